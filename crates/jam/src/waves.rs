//! Single waves: a start that contains one wave, and the amplitude of a wave in a state.

use crate::stability::Complex;

/// The start, in the form [`Deviations`](crate::states::Deviations), of `pedestrians` in the uniform flow of this
/// `speed` that carries one wave: places `A exp(i k n)`, gaps their differences, speeds `z` times them (the eigenvector
/// of the root `z` of [`Linear::root`](crate::stability::Linear::root)), of all the real parts.
///
/// `k` is a whole multiple of `2 pi / N`; `amplitude` is `A`, in units of `a_0`, small beside the net gap.
pub fn start(pedestrians: usize, speed: f64, z: Complex, k: f64, amplitude: f64) -> Vec<f64> {
    let mut start = vec![0.0; 2 * pedestrians + 3];
    let place = |n: usize| (amplitude * math::cos(k * n as f64), amplitude * math::sin(k * n as f64));
    for n in 0..pedestrians {
        let (here, ahead) = (place(n), place((n + 1) % pedestrians));
        start[n] = ahead.0 - here.0;
        start[pedestrians + n] = z.0 * here.0 - z.1 * here.1;
    }
    start[2 * pedestrians] = amplitude;
    start[2 * pedestrians + 2] = speed;
    start
}

/// The coefficient `(1 / N) sum w_n exp(-i k n)` of the wave `k` in `N >= 1` values, in their unit; of none it is NaN.
pub fn coefficient(values: &[f64], k: f64) -> Complex {
    let count = values.len() as f64;
    let part = |f: fn(f64) -> f64| values.iter().enumerate().map(|(n, w)| w * f(k * n as f64)).sum::<f64>() / count;
    (part(math::cos), -part(math::sin))
}
