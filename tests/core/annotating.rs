//! An annotator's store: undo without end, disks that fail, and files that must not be touched.

use std::io::ErrorKind;

use crate::helpers::disk::Disk;
use crate::helpers::store::{NOW, ada, axis_path, cloud, id, judgment, open};
use axiscope::annotate::DiskFiles;
use axiscope::annotate::{Annotation, Author, Confidence, Ends, Judgment, Method, Notice, Store, StoreError};
use axiscope::fruit::{AxisFiles, read_annotations};
use axiscope::geometry::Unit;

fn length(annotation: &Annotation) -> f64 {
    annotation.ends().map_or(0.0, Ends::length)
}

#[test]
fn undo_and_redo_survive_a_restart() {
    let disk = Disk::default();
    let mut store = open(&disk);
    assert!(store.current().is_none() && !store.undo(NOW).unwrap());
    assert!(disk.paths().is_empty(), "whoever said nothing leaves no file");
    for n in 1..=500 {
        store.edit(judgment(f64::from(n)), NOW).unwrap();
    }
    for _ in 0..300 {
        assert!(store.undo(NOW).unwrap());
    }
    assert!(store.redo(NOW).unwrap());
    drop(store);

    let mut store = open(&disk);
    assert!(store.notices().is_empty() && store.is_saved());
    assert_eq!(
        (store.history().undo_steps(), store.history().redo_steps()),
        (201, 299)
    );
    assert_eq!(length(store.current().unwrap()), 201.0);
    assert_eq!(
        Annotation::from_json(&disk.read_file(&axis_path(1)).unwrap()).as_ref(),
        Ok(store.current().unwrap())
    );
    while store.undo(NOW).unwrap() {}
    assert!(store.current().is_none() && disk.read_file(&axis_path(1)).is_none());
    for n in 1..=500 {
        assert!(store.redo(NOW).unwrap());
        assert!((length(store.current().unwrap()) - f64::from(n)).abs() < 1e-9);
    }
    assert!(!store.redo(NOW).unwrap());
    store.undo(NOW).unwrap();
    store.edit(judgment(1000.0), NOW).unwrap();
    assert_eq!(
        store.history().redo_steps(),
        0,
        "an edit ends what could be done again"
    );
}

#[test]
fn blindness_and_a_known_start_are_recorded_for_good() {
    let disk = Disk::default();
    let mut store = open(&disk);
    let blind = |method| Judgment {
        blind: true,
        method,
        ..judgment(1.0)
    };
    let mut seeing = open(&Disk::default());
    seeing.edit(judgment(1.0), NOW).unwrap();
    assert!(!seeing.current().unwrap().judgment.blind);
    store.edit(blind(Method::ByHand), "2026-03-01T12:00:00Z").unwrap();
    assert!(store.current().unwrap().judgment.blind);
    store
        .edit(blind(Method::FromComputed), "2026-03-02T12:00:00Z")
        .unwrap();
    assert!(
        !store.current().unwrap().judgment.blind,
        "the computed axis was seen"
    );
    store.undo(NOW).unwrap();
    assert!(store.current().unwrap().judgment.blind, "as it was then");
    store.edit(blind(Method::ByHand), "2026-03-03T12:00:00Z").unwrap();
    let last = store.current().unwrap();
    assert!(!last.judgment.blind, "what was seen is not unseen");
    assert_eq!(
        (last.created.as_str(), last.modified.as_str()),
        ("2026-03-01T12:00:00Z", "2026-03-03T12:00:00Z")
    );
}

/// Every operation on the disk fails once, in every way, at every place of a session; afterwards the disk
/// is well again, and nothing is missing.
#[test]
fn a_disk_that_fails_is_told_at_once_and_loses_nothing() {
    for kind in [
        ErrorKind::StorageFull,
        ErrorKind::PermissionDenied,
        ErrorKind::ReadOnlyFilesystem,
    ] {
        for failing in 0..14 {
            let disk = Disk::default();
            let mut store = open(&disk);
            disk.fail_after(failing, kind);
            let mut was_told = false;
            for n in 1..=5 {
                let done = store.edit(judgment(f64::from(n)), NOW);
                assert_eq!(done.is_ok(), store.is_saved(), "{kind} after {failing}");
                assert_eq!(
                    length(store.current().unwrap()).round(),
                    f64::from(n),
                    "it holds all the same"
                );
                if let Err(error) = done {
                    was_told = true;
                    assert!(error.to_string().starts_with("set/fruit.Ada.axis."), "{error}");
                }
            }
            assert!(was_told || failing >= 10);
            disk.heal();
            store.save().unwrap();
            drop(store);
            let store = open(&disk);
            assert_eq!(store.history().undo_steps(), 5, "{kind} after {failing}");
            assert_eq!(length(store.current().unwrap()).round(), 5.0);
        }
    }
}

