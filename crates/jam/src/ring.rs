//! The ring of pedestrians and its initial state.

/// `N` pedestrians on a ring of length `L`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// `N >= 2`.
    pub pedestrians: usize,
    /// `L > 0`, in units of `a_0`.
    pub length: f64,
}

impl Ring {
    /// `Delta y = L / N`, in units of `a_0`: the spacing of the uniform flow. Its inverse is the density.
    pub fn headway(&self) -> f64 {
        self.length / self.pedestrians as f64
    }
}

/// The initial state: equal distances, all speeds 0, pedestrian 0 moved forward by `shift` (`eps_1` of the paper).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// In units of `a_0`, of either sign; smaller in size than the effective gap at rest, so that both gaps of
    /// pedestrian 0 are open.
    pub shift: f64,
}
