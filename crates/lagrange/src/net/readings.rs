//! How lengths are read: as they are, or, where they overdetermine the shape, the part of them that
//! places decide.
//!
//! The readings are tried from the widest: a shape that is singular within the tolerances of its
//! lengths, and in equilibrium there, is the answer. A line that is nearly taut is not, as nothing
//! bears its load there; it is read as it is.

use model::system::Misfit;

use super::assembly::NEARLY;
use super::decided::{Decided, SHARP, WIDEST, cuts};
use super::framework::Framework;
use super::newton::{Patience, Run, polish};
use super::residual::Residual;
use super::signs::signs_mended;
use super::solution::NO_FORCE;
use super::solve::Solver;
use super::state::State;
use super::weak;
use crate::error::Error;

/// Residual at which misfits are looked at for the first time: they are known to about its square
/// root where motions are weak, and to it elsewhere, and tolerances are 1e-9 and more.
const MISFITS_SEEN: f64 = 1e-10;
/// Self-stresses beyond this multiple of the least forces stiffen nothing more.
const LARGE_STRESS: f64 = 10.0;

impl Solver<'_> {
    /// Newton's method: where lengths overdetermine the shape with the part of them that places
    /// decide, first as far as tolerances allow.
    pub(super) fn with_signs(&mut self, start: State, patience: Patience) -> Result<Run, Error> {
        let mut refused = None;
        // Forces that are far too large hide the loads by their rounding: then once more without them.
        let unborne = State { axial: vec![0.0; start.axial.len()], ..start.clone() };
        for cut in self.cuts(&start) {
            for state in [&start, &unborne] {
                match self.at_cut(state.clone(), patience, cut) {
                    Ok(run) => return Ok(run),
                    Err(error) => refused = Some(clearer(refused, error)),
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
                Err(error) => return Err(clearer(refused, error)),
            },
        };
        // The place it has come to may be singular where the start was not.
        let cuts = self.cuts(&run.state);
        for &cut in &cuts {
            match self.at_cut(run.state.clone(), patience, cut) {
                Ok(run) => return Ok(run),
                Err(error) => refused = Some(clearer(refused, error)),
            }
        }
        match refused {
            Some(error) if cuts.contains(&SHARP) => Err(error),
            _ => Ok(run),
        }
    }

    pub(super) fn cuts(&mut self, state: &State) -> Vec<f64> {
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
        let (framework, stiffness) = (&self.framework, &mut self.stiffness);
        let run = weak::settled(self.system, framework, stiffness, run, Some(&mut decided));
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
        let most =
            LARGE_STRESS * size(&shared.state.axial).max(framework.least_scale(&shared.state));
        let part = (most / size(&stresses).max(most)).min(1.0);
        let mut state = shared.state.clone();
        for (axial, stress) in state.axial.iter_mut().zip(stresses) {
            *axial += part * stress;
        }
        let found =
            polish(framework, stiffness, &self.settings, state, Patience::Full, Some(decided));
        let holds = found.residual.size() <= self.settings.tolerance;
        if holds { found } else { shared }
    }

    /// How far the members that overdetermine a shape are from their lengths there.
    fn misfits(&self, run: &Run, decided: &mut Decided) -> Vec<Misfit> {
        let (framework, unit) = (&self.framework, self.framework.units.length_m);
        let misfit = |member: usize| {
            let link = &framework.links[member];
            let length = framework.whole(member, |span| run.residual.directions[span].1);
            let misfit_m = (length - link.length) * unit;
            Misfit { member, misfit_m, within_m: link.within * unit }
        };
        let mut misfits: Vec<_> = decided.members(framework).into_iter().map(misfit).collect();
        misfits.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
        misfits
    }

    /// Where lengths overdetermine the shape and no basis of self-stresses is at hand, the least
    /// forces; whether they obey the signs and are the ones taken.
    pub(super) fn shared(&mut self, run: &mut Run) -> bool {
        let Some(cut) = self.cuts(&run.state).pop() else { return false };
        let Ok(mut decided) = Decided::new(&self.framework, &run.state, cut) else { return false };
        let mut state = run.state.clone();
        state.axial = decided.share(&self.framework, &state.axial);
        let residual = Residual::within(&self.framework, &state, Some(&mut decided));
        let next = Run { state, residual, steps: 0 };
        let signs = signs_mended(&self.framework, &self.settings, &next, 0.0);
        let pushes = self.framework.pushes(&next.residual.directions, &next.state.axial);
        let pulled = pushes.iter().any(|push| *push < -NO_FORCE * next.residual.unit);
        let holds = next.residual.size() <= self.settings.tolerance && signs.is_none() && !pulled;
        if holds {
            *run = next;
        }
        holds
    }
}

/// A misfit in units of what it may be.
fn ratio(misfit: &Misfit) -> f64 {
    misfit.misfit_m.abs() / misfit.within_m
}

/// Whether misfits are those of lengths that do not fit, not of a search that has gone astray.
pub(super) fn nearly(framework: &Framework, misfits: &[Misfit]) -> bool {
    misfits.iter().all(|misfit| {
        let length_m = framework.links[misfit.member].length * framework.units.length_m;
        misfit.misfit_m.abs() <= misfit.within_m.max(NEARLY * length_m)
    })
}

/// Of two refusals the one that says more: the least misfit of all, before any other.
pub(super) fn clearer(before: Option<Error>, error: Error) -> Error {
    let size = |error: &Error| match error {
        Error::Misfit { misfits } => misfits.first().map_or(0.0, ratio),
        _ => f64::INFINITY,
    };
    match before {
        Some(before) if size(&before) <= size(&error) => before,
        _ => error,
    }
}
