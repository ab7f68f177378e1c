//! Tests of the checks: each fault is reported at exactly its level.

use crate::shop::{Shop, blessed};
use serde_json::Value;
use verify::pixels::{self, Image};
use verify::verdict::Verdict;

const TOLERANCES: &str = "[[column]]\ntables = [\"fig04/*\", \"fig05/*\"]\ncolumns = [\"std\", \"phi\"]\n\
    absolute = 1e-15\nrelative = 1e-12\nrule = \"condition\"\nbecause = \"a test\"\n\n\
    [[event]]\nscene = \"fig04-stable\"\nabsolute = 1e-9\ngrowth = \"none\"\nperturbation = 1.0\nbecause = \"a test\"\n";

/// What `verify` says of a figure when a program gets something wrong.
fn spoil(shop: &Shop, spoil: &str, figure: &str) -> Value {
    shop.write("spoil", spoil);
    let said = shop.xtask(&["verify", figure, "--json"]).expect(1).json();
    std::fs::remove_file(shop.root.join("spoil")).expect("the file was there");
    said["figures"][0].clone()
}

/// Asserts the verdict and which of the three levels differ: bytes, numbers, pixels.
#[track_caller]
fn expect(said: &Value, verdict: Verdict, differs: [bool; 3]) {
    let found = ["bytes", "numbers", "pixels"].map(|level| said[level]["verdict"] == "differs");
    assert_eq!((said["verdict"].as_str(), found), (Some(verdict.word()), differs), "{said:#}");
}

fn checked(name: &str) -> Shop {
    let shop = blessed(name);
    shop.write("data/tolerances.toml", TOLERANCES);
    shop
}

#[test]
fn one_ulp_in_one_cell_is_other_bits() {
    let shop = checked("levels-ulp");
    let said = spoil(&shop, "fig04 ulp 4000\n", "4");
    expect(&said, Verdict::OtherBits, [true, true, false]);
    let table = &said["numbers"]["tables"]["stable.csv"];
    assert_eq!((table["cells"].as_i64(), table["ulp"]["value"].as_f64()), (Some(1), Some(1.0)));
    assert_eq!((table["ulp"]["row"].as_i64(), table["ulp"]["column"].as_str()), (Some(4000), Some("std")));
    assert_eq!(table["ulp"]["at"], "t = 4000");
    assert_eq!(
        (table["course"]["since"].as_f64(), table["course"]["course"].as_str()),
        (Some(4000.0), Some("in one row"))
    );
    assert_eq!((table["against"].as_str(), table["beyond"].as_i64()), (Some("table"), Some(0)));
}

#[test]
fn without_the_whole_table_the_samples_are_compared() {
    let shop = checked("levels-samples");
    std::fs::remove_dir_all(shop.root.join("data/fig04")).expect("tables");
    // every third row is committed
    let said = spoil(&shop, "fig04 ulp 3999\n", "4");
    expect(&said, Verdict::OtherBits, [true, true, false]);
    assert_eq!(said["numbers"]["tables"]["stable.csv"]["ulp"]["row"].as_i64(), Some(3999));
    let said = spoil(&shop, "fig04 sign 4000\n", "4");
    expect(&said, Verdict::Unlocated, [true, false, false]);
    assert_eq!(said["numbers"]["tables"]["stable.csv"]["against"], "sample");
}

#[test]
fn a_flipped_sign_is_other_physics() {
    let shop = checked("levels-sign");
    let said = spoil(&shop, "fig04 sign 4000\n", "4");
    expect(&said, Verdict::OtherPhysics, [true, true, false]);
    let table = &said["numbers"]["tables"]["unstable.csv"];
    assert_eq!((table["beyond"].as_i64(), table["furthest"]["row"].as_i64()), (Some(1), Some(4000)));
    expect(&spoil(&shop, "fig05 sign 0\n", "5"), Verdict::OtherPhysics, [true, true, false]);
}

