//! Linear stability of the uniform flow, exactly and for every wave number.
//!
//! Each law linearises to
//! `eps_n'' = kappa (eps_{n+1}' - eps_n') + phi (eps_{n+1} - eps_n) - beta (eps_n' + eps_{n+1}') - eps_n'`. A wave
//! `exp(z t + i k n)` then obeys `z^2 + (1 + beta (1 + e^{ik}) + kappa (1 - e^{ik})) z + phi (1 - e^{ik}) = 0`
//! (eq:stabN, eq:stab_neu_av).

use math::complex_sqrt;
use math::double_double::DoubleDouble;
use std::f64::consts::PI;

/// The coefficients of the linearised law; all >= 0 for the laws of the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// `phi`: the slope of the acceleration in the spacing, in units of `1 / tau^2` (eq:epsf).
    pub phi: f64,
    /// `-(1 + 2 beta)` is its slope in a speed that all share, in units of `1 / tau`; 0 without widening.
    pub beta: f64,
    /// `1 + 2 kappa` is the slope in the speed ahead less that in the own speed, in units of `1 / tau`; 0 where
    /// relative speeds have no influence.
    pub kappa: f64,
}

/// How the acceleration of pedestrian n answers to the spacings and speeds of n + j: the derivatives `f_{s_j}`,
/// `f_{v_j}` in the uniform flow, for any neighbours j.
///
/// A wave `exp(z t + i k n)` of positions obeys `z^2 + b z + c = 0` with `b(k) = -sum_j f_{v_j} e^{ijk}` and
/// `c(k) = sum_j f_{s_j} e^{ijk} (1 - e^{ik})`. Both roots decay if and only if `Re b > 0` and
/// `D = (Re b)^2 Re c + Re b Im b Im c - (Im c)^2 > 0` (the criterion of Routh and Hurwitz for complex coefficients).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Response {
    /// `(j, f_{s_j})`, in units of `1 / tau^2`: to the spacing of pedestrian n + j.
    pub spacings: Vec<(i32, f64)>,
    /// `(j, f_{v_j})`, in units of `1 / tau`: to the speed of pedestrian n + j.
    pub speeds: Vec<(i32, f64)>,
}

/// Which waves are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waves {
    /// All `k` in (0, pi].
    All,
    /// The waves of a ring of N pedestrians: `k = 2 pi l / N`.
    Ring(usize),
}

impl Response {
    /// `b` and `c` of `z^2 + b z + c = 0`, in units of `1 / tau` and `1 / tau^2`, for any `k`.
    pub fn polynomial(&self, k: f64) -> (Complex, Complex) {
        self.polynomial_with(k, math::sin(0.5 * k))
    }

    /// The same, given `sin(k / 2)`. Sines and cosines are most of the work for the waves of a ring: none is taken
    /// twice.
    fn polynomial_with(&self, k: f64, half: f64) -> (Complex, Complex) {
        let sin_k = math::sin(k);
        let turn = |j: i32| match j {
            0 => (1.0, 0.0),
            1 => (math::cos(k), sin_k),
            _ => (math::cos(f64::from(j) * k), math::sin(f64::from(j) * k)),
        };
        let mut b = (0.0, 0.0);
        for (j, slope) in &self.speeds {
            let (cos, sin) = turn(*j);
            b = (b.0 - slope * cos, b.1 - slope * sin);
        }
        // 1 - e^{ik} without cancellation
        let (re, im) = (2.0 * half * half, -sin_k);
        let mut c = (0.0, 0.0);
        for (j, slope) in &self.spacings {
            let (cos, sin) = turn(*j);
            c = (c.0 + slope * (cos * re - sin * im), c.1 + slope * (cos * im + sin * re));
        }
        (b, c)
    }

    /// The root `z^+` with the larger real part, in units of `1 / tau`, for `k` in (0, pi]; minus its imaginary part is
    /// the frequency of the wave.
    pub fn root(&self, k: f64) -> Complex {
        Response::root_of(self.polynomial(k))
    }

