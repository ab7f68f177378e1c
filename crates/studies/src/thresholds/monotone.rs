//! Whether values rise or fall from cell to cell along the axes of the maps.

use crate::hard::rows::{Rows, row};
use figures::failure::Failure;
use scene::map::Map;

/// For each map and each of its axes: pairs of neighbouring cells in which the value rises, falls, or stays the same.
/// Neighbours that are both stable, both unstable, or one of each are counted apart: `all` and `across` (one stable,
/// one not; there `rising` means that stability is lost along the axis).
///
/// # Errors
/// A map cannot be computed, or a cell of it is blank.
pub fn table(maps: &[(&str, Map)]) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["figure", "panel", "axis", "cells", "pairs", "rising", "falling", "lost", "regained"]);
    for (name, map) in maps {
        let (figure, panel) = name.split_once('_').unwrap_or((name, ""));
        let computed = map.compute().map_err(Failure::input)?;
        let whole = computed.whole().map_err(|why| Failure::work(format!("{name}: {why}")))?;
        let values = whole.column(map.columns()[2])?;
        let (columns, lines) = (map.x.cells, map.y.cells);
        let value = |i: usize, j: usize| values[i * lines + j];
        for (axis, along_x) in [(map.x.parameter.as_str(), true), (map.y.parameter.as_str(), false)] {
            let [mut pairs, mut rising, mut falling, mut lost, mut regained] = [0_usize; 5];
            let (last_i, last_j) = if along_x { (columns - 1, lines) } else { (columns, lines - 1) };
            for (i, j) in (0..last_i).flat_map(|i| (0..last_j).map(move |j| (i, j))) {
                let (here, next) = (value(i, j), if along_x { value(i + 1, j) } else { value(i, j + 1) });
                pairs += 1;
                rising += usize::from(next > here);
                falling += usize::from(next < here);
                lost += usize::from(here <= 0.0 && next > 0.0);
                regained += usize::from(here > 0.0 && next <= 0.0);
            }
            rows.push(row![figure, panel, axis, values.len(), pairs, rising, falling, lost, regained]);
        }
    }
    Ok(rows)
}
