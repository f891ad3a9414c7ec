//! What a census says, as `funicular census --json` prints it. Tables and CSV are written from the
//! same.

use std::borrow::Borrow;

use census::net::{ChainCensus, SystemCensus};
use census::{Interval, Position, ProvenEquilibrium};
use model::system::{Row, System, SystemEquilibrium};
use model::{Equilibrium, InPlane, Reason, SolverName, Status};
use serde::{Serialize, Serializer};
use validate::systems::judge;

use super::summary::{EnergyUnit, Summary};
use crate::object::head;
use crate::solve::{Lists, Named};

/// All equilibria of a system with their proofs, and what is known of the list.
#[derive(Debug, Clone)]
pub struct CensusAnswer {
    /// The isolated equilibria by energy; of a row of bars those in one vertical plane, circles by
    /// both their mirror images.
    pub equilibria: Vec<Found>,
    /// The census as a whole.
    pub census: Summary,
    pub(super) system: System,
    proven: SystemCensus,
}

/// One equilibrium: the same keys as those of `solve`, and what only the census of a row of bars
/// knows.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// As every solver gives it, from the middles of the enclosures.
    pub equilibrium: SystemEquilibrium,
    /// What is known where the system is one row of bars between two anchors.
    pub in_row: Option<InRow>,
}

/// What the census of a row of bars between two anchors knows of an equilibrium. Bars and joints
/// are in the order of the row, from joint 0, the anchor that the system has first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InRow {
    /// `1`, or `1'` for the mirror image of 1 on the same circle.
    pub label: String,
    /// The number of the circle, from 1.
    pub circle: Option<usize>,
    /// Whether this is the mirror image.
    pub mirrored: bool,
    /// Among the motions in the vertical plane.
    pub in_plane: InPlane,
    /// Angle of each bar from the descending vertical, [0, 360).
    pub angles_deg: Vec<f64>,
    /// The same, (-180, 180].
    pub angles_signed_deg: Vec<f64>,
    /// +1 for each bar in tension, -1 in compression, 0 for one that carries next to nothing.
    pub signs: Vec<i8>,
    /// The energy in units of `census.energy_unit_j`.
    pub energy_scaled: f64,
    /// Intervals that hold the exact values.
    pub enclosures: Enclosures,
}

/// Intervals that hold the exact values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Enclosures {
    /// Pull of the chain on the first anchor, level and upright.
    pub pull_n: [Interval; 2],
    /// Energy above the height of joint 0.
    pub energy_j: Interval,
    /// Angle of each bar from the descending vertical.
    pub angles_rad: Vec<Interval>,
    /// Place of each joint.
    pub joints_m: Vec<[Interval; 3]>,
    /// Force at each joint on the bar that ends there, which bears the weight at that joint; at joint 0 of the ground on bar 1.
    pub multipliers_n: Vec<[Interval; 3]>,
    /// Axial force of each bar.
    pub axial_n: Vec<Interval>,
}

impl CensusAnswer {
    /// Put together from a census.
    pub fn new(system: &System, proven: SystemCensus) -> Self {
        let equilibria: Vec<Found> = if let Some((row, chain)) = AsRow::of(system, &proven) {
            let found = |at: Position| row.found(chain.census.position_to_model(&at), &at);
            chain.census.positions().map(found).collect()
        } else {
            let found = proven.to_model(system).into_iter();
            found.map(|equilibrium| Found::of(system, equilibrium, None)).collect()
        };
        let census = Summary::of(system, &proven, equilibria.len());
        Self { equilibria, census, system: system.clone(), proven }
    }

    /// What it is the census of.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The census itself, with the enclosures.
    pub fn proven(&self) -> &SystemCensus {
        &self.proven
    }

    /// The census of the row of bars that the system is, if it is one: to draw.
    pub fn row(&self) -> Option<&ChainCensus> {
        self.proven.row(&self.system)
    }

    /// The system as that row.
    pub(super) fn as_row(&self) -> Option<AsRow<'_>> {
        AsRow::of(&self.system, &self.proven).map(|(row, _)| row)
    }

    /// Whether it is proved that there is no other.
    pub fn complete(&self) -> bool {
        self.census.complete
    }

    /// With this list.
    pub(super) fn object<E>(&self, list: Option<&'static str>, equilibria: E) -> Object<'_, E> {
        Object { system: &self.system, list, equilibria, census: &self.census }
    }
}

impl Serialize for CensusAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let items = || self.equilibria.iter().map(|found| Item(&self.system, found));
        self.object(None, Each(items)).serialize(serializer)
    }
}

#[derive(Serialize)]
pub(super) struct Object<'a, E> {
    #[serde(flatten, serialize_with = "head")]
    system: &'a System,
    #[serde(skip_serializing_if = "Option::is_none")]
    list: Option<&'static str>,
    equilibria: E,
    census: &'a Summary,
}

