//! The rows of a fit: the misfits of points and contour rays, and their derivatives by the body and its pose.

use glam::DVec3;

use super::basis::Basis;
use super::pose::{PARAMETERS, Pose};

/// The observations that a body is fitted to.
#[derive(Debug, Clone)]
pub(super) struct Observations {
    /// Points of the surface, in centimeters relative to the viewpoint.
    pub(super) points: Vec<DVec3>,
    /// Their unit normals.
    pub(super) normals: Vec<DVec3>,
    /// Unit rays from the viewpoint that touch the body, with a factor to their rows.
    pub(super) rays: Vec<(DVec3, f64)>,
}

/// The least cosine between the normal and the direction from the center that a misfit is multiplied by: where the surface
/// is seen along its radius' side, the radius says little about the distance to the surface.
const LEAST_COSINE: f64 = 0.15;

/// The columns of a row beside the harmonics: the pose's parameters, and the radius.
pub(super) const EXTRA: usize = PARAMETERS + 1;

impl Observations {
    pub(super) fn len(&self) -> usize {
        self.points.len() + self.rays.len()
    }

    /// Computes the rows of all observations, one after another, `basis.terms() + EXTRA` numbers each: the k `Y_j`, the
    /// derivatives of the misfit by the pose, and k R. The misfit is k (R − Σ `β_j` `Y_j`), about the distance between point
    /// and body in centimeters.
    pub(super) fn rows(&self, basis: &Basis, pose: Pose, beta: &[f64], rows: &mut [f64]) {
        let width = basis.terms() + EXTRA;
        let (of_points, of_rays) = rows.split_at_mut(width * self.points.len());
        let shifted = pose.shifted();
        for ((row, &point), &normal) in of_points
            .chunks_exact_mut(width)
            .zip(&self.points)
            .zip(&self.normals)
        {
            let offset = point - pose.center;
            let w = pose.to_body(offset);
            let place = Place::new(basis, beta, w);
            let cosine = normal.dot(offset) / place.radius;
            let factor = cosine.max(LEAST_COSINE);
            let [a, b] = pose.turned(w);
            let moves = [a, b, shifted[0], shifted[1], shifted[2]];
            place.fill(basis, factor, row, moves.map(|dw| place.slope.dot(dw)));
            if cosine > LEAST_COSINE {
                // The factor changes as well: k = n·q / R, and n·q only with the center.
                let across = pose.frame.transpose() * normal;
                let by_center = [0.0, 0.0, -across.x, -across.y, -across.z];
                let columns = &mut row[basis.terms()..];
                for ((column, dw), dn) in columns.iter_mut().zip(moves).zip(by_center) {
                    let change = (dn - cosine * place.unit.dot(dw)) / place.radius;
                    *column += change * place.misfit;
                }
            }
        }
        for (row, &(ray, weight)) in of_rays.chunks_exact_mut(width).zip(&self.rays) {
            // The ray's point nearest to the center, in body coordinates: w = s e − w_c with w·e = 0.
            let (e, from) = (pose.to_body(ray), pose.to_body(pose.center));
            let squared = e.length_squared();
            let along = e.dot(from) / squared;
            let w = along * e - from;
            let place = Place::new(basis, beta, w);
            // In body coordinates the gradient of R is of length one; in centimeters a stretched body's is shorter.
            let metric = DVec3::new(w.x, w.y, w.z / pose.stretch).length();
            let metric = metric.max(1e-9 * place.radius);
            let factor = weight * place.radius / metric;
            let metric_slope = DVec3::new(w.x, w.y, w.z / (pose.stretch * pose.stretch)) / metric;
            let [a, b] = pose.turned(w);
            let [ea, eb] = pose.turned(e);
            let zero = DVec3::ZERO;
            let moves = [
                (a, ea),
                (b, eb),
                (shifted[0], zero),
                (shifted[1], zero),
                (shifted[2], zero),
            ];
            // Where the pose moves, the nearest point slides along the ray by ds.
            let derivatives = moves.map(|(dw, de)| {
                let slide = -(dw.dot(e) + w.dot(de)) / squared;
                let moved = dw + slide * e;
                // The factor changes as well, by this share of itself.
                let change = place.unit.dot(moved) / place.radius - metric_slope.dot(moved) / metric;
                place.slope.dot(moved) + change * place.misfit
            });
            place.fill(basis, factor, row, derivatives);
        }
    }
}

