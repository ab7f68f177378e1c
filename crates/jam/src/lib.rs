//! Force-based models of pedestrians in single file on a ring: laws of motion, the uniform flow and its stability,
//! events and jams of a run, and its outcome. The crate uses no files and no clock, and gives the same bits on every
//! machine.
//!
//! A run of a law of your own, here the optimal-velocity model of Bando et al. (1995):
//!
//! ```
//! use jam::{laws::{Law, Model}, ring::{Ring, Start}, run::{Run, run}};
//!
//! #[derive(Clone, Copy, Debug, Default)]
//! struct OptimalVelocity;
//! impl Law for OptimalVelocity {
//!     const CONTACT: f64 = 0.0;
//!     fn acceleration<X: jam::math::number::Number>(&self, spacing: X, speed: X, _ahead: X) -> X {
//!         (spacing - 2.0).tanh() + 0.9640275800758169 - speed
//!     }
//! }
//! let ring = Ring { pedestrians: 50, length: 100.0 };
//! let outcome = run(&Run::new(Model::own(OptimalVelocity)?, ring, Start { shift: 0.1 }, 300.0)?)?;
//! println!("standard deviation of the speeds at t = 300: {}", outcome.samples.std[300]);
//! # assert!((outcome.samples.std[300] - 0.8).abs() < 0.2, "jams: {}", outcome.samples.std[300]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Units
//!
//! All quantities are dimensionless. For the laws of the paper (Chraibi et al., Phys. Rev. E 92, 042809, 2015) lengths
//! are in units of `a_0`, half the size of a standing pedestrian, and times in units of `tau`, the relaxation time
//! (eq-rescale); a law of your own brings its own units of length and time, and where the documentation says `a_0` and
//! `tau`, read these. Wave numbers `k` are in radians per pedestrian.
//!
//! Rows have one number for each of the `N` pedestrians, who are counted from 0; pedestrian `n` follows `n + 1`, and
//! the last follows the first. With a row of another length a call panics, or its result has no meaning. Positions are
//! unwrapped: they grow beyond the length of the ring.
//!
//! A number that does not exist is `None` or an error, with two exceptions: where an acceleration has no value it is
//! NaN, and so are coefficients of [`stability::Linear`] where a law has no derivatives. What is computed from NaN is
//! NaN.
//!
//! The crates that occur in signatures are re-exported: [`math`] (kinds of numbers), [`ode`] (methods, tolerances,
//! steps) and [`formula`] (the language of formulas).
//!
//! # A tour
//!
//! ## Laws
//!
//! [`laws::Model`] is a law with its parameters: one of the three of the paper, a [`laws::Formula`], or a Rust type
//! that implements [`laws::Law`].
//!
//! ```
//! use jam::laws::{Logarithmic, Model};
//!
//! let law = Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 });
//! assert_eq!(law.parameters(), ["a_v", "epsilon", "v0"]);
//! let faster = law.with("v0", 1.5)?;
//! assert_eq!(faster.desired_speed(), 1.5);
//! // an acceleration: spacing, own speed, speed ahead; far from all others, from rest
//! assert!((faster.acceleration(10.0, 0.0, 0.0) - 1.5).abs() < 1e-12);
//! assert!(law.with("mu", 1.0).unwrap_err().contains("a_v, epsilon, v0"));
//! # Ok::<(), String>(())
//! ```
//!
//! A formula as a text needs no compiler and may look at several neighbours. A law in Rust runs at the speed of the
//! built-in ones; its formula is written once for any [`math::number::Number`], and accelerations, linear stability,
//! Taylor's method and differences from the uniform flow without cancellation follow from it.
//!
//! ## Stability
//!
//! The uniform flow has equal spacings and the [steady speed](uniform::steady_speed). Its [`stability::Response`] is
//! exact for every wave number `k` in (0, pi].
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
//! A map is a loop over parameters and headways. A point where the law has no uniform flow, or no derivative, has no
//! value. The law is a Rust type here, whose parameter is known by its name:
//!
//! ```
//! use jam::laws::{Law, Model, Parameter, Range};
//! use jam::math::number::Number;
//! use jam::stability::Waves;
//! use jam::uniform::steady_speed;
//!
//! #[derive(Clone, Copy, Debug, Default)]
//! struct OptimalVelocity {
//!     kappa: f64,
//! }
//! impl Law for OptimalVelocity {
//!     const PARAMETERS: &'static [Parameter<Self>] =
//!         &[Parameter { name: "kappa", range: Range::Positive, default: None, place: |law| &mut law.kappa }];
//!     const CONTACT: f64 = 0.0;
//!     #[inline(always)]
//!     fn acceleration<X: Number>(&self, spacing: X, speed: X, _ahead: X) -> X {
//!         ((spacing - 2.0).tanh() + 0.9640275800758169 - speed) * self.kappa
//!     }
//! }
//!
//! let law = Model::own(OptimalVelocity { kappa: 1.0 })?;
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
//! ## Samples, jams, and the outcome of a run
//!
//! [`run::Run`] says what is integrated and what is kept; its fields can be replaced. The [`run::Outcome`] holds
//! samples at regular times, taken from inside the steps; the jams at the end and how fast they travel ([`jams`]); and,
//! if an observer asks for it, the outcome of the run ([`outcome`]).
//!
//! ```
//! # use jam::laws::{Law, Model, Parameter, Range};
//! # use jam::math::number::Number;
//! # #[derive(Clone, Copy, Debug, Default)]
//! # struct OptimalVelocity {
//! #     kappa: f64,
//! # }
//! # impl Law for OptimalVelocity {
//! #     const PARAMETERS: &'static [Parameter<Self>] =
//! #         &[Parameter { name: "kappa", range: Range::Positive, default: None, place: |law| &mut law.kappa }];
//! #     const CONTACT: f64 = 0.0;
//! #     #[inline(always)]
//! #     fn acceleration<X: Number>(&self, spacing: X, speed: X, _ahead: X) -> X {
//! #         ((spacing - 2.0).tanh() + 0.9640275800758169 - speed) * self.kappa
//! #     }
//! # }
//! use jam::ode::{Control, Method};
//! use jam::outcome::Class;
//! use jam::ring::{Ring, Start};
//! use jam::run::{Judging, Run, run_from};
//!
//! let law = Model::own(OptimalVelocity { kappa: 1.0 })?;
//! let ring = Ring { pedestrians: 50, length: 100.0 };
//! let run = Run::new(law, ring, Start { shift: 0.1 }, 300.0)?;
//! let run = Run { sample: 10.0, method: Method::Taylor, control: Control::Adaptive { tolerance: 1e-10 }, ..run };
//! let outcome = run_from(&run, None, &mut Judging::Along)?;
//!
//! assert_eq!(outcome.samples.len(), 31);
//! let last = outcome.samples.last().expect("a sample");
//! assert_eq!((last.time, last.speeds.len()), (300.0, 50));
//! let (jam_speed, duration) = outcome.drift.speed().expect("jams that travel");
//! assert!(jam_speed < 0.0 && duration > 0.0 && outcome.drift.jams().iter().all(|jam| jam.extent > 0.0));
//! let verdict = outcome.verdict.expect("it was asked for");
//! println!("{}: least gap {:.3}", verdict.class.in_words(), verdict.least_gap);
//! // the waves have not settled yet
//! assert_eq!(verdict.class, Class::Undecided);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Events
//!
//! The first overlap, negative speed and exchange of places are found to the last bit of the time ([`events`]). An
//! overlap ends the samples, unless [`run::AtOverlap`] says otherwise.
//!
//! ```
//! # use jam::laws::{Law, Model, Parameter, Range};
//! # use jam::math::number::Number;
//! # #[derive(Clone, Copy, Debug, Default)]
//! # struct OptimalVelocity {
//! #     kappa: f64,
//! # }
//! # impl Law for OptimalVelocity {
//! #     const PARAMETERS: &'static [Parameter<Self>] =
//! #         &[Parameter { name: "kappa", range: Range::Positive, default: None, place: |law| &mut law.kappa }];
//! #     const CONTACT: f64 = 0.0;
//! #     #[inline(always)]
//! #     fn acceleration<X: Number>(&self, spacing: X, speed: X, _ahead: X) -> X {
//! #         ((spacing - 2.0).tanh() + 0.9640275800758169 - speed) * self.kappa
//! #     }
//! # }
//! use jam::events::EventKind;
//! use jam::ring::{Ring, Start};
//! use jam::run::{Run, run};
//!
//! let law = Model::own(OptimalVelocity { kappa: 0.5 })?;
//! let ring = Ring { pedestrians: 50, length: 100.0 };
//! let outcome = run(&Run::new(law, ring, Start { shift: 0.1 }, 300.0)?)?;
//! let overlap = outcome.stop().expect("speeds relax too slowly to keep a distance");
//! assert_eq!((overlap.kind, overlap.pedestrian), (EventKind::Overlap, 34));
//! assert!((overlap.time - 45.758754348).abs() < 1e-8);
//! assert_eq!(outcome.samples.times.last(), Some(&45.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! ## Looking on
//!
//! A [`run::RunObserver`] receives samples, events and steps as they occur, and can end a run. Long runs can be resumed
//! from a [`run::Checkpoint`].
//!
//! ```
//! # use jam::laws::{Formula, Model};
//! use jam::ring::{Ring, Start};
//! use jam::run::{Run, RunObserver, Sample, run_from};
//!
//! /// Ends a run once the speeds differ.
//! #[derive(Default)]
//! struct UntilWaves {
//!     time: Option<f64>,
//! }
//! impl RunObserver for UntilWaves {
//!     fn sampled(&mut self, sample: &Sample<'_>) {
//!         if sample.std > 0.1 {
//!             self.time.get_or_insert(sample.time);
//!         }
//!     }
//!     fn is_done(&self) -> bool {
//!         self.time.is_some()
//!     }
//! }
//!
//! # let acceleration = "kappa*(tanh(s - 2) + tanh(2) - v)";
//! # let lines = [("acceleration", acceleration.into()), ("kappa", 1.0.into()), ("body", 0.0.into())];
//! # let law = Model::Formula(Formula::written(&lines)?);
//! let run = Run::new(law, Ring { pedestrians: 50, length: 100.0 }, Start { shift: 0.1 }, 300.0)?;
//! let mut observer = UntilWaves::default();
//! let outcome = run_from(&run, None, &mut observer)?;
//! let time = observer.time.expect("the uniform flow is unstable");
//! assert!(time > 10.0 && outcome.statistics.time < 300.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Accuracy
//!
//! A tolerance bounds the error of a step, not that of a run. [`errors::stated`] makes a run and estimates the errors
//! of its results; it refuses samples that its check does not confirm. The estimates hold what steps leave out,
//! roundings, and a force that is off by a part at all times, as rounded constants make it: those of the law, and the
//! headway `L/N`. Parameters count as exact.
//!
//! ```
//! # use jam::laws::{Law, Model, Parameter, Range};
//! # use jam::math::number::Number;
//! # #[derive(Clone, Copy, Debug, Default)]
//! # struct OptimalVelocity {
//! #     kappa: f64,
//! # }
//! # impl Law for OptimalVelocity {
//! #     const PARAMETERS: &'static [Parameter<Self>] =
//! #         &[Parameter { name: "kappa", range: Range::Positive, default: None, place: |law| &mut law.kappa }];
//! #     const CONTACT: f64 = 0.0;
//! #     #[inline(always)]
//! #     fn acceleration<X: Number>(&self, spacing: X, speed: X, _ahead: X) -> X {
//! #         ((spacing - 2.0).tanh() + 0.9640275800758169 - speed) * self.kappa
//! #     }
//! # }
//! use jam::ring::{Ring, Start};
//! use jam::run::Run;
//!
//! let law = Model::own(OptimalVelocity { kappa: 1.0 })?;
//! let run = Run::new(law, Ring { pedestrians: 50, length: 100.0 }, Start { shift: 0.1 }, 300.0)?;
//! let (outcome, errors) = jam::errors::stated(&run)?;
//! let (std, error) = (outcome.samples.std[300], errors.std.expect("an estimate"));
//! println!("standard deviation of the speeds at t = 300: {std} +- {error:.0e}");
//! assert!(error > 0.0 && error < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use {formula, math, ode};

pub mod criteria;
pub mod errors;
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
