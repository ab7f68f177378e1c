//! Judges a run while it is integrated.

use super::least::{Ends, highest, lowest};
use super::repeats::{Repeats, Repetition};
use super::windows::{Stretch, drift, last};
use super::{AGREEMENT, CONTRAST, Class, Decision, Memory, NEAR_FLOW, NEAR_LINE, START, Verdict};
use crate::events::{Event, EventKind, Watch};
use crate::laws::Model;
use crate::observe::speed_std;
use crate::ring::Ring;
use ode::Step;

/// Observes every step of a run and determines its outcome.
#[derive(Debug)]
pub struct Judge {
    ring: Ring,
    /// The size of speeds.
    scale: f64,
    flow: Option<Flow>,
    least_gap: f64,
    least_speed: f64,
    /// The least speed of all, the start from rest included.
    least_of_all: f64,
    std: f64,
    /// The end of the step looked at last.
    seen: f64,
    /// The largest less the least speed there.
    contrast: f64,
    blocks: Vec<Stretch>,
    block: Stretch,
    repeats: Repeats,
    verdict: Option<Verdict>,
}

/// The stability of the uniform flow, from the linearised law.
#[derive(Clone, Copy, Debug)]
struct Flow {
    headway: f64,
    speed: f64,
    /// The least of headway and effective gap.
    clearance: f64,
    /// The margin of stability of the waves of the ring.
    margin: f64,
    growth_rate: f64,
}

/// The duration of a block of statistics.
const BLOCK: f64 = 50.0;

/// Windows are at least so long.
const SHORTEST_WINDOW: f64 = 200.0;

/// Irregular waves, whose least gap is another one in each short window, are judged by windows of this part of the run.
const THIRD: f64 = 1.0 / 3.0;

/// Windows are looked at first at this time, then whenever it has doubled. The jams of a logarithmic ring stand long
/// before they touch: at `v0 = 1.256` by t = 300, and touch at t = 1300.
const FIRST_JUDGED: f64 = 6000.0;

/// And so long that waves go around the ring so often, seen by those who walk in it: as seen from the ground a wave can
/// stand, and no window would be long enough.
const ROUNDS: f64 = 2.0;

impl Judge {
    /// For a run of this law on this ring, whose uniform flow has this speed, if there is one.
    pub fn new(model: &Model, ring: Ring, speed: Option<f64>) -> Judge {
        let flow = speed.and_then(|speed| Flow::of(model, ring, speed));
        Judge {
            ring,
            scale: model.desired_speed(),
            flow,
            least_gap: f64::INFINITY,
            least_speed: f64::INFINITY,
            least_of_all: f64::INFINITY,
            std: 0.0,
            seen: 0.0,
            contrast: 0.0,
            blocks: Vec::new(),
            block: Stretch::EMPTY,
            repeats: Repeats::default(),
            verdict: None,
        }
    }

    /// What is certain so far, if anything is.
    pub fn verdict(&self) -> Option<&Verdict> {
        self.verdict.as_ref()
    }

    /// What has been seen so far.
    pub fn remember(&self) -> Memory {
        let numbers = [self.least_gap, self.least_speed, self.least_of_all, self.std, self.seen, self.contrast];
        let (blocks, block) = (self.blocks.clone(), self.block.clone());
        Memory { numbers, blocks, block, repeats: self.repeats.clone(), verdict: self.verdict.clone() }
    }

    /// Goes on where another judge of the same run stood.
    pub fn recall(&mut self, memory: Memory) {
        [self.least_gap, self.least_speed, self.least_of_all, self.std, self.seen, self.contrast] = memory.numbers;
        (self.blocks, self.block, self.repeats, self.verdict) =
            (memory.blocks, memory.block, memory.repeats, memory.verdict);
    }

    /// Looks at what happens at the start.
    pub fn start(&mut self, watch: &Watch<'_>, found: &[Event]) {
        let now = watch.after();
        (self.least_gap, self.least_of_all) = (lowest(&now.effective_gaps), lowest(&now.speeds));
        self.std = speed_std(&now.speeds);
        self.happened(watch, found);
    }

