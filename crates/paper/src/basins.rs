//! Which start leads where: a slice through the planar starts, by both solvers.

use model::SolverName;
use rayon::prelude::*;
use serde::Serialize;

use crate::example::Example;

/// Starts along each of theta and alpha. Odd, so that 0 is one of them and the picture is
/// symmetric.
const SIDE: usize = 73;

/// A slice: the third bar hangs straight down at the start, the other two angles are those of a
/// grid.
const BETA_RAD: f64 = 0.0;

/// How close an end has to come in energy to an equilibrium to be it, mgl.
const SAME_ENERGY_MGL: f64 = 1e-9;

/// E1, E1', E2, E2'.
const LETTERS: [char; 4] = ['1', '2', '3', '4'];

/// No equilibrium.
const NO_ANSWER: char = '-';

/// Where the starts of a slice lead with one solver.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Basins {
    /// The solver.
    pub solver: SolverName,
    /// One string for each alpha from 180 to −180 deg, one letter for each theta from −180 to 180
    /// deg: `1`, `2`, `3`, `4` for E1, E1', E2, E2', `-` where the solver gave no answer.
    pub rows: Vec<String>,
}

impl Basins {
    /// Both solvers over the same slice.
    pub fn of_both(example: &Example) -> [Self; 2] {
        let places = example.lagrange.all().map(|found| {
            let planar = example.by_lagrange(found);
            (planar.v_mgl, planar.angles_rad[0] > 0.0)
        });
        let letter = |(v_mgl, towards_y): End| {
            let same =
                |place: &End| (place.0 - v_mgl).abs() <= SAME_ENERGY_MGL && place.1 == towards_y;
            LETTERS
                .into_iter()
                .zip(&places)
                .find(|(_, place)| same(place))
                .map(|(letter, _)| letter)
        };
        let rows = |ends: Ends| {
            let rows = (0..SIDE).into_par_iter().rev().map(|row| {
                let starts: Vec<_> =
                    (0..SIDE).map(|column| [angle(column), angle(row), BETA_RAD]).collect();
                let ends = ends(example, &starts).into_iter();
                ends.map(|end| end.and_then(letter).unwrap_or(NO_ANSWER)).collect()
            });
            rows.collect()
        };
        [
            Self { solver: SolverName::LAGRANGE, rows: rows(by_lagrange) },
            Self { solver: SolverName::ENERGY, rows: rows(by_energy) },
        ]
    }

    /// How many starts lead to the equilibrium of this letter.
    pub fn count(&self, letter: char) -> usize {
        self.rows.iter().map(|row| row.chars().filter(|c| *c == letter).count()).sum()
    }
}

/// Angle of a line of the grid, rad.
fn angle(k: usize) -> f64 {
    (2.0 * k as f64 / (SIDE - 1) as f64 - 1.0) * std::f64::consts::PI
}

/// V in mgl where a start ends, and whether joint A lies towards +Y there.
type End = (f64, bool);

/// Where starts end with a solver.
type Ends = fn(&Example, &[[f64; 3]]) -> Vec<Option<End>>;

/// Where each start ends by `lagrange`.
fn by_lagrange(example: &Example, starts: &[[f64; 3]]) -> Vec<Option<End>> {
    let solver = lagrange::Solver::new(&example.problem, &lagrange::Settings::default());
    let Ok(mut solver) = solver else { return vec![None; starts.len()] };
    let mut end = |angles: &[f64; 3]| {
        let found = solver.solve(&lagrange::Seed::planar(angles)).ok()?;
        Some((example.v_mgl(found.energy_j()), found.first_offset_m()[1] > 0.0))
    };
    starts.iter().map(&mut end).collect()
}

/// The same by `energy`, which stays in the plane.
fn by_energy(example: &Example, starts: &[[f64; 3]]) -> Vec<Option<End>> {
    let settings =
        energy::Settings { motion: energy::Motion::Plane, ..energy::Settings::default() };
    let end = |angles: &[f64; 3]| {
        let seed = energy::Seed::angles(&example.problem, angles).ok()?;
        let found = energy::minimise_from(&example.problem, &seed, &settings).ok()?.equilibrium;
        Some((example.v_mgl(found.energy_j), found.joints_m[1][1] > found.joints_m[0][1]))
    };
    starts.iter().map(end).collect()
}
