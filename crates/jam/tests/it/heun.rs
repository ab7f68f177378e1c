//! Batches of Heun steps have the bits of the scheme as printed, for every vector width, ring size and division into
//! blocks.

use crate::sample::{Random, paper_laws, variants};
use jam::laws::{Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{Cut, RingSystem, StateVariables, heun_steps};
use math::simd::Width;
use ode::Batch;

/// A start where nobody has the distance of another one.
fn uneven(form: &dyn RingSystem, count: usize) -> Vec<f64> {
    let mut random = Random(14);
    let mut state = form.start(Start { shift: 0.05 });
    state[..count].iter_mut().for_each(|x| *x += random.uniform(0.0, 0.1));
    state[count..].iter_mut().for_each(|v| *v += random.uniform(0.5, 0.6));
    state
}

fn bits(state: &[f64]) -> Vec<u64> {
    state.iter().map(|x| x.to_bits()).collect()
}

/// Paper's laws and random ones of every combination of terms.
fn many_laws() -> Vec<Model> {
    paper_laws().into_iter().chain(variants(&mut Random(15))).collect()
}

#[test]
fn heun_steps_have_the_same_bits_at_every_width_and_size() {
    for (turn, model) in many_laws().into_iter().enumerate() {
        // around whole registers, and around whole rows
        for count in [2, 3, 5, 7, 8, 9, 16, 57, 67, 133, 255, 256, 257, 520 + turn] {
            let ring = Ring { pedestrians: count, length: count as f64 * 4.5 };
            let form = StateVariables::Positions.build(&model, ring);
            let start = uneven(&*form, count);
            let (h, steps) = (0.001, 20);
            let mut expected = start.clone();
            step_by_step(&*form, &mut expected, h, steps);
            for width in [Width::Baseline, Width::Four, Width::Eight] {
                let mut state = start.clone();
                let batch = heun_steps(&model, ring, (h, steps), &mut state, None, width);
                assert_eq!((batch, bits(&state)), (Batch::Done, bits(&expected)), "{model:?} {count} {width:?}");
            }
        }
    }
}

/// Heun's scheme as printed, from the rates of the form.
fn step_by_step(form: &dyn RingSystem, state: &mut [f64], h: f64, steps: u64) {
    let n = state.len();
    let (mut first, mut second, mut guess) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for _ in 0..steps {
        form.rates(state, &mut first);
        (0..n).for_each(|i| guess[i] = state[i] + h * first[i]);
        form.rates(&guess, &mut second);
        (0..n).for_each(|i| state[i] += h * (0.5 * first[i] + 0.5 * second[i]));
    }
}

#[test]
fn heun_steps_have_the_same_bits_however_the_ring_is_cut() {
    let (h, count) = (0.001, 50);
    for model in many_laws() {
        for pedestrians in [1000, 1003] {
            let ring = Ring { pedestrians, length: pedestrians as f64 * 4.5 };
            let form = StateVariables::Positions.build(&model, ring);
            let start = uneven(&*form, pedestrians);
            let mut expected = start.clone();
            let in_one = heun_steps(&model, ring, (h, count), &mut expected, None, Width::Eight);
            assert_eq!(in_one, Batch::Done, "{model:?}");
            for (block, steps, threads) in [(64, 16, 1), (100, 7, 1), (999, 3, 1), (37, 1, 3), (300, 20, 2), (5, 16, 1)]
            {
                let cut = Cut { block, steps, threads };
                let mut state = start.clone();
                let batch = heun_steps(&model, ring, (h, count), &mut state, Some(cut), Width::Eight);
                assert_eq!((batch, bits(&state)), (in_one, bits(&expected)), "{model:?} {pedestrians} {cut:?}");
            }
        }
    }
}

#[test]
fn a_cut_burst_with_an_event_leaves_the_state_untouched() {
    let [algebraic, ..] = paper_laws();
    let ring = Ring { pedestrians: 1000, length: 3000.0 };
    let form = StateVariables::Positions.build(&algebraic, ring);
    for victim in [0, 1, 499, 500, 998, 999] {
        // it stands so close to the next one that it is thrown back
        let mut start = form.start(Start { shift: 0.0 });
        start[victim] += 0.7;
        for threads in [1, 2] {
            let mut state = start.clone();
            let cut = Cut { block: 100, steps: 16, threads };
            assert_eq!(
                heun_steps(&algebraic, ring, (0.001, 100), &mut state, Some(cut), Width::Eight),
                Batch::NeedsInspection
            );
            assert_eq!(state, start);
        }
    }
}

#[test]
fn whoever_passes_the_one_ahead_ends_a_burst_under_laws_without_a_wall() {
    let ring = Ring { pedestrians: 20, length: 20.0 * 4.5 };
    for model in many_laws().into_iter().filter(|model| !model.is_singular()) {
        let form = StateVariables::Positions.build(&model, ring);
        for victim in [0, 7, 19] {
            // through the one ahead within 45 of the steps: no force of these laws stops a speed of 100
            let mut start = form.start(Start { shift: 0.0 });
            start[20..].fill(1.0);
            start[20 + victim] = 100.0;
            let mut state = start.clone();
            let batch = heun_steps(&model, ring, (0.001, 100), &mut state, None, Width::Eight);
            assert_eq!((batch, state), (Batch::NeedsInspection, start), "{model:?} {victim}");
        }
    }
}

#[test]
fn rings_are_cut_where_they_are_large() {
    assert_eq!([Cut::of(2), Cut::of(4096)], [None, None]);
    let one = Some(Cut { block: 1024, steps: 16, threads: 1 });
    assert_eq!([Cut::of(4097), Cut::of(131_071)], [one, one]);
    let available = std::thread::available_parallelism().map_or(1, |threads| threads.get());
    let threads = |n| Cut::of(n).expect("it is large").threads;
    // each with 65,536 at least
    assert_eq!(threads(131_072), available.min(2));
    assert_eq!(threads(10_000_000), available.min(152));
}

/// A state of positions with these gaps and speeds.
fn positions(gaps: &[f64], speeds: &[f64]) -> Vec<f64> {
    let places = gaps.iter().scan(0.0, |place, gap| Some(std::mem::replace(place, *place + gap)));
    places.chain(speeds.iter().copied()).collect()
}

/// What a batch of so many steps of 0.001 says of a ring with one pedestrian who is different, in one piece.
fn burst_with(model: &Model, size: usize, victim: usize, (gap, speed): (f64, f64), ahead: f64, steps: u64) -> Batch {
    let (mut gaps, mut speeds) = (vec![4.5; size], vec![1.0; size]);
    (gaps[victim], speeds[victim]) = (gap, speed);
    speeds[(victim + 1) % size] = ahead;
    let ring = Ring { pedestrians: size, length: gaps.iter().sum() };
    let mut state = positions(&gaps, &speeds);
    let before = state.clone();
    let batch = heun_steps(model, ring, (0.001, steps), &mut state, None, Width::Eight);
    assert_eq!(batch == Batch::NeedsInspection, state == before, "a batch is whole or leaves the state as it was");
    batch
}

/// No force but the drive, of this law's contact.
fn drive() -> [Model; 2] {
    let (strength, range, contact, widening, epsilon, desired_speed) = (0.0, 1.0, 0.0, 0.0, 0.1, 1.0);
    let exponential = Exponential { a: strength, b: range, c: contact, a_v: widening, epsilon, v0: desired_speed };
    [
        Model::Exponential(exponential),
        Model::Logarithmic(Logarithmic { v0: desired_speed, a_v: widening, epsilon: 0.01 }),
    ]
}

#[test]
fn what_is_no_more_after_the_last_step_is_seen_as_well() {
    for model in drive() {
        let contact = model.contact();
        for size in [3, 20, 600] {
            for victim in [0, 1, size - 2, size - 1] {
                let said = |own, ahead, steps| burst_with(&model, size, victim, own, ahead, steps);
                // 0.05 of room, and 0.1 walked in the one step
                assert_eq!(
                    said((contact + 0.05, 100.0), 1.0, 1),
                    Batch::NeedsInspection,
                    "{model:?} {victim} of {size}"
                );
                assert_eq!(said((contact + 0.15, 100.0), 1.0, 1), Batch::Done, "{model:?} {victim} of {size}");
            }
        }
    }
    // the speed ahead takes room away as well: 5.005 - 0.1 (20 + 10) - 2, less 0.01 after one step
    let wide = Model::Exponential(Exponential { a: 0.0, b: 1.0, c: 0.0, a_v: 0.1, epsilon: 0.1, v0: 1.0 });
    for victim in [0, 1, 18, 19] {
        let said = |gap| burst_with(&wide, 20, victim, (gap, 20.0), 10.0, 1);
        assert_eq!([said(5.005), said(5.02)], [Batch::NeedsInspection, Batch::Done], "{victim}");
    }
    // slower than nothing after one step: a force of some 7 on who nearly stands
    let strong = Model::Exponential(Exponential { a: 10.0, b: 1.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 1.0 });
    for victim in [0, 1, 18, 19] {
        let said = |speed| burst_with(&strong, 20, victim, (2.5, speed), 1.0, 1);
        assert_eq!(said(0.001), Batch::NeedsInspection, "{victim}");
        assert_eq!(said(0.1), Batch::Done, "{victim}");
    }
}

#[test]
fn what_is_no_more_for_a_moment_within_is_seen_as_well() {
    for model in drive() {
        let contact = model.contact();
        // around whole registers and whole rows
        for size in [3, 20, 256, 600] {
            for victim in [0, 1, size / 2, size - 1] {
                let said = |own, ahead| burst_with(&model, size, victim, own, ahead, 100);
                // too close at the start, but the one ahead leaves; walking backwards, but speeding up; both
                let cases = [((contact - 0.01, 1.0), 2.0), ((4.0, -0.01), 2.0), ((contact - 0.01, -0.01), 2.0)];
                for (own, ahead) in cases {
                    assert_eq!(said(own, ahead), Batch::NeedsInspection, "{model:?} {victim} of {size}: {own:?}");
                }
                assert_eq!(said((contact + 0.01, 0.5), 2.0), Batch::Done, "{model:?} {victim} of {size}");
                // too close and backwards before the first step, neither after it
                let both = (contact - 0.0005, -0.0005);
                assert_eq!(
                    burst_with(&model, size, victim, both, 2.0, 1),
                    Batch::NeedsInspection,
                    "{model:?} {victim} of {size}"
                );
            }
        }
    }
}
