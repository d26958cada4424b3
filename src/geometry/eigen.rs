//! Eigenvalues and eigenvectors of symmetric 3×3 matrices, by Jacobi's rotations: quick enough at this size,
//! and as exact for equal or vanishing eigenvalues as for any others.

use glam::DVec3;

/// Rotations of all three pairs come to rest after four or five rounds; the bound is for safety.
const ROUNDS: usize = 16;

/// The eigenvalues of the symmetric matrix `[xx, xy, xz, yy, yz, zz]`, smallest first, with unit
/// eigenvectors at right angles in the same order.
pub(crate) fn symmetric_eigen([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> ([f64; 3], [DVec3; 3]) {
    let mut a = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
    for _ in 0..ROUNDS {
        let off = a[0][1].abs() + a[0][2].abs() + a[1][2].abs();
        let size = a[0][0].abs() + a[1][1].abs() + a[2][2].abs();
        // Below the last digit of the largest eigenvalue nothing changes any more.
        if off <= 1e-17 * size {
            break;
        }
        for (p, q, r) in [(0, 1, 2), (0, 2, 1), (1, 2, 0)] {
            let apq = a[p][q];
            if apq == 0.0 {
                continue;
            }
            // The smaller of the two angles that make a[p][q] vanish.
            let theta = (a[q][q] - a[p][p]) / (2.0 * apq);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            a[p][p] -= t * apq;
            a[q][q] += t * apq;
            (a[p][q], a[q][p]) = (0.0, 0.0);
            let (arp, arq) = (a[r][p], a[r][q]);
            a[r][p] = c * arp - s * arq;
            a[r][q] = s * arp + c * arq;
            (a[p][r], a[q][r]) = (a[r][p], a[r][q]);
            (axes[p], axes[q]) = (c * axes[p] - s * axes[q], s * axes[p] + c * axes[q]);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    (order.map(|i| a[i][i]), order.map(|i| axes[i]))
}
