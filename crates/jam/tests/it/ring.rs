//! The ring: all pedestrians are equivalent, the spacings sum to its length, and its three forms agree.

use crate::sample::{HEADWAYS, Random, laws, paper_laws};
use jam::laws::Model;
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables, gaps_state};
use ode::{Batch, Control, Method, Problem, Statistics, Step, integrate};
use std::ops::ControlFlow;

const COUNT: usize = 21;

fn integrated(form: &dyn RingSystem, start: &[f64], end: f64, method: Method, control: Control) -> Statistics {
    let mut observer = |_: &mut Step<'_>| ControlFlow::Continue(());
    integrate(&Problem { system: form, start, begin: 0.0, end, method, control }, &mut observer).expect("it runs")
}

fn read(form: &dyn RingSystem, state: &[f64], count: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count]);
    form.read(state, &mut gaps, &mut speeds);
    (gaps, speeds)
}

#[test]
fn labels_do_not_matter() {
    let mut random = Random(6);
    for model in [laws(&mut random), laws(&mut random), laws(&mut random), laws(&mut random)].concat() {
        let ring = Ring { pedestrians: COUNT, length: COUNT as f64 * 3.5 };
        for kind in [StateVariables::Deviations, StateVariables::Spacings] {
            let form = kind.build(&model, ring);
            let mut start = form.start(Start { shift: 0.0 });
            for value in &mut start[..2 * COUNT] {
                *value += random.uniform(-0.2, 0.2);
            }
            for turn in [1, 2, COUNT - 1] {
                let mut turned = start.clone();
                turned[..COUNT].rotate_left(turn);
                turned[COUNT..2 * COUNT].rotate_left(turn);
                for method in Method::ALL.into_iter().filter(|method| method.suits(&*form)) {
                    let control = Control::Fixed { step: 0.0625 };
                    let mut plain = integrated(&*form, &start, 5.0, method, control).state;
                    let turned = integrated(&*form, &turned, 5.0, method, control).state;
                    plain[..COUNT].rotate_left(turn);
                    plain[COUNT..2 * COUNT].rotate_left(turn);
                    // all but the place of pedestrian 0, who is another one
                    let bits = |state: &[f64]| state[..2 * COUNT].iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                    assert_eq!(bits(&plain), bits(&turned), "{model:?} {kind:?} {} by {turn}", method.name());
                }
            }
        }
    }
}

#[test]
fn gaps_sum_to_the_length() {
    // Every gap is a sum of steps, each rounded to half a unit of the gap or less, and the rates of the gaps sum to 0
    // up to their rounding: after n steps the sum is off by less than n N eps s, s the largest gap
    for (model, headway) in paper_laws().into_iter().zip(HEADWAYS) {
        let ring = Ring { pedestrians: COUNT, length: COUNT as f64 * headway };
        for kind in [StateVariables::Deviations, StateVariables::Spacings] {
            let form = kind.build(&model, ring);
            let start = form.start(Start { shift: 0.1 });
            for (method, control) in [
                (Method::Heun, Control::Fixed { step: 1e-3 }),
                (Method::Dop853, Control::Adaptive { tolerance: 1e-12 }),
                (Method::Extrapolation, Control::Adaptive { tolerance: 1e-12 }),
            ] {
                let end = integrated(&*form, &start, 20.0, method, control);
                let (gaps, _) = read(&*form, &end.state, COUNT);
                let largest = gaps.iter().copied().fold(0.0, math::larger);
                let error = (gaps.iter().sum::<f64>() - ring.length).abs();
                let bound = end.steps as f64 * COUNT as f64 * f64::EPSILON * largest;
                println!("{} {kind:?} {}: off by {error:e}, bound {bound:e}", model.name(), method.name());
                assert!(error < bound, "{} {kind:?} {}: {error:e}, bound {bound:e}", model.name(), method.name());
            }
        }
    }
}

#[test]
fn the_three_forms_start_alike_and_stay_together() {
    for (model, headway) in paper_laws().into_iter().zip(HEADWAYS) {
        let ring = Ring { pedestrians: COUNT, length: COUNT as f64 * headway };
        let shift = 0.05;
        let ends: Vec<_> = [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions]
            .map(|kind| {
                let form = kind.build(&model, ring);
                let start = form.start(Start { shift });
                assert_start(&*form, &start, ring, shift);
                let end = integrated(&*form, &start, 20.0, Method::Dop853, Control::Adaptive { tolerance: 1e-13 });
                let mut positions = vec![0.0; COUNT];
                form.write_positions(&end.state, &mut positions);
                let (gaps, speeds) = read(&*form, &end.state, COUNT);
                assert!((form.speed_std(&end.state) - jam::observe::speed_std(&speeds)).abs() < 1e-13);
                [positions, gaps, speeds].concat()
            })
            .into();
        for other in &ends[1..] {
            let difference = ends[0].iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, math::larger);
            println!("{}: forms differ by {difference:e}", model.name());
            // positions to 150 have errors of 1e-13 of that; over 20 time units an error grows less than tenfold
            assert!(difference < 150.0 * 1e-13 * 10.0, "{}: {difference:e}", model.name());
        }
    }
}

/// Equal distances, all at rest, pedestrian 0 ahead by the shift.
fn assert_start(form: &dyn RingSystem, start: &[f64], ring: Ring, shift: f64) {
    let mut positions = vec![0.0; COUNT];
    form.write_positions(start, &mut positions);
    for (n, position) in positions.iter().enumerate() {
        let place = n as f64 * ring.headway() + if n == 0 { shift } else { 0.0 };
        assert!((position - place).abs() < 1e-13, "{n}: {position} not {place}");
    }
    let (gaps, speeds) = read(form, start, COUNT);
    assert!((gaps[0] - (ring.headway() - shift)).abs() < 1e-13);
    assert!((gaps[COUNT - 1] - (ring.headway() + shift)).abs() < 1e-13);
    assert!(speeds.iter().all(|&speed| speed == 0.0));
}

