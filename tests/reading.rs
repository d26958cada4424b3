//! Reading PLY: what is read, and how it is understood.

use axiscope::geometry::{Cloud, Unit};
use axiscope::io::ply::{Note, PlyCloud, read};
use glam::{DVec3, Vec3};

/// Reads a file of which only the header's middle and the body are given.
fn ascii(elements: &str, body: &str) -> PlyCloud {
    let file = format!("ply\nformat ascii 1.0\n{elements}\nend_header\n{body}");
    read(file.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{file}"))
}

fn vertex(count: usize, properties: &str) -> String {
    let properties: Vec<String> = properties.split(", ").map(|p| format!("property {p}")).collect();
    format!("element vertex {count}\n{}", properties.join("\n"))
}

const XYZ: &str = "float x, float y, float z";

/// A value of each type, in little-endian and big-endian bytes, with the number that it is.
fn typed_values() -> Vec<(&'static str, Vec<u8>, Vec<u8>, f64)> {
    macro_rules! values {
        ($($name:literal $value:expr;)*) => {
            vec![$(($name, $value.to_le_bytes().to_vec(), $value.to_be_bytes().to_vec(), $value as f64),)*]
        };
    }
    let mut values = values! {
        "char" -7i8; "int8" -8i8; "uchar" 200u8; "uint8" 201u8;
        "short" -300i16; "int16" -301i16; "ushort" 60000u16; "uint16" 60001u16;
        "int" -70000i32; "int32" -70001i32; "uint" 4_000_000_000u32; "uint32" 4_000_000_001u32;
        "int64" -5_000_000_000i64; "uint64" 5_000_000_000u64;
        "float" 0.1f32; "float32" -0.2f32; "double" 0.1f64; "float64" -1e300f64;
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
        let body: String = body.lines().map(|row| format!("0 0 0 {row}\n")).collect();
        ascii(&vertex(rows, &properties), &body)
            .cloud
            .colors()
            .unwrap()
            .to_vec()
    };
    assert_eq!(
        colors("float", "0 0.5 1 1\n0.2 0 0 0"),
        [[0, 128, 255, 255], [51, 0, 0, 0]]
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
    let mut body = String::new();
    for row in 0..rows {
        let y = ["0", "nan", "inf", "-1.#IND"][row % 4];
        body += &format!("{row} {y} 0 {row} 0 nan {} 0 0 {row}\n", row % 256);
    }
    let read = ascii(&vertex(rows, &properties), &body);
    assert_eq!(
        (read.cloud.len(), read.dropped_not_finite),
        (rows / 4, rows - rows / 4)
    );
    for row in 0..read.cloud.len() {
        let kept = i32::try_from(4 * row).unwrap();
        assert_eq!(read.cloud.positions()[row].x, f64::from(kept));
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
fn other_elements_and_lists_are_stepped_over() {
    let elements = format!(
        "element nothing 18446744073709551615\nelement camera 1\nproperty float focal\nproperty list uchar double k\n{}\n{}",
        vertex(
            2,
            "float x, list uchar short before, float y, float z, list int float after, uchar label"
        ),
        "element face 1\nproperty list uchar int vertex_indices",
    );
    let expected = ([DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0)], [8, 9]);

    let read_ascii = ascii(
        &elements,
        "0.5 2 1e-3 nan\n1 2 7 7 2 3 0 8\n4 0 5 6 1 0.5 9\n3 0 1 1\n",
    );
    assert_eq!(read_ascii.cloud.positions(), expected.0);
    assert_eq!(read_ascii.cloud.labels(), Some(&expected.1[..]));
    assert_eq!(read_ascii.notes, []);

    let header = format!("ply\nformat binary_little_endian 1.0\n{elements}\nend_header\n");
    let mut file = header.into_bytes();
    let mut put = |bytes: &[u8]| file.extend_from_slice(bytes);
    put(&0.5f32.to_le_bytes());
    put(&[2]);
    put(&[0; 16]);
    for (xyz, before, after, label) in [([1f32, 2.0, 3.0], 2u8, 0u8, 8), ([4.0, 5.0, 6.0], 0, 1, 9)] {
        put(&xyz[0].to_le_bytes());
        put(&[before]);
        put(&vec![0xff; 2 * usize::from(before)]);
        put(&xyz[1].to_le_bytes());
        put(&xyz[2].to_le_bytes());
        put(&i32::from(after).to_le_bytes());
        put(&vec![0xff; 4 * usize::from(after)]);
        put(&[label]);
    }
    put(&[3]);
    put(&[0; 12]);
    let read_binary = read(&file).unwrap();
    assert_eq!(read_binary, read_ascii);
}

#[test]
fn a_header_is_read_however_it_was_typed() {
    let lines = [
        "ply",
        "format ascii 1.0",
        "comment made by hand \u{e9}",
        "",
        "obj_info num_cols 4",
        "element vertex 1",
        "property float x",
        "property float y",
        "property float z",
        "end_header",
        "1 2 3",
        "",
    ];
    let expected = [DVec3::new(1.0, 2.0, 3.0)];
    for end in ["\n", "\r\n", "\r"] {
        for (before, after) in [("", ""), ("  ", ""), ("", " \t"), ("\t", "  ")] {
            let indented: Vec<String> = lines
                .iter()
                .map(|line| format!("{before}{line}{after}"))
                .collect();
            let plain = indented.join(end);
            let marked = format!("\u{feff}{plain}");
            // The same in Latin-1, where é is one byte that is no UTF-8.
            let latin: Vec<u8> = plain.chars().map(|c| c as u8).collect();
            for file in [plain.as_bytes(), marked.as_bytes(), &latin] {
                let read = read(file).unwrap();
                assert_eq!(read.cloud.positions(), expected);
                assert_eq!(read.notes, []);
            }
        }
    }
}

#[test]
fn unknown_lines_and_versions_are_told() {
    let file = "ply\nformat ascii 1.1\nauthor me\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nwhatever\nend_header\n1 2 3\n";
    let read = read(file.as_bytes()).unwrap();
    assert_eq!(read.cloud.len(), 1);
    let told = [
        Note::Version("\"1.1\"".into()),
        Note::UnknownHeaderLines {
            first_line: 3,
            count: 2,
        },
    ];
    assert_eq!(read.notes, told);
}

#[test]
fn the_body_starts_right_after_the_line_end_of_the_header() {
    // x is 10 or 13 in its first byte: a line end that is none.
    for first in [0x0a, 0x0d] {
        for end in ["\n", "\r\n", "\r"] {
            let header = format!(
                "ply\nformat binary_little_endian 1.0\n{}\nend_header\n",
                vertex(1, "uchar x, uchar y, uchar z")
            );
            let mut file = header.replace('\n', end).into_bytes();
            file.extend([first, 0x0a, 0x0d]);
            let read = read(&file).unwrap();
            assert_eq!(
                read.cloud.positions(),
                [DVec3::new(f64::from(first), 10.0, 13.0)],
                "{end:?}"
            );
        }
    }
}

#[test]
fn rows_may_be_spaced_by_any_white_space() {
    let body = "\n\n  1\t2   3  \r\n\r\n\x0b4 5\x0c6\r7 8 9";
    let cloud = ascii(&vertex(3, XYZ), body).cloud;
    let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
    assert_eq!(cloud.positions(), rows.map(DVec3::from));
}

#[test]
fn numbers_in_sequence_are_read_where_rows_wrap() {
    let elements = format!(
        "{}\nelement face 1\nproperty list uchar int vertex_index",
        vertex(3, &format!("{XYZ}, uchar label"))
    );
    let expected = [[1.0, 2.0, 3.0], [5.0, 6.0, 7.0], [9.0, 10.0, 11.0]].map(DVec3::from);
    for body in [
        "1 2 3\n4 5 6 7 8 9\n10 11 12 3\n0 1\n2",
        "1 2 3 4 5 6 7 8 9 10 11 12 3 0 1 2",
        "1 2 3 4\n5\n6 7 8\n9 10 11 12\n3 0 1 2\n",
    ] {
        let read = ascii(&elements, body);
        assert_eq!(read.cloud.positions(), expected);
        assert_eq!(read.cloud.labels(), Some(&[4, 8, 12][..]));
        assert!(
            matches!(read.notes[..], [Note::RowsWrap { .. }]),
            "{:?}",
            read.notes
        );
    }
}

#[test]
fn what_follows_the_vertices_is_not_needed() {
    let with_faces = format!(
        "{}\nelement face 5\nproperty list uchar int vertex_index",
        vertex(1, "uchar x, uchar y, uchar z")
    );
    let told = [Note::RestDamaged {
        element: "\"face\"".into(),
    }];
    assert_eq!(ascii(&with_faces, "1 2 3\n3 0 1").notes, told);
    let binary = |elements: &str, rest: &[u8]| {
        let header = format!("ply\nformat binary_big_endian 1.0\n{elements}\nend_header\n\x01\x02\x03");
        let read = read(&[header.as_bytes(), rest].concat()).unwrap();
        assert_eq!(read.cloud.positions(), [DVec3::new(1.0, 2.0, 3.0)]);
        read.notes
    };
    assert_eq!(binary(&with_faces, &[3, 0, 0]), told);
    assert_eq!(binary(&with_faces, &[0; 5]), []);
    let alone = vertex(1, "uchar x, uchar y, uchar z");
    assert_eq!(binary(&alone, b"\n"), []);
    assert_eq!(binary(&alone, b"rest"), [Note::Trailing { bytes: 4 }]);
    assert_eq!(ascii(&alone, "1 2 3\n\n").notes, []);
    assert_eq!(
        ascii(&alone, "1 2 3\n4 5 6\n").notes,
        [Note::Trailing { bytes: 5 }]
    );
}

#[test]
fn a_comment_may_state_the_unit() {
    let stated = |comments: &str| {
        let read = ascii(&format!("{comments}\n{}", vertex(0, XYZ)), "");
        (read.stated_unit, read.notes)
    };
    assert_eq!(stated("comment unit m"), (Some(Unit::Meter), vec![]));
    assert_eq!(stated("comment unit cm"), (Some(Unit::Centimeter), vec![]));
    assert_eq!(stated("comment  unit  mm "), (Some(Unit::Millimeter), vec![]));
    assert_eq!(stated("comment the unit is cm\ncomment unit"), (None, vec![]));
    assert_eq!(
        stated("comment unit cm\ncomment unit cm"),
        (Some(Unit::Centimeter), vec![])
    );
    assert_eq!(
        stated("comment unit inch"),
        (
            None,
            vec![Note::UnknownUnit {
                line: 3,
                unit: "\"inch\"".into()
            }]
        )
    );
    assert_eq!(
        stated("comment unit cm\ncomment unit mm"),
        (None, vec![Note::UnitsDisagree { line: 4 }])
    );
}

#[test]
fn ascii_keeps_digits_that_the_stated_type_would_lose() {
    let cloud = ascii(&vertex(1, XYZ), "512345.123456 0.1 -1e-300").cloud;
    assert_eq!(cloud.positions(), [DVec3::new(512_345.123_456, 0.1, -1e-300)]);
}

#[test]
fn notes_are_one_line_each() {
    let notes = [
        Note::UnknownHeaderLines {
            first_line: 3,
            count: 1,
        },
        Note::UnknownHeaderLines {
            first_line: 3,
            count: 2,
        },
        Note::Incomplete {
            column: "normals",
            missing: "nz",
        },
        Note::Trailing { bytes: 4 },
    ];
    let shown = notes.map(|note| note.to_string());
    assert_eq!(shown[0], "Line 3 of the header is unknown and was ignored");
    assert!(shown.iter().all(|note| note.lines().count() == 1), "{shown:?}");
}

#[test]
fn an_empty_cloud_is_a_cloud() {
    let cloud = ascii(&vertex(0, XYZ), "").cloud;
    assert_eq!(cloud, Cloud::new(Vec::new()));
}
