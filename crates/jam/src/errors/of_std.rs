//! The error of the standard deviation of speeds, from the errors of these.

use math::simd::{Kernel, dispatch};

/// By how much the standard deviation of speeds is off: the difference from that of the speeds less their errors, and
/// what is not sure of these errors. They may all but cancel in the sum, what is not sure of them does not. Scaled:
/// speeds of 1e-200 have squares. `most` is the largest of the errors.
pub(super) fn std_error(speeds: &[f64], errors: &[f64], most: f64) -> f64 {
    let (count, scale) = (speeds.len() as f64, math::larger(ode::largest(speeds), most));
    if scale < SMALLEST || !scale.is_finite() {
        // numbers without digits, or none: none is off by more than all of it
        return scale;
    }
    let [mean, shift] = dispatch(Sums { speeds, errors }).map(|sum| sum / scale / count);
    let [squares, between, offs] = dispatch(Squares { speeds, errors, share: 1.0 / scale, mean, shift });
    // the squares of what remains without the errors
    let others = squares - between;
    let deviations = (squares / count).sqrt() + math::larger(others / count, 0.0).sqrt();
    let difference = if between == 0.0 { 0.0 } else { (between / count).abs() / deviations };
    scale * (difference + UNSURE * (offs / count).sqrt())
}

/// The sums of speeds and of their errors.
struct Sums<'a> {
    speeds: &'a [f64],
    errors: &'a [f64],
}

impl Kernel for Sums<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run(self) -> [f64; 2] {
        let mut sums = [[0.0; LANES]; 2];
        let (speeds, rest) = self.speeds.as_chunks::<LANES>();
        let (errors, error_rest) = self.errors.as_chunks::<LANES>();
        for (speeds, errors) in speeds.iter().zip(errors) {
            for lane in 0..LANES {
                sums[0][lane] += speeds[lane];
                sums[1][lane] += errors[lane];
            }
        }
        [rest.iter().chain(&sums[0]).sum(), error_rest.iter().chain(&sums[1]).sum()]
    }
}

/// The sums, in these units and over the deviations `d` from the mean and `e` of the errors from theirs, of `d^2`, of
/// `d^2 - (d - e)^2` and of `e^2`.
struct Squares<'a> {
    speeds: &'a [f64],
    errors: &'a [f64],
    share: f64,
    mean: f64,
    shift: f64,
}

impl Kernel for Squares<'_> {
    type Output = [f64; 3];

    #[inline(always)]
    fn run(self) -> [f64; 3] {
        let Squares { speeds, errors, share, mean, shift } = self;
        let (mut squares, mut between, mut offs) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (eights, rest) = speeds.as_chunks::<LANES>();
        let (error_eights, error_rest) = errors.as_chunks::<LANES>();
        for (speeds, errors) in eights.iter().zip(error_eights) {
            for lane in 0..LANES {
                let (own, off) = (speeds[lane] * share - mean, errors[lane] * share - shift);
                squares[lane] += own * own;
                between[lane] += off * (2.0 * own - off);
                offs[lane] += off * off;
            }
        }
        for (speed, error) in rest.iter().zip(error_rest) {
            let (own, off) = (speed * share - mean, error * share - shift);
            squares[0] += own * own;
            between[0] += off * (2.0 * own - off);
            offs[0] += off * off;
        }
        [squares, between, offs].map(|sums| sums.iter().sum())
    }
}

/// Numbers per iteration.
const LANES: usize = 8;

/// Shares of smaller numbers are no doubles.
const SMALLEST: f64 = 1e-300;

/// The part of the errors of steps that is not sure: orders that follow the first that is left out are smaller by about
/// this factor each, since the steps are as long as the series allow.
pub(super) const UNSURE: f64 = 0.2;

#[cfg(test)]
mod tests {
    use super::UNSURE;

    fn std_error(speeds: &[f64], errors: &[f64]) -> f64 {
        super::std_error(speeds, errors, ode::largest(errors))
    }

    /// The standard deviation of these.
    fn std(values: &[f64]) -> f64 {
        crate::observe::speed_std(values)
    }

    #[test]
    fn the_error_of_a_standard_deviation_is_its_change_and_a_part_of_the_errors() {
        let speeds = [1.0, 1.25, 0.5, 2.0, 1.0];
        let errors = [1e-3, -2e-3, 5e-4, 1e-3, -1e-3];
        let right: Vec<f64> = speeds.iter().zip(&errors).map(|(speed, error)| speed - error).collect();
        let expected = (std(&speeds) - std(&right)).abs() + UNSURE * std(&errors);
        assert!((std_error(&speeds, &errors) / expected - 1.0).abs() < 1e-9);
        // of any size, 1e-200 too
        let tiny = |values: &[f64]| values.iter().map(|value| 1e-200 * value).collect::<Vec<f64>>();
        assert!((std_error(&tiny(&speeds), &tiny(&errors)) / (1e-200 * expected) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn errors_that_all_have_alike_do_not_count() {
        assert!(std_error(&[1.0, 2.0, 4.0], &[0.125; 3]) < 1e-15);
        assert_eq!(std_error(&[1.0, 2.0, 4.0], &[0.0; 3]), 0.0);
        // of the least doubles, too, there is a number
        assert!((2e-322..1e-321).contains(&std_error(&[0.0; 3], &[2e-322, 0.0, -2e-322])));
    }

    #[test]
    fn errors_that_cancel_in_the_deviation_count_by_what_is_unsure() {
        // across the deviation of the speeds
        let (speeds, errors) = ([1.0, -1.0, 0.0], [1e-6, 1e-6, -2e-6]);
        let error = std_error(&speeds, &errors);
        let expected = UNSURE * std(&errors);
        assert!((error / expected - 1.0).abs() < 1e-4, "{error:e} {expected:e}");
    }
}
