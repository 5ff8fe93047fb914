//! From a name or a file to a scenario, entries overridden by hand.

use std::fs;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::error::LoadError;
use super::scenario::Scenario;

/// The built-in scenarios in order of the list, each the text of its file.
const BUILT_IN: [&str; 12] = [
    include_str!("../../scenarios/spiral.toml"),
    include_str!("../../scenarios/aggressive.toml"),
    include_str!("../../scenarios/hover.toml"),
    include_str!("../../scenarios/payload-pickup.toml"),
    include_str!("../../scenarios/payload-drop.toml"),
    include_str!("../../scenarios/wind.toml"),
    include_str!("../../scenarios/slow-position.toml"),
    include_str!("../../scenarios/latency.toml"),
    include_str!("../../scenarios/dropouts.toml"),
    include_str!("../../scenarios/outliers.toml"),
    include_str!("../../scenarios/bit-faults.toml"),
    include_str!("../../scenarios/random.toml"),
];

/// Names and descriptions of the built-in scenarios.
pub fn list() -> Vec<(String, String)> {
    let built_in = BUILT_IN.iter().filter_map(|text| toml::from_str::<Scenario>(text).ok());
    built_in.map(|scenario| (scenario.name, scenario.description)).collect()
}

/// The scenario of a built-in name, else of a file, with `overrides` of the form `plant.mass=3.1` applied in order, checked.
/// Keys are those of the file, levels parted by dots, elements of a list by their number from 0; values are written as in
/// TOML, words without quotes.
///
/// # Errors
/// [`LoadError`], naming file and key.
pub fn load(name: &str, overrides: &[String]) -> Result<Scenario, LoadError> {
    let (file, text) = text_of(name)?;
    parse(name, &file, &text, overrides)
}

/// The same of the `text` of a `file`.
///
/// # Errors
/// As [`load`].
pub fn parse(name: &str, file: &Path, text: &str, overrides: &[String]) -> Result<Scenario, LoadError> {
    let wrong = |error: toml::de::Error| LoadError::Toml { file: file.into(), message: error.to_string() };
    // The file on its own first: its errors come with line and column.
    let mut scenario: Scenario = toml::from_str(text).map_err(wrong)?;
    for given in overrides {
        let wrong = |message: String| LoadError::Set { given: given.clone(), message };
        // With every default in it, so that an element of a list the file leaves out can be set too.
        let mut table = Table::try_from(&scenario).map_err(|error| wrong(error.to_string()))?;
        set(&mut table, given).map_err(wrong)?;
        scenario = table.try_into().map_err(|error: toml::de::Error| wrong(one_line(&error.to_string())))?;
    }
    scenario.check().map_err(|refused| LoadError::Refused { name: name.to_owned(), refused })?;
    Ok(scenario)
}

fn text_of(name: &str) -> Result<(PathBuf, String), LoadError> {
    let first_line = format!("name = \"{name}\"");
    if let Some(text) = BUILT_IN.iter().find(|text| text.lines().next() == Some(first_line.as_str())) {
        return Ok((PathBuf::from(format!("{name}.toml")), (*text).to_owned()));
    }
    match fs::read_to_string(name) {
        Ok(text) => Ok((PathBuf::from(name), text)),
        Err(cause) => Err(LoadError::NotThere { name: name.to_owned(), cause }),
    }
}

/// Puts the value of `KEY=VALUE` into `table`.
fn set(table: &mut Table, given: &str) -> Result<(), String> {
    let (key, text) = given.split_once('=').ok_or("is not of the form KEY=VALUE")?;
    let levels: Vec<&str> = key.trim().split('.').collect();
    let [first, rest @ ..] = levels.as_slice() else { return Err("has no key".to_owned()) };
    if levels.iter().any(|level| level.is_empty()) {
        return Err("has no key".to_owned());
    }
    put(table.entry(*first).or_insert_with(empty), rest, value_of(text.trim()))
}

