//! A verification as one HTML page: the four levels, and differing pictures side by side. The page makes no network
//! request.

use crate::attest::Attestation;
use crate::findings::Findings;
use crate::judgement::Judgement;
use crate::pictures::Picture;
use crate::{html, words};
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use checkout::disk;
use checkout::failure::Failure;
use minijinja::{Value, context};

/// The page.
///
/// # Errors
/// A picture cannot be read.
pub fn html(findings: &Findings, attested: &[Attestation]) -> Result<String, Failure> {
    let differing = findings.figures.iter().filter(|figure| !figure.is_same()).map(section);
    let machine = |one: &Attestation| {
        let bits = if one.sums == findings.sums { "the same as here" } else { "others than here" };
        let Attestation { processor, system, rustc, processors, .. } = one;
        [processor.clone(), system.clone(), rustc.clone(), processors.to_string(), bits.to_owned()]
    };
    let head = ["processor", "system", "rustc", "processors", "bits"].map(str::to_owned);
    let machines = std::iter::once(head).chain(attested.iter().map(machine));
    let page = context! {
        summary => if findings.are_same() { "Everything is as committed." } else { findings.verdict().meaning() },
        rows => findings.rows(), left_out => findings.left_out_line(), claims => findings.claims.line(),
        differences => [findings.claims.details(), findings.strays.clone()].concat().join("\n"),
        figures => differing.collect::<Result<Vec<Value>, Failure>>()?,
        attested => if attested.is_empty() { Vec::new() } else { machines.collect::<Vec<_>>() },
    };
    html::environment().render_named_str("page.html", include_str!("page.html"), page).map_err(Failure::failed)
}

/// What differs in a figure.
fn section(figure: &Judgement) -> Result<Value, Failure> {
    let mut pictures = Vec::new();
    for (name, picture) in &figure.pictures {
        let Picture::Pixels(_, shown) = picture else { continue };
        for (file, what) in shown.files.iter().zip(["expected", "actual", "difference"]) {
            let data = BASE64_STANDARD.encode(disk::read_bytes(file)?.unwrap_or_default());
            pictures.push(context! { name, what, data });
        }
    }
    let details = words::details(figure).join("\n");
    Ok(context! { id => &figure.id, meaning => figure.verdict().meaning(), details, pictures })
}
