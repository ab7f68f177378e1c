//! Fingerprints of what laws give, to the last bit, on a ring that is the same everywhere.

use crate::sample::{Random, variants};
use crate::written::{as_formula, others};
use jam::force::Flow;
use jam::laws::Model;
use jam::ring::Ring;
use jam::states::StateVariables;
use std::fmt::Write;

/// More than a block, and no whole number of registers.
const PEDESTRIANS: usize = 77;
const ORDER: usize = 12;

/// Fowler, Noll and Vo's hash of the bits; of a NaN only that it is one, since its bits are the processor's.
fn fingerprint(values: &[f64]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for value in values {
        let bits = if value.is_nan() { u64::MAX } else { value.to_bits() };
        for byte in bits.to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    hash
}

/// Accelerations, differences from those of a uniform flow, and Taylor coefficients of gaps and of deviations.
fn of(model: &Model) -> [u64; 4] {
    let mut random = Random(45);
    let mut row = |low: f64, high: f64| (0..PEDESTRIANS).map(|_| random.uniform(low, high)).collect::<Vec<f64>>();
    let (net_gaps, speeds) = (row(1.5, 3.0), row(0.0, 1.0));
    let (spacings, changes) = (row(-0.1, 0.1), row(-0.1, 0.1));
    let force = model.force();
    let mut accelerations = vec![0.0; PEDESTRIANS];
    force.accelerations(&net_gaps, &speeds, &mut accelerations);
    let mut differences = vec![0.0; PEDESTRIANS];
    let flow = Flow { net_gap: 2.0, speed: 0.4 };
    let uniform = force.deviations(flow, &spacings, &changes, &mut differences);
    differences.push(uniform);
    let series = |kind: StateVariables, rows: [&[f64]; 2], rest: &[f64]| {
        let form = kind.build(model, Ring { pedestrians: PEDESTRIANS, length: 2.5 * PEDESTRIANS as f64 });
        let n = form.dimension();
        let mut coefficients = vec![0.0; (ORDER + 1) * n];
        let (state, rates) = coefficients.split_at_mut(n);
        state.copy_from_slice(&[rows[0], rows[1], rest].concat());
        form.rates(state, &mut rates[..n]);
        form.series(ORDER, 1.0, &mut coefficients);
        coefficients
    };
    let of_gaps = series(StateVariables::Spacings, [&net_gaps, &speeds], &[0.0]);
    let of_deviations = series(StateVariables::Deviations, [&spacings, &changes], &[0.0, 0.0, 0.4]);
    [&accelerations, &differences, &of_gaps, &of_deviations].map(|values| fingerprint(values))
}

/// The fingerprints of all laws, compiled and written down.
pub fn table() -> String {
    let mut text = "law,accelerations,deviations,series_gaps,series_deviations\n".to_owned();
    let mut line = |name: String, model: &Model| {
        let [a, b, c, d] = of(model);
        writeln!(text, "{name},{a:016x},{b:016x},{c:016x},{d:016x}").expect("room");
    };
    for (index, model) in variants(&mut Random(46)).iter().enumerate() {
        line(format!("{}-{index}", model.name()), model);
        line(format!("{}-{index}-formula", model.name()), &as_formula(model));
    }
    for (index, model) in others().iter().enumerate() {
        line(format!("formula-{index}"), model);
    }
    text
}
