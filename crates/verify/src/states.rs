//! Hashes of the state of all pedestrians at checkpoints of each run, to find where two runs part, and with whom.
//!
//! `data/states/SCENE.csv` has a line for each checkpoint: `t`; `state`, the first 16 digits of a rolling SHA-256 over
//! every sample (`t,n,x,v` as in a table of trajectories) from the start up to and with t; and `pedestrians`, four
//! digits for each pedestrian's sample at t itself. The rolling hash shows whether anything differed up to t; the short
//! ones show which pedestrians differ at t (one in 65536 is missed). A run that stores no trajectories is made once
//! more with them.

use crate::reference::Reference;
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{Paths, RUN_TABLES};
use checkout::process;
use checkout::request::MadeFigure;
use serde::Serialize;
use std::collections::BTreeMap;
use std::process::Command;

/// The header of a file of hashes.
const HEADER: &str = "t,state,pedestrians";
/// Digits of the rolling hash.
const DIGITS: usize = 16;
/// Digits for each pedestrian.
const SHORT: usize = 4;
/// Times of the first checkpoints: a difference spreads to all pedestrians within a few time units.
const EARLY: [u32; 5] = [1, 2, 5, 10, 20];
/// Time units between the later ones.
const EVERY: u32 = 50;

/// One checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// The time, as the table of trajectories writes it.
    pub t: String,
    /// The rolling hash.
    pub state: String,
    /// The short hash of each pedestrian, one after the other.
    pub pedestrians: String,
}

/// Where a run parts from the committed one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parted {
    /// The run, as in the table of events.
    pub scene: String,
    /// The last checkpoint up to which every sample is as committed; none when the first differs.
    pub same_until: Option<String>,
    /// The first checkpoint that differs.
    pub at: Option<String>,
    /// The pedestrians that differ there, counted from 0; empty if the difference occurs before it, or the run ends
    /// elsewhere.
    pub pedestrians: Vec<usize>,
    /// All pedestrians of the run.
    pub of: usize,
}

/// The hashes of a table of trajectories.
///
/// # Errors
/// It is not sorted by t with the same number of lines for each t.
pub fn of(trajectories: &str) -> Result<Vec<Checkpoint>, String> {
    let mut checkpoints: Vec<Checkpoint> = Vec::new();
    let (mut since, mut count) = (String::new(), None);
    let lines: Vec<&str> = trajectories.lines().skip(1).collect();
    let time = |line: &str| line.split(',').next().unwrap_or("").to_owned();
    let samples: Vec<&[&str]> = lines.chunk_by(|one, other| time(one) == time(other)).collect();
    for (index, sample) in samples.iter().enumerate() {
        let t = time(sample[0]);
        if *count.get_or_insert(sample.len()) != sample.len() {
            return Err(format!("expected {} pedestrians at t = {t}, found {}", samples[0].len(), sample.len()));
        }
        since.extend(sample.iter().flat_map(|line| [line, "\n"]));
        if is_checkpoint(&t) || index + 1 == samples.len() {
            let before = checkpoints.last().map_or("", |checkpoint| &checkpoint.state);
            let state = digits(format!("{before}\n{since}").as_bytes(), DIGITS);
            let pedestrians = sample.iter().map(|line| digits(line.as_bytes(), SHORT)).collect();
            checkpoints.push(Checkpoint { t, state, pedestrians });
            since.clear();
        }
    }
    Ok(checkpoints)
}

fn is_checkpoint(t: &str) -> bool {
    t.parse().is_ok_and(|t: u32| EARLY.contains(&t) || t.is_multiple_of(EVERY))
}

fn digits(bytes: &[u8], digits: usize) -> String {
    let mut hash = files::write::sha256(bytes);
    hash.truncate(digits);
    hash
}

/// The checkpoints as text.
pub fn to_csv(checkpoints: &[Checkpoint]) -> String {
    let line = |Checkpoint { t, state, pedestrians }: &Checkpoint| format!("{t},{state},{pedestrians}\n");
    format!("{HEADER}\n{}", checkpoints.iter().map(line).collect::<String>())
}

/// Reads what [`to_csv`] writes; `file` is only for messages.
///
/// # Errors
/// Usage: another header, or a line of another form, with its number.
pub fn parse(file: &str, text: &str) -> Result<Vec<Checkpoint>, Failure> {
    let mut checkpoints = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let fail = || Failure::Usage(format!("{file}:{}: expected {HEADER}, found {line:?}", index + 1));
        let cells: Vec<&str> = line.split(',').collect();
        let [t, state, pedestrians] = cells[..] else { return Err(fail()) };
        match index {
            0 if line != HEADER => return Err(fail()),
            0 => {}
            _ if state.len() != DIGITS || pedestrians.len() % SHORT != 0 => return Err(fail()),
            _ => checkpoints.push(Checkpoint { t: t.into(), state: state.into(), pedestrians: pedestrians.into() }),
        }
    }
    Ok(checkpoints)
}

