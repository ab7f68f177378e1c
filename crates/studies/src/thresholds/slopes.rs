//! Slopes that the source uses: of the smooth ramp, and of the optimal velocity.

use crate::hard::rows::{Rows, row};
use jam::laws::{C, Logarithmic};
use jam::ramp::{ramp, smooth_ramp};
use math::lane::sigmoid;

/// The slope of `r_eps` at a distance, exactly and by differences, beside the -1/2 of the source (eq:seps); its value
/// beside `eps ln 2 - d' / 2` (eq:sfm_ss).
pub fn slopes() -> Rows {
    let mut rows = Rows::new(&["d_gap", "epsilon", "slope", "slope_error", "value", "paper_value", "ramp"]);
    for epsilon in [0.1, 0.01] {
        for x in [0.0, 0.01, 0.1, 200.0 / 67.0 - 2.0, 1.0, 1.5, 2.5] {
            let slope = -sigmoid(-x / epsilon);
            let h = 1e-5 * epsilon;
            let numeric = (smooth_ramp(x + h, epsilon) - smooth_ramp(x - h, epsilon)) / (2.0 * h);
            let paper = epsilon * std::f64::consts::LN_2 - 0.5 * x;
            rows.push(row![x, epsilon, slope, (slope - numeric).abs(), smooth_ramp(x, epsilon), paper, ramp(x)]);
        }
    }
    rows
}

/// `xi` of the linearised logarithmic law, the paper's `xi` (`eps -> 0`), and the slope of the optimal velocity
/// `V = v_0 (1 - ln(1 + c R))` by differences.
pub fn optimal_velocity() -> Rows {
    let mut rows =
        Rows::new(&["headway", "v0", "xi", "paper_xi", "slope", "difference", "unstable", "slope_above_half"]);
    for v0 in [0.5, 0.8, 0.83, 0.84, 1.0, 2.0, 3.0] {
        for headway in [0.5, 1.0, 1.5, 200.0 / 133.0, 1.9, 2.0, 2.2] {
            let law = Logarithmic { v0, a_v: 0.0, epsilon: 0.01 };
            let velocity = |s: f64| v0 * (1.0 - math::ln_1p(C * smooth_ramp(0.5 * s - 1.0, law.epsilon)));
            // four points: the third power of h is left, times a fifth derivative of 1 / eps^4
            let h = 1e-4;
            let near = velocity(headway + h) - velocity(headway - h);
            let far = velocity(headway + 2.0 * h) - velocity(headway - 2.0 * h);
            let slope = (8.0 * near - far) / (12.0 * h);
            let linear = law.linearise(headway, 0.0);
            let paper = C * v0 / (2.0 * (1.0 + C * (1.0 - 0.5 * headway)));
            let (unstable, above) = (linear.long_wave_margin() > 0.0, slope > 0.5);
            let (unstable, above) = (usize::from(unstable), usize::from(above));
            rows.push(row![headway, v0, linear.phi, paper, slope, (slope - linear.phi).abs(), unstable, above]);
        }
    }
    rows
}
