//! Several doubles side by side, as one instruction on wide registers processes them.
//!
//! Operations are plain loops of fixed length, which the compiler turns into vector code; for the body of a
//! [`Kernel`](crate::simd::Kernel). The operations of several registers do not wait for each other, so a processor
//! overlaps them.

use crate::lane::{self, SoftplusBase};
use crate::number::Number;
use crate::row::pieces::{self, Room};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `W` doubles of one unit, one for each pedestrian of a block. Each lane has the bits of the same operations on one
/// double; NaN in a lane stays in that lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const W: usize>(pub [f64; W]);

impl<const W: usize> Default for Lanes<W> {
    #[inline(always)]
    fn default() -> Lanes<W> {
        Lanes([0.0; W])
    }
}

impl<const W: usize> Lanes<W> {
    /// The first `W` of a slice.
    ///
    /// # Panics
    /// The slice is shorter.
    #[inline(always)]
    pub fn of(values: &[f64]) -> Lanes<W> {
        let mut lanes = [0.0; W];
        lanes.copy_from_slice(&values[..W]);
        Lanes(lanes)
    }

    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(value: f64) -> Lanes<W> {
        Lanes([value; W])
    }
}

/// Applies an expression lane by lane. A macro, because a closure of some length would not be inlined, and compiled for
/// the narrow registers then.
macro_rules! lane_by_lane {
    ($x:ident of $lanes:expr => $value:expr) => {{
        let mut lanes = $lanes.0;
        for lane in &mut lanes {
            let $x = *lane;
            *lane = $value;
        }
        Lanes(lanes)
    }};
    ($x:ident of $lanes:expr, $y:ident of $others:expr => $value:expr) => {{
        let mut lanes = $lanes.0;
        for (lane, $y) in lanes.iter_mut().zip($others.0) {
            let $x = *lane;
            *lane = $value;
        }
        Lanes(lanes)
    }};
}
pub(crate) use lane_by_lane;

/// From this number of lanes on, a function is evaluated in several short loops, which a processor overlaps better and
/// whose constants it has registers for (see [`row`](crate::row)).
const MANY: usize = 32;

/// Applies a function of a lane, or where there are many lanes a function of a piece of a row.
macro_rules! function {
    ($x:ident of $lanes:expr => $value:expr, $piece:ident, $room:ident => $of_piece:expr) => {
        if W < MANY {
            lane_by_lane!($x of $lanes => $value)
        } else {
            let mut $piece = $lanes.0;
            let [mut a, mut b, mut c, mut d] = [[0.0; W]; 4];
            let $room: Room<'_> = [&mut a, &mut b, &mut c, &mut d];
            $of_piece;
            Lanes($piece)
        }
    };
    ($function:ident of $lanes:expr) => {
        function!(x of $lanes => lane::$function(x), piece, room => pieces::$function(&mut piece, room))
    };
}

impl<const W: usize> Lanes<W> {
    /// softplus(y0 + x) - softplus(y0).
    #[inline(always)]
    pub(crate) fn softplus_difference(self, base: &SoftplusBase) -> Lanes<W> {
        function!(x of self => lane::softplus_difference(base, x),
            piece, room => pieces::softplus_difference(base, &mut piece, room))
    }
}

impl<const W: usize> Neg for Lanes<W> {
    type Output = Lanes<W>;
    #[inline(always)]
    fn neg(self) -> Lanes<W> {
        lane_by_lane!(x of self => -x)
    }
}

/// An operator of two blocks, and of a block and a constant.
macro_rules! operator {
    ($trait:ident, $name:ident, $operator:tt) => {
        impl<const W: usize> $trait for Lanes<W> {
            type Output = Lanes<W>;
            #[inline(always)]
            fn $name(self, other: Lanes<W>) -> Lanes<W> {
                lane_by_lane!(a of self, b of other => a $operator b)
            }
        }

        impl<const W: usize> $trait<f64> for Lanes<W> {
            type Output = Lanes<W>;
            #[inline(always)]
            fn $name(self, other: f64) -> Lanes<W> {
                lane_by_lane!(a of self => a $operator other)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<const W: usize> Number for Lanes<W> {
    #[inline(always)]
    fn recip(self) -> Lanes<W> {
        lane_by_lane!(x of self => 1.0 / x)
    }

    #[inline(always)]
    fn powi(self, n: i32) -> Lanes<W> {
        // chosen once for all lanes
        let product = match n.unsigned_abs() {
            0 => Lanes::splat(1.0),
            1 => self,
            2 => self * self,
            3 => self * self * self,
            n => (1..n).fold(self, |product, _| product * self),
        };
        if n < 0 { product.recip() } else { product }
    }

    #[inline(always)]
    fn powf(self, q: f64) -> Lanes<W> {
        (self.ln() * q).exp()
    }

    #[inline(always)]
    fn exp(self) -> Lanes<W> {
        function!(exp of self)
    }

    #[inline(always)]
    fn exp_m1(self) -> Lanes<W> {
        function!(exp_m1 of self)
    }

    #[inline(always)]
    fn ln(self) -> Lanes<W> {
        lane_by_lane!(x of self => lane::ln(x))
    }

    #[inline(always)]
    fn ln_1p(self) -> Lanes<W> {
        function!(ln_1p of self)
    }

    #[inline(always)]
    fn sqrt(self) -> Lanes<W> {
        lane_by_lane!(x of self => x.sqrt())
    }

    #[inline(always)]
    fn tanh(self) -> Lanes<W> {
        function!(tanh of self)
    }

    #[inline(always)]
    fn softplus(self) -> Lanes<W> {
        function!(softplus of self)
    }

    #[inline(always)]
    fn abs(self) -> Lanes<W> {
        lane_by_lane!(x of self => x.abs())
    }

    #[inline(always)]
    fn min(self, other: Lanes<W>) -> Lanes<W> {
        lane_by_lane!(a of self, b of other => Number::min(a, b))
    }

    #[inline(always)]
    fn max(self, other: Lanes<W>) -> Lanes<W> {
        lane_by_lane!(a of self, b of other => Number::max(a, b))
    }
}
