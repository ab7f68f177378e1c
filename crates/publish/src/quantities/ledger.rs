//! Named measures from the ledger of claims, and the number of claims with each verdict.

use super::form::Form;
use super::{Quantities, Source};
use checkout::failure::Failure;
use checkout::paths::LEDGER;
use claims::entry::Verdict;
use claims::report::{Ledger, Tested};

/// Adds `claim.ID.NAME` (and `erratum`, `parameter`) for each test with a name, and `claims.VERDICT`.
///
/// # Errors
/// As [`Ledger::read`].
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let Ledger { claims, errata, parameters, .. } = Ledger::read(source.paths)?;
    entries(all, "claims", "claim", claims.iter().map(|claim| (&*claim.id, &*claim.tests)));
    entries(all, "errata", "erratum", errata.iter().map(|erratum| (&*erratum.id, &*erratum.tests)));
    entries(all, "parameters", "parameter", parameters.iter().map(|one| (&*one.id, &*one.tests)));
    for verdict in Verdict::ALL {
        let count = claims.iter().filter(|claim| claim.found() == verdict).count();
        all.exact(&format!("claims.{}", verdict.words().replace(' ', "-")), count as f64, LEDGER);
    }
    Ok(())
}

/// The number of entries of a list, and what their tests measure.
fn entries<'a>(
    all: &mut Quantities,
    list: &str,
    short: &str,
    entries: impl ExactSizeIterator<Item = (&'a str, &'a [Tested])>,
) {
    all.exact(&format!("{list}.count"), entries.len() as f64, LEDGER);
    for (id, tests) in entries {
        tests.iter().for_each(|test| measure(all, &format!("{short}.{id}"), test));
    }
}

fn measure(all: &mut Quantities, start: &str, test: &Tested) {
    let (Some(name), value) = (&test.name, test.value) else { return };
    if !value.is_finite() {
        return;
    }
    let error = Some(test.error).filter(|error| error.is_finite() && *error > 0.0);
    // three digits say what a measure is; where its error is larger they are fewer
    let rounded = Form::rounded(value, 3);
    let form = match error {
        Some(error) if error > value.abs() * 1e-3 => Form::uncertain(value, error),
        _ if value.fract() == 0.0 => Form::exact(value),
        _ => rounded,
    };
    all.add(&format!("{start}.{name}"), Some(value), error, form, &format!("{LEDGER}: {start}"));
}