    /// Observes a step after the watch has; `new` are the events that the watch found.
    pub fn look(&mut self, watch: &mut Watch<'_>, step: &mut Step<'_>, new: &[Event]) {
        if self.verdict.is_some() {
            return;
        }
        let before = self.seen;
        let contrast = self.gather(watch, step);
        self.happened(watch, new);
        if self.verdict.is_some() {
            return;
        }
        if self.is_back(watch) {
            let distance = self.flow.map_or(0.0, |flow| -flow.margin);
            return self.decide(Class::Decays, step.end, Decision::Return, distance);
        }
        if contrast > CONTRAST * self.scale
            && step.end > START
            && let Some(repetition) = self.repeats.look(watch, step, contrast, self.scale)
        {
            self.repeated(step.end, repetition);
        }
        if self.verdict.is_none() && is_time_to_judge(before, step.end) {
            // what is not certain yet may be later
            let _ = self.judge_windows(step.end);
        }
    }

    /// The verdict of a run that ended at this time, with these events: those that no step showed among them.
    pub fn end(mut self, time: f64, found: &[Event]) -> Verdict {
        if self.verdict.is_none() {
            self.stopped(found, f64::INFINITY);
        }
        if self.verdict.is_none() {
            self.close_block();
            if let Err(missing) = self.judge_windows(time) {
                self.decide(Class::Undecided, time, Decision::Missing(missing), 0.0);
            }
        }
        self.verdict.take().unwrap_or_else(|| self.of(Class::Undecided, time, Decision::Start, 0.0))
    }

    /// Decides for lasting waves if the last windows agree, or for a decay in progress.
    fn judge_windows(&mut self, time: f64) -> Result<(), String> {
        if let Some(margin) = self.is_falling() {
            self.decide(Class::Decays, time, Decision::Falling, -margin);
            return Ok(());
        }
        let [mut late, early] = self.agreeing()?;
        late.least_speed = lowest(&[late.least_speed, early.least_speed]);
        let label_speed = late.label_speed();
        self.lasting(time, Decision::Windows, &late, label_speed);
        Ok(())
    }

    /// Takes the numbers of a step; returns the contrast of speeds at its end.
    fn gather(&mut self, watch: &mut Watch<'_>, step: &mut Step<'_>) -> f64 {
        let h = step.length();
        // steps of fixed length between two samples are not all shown: this one stands for them
        let since = step.end - self.seen;
        self.seen = step.end;
        let (mut gap, mut speed) = (lowest(&watch.after().effective_gaps), lowest(&watch.after().speeds));
        let contrast = highest(&watch.after().speeds) - speed;
        let (before, after) = (watch.before(), watch.after());
        let gaps = Ends {
            before: (&before.effective_gaps, &before.effective_gap_rates),
            after: (&after.effective_gaps, &after.effective_gap_rates),
            h,
        };
        let speeds =
            Ends { before: (&before.speeds, &before.speed_rates), after: (&after.speeds, &after.speed_rates), h };
        let dips =
            [gaps.dip(lowest(&[gap, self.block.least_gap])), speeds.dip(lowest(&[speed, self.block.least_speed]))];
        for theta in dips.into_iter().flatten() {
            let within = watch.within(step, theta);
            (gap, speed) = (lowest(&[gap, lowest(&within.effective_gaps)]), lowest(&[speed, lowest(&within.speeds)]));
        }
        let now = watch.after();
        (self.std, self.contrast) = (speed_std(&now.speeds), contrast);
        let mean = now.speeds.iter().sum::<f64>() / now.speeds.len() as f64;
        self.block.add(since, self.std, mean, drift(&now.speeds, &now.speed_rates));
        self.block.contrast = lowest(&[self.block.contrast, contrast]);
        self.block.least_gap = lowest(&[self.block.least_gap, gap]);
        self.block.least_speed = lowest(&[self.block.least_speed, speed]);
        self.least_gap = lowest(&[self.least_gap, gap]);
        self.least_of_all = lowest(&[self.least_of_all, speed]);
        if step.start >= START {
            self.least_speed = lowest(&[self.least_speed, speed]);
        }
        if self.block.duration >= BLOCK {
            self.close_block();
        }
        contrast
    }

