//! The camera's poses in a text file, as the TUM RGB-D benchmark and most programs for scanning write them.

use glam::{DQuat, DVec3};

use super::CameraPose;
use crate::geometry::Unit;

/// The reason why a list of poses was not read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TrajectoryError {
    /// A line is not a pose.
    #[error(
        "line {line} is not a pose: a time, the position x y z in meters and a quaternion x y z w are eight numbers"
    )]
    Line {
        /// The line's number, from 1.
        line: usize,
    },
    /// There are no poses.
    #[error("it has no poses")]
    Empty,
}

/// Reads a trajectory in the format of the TUM RGB-D benchmark: a line a pose with eight numbers, which are a time (not
/// used), the position in meters and the rotation as a quaternion x, y, z, w. Lines that start with `#` are comments.
///
/// # Errors
/// Returns an error if a line is no pose, or there is none.
pub fn parse_trajectory(text: &str) -> Result<Vec<CameraPose>, TrajectoryError> {
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    let poses: Result<Vec<CameraPose>, TrajectoryError> = lines
        .filter(|(_, text)| !text.is_empty() && !text.starts_with('#'))
        .map(|(line, text)| parse_pose(text).ok_or(TrajectoryError::Line { line }))
        .collect();
    match poses {
        Ok(poses) if poses.is_empty() => Err(TrajectoryError::Empty),
        other => other,
    }
}

fn parse_pose(text: &str) -> Option<CameraPose> {
    let numbers: Option<Vec<f64>> = text
        .split_whitespace()
        .map(|word| word.parse().ok().filter(|x: &f64| x.is_finite()))
        .collect();
    let [_, x, y, z, qx, qy, qz, qw] = numbers?.try_into().ok()?;
    let orientation = DQuat::from_xyzw(qx, qy, qz, qw);
    (orientation.length() > 1e-3).then_some(CameraPose {
        position_cm: DVec3::new(x, y, z) * Unit::Meter.in_cm(),
        orientation,
    })
}
