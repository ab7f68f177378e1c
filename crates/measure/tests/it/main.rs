//! Ratios of paired measurements, and the criterion for a slowdown.

use measure::benchmarks::Measured;
use measure::pairs::{FEWEST, median, ratio};

#[test]
fn medians_lie_in_the_middle() {
    assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
    assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
    assert!(median(&[]).is_nan());
}

/// Pairs with these ratios.
fn pairs(ratios: &[f64]) -> Vec<(f64, f64)> {
    ratios.iter().map(|ratio| (2.0, 2.0 * ratio)).collect()
}

#[test]
fn intervals_leave_out_what_the_table_of_the_sign_test_says() {
    // ranks of the 95 % interval for a median: n = 6: 1, 9: 2, 12: 3, 15: 4, 20: 6
    for (count, rank) in [(6, 1), (8, 1), (9, 2), (11, 2), (12, 3), (15, 4), (20, 6)] {
        let ratios: Vec<f64> = (1..=count).map(f64::from).collect();
        let found = ratio(&pairs(&ratios)).expect("pairs enough");
        assert_eq!((found.low, found.high), (f64::from(rank), f64::from(count + 1 - rank)), "{count} pairs");
    }
    assert_eq!(ratio(&pairs(&[1.0; FEWEST - 1])), None);
}

/// A benchmark whose samples have these ratios to those of the other tree.
fn measured(ratios: &[f64], instructions: Option<(f64, f64)>) -> Measured {
    let (against_seconds, seconds) = pairs(ratios).into_iter().unzip();
    let (against_instructions, instructions) = instructions.unzip();
    Measured { count: 1, seconds, against_seconds, instructions, against_instructions, ..Measured::default() }
}

#[test]
fn slower_is_what_is_slower_for_certain() {
    let noisy = [0.9, 0.95, 1.0, 1.04, 1.08, 1.1, 1.2, 1.4, 1.5];
    assert!(!measured(&noisy, None).is_slower(0.05), "the interval holds 1.05");
    assert!(measured(&noisy.map(|ratio| ratio * 1.2), None).is_slower(0.05), "all of it is above 1.05");
    assert!(measured(&noisy, Some((100.0, 106.0))).is_slower(0.05), "instructions are exact");
    assert!(!measured(&noisy, Some((100.0, 104.0))).is_slower(0.05));
    assert!(!measured(&[], None).is_slower(0.05), "one tree alone is not slower than anything");
}
