//! The crate `differential-equations`: DOP853, Dormand and Prince's 5(4) and Verner's pairs; samples from its
//! interpolants.
//!
//! Arguments and results as in `bench/cpp/harness.hpp`; the right-hand side is the library of `bench/cpp/rhs.cpp`.

use differential_equations::ode::ODE;
use differential_equations::prelude::{ExplicitRungeKutta, IVP, Solution};
use std::error::Error;
use std::ffi::{CString, c_char, c_int, c_long};
use std::fmt::Write as _;

#[link(name = "rhs")]
unsafe extern "C" {
    fn ring_open(name: *const c_char, deviation: c_int) -> c_long;
    fn ring_start(y: *mut f64);
    fn ring_evaluations() -> c_long;
    fn ring_rates(t: f64, y: *const f64, f: *mut f64, nothing: *const f64);
}

#[repr(C)]
struct Timespec {
    seconds: i64,
    nanoseconds: i64,
}

unsafe extern "C" {
    fn clock_gettime(clock: c_int, now: *mut Timespec) -> c_int;
}

const CLOCK_PROCESS_CPUTIME_ID: c_int = 2;

fn cpu_seconds() -> f64 {
    let mut now = Timespec { seconds: 0, nanoseconds: 0 };
    // SAFETY: `now` has the layout of a 64-bit `struct timespec`
    unsafe { clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &mut now) };
    now.seconds as f64 + 1e-9 * now.nanoseconds as f64
}

/// The ring that the library has open.
struct Ring;

impl ODE<f64, Vec<f64>> for Ring {
    fn diff(&self, t: f64, y: &Vec<f64>, rates: &mut Vec<f64>) {
        // SAFETY: both have the dimension of the open ring, and do not overlap
        unsafe { ring_rates(t, y.as_ptr(), rates.as_mut_ptr(), std::ptr::null()) };
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [case, form, method, tolerance, ratio, repeats, times, states] = arguments.as_slice() else {
        return Err("usage: CASE FORM METHOD TOLERANCE RATIO REPEATS TIMES STATES".into());
    };
    if form != "plain" {
        return Err("forms: plain".into());
    }
    let relative: f64 = tolerance.parse()?;
    let absolute = relative * ratio.parse::<f64>()?;
    let end = if case == "algebraic_stable" { 500.0 } else { 3000.0 };
    let mut seconds = Vec::new();
    let (mut evaluations, mut steps) = (0, 0);
    for _ in 0..repeats.parse::<usize>()? {
        let start = open(case)?;
        let clock = cpu_seconds();
        let solution = solve(method, start, end, relative, absolute)?;
        let spread: Vec<f64> = solution.y.iter().map(|y| spread(&y[y.len() / 2..])).collect();
        seconds.push(cpu_seconds() - clock);
        if spread.len() != end as usize + 1 {
            return Err("not all samples were taken".into());
        }
        // SAFETY: reads a number
        evaluations = unsafe { ring_evaluations() };
        steps = solution.steps.total();
        std::fs::write(states, table(&solution.y, times)?)?;
    }
    println!(r#"{{"seconds": {seconds:?}, "evaluations": {evaluations}, "steps": {steps}}}"#);
    Ok(())
}

/// Opens the ring of a case in the library: its state at the start, gaps and then speeds.
fn open(case: &str) -> Result<Vec<f64>, Box<dyn Error>> {
    let name = CString::new(case)?;
    // SAFETY: a string that ends in a zero byte; then a vector as long as the library says
    unsafe {
        let mut start = vec![0.0; usize::try_from(ring_open(name.as_ptr(), 0))?];
        ring_start(start.as_mut_ptr());
        Ok(start)
    }
}

/// Integrates from 0 to `end`, with a sample at every unit of time.
fn solve(
    method: &str,
    start: Vec<f64>,
    end: f64,
    relative: f64,
    absolute: f64,
) -> Result<Solution<f64, Vec<f64>>, Box<dyn Error>> {
    let problem = IVP::ode(&Ring, 0.0, end, start).even(1.0);
    // every method has a type of its own
    macro_rules! with {
        ($name:ident) => {
            problem.method(ExplicitRungeKutta::$name().rtol(relative).atol(absolute).max_steps(100_000_000)).solve()
        };
    }
    let solved = match method {
        "dopri54" => with!(dopri5),
        "dop853" => with!(dop853),
        "verner65" => with!(rkv656e),
        "verner76" => with!(rkv767e),
        "verner87" => with!(rkv878e),
        "verner98" => with!(rkv989e),
        _ => return Err("methods: dopri54, dop853, verner65, verner76, verner87, verner98".into()),
    };
    solved.map_err(|error| format!("{error:?}").into())
}

/// The population standard deviation.
fn spread(speeds: &[f64]) -> f64 {
    let count = speeds.len() as f64;
    let mean = speeds.iter().sum::<f64>() / count;
    (speeds.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / count).sqrt()
}

/// `t,n,gap,speed` at the wanted times.
fn table(samples: &[Vec<f64>], times: &str) -> Result<String, Box<dyn Error>> {
    let mut text = "t,n,gap,speed\n".to_owned();
    for time in times.split(',') {
        let (gaps, speeds) = {
            let y = &samples[time.parse::<usize>()?];
            y.split_at(y.len() / 2)
        };
        for (n, (gap, speed)) in gaps.iter().zip(speeds).enumerate() {
            writeln!(text, "{time},{n},{gap:?},{speed:?}")?;
        }
    }
    Ok(text)
}
