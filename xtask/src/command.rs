//! Running other programs: shown, from the workspace root, without a standard input.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

/// The workspace root.
pub fn root() -> Result<PathBuf> {
    let manifest = std::env::var_os("CARGO_MANIFEST_DIR").context("run this as `cargo xtask`")?;
    let root = Path::new(&manifest).parent().context("xtask has no parent folder")?;
    Ok(root.to_path_buf())
}

/// Shows and runs a program; its exit status decides. `variables` are set in its environment.
pub fn run_with(program: &str, arguments: &[&str], variables: &[(&str, &str)]) -> Result<()> {
    let shown = shown(program, arguments, variables);
    println!("$ {shown}");
    std::io::stdout().flush()?;
    let status =
        prepared(program, arguments, variables)?.status().with_context(|| format!("cannot start `{shown}`"))?;
    if !status.success() {
        bail!("`{shown}`: {status}");
    }
    Ok(())
}

/// [`run_with`] the environment as it is.
pub fn run(program: &str, arguments: &[&str]) -> Result<()> {
    run_with(program, arguments, &[])
}

/// The standard output of a program that must succeed.
pub fn output(program: &str, arguments: &[&str]) -> Result<String> {
    let shown = shown(program, arguments, &[]);
    let output = prepared(program, arguments, &[])?
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("cannot start `{shown}`"))?;
    if !output.status.success() {
        bail!("`{shown}`: {}", output.status);
    }
    String::from_utf8(output.stdout).with_context(|| format!("`{shown}`: not UTF-8"))
}

/// Whether a program starts and succeeds, without a word from it.
pub fn succeeds(program: &str, arguments: &[&str]) -> bool {
    Command::new(program)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// Whether a program of this name is in a folder of `PATH`.
pub fn on_path(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}

fn prepared(program: &str, arguments: &[&str], variables: &[(&str, &str)]) -> Result<Command> {
    let mut command = Command::new(program);
    command.args(arguments).envs(variables.iter().copied()).current_dir(root()?).stdin(Stdio::null());
    Ok(command)
}

fn shown(program: &str, arguments: &[&str], variables: &[(&str, &str)]) -> String {
    let mut words: Vec<String> = variables.iter().map(|(name, value)| format!("{name}='{value}'")).collect();
    words.push(program.into());
    words.extend(arguments.iter().map(|argument| argument.to_string()));
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_status_decides() {
        assert!(run("true", &[]).is_ok());
        let error = run_with("false", &["argument"], &[("NAME", "value")]).unwrap_err().to_string();
        assert!(error.contains("NAME='value' false argument"), "{error}");
        assert!(run("no-such-program-anywhere", &[]).is_err());
        assert!(!on_path("no-such-program-anywhere"));
        assert!(on_path("cargo"));
    }

    #[test]
    fn the_root_holds_the_workspace() {
        assert!(root().unwrap().join("xtask/Cargo.toml").is_file());
    }
}
