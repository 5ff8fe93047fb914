//! Building the programs of `target-tests` and its neighbours.

use std::path::PathBuf;

use anyhow::Result;

use crate::command::{root, run};
use crate::setup;

/// The target with an FPU: the one that is measured.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// A package outside the workspace, and where its build goes.
#[derive(Clone, Copy, Debug)]
pub struct Package {
    /// The folder of its manifest, from the root.
    pub folder: &'static str,
}

/// The programs that prove and measure.
pub const TARGET_TESTS: Package = Package { folder: "target-tests" };
/// The crates that others use for the same purpose.
pub const PEERS: Package = Package { folder: "target-tests/peers" };
/// An RTIC task.
pub const RTIC: Package = Package { folder: "examples/rtic" };
/// An Embassy task.
pub const EMBASSY: Package = Package { folder: "examples/embassy" };

/// All packages that are no members of the workspace.
pub const OUTSIDE: &[Package] = &[TARGET_TESTS, PEERS, RTIC, EMBASSY];

impl Package {
    /// The manifest, from the root.
    pub fn manifest(self) -> String {
        format!("{}/Cargo.toml", self.folder)
    }

    /// Where cargo puts what it builds, from the root.
    pub fn target_folder(self) -> String {
        format!("target/{}", self.folder.replace('/', "-"))
    }

    /// The arguments of a release build for the microcontroller, to which a binary or features may be added.
    pub fn build_arguments(self) -> Vec<String> {
        ["build", "--release", "--locked", "--manifest-path", &self.manifest(), "--target-dir", &self.target_folder()]
            .into_iter()
            .chain(["--target", TARGET])
            .map(String::from)
            .collect()
    }

    /// Builds one binary for the microcontroller; its path.
    pub fn build(self, binary: &str) -> Result<PathBuf> {
        setup::rust_targets()?;
        let arguments = self.build_arguments();
        let mut arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        arguments.extend(["--bin", binary]);
        run("cargo", &arguments)?;
        Ok(root()?.join(self.target_folder()).join(TARGET).join("release").join(binary))
    }
}
