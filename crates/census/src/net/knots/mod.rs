//! All equilibria of a net of bars with several closures, by the places of few of its joints.
//!
//! As many joints between two bars as possible are taken out (module `swing`); the places of the
//! others, the knots, are the unknowns, with the force densities of the bars between knots. Branch
//! and bound (module `search`) goes through all places that bars can reach. They are bounded, so no
//! bound for the forces is needed. In each box of places
//!
//! - distances that bars must bridge narrow the box (`reach`);
//! - forces follow from the linear balance, as enclosures; where they have no solution the box
//!   holds no equilibrium (`unknown_forces`). Where the bars of a strand may lie straight its tension has
//!   no bound: it is then an unknown of the linear balance, and what comes out must not be less
//!   than straight bars make it at least;
//! - where all is smooth, the interval Newton method narrows the box, or proves that it has one
//!   equilibrium at most for a pattern of signs (`box_test`).
//!
//! Every equilibrium is then proved again in all its places and forces (`enclose`), by equations that
//! share nothing with the search, and its index (`inertia`).
//!
//! R. B. Kearfott, "Rigorous Global Search: Continuous Problems" (1996),
//! doi:10.1007/978-1-4757-2495-0; A. Neumaier, "Interval Methods for Systems of Equations" (1990),
//! doi:10.1017/CBO9780511526473, sections 4.1 (linear equations) and 5.1 (Newton's method); the use
//! of distances: J.-P. Merlet, "Parallel Robots", 2nd ed. (2006), doi:10.1007/1-4020-4133-0,
//! section 4.4

mod box_test;
mod cell;
mod dense;
mod enclose;
mod inertia;
mod jet;
mod layout;
mod newton;
mod pieces;
mod reach;
mod search;
mod swing;
mod unknown_forces;

use model::NoCensus;
use numerics::Interval;

use self::box_test::Found;
use self::cell::Cell;
use self::enclose::{Enclosed, enclosed};
use self::layout::Layout;
pub(super) use self::pieces::Core;
use self::search::{Search, search};
use super::choice::Choice;
use crate::boxes::arithmetic::NOWHERE;
use crate::branch_and_bound::{encloses, hull};
use crate::run::search::Progress;
use crate::settings::Settings;

/// Tests of a box for a pattern against one of a cell of pulls: three coordinates instead of two.
const TESTS: u64 = 10;

/// Most coordinates of knots.
const MOST_COORDINATES: usize = 12;

/// Most joints that swing: each doubles the patterns.
const MOST_SWINGS: usize = 12;

/// The net of a part with what its census took.
#[derive(Debug, Clone, PartialEq)]
pub struct NetCensus {
    /// Its joints that move, from 0.
    pub joints: Vec<usize>,
    /// Its members, from 0.
    pub members: Vec<usize>,
    /// Members less joints that move.
    pub closures: usize,
    /// Joints whose places were searched, from 0.
    pub knots: Vec<usize>,
    /// Joints between two bars each that follow from those, from 0; each doubles the patterns.
    pub swings: Vec<usize>,
    /// Whether only equilibria in the vertical plane of the anchors were looked for: in space the
    /// joints move in too many ways. The list is then not complete, whatever is undecided.
    pub in_plane: bool,
    /// Boxes of places looked at.
    pub cells: u64,
    /// Tests of one box for one pattern.
    pub tests: u64,
    /// What could not be decided.
    pub undecided: Vec<UndecidedPlaces>,
}

/// A box of places of the knots for which the census does not say how many equilibria it holds,
/// besides those that are listed.
#[derive(Debug, Clone, PartialEq)]
pub struct UndecidedPlaces {
    /// Why.
    pub reason: Open,
    /// The places of the knots, m.
    pub knots_m: Vec<[Interval; 3]>,
    /// How many patterns of signs are in question, at most.
    pub patterns: usize,
}

/// Why places of knots are undecided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Open {
    /// The box is as small as boxes get: a degenerate equilibrium, straight bars, or nearly so.
    #[error("as small as boxes get: a degenerate equilibrium, straight bars, or nearly so")]
    Degenerate,
    /// The budget of tests was spent.
    #[error("the budget of tests was spent")]
    Budget,
    /// One equilibrium at most lies there, and it or its index is not proved.
    #[error("one equilibrium at most, which or whose index is not proved")]
    Unproved,
    /// A span of a rope may have no length there: a joint has run to its end, if there is such an equilibrium.
    #[error("a joint may have run to the end of a span of a rope")]
    Jam,
}

/// Equilibria of a net.
pub(super) fn taken(
    core: &Core,
    settings: &Settings,
    watch: &dyn Fn(Progress),
) -> Result<(NetCensus, Vec<Choice>), NoCensus> {
    let space = Layout::new(core, 3, [0, 1, 2])?;
    let layout = laid_out(core, space, settings)?;
    Ok(match layout.coordinates() {
        0..=3 => searched::<3>(core, &layout, settings, watch),
        _ => searched::<12>(core, &layout, settings, watch),
    })
}

/// Why a net has no census, as far as that is known before the search.
pub(super) fn refusal(core: &Core, settings: &Settings) -> Result<(), NoCensus> {
    let space = Layout::new(core, 3, [0, 1, 2])?;
    let axis = core.axis();
    // What swings about the vertical itself may leave the plane of the knot.
    let is_flat = space.knots.len() == 1 && space.swings.is_empty();
    if let Some(joint) = core.turning().or(axis.filter(|_| !is_flat)) {
        return Err(NoCensus::Turns { joint: joint + 1 });
    }
    laid_out(core, space, settings).map(|_| ())
}

