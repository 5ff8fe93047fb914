//! The library, and programs in C with it, on this machine and on the microcontroller.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::command::{run, succeeds};
use crate::metadata;

const TARGET: &str = "thumbv7em-none-eabihf";

/// Where the interface must compile without a word.
const STRICT: &[&str] = &["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Ifsb-c/include"];

/// C that does the same arithmetic everywhere: no fused multiply-add.
const C99: &[&str] = &["-std=c99", "-ffp-contract=off", "-O2", "-g"];

const CORTEX_M4F: &[&str] =
    &["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard", "-ffunction-sections", "-fdata-sections"];

/// What a program that finds mistakes of its own is built with.
const SANITISED: &[&str] = &["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

const EMULATOR: &[&str] = &[
    "60",
    "qemu-system-arm",
    "-M",
    "netduinoplus2",
    "-nographic",
    "-monitor",
    "none",
    "-serial",
    "null",
    "-semihosting-config",
    "enable=on,target=native",
    "-icount",
    "shift=0",
    "-kernel",
];

/// Where a program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Machine {
    /// This one.
    Host,
    /// The emulated microcontroller.
    Target,
}

impl fmt::Display for Machine {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Host => "host",
            Self::Target => "target",
        })
    }
}

/// Builds into a folder of cargo's target folder.
pub struct Build {
    cargo: PathBuf,
    folder: PathBuf,
}

impl Build {
    /// The folder, made where it is missing.
    pub fn new() -> Result<Self> {
        let cargo = metadata::target_folder()?;
        let folder = cargo.join("c-interface");
        fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
        Ok(Self { cargo, folder })
    }

    /// A file of the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// The map that the linker wrote for a program of the microcontroller.
    pub fn map(&self, program: &str) -> PathBuf {
        self.file(&format!("{program}.map"))
    }

    /// The header alone, twice in a file, in C99, C11 and C++11.
    pub fn headers(&self) -> Result<()> {
        for (compiler, language, standard, machine) in [
            ("gcc", "c", "-std=c99", &[][..]),
            ("gcc", "c", "-std=c11", &[]),
            ("g++", "c++", "-std=c++11", &[]),
            ("arm-none-eabi-gcc", "c", "-std=c99", CORTEX_M4F),
            ("arm-none-eabi-gcc", "c", "-std=c11", CORTEX_M4F),
        ] {
            let source = self.file("header.c");
            fs::write(
                &source,
                "#include \"fsb.h\"\n#include \"fsb.h\"\nint nothing(void);\nint nothing(void) { return FSB_OK; }\n",
            )?;
            let mut arguments = vec![standard, "-fsyntax-only"];
            arguments.extend_from_slice(machine);
            arguments.extend_from_slice(STRICT);
            arguments.extend(["-x", language, text(&source)?]);
            run(compiler, &arguments)?;
        }
        Ok(())
    }

    /// libfsb.a, optimised. `options` go to rustc.
    pub fn library(&self, machine: Machine, options: &[&str]) -> Result<PathBuf> {
        self.library_in(&self.cargo, machine, &[], options)
    }

    /// The same with features, in a cargo target folder of its own.
    pub fn library_in(&self, folder: &Path, machine: Machine, features: &[&str], options: &[&str]) -> Result<PathBuf> {
        let mut arguments = vec!["rustc", "--release", "--package", "fsb-c", "--lib", "--target-dir", text(folder)?];
        if machine == Machine::Target {
            arguments.extend(["--target", TARGET]);
        }
        for feature in features {
            arguments.extend(["--features", feature]);
        }
        arguments.push("--");
        arguments.extend_from_slice(options);
        run("cargo", &arguments)?;
        let folder = if machine == Machine::Target { folder.join(TARGET) } else { folder.to_path_buf() };
        Ok(folder.join("release/libfsb.a"))
    }

    /// A program of one C file and the library.
    pub fn program(&self, machine: Machine, name: &str, source: &str, library: &Path) -> Result<PathBuf> {
        match machine {
            Machine::Host => self.host(name, source, library, &[]),
            Machine::Target => {
                let program = self.file(name);
                let arguments = self.target_arguments(name, source, library)?;
                let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
                run("arm-none-eabi-gcc", &arguments)?;
                Ok(program)
            }
        }
    }

    /// A program of this machine under the address and undefined-behaviour sanitizers, where the compiler has them.
    pub fn checked_program(&self, name: &str, source: &str, library: &Path) -> Result<PathBuf> {
        let probe = self.file("sanitizers.c");
        fs::write(&probe, "int main(void) { return 0; }\n")?;
        let target = self.file("sanitizers");
        let mut arguments = SANITISED.to_vec();
        arguments.extend([text(&probe)?, "-o", text(&target)?]);
        if succeeds("gcc", &arguments) && succeeds(text(&target)?, &[]) {
            return self.host(name, source, library, SANITISED);
        }
        println!("gcc has no address sanitizer here: {source} runs without");
        self.host(name, source, library, &[])
    }

    fn host(&self, name: &str, source: &str, library: &Path, options: &[&str]) -> Result<PathBuf> {
        let program = self.file(name);
        let mut arguments = C99.to_vec();
        arguments.extend_from_slice(STRICT);
        arguments.extend_from_slice(options);
        arguments.extend([source, text(library)?, "-lpthread", "-ldl", "-lm", "-o", text(&program)?]);
        run("gcc", &arguments)?;
        Ok(program)
    }

    /// What arm-none-eabi-gcc is called with.
    pub fn target_arguments(&self, name: &str, source: &str, library: &Path) -> Result<Vec<String>> {
        let (program, map) = (self.file(name), self.map(name));
        let mut arguments = C99.to_vec();
        arguments.extend_from_slice(CORTEX_M4F);
        arguments.extend_from_slice(STRICT);
        arguments.extend(["-nostartfiles", "--specs=rdimon.specs", "-Tfsb-c/examples/netduinoplus2/link.ld"]);
        let linker = format!("-Wl,--gc-sections,-z,noexecstack,-Map={}", text(&map)?);
        arguments.extend([&linker, source, "fsb-c/examples/netduinoplus2/startup.c", text(library)?]);
        arguments.extend(["-lm", "-o", text(&program)?]);
        Ok(arguments.into_iter().map(String::from).collect())
    }

    /// What a program prints; it must succeed. Where it does not, what it printed is shown.
    pub fn run(&self, machine: Machine, program: &Path) -> Result<String> {
        let mut command = match machine {
            Machine::Host => Command::new(program),
            Machine::Target => {
                let mut emulator = Command::new("timeout");
                emulator.args(EMULATOR).arg(program);
                emulator
            }
        };
        let name = program.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let output = command
            .stdin(Stdio::null())
            .stderr(Stdio::inherit())
            .output()
            .with_context(|| format!("cannot start {name} on the {machine}"))?;
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        if !output.status.success() {
            bail!("{name} on the {machine}: {}\n{printed}", output.status);
        }
        Ok(printed)
    }
}

fn text(path: &Path) -> Result<&str> {
    path.to_str().with_context(|| format!("{} is not UTF-8", path.display()))
}
