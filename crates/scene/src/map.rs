//! Stability over two parameters: `[map]` with `[law]` and `[uniform]`.

use crate::axis::{Axis, law_of_plane, spread};
use crate::law;
use files::reader::{FINITE, POSITIVE, Reader, SceneError, Section};
use files::table::{Table, push_number};
use jam::criteria;
use jam::laws::Model;
use jam::precise::Precise;
use jam::stability::{Linear, Waves};
use jam::uniform::{self, steady_speed};

/// Which number a map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// How far the uniform flow is from stability, exactly, for the waves of all lengths: negative where it is stable
    /// (see [`Linear::largest_margin`]).
    Margin,
    /// The paper's criterion, negative where the uniform flow is stable; only where the assumptions hold that it was
    /// derived with.
    Criterion,
    /// `Re z^+`.
    GrowthRate,
}

/// A map that can be computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The law; parameters that are an axis are replaced cell by cell.
    pub model: Model,
    /// What is shown.
    pub value: Value,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    point: Point,
}

/// A point of parameter space besides the law: wave number and uniform flow.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    headway: Option<f64>,
    gap: Option<f64>,
    wave_number: Option<f64>,
    /// The steady speed next to this one is taken, where a formula has several.
    speed: Option<f64>,
}

/// The names of the values in scene files.
const VALUES: [(&str, Value); 3] =
    [("margin", Value::Margin), ("criterion", Value::Criterion), ("growth_rate", Value::GrowthRate)];

/// What keeps the criterion of a law that is not the paper's from being computed.
const NO_CRITERION: &str = "the criterion is that of the paper, which has none for a formula or any further law";

/// The criterion is left out where it differs by more than this from the exact one, relative to values above 1.
pub const CRITERION_HOLDS: f64 = 1e-3;

/// The numbers of a map and how exact they are.
#[derive(Clone, Debug)]
pub struct Computed {
    /// One row for each cell that has a value: the two parameters and the value.
    pub table: Table,
    /// The cells without a value, by their number in the order of the table with all of them: those without a uniform
    /// flow, a linear response or a finite number, and those in which the paper's criterion differs from the exact one
    /// by more than [`CRITERION_HOLDS`].
    pub blank: Vec<usize>,
    /// How many of them have no value at all.
    pub undefined: usize,
    /// The first of these, and why it has none.
    pub first_undefined: Option<String>,
    /// The largest difference from the same value found another way; relative to values above 1.
    pub error: f64,
}

impl Computed {
    /// The table, where every cell has a value.
    ///
    /// # Errors
    /// A cell is blank: how many are, and why.
    pub fn whole(self) -> Result<Table, String> {
        self.blank_reason().map_or(Ok(self.table), Err)
    }

    /// The values of all cells, NaN for blank ones, as a picture takes them.
    pub fn values(&self) -> Vec<f64> {
        let (mut rows, mut blank) = (self.table.rows(), self.blank.iter().peekable());
        let cells = self.table.len() + self.blank.len();
        let mut value = |cell: usize| match blank.next_if_eq(&&cell) {
            Some(_) => f64::NAN,
            None => rows.next().map_or(f64::NAN, |row| row[2]),
        };
        (0..cells).map(&mut value).collect()
    }

    /// The part of the cells that are blank.
    pub fn blank_share(&self) -> f64 {
        self.share(self.blank.len())
    }

    /// Why cells are blank, if some are: each reason with the part of the cells that it holds for, in percent.
    pub fn blank_reason(&self) -> Option<String> {
        let inexact = self.blank.len() - self.undefined;
        let percent = |count: usize| format!("{:.1} % blank: ", 100.0 * self.share(count));
        let criterion = "the paper's criterion differs there from the exact one by more than 0.1 %; `margin` is exact";
        let criterion = (inexact > 0).then(|| percent(inexact) + criterion);
        let undefined = self.first_undefined.as_ref().map(|first| {
            let count = self.undefined;
            let cells = if count == 1 { "cell" } else { "cells" };
            format!("{}{count} {cells} without a value, the first {first}", percent(count))
        });
        let reasons: Vec<String> = criterion.into_iter().chain(undefined).collect();
        (!reasons.is_empty()).then(|| reasons.join("; "))
    }

    /// The part of all cells that so many are.
    pub fn share(&self, count: usize) -> f64 {
        count as f64 / (self.table.len() + self.blank.len()) as f64
    }

    /// The part of all cells with a value above 0.
    pub fn unstable_share(&self) -> f64 {
        self.share(self.table.rows().filter(|row| row[2] > 0.0).count())
    }

