//! The limit of stiff springs where lengths overdetermine the shape.
//!
//! Springs of stiffness `kappa / l` in place of the inextensible members have a minimiser `x` with
//! the forces `kappa e / l`. As `kappa` grows
//!
//! `x -> x*,   kappa e / l = t + kappa W e* + O(1 / kappa)`,
//!
//! with `e*` the misfits that no change of the shape takes up, `Rᵀ W e* = 0`. The part that grows
//! with the stiffness is that of the misfits, and rigid members cannot tell it; the other one is
//! what the loads cause, shared as by equally stiff members. So `x*` and `t` solve
//!
//! `Rᵀ t = load,   t = W R y,   Rᵀ W e(x) = 0`.
//!
//! Each step here is one of the method of multipliers, Newton's method with springs that are stiff
//! already, followed by [`Share`], which removes from the forces the part of the misfits. Balance in
//! the motions that keep the lengths sees the forces of the loads alone.
//!
//! A shape that is within the tolerances of a singular one, as three bars in a plane that hold a
//! joint in space, is read as singular: motions that strain the members by less than some softness
//! are motions. What needs them strained, as a nearly taut line needs its sag, has no equilibrium in
//! that reading, and the next one is less soft.

use std::collections::BTreeSet;
use std::sync::Arc;

use model::system::{Kind, LENGTH_ROUNDING, Misfit};

use crate::error::Error;
use crate::net::frame::{Frame, Rod};
use crate::net::law::Excess;
use crate::net::newton::Newton;
use crate::net::polish::{STIFF_STRAIN, STIFFER, rounding_floor};
use crate::net::shape::{Shape, largest};
use crate::net::share::{Share, Shared, disorder};
use crate::net::stability::DENSE;
use crate::thresholds::{CHANGES, NO_STRAIN, PROGRESS};
use crate::vector::norm;

/// Softness of the first reading, over the tolerance of the lengths: a member of length `l` that is
/// turned by an angle `a` has to be longer by `l a² / 2` and strains by `a` in the motion, so `a²`
/// is of the size of the tolerance. The corrections of [`Share`] make up for a factor of some 1e3.
const SOFT: f64 = 1e4;

/// Softness of the first reading at most: more than that and nothing is rigid.
const SOFTEST: f64 = 1e-2;

/// Softness of the last reading: below it all is rounding.
const HARDEST: f64 = 1e-14;

/// What a self-stress with the floor in it may leave at a joint, over its size. The floor has no tolerance: a bar that leans on it
/// by the angle `a` leaves `a`, and shares nothing with it unless that is rounding.
const LEANING: f64 = 1e-10;

/// A shape that is overdetermined, in one reading of it.
#[derive(Debug, Clone)]
pub(super) struct Limit {
    pub(super) shape: Shape,
    /// Inextensible members that are as long as they can be, whether they bear a force or not.
    pub(super) taut: Vec<bool>,
    /// Self-stress with which the shape is stable although it is not with the forces alone; empty
    /// where none is needed. Rigid members can bear any, and one is enough.
    pub(super) stiffening: Vec<f64>,
    /// The larger of the unbalance and of the misfits that a change of the shape would take up.
    pub(super) residual: f64,
    /// Singular values of the rigidity matrix below this part of the largest are zero.
    pub(super) rank: f64,
    /// Of the members that take part in a self-stress, largest over its tolerance first.
    pub(super) misfits: Vec<Misfit>,
}

impl Limit {
    /// Whether all lengths are within their tolerances.
    pub(super) fn fits(&self) -> bool {
        self.misfits.iter().all(|misfit| misfit.misfit_m.abs() <= misfit.within_m)
    }

    /// How these members share loads at a shape in its reading, where lengths are known to rounding.
    pub(super) fn share(&self, frame: &Frame, shape: &Shape, taut: &[bool]) -> Option<Share> {
        let softness = SOFT * self.rank * self.rank;
        let mut share = Share::new(&Arc::new(frame.clone())).ok()?;
        (frame.is_exact() && share.stand(&shape.x, taut, softness)).then_some(share)
    }

    /// Whether the members that take part in a self-stress are as many as the coordinates of their joints.
    pub(super) fn has_enough(&self, frame: &Frame) -> bool {
        let ends = self.misfits.iter().flat_map(|misfit| {
            let rod = &frame.rods[misfit.member];
            [rod.from, rod.to]
        });
        let joints: BTreeSet<usize> = ends.collect();
        let coordinates = joints.into_iter().map(|joint| frame.spots[joint].freedom);
        self.misfits.len() >= coordinates.sum()
    }

