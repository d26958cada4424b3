//! Scans of meshes from elsewhere: points on the surface, whatever the file's format.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use axiscope::fruit::read_mesh;
use axiscope::geometry::Unit;
use axiscope::simulate::{MeshScanSettings, ScanSettings, ScannedMesh, SimulateError, TriangleMesh};
use glam::DVec3;
use tempfile::TempDir;

use super::exact;

const RADIUS: f64 = 4.0;

/// An ellipsoid of revolution about y with the half-axes `across` and `along`, whose coordinates are exact in 32 bits, as
/// vertices and triangles.
fn ellipsoid(across: f64, along: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    const RINGS: u32 = 90;
    const AROUND: u32 = 120;
    let mut positions = Vec::new();
    for ring in 0..=RINGS {
        let (sin, cos) = (f64::from(ring) / f64::from(RINGS) * std::f64::consts::PI).sin_cos();
        for step in 0..AROUND {
            let turn = f64::from(step) / f64::from(AROUND) * std::f64::consts::TAU;
            let p = DVec3::new(across * sin * turn.sin(), along * cos, across * sin * turn.cos());
            positions.push(p.as_vec3().as_dvec3());
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..RINGS {
        for step in 0..AROUND {
            let at = |ring: u32, step: u32| ring * AROUND + step % AROUND;
            let [a, b] = [at(ring, step), at(ring, step + 1)];
            let [c, d] = [at(ring + 1, step + 1), at(ring + 1, step)];
            triangles.extend([[a, c, b], [a, d, c]]);
        }
    }
    (positions, triangles)
}

fn sphere() -> TriangleMesh {
    let (positions, triangles) = ellipsoid(RADIUS, RADIUS);
    TriangleMesh::new(&positions, triangles).expect("a mesh")
}

/// Scans without errors of the camera or its poses.
fn exactly(views: u32, arc_deg: f64) -> MeshScanSettings {
    MeshScanSettings {
        camera: exact(),
        scan: ScanSettings {
            views,
            arc_deg,
            pose_noise_deg: 0.0,
            pose_noise_cm: 0.0,
            ..ScanSettings::default()
        },
        ..MeshScanSettings::default()
    }
}

fn farthest_from_sphere(scanned: &ScannedMesh) -> f64 {
    let off = |p: &DVec3| (p.distance(scanned.pose.translation) - RADIUS).abs();
    scanned.cloud.positions().iter().map(off).fold(0.0, f64::max)
}

#[test]
fn a_scan_of_a_sphere_lies_on_it_and_covers_the_cap_that_faces_the_camera() {
    let one = exactly(1, 0.0).scan(&sphere()).expect("seen");
    assert!(
        farthest_from_sphere(&one) < 0.01,
        "{}",
        farthest_from_sphere(&one)
    );
    let distance = one.pose.translation.length();
    let cap = (1.0 - RADIUS / distance) / 2.0;
    assert!((one.coverage - cap).abs() < 0.01, "{} is not {cap}", one.coverage);
    assert!(one.truth.is_none(), "no axis is known");
    assert!(one.cloud.colors().is_none() && one.cloud.labels().is_none());

    let around = exactly(24, 360.0).scan(&sphere()).expect("seen");
    let half_a_voxel = 0.1;
    assert!(
        farthest_from_sphere(&around) < half_a_voxel,
        "{}",
        farthest_from_sphere(&around)
    );
    let all_but_both_ends = (1.0 - (RADIUS / distance).powi(2)).sqrt();
    let off = (around.coverage - all_but_both_ends).abs();
    assert!(off < 0.02, "{} is not {all_but_both_ends}", around.coverage);
    for (normal, p) in around
        .cloud
        .normals()
        .expect("fused")
        .iter()
        .zip(around.cloud.positions())
    {
        let outward = (*p - around.pose.translation).normalize();
        assert!(normal.as_dvec3().dot(outward) > 0.9, "{normal} at {p}");
    }
}

#[test]
fn the_axis_is_where_the_points_are_in_every_frame() {
    let (positions, triangles) = ellipsoid(3.0, 4.0);
    let moved: Vec<DVec3> = positions
        .iter()
        .map(|p| *p * 10.0 + DVec3::new(500.0, -20.0, 80.0))
        .collect();
    let mesh = TriangleMesh::new(&moved, triangles).expect("a mesh");
    let top = DVec3::new(500.0, 20.0, 80.0);
    let bottom = DVec3::new(500.0, -60.0, 80.0);
    for from in [
        None,
        Some(DVec3::new(900.0, 60.0, 200.0)),
        Some(DVec3::new(500.0, 400.0, 80.0)),
    ] {
        let settings = MeshScanSettings {
            mesh_unit: Unit::Millimeter,
            from,
            axis: Some([top, bottom]),
            ..exactly(7, 90.0)
        };
        let scanned = settings.scan(&mesh).expect("seen");
        let truth = scanned.truth.as_ref().expect("an axis");
        assert!((truth.stem_end.distance(truth.blossom_end) - 8.0).abs() < 1e-9);
        assert!(
            truth.center.truncate().length() < 1e-9,
            "looked at: {}",
            truth.center
        );
        assert_eq!(truth.coverage, Some(scanned.coverage));
        for p in scanned.cloud.positions() {
            let along = (*p - truth.center).dot(truth.axis.direction);
            let across = (*p - truth.center)
                .reject_from_normalized(truth.axis.direction)
                .length();
            let on_surface = (along / 4.0).hypot(across / 3.0);
            assert!((on_surface - 1.0).abs() < 0.04, "{on_surface} at {p}");
        }
        let (cloud, millimeters) = scanned.in_unit(Unit::Millimeter);
        let ratio = cloud.positions()[0].z / scanned.cloud.positions()[0].z;
        assert!((ratio - 10.0).abs() < 1e-12);
        assert!((millimeters.expect("an axis").center.z / truth.center.z - 10.0).abs() < 1e-12);
    }
}

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
        writeln!(obj, "f {a}//1 {b}//1 {}\r", c - 1 - positions.len() as i64).unwrap();
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
    for x in positions.iter().flat_map(|p| p.to_array()) {
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

#[test]
fn scans_that_make_no_sense_are_refused() {
    let refused = |change: fn(&mut MeshScanSettings)| {
        let mut settings = exactly(1, 0.0);
        change(&mut settings);
        settings.scan(&sphere()).expect_err("refused")
    };
    let setting = |error| match error {
        SimulateError::Setting { name, .. } => name,
        other => panic!("{other}"),
    };
    assert_eq!(setting(refused(|s| s.up = DVec3::ZERO)), "up");
    assert_eq!(setting(refused(|s| s.from = Some(DVec3::NAN))), "from");
    assert_eq!(setting(refused(|s| s.axis = Some([DVec3::X; 2]))), "axis");
    assert_eq!(setting(refused(|s| s.scan.views = 0)), "views");
    assert_eq!(setting(refused(|s| s.scan.voxel_cm = f64::NAN)), "voxel_cm");
    assert_eq!(
        refused(|s| s.from = Some(DVec3::ZERO)),
        SimulateError::LooksAtItself
    );
    assert_eq!(
        refused(|s| s.from = Some(DVec3::new(0.0, 0.0, 900.0))),
        SimulateError::NothingVisible
    );
    let meters = refused(|s| s.mesh_unit = Unit::Meter).to_string();
    assert!(
        meters.contains("800.0 cm across") && meters.contains("unit"),
        "{meters}"
    );
}
