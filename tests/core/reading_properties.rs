//! Reading PLY, as properties: what is written comes back, and damage never does harm.

use std::time::{Duration, Instant};

use axiscope::geometry::{Cloud, Unit};
use axiscope::ply::{Encoding, PlyCloud, Precision, WriteError, WriteOptions, read, write};
use glam::{DVec3, Vec3};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// A number of any size, as likely around 1 as anywhere.
fn coordinate() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![-10.0..10.0, (POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO)]
}

/// Clouds with any of the columns. Normals are finite: others are read as none.
fn cloud() -> impl Strategy<Value = Cloud> {
    let normal =
        (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z).as_vec3());
    let label = prop_oneof![0..3, any::<i32>()];
    let opaque = any::<[u8; 3]>().prop_map(|[r, g, b]| [r, g, b, 255]);
    let rows = vec(
        (
            any::<[u8; 4]>(),
            opaque,
            label,
            0..256i32,
            normal,
            [coordinate(), coordinate(), coordinate()],
        ),
        0..300,
    );
    (rows, any::<[bool; 5]>()).prop_map(
        |(rows, [with_normals, with_colors, with_labels, is_opaque, is_narrow])| {
            let mut cloud = Cloud::new(rows.iter().map(|row| DVec3::from(row.5)).collect());
            if with_normals {
                let finite = |n: Vec3| if n.is_finite() { n } else { Vec3::X };
                cloud = cloud
                    .with_normals(rows.iter().map(|row| finite(row.4)).collect())
                    .unwrap();
            }
            if with_colors {
                cloud = cloud
                    .with_colors(
                        rows.iter()
                            .map(|row| if is_opaque { row.1 } else { row.0 })
                            .collect(),
                    )
                    .unwrap();
            }
            if with_labels {
                cloud = cloud
                    .with_labels(
                        rows.iter()
                            .map(|row| if is_narrow { row.3 } else { row.2 })
                            .collect(),
                    )
                    .unwrap();
            }
            cloud
        },
    )
}

fn written(cloud: &Cloud, options: &WriteOptions<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(&mut bytes, cloud, options).unwrap();
    bytes
}

fn single(positions: &[DVec3]) -> Vec<Vec3> {
    positions.iter().map(|p| p.as_vec3()).collect()
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn what_is_written_comes_back(
        cloud in cloud(),
        unit in proptest::option::of(select(&Unit::ALL[..])),
        comments in vec("[ -~\n\r]{0,40}", 0..3),
    ) {
        // A comment that happens to state a unit is one.
        let comments: Vec<String> = comments.iter().map(|comment| format!("- {}", comment.replace(['\n', '\r'], "\n- "))).collect();
        for encoding in Encoding::ALL {
            let options = WriteOptions { unit, comments: &comments, encoding, precision: Precision::Double, scalars: &[] };
            let bytes = written(&cloud, &options);
            prop_assert_eq!(&bytes, &written(&cloud, &options));
            let expected = PlyCloud { cloud: cloud.clone(), dropped_not_finite: 0, stated_unit: unit, notes: vec![] };
            prop_assert_eq!(read(&bytes).unwrap(), expected);
        }
    }

    #[test]
    fn single_precision_keeps_what_fits_in_it(cloud in cloud()) {
        let fits = cloud.positions().iter().all(|p| p.as_vec3().is_finite());
        for encoding in Encoding::ALL {
            let options = WriteOptions { encoding, ..WriteOptions::default() };
            if fits {
                let back = read(&written(&cloud, &options)).unwrap().cloud;
                prop_assert_eq!(single(back.positions()), single(cloud.positions()));
                prop_assert_eq!((back.normals(), back.colors(), back.labels()), (cloud.normals(), cloud.colors(), cloud.labels()));
            } else {
                let first = cloud.positions().iter().position(|p| !p.as_vec3().is_finite()).unwrap();
                let mut bytes = Vec::new();
                let error = write(&mut bytes, &cloud, &options).unwrap_err();
                let is_told = matches!(error, WriteError::TooLarge { point } if point == first);
                prop_assert!(is_told, "{}", error);
                prop_assert!(bytes.is_empty());
            }
        }
    }

    #[test]
    fn the_precision_needed_keeps_every_position(cloud in cloud()) {
        let single = Cloud::new(single(cloud.positions()).iter().map(|p| p.as_dvec3()).collect());
        prop_assert_eq!(Precision::needed_by(&single), Precision::Float);
        let options = WriteOptions { precision: Precision::needed_by(&cloud), ..WriteOptions::default() };
        prop_assert_eq!(read(&written(&cloud, &options)).unwrap().cloud, cloud);
    }
}

