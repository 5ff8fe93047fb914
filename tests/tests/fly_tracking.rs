//! What flying on the estimates costs: tracking beside the yardstick, which knows the truth.

use fsb_sim_host::fly::record::Tracking;
use fsb_tests::fly::fly;

/// Within 10 % of the yardstick's, or within 1 mm and 1 mrad of it.
fn near(ours: f64, yardstick: f64, room: f64) -> bool {
    ours <= (1.1 * yardstick).max(yardstick + room)
}

fn near_the_yardstick(of: &Tracking) -> bool {
    near(of.position_rms, of.yardstick_position_rms, 1e-3) && near(of.attitude_rms, of.yardstick_attitude_rms, 1e-3)
}

#[test]
fn near_the_yardstick_without_noise() {
    let quiet = ["sensors.position.noise_sd=0", "sensors.attitude.noise_sd=0"];
    for name in ["spiral", "aggressive"] {
        let flight = fly(name, &quiet, 1);
        assert!(near_the_yardstick(&flight.tracking), "{name}: {:?}", flight.tracking);
        // Without noise there is next to nothing between them.
        assert!((flight.tracking.position_rms / flight.tracking.yardstick_position_rms - 1.0).abs() < 0.02, "{name}");
    }
}

/// As they are built in: `spiral` with the noise of motion capture.
#[test]
fn near_the_yardstick_as_built_in() {
    for seed in 1..=5 {
        for name in ["spiral", "aggressive"] {
            let flight = fly(name, &[], seed);
            assert!(near_the_yardstick(&flight.tracking), "{name}: {:?}", flight.tracking);
        }
    }
}

/// With ten times that noise, 10 mm and 0.3°, the distance stays within 5 mm and 4 mrad of the yardstick's.
#[test]
fn with_noise_not_far_from_it() {
    let noise = ["rate=200", "sensors.position.noise_sd=0.01", "sensors.attitude.noise_sd=0.005235987755982988"];
    for name in ["spiral", "aggressive"] {
        for seed in 1..=5 {
            let Tracking { position_rms, attitude_rms, yardstick_position_rms, yardstick_attitude_rms, .. } =
                fly(name, &noise, seed).tracking;
            assert!(near(position_rms, yardstick_position_rms, 5e-3), "{name}: {position_rms}");
            assert!(near(attitude_rms, yardstick_attitude_rms, 4e-3), "{name}: {attitude_rms}");
        }
    }
}

/// The rotors' lag, known to the estimator as first order, costs no accuracy of the parameters.
#[test]
fn a_known_lag_is_reckoned_with() {
    let lag = [
        "plant.rotor.time_constant=0.03",
        "plant.rotor.lag_on=thrust",
        "estimator.actuator_lag=0.03",
        "plant.rotor.thrust_max=25",
    ];
    let flight = fly("aggressive", &lag, 1);
    let without = fly("aggressive", &lag[..2], 1);
    for i in 0..4 {
        let end =
            |flight: &fsb_sim_host::fly::Flight| flight.errors.last().unwrap().all()[i].map_or(f64::NAN, f64::abs);
        println!("{i}: {:.4} % with the lag known, {:.4} % without", end(&flight), end(&without));
        assert!(end(&flight) <= 0.01, "parameter {i}");
    }
    assert!(without.errors.last().unwrap().ixx.unwrap().abs() > 0.3, "the lag matters in this flight");
}
