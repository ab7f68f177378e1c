//! The difference of a formula from its value at a reference state, without cancellation.
//!
//! A formula is carried out twice. First at the reference, with [`Reference`] numbers: every operation that is not
//! linear leaves on a [`Tape`] what it needs of the reference. Then with [`Change`]s, as often as wanted: the
//! operations take what they find on the tape, in the same order, and give the difference to a relative error of the
//! order of rounding, however small it is (see [`rules`]). A difference has the unit of the value; where the reference
//! or the changed argument lies beyond the range of a function it is NaN.

mod changed;
pub mod rules;

pub use changed::Changed;

use crate::lanes::{Lanes, lane_by_lane};
use crate::number::Number;
use rules::Kept;
use std::cell::{Cell, RefCell};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// As many operations that are not linear as a formula may have.
const CAPACITY: usize = 16;

/// What the operations of a formula keep of the reference, in their order.
#[derive(Clone, Debug)]
pub struct Tape {
    kept: [Kept; CAPACITY],
    length: usize,
    /// Products of which a power consists, less one for each operation.
    more: usize,
    /// Operations with a kink.
    kinks: usize,
    /// Whether an exponential is next to nothing.
    is_faint: bool,
}

impl Default for Tape {
    fn default() -> Tape {
        Tape { kept: [Kept::default(); CAPACITY], length: 0, more: 0, kinks: 0, is_faint: false }
    }
}

impl Tape {
    /// As many operations keep something for a [series](crate::series) of the formula, at most.
    pub fn histories(&self) -> usize {
        self.length + self.more
    }

    /// Whether the formula has kinks: `abs`, `min` or `max`.
    pub fn has_kinks(&self) -> bool {
        self.kinks > 0
    }

    /// Whether an exponential of the reference is next to nothing, so that its factor e^da may overflow where the
    /// product does not: then [`Change`]s give NaN or infinities there.
    pub fn is_faint(&self) -> bool {
        self.is_faint
    }
}

/// A tape being written.
#[derive(Debug)]
pub struct Recorder(RefCell<Tape>);

/// A value at the reference.
#[derive(Clone, Copy, Debug)]
pub struct Reference<'t> {
    tape: &'t Recorder,
    value: f64,
}

impl Recorder {
    /// An empty tape.
    pub fn new() -> Recorder {
        Recorder(RefCell::default())
    }

    /// A variable of the formula, with its value at the reference.
    pub fn variable(&self, value: f64) -> Reference<'_> {
        Reference { tape: self, value }
    }

    /// The tape, once the formula has been carried out.
    pub fn finish(self) -> Tape {
        self.0.into_inner()
    }

    /// Writes one operation down.
    ///
    /// # Panics
    /// A formula of more than 16 operations that are not linear.
    fn keep(&self, kept: Kept) {
        let mut tape = self.0.borrow_mut();
        let next = tape.length;
        assert!(next < CAPACITY, "a compiled formula has at most {CAPACITY} operations that are not linear");
        tape.kept[next] = kept;
        tape.length = next + 1;
    }
}

impl Default for Recorder {
    fn default() -> Recorder {
        Recorder::new()
    }
}

impl Reference<'_> {
    /// The value.
    pub fn value(self) -> f64 {
        self.value
    }

    fn map(self, kept: Kept, value: f64) -> Self {
        self.tape.keep(kept);
        Reference { value, ..self }
    }

    /// Of an operation with a kink.
    fn with_kink(self, kept: Kept, value: f64) -> Self {
        self.tape.0.borrow_mut().kinks += 1;
        self.map(kept, value)
    }

    /// Of an exponential, or one less 1.
    fn with_exponential(self, value: f64) -> Self {
        let kept = Kept::of_exp(self.value);
        self.tape.0.borrow_mut().is_faint |= rules::is_faint(&kept);
        self.map(kept, value)
    }
}

/// A tape being read, from its beginning.
#[derive(Debug)]
pub struct Player<'t> {
    tape: &'t Tape,
    next: Cell<usize>,
}

impl<'t> Player<'t> {
    /// Reads this tape.
    #[inline(always)]
    pub fn new(tape: &'t Tape) -> Player<'t> {
        Player { tape, next: Cell::new(0) }
    }

    /// A variable of the formula, as its change from the reference, one for each of `W` pedestrians.
    #[inline(always)]
    pub fn variable<const W: usize>(&self, change: Lanes<W>) -> Change<'_, W> {
        Change { player: self, change }
    }

    #[inline(always)]
    fn kept(&self) -> &'t Kept {
        let next = self.next.get();
        self.next.set(next + 1);
        // the recorder has seen that there is no more; the remainder spares the test
        &self.tape.kept[next % CAPACITY]
    }
}

/// How much a value differs from that at the reference, for `W` pedestrians.
#[derive(Clone, Copy, Debug)]
pub struct Change<'t, const W: usize> {
    player: &'t Player<'t>,
    change: Lanes<W>,
}

impl<const W: usize> Change<'_, W> {
    /// The differences.
    #[inline(always)]
    pub fn change(self) -> Lanes<W> {
        self.change
    }
}

/// Applies a rule to the changes of one number or two.
macro_rules! changed {
    ($number:ident, $kept:ident, $a:ident => $value:expr) => {{
        let $kept = *$number.player.kept();
        Change { change: lane_by_lane!($a of $number.change => $value), ..$number }
    }};
    ($number:ident, $kept:ident, $a:ident, $b:ident of $other:ident => $value:expr) => {{
        let $kept = *$number.player.kept();
        Change { change: lane_by_lane!($a of $number.change, $b of $other.change => $value), ..$number }
    }};
}

impl Neg for Reference<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Reference { value: -self.value, ..self }
    }
}

