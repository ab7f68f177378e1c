//! Executes a program for the coefficients of a series: order by order and instruction by instruction, each a loop over
//! blocks of pedestrians.

use super::program::{Action, Program, Source};
use super::rows::{Neighbours, Reach};
use crate::force::Motion;
use formula::Unary;
use math::lanes::Lanes;
use math::series::recurrences::{self as next, History};
use math::series::{Block, ROWS};
use math::simd::Kernel;

/// Pedestrians per iteration.
pub const W: usize = 16;

/// A row of a block for each order.
type Blocks = [[f64; W]];

/// Memory that is kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    /// What the operations keep: for each of them, for each block, [`ROWS`] rows of coefficients.
    histories: Vec<Block<W>>,
    registers: Vec<Vec<[f64; W]>>,
    neighbours: Neighbours,
    spacings: Vec<f64>,
    speeds: Vec<f64>,
}

/// The coefficients of a motion under a program.
pub struct Coefficients<'a, 'b> {
    /// The program.
    pub program: &'a Program,
    /// How far it looks.
    pub reach: Reach,
    /// How many operations keep something, products of whole powers counted one by one.
    pub operations: usize,
    /// What is to be added to a net gap for a spacing.
    pub contact: f64,
    /// What is known of the motion, and where the rest goes.
    pub motion: Motion<'b>,
    /// Memory.
    pub memory: &'a mut Memory,
}

impl Kernel for Coefficients<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Coefficients { program, reach, operations, contact, motion, memory } = self;
        let Motion { flow, pedestrians: n, order, unit, dimension, coefficients } = motion;
        let blocks = n.div_ceil(W);
        let Memory { histories, registers, neighbours, spacings, speeds } = memory;
        let needed = operations * blocks * ROWS * order;
        if histories.len() < needed {
            histories.resize(needed, Block::default());
        }
        registers.resize(program.registers, Vec::new());
        registers.iter_mut().for_each(|register| register.resize(blocks, [0.0; W]));
        for k in 0..order {
            let (rows, next) = coefficients.split_at_mut((k + 1) * dimension);
            let row = &rows[k * dimension..];
            let mut carrying = Order { program, registers, histories, length: order, k, blocks };
            if k == 0 {
                // the coefficients of order 0 with the uniform flow; row 1 is given
                spacings.clear();
                spacings.extend(row[..n].iter().map(|spacing| spacing + flow.net_gap));
                speeds.clear();
                speeds.extend(row[n..2 * n].iter().map(|speed| speed + flow.speed));
                neighbours.fill(reach, spacings, speeds, contact);
                carrying.run::<true>(neighbours);
                continue;
            }
            let (spacings, speeds) = (&row[..n], &row[n..2 * n]);
            neighbours.fill(reach, spacings, speeds, 0.0);
            carrying.run::<false>(neighbours);
            let result = match program.result {
                Source::Register(register) => registers[register].as_flattened(),
                variable => neighbours.row(variable, 0, blocks * W),
            };
            let share = unit / (k + 1) as f64;
            for (to, acceleration) in next[n..2 * n].iter_mut().zip(result) {
                *to = acceleration * share;
            }
            for (to, pair) in next.iter_mut().zip(speeds.windows(2)) {
                *to = (pair[1] - pair[0]) * share;
            }
            next[n - 1] = (speeds[0] - speeds[n - 1]) * share;
        }
    }
}

/// One order.
struct Order<'a> {
    program: &'a Program,
    registers: &'a mut Vec<Vec<[f64; W]>>,
    histories: &'a [Block<W>],
    /// Coefficients of a series.
    length: usize,
    /// The order.
    k: usize,
    blocks: usize,
}

impl Order<'_> {
    #[inline(always)]
    fn run<const START: bool>(&mut self, neighbours: &Neighbours) {
        let mut used = 0;
        for instruction in &self.program.instructions {
            // beyond order 0 a constant adds nothing
            if let (Action::AddConstant(_), Some(spent), false) = (instruction.action, instruction.spent, START) {
                self.registers.swap(instruction.into, spent);
                continue;
            }
            let mut target = std::mem::take(&mut self.registers[instruction.into]);
            let registers = &self.registers;
            let size = self.blocks * W;
            let get = |source: Source| match source {
                Source::Register(register) => &registers[register][..],
                variable => neighbours.row(variable, 0, size).as_chunks::<W>().0,
            };
            let x = get(instruction.of);
            let y = instruction.action.second().map_or(x, get);
            let histories =
                Histories { memory: self.histories, blocks: self.blocks, length: self.length, order: self.k };
            used += next_order::<START>(instruction.action, histories.of(used), x, y, &mut target);
            self.registers[instruction.into] = target;
        }
    }
}

