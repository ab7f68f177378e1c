//! Random texts, valid and invalid: no panic, no hang, bounded memory, and every message points into the text.

use crate::common::{Random, lines, state};
use crate::trees::{PARAMETERS, tree};
use formula::limits::MOST_OPERATIONS;
use formula::{Error, Expression, Location, law};

/// What random texts are made of.
const WORDS: [&str; 66] = [
    "s",
    "v",
    "x",
    "j",
    "sum",
    "sum(j, 1, 3, ",
    "sum(j,-1000,1000,",
    "s[",
    "v[1]",
    "x[-2]",
    "x[j]",
    "s[2*j-1]",
    "[",
    "]",
    "(",
    ")",
    "+",
    "-",
    "*",
    "/",
    "^",
    "**",
    ",",
    "exp(",
    "ln(",
    "ln_1p(",
    "exp_m1(",
    "sqrt(",
    "tanh(",
    "softplus(",
    "abs(",
    "min(",
    "max(",
    "ramp(",
    "exp",
    "e",
    "pi",
    "p",
    "q2",
    "kappa",
    "V",
    "gap",
    "body",
    "acceleration",
    "kind",
    "quite_unknown",
    "0",
    "1",
    "2",
    "16",
    "1000",
    "-2",
    "1e308",
    "1e999",
    "1.5",
    ".",
    "1e-310",
    "1_0",
    " ",
    "\n",
    "\u{2212}",
    "\u{d7}",
    "\u{3c0}",
    "\u{1f6b6}",
    "\u{0}",
    "'",
];

/// A text: a good formula, one with a few changes, or words in a row.
fn text(random: &mut Random) -> String {
    let mut text = match random.below(4) {
        0 => return (0..random.below(24)).map(|_| random.pick(&WORDS)).collect(),
        _ => {
            let levels = 1 + random.below(4) as u32;
            tree(random, levels).text(random)
        }
    };
    for _ in 0..random.pick(&[0, 0, 0, 1, 2, 3]) {
        let places: Vec<usize> = text.char_indices().map(|(place, _)| place).chain([text.len()]).collect();
        let (from, to) = (random.pick(&places), random.pick(&places));
        let (from, to) = if from <= to { (from, to) } else { (to, from) };
        match random.below(3) {
            0 => text.insert_str(from, random.pick(&WORDS)),
            1 => text.replace_range(from..to, random.pick(&WORDS)),
            _ => {
                let copy = text[from..to].to_owned();
                text.insert_str(from, &copy);
            }
        }
    }
    text
}

#[track_caller]
fn assert_points_into(text: &str, start: Location, error: &Error) {
    let lines = text.split('\n').count() as u32;
    let line = error.place.line.checked_sub(start.line).filter(|line| *line < lines);
    let line = text.split('\n').nth(line.unwrap_or_else(|| panic!("{error} for {text:?}")) as usize).expect("a line");
    let first = if error.place.line == start.line { start.column } else { 1 };
    let column = error.place.column.checked_sub(first).expect("a column of the text");
    assert!(column as usize <= line.chars().count(), "{error} for {text:?}");
    assert!(!error.found.is_empty() && !error.valid.is_empty(), "{error}");
}

/// Tries random laws and expressions; returns how many were good.
fn tried(seed: u64, count: usize) -> usize {
    let mut random = Random(seed);
    let mut good = 0;
    for _ in 0..count {
        let (acceleration, other) = (text(&mut random), text(&mut random));
        let texts = [("acceleration", acceleration.as_str()), ("gap", "s - V + 0*(p + q2 + kappa)"), ("V", &other)];
        let mut numbers = PARAMETERS.to_vec();
        numbers.push(("body", 0.5));
        let section = Location { line: 1, column: 1 };
        let definitions = lines(&texts, &numbers);
        match law("scene.toml", section, &definitions).and_then(|graph| {
            assert!(graph.size() <= MOST_OPERATIONS);
            graph.bind(&graph.values())
        }) {
            Ok(bound) => {
                for root in bound.roots() {
                    let value = bound.eval(*root, state);
                    assert!(value.is_ok_and(|value| value.is_finite()) || bound.eval(*root, state).is_err());
                }
                good += 1;
            }
            Err(error) => {
                // texts of several lines overlap in this file
                let is_first = error.place.line == 2;
                match acceleration.contains('\n') || other.contains('\n') {
                    true => assert!(!error.found.is_empty() && !error.valid.is_empty(), "{error}"),
                    false if is_first => assert_points_into(&acceleration, definitions[0].value, &error),
                    false => assert_points_into(&other, definitions[2].value, &error),
                }
            }
        }
        let start = Location { line: 41, column: 13 };
        match Expression::parse("claims.toml", start, &acceleration) {
            Ok(expression) => {
                let value = expression.eval(|name| 0.5 + name as f64);
                assert!(value.is_err() || value.is_ok_and(|value| value.is_finite()));
            }
            Err(error) => assert_points_into(&acceleration, start, &error),
        }
    }
    good
}

#[test]
fn random_texts_do_no_harm() {
    let good = tried(11, 20_000);
    println!("{good} of 20000 are laws");
    assert!((2_000..18_000).contains(&good), "{good}: both kinds must be tried");
}

#[test]
#[ignore = "a million: minutes; run with --release"]
fn a_million_random_texts_do_no_harm() {
    let good = tried(12, 1_000_000);
    assert!((100_000..900_000).contains(&good), "{good}");
}
