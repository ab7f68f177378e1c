//! Laws as formulas: the built-in ones a second time, and others.

use formula::{Definition, Given, Location};
use jam::laws::{Formula, Model};

/// A law from the lines of its section.
pub fn law(lines: &[(&str, Given<'_>)]) -> Model {
    let place = |line: usize, column| Location { line: line as u32 + 2, column };
    let definitions: Vec<Definition<'_>> = lines
        .iter()
        .enumerate()
        .map(|(line, (name, given))| Definition { name, key: place(line, 1), value: place(line, 20), given: *given })
        .collect();
    let graph = formula::law("scene.toml", Location { line: 1, column: 1 }, &definitions);
    Model::Formula(graph.and_then(Formula::new).unwrap_or_else(|error| panic!("{error}")))
}

/// A built-in law, written as formulas.
pub fn as_formula(model: &Model) -> Model {
    let number = Given::Number;
    match model {
        Model::Algebraic(p) => law(&[
            ("acceleration", Given::Text("v0 - v - (mu + delta*ramp(v[1] - v, epsilon))^2*d^(-q)")),
            ("d", Given::Text("s - body - a_v*(v + v[1])")),
            ("gap", Given::Text("d")),
            ("mu", number(p.mu)),
            ("delta", number(p.delta)),
            ("q", number(p.q)),
            ("a_v", number(p.a_v)),
            ("epsilon", number(p.epsilon)),
            ("v0", number(p.v0)),
            ("body", number(2.0)),
        ]),
        Model::Exponential(p) => law(&[
            ("acceleration", Given::Text("v0 - v - a*exp(-d/b) - c*ramp(d, epsilon)")),
            ("d", Given::Text("s - body - a_v*(v + v[1])")),
            ("gap", Given::Text("d")),
            ("a", number(p.a)),
            ("b", number(p.b)),
            ("c", number(p.c)),
            ("a_v", number(p.a_v)),
            ("epsilon", number(p.epsilon)),
            ("v0", number(p.v0)),
            ("body", number(2.0)),
        ]),
        Model::Logarithmic(p) => law(&[
            ("acceleration", Given::Text("v0*(1 - ln_1p((e - 1)*ramp(s/(2 + a_v*(v + v[1])) - 1, epsilon))) - v")),
            ("a_v", number(p.a_v)),
            ("epsilon", number(p.epsilon)),
            ("v0", number(p.v0)),
            ("body", number(0.0)),
        ]),
        Model::Formula(_) | Model::Own(_) => model.clone(),
    }
}

/// Laws in which the other operations of the language occur, and other neighbours.
pub fn others() -> Vec<Model> {
    [
        "tanh(s - 2) + tanh(2) - v",
        "0.8*(min(s[-1], s) - v) + 0.1*max(v[1] - v, 0)",
        "1 - v/(1 + sqrt(s)) - ln(1 + abs(v[1] - v))*exp_m1(-s)",
        "(s^2.5 - 1)/(s^3 + 2) - 0.7*v + 0.2*sum(j, 1, 2, v[j] - v)/x[2]",
        "1.2*(1 - (v/1.2)^4 - ((0.5 + v + v*(v - v[1])/2)/s)^2)",
    ]
    .map(|acceleration| law(&[("acceleration", acceleration.into()), ("body", 0.5.into()), ("scale", 1.0.into())]))
    .to_vec()
}
