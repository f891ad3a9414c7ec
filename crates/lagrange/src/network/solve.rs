//! The solve: hang, settle, polish, and look at the second order.

use std::iter;
use std::time::Instant;

use model::system::{Kind, Misfit, System};
use nalgebra::Vector3;

use super::decided::{Decided, SHARP, WIDEST, cuts};
use super::elements;
use super::error::Error;
use super::floor::{above, below};
use super::framework::{Framework, Link};
use super::hanging::{FIRST_END, Hanging, LAST_END, SECOND_END};
use super::law::by_direction;
use super::newton::{Patience, Run, polish};
use super::residual::Residual;
use super::possible::{check, check_loaded, is_loaded, too_short};
use super::second_order::SecondOrder;
use super::seed::Seed;
use super::settings::Settings;
use super::settle::settle;
use super::solution::{Found, NO_FORCE, Solution};
use super::state::State;
use super::stiffness::Stiffness;

/// Changes of the set of taut members before the iteration counts as failed.
const SIGN_CHANGES: usize = 30;
/// Residual at which signs are looked at for the first time: far above rounding, so that a wrong
/// one costs few steps, and far below the forces that are likely.
const SIGNS_SEEN: f64 = 1e-6;
/// At the first changes only members that push this part of the worst push, or more, are made
/// slack: that relieves their neighbours. Where all are, along the edge of a net that hangs from
/// its corners, those that ought not come back one by one (12 changes in the place of 2).
const CAREFUL_CHANGES: usize = 4;
const WORST_PUSH: f64 = 0.9;
/// Forces of this many times the loads have a rounding of 1e-7 of these and more, which the places
/// of near joints multiply.
const ABSURD: f64 = 1e9;
/// Residual at which misfits are looked at for the first time: they are known to about its square
/// root where motions are weak, and to it elsewhere, and tolerances are 1e-9 and more.
const MISFITS_SEEN: f64 = 1e-10;
/// Starts of the search for places where lengths fit, the moves of joints for them in units of the
/// mean length, and the part of its length by which a member may be off where it ends.
const ASSEMBLIES: usize = 60;
const ASSEMBLY_KICK: f64 = 2.0;
const NEARLY: f64 = 1e-4;
/// Self-stresses beyond this multiple of the least forces stiffen nothing more.
const LARGE_STRESS: f64 = 10.0;
/// A cable shorter than this part of its length is slack at the start.
const SLACK_LENGTH: f64 = 1e-3;
/// Tries to leave an unstable equilibrium, each by a small move of every joint.
const ESCAPES: usize = 4;
/// Such moves, in units of the mean length: the next one where the last one led nowhere.
const KICKS: [f64; 5] = [0.01, 0.1, 0.5, 1.0, 2.0];
/// Ridge of the least squares for lengths, in units of their largest error.
const LENGTH_RIDGE: f64 = 0.1;
/// A step of these is halved at most so many times.
const LENGTH_HALVINGS: i32 = 24;
/// A system without loads whose elastic members all bear less than this part of their stiffness is
/// not prestressed: that much is rounding.
const NO_STRAIN: f64 = 1e-12;
/// Ridge of the least squares for the forces of a seed, in units of the stiffness.
const RIDGE: f64 = 1e-9;

/// The hanging equilibrium of a system: the lowest one where every bar is in tension (then it is
/// the only minimum), and a local minimum of the energy otherwise.
///
/// # Errors
///
/// [`Error`], with numbers: what falls, what does not reach, what did not converge.
pub fn solve(system: &System, settings: &Settings) -> Result<Solution, Error> {
    settings.validate()?;
    let began = Instant::now();
    let framework = Framework::new(system);
    check_loaded(&framework)?;
    let solution = above(system, framework, None, settings, |framework| {
        check(system, &framework)?;
        match by_runs(system, &framework, settings, began) {
            Some(solution) => Ok(solution),
            None => hang(system, framework, settings, began),
        }
    })?;
    decided(system, solution)
}

