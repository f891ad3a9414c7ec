//! The list of equilibria that outcomes are numbered by, and the way to a number.

use std::cmp::Ordering;

use census::{Census, CensusError, ProvenEquilibrium, SlackFamily};
use model::Problem;
use serde::{Deserialize, Serialize};

use crate::accuracy::{carried, place_error};
use crate::error::SweepError;
use crate::settings::Settings;

/// An outcome is an equilibrium of the list when no joint is farther from it than this, in total
/// lengths. A converged seed is within its residual (1e-13) times the condition of the equilibrium;
/// equilibria nearer to each other than four times this narrow it to a quarter of their distance.
/// Where bars bear so little that a converged seed is known less well, that is the tolerance.
pub const JOINT_TOLERANCE: f64 = 1e-6;

/// Energies of one equilibrium differ by less than this, in total weight times total length: near
/// an equilibrium the energy changes with the square of the distance, and with the gap.
pub(crate) const ENERGY_TOLERANCE: f64 = 1e-9;

/// Where an entry of the list comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// Proved by the census.
    Proven,
    /// A family of equilibria with slack bars, proved by the census; one number for the whole of
    /// it.
    Family,
    /// Reached by a seed, where the census is not complete.
    #[default]
    Discovered,
}

/// One entry of the list.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Member {
    /// Where it comes from.
    pub origin: Origin,
    /// Potential energy above the height of joint 0, J.
    pub energy_j: f64,
    /// Angles of the bars from the descending vertical towards the last anchor, rad. Of a family,
    /// those of one shape for the bars that carry force, and none for the slack ones.
    pub angles_rad: Vec<Option<f64>>,
    /// Negative directions of the second derivative of the energy in the plane; 0 is a minimum.
    /// None if it is not known.
    pub index_in_plane: Option<usize>,
    /// The same in space, of systems that start from places in space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub index_in_space: Option<usize>,
    /// With the anchors on one vertical: whether this is the mirror image of the entry that the
    /// census shows, half a turn away on the same circle of equilibria.
    pub mirrored: bool,
    /// Of what is released: the places of the joints, world frame, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joints_m: Option<Vec<model::Vector>>,
}

impl Member {
    /// Directions in which the energy falls: in space where starts are places in space, else in the
    /// plane. None if it is not known.
    pub fn index(&self) -> Option<usize> {
        self.index_in_space.or(self.index_in_plane)
    }
}

/// What the census proves, by energy and then by angles, and what it takes to find an entry. Equal
/// for equal problems and settings: it depends on no seed of the sweep, no thread, no shard.
///
/// When the census leaves something undecided, or the chain is too long for one, the list is not
/// complete, and what the seeds reach is numbered behind it, as they go: [`Reached`](crate::Reached).
#[derive(Debug, Clone, PartialEq)]
pub struct Members {
    list: Vec<Member>,
    complete: bool,
    lookup: Lookup,
}

/// The list in units of the chain.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lookup {
    lengths: Vec<f64>,
    /// One per entry, ascending.
    energies: Vec<f64>,
    /// Directions, n per entry; undefined for slack bars.
    directions: Vec<[f64; 2]>,
    /// How far converged seeds may be from each entry, in total lengths.
    errors: Vec<f64>,
    /// What the bars carry, in units of the total weight.
    carried: Vec<f64>,
    /// Total weight times total length, J.
    unit_j: f64,
    tolerance: f64,
    /// A quarter of the smallest distance of two entries of one energy.
    apart: f64,
}

impl Members {
    /// Make the list.
    ///
    /// # Errors
    ///
    /// [`SweepError::Census`] when the settings of the census are out of range,
    /// [`SweepError::TooManyEquilibria`] when the columns cannot number them.
    pub fn of(problem: &Problem, settings: &Settings) -> Result<Self, SweepError> {
        let (mut list, complete) = match Census::take(problem, &settings.census) {
            Ok(census) => (proven(&census, problem), census.complete),
            Err(CensusError::TooManyBars { .. }) => (vec![], false),
            Err(error) => return Err(error.into()),
        };
        if list.len() > Self::MOST {
            return Err(SweepError::TooManyEquilibria { members: list.len(), most: Self::MOST });
        }
        list.sort_by(by_energy_and_angles);
        let lookup = Lookup::new(problem, &list);
        Ok(Self { list, complete, lookup })
    }

    /// Largest number of entries: as many as there are codes that are not negative.
    pub(crate) const MOST: usize = i16::MAX as usize;

    /// The entries; the number of one is its place.
    pub fn list(&self) -> &[Member] {
        &self.list
    }

    /// Whether it is proved that there are no others.
    pub fn complete(&self) -> bool {
        self.complete
    }

