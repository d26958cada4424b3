//! Progress bars on standard error, and the time that each stage takes.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use axiscope::method::{Observe, Stage};
use axiscope::parallel::Watch;
use indicatif::{ProgressBar, ProgressStyle};

/// A watch over the analysis of one cloud: it measures the time of each stage, and shows a bar if the work takes long.
pub(super) struct StageClock {
    bar: ProgressBar,
    started: Instant,
    entered: Mutex<Vec<(Stage, Instant)>>,
}

/// The time after which a bar is shown.
const PATIENCE: Duration = Duration::from_millis(500);

impl StageClock {
    pub(super) fn new() -> Self {
        Self {
            bar: bar("{msg:<16} {wide_bar} {percent:>3} %").with_message("Reading"),
            started: Instant::now(),
            entered: Mutex::default(),
        }
    }

    /// Removes the bar and returns the time that each stage took.
    pub(super) fn finish(self) -> StageTimes {
        self.bar.finish_and_clear();
        let entered = self.entered.into_inner().unwrap_or_default();
        StageTimes {
            entered,
            ended: Instant::now(),
        }
    }
}

/// The times at which the stages began.
pub(super) struct StageTimes {
    entered: Vec<(Stage, Instant)>,
    ended: Instant,
}

impl StageTimes {
    /// Returns the time that `stage` took in milliseconds; 0 if it did not run.
    pub(super) fn milliseconds(&self, stage: Stage) -> f64 {
        let ends = self.entered.iter().skip(1).map(|e| e.1).chain([self.ended]);
        let spans = self.entered.iter().zip(ends);
        let of_stage = spans.filter(|((s, _), _)| *s == stage);
        let milliseconds = of_stage.map(|((_, start), end)| (end - *start).as_secs_f64() * 1e3);
        // The sum of nothing is -0.0.
        milliseconds.sum::<f64>() + 0.0
    }
}

impl Watch for StageClock {
    fn advanced(&self, done: usize, total: usize) {
        if self.started.elapsed() > PATIENCE {
            self.bar.set_length(total as u64);
            self.bar.set_position(done as u64);
        }
    }
}

impl Observe for StageClock {
    fn entered(&self, stage: Stage) {
        if let Ok(mut entered) = self.entered.lock() {
            entered.push((stage, Instant::now()));
        }
        self.bar.set_message(match stage {
            Stage::Filters => "Filtering",
            Stage::Normals => "Normals",
            Stage::Center => "Fruit center",
            Stage::PlaneTerms => "Candidate planes",
            Stage::Scores => "Scores",
        });
    }
}

/// Returns a bar on standard error, which is invisible unless that is a terminal.
pub(super) fn bar(template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::no_length().with_style(style.progress_chars("━╸─"))
}

/// A progress bar that counts finished pieces, which may report out of order: the bar never moves back.
pub(super) struct CountingBar {
    bar: ProgressBar,
    furthest: Mutex<usize>,
}

impl CountingBar {
    pub(super) fn new(what: &str, total: usize) -> Self {
        let bar = bar(&format!("{what} {{wide_bar}} {{pos}}/{{len}}, {{eta}} left"));
        bar.set_length(total as u64);
        Self {
            bar,
            furthest: Mutex::default(),
        }
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for CountingBar {
    fn advanced(&self, done: usize, _total: usize) {
        if let Ok(mut furthest) = self.furthest.lock()
            && done > *furthest
        {
            *furthest = done;
            self.bar.set_position(done as u64);
        }
    }
}
