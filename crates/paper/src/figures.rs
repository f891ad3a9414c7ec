//! What there is to draw: the closure curve with the paper's scan on it, and how each solver
//! converges.

use energy::example::{Branch, PAPER_STEP_RAD, ScanMinimum, curve};
use model::{Problem, SolverName};
use serde::Serialize;

use crate::basins::Basins;
use crate::example::Example;

/// Points of each branch of the closure curve: half a degree of arc or less between neighbours.
const CURVE_POINTS: usize = 721;

/// Starts of the histories: angles of the three bars, rad, and what they are. The first is that of
/// the solved example; the others lie far from every equilibrium.
const STARTS: [(&str, [f64; 3]); 2] =
    [("rough guess near E1", [0.3, 0.7, -1.3]), ("all bars swung out", [1.4, 2.2, -1.0])];

/// How far from the first result of the scan the curve is drawn once more, enlarged, deg; the step
/// of the scan is 0.0573 deg.
pub const NEAR_DEG: f64 = 0.15;

/// Points of the enlarged piece.
const NEAR_POINTS: i32 = 121;

/// Largest number of iterations that a history asks `energy` for; it is done long before.
const MOST_ITERATIONS: u64 = 60;

/// What there is to draw: angles in degrees from the descending vertical, energies in mgl.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Closed chains: theta, alpha, beta, V.
    pub closure_curve: Vec<[f64; 4]>,
    /// The points of the paper's scan on each of its two branches: theta, V.
    pub scan_points: [Vec<[f64; 2]>; 2],
    /// The results of the scan, (ix) and (x): theta, alpha, beta, V.
    pub scan_results: [[f64; 4]; 2],
    /// V along the curve within [`NEAR_DEG`] of the first result: theta, V.
    pub near_minimum: Vec<[f64; 2]>,
    /// Slope of V along the closure curve at (x), mgl/rad.
    pub slope_at_x: f64,
    /// Where the starts of a slice lead, by each solver.
    pub basins: [Basins; 2],
    /// Residuals of the solvers, iteration by iteration.
    pub histories: Vec<History>,
}

/// How one solver converged from one start.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct History {
    /// The solver.
    pub solver: SolverName,
    /// The start in words.
    pub start: &'static str,
    /// Its angles, deg.
    pub start_deg: [f64; 3],
    /// theta, alpha, beta where it ended, deg, signed.
    pub end_deg: [f64; 3],
    /// Number of the iteration that the first residual is left after; 0 for the start itself.
    pub first_iteration: usize,
    /// The residual after each iteration, dimensionless; see `residual_of`.
    pub residuals: Vec<f64>,
    /// What the residual measures.
    pub residual_of: &'static str,
}

impl Figures {
    /// Work them out.
    pub fn compute(example: &Example) -> Self {
        let (problem, found) = (&example.problem, &example.energy.scan);
        let scanned = |branch: Branch| {
            (1..=found.first.points)
                .filter_map(|k| {
                    let theta = k as f64 * PAPER_STEP_RAD;
                    let alpha = energy::example::alpha(theta, branch)?;
                    Some([theta.to_degrees(), energy::example::potential(theta, alpha)])
                })
                .collect()
        };
        Self {
            closure_curve: curve(CURVE_POINTS)
                .iter()
                .map(|p| point(p.theta_rad, p.alpha_rad, p.beta_rad, p.energy_mgl))
                .collect(),
            scan_points: Branch::BOTH.map(scanned),
            scan_results: [result(&found.first), result(&found.second)],
            near_minimum: near(&found.first),
            slope_at_x: energy::example::slope(found.second.theta_rad, found.second.branch),
            basins: Basins::of_both(example),
            histories: STARTS
                .iter()
                .flat_map(|&(start, angles)| {
                    [by_lagrange(problem, start, angles), by_energy(problem, start, angles)]
                })
                .flatten()
                .collect(),
        }
    }
}

fn point(theta: f64, alpha: f64, beta: f64, energy: f64) -> [f64; 4] {
    [theta.to_degrees(), alpha.to_degrees(), beta.to_degrees(), energy]
}

fn result(m: &ScanMinimum) -> [f64; 4] {
    point(m.theta_rad, m.alpha_rad, m.beta_rad, m.energy_mgl)
}

/// The closure curve about a result of the scan.
fn near(found: &ScanMinimum) -> Vec<[f64; 2]> {
    (0..NEAR_POINTS)
        .filter_map(|k| {
            let fraction = 2.0 * f64::from(k) / f64::from(NEAR_POINTS - 1) - 1.0;
            let theta = found.theta_rad + fraction * NEAR_DEG.to_radians();
            let alpha = energy::example::alpha(theta, found.branch)?;
            Some([theta.to_degrees(), energy::example::potential(theta, alpha)])
        })
        .collect()
}

/// theta, alpha, beta of joints in the plane *OYZ*, deg.
fn angles_deg(joints: &[model::Vector]) -> [f64; 3] {
    std::array::from_fn(|i| {
        f64::atan2(joints[i + 1][1] - joints[i][1], joints[i][2] - joints[i + 1][2]).to_degrees()
    })
}

/// `lagrange` writes its history itself. Nothing if it finds no equilibrium.
fn by_lagrange(problem: &Problem, start: &'static str, angles: [f64; 3]) -> Option<History> {
    let settings = lagrange::Settings::default();
    let seed = lagrange::Seed::planar(&angles);
    let found = lagrange::solve_from(problem, &seed, &settings).ok()?;
    let mut residuals = found.residual_history;
    // The history ends before the last step; the answer's own residual is in the same units.
    residuals.push(found.equilibrium.evidence.residual);
    Some(History {
        solver: SolverName::LAGRANGE,
        start,
        start_deg: angles.map(f64::to_degrees),
        end_deg: angles_deg(&found.equilibrium.joints_m),
        first_iteration: 0,
        residuals,
        residual_of: "norm of the reduced equations, in mg, mgl and l; at the end the largest of all 30",
    })
}

/// `energy` is run again and again with one iteration more each time: what is left after k
/// iterations is what it says when it is stopped there.
fn by_energy(problem: &Problem, start: &'static str, angles: [f64; 3]) -> Option<History> {
    let seed = energy::Seed::angles(problem, &angles).ok()?;
    let mut residuals = Vec::new();
    for max_iterations in 1..=MOST_ITERATIONS {
        let settings = energy::Settings {
            max_iterations,
            motion: energy::Motion::Plane,
            ..energy::Settings::default()
        };
        match energy::minimise_from(problem, &seed, &settings) {
            Err(energy::Error::NotConverged { gradient, .. }) => residuals.push(gradient),
            Err(_) => return None,
            Ok(found) => {
                residuals.push(found.work.gradient);
                return Some(History {
                    solver: SolverName::ENERGY,
                    start,
                    start_deg: angles.map(f64::to_degrees),
                    end_deg: angles_deg(&found.equilibrium.joints_m),
                    first_iteration: 1,
                    residuals,
                    residual_of: "projected gradient: largest force across a bar, over the largest force",
                });
            }
        }
    }
    None
}
