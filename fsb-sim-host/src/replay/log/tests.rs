//! What is read, what is refused, and with which words.

mod refused;
mod robust;
mod time;

use std::io::Write;

use proptest::test_runner::{Config, RngSeed};

use super::*;

/// The same cases on every run.
fn seeded(seed: u64) -> Config {
    Config { rng_seed: RngSeed::Fixed(seed), failure_persistence: None, ..Config::default() }
}

/// Reads `text` under the name `a.csv`.
fn read(text: &str) -> Result<AxisLog, LogError> {
    AxisLog::from_reader("a.csv", text.as_bytes())
}

/// A log of one axis x with these times as written.
fn with_times<T: std::fmt::Display>(times: impl IntoIterator<Item = T>) -> String {
    let rows: Vec<String> = times.into_iter().map(|time| format!("{time},0,0\n")).collect();
    format!("t,x,fx\n{}", rows.concat())
}

#[test]
fn columns_are_read_by_name() {
    let log = read(
        "fz,comment,t,vz_ref,z,yaw,tauz\n\
         9.8,take-off,10.00,0.5,1,0.1,1e-3\n\
         9.9,,10.01,,,0.2,-2e-3\n\
         10,nan,10.02,0.7,1.5,.3,0\n\
         +10.1,\"a, b\",10.03,0.8,2.,-0.4,0\n",
    )
    .unwrap();
    assert_eq!(log.len(), 4);
    assert_eq!(log.period, 0.01);
    assert_eq!(log.start, 10.0);
    assert!((log.time(3) - 10.03).abs() < 1e-12);
    assert!(log.unpaired.is_empty());
    let [z, yaw] = &log.axes[..] else { panic!("{} axes", log.axes.len()) };
    assert_eq!(z.axis, Axis::Z);
    assert_eq!(z.position, [Some(1.0), None, Some(1.5), Some(2.0)]);
    assert_eq!(z.input, [9.8, 9.9, 10.0, 10.1]);
    assert_eq!(z.velocity_reference, Some(vec![Some(0.5), None, Some(0.7), Some(0.8)]));
    assert_eq!(yaw.axis, Axis::Yaw);
    assert_eq!(yaw.position, [Some(0.1), Some(0.2), Some(0.3), Some(-0.4)]);
    assert_eq!(yaw.input, [0.001, -0.002, 0.0, 0.0]);
    assert_eq!(yaw.velocity_reference, None);
}

#[test]
fn all_six_axes() {
    let names = "t,x,y,z,roll,pitch,yaw,fx,fy,fz,taux,tauy,tauz,vx_ref,vy_ref,vz_ref,vroll_ref,vpitch_ref,vyaw_ref";
    let rows: String = (0..4)
        .map(|row| {
            let values: Vec<String> = (1..=18).map(|column| format!("{}", 100 * column + row)).collect();
            format!("{row},{}\n", values.join(","))
        })
        .collect();
    let log = read(&format!("{names}\n{rows}")).unwrap();
    assert_eq!(log.axes.iter().map(|column| column.axis).collect::<Vec<_>>(), Axis::ALL);
    for (index, column) in log.axes.iter().enumerate() {
        let first = 100.0 * (index as f64 + 1.0);
        assert_eq!(column.position[0], Some(first));
        assert_eq!(column.input[3], first + 603.0);
        assert_eq!(column.velocity_reference.as_ref().unwrap()[2], Some(first + 1202.0));
        assert_eq!(column.axis.is_translation(), index < 3);
    }
}

#[test]
fn how_the_text_is_laid_out_does_not_matter() {
    let plain = "t,x,fx\n0,1,2\n0.1,,3\n0.2,4,5\n0.3,6,7\n";
    let expected = read(plain).unwrap();
    for same in [
        plain.trim_end().to_string(),
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\n\n"),
        format!("\u{feff}{plain}"),
        format!("\u{feff}{}", plain.replace('\n', "\r\n")),
        plain.replace(',', " ,\t ").replace('\n', "  \n"),
        plain.replace("x,fx", "\"x\",\"fx\""),
        plain.replace(',', ";"),
        plain.replace(',', "\t"),
        format!("\u{feff}{}", plain.replace(',', " ; ").replace('\n', "\r\n")),
        plain.replace(",,", ",nan,"),
        plain.replace(",,", ", -NaN ,"),
    ] {
        assert_eq!(read(&same).unwrap(), expected, "{same:?}");
    }
}

#[test]
fn a_half_axis_beside_a_whole_one_is_told() {
    let log = read("t,x,fx,y,tauz\n0,1,2,a,b\n1,1,2,a,b\n2,1,2,a,b\n3,1,2,a,b\n").unwrap();
    assert_eq!(log.axes.len(), 1);
    assert_eq!(log.unpaired, ["y", "tauz"]);
}

#[test]
fn utf_16_is_named() {
    let bytes: Vec<u8> = format!("\u{feff}{}", with_times(0..5)).encode_utf16().flat_map(u16::to_le_bytes).collect();
    let message = AxisLog::from_reader("a.csv", &bytes[..]).unwrap_err().to_string();
    assert_eq!(message, "a.csv: cannot be read: it is in UTF-16, expected UTF-8");
}

#[test]
fn a_file_is_read() {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(with_times(0..5).as_bytes()).unwrap();
    assert_eq!(AxisLog::read(file.path()).unwrap().len(), 5);
}
