//! `fsb replay LOG.ulg` as a process, on a flight simulated in PX4's own frames: north, east, down; forward, right, down.

#[path = "cli_replay_ulog/writer.rs"]
mod writer;

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use writer::Field::{Byte, Float};
use writer::Writer;

const GRAVITY: f64 = 9.81;
/// Share of the full thrust that hovers.
const HOVER: f64 = 0.42;
/// Leaves the ground, and touches it again (s). The land detector says so earlier and later.
const LIFT_OFF: f64 = 3.0;
const TOUCH_DOWN: f64 = 15.0;
const END: f64 = 18.0;
const STEP: f64 = 1e-4;

const FORMATS: [(&str, &str); 6] = [
    (
        "vehicle_local_position",
        "uint64_t timestamp;float x;float y;float z;float vx;float vy;float vz;float[2] delta_xy;float delta_z;bool \
         xy_valid;bool z_valid;uint8_t xy_reset_counter;uint8_t z_reset_counter",
    ),
    ("vehicle_attitude", "uint64_t timestamp;float[4] q"),
    ("vehicle_thrust_setpoint", "uint64_t timestamp;float[3] xyz"),
    ("vehicle_land_detected", "uint64_t timestamp;bool landed"),
    ("actuator_armed", "uint64_t timestamp;bool armed"),
    ("hover_thrust_estimate", "uint64_t timestamp;float hover_thrust;float hover_thrust_var;bool valid"),
];

/// What differs from log to log.
struct Log {
    /// North leaps by so much at 8 s, with PX4's counter and amount.
    reset: f64,
    flies: bool,
    thrust: bool,
    largest: f64,
}

impl Default for Log {
    fn default() -> Self {
        Self { reset: 0.0, flies: true, thrust: true, largest: 1.0 }
    }
}

/// Roll, pitch and yaw as a quaternion from body to world.
fn attitude(t: f64) -> [f64; 4] {
    let half = [0.15 * (1.1 * t).sin(), 0.12 * (0.8 * t).cos(), 0.7 + 0.2 * (0.4 * t).sin()].map(|angle| angle / 2.0);
    let [(sr, cr), (sp, cp), (sy, cy)] = half.map(f64::sin_cos);
    [cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy]
}

impl Log {
    /// Up and down again in twelve seconds; on the ground it builds up and lets go.
    fn set_point(&self, t: f64) -> f64 {
        let share = if !self.flies || t < 1.0 {
            0.0
        } else if t < LIFT_OFF {
            0.2 * (t - 1.0)
        } else if t < TOUCH_DOWN {
            let tau = t - LIFT_OFF;
            let climb = std::f64::consts::TAU / (TOUCH_DOWN - LIFT_OFF);
            (HOVER * (1.0 + 0.08 * (climb * tau).cos() + 0.05 * (2.9 * tau).sin())).min(self.largest)
        } else {
            0.1
        };
        f64::from(share as f32)
    }

    fn bytes(&self) -> Vec<u8> {
        let mut log = Writer::new(&FORMATS);
        let (mut y, mut v, mut thrust) = ([0.3, -0.2, 0.0f64], [0.0; 3], 0.0);
        for step in 0..(END / STEP) as u64 {
            let (t, every) = (step as f64 * STEP, |seconds: f64| step.is_multiple_of((seconds / STEP).round() as u64));
            if every(0.02) {
                thrust = self.set_point(t);
                if self.thrust {
                    log.data("vehicle_thrust_setpoint", 0, t, &[Float(0.0), Float(0.0), Float(-thrust)]);
                }
                // Another instance, seldom sent and of something else.
                if self.thrust && every(1.0) {
                    log.data("vehicle_thrust_setpoint", 1, t, &[Float(0.9), Float(0.0), Float(0.0)]);
                }
            }
            if every(0.01) {
                log.data("vehicle_attitude", 0, t, &attitude(t).map(Float));
            }
            if every(0.05) {
                let leap = if t >= 8.0 { self.reset } else { 0.0 };
                let leapt = Byte(u8::from(leap != 0.0));
                let place = [y[0] + leap, y[1], y[2], v[0], v[1], v[2], leap, 0.0, 0.0].map(Float);
                log.data("vehicle_local_position", 0, t, &[&place[..], &[Byte(1), Byte(1), leapt, Byte(0)]].concat());
            }
            if every(0.5) {
                let on_ground = !self.flies || !(LIFT_OFF - 0.8..=TOUCH_DOWN + 1.2).contains(&t);
                log.data("vehicle_land_detected", 0, t, &[Byte(u8::from(on_ground))]);
                log.data("actuator_armed", 0, t, &[Byte(u8::from(self.flies && t >= 0.5))]);
                log.data("hover_thrust_estimate", 0, t, &[Float(0.425), Float(1e-6), Byte(u8::from(t > 6.0))]);
            }
            if !(LIFT_OFF..TOUCH_DOWN).contains(&t) {
                (v, y[2]) = ([0.0; 3], if t < LIFT_OFF { 0.0 } else { y[2] });
                continue;
            }
            let [w, a, b, c] = attitude(t + STEP / 2.0);
            // Thrust acts along -z of the body.
            let down = [2.0 * (a * c + w * b), 2.0 * (b * c - w * a), 1.0 - 2.0 * (a * a + b * b)];
            for i in 0..3 {
                let weight = if i == 2 { GRAVITY } else { 0.0 };
                let acceleration = weight - GRAVITY / HOVER * thrust * down[i];
                y[i] += STEP * v[i] + STEP * STEP / 2.0 * acceleration;
                v[i] += STEP * acceleration;
            }
        }
        log.finish()
    }
}

fn fsb(directory: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).current_dir(directory).arg("replay").args(args).output().unwrap()
}

