//! Events of constructed trajectories: their times, pedestrians and order.

use jam::events::{BLOW_UP, Event, EventKind, Watch};
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables, gaps_state};
use ode::{Control, Group, Measure, Method, Problem, Step, System, integrate};
use std::cell::Cell;
use std::f64::consts::PI;
use std::ops::{ControlFlow, Range};

/// Three pedestrians whose gaps and speeds are `constant + amplitude cos t`; the state is `(cos t, -sin t)`.
struct Swing {
    gaps: [(f64, f64); 3],
    speeds: [(f64, f64); 3],
    /// How often gaps and speeds were asked for.
    reads: Cell<usize>,
}

impl Swing {
    fn new(gaps: [(f64, f64); 3], speeds: [(f64, f64); 3]) -> Swing {
        Swing { gaps, speeds, reads: Cell::new(0) }
    }
}

impl System for Swing {
    fn dimension(&self) -> usize {
        2
    }
    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        rates[0] = state[1];
    }
    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        rates[1] = -state[0];
    }
    fn positions(&self) -> Vec<Range<usize>> {
        vec![0..1, 1..1]
    }
    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..2, measure: Measure::Largest, floor: 1.0 }]
    }
}

impl RingSystem for Swing {
    fn start(&self, _start: Start) -> Vec<f64> {
        vec![1.0, 0.0]
    }
    fn start_displaced(&self, _displacements: &[f64]) -> Vec<f64> {
        vec![1.0, 0.0]
    }
    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        self.reads.set(self.reads.get() + 1);
        for n in 0..3 {
            gaps[n] = self.gaps[n].0 + self.gaps[n].1 * state[0];
            speeds[n] = self.speeds[n].0 + self.speeds[n].1 * state[0];
        }
    }
    fn read_rates(&self, rates: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        for n in 0..3 {
            gaps[n] = self.gaps[n].1 * rates[0];
            speeds[n] = self.speeds[n].1 * rates[0];
        }
    }
    fn write_positions(&self, _state: &[f64], positions: &mut [f64]) {
        positions.fill(0.0);
    }
    fn speeds(&self) -> Range<usize> {
        0..1
    }
    fn speed_std(&self, _state: &[f64]) -> f64 {
        0.0
    }
}

fn relaxation(widening: f64) -> Model {
    Model::Exponential(Exponential { a: 0.0, b: 1.0, c: 0.0, a_v: widening, epsilon: 0.1, v0: 1.0 })
}

/// The events of a run, and whether each was reported once.
fn watched(form: &dyn RingSystem, model: Model, start: &[f64], count: usize, end: f64, control: Control) -> Vec<Event> {
    let mut watch = Watch::new(model, form, count);
    let mut reported = Vec::new();
    let problem = Problem { system: form, start, begin: 0.0, end, method: Method::Dop853, control };
    integrate(&problem, &mut |step: &mut Step<'_>| {
        reported.extend(watch.look(step));
        ControlFlow::Continue(())
    })
    .expect("it runs");
    assert_eq!(reported, watch.found());
    reported
}

fn swing_events(swing: &Swing, widening: f64, control: Control) -> Vec<Event> {
    watched(swing, relaxation(widening), &[1.0, 0.0], 3, 6.0, control)
}

const ADAPTIVE: Control = Control::Adaptive { tolerance: 1e-13 };

/// Event, pedestrian, and the cosine at its time, which tells the time on the way down.
fn assert_events(found: &[Event], expected: &[(EventKind, usize, f64)]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (event, (kind, pedestrian, cos)) in found.iter().zip(expected) {
        assert_eq!((event.kind, event.pedestrian), (*kind, *pedestrian), "{found:?}");
        assert!(event.time > 0.0 && event.time < PI, "on the way down: {event:?}");
        assert!((math::cos(event.time) - cos).abs() < 1e-12, "{event:?}: {}", math::cos(event.time));
    }
}

#[test]
fn overlap_negative_speed_and_exchange_in_order() {
    let swing = Swing::new([(5.0, 0.0), (3.0, 4.0), (2.5, 0.5)], [(1.0, 0.0), (0.5, 0.0), (0.25, 0.5)]);
    // gap 2: 3 + 4 cos = 2; speed 2: 1/4 + cos / 2 = 0; gap 1: 3 + 4 cos = 0; gap 2 just touches 2 at cos = -1
    let expected =
        [(EventKind::Overlap, 1, -0.25), (EventKind::NegativeSpeed, 2, -0.5), (EventKind::Exchange, 1, -0.75)];
    assert_events(&swing_events(&swing, 0.0, ADAPTIVE), &expected);
    // the same with steps so long that a pedestrian comes and goes within a few of them
    let coarse = swing_events(&swing, 0.0, Control::Fixed { step: 0.5 });
    let events: Vec<EventKind> = coarse.iter().map(|event| event.kind).collect();
    assert_eq!(events, [EventKind::Overlap, EventKind::NegativeSpeed, EventKind::Exchange]);
}

