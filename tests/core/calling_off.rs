//! Long work is called off soon, whatever it is doing.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use axiscope::geometry::{Cloud, Unit};
use axiscope::method::{CenterMethod, Observe, Params, Preset, Stage, analyze};
use axiscope::parallel::Watch;

use crate::helpers::bodies::scattered;

/// A watch that measures the longest time between two of its questions.
struct Gaps(Mutex<Longest>);

struct Longest {
    last: Instant,
    longest: Duration,
    stage: Option<Stage>,
    in_stage: Option<Stage>,
}

impl Watch for Gaps {
    fn is_cancelled(&self) -> bool {
        let mut gaps = self.0.lock().expect("no test panicked here");
        let gap = gaps.last.elapsed();
        if gap > gaps.longest {
            (gaps.longest, gaps.in_stage) = (gap, gaps.stage);
        }
        gaps.last = Instant::now();
        false
    }
}

impl Observe for Gaps {
    fn entered(&self, stage: Stage) {
        self.is_cancelled();
        self.0.lock().expect("no test panicked here").stage = Some(stage);
    }
}

/// Runs minutes; `scripts/campaign` has the shorter ones.
#[test]
#[ignore = "takes minutes, and its times need a machine of its own"]
fn no_stage_of_a_large_cloud_goes_on_for_long_without_asking() {
    let points: Vec<_> = scattered(1, 4_000_000)
        .into_iter()
        .map(|p| 4.0 * p.normalize() * (1.0 + 0.1 * p.x) + 30.0 * glam::DVec3::Z)
        .collect();
    let cloud = Cloud::new(points);
    let mut params = Params::new(Preset::AsIntended, Unit::Centimeter);
    params.filters.max_points = 1_000_000;
    for voxel_cm in [None, Some(0.01)] {
        for center in [params.center, CenterMethod::Sphere] {
            params.filters.voxel_cm = voxel_cm;
            params.center = center;
            let now = Instant::now();
            let gaps = Gaps(Mutex::new(Longest {
                last: now,
                longest: Duration::ZERO,
                stage: None,
                in_stage: None,
            }));
            params.u = 5;
            drop(analyze(&cloud, &params, &gaps));
            let gaps = gaps.0.into_inner().expect("no test panicked here");
            println!(
                "{voxel_cm:?} {center:?}: {:?} in {:?}",
                gaps.longest, gaps.in_stage
            );
            assert!(
                gaps.longest < Duration::from_millis(200),
                "{:?} in {:?}",
                gaps.longest,
                gaps.in_stage
            );
        }
    }
}
