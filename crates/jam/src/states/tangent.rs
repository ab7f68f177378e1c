//! The linearised equations where the force depends on a pedestrian's own spacing and speed alone: `du_n/dt = w_{n+1} -
//! w_n`, `dw_n/dt = phi_n u_n - w_n`, with the slopes `phi_n` of the acceleration along the solution.

use math::simd::{Kernel, dispatch};
use ode::Tangent;

/// The middle of the eigenvalues: for equal slopes, those of a wave add up to -1.
pub(super) const FADING: f64 = -0.5;

/// About how far from their middle eigenvalues `z` lie at most: that of the relaxation, or, for the steepest slope `phi`,
/// those of its shortest waves, for which `(z + 1/2)^2 = 1/4 - 2 phi`. Slopes are not equal; a tenth is added for that.
pub(super) fn fastest(slopes: &[f64]) -> f64 {
    let shortest = 2.0 * ode::largest(slopes) - FADING * FADING;
    1.1 * math::larger(shortest, FADING * FADING).sqrt()
}

/// Writes the rows of spacings and of speeds, which stand first in each, without their fading.
pub(super) fn series(tangent: Tangent<'_>, order: usize, unit: f64, coefficients: &mut [f64]) {
    dispatch(Series { tangent, order, unit, coefficients });
}

/// Row by row, each from the one before it and, where the slopes grow, from that before that.
struct Series<'a> {
    tangent: Tangent<'a>,
    order: usize,
    unit: f64,
    coefficients: &'a mut [f64],
}

impl Kernel for Series<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Series { tangent: Tangent { start, growth }, order, unit, coefficients } = self;
        let (n, last) = (start.len(), start.len() - 1);
        let dimension = coefficients.len() / (order + 1);
        for k in 0..order {
            let share = unit / (k + 1) as f64;
            let (done, next) = coefficients.split_at_mut((k + 1) * dimension);
            let (before, now) = done.split_at(k * dimension);
            let (spacings, speeds, ahead) = (&now[..n], &now[n..2 * n], &now[n + 1..2 * n]);
            let relaxation = -1.0 - FADING;
            let (next_spacings, next_speeds) = next[..2 * n].split_at_mut(n);
            for i in 0..last {
                next_spacings[i] = ((ahead[i] - speeds[i]) - FADING * spacings[i]) * share;
            }
            next_spacings[last] = ((speeds[0] - speeds[last]) - FADING * spacings[last]) * share;
            if k == 0 || growth.is_empty() {
                for i in 0..n {
                    next_speeds[i] = (start[i] * spacings[i] + relaxation * speeds[i]) * share;
                }
            } else {
                let earlier = &before[(k - 1) * dimension..][..n];
                for i in 0..n {
                    next_speeds[i] = (start[i] * spacings[i] + growth[i] * earlier[i] + relaxation * speeds[i]) * share;
                }
            }
        }
    }
}