    /// The table of this map as CSV, the value of blank cells empty.
    pub fn to_csv(&self, map: &Map) -> Vec<u8> {
        if self.blank.is_empty() {
            return self.table.to_csv();
        }
        let mut text = self.table.columns.join(",") + "\n";
        for (cell, value) in self.values().into_iter().enumerate() {
            let (x, y) = (map.x.centre(cell / map.y.cells), map.y.centre(cell % map.y.cells));
            for (number, end) in [(x, ","), (y, ",")] {
                push_number(&mut text, number);
                text += end;
            }
            if !value.is_nan() {
                push_number(&mut text, value);
            }
            text += "\n";
        }
        text.into_bytes()
    }
}

/// Reads a map from the tables of a panel.
///
/// # Errors
/// What is missing, unknown or out of range, with file and line.
pub fn read(file: &str, tables: &Section) -> Result<Map, SceneError> {
    let mut top = Reader::new(file, "scene", tables);
    let mut map = Reader::new(file, "map", top.section("map")?);
    let value = if map.has("value") { map.one_of("value", &VALUES)? } else { Value::Margin };
    let (x, y) = (axis(file, "map.x", map.section("x")?)?, axis(file, "map.y", map.section("y")?)?);
    let law_tables = top.section("law")?;
    let [x_section, y_section] = [map.section("x")?, map.section("y")?];
    for (name, section, axis) in [("map.x", x_section, &x), ("map.y", y_section, &y)] {
        if name == "map.y" && axis.parameter == x.parameter {
            return Err(Reader::new(file, name, section).complaint("parameter", "is the other axis as well"));
        }
        if law_tables.entries.contains_key(&axis.parameter) {
            let problem = format!("is an axis of the map ({name}): leave it out here");
            return Err(Reader::new(file, "law", law_tables).complaint(&axis.parameter, &problem));
        }
        if let Some((key, problem)) = unfit(law_tables, axis) {
            return Err(Reader::new(file, name, section).complaint(key, &problem));
        }
    }
    map.finish()?;
    let model = law_of_plane(law_tables, [&x, &y], |at| {
        let mut law = law_tables.clone();
        for (axis, (section, value)) in [&x, &y].into_iter().zip([x_section, y_section].into_iter().zip(at)) {
            place_holder(&mut law, axis, section, value);
        }
        law::read(file, &law)
    })?;
    let point = if top.has("uniform") { uniform(file, top.section("uniform")?)? } else { EMPTY };
    top.finish()?;
    let map = Map { model, value, x, y, point };
    match map.complaint() {
        None => Ok(map),
        Some(problem) => Err(Reader::new(file, "scene", tables).complaint("map", &problem)),
    }
}

const EMPTY: Point = Point { headway: None, gap: None, wave_number: None, speed: None };

fn uniform(file: &str, section: &Section) -> Result<Point, SceneError> {
    let mut reader = Reader::new(file, "uniform", section);
    let point = Point {
        headway: reader.optional_number("headway", POSITIVE)?,
        gap: reader.optional_number("d_gap", POSITIVE)?,
        wave_number: reader.optional_number("k", POSITIVE)?,
        speed: reader.optional_number("speed", FINITE)?,
    };
    reader.finish()?;
    Ok(point)
}

fn axis(file: &str, name: &'static str, section: &Section) -> Result<Axis, SceneError> {
    let mut reader = Reader::new(file, name, section);
    let axis = Axis::read(&mut reader, "a parameter of the law, d_gap, headway or k", 2_000)?;
    reader.finish()?;
    Ok(axis)
}

/// Which key of this axis does not fit the law, and why, if one does not. Of a formula every name is a parameter, if
/// the formulas use it.
fn unfit(law: &Section, axis: &Axis) -> Option<(&'static str, String)> {
    let law = law::built_in(law)?;
    let (kind, own) = (law.name(), law.parameters());
    let name = axis.parameter.as_str();
    if !OF_THE_FLOW.contains(&name) && !own.iter().any(|parameter| parameter == name) {
        let valid = [own.join(", "), OF_THE_FLOW.join(", ")].join(", ");
        return Some(("parameter", format!("the {kind} law has no parameter {name}; an axis can be {valid}")));
    }
    axis.negative().map(|problem| ("from", problem))
}

/// Axes that are no parameters of a law.
const OF_THE_FLOW: [&str; 3] = ["d_gap", "headway", "k"];

/// A parameter of the law that is an axis need not be named: it has an arbitrary value until the cells set it.
fn place_holder(law: &mut Section, axis: &Axis, section: &Section, value: f64) {
    use files::reader::{Entry, Value};
    if !OF_THE_FLOW.contains(&axis.parameter.as_str()) {
        let line = section.entries.get("parameter").map_or(law.line, |entry| entry.line);
        law.entries.insert(axis.parameter.clone(), Entry::new(line, Value::Number(value)));
    }
}

