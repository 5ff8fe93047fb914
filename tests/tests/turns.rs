//! Axes take turns: with block means no tick carries two axes' identifiers, nor do two estimators on one processor.

use fsb_core::estimator::AxisDiagnostics;
use fsb_core::{Estimator, EstimatorConfig};
use fsb_sim_host::plant::{Motion, Recording, RecordingConfig, record};

const PERIOD: f64 = 1e-3;
const BLOCK: u32 = 10;

fn flights() -> [Recording; 3] {
    [(1.0, 0.7), (-2.0, 1.1), (3.0, 1.7)].map(|(centre, frequency)| {
        let motion = Motion { centre, amplitude: 1.0, frequency };
        record(&RecordingConfig {
            period: PERIOD,
            samples: 4000,
            drift: 0.0,
            position: centre,
            motion,
            ..Default::default()
        })
    })
}

fn estimator<const P: usize>(turn: u32) -> Estimator<3, P> {
    Estimator::new(&EstimatorConfig { block: BLOCK, turn, noise_sd: Some(1e-7), ..EstimatorConfig::new(PERIOD) })
        .unwrap()
}

fn sample(flights: &[Recording; 3], n: usize) -> [Option<f32>; 3] {
    flights.each_ref().map(|f| Some(f.positions[n] as f32))
}

fn input(flights: &[Recording; 3], n: usize) -> [f32; 3] {
    flights.each_ref().map(|f| f.forces[n] as f32)
}

/// What an axis's identifier alone determines.
fn identifier_bits(d: &AxisDiagnostics) -> [u32; 2] {
    [d.z2.to_bits(), d.z0.to_bits()]
}

#[test]
fn in_every_tick_at_most_one_axis_advances() {
    let flights = flights();
    let mut estimators = [estimator::<1>(0), estimator::<1>(3)];
    let mut before = estimators.map(|e| e.diagnostics());
    let mut advances = [[0_u32; 3]; 2];
    for n in 0..3000 {
        let mut now = 0;
        for (e, estimator) in estimators.iter_mut().enumerate() {
            estimator.measure(&sample(&flights, n)).unwrap();
            let after = estimator.diagnostics();
            for axis in 0..3 {
                if identifier_bits(&after[axis]) != identifier_bits(&before[e][axis]) {
                    now += 1;
                    advances[e][axis] += 1;
                }
            }
            before[e] = after;
            estimator.apply(&input(&flights, n));
            // The work is in `measure`, not here.
            assert_eq!(estimator.diagnostics(), after);
        }
        assert!(now <= 1, "tick {n}: {now} axes");
    }
    // One in ten ticks each; nothing moves while the window is shut, in the first two blocks.
    assert!(advances.iter().flatten().all(|&count| (296..=300).contains(&count)), "{advances:?}");
}

/// A later turn is a later start and nothing else: the identifier that starts at measurement 3 says what one that is first
/// measured then says, to the last bit. (The variance of k̂ is another matter: it has part of its noise level from the observer.)
#[test]
fn a_turn_is_a_shift() {
    let flights = flights();
    for turn in [1, 3, 9] {
        let (mut turned, mut plain) = (estimator::<3>(turn), estimator::<3>(0));
        let mut valid = 0;
        for n in 0..4000 {
            turned.measure(&sample(&flights, n)).unwrap();
            if n >= turn as usize {
                plain.measure(&sample(&flights, n)).unwrap();
            }
            for (a, b) in turned.diagnostics().iter().zip(plain.diagnostics()) {
                let signals = |d: &AxisDiagnostics| [d.z2, d.z0, d.zu, d.numerator, d.denominator].map(f32::to_bits);
                assert_eq!(signals(a), signals(&b), "turn {turn}, measurement {n}");
            }
            for (a, b) in turned.parameters().iter().zip(plain.parameters()) {
                if let (Some(a), Some(b)) = (a, b) {
                    assert_eq!(a.value, b.value, "turn {turn}, measurement {n}");
                    valid += 1;
                }
            }
            turned.apply(&input(&flights, n));
            plain.apply(&input(&flights, n));
        }
        assert!(valid > 3 * 3000, "the comparison was about something");
    }
}

/// k̂ and the states of the two agree with the truth whatever the turn.
#[test]
fn every_turn_finds_the_truth() {
    let flights = flights();
    let k = RecordingConfig::default().k;
    for turn in 0..BLOCK {
        let mut estimator = estimator::<3>(turn);
        for n in 0..4000 {
            estimator.measure(&sample(&flights, n)).unwrap();
            if n + 1 < 4000 {
                estimator.apply(&input(&flights, n));
            }
        }
        for (axis, (parameter, state)) in estimator.parameters().iter().zip(estimator.states()).enumerate() {
            let (found, state) = (parameter.unwrap(), state.unwrap());
            assert!((f64::from(found.value) / k - 1.0).abs() < 1e-6, "turn {turn}, axis {axis}: {found:?}");
            assert!((f64::from(state.velocity) - flights[axis].velocities[3999]).abs() < 2e-6);
            assert!((f64::from(state.position) - flights[axis].positions[3999]).abs() < 5e-7);
        }
    }
}

/// The ways that are quicker than the general one lead to the same bits: an estimator that is restored before every measurement
/// goes the general way each time.
#[test]
fn the_quick_ways_lead_where_the_general_one_does() {
    let flights = flights();
    for (block, turn) in [(1, 0), (1, 4), (3, 0), (BLOCK, 0), (BLOCK, 4), (20, 4)] {
        let config = EstimatorConfig {
            block,
            turn,
            noise_sd: Some(1e-7),
            drift: [0.0, 0.0, 1e-3],
            ..EstimatorConfig::new(PERIOD)
        };
        let mut quick = Estimator::<3, 3>::new(&config).unwrap();
        let mut general = quick;
        let mut bytes = vec![0; quick.snapshot_length()];
        for n in 0..2000 {
            general.snapshot(&mut bytes).unwrap();
            general.restore(&bytes).unwrap();
            for estimator in [&mut quick, &mut general] {
                let mut now = sample(&flights, n);
                if n == 1500 {
                    now[1] = None;
                }
                estimator.measure(&now).unwrap();
                estimator.apply(&input(&flights, n));
            }
            quick.snapshot(&mut bytes).unwrap();
            let after = bytes.clone();
            general.snapshot(&mut bytes).unwrap();
            assert!(after == bytes, "block {block}, turn {turn}, measurement {n}");
        }
        assert!(quick.parameters().iter().all(Option::is_some), "the comparison was about something");
    }
}
