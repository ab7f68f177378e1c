//! Chooses the form of the state for a run, and checks that the law has a value at the start.

use crate::laws::Model;
use crate::ring::{Ring, Start};
use crate::states::{RingSystem, StateVariables};
use ode::Method;

/// Below this response of the uniform flow to a gap, its force has lost digits to underflow.
const LEAST_RESPONSE: f64 = 1e-280;

/// The form of the state: deviations from the uniform flow of this speed if none is `wanted` and they can hold the run,
/// else spacings.
pub fn fitting(wanted: Option<StateVariables>, model: &Model, ring: Ring, speed: Option<f64>) -> StateVariables {
    let form = wanted.unwrap_or(StateVariables::Deviations);
    if form == StateVariables::Deviations && !has_deviations(model, ring, speed) {
        StateVariables::Spacings
    } else {
        form
    }
}

/// The default method of a run: Taylor's, the steps of which end on [kinks](Model::has_kinks); or `dop853` in
/// positions, which have no series, and for laws with [kinks that do not suit Taylor's
/// method](Model::has_unsuited_kinks).
pub fn usual_method(form: StateVariables, model: &Model) -> Method {
    if form == StateVariables::Positions || model.has_unsuited_kinks() { Method::Dop853 } else { Method::Taylor }
}

/// Whether a ring has a uniform flow that its state can deviate from.
pub fn has_deviations(model: &Model, ring: Ring, steady_speed: Option<f64>) -> bool {
    match steady_speed {
        None => false,
        // what the uniform flow itself cannot hold in a number is lost in deviations from it
        Some(speed) if model.is_of_paper() => model.linearise(ring.headway(), speed).phi >= LEAST_RESPONSE,
        // on a kink there is no uniform flow to be near to
        Some(speed) => model.response(ring.headway(), speed).is_some(),
    }
}

/// The first pedestrian whose acceleration is not finite at the start, and that.
pub fn without_value(form: &dyn RingSystem, start: Start, ring: Ring) -> Option<(usize, f64)> {
    let state = form.start(start);
    let mut rates = vec![0.0; state.len()];
    form.rates(&state, &mut rates);
    let (mut spacings, mut accelerations) = (vec![0.0; ring.pedestrians], vec![0.0; ring.pedestrians]);
    form.read_rates(&rates, &mut spacings, &mut accelerations);
    accelerations.iter().position(|a| !a.is_finite()).map(|n| (n, accelerations[n]))
}

/// The complaint that a formula looks further than once around the ring.
pub fn too_wide(model: &Model, ring: Ring) -> Option<String> {
    let Model::Formula(law) = model else { return None };
    let (behind, ahead) = law.reach();
    let reach = behind.max(ahead);
    let problem = || format!("the formulas look {reach} pedestrians away; there must be at least {}", reach + 1);
    (reach >= ring.pedestrians).then(problem)
}
