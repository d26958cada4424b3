//! The rows of the table of open clouds, their order, and the filter.

use std::cmp::Ordering;
use std::path::PathBuf;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::evaluate::{CloudTags, Outcome, TruthChoice};
use crate::view::grouped;

/// A column of the table, by which it can be sorted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Column {
    /// The order in which the clouds were opened.
    Opened,
    /// The file's name.
    Name,
    /// Points in the file.
    Points,
    /// The error against the peduncle's axis.
    PeduncleError,
    /// The error against the peduncle's own direction.
    DirectionError,
    /// The error against the simulator's axis.
    TrueError,
    /// The error against the axis set by hand.
    ManualError,
    /// The winner's lead over the runner-up.
    Lead,
    /// The number of warnings.
    Warnings,
    /// The annotators.
    Annotators,
    /// The tags.
    Tags,
}

impl Column {
    /// All columns in order.
    pub const ALL: [Self; 11] = [
        Self::Opened,
        Self::Name,
        Self::Points,
        Self::PeduncleError,
        Self::DirectionError,
        Self::TrueError,
        Self::ManualError,
        Self::Lead,
        Self::Warnings,
        Self::Annotators,
        Self::Tags,
    ];

    /// Returns the column of the error against a reference.
    pub fn of_error(choice: TruthChoice) -> Option<Self> {
        match choice {
            TruthChoice::Auto => None,
            TruthChoice::Peduncle => Some(Self::PeduncleError),
            TruthChoice::PeduncleDirection => Some(Self::DirectionError),
            TruthChoice::Truth => Some(Self::TrueError),
            TruthChoice::Manual => Some(Self::ManualError),
        }
    }
}

/// The order of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sort {
    /// The column.
    pub by: Column,
    /// Whether large values come first.
    pub is_descending: bool,
}

impl Default for Sort {
    fn default() -> Self {
        Self {
            by: Column::Opened,
            is_descending: false,
        }
    }
}

/// The conditions that a cloud must meet to be shown.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Filter {
    /// A part of the name, the tags or the note, in upper or lower case.
    pub search: String,
    /// Only clouds without an error against the chosen reference.
    pub only_failed: bool,
    /// Only clouds that nobody has annotated.
    pub only_unannotated: bool,
    /// Only clouds with warnings.
    pub only_warned: bool,
    /// Only clouds with a larger error, in degrees.
    pub above_deg: Option<f64>,
    /// Only clouds with this tag.
    pub tag: Option<String>,
}

impl Filter {
    /// Returns whether every cloud is shown.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// The row of one open cloud.
#[derive(Debug, Clone)]
pub struct TableRow {
    /// The file's name.
    pub name: String,
    /// The file; `None` for a bundled sample.
    pub path: Option<PathBuf>,
    /// The result, once it is known.
    pub outcome: Option<Arc<Outcome>>,
    /// Whether the result belongs to other parameters than the current ones.
    pub is_stale: bool,
    /// Tags and note.
    pub tagged: CloudTags,
    /// The texts of the cells in the order of [`Column::ALL`], made when a value changes instead of in each frame.
    pub cells: Arc<[String; 11]>,
}

impl TableRow {
    pub(super) fn new(place: usize, name: String, path: Option<PathBuf>) -> Self {
        let mut row = Self {
            name,
            path,
            outcome: None,
            is_stale: false,
            tagged: CloudTags::default(),
            cells: Arc::default(),
        };
        row.write_cells(place);
        row
    }

    /// Updates the texts of the cells.
    pub(super) fn write_cells(&mut self, place: usize) {
        let degrees = |choice| match &self.outcome {
            None => String::new(),
            Some(outcome) => outcome
                .error_deg(choice)
                .map_or_else(|| "–".into(), |e| format!("{e:.1}")),
        };
        let row = self.outcome.as_ref().map(|o| o.row());
        let text = |column| match column {
            Column::Opened => (place + 1).to_string(),
            Column::Name => self.name.clone(),
            Column::Points => row.and_then(|r| r.points).map(grouped).unwrap_or_default(),
            Column::PeduncleError => degrees(TruthChoice::Peduncle),
            Column::DirectionError => degrees(TruthChoice::PeduncleDirection),
            Column::TrueError => degrees(TruthChoice::Truth),
            Column::ManualError => degrees(TruthChoice::Manual),
            Column::Lead => {
                let lead = row.and_then(|r| r.lead);
                lead.map(|l| format!("{:.1}", 100.0 * l)).unwrap_or_default()
            }
            Column::Warnings => match self.warning_count() {
                0 => String::new(),
                count => count.to_string(),
            },
            Column::Annotators => row.map(|r| r.annotators.clone()).unwrap_or_default(),
            Column::Tags => self.tagged.tags.join(", "),
        };
        self.cells = Arc::new(Column::ALL.map(text));
    }

    /// Returns the number of warnings, where the failure of an unusable cloud counts as one.
    pub fn warning_count(&self) -> usize {
        let Some(outcome) = &self.outcome else { return 0 };
        let row = outcome.row();
        // Rows hold warnings as sentences one after another.
        let sentences = row.warnings.split(". ").filter(|s| !s.trim().is_empty()).count();
        sentences + usize::from(row.sha256.is_none())
    }

