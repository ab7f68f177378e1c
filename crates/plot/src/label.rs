//! Labels: plain text with mathematics between dollar signs, set glyph by glyph while it is read.
//!
//! Inside dollars: letters and small Greek are italic, digits, capital Greek and signs upright; blanks do not count;
//! `_` and `^` take one item or a `{group}`; `'` is a prime. Commands: Greek letters by name, `\tilde \hat \bar \dot`,
//! `\mathrm{} \text{}`, `\langle \rangle \times \le \ge \infty \Vert`, and the spaces `\,` `\;`.

use crate::error::PlotError;
use crate::font::{self, DIGIT_HEIGHT, SLANT, X_HEIGHT};
use crate::geometry::larger;
use tiny_skia::{Path, PathBuilder};

/// Size of sub- and superscripts relative to their base.
const SCRIPT_SIZE: f64 = 0.72;
/// Rise of a superscript's baseline, in em of the base.
const SUPERSCRIPT_RISE: f64 = 0.36;
/// Fall of a subscript's baseline, in em of the base.
const SUBSCRIPT_FALL: f64 = 0.17;
/// Space on either side of a binary sign and of a relation, in em.
const BINARY_SPACE: f64 = 0.18;
const RELATION_SPACE: f64 = 0.24;
/// Room above the baseline that a line of text takes, in em: tall letters, primes and most accents fit.
pub(crate) const LINE_TOP: f64 = 0.8;

/// A character at its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed {
    pub character: char,
    pub italic: bool,
    /// Size of the font.
    pub size: f64,
    /// Right of the label's left end.
    pub x: f64,
    /// Above the label's baseline.
    pub y: f64,
}

/// A typeset label; lengths in the unit of its font size.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Label {
    pub glyphs: Vec<Placed>,
    /// Advance width.
    pub width: f64,
    size: f64,
}

impl Label {
    /// Typesets a label at a font size.
    ///
    /// # Errors
    /// With the place: an unknown command, an unclosed brace or dollar; a character without a glyph.
    pub fn new(text: &str, size: f64) -> Result<Self, PlotError> {
        let mut setter =
            Setter { text, characters: text.chars().collect(), place: 0, glyphs: vec![], x: 0.0, overhang: 0.0 };
        while let Some(character) = setter.next() {
            match character {
                '$' => setter.math('$', Style { size, y: 0.0, italic: true, script: false })?,
                _ => setter.glyph(character, false, size, 0.0)?,
            }
        }
        Ok(Self { width: setter.x + setter.overhang, glyphs: setter.glyphs, size })
    }

    /// The top of the line above its baseline.
    pub fn line_top(&self) -> f64 {
        LINE_TOP * self.size
    }

    /// The middle of digits above the baseline.
    pub fn middle(&self) -> f64 {
        DIGIT_HEIGHT / 2.0 * self.size
    }

    /// The outline of all glyphs; `place` takes (right, down) from the start of the baseline to the page.
    ///
    /// # Errors
    /// The face lacks a character.
    pub fn outline(&self, place: impl Fn(f64, f64) -> (f32, f32)) -> Result<Option<Path>, PlotError> {
        let mut path = PathBuilder::new();
        for glyph in &self.glyphs {
            let on_page = |x: f64, y: f64| place(glyph.x + x * glyph.size, -glyph.y - y * glyph.size);
            font::outline(glyph.character, glyph.italic, &mut path, on_page)?;
        }
        Ok(path.finish())
    }
}

/// How mathematics is set at the moment.
#[derive(Clone, Copy)]
struct Style {
    size: f64,
    /// The baseline, above the label's.
    y: f64,
    /// Letters are italic, as variables; else upright, as words.
    italic: bool,
    /// Inside a script signs have no space around them.
    script: bool,
}

/// How a glyph is spaced from its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Ordinary,
    Binary,
    Relation,
    Opening,
    Punctuation,
}

/// What stands at a place of the text.
enum Symbol {
    Glyph {
        character: char,
        italic: bool,
        kind: Kind,
    },
    /// A gap, in em.
    Space(f64),
    /// A mark above the next item.
    Accent(char),
    /// A group in braces, now open; italic or not.
    Group(bool),
}

struct Setter<'a> {
    text: &'a str,
    characters: Vec<char>,
    /// Characters read.
    place: usize,
    glyphs: Vec<Placed>,
    x: f64,
    /// How far an italic before the cursor leans over it.
    overhang: f64,
}

