//! Ropes that jam: joints that have run together are solved as one.
//!
//! Where a span of a rope has no length its direction is any vector $s$ with $|s| \\le 1$: a subgradient of
//! $|d|$. The two joints are one in the balances then, and what each of them alone is out of balance by the
//! spans bear as $T s$. It is an equilibrium if that is no more than the tension. Where several spans may bear
//! it, it is shared with the least $\sum T |s|^2$.

use matrices::dense::{apply, least_squares};
use model::Jam;
use model::system::{Joined, RunTogether, System};
use nalgebra::{DMatrix, DVector, Vector3};

use super::framework::Framework;
use super::solution::{Answer, Solution};
use super::state::State;
use crate::error::Error;
use crate::thresholds::ZERO;

/// What a span bears may exceed its tension by this part of it. What a light ring feels of a corner is only the
/// square of its weight over the tension.
const ABOVE: f64 = 1e-11;

/// What was found; where a rope jams, with the joints that run together as one. Where that is no equilibrium those of
/// another of its spans may be: nearly equal weights over a pulley are nearly one at either end.
pub(super) fn joined(
    system: &System,
    framework: Framework,
    mut solve: impl FnMut(&System, Framework, Option<&Joined>) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let whole = (!framework.ropes.is_empty()).then(|| framework.clone());
    let found = solve(system, framework, None);
    let (Some(whole), Err(Error::Jammed(RunTogether { member, from, to }))) = (whole, &found)
    else {
        return found;
    };
    let [Some(a), Some(b)] = [from, to].map(|name| system.joint(name)) else { return found };
    let others = system.members()[member - 1].spans().filter(|span| *span != [a, b]);
    let mut corners = std::iter::once([a, b]).chain(others);
    corners.find_map(|pair| corner(system, &whole, pair, &mut solve)).map_or(found, Ok)
}

/// The equilibrium with the joints of a pair as one, and of others as long as more run together.
fn corner(
    system: &System,
    whole: &Framework,
    mut pair: [usize; 2],
    solve: &mut impl FnMut(&System, Framework, Option<&Joined>) -> Result<Solution, Error>,
) -> Option<Solution> {
    let mut pairs = Vec::new();
    loop {
        pairs.push(pair);
        let joined = system.joined(&pairs)?;
        match solve(&joined.system, whole.joined(&joined), Some(&joined)) {
            Ok(solution) => return apart(system, whole, &joined, solution),
            Err(Error::Jammed(RunTogether { from, to, .. })) => {
                pair = [system.joint(&from)?, system.joint(&to)?];
            }
            Err(_) => return None,
        }
    }
}

impl Framework {
    /// That of the joined system, with what lies on the floor here.
    fn joined(&self, joined: &Joined) -> Self {
        let framework = Self { work: self.work.clone(), ..Self::new(&joined.system) };
        let mut lies = vec![false; framework.nodes.len()];
        for lying in &self.lying {
            lies[joined.numbers[lying.joint]] = true;
        }
        match framework.floor(&joined.system) {
            Some(floor) => framework.with_laid(floor, &lies),
            None => framework,
        }
    }
}

/// The answer with all joints of the whole system; nothing where a span would bear more than its tension.
fn apart(
    system: &System,
    framework: &Framework,
    joined: &Joined,
    mut solution: Solution,
) -> Option<Solution> {
    let units = framework.units;
    let answer = &solution.equilibrium;
    let place = |number: &usize| units.place(answer.joints_m[*number]);
    let axial = answer.axial_n.iter().map(|axial_n| axial_n / units.force_n).collect();
    let axial = framework.by_link(axial);
    let taut = vec![true; axial.len()];
    let state = State::new(joined.numbers.iter().map(place).collect(), axial, taut);
    let mut directions = state.directions(framework);
    let spans: Vec<usize> = (0..framework.links.len())
        .filter(|k| {
            let link = &framework.links[*k];
            let is_one = joined.numbers[link.from] == joined.numbers[link.to];
            link.rope.is_some() && is_one && framework.ends_move(link) && state.axial[*k] > 0.0
        })
        .collect();
    for (span, pull) in spans.iter().zip(pulls(framework, joined, &state, &spans)?) {
        if pull.norm() > state.axial[*span] * (1.0 + ABOVE) {
            return None;
        }
        directions[*span].0 = pull / state.axial[*span];
    }
    let left = framework.left(&directions, &state.axial);
    let jam = |span: &usize| {
        let member = framework.member_of(*span);
        let rope = framework.rope(&framework.links[*span])?;
        let number = rope.spans.iter().position(|other| other == span)?;
        let pull = directions[*span].0 * (state.axial[*span] * units.force_n);
        Some(Jam { member, span: number, pull_n: pull.into() })
    };
    let mut jams: Vec<Jam> = spans.iter().filter_map(jam).collect();
    jams.sort_by_key(|jam| [jam.member, jam.span]);
    let (stability, mut evidence) = (answer.stability, answer.evidence.clone());
    evidence.jams = jams;
    solution.equilibrium =
        Answer { system, framework, state, directions, left }.equilibrium(stability, evidence);
    Some(solution)
}

/// What the spans without length bear, each at its first joint: with it every joint is in balance along its free
/// directions. Nothing where none do that.
fn pulls(
    framework: &Framework,
    joined: &Joined,
    state: &State,
    spans: &[usize],
) -> Option<Vec<Vector3<f64>>> {
    let numbers = &joined.numbers;
    let shared = |joint: &usize| numbers.iter().filter(|other| **other == numbers[*joint]).count();
    let joints = (0..numbers.len()).filter(|joint| shared(joint) > 1);
    let rows: Vec<(usize, Vector3<f64>)> = joints
        .flat_map(|joint| {
            let free = &framework.nodes[joint].free;
            let axes = free.axes();
            (0..free.count()).map(move |k| (joint, axes.column(k).into()))
        })
        .collect();
    let left = framework.left(&state.directions(framework), &state.axial);
    let wanted = DVector::from_iterator(rows.len(), rows.iter().map(|(at, e)| -e.dot(&left[*at])));
    let weights: Vec<f64> = spans.iter().map(|span| state.axial[*span].sqrt()).collect();
    let balance = DMatrix::from_fn(rows.len(), 3 * spans.len(), |row, column| {
        let (at, along) = rows[row];
        let link = &framework.links[spans[column / 3]];
        let sign = f64::from(u8::from(link.from == at)) - f64::from(u8::from(link.to == at));
        sign * weights[column / 3] * along[column % 3]
    });
    let parts = least_squares(&balance, &wanted, ZERO)?;
    let off = (apply(&balance, &parts) - wanted).amax();
    let pull = |(k, weight): (usize, &f64)| {
        Vector3::from_iterator(parts.rows(3 * k, 3).iter().copied()) * *weight
    };
    (off <= ZERO * state.largest_force(framework))
        .then(|| weights.iter().enumerate().map(pull).collect())
}
