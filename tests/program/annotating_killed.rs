//! The program is killed while somebody annotates, over and over: what it said was saved is there.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use axiscope::annotate::DiskFiles;
use axiscope::annotate::{Annotation, Author, CloudId, Store};
use axiscope::fruit::sha256_hex;
use axiscope::geometry::Unit;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tempfile::TempDir;

/// How often the program is killed: `AXISCOPE_KILLS`, or 200.
fn kills() -> usize {
    let asked = std::env::var("AXISCOPE_KILLS").ok();
    asked.and_then(|kills| kills.parse().ok()).unwrap_or(200)
}

/// More than the program manages before it is killed.
const LINES: usize = 300;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Deed {
    /// An edit, told by its note.
    Edit(usize),
    Undo,
    Redo,
}

/// What the annotator's history should be.
#[derive(Debug, Clone, Default)]
struct Model {
    path: Vec<usize>,
    done: usize,
}

impl Model {
    fn after(deeds: &[Deed]) -> Self {
        let mut model = Self::default();
        for deed in deeds {
            model.apply(*deed);
        }
        model
    }

    fn apply(&mut self, deed: Deed) {
        match deed {
            Deed::Edit(note) => {
                self.path.truncate(self.done);
                self.path.push(note);
                self.done += 1;
            }
            Deed::Undo => self.done -= 1,
            Deed::Redo => self.done += 1,
        }
    }

    /// A deed that is possible now.
    fn next(&self, random: &mut ChaCha8Rng, fresh: &mut usize) -> Deed {
        match random.random_range(0..10) {
            0 | 1 if self.done > 0 => Deed::Undo,
            2 if self.done < self.path.len() => Deed::Redo,
            _ => {
                *fresh += 1;
                Deed::Edit(*fresh)
            }
        }
    }
}

fn line_of(deed: Deed) -> String {
    match deed {
        Deed::Edit(n) => format!("--base 1,{n},2 --blossom 1,-{n},2.5 --note {n}\n"),
        Deed::Undo => "--undo\n".into(),
        Deed::Redo => "--redo\n".into(),
    }
}

/// Runs the program with these edits on its standard input, and kills it after `patience`. Returns the
/// numbers that it said were saved.
fn killed_while_annotating(cloud: &Path, deeds: &[Deed], patience: Duration) -> Vec<u64> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_axiscope"))
        .args(["annotate", "--annotator", "Ada", "--script", "-"])
        .arg(cloud)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let lines: String = deeds.iter().copied().map(line_of).collect();
    let mut input = child.stdin.take().unwrap();
    // All at once: a pipe holds as much. The program must not see the end before it is killed.
    input.write_all(lines.as_bytes()).unwrap();
    std::thread::sleep(patience);
    child.kill().unwrap();
    child.wait().unwrap();
    drop(input);
    let shown = BufReader::new(child.stdout.take().unwrap()).split(b'\n');
    let number = |line: Vec<u8>| {
        let line = String::from_utf8(line).unwrap();
        line.strip_prefix("saved ")
            .unwrap_or_else(|| panic!("{line}"))
            .parse::<u64>()
            .unwrap()
    };
    shown.map(|line| number(line.unwrap())).collect()
}

#[test]
fn two_hundred_kills_lose_nothing_that_was_shown_as_saved() {
    let folder = TempDir::new().unwrap();
    let cloud = folder.path().join("fruit.ply");
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                property float z\nend_header\n0 0 50\n8 0 50\n0 8 51\n3 3 49\n";
    std::fs::write(&cloud, text).unwrap();
    let author = Author::annotator("Ada").unwrap();
    let axis_file = author.axis_path(&cloud, 1);
    let open = || {
        let id = CloudId {
            file: "fruit.ply".into(),
            sha256: sha256_hex(text.as_bytes()),
        };
        let files = Box::new(DiskFiles::default());
        Store::open(files, &cloud, id, Unit::Centimeter, author.clone()).unwrap()
    };
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let (mut known, mut fresh, mut broken_off) = (Vec::<Deed>::new(), 0, 0);
    for round in 0..kills() {
        let mut model = Model::after(&known);
        let mut deeds = Vec::new();
        for _ in 0..LINES {
            let deed = model.next(&mut random, &mut fresh);
            model.apply(deed);
            deeds.push(deed);
        }
        let patience = Duration::from_micros(random.random_range(0..20_000));
        let shown = killed_while_annotating(&cloud, &deeds, patience);
        let expected: Vec<u64> = (known.len() as u64 + 1..).take(shown.len()).collect();
        assert_eq!(shown, expected, "round {round}");

        // Whatever moment it was, the axis file is whole.
        if let Ok(bytes) = std::fs::read(&axis_file) {
            Annotation::from_json(&bytes).unwrap_or_else(|error| panic!("round {round}: {error}"));
        }
        let (store, writable) = open();
        writable.unwrap();
        let saved = usize::try_from(store.operations()).unwrap();
        let least = known.len() + shown.len();
        assert!(
            (least..=known.len() + LINES).contains(&saved),
            "round {round}: {least} shown as saved, {saved} there"
        );
        broken_off += usize::from(saved > known.len());
        // An edit may be on the disk and not yet shown; one at most.
        assert!(saved - least <= 1, "round {round}: {saved} there, {least} shown");
        known.extend(&deeds[..saved - known.len()]);

        let model = Model::after(&known);
        let history = store.history();
        let notes: Vec<usize> = history
            .steps()
            .iter()
            .map(|state| state.judgment.note.parse().unwrap())
            .collect();
        assert_eq!(
            (&notes, history.undo_steps()),
            (&model.path, model.done),
            "round {round}"
        );
        assert!(store.is_saved());
        let in_file = std::fs::read(&axis_file)
            .ok()
            .map(|bytes| Annotation::from_json(&bytes).unwrap());
        assert_eq!(in_file.as_ref(), store.current(), "round {round}");
        if let Some(ends) = store.current().and_then(Annotation::ends) {
            let n = model.path[model.done - 1] as f64;
            assert_eq!(ends.peduncle_base().to_array(), [1.0, n, 2.0]);
        }
        fresh = known
            .iter()
            .filter(|deed| matches!(deed, Deed::Edit(_)))
            .count()
            .max(fresh);
    }
    // Else the kills came before the program had begun.
    assert!(broken_off > kills() / 4, "only {broken_off} runs got to work");
    let copies = std::fs::read_dir(folder.path()).unwrap().count();
    assert!(
        copies <= 4,
        "cloud, axis, journal and one half-written file: {copies}"
    );
}
