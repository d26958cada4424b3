//! A disk in memory that fails, or dies in the middle of writing, when it is told to.

use std::collections::BTreeMap;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard};

use axiscope::annotate::{Files, Store};

#[derive(Default)]
struct State {
    files: BTreeMap<PathBuf, Vec<u8>>,
    /// Operations that still succeed, and what happens afterwards.
    trouble: Option<(usize, Trouble)>,
}

#[derive(Clone, Copy)]
enum Trouble {
    /// Every operation fails, a write after half of its bytes.
    Fails(ErrorKind),
    /// The one operation is done in part, and everything after it fails.
    Dies(f64),
}

/// Clones are the same disk.
#[derive(Clone, Default)]
pub struct Disk(Arc<Mutex<State>>);

impl Disk {
    pub fn fail_after(&self, operations: usize, kind: ErrorKind) {
        self.state().trouble = Some((operations, Trouble::Fails(kind)));
    }

    pub fn die_after(&self, operations: usize, part: f64) {
        self.state().trouble = Some((operations, Trouble::Dies(part)));
    }

    pub fn heal(&self) {
        self.state().trouble = None;
    }

    pub fn paths(&self) -> Vec<PathBuf> {
        self.state().files.keys().cloned().collect()
    }

    pub fn read_file(&self, path: &Path) -> Option<Vec<u8>> {
        self.state().files.get(path).cloned()
    }

    pub fn write_file(&self, path: &Path, bytes: &[u8]) {
        self.state().files.insert(path.into(), bytes.into());
    }

    /// What the store's axis file should hold.
    pub fn content_of(store: &Store) -> Vec<u8> {
        store
            .current()
            .map(|a| a.to_json().into_bytes())
            .unwrap_or_default()
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().expect("no test panicked here")
    }

    /// How much of an operation is done, and its error: all and none where the disk is well.
    fn step(&self) -> (f64, Option<io::Error>) {
        let mut state = self.state();
        match &mut state.trouble {
            None => (1.0, None),
            Some((left @ 1.., _)) => {
                *left -= 1;
                (1.0, None)
            }
            Some((0, Trouble::Fails(kind))) => (0.5, Some((*kind).into())),
            Some((0, Trouble::Dies(part))) => {
                let done = std::mem::replace(part, 0.0);
                (done, Some(ErrorKind::BrokenPipe.into()))
            }
        }
    }
}

impl Files for Disk {
    fn read(&mut self, path: &Path, _: u64) -> io::Result<Option<Vec<u8>>> {
        // Reading is what every session begins with; its failure is another test's.
        Ok(self.read_file(path))
    }

    fn claim(&mut self, _: &Path) -> io::Result<()> {
        Ok(())
    }

    fn append(&mut self, path: &Path, at: u64, bytes: &[u8]) -> io::Result<()> {
        let (part, error) = self.step();
        let mut state = self.state();
        let file = state.files.entry(path.into()).or_default();
        let at = usize::try_from(at).expect("small");
        assert!(at <= file.len(), "nothing is skipped");
        if part > 0.0 {
            file.truncate(at);
            file.extend(&bytes[..(part * bytes.len() as f64) as usize]);
        }
        error.map_or(Ok(()), Err)
    }

    fn replace(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let (part, error) = self.step();
        // All or nothing: half of it is a file of another name.
        if part == 1.0 {
            self.write_file(path, bytes);
        }
        error.map_or(Ok(()), Err)
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        let (part, error) = self.step();
        if part == 1.0 {
            self.state().files.remove(path);
        }
        error.map_or(Ok(()), Err)
    }

    fn probe(&mut self, _: &Path) -> io::Result<()> {
        self.step().1.map_or(Ok(()), Err)
    }
}
