//! The page on user-defined laws: its commands as printed, and its messages.

use crate::{binary, root};
use std::path::Path;
use std::process::{Command, Output};

fn page() -> String {
    std::fs::read_to_string(root().join("scenes/FORMULAS.md")).expect("the page")
}

/// The fenced blocks of a page: their language and text.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let mut all = Vec::new();
    let mut rest = page;
    while let Some((_, block)) = rest.split_once("\n```") {
        let (language, block) = block.split_once('\n').expect("a fence on a line of its own");
        let (text, after) = block.split_once("```\n").expect("a closed block");
        all.push((language, text));
        rest = after;
    }
    all
}

/// Runs a command of the page in a folder: `cargo xtask VERB` is the program VERB.
fn carry_out(command: &str, folder: &Path) -> Output {
    let mut words = command.split_whitespace();
    let program = match command.strip_prefix("cargo xtask ") {
        Some(_) => binary(words.nth(2).expect("a verb")),
        None => words.next().expect("a program").into(),
    };
    Command::new(program).args(words).current_dir(folder).output().expect("the program starts")
}

/// Without the seconds, which are those of the machine.
fn timeless(text: &str) -> String {
    let line = |line: &str| line.split_once(" right-hand sides, ").map_or(line, |(counts, _)| counts).to_owned();
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

fn with_scenes() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (_, text) in blocks(&page()).iter().filter(|(language, _)| *language == "toml") {
        let name =
            text.strip_prefix("# ").and_then(|text| text.split_once(':')).expect("a scene starts with its name").0;
        std::fs::write(folder.path().join(name), text).expect("a scene is written");
    }
    folder
}

#[test]
fn the_five_commands_print_what_the_page_says() {
    let (page, folder) = (page(), with_scenes());
    let blocks = blocks(&page);
    let commands: Vec<_> = blocks.windows(2).filter(|pair| pair[0].0 == "sh").collect();
    assert_eq!(commands.len(), 5);
    for pair in commands {
        let (command, expected) = (pair[0].1.trim(), pair[1].1);
        assert_eq!((pair[1].0, command.lines().count()), ("text", 1), "{command}");
        let output = carry_out(command, folder.path());
        assert!(output.status.success(), "{command}: {output:?}");
        assert_eq!(timeless(&String::from_utf8_lossy(&output.stdout)), timeless(expected), "{command}");
    }
    for file in ["my-map/main.csv", "my-map/main.png", "my-run/trajectories.csv", "my-run/summary.json"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
}

#[test]
fn every_message_of_the_page_is_that_of_its_mistake() {
    let folder = with_scenes();
    let scene = folder.path().join("my.toml");
    let good = std::fs::read_to_string(&scene).expect("the scene");
    let page = page();
    let (_, table) = page.split_once("| line | message |\n|---|---|\n").expect("the table of messages");
    let mut count = 0;
    for row in table.lines().filter(|row| row.starts_with("| ")) {
        let cells: Vec<&str> = row.trim_matches('|').split(" | ").map(|cell| cell.trim_matches([' ', '`'])).collect();
        let [line, message] = cells[..] else { panic!("{row}") };
        let key = line.split_once(' ').expect("a key").0;
        let is_this = |known: &&str| known.split_whitespace().next() == Some(key);
        let bad = match good.lines().find(is_this) {
            Some(known) => good.replacen(known, line, 1),
            None => good.replacen("\n\n[ring]", &format!("\n{line}\n\n[ring]"), 1),
        };
        assert_ne!(bad, good);
        std::fs::write(&scene, bad).expect("a scene is written");
        let output = carry_out("cargo xtask simulate my.toml --out out", folder.path());
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}: {told}");
        assert!(told.contains(message.trim_end_matches(['`', ' '])) && told.lines().count() == 1, "{line}: {told}");
        assert!(!folder.path().join("out").exists(), "{line}");
        count += 1;
    }
    assert!(count >= 7, "{count} messages");
}