impl Setter<'_> {
    fn peek(&self) -> Option<char> {
        self.characters.get(self.place).copied()
    }

    fn next(&mut self) -> Option<char> {
        let character = self.peek();
        self.place += usize::from(character.is_some());
        character
    }

    fn fail<T>(&self, reason: impl std::fmt::Display) -> Result<T, PlotError> {
        Err(PlotError(format!("label '{}', character {}: {reason}", self.text, self.place)))
    }

    fn skip(&mut self, width: f64) {
        if width != 0.0 {
            self.x += width;
            self.overhang = 0.0;
        }
    }

    fn glyph(&mut self, character: char, italic: bool, size: f64, y: f64) -> Result<(), PlotError> {
        let glyph = font::glyph(character, italic)?;
        if !italic {
            self.skip(self.overhang);
        }
        self.glyphs.push(Placed { character, italic, size, x: self.x, y });
        self.x += glyph.advance * size;
        self.overhang = if italic { glyph.overhang() * size } else { 0.0 };
        Ok(())
    }

    /// Sets items up to and with the closing character.
    fn math(&mut self, close: char, style: Style) -> Result<(), PlotError> {
        let mut before = Kind::Opening;
        loop {
            match self.peek() {
                None => return self.fail(format!("'{close}' expected before the end")),
                Some(character) if character == close => break,
                Some(' ') if style.italic => self.place += 1,
                Some(_) => {
                    before = self.item(before, style)?;
                    self.scripts(style)?;
                }
            }
        }
        self.place += 1;
        Ok(())
    }

    /// Sets one item without its scripts.
    fn item(&mut self, before: Kind, style: Style) -> Result<Kind, PlotError> {
        let Style { size, y, script, .. } = style;
        match self.symbol(style.italic)? {
            Symbol::Glyph { character, italic, kind } => {
                let has_scripts = matches!(self.peek(), Some('\'' | '_' | '^'));
                // a sign at the start or after another sign belongs to what follows it
                let is_unary = kind == Kind::Binary && before != Kind::Ordinary;
                let (ahead, behind) = match kind {
                    _ if script || is_unary || has_scripts => (0.0, 0.0),
                    Kind::Binary => (BINARY_SPACE, BINARY_SPACE),
                    Kind::Relation => (RELATION_SPACE, RELATION_SPACE),
                    Kind::Punctuation => (0.0, BINARY_SPACE),
                    Kind::Ordinary | Kind::Opening => (0.0, 0.0),
                };
                self.skip(ahead * size);
                self.glyph(character, italic, size, y)?;
                self.skip(behind * size);
                return Ok(if has_scripts { Kind::Ordinary } else { kind });
            }
            Symbol::Space(width) => self.skip(width * size),
            Symbol::Accent(mark) => self.accent(mark, style)?,
            Symbol::Group(italic) => self.math('}', Style { italic, ..style })?,
        }
        Ok(Kind::Ordinary)
    }

    /// Sets the next item, then a mark centred above its ink, along the slant if it is italic.
    fn accent(&mut self, mark: char, style: Style) -> Result<(), PlotError> {
        let (start, first) = (self.x, self.glyphs.len());
        self.item(Kind::Ordinary, style)?;
        let [base] = self.glyphs[first..] else { return self.fail("an accent goes above one letter") };
        let (after, overhang) = (self.x, self.overhang);
        let (letter, accent) = (font::glyph(base.character, base.italic)?, font::glyph(mark, false)?);
        let lean = if base.italic { SLANT * letter.top / 2.0 } else { 0.0 };
        let centre = (letter.left + letter.right) / 2.0 + lean;
        self.overhang = 0.0;
        self.x = start + (centre - (accent.left + accent.right) / 2.0) * style.size;
        self.glyph(mark, false, style.size, style.y + larger(letter.top - X_HEIGHT, 0.0) * style.size)?;
        (self.x, self.overhang) = (after, overhang);
        Ok(())
    }

    /// Sets primes and superscripts above, subscripts below, both starting behind the base.
    fn scripts(&mut self, Style { size, y, italic, .. }: Style) -> Result<(), PlotError> {
        let (mut below, mut above) = (self.x, self.x + self.overhang);
        let mut end = None;
        while let Some(character @ ('\'' | '_' | '^')) = self.peek() {
            self.place += 1;
            let (start, rise) = if character == '_' { (below, -SUBSCRIPT_FALL) } else { (above, SUPERSCRIPT_RISE) };
            (self.x, self.overhang) = (start, 0.0);
            match character {
                '\'' => self.glyph('\u{2032}', false, size, y)?,
                _ => {
                    let style = Style { size: size * SCRIPT_SIZE, y: y + rise * size, italic, script: true };
                    self.item(Kind::Ordinary, style)?;
                }
            }
            let cursor = if character == '_' { &mut below } else { &mut above };
            *cursor = self.x + self.overhang;
            end = Some(larger(end.unwrap_or(*cursor), *cursor));
        }
        if let Some(end) = end {
            (self.x, self.overhang) = (end, 0.0);
        }
        Ok(())
    }

    fn symbol(&mut self, italic: bool) -> Result<Symbol, PlotError> {
        match self.next() {
            None => self.fail("an item expected before the end"),
            Some('{') => Ok(Symbol::Group(italic)),
            Some('\\') => self.command(italic),
            Some(character @ ('_' | '^' | '\'' | '$' | '}')) => {
                self.place -= 1;
                self.fail(format!("'{character}' has nothing before it that it could belong to"))
            }
            Some(character) => Ok(letter_or_sign(character, italic)),
        }
    }

    fn command(&mut self, italic: bool) -> Result<Symbol, PlotError> {
        let start = self.place;
        while self.peek().is_some_and(|c| c.is_ascii_alphabetic()) {
            self.place += 1;
        }
        let name: String = self.characters[start..self.place].iter().collect();
        // as in TeX, blanks after a command's name only end the name
        while !name.is_empty() && self.peek() == Some(' ') {
            self.place += 1;
        }
        let sign = |character, kind| Ok(Symbol::Glyph { character, italic: false, kind });
        match name.as_str() {
            "" => match self.next() {
                Some(',') => Ok(Symbol::Space(0.17)),
                Some(';' | ' ') => Ok(Symbol::Space(0.28)),
                _ => self.fail("a command's name expected after '\\'"),
            },
            "tilde" => Ok(Symbol::Accent('\u{2dc}')),
            "hat" => Ok(Symbol::Accent('\u{2c6}')),
            "bar" => Ok(Symbol::Accent('\u{af}')),
            "dot" => Ok(Symbol::Accent('\u{2d9}')),
            "langle" => sign('\u{27e8}', Kind::Opening),
            "rangle" => sign('\u{27e9}', Kind::Ordinary),
            "times" => sign('\u{d7}', Kind::Binary),
            "le" => sign('\u{2264}', Kind::Relation),
            "ge" => sign('\u{2265}', Kind::Relation),
            "infty" => sign('\u{221e}', Kind::Ordinary),
            "Vert" => sign('\u{2016}', Kind::Ordinary),
            "mathrm" | "text" if self.peek() == Some('{') => {
                self.place += 1;
                Ok(Symbol::Group(false))
            }
            "mathrm" | "text" => self.fail("'{' expected"),
            _ => match greek(&name) {
                Some(character) => Ok(letter_or_sign(character, italic)),
                None => self.fail(format!("unknown command '\\{name}'")),
            },
        }
    }
}

