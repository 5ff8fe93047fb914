//! `fsb` as a process whose output nobody reads to the end.

use serde_json::Value;
use std::fmt::Write as _;
use std::process::{Command, Output, Stdio};

/// A mass on a spring scale, 100 Hz, and a column that is not read: the command has something to tell.
fn log() -> String {
    let mut log = String::from("t,z,fz,x\n");
    for n in 0..400 {
        let t = 0.01 * f64::from(n);
        writeln!(log, "{t},{},{},0", (2.0 * t).sin(), 9.81 - 4.0 * (2.0 * t + 0.01).sin()).unwrap();
    }
    log
}

/// Runs with a stderr that is closed at its other end.
fn unheard(arguments: &[&str]) -> (Output, tempfile::TempDir) {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("log.csv"), log()).unwrap();
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let command = Command::new(env!("CARGO_BIN_EXE_fsb"))
        .args(arguments)
        .current_dir(directory.path())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(writer)
        .spawn();
    (command.unwrap().wait_with_output().unwrap(), directory)
}

/// `fsb … 2>&1 >result.json | head -1`: the result is there, and the exit status the one documented.
#[test]
fn a_stderr_that_nobody_reads_costs_nothing() {
    let (output, directory) = unheard(&["replay", "log.csv", "--json", "--out", "out"]);
    assert_eq!(output.status.code(), Some(0));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["samples"], 400);
    assert!(directory.path().join("out/report.html").is_file());
    for (arguments, status) in [
        (&["replay", "none.csv"][..], 2),
        (&["fly", "--scenario", "hover", "--set", "duration=1", "--out", "out"], 0),
        (&["tune", "--noise-sd", "0.01", "--rate", "100", "--out", "out"], 0),
    ] {
        assert_eq!(unheard(arguments).0.status.code(), Some(status), "{arguments:?}");
    }
}

/// A full disk is told, whatever was asked: nobody takes what is not there for an answer. A reader that has gone is no failure.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_no_success() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("log.csv"), log()).unwrap();
    for arguments in [
        &["--help"][..],
        &["--version"],
        &["help", "fly"],
        &["fly", "--help"],
        &["fly", "--list"],
        &["fly", "--list", "--json"],
        &["replay", "log.csv", "--json"],
        &["tune", "--noise-sd", "0.01", "--rate", "100"],
    ] {
        let run = |stdout: Stdio| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_fsb"));
            command.args(arguments).current_dir(directory.path()).stdout(stdout).output().unwrap()
        };
        let full = run(std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap().into());
        let complaint = String::from_utf8_lossy(&full.stderr).into_owned();
        assert_eq!(full.status.code(), Some(1), "{arguments:?}: {complaint}");
        assert!(
            complaint.contains("error: cannot write to stdout: No space left on device"),
            "{arguments:?}: {complaint}"
        );
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        assert_eq!(run(writer.into()).status.code(), Some(0), "{arguments:?}");
        assert_eq!(run(Stdio::piped()).status.code(), Some(0), "{arguments:?}");
    }
    assert_eq!(unheard(&["fly", "--sed", "1"]).0.status.code(), Some(2));
}

/// A log that comes through a pipe, as from `fsb replay <(zcat log.csv.gz)`, is read whole.
#[cfg(unix)]
#[test]
fn a_log_may_come_through_a_pipe() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fsb"));
    command.args(["replay", "/dev/stdin", "--json"]);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), log().as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(serde_json::from_slice::<Value>(&output.stdout).unwrap()["samples"], 400);
}
