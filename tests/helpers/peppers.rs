//! Folders of small simulated peppers with their truths.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use axiscope::geometry::Unit;
use axiscope::ply::{WriteOptions, write};
use axiscope::simulate::{DepthCamera, PepperSettings};

/// Writes `count` peppers of some hundred points, with their truths, as if some time ago.
pub fn write_peppers(folder: &Path, count: u64) -> Vec<PathBuf> {
    std::fs::create_dir_all(folder).expect("a folder");
    (0..count).map(|seed| write_pepper(folder, seed)).collect()
}

/// One pepper, `pepper_SEED.ply`.
pub fn write_pepper(folder: &Path, seed: u64) -> PathBuf {
    let settings = PepperSettings {
        seed,
        camera: DepthCamera {
            width_px: 320,
            height_px: 240,
            focal_px: 240.0,
            ..DepthCamera::default()
        },
        ..PepperSettings::default()
    };
    let pepper = settings.simulate().expect("a pepper");
    let path = folder.join(format!("pepper_{seed:03}.ply"));
    let options = WriteOptions {
        unit: Some(Unit::Centimeter),
        ..WriteOptions::default()
    };
    let mut bytes = Vec::new();
    write(&mut bytes, &pepper.cloud, &options).expect("written to memory");
    std::fs::write(&path, bytes).expect("written");
    let truth = path.with_extension("truth.json");
    std::fs::write(&truth, serde_json::to_string(&pepper.truth).expect("JSON")).expect("written");
    make_older(&path);
    make_older(&truth);
    path
}

/// As if it had been written a minute ago: what has just changed is read again, to be sure.
pub fn make_older(path: &Path) {
    let file = File::options().append(true).open(path).expect("it is there");
    let then = SystemTime::now() - Duration::from_mins(1);
    file.set_modified(then).expect("its time can be set");
}
