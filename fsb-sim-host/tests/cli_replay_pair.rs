//! `fsb replay --motion --input` as a process, on a vehicle whose motion is known.

#[path = "cli_replay_pair/vehicle.rs"]
mod vehicle;

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;
use vehicle::Vehicle;

fn fsb(directory: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fsb")).current_dir(directory).arg("replay").args(args).output().unwrap()
}

fn with_files(motion: &str, input: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("motion.csv"), motion).unwrap();
    fs::write(directory.path().join("input.csv"), input).unwrap();
    directory
}

const PAIR: [&str; 4] = ["--motion", "motion.csv", "--input", "input.csv"];

fn replay(motion: &str, input: &str, args: &[&str]) -> (Output, TempDir) {
    let directory = with_files(motion, input);
    (fsb(directory.path(), &[&PAIR[..], args].concat()), directory)
}

fn json(vehicle: &Vehicle, args: &[&str]) -> (Value, String) {
    let (motion, input) = vehicle.record();
    let (output, _) = replay(&motion, &input, &[&["--json"], args].concat());
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{stderr}");
    (serde_json::from_slice(&output.stdout).unwrap(), stderr)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn assert_near(value: &Value, truth: f64, within: f64) {
    let value = number(value);
    assert!((value - truth).abs() <= within, "{value} is not {truth} to {within}");
}

/// Held inputs are exact at their own stamps: nothing but the interpolation of positions and of attitudes is left.
#[test]
fn mass_to_2e_5_from_irregular_files() {
    let (json, stderr) = json(&Vehicle::default(), &[]);
    assert_near(&json["mass"]["value"], 1.3, 2e-5 * 1.3);
    assert_near(&json["period_s"], 0.01, 2e-4);
    assert!(number(&json["residual_rms"]) < 2e-3, "{json}");
    assert_eq!(json["lag_s"], 0.0);
    for axis in ["x", "y", "z"] {
        assert!(number(&json["axes"][axis]["velocity_rms_error"]) < 2e-3, "{json}");
        assert_eq!(json["axes"][axis]["drag_observable"], false);
        assert_eq!(json["axes"][axis]["drag"], Value::Null);
    }
    assert!(!stderr.contains("gap") && !stderr.contains("jump") && !stderr.contains("largest value"), "{stderr}");
}

#[test]
fn drag_and_disturbance_are_told() {
    let vehicle =
        Vehicle { drag: [0.4, 0.3, 0.5], disturbance: [0.1, -0.15, 0.05], seconds: 20.0, ..Vehicle::default() };
    let (json, _) = json(&vehicle, &["--identify", "k,drag,disturbance"]);
    assert_near(&json["mass"]["value"], 1.3, 3e-3 * 1.3);
    for (i, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let axis = &json["axes"][axis];
        assert_eq!((&axis["drag_observable"], &axis["disturbance_observable"]), (&true.into(), &true.into()), "{json}");
        assert_near(&axis["drag"], vehicle.drag[i], 0.02);
        assert_near(&axis["disturbance"], vehicle.disturbance[i], 0.03);
    }
    assert!(number(&json["residual_rms"]) < 3e-3, "{json}");
}

#[test]
fn a_known_lag_is_found_to_a_millisecond() {
    for (lag, noise) in [(0.0234, 0.0), (-0.011, 0.0), (0.0234, 0.001), (0.087, 0.001)] {
        let vehicle = Vehicle { lag, noise, drag: [0.3, 0.3, 0.2], seconds: 20.0, ..Vehicle::default() };
        let (json, _) = json(&vehicle, &["--lag", "auto"]);
        println!("lag {lag} s, noise {noise} m: found {}", json["lag_s"]);
        assert_near(&json["lag_s"], lag, 1e-3);
    }
}

#[test]
fn a_lag_that_is_given_is_taken() {
    let vehicle = Vehicle { lag: 0.05, ..Vehicle::default() };
    let (json, _) = json(&vehicle, &["--lag", "0.05"]);
    assert_near(&json["mass"]["value"], 1.3, 2e-5 * 1.3);
    assert_eq!(json["lag_s"], 0.05);
}

#[test]
fn a_gap_is_missed_measurements_and_a_word() {
    let vehicle = Vehicle { lost: |t| (3.0..3.4).contains(&t), ..Vehicle::default() };
    let (json, stderr) = json(&vehicle, &[]);
    let missed = number(&json["missed"]);
    assert!((114.0..=126.0).contains(&missed), "{missed} of three axes for 0.4 s");
    assert_near(&json["mass"]["value"], 1.3, 1e-4 * 1.3);
    assert!(stderr.contains("position: a gap of 0.41 s at t = 3.00 s") && !stderr.contains("jumps"), "{stderr}");
}

#[test]
fn a_jump_and_a_saturated_motor_get_a_word() {
    let (motion, input) = Vehicle::default().record();
    let mut rows: Vec<String> = motion.lines().map(str::to_owned).collect();
    for row in rows.iter_mut().skip(400) {
        let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
        cells[2] = (cells[2].parse::<f64>().unwrap() + 0.7).to_string();
        *row = cells.join(",");
    }
    let clipped: Vec<String> = input
        .lines()
        .map(|line| match line.split(',').collect::<Vec<_>>()[..] {
            [t, f, _] if f != "thrust_N" => format!("{t},{},7", f.parse::<f64>().unwrap().min(14.0)),
            _ => line.to_owned(),
        })
        .collect();
    let (output, _) = replay(&rows.join("\n"), &clipped.join("\n"), &[]);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("y jumps by 0.7") && stderr.contains("largest value, 14.0000"), "{stderr}");
}

