//! First crossings and samples.

use crate::problems::{Equations, oscillation, oscillator, solve, watched};
use ode::{Control, Method, Sampler, first_crossing};
use std::f64::consts::FRAC_PI_2;

/// `y = t`: one Euler step of length 1, inside which the state is the fraction itself.
fn clock() -> Equations {
    Equations::scalar(|_, rates| rates[0] = 1.0)
}

fn crossing(parts: u32, value: impl Fn(f64) -> f64) -> Option<f64> {
    let mut found = None;
    watched(&clock(), &[0.0], 1.0, Method::Euler, Control::Fixed { step: 1.0 }, &mut |step| {
        found = first_crossing(step, parts, &mut |state| value(state[0]));
    })
    .expect("nothing stands in the way");
    found
}

#[test]
fn a_crossing_is_found_to_the_last_bit() {
    for i in 1..200 {
        let place = f64::from(i) / 200.0;
        // negative from the next number on
        assert_eq!(crossing(16, |y| place - y), Some(place.next_up()));
        // negative from this very number on
        assert_eq!(crossing(1, |y| if y >= place { -1.0 } else { 1.0 }), Some(place));
    }
}

#[test]
fn the_first_of_several_crossings_counts() {
    let within = |y: f64, from: f64, to: f64| -> f64 { if y > from && y < to { -1.0 } else { 1.0 } };
    let dips = |y: f64| math::smaller(within(y, 0.3, 0.4), within(y, 0.7, 0.8));
    assert_eq!(crossing(16, dips), Some(0.3_f64.next_up()));
    assert_eq!(crossing(16, |_| 1.0), None);
}

#[test]
fn a_dip_within_a_part_is_found() {
    // negative within 1e-3 of its lowest point, in sixteen parts of the step and about all of their ends
    for i in 1..320 {
        let lowest = f64::from(i) / 320.0;
        let found = crossing(16, |y| (y - lowest) * (y - lowest) - 1e-6).expect("it dips");
        assert!((found - (lowest - 1e-3)).abs() < 1e-12, "{found} for {lowest}");
        assert_eq!(crossing(16, |y| (y - lowest) * (y - lowest) + 1e-6), None);
    }
}

#[test]
fn a_dip_is_found_where_only_one_neighbour_is_high() {
    // a third part behind the middle, so that the sample after the lowest is less than twice as high
    for lowest in [0.5 + 0.11, 0.5 - 0.11] {
        let value = |y: f64| (y - lowest) * (y - lowest) - 1e-3;
        let found = crossing(4, value).expect("it dips");
        assert!((found - (lowest - math::exp(0.5 * math::ln(1e-3)))).abs() < 1e-12, "{found} for {lowest}");
    }
}

#[test]
fn a_value_without_a_minimum_is_not_searched() {
    // each look costs an evaluation of the interpolant; a search for a minimum takes 48
    for value in [|y: f64| 1.0 + y, |y: f64| 3.0 - y] {
        let looks = std::cell::Cell::new(0);
        let counted = |y: f64| {
            looks.set(looks.get() + 1);
            value(y)
        };
        assert_eq!(crossing(16, counted), None);
        assert!(looks.get() <= 20, "{} looks", looks.get());
    }
}

#[test]
fn the_quarter_turn_of_the_oscillator() {
    let mut time = None;
    let control = Control::Adaptive { tolerance: 1e-13 };
    watched(&oscillator(), &[1.0, 0.0], 3.0, Method::Dop853, control, &mut |step| {
        if time.is_none() {
            let found = first_crossing(step, 16, &mut |state| state[0]);
            time = found.map(|theta| step.start + theta * step.length());
        }
    })
    .expect("nothing stands in the way");
    let time = time.expect("it crosses");
    println!("quarter turn off by {:e}", time - FRAC_PI_2);
    // the speed there is 1, so the time errs as the state does: a few tolerances
    assert!((time - FRAC_PI_2).abs() < 1e-12, "{time:?}");
}

#[test]
fn samples_stand_at_their_times_and_shorten_no_step() {
    for (method, further) in [(Method::Dop853, 3), (Method::Extrapolation, 64)] {
        let control = Control::Adaptive { tolerance: 1e-12 };
        let plain = solve(&oscillator(), &[1.0, 0.0], 20.0, method, control);
        for interval in [0.01, 1.0, 7.0] {
            let mut sampler = Sampler::new(interval, 2);
            let mut count = 0;
            let sampled = watched(&oscillator(), &[1.0, 0.0], 20.0, method, control, &mut |step| {
                sampler.within(step, 20.0, &mut |t, state| {
                    count += 1;
                    assert_eq!(t, f64::from(count) * interval);
                    let truth = oscillation(t);
                    // 20 time units of at most some steps each, the tolerance at each
                    assert!((state[0] - truth[0]).abs() < 1e-11, "t = {t}: {} not {}", state[0], truth[0]);
                });
            })
            .expect("nothing stands in the way");
            assert_eq!(count, (20.0 / interval).round() as i32 - i32::from(interval == 7.0));
            assert_eq!((plain.steps, plain.rejected), (sampled.steps, sampled.rejected));
            assert_eq!(plain.state, sampled.state);
            let extra = sampled.evaluations - plain.evaluations;
            let most = if method == Method::Dop853 { plain.steps } else { count as u64 } * further;
            assert!(extra > 0 && extra <= most, "{}: {extra} evaluations for {count} samples", method.name());
        }
    }
}

#[test]
fn samples_end_where_they_are_told() {
    let mut times = Vec::new();
    let mut sampler = Sampler::new(0.25, 1);
    watched(&clock(), &[0.0], 4.0, Method::Euler, Control::Fixed { step: 1.0 }, &mut |step| {
        sampler.within(step, 1.5, &mut |t, state| {
            assert_eq!(t, state[0]);
            times.push(t);
        });
    })
    .expect("nothing stands in the way");
    assert_eq!(times, [0.25, 0.5, 0.75, 1.0, 1.25, 1.5]);
}

#[test]
fn a_sample_that_rounding_puts_behind_the_end_is_taken() {
    // three intervals of 0.1 are 0.30000000000000004
    let mut times = Vec::new();
    let mut sampler = Sampler::new(0.1, 1);
    watched(&clock(), &[0.0], 0.3, Method::Euler, Control::Fixed { step: 0.15 }, &mut |step| {
        sampler.within(step, 0.3, &mut |t, _| times.push(t));
    })
    .expect("nothing stands in the way");
    assert_eq!(times, [0.1, 0.2, 0.1 * 3.0]);
}
