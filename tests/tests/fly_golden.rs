//! One flight kept as a file: whatever changes it shows in review as a change of that file.
//!
//! It proves nothing about being right, other tests do. `FSB_WRITE_GOLDEN=1 cargo test -p fsb-tests --test fly_golden`
//! writes it anew.

use fsb_sim_host::fly::record::Sample;
use fsb_tests::fly::fly;
use std::fmt::Write as _;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/fly-spiral.csv");
/// Two numbers are the same within this share of the largest of their column: other mathematics libraries differ in the last
/// digit, and a stable loop does not make more of it.
const SAME: f64 = 1e-6;

const HEADER: &str = "t,x,y,z,qw,qx,qy,qz,vx_hat,vy_hat,vz_hat,wx_hat,wy_hat,wz_hat,mass_hat,mass_sd,ixx_hat,ixx_sd,iyy_hat,\
                      iyy_sd,izz_hat,izz_sd,thrust1,thrust2,thrust3,thrust4,thrust5,thrust6";

fn row(sample: &Sample) -> Vec<Option<f64>> {
    let (moment, belief) = (&sample.moment, &sample.belief);
    let all = |values: &[f64]| values.iter().copied().map(Some).collect::<Vec<_>>();
    let maybe = |values: Option<[f32; 3]>| [0, 1, 2].map(|i| values.map(|v| f64::from(v[i]))).to_vec();
    let parameters =
        belief.parameters.iter().flat_map(|p| [p.map(|p| f64::from(p.value)), p.map(|p| f64::from(p.sd()))]);
    [
        all(&[moment.t]),
        all(&moment.truth.position),
        all(&moment.truth.attitude.0),
        maybe(belief.velocity),
        maybe(belief.rates),
        parameters.collect(),
        all(&moment.thrusts),
    ]
    .concat()
}

#[test]
fn the_spiral_is_as_it_was() {
    let flight = fly("spiral", &["duration=10"], 1);
    let every = flight.samples.len() / 40;
    let rows: Vec<Vec<Option<f64>>> = flight.samples.iter().step_by(every).map(row).collect();
    if std::env::var_os("FSB_WRITE_GOLDEN").is_some() {
        let mut text = format!("{HEADER}\n");
        for row in &rows {
            let cells: Vec<String> = row.iter().map(|v| v.map_or(String::new(), |v| format!("{v:.6e}"))).collect();
            let _ = writeln!(text, "{}", cells.join(","));
        }
        std::fs::write(FILE, text).unwrap();
    }
    let text = std::fs::read_to_string(FILE).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(HEADER));
    let kept: Vec<Vec<Option<f64>>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().ok()).collect()).collect();
    assert_eq!(kept.len(), rows.len());
    for column in 0..HEADER.split(',').count() {
        let largest = kept.iter().filter_map(|row| row[column]).fold(0.0_f64, |a, b| a.max(b.abs()));
        for (row, kept) in rows.iter().zip(&kept) {
            let (is, was) = (row[column], kept[column]);
            let same = match (is, was) {
                (Some(is), Some(was)) => (is - was).abs() <= SAME * largest,
                (None, None) => true,
                _ => false,
            };
            let name = HEADER.split(',').nth(column).unwrap();
            assert!(same, "{name} at {:?} s was {was:?}, is {is:?}; see the head of this file", row[0]);
        }
    }
}