/// By all members at once.
fn hang(
    system: &System,
    framework: Framework,
    settings: &Settings,
    began: Instant,
) -> Result<Solution, Error> {
    let mut hanging = Hanging::new(&framework)?;
    let stiffness = Stiffness::new(&framework, false)?;
    let mut solver = Solver::new(system, framework, *settings, stiffness, began);
    if !system.is_unloaded() && !is_loaded(&solver.framework) {
        // The floor bears every load.
        if let Some(run) = solver.without_forces(hanging.places()) {
            let second_order = solver.second_order(&run.state);
            return Ok(solver.solution(run, second_order));
        }
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
        match solver.with_signs(hanging.state(&solver.framework), patience) {
            Ok(run) => {
                let second_order = solver.second_order(&run.state);
                if second_order.index == 0 {
                    return Ok(solver.solution(run, second_order));
                }
            }
            Err(_) => too_far = true,
        }
    }
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

/// The equilibrium that Newton's method reaches from a seed, stable or not.
///
/// # Errors
///
/// [`Error`], with numbers.
pub fn solve_from(system: &System, seed: &Seed, settings: &Settings) -> Result<Solution, Error> {
    settings.validate()?;
    seed.check(system)?;
    let began = Instant::now();
    let framework = Framework::new(system);
    check_loaded(&framework)?;
    let lies = below(system, &framework, &seed.joints_m);
    let solution = above(system, framework, Some(lies), settings, |framework| {
        check(system, &framework)?;
        let stiffness = Stiffness::new(&framework, false)?;
        let mut solver = Solver::new(system, framework, *settings, stiffness, began);
        let start = solver.start(seed);
        let run = solver.with_signs(start, Patience::Full)?;
        let second_order = solver.second_order(&run.state);
        Ok(solver.solution(run, second_order))
    })?;
    decided(system, solution)
}

/// Refuse a rest without loads and without prestress: the shape is one of many.
fn decided(system: &System, solution: Solution) -> Result<Solution, Error> {
    let members = || system.members().iter().zip(&solution.equilibrium.axial_n);
    let idle = || {
        members().all(|(m, axial_n)| m.stiffness_n.is_none_or(|ea| axial_n.abs() <= NO_STRAIN * ea))
    };
    if system.is_unloaded() && idle() { Err(Error::Unloaded) } else { Ok(solution) }
}

/// The hanging equilibrium with runs of members as elements, where that pays and every member
/// pulls. Small systems go without: their self-stresses are counted anyway.
fn by_runs(
    system: &System,
    framework: &Framework,
    settings: &Settings,
    began: Instant,
) -> Option<Solution> {
    if framework.freedoms() <= settings.dense_freedoms {
        return None;
    }
    let run = elements::hang(framework)?;
    if run.residual.size().is_nan()
        || run.residual.size() > settings.tolerance
        || signs_mended(framework, settings, &run, 0.0).is_some()
    {
        return None;
    }
    let second_order = SecondOrder::in_tension(framework, &run.state)?;
    let factorisations = run.steps;
    let found = Found {
        residual: run.residual,
        tolerance: settings.tolerance,
        state: run.state,
        factorisations,
        second_order,
        least: false,
        solve_s: began.elapsed().as_secs_f64(),
    };
    Some(Solution::new(system, framework, found))
}

struct Solver<'a> {
    system: &'a System,
    settings: Settings,
    framework: Framework,
    stiffness: Stiffness,
    factorisations: usize,
    began: Instant,
}

impl<'a> Solver<'a> {
    fn new(
        system: &'a System,
        framework: Framework,
        settings: Settings,
        stiffness: Stiffness,
        began: Instant,
    ) -> Self {
        Self { system, settings, framework, stiffness, factorisations: 0, began }
    }

