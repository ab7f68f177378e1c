//! Every width of vector registers gives the same bits, and so does a single call.

use crate::sample::{Map, Random};
use math::lane::{self, SoftplusBase};
use math::row::{self, Scratch};
use math::simd::{Kernel, Width, available, dispatch, dispatch_up_to};

const WIDTHS: [Width; 3] = [Width::Baseline, Width::Four, Width::Eight];

#[track_caller]
fn assert_same_bits(name: &str, x: &[f64], f: impl Fn(f64) -> f64 + Copy) {
    let single: Vec<u64> = x.iter().map(|&x| f(std::hint::black_box(x)).to_bits()).collect();
    for width in WIDTHS {
        let mut out = vec![0.0; x.len()];
        dispatch_up_to(width, Map { f, x, out: &mut out });
        let first = (0..x.len()).find(|&i| out[i].to_bits() != single[i]);
        assert_eq!(first.map(|i| (x[i], out[i])), None, "{name} at {width:?}");
    }
}

/// Arguments of all sizes and signs, the edges of ranges among them; an odd number, so
/// that single values remain beside the vectors.
fn arguments() -> Vec<f64> {
    let mut random = Random(70);
    let mut x = vec![0.0, -0.0, 709.78, 709.79, -708.0, -708.1, 1e300, -1e300, f64::INFINITY, f64::NEG_INFINITY];
    x.extend((0..30_000).map(|_| random.signed_spread(1e-300, 1e5)));
    x.extend((0..30_000).map(|_| random.uniform(-750.0, 750.0)));
    x.extend((0..30_001).map(|_| random.uniform(-2.0, 2.0)));
    x
}

#[test]
fn lanes_have_the_same_bits_at_every_width() {
    println!("the widest registers here: {:?}", available());
    let x = arguments();
    assert_same_bits("exp", &x, lane::exp);
    assert_same_bits("exp_m1", &x, lane::exp_m1);
    assert_same_bits("softplus", &x, lane::softplus);
    assert_same_bits("sigmoid", &x, lane::sigmoid);
    assert_same_bits("tanh", &x, lane::tanh);
    for y0 in [-750.0, -25.0, -0.3, 0.0, 0.3, 25.0, 750.0] {
        let base = SoftplusBase::new(y0);
        assert_same_bits("softplus_difference", &x, move |d| lane::softplus_difference(&base, d));
    }
    let positive: Vec<f64> = x.iter().map(|x| x.abs()).filter(|&x| x > 0.0).collect();
    assert_same_bits("ln", &positive, lane::ln);
    assert_same_bits("ln_1p", &positive, lane::ln_1p);
    assert_same_bits("ln_1p", &x, |x| lane::ln_1p(if x > -1.0 { x } else { 0.5 }));
    assert_same_bits("pow", &positive, |x| lane::pow(x, -2.5));
    assert_same_bits("pow_m1", &positive, |x| lane::pow_m1(x, 0.3));
}

/// Sums are folded in their order at every width.
struct Sum<'a>(&'a [f64]);

impl Kernel for Sum<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        self.0.iter().fold(0.0, |sum, x| sum + x * 1.1)
    }
}

#[test]
fn kernels_that_return_a_value_have_the_same_bits_at_every_width() {
    let mut random = Random(71);
    let x: Vec<f64> = (0..1001).map(|_| random.uniform(-1.0, 1.0)).collect();
    let sums = WIDTHS.map(|width| dispatch_up_to(width, Sum(&x)).to_bits());
    assert_eq!(sums, [dispatch(Sum(&x)).to_bits(); 3]);
}

/// A function of rows, on a row.
struct InRows<'a>(fn(&mut [f64], &mut Scratch), &'a mut [f64]);

impl Kernel for InRows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        (self.0)(self.1, &mut Scratch::default());
    }
}

#[test]
fn rows_have_the_bits_of_their_lanes() {
    let mut random = Random(73);
    let x = arguments();
    let base = SoftplusBase::new(-1.7);
    // none, parts of registers and of rows, and several rows with a remainder
    for length in (0..20).chain([255, 256, 257, 1000, x.len()]) {
        let begin = (random.bits() % (x.len() - length + 1) as u64) as usize;
        let x = &x[begin..][..length];
        let above: Vec<f64> = x.iter().map(|&x| if x > -1.0 { x } else { 0.5 }).collect();
        assert_row("exp", x, row::exp, lane::exp);
        assert_row("exp_m1", x, row::exp_m1, lane::exp_m1);
        assert_row("softplus", x, row::softplus, lane::softplus);
        assert_row("tanh", x, row::tanh, lane::tanh);
        assert_row("ln_1p", &above, row::ln_1p, lane::ln_1p);
        let mut row = x.to_vec();
        row::softplus_difference(&base, &mut row, &mut Scratch::default());
        let lanes: Vec<f64> = x.iter().map(|&x| lane::softplus_difference(&base, x)).collect();
        assert!(is_same(&row, &lanes), "softplus_difference, {length}");
    }
}

fn is_same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

#[track_caller]
fn assert_row(name: &str, x: &[f64], in_row: fn(&mut [f64], &mut Scratch), lane: fn(f64) -> f64) {
    let mut row = x.to_vec();
    dispatch(InRows(in_row, &mut row));
    let lanes: Vec<f64> = x.iter().map(|&x| lane(x)).collect();
    assert!(is_same(&row, &lanes), "{name}, {}", x.len());
}

#[test]
fn a_softplus_and_its_decay_are_those_of_their_own_functions() {
    for x in arguments() {
        let [softplus, decay] = lane::softplus_and_decay(x);
        let own = [lane::softplus(x), lane::exp(-x.abs())];
        assert_eq!([softplus, decay].map(f64::to_bits), own.map(f64::to_bits), "at {x:e}");
    }
}
