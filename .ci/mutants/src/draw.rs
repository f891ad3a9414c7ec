//! Which changes are tried.

use std::process::Command;

use crate::{Failure, Mutant};

/// All that cargo-mutants proposes for a crate, without what `.cargo/mutants.toml` leaves out.
///
/// # Errors
///
/// Where cargo-mutants fails or is not there.
pub fn listed(krate: &str) -> Result<Vec<Mutant>, Failure> {
    let output =
        Command::new("cargo").args(["mutants", "--list", "--json", "-p", krate]).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// `count` of them at random, the same for the same seed.
pub fn drawn(all: &[Mutant], count: usize, seed: u64) -> Vec<Mutant> {
    let mut left: Vec<&Mutant> = all.iter().collect();
    let mut state = seed;
    let count = count.min(left.len());
    for k in 0..count {
        let other = k + (next(&mut state) % (left.len() - k) as u64) as usize;
        left.swap(k, other);
    }
    left.truncate(count);
    left.into_iter().cloned().collect()
}

/// SplitMix64 (Steele, Lea and Flood 2014).
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Those that the rows of a result's table name. Where the code has moved it is the one with the same text in the same
/// file whose column, then whose line is nearest.
pub fn named(all: &[Mutant], result: &str) -> Vec<Mutant> {
    let mut found: Vec<&Mutant> = Vec::new();
    for row in result.lines().filter_map(|line| line.strip_prefix("| `")) {
        let Some((cell, _)) = row.split_once("` |") else { continue };
        let cell = cell.replace("\\|", "|");
        let Some((file, place, text)) = parts(&cell) else { continue };
        let nearest = all
            .iter()
            .filter(|mutant| {
                parts(&mutant.name)
                    .is_some_and(|(path, _, other)| path.ends_with(file) && other == text)
            })
            .min_by_key(|mutant| {
                let start = mutant.span.start;
                (start.column.abs_diff(place.1), start.line.abs_diff(place.0))
            });
        match nearest {
            Some(mutant) if !found.iter().any(|other| other.name == mutant.name) => {
                found.push(mutant);
            }
            Some(_) => eprintln!("twice: {cell}"),
            None => eprintln!("gone: {cell}"),
        }
    }
    found.into_iter().cloned().collect()
}

/// `file:line:column: text`.
fn parts(name: &str) -> Option<(&str, (usize, usize), &str)> {
    let (place, text) = name.split_once(": ")?;
    let mut parts = place.split(':');
    let file = parts.next()?;
    Some((file, (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?), text))
}

/// With ids from 1.
pub fn numbered(mutants: Vec<Mutant>) -> Vec<Mutant> {
    let numbers = 1..;
    mutants.into_iter().zip(numbers).map(|(mutant, id)| Mutant { id, ..mutant }).collect()
}
