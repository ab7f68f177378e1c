//! Typesetting: a label's tree becomes runs of text at fixed places, with known width and height.

use crate::error::PlotError;
use crate::font::{self, SLANT, X_HEIGHT};
use crate::markup::{self, Kind, Node};

/// Size of sub- and superscripts relative to their base.
const SCRIPT_SIZE: f64 = 0.72;
/// Rise of a superscript's baseline, in em of the base.
const SUPERSCRIPT_RISE: f64 = 0.36;
/// Fall of a subscript's baseline, in em of the base.
const SUBSCRIPT_FALL: f64 = 0.17;
/// Space on either side of a binary sign and of a relation, in em.
const BINARY_SPACE: f64 = 0.18;
const RELATION_SPACE: f64 = 0.24;

/// Characters of one face and size on one baseline.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    pub text: String,
    pub italic: bool,
    /// Size of the font in millimetres.
    pub size: f64,
    /// Start, in millimetres from the label's left end.
    pub x: f64,
    /// Baseline, in millimetres above the label's baseline.
    pub y: f64,
}

/// A typeset label; lengths in millimetres.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Label {
    pub runs: Vec<Run>,
    /// Advance width.
    pub width: f64,
    /// Height of the ink above the baseline.
    pub ascent: f64,
    /// Depth of the ink below the baseline.
    pub descent: f64,
}

impl Label {
    /// Typesets a label of the language of [`markup`] at a font size in millimetres.
    ///
    /// # Errors
    /// [`PlotError::Markup`] and [`PlotError::Glyph`].
    pub fn new(text: &str, size: f64) -> Result<Self, PlotError> {
        let mut setter = Setter { label: Self::default(), x: 0.0, overhang: 0.0, end: None };
        setter.set(&markup::parse(text)?, size, 0.0, false)?;
        setter.label.width = setter.x + setter.overhang;
        Ok(setter.label)
    }

    /// Ink height from lowest to highest point.
    pub fn height(&self) -> f64 {
        self.ascent + self.descent
    }
}

struct Setter {
    label: Label,
    x: f64,
    /// How far an italic before the cursor leans over it.
    overhang: f64,
    /// Where the last run ends, if the next character may join it.
    end: Option<f64>,
}

impl Setter {
    fn set(&mut self, nodes: &[Node], size: f64, y: f64, script: bool) -> Result<(), PlotError> {
        let mut before = Kind::Opening;
        for (index, node) in nodes.iter().enumerate() {
            let kind = kind_of(node);
            // A sign at the start or after another sign belongs to what follows it.
            let unary = kind == Kind::Binary && (before != Kind::Ordinary || index == 0);
            let space = match kind {
                _ if script || unary => 0.0,
                Kind::Binary => BINARY_SPACE * size,
                Kind::Relation => RELATION_SPACE * size,
                _ => 0.0,
            };
            self.skip(space);
            self.node(node, size, y, script)?;
            let after = if kind == Kind::Punctuation && !script { BINARY_SPACE * size } else { space };
            self.skip(after);
            before = kind;
        }
        Ok(())
    }

    fn node(&mut self, node: &Node, size: f64, y: f64, script: bool) -> Result<(), PlotError> {
        match node {
            Node::Glyph { character, italic, .. } => self.glyph(*character, *italic, size, y),
            Node::Space(width) => {
                self.skip(width * size);
                Ok(())
            }
            Node::Group(nodes) => self.set(nodes, size, y, script),
            Node::Accent { mark, base } => self.accent(*mark, base, size, y),
            Node::Scripts { base, primes, sub, sup } => {
                self.node(base, size, y, script)?;
                self.scripts(*primes, sub, sup, size, y)
            }
        }
    }

    fn skip(&mut self, width: f64) {
        if width != 0.0 {
            self.x += width;
            self.overhang = 0.0;
            self.end = None;
        }
    }

    fn glyph(&mut self, character: char, italic: bool, size: f64, y: f64) -> Result<(), PlotError> {
        let glyph = font::glyph(character, italic)?;
        if !italic && self.overhang > 0.0 {
            self.skip(self.overhang);
        }
        if character == ' ' {
            // SVG drops blanks at the ends of a text: a blank is a move.
            self.skip(glyph.advance * size);
            return Ok(());
        }
        self.push(character, italic, size, y);
        self.label.ascent = self.label.ascent.max(y + glyph.top * size);
        self.label.descent = self.label.descent.max(-y - glyph.bottom * size);
        self.x += glyph.advance * size;
        self.overhang = if italic { glyph.overhang() * size } else { 0.0 };
        self.end = Some(self.x);
        Ok(())
    }

