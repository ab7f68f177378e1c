//! Kinks of the right-hand side, on which the steps of Taylor's method end.
//!
//! The rates of a system with `abs`, `min` or `max` are smooth on either side of the places where an argument passes
//! through 0. The series about the start of a step is that of the side which the solution enters; beyond the first
//! crossing it belongs to another equation. The arguments have series of their own ([`System::kink_arguments`]), whose
//! zeros are found to the last bit, so a step ends on a kink instead of being halved until it is short.

use crate::system::System;
use crate::taylor::HIGHEST;
use math::simd::{Kernel, dispatch};

/// The arguments of all kinks in a step.
pub(crate) struct Kinks {
    /// How many arguments.
    count: usize,
    /// How many coefficients each of them has.
    order: usize,
    /// A row of coefficients for each order, that of order 0 first.
    rows: Vec<f64>,
    /// Between which numbers each argument stays within a step.
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Kinks {
    /// The kinks of a system with series of this order; `None` if it has none.
    pub(crate) fn new(system: &dyn System, order: usize) -> Option<Kinks> {
        let count = system.kinks();
        let zeros = |count: usize| vec![0.0; count];
        (count > 0).then(|| Kinks { count, order, rows: zeros(count * order), low: zeros(count), high: zeros(count) })
    }

    /// The time after which a step of `length` has to end because an argument has changed its sign, in the series
    /// written last, with this unit of time.
    ///
    /// An argument that is `x` beyond 0 after the time `t` makes the rates wrong by about `x` and the state by less
    /// than `x t`. It ends the step where that reaches `slack`. So an argument beside 0 that is all rounding ends no
    /// step, and kinks closer to each other than a short step of no consequence share one.
    pub(crate) fn end(&mut self, system: &dyn System, length: f64, unit: f64, slack: f64) -> f64 {
        let Kinks { count, order, rows, low, high } = self;
        system.kink_arguments(*order, rows);
        // a series without an end would overflow at the end of its step
        let longest = LONGEST * unit;
        let mut end = if length < longest { length } else { longest };
        dispatch(Range { rows, h: end / unit, low, high });
        let allowed = slack / end;
        for argument in 0..*count {
            let start = rows[argument];
            let may_cross = start >= 0.0 && low[argument] < -allowed || start <= 0.0 && high[argument] > allowed;
            if !may_cross {
                continue;
            }
            let coefficients = rows[argument..].iter().step_by(*count);
            if let Some(sooner) = first_crossing(coefficients, end, unit, slack) {
                end = sooner;
            }
        }
        end
    }
}

/// Longest step of a system with kinks, in units of the last one.
const LONGEST: f64 = 1e6;

/// Bounds polynomials from 0 to `h` by the least and the largest of their control points (see [`control_points`]).
struct Range<'a> {
    rows: &'a [f64],
    h: f64,
    low: &'a mut [f64],
    high: &'a mut [f64],
}

/// Polynomials per iteration.
const LANES: usize = 8;

impl Range<'_> {
    #[inline(always)]
    fn lanes<const LANES: usize>(&mut self, from: usize) {
        let mut points = [[0.0; LANES]; HIGHEST + 1];
        let count = self.low.len();
        let points = &mut points[..self.rows.len() / count];
        let degree = points.len() - 1;
        let mut factor = 1.0;
        for (k, (point, row)) in points.iter_mut().zip(self.rows.chunks_exact(count)).enumerate() {
            for (point, coefficient) in point.iter_mut().zip(&row[from..][..LANES]) {
                *point = factor * coefficient;
            }
            factor *= next_factor(k, degree) * self.h;
        }
        for first in 1..=degree {
            for k in (first..=degree).rev() {
                let before = points[k - 1];
                for (point, before) in points[k].iter_mut().zip(before) {
                    *point += before;
                }
            }
        }
        let (mut low, mut high) = (points[0], points[0]);
        for point in points {
            for lane in 0..LANES {
                low[lane] = if point[lane] < low[lane] { point[lane] } else { low[lane] };
                high[lane] = if point[lane] > high[lane] { point[lane] } else { high[lane] };
            }
        }
        self.low[from..][..LANES].copy_from_slice(&low);
        self.high[from..][..LANES].copy_from_slice(&high);
    }
}