/// A body coordinate, with the radius of the body in its direction.
struct Place {
    /// R, the distance from the center in body coordinates.
    radius: f64,
    /// w / R.
    unit: DVec3,
    /// R − Σ `β_j` `Y_j`.
    misfit: f64,
    /// The derivatives of the misfit by w.
    slope: DVec3,
}

impl Place {
    fn new(basis: &Basis, beta: &[f64], w: DVec3) -> Self {
        // At the very center any direction does; no point of a surface lies there.
        let radius = w.length().max(1e-9);
        let unit = w / radius;
        let (body, gradient) = basis.radius(beta, unit.to_array());
        let gradient = DVec3::from_array(gradient);
        // The body's radius does not change along the ray from the center.
        let across = (gradient - unit * unit.dot(gradient)) / radius;
        Self {
            radius,
            unit,
            misfit: radius - body,
            slope: unit - across,
        }
    }

    fn fill(&self, basis: &Basis, factor: f64, row: &mut [f64], derivatives: [f64; PARAMETERS]) {
        let (terms, extra) = row.split_at_mut(basis.terms());
        basis.values(self.unit.to_array(), terms);
        for term in terms {
            *term *= factor;
        }
        for (column, derivative) in extra.iter_mut().zip(derivatives) {
            *column = factor * derivative;
        }
        extra[PARAMETERS] = factor * self.radius;
    }
}

#[cfg(test)]
mod tests {
    use super::super::basis::{COARSE, FINE};
    use super::*;

    /// The misfits of all rows.
    fn misfits(observations: &Observations, basis: &Basis, pose: Pose, beta: &[f64]) -> Vec<f64> {
        let (terms, width) = (basis.terms(), basis.terms() + EXTRA);
        let mut rows = vec![0.0; width * observations.len()];
        observations.rows(basis, pose, beta, &mut rows);
        let misfit = |row: &[f64]| {
            let body: f64 = row[..terms].iter().zip(beta).map(|(y, b)| y * b).sum();
            row[width - 1] - body
        };
        rows.chunks_exact(width).map(misfit).collect()
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        for (basis, stretch) in [(&COARSE, 1.0), (&FINE, 1.0), (&FINE, 2.3)] {
            let center = DVec3::new(1.0, -2.0, 40.0);
            let place = |i: u32| {
                let (a, b) = (0.7 * f64::from(i), 0.9 + 0.13 * f64::from(i));
                DVec3::new(a.cos() * b.sin(), b.cos(), -(a.sin() * b.sin()).abs() - 0.3)
            };
            let observations = Observations {
                points: (0..40)
                    .map(|i| center + (2.0 + 0.02 * f64::from(i)) * place(i))
                    .collect(),
                normals: (0..40).map(|i| (place(i) + 0.2 * DVec3::X).normalize()).collect(),
                rays: (0..9)
                    .map(|i| ((center + 3.0 * place(i)).normalize(), 0.4))
                    .collect(),
            };
            let pose = Pose::new(
                DVec3::new(0.3, -0.8, 0.2).normalize(),
                center + 0.1 * DVec3::Y,
                stretch,
            );
            let beta: Vec<f64> = (0..basis.terms())
                .map(|j| if j == 0 { 2.5 } else { 0.3 * (1.7 * j as f64).sin() })
                .collect();
            let (terms, width) = (basis.terms(), basis.terms() + EXTRA);
            let mut rows = vec![0.0; width * observations.len()];
            observations.rows(basis, pose, &beta, &mut rows);
            for k in 0..PARAMETERS {
                let at = |length: f64| {
                    let mut step = [0.0; PARAMETERS];
                    step[k] = length;
                    misfits(&observations, basis, pose.moved(step), &beta)
                };
                let (before, after) = (at(-1e-6), at(1e-6));
                for (i, row) in rows.chunks_exact(width).enumerate() {
                    let difference = (after[i] - before[i]) / 2e-6;
                    // A row's factor has a kink where the cosine is least.
                    let kink = i < observations.points.len() && {
                        let offset = observations.points[i] - pose.center;
                        observations.normals[i].dot(offset) < 0.2 * offset.length()
                    };
                    let error = (row[terms + k] - difference).abs();
                    assert!(
                        kink || error <= 1e-6 * (1.0 + difference.abs()),
                        "row {i}, parameter {k}: {error}"
                    );
                }
            }
        }
    }
}
