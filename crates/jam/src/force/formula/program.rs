//! A formula as a list of instructions on registers, each of which holds one number for every pedestrian of a row.

use formula::{Binary, Bound, Id, Operation, Unary, Variable};
use math::number::Number;

/// Where an instruction finds an operand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// The spacing of pedestrian n + j, less the contact if `net`.
    Spacing {
        /// Whose.
        j: i32,
        /// Whether it is the net gap.
        net: bool,
    },
    /// The speed of pedestrian n + j.
    Speed(i32),
    /// What an instruction left.
    Register(usize),
}

/// What an instruction does with a number and a constant, with a number, or with two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// A number that is the same for all pedestrians; the operand is unused.
    Constant(f64),
    /// `x + c`
    AddConstant(f64),
    /// `x c`
    MulConstant(f64),
    /// `x / c`
    DivConstant(f64),
    /// `1 / x`
    Recip,
    /// `x^n`
    Whole(i32),
    /// `x^q`
    Power(f64),
    /// The sign, or a function of one number.
    Unary(Unary),
    /// `x + y`
    Add(Source),
    /// `x - y`
    Sub(Source),
    /// `x y`
    Mul(Source),
    /// `x / y`
    Div(Source),
    /// The smaller one.
    Min(Source),
    /// The larger one.
    Max(Source),
}

/// One instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instruction {
    /// What it does.
    pub action: Action,
    /// With what.
    pub of: Source,
    /// The register of its result, which is none of its operands.
    pub into: usize,
    /// The node of the graph that it belongs to, for messages.
    pub node: Id,
    /// The register of its first operand, if that is not needed any more.
    pub spent: Option<usize>,
}

/// The instructions for one root of a graph.
#[derive(Clone, Debug)]
pub struct Program {
    /// In the order in which they are carried out.
    pub instructions: Vec<Instruction>,
    /// As many registers as they need.
    pub registers: usize,
    /// Where the result is.
    pub result: Source,
}

/// Builds a program; every instruction has a register of its own at first.
struct Builder<'a> {
    bound: &'a Bound,
    contact: f64,
    instructions: Vec<Instruction>,
    sources: Vec<Option<Source>>,
}

impl Program {
    /// The program of a root. Where the graph subtracts the contact spacing, the net gap already exists.
    pub fn new(bound: &Bound, root: Id, contact: f64) -> Program {
        let needed = bound.needed(root);
        let sources = vec![None; bound.nodes().len()];
        let mut builder = Builder { bound, contact, instructions: Vec::new(), sources };
        for node in (0..=root).filter(|&node| needed[node]) {
            builder.node(node);
        }
        let result = builder.source(root, root);
        let mut program = Program { registers: builder.instructions.len(), instructions: builder.instructions, result };
        program.share_registers();
        program
    }

    /// Carries the program out with any number; `variable` gives the variables.
    pub fn carry_out<X: Number>(&self, variable: impl Fn(Source) -> X) -> X {
        let anything = variable(Source::Speed(0));
        let mut registers = vec![anything; self.registers];
        for Instruction { action, of, into, .. } in &self.instructions {
            let get = |source: Source| match source {
                Source::Register(index) => registers[index],
                other => variable(other),
            };
            registers[*into] = action.act(get(*of), get);
        }
        match self.result {
            Source::Register(index) => registers[index],
            other => variable(other),
        }
    }

    /// Whether a kink lies at these values of the variables: `|x|` at 0, or the smaller or larger of two equal numbers.
    pub fn is_on_kink(&self, variable: impl Fn(Source) -> f64) -> bool {
        let mut registers = vec![0.0; self.registers];
        for Instruction { action, of, into, .. } in &self.instructions {
            let get = |source: Source| match source {
                Source::Register(index) => registers[index],
                other => variable(other),
            };
            let x = get(*of);
            let is_kink = match *action {
                Action::Unary(Unary::Abs) => x == 0.0,
                Action::Min(y) | Action::Max(y) => x == get(y),
                _ => false,
            };
            if is_kink {
                return true;
            }
            registers[*into] = action.act(x, get);
        }
        false
    }

