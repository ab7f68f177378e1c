//! The laws as differences from the uniform flow agree with the printed laws and stay accurate for small deviations.

use crate::sample::{Random, algebraic, deviation, laws, variants};
use jam::laws::{Algebraic, Exponential, Model};
use jam::ring::{Ring, Start};
use jam::states::StateVariables;
use math::double_double::DoubleDouble;

/// Gap and speed of a uniform flow with room, and where its room is.
fn flow(model: &Model, random: &mut Random) -> (f64, f64, f64) {
    let speed = random.uniform(-0.3, 1.0) * model.desired_speed();
    let room = random.uniform(0.3, 3.0);
    (room + 2.0 * model.gap_per_speed() * speed + model.contact(), speed, room)
}

/// How much the acceleration moves when each of its arguments is off by half a unit, by central differences.
fn sensitivity(model: &Model, arguments: [f64; 3]) -> f64 {
    let [gap, speed, ahead] = arguments;
    let slope = |i: usize| {
        let h = 1e-6;
        let mut ends = [arguments; 2];
        ends[0][i] += h;
        ends[1][i] -= h;
        let value = |a: [f64; 3]| model.acceleration(a[0], a[1], a[2]);
        ((value(ends[0]) - value(ends[1])) / (2.0 * h)).abs()
    };
    let size = gap.abs() + 2.0;
    0.5 * f64::EPSILON * (slope(0) * size + slope(1) * (speed.abs() + 1.0) + slope(2) * (ahead.abs() + 1.0))
}

/// Rounding of the printed law: some ten operations and functions of at most two units each (the power: `2.5 q ln d`
/// more) on terms of the size of drive and force, and the rounding of each argument.
fn rounding(model: &Model, arguments: [f64; 3]) -> f64 {
    let [gap, speed, ahead] = arguments;
    let drive = model.desired_speed() + speed.abs();
    let force = (model.desired_speed() - speed - model.acceleration(gap, speed, ahead)).abs();
    let power = match model {
        Model::Algebraic(law) => 2.5 * law.q * math::ln(model.effective_gap(gap, speed, ahead)).abs(),
        _ => 0.0,
    };
    // the logarithm's own scale is the desired speed, for each unit of force
    let force = if matches!(model, Model::Logarithmic(_)) { force + drive } else { force };
    f64::EPSILON * (10.0 * drive + (20.0 + power) * force) + 4.0 * sensitivity(model, arguments)
}

#[test]
fn powers_1_2_and_3_are_products() {
    let mut random = Random(31);
    for _ in 0..300 {
        let gap = 2.0 + random.uniform(0.3, 3.0);
        let room = gap - 2.0;
        let products = [1.0 / room, 1.0 / (room * room), 1.0 / (room * room * room)];
        for (power, inverse) in [1.0, 2.0, 3.0].into_iter().zip(products) {
            let law = Algebraic { delta: 0.0, a_v: 0.0, q: power, ..algebraic(&mut random) };
            let expected = law.v0 - 0.25 - law.mu * law.mu * inverse;
            assert_eq!(Model::Algebraic(law).acceleration(gap, 0.25, 0.5), expected, "{law:?} at {gap}");
        }
    }
}

#[test]
fn deviations_are_differences_of_the_printed_law() {
    let mut random = Random(1);
    let mut worst: f64 = 0.0;
    for _ in 0..20_000 {
        for model in laws(&mut random) {
            let (gap, speed, room) = flow(&model, &mut random);
            let scale = room * random.magnitude(-6.0, 0.0);
            let from = [(); 3].map(|()| scale * random.uniform(-0.7, 1.0));
            let there = [gap + from[0], speed + from[1], speed + from[2]];
            if model.effective_gap(there[0], there[1], there[2]) < 0.1 * room {
                continue;
            }
            let printed = model.acceleration(there[0], there[1], there[2]) - model.acceleration(gap, speed, speed);
            let allowed = rounding(&model, there) + rounding(&model, [gap, speed, speed]);
            let ratio = (deviation(&model, gap, speed, from) - printed).abs() / allowed;
            assert!(ratio < 1.0, "{model:?} at {gap}, {speed} from {from:?}: {ratio} times the rounding");
            worst = math::larger(worst, ratio);
        }
    }
    println!("largest difference {worst:.3} times the bound");
}

