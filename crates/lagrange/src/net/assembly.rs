//! Places where lengths fit, whatever the forces.

use std::iter;

use model::system::Kind;
use nalgebra::Vector3;

use super::fitted::fitted_forces;
use super::framework::Link;
use super::newton::{Patience, Run};
use super::readings::{clearer, nearly};
use super::signs::{SIGN_CHANGES, signs_mended};
use super::solve::{KICKS, Solver};
use super::state::State;
use crate::error::Error;
use crate::thresholds::HALVINGS;

/// Starts of the search for places where lengths fit, the moves of joints for them in units of the
/// mean length, and the part of its length by which a member may be off where it ends.
const ASSEMBLIES: usize = 60;
const ASSEMBLY_KICK: f64 = 2.0;
pub(super) const NEARLY: f64 = 1e-4;
/// Ridge of the least squares for lengths, in units of their largest error.
const LENGTH_RIDGE: f64 = 0.1;

impl Solver<'_> {
    /// A rest where the lengths fit, from many starts: lengths that overdetermine a shape have many
    /// places where no small move makes them fit better.
    pub(super) fn assembled(&mut self, from: &State, error: Error) -> Result<Run, Error> {
        let mut refused = Some(error);
        let search = match &refused {
            Some(Error::Misfit { misfits }) => !nearly(&self.framework, misfits),
            _ => !self.cuts(from).is_empty(),
        };
        if !search {
            return refused.map_or(Err(Error::Unloaded), Err);
        }
        for kick in 0..ASSEMBLIES {
            let Some(state) = self.fits_at(from, kick) else { continue };
            match self.with_signs(state, Patience::Full) {
                Ok(run) => return Ok(run),
                Err(error) => refused = Some(clearer(refused, error)),
            }
            if matches!(&refused, Some(Error::Misfit { misfits }) if nearly(&self.framework, misfits))
            {
                break;
            }
        }
        Err(refused.unwrap_or(Error::Unloaded))
    }

    /// A start moved to places where the lengths of rigid bars nearly fit, if that leads to any.
    fn fits_at(&mut self, from: &State, kick: usize) -> Option<State> {
        let mut start = from.clone();
        // Only rigid bars have a length whatever they bear.
        let rigid = |link: &Link| link.kind == Kind::Bar && link.compliance <= 0.0;
        start.taut = self.framework.links.iter().map(rigid).collect();
        let fitted = self.fitted(self.strewn(start, kick));
        let mut links = self.framework.links.iter().zip(&fitted.residual.lengths);
        let fits =
            |(link, misfit): (&Link, &f64)| misfit.abs() <= link.within.max(NEARLY * link.length);
        if !links.all(fits) {
            return None;
        }
        let mut state = fitted.state;
        state.taut.clone_from(&from.taut);
        state.axial = fitted_forces(&self.framework, &mut self.stiffness, &state);
        self.factorisations += 1;
        Some(state)
    }

    /// The state with every joint moved along its free directions, each without regard to the others.
    fn strewn(&self, mut state: State, start: usize) -> State {
        let joints = state.places.iter_mut().zip(&self.framework.nodes).enumerate();
        for (joint, (place, node)) in joints {
            let axis = |axis: usize| {
                let word = mixed((joint as u64) << 34 | (start as u64) << 2 | axis as u64);
                ASSEMBLY_KICK * (2.0 * (word as f64 / u64::MAX as f64) - 1.0)
            };
            *place += node.free.part(&Vector3::new(axis(0), axis(1), axis(2)));
        }
        state
    }

    /// Places near some where every member has a length at which it bears no force: with these a
    /// rest, and none has less energy, where no load acts along a free direction.
    pub(super) fn without_forces(&mut self, places: &[Vector3<f64>]) -> Option<Run> {
        let bars = self.framework.links.iter().map(|link| link.kind == Kind::Bar);
        let none = vec![0.0; self.framework.links.len()];
        let start = State::new(places.to_vec(), none, bars.collect());
        let sizes = iter::once(0.0).chain(KICKS).enumerate();
        sizes.into_iter().find_map(|(kick, size)| {
            let mut run = self.fitted(self.kicked(&start, kick, size));
            for _ in 0..SIGN_CHANGES {
                let size = run.residual.size();
                if size.is_nan() || size > self.settings.tolerance {
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
    pub(super) fn fitted(&mut self, state: State) -> Run {
        let mut run = Run::at(&self.framework, state);
        for _ in 0..self.settings.max_iterations {
            if self.framework.work.is_spent() {
                break;
            }
            let step = self.length_step(&run);
            let mut sizes = iter::successors(Some(1.0), |t| Some(0.5 * t)).take(HALVINGS);
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
        self.stiffness
            .assemble_members(&self.framework, |k| (residual.directions[k].0, 0.0, along(k)));
        self.stiffness.shift(LENGTH_RIDGE * residual.length.0);
        self.stiffness.factorise_definite();
        self.factorisations += 1;
        let mut moves = vec![Vector3::zeros(); self.framework.nodes.len()];
        let links = self.framework.links.iter().zip(&residual.directions);
        for ((link, (u, _)), misfit) in links.zip(&residual.lengths) {
            moves[link.from] -= u * *misfit;
            moves[link.to] += u * *misfit;
        }
        self.stiffness.moves(&self.framework, &moves)
    }
}

/// A word without pattern (G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number
/// generators, OOPSLA 2014).
fn mixed(counter: u64) -> u64 {
    let mut word = counter.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}
