//! Plants whose motion is known exactly: the truth the estimators are held against.
//!
//! | file | what |
//! |---|---|
//! | `axis` | one axis, y'' = k f + c, stepped without discretisation error |
//! | `recording` | a noise-free flight of one axis under a PD-like law |

// Brackets in these docs hold units and sample indices.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod axis;
pub mod recording;

pub use axis::HeldInputAxis;
pub use recording::{Motion, Recording, RecordingConfig, record};