/// Where two runs part; nothing when they do not.
pub fn compare(scene: &str, committed: &[Checkpoint], found: &[Checkpoint]) -> Option<Parted> {
    let differs = |index: &usize| committed.get(*index) != found.get(*index);
    let same = (0..committed.len().max(found.len())).find(differs)?;
    let (one, other) = (committed.get(same), found.get(same));
    let short = |checkpoint: Option<&Checkpoint>| -> Vec<String> {
        let text = checkpoint.map_or("", |checkpoint| &checkpoint.pedestrians);
        text.as_bytes().chunks(SHORT).map(|digits| String::from_utf8_lossy(digits).into_owned()).collect()
    };
    let (ours, theirs) = (short(one), short(other));
    let comparable = one.zip(other).is_some_and(|(one, other)| one.t == other.t);
    Some(Parted {
        scene: scene.to_owned(),
        same_until: same.checked_sub(1).map(|before| committed[before].t.clone()),
        at: one.or(other).map(|checkpoint| checkpoint.t.clone()),
        pedestrians: (0..ours.len()).filter(|&n| comparable && theirs.get(n) != ours.get(n)).collect(),
        of: pedestrians(committed).max(pedestrians(found)),
    })
}

/// All pedestrians of a run.
fn pedestrians(checkpoints: &[Checkpoint]) -> usize {
    checkpoints.first().map_or(0, |checkpoint| checkpoint.pedestrians.len() / SHORT)
}

/// Compares each run of a figure for which hashes are committed.
///
/// # Errors
/// A committed file is malformed, or a run cannot be made or read.
pub fn judge(
    paths: &Paths,
    made: &Paths,
    survey: &MadeFigure<'_>,
    reference: &Reference,
) -> Result<Vec<Parted>, Failure> {
    let mut parted = Vec::new();
    for (scene, panel, key) in own_runs(survey, &reference.scenes) {
        let name = Paths::states(scene);
        let Some(text) = disk::read_text(&paths.root.join(&name))? else { continue };
        let committed = parse(&name, &text)?;
        let found = of_run(made, survey, panel, key)?;
        parted.extend(compare(scene, &committed, &found));
    }
    Ok(parted)
}

/// The runs that are listed under this figure: scene, panel, key. A run that several figures share is judged once.
pub fn own_runs<'a>(
    survey: &'a MadeFigure<'_>,
    scenes: &'a BTreeMap<String, String>,
) -> impl Iterator<Item = (&'a str, &'a str, &'a str)> {
    let named = survey.runs.iter().filter_map(|(panel, key)| Some((scenes.get(key)?.as_str(), &**panel, &**key)));
    named.filter(|(scene, panel, _)| *scene == format!("{}-{panel}", survey.figure.id))
}

/// The hashes of a stored run; one without trajectories is made once more, with them.
///
/// # Errors
/// It cannot be made or read.
pub fn of_run(made: &Paths, survey: &MadeFigure<'_>, panel: &str, key: &str) -> Result<Vec<Checkpoint>, Failure> {
    let [_, trajectories] = RUN_TABLES;
    let stored = made.store().join(key).join(trajectories);
    let text = match disk::read_text(&stored)? {
        Some(text) => text,
        None => again(made, survey, panel)?,
    };
    of(&text).map_err(|problem| Failure::Failed(format!("{}, panel {panel}: {problem}", survey.figure.slug)))
}

/// Makes the run of a panel with its trajectories.
fn again(made: &Paths, survey: &MadeFigure<'_>, panel: &str) -> Result<String, Failure> {
    let [_, trajectories] = RUN_TABLES;
    let name = Paths::scene(&survey.figure.slug);
    let scene = disk::read_text(&made.root.join(&name))?.unwrap_or_default();
    let keep = |line: &str| match line.split_once('=') {
        Some((key, _)) if key.trim().ends_with("record") => line.replace("\"std\"", "\"trajectories\"") + "\n",
        _ => format!("{line}\n"),
    };
    let folder = made.own().join("states");
    let file = folder.join("scene.toml");
    disk::write(&file, scene.lines().map(keep).collect::<String>().as_bytes())?;
    let mut command = Command::new(made.binary("simulate"));
    command
        .arg(&file)
        .args(["--panel", panel, "--tables-only", "--no-check", "--out"])
        .arg(&folder)
        .current_dir(&made.root);
    let failed = || Failure::Failed(format!("{name}, panel {panel}: cannot be run with its trajectories"));
    process::output(&mut command).ok_or_else(failed)?;
    let text = disk::read_text(&folder.join(trajectories))?.ok_or_else(failed);
    disk::remove(&folder)?;
    text
}

impl Parted {
    /// In words.
    pub fn words(&self) -> String {
        let Parted { scene, same_until, at, pedestrians, of } = self;
        let until = same_until.as_deref().map_or("from the start".to_owned(), |t| format!("after t = {t}"));
        let first: Vec<String> = pedestrians.iter().take(5).map(usize::to_string).collect();
        let samples = match (at, pedestrians.len()) {
            (None, _) => "ends elsewhere".to_owned(),
            (Some(at), 0) => format!("parts {until}; by t = {at}"),
            (Some(at), count) => {
                let more = if count > 5 { " ..." } else { "" };
                format!("parts {until}; at t = {at} {count} of {of} pedestrians differ: {}{more}", first.join(" "))
            }
        };
        format!("run {scene} {samples}")
    }
}
