//! The errors of a run by Taylor's method, whose steps tell their own, carried along with it ([`ode::Shadow`]).

use crate::check::{Errors, ROUNDINGS, largest};
use crate::run::Scene;
use crate::simulation::{Onlooker, Outcome, Sight};
use jam::events::{Event, Happening};
use jam::states::FormKind;
use ode::{Shadow, Step};

/// Looks on while a scene runs from its start, and knows the errors at its end if the steps tell theirs.
#[derive(Clone, Debug)]
pub struct Propagated {
    pedestrians: usize,
    shadow: Option<Shadow>,
    /// Whether a step did not tell its error.
    is_blind: bool,
    /// The largest error of the standard deviation so far.
    std: f64,
    /// Of the times of events within steps.
    events: Vec<f64>,
}

/// The first order left out is not all that a step leaves out.
const CAUTION: f64 = 2.0;

impl Onlooker for Propagated {
    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        if self.is_blind {
            return;
        }
        let (n, dimension) = (self.pedestrians, step.after().len());
        let shadow = self.shadow.get_or_insert_with(|| Shadow::new(of_start(step.before(), n)));
        if shadow.now().len() != dimension {
            *shadow = Shadow::new(in_gaps(shadow.now(), n));
        }
        let before = if sight.new.is_empty() { Vec::new() } else { shadow.now().to_vec() };
        self.is_blind = !shadow.follow(step);
        if self.is_blind {
            return;
        }
        if sight.has_sample {
            let error = std_error(&step.after()[n..2 * n], &shadow.now()[n..2 * n]);
            self.std = if error <= self.std { self.std } else { error };
        }
        for happening in sight.new {
            let mut change = |direction: &[f64]| {
                sight.watch.change(happening.event, happening.pedestrian, step.after(), direction).abs()
            };
            let by_error = math::larger(change(&before), change(shadow.now()));
            let place = (happening.time - step.start) / step.length();
            let rate = (1.0 - place) * change(step.rates_before()) + place * change(step.rates_after());
            self.events.push(if by_error == 0.0 { 0.0 } else { by_error / rate });
        }
    }
}

impl Propagated {
    /// Before the first step.
    pub fn new(scene: &Scene) -> Propagated {
        let (pedestrians, std) = (scene.ring.pedestrians, 0.0);
        Propagated { pedestrians, shadow: None, is_blind: !scene.method.needs_series(), std, events: Vec::new() }
    }

    /// The errors of the run that it has seen; `None` where steps did not tell theirs.
    pub fn errors(&self, scene: &Scene, outcome: &Outcome) -> Option<Errors> {
        let error = self.shadow.as_ref().filter(|_| !self.is_blind)?.now();
        let n = self.pedestrians;
        // deviations have the speed of the uniform flow, too
        let (spacings, flow) = (&error[..n], error.get(2 * n + 2).copied().unwrap_or(0.0));
        let speeds: Vec<f64> = error[n..2 * n].iter().map(|error| error + flow).collect();
        let first: f64 = error[2 * n..].iter().take(2).sum();
        let positions: Vec<f64> = std::iter::once(&first)
            .chain(spacings)
            .scan(0.0, |position, more| {
                *position += more;
                Some(*position)
            })
            .take(n)
            .collect();
        let rounding = |numbers: &[f64]| ROUNDINGS * largest(numbers);
        let of_std = match scene.form {
            FormKind::Deviations => ROUNDINGS * outcome.std.rows().fold(0.0, |most, row| math::larger(most, row[1])),
            _ => rounding(&outcome.speeds),
        };
        // at a blow-up a rounding of the time is a large part of the state
        let is_blow_up = outcome.events.iter().any(|happening| happening.event == Event::BlowUp);
        let end =
            |errors: &[f64], numbers: &[f64]| (!is_blow_up).then(|| CAUTION * largest(errors) + rounding(numbers));
        Some(Errors {
            std: Some(CAUTION * self.std + of_std + f64::MIN_POSITIVE),
            positions: end(&positions, &outcome.positions).map(|error| error + 2.0 * rounding(&outcome.positions)),
            speeds: end(&speeds, &outcome.speeds).map(|error| error + ROUNDINGS * scene.model.desired_speed().abs()),
            events: self.of_events(&outcome.events),
            cost: 0.0,
        })
    }

    /// Events at the start are exact; that a run has come to a wall is no event of a step.
    fn of_events(&self, events: &[Happening]) -> Vec<Option<f64>> {
        let mut of_steps = self.events.iter();
        let error = |happening: &Happening| match happening.time {
            0.0 => Some(0.0),
            time => of_steps.next().map(|error| CAUTION * error + ROUNDINGS * time),
        };
        events.iter().map(error).collect()
    }
}

/// The rounding of the start: none in deviations; in spacings that of the two that differ from the rest.
fn of_start(state: &[f64], n: usize) -> Vec<f64> {
    let mut error = vec![0.0; state.len()];
    if state.len() == 2 * n + 1 {
        error[0] = 0.5 * f64::EPSILON * state[0].abs();
        error[n - 1] = -0.5 * f64::EPSILON * state[n - 1].abs();
    }
    error
}

/// An error in deviations as one in spacings and speeds.
fn in_gaps(error: &[f64], n: usize) -> Vec<f64> {
    let mut gaps = error[..2 * n + 1].to_vec();
    gaps[n..2 * n].iter_mut().for_each(|speed| *speed += error[2 * n + 2]);
    gaps[2 * n] += error[2 * n + 1];
    gaps
}

/// By how much the standard deviation of speeds differs from that of the speeds less their errors. Scaled: speeds of 1e-200
/// have squares.
fn std_error(speeds: &[f64], errors: &[f64]) -> f64 {
    let (count, scale) = (speeds.len() as f64, math::larger(largest(speeds), largest(errors)));
    if scale == 0.0 || !scale.is_finite() {
        return scale;
    }
    let share = 1.0 / (scale * count);
    let (mean, shift) = (speeds.iter().sum::<f64>() * share, errors.iter().sum::<f64>() * share);
    let (mut squares, mut others, mut between) = (0.0, 0.0, 0.0);
    for (speed, error) in speeds.iter().zip(errors) {
        let (own, off) = (speed / scale - mean, error / scale - shift);
        squares += own * own;
        others += (own - off) * (own - off);
        between += off * (2.0 * own - off);
    }
    if between == 0.0 {
        return 0.0;
    }
    scale * (between / count).abs() / ((squares / count).sqrt() + (others / count).sqrt())
}
