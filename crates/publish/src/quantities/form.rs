//! The form in which a number is written: a text, or a mantissa and a power of ten.

/// A number as it is read: `mantissa` alone, or times ten to the `exponent`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Form {
    /// Digits, sign and point; an uncertainty of the last digit in brackets.
    pub mantissa: String,
    /// The power of ten; `None` for a number that is written out.
    pub exponent: Option<i32>,
}

/// Powers of ten from which on numbers are written with one.
const LARGE: i32 = 6;
/// Whole numbers below this are counts and written out.
const COUNTED: f64 = 1e9;
/// Powers of ten below which numbers are written with one.
const SMALL: i32 = -3;

impl Form {
    /// Every digit of the shortest text that reads back as the number: for parameters, tolerances and counts.
    pub fn exact(value: f64) -> Form {
        if value.fract() == 0.0 && value.abs() < COUNTED {
            return Form::plain(format!("{value}"));
        }
        let text = format!("{value:e}");
        let (mantissa, exponent) = split(&text);
        if (SMALL..LARGE).contains(&exponent) && !is_small_power(mantissa, exponent) {
            return Form::plain(format!("{value}"));
        }
        Form { mantissa: mantissa.to_owned(), exponent: Some(exponent) }
    }

    /// Rounded to `digits` significant digits, from 1.
    pub fn rounded(value: f64, digits: usize) -> Form {
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        let (mantissa, exponent) = split(&text);
        if value == 0.0 {
            return Form::plain("0".to_owned());
        }
        if (SMALL..LARGE).contains(&exponent) {
            let decimals = usize::try_from(digits as i64 - 1 - i64::from(exponent)).unwrap_or(0);
            // rounded in the same place, so that large numbers lose their digits too
            let rounded: f64 = text.parse().unwrap_or(value);
            return Form::plain(format!("{rounded:.decimals$}"));
        }
        Form { mantissa: mantissa.to_owned(), exponent: Some(exponent) }
    }

    /// Rounded where the error begins, which stands behind it in brackets: one digit, rounded up, in units of the last
    /// place. Without an error above 0, every digit.
    pub fn uncertain(value: f64, error: f64) -> Form {
        if !(error > 0.0 && error.is_finite()) {
            return Form::exact(value);
        }
        let text = format!("{error:e}");
        let (leading, mut place) = split(&text);
        let mut digit = leading.bytes().next().map_or(1, |byte| byte - b'0');
        if leading.bytes().skip(1).any(|byte| matches!(byte, b'1'..=b'9')) {
            digit += 1;
        }
        if digit == 10 {
            (digit, place) = (1, place + 1);
        }
        let decimals = usize::try_from(-place).unwrap_or(0);
        Form::plain(format!("{value:.decimals$}({digit})"))
    }

    /// A text that is not a number, or one written out.
    pub fn plain(text: String) -> Form {
        Form { mantissa: text, exponent: None }
    }

    /// The number in LaTeX, in text or in mathematics.
    pub fn to_tex(&self) -> String {
        match (self.mantissa.as_str(), self.exponent) {
            (text, None) => format!("\\ensuremath{{{text}}}"),
            ("1", Some(exponent)) => format!("\\ensuremath{{10^{{{exponent}}}}}"),
            (text, Some(exponent)) => format!("\\ensuremath{{{text}\\times 10^{{{exponent}}}}}"),
        }
    }
}

/// 1e-3 and the like: a bare power of ten reads better as one.
fn is_small_power(mantissa: &str, exponent: i32) -> bool {
    mantissa == "1" && exponent < -2
}

fn split(text: &str) -> (&str, i32) {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    (mantissa, exponent.parse().unwrap_or(0))
}
