//! What the library adds to a program, by the linker's map.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::on_target::budgets;

/// Where the microcontroller has flash and RAM; what else the map lists (debug information) stays on the disk.
const MEMORY: &[std::ops::Range<u64>] = &[0x0800_0000..0x0810_0000, 0x2000_0000..0x2002_0000];

/// Compares the bytes of flash and RAM that the flight of the example takes from libfsb.a with `budgets.toml`.
pub fn check(map: &Path) -> Result<()> {
    let text = fs::read_to_string(map).with_context(|| format!("cannot read {}", map.display()))?;
    let sections = of_library(&text);
    let total: u64 = sections.values().sum();
    let mut largest: Vec<_> = sections.iter().map(|(name, size)| (*size, name)).collect();
    largest.sort_unstable_by(|a, b| b.cmp(a));
    println!("libfsb.a takes {total} bytes of fly.elf; the largest parts:");
    for (size, name) in largest.iter().take(12) {
        println!("{size:8}  {name}");
    }
    if total == 0 {
        bail!("the map names nothing of libfsb.a");
    }
    budgets::check("c", &vec![("bytes_of_library".into(), total as f64)])
}

/// Input sections of libfsb.a that are in the microcontroller's memory, and their sizes.
fn of_library(map: &str) -> BTreeMap<String, u64> {
    let listing = map.split_once("Linker script and memory map").map_or("", |(_, listing)| listing);
    let mut found = BTreeMap::new();
    let mut section = "";
    for line in listing.lines() {
        // " .text.name  0xaddress  0xsize  file", or the name on a line of its own where it is long.
        let mut words: Vec<&str> = line.split_whitespace().collect();
        if line.starts_with(" .") {
            section = words.remove(0);
        }
        if let [address, size, file, ..] = words[..]
            && let (Some(address), Some(size)) = (hexadecimal(address), hexadecimal(size))
            && file.contains("libfsb.a")
            && MEMORY.iter().any(|memory| memory.contains(&address))
        {
            *found.entry(section.to_string()).or_default() += size;
        }
    }
    found
}

fn hexadecimal(word: &str) -> Option<u64> {
    u64::from_str_radix(word.strip_prefix("0x")?, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_of_the_library_in_memory_are_counted() {
        let map = "Discarded input sections\n\n .text.gone 0x08000000 0x99 a/libfsb.a(x.o)\n\
            Linker script and memory map\n\n\
            \x20.text.main     0x08000100       0x10 main.o\n\
            \x20.text.fsb_a    0x08000110       0x20 a/libfsb.a(x.o)\n\
            \x20.text.a_long_name_of_a_function\n\
            \x20               0x08000130        0x8 a/libfsb.a(x.o)\n\
            \x20*fill*         0x08000138        0x2\n\
            \x20.text.fsb_a    0x08000140        0x1 a/libfsb.a(y.o)\n\
            \x20.debug_info    0x00000000      0x900 a/libfsb.a(x.o)\n";
        let found = of_library(map);
        assert_eq!(found.values().sum::<u64>(), 0x29);
        assert_eq!(found[".text.fsb_a"], 0x21);
        assert_eq!(found[".text.a_long_name_of_a_function"], 8);
    }
}
