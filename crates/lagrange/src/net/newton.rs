//! Newton's method on places and axial forces together.
//!
//! With the directions $u$ and lengths $d$ of the members the equations are the balance of the
//! joints and
//! $|d| = l + c\\,N$ for every taut member, and their derivative is
//!
//! $$ \begin{bmatrix} \sum C^T \tfrac{N}{d} (1 - u u^T) C & C^T u \\\\ u^T C & -c \end{bmatrix}. $$
//!
//! It is symmetric and indefinite. A step solves it by refinement: with $-c - 1/\rho$ in place of
//! $-c$ the forces can be eliminated, which leaves a matrix over the joints alone, and the small
//! $1/\rho$ is taken out again by the residual of the true system. The same equations hold at every
//! equilibrium, stable or not.

use nalgebra::Vector3;

use super::decided::{Decided, SWEEPS};
use super::fitted::RIGID;
use super::framework::{Framework, Link};
use super::residual::Residual;
use super::settings::Settings;
use super::state::State;
use super::stiffness::Stiffness;
use crate::thresholds::{CLOSURE_ROUNDING, EARNED, HALVED, ROUNDED, SEEN};

/// $\rho$ in units of the largest stiffness $N/l$: far above it, so that a sweep gains some digits,
/// and far below the inverse of rounding.
const PENALTY: f64 = 1e5;
/// Stiffness given to each joint, in units of $N/l$ of its members, where steps do not help.
const HELD: f64 = 1e-8;
/// Refinement of a step ends when the residual of the linear system has fallen to this part.
const REFINED: f64 = 3e-6;
/// A sweep that leaves this part of what was left, as with a line that is nearly taut, has too small
/// a correction: it is made so long that it leaves least.
const POOR_SWEEP: f64 = 0.1;
/// A step is halved at most so many times.
const HALVINGS: usize = 24;

/// In this many steps the merit ought to be [`HALVED`], or the start was too far away.
const SLOW_STEPS: usize = 3;

/// When a run of Newton's method ends without success.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Patience {
    /// As soon as the steps hardly help: there is a nearer start to be had.
    Little,
    /// When no step helps at all.
    Full,
}

/// A run of Newton's method: the best state, its residual, and the steps it took.
pub(super) struct Run {
    pub state: State,
    pub residual: Residual,
    pub steps: usize,
}

impl Run {
    /// A run that has made no step yet.
    pub fn at(framework: &Framework, state: State) -> Self {
        Self::within(framework, state, None)
    }

    fn within(framework: &Framework, state: State, decided: Option<&mut Decided>) -> Self {
        Self { residual: Residual::within(framework, &state, decided), state, steps: 0 }
    }
}

/// The state with the forces of elastic members between anchors, which nothing else changes.
pub(super) fn with_held(framework: &Framework, mut state: State) -> State {
    for (k, link) in framework.links.iter().enumerate() {
        if let Some(force) = framework.held_force(k) {
            (state.axial[k], state.taut[k]) = (force, link.bears(force));
        }
    }
    state
}

/// Improve a state until it is in equilibrium to rounding, or no step helps.
pub(super) fn polish(
    framework: &Framework,
    stiffness: &mut Stiffness,
    settings: &Settings,
    state: State,
    patience: Patience,
    mut decided: Option<&mut Decided>,
) -> Run {
    let mut run = Run::within(framework, with_held(framework, state), decided.as_deref_mut());
    let (mut merit, mut slow, mut anew) = (run.residual.merit, 0, false);
    // Of stiff members a rounding of a length is a force.
    let elastic = framework.links.iter().any(|link| link.compliance > 0.0);
    let rounded = if elastic { CLOSURE_ROUNDING } else { ROUNDED };
    let rigid = |link: &Link| link.compliance <= 0.0 && framework.moves(link);
    let (mixed, mut stiffly) = (elastic && framework.links.iter().any(rigid), false);
    while run.steps < settings.max_iterations && !framework.work.is_spent() {
        let done = run.residual.size() <= settings.tolerance;
        let Residual { forces, lengths, .. } = &run.residual;
        // What is left of rounding goes with the factor of the last step, where that was near enough.
        let last = done && run.steps > 0 && !anew;
        if !last {
            let near = run.residual.size() <= SEEN;
            stiffly = mixed && ((slow > 0 && near) || decided.is_some());
        }
        let at = Derivative::at(framework, &run.state, &run.residual);
        let at = if stiffly { at.stiffer() } else { at };
        let derivative = if last {
            Some(at)
        } else {
            let held = if elastic && (done || slow > 0) { HELD } else { 0.0 };
            at.factored(framework, stiffness, held)
        };
        let step = derivative.and_then(|d| {
            let decided = decided.as_deref_mut();
            d.solve(framework, stiffness, (forces, lengths), REFINED, decided)
        });
        let Some((step, _)) = step else { break };
        run.steps += 1;
        let next = search(framework, &run, &step, done, decided.as_deref_mut());
        let Some((state, residual)) = next else {
            anew = last && run.residual.size() > rounded;
            if anew {
                continue;
            }
            break;
        };
        let before = run.residual.size();
        (run.state, run.residual) = (state, residual);
        if let Some(decided) = decided.as_deref_mut() {
            decided.renew(framework, &run.state);
            run.residual = Residual::within(framework, &run.state, Some(decided));
        }
        slow += 1;
        if run.residual.merit <= HALVED * merit {
            (merit, slow) = (run.residual.merit, 0);
        }
        // Lengths are brought to rounding as long as steps help; a factor from before may be none of a
        // part that turns freely.
        let halved = run.residual.size() <= HALVED * before;
        let rough = done && run.residual.length.0 > rounded;
        anew = rough && last && !halved;
        if anew || (rough && halved) {
            continue;
        }
        if done || (patience == Patience::Little && slow >= SLOW_STEPS) {
            break;
        }
    }
    run
}

