//! Simulated clouds: what is known about them is true, and the same seed gives the same cloud.

mod camera;
mod ellipsoid;
mod mesh_files;
mod meshes;
mod pepper;
mod scans;
mod seeds;
mod seen_points;
mod truth;

use axiscope::simulate::{DepthCamera, PepperSettings, Settings, SimulateError, Simulated, Truth};
use glam::{DVec2, DVec3};

fn pepper(seed: u64) -> PepperSettings {
    PepperSettings {
        seed,
        ..PepperSettings::default()
    }
}

/// A camera without errors.
fn exact() -> DepthCamera {
    DepthCamera {
        noise_cm: 0.0,
        step_cm: 0.0,
        grazing_deg: 90.0,
        dropout: 0.0,
        ..DepthCamera::default()
    }
}

/// An upright pepper straight ahead that is its own mirror image, before a camera without errors.
fn perfect(seed: u64) -> PepperSettings {
    PepperSettings {
        asymmetry: 0.0,
        tilt_towards_camera_deg: Some(0.0),
        tilt_sideways_deg: Some(0.0),
        center_cm: Some(DVec3::new(0.0, 0.0, 40.0)),
        camera: exact(),
        ..pepper(seed)
    }
}

fn simulate(settings: &PepperSettings) -> Simulated {
    settings.simulate().expect("a pepper in view")
}

fn labelled(simulated: &Simulated, label: i32) -> Vec<DVec3> {
    let labels = simulated.cloud.labels().expect("labels");
    let rows = labels.iter().zip(simulated.cloud.positions());
    rows.filter(|(l, _)| **l == label).map(|(_, p)| *p).collect()
}

fn settings_of(truth: &Truth) -> &PepperSettings {
    match &truth.settings {
        Settings::Pepper(settings) => settings,
        _ => panic!("not a pepper"),
    }
}

/// Where the camera of these settings sees a point, in pixels.
fn pixel(camera: &DepthCamera, p: DVec3) -> DVec2 {
    let middle = DVec2::new(f64::from(camera.width_px - 1), f64::from(camera.height_px - 1)) / 2.0;
    p.truncate() / p.z * camera.focal_px + middle
}

fn whole(pixel: DVec2) -> (i64, i64) {
    (pixel.x.round() as i64, pixel.y.round() as i64)
}

/// The root mean square difference of depths.
fn rms(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    let sum: f64 = a.iter().zip(b).map(|(p, q)| (p.z - q.z).powi(2)).sum();
    (sum / a.len() as f64).sqrt()
}

/// The name of the setting that was refused.
fn refused(result: Result<Simulated, SimulateError>) -> &'static str {
    match result {
        Err(SimulateError::Setting { name, .. }) => name,
        other => panic!("not refused for a setting: {:?}", other.err()),
    }
}
