//! Steps of Heun's scheme made many at once: the bits of the scheme as printed, at every width, size and cut.

use crate::sample::{Random, laws, paper_laws};
use jam::laws::Model;
use jam::ring::{Ring, Start};
use jam::states::{Cut, Form, FormKind, heun_steps};
use math::simd::Width;
use ode::Burst;

/// A start where nobody has the distance of another one.
fn uneven(form: &dyn Form, count: usize) -> Vec<f64> {
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
    let mut random = Random(15);
    paper_laws().into_iter().chain((0..6).flat_map(|_| laws(&mut random))).collect()
}

#[test]
fn heun_steps_have_the_same_bits_at_every_width_and_size() {
    for (turn, model) in many_laws().into_iter().enumerate() {
        // around whole registers, and around whole rows
        for count in [2, 3, 5, 7, 8, 9, 16, 57, 67, 133, 255, 256, 257, 520 + turn] {
            let ring = Ring { pedestrians: count, length: count as f64 * 4.5 };
            let form = FormKind::Positions.build(&model, ring);
            let start = uneven(&*form, count);
            let (h, steps) = (0.001, 20);
            let mut expected = start.clone();
            step_by_step(&*form, &mut expected, h, steps);
            for width in [Width::Baseline, Width::Four, Width::Eight] {
                let mut state = start.clone();
                let burst = heun_steps(&model, ring, (h, steps), &mut state, None, width);
                assert_eq!((burst, bits(&state)), (Burst::Quiet, bits(&expected)), "{model:?} {count} {width:?}");
            }
        }
    }
}

/// Heun's scheme as printed, from the rates of the form.
fn step_by_step(form: &dyn Form, state: &mut [f64], h: f64, steps: u64) {
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
            let form = FormKind::Positions.build(&model, ring);
            let start = uneven(&*form, pedestrians);
            let mut expected = start.clone();
            let in_one = heun_steps(&model, ring, (h, count), &mut expected, None, Width::Eight);
            assert_eq!(in_one, Burst::Quiet, "{model:?}");
            for (block, steps, threads) in [(64, 16, 1), (100, 7, 1), (999, 3, 1), (37, 1, 3), (300, 20, 2), (5, 16, 1)]
            {
                let cut = Cut { block, steps, threads };
                let mut state = start.clone();
                let burst = heun_steps(&model, ring, (h, count), &mut state, Some(cut), Width::Eight);
                assert_eq!((burst, bits(&state)), (in_one, bits(&expected)), "{model:?} {pedestrians} {cut:?}");
            }
        }
    }
}

#[test]
fn a_cut_burst_with_an_event_leaves_the_state_untouched() {
    let [algebraic, ..] = paper_laws();
    let ring = Ring { pedestrians: 1000, length: 3000.0 };
    let form = FormKind::Positions.build(&algebraic, ring);
    for victim in [0, 1, 499, 500, 998, 999] {
        // it stands so close to the next one that it is thrown back
        let mut start = form.start(Start { shift: 0.0 });
        start[victim] += 0.7;
        for threads in [1, 2] {
            let mut state = start.clone();
            let cut = Cut { block: 100, steps: 16, threads };
            assert_eq!(
                heun_steps(&algebraic, ring, (0.001, 100), &mut state, Some(cut), Width::Eight),
                Burst::Eventful
            );
            assert_eq!(state, start);
        }
    }
}
