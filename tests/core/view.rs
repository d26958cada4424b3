//! What a view shows, without a GPU: the camera's geometry, colors and legends, overlays, layout.

use crate::helpers::bodies;
use std::collections::HashMap;

use axiscope::geometry::{Cloud, Extent, Plane, Unit};
use axiscope::method::{
    Analysis, AxisEstimate, AxisSource, CenterMethod, Params, PlaneDetail, Preset, Side, analyze,
    plane_detail,
};
use axiscope::render::{Camera, Insets, Projection, Viewport};
use axiscope::view::{
    Coloring, ColoringError, NEUTRAL, Overlay, Overlays, Page, Primitive, SceneSettings, ShownPoints, Style,
    Subject, Theme, ViewPreset, build_scene, color_points, framed_points, grouped, insets, lay_out,
    round_step, value_color,
};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

const VIEWPORT: Viewport = Viewport {
    width_px: 800.0,
    height_px: 600.0,
};

fn vector(range: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-range..range).prop_map(DVec3::from_array)
}

prop_compose! {
    fn camera()(
        target in vector(50.0),
        offset in vector(30.0).prop_filter("an eye apart from its target", |v| v.length() > 1.0),
        orthographic in any::<bool>(),
        shift in (-0.5..0.5, -0.5..0.5),
    ) -> Camera {
        let mut camera = Camera::looking_at(target + offset, target, DVec3::NEG_Y);
        camera.projection = if orthographic { Projection::Orthographic } else { Projection::Perspective };
        camera.lens_shift_ndc = DVec2::from(shift);
        camera
    }
}

fn pixel() -> impl Strategy<Value = DVec2> {
    (0.0..800.0, 0.0..600.0).prop_map(DVec2::from)
}

proptest! {
    #[test]
    fn a_pixel_unprojected_and_projected_is_itself(camera in camera(), pixel in pixel(), depth in 0.5..90.0) {
        let point = camera.point_at_depth(pixel, depth, VIEWPORT);
        prop_assert!((camera.depth_of(point) - depth).abs() < 1e-8);
        let back = camera.project(point, VIEWPORT).expect("it is before the eye");
        prop_assert!((back - pixel).length() < 1e-6, "{back} for {pixel}");
        // And the matrix that the GPU gets says the same.
        let clip = camera.clip_from_world(VIEWPORT, (0.1, 100.0)) * point.extend(1.0);
        let ndc = clip.truncate() / clip.w;
        let by_matrix = DVec2::new((ndc.x + 1.0) * 400.0, (1.0 - ndc.y) * 300.0);
        prop_assert!((by_matrix - pixel).length() < 1e-6);
        prop_assert!((0.0..=1.0).contains(&ndc.z));
    }

    #[test]
    fn zooming_keeps_what_is_under_the_cursor(camera in camera(), pixel in pixel(), factor in 0.2..3.0) {
        let mut zoomed = camera;
        let point = camera.point_at_depth(pixel, camera.depth_of(camera.pivot_in_world), VIEWPORT);
        zoomed.zoom_at_pixel(pixel, factor, VIEWPORT);
        let after = zoomed.project(point, VIEWPORT).expect("still before the eye");
        prop_assert!((after - pixel).length() < 1e-6);
        let size = |c: &Camera| c.pixel_size_at(c.depth_of(c.pivot_in_world), VIEWPORT);
        prop_assert!((size(&zoomed) / size(&camera) - factor).abs() < 1e-9);
    }

    #[test]
    fn orbiting_keeps_the_distance_and_the_pivots_pixel(camera in camera(), yaw in -3.0..3.0, pitch in -3.0..3.0, pivot in vector(3.0)) {
        let mut camera = camera;
        let before = camera;
        camera.set_pivot(before.pivot_in_world + pivot);
        // Picking a pivot does not move the picture.
        prop_assert_eq!(camera.project(DVec3::ONE, VIEWPORT), before.project(DVec3::ONE, VIEWPORT));
        let distance = camera.eye_in_world.distance(camera.pivot_in_world);
        let at = camera.project(camera.pivot_in_world, VIEWPORT);
        camera.orbit(yaw, pitch);
        prop_assert!((camera.eye_in_world.distance(camera.pivot_in_world) - distance).abs() < 1e-9);
        if let (Some(at), Some(now)) = (at, camera.project(camera.pivot_in_world, VIEWPORT)) {
            prop_assert!((at - now).length() < 1e-5 * at.length().max(1e3));
        }
    }

    #[test]
    fn panning_moves_the_pivot_by_the_pixels(camera in camera(), by in pixel()) {
        let mut moved = camera;
        let start = camera.project(camera.pivot_in_world, VIEWPORT).expect("before the eye");
        moved.pan(by, VIEWPORT);
        let now = moved.project(camera.pivot_in_world, VIEWPORT).expect("before the eye");
        prop_assert!((now - start - by).length() < 1e-6);
    }

    #[test]
    fn framing_fills_the_room_between_the_insets(camera in camera(), size in vector(8.0)) {
        let mut camera = camera;
        let half = size.abs() + 0.5;
        let corners = Camera::corners(&Extent { min: -half, max: half });
        let insets = Insets { left_px: 20.0, right_px: 200.0, top_px: 30.0, bottom_px: 60.0 };
        camera.frame(&corners, VIEWPORT, insets);
        let pixels = corners.map(|c| camera.project(c, VIEWPORT).expect("before the eye"));
        let (low, high) = pixels.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
        prop_assert!(low.x > 19.99 && low.y > 29.99 && high.x < 600.01 && high.y < 540.01, "{low} {high}");
        // One way it is filled, but for what perspective takes.
        let filled = ((high.x - low.x) / 580.0).max((high.y - low.y) / 510.0);
        prop_assert!(filled > 0.5, "{filled}");
    }
}

