//! Simulates peppers whose axis is known and takes their errors apart.
//!
//! ```sh
//! cargo run --release --example simulated --no-default-features --features parallel
//! ```
//!
//! Each pepper is analyzed twice: as usual, and with its true center given. The difference is the error that the
//! estimated center causes. The lean towards the camera is an error of its own: Eq. 16 makes every axis perpendicular
//! to the view ray, so no plane can express it.

use std::error::Error;

use axiscope::geometry::{Unit, angle_between_lines_rad};
use axiscope::method::{CenterMethod, Params, Preset, analyze};
use axiscope::simulate::PepperSettings;

fn main() -> Result<(), Box<dyn Error>> {
    println!("seed  points    lean   error   with the true center");
    for seed in 1..=5 {
        // Whatever is not set here, such as size and pose, is drawn from the seed.
        let settings = PepperSettings {
            seed,
            ..PepperSettings::default()
        };
        let pepper = settings.simulate()?;
        let truth = &pepper.truth;

        // Simulated clouds are in centimeters, in the frame of a camera at the origin.
        let usual = Params::new(Preset::AsIntended, Unit::Centimeter);
        let with_true_center = Params {
            center: CenterMethod::Given(truth.center),
            ..usual.clone()
        };
        let error_deg = |params: &Params| -> Result<Option<f64>, Box<dyn Error>> {
            let analysis = analyze(&pepper.cloud, params, &())?;
            let angle_deg = |direction| angle_between_lines_rad(direction, truth.axis.direction).to_degrees();
            Ok(analysis.axis.map(|axis| angle_deg(axis.direction)))
        };
        let in_words = |error_deg: Option<f64>| error_deg.map_or("no axis".into(), |e| format!("{e:.2}°"));

        // The angle between the true axis and the plane perpendicular to the view ray.
        let lean_deg = 90.0 - angle_between_lines_rad(truth.axis.direction, truth.center).to_degrees();
        println!(
            "{seed:>4} {:>7} {lean_deg:>6.2}° {:>7} {:>7}",
            pepper.cloud.len(),
            in_words(error_deg(&usual)?),
            in_words(error_deg(&with_true_center)?),
        );
    }
    Ok(())
}
