//! What the lengths of inextensible members decide, where there are more than the shape needs.
//!
//! With the rows $R$ of the taut inextensible members and $L$ their lengths, errors $e$ of the
//! lengths have the part
//!
//! $$ e_d = R y, \qquad R^T L^{-1} R\\, y = R^T L^{-1} e, $$
//!
//! that moves of the joints take away. The rest is in no shape: $L^{-1} (e - e_d)$ balances without
//! loads, and rigid members do not say what force it is. The shape that meets the lengths best has
//! $e_d = 0$. Forces split by the same projection: $t = L^{-1} R y$ with $R^T t$ given has the least
//! complementary energy $\sum t^2 l$, which is the share of equally stiff members.
//!
//! The rank of $R$ is read at a *cut*: motions that change the lengths by less than this part of
//! what the stiffest motion does count as mechanisms.

use nalgebra::Vector3;

use super::framework::Framework;
use super::state::State;
use super::stiffness::Stiffness;
use crate::error::Error;
use crate::thresholds::{CLOSURE_ROUNDING, GOLDEN};

/// The cut where lengths are taken as they are: a line with a slack of 1e-10 of its span, whose
/// forces are real, has 1e-5; lengths that are rounded to doubles leave a flat frame out of its
/// plane by 1e-8. Its square is above the rounding of the matrix.
pub(super) const SHARP: f64 = 1e-6;
/// The widest one: motions beyond change lengths by an error that is no tolerance any more.
pub(super) const WIDEST: f64 = 1e-2;
/// Sweeps of refinement: each leaves of what a motion of the singular value s changes the part
/// cut²/(cut² + s²).
pub(super) const SWEEPS: usize = 8;
/// A member takes part in a self-stress where this part of an error of lengths without pattern, or
/// more, is in no shape.
const TAKES_PART: f64 = 1e-7;

/// Of each member its direction and $1/l$, the latter zero for those that do not keep a length.
fn rows(framework: &Framework, state: &State) -> Vec<(Vector3<f64>, f64)> {
    let links = framework.links.iter().zip(state.directions(framework)).zip(&state.taut);
    links
        .map(|((link, (u, _)), taut)| {
            let rigid = *taut && link.compliance <= 0.0 && framework.moves(link);
            (u, if rigid { link.length.recip() } else { 0.0 })
        })
        .collect()
}

/// $R^T L^{-1} R$
fn assemble(framework: &Framework, stiffness: &mut Stiffness, rows: &[(Vector3<f64>, f64)]) {
    stiffness.assemble_members(framework, |k| (rows[k].0, 0.0, rows[k].1));
}

/// Number of self-stresses at a cut, by the signs of pivots (Sylvester): as many negative ones has
/// the matrix less the square of the cut as there are mechanisms.
fn self_stresses(
    framework: &Framework,
    stiffness: &mut Stiffness,
    rows: &[(Vector3<f64>, f64)],
    cut: f64,
) -> usize {
    assemble(framework, stiffness, rows);
    stiffness.shift(-cut * cut * stiffness.largest());
    stiffness.factorise_indefinite();
    let rank = framework.freedoms().saturating_sub(stiffness.negative_pivots());
    let members = &rows[..framework.members()];
    members.iter().filter(|(_, weight)| *weight > 0.0).count().saturating_sub(rank)
}

/// The cut at which a shape is singular that becomes so within the tolerances of its lengths: a
/// move by d changes a length l to the second order, by d²/2l.
fn wide(framework: &Framework) -> f64 {
    let rigid = framework.links.iter().filter(|link| link.compliance <= 0.0);
    let widest = rigid.map(|link| link.within / link.length).fold(0.0, f64::max);
    (2.0 * widest).sqrt().clamp(SHARP, WIDEST)
}

/// The cuts at which lengths overdetermine a shape, the widest first; the second one where it finds
/// less self-stresses. Also the number of factorisations.
pub(super) fn cuts(
    framework: &Framework,
    stiffness: &mut Stiffness,
    state: &State,
) -> (Vec<f64>, usize) {
    let (rows, wide) = (rows(framework, state), wide(framework));
    if rows.iter().all(|(_, weight)| *weight <= 0.0) {
        return (Vec::new(), 0);
    }
    let most = self_stresses(framework, stiffness, &rows, wide);
    if most == 0 {
        return (Vec::new(), 1);
    }
    let clear = self_stresses(framework, stiffness, &rows, SHARP);
    let cuts = match clear {
        0 => vec![wide],
        _ if clear == most => vec![SHARP],
        _ => vec![wide, SHARP],
    };
    (cuts, 2)
}

/// The projection onto what lengths decide at a shape.
pub(super) struct Decided {
    pub cut: f64,
    rows: Vec<(Vector3<f64>, f64)>,
    stiffness: Stiffness,
}

impl Decided {
    /// At a state and a cut.
    ///
    /// # Errors
    ///
    /// [`Error::Memory`] when the factor cannot be held.
    pub fn new(framework: &Framework, state: &State, cut: f64) -> Result<Self, Error> {
        let stiffness = Stiffness::new(framework, false)?;
        let mut decided = Self { cut, rows: Vec::new(), stiffness };
        decided.renew(framework, state);
        Ok(decided)
    }

    /// The same at another state.
    pub fn renew(&mut self, framework: &Framework, state: &State) {
        self.rows = rows(framework, state);
        assemble(framework, &mut self.stiffness, &self.rows);
        self.stiffness.shift(self.cut * self.cut * self.stiffness.largest());
        self.stiffness.factorise_definite();
    }

    /// By how much moves of the joints make a member longer, to first order.
    fn stretch(&self, framework: &Framework, link: usize, moves: &[Vector3<f64>]) -> f64 {
        framework.whole(link, |k| self.rows[k].0.dot(&framework.links[k].span(moves)))
    }

