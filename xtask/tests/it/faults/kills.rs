//! The runner is killed, alone or with all its programs, at moments spread over its whole duration and within writes.

use super::Tally;
use super::checkout::{Checkout, CommandOutput};
use super::random::Random;
use std::collections::BTreeSet;
use std::os::unix::process::CommandExt as _;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Asked for by name: few figures, so that many kills are affordable; and all.
const FEW: [&[&str]; 2] = [&["2", "7", "8"], &["2", "4", "7", "12"]];

/// From where a run starts that is going to be killed.
#[derive(Clone, Copy, PartialEq)]
enum Start {
    /// Nothing was made.
    Nothing,
    /// The runs are stored, nothing is drawn.
    Undrawn,
    /// Everything was made, and is made again.
    Forced,
    /// Wherever the last kill has left it.
    PartialRun,
}

struct Plan {
    figures: &'static [&'static str],
    start: Start,
    /// Only the runner: its programs go on.
    alone: bool,
    /// At this part of the undisturbed duration; else when so many temporary names have been seen.
    moment: Result<f64, usize>,
}

/// Kills `count` runs.
pub fn kills(checkout: &Checkout, count: usize, random: &mut Random, tally: &mut Tally) {
    let durations = durations(checkout);
    let (mut killed, mut alone, mut within, mut early) = (0, 0, 0, 0);
    while killed < count {
        let plan = draw(killed, count, random);
        let duration = durations[index(plan.figures)][plan.start as usize];
        match plan.start {
            Start::Nothing => checkout.forget(true),
            Start::Undrawn => checkout.forget(false),
            Start::Forced | Start::PartialRun => {}
        }
        let Some(left) = kill(checkout, &plan, duration) else {
            early += 1;
            assert!(early < 3 * count, "runs end before they can be killed");
            continue;
        };
        killed += 1;
        alone += usize::from(plan.alone);
        within += usize::from(left > 0);
        let after = format!("kill {killed} of {}", plan.words());
        if !plan.alone {
            checkout.fresh_must_be_right(&after);
        }
        // the next kill may start from what this one has left
        if random.below(4) > 0 || plan.alone {
            checkout.must_recover(plan.figures, &after);
        }
    }
    checkout.must_recover(&[], "all kills");
    tally.add(
        "kills",
        killed,
        &format!("{alone} of the runner alone, {within} within a write, {early} runs had ended before"),
    );
}

/// Seconds of undisturbed runs, by figures and start.
fn durations(checkout: &Checkout) -> Vec<[Duration; 4]> {
    let timed = |figures: &[&str], start: Start| {
        match start {
            Start::Nothing => checkout.forget(true),
            Start::Undrawn => checkout.forget(false),
            Start::Forced | Start::PartialRun => {}
        }
        let clock = Instant::now();
        let ended = CommandOutput::of(&mut checkout.command(&arguments(figures, start)));
        assert_eq!(ended.code, Some(0), "{}", ended.words);
        clock.elapsed()
    };
    let all = [FEW[0], FEW[1], &[]];
    all.map(|figures| {
        let [nothing, undrawn, forced] =
            [Start::Nothing, Start::Undrawn, Start::Forced].map(|start| timed(figures, start));
        [nothing, undrawn, forced, undrawn]
    })
    .to_vec()
}

fn index(figures: &[&str]) -> usize {
    FEW.iter().position(|few| *few == figures).unwrap_or(FEW.len())
}

/// Every twentieth kill is of a run of all figures, every tenth of a larger choice.
fn draw(killed: usize, count: usize, random: &mut Random) -> Plan {
    let figures: &'static [&'static str] = match killed % 20 {
        0 => &[],
        5 | 15 => FEW[1],
        _ => FEW[0],
    };
    let start = [Start::Nothing, Start::Undrawn, Start::Forced, Start::PartialRun][random.below(4)];
    // moments in order fill the duration evenly, with a random part within each stretch
    let part = (killed as f64 + random.part()) / count as f64;
    let moment = if random.below(2) == 0 { Ok(part * 1.02) } else { Err(1 + random.below(24)) };
    Plan { figures, start, alone: random.below(4) == 0, moment }
}

impl Plan {
    fn words(&self) -> String {
        let start = ["from nothing", "with runs at hand", "by force", "underway"][self.start as usize];
        let who = if self.alone { "the runner alone" } else { "all" };
        format!("{who}, figures {:?} {start}, at {:?}", self.figures, self.moment)
    }
}

fn arguments<'a>(figures: &[&'a str], start: Start) -> Vec<&'a str> {
    let force: &[&str] = if start == Start::Forced { &["--force"] } else { &[] };
    [figures, force].concat()
}

/// Starts a run and kills it; the number of temporary files and folders it leaves, or `None` when it had ended before.
fn kill(checkout: &Checkout, plan: &Plan, duration: Duration) -> Option<usize> {
    let mut command = checkout.command(&arguments(plan.figures, plan.start));
    command.process_group(0).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().expect("the runner starts");
    let clock = Instant::now();
    let mut seen = BTreeSet::new();
    loop {
        if child.try_wait().expect("a child").is_some() {
            return None;
        }
        let is_time = match plan.moment {
            Ok(part) => clock.elapsed() >= duration.mul_f64(part),
            Err(names) => {
                seen.extend(checkout.temporary());
                seen.len() >= names
            }
        };
        if is_time {
            break;
        }
        if plan.moment.is_ok() {
            std::thread::sleep(Duration::from_micros(300));
        }
    }
    end(&mut child, plan.alone);
    Some(checkout.temporary().len())
}

/// Kills the runner, with its programs unless `alone`.
pub fn end(child: &mut Child, alone: bool) {
    if alone {
        child.kill().expect("a child that can be killed");
    } else {
        let group = format!("kill -9 -{}", child.id());
        let status = Command::new("sh").args(["-c", &group]).status().expect("sh");
        assert!(status.success(), "{group}");
    }
    child.wait().expect("a child");
}