    fn close_block(&mut self) {
        if self.block.duration > 0.0 {
            self.blocks.push(std::mem::replace(&mut self.block, Stretch::EMPTY));
        }
    }

    /// Decides by the first event that ends a run.
    fn happened(&mut self, watch: &Watch<'_>, new: &[Event]) {
        if let Some(stop) = new.iter().find(|event| event.kind.is_stop()) {
            self.stopped(new, watch.after().effective_gap_rates[stop.pedestrian].abs() / self.scale);
        }
    }

    /// The same, of a gap that closes at this speed, in units of the desired one.
    fn stopped(&mut self, found: &[Event], closing: f64) {
        let Some(stop) = found.iter().find(|event| event.kind.is_stop()) else { return };
        let (class, distance) = match stop.kind {
            EventKind::Undefined => (Class::Undefined, f64::INFINITY),
            EventKind::BlowUp => (Class::BlowUp, f64::INFINITY),
            _ => (Class::Contact, if closing.is_nan() { f64::INFINITY } else { closing }),
        };
        if class == Class::Contact {
            // the step goes on beyond it
            self.least_gap = 0.0;
        }
        self.decide(class, stop.time, Decision::EventKind, distance);
    }

    /// Whether the state is back at the uniform flow, and stays there.
    fn is_back(&self, watch: &Watch<'_>) -> bool {
        let Some(Flow { headway, speed, clearance, .. }) = self.flow.filter(Flow::decays) else { return false };
        let now = watch.after();
        let near = |numbers: &[f64], flow: f64, bound: f64| numbers.iter().all(|number| (number - flow).abs() < bound);
        near(&now.speeds, speed, NEAR_FLOW * self.scale) && near(&now.gaps, headway, NEAR_FLOW * clearance)
    }

    /// The length of the windows that waves are judged by; `None` if nothing travels.
    fn window(&self) -> Option<f64> {
        let (recent, _) = last(&self.blocks, 0.0, SHORTEST_WINDOW)?;
        let around = ROUNDS * self.ring.pedestrians as f64 / recent.label_speed().abs();
        around.is_finite().then_some(math::larger(around, SHORTEST_WINDOW))
    }

    /// The last two windows of this length, the later first.
    fn windows(&self, duration: f64) -> Option<[Stretch; 2]> {
        let (late, until) = last(&self.blocks, 0.0, duration)?;
        let (early, _) = last(&self.blocks, until, duration)?;
        Some([late, early])
    }

    /// The margin of stability, if every wave of the ring decays, speeds differ too little for waves, and less and
    /// less. Where neighbours hardly answer to each other, a perturbation takes longer than any run to fall below
    /// [`NEAR_FLOW`].
    fn is_falling(&self) -> Option<f64> {
        let flow = self.flow.filter(Flow::decays)?;
        let [late, early] = self.windows(THIRD * self.seen)?;
        let is_weak = self.contrast < CONTRAST * self.scale;
        (is_weak && late.mean_std() < (1.0 - AGREEMENT) * early.mean_std()).then_some(flow.margin)
    }

    /// The last two windows, or the last two thirds of the run, if waves last through both and they agree.
    fn agreeing(&self) -> Result<[Stretch; 2], String> {
        let least = self.window().unwrap_or(SHORTEST_WINDOW);
        let third = THIRD * self.seen;
        let thirds = if third > least { self.windows(third) } else { None };
        let (Some(windows), Some(thirds)) = (self.windows(least), thirds) else {
            return Err(format!("a longer t_end: three windows of at least {least:.0} must fit in"));
        };
        let contrast = |pair: &[Stretch; 2]| lowest(&[pair[0].contrast, pair[1].contrast]);
        let last_contrast = contrast(&windows);
        if !is_above(last_contrast, CONTRAST * self.scale) {
            return Err(self.too_weak(last_contrast));
        }
        let [std, gap] = changes(&windows);
        let missing = format!(
            "a longer t_end: between the last two windows of {least:.0} the standard deviation changes by {:.1} %, the least gap by {:.1} %",
            100.0 * std,
            100.0 * gap
        );
        let agree = |pair: &[Stretch; 2]| {
            is_above(contrast(pair), CONTRAST * self.scale) && changes(pair).iter().all(|change| *change < AGREEMENT)
        };
        [windows, thirds].into_iter().find(agree).ok_or(missing)
    }

