//! All equilibria of a bridle: one joint, the knot, that strands of bars hold to anchors.
//!
//! With each box of places of the knot (module `search`) goes, for each strand, the list of the
//! cells of pulls that reach the box (module `pulls`), infinite pulls of straight strands included:
//! pull and pattern tell shape and force of the strand. Choices of one cell for each strand that
//! cannot hold the load of the knot are dropped (module `balance`), and the interval Newton method
//! on place and pulls narrows the others, or proves that a box has one equilibrium at most (module
//! `newton`). Every equilibrium is then proved again in all its places and forces by Krawczyk's
//! test on the equations of the system, which share nothing with the search (module `enclose`).
//!
//! # What is covered
//!
//! Bars whose force vanishes may point anywhere; they stay in the vertical plane of the strand, and
//! cells about such pulls are kept until the box of places is small. Where the knot may stand
//! over or under an anchor the plane of that strand is unknown, and only the size of its horizontal
//! force counts. What is degenerate in these ways, or has a singular derivative, ends as undecided
//! boxes.

mod balance;
mod enclose;
mod newton;
mod pulls;
mod search;
mod strand;

use model::NoCensus;
use numerics::Interval;

use self::enclose::{Enclosed, enclosed};
use self::newton::Found;
use self::search::{Search, search};
use self::strand::Bridle;
use super::choice::Choice;
use super::knots::{Core, NetCensus, Open, UndecidedPlaces, gathered};
use crate::boxes::arithmetic::Vector;
use crate::run::search::Progress;
use crate::settings::Settings;

/// Tests of a cell of pulls for a pattern of a strand against those in a chain: each box of places
/// of the knot has its own.
const TESTS: u64 = 10;

/// Strands of so many bars follow from the place of the knot by closed forms, which is faster.
const SHORT: usize = 2;

/// Most strands: each multiplies the choices of pulls.
const MOST_STRANDS: usize = 3;

/// Processor time of the census of a bridle of three strands of so many bars together, s: 3 s ·
/// 2^(n − 9), good to an order of magnitude (`examples/bridle_census.rs`): strands of four bars each
/// take longer than that.
///
/// ```
/// let [nine, ten] = [9, 10].map(census::net::bridle_seconds);
/// assert!(nine < 60.0 && ten > nine);
/// ```
pub fn bridle_seconds(bars: usize) -> f64 {
    const NINE_BARS_S: f64 = 3.0;
    // Beyond this the number overflows.
    NINE_BARS_S * 2.0_f64.powf((bars as f64 - 9.0).min(600.0))
}

/// A net that is a bridle of three strands; nothing if it is another net, or one with short strands whose
/// joints move in few enough ways to be searched by their places.
fn bridle(core: &Core, motions: usize, settings: &Settings) -> Result<Option<Bridle>, NoCensus> {
    let Some(bridle) = Bridle::new(core) else { return Ok(None) };
    let few = motions <= settings.max_motions && bridle.longest() <= SHORT;
    if few || bridle.strands.len() > MOST_STRANDS {
        return Ok(None);
    }
    let (bars, limit) = (bridle.bars(), settings.max_bridle_bars);
    if bars > limit { Err(NoCensus::Bridle { bars, limit }) } else { Ok(Some(bridle)) }
}

/// Whether a net is such a bridle.
pub(super) fn refusal(core: &Core, motions: usize, settings: &Settings) -> Result<bool, NoCensus> {
    bridle(core, motions, settings).map(|bridle| bridle.is_some())
}

/// Equilibria of a net that is such a bridle.
pub(super) fn taken(
    core: &Core,
    motions: usize,
    settings: &Settings,
    watch: &dyn Fn(Progress),
) -> Result<Option<(NetCensus, Vec<Choice>)>, NoCensus> {
    let Some(bridle) = bridle(core, motions, settings)? else { return Ok(None) };
    let bars = bridle.bars();
    let patterns = bridle.strands.iter().map(|strand| 1_u64 << strand.length.len()).sum();
    let budget = settings.max_tests_per_pattern.saturating_mul(TESTS).saturating_mul(patterns);
    let Search { found, undecided, cells, tests, exhausted, .. } = search(&bridle, budget, watch);
    let reason = if exhausted { Open::Budget } else { Open::Degenerate };
    let places = |at: Vector, patterns: usize, reason: Open| {
        let knots_m = vec![core.frame.place_m(at)];
        UndecidedPlaces { reason, knots_m, patterns }
    };
    let undecided = undecided.into_iter().map(|task| (task.at, task.patterns()));
    let mut open: Vec<UndecidedPlaces> = gathered(undecided)
        .into_iter()
        .map(|(at, strands)| {
            let patterns = strands.iter().map(Vec::len).fold(1, usize::saturating_mul);
            places(at, patterns, reason)
        })
        .collect();
    let mut once: Vec<(Found, Enclosed)> = vec![];
    for found in found {
        // It is alone where it is: whatever else lies there is the same.
        if once.iter().any(|(_, enclosed)| enclosed.is(&bridle, &found)) {
            continue;
        }
        match enclosed(core, &bridle, &found) {
            // Proved already in another chart, or from a neighbour.
            Some(enclosed) if once.iter().any(|(other, _)| enclosed.is(&bridle, other)) => {}
            Some(enclosed) if once.iter().all(|(_, other)| enclosed.differs(other)) => {
                once.push((found, enclosed));
            }
            // Not enclosed, or neither proved to be one of the others nor to be another.
            _ => {
                let at: Vec<Interval> = found.alone_in;
                open.push(places([at[0], at[1], at[2]], 1, Open::Unproved));
            }
        }
    }
    let net = NetCensus {
        joints: core.joints.to_vec(),
        members: core.members.to_vec(),
        closures: core.closures(),
        knots: vec![bridle.knot],
        swings: vec![],
        signs: bars,
        in_plane: false,
        cells,
        tests,
        undecided: open,
    };
    Ok(Some((net, once.into_iter().map(|(_, enclosed)| enclosed.choice).collect())))
}
