//! The force of a law that is a Rust function, compiled for blocks of pedestrians.

use super::blocks::{Block, Pace, along};
use super::heun::{self, Cut};
use super::series::{Memory, Motion};
use super::{Dependence, Flow, Force, Interpreted, Prepared, Rows, Steps};
use crate::laws::{Chosen, Law};
use crate::ramp::Bend;
use formula::{Variable, Writer};
use math::affine::Affine;
use math::change::{Player, Recorder, Tape};
use math::dual::{Dual, Gradient};
use math::lanes::Lanes;
use math::simd::{Kernel, Width, dispatch, dispatch_up_to, dispatch_wide};
use ode::Batch;
use std::cell::{OnceCell, RefCell};
use std::sync::Arc;

/// The force of a law.
#[derive(Clone, Debug)]
pub struct Compiled<L: Law> {
    law: L,
    /// The slopes of the acceleration in the own speed and in that ahead, where the formula has the same ones
    /// everywhere.
    speed_slopes: Option<[f64; 2]>,
    /// The uniform flow asked for last: once it is steady it is asked for again and again.
    reference: RefCell<Reference>,
    memory: RefCell<Memory>,
    /// The law as a list of operations, for work that is not worth compiling; large, and most runs do without.
    interpreted: OnceCell<Box<Interpreted>>,
}

/// What the formula keeps of a uniform flow.
#[derive(Clone, Debug)]
struct Reference {
    flow: Flow,
    acceleration: f64,
    tape: Tape,
}

impl Reference {
    fn new<L: Law>(law: &L, flow: Flow) -> Reference {
        let recorder = Recorder::new();
        let speed = recorder.variable(flow.speed);
        law.acceleration(recorder.variable(flow.net_gap), speed, speed);
        Reference { flow, acceleration: Reference::acceleration(law, flow), tape: recorder.finish() }
    }

    /// Turns to another flow. Where the law is `linear_in_speeds`, what it keeps depends on the net gap alone.
    #[cold]
    fn turn_to<L: Law>(&mut self, law: &L, flow: Flow, linear_in_speeds: bool) {
        let is_same_tape = linear_in_speeds && self.flow.net_gap == flow.net_gap;
        if is_same_tape && self.flow.speed.is_finite() && flow.speed.is_finite() {
            (self.flow, self.acceleration) = (flow, Reference::acceleration(law, flow));
        } else {
            *self = Reference::new(law, flow);
        }
    }

    fn acceleration<L: Law>(law: &L, flow: Flow) -> f64 {
        law.acceleration(flow.net_gap, flow.speed, flow.speed)
    }
}

impl<L: Law> Compiled<L> {
    /// The force of this law.
    pub fn new(law: L) -> Compiled<L> {
        let reference = RefCell::new(Reference::new(&law, Flow { net_gap: 1.0, speed: 0.0 }));
        let speed_slopes = speed_slopes(&law);
        Compiled { law, speed_slopes, reference, memory: RefCell::default(), interpreted: OnceCell::new() }
    }

    /// Whether the law has kinks. The arguments of these are known where it is carried out as a list of operations.
    fn has_kinks(&self) -> bool {
        self.reference.borrow().tape.has_kinks()
    }

    fn interpreted(&self) -> &Interpreted {
        self.interpreted.get_or_init(|| Box::new(interpreted(&self.law)))
    }
}

/// The law as a list of operations.
fn interpreted<L: Law>(law: &L) -> Interpreted {
    let writer = Writer::default();
    let [speed, ahead] = [0, 1].map(|j| writer.variable(Variable::Speed(j)));
    let acceleration = law.acceleration(writer.variable(Variable::Spacing(0)) - L::CONTACT, speed, ahead);
    let bound = writer.finish(acceleration);
    Interpreted::new(Arc::new(Prepared::new(&bound, bound.acceleration(), L::CONTACT)), None, L::SINGULAR)
}

fn speed_slopes<L: Law>(law: &L) -> Option<[f64; 2]> {
    law.acceleration(Affine::FREE, Affine::variable(0), Affine::variable(1)).slopes
}

impl<L: Law> Force for Compiled<L> {
    fn contact(&self) -> f64 {
        L::CONTACT
    }

    fn is_singular(&self) -> bool {
        L::SINGULAR
    }