#[test]
fn rates_of_gaps_and_speeds_are_those_of_the_state() {
    for (model, headway) in paper_laws().into_iter().zip(HEADWAYS) {
        let ring = Ring { pedestrians: COUNT, length: COUNT as f64 * headway };
        for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
            let form = kind.build(&model, ring);
            let mut random = Random(7);
            let mut state = form.start(Start { shift: 0.05 });
            for value in &mut state {
                *value += random.uniform(0.0, 0.1);
            }
            let mut rates = vec![0.0; state.len()];
            form.rates(&state, &mut rates);
            let (gaps, speeds) = read(&*form, &state, COUNT);
            let (mut gap_rates, mut speed_rates) = (vec![0.0; COUNT], vec![0.0; COUNT]);
            form.read_rates(&rates, &mut gap_rates, &mut speed_rates);
            for n in 0..COUNT {
                let ahead = speeds[(n + 1) % COUNT];
                assert!((gap_rates[n] - (ahead - speeds[n])).abs() < 1e-14);
                let acceleration = model.acceleration(gaps[n], speeds[n], ahead);
                // gaps of positions up to 75 are known to 1e-14; the logarithmic law magnifies that at its kink by 1
                assert!((speed_rates[n] - acceleration).abs() < 1e-12, "{} {kind:?}", model.name());
            }
        }
    }
}

#[test]
fn another_form_of_the_same_state() {
    for (model, headway) in paper_laws().into_iter().zip(HEADWAYS) {
        let ring = Ring { pedestrians: COUNT, length: COUNT as f64 * headway };
        let gaps: Vec<f64> = (0..COUNT).map(|n| headway + 0.01 * n as f64).collect();
        let speeds: Vec<f64> = (0..COUNT).map(|n| 0.1 * n as f64).collect();
        let state = gaps_state(&model, &gaps, &speeds, 1.25);
        let form = StateVariables::Spacings.build(&model, ring);
        assert_eq!(state.len(), form.dimension());
        let (same_gaps, same_speeds) = read(&*form, &state, COUNT);
        assert!(gaps.iter().zip(&same_gaps).all(|(a, b)| (a - b).abs() <= 2.0 * f64::EPSILON * a));
        assert_eq!(speeds, same_speeds);
        let mut positions = vec![0.0; COUNT];
        form.write_positions(&state, &mut positions);
        assert_eq!(positions[0], 1.25);
        assert!((positions[2] - (1.25 + gaps[0] + gaps[1])).abs() < 1e-14);
    }
}

#[test]
fn the_domain_ends_where_a_gap_of_a_singular_law_closes() {
    let [algebraic, exponential, logarithmic] = paper_laws();
    for (model, singular) in [(algebraic, true), (exponential, false), (logarithmic, false)] {
        assert_eq!(model.is_singular(), singular);
        let ring = Ring { pedestrians: 4, length: 12.0 };
        for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
            let form = kind.build(&model, ring);
            assert!(form.in_domain(&form.start(Start { shift: 0.99 })));
            for shift in [1.01, -1.01] {
                assert_eq!(form.in_domain(&form.start(Start { shift })), !singular, "{} {kind:?}", model.name());
            }
        }
    }
}

#[test]
fn widening_takes_room_from_both_speeds() {
    let mut random = Random(8);
    for model in laws(&mut random) {
        let a_v = model.gap_per_speed();
        let expected = match model {
            Model::Logarithmic(_) => 3.0,
            _ => (3.0 - 2.0) - a_v * (0.5 + 0.25),
        };
        assert_eq!(model.effective_gap(3.0, 0.5, 0.25), expected);
    }
}

#[test]
fn heun_steps_in_a_burst_are_those_one_by_one() {
    let mut random = Random(13);
    for model in paper_laws().into_iter().chain((0..5).flat_map(|_| laws(&mut random))) {
        let ring = Ring { pedestrians: COUNT, length: COUNT as f64 * 3.5 };
        let form = StateVariables::Positions.build(&model, ring);
        let start = form.start(Start { shift: 0.05 });
        let (h, count) = (0.001, 1000);
        let one_by_one = integrated(&*form, &start, h * count as f64, Method::Heun, Control::Fixed { step: h });
        assert_eq!(one_by_one.steps, count);
        let mut state = start.clone();
        let batch = form.heun(&mut state, h, count);
        // a strong law among the random ones may push backwards, which is for the steps one by one to see
        assert!(batch == Batch::Done || !paper_laws().contains(&model), "{model:?}: {batch:?}");
        let bits = |state: &[f64]| state.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let expected = if batch == Batch::Done { &one_by_one.state } else { &start };
        assert_eq!(bits(&state), bits(expected), "{model:?}: {batch:?}");
        // the other forms have no such way
        for kind in [StateVariables::Deviations, StateVariables::Spacings] {
            let form = kind.build(&model, ring);
            let mut state = form.start(Start { shift: 0.05 });
            assert_eq!(form.heun(&mut state, h, count), Batch::Unsupported);
        }
    }
}

#[test]
fn a_burst_with_an_event_leaves_the_state_untouched() {
    let [algebraic, ..] = paper_laws();
    let form = StateVariables::Positions.build(&algebraic, Ring { pedestrians: 4, length: 12.0 });
    // pedestrian 0 stands so close to 1 that it is thrown back
    let start = form.start(Start { shift: 0.7 });
    let mut state = start.clone();
    assert_eq!(form.heun(&mut state, 0.001, 100), Batch::NeedsInspection);
    assert_eq!(state, start);
}