/// The net in space, or in a plane where that is all that can be searched, or to which a knot turns freely.
fn laid_out(core: &Core, space: Layout, settings: &Settings) -> Result<Layout, NoCensus> {
    let axis = core.axis();
    let in_plane = axis.is_some() || space.motions() > settings.max_motions;
    let layout = match core.plane().filter(|_| in_plane) {
        Some(axes) => Layout { axis, ..Layout::new(core, 2, axes)? },
        None => space,
    };
    let (closures, motions, limit) = (core.closures(), layout.motions(), settings.max_motions);
    if motions > limit {
        return Err(NoCensus::Motions { closures, motions, limit });
    }
    // Self-stresses: forces are a family.
    let determined = layout.constraints() <= layout.coordinates();
    if !determined || layout.swings.len() > MOST_SWINGS || layout.coordinates() > MOST_COORDINATES {
        return Err(NoCensus::Closures { closures });
    }
    Ok(layout)
}

/// With room for N coordinates.
fn searched<const N: usize>(
    core: &Core,
    layout: &Layout,
    settings: &Settings,
    watch: &dyn Fn(Progress),
) -> (NetCensus, Vec<Choice>) {
    let patterns = 1_u64 << layout.swings.len();
    let budget = settings.max_tests_per_pattern.saturating_mul(patterns).saturating_mul(TESTS);
    let Search { found, undecided, mut cells, mut tests, exhausted, .. } =
        search::<N>(layout, budget, watch);
    let reason = |at: &[Interval; N]| match Cell::over(layout, *at) {
        Some(cell) if cell.jams() => Open::Jam,
        _ if exhausted => Open::Budget,
        _ => Open::Degenerate,
    };
    let mut open: Vec<UndecidedPlaces> = vec![];
    for (at, patterns) in gathered(undecided.into_iter().map(|task| (task.at, task.patterns))) {
        open.push(places(core, layout, reason(&at), &at, patterns.len()));
    }
    for jammed in layout.jammed() {
        let search = search::<N>(&jammed, budget, watch);
        cells += search.cells;
        tests += search.tests;
        let found = search.found.into_iter().map(|found| (found.alone_in, vec![found.pattern]));
        let undecided = search.undecided.into_iter().map(|task| (task.at, task.patterns));
        for (at, patterns) in gathered(found.chain(undecided)) {
            open.push(places(core, &jammed, Open::Jam, &at, patterns.len()));
        }
    }
    let mut once: Vec<(Found<N>, Enclosed)> = vec![];
    for found in found {
        // Nothing hangs there at the end of a rope: it is too short.
        if reach::narrow(layout, &mut found.alone_in.clone()).is_none() {
            continue;
        }
        let known = |(other, enclosed): &(Found<N>, Enclosed)| {
            other.pattern == found.pattern && encloses(&found.alone_in, &enclosed.knots)
        };
        // It is alone where it is: whatever else lies there is the same.
        if once.iter().any(known) {
            continue;
        }
        match enclosed(core, layout, &found) {
            Some(enclosed) => once.push((found, enclosed)),
            None => open.push(places(core, layout, Open::Unproved, &found.alone_in, 1)),
        }
    }
    let net = NetCensus {
        joints: core.joints.to_vec(),
        members: core.members.to_vec(),
        closures: core.closures(),
        knots: layout.knots.clone(),
        swings: layout.swings.iter().map(|swing| swing.joint).collect(),
        in_plane: layout.dim == 2 && layout.axis.is_none(),
        cells,
        tests,
        undecided: open,
    };
    (net, once.into_iter().map(|(_, enclosed)| enclosed.choice).collect())
}

/// A box of the search in metres.
fn places<const N: usize>(
    core: &Core,
    layout: &Layout,
    reason: Open,
    at: &[Interval; N],
    patterns: usize,
) -> UndecidedPlaces {
    let knots = at[..layout.coordinates()].chunks_exact(layout.dim).map(|parts| {
        let mut place = core.anchor_m().map_or(NOWHERE, |at_m| core.frame.place(at_m));
        for (axis, part) in layout.axes.iter().zip(parts) {
            place[*axis] = *part;
        }
        core.frame.place_m(place)
    });
    UndecidedPlaces { reason, knots_m: knots.collect(), patterns }
}

/// More boxes than this are not told apart: joining them takes the square of their number.
const MOST_OPEN: usize = 512;

/// Boxes that touch become one, with all their patterns.
fn gathered<const N: usize, P: Ord>(
    tasks: impl Iterator<Item = ([Interval; N], Vec<P>)>,
) -> Vec<([Interval; N], Vec<P>)> {
    let mut all: Vec<([Interval; N], Vec<P>)> = vec![];
    for (mut at, mut patterns) in tasks {
        let many = all.len() >= MOST_OPEN;
        let touching = |all: &[([Interval; N], Vec<P>)], at: &[Interval; N]| {
            all.iter()
                .position(|(other, _)| many || other.iter().zip(at).all(|(a, b)| !a.disjoint(*b)))
        };
        while let Some(k) = touching(&all, &at) {
            let (other, more) = all.swap_remove(k);
            at = hull(at, other);
            patterns.extend(more);
            patterns.sort_unstable();
            patterns.dedup();
        }
        all.push((at, patterns));
    }
    all
}
