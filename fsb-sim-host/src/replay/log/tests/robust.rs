//! Whatever is in the file, an answer comes back.

use super::*;
use proptest::prelude::*;

/// Pieces a log is made of, in any order.
fn pieces() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(vec![
        "t", "x", "fx", "z", "fz", "yaw", "tauz", "vx_ref", ",", ",", ",", "\n", "\n", "\r\n", "\r", "\"", " ", "0",
        "1", "2", "0.5", "-3", "1e9", "1e-320", "nan", "inf", "é", "\u{feff}",
    ]);
    prop::collection::vec(piece, 0..120).prop_map(|pieces| pieces.concat())
}

/// Finite values of every size that f32 holds.
fn value() -> impl Strategy<Value = f64> {
    any::<f32>().prop_filter("finite", |value| value.is_finite()).prop_map(f64::from)
}

proptest! {
    #![proptest_config(seeded(43))]

    #[test]
    fn arbitrary_bytes(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        let _ = AxisLog::from_reader("a.csv", &bytes[..]);
    }

    #[test]
    fn arbitrary_bytes_below_a_header(bytes in prop::collection::vec(any::<u8>(), 0..500)) {
        let _ = AxisLog::from_reader("a.csv", &[b"t,x,fx\n0,0,0\n1,0,0\n2,0,0\n3,0,0\n", &bytes[..]].concat()[..]);
    }

    #[test]
    fn pieces_of_a_log(text in pieces(), header in any::<bool>()) {
        let text = if header { format!("t,x,fx,vx_ref\n{text}") } else { text };
        match read(&text) {
            Ok(log) => prop_assert!(log.len() >= FEWEST_SAMPLES && log.period > 0.0 && !log.axes.is_empty()),
            Err(error) => prop_assert!(error.to_string().starts_with("a.csv:"), "{}", error),
        }
    }

    #[test]
    fn what_is_written_is_read(
        rows in prop::collection::vec((prop::option::of(value()), value(), prop::option::of(value())), 4..60),
        period in 1e-4..1.0_f64,
    ) {
        let cell = |value: Option<f64>| value.map(|value| format!("{value:e}")).unwrap_or_default();
        let mut text = String::from("vroll_ref,t,taux,roll\n");
        for (n, (position, input, reference)) in rows.iter().enumerate() {
            text += &format!("{},{},{input:e},{}\n", cell(*reference), n as f64 * period, cell(*position));
        }
        let log = read(&text).unwrap();
        let [roll] = &log.axes[..] else { panic!("{} axes", log.axes.len()) };
        prop_assert_eq!(roll.axis, Axis::Roll);
        prop_assert!((log.period / period - 1.0).abs() < 1e-11);
        prop_assert!(rows.iter().map(|row| row.0).eq(roll.position.iter().copied()));
        prop_assert!(rows.iter().map(|row| row.1).eq(roll.input.iter().copied()));
        prop_assert!(rows.iter().map(|row| row.2).eq(roll.velocity_reference.as_ref().unwrap().iter().copied()));
    }
}
