//! A verification as one HTML page: the four levels, and differing pictures side by side. The page makes no network
//! request.

use crate::attest::Attestation;
use crate::findings::Findings;
use crate::judgement::Judgement;
use crate::pictures::Picture;
use crate::words;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use checkout::disk;
use checkout::failure::Failure;
use std::path::Path;

const STYLE: &str = "
:root { color-scheme: light dark; font: 16px/1.45 serif; }
body { max-width: 75rem; margin: 0 auto; padding: 1rem; }
table { border-collapse: collapse; } td, th { padding: .2rem .7rem; text-align: left; border-bottom: 1px solid #8886; }
.differs { font-weight: bold; color: light-dark(#a30000, #ff8a80); }
.sides { display: flex; gap: 1rem; flex-wrap: wrap; } figure { margin: 0; flex: 1 1 18rem; } img { width: 100%; background: #fff; }
pre { white-space: pre-wrap; }";

/// The page.
///
/// # Errors
/// A picture cannot be read.
pub fn html(findings: &Findings, attested: &[Attestation]) -> Result<String, Failure> {
    let differing: Vec<&Judgement> = findings.figures.iter().filter(|figure| !figure.is_same()).collect();
    let details: Vec<String> = differing.into_iter().map(section).collect::<Result<_, _>>()?;
    let left_out = findings.left_out_line().map_or(String::new(), |line| format!("<p>{}</p>\n", escape(&line)));
    let summary = if findings.are_same() { "Everything is as committed." } else { findings.verdict().meaning() };
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <title>Verification</title><style>{STYLE}</style></head><body>\n<main><h1>Verification</h1>\n\
         <p>{}</p>\n{}\n{left_out}{}{}<h2>Machines and their bits</h2>\n{}</main></body></html>\n",
        escape(summary),
        table(&findings.rows()),
        claims(findings),
        details.concat(),
        machines(attested, &findings.sums),
    ))
}

fn claims(findings: &Findings) -> String {
    let lines = [findings.claims.details(), findings.strays.clone()].concat().join("\n");
    format!("<p>{}</p>\n<pre class=\"differs\">{}</pre>\n", escape(&findings.claims.line()), escape(&lines))
}

/// What differs in a figure.
fn section(figure: &Judgement) -> Result<String, Failure> {
    let lines = words::details(figure).join("\n");
    let mut pictures = String::new();
    for (name, picture) in &figure.pictures {
        let Picture::Pixels(_, shown) = picture else { continue };
        for (file, what) in shown.files.iter().zip(["expected", "actual", "difference"]) {
            pictures.push_str(&image(file, &format!("{name}: {what}"), what)?);
        }
    }
    let (id, meaning) = (&figure.id, figure.verdict().meaning());
    Ok(format!(
        "<section><h2>{}: {meaning}</h2>\n<pre>{}</pre>\n<div class=\"sides\">{pictures}</div></section>\n",
        escape(id),
        escape(&lines)
    ))
}

fn image(file: &Path, alt: &str, caption: &str) -> Result<String, Failure> {
    let bytes = disk::read_bytes(file)?.unwrap_or_default();
    let data = BASE64_STANDARD.encode(bytes);
    let alt = escape(alt);
    Ok(format!(
        "<figure><img alt=\"{alt}\" src=\"data:image/png;base64,{data}\"><figcaption>{caption}</figcaption></figure>"
    ))
}

/// The machines that were attested, those with the bits of this run marked.
fn machines(attested: &[Attestation], sums: &str) -> String {
    let mut rows = vec![["processor", "system", "rustc", "processors", "bits"].map(str::to_owned).to_vec()];
    for one in attested {
        let bits = if one.sums == sums { "the same as here" } else { "others than here" };
        let Attestation { processor, system, rustc, processors, .. } = one;
        rows.push(vec![processor.clone(), system.clone(), rustc.clone(), processors.to_string(), bits.to_owned()]);
    }
    if attested.is_empty() { "<p>No attestations yet.</p>\n".to_owned() } else { table(&rows) }
}

fn table(rows: &[Vec<String>]) -> String {
    let cell = |tag: &str, text: &String| {
        let class = if text == "differs" { " class=\"differs\"" } else { "" };
        format!("<{tag}{class}>{}</{tag}>", escape(text))
    };
    let row = |(index, row): (usize, &Vec<String>)| {
        let tag = if index == 0 { "th" } else { "td" };
        format!("<tr>{}</tr>\n", row.iter().map(|text| cell(tag, text)).collect::<String>())
    };
    format!("<table>\n{}</table>\n", rows.iter().enumerate().map(row).collect::<String>())
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
