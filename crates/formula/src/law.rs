//! The formulas of a law: resolves names and determines the order of evaluation.

use crate::build::Builder;
use crate::graph::{Graph, Parameter, Symbol};
use crate::names::{self, ACCELERATION, BODY, GAP, SCALE};
use crate::operation::Id;
use crate::parse::{Vocabulary, parse};
use crate::place::{Error, Location, Problem};
use crate::tree::Tree;
use std::collections::BTreeMap;

/// What a key of `[law]` has behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given<'a> {
    /// A number: a parameter.
    Number(f64),
    /// A string: an expression.
    Text(&'a str),
}

impl From<f64> for Given<'_> {
    fn from(number: f64) -> Self {
        Given::Number(number)
    }
}

impl<'a> From<&'a str> for Given<'a> {
    fn from(text: &'a str) -> Self {
        Given::Text(text)
    }
}

/// One line of `[law]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Definition<'a> {
    /// The key.
    pub name: &'a str,
    /// The position of the key.
    pub key: Location,
    /// The position of the value: of the number, or of the first character of the string after the quotation mark.
    pub value: Location,
    /// The value.
    pub given: Given<'a>,
}

/// Parses the formulas of a law.
///
/// `file` is for messages, `section` the place of the header `[law]`; `definitions` are its lines in the order of the
/// file but for `kind`: `acceleration` and `body`, `gap` and `scale` where given, parameters, named expressions.
///
/// # Errors
/// The first thing that is wrong, with its place, what was found and what would be valid: syntax, unknown names (with
/// the nearest), circles, unused names, reserved names, a law that is too large.
pub fn law(file: &str, section: Location, definitions: &[Definition<'_>]) -> Result<Graph, Error> {
    graph(file, section, definitions).map_err(|problem| problem.within(file))
}

fn graph(file: &str, section: Location, definitions: &[Definition<'_>]) -> Result<Graph, Problem> {
    let places = checked(section, definitions)?;
    let trees: Vec<Tree> = definitions.iter().map(tree).collect::<Result<_, _>>()?;
    let uses: Vec<Vec<(usize, Location)>> =
        trees.iter().map(|tree| resolved(tree, &places)).collect::<Result<_, _>>()?;
    let order = order(definitions, &uses)?;
    let roots: Vec<usize> = [ACCELERATION, GAP].iter().filter_map(|root| places.get(root).copied()).collect();
    all_used(definitions, &uses, &roots)?;

    let mut parameters = Vec::new();
    let mut builder = Builder::default();
    let mut known: BTreeMap<&str, Id> = BTreeMap::new();
    for Definition { name, value: place, given, .. } in definitions {
        if let Given::Number(value) = *given {
            known.insert(name, builder.add(Symbol::Parameter(parameters.len()), *place)?);
            parameters.push(Parameter { name: (*name).to_owned(), place: *place, value });
        }
    }
    for place in order {
        if let Given::Text(_) = definitions[place].given {
            let id = builder.expression(&trees[place].entries, &known, 0)?;
            known.insert(definitions[place].name, id);
        }
    }
    let roots = roots.iter().map(|root| known[definitions[*root].name]).collect();
    Ok(Graph { file: file.to_owned(), arena: builder.arena, parameters, roots })
}

/// The definitions by name, none of which is reserved, there twice, or of the wrong kind.
fn checked<'a>(section: Location, definitions: &[Definition<'a>]) -> Result<BTreeMap<&'a str, usize>, Problem> {
    let mut places = BTreeMap::new();
    for (place, &Definition { name, key, value, given }) in definitions.iter().enumerate() {
        if !names::is_name(name) {
            let valid = "names of ASCII letters, digits and _, a letter first";
            return Err(Problem::new(key, format!("the name `{}`", name.escape_default()), valid));
        }
        if names::reserved().any(|word| word == name) {
            let words = names::reserved().collect::<Vec<_>>().join(" ");
            return Err(Problem::new(
                key,
                format!("the name `{name}`, which is reserved"),
                format!("names other than {words}"),
            ));
        }
        match given {
            Given::Number(number) if !number.is_finite() => {
                return Err(Problem::new(value, format!("{name} = {number}"), "a finite number"));
            }
            Given::Number(number) if name == SCALE && number <= 0.0 => {
                return Err(Problem::new(value, format!("{name} = {number}"), "a number > 0, the size of speeds"));
            }
            Given::Number(_) if [ACCELERATION, GAP].contains(&name) => {
                return Err(Problem::new(value, format!("a number for {name}"), "an expression in quotation marks"));
            }
            Given::Text(_) if [BODY, SCALE].contains(&name) => {
                return Err(Problem::new(value, format!("an expression for {name}"), "a number"));
            }
            Given::Number(_) | Given::Text(_) => {}
        }
        if places.insert(name, place).is_some() {
            return Err(Problem::new(key, format!("a second `{name}`"), "every name once"));
        }
    }
    let missing = |name: &str, valid: &str| match places.contains_key(name) {
        true => Ok(()),
        false => Err(Problem::new(section, format!("a law without `{name}`"), valid)),
    };
    missing(ACCELERATION, "acceleration = \"EXPRESSION\", dv/dt of pedestrian n")?;
    missing(BODY, "body = NUMBER, the spacing at which two touch")?;
    Ok(places)
}