impl Kernel for Range<'_> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let count = self.low.len();
        if count < LANES {
            for from in 0..count {
                self.lanes::<1>(from);
            }
        } else {
            // the last block begins earlier rather than be cut: what is written twice is the same
            for from in (0..count).step_by(LANES) {
                self.lanes::<LANES>(from.min(count - LANES));
            }
        }
    }
}

/// One over the binomial coefficient of `degree` and `k + 1`, in units of that of `degree` and `k`.
#[inline(always)]
fn next_factor(k: usize, degree: usize) -> f64 {
    if k < degree { (k + 1) as f64 / (degree - k) as f64 } else { 1.0 }
}

/// The time within `end` at which an argument with these coefficients is as far beyond 0, times that time, as allowed.
fn first_crossing<'a>(
    coefficients: impl Iterator<Item = &'a f64> + Clone,
    end: f64,
    unit: f64,
    slack: f64,
) -> Option<f64> {
    let first = coefficients.clone().find(|coefficient| **coefficient != 0.0)?;
    // a kink found before has made the step shorter
    let (mut change, mut power) = (0.0, 1.0);
    for coefficient in coefficients.clone().skip(1) {
        power *= end / unit;
        change += coefficient.abs() * power;
    }
    let start = coefficients.clone().next().map_or(0.0, |start| start.abs());
    if (change - start) * end <= slack {
        return None;
    }
    // `slack + t |f(t)|` on the side where the step starts, as a polynomial of the part of the step
    let mut polynomial = Polynomial { coefficients: [0.0; HIGHEST + 1], degree: 0 };
    polynomial.coefficients[0] = slack;
    let mut power = if *first < 0.0 { -end } else { end };
    for coefficient in coefficients {
        polynomial.degree += 1;
        polynomial.coefficients[polynomial.degree] = coefficient * power;
        power *= end / unit;
    }
    polynomial.first_zero().map(|part| part * end).filter(|time| *time > 0.0)
}

/// A polynomial on the interval from 0 to 1.
struct Polynomial {
    coefficients: [f64; HIGHEST + 1],
    degree: usize,
}

/// Part of the interval in which no more zeros are told apart.
const NARROW: f64 = 1e-12;

/// A part of the interval, with the control points there.
struct Part {
    from: f64,
    width: f64,
    points: [f64; HIGHEST + 1],
}

impl Polynomial {
    /// The first zero of a polynomial that is positive at 0. A part of the interval has no more zeros than its control
    /// points change their sign, and is halved until that is once or never (Descartes' rule; G. E. Collins, A. G.
    /// Akritas, *Polynomial real root isolation using Descarte's rule of signs*, SYMSAC 1976).
    fn first_zero(&self) -> Option<f64> {
        let mut parts = vec![Part { from: 0.0, width: 1.0, points: self.control_points() }];
        while let Some(part) = parts.pop() {
            let Part { from, width, points } = &part;
            match sign_changes(&points[..=self.degree]) {
                0 => (),
                1 => return Some(self.bisect(*from, from + width)),
                _ if *width < NARROW => return Some(*from),
                _ => {
                    let [left, right] = part.halves(self.degree);
                    parts.extend([right, left]);
                }
            }
        }
        None
    }

    /// The coefficients of the Bernstein polynomials, between which it stays.
    fn control_points(&self) -> [f64; HIGHEST + 1] {
        let (mut points, mut factor) = (self.coefficients, 1.0);
        for (k, point) in points[..=self.degree].iter_mut().enumerate() {
            *point *= factor;
            factor *= next_factor(k, self.degree);
        }
        for first in 1..=self.degree {
            for k in (first..=self.degree).rev() {
                points[k] += points[k - 1];
            }
        }
        points
    }

    fn at(&self, x: f64) -> f64 {
        self.coefficients[..=self.degree].iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
    }

    /// The place from which on it is negative, between one where it is not and one where it is.
    fn bisect(&self, mut before: f64, mut past: f64) -> f64 {
        loop {
            let middle = 0.5 * (before + past);
            if middle <= before || middle >= past {
                return past;
            }
            if self.at(middle) < 0.0 { past = middle } else { before = middle }
        }
    }
}

