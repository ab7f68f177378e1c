//! Faults on a copy of the real checkout: kills, damage, full disks, wrong clocks. After each a plain run must give the
//! right sums, and no run that says all is well may have left anything wrong. `FAULTS_SEED` sets other moments and
//! places, `FAULTS_KILLS` another number of kills, `FAULTS_ONLY` picks one kind.

mod checkout;
mod damage;
mod kills;
mod limits;
mod random;

use checkout::Checkout;
use random::Random;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

/// What was done, told at the end.
#[derive(Default)]
pub struct Tally {
    lines: Vec<String>,
    total: usize,
    skipped: usize,
}

impl Tally {
    pub fn add(&mut self, what: &str, count: usize, more: &str) {
        let more = if more.is_empty() { String::new() } else { format!(" ({more})") };
        self.total += count;
        self.say(format!("{count:>5}  {what}{more}"));
    }

    pub fn skip(&mut self, what: &str, why: &str) {
        self.skipped += 1;
        self.say(format!("skipped: {what}: {why}"));
    }

    /// Told as it comes, also when the tests' own words are kept back.
    fn say(&mut self, line: String) {
        let _ = writeln!(std::io::stderr(), "faults: {line}");
        self.lines.push(line);
    }
}

/// A kind of fault: its name for `FAULTS_ONLY`, and what does it.
type Part<'a> = (&'a str, &'a mut dyn FnMut(&mut Random, &mut Tally));

#[test]
#[ignore = "some minutes, and the figures' programs: cargo xtask ci --full"]
fn after_every_fault_a_plain_run_gives_the_right_sums() {
    let number = |name: &str, other: u64| std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(other);
    let (seed, count) = (number("FAULTS_SEED", 1), number("FAULTS_KILLS", 200) as usize);
    let only = std::env::var("FAULTS_ONLY").unwrap_or_default();
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("faults");
    checkout::remove(&place);
    let clock = Instant::now();
    let copy = Checkout::new(&place.join("checkout"));
    let (mut random, mut tally) = (Random(seed), Tally::default());
    let parts: [Part<'_>; 12] = [
        ("kills", &mut |random, tally| kills::kills(&copy, count, random, tally)),
        ("store", &mut |random, tally| damage::store(&copy, random, tally)),
        ("records", &mut |random, tally| damage::records(&copy, random, tally)),
        ("reports", &mut |random, tally| damage::reports(&copy, random, tally)),
        ("outputs", &mut |random, tally| damage::outputs(&copy, random, tally)),
        ("links", &mut |_, tally| damage::links(&copy, &place.join("elsewhere"), tally)),
        ("sizes", &mut |random, tally| limits::file_sizes(&copy, random, tally)),
        ("full", &mut |random, tally| limits::full_disk(&copy, &place.join("small"), random, tally)),
        ("read-only", &mut |_, tally| limits::read_only(&copy, tally)),
        ("resources", &mut |_, tally| limits::resources(&copy, tally)),
        ("clocks", &mut |_, tally| limits::clocks(&copy, tally)),
        ("together", &mut |_, tally| limits::together(&copy, tally)),
    ];
    for (name, part) in parts {
        if only.is_empty() || only == name {
            part(&mut random, &mut tally);
        }
    }
    limits::paths(&copy, &place, &mut tally);
    copy.must_recover(&[], "everything");
    checkout::remove(&place);
    let (total, skipped, seconds) = (tally.total, tally.skipped, clock.elapsed().as_secs());
    tally.say(format!("{total} faults, {skipped} kinds skipped, seed {seed}, {seconds} s: nothing wrong was accepted"));
}
