//! A census held against everything else that knows something about equilibria.
//!
//! The census proves its list by intervals, from the balance of moments alone. Here others judge it
//! who share no formula with it: `lagrange` started at every listed equilibrium has to stay there,
//! the statics judge has to find every bar in balance, whatever random seeds of either solver find
//! has to be listed, and the stress matrices of the first and the last of the list have to certify
//! that no configuration has less energy, none more.

use census::{Census, Interval};
use lagrange::{Error, Seed, Settings, Solver};
use model::{Chain, Equilibrium, NoCertificate, Problem, Vector};
use numerics::vector::worse;

use crate::certificate::{certify, certify_highest};
use crate::free::stored_rounding_m;
use crate::systems::judge_chain;

/// Where a position stands in a census.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Number of the equilibrium in the list, from 1.
    pub number: usize,
    /// How far outside of its boxes the worst coordinate of a joint lies, in units of the total
    /// length; 0 inside.
    pub beyond: f64,
}

/// The listed equilibrium whose boxes are nearest to a position; with the anchors on one vertical
/// the position is turned about it first. `None` if nothing is listed, or the joints do not fit the
/// chain.
pub fn nearest(chain: &Chain, census: &Census, joints_m: &[Vector]) -> Option<Nearest> {
    let all = census.equilibria.iter().enumerate().map(|(k, equilibrium)| Nearest {
        number: k + 1,
        beyond: beyond(chain, &equilibrium.joints_m, joints_m),
    });
    all.filter(|place| place.beyond.is_finite()).min_by(|a, b| a.beyond.total_cmp(&b.beyond))
}

/// How far a position lies from the nearest straight one in the vertical through both anchors, in
/// units of the total length.
pub(crate) fn nearest_straight(chain: &Chain, census: &Census, joints_m: &[Vector]) -> Option<f64> {
    let [start, end] = [chain.anchors().start_m, chain.anchors().end_m];
    // Between anchors in one point there is one that hangs and one that stands.
    let ways: &[f64] = match end[2] - start[2] {
        rise if rise > 0.0 => &[1.0],
        rise if rise < 0.0 => &[-1.0],
        _ => &[1.0, -1.0],
    };
    let upright = census.straight.iter().filter(|position| position.upright);
    let all = upright.flat_map(|position| ways.iter().map(move |way| (position, way)));
    let distances = all.map(|(position, way)| {
        let mut height = Interval::point(start[2]);
        let mut boxes = vec![start.map(Interval::point)];
        for (bar, along) in chain.bars().iter().zip(&position.along) {
            height =
                height + Interval::point(way * f64::from(*along)) * Interval::point(bar.length_m());
            boxes.push([Interval::point(start[0]), Interval::point(start[1]), height]);
        }
        beyond(chain, &boxes, joints_m)
    });
    distances.filter(|distance| distance.is_finite()).min_by(f64::total_cmp)
}

/// How far outside of boxes the worst coordinate of a joint lies, in units of the total length.
fn beyond(chain: &Chain, boxes: &[[Interval; 3]], joints_m: &[Vector]) -> f64 {
    if boxes.len() != joints_m.len() {
        return f64::NAN;
    }
    let turned = if chain.anchors_on_one_vertical() {
        turned_onto(chain.anchors().start_m, boxes, joints_m)
    } else {
        joints_m.to_vec()
    };
    let coordinates = boxes.iter().flatten().zip(turned.iter().flatten());
    coordinates.map(|(part, x)| outside(*part, *x)).fold(0.0, worse) / chain.total_length_m()
}

/// How far a number lies outside of an interval.
fn outside(part: Interval, x: f64) -> f64 {
    if part.contains(x) { 0.0 } else { worse(part.lo() - x, x - part.hi()) }
}

