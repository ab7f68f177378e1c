//! Linear stability of the uniform flow, exactly and for every wave number.
//!
//! Each law linearises to `eps_n'' = kappa (eps_{n+1}' - eps_n') + phi (eps_{n+1} - eps_n) - beta (eps_n' + eps_{n+1}') - eps_n'`.
//! A wave `exp(z t + i k n)` then obeys
//! `z^2 + (1 + beta (1 + e^{ik}) + kappa (1 - e^{ik})) z + phi (1 - e^{ik}) = 0` (eq:stabN, eq:stab_neu_av).

use math::complex_sqrt;
use math::twofold::Twofold;

/// The coefficients of the linearised law; all >= 0 for the laws of the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Response to the gap.
    pub phi: f64,
    /// Response to the speeds through the space requirement.
    pub beta: f64,
    /// Response to the relative speed.
    pub kappa: f64,
}

/// A complex number, real and imaginary part.
pub type Complex = (f64, f64);

impl Linear {
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

    /// `Re z^+` after one step of Newton's method from [`Linear::root`], with the residual in twofold precision: its
    /// difference from [`Linear::growth_rate`] is the error of the latter.
    pub fn refined_growth_rate(&self, k: f64) -> f64 {
        let (re, im) = self.root(k);
        let (b, c) = self.polynomial(k);
        let product = |x: f64, y: f64| Twofold::product(x, y);
        let residual_re = product(re, re) - product(im, im) + product(b.0, re) - product(b.1, im) + Twofold::from(c.0);
        let residual_im =
            product(re, im) * Twofold::from(2.0) + product(b.0, im) + product(b.1, re) + Twofold::from(c.1);
        let (slope_re, slope_im) = (2.0 * re + b.0, 2.0 * im + b.1);
        let size = slope_re * slope_re + slope_im * slope_im;
        re - (residual_re.hi * slope_re + residual_im.hi * slope_im) / size
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

    /// [`Linear::long_wave_margin`] in twofold precision.
    pub fn refined_margin(&self) -> f64 {
        let twice = |x: f64| Twofold::from(2.0) * x;
        let one = Twofold::from(1.0);
        (twice(self.phi) - (one + twice(self.kappa)) * (one + twice(self.beta))).hi
    }

    /// The largest growth rate among the waves `k = 2 pi l / N`, `l = 1 .. N/2`, and its `l`.
    pub fn fastest(&self, pedestrians: usize) -> (f64, usize) {
        let rate = |l: usize| self.growth_rate(2.0 * std::f64::consts::PI * l as f64 / pedestrians as f64);
        let mut fastest = (rate(1), 1);
        for l in 2..=pedestrians / 2 {
            let candidate = rate(l);
            if candidate > fastest.0 {
                fastest = (candidate, l);
            }
        }
        fastest
    }
}
