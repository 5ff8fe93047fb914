//! Wrench to thrusts and back, by a constant 6 x 6 matrix.

use core::fmt;

/// Motors, and components of a wrench.
const N: usize = 6;

/// A wrench from six thrusts: `wrench = forward * thrusts`, and its inverse.
///
/// A wrench is the body-frame force \[N\] on x, y, z, then the torque \[N m\] about x, y, z.
#[derive(Clone, Copy, Debug)]
pub struct Allocation {
    forward: [[f32; N]; N],
    inverse: [[f32; N]; N],
    /// Newtons of lift, the force along z, per newton of each motor where they do nothing but lift; `None` where that needs a motor to
    /// pull down, or not to turn.
    lift: Option<[f32; N]>,
    thrust_max: f32,
}

/// An allocation was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum AllocationError {
    /// The rotors cannot produce every wrench: the matrix is singular, or has an entry that is not finite.
    Singular,
    /// The largest thrust is not positive and finite.
    ThrustMax,
}

impl fmt::Display for AllocationError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Singular => "the rotors cannot produce every force and torque",
            Self::ThrustMax => "the largest thrust is not a positive number",
        })
    }
}

impl core::error::Error for AllocationError {}

impl Allocation {
    /// `forward[i][j]`: component i of the wrench that motor j produces per newton of its thrust. `thrust_max` \[N\] is
    /// what one motor produces at full duty.
    ///
    /// # Errors
    /// [`AllocationError`]. Pivots below 1e-9 count as singular.
    pub fn new(forward: &[[f64; N]; N], thrust_max: f64) -> Result<Self, AllocationError> {
        if !(thrust_max > 0.0 && thrust_max <= 1e6) {
            return Err(AllocationError::ThrustMax);
        }
        let inverse = inverse(forward).ok_or(AllocationError::Singular)?;
        let lift = inverse.map(|[_, _, of_lift, ..]| (1.0 / of_lift) as f32);
        let lift = lift.iter().all(|newtons| *newtons > 0.0 && *newtons < 1e6).then_some(lift);
        Ok(Self { forward: rounded(forward), inverse: rounded(&inverse), lift, thrust_max: thrust_max as f32 })
    }

    /// The thrusts \[N\] that produce `wrench`, of any sign and size. Cost: 66 operations.
    pub fn thrusts(&self, wrench: &[f32; N]) -> [f32; N] {
        product(&self.inverse, wrench)
    }

    /// Which of these thrusts the motors do not have, by bits: below zero, above the largest, or no number.
    pub fn beyond(&self, thrusts: &[f32; N]) -> u8 {
        let out = |thrust: &f32| !(0.0..=self.thrust_max).contains(thrust);
        thrusts.iter().zip(0..).fold(0, |bits, (thrust, motor)| bits | u8::from(out(thrust)) << motor)
    }

    /// Thrusts \[N\] that the motors have, for a `wrench` that needs others: the torque first, as a vehicle that is not held upright
    /// falls; then the lift, as far as it leaves room for the torque; the side force with what is left. Where the rotors do not lift by
    /// pulling up each, every thrust is bounded for itself. What is beyond 1e6 N or N m counts as that, what is no number as nothing. Cost: about 250 operations.
    #[inline(never)]
    pub fn bounded(&self, wrench: &[f32; N]) -> [f32; N] {
        let [x, y, z, p, q, r] = wrench.map(|entry| if entry.is_nan() { 0.0 } else { within(entry, -1e6, 1e6) });
        let Some(lift) = &self.lift else {
            return self.thrusts(&[x, y, z, p, q, r]).map(|thrust| within(thrust, 0.0, self.thrust_max));
        };
        let mut thrusts = self.thrusts(&[0.0, 0.0, 0.0, p, q, r]);
        // In newtons of lift: what the torque takes of a motor, and all that one has.
        let (mut least, mut most, mut all) = (0.0, 0.0, f32::INFINITY);
        for (torque, per) in thrusts.iter().zip(lift) {
            least = smaller(torque * per, least);
            most = -smaller(-torque * per, -most);
            all = smaller(self.thrust_max * per, all);
        }
        let share = smaller(all / (most - least), 1.0);
        let mut highest = f32::INFINITY;
        for (torque, per) in thrusts.iter_mut().zip(lift) {
            *torque *= share;
            highest = smaller((self.thrust_max - *torque) * per, highest);
        }
        let z = within(z, -share * least, highest);
        let aside = self.thrusts(&[x, y, 0.0, 0.0, 0.0, 0.0]);
        let mut share = 1.0;
        for ((thrust, per), aside) in thrusts.iter_mut().zip(lift).zip(&aside) {
            *thrust += z / per;
            let left = if *aside > 0.0 { self.thrust_max - *thrust } else { -*thrust };
            if *aside != 0.0 {
                share = smaller(left / aside, share);
            }
        }
        let share = within(share, 0.0, 1.0);
        for (thrust, aside) in thrusts.iter_mut().zip(&aside) {
            *thrust = within(*thrust + share * aside, 0.0, self.thrust_max);
        }
        thrusts
    }

