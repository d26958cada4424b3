//! Reading that is watched: its progress, and calling it off.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use axiscope::fruit::{ReadErrorKind, read_cloud, read_cloud_watched};
use axiscope::geometry::Cloud;
use axiscope::parallel::Watch;
use axiscope::ply::{self, Encoding, Precision, WriteOptions};
use glam::DVec3;

/// Notes all progress, and calls off once so much of it was told.
struct Patience {
    told: Mutex<Vec<(usize, usize)>>,
    calls_off_at: f64,
    asked_after: AtomicUsize,
}

impl Patience {
    fn until(calls_off_at: f64) -> Self {
        Self {
            told: Mutex::default(),
            calls_off_at,
            asked_after: AtomicUsize::new(0),
        }
    }

    fn share(&self) -> f64 {
        let told = self.told.lock().unwrap();
        told.last()
            .map_or(0.0, |&(done, total)| done as f64 / total as f64)
    }
}

impl Watch for Patience {
    fn is_cancelled(&self) -> bool {
        let over = self.share() >= self.calls_off_at;
        self.asked_after.fetch_add(usize::from(over), Ordering::Relaxed);
        over
    }

    fn advanced(&self, done: usize, total: usize) {
        self.told.lock().unwrap().push((done, total));
    }
}

fn file(encoding: Encoding) -> tempfile::NamedTempFile {
    let at = |i: i32| DVec3::new(f64::from(i), f64::from(i % 7), 30.0);
    let cloud = Cloud::new((0..300_000).map(at).collect());
    let options = WriteOptions {
        encoding,
        precision: Precision::Float,
        ..WriteOptions::default()
    };
    let mut bytes = Vec::new();
    ply::write(&mut bytes, &cloud, &options).unwrap();
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), bytes).unwrap();
    file
}

#[test]
fn progress_rises_from_nothing_to_all_and_the_cloud_is_the_same() {
    for encoding in [
        Encoding::Ascii,
        Encoding::BinaryLittleEndian,
        Encoding::BinaryBigEndian,
    ] {
        let file = file(encoding);
        let watch = Patience::until(2.0);
        let watched = read_cloud_watched(file.path(), &watch).unwrap();
        assert_eq!(watched, read_cloud(file.path()).unwrap());
        let told = watch.told.lock().unwrap();
        let shares: Vec<f64> = told.iter().map(|&(d, t)| d as f64 / t as f64).collect();
        assert!(shares.len() > 24, "dozens of times: {}", shares.len());
        assert!(shares.len() < 3000, "and never once a point: {}", shares.len());
        assert!(shares.is_sorted(), "{encoding:?}: {shares:?}");
        assert!(shares[0] <= 0.3 && *shares.last().unwrap() > 0.95, "{shares:?}");
    }
}

#[test]
fn reading_that_is_called_off_stops_soon_and_gives_no_cloud() {
    for encoding in [Encoding::Ascii, Encoding::BinaryLittleEndian] {
        let file = file(encoding);
        for share in [0.0, 0.2, 0.31, 0.6, 0.9] {
            let watch = Patience::until(share);
            let error = read_cloud_watched(file.path(), &watch).unwrap_err();
            assert!(matches!(error.kind, ReadErrorKind::Cancelled), "{error}");
            assert!(
                watch.share() < share + 0.1 || watch.share() <= 0.3,
                "{}",
                watch.share()
            );
            assert!(error.to_string().ends_with(": reading was called off"), "{error}");
        }
    }
}
