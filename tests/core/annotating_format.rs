//! What is written of an axis is what the schema says, any bytes can be read, and nudges keep their word.

use crate::helpers::disk::Disk;
use crate::helpers::store::{NOW, ada, axis_path, id, judgment, open};
use axiscope::annotate::{Annotation, Ends, EndsError, Judgment, Pivot, read_journal};
use axiscope::geometry::Unit;
use glam::DVec3;
use proptest::prelude::*;

#[test]
fn what_is_written_is_what_the_schema_says() {
    let schema: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string("assets/axis.schema.json").unwrap()).unwrap();
    let disk = Disk::default();
    let mut store = open(&disk);
    for judgment in [judgment(1.0), Judgment::cannot_tell()] {
        store.edit(judgment.clone(), NOW).unwrap();
        let bytes = disk.read_file(&axis_path(1)).unwrap();
        let read = Annotation::from_json(&bytes).unwrap();
        assert_eq!((&read.judgment.ends, read.unit), (&judgment.ends, Unit::Meter));
        let written: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
        let fields = written.as_object().unwrap();
        let properties = schema["properties"].as_object().unwrap();
        assert!(
            fields.keys().eq(properties.keys()),
            "the same fields, none left out"
        );
        let required: Vec<_> = schema["required"]
            .as_array()
            .unwrap()
            .iter()
            .map(|r| r.as_str().unwrap())
            .collect();
        assert!(fields.keys().all(|field| required.contains(&field.as_str())));
        for (name, property) in properties {
            let kind = match &written[name] {
                serde_json::Value::Null => "null",
                serde_json::Value::Bool(_) => "boolean",
                serde_json::Value::Number(_) => "number",
                serde_json::Value::String(_) => "string",
                serde_json::Value::Array(_) => "array",
                serde_json::Value::Object(_) => "object",
            };
            let allowed = property["type"].to_string();
            assert!(allowed.contains(kind), "{name} is {kind}, not {allowed}");
            if let Some(values) = property["enum"].as_array() {
                assert!(values.contains(&written[name]), "{name}");
            }
        }
        assert_eq!(written["schema"], schema["properties"]["schema"]["const"]);
        // Leaving any field out makes it another file.
        for name in fields.keys() {
            let mut fields = fields.clone();
            fields.remove(name);
            let text = serde_json::to_vec(&fields).unwrap();
            assert!(Annotation::from_json(&text).is_err(), "{name}");
        }
    }
}

proptest! {
    #[test]
    fn any_bytes_are_read_without_harm(mut bytes in prop::collection::vec(any::<u8>(), 0..200), cut in 0_usize..2000) {
        let _ = Annotation::from_json(&bytes);
        let _ = read_journal(&bytes, &id().sha256, &ada());
        // A journal cut anywhere, with anything but a line end behind it, keeps its whole lines.
        let disk = Disk::default();
        let mut store = open(&disk);
        for n in 1..=3 {
            store.edit(judgment(f64::from(n)), NOW).unwrap();
        }
        let mut journal = disk.read_file(store.journal_path()).unwrap();
        journal.truncate(cut);
        let whole = journal.split_inclusive(|&b| b == b'\n').filter(|line| line.ends_with(b"\n")).count();
        if whole > 0 {
            bytes.retain(|&b| b != b'\n');
            journal.extend(bytes);
            let read = read_journal(&journal, &id().sha256, &ada()).unwrap();
            prop_assert_eq!(read.operations, whole as u64 - 1);
            prop_assert_eq!(read.history.undo_steps(), whole - 1);
        }
    }

    #[test]
    fn nudges_keep_what_they_promise(
        base in prop::array::uniform3(-50.0..50.0_f64),
        other in prop::array::uniform3(60.0..90.0_f64),
        ray in prop::array::uniform3(-1.0..1.0_f64),
        degrees in -170.0..170.0_f64,
    ) {
        let ends = Ends::new(base.into(), other.into()).unwrap();
        let ray = DVec3::from(ray);
        prop_assume!(ray.normalize_or_zero().cross(ends.direction()).length() > 0.01);
        let [lean, picture] = ends.across(ray);
        for about in [lean, picture] {
            prop_assert!((about.length() - 1.0).abs() < 1e-9 && about.dot(ends.direction()).abs() < 1e-9);
            for pivot in [Pivot::Middle, Pivot::PeduncleBase, Pivot::BlossomEnd] {
                let turned = ends.turned(about, degrees, pivot).unwrap();
                prop_assert!((turned.angle_to_deg(&ends) - degrees.abs()).abs() < 1e-6);
                prop_assert!((turned.length() - ends.length()).abs() < 1e-9 * ends.length());
                let still = match pivot {
                    Pivot::Middle => turned.middle().distance(ends.middle()),
                    Pivot::PeduncleBase => turned.peduncle_base().distance(ends.peduncle_base()),
                    Pivot::BlossomEnd => turned.blossom_end().distance(ends.blossom_end()),
                };
                prop_assert!(still < 1e-9 * 100.0);
                let back = turned.turned(about, -degrees, pivot).unwrap();
                prop_assert!(back.peduncle_base().distance(ends.peduncle_base()) < 1e-7);
            }
        }
        prop_assert!(lean.dot(ray).abs() < 1e-9, "leaning is about a direction across the view");
        prop_assert!(lean.dot(picture).abs() < 1e-9);
        let longer = ends.lengthened(2.0, Pivot::PeduncleBase).unwrap();
        prop_assert!(longer.peduncle_base() == ends.peduncle_base());
        prop_assert!((longer.length() - ends.length() - 2.0).abs() < 1e-9);
        prop_assert!(ends.flipped().angle_to_deg(&ends) > 179.999);
    }
}

#[test]
fn what_is_no_axis_is_refused() {
    let p = DVec3::new(3.0, 4.0, 5.0);
    assert_eq!(Ends::new(p, p), Err(EndsError::OnePoint));
    assert_eq!(Ends::new(p, p + DVec3::X * f64::NAN), Err(EndsError::NotFinite));
    assert_eq!(Ends::new(p, DVec3::MAX), Err(EndsError::NotFinite));
    let ends = Ends::new(p, p + DVec3::Y).unwrap();
    assert_eq!(ends.lengthened(-1.0, Pivot::Middle), Err(EndsError::NoLengthLeft));
    assert_eq!(
        ends.turned(DVec3::ZERO, 1.0, Pivot::Middle),
        Err(EndsError::NoDirection)
    );
    assert_eq!(Ends::spanning(&[], p, DVec3::X), Err(EndsError::OnePoint));
    let spanning = Ends::spanning(&[p, p + 2.0 * DVec3::Y, p + DVec3::X], p, DVec3::NEG_Y).unwrap();
    assert_eq!(
        (spanning.peduncle_base(), spanning.blossom_end()),
        (p, p + 2.0 * DVec3::Y)
    );
    assert!(Judgment::cannot_tell().ends.is_none());
}
