//! Reading PLY: headers as they were typed, rows as they are laid out, and what stands around the vertices.

use axiscope::geometry::Unit;
use axiscope::ply::{Note, Place, read};
use glam::DVec3;

use crate::helpers::ply_text::{XYZ, ascii, vertex};

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
fn a_late_wrapped_row_does_not_spoil_those_before_it() {
    let rows = 1000;
    let mut lines: Vec<String> = (0..rows).map(|row| format!("{row} 0 1")).collect();
    lines[rows - 2] = "998\n0 1".into();
    let read = ascii(&vertex(rows, XYZ), &lines.join("\n"));
    let expected: Vec<DVec3> = (0..1000)
        .map(|row| DVec3::new(f64::from(row), 0.0, 1.0))
        .collect();
    assert_eq!(read.cloud.positions(), expected);
    assert_eq!(
        read.notes,
        [Note::RowsWrap {
            place: Place::Line(1006)
        }]
    );
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
