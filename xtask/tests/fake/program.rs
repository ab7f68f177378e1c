//! Stands in for cargo, `simulate` and the figures' binaries in the runner's tests: what it does depends on the name it
//! is started by. Every call is noted in `calls.log` in the current folder.
//!
//! A scene whose title begins with `exit N` makes its figure end with that code. In the current folder, `full` names
//! programs that end with code 4 after half their work (`killed`: a run that leaves its checkpoint), `report.json` is
//! what figures without runs report, `spoil` holds lines `PROGRAM WHAT ROW` of what a program gets wrong (see
//! [`spoilt`]), `slow` makes every program last long enough to be measured.

use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::exit;

fn main() -> io::Result<()> {
    let arguments: Vec<String> = env::args().collect();
    let name = Path::new(&arguments[0]).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    // these are the real programs
    match name.as_str() {
        "verify" => exit(verify::cli::run(env::args_os())),
        "publish" => exit(publish::cli::run(env::args_os())),
        _ => {}
    }
    note(&name, &arguments)?;
    if Path::new("slow").exists() {
        std::thread::sleep(std::time::Duration::from_millis(40));
    }
    match name.as_str() {
        "cargo" if arguments.get(1).is_some_and(|verb| verb == "vendor") => vendor(&arguments),
        "cargo" if arguments.get(1).is_some_and(|verb| verb == "clean") => {
            fs::remove_dir_all(PathBuf::from(env::var("CARGO_TARGET_DIR").unwrap_or_default()).join("release"))
        }
        "cargo" => cargo(),
        "simulate" => simulate(&arguments),
        "map" => exit(3),
        "export" => fs::write("exported.txt", arguments[1..].join("\n")),
        "precision" | "hard" | "studies" => accuracy(&name, &arguments),
        _ => figure(&name, &arguments),
    }
}

fn note(name: &str, arguments: &[String]) -> io::Result<()> {
    // programs about the result are built whenever they are asked
    let is_quiet = |word: &str| ["verify", "publish", "interchange", "browser"].contains(&word);
    if name == "cargo" && value(arguments, "-p").is_some_and(|package| is_quiet(&package)) {
        return Ok(());
    }
    let mut log = fs::OpenOptions::new().create(true).append(true).open("calls.log")?;
    let panel = match arguments.get(1) {
        Some(verb) if verb == "clean" => verb.clone(),
        _ => value(arguments, "--panel").unwrap_or_default(),
    };
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
    for name in slugs.filter(|slug| slug.contains('-')).chain(
        ["simulate", "map", "sweep", "precision", "hard", "studies", "export", "verify", "publish"].map(str::to_owned),
    ) {
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
    fs::write(out.join("trajectories.csv"), trajectories(shift))?;
    let t: f64 = 12.5 + shift;
    let t = if spoilt("simulate", "event").is_some() { t.next_up() } else { t };
    fs::write(out.join("events.csv"), format!("event,t,n\noverlap,{t:?},7\n"))?;
    let tolerance = if shift > 0.0 { 1e-13 } else { 1e-11 };
    let summary = format!("\"method\": \"dop853\", \"control\": {{\"tolerance\": {tolerance:?}}}, \"steps\": 10");
    fs::write(out.join("summary.json"), format!("{{{summary}, \"length\": 200.0, \"seconds\": 0.1}}"))
}

/// Three pedestrians at 120 samples; `spoil` may ask that the second is wrong from a time on, and the third ten later.
fn trajectories(shift: f64) -> String {
    let from = spoilt("simulate", "state").unwrap_or(usize::MAX);
    let moved = |t: usize, n: usize| n > 0 && t >= from.saturating_add(10 * (n - 1));
    let value = |t: usize, n: usize| (t + n) as f64 + shift + if moved(t, n) { 1e-12 } else { 0.0 };
    let row = |t: usize, n: usize| format!("{t},{n},{:?},1\n", value(t, n));
    let rows = (0..120).flat_map(|t| (0..3).map(move |n| (t, n))).map(|(t, n)| row(t, n));
    format!("t,n,x,v\n{}", rows.collect::<String>())
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
    spoil_tables(id, &tables)?;
    fs::write(pictures.join(format!("{id}.png")), picture(count as u8, spoilt(id, "colours").is_some()))?;
    let text = if spoilt(id, "svg").is_some() { "other" } else { "curve" };
    fs::write(pictures.join(format!("{id}.svg")), format!("<svg>{text} {count}</svg>"))
}

/// The row for which the file `spoil` asks a program to get something wrong.
fn spoilt(program: &str, what: &str) -> Option<usize> {
    let text = fs::read_to_string("spoil").unwrap_or_default();
    let mut lines = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
    let row = lines.find(|words| words[..2] == [program, what])?.get(2).and_then(|row| row.parse().ok());
    Some(row.unwrap_or(0))
}

/// Moves one cell of each table by an `ulp`, flips its `sign`, `cut`s the table off behind the row, loses it (`gone`),
/// or puts a wrong word into it (`words`).
fn spoil_tables(id: &str, tables: &Path) -> io::Result<()> {
    for file in fs::read_dir(tables)?.map(|entry| entry.map(|entry| entry.path())).collect::<io::Result<Vec<_>>>()? {
        let text = fs::read_to_string(&file)?;
        let change = |row: usize, change: &dyn Fn(f64) -> f64| {
            let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
            if let Some((start, value)) = lines[row + 1].clone().rsplit_once(',') {
                lines[row + 1] = format!("{start},{:?}", change(value.parse().unwrap_or(0.0)));
            }
            fs::write(&file, lines.join("\n") + "\n")
        };
        if let Some(row) = spoilt(id, "ulp") {
            change(row, &f64::next_up)?;
        } else if let Some(row) = spoilt(id, "sign") {
            change(row, &|value| -value)?;
        } else if let Some(row) = spoilt(id, "cut") {
            fs::write(&file, text.lines().take(row + 1).map(|line| format!("{line}\n")).collect::<String>())?;
        } else if spoilt(id, "words").is_some() {
            fs::write(&file, "start,phi\none,1\nrondam,2\n")?;
        } else if spoilt(id, "gone").is_some() {
            fs::remove_file(&file)?;
        }
    }
    Ok(())
}

/// A PNG of 16 x 8 pixels: a bright band on a dark ground, or with red and blue `swapped`.
fn picture(count: u8, swapped: bool) -> Vec<u8> {
    let pixel = |index: u8| match (index / 16 == 3, swapped) {
        (false, _) => [40, 40, 40],
        (true, false) => [200, 100 + count, 20],
        (true, true) => [20, 100 + count, 200],
    };
    let pixels: Vec<u8> = (0..16 * 8).flat_map(pixel).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 16, 8);
    encoder.set_color(png::ColorType::Rgb);
    if let Ok(mut writer) = encoder.write_header() {
        writer.write_image_data(&pixels).expect("as many pixels as the header says");
    }
    bytes
}
