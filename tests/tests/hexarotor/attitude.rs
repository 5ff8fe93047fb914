//! Quaternion, R(η) and (1) of the paper.

use fsb_sim_host::hexarotor::vector::{Matrix, cross, product, scaled, transposed_product};
use fsb_sim_host::hexarotor::{HexarotorConfig, Quaternion, StartConfig, body_rates, euler_matrix, euler_rates};
use proptest::prelude::*;

use super::{TICK, built, close};

fn each_row(found: &Matrix, expected: &Matrix, within: f64) {
    found.iter().zip(expected).for_each(|(found, expected)| close(*found, *expected, within));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, rng_seed: proptest::test_runner::RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

    /// The quaternion of η gives R(η) as printed, gives η back, and turns vectors as the matrix does.
    #[test]
    fn the_quaternion_is_the_matrix_of_the_paper(
        roll in -3.1..3.1, pitch in -1.55..1.55, yaw in -3.1..3.1, v in prop::array::uniform3(-5.0..5.0)
    ) {
        let euler = [roll, pitch, yaw];
        let q = Quaternion::from_euler(euler);
        each_row(&q.matrix(), &euler_matrix(euler), 1e-14);
        close(q.euler(), euler, 1e-12);
        close(q.rotate(v), product(&q.matrix(), v), 1e-13);
        close(q.rotate_back(v), transposed_product(&q.matrix(), v), 1e-13);
    }

    /// Rotation vectors come back, up to π, however small; twice the same rotation is twice the vector.
    #[test]
    fn rotation_vectors_come_back(axis in prop::array::uniform3(-1.0..1.0), exponent in -12.0..0.0) {
        let vector = scaled(1.8 * 10.0_f64.powf(exponent), axis);
        let q = Quaternion::from_rotation_vector(vector);
        close(q.rotation_vector(), vector, 1e-15);
        let half = Quaternion::from_rotation_vector(scaled(0.5, vector));
        close(half.then_in_body(&half).rotation_vector(), vector, 1e-14);
    }

    /// (1) and its inverse.
    #[test]
    fn rates_convert_both_ways(
        euler in (-3.1..3.1, -1.4..1.4, -3.1..3.1), rates in prop::array::uniform3(-5.0..5.0)
    ) {
        let euler = [euler.0, euler.1, euler.2];
        close(body_rates(euler, euler_rates(euler, rates)), rates, 1e-12);
    }
}

/// Yaw 90° brings body x to world y, pitch 90° body x down, roll 90° body y up.
#[test]
fn rotations_by_hand() {
    let quarter = std::f64::consts::FRAC_PI_2;
    close(Quaternion::from_euler([0.0, 0.0, quarter]).rotate([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0], 1e-15);
    close(Quaternion::from_euler([0.0, quarter, 0.0]).rotate([1.0, 0.0, 0.0]), [0.0, 0.0, -1.0], 1e-15);
    close(Quaternion::from_euler([quarter, 0.0, 0.0]).rotate([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0], 1e-15);
}

/// In flight, by central differences over two ticks: η' = Ω_B ω (1) and R' = R S(ω) (3).
#[test]
fn a_flight_obeys_1_and_3() {
    let start = StartConfig { attitude: [0.4, -0.3, 0.8], body_rates: [1.0, -2.0, 1.5], ..Default::default() };
    let mut vehicle = built(&HexarotorConfig { start, ..Default::default() });
    let mut seen = vec![*vehicle.state()];
    for n in 0..400 {
        let phase = f64::from(n) * 0.02;
        let torque = [0.05 * phase.sin(), 0.04 * phase.cos(), 0.03 * (2.0 * phase).sin()];
        let allocation = vehicle.allocate([0.0, 0.0, 24.0], torque);
        vehicle.step(&allocation.thrusts, TICK);
        seen.push(*vehicle.state());
    }
    let difference = |a: f64, b: f64| (b - a) / (2.0 * TICK);
    for three in seen.windows(3) {
        let [before, now, after] = [0, 1, 2].map(|i| three[i].attitude);
        let (euler, rates) = (now.euler(), three[1].body_rates);
        let slope = [0, 1, 2].map(|i| difference(before.euler()[i], after.euler()[i]));
        // The torque steps between ticks: half a step's worth of angular acceleration stays in the difference.
        close(slope, euler_rates(euler, rates), 2e-4);
        for (column, unit) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
            let change = [0, 1, 2].map(|row| difference(before.matrix()[row][column], after.matrix()[row][column]));
            close(change, product(&now.matrix(), cross(rates, unit)), 2e-4);
        }
    }
}
