//! The method attains its order, and its steps do not depend on the output times.

use math::double_double::DoubleDouble;
use reference::extrapolation::Extrapolation;
use reference::run::{Precision, Run};
use reference::scenes::{Parameters, Scene, scene};

fn exponential() -> Scene {
    scene("exponential_unstable", Parameters::Doubles).expect("a scene")
}

#[test]
fn one_step_has_an_error_of_order_2k_plus_1() {
    let ring = exponential().ring;
    let start = ring.start(200.0, DoubleDouble::from(0.5));
    let mut rates = start.clone();
    ring.rates(&start, &mut rates);
    let mut best = Extrapolation::new(14, ring.dimension());
    for rows in [2, 3, 4, 5] {
        let mut method = Extrapolation::new(rows, ring.dimension());
        let mut error = |h: f64| {
            method.step(&ring, &start, &rates, DoubleDouble::from(h));
            best.step(&ring, &start, &rates, DoubleDouble::from(h));
            let pairs = method.result.iter().zip(&best.result);
            pairs.fold(0.0_f64, |largest, (a, b)| math::larger(largest, (*a - *b).hi.abs()))
        };
        let (long, short) = (error(1.0 / 16.0), error(1.0 / 32.0));
        let slope = math::ln(long / short) / math::ln(2.0);
        let order = (2 * rows + 1) as f64;
        // the next term of the error is smaller by the step over a time of order 1
        assert!((slope - order).abs() < 0.2, "{rows} rows: slope {slope}, expected {order}");
    }
}

#[test]
fn a_tighter_tolerance_and_other_rows_give_the_same_solution() {
    let mut first = Run::new(&exponential(), Precision { tolerance: 1e-26, rows: 12 });
    let mut second = Run::new(&exponential(), Precision { tolerance: 1e-22, rows: 8 });
    first.advance_to(20.0).expect("no wall");
    for time in 1..=8 {
        second.advance_to(2.5 * f64::from(time)).expect("no wall");
    }
    assert_eq!(first.time, second.time);
    let largest = first.state.iter().zip(&second.state).fold(0.0_f64, |l, (a, b)| math::larger(l, (*a - *b).hi.abs()));
    // a few dozen steps, each with an error below the looser tolerance, which does not grow tenfold before t = 20
    assert!(largest < 1e-20, "{largest:e}");
    assert!(largest > 0.0, "the runs share too much");
}
