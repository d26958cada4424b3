//! Malformed PLY files: each is refused in one line that names where and what.

use axiscope::fruit::{parse_cloud, read_cloud};
use axiscope::ply::{Place, read};

/// A file whose vertices are complete, with something replaced.
fn changed(from: &str, to: &str) -> Vec<u8> {
    let file = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n";
    assert!(file.contains(from), "{from}");
    file.replacen(from, to, 1).into_bytes()
}

fn binary(elements: &str, body: &[u8]) -> Vec<u8> {
    let mut file = format!("ply\nformat binary_little_endian 1.0\n{elements}\nend_header\n").into_bytes();
    file.extend(body);
    file
}

const BYTES: &str = "property uchar x\nproperty uchar y\nproperty uchar z";

/// Each file is refused with a message that contains what stands beside it.
fn refused(cases: Vec<(Vec<u8>, &str)>) {
    for (file, expected) in cases {
        let error = read(&file).expect_err(expected);
        let shown = error.to_string();
        assert!(shown.contains(expected), "{shown:?} has no {expected:?}");
        assert_eq!(shown.lines().count(), 1, "{shown:?}");
    }
}

#[test]
fn what_is_no_ply_file_is_refused() {
    refused(vec![
        (vec![], "the file is empty"),
        (b" \n\n".to_vec(), "the file is empty"),
        (b"plywood\n".to_vec(), "this is not a PLY file"),
        (b"\x89PNG\r\n\x1a\n".to_vec(), "this is not a PLY file"),
        (b"\xff\xfep\0l\0y\0\n\0".to_vec(), "not a PLY file but UTF-16"),
        (b"\x1f\x8b\x08\0\0\0".to_vec(), "not a PLY file but gzip"),
        (
            b"ply\nformat ascii 1.0\n".to_vec(),
            "line 2: the header has no \"end_header\" line within the first 21 bytes",
        ),
        (
            [b"ply\nformat ascii 1.0\n".to_vec(), vec![b'x'; 3 << 20]].concat(),
            "line 2: the header has no \"end_header\" line within the first 1048576 bytes",
        ),
    ]);
}

#[test]
fn a_header_without_end_is_not_searched_for_ever() {
    let long = format!("{}element", "comment and so on\n".repeat(1 << 16));
    refused(vec![(
        changed("element", &long),
        "the header has no \"end_header\" line within the first 1048576 bytes",
    )]);
}

#[test]
fn malformed_headers_are_refused_with_their_line() {
    refused(vec![
        (
            changed("format ascii 1.0\n", ""),
            "line 6: the header has no \"format\" line",
        ),
        (
            changed("ascii", "ascii 1.0 or"),
            "line 2: 5 words where \"format NAME 1.0\" is expected",
        ),
        (
            changed("ascii", "hexadecimal"),
            "line 2: unknown format \"hexadecimal\"",
        ),
        (
            changed("element", "format ascii 1.0\nelement"),
            "line 3: a second \"format\" line",
        ),
        (
            changed("vertex 2", "vertex"),
            "line 3: 2 words where \"element NAME COUNT\" is expected",
        ),
        (
            changed("vertex 2", "vertex -2"),
            "line 3: the count \"-2\" is not a whole number",
        ),
        (
            changed("vertex 2", "vertex two"),
            "line 3: the count \"two\" is not a whole number",
        ),
        (
            changed("vertex 2", "vertex 99999999999999999999"),
            "line 3: the count \"99999999999999999999\"",
        ),
        (
            changed("vertex 2", "points 2"),
            "line 7: the header has no vertex element",
        ),
        (
            changed("element", "property float x\nelement"),
            "line 3: a property before the first element",
        ),
        (
            changed("float y", "float"),
            "line 5: 2 words where \"property TYPE NAME\" is expected",
        ),
        (
            changed("float y", "list uchar y"),
            "line 5: 4 words where \"property list COUNT_TYPE ITEM_TYPE NAME\" is expected",
        ),
        (changed("float y", "quad y"), "line 5: unknown type \"quad\""),
        (
            changed("float y", "list uchar quad y"),
            "line 5: unknown type \"quad\"",
        ),
        (
            changed("float y", "list float int y"),
            "line 5: the count of a list cannot be of type \"float\"",
        ),
        (
            changed("float y", "list uchar int y"),
            "line 3: property \"y\" is a list",
        ),
        (
            changed("float y", "float x"),
            "line 5: property \"x\" was declared on line 4 already",
        ),
        (
            changed("float z", "float up"),
            "line 3: the vertex element has no property \"z\"",
        ),
        (
            changed("end_header", "element vertex 2\nend_header"),
            "line 7: element \"vertex\" was declared on line 3 already",
        ),
        (
            changed(
                "end_header",
                "element face 2\nproperty int a\nproperty int a\nend_header",
            ),
            "line 9: property \"a\" was declared on line 8",
        ),
    ]);
}

