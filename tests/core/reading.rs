//! Reading PLY: what properties mean and how their values are understood.

use axiscope::geometry::Cloud;
use axiscope::ply::{Note, read};
use glam::{DVec3, Vec3};

use crate::helpers::ply_text::{XYZ, ascii, vertex};

/// A value of each type, in little-endian and big-endian bytes, with the number that it is.
fn typed_values() -> Vec<(&'static str, Vec<u8>, Vec<u8>, f64)> {
    macro_rules! values {
        ($($name:literal $value:literal $number:expr;)*) => {
            vec![$(($name, $value.to_le_bytes().to_vec(), $value.to_be_bytes().to_vec(), $number),)*]
        };
    }
    let mut values = values! {
        "char" -7i8 -7.0;
        "int8" -8i8 -8.0;
        "uchar" 200u8 200.0;
        "uint8" 201u8 201.0;
        "short" -300i16 -300.0;
        "int16" -301i16 -301.0;
        "ushort" 60000u16 60000.0;
        "uint16" 60001u16 60001.0;
        "int" -70000i32 -70000.0;
        "int32" -70001i32 -70001.0;
        "uint" 4_000_000_000u32 4e9;
        "uint32" 4_000_000_001u32 4_000_000_001.0;
        "int64" -5_000_000_000i64 -5e9;
        "uint64" 5_000_000_000u64 5e9;
        "float" 0.1f32 f64::from(0.1f32);
        "float32" -0.2f32 f64::from(-0.2f32);
        "double" 0.1f64 0.1;
        "float64" -1e300f64 -1e300;
    };
    // 1.5 as a half float.
    values.push((
        "float16",
        0x3e00u16.to_le_bytes().to_vec(),
        0x3e00u16.to_be_bytes().to_vec(),
        1.5,
    ));
    values
}

#[test]
fn every_type_is_read_for_every_coordinate() {
    for (x_type, x_le, x_be, x) in typed_values() {
        for (y_type, y_le, y_be, y) in typed_values() {
            let types = format!("{x_type} x, {y_type} y, {x_type} z");
            for (format, x_bytes, y_bytes) in [
                ("binary_little_endian", &x_le, &y_le),
                ("binary_big_endian", &x_be, &y_be),
            ] {
                let header = format!("ply\nformat {format} 1.0\n{}\nend_header\n", vertex(2, &types));
                let row = [x_bytes.as_slice(), y_bytes, x_bytes].concat();
                let file = [header.as_bytes(), &row, &row].concat();
                assert_eq!(
                    read(&file).unwrap().cloud.positions(),
                    [DVec3::new(x, y, x); 2],
                    "{types}"
                );
            }
            let row = format!("{x} {y} {x}\n");
            let cloud = ascii(&vertex(1, &types), &row).cloud;
            assert_eq!(cloud.positions(), [DVec3::new(x, y, x)], "{types}");
        }
    }
}

#[test]
fn every_type_is_read_for_every_other_column() {
    let names = ["nx", "ny", "nz", "red", "green", "blue", "alpha", "label"];
    for (kind, little_endian, big_endian, value) in typed_values() {
        let others: Vec<String> = names.iter().map(|name| format!("{kind} {name}")).collect();
        let elements = vertex(1, &format!("{XYZ}, {}", others.join(", ")));
        for (format, bytes) in [
            ("binary_little_endian", &little_endian),
            ("binary_big_endian", &big_endian),
        ] {
            let header = format!("ply\nformat {format} 1.0\n{elements}\nend_header\n");
            let mut file = [header.as_bytes(), &[0; 12]].concat();
            for _ in names {
                file.extend(bytes);
            }
            let cloud = read(&file).unwrap().cloud;
            // Beyond single precision a normal is infinite, and so there is none.
            let normal = if value.abs() > 1e40 { 0.0 } else { value as f32 };
            assert_eq!(cloud.normals(), Some(&[Vec3::splat(normal)][..]), "{kind}");
            let in_range = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value);
            let label = if in_range { value.round() as i32 } else { -1 };
            assert_eq!(cloud.labels(), Some(&[label][..]), "{kind}");
            let color = match kind {
                "float" | "float64" | "double" | "float32" => (value * 255.0).round() as u8,
                "ushort" | "uint16" => (value / 257.0).round() as u8,
                _ => value.round() as u8,
            };
            if value < 1e6 {
                assert_eq!(cloud.colors(), Some(&[[color; 4]][..]), "{kind}");
            }
        }
    }
}

#[test]
fn normals_and_colors_go_under_several_names() {
    for names in ["nx ny nz", "normal_x normal_y normal_z", "NX NY NZ"] {
        let [x, y, z] = names.split(' ').collect::<Vec<_>>()[..] else {
            unreachable!()
        };
        let properties = format!("{XYZ}, float {z}, float {y}, float {x}");
        let cloud = ascii(&vertex(1, &properties), "0 0 0 3 2 1").cloud;
        assert_eq!(cloud.normals(), Some(&[Vec3::new(1.0, 2.0, 3.0)][..]), "{names}");
    }
    for names in [
        "red green blue alpha",
        "diffuse_red diffuse_green diffuse_blue diffuse_alpha",
        "r g b a",
    ] {
        let [red, green, blue, alpha] = names.split(' ').collect::<Vec<_>>()[..] else {
            unreachable!()
        };
        let properties = format!("{XYZ}, uchar {alpha}, uchar {blue}, uchar {green}, uchar {red}");
        let cloud = ascii(&vertex(1, &properties), "0 0 0 4 3 2 1").cloud;
        assert_eq!(cloud.colors(), Some(&[[1, 2, 3, 4]][..]), "{names}");
        let properties = format!("{XYZ}, uchar {red}, uchar {green}, uchar {blue}");
        let cloud = ascii(&vertex(1, &properties), "0 0 0 1 2 3").cloud;
        assert_eq!(cloud.colors(), Some(&[[1, 2, 3, 255]][..]), "{names}");
    }
    let names = [
        "label",
        "class",
        "classification",
        "scalar_label",
        "scalar_Label",
        "scalar_class",
        "scalar_Classification",
    ];
    for name in names {
        let cloud = ascii(&vertex(1, &format!("float {name}, {XYZ}")), "7 1 2 3").cloud;
        assert_eq!(cloud.labels(), Some(&[7][..]), "{name}");
        assert_eq!(cloud.positions(), [DVec3::new(1.0, 2.0, 3.0)]);
    }
}

