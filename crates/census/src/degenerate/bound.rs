//! How many equilibria an undecided box can hold.

use numerics::Interval;
use serde::{Deserialize, Serialize};

use crate::closure::{Closure, Pattern};
use crate::degenerate::arc::{Counted, count};
use crate::degenerate::maps::closure;
use crate::plane::cell::Cell;
use crate::plane::face::Face;
use crate::plane::system::System;
use crate::search::merge::Zeros;

/// What is proved of the equilibria in and around an undecided box: at most two next to a fold, at
/// most three next to a merger by symmetry. The numbers of a chain are doubles, and whether it is
/// exactly at a fold hangs on what is beyond their last digits; but not that there are two at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bound {
    /// At most so many, counted with multiplicity, besides those that are listed.
    pub at_most: usize,
    /// Those where the determinant of the closure's derivative is positive less those where it is
    /// negative: their number has the same parity. None where zeros are counted that are no pulls
    /// (beyond infinity, w < 0), or that may be listed elsewhere.
    pub degree: Option<i8>,
}

impl Bound {
    /// Of the zeros of one pattern in a box, those that are listed left out; `None` where nothing
    /// is proved. `all` says that no equilibrium is listed but these.
    pub(crate) fn of(
        system: &System,
        cell: &Cell,
        pattern: Pattern,
        listed: &Zeros,
        all: bool,
    ) -> Option<Self> {
        let signs: Vec<i8> = pattern.signs(system.bars()).collect();
        let map = |at: [Interval; 2]| closure(system, &signs, cell.face, at);
        let Counted { at, mut at_most, mut degree } = count(&map, cell.at)?;
        let around = Cell { face: cell.face, at };
        for (_, zero) in listed.iter().filter(|(other, _)| *other == pattern) {
            let Some(tight) = zero.tight.on(cell.face, system) else {
                if zero.tight.behind(cell.face, system) {
                    continue;
                }
                return None;
            };
            if around.disjoint(&tight) {
                continue;
            }
            if !around.encloses(&tight) {
                return None;
            }
            let [[a, b], [c, d]] = Closure::over(system, &signs, &tight)?.slope;
            degree = degree.checked_sub((a * d - b * c).sign()?)?;
            at_most = at_most.checked_sub(1)?;
        }
        let near = matches!(cell.face, Face::Near | Face::Around(_));
        let degree = (all && (near || at[1].lo() > 0.0)).then_some(degree);
        Some(Self { at_most, degree })
    }
}
