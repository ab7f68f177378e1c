//! One travelling wave, by Newton's method: `v_n(t) = V(2 pi n / N + omega t)`, with one wave on the ring.
//!
//! The profile `V` is known at an odd number of equidistant places. Its derivative, its shift by one pedestrian and the
//! gaps are those of the trigonometric polynomial through these values: each is the product with a circulant matrix.
//! The gap changes at the rate `v_{n+1} - v_n`, so its profile is `d' + W V / omega` with `W` of the multipliers `(e^{i
//! k 2 pi / N} - 1) / (i k)`.

use super::elimination::solve;
use jam::laws::{Algebraic, Law};
use math::dual::Dual;
use std::f64::consts::TAU;

/// A travelling wave.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wave {
    /// The first cosine coefficient of the speeds.
    pub(super) amplitude: f64,
    /// The strength of the force.
    pub(super) strength: f64,
    /// The rate at which the phase of all pedestrians grows.
    pub(super) frequency: f64,
    /// The speeds, at equidistant phases.
    pub(super) speeds: Vec<f64>,
}

/// What all waves of a ring have in common.
pub(super) struct Family {
    law: Algebraic,
    gap: f64,
    points: usize,
    /// First columns of the circulant matrices: derivative, shift by a pedestrian, gap times frequency.
    slope: Vec<f64>,
    ahead: Vec<f64>,
    gaps: Vec<f64>,
}

/// As many steps Newton's method may take.
const ROUNDS: usize = 12;
/// It ends where nothing changes by more than this.
const CLOSE: f64 = 1e-11;
/// Half the step of the difference that gives the derivative with respect to the strength.
const STEP: f64 = 1e-6;

impl Family {
    /// The waves of the law without widening, at a gap of the uniform flow.
    pub(super) fn new(law: Algebraic, gap: f64, pedestrians: usize, points: usize) -> Family {
        assert!(points % 2 == 1 && law.a_v == 0.0, "an odd number of points, and gaps without speeds");
        let apart = TAU / pedestrians as f64;
        let column = |part: &dyn Fn(f64, f64) -> f64, mean: f64| -> Vec<f64> {
            let phases = (0..points).map(|i| TAU * i as f64 / points as f64);
            let sum = |phase: f64| (1..=points / 2).map(|k| 2.0 * part(k as f64, phase)).sum::<f64>();
            phases.map(|phase| (mean + sum(phase)) / points as f64).collect()
        };
        Family {
            law,
            gap,
            points,
            slope: column(&|k, phase| -k * math::sin(k * phase), 0.0),
            ahead: column(&|k, phase| math::cos(k * (phase + apart)), 1.0),
            gaps: column(&|k, phase| (math::sin(k * (phase + apart)) - math::sin(k * phase)) / k, 0.0),
        }
    }

    /// The gaps of a wave, at the phases of its speeds.
    pub(super) fn gaps(&self, wave: &Wave) -> Vec<f64> {
        let products = product(&self.gaps, &wave.speeds).into_iter();
        products.map(|product| self.gap + product / wave.frequency).collect()
    }

    /// The wave with the amplitude of the guess, and the number of steps of Newton's method; `None` where that does not
    /// converge.
    pub(super) fn find(&self, guess: Wave) -> Option<(Wave, usize)> {
        let mut wave = guess;
        for round in 1..=ROUNDS {
            let (matrix, right) = self.equations(&wave);
            let change = solve(matrix, right)?;
            wave.speeds.iter_mut().zip(&change).for_each(|(speed, change)| *speed += change);
            wave.frequency += change[self.points];
            wave.strength += change[self.points + 1];
            if !(wave.frequency > 0.0 && wave.strength > 0.0) || self.gaps(&wave).iter().any(|gap| *gap <= 0.0) {
                return None;
            }
            if change.iter().all(|change| change.abs() < CLOSE) {
                return Some((wave, round));
            }
        }
        None
    }

    /// `omega V' = f(d, V, V ahead)` at each place, that the wave is even in its first harmonic, and its amplitude: the
    /// derivatives row by row, and what is missing.
    fn equations(&self, wave: &Wave) -> (Vec<f64>, Vec<f64>) {
        let (points, size) = (self.points, self.points + 2);
        let law = |strength: f64| Algebraic { mu: strength, ..self.law };
        let [slopes, ahead] = [&self.slope, &self.ahead].map(|column| product(column, &wave.speeds));
        let gaps = self.gaps(wave);
        let (mut matrix, mut right) = (vec![0.0; size * size], vec![0.0; size]);
        for i in 0..points {
            let values = [gaps[i], wave.speeds[i], ahead[i]];
            let by = |which: usize| {
                let at = |j: usize| if j == which { Dual::variable(values[j]) } else { Dual::constant(values[j]) };
                law(wave.strength).acceleration(at(0), at(1), at(2)).slope
            };
            let plain = |strength: f64| law(strength).acceleration(values[0], values[1], values[2]);
            let [by_gap, by_speed, by_ahead] = [0, 1, 2].map(by);
            let row = &mut matrix[i * size..][..size];
            for (j, entry) in row[..points].iter_mut().enumerate() {
                let place = (i + points - j) % points;
                *entry = wave.frequency * self.slope[place]
                    - by_ahead * self.ahead[place]
                    - by_gap * self.gaps[place] / wave.frequency;
            }
            row[i] -= by_speed;
            row[points] = slopes[i] + by_gap * (gaps[i] - self.gap) / wave.frequency;
            row[points + 1] = -(plain(wave.strength + STEP) - plain(wave.strength - STEP)) / (2.0 * STEP);
            right[i] = plain(wave.strength) - wave.frequency * slopes[i];
        }
        for j in 0..points {
            let phase = TAU * j as f64 / points as f64;
            let [cosine, sine] = [math::cos(phase), math::sin(phase)].map(|part| 2.0 * part / points as f64);
            matrix[points * size + j] = sine;
            matrix[(points + 1) * size + j] = cosine;
            right[points] -= sine * wave.speeds[j];
            right[points + 1] -= cosine * wave.speeds[j];
        }
        right[points + 1] += wave.amplitude;
        (matrix, right)
    }
}

/// The product of a circulant matrix, given by its first column, with a vector.
fn product(column: &[f64], vector: &[f64]) -> Vec<f64> {
    let size = vector.len();
    let entry = |i: usize| vector.iter().enumerate().map(|(j, value)| column[(i + size - j) % size] * value).sum();
    (0..size).map(entry).collect()
}

/// The trigonometric polynomial through these values, at the given number of equidistant phases instead.
pub(super) fn resampled(values: &[f64], points: usize) -> Vec<f64> {
    let size = values.len();
    let kernel = |offset: f64| 1.0 + 2.0 * (1..=size / 2).map(|k| math::cos(k as f64 * offset)).sum::<f64>();
    let value = |phase: f64| {
        let parts = values.iter().enumerate().map(|(j, value)| value * kernel(phase - TAU * j as f64 / size as f64));
        parts.sum::<f64>() / size as f64
    };
    (0..points).map(|i| value(TAU * i as f64 / points as f64)).collect()
}