    fn accelerations(&self, net_gaps: &[f64], speeds: &[f64], accelerations: &mut [f64]) {
        let row = Row { net_gaps, speeds, ahead_of_last: speeds[0] };
        self::accelerations(&self.law, Width::Eight, row, accelerations);
    }

    fn deviations(&self, flow: Flow, spacings: &[f64], speeds: &[f64], accelerations: &mut [f64]) -> f64 {
        let mut reference = self.reference.borrow_mut();
        if reference.flow != flow {
            reference.turn_to(&self.law, flow, self.speed_slopes.is_some());
        }
        let (law, tape) = (&self.law, &reference.tape);
        let is_done = !tape.is_faint()
            && (dispatch(Deviations::<L, true> { law, tape, spacings, speeds, accelerations })
                || dispatch_wide(Deviations::<L, false> { law, tape, spacings, speeds, accelerations }).is_some());
        if is_done {
            reference.acceleration
        } else {
            self.interpreted().deviations(flow, spacings, speeds, accelerations)
        }
    }

    fn effective_gaps(&self, net_gaps: &[f64], speeds: &[f64], gaps: &mut [f64]) {
        dispatch(EffectiveGaps { law: self.law, net_gaps, speeds, gaps });
    }

    /// The effective gap is linear, and nothing where net gap and speeds are nothing.
    fn effective_gap_rates(&self, _now: Rows<'_>, rates: Rows<'_>, gap_rates: &mut [f64]) {
        self.effective_gaps(rates.spacings, rates.speeds, gap_rates);
    }

    fn is_open(&self, flow: Flow, spacings: &[f64], speeds: &[f64]) -> bool {
        !L::SINGULAR || dispatch(IsOpen { law: &self.law, flow, spacings, speeds })
    }

    fn uses_speeds(&self) -> bool {
        self.speed_slopes.is_none()
    }

    fn relaxation(&self, _flow: Flow) -> f64 {
        self.speed_slopes.map_or(f64::NAN, |[own, ahead]| own + ahead)
    }

    fn dependence(&self) -> Dependence {
        if self.speed_slopes == Some([-1.0, 0.0]) { Dependence::Spacing } else { Dependence::Speeds }
    }

    fn slopes(&self, flow: Flow, now: Rows<'_>, slopes: &mut [f64]) {
        let law = self.law;
        match self.dependence() {
            Dependence::Spacing => dispatch(Slopes { law, more: flow.net_gap, spacings: now.spacings, slopes }),
            _ => dispatch(Gradients { law, flow, now, slopes }),
        }
    }

    fn bend(&self) -> Option<Bend> {
        self.law.bend()
    }

    fn series(&self, mut motion: Motion<'_>) {
        let operations = self.reference.borrow().tape.histories();
        let is_done = !self.has_kinks()
            && super::series::compiled(self.law, operations, &mut motion, &mut self.memory.borrow_mut());
        if !is_done {
            self.interpreted().series(motion);
        }
    }

    fn kinks(&self) -> usize {
        if self.has_kinks() { self.interpreted().kinks() } else { 0 }
    }

    fn has_unsuited_kinks(&self) -> bool {
        self.has_kinks() && self.interpreted().has_unsuited_kinks()
    }

    fn kink_arguments(&self, pedestrians: usize, order: usize, arguments: &mut [f64]) {
        self.interpreted().kink_arguments(pedestrians, order, arguments);
    }

    fn heun(&self, steps: Steps, cut: Option<Cut>, state: &mut [f64]) -> Batch {
        heun::batch(&self.law, steps, cut, state)
    }
}

/// How the accelerations of a law are computed whose terms are constants.
#[inline(always)]
fn plain_pace<L: Law>(law: &L) -> Pace {
    if law.is_long() { Pace::Wide } else { Pace::Single }
}

/// How a law is carried out otherwise.
#[inline(always)]
fn pace<L: Law>(law: &L) -> Pace {
    if law.is_long() { Pace::Wide } else { Pace::Narrow }
}

/// Pedestrians each of whom follows the next; the last one follows a pedestrian with the given speed, which may also be
/// stored after the others.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    pub(super) net_gaps: &'a [f64],
    pub(super) speeds: &'a [f64],
    pub(super) ahead_of_last: f64,
}