#[test]
fn a_swapped_colour_map_is_another_rendering() {
    let shop = checked("levels-colours");
    let said = spoil(&shop, "fig04 colours\n", "4");
    expect(&said, Verdict::OtherRendering, [true, false, true]);
    let picture = &said["pixels"]["pictures"]["figures/fig04-growth/fig04.png"];
    assert_eq!((picture["changed"].as_i64(), picture["largest"].as_i64()), (Some(16), Some(180)));
    assert_eq!(picture["within"], serde_json::json!([0, 3, 15, 3]));
    assert!(picture["shares"].as_array().expect("a sweep").iter().all(|share| share.as_f64() == Some(0.125)));
    let files: Vec<&str> = picture["files"].as_array().expect("files").iter().filter_map(Value::as_str).collect();
    let images: Vec<Image> =
        files.iter().map(|file| Image::decode(&std::fs::read(file).expect("a picture")).expect("a PNG")).collect();
    assert_eq!((images.len(), pixels::compare(&images[0], &images[1]).expect("one size").changed), (3, 16));
}

#[test]
fn a_changed_svg_is_another_rendering_without_other_pixels() {
    let shop = checked("levels-svg");
    let said = spoil(&shop, "fig04 svg\n", "4");
    expect(&said, Verdict::OtherRendering, [true, false, true]);
    let pictures = said["pixels"]["pictures"].as_object().expect("pictures");
    assert_eq!(pictures.keys().collect::<Vec<_>>(), ["figures/fig04-growth/fig04.svg"]);
    assert_eq!(pictures["figures/fig04-growth/fig04.svg"]["first_byte"].as_i64(), Some(5));
}

#[test]
fn another_encoding_of_the_same_pixels_is_another_file() {
    let shop = checked("levels-encoding");
    let name = "figures/fig04-growth/fig04.png";
    let image = Image::decode(&shop.bytes(name)).expect("a PNG");
    let other = image.encode().expect("a PNG");
    let sums = shop.read("data/SHA256SUMS");
    let sum = |bytes: &[u8]| files::write::sha256(bytes);
    shop.write("data/SHA256SUMS", &sums.replace(&sum(&shop.bytes(name)), &sum(&other)));
    std::fs::write(shop.root.join(name), other).expect("a picture");
    let said = shop.xtask(&["verify", "4", "--json"]).expect(1).json();
    expect(&said["figures"][0], Verdict::OtherFile, [true, false, false]);
    shop.xtask(&["verify", "4", "--tolerant"]).expect(0);
}

#[test]
fn a_truncated_table_is_broken() {
    let shop = checked("levels-cut");
    let said = spoil(&shop, "fig04 cut 4000\n", "4");
    expect(&said, Verdict::Broken, [true, true, false]);
    assert_eq!(said["numbers"]["tables"]["stable.csv"]["unmatched"].as_i64(), Some(1000));
}

#[test]
fn a_missing_table_is_broken() {
    let shop = checked("levels-gone");
    let said = spoil(&shop, "fig04 gone\n", "4");
    expect(&said, Verdict::Broken, [true, true, false]);
    assert_eq!(said["bytes"]["files"]["data/fig04/stable.csv"], "missing");
}

#[test]
fn truncated_committed_files_contradict_their_sums() {
    let shop = checked("levels-committed");
    let sample = shop.read("data/golden/fig04/stable.csv");
    shop.write("data/golden/fig04/stable.csv", &sample[..sample.len() / 2]);
    let said = shop.xtask(&["verify", "4", "--json"]).expect(1).json();
    expect(&said["figures"][0], Verdict::Contradiction, [false, true, false]);
    shop.write("data/golden/fig04/stable.csv", &sample);
    // a picture whose bytes are lost cannot be compared, but what was made has the committed sum
    shop.write("figures/fig04-growth/fig04.png", "cut");
    shop.xtask(&["verify", "4"]).expect(0);
    let said = spoil(&shop, "fig04 colours\n", "4");
    expect(&said, Verdict::Broken, [true, false, true]);
}

#[test]
fn an_event_moved_by_one_ulp_is_other_bits() {
    let shop = checked("levels-event");
    let said = spoil(&shop, "simulate event\n", "4");
    // both runs of the figure have it, but only one has a tolerance
    expect(&said, Verdict::OtherPhysics, [true, true, false]);
    let both = TOLERANCES.replace(
        "[[event]]",
        "[[event]]\nscene = \"fig04-unstable\"\nabsolute = 1e-9\ngrowth = \
        \"none\"\nperturbation = 1.0\nbecause = \"a test\"\n\n[[event]]",
    );
    shop.write("data/tolerances.toml", &both);
    let said = spoil(&shop, "simulate event\n", "4");
    expect(&said, Verdict::OtherBits, [true, true, false]);
    assert_eq!(said["numbers"]["events"][0]["ulp"].as_i64(), Some(1));
    assert!(said["numbers"]["tables"]["stable.csv"]["cells"] == 0);
}

