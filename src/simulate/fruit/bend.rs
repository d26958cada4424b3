//! A straight body, bent along an arc.

use glam::DVec3;

/// A bend: the axis y becomes an arc in the plane of x and y, as long as it was.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bend {
    radius_cm: f64,
    /// Half the angle that the fruit turns by.
    half_rad: f64,
    half_length_cm: f64,
}

impl Bend {
    /// The bend of a fruit that turns by an angle along its length; `None` if it is straight.
    pub(super) fn new(angle_deg: f64, length_cm: f64) -> Option<Self> {
        let half_rad = angle_deg.to_radians() / 2.0;
        (half_rad > 0.0).then(|| Self {
            radius_cm: length_cm / (2.0 * half_rad),
            half_rad,
            half_length_cm: length_cm / 2.0,
        })
    }

    /// The radius of the arc.
    pub(super) fn radius_cm(&self) -> f64 {
        self.radius_cm
    }

    /// The largest distance of the arc from the axis.
    pub(super) fn sagitta_cm(&self) -> f64 {
        self.radius_cm * (1.0 - self.half_rad.cos())
    }

    /// Half the distance between the ends of the arc.
    pub(super) fn half_chord_cm(&self) -> f64 {
        self.radius_cm * self.half_rad.sin()
    }

    /// Bends a point. What lies beyond an end goes straight on. The mean of the arc keeps its place.
    pub(super) fn bent(&self, p: DVec3) -> DVec3 {
        let along = p.y.clamp(-self.half_length_cm, self.half_length_cm);
        let (sin, cos) = (along / self.radius_cm).sin_cos();
        let from_middle = self.radius_cm - p.x;
        let mean = self.radius_cm * (1.0 - self.half_rad.sin() / self.half_rad);
        let beyond = DVec3::new(sin, cos, 0.0) * (p.y - along);
        DVec3::new(self.radius_cm - from_middle * cos - mean, from_middle * sin, p.z) + beyond
    }
}
