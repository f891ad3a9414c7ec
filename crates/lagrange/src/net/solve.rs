//! The solve: hang, settle, polish, and look at the second order.

use std::time::Instant;

use model::system::{Kind, Member, System};
use nalgebra::Vector3;

use super::densities::by_densities;
use super::elements;
use super::fitted::fitted_forces;
use super::floor::{above, below, catches, raised};
use super::framework::{Framework, Link};
use super::hanging::{FIRST_END, Hanging, LAST_END, SECOND_END};
use super::jam::joined;
use super::newton::{Patience, Run, with_held};
use super::possible::{check, check_loaded, is_loaded, jammed, too_short};
use super::readings::nearly;
use super::second_order::SecondOrder;
use super::seed::Seed;
use super::settings::Settings;
use super::settle::{FIRST_PENALTY, NEAR_PENALTY, settle};
use super::signs::signs_mended;
use super::solution::{Found, Solution};
use super::state::State;
use super::stiffness::Stiffness;
use crate::error::Error;
use crate::thresholds::{GIVEN, LOOSE, MISDRAWN, ZERO};

/// Tries to leave an unstable equilibrium, each by a small move of every joint.
const ESCAPES: usize = 4;
/// Such moves, in units of the mean length: the next one where the last one led nowhere.
pub(super) const KICKS: [f64; 5] = [0.01, 0.1, 0.5, 1.0, 2.0];

/// How something is solved, and since when.
#[derive(Clone, Copy)]
struct Task<'a> {
    settings: &'a Settings,
    began: Instant,
}

/// The hanging equilibrium of a system: the lowest one where every bar is in tension (then it is
/// the only minimum), and a local minimum of the energy otherwise.
///
/// # Errors
///
/// [`Error`], with numbers: what falls, what does not reach, what did not converge.
pub fn solve(system: &System, settings: &Settings) -> Result<Solution, Error> {
    settings.validate()?;
    let task = Task { settings, began: Instant::now() };
    let framework = Framework::new(system).within(settings.max_work);
    let (work, floor) = (framework.work.clone(), framework.floor(system));
    check_loaded(&framework)?;
    let on_floor = floor.map(|floor| (framework.clone(), floor));
    let solution = above(system, framework, None, settings, |framework| {
        joined(system, framework, |system, framework, _| {
            check(system, &framework)?;
            match by_runs(system, &framework, task) {
                Some(solution) => Ok(solution),
                None => hang(system, framework, task),
            }
        })
    });
    let solution = match (solution, on_floor) {
        (Err(error), Some((framework, floor))) if catches(&error) => {
            caught(system, framework, floor, task).ok_or(error)
        }
        (solution, _) => solution,
    };
    decided(system, work.judged(solution)?)
}

/// By all members at once.
fn hang(system: &System, framework: Framework, task: Task<'_>) -> Result<Solution, Error> {
    if !framework.ropes.is_empty() {
        return from_densities(system, framework, task);
    }
    let mut hanging = Hanging::new(&framework)?;
    let stiffness = Stiffness::new(&framework, false)?;
    let mut solver = Solver::new(system, framework, task, stiffness);
    if let Some((run, second_order)) = solver.lying(&hanging.places) {
        return Ok(solver.solution(run, second_order));
    }
    let mut too_far = false;
    for (end, patience) in
        [(FIRST_END, Patience::Little), (SECOND_END, Patience::Little), (LAST_END, Patience::Full)]
    {
        if end < FIRST_END && end > LAST_END && !too_far {
            continue;
        }
        let before = hanging.steps;
        let reached = hanging.advance(&solver.framework, &mut solver.stiffness, end);
        solver.factorisations += hanging.steps - before;
        if !reached {
            break;
        }
        if end > LAST_END && !hanging.clear(&solver.framework) {
            continue;
        }
        let start = hanging.state(&solver.framework);
        match solver.with_signs(start.clone(), patience) {
            Ok(run) => {
                let second_order = solver.second_order(&run.state);
                if second_order.index == 0 {
                    return Ok(solver.solution(run, second_order));
                }
            }
            Err(_) => too_far = true,
        }
    }
    solver.framework.work.goes_on()?;
    if let Some(error) = too_short(system, &solver.framework) {
        return Err(error);
    }
    let start = hanging.state(&solver.framework);
    let run = match solver.settled(&start, 0) {
        Err(error) => solver.assembled(&start, error)?,
        Ok(run) => run,
    };
    solver.stable(run)
}