/// What damages a file.
#[derive(Debug, Clone)]
enum Damage {
    Flip(Index, u8),
    Truncate(Index),
    Delete(Index, usize),
    Insert(Index, Vec<u8>),
    Repeat(Index),
    Count(Index, &'static str),
}

fn damage() -> impl Strategy<Value = Damage> {
    const PIECES: [&str; 13] = [
        "nan",
        "1e",
        "-",
        "\r",
        "\n\n",
        "\u{feff}",
        "property list uint double l\n",
        "element e 4294967295\n",
        "end_header\n",
        "comment unit cm\n",
        "property float16 h\n",
        "list",
        "\0",
    ];
    const COUNTS: [&str; 7] = [
        "18446744073709551615",
        "9223372036854775807",
        "4294967296",
        "-1",
        "0",
        "1e3",
        "2147483648",
    ];
    let at = any::<Index>;
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(at, byte)| Damage::Flip(at, byte)),
        at().prop_map(Damage::Truncate),
        (at(), 1..40usize).prop_map(|(at, size)| Damage::Delete(at, size)),
        (at(), vec(any::<u8>(), 1..20)).prop_map(|(at, bytes)| Damage::Insert(at, bytes)),
        (at(), select(&PIECES[..])).prop_map(|(at, piece)| Damage::Insert(at, piece.into())),
        at().prop_map(Damage::Repeat),
        (at(), select(&COUNTS[..])).prop_map(|(at, count)| Damage::Count(at, count)),
    ]
}

fn damaged(mut file: Vec<u8>, damage: &Damage) -> Vec<u8> {
    if file.is_empty() {
        return file;
    }
    // Half of all damage goes to the header, which is but a small part of most files.
    let header = file
        .windows(10)
        .position(|w| w == b"end_header")
        .map_or(file.len(), |at| at + 11)
        .min(file.len());
    let place = |at: &Index| {
        if at.index(2) == 0 {
            at.index(header)
        } else {
            at.index(file.len())
        }
    };
    let line_at = |at: &Index| {
        let starts: Vec<usize> = (0..header).filter(|&i| i == 0 || file[i - 1] == b'\n').collect();
        let start = starts[at.index(starts.len())];
        let end = file[start..]
            .iter()
            .position(|&byte| byte == b'\n')
            .map_or(file.len(), |size| start + size + 1);
        start..end
    };
    match damage {
        Damage::Flip(at, byte) => {
            let at = place(at);
            file[at] ^= byte;
        }
        Damage::Truncate(at) => {
            let at = place(at);
            file.truncate(at);
        }
        Damage::Delete(at, size) => {
            let at = place(at);
            let end = (at + size).min(file.len());
            file.drain(at..end);
        }
        Damage::Insert(at, bytes) => {
            let at = place(at);
            file.splice(at..at, bytes.iter().copied());
        }
        Damage::Repeat(at) => {
            let line = line_at(at);
            let copy = file[line.clone()].to_vec();
            file.splice(line.start..line.start, copy);
        }
        Damage::Count(at, count) => {
            let line = line_at(at);
            let text = String::from_utf8_lossy(&file[line.clone()]).into_owned();
            if let Some((before, _)) = text.trim_end().rsplit_once(' ') {
                file.splice(line, format!("{before} {count}\n").into_bytes());
            }
        }
    }
    file
}

