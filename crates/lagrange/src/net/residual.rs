//! How far a state is from an equilibrium.

use nalgebra::Vector3;

use super::decided::Decided;
use super::framework::Framework;
use super::state::State;
use crate::error::Error;
use crate::larger::larger;
use model::system::System;

/// Balance is measured against the loads of a joint (the mean load where it has none), or where the forces in its members are far
/// larger, near a singular shape, against this part of them: the tolerance is then some fifty
/// roundings of these forces.
const OF_FORCES: f64 = 1e-2;
/// Far from the origin rounded places turn a member by a rounding of this part of their distance over its length; the
/// forces of a long truss are large there.
const FAR: f64 = 8.0;
/// But never against more than this many times the loads: what rounding of larger forces leaves
/// over is a part of the loads that matters.
const OF_LOADS: f64 = 1e6;

/// Balance of the joints and lengths of the members that keep one.
pub(super) struct Residual {
    /// Unbalanced force at each joint.
    pub forces: Vec<Vector3<f64>>,
    /// Length by the law minus length, of each taut member; zero for the others. Where lengths
    /// overdetermine the shape the part of it that places decide.
    pub lengths: Vec<f64>,
    /// Direction and length of each member.
    pub directions: Vec<(Vector3<f64>, f64)>,
    /// Largest force, the unit of forces in `merit`.
    pub unit: f64,
    /// Largest unbalanced force along a free direction, in units of what loads its joint, and the
    /// joint.
    pub balance: (f64, usize),
    /// Largest error of a length, in units of the length, and its member.
    pub length: (f64, usize),
    /// Sum of squares, for the search along a step.
    pub merit: f64,
}

impl Residual {
    pub fn new(framework: &Framework, state: &State) -> Self {
        Self::within(framework, state, None)
    }

    /// With the part of the lengths that places decide alone.
    pub fn within(framework: &Framework, state: &State, decided: Option<&mut Decided>) -> Self {
        let directions = state.directions(framework);
        // What pushes while its ends are in one place pushes them apart, this way or that: no balance.
        let pulls = directions.iter().zip(&state.axial).map(|((u, length), axial)| {
            if *length <= 0.0 && *axial < 0.0 { Vector3::x() * *axial } else { u * *axial }
        });
        let forces = framework.unbalance(pulls);
        let unit = state.largest_force(framework).max(f64::MIN_POSITIVE);
        // In units of what is too large for a number every force would be small.
        let unit = if unit.is_finite() { unit } else { f64::NAN };
        let mut merit = 0.0;
        let free = framework.nodes.iter().zip(&forces).zip(units(framework, state));
        let free = free.map(|((node, force), of)| {
            let square = node.free.components(force).norm_squared();
            merit += square;
            square.sqrt() / of
        });
        let balance = largest(free);
        // One by one: the square of the smallest number is none.
        merit = merit / unit / unit;
        let links = framework.links.iter().enumerate().zip(state.axial.iter().zip(&state.taut));
        let misfits = links.map(|((k, link), (axial, taut))| {
            let keeps = *taut && framework.moves(link);
            let length = framework.whole(k, |span| directions[span].1);
            if keeps { link.length + link.compliance * axial - length } else { 0.0 }
        });
        let lengths: Vec<f64> = misfits.collect();
        let lengths = match decided {
            Some(decided) => decided.part(framework, &lengths),
            None => lengths,
        };
        let length = largest(framework.links.iter().zip(&lengths).map(|(link, misfit)| {
            merit += misfit * misfit;
            misfit.abs() / link.length
        }));
        Self { forces, lengths, directions, unit, balance, length, merit }
    }

    /// The larger of the two, dimensionless.
    pub fn size(&self) -> f64 {
        larger(self.balance.0, self.length.0)
    }

    /// The error of a solve that ends here.
    pub fn not_converged(
        &self,
        system: &System,
        framework: &Framework,
        iterations: usize,
    ) -> Error {
        let member = framework.member_of(self.length.1);
        Error::NotConverged {
            iterations,
            joint: system.joints()[self.balance.1].name.to_string(),
            unbalance: self.balance.0,
            member: member + 1,
            misfit_m: self.lengths.get(member).map_or(0.0, |r| r.abs()) * framework.units.length_m,
        }
    }
}

/// What the balance of each joint is measured against.
fn units<'a>(framework: &'a Framework, state: &State) -> impl Iterator<Item = f64> + 'a {
    let mut forces = vec![0.0; framework.nodes.len()];
    for (link, axial) in framework.links.iter().zip(&state.axial) {
        let far = [link.from, link.to].map(|joint| state.places[joint].amax());
        let turned = (far[0].max(far[1]) / (FAR * link.length)).max(1.0);
        forces[link.from] += axial.abs() * turned;
        forces[link.to] += axial.abs() * turned;
    }
    let least = framework.least_scale(state);
    framework.nodes.iter().zip(forces).map(move |(node, force)| {
        // What is light is held to its own load, or it might lie anywhere beside what is heavy.
        let own = node.load.norm();
        let loads = own.max(least);
        let own = if own > 0.0 { own } else { loads };
        let unit = own.max((OF_FORCES * force).min(OF_LOADS * loads));
        // In units of what is too large for a number every force would be small.
        if force.is_finite() { unit } else { f64::NAN }
    })
}