/// With ropes over rings and pulleys, which module `hanging` does not know: from force densities to a
/// rest of the true members.
fn from_densities(
    system: &System,
    framework: Framework,
    task: Task<'_>,
) -> Result<Solution, Error> {
    let start = of_densities(&framework)?;
    let stiffness = Stiffness::new(&framework, false)?;
    let mut solver = Solver::new(system, framework, task, stiffness);
    if let Some((run, second_order)) = solver.lying(&start.places) {
        return Ok(solver.solution(run, second_order));
    }
    let run = solver.settled(&start, 0)?;
    solver.stable(run)
}

/// The shape of force densities.
fn of_densities(framework: &Framework) -> Result<State, Error> {
    let (places, densities) = by_densities(framework)?;
    let axial = framework.links.iter().zip(&densities);
    let axial: Vec<f64> = axial.map(|(link, w)| w * link.span(&places).norm()).collect();
    let taut = vec![true; axial.len()];
    Ok(State::new(places, framework.by_link(axial[..framework.members()].to_vec()), taut))
}

/// From a rest above a floor that gives way a little, where laying joints down round by round found nothing.
fn caught(system: &System, framework: Framework, floor: f64, task: Task<'_>) -> Option<Solution> {
    let mut start = of_densities(&framework).ok()?;
    for (place, node) in start.places.iter_mut().zip(&framework.nodes) {
        if place.z < floor {
            *place = raised(node, place, floor);
        }
    }
    let stiffness = Stiffness::new(&framework, false).ok()?;
    let mut solver = Solver::new(system, framework, task, stiffness);
    KICKS.into_iter().enumerate().find_map(|(kick, size)| {
        let state = solver.kicked(&start, kick, size);
        let (framework, stiffness) = (&solver.framework, &mut solver.stiffness);
        let rest = settle(framework, stiffness, state, FIRST_PENALTY, Some(floor));
        if !rest.fits {
            return None;
        }
        let units = framework.units;
        let joints = rest.state.places.iter().zip(&framework.nodes).zip(&rest.lies);
        let joints = joints.map(|((place, node), lies)| {
            let place = if *lies { raised(node, place, floor) } else { *place };
            (place * units.length_m + units.origin_m).into()
        });
        let members = rest.state.axial[..framework.members()].iter();
        let axial_n = Some(members.map(|axial| axial * units.force_n).collect());
        let seed = Seed { axial_n, ..Seed::at(joints.collect()) };
        let framework = framework.clone();
        let found = from_seed(system, framework, rest.lies, &seed, task);
        found.ok().filter(|found| found.equilibrium.stability.index_in_space == 0)
    })
}

/// The equilibrium that Newton's method reaches from a seed, stable or not.
///
/// # Errors
///
/// [`Error`], with numbers.
pub fn solve_from(system: &System, seed: &Seed, settings: &Settings) -> Result<Solution, Error> {
    settings.validate()?;
    seed.check(system)?;
    let task = Task { settings, began: Instant::now() };
    let framework = Framework::new(system).within(settings.max_work);
    let work = framework.work.clone();
    check_loaded(&framework)?;
    let lies = below(system, &framework, seed);
    let solution = from_seed(system, framework, lies, seed, task);
    decided(system, work.judged(solution)?)
}

/// The same, with the joints that lie on the floor first.
fn from_seed(
    system: &System,
    framework: Framework,
    lies: Vec<bool>,
    seed: &Seed,
    task: Task<'_>,
) -> Result<Solution, Error> {
    above(system, framework, Some(lies), task.settings, |framework| {
        joined(system, framework, |system, framework, joined| {
            let seed = joined.map_or_else(
                || seed.clone(),
                |joined| Seed { joints_m: joined.places_m(&seed.joints_m), ..seed.clone() },
            );
            reached(system, framework, &seed, task)
        })
    })
}