    fn root_of((b, c): (Complex, Complex)) -> Complex {
        let discriminant = (b.0 * b.0 - b.1 * b.1 - 4.0 * c.0, 2.0 * b.0 * b.1 - 4.0 * c.1);
        let s = complex_sqrt(discriminant.0, discriminant.1);
        // the sum that does not cancel gives one root, its product with the other is c
        let same_side = b.0 * s.0 + b.1 * s.1 >= 0.0;
        let sum = if same_side { (b.0 + s.0, b.1 + s.1) } else { (b.0 - s.0, b.1 - s.1) };
        let far = (-0.5 * sum.0, -0.5 * sum.1);
        let size = sum.0 * sum.0 + sum.1 * sum.1;
        if size == 0.0 {
            return far;
        }
        let near = (-2.0 * (c.0 * sum.0 + c.1 * sum.1) / size, -2.0 * (c.1 * sum.0 - c.0 * sum.1) / size);
        if near.0 >= far.0 { near } else { far }
    }

    /// `Re z^+`: the growth rate of the wave, in units of `1 / tau`, for `k` in (0, pi]; negative where it decays.
    pub fn growth_rate(&self, k: f64) -> f64 {
        self.root(k).0
    }

    /// `Re z^+` after one step of Newton's method from [`Response::root`]: its difference from
    /// [`Response::growth_rate`] is the error of the latter.
    pub fn refined_growth_rate(&self, k: f64) -> f64 {
        refined_rate(self.root(k), self.polynomial(k))
    }

    /// The wave with the largest margin by a finer grid of waves than that of [`Response::margin`] (0: the limit of
    /// long waves).
    pub fn largest_by_finer_grid(&self) -> f64 {
        const FINER: usize = 7;
        self.over_all(FINER).1
    }

    /// How far a wave `k` in (0, pi] is from stability, in units of `1 / tau^2`, negative when it decays: `-D / ((1 -
    /// cos k) sum_j f_{s_j})`, or `-D` where that sum is not positive. Where `Re b <= 0`, which no relaxation
    /// outweighs, at least `-Re b`.
    pub fn margin_of(&self, k: f64) -> f64 {
        let half = math::sin(0.5 * k);
        self.margin_with(k, half, self.polynomial_with(k, half))
    }

    fn margin_with(&self, k: f64, half: f64, (b, c): (Complex, Complex)) -> f64 {
        let d = b.0 * b.0 * c.0 + b.0 * b.1 * c.1 - c.1 * c.1;
        // a neutral wave, one that all neighbours together do not answer, neither grows nor decays
        let d = if d.abs() <= self.rounding(half, k, b, c) { 0.0 } else { d };
        self.damped(-d / (2.0 * half * half * self.stiffness()), b.0)
    }

    /// As large an error as the rounding of `b(k)` and `c(k)` can leave in `D`; 0 with one neighbour, whose terms do
    /// not cancel.
    fn rounding(&self, half: f64, k: f64, b: Complex, c: Complex) -> f64 {
        if self.spacings.len() < 2 {
            return 0.0;
        }
        let sum = |list: &[(i32, f64)], part: &dyn Fn(f64) -> f64| -> f64 {
            list.iter().map(|(j, slope)| slope.abs() * part(f64::from(*j).abs() * k)).sum()
        };
        // a wave number rounded by half a unit turns a term by that times its angle
        let speeds = sum(&self.speeds, &|angle| 1.0 + angle);
        let spacings = 2.0 * half.abs() * sum(&self.spacings, &|angle| 1.0 + angle);
        let largest = b.0.abs() + b.1.abs();
        2.0 * f64::EPSILON
            * (largest * largest * spacings + largest * speeds * (c.0.abs() + c.1.abs()) + c.1.abs() * spacings)
            + (f64::EPSILON * spacings) * (f64::EPSILON * spacings)
    }

    /// The limit of [`Response::margin_of`] for long waves, `k -> 0`.
    pub fn long_wave_margin(&self) -> f64 {
        let moment = |list: &[(i32, f64)], power: i32| -> f64 {
            list.iter().map(|(j, slope)| slope * f64::from(j.pow(power as u32))).sum()
        };
        let (s0, s1) = (moment(&self.spacings, 0), moment(&self.spacings, 1));
        let (v0, v1) = (moment(&self.speeds, 0), moment(&self.speeds, 1));
        let d = v0 * v0 * (0.5 * s0 + s1) - v0 * v1 * s0 - s0 * s0;
        self.damped(-2.0 * d / self.stiffness(), -v0)
    }

