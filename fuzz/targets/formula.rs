//! Formulas: any text is a law or an expression with a value, or refused with a place within it.

use formula::{Definition, Error, Expression, Given, Location, Variable, law};

/// Tries one file: a law whose lines are `name = number` and `name = expression`, and the whole of it as one
/// expression.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let definitions: Vec<Definition<'_>> = text.lines().enumerate().filter_map(definition).collect();
    let bound = law("scene.toml", Location { line: 1, column: 1 }, &definitions).and_then(|graph| {
        let stencil = graph.stencil();
        assert!(stencil.spacings.iter().chain(&stencil.speeds).all(|j| j.abs() <= formula::limits::FARTHEST));
        graph.bind(&graph.values())
    });
    match bound {
        Ok(bound) => {
            for root in bound.roots() {
                let value = bound.eval(*root, |variable| match variable {
                    Variable::Spacing(j) => 2.5 + 0.375 * f64::from(j),
                    Variable::Speed(j) => 0.75 - 0.0625 * f64::from(j),
                    Variable::Free(_) => unreachable!("a law has no free names"),
                });
                match value {
                    Ok(value) => assert!(value.is_finite()),
                    Err(error) => complaint(&error, &text),
                }
                for kink in bound.kinks(*root) {
                    assert!(kink.node <= *root && kink.left < kink.node);
                }
            }
        }
        Err(error) => complaint(&error, &text),
    }
    match Expression::parse("scene.toml", Location { line: 1, column: 1 }, &text) {
        Ok(expression) => {
            let value = expression.eval(|name| 0.5 + name as f64);
            assert!(value.is_err() || value.is_ok_and(|value| value.is_finite()));
        }
        Err(error) => complaint(&error, &text),
    }
}

/// The definition of a line.
fn definition((at, line): (usize, &str)) -> Option<Definition<'_>> {
    let (name, value) = line.split_once(" = ")?;
    let place = |column: usize| Location { line: at as u32 + 1, column: column as u32 };
    let given = value.parse().map_or(Given::Text(value), Given::Number);
    Some(Definition { name, key: place(1), value: place(name.chars().count() + 4), given })
}

fn complaint(error: &Error, text: &str) {
    assert!(!error.found.is_empty() && !error.valid.is_empty(), "{error}");
    let lines = 1 + text.matches('\n').count();
    assert!(error.place.line >= 1 && error.place.line as usize <= lines, "{error}");
    let line = text.split('\n').nth(error.place.line as usize - 1).unwrap_or("");
    assert!(error.place.column >= 1 && error.place.column as usize <= line.chars().count() + 1, "{error}");
}
