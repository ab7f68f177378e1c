//! The label language: plain text with math between dollar signs, read into a small tree.
//!
//! Inside dollars: letters and small Greek are italic, digits, capital Greek and signs upright;
//! blanks do not count; `_` and `^` take one item or a `{group}`; `'` is a prime.
//! Commands: Greek letters by name, `\tilde \hat \bar \dot \ddot`, `\mathrm{} \text{} \mathcal{}`,
//! `\langle \rangle \times \cdot \pm \le \ge \ne \approx \infty \partial \ell \to \ldots \Vert`,
//! the functions `\ln \exp \max \min \std \Re`, and the spaces `\,` `\;` `\quad`.

use crate::error::PlotError;

/// How an item is spaced from its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Ordinary,
    Binary,
    Relation,
    Opening,
    Punctuation,
}

/// One item of a label.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Node {
    /// One character.
    Glyph { character: char, italic: bool, kind: Kind },
    /// A gap, in em.
    Space(f64),
    /// A mark above one item.
    Accent { mark: char, base: Box<Node> },
    /// An item with primes, subscript and superscript.
    Scripts { base: Box<Node>, primes: usize, sub: Vec<Node>, sup: Vec<Node> },
    /// A group in braces or between dollars.
    Group(Vec<Node>),
}

/// Reads a label.
///
/// # Errors
/// [`PlotError::Markup`] with the place: an unknown command, an unclosed brace or dollar.
pub(crate) fn parse(label: &str) -> Result<Vec<Node>, PlotError> {
    let mut reader = Reader { label, characters: label.chars().collect(), place: 0 };
    let mut nodes = Vec::new();
    while let Some(character) = reader.next() {
        if character == '$' {
            nodes.push(Node::Group(reader.math('$', Letters::Italic)?));
        } else {
            nodes.push(ordinary(character, false));
        }
    }
    Ok(nodes)
}

/// Whether letters are set italic, as variables, or upright, as words.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Letters {
    Italic,
    Upright,
}

fn ordinary(character: char, italic: bool) -> Node {
    Node::Glyph { character, italic, kind: Kind::Ordinary }
}

struct Reader<'a> {
    label: &'a str,
    characters: Vec<char>,
    place: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.characters.get(self.place).copied()
    }

    fn next(&mut self) -> Option<char> {
        let character = self.peek();
        self.place += usize::from(character.is_some());
        character
    }

    fn fail<T>(&self, reason: impl Into<String>) -> Result<T, PlotError> {
        Err(PlotError::Markup { label: self.label.to_owned(), position: self.place, reason: reason.into() })
    }

    /// Items up to and with the closing character.
    fn math(&mut self, close: char, letters: Letters) -> Result<Vec<Node>, PlotError> {
        let mut nodes = Vec::new();
        loop {
            match self.peek() {
                None => return self.fail(format!("'{close}' expected before the end")),
                Some(character) if character == close => break,
                Some(' ') if letters == Letters::Italic => self.place += 1,
                Some(_) => {
                    let item = self.item(letters)?;
                    nodes.push(self.with_scripts(item, letters)?);
                }
            }
        }
        self.place += 1;
        Ok(nodes)
    }

    fn item(&mut self, letters: Letters) -> Result<Node, PlotError> {
        match self.next() {
            None => self.fail("an item expected before the end"),
            Some('{') => Ok(Node::Group(self.math('}', letters)?)),
            Some('\\') => self.command(letters),
            Some(character @ ('_' | '^' | '\'' | '$' | '}')) => {
                self.place -= 1;
                self.fail(format!("'{character}' has nothing before it that it could belong to"))
            }
            Some(character) => Ok(symbol(character, letters)),
        }
    }

    fn with_scripts(&mut self, base: Node, letters: Letters) -> Result<Node, PlotError> {
        let (mut primes, mut sub, mut sup) = (0, Vec::new(), Vec::new());
        while let Some(character @ ('\'' | '_' | '^')) = self.peek() {
            self.place += 1;
            match character {
                '\'' => primes += 1,
                '_' => sub.push(self.item(letters)?),
                _ => sup.push(self.item(letters)?),
            }
        }
        if primes == 0 && sub.is_empty() && sup.is_empty() {
            return Ok(base);
        }
        Ok(Node::Scripts { base: Box::new(base), primes, sub, sup })
    }

    fn command(&mut self, letters: Letters) -> Result<Node, PlotError> {
        let start = self.place;
        while self.peek().is_some_and(|c| c.is_ascii_alphabetic()) {
            self.place += 1;
        }
        let name: String = self.characters[start..self.place].iter().collect();
        if name.is_empty() {
            return match self.next() {
                Some(',') => Ok(Node::Space(0.17)),
                Some(';' | ' ') => Ok(Node::Space(0.28)),
                _ => self.fail("a command's name expected after '\\'"),
            };
        }
        // As in TeX, blanks after a command's name only end the name.
        while self.peek() == Some(' ') {
            self.place += 1;
        }
        if let Some(mark) = accent(&name) {
            return Ok(Node::Accent { mark, base: Box::new(self.item(letters)?) });
        }
        if let Some(node) = named(&name, letters) {
            return Ok(node);
        }
        match name.as_str() {
            "mathrm" | "text" => self.braced(Letters::Upright),
            // The vendored faces have no script capitals: italic stands in for them.
            "mathcal" | "mathit" => self.braced(Letters::Italic),
            _ => self.fail(format!("unknown command '\\{name}'")),
        }
    }

    fn braced(&mut self, letters: Letters) -> Result<Node, PlotError> {
        match self.next() {
            Some('{') => Ok(Node::Group(self.math('}', letters)?)),
            _ => self.fail("'{' expected"),
        }
    }
}

