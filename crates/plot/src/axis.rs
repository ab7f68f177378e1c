//! An axis: its range, scale, and ticks at round numbers. It is a coordinate for plotters.

use crate::error::PlotError;
use crate::geometry::larger;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// Number of steps between ticks that an axis aims at, at most.
const STEPS: usize = 5;
/// As many steps, at most, an axis around values has from one round end to the other.
const ROUND_STEPS: usize = 8;
/// Room between values and an end, as a part of their range.
const HEADROOM: f64 = 0.03;
/// Smallest fraction of the range that still counts as reaching a tick at its end.
const SLACK: f64 = 1e-9;

/// An axis of a panel. Values are the data's own; `from` is drawn left or below.
#[derive(Debug, Clone)]
#[must_use]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) logarithmic: bool,
    steps: usize,
    own_ticks: Option<Vec<(f64, String)>>,
    numbered: bool,
}

/// A tick on an axis; a minor tick has no number.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub value: f64,
    pub text: Option<String>,
}

impl Axis {
    /// A linear axis from one finite value to a different one (falling is allowed). The label is in the markup of this
    /// crate; empty for none.
    pub fn linear(label: &str, from: f64, to: f64) -> Self {
        Self { label: label.to_owned(), from, to, logarithmic: false, steps: STEPS, own_ticks: None, numbered: true }
    }

    /// A logarithmic axis; both ends finite, positive and different.
    pub fn log10(label: &str, from: f64, to: f64) -> Self {
        Self { logarithmic: true, ..Self::linear(label, from, to) }
    }

    /// A linear axis that holds all finite values and ends at round numbers on both sides.
    pub fn around(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (mut low, mut high) = range(values.into_iter().filter(|value| value.is_finite())).unwrap_or((0.0, 1.0));
        if low == high {
            let half = if low == 0.0 { 1.0 } else { low.abs() / 2.0 };
            (low, high) = (low - half, high + half);
        }
        let step = Step::at_least((high - low) / ROUND_STEPS as f64);
        let down = (low / step.size() + SLACK).floor();
        let up = (high / step.size() - SLACK).ceil();
        Self::linear(label, step.times(down as i64), step.times(up as i64))
    }

    /// As [`Axis::around`], with room between the values and both ends, but none next to zero.
    pub fn roomy(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = range(values.into_iter().filter(|value| value.is_finite())).unwrap_or((0.0, 1.0));
        let room = |end: f64| if end == 0.0 { 0.0 } else { HEADROOM * (high - low) };
        Self::around(label, [low - room(low), high + room(high)])
    }

    /// [`Axis::roomy`] around the values and zero.
    pub fn from_zero(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        Self::roomy(label, values.into_iter().chain([0.0]))
    }

    /// A logarithmic axis of whole decades that holds all positive finite values.
    pub fn decades(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let positive = values.into_iter().filter(|value| value.is_finite() && *value > 0.0);
        let (low, high) = range(positive).unwrap_or((1.0, 10.0));
        let (from, to) = (decimal(1, decade(low)), round_up(high, &[1]));
        Self::log10(label, from, if to > from { to } else { from * 10.0 })
    }

    /// Aims at this many steps between ticks, at most; at least 1. Ignored by logarithmic axes.
    pub fn steps(mut self, steps: usize) -> Self {
        self.steps = steps.max(1);
        self
    }

    /// Uses these ticks (value and text in markup; an empty text makes a minor tick).
    pub fn ticks(mut self, ticks: &[(f64, &str)]) -> Self {
        self.own_ticks = Some(ticks.iter().map(|(value, text)| (*value, (*text).to_owned())).collect());
        self
    }

    /// Leaves out the numbers at the ticks: a neighbour in the grid has the same axis.
    pub fn without_numbers(mut self) -> Self {
        self.numbered = false;
        self
    }

    pub(crate) fn without_label(mut self) -> Self {
        self.label.clear();
        self
    }

