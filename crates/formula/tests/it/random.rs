//! Ten thousand random formulas. Their values have the bits of a recursive evaluation of the tree; errors against
//! double-double stay within a running bound; derivatives are compared with differences in double-double.

use crate::common::{Random, graph, state};
use crate::dual::Dual;
use crate::running::Running;
use crate::trees::{PARAMETERS, tree};
use formula::{Bound, Kink, Variable};
use math::double_double::DoubleDouble;

const COUNT: usize = 10_000;

/// Random laws with their trees.
fn formulas(seed: u64) -> impl Iterator<Item = (String, crate::trees::Tree, Bound)> {
    let mut random = Random(seed);
    (0..COUNT).filter_map(move |_| {
        let tree = tree(&mut random, 5);
        let text = tree.text(&mut random);
        // every parameter must be used
        let padded = format!("{text}{}", PARAMETERS.map(|(name, _)| format!(" + 0*{name}")).concat());
        let graph = graph(&[("acceleration", &padded)], &PARAMETERS).unwrap_or_else(|error| panic!("{text}: {error}"));
        // a part without variables may have no value
        Some((text, tree, graph.bind(&graph.values()).ok()?))
    })
}

#[test]
fn bits_are_those_of_a_recursion_over_the_tree() {
    let (mut compared, mut undefined) = (0, 0);
    for (text, tree, bound) in formulas(1) {
        let expected = tree.value();
        match bound.eval(bound.acceleration(), state) {
            Ok(value) => {
                // the sum with a term that is gone can lose the sign of 0 only
                assert_eq!(value + 0.0, expected + 0.0, "{text}");
                compared += 1;
            }
            Err(error) => {
                assert!(!expected.is_finite(), "{text}: {expected} but {error}");
                undefined += 1;
            }
        }
    }
    println!("{compared} equal, {undefined} without a value");
    assert!(compared > COUNT * 3 / 4, "{compared} compared");
}

#[test]
fn errors_keep_within_the_running_bound() {
    let (mut checked, mut sharp, mut worst) = (0, 0, 0.0_f64);
    for (text, _, bound) in formulas(2) {
        let root = bound.acceleration();
        let running = |variable| Running::exact(state(variable));
        let Running { value, bound: allowed } = bound.carry_out(root, Running::exact, running);
        if allowed.is_infinite() {
            continue;
        }
        let plain = bound.eval(root, state).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(plain.to_bits(), value.to_bits(), "{text}");
        let exact = bound.carry_out(root, DoubleDouble::from, |variable| DoubleDouble::from(state(variable)));
        let error = (exact - plain).hi.abs();
        assert!(error <= allowed, "{text}: {plain} is off by {error:e}, allowed are {allowed:e}");
        checked += 1;
        sharp += usize::from(allowed < 1e-12 * plain.abs());
        worst = if error > 0.0 && error / allowed > worst { error / allowed } else { worst };
    }
    println!(
        "{checked} checked, of which {sharp} with a bound below 1e-12; the largest error is {worst:.3} of its bound"
    );
    assert!(checked > COUNT * 3 / 4 && sharp > checked * 3 / 4, "{checked} checked, {sharp} with a small bound");
    assert!(worst > 0.2, "bounds that no error comes near say little: {worst}");
}

/// The state with one direction of change for each variable.
fn direction(variable: Variable) -> f64 {
    match variable {
        Variable::Spacing(j) => 0.5 + 0.125 * f64::from(j),
        Variable::Speed(j) => -0.25 + 0.5 * f64::from(j),
        Variable::Free(_) => f64::NAN,
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    let (mut checked, mut sharp, mut of_doubles) = (0, 0, 0);
    for (text, _, bound) in formulas(3) {
        let root = bound.acceleration();
        // next to a kink a difference is no derivative
        let value = |node| bound.eval(node, state).unwrap_or(f64::NAN);
        let is_near = |kink: &Kink| (value(kink.left) - kink.right.map_or(0.0, value)).abs() < 1e-4;
        if bound.kinks(root).iter().any(is_near) {
            continue;
        }
        let at = |t: f64| {
            let moved = |variable| DoubleDouble::sum(state(variable), direction(variable) * t);
            bound.carry_out(root, DoubleDouble::from, moved)
        };
        let central = |h: f64| (at(h) - at(-h)) / (2.0 * h);
        let dual = |variable| Dual {
            value: DoubleDouble::from(state(variable)),
            slope: DoubleDouble::from(direction(variable)),
        };
        let flat = |value| Dual { value: DoubleDouble::from(value), slope: DoubleDouble::ZERO };
        let exact = bound.carry_out(root, flat, dual).slope;
        // errors h^2, h^4; their difference bounds that of the better one
        let h = 1.0 / (1u64 << 20) as f64;
        let d = [h, h / 2.0, h / 4.0].map(central);
        let better = |coarse: DoubleDouble, fine: DoubleDouble| fine + (fine - coarse) / 3.0;
        let (first, second) = (better(d[0], d[1]), better(d[1], d[2]));
        let size = exact.hi.abs() + at(0.0).hi.abs();
        // below 1e-250 tails of double-doubles underflow
        let allowed = 2.0 * (second - first).hi.abs() + 1e-18 * size + 1e-250;
        let error = (second - exact).hi.abs();
        if !allowed.is_finite() {
            continue;
        }
        assert!(error <= allowed, "{text}: {} by differences {}, off by {error:e}", exact.hi, second.hi);
        checked += 1;
        sharp += usize::from(allowed <= 1e-12 * size);
        // and the derivative in doubles keeps within its own running bound
        let running =
            |variable| Dual { value: Running::exact(state(variable)), slope: Running::exact(direction(variable)) };
        let flat = |value| Dual { value: Running::exact(value), slope: Running::exact(0.0) };
        let Running { value, bound: allowed } = bound.carry_out(root, flat, running).slope;
        if allowed.is_finite() {
            let error = (exact - value).hi.abs();
            assert!(error <= allowed, "{text}: slope {value} is off by {error:e}, allowed are {allowed:e}");
            of_doubles += 1;
        }
    }
    println!("{checked} checked, of which {sharp} to 1e-12; {of_doubles} in doubles");
    assert!(sharp > COUNT * 3 / 4 && of_doubles > COUNT * 3 / 4, "{checked} {sharp} {of_doubles}");
}
