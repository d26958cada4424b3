//! The list of open clouds.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::App;
use super::samples::Sample;
use super::scan_from_here::ScanFromHere;
use super::source::Source;
use super::state::{Entry, PlaneChoice, State};
use crate::fruit::clouds_in;

/// Files that are remembered as opened lately.
const MOST_RECENT: usize = 12;

/// The outcome of opening some paths.
struct Opened {
    /// The place in the list of the first cloud that they name.
    first: Option<usize>,
    /// The problems with them, a sentence each.
    problems: Vec<String>,
}

/// The commands about the list. Every part turns to another cloud with it.
impl App {
    pub(super) fn open(&mut self, paths: &[PathBuf]) {
        let opened = self.context.state.open(paths);
        let folders = paths.iter().filter(|path| path.is_dir());
        let folders: Vec<PathBuf> = folders
            .filter_map(|path| std::path::absolute(path).ok())
            .collect();
        self.list_changed(!folders.is_empty());
        let open = &mut self.context.state.many.folders;
        open.retain(|known| !folders.contains(known));
        open.extend(folders);
        for problem in opened.problems {
            self.context.say(true, problem);
        }
        match opened.first {
            Some(place) => self.show(place),
            // Whatever was open was a sample, and has gone.
            None if self.context.state.current.is_none() => self.open_sample(Sample::Pepper),
            None => {}
        }
    }

    pub(super) fn open_sample(&mut self, sample: Sample) {
        self.add_and_show(Source::Bundled(sample));
    }

    pub(super) fn add_and_show(&mut self, source: Source) {
        let place = self.context.state.add(source);
        self.list_changed(false);
        self.context.state.true_axes.leave_subject();
        self.show(place);
    }

    /// Makes a cloud of the points that a depth camera in the place of the view's eye would see, in that camera's frame.
    pub(super) fn scan_from_here(&mut self) {
        let state = &self.context.state;
        let Some(whole) = state.source() else { return };
        let scan = Source::Scanned(ScanFromHere::new(
            whole,
            state.settings.request.unit,
            &state.camera,
        ));
        let mut request = state.settings.request.clone();
        // The camera is at the origin of its own frame.
        request.params.viewpoint = glam::DVec3::ZERO;
        self.context.set_request(request, None);
        self.inspector.forget_framing();
        self.add_and_show(scan);
    }

    /// Writes the current cloud to a file beside the interface.
    pub(super) fn save_cloud(&mut self, path: PathBuf) {
        if let Some(source) = self.context.state.source().cloned() {
            self.saves.submit(move |()| source.save(&path));
        }
    }

    pub(super) fn show(&mut self, place: usize) {
        let state = &mut self.context.state;
        if place >= state.entries.len() || state.current == Some(place) {
            return;
        }
        state.current = Some(place);
        // A plane is chosen for one cloud; the next one begins with its best.
        state.settings.plane = PlaneChoice::Best;
        state.is_playing = false;
        state.true_axes.leave_subject();
        self.peduncle.leave_cloud(&mut state.peduncle);
        self.inspector.turn_to_cloud();
    }

    pub(super) fn close(&mut self) {
        let state = &mut self.context.state;
        let Some(current) = state.current.take() else {
            return;
        };
        let closed = state.entries.remove(current);
        // Its folder is no longer open as a whole.
        let is_of = |folder: &PathBuf| {
            let path = std::path::absolute(closed.source.path());
            path.is_ok_and(|path| path.parent() == Some(folder))
        };
        state.many.folders.retain(|folder| !is_of(folder));
        self.peduncle.leave_cloud(&mut state.peduncle);
        let count = state.entries.len();
        self.list_changed(false);
        if count == 0 {
            self.inspector.close(&mut self.context);
        } else {
            self.show(current.min(count - 1));
        }
    }

    fn list_changed(&mut self, opened_folder: bool) {
        self.many.list_changed(opened_folder, &mut self.context);
    }
}

impl State {
    /// Adds files, and what lies in folders, to the list; what is there already is not added again.
    fn open(&mut self, paths: &[PathBuf]) -> Opened {
        let mut opened = Opened {
            first: None,
            problems: Vec::new(),
        };
        // A sample makes room for the first file of one's own.
        self.entries.retain(|entry| entry.source.is_file());
        self.current = self.current.filter(|&i| i < self.entries.len());
        let entries = self.entries.iter().enumerate();
        let mut known: HashMap<Source, usize> = entries
            .map(|(place, entry)| (entry.source.clone(), place))
            .collect();
        for path in paths {
            let clouds = if path.is_dir() {
                match clouds_in(path) {
                    Ok(clouds) if clouds.is_empty() => {
                        opened.problems.push(format!(
                            "{}: there are no PLY files in this folder.",
                            path.display()
                        ));
                        continue;
                    }
                    Ok(clouds) => clouds,
                    Err(error) => {
                        opened.problems.push(format!("{}: {error}.", path.display()));
                        continue;
                    }
                }
            } else {
                vec![path.clone()]
            };
            for cloud in clouds {
                let source = Source::File(cloud);
                let place = *known.entry(source.clone()).or_insert_with(|| {
                    self.entries.push(Entry {
                        source,
                        problem: None,
                    });
                    self.entries.len() - 1
                });
                opened.first.get_or_insert(place);
            }
            // A list that comes back is nothing that somebody opened.
            if paths.len() <= MOST_RECENT {
                self.remember(path);
            }
        }
        opened
    }

    /// Adds one cloud; says where in the list it is.
    fn add(&mut self, source: Source) -> usize {
        let known = self.entries.iter().position(|entry| entry.source == source);
        known.unwrap_or_else(|| {
            self.entries.push(Entry {
                source,
                problem: None,
            });
            self.entries.len() - 1
        })
    }

    fn remember(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|known| *known != path);
        self.recent.insert(0, path);
        self.recent.truncate(MOST_RECENT);
    }
}
