//! `report`: one HTML file with everything in it.

use crate::cli::ReportArgs;
use crate::disk;
use crate::failure::Failure;
use crate::figure;
use crate::gate;
use crate::lock::Lock;
use crate::page;
use crate::paths::{PAGE, PAPER_SUMS, Paths};
use crate::print;
use crate::sums;

/// Runs the verb.
///
/// # Errors
/// Stale, Differs: the figures do not verify. Failed: something that the page is made from is missing or malformed.
pub fn run(paths: &Paths, arguments: &ReportArgs) -> Result<(), Failure> {
    let _lock = Lock::take(paths)?;
    gate::figures_verify(paths, &figure::discover(paths)?)?;
    let html = page::render(paths)?;
    let hash = files::write::sha256(html.as_bytes());
    match &arguments.out {
        Some(file) => {
            disk::write(file, html.as_bytes())?;
            print::out(&format!("{}\n", file.display()))
        }
        None => {
            disk::write_if_changed(&paths.root.join(PAGE), html.as_bytes())?;
            sums::record(&paths.root.join(PAPER_SUMS), PAGE, &hash)?;
            print::out(&format!("{PAGE}\n"))
        }
    }
}