fn letter_or_sign(character: char, italic: bool) -> Symbol {
    let (character, kind) = match character {
        '-' if italic => ('\u{2212}', Kind::Binary),
        '+' | '\u{2212}' => (character, Kind::Binary),
        '=' | '<' | '>' => (character, Kind::Relation),
        '(' | '[' => (character, Kind::Opening),
        ',' | ';' => (character, Kind::Punctuation),
        _ => (character, Kind::Ordinary),
    };
    let is_upright = !character.is_alphabetic() || ('\u{391}'..='\u{3a9}').contains(&character);
    Symbol::Glyph { character, italic: italic && !is_upright, kind }
}

/// The lower-case letters from U+03B1 on by their names in TeX; one form of sigma has none.
const GREEK: &str = "alpha beta gamma delta varepsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho - sigma \
                     tau upsilon varphi chi psi omega";

/// The Greek letter of a TeX name; a capital's name starts with a capital.
fn greek(name: &str) -> Option<char> {
    match name {
        "epsilon" => return Some('\u{3f5}'),
        "phi" => return Some('\u{3d5}'),
        "Phi" => return Some('\u{3a6}'),
        _ => {}
    }
    let capital = name.starts_with(|c: char| c.is_ascii_uppercase());
    let index = GREEK.split(' ').position(|known| known == name.to_ascii_lowercase())?;
    char::from_u32(if capital { 0x391 } else { 0x3b1 } + index as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(label: &Label, place: fn(f64, f64) -> (f32, f32)) -> Result<tiny_skia::Rect, PlotError> {
        Ok(label.outline(place)?.map(|path| path.bounds()).expect("letters have an outline"))
    }

    #[test]
    fn a_leading_sign_gets_no_space() -> Result<(), PlotError> {
        let negative = Label::new("$-4$", 1.0)?;
        let sum = font::glyph('\u{2212}', false)?.advance + font::glyph('4', false)?.advance;
        assert!((negative.width - sum).abs() < 1e-12, "{}", negative.width);
        assert!(Label::new("$3-4$", 1.0)?.width > sum + 2.0 * BINARY_SPACE);
        Ok(())
    }

    #[test]
    fn prime_and_subscript_start_behind_their_base_in_either_order() -> Result<(), PlotError> {
        let places = |text: &str| -> Result<Vec<(char, f64)>, PlotError> {
            let mut places: Vec<_> =
                Label::new(text, 1.0)?.glyphs.iter().map(|glyph| (glyph.character, glyph.x)).collect();
            places.sort_by_key(|place| place.0);
            Ok(places)
        };
        let found = places("$v_0'$")?;
        assert_eq!(found, places("$v'_0$")?);
        let behind = font::glyph('v', true)?.advance;
        assert!(found[0] == ('0', behind) && found[2].1 >= behind && found[2].1 < behind + 0.2, "{found:?}");
        Ok(())
    }

    #[test]
    fn greek_names_give_their_letters() -> Result<(), PlotError> {
        let letters = [("mu", '\u{3bc}', true), ("varepsilon", '\u{3b5}', true), ("omega", '\u{3c9}', true)];
        for (name, character, italic) in
            letters.into_iter().chain([("Delta", '\u{394}', false), ("Sigma", '\u{3a3}', false)])
        {
            let glyph = Label::new(&format!("$\\{name}$"), 1.0)?.glyphs[0];
            assert_eq!((glyph.character, glyph.italic), (character, italic), "{name}");
        }
        Ok(())
    }

    #[test]
    fn faults_are_reported_with_their_place() {
        for (text, place) in [("$a", 2), (r"$\nonsense$", 10), ("$_a$", 1), (r"$\mathrm x$", 9), ("$x_$", 3)] {
            let fault = Label::new(text, 1.0).expect_err(text).to_string();
            assert!(fault.contains(text) && fault.contains(&format!("character {place}:")), "{fault}");
        }
        assert!(Label::new(r"$\hat{ab}$", 1.0).is_err());
    }

    #[test]
    fn accents_sit_above_the_ink_of_their_letter() -> Result<(), PlotError> {
        let ink = |label: &Label, glyph: usize| {
            let alone = Label { glyphs: vec![label.glyphs[glyph]], ..Label::default() };
            bounds(&alone, |x, y| (x as f32, y as f32))
        };
        for text in [r"$\tilde a$", r"$\hat\Phi$", r"$\dot x$"] {
            let label = Label::new(text, 1000.0)?;
            let (letter, mark) = (ink(&label, 0)?, ink(&label, 1)?);
            assert!(mark.bottom() < letter.top(), "{text}: the mark touches the letter");
            let off = (mark.left() + mark.right() - letter.left() - letter.right()) / 2.0;
            assert!((-0.1..100.0).contains(&off), "{text}: the mark is {off} thousandths of an em off the middle");
        }
        Ok(())
    }

    #[test]
    fn outlines_turn_and_move_with_their_label() -> Result<(), PlotError> {
        let label = Label::new("T", 1000.0)?;
        let (level, upwards) =
            (bounds(&label, |x, y| (x as f32 + 50.0, y as f32))?, bounds(&label, |x, y| (y as f32, -x as f32))?);
        assert!(level.bottom().abs() < 5.0 && level.top() < -600.0, "{level:?}: not on the baseline");
        assert_eq!((upwards.left(), upwards.right()), (level.top(), level.bottom()));
        assert_eq!(upwards.bottom(), 50.0 - level.left());
        Ok(())
    }
}
