//! The results of the open clouds as files, the same as those of `axiscope evaluate`, and its command line.

use std::path::{Path, PathBuf};

use super::Many;
use crate::app::context::Context;
use crate::app::state::State;
use crate::evaluate::{Row, Sweep, TruthChoice, WorstPicture, result_files};
use crate::files::write_all;
use crate::fruit::Request;

/// The number of clouds with a picture in the report.
const PICTURES: usize = 12;
/// The name of the folder of results.
const FOLDER: &str = "axiscope-results";

impl State {
    /// Returns the innermost folder that contains all open files.
    fn common_folder(&self) -> Option<PathBuf> {
        let mut folders = self
            .many
            .rows
            .iter()
            .filter_map(|row| row.path.as_deref()?.parent());
        let first = folders.next()?.to_owned();
        Some(folders.fold(first, |common, folder| {
            let shared = common.components().zip(folder.components());
            shared.take_while(|(a, b)| a == b).map(|(a, _)| a).collect()
        }))
    }

    /// Returns the rows of the open files against the chosen reference, with their tags; `None` if one is not evaluated
    /// yet.
    fn result_rows(&self, folder: &Path) -> Option<Vec<Row>> {
        let rows = self.many.rows.iter();
        rows.filter_map(|row| Some((row, row.path.as_ref()?)))
            .map(|(row, path)| {
                let outcome = row.outcome.as_ref().filter(|_| !row.is_stale)?;
                Some(Row {
                    file: Row::name_in(folder, path),
                    tags: row.tagged.tags.join(", "),
                    note: row.tagged.note.clone(),
                    ..outcome.against(self.many.against)
                })
            })
            .collect()
    }
}

/// Returns the command line that evaluates the folder of the open clouds in the same way; `None` if no file is open.
pub fn evaluate_command_line(state: &State) -> Option<Vec<String>> {
    let folder = state.common_folder()?;
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        &folder
    };
    let mut words: Vec<String> = ["axiscope".into(), "evaluate".into(), folder.display().to_string()].into();
    if state.many.against != TruthChoice::Auto {
        words.extend(["--truth".into(), state.many.against.name().into()]);
    }
    words.extend(["--out".into(), FOLDER.into()]);
    words.extend(state.settings.request.options());
    if state.many.sweep.map.is_some() {
        let ranges = &state.many.sweep.ranges;
        let ([from, to], [low, high]) = (ranges.u, ranges.tau_cm_per_rad);
        words.push("--sweep".into());
        words.push(format!("u={from}..{to}:{}", ranges.u_step));
        words.push(format!("tau={low}..{high}:{}", ranges.tau_step_cm_per_rad));
    }
    Some(words)
}

/// All input of the results.
struct Task {
    clouds: PathBuf,
    request: Request,
    rows: Vec<Row>,
    sweep: Option<Sweep>,
    /// The parent of the folder of results.
    into: PathBuf,
}

impl Many {
    /// Saves the results in a new folder within `into`.
    pub(super) fn save_results(&mut self, into: PathBuf, cx: &mut Context) {
        let Some(clouds) = cx.state.common_folder() else {
            cx.say(false, "There is no open file to save results of.");
            return;
        };
        let Some(rows) = cx.state.result_rows(&clouds) else {
            cx.say(
                false,
                "Results are saved once all open clouds are evaluated with the parameters in force.",
            );
            return;
        };
        let sweep = &cx.state.many.sweep;
        let is_whole = !sweep.is_stale && sweep.progress.is_none() && !sweep.ranges.only_current;
        let task = Task {
            clouds,
            request: cx.state.settings.request.clone(),
            rows,
            sweep: sweep.map.as_deref().filter(|_| is_whole).cloned(),
            into,
        };
        self.results.submit(move |_| save(&task));
    }

    pub(super) fn update_results(&mut self, cx: &mut Context) {
        if let Some(result) = self.results.take() {
            cx.say_result(result);
        }
    }
}

fn save(task: &Task) -> Result<String, String> {
    let (pictures, lack) = pictures(task);
    let files = result_files(
        &task.clouds,
        &task.request,
        &task.rows,
        task.sweep.as_ref(),
        &pictures,
    )
    .map_err(|error| format!("The results could not be made: {error}."))?;
    let folder = new_folder(&task.into).map_err(|error| format!("{}: {error}.", task.into.display()))?;
    let files = files.into_iter().map(|(name, bytes)| (folder.join(name), bytes));
    write_all(&files.collect::<Vec<_>>()).map_err(|failed| format!("{failed}."))?;
    let lack = lack.map(|lack| format!(" {lack}")).unwrap_or_default();
    Ok(format!(
        "Saved the results of {} clouds in {}.{lack}",
        task.rows.len(),
        folder.display()
    ))
}

/// Creates a new folder, so that no file is overwritten.
fn new_folder(into: &Path) -> std::io::Result<PathBuf> {
    let mut count = 1;
    loop {
        let name = if count == 1 {
            FOLDER.to_owned()
        } else {
            format!("{FOLDER}-{count}")
        };
        let folder = into.join(name);
        match std::fs::create_dir(&folder) {
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => count += 1,
            result => return result.map(|()| folder),
        }
    }
}

fn pictures(task: &Task) -> (Vec<WorstPicture>, Option<String>) {
    crate::evaluate::pictures_of_worst(&task.clouds, &task.rows, &task.request, PICTURES)
}
