//! The outline of a fruit in the image of its camera: seen, and a body's.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};

use super::shape::Body;

/// The sectors around the middle of the image that an outline is cut into.
pub const SECTORS: usize = 64;

/// The cosine between normal and ray near the edge below which the surface turns away there: the edge is true contour.
/// Above it, something hides the rest of the fruit.
const CONTOUR_COSINE: f64 = 0.55;

/// The farthest that points reach in one sector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The distance from the middle in the image, as a tangent.
    pub reach: f64,
    /// The cosine between normal and ray there, 0 where the surface turns away.
    pub cosine: f64,
    /// The depth of the outermost point in centimeters.
    pub depth: f64,
}

impl Edge {
    /// Whether the edge is the fruit's own contour rather than that of what hides it.
    pub fn is_contour(&self) -> bool {
        self.cosine < CONTOUR_COSINE
    }
}

/// The seen outline: the edge in each sector around the middle of the points.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Right, down and ahead, with the ray to the points' mean ahead.
    camera: DMat3,
    middle: DVec2,
    /// The edge of each sector; `None` for a sector without enough points.
    pub edges: Vec<Option<Edge>>,
}

/// How a body's outline compares with the seen one.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The mean over all sectors of the robust, squared excess in contour sectors, in standard deviations.
    pub misfit: f64,
    /// The excess of the body over the seen edge in each sector, in centimeters; `None` where either is missing.
    pub excess_cm: Vec<Option<f64>>,
    /// The area within the seen outline as a share of that within the seen and the body's outline, 0 to 1.
    pub seen_share: f64,
}

impl Outline {
    /// Finds the outline of points relative to their camera, with normals; `None` if they are not ahead of it.
    pub(super) fn of(points: &[DVec3], normals: &[DVec3]) -> Option<Self> {
        let ahead = points.iter().sum::<DVec3>().try_normalize()?;
        // Right and down as far as the file's frame is that of a camera whose y points down.
        let right = DVec3::Y
            .cross(ahead)
            .try_normalize()
            .unwrap_or_else(|| ahead.any_orthonormal_vector());
        let camera = DMat3::from_cols(right, ahead.cross(right), ahead);
        let mut outline = Self {
            camera,
            middle: DVec2::ZERO,
            edges: vec![None; SECTORS],
        };
        let images: Option<Vec<(DVec2, f64)>> = points.iter().map(|&p| outline.image(p)).collect();
        let images = images?;
        outline.middle = images.iter().map(|i| i.0).sum::<DVec2>() / images.len() as f64;
        let mut members: Vec<Vec<(f64, usize)>> = vec![Vec::new(); SECTORS];
        for (i, (at, _)) in images.iter().enumerate() {
            let offset = *at - outline.middle;
            members[sector(offset)].push((offset.length(), i));
        }
        for sector in &mut members {
            sector.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        }
        for s in 0..SECTORS {
            let around = [(s + SECTORS - 1) % SECTORS, s, (s + 1) % SECTORS];
            let mut wide: Vec<(f64, usize)> =
                around.iter().flat_map(|&a| members[a].iter().copied()).collect();
            wide.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            let outermost = if members[s].len() < 3 { &wide } else { &members[s] };
            let Some(outermost) = outermost.get(..3) else {
                continue;
            };
            let reach = outermost.iter().map(|o| o.0).sum::<f64>() / 3.0;
            let near_edge = wide.iter().filter(|o| o.0 > 0.93 * reach);
            let mut cosines: Vec<f64> = near_edge
                .map(|o| normals[o.1].dot(points[o.1].normalize_or_zero()).abs())
                .collect();
            let cosine = median(&mut cosines).unwrap_or(1.0);
            let depth = images[outermost[0].1].1;
            outline.edges[s] = Some(Edge { reach, cosine, depth });
        }
        Some(outline)
    }

    /// Returns the place of a point in the image, as tangents, and its depth; `None` if it is not ahead.
    fn image(&self, point: DVec3) -> Option<(DVec2, f64)> {
        let p = self.camera.transpose() * point;
        (p.z > 0.0).then(|| (DVec2::new(p.x, p.y) / p.z, p.z))
    }

