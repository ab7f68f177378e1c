//! The plan: what to do, and in which order.

use crate::pool::Job;
use crate::record::FigureState;
use crate::store;
use checkout::failure::Failure;
use checkout::paths::Paths;
use files::reader::Value;
use files::scene_file::{Kind, Panel};
use std::collections::BTreeMap;

/// One program to start.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// For progress, logs and times: `fig04 run stable`, or the figure's slug.
    pub name: String,
    /// What it does.
    pub task: Task,
    /// What it waits for, and how long it may take.
    pub job: Job,
}

/// What a node does.
#[derive(Clone, Debug, PartialEq)]
pub enum Task {
    /// Integrates a run into the store.
    Simulate {
        /// The scene file, by name.
        scene: String,
        /// The panel of it.
        panel: String,
        /// Where it is stored.
        key: String,
        /// Whether another method at a tighter tolerance is used.
        check: bool,
    },
    /// Writes the tables and pictures of a figure.
    Draw {
        /// Index of the figure among those surveyed.
        figure: usize,
    },
}

/// What is asked of one figure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Write its tables and pictures.
    pub draw: bool,
    /// Have its runs and their checks at hand, to compare them.
    pub measure: bool,
}

/// The nodes that fulfil the needs (one for each figure surveyed). Runs that are stored and intact are not repeated
/// unless `force`; a run that several figures share appears once, under the name of the first.
///
/// # Errors
/// A stored run cannot be read.
pub fn make(paths: &Paths, surveys: &[FigureState<'_>], needs: &[Needs], force: bool) -> Result<Vec<Node>, Failure> {
    let mut nodes: Vec<Node> = Vec::new();
    let mut known: BTreeMap<String, Option<usize>> = BTreeMap::new();
    for (index, (survey, need)) in surveys.iter().zip(needs).enumerate() {
        let mut after = Vec::new();
        for (panel, (_, key)) in survey.figure.runs().zip(&survey.runs) {
            let both = [(false, need.draw || need.measure), (true, need.measure)];
            for (check, _) in both.into_iter().filter(|(_, wanted)| *wanted) {
                let node = run(survey, panel, key, check);
                let at = match known.get(&node.0) {
                    Some(&at) => at,
                    None if !force && store::is_sound(&store::folder(paths, &node.0))? => None,
                    None => {
                        nodes.push(node.1);
                        Some(nodes.len() - 1)
                    }
                };
                known.insert(node.0, at);
                after.extend(at.filter(|_| !check));
            }
        }
        if need.draw {
            nodes.push(draw(survey, index, after));
        }
    }
    Ok(nodes)
}

fn run(survey: &FigureState<'_>, panel: &Panel, key: &str, check: bool) -> (String, Node) {
    let key = if check { store::check_key(key) } else { key.to_owned() };
    let work = if check { 2.0 * cost(panel) } else { cost(panel) };
    let verb = if check { "check" } else { "run" };
    let name = format!("{} {verb} {}", survey.figure.id, panel.name);
    let scene = Paths::scene(&survey.figure.slug);
    let task = Task::Simulate { scene, panel: panel.name.clone(), key: key.clone(), check };
    (key, Node { name, task, job: Job { after: Vec::new(), weight: work } })
}

fn draw(survey: &FigureState<'_>, index: usize, after: Vec<usize>) -> Node {
    let panels = survey.figure.scene_file.as_ref().map_or(&[][..], |scene_file| &scene_file.panels);
    let maps = panels.iter().filter(|panel| panel.kind == Kind::Map).count();
    let job = Job { after, weight: 1.0 + maps as f64 };
    Node { name: survey.figure.slug.clone(), task: Task::Draw { figure: index }, job }
}

/// Pedestrians times duration: a guess of the work, far above that of any map. 1e6 when the scene does not say.
fn cost(panel: &Panel) -> f64 {
    let number = |table: &str, key: &str| match panel.tables.section(table)?.entries.get(key)?.value {
        Value::Number(number) => Some(number),
        _ => None,
    };
    match (number("ring", "pedestrians"), number("run", "t_end")) {
        (Some(pedestrians), Some(duration)) => 100.0 + pedestrians * duration,
        _ => 1e6,
    }
}
