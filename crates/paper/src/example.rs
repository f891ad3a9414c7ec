//! The paper's example (section VIII) solved by everyone: what the claims are judged by.

use census::Census;
use energy::example::{ExampleMinimum, PAPER_STEP_RAD, Scan, scan};
use lagrange::Seed;
use model::{Equilibrium, Problem, Vector};

/// Where `lagrange` starts for E1, and mirrored for E1': rough angles, rad, none of them an answer.
const NEAR_E1: [f64; 3] = [0.3, 0.7, -1.3];
/// Where `lagrange` starts for E2.
const NEAR_E2: [f64; 3] = [1.3, -0.7, -0.3];

/// Why the example could not be solved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExampleError {
    /// Occurs when `lagrange` finds no equilibrium from a seed near one.
    #[error("lagrange, near {near}: {error}")]
    Lagrange {
        /// The equilibrium.
        near: &'static str,
        /// What it says.
        error: lagrange::Error,
    },
    /// Occurs when `energy` finds no minimum.
    #[error("energy: {0}")]
    Energy(#[from] energy::Error),
    /// Occurs when E1 or E2 is not certified to have the least or the greatest energy.
    #[error("certificate: {0}")]
    Certificate(#[from] model::NoCertificate),
    /// Occurs when the example as cables is not solved.
    #[error("cables: {0}")]
    Cables(#[from] validate::systems::ConeError),
    /// Occurs when the census refuses the example.
    #[error("census: {0}")]
    Census(#[from] census::CensusError),
    /// Occurs when the scan has no point.
    #[error("the scan of the paper has no point")]
    Scan,
}

/// The units of the paper: bar length *l*, weight of a bar *mg*, and their product.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperUnits {
    /// Length of a bar, m.
    pub l_m: f64,
    /// Weight of a bar, N.
    pub mg_n: f64,
}

impl PaperUnits {
    fn of(problem: &Problem) -> Self {
        let bar = &problem.chain().bars()[0];
        Self { l_m: bar.length_m(), mg_n: bar.mass_kg() * problem.chain().gravity_m_s2() }
    }

    /// Unit of energies and moments, J.
    pub fn mgl_j(&self) -> f64 {
        self.mg_n * self.l_m
    }
}

/// The paper's V counts from the level of all bars' centres 6 *l* in sum below *O*.
const ENERGY_ZERO_MGL: f64 = 6.0;

/// An equilibrium of the example in the paper's own numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planar {
    /// theta, alpha, beta from the descending vertical towards +Y, rad, in (-pi, pi].
    pub angles_rad: [f64; 3],
    /// V of (v), mgl.
    pub v_mgl: f64,
    /// The multipliers, mg: O, A, B, D.
    pub forces_mg: [Vector; 4],
    /// Largest distance of a joint from the plane *OYZ*, l.
    pub aside_l: f64,
}

impl Planar {
    /// The equilibrium as it is, read in the plane *OYZ*.
    fn of(units: PaperUnits, found: &Equilibrium) -> Self {
        let joints = &found.joints_m;
        let angles_rad = std::array::from_fn(|i| {
            f64::atan2(joints[i + 1][1] - joints[i][1], joints[i][2] - joints[i + 1][2])
        });
        Self {
            angles_rad,
            v_mgl: found.energy_j / units.mgl_j() + ENERGY_ZERO_MGL,
            forces_mg: std::array::from_fn(|k| found.multipliers_n[k].map(|f| f / units.mg_n)),
            aside_l: joints.iter().map(|j| j[0].abs()).fold(0.0, f64::max) / units.l_m,
        }
    }

    /// The equilibrium turned about the vertical until joint A lies towards +Y: any solution in
    /// space in the paper's plane.
    fn turned(units: PaperUnits, found: &Equilibrium) -> Self {
        let [x, y, _] = found.joints_m[1];
        let r = x.hypot(y);
        let (sin, cos) = if r > 0.0 { (x / r, y / r) } else { (0.0, 1.0) };
        let turn = |[x, y, z]: Vector| [cos * x - sin * y, sin * x + cos * y, z];
        let mut found = found.clone();
        found.joints_m.iter_mut().chain(&mut found.multipliers_n).for_each(|v| *v = turn(*v));
        Self::of(units, &found)
    }
}

/// The four planar equilibria by `lagrange`.
#[derive(Debug, Clone, PartialEq)]
pub struct ByLagrange {
    /// The minimum.
    pub e1: lagrange::Solution,
    /// Its mirror image.
    pub e1_mirrored: lagrange::Solution,
    /// The maximum in the plane.
    pub e2: lagrange::Solution,
    /// Its mirror image.
    pub e2_mirrored: lagrange::Solution,
}

impl ByLagrange {
    /// All four.
    pub fn all(&self) -> [&lagrange::Solution; 4] {
        [&self.e1, &self.e1_mirrored, &self.e2, &self.e2_mirrored]
    }
}

/// What `energy` has to say.
#[derive(Debug, Clone, PartialEq)]
pub struct ByEnergy {
    /// The minimum in space, from no guess.
    pub e1: energy::Solution,
    /// The minimum in the plane from the mirrored seed.
    pub e1_mirrored: energy::Solution,
    /// Where a minimisation in the plane ends that starts exactly at E2.
    pub from_e2: energy::Solution,
    /// (vi) minimised over theta and alpha.
    pub minimum: ExampleMinimum,
    /// The paper's scan.
    pub scan: Scan,
    /// Second-order behaviour at E2, by the energy.
    pub at_e2: energy::SecondOrder,
    /// Reaction at D by differences of the least energy, mg, turned into the plane *OYZ*.
    pub reaction_at_d_mg: Vector,
}

/// The example, solved.
#[derive(Debug, Clone, PartialEq)]
pub struct Example {
    /// Three equal bars, anchors 2 l apart on one vertical.
    pub problem: Problem,
    /// Its units.
    pub units: PaperUnits,
    /// The four equilibria by `lagrange`.
    pub lagrange: ByLagrange,
    /// What `energy` has to say.
    pub energy: ByEnergy,
    /// All equilibria, with proof.
    pub census: Census,
}

impl Example {
    /// Solve it.
    ///
    /// # Errors
    ///
    /// [`ExampleError`] when a solver fails: there is then nothing to judge.
    pub fn solve() -> Result<Self, ExampleError> {
        let problem = model::cases::paper();
        let units = PaperUnits::of(&problem);
        let settings = lagrange::Settings::default();
        let find = |near, angles: [f64; 3]| {
            lagrange::solve_from(&problem, &Seed::planar(&angles), &settings)
                .map_err(|error| ExampleError::Lagrange { near, error })
        };
        let lagrange = ByLagrange {
            e1: find("E1", NEAR_E1)?,
            e1_mirrored: find("E1'", NEAR_E1.map(|x| -x))?,
            e2: find("E2", NEAR_E2)?,
            e2_mirrored: find("E2'", NEAR_E2.map(|x| -x))?,
        };
        let energy = Self::by_energy(&problem, units, &lagrange)?;
        let census = Census::take(&problem, &census::Settings::default())?;
        Ok(Self { problem, units, lagrange, energy, census })
    }

    fn by_energy(
        problem: &Problem,
        units: PaperUnits,
        lagrange: &ByLagrange,
    ) -> Result<ByEnergy, ExampleError> {
        let space = energy::Settings::default();
        let plane = energy::Settings { motion: energy::Motion::Plane, ..space };
        let seed = |angles: [f64; 3]| energy::Seed::angles(problem, &angles);
        let e2 = seed(Planar::of(units, &lagrange.e2.equilibrium).angles_rad)?;
        let e1 = energy::minimise(problem, &space)?;
        let in_plane = energy::minimise_from(problem, &seed(NEAR_E1)?, &plane)?;
        let reaction = energy::reaction_by_differences(problem, &in_plane, &space)?;
        Ok(ByEnergy {
            e1,
            e1_mirrored: energy::minimise_from(problem, &seed(NEAR_E1.map(|x| -x))?, &plane)?,
            from_e2: energy::minimise_from(problem, &e2, &plane)?,
            minimum: energy::example::minimise(NEAR_E1[0], NEAR_E1[1], &space)?,
            scan: scan(PAPER_STEP_RAD).ok_or(ExampleError::Scan)?,
            at_e2: energy::second_order(problem, &e2)?,
            reaction_at_d_mg: reaction.map(|f| f / units.mg_n),
        })
    }

    /// V of the paper, mgl, from an energy measured from the height of *O*, J.
    pub fn v_mgl(&self, energy_j: f64) -> f64 {
        energy_j / self.units.mgl_j() + ENERGY_ZERO_MGL
    }

    /// One of the solutions of `lagrange` in the paper's numbers.
    pub fn by_lagrange(&self, found: &lagrange::Solution) -> Planar {
        Planar::of(self.units, &found.equilibrium)
    }

    /// E1 by `energy` in the paper's numbers.
    pub fn by_energy_e1(&self) -> Planar {
        Planar::turned(self.units, &self.energy.e1.equilibrium)
    }

    /// A solution of `energy` in the plane, as it is.
    pub fn by_energy_in_plane(&self, found: &energy::Solution) -> Planar {
        Planar::of(self.units, &found.equilibrium)
    }
}
