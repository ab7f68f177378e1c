//! Recurrences for the next coefficient of an operation's result, from the coefficients of its operands and its own
//! earlier ones.
//!
//! An elementary function solves a differential equation of its own, which is a recurrence for its coefficients (R. E.
//! Moore, *Interval Analysis*, 1966, chapter 11; E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary Differential
//! Equations I*, section I.8). With `a' = sum k a_k t^(k-1)` the numbers `k a_k` are called rates below.

use super::{Block, Coefficient};

/// Rows that an operation keeps, as long as the series. Behind them it keeps one block more, of order 0.
const ROWS: usize = 3;

/// All blocks that it keeps, for series of this length.
#[inline(always)]
pub fn memory(length: usize) -> usize {
    ROWS * length + 1
}

/// The memory of one operation, and the order that is computed.
#[derive(Clone, Copy, Debug)]
pub struct History<'t, C: Copy> {
    rows: &'t [Block<C>],
    length: usize,
    order: usize,
}

/// A row: the coefficients of one series.
type Row<'t, C> = &'t [Block<C>];

impl<'t, C: Coefficient> History<'t, C> {
    /// In [`memory`] for series of this length.
    #[inline(always)]
    pub fn new(rows: Row<'t, C>, length: usize, order: usize) -> History<'t, C> {
        History { rows, length, order }
    }

    #[inline(always)]
    fn row(self, index: usize) -> Row<'t, C> {
        &self.rows[index * self.length..][..if index < ROWS { self.length } else { 1 }]
    }

    /// Writes the coefficient of this order.
    #[inline(always)]
    fn write(self, index: usize, value: C) {
        self.row(index)[self.order].set(value);
    }

    /// A coefficient of order 0.
    #[inline(always)]
    fn first(self, index: usize) -> C {
        self.row(index)[0].get()
    }

    /// The coefficients of the argument of a kink, if it is the memory of one.
    pub fn argument(self) -> impl Iterator<Item = C> {
        self.row(ARGUMENT).iter().map(Block::get)
    }

    /// `a_1 b_{k-1} + ... + a_{k-1} b_1`: the coefficient of this order of a product, less its ends. To be called
    /// before the coefficient of this order is written to row `a`, where the sum of the next order waits meanwhile.
    ///
    /// Every second order goes through the rows, and finds on its way all of the next sum but the ends, which have
    /// coefficients that do not exist yet: the numbers loaded serve for both.
    #[inline(always)]
    fn inner(self, a: usize, b: usize) -> C {
        let order = self.order;
        if order < 2 {
            return C::default();
        }
        let (row, others) = (self.row(a), &self.row(b)[..order]);
        if order % 2 == 1 {
            let (mut sum, row) = (row[order].get(), &row[..order]);
            // both ends; in a loop, since the compiler would tear two products to pieces
            let mut i = 1;
            while i < order {
                sum = sum + row[i].get() * others[order - i].get();
                i += order - 2;
            }
            return sum;
        }
        let first = &row[..order];
        let (mut sum, mut next) = (first[1].get() * others[order - 1].get(), C::default());
        // by index: iterators that run against each other cost several times the sum
        for i in 2..order {
            let a = first[i].get();
            sum = sum + a * others[order - i].get();
            next = next + a * others[order + 1 - i].get();
        }
        if order + 1 < self.length {
            row[order + 1].set(next);
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
pub fn product<C: Coefficient, const START: bool>(h: History<'_, C>, a: C, b: C) -> C {
    let inner = if START { C::default() } else { h.inner(0, 1) };
    h.write(0, a);
    h.write(1, b);
    if START { a * b } else { (h.first(0) * b + a * h.first(1)) + inner }
}

/// Of c = a / b, from `c b = a`.
#[inline(always)]
pub fn quotient<C: Coefficient, const START: bool>(h: History<'_, C>, a: C, b: C) -> C {
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
pub fn recip<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    h.write(0, a);
    let c = if START { a.recip() } else { -((h.first(1) * a + h.inner(1, 0)) * h.first(1)) };
    h.write(1, c);
    c
}

/// Of a^n for a negative n, where a does not vanish.
#[inline(always)]
pub fn whole_power<C: Coefficient, const START: bool>(h: History<'_, C>, a: C, n: i32) -> C {
    if START { start_power(h, a, a.powi(n)) } else { next_whole_power(h, a, f64::from(n)) }
}

/// Of a^q, a > 0.
#[inline(always)]
pub fn power<C: Coefficient, const START: bool>(h: History<'_, C>, a: C, q: f64) -> C {
    if START { start_power(h, a, a.powf(q)) } else { next_power(h, a, q) }
}

#[inline(always)]
fn start_power<C: Coefficient>(h: History<'_, C>, a: C, f: C) -> C {
    h.write(0, a);
    h.write(1, f);
    h.write(2, a.recip());
    f
}

/// From `a f' = q f a'`: `k a_0 f_k = sum (q (k - j) - j) a_{k-j} f_j` over `j < k`.
#[inline(always)]
fn next_power<C: Coefficient>(h: History<'_, C>, a: C, q: f64) -> C {
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

/// [`next_power`] for a whole q, whose factors are whole numbers: each follows from the one before without rounding.
#[inline(always)]
fn next_whole_power<C: Coefficient>(h: History<'_, C>, a: C, q: f64) -> C {
    h.write(0, a);
    let (k, order) = (h.k(), h.order);
    let mut factor = q * k;
    let mut sum = h.first(1) * a * factor;
    if order > 1 {
        let (powers, numbers) = (&h.row(1)[1..order], &h.row(0)[1..order]);
        #[allow(clippy::needless_range_loop)]
        for i in 0..powers.len() {
            let (f, a) = (powers[i].get(), numbers[powers.len() - 1 - i].get());
            factor -= q + 1.0;
            sum = sum + (f * a) * factor;
        }
    }
    let f = sum * (h.first(2) * (1.0 / k));
    h.write(1, f);
    f
}

/// Of f = e^a.
#[inline(always)]
pub fn exp<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    if START {
        let f = a.exp();
        h.write(0, f);
        return f;
    }
    next_exp(h, a)
}

/// Of e^a - 1.
#[inline(always)]
pub fn exp_m1<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    if START {
        h.write(0, a.exp());
        return a.exp_m1();
    }
    next_exp(h, a)
}

/// From `f' = f a'`: `k f_k = sum f_j (k - j) a_{k-j}` over `j < k`.
#[inline(always)]
fn next_exp<C: Coefficient>(h: History<'_, C>, a: C) -> C {
    let rate = a * h.k();
    h.write(1, rate);
    let f = (h.first(0) * rate + h.inner(0, 1)) * (1.0 / h.k());
    h.write(0, f);
    f
}

/// Of ln a.
#[inline(always)]
pub fn ln<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    if START {
        h.write(1, a.recip());
        return a.ln();
    }
    next_ln(h, a)
}

/// Of ln(1 + a).
#[inline(always)]
pub fn ln_1p<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    if START {
        h.write(1, (a + 1.0).recip());
        return a.ln_1p();
    }
    next_ln(h, a)
}

