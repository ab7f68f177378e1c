//! Force-based models of pedestrians in single file on a ring: laws of motion, the uniform flow and its stability, events
//! and jams of a run, and what became of it. Pure: no files, no clock, the same bits on every machine.
//!
//! A run of a law of your own, here the optimal-velocity model of Bando et al. (1995):
//!
//! ```
//! # use jam::{laws::{Formula, Model}, ring::{Ring, Start}, states::StateVariables};
//! # use ode::{Control, Method, Problem, Step, integrate};
//! # use std::ops::ControlFlow;
//! let lines = [("acceleration", "kappa*(tanh(s - 2) + tanh(2) - v)".into()), ("kappa", 1.0.into()), ("body", 0.0.into())];
//! let law = Model::Formula(Formula::written(&lines)?);
//! let form = StateVariables::Deviations.build(&law, Ring { pedestrians: 50, length: 100.0 });
//! let start = form.start(Start { shift: 0.1 });
//! let (method, control) = (Method::Dop853, Control::Adaptive { tolerance: 1e-9 });
//! let problem = Problem { system: &*form, start: &start, begin: 0.0, end: 300.0, method, control };
//! let end = integrate(&problem, &mut |_: &mut Step<'_>| ControlFlow::Continue(()))?;
//! println!("standard deviation of the speeds at t = 300: {}", form.speed_deviation(&end.state));
//! # assert!((form.speed_deviation(&end.state) - 0.8).abs() < 0.2, "jams: {}", form.speed_deviation(&end.state));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Units
//!
//! All quantities are dimensionless. For the laws of the paper (Chraibi et al., Phys. Rev. E 92, 042809, 2015) lengths are in
//! units of `a_0`, half the size of a standing pedestrian, and times in units of `tau`, the relaxation time (eq-rescale); a
//! law of your own brings its own units. Rows have one number for each pedestrian; pedestrian `n` follows `n + 1`, and the
//! last follows the first.
//!
//! # A tour
//!
//! ## Laws
//!
//! [`laws::Model`] is a law with its parameters: one of the three of the paper, or a [`laws::Formula`].
//!
//! ```
//! use jam::laws::{Logarithmic, Model};
//!
//! let law = Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening: 0.0, epsilon: 0.01 });
//! assert_eq!(law.parameters(), ["a_v", "epsilon", "v0"]);
//! let faster = law.with("v0", 1.5)?;
//! assert_eq!(faster.desired_speed(), 1.5);
//! // an acceleration: spacing, own speed, speed ahead; far from everybody, from rest
//! assert!((faster.acceleration(10.0, 0.0, 0.0) - 1.5).abs() < 1e-12);
//! assert!(law.with("mu", 1.0).unwrap_err().contains("a_v, epsilon, v0"));
//! # Ok::<(), String>(())
//! ```
//!
//! A law in Rust runs at the speed of the built-in ones: [`laws::Law`] has one as an example. Its formula is written once for
//! any [`math::number::Number`], and [`force::Compiled`] makes the force of a ring of it. [`events::Watch`] and
//! [`outcome::Judge`] take a [`laws::Model`], so for these it has to be one of the built-in laws or a formula.
//!
//! ## Stability
//!
//! The uniform flow has equal spacings and the [steady speed](uniform::steady_speed). Its [`stability::Response`] is exact for
//! every wave number `k` in (0, pi].
//!
//! ```
//! use jam::laws::{Formula, Model};
//! use jam::stability::Waves;
//! use jam::uniform::steady_speed;
//!
//! let law = Model::Formula(Formula::written(&[
//!     ("acceleration", "kappa*(tanh(s - 2) + tanh(2) - v)".into()),
//!     ("kappa", 1.0.into()),
//!     ("body", 0.0.into()),
//!     ("scale", 1.0.into()),
//! ])?);
//! let headway = 2.0;
//! let speed = steady_speed(&law, headway)?;
//! assert!((speed - 0.9640275800758169).abs() < 1e-12);
//! let response = law.response(headway, speed).expect("the law has derivatives here");
//! // a margin above 0 is unstable: long waves grow, since V'(2) = 1 > kappa/2
//! let (margin, k) = response.margin(Waves::All);
//! assert!(margin > 0.0 && k == 0.0);
//! // on a ring of 50: k = 2 pi l / 50
//! let (growth_rate, l) = response.fastest(50);
//! assert!(growth_rate > 0.0 && l > 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## A map
//!
//! A map is a loop: where a law has no uniform flow, or no derivative, there is no value.
//!
//! ```
//! # use jam::laws::{Formula, Model};
//! # use jam::stability::Waves;
//! # use jam::uniform::steady_speed;
//! # let lines = [("acceleration", "kappa*(tanh(s - 2) + tanh(2) - v)".into()), ("kappa", 1.0.into()), ("body", 0.0.into())];
//! # let law = Model::Formula(Formula::written(&lines)?);
//! let margin = |kappa: f64, headway: f64| -> Option<f64> {
//!     let law = law.with("kappa", kappa).ok()?;
//!     let speed = steady_speed(&law, headway).ok()?;
//!     Some(law.response(headway, speed)?.margin(Waves::All).0)
//! };
//! let rows = [0.5, 1.5, 2.5].map(|kappa| [1.0, 2.0, 3.0].map(|headway| margin(kappa, headway)));
//! let is_stable = rows.map(|row| row.map(|value| value.is_some_and(|margin| margin < 0.0)));
//! // V'(2) = 1 needs kappa > 2, V'(1) = V'(3) = 0.42 needs kappa > 0.84
//! assert_eq!(is_stable, [[false, false, false], [true, false, true], [true, true, true]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Events, samples, jams, and what became of a run
//!
//! An [`ode::Observer`] sees every step. [`events::Watch`] finds the first overlap, negative speed and exchange of places in
//! them, to the last bit of the time; [`ode::Sampler`] takes states at regular times from inside the steps;
//! [`outcome::Judge`] says what became of the run; [`jams::find`] finds the jams of a snapshot.
//!
//! ```
//! # use jam::laws::{Formula, Model};
//! # use jam::ring::{Ring, Start};
//! # use jam::states::StateVariables;
//! # use ode::{Control, Method, Problem, Sampler, Step, integrate};
//! use jam::events::{EventKind, Watch};
//! use jam::outcome::{Class, Judge};
//! use jam::uniform::steady_speed;
//! use std::ops::ControlFlow;
//!
//! # let lines = [("acceleration", "kappa*(tanh(s - 2) + tanh(2) - v)".into()), ("kappa", 1.0.into()), ("body", 0.0.into())];
//! # let law = Model::Formula(Formula::written(&lines)?);
//! let ring = Ring { pedestrians: 50, length: 100.0 };
//! let form = StateVariables::Deviations.build(&law, ring);
//! let start = form.start(Start { shift: 0.1 });
//! let mut rates = vec![0.0; start.len()];
//! form.rates(&start, &mut rates);
//!
//! let mut watch = Watch::new(law.clone(), &*form, ring.pedestrians);
//! let mut judge = Judge::new(&law, ring, steady_speed(&law, ring.headway()).ok());
//! let mut sampler = Sampler::new(10.0, start.len());
//! let mut samples = vec![(0.0, form.speed_deviation(&start))];
//! let found = watch.start(0.0, &start, &rates);
//! judge.start(&watch, &found);
//! let mut observer = |step: &mut Step<'_>| {
//!     let new = watch.look(step);
//!     judge.look(&mut watch, step, &new);
//!     sampler.within(step, step.end, &mut |t, state| samples.push((t, form.speed_deviation(state))));
//!     // the law has no meaning behind a stop
//!     if new.iter().any(|happening| happening.kind.is_stop()) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
//! };
//! let (method, control) = (Method::Dop853, Control::Adaptive { tolerance: 1e-9 });
//! let problem = Problem { system: &*form, start: &start, begin: 0.0, end: 300.0, method, control };
//! let end = integrate(&problem, &mut observer)?;
//!
//! assert_eq!(samples.len(), 31);
//! assert!(watch.found().iter().all(|happening| happening.kind != EventKind::Overlap));
//! let verdict = judge.end(end.time, watch.found());
//! println!("{}: least gap {:.3}", verdict.class.in_words(), verdict.least_gap);
//! # assert!(matches!(verdict.class, Class::Undecided | Class::Waves | Class::WavesBackwards), "{verdict:?}");
//!
//! let (mut positions, mut gaps, mut speeds) = (vec![0.0; 50], vec![0.0; 50], vec![0.0; 50]);
//! form.write_positions(&end.state, &mut positions);
//! form.read(&end.state, &mut gaps, &mut speeds);
//! let threshold = jam::jams::threshold(&speeds, law.desired_speed()).expect("speeds differ");
//! let jams = jam::jams::find(&positions, &speeds, ring.length, threshold);
//! assert!(!jams.is_empty() && jams.iter().all(|jam| jam.extent > 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Accuracy
//!
//! A tolerance bounds the error of a step, not that of a run. Run twice, the second time with another method and a smaller
//! tolerance, and take the difference for the error of the first; [`ode::Shadow`] carries the errors of Taylor's method along.
#![deny(rustdoc::broken_intra_doc_links)]

pub mod criteria;
pub mod events;
pub mod force;
pub mod jams;
pub mod laws;
pub mod observe;
pub mod outcome;
pub mod precise;
pub mod ramp;
pub mod ring;
pub mod run;
pub mod stability;
pub mod states;
pub mod uniform;
pub mod waves;
