//! How small differences of spacings and speeds move where the force depends on the own spacing alone:
//! `du_n/dt = w_{n+1} - w_n`, `dw_n/dt = phi_n u_n - w_n` with the slopes `phi_n` of the acceleration along the solution.

use math::simd::{Kernel, dispatch};
use ode::Tangent;

/// About the largest growth rate of such a difference: neither the relaxation nor the waves of the steepest slope are faster.
pub(super) fn fastest(slopes: &[f64]) -> f64 {
    let steepest = ode::largest(slopes);
    0.5 + (0.25 + 2.0 * steepest).sqrt()
}

/// Writes the rows of spacings and of speeds, which stand first in each.
pub(super) fn series(tangent: Tangent<'_>, order: usize, unit: f64, coefficients: &mut [f64]) {
    let dimension = coefficients.len() / (order + 1);
    for k in 0..order {
        let (done, next) = coefficients.split_at_mut((k + 1) * dimension);
        let (before, now) = done.split_at(k * dimension);
        let before = &before[before.len().saturating_sub(dimension)..];
        dispatch(Row { tangent, before, now, share: unit / (k + 1) as f64, next: &mut next[..dimension] });
    }
}

/// One row from the one before it, and from that before that if there is one.
struct Row<'a> {
    tangent: Tangent<'a>,
    before: &'a [f64],
    now: &'a [f64],
    share: f64,
    next: &'a mut [f64],
}

impl Kernel for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Row { tangent: Tangent { start, growth }, before, now, share, next } = self;
        let n = start.len();
        let (spacings, speeds) = (&now[..n], &now[n..2 * n]);
        let (next_spacings, next_speeds) = next[..2 * n].split_at_mut(n);
        for ((next, own), ahead) in next_spacings.iter_mut().zip(speeds).zip(&speeds[1..]) {
            *next = (ahead - own) * share;
        }
        next_spacings[n - 1] = (speeds[0] - speeds[n - 1]) * share;
        let known = start.iter().zip(spacings).zip(speeds);
        for (next, ((slope, spacing), speed)) in next_speeds.iter_mut().zip(known) {
            *next = slope * spacing - speed;
        }
        if !before.is_empty() {
            for (next, (growth, spacing)) in next_speeds.iter_mut().zip(growth.iter().zip(&before[..n])) {
                *next += growth * spacing;
            }
        }
        next_speeds.iter_mut().for_each(|next| *next *= share);
    }
}