    /// Newton's method: where lengths overdetermine the shape with the part of them that places
    /// decide, first as far as tolerances allow.
    fn with_signs(&mut self, start: State, patience: Patience) -> Result<Run, Error> {
        let mut refused = None;
        for cut in self.cuts(&start) {
            // Misfits may have become forces on the way here: then once more without them.
            let mut afresh = start.clone();
            let mut decided = Decided::new(&self.framework, &start, cut)?;
            afresh.axial = decided.bear(&self.framework, &start.axial);
            for state in [start.clone(), afresh] {
                match self.at_cut(state, patience, cut) {
                    Ok(run) => return Ok(run),
                    Err(error) => refused = clearer(refused, error),
                }
                if matches!(refused, Some(Error::Misfit { .. })) {
                    break;
                }
            }
        }
        let overdetermined = refused.is_some();
        let run = match self.at_signs(start.clone(), patience, None) {
            Ok(run) => run,
            Err(error) if !overdetermined => return Err(error),
            // A flat frame whose lengths are far off is at best flat.
            Err(_) => match self.at_cut(start, patience, WIDEST) {
                Ok(run) => return Ok(run),
                Err(error) => return Err(clearer(refused, error).unwrap_or(Error::Unloaded)),
            },
        };
        // The place it has come to may be singular where the start was not.
        let cuts = self.cuts(&run.state);
        for &cut in &cuts {
            let mut state = run.state.clone();
            state.axial = Decided::new(&self.framework, &state, cut)?.share(&self.framework, &state.axial);
            match self.at_cut(state, patience, cut) {
                Ok(run) => return Ok(run),
                Err(error) => refused = clearer(refused, error),
            }
        }
        match refused {
            Some(error) if cuts.contains(&SHARP) => Err(error),
            _ => Ok(run),
        }
    }

    fn cuts(&mut self, state: &State) -> Vec<f64> {
        let (cuts, factorisations) = cuts(&self.framework, &mut self.stiffness, state);
        self.factorisations += factorisations;
        cuts
    }

    /// The same at one cut; refused where lengths are off by more than their tolerances.
    fn at_cut(&mut self, state: State, patience: Patience, cut: f64) -> Result<Run, Error> {
        let mut decided = Decided::new(&self.framework, &state, cut)?;
        // Misfits show long before rounding.
        let settings = self.settings;
        self.settings.tolerance = settings.tolerance.max(MISFITS_SEEN);
        let near = self.at_signs(state, patience, Some(&mut decided));
        self.settings = settings;
        let near = self.fitting(near?, &mut decided)?;
        let run = self.at_signs(near.state, patience, Some(&mut decided))?;
        let run = self.at_share(run, &mut decided);
        self.fitting(run, &mut decided)
    }

    /// Refuse a shape where lengths are off by more than their tolerances.
    fn fitting(&self, run: Run, decided: &mut Decided) -> Result<Run, Error> {
        decided.renew(&self.framework, &run.state);
        let misfits = self.misfits(&run, decided);
        let fits = misfits.iter().all(|misfit| misfit.misfit_m.abs() <= misfit.within_m);
        if fits { Ok(run) } else { Err(Error::Misfit { misfits }) }
    }

    /// The same equilibrium where the least forces are in balance as well. Near a singular shape
    /// the ones found, with their self-stresses, balance a little beside it.
    fn at_share(&mut self, run: Run, decided: &mut Decided) -> Run {
        let mut state = run.state.clone();
        decided.renew(&self.framework, &state);
        state.axial = decided.share(&self.framework, &state.axial);
        let (framework, stiffness) = (&self.framework, &mut self.stiffness);
        let shared =
            polish(framework, stiffness, &self.settings, state, Patience::Full, Some(decided));
        self.factorisations += shared.steps;
        if shared.residual.size().is_nan() || shared.residual.size() > self.settings.tolerance {
            return run;
        }
        // Self-stresses count at the second order: those that were found stay, as long as the least
        // forces are not rounded off beside them.
        decided.renew(framework, &shared.state);
        let least = decided.share(framework, &run.state.axial);
        let stresses = run.state.axial.iter().zip(least).map(|(found, least)| found - least);
        let stresses: Vec<f64> = stresses.collect();
        let size = |forces: &[f64]| forces.iter().fold(0.0_f64, |most, t| most.max(t.abs()));
        let most = LARGE_STRESS * size(&shared.state.axial).max(framework.least_scale(&shared.state));
        let part = (most / size(&stresses).max(most)).min(1.0);
        let mut state = shared.state.clone();
        for (axial, stress) in state.axial.iter_mut().zip(stresses) {
            *axial += part * stress;
        }
        let found = polish(framework, stiffness, &self.settings, state, Patience::Full, Some(decided));
        let holds = found.residual.size() <= self.settings.tolerance;
        if holds { found } else { shared }
    }

