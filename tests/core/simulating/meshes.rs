//! Scans of meshes from elsewhere: points on the surface, and an axis that stays with them.

use axiscope::geometry::Unit;
use axiscope::simulate::{MeshScanSettings, ScanSettings, ScannedMesh, SimulateError, TriangleMesh};
use glam::DVec3;

use super::exact;

const RADIUS: f64 = 4.0;

/// An ellipsoid of revolution about y with the half-axes `across` and `along`, whose coordinates are exact in 32 bits, as
/// vertices and triangles.
pub(super) fn ellipsoid(across: f64, along: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
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
pub(super) fn exactly(views: u32, arc_deg: f64) -> MeshScanSettings {
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
