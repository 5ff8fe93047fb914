//! The sampled-data form in f64, written from its definitions: an oracle for the f32 core that shares none of its formulas.
//!
//! | file | what | how it differs from the core |
//! |---|---|---|
//! | `window` | e, h, g at sample n | exp and expm1 at every sample instead of a recurrence |
//! | `moments` | J1, J2 of an interval | - |
//! | `identifier` | ẑ2, ẑ0, ẑu, on samples or block means | second differences and a simulated response instead of b1, b2, b3 and running sums |
//! | `observer` | position and velocity | textbook predictor-corrector, gains as differences |
//! | `read_out` | k from ẑ2 and ẑ0 | plain sums |
//!
//! Model: y'' = k f + c, f known through its moments, y sampled every T. With noise-free samples k, y and y' are exact to
//! rounding from the third sample on. f64 carries this: noise-free at 8 kHz the rounding of positions of a few metres costs
//! 1e-9 of k at the third sample, and less ever after.

// Brackets in these docs hold units and sample indices.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod identifier;
pub mod moments;
pub mod observer;
pub mod read_out;
pub mod window;

pub use identifier::{BlockOutput, TwinIdentifier};
pub use moments::Moments;
pub use observer::{RetroactiveObserver, TwinObserver};
pub use read_out::{TwinAbsoluteRatio, TwinLeastSquares};
pub use window::TwinWindow;
