//! The step with the smallest error: found in the table of rounding, and predicted from its longest step.

use super::STATES;
use crate::hard::rows::{Rows, row};
use figures::failure::Failure;

/// For each form, sum and time: the step of the table with the smallest error of the gaps, that error, and the step at
/// which it is predicted. A plain run drops as much in each step whatever its length, so `R = r / h` besides the
/// truncation `C h^2`, and the best step is `(r / 2 C)^(1/3)`; `C` and `r` are those of the longest step. What a
/// compensated run drops does not depend on the step: nothing is gained below `(R / C)^(1/2)`.
///
/// # Errors
/// The table lacks a column or has no row.
pub fn table(rounding: &Rows) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["state", "sum", "t", "dt_best", "error_gap", "dt_predicted"]);
    for (_, state) in STATES {
        for sum in ["plain", "compensated"] {
            let columns = ["t", "dt", "error_gap", "truncation_gap", "rounding_gap"];
            let all = rounding.select(&[("state", state), ("sum", sum)], &columns)?;
            let longest = all.rows().map(|row| row[1]).fold(0.0, math::larger);
            for first in all.rows().filter(|row| row[1] == longest) {
                let (time, h) = (first[0], first[1]);
                let here = all.rows().filter(|row| row[0] == time);
                let best = here.fold(first, |best, row| if row[2] < best[2] { row } else { best });
                let c = first[3] / (h * h);
                let predicted =
                    if sum == "plain" { math::pow(first[4] * h / (2.0 * c), 1.0 / 3.0) } else { (first[4] / c).sqrt() };
                rows.push(row![state, sum, time, best[1], best[2], predicted]);
            }
        }
    }
    Ok(rows)
}
