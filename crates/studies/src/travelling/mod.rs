//! Travelling waves of the algebraic law with relative speed on a ring, stable or not, computed without runs: a branch
//! is followed along its amplitude from the onset of instability. Runs that start from some of the waves show whether
//! they last.

mod elimination;
mod presets;
mod wave;

use crate::hard::rows::{CellValue, Rows, row};
use crate::hard::run::two_methods;
use figures::failure::Failure;
use jam::laws::{Algebraic, Model};
use jam::observe::speed_std;
use jam::ring::Ring;
use jam::stability::{Response, Waves};
use jam::states::StateVariables;
use jam::uniform::{headway_of_gap, steady_speed};
use ode::{Problem, Step, integrate};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use wave::{Family, Wave, resampled};

/// The effective gap of the uniform flow: that of supplement 19.
const GAP: f64 = 0.5;
/// Rings, with the number of places of a profile.
const RINGS: [(usize, usize); 3] = [(67, 97), (134, 161), (268, 257)];
/// Number of additional points that estimate the error.
const FINER: f64 = 1.5;
/// The amplitude of the first wave, and by how much that of the second is larger.
const FIRST: [f64; 2] = [2e-4, 1e-4];
/// A branch ends this far above the threshold, or at this amplitude.
const LAST: [f64; 2] = [0.009, 0.4];
/// Largest number of tries.
const TRIES: usize = 200;
/// Steps of the amplitude grow by this factor where Newton's method needs few steps, and shrink where it fails.
const GROWTH: f64 = 1.18;
const FEW: usize = 6;

/// `<mu, 1, 2, 0>` at `v0' = 3`.
fn law(strength: f64) -> Algebraic {
    Algebraic { mu: strength, delta: 1.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 }
}

/// The linearised law at this strength, with the steady speed.
fn response(strength: f64) -> Result<(Response, f64), Failure> {
    let model = Model::Algebraic(law(strength));
    let headway = headway_of_gap(&model, GAP).map_err(Failure::work)?;
    let speed = steady_speed(&model, headway).map_err(Failure::work)?;
    let response = model.response(headway, speed).ok_or_else(|| Failure::work("no linearised law"))?;
    Ok((response, speed))
}

/// The strength from which on the uniform flow is unstable.
fn threshold(waves: Waves) -> Result<f64, Failure> {
    let (mut low, mut high) = (0.2, 0.4);
    // to the last bits
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if response(middle)?.0.margin(waves).0 > 0.0 { high = middle } else { low = middle }
    }
    Ok(high)
}

/// The waves of a ring from the threshold on, with the family that they belong to.
fn branch(pedestrians: usize, points: usize) -> Result<(Family, Vec<Wave>), Failure> {
    let family = Family::new(law(1.0), GAP, pedestrians, points);
    let critical = threshold(Waves::Ring(pedestrians))?;
    let (response, speed) = response(critical)?;
    let frequency = response.root(TAU / pedestrians as f64).1.abs();
    let cosine = |i: usize| math::cos(TAU * i as f64 / points as f64);
    let small = |amplitude: f64| {
        let speeds = (0..points).map(|i| speed + amplitude * cosine(i)).collect();
        Wave { amplitude, strength: critical, frequency, speeds }
    };
    let mut waves: Vec<Wave> = Vec::new();
    let mut step = FIRST[1];
    for _ in 0..TRIES {
        let amplitude = waves.last().map_or(FIRST[0], |last| last.amplitude + step);
        let guess = match &waves[..] {
            [.., before, last] => carried_on(before, last, amplitude),
            _ => small(amplitude),
        };
        match family.find(guess) {
            None => step *= 0.5,
            Some((wave, rounds)) => {
                step *= if rounds < FEW { GROWTH } else { 1.0 };
                let is_last = wave.strength - critical > LAST[0] || amplitude > LAST[1];
                waves.push(wave);
                if is_last {
                    return Ok((family, waves));
                }
            }
        }
    }
    Err(Failure::work(format!("{pedestrians} pedestrians: the branch of waves has no end")))
}

