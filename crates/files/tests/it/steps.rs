//! Prints of steps: every bit counts, a part that differs alone is named, and how often several are taken for one.

use files::steps::{Change, Print, first_change, parse, to_csv};

/// Numbers without a pattern, the same on every machine.
fn numbers(seed: u64, count: usize) -> Vec<f64> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..count).map(|_| next()).collect()
}

fn flipped(state: &[f64], component: usize, bit: u32) -> Vec<f64> {
    let mut state = state.to_vec();
    state[component] = f64::from_bits(state[component].to_bits() ^ (1 << bit));
    state
}

const PEDESTRIANS: usize = 133;

fn change(one: &[f64], other: &[f64]) -> Option<Change> {
    let prints = [one, other].map(|state| [Print::new(0.1, state, PEDESTRIANS)]);
    first_change(&prints[0], &prints[1], PEDESTRIANS).map(|(_, change)| change)
}

#[test]
fn any_bit_of_any_component_names_its_pedestrian() {
    let state = numbers(1, 2 * PEDESTRIANS + 3);
    assert_eq!(change(&state, &state), None);
    let mut unseen = 0;
    for component in 0..state.len() {
        for bit in 0..64 {
            let expected = match component {
                n if n < 2 * PEDESTRIANS => Change::Pedestrian(n % PEDESTRIANS),
                _ => Change::Shared,
            };
            match change(&state, &flipped(&state, component, bit)) {
                None => unseen += 1,
                found => assert_eq!(found, Some(expected), "component {component}, bit {bit}"),
            }
        }
    }
    // 17,216 cases of 1/262139 each
    assert!(unseen <= 2, "{unseen}");
}

#[test]
fn zero_and_minus_zero_are_not_the_same() {
    let zeros = vec![0.0; 2 * PEDESTRIANS];
    let mut other = zeros.clone();
    other[7] = -0.0;
    assert_eq!(change(&zeros, &other), Some(Change::Pedestrian(7)));
}

#[test]
fn pedestrians_who_change_places_are_several() {
    let state = numbers(2, 2 * PEDESTRIANS + 1);
    let mut other = state.clone();
    other.swap(3, 4);
    other.swap(PEDESTRIANS + 3, PEDESTRIANS + 4);
    assert_eq!(change(&state, &other), Some(Change::Several));
}

#[test]
fn several_are_taken_for_one_as_often_as_is_said() {
    let (tries, mut wrong) = (40_000, 0);
    for seed in 0..tries {
        let state = numbers(seed, 2 * PEDESTRIANS + 3);
        let other = flipped(&flipped(&state, seed as usize % 266, 0), (seed as usize + 1) % 266, 0);
        wrong += u32::from(change(&state, &other) != Some(Change::Several));
    }
    // 134/262139 of them, 20.4, give or take 4.5
    assert!((5..=40).contains(&wrong), "{wrong}");
}

#[test]
fn the_first_of_the_steps_that_differ_is_named() {
    let steps: Vec<Vec<f64>> = (0..100).map(|step| numbers(step, 2 * PEDESTRIANS + 3)).collect();
    let prints = |steps: &[Vec<f64>], length: f64| -> Vec<Print> {
        steps.iter().map(|state| Print::new(length, state, PEDESTRIANS)).collect()
    };
    let one = prints(&steps, 0.1);
    for first in [0, 1, 23, 24, 99] {
        let mut other = one.clone();
        other[first] = Print::new(0.1, &flipped(&steps[first], 150, 3), PEDESTRIANS);
        other[99] = Print::new(0.1, &flipped(&steps[99], 150, 3), PEDESTRIANS);
        assert_eq!(first_change(&one, &other, PEDESTRIANS), Some((first, Change::Pedestrian(17))));
    }
    assert_eq!(first_change(&one, &one, PEDESTRIANS), None);
    assert_eq!(first_change(&one, &one[..40], PEDESTRIANS), Some((40, Change::Ended)));
    assert_eq!(first_change(&[], &one, PEDESTRIANS), Some((0, Change::Ended)));
    let longer = [&one[..50], &prints(&steps[50..], 0.1_f64.next_up())].concat();
    assert_eq!(first_change(&one, &longer, PEDESTRIANS), Some((50, Change::Length)));
}

#[test]
fn prints_come_back_as_they_were() {
    for count in [0, 1, 23, 24, 25, 100] {
        let prints: Vec<Print> =
            (0..count).map(|step| Print::new(0.1, &numbers(step, 2 * PEDESTRIANS), PEDESTRIANS)).collect();
        assert!(prints.iter().all(|print| Print::parse(&print.to_string()) == Some(*print)));
        assert_eq!(parse(&to_csv(&prints)), Ok(prints));
    }
}

#[test]
fn lines_of_another_form_are_refused() {
    let print = Print::new(0.1, &[1.0, 2.0], 1).to_string();
    for (text, line) in [
        (String::new(), 1),
        ("step,print\n".to_owned(), 1),
        (format!("step,prints\n0,{print}\n2,{print}\n"), 3),
        (format!("step,prints\n0,{}\n", &print[..7]), 2),
        (format!("step,prints\n0,{}.\n", &print[..7]), 2),
        ("step,prints\n0,00------\n".to_owned(), 2),
        (format!("step,prints\n{print}\n"), 2),
    ] {
        assert_eq!(parse(&text), Err(line), "{text}");
    }
}
