//! The kept results of stages: the same analysis as from nothing, without the work that was done before.

use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex};

use axiscope::geometry::{Cloud, Unit};
use axiscope::method::{
    Aggregation, Analysis, CenterMethod, Filters, NormalSource, Observe, OutlierFilter, Params, Preset,
    RandomSearch, Stage, Stages, analyze,
};
use axiscope::parallel::Watch;
use glam::DVec3;
use proptest::prelude::*;
use proptest::sample::select;

use crate::helpers::bodies::view;

/// A small cloud with normals of its own, some of which are missing.
fn cloud(seed: u64) -> Cloud {
    let v = view(seed, 260);
    let normals = v.normals.iter().enumerate();
    let normals = normals.map(|(i, n)| {
        if i % 40 == 7 {
            glam::Vec3::ZERO
        } else {
            n.as_vec3()
        }
    });
    Cloud::new(v.points).with_normals(normals.collect()).unwrap()
}

fn k(k: usize) -> NonZeroUsize {
    NonZeroUsize::new(k).unwrap()
}

fn search(seed: u64) -> RandomSearch {
    RandomSearch {
        count: 60,
        spread: 1.0,
        seed,
    }
}

fn params() -> Params {
    Params {
        center: CenterMethod::Equidistant(search(0)),
        ..Params::new(Preset::AsIntended, Unit::Centimeter)
    }
}

/// A change of one setting, among few values, so that a sequence of them often comes back to one.
#[derive(Debug, Clone)]
enum Change {
    U(usize),
    Tau(f64),
    Aggregation(Aggregation),
    PartnerFraction(f64),
    Unit(Unit),
    Normals(NormalSource),
    K(usize),
    Center(CenterMethod),
    Viewpoint(DVec3),
    Filters(Filters),
}

impl Change {
    fn apply(&self, params: &mut Params) {
        match *self {
            Self::U(u) => params.u = u,
            Self::Tau(tau) => params.tau_cm_per_rad = tau,
            Self::Aggregation(aggregation) => params.aggregation = aggregation,
            Self::PartnerFraction(fraction) => params.min_partner_fraction = fraction,
            Self::Unit(unit) => params.unit = unit,
            Self::Normals(normals) => params.normals = normals,
            Self::K(neighbors) => params.k = k(neighbors),
            Self::Center(center) => params.center = center,
            Self::Viewpoint(viewpoint) => params.viewpoint = viewpoint,
            Self::Filters(filters) => params.filters = filters,
        }
    }
}

fn change_of_scores() -> impl Strategy<Value = Change> {
    prop_oneof![
        (0.0..4.0f64).prop_map(Change::Tau),
        select(vec![Aggregation::Mean, Aggregation::Sum]).prop_map(Change::Aggregation),
        (0.0..=1.0f64).prop_map(Change::PartnerFraction),
    ]
}

fn any_change() -> impl Strategy<Value = Change> {
    let centers = vec![
        CenterMethod::MeanRms(search(0)),
        CenterMethod::Equidistant(search(0)),
        CenterMethod::Equidistant(search(1)),
        CenterMethod::Sphere,
        CenterMethod::Given(DVec3::new(1.5, -2.0, 30.0)),
        CenterMethod::Given(DVec3::new(1.0, -1.0, 31.0)),
    ];
    // The second lies inside the cloud's box, the third among the points of a body that surrounds it.
    let viewpoints = vec![
        DVec3::ZERO,
        DVec3::new(0.0, 1.0, -4.0),
        DVec3::new(1.5, -2.0, 29.0),
    ];
    let none = Filters::default();
    let filters = vec![
        none,
        Filters {
            voxel_cm: Some(0.4),
            ..none
        },
        Filters {
            max_points: 150,
            ..none
        },
        Filters {
            outliers: Some(OutlierFilter {
                neighbors: k(8),
                std_ratio: 1.5,
            }),
            ..none
        },
    ];
    prop_oneof![
        change_of_scores(),
        // Four is out of range.
        select(vec![4, 5, 6, 7]).prop_map(Change::U),
        select(Unit::ALL.to_vec()).prop_map(Change::Unit),
        select(vec![NormalSource::Estimate, NormalSource::File]).prop_map(Change::Normals),
        // The last is more than there are points.
        select(vec![6, 12, 400]).prop_map(Change::K),
        select(centers).prop_map(Change::Center),
        select(viewpoints).prop_map(Change::Viewpoint),
        select(filters).prop_map(Change::Filters),
    ]
}

/// Records the stages that begin.
#[derive(Default)]
struct Recorder(Mutex<Vec<Stage>>);

impl Watch for Recorder {}

impl Observe for Recorder {
    fn entered(&self, stage: Stage) {
        self.0.lock().unwrap().push(stage);
    }
}