    /// What energies are compared in: total weight times total length, J.
    pub fn energy_unit_j(&self) -> f64 {
        self.lookup.unit_j
    }

    /// The number of the nearest entry within the tolerance, for unit directions (along the
    /// heading, up) of the bars.
    pub fn identify(&self, directions: &[[f64; 2]], energy_j: f64) -> Option<i16> {
        let entry = self.lookup.nearest(directions, energy_j)?;
        i16::try_from(entry).ok()
    }
}

impl Lookup {
    pub(crate) fn new(problem: &Problem, list: &[Member]) -> Self {
        let chain = problem.chain();
        let total_m = chain.total_length_m();
        let unit_j = chain.total_mass_kg() * chain.gravity_m_s2() * total_m;
        let directions = list.iter().flat_map(directions_of);
        let mut lookup = Self {
            lengths: chain.bars().iter().map(|bar| bar.length_m() / total_m).collect(),
            energies: list.iter().map(|member| member.energy_j / unit_j).collect(),
            directions: directions.collect(),
            errors: vec![],
            carried: carried(chain),
            unit_j,
            tolerance: JOINT_TOLERANCE,
            apart: f64::INFINITY,
        };
        let entries = lookup.directions.chunks(lookup.lengths.len());
        lookup.errors = entries.map(|u| lookup.error(u)).collect();
        let separation = lookup.separation();
        lookup.apart = 0.25 * separation;
        lookup.tolerance = JOINT_TOLERANCE.min(lookup.apart);
        lookup
    }

    /// Put an entry into its place; what was there comes after it.
    pub(crate) fn insert(&mut self, at: usize, member: &Member) {
        let bars = self.lengths.len();
        let directions: Vec<_> = directions_of(member).collect();
        self.energies.insert(at, member.energy_j / self.unit_j);
        self.errors.insert(at, self.error(&directions));
        self.directions.splice(at * bars..at * bars, directions);
    }

    /// Drop all entries but the first.
    pub(crate) fn truncate(&mut self, entries: usize) {
        self.energies.truncate(entries);
        self.errors.truncate(entries);
        self.directions.truncate(entries * self.lengths.len());
    }

    pub(crate) fn bars(&self) -> usize {
        self.lengths.len()
    }

    /// Total weight times total length, J.
    pub(crate) fn unit_j(&self) -> f64 {
        self.unit_j
    }

    /// Smallest distance of two entries that are not farther apart in energy than the tolerance.
    fn separation(&self) -> f64 {
        let bars = self.lengths.len();
        let mut least = f64::INFINITY;
        for (entry, energy) in self.energies.iter().enumerate() {
            let same = |other: &f64| other - energy <= 2.0 * ENERGY_TOLERANCE;
            for other in entry + 1..self.energies.len() {
                if !same(&self.energies[other]) {
                    break;
                }
                let u = &self.directions[other * bars..(other + 1) * bars];
                least = least.min(self.distance(entry, u));
            }
        }
        least
    }

    /// How far a converged seed may be from its equilibrium, where that is more than the tolerance;
    /// of two seeds each may be.
    fn error(&self, u: &[[f64; 2]]) -> f64 {
        let error = 2.0 * place_error(&self.lengths, &self.carried, u);
        if error > JOINT_TOLERANCE { error } else { 0.0 }
    }

    /// The nearest entry within the tolerance.
    #[inline]
    pub(crate) fn nearest(&self, u: &[[f64; 2]], energy_j: f64) -> Option<usize> {
        let energy = energy_j / self.unit_j;
        let first = self.energies.partition_point(|other| *other < energy - ENERGY_TOLERANCE);
        let mut best = (f64::INFINITY, None);
        for entry in first..self.energies.len() {
            if self.energies[entry] > energy + ENERGY_TOLERANCE {
                break;
            }
            let distance = self.distance(entry, u);
            let tolerance = self.tolerance.max(self.errors[entry].min(self.apart));
            if distance <= best.0.min(tolerance) {
                best = (distance, Some(entry));
            }
        }
        best.1
    }

    /// Largest distance of a joint, in total lengths; for a family, largest part of a joint's
    /// distance that the bars in force make.
    #[inline]
    fn distance(&self, entry: usize, u: &[[f64; 2]]) -> f64 {
        let bars = self.lengths.len();
        let member = &self.directions[entry * bars..(entry + 1) * bars];
        let (mut off, mut largest) = ([0.0; 2], 0.0_f64);
        for ((length, a), b) in self.lengths.iter().zip(member).zip(u) {
            if a[0].is_nan() {
                continue;
            }
            off[0] += length * (b[0] - a[0]);
            off[1] += length * (b[1] - a[1]);
            let square = off[0] * off[0] + off[1] * off[1];
            // Undefined distances are the largest.
            largest = if square <= largest { largest } else { square };
        }
        largest.sqrt()
    }
}