#[test]
fn small_deviations_keep_their_digits() {
    let mut random = Random(2);
    for size in [1e-9, 1e-12, 1e-100, 1e-290] {
        let mut worst: f64 = 0.0;
        for _ in 0..5000 {
            for model in laws(&mut random) {
                let (gap, speed, room) = flow(&model, &mut random);
                let from = [(); 3].map(|()| size * random.uniform(-1.0, 1.0));
                let linear = model.linearise(gap, speed);
                let terms = [
                    linear.phi * from[0],
                    -linear.beta * (from[1] + from[2]),
                    linear.kappa * (from[2] - from[1]),
                    -from[1],
                ];
                let scale: f64 = terms.iter().map(|term| term.abs()).sum();
                // relative size of the next term: the shortest length over which each law bends
                let bend = match model {
                    Model::Algebraic(law) => (law.q + 1.0) / room + 1.0 / law.epsilon,
                    Model::Exponential(law) => 1.0 / law.b + 1.0 / law.epsilon,
                    Model::Logarithmic(law) => 2.0 + 1.0 / law.epsilon,
                    Model::Formula(_) | Model::Own(_) => f64::NAN,
                };
                let error = (deviation(&model, gap, speed, from) - terms.iter().sum::<f64>()).abs() / scale;
                // the same force through other formulas: 40 units, and exp(-d / eps) knows d / eps to its own rounding
                let allowed = 10.0 * bend * size + f64::EPSILON * (40.0 + 4.0 * bend * (gap.abs() + 2.0));
                assert!(error < allowed, "{model:?} at {gap}, {speed} from {from:?}: {error:e}, allowed {allowed:e}");
                worst = math::larger(worst, error);
            }
        }
        println!("deviations of {size:e}: largest relative error {worst:e}");
    }
}

#[test]
fn whole_powers_agree_with_twofold_numbers() {
    // without widening and relative speed the force needs no function: -w - mu^2 (1 / (d + u)^q - 1 / d^q)
    let mut random = Random(3);
    let mut worst: f64 = 0.0;
    for _ in 0..20_000 {
        let Model::Algebraic(mut law) = laws(&mut random)[0] else { continue };
        (law.delta, law.a_v) = (0.0, 0.0);
        for q in 1..=3 {
            law.q = f64::from(q);
            let gap = 2.0 + random.uniform(0.3, 3.0);
            let d = gap - 2.0;
            let (u, w) = (d * random.magnitude(-15.0, -0.1) * random.uniform(-1.0, 1.0), random.uniform(-1e-3, 1e-3));
            let power = |x: DoubleDouble| (1..q).fold(x, |power, _| power * x);
            let (before, after) = (power(DoubleDouble::from(d)), power(DoubleDouble::sum(d, u)));
            // 1 / after - 1 / before, over one denominator; double-double numbers keep 16 digits of it down to u =
            // 1e-15 d
            let difference = (before - after) / (before * after);
            let force = DoubleDouble::product(law.mu, law.mu) * difference;
            let exact = DoubleDouble::from(-w) - force;
            let computed = deviation(&Model::Algebraic(law), gap, 0.7, [u, w, 0.0]);
            let error = (exact - computed).abs().hi / (w.abs() + force.hi.abs());
            worst = math::larger(worst, error);
            assert!(error < 12.0 * f64::EPSILON, "q = {q}, d = {d}, u = {u:e}: {error:e}");
        }
    }
    println!("largest relative error {worst:e}");
}

/// Rows of every number of whole registers, of parts of one, and of several rows.
#[test]
fn a_ring_of_deviations_has_the_bits_of_its_pedestrians_one_by_one() {
    let mut random = Random(26);
    for count in [2, 3, 8, 9, 57, 67, 133, 256, 257, 515] {
        for model in variants(&mut random) {
            let ring = Ring { pedestrians: count, length: count as f64 * 4.5 };
            let form = StateVariables::Deviations.build(&model, ring);
            let mut state = form.start(Start { shift: 0.1 });
            state[..2 * count].iter_mut().for_each(|deviation| *deviation += random.uniform(-0.1, 0.1));
            state[2 * count + 2] = 0.3;
            let mut rates = vec![0.0; form.dimension()];
            form.rates(&state, &mut rates);
            for n in 0..count {
                let from = [state[n], state[count + n], state[count + (n + 1) % count]];
                let alone = deviation(&model, ring.headway(), 0.3, from);
                assert_eq!(rates[count + n].to_bits(), alone.to_bits(), "{model:?}, {n} of {count}");
            }
        }
    }
}

