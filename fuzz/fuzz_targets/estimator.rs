//! Any calls with any bits, bare and behind the gate.
#![no_main]

use fsb_core::Estimator;
use fsb_core::estimator::Learning;
use fsb_core::guard::{GuardConfig, Guarded};
use fsb_core::moments::InputMoments;
use fuzz::{Bytes, judge};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let _ = match bytes.byte() {
        Some(kind) if kind & 1 == 0 => run::<2, 1>(&mut bytes),
        Some(_) => run::<2, 2>(&mut bytes),
        None => None,
    };
});

fn run<const N: usize, const P: usize>(bytes: &mut Bytes<'_>) -> Option<()> {
    let config = bytes.config::<N, P>()?;
    let mut bare = Estimator::new(&config).ok()?;
    let guard = GuardConfig { frozen_after: u32::from(bytes.byte()? & 7), bridge: 0.5, ..GuardConfig::default() };
    let mut guarded = Guarded::new(&config, &guard).ok()?;
    loop {
        match bytes.byte()? {
            0..100 => {
                let given = bytes.numbers::<N>()?;
                let _ = bare.measure_raw(&given);
                let _ = guarded.measure(&given.map(|y| (y != 0.25).then_some(y)));
            }
            100..200 => {
                let input = bytes.numbers::<N>()?;
                bare.apply(&input);
                guarded.apply(&input);
            }
            200..215 => {
                let (from, to) = (bytes.numbers::<N>()?, bytes.numbers::<N>()?);
                bare.apply_ramp(&from, &to);
                guarded.apply_ramp(&from, &to);
            }
            215..230 => {
                let (j1, j2) = (bytes.numbers::<N>()?, bytes.numbers::<N>()?);
                let mut moments = [InputMoments::ZERO; N];
                for (each, (j1, j2)) in moments.iter_mut().zip(j1.into_iter().zip(j2)) {
                    *each = InputMoments { j1, j2 };
                }
                bare.apply_moments(&moments);
                guarded.apply_moments(&moments);
            }
            230..236 => guarded.missed(u32::from(bytes.byte()?)),
            236..240 => {
                bare.reinitialise_identifier();
                guarded.reinitialise_identifier();
            }
            240..243 => {
                bare.reset_identifier();
                guarded.reset_identifier();
            }
            243..246 => {
                bare.restart();
                guarded.restart();
            }
            246..248 => bare.translate(&bytes.numbers()?),
            248..254 => {
                let learning = [Learning::On, Learning::Off, Learning::Contact][usize::from(bytes.byte()? % 3)];
                bare.set_learning(learning);
                guarded.set_learning(learning);
            }
            _ => {
                bare.reset();
                guarded.reset();
            }
        }
        judge(&bare);
        judge(&guarded);
        for state in guarded.states().into_iter().flatten() {
            assert!(state.position.is_finite() && state.velocity.is_finite());
        }
    }
}