#[test]
fn presets_look_where_they_say() {
    let points: Vec<DVec3> = bodies::scattered(3, 500)
        .iter()
        .map(|p| *p + DVec3::new(1.0, 2.0, 40.0))
        .collect();
    let axis = DVec3::new(0.1, 0.9, 0.2).normalize();
    let look = |preset: ViewPreset| {
        preset.camera(
            &points,
            DVec3::ZERO,
            axis,
            Projection::Perspective,
            VIEWPORT,
            Insets::default(),
        )
    };
    let camera = look(ViewPreset::Camera);
    assert_eq!(camera.eye_in_world, DVec3::ZERO);
    assert!(camera.up_in_world().y < -0.99);
    assert!(look(ViewPreset::Front).forward_in_world().distance(DVec3::Z) < 1e-9);
    assert!(look(ViewPreset::Side).forward_in_world().distance(DVec3::NEG_X) < 1e-9);
    assert!(look(ViewPreset::Top).forward_in_world().distance(DVec3::Y) < 1e-9);
    for preset in [ViewPreset::Normal, ViewPreset::Axis] {
        assert!(look(preset).forward_in_world().distance(axis) < 1e-9);
    }
    for preset in [
        ViewPreset::Camera,
        ViewPreset::Front,
        ViewPreset::Side,
        ViewPreset::Top,
    ] {
        for p in &points {
            let at = look(preset).project(*p, VIEWPORT).expect("before the eye");
            assert!(
                (-0.01..800.01).contains(&at.x) && (-0.01..600.01).contains(&at.y),
                "{preset:?}: {at}"
            );
        }
    }
}

/// A fruit with labels and colors, analyzed, and one point that was not used.
struct Fixture {
    cloud: Cloud,
    analysis: Analysis,
    detail: PlaneDetail,
    shown: ShownPoints,
}

fn fixture() -> Fixture {
    let view = bodies::view(7, 600);
    let points = view.points.len();
    let mut normals: Vec<glam::Vec3> = view.normals.iter().map(|n| n.as_vec3()).collect();
    normals[5] = glam::Vec3::ZERO;
    let cloud = Cloud::new(view.points)
        .with_labels((0..points).map(|i| i32::from(i % 10 == 0)).collect())
        .and_then(|c| c.with_colors(vec![[10, 20, 30, 255]; points]))
        .and_then(|c| c.with_normals(normals))
        .expect("one row a point");
    let params = Params {
        normals: axiscope::method::NormalSource::File,
        center: CenterMethod::Given(view.center),
        ..Params::new(Preset::AsIntended, Unit::Centimeter)
    };
    let analysis = analyze(&cloud, &params, &()).expect("it can be analyzed");
    let plane = Plane {
        point: analysis.center,
        normal: analysis.best.expect("there is a plane").candidate.normal,
    };
    let detail =
        plane_detail(&analysis.surface, params.unit, plane, params.viewpoint, &()).expect("not cancelled");
    let shown = ShownPoints::new(&cloud, &analysis);
    Fixture {
        cloud,
        analysis,
        detail,
        shown,
    }
}