impl<const W: usize> Neg for Change<'_, W> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Change { change: -self.change, ..self }
    }
}

/// An operation that is linear in its variables: the reference does not matter.
macro_rules! linear {
    ($trait:ident, $name:ident, $operator:tt) => {
        impl $trait for Reference<'_> {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Reference { value: self.value $operator other.value, ..self }
            }
        }

        impl<const W: usize> $trait for Change<'_, W> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Change { change: self.change $operator other.change, ..self }
            }
        }
    };
}

linear!(Add, add, +);
linear!(Sub, sub, -);

/// An operation with a constant: its effect on the value, and on a change of it.
macro_rules! constant {
    ($trait:ident, $name:ident, $operator:tt, $change:ident, $other:ident => $value:expr) => {
        impl $trait<f64> for Reference<'_> {
            type Output = Self;
            fn $name(self, other: f64) -> Self {
                Reference { value: self.value $operator other, ..self }
            }
        }

        impl<const W: usize> $trait<f64> for Change<'_, W> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, $other: f64) -> Self {
                let $change = self.change;
                Change { change: $value, ..self }
            }
        }
    };
}

constant!(Add, add, +, change, _constant => change);
constant!(Sub, sub, -, change, _constant => change);
constant!(Mul, mul, *, change, factor => change * factor);
// a change is as exact when it is multiplied by the reciprocal, which is computed once
constant!(Div, div, /, change, divisor => change * (1.0 / divisor));

impl Mul for Reference<'_> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.map(Kept::of_product(self.value, other.value), self.value * other.value)
    }
}

impl<const W: usize> Mul for Change<'_, W> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        changed!(self, kept, a, b of other => rules::product(&kept, a, b))
    }
}

impl Div for Reference<'_> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.map(Kept::of_quotient(self.value, other.value), self.value / other.value)
    }
}

impl<const W: usize> Div for Change<'_, W> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        changed!(self, kept, a, b of other => rules::quotient(&kept, a, b))
    }
}

/// The functions, each with the values it stores and its rule; marked functions also have a rule for many values at
/// once.
macro_rules! functions {
    ($(@ $long:ident, $long_kept:ident, $rows:ident;)* $($name:ident, $kept:ident, $rule:ident;)*) => {
        impl Number for Reference<'_> {
            $(fn $long(self) -> Self {
                self.map(Kept::$long_kept(self.value), Number::$long(self.value))
            })*

            $(fn $name(self) -> Self {
                self.map(Kept::$kept(self.value), Number::$name(self.value))
            })*

            fn powi(self, n: i32) -> Self {
                let products = n.max(2) as usize - 1;
                self.tape.0.borrow_mut().more += products - 1;
                self.map(Kept::of_whole_power(self.value, n), Number::powi(self.value, n))
            }

            fn powf(self, q: f64) -> Self {
                self.map(Kept::of_power(self.value, q), Number::powf(self.value, q))
            }

            fn exp(self) -> Self {
                self.with_exponential(Number::exp(self.value))
            }

            fn exp_m1(self) -> Self {
                self.with_exponential(Number::exp_m1(self.value))
            }

            fn min(self, other: Self) -> Self {
                self.with_kink(Kept::of_pair(self.value, other.value), Number::min(self.value, other.value))
            }

            fn max(self, other: Self) -> Self {
                self.with_kink(Kept::of_pair(self.value, other.value), Number::max(self.value, other.value))
            }

            fn abs(self) -> Self {
                self.with_kink(Kept::of_abs(self.value), Number::abs(self.value))
            }
        }

        impl<const W: usize> Number for Change<'_, W> {
            $(#[inline(always)]
            fn $long(self) -> Self {
                let kept = *self.player.kept();
                Change { change: rules::$rows(&kept, self.change), ..self }
            })*

            $(#[inline(always)]
            fn $name(self) -> Self {
                changed!(self, kept, a => rules::$rule(&kept, a))
            })*

            #[inline(always)]
            fn powi(self, n: i32) -> Self {
                // chosen once for all lanes
                match n {
                    -3 => changed!(self, kept, a => rules::whole_power(&kept, a, -3)),
                    -2 => changed!(self, kept, a => rules::whole_power(&kept, a, -2)),
                    -1 => changed!(self, kept, a => rules::whole_power(&kept, a, -1)),
                    1 => changed!(self, kept, a => rules::whole_power(&kept, a, 1)),
                    2 => changed!(self, kept, a => rules::whole_power(&kept, a, 2)),
                    3 => changed!(self, kept, a => rules::whole_power(&kept, a, 3)),
                    _ => changed!(self, kept, a => rules::whole_power(&kept, a, n)),
                }
            }

            #[inline(always)]
            fn powf(self, q: f64) -> Self {
                let kept = *self.player.kept();
                Change { change: rules::power_of(&kept, self.change, q), ..self }
            }

            #[inline(always)]
            fn exp(self) -> Self {
                let kept = *self.player.kept();
                Change { change: rules::exp_of(&kept, self.change), ..self }
            }

            #[inline(always)]
            fn exp_m1(self) -> Self {
                self.exp()
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                changed!(self, kept, a, b of other => rules::min(&kept, a, b))
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                changed!(self, kept, a, b of other => rules::max(&kept, a, b))
            }

            #[inline(always)]
            fn abs(self) -> Self {
                changed!(self, kept, a => rules::abs(&kept, a))
            }
        }
    };
}

functions! {
    @ ln, of_ln, ln_of;
    @ ln_1p, of_ln_1p, ln_of;
    @ softplus, of_softplus, softplus_of;
    recip, of_recip, recip;
    sqrt, of_sqrt, sqrt;
    tanh, of_tanh, tanh;
}