/// The program dies after any number of operations; each leaves any part of what it was writing.
#[test]
fn dying_between_any_two_operations_keeps_what_was_saved() {
    for steps in 0..24 {
        for part in [0.0, 0.3, 0.99, 1.0] {
            let disk = Disk::default();
            disk.die_after(steps, part);
            let mut saved = 0;
            if let Ok((mut store, _)) = Store::open(Box::new(disk.clone()), cloud(), id(), Unit::Meter, ada())
            {
                for n in 1..=8_u32 {
                    match store.edit(judgment(f64::from(n)), NOW) {
                        Ok(()) => saved = n,
                        Err(_) => break,
                    }
                }
            }
            disk.heal();
            let mut store = open(&disk);
            let there = store.current().map_or(0.0, length).round();
            assert!(
                there == f64::from(saved) || there == f64::from(saved) + 1.0,
                "after {steps} operations: {saved} saved, {there} there"
            );
            assert_eq!(store.history().undo_steps(), there as usize);
            // And it can go on.
            store.edit(judgment(99.0), NOW).unwrap();
            drop(store);
            assert_eq!(length(open(&disk).current().unwrap()).round(), 99.0);
            assert_eq!(open(&disk).axis_path(), axis_path(1));
        }
    }
}

#[test]
fn what_was_out_of_reach_does_not_come_back_as_somebody_else_s() {
    let disk = Disk::default();
    let mut store = open(&disk);
    store.edit(judgment(1.0), NOW).unwrap();
    store.edit(judgment(2.0), NOW).unwrap();
    let old = disk.read_file(&axis_path(1)).unwrap();
    store.undo(NOW).unwrap();
    store.edit(judgment(3.0), NOW).unwrap();
    drop(store);
    // As if the axis file could not be replaced since.
    disk.write_file(&axis_path(1), &old);
    let store = open(&disk);
    assert_eq!(length(store.current().unwrap()), 3.0);
    assert_eq!(store.notices(), [Notice::Restored(axis_path(1))]);
}

/// Files in the place of the axis file that must stay as they are, and a word of the reason.
fn untouchable() -> Vec<(&'static str, Vec<u8>)> {
    let disk = Disk::default();
    let mut store = open(&disk);
    store.edit(judgment(1.0), NOW).unwrap();
    let good = String::from_utf8(disk.read_file(&axis_path(1)).unwrap()).unwrap();
    let with = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        good.replace(from, to).into_bytes()
    };
    vec![
        ("EOF", good.as_bytes()[..good.len() / 2].to_vec()),
        ("EOF", Vec::new()),
        ("no axis file", b"\x00\xff\x00".to_vec()),
        ("version 2", with("axiscope.axis/1", "axiscope.axis/2")),
        (
            "version 40",
            br#"{"schema": "axiscope.axis/40", "ends": 3}"#.to_vec(),
        ),
        ("schema", with("axiscope.axis/1", "other.axis/1")),
        ("another cloud", with(&"ab".repeat(32), &"cd".repeat(32))),
        ("Bob's", with("\"annotator\": \"Ada\"", "\"annotator\": \"Bob\"")),
        ("unknown field", with("\"blind\"", "\"mood\": 1, \"blind\"")),
        ("direction", with("-1.0", "1.0")),
        ("confidence", with("0.7", "1.7")),
        ("time", with(NOW, "yesterday")),
        ("finite", with("0.5", "1e999")),
    ]
}

#[test]
fn a_file_that_is_not_understood_or_another_s_is_never_touched() {
    for (reason, content) in untouchable() {
        let disk = Disk::default();
        disk.write_file(&axis_path(1), &content);
        let mut store = open(&disk);
        assert!(store.current().is_none(), "{reason}");
        store.edit(judgment(5.0), NOW).unwrap();
        assert_eq!(disk.read_file(&axis_path(1)), Some(content), "{reason}");
        assert_eq!(store.axis_path(), axis_path(2));
        let said: Vec<String> = store.notices().iter().map(ToString::to_string).collect();
        let has = |word: &str| said.iter().any(|notice| notice.contains(word));
        assert!(
            has("fruit.Ada.axis.json is left as it is") && has("fruit.Ada.2.axis.json"),
            "{said:?}"
        );
        assert!(reason == "finite" || has(reason), "{reason}: {said:?}");
        drop(store);
        // And the copy is found again, with its history.
        let store = open(&disk);
        assert_eq!(
            (store.axis_path(), store.history().undo_steps()),
            (axis_path(2).as_path(), 1)
        );
        assert_eq!(length(store.current().unwrap()), 5.0);
    }
}