    /// `sum_j f_{s_j}`, or 1 where it is not positive.
    fn stiffness(&self) -> f64 {
        let sum: f64 = self.spacings.iter().map(|(_, slope)| slope).sum();
        if sum > 0.0 { sum } else { 1.0 }
    }

    fn damped(&self, margin: f64, re_b: f64) -> f64 {
        if re_b > 0.0 || margin > -re_b { margin } else { -re_b }
    }

    /// The largest margin over the waves, and its `k` (0: the limit of long waves).
    pub fn margin(&self, waves: Waves) -> (f64, f64) {
        match waves {
            Waves::Ring(pedestrians) => {
                let waves = (1..=pedestrians / 2).map(|l| wave_number(l, pedestrians));
                self.largest((f64::NAN, 0.0), waves)
            }
            Waves::All => self.over_all(4),
        }
    }

    /// The largest margin over the waves of a ring, as [`Response::margin`] gives it, and the largest growth rate of
    /// them, as [`Response::fastest`] does: each wave is worked out once for both.
    pub fn of_ring(&self, pedestrians: usize) -> (f64, f64) {
        let waves = (1..=pedestrians / 2).map(|l| wave_number(l, pedestrians));
        waves.fold((f64::NAN, f64::NAN), |(margin, rate), k| {
            let half = math::sin(0.5 * k);
            let polynomial = self.polynomial_with(k, half);
            let own = [self.margin_with(k, half, polynomial), Response::root_of(polynomial).0];
            let largest = |known: f64, own: f64| if own > known || known.is_nan() { own } else { known };
            (largest(margin, own[0]), largest(rate, own[1]))
        })
    }

    /// The larger of a margin, with its `k`, and those of these waves.
    fn largest(&self, known: (f64, f64), waves: impl Iterator<Item = f64>) -> (f64, f64) {
        waves.fold(known, |best, k| {
            let margin = self.margin_of(k);
            if margin > best.0 || best.0.is_nan() { (margin, k) } else { best }
        })
    }

    /// The largest margin over all waves: the best of a grid, `fineness` points for each wave length of the stencil's
    /// widest pair, and what lies next to it. With one predecessor the margin and `Re b` are linear in `cos k`, so that
    /// one end or the other is the largest.
    fn over_all(&self, fineness: usize) -> (f64, f64) {
        let long = (self.long_wave_margin(), 0.0);
        if self.looks_at_one() {
            return self.largest(long, std::iter::once(PI));
        }
        let count = self.grid(fineness);
        let step = PI / count as f64;
        let coarse = self.largest(long, (1..=count).map(|i| step * i as f64));
        self.refined(coarse, step)
    }

    /// Whether it depends only on a pedestrian's own spacing and speed and on the speed ahead.
    fn looks_at_one(&self) -> bool {
        self.spacings.iter().all(|(j, _)| *j == 0) && self.speeds.iter().all(|(j, _)| *j == 0 || *j == 1)
    }

    /// The least and the largest wave number that grows, of all `k` in (0, pi] (0: the limit of long waves). `None`
    /// where none does. Between the two, a wide stencil may have waves that decay: see [`Response::growing_bands`].
    pub fn growing(&self) -> Option<(f64, f64)> {
        let bands = self.growing_bands();
        Some((bands.first()?.0, bands.last()?.1))
    }