/// The longest of the halved steps that lowers the merit.
fn search(
    framework: &Framework,
    run: &Run,
    step: &Step,
    done: bool,
    mut decided: Option<&mut Decided>,
) -> Option<(State, Residual)> {
    let mut t = 1.0;
    for _ in 0..if done { 1 } else { HALVINGS } {
        let state = step.applied(&run.state, t);
        let residual = Residual::within(framework, &state, decided.as_deref_mut());
        if residual.merit <= run.residual.merit * (1.0 - 2.0 * EARNED * t) {
            return Some((state, residual));
        }
        t *= 0.5;
    }
    None
}

/// Change of places and of axial forces.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub places: Vec<Vector3<f64>>,
    pub axial: Vec<f64>,
}

/// One row of the derivative: a member's direction and its stiffnesses.
struct Row {
    u: Vector3<f64>,
    /// $N/d$, normal to the member.
    across: f64,
    /// Whether the member keeps its length.
    taut: bool,
    compliance: f64,
    /// $1/(c + 1/\rho)$.
    along: f64,
}

/// The derivative of the equations at a state, whose factor a [`Stiffness`] holds.
pub(super) struct Derivative {
    rows: Vec<Row>,
    /// Largest force, the unit of balance.
    unit: f64,
    /// Whether joints are held a little.
    is_held: bool,
}

impl Derivative {
    /// At a state, for a stiffness that holds a factor from nearby.
    pub fn at(framework: &Framework, state: &State, residual: &Residual) -> Self {
        Self {
            rows: rows(framework, state, &residual.directions),
            unit: residual.unit,
            is_held: false,
        }
    }

    /// The same with the true stiffness of the elastic members, however stiff they are; members that keep their
    /// lengths are stiffer than these, however little they bear, or lengths would come right slowly beside them.
    pub fn stiffer(mut self) -> Self {
        let of_elastic =
            |row: &Row| (row.taut && row.compliance > 0.0).then(|| row.compliance.recip());
        let rigid = RIGID * self.rows.iter().filter_map(of_elastic).fold(0.0, f64::max);
        for row in self.rows.iter_mut().filter(|row| row.taut) {
            row.along = of_elastic(row).unwrap_or(row.along.max(rigid));
        }
        self
    }

    /// Factorise it, with each joint held a little; nothing when the factor is not finite.
    pub fn factored(
        mut self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        held: f64,
    ) -> Option<Self> {
        self.is_held = held > 0.0;
        self.assembled(framework, stiffness);
        // What turns freely would move by what rounding leaves of its stiffness; refinement takes this out again.
        for (link, row) in framework.links.iter().zip(&self.rows).filter(|_| self.is_held) {
            let held = held * row.across.abs();
            stiffness.hold(link.from, held);
            stiffness.hold(link.to, held);
        }
        stiffness.factorise_indefinite().then_some(self)
    }

    /// The stiffer one, also where it is singular: what needs more borders it.
    pub fn bordered(
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &State,
        residual: &Residual,
    ) -> Option<Self> {
        let new = Self::at(framework, state, residual).stiffer();
        new.assembled(framework, stiffness);
        stiffness.factorise_bordered().then_some(new)
    }

