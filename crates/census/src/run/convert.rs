//! The census in the words of the model: plain numbers with their evidence.

use model::{
    Complete, Equilibrium, Evidence, NoCertificate, Optimal, Reactions, Reason, SolverName,
    Stability, Status, Vector, Verified,
};
use numerics::Interval;

use crate::run::Census;
use crate::run::count::topology::TopologyError;
use crate::run::equilibrium::ProvenEquilibrium;
use crate::run::position::Position;

impl Census {
    /// The isolated equilibria as answers of a solver, in the order of the census: middles of the
    /// enclosures, and how far each is proved. Each circle appears once.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// let answers = census.to_model();
    /// assert_eq!(answers[0].evidence.rung(), Some(model::Rung::Optimal));
    /// assert_eq!(answers[1].evidence.rung(), Some(model::Rung::Complete));
    /// assert_eq!(answers[1].stability.index_in_space, 2);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn to_model(&self) -> Vec<Equilibrium> {
        let all = self.count_in_plane();
        self.equilibria.iter().map(|equilibrium| self.one_to_model(equilibrium, all)).collect()
    }

    /// One position as the answer of a solver, as in [`to_model`](Self::to_model).
    pub fn position_to_model(&self, position: &Position) -> Equilibrium {
        self.one_to_model(&position.equilibrium, self.count_in_plane())
    }

    /// One of so many that there are in the plane.
    pub(super) fn one_to_model(&self, proven: &ProvenEquilibrium, all: usize) -> Equilibrium {
        let vectors = |boxes: &[[Interval; 3]]| -> Vec<Vector> {
            boxes.iter().map(|vector| vector.map(Interval::mid)).collect()
        };
        let multipliers_n = vectors(&proven.multipliers_n);
        let ends = [multipliers_n.first(), multipliers_n.last()];
        let [start, end] = ends.map(|force| force.copied().unwrap_or_default());
        let dimension = proven.signs.len().saturating_sub(2);
        let indices = [proven.index_in_plane, proven.index_in_space()];
        Equilibrium {
            solver: SolverName::CENSUS,
            energy_j: proven.energy_j.mid(),
            joints_m: vectors(&proven.joints_m),
            multipliers_n,
            reactions_n: Reactions { start, end },
            axial_n: proven.axial_n.iter().map(|force| force.mid()).collect(),
            stability: Stability::of(indices, dimension, false),
            evidence: self.evidence(proven, all),
        }
    }

    fn evidence(&self, proven: &ProvenEquilibrium, all: usize) -> Evidence {
        let mut evidence =
            Evidence::enclosed("width of the enclosures of pull and angles", proven.width());
        evidence.condition = proven.condition;
        evidence.solve_s = self.statistics.seconds;
        let ladder = &mut evidence.ladder;
        ladder.verified = Status::Reached(Verified {
            box_width: proven.width(),
            distance: 0.0,
            circle: proven.circle,
            system: None,
        });
        ladder.complete = self.completeness_of(all);
        ladder.optimal = if proven.optimal {
            Status::Reached(Optimal { gap: None, singular: proven.circle })
        } else {
            Status::Open(Reason::NoCertificate(match proven.index_in_space() {
                0 => NoCertificate::PivotsUndecided,
                directions => NoCertificate::EnergyFalls { directions },
            }))
        };
        evidence
    }

    /// The rung `complete` of every equilibrium of this list.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// let proof = census.completeness();
    /// assert_eq!(proof.proof().map(|complete| complete.in_plane), Some(4));
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn completeness(&self) -> Status<Complete> {
        self.completeness_of(self.count_in_plane())
    }

    /// The same of a list of so many in the plane.
    fn completeness_of(&self, in_plane: usize) -> Status<Complete> {
        if self.complete {
            return Status::Reached(Complete {
                in_plane,
                families: self.families.len(),
                patterns: self.patterns(),
                cells: self.statistics.cells,
                system: None,
            });
        }
        Status::Open(match &self.topology {
            _ if self.undecided.is_empty() && self.singular_families() > 0 => {
                Reason::SingularFamilies { listed: self.singular_families() }
            }
            Err(error) if self.undecided.is_empty() => match error {
                TopologyError::Straight { sides } => {
                    Reason::StraightPosition { sides: sides.clone() }
                }
                TopologyError::TooFewSides { sides } | TopologyError::TooManySides { sides } => {
                    Reason::CountUnchecked { sides: *sides }
                }
            },
            _ => Reason::CensusUndecided { cells: self.undecided.len() },
        })
    }

    /// Patterns of tension and compression that the census goes through, 2ⁿ; the largest number
    /// where they are more.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// assert_eq!(census.patterns(), 8);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn patterns(&self) -> u64 {
        2_u64.saturating_pow(u32::try_from(self.statistics.bars).unwrap_or(u32::MAX))
    }
}

#[cfg(test)]
mod tests;