fn replay(bytes: &[u8], args: &[&str]) -> Output {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("log.ulg"), bytes).unwrap();
    fsb(directory.path(), &[&["log.ulg"], args].concat())
}

fn json(bytes: &[u8], args: &[&str]) -> (Value, String) {
    let output = replay(bytes, &[&["--json"], args].concat());
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{stderr}");
    (serde_json::from_slice(&output.stdout).unwrap(), stderr)
}

fn assert_near(value: &Value, truth: f64, relative: f64) {
    let value = value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    assert!((value / truth - 1.0).abs() <= relative, "{value} is not {truth}");
}

#[test]
fn hover_thrust_of_what_flies() {
    let (json, stderr) = json(&Log::default().bytes(), &[]);
    println!("{json}\n{stderr}");
    assert_near(&json["hover_thrust"]["value"], HOVER, 1e-4);
    assert_near(&json["hover_thrust"]["px4"], 0.425, 1e-6);
    assert_eq!((json.get("mass"), &json["hover_thrust"]["valid"]), (None, &true.into()));
    // The frames: a wrong one would send the vehicle elsewhere than where it went.
    for axis in ["x", "y", "z"] {
        assert!(json["axes"][axis]["velocity_rms_error"].as_f64().unwrap() < 3e-3, "{json}");
    }
    assert!(stderr.contains("using vehicle_thrust_setpoint (50.0 Hz, instance 0 of 2)"), "{stderr}");
    let told = stderr.lines().find(|line| line.contains("flight from")).unwrap_or_else(|| panic!("{stderr}"));
    let times: Vec<f64> = told.split(' ').filter_map(|word| word.parse().ok()).collect();
    assert!(times[0] > LIFT_OFF && times[0] < LIFT_OFF + 2.0 && times[1] < TOUCH_DOWN, "{told}");
}

#[test]
fn newtons_make_it_a_mass() {
    let (json, _) = json(&Log::default().bytes(), &["--full-thrust", "30"]);
    assert_near(&json["mass"]["value"], HOVER * 30.0 / GRAVITY, 1e-4);
    assert_eq!(json.get("hover_thrust"), None);
}

#[test]
fn a_reset_of_the_position_is_taken_back_and_told() {
    let (json, stderr) = json(&Log { reset: 0.8, ..Log::default() }.bytes(), &[]);
    assert!(stderr.contains("reset the position at t = 8.00 s, north by 0.80 m"), "{stderr}");
    assert!(!stderr.contains("jumps"), "{stderr}");
    assert_near(&json["hover_thrust"]["value"], HOVER, 1e-4);
}

#[test]
fn a_thrust_at_its_limit_is_told() {
    let stderr = json(&Log { largest: 0.44, ..Log::default() }.bytes(), &[]).1;
    assert!(stderr.contains("the thrust stays at its largest value, 0.44"), "{stderr}");
}

#[test]
fn a_file_cut_off_is_used_as_far_as_it_goes() {
    let bytes = Log::default().bytes();
    let (json, stderr) = json(&bytes[..bytes.len() * 3 / 5], &[]);
    assert_near(&json["hover_thrust"]["value"], HOVER, 1e-4);
    assert!(stderr.contains("the file is damaged, what comes before is used"), "{stderr}");
}

#[test]
fn what_never_flies_ends_with_3_and_what_is_no_log_with_2() {
    let cases: [(Vec<u8>, i32, &str); 4] = [
        (Log { flies: false, ..Log::default() }.bytes(), 3, "no flight in this log: the motors are never armed"),
        (
            Log { thrust: false, ..Log::default() }.bytes(),
            2,
            "no thrust set-point in this log; looked for vehicle_thrust_setpoint",
        ),
        (b"ULogfool".to_vec(), 2, "log.ulg: not a ULog file"),
        (Vec::new(), 2, "log.ulg: not a ULog file"),
    ];
    for (bytes, status, expected) in cases {
        let output = replay(&bytes, &["--json"]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains(expected), "{expected}: {stderr}");
        assert_eq!((output.status.code(), output.stdout.len()), (Some(status), 0), "{stderr}");
    }
    let missing = fsb(tempfile::tempdir().unwrap().path(), &["none.ulg"]);
    assert!(String::from_utf8_lossy(&missing.stderr).contains("none.ulg: no such file; expected a ULog file"));
    assert_eq!(missing.status.code(), Some(2));
}

/// A parameter whose name is longer than its message, after everything else: what comes before is used, and nothing but words is
/// on stderr.
#[test]
fn a_message_shorter_than_its_own_lengths() {
    let bytes = [&Log::default().bytes()[..], &[3, 0, b'Q', 200, b'x', b'y'], &[3, 0, b'P', 200, b'x', b'y']].concat();
    let (json, stderr) = json(&bytes, &[]);
    assert_near(&json["hover_thrust"]["value"], HOVER, 1e-4);
    assert!(stderr.contains("the file is damaged, what comes before is used") && !stderr.contains("panic"), "{stderr}");
}

/// Bytes changed here and there end in a result or in a refusal, never in a crash.
#[test]
fn damaged_bytes_do_not_crash() {
    let whole = Log::default().bytes();
    let mut chance = 1u64;
    for trial in 0..60 {
        let mut bytes = whole[..whole.len() / 2].to_vec();
        for _ in 0..20 {
            chance = chance.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let reach = if trial % 2 == 0 { 900 } else { bytes.len() };
            let at = 16 + (chance >> 33) as usize % (reach - 16);
            bytes[at] = (chance >> 8) as u8;
        }
        let output = replay(&bytes, &["--json"]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(matches!(output.status.code(), Some(0..=3)), "trial {trial}: {:?} {stderr}", output.status);
    }
}