    /// The bands of wave numbers that grow, in ascending order: the least and the largest `k` of each (0: the limit of
    /// long waves). A stencil of several neighbours may have more than one.
    pub fn growing_bands(&self) -> Vec<(f64, f64)> {
        let count = self.grid(4);
        let step = PI / count as f64;
        let mut waves: Vec<(f64, bool)> = vec![(0.0, self.long_wave_margin() > 0.0)];
        waves.extend((1..=count).map(|i| step * i as f64).map(|k| (k, self.margin_of(k) > 0.0)));
        // a band that lies between two of the grid
        let (margin, k) = self.margin(Waves::All);
        let next = waves.partition_point(|(other, _)| *other < k);
        if margin > 0.0 && next > 0 && next < waves.len() && !waves[next - 1].1 && !waves[next].1 {
            waves.insert(next, (k, true));
        }
        let mut bands = Vec::new();
        let mut least = waves[0].1.then_some(0.0);
        for pair in waves.windows(2) {
            let [(left, grows_left), (right, grows_right)] = [pair[0], pair[1]];
            match (grows_left, grows_right) {
                // where the limit itself does not grow, rounding decides about the longest waves
                (false, true) => least = Some(self.edge(if left == 0.0 { 1e-9 } else { left }, right)),
                (true, false) => bands.extend(least.take().map(|least| (least, self.edge(right, left)))),
                _ => {}
            }
        }
        bands.extend(least.map(|least| (least, PI)));
        bands
    }

    /// Where growth begins, between a wave that decays and one that grows, by bisection.
    fn edge(&self, decaying: f64, growing: f64) -> f64 {
        let (mut decaying, mut growing) = (decaying, growing);
        for _ in 0..60 {
            let middle = 0.5 * (decaying + growing);
            if self.margin_of(middle) > 0.0 { growing = middle } else { decaying = middle }
        }
        growing
    }

    /// The largest growth rate, in units of `1 / tau`, among the waves of a ring of `N >= 2`, `k = 2 pi l / N` for `l =
    /// 1 .. N/2`, and its `l`.
    pub fn fastest(&self, pedestrians: usize) -> (f64, usize) {
        fastest(pedestrians, |k| self.growth_rate(k))
    }

    /// How many waves of a grid are looked at: `fineness` times the stencil.
    fn grid(&self, fineness: usize) -> usize {
        let widest = self.spacings.iter().chain(&self.speeds).map(|(j, _)| j.unsigned_abs()).max();
        16 * fineness * (widest.unwrap_or(0) as usize + 2)
    }

    /// The maximum next to the best of a grid, by a golden section.
    fn refined(&self, coarse: (f64, f64), step: f64) -> (f64, f64) {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        if coarse.1 == 0.0 {
            return coarse;
        }
        let (mut low, mut high) = (coarse.1 - step, if coarse.1 + step > PI { PI } else { coarse.1 + step });
        let mut best = coarse;
        for _ in 0..60 {
            let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
            let (at_left, at_right) = (self.margin_of(left), self.margin_of(right));
            for (margin, k) in [(at_left, left), (at_right, right)] {
                best = if margin > best.0 { (margin, k) } else { best };
            }
            (low, high) = if at_left > at_right { (low, right) } else { (left, high) };
        }
        best
    }
}

/// A complex number, real and imaginary part.
pub type Complex = (f64, f64);

/// The real part of a root of `z^2 + b z + c` after one step of Newton's method, with the residual in double-double
/// precision.
fn refined_rate((re, im): Complex, (b, c): (Complex, Complex)) -> f64 {
    let product = |x: f64, y: f64| DoubleDouble::product(x, y);
    let residual_re = product(re, re) - product(im, im) + product(b.0, re) - product(b.1, im) + DoubleDouble::from(c.0);
    let residual_im =
        product(re, im) * DoubleDouble::from(2.0) + product(b.0, im) + product(b.1, re) + DoubleDouble::from(c.1);
    let (slope_re, slope_im) = (2.0 * re + b.0, 2.0 * im + b.1);
    let size = slope_re * slope_re + slope_im * slope_im;
    re - (residual_re.hi * slope_re + residual_im.hi * slope_im) / size
}

/// The wave number of the wave that goes `l` times into a ring.
fn wave_number(l: usize, pedestrians: usize) -> f64 {
    2.0 * PI * l as f64 / pedestrians as f64
}

/// The largest growth rate among the waves of a ring, `l = 1 .. N/2`, and its `l`.
fn fastest(pedestrians: usize, growth_rate: impl Fn(f64) -> f64) -> (f64, usize) {
    let rate = |l: usize| (growth_rate(wave_number(l, pedestrians)), l);
    (2..=pedestrians / 2).map(rate).fold(rate(1), |best, next| if next.0 > best.0 { next } else { best })
}

