//! Shared by the tests of this package.

pub mod analytic;
pub mod drag_flight;
pub mod flight;