    /// The largest misfit over its tolerance.
    fn ratio(&self) -> f64 {
        self.misfits.first().map_or(0.0, |worst| worst.misfit_m.abs() / worst.within_m)
    }
}

/// What a reading of a shape ends with.
pub(super) enum Reading {
    Found(Limit),
    /// A joint that seemed to lie on the floor is above it, and then nothing is overdetermined.
    Released(Shape),
    /// No equilibrium near the start.
    Astray,
    /// No self-stress: the shape is not overdetermined.
    Regular,
}

impl Frame {
    /// The same with excesses that are linear in the distance.
    fn linear(&self) -> Self {
        let rods = self.rods.iter().map(|rod| Rod { linear: true, ..*rod });
        Self { rods: rods.collect(), ..self.clone() }
    }

    /// The largest tolerance of an inextensible member, over its length.
    fn tolerance(&self) -> f64 {
        let rods = self.rods.iter().filter(|rod| !rod.ground && !rod.elastic());
        rods.map(|rod| rod.within / rod.length).fold(0.0, f64::max)
    }

    /// Whether all lengths are known to rounding: there what no change of the shape takes up is told from what a soft
    /// motion does. Of others springs tell it.
    fn is_exact(&self) -> bool {
        self.tolerance() <= 1.01 * LENGTH_ROUNDING
    }

    /// Inextensible members that are taut within their tolerances, joints on the floor within
    /// rounding, and the elastic members that resist.
    fn touching(&self, shape: &Shape) -> Vec<bool> {
        let rounding = rounding_floor(self, shape);
        let taut = |(e, rod): (usize, &Rod)| {
            let excess = self.excess(&shape.x, e).value;
            let within = if rod.ground { rounding } else { rod.within };
            rod.kind == Kind::Bar
                || rod.resists(shape.force[e])
                || (!rod.elastic() && excess.abs() <= within)
        };
        self.rods.iter().enumerate().map(taut).collect()
    }

    /// The members that keep the shape while their forces are sought: what is just taut would resist.
    fn holding(&self, shape: &Shape, taut: &[bool]) -> Vec<bool> {
        let rounding = rounding_floor(self, shape);
        let holds = |(e, rod): (usize, &Rod)| {
            let just_taut = || self.excess(&shape.x, e).value.abs() <= rounding * rod.length;
            taut[e] || (!rod.elastic() && !rod.ground && just_taut())
        };
        self.rods.iter().enumerate().map(holds).collect()
    }

    /// Whether no joint is below the floor by more than rounding: the floor has no tolerance that a misfit could be
    /// put into.
    fn above_floor(&self, shape: &Shape) -> bool {
        let rounding = rounding_floor(self, shape);
        let mut ground = self.rods.iter().enumerate().filter(|(_, rod)| rod.ground);
        ground.all(|(e, rod)| rod.excess(self.span(&shape.x, e)).value <= rounding)
    }

    /// The part of the forces of the inextensible members that no load causes.
    fn self_stress(&self, share: &mut Share, shape: &Shape) -> Vec<f64> {
        let mut force = shape.force.clone();
        share_forces(self, share, &mut force);
        shape.force.iter().zip(force).map(|(all, part)| all - part).collect()
    }

    /// Whether a self-stress of these members is out of balance at a shape by more than rounding.
    fn leaning(&self, share: &mut Share, shape: &Shape, members: &[bool]) -> bool {
        let size = self.force_scale(&shape.force);
        let any = |(e, stressed): (usize, &bool)| {
            // Without order, so that it has a part of every self-stress.
            if *stressed { size * disorder(e) } else { 0.0 }
        };
        let mut force: Vec<f64> = members.iter().enumerate().map(any).collect();
        self.spread(&mut force);
        let stress = self.self_stress(share, &Shape { x: shape.x.clone(), force });
        let with = self.slope(&stressed(shape, &stress)).unbalance;
        with - self.slope(shape).unbalance > LEANING
    }

    /// The misfits of some members, the worst first.
    fn misfits(&self, excess: &[Excess], members: &[bool]) -> Vec<Misfit> {
        let misfit = |member: usize| Misfit {
            member,
            misfit_m: excess[member].value * self.length_m,
            within_m: self.rods[member].within * self.length_m,
        };
        let mut misfits: Vec<Misfit> =
            (0..self.members).filter(|&e| members[e]).map(misfit).collect();
        let ratio = |misfit: &Misfit| misfit.misfit_m.abs() / misfit.within_m;
        misfits.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
        misfits
    }
}

