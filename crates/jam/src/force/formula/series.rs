//! Executes a program for the coefficients of a series: order by order and instruction by instruction, each a loop over
//! blocks of pedestrians.

use super::program::{Action, Program, Source};
use super::rows::{Neighbours, Reach};
use crate::force::{Flow, Motion, NOTHING};
use formula::Unary;
use math::change::Changed;
use math::lanes::Lanes;
use math::series::recurrences::{self as next, History};
use math::series::{Block, Coefficient, memory};
use math::simd::{Kernel, Width, dispatch, dispatch_to_four};

/// The most pedestrians of a block.
pub const W: usize = 16;

/// Coefficients of a block of pedestrians: as they are, or that of the uniform flow with the differences from it.
pub trait Along: Coefficient {
    /// Pedestrians of a block.
    const WIDTH: usize;

    /// From the coefficient of the uniform flow and the differences from it.
    fn of(flow: f64, differences: &[f64]) -> Self;

    /// The coefficient of the uniform flow, if there is one, and the differences from it.
    fn parts(&self) -> (f64, &[f64]);

    /// Runs a kernel on registers of a width that is worth it.
    fn dispatch(kernel: impl Kernel<Output = ()>);
}

impl Along for Lanes<W> {
    const WIDTH: usize = W;

    #[inline(always)]
    fn of(flow: f64, differences: &[f64]) -> Self {
        Lanes::of(differences) + flow
    }

    #[inline(always)]
    fn parts(&self) -> (f64, &[f64]) {
        (0.0, &self.0)
    }

    fn dispatch(kernel: impl Kernel<Output = ()>) {
        dispatch(kernel);
    }
}

/// Narrower: each operation is several.
pub type WithFlow = Changed<8>;

impl Along for WithFlow {
    const WIDTH: usize = 8;

    #[inline(always)]
    fn of(flow: f64, differences: &[f64]) -> Self {
        Changed { value: flow, change: Lanes::of(differences) }
    }

    #[inline(always)]
    fn parts(&self) -> (f64, &[f64]) {
        (self.value, &self.change.0)
    }

    // a uniform flow is soon steady: not worth another copy
    fn dispatch(kernel: impl Kernel<Output = ()>) {
        dispatch_to_four(Width::Four, kernel);
    }
}

/// Memory that is kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Memory<C: Copy> {
    /// What the operations keep: for each of them, for each block, its [`memory`].
    histories: Vec<Block<C>>,
    /// One order, for each block.
    registers: Vec<Vec<C>>,
    variables: Vec<Vec<C>>,
    neighbours: Neighbours,
}

impl<C: Along> Memory<C> {
    /// Writes the arguments of the operations with kinks, which begin at these histories: `order` rows, in each for
    /// each of them one number for each pedestrian.
    pub fn arguments(&self, kinks: &[usize], pedestrians: usize, order: usize, arguments: &mut [f64]) {
        let (blocks, count) = (pedestrians.div_ceil(C::WIDTH), kinks.len() * pedestrians);
        let histories = Histories { memory: &self.histories, blocks, length: order, order: 0 };
        for (kink, &operation) in kinks.iter().enumerate() {
            let histories = histories.of(operation);
            for block in 0..blocks {
                let from = block * C::WIDTH;
                let own = kink * pedestrians + from;
                let size = C::WIDTH.min(pedestrians - from);
                for (row, coefficient) in arguments.chunks_exact_mut(count).zip(histories.block(block).argument()) {
                    let (flow, differences) = coefficient.parts();
                    for (to, difference) in row[own..own + size].iter_mut().zip(differences) {
                        *to = flow + difference;
                    }
                }
            }
        }
    }
}

