//! The first step in which a run differs from the committed one, and who differs in it.
//!
//! `data/steps/SCENE.csv` has a print of every accepted step ([`files::steps`], which says how often one is mistaken): the
//! program that makes the run writes them with the end of each step, and `bless` keeps the prints. Only runs by steps of
//! adaptive length have them.

use crate::disk;
use crate::failure::Failure;
use crate::paths::{Paths, RUN_STEPS};
use crate::store;
use files::steps::{self, Change, Print};
use serde::Serialize;

/// What the steps of a run say.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Steps {
    /// None are committed.
    NotKept,
    /// Every step is the committed one.
    Same,
    /// From one on they are others.
    Part(Part),
}

/// The first step that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part {
    /// Its number, from 1; 0 is the state at the start.
    pub step: usize,
    /// The steps of the committed run.
    pub of: usize,
    /// Where it begins, in both runs; none for the start.
    pub from: Option<String>,
    /// Where it ends in the run that was made; none if that has no such step.
    pub to: Option<String>,
    /// Whether it has the committed length.
    pub same_length: bool,
    /// Who differs at its end, if it is one alone, from 0.
    pub pedestrian: Option<usize>,
    /// What differs, in words.
    pub what: String,
}

/// A run's own steps: the end of each, as text, and its print.
type Made = Vec<(String, Print)>;

/// Compares the steps of a stored run with the committed ones.
///
/// # Errors
/// Usage: the committed file is malformed. Failed: the stored one is, or a file cannot be read.
pub fn judge(paths: &Paths, made: &Paths, scene: &str, key: &str, pedestrians: usize) -> Result<Steps, Failure> {
    let name = Paths::steps(scene);
    let Some(text) = disk::read_text(&paths.root.join(&name))? else { return Ok(Steps::NotKept) };
    let malformed = |line| Failure::Usage(format!("{name}:{line}: not the prints of steps"));
    let committed = steps::parse(&text).map_err(malformed)?;
    let found = of_run(made, key)?.unwrap_or_default();
    Ok(compare(&committed, &found, pedestrians))
}

/// The committed form of the steps of a stored run; nothing for one by steps of fixed length.
///
/// # Errors
/// They cannot be read.
pub fn to_keep(made: &Paths, key: &str) -> Result<Option<String>, Failure> {
    let prints = |made: Made| made.into_iter().map(|(_, print)| print).collect::<Vec<_>>();
    Ok(of_run(made, key)?.map(|made| steps::to_csv(&prints(made))))
}

fn of_run(made: &Paths, key: &str) -> Result<Option<Made>, Failure> {
    let file = store::folder(made, key).join(RUN_STEPS);
    let Some(text) = disk::read_text(&file)? else { return Ok(None) };
    let read = |line: &str| line.split_once(',').and_then(|(t, print)| Some((t.to_owned(), Print::parse(print)?)));
    let lines = text.lines().skip(1).enumerate();
    let malformed = |index: usize| Failure::Failed(format!("{}:{}: not a print of a step", file.display(), index + 2));
    lines.map(|(index, line)| read(line).ok_or_else(|| malformed(index))).collect::<Result<_, _>>().map(Some)
}

fn compare(committed: &[Print], found: &[(String, Print)], pedestrians: usize) -> Steps {
    let prints: Vec<Print> = found.iter().map(|(_, print)| *print).collect();
    let Some((step, change)) = steps::first_change(committed, &prints, pedestrians) else { return Steps::Same };
    let end = |step: usize| found.get(step).map(|(t, _)| t.clone());
    let (of, taken) = (committed.len().saturating_sub(1), found.len().saturating_sub(1));
    Steps::Part(Part {
        step,
        of,
        from: step.checked_sub(1).and_then(end),
        to: end(step),
        same_length: !matches!(change, Change::Length | Change::Ended),
        pedestrian: match change {
            Change::Pedestrian(n) => Some(n),
            _ => None,
        },
        what: match change {
            Change::Ended if found.is_empty() => "no steps were kept".to_owned(),
            Change::Ended => format!("the run has {taken} steps"),
            Change::Length => "its length is another".to_owned(),
            Change::Pedestrian(n) => format!("pedestrian {n} alone"),
            Change::Shared => "no pedestrian, but what all share".to_owned(),
            Change::Several => "several pedestrians".to_owned(),
        },
    })
}

impl Steps {
    /// Whether a step differs.
    pub fn differ(&self) -> bool {
        matches!(self, Steps::Part(_))
    }

    /// In words; nothing where none are kept.
    pub fn words(&self) -> Option<String> {
        match self {
            Steps::NotKept => None,
            Steps::Same => Some("every step is the same: samples inside a step differ".to_owned()),
            Steps::Part(Part { step: 0, what, .. }) => Some(format!("first different at the start: {what}")),
            Steps::Part(Part { step, of, from, to, what, .. }) => {
                let when =
                    |word: &str, t: &Option<String>| t.as_ref().map_or(String::new(), |t| format!("{word} t = {t}"));
                let (from, to) = (when(", from", from), when(" to", to));
                Some(format!("first different at step {step} of {of}{from}{to}: {what}"))
            }
        }
    }
}