impl Newton {
    /// The limit at the singular shape next to this one, in the softest reading that has an
    /// equilibrium within the tolerances; else the reading that fits best. [`Reading::Regular`] where
    /// no reading finds a self-stress and an equilibrium. A shape is `exact` where it is a solution
    /// that meets all lengths.
    pub(super) fn limit(&mut self, shape: &Shape, exact: bool) -> Result<Reading, Error> {
        let within = self.frame.tolerance();
        if within <= 0.0 {
            return Ok(Reading::Regular);
        }
        let given = Arc::clone(&self.frame);
        self.frame = Arc::new(given.linear());
        let found = self.readings(shape, within, exact);
        self.frame = given;
        let mut found = found?;
        if let Reading::Found(limit) = &mut found {
            // The force of the other law is that by its own gradient.
            for (e, rod) in self.frame.rods.iter().enumerate() {
                if !rod.elastic() && !rod.ground && rod.rope == 0 {
                    limit.shape.force[e] *= rod.length / norm(self.frame.span(&limit.shape.x, e));
                }
            }
        }
        Ok(found)
    }

    /// The readings from the softest to the hardest.
    fn readings(&mut self, shape: &Shape, within: f64, exact: bool) -> Result<Reading, Error> {
        let mut share = Share::new(&self.frame)?;
        // In large systems no self-stress is named, so forces that have none need no other reading.
        if exact && self.frame.freedom > DENSE && self.determinate(&mut share, shape) {
            return Ok(Reading::Regular);
        }
        let mut softness = (SOFT * within).min(SOFTEST);
        let mut best: Option<Limit> = None;
        while softness >= HARDEST {
            match self.reading(&mut share, shape, softness) {
                Reading::Found(found) if found.fits() => return Ok(Reading::Found(found)),
                Reading::Found(found) => {
                    if best.as_ref().is_none_or(|best| found.ratio() < best.ratio()) {
                        best = Some(found);
                    }
                }
                Reading::Released(shape) => return Ok(Reading::Released(shape)),
                Reading::Regular => break,
                Reading::Astray => {}
            }
            softness *= STIFFER;
        }
        Ok(best.map_or(Reading::Regular, Reading::Found))
    }

    /// Whether the forces of a shape have no part that is a self-stress, down to rounding.
    fn determinate(&self, share: &mut Share, shape: &Shape) -> bool {
        if !share.stand(&shape.x, &self.frame.touching(shape), HARDEST) {
            return false;
        }
        let rest = self.frame.self_stress(share, shape);
        largest(&rest) <= self.settings.tolerance * largest(&shape.force)
    }

    fn reading(&mut self, share: &mut Share, start: &Shape, softness: f64) -> Reading {
        let frame = Arc::clone(&self.frame);
        let mut shape = start.clone();
        let mut taut = frame.touching(&shape);
        if !share.stand(&shape.x, &taut, softness) {
            return Reading::Astray;
        }
        if share.self_stressed().is_none() {
            return Reading::Regular;
        }
        share_forces(&frame, share, &mut shape.force);
        let mut stiffening = Vec::new();
        let mut strain = STIFF_STRAIN;
        let mut last: Option<(f64, Shape)> = None;
        for _ in 0..CHANGES {
            let holding = frame.holding(&shape, &taut);
            if !self.factorise_stiff(
                &stressed(&shape, &stiffening),
                frame.force_scale(&shape.force) / strain,
                &holding,
                0.0,
            ) {
                if strain * STIFFER >= NO_STRAIN {
                    // Pushed members must not buckle in what strains them little, nor because soft springs have let go of
                    // what is just taut: the forces are nearly right now, and the places were.
                    strain *= STIFFER;
                    shape.x.clone_from(&start.x);
                } else if stiffening.is_empty() {
                    stiffening = frame.self_stress(share, start);
                    strain = STIFF_STRAIN;
                } else {
                    return Reading::Astray;
                }
                continue;
            }
            let stiffness = frame.force_scale(&shape.force) / strain;
            // What no change of the shape takes up is no reason to change it.
            let excess = frame.excesses(&shape.x);
            let off =
                if frame.is_exact() { share.in_no_shape(|e| excess[e].value) } else { vec![] };
            shape = self.chord(&shape, stiffness, &holding, &off);
            // Forces of what goes slack are borne by the others before they move anything.
            let Some(changes) = settle_taut(&frame, share, &mut shape, &mut taut, softness) else {
                return Reading::Astray;
            };
            if changes > 0 {
                last = None;
                continue;
            }
            let residual = self.limit_residual(share, &shape, &taut);
            if !residual.is_finite() {
                return Reading::Astray;
            }
            match last {
                Some((before, there)) if residual > PROGRESS * before => {
                    let (residual, mut better) =
                        if residual < before { (residual, shape) } else { (before, there) };
                    if release_floor(&frame, &mut better, &mut taut) {
                        (shape, last) = (better, None);
                        if !share.stand(&shape.x, &taut, softness) {
                            return Reading::Astray;
                        }
                        if share.self_stressed().is_none() {
                            return Reading::Released(shape);
                        }
                        continue;
                    }
                    let shape = better;
                    if residual > self.tolerance(&shape) {
                        return Reading::Astray;
                    }
                    let shape = self.balanced(share, shape, &taut);
                    return self.ended(share, shape, stiffening, residual, softness);
                }
                _ => last = Some((residual, shape.clone())),
            }
        }
        Reading::Astray
    }