    fn assembled(&self, framework: &Framework, stiffness: &mut Stiffness) {
        stiffness.assemble_members(framework, |k| {
            let row = &self.rows[k];
            (row.u, row.across, row.along)
        });
    }

    /// What concerns taut members; zero for the others.
    pub fn of_taut(&self, values: &[f64]) -> Vec<f64> {
        let rows = self.rows.iter().zip(values);
        rows.map(|(row, value)| if row.taut { *value } else { 0.0 }).collect()
    }

    /// The step that takes unbalanced forces and misfits of the lengths away to first order, and
    /// the part of their norm that it leaves, once that is below `enough` or falls no further;
    /// nothing when it leaves all. Of misfits that no places take away nothing is left.
    pub fn solve(
        &self,
        framework: &Framework,
        stiffness: &mut Stiffness,
        (forces, lengths): (&[Vector3<f64>], &[f64]),
        enough: f64,
        mut decided: Option<&mut Decided>,
    ) -> Option<(Step, f64)> {
        let mut step = Step {
            places: vec![Vector3::zeros(); framework.nodes.len()],
            axial: vec![0.0; framework.links.len()],
        };
        let mut left = (forces.to_vec(), lengths.to_vec());
        let first = size(framework, forces, lengths, self.unit);
        let mut last = f64::INFINITY;
        let mut leaves = |step: &Step| {
            let mut left = self.left(step, framework, forces, lengths);
            if let Some(decided) = decided.as_deref_mut() {
                left.1 = decided.part(framework, &left.1);
            }
            let size = size(framework, &left.0, &left.1, self.unit);
            (left, size)
        };
        for _ in 0..SWEEPS {
            let mut better = self.refined(&step, framework, stiffness, &left.0, &left.1);
            let (mut leaves_now, mut size) = leaves(&better);
            // Of what is held that would be what turns freely.
            if !self.is_held && size > POOR_SWEEP * POOR_SWEEP * last.min(first) {
                let by = self.best_length(framework, &left, &leaves_now);
                let longer = step.towards(&better, by);
                let (leaves_longer, least) = leaves(&longer);
                if least < size {
                    (better, leaves_now, size) = (longer, leaves_longer, least);
                }
            }
            left = leaves_now;
            if size.is_nan() || size >= last {
                break;
            }
            (step, last) = (better, size);
            if size <= enough * enough * first {
                break;
            }
        }
        // A step that leaves all of the residual does not count.
        (last < first).then(|| (step, (last / first).sqrt()))
    }

    /// How many times a correction should be made, from what is left before and after one.
    fn best_length(
        &self,
        framework: &Framework,
        before: &(Vec<Vector3<f64>>, Vec<f64>),
        after: &(Vec<Vector3<f64>>, Vec<f64>),
    ) -> f64 {
        let taken: Vec<_> = before.0.iter().zip(&after.0).map(|(b, a)| b - a).collect();
        let shortened: Vec<_> = before.1.iter().zip(&after.1).map(|(b, a)| b - a).collect();
        let nodes = framework.nodes.iter().zip(before.0.iter().zip(&taken));
        let work =
            nodes.map(|(node, (b, t))| node.free.components(b).dot(&node.free.components(t)));
        let of_forces = work.sum::<f64>() / (self.unit * self.unit);
        let of_lengths: f64 = before.1.iter().zip(&shortened).map(|(b, s)| b * s).sum();
        (of_forces + of_lengths) / size(framework, &taken, &shortened, self.unit)
    }

    /// The step plus the solution for what is left.
    pub fn refined(
        &self,
        step: &Step,
        framework: &Framework,
        stiffness: &mut Stiffness,
        forces: &[Vector3<f64>],
        lengths: &[f64],
    ) -> Step {
        let mut right = forces.to_vec();
        for ((link, row), misfit) in framework.links.iter().zip(&self.rows).zip(lengths) {
            let pull = row.u * (row.along * misfit);
            right[link.from] -= pull;
            right[link.to] += pull;
        }
        let moves = stiffness.moves(framework, &right);
        let axial = self.rows.iter().zip(lengths).enumerate();
        let axial = axial
            .map(|(k, (row, misfit))| row.along * (self.stretch(framework, k, &moves) - misfit));
        Step {
            axial: step.axial.iter().zip(axial).map(|(a, more)| a + more).collect(),
            places: step.places.iter().zip(&moves).map(|(place, more)| place + more).collect(),
        }
    }

