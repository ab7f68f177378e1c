//! Executes a program for the coefficients of a series: order by order and instruction by instruction, each a loop over
//! blocks of pedestrians.

use super::program::{Action, Program, Source};
use super::rows::{Neighbours, Reach};
use crate::force::{Flow, Motion, NOTHING};
use formula::Unary;
use math::change::Changed;
use math::lanes::Lanes;
use math::series::recurrences::{self as next, History};
use math::series::{Block, Coefficient, ROWS};
use math::simd::Kernel;

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
}

/// Memory that is kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Memory<C: Copy> {
    /// What the operations keep: for each of them, for each block, [`ROWS`] rows of coefficients.
    histories: Vec<Block<C>>,
    /// One order, for each block.
    registers: Vec<Vec<C>>,
    variables: Vec<Vec<C>>,
    neighbours: Neighbours,
}

impl<C: Along> Memory<C> {
    /// Writes the arguments of the operations with kinks, which begin at these histories: `order` rows, in each for each of them
    /// one number for each pedestrian.
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

impl<C: Along> Kernel for Coefficients<'_, '_, C> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
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
#[inline(always)]
fn place(variables: &[Source], variable: Source) -> usize {
    variables.iter().position(|own| *own == variable).unwrap_or(0)
}

impl<C: Along> Coefficients<'_, '_, C> {
    /// Makes room.
    fn reserve(&mut self, blocks: usize) {
        let needed = self.operations * blocks * ROWS * self.motion.order;
        let Memory { histories, registers, variables, .. } = &mut *self.memory;
        if histories.len() < needed {
            histories.resize(needed, Block::default());
        }
        for (rows, count) in [(registers, self.program.registers), (variables, self.variables.len())] {
            rows.resize(count, Vec::new());
            rows.iter_mut().for_each(|row| row.resize(blocks, C::default()));
        }
    }

    /// Takes the variables of an order: at order 0 with the uniform flow, whose speed may have coefficients of other orders.
    #[inline(always)]
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
    #[inline(always)]
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
            let mut target = std::mem::take(&mut registers[instruction.into]);
            let get = |source: Source| match source {
                Source::Register(register) => &registers[register][..],
                variable => &variables[place(self.variables, variable)][..],
            };
            let x = get(instruction.of);
            let y = instruction.action.second().map_or(x, get);
            used += next_order::<C, START>(instruction.action, histories.of(used), x, y, &mut target);
            registers[instruction.into] = target;
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
        Histories { memory: &self.memory[operation * self.blocks * ROWS * self.length..], ..*self }
    }

    /// The history of a block.
    #[inline(always)]
    fn block(&self, block: usize) -> History<'a, C> {
        let size = ROWS * self.length;
        History::new(&self.memory[block * size..(block + 1) * size], self.length, self.order)
    }
}

/// A loop over blocks, with their histories where needed.
macro_rules! each {
    ($target:ident, $x:ident => $value:expr) => {
        for (target, $x) in $target.iter_mut().zip($x) {
            let $x = *$x;
            *target = $value;
        }
    };
    ($target:ident, $x:ident, $y:ident => $value:expr) => {
        for ((target, $x), $y) in $target.iter_mut().zip($x).zip($y) {
            let ($x, $y) = (*$x, *$y);
            *target = $value;
        }
    };
    ($target:ident, $histories:ident, $h:ident, $x:ident => $value:expr) => {
        for (block, (target, $x)) in $target.iter_mut().zip($x).enumerate() {
            let ($h, $x) = ($histories.block(block), *$x);
            *target = $value;
        }
    };
    ($target:ident, $histories:ident, $h:ident, $x:ident, $y:ident => $value:expr) => {
        for (block, ((target, $x), $y)) in $target.iter_mut().zip($x).zip($y).enumerate() {
            let ($h, $x, $y) = ($histories.block(block), *$x, *$y);
            *target = $value;
        }
    };
}

/// One instruction; returns how many histories it used.
#[inline(always)]
fn next_order<C: Along, const START: bool>(
    action: Action,
    hs: Histories<'_, C>,
    x: &[C],
    y: &[C],
    row: &mut [C],
) -> usize {
    match action {
        Action::Constant(c) => row.fill(if START { C::default() + c } else { C::default() }),
        Action::AddConstant(c) if START => each!(row, x => x + c),
        Action::AddConstant(_) => row.copy_from_slice(x),
        Action::MulConstant(c) => each!(row, x => x * c),
        Action::DivConstant(c) => each!(row, x => x / c),
        Action::Add(_) => {
            each!(row, x, y => x + y);
        }
        Action::Sub(_) => {
            each!(row, x, y => x - y);
        }
        Action::Mul(_) => each!(row, hs, h, x, y => next::product::<C, START>(h, x, y)),
        Action::Div(_) => each!(row, hs, h, x, y => next::quotient::<C, START>(h, x, y)),
        Action::Min(_) => each!(row, hs, h, x, y => next::min::<C, START>(h, x, y)),
        Action::Max(_) => each!(row, hs, h, x, y => next::max::<C, START>(h, x, y)),
        Action::Recip => each!(row, hs, h, x => next::recip::<C, START>(h, x)),
        Action::Power(q) => each!(row, hs, h, x => next::power::<C, START>(h, x, q)),
        Action::Whole(n) if n < 0 => each!(row, hs, h, x => next::whole_power::<C, START>(h, x, n)),
        Action::Whole(n) => {
            // products, because the number may pass through 0
            row.copy_from_slice(x);
            for factor in 1..n as usize {
                let hs = hs.of(factor - 1);
                for (block, (row, x)) in row.iter_mut().zip(x).enumerate() {
                    *row = next::product::<C, START>(hs.block(block), *row, *x);
                }
            }
        }
        Action::Unary(unary) => match unary {
            Unary::Neg => each!(row, x => -x),
            Unary::Exp => each!(row, hs, h, x => next::exp::<C, START>(h, x)),
            Unary::ExpM1 => each!(row, hs, h, x => next::exp_m1::<C, START>(h, x)),
            Unary::Ln => each!(row, hs, h, x => next::ln::<C, START>(h, x)),
            Unary::Ln1p => each!(row, hs, h, x => next::ln_1p::<C, START>(h, x)),
            Unary::Sqrt => each!(row, hs, h, x => next::sqrt::<C, START>(h, x)),
            Unary::Tanh => each!(row, hs, h, x => next::tanh::<C, START>(h, x)),
            Unary::Softplus => each!(row, hs, h, x => next::softplus::<C, START>(h, x)),
            Unary::Abs => each!(row, hs, h, x => next::abs::<C, START>(h, x)),
        },
    }
    action.histories()
}