    /// How far the members that overdetermine a shape are from their lengths there.
    fn misfits(&self, run: &Run, decided: &mut Decided) -> Vec<Misfit> {
        let (framework, unit) = (&self.framework, self.framework.units.length_m);
        let misfit = |member: usize| {
            let link = &framework.links[member];
            let misfit_m = (run.residual.directions[member].1 - link.length) * unit;
            Misfit { member, misfit_m, within_m: link.within * unit }
        };
        let mut misfits: Vec<_> = decided.members(framework).into_iter().map(misfit).collect();
        misfits.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
        misfits
    }

    /// Refuse forces that only rounding decides.
    fn not_absurd(&self, run: Run) -> Result<Run, Error> {
        let (framework, axial) = (&self.framework, &run.state.axial);
        let elastic = framework.links.iter().zip(axial).filter(|(link, _)| link.compliance > 0.0);
        let borne = elastic.map(|(_, axial)| axial.abs());
        let loads = framework.nodes.iter().map(|node| node.load.norm());
        let scale = borne.chain(loads).fold(framework.least_scale(&run.state), f64::max);
        let worst = (0..axial.len()).max_by(|a, b| axial[*a].abs().total_cmp(&axial[*b].abs()));
        match worst {
            Some(member) if axial[member].abs() > ABSURD * scale => Err(Error::Absurd {
                member,
                force_n: axial[member] * framework.units.force_n,
                ratio: axial[member].abs() / scale,
            }),
            _ => Ok(run),
        }
    }

    /// Newton's method, with the set of taut members changed until all signs are right.
    fn at_signs(
        &mut self,
        mut state: State,
        patience: Patience,
        mut decided: Option<&mut Decided>,
    ) -> Result<Run, Error> {
        let settings = self.settings;
        let one_sided = self.framework.links.iter().any(|link| link.kind != Kind::Bar);
        let mut tight = !one_sided;
        for change in 0..SIGN_CHANGES {
            let tolerance =
                if tight { settings.tolerance } else { settings.tolerance.max(SIGNS_SEEN) };
            let settings = Settings { tolerance, ..settings };
            if let Some(decided) = decided.as_deref_mut() {
                decided.renew(&self.framework, &state);
            }
            let run = polish(
                &self.framework,
                &mut self.stiffness,
                &settings,
                state,
                patience,
                decided.as_deref_mut(),
            );
            self.factorisations += run.steps;
            if run.residual.size().is_nan() || run.residual.size() > tolerance {
                let (system, framework) = (self.system, &self.framework);
                return Err(run.residual.not_converged(system, framework, self.factorisations));
            }
            let share = if change < CAREFUL_CHANGES { WORST_PUSH } else { 0.0 };
            state = match signs_mended(&self.framework, &self.settings, &run, share) {
                Some(next) => next,
                None if tight => return self.not_absurd(run),
                None => {
                    tight = true;
                    run.state
                }
            };
        }
        let run = Run::at(&self.framework, state);
        Err(run.residual.not_converged(self.system, &self.framework, self.factorisations))
    }

    /// A rest of the true members near a state, moved a little: the shape as cables is often a
    /// saddle of the bars', with bars that have no length in it or lie in one line. Where the
    /// members do not fit from there, it is moved further.
    fn settled(&mut self, from: &State, kick: usize) -> Result<Run, Error> {
        let mut result = Err(Error::Unloaded);
        for (tries, size) in KICKS.into_iter().enumerate() {
            let state = self.kicked(from, kick + tries, size);
            let rest = settle(&self.framework, &mut self.stiffness, state);
            self.factorisations += rest.factorisations;
            if let Some(joint) = rest.lost {
                let distance_m = rest.state.places[joint].norm() * self.framework.units.length_m;
                let joint = self.system.joints()[joint].name.clone();
                return Err(Error::Escapes { joint, distance_m });
            }
            let fits = rest.fits;
            result = self.with_signs(rest.state, Patience::Full);
            if fits && result.is_ok() {
                break;
            }
        }
        result
    }

