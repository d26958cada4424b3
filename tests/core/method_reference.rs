//! Agreement with plane terms that were computed from the paper's equations in another language
//! (`tests/fixtures/make_reference.py`).

use std::path::Path;

use axiscope::fruit::read_cloud;
use axiscope::geometry::Unit;
use axiscope::method::{Aggregation, CandidateGrid, Ranking, Surface, TAU_CM_PER_RAD, plane_terms};
use glam::DVec3;
use serde::Deserialize;

#[derive(Deserialize)]
struct Case {
    file: String,
    unit_in_cm: f64,
    center: DVec3,
    viewpoint: DVec3,
    grids: Vec<Grid>,
}

#[derive(Deserialize)]
struct Grid {
    u: usize,
    /// n, ΣD in centimeters, ΣΞ in radians.
    planes: Vec<(usize, f64, f64)>,
    best_sum: usize,
    best_mean: usize,
}

fn close(ours: f64, theirs: f64, tolerance: f64) -> bool {
    (ours - theirs).abs() <= tolerance * theirs.abs()
}

#[test]
fn every_plane_s_terms_and_the_winners_agree() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let text = std::fs::read_to_string(folder.join("expected.json")).unwrap();
    let cases: Vec<Case> = serde_json::from_str(&text).unwrap();
    assert_eq!(cases.iter().map(|c| c.grids.len()).sum::<usize>(), 3);
    for case in cases {
        let cloud = read_cloud(folder.join(&case.file)).unwrap().ply.cloud;
        let unit = Unit::ALL
            .into_iter()
            .find(|u| u.in_cm() == case.unit_in_cm)
            .unwrap();
        let surface = Surface::with_file_normals(&cloud).unwrap();
        for expected in case.grids {
            let grid = CandidateGrid::new(expected.u).unwrap();
            let ours = plane_terms(&surface, unit, case.center, case.viewpoint, grid, &()).unwrap();
            assert_eq!(ours.terms.len(), expected.planes.len());
            for (i, (ours, &(n, d, xi))) in ours.terms.iter().zip(&expected.planes).enumerate() {
                let at = format!(
                    "{} u {} plane {i}: {ours:?} against {n} {d} {xi}",
                    case.file, expected.u
                );
                assert!(ours.partners.abs_diff(n) as f64 <= 0.001 * n as f64, "{at}");
                assert!(close(ours.distance_sum_cm, d, 1e-3), "{at}");
                assert!(close(ours.angle_sum_rad, xi, 1e-3), "{at}");
            }
            let best = |aggregation: Aggregation| {
                let least = aggregation.default_min_partner_fraction();
                Ranking::new(&ours, TAU_CM_PER_RAD, aggregation, least)
                    .best()
                    .unwrap()
            };
            assert_eq!(best(Aggregation::Sum), expected.best_sum, "{}", case.file);
            assert_eq!(best(Aggregation::Mean), expected.best_mean, "{}", case.file);
        }
    }
}