impl Linear {
    /// Of a law without derivatives.
    pub const NONE: Linear = Linear { phi: f64::NAN, beta: f64::NAN, kappa: f64::NAN };

    /// The coefficients of a response to one predecessor; [`Linear::NONE`] of any other.
    pub fn of(response: &Response) -> Linear {
        let slope = |list: &[(i32, f64)], wanted: i32| list.iter().find(|(j, _)| *j == wanted).map_or(0.0, |(_, f)| *f);
        if !response.looks_at_one() {
            return Linear::NONE;
        }
        let (own, ahead) = (slope(&response.speeds, 0), slope(&response.speeds, 1));
        Linear { phi: slope(&response.spacings, 0), beta: -0.5 * (own + ahead + 1.0), kappa: 0.5 * (ahead - own - 1.0) }
    }

    /// The root `z^+` with the larger real part, for the wave number `k` in (0, pi]. (At `k = 0` it is 0: a shift of
    /// all pedestrians, which is no perturbation.)
    pub fn root(&self, k: f64) -> Complex {
        let (b, c) = self.polynomial(k);
        let discriminant = (b.0 * b.0 - b.1 * b.1 - 4.0 * c.0, 2.0 * b.0 * b.1 - 4.0 * c.1);
        let s = complex_sqrt(discriminant.0, discriminant.1);
        // -2 c / (b + s) rather than (s - b) / 2: both have a real part >= 0, so nothing cancels for small k
        let (re, im) = (b.0 + s.0, b.1 + s.1);
        let size = re * re + im * im;
        (-2.0 * (c.0 * re + c.1 * im) / size, -2.0 * (c.1 * re - c.0 * im) / size)
    }

    /// `Re z^+`: the growth rate of the wave.
    pub fn growth_rate(&self, k: f64) -> f64 {
        self.root(k).0
    }

    /// `Re z^+` after one step of Newton's method from [`Linear::root`], with the residual in double-double precision:
    /// its difference from [`Linear::growth_rate`] is the error of the latter.
    pub fn refined_growth_rate(&self, k: f64) -> f64 {
        refined_rate(self.root(k), self.polynomial(k))
    }

    /// `b` and `c` of `z^2 + b z + c = 0`.
    pub fn polynomial(&self, k: f64) -> (Complex, Complex) {
        let half = math::sin(0.5 * k);
        // 1 - e^{ik} without cancellation
        let one_minus = (2.0 * half * half, -math::sin(k));
        let one_plus = (2.0 - one_minus.0, -one_minus.1);
        let b = (
            1.0 + self.beta * one_plus.0 + self.kappa * one_minus.0,
            self.beta * one_plus.1 + self.kappa * one_minus.1,
        );
        (b, (self.phi * one_minus.0, self.phi * one_minus.1))
    }

    /// How far the wave `k` is from stability: negative when it decays. From
    /// `phi (1 + cos k) < (1 + 2 kappa) ((1 + 2 kappa) + (beta - kappa) (1 + cos k))`, the exact condition.
    pub fn margin(&self, k: f64) -> f64 {
        let half = math::cos(0.5 * k);
        let one_plus_cos = 2.0 * half * half;
        let a = 1.0 + 2.0 * self.kappa;
        self.phi * one_plus_cos - a * (a + (self.beta - self.kappa) * one_plus_cos)
    }

    /// The same for all waves: long ones (`k -> 0`) are the first to grow, `2 phi < (1 + 2 kappa) (1 + 2 beta)`.
    pub fn long_wave_margin(&self) -> f64 {
        2.0 * self.phi - (1.0 + 2.0 * self.kappa) * (1.0 + 2.0 * self.beta)
    }

    /// The largest margin over all waves. It is linear in `cos k`: that of long waves or that of the shortest, `k =
    /// pi`, which always decays but may do so more slowly.
    pub fn largest_margin(&self) -> f64 {
        math::larger(self.long_wave_margin(), self.margin(PI))
    }

    /// The largest growth rate among the waves `k = 2 pi l / N`, `l = 1 .. N/2`, and its `l`.
    pub fn fastest(&self, pedestrians: usize) -> (f64, usize) {
        fastest(pedestrians, |k| self.growth_rate(k))
    }
}