    /// Why a run without strong waves is not one that decays.
    fn too_weak(&self, contrast: f64) -> String {
        let weak = format!("speeds differ by no more than {contrast:.1e}");
        match self.flow {
            None => format!("another law: {weak}, and the uniform flow has no linearised law"),
            Some(flow) if flow.margin.abs() <= NEAR_LINE => {
                format!("other parameters: {weak}, and the stability margin, {:.1e}, is too close to 0", flow.margin)
            }
            Some(flow) if flow.growth_rate > 0.0 => {
                format!("a longer t_end: {weak}, growing at a rate of {:.1e}", flow.growth_rate)
            }
            Some(flow) => format!("a longer t_end: {weak}, decaying at a rate of {:.1e}", flow.growth_rate),
        }
    }

    /// Decides for waves that repeat themselves.
    fn repeated(&mut self, time: f64, Repetition { period, shift }: Repetition) {
        self.close_block();
        // back to before the state first repeated itself
        let Some((window, _)) = last(&self.blocks, 0.0, period) else { return };
        let count = self.ring.pedestrians as f64;
        let rounds = ((window.label_speed() * period - shift) / count).round();
        self.lasting(time, Decision::Repetition, &window, (shift + rounds * count) / period);
    }

    /// Decides for lasting waves, by what they are in this window.
    fn lasting(&mut self, time: f64, decision: Decision, window: &Stretch, label_speed: f64) {
        let class = if window.least_speed < 0.0 { Class::WavesBackwards } else { Class::Waves };
        let clearance = self.flow.map_or(self.ring.headway(), |flow| flow.clearance);
        let distances = [
            window.contrast / (CONTRAST * self.scale) - 1.0,
            window.least_gap / clearance,
            window.least_speed.abs() / self.scale,
        ];
        self.std = window.mean_std();
        self.decide(class, time, decision, lowest(&distances));
        if let Some(verdict) = &mut self.verdict {
            verdict.lasting_least_speed = Some(window.least_speed);
            verdict.wave_speed = Some(window.mean_speed() + self.ring.headway() * label_speed);
        }
    }

    fn decide(&mut self, class: Class, time: f64, decision: Decision, distance: f64) {
        self.verdict = Some(self.of(class, time, decision, distance));
    }

    fn of(&self, class: Class, time: f64, decision: Decision, distance: f64) -> Verdict {
        Verdict {
            class,
            time,
            decision,
            backward_flow: self.flow.is_some_and(|flow| flow.speed < 0.0),
            least_gap: self.least_gap,
            least_speed: if self.least_speed.is_finite() { self.least_speed } else { self.least_of_all },
            std: self.std,
            lasting_least_speed: None,
            wave_speed: None,
            distance,
        }
    }
}

/// Whether a step ends at or behind a time at which windows are looked at, and begins before it.
fn is_time_to_judge(start: f64, end: f64) -> bool {
    let mut time = FIRST_JUDGED;
    while time <= start {
        time *= 2.0;
    }
    end >= time
}

/// Whether a number is above a bound, and is a number.
fn is_above(number: f64, bound: f64) -> bool {
    number > bound
}

/// By which part of themselves the mean standard deviation and the least gap change from the earlier to the later.
fn changes([late, early]: &[Stretch; 2]) -> [f64; 2] {
    let change = |late: f64, early: f64| (late - early).abs() / late.abs();
    [change(late.mean_std(), early.mean_std()), change(late.least_gap, early.least_gap)]
}

impl Flow {
    /// Whether every wave of the ring decays according to the linearised law.
    fn decays(&self) -> bool {
        self.growth_rate < 0.0 && self.margin < -NEAR_LINE
    }

    fn of(model: &Model, ring: Ring, speed: f64) -> Option<Flow> {
        let headway = ring.headway();
        let response = model.response(headway, speed)?;
        let gap = model.effective_gap(headway, speed, speed);
        let clearance = if gap < headway { gap } else { headway };
        let (margin, growth_rate) = response.of_ring(ring.pedestrians);
        Some(Flow { headway, speed, clearance, margin, growth_rate })
    }
}
