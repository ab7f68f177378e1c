//! The bits of a hundred thousand results of every function, as one number each. They
//! must be the same on every machine; whoever changes a function on purpose takes the
//! new numbers from the message of the failed test.

use crate::sample::{Map, Random};
use math::double_double::{DoubleDouble, full};
use math::lane::{self, SoftplusBase};
use math::simd::dispatch;

/// The hash FNV-1a of the bits of the results, lowest byte first.
fn hash(results: impl Iterator<Item = f64>) -> u64 {
    let bytes = results.flat_map(|result| result.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn lanes(x: &[f64], f: impl Fn(f64) -> f64) -> u64 {
    let mut out = vec![0.0; x.len()];
    dispatch(Map { f, x, out: &mut out });
    hash(out.into_iter())
}

fn arguments(low: f64, high: f64) -> Vec<f64> {
    let mut random = Random(90);
    (0..100_000).map(|_| random.uniform(low, high)).collect()
}

#[test]
fn scalar_functions_have_the_pinned_bits() {
    let positive = arguments(0.0, 10.0);
    let signed = arguments(-20.0, 20.0);
    let of = |x: &[f64], f: fn(f64) -> f64| hash(x.iter().map(|&x| f(x)));
    let hashes = [
        ("exp", of(&signed, math::exp)),
        ("exp_m1", of(&signed, math::exp_m1)),
        ("sin", of(&signed, math::sin)),
        ("cos", of(&signed, math::cos)),
        ("ln", of(&positive, math::ln)),
        ("ln_1p", of(&positive, math::ln_1p)),
        ("log10", of(&positive, math::log10)),
        ("pow", of(&positive, |x| math::pow(x, -2.3))),
        ("complex_sqrt", of(&signed, |x| math::complex_sqrt(x, 1.0).1)),
    ];
    assert_pinned(&hashes, &SCALARS);
}

#[test]
fn lanes_have_the_pinned_bits() {
    let positive = arguments(0.0, 10.0);
    let signed = arguments(-20.0, 20.0);
    let base = SoftplusBase::new(0.7);
    let hashes = [
        ("exp", lanes(&signed, lane::exp)),
        ("exp_m1", lanes(&signed, lane::exp_m1)),
        ("softplus", lanes(&signed, lane::softplus)),
        ("sigmoid", lanes(&signed, lane::sigmoid)),
        ("tanh", lanes(&signed, lane::tanh)),
        ("softplus_difference", lanes(&signed, move |x| lane::softplus_difference(&base, x))),
        ("ln", lanes(&positive, lane::ln)),
        ("ln_1p", lanes(&positive, lane::ln_1p)),
        ("pow", lanes(&positive, |x| lane::pow(x, -2.3))),
        ("pow_m1", lanes(&positive, |x| lane::pow_m1(x, 0.3))),
    ];
    assert_pinned(&hashes, &LANES);
}

#[test]
fn twofold_functions_have_the_pinned_bits() {
    let arguments = |low: f64, high: f64| -> Vec<DoubleDouble> {
        let mut random = Random(91);
        (0..20_000).map(|_| DoubleDouble::sum(random.uniform(low, high), random.uniform(-1e-18, 1e-18))).collect()
    };
    let of = |x: &[DoubleDouble], f: fn(DoubleDouble) -> DoubleDouble| {
        hash(x.iter().map(|x| f(*x)).flat_map(|y| [y.hi, y.lo]))
    };
    let (positive, signed) = (arguments(0.01, 10.0), arguments(-20.0, 20.0));
    let hashes = [
        ("exp", of(&signed, full::exp)),
        ("exp_m1", of(&signed, full::exp_m1)),
        ("ln", of(&positive, full::ln)),
        ("ln_1p", of(&positive, full::ln_1p)),
        ("softplus", of(&signed, full::softplus)),
        ("tanh", of(&signed, full::tanh)),
        ("exp to 80 bits", of(&signed, DoubleDouble::exp)),
        ("exp_m1 to 80 bits", of(&signed, DoubleDouble::exp_m1)),
        ("ln to 80 bits", of(&positive, DoubleDouble::ln)),
        ("ln_1p to 80 bits", of(&positive, DoubleDouble::ln_1p)),
        ("sqrt", of(&positive, DoubleDouble::sqrt)),
    ];
    assert_pinned(&hashes, &TWOFOLDS);
}

#[track_caller]
fn assert_pinned(hashes: &[(&str, u64)], pinned: &[(&str, u64)]) {
    let table = |rows: &[(&str, u64)]| -> String {
        rows.iter().map(|(name, hash)| format!("    (\"{name}\", 0x{hash:016x}),\n")).collect()
    };
    assert!(hashes == pinned, "the bits are\n{}pinned are\n{}", table(hashes), table(pinned));
}

const SCALARS: [(&str, u64); 9] = [
    ("exp", 0xd20389a7ae6e1d6d),
    ("exp_m1", 0x2ed2793b0e665eb1),
    ("sin", 0xe83a008be6a73b48),
    ("cos", 0xdd224e573a610721),
    ("ln", 0x952251c0a0d94c34),
    ("ln_1p", 0xe0ec8ecb7ffa8ee5),
    ("log10", 0x85ca453cc8bf9e79),
    ("pow", 0xe75b343ce2349ae6),
    ("complex_sqrt", 0x23f089d1338adca7),
];

const TWOFOLDS: [(&str, u64); 11] = [
    ("exp", 0xe56bb08a2858e4ed),
    ("exp_m1", 0xf786fb7bf26a791d),
    ("ln", 0x0221a9275a5e4ce5),
    ("ln_1p", 0xebb90bee9772cf85),
    ("softplus", 0x5429c5a7f1645ee3),
    ("tanh", 0x2a37ecacc396d96a),
    ("exp to 80 bits", 0x1bd22ccdb517d040),
    ("exp_m1 to 80 bits", 0xb6f2124f7719fb58),
    ("ln to 80 bits", 0xa8abd71507c392fc),
    ("ln_1p to 80 bits", 0xefc4239a59561178),
    ("sqrt", 0xded8369eda032efc),
];

const LANES: [(&str, u64); 10] = [
    ("exp", 0x9e59492749fa0b36),
    ("exp_m1", 0x2ace3e0efa874206),
    ("softplus", 0x0b7b5d398378e9d2),
    ("sigmoid", 0x06070d237d73e4b8),
    ("tanh", 0xbc44e26cf286a0fb),
    ("softplus_difference", 0xbe2b53e55bfd604d),
    ("ln", 0x5c68dc0e4dc0ee00),
    ("ln_1p", 0xc85676a352a2f58a),
    ("pow", 0xfb36583e697e675d),
    ("pow_m1", 0x1dff3bd83ba33430),
];