/// Writes the accelerations of a row, with registers no wider than this limit. A function of its own, compiled once for
/// whoever needs them. Laws with terms that the runs of the paper do not have are compiled for registers of one width,
/// since copies would take longer to compile than they save; where there are none, pedestrians are done one after the
/// other.
pub(super) fn accelerations<L: Law>(law: &L, limit: Width, row: Row<'_>, accelerations: &mut [f64]) {
    if law.plain().is_some() {
        return dispatch_up_to(limit, Accelerations::<L, true> { law, row, accelerations });
    }
    let is_done = limit >= Width::Four
        && dispatch_wide(Accelerations::<L, false> { law, row, accelerations: &mut *accelerations }).is_some();
    if !is_done {
        let Row { net_gaps, speeds, ahead_of_last } = row;
        along(&Values(*law), Pace::Single, net_gaps, speeds, ahead_of_last, accelerations);
    }
}

/// The accelerations of a row, under the law in its [plain](Law::plain) form if `PLAIN`.
struct Accelerations<'a, L, const PLAIN: bool> {
    law: &'a L,
    row: Row<'a>,
    accelerations: &'a mut [f64],
}

/// The accelerations of a law, block by block.
struct Values<L>(L);

impl<L: Law> Block for Values<L> {
    const FILLER: [f64; 2] = [1.0, 0.0];

    #[inline(always)]
    fn value<const W: usize>(&self, net_gap: Lanes<W>, speed: Lanes<W>, ahead: Lanes<W>) -> Lanes<W> {
        self.0.acceleration(net_gap, speed, ahead)
    }
}

impl<L: Law, const PLAIN: bool> Kernel for Accelerations<'_, L, PLAIN> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Accelerations { law, row: Row { net_gaps, speeds, ahead_of_last }, accelerations } = self;
        if !PLAIN {
            along(&Values(*law), pace(law), net_gaps, speeds, ahead_of_last, accelerations);
        } else if let Some(law) = law.plain() {
            along(&Values(law), plain_pace(&law), net_gaps, speeds, ahead_of_last, accelerations);
        }
    }
}

/// The accelerations of all pedestrians less that of the uniform flow; false if the law is another one: one in a plain
/// form if `PLAIN`, else one with any terms.
struct Deviations<'a, L, const PLAIN: bool> {
    law: &'a L,
    tape: &'a Tape,
    spacings: &'a [f64],
    speeds: &'a [f64],
    accelerations: &'a mut [f64],
}

struct Changes<'a, L> {
    law: L,
    tape: &'a Tape,
}

impl<L: Law> Block for Changes<'_, L> {
    const FILLER: [f64; 2] = [0.0, 0.0];

    #[inline(always)]
    fn value<const W: usize>(&self, spacing: Lanes<W>, speed: Lanes<W>, ahead: Lanes<W>) -> Lanes<W> {
        let player = Player::new(self.tape);
        self.law.acceleration(player.variable(spacing), player.variable(speed), player.variable(ahead)).change()
    }
}

impl<L: Law, const PLAIN: bool> Deviations<'_, L, PLAIN> {
    #[inline(always)]
    fn along(self, law: L, pace: Pace) -> bool {
        let Deviations { tape, spacings, speeds, accelerations, .. } = self;
        along(&Changes { law, tape }, pace, spacings, speeds, speeds[0], accelerations);
        true
    }
}

impl<L: Law, const PLAIN: bool> Kernel for Deviations<'_, L, PLAIN> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let law = *self.law;
        law.choose(self)
    }
}

impl<L: Law, const PLAIN: bool> Chosen<L> for Deviations<'_, L, PLAIN> {
    type Output = bool;

    #[inline(always)]
    fn any(self, law: L) -> bool {
        !PLAIN && self.along(law, Pace::Wide)
    }

    #[inline(always)]
    fn plain(self, law: L) -> bool {
        PLAIN && self.along(law, pace(&law))
    }

    #[inline(always)]
    fn straight(self, law: L) -> bool {
        PLAIN && self.along(law, Pace::Single)
    }
}

/// The derivatives of the accelerations by the net gaps.
struct Slopes<'a, L> {
    law: L,
    /// What the spacings lack of net gaps.
    more: f64,
    spacings: &'a [f64],
    slopes: &'a mut [f64],
}

