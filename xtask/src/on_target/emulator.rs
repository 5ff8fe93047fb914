//! QEMU's `netduinoplus2`: an STM32F405. With `-icount shift=0` an instruction takes one nanosecond of its time, so that
//! counts are exact and the same on every run.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

use crate::command::on_path;

const PROGRAM: &str = "qemu-system-arm";
/// No program here takes a tenth of this.
const LIMIT: Duration = Duration::from_secs(240);

/// What the program printed. It must exit with status 0 in time, and the last line must be `end`: a silent or cut off run
/// is none.
pub fn output(program: &Path, argument: Option<&str>) -> Result<Vec<String>> {
    let child = start(program, argument, &[], Stdio::inherit())?;
    printed(child)
}

/// As [`output`], the serial port being sent `bytes` as fast as the program takes them, and nothing after them.
pub fn fed(program: &Path, bytes: Vec<u8>) -> Result<Vec<String>> {
    let mut child = started(program, None, "stdio", &[], Stdio::piped(), Stdio::inherit())?;
    let mut stdin = child.stdin.take().context("no standard input")?;
    // A program that has ended takes no more.
    thread::spawn(move || stdin.write_all(&bytes));
    printed(child)
}

fn printed(mut child: Child) -> Result<Vec<String>> {
    let mut stdout = child.stdout.take().context("no standard output")?;
    let reader = thread::spawn(move || {
        let mut text = String::new();
        stdout.read_to_string(&mut text).map(|_| text)
    });
    let outcome = finish(&mut child);
    let text = reader.join().ok().context("the reader died")?.context("cannot read the output")?;
    if let Err(error) = outcome {
        print!("{text}");
        return Err(error);
    }
    whole(&text)
}

/// The bytes of the standard output, which need no `end`. The program must exit with status 0 in time.
pub fn bytes(program: &Path) -> Result<Vec<u8>> {
    let mut child = start(program, None, &[], Stdio::null())?;
    let mut stdout = child.stdout.take().context("no standard output")?;
    let reader = thread::spawn(move || {
        let mut bytes = Vec::new();
        stdout.read_to_end(&mut bytes).map(|_| bytes)
    });
    finish(&mut child)?;
    reader.join().ok().context("the reader died")?.context("cannot read the output")
}

/// Hands every line of the emulator's log to `line`, for a program that runs one instruction a time.
pub fn traced(program: &Path, argument: &str, filter: &str, mut line: impl FnMut(&str) -> Result<()>) -> Result<()> {
    let options = ["-singlestep", "-d", "exec,nochain", "-dfilter", filter];
    let mut child = start(program, Some(argument), &options, Stdio::piped())?;
    let mut log = BufReader::with_capacity(1 << 20, child.stderr.take().context("no log")?);
    let mut text = String::new();
    while log.read_line(&mut text).context("cannot read the log")? > 0 {
        if let Err(error) = line(text.trim_end()) {
            let _ = child.kill();
            let _ = child.wait();
            return Err(error);
        }
        text.clear();
    }
    let mut printed = String::new();
    child.stdout.take().context("no standard output")?.read_to_string(&mut printed)?;
    finish(&mut child)?;
    whole(&printed).map(|_| ())
}

/// The lines before `end`.
fn whole(text: &str) -> Result<Vec<String>> {
    let mut lines: Vec<String> = text.lines().map(|line| line.trim_end().to_string()).collect();
    match lines.pop() {
        Some(last) if last == "end" => Ok(lines),
        Some(last) => bail!("the program on the emulator did not come to its end; its last line: {last}"),
        None => bail!("the program on the emulator printed nothing"),
    }
}

fn start(program: &Path, argument: Option<&str>, options: &[&str], log: Stdio) -> Result<Child> {
    started(program, argument, "null", options, Stdio::null(), log)
}

fn started(
    program: &Path,
    argument: Option<&str>,
    serial: &str,
    options: &[&str],
    input: Stdio,
    log: Stdio,
) -> Result<Child> {
    if !on_path(PROGRAM) {
        bail!("{PROGRAM} is missing, and without it nothing can be said about the target: run `cargo xtask setup`");
    }
    let mut semihosting = String::from("enable=on,target=native,arg=program");
    if let Some(argument) = argument {
        semihosting += &format!(",arg={argument}");
    }
    println!("$ {PROGRAM} … -kernel {} {}", program.display(), argument.unwrap_or_default());
    Command::new(PROGRAM)
        .args(["-M", "netduinoplus2", "-nographic", "-monitor", "none", "-serial", serial])
        .args(["-icount", "shift=0,sleep=off", "-semihosting-config", &semihosting])
        .args(options)
        .arg("-kernel")
        .arg(program)
        .stdin(input)
        .stdout(Stdio::piped())
        .stderr(log)
        .spawn()
        .with_context(|| format!("cannot start {PROGRAM}"))
}

fn finish(child: &mut Child) -> Result<()> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            if !status.success() {
                bail!("the program on the emulator failed: {status}");
            }
            return Ok(());
        }
        if start.elapsed() > LIMIT {
            child.kill()?;
            child.wait()?;
            bail!("the program on the emulator did not end within {} s", LIMIT.as_secs());
        }
        thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_has_an_end() {
        assert_eq!(whole("a 1\nb 2\nend\n").unwrap(), ["a 1", "b 2"]);
        assert!(whole("").is_err());
        assert!(whole("a 1\nb").is_err());
        assert!(whole("a 1\n").is_err());
    }
}