/// A file that has everything there is: elements before and after, lists, all types.
fn rich_file(encoding: Encoding) -> Vec<u8> {
    let format = ["ascii", "binary_little_endian", "binary_big_endian"][encoding as usize];
    let header = format!(
        "ply\nformat {format} 1.0\ncomment unit mm\nelement before 2\nproperty list uchar short l\nelement vertex 3\n\
         property uchar x\nproperty char y\nproperty uchar z\nproperty list uchar uchar l\nproperty uchar red\n\
         property uchar green\nproperty uchar blue\nproperty char label\nelement face 1\nproperty list uchar uchar v\nend_header\n"
    );
    let body: &[u8] = &[
        0, 1, 7, 7, 1, 2, 3, 2, 9, 9, 10, 20, 30, 1, 4, 5, 6, 0, 13, 10, 32, 0, 7, 8, 9, 1, 1, 1, 1, 1, 2, 3,
        0, 1, 2,
    ];
    let text = "0\n1 1799\n1 2 3 2 9 9 10 20 30 1\n4 5 6 0 13 10 32 0\n7 8 9 1 1 1 1 1 2\n3 0 1 2\n";
    [
        header.as_bytes(),
        if encoding == Encoding::Ascii {
            text.as_bytes()
        } else {
            body
        },
    ]
    .concat()
}

#[test]
fn the_file_to_be_damaged_is_a_good_one() {
    let clouds = Encoding::ALL.map(|encoding| read(&rich_file(encoding)).unwrap());
    assert_eq!(clouds[0].cloud.len(), 3);
    assert_eq!(clouds[0].notes, []);
    assert_eq!(clouds[0], clouds[1]);
    assert_eq!(clouds[0], clouds[2]);
}

proptest! {
    #![proptest_config(cases(10_000))]

    #[test]
    fn damage_gives_a_cloud_or_one_line(
        encoding in select(&Encoding::ALL[..]),
        is_rich: bool,
        damages in vec(damage(), 1..4),
    ) {
        let file = if is_rich {
            rich_file(encoding)
        } else {
            let rows: u8 = 30;
            let cloud = Cloud::new((0..rows).map(|i| DVec3::splat(f64::from(i) / 7.0)).collect())
                .with_normals(vec![Vec3::X; usize::from(rows)]).unwrap()
                .with_labels((0..i32::from(rows)).collect()).unwrap();
            written(&cloud, &WriteOptions { encoding, ..WriteOptions::default() })
        };
        let file = damages.iter().fold(file, damaged);
        let start = Instant::now();
        let result = read(&file);
        // However slow the machine: a reader that spins takes far longer.
        prop_assert!(start.elapsed() < Duration::from_mins(1), "it spins");
        match result {
            Ok(read) => {
                let cloud = read.cloud;
                prop_assert!(cloud.positions().iter().all(|p| p.is_finite()));
                prop_assert!(cloud.normals().is_none_or(|n| n.iter().all(|n| n.is_finite())));
                // Three bytes at least for each point.
                prop_assert!(3 * (cloud.len() + read.dropped_not_finite) <= file.len());
                prop_assert!(read.notes.iter().all(|note| note.to_string().lines().count() == 1));
            }
            Err(error) => prop_assert_eq!(error.to_string().lines().count(), 1, "{}", error),
        }
    }

    #[test]
    fn any_bytes_after_a_header_give_a_cloud_or_one_line(
        encoding in select(&["ascii", "binary_little_endian", "binary_big_endian"][..]),
        list: bool,
        count in 0..20u32,
        body in prop_oneof![vec(any::<u8>(), 0..200), "[-0-9 .enaif\n]{0,200}".prop_map(String::into_bytes)],
    ) {
        let extra = if list { "property list short ushort extra\n" } else { "" };
        let header = format!("ply\nformat {encoding} 1.0\nelement vertex {count}\n{extra}property uchar x\nproperty short y\nproperty float z\nend_header\n");
        match read(&[header.as_bytes(), &body].concat()) {
            Ok(read) => prop_assert_eq!(read.cloud.len() + read.dropped_not_finite, count as usize),
            Err(error) => prop_assert_eq!(error.to_string().lines().count(), 1, "{}", error),
        }
    }
}