/// The histories of operations.
#[derive(Clone, Copy)]
struct Histories<'a> {
    memory: &'a [Block<W>],
    blocks: usize,
    length: usize,
    order: usize,
}

impl<'a> Histories<'a> {
    /// Those of the operation with this number and the ones behind it.
    #[inline(always)]
    fn of(self, operation: usize) -> Histories<'a> {
        Histories { memory: &self.memory[operation * self.blocks * ROWS * self.length..], ..self }
    }

    /// The history of a block.
    #[inline(always)]
    fn block(self, block: usize) -> History<'a, W> {
        let size = ROWS * self.length;
        History::new(&self.memory[block * size..(block + 1) * size], self.length, self.order)
    }
}

/// A loop over pedestrians, or over blocks with their histories.
macro_rules! each {
    ($target:ident, $x:ident => $value:expr) => {
        for (target, $x) in $target.as_flattened_mut().iter_mut().zip($x.as_flattened()) {
            *target = $value;
        }
    };
    ($target:ident, $x:ident, $y:ident => $value:expr) => {
        let pairs = $x.as_flattened().iter().zip($y.as_flattened());
        for (target, ($x, $y)) in $target.as_flattened_mut().iter_mut().zip(pairs) {
            *target = $value;
        }
    };
    ($target:ident, $histories:ident, $h:ident, $x:ident => $value:expr) => {
        for (block, (target, x)) in $target.iter_mut().zip($x).enumerate() {
            let ($h, $x) = ($histories.block(block), Lanes(*x));
            *target = $value.0;
        }
    };
    ($target:ident, $histories:ident, $h:ident, $x:ident, $y:ident => $value:expr) => {
        for (block, ((target, x), y)) in $target.iter_mut().zip($x).zip($y).enumerate() {
            let ($h, $x, $y) = ($histories.block(block), Lanes(*x), Lanes(*y));
            *target = $value.0;
        }
    };
}

/// One instruction; returns how many histories it used.
#[inline(always)]
fn next_order<const START: bool>(action: Action, hs: Histories<'_>, x: &Blocks, y: &Blocks, row: &mut Blocks) -> usize {
    let constant = |c: f64| if START { c } else { 0.0 };
    match action {
        Action::Constant(c) => row.fill([constant(c); W]),
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
        Action::Mul(_) => each!(row, hs, h, x, y => next::product::<W, START>(h, x, y)),
        Action::Div(_) => each!(row, hs, h, x, y => next::quotient::<W, START>(h, x, y)),
        Action::Min(_) => each!(row, hs, h, x, y => next::min::<W, START>(h, x, y)),
        Action::Max(_) => each!(row, hs, h, x, y => next::max::<W, START>(h, x, y)),
        Action::Recip => each!(row, hs, h, x => next::recip::<W, START>(h, x)),
        Action::Power(q) => each!(row, hs, h, x => next::power::<W, START>(h, x, q)),
        Action::Whole(n) if n < 0 => each!(row, hs, h, x => next::whole_power::<W, START>(h, x, n)),
        Action::Whole(n) => {
            // products, because the number may pass through 0
            row.copy_from_slice(x);
            for factor in 1..n as usize {
                let hs = hs.of(factor - 1);
                for (block, (row, x)) in row.iter_mut().zip(x).enumerate() {
                    *row = next::product::<W, START>(hs.block(block), Lanes(*row), Lanes(*x)).0;
                }
            }
        }
        Action::Unary(unary) => match unary {
            Unary::Neg => each!(row, x => -x),
            Unary::Exp => each!(row, hs, h, x => next::exp::<W, START>(h, x)),
            Unary::ExpM1 => each!(row, hs, h, x => next::exp_m1::<W, START>(h, x)),
            Unary::Ln => each!(row, hs, h, x => next::ln::<W, START>(h, x)),
            Unary::Ln1p => each!(row, hs, h, x => next::ln_1p::<W, START>(h, x)),
            Unary::Sqrt => each!(row, hs, h, x => next::sqrt::<W, START>(h, x)),
            Unary::Tanh => each!(row, hs, h, x => next::tanh::<W, START>(h, x)),
            Unary::Softplus => each!(row, hs, h, x => next::softplus::<W, START>(h, x)),
            Unary::Abs => each!(row, hs, h, x => next::abs::<W, START>(h, x)),
        },
    }
    action.histories()
}
