//! A third independent answer: the chain as a conic programme.
//!
//! Hang cables instead of bars, $|d_i| \le l_i$, and the least energy is a second-order cone
//! programme, solved by clarabel's interior point method with neither Newton's laws nor a search
//! among shapes. Where all cables are taut they are the bars: the optimum is the energy of the
//! equilibrium, the duals of the cones are the bar vectors and the axial forces (clarabel's optimum
//! is good to its tolerance; from there [`cable_bound`] goes on to rounding by closing the cables).
//! Where a bar is pressed the programme is below it, and says which cables are slack.
//!
//! ```
//! use validate::cables::hold_against_cables;
//! // The paper's third bar is pressed: no cable can be.
//! let problem = model::cases::paper();
//! let found = lagrange::condensed::solve(&problem, &lagrange::condensed::Settings::default())?;
//! let cables = hold_against_cables(&problem, &found.equilibrium)?;
//! // Its energy is 2.33546865 mgl in the paper's terms, that of the cables 2; the weight times
//! // length is 9.
//! assert!(!cables.taut && (cables.gap - 0.33546865 / 9.0).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use bounds::{BoundError, BoundSettings, cable_bound};
use model::{Equilibrium, Problem, Vector};
use serde::Serialize;

use crate::tolerances::Tolerances;

/// Smallest axial force, in units of the largest joint force, that says that a bar is in tension:
/// below it the two methods may well differ about which bars carry nothing.
const TENSION: f64 = 1e-9;

/// Joints within this part of the length of one vertical are on it. A chain that closes to a
/// rounding of its length bends off a line by the square root of that, 1e-8.
const LINE: f64 = 1e-8;

/// An equilibrium held against the cables.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cables {
    /// Whether every cable is taut, so that the cables are the chain.
    pub taut: bool,
    /// How many are slack.
    pub slack: usize,
    /// Whether the equilibrium has every bar in tension: the same question asked of it.
    pub in_tension: bool,
    /// Energy of the equilibrium less the proven bound, in units of weight times length.
    pub gap: f64,
    /// The solver's own optimum less the proven bound, the same unit: what its tolerance leaves.
    pub optimum: f64,
    /// Largest difference of an axial force, in units of the larger of the weight and the largest
    /// joint force; `None` where all bars hang on one vertical line, and two strands share the
    /// weight of the lowest joint in any way they like.
    pub axial: Option<f64>,
    /// Largest distance of a joint, in units of the total length; `None` about anchors on one
    /// vertical, where the planes need not be the same.
    pub joints: Option<f64>,
    /// Iterations of the interior point method.
    pub iterations: usize,
}

impl Cables {
    /// Whether the cables confirm the equilibrium: taut with the same energy and the same axial
    /// forces, or slack and below it. The budgets are those of two solvers that are compared.
    #[must_use]
    pub fn confirm(&self, tolerances: &Tolerances) -> bool {
        let [energy, axial] = [&tolerances.energy, &tolerances.forces].map(|budget| budget.value);
        if self.taut != self.in_tension {
            return false;
        }
        // A gap below zero by more than rounding would disprove a proof; NaN fails.
        if self.taut {
            self.gap.abs() <= energy && self.axial.is_none_or(|worst| worst <= axial)
        } else {
            self.gap > -energy
        }
    }
}

/// Solve the chain as cables and hold an equilibrium against it.
///
/// # Errors
///
/// [`BoundError`] when clarabel does not solve the programme.
pub fn hold_against_cables(problem: &Problem, found: &Equilibrium) -> Result<Cables, BoundError> {
    let chain = problem.chain();
    let bound = cable_bound(problem, &BoundSettings::default())?;
    let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
    let length_m = chain.total_length_m();
    let force_n = found.multipliers_n.iter().map(|f| norm(*f)).fold(weight_n, f64::max);
    let energy_j = weight_n * length_m;
    let axial = bound.cables.axial_n.iter().zip(&found.axial_n).map(|(a, b)| (a - b).abs());
    let apart = bound.cables.joints_m.iter().zip(&found.joints_m).map(|(a, b)| {
        let off = std::array::from_fn(|k| a[k] - b[k]);
        norm(off)
    });
    let origin = chain.anchors().start_m;
    let aside = found.joints_m.iter().map(|[x, y, _]| (x - origin[0]).hypot(y - origin[1]));
    let on_a_line = worst(aside) <= LINE * length_m;
    Ok(Cables {
        taut: bound.is_equilibrium(),
        slack: bound.slack.len(),
        in_tension: found.axial_n.iter().all(|n| *n > TENSION * force_n),
        gap: bound.gap_j(found.energy_j) / energy_j,
        optimum: (bound.bound_j - bound.rigorous_j) / energy_j,
        axial: (!on_a_line).then(|| worst(axial) / force_n),
        joints: (!chain.anchors_on_one_vertical()).then(|| worst(apart) / length_m),
        iterations: bound.evidence.iterations,
    })
}

/// The largest value, NaN if there is one (`f64::max` would forget it).
fn worst(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

fn norm([x, y, z]: Vector) -> f64 {
    x.hypot(y).hypot(z)
}

#[cfg(test)]
mod tests;