    /// The share of sectors whose edge is true contour, 0 to 1.
    pub fn contour_share(&self) -> f64 {
        let contours = self.edges.iter().flatten().filter(|e| e.is_contour()).count();
        contours as f64 / SECTORS as f64
    }

    /// Returns the rays through the contour, each with a factor to its row in a fit: `sigma` over the uncertainty of the
    /// body's edge, all lengths in units of the fruit's size. Grazing surface gives no points, so that the body reaches
    /// beyond the outermost ones by about S (1 − sin of the last angle), of which the rays allow for half.
    pub(super) fn rays(&self, size: f64, sigma: f64) -> Vec<(DVec3, f64)> {
        /// The uncertainty of an edge at which the surface turns away altogether.
        const EDGE_SPREAD: f64 = 0.1;
        let ray = |(s, edge): (usize, &Option<Edge>)| {
            let edge = edge.filter(Edge::is_contour)?;
            let hole = 1.0 - (1.0 - edge.cosine * edge.cosine).sqrt();
            let reach = edge.reach + 0.5 * hole * size / edge.depth;
            let (sin, cos) = ((s as f64 + 0.5) / SECTORS as f64 * TAU - PI).sin_cos();
            let at = self.middle + reach * DVec2::new(cos, sin);
            let direction = (self.camera * at.extend(1.0)).normalize();
            Some((direction, sigma / (EDGE_SPREAD + 0.5 * hole)))
        };
        self.edges.iter().enumerate().filter_map(ray).collect()
    }

    /// Compares a body's outline with the seen one. `size` is the fruit's, in centimeters.
    pub(super) fn compare(&self, body: &Body, size: f64) -> Comparison {
        /// The expected excess and its standard deviation, in units of the fruit's size: edges are not measured.
        const EXPECTED: (f64, f64) = (0.02, 0.04);
        /// The bound between squared and linear loss, and the largest loss.
        const HUBER: f64 = 2.0;
        const LARGEST: f64 = 12.0;
        let mut reaches = vec![0.0_f64; SECTORS];
        for point in body.points() {
            if let Some((at, _)) = self.image(point) {
                let offset = at - self.middle;
                let reach = &mut reaches[sector(offset)];
                *reach = reach.max(offset.length());
            }
        }
        let (mut misfit, mut seen, mut whole) = (0.0, 0.0, 0.0);
        let mut excess_cm = vec![None; SECTORS];
        for ((edge, reach), excess_cm) in self.edges.iter().zip(reaches).zip(&mut excess_cm) {
            let reach_seen = edge.map_or(0.0, |e| e.reach);
            seen += reach_seen * reach_seen;
            whole += reach.max(reach_seen).powi(2);
            let Some(edge) = edge.filter(|_| reach > 0.0) else {
                continue;
            };
            let excess = (reach - edge.reach) * edge.depth;
            *excess_cm = Some(excess);
            if edge.is_contour() {
                let z = ((excess / size - EXPECTED.0) / EXPECTED.1).abs();
                let loss = if z < HUBER {
                    0.5 * z * z
                } else {
                    HUBER * (z - 0.5 * HUBER)
                };
                misfit += loss.min(LARGEST);
            }
        }
        Comparison {
            misfit: misfit / SECTORS as f64,
            excess_cm,
            // The points' own outline encloses some area, so that this is no division by zero.
            seen_share: seen / whole.max(f64::MIN_POSITIVE),
        }
    }
}

fn sector(offset: DVec2) -> usize {
    let turn = (offset.y.atan2(offset.x) + PI) / TAU;
    // From 0 to 1; one itself belongs to the last sector.
    ((turn * SECTORS as f64) as usize).min(SECTORS - 1)
}

/// The median, by the mean of the middle two of an even number.
fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_unstable_by(f64::total_cmp);
    let half = values.len() / 2;
    match values.len() % 2 {
        _ if values.is_empty() => None,
        0 => Some(0.5 * (values[half - 1] + values[half])),
        _ => Some(values[half]),
    }
}
