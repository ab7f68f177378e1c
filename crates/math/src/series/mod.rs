//! Power series of a formula along a motion, computed order by order.
//!
//! Each operation has a recurrence for its next coefficient ([`recurrences`]). A formula is carried out once for each
//! order, with [`Jet`]s that hold the coefficients of this order: linear operations act on these, the others read and
//! write the earlier ones in a [`OrderMemory`].
//!
//! The coefficient of order `k` is that of `(t / u)^k`, with any unit of time `u` that all variables share: it has the
//! unit of the value. At order 0 functions have the range of their [lanes](crate::lane); NaN there makes all later
//! orders NaN.

pub mod recurrences;

use crate::lane;
use crate::lanes::{Lanes, lane_by_lane};
use crate::number::Number;
use recurrences as next;
use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What series have as coefficients: numbers, whose functions are needed at order 0 only.
pub trait Coefficient: Number + Default {
    /// The first where the sign is not negative, else the second.
    fn choose(sign: Self, first: Self, second: Self) -> Self;

    /// The sign that is known, 1 or -1; where it is 0, that of a number.
    fn sign(known: Self, number: Self) -> Self;

    /// ln(1 + e^x), and e^-|x|, from which it can be made.
    #[inline(always)]
    fn softplus_and_decay(self) -> [Self; 2] {
        [self.softplus(), (-self.abs()).exp()]
    }
}

/// 1, -1 or 0.
#[inline(always)]
pub(crate) fn sign_of(a: f64) -> f64 {
    let positive = if a > 0.0 { 1.0 } else { 0.0 };
    if a < 0.0 { -1.0 } else { positive }
}

impl<const W: usize> Coefficient for Lanes<W> {
    #[inline(always)]
    fn choose(sign: Self, first: Self, second: Self) -> Self {
        let mut chosen = first;
        for lane in 0..W {
            chosen.0[lane] = if sign.0[lane] < 0.0 { second.0[lane] } else { first.0[lane] };
        }
        chosen
    }

    #[inline(always)]
    fn sign(known: Self, number: Self) -> Self {
        lane_by_lane!(known of known, a of number => if known == 0.0 { sign_of(a) } else { known })
    }

    #[inline(always)]
    fn softplus_and_decay(self) -> [Self; 2] {
        let (mut softplus, mut decay) = (self.0, self.0);
        for (softplus, decay) in softplus.iter_mut().zip(&mut decay) {
            [*softplus, *decay] = lane::softplus_and_decay(*softplus);
        }
        [Lanes(softplus), Lanes(decay)]
    }
}

/// The coefficients of one order, of the pedestrians of a block. Aligned as the widest registers are: a load across two
/// cache lines costs two of them.
#[derive(Clone, Debug, Default)]
#[repr(align(64))]
pub struct Block<C: Copy>(Cell<C>);

impl<C: Coefficient> Block<C> {
    #[inline(always)]
    fn get(&self) -> C {
        self.0.get()
    }

    #[inline(always)]
    fn set(&self, coefficients: C) {
        self.0.set(coefficients);
    }
}

/// The blocks that an operation which is not linear keeps of series of this length.
#[inline(always)]
pub fn memory(length: usize) -> usize {
    recurrences::memory(length)
}

/// Where the operations of a formula keep earlier coefficients: [`memory`] for each operation that is not linear.
#[derive(Debug)]
pub struct OrderMemory<'t, C: Copy> {
    memory: &'t [Block<C>],
    /// Coefficients of a series.
    length: usize,
    /// The order that is computed.
    order: usize,
    next: Cell<usize>,
}

impl<'t, C: Coefficient> OrderMemory<'t, C> {
    /// For the coefficients of this `order`, from 0, of series of `length` coefficients (`order < length`). The blocks
    /// are [`memory(length)`](memory()) for each operation of the formula that is not linear
    /// ([`Tape::histories`](crate::change::Tape::histories)); with fewer it panics. Orders are computed one after the
    /// other, from 0.
    #[inline(always)]
    pub fn new(memory: &'t [Block<C>], length: usize, order: usize) -> OrderMemory<'t, C> {
        OrderMemory { memory, length, order, next: Cell::new(0) }
    }

    /// A variable: its coefficient of this order.
    #[inline(always)]
    pub fn variable<const START: bool>(&self, coefficient: C) -> Jet<'_, C, START> {
        Jet { place: self, coefficient }
    }

    /// The memory of the next operation.
    #[inline(always)]
    fn history(&self) -> next::History<'t, C> {
        let from = self.next.get();
        let end = from + memory(self.length);
        self.next.set(end);
        next::History::new(&self.memory[from..end], self.length, self.order)
    }
}

/// Coefficients of a series. `START` at order 0, where functions are evaluated; from order 1 on there are recurrences.
#[derive(Clone, Copy, Debug)]
pub struct Jet<'t, C: Copy, const START: bool> {
    place: &'t OrderMemory<'t, C>,
    coefficient: C,
}

impl<C: Coefficient, const START: bool> Jet<'_, C, START> {
    /// The coefficients of this order.
    #[inline(always)]
    pub fn coefficient(self) -> C {
        self.coefficient
    }

    #[inline(always)]
    fn with(self, coefficient: C) -> Self {
        Jet { coefficient, ..self }
    }
}

impl<C: Coefficient, const START: bool> Neg for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(-self.coefficient)
    }
}

impl<C: Coefficient, const START: bool> Add for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.coefficient + other.coefficient)
    }
}

impl<C: Coefficient, const START: bool> Sub for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.coefficient - other.coefficient)
    }
}

impl<C: Coefficient, const START: bool> Add<f64> for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        if START { self.with(self.coefficient + other) } else { self }
    }
}

impl<C: Coefficient, const START: bool> Sub<f64> for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        if START { self.with(self.coefficient - other) } else { self }
    }
}

impl<C: Coefficient, const START: bool> Mul<f64> for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.with(self.coefficient * other)
    }
}

impl<C: Coefficient, const START: bool> Div<f64> for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: f64) -> Self {
        self.with(self.coefficient / other)
    }
}

impl<C: Coefficient, const START: bool> Mul for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(next::product::<C, START>(self.place.history(), self.coefficient, other.coefficient))
    }
}

impl<C: Coefficient, const START: bool> Div for Jet<'_, C, START> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(next::quotient::<C, START>(self.place.history(), self.coefficient, other.coefficient))
    }
}

/// Functions of one number.
macro_rules! functions {
    ($($name:ident)*) => {
        $(#[inline(always)]
        fn $name(self) -> Self {
            self.with(next::$name::<C, START>(self.place.history(), self.coefficient))
        })*
    };
}

impl<C: Coefficient, const START: bool> Number for Jet<'_, C, START> {
    functions!(recip exp exp_m1 ln ln_1p sqrt tanh softplus abs);

    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        match n {
            0 => self.with(if START { C::default() + 1.0 } else { C::default() }),
            1 => self,
            -1 => self.recip(),
            // products, because the number may pass through 0
            2.. => {
                // a loop: a closure would be compiled for the narrow registers
                let mut product = self;
                for _ in 1..n {
                    product = product * self;
                }
                product
            }
            _ => self.with(next::whole_power::<C, START>(self.place.history(), self.coefficient, n)),
        }
    }

    #[inline(always)]
    fn powf(self, q: f64) -> Self {
        self.with(next::power::<C, START>(self.place.history(), self.coefficient, q))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.with(next::min::<C, START>(self.place.history(), self.coefficient, other.coefficient))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(next::max::<C, START>(self.place.history(), self.coefficient, other.coefficient))
    }
}
