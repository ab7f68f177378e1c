//! Stands in for cargo, `simulate` and the figures' binaries in the runner's tests: what it does depends on the name it
//! is started by. Every call is noted in `calls.log` in the current folder.
//!
//! A scene whose title begins with `exit N` makes its figure end with that code. In the current folder, `full` names
//! programs that end with code 4 after half their work (`killed`: a run that leaves its checkpoint), `report.json` is
//! what figures without runs report.

use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::exit;

fn main() -> io::Result<()> {
    let arguments: Vec<String> = env::args().collect();
    let name = Path::new(&arguments[0]).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    note(&name, &arguments)?;
    match name.as_str() {
        "cargo" if arguments.get(1).is_some_and(|verb| verb == "vendor") => vendor(&arguments),
        "cargo" => cargo(),
        "simulate" => simulate(&arguments),
        "map" => exit(3),
        "export" => fs::write("exported.txt", arguments[1..].join("\n")),
        "precision" | "hard" | "studies" => accuracy(&name, &arguments),
        _ => figure(&name, &arguments),
    }
}

fn note(name: &str, arguments: &[String]) -> io::Result<()> {
    let mut log = fs::OpenOptions::new().create(true).append(true).open("calls.log")?;
    let panel = value(arguments, "--panel").unwrap_or_default();
    let check = if arguments.iter().any(|argument| argument == "--check") { " check" } else { "" };
    let scheme = if arguments.iter().any(|argument| argument == "--scheme") { " scheme" } else { "" };
    let resumed = if checkpoint(arguments).exists() { " resumed" } else { "" };
    log.write_all(format!("{name} {panel}{check}{scheme}{resumed}\n").as_bytes())
}

fn value(arguments: &[String], option: &str) -> Option<String> {
    let at = arguments.iter().position(|argument| argument == option)?;
    arguments.get(at + 1).cloned()
}

/// A table of two runs, or of the first alone with `--quick`.
fn accuracy(name: &str, arguments: &[String]) -> io::Result<()> {
    let out = PathBuf::from(value(arguments, "--out").unwrap_or_default());
    let part = value(arguments, "--only").map_or(String::new(), |part| format!("_{part}"));
    let mut text = "method,control,right_hand_sides,error_gap,error_speed\ndop853,1e-9,30,1e-7,1e-8\n".to_owned();
    if !arguments.iter().any(|argument| argument == "--quick") {
        text.push_str("dop853,1e-12,60,1e-9,1e-12\n");
    }
    fs::create_dir_all(&out)?;
    fs::write(out.join(format!("{name}{part}.csv")), text)
}

/// The file given by `--checkpoint`; without one a name that no file has.
fn checkpoint(arguments: &[String]) -> PathBuf {
    value(arguments, "--checkpoint").map_or_else(|| "no checkpoint".into(), PathBuf::from)
}

/// One crate in the folder that is named last.
fn vendor(arguments: &[String]) -> io::Result<()> {
    let folder = PathBuf::from(arguments.last().cloned().unwrap_or_default()).join("one-1.0.0/src");
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("lib.rs"), "//! vendored\n")
}

/// "Builds" every binary: a link to this one. A source that says so does not build.
fn cargo() -> io::Result<()> {
    if fs::read_to_string("crates/math/src/lib.rs")?.contains("broken") {
        exit(101);
    }
    let release = PathBuf::from(env::var("CARGO_TARGET_DIR").unwrap_or_default()).join("release");
    fs::create_dir_all(&release)?;
    let slugs = fs::read_dir("figures")?.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    for name in slugs
        .filter(|slug| slug.contains('-'))
        .chain(["simulate", "map", "precision", "hard", "studies", "export"].map(str::to_owned))
    {
        let binary = release.join(name);
        if !binary.exists() {
            fs::hard_link(env::current_exe()?, binary)?;
        }
    }
    Ok(())
}