/// A list whose items are made while it is written.
pub(super) struct Each<F>(pub(super) F);

impl<F: Fn() -> I, I: Iterator<Item: Serialize>> Serialize for Each<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((self.0)())
    }
}

/// An equilibrium with the names of its joints.
pub(super) struct Item<'a, F>(pub(super) &'a System, pub(super) F);

impl<F: Borrow<Found>> Serialize for Item<'_, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Keys<'a> {
            #[serde(flatten)]
            equilibrium: Named<'a>,
            #[serde(flatten)]
            in_row: Option<&'a InRow>,
        }
        let Found { equilibrium, in_row } = self.1.borrow();
        let named = Named { system: self.0, equilibrium, lists: Lists::Objects };
        Keys { equilibrium: named, in_row: in_row.as_ref() }.serialize(serializer)
    }
}

impl Found {
    /// An equilibrium that no other solver was asked for.
    fn of(system: &System, mut equilibrium: SystemEquilibrium, in_row: Option<InRow>) -> Self {
        let statics = judge(system, &equilibrium).largest();
        equilibrium.evidence.ladder.agreed =
            Status::Open(Reason::OneSolverOnly { solver: SolverName::CENSUS, statics });
        Self { equilibrium, in_row }
    }

    /// Its name in the list, where it has this place from 0: `2`, or `2'` for a mirror image.
    pub fn label(&self, k: usize) -> String {
        self.in_row.as_ref().map_or_else(|| (k + 1).to_string(), |found| found.label.clone())
    }

    /// Largest relative width of the enclosures.
    pub fn box_width(&self) -> f64 {
        let verified = self.equilibrium.evidence.ladder.verified.proof();
        verified.map_or(f64::NAN, |proof| proof.box_width)
    }
}

/// A system as the row of bars that it is.
pub(super) struct AsRow<'a> {
    system: &'a System,
    row: &'a Row,
    unit: EnergyUnit,
}

impl<'a> AsRow<'a> {
    pub(super) fn of(
        system: &'a System,
        proven: &'a SystemCensus,
    ) -> Option<(Self, &'a ChainCensus)> {
        let (chain, row) = (proven.row(system)?, system.as_row()?);
        Some((Self { system, row, unit: EnergyUnit::of(row.problem().chain()) }, chain))
    }

    /// A position, and the same as the answer of a solver.
    pub(super) fn found(&self, equilibrium: Equilibrium, position: &Position) -> Found {
        let proven = &position.equilibrium;
        let signed: Vec<f64> =
            proven.angles_rad.iter().map(|angle| signed_deg(angle.mid().to_degrees())).collect();
        let in_row = InRow {
            label: position.label(),
            circle: proven.circle.then_some(position.number),
            mirrored: position.mirrored,
            in_plane: equilibrium.stability.in_plane,
            angles_deg: signed.iter().copied().map(full_turn_deg).collect(),
            angles_signed_deg: signed,
            signs: proven.signs.clone(),
            energy_scaled: equilibrium.energy_j / self.unit.energy_unit_j,
            enclosures: Enclosures::of(proven),
        };
        Found::of(self.system, self.row.equilibrium(equilibrium), Some(in_row))
    }
}

/// In (-180, 180].
fn signed_deg(angle: f64) -> f64 {
    if angle > 180.0 {
        angle - 360.0
    } else if angle <= -180.0 {
        angle + 360.0
    } else {
        angle
    }
}

/// In [0, 360).
fn full_turn_deg(signed: f64) -> f64 {
    let turned = if signed < 0.0 { signed + 360.0 } else { signed };
    // A tiny negative angle rounds to the full turn, which is zero.
    if turned >= 360.0 { 0.0 } else { turned }
}

impl Enclosures {
    fn of(proven: &ProvenEquilibrium) -> Self {
        let ProvenEquilibrium { angles_rad, joints_m, multipliers_n, axial_n, .. } = proven.clone();
        let (pull_n, energy_j) = (proven.pull_n, proven.energy_j);
        Self { pull_n, energy_j, angles_rad, joints_m, multipliers_n, axial_n }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_in_their_ranges() {
        for (angle, signed, full) in [
            (19.5, 19.5, 19.5),
            (-73.9, -73.9, 286.1),
            (190.0, -170.0, 190.0),
            (-180.0, 180.0, 180.0),
        ] {
            assert!((signed_deg(angle) - signed).abs() < 1e-12);
            assert!((full_turn_deg(signed_deg(angle)) - full).abs() < 1e-12);
        }
        assert!(full_turn_deg(-1e-20) < 360.0);
    }
}
