//! Random scenes by their seeds.

use hunt::draw;
use hunt::draw::FORMULAS;
use hunt::judge;
use hunt::judge::{Ratio, Verdict};
use hunt::report::{Hunted, hunt, table};

/// Runs that the second integration may leave undecided: chaotic ones, and steep ones that take too much work.
const UNDECIDED: f64 = 0.02;

/// Hunts through so many scenes with the laws of the paper, and so many with formulas.
fn judged(of_the_paper: u64, formulas: u64) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let both = [hunt(0, of_the_paper, threads), hunt(FORMULAS, formulas, threads)];
    for all in &both {
        println!("{}", table(all));
        let verdicts: Vec<_> = all.iter().flat_map(|Hunted { verdicts, .. }| verdicts).collect();
        assert!(verdicts.iter().all(|verdict| verdict.findings.is_empty()), "{}", table(all));
        let undecided = verdicts.iter().filter(|verdict| !verdict.undecided.is_empty()).count() as f64;
        assert!(undecided <= UNDECIDED * verdicts.len() as f64, "{}", table(all));
    }
    // the generators reach all that they should
    let reached = [
        &["ran to t_end", "negative_speed", "overlap", "exchange", "refused: no uniform flow"][..],
        &["ran to t_end", "negative_speed", "overlap", "exchange"],
    ];
    for (all, endings) in both.iter().zip(reached) {
        for ending in endings {
            let mut verdicts = all.iter().flat_map(|hunted| &hunted.verdicts);
            assert!(verdicts.any(|verdict| verdict.ending.contains(ending)), "no run: {ending}\n{}", table(all));
        }
    }
}

#[test]
fn three_hundred_random_scenes_are_right_or_say_why_not() {
    judged(200, 100);
}

fn of(seed: u64) -> Vec<Verdict> {
    judge::scene(&draw::scene(seed))
}

/// Blow-ups of which the steps tell the time: the error is carried to three digits through all throws, so that no
/// second run is needed.
#[test]
fn steps_tell_the_error_of_a_blow_up() {
    for seed in [2_340_035, 2_340_046] {
        for verdict in of(seed) {
            assert!(verdict.ending.contains("blow_up"), "{seed}: {verdict:#?}");
            assert!(verdict.findings.is_empty(), "{seed}: {verdict:#?}");
            assert_eq!(verdict.cost, Some(0.0), "{seed}: {verdict:#?}");
        }
    }
}

/// Asserts that no error of these runs is far larger than the stated one; returns the ratios of them all.
fn stated_of(seeds: &[u64]) -> Vec<Ratio> {
    let mut all = Vec::new();
    for &seed in seeds {
        for verdict in of(seed) {
            assert!(verdict.findings.is_empty(), "{seed}: {verdict:#?}");
            let wrong = verdict.stated.iter().find(|ratio| ratio.value() > 10.0);
            assert!(wrong.is_none(), "{seed}: {wrong:?} in {verdict:#?}");
            all.extend(verdict.stated);
        }
    }
    all
}

/// Runs whose true errors were 7 to 190 times the stated ones.
#[test]
fn errors_of_runs_that_were_found_are_stated() {
    stated_of(&[600_874, 1_600_582, 1_600_241, 301_796, 300_245, 1_050_169, 310_147, 310_919, 508_701, 10_501_663]);
    let events = of(600_874).into_iter().flat_map(|verdict| verdict.stated).filter(|ratio| ratio.what == "events");
    assert!(events.into_iter().any(|ratio| ratio.error > 1e-13 && ratio.allowed.is_finite()), "an error is stated");
}

/// Samples further apart than steps, while errors fade: true errors of std were 1.6 and 2.7 times what the ends of
/// steps tell.
#[test]
fn fading_errors_are_those_where_samples_are_taken() {
    let all = stated_of(&[2_000_183, 2_000_238]);
    let of_std: Vec<_> = all.iter().filter(|ratio| ratio.what == "std").collect();
    assert!(of_std.len() > 1 && of_std.iter().all(|ratio| ratio.value() < 1.0), "{of_std:#?}");
}

/// Fixed steps: motion that has faded by some decades, by Euler's method, down to the rounding of speeds; by so many
/// that half steps have none of its digits; a few steps of a high order; steps over bends too sharp for them; a force
/// that underflows at the start alone.
#[test]
fn errors_of_fixed_steps_are_stated() {
    let all = stated_of(&[331_563, 301_354, 1_331_083, 332_743, 310_130, 332_631, 540_125]);
    assert!(all.len() > 15 && all.iter().all(|ratio| ratio.allowed.is_finite()), "{all:#?}");
}

/// A few steps that two methods have in common: over a sharp bend, to a time within the longest of them.
#[test]
fn errors_of_a_few_adaptive_steps_are_stated() {
    let all = stated_of(&[311_807, 310_455, 330_069]);
    assert!(all.iter().all(|ratio| ratio.allowed.is_finite()), "{all:#?}");
    // not for being far too large
    assert!(all.iter().any(|ratio| ratio.what == "std" && ratio.value() > 0.1), "{all:#?}");
}

