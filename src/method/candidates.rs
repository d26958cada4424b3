//! Candidate planes (§ 2.4, Eq. 4–10): u² normals over half a sphere.

use std::f64::consts::PI;

use glam::DVec3;

use super::ParamError;

/// The paper's grid of candidate planes. All pass through the fruit center; there are u² of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct CandidateGrid {
    u: usize,
}

/// The place of one candidate plane in the grid, and its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// 1 to u: the step of α.
    pub g: usize,
    /// 1 to u: the step of β.
    pub h: usize,
    /// Eq. 6, in (0, π). The paper calls it the azimuth; by Eq. 8–10 it is the polar angle from z.
    pub alpha_rad: f64,
    /// Eq. 7, in (−π/2, π/2). The paper calls it the elevation; by Eq. 8–10 it is the azimuth.
    pub beta_rad: f64,
    /// The plane's unit normal n_p (Eq. 8–10 with r = 1).
    pub normal: DVec3,
}

impl CandidateGrid {
    /// The least u that the paper allows (u > 4).
    pub const MIN_U: usize = 5;
    /// The largest u that is allowed: half a degree between planes.
    pub const MAX_U: usize = 360;

    /// Makes a grid of u × u planes.
    ///
    /// # Errors
    /// Returns an error if u is not in [`CandidateGrid::MIN_U`]..=[`CandidateGrid::MAX_U`].
    pub fn new(u: usize) -> Result<Self, ParamError> {
        if (Self::MIN_U..=Self::MAX_U).contains(&u) {
            Ok(Self { u })
        } else {
            Err(ParamError::GridSize(u))
        }
    }

    /// Steps along each angle.
    pub fn u(self) -> usize {
        self.u
    }

    /// The number of planes, u².
    pub fn plane_count(self) -> usize {
        self.u * self.u
    }

    /// The plane at `index` (0 to u² − 1), which counts h fastest (g-major).
    pub fn candidate(self, index: usize) -> Candidate {
        let (g, h) = (index / self.u + 1, index % self.u + 1);
        let step = PI / self.u as f64;
        let alpha_rad = (g as f64 - 0.5) * step;
        let beta_rad = (h as f64 - 0.5) * step - PI / 2.0;
        let normal = DVec3::new(
            alpha_rad.sin() * beta_rad.cos(),
            alpha_rad.sin() * beta_rad.sin(),
            alpha_rad.cos(),
        );
        Candidate {
            g,
            h,
            alpha_rad,
            beta_rad,
            normal,
        }
    }

    /// The index of the plane at the steps `g` and `h` (each 1 to u); `None` outside the grid.
    pub fn index_of(self, g: usize, h: usize) -> Option<usize> {
        let range = 1..=self.u;
        (range.contains(&g) && range.contains(&h)).then(|| (g - 1) * self.u + h - 1)
    }

    /// All planes, g-major.
    pub fn candidates(self) -> impl ExactSizeIterator<Item = Candidate> {
        (0..self.plane_count()).map(move |i| self.candidate(i))
    }
}