    /// A rest where the lengths fit, from many starts: lengths that overdetermine a shape have many
    /// places where no small move makes them fit better.
    fn assembled(&mut self, from: &State, error: Error) -> Result<Run, Error> {
        let mut refused = Some(error);
        if self.cuts(from).is_empty() && !matches!(refused, Some(Error::Misfit { .. })) {
            return refused.map_or(Err(Error::Unloaded), Err);
        }
        let mut start = from.clone();
        // Only rigid bars have a length whatever they bear.
        let rigid = |link: &Link| link.kind == Kind::Bar && link.compliance <= 0.0;
        start.taut = self.framework.links.iter().map(rigid).collect();
        for kick in 0..ASSEMBLIES {
            let fitted = self.fitted(self.kicked(&start, kick, ASSEMBLY_KICK));
            let links = self.framework.links.iter().zip(&fitted.residual.lengths);
            let fits = |(link, misfit): (&Link, &f64)| {
                misfit.abs() <= link.within.max(NEARLY * link.length)
            };
            if !links.into_iter().all(fits) {
                continue;
            }
            let mut state = fitted.state;
            state.taut.clone_from(&from.taut);
            state.axial = self.best_forces(&state);
            match self.with_signs(state, Patience::Full) {
                Ok(run) => return Ok(run),
                Err(error) => refused = clearer(refused, error),
            }
            if matches!(&refused, Some(Error::Misfit { misfits }) if nearly(misfits)) {
                break;
            }
        }
        Err(refused.unwrap_or(Error::Unloaded))
    }

    /// Places near some where every member has a length at which it bears no force: with these a
    /// rest, and none has less energy, where no load acts along a free direction.
    fn without_forces(&mut self, places: &[Vector3<f64>]) -> Option<Run> {
        let bars = self.framework.links.iter().map(|link| link.kind == Kind::Bar);
        let none = vec![0.0; self.framework.links.len()];
        let start = State::new(places.to_vec(), none, bars.collect());
        let sizes = iter::once(0.0).chain(KICKS).enumerate();
        sizes.into_iter().find_map(|(kick, size)| {
            let mut run = self.fitted(self.kicked(&start, kick, size));
            for _ in 0..SIGN_CHANGES {
                if run.residual.size() > self.settings.tolerance {
                    return None;
                }
                match signs_mended(&self.framework, &self.settings, &run, 0.0) {
                    Some(next) => run = self.fitted(next),
                    None => return Some(run),
                }
            }
            None
        })
    }

    /// The lengths alone, by least squares (Levenberg and Marquardt): where they say nothing about
    /// a direction no joint moves along it.
    fn fitted(&mut self, state: State) -> Run {
        let mut run = Run::at(&self.framework, state);
        for _ in 0..self.settings.max_iterations {
            let step = self.length_step(&run);
            let mut sizes = (0..LENGTH_HALVINGS).map(|k| 0.5_f64.powi(k));
            let better = sizes.find_map(|t| {
                let next = Run::at(&self.framework, run.state.moved(&step, t));
                (next.residual.merit < run.residual.merit).then_some(next)
            });
            let Some(better) = better else { break };
            run = better;
        }
        run
    }

    /// One step towards the lengths of the taut members. The ridge falls with the error, so that
    /// steps become Newton's, also where two places with the right lengths are about to meet.
    fn length_step(&mut self, run: &Run) -> Vec<Vector3<f64>> {
        let residual = &run.residual;
        let along = |k: usize| f64::from(u8::from(run.state.taut[k]));
        let directions = residual.directions.iter().enumerate();
        let blocks = directions.map(|(k, (u, _))| by_direction(u, 0.0, along(k)));
        self.stiffness.assemble(&self.framework, blocks);
        self.stiffness.shift(LENGTH_RIDGE * residual.length.0);
        self.stiffness.factorise_definite();
        self.factorisations += 1;
        let mut moves = vec![Vector3::zeros(); self.framework.nodes.len()];
        let links = self.framework.links.iter().zip(&residual.directions);
        for ((link, (u, _)), misfit) in links.zip(&residual.lengths) {
            moves[link.from] -= u * *misfit;
            moves[link.to] += u * *misfit;
        }
        let mut moves = self.stiffness.gather(&self.framework, &moves);
        self.stiffness.solve(&mut moves);
        self.stiffness.scatter(&self.framework, &moves)
    }

