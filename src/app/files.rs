//! The list of open clouds.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::state::{Entry, State};
use crate::app::inspector::stages::Source;
use crate::fruit::clouds_in;

/// Files that are remembered as opened lately.
const MOST_RECENT: usize = 12;

/// What opening some paths came to.
pub(super) struct Opened {
    /// The place in the list of the first cloud that they name.
    pub(super) first: Option<usize>,
    /// What is wrong with them, a sentence each.
    pub(super) problems: Vec<String>,
}

impl State {
    /// Adds files, and what lies in folders, to the list; what is there already is not added again.
    pub(super) fn open(&mut self, paths: &[PathBuf]) -> Opened {
        let mut opened = Opened {
            first: None,
            problems: Vec::new(),
        };
        // A sample makes room for the first file of one's own.
        self.entries
            .retain(|entry| matches!(entry.source, Source::File(_)));
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
    pub(super) fn add(&mut self, source: Source) -> usize {
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
