//! What a tick's code cannot do, because there is no instruction for it: the call graph of the tick, disassembled.

use anyhow::{Result, bail};

use super::listing::{Function, Listing};
use super::programs::TARGET_TESTS;
use super::size::TICK;

/// The axis alone.
const ONE: &[&str] = &["one_measure", "one_apply"];
/// The control loop's tick, motors and pin included.
const LOOP: &[&str] = &["loop_tick"];
/// The vehicle's estimator, a program of its own.
const VEHICLE: &[&str] = &["vehicle_update", "vehicle_state"];
/// The regression with drag, in the same.
const DRAG: &[&str] = &["drag_measure", "drag_apply", "drag_states"];
/// A function that calls what a tick must not, to show that it is seen.
const CULPRITS: &[(&str, &str)] = &[
    ("culprit_expf", "transcendental"),
    ("culprit_f64", "soft float"),
    ("culprit_allocates", "allocation"),
    ("culprit_recursive", "recursion"),
    ("culprit_indirect", "indirect"),
    ("culprit_panics", "panic"),
];

/// Checks the tick, and that every rule is broken by the program that is written to break it.
pub fn run() -> Result<()> {
    let listing = Listing::of(&TARGET_TESTS.build("tick")?)?;
    let mut complaints = Vec::new();
    let vehicle = Listing::of(&TARGET_TESTS.build("vehicle")?)?;
    for (name, roots, listing) in [
        ("six axes", TICK, &listing),
        ("one axis", ONE, &listing),
        ("control loop", LOOP, &listing),
        ("vehicle", VEHICLE, &vehicle),
        ("regression with drag", DRAG, &vehicle),
    ] {
        let functions = listing.reachable(roots)?;
        let instructions: usize =
            functions.iter().filter_map(|f| listing.functions.get(f)).map(|f| f.instructions.len()).sum();
        println!("{name}: {} functions, {instructions} instructions", functions.len());
        for line in copies(listing, &functions) {
            println!("  {line}");
        }
        complaints.extend(check(listing, roots)?);
    }
    if !complaints.is_empty() {
        bail!("in the tick: {}", complaints.iter().map(|complaint| short(complaint)).collect::<Vec<_>>().join("; "));
    }
    println!("no allocation, transcendental, soft float, recursion, indirect call or panic in any of them");
    let culprits = Listing::of(&TARGET_TESTS.build("culprits")?)?;
    for (culprit, rule) in CULPRITS {
        let complaints = check(&culprits, &[culprit])?;
        let Some(caught) = complaints.iter().find(|complaint| complaint.starts_with(rule)) else {
            bail!("{culprit} breaks the rule `{rule}` and was not caught: {complaints:?}");
        };
        println!("{culprit} is caught: {}", short(caught));
    }
    Ok(())
}

/// Everything that is wrong with what can be reached from `roots`.
fn check(listing: &Listing, roots: &[&str]) -> Result<Vec<String>> {
    let functions = listing.reachable(roots)?;
    let mut complaints = Vec::new();
    for address in &functions {
        let Some(function) = listing.functions.get(address) else { continue };
        complaints.extend(name_rule(&function.name).map(|rule| format!("{rule}: {} is called", function.name)));
        complaints.extend(inlined(function));
        for instruction in function.instructions.iter().filter(|instruction| instruction.is_indirect()) {
            let what = format!("{} {}", instruction.mnemonic, instruction.operands);
            complaints.push(format!("indirect call: {what} in {}", function.name));
        }
        if reaches(listing, *address) {
            complaints.push(format!("recursion: {} can come back to itself", function.name));
        }
    }
    Ok(complaints)
}

