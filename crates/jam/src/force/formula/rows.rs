//! Executes a program for a row of pedestrians: each instruction is a short loop.

use super::program::{Action, Program, Source};
use formula::Unary;
use math::change::rules::{self, Kept};
use math::number::Number;
use math::row::{self, LANES, LENGTH, Scratch};
use math::simd::Kernel;

/// Spacings and speeds of a ring, with those of the neighbours that a formula looks at before the first and behind the
/// last pedestrian, so that a neighbour is a fixed number of places away.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    /// Places before the first pedestrian.
    behind: usize,
    net_gaps: Vec<f64>,
    /// Filled only where a formula asks for them.
    spacings: Vec<f64>,
    speeds: Vec<f64>,
}

/// How far a program looks, and whether it asks for whole spacings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reach {
    /// Places behind.
    pub behind: usize,
    /// Places ahead.
    pub ahead: usize,
    /// Whether it asks for spacings that are not net gaps.
    pub spacings: bool,
}

impl Reach {
    /// The reach of a program.
    pub fn of(program: &Program) -> Reach {
        let mut reach = Reach::default();
        for source in program.variables() {
            let j = match source {
                Source::Spacing { j, net } => {
                    reach.spacings |= !net;
                    j
                }
                Source::Speed(j) => j,
                Source::Register(_) => 0,
            };
            let distance = j.unsigned_abs() as usize;
            let side = if j < 0 { &mut reach.behind } else { &mut reach.ahead };
            *side = distance.max(*side);
        }
        reach
    }
}

impl Neighbours {
    /// Takes the ring; whole spacings are `contact` more than net gaps.
    pub fn fill(&mut self, reach: Reach, net_gaps: &[f64], speeds: &[f64], contact: f64) {
        self.behind = reach.behind;
        extend(reach, net_gaps, &mut self.net_gaps);
        extend(reach, speeds, &mut self.speeds);
        if reach.spacings {
            self.spacings.clear();
            self.spacings.extend(self.net_gaps.iter().map(|gap| gap + contact));
        }
    }

    /// A variable of the pedestrians `begin ..`.
    #[inline(always)]
    pub fn row(&self, source: Source, begin: usize, size: usize) -> &[f64] {
        let (row, j) = match source {
            Source::Spacing { j, net: true } => (&self.net_gaps, j),
            Source::Spacing { j, net: false } => (&self.spacings, j),
            Source::Speed(j) => (&self.speeds, j),
            Source::Register(_) => return &[],
        };
        let from = (self.behind + begin).wrapping_add_signed(j as isize);
        &row[from..from + size]
    }
}

/// The whole ring followed by the first `reach` pedestrians again, filled up to whole blocks. The reach is at most the
/// size of the ring.
fn extend(reach: Reach, ring: &[f64], row: &mut Vec<f64>) {
    let n = ring.len();
    row.clear();
    row.extend_from_slice(&ring[n - reach.behind..]);
    row.extend_from_slice(ring);
    let mut after = n.next_multiple_of(super::series::W) - n + reach.ahead;
    while after > 0 {
        let part = after.min(n);
        row.extend_from_slice(&ring[..part]);
        after -= part;
    }
}

/// The registers.
#[derive(Clone, Debug, Default)]
pub struct Machine {
    registers: Vec<Vec<f64>>,
    room: Scratch,
}

impl Machine {
    /// With the given number of registers.
    pub fn resize(&mut self, registers: usize) {
        self.registers.resize(registers, vec![0.0; LENGTH]);
    }
}

/// A program to be carried out.
pub struct Rows<'a> {
    /// The program.
    pub program: &'a Program,
    /// For changes from a uniform flow, what each instruction keeps of it.
    pub kept: Option<&'a [Kept]>,
    /// The variables.
    pub neighbours: &'a Neighbours,
    /// The registers.
    pub machine: &'a mut Machine,
    /// One number for each pedestrian.
    pub result: &'a mut [f64],
}

impl Kernel for Rows<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Rows { program, kept, neighbours, machine, result } = self;
        for (chunk, result) in result.chunks_mut(LENGTH).enumerate() {
            let (begin, size) = (chunk * LENGTH, result.len().next_multiple_of(LANES));
            for (index, instruction) in program.instructions.iter().enumerate() {
                let mut target = std::mem::take(&mut machine.registers[instruction.into]);
                let registers = &machine.registers;
                let get = |source: Source| match source {
                    Source::Register(register) => &registers[register][..size],
                    variable => neighbours.row(variable, begin, size),
                };
                let (x, row) = (get(instruction.of), &mut target[..size]);
                let second = instruction.action.second().map_or(x, get);
                match kept {
                    None => values(instruction.action, x, second, row, &mut machine.room),
                    Some(kept) => changes(instruction.action, &kept[index], x, second, row, &mut machine.room),
                }
                machine.registers[instruction.into] = target;
            }
            let own = match program.result {
                Source::Register(register) => &machine.registers[register][..size],
                variable => neighbours.row(variable, begin, size),
            };
            result.copy_from_slice(&own[..result.len()]);
        }
    }
}