/// Directions (along the heading, up) of the bars; undefined for slack ones.
pub(crate) fn directions_of(member: &Member) -> impl Iterator<Item = [f64; 2]> + '_ {
    member.angles_rad.iter().map(|angle| {
        angle.map_or([f64::NAN; 2], |angle| {
            let (sin, cos) = angle.sin_cos();
            [sin, -cos]
        })
    })
}

/// Entries of the census: isolated equilibria, both halves of circles, and families.
fn proven(census: &Census, problem: &Problem) -> Vec<Member> {
    let isolated = census.equilibria.iter().flat_map(|equilibrium| {
        let shown = isolated(equilibrium, false);
        let mirrored = equilibrium.circle.then(|| isolated(equilibrium, true));
        std::iter::once(shown).chain(mirrored)
    });
    isolated.chain(census.families.iter().map(|slack| family(slack, problem))).collect()
}

fn isolated(equilibrium: &ProvenEquilibrium, mirrored: bool) -> Member {
    let sign = if mirrored { -1.0 } else { 1.0 };
    Member {
        origin: Origin::Proven,
        energy_j: equilibrium.energy_j.mid(),
        angles_rad: equilibrium.angles_rad.iter().map(|angle| Some(sign * angle.mid())).collect(),
        index_in_plane: Some(equilibrium.index_in_plane),
        mirrored,
        ..Member::default()
    }
}

fn family(slack: &SlackFamily, problem: &Problem) -> Member {
    Member {
        origin: Origin::Family,
        energy_j: slack.energy_j.mid(),
        angles_rad: slack.angles_rad(problem),
        index_in_plane: Some(slack.index_in_plane),
        ..Member::default()
    }
}

/// By energy, then by the angles, bar by bar; slack bars first.
pub(crate) fn by_energy_and_angles(a: &Member, b: &Member) -> Ordering {
    let angles = a.angles_rad.iter().zip(&b.angles_rad);
    angles.fold(a.energy_j.total_cmp(&b.energy_j), |order, (x, y)| {
        let less = |x: &Option<f64>| x.unwrap_or(f64::NEG_INFINITY);
        order.then(less(x).total_cmp(&less(y)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's equilibria E1 and E2, from 40 digits.
    fn members() -> Members {
        let angles: [[f64; 3]; 2] = [
            [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34],
            [73.920_588_792_231_34, -38.599_136_184_451_89, -19.694_867_976_133_02],
        ];
        let list: Vec<_> = angles
            .into_iter()
            .zip([2.335_468_651_999_305, 3.664_531_348_000_695])
            .map(|(angles, mgl)| Member {
                origin: Origin::Proven,
                energy_j: (mgl - 6.0) * model::STANDARD_GRAVITY_M_S2,
                angles_rad: angles.map(|angle| Some(angle.to_radians())).into(),
                index_in_plane: Some(0),
                ..Member::default()
            })
            .collect();
        let lookup = Lookup::new(&model::cases::paper(), &list);
        Members { list, complete: true, lookup }
    }

    /// A millionth of the total length and no more: the last joint of the paper's chain moves by a
    /// third of the turn of the last bar.
    #[test]
    fn outcomes_belong_to_an_entry_within_a_millionth_of_the_length() {
        let members = members();
        for entry in [0, 1] {
            let member = &members.list()[entry];
            let turned = |by: f64| {
                let mut angles: Vec<f64> = member.angles_rad.iter().flatten().copied().collect();
                angles[2] += 3.0 * by;
                let directions: Vec<_> =
                    angles.iter().map(|angle| [angle.sin(), -angle.cos()]).collect();
                members.identify(&directions, member.energy_j)
            };
            let number = i16::try_from(entry).unwrap();
            assert_eq!([0.0, 0.9e-6, -0.9e-6].map(turned), [Some(number); 3]);
            assert_eq!([1.1e-6, -1.1e-6, 1e-3].map(turned), [None; 3]);
        }
    }

    /// Energies tell entries apart as well: a billionth of total weight times total length.
    #[test]
    fn outcomes_belong_to_an_entry_of_their_energy() {
        let members = members();
        let member = &members.list()[0];
        let angles = member.angles_rad.iter().flatten();
        let directions: Vec<_> = angles.map(|angle| [angle.sin(), -angle.cos()]).collect();
        let unit_j = 9.0 * model::STANDARD_GRAVITY_M_S2;
        let off = |by: f64| members.identify(&directions, member.energy_j + by * unit_j);
        assert_eq!([0.9e-9, -0.9e-9].map(off), [Some(0); 2]);
        assert_eq!([1.1e-9, -1.1e-9].map(off), [None; 2]);
    }
}
