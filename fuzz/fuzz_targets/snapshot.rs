//! Any bytes as a snapshot, also with a checksum that is right: refused, or harmless.
#![no_main]

use fsb_core::{Estimator, EstimatorConfig};
use fuzz::{Bytes, judge};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut estimator = Estimator::<1, 1>::new(&EstimatorConfig::new(0.01)).expect("the default");
    assert!(estimator.restore(data).is_err() || data.len() == estimator.snapshot_length());
    let mut own = vec![0; estimator.snapshot_length()];
    estimator.snapshot(&mut own).expect("long enough");
    let state = 16..own.len() - 4;
    // Words to be put somewhere into a snapshot of its own.
    let mut bytes = Bytes(data);
    while let (Some(at), Some(word)) = (bytes.byte(), bytes.word()) {
        let at = state.start + 4 * (usize::from(at) % (state.len() / 4));
        own[at..at + 4].copy_from_slice(&word.to_le_bytes());
        if bytes.0.len() < 8 {
            break;
        }
    }
    let end = own.len() - 4;
    let checksum = crc32(&own[..end]);
    own[end..].copy_from_slice(&checksum.to_le_bytes());
    if estimator.restore(&own).is_ok() {
        for n in 0..60 {
            let y = bytes.number().unwrap_or(n as f32 * 0.01);
            let _ = estimator.measure(&[Some(y)]);
            estimator.apply(&[if n % 9 < 4 { 1.0 } else { -1.0 }]);
            judge(&estimator);
        }
    }
});

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}
