//! The stability of a uniform flow by independent means in double-double arithmetic. The difference from
//! [`Model::response`] and [`Response::margin`] is their error.
//!
//! The law is carried out in double-double numbers; its slopes are differences, not derivatives; the steady speed is
//! improved by Newton's method; the powers of `e^{ik}` are products. What is shared is the law as a formula.

use crate::force::Source;
use crate::laws::{Formula, Law, Model};
use crate::stability::Response;
use math::double_double::DoubleDouble;

/// A slope for each neighbour.
type Slopes = Vec<(i32, DoubleDouble)>;

/// How the acceleration answers to spacings and speeds (see [`Response`]).
#[derive(Clone, Debug)]
pub struct Precise {
    spacings: Slopes,
    speeds: Slopes,
}

/// A part of the size of a variable, for differences: its square is beyond double-double numbers, also on the scale of
/// ramps.
const PART: f64 = 1e-13;

impl Precise {
    /// In the uniform flow with this headway (in units of `a_0`), whose speed is next to this one; found by Newton's
    /// method.
    pub fn new(model: &Model, headway: f64, speed: f64) -> Precise {
        let at = |spacing: DoubleDouble, speed: DoubleDouble| accelerate(model, &|_| spacing, &|_| speed);
        let (spacing, mut v) = (DoubleDouble::from(headway) - model.contact(), DoubleDouble::from(speed));
        for _ in 0..2 {
            let h = DoubleDouble::from(PART * (1.0 + speed.abs()));
            let slope = (at(spacing, v + h) - at(spacing, v - h)) / (h + h);
            let better = v - at(spacing, v) / slope;
            // a speed that is no simple root stays
            v = if (better.hi - speed).abs() <= 1e-9 * (1.0 + speed.abs()) { better } else { v };
        }
        Precise::at(model, spacing, v)
    }

    /// Where standing pedestrians would have this net gap: the response does not depend on the speed of their flow.
    pub fn at_gap(model: &Model, gap: f64) -> Precise {
        Precise::at(model, DoubleDouble::from(gap), DoubleDouble::ZERO)
    }

    fn at(model: &Model, net_gap: DoubleDouble, speed: DoubleDouble) -> Precise {
        let (behind, ahead) = match model {
            Model::Formula(formula) => formula.reach(),
            _ => (0, 1),
        };
        let slope = |is_spacing: bool, place: i32| {
            let size = if is_spacing { net_gap.hi } else { speed.hi };
            let h = PART * (1.0 + size.abs());
            let shifted = |h: f64| {
                let more = |j: i32, here: bool| if here && j == place { h } else { 0.0 };
                accelerate(model, &|j| net_gap + more(j, is_spacing), &|j| speed + more(j, !is_spacing))
            };
            (shifted(h) - shifted(-h)) / DoubleDouble::from(2.0 * h)
        };
        let slopes = |is_spacing: bool| {
            let places = -(behind as i32)..=ahead as i32;
            places.map(|j| (j, slope(is_spacing, j))).filter(|(_, slope)| slope.hi != 0.0).collect()
        };
        Precise { spacings: slopes(true), speeds: slopes(false) }
    }

    /// The same, rounded to doubles.
    pub fn rounded(&self) -> Response {
        let rounded = |slopes: &Slopes| slopes.iter().map(|(j, slope)| (*j, f64::from(*slope))).collect();
        Response { spacings: rounded(&self.spacings), speeds: rounded(&self.speeds) }
    }

    /// The largest margin over all waves, by a finer grid of waves than that of [`Response::margin`].
    pub fn margin(&self) -> f64 {
        f64::from(self.margin_of(self.rounded().largest_by_finer_grid()))
    }

    /// See [`Response::margin_of`]; 0 is the limit of long waves.
    fn margin_of(&self, k: f64) -> DoubleDouble {
        let sum = self.spacings.iter().fold(DoubleDouble::ZERO, |sum, (_, slope)| sum + *slope);
        let stiffness = if sum.hi > 0.0 { sum } else { DoubleDouble::ONE };
        if k == 0.0 {
            let moment = |slopes: &Slopes, power: u32| {
                slopes.iter().fold(DoubleDouble::ZERO, |sum, (j, slope)| sum + *slope * f64::from(j.pow(power)))
            };
            let (s0, s1) = (sum, moment(&self.spacings, 1));
            let (v0, v1) = (moment(&self.speeds, 0), moment(&self.speeds, 1));
            let d = v0 * v0 * (s0 * 0.5 + s1) - v0 * v1 * s0 - s0 * s0;
            return damped(-(d + d) / stiffness, -v0);
        }
        // the angle whose cosine this double is, and its sine
        let cos = DoubleDouble::from(math::cos(k));
        let sin = (DoubleDouble::ONE - cos * cos).sqrt();
        let wave = (cos, sin);
        let rest = (DoubleDouble::ONE - cos, -sin);
        let b = times_powers(&self.speeds, wave);
        let c = product(times_powers(&self.spacings, wave), rest);
        let b = (-b.0, -b.1);
        let d = b.0 * b.0 * c.0 + b.0 * b.1 * c.1 - c.1 * c.1;
        damped(-d / (rest.0 * stiffness), b.0)
    }
}

fn damped(margin: DoubleDouble, re_b: DoubleDouble) -> DoubleDouble {
    if re_b.hi > 0.0 || (margin + re_b).hi > 0.0 { margin } else { -re_b }
}

type Complex = (DoubleDouble, DoubleDouble);

fn product(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

/// The sum of the slopes, each times the power of `wave` by its place.
fn times_powers(slopes: &Slopes, wave: Complex) -> Complex {
    let power = |j: i32| {
        let factor = if j < 0 { (wave.0, -wave.1) } else { wave };
        (0..j.unsigned_abs()).fold((DoubleDouble::ONE, DoubleDouble::ZERO), |power, _| product(power, factor))
    };
    slopes.iter().fold((DoubleDouble::ZERO, DoubleDouble::ZERO), |sum, (j, slope)| {
        let (re, im) = power(*j);
        (sum.0 + *slope * re, sum.1 + *slope * im)
    })
}

/// The acceleration for net gaps and speeds of neighbours.
fn accelerate(
    model: &Model,
    net_gap: &dyn Fn(i32) -> DoubleDouble,
    speed: &dyn Fn(i32) -> DoubleDouble,
) -> DoubleDouble {
    match model {
        Model::Algebraic(law) => of_law(law, net_gap, speed),
        Model::Exponential(law) => of_law(law, net_gap, speed),
        Model::Logarithmic(law) => of_law(law, net_gap, speed),
        Model::Formula(law) => of_formula(law, net_gap, speed),
        Model::Own(law) => law.precise(net_gap(0), speed(0), speed(1)),
    }
}

fn of_law<L: Law>(law: &L, net_gap: &dyn Fn(i32) -> DoubleDouble, speed: &dyn Fn(i32) -> DoubleDouble) -> DoubleDouble {
    law.acceleration(net_gap(0), speed(0), speed(1))
}

fn of_formula(
    law: &Formula,
    net_gap: &dyn Fn(i32) -> DoubleDouble,
    speed: &dyn Fn(i32) -> DoubleDouble,
) -> DoubleDouble {
    law.carry_out(|source| match source {
        Source::Spacing { j, net: true } => net_gap(j),
        Source::Spacing { j, net: false } => net_gap(j) + law.contact(),
        Source::Speed(j) => speed(j),
        Source::Register(_) => DoubleDouble::ZERO,
    })
}
