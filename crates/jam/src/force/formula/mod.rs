//! The force of a law that is a formula in a scene. Its graph is evaluated over rows of pedestrians and gives the bits
//! of the same formula written in Rust.

pub mod program;
mod rows;
mod series;

use super::{Cut, Dependence, Flow, Force, Motion, Steps};
use formula::{Bound, Id, Unary};
use math::change::rules::Kept;
use math::dual::{Dual, Gradient};
use math::lanes::Lanes;
use math::simd::dispatch;
use ode::Batch;
pub use program::Source;
use program::{Action, Instruction, Program};
use rows::{Machine, Neighbours, Reach, Rows};
use series::Along;
use std::cell::RefCell;
use std::sync::Arc;

/// A formula that is ready to be carried out.
#[derive(Clone, Debug)]
pub struct Prepared {
    contact: f64,
    program: Program,
    variables: Vec<Source>,
    reach: Reach,
    /// How many operations keep something of earlier orders of a series.
    operations: usize,
    /// Where those of the operations with kinks begin among them.
    kinks: Vec<usize>,
    uses_speeds: bool,
}

impl Prepared {
    /// Prepares a root of a graph; `contact` is the spacing at which two touch.
    pub fn new(bound: &Bound, root: Id, contact: f64) -> Prepared {
        let program = Program::new(bound, root, contact);
        let reach = Reach::of(&program);
        let operations = program.instructions.iter().map(|instruction| instruction.action.histories()).sum();
        let kinks = program.kinks();
        let uses_speeds = !relaxes_only(&program);
        let variables = program.variables();
        Prepared { contact, program, variables, reach, operations, kinks, uses_speeds }
    }

    /// The instructions.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Writes the accelerations in uniform flows with this net gap, one for each speed.
    pub fn in_uniform_flows(&self, net_gap: f64, speeds: &[f64], accelerations: &mut [f64]) {
        let program = &self.program.of_uniform_flow();
        let (mut neighbours, mut machine) = (Neighbours::default(), Machine::default());
        machine.resize(program.registers);
        let (reach, net_gaps) = (Reach::of(program), [net_gap; AT_ONCE]);
        for (speeds, result) in speeds.chunks(AT_ONCE).zip(accelerations.chunks_mut(AT_ONCE)) {
            neighbours.fill(reach, &net_gaps[..speeds.len()], speeds, self.contact);
            dispatch(Rows { program, kept: None, neighbours: &neighbours, machine: &mut machine, result });
        }
    }

    fn series<C: Along>(&self, motion: Motion<'_>, memory: &mut series::Memory<C>) {
        let Prepared { program, variables, reach, operations, contact, .. } = self;
        let (reach, operations, contact) = (*reach, *operations, *contact);
        series::Coefficients { program, variables, reach, operations, contact, motion, memory }.write();
    }

    /// How far it looks behind and ahead, in pedestrians.
    pub fn reach(&self) -> (usize, usize) {
        (self.reach.behind, self.reach.ahead)
    }
}

/// Uniform flows per iteration.
const AT_ONCE: usize = 512;

/// Whether speeds occur in no operation but linear ones with constants, so that a steady relaxation of the uniform flow
/// is all that they do.
fn relaxes_only(program: &Program) -> bool {
    let mut depends = vec![false; program.registers];
    let on_speed = |source: program::Source, depends: &[bool]| match source {
        Source::Speed(_) => true,
        Source::Register(register) => depends[register],
        Source::Spacing { .. } => false,
    };
    for Instruction { action, of, into, .. } in &program.instructions {
        let own = !matches!(action, Action::Constant(_)) && on_speed(*of, &depends);
        let other = action.second().is_some_and(|source| on_speed(source, &depends));
        if (own || other) && action.histories() > 0 {
            return false;
        }
        depends[*into] = own || other;
    }
    true
}

/// The force of a formula.
#[derive(Clone, Debug)]
pub struct Interpreted {
    prepared: Arc<Prepared>,
    /// The effective gap, where it is not the net gap.
    gap: Option<Arc<Prepared>>,
    is_singular: bool,
    scratch: RefCell<Scratch>,
}

#[derive(Clone, Debug, Default)]
struct Scratch {
    neighbours: Neighbours,
    machine: Machine,
    reference: Option<(Flow, f64)>,
    kept: Vec<Kept>,
    memory: series::Memory<Lanes<{ series::W }>>,
    /// For series of differences from a uniform flow that changes.
    memory_along: series::Memory<series::WithFlow>,
    /// Whether the series written last are such.
    is_along: bool,
}

