//! Each error, with the place and the words it must have.

use super::*;

/// The message must begin with the file and line, and have every part.
#[track_caller]
fn refused(text: &str, place: &str, parts: &[&str]) {
    let message = read(text).expect_err("this log must be refused").to_string();
    assert!(message.starts_with(&format!("{place}: ")), "{message}");
    for part in parts {
        assert!(message.contains(part), "{message}\nlacks `{part}`");
    }
}

#[test]
fn no_such_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("missing.csv");
    let error = AxisLog::read(&path).unwrap_err();
    assert!(matches!(error, LogError::NotFound { .. }));
    assert_eq!(error.to_string(), format!("{}: no such file; expected an axis log (CSV)", path.display()));
}

#[test]
fn a_folder_is_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let message = AxisLog::read(folder.path()).unwrap_err().to_string();
    assert!(message.starts_with(&format!("{}: cannot be read: ", folder.path().display())), "{message}");
}

#[test]
fn nothing_in_the_file() {
    for text in ["", "\n\r\n\n", "\u{feff}"] {
        refused(text, "a.csv:1", &["the file is empty", "expected a header"]);
    }
}

#[test]
fn numbers_for_a_header() {
    refused("0,1,2\n0.1,1,2\n", "a.csv:1", &["found `0,1,2`", "expected a header"]);
}

#[test]
fn no_time() {
    refused("time,x,fx\n", "a.csv:1", &["column t is missing", "found `time,x,fx`"]);
    refused("t x fx\n0 1 2\n", "a.csv:1", &["column t is missing", "found `t x fx`", "separated by commas"]);
}

#[test]
fn a_binary_file_is_cut_short() {
    let bytes: Vec<u8> = (0..4000_u32).map(|i| (i * i % 251) as u8 | 0x80).collect();
    let message = AxisLog::from_reader("a.csv", &bytes[..]).unwrap_err().to_string();
    assert!(message.starts_with("a.csv:1: ") && message.chars().count() < 250, "{message}");
}

#[test]
fn a_column_twice() {
    refused("t,x,fx,x\n", "a.csv:1", &["column x is there twice", "columns 2 and 4"]);
    refused("t,x,fx,t\n", "a.csv:1", &["column t is there twice", "columns 1 and 4"]);
    refused("t,x,fx,vx_ref,vx_ref\n", "a.csv:1", &["column vx_ref", "columns 4 and 5"]);
    assert!(read("t,x,fx,a,a\n0,0,0,,\n1,0,0,,\n2,0,0,,\n3,0,0,,\n").is_ok(), "columns that are not read may repeat");
}

#[test]
fn no_axis() {
    refused("t,a\n", "a.csv:1", &["no usable axis", "found none of these", "x and fx", "yaw and tauz"]);
    refused("t,x,y,fz\n", "a.csv:1", &["no usable axis", "found x without fx, y without fy, fz without z"]);
    refused("t,roll,tauy\n", "a.csv:1", &["roll without taux, tauy without pitch"]);
}

#[test]
fn not_a_number() {
    refused(
        "t,x,fx\n0,0,0\n1,one,0\n",
        "a.csv:3",
        &["column x", "found `one`", "expected a number, nan or an empty cell"],
    );
    refused("t,x,fx\n0,0,0\n1,0,1.2.3\n", "a.csv:3", &["column fx", "found `1.2.3`", "expected a number"]);
    refused("t;x;fx\n0;0;1,5\n", "a.csv:2", &["column fx", "found `1,5`", "a number with a decimal point"]);
    refused("t,x,fx\n0:00,0,0\n", "a.csv:2", &["column t", "found `0:00`"]);
    refused("t,x,fx,vx_ref\n0,0,0,-\n", "a.csv:2", &["column vx_ref", "found `-`"]);
}

#[test]
fn not_finite() {
    for word in ["inf", "-Infinity", "1e999"] {
        let found = format!("found `{word}`");
        let expected = "expected a finite number, nan or an empty cell";
        refused(&format!("t,x,fx\n0,{word},0\n"), "a.csv:2", &["column x", &found, expected]);
        refused(&format!("t,x,fx,vx_ref\n0,0,0,{word}\n"), "a.csv:2", &["column vx_ref", &found, expected]);
    }
    for word in ["nan", "NaN", "inf", "-Infinity", "1e999"] {
        let found = format!("found `{word}`");
        refused(&format!("t,x,fx\n0,0,{word}\n"), "a.csv:2", &["column fx", &found, "expected a finite number"]);
        refused(&format!("t,x,fx\n{word},0,0\n"), "a.csv:2", &["column t", &found]);
    }
}

#[test]
fn beyond_f32() {
    refused("t,x,fx\n0,-3.5e38,0\n", "a.csv:2", &["column x", "found `-3.5e38`", "within f32"]);
    refused("t,x,fx\n0,0,1e100\n", "a.csv:2", &["column fx", "found `1e100`"]);
    assert!(read("t,x,fx\n0,3.4e38,-3.4e38\n1,,0\n2,,0\n3,,0\n").is_ok());
}

#[test]
fn empty_cells() {
    refused("t,x,fx\n0,0,0\n1,0,\n", "a.csv:3", &["column fx", "empty cell", "expected a number"]);
    refused("t,x,fx\n0,0,0\n ,0,0\n", "a.csv:3", &["column t", "empty cell"]);
}

#[test]
fn ragged_rows() {
    refused("t,x,fx\n0,0,0\n1,0\n", "a.csv:3", &["found 2 fields, expected 3", "first one missing is fx"]);
    refused("t,x,fx\n0,0,0\n1,0,0,0\n", "a.csv:3", &["found 4 fields, expected 3"]);
}

#[test]
fn too_short() {
    refused("t,x,fx\n", "a.csv:1", &["ends after 0 samples", "at least 4"]);
    refused(&with_times(0..3), "a.csv:4", &["ends after 3 samples", "at least 4"]);
    refused(&with_times(0..1), "a.csv:2", &["ends after 1 sample,", "at least 4"]);
}

#[test]
fn lines_are_counted_as_an_editor_does() {
    let text = "t,x,fx\n0,0,0\n\n1,0,0\n2,bad,0\n";
    refused(text, "a.csv:5", &["`bad`"]);
    refused(&text.replace('\n', "\r\n"), "a.csv:5", &["`bad`"]);
    refused(&text.replace('\n', "\r"), "a.csv:5", &["`bad`"]);
    refused(&format!("\u{feff}{text}"), "a.csv:5", &["`bad`"]);
    refused("t,x,fx,note\n0,0,0,\"two\nlines\"\n1,bad,0,\n", "a.csv:4", &["`bad`"]);
}
