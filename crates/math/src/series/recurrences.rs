//! Recurrences for the next coefficient of an operation's result, from the coefficients of its operands and its own
//! earlier ones.
//!
//! An elementary function solves a differential equation of its own, which is a recurrence for its coefficients (R. E.
//! Moore, *Interval Analysis*, 1966, chapter 11; E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary Differential
//! Equations I*, section I.8). With `a' = sum k a_k t^(k-1)` the numbers `k a_k` are called rates below.

use super::Block;
use crate::lane;
use crate::lanes::{Lanes, lane_by_lane};
use crate::number::Number;

/// Rows of memory of an operation.
pub const ROWS: usize = 4;

/// The memory of one operation, and the order that is computed.
#[derive(Clone, Copy, Debug)]
pub struct History<'t, const W: usize> {
    rows: &'t [Block<W>],
    length: usize,
    order: usize,
}

/// A row: the coefficients of one series.
type Row<'t, const W: usize> = &'t [Block<W>];

impl<'t, const W: usize> History<'t, W> {
    /// [`ROWS`] rows of `length` coefficients.
    #[inline(always)]
    pub fn new(rows: Row<'t, W>, length: usize, order: usize) -> History<'t, W> {
        History { rows, length, order }
    }

    #[inline(always)]
    fn row(self, index: usize) -> Row<'t, W> {
        &self.rows[index * self.length..(index + 1) * self.length]
    }

    /// Writes the coefficient of this order.
    #[inline(always)]
    fn write(self, index: usize, value: Lanes<W>) {
        self.row(index)[self.order].set(value);
    }

    /// A coefficient of order 0.
    #[inline(always)]
    fn first(self, index: usize) -> Lanes<W> {
        self.row(index)[0].get()
    }

    /// `a_1 b_{k-1} + ... + a_{k-1} b_1`: the coefficient of this order of a product, less its ends.
    #[inline(always)]
    fn inner(self, a: usize, b: usize) -> Lanes<W> {
        let mut sum = Lanes::default();
        if self.order > 1 {
            let (a, b) = (&self.row(a)[1..self.order], &self.row(b)[1..self.order]);
            // by index: iterators that run against each other cost several times the sum
            #[allow(clippy::needless_range_loop)]
            for i in 0..a.len() {
                sum = sum + a[i].get() * b[a.len() - 1 - i].get();
            }
        }
        sum
    }

    #[inline(always)]
    fn k(self) -> f64 {
        self.order as f64
    }
}

/// Of a b.
#[inline(always)]
pub fn product<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    h.write(0, a);
    h.write(1, b);
    if START { a * b } else { (h.first(0) * b + a * h.first(1)) + h.inner(0, 1) }
}

/// Of c = a / b, from `c b = a`.
#[inline(always)]
pub fn quotient<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    h.write(0, b);
    if START {
        h.write(2, b.recip());
        let c = a / b;
        h.write(1, c);
        return c;
    }
    let c = (a - (h.first(1) * b + h.inner(1, 0))) * h.first(2);
    h.write(1, c);
    c
}

/// Of c = 1 / a, from `c a = 1`.
#[inline(always)]
pub fn recip<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    h.write(0, a);
    let c = if START { a.recip() } else { -((h.first(1) * a + h.inner(1, 0)) * h.first(1)) };
    h.write(1, c);
    c
}

/// Of a^n for a negative n, where a does not vanish.
#[inline(always)]
pub fn whole_power<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>, n: i32) -> Lanes<W> {
    if START { start_power(h, a, a.powi(n)) } else { next_power(h, a, f64::from(n)) }
}

/// Of a^q, a > 0.
#[inline(always)]
pub fn power<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>, q: f64) -> Lanes<W> {
    if START { start_power(h, a, a.powf(q)) } else { next_power(h, a, q) }
}

#[inline(always)]
fn start_power<const W: usize>(h: History<'_, W>, a: Lanes<W>, f: Lanes<W>) -> Lanes<W> {
    h.write(0, a);
    h.write(1, f);
    h.write(2, a.recip());
    f
}

/// From `a f' = q f a'`: `k a_0 f_k = sum (q (k - j) - j) a_{k-j} f_j` over `j < k`.
#[inline(always)]
fn next_power<const W: usize>(h: History<'_, W>, a: Lanes<W>, q: f64) -> Lanes<W> {
    h.write(0, a);
    let (k, order) = (h.k(), h.order);
    let mut sum = h.first(1) * a * (q * k);
    if order > 1 {
        let (powers, numbers) = (&h.row(1)[1..order], &h.row(0)[1..order]);
        let mut j = 1.0;
        #[allow(clippy::needless_range_loop)]
        for i in 0..powers.len() {
            let (f, a) = (powers[i].get(), numbers[powers.len() - 1 - i].get());
            sum = sum + (f * a) * (q * (k - j) - j);
            j += 1.0;
        }
    }
    let f = sum * (h.first(2) * (1.0 / k));
    h.write(1, f);
    f
}

/// Of f = e^a.
#[inline(always)]
pub fn exp<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    if START {
        let f = a.exp();
        h.write(0, f);
        return f;
    }
    next_exp(h, a)
}

/// Of e^a - 1.
#[inline(always)]
pub fn exp_m1<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    if START {
        h.write(0, a.exp());
        return a.exp_m1();
    }
    next_exp(h, a)
}

