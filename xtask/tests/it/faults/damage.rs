//! Files of the store, records and outputs are damaged, cut off, lost, or have something else in their place.

use super::Tally;
use super::checkout::{Checkout, copy, entries, make_executable, remove};
use super::kills;
use super::random::Random;
use std::fs;
use std::os::unix::fs::symlink;
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

/// What is done to a file.
const HARMS: [&str; 8] =
    ["one bit", "cut off", "emptied", "lost", "a folder", "a dead link", "a link to another file", "a link to itself"];

/// A figure with two runs and their checks, both short; its number.
const FIGURE: &str = "7";

/// Damages each file of the stored runs, then has them used.
pub fn store(checkout: &Checkout, random: &mut Random, tally: &mut Tally) {
    checkout.forget(true);
    checkout.must_recover(&[FIGURE], "an emptied store");
    let runs: Vec<PathBuf> = entries(&checkout.target.join("store"));
    assert_eq!(runs.len(), 4, "{runs:?}");
    let mut count = 0;
    for run in &runs[..2] {
        for file in entries(run).into_iter().chain([run.clone()]) {
            for harm in HARMS {
                do_harm(&file, harm, random);
                checkout.forget(false);
                recover(checkout, &file, harm);
                count += 1;
            }
        }
    }
    // the list of sums ends before its last line, and the file it no longer names is wrong
    for run in &runs {
        let list = run.join("SHA256SUMS");
        let text = fs::read_to_string(&list).expect("sums");
        let lines: Vec<&str> = text.lines().collect();
        let (last, rest) = lines.split_last().expect("a line");
        fs::write(&list, rest.iter().map(|line| format!("{line}\n")).collect::<String>()).expect("a file");
        let name = last.split_once("  ").expect("a name").1;
        do_harm(&run.join(name), "one bit", random);
        checkout.forget(false);
        recover(checkout, &list, "without its last line");
        count += 1;
    }
    tally.add("stored runs damaged", count, "");
}

/// Damages the runner's own records.
pub fn records(checkout: &Checkout, random: &mut Random, tally: &mut Tally) {
    let mut count = 0;
    for name in [
        "state.json",
        "times.json",
        "build.json",
        "lock",
        "report/fig07.json",
        "report",
        "log",
        "log/fig07-exponential-std.txt",
    ] {
        let file = checkout.target.join("xtask").join(name);
        for harm in HARMS {
            let often = if harm == "one bit" && name.ends_with(".json") { 12 } else { 1 };
            for _ in 0..often {
                do_harm(&file, harm, random);
                recover(checkout, &file, harm);
                count += 1;
            }
        }
    }
    tally.add("records damaged", count, "");
}

/// Damages what a figure said of its accuracy: it is drawn and recorded, its errors are not in the manifest yet.
pub fn reports(checkout: &Checkout, random: &mut Random, tally: &mut Tally) {
    let program = checkout.target.join("release/simulate");
    let kept = checkout.target.join("release/simulate.kept");
    let report = checkout.target.join("xtask/report/fig05.json");
    for harm in HARMS {
        checkout.forget(true);
        fs::rename(&program, &kept).expect("a rename");
        fs::write(&program, "#!/bin/sh\nexec sleep 60\n").expect("a script");
        make_executable(&program);
        kill_when_recorded(checkout, "data/fig05");
        fs::rename(&kept, &program).expect("a rename");
        do_harm(&report, harm, random);
        checkout.must_recover(&["5"], &format!("{}: {harm}", report.display()));
    }
    tally.add("reports of accuracy damaged", HARMS.len(), "between drawing and measuring");
}

/// Kills a run of figure 5 and of one that takes long as soon as the record of the first is there.
fn kill_when_recorded(checkout: &Checkout, name: &str) {
    let mut command = checkout.command(&["5", FIGURE, "--jobs", "8"]);
    let mut child = command.process_group(0).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the runner");
    let state = checkout.target.join("xtask/state.json");
    while !fs::read_to_string(&state).is_ok_and(|text| text.contains(&format!("\"{name}\""))) {
        assert!(child.try_wait().expect("a child").is_none(), "the run ended before {name} was recorded");
        std::thread::sleep(Duration::from_millis(1));
    }
    kills::end(&mut child, false);
}