fn put(at: &mut Value, levels: &[&str], value: Value) -> Result<(), String> {
    let [level, rest @ ..] = levels else {
        *at = value;
        return Ok(());
    };
    match at {
        Value::Table(table) => put(table.entry(*level).or_insert_with(empty), rest, value),
        Value::Array(list) => {
            let element = level.parse().ok().and_then(|index: usize| list.get_mut(index));
            put(element.ok_or_else(|| format!("the list has no element {level}"))?, rest, value)
        }
        _ => Err(format!("what {level} should be part of is a single value")),
    }
}

fn empty() -> Value {
    Value::Table(Table::new())
}

/// A value as in TOML; what is none is a word.
fn value_of(text: &str) -> Value {
    let line = format!("value = {text}");
    let parsed = if text.contains('\n') { None } else { toml::from_str::<Table>(&line).ok() };
    parsed.and_then(|mut table| table.remove("value")).unwrap_or_else(|| Value::String(text.to_owned()))
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(overrides: &[&str]) -> Result<Scenario, String> {
        load("hover", &overrides.iter().map(|&o| o.to_owned()).collect::<Vec<_>>()).map_err(|error| error.to_string())
    }

    /// Every built-in file parses, is sound, and is found by the name it gives itself.
    #[test]
    fn built_in_scenarios_are_sound() {
        let names: Vec<String> = list().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names.len(), BUILT_IN.len());
        for name in &names {
            let scenario = load(name, &[]).unwrap();
            assert_eq!(&scenario.name, name);
            assert!(scenario.description.len() > 40, "{name}");
        }
    }

    /// So is the one in the README.
    #[test]
    fn the_example_of_the_readme_is_a_scenario() {
        let readme = include_str!("../../README.md");
        let text = readme.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
        let scenario: Scenario = toml::from_str(text).unwrap();
        assert_eq!(scenario.check(), Ok(()));
    }

    #[test]
    fn entries_are_overridden() {
        let plain = with(&[]).unwrap();
        let changed =
            with(&["plant.mass=3.1", "plant.drag.linear=[1, 2, 3]", "sensors.position.gaps = [[1.0, 2]]"]).unwrap();
        assert_eq!((changed.plant.mass, changed.plant.drag.linear), (3.1, [1.0, 2.0, 3.0]));
        assert_eq!(changed.sensors.position.gaps, [[1.0, 2.0]]);
        assert_eq!((changed.duration, changed.estimator), (plain.duration, plain.estimator));
        let path =
            with(&["reference.position={ kind = \"hover\", at = [1, 2, 3] }", "reference.position.at.2=7"]).unwrap();
        assert_eq!(path.reference.position.at(0.0).value, [1.0, 2.0, 7.0]);
        assert_eq!(with(&["name=elsewhere"]).unwrap().name, "elsewhere");
    }

    #[test]
    fn wrong_overrides_are_named() {
        for (given, part) in [
            ("plant.mas=3", "unknown field `mas`"),
            ("wings=2", "unknown field `wings`"),
            ("plant.mass=heavy", "invalid type"),
            ("plant.mass=[1]", "invalid type"),
            ("plant.mass.of=1", "single value"),
            ("plant.inertia.3=1", "no element 3"),
            ("plant.mass", "KEY=VALUE"),
            ("=1", "no key"),
            ("plant.=1", "no key"),
            ("plant.mass=-1", "plant.mass = -1.0: must be"),
            ("plant.mass=nan", "plant.mass = NaN: must be"),
            ("duration=0", "duration = 0.0"),
            ("rate=1e9", "rate = "),
            ("estimator.translation.lambda=-1", "estimator.translation.lambda must be positive"),
            ("estimator.rotation.observer_q=1e9", "estimator.rotation.observer_q times the period"),
            ("estimator.rotation.fade=0", "estimator.rotation.fade must be positive"),
            ("estimator.translation.latency=-1", "estimator.translation.latency = -1.0: must be from 0 to 60 s"),
            ("estimator.rotation.latency=nan", "estimator.rotation.latency = NaN: must be"),
            ("estimator.rotation.latency=0.1", "an attitude that is 20 control periods late, and a position that is 0"),
            (
                "random.mass=[0, 1]",
                "random.mass = [0.0, 1.0]: must be a range [from, to], in order, from 0.001 to 1000",
            ),
            ("random.dropout=[0, 1.1]", "random.dropout = [0.0, 1.1]: must be a range"),
            (
                "random.position_latency=[0, 1.3]",
                "random.position_latency = [0.0, 1.3]: at 1.3, estimator: a latency of 260 control periods; up to 256 can",
            ),
            ("control.rotation.kp=0", "control.rotation.kp must be positive"),
            ("reference.position.kind=loop", "loop"),
        ] {
            let message = with(&[given]).unwrap_err();
            assert!(message.contains(part), "{given}: {message}");
        }
    }

    /// What is drawn around a first guess needs one; and the rotors may be as strong as is documented.
    #[test]
    fn what_hangs_together_is_checked_together() {
        let blind = BUILT_IN[2].replace("mass = { nominal = 2.0, ", "mass = { ");
        assert_ne!(blind, BUILT_IN[2]);
        let of = |set: &[&str]| {
            let set: Vec<String> = set.iter().map(|&set| set.to_owned()).collect();
            parse("blind", Path::new("blind.toml"), &blind, &set).map_err(|error| error.to_string())
        };
        assert!(of(&[]).is_ok());
        assert!(of(&["random.mass=[1, 2]"]).unwrap_err().contains("needs a first guess, estimator.mass.nominal"));
        assert!(with(&["plant.rotor.thrust_max=1e5", "plant.frame.arm=100"]).is_ok());
    }

    /// A range is refused for what its ends would be, before anything is drawn; one that can be flown is not.
    #[test]
    fn what_may_be_drawn_is_checked_beforehand() {
        for (set, part) in [
            (
                ["estimator.mass.nominal=0.6", "random.mass=[1e-3, 1]"],
                "random.mass = [0.001, 1.0]: at 0.001, plant.mass",
            ),
            (
                ["estimator.inertia.nominal.0=50", "random.inertia=[1, 1e3]"],
                "random.inertia = [1.0, 1000.0]: at 1000, plant.inertia",
            ),
            (
                ["random.position_latency=[0.1, 0.2]", "estimator.rotation.latency=0.15"],
                "an attitude that is 30 control periods late, and a position that is 0",
            ),
            (
                [
                    "estimator.translation.latency=0.02",
                    "random={ position_latency = [0, 0.1], attitude_latency = [0, 0.1] }",
                ],
                "random.attitude_latency = [0.0, 0.1]: at 0.1, estimator: an attitude that is 20 control periods late",
            ),
            (
                ["sensors.position.latency_jitter=59", "random={ position_latency = [0, 1.2] }"],
                "random.position_latency = [0.0, 1.2]: at 1.2, sensors.position.latency_jitter",
            ),
        ] {
            let message = with(&set).unwrap_err();
            assert!(message.contains(part), "{set:?}: {message}");
        }
        for set in [
            ["random.position_latency=[0, 1.28]", "random.attitude_latency=[0, 60]"],
            ["random.position_latency=[0, 60]", "estimator.translation.latency=0"],
            ["random.mass=[0.5, 2]", "random.inertia=[0.5, 2]"],
        ] {
            assert_eq!(with(&set).map(|_| ()), Ok(()), "{set:?}");
        }
    }

    #[test]
    fn wrong_files_are_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.toml");
        let name = path.to_str().unwrap();
        assert!(load(name, &[]).unwrap_err().to_string().contains("neither a built-in"));
        let good = BUILT_IN[2];
        for (text, part) in [
            (good.replace("[plant]", "[plant]\nmas = 2.0"), "unknown field `mas`"),
            (good.replace("duration", "durat"), "durat"),
            (good.replace("duration = ", "duration = \"long\" #"), "duration"),
            ("name = [".to_owned(), "line 1"),
            (String::new(), "missing field"),
        ] {
            fs::write(&path, text).unwrap();
            let message = load(name, &[]).unwrap_err().to_string();
            assert!(message.contains("mine.toml") && message.contains(part), "{part}: {message}");
        }
    }
}
