//! The document: numerals in its text, how numbers are written, when it is refused, whether its bytes are always the same.

use crate::shop::{Shop, blessed};
use std::fs;
use std::path::{Path, PathBuf};
use xtask::figure;
use xtask::literals::{allowed, check, said, strays};
use xtask::paths::{DOCUMENT, NUMBERS_JSON, NUMBERS_TEX, Paths};
use xtask::quantities::Quantities;
use xtask::quantities::form::Form;
use xtask::typeset::{self, Typesetter};

fn numerals(text: &str) -> Vec<String> {
    strays(text).into_iter().map(|stray| stray.numeral).collect()
}

fn checkout() -> Paths {
    Paths::find(Some(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))).expect("the checkout")
}

#[test]
fn numbers_of_the_data_may_not_stand_in_text_captions_or_alternative_texts() {
    assert_eq!(numerals("The run ends at 960.87."), ["960.87"]);
    assert_eq!(numerals("#figure(caption: [With 67 pedestrians.])"), ["67"]);
    assert_eq!(numerals("#image(\"a.svg\", alt: \"133 paths\")"), ["133"]);
    assert_eq!(numerals("*bold 12* and _3_ and - 4"), ["12", "3", "4"]);
    assert_eq!(numerals("`0.4888` and `1e-12`").len(), 2);
    assert_eq!(numerals("#table([5], m($x$))"), ["5"]);
    assert_eq!(numerals("#let x = [6]\n#if a [7] else [8]"), ["6", "7", "8"]);
    assert_eq!(numerals("#str(0.25)"), ["0.25"]);
    assert_eq!(
        numerals("Fifteen figures, twenty-two methods, a hundred runs, two panels"),
        ["Fifteen", "twenty", "hundred"]
    );
}

#[test]
fn what_names_a_number_is_none() {
    for text in [
        "#n(\"fig04.room\") and #said(\"2000 s\") of @fig04, DOP853, RK4 <fig:4>",
        "#image(\"/figures/fig04.svg\", width: 100%)\n#v(1.5em) #columns(2)[a]",
        "// 12 in a comment\n/* 13 */ `figures/fig04` #link(\"../x\")[y]",
        "#include \"sections/01.typ\"\n#import \"a1-2.typ\": b",
        "#set heading(numbering: \"1.1\")",
        "#keys(\"0.1\", \"1e-5\").map(key => n(\"a.\" + key))",
        "#m($x = #said($10^(-5)$)$)",
    ] {
        assert_eq!(numerals(text), Vec::<String>::new(), "{text}");
    }
}

#[test]
fn mathematics_keeps_the_digits_of_its_structure_and_no_others() {
    for text in
        ["$z^2 + 2 phi (1 - e^(i k)) = 0$", "$1 / (2 N^2)$", "$a = 1$, $k = 2 pi l \\/ N$", "$x_(n+1)$", "$y < -1$"]
    {
        assert_eq!(numerals(text), Vec::<String>::new(), "{text}");
    }
    assert_eq!(numerals("$v_0 = 3$"), ["3"]);
    assert_eq!(numerals("$v_0 = 3, N = 67$"), ["3", "67"]);
    assert_eq!(numerals("$mu > 0.45 + x$"), ["0.45"]);
    assert_eq!(numerals("$d approx 2$"), ["2"]);
    assert_eq!(numerals("$x \"of 9 people\"$"), ["9"]);
}

#[test]
fn a_numeral_needs_a_reason_and_the_list_may_not_rot() {
    assert_eq!(allowed("# about\n[10#super | the base\n").expect("a list"), ["[10#super"]);
    assert_eq!(allowed("12 |  \n").expect_err("no reason").code(), 2);
    let shop = Shop::new("paper-numerals");
    let paths = Paths::find(Some(shop.root.clone())).expect("the shop");
    shop.write("paper/main.typ", "PDF/A-2a\n");
    assert!(check(&paths).expect_err("a numeral").text().contains("paper/main.typ:1: 2a"));
    shop.write("paper/numerals.txt", "PDF/A-2a | the name of a standard\n");
    check(&paths).expect("allowed");
    shop.write("paper/main.typ", "nothing\n");
    assert!(check(&paths).expect_err("an idle entry").text().contains("is not used"));
}