#[test]
fn widening_makes_the_overlap_earlier() {
    let swing = Swing::new([(5.0, 0.0), (3.0, 4.0), (5.0, 0.0)], [(1.0, 0.0), (0.5, 0.0), (0.25, 0.0)]);
    // room of 1: 3 + 4 cos - 2 - a_v (1/2 + 1/4) = 0 for a_v = 2: cos = 1/8; exchange as before
    let expected = [(EventKind::Overlap, 1, 0.125), (EventKind::Exchange, 1, -0.75)];
    assert_events(&swing_events(&swing, 2.0, ADAPTIVE), &expected);
}

#[test]
fn a_dip_within_a_step_is_seen() {
    // gap 0 is below 2 only for cos < -0.98, 0.4 time units about t = pi, within the step from 2 to 4
    let swing = Swing::new([(2.98, 1.0), (5.0, 0.0), (5.0, 0.0)], [(1.0, 0.0); 3]);
    let found = swing_events(&swing, 0.0, Control::Fixed { step: 2.0 });
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].kind, found[0].pedestrian), (EventKind::Overlap, 0));
    // dense output over steps of 2: an error of the cosine of 2^8 / 40320
    assert!((math::cos(found[0].time) + 0.98).abs() < 1e-2, "{found:?}");
}

#[test]
fn nothing_happens_where_nothing_is_negative() {
    let swing = Swing::new([(3.001, 1.0), (5.0, 0.0), (5.0, 0.0)], [(1.001, 1.0); 3]);
    assert!(swing_events(&swing, 0.0, ADAPTIVE).is_empty());
}

#[test]
fn of_equals_all_are_named() {
    let swing = Swing::new([(5.0, 0.0), (3.0, 4.0), (3.0, 4.0)], [(1.0, 0.0); 3]);
    let both = |event, cos| [(event, 1, cos), (event, 2, cos)];
    let expected = [both(EventKind::Overlap, -0.25), both(EventKind::Exchange, -0.75)].concat();
    assert_events(&swing_events(&swing, 0.0, ADAPTIVE), &expected);
    // one that is later by more than a thousand millionth of the time is not at once with the first
    let later = Swing::new([(5.0, 0.0), (3.0, 4.0), (3.0 + 1e-6, 4.0)], [(1.0, 0.0); 3]);
    assert_eq!(swing_events(&later, 0.0, ADAPTIVE).len(), 2);
    let earlier = Swing::new([(5.0, 0.0), (3.0, 4.0), (3.0 - 1e-6, 4.0)], [(1.0, 0.0); 3]);
    let found = swing_events(&earlier, 0.0, ADAPTIVE);
    assert!(found.len() == 2 && found.iter().all(|event| event.pedestrian == 2), "{found:?}");
}

#[test]
fn widening_counts_from_the_last_pedestrian_to_the_first() {
    // room of 2: 7 + 2 cos - 2 - (2 + 2) = 0 at cos = -1/2; the widening is what is missing, and no gap is small
    let swing = Swing::new([(20.0, 0.0), (20.0, 0.0), (7.0, 2.0)], [(2.0, 0.0), (0.5, 0.0), (2.0, 0.0)]);
    assert_events(&swing_events(&swing, 1.0, ADAPTIVE), &[(EventKind::Overlap, 2, -0.5)]);
    let swing = Swing::new([(20.0, 0.0), (7.0, 2.0), (20.0, 0.0)], [(0.5, 0.0), (2.0, 0.0), (2.0, 0.0)]);
    assert_events(&swing_events(&swing, 1.0, ADAPTIVE), &[(EventKind::Overlap, 1, -0.5)]);
}

/// Readings of gaps and speeds by a watch over so many steps of this length, from this phase of the swing on.
fn readings(swing: &Swing, widening: f64, begin: f64, step: f64, steps: usize) -> usize {
    let before = swing.reads.get();
    let start = [math::cos(begin), -math::sin(begin)];
    watched(swing, relaxation(widening), &start, 3, step * steps as f64, Control::Fixed { step });
    swing.reads.get() - before
}

/// A sixth of a swing.
const SIXTH: f64 = PI / 3.0;

#[test]
fn a_calm_step_is_read_once() {
    // what comes near no event is looked at at the ends of steps only: once before the first step, once after each
    let calm = Swing::new([(12.0, 1.0), (13.0, -1.0), (14.0, 2.0)], [(3.0, 0.5), (2.0, -0.5), (2.5, 0.0)]);
    assert_eq!(readings(&calm, 0.0, 0.0, SIXTH, 6), 7);
    assert_eq!(readings(&calm, 0.5, 0.0, SIXTH, 6), 7);
    // at rest a speed of exactly 0 is no event, and is not looked for
    let standing = Swing::new([(12.0, 0.0); 3], [(0.0, 0.0); 3]);
    assert_eq!(readings(&standing, 0.0, 0.0, SIXTH, 6), 7);
}