#[test]
fn a_file_that_another_program_puts_there_meanwhile_is_not_touched_either() {
    for (_, content) in untouchable() {
        let disk = Disk::default();
        let mut store = open(&disk);
        store.edit(judgment(1.0), NOW).unwrap();
        disk.write_file(&axis_path(1), &content);
        store.edit(judgment(2.0), NOW).unwrap();
        assert_eq!(disk.read_file(&axis_path(1)), Some(content));
        assert!(matches!(store.notices(), [Notice::NotOverwritten { .. }]));
        assert_eq!(
            length(&Annotation::from_json(&disk.read_file(&axis_path(2)).unwrap()).unwrap()),
            2.0
        );
        assert_eq!(store.history().undo_steps(), 2);
    }
    // One of ours that was changed becomes the newest edit, so that nobody's work is lost.
    let disk = Disk::default();
    let mut store = open(&disk);
    store.edit(judgment(1.0), NOW).unwrap();
    let text = String::from_utf8(disk.read_file(&axis_path(1)).unwrap()).unwrap();
    disk.write_file(&axis_path(1), text.replace("0.7", "0.1").as_bytes());
    store.edit(judgment(2.0), NOW).unwrap();
    assert_eq!(store.history().undo_steps(), 3);
    store.undo(NOW).unwrap();
    assert_eq!(store.current().unwrap().judgment.confidence, Confidence::new(0.1));
}

#[test]
fn a_damaged_journal_is_left_alone_and_the_axis_kept() {
    let disk = Disk::default();
    let mut store = open(&disk);
    for n in 1..=3 {
        store.edit(judgment(f64::from(n)), NOW).unwrap();
    }
    drop(store);
    let journal = ada().journal_path(cloud(), 1);
    let bytes = disk.read_file(&journal).unwrap();
    let lines = bytes.split_inclusive(|&b| b == b'\n').collect::<Vec<_>>();
    // A letter changed in any line but the last, which is told from one cut short by its end.
    for line in 0..lines.len() {
        let mut damaged = bytes.clone();
        let place = lines[..line].iter().map(|l| l.len()).sum::<usize>() + lines[line].len() / 2;
        damaged[place] ^= 4;
        let disk = Disk::default();
        disk.write_file(&journal, &damaged);
        disk.write_file(&axis_path(1), Disk::content_of(&open_with(&bytes)).as_slice());
        let mut store = open(&disk);
        assert_eq!(length(store.current().unwrap()), 3.0, "line {line}");
        store.edit(judgment(4.0), NOW).unwrap();
        assert_eq!(disk.read_file(&journal), Some(damaged), "line {line}");
        assert_eq!(store.journal_path(), ada().journal_path(cloud(), 2));
        assert_eq!(store.history().undo_steps(), 2);
    }
}

/// The store that this journal gives.
fn open_with(journal: &[u8]) -> Store {
    let disk = Disk::default();
    disk.write_file(&ada().journal_path(cloud(), 1), journal);
    open(&disk)
}

#[test]
fn two_programs_do_not_annotate_at_once_under_one_name() {
    let folder = tempfile::TempDir::new().unwrap();
    let cloud = folder.path().join("fruit.ply");
    let open = |author: Author| {
        Store::open(Box::new(DiskFiles::default()), &cloud, id(), Unit::Meter, author)
            .map(|(store, writable)| (store, writable.unwrap()).0)
    };
    let mut one = open(ada()).unwrap();
    let mut other = open(ada()).unwrap();
    one.edit(judgment(1.0), NOW).unwrap();
    assert!(matches!(
        other.edit(judgment(2.0), NOW),
        Err(StoreError::InUse { .. })
    ));
    assert!(matches!(open(ada()), Err(StoreError::InUse { .. })));
    open(Author::annotator("Bob").unwrap())
        .unwrap()
        .edit(judgment(3.0), NOW)
        .unwrap();
    drop((one, other));
    assert_eq!(length(open(ada()).unwrap().current().unwrap()), 1.0);

    let files = AxisFiles::default().of(&cloud);
    let (annotations, warnings) = read_annotations(&files, &id().sha256);
    assert_eq!(
        annotations
            .iter()
            .map(|a| a.annotator.as_str())
            .collect::<Vec<_>>(),
        ["Ada", "Bob"]
    );
    assert!(warnings.is_empty());
    let (none, warnings) = read_annotations(&files, "another");
    assert!(none.is_empty() && warnings.len() == 2, "{warnings:?}");
}

#[test]
fn a_folder_that_is_gone_is_told_when_it_is_opened() {
    let folder = tempfile::TempDir::new().unwrap();
    let cloud = folder.path().join("gone/fruit.ply");
    let (mut store, writable) =
        Store::open(Box::new(DiskFiles::default()), &cloud, id(), Unit::Meter, ada()).unwrap();
    assert!(writable.is_err());
    assert!(store.edit(judgment(1.0), NOW).is_err() && !store.is_saved());
    std::fs::create_dir(folder.path().join("gone")).unwrap();
    store.save().unwrap();
    assert!(store.is_saved() && store.axis_path().is_file());
    let names: Vec<_> = std::fs::read_dir(folder.path().join("gone")).unwrap().collect();
    assert_eq!(names.len(), 2, "nothing is left behind: {names:?}");
}
