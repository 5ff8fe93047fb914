//! Recorded flights through the f32 core: the axis log and its reader.

pub mod log;
