//! An irregular wave train of the algebraic law with widening, and which of its properties are reproducible. Its
//! trajectories are not beyond some time, when two methods part, nor is the time at which it becomes regular. The
//! regular train that follows is reproducible, and so are means, as far as methods and starts agree about them.

mod lyapunov;
mod observed;

use crate::hard::rows::{CellValue, Rows, row};
use crate::hard::run::{Case, Leg, two_methods};
use figures::failure::Failure;
use jam::laws::{Algebraic, Model};
use jam::ring::Ring;
use jam::states::StateVariables;
use observed::{Window, parting, path, windows};
use ode::{Control, Method};

/// `<0.45, 0, 2, 0.3>` at `v0' = 3` on the ring of figure 4.
fn case() -> Case {
    let law = Algebraic { mu: 0.45, delta: 0.0, q: 2.0, a_v: 0.3, epsilon: 0.1, v0: 3.0 };
    let ring = Ring { pedestrians: 67, length: LENGTH };
    Case { model: Model::Algebraic(law), ring, kind: StateVariables::Spacings }
}

/// The length of the ring, in units of `a_0`.
pub const LENGTH: f64 = 200.0;
/// Shifts of the starts: that of the source, and larger ones.
const SHIFTS: [f64; 4] = [1e-4, 1e-3, 1e-2, 0.1];
/// The waves have grown long before this time, in units of `tau`.
const BEGIN: f64 = 2000.0;
/// Number of windows of this length over which statistics are taken.
const WINDOWS: usize = 100;
const WINDOW: f64 = 1000.0;
/// In every window of irregular waves the least gap is below 0.201, in every one of regular waves above 0.216.
const IRREGULAR: f64 = 0.21;
/// The tolerance of the runs for statistics, and of those that are compared moment by moment.
const TOLERANCE: f64 = 1e-8;
const FINE: f64 = 1e-12;
/// Trajectories are compared up to this time.
const COMPARED: f64 = 1500.0;
/// What the shift of a second start has more.
const NUDGE: f64 = 1e-10;
/// The paths of all are kept from here to there: the two methods still agree about them.
pub const SHOWN: [f64; 2] = [1000.0, 1050.0];