    /// Whether the range can be drawn.
    ///
    /// # Errors
    /// An end is not finite, both are equal, or one is not positive on a logarithmic axis.
    pub(crate) fn check(&self) -> Result<(), PlotError> {
        let finite = self.from.is_finite() && self.to.is_finite() && self.from != self.to;
        let positive = !self.logarithmic || (self.from > 0.0 && self.to > 0.0);
        if finite && positive {
            return Ok(());
        }
        let valid = if self.logarithmic {
            "a logarithmic axis needs two different positive finite ends"
        } else {
            "an axis needs two different finite ends"
        };
        Err(PlotError::range(&self.label, self.from, self.to, valid))
    }

    /// Where a value lies: 0 at `from`, 1 at `to`; NaN if it has no place (not positive on a logarithmic axis).
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        if !self.logarithmic {
            return (value - self.from) / (self.to - self.from);
        }
        if value > 0.0 {
            let start = math::log10(self.from);
            (math::log10(value) - start) / (math::log10(self.to) - start)
        } else {
            f64::NAN
        }
    }

    /// The value at a fraction of a linear axis.
    pub(crate) fn value(&self, fraction: f64) -> f64 {
        self.from + fraction * (self.to - self.from)
    }

    /// The lower and the upper end.
    fn ends(&self) -> (f64, f64) {
        if self.from < self.to { (self.from, self.to) } else { (self.to, self.from) }
    }

    /// The label, with the power of ten that the numbers share.
    pub(crate) fn title(&self) -> String {
        let (low, high) = self.ends();
        match shared_power(low, high) {
            power if power != 0 && self.numbered && !self.logarithmic && self.own_ticks.is_none() => {
                format!("{} $/\\,10^{{{power}}}$", self.label).trim_start().to_owned()
            }
            _ => self.label.clone(),
        }
    }

    /// The same axis with fewer ticks, if there is one: fewer steps, or every other own tick.
    pub(crate) fn sparser(&self) -> Option<Self> {
        match &self.own_ticks {
            Some(own) if own.len() > 2 => {
                let kept = own.iter().step_by(2).cloned().collect();
                Some(Self { own_ticks: Some(kept), ..self.clone() })
            }
            None if !self.logarithmic && self.steps > 1 => Some(Self { steps: self.steps - 1, ..self.clone() }),
            _ => None,
        }
    }

    /// The ticks inside the range, in rising order.
    pub(crate) fn marks(&self) -> Vec<Tick> {
        let (low, high) = self.ends();
        let slack = SLACK * (high - low);
        let inside = |value: f64| value >= low - slack && value <= high + slack;
        if let Some(own) = &self.own_ticks {
            let text = |text: &String| Some(text.clone()).filter(|text| !text.is_empty());
            let marks = own.iter().filter(|(value, _)| inside(*value));
            return marks.map(|(value, name)| Tick { value: *value, text: text(name) }).collect();
        }
        let ticks = if self.logarithmic { logarithmic_ticks(low, high) } else { linear_ticks(low, high, self.steps) };
        let keep = |tick: Tick| if self.numbered { tick } else { Tick { text: None, ..tick } };
        ticks.into_iter().map(keep).collect()
    }
}

/// The place of a value that has none: not finite, or not positive on a logarithmic axis.
pub(crate) const NOWHERE: i32 = i32::MIN;

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (start, end): (i32, i32)) -> i32 {
        let place = f64::from(start) + self.fraction(*value) * (f64::from(end) - f64::from(start));
        // beyond the page, and as far as a line to there needs to know
        if place.is_finite() { place.round().clamp(-1e9, 1e9) as i32 } else { NOWHERE }
    }

    /// The ticks with a number; the minor ones as well where light points are asked for.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let light = hint.weight().allow_light_points();
        self.marks().into_iter().filter(|tick| light || tick.text.is_some()).map(|tick| tick.value).collect()
    }

    fn range(&self) -> Range<f64> {
        self.from..self.to
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        self.marks().into_iter().find(|tick| tick.value == *value).and_then(|tick| tick.text).unwrap_or_default()
    }
}

/// The least and the largest of numbers, if there are any.
fn range(numbers: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    numbers.fold(None, |range, number| match range {
        None => Some((number, number)),
        Some((low, high)) => Some((if number < low { number } else { low }, if number > high { number } else { high })),
    })
}

