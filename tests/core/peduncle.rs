//! The peduncle's references, the regions of lasso and brush, and selections that grow, against what they
//! are by definition.

use axiscope::geometry::{Cloud, PointSet, angle_between_lines_rad};
use axiscope::method::AxisSource;
use axiscope::peduncle::{Peduncle, PeduncleError, grown, median_spacing, shrunk};
use axiscope::render::{Camera, Viewport};
use axiscope::view::{Brush, Lasso, Region, Screen};
use glam::{DMat3, DQuat, DVec2, DVec3};
use proptest::prelude::*;

/// Half a tube along y, as a depth camera sees a peduncle: so long, so wide, with so much noise.
fn tube(length: f64, radius: f64, noise: f64) -> Vec<DVec3> {
    let mut points = Vec::new();
    for i in 0..40_u32 {
        for j in 0..12_u32 {
            let angle = std::f64::consts::PI * f64::from(j) / 11.0;
            // Neither regular nor random, and the same every time.
            let jitter = |k: u32| noise * (f64::from((i * 12 + j) * 7 + k) * 1.7).sin();
            let y = length * (f64::from(i) / 39.0 - 0.5);
            let around = DVec3::new(radius * angle.cos(), y, -radius * angle.sin());
            points.push(around + DVec3::new(jitter(1), jitter(2), jitter(3)));
        }
    }
    points
}

fn of(points: Vec<DVec3>) -> Peduncle {
    let labels = vec![Cloud::PEDUNCLE; points.len()];
    let cloud = Cloud::new(points).with_labels(labels).expect("one a point");
    Peduncle::by_label(&cloud).expect("all of it")
}

fn rotation() -> impl Strategy<Value = DMat3> {
    (-3.0..3.0, -3.0..3.0, -3.0..3.0)
        .prop_map(|(x, y, z)| DMat3::from_quat(DQuat::from_scaled_axis(DVec3::new(x, y, z))))
}

proptest! {
    #[test]
    fn the_peduncle_s_direction_turns_and_moves_with_it(turn in rotation(), far in -1e6..1e6_f64, noise in 0.0..0.03_f64) {
        let offset = DVec3::new(far, -0.5 * far, 1e6);
        let moved: Vec<DVec3> = tube(2.0, 0.25, noise).into_iter().map(|p| turn * p + offset).collect();
        let peduncle = of(moved);
        let center = offset - turn * DVec3::Y * 4.0;
        let axis = peduncle.direction_axis(center).expect("it is long");
        prop_assert_eq!(&axis.source, &AxisSource::PeduncleDirection);
        prop_assert!(axis.origin.distance(peduncle.mean) < 1e-9);
        let off = angle_between_lines_rad(axis.direction, turn * DVec3::Y).to_degrees();
        prop_assert!(off < 1.0, "{off}°");
        // Outward, whichever way the eigenvector points.
        prop_assert!(axis.direction.dot(turn * DVec3::Y) > 0.0);
        let inward = peduncle.direction_axis(offset + turn * DVec3::Y * 4.0).expect("it is long");
        prop_assert!(inward.direction.dot(turn * DVec3::Y) < 0.0);
    }

    #[test]
    fn a_lasso_takes_what_lies_inside_of_the_polygon(
        corners in prop::collection::vec((0.0..300.0_f64, 0.0..200.0_f64), 3..40),
        pixels in prop::collection::vec((-20.0..320.0_f64, -20.0..220.0_f64), 200),
    ) {
        let corners: Vec<DVec2> = corners.into_iter().map(DVec2::from).collect();
        let lasso = Lasso::new(&corners);
        for pixel in pixels.into_iter().map(DVec2::from) {
            prop_assert_eq!(lasso.contains(pixel), is_inside(&corners, pixel), "{}", pixel);
        }
    }

    #[test]
    fn a_brush_takes_what_is_within_its_radius(
        path in prop::collection::vec((0.0..300.0_f64, 0.0..200.0_f64), 1..20),
        radius in 1.0..60.0_f64,
        pixels in prop::collection::vec((-80.0..380.0_f64, -80.0..280.0_f64), 200),
    ) {
        let path: Vec<DVec2> = path.into_iter().map(DVec2::from).collect();
        let brush = Brush::new(&path, radius);
        for pixel in pixels.into_iter().map(DVec2::from) {
            let distance = path
                .windows(2)
                .map(|piece| distance_to_piece(piece[0], piece[1], pixel))
                .fold(path[0].distance(pixel), f64::min);
            // Right at the rim, rounding decides.
            if (distance - radius).abs() > 1e-9 {
                prop_assert_eq!(brush.contains(pixel), distance < radius, "{} at {}", pixel, distance);
            }
        }
    }

    #[test]
    fn taking_away_is_the_inverse_of_adding(
        corners in prop::collection::vec((0.0..400.0_f64, 0.0..300.0_f64), 3..12),
        through in any::<bool>(),
        before in prop::collection::vec(any::<bool>(), 480),
    ) {
        let points = tube(2.0, 0.25, 0.02);
        let screen = screen(&points);
        let corners: Vec<DVec2> = corners.into_iter().map(DVec2::from).collect();
        let region = Region::Lasso(Lasso::new(&corners));
        let takes = |i: usize| {
            let pixel = screen.pixel(i).expect("before the camera");
            (through || !screen.is_hidden(i)) && is_inside(&corners, pixel)
        };
        let mut added = before.clone();
        screen.mark(&region, false, through, &mut added);
        for i in 0..points.len() {
            prop_assert_eq!(added[i], before[i] || takes(i));
        }
        let mut taken = added.clone();
        screen.mark(&region, true, through, &mut taken);
        for i in 0..points.len() {
            prop_assert_eq!(taken[i], before[i] && !takes(i));
        }
    }

    #[test]
    fn growing_adds_the_neighbors_and_nothing_else(
        points in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64), 2..150),
        seeds in prop::collection::vec(0..150_usize, 0..6),
        reach in 0.01..0.6_f64,
    ) {
        let points: Vec<DVec3> = points.into_iter().map(DVec3::from).collect();
        let selected: PointSet = seeds.into_iter().filter(|&i| i < points.len()).collect();
        let near = |p: DVec3, of: &dyn Fn(usize) -> bool| {
            (0..points.len()).any(|i| of(i) && points[i].distance(p) <= reach)
        };
        let more = grown(&points, &selected, reach, &()).expect("nobody calls it off");
        let fewer = shrunk(&points, &selected, reach, &()).expect("nobody calls it off");
        for (i, &point) in points.iter().enumerate() {
            let is_in = selected.contains(i);
            prop_assert_eq!(more.contains(i), is_in || near(point, &|j| selected.contains(j)));
            prop_assert_eq!(fewer.contains(i), is_in && !near(point, &|j| !selected.contains(j)));
        }
        let farther = grown(&points, &selected, 1.5 * reach, &()).expect("nobody calls it off");
        prop_assert!(more.iter().all(|i| farther.contains(i)), "a longer reach takes no less");
    }

    #[test]
    fn a_set_of_points_is_read_as_it_was_written(indices in prop::collection::vec(0..4000_usize, 0..200)) {
        let set: PointSet = indices.iter().copied().collect();
        prop_assert_eq!(set.to_string().parse::<PointSet>(), Ok(set.clone()));
        prop_assert_eq!(PointSet::of_mask(&set.mask(4000)), set.clone());
        prop_assert!(indices.iter().all(|&i| set.contains(i)) && !set.contains(4000));
    }
}