/// From `a f' = a'` (`(1 + a) f' = a'`): `a_0 k f_k = k a_k - sum a_{k-j} j f_j` over `0 < j < k`.
#[inline(always)]
fn next_ln<C: Coefficient>(h: History<'_, C>, a: C) -> C {
    h.write(0, a);
    let rate = (a * h.k() - h.inner(2, 0)) * h.first(1);
    h.write(2, rate);
    rate * (1.0 / h.k())
}

/// Of f = sqrt(a), from `f^2 = a`.
#[inline(always)]
pub fn sqrt<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
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
pub fn tanh<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    if START {
        let f = a.tanh();
        h.write(0, f);
        // 1 - tanh^2 without cancellation: 4 e / (1 + e)^2 with e = exp(-|2 a|)
        let decay = (-(a * 2.0).abs()).exp();
        let inverse = (decay + 1.0).recip();
        h.write(1, (decay * inverse) * (inverse * 4.0));
        return f;
    }
    let (rate, squares) = (a * h.k(), h.inner(0, 0));
    let f = (h.first(1) * rate + h.inner(1, 2)) * (1.0 / h.k());
    h.write(0, f);
    h.write(1, -(h.first(0) * f * 2.0 + squares));
    h.write(2, rate);
    f
}

/// Of ln(1 + e^y) = h + max(y, 0), `h = ln(1 + e)`, `e = exp(-|y|)`: from `e' = -|y|' e` and `(1 + e) h' = e'`.
#[inline(always)]
pub fn softplus<C: Coefficient, const START: bool>(h: History<'_, C>, y: C) -> C {
    const DECAY: usize = 0;
    const EXPONENT_RATE: usize = 1;
    const REST_RATE: usize = 2;
    const INVERSE: usize = 3;
    if START {
        let [softplus, decay] = y.softplus_and_decay();
        h.write(DECAY, decay);
        // at order 0 there is no rate: the sign of the exponent stands there
        let one = C::default() + 1.0;
        h.write(EXPONENT_RATE, C::choose(-y, one, -one));
        h.write(INVERSE, (decay + 1.0).recip());
        return softplus;
    }
    let (k, sign) = (h.k(), h.first(EXPONENT_RATE));
    let y_rate = y * k;
    let above = C::choose(sign, C::default(), y_rate);
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
pub fn abs<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    a * side::<C, START>(h, a)
}

/// Of the smaller of a and b, on the side that they enter.
#[inline(always)]
pub fn min<C: Coefficient, const START: bool>(h: History<'_, C>, a: C, b: C) -> C {
    C::choose(side::<C, START>(h, b - a), a, b)
}

/// Of the larger of a and b, on the side that they enter.
#[inline(always)]
pub fn max<C: Coefficient, const START: bool>(h: History<'_, C>, a: C, b: C) -> C {
    C::choose(side::<C, START>(h, a - b), a, b)
}

/// The row of a kink in which its argument stands: that of `abs`, and what `min` and `max` compare.
const ARGUMENT: usize = 1;

/// The sign of a series for small times: that of its first coefficient which does not vanish, 0 before there is one.
#[inline(always)]
fn side<C: Coefficient, const START: bool>(h: History<'_, C>, a: C) -> C {
    let known = if START { C::default() } else { h.first(0) };
    let sign = C::sign(known, a);
    h.row(0)[0].set(sign);
    h.write(ARGUMENT, a);
    sign
}
