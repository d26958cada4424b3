//! Evaluates every cloud of a folder and prints a table: errors, partners and failures.
//!
//! ```sh
//! cargo run --release --example folder --no-default-features --features parallel -- FOLDER
//! ```
//!
//! Without a folder it takes the bundled samples. `axiscope::evaluate::csv` (feature `reports`) writes the same rows
//! with all their columns.

use std::error::Error;
use std::path::PathBuf;

use axiscope::evaluate::{Outcome, Row, Summary};
use axiscope::fruit::{Request, clouds_in};

fn main() -> Result<(), Box<dyn Error>> {
    let bundled = concat!(env!("CARGO_MANIFEST_DIR"), "/assets");
    let folder = PathBuf::from(std::env::args_os().nth(1).unwrap_or(bundled.into()));
    let request = Request::default();

    println!("{:<24} {:>8} {:>8}  reference", "cloud", "partners", "error");
    let mut rows = Vec::new();
    for path in clouds_in(&folder)? {
        // A cloud that cannot be read or analyzed is a row as well: it holds the reason.
        let name = Row::name_in(&folder, &path);
        let (outcome, _examined) = Outcome::of_file(&name, &path, &request, &())?;
        let row = outcome.row();
        println!(
            "{:<24} {:>8} {:>8}  {}",
            row.file,
            row.partner_fraction
                .map_or("–".into(), |share| format!("{:.0} %", 100.0 * share)),
            row.error_deg.map_or("–".into(), |error| format!("{error:.2}°")),
            row.failure.as_deref().or(row.truth.as_deref()).unwrap_or("–"),
        );
        rows.push(row.clone());
    }

    let summary = Summary::of(&rows);
    println!("\n{} clouds, {} with an error", summary.clouds, summary.measured);
    if let (Some(mean), Some(median)) = (summary.mean_deg, summary.median_deg) {
        println!("mean {mean:.2}°, median {median:.2}°");
    }
    Ok(())
}
