//! The article: number formats, the conditions under which it is refused, and reproducible bytes.

use checkout::figure;
use checkout::paths::{NUMBERS_JSON, NUMBERS_TEX, Paths};
use publish::article::DOCUMENT;
use publish::quantities::Quantities;
use publish::quantities::form::Form;
use publish::typeset::{self, Typesetter};
use std::fs;
use std::path::{Path, PathBuf};

fn checkout() -> Paths {
    Paths::find(Some(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))).expect("the checkout")
}

#[test]
fn numbers_are_written_as_far_as_they_are_known() {
    let written = |form: Form| (form.mantissa, form.exponent);
    let plain = |text: &str| (text.to_owned(), None);
    assert_eq!(written(Form::uncertain(960.8728468805091, 2.8e-12)), plain("960.872846880509(3)"));
    assert_eq!(written(Form::uncertain(12.34, 0.0961)), plain("12.3(1)"));
    assert_eq!(written(Form::uncertain(5.0, 0.0)), plain("5"));
    assert_eq!(written(Form::rounded(0.48881, 4)), plain("0.4888"));
    assert_eq!(written(Form::rounded(88123.0, 2)), plain("88000"));
    assert_eq!(written(Form::rounded(6.43e-12, 2)), ("6.4".to_owned(), Some(-12)));
    assert_eq!(written(Form::rounded(9.96e-5, 2)), ("1.0".to_owned(), Some(-4)));
    assert_eq!(written(Form::exact(1e-12)), ("1".to_owned(), Some(-12)));
    assert_eq!(written(Form::exact(0.01)), plain("0.01"));
    assert_eq!(written(Form::exact(2048001.0)), plain("2048001"));
    assert_eq!(Form::exact(1e-12).to_tex(), "\\ensuremath{10^{-12}}");
    assert_eq!(Form::rounded(6.43e-12, 2).to_tex(), "\\ensuremath{6.4\\times 10^{-12}}");
}

#[test]
fn committed_numbers_are_those_of_the_tables() {
    let paths = checkout();
    let all = figure::discover(&paths).expect("figures");
    // tables are generated; where they are not, there is nothing to compare with
    let numbers = match Quantities::collect(&paths, &all) {
        Err(failure) if failure.code() == 3 => return eprintln!("skipped: {}", failure.text()),
        collected => collected.expect("numbers"),
    };
    let committed = |name: &str| fs::read_to_string(paths.root.join(name)).expect("a committed file");
    assert!(numbers.to_json().expect("finite numbers") == committed(NUMBERS_JSON), "cargo xtask paper --bless");
    assert!(numbers.to_tex() == committed(NUMBERS_TEX), "cargo xtask paper --bless");
    assert!(numbers.by_name.len() > 500, "{}", numbers.by_name.len());
}

#[test]
fn every_printed_bracket_holds_the_reference_solution() {
    let text = fs::read_to_string(checkout().root.join(NUMBERS_JSON)).expect("the committed numbers");
    let numbers: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let numbers = numbers["numbers"].as_object().expect("numbers by name");
    let printed = |name: &str| numbers.get(name)?["mantissa"].as_str();
    let mut compared = 0;
    for name in numbers.keys() {
        let Some(start) = name.strip_suffix(".reference") else { continue };
        let Some(bracketed) = printed(&format!("{start}.t")) else { continue };
        let (value, digit) = bracketed.split_once('(').expect("a bracket");
        let decimals = value.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let bracket: f64 = format!("{}e-{decimals}", digit.trim_end_matches(')')).parse().expect("a number");
        let reference: f64 = printed(name).and_then(|text| text.parse().ok()).expect("a number");
        let off = (value.parse::<f64>().expect("a number") - reference).abs();
        // both are rounded to doubles
        assert!(off <= bracket + f64::EPSILON * reference, "{start}: {bracketed} is {off:e} away from {reference}");
        compared += 1;
    }
    assert_eq!(compared, 5, "events with a reference solution");
}

/// What the document is set from, copied to another place.
fn copy_of_sources(paths: &Paths, name: &str) -> Paths {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&root);
    let wanted = |path: &Path| {
        let text = path.to_string_lossy();
        [".typ", ".toml", ".csv", ".bib", ".json", ".svg", ".otf", ".py", ".txt"]
            .iter()
            .any(|ending| text.ends_with(ending))
    };
    for folder in ["paper", "figures", "crates/plot/fonts", "data", "data/accuracy"] {
        // of data only what lies at its top
        let files = checkout::disk::walk(&paths.root.join(folder), &|_| folder != "data").expect("a folder");
        for file in files.into_iter().filter(|file| wanted(file)) {
            let copy = root.join(file.strip_prefix(&paths.root).expect("below the root"));
            fs::create_dir_all(copy.parent().expect("a folder")).expect("a folder");
            fs::copy(&file, copy).expect("a copy");
        }
    }
    Paths { base: root.clone(), root, ..paths.clone() }
}

fn typesetter(paths: &Paths) -> Option<Typesetter> {
    // tests have no network: only what is there already
    typeset::at_hand(paths)
}

#[test]
fn the_document_has_the_same_bytes_in_another_folder() {
    let paths = checkout();
    let Some(typesetter) = typesetter(&paths) else {
        return eprintln!("skipped: no typesetter; cargo xtask paper installs one");
    };
    let output = |name: &str| -> PathBuf { Path::new(env!("CARGO_TARGET_TMPDIR")).join(name) };
    let copy = copy_of_sources(&paths, "paper copy ä");
    let (here, there) = (output("here.pdf"), output("there.pdf"));
    typesetter.set(&paths, DOCUMENT, &here, &[]).expect("set here");
    typesetter.set(&copy, DOCUMENT, &there, &[]).expect("set there");
    let (here, there) = (fs::read(here).expect("a PDF"), fs::read(there).expect("a PDF"));
    assert!(here == there, "{} and {} bytes", here.len(), there.len());
    let text = String::from_utf8_lossy(&here);
    assert!(!text.contains(&*copy.root.to_string_lossy()) && !text.contains(&*paths.root.to_string_lossy()));
}

#[test]
fn a_picture_without_words_is_refused_by_the_typesetter() {
    let paths = checkout();
    let Some(typesetter) = typesetter(&paths) else {
        return eprintln!("skipped: no typesetter; cargo xtask paper installs one");
    };
    let copy = copy_of_sources(&paths, "paper-mute");
    let file = copy.root.join("paper/pictures.typ");
    let text = fs::read_to_string(&file).expect("a source");
    fs::write(&file, text.replace("image(path, alt: alternatives.at(id), ", "image(path, ")).expect("a source");
    let failure = typesetter.set(&copy, DOCUMENT, &copy.root.join("x.pdf"), &[]).expect_err("no words");
    assert!(failure.text().contains("alt"), "{}", failure.text());
}