#[test]
fn a_ring_is_open_while_everybody_has_room() {
    let mut random = Random(27);
    let (mut open, mut closed) = (0, 0);
    for model in (0..40).flat_map(|_| variants(&mut random)).collect::<Vec<_>>() {
        let ring = Ring { pedestrians: 5, length: 5.0 * 4.5 };
        let form = StateVariables::Deviations.build(&model, ring);
        let gaps: Vec<f64> = (0..5).map(|_| model.contact() + random.uniform(-0.1, 0.9)).collect();
        let speeds: Vec<f64> = (0..5).map(|_| random.uniform(0.0, 0.6)).collect();
        let rooms = (0..5).map(|n| model.effective_gap(gaps[n], speeds[n], speeds[(n + 1) % 5]));
        let least = rooms.fold(f64::INFINITY, math::smaller);
        let expected = !model.is_singular() || least > 0.0;
        let positions: Vec<f64> = (0..5).map(|n| gaps[..n].iter().sum()).collect();
        // of a ring that is as long as these gaps
        let length: f64 = gaps.iter().sum();
        let by_positions = StateVariables::Positions.build(&model, Ring { pedestrians: 5, length });
        assert_eq!(by_positions.in_domain(&[positions, speeds.clone()].concat()), expected, "{model:?}");
        let uniform = 0.2;
        let mut deviations = vec![0.0; form.dimension()];
        for n in 0..5 {
            (deviations[n], deviations[5 + n]) = (gaps[n] - ring.headway(), speeds[n] - uniform);
        }
        deviations[5 * 2 + 2] = uniform;
        assert_eq!(form.in_domain(&deviations), expected, "{model:?}");
        if model.is_singular() {
            *if expected { &mut open } else { &mut closed } += 1;
        }
    }
    assert!(open > 50 && closed > 50, "{open} open, {closed} closed");
}

#[test]
fn a_ring_with_a_room_of_exactly_nothing_is_closed() {
    let law = Algebraic { delta: 0.0, a_v: 0.25, ..algebraic(&mut Random(29)) };
    let model = Model::Algebraic(law);
    let ring = Ring { pedestrians: 4, length: 16.0 };
    for victim in 0..4 {
        // gap 3, speeds 2: room 3 - 0.25 (2 + 2) - 2 = 0, all exact
        let (mut gaps, speeds) = ([4.0; 4], [2.0; 4]);
        gaps[victim] = 3.0;
        gaps[(victim + 1) % 4] = 5.0;
        for kind in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
            let form = kind.build(&model, ring);
            let mut state = form.start(Start { shift: 0.0 });
            let places: Vec<f64> = (0..4).map(|n| gaps[..n].iter().sum()).collect();
            for n in 0..4 {
                let (place, speed) = match kind {
                    StateVariables::Deviations => (gaps[n] - 4.0, speeds[n]),
                    StateVariables::Spacings => (gaps[n] - 2.0, speeds[n]),
                    StateVariables::Positions => (places[n], speeds[n]),
                };
                (state[n], state[4 + n]) = (place, speed);
            }
            assert!(!form.in_domain(&state), "{kind:?} {victim}");
            // slower by a little there is room again
            state[4 + victim] -= 1e-9;
            assert!(form.in_domain(&state), "{kind:?} {victim}");
        }
    }
}

#[test]
fn a_force_next_to_nothing_in_the_uniform_flow_is_right_where_a_gap_closes() {
    // e^-705 in the flow, of which e^710 would be a factor: that overflows
    let (ring, closed) = (Ring { pedestrians: 16, length: 16.0 * 707.0 }, 710.0);
    for (c, a_v) in [(0.0, 0.0), (0.0, 0.1), (1.0, 0.0), (1.0, 0.1)] {
        let model = Model::Exponential(Exponential { a: 1.5, b: 1.0, c, a_v, epsilon: 0.1, v0: 3.0 });
        let form = StateVariables::Deviations.build(&model, ring);
        let mut state = form.start(Start { shift: 0.0 });
        state[16..].fill(0.0);
        (state[3], state[4]) = (-closed, closed);
        let mut rates = vec![0.0; form.dimension()];
        form.rates(&state, &mut rates);
        for (n, spacing) in [(2, 707.0), (3, 707.0 - closed), (4, 707.0 + closed)] {
            let expected = model.acceleration(spacing, 0.0, 0.0);
            // that of the uniform flow and the difference from it
            let acceleration = rates[34] + rates[16 + n];
            let error = (acceleration - expected).abs() / expected.abs();
            assert!(error < 1e-12, "c {c}, a_v {a_v}, pedestrian {n}: {acceleration} instead of {expected}");
        }
    }
}

#[test]
fn laws_have_their_names() {
    let names = laws(&mut Random(28)).map(|model| model.name());
    assert_eq!(names, ["algebraic", "exponential", "logarithmic"]);
}
