//! The numbers in the documentation: what the commands of `fsb` print, between `<!-- numbers:NAME -->` and
//! `<!-- /numbers -->`, and the examples, which are copies of ones that are compiled elsewhere.
//!
//! | file | what |
//! |---|---|
//! | `blocks` | finding and replacing what stands between the marks |
//! | `budgets` | what a tick costs on the target |
//! | `compare` | the same, or the same but for the last digit |
//! | `examples` | the programs shown |
//! | `faults` | bad input and faults |
//! | `figure` | the figure shown |
//! | `fly` | simulated flights |
//! | `flights` | recorded flights, where there are any |
//! | `links` | files that a document refers to |
//! | `measured` | what the commands say |
//! | `tables` | that, as tables |

mod blocks;
mod budgets;
mod compare;
mod examples;
mod faults;
mod figure;
mod flights;
mod fly;
mod links;
mod measured;
mod tables;

use std::fs;

use anyhow::{Context, Result, bail};

use crate::command::root;
use blocks::Block;
use compare::{Tolerance, same};
use measured::Measured;

/// The documents that hold blocks.
const DOCUMENTS: &[&str] = &["README.md", "fsb-core/README.md", "docs/design.md", "docs/robustness.md"];

/// Compares every block with what the commands print now; with `--write` on the command line it is written instead.
pub fn run() -> Result<()> {
    let write = std::env::args().any(|argument| argument == "--write");
    let measured = Measured::now()?;
    let lost = links::check()?;
    let mut complaints = Vec::new();
    for document in DOCUMENTS {
        let path = root()?.join(document);
        let text = fs::read_to_string(&path).with_context(|| format!("cannot read {document}"))?;
        let mut fresh = text.clone();
        for block in blocks::find(&text).with_context(|| document.to_string())? {
            let Some((content, tolerance)) = content(&block, &measured)? else {
                println!("{document}: {} is kept as it is", block.name);
                continue;
            };
            if let Some(difference) = same(&block.content, &content, tolerance) {
                complaints.push(format!("{document}: {}\n{difference}", block.name));
                fresh = blocks::replace(&fresh, &block.name, &content);
            }
        }
        if write && fresh != text {
            fs::write(&path, fresh).with_context(|| format!("cannot write {document}"))?;
            println!("{document}: written");
        }
    }
    complaints.extend(figure::update(&measured.figure, write)?);
    for complaint in lost.iter().chain(&complaints) {
        println!("{complaint}");
    }
    if !lost.is_empty() {
        bail!("{} links to nowhere", lost.len());
    }
    if !write && !complaints.is_empty() {
        bail!("{} differences; after a look at them: cargo xtask numbers --write", complaints.len());
    }
    Ok(())
}

/// What a block should hold; `None` where that cannot be told on this machine.
fn content(block: &Block, measured: &Measured) -> Result<Option<(String, Tolerance)>> {
    Ok(match block.name.as_str() {
        "table1" => Some((tables::table1(&measured.paper)?, Tolerance::LastDigit)),
        "loop" => Some((tables::closed_loop(&measured.paper)?, Tolerance::LastDigit)),
        "efficiency" => Some((tables::efficiency(&measured.efficiency)?, Tolerance::LastDigit)),
        "exactness" => Some((tables::exactness(&measured.exactness, &|_| true)?, Tolerance::None)),
        "exactness-short" => Some((tables::exactness(&measured.exactness, &tables::in_short)?, Tolerance::None)),
        "recovery" => Some((faults::recovery(&measured.faults["bad_measurements"])?, Tolerance::LastDigit)),
        "recovery-inputs" => Some((faults::recovery(&measured.faults["bad_inputs"])?, Tolerance::LastDigit)),
        "bursts" => Some((faults::bursts(&measured.faults["bursts"])?, Tolerance::LastDigit)),
        "jitter" => Some((faults::jitter(&measured.faults["jitter"])?, Tolerance::LastDigit)),
        "cost" => Some((budgets::table()?, Tolerance::None)),
        "kinds" => Some((budgets::kinds()?, Tolerance::None)),
        "fly" => Some((fly::scenarios()?, Tolerance::LastDigit)),
        "fly-random" => Some((fly::random()?, Tolerance::LastDigit)),
        "drag" => flights::drag()?.map(|table| (table, Tolerance::LastDigit)),
        "flights" => flights::table()?.map(|table| (table, Tolerance::LastDigit)),
        "example-rust" => Some((examples::rust()?, Tolerance::None)),
        "example-c" => examples::c()?.map(|example| (example, Tolerance::None)),
        other => bail!("nobody knows the numbers `{other}`"),
    })
}