#[test]
fn an_exact_name_goes_before_one_in_another_case() {
    let cloud = ascii(
        &vertex(1, "float X, float Y, float Z, float x, float y, float z"),
        "1 2 3 4 5 6",
    )
    .cloud;
    assert_eq!(cloud.positions(), [DVec3::new(4.0, 5.0, 6.0)]);
    let cloud = ascii(&vertex(1, "float X, float Y, float Z"), "1 2 3").cloud;
    assert_eq!(cloud.positions(), [DVec3::new(1.0, 2.0, 3.0)]);
}

#[test]
fn an_incomplete_column_is_ignored_and_told() {
    let read = ascii(
        &vertex(
            1,
            &format!("{XYZ}, float nx, float ny, uchar red, list uchar int green, uchar blue"),
        ),
        "0 0 0 1 2 3 1 9 4",
    );
    assert_eq!((read.cloud.normals(), read.cloud.colors()), (None, None));
    let told = [
        Note::Incomplete {
            column: "normals",
            missing: "nz",
        },
        Note::Incomplete {
            column: "colors",
            missing: "green",
        },
    ];
    assert_eq!(read.notes, told);
    // A lone `r` is a radius rather than a color.
    assert_eq!(ascii(&vertex(1, &format!("{XYZ}, float r")), "0 0 0 1").notes, []);
}

#[test]
fn colors_are_brought_to_bytes_from_the_scale_they_are_on() {
    let colors = |kind: &str, body: &str| {
        let rows = body.lines().count();
        let properties = format!("{XYZ}, {kind} red, {kind} green, {kind} blue, {kind} alpha");
        let body: Vec<String> = body.lines().map(|row| format!("0 0 0 {row}")).collect();
        ascii(&vertex(rows, &properties), &body.join("\n"))
            .cloud
            .colors()
            .unwrap()
            .to_vec()
    };
    assert_eq!(
        colors("float", "0 0.5 1 1\n0.2 0.75 0 0"),
        [[0, 128, 255, 255], [51, 191, 0, 0]]
    );
    assert_eq!(
        colors("float", "0 0.5 255 1\n300 -4 nan 0"),
        [[0, 1, 255, 255], [255, 0, 0, 0]]
    );
    assert_eq!(colors("ushort", "0 257 65535 65535"), [[0, 1, 255, 255]]);
    assert_eq!(colors("ushort", "0 1 255 255"), [[0, 1, 255, 255]]);
    assert_eq!(colors("int", "-1 1 255 255"), [[0, 1, 255, 255]]);
    assert_eq!(colors("uchar", "0 1 2 3"), [[0, 1, 2, 3]]);
}

#[test]
fn points_that_are_not_finite_are_dropped_with_all_their_columns() {
    let rows = 300;
    let properties =
        format!("{XYZ}, float nx, float ny, float nz, uchar red, uchar green, uchar blue, int label");
    let mut body = Vec::new();
    for row in 0..rows {
        let y = ["0", "nan", "inf", "-1.#IND"][row % 4];
        body.push(format!("{row} {y} 0 {row} 0 nan {} 0 0 {row}", row % 256));
    }
    let read = ascii(&vertex(rows, &properties), &body.join("\n"));
    assert_eq!(
        (read.cloud.len(), read.dropped_not_finite),
        (rows / 4, rows - rows / 4)
    );
    for row in 0..read.cloud.len() {
        let kept = i32::try_from(4 * row).unwrap();
        assert_eq!(read.cloud.positions()[row], DVec3::new(f64::from(kept), 0.0, 0.0));
        assert_eq!(read.cloud.labels().unwrap()[row], kept);
        assert_eq!(i32::from(read.cloud.colors().unwrap()[row][0]), kept % 256);
        // Not finite, and so the zero vector, though x and y are.
        assert_eq!(read.cloud.normals().unwrap()[row], Vec3::ZERO);
    }
}

#[test]
fn labels_are_rounded_and_those_that_cannot_be_are_told() {
    let read = ascii(
        &vertex(5, &format!("{XYZ}, double label")),
        "0 0 0 1.9\n0 0 0 -3\n0 0 0 nan\n0 0 0 1e12\nnan 0 0 nan",
    );
    assert_eq!(read.cloud.labels(), Some(&[2, -3, -1, -1][..]));
    assert_eq!(read.notes, [Note::UnusableLabels { count: 2 }]);
}

#[test]
fn ascii_keeps_digits_that_the_stated_type_would_lose() {
    let cloud = ascii(&vertex(1, XYZ), "512345.123456 0.1 -1e-300").cloud;
    assert_eq!(cloud.positions(), [DVec3::new(512_345.123_456, 0.1, -1e-300)]);
}

#[test]
fn an_empty_cloud_is_a_cloud() {
    let cloud = ascii(&vertex(0, XYZ), "").cloud;
    assert_eq!(cloud, Cloud::new(Vec::new()));
}