/// A loop over a row: an expression of the element of one row, or of two.
macro_rules! each {
    ($row:ident, $x:ident => $value:expr) => {
        for (target, $x) in $row.iter_mut().zip($x) {
            let $x = *$x;
            *target = $value;
        }
    };
    ($row:ident, $x:ident, $y:ident => $value:expr) => {
        for ((target, $x), $y) in $row.iter_mut().zip($x).zip($y) {
            let ($x, $y) = (*$x, *$y);
            *target = $value;
        }
    };
}

/// One instruction on values.
#[inline(always)]
fn values(action: Action, x: &[f64], y: &[f64], row: &mut [f64], room: &mut Scratch) {
    match action {
        Action::Constant(c) => row.fill(c),
        Action::AddConstant(c) => each!(row, x => x + c),
        Action::MulConstant(c) => each!(row, x => x * c),
        Action::DivConstant(c) => each!(row, x => x / c),
        Action::Unary(Unary::Neg) => each!(row, x => -x),
        Action::Recip => each!(row, x => 1.0 / x),
        Action::Whole(2) => each!(row, x => x * x),
        Action::Whole(3) => each!(row, x => x * x * x),
        Action::Whole(-2) => each!(row, x => 1.0 / (x * x)),
        Action::Whole(-3) => each!(row, x => 1.0 / (x * x * x)),
        Action::Whole(n) => each!(row, x => Number::powi(x, n)),
        Action::Power(q) => each!(row, x => math::lane::pow(x, q)),
        Action::Add(_) => each!(row, x, y => x + y),
        Action::Sub(_) => each!(row, x, y => x - y),
        Action::Mul(_) => each!(row, x, y => x * y),
        Action::Div(_) => each!(row, x, y => x / y),
        Action::Min(_) => each!(row, x, y => Number::min(x, y)),
        Action::Max(_) => each!(row, x, y => Number::max(x, y)),
        Action::Unary(Unary::Sqrt) => each!(row, x => x.sqrt()),
        Action::Unary(Unary::Abs) => each!(row, x => x.abs()),
        Action::Unary(Unary::Ln) => each!(row, x => math::lane::ln(x)),
        Action::Unary(unary) => {
            row.copy_from_slice(x);
            match unary {
                Unary::Exp => row::exp(row, room),
                Unary::ExpM1 => row::exp_m1(row, room),
                Unary::Ln1p => row::ln_1p(row, room),
                Unary::Tanh => row::tanh(row, room),
                _ => row::softplus(row, room),
            }
        }
    }
}

/// One instruction on changes from what it kept.
#[inline(always)]
fn changes(action: Action, kept: &Kept, x: &[f64], y: &[f64], row: &mut [f64], room: &mut Scratch) {
    let kept = *kept;
    match action {
        Action::Constant(_) => row.fill(0.0),
        Action::AddConstant(_) => row.copy_from_slice(x),
        Action::MulConstant(c) => each!(row, x => x * c),
        Action::DivConstant(c) => {
            let inverse = 1.0 / c;
            each!(row, x => x * inverse);
        }
        Action::Unary(Unary::Neg) => each!(row, x => -x),
        Action::Recip => each!(row, x => rules::recip(&kept, x)),
        Action::Whole(-3) => each!(row, x => rules::whole_power(&kept, x, -3)),
        Action::Whole(-2) => each!(row, x => rules::whole_power(&kept, x, -2)),
        Action::Whole(2) => each!(row, x => rules::whole_power(&kept, x, 2)),
        Action::Whole(3) => each!(row, x => rules::whole_power(&kept, x, 3)),
        Action::Whole(n) => each!(row, x => rules::whole_power(&kept, x, n)),
        Action::Power(q) => each!(row, x => rules::power(&kept, x, q)),
        Action::Add(_) => each!(row, x, y => x + y),
        Action::Sub(_) => each!(row, x, y => x - y),
        Action::Mul(_) => each!(row, x, y => rules::product(&kept, x, y)),
        Action::Div(_) => each!(row, x, y => rules::quotient(&kept, x, y)),
        Action::Min(_) => each!(row, x, y => rules::min(&kept, x, y)),
        Action::Max(_) => each!(row, x, y => rules::max(&kept, x, y)),
        Action::Unary(Unary::Sqrt) => each!(row, x => rules::sqrt(&kept, x)),
        Action::Unary(Unary::Abs) => each!(row, x => rules::abs(&kept, x)),
        Action::Unary(Unary::Tanh) => each!(row, x => rules::tanh(&kept, x)),
        Action::Unary(Unary::Exp | Unary::ExpM1) if rules::is_faint(&kept) => {
            each!(row, x => rules::faint_exp(&kept, x));
        }
        Action::Unary(Unary::Exp | Unary::ExpM1) => {
            row.copy_from_slice(x);
            row::exp_m1(row, room);
            row.iter_mut().for_each(|x| *x = rules::scale(&kept, *x));
        }
        Action::Unary(Unary::Ln | Unary::Ln1p) => {
            each!(row, x => rules::scale(&kept, x));
            row::ln_1p(row, room);
        }
        Action::Unary(Unary::Softplus) => {
            row.copy_from_slice(x);
            row::softplus_difference(rules::softplus_base(&kept), row, room);
        }
    }
}