/// The analysis, and the stages that began for it.
fn analyze_recorded(stages: &mut Stages, params: &Params) -> (Analysis, Vec<Stage>) {
    let recorder = Recorder::default();
    let analysis = stages.analyze(params, &recorder).unwrap();
    (analysis, recorder.0.into_inner().unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_sequence_of_settings_gives_the_analysis_of_a_fresh_start(
        seed in 0u64..1000, changes in prop::collection::vec(any_change(), 1..14),
    ) {
        let cloud = cloud(seed);
        let (mut stages, mut params) = (Stages::new(cloud.clone()), params());
        for change in changes {
            change.apply(&mut params);
            let kept = stages.analyze_kept(&params);
            let fresh = analyze(&cloud, &params, &());
            prop_assert_eq!(&stages.analyze(&params, &()), &fresh, "after {:?}", change);
            if let Some(kept) = kept {
                prop_assert_eq!(Ok(kept), fresh);
            }
        }
    }

    #[test]
    fn changes_of_scores_repeat_no_other_stage(
        seed in 0u64..1000, before in prop::collection::vec(any_change(), 0..6),
        changes in prop::collection::vec(change_of_scores(), 1..6),
    ) {
        let (mut stages, mut params) = (Stages::new(cloud(seed)), params());
        for change in &before {
            change.apply(&mut params);
        }
        let Ok(first) = stages.analyze(&params, &()) else {
            return Ok(());
        };
        for change in changes {
            change.apply(&mut params);
            prop_assert!(stages.analyze_kept(&params).is_some(), "{change:?}");
            let (analysis, entered) = analyze_recorded(&mut stages, &params);
            prop_assert_eq!(&entered[..], [Stage::Scores], "{:?}", change);
            prop_assert!(Arc::ptr_eq(&analysis.surface, &first.surface));
            prop_assert!(Arc::ptr_eq(&analysis.planes, &first.planes));
        }
    }
}

#[test]
fn a_change_repeats_the_stages_that_depend_on_it_and_no_other() {
    use Stage::{Center, Normals, PlaneTerms, Scores};
    let all = &[Stage::Filters, Normals, Center, PlaneTerms, Scores][..];
    let voxel = |edge| Filters {
        voxel_cm: edge,
        ..Filters::default()
    };
    let given = |z| CenterMethod::Given(DVec3::new(1.5, -2.0, z));
    let steps: [(Change, &[Stage]); 18] = [
        (Change::U(6), all),
        (Change::U(7), &[PlaneTerms, Scores]),
        (Change::U(6), &[Scores]),
        (Change::Unit(Unit::Millimeter), &[PlaneTerms, Scores]),
        (Change::Unit(Unit::Centimeter), &[Scores]),
        (Change::Center(given(30.0)), &[PlaneTerms, Scores]),
        (Change::Center(given(30.5)), &[PlaneTerms, Scores]),
        // A dragged center does not push out the one that took a search.
        (Change::Center(CenterMethod::Equidistant(search(0))), &[Scores]),
        (
            Change::Center(CenterMethod::Equidistant(search(1))),
            &[Center, PlaneTerms, Scores],
        ),
        (Change::K(12), all),
        (Change::Viewpoint(DVec3::new(0.0, 1.0, -4.0)), all),
        (Change::Normals(NormalSource::File), all),
        // Neighbors are not looked for.
        (Change::K(8), &[Scores]),
        (Change::Filters(voxel(Some(0.4))), all),
        // The edge is given in centimeters: in another unit it is another one.
        (Change::Unit(Unit::Millimeter), all),
        (Change::Unit(Unit::Centimeter), all),
        (Change::Filters(voxel(None)), all),
        (Change::Tau(0.5), &[Scores]),
    ];
    let (mut stages, mut params) = (Stages::new(cloud(3)), params());
    for (step, (change, expected)) in steps.iter().enumerate() {
        change.apply(&mut params);
        let (_, entered) = analyze_recorded(&mut stages, &params);
        assert_eq!(entered, *expected, "step {step}: {change:?}");
    }
}

#[test]
fn grids_are_kept_and_the_oldest_goes_first() {
    let (mut stages, mut params) = (Stages::new(cloud(3)), params());
    for u in 5..18 {
        params.u = u;
        stages.analyze(&params, &()).unwrap();
    }
    let is_kept = |u| stages.analyze_kept(&Params { u, ..params.clone() }).is_some();
    assert!((6..18).all(is_kept), "twelve are");
    assert!(!is_kept(5));
}

#[test]
fn any_plane_s_axis_is_that_of_eq_16() {
    let analysis = analyze(&cloud(3), &params(), &()).unwrap();
    let best = analysis.best.unwrap();
    assert_eq!(analysis.axis_of(best.index).ok(), analysis.axis);
    for (index, candidate) in analysis.planes.grid.candidates().enumerate() {
        let plane = analysis.plane(index);
        assert_eq!((plane.point, plane.normal), (analysis.center, candidate.normal));
        let expected =
            axiscope::method::symmetry_axis(candidate.normal, analysis.center, analysis.params.viewpoint);
        let axis = analysis.axis_of(index);
        assert_eq!(
            axis.as_ref().map(|axis| axis.direction),
            expected.as_ref().copied()
        );
        assert_eq!(axis.map(|axis| axis.origin), expected.map(|_| analysis.center));
    }
}
