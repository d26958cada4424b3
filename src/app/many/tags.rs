//! Tags and notes of clouds: a file in their folder, written by a thread of its own.
//!
//! An edit is shown at once and written behind it: the file is read again, only the edited cloud's part is
//! changed, and the whole goes aside, onto the disk, and into place. A file that does not parse, or is newer
//! than this program, is left as it is.

use std::collections::{BTreeMap, VecDeque};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};

use serde::{Deserialize, Serialize};

use crate::annotate::DiskFiles;
use crate::annotate::Files;
use crate::app::workers::Repaint;

/// The file's name in the folder of the clouds.
pub const TAGS_FILE: &str = "axiscope-tags.json";
const SCHEMA: &str = "axiscope.tags/1";
/// No file of tags is longer.
const LONGEST: u64 = 64 << 20;

/// What somebody says of a cloud.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tagged {
    /// Short words, sorted, each once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tags: Vec<String>,
    /// Anything.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

impl Tagged {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.tags.is_empty() && self.note.is_empty()
    }

    /// With these tags, as somebody types them: commas between, spaces around, in any order.
    #[must_use]
    pub fn with_tags(&self, typed: &str) -> Self {
        let mut tags: Vec<String> = typed
            .split(',')
            .map(|tag| tag.split_whitespace().collect::<Vec<_>>().join(" "))
            .filter(|tag| !tag.is_empty())
            .collect();
        tags.sort();
        tags.dedup();
        Self {
            tags,
            note: self.note.clone(),
        }
    }
}

/// The file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TagsFile {
    schema: String,
    clouds: BTreeMap<String, Tagged>,
}

/// The tags and notes in a folder, by the clouds' file names; none where there is no file.
///
/// # Errors
/// A sentence where the file cannot be used.
pub fn read_tags(folder: &Path) -> Result<BTreeMap<String, Tagged>, String> {
    let path = folder.join(TAGS_FILE);
    let named = |why: String| {
        format!(
            "{}: the tags are not used, and the file is left as it is: {why}.",
            path.display()
        )
    };
    let bytes = match DiskFiles::default().read(&path, LONGEST) {
        Ok(None) => return Ok(BTreeMap::new()),
        Ok(Some(bytes)) => bytes,
        Err(error) => return Err(named(error.to_string())),
    };
    // Its schema first: of a newer file nothing else can be expected to be understood.
    let schema = serde_json::from_slice::<serde_json::Value>(&bytes)
        .map_err(|error| named(error.to_string()))?
        .get("schema")
        .and_then(|s| s.as_str().map(str::to_owned));
    if schema.as_deref() != Some(SCHEMA) {
        let is = schema.map_or_else(|| "it names no schema".into(), |s| format!("its schema is {s:?}"));
        return Err(named(format!("{is}, and this program knows {SCHEMA:?}")));
    }
    let file: TagsFile = serde_json::from_slice(&bytes).map_err(|error| named(error.to_string()))?;
    Ok(file.clouds)
}

/// Changes what is said of one cloud in its folder's file, and returns once that is on the disk.
fn write_tags(folder: &Path, name: &str, tagged: &Tagged) -> Result<(), String> {
    let path = folder.join(TAGS_FILE);
    // One program at a time; where folders cannot be locked, the last one wins for this cloud alone.
    let lock = File::open(folder).ok();
    let _is_locked = lock.as_ref().is_some_and(|lock| lock.lock().is_ok());
    let mut clouds = read_tags(folder)?;
    if tagged.is_empty() {
        clouds.remove(name);
    } else {
        clouds.insert(name.to_owned(), tagged.clone());
    }
    let file = TagsFile {
        schema: SCHEMA.into(),
        clouds,
    };
    let mut text = serde_json::to_string_pretty(&file).map_err(|error| error.to_string())?;
    text.push('\n');
    DiskFiles::default()
        .replace(&path, text.as_bytes())
        .map_err(|error| {
            format!(
                "{}: the tags could not be saved, and are kept until the program ends: {error}.",
                path.display()
            )
        })
}

/// What the thread that writes is asked.
enum Task {
    Read(PathBuf),
    Write { path: PathBuf, tagged: Tagged },
}

/// What it answers.
#[derive(Debug)]
pub(super) enum Answer {
    /// The folder's tags, by the clouds' names, or what is wrong with them.
    Read(PathBuf, Result<BTreeMap<String, Tagged>, String>),
    /// One edit is on the disk, or why it is not.
    Written(Result<(), String>),
}

/// The thread that reads and writes tags, in the order in which that is asked.
pub(super) struct Scribe {
    tasks: Option<Sender<Task>>,
    answers: Receiver<Answer>,
    thread: Option<std::thread::JoinHandle<()>>,
    /// Tasks that were not answered yet.
    open: usize,
}

impl Scribe {
    pub(super) fn new(repaint: Repaint) -> std::io::Result<Self> {
        let (tasks, todo) = channel();
        let (done, answers) = channel();
        let thread = std::thread::Builder::new()
            .name("tags".into())
            .spawn(move || work(&todo, &done, &repaint))?;
        Ok(Self {
            tasks: Some(tasks),
            answers,
            thread: Some(thread),
            open: 0,
        })
    }

    pub(super) fn read(&mut self, folder: PathBuf) {
        self.ask(Task::Read(folder));
    }

    pub(super) fn write(&mut self, path: PathBuf, tagged: Tagged) {
        self.ask(Task::Write { path, tagged });
    }

    fn ask(&mut self, task: Task) {
        if self.tasks.as_ref().is_some_and(|tasks| tasks.send(task).is_ok()) {
            self.open += 1;
        }
    }

    pub(super) fn take(&mut self) -> Option<Answer> {
        let answer = self.answers.try_recv().ok()?;
        self.open -= 1;
        Some(answer)
    }

    pub(super) fn is_busy(&self) -> bool {
        self.open > 0
    }
}

impl Drop for Scribe {
    /// What was asked before the window closes is still written.
    fn drop(&mut self) {
        self.tasks = None;
        if let Some(thread) = self.thread.take() {
            // A fault of that thread has been told on standard error.
            let _ = thread.join();
        }
    }
}

fn work(todo: &Receiver<Task>, done: &Sender<Answer>, repaint: &Repaint) {
    let mut queue = VecDeque::new();
    loop {
        let Some(task) = queue.pop_front().or_else(|| todo.recv().ok()) else {
            return;
        };
        queue.extend(todo.try_iter());
        let answer = match task {
            Task::Read(folder) => {
                let tags = read_tags(&folder);
                Answer::Read(folder, tags)
            }
            Task::Write { path, tagged } => {
                // Of what is typed, letter by letter, only the newest need go to the disk.
                let is_newer =
                    |task: &Task| matches!(task, Task::Write { path: other, .. } if *other == path);
                if queue.iter().any(is_newer) {
                    Answer::Written(Ok(()))
                } else {
                    let folder = path.parent().unwrap_or(Path::new(""));
                    Answer::Written(write_tags(folder, &super::run::name_of(&path), &tagged))
                }
            }
        };
        // Nobody listens any more where the window has closed.
        let _ = done.send(answer);
        repaint();
    }
}
