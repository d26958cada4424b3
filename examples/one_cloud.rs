//! Finds the symmetry axis of one cloud and compares it with the axes that are known of the fruit.
//!
//! ```sh
//! cargo run --example one_cloud --no-default-features -- CLOUD.ply
//! ```
//!
//! Without a file it reads a bundled pepper, which was simulated: its true axis lies beside it in a truth file.

use std::error::Error;
use std::path::PathBuf;

use axiscope::evaluate::examine;
use axiscope::fruit::{Fruit, Request};
use axiscope::method::axis_error_rad;

fn main() -> Result<(), Box<dyn Error>> {
    let bundled = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/pepper.ply");
    let path = PathBuf::from(std::env::args_os().nth(1).unwrap_or(bundled.into()));

    // The defaults follow the paper as its authors meant it, and take the unit and the peduncle from the file.
    let request = Request::default();
    let fruit = Fruit::read(&path, &request)?;
    println!(
        "{}: {} points in {}",
        path.display(),
        fruit.cloud().len(),
        fruit.unit
    );

    // The second argument of a long computation watches its progress and may cancel it; `()` does neither.
    let examined = examine(fruit, &request, &())?;
    for warning in &examined.warnings {
        println!("Warning: {warning}");
    }

    // There is no axis if no plane has enough points with a partner; a warning says so.
    let Some(axis) = &examined.analysis.axis else {
        return Err("the cloud has no symmetry axis".into());
    };
    println!("center    {:.4}", axis.origin);
    println!("direction {:.4}", axis.direction);
    for reference in &examined.references {
        let error_deg = axis_error_rad(axis, reference).to_degrees();
        println!("{error_deg:5.2}° to the axis by {}", reference.source.name());
    }
    Ok(())
}
