//! The components of each form of the state.

use crate::sample::{Random, variants};
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables};

/// Components that `fill` wrote to.
fn written(form: &dyn RingSystem, fill: impl Fn(&[f64], &mut [f64])) -> Vec<bool> {
    let state = form.start(Start { shift: 0.1 });
    let mut rates = vec![f64::NAN; form.dimension()];
    fill(&state, &mut rates);
    rates.iter().map(|rate| !rate.is_nan()).collect()
}

#[test]
fn positions_are_what_kinematics_moves_and_groups_hold_every_component() {
    for model in variants(&mut Random(32)) {
        for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
            let form = kind.build(&model, Ring { pedestrians: 7, length: 7.0 * 4.5 });
            let moved = written(&*form, |state, rates| form.kinematics(state, rates));
            let driven = written(&*form, |state, rates| form.dynamics(state, rates));
            let mut positions = vec![false; form.dimension()];
            form.positions().into_iter().flatten().for_each(|i| positions[i] = true);
            assert_eq!(moved, positions, "{kind:?}");
            let others: Vec<bool> = positions.iter().map(|is_position| !is_position).collect();
            assert_eq!(driven, others, "{kind:?}");
            let mut groups: Vec<usize> = form.groups().into_iter().flat_map(|group| group.range).collect();
            groups.sort_unstable();
            assert_eq!(groups, (0..form.dimension()).collect::<Vec<_>>(), "{kind:?}");
        }
    }
}
