//! Hostile input by the million: mutated files, clouds with strays, and clouds of any scale.
//!
//! Each test runs for `AXISCOPE_CAMPAIGN_SECONDS`, two by default, from the seed `AXISCOPE_CAMPAIGN_SEED`; `scripts/campaign`
//! sets them. A failure names the seed of its case, which repeats it alone.

#[path = "../helpers/mod.rs"]
mod helpers;
mod matrix;
mod mutation;
mod targets;

use std::path::Path;

use axiscope::annotate::{Annotation, Author, CloudId, Confidence, Ends, Judgment, Store};
use axiscope::geometry::Unit;
use axiscope::ply::{Encoding, WriteOptions, write};
use axiscope::simulate::EllipsoidSettings;
use glam::DVec3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use helpers::campaign::campaign;
use helpers::disk::Disk;
use mutation::mutated;

/// Small clouds in every encoding, and the files of other programs among the fixtures.
fn ply_files() -> Vec<Vec<u8>> {
    let settings = EllipsoidSettings {
        points: 60,
        ..EllipsoidSettings::default()
    };
    let cloud = settings.simulate().expect("a cloud").cloud;
    let cloud = cloud
        .with_labels((0..60).map(|i| i % 3).collect())
        .expect("one each");
    let encoded = |encoding| {
        let options = WriteOptions {
            encoding,
            unit: Some(Unit::Centimeter),
            ..WriteOptions::default()
        };
        let mut bytes = Vec::new();
        write(&mut bytes, &cloud, &options).expect("memory takes everything");
        bytes
    };
    let lists = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty list uchar int i\nproperty double x\nproperty double y\n\
        property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        2 1 2 0 0 0\n0 1 0 0\n1 9 0 1 1e-3\n3 0 1 2\n";
    Encoding::ALL
        .into_iter()
        .map(encoded)
        .chain([lists.to_vec()])
        .collect()
}

fn judgment(n: usize) -> Judgment {
    let ends = Ends::new(DVec3::new(0.0, -4.0, n as f64), DVec3::new(0.5, 4.0, 55.0)).expect("two ends");
    Judgment {
        confidence: Confidence::new(0.75),
        note: format!("a note, \"quoted\" {n}"),
        ..Judgment::by_hand(ends)
    }
}

/// A disk with the files of an annotator after some edits, an undo among them; the axis file, and the journal.
fn annotated() -> (Annotation, Vec<u8>) {
    let disk = Disk::default();
    let cloud = CloudId {
        file: "cloud.ply".into(),
        sha256: targets::SHA256.into(),
    };
    let author = Author::annotator("Ada").expect("a name");
    let (mut store, _) = Store::open(
        Box::new(disk.clone()),
        Path::new("cloud.ply"),
        cloud,
        Unit::Centimeter,
        author,
    )
    .expect("it opens");
    for n in 0..4 {
        store.edit(judgment(n), "2026-03-01T12:00:00Z").expect("saved");
    }
    store.undo("2026-03-01T12:00:01Z").expect("saved");
    let journal = disk.read_file(store.journal_path()).expect("a journal");
    (store.current().expect("an axis").clone(), journal)
}

#[test]
fn ply_reader() {
    let files = ply_files();
    campaign("ply_reader", |random| targets::ply(&mutated(&files, random)));
}

#[test]
fn analysis() {
    let files = ply_files();
    campaign("analysis", |random| {
        let mut bytes = random.random::<[u8; 4]>().to_vec();
        bytes.extend(mutated(&files, random));
        targets::analysis(&bytes);
    });
}

#[test]
fn axis_file() {
    let files = [annotated().0.to_json().into_bytes()];
    campaign("axis_file", |random| targets::axis_file(&mutated(&files, random)));
}

#[test]
fn journal() {
    let files = [annotated().1];
    campaign("journal", |random| targets::journal(&mutated(&files, random)));
}

#[test]
fn store_of_damaged_files() {
    let (axis, journal) = annotated();
    let (axes, journals) = ([axis.to_json().into_bytes()], [journal]);
    let author = Author::annotator("Ada").expect("a name");
    let cloud = Path::new("cloud.ply");
    campaign("store_of_damaged_files", |random| {
        let disk = Disk::default();
        let pick = |files: &[Vec<u8>; 1], random: &mut ChaCha8Rng| match random.random_range(0..3) {
            0 => None,
            1 => Some(files[0].clone()),
            _ => Some(mutated(files, random)),
        };
        if let Some(bytes) = pick(&axes, random) {
            disk.write_file(&author.axis_path(cloud, 1), &bytes);
        }
        if let Some(bytes) = pick(&journals, random) {
            disk.write_file(&author.journal_path(cloud, 1), &bytes);
        }
        targets::store(&disk, cloud);
    });
}

#[test]
fn small_json_files() {
    let line = axiscope::annotate::exchange::write_line(
        "a line",
        judgment(1).ends.as_ref().expect("ends"),
        Unit::Centimeter,
        axiscope::annotate::exchange::Placement::default(),
    );
    let truth = EllipsoidSettings::default().simulate().expect("a cloud").truth;
    let files = [
        line.into_bytes(),
        serde_json::to_vec_pretty(&truth).expect("JSON"),
    ];
    campaign("small_json_files", |random| {
        targets::json(&mutated(&files, random));
    });
}

#[test]
fn table_of_axes() {
    let axis = annotated().0;
    let table = axiscope::annotate::exchange::write_table([("cloud.ply", &axis), ("b.ply", &axis)]);
    let files = [table.expect("a table")];
    campaign("table_of_axes", |random| targets::table(&mutated(&files, random)));
}

#[test]
fn settings_in_a_picture() {
    let settings = axiscope::view::PictureSettings {
        version: "0.1.0".into(),
        arguments: ["render", "cloud.ply", "--u", "6"].map(String::from).into(),
        cloud: "cloud.ply".into(),
        sha256: targets::SHA256.into(),
    };
    let image = axiscope::render::Image {
        width_px: 7,
        height_px: 5,
        rgba: vec![9; 4 * 35],
    };
    let files = [axiscope::view::encode_picture(&image, &settings).expect("a picture")];
    campaign("settings_in_a_picture", |random| {
        let mut bytes = mutated(&files, random);
        // Most mutations end at the checksum of a chunk: half of them get the right one.
        if random.random() {
            mutation::repair_png(&mut bytes);
        }
        targets::picture(&bytes);
    });
}