    /// The same for identical pedestrians: the variables of all of them are equal.
    pub fn of_uniform_flow(&self) -> Program {
        let own = |source: Source| match source {
            Source::Spacing { net, .. } => Source::Spacing { j: 0, net },
            Source::Speed(_) => Source::Speed(0),
            register => register,
        };
        let mut program = self.clone();
        for instruction in &mut program.instructions {
            instruction.of = own(instruction.of);
            instruction.action = instruction.action.map(own);
        }
        program.result = own(program.result);
        program
    }

    /// The operations with kinks: how many histories the ones before take.
    pub fn kinks(&self) -> Vec<usize> {
        let (mut kinks, mut used) = (Vec::new(), 0);
        for instruction in &self.instructions {
            if instruction.has_kink() {
                kinks.push(used);
            }
            used += instruction.action.histories();
        }
        kinks
    }

    /// Whether some kinks are of higher derivatives only, as that of `max(0, x)^2`: those whose result goes into powers
    /// above 1 and nowhere else.
    pub fn has_soft_kinks(&self) -> bool {
        (0..self.instructions.len()).any(|index| self.instructions[index].has_kink() && self.is_raised(index))
    }

    /// Whether a root is drawn of something behind a kink, as that of `max(0, x)`: its slope may be infinite there.
    pub fn has_roots_of_kinks(&self) -> bool {
        let mut behind = vec![false; self.registers];
        for instruction in &self.instructions {
            let is_behind = |source| matches!(source, Source::Register(register) if behind[register]);
            let is_operand_behind = match instruction.action {
                Action::Constant(_) => false,
                action => is_behind(instruction.of) || action.second().is_some_and(is_behind),
            };
            if is_operand_behind && matches!(instruction.action, Action::Unary(Unary::Sqrt)) {
                return true;
            }
            behind[instruction.into] = is_operand_behind || instruction.has_kink();
        }
        false
    }

    /// Whether the result of an instruction goes into powers above 1 and nowhere else.
    fn is_raised(&self, index: usize) -> bool {
        let result = Source::Register(self.instructions[index].into);
        for Instruction { action, of, into, .. } in &self.instructions[index + 1..] {
            let (is_first, is_second) = (*of == result, action.second() == Some(result));
            let is_power = match *action {
                Action::Whole(n) => n > 1,
                Action::Power(q) => q > 1.0,
                Action::Mul(_) => is_first && is_second,
                _ => false,
            };
            if (is_first && !matches!(action, Action::Constant(_)) || is_second) && !is_power {
                return false;
            }
            if Source::Register(*into) == result {
                return true;
            }
        }
        self.result != result
    }

    /// The variables that occur.
    pub fn variables(&self) -> Vec<Source> {
        let operands = self.instructions.iter().flat_map(|instruction| {
            let second = instruction.action.second();
            std::iter::once(instruction.of).chain(second)
        });
        let mut variables: Vec<Source> = Vec::new();
        for source in operands.chain([self.result]) {
            if !matches!(source, Source::Register(_)) && !variables.contains(&source) {
                variables.push(source);
            }
        }
        variables
    }

    /// Reuses registers whose contents are not needed any more for later instructions.
    fn share_registers(&mut self) {
        let mut last_use = vec![0; self.instructions.len()];
        for (index, instruction) in self.instructions.iter().enumerate() {
            for source in std::iter::once(instruction.of).chain(instruction.action.second()) {
                if let Source::Register(register) = source {
                    last_use[register] = index;
                }
            }
        }
        if let Source::Register(register) = self.result {
            last_use[register] = usize::MAX;
        }
        let (mut free, mut count): (Vec<usize>, usize) = (Vec::new(), 0);
        let mut place = vec![0; self.instructions.len()];
        for index in 0..self.instructions.len() {
            let register = free.pop().unwrap_or_else(|| {
                count += 1;
                count - 1
            });
            place[index] = register;
            let operands: Vec<usize> = {
                let instruction = &self.instructions[index];
                let sources = std::iter::once(instruction.of).chain(instruction.action.second());
                sources.filter_map(|source| if let Source::Register(own) = source { Some(own) } else { None }).collect()
            };
            let moved = |source: Source| match source {
                Source::Register(own) => Source::Register(place[own]),
                other => other,
            };
            let instruction = &mut self.instructions[index];
            instruction.of = moved(instruction.of);
            instruction.action = instruction.action.map(moved);
            instruction.into = register;
            instruction.spent = match (instruction.of, operands.first()) {
                (Source::Register(own), Some(first)) if last_use[*first] == index => Some(own),
                _ => None,
            };
            for (position, own) in operands.iter().enumerate() {
                if last_use[*own] == index && !operands[..position].contains(own) {
                    free.push(place[*own]);
                }
            }
        }
        if let Source::Register(own) = self.result {
            self.result = Source::Register(place[own]);
        }
        self.registers = count;
    }
}

