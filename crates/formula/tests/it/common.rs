//! Short laws for tests, and reproducible random numbers.

#[path = "../../../math/src/random.rs"]
mod random;

use formula::{Bound, Definition, Error, Given, Graph, Location, Variable, law};

pub use random::Random;

/// A law from its lines: names and expressions, names and numbers. Line 1 is the header; keys stand in column 1, values
/// in column 9.
pub fn lines<'a>(texts: &[(&'a str, &'a str)], numbers: &[(&'a str, f64)]) -> Vec<Definition<'a>> {
    let given = texts.iter().map(|(name, text)| (*name, Given::Text(text)));
    let given = given.chain(numbers.iter().map(|(name, number)| (*name, Given::Number(*number))));
    let line = |(line, (name, given))| {
        let place = |column| Location { line: line as u32 + 2, column };
        Definition { name, key: place(1), value: place(9), given }
    };
    given.enumerate().map(line).collect()
}

/// A law with `body = 0` added.
pub fn graph(texts: &[(&str, &str)], numbers: &[(&str, f64)]) -> Result<Graph, Error> {
    let mut definitions = lines(texts, numbers);
    let place = Location { line: 99, column: 1 };
    definitions.push(Definition { name: "body", key: place, value: place, given: Given::Number(0.0) });
    law("scene.toml", Location { line: 1, column: 1 }, &definitions)
}

/// A law of one expression, with the values of the file.
pub fn bound(acceleration: &str, numbers: &[(&str, f64)]) -> Bound {
    let graph = graph(&[("acceleration", acceleration)], numbers).unwrap_or_else(|error| panic!("{error}"));
    graph.bind(&graph.values()).unwrap_or_else(|error| panic!("{error}"))
}

/// Spacings and speeds that differ from one pedestrian to the next.
pub fn state(variable: Variable) -> f64 {
    match variable {
        Variable::Spacing(j) => 2.5 + 0.375 * f64::from(j),
        Variable::Speed(j) => 0.75 - 0.0625 * f64::from(j),
        Variable::Free(_) => f64::NAN,
    }
}

impl Random {
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}
