//! Files of meshes: every format gives the same triangles, and a bad file a sentence.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use axiscope::fruit::read_mesh;
use axiscope::geometry::Unit;
use axiscope::simulate::MeshScanSettings;
use glam::DVec3;
use tempfile::TempDir;

use super::meshes::{ellipsoid, exactly};

/// Writes a mesh in five ways.
fn in_all_formats(folder: &Path, positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<PathBuf> {
    let mut obj = String::from("# a mesh\r\nmtllib none.mtl\r\no body\r\n");
    let mut ply = String::new();
    for p in positions {
        writeln!(obj, "v {} {} {}\r", p.x, p.y, p.z).unwrap();
        writeln!(ply, "{} {} {}", p.x, p.y, p.z).unwrap();
    }
    obj += "vn 0 1 0\r\ns off\r\n";
    for t in triangles {
        let [a, b, c] = t.map(|i| i64::from(i) + 1);
        writeln!(
            obj,
            "f {a}//1 {b}//1 {}\r",
            c - 1 - i64::try_from(positions.len()).unwrap()
        )
        .unwrap();
        writeln!(ply, "3 {} {} {}", t[0], t[1], t[2]).unwrap();
    }
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
             element face {}\nproperty list uchar int vertex_indices\nend_header\n",
            positions.len(),
            triangles.len()
        )
    };
    let mut binary_ply = header("binary_big_endian").into_bytes();
    for x in positions.iter().flat_map(DVec3::to_array) {
        binary_ply.extend(x.to_be_bytes());
    }
    for t in triangles {
        binary_ply.push(3);
        binary_ply.extend(t.iter().flat_map(|i| i.to_be_bytes()));
    }
    let mut text = String::from("solid\n");
    let mut binary = Vec::new();
    let facets = triangles.iter().map(|t| {
        let corner = |i: u32| stl_io::Vertex::new(positions[i as usize].as_vec3().to_array());
        stl_io::Triangle {
            normal: stl_io::Normal::new([0.0; 3]),
            vertices: t.map(corner),
        }
    });
    let facets: Vec<stl_io::Triangle> = facets.collect();
    stl_io::write_stl(&mut binary, facets.iter()).unwrap();
    // As SolidWorks begins it.
    binary[..12].copy_from_slice(b"solid binary");
    for facet in &facets {
        text += " facet normal 0 0 0\n  outer loop\n";
        for v in facet.vertices {
            writeln!(text, "   vertex {} {} {}", v[0], v[1], v[2]).unwrap();
        }
        text += "  endloop\n endfacet\n";
    }
    text += "endsolid\n";
    let files: [(&str, Vec<u8>); 5] = [
        ("binary.ply", binary_ply),
        ("text.ply", (header("ascii") + &ply).into_bytes()),
        ("mesh.OBJ", obj.into_bytes()),
        ("text.stl", text.into_bytes()),
        ("binary.stl", binary),
    ];
    let write = |(name, bytes): (&str, Vec<u8>)| {
        std::fs::write(folder.join(name), bytes).unwrap();
        folder.join(name)
    };
    files.into_iter().map(write).collect()
}

#[test]
fn one_mesh_gives_the_same_cloud_in_every_format() {
    let folder = TempDir::new().unwrap();
    let (positions, triangles) = ellipsoid(3.0, 4.0);
    let mut clouds = Vec::new();
    for path in in_all_formats(folder.path(), &positions, &triangles) {
        let file = read_mesh(&path, None).expect("a mesh");
        assert_eq!(file.unit, Unit::Centimeter, "guessed");
        assert_eq!(file.mesh.triangles().len(), triangles.len());
        let scanned = MeshScanSettings {
            seed: 5,
            ..MeshScanSettings::default()
        }
        .scan(&file.mesh);
        clouds.push(scanned.expect("seen").cloud);
    }
    assert!(clouds[0].len() > 5000);
    for cloud in &clouds {
        assert!(*cloud == clouds[0], "all formats alike");
    }
}

/// The triangles' corners as other readers of these formats see them.
#[test]
fn obj_and_stl_are_read_as_others_read_them() {
    let folder = TempDir::new().unwrap();
    let text = "v 0 0 0\nv 1 0 0 1.0 0.5 0\nv 1 1 0\ng a\nf 1 2 3\nv 0 1 0\nf 1/1 3/2 -1\ng b\nv 2 2 2\nv 0 3 1\nf 1 2 3 4 -1\n";
    let text = format!("vt 0 0\nvt 1 1\n{text}");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, &text).unwrap();
    let ours = read_mesh(&path, Some(Unit::Centimeter)).expect("a mesh").mesh;
    let ours: Vec<DVec3> = ours
        .triangles()
        .iter()
        .flatten()
        .map(|&i| ours.positions()[i as usize])
        .collect();
    let plain: String = text
        .lines()
        .map(|line| line.replace(" 1.0 0.5 0", "") + "\n")
        .collect();
    let options = tobj::LoadOptions {
        triangulate: true,
        ..Default::default()
    };
    let (models, _) = tobj::load_obj_buf(&mut plain.as_bytes(), &options, |_| {
        Err(tobj::LoadError::GenericFailure)
    })
    .expect("a mesh for tobj");
    let theirs: Vec<DVec3> = models
        .iter()
        .flat_map(|m| {
            let at = |&i: &u32| DVec3::from_slice(&m.mesh.positions[i as usize * 3..][..3]);
            m.mesh.indices.iter().map(at).collect::<Vec<_>>()
        })
        .collect();
    assert_eq!(ours, theirs);

    let (positions, triangles) = ellipsoid(1.0, 2.0);
    let path = &in_all_formats(folder.path(), &positions, &triangles)[3];
    let ours = read_mesh(path, Some(Unit::Centimeter)).expect("a mesh").mesh;
    let text = std::fs::read_to_string(path)
        .unwrap()
        .replacen("solid", "solid x", 1);
    let theirs = stl_io::read_stl(&mut std::io::Cursor::new(text)).expect("a mesh for stl_io");
    for (ours_at, face) in ours.triangles().iter().zip(&theirs.faces) {
        for (&i, &j) in ours_at.iter().zip(&face.vertices) {
            let theirs = DVec3::from_array(theirs.vertices[j].0.map(f64::from));
            assert_eq!(ours.positions()[i as usize].as_vec3(), theirs.as_vec3());
        }
    }
}

