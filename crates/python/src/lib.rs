//! The module `jamming._native`: what the package `jamming` computes with. It takes scenes as their author wrote them, in
//! TOML or as a dictionary, and gives back arrays and what `summary.json` says. What users see is written in Python.

mod compute;
mod given;
mod sweep;
mod watch;

use pyo3::pymodule;

/// Runs, maps, sweeps and stability.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::compute::{Response, map, response, simulate};
    #[pymodule_export]
    use crate::sweep::sweep;
}
