//! One run: its cost, and its distance from the solution.

use super::scenes::Instant;
use cpu_time::ProcessTime;
use jam::events::{EventKind, Watch};
use jam::observe::speed_std;
use jam::states::StateVariables;
use math::double_double::DoubleDouble;
use ode::{Control, Method, Observer, Problem, Sampler, Step, integrate};
use scene::run::Scene;
use std::ops::ControlFlow;

/// Cost and error of a run.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Evaluations of the right-hand side, those for samples at every unit of time included; where the integration
    /// failed, none are known.
    pub evaluations: Option<u64>,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps; unknown where the integration failed.
    pub rejected: Option<u64>,
    /// Largest error of a gap and of a speed, over all pedestrians and all times of the solution; nothing when the run
    /// stopped before the last of them.
    pub errors: Option<(f64, f64)>,
    /// What ended the run early: an event, or `not_finite`, `step_too_small`.
    pub stop: Option<&'static str>,
    /// Seconds of the process on its processor.
    pub seconds: f64,
}

/// Looks for events, samples the standard deviation of the speeds and compares with the solution.
struct Judge<'a> {
    solution: &'a [Instant],
    pedestrians: usize,
    watch: Watch<'a>,
    sampler: Sampler,
    /// The times of the solution passed so far.
    passed: usize,
    worst: (f64, f64),
    steps: u64,
    stop: Option<EventKind>,
    /// The standard deviations, as `simulate` would keep them.
    std: Vec<f64>,
}

/// Integrates the deviations from the uniform flow, sampled as the scene says, as `simulate` does, up to the end of the
/// solution or the first stop.
pub fn measure(scene: &Scene, method: Method, control: Control, solution: &[Instant]) -> Measured {
    let form = StateVariables::Deviations.build(&scene.model, scene.ring);
    let pedestrians = scene.ring.pedestrians;
    let start = form.start(scene.start);
    let mut judge = Judge {
        solution,
        pedestrians,
        watch: Watch::new(scene.model.clone(), &*form, pedestrians),
        sampler: Sampler::new(scene.sample, form.dimension()),
        passed: 0,
        worst: (0.0, 0.0),
        steps: 0,
        stop: None,
        std: Vec::with_capacity((scene.t_end / scene.sample) as usize),
    };
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: scene.t_end, method, control };
    let clock = ProcessTime::now();
    let result = integrate(&problem, &mut judge);
    let seconds = clock.elapsed().as_secs_f64();
    let failed = result.as_ref().err().map(ode::Failure::name);
    let statistics = result.ok();
    // an event in the last step may come after the last sample, or with it
    let is_whole = judge.passed == solution.len() && judge.stop.is_none();
    Measured {
        evaluations: statistics.as_ref().map(|statistics| statistics.evaluations),
        steps: judge.steps,
        rejected: statistics.as_ref().map(|statistics| statistics.rejected),
        errors: is_whole.then_some(judge.worst),
        stop: judge.stop.map(EventKind::name).or(failed),
        seconds,
    }
}

impl Observer for Judge<'_> {
    fn after(&mut self, step: &mut Step<'_>) -> ControlFlow<()> {
        self.steps += 1;
        let new = self.watch.look(step);
        let stop = new.iter().find(|happening| happening.kind.is_stop());
        let until = stop.map_or(f64::INFINITY, |happening| happening.time);
        let Judge { solution, pedestrians, sampler, passed, worst, std, .. } = self;
        let end = if until < step.end { until } else { step.end };
        sampler.within(step, end, &mut |time, state| {
            std.push(speed_std(&state[*pedestrians..2 * *pedestrians]));
            if let Some(instant) = solution.get(*passed).filter(|instant| (instant.time - time).abs() < 1e-9) {
                let (gap, speed) = distance(instant, state);
                *worst = (larger(worst.0, gap), larger(worst.1, speed));
                *passed += 1;
            }
        });
        self.stop = stop.map(|happening| happening.kind);
        if self.stop.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn next_sample(&self) -> f64 {
        self.sampler.next()
    }
}

/// The largest errors of gaps and of speeds. The state is that of [`jam::states::Deviations`]; gaps are compared as
/// deviations, which have more digits than gaps.
fn distance(instant: &Instant, state: &[f64]) -> (f64, f64) {
    let count = instant.gaps.len();
    let uniform = state[2 * count + 2];
    let gaps = instant.gaps.iter().zip(state).map(|(exact, gap)| (gap - exact).abs());
    let speeds = instant.speeds.iter().zip(&state[count..2 * count]);
    let speeds = speeds.map(|(exact, speed)| (DoubleDouble::sum(uniform, *speed) - *exact).hi.abs());
    (gaps.fold(0.0, larger), speeds.fold(0.0, larger))
}

/// The larger of two numbers; infinite when the second is none, so that no error is lost.
fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { math::larger(a, b) }
}
