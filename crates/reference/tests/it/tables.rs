//! Only digits confirmed by two runs are written; the standard deviation is the population's.

use math::double_double::DoubleDouble;
use reference::laws::Law;
use reference::ring::Ring;
use reference::table::{confirmed, spread};

#[test]
fn the_last_digit_is_worth_more_than_the_difference() {
    let third = DoubleDouble::ONE / 3.0;
    assert_eq!(confirmed(third, third), "3.3333333333333333333e-1");
    assert_eq!(confirmed(third, third + 1e-24), "3.3333333333333333333e-1");
    assert_eq!(confirmed(third, third + 1e-10), "3.333333333e-1");
    assert_eq!(confirmed(third, third + 1.0), "3e-1");
    assert_eq!(confirmed(DoubleDouble::ZERO, DoubleDouble::ZERO), "0");
}

#[test]
fn the_standard_deviation_divides_by_the_number_of_pedestrians() {
    let law = Law::Logarithmic { desired_speed: DoubleDouble::ONE, epsilon: DoubleDouble::ONE };
    let ring = Ring { law, pedestrians: 4 };
    let speeds = [1.0, 2.0, 3.0, 6.0];
    let state: Vec<DoubleDouble> = [0.0; 4].into_iter().chain(speeds).chain([0.0]).map(DoubleDouble::from).collect();
    // mean 3, squares 4 + 1 + 0 + 9 over 4
    let error = spread(&ring, &state) - DoubleDouble::from(3.5).sqrt();
    assert!(error.hi.abs() < 1e-30, "{error:?}");
}