impl Instruction {
    /// Whether it has a kink.
    fn has_kink(&self) -> bool {
        matches!(self.action, Action::Unary(Unary::Abs) | Action::Min(_) | Action::Max(_))
    }
}

impl Action {
    /// Does it, with a number and, where there is a second operand, with what `get` finds.
    #[inline(always)]
    pub fn act<X: Number>(&self, x: X, get: impl Fn(Source) -> X) -> X {
        match *self {
            Action::Constant(c) => x * 0.0 + c,
            Action::AddConstant(c) => x + c,
            Action::MulConstant(c) => x * c,
            Action::DivConstant(c) => x / c,
            Action::Recip => x.recip(),
            Action::Whole(n) => x.powi(n),
            Action::Power(q) => x.powf(q),
            Action::Unary(unary) => apply(unary, x),
            Action::Add(y) => x + get(y),
            Action::Sub(y) => x - get(y),
            Action::Mul(y) => x * get(y),
            Action::Div(y) => x / get(y),
            Action::Min(y) => x.min(get(y)),
            Action::Max(y) => x.max(get(y)),
        }
    }

    /// How many histories it takes in a series ([`math::series`]).
    pub fn histories(&self) -> usize {
        match *self {
            Action::Whole(n) if n > 1 => n as usize - 1,
            Action::Unary(Unary::Neg) => 0,
            Action::Whole(_) | Action::Power(_) | Action::Recip | Action::Unary(_) => 1,
            Action::Mul(_) | Action::Div(_) | Action::Min(_) | Action::Max(_) => 1,
            _ => 0,
        }
    }

    /// The second operand, if there is one.
    pub fn second(&self) -> Option<Source> {
        match *self {
            Action::Add(y) | Action::Sub(y) | Action::Mul(y) | Action::Div(y) | Action::Min(y) | Action::Max(y) => {
                Some(y)
            }
            _ => None,
        }
    }

    fn map(self, moved: impl Fn(Source) -> Source) -> Action {
        match self {
            Action::Add(y) => Action::Add(moved(y)),
            Action::Sub(y) => Action::Sub(moved(y)),
            Action::Mul(y) => Action::Mul(moved(y)),
            Action::Div(y) => Action::Div(moved(y)),
            Action::Min(y) => Action::Min(moved(y)),
            Action::Max(y) => Action::Max(moved(y)),
            other => other,
        }
    }
}

/// The sign or a function of a number.
#[inline(always)]
fn apply<X: Number>(unary: Unary, x: X) -> X {
    match unary {
        Unary::Neg => -x,
        Unary::Exp => x.exp(),
        Unary::ExpM1 => x.exp_m1(),
        Unary::Ln => x.ln(),
        Unary::Ln1p => x.ln_1p(),
        Unary::Sqrt => x.sqrt(),
        Unary::Tanh => x.tanh(),
        Unary::Softplus => x.softplus(),
        Unary::Abs => x.abs(),
    }
}

/// A division by a power of 2 has the bits of a multiplication, which is faster.
fn divided_by(c: f64) -> Action {
    const FRACTION: u64 = (1 << 52) - 1;
    let inverse = 1.0 / c;
    let is_power_of_two = c.to_bits() & FRACTION == 0 && c.is_normal() && inverse.is_normal();
    if is_power_of_two { Action::MulConstant(inverse) } else { Action::DivConstant(c) }
}