/// The rule that a function of this name breaks by being called.
fn name_rule(name: &str) -> Option<&'static str> {
    let any = |parts: &[&str]| parts.iter().any(|part| name.contains(part));
    let copies = ["__aeabi_memcpy", "__aeabi_memmove", "__aeabi_memset", "__aeabi_memclr"];
    if any(&["__rust_alloc", "__rust_realloc", "__rustc::__r", "malloc", "alloc::", "GlobalAlloc"]) {
        Some("allocation")
    } else if any(&["panicking", "panic_fmt", "unwrap_failed", "expect_failed"]) {
        Some("panic")
    } else if any(&["compiler_builtins::float", "__addsf", "__adddf", "__muldf", "__mulsf", "__divdf", "__divsf"])
        || (name.starts_with("__aeabi_") && !copies.iter().any(|copy| name.starts_with(copy)))
    {
        Some("soft float")
    } else if any(&["libm::", "micromath::", "compiler_builtins::math"])
        || ["expf", "logf", "powf", "sinf", "cosf", "exp", "log", "pow", "sin", "cos", "sqrt", "sqrtf"].contains(&name)
    {
        Some("transcendental")
    } else {
        None
    }
}

/// Without the folders in front of a crate's.
fn short(complaint: &str) -> String {
    let words = complaint
        .split(' ')
        .map(|word| if word.starts_with('/') { word.rsplit('/').next().unwrap_or(word) } else { word });
    words.collect::<Vec<_>>().join(" ")
}

/// Code from a forbidden source file that was inlined, so that no call tells of it.
fn inlined(function: &Function) -> Option<String> {
    function.instructions.iter().find_map(|instruction| {
        let source = instruction.source.as_deref()?;
        let of = |part: &str| source.contains(part);
        let rule = if of("/libm-") || of("/micromath-") || of("/libm/src/math") {
            "transcendental"
        } else if of("library/alloc/src") {
            "allocation"
        } else {
            return None;
        };
        Some(format!("{rule}: code of {source} in {}", function.name))
    })
}

/// Whether a function can be reached from itself.
fn reaches(listing: &Listing, function: u32) -> bool {
    let (mut seen, mut open) = (Vec::new(), listing.callees(function));
    while let Some(next) = open.pop() {
        if next == function {
            return true;
        }
        if !seen.contains(&next) {
            seen.push(next);
            open.extend(listing.callees(next));
        }
    }
    false
}

/// Calls that copy or clear memory, with the length where it is a constant right before the call.
fn copies(listing: &Listing, functions: &[u32]) -> Vec<String> {
    let mut lines = Vec::new();
    for function in functions.iter().filter_map(|address| listing.functions.get(address)) {
        for (index, instruction) in function.instructions.iter().enumerate() {
            let callee = instruction.target().and_then(|target| listing.functions.get(&target));
            let Some(callee) = callee.filter(|callee| callee.name.contains("mem") && callee.name != function.name)
            else {
                continue;
            };
            let before = function.instructions[..index].iter().rev().take(8);
            let length = before.clone().find_map(|instruction| instruction.operands.strip_prefix("r2, #"));
            lines.push(format!("{} of {} bytes in {}", callee.name, length.unwrap_or("?"), function.name));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::super::listing::parsed;
    use super::*;

    #[test]
    fn names() {
        assert_eq!(name_rule("__aeabi_fadd"), Some("soft float"));
        assert_eq!(name_rule("compiler_builtins::float::add::__adddf3"), Some("soft float"));
        assert_eq!(name_rule("libm::math::expf::expf"), Some("transcendental"));
        assert_eq!(name_rule("core::panicking::panic_bounds_check"), Some("panic"));
        assert_eq!(name_rule("alloc::alloc::exchange_malloc"), Some("allocation"));
        assert_eq!(name_rule("__aeabi_memcpy4"), None);
        assert_eq!(name_rule("fsb_firmware::allocation::Allocation::thrusts"), None);
        assert_eq!(name_rule("<fsb_core::estimator::Estimator<_,_>>::advance"), None);
    }

    #[test]
    fn recursion_over_two_functions_and_inlined_code() {
        let text = "
08000100 <a>:
/x/libm-0.2.16/src/math/expf.rs:12
 8000100:\tbl\t8000110 <b>
08000110 <b>:
 8000110:\tb.w\t8000100 <a>
";
        let complaints = check(&parsed(text), &["a"]).unwrap();
        assert!(complaints.iter().any(|complaint| complaint.starts_with("recursion")), "{complaints:?}");
        assert!(complaints.iter().any(|complaint| complaint.starts_with("transcendental")), "{complaints:?}");
        assert!(check(&parsed(text), &["c"]).is_err());
    }
}
