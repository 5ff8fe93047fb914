//! The paper's algorithms literally: continuous time, f64, errata corrected (`docs/errata.md`).
//!
//! Source: Kasac, Kotarski, Piljek, Asian Journal of Control 21 (2019) 1619-1629, doi 10.1002/asjc.2042. Numbers in
//! parentheses are that paper's equations. Model (15): y'' = k f + c, c a known constant drift (-g on the vertical axis).
//!
//! | file | what |
//! |---|---|
//! | `window` | h(t), w1, w2, w3, w̄2, w̄3 and the matrices B(t), C(t): (39)-(43), (60) |
//! | `rk4` | the integrator and what a step has to know |
//! | `identifier` | the six states (38) and the read-out (44) |
//! | `observer` | the two states (53)-(54) and the outputs (57), (59) |
//! | `adb` | the derivative-based observer (66)-(67) |
//! | `estimator` | identifier and observer on sampled data, as they fly a loop |
//! | `bibo` | the gains of (61)-(64), corrected |
//!
//! Every system is linear and integrated by the classical Runge-Kutta method. Between samples y is the chord of the two
//! samples and f is held; a step is taken when its closing sample arrives, so nothing looks ahead.

// Brackets in these docs hold units and sample indices.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod adb;
pub mod bibo;
pub mod estimator;
pub mod identifier;
pub mod observer;
pub mod rk4;
pub mod window;

pub use adb::{AdbConfig, AdbEstimator, AdbObserver};
pub use estimator::{ConfigError, PaperConfig, PaperEstimator, ParameterFrom};
pub use identifier::{Identifier, absolute_ratio};
pub use observer::Observer;
pub use rk4::{Step, ThroughStep, rk4};
pub use window::{Tuning, Window};
