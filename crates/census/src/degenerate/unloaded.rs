//! Equilibria in which a bar carries nothing and the second derivative is singular: proved exactly.
//!
//! In the coordinates of [`axial`](crate::slack::axial), with all other bars upright,
//! $\kappa_i = c_i - c_k$ and
//!
//! $$ S_m = \sum_{i \ne k} s_i l_i \frac{\operatorname{sgn}(\kappa_i)^{m-1}}{|\kappa_i|^m}, $$
//!
//! bar k bridges the gap that they leave without force if the gap is as long as the bar, and the
//! equilibrium is degenerate if S_1 = 0. For integers both are questions without rounding. With the
//! direction $e = (x, z)$ of bar k and ρ along the curve of zeros of the upright closure, the level
//! closure is
//!
//! $$ x S_1 \varrho - \tfrac32 x z S_2 \varrho^2 + \tfrac12 x (5 z^2 - 1) S_3 \varrho^3 + \dots, $$
//!
//! the third term if the second vanishes (z = 0 or $S_2 = 0$; $5 z^2 \ne 1$, the sides being
//! integers), and $-\tfrac58 x S_2^2 \varrho^4 / l_k$ if z = 0 and $S_3 = 0$: expand $\varrho x/|F_i|$
//! and the upright parts in Legendre polynomials, and solve the upright closure for the turn of e. So
//! the multiplicity is the order of the first term that does not vanish. That no other zero is near
//! is proved as in [`arc`](crate::degenerate::arc).

use numerics::Interval;
use serde::{Deserialize, Serialize};

use crate::degenerate::arc::widest;
use crate::degenerate::maps::axial;
use crate::equilibrium::inertia::Indices;
use crate::equilibrium::{Neighbourhood, Observed, ProvenEquilibrium};
use crate::plane::cell::Cell;
use crate::slack::axial::{AxialClosure, Bars};
use crate::slack::moments::ExactMoments;

/// An equilibrium at which several have merged: the second derivative of the energy vanishes in one
/// direction in the plane, exactly, or in several.
///
/// In one direction it does where one bar carries nothing and the others happen to balance. Where g > 1
/// bars in a row carry nothing and just bridge the gap that the others leave, in one line, it does so
/// in the g − 1 directions in which they can turn, and the energy changes there with the fourth power of
/// the turns.
///
/// ```
/// use census::{Census, Settings};
/// use model::{Anchors, Bar, Chain, Problem};
/// // Bar 1 hangs, bar 2 is level without force, and bar 3 stands as heavily as bar 1 hangs.
/// let bars = vec![Bar::homogeneous(1.0, 1.0)?; 3];
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, -2.0] };
/// let problem = Problem::new(Chain::new("step", 9.81, anchors, bars)?)?;
/// let census = Census::take(&problem, &Settings::default())?;
/// let [step] = &census.degenerate[..] else { panic!("{census:?}") };
/// assert_eq!((&step.signs[..], step.multiplicity, step.degree), (&[1, 0, -1][..], Some(4), 0));
/// assert!(census.decided());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DegenerateEquilibrium {
    /// +1 for each bar in tension, −1 in compression, 0 for those that carry nothing.
    pub signs: Vec<i8>,
    /// So many equilibria have merged: the multiplicity of the zero of the derivative of the energy.
    /// `None` where a whole family has shrunk to this position: more than two bars in a row carry
    /// nothing.
    pub multiplicity: Option<usize>,
    /// Σ (−1)^index over the equilibria into which it falls apart when the chain is changed a
    /// little: 0 if the multiplicity is even.
    pub degree: i8,
    /// Directions in the plane in which the second derivative is negative.
    pub index_in_plane: usize,
    /// Directions out of the plane in which the second derivative is negative.
    pub index_out_of_plane: usize,
    /// The pull of the chain on the first anchor, as [`ProvenEquilibrium::pull_n`].
    pub pull_n: [Interval; 2],
    /// A neighbourhood of the pull that holds no other equilibrium with these signs.
    pub alone_in: Neighbourhood,
    /// Angle of each bar from the descending vertical towards the last anchor, (−π, π].
    pub angles_rad: Vec<Interval>,
    /// Potential energy, measured from the height of joint 0.
    pub energy_j: Interval,
    /// Joints 0..=n, world frame.
    pub joints_m: Vec<[Interval; 3]>,
    /// Multipliers in the paper's meaning and order, world frame.
    pub multipliers_n: Vec<[Interval; 3]>,
    /// Axial force of each bar, tension positive.
    pub axial_n: Vec<Interval>,
}

/// The square of pulls tried shrinks so often by a half.
const SHRINKS: usize = 12;

/// The degenerate equilibrium in which a bar carries nothing, if there is one with these signs and
/// none other is near.
pub(crate) fn prove(exact: &ExactMoments, closure: &AxialClosure) -> Option<DegenerateEquilibrium> {
    let AxialClosure { system, group, face, signs, axis, .. } = closure;
    let (system, bar, face) = (*system, group.start, *face);
    let multiplicity = exact.multiplicity(bar, signs)?;
    let map = |at| axial(system, signs, face, *axis, at);
    let exactly = closure.directions(0.0)?;
    let counted = widest(&map, [Interval::ZERO, exactly], multiplicity)?;
    // Forces so small that bar k must have one of the directions of the box.
    let mut radius = counted.at[0].hi().min(-counted.at[0].lo());
    let fits = |radius| closure.directions(radius).is_some_and(|t| counted.at[1].encloses(t));
    for _ in 0..SHRINKS {
        if fits(radius) {
            break;
        }
        radius *= 0.5;
    }
    if !fits(radius) {
        return None;
    }
    let compressed = signs.iter().filter(|sign| **sign < 0).count();
    let indices = Indices {
        // One direction of the closure is neither negative nor positive.
        in_plane: compressed.checked_sub(1)?,
        out_of_plane: compressed,
        condition: f64::INFINITY,
    };
    let turned = if compressed % 2 == 0 { 1 } else { -1 };
    // The derivative by (ρ, t) has the sign of (−1)^index but for the compressed bars.
    let degree = turned * counted.degree;
    let bars = closure.bars([Interval::ZERO, exactly])?;
    Some(DegenerateEquilibrium::new(closure, bars, radius, indices, (Some(multiplicity), degree)))
}

impl DegenerateEquilibrium {
    /// From what the bars do there; no other equilibrium has its pull in the disc of that radius.
    pub(super) fn new(
        closure: &AxialClosure,
        bars: Bars,
        radius: f64,
        indices: Indices,
        (multiplicity, degree): (Option<usize>, i8),
    ) -> Self {
        let AxialClosure { system, group, face, signs, .. } = closure;
        let pull = bars.forces[group.start];
        let observed = Observed {
            pull: Cell { face: *face, at: pull }.pull(system),
            forces: bars.forces,
            sizes: bars.sizes,
            directions: bars.directions,
        };
        // A square inside the disc.
        let side = Interval::new(-0.5 * radius, 0.5 * radius);
        let alone_in = Neighbourhood { chart: *face, at: [side, side] };
        let shown = ProvenEquilibrium::assemble(system, signs, &observed, alone_in, indices, false);
        Self {
            signs: shown.signs,
            multiplicity,
            degree,
            index_in_plane: shown.index_in_plane,
            index_out_of_plane: shown.index_out_of_plane,
            pull_n: shown.pull_n,
            alone_in,
            angles_rad: shown.angles_rad,
            energy_j: shown.energy_j,
            joints_m: shown.joints_m,
            multipliers_n: shown.multipliers_n,
            axial_n: shown.axial_n,
        }
    }
}
