//! A program carried out for the coefficients of a series, order by order.

use super::program::{Program, Source};
use crate::force::Motion;
use math::lanes::Lanes;
use math::series::{Jet, Place, ROWS};
use math::simd::Kernel;
use std::cell::Cell;

/// So many pedestrians at a time.
const W: usize = 16;

/// Memory that is kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    /// What the operations keep, one block of pedestrians after another.
    histories: Vec<Cell<[f64; W]>>,
    registers: Vec<[f64; W]>,
    spacings: Vec<f64>,
    speeds: Vec<f64>,
}

/// The coefficients of a motion under a program.
pub struct Coefficients<'a, 'b> {
    /// The program.
    pub program: &'a Program,
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
        let Coefficients { program, operations, contact, motion, memory } = self;
        let Motion { flow, pedestrians: n, order, unit, dimension, coefficients } = motion;
        let size = operations * ROWS * order;
        let Memory { histories, registers, spacings, speeds } = memory;
        histories.resize(n.div_ceil(W) * size, Cell::new([0.0; W]));
        registers.resize(program.registers, [0.0; W]);
        for k in 0..order {
            let (rows, next) = coefficients.split_at_mut((k + 1) * dimension);
            let row = &rows[k * dimension..];
            // the coefficients of this order, those of order 0 with the uniform flow
            let add = |value: f64, flow: f64| if k == 0 { value + flow } else { value };
            spacings.clear();
            spacings.extend(row[..n].iter().map(|spacing| add(*spacing, flow.net_gap)));
            speeds.clear();
            speeds.extend(row[n..2 * n].iter().map(|speed| add(*speed, flow.speed)));
            let share = unit / (k + 1) as f64;
            for block in 0..n.div_ceil(W) {
                let place = Place::new(&histories[block * size..(block + 1) * size], order, k);
                let variable = |source: Source| Lanes(gather(source, spacings, speeds, block * W, contact, k));
                let value = if k == 0 {
                    carry_out::<true>(program, registers, &place, variable)
                } else {
                    carry_out::<false>(program, registers, &place, variable)
                };
                let from = block * W;
                // row 1 is given
                if k > 0 {
                    let to = &mut next[n + from..n + n.min(from + W)];
                    to.iter_mut().zip((value * share).0).for_each(|(to, value)| *to = value);
                }
            }
            if k > 0 {
                for i in 0..n {
                    next[i] = (speeds[if i + 1 == n { 0 } else { i + 1 }] - speeds[i]) * share;
                }
            }
        }
    }
}

/// One order of one block.
#[inline(always)]
fn carry_out<const START: bool>(
    program: &Program,
    registers: &mut [[f64; W]],
    place: &Place<'_, W>,
    variable: impl Fn(Source) -> Lanes<W>,
) -> Lanes<W> {
    for instruction in &program.instructions {
        let value = {
            let get = |source: Source| match source {
                Source::Register(register) => place.variable::<START>(Lanes(registers[register])),
                other => place.variable(variable(other)),
            };
            let of: Jet<'_, W, START> = get(instruction.of);
            instruction.action.act(of, get).coefficient()
        };
        registers[instruction.into] = value.0;
    }
    match program.result {
        Source::Register(register) => Lanes(registers[register]),
        other => variable(other),
    }
}

/// A variable of a block; behind the last pedestrian, the first again.
#[inline(always)]
fn gather(source: Source, spacings: &[f64], speeds: &[f64], from: usize, contact: f64, order: usize) -> [f64; W] {
    let n = spacings.len();
    let (row, j, more) = match source {
        Source::Spacing { j, net } => (spacings, j, if net || order > 0 { 0.0 } else { contact }),
        Source::Speed(j) => (speeds, j, 0.0),
        Source::Register(_) => return [0.0; W],
    };
    let first = from as isize + j as isize;
    let mut block = [0.0; W];
    if first >= 0 && first as usize + W <= n {
        block.copy_from_slice(&row[first as usize..first as usize + W]);
    } else {
        for (lane, value) in block.iter_mut().enumerate() {
            *value = row[(first + lane as isize).rem_euclid(n as isize) as usize];
        }
    }
    if more != 0.0 {
        block.iter_mut().for_each(|value| *value += more);
    }
    block
}