impl Interpreted {
    /// The force of this formula, with the formula of the effective gap where that is not the net gap; `is_singular`
    /// says whether it has no value where two touch.
    pub fn new(prepared: Arc<Prepared>, gap: Option<Arc<Prepared>>, is_singular: bool) -> Interpreted {
        let mut scratch = Scratch::default();
        let own = prepared.program.registers;
        scratch.machine.resize(gap.as_ref().map_or(own, |gap| own.max(gap.program.registers)));
        Interpreted { prepared, gap, is_singular, scratch: RefCell::new(scratch) }
    }
}

impl Force for Interpreted {
    fn contact(&self) -> f64 {
        self.prepared.contact
    }

    fn is_singular(&self) -> bool {
        self.is_singular
    }

    fn accelerations(&self, net_gaps: &[f64], speeds: &[f64], accelerations: &mut [f64]) {
        let Scratch { neighbours, machine, .. } = &mut *self.scratch.borrow_mut();
        let Prepared { program, reach, contact, .. } = &*self.prepared;
        neighbours.fill(*reach, net_gaps, speeds, *contact);
        dispatch(Rows { program, kept: None, neighbours, machine, result: accelerations });
    }

    fn deviations(&self, flow: Flow, spacings: &[f64], speeds: &[f64], accelerations: &mut [f64]) -> f64 {
        let Scratch { neighbours, machine, reference, kept, .. } = &mut *self.scratch.borrow_mut();
        let Prepared { program, reach, contact, .. } = &*self.prepared;
        let uniform = match *reference {
            Some((known, acceleration)) if known == flow => acceleration,
            _ => keep(program, flow, *contact, kept),
        };
        *reference = Some((flow, uniform));
        neighbours.fill(*reach, spacings, speeds, 0.0);
        dispatch(Rows { program, kept: Some(kept), neighbours, machine, result: accelerations });
        uniform
    }

    fn effective_gaps(&self, net_gaps: &[f64], speeds: &[f64], gaps: &mut [f64]) {
        let Some(prepared) = &self.gap else { return gaps.copy_from_slice(net_gaps) };
        let Scratch { neighbours, machine, .. } = &mut *self.scratch.borrow_mut();
        let Prepared { program, reach, contact, .. } = &**prepared;
        neighbours.fill(*reach, net_gaps, speeds, *contact);
        dispatch(Rows { program, kept: None, neighbours, machine, result: gaps });
    }

    fn effective_gap_rates(&self, now: super::Rows<'_>, rates: super::Rows<'_>, gap_rates: &mut [f64]) {
        let Some(prepared) = &self.gap else { return gap_rates.copy_from_slice(rates.spacings) };
        let (contact, count) = (prepared.contact, gap_rates.len() as i64);
        for (n, rate) in (0..).zip(gap_rates) {
            let at = |j: i32| (n + i64::from(j)).rem_euclid(count) as usize;
            *rate = prepared
                .program
                .carry_out(|source| match source {
                    Source::Spacing { j, net } => {
                        let more = if net { 0.0 } else { contact };
                        Dual { value: now.spacings[at(j)] + more, slope: rates.spacings[at(j)] }
                    }
                    Source::Speed(j) => Dual { value: now.speeds[at(j)], slope: rates.speeds[at(j)] },
                    Source::Register(_) => Dual::constant(0.0),
                })
                .slope;
        }
    }

    fn is_open(&self, flow: Flow, spacings: &[f64], speeds: &[f64]) -> bool {
        if !self.is_singular {
            return true;
        }
        let net_gaps: Vec<f64> = spacings.iter().map(|spacing| flow.net_gap + spacing).collect();
        let speeds: Vec<f64> = speeds.iter().map(|speed| flow.speed + speed).collect();
        let mut gaps = vec![0.0; net_gaps.len()];
        self.effective_gaps(&net_gaps, &speeds, &mut gaps);
        gaps.iter().all(|gap| *gap > 0.0)
    }

    fn uses_speeds(&self) -> bool {
        self.prepared.uses_speeds
    }

    fn relaxation(&self, flow: Flow) -> f64 {
        let Prepared { program, contact, .. } = &*self.prepared;
        let along = |source| match source {
            Source::Spacing { net, .. } => Dual::constant(flow.net_gap + if net { 0.0 } else { *contact }),
            Source::Speed(_) | Source::Register(_) => Dual::variable(flow.speed),
        };
        program.carry_out(along).slope
    }