/// The straight line through two waves, at an amplitude.
fn carried_on(before: &Wave, last: &Wave, amplitude: f64) -> Wave {
    let t = (amplitude - before.amplitude) / (last.amplitude - before.amplitude);
    let at = |a: f64, b: f64| a + t * (b - a);
    let speeds = before.speeds.iter().zip(&last.speeds).map(|(a, b)| at(*a, *b)).collect();
    let [strength, frequency] = [at(before.strength, last.strength), at(before.frequency, last.frequency)];
    Wave { amplitude, strength, frequency, speeds }
}

/// The tables: all waves (`branch`), where they begin and turn around (`turns`), runs from some of them (`runs`), and
/// a run of each preset (`presets`).
///
/// # Errors
/// Newton's method or a run failed.
pub fn tables() -> Result<[(&'static str, Rows); 4], Failure> {
    let mut all = Rows::new(&[
        "pedestrians",
        "amplitude",
        "mu",
        "error",
        "above",
        "std",
        "least_speed",
        "least_gap",
        "wave_speed",
    ]);
    let mut turns = Rows::new(&[
        "pedestrians",
        "threshold",
        "infinite",
        "onset",
        "highest",
        "highest_std",
        "lowest",
        "lowest_std",
        "error",
    ]);
    let mut runs = Rows::new(&["pedestrians", "mu", "margin", "t", "std_start", "std", "error"]);
    let (presets, infinite) = (presets::table()?, threshold(Waves::All)?);
    for (pedestrians, points) in RINGS {
        let critical = threshold(Waves::Ring(pedestrians))?;
        let (family, waves) = branch(pedestrians, points)?;
        let more = (FINER * points as f64) as usize | 1;
        let finer = Family::new(law(1.0), GAP, pedestrians, more);
        let mut largest: f64 = 0.0;
        for wave in &waves {
            let speeds = resampled(&wave.speeds, more);
            let (fine, _) = finer
                .find(Wave { speeds, ..wave.clone() })
                .ok_or_else(|| Failure::work(format!("{pedestrians} pedestrians: no wave with {more} places")))?;
            let error = (fine.strength - wave.strength).abs();
            largest = math::larger(largest, error);
            let least = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, math::smaller);
            let mean = wave.speeds.iter().sum::<f64>() / points as f64;
            // the phase goes by one pedestrian in 2 pi / N / omega, who is a headway further back
            let headway = GAP + Model::Algebraic(law(wave.strength)).contact();
            let wave_speed = mean - wave.frequency * pedestrians as f64 / TAU * headway;
            let (slowest, gap) = (least(&wave.speeds), least(&family.gaps(wave)));
            all.push(row![
                pedestrians as f64,
                wave.amplitude,
                wave.strength,
                error,
                wave.strength - critical,
                speed_std(&wave.speeds),
                slowest,
                gap,
                wave_speed
            ]);
        }
        let onset =
            waves.first().map(|wave| speed_std(&wave.speeds) * speed_std(&wave.speeds) / (wave.strength - critical));
        let highest = turn(&waves, |before, here, after| here >= before && here > after);
        let lowest = turn(&waves, |before, here, after| here <= before && here < after);
        let [strength, std] = [|wave: &&Wave| wave.strength, |wave: &&Wave| speed_std(&wave.speeds)];
        turns.push(row![
            pedestrians as f64,
            critical,
            infinite,
            onset,
            highest.as_ref().map(strength),
            highest.as_ref().map(std),
            lowest.as_ref().map(strength),
            lowest.as_ref().map(std),
            largest
        ]);
        for wave in lasting(&waves, lowest) {
            runs.push(lasts(&family, wave, pedestrians)?);
        }
    }
    Ok([("branch", all), ("turns", turns), ("runs", runs), ("presets", presets)])
}

/// The first wave whose strength is extreme among its neighbours.
fn turn(waves: &[Wave], is_extreme: impl Fn(f64, f64, f64) -> bool) -> Option<&Wave> {
    let found = waves.windows(3).find(|three| is_extreme(three[0].strength, three[1].strength, three[2].strength));
    found.map(|three| &three[1])
}

/// The waves that runs begin with: one in the middle of those beyond the lowest, and that after the lowest, both on the
/// part of the branch along which the strength grows; without a lowest one that of the middle alone.
fn lasting<'a>(waves: &'a [Wave], lowest: Option<&'a Wave>) -> Vec<&'a Wave> {
    let beyond: Vec<&Wave> =
        waves.iter().filter(|wave| lowest.is_none_or(|lowest| wave.amplitude > lowest.amplitude)).collect();
    let near = beyond.iter().position(|_| lowest.is_some()).map(|_| beyond[beyond.len() / 4]);
    near.into_iter().chain(beyond.get(beyond.len() / 2).copied()).collect()
}

