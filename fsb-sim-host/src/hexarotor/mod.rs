//! The paper's target vehicle in six degrees of freedom: a fully actuated hexarotor with passively tilted rotors, equations
//! (1)-(9) in full and in f64 (section II, Fig. 1; its references 17 and 18).
//!
//! World frame: z up. Body frame: x along arm 1, z up through the rotors' plane, origin in the centre of mass. Attitude:
//! R(η) of (2) turns body into world coordinates, η = (roll, pitch, yaw) = (φ, θ, ψ). Everything in SI units, angles in
//! radians.
//!
//! ```text
//! x'' = (R F + R F_drag)/m - g e3,      R' = R S(ω),      I ω' = τ - ω × (I ω + h) - h' - d ∘ ω
//! ```
//!
//! The rotors give F and τ; F_drag, the damping d and the rotors' own angular momentum h are no part of the paper and are off
//! unless asked for, as are rotor lag and wind: [`HexarotorConfig::default`] is section II with thrust limits.
//!
//! | file | what |
//! |---|---|
//! | `vehicle` | the plant: thrust commands in, motion out |
//! | `config`, `error` | it as data, checked |
//! | `attitude` | unit quaternion, rotation matrix, Euler angles of the paper, (1) |
//! | `body` | the differential equations |
//! | `frame` | arms, tilts, the allocation matrix and its inverse |
//! | `allocation` | a wrench to thrusts within limits, and which wrenches are attainable |
//! | `rotors` | thrust ∝ Ω², first-order lag, angular momentum of the rotors |
//! | `wind` | mean wind and first-order gusts |
//! | `vector` | three-vectors |

// Units stand in brackets; they are no links.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod allocation;
pub mod attitude;
mod body;
pub mod config;
pub mod error;
pub mod frame;
mod rotors;
pub mod vector;
pub mod vehicle;
mod wind;

pub use allocation::{Allocation, Allocator, Attainable};
pub use attitude::{Quaternion, body_rates, euler_matrix, euler_rates};
pub use config::{
    DragConfig, FrameConfig, HexarotorConfig, LagOn, Payload, PayloadStep, RotorConfig, StartConfig, WindConfig,
};
pub use error::ParameterError;
pub use frame::{Frame, Wrench};
pub use vehicle::{Hexarotor, State, TrueParameters};
