//! The module `jamming._native`, which computes for the package `jamming`. It takes scenes as their author wrote them,
//! in TOML or as a dictionary, and returns arrays and the contents of `summary.json`. The user interface is written in
//! Python.

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