#[test]
fn what_was_measured_is_not_said() {
    assert_eq!(said("#said(\"2000 s\")\nand #said(\"0.45.\")"), [(1, "2000"), (2, "0.45")]);
    let shop = Shop::new("paper-said");
    let paths = Paths::find(Some(shop.root.clone())).expect("the shop");
    let numbers = r#"{"numbers": {"a": {"from": "data/x.csv", "mantissa": "960.87(3)"}, "b": {"from": "figures/x", "mantissa": "2000"}}}"#;
    shop.write("paper/numbers.json", numbers);
    shop.write("paper/main.typ", "#said(\"2000\")\n");
    check(&paths).expect("from a scene");
    shop.write("paper/main.typ", "\n#said(\"T = 960.87\")\n");
    let failure = check(&paths).expect_err("measured");
    assert!(failure.text().contains("paper/main.typ:2: 960.87 was measured"), "{}", failure.text());
}

#[test]
fn the_document_says_no_number_of_its_own() {
    check(&checkout()).expect("every numeral comes from the data");
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
fn the_document_is_refused_unless_the_figures_verify() {
    let shop = blessed("paper-gate");
    // it goes on to the typesetter, whose pins this checkout lacks
    let ended = shop.xtask(&["paper"]).expect(5);
    assert!(ended.err.contains("no typesetter") && ended.err.contains("install typst"), "{}", ended.err);
    let table = shop.read("data/fig05/left.csv");
    shop.write("data/fig05/left.csv", "a,phi\n0,7\n");
    let ended = shop.xtask(&["paper"]).expect(1);
    assert!(ended.err.contains("do not verify") && ended.err.contains("data/fig05/left.csv differs"), "{}", ended.err);
    shop.write("data/fig05/left.csv", &table);
    fs::remove_file(shop.root.join("figures/fig06-exponential-sway/fig06.svg")).expect("a picture");
    let ended = shop.xtask(&["paper"]).expect(1);
    assert!(ended.err.contains("fig06.svg missing"), "{}", ended.err);
    shop.xtask(&["figures", "6"]).expect(0);
    shop.edit("figures/fig04-growth/scene.toml", "mu = 0.5", "mu = 0.6");
    let ended = shop.xtask(&["paper"]).expect(3);
    assert!(ended.err.contains("do not verify, stale") && ended.err.contains("fig04"), "{}", ended.err);
}

#[test]
fn an_edited_picture_of_a_supplement_is_refused_too() {
    let shop = blessed("paper-gate-supplement");
    shop.xtask(&["figures", "--all"]).expect(1);
    shop.xtask(&["bless", "--all"]).expect(0);
    assert!(!shop.xtask(&["paper"]).expect(5).err.contains("do not verify"));
    shop.write("figures/s01-variant/s01.svg", "<svg>another</svg>");
    let ended = shop.xtask(&["paper"]).expect(1);
    assert!(ended.err.contains("s01.svg differs"), "{}", ended.err);
}

/// What the document is set from, copied to another place.
fn copy_of_sources(paths: &Paths, name: &str) -> Paths {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&root);
    let wanted = |path: &Path| {
        let text = path.to_string_lossy();
        [".typ", ".bib", ".json", ".svg", ".otf", ".py", ".txt"].iter().any(|ending| text.ends_with(ending))
    };
    for folder in ["paper", "figures", "crates/plot/fonts", "data"] {
        // of data only what lies at its top
        let files = xtask::disk::walk(&paths.root.join(folder), &|_| folder != "data").expect("a folder");
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
    typeset::at_hand(paths).and_then(|_| typeset::find(paths).ok())
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
    fs::write(&file, text.replace("image(path, alt: picture.alt, ", "image(path, ")).expect("a source");
    let failure = typesetter.set(&copy, DOCUMENT, &copy.root.join("x.pdf"), &[]).expect_err("no words");
    assert!(failure.text().contains("alt"), "{}", failure.text());
}