impl Map {
    /// What keeps the map from being computed, if anything.
    fn complaint(&self) -> Option<String> {
        let has = |name| self.x.parameter == name || self.y.parameter == name;
        if self.value == Value::Criterion && !self.model.is_of_paper() {
            return Some(format!("{NO_CRITERION}; value must be \"margin\" (exact) or \"growth_rate\""));
        }
        if self.value == Value::GrowthRate && !has("k") && self.point.wave_number.is_none() {
            return Some("growth_rate needs a wave number: an axis k, or uniform.k".to_owned());
        }
        if self.value != Value::GrowthRate && (has("k") || self.point.wave_number.is_some()) {
            let name = if self.value == Value::Margin { "margin" } else { "criterion" };
            return Some(format!("the {name} is one for all waves: leave out k, or choose growth_rate"));
        }
        let gaps = [has("d_gap") || self.point.gap.is_some(), has("headway") || self.point.headway.is_some()];
        match (gaps, &self.model) {
            ([false, false], _) => {
                Some("needs the uniform flow: uniform.headway or uniform.d_gap, or an axis of it".to_owned())
            }
            ([true, true], _) => Some("headway and d_gap determine each other: give one of them".to_owned()),
            ([true, _], model) if !model.has_effective_gap() => {
                Some(format!("the {} law needs the headway, not d_gap", model.name()))
            }
            _ => None,
        }
    }

    /// The columns of its table.
    pub fn columns(&self) -> [&str; 3] {
        let value = match self.value {
            Value::Margin => "margin",
            Value::Criterion => "phi",
            Value::GrowthRate => "re_z",
        };
        [&self.x.parameter, &self.y.parameter, value]
    }

    /// Computes the map, column of cells by column of cells.
    ///
    /// # Errors
    /// Of 256 cells spread over the plane (of a small one: of all) none has a uniform flow and a finite value: the
    /// parameters of the first, and why. A cell has several uniform flows, of which the scene has to name one.
    pub fn compute(&self) -> Result<Computed, String> {
        self.compute_seen(&mut |_| ())
    }

    /// The same; before each cell, `onlooker` is called with the fraction of cells done.
    ///
    /// # Errors
    /// As [`Map::compute`].
    pub fn compute_seen(&self, onlooker: &mut dyn FnMut(f64)) -> Result<Computed, String> {
        self.has_values(onlooker)?;
        let mut table = Table::new(&self.columns());
        let (mut error, mut blank) = (0.0, Vec::new());
        let (mut undefined, mut first_undefined) = (0, None);
        let cells = self.x.cells * self.y.cells;
        for cell in 0..cells {
            onlooker(cell as f64 / cells as f64);
            let (x, y) = (self.x.centre(cell / self.y.cells), self.y.centre(cell % self.y.cells));
            let place = |why: &str| self.told([x, y], why);
            let (value, other) = match self.cell(x, y).and_then(finite) {
                Ok(values) => values,
                Err(Lack::Choice(why)) => return Err(place(&why)),
                Err(Lack::Value(why)) => {
                    first_undefined.get_or_insert_with(|| place(&why));
                    undefined += 1;
                    blank.push(cell);
                    continue;
                }
            };
            // relative where the value is large: there it lies far beyond the colours
            let size = |value: f64| if value.abs() > 1.0 { value.abs() } else { 1.0 };
            if self.value == Value::Criterion && (value - other).abs() > CRITERION_HOLDS * size(other) {
                blank.push(cell);
                continue;
            }
            let difference = (value - other).abs() / size(value);
            error = math::larger(error, difference);
            table.push(&[x, y, value]);
        }
        Ok(Computed { table, blank, undefined, first_undefined, error })
    }

    /// Whether cells spread over the plane have values: a plane of a heavy formula is not computed in whole to be
    /// refused.
    fn has_values(&self, onlooker: &mut dyn FnMut(f64)) -> Result<(), String> {
        let (places, mut first) = (spread([&self.x, &self.y]), None);
        for at in &places {
            onlooker(0.0);
            match self.cell(at[0], at[1]).and_then(finite) {
                Err(Lack::Value(why)) => first.get_or_insert_with(|| self.told(*at, &why)),
                // several speeds are told where the plane is computed
                Ok(_) | Err(Lack::Choice(_)) => return Ok(()),
            };
        }
        let first = first.unwrap_or_default();
        Err(format!("{first}; none of {} cells spread over the plane has a value", places.len()))
    }

    fn told(&self, [x, y]: [f64; 2], why: &str) -> String {
        format!("at {} = {x:?}, {} = {y:?}: {why}", self.x.parameter, self.y.parameter)
    }