    /// A converged reading.
    fn ended(
        &self,
        share: &mut Share,
        shape: Shape,
        stiffening: Vec<f64>,
        residual: f64,
        softness: f64,
    ) -> Reading {
        let taut = self.frame.touching(&shape);
        if !self.frame.above_floor(&shape) || !share.stand(&shape.x, &taut, softness) {
            return Reading::Astray;
        }
        let Some(stressed) = share.self_stressed() else { return Reading::Regular };
        let mut with_floor = self.frame.rods.iter().zip(&stressed);
        if with_floor.any(|(rod, stressed)| rod.ground && *stressed)
            && self.frame.leaning(share, &shape, &stressed)
        {
            return Reading::Astray;
        }
        let misfits = self.frame.misfits(&self.frame.excesses(&shape.x), &stressed);
        let rank = (softness / SOFT).sqrt();
        Reading::Found(Limit { shape, taut, stiffening, residual, rank, misfits })
    }

    /// With what is out of balance borne by these members without soft springs, where that helps: what bends a long truss
    /// strains its members by little, and a soft spring on every joint bears much of it.
    fn balanced(&self, share: &mut Share, shape: Shape, taut: &[bool]) -> Shape {
        let (frame, mut taut) = (&self.frame, taut.to_vec());
        if !share.stand(&shape.x, &taut, HARDEST) {
            return shape;
        }
        let mut exact = shape.clone();
        let left = frame.lagrangian_gradient(&frame.excesses(&shape.x), &shape.force);
        let left: Vec<f64> = left.iter().map(|left| -left).collect();
        for (force, more) in exact.force.iter_mut().zip(share.bearing(&left, None).force) {
            *force += more;
        }
        let ended = settle_taut(frame, share, &mut exact, &mut taut, HARDEST).is_some();
        let better = || frame.slope(&exact).unbalance < frame.slope(&shape).unbalance;
        if ended && better() { exact } else { shape }
    }

    /// The larger of the unbalance and of the strains that a change of the shape would take up.
    fn limit_residual(&self, share: &mut Share, shape: &Shape, taut: &[bool]) -> f64 {
        let frame = &self.frame;
        let excess = frame.excesses(&shape.x);
        let strain = |e: usize| if taut[e] { excess[e].value / frame.rods[e].length } else { 0.0 };
        let springs: Vec<f64> = (0..frame.rods.len()).map(strain).collect();
        let strain = largest(&share.shared(&springs).force);
        let misfits = frame.rods.iter().enumerate().map(|(e, rod)| {
            let misfit = rod.misfit(excess[e].value, shape.force[e]);
            if rod.elastic() {
                misfit
            } else if taut[e] || misfit <= rod.within / rod.length {
                0.0
            } else {
                misfit
            }
        });
        let misfit = misfits.fold(strain, f64::max);
        frame.slope(shape).unbalance.max(misfit)
    }
}

/// A shape with a self-stress besides its forces.
pub(super) fn stressed(shape: &Shape, stress: &[f64]) -> Shape {
    let mut shape = shape.clone();
    for (force, stress) in shape.force.iter_mut().zip(stress) {
        *force += stress;
    }
    shape
}

/// Take out of the forces of the inextensible members what no load causes.
pub(super) fn share_forces(frame: &Frame, share: &mut Share, force: &mut [f64]) {
    let shared = share.shared(force);
    take_shares(frame, &shared, force);
}

/// Let the inextensible members bear their shares.
fn take_shares(frame: &Frame, shared: &Shared, force: &mut [f64]) {
    for (e, rod) in frame.rods.iter().enumerate() {
        if !rod.elastic() {
            force[e] = shared.force[e];
        }
    }
}