    /// By how much moves of the joints make a member longer, to first order.
    fn stretch(&self, framework: &Framework, link: usize, moves: &[Vector3<f64>]) -> f64 {
        framework.whole(link, |k| self.rows[k].u.dot(&framework.links[k].span(moves)))
    }

    /// What a step leaves of unbalanced forces and misfits to first order.
    pub fn left(
        &self,
        step: &Step,
        framework: &Framework,
        forces: &[Vector3<f64>],
        lengths: &[f64],
    ) -> (Vec<Vector3<f64>>, Vec<f64>) {
        let (mut forces, mut lengths) = (forces.to_vec(), lengths.to_vec());
        for (k, (link, row)) in framework.links.iter().zip(&self.rows).enumerate() {
            let change = link.span(&step.places);
            let across = change - row.u * row.u.dot(&change);
            let pull = across * row.across + row.u * step.axial[k];
            forces[link.from] += pull;
            forces[link.to] -= pull;
            if row.taut {
                let stretch = self.stretch(framework, k, &step.places);
                lengths[k] -= stretch - row.compliance * step.axial[k];
            }
        }
        (forces, lengths)
    }
}

impl Step {
    /// On the way from here to another step, in units of the way.
    fn towards(&self, other: &Self, by: f64) -> Self {
        let places = self.places.iter().zip(&other.places);
        let axial = self.axial.iter().zip(&other.axial);
        Self {
            places: places.map(|(a, b)| a + (b - a) * by).collect(),
            axial: axial.map(|(a, b)| a + (b - a) * by).collect(),
        }
    }

    pub fn applied(&self, state: &State, t: f64) -> State {
        let mut next = state.moved(&self.places, t);
        for (axial, step) in next.axial.iter_mut().zip(&self.axial) {
            *axial += step * t;
        }
        next
    }
}

fn size(framework: &Framework, forces: &[Vector3<f64>], lengths: &[f64], unit: f64) -> f64 {
    let forces = framework.nodes.iter().zip(forces);
    let squares = forces.map(|(node, force)| node.free.components(force).norm_squared());
    squares.sum::<f64>() / (unit * unit) + lengths.iter().map(|l| l * l).sum::<f64>()
}

fn rows(framework: &Framework, state: &State, directions: &[(Vector3<f64>, f64)]) -> Vec<Row> {
    let across = |k: usize| -> f64 {
        let (_, length) = directions[k];
        if length > 0.0 { state.axial[k] / length } else { 0.0 }
    };
    let links = framework.links.iter();
    let stiffest = (0..directions.len()).map(|k| across(k).abs()).fold(0.0, f64::max);
    let rho = PENALTY * if stiffest > 0.0 { stiffest } else { 1.0 };
    links
        .enumerate()
        .map(|(k, link)| {
            let taut = state.taut[k] && framework.moves(link);
            Row {
                u: directions[k].0,
                across: across(k),
                taut,
                compliance: link.compliance,
                along: if taut { (link.compliance + rho.recip()).recip() } else { 0.0 },
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, System};

    use super::*;

    /// Two bars hold a lamp from anchors above each other. If one alone is to be longer, the lamp moves
    /// by half of it, and half is left with either bar: of a misfit of any size a part of √2/2.
    #[test]
    fn what_a_step_leaves_is_a_part_of_what_was_there() {
        let joints = vec![
            Joint::anchor("A", [0.0, 0.0, 2.0]),
            Joint::anchor("B", [0.0, 0.0, 1.0]),
            Joint::free("P").with_mass(1.0),
        ];
        let bar = |from, length| Member::bar(from, 2, Bar::homogeneous(length, 0.0).unwrap());
        let system = System::new("a lamp", 9.81, joints, vec![bar(0, 2.0), bar(1, 1.0)]).unwrap();
        let framework = Framework::new(&system);
        let place = |z: f64| framework.units.place([0.0, 0.0, z]);
        let places = [2.0, 1.0, 0.0].map(place).to_vec();
        let state = State::new(places, vec![0.5; 2], vec![true; 2]);
        let mut stiffness = Stiffness::new(&framework, false).unwrap();
        let residual = Residual::new(&framework, &state);
        let derivative = Derivative::at(&framework, &state, &residual);
        let derivative = derivative.factored(&framework, &mut stiffness, 0.0).unwrap();
        for size in [1.0, 1e-3] {
            let sides = (&[Vector3::zeros(); 3][..], &[size, 0.0][..]);
            let (_, left) =
                derivative.solve(&framework, &mut stiffness, sides, f64::EPSILON, None).unwrap();
            assert!((left - f64::sqrt(0.5)).abs() < 1e-6, "{size}: {left}");
        }
    }
}