/// The rule of even and odd, edge by edge.
fn is_inside(corners: &[DVec2], p: DVec2) -> bool {
    let mut inside = false;
    for i in 0..corners.len() {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    inside
}

fn distance_to_piece(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let along = b - a;
    if along == DVec2::ZERO {
        return a.distance(p);
    }
    let share = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    p.distance(a + share * along)
}

fn screen(points: &[DVec3]) -> Screen {
    let camera = Camera::looking_at(DVec3::new(0.0, 0.0, -8.0), DVec3::ZERO, DVec3::NEG_Y);
    Screen::new(points, &camera, Viewport::new(400.0, 300.0), 3.0)
}

#[test]
fn what_others_hide_is_not_taken_unless_through_the_cloud() {
    // Two walls, one behind the other, and a point of the far one beside the near one.
    let mut points = Vec::new();
    for z in [0.0, 2.0] {
        for i in 0..60_u32 {
            for j in 0..60_u32 {
                let at = |k: u32| 0.02 * (f64::from(k) - 30.0);
                points.push(DVec3::new(at(i), at(j), z));
            }
        }
    }
    points.push(DVec3::new(1.2, 0.0, 2.0));
    let screen = screen(&points);
    let all = [
        DVec2::ZERO,
        DVec2::new(400.0, 0.0),
        DVec2::new(400.0, 300.0),
        DVec2::new(0.0, 300.0),
    ];
    let region = Region::Lasso(Lasso::new(&all));
    let mut mask = vec![false; points.len()];
    screen.mark(&region, false, false, &mut mask);
    let taken = |mask: &[bool], range: std::ops::Range<usize>| mask[range].iter().filter(|m| **m).count();
    assert_eq!(taken(&mask, 0..3600), 3600, "the near wall");
    assert!(
        taken(&mask, 3600..7200) < 36,
        "{} of the far one",
        taken(&mask, 3600..7200)
    );
    assert!(mask[7200], "nothing lies before it");
    screen.mark(&region, false, true, &mut mask);
    assert_eq!(taken(&mask, 0..7201), 7201);
}

#[test]
fn what_is_behind_the_camera_is_never_taken() {
    let points = [DVec3::new(0.0, 0.0, -20.0), DVec3::ZERO];
    let screen = screen(&points);
    let everywhere = Region::Brush(Brush::new(
        &[DVec2::new(-500.0, 150.0), DVec2::new(900.0, 150.0)],
        900.0,
    ));
    let mut mask = [false; 2];
    screen.mark(&everywhere, false, true, &mut mask);
    assert_eq!(mask, [false, true]);
}

#[test]
fn a_peduncle_without_a_direction_says_so() {
    let center = DVec3::new(0.0, -4.0, 0.0);
    let few = of(tube(2.0, 0.25, 0.0).into_iter().take(9).collect());
    assert_eq!(
        few.direction_axis(center),
        Err(PeduncleError::TooFewForDirection { points: 9 })
    );
    let stump = of(tube(0.6, 0.25, 0.0));
    let Err(PeduncleError::NoDirection { elongation }) = stump.direction_axis(center) else {
        panic!("as wide as it is long");
    };
    assert!(elongation < Peduncle::LEAST_ELONGATION, "{elongation}");
    let point = of(vec![DVec3::ONE; 30]);
    assert!(point.direction_axis(center).is_err(), "thirty times one point");
    let line = of((0..30).map(|i| DVec3::Y * f64::from(i)).collect());
    assert_eq!(line.elongation(), f64::INFINITY);
    assert!(
        line.direction_axis(center)
            .expect("a line")
            .direction
            .distance(DVec3::Y)
            < 1e-12
    );
    // The first reference needs none of this.
    assert!(stump.reference_axis(center).is_ok() && few.reference_axis(center).is_ok());
}

#[test]
fn a_companion_gives_the_references_of_its_points() {
    let points = tube(2.0, 0.25, 0.02);
    let body: Vec<DVec3> = points.iter().map(|&p| 3.0 * p - DVec3::Y * 5.0).collect();
    let both: Vec<DVec3> = body.iter().chain(&points).copied().collect();
    let labels = (0..both.len())
        .map(|i| i32::from(i >= body.len()))
        .collect::<Vec<_>>();
    let cloud = Cloud::new(both).with_labels(labels).expect("one a point");
    let labeled = Peduncle::by_label(&cloud).expect("labeled");
    let companion = Peduncle::by_companion(&cloud, &Cloud::new(points)).expect("points");
    let center = DVec3::new(0.1, -5.0, 0.0);
    for axis in [Peduncle::reference_axis, Peduncle::direction_axis] {
        let (a, b) = (
            axis(&labeled, center).expect("an axis"),
            axis(&companion, center).expect("an axis"),
        );
        assert!(a.direction.distance(b.direction) < 1e-12);
    }
    let picked: PointSet = labeled.in_cloud.iter().copied().collect();
    let by_hand = Peduncle::by_points(&cloud, &picked)
        .expect("its points")
        .expect("some");
    assert_eq!((by_hand.mean, by_hand.spread), (labeled.mean, labeled.spread));
    assert_eq!(Peduncle::by_points(&cloud, &PointSet::default()), Ok(None));
    let beyond = Peduncle::by_points(&cloud, &[3, cloud.len()].into_iter().collect());
    let index = cloud.len();
    assert_eq!(beyond, Err(PeduncleError::NoSuchPoint { index, points: index }));
}

#[test]
fn the_spacing_is_that_of_most_points() {
    let mut grid: Vec<DVec3> = (0..400_u32)
        .map(|i| DVec3::new(f64::from(i % 20), f64::from(i / 20), 1e6))
        .collect();
    grid.push(DVec3::new(500.0, 0.0, 1e6));
    assert!((median_spacing(&grid).expect("they are apart") - 1.0).abs() < 1e-9);
    // Copies of a point are no neighbors of it.
    let twice: Vec<DVec3> = grid.iter().chain(&grid).copied().collect();
    assert!((median_spacing(&twice).expect("they are apart") - 1.0).abs() < 1e-9);
    assert_eq!(median_spacing(&[DVec3::ONE, DVec3::ONE]), None);
    assert_eq!(median_spacing(&[]), None);
}

#[test]
fn texts_that_are_no_sets_of_points_are_refused() {
    for wrong in ["5-3", "1,1", "2,1", "a", "1-", "0-4294967295", "1, 2", "-1", ","] {
        assert!(wrong.parse::<PointSet>().is_err(), "{wrong}");
    }
    assert_eq!("".parse::<PointSet>(), Ok(PointSet::default()));
    let runs: PointSet = [9, 3, 4, 5, 7, 9].into_iter().collect();
    assert_eq!(runs.to_string(), "3-5,7,9");
}