/// The least of some leading digits (rising, from 1) times a power of ten that is not below a size; 1 for the size 0.
pub(crate) fn round_up(size: f64, digits: &[i64]) -> f64 {
    if size <= 0.0 {
        return 1.0;
    }
    let exponent = decade(size);
    let mut candidates = digits.iter().map(|digit| decimal(*digit, exponent));
    candidates.find(|candidate| *candidate >= size).unwrap_or_else(|| decimal(1, exponent + 1))
}

/// A step of `mantissa` times ten to the `exponent`, mantissa 1, 2 or 5.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Step {
    mantissa: i64,
    exponent: i32,
}

impl Step {
    /// The smallest step that is not below `length` (finite, positive).
    fn at_least(length: f64) -> Self {
        let exponent = decade(length);
        let candidates = [(1, exponent), (2, exponent), (5, exponent), (1, exponent + 1)];
        let steps = candidates.map(|(mantissa, exponent)| Self { mantissa, exponent });
        let fits = |step: &&Self| step.size() >= length * (1.0 - SLACK);
        steps.iter().find(fits).copied().unwrap_or(steps[3])
    }

    fn size(self) -> f64 {
        self.times(1)
    }

    /// The double nearest to `count` steps.
    fn times(self, count: i64) -> f64 {
        decimal(count * self.mantissa, self.exponent)
    }
}