#[test]
fn bad_files_are_refused_in_a_sentence() {
    let folder = TempDir::new().unwrap();
    let header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let faces = "element face 1\nproperty list uchar int vertex_index\nend_header\n";
    let three = "0 0 0\n1 0 0\n0 1 0\n";
    let cases: [(&str, String, &str); 16] = [
        (
            "a.ply",
            format!("{header}end_header\n{three}"),
            "a cloud of points cannot be scanned",
        ),
        (
            "b.ply",
            format!("{header}{faces}{three}3 0 1 3\n"),
            "line 13: a face has the corner 3, and the vertices are 0 to 2",
        ),
        (
            "c.ply",
            format!("{header}{faces}{three}3 0 1\n"),
            "the file ends after 0 of 1 rows of element \"face\"",
        ),
        (
            "d.ply",
            format!("{header}{faces}{three}3 0 one 2\n"),
            "\"one\" is not a number",
        ),
        (
            "e.ply",
            format!("{header}{faces}0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n"),
            "1 vertices have coordinates that are not finite",
        ),
        (
            "f.ply",
            format!("{header}{faces}0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n"),
            "none of its triangles has an area",
        ),
        (
            "a.obj",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n".into(),
            "line 4: a face has the corner 4, after 3 vertices",
        ),
        (
            "b.obj",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 -9223372036854775808\n".into(),
            "line 5: a face has the corner",
        ),
        ("c.obj", "v 0 0\n".into(), "line 1: a vertex takes three numbers"),
        (
            "d.obj",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n".into(),
            "line 4: a face takes at least three indices",
        ),
        (
            "e.obj",
            "v 0 0 0\nv 1 0 inf\n".into(),
            "line 2: a vertex takes three numbers",
        ),
        ("f.obj", "hello\n".into(), "it has no triangles"),
        (
            "a.stl",
            "solid\nvertex 0 0 0\nvertex 1 0 0\nendloop\n".into(),
            "line 4: a facet does not have three corners",
        ),
        ("b.stl", "hello".into(), "this is not an STL file"),
        (
            "c.stl",
            format!("{:80}\u{2}\0\0\0{:50}", "a", "b"),
            "the file ends after 1 of 2 triangles",
        ),
        (
            "a.glb",
            "hello".into(),
            "the file's name must end in .ply, .obj or .stl",
        ),
    ];
    for (name, bytes, cause) in cases {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let error = read_mesh(&path, None).expect_err(name).to_string();
        assert!(error.contains(name) && error.contains(cause), "{error}");
        assert!(!error.contains('\n'), "{error}");
    }
    let missing = read_mesh(folder.path().join("none.obj"), None).expect_err("missing");
    assert!(missing.to_string().contains("there is no such file"));
}

/// Any bytes at all are a mesh or a sentence.
#[test]
fn damaged_files_never_panic() {
    let folder = TempDir::new().unwrap();
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let files = in_all_formats(folder.path(), &positions, &[[0, 1, 2], [1, 2, 3], [0, 3, 1]]);
    let mut state = 1_u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let (mut read, mut refused) = (0, 0);
    for path in files {
        let whole = std::fs::read(&path).unwrap();
        for _ in 0..300 {
            let mut bytes = whole.clone();
            for _ in 0..=random(3) {
                let at = random(bytes.len());
                match random(3) {
                    0 => bytes[at] = random(256) as u8,
                    1 => bytes.truncate(at.max(1)),
                    _ => bytes.insert(at, b"0123456789-./ e\n"[random(16)]),
                }
            }
            std::fs::write(&path, bytes).unwrap();
            match read_mesh(&path, None) {
                Ok(file) => {
                    // Scanned or refused, too.
                    let _ = exactly(1, 0.0).scan(&file.mesh);
                    read += 1;
                }
                Err(error) => {
                    assert!(error.to_string().len() < 500);
                    refused += 1;
                }
            }
        }
    }
    assert!(read > 100 && refused > 100, "{read} read, {refused} refused");
}
