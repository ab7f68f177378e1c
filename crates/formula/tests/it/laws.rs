//! Laws: neighbours, sums, names, sharing, folding, kinks.

use crate::common::{bound, graph, state};
use formula::{Binary, Bound, Operation, Stencil, Unary, Variable};
use math::lane;

#[track_caller]
fn value(bound: &Bound) -> f64 {
    bound.eval(bound.acceleration(), state).unwrap_or_else(|error| panic!("{error}"))
}

fn s(j: i32) -> f64 {
    state(Variable::Spacing(j))
}

fn v(j: i32) -> f64 {
    state(Variable::Speed(j))
}

#[test]
fn neighbours_and_sums_mean_what_they_say() {
    let f = |x: f64| 1.0 / (x - 0.7);
    let table = [
        ("s + v", s(0) + v(0)),
        ("s[0] - v[0]", s(0) - v(0)),
        ("s[-1]*v[2]", s(-1) * v(2)),
        ("x[0]", 0.0),
        ("x[1]", s(0)),
        ("x[3]", (s(0) + s(1)) + s(2)),
        ("x[-1]", -s(-1)),
        ("x[-3]", -((s(-1) + s(-2)) + s(-3))),
        ("x[2] - x[1]", (s(0) + s(1)) - s(0)),
        ("sum(j, 1, 3, j*v[j])", (v(1) + 2.0 * v(2)) + 3.0 * v(3)),
        ("sum(j, -1, 1, s[j])", (s(-1) + s(0)) + s(1)),
        ("sum(j, 2, 2, s[j - 1])", s(1)),
        ("sum(j, 1, 2, s[2*j + 1] - v[-j])", (s(3) - v(-1)) + (s(5) - v(-2))),
        ("sum(j, 1, 2, s[-2*j - 1])", s(-3) + s(-5)),
        ("sum(j, 1, 3, 1/(x[j] - 0.7))", (f(s(0)) + f(s(0) + s(1))) + f(s(0) + s(1) + s(2))),
        ("2*sum(j, 1, 2, v[j]) + sum(j, 1, 2, s[j])", 2.0 * (v(1) + v(2)) + (s(1) + s(2))),
        ("sum(j, 1, 3, 2)", 6.0),
    ];
    for (text, expected) in table {
        assert_eq!(value(&bound(text, &[])), expected, "{text}");
    }
}

#[test]
fn names_may_stand_in_any_order_and_are_computed_once() {
    let texts = [("acceleration", "A*A + gap"), ("A", "B + exp(B)"), ("gap", "B - 2"), ("B", "exp(s - v)")];
    let graph = graph(&texts, &[]).expect("a law");
    let bound = graph.bind(&graph.values()).expect("finite values");
    let exps = bound.nodes().iter().filter(|node| matches!(node, Operation::Unary(Unary::Exp, _))).count();
    assert_eq!(exps, 2);
    let b = lane::exp(s(0) - v(0));
    let a = b + lane::exp(b);
    assert_eq!(value(&bound), a * a + (b - 2.0));
    let gap = bound.gap().expect("a gap");
    assert_eq!(bound.eval(gap, state).expect("a value"), b - 2.0);
    assert!(bound.nodes().iter().enumerate().all(|(id, node)| node.operands().all(|operand| operand < id)));
    // equal operations are shared without names, too
    assert_eq!(self::bound("tanh(s - 2)*v + tanh(s - 2)", &[]).nodes().len(), 7);
}

#[test]
fn parameters_are_listed_and_bound() {
    let graph = graph(&[("acceleration", "kappa*(v0 - v)")], &[("v0", 3.0), ("kappa", 0.5)]).expect("a law");
    let names: Vec<&str> = graph.parameters().iter().map(|parameter| parameter.name.as_str()).collect();
    assert_eq!(names, ["v0", "kappa", "body"]);
    assert_eq!((graph.parameter("kappa"), graph.parameter("kapa")), (Some(1), None));
    assert_eq!((graph.parameters()[0].place.line, graph.parameters()[0].place.column), (3, 9));
    assert_eq!(value(&graph.bind(&graph.values()).expect("finite")), 0.5 * (3.0 - v(0)));
    assert_eq!(value(&graph.bind(&[1.0, 2.0, 0.0]).expect("finite")), 2.0 * (1.0 - v(0)));
}

/// The operations that remain, last first, without variables and constants.
fn operations(bound: &Bound) -> Vec<&'static str> {
    let is_leaf = |node: &&Operation| matches!(node, Operation::Constant(_) | Operation::Variable(_));
    bound.nodes().iter().rev().filter(|node| !is_leaf(node)).map(Operation::name).collect()
}

