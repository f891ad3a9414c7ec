//! The bounds of undecided boxes, proved again from the chain and the listed equilibria.

use rayon::prelude::*;

use crate::census::Census;
use crate::census::check::{CheckError, zero_again};
use crate::closure::Pattern;
use crate::degenerate::bound::Bound;
use crate::enclosure::polish::PreciseSystem;
use crate::equilibrium::ProvenEquilibrium;
use crate::plane::cell::Cell;
use crate::plane::face::Face;
use crate::plane::system::System;
use crate::search::merge::Zeros;
use crate::search::undecided::{Reason, Undecided};

/// Every bound that is stated, against the one that is proved; `all` says that no equilibrium is
/// listed but those with a sign for each bar. The listed equilibria are known to be right.
pub(super) fn check_bounds(
    census: &Census,
    precise: &PreciseSystem,
    system: &System,
    all: bool,
) -> Result<(), CheckError> {
    let one = |(k, open): (usize, &Undecided)| {
        let Some(stated) = open.bound else { return Ok(()) };
        let number = k + 1;
        let not_proved = CheckError::BoundNotProved { number };
        // One pattern in a box that is as small as boxes get: only such boxes are counted in.
        let ([signs], Reason::Degenerate) = (&open.signs[..], open.reason) else {
            return Err(CheckError::Bound { number });
        };
        let Some(pattern) = pattern(system, signs) else {
            return Err(CheckError::Bound { number });
        };
        if matches!(open.chart, Face::Around(group) if usize::from(group) >= system.groups.len()) {
            return Err(CheckError::Bound { number });
        }
        let cell = Cell { face: open.chart, at: open.at };
        let listed = listed(census, precise, system, signs, pattern)?;
        let proved = Bound::of(system, &cell, pattern, &listed, all).ok_or(not_proved.clone())?;
        let contradicts = stated.degree.zip(proved.degree).is_some_and(|(a, b)| a != b);
        if contradicts || stated.at_most > proved.at_most {
            return Err(CheckError::Bound { number });
        }
        // Fewer, or a degree where none is proved, may be right all the same.
        if stated.at_most < proved.at_most || (stated.degree.is_some() && proved.degree.is_none()) {
            return Err(not_proved);
        }
        Ok(())
    };
    census.undecided.par_iter().enumerate().map(one).collect()
}

/// The zeros of the listed equilibria with these signs.
fn listed(
    census: &Census,
    precise: &PreciseSystem,
    system: &System,
    signs: &[i8],
    pattern: Pattern,
) -> Result<Zeros, CheckError> {
    let again = |(k, stated): (usize, &ProvenEquilibrium)| {
        let around = Cell { face: stated.alone_in.chart, at: stated.alone_in.at };
        Ok((pattern, zero_again(precise, system, k + 1, signs, around)?))
    };
    census.equilibria.iter().enumerate().filter(|(_, e)| e.signs == signs).map(again).collect()
}

/// The pattern with a sign for each bar.
fn pattern(system: &System, signs: &[i8]) -> Option<Pattern> {
    let each = signs.len() == system.bars() && signs.iter().all(|sign| sign.abs() == 1);
    let compressed = signs.iter().enumerate().filter(|(_, sign)| **sign < 0);
    each.then(|| Pattern(compressed.map(|(bar, _)| Pattern::bit(signs.len(), bar)).sum()))
}
