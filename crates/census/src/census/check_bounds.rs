//! The bounds of undecided boxes, proved again from the chain and the listed equilibria.

use rayon::prelude::*;

use crate::census::Census;
use crate::census::check::CheckError;
use crate::closure::Pattern;
use crate::degenerate::bound::Bound;
use crate::enclosure::krawczyk::Zero;
use crate::plane::cell::Cell;
use crate::plane::face::Face;
use crate::plane::system::System;
use crate::search::undecided::{Reason, Undecided};
use crate::slack::moments::Exact;
use crate::slack::unloaded::unloaded;

/// The zeros of the listed equilibria with some signs, proved again.
pub(super) type Listed<'a> = dyn Fn(&[i8]) -> Result<Vec<Zero>, CheckError> + Sync + 'a;

/// Every bound that is stated, against the one that is proved.
pub(super) fn check_bounds(
    census: &Census,
    system: &System,
    exact: &Exact,
    listed: &Listed<'_>,
) -> Result<(), CheckError> {
    if census.undecided.iter().all(|open| open.bound.is_none()) {
        return Ok(());
    }
    let again = unloaded(system, exact);
    // Whether no equilibrium is listed but those with a sign for each bar.
    let all = again.equilibria.is_empty() && again.degenerate.is_empty();
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
        let listed = listed(signs)?.into_iter().map(|zero| (pattern, zero)).collect();
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

/// The pattern with a sign for each bar.
fn pattern(system: &System, signs: &[i8]) -> Option<Pattern> {
    let each = signs.len() == system.bars() && signs.iter().all(|sign| sign.abs() == 1);
    let compressed = signs.iter().enumerate().filter(|(_, sign)| **sign < 0);
    each.then(|| Pattern(compressed.map(|(bar, _)| Pattern::bit(signs.len(), bar)).sum()))
}