/// Ends here, with half a table written, when the program is one of those for which the disk is full.
fn fill_disk(name: &str, half: &Path) -> io::Result<()> {
    if fs::read_to_string("full").is_ok_and(|names| names.split_whitespace().any(|one| one == name)) {
        fs::write(half, "t")?;
        eprintln!("no space left on device");
        exit(4);
    }
    Ok(())
}

/// A run of 5000 samples; the check is 1e-9 away. One that is sampled otherwise than its scene says is
/// to be exported: its scene is kept as `scene-run.txt`.
fn simulate(arguments: &[String]) -> io::Result<()> {
    let Some(out) = value(arguments, "--out").map(PathBuf::from) else { return Ok(()) };
    if let Some(interval) = value(arguments, "--sample") {
        fs::create_dir_all(&out)?;
        fs::copy(&arguments[1], "scene-run.txt")?;
        return fs::write(out.join("trajectories.csv"), interval);
    }
    let shift = if arguments.iter().any(|argument| argument == "--check") { 1e-9 } else { 0.0 };
    let rows: Vec<String> = (0..5000).map(|t| format!("{t},{:?}\n", f64::from(t % 3) + shift)).collect();
    let name = if shift > 0.0 { "check" } else { "simulate" };
    fill_disk(name, &out.join("half.csv"))?;
    let checkpoint = checkpoint(arguments);
    if checkpoint.exists() {
        eprintln!("resumed 0.5000");
        fs::remove_file(&checkpoint)?;
    } else if name == "simulate" {
        eprintln!("progress 0.5000");
        fill_disk("killed", &checkpoint)?;
    }
    fs::write(out.join("std.csv"), format!("t,std\n{}", rows.concat()))?;
    fs::write(out.join("events.csv"), format!("event,t,n\noverlap,{:?},7\n", 12.5 + shift))?;
    let tolerance = if shift > 0.0 { 1e-13 } else { 1e-11 };
    let summary = format!("\"method\": \"dop853\", \"control\": {{\"tolerance\": {tolerance:?}}}, \"steps\": 10");
    fs::write(out.join("summary.json"), format!("{{{summary}, \"length\": 200.0, \"seconds\": 0.1}}"))
}

/// Copies the curve of each run (or makes a table from the scene's title) and writes two pictures.
fn figure(name: &str, arguments: &[String]) -> io::Result<()> {
    let scene = fs::read_to_string(value(arguments, "--scene").unwrap_or_default())?;
    if let Some(rest) = scene.strip_prefix("title = \"exit ") {
        eprintln!("no space left on device");
        exit(rest.split(|c: char| !c.is_ascii_digit()).next().and_then(|code| code.parse().ok()).unwrap_or(4));
    }
    let tables = PathBuf::from(value(arguments, "--tables").unwrap_or_default());
    let pictures = PathBuf::from(value(arguments, "--pictures").unwrap_or_default());
    fill_disk(name, &tables.join("half.csv"))?;
    let runs = arguments.windows(2).filter(|pair| pair[0] == "--run").filter_map(|pair| pair[1].split_once('='));
    let mut count = 0;
    for (panel, folder) in runs {
        fs::copy(Path::new(folder).join("std.csv"), tables.join(format!("{panel}.csv")))?;
        count += 1;
    }
    if count == 0 {
        fs::write(tables.join("left.csv"), format!("a,phi\n0,{}\n", scene.len()))?;
        let report = r#"{"tables": {"left": {"error": {"phi": 1e-16}, "method": "closed form"}}}"#;
        let report = fs::read_to_string("report.json").unwrap_or_else(|_| report.to_owned());
        fs::write(value(arguments, "--report").unwrap_or_default(), report)?;
    }
    let id = name.split('-').next().unwrap_or("");
    fs::write(pictures.join(format!("{id}.png")), format!("picture {count}"))?;
    fs::write(pictures.join(format!("{id}.svg")), format!("<svg>{count}</svg>"))
}
