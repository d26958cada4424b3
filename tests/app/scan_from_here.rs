//! Scans by a depth camera in the place of the view's eye.

use axiscope::app::{Command, State};
use axiscope::render::Camera;
use glam::DVec3;

use crate::helpers::driving::{act, app};

/// A box of 8 by 6 by 4 cm about the origin in meters: eight corners, six faces of four.
const BOX_M: &str = "ply
format ascii 1.0
comment unit: m
element vertex 8
property float x
property float y
property float z
element face 6
property list uchar int vertex_indices
end_header
-0.04 -0.03 -0.02
0.04 -0.03 -0.02
0.04 0.03 -0.02
-0.04 0.03 -0.02
-0.04 -0.03 0.02
0.04 -0.03 0.02
0.04 0.03 0.02
-0.04 0.03 0.02
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 2 3 7 6
4 1 2 6 5
4 0 4 7 3
";
const HALF_CM: DVec3 = DVec3::new(4.0, 3.0, 2.0);

/// The positions in the view, whether or not they could be analyzed.
fn shown(state: &State) -> Vec<DVec3> {
    let shown = state.look.as_ref().expect("something is shown");
    shown.shown.positions.to_vec()
}

#[test]
fn a_mesh_is_scanned_by_its_faces_and_not_by_its_corners() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("box.ply");
    std::fs::write(&path, BOX_M).expect("written");
    let mut app = app();
    act(&mut app, Command::Open(vec![path]));
    assert_eq!(shown(app.state()).len(), 8, "its corners are the cloud");
    let camera = Camera::looking_at(DVec3::new(0.3, -0.2, -0.5), DVec3::ZERO, DVec3::NEG_Y);
    act(&mut app, Command::Camera(Box::new(camera)));
    act(&mut app, Command::ScanFromHere);
    assert_eq!(app.state().entries.len(), 2);
    let seen = shown(app.state());
    assert!(seen.len() > 1500, "{} points", seen.len());
    let mut on_faces = [0; 6];
    for p in &seen {
        assert!(p.z > 0.0, "before the camera");
        let in_view = DVec3::new(p.x, -p.y, -p.z);
        let at_cm = 100.0 * (camera.eye_in_world + camera.world_from_view * in_view);
        let over = at_cm.abs() - HALF_CM;
        // The camera's noise at 60 cm, and its steps of a millimeter.
        assert!(over.max_element().abs() < 0.8, "{at_cm} lies on a face");
        for axis in 0..3 {
            let mut elsewhere = over;
            elsewhere[axis] = f64::NEG_INFINITY;
            // Away from the edges, a point is of one face.
            if over[axis].abs() < 0.3 && elsewhere.max_element() < -0.4 {
                on_faces[2 * axis + usize::from(at_cm[axis] > 0.0)] += 1;
            }
        }
    }
    // The camera is at x > 0, y < 0, z < 0.
    assert!(
        on_faces[1] > 100 && on_faces[2] > 100 && on_faces[4] > 500,
        "{on_faces:?}"
    );
    assert_eq!((on_faces[0], on_faces[3], on_faces[5]), (0, 0, 0), "hidden faces");
}