/// How long a run from a wave goes, in units of `tau`.
const END: f64 = 2000.0;
/// What is added to the speed of pedestrian 0.
const DISTURBED: f64 = 1e-3;

fn watched_by_nobody(_: &mut Step<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// A run from a wave with one disturbed pedestrian, by two methods: a row of `runs`.
fn lasts(family: &Family, wave: &Wave, pedestrians: usize) -> Result<Vec<CellValue>, Failure> {
    let model = Model::Algebraic(law(wave.strength));
    let headway = headway_of_gap(&model, GAP).map_err(Failure::work)?;
    let form = StateVariables::Spacings.build(&model, Ring { pedestrians, length: headway * pedestrians as f64 });
    let [gaps, mut speeds] = [&family.gaps(wave), &wave.speeds].map(|values| resampled(values, pedestrians));
    let began = speed_std(&speeds);
    speeds[0] += DISTURBED;
    let start: Vec<f64> = gaps.into_iter().chain(speeds).chain([0.0]).collect();
    let mut ends = [0.0; 2];
    for (end, (method, control)) in ends.iter_mut().zip(two_methods(1e-8)) {
        let problem = Problem { system: &*form, start: &start, begin: 0.0, end: END, method, control };
        let made = integrate(&problem, &mut watched_by_nobody).map_err(Failure::work)?;
        *end = speed_std(&made.state[pedestrians..2 * pedestrians]);
    }
    let margin = response(wave.strength)?.0.margin(Waves::Ring(pedestrians)).0;
    Ok(row![pedestrians as f64, wave.strength, margin, END, began, ends[0], (ends[0] - ends[1]).abs()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_begin_at_the_threshold_of_the_ring_and_grow_as_the_root_of_the_distance() {
        let critical = threshold(Waves::Ring(20)).expect("a threshold");
        let family = Family::new(law(1.0), GAP, 20, 31);
        let (response, speed) = response(critical).expect("a linearised law");
        let wave = |amplitude: f64| {
            let speeds = (0..31).map(|i| speed + amplitude * math::cos(TAU * f64::from(i) / 31.0)).collect();
            let frequency = response.root(TAU / 20.0).1.abs();
            let guess = Wave { amplitude, strength: critical, frequency, speeds };
            family.find(guess).expect("a wave").0.strength - critical
        };
        let [one, two] = [1e-3, 2e-3].map(wave);
        assert!(one > 0.0 && (two / one - 4.0).abs() < 1e-2, "{one} {two}");
    }

    #[test]
    fn a_run_from_a_wave_goes_around_with_its_frequency() {
        let (family, waves) = branch(20, 31).expect("a branch");
        let wave = &waves[waves.len() / 2];
        let model = Model::Algebraic(law(wave.strength));
        let form = StateVariables::Spacings.build(&model, Ring { pedestrians: 20, length: 50.0 });
        let [gaps, speeds] = [&family.gaps(wave), &wave.speeds].map(|values| resampled(values, 20));
        let start: Vec<f64> = gaps.iter().chain(&speeds).copied().chain([0.0]).collect();
        let [(method, control), _] = two_methods(1e-11);
        let end = TAU / wave.frequency;
        let problem = Problem { system: &*form, start: &start, begin: 0.0, end, method, control };
        let made = integrate(&problem, &mut watched_by_nobody).expect("a run");
        for (n, speed) in speeds.iter().enumerate() {
            assert!((made.state[20 + n] - speed).abs() < 1e-6, "{n}: {} {speed}", made.state[20 + n]);
        }
    }

    #[test]
    fn a_profile_at_other_places_is_the_same_function() {
        let values: Vec<f64> = (0..9).map(|i| 1.0 + math::sin(3.0 * TAU * f64::from(i) / 9.0)).collect();
        for (i, value) in resampled(&values, 14).iter().enumerate() {
            assert!((value - 1.0 - math::sin(3.0 * TAU * i as f64 / 14.0)).abs() < 1e-14);
        }
    }
}