/// An attitude from world to body, and a height that is a depth, are noticed although gravity still tells a mass.
#[test]
fn wrong_directions_get_a_word() {
    let (motion, input) = Vehicle::default().record();
    let told = |columns: &[usize]| {
        let turned: Vec<String> = motion
            .lines()
            .map(|line| {
                let cell = |(i, cell): (usize, &str)| match cell.parse::<f64>() {
                    Ok(number) if columns.contains(&i) => (-number).to_string(),
                    _ => cell.to_owned(),
                };
                line.split(',').enumerate().map(cell).collect::<Vec<_>>().join(",")
            })
            .collect();
        String::from_utf8_lossy(&replay(&turned.join("\n"), &input, &[]).0.stderr).into_owned()
    };
    assert_eq!(told(&[]), "");
    // All four signs of a quaternion turned are the same attitude, three of them its inverse.
    assert_eq!(told(&[4, 5, 6, 7]), "");
    let inverse = told(&[5, 6, 7]);
    assert!(inverse.contains("x, y: the motion goes against the force"), "{inverse}");
    assert!(told(&[3]).contains("z: the motion goes against the force"));
}

#[test]
fn columns_by_other_names() {
    let (motion, input) = Vehicle::default().record();
    let motion = motion.replacen("t,x,", "stamp,px,", 1);
    let input = input.replacen("t,thrust_N", "time,T", 1);
    let directory = with_files(&motion, &input);
    let toml = "x = \"px\"\nthrust = \"T\"\n[motion]\nt = \"stamp\"\n[input]\nt = \"time\"\n";
    fs::write(directory.path().join("columns.toml"), toml).unwrap();
    let by_file = fsb(directory.path(), &[&PAIR[..], &["--columns", "columns.toml", "--json"]].concat());
    let names = ["--column", "x=px", "--column", "motion.t=stamp", "--column", "input.t=time", "--column", "thrust=T"];
    let by_line = fsb(directory.path(), &[&PAIR[..], &names, &["--json"]].concat());
    assert!(by_file.status.success(), "{}", String::from_utf8_lossy(&by_file.stderr));
    assert_eq!(by_file.stdout, by_line.stdout);
    let json: Value = serde_json::from_slice(&by_file.stdout).unwrap();
    assert_near(&json["mass"]["value"], 1.3, 2e-5 * 1.3);
}

#[test]
fn a_body_force_in_place_of_the_thrust() {
    let (motion, input) = Vehicle::default().record();
    let input = input.replacen("thrust_N,other", "up,none", 1).replace(",7\n", ",0\n");
    let names = ["--column", "fx_body=none", "--column", "fy_body=none", "--column", "fz_body=up", "--json"];
    let (output, _) = replay(&motion, &input, &names);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_near(&json["mass"]["value"], 1.3, 2e-5 * 1.3);
}

