//! The steps of a run as a table of prints ([`files::steps`]), which a later run is compared with.

use files::steps::Print;
use ode::Step;
use std::fmt::Write as _;

const HEADER: &str = "t,print\n";

/// `t,print`: the end of each accepted step and its print. The first line is the start, as a step of no length.
#[derive(Clone, Debug, PartialEq)]
pub struct Steps {
    pedestrians: usize,
    text: String,
}

impl Steps {
    /// No steps yet, of a ring of so many pedestrians.
    pub fn new(pedestrians: usize) -> Steps {
        Steps { pedestrians, text: HEADER.to_owned() }
    }

    /// Adds a step; before the first, the state that it starts from.
    pub fn push(&mut self, step: &Step<'_>) {
        if self.text == HEADER {
            self.line(step.start, Print::new(0.0, step.before(), self.pedestrians));
        }
        self.line(step.end, Print::new(step.length(), step.after(), self.pedestrians));
    }

    fn line(&mut self, t: f64, print: Print) {
        // writing to a String cannot fail
        let _ = writeln!(self.text, "{t:?},{print}");
    }

    /// The table.
    pub fn to_csv(&self) -> &str {
        &self.text
    }
}
