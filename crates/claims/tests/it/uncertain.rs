//! Values with errors: comparisons that stay undecided, and arithmetic that propagates errors.

use claims::requirement::Requirement;
use claims::uncertain::{Outcome, Relation, Uncertain};
use math::number::Number;

#[test]
fn comparisons_are_open_where_the_error_reaches_over() {
    let value = |value: f64, error: f64| Uncertain { value, error };
    for (relation, at, outcome) in [
        (Relation::Above, value(1.0, 0.5), Outcome::True),
        (Relation::Above, value(0.4, 0.5), Outcome::Undecided),
        (Relation::Above, value(-0.4, 0.5), Outcome::Undecided),
        (Relation::Above, value(-1.0, 0.5), Outcome::False),
        (Relation::Above, value(0.0, 0.0), Outcome::False),
        (Relation::AtLeast, value(0.0, 0.0), Outcome::True),
        (Relation::Below, value(-1.0, 0.5), Outcome::True),
        (Relation::AtMost, value(0.5, 0.5), Outcome::Undecided),
        (Relation::Equal, value(0.0, 0.0), Outcome::True),
        (Relation::Equal, value(0.0, 1e-9), Outcome::Undecided),
        (Relation::Equal, value(1.0, 0.5), Outcome::False),
        (Relation::Unequal, value(1.0, 0.5), Outcome::True),
        (Relation::Above, value(f64::NAN, 0.0), Outcome::Undecided),
        (Relation::Above, value(1.0, f64::INFINITY), Outcome::Undecided),
    ] {
        assert_eq!(at.compare(relation, Uncertain::exact(0.0)), outcome, "{at:?} {relation:?} 0");
    }
    let within = Requirement::parse("1 within 0.1").expect("a requirement");
    assert_eq!(within.judge(value(1.05, 0.01)), Outcome::True);
    assert_eq!(within.judge(value(1.05, 0.1)), Outcome::Undecided);
    assert_eq!(within.judge(value(1.5, 0.1)), Outcome::False);
    for text in ["", "> ", "1", "> x", "1 within -1", "~ 1", "> inf"] {
        Requirement::parse(text).expect_err(text);
    }
}

#[test]
fn errors_are_carried_through_arithmetic() {
    let (a, b) = (Uncertain { value: 6.0, error: 0.6 }, Uncertain { value: 2.0, error: 0.5 });
    // every corner of the two intervals lies within the result
    let operations: [fn(Uncertain, Uncertain) -> Uncertain; 8] = [
        |x, y| x + y,
        |x, y| x - y,
        |x, y| x * y,
        |x, y| x / y,
        Number::min,
        Number::max,
        |x, y| y.powi(-3) * x.ln(),
        |x, y| x.powf(-1.5) - y.tanh().exp(),
    ];
    for (place, operation) in operations.into_iter().enumerate() {
        let result = operation(a, b);
        for x in [a.low(), a.high()] {
            for y in [b.low(), b.high()] {
                let corner = operation(Uncertain::exact(x), Uncertain::exact(y)).value;
                assert!((corner - result.value).abs() <= result.error + 1e-12, "{place}: {corner} of {result:?}");
            }
        }
    }
    assert!((a / Uncertain { value: 0.1, error: 0.2 }).error.is_infinite());
    assert!(Uncertain { value: 0.1, error: 0.2 }.ln().error.is_infinite());
}
