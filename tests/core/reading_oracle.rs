//! Reading PLY: an independent reader finds the same in the same file.

use axiscope::ply::read;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

/// A value in ASCII and in both binary encodings.
#[derive(Debug, Clone)]
struct Value {
    text: String,
    little_endian: Vec<u8>,
}

/// A scalar type with a strategy for its values.
fn typed(kind: &'static str) -> BoxedStrategy<Value> {
    macro_rules! value {
        ($strategy:expr) => {
            $strategy
                .prop_map(|value| Value {
                    text: value.to_string(),
                    little_endian: value.to_le_bytes().to_vec(),
                })
                .boxed()
        };
    }
    match kind {
        "char" => value!(any::<i8>()),
        "uchar" => value!(any::<u8>()),
        "short" => value!(any::<i16>()),
        "ushort" => value!(any::<u16>()),
        "int" => value!(any::<i32>()),
        "uint" => value!(any::<u32>()),
        "float" => value!(-1e6f32..1e6),
        _ => value!(-1e6f64..1e6),
    }
}

const KINDS: [&str; 8] = [
    "char", "uchar", "short", "ushort", "int", "uint", "float", "double",
];

/// Some columns: x, y, z and others between them, each of its type, and rows of values.
fn table() -> impl Strategy<Value = (Vec<(String, &'static str)>, Vec<Vec<Value>>)> {
    let names = ["x", "y", "z", "intensity", "label", "nx", "curvature"]
        .map(str::to_owned)
        .to_vec();
    (Just(names).prop_shuffle(), vec(select(&KINDS[..]), 7), 0..30usize).prop_flat_map(
        |(names, kinds, rows)| {
            let row: Vec<_> = kinds.iter().map(|&kind| typed(kind)).collect();
            let columns: Vec<_> = names.into_iter().zip(kinds).collect();
            (Just(columns), vec(row, rows))
        },
    )
}

fn as_f64(property: &Property) -> f64 {
    match *property {
        Property::Char(v) => v.into(),
        Property::UChar(v) => v.into(),
        Property::Short(v) => v.into(),
        Property::UShort(v) => v.into(),
        Property::Int(v) => v.into(),
        Property::UInt(v) => v.into(),
        Property::Float(v) => v.into(),
        Property::Double(v) => v,
        _ => panic!("a list"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn another_reader_agrees((columns, rows) in table()) {
        for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
            let properties: Vec<String> = columns.iter().map(|(name, kind)| format!("property {kind} {name}\n")).collect();
            let properties = properties.concat();
            let count = rows.len();
            let header = format!("ply\nformat {encoding} 1.0\nelement vertex {count}\n{properties}end_header\n");
            let mut file = header.into_bytes();
            for row in &rows {
                if encoding == "ascii" {
                    let words: Vec<&str> = row.iter().map(|value| value.text.as_str()).collect();
                    file.extend(format!("{}\n", words.join(" ")).bytes());
                }
                for value in row.iter().filter(|_| encoding != "ascii") {
                    let mut bytes = value.little_endian.clone();
                    if encoding == "binary_big_endian" {
                        bytes.reverse();
                    }
                    file.extend(bytes);
                }
            }
            let ours = read(&file).unwrap().cloud;
            let theirs = Parser::<DefaultElement>::new().read_ply(&mut file.as_slice()).unwrap();
            let theirs = theirs.payload.get("vertex").map_or(&[][..], |rows| rows.as_slice());
            prop_assert_eq!(ours.len(), theirs.len());
            for (row, theirs) in theirs.iter().enumerate() {
                let value = |name: &str| as_f64(theirs.get(name).unwrap());
                // They round to the stated type where we keep the digits of ASCII.
                for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                    let ours = ours.positions()[row][axis];
                    let is_single = columns.iter().any(|(column, kind)| column == name && *kind == "float");
                    let ours = if is_single { f64::from(ours as f32) } else { ours };
                    prop_assert_eq!(ours.to_bits(), value(name).to_bits());
                }
                // A cast saturates.
                let label = value("label").round();
                let fits = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&label);
                prop_assert_eq!(ours.labels().unwrap()[row], if fits { label as i32 } else { -1 });
            }
        }
    }
}