#[test]
fn a_normalised_thrust_gives_a_hover_thrust() {
    let (motion, input) = Vehicle::default().record();
    let (output, directory) = replay(&motion, &input, &["--normalised", "--json", "--out", "out"]);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json.get("mass"), None);
    assert_near(&json["hover_thrust"]["value"], 1.3 * vehicle::GRAVITY, 2e-5 * 1.3 * vehicle::GRAVITY);
    assert_eq!((&json["hover_thrust"]["valid"], &json["hover_thrust"]["px4"]), (&true.into(), &Value::Null));
    let told = fs::read_to_string(directory.path().join("out/estimates.csv")).unwrap();
    assert!(told.starts_with("t,x_hat") && told.lines().next().unwrap().ends_with(",hover_thrust_hat,hover_thrust_sd"));
    let last: f64 = told.lines().last().unwrap().split(',').nth_back(1).unwrap().parse().unwrap();
    assert!((last / (1.3 * vehicle::GRAVITY) - 1.0).abs() < 2e-5, "{last}");
    let table = String::from_utf8(replay(&motion, &input, &["--normalised"]).0.stdout).unwrap();
    assert!(table.contains("hover thrust  x, y, z  12.753") && !table.contains("kg"), "{table}");
    let page = fs::read_to_string(directory.path().join("out/report.html")).unwrap();
    for part in ["Hover thrust", "What is left of the accelerations", "Kalman filter", "Excitation", "Innovations of x"]
    {
        assert!(page.contains(part), "{part}");
    }
    for loaded in ["src=", "href=\"http", "@import", "url("] {
        assert!(!page.contains(loaded), "the page loads something: {loaded}");
    }
    let full = ["--full-thrust", "2", "--json"];
    let newtons: Value = serde_json::from_slice(&replay(&motion, &input, &full).0.stdout).unwrap();
    assert_near(&newtons["mass"]["value"], 2.6, 1e-4);
}

