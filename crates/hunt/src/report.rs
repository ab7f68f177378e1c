//! Summarises the verdicts over many scenes.

use crate::judge::{Ratio, Verdict, scene};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::atomic::{AtomicU64, Ordering};

/// A scene and the verdicts on its panels.
#[derive(Clone, Debug)]
pub struct Hunted {
    /// What it was drawn from.
    pub seed: u64,
    /// Of each panel.
    pub verdicts: Vec<Verdict>,
}

/// Hunts through the scenes of seeds `from .. from + count` on `threads` threads; results are in the order of the
/// seeds.
pub fn hunt(from: u64, count: u64, threads: usize) -> Vec<Hunted> {
    let next = AtomicU64::new(from);
    let work = || {
        let mut done = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= from + count {
                return done;
            }
            done.push(Hunted { seed, verdicts: scene(&crate::draw::scene(seed)) });
        }
    };
    let mut all: Vec<Hunted> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads.max(1)).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("verdicts, not panics")).collect()
    });
    all.sort_by_key(|hunted| hunted.seed);
    all
}

/// The table: endings with counts, ratios by quantity, findings and what is undecided with seeds.
pub fn table(all: &[Hunted]) -> String {
    let mut endings: BTreeMap<&str, usize> = BTreeMap::new();
    let mut ratios: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mut own = Vec::new();
    let (mut findings, mut undecided) = (String::new(), String::new());
    let mut runs = 0;
    for hunted in all {
        for verdict in &hunted.verdicts {
            runs += 1;
            *endings.entry(&verdict.ending).or_default() += 1;
            for ratio in &verdict.ratios {
                ratios.entry(ratio.what).or_default().push(ratio.value());
                own.push(ratio.uncertainty / ratio.allowed);
            }
            let label = format!("{} {} [{}] {}", hunted.seed, verdict.panel, verdict.method, verdict.ending);
            // writing to a string cannot fail
            if let Some(first) = verdict.findings.first() {
                let _ = writeln!(findings, "  {label}: {} of which the first: {first}", verdict.findings.len());
            } else if let Some(first) = verdict.undecided.first() {
                let _ = writeln!(undecided, "  {label}: {} of which the first: {first}", verdict.undecided.len());
            }
        }
    }
    let resumed = all.iter().flat_map(|hunted| &hunted.verdicts).filter(|verdict| verdict.is_resumed).count();
    let mut text = format!("{} scenes, {runs} runs, {resumed} of them resumed as well\n", all.len());
    for (ending, count) in endings {
        let _ = writeln!(text, "{count:7}  {ending}");
    }
    for (what, values) in ratios {
        let _ = writeln!(text, "error / allowed of {what}: {}", distribution(values));
    }
    text.push_str(&honesty(all));
    text.push_str(&cost(all));
    let _ = writeln!(text, "the second integration's own error / allowed: {}", distribution(own));
    let _ = write!(
        text,
        "findings: {}\n{findings}undecided: {}\n{undecided}",
        findings.lines().count(),
        undecided.lines().count()
    );
    text
}

/// How honest the errors are that runs state: true over stated, and how much too cautious.
fn honesty(all: &[Hunted]) -> String {
    let mut by_number: BTreeMap<&str, Vec<&Ratio>> = BTreeMap::new();
    for ratio in all.iter().flat_map(|hunted| &hunted.verdicts).flat_map(|verdict| &verdict.stated) {
        by_number.entry(ratio.what).or_default().push(ratio);
    }
    let mut text = String::new();
    for Hunted { seed, verdicts } in all {
        for verdict in verdicts {
            for ratio in verdict.stated.iter().filter(|ratio| ratio.value() > 3.0) {
                let Ratio { what, error, allowed, .. } = ratio;
                let label = format!("{seed} {} [{}] {}", verdict.panel, verdict.method, verdict.ending);
                let _ = writeln!(text, "  {label}: error of {what} {error:.2e}, stated {allowed:.2e}");
            }
        }
    }
    for (what, all) in by_number {
        let ratios: Vec<&Ratio> = all.iter().copied().filter(|ratio| ratio.allowed.is_finite()).collect();
        let share = |of: &[&Ratio], is: &dyn Fn(&Ratio) -> bool| {
            100.0 * of.iter().filter(|ratio| is(ratio)).count() as f64 / of.len().max(1) as f64
        };
        let visible: Vec<&Ratio> = ratios.iter().copied().filter(|ratio| ratio.error > 1e-14 * ratio.range).collect();
        let _ = writeln!(
            text,
            "stated error of {what}: {} numbers, {} without one; true error within 10 times of {:.2} %, within 3 times of {:.2} %; of {} with \
             a true error above 1e-14 of the range the stated one is at most 100 times that of {:.1} %; true / stated: {}",
            ratios.len(),
            all.len() - ratios.len(),
            share(&ratios, &|ratio| ratio.value() <= 10.0),
            share(&ratios, &|ratio| ratio.value() <= 3.0),
            visible.len(),
            share(&visible, &|ratio| ratio.value() >= 0.01),
            distribution(ratios.iter().map(|ratio| ratio.value()).collect())
        );
    }
    text
}

/// What the stated errors cost, in right-hand sides: in all, and run by run.
fn cost(all: &[Hunted]) -> String {
    let verdicts = all.iter().flat_map(|hunted| &hunted.verdicts);
    let costs = verdicts.filter(|verdict| verdict.evaluations > 0);
    let costs: Vec<(f64, u64)> = costs.filter_map(|verdict| Some((verdict.cost?, verdict.evaluations))).collect();
    if costs.is_empty() {
        return String::new();
    }
    let of_check: f64 = costs.iter().map(|(ratio, evaluations)| ratio * *evaluations as f64).sum();
    let of_runs: f64 = costs.iter().map(|(_, evaluations)| *evaluations as f64).sum();
    let mean = costs.iter().map(|(ratio, _)| ratio).sum::<f64>() / costs.len() as f64;
    let ratios = distribution(costs.iter().map(|(ratio, _)| *ratio).collect());
    format!(
        "cost of stating errors, in right-hand sides: {:.2} of the runs in all, {mean:.2} on average; {ratios}\n",
        of_check / of_runs
    )
}

fn distribution(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let quantile = |q: f64| values.get((values.len().saturating_sub(1) as f64 * q) as usize).copied().unwrap_or(0.0);
    let [half, most, nearly, all] = [0.5, 0.9, 0.99, 1.0].map(quantile);
    format!("{} numbers, median {half:.1e}, 90 % {most:.1e}, 99 % {nearly:.1e}, worst {all:.1e}", values.len())
}
