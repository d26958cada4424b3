//! The pose of a body: its center, its axis, and the stretch along the axis.

use glam::{DMat3, DVec3};

/// A frame about a candidate axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The center in centimeters, relative to the viewpoint.
    pub center: DVec3,
    /// Unit vectors; the third is the axis, the others span the cross-section.
    pub frame: DMat3,
    /// κ: lengths along the axis are divided by it before the body's radius is taken, so that a long fruit is as round as
    /// the others. 1 for most.
    pub stretch: f64,
}

/// The parameters of a pose's step: two of the axis, three of the center.
pub(super) const PARAMETERS: usize = 5;

impl Pose {
    pub(super) fn new(axis: DVec3, center: DVec3, stretch: f64) -> Self {
        let (across, other) = axis.any_orthonormal_pair();
        Self {
            center,
            frame: DMat3::from_cols(across, other, axis),
            stretch,
        }
    }

    /// The unit direction of the axis.
    pub fn axis(&self) -> DVec3 {
        self.frame.z_axis
    }

    /// Returns an offset in the body's coordinates (u, v, t), with t along the axis and divided by the stretch.
    pub(super) fn to_body(self, offset: DVec3) -> DVec3 {
        let q = self.frame.transpose() * offset;
        DVec3::new(q.x, q.y, q.z / self.stretch)
    }

    /// Returns the position of body coordinates.
    pub(super) fn position_of(self, w: DVec3) -> DVec3 {
        self.center + self.frame * DVec3::new(w.x, w.y, w.z * self.stretch)
    }

    /// Returns the derivatives of the body coordinates `w` of an offset by the step of [`Pose::moved`]: of the axis' two
    /// parameters only, since a move of the center is the same for all offsets.
    pub(super) fn turned(self, w: DVec3) -> [DVec3; 2] {
        let along = self.stretch * w.z;
        [
            DVec3::new(-along, 0.0, w.x / self.stretch),
            DVec3::new(0.0, -along, w.y / self.stretch),
        ]
    }

    /// Returns the derivatives of body coordinates by the moves of the center along the frame.
    pub(super) fn shifted(self) -> [DVec3; 3] {
        [-DVec3::X, -DVec3::Y, -DVec3::Z / self.stretch]
    }

    /// Returns the pose whose axis leans by `step[0..2]` towards the first two vectors of the frame, and whose center has
    /// moved by `step[2..5]` along all three.
    pub(super) fn moved(self, step: [f64; PARAMETERS]) -> Self {
        let DMat3 {
            x_axis,
            y_axis,
            z_axis,
        } = self.frame;
        let axis = (z_axis + step[0] * x_axis + step[1] * y_axis).normalize();
        let across = (x_axis - x_axis.dot(axis) * axis).normalize();
        Self {
            center: self.center + step[2] * x_axis + step[3] * y_axis + step[4] * z_axis,
            frame: DMat3::from_cols(across, axis.cross(across), axis),
            stretch: self.stretch,
        }
    }
}
