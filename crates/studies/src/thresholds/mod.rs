//! Where stability ends, exactly, compared with what the source says: critical values for all waves and for those of a
//! ring, criteria against growth rates in random cases, and behaviour beyond the linear theory.

pub mod all_waves;
mod contact;
pub mod critical;
mod jam_headway;
pub mod monotone;
mod slopes;
mod widening;

use crate::hard::Tables;
use figures::failure::Failure;

/// All tables of the supplement but that of the maps ([`monotone::table`]).
///
/// # Errors
/// There is no uniform flow where one is needed, or a run failed.
pub fn tables() -> Result<Tables, Failure> {
    Ok(vec![
        ("thresholds", critical::thresholds()?),
        ("ring", critical::ring()?),
        ("minus_delta", critical::minus_delta()),
        ("all_waves", all_waves::all_waves()),
        ("roots", all_waves::roots()),
        ("widening", widening::table()),
        ("widening_runs", widening::runs()?),
        ("safety", widening::safety()),
        ("slopes", slopes::slopes()),
        ("optimal_velocity", slopes::optimal_velocity()),
        ("relaxation", contact::relaxation()?),
        ("contact", contact::contact()?),
        ("collision", contact::collision()?),
        ("collision_by_headway", jam_headway::collision_by_headway()?),
        ("jam_headway", jam_headway::jam_headway()?),
    ])
}