#[test]
fn malformed_rows_are_refused_with_their_line() {
    refused(vec![
        (
            changed("vertex 2", "vertex 3"),
            "line 10: the file ends after 2 of 3 rows of element \"vertex\"",
        ),
        (
            changed("vertex 2", "vertex 18446744073709551615"),
            "line 10: the file ends after 2 of 18446744073709551615 rows",
        ),
        (changed("4 5 6", "4 5"), "line 9: 2 numbers where 3 are expected"),
        (
            changed("4 5 6", "4 5 6 7"),
            "line 9: 4 numbers where 3 are expected",
        ),
        (
            changed("4 5 6\n", "4 5"),
            "line 9: the file ends after 1 of 2 rows",
        ),
        (changed("4 5 6", "4 five 6"), "line 9: \"five\" is not a number"),
        (
            changed("4 5 6", "4 5,5 6"),
            "line 9: \"5,5\" is not a number (the decimal sign must be a point",
        ),
        (
            changed("1 2 3", "1,2,3"),
            "line 8: \"1,2,3\" is not a number (the decimal sign",
        ),
        (changed("1 2 3", "1 2\0 3"), "line 8: \"2\\0\" is not a number"),
        (
            changed("1 2 3", &format!("1 {} 3", "9e".repeat(99))),
            "line 8: \"9e9e9e9e9e9e9e9e9e9e9e9e9e9e9e9e9e9e9e9e…\" is not",
        ),
        (
            changed("float z", "float z\nproperty list int int l"),
            "line 9: 3 numbers where at least 4 are expected",
        ),
        (
            changed(
                "float z\nend_header\n1 2 3",
                "float z\nproperty list int int l\nend_header\n1 2 3 -1",
            ),
            "line 9: the count of a list is \"-1\"",
        ),
        (
            changed(
                "float z\nend_header\n1 2 3",
                "float z\nproperty list int int l\nend_header\n1 2 3 1e18 4",
            ),
            "line 9: 5 numbers where at least 4 are expected",
        ),
    ]);
}

#[test]
fn malformed_binary_is_refused_with_its_byte() {
    let with_list = format!("element vertex 2\n{BYTES}\nproperty list char float extra");
    let camera = format!("element camera 3\nproperty list int double k\nelement vertex 1\n{BYTES}");
    refused(vec![
        (
            binary(&format!("element vertex 3\n{BYTES}"), &[0; 8]),
            "byte 123: the file ends after 2 of 3 rows of element \"vertex\"",
        ),
        (
            binary(&format!("element vertex 18446744073709551615\n{BYTES}"), &[0; 8]),
            "rows of element \"vertex\"",
        ),
        (
            binary(&format!("element vertex 6148914691236517206\n{BYTES}"), &[0; 8]),
            "ends after 2 of 6148914691236517206",
        ),
        (binary(&with_list, &[0; 4]), "the file ends after 1 of 2 rows"),
        (
            binary(&with_list, &[0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]),
            "the file ends after 1 of 2 rows",
        ),
        (
            binary(&with_list, &[0, 0, 0, 0, 0, 0, 0, 0xff]),
            "byte 153: a list of -1 items",
        ),
        (
            binary(&camera, &[0, 0, 0, 0, 0xff, 0xff, 0xff, 0x7f]),
            "the file ends after 1 of 3 rows of element \"camera\"",
        ),
        (
            binary(&camera, &[0, 0, 0, 0x80]),
            "byte 159: a list of -2147483648 items",
        ),
    ]);
}

#[test]
fn lines_are_counted_by_the_line_end_in_use() {
    for end in ["\n", "\r\n", "\r"] {
        let file = String::from_utf8(changed("4 5 6", "4 five 6"))
            .unwrap()
            .replace('\n', end);
        assert_eq!(
            read(file.as_bytes()).unwrap_err().place,
            Place::Line(9),
            "{end:?}"
        );
    }
}

#[test]
fn a_row_with_a_number_too_many_is_not_made_up_for_by_chance() {
    // Nine numbers where six are expected, whatever way they are read.
    let error = read(&changed("1 2 3", "1 2 3 4\n4 5")).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("line 8: 4 numbers where 3 are expected"),
        "{error}"
    );
}

#[test]
fn huge_counts_of_nothing_cost_nothing() {
    for format in ["ascii", "binary_big_endian"] {
        let nothing = "element a 18446744073709551615\nelement b 18446744073709551615";
        let file = format!(
            "ply\nformat {format} 1.0\n{nothing}\nelement vertex 0\n{BYTES}\nelement c 18446744073709551615\nend_header\n"
        );
        assert!(read(file.as_bytes()).unwrap().cloud.is_empty());
    }
}

#[test]
fn files_that_cannot_be_read_are_named_with_the_cause() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("empty.ply"), b"").unwrap();
    std::fs::write(path("bad.ply"), changed("4 5 6", "4 five 6")).unwrap();
    let cases = [
        (path("missing.ply"), "missing.ply: there is no such file"),
        (folder.path().to_owned(), ": this is a folder, not a file"),
        (path("empty.ply"), "empty.ply: the file is empty"),
        (path("bad.ply"), "bad.ply: line 9: \"five\" is not a number"),
        ("two\nlines.ply".into(), "two\\nlines.ply: there is no such file"),
    ];
    for (path, expected) in cases {
        let shown = read_cloud(&path).expect_err(expected).to_string();
        assert!(
            shown.ends_with(expected),
            "{shown:?} does not end with {expected:?}"
        );
        assert_eq!(shown.lines().count(), 1);
    }
}

#[cfg(unix)]
#[test]
fn a_device_is_refused_before_it_is_opened() {
    let shown = read_cloud("/dev/zero").unwrap_err().to_string();
    assert_eq!(shown, "/dev/zero: this is not a regular file");
}

#[test]
fn a_file_that_is_read_tells_its_hash() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloud.ply");
    let bytes = changed("", "");
    std::fs::write(&path, &bytes).unwrap();
    let file = read_cloud(&path).unwrap();
    assert_eq!(file.ply.cloud.len(), 2);
    assert_eq!(file.path, path);
    assert_eq!(file, parse_cloud(&path, &bytes).unwrap());
    // Of `printf 'ply\nformat ascii 1.0\n…' | sha256sum`.
    assert_eq!(
        file.sha256,
        "5e79ba35d65d3838f39d007f0bbc02c5591894f0358fb89fc530fc3af2015350"
    );
}