#[test]
fn folding_removes_what_has_no_variable_and_factors_0_and_1() {
    let numbers = [("o", 0.0), ("i", 1.0), ("q", 2.0)];
    let table: [(&str, &[&str]); 29] = [
        ("o*s*ln(v) + v", &[]),
        ("v - o*exp(s)", &[]),
        ("v - s*o/v", &[]),
        ("v - 0*exp(s)*v[1]", &[]),
        ("v + -(o*s)", &[]),
        ("i*s", &[]),
        ("s*i", &[]),
        ("s*1/i", &[]),
        ("s/(2 + o*(v + v[1]))", &["/"]),
        ("(q + o*ramp(v, 0.1))^2/s", &["/"]),
        ("tanh(q)*s", &["*"]),
        ("ln(q*3)/2 + s", &["+"]),
        // as written: not a factor, or neither a literal nor a parameter
        ("s + 0", &["+"]),
        ("s - o", &["-"]),
        ("(i - 1)*s", &["*"]),
        ("o - o*s - s", &["-"]),
        ("s + 1 + 1", &["+", "+"]),
        ("2*s*3", &["*", "*"]),
        ("s/s", &["/"]),
        ("-1*s", &["*"]),
        // powers
        ("s^i", &[]),
        ("s^o + v", &["+"]),
        ("s^q", &["^"]),
        ("s^-q", &["^"]),
        ("s^(q + 1)", &["^"]),
        ("ramp(s, o)", &["max", "-"]),
        ("ramp(s, i)", &["*", "softplus", "*"]),
        ("o*ramp(s, i) + v", &[]),
        ("sqrt(abs(min(i, q)))*s", &["*"]),
    ];
    for (text, expected) in table {
        let used: Vec<(&str, f64)> = numbers.into_iter().filter(|(name, _)| text.contains(name)).collect();
        let all = format!("({text}) + (o + i + q)*0");
        let kept = if used.len() < numbers.len() { all.as_str() } else { text };
        assert_eq!(operations(&bound(kept, &numbers)), expected, "{text}");
    }
    assert_eq!(value(&bound("s^0 + v", &[])), 1.0 + v(0));
    assert!(matches!(bound("s^-2", &[]).nodes()[1], Operation::Power(0, -2)));
    assert!(matches!(bound("s^17", &[]).nodes()[2], Operation::Binary(Binary::Pow, 0, 1)));
    assert!(matches!(bound("s^0.5", &[]).nodes()[2], Operation::Binary(Binary::Pow, 0, 1)));
}

#[test]
fn a_root_can_be_a_constant() {
    let bound = bound("2*3", &[]);
    assert_eq!((bound.nodes(), bound.acceleration()), (&[Operation::Constant(6.0)][..], 0));
    assert_eq!(value(&bound), 6.0);
}

#[test]
fn stencils_follow_the_terms_that_remain() {
    let texts = [("acceleration", "a*v[2] + s[-1] + x[2] + sum(j, 1, 2, v[-j])"), ("gap", "s - v[5]")];
    let graph = graph(&texts, &[("a", 0.0)]).expect("a law");
    assert_eq!(graph.stencil(), Stencil { spacings: vec![-1, 0, 1], speeds: vec![-2, -1, 2, 5] });
    let bound = graph.bind(&graph.values()).expect("finite");
    assert_eq!(bound.stencil(bound.acceleration()), Stencil { spacings: vec![-1, 0, 1], speeds: vec![-2, -1] });
    assert_eq!(bound.stencil(bound.gap().expect("a gap")), Stencil { spacings: vec![0], speeds: vec![5] });
    let with = graph.bind(&[1.0, 0.0]).expect("finite");
    assert_eq!(with.stencil(with.acceleration()).speeds, [-2, -1, 2]);
}

#[test]
fn kinks_are_located() {
    let texts = [("acceleration", "abs(s - 2) + max(v, s) + c*ramp(s, eps)"), ("gap", "min(s, 1)")];
    let graph = graph(&texts, &[("c", 1.0), ("eps", 0.0)]).expect("a law");
    let bound = graph.bind(&graph.values()).expect("finite");
    let kinks = bound.kinks(bound.acceleration());
    let sides: Vec<(&str, bool, u32)> = kinks
        .iter()
        .map(|kink| (bound.nodes()[kink.node].name(), kink.right.is_some(), bound.place(kink.node).column))
        .collect();
    assert_eq!(sides, [("abs", false, 9), ("max", true, 22), ("max", true, 36)]);
    assert_eq!(bound.kinks(bound.gap().expect("a gap")).len(), 1);
    // abs(s - 2): 0 where s is 2; max(v, s): equal where v is s
    let at = |node, spacing: f64| {
        bound.eval(node, |variable| match variable {
            Variable::Spacing(_) => spacing,
            _ => 0.5,
        })
    };
    assert_eq!(at(kinks[0].left, 2.0).expect("a value"), 0.0);
    assert_eq!(at(kinks[1].left, 0.5), at(kinks[1].right.expect("two sides"), 0.5));
    for (values, count) in [([1.0, 0.1, 0.0], 2), ([0.0, 0.0, 0.0], 2)] {
        let bound = graph.bind(&values).expect("finite");
        assert_eq!(bound.kinks(bound.acceleration()).len(), count, "smooth, or gone");
    }
}
