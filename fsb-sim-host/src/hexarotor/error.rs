//! A parameter that cannot be right.

use thiserror::Error;

/// Which parameter, what it was given, and what it needs. Names are those of the configuration, dots between the levels.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{name} = {value}: {needs}")]
pub struct ParameterError {
    /// As in the configuration: `rotor.thrust_max`.
    pub name: String,
    /// What was given, as it would be written.
    pub value: String,
    /// What is wanted.
    pub needs: &'static str,
}

impl ParameterError {
    /// An error of the parameter `name`.
    pub fn new(name: &str, value: impl std::fmt::Debug, needs: &'static str) -> Self {
        Self { name: name.to_owned(), value: format!("{value:?}"), needs }
    }

    /// The same, of a parameter that lies in `group`: `mass` within `plant` is `plant.mass`.
    #[must_use]
    pub fn within(self, group: &str) -> Self {
        Self { name: format!("{group}.{}", self.name), ..self }
    }
}

/// Whether `value` lies in `range`; a NaN does not.
pub(crate) fn check(
    name: &str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    needs: &'static str,
) -> Result<(), ParameterError> {
    if range.contains(&value) { Ok(()) } else { Err(ParameterError::new(name, value, needs)) }
}

/// Whether all three lie in `range`.
pub(crate) fn check_each(
    name: &str,
    values: [f64; 3],
    range: std::ops::RangeInclusive<f64>,
    needs: &'static str,
) -> Result<(), ParameterError> {
    if values.iter().all(|value| range.contains(value)) {
        Ok(())
    } else {
        Err(ParameterError::new(name, values, needs))
    }
}