    /// The value of a cell, and the same found another way.
    fn cell(&self, x: f64, y: f64) -> Result<(f64, f64), Lack> {
        let (mut of_law, mut point) = (Vec::new(), self.point);
        for (parameter, value) in [(&self.x.parameter, x), (&self.y.parameter, y)] {
            match parameter.as_str() {
                "d_gap" => point.gap = Some(value),
                "headway" => point.headway = Some(value),
                "k" => point.wave_number = Some(value),
                name => of_law.push((name, value)),
            }
        }
        let model = self.model.with_all(&of_law)?;
        if !model.is_of_paper() {
            return self.of_any_law(&model, &point);
        }
        let (criterion, linear) = stability(&model, &point)?;
        Ok(match self.value {
            Value::Margin => (linear.largest_margin(), precise(&model, &point)?.margin()),
            Value::Criterion => (criterion, criterion_of(&model, &linear)),
            Value::GrowthRate => {
                let k = point.wave_number.ok_or("needs a wave number")?;
                (linear.growth_rate(k), linear.refined_growth_rate(k))
            }
        })
    }

    /// The value of a cell of a law that is not the paper's, whose stencil may be any.
    fn of_any_law(&self, model: &Model, point: &Point) -> Result<(f64, f64), Lack> {
        let headway = point.headway.ok_or("needs the headway")?;
        let speed = uniform::nearest(model, headway, point.speed).map_err(|error| {
            let words = error.to_string();
            if error.speeds.is_empty() { Lack::Value(words) } else { Lack::Choice(words) }
        })?;
        let response = model.response(headway, speed).ok_or("the uniform flow lies on a kink, or has no derivative")?;
        let precise = || Precise::new(model, headway, speed);
        match self.value {
            Value::Margin => Ok((response.margin(Waves::All).0, precise().margin())),
            Value::GrowthRate => {
                let k = point.wave_number.ok_or("needs a wave number")?;
                Ok((response.growth_rate(k), precise().rounded().refined_growth_rate(k)))
            }
            Value::Criterion => Err(NO_CRITERION.into()),
        }
    }
}

/// Why a cell gets no value, in words.
enum Lack {
    /// It has none.
    Value(String),
    /// It has several, and the scene names none.
    Choice(String),
}

impl From<String> for Lack {
    fn from(why: String) -> Lack {
        Lack::Value(why)
    }
}

impl From<&str> for Lack {
    fn from(why: &str) -> Lack {
        Lack::Value(why.to_owned())
    }
}

/// The same pair, if both are numbers that a table can hold.
fn finite((value, other): (f64, f64)) -> Result<(f64, f64), Lack> {
    let why = "a number is too large or too small here";
    match (value.is_finite(), other.is_finite()) {
        (true, true) => Ok((value, other)),
        (false, _) => Err(Lack::Value(format!("the value is {value:?}: {why}"))),
        (true, false) => Err(Lack::Value(format!("the value found the other way is {other:?}: {why}"))),
    }
}

/// How the law answers at a point, to twice the digits.
fn precise(model: &Model, point: &Point) -> Result<Precise, String> {
    if let Some(gap) = point.gap {
        return Ok(Precise::at_gap(model, gap));
    }
    let headway = point.headway.ok_or("needs the headway")?;
    let speed = steady_speed(model, headway).map_err(|error| error.to_string())?;
    Ok(Precise::new(model, headway, speed))
}

/// The paper's criterion and the linearised law at a point.
fn stability(model: &Model, point: &Point) -> Result<(f64, Linear), String> {
    let steady = || {
        let headway = point.headway.ok_or("needs the headway")?;
        let speed = steady_speed(model, headway).map_err(|error| error.to_string())?;
        Ok::<_, String>((headway, speed))
    };
    Ok(match model {
        Model::Algebraic(law) => {
            let gap = point.gap.map_or_else(|| steady().map(|(headway, speed)| law.gap(headway, speed)), Ok)?;
            (criteria::algebraic(law, gap), law.linearise(gap))
        }
        Model::Exponential(law) => {
            let gap = point.gap.map_or_else(|| steady().map(|(headway, speed)| law.gap(headway, speed)), Ok)?;
            (criteria::exponential(law, gap), law.linearise(gap))
        }
        Model::Logarithmic(law) => {
            let (headway, speed) = steady()?;
            (criteria::logarithmic(law, headway, speed), law.linearise(headway, speed))
        }
        _ => return Err(NO_CRITERION.to_owned()),
    })
}

/// The exact criterion, normalised like the paper's, through the coefficients of the linearised law: `phi / (1 + 2
/// beta)
/// - kappa - 1/2`, which for the logarithmic law the paper divides once more by `1 + 2 beta`.
fn criterion_of(model: &Model, linear: &Linear) -> f64 {
    let Linear { phi, beta, kappa } = *linear;
    let widened = 1.0 + 2.0 * beta;
    match model {
        Model::Logarithmic(_) => (phi / widened - 0.5) / widened,
        _ => phi / widened - kappa - 0.5,
    }
}