impl Part {
    /// Both halves (de Casteljau).
    fn halves(&self, degree: usize) -> [Part; 2] {
        let width = 0.5 * self.width;
        let (mut left, mut right) = (self.points, self.points);
        for (k, point) in left.iter_mut().take(degree + 1).enumerate() {
            *point = right[0];
            for i in 0..degree - k {
                right[i] = 0.5 * (right[i] + right[i + 1]);
            }
        }
        [Part { from: self.from, width, points: left }, Part { from: self.from + width, width, points: right }]
    }
}

/// How often the sign changes along a row; 0 counts as positive.
fn sign_changes(numbers: &[f64]) -> usize {
    numbers.windows(2).filter(|pair| (pair[0] < 0.0) != (pair[1] < 0.0)).count()
}

#[cfg(test)]
mod tests {
    use super::{Polynomial, first_crossing};
    use crate::taylor::HIGHEST;

    fn polynomial(coefficients: &[f64]) -> Polynomial {
        let mut all = [0.0; HIGHEST + 1];
        all[..coefficients.len()].copy_from_slice(coefficients);
        Polynomial { coefficients: all, degree: coefficients.len() - 1 }
    }

    /// `(x - a) (x - b) ...`, positive at 0 for an even number of zeros.
    fn with_zeros(zeros: &[f64]) -> Polynomial {
        let mut product = vec![1.0];
        for zero in zeros {
            let shifted: Vec<f64> = std::iter::once(0.0).chain(product.iter().copied()).collect();
            product.push(0.0);
            product.iter_mut().zip(shifted).for_each(|(own, shifted)| *own = shifted - zero * *own);
        }
        polynomial(&product)
    }

    #[test]
    fn the_first_zero_is_found_however_close_the_next() {
        for zeros in [
            vec![0.3, 0.7],
            vec![0.5, 0.5 + 1e-6],
            vec![1e-9, 0.9],
            vec![0.25, 0.26, 0.27, 0.28],
            vec![-0.1, -2.0, 0.999, 3.0],
            vec![0.1, 0.3, 0.5, 0.7, 0.9, 1.1],
        ] {
            let first = zeros.iter().copied().filter(|zero| *zero > 0.0).reduce(math::smaller).expect("a zero");
            let found = with_zeros(&zeros).first_zero().expect("it is found");
            assert!((found - first).abs() < 1e-9 * math::larger(first, 1e-3), "{zeros:?}: {found}");
        }
    }

    #[test]
    fn no_zero_is_found_where_there_is_none() {
        assert_eq!(with_zeros(&[1.5, 2.0]).first_zero(), None);
        assert_eq!(with_zeros(&[-0.5, -0.1]).first_zero(), None);
        // 1e-4 above 0 at its lowest
        assert_eq!(polynomial(&[0.2501, -1.0, 1.0]).first_zero(), None);
        assert_eq!(polynomial(&[1e-300, 0.0, 0.0]).first_zero(), None);
    }

    /// It touches 0 at 0.5: the search ends, with that place or without.
    #[test]
    fn a_touching_polynomial_ends_the_search() {
        let found = polynomial(&[0.25, -1.0, 1.0]).first_zero();
        assert!(found.is_none_or(|found| (found - 0.5).abs() < 1e-6), "{found:?}");
    }

    #[test]
    fn a_crossing_counts_where_it_is_of_consequence() {
        let crossing = |coefficients: &[f64], slack: f64| first_crossing(coefficients.iter(), 8.0, 2.0, slack);
        // 3 - t falls through 0 at 3, and t times that to -1e-12 a little later
        let time = crossing(&[3.0, -2.0], 1e-12).expect("it crosses");
        assert!((time - 3.0).abs() < 1e-12 && time > 3.0, "{time}");
        assert_eq!(crossing(&[-3.0, 2.0], 1e-12), Some(time), "from the other side");
        // all rounding
        assert_eq!(crossing(&[1e-17, -3e-17, 2e-17], 1e-12), None);
        // at 0, it leaves to the side of its first coefficient that is not 0, and comes back at 6
        let time = crossing(&[0.0, 12.0, -4.0], 1e-12).expect("it crosses");
        assert!((time - 6.0).abs() < 1e-9, "{time}");
        assert_eq!(crossing(&[0.0, 0.0, 0.0], 1e-12), None);
        // a little beyond at the start already: a short step, not one without length
        let time = crossing(&[1e-18, -2.0], 1e-12).expect("it crosses");
        assert!((time - 1e-6).abs() < 1e-11, "{time}");
    }
}