/// The coefficients of a motion under a program.
pub struct Coefficients<'a, 'b, C: Copy> {
    /// The program.
    pub program: &'a Program,
    /// Its variables.
    pub variables: &'a [Source],
    /// How far it looks.
    pub reach: Reach,
    /// How many operations keep something, products of whole powers counted one by one.
    pub operations: usize,
    /// What is to be added to a net gap for a spacing.
    pub contact: f64,
    /// What is known of the motion, and where the rest goes.
    pub motion: Motion<'b>,
    /// Memory.
    pub memory: &'a mut Memory<C>,
}

impl<C: Along> Coefficients<'_, '_, C> {
    /// Writes them.
    pub fn write(mut self) {
        let Motion { pedestrians: n, order, unit, dimension, along, .. } = self.motion;
        let blocks = n.div_ceil(C::WIDTH);
        self.reserve(blocks);
        self.take::<true>(0);
        self.order::<true>(0, blocks);
        for k in 1..order {
            self.take::<false>(k);
            self.order::<false>(k, blocks);
            let result = match self.program.result {
                Source::Register(register) => &self.memory.registers[register],
                variable => &self.memory.variables[place(self.variables, variable)],
            };
            let share = unit / (k + 1) as f64;
            let (rows, next) = self.motion.coefficients.split_at_mut((k + 1) * dimension);
            let speeds = &rows[k * dimension + n..k * dimension + 2 * n];
            for (to, result) in next[n..2 * n].chunks_mut(C::WIDTH).zip(result) {
                let (_, accelerations) = result.parts();
                for (to, acceleration) in to.iter_mut().zip(accelerations) {
                    *to = acceleration * share;
                }
            }
            if let Some(speed) = along {
                next[speed] = result[0].parts().0 * share;
            }
            for (to, pair) in next.iter_mut().zip(speeds.windows(2)) {
                *to = (pair[1] - pair[0]) * share;
            }
            next[n - 1] = (speeds[0] - speeds[n - 1]) * share;
        }
    }
}

/// Where a variable stands.
fn place(variables: &[Source], variable: Source) -> usize {
    variables.iter().position(|own| *own == variable).unwrap_or(0)
}

impl<C: Along> Coefficients<'_, '_, C> {
    /// Makes room.
    fn reserve(&mut self, blocks: usize) {
        let needed = self.operations * blocks * memory(self.motion.order);
        let Memory { histories, registers, variables, .. } = &mut *self.memory;
        if histories.len() < needed {
            histories.resize(needed, Block::default());
        }
        for (rows, count) in [(registers, self.program.registers), (variables, self.variables.len())] {
            rows.resize(count, Vec::new());
            rows.iter_mut().for_each(|row| row.resize(blocks, C::default()));
        }
    }

    /// Takes the variables of an order: at order 0 with the uniform flow, whose speed may have coefficients of other
    /// orders.
    fn take<const START: bool>(&mut self, k: usize) {
        let Motion { flow, pedestrians: n, dimension, along, .. } = self.motion;
        let row = &self.motion.coefficients[k * dimension..(k + 1) * dimension];
        let Memory { variables, neighbours, .. } = &mut *self.memory;
        neighbours.fill(Reach { spacings: false, ..self.reach }, &row[..n], &row[n..2 * n], 0.0);
        let flow = match along {
            _ if START => flow,
            Some(speed) => Flow { speed: row[speed], ..NOTHING },
            None => NOTHING,
        };
        for (variable, blocks) in self.variables.iter().zip(variables) {
            let (source, flow, more) = match *variable {
                Source::Spacing { j, net } => {
                    let more = if net || !START { NOTHING.net_gap } else { self.contact };
                    (Source::Spacing { j, net: true }, flow.net_gap, more)
                }
                other => (other, flow.speed, NOTHING.speed),
            };
            let row = neighbours.row(source, 0, blocks.len() * C::WIDTH);
            for (block, lanes) in blocks.iter_mut().zip(row.chunks_exact(C::WIDTH)) {
                *block = C::of(flow, lanes) + more;
            }
        }
    }

