//! A true axis as its two ends, and the small changes that move it. All of it pure.

use glam::{DQuat, DVec3};

use crate::geometry::angle_between_directions_rad;

/// The steps of the nudges that turn an axis, in degrees.
pub const NUDGES_DEG: [f64; 3] = [0.1, 1.0, 5.0];

/// Why two points are no axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EndsError {
    /// A coordinate is infinite or no number.
    #[error("a coordinate of the axis is not finite")]
    NotFinite,
    /// They are one point, to what a coordinate can tell.
    #[error("both ends of the axis are one point")]
    OnePoint,
    /// There is no direction to turn about or to point along.
    #[error("a direction of no length")]
    NoDirection,
    /// An axis cannot be made shorter than nothing.
    #[error("the axis would have no length left")]
    NoLengthLeft,
}

/// The two ends of a fruit's axis, in the unit and frame of the cloud's file. Both are finite and
/// they are apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ends {
    peduncle_base: DVec3,
    blossom_end: DVec3,
}

/// What stays where it is when an axis is turned or lengthened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Pivot {
    /// The middle between the ends.
    #[default]
    Middle,
    /// The peduncle's base.
    #[cfg_attr(feature = "cli", value(name = "base"))]
    PeduncleBase,
    /// The blossom end.
    #[cfg_attr(feature = "cli", value(name = "blossom"))]
    BlossomEnd,
}

impl Ends {
    /// An axis from the peduncle's base to the blossom end.
    ///
    /// # Errors
    /// Where a coordinate is not finite, or both are one point.
    pub fn new(peduncle_base: DVec3, blossom_end: DVec3) -> Result<Self, EndsError> {
        if !peduncle_base.is_finite() || !blossom_end.is_finite() {
            return Err(EndsError::NotFinite);
        }
        let apart = (peduncle_base - blossom_end).length();
        let far = peduncle_base.abs().max(blossom_end.abs()).max_element();
        // Below this the direction is the rounding of the coordinates.
        if !apart.is_finite() {
            return Err(EndsError::NotFinite);
        }
        if apart <= 1e-12 * far {
            return Err(EndsError::OnePoint);
        }
        Ok(Self {
            peduncle_base,
            blossom_end,
        })
    }

    /// A start for an annotator: the stretch of the line through `origin` along `toward_peduncle` that
    /// `points` span, but for their outermost 2 % on either side.
    ///
    /// # Errors
    /// Where the direction has no length, or the points span nothing along it.
    pub fn spanning(points: &[DVec3], origin: DVec3, toward_peduncle: DVec3) -> Result<Self, EndsError> {
        let direction = toward_peduncle.try_normalize().ok_or(EndsError::NoDirection)?;
        let mut along: Vec<f64> = points.iter().map(|&p| (p - origin).dot(direction)).collect();
        if along.is_empty() {
            return Err(EndsError::OnePoint);
        }
        along.sort_by(f64::total_cmp);
        let strays = (along.len() - 1) * 2 / 100;
        let (low, high) = (along[strays], along[along.len() - 1 - strays]);
        Self::new(origin + high * direction, origin + low * direction)
    }

    /// Where the peduncle leaves the fruit.
    pub fn peduncle_base(&self) -> DVec3 {
        self.peduncle_base
    }

    /// The other end, where the blossom was.
    pub fn blossom_end(&self) -> DVec3 {
        self.blossom_end
    }

    /// The middle between both ends.
    pub fn middle(&self) -> DVec3 {
        self.peduncle_base.midpoint(self.blossom_end)
    }

    /// The unit direction from the blossom end towards the peduncle, as a simulated truth's.
    pub fn direction(&self) -> DVec3 {
        (self.peduncle_base - self.blossom_end).normalize()
    }

    /// The distance between the ends, in the file's unit.
    pub fn length(&self) -> f64 {
        self.peduncle_base.distance(self.blossom_end)
    }

    /// The same line with its ends exchanged.
    #[must_use]
    pub fn flipped(&self) -> Self {
        Self {
            peduncle_base: self.blossom_end,
            blossom_end: self.peduncle_base,
        }
    }