#[test]
fn tolerant_accepts_other_bits_and_no_other_physics() {
    let shop = checked("levels-tolerant");
    shop.write("spoil", "fig04 ulp 4000\n");
    shop.xtask(&["verify", "4"]).expect(1);
    let ended = shop.xtask(&["verify", "4", "--tolerant"]).expect(0);
    assert!(ended.out.contains("same numbers within tolerance, other bits"), "{}", ended.out);
    shop.write("spoil", "fig04 sign 4000\n");
    shop.xtask(&["verify", "4", "--tolerant"]).expect(1);
    shop.write("spoil", "fig06 ulp 0\n");
    // no tolerance is stated for figure 6
    shop.xtask(&["verify", "6", "--tolerant"]).expect(1);
}

#[test]
fn verify_works_in_an_empty_folder() {
    let shop = blessed("levels-empty");
    shop.xtask(&["clean"]).expect(0);
    for name in ["data/fig04", "data/fig05", "target/store", "target/xtask"] {
        let _ = std::fs::remove_dir_all(shop.root.join(name));
    }
    shop.xtask(&["verify"]).expect(0);
    let stored = std::fs::read_dir(shop.root.join("target/store")).into_iter().flatten().count();
    assert!(!shop.has("data/fig04") && stored == 0);
}

#[test]
fn the_first_checkpoint_and_pedestrian_that_part_are_named() {
    let shop = checked("levels-states");
    for (from, until, at, who) in
        [(0, None, "0", vec![1]), (15, Some("10"), "20", vec![1]), (45, Some("20"), "50", vec![1])]
    {
        let said = spoil(&shop, &format!("simulate state {from}\n"), "11");
        expect(&said, Verdict::OtherBits, [false, true, false]);
        let parted = &said["numbers"]["parted"][0];
        assert_eq!((parted["same_until"].as_str(), parted["at"].as_str()), (until, Some(at)), "{parted:#}");
        assert_eq!((&parted["pedestrians"], parted["of"].as_i64()), (&who.into(), Some(3)));
    }
    let ended = {
        shop.write("spoil", "simulate state 30\n");
        shop.xtask(&["verify", "11"]).expect(1)
    };
    let words = "run fig11-main parts after t = 20; at t = 50 2 of 3 pedestrians differ: 1 2";
    assert!(ended.out.contains(words), "{}", ended.out);
}

#[test]
fn another_word_in_a_table_is_infinitely_far() {
    let shop = checked("levels-word");
    let table = "start,phi\none,1\nrandom,2\n";
    let sum = |text: &str| files::write::sha256(text.as_bytes());
    shop.write("data/fig05/left.csv", table);
    shop.write("data/golden/fig05/left.csv", table);
    let sums = shop.read("data/SHA256SUMS");
    let line = sums.lines().find(|line| line.ends_with("fig05/left.csv")).expect("a sum").to_owned();
    shop.write("data/SHA256SUMS", &sums.replace(&line, &format!("{}  data/fig05/left.csv", sum(table))));
    // the figure makes a table of other columns
    let said = shop.xtask(&["verify", "5", "--json"]).expect(1).json();
    expect(&said["figures"][0], Verdict::Broken, [true, true, false]);
    assert!(said["figures"][0]["numbers"]["tables"]["left.csv"]["problem"].as_str().is_some());
    // and one of the same columns with another word
    shop.write("spoil", "fig05 words\n");
    let said = shop.xtask(&["verify", "5", "--json"]).expect(1).json();
    let compared = &said["figures"][0]["numbers"]["tables"]["left.csv"];
    assert_eq!((compared["cells"].as_i64(), compared["beyond"].as_i64()), (Some(1), Some(1)), "{compared:#}");
    assert_eq!(compared["furthest"]["column"], "start");
}
