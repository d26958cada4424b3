//! Pictures drawn by the software driver, and the command `render` from end to end.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use axiscope::render::{
    Background, Camera, DrawError, Extract, EyeDome, Gpu, Image, Line, Points, Polygon, SHADERS, Scene,
    Viewport, draw_extract, draw_image,
};
use glam::{DVec3, Vec3};
use wgpu::naga;

const BACKGROUND: [u8; 4] = [20, 30, 40, 255];
const RED: [u8; 4] = [220, 40, 30, 255];
const BLUE: [u8; 4] = [20, 60, 230, 255];
const SIDE: u32 = 101;

fn scene(points: &[(Vec3, [u8; 4])], size_px: f32) -> Scene {
    let mut scene = Scene::empty(Background {
        top: BACKGROUND,
        bottom: BACKGROUND,
    });
    // Far from zero, where f32 alone would be too coarse.
    scene.origin_in_world = ORIGIN;
    scene.points.push(Points {
        positions: points.iter().map(|p| p.0).collect(),
        colors: points.iter().map(|p| p.1).collect(),
        size_px,
        ..Points::default()
    });
    scene.fit_bounds();
    scene.bounds.radius += 5.0;
    scene
}

const ORIGIN: DVec3 = DVec3::new(4e6, -2e6, 1e6);

fn camera() -> Camera {
    Camera::looking_at(ORIGIN - 20.0 * DVec3::Z, ORIGIN, DVec3::NEG_Y)
}

fn drawn(scene: &Scene) -> Image {
    let gpu = Gpu::software().expect("the software driver is installed");
    draw_image(&gpu, scene, &camera(), SIDE, SIDE).expect("it draws")
}

fn at(image: &Image, x: u32, y: u32) -> [u8; 4] {
    image.pixel(x, y).expect("inside")
}

#[test]
fn a_point_is_a_disc_of_its_color_at_its_pixel() {
    let place = Vec3::new(1.0, 0.7, 0.3);
    let image = drawn(&scene(&[(place, RED)], 20.0));
    let side = f64::from(SIDE);
    let middle = camera()
        .project(ORIGIN + place.as_dvec3(), Viewport::new(side, side))
        .expect("before the eye");
    let (mut area, mut sum) = (0.0, glam::DVec2::ZERO);
    for y in 0..SIDE {
        for x in 0..SIDE {
            let pixel = at(&image, x, y);
            let from_middle = glam::DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - middle;
            if from_middle.length() < 9.0 {
                assert_eq!(pixel, RED, "{x} {y}");
            }
            if from_middle.length() > 11.0 {
                assert_eq!(pixel, BACKGROUND, "{x} {y}");
            }
            let share = (f64::from(pixel[0]) - 20.0) / 200.0;
            area += share;
            sum += share * from_middle;
        }
    }
    assert!((sum / area).length() < 0.3, "its middle is off by {}", sum / area);
    assert!(
        (area / (std::f64::consts::PI * 100.0) - 1.0).abs() < 0.03,
        "area {area}"
    );
}

#[test]
fn the_nearer_point_hides_the_farther_whatever_their_order() {
    let (near, far) = ((Vec3::new(0.0, 0.0, -3.0), RED), (Vec3::new(0.0, 0.0, 3.0), BLUE));
    for points in [[near, far], [far, near]] {
        assert_eq!(at(&drawn(&scene(&points, 12.0)), 50, 50), RED);
    }
}

#[test]
fn a_plane_shines_over_points_and_hides_nothing_before_it() {
    let mut scene = scene(
        &[(Vec3::new(0.0, 0.0, 3.0), BLUE), (Vec3::new(2.0, 0.0, -3.0), RED)],
        16.0,
    );
    let corner = |x: f64, y: f64| ORIGIN + DVec3::new(x, y, 0.0);
    scene.polygons.push(Polygon {
        corners_in_world: vec![
            corner(-4.0, -4.0),
            corner(4.0, -4.0),
            corner(4.0, 4.0),
            corner(-4.0, 4.0),
        ],
        color: [255, 255, 255, 128],
    });
    let image = drawn(&scene);
    let blended = at(&image, 50, 50);
    for channel in 0..3 {
        let expected = f64::midpoint(f64::from(BLUE[channel]), 255.0);
        assert!(
            (f64::from(blended[channel]) - expected).abs() <= 2.0,
            "{blended:?}"
        );
    }
    let red = camera()
        .project(ORIGIN + DVec3::new(2.0, 0.0, -3.0), Viewport::new(101.0, 101.0))
        .expect("before the eye");
    assert_eq!(at(&image, red.x as u32, red.y as u32), RED);
}