/// The tables: statistics window by window (`windows`) and of whole runs (`runs`), how far runs come apart (`parting`),
/// and paths while they do not (`paths`).
///
/// # Errors
/// A run ended before its time.
pub fn tables() -> Result<[(&'static str, Rows); 4], Failure> {
    let case = case();
    let mut of_windows = Rows::new(&["method", "shift", "t", "std", "least_gap", "least_speed", "largest_speed"]);
    let mut of_runs = Rows::new(&RUNS);
    for scheme in two_methods(TOLERANCE) {
        for shift in SHIFTS {
            let run = Run::of(&case, scheme, shift)?;
            for Window { begin, std, least_gap, least_speed, largest_speed } in &run.windows {
                of_windows.push(row![scheme.0.name(), shift, *begin, *std, *least_gap, *least_speed, *largest_speed]);
            }
            of_runs.push(run.row(&case, scheme)?);
        }
    }
    let fine = two_methods(FINE);
    let pairs = [[(fine[0], SHIFTS[0]), (fine[1], SHIFTS[0])], [(fine[0], SHIFTS[0]), (fine[0], SHIFTS[0] + NUDGE)]];
    let [methods, starts] = pairs.map(|pair| parting(&case, pair, COMPARED));
    let mut apart = Rows::new(&["t", "methods", "starts"]);
    for ((t, methods), (_, starts)) in methods?.into_iter().zip(starts?) {
        apart.push(row![t, methods, starts]);
    }
    let paths = path(&case, SHIFTS[0], fine[0], SHOWN)?;
    Ok([("windows", of_windows), ("runs", of_runs), ("parting", apart), ("paths", paths)])
}

/// The columns of `runs`.
const RUNS: [&str; 14] = [
    "method",
    "shift",
    "irregular_until",
    "irregular_std",
    "irregular_std_error",
    "irregular_least_speed",
    "std",
    "least_gap",
    "least_speed",
    "largest_speed",
    "waves",
    "exponent",
    "exponent_error",
    "late_exponent",
];

/// A run from a start.
struct Run {
    shift: f64,
    /// The state before the first window.
    grown: Vec<f64>,
    windows: Vec<Window>,
    /// The state after the last window.
    end: Vec<f64>,
}

impl Run {
    fn of(case: &Case, scheme: Scheme, shift: f64) -> Result<Run, Failure> {
        let (method, control) = scheme;
        let grown = case.run(shift, Leg { method, control, begin: 0.0, end: BEGIN }).whole()?.state;
        let (windows, end) = windows(case, &grown, scheme, BEGIN, (WINDOWS, WINDOW))?;
        Ok(Run { shift, grown, windows, end })
    }

    /// The row of `runs`: until when the waves are irregular and what they are then, what they are in the last window.
    fn row(&self, case: &Case, scheme: Scheme) -> Result<Vec<CellValue>, Failure> {
        let count = self.windows.iter().rposition(|window| window.least_gap < IRREGULAR).map_or(0, |last| last + 1);
        let (irregular, last) = (&self.windows[..count], &self.windows[WINDOWS - 1]);
        let stds: Vec<f64> = irregular.iter().map(|window| window.std).collect();
        // of one window no error can be told
        let known = (count > 1).then(|| mean(&stds));
        let slowest = irregular.iter().map(|window| window.least_speed).fold(f64::INFINITY, math::smaller);
        let (exponent, exponent_error) = mean(&lyapunov::exponents(case, &self.grown, scheme)?);
        let (late, _) = mean(&lyapunov::exponents(case, &self.end, scheme)?);
        Ok(row![
            scheme.0.name(),
            self.shift,
            (count > 0).then_some(BEGIN + count as f64 * WINDOW),
            known.map(|(mean, _)| mean),
            known.map(|(_, error)| error),
            (count > 0).then_some(slowest),
            last.std,
            last.least_gap,
            last.least_speed,
            last.largest_speed,
            maxima(&self.end[case.ring.pedestrians..2 * case.ring.pedestrians]) as f64,
            exponent,
            exponent_error,
            late
        ])
    }
}

/// How many are faster than both of their neighbours on the ring.
fn maxima(speeds: &[f64]) -> usize {
    let count = speeds.len();
    (0..count).filter(|&n| speeds[n] > speeds[(n + 1) % count] && speeds[n] > speeds[(n + count - 1) % count]).count()
}

/// A method with the rule for its steps.
type Scheme = (Method, Control);

/// The mean of values that are independent, with its standard error.
fn mean(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    (mean, (squares / (count - 1.0) / count).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_have_the_standard_error_of_independent_values() {
        let (value, error) = mean(&[1.0, 2.0, 3.0, 6.0]);
        assert_eq!(value, 3.0);
        assert!((error - (14.0_f64 / 12.0).sqrt()).abs() < 1e-15, "{error}");
    }

    #[test]
    fn waves_are_counted_around_the_ring() {
        assert_eq!(maxima(&[3.0, 1.0, 2.0, 1.0, 2.0]), 2);
        assert_eq!(maxima(&[1.0; 5]), 0);
    }

    /// The paper's middle class, whose waves go around without changing: each window is like the one before, and like
    /// the certified run of supplement 19.
    #[test]
    fn windows_of_a_regular_wave_agree_with_the_run_of_supplement_19() {
        let law = Algebraic { mu: 0.32, delta: 1.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 };
        let ring = Ring { pedestrians: 67, length: 167.5 };
        let case = Case { model: Model::Algebraic(law), ring, kind: StateVariables::Spacings };
        let scheme = (Method::Dop853, Control::Adaptive { tolerance: 1e-8 });
        let leg = Leg { method: scheme.0, control: scheme.1, begin: 0.0, end: 1000.0 };
        let grown = case.run(0.1, leg).whole().expect("a run").state;
        let (found, _) = windows(&case, &grown, scheme, 1000.0, (2, 50.0)).expect("windows");
        for window in &found {
            assert!((window.std - 0.418_767).abs() < 1e-5, "{}", window.std);
            assert!((window.least_speed - 1.129_02).abs() < 1e-3, "{}", window.least_speed);
            assert!((window.least_gap - 0.274_00).abs() < 1e-3, "{}", window.least_gap);
        }
        assert_eq!(maxima(&grown[67..134]), 1);
    }

    #[test]
    fn runs_that_begin_side_by_side_are_compared_moment_by_moment() {
        let scheme = two_methods(FINE)[0];
        let apart = parting(&case(), [(scheme, 1e-4), (scheme, 1e-4 + NUDGE)], 20.0).expect("runs");
        assert_eq!(apart.iter().map(|(t, _)| *t).collect::<Vec<f64>>(), [5.0, 10.0, 15.0, 20.0]);
        assert!(apart.iter().all(|(_, apart)| (1e-11..1e-7).contains(apart)), "{apart:?}");
        let same = parting(&case(), [(scheme, 1e-4), (scheme, 1e-4)], 20.0).expect("runs");
        assert!(same.iter().all(|(_, apart)| *apart == 0.0), "{same:?}");
    }
}
