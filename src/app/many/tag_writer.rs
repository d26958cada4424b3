//! A thread that reads and writes tags in the order in which that is asked, behind what is shown.

use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};

use crate::app::workers::Repaint;
use crate::evaluate::{Tagged, read_tags, write_tags};

/// A task of the thread.
enum Task {
    Read(PathBuf),
    Write { path: PathBuf, tagged: Tagged },
}

/// The result of a task.
#[derive(Debug)]
pub(super) enum TagResult {
    /// The tags of a folder by the clouds' names, or a sentence about the file.
    Read(PathBuf, Result<BTreeMap<String, Tagged>, String>),
    /// One edit is on the disk, or a sentence says why not.
    Written(Result<(), String>),
}

/// The handle of the thread.
pub(super) struct TagWriter {
    tasks: Option<Sender<Task>>,
    results: Receiver<TagResult>,
    thread: Option<std::thread::JoinHandle<()>>,
    /// The number of tasks without a result.
    pending: usize,
}

impl TagWriter {
    pub(super) fn new(repaint: Repaint) -> std::io::Result<Self> {
        let (tasks, received) = channel();
        let (done, results) = channel();
        let thread = std::thread::Builder::new()
            .name("tags".into())
            .spawn(move || work(&received, &done, &repaint))?;
        Ok(Self {
            tasks: Some(tasks),
            results,
            thread: Some(thread),
            pending: 0,
        })
    }

    pub(super) fn read(&mut self, folder: PathBuf) {
        self.submit(Task::Read(folder));
    }

    pub(super) fn write(&mut self, path: PathBuf, tagged: Tagged) {
        self.submit(Task::Write { path, tagged });
    }

    fn submit(&mut self, task: Task) {
        if self.tasks.as_ref().is_some_and(|tasks| tasks.send(task).is_ok()) {
            self.pending += 1;
        }
    }

    pub(super) fn take(&mut self) -> Option<TagResult> {
        let result = self.results.try_recv().ok()?;
        self.pending -= 1;
        Some(result)
    }

    pub(super) fn is_busy(&self) -> bool {
        self.pending > 0
    }
}

impl Drop for TagWriter {
    /// Waits for the edits that were asked for before the window closed.
    fn drop(&mut self) {
        self.tasks = None;
        if let Some(thread) = self.thread.take() {
            // A panic of that thread has been printed already.
            let _ = thread.join();
        }
    }
}

fn work(tasks: &Receiver<Task>, done: &Sender<TagResult>, repaint: &Repaint) {
    let mut queue = VecDeque::new();
    loop {
        let Some(task) = queue.pop_front().or_else(|| tasks.recv().ok()) else {
            return;
        };
        queue.extend(tasks.try_iter());
        let result = match task {
            Task::Read(folder) => {
                let tags = read_tags(&folder);
                TagResult::Read(folder, tags)
            }
            Task::Write { path, tagged } => {
                // While somebody types, only the newest text has to go to the disk.
                let is_newer =
                    |task: &Task| matches!(task, Task::Write { path: other, .. } if *other == path);
                if queue.iter().any(is_newer) {
                    TagResult::Written(Ok(()))
                } else {
                    let folder = path.parent().unwrap_or(Path::new(""));
                    TagResult::Written(write_tags(folder, &super::background::name_of(&path), &tagged))
                }
            }
        };
        // The window may have closed.
        let _ = done.send(result);
        repaint();
    }
}