/// The joints turned about the vertical through `origin` so that they come closest to the middles
/// of the boxes.
fn turned_onto(origin: Vector, boxes: &[[Interval; 3]], joints_m: &[Vector]) -> Vec<Vector> {
    let (mut along, mut across) = (0.0, 0.0);
    for (target, joint) in boxes.iter().zip(joints_m) {
        let [x, y, _]: Vector = std::array::from_fn(|k| target[k].mid() - origin[k]);
        let [a, b, _]: Vector = std::array::from_fn(|k| joint[k] - origin[k]);
        along += x * a + y * b;
        across += y * a - x * b;
    }
    let size = along.hypot(across);
    let (sin, cos) = if size > 0.0 { (across / size, along / size) } else { (0.0, 1.0) };
    let turn = |joint: &Vector| {
        let [a, b, c]: Vector = std::array::from_fn(|k| joint[k] - origin[k]);
        [origin[0] + cos * a - sin * b, origin[1] + sin * a + cos * b, origin[2] + c]
    };
    joints_m.iter().map(turn).collect()
}

/// What became of `lagrange`, started at a listed equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Visit {
    /// Number of the equilibrium where it started, from 1.
    pub number: usize,
    /// Where it ended.
    pub ended: Nearest,
    /// The 30 equations of the paper, for n bars, have the same index there, in the plane and in
    /// space.
    pub same_stability: bool,
}

/// Start `lagrange` in the middle of the boxes of every listed equilibrium.
///
/// # Errors
/// [`Error`] of the first start that does not converge.
///
/// # Panics
/// Never: a converged solution has the joints of its chain, and the census from which it was
/// started has an entry.
///
/// ```
/// use census::{Census, Settings};
/// let problem = model::cases::paper();
/// let census = Census::take(&problem, &Settings::default())?;
/// for visit in validate::census_checks::visits(&problem, &census).unwrap() {
///     assert!(visit.ended.number == visit.number && visit.ended.beyond < 1e-12);
/// }
/// # Ok::<(), census::CensusError>(())
/// ```
pub fn visits(problem: &Problem, census: &Census) -> Result<Vec<Visit>, Error> {
    let chain = problem.chain();
    let mut solver = Solver::new(problem, &Settings::default())?;
    let listed = census.equilibria.iter().enumerate();
    listed
        .map(|(k, equilibrium)| {
            let joints: Vec<Vector> =
                equilibrium.joints_m.iter().map(|joint| joint.map(Interval::mid)).collect();
            let bars: Vec<Vector> = joints
                .windows(2)
                .map(|ends| std::array::from_fn(|axis| ends[1][axis] - ends[0][axis]))
                .collect();
            let found = solver.solve(&Seed::directions(&bars))?.solution()?.equilibrium;
            Ok(Visit {
                number: k + 1,
                ended: nearest(chain, census, &found.joints_m)
                    .expect("the census has at least the equilibrium of this start"),
                same_stability: found.stability.index_in_plane == equilibrium.index_in_plane
                    && found.stability.index_in_space == equilibrium.index_in_space(),
            })
        })
        .collect()
}

/// The largest violation of Newton's laws by the middles of the boxes, over all equilibria: joints
/// and multipliers, judged bar by bar.
pub fn statics(problem: &Problem, census: &Census) -> f64 {
    let answers = census.to_model();
    let judged = answers.iter().map(|answer| judge_chain(problem, answer).largest());
    judged.fold(0.0, worse)
}

/// How far the certificates of the lowest and of the highest of the list miss their energies, in
/// units of the weight between the anchors times the total length.
///
/// # Errors
/// [`NoCertificate`] when something lower or higher is not excluded.
pub fn gaps(problem: &Problem, census: &Census) -> Result<[f64; 2], NoCertificate> {
    let answers = census.to_model();
    let by_energy = |a: &&Equilibrium, b: &&Equilibrium| a.energy_j.total_cmp(&b.energy_j);
    let lowest = answers.iter().min_by(by_energy).ok_or(NoCertificate::Unusable)?;
    let highest = answers.iter().max_by(by_energy).ok_or(NoCertificate::Unusable)?;
    Ok([certify(problem, lowest)?.gap, certify_highest(problem, highest)?.gap])
}

/// The accuracy to which a solver may place a joint, in units of the total length: what coordinates
/// can hold besides 1e-12.
pub fn placed(chain: &Chain) -> f64 {
    /// Measured on random chains: 2e-14 in general.
    const SOLVER: f64 = 1e-12;
    SOLVER + stored_rounding_m(chain) / chain.total_length_m()
}

#[cfg(test)]
mod tests;
