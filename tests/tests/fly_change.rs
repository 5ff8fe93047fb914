//! Payloads picked up and dropped: the change noticed, the old value held until the new one is there, and no false alarm.

use fsb_sim_host::fly::{Keep, record};
use fsb_tests::fly::{fly, scenario, worst};

/// 40 % of the mass dropped at 8 s: within 2 % of the new one 0.7 s later, and there is a value all the time.
#[test]
fn a_drop_is_noticed() {
    for seed in 1..=10 {
        let flight = fly("payload-drop", &[], seed);
        let events: Vec<String> = flight.events.iter().map(|e| format!("{:.2} s {}", e.t, e.what)).collect();
        let after = worst(&flight.errors, 0, 8.7, 16.0);
        println!("  {events:?}\n  mass within {after:.3} % from 8.7 s on");
        assert!(flight.events.iter().any(|e| (8.0..8.7).contains(&e.t) && e.what.contains("change of the mass")));
        assert!(after <= 2.0, "seed {seed}: {after} %");
        assert!(worst(&flight.errors, 0, 1.0, 16.0).is_finite(), "a value all the time");
        let of = flight.tracking;
        println!("  height error {:.3} m, yardstick {:.4} m", of.height_error_max, of.yardstick_height_error_max);
        assert!(of.height_error_max <= 0.5, "seed {seed}: {}", of.height_error_max);
    }
}

#[test]
fn a_pickup_is_noticed() {
    for seed in 1..=10 {
        let flight = fly("payload-pickup", &[], seed);
        let after = worst(&flight.errors, 0, 9.0, 16.0);
        println!("  mass within {after:.3} % from 9 s on");
        assert!(after <= 2.0, "seed {seed}: {after} %");
        assert!(flight.tracking.height_error_max <= 0.6, "seed {seed}: {}", flight.tracking.height_error_max);
    }
}

/// An hour of hover, twenty minutes of the spiral, and the moving flights as built in with the detector on: no alarm.
#[test]
fn no_false_alarm() {
    let detector = "estimator.change={ relative = 0.15, sigmas = 6.0, hold_off = 2.0 }";
    for (name, duration) in [
        ("hover", 3600.0),
        ("spiral", 1200.0),
        ("aggressive", 60.0),
        ("latency", 60.0),
        ("slow-position", 60.0),
        ("wind", 60.0),
    ] {
        let duration = format!("duration={duration}");
        let flight = record(&scenario(name, &[&duration, detector]), 7, Keep::Numbers).unwrap();
        let alarms: Vec<_> = flight.events.iter().filter(|event| event.what.contains("change")).collect();
        println!("{name}, {duration} s, seed 7: {} events", flight.events.len());
        assert!(alarms.is_empty() && flight.diverged.is_none(), "{name}: {alarms:?}");
    }
}