impl Fixture {
    fn subject(&self) -> Subject<'_> {
        Subject {
            shown: &self.shown,
            analysis: &self.analysis,
            detail: Some(&self.detail),
        }
    }
}

#[test]
fn colors_say_what_the_detail_says() {
    let fixture = fixture();
    assert_eq!(fixture.shown.in_surface.get(5), None);
    let tau = fixture.analysis.params.tau_cm_per_rad;
    for coloring in [Coloring::Distance, Coloring::Angle, Coloring::Score] {
        let colored = color_points(fixture.subject(), coloring).expect("there is a plane");
        let high = colored.legend.ramp.as_ref().expect("there are values").high;
        let value = |i: usize| {
            fixture.detail.points[i].partner.map(|p| match coloring {
                Coloring::Distance => p.distance_cm,
                Coloring::Angle => p.angle_rad.to_degrees(),
                _ => p.score_cm(tau),
            })
        };
        let mut above = 0;
        let with = (0..fixture.detail.points.len()).filter_map(value).count();
        for (color, place) in colored.colors.iter().zip(fixture.shown.in_surface.iter()) {
            match place {
                None => assert_eq!(*color, NEUTRAL),
                Some(i) => {
                    if let Some(v) = value(i) {
                        assert_eq!(*color, value_color(v / high), "{coloring:?}");
                        above += usize::from(v > high);
                    }
                }
            }
        }
        assert!(
            above <= with.div_ceil(50),
            "{above} of {with} lie above the 98th percentile"
        );
        assert!(colored.legend.notes[0].contains("98th percentile"));
    }
}

#[test]
fn legends_count_every_point_once() {
    let fixture = fixture();
    for coloring in [Coloring::Side, Coloring::Partner, Coloring::Label] {
        let colored = color_points(fixture.subject(), coloring).expect("all is there");
        let mut counts: HashMap<[u8; 4], usize> = HashMap::new();
        for color in &colored.colors {
            *counts.entry(*color).or_default() += 1;
        }
        for swatch in &colored.legend.swatches {
            let (count, _) = swatch.count.expect("a category has a count");
            assert_eq!(
                counts.remove(&swatch.color).unwrap_or(0),
                count,
                "{}",
                swatch.label
            );
        }
        assert!(counts.is_empty(), "colors without a meaning");
    }
    let side = color_points(fixture.subject(), Coloring::Side).expect("there is a plane");
    let front = fixture
        .detail
        .points
        .iter()
        .filter(|p| p.side == Side::Front)
        .count();
    assert_eq!(side.legend.swatches[0].count.map(|c| c.0), Some(front));
    assert_eq!(side.legend.swatches[2].label, "not used");
}

#[test]
fn what_is_missing_is_said() {
    let fixture = fixture();
    let bare = ShownPoints::new(&Cloud::new(fixture.cloud.positions().to_vec()), &fixture.analysis);
    let subject = Subject {
        shown: &bare,
        detail: None,
        ..fixture.subject()
    };
    assert_eq!(color_points(subject, Coloring::Rgb), Err(ColoringError::NoColors));
    assert_eq!(
        color_points(subject, Coloring::Label),
        Err(ColoringError::NoLabels)
    );
    for coloring in Coloring::ALL.into_iter().filter(|c| c.needs_plane()) {
        assert_eq!(color_points(subject, coloring), Err(ColoringError::NoPlane));
    }
}

