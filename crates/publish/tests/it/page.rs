//! The page: its sources contain no measured number, what it repeats from other crates agrees with them, and it is made
//! from verified figures only. A browser tests its display (`checks/browser`).

use publish::page::{SCRIPTS, TEMPLATE, WORKER};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Numerals that may stand in the text: of the paper's reference, of licences, of figures and of the name of a hash.
const ALLOWED: [&str; 12] = ["256", "92", "042809", "2015", "10.1103", "92.042809", "2.0", "1", "10", "11", "12", "13"];
/// More digits than any number that somebody would choose.
const DIGITS: usize = 3;
/// Other numbers of so many digits: the largest byte, SHA-256, the code of a minus, all digits.
const CHOSEN: [&str; 4] = ["255", "256", "2212", "0123456789"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Runs of digits and points that do not belong to a name.
fn numerals(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut before = ' ';
    let mut now = String::new();
    for letter in text.chars().chain([' ']) {
        let goes_on = letter.is_ascii_digit() || (letter == '.' && !now.is_empty());
        if goes_on && (!now.is_empty() || !(before.is_alphanumeric() || before == '_')) {
            now.push(letter);
        } else {
            if !now.is_empty() {
                found.push(now.trim_end_matches('.').to_owned());
            }
            now.clear();
        }
        before = letter;
    }
    found
}

/// The text that a reader of the template sees: no tags, no slots.
fn visible(template: &str) -> String {
    let body = template.split_once("<body>").expect("a body").1;
    let mut text = String::new();
    for part in body.split('<') {
        text.push_str(part.split_once('>').map_or(part, |(_, rest)| rest));
        text.push(' ');
    }
    for (open, close) in [("{{", "}}"), ("{%", "%}"), ("{#", "#}")] {
        let parts = text.split(open).map(|part| part.split_once(close).map_or(part, |(_, rest)| rest));
        text = parts.collect();
    }
    text
}

/// Digits between the first and the last that is not zero.
fn significant(numeral: &str) -> usize {
    let digits: String = numeral.chars().filter(char::is_ascii_digit).collect();
    digits.trim_matches('0').len()
}

/// Lines of a source up to its tests, without colours and lengths in hexadecimal form.
fn code(text: &str) -> String {
    let code = text.split("#[cfg(test)]").next().unwrap_or("");
    code.replace("0x", "x_")
}

#[test]
fn numerals_are_found_where_they_stand() {
    assert_eq!(numerals("t = 960.87, fig12 and x_3; 2.9e-5."), ["960.87", "2.9", "5"]);
    assert_eq!(
        visible("<body>a 1<b title=\"2\">{{three[5]}}{% if six == 7 %} 4{% endif %}</b>")
            .split_whitespace()
            .collect::<String>(),
        "a14"
    );
    assert_eq!(["0.0500", "480", "960.87"].map(significant), [1, 2, 5]);
}

#[test]
fn no_number_of_the_text_is_typed_by_hand() {
    let strange: Vec<String> =
        numerals(&visible(TEMPLATE)).into_iter().filter(|numeral| !ALLOWED.contains(&numeral.as_str())).collect();
    assert!(strange.is_empty(), "in the template: {strange:?}; take numbers from the data by a slot");
}

#[test]
fn no_number_of_the_script_or_its_writer_is_a_measured_one() {
    let mut sources: Vec<(String, String)> =
        SCRIPTS.iter().chain(&WORKER).map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect();
    for file in fs::read_dir(root().join("crates/publish/src/page")).expect("sources").flatten() {
        if file.path().extension().is_some_and(|ending| ending == "rs") {
            let name = file.file_name().to_string_lossy().into_owned();
            sources.push((name, fs::read_to_string(file.path()).expect("a source")));
        }
    }
    assert!(sources.len() > 12);
    let measured = |numeral: &String| significant(numeral) >= DIGITS && !CHOSEN.contains(&numeral.as_str());
    let strange = sources.iter().flat_map(|(name, text)| {
        numerals(&code(text)).into_iter().filter(measured).map(move |numeral| format!("{name}: {numeral}"))
    });
    let strange: Vec<String> = strange.collect();
    assert!(strange.is_empty(), "{strange:?}; take numbers from the data");
}

#[test]
fn every_picture_has_words_without_numbers() {
    let text = read("paper/alternatives.toml");
    let lines: Vec<(&str, &str)> = text.lines().filter_map(|line| line.split_once(" = ")).collect();
    let described: BTreeSet<String> = lines.iter().map(|(id, _)| (*id).to_owned()).collect();
    let slugs = fs::read_dir(root().join("figures")).expect("figures").flatten();
    let slugs = slugs.filter(|folder| folder.path().join("scene.toml").is_file());
    let figures: BTreeSet<String> =
        slugs.filter_map(|folder| Some(folder.file_name().to_str()?.split('-').next()?.to_owned())).collect();
    assert_eq!(described, figures);
    for (id, words) in lines {
        assert!(words.len() > 60 && numerals(words).is_empty(), "{id}: {words}");
    }
}