    fn push(&mut self, character: char, italic: bool, size: f64, y: f64) {
        let joins = |run: &&mut Run| run.italic == italic && run.size == size && run.y == y;
        let last = self.label.runs.last_mut().filter(joins);
        match last {
            Some(run) if self.end.is_some() => run.text.push(character),
            _ => self.label.runs.push(Run { text: character.to_string(), italic, size, x: self.x, y }),
        }
    }

    /// Sets the base, then the mark centred above its ink, along the slant if it is italic.
    fn accent(&mut self, mark: char, base: &Node, size: f64, y: f64) -> Result<(), PlotError> {
        let start = self.x;
        self.node(base, size, y, false)?;
        let (after, overhang) = (self.x, self.overhang);
        let Some((character, italic)) = single(base) else {
            return Err(PlotError::Markup {
                label: mark.to_string(),
                position: 0,
                reason: "an accent goes above one letter".to_owned(),
            });
        };
        let (letter, accent) = (font::glyph(character, italic)?, font::glyph(mark, false)?);
        let lean = if italic { SLANT * letter.top / 2.0 } else { 0.0 };
        let centre = (letter.left + letter.right) / 2.0 + lean;
        let rise = (letter.top - X_HEIGHT).max(0.0);
        self.end = None;
        self.overhang = 0.0;
        self.x = start + (centre - (accent.left + accent.right) / 2.0) * size;
        self.glyph(mark, false, size, y + rise * size)?;
        (self.x, self.overhang, self.end) = (after, overhang, None);
        Ok(())
    }

    /// Sets primes and superscript above, subscript below, both starting behind the base.
    fn scripts(&mut self, primes: usize, sub: &[Node], sup: &[Node], size: f64, y: f64) -> Result<(), PlotError> {
        let (start, overhang) = (self.x, self.overhang);
        self.overhang = 0.0;
        self.end = None;
        self.set(sub, size * SCRIPT_SIZE, y - SUBSCRIPT_FALL * size, true)?;
        let below = self.x + self.overhang;
        (self.x, self.overhang, self.end) = (start + overhang, 0.0, None);
        for _ in 0..primes {
            self.glyph('\u{2032}', false, size, y)?;
        }
        self.end = None;
        self.set(sup, size * SCRIPT_SIZE, y + SUPERSCRIPT_RISE * size, true)?;
        let above = if primes == 0 && sup.is_empty() { start } else { self.x + self.overhang };
        (self.x, self.overhang, self.end) = (below.max(above), 0.0, None);
        Ok(())
    }
}

fn kind_of(node: &Node) -> Kind {
    match node {
        Node::Glyph { kind, .. } => *kind,
        _ => Kind::Ordinary,
    }
}

fn single(node: &Node) -> Option<(char, bool)> {
    match node {
        Node::Glyph { character, italic, .. } => Some((*character, *italic)),
        Node::Group(nodes) => match nodes.as_slice() {
            [only] => single(only),
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_in_one_run_and_blanks_become_moves() -> Result<(), PlotError> {
        let label = Label::new("two words", 1.0)?;
        let texts: Vec<&str> = label.runs.iter().map(|run| run.text.as_str()).collect();
        assert_eq!(texts, ["two", "words"]);
        assert_eq!(label.runs[0].x, 0.0);
        Ok(())
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
    fn accents_sit_above_the_ink_of_their_letter() -> Result<(), PlotError> {
        for (text, italic) in [(r"$\tilde a$", true), (r"$\hat\Phi$", false), (r"$\dot x$", true)] {
            let label = Label::new(text, 1.0)?;
            let (base, mark) = (&label.runs[0], &label.runs[1]);
            let letter = font::glyph(base.text.chars().next().unwrap_or(' '), italic)?;
            let accent = font::glyph(mark.text.chars().next().unwrap_or(' '), false)?;
            assert!(mark.y + accent.bottom > letter.top, "{text}: the mark touches the letter");
            let off = mark.x + (accent.left + accent.right) / 2.0 - (letter.left + letter.right) / 2.0;
            assert!((-1e-12..0.1).contains(&off), "{text}: the mark is {off} em off the middle");
        }
        Ok(())
    }
}