/// The same with these joints on the floor.
fn reached(
    system: &System,
    framework: Framework,
    seed: &Seed,
    task: Task<'_>,
) -> Result<Solution, Error> {
    check(system, &framework)?;
    let stiffness = Stiffness::new(&framework, false)?;
    let mut solver = Solver::new(system, framework, task, stiffness);
    let start = solver.start(seed);
    // Without loads the lengths of the shape are all that says what the members bear, and at rest they are right.
    let to_fit = seed.axial_n.is_none() && !seed.at_rest && !system.is_unloaded();
    let drawn = to_fit.then(|| start.clone());
    let start = if to_fit { solver.closed(start) } else { start };
    let one_sided = solver.framework.links.iter().any(|link| link.kind != Kind::Bar);
    let found = match (solver.with_signs(start.clone(), Patience::Full), &drawn) {
        // Bars from far away may be led astray by being closed first.
        (Err(error @ Error::NotConverged { .. }), Some(drawn))
            if !one_sided && start.places != drawn.places =>
        {
            solver.with_signs(drawn.clone(), Patience::Full).map_err(|_| error)
        }
        (found, _) => found,
    };
    let run = match found {
        // With bars alone what a search ends in may be far from the seed. Cables and struts may change to and fro between two
        // sets that are both wrong, where what each holds is not stable.
        Err(error @ Error::NotConverged { .. })
            if one_sided || !solver.framework.ropes.is_empty() || system.is_unloaded() =>
        {
            // From where it comes to rest, unless that is a corner.
            let (framework, stiffness) = (&solver.framework, &mut solver.stiffness);
            let rest = match drawn {
                Some(drawn) => settle(framework, stiffness, drawn, NEAR_PENALTY, None),
                None => settle(framework, stiffness, start, FIRST_PENALTY, None),
            };
            solver.factorisations += rest.factorisations;
            if system.is_unloaded() && rest.fits && is_idle(&solver.framework, &rest.state) {
                return Err(Error::Unloaded);
            }
            let jam = jammed(system, &solver.framework, &rest.state);
            let found = solver.with_signs(rest.state, Patience::Full);
            found.map_err(|_| jam.unwrap_or(error))?
        }
        result => result?,
    };
    let second_order = solver.second_order(&run.state);
    Ok(solver.solution(run, second_order))
}

/// Refuse a rest without loads and without prestress: the shape is one of many.
fn decided(system: &System, solution: Solution) -> Result<Solution, Error> {
    // What is stretched between anchors holds no shape.
    let moves = |m: &Member| m.path().any(|joint| !system.joints()[joint].support.is_fixed());
    let mut members = system.members().iter().zip(&solution.equilibrium.axial_n);
    let mut idle = || {
        members.all(|(m, axial_n)| {
            !moves(m) || m.stiffness_n.is_none_or(|ea| axial_n.abs() <= GIVEN * ea)
        })
    };
    if system.is_unloaded() && idle() { Err(Error::Unloaded) } else { Ok(solution) }
}

/// Whether elastic members that move bear nothing but what a search leaves.
fn is_idle(framework: &Framework, state: &State) -> bool {
    let mut links = framework.links.iter().zip(&state.axial);
    links.all(|(link, axial)| {
        !framework.moves(link) || link.compliance * axial.abs() <= ZERO * link.length
    })
}

/// The hanging equilibrium with runs of members as elements, where that pays and every member
/// pulls. Small systems go without: their self-stresses are counted anyway.
fn by_runs(system: &System, framework: &Framework, task: Task<'_>) -> Option<Solution> {
    if framework.freedoms() <= task.settings.dense_freedoms {
        return None;
    }
    let run = elements::hang(framework)?;
    if run.residual.size().is_nan()
        || run.residual.size() > task.settings.tolerance
        || signs_mended(framework, task.settings, &run, 0.0).is_some()
    {
        return None;
    }
    let second_order = SecondOrder::in_tension(framework, &run.state)?;
    let factorisations = run.steps;
    let found = Found {
        residual: run.residual,
        tolerance: task.settings.tolerance,
        state: run.state,
        factorisations,
        second_order,
        least: false,
        solve_s: task.began.elapsed().as_secs_f64(),
    };
    Some(Solution::new(system, framework, found))
}

