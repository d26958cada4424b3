//! Long work is called off soon, whatever it is doing.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use axiscope::geometry::{Cloud, Unit};
use axiscope::glam::DVec3;
use axiscope::method::{CenterMethod, Observe, Params, Preset, Stage, analyze};
use axiscope::parallel::Watch;

use crate::helpers::bodies::scattered;

/// A watch that measures the longest time between two of its questions in each stage.
struct Gaps(Mutex<(Instant, Vec<(Stage, Duration)>)>);

impl Watch for Gaps {
    fn is_cancelled(&self) -> bool {
        let mut gaps = self.0.lock().expect("no test panicked here");
        let (last, stages) = &mut *gaps;
        if let Some((_, longest)) = stages.last_mut() {
            *longest = last.elapsed().max(*longest);
        }
        *last = Instant::now();
        false
    }
}

impl Observe for Gaps {
    fn entered(&self, stage: Stage) {
        self.is_cancelled();
        let mut gaps = self.0.lock().expect("no test panicked here");
        gaps.1.push((stage, Duration::ZERO));
    }
}

#[test]
#[ignore = "takes minutes, and its times need a machine of its own"]
fn no_stage_of_a_large_cloud_goes_on_for_long_without_asking() {
    let on_a_body = |p: DVec3| 4.0 * p.normalize() * (1.0 + 0.1 * p.x) + 30.0 * DVec3::Z;
    let cloud = Cloud::new(scattered(1, 4_000_000).into_iter().map(on_a_body).collect());
    let mut params = Params::new(Preset::AsIntended, Unit::Centimeter);
    params.u = 5;
    params.filters.max_points = 300_000;
    for (voxel_cm, center) in [
        (None, params.center),
        (Some(0.01), params.center),
        (None, CenterMethod::Sphere),
    ] {
        params.filters.voxel_cm = voxel_cm;
        params.center = center;
        let gaps = Gaps(Mutex::new((Instant::now(), Vec::new())));
        analyze(&cloud, &params, &gaps).expect("an analysis");
        let (_, gaps) = gaps.0.into_inner().expect("no test panicked here");
        println!("{voxel_cm:?}: {gaps:?}");
        for (stage, gap) in gaps {
            assert!(gap < Duration::from_millis(200), "{gap:?} in {stage:?}");
        }
    }
}
