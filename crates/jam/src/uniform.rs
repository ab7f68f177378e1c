//! The uniform flow: equal gaps, equal and constant speeds.

use crate::laws::Model;

/// Why there is no uniform flow with open gaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoUniformFlow {
    /// The headway `Delta y` asked for.
    pub headway: f64,
}

impl std::fmt::Display for NoUniformFlow {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "no uniform flow at headway L/N = {:?}: at no speed from -1e12 v_0 to v_0 does the drive balance the force with room left; a longer ring, fewer pedestrians or a weaker force has a uniform flow",
            self.headway
        )
    }
}

impl std::error::Error for NoUniformFlow {}

/// The steady speed `v'` at which the acceleration vanishes when all gaps are `headway` and all speeds equal. It is
/// implicit (eq2) because the room depends on the speed; found by bisection to the last bit, the acceleration falling
/// with the speed.
///
/// # Errors
/// [`NoUniformFlow`] when at no speed from -1e12 times the desired one up to it the drive balances the force with room left.
pub fn steady_speed(model: &Model, headway: f64) -> Result<f64, NoUniformFlow> {
    let pushes = |speed: f64| {
        let has_room = !model.is_singular() || model.room(headway, speed, speed) > 0.0;
        has_room && model.acceleration(headway, speed, speed) > 0.0
    };
    let has_room = |speed: f64| model.room(headway, speed, speed) > 0.0;
    let desired = model.desired_speed();
    let mut slow = -desired;
    // a strong force asks for a negative speed: go down until it is found, or the doubling runs away
    while has_room(slow) && !pushes(slow) && slow > -1e12 * desired {
        slow *= 2.0;
    }
    if !has_room(slow) || !pushes(slow) {
        return Err(NoUniformFlow { headway });
    }
    let mut fast = desired;
    loop {
        let middle = 0.5 * (slow + fast);
        if middle <= slow || middle >= fast {
            return if has_room(slow) { Ok(slow) } else { Err(NoUniformFlow { headway }) };
        }
        if pushes(middle) { slow = middle } else { fast = middle }
    }
}