    /// Carries the program out for an order.
    fn order<const START: bool>(&mut self, k: usize, blocks: usize) {
        let Memory { histories, registers, variables, .. } = &mut *self.memory;
        let histories = Histories { memory: histories, blocks, length: self.motion.order, order: k };
        let mut used = 0;
        for instruction in &self.program.instructions {
            // beyond order 0 a constant adds nothing
            if let (Action::AddConstant(_), Some(spent), false) = (instruction.action, instruction.spent, START) {
                registers.swap(instruction.into, spent);
                continue;
            }
            let mut row = std::mem::take(&mut registers[instruction.into]);
            let second = instruction.action.second();
            // the result replaces the first operand: that itself if nobody needs it any more, else a copy
            let is_spent = match instruction.spent {
                Some(spent) if second != Some(instruction.of) => {
                    std::mem::swap(&mut row, &mut registers[spent]);
                    true
                }
                _ => false,
            };
            let get = |source: Source| match source {
                Source::Register(register) => &registers[register][..],
                variable => &variables[place(self.variables, variable)][..],
            };
            let y = get(second.unwrap_or(instruction.of));
            if !is_spent {
                row.copy_from_slice(get(instruction.of));
            }
            used += Next { histories: histories.of(used), row: &mut row, y }.act::<START>(instruction.action);
            registers[instruction.into] = row;
        }
    }
}

/// The histories of operations.
struct Histories<'a, C: Copy> {
    memory: &'a [Block<C>],
    blocks: usize,
    length: usize,
    order: usize,
}

impl<'a, C: Coefficient> Histories<'a, C> {
    /// Those of the operation with this number and the ones behind it.
    #[inline(always)]
    fn of(&self, operation: usize) -> Histories<'a, C> {
        Histories { memory: &self.memory[operation * self.blocks * memory(self.length)..], ..*self }
    }

    /// The history of a block.
    #[inline(always)]
    fn block(&self, block: usize) -> History<'a, C> {
        let size = memory(self.length);
        History::new(&self.memory[block * size..(block + 1) * size], self.length, self.order)
    }
}

/// One instruction for an order: the operands, the first of which the result replaces.
struct Next<'a, C: Copy> {
    histories: Histories<'a, C>,
    row: &'a mut [C],
    y: &'a [C],
}

impl<C: Along> Next<'_, C> {
    /// Carries it out; returns how many histories it used.
    fn act<const START: bool>(mut self, action: Action) -> usize {
        match action {
            Action::Constant(_)
            | Action::AddConstant(_)
            | Action::MulConstant(_)
            | Action::DivConstant(_)
            | Action::Add(_)
            | Action::Sub(_)
            | Action::Unary(Unary::Neg) => {
                dispatch_to_four(Width::Four, Linear { action, is_start: START, row: self.row, y: self.y });
            }
            Action::Mul(_) => self.step::<START>(Product),
            Action::Div(_) => self.step::<START>(Quotient),
            Action::Min(_) => self.step::<START>(Min),
            Action::Max(_) => self.step::<START>(Max),
            Action::Recip => self.step::<START>(Recip),
            Action::Power(q) => self.step::<START>(Power(q)),
            Action::Whole(n) if n < 0 => self.step::<START>(WholePower(n)),
            Action::Whole(n) => {
                // products, because the number may pass through 0
                let x = self.row.to_vec();
                for factor in 1..n as usize {
                    Next { histories: self.histories.of(factor - 1), row: self.row, y: &x }.step::<START>(Product);
                }
            }
            Action::Unary(Unary::Exp) => self.step::<START>(Exp),
            Action::Unary(Unary::ExpM1) => self.step::<START>(ExpM1),
            Action::Unary(Unary::Ln) => self.step::<START>(Ln),
            Action::Unary(Unary::Ln1p) => self.step::<START>(Ln1p),
            Action::Unary(Unary::Sqrt) => self.step::<START>(Sqrt),
            Action::Unary(Unary::Tanh) => self.step::<START>(Tanh),
            Action::Unary(Unary::Softplus) => self.step::<START>(Softplus),
            Action::Unary(Unary::Abs) => self.step::<START>(Abs),
        }
        action.histories()
    }

    /// An operation that is not linear.
    fn step<const START: bool>(&mut self, recurrence: impl Recurrence<C>) {
        let Next { histories, row, y } = self;
        C::dispatch(Each::<_, _, START> { recurrence, histories: histories.of(0), row, y });
    }
}