/// From `f' = f a'`: `k f_k = sum f_j (k - j) a_{k-j}` over `j < k`.
#[inline(always)]
fn next_exp<const W: usize>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    let rate = a * h.k();
    h.write(1, rate);
    let f = (h.first(0) * rate + h.inner(0, 1)) * (1.0 / h.k());
    h.write(0, f);
    f
}

/// Of ln a.
#[inline(always)]
pub fn ln<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    if START {
        h.write(1, a.recip());
        return a.ln();
    }
    next_ln(h, a)
}

/// Of ln(1 + a).
#[inline(always)]
pub fn ln_1p<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    if START {
        h.write(1, (a + 1.0).recip());
        return a.ln_1p();
    }
    next_ln(h, a)
}

/// From `a f' = a'` (`(1 + a) f' = a'`): `a_0 k f_k = k a_k - sum a_{k-j} j f_j` over `0 < j < k`.
#[inline(always)]
fn next_ln<const W: usize>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    h.write(0, a);
    let rate = (a * h.k() - h.inner(2, 0)) * h.first(1);
    h.write(2, rate);
    rate * (1.0 / h.k())
}

/// Of f = sqrt(a), from `f^2 = a`.
#[inline(always)]
pub fn sqrt<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    if START {
        let f = a.sqrt();
        h.write(0, f);
        h.write(1, (f * 2.0).recip());
        return f;
    }
    let f = (a - h.inner(0, 0)) * h.first(1);
    h.write(0, f);
    f
}

/// Of f = tanh a, from `f' = p a'`, `p = 1 - f^2`.
#[inline(always)]
pub fn tanh<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    if START {
        let f = a.tanh();
        h.write(0, f);
        // 1 - tanh^2 without cancellation
        h.write(1, lane_by_lane!(a of a => 4.0 * (lane::sigmoid(2.0 * a) * lane::sigmoid(-2.0 * a))));
        return f;
    }
    let rate = a * h.k();
    h.write(2, rate);
    let f = (h.first(1) * rate + h.inner(1, 2)) * (1.0 / h.k());
    h.write(0, f);
    h.write(1, -(h.first(0) * f * 2.0 + h.inner(0, 0)));
    f
}

/// Of ln(1 + e^y) = h + max(y, 0), `h = ln(1 + e)`, `e = exp(-|y|)`: from `e' = -|y|' e` and `(1 + e) h' = e'`.
#[inline(always)]
pub fn softplus<const W: usize, const START: bool>(h: History<'_, W>, y: Lanes<W>) -> Lanes<W> {
    const DECAY: usize = 0;
    const EXPONENT_RATE: usize = 1;
    const REST_RATE: usize = 2;
    const INVERSE: usize = 3;
    if START {
        let decay = lane_by_lane!(y of y => lane::exp(-y.abs()));
        h.write(DECAY, decay);
        // at order 0 there is no rate: the sign of the exponent stands there
        h.write(EXPONENT_RATE, lane_by_lane!(y of y => if y > 0.0 { -1.0 } else { 1.0 }));
        h.write(INVERSE, (decay + 1.0).recip());
        return y.softplus();
    }
    let (k, sign) = (h.k(), h.first(EXPONENT_RATE));
    let y_rate = y * k;
    let above = lane_by_lane!(sign of sign, rate of y_rate => if sign < 0.0 { rate } else { 0.0 });
    let exponent_rate = sign * y_rate;
    let decay_rate = h.first(DECAY) * exponent_rate + h.inner(DECAY, EXPONENT_RATE);
    let rest_rate = (decay_rate - h.inner(REST_RATE, DECAY)) * h.first(INVERSE);
    h.write(EXPONENT_RATE, exponent_rate);
    h.write(DECAY, decay_rate * (1.0 / k));
    h.write(REST_RATE, rest_rate);
    (rest_rate + above) * (1.0 / k)
}

/// Of |a|: the series on the side that it enters.
#[inline(always)]
pub fn abs<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    a * side::<W, START>(h, a)
}

/// Of the smaller of a and b, on the side that they enter.
#[inline(always)]
pub fn min<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    choose(side::<W, START>(h, b - a), a, b)
}

/// Of the larger of a and b, on the side that they enter.
#[inline(always)]
pub fn max<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    choose(side::<W, START>(h, a - b), a, b)
}

/// The first where the sign is not negative, else the second.
#[inline(always)]
fn choose<const W: usize>(sign: Lanes<W>, a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    let mut chosen = a;
    for lane in 0..W {
        chosen.0[lane] = if sign.0[lane] < 0.0 { b.0[lane] } else { a.0[lane] };
    }
    chosen
}

/// 1, -1 or 0.
#[inline(always)]
fn sign_of(a: f64) -> f64 {
    let positive = if a > 0.0 { 1.0 } else { 0.0 };
    if a < 0.0 { -1.0 } else { positive }
}

/// The sign of a series for small times: that of its first coefficient which does not vanish, 0 before there is one.
#[inline(always)]
fn side<const W: usize, const START: bool>(h: History<'_, W>, a: Lanes<W>) -> Lanes<W> {
    let known = if START { Lanes::default() } else { h.first(0) };
    let sign = lane_by_lane!(known of known, a of a => if known == 0.0 { sign_of(a) } else { known });
    h.row(0)[0].set(sign);
    sign
}