fn tree(definition: &Definition<'_>) -> Result<Tree, Problem> {
    match definition.given {
        Given::Number(_) => Ok(Tree::default()),
        Given::Text(text) => parse(text, definition.value, Vocabulary::Law),
    }
}

/// The definitions that an expression names.
fn resolved(tree: &Tree, places: &BTreeMap<&str, usize>) -> Result<Vec<(usize, Location)>, Problem> {
    let mut uses = Vec::new();
    for (name, place) in tree.names() {
        match places.get(name) {
            _ if name == ACCELERATION || name == names::KIND => {
                return Err(Problem::new(place, format!("`{name}` within an expression"), known(places)));
            }
            Some(definition) => uses.push((*definition, place)),
            None => {
                let own = places.keys().copied().filter(|name| *name != ACCELERATION);
                let near = names::nearest(name, own.chain(names::common()).chain([names::SUM]));
                let hint = near.map_or(String::new(), |near| format!("{near}? "));
                return Err(Problem::new(
                    place,
                    format!("the unknown name `{name}`"),
                    format!("{hint}{}", known(places)),
                ));
            }
        }
    }
    Ok(uses)
}

/// What an expression may name.
fn known(places: &BTreeMap<&str, usize>) -> String {
    let own: Vec<&str> = places.keys().copied().filter(|name| *name != ACCELERATION).collect();
    let words: Vec<&str> = names::common().collect();
    format!("s v s[j] v[j] x[j] sum, the names of [law] ({}), {}", own.join(" "), words.join(" "))
}

/// An order in which every definition comes behind those it uses.
fn order(definitions: &[Definition<'_>], uses: &[Vec<(usize, Location)>]) -> Result<Vec<usize>, Problem> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut states = vec![State::New; uses.len()];
    let mut order = Vec::new();
    for start in 0..uses.len() {
        // definitions that are open, and how many of their uses are done
        let mut path = if states[start] == State::New { vec![(start, 0)] } else { Vec::new() };
        while let Some((current, done)) = path.last_mut() {
            states[*current] = State::Open;
            match uses[*current].get(*done) {
                None => {
                    states[*current] = State::Done;
                    order.push(*current);
                    path.pop();
                }
                Some((next, place)) => {
                    *done += 1;
                    match states[*next] {
                        State::New => path.push((*next, 0)),
                        State::Done => {}
                        State::Open => {
                            let inside = path.iter().map(|(open, _)| *open).skip_while(|open| open != next);
                            let circle: Vec<&str> = inside.chain([*next]).map(|open| definitions[open].name).collect();
                            let found = format!("circular definitions: {}", circle.join(" -> "));
                            return Err(Problem::new(*place, found, "named expressions without circular references"));
                        }
                    }
                }
            }
        }
    }
    Ok(order)
}

/// Complains about the first definition that the roots do not lead to.
fn all_used(definitions: &[Definition<'_>], uses: &[Vec<(usize, Location)>], roots: &[usize]) -> Result<(), Problem> {
    let mut used = vec![false; uses.len()];
    let mut open = roots.to_vec();
    while let Some(current) = open.pop() {
        if !std::mem::replace(&mut used[current], true) {
            open.extend(uses[current].iter().map(|(next, _)| *next));
        }
    }
    let free = [BODY, SCALE];
    match definitions.iter().zip(used).find(|(definition, used)| !used && !free.contains(&definition.name)) {
        None => Ok(()),
        Some((Definition { name, key, .. }, _)) => {
            let near = names::nearest(name, [GAP, BODY, SCALE].into_iter());
            let hint = near.map_or(String::new(), |near| format!("{near}? "));
            let found = format!("`{name}`, which neither acceleration nor gap uses");
            Err(Problem::new(*key, found, format!("{hint}only names that are used; gap, body and scale need not be")))
        }
    }
}