/// At a loose tolerance a run passes by a blow-up, at which the second run takes thousands of steps; roundings of
/// positions grow into a blow-up that the ring does not have.
#[test]
fn rows_beyond_a_blow_up_and_before_a_false_one_are_left_out() {
    for seed in [1_330_169, 352_451, 363_680] {
        for verdict in of(seed) {
            assert!(verdict.ending.starts_with("failed: not_confirmed"), "{seed}: {verdict:#?}");
            assert!(verdict.findings.is_empty(), "{seed}: {verdict:#?}");
        }
    }
}

/// Positions that lose the gap at a wall: deviations keep it, as the advice has it.
#[test]
fn advice_at_a_wall_helps() {
    for verdict in of(592_336) {
        assert!(verdict.findings.is_empty(), "{verdict:#?}");
    }
}

/// Two methods that agree in the one sample by chance; an event in a run in positions that the second run has a little
/// earlier; a second run of which one step lands by chance where the force exceeds all bounds.
#[test]
fn errors_are_stated_where_second_runs_mislead() {
    let all = stated_of(&[375_436, 1_372_133, 375_971]);
    assert!(all.iter().all(|ratio| ratio.allowed.is_finite()), "{all:#?}");
}

/// Taylor's method: speeds that relax freely, by long steps; errors of steps that rounded constants hide.
#[test]
fn errors_of_free_relaxation_are_within_three_times_the_stated_ones() {
    let all = stated_of(&[2_380_016, 2_380_198, 2_520_260]);
    let wrong = all.iter().find(|ratio| ratio.value() > 3.0);
    assert!(all.len() > 10 && wrong.is_none(), "{wrong:?}");
}

/// Steps over a bend that is too sharp for them, and those of half the length, blow up.
#[test]
fn false_blow_ups_of_fixed_steps_are_not_confirmed() {
    let all = of(10_520_242);
    assert!(all.iter().all(|verdict| verdict.findings.is_empty()), "{all:#?}");
    let refused = all.iter().filter(|verdict| verdict.ending.starts_with("failed: not_confirmed"));
    assert_eq!(refused.count(), 2, "{all:#?}");
}

/// Shifts that spacings lose where there is no uniform flow to deviate from: the second run loses them, too.
#[test]
fn errors_of_lost_shifts_are_stated() {
    let all = stated_of(&[520_091, 520_084, 10_520_000]);
    assert!(all.len() > 10 && all.iter().all(|ratio| ratio.allowed.is_finite()), "{all:#?}");
}

/// A step of Taylor's method proposed past a wall that its series does not see yet: from there no path to a bend
/// follows.
#[test]
fn steps_are_not_cut_by_an_end_that_means_nothing() {
    for verdict in of(2_375_971) {
        assert_eq!(verdict.ending, "ran to t_end", "{verdict:#?}");
        assert!(verdict.findings.is_empty() && verdict.evaluations < 10_000, "{verdict:#?}");
    }
}

/// Positions lose small gaps, and the smallest tolerances are near the roundings of a steep law: the advice leads on.
#[test]
fn runs_that_go_no_further_give_true_advice() {
    for (seed, words) in [(370_716, "deviations"), (376_829, "deviations"), (380_223, "deviations"), (380_381, "raise")]
    {
        let scene = draw::scene(seed);
        let panels = files::scene_file::parse("scene.toml", &scene).expect("a scene").panels;
        let scene = scene::run::read("scene.toml", &panels[0].tables).expect("a scene");
        let broken = jam::run::run(&scene).expect_err("it goes no further");
        assert!(broken.advice.is_some_and(|advice| advice.contains(words)), "{seed}: {broken}");
        assert!(judge::refusals::is_advice_true(&scene, &broken), "{seed}: {broken}");
    }
}

/// Steps of fixed length that end where the state is no longer finite are too long before that, too.
#[test]
fn nothing_is_stated_of_the_end_of_steps_that_break_off() {
    for seed in [300_410, 300_781] {
        let all = of(seed);
        assert!(all.iter().any(|verdict| verdict.ending.starts_with("failed: not_finite")), "{seed}: {all:#?}");
        assert!(all.iter().all(|verdict| verdict.findings.is_empty()), "{seed}: {all:#?}");
    }
}

/// A loose tolerance leads the run out of the domain of its formula.
#[test]
fn a_formula_without_value_is_no_end_where_the_second_run_goes_on() {
    let all = of(1_000_186);
    assert!(all.iter().all(|verdict| verdict.ending.starts_with("failed: not_confirmed")), "{all:#?}");
    assert!(all.iter().all(|verdict| verdict.findings.is_empty() && verdict.undecided.is_empty()), "{all:#?}");
}

#[test]
#[ignore = "half an hour"]
fn ten_thousand_random_scenes_are_right_or_say_why_not() {
    judged(7_000, 3_000);
}