#[test]
fn only_steps_that_may_hold_an_event_are_searched() {
    // Gap of 0 is 3.5 + cos t, least room 1/2 at t = pi. The control points of a step from a to b are cos a,
    // cos a - h/3 sin a, cos b + h/3 sin b, cos b, for h = pi / 3: from pi/3 to 2 pi/3 they lie 2.0, 1.698, 1.302, 1.0,
    // spread 1.0 <= least; from 2 pi/3 to pi: 1.0, 0.698, 0.5, 0.5, spread 0.5 <= least; so no step is searched.
    let near = Swing::new([(3.5, 1.0), (20.0, 0.0), (20.0, 0.0)], [(3.0, 0.0); 3]);
    assert_eq!(readings(&near, 0.0, 0.0, SIXTH, 6), 7);
    // Lower by 1/10 the least of the second is 0.4 against the same spread of 0.5, and that of the first is 0.9 against
    // 1.0: both, and the two on the way up, are searched at 17 places and one or two more next to the lower end.
    let nearer = Swing::new([(3.4, 1.0), (20.0, 0.0), (20.0, 0.0)], [(3.0, 0.0); 3]);
    assert_eq!(readings(&nearer, 0.0, 0.0, SIXTH, 6), 7 + 2 * 18 + 2 * 19);
}

#[test]
fn a_hump_within_a_step_widens_what_is_searched() {
    // Room 0.45 - cos t over one step of 2 pi / 3, a fifth earlier or later than even about its top: the control points
    // less 0.45 are 0.318, 0.980, 1.186, 0.663 or the other way round. The spread 0.868 is more than the least, 0.768;
    // without the highest of them it would be 0.662, and nothing would be searched.
    let hump = |least: f64| Swing::new([(2.0 + least, -1.0), (20.0, 0.0), (20.0, 0.0)], [(3.0, 0.0); 3]);
    for begin in [2.0 * SIXTH - 0.2, 2.0 * SIXTH + 0.2] {
        assert!(readings(&hump(0.45), 0.0, begin, 2.0 * SIXTH, 1) > 2 + 16, "{begin}");
        // higher by 1/5 nothing is searched
        assert_eq!(readings(&hump(0.65), 0.0, begin, 2.0 * SIXTH, 1), 2, "{begin}");
    }
}

#[test]
fn blow_up_is_a_speed_beyond_the_bound() {
    // |v_1| = 1e12 (1 - cos t) passes the bound at t = pi / 2, backwards, so its speed is negative from the start on
    let swing = Swing::new([(5.0, 0.0); 3], [(1.0, 0.0), (-BLOW_UP, BLOW_UP), (1.0, 0.0)]);
    let found = swing_events(&swing, 0.0, ADAPTIVE);
    let blow_up = found.iter().find(|event| event.kind == EventKind::BlowUp).expect("it blows up");
    assert_eq!(blow_up.pedestrian, 1);
    assert!((blow_up.time - std::f64::consts::FRAC_PI_2).abs() < 1e-12, "{blow_up:?}");
}

#[test]
fn stops_and_names() {
    let known: Vec<(&str, bool)> = EventKind::ALL.iter().map(|event| (event.name(), event.is_stop())).collect();
    assert_eq!(
        known,
        [("overlap", true), ("negative_speed", false), ("exchange", false), ("undefined", true), ("blow_up", true)]
    );
}

/// `dv/dt = 1 - v`: pedestrian 0 runs into 1, `s_0 = 3 - 4 (1 - exp(-t))`.
fn runner() -> (Model, Ring, Vec<f64>, Vec<f64>) {
    (relaxation(0.0), Ring { pedestrians: 3, length: 9.0 }, vec![3.0; 3], vec![4.5, 0.5, 2.0])
}

#[test]
fn a_faster_pedestrian_passes_at_the_time_of_the_formula() {
    let (model, ring, gaps, speeds) = runner();
    let form = StateVariables::Spacings.build(&model, ring);
    let start = gaps_state(&model, &gaps, &speeds, 0.0);
    let found = watched(&*form, model, &start, 3, 5.0, ADAPTIVE);
    // overlap at s = 2: 1 - exp(-t) = 1/4; exchange at s = 0: 3/4
    let expected = [(EventKind::Overlap, -math::ln(0.75)), (EventKind::Exchange, -math::ln(0.25))];
    assert_eq!(found.len(), 2, "{found:?}");
    for (event, (kind, time)) in found.iter().zip(expected) {
        assert_eq!((event.kind, event.pedestrian), (kind, 0));
        // the gap closes with a speed of at least 1 there, so the time errs as the gap does
        assert!((event.time - time).abs() < 1e-12, "{event:?} not {time}");
    }
}