/// Largest value and its place; a NaN is the largest.
fn largest(values: impl Iterator<Item = f64>) -> (f64, usize) {
    values.enumerate().fold((0.0, 0), |(most, at), (k, value)| {
        if value > most || value.is_nan() { (value, k) } else { (most, at) }
    })
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member};

    use super::*;

    /// A cable and an elastic bar in an L, every number of another size: the unit of length is the mean of
    /// both, 2 m, that of force the mean load.
    fn bent(mass_kg: f64) -> (System, Framework, State) {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("P").with_mass(1.0),
            Joint::free("Q").with_mass(mass_kg),
        ];
        let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let members = vec![
            Member::cable(0, 1, body(3.0)),
            Member::bar(1, 2, body(1.0)).with_stiffness(50.0 * (1.0 + mass_kg)),
        ];
        let system = System::new("bent", 10.0, joints, members).unwrap();
        let framework = Framework::new(&system);
        let places = [[0.0; 3], [3.03, 0.0, 0.0], [3.03, 0.0, -1.5]]
            .map(|at_m| framework.units.place(at_m))
            .to_vec();
        let axial = [4.0, 25.0].map(|force_n| force_n / framework.units.force_n).to_vec();
        let state = State::new(places, axial, vec![true; 2]);
        (system, framework, state)
    }

    #[test]
    fn balance_and_lengths_are_those_of_a_bent_line() {
        let (_, framework, state) = bent(3.0);
        let residual = Residual::new(&framework, &state);
        let unit_n = framework.units.force_n;
        let near = |found: f64, wanted: f64| {
            assert!((found - wanted).abs() < 1e-12 * wanted.abs().max(1.0), "{found} {wanted}");
        };
        // At P 10 N and 25 N down, 4 N back; at Q 30 N down and 25 N up.
        for (joint, wanted) in [(1, [-4.0, 0.0, -35.0]), (2, [0.0, 0.0, -5.0])] {
            for (k, wanted_n) in wanted.into_iter().enumerate() {
                near(residual.forces[joint][k] * unit_n, wanted_n);
            }
        }
        // Held against the 10 N at P, not against the mean.
        assert_eq!(residual.balance.1, 1);
        near(residual.balance.0, 4.0_f64.hypot(35.0) / 10.0);
        near(residual.unit * unit_n, 30.0);
        // Longer than 3 m by a hundredth; of 1 m, 1.125 m by 25 N, and 1.5 m.
        near(residual.lengths[0] * framework.units.length_m, -0.03);
        near(residual.lengths[1] * framework.units.length_m, 1.0 + 25.0 / 200.0 - 1.5);
        assert_eq!(residual.length.1, 1);
        near(residual.length.0, 0.375);
        let squares = (16.0 + 35.0 * 35.0 + 25.0) / 900.0 + (0.03 * 0.03 + 0.375 * 0.375) / 4.0;
        near(residual.merit, squares);
        near(residual.size(), 4.0_f64.hypot(35.0) / 10.0);
    }

    /// A load a billion times less than the other is held to itself, and slack members to no length.
    #[test]
    fn what_is_light_is_held_to_its_own_load() {
        let (system, framework, mut state) = bent(1e-9);
        state.axial = [10.0, 2e-8].map(|force_n| force_n / framework.units.force_n).to_vec();
        state.taut[0] = false;
        let residual = Residual::new(&framework, &state);
        // At Q 2e-8 N up and 1e-8 N down; at P all 10 N, and the pull across, of 10 N.
        assert!((residual.forces[2][2] * framework.units.force_n / 1e-8 - 1.0).abs() < 1e-6);
        assert_eq!(residual.balance.1, 1);
        assert!(residual.lengths[0].abs() <= 0.0 && residual.length.1 == 1);
        state.axial[0] = 0.0;
        state.places[1] = state.places[0] - Vector3::new(0.0, 0.0, 1.0);
        state.axial[0] = 10.0 / framework.units.force_n;
        let hanging = Residual::new(&framework, &state);
        assert_eq!(hanging.balance.1, 2);
        let text = hanging.not_converged(&system, &framework, 7);
        let Error::NotConverged { iterations, joint, unbalance, member, .. } = text else {
            panic!()
        };
        assert_eq!((iterations, joint.as_str(), member), (7, "Q", 2));
        assert!(unbalance > 0.5 && unbalance < 4.0, "{unbalance}");
    }
}
