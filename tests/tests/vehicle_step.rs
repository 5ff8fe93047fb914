//! Measurements that have come out of step with the control loop, one of whose periods nobody counted: they are taken again in the time of
//! so many as make a jump, not when everything is stale.

use fsb_core::vehicle::{Expected, Measured, VehicleConfig, VehicleEstimator};
use fsb_tests::rigid_body::RigidBody;
use fsb_tests::six_axes::{Course, Flight};

/// Aggressive flight at 400 Hz, positions every 8 and attitudes every 4 periods with 1 mm and 1 mrad of noise; after 6 s these come by so many periods
/// later than they should. The largest errors of velocity (m/s) and rates (rad/s) from 0.6 s after that on, ticks without a state, and positions told to be out of step.
fn flown(later: u32, seed: u64) -> ([f64; 2], u32, u32) {
    let period = 0.0025;
    let truth = RigidBody::default();
    let mut config = VehicleConfig::new(period);
    config.mass = Expected::about(truth.mass);
    config.inertia = truth.inertia.map(Expected::about);
    (config.translation.substeps, config.rotation.substeps) = (8, 4);
    let mut vehicle = VehicleEstimator::<1>::new(&config).unwrap();
    let mut flight = Flight::new(truth, Course::AGGRESSIVE, period, seed);
    (flight.position_noise, flight.attitude_noise) = (1e-3, 1e-3);
    let mut wrench = flight.pilot();
    let (mut off, mut without) = ([0.0_f64; 2], 0);
    for tick in 0..4000_u32 {
        let all = flight.measure();
        let phase = if tick < 2400 { tick } else { tick + 8 - later };
        let measured = Measured {
            position: all.position.filter(|_| phase.is_multiple_of(8)),
            attitude: all.attitude.filter(|_| phase.is_multiple_of(4)),
        };
        vehicle.update(&measured, &wrench);
        let state = vehicle.state();
        if tick > 2640 {
            without += u32::from(state.velocity.is_none() || state.rates.is_none());
            for (off, (state, truth)) in
                off.iter_mut().zip([(state.velocity, flight.body.velocity), (state.rates, flight.body.rates)])
            {
                let errors = state.iter().flatten().zip(truth).map(|(x, truth)| (f64::from(*x) - truth).abs());
                *off = errors.fold(*off, f64::max);
            }
        }
        wrench = flight.pilot();
        flight.step(&wrench);
    }
    (off, without, vehicle.counters().positions_out_of_step)
}

#[test]
fn in_step_again() {
    println!("seeds 0 to 20");
    for later in [0, 1, 2, 4, 5] {
        let flights: Vec<_> = (0..20).map(|seed| flown(later, seed)).collect();
        let worst = [0, 1].map(|i| flights.iter().map(|(off, ..)| off[i]).fold(0.0, f64::max));
        println!("{later} periods later: velocity off by {:.3} m/s, rates by {:.3} rad/s", worst[0], worst[1]);
        assert!(worst[0] < 0.06 && worst[1] < 0.12, "{later}: {worst:?}");
        let told = if later == 0 { 0 } else { 10 };
        assert!(flights.iter().all(|&(_, without, early)| without == 0 && early == told), "{later}: {flights:?}");
    }
}