impl<L: Law> Slopes<'_, L> {
    #[inline(always)]
    fn of(self, law: impl Law) {
        let rest = Dual::constant(0.0);
        for (slope, spacing) in self.slopes.iter_mut().zip(self.spacings) {
            *slope = law.acceleration(Dual::variable(self.more + spacing), rest, rest).slope;
        }
    }
}

impl<L: Law> Kernel for Slopes<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        match self.law.plain() {
            Some(law) => self.of(law),
            None => {
                let law = self.law;
                self.of(law);
            }
        }
    }
}

/// The derivatives of the accelerations by the net gaps, the own speeds and those ahead, row by row.
struct Gradients<'a, L> {
    law: L,
    /// What spacings and speeds deviate from.
    flow: Flow,
    now: Rows<'a>,
    slopes: &'a mut [f64],
}

impl<L: Law> Kernel for Gradients<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Gradients { law, flow, now: Rows { spacings, speeds }, slopes } = self;
        let n = spacings.len();
        let gradient = |spacing: f64, own: f64, ahead: f64| {
            let variable = |which: usize, value: f64| Dual { value, slope: Gradient::<3>::of(which) };
            let (net_gap, own) = (variable(0, flow.net_gap + spacing), variable(1, flow.speed + own));
            law.acceleration(net_gap, own, variable(2, flow.speed + ahead)).slope.0
        };
        let (by_spacing, by_speeds) = slopes.split_at_mut(n);
        let (by_own, by_ahead) = by_speeds.split_at_mut(n);
        let rows = by_spacing.iter_mut().zip(by_own).zip(by_ahead);
        let pairs = spacings.iter().zip(speeds).zip(speeds.iter().skip(1).chain(&speeds[..1]));
        for (((by_spacing, by_own), by_ahead), ((spacing, own), ahead)) in rows.zip(pairs) {
            [*by_spacing, *by_own, *by_ahead] = gradient(*spacing, *own, *ahead);
        }
    }
}

/// The effective gaps of all pedestrians.
struct EffectiveGaps<'a, L> {
    law: L,
    net_gaps: &'a [f64],
    speeds: &'a [f64],
    gaps: &'a mut [f64],
}

impl<L: Law> Kernel for EffectiveGaps<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let EffectiveGaps { law, net_gaps, speeds, gaps } = self;
        let last = net_gaps.len() - 1;
        let pairs = net_gaps.iter().zip(speeds).zip(&speeds[1..]);
        for (gap, ((net_gap, speed), ahead)) in gaps.iter_mut().zip(pairs) {
            *gap = law.effective_gap(*net_gap, *speed, *ahead);
        }
        gaps[last] = law.effective_gap(net_gaps[last], speeds[last], speeds[0]);
    }
}

/// Whether every effective gap is positive, for deviations from a uniform flow.
struct IsOpen<'a, L> {
    law: &'a L,
    flow: Flow,
    spacings: &'a [f64],
    speeds: &'a [f64],
}

impl<L: Law> IsOpen<'_, L> {
    /// Whether one of so many pedestrians, from this one on, has no gap. A block at a time, and each block to its end:
    /// the compiler makes a comparison of registers of it.
    #[inline(always)]
    fn is_closed<const W: usize>(&self, open: f64, from: usize, ahead: Lanes<W>) -> bool {
        let (spacings, speeds) = (Lanes::of(&self.spacings[from..]), Lanes::of(&self.speeds[from..]));
        // the effective gap is linear: what the deviations add to that of the uniform flow
        let gaps = self.law.effective_gap(spacings, speeds, ahead) + open;
        let mut is_closed = false;
        for gap in gaps.0 {
            is_closed |= gap <= 0.0;
        }
        is_closed
    }
}

impl<L: Law> Kernel for IsOpen<'_, L> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        const W: usize = 16;
        let (last, flow) = (self.spacings.len() - 1, self.flow);
        let open = self.law.effective_gap(flow.net_gap, flow.speed, flow.speed);
        let mut is_closed = self.is_closed(open, last, Lanes([self.speeds[0]]));
        if last < W {
            for n in 0..last {
                is_closed |= self.is_closed(open, n, Lanes([self.speeds[n + 1]]));
            }
        } else {
            for from in (0..last).step_by(W) {
                // the last block begins earlier rather than be cut
                let from = if from < last - W { from } else { last - W };
                is_closed |= self.is_closed::<W>(open, from, Lanes::of(&self.speeds[from + 1..]));
            }
        }
        !is_closed
    }
}