/// The recurrence of an operation. A type, because each is a kernel of its own: one kernel of all took the compiler
/// four times as long.
trait Recurrence<C: Coefficient> {
    /// The coefficient of this order from those of the operands.
    fn next<const START: bool>(&self, history: History<'_, C>, x: C, y: C) -> C;
}

/// Recurrences of functions of one number.
macro_rules! of_one {
    ($($name:ident $next:ident)*) => {
        $(
            struct $name;

            impl<C: Coefficient> Recurrence<C> for $name {
                #[inline(always)]
                fn next<const START: bool>(&self, history: History<'_, C>, x: C, _y: C) -> C {
                    next::$next::<C, START>(history, x)
                }
            }
        )*
    };
}

of_one! {
    Recip recip
    Exp exp
    ExpM1 exp_m1
    Ln ln
    Ln1p ln_1p
    Sqrt sqrt
    Tanh tanh
    Softplus softplus
    Abs abs
}

/// Recurrences of functions of two numbers.
macro_rules! of_two {
    ($($name:ident $next:ident)*) => {
        $(
            struct $name;

            impl<C: Coefficient> Recurrence<C> for $name {
                #[inline(always)]
                fn next<const START: bool>(&self, history: History<'_, C>, x: C, y: C) -> C {
                    next::$next::<C, START>(history, x, y)
                }
            }
        )*
    };
}

of_two! {
    Product product
    Quotient quotient
    Min min
    Max max
}

struct Power(f64);

impl<C: Coefficient> Recurrence<C> for Power {
    #[inline(always)]
    fn next<const START: bool>(&self, history: History<'_, C>, x: C, _y: C) -> C {
        next::power::<C, START>(history, x, self.0)
    }
}

/// With a negative exponent.
struct WholePower(i32);

impl<C: Coefficient> Recurrence<C> for WholePower {
    #[inline(always)]
    fn next<const START: bool>(&self, history: History<'_, C>, x: C, _y: C) -> C {
        next::whole_power::<C, START>(history, x, self.0)
    }
}

/// A recurrence for all blocks.
struct Each<'a, R, C: Copy, const START: bool> {
    recurrence: R,
    histories: Histories<'a, C>,
    row: &'a mut [C],
    y: &'a [C],
}

impl<R: Recurrence<C>, C: Along, const START: bool> Kernel for Each<'_, R, C, START> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Each { recurrence, histories, row, y } = self;
        for (block, (row, y)) in row.iter_mut().zip(y).enumerate() {
            *row = recurrence.next::<START>(histories.block(block), *row, *y);
        }
    }
}

/// An operation that needs no history.
struct Linear<'a, C> {
    action: Action,
    is_start: bool,
    row: &'a mut [C],
    y: &'a [C],
}

impl<C: Along> Kernel for Linear<'_, C> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Linear { action, is_start, row, y } = self;
        match action {
            Action::Constant(c) => row.fill(if is_start { C::default() + c } else { C::default() }),
            Action::AddConstant(c) if is_start => row.iter_mut().for_each(|x| *x = *x + c),
            Action::MulConstant(c) => row.iter_mut().for_each(|x| *x = *x * c),
            Action::DivConstant(c) => row.iter_mut().for_each(|x| *x = *x / c),
            Action::Add(_) => row.iter_mut().zip(y).for_each(|(x, y)| *x = *x + *y),
            Action::Sub(_) => row.iter_mut().zip(y).for_each(|(x, y)| *x = *x - *y),
            Action::Unary(_) => row.iter_mut().for_each(|x| *x = -*x),
            _ => {}
        }
    }
}