#[test]
fn nothing_that_pushes_is_no_flight() {
    let (motion, _) = Vehicle::default().record();
    let input: String = (0..100).map(|i| format!("{},0\n", 0.1 * f64::from(i))).collect();
    let (output, _) = replay(&motion, &format!("t,thrust_N\n{input}"), &["--json"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(output.stdout.is_empty());
    assert!(String::from_utf8_lossy(&output.stderr).contains("no flight in this log"));
}

#[test]
fn bad_input_is_named_and_nothing_is_written() {
    let (motion, input) = Vehicle { seconds: 2.0, ..Vehicle::default() }.record();
    let no_quaternion = motion.replacen("qw", "q0", 1);
    let no_number = motion.replacen("\n0.0", "\n0.0x", 1);
    let too_large = format!("{motion}1e39,0,0,0,1,0,0,0,0,0,0\n");
    let steering = motion.replacen("\n0.0", "\n\u{1b}[2J", 1);
    let backwards = format!("{input}0.1,13,7\n");
    let short = input.lines().take(3).collect::<Vec<_>>().join("\n");
    let elsewhere: String = input
        .lines()
        .map(|line| if line.starts_with('t') { line.to_owned() } else { format!("9{line}") } + "\n")
        .collect();
    let last = input.lines().count() + 1;
    let turned = motion.replacen("\n", "\n0.0001,0,0,0,2,0,0,0,0,0,0\n", 1);
    let cases: [(&str, &str, &[&str], &str); 14] = [
        (&no_quaternion, &input, &[], "motion.csv:1: no column `qw` for qw; found t, x, y, z, q0"),
        (&no_number, &input, &[], "motion.csv:2: column t: found `0.0x"),
        (&too_large, &input, &[], "column t: found `1e39`, expected a number within f32, up to 3.4e38"),
        (&steering, &input, &[], "motion.csv:2: column t: found `\u{fffd}[2J"),
        (&motion, &backwards, &[], &format!("input.csv:{last}: column t: found 0.1 s after")),
        (&motion, &short, &[], "input.csv: rows with an input: found 2, expected at least 4"),
        (&motion, &elsewhere, &[], "no second in common"),
        (&turned, &input, &[], "motion.csv:2: column qw: found `[2.0, 0.0, 0.0, 0.0]`, expected a quaternion"),
        (&motion, "", &[], "input.csv:1: the file is empty"),
        (&motion, &input, &["--column", "thrust=F"], "input.csv:1: no column `F` for thrust; found t, thrust_N, other"),
        (&motion, &input, &["--column", "lift=F"], "--column: there is no `lift` to name"),
        (&motion, &input, &["--columns", "none.toml"], "none.toml: no such file"),
        (&motion, &input, &["--lag", "2"], "motion.csv: with this --lag hardly a position is left"),
        (&motion, &input, &["--lag", "-9"], "motion.csv: with this --lag hardly a position is left"),
    ];
    for (motion, input, args, expected) in cases {
        let (output, directory) = replay(motion, input, &[args, &["--out", "out"]].concat());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains(expected), "{expected}: {stderr}");
        assert_eq!(output.status.code(), Some(2), "{stderr}");
        assert!(output.stdout.is_empty() && !directory.path().join("out").exists());
    }
    let directory = with_files(&motion, &input);
    fs::write(directory.path().join("names.toml"), "[sensor]\nx = \"x\"\n").unwrap();
    let output = fsb(directory.path(), &[&PAIR[..], &["--columns", "names.toml"]].concat());
    assert!(String::from_utf8_lossy(&output.stderr).contains("names.toml: sensor: found a value of type table"));
    let (output, _) = replay(&motion, &input, &["--identify", "drag"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("k is always identified"));
    assert_eq!(output.status.code(), Some(2));
}

/// Whatever ends a line, and with empty lines between: the line an editor shows.
#[test]
fn the_line_at_fault_is_the_one_an_editor_shows() {
    let (motion, input) = Vehicle { seconds: 1.0, ..Vehicle::default() }.record();
    let mut lines: Vec<&str> = motion.lines().collect();
    lines[30] = "0.3,none,0,0,1,0,0,0,0,0,0";
    for (end, line) in [("\n", 31), ("\r\n", 31), ("\r", 31), ("\n\n", 61), ("\r\n\r\n", 61)] {
        let (output, _) = replay(&lines.join(end), &input, &[]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains(&format!("motion.csv:{line}: column x: found `none`")), "{end:?}: {stderr}");
    }
    let below = format!("\n\n{}", motion.replacen("qw", "q0", 1));
    let (output, _) = replay(&below, &input, &[]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("motion.csv:3: no column `qw`"));
    lines[30] = "nan,0,0,0,1,0,0,0,0,0,0";
    let (output, _) = replay(&lines.join("\n"), &input, &[]);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("motion.csv:31: column t: found `nan`, expected a finite number\n"), "{stderr}");
}

/// The command in the report is one that a shell runs, and it makes the same report.
#[cfg(unix)]
#[test]
fn the_command_of_the_report_can_be_pasted() {
    let (motion, input) = Vehicle::default().record();
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("-it's <my> motion.csv"), motion.replacen("t,x", "t,pos & $x", 1)).unwrap();
    fs::write(directory.path().join("input.csv"), input).unwrap();
    fs::write(directory.path().join("all names.toml"), "y = 'y'").unwrap();
    let output = fsb(
        directory.path(),
        &[
            "--motion=./-it's <my> motion.csv",
            "--input",
            "input.csv",
            "--column",
            "x=pos & $x",
            "--columns",
            "all names.toml",
            "--lag",
            "0.01",
            "--out",
            "out",
        ],
    );
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let page = fs::read_to_string(directory.path().join("out/report.html")).unwrap();
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..roxmltree::ParsingOptions::default() };
    let parsed = roxmltree::Document::parse_with_options(&page, options).unwrap();
    let shown =
        parsed.descendants().filter_map(|node| node.text()).find(|text| text.starts_with("fsb replay")).unwrap();
    let script = format!("fsb() {{ \"$FSB\" \"$@\"; }}; {shown} --out again");
    let mut shell = Command::new("sh");
    shell.arg("-c").arg(script).env("FSB", env!("CARGO_BIN_EXE_fsb")).current_dir(directory.path());
    let pasted = shell.output().unwrap();
    assert!(pasted.status.success(), "{shown}: {}", String::from_utf8_lossy(&pasted.stderr));
    assert_eq!(page, fs::read_to_string(directory.path().join("again/report.html")).unwrap());
}
