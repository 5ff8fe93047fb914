//! The read-out's rules one by one.

mod covariance;
mod noise_level;
mod parameter;
mod status;
