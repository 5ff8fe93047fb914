//! Shared by the tests of this package.

pub mod analytic;
pub mod drag_flight;
pub mod drag_flights;
pub mod flight;
pub mod fly;
pub mod rigid_body;
pub mod seal;
pub mod six_axes;
pub mod subnormal;
pub mod turbulence;
pub mod words;
