//! The C functions that the module exports. A function that answers with text or bytes keeps them and returns their
//! length; [`answer`] returns their address, which is valid until the next call. A negative length announces an error
//! message. Input is written to the address that [`room`] returns before the call.
#![allow(unsafe_code, reason = "an exported name is `unsafe` since two of the same would clash; nothing else here is")]

use crate::compute::Tables;
use crate::figures::FIGURES;
use crate::page::Page;
use crate::rejudge::Ran;
use crate::{flow, rejudge, simulate};
use serde_json::{Value, json};
use std::sync::{Mutex, MutexGuard, PoisonError};

static TABLES: Mutex<Tables> = Mutex::new(Tables::new());
static ANSWER: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static RAN: Mutex<Option<Ran>> = Mutex::new(None);
static GIVEN: Mutex<Vec<u8>> = Mutex::new(Vec::new());

/// The number of figures; they are counted from 0.
#[unsafe(no_mangle)]
pub extern "C" fn figure_count() -> usize {
    FIGURES.len()
}

/// The number of tables of a figure; 0 for a figure that does not exist.
#[unsafe(no_mangle)]
pub extern "C" fn table_count(figure: usize) -> usize {
    FIGURES.get(figure).map_or(0, |figure| figure.tables.len())
}

/// Computes the tables of a figure; the answer has a line of `data/SHA256SUMS` for each.
#[unsafe(no_mangle)]
pub extern "C" fn sums(figure: usize) -> isize {
    let lines = match FIGURES.get(figure) {
        Some(figure) => lock(&TABLES).sums(figure).map(String::into_bytes),
        None => Err(missing("figure", figure, FIGURES.len())),
    };
    keep(lines)
}

/// Computes one table; the answer is its CSV.
#[unsafe(no_mangle)]
pub extern "C" fn table(figure: usize, table: usize) -> isize {
    let bytes = match FIGURES.get(figure).map(|figure| (figure, figure.tables.get(table))) {
        Some((figure, Some(entry))) => lock(&TABLES).csv(figure, entry),
        Some((figure, None)) => Err(missing("table", table, figure.tables.len())),
        None => Err(missing("figure", figure, FIGURES.len())),
    };
    keep(bytes)
}

/// Allocates a buffer of the given size for the input of the next call, and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    let mut given = lock(&GIVEN);
    *given = vec![0; length];
    given.as_mut_ptr()
}

/// Small waves on the uniform flow of the scene in the room; the answer is JSON, see [`flow::of`].
#[unsafe(no_mangle)]
pub extern "C" fn stability(count: usize) -> isize {
    with_given(|text| flow::of(text, count))
}

/// Runs the scene in the buffer and reports progress to the page; the answer is JSON, see [`simulate::run`].
#[unsafe(no_mangle)]
pub extern "C" fn run() -> isize {
    with_given(|text| {
        let (told, ran) = simulate::run_kept(text, &mut Page)?;
        *lock(&RAN) = Some(ran);
        Ok(told)
    })
}

/// Judges the claims in the room on the run before; the answer is JSON, see [`rejudge::judge`].
#[unsafe(no_mangle)]
pub extern "C" fn judge() -> isize {
    with_given(|text| match &*lock(&RAN) {
        Some(ran) => rejudge::judge(text, ran),
        None => Err(json!({ "problem": "there was no run" })),
    })
}

/// SHA-256 of the bytes in the room, as hexadecimal digits.
#[unsafe(no_mangle)]
pub extern "C" fn sum() -> isize {
    keep(Ok(files::write::sha256(&lock(&GIVEN)).into_bytes()))
}

/// The address of the answer to the last call.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    lock(&ANSWER).as_ptr()
}

fn with_given(compute: impl FnOnce(&str) -> Result<Value, Value>) -> isize {
    let given = lock(&GIVEN);
    let answer = compute(&String::from_utf8_lossy(&given));
    keep(answer.map(|told| told.to_string().into_bytes()).map_err(|complaint| complaint.to_string()))
}

fn missing(what: &str, index: usize, count: usize) -> String {
    format!("{what} {index}: there are {count}, counted from 0")
}

/// Keeps the answer; its length, negative for a message.
fn keep(answer: Result<Vec<u8>, String>) -> isize {
    let (bytes, sign) = match answer {
        Ok(bytes) => (bytes, 1),
        Err(message) => (message.into_bytes(), -1),
    };
    // a Vec is never longer than isize::MAX
    let length = sign * bytes.len() as isize;
    *lock(&ANSWER) = bytes;
    length
}

/// What an earlier panic left behind is whole: both values are replaced in one assignment.
fn lock<T>(mutex: &'static Mutex<T>) -> MutexGuard<'static, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
