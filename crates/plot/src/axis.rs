//! One axis: its range, its scale, and ticks at round numbers.

use crate::error::PlotError;

/// Number of steps between ticks that an axis aims at, at most.
const STEPS: usize = 5;
/// Smallest fraction of the range that still counts as reaching a tick at its end.
const SLACK: f64 = 1e-9;

/// An axis of a panel. Values are the data's own; `from` is drawn left or below.
#[derive(Debug, Clone)]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) logarithmic: bool,
    steps: usize,
    own_ticks: Option<Vec<(f64, String)>>,
    numbered: bool,
}

/// A mark on an axis; a minor one has no number.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub value: f64,
    pub text: Option<String>,
}

impl Axis {
    /// A linear axis from one finite value to a different one (falling is allowed).
    /// The label is in the markup of this crate; empty for none.
    #[must_use]
    pub fn linear(label: &str, from: f64, to: f64) -> Self {
        Self { label: label.to_owned(), from, to, logarithmic: false, steps: STEPS, own_ticks: None, numbered: true }
    }

    /// A logarithmic axis; both ends finite, positive and different.
    #[must_use]
    pub fn log10(label: &str, from: f64, to: f64) -> Self {
        Self { logarithmic: true, ..Self::linear(label, from, to) }
    }

    /// A linear axis that holds all finite values and ends at ticks on both sides.
    #[must_use]
    pub fn around(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.into_iter().filter(|value| value.is_finite()) {
            low = low.min(value);
            high = high.max(value);
        }
        if low > high {
            (low, high) = (0.0, 1.0);
        } else if low == high {
            let half = if low == 0.0 { 1.0 } else { low.abs() / 2.0 };
            (low, high) = (low - half, high + half);
        }
        let step = Step::at_least((high - low) / STEPS as f64);
        let down = (low / step.size() + SLACK).floor();
        let up = (high / step.size() - SLACK).ceil();
        Self::linear(label, step.times(down as i64), step.times(up as i64))
    }

    /// Aims at this many steps between ticks, at most; at least 1. Ignored by logarithmic axes.
    #[must_use]
    pub fn steps(mut self, steps: usize) -> Self {
        self.steps = steps.max(1);
        self
    }

    /// Uses these ticks (value and text in markup; an empty text makes a minor tick).
    #[must_use]
    pub fn ticks(mut self, ticks: &[(f64, &str)]) -> Self {
        self.own_ticks = Some(ticks.iter().map(|(value, text)| (*value, (*text).to_owned())).collect());
        self
    }

    /// Leaves out the numbers at the ticks: a neighbour in the grid has the same axis.
    #[must_use]
    pub fn without_numbers(mut self) -> Self {
        self.numbered = false;
        self
    }

    /// Whether the range can be drawn.
    ///
    /// # Errors
    /// [`PlotError::Range`] if an end is not finite, both are equal, or one is not positive on a
    /// logarithmic axis.
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
        Err(PlotError::Range { axis: self.label.clone(), from: self.from, to: self.to, valid })
    }

    /// Where a value lies: 0 at `from`, 1 at `to`; NaN if it has no place (not positive on a
    /// logarithmic axis).
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
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
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
    let largest = low.abs().max(high.abs());
    let mark = |count: i64| Tick {
        value: step.times(count),
        text: Some(number(count * step.mantissa, step.exponent, largest)),
    };
    (first..=last).map(mark).collect()
}

/// A tick's number, with as many decimals as its step; very small and very large axes share a power of ten.
fn number(mantissa: i64, exponent: i32, largest: f64) -> String {
    let plain = exponent >= -4 && largest < 1e6;
    if mantissa == 0 && !plain {
        return "0".to_owned();
    }
    let power = if plain { 0 } else { decade(largest) };
    let decimals = usize::try_from(power - exponent).unwrap_or(0);
    let digits = format!("{:.decimals$}", decimal(mantissa, exponent - power)).replace('-', "\u{2212}");
    if plain { digits } else { format!(r"${digits}\times10^{{{power}}}$") }
}

/// Ticks at decades, thinned to at most seven numbers; below two decades also at 2 and 5.
fn logarithmic_ticks(low: f64, high: f64) -> Vec<Tick> {
    let (first, last) = (decade(low), decade(high));
    let fine = high / low < 100.0;
    let stride = (1..).find(|stride| (last - first) / stride < 7).unwrap_or(1);
    let inside = |value: f64| value >= low * (1.0 - SLACK) && value <= high * (1.0 + SLACK);
    let mut ticks = Vec::new();
    for exponent in first..=last {
        for mantissa in 1..=9 {
            let value = decimal(mantissa, exponent);
            let numbered =
                if fine { matches!(mantissa, 1 | 2 | 5) } else { mantissa == 1 && exponent.rem_euclid(stride) == 0 };
            // Over many decades the marks between them would only be a grey band.
            let shown = numbered || mantissa == 1 || (stride == 1 && last - first < 7);
            if inside(value) && shown {
                ticks.push(Tick { value, text: numbered.then(|| power(mantissa, exponent, fine)) });
            }
        }
    }
    ticks
}

fn power(mantissa: i64, exponent: i32, fine: bool) -> String {
    if fine && (-3..=3).contains(&exponent) {
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
        assert_eq!(
            texts(&Axis::linear("", 0.0, 2e-5)),
            ["0", r"$0.5\times10^{-5}$", r"$1.0\times10^{-5}$", r"$1.5\times10^{-5}$", r"$2.0\times10^{-5}$"]
        );
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
    fn an_axis_around_values_ends_at_ticks() {
        let axis = Axis::around("", [0.13, f64::NAN, 2.7]);
        assert_eq!((axis.from, axis.to), (0.0, 3.0));
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