    /// The wrench that `thrusts` \[N\] produce. Cost: 66 operations.
    pub fn wrench(&self, thrusts: &[f32; N]) -> [f32; N] {
        product(&self.forward, thrusts)
    }

    /// What one motor produces at full duty \[N\].
    pub const fn thrust_max(&self) -> f32 {
        self.thrust_max
    }
}

/// `b` where `a` is no number.
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// `least` where `x` is no number, and where the bounds are crossed.
fn within(x: f32, least: f32, most: f32) -> f32 {
    if x > least { smaller(x, most) } else { least }
}

fn product(matrix: &[[f32; N]; N], vector: &[f32; N]) -> [f32; N] {
    matrix.map(|row| row.iter().zip(vector).fold(0.0, |sum, (a, b)| sum + a * b))
}

fn rounded(matrix: &[[f64; N]; N]) -> [[f32; N]; N] {
    matrix.map(|row| row.map(|entry| entry as f32))
}

/// Gauss-Jordan with the largest pivot of the column.
fn inverse(matrix: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut left = *matrix;
    let mut right: [[f64; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    for column in 0..N {
        let size = |row: &usize| left.get(*row).and_then(|row| row.get(column)).map_or(0.0, |entry| entry.abs());
        let pivot_row = (column..N).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        exchange(&mut left, column, pivot_row);
        exchange(&mut right, column, pivot_row);
        let (lefts, rights) = (*left.get(column)?, *right.get(column)?);
        let pivot = *lefts.get(column)?;
        // Written so that NaN fails it.
        if !(pivot.abs() >= 1e-9 && pivot.is_finite()) {
            return None;
        }
        for (row, (l, r)) in left.iter_mut().zip(right.iter_mut()).enumerate() {
            let factor = if row == column { (pivot - 1.0) / pivot } else { l.get(column)? / pivot };
            for (entry, of_pivot) in l.iter_mut().zip(&lefts).chain(r.iter_mut().zip(&rights)) {
                *entry -= factor * of_pivot;
            }
        }
    }
    Some(right)
}

/// `swap`, which could panic.
fn exchange(rows: &mut [[f64; N]; N], a: usize, b: usize) {
    let (Some(&of_a), Some(&of_b)) = (rows.get(a), rows.get(b)) else { return };
    for (index, row) in [(a, of_b), (b, of_a)] {
        if let Some(slot) = rows.get_mut(index) {
            *slot = row;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thrusts_give_the_wrench_back() {
        let mut forward = [[0.0; N]; N];
        for (i, row) in forward.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = if i == j { 0.0 } else { 1.0 + i as f64 - 2.0 * j as f64 * i as f64 };
            }
            row[(i + 2) % N] += 3.0;
        }
        let allocation = Allocation::new(&forward, 5.0).unwrap();
        let wrench = [0.5, -1.0, 14.0, 0.1, -0.2, 0.05];
        for (got, wanted) in allocation.wrench(&allocation.thrusts(&wrench)).iter().zip(wrench) {
            assert!((got - wanted).abs() < 2e-5, "{got} {wanted}");
        }
    }

    /// Coplanar, parallel rotors produce no sideways force.
    /// Wrenches of any size, against what the motors have: the torque is as wanted wherever there are thrusts that make it, the lift
    /// wherever there are beside it, and the side force never of another direction.
    #[test]
    fn torque_first_then_lift() {
        let body = crate::TiltedHexarotor { arm: 0.25, tilt: 0.35, drag_ratio: 0.02 };
        let allocation = Allocation::new(&body.matrix(), 6.0).unwrap();
        let mut seed = 7_u32;
        let mut uniform = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1_u32 << 23) as f32 - 1.0
        };
        let close = |a: f32, b: f32| (a - b).abs() < 2e-4;
        let (mut whole, mut lifted, mut scaled) = (0, 0, 0);
        for _ in 0..20_000 {
            let size = uniform().abs() * 3.0;
            let wrench = [8.0, 8.0, 60.0, 1.5, 1.5, 1.5].map(|most| most * size * uniform());
            let thrusts = allocation.bounded(&wrench);
            assert!(thrusts.iter().all(|thrust| (0.0..=6.0).contains(thrust)), "{thrusts:?}");
            let made = allocation.wrench(&thrusts);
            // Equal thrusts lift and do nothing else: there is room where the torque's own are no further apart than a motor's.
            let own = allocation.thrusts(&[0.0, 0.0, 0.0, wrench[3], wrench[4], wrench[5]]);
            let (low, high) = own.iter().fold((0.0_f32, 0.0_f32), |(l, h), t| (l.min(*t), h.max(*t)));
            let room = high - low <= 6.0;
            let share = if room { 1.0 } else { 6.0 / (high - low) };
            assert!((3..6).all(|i| close(made[i], share * wrench[i])), "{wrench:?} {made:?} {share}");
            let per = 6.0 * libm::cosf(0.35);
            let lift = wrench[2].max(-share * low * per).min((6.0 - share * high) * per);
            assert!(close(made[2], lift), "{wrench:?} {made:?} {lift}");
            assert!(close(made[0] * wrench[1], made[1] * wrench[0]), "{wrench:?} {made:?}");
            assert!(made[0] * wrench[0] > -1e-3 && made[0].abs() <= wrench[0].abs() + 1e-4, "{wrench:?} {made:?}");
            let wanted = allocation.thrusts(&wrench);
            if allocation.beyond(&wanted) == 0 && close(lift, wrench[2]) {
                whole += 1;
                assert!(wanted.iter().zip(&thrusts).all(|(a, b)| close(*a, *b)), "{wanted:?} {thrusts:?}");
            }
            lifted += u32::from(close(lift, wrench[2]));
            scaled += u32::from(!room);
        }
        assert!(whole > 300 && lifted > 1000 && scaled > 1000, "{whole} {lifted} {scaled}");
    }

    #[test]
    fn what_is_no_wrench_is_bounded_as_well() {
        let body = crate::TiltedHexarotor { arm: 0.25, tilt: 0.35, drag_ratio: 0.02 };
        let allocation = Allocation::new(&body.matrix(), 6.0).unwrap();
        for entry in 0..6 {
            for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, -3e38] {
                let mut wrench = [0.0, 0.0, 14.7, 0.0, 0.0, 0.0];
                wrench[entry] = value;
                let thrusts = allocation.bounded(&wrench);
                assert!(thrusts.iter().all(|thrust| (0.0..=6.0).contains(thrust)), "{wrench:?} {thrusts:?}");
                let made = allocation.wrench(&thrusts);
                assert!(!value.is_nan() || made[entry].abs() < 1e-4, "{wrench:?} {made:?}");
            }
        }
    }

    /// Also where a motor has no share in it: a side force is scaled, and not left out.
    #[test]
    fn a_side_force_is_what_is_left() {
        // A force along x or y is one motor more and one less, and all of them lift.
        let mut forward = [[0.0; N]; N];
        for (motor, row) in forward.iter_mut().enumerate() {
            row[motor] = 1.0;
        }
        forward[2] = [1.0; N];
        (forward[0][5], forward[1][5], forward[3][5], forward[4][5], forward[5]) =
            (-1.0, -1.0, -1.0, -1.0, [1.0, 1.0, 1.0, -1.5, -1.5, 0.0]);
        let allocation = Allocation::new(&forward, 6.0).unwrap();
        let zeros = |thrusts: [f32; N]| thrusts.iter().filter(|thrust| **thrust == 0.0).count();
        assert!(allocation.lift.is_some() && zeros(allocation.thrusts(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0])) > 0);
        let lifted = [0.0, 0.0, 12.0, 0.0, 0.0, 0.0];
        for (axis, side) in [(0, 50.0), (0, -50.0), (1, 50.0), (1, -50.0)] {
            let mut wrench = lifted;
            wrench[axis] = side;
            let made = allocation.wrench(&allocation.bounded(&wrench));
            assert!(made[axis] * side.signum() > 1.0 && (made[2] - 12.0).abs() < 1e-4, "{wrench:?} {made:?}");
        }
    }

    #[test]
    fn what_cannot_be_inverted_is_refused() {
        let mut forward = [[0.0; N]; N];
        assert_eq!(Allocation::new(&forward, 5.0).unwrap_err(), AllocationError::Singular);
        forward[2] = [1.0; N];
        assert_eq!(Allocation::new(&forward, 5.0).unwrap_err(), AllocationError::Singular);
        for (i, row) in forward.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        assert_eq!(Allocation::new(&forward, f64::NAN).unwrap_err(), AllocationError::ThrustMax);
        assert_eq!(Allocation::new(&forward, 0.0).unwrap_err(), AllocationError::ThrustMax);
        assert!(Allocation::new(&forward, 5.0).is_ok());
        forward[3][4] = f64::INFINITY;
        assert_eq!(Allocation::new(&forward, 5.0).unwrap_err(), AllocationError::Singular);
    }
}
