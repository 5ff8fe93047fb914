//! `budgets.toml`: what a tick may cost on the target.

use std::collections::BTreeMap;
use std::fs;

use anyhow::{Context, Result, bail};
use toml::Table;

use crate::command::root;

const FILE: &str = "budgets.toml";
/// A budget is what was measured and this share more.
const MARGIN: f64 = 0.03;
/// Set to 1, the steps write what they measure, and the budgets that follow from it, into the file.
const REWRITE: &str = "FSB_WRITE_BUDGETS";

/// What was measured, by name, in the order of printing.
pub type Measured = Vec<(String, f64)>;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Budget {
    measured: f64,
    budget: f64,
    goal: Option<f64>,
}

/// Compares with the budgets of `group`; both must name the same things.
pub fn check(group: &str, measured: &Measured) -> Result<()> {
    let path = root()?.join(FILE);
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read {FILE}"))?;
    if std::env::var_os(REWRITE).is_some_and(|value| value == "1") {
        let text = rewritten(&text, group, measured);
        fs::write(&path, &text)?;
        return verdict(&parse(&text, group)?, group, measured);
    }
    verdict(&parse(&text, group)?, group, measured)
}

fn parse(text: &str, group: &str) -> Result<BTreeMap<String, Budget>> {
    let file: Table = text.parse().with_context(|| format!("{FILE} is no TOML"))?;
    let table = file.get(group).and_then(|entry| entry.as_table()).with_context(|| format!("{FILE}: no [{group}]"))?;
    let mut budgets = BTreeMap::new();
    for (name, entry) in table {
        let number = |key: &str| entry.get(key).and_then(|v| v.as_float().or(v.as_integer().map(|i| i as f64)));
        let lacks = |key: &str| format!("{FILE}: {group}.{name} lacks `{key}`");
        let budget = Budget {
            measured: number("measured").with_context(|| lacks("measured"))?,
            budget: number("budget").with_context(|| lacks("budget"))?,
            goal: number("goal"),
        };
        budgets.insert(name.clone(), budget);
    }
    Ok(budgets)
}

fn verdict(budgets: &BTreeMap<String, Budget>, group: &str, measured: &Measured) -> Result<()> {
    let mut complaints = Vec::new();
    println!("{:<46} {:>9} {:>9} {:>9}", group, "measured", "budget", "goal");
    for (name, value) in measured {
        let Some(budget) = budgets.get(name) else {
            complaints.push(format!("{name} = {value}: not in {FILE}"));
            continue;
        };
        let goal = budget
            .goal
            .map_or(String::from("-"), |goal| format!("{goal}{}", if *value <= goal { " ok" } else { " ABOVE" }));
        println!("{name:<46} {value:>9} {:>9} {goal:>9}", budget.budget);
        if value.is_nan() || *value > budget.budget {
            complaints.push(format!("{name}: {value}, budget {}", budget.budget));
        }
        if *value < budget.measured * (1.0 - MARGIN) {
            println!("  {name} was {}: tighten its budget ({REWRITE}=1)", budget.measured);
        }
    }
    for name in budgets.keys().filter(|name| measured.iter().all(|(other, _)| other != *name)) {
        complaints.push(format!("{name} has a budget and was not measured"));
    }
    if !complaints.is_empty() {
        bail!("{}", complaints.join("; "));
    }
    Ok(())
}

/// The file with the entries of `group` as measured, goals and comments kept, entries that are new at the end.
fn rewritten(text: &str, group: &str, measured: &Measured) -> String {
    let mut out = String::new();
    let mut current: Option<f64> = None;
    let mut missing: Vec<&(String, f64)> = measured.iter().collect();
    for line in text.lines() {
        if line.starts_with('[') {
            let header = |name: &str| format!("[{group}.{name}]");
            let found = missing.iter().position(|(name, _)| line.trim() == header(name));
            current = found.map(|index| missing.remove(index).1);
        }
        match (current, line.split_once('=').map(|(key, _)| key.trim())) {
            (Some(value), Some("measured")) => out += &format!("measured = {value:?}\n"),
            (Some(value), Some("budget")) => out += &format!("budget = {:?}\n", with_margin(value)),
            _ => out += &format!("{line}\n"),
        }
    }
    for (name, value) in missing {
        out += &format!("\n[{group}.{name}]\nmeasured = {value:?}\nbudget = {:?}\n", with_margin(*value));
    }
    out
}

fn with_margin(value: f64) -> f64 {
    (value * (1.0 + MARGIN) * 10.0).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# rule\n[a.x]\nmeasured = 100\nbudget = 103.0\ngoal = 90\n[b.y]\nmeasured = 1\nbudget = 2\n";

    fn measured(value: f64) -> Measured {
        vec![("x".into(), value)]
    }

    #[test]
    fn above_the_budget_is_an_error() {
        let budgets = parse(TEXT, "a").unwrap();
        assert!(verdict(&budgets, "a", &measured(103.0)).is_ok());
        assert!(verdict(&budgets, "a", &measured(103.1)).is_err());
        assert!(verdict(&budgets, "a", &measured(f64::NAN)).is_err());
    }

    #[test]
    fn every_name_is_measured_and_budgeted() {
        let budgets = parse(TEXT, "a").unwrap();
        assert!(verdict(&budgets, "a", &vec![]).is_err());
        assert!(verdict(&budgets, "a", &vec![("x".into(), 1.0), ("z".into(), 1.0)]).is_err());
        assert!(parse(TEXT, "c").is_err());
        assert!(parse("[a.x]\nmeasured = 1\n", "a").is_err());
    }

    #[test]
    fn rewriting_keeps_goals_and_others() {
        let text = rewritten(TEXT, "a", &vec![("x".into(), 50.0), ("new".into(), 7.0)]);
        let budgets = parse(&text, "a").unwrap();
        assert_eq!(budgets["x"], Budget { measured: 50.0, budget: 51.5, goal: Some(90.0) });
        assert_eq!(budgets["new"], Budget { measured: 7.0, budget: 7.2, goal: None });
        assert_eq!(parse(&text, "b").unwrap(), parse(TEXT, "b").unwrap());
        assert!(text.starts_with("# rule\n"));
    }

    #[test]
    fn the_committed_file_is_readable() {
        let text = fs::read_to_string(root().unwrap().join(FILE)).unwrap();
        for group in ["c", "cost", "cycles", "kinds", "size"] {
            let budgets = parse(&text, group).unwrap();
            assert!(!budgets.is_empty());
            assert!(budgets.values().all(|budget| budget.budget <= with_margin(budget.measured)));
        }
    }
}