fn symbol(character: char, letters: Letters) -> Node {
    let (character, kind) = match character {
        '-' if letters == Letters::Italic => ('\u{2212}', Kind::Binary),
        '+' | '\u{2212}' => (character, Kind::Binary),
        '=' | '<' | '>' => (character, Kind::Relation),
        '(' | '[' => (character, Kind::Opening),
        ',' | ';' => (character, Kind::Punctuation),
        _ => (character, Kind::Ordinary),
    };
    let italic =
        letters == Letters::Italic && character.is_alphabetic() && !('\u{391}'..='\u{3a9}').contains(&character);
    Node::Glyph { character, italic, kind }
}

fn accent(name: &str) -> Option<char> {
    Some(match name {
        "tilde" => '\u{2dc}',
        "hat" => '\u{2c6}',
        "bar" => '\u{af}',
        "dot" => '\u{2d9}',
        "ddot" => '\u{a8}',
        _ => return None,
    })
}

fn named(name: &str, letters: Letters) -> Option<Node> {
    let signs: [(&str, char, Kind); 18] = [
        ("langle", '\u{27e8}', Kind::Opening),
        ("rangle", '\u{27e9}', Kind::Ordinary),
        ("times", '\u{d7}', Kind::Binary),
        ("cdot", '\u{b7}', Kind::Binary),
        ("pm", '\u{b1}', Kind::Binary),
        ("le", '\u{2264}', Kind::Relation),
        ("ge", '\u{2265}', Kind::Relation),
        ("ne", '\u{2260}', Kind::Relation),
        ("approx", '\u{2248}', Kind::Relation),
        ("to", '\u{2192}', Kind::Relation),
        ("in", '\u{2208}', Kind::Relation),
        ("infty", '\u{221e}', Kind::Ordinary),
        ("partial", '\u{2202}', Kind::Ordinary),
        ("ell", '\u{2113}', Kind::Ordinary),
        ("ldots", '\u{2026}', Kind::Ordinary),
        ("Vert", '\u{2016}', Kind::Ordinary),
        ("vert", '|', Kind::Ordinary),
        ("sqrt", '\u{221a}', Kind::Ordinary),
    ];
    if let Some(&(_, character, kind)) = signs.iter().find(|sign| sign.0 == name) {
        return Some(Node::Glyph { character, italic: false, kind });
    }
    if let "ln" | "exp" | "max" | "min" | "std" | "Re" | "Im" | "mod" = name {
        let mut word: Vec<Node> = name.chars().map(|c| ordinary(c, false)).collect();
        word.push(Node::Space(0.12));
        return Some(Node::Group(word));
    }
    if name == "quad" {
        return Some(Node::Space(1.0));
    }
    greek(name).map(|character| symbol(character, letters))
}

/// The Greek letter of a TeX name; a capital's name starts with a capital.
fn greek(name: &str) -> Option<char> {
    const NAMES: [&str; 24] = [
        "alpha",
        "beta",
        "gamma",
        "delta",
        "varepsilon",
        "zeta",
        "eta",
        "theta",
        "iota",
        "kappa",
        "lambda",
        "mu",
        "nu",
        "xi",
        "omicron",
        "pi",
        "rho",
        "",
        "sigma",
        "tau",
        "upsilon",
        "varphi",
        "chi",
        "psi",
    ];
    match name {
        "omega" => return Some('\u{3c9}'),
        "Omega" => return Some('\u{3a9}'),
        "epsilon" => return Some('\u{3f5}'),
        "phi" => return Some('\u{3d5}'),
        "Phi" => return Some('\u{3a6}'),
        "" => return None,
        _ => {}
    }
    let capital = name.starts_with(|c: char| c.is_ascii_uppercase());
    let index = NAMES.iter().position(|known| *known == name.to_ascii_lowercase())?;
    let first = if capital { 0x391 } else { 0x3b1 };
    char::from_u32(first + index as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn italic(character: char) -> Node {
        ordinary(character, true)
    }

    fn math(label: &str) -> Result<Vec<Node>, PlotError> {
        match parse(label)?.as_slice() {
            [Node::Group(nodes)] => Ok(nodes.clone()),
            other => panic!("{label}: {other:?}"),
        }
    }

    #[test]
    fn prime_and_subscript_share_their_base() -> Result<(), PlotError> {
        let expected =
            Node::Scripts { base: Box::new(italic('v')), primes: 1, sub: vec![ordinary('0', false)], sup: vec![] };
        for label in ["$v_0'$", "$v'_0$"] {
            assert_eq!(math(label)?, std::slice::from_ref(&expected), "{label}");
        }
        Ok(())
    }

    #[test]
    fn greek_names_give_their_letters() -> Result<(), PlotError> {
        let letters =
            [("mu", '\u{3bc}'), ("varepsilon", '\u{3b5}'), ("pi", '\u{3c0}'), ("omega", '\u{3c9}'), ("tau", '\u{3c4}')];
        for (name, character) in letters {
            assert_eq!(math(&format!("$\\{name}$"))?, [italic(character)], "{name}");
        }
        assert_eq!(math(r"$\Delta$")?, [ordinary('\u{394}', false)]);
        assert_eq!(math(r"$\Sigma$")?, [ordinary('\u{3a3}', false)]);
        Ok(())
    }

    #[test]
    fn faults_are_reported_with_their_place() {
        for (label, place) in [("$a", 2), (r"$\nonsense$", 10), ("$_a$", 1), (r"$\mathrm x$", 10), ("$x_$", 3)] {
            match parse(label) {
                Err(PlotError::Markup { position, .. }) => assert_eq!(position, place, "{label}"),
                other => panic!("{label}: {other:?}"),
            }
        }
    }
}