#[test]
fn lines_are_hidden_by_points_unless_they_shine_through() {
    let green = [0, 200, 0, 255];
    for (opacity, expected) in [(0.0, RED), (1.0, green)] {
        let mut scene = scene(&[(Vec3::ZERO, RED)], 16.0);
        let behind = ORIGIN + 3.0 * DVec3::Z;
        scene.lines.push(
            Line::new(behind - 4.0 * DVec3::X, behind + 4.0 * DVec3::X, green, 4.0).shining_through(opacity),
        );
        let image = drawn(&scene);
        assert_eq!(at(&image, 50, 50), expected);
        assert_eq!(at(&image, 75, 50), green);
        assert_eq!(at(&image, 75, 56), BACKGROUND);
    }
}

#[test]
fn eye_dome_lighting_darkens_what_lies_behind_an_edge() {
    let mut points: Vec<(Vec3, [u8; 4])> = Vec::new();
    for i in -40..=40 {
        for j in -40..=40_i16 {
            let depth = if i < 0 { -1.0 } else { 1.0 };
            points.push((
                Vec3::new(f32::from(i as i16) * 0.1, f32::from(j) * 0.1, depth),
                RED,
            ));
        }
    }
    let mut scene = scene(&points, 6.0);
    assert_eq!(at(&drawn(&scene), 56, 50), RED);
    scene.eye_dome = EyeDome {
        strength: 1.0,
        scale: 4.0,
    };
    let image = drawn(&scene);
    assert_eq!(at(&image, 30, 50), RED);
    let darkest = (45..60).map(|x| at(&image, x, 50)[0]).min();
    assert!((60..200).contains(&darkest.unwrap_or(0)), "{darkest:?}");
}

#[test]
fn a_thinned_cloud_is_an_even_part_of_it() {
    let points: Vec<(Vec3, [u8; 4])> = (0..1000_u16)
        .map(|i| (Vec3::new(f32::from(i) * 0.008 - 4.0, 0.0, 0.0), RED))
        .collect();
    let scene = scene(&points, 1.0);
    let gpu = Gpu::software().expect("the software driver is installed");
    let thinned = |points| Extract {
        points,
        ..Extract::whole([101, 101], 2)
    };
    let image = draw_extract(&gpu, &scene, &camera(), &[thinned(0..20)]).expect("can be drawn");
    let red = |x: &u32| (48..53).any(|y| at(&image, *x, y) != BACKGROUND);
    let (left, right) = ((0..50).filter(red).count(), (50..101).filter(red).count());
    assert!(
        (8..=26).contains(&left) && left.abs_diff(right) <= 4,
        "{left} and {right}"
    );
}

#[test]
fn a_picture_that_comes_little_by_little_is_the_whole_one() {
    // Spheres of points around a line and a plane, so that depth and overlays matter.
    let points: Vec<(Vec3, [u8; 4])> = (0..600_u16)
        .map(|i| {
            let (a, b) = (f32::from(i) * 0.37, f32::from(i) * 0.011);
            let place = Vec3::new(3.0 * a.sin() * b.cos(), 3.0 * a.cos() * b.cos(), 3.0 * b.sin());
            (place, if i % 2 == 0 { RED } else { BLUE })
        })
        .collect();
    let mut scene = scene(&points, 9.0);
    scene.eye_dome = EyeDome {
        strength: 1.0,
        scale: 4.0,
    };
    scene.lines.push(Line::new(
        DVec3::new(-4.0, -4.0, -4.0),
        DVec3::new(4.0, 4.0, 4.0),
        BLUE,
        4.0,
    ));
    let gpu = Gpu::software().expect("the software driver is installed");
    let part = |points| Extract {
        points,
        ..Extract::whole([SIDE, SIDE], 1)
    };
    let draw = |parts: &[Extract]| draw_extract(&gpu, &scene, &camera(), parts).expect("it draws");
    let whole = draw(&[part(0..usize::MAX)]);
    assert_eq!(draw(&[part(0..100), part(100..350), part(350..600)]), whole);
    assert_ne!(
        draw(&[part(0..100), part(100..350)]),
        whole,
        "something is missing"
    );
    // From the beginning means anew.
    assert_eq!(draw(&[part(0..600), part(0..100)]), draw(&[part(0..100)]));
}