/// Change the members that are taut until the shares of forces have the right signs; how often, `None` where that comes to
/// no end.
fn settle_taut(
    frame: &Frame,
    share: &mut Share,
    shape: &mut Shape,
    taut: &mut [bool],
    softness: f64,
) -> Option<usize> {
    // Not what earlier ones bear: a soft spring may have borne what nothing else did.
    let mut borne = None;
    let mut reached: Option<Shared> = None;
    let near = frame.touching(shape);
    for changes in 0..CHANGES {
        if !share.stand(&shape.x, taut, softness) {
            return None;
        }
        let borne = borne.get_or_insert_with(|| share.unshared(&shape.force));
        let next = share.bearing(borne, reached.as_ref());
        let ended = reached.as_mut().is_none_or(|from| from.towards(&next, frame, &near));
        let shared = reached.get_or_insert(next);
        take_shares(frame, shared, &mut shape.force);
        if !change_taut(frame, shape, taut, &shared.stretch, &near) && ended {
            return Some(changes);
        }
    }
    None
}

/// Let go of the floor where it is not reached, by more than rounding; whether there is such a joint.
fn release_floor(frame: &Frame, shape: &mut Shape, taut: &mut [bool]) -> bool {
    let rounding = rounding_floor(frame, shape);
    let mut released = false;
    for (e, rod) in frame.rods.iter().enumerate().filter(|(_, rod)| rod.ground) {
        if taut[e] && rod.excess(frame.span(&shape.x, e)).value < -rounding {
            (taut[e], shape.force[e], released) = (false, 0.0, true);
        }
    }
    released
}

/// Let go of members that work against their kind, and take back those `near` their lengths that would resist; whether there
/// are any.
fn change_taut(
    frame: &Frame,
    shape: &mut Shape,
    taut: &mut [bool],
    stretch: &[f64],
    near: &[bool],
) -> bool {
    let rounding = rounding_floor(frame, shape);
    let least = rounding * frame.force_scale(&shape.force);
    let mut changed = false;
    for (e, rod) in frame.rods.iter().enumerate() {
        if rod.kind == Kind::Bar {
            continue;
        }
        let force = shape.force[e];
        if taut[e] && force.abs() > least && !rod.resists(force) {
            (taut[e], changed) = (false, true);
        } else if !taut[e] {
            let pulls = if rod.elastic() { frame.excess(&shape.x, e).value } else { stretch[e] };
            if near[e] && pulls.abs() > least && rod.resists(pulls)
                || rod.elastic() && rod.prestress(pulls).abs() > least
            {
                (taut[e], changed) = (true, true);
            }
        }
        // What others bear of the force of a rigid one is still to be shared.
        if !taut[e] && rod.elastic() {
            shape.force[e] = 0.0;
        }
    }
    changed
}

#[cfg(test)]
mod tests {
    use model::system::{Joint, Member, System};
    use model::{Bar, Vector};

    use super::*;

    /// A slack strut that is as long as it can be is taken back where it would push, not where it would pull;
    /// and a misfit counts in units of what it may be.
    #[test]
    fn a_strut_that_pushes_is_taken_back() {
        let bar = |length: f64| Bar::homogeneous(length, 1.0).unwrap();
        let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P"), Joint::free("Q")];
        let strut = Member::bar(1, 2, bar(0.5)).of_kind(Kind::Strut);
        let members = vec![Member::bar(0, 1, bar(1.0)), strut];
        let system = System::new("row", 10.0, joints, members).unwrap();
        let frame = Frame::new(&system).unwrap();
        let [x, y, z] = frame.supports[0];
        let (first, second) = (frame.rods[0].length, frame.rods[1].length);
        let at: Vec<Vector> = [0.0, first, first + second].map(|way| [x + way, y, z]).to_vec();
        for (stretch, wanted) in [(-0.5, true), (0.5, false)] {
            let mut shape = Shape { x: at.clone(), force: vec![0.0; 2] };
            let mut taut = [true, false];
            let changed = change_taut(&frame, &mut shape, &mut taut, &[0.0, stretch], &[true; 2]);
            assert_eq!((changed, taut[1]), (wanted, wanted), "{stretch}");
        }
        let limit = Limit {
            shape: Shape { x: at, force: vec![0.0; 2] },
            taut: vec![true; 2],
            stiffening: vec![],
            residual: 0.0,
            rank: 0.0,
            misfits: vec![Misfit { member: 0, misfit_m: -3e-3, within_m: 2e-3 }],
        };
        assert!((limit.ratio() - 1.5).abs() < 1e-15 && !limit.fits());
    }
}