    fn dependence(&self) -> Dependence {
        let is_near = |source: &Source| match *source {
            Source::Spacing { j, .. } => j == 0,
            Source::Speed(j) => j == 0 || j == 1,
            Source::Register(_) => true,
        };
        if self.prepared.variables.iter().all(is_near) { Dependence::Speeds } else { Dependence::Unknown }
    }

    fn slopes(&self, flow: Flow, now: super::Rows<'_>, slopes: &mut [f64]) {
        let (n, Prepared { program, contact, .. }) = (now.spacings.len(), &*self.prepared);
        for own in 0..slopes.len() / 3 {
            let variable = |which: usize, value: f64| Dual { value, slope: Gradient::<3>::of(which) };
            let Gradient(gradient) = program
                .carry_out(|source| match source {
                    Source::Spacing { net, .. } => {
                        variable(0, flow.net_gap + now.spacings[own] + if net { 0.0 } else { *contact })
                    }
                    Source::Speed(1) => variable(2, flow.speed + now.speeds[(own + 1) % n]),
                    Source::Speed(_) | Source::Register(_) => variable(1, flow.speed + now.speeds[own]),
                })
                .slope;
            for (row, slope) in gradient.into_iter().enumerate() {
                slopes[row * n + own] = slope;
            }
        }
    }

    fn series(&self, motion: Motion<'_>) {
        let Scratch { memory, memory_along, is_along, .. } = &mut *self.scratch.borrow_mut();
        *is_along = motion.along.is_some();
        match motion.along {
            None => self.prepared.series(motion, memory),
            Some(_) => self.prepared.series(motion, memory_along),
        }
    }

    fn kinks(&self) -> usize {
        self.prepared.kinks.len()
    }

    fn has_unsuited_kinks(&self) -> bool {
        let program = &self.prepared.program;
        program.has_soft_kinks() || program.has_roots_of_kinks()
    }

    fn kink_arguments(&self, pedestrians: usize, order: usize, arguments: &mut [f64]) {
        let Scratch { memory, memory_along, is_along, .. } = &*self.scratch.borrow();
        let kinks = &self.prepared.kinks;
        if *is_along {
            memory_along.arguments(kinks, pedestrians, order, arguments);
        } else {
            memory.arguments(kinks, pedestrians, order, arguments);
        }
    }

    fn heun(&self, _steps: Steps, _cut: Option<Cut>, _state: &mut [f64]) -> Batch {
        Batch::Unsupported
    }
}

/// Writes what each instruction keeps of a uniform flow, and returns the acceleration there.
fn keep(program: &Program, flow: Flow, contact: f64, kept: &mut Vec<Kept>) -> f64 {
    let mut registers = vec![0.0; program.registers];
    let variable = |source: Source, registers: &[f64]| match source {
        Source::Spacing { net, .. } => flow.net_gap + if net { 0.0 } else { contact },
        Source::Speed(_) => flow.speed,
        Source::Register(register) => registers[register],
    };
    kept.clear();
    for Instruction { action, of, into, .. } in &program.instructions {
        let x = variable(*of, &registers);
        let y = action.second().map_or(0.0, |source| variable(source, &registers));
        kept.push(kept_of(*action, x, y));
        let value = action.act(x, |source| variable(source, &registers));
        registers[*into] = value;
    }
    variable(program.result, &registers)
}

fn kept_of(action: Action, x: f64, y: f64) -> Kept {
    match action {
        Action::Recip => Kept::of_recip(x),
        Action::Whole(n) => Kept::of_whole_power(x, n),
        Action::Power(q) => Kept::of_power(x, q),
        Action::Mul(_) => Kept::of_product(x, y),
        Action::Div(_) => Kept::of_quotient(x, y),
        Action::Min(_) | Action::Max(_) => Kept::of_pair(x, y),
        Action::Unary(unary) => match unary {
            Unary::Neg => Kept::default(),
            Unary::Exp | Unary::ExpM1 => Kept::of_exp(x),
            Unary::Ln => Kept::of_ln(x),
            Unary::Ln1p => Kept::of_ln_1p(x),
            Unary::Sqrt => Kept::of_sqrt(x),
            Unary::Tanh => Kept::of_tanh(x),
            Unary::Softplus => Kept::of_softplus(x),
            Unary::Abs => Kept::of_abs(x),
        },
        _ => Kept::default(),
    }
}
