//! The vehicle's estimator and the regression with drag, and how they are configured for the flights.

use fsb_core::regression::{DragConfig, DragEstimator};
use fsb_core::vehicle::{ChangeRule, Expected, VehicleConfig, VehicleEstimator};

use crate::drag::DRIFT;
use crate::rigid_body::{Conditions, INERTIA, LAG, MASS};

/// Room for a position that is late by so many ticks.
pub const LATEST: usize = 32;
/// The vehicle's estimator.
pub type Vehicle = VehicleEstimator<LATEST>;
/// x, y, z with drag and disturbance.
pub type Drag = DragEstimator<3>;

/// Positions at 100 Hz and attitudes at 1 kHz that are not late, actuators that follow at once.
pub const PLAIN: Conditions =
    Conditions { lag: false, position: [10, 0], attitude: [1, 0], loaded_at: None, quaternions: true, faults: false };
/// The same with positions 20 ms late and attitudes 2 ms, actuators that lag, and a load picked up after 5 s.
pub const FULL: Conditions = Conditions {
    lag: true,
    position: [10, 20],
    attitude: [1, 2],
    loaded_at: Some(5000),
    quaternions: false,
    faults: false,
};

/// The configuration at 1 kHz for a flight like that. What is expected of mass and inertia is a fifth too much.
pub fn config(conditions: &Conditions) -> VehicleConfig {
    let mut config = VehicleConfig::new(1e-3);
    config.mass = Expected::about(1.2 * MASS);
    config.inertia = INERTIA.map(|x| Expected::about(1.2 * x));
    [config.translation.substeps, config.translation.latency] = conditions.position;
    [config.rotation.substeps, config.rotation.latency] = conditions.attitude;
    config.rotation.block = 10;
    config.actuator_lag = conditions.lag.then_some(LAG);
    config.change = conditions.loaded_at.map(|_| ChangeRule::default());
    config
}

/// Starts.
pub fn vehicle(conditions: &Conditions) -> Vehicle {
    Vehicle::new(&config(conditions)).expect("a good configuration")
}

/// The configuration of the regression at a period \[s\] from one measurement to the next.
pub fn drag_config(period: f64) -> DragConfig<3> {
    let mut config = DragConfig::new(period);
    config.drift = DRIFT;
    config.nominal = Some(0.5);
    config
}