#[test]
fn a_watch_goes_on_in_another_form() {
    let (model, ring, gaps, speeds) = runner();
    let (first, second) = (StateVariables::Spacings.build(&model, ring), StateVariables::Positions.build(&model, ring));
    let mut watch = Watch::new(model.clone(), &*first, 3);
    let start = gaps_state(&model, &gaps, &speeds, 0.0);
    let problem =
        Problem { system: &*first, start: &start, begin: 0.0, end: 0.5, method: Method::Dop853, control: ADAPTIVE };
    let look = |step: &mut Step<'_>, watch: &mut Watch<'_>| watch.look(step).len();
    let mut seen = 0;
    let half = integrate(&problem, &mut |step: &mut Step<'_>| {
        seen += look(step, &mut watch);
        ControlFlow::Continue(())
    })
    .expect("it runs")
    .state;
    assert_eq!(seen, 1);
    let (mut positions, mut gaps, mut speeds) = (vec![0.0; 3], vec![0.0; 3], vec![0.0; 3]);
    first.write_positions(&half, &mut positions);
    first.read(&half, &mut gaps, &mut speeds);
    watch.change_form(&*second);
    let start = [positions, speeds].concat();
    let problem = Problem { system: &*second, start: &start, begin: 0.5, end: 5.0, ..problem };
    integrate(&problem, &mut |step: &mut Step<'_>| {
        seen += look(step, &mut watch);
        ControlFlow::Continue(())
    })
    .expect("it runs");
    assert_eq!(seen, 2);
    assert!((watch.found()[1].time + math::ln(0.25)).abs() < 1e-12, "{:?}", watch.found());
}

#[test]
fn for_the_logarithmic_law_an_overlap_is_an_exchange() {
    let model = Model::Logarithmic(jam::laws::Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 });
    assert_eq!((model.contact(), model.effective_gap(0.5, 1.0, 1.0)), (0.0, 0.5));
    let swing = Swing::new([(0.5, 1.0), (5.0, 0.0), (5.0, 0.0)], [(1.0, 0.0); 3]);
    let found = watched(&swing, model, &[1.0, 0.0], 3, 6.0, ADAPTIVE);
    assert_events(&found, &[(EventKind::Overlap, 0, -0.5), (EventKind::Exchange, 0, -0.5)]);
    assert_eq!(found[0].time, found[1].time);
}

/// What both ways to look at the steps of a run find, and how many steps one of them passed over.
fn looked_at(model: &Model, ring: Ring, shift: f64, end: f64) -> ([Vec<Event>; 2], usize) {
    let form = StateVariables::Deviations.build(model, ring);
    let start = form.start(Start { shift });
    let watch = || Watch::new(model.clone(), &*form, ring.pedestrians);
    let (mut all, mut new, mut quiet) = (watch(), watch(), 0);
    let control = Control::Adaptive { tolerance: 1e-9 };
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end, method: Method::Dop853, control };
    let done = integrate(&problem, &mut |step: &mut Step<'_>| {
        let found = all.look(step);
        assert_eq!(new.look_for_new(step), found, "at t = {}", step.end);
        quiet += usize::from(new.is_quiet());
        let is_over = found.iter().any(|event| event.kind.is_stop());
        if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(done.is_ok(), "{done:?}");
    ([all.found().to_vec(), new.found().to_vec()], quiet)
}

#[test]
fn steps_near_a_uniform_flow_are_passed_over_and_no_event_with_them() {
    let ring = Ring { pedestrians: 67, length: 200.0 };
    let algebraic = |strength: f64| {
        Model::Algebraic(Algebraic { mu: strength, q: 2.0, v0: 3.0, epsilon: 0.1, ..Algebraic::default() })
    };
    let ([all, new], quiet) = looked_at(&algebraic(0.45), ring, 1e-4, 300.0);
    assert!(all.is_empty() && new.is_empty(), "{all:?}, {new:?}");
    assert!(quiet > 50, "{quiet}");
    // unstable: quiet at first, then two touch in a jam
    let ring = Ring { pedestrians: 133, length: 200.0 };
    let logarithmic = Model::Logarithmic(Logarithmic { v0: 2.0, a_v: 0.0, epsilon: 0.01 });
    let ([all, new], quiet) = looked_at(&logarithmic, ring, 1e-4, 3000.0);
    assert!(all.iter().any(|event| event.kind == EventKind::Overlap), "{all:?}");
    assert_eq!(all, new);
    assert!(quiet > 50, "{quiet}");
}