/// A solve under way.
pub(super) struct Solver<'a> {
    pub system: &'a System,
    pub settings: Settings,
    pub framework: Framework,
    pub stiffness: Stiffness,
    pub factorisations: usize,
    began: Instant,
}

impl<'a> Solver<'a> {
    fn new(system: &'a System, framework: Framework, task: Task<'_>, stiffness: Stiffness) -> Self {
        let Task { settings, began } = task;
        Self { system, settings: *settings, framework, stiffness, factorisations: 0, began }
    }

    /// An equilibrium near some places in which no member need bear anything, where the floor bears every load.
    fn lying(&mut self, places: &[Vector3<f64>]) -> Option<(Run, SecondOrder)> {
        if self.system.is_unloaded() || is_loaded(&self.framework) {
            return None;
        }
        let run = self.without_forces(places)?;
        // But not what is stretched between anchors.
        let state = with_held(&self.framework, run.state);
        let run = Run { steps: run.steps, ..Run::at(&self.framework, state) };
        let second_order = self.second_order(&run.state);
        Some((run, second_order))
    }

    /// A rest of the true members near a state, moved a little: the shape as cables is often a
    /// saddle of the bars', with bars that have no length in it or lie in one line. Where the
    /// members do not fit from there, it is moved further.
    fn settled(&mut self, from: &State, kick: usize) -> Result<Run, Error> {
        let mut found = Err(Error::Unloaded);
        for (tries, size) in KICKS.into_iter().enumerate() {
            let state = self.kicked(from, kick + tries, size);
            let rest = settle(&self.framework, &mut self.stiffness, state, FIRST_PENALTY, None);
            self.factorisations += rest.factorisations;
            if let (Some(joint), Err(_)) = (rest.lost, &found) {
                let distance_m = rest.state.places[joint].norm() * self.framework.units.length_m;
                let joint = self.system.joints()[joint].name.to_string();
                return Err(Error::Escapes { joint, distance_m });
            }
            let fits = rest.fits;
            let jam = jammed(self.system, &self.framework, &rest.state);
            let result = self.with_signs(rest.state, Patience::Full);
            let never_fits = matches!(&result, Err(Error::Misfit { misfits }) if nearly(&self.framework, misfits));
            if never_fits || (fits && result.is_ok()) {
                return result;
            }
            found = match (result, found) {
                // An equilibrium, if not where it came to rest.
                (Ok(run), _) | (Err(_), Ok(run)) => Ok(run),
                // From elsewhere it may not have run together.
                (Err(_), Err(first @ Error::Jammed(_))) => Err(first),
                (Err(error @ Error::NotConverged { .. }), _) => Err(jam.unwrap_or(error)),
                (Err(error), _) => Err(error),
            };
        }
        found
    }

    /// The state with every joint moved along its free directions, by up to this size.
    pub fn kicked(&self, from: &State, kick: usize, size: f64) -> State {
        let mut state = State::new(from.places.clone(), from.axial.clone(), from.taut.clone());
        let joints = state.places.iter_mut().zip(&self.framework.nodes).enumerate();
        for (joint, (place, node)) in joints {
            *place += node.free.part(&(scatter(joint, kick) * size));
        }
        state
    }

    /// Leave unstable equilibria.
    fn stable(mut self, mut run: Run) -> Result<Solution, Error> {
        let mut kick = 0;
        loop {
            let second_order = self.second_order(&run.state);
            if second_order.index == 0 {
                return Ok(self.solution(run, second_order));
            }
            kick += 1;
            if kick > ESCAPES {
                return Err(Error::Unstable { index: second_order.index });
            }
            run = self.settled(&run.state, kick * KICKS.len())?;
        }
    }

    fn second_order(&mut self, state: &State) -> SecondOrder {
        let dense = self.settings.dense_freedoms;
        SecondOrder::new(&self.framework, &mut self.stiffness, state, dense)
    }

    fn solution(mut self, mut run: Run, second_order: SecondOrder) -> Solution {
        let least = second_order.self_stresses.is_none() && self.shared(&mut run);
        let found = Found {
            residual: run.residual,
            tolerance: self.settings.tolerance,
            state: run.state,
            factorisations: self.factorisations,
            second_order,
            least,
            solve_s: self.began.elapsed().as_secs_f64(),
        };
        Solution::new(self.system, &self.framework, found)
    }