#[test]
fn sizes_are_checked() {
    let gpu = Gpu::software().expect("the software driver is installed");
    for (width, height) in [(0, 10), (10, 0), (16_385, 10)] {
        let result = draw_image(&gpu, &scene(&[], 1.0), &camera(), width, height);
        assert!(matches!(result, Err(DrawError::Size { .. })), "{width} {height}");
    }
    let image = draw_image(&gpu, &scene(&[], 1.0), &camera(), 1, 1).expect("one pixel is a picture");
    assert_eq!(image.rgba, BACKGROUND);
}

#[test]
fn every_shader_is_valid() {
    let (_, view) = SHADERS[0];
    for (name, text) in &SHADERS[1..] {
        let module = naga::front::wgsl::parse_str(&format!("{view}\n{text}")).expect(name);
        let flags = naga::valid::ValidationFlags::all();
        naga::valid::Validator::new(flags, naga::valid::Capabilities::empty())
            .validate(&module)
            .expect(name);
    }
}

fn fixture() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/tapered_m.ply")
}

/// Exit status and standard error.
fn render(folder: &Path, args: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin("axiscope")
        .expect("the binary is built")
        .current_dir(folder)
        .env("WGPU_ADAPTER_NAME", "llvmpipe")
        .arg("render")
        .args(args)
        .output()
        .expect("it runs");
    (
        output.status.code().expect("no signal ended it"),
        String::from_utf8_lossy(&output.stderr).into_owned(),
    )
}

#[test]
fn a_picture_carries_its_settings_and_is_drawn_again_from_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let cloud = folder.path().join("fruit.ply");
    std::fs::copy(fixture(), &cloud).expect("copied");
    let (status, err) = render(
        folder.path(),
        &[
            "fruit.ply",
            "-o",
            "a.png",
            "--size",
            "320x240",
            "--color",
            "score",
            "--plane",
            "2,3",
            "--unit",
            "m",
        ],
    );
    assert_eq!(status, 0, "{err}");
    let first = std::fs::read(folder.path().join("a.png")).expect("written");
    let settings = axiscope::view::picture_settings(&first).expect("it carries them");
    assert_eq!(settings.cloud, "fruit.ply");
    assert_eq!(settings.sha256.len(), 64);
    assert!(settings.arguments.contains(&"2,3".to_owned()));

    let (status, err) = render(folder.path(), &["--from", "a.png", "-o", "b.png"]);
    assert_eq!(status, 0, "{err}");
    assert!(!err.contains("changed"), "{err}");
    let second = std::fs::read(folder.path().join("b.png")).expect("written");
    assert!(first == second, "the same settings gave another picture");

    let mut bytes = std::fs::read(&cloud).expect("there");
    bytes.push(b'\n');
    std::fs::write(&cloud, bytes).expect("written");
    let (status, err) = render(folder.path(), &["--from", "a.png", "-o", "c.png"]);
    assert_eq!(status, 0, "{err}");
    assert!(err.contains("has changed since"), "{err}");

    std::fs::remove_file(&cloud).expect("removed");
    let (status, err) = render(folder.path(), &["--from", "a.png", "-o", "d.png"]);
    assert_eq!(status, 1);
    assert!(err.contains("fruit.ply"), "{err}");
}

#[test]
fn wrong_usage_and_unusable_input_are_told_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let cloud = fixture();
    let cloud = cloud.to_str().expect("UTF-8");
    for wrong in [
        ["--size", "0x10"],
        ["--size", "20000x10"],
        ["--size", "wide"],
        ["--overlays", "plane,nonsense"],
        ["--plane", "7,1"],
        ["--color", "pretty"],
        ["--point-size", "-1"],
        ["--from", "other.png"],
    ] {
        let (status, err) = render(
            folder.path(),
            &[
                cloud, "-o", "x.png", "--unit", "m", wrong[0], wrong[1], "--view", "top",
            ],
        );
        assert_eq!(status, 2, "{wrong:?}: {err}");
        assert!(!folder.path().join("x.png").exists());
    }
    std::fs::write(folder.path().join("no.png"), b"no PNG").expect("written");
    let (status, err) = render(folder.path(), &["--from", "no.png", "-o", "x.png"]);
    assert_eq!(status, 1);
    assert!(err.contains("no PNG file"), "{err}");
}
