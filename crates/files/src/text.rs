//! Checks text that people or their programs wrote, and names what is wrong with it.

use std::io;
use std::path::Path;

/// The text of a file, without a byte order mark.
///
/// # Errors
/// It cannot be read, or is in another encoding than UTF-8: the line, counted from 1 (0: all of it), and the problem.
pub fn read(path: &Path) -> Result<String, (usize, String)> {
    let bytes = std::fs::read(path).map_err(|error| (0, told(&error)))?;
    decode(bytes)
}

fn told(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::IsADirectory => "is a folder; the name of a file is needed".to_owned(),
        _ => error.to_string(),
    }
}

/// Bytes as text, without a byte order mark.
///
/// # Errors
/// As [`read`].
pub fn decode(bytes: Vec<u8>) -> Result<String, (usize, String)> {
    const SAVE: &str = "save the file as UTF-8";
    const MARK: char = '\u{feff}';
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err((0, format!("the text is UTF-16; {SAVE}")));
    }
    let line = |offset: usize, bytes: &[u8]| 1 + bytes[..offset].iter().filter(|&&byte| byte == b'\n').count();
    if let Some(offset) = bytes.iter().position(|&byte| byte == 0) {
        let problem = format!("a byte 0: the text is UTF-16 or UTF-32, or no text; {SAVE}");
        return Err((line(offset, &bytes), problem));
    }
    match String::from_utf8(bytes) {
        Ok(text) if text.starts_with(MARK) => Ok(text[MARK.len_utf8()..].to_owned()),
        Ok(text) => Ok(text),
        Err(error) => {
            let offset = error.utf8_error().valid_up_to();
            let bytes = error.into_bytes();
            let found = bytes[offset];
            let problem = format!("byte 0x{found:02x} is not UTF-8 (Latin-1 or Windows-1252?); {SAVE}");
            Err((line(offset, &bytes), problem))
        }
    }
}

/// The reason why a cell or value is not a number, if it is a known one, and what to write instead.
pub fn hint(text: &str) -> Option<String> {
    let minus = |character: char| matches!(character, '\u{2212}' | '\u{2010}'..='\u{2014}' | '\u{fe63}' | '\u{ff0d}');
    let plain = text.replace(minus, "-").trim().replace(['\u{a0}', '\u{202f}', '\u{2009}'], "");
    let pointed = plain.replacen(',', ".", 1);
    let is_number = |text: &str| text.parse::<f64>().is_ok();
    if is_number(&plain) && text.contains(minus) {
        return Some(format!("a typographic minus sign; write {plain}"));
    }
    if plain.matches(',').count() == 1 && is_number(&pointed) {
        return Some(format!("a decimal comma; write {pointed}"));
    }
    (is_number(&plain) && plain != text).then(|| format!("spaces around or in the number; write {plain}"))
}

/// The hint that fits the first word of a line for which there is one: for what a parser of another language refused.
pub fn hint_in(line: &str) -> Option<String> {
    let words = line.split(|character: char| character == '=' || character.is_ascii_whitespace());
    words.map(|word| word.trim_matches(['[', ']', '{', '}'])).find_map(hint)
}