    /// The part of errors of lengths that places decide; those of elastic members are decided by
    /// their forces, and stay.
    pub fn part(&mut self, framework: &Framework, errors: &[f64]) -> Vec<f64> {
        let of_rows = self.rows.iter().zip(errors);
        let mut left: Vec<f64> =
            of_rows.map(|((_, weight), e)| if *weight > 0.0 { *e } else { 0.0 }).collect();
        let largest = left.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        for _ in 0..SWEEPS {
            let mut forces = vec![Vector3::zeros(); framework.nodes.len()];
            for ((link, (u, weight)), e) in framework.links.iter().zip(&self.rows).zip(&left) {
                forces[link.from] -= u * (weight * e);
                forces[link.to] += u * (weight * e);
            }
            let moves = self.stiffness.moves(framework, &forces);
            let mut change = 0.0_f64;
            for (k, ((_, weight), e)) in self.rows.iter().zip(&mut left).enumerate() {
                if *weight > 0.0 {
                    let taken = self.stretch(framework, k, &moves);
                    change = change.max(taken.abs());
                    *e -= taken;
                }
            }
            if change <= CLOSURE_ROUNDING * largest {
                break;
            }
        }
        errors.iter().zip(left).map(|(e, left)| e - left).collect()
    }

    /// The axial forces with the least complementary energy that balance the same loads; those of
    /// elastic members stay.
    pub fn share(&mut self, framework: &Framework, axial: &[f64]) -> Vec<f64> {
        let rows = self.rows.iter().zip(axial);
        let stretches: Vec<f64> =
            rows.map(|((_, w), t)| if *w > 0.0 { t / w } else { 0.0 }).collect();
        let parts = self.part(framework, &stretches);
        let rows = self.rows.iter().zip(parts).zip(axial);
        rows.map(|(((_, w), part), t)| if *w > 0.0 { w * part } else { *t }).collect()
    }

    /// The axial forces with the least complementary energy that bear loads of the joints.
    pub fn bearing(&mut self, framework: &Framework, loads: &[Vector3<f64>]) -> Vec<f64> {
        let moves = self.stiffness.moves(framework, loads);
        let rows = self.rows.iter().enumerate();
        rows.map(|(k, (_, weight))| weight * self.stretch(framework, k, &moves)).collect()
    }

    /// The members that take part in a self-stress: the part of lengths without pattern that is in
    /// no shape shows them.
    pub fn members(&mut self, framework: &Framework) -> Vec<usize> {
        let probe = |k: usize| framework.links[k].length * (0.5 + (k as f64 * GOLDEN).fract());
        let members = framework.members();
        let probe: Vec<f64> = framework.by_link((0..members).map(probe).collect());
        let parts = self.part(framework, &probe);
        let open = |k: &usize| (probe[*k] - parts[*k]).abs() > TAKES_PART * probe[*k];
        (0..members).filter(|k| self.rows[*k].1 > 0.0 && open(k)).collect()
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, System};

    use super::*;

    /// A move by d changes a length l by d²/2l, so a tolerance of 2e-6 of it hides one of 2e-3 l; no more than
    /// a hundredth, no less than a millionth, and elastic members have none.
    #[test]
    fn the_widest_cut_is_that_of_the_loosest_rigid_member() {
        let cut = |within: [Option<f64>; 2]| {
            let joints = vec![
                Joint::anchor("A", [0.0; 3]),
                Joint::free("P").with_mass(1.0),
                Joint::free("Q").with_mass(1.0),
            ];
            let bar =
                |from, to, length| Member::bar(from, to, Bar::homogeneous(length, 0.0).unwrap());
            let mut members =
                vec![bar(0, 1, 4.0), bar(1, 2, 2.0), bar(0, 2, 3.0).with_stiffness(10.0)];
            for (member, within) in members.iter_mut().zip(within) {
                member.set_length_tolerance(within);
            }
            wide(&Framework::new(&System::new("", 10.0, joints, members).unwrap()))
        };
        for (within, wanted) in [
            ([Some(8e-6), Some(1e-6)], 2e-3),
            ([Some(1e-6), Some(4e-6)], 2e-3),
            ([Some(0.4), None], WIDEST),
            ([Some(1e-15), Some(1e-15)], SHARP),
        ] {
            let found = cut(within);
            assert!((found / wanted - 1.0).abs() < 1e-12, "{within:?}: {found}");
        }
    }

    /// Rods above and below a joint between anchors; the cable to it is slack, and the rod from it ends free.
    #[test]
    fn members_of_a_self_stress_are_taut() {
        let bar = |from, to, length| Member::bar(from, to, Bar::homogeneous(length, 0.0).unwrap());
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("P").with_mass(1.0),
            Joint::free("Q").with_mass(1.0),
            Joint::anchor("B", [0.0, 0.0, -1.7]),
            Joint::anchor("C", [0.5, 0.0, 0.0]),
        ];
        let cable = bar(4, 1, 1.5).of_kind(model::system::Kind::Cable);
        let members = vec![bar(0, 1, 1.0), cable, bar(1, 2, 0.4), bar(1, 3, 0.7)];
        let system = System::new("", 10.0, joints, members).unwrap();
        let framework = Framework::new(&system);
        let place = |[x_m, z_m]: [f64; 2]| framework.units.place([x_m, 0.0, z_m]);
        let places =
            [[0.0, 0.0], [0.0, -1.0], [0.4, -1.0], [0.0, -1.7], [0.5, 0.0]].map(place).to_vec();
        let state = State::new(places, vec![0.0; 4], vec![true, false, true, true]);
        let mut decided = Decided::new(&framework, &state, SHARP).unwrap();
        assert_eq!(decided.members(&framework), [0, 3]);
    }
}
