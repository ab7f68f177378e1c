//! Fixed steps that jump over a wall: every step that ends beyond it is reported.

use crate::sample::{Random, laws};
use jam::events::{EventKind, Watch};
use jam::laws::Model;
use jam::ring::Ring;
use jam::states::{RingSystem, StateVariables};
use ode::{Control, Failure, Group, Method, Problem, Step, System, integrate};
use std::cell::Cell;
use std::ops::{ControlFlow, Range};

/// A ring that notices when its force is asked for beyond a wall.
struct Guarded {
    form: Box<dyn RingSystem>,
    is_beyond: Cell<bool>,
}

impl System for Guarded {
    fn dimension(&self) -> usize {
        self.form.dimension()
    }
    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        self.form.kinematics(state, rates);
    }
    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        self.is_beyond.set(self.is_beyond.get() || !self.form.in_domain(state));
        self.form.dynamics(state, rates);
    }
    fn positions(&self) -> Vec<Range<usize>> {
        self.form.positions()
    }
    fn groups(&self) -> Vec<Group> {
        self.form.groups()
    }
    fn in_domain(&self, state: &[f64]) -> bool {
        self.form.in_domain(state)
    }
}

/// What became of the steps of many runs.
#[derive(Debug, Default)]
struct Counts {
    runs: u32,
    overlaps: u32,
    blow_ups: u32,
    not_finite: u32,
    /// Steps with a stage beyond the wall that ended before it.
    beyond: u32,
    /// Those of them that are reported as a whole.
    back: u32,
}

/// Steps until the first stop; panics where a step ends beyond the wall and no overlap is reported in it.
fn run(
    model: Model,
    ring: Ring,
    kind: StateVariables,
    method: Method,
    step: f64,
    random: &mut Random,
    counts: &mut Counts,
) {
    let count = ring.pedestrians;
    let guarded = Guarded { form: kind.build(&model, ring), is_beyond: Cell::new(false) };
    let form = &*guarded.form;
    let mut start = form.start(jam::ring::Start { shift: 0.0 });
    for place in 0..count {
        start[place] += random.uniform(-0.1, 0.1);
        start[count + place] += random.uniform(0.0, model.desired_speed());
    }
    if !form.in_domain(&start) {
        return;
    }
    let mut watch = Watch::new(model.clone(), form, count);
    let (mut gaps, mut speeds) = (vec![0.0; count], vec![0.0; count]);
    let mut observer = |taken: &mut Step<'_>| {
        // before the interpolant, which asks beyond the wall where the step ends there, adds to it
        let was_beyond = guarded.is_beyond.get();
        let new = watch.look(taken);
        form.read(taken.after(), &mut gaps, &mut speeds);
        let rooms = (0..count).map(|n| model.effective_gap(gaps[n], speeds[n], speeds[(n + 1) % count]));
        let narrowest = rooms.fold(f64::INFINITY, math::smaller);
        let overlap = new.iter().find(|event| event.kind == EventKind::Overlap);
        if narrowest < 0.0 {
            let found = overlap.unwrap_or_else(|| panic!("{model:?} {kind:?} {}: {narrowest:e}", method.name()));
            assert!(found.time > taken.start && found.time <= taken.end * (1.0 + f64::EPSILON), "{found:?}");
            assert!(found.pedestrian < count && found.gap.is_finite() && found.step == taken.length(), "{found:?}");
        } else if was_beyond {
            counts.beyond += 1;
            let found =
                overlap.unwrap_or_else(|| panic!("{model:?} {kind:?} {}: a stage beyond the wall", method.name()));
            form.read(taken.before(), &mut gaps, &mut speeds);
            let room = |n: usize| model.effective_gap(gaps[n], speeds[n], speeds[(n + 1) % count]);
            // where no value within the step is negative, the event is at its end, of who had the least room
            if found.time == taken.end {
                counts.back += 1;
                let least = (0..count).map(room).fold(f64::INFINITY, math::smaller);
                assert_eq!((room(found.pedestrian), gaps[found.pedestrian]), (least, found.gap), "{found:?}");
            }
        }
        guarded.is_beyond.set(false);
        counts.overlaps += u32::from(overlap.is_some());
        let blow_up = new.iter().any(|event| event.kind == EventKind::BlowUp);
        counts.blow_ups += u32::from(blow_up);
        if blow_up || overlap.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let control = Control::Fixed { step };
    let problem = Problem { system: &guarded, start: &start, begin: 0.0, end: 8.0, method, control };
    counts.runs += 1;
    match integrate(&problem, &mut observer) {
        Err(Failure::NotFinite { .. }) => counts.not_finite += 1,
        other => assert!(other.is_ok(), "{other:?}"),
    }
}

#[test]
fn no_step_that_ends_beyond_a_wall_goes_unreported() {
    let (mut beyond, mut back) = (0, 0);
    for method in Method::ALL.into_iter().filter(|method| !method.needs_series()) {
        let mut random = Random(21);
        let mut counts = Counts::default();
        for _ in 0..60 {
            for model in laws(&mut random) {
                let headway = model.contact() + random.uniform(0.5, 1.5) + 4.0 * model.gap_per_speed();
                let ring = Ring { pedestrians: 5, length: 5.0 * headway };
                for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
                    run(model.clone(), ring, kind, method, random.magnitude(-1.5, -0.3), &mut random, &mut counts);
                }
            }
        }
        println!("{}: {counts:?}", method.name());
        assert!(counts.overlaps > 50 && counts.overlaps < counts.runs, "{}: {counts:?}", method.name());
        beyond += counts.beyond;
        back += counts.back;
    }
    // without such steps the test would say nothing of them
    assert!(beyond > 10 && back > 5, "{beyond}, {back}");
}