impl Builder<'_> {
    fn constant(&self, node: Id) -> Option<f64> {
        match self.bound.nodes()[node] {
            Operation::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Where the value of a node is; a constant is put into a register for `user`.
    fn source(&mut self, node: Id, user: Id) -> Source {
        if let Some(source) = self.sources[node] {
            return source;
        }
        let value = self.constant(node).unwrap_or(f64::NAN);
        let source = self.push(Action::Constant(value), Source::Speed(0), user);
        self.sources[node] = Some(source);
        source
    }

    fn push(&mut self, action: Action, of: Source, node: Id) -> Source {
        let into = self.instructions.len();
        self.instructions.push(Instruction { action, of, into, node, spent: None });
        Source::Register(into)
    }

    fn node(&mut self, node: Id) {
        let source = match self.bound.nodes()[node] {
            // put where it is needed, as part of an instruction if possible
            Operation::Constant(_) => return,
            Operation::Variable(Variable::Spacing(j)) => Source::Spacing { j, net: false },
            Operation::Variable(Variable::Speed(j)) => Source::Speed(j),
            // a law has none
            Operation::Variable(Variable::Free(_)) => return,
            Operation::Unary(unary, a) => {
                let of = self.source(a, node);
                self.push(Action::Unary(unary), of, node)
            }
            Operation::Power(a, n) => {
                let of = self.source(a, node);
                self.push(if n == -1 { Action::Recip } else { Action::Whole(n) }, of, node)
            }
            Operation::Binary(binary, a, b) => self.binary(binary, a, b, node),
        };
        self.sources[node] = Some(source);
    }

    fn binary(&mut self, binary: Binary, a: Id, b: Id, node: Id) -> Source {
        let net_gap = match (binary, self.bound.nodes()[a], self.constant(b)) {
            (Binary::Sub, Operation::Variable(Variable::Spacing(j)), Some(c)) if c == self.contact => Some(j),
            _ => None,
        };
        if let Some(j) = net_gap {
            return Source::Spacing { j, net: true };
        }
        match (binary, self.constant(a), self.constant(b)) {
            (Binary::Add, Some(c), _) => self.with_constant(Action::AddConstant(c), b, node),
            (Binary::Add, _, Some(c)) => self.with_constant(Action::AddConstant(c), a, node),
            (Binary::Sub, _, Some(c)) => self.with_constant(Action::AddConstant(-c), a, node),
            (Binary::Sub, Some(c), _) => {
                let minus = self.with_constant(Action::Unary(Unary::Neg), b, node);
                self.push(Action::AddConstant(c), minus, node)
            }
            (Binary::Mul, Some(c), _) => self.with_constant(Action::MulConstant(c), b, node),
            (Binary::Mul, _, Some(c)) => self.with_constant(Action::MulConstant(c), a, node),
            (Binary::Div, _, Some(c)) => self.with_constant(divided_by(c), a, node),
            (Binary::Pow, _, Some(q)) => self.with_constant(Action::Power(q), a, node),
            (Binary::Pow, ..) => {
                // a^b = exp(b ln a), as math::lane::pow has it
                let (of, exponent) = (self.source(a, node), self.source(b, node));
                let logarithm = match self.constant(a) {
                    Some(c) => self.push(Action::Constant(math::lane::ln(c)), of, node),
                    None => self.push(Action::Unary(Unary::Ln), of, node),
                };
                let product = self.push(Action::Mul(logarithm), exponent, node);
                self.push(Action::Unary(Unary::Exp), product, node)
            }
            (_, _, _) => {
                let (first, second) = (self.source(a, node), self.source(b, node));
                let action = match binary {
                    Binary::Add => Action::Add(second),
                    Binary::Sub => Action::Sub(second),
                    Binary::Mul => Action::Mul(second),
                    Binary::Div | Binary::Pow => Action::Div(second),
                    Binary::Min => Action::Min(second),
                    Binary::Max => Action::Max(second),
                };
                self.push(action, first, node)
            }
        }
    }

    fn with_constant(&mut self, action: Action, of: Id, node: Id) -> Source {
        let of = self.source(of, node);
        self.push(action, of, node)
    }
}