    /// Returns the reason, as a clause, why there is no error against the reference.
    pub fn failure(&self, choice: TruthChoice) -> Option<&str> {
        self.outcome.as_ref()?.failure(choice)
    }

    /// Returns the error against the reference in degrees.
    pub fn error_deg(&self, choice: TruthChoice) -> Option<f64> {
        self.outcome.as_ref()?.error_deg(choice)
    }

    /// Returns the distance of the fruit center from the origin, the place of the depth camera, in centimeters.
    pub fn distance_cm(&self) -> Option<f64> {
        let row = self.outcome.as_ref()?.row();
        let [x, y, z] = row.center?;
        Some((x * x + y * y + z * z).sqrt() * row.unit?.in_cm())
    }

    /// Returns the difference between the runner-up's score and the best, in percent of the best.
    pub fn lead_percent(&self) -> Option<f64> {
        Some(100.0 * self.outcome.as_ref()?.row().lead?)
    }

    /// Returns the lean of the reference axis out of the plane across the view ray in degrees, 0 to 90: by Eq. 16 no
    /// error is less.
    pub fn lean_deg(&self, choice: TruthChoice) -> Option<f64> {
        let reference = self.outcome.as_ref()?.reference(choice)?;
        Some(reference.error_parts.as_ref()?.lean_deg)
    }

    /// Returns the share of the fruit's surface that the camera saw in percent, which only the simulator knows.
    pub fn coverage_percent(&self) -> Option<f64> {
        Some(100.0 * self.outcome.as_ref()?.row().coverage?)
    }

    fn passes(&self, filter: &Filter, search: &str, choice: TruthChoice) -> bool {
        let found = |text: &str| text.to_lowercase().contains(search);
        let is_sought = search.is_empty()
            || found(&self.name)
            || found(&self.tagged.note)
            || self.tagged.tags.iter().any(|tag| found(tag));
        let is_annotated = self
            .outcome
            .as_ref()
            .is_some_and(|o| !o.row().annotators.is_empty());
        is_sought
            && (!filter.only_failed || self.failure(choice).is_some())
            && (!filter.only_unannotated || !is_annotated)
            && (!filter.only_warned || self.warning_count() > 0)
            && filter
                .above_deg
                .is_none_or(|limit| self.error_deg(choice).is_some_and(|e| e > limit))
            && filter
                .tag
                .as_ref()
                .is_none_or(|tag| self.tagged.tags.contains(tag))
    }
}

/// Returns the places of the shown rows in their order. Rows without the value come last in both directions; equal rows
/// stay in the order of opening.
pub fn ordered(rows: &[TableRow], sort: Sort, filter: &Filter, choice: TruthChoice) -> Vec<usize> {
    let search = filter.search.trim().to_lowercase();
    let mut order: Vec<usize> = (0..rows.len())
        .filter(|&place| rows[place].passes(filter, &search, choice))
        .collect();
    let turned = |order: Ordering| {
        if sort.is_descending {
            order.reverse()
        } else {
            order
        }
    };
    let number = |value: fn(&TableRow) -> Option<f64>| {
        move |a: &TableRow, b: &TableRow| match (value(a), value(b)) {
            (Some(a), Some(b)) => turned(a.total_cmp(&b)),
            (a, b) => b.is_some().cmp(&a.is_some()),
        }
    };
    let text = |value: fn(&TableRow) -> String| {
        move |a: &TableRow, b: &TableRow| {
            let (a, b) = (value(a), value(b));
            match (a.is_empty(), b.is_empty()) {
                (false, false) => turned(a.cmp(&b)),
                (a, b) => a.cmp(&b),
            }
        }
    };
    let mut by = |compare: &dyn Fn(&TableRow, &TableRow) -> Ordering| {
        order.sort_by(|&a, &b| compare(&rows[a], &rows[b]));
    };
    match sort.by {
        Column::Opened => {
            if sort.is_descending {
                order.reverse();
            }
        }
        Column::Name => by(&text(|r| r.name.clone())),
        Column::Points => by(&number(|r| Some(r.outcome.as_ref()?.row().points? as f64))),
        Column::PeduncleError => by(&number(|r| r.error_deg(TruthChoice::Peduncle))),
        Column::DirectionError => by(&number(|r| r.error_deg(TruthChoice::PeduncleDirection))),
        Column::TrueError => by(&number(|r| r.error_deg(TruthChoice::Truth))),
        Column::ManualError => by(&number(|r| r.error_deg(TruthChoice::Manual))),
        Column::Lead => by(&number(TableRow::lead_percent)),
        Column::Warnings => by(&number(|r| r.outcome.as_ref().map(|_| r.warning_count() as f64))),
        Column::Annotators => by(&text(|r| r.cells[9].clone())),
        Column::Tags => by(&text(|r| r.cells[10].clone())),
    }
    order
}