#[test]
fn each_overlay_has_a_switch() {
    let fixture = fixture();
    let colored = color_points(fixture.subject(), Coloring::Rgb).expect("it has colors");
    let reference = AxisEstimate {
        source: AxisSource::Simulation,
        origin: fixture.analysis.center,
        direction: DVec3::Y,
        confidence: None,
    };
    let scene = |overlays: &Overlays| {
        let style = Style {
            overlays: overlays.clone(),
            ..Style::default()
        };
        let settings = SceneSettings {
            style: &style,
            point_size_px: 3.0,
            plane: Some(fixture.detail.plane),
            axis: fixture.analysis.axis.as_ref(),
            reference: Some(&reference),
            references: std::slice::from_ref(&reference),
        };
        assert!(framed_points(&fixture.shown, &settings).len() > 400);
        build_scene(fixture.subject(), &colored, &settings)
    };
    let bare = scene(&Overlays::none());
    assert_eq!(
        (bare.points.len(), bare.lines.len(), bare.polygons.len()),
        (1, 0, 0)
    );
    let written = [Overlay::Legend, Overlay::Scale, Overlay::Triad, Overlay::Caption];
    for overlay in Overlay::ALL {
        let one: Overlays = overlay.name().parse().expect("its own name");
        assert_eq!(scene(&one) == bare, written.contains(&overlay), "{overlay:?}");
    }
    let ghost = scene(&"ghost".parse().expect("a name"));
    let origin = ghost.origin_in_world;
    let mirrored = fixture
        .detail
        .plane
        .reflect_point(fixture.analysis.surface.points()[0]);
    assert!((ghost.points[1].positions[0].as_dvec3() + origin).distance(mirrored) < 1e-4);
    assert!("plane,nonsense".parse::<Overlays>().is_err());
}

#[test]
fn nothing_is_cut_off_and_nothing_covers_anything() {
    let fixture = fixture();
    let caption = [
        "first line of it".to_owned(),
        "second line of it, which is longer".to_owned(),
    ];
    // Widths of a wide font.
    let measure = |text: &str, size: f64| 0.62 * size * text.chars().count() as f64;
    for (width_px, height_px) in [(1200.0, 900.0), (640.0, 480.0)] {
        for coloring in Coloring::ALL {
            let colored = color_points(fixture.subject(), coloring).expect("all is there");
            let page = Page {
                viewport: Viewport { width_px, height_px },
                theme: Theme::Light,
                legend: Some(&colored.legend),
                scale_unit: Some("cm"),
                has_triad: true,
                caption: caption.to_vec(),
                label: Some((fixture.analysis.center - 3.0 * DVec3::Y, "9.9° apart".into())),
            };
            let camera = ViewPreset::Camera.camera(
                fixture.cloud.positions(),
                DVec3::ZERO,
                DVec3::X,
                Projection::Perspective,
                page.viewport,
                insets(&page, &measure),
            );
            let mut boxes: Vec<(DVec2, DVec2, String)> = Vec::new();
            for primitive in lay_out(&page, &camera, &measure) {
                let Primitive::Text {
                    at,
                    anchor,
                    size_px,
                    text,
                    ..
                } = primitive
                else {
                    continue;
                };
                let width = measure(&text, size_px);
                let left = match anchor {
                    axiscope::view::Anchor::Start => at.x,
                    axiscope::view::Anchor::Middle => at.x - 0.5 * width,
                    axiscope::view::Anchor::End => at.x - width,
                };
                let (min, max) = (
                    DVec2::new(left, at.y - 0.75 * size_px),
                    DVec2::new(left + width, at.y + 0.2 * size_px),
                );
                assert!(
                    min.min_element() >= 0.0 && max.x <= width_px && max.y <= height_px,
                    "{text}"
                );
                for (other_min, other_max, other) in &boxes {
                    let apart = min.cmpge(*other_max).any() || other_min.cmpge(max).any();
                    assert!(apart, "“{text}” covers “{other}” ({coloring:?})");
                }
                boxes.push((min, max, text));
            }
            assert!(boxes.len() >= 7);
        }
    }
}

#[test]
fn ticks_are_round_and_few() {
    for (most, count, expected) in [
        (1.0, 4.0, 0.5),
        (0.9, 5.0, 0.2),
        (37.0, 4.0, 10.0),
        (2.0, 2.0, 1.0),
    ] {
        assert!(
            (round_step(most, count) - expected).abs() < 1e-12,
            "{most} {count}"
        );
    }
}

#[test]
fn thousands_are_parted() {
    let texts = [0, 999, 1000, 1_234_567].map(grouped);
    assert_eq!(texts, ["0", "999", "1,000", "1,234,567"]);
}
