//! What is fed with hostile bytes: each function reads them as one kind of input and asserts what must hold of any.
//!
//! The test program `campaign` calls them with mutated files for a while, and the fuzzers in `fuzz/` with their own.
#![allow(dead_code, reason = "each fuzzer uses one of them")]

use std::path::Path;

use axiscope::annotate::exchange::{ImportedRow, read_lines};
use axiscope::annotate::{Annotation, Author, CloudId, Files, Store, read_journal};
use axiscope::fruit::parse_cloud;
use axiscope::geometry::{Cloud, Unit};
use axiscope::method::{CenterMethod, Params, Preset, RandomSearch, analyze};
use axiscope::ply::{Encoding, Precision, WriteOptions, read, write};
use axiscope::simulate::Truth;

/// The hash that annotations and journals of the campaign name.
pub const SHA256: &str = "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";

fn assert_one_line(error: &dyn std::fmt::Display) {
    let text = error.to_string();
    assert!(text.lines().count() == 1, "{text:?}");
}

/// The reader: what it reads can be written, and comes back as it was.
pub fn ply(bytes: &[u8]) {
    match read(bytes) {
        Ok(first) => {
            first.notes.iter().for_each(|note| assert_one_line(note));
            for encoding in Encoding::ALL {
                let options = WriteOptions {
                    encoding,
                    precision: Precision::Double,
                    ..WriteOptions::default()
                };
                let mut written = Vec::new();
                write(&mut written, &first.cloud, &options).expect("memory takes everything");
                let second = read(&written).expect("our own files are well-formed");
                assert_eq!(second.cloud, first.cloud);
            }
        }
        Err(error) => assert_one_line(&error),
    }
}

/// The analysis of a small cloud: an error of one line, or numbers that are all finite.
pub fn analysis(bytes: &[u8]) {
    // The first bytes choose the parameters, the others are a file.
    let Some((choice, file)) = bytes.split_first_chunk::<4>() else {
        return;
    };
    let Ok(file) = parse_cloud("cloud.ply", file) else {
        return;
    };
    let cloud = file.ply.cloud;
    if cloud.len() < 2000 {
        analyzed(&cloud, *choice);
    }
}

/// Analyzes a cloud under parameters that four bytes choose.
pub fn analyzed(cloud: &Cloud, choice: [u8; 4]) {
    let preset = [Preset::AsIntended, Preset::AsPrinted][usize::from(choice[0] & 1)];
    let unit = [Unit::Meter, Unit::Centimeter, Unit::Millimeter][usize::from(choice[1]) % 3];
    let mut params = Params::new(preset, unit);
    let search = RandomSearch {
        count: 50,
        ..RandomSearch::default()
    };
    params.u = 5 + usize::from(choice[2] & 1);
    params.center = if choice[0] & 2 == 0 {
        CenterMethod::of_preset(preset, search)
    } else {
        CenterMethod::Sphere
    };
    params.filters.keep_strays = choice[0] & 4 != 0;
    params.filters.voxel_cm = (choice[0] & 8 != 0).then(|| 10_f64.powi(i32::from(choice[3].cast_signed())));
    if choice[0] & 16 != 0 {
        params.filters.max_points = 100;
    }
    if choice[0] & 32 != 0 {
        params.tau_cm_per_rad = 10_f64.powi(i32::from(choice[3].cast_signed()));
    }
    match analyze(cloud, &params, &()) {
        Ok(found) => {
            assert!(found.center.is_finite(), "{:?}", found.center);
            assert!(found.surface.len() + found.strays.len() <= cloud.len() + found.strays.len());
            if let Ok(best) = found.best {
                assert!(best.score_cm.is_finite());
                assert!(found.ranking.scores_cm()[best.index].is_some());
            }
            if let Some(axis) = &found.axis {
                assert!((axis.direction.length() - 1.0).abs() < 1e-9, "{axis:?}");
            }
            found.warnings.iter().for_each(|warning| assert_one_line(warning));
        }
        Err(error) => assert_one_line(&error),
    }
}

/// An axis file: what is read is written as it was read.
pub fn axis_file(bytes: &[u8]) {
    match Annotation::from_json(bytes) {
        Ok(annotation) => {
            let again = Annotation::from_json(annotation.to_json().as_bytes());
            assert_eq!(again.expect("our own files are read"), annotation);
        }
        Err(error) => assert_one_line(&error),
    }
}

/// A journal: what is read of it can be continued, and nothing that it says is lost.
pub fn journal(bytes: &[u8]) {
    let author = Author::annotator("Ada").expect("a name");
    match read_journal(bytes, SHA256, &author) {
        Ok(journal) => {
            assert!(journal.length <= bytes.len() as u64);
            let kept = usize::try_from(journal.length).expect("small");
            let again = read_journal(&bytes[..kept], SHA256, &author).expect("its whole lines are a journal");
            assert_eq!(again.history.current(), journal.history.current());
            assert_eq!(again.operations, journal.operations);
        }
        Err(error) => assert_one_line(&error),
    }
}

/// A store that finds these bytes as its journal or its axis file: it opens, and its next edit is read again.
pub fn store(files: &(impl Files + Clone + 'static), cloud: &Path) {
    let open = || {
        let cloud_id = CloudId {
            file: "cloud.ply".into(),
            sha256: SHA256.into(),
        };
        let author = Author::annotator("Ada").expect("a name");
        Store::open(Box::new(files.clone()), cloud, cloud_id, Unit::Centimeter, author)
    };
    let (mut store, writable) = open().expect("a name is free");
    writable.expect("this disk takes everything");
    let judgment = axiscope::annotate::Judgment::cannot_tell();
    store.edit(judgment, "2026-03-01T12:00:00Z").expect("it is saved");
    let expected = store.current().cloned();
    drop(store);
    assert_eq!(open().expect("it opens").0.current(), expected.as_ref());
}

/// The other small files: markup lines of 3D Slicer, and the simulator's truth.
pub fn json(bytes: &[u8]) {
    if let Err(error) = read_lines(bytes) {
        assert_one_line(&error);
    }
    if let Ok(truth) = serde_json::from_slice::<Truth>(bytes) {
        let truth = truth.in_unit(Unit::Meter);
        assert!(serde_json::to_string(&truth).is_ok());
    }
}

/// A table of axes: every row has an axis that converts to any unit, or says why not.
pub fn table(bytes: &[u8]) {
    match axiscope::annotate::exchange::read_table(bytes) {
        Ok(rows) => {
            let convert = |row: &ImportedRow| row.in_unit(Unit::Millimeter).err();
            rows.iter()
                .filter_map(convert)
                .for_each(|error| assert_one_line(&error));
        }
        Err(error) => drop(error.to_string()),
    }
}

/// The settings that a picture carries: what is read is written as it was.
pub fn picture(bytes: &[u8]) {
    use axiscope::render::Image;
    use axiscope::view::{decode_picture, encode_picture, picture_settings};
    if let Ok(settings) = picture_settings(bytes) {
        let image = Image {
            width_px: 1,
            height_px: 1,
            rgba: vec![0; 4],
        };
        let written = encode_picture(&image, &settings).expect("settings of any text");
        assert_eq!(picture_settings(&written).expect("they are there"), settings);
    }
    if let Some(image) = decode_picture(bytes) {
        assert_eq!(
            image.rgba.len() as u64,
            4 * u64::from(image.width_px) * u64::from(image.height_px)
        );
    }
}
