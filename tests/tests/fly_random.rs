//! Many random flights: none diverges, and their errors.

use fsb_sim_host::fly::fly_many;
use fsb_tests::fly::scenario;

/// 200 of `fsb fly --scenario random --runs 10000`.
#[test]
fn none_diverges() {
    let flights = fly_many(&scenario("random", &[]), 1, 200, || ()).unwrap();
    println!("seeds 1 to 200: {:.0} × real time a core", flights.real_time_factor);
    assert_eq!((flights.runs.len(), flights.diverged()), (200, 0));
    // Median and largest error at the end [%].
    for (i, median, largest) in [(0, 0.01, 0.1), (1, 0.3, 5.0), (2, 0.3, 5.0), (3, 0.3, 5.0)] {
        let spread = flights.errors(i).unwrap();
        println!("{i}: {spread:?}");
        assert_eq!(spread.flights, 200, "parameter {i} is valid at the end of every flight");
        assert!(spread.median.abs() <= median && spread.max.max(-spread.min) <= largest, "{i}: {spread:?}");
    }
}

/// The draws cover what the scenario says, and belong to the seed.
#[test]
fn draws_cover_their_ranges() {
    let scenario = scenario("random", &[]);
    let (mut low, mut high) = ([f64::INFINITY; 4], [0.0_f64; 4]);
    for seed in 0..500 {
        let drawn = scenario.drawn(seed);
        assert_eq!(drawn, scenario.drawn(seed));
        let guess = scenario.estimator.inertia.nominal.unwrap();
        let mass = drawn.plant.mass / scenario.estimator.mass.nominal.unwrap();
        for (i, ratio) in [mass].into_iter().chain((0..3).map(|i| drawn.plant.inertia[i] / guess[i])).enumerate() {
            (low[i], high[i]) = (low[i].min(ratio), high[i].max(ratio));
        }
        assert!(drawn.plant.start.attitude.iter().all(|angle| angle.abs() <= 0.5));
        assert!(drawn.sensors.attitude.latency <= drawn.sensors.position.latency);
        assert_eq!(drawn.check(), Ok(()));
    }
    println!("ratios from {low:?} to {high:?}");
    assert!(low.iter().all(|&ratio| (0.5..0.6).contains(&ratio)));
    assert!(high.iter().all(|&ratio| ratio > 1.7 && ratio <= 2.0 + 1e-9));
}

/// A flight alone is the one of the series with its seed.
#[test]
fn a_flight_of_a_series_can_be_repeated() {
    let scenario = scenario("random", &["duration=3"]);
    let series = fly_many(&scenario, 40, 3, || ()).unwrap();
    let alone = fly_many(&scenario, 42, 1, || ()).unwrap();
    assert_eq!(series.runs[2].parameters, alone.first.parameters);
}