/// Damages tables and pictures.
pub fn outputs(checkout: &Checkout, random: &mut Random, tally: &mut Tally) {
    let mut count = 0;
    let names = [
        "data/fig07/stable.csv",
        "data/fig07",
        "figures/fig07-exponential-std/fig07.png",
        "figures/fig07-exponential-std/fig07.svg",
    ];
    for name in names {
        for harm in HARMS {
            do_harm(&checkout.root.join(name), harm, random);
            checkout.fresh_must_be_right(&format!("{name}: {harm}"));
            recover(checkout, &checkout.root.join(name), harm);
            count += 1;
        }
    }
    // something that no figure writes
    fs::write(checkout.root.join("data/fig07/other.csv"), "t,std\n0,0\n").expect("a file");
    recover(checkout, &checkout.root.join("data/fig07/other.csv"), "added");
    tally.add("outputs damaged", count + 1, "");
}

fn recover(checkout: &Checkout, file: &Path, harm: &str) {
    checkout.must_recover(&[FIGURE], &format!("{}: {harm}", file.display()));
}

fn do_harm(file: &Path, harm: &str, random: &mut Random) {
    // what an earlier harm has left and no run had to mend
    if fs::symlink_metadata(file).is_ok_and(|data| data.is_symlink()) {
        remove(file);
    }
    let parent = file.parent().expect("a folder");
    if !parent.is_dir() {
        remove(parent);
        fs::create_dir_all(parent).expect("a folder");
    }
    let is_folder = file.is_dir();
    match harm {
        "one bit" if !is_folder => {
            let mut bytes = fs::read(file).unwrap_or_default();
            if bytes.is_empty() {
                bytes.push(0);
            }
            let place = random.below(bytes.len());
            bytes[place] ^= 1 << random.below(8);
            fs::write(file, bytes).expect("a file");
        }
        "cut off" if !is_folder => {
            let bytes = fs::read(file).unwrap_or_default();
            let length = random.below(bytes.len());
            fs::write(file, &bytes[..length]).expect("a file");
        }
        "emptied" if is_folder => {
            remove(file);
            fs::create_dir(file).expect("a folder");
        }
        "a folder" if is_folder => {
            remove(file);
            fs::write(file, "a file in place of a folder").expect("a file");
        }
        "emptied" => fs::write(file, "").expect("a file"),
        "a folder" => {
            remove(file);
            fs::create_dir(file).expect("a folder");
            fs::write(file.join("inside"), "").expect("a file");
        }
        "a dead link" => relink(file, "nowhere"),
        "a link to itself" => relink(file, &file.file_name().unwrap_or_default().to_string_lossy()),
        "a link to another file" => relink(file, "/dev/null"),
        // a folder has no bits
        "one bit" | "cut off" | "lost" => remove(file),
        other => panic!("{other}"),
    }
}

fn relink(file: &Path, to: &str) {
    remove(file);
    symlink(to, file).expect("a link");
}

/// Folders and pictures are links to places elsewhere.
pub fn links(checkout: &Checkout, elsewhere: &Path, tally: &mut Tally) {
    let mut count = 0;
    for name in
        ["data", "target/store", "target/xtask", "target", "figures", "figures/fig07-exponential-std", "data/fig07"]
    {
        let (here, there) = (checkout.root.join(name), elsewhere.join(name));
        fs::create_dir_all(there.parent().expect("a folder")).expect("a folder");
        remove(&there);
        fs::rename(&here, &there).expect("a move");
        symlink(&there, &here).expect("a link");
        checkout.must_recover(&[FIGURE], &format!("a link in place of {name}"));
        checkout.forget(true);
        checkout.must_recover(&[FIGURE], &format!("a link in place of {name}, from nothing"));
        if fs::symlink_metadata(&here).is_ok_and(|data| data.is_symlink()) {
            remove(&here);
            fs::rename(&there, &here).expect("a move");
        }
        count += 1;
    }
    for ending in ["png", "svg"] {
        let picture = checkout.root.join(format!("figures/fig07-exponential-std/fig07.{ending}"));
        let there = elsewhere.join(format!("picture.{ending}"));
        copy(&picture, &there);
        relink(&picture, &there.to_string_lossy());
        checkout.must_recover(&[FIGURE], "a link in place of a picture");
        fs::write(&there, "another picture").expect("a file");
        checkout.must_recover(&[FIGURE], "a link to another picture");
        assert_eq!(fs::read(&there).expect("a file"), b"another picture", "a run wrote through a link");
        count += 2;
    }
    // the checkout itself through a link
    let link = elsewhere.join("link");
    symlink(&checkout.root, &link).expect("a link");
    checkout.at(&link).must_recover(&[FIGURE], "a link to the checkout");
    checkout.must_recover(&[], "links");
    tally.add("symbolic links", count + 1, "");
}
