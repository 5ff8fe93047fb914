//! Which column is what: names of their own, by the names of a file or of the command line.
//!
//! | role | default header | |
//! |---|---|---|
//! | `motion.t` | `t` | time of the motion file \[s\] |
//! | `x` `y` `z` | the same | position \[m\], world frame, z up |
//! | `qw` `qx` `qy` `qz` | the same | attitude, body to world |
//! | `vx_ref` `vy_ref` `vz_ref` | the same | optional velocity to compare with \[m/s\] |
//! | `input.t` | `t` | time of the input file \[s\] |
//! | `thrust` | `thrust_N` | thrust along body z \[N\] |
//! | `fx_body` `fy_body` `fz_body` | none | force in the body frame \[N\], in place of `thrust` |

use crate::replay::flight::FlightError;
use std::path::Path;

/// The header of each role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    headers: Vec<(&'static str, Option<String>)>,
}

/// Role and default header.
const ROLES: [(&str, Option<&str>); 16] = [
    ("motion.t", Some("t")),
    ("x", Some("x")),
    ("y", Some("y")),
    ("z", Some("z")),
    ("qw", Some("qw")),
    ("qx", Some("qx")),
    ("qy", Some("qy")),
    ("qz", Some("qz")),
    ("vx_ref", Some("vx_ref")),
    ("vy_ref", Some("vy_ref")),
    ("vz_ref", Some("vz_ref")),
    ("input.t", Some("t")),
    ("thrust", Some("thrust_N")),
    ("fx_body", None),
    ("fy_body", None),
    ("fz_body", None),
];

impl Default for Columns {
    fn default() -> Self {
        Self { headers: ROLES.map(|(role, header)| (role, header.map(str::to_owned))).into() }
    }
}

impl Columns {
    /// The header of `role`, if it has one.
    pub(super) fn header(&self, role: &str) -> Option<&str> {
        self.headers.iter().find(|(name, _)| *name == role).and_then(|(_, header)| header.as_deref())
    }

    /// Names the column of a role, `place` standing for where that was said.
    ///
    /// # Errors
    /// No such role.
    pub fn name(&mut self, place: &str, role: &str, header: &str) -> Result<(), FlightError> {
        let Some(entry) = self.headers.iter_mut().find(|(name, _)| *name == role) else {
            let roles: Vec<&str> = ROLES.iter().map(|(role, _)| *role).collect();
            let what = format!("there is no `{role}` to name; expected one of {}", roles.join(", "));
            return Err(FlightError::Columns { place: place.to_owned(), what });
        };
        entry.1 = Some(header.to_owned());
        Ok(())
    }

    /// Takes `ROLE=HEADER`.
    ///
    /// # Errors
    /// It is not of that form, or there is no such role.
    pub fn name_by(&mut self, option: &str, text: &str) -> Result<(), FlightError> {
        match text.split_once('=') {
            Some((role, header)) if !header.is_empty() => self.name(option, role.trim(), header.trim()),
            _ => Err(FlightError::Columns {
                place: option.to_owned(),
                what: format!("found `{text}`, expected ROLE=HEADER such as thrust=thrust_N"),
            }),
        }
    }

    /// Takes the names of a TOML file: `x = "pos_x"` and so on, and `t` in the tables `[motion]` and `[input]`.
    ///
    /// # Errors
    /// The file cannot be read, is no TOML, or names a role that does not exist.
    pub fn read(&mut self, path: &Path) -> Result<(), FlightError> {
        let file = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|source| match source.kind() {
            std::io::ErrorKind::NotFound => {
                FlightError::NotFound { file: file.clone(), expected: "a TOML file of column names" }
            }
            _ => FlightError::NotReadable { file: file.clone(), source },
        })?;
        let refuse = |what: String| FlightError::Columns { place: file.clone(), what };
        let table: toml::Table = text.parse().map_err(|error: toml::de::Error| refuse(error.to_string()))?;
        self.take(&file, "", &table)
    }

    fn take(&mut self, file: &str, prefix: &str, table: &toml::Table) -> Result<(), FlightError> {
        for (key, value) in table {
            match value {
                toml::Value::Table(inner) if prefix.is_empty() && ["motion", "input"].contains(&key.as_str()) => {
                    self.take(file, key, inner)?;
                }
                toml::Value::String(header) => {
                    let whole = format!("{prefix}.{key}");
                    let role = if ROLES.iter().any(|(role, _)| *role == whole) { &whole } else { key };
                    self.name(file, role, header)?;
                }
                other => {
                    let what = format!(
                        "{key}: found a value of type {other}, expected the name of a column in quotation marks",
                        other = other.type_str()
                    );
                    return Err(FlightError::Columns { place: file.to_owned(), what });
                }
            }
        }
        Ok(())
    }
}
