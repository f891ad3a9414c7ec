//! The census in the words of the model: plain numbers with their evidence.

use intervals::Interval;
use model::{
    Equilibrium, Evidence, InPlane, InSpace, Reactions, Rung, SolverName, Stability, Vector,
};

use crate::{Census, Position, ProvenEquilibrium};

impl Census {
    /// The isolated equilibria as answers of a solver, in the order of the census: middles of the
    /// enclosures, and how far each is proved. Each circle appears once.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// let answers = census.to_model();
    /// assert_eq!(answers[0].evidence.rung(), model::Rung::Optimal);
    /// assert_eq!(answers[1].evidence.rung(), model::Rung::Complete);
    /// assert_eq!(answers[1].stability.index_in_space, 2);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    #[must_use]
    pub fn to_model(&self) -> Vec<Equilibrium> {
        self.equilibria.iter().map(|equilibrium| self.one_to_model(equilibrium)).collect()
    }

    /// One position as the answer of a solver, as in [`to_model`](Self::to_model).
    #[must_use]
    pub fn position_to_model(&self, position: &Position) -> Equilibrium {
        self.one_to_model(&position.equilibrium)
    }

    fn one_to_model(&self, proven: &ProvenEquilibrium) -> Equilibrium {
        let vectors = |boxes: &[[Interval; 3]]| -> Vec<Vector> {
            boxes.iter().map(|vector| vector.map(Interval::mid)).collect()
        };
        let multipliers_n = vectors(&proven.multipliers_n);
        let ends = [multipliers_n.first(), multipliers_n.last()];
        let [start, end] = ends.map(|force| force.copied().unwrap_or_default());
        let dimension = proven.signs.len().saturating_sub(2);
        let in_plane = if proven.index_in_plane == 0 {
            InPlane::Minimum
        } else if proven.index_in_plane == dimension {
            InPlane::Maximum
        } else {
            InPlane::Saddle
        };
        let index_in_space = proven.index_in_space();
        Equilibrium {
            solver: SolverName::Census,
            energy_j: proven.energy_j.mid(),
            joints_m: vectors(&proven.joints_m),
            multipliers_n,
            reactions_n: Reactions { start, end },
            axial_n: proven.axial_n.iter().map(|force| force.mid()).collect(),
            stability: Stability {
                in_plane,
                index_in_plane: proven.index_in_plane,
                in_space: if index_in_space == 0 { InSpace::Stable } else { InSpace::Unstable },
                index_in_space,
            },
            evidence: self.evidence(proven),
        }
    }

    fn evidence(&self, proven: &ProvenEquilibrium) -> Evidence {
        let width = proven.width();
        let mut evidence =
            Evidence::converged(width, "width of the enclosures of pull and angles", 0);
        evidence.condition = proven.condition;
        evidence.solve_s = self.statistics.seconds;
        evidence.reach(
            Rung::Verified,
            format!(
                "Krawczyk's test: exactly one equilibrium in a box of relative width {width:.1e}"
            ),
        );
        if self.complete {
            evidence.reach(
                Rung::Complete,
                format!(
                    "no other of the {} patterns of tension and compression closes anywhere else{} \
                     ({} cells of pulls)",
                    2_u64.saturating_pow(u32::try_from(proven.signs.len()).unwrap_or(u32::MAX)),
                    match self.families.len() {
                        0 => String::new(),
                        1 => ", but for 1 family with slack bars".to_owned(),
                        number => format!(", but for {number} families with slack bars"),
                    },
                    self.statistics.cells
                ),
            );
        } else {
            let undecided = self.undecided.len();
            evidence.miss(
                Rung::Complete,
                match &self.topology {
                    Err(error) if undecided == 0 => error.to_string(),
                    _ => format!("{undecided} cells of pulls are undecided"),
                },
            );
        }
        if proven.optimal {
            evidence.reach(
                Rung::Optimal,
                "the stress matrix is positive semidefinite, by factorisation in intervals",
            );
        } else if proven.index_in_space() > 0 {
            evidence.miss(
                Rung::Optimal,
                format!("the energy falls in {} directions", proven.index_in_space()),
            );
        } else {
            evidence.miss(Rung::Optimal, "the pivots of the stress matrix are not proved positive");
        }
        evidence
    }
}