/// The double nearest to `mantissa` times ten to the `exponent`: reading a decimal rounds right.
fn decimal(mantissa: i64, exponent: i32) -> f64 {
    format!("{mantissa}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// The exponent of the decade a positive number lies in: 0 for 1 to below 10. Exact.
fn decade(value: f64) -> i32 {
    let text = format!("{value:e}");
    text.split('e').nth(1).and_then(|exponent| exponent.parse().ok()).unwrap_or(0)
}

fn linear_ticks(low: f64, high: f64, steps: usize) -> Vec<Tick> {
    let step = Step::at_least((high - low) / steps as f64);
    let slack = SLACK * (high - low) / step.size();
    let first = (low / step.size() - slack).ceil() as i64;
    let last = (high / step.size() + slack).floor() as i64;
    let power = shared_power(low, high);
    let mark =
        |count: i64| Tick { value: step.times(count), text: Some(number(count * step.mantissa, step.exponent, power)) };
    (first..=last).map(mark).collect()
}

/// The power of ten that the numbers of an axis share, named in its label: 0 where plain numbers are short enough.
fn shared_power(low: f64, high: f64) -> i32 {
    match decade(larger(low.abs(), high.abs())) {
        -2..=5 => 0,
        power => power,
    }
}

/// A tick's number over a power of ten, with as many decimals as its step.
fn number(mantissa: i64, exponent: i32, power: i32) -> String {
    let decimals = usize::try_from(power - exponent).unwrap_or(0);
    format!("{:.decimals$}", decimal(mantissa, exponent - power)).replace('-', "\u{2212}")
}

/// Ticks at decades, thinned to at most seven numbers; below two decades also at 2 and 5.
fn logarithmic_ticks(low: f64, high: f64) -> Vec<Tick> {
    let (first, last) = (decade(low), decade(high));
    let fine = high / low < 100.0;
    let stride = (1..).find(|stride| (last - first) / stride < 7).unwrap_or(1);
    let inside = |value: f64| value >= low * (1.0 - SLACK) && value <= high * (1.0 + SLACK);
    let plain = fine && first >= -3 && last <= 3;
    let mut ticks = Vec::new();
    for exponent in first..=last {
        for mantissa in 1..=9 {
            let value = decimal(mantissa, exponent);
            let numbered =
                if fine { matches!(mantissa, 1 | 2 | 5) } else { mantissa == 1 && exponent.rem_euclid(stride) == 0 };
            // Over many decades the marks between them would only be a grey band.
            let shown = numbered || mantissa == 1 || (stride == 1 && last - first < 7);
            if inside(value) && shown {
                ticks.push(Tick { value, text: numbered.then(|| power(mantissa, exponent, plain)) });
            }
        }
    }
    ticks
}

fn power(mantissa: i64, exponent: i32, plain: bool) -> String {
    if plain {
        return decimal(mantissa, exponent).to_string();
    }
    if mantissa == 1 { format!("$10^{{{exponent}}}$") } else { format!(r"${mantissa}\times10^{{{exponent}}}$") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis) -> Vec<String> {
        axis.marks().into_iter().filter_map(|tick| tick.text).collect()
    }

    #[test]
    fn ticks_are_round_and_share_their_decimals() {
        assert_eq!(texts(&Axis::linear("", 0.0, 1.0)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts(&Axis::linear("", 0.0, 3000.0)), ["0", "1000", "2000", "3000"]);
        assert_eq!(texts(&Axis::linear("", -0.5, 0.5)), ["\u{2212}0.4", "\u{2212}0.2", "0.0", "0.2", "0.4"]);
    }

    #[test]
    fn small_and_large_numbers_share_a_power_that_the_label_names() {
        let small = Axis::linear("std", 0.0, 2e-5);
        assert_eq!(texts(&small), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(small.title(), r"std $/\,10^{-5}$");
        assert_eq!(Axis::linear("", 0.0, 2e7).title(), r"$/\,10^{7}$");
        assert_eq!(Axis::linear("std", 0.0, 0.05).title(), "std");
    }

    #[test]
    fn a_narrow_range_keeps_plain_numbers() {
        let axis = Axis::linear("$d'$", 0.9999, 1.0001).steps(4);
        assert_eq!(texts(&axis), ["0.99990", "0.99995", "1.00000", "1.00005", "1.00010"]);
        assert_eq!(axis.title(), "$d'$");
    }

    #[test]
    fn plotters_finds_places_and_texts() {
        let axis = Axis::log10("", 1e-4, 1.0);
        assert_eq!(axis.map(&1e-2, (0, 1000)), 500);
        assert_eq!(axis.map(&1e-2, (1000, 0)), 500);
        assert_eq!((axis.map(&-1.0, (0, 1000)), axis.map(&f64::NAN, (0, 1000))), (NOWHERE, NOWHERE));
        assert!(axis.map(&1e300, (0, 1000)) > 1000);
        assert_eq!(axis.format_ext(&1e-3), "$10^{-3}$");
    }

    #[test]
    fn decades_are_thinned() {
        assert_eq!(texts(&Axis::log10("", 1e-3, 1.0)), ["$10^{-3}$", "$10^{-2}$", "$10^{-1}$", "$10^{0}$"]);
        assert_eq!(
            texts(&Axis::log10("", 1e-12, 1.0)),
            ["$10^{-12}$", "$10^{-10}$", "$10^{-8}$", "$10^{-6}$", "$10^{-4}$", "$10^{-2}$", "$10^{0}$"]
        );
        assert_eq!(texts(&Axis::log10("", 0.5, 5.0)), ["0.5", "1", "2", "5"]);
    }

    #[test]
    fn an_axis_around_values_ends_at_round_numbers() {
        let axis = Axis::around("", [0.13, f64::NAN, 2.7]);
        assert_eq!((axis.from, axis.to), (0.0, 3.0));
        let roomy = Axis::from_zero("", [0.3, 1.0]);
        assert_eq!((roomy.from, roomy.to), (0.0, 1.2));
        let level = Axis::around("", [2.0, 2.0]);
        assert!(level.from < 2.0 && level.to > 2.0);
        assert!(Axis::around("", []).check().is_ok());
    }

    #[test]
    fn places_on_a_logarithmic_axis() {
        let axis = Axis::log10("", 1e-4, 1.0);
        assert!((axis.fraction(1e-2) - 0.5).abs() < 1e-15);
        assert!(axis.fraction(0.0).is_nan() && axis.fraction(-1.0).is_nan());
    }

    #[test]
    fn useless_ranges_are_refused() {
        for axis in [Axis::linear("", 1.0, 1.0), Axis::linear("", 0.0, f64::NAN), Axis::log10("", 0.0, 1.0)] {
            assert!(axis.check().is_err(), "{axis:?}");
        }
    }
}
