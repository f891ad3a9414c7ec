//! Which cables and struts are taut, and forces that are no answer.

use model::system::Kind;

use super::decided::Decided;
use super::framework::{Framework, Link};
use super::newton::{Patience, Run, polish};
use super::settings::Settings;
use super::solution::NO_FORCE;
use super::solve::Solver;
use super::state::State;
use super::weak;
use crate::error::Error;
use crate::thresholds::{ROUNDED, SEEN, ZERO};

/// Changes of the set of taut members before the iteration counts as failed.
pub(super) const SIGN_CHANGES: usize = 30;
/// At the first changes only members that push this part of the worst push, or more, are made
/// slack: that relieves their neighbours. Where all are, along the edge of a net that hangs from
/// its corners, those that ought not come back one by one (12 changes in the place of 2).
const CAREFUL_CHANGES: usize = 4;
const WORST_PUSH: f64 = 0.9;

impl Solver<'_> {
    /// Newton's method, with the set of taut members changed until all signs are right.
    pub(super) fn at_signs(
        &mut self,
        mut state: State,
        patience: Patience,
        mut decided: Option<&mut Decided>,
    ) -> Result<Run, Error> {
        let settings = self.settings;
        let one_sided = self.framework.links.iter().any(|link| link.kind != Kind::Bar);
        let mut tight = !one_sided;
        for change in 0..SIGN_CHANGES {
            let tolerance = if tight { settings.tolerance } else { settings.tolerance.max(SEEN) };
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
                None if tight => {
                    let run = if decided.is_none() {
                        weak::settled(self.system, &self.framework, &mut self.stiffness, run, None)
                    } else {
                        run
                    };
                    return self.not_absurd(run);
                }
                None => {
                    tight = true;
                    run.state
                }
            };
        }
        let run = Run::at(&self.framework, state);
        Err(run.residual.not_converged(self.system, &self.framework, self.factorisations))
    }

    /// Refuse forces that only rounding decides.
    fn not_absurd(&self, run: Run) -> Result<Run, Error> {
        let (framework, axial) = (&self.framework, &run.state.axial);
        let elastic = framework.links.iter().zip(axial).filter(|(link, _)| link.compliance > 0.0);
        let borne = elastic.map(|(_, axial)| axial.abs());
        let loads = framework.nodes.iter().map(|node| node.load.norm());
        let scale = borne.chain(loads).fold(framework.least_scale(&run.state), f64::max);
        let worst = (0..axial.len()).max_by(|a, b| axial[*a].abs().total_cmp(&axial[*b].abs()));
        // Of forces beside which the loads are nothing the rounding is 1e-7 of these and more, which the places of near
        // joints multiply.
        match worst {
            Some(member) if ZERO * axial[member].abs() > scale => Err(Error::Absurd {
                member: framework.member_of(member) + 1,
                force_n: axial[member] * framework.units.force_n,
                ratio: axial[member].abs() / scale,
            }),
            _ => Ok(run),
        }
    }
}

/// The state with cables that push made slack and slack ones that are too long made taut,
/// struts the other way round; nothing when there are none. Of those that push only the ones that
/// push at least this share of the worst.
pub(super) fn signs_mended(
    framework: &Framework,
    settings: &Settings,
    run: &Run,
    share: f64,
) -> Option<State> {
    let state = &run.state;
    // Of what is elastic the length says whether it bears a force.
    let least = |link: &Link| {
        let none = if link.compliance > 0.0 { ROUNDED } else { NO_FORCE };
        none.max(run.residual.size()) * run.residual.unit
    };
    let longer = settings.tolerance.max(run.residual.size());
    let wrong = |(k, link): (usize, &Link)| {
        if link.kind == Kind::Bar {
            return None;
        }
        let axial = state.axial[k];
        let length = framework.whole(k, |span| run.residual.directions[span].1);
        let excess = length - link.length;
        let outside = if link.kind == Kind::Cable { excess } else { -excess };
        let pushes = state.taut[k] && axial.abs() > least(link) && !link.bears(axial);
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