    /// A state whose stiff members have not their lengths by far, moved until they have: forces
    /// fitted to such a shape lead Newton's method astray.
    fn closed(&mut self, state: State) -> State {
        let mut unloaded = state.clone();
        unloaded.axial.fill(0.0);
        let directions = state.directions(&self.framework);
        let mut off = 0.0_f64;
        for (k, link) in self.framework.links.iter().enumerate() {
            let length = self.framework.whole(k, |span| directions[span].1);
            let misfit = (length / link.length - 1.0).abs();
            let stiff = link.compliance <= MISDRAWN * link.length;
            // What is stretched in the drawing by its prestress is as long there as it ought to be.
            let member = &self.system.members()[self.framework.member_of(k)];
            unloaded.taut[k] =
                stiff && member.prestress.is_none() && (link.kind == Kind::Bar || misfit <= LOOSE);
            off = off.max(if unloaded.taut[k] { misfit } else { 0.0 });
        }
        if off <= MISDRAWN {
            return state;
        }
        let units = self.framework.units;
        let places = self.fitted(unloaded).state.places;
        let to_m = |place: &Vector3<f64>| (place * units.length_m + units.origin_m).into();
        self.start(&Seed::at(places.iter().map(to_m).collect()))
    }

    fn start(&mut self, seed: &Seed) -> State {
        let units = self.framework.units;
        let places = self.framework.nodes.iter().zip(&seed.joints_m).map(|(node, at_m)| {
            let given = units.place(*at_m);
            node.base + node.free.part(&(given - node.base))
        });
        let members = self.framework.links.len();
        let mut state = State::new(places.collect(), vec![0.0; members], vec![true; members]);
        let directions = state.directions(&self.framework);
        for (k, link) in self.framework.links.iter().enumerate() {
            // What is said to bear nothing is slack where it is shorter.
            let said = seed.axial_n.as_ref().map(|axial| axial[self.framework.member_of(k)]);
            let known = seed.at_rest || said.is_some_and(|axial| axial.abs() <= 0.0);
            let slack_length = if known { ZERO } else { MISDRAWN };
            let length = self.framework.whole(k, |span| directions[span].1);
            let short = 1.0 - length / link.length;
            state.taut[k] = match link.kind {
                Kind::Bar => true,
                Kind::Cable => short <= slack_length,
                Kind::Strut => -short <= slack_length,
            };
        }
        state.axial = match &seed.axial_n {
            Some(axial_n) => {
                let axial = axial_n.iter().map(|axial| axial / units.force_n);
                self.framework.by_link(axial.collect())
            }
            None if self.system.is_unloaded() => self.prestress(&state),
            None => {
                self.factorisations += 1;
                fitted_forces(&self.framework, &mut self.stiffness, &state)
            }
        };
        for (k, link) in self.framework.links.iter().enumerate() {
            let axial = state.axial[k];
            let pushes = link.kind != Kind::Bar && axial.abs() > 0.0 && !link.bears(axial);
            if pushes || !state.taut[k] {
                (state.taut[k], state.axial[k]) = (false, 0.0);
            }
        }
        state
    }

    /// Forces of the elastic members at their lengths: where no load acts, nothing else says what
    /// the forces are. Inextensible members have none yet.
    fn prestress(&self, state: &State) -> Vec<f64> {
        let directions = state.directions(&self.framework);
        let force = |(k, link): (usize, &Link)| {
            let force = if link.compliance > 0.0 {
                let length = self.framework.whole(k, |span| directions[span].1);
                (length - link.length) / link.compliance
            } else {
                0.0
            };
            if link.bears(force) { force } else { 0.0 }
        };
        self.framework.links.iter().enumerate().map(force).collect()
    }
}

/// A fixed direction for each joint and each try, spread without pattern (golden ratios).
fn scatter(joint: usize, kick: usize) -> Vector3<f64> {
    const STEPS: [f64; 3] =
        [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_897_7];
    let at = (joint * 7 + kick * 13 + 1) as f64;
    Vector3::from(STEPS.map(|step| 2.0 * (at * step).fract() - 1.0))
}