    /// The state with every joint moved along its free directions, by up to this size.
    fn kicked(&self, from: &State, kick: usize, size: f64) -> State {
        let mut state = State::new(from.places.clone(), from.axial.clone(), from.taut.clone());
        let joints = state.places.iter_mut().zip(&self.framework.nodes).enumerate();
        for (joint, (place, node)) in joints {
            *place += node.free.part(&(scatter(joint, kick) * size));
        }
        state
    }

    /// Leave unstable equilibria.
    fn stable(mut self, mut run: Run) -> Result<Solution, Error> {
        let mut second_order = self.second_order(&run.state);
        for kick in 1..=ESCAPES {
            if second_order.index == 0 {
                return Ok(self.solution(run, second_order));
            }
            run = self.settled(&run.state, kick * KICKS.len())?;
            second_order = self.second_order(&run.state);
        }
        if second_order.index == 0 {
            return Ok(self.solution(run, second_order));
        }
        Err(Error::Unstable { index: second_order.index })
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

    /// Where lengths overdetermine the shape and no basis of self-stresses is at hand, the least
    /// forces; whether they obey the signs and are the ones taken.
    fn shared(&mut self, run: &mut Run) -> bool {
        let Some(cut) = self.cuts(&run.state).pop() else { return false };
        let Ok(mut decided) = Decided::new(&self.framework, &run.state, cut) else { return false };
        let mut state = run.state.clone();
        state.axial = decided.share(&self.framework, &state.axial);
        let residual = Residual::within(&self.framework, &state, Some(&mut decided));
        let next = Run { state, residual, steps: 0 };
        let signs = signs_mended(&self.framework, &self.settings, &next, 0.0);
        let directions = next.residual.directions.iter().map(|(u, _)| u);
        let pushes = self.framework.pushes(directions, &next.state.axial);
        let pulled = pushes.iter().any(|push| *push < -NO_FORCE * next.residual.unit);
        let holds = next.residual.size() <= self.settings.tolerance && signs.is_none() && !pulled;
        if holds {
            *run = next;
        }
        holds
    }

    /// The state of a seed.
    fn start(&mut self, seed: &Seed) -> State {
        let units = self.framework.units;
        let places = self.framework.nodes.iter().zip(&seed.joints_m).map(|(node, at_m)| {
            let given = (Vector3::from(*at_m) - units.origin_m) / units.length_m;
            node.base + node.free.part(&(given - node.base))
        });
        let members = self.framework.links.len();
        let mut state = State::new(places.collect(), vec![0.0; members], vec![true; members]);
        state.axial = match &seed.axial_n {
            Some(axial_n) => axial_n.iter().map(|axial| axial / units.force_n).collect(),
            None if self.system.is_unloaded() => self.prestress(&state),
            None => self.best_forces(&state),
        };
        let directions = state.directions(&self.framework);
        for (k, link) in self.framework.links.iter().enumerate() {
            let short = 1.0 - directions[k].1 / link.length;
            let slack = match link.kind {
                Kind::Bar => false,
                Kind::Cable => short > SLACK_LENGTH || state.axial[k] < 0.0,
                Kind::Strut => -short > SLACK_LENGTH || state.axial[k] > 0.0,
            };
            if slack {
                (state.taut[k], state.axial[k]) = (false, 0.0);
            }
        }
        state
    }

    /// Forces of the elastic members at their lengths: where no load acts, nothing else says what
    /// the forces are. Inextensible members have none yet.
    fn prestress(&self, state: &State) -> Vec<f64> {
        let directions = state.directions(&self.framework);
        let force = |(link, (_, distance)): (&Link, &(Vector3<f64>, f64))| {
            let force = if link.compliance > 0.0 {
                (distance - link.length) / link.compliance
            } else {
                0.0
            };
            if link.bears(force) { force } else { 0.0 }
        };
        self.framework.links.iter().zip(&directions).map(force).collect()
    }

    /// Axial forces that leave the joints least out of balance.
    fn best_forces(&mut self, state: &State) -> Vec<f64> {
        let directions = state.directions(&self.framework);
        let blocks = directions.iter().map(|(u, _)| by_direction(u, 0.0, 1.0));
        self.stiffness.assemble(&self.framework, blocks);
        self.stiffness.shift(RIDGE);
        self.stiffness.factorise_definite();
        self.factorisations += 1;
        let loads: Vec<_> = self.framework.nodes.iter().map(|node| node.load).collect();
        let mut moves = self.stiffness.gather(&self.framework, &loads);
        self.stiffness.solve(&mut moves);
        let moves = self.stiffness.scatter(&self.framework, &moves);
        let links = self.framework.links.iter().zip(&directions);
        links.map(|(link, (u, _))| u.dot(&link.span(&moves))).collect()
    }
}

/// A misfit in units of what it may be.
fn ratio(misfit: &Misfit) -> f64 {
    misfit.misfit_m.abs() / misfit.within_m
}

/// Whether misfits are those of lengths that do not fit, not of a search that has gone astray.
fn nearly(misfits: &[Misfit]) -> bool {
    misfits.iter().all(|misfit| {
        misfit.misfit_m.abs() <= misfit.within_m * (NEARLY / model::system::LENGTH_ROUNDING)
    })
}

/// Of two refusals the one that says more: the least misfit of all, before any other.
fn clearer(before: Option<Error>, error: Error) -> Option<Error> {
    let size = |error: &Error| match error {
        Error::Misfit { misfits } => misfits.first().map_or(0.0, ratio),
        _ => f64::INFINITY,
    };
    Some(match before {
        Some(before) if size(&before) <= size(&error) => before,
        _ => error,
    })
}

/// The state with cables that push made slack and slack ones that are too long made taut,
/// struts the other way round; nothing when there are none. Of those that push only the ones that
/// push at least this share of the worst.
fn signs_mended(
    framework: &Framework,
    settings: &Settings,
    run: &Run,
    share: f64,
) -> Option<State> {
    let state = &run.state;
    let least = NO_FORCE.max(run.residual.size()) * run.residual.unit;
    let longer = settings.tolerance.max(run.residual.size());
    let wrong = |(k, link): (usize, &Link)| {
        if link.kind == Kind::Bar {
            return None;
        }
        let axial = state.axial[k];
        let excess = run.residual.directions[k].1 - link.length;
        let outside = if link.kind == Kind::Cable { excess } else { -excess };
        let pushes = state.taut[k] && axial.abs() > least && !link.bears(axial);
        let reaches = !state.taut[k] && outside > longer * link.length;
        (pushes || reaches).then_some(k)
    };
    let wrong: Vec<usize> = framework.links.iter().enumerate().filter_map(wrong).collect();
    if wrong.is_empty() {
        return None;
    }
    let pushing = wrong.iter().filter(|k| state.taut[**k]);
    let enough = share * pushing.map(|k| state.axial[*k].abs()).fold(0.0, f64::max);
    let mut state = state.clone();
    for k in wrong {
        if state.taut[k] && state.axial[k].abs() < enough {
            continue;
        }
        state.taut[k] = !state.taut[k];
        if !state.taut[k] {
            state.axial[k] = 0.0;
        }
    }
    Some(state)
}

/// A fixed direction for each joint and each try, spread without pattern (golden ratios).
fn scatter(joint: usize, kick: usize) -> Vector3<f64> {
    const STEPS: [f64; 3] =
        [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_897_7];
    let at = (joint * 7 + kick * 13 + 1) as f64;
    Vector3::from(STEPS.map(|step| 2.0 * (at * step).fract() - 1.0))
}