    /// The two unit directions across the axis that an annotator who looks along `view_ray` wants to
    /// turn it about. About the first the axis leans towards the viewer or away; about the second it
    /// turns within the picture. Where the axis is seen end-on they are any two.
    ///
    /// (The directions across the *view*, its right and its up, the viewer knows itself.)
    pub fn across(&self, view_ray: DVec3) -> [DVec3; 2] {
        let direction = self.direction();
        let across = direction.cross(view_ray.normalize_or_zero());
        // A sine of 10⁻⁶ tells no direction that an eye could.
        let lean = if across.length() > 1e-6 {
            across.normalize()
        } else {
            direction.any_orthonormal_vector()
        };
        [lean, lean.cross(direction)]
    }

    /// Turned by `degrees` about the direction `about`, right-handed. Lengths stay.
    ///
    /// # Errors
    /// Where `about` has no length, or a number is not finite.
    pub fn turned(&self, about: DVec3, degrees: f64, pivot: Pivot) -> Result<Self, EndsError> {
        let about = about.try_normalize().ok_or(EndsError::NoDirection)?;
        if !degrees.is_finite() {
            return Err(EndsError::NotFinite);
        }
        let turn = DQuat::from_axis_angle(about, degrees.to_radians());
        let still = self.place(pivot);
        let moved = |end: DVec3| still + turn * (end - still);
        match pivot {
            Pivot::Middle => Self::new(moved(self.peduncle_base), moved(self.blossom_end)),
            Pivot::PeduncleBase => Self::new(self.peduncle_base, moved(self.blossom_end)),
            Pivot::BlossomEnd => Self::new(moved(self.peduncle_base), self.blossom_end),
        }
    }

    /// Moved as a whole, in the file's unit.
    ///
    /// # Errors
    /// Where a number is not finite.
    pub fn shifted(&self, by: DVec3) -> Result<Self, EndsError> {
        Self::new(self.peduncle_base + by, self.blossom_end + by)
    }

    /// Longer by `by`, in the file's unit; shorter where that is negative.
    ///
    /// # Errors
    /// Where nothing of the axis would be left, or a number is not finite.
    pub fn lengthened(&self, by: f64, pivot: Pivot) -> Result<Self, EndsError> {
        if !by.is_finite() {
            return Err(EndsError::NotFinite);
        }
        if by <= -self.length() {
            return Err(EndsError::NoLengthLeft);
        }
        let step = by * self.direction();
        let (base, blossom) = match pivot {
            Pivot::Middle => (0.5 * step, -0.5 * step),
            Pivot::PeduncleBase => (DVec3::ZERO, -step),
            Pivot::BlossomEnd => (step, DVec3::ZERO),
        };
        Self::new(self.peduncle_base + base, self.blossom_end + blossom)
    }

    /// The same middle and length in another direction, towards the peduncle.
    ///
    /// # Errors
    /// Where that has no length, or a number is not finite.
    pub fn pointing(&self, toward_peduncle: DVec3) -> Result<Self, EndsError> {
        let half = 0.5 * self.length() * toward_peduncle.try_normalize().ok_or(EndsError::NoDirection)?;
        Self::new(self.middle() + half, self.middle() - half)
    }

    /// With the peduncle's base elsewhere.
    ///
    /// # Errors
    /// Where that is no axis.
    pub fn with_peduncle_base(&self, place: DVec3) -> Result<Self, EndsError> {
        Self::new(place, self.blossom_end)
    }

    /// With the blossom end elsewhere.
    ///
    /// # Errors
    /// Where that is no axis.
    pub fn with_blossom_end(&self, place: DVec3) -> Result<Self, EndsError> {
        Self::new(self.peduncle_base, place)
    }

    /// The angle to another axis as directions, in degrees from 0 to 180: above 90 they point to
    /// opposite ends.
    pub fn angle_to_deg(&self, other: &Self) -> f64 {
        angle_between_directions_rad(self.direction(), other.direction()).to_degrees()
    }

    fn place(&self, pivot: Pivot) -> DVec3 {
        match pivot {
            Pivot::Middle => self.middle(),
            Pivot::PeduncleBase => self.peduncle_base,
            Pivot::BlossomEnd => self.blossom_end,
        }
    }
}
