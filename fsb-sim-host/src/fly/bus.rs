//! The bus between sensors, estimator and actuators: what it does to the bits of the numbers that are sent over it.

use fsb_core::vehicle::Wrench;
use fsb_faults::{FaultConfig, Injector};
use serde::{Deserialize, Serialize};

use super::error::Refused;
use crate::hexarotor::ParameterError;

/// Faults of the numbers on their way to the estimator; none by default.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct BusConfig {
    /// Of x, y and z.
    pub position: BusFaults,
    /// Of the quaternion's four numbers.
    pub attitude: BusFaults,
    /// Of force and torque, as the estimator is told them.
    pub wrench: BusFaults,
}

/// Probabilities for each number that is sent.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct BusFaults {
    /// It is NaN or infinite.
    pub nan: f32,
    /// One of its bits is flipped.
    pub bit_flip: f32,
    /// From now on the same number is sent again and again.
    pub freeze: f32,
    /// So many times.
    pub freeze_length: u16,
}

impl BusFaults {
    fn injectors<const N: usize>(&self, name: &str, seed: u64) -> Result<[Injector<1>; N], Refused> {
        let Self { nan, bit_flip, freeze, freeze_length } = *self;
        let config = FaultConfig { nan, bit_flip, freeze, freeze_length, ..FaultConfig::default() };
        let injector = |of: usize| Injector::new(&config, seed.wrapping_mul(64).wrapping_add(of as u64));
        if let Err(error) = injector(0) {
            let value = [("nan", nan), ("bit_flip", bit_flip), ("freeze", freeze)];
            let value = value.iter().find(|(name, _)| *name == error.parameter()).map_or(f32::NAN, |of| of.1);
            let refused = ParameterError::new(error.parameter(), f64::from(value), "must be from 0 to 1");
            return Err(refused.within(&format!("bus.{name}")).into());
        }
        // The others have the same configuration.
        Ok(std::array::from_fn(|of| injector(of).unwrap_or_else(|_| unreachable!("the first was taken"))))
    }
}

/// The bus, each number with its own faults.
#[derive(Clone, Debug)]
pub struct Bus {
    position: [Injector<1>; 3],
    attitude: [Injector<1>; 4],
    force: [Injector<1>; 3],
    torque: [Injector<1>; 3],
}

impl Bus {
    /// Of a flight of `seed`.
    ///
    /// # Errors
    /// Names the parameter.
    pub fn new(config: &BusConfig, seed: u64) -> Result<Self, Refused> {
        let part = |number: u64| seed.wrapping_mul(4).wrapping_add(number);
        Ok(Self {
            position: config.position.injectors("position", part(0))?,
            attitude: config.attitude.injectors("attitude", part(1))?,
            force: config.wrench.injectors("wrench", part(2))?,
            torque: config.wrench.injectors("wrench", part(3))?,
        })
    }

    /// What arrives of a position.
    pub fn position(&mut self, sent: Option<[f32; 3]>) -> Option<[f32; 3]> {
        sent.map(|sent| sent_over(&mut self.position, sent))
    }

    /// What arrives of an attitude.
    pub fn attitude(&mut self, sent: Option<[f32; 4]>) -> Option<[f32; 4]> {
        sent.map(|sent| sent_over(&mut self.attitude, sent))
    }

    /// What arrives of a wrench.
    pub fn wrench(&mut self, sent: &Wrench) -> Wrench {
        Wrench { force: sent_over(&mut self.force, sent.force), torque: sent_over(&mut self.torque, sent.torque) }
    }
}

/// Nothing is dropped here: that is the sensor's.
fn sent_over<const N: usize>(injectors: &mut [Injector<1>; N], sent: [f32; N]) -> [f32; N] {
    let mut arrives = sent;
    for (number, injector) in arrives.iter_mut().zip(injectors) {
        *number = injector.pass(Some(*number)).unwrap_or(*number);
    }
    arrives
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_faults_nothing_happens() {
        let mut bus = Bus::new(&BusConfig::default(), 1).unwrap();
        for n in 0..1000 {
            let x = n as f32 * 0.37;
            assert_eq!(bus.position(Some([x, -x, 1.0])), Some([x, -x, 1.0]));
            assert_eq!(bus.attitude(None), None);
        }
    }

    #[test]
    fn faults_come_as_often_as_they_should() {
        let faults = BusFaults { nan: 0.1, ..BusFaults::default() };
        let mut bus = Bus::new(&BusConfig { wrench: faults, ..BusConfig::default() }, 5).unwrap();
        let bad = (0..10_000).map(|_| bus.wrench(&Wrench::default())).flat_map(|w| [w.force, w.torque].concat());
        let bad = bad.filter(|x| !x.is_finite()).count();
        // 6000 of 60 000, within 4 standard deviations.
        assert!((5706..=6294).contains(&bad), "{bad}");
    }

    #[test]
    fn wrong_shares_are_named() {
        let faults = BusFaults { bit_flip: 1.5, ..BusFaults::default() };
        let refused = Bus::new(&BusConfig { attitude: faults, ..BusConfig::default() }, 1).unwrap_err().to_string();
        assert!(refused.contains("bus.attitude.bit_flip = 1.5"), "{refused}");
    }
}
