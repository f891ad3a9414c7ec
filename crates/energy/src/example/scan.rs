//! The paper's scan, exactly as it was done.

use super::{Branch, beta, candidates, potential};

/// The step of the paper's scan, rad: (ix) and (x) are points of it.
pub const PAPER_STEP_RAD: f64 = 0.001;

/// A smallest value found by the scan: what the paper took for an equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct ScanMinimum {
    /// The solution of (viii).
    pub branch: Branch,
    /// Number of the scan point, from 1.
    pub point: usize,
    /// Scan points on the branch.
    pub points: usize,
    /// Angle of bar 1, rad.
    pub theta_rad: f64,
    /// Angle of bar 2, rad.
    pub alpha_rad: f64,
    /// Angle of bar 3, rad.
    pub beta_rad: f64,
    /// Energy (vi), `mgl`.
    pub energy_mgl: f64,
}

/// The numbers as the paper prints them: degrees in [0, 360) and `mgl`, five decimals.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Printed {
    /// Theta, degrees.
    pub theta: String,
    /// Alpha, degrees.
    pub alpha: String,
    /// Beta, degrees.
    pub beta: String,
    /// Energy, `mgl`.
    pub energy: String,
}

impl ScanMinimum {
    /// Rounded as the paper rounds.
    pub fn printed(&self) -> Printed {
        let degrees = |rad: f64| format!("{:.5}", rad.to_degrees().rem_euclid(360.0));
        Printed {
            theta: degrees(self.theta_rad),
            alpha: degrees(self.alpha_rad),
            beta: degrees(self.beta_rad),
            energy: format!("{:.5}", self.energy_mgl),
        }
    }

    /// Whether the smallest value is the first point of the scan: then nothing says that the energy
    /// does not fall on before it.
    pub fn is_end_point(&self) -> bool {
        self.point == 1
    }
}

/// The results of a scan on both branches.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// The branch of `alpha_1`: the paper's (ix).
    pub first: ScanMinimum,
    /// The branch of `alpha_2`: the paper's (x).
    pub second: ScanMinimum,
}

/// Scan `theta = step, 2 step, ...` as far as (viii) has solutions, solve it for alpha, evaluate
/// (vi), and keep the smallest value on each branch.
///
/// `None` if the step is not a number of at least 1e-8 that leaves at least one point.
///
/// ```
/// use energy::example::{PAPER_STEP_RAD, scan};
/// let found = scan(PAPER_STEP_RAD).unwrap();
/// let ix = found.first.printed();
/// assert_eq!([&*ix.theta, &*ix.alpha, &*ix.beta, &*ix.energy],
///            ["19.70975", "38.58306", "286.07420", "2.33547"]);
/// let x = found.second.printed();
/// assert_eq!([&*x.theta, &*x.alpha, &*x.beta, &*x.energy],
///            ["0.05730", "299.94274", "59.94267", "2.50087"]);
/// assert!(found.second.is_end_point());
/// ```
///
/// Equations (vi), (viii), (ix), (x) of the paper.
pub fn scan(step_rad: f64) -> Option<Scan> {
    if step_rad.is_nan() || step_rad < SMALLEST_STEP_RAD {
        return None;
    }
    let mut best: [Option<ScanMinimum>; 2] = [None, None];
    let mut points = 0;
    for point in 1.. {
        let theta_rad = point as f64 * step_rad;
        let mut closing: Vec<f64> =
            candidates(theta_rad).iter().filter(|c| c.closes).map(|c| c.alpha_rad).collect();
        // The larger alpha is the branch of the first quadrant.
        closing.sort_by(|a, b| b.total_cmp(a));
        if closing.len() != 2 {
            break;
        }
        points = point;
        for ((slot, branch), alpha_rad) in best.iter_mut().zip(Branch::BOTH).zip(closing) {
            let energy_mgl = potential(theta_rad, alpha_rad);
            if slot.as_ref().is_none_or(|b| energy_mgl < b.energy_mgl) {
                let beta_rad = beta(theta_rad, alpha_rad);
                *slot = Some(ScanMinimum {
                    branch,
                    point,
                    points: 0,
                    theta_rad,
                    alpha_rad,
                    beta_rad,
                    energy_mgl,
                });
            }
        }
    }
    let [first, second] = best.map(|slot| slot.map(|found| ScanMinimum { points, ..found }));
    Some(Scan { first: first?, second: second? })
}

/// Below this step the scan would go on for minutes.
const SMALLEST_STEP_RAD: f64 = 1e-8;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scan_stops_where_viii_has_no_solution_any_more() {
        let found = scan(PAPER_STEP_RAD).unwrap();
        // arccos(1/4) = 1.31811607...
        assert_eq!((found.first.points, found.second.points), (1318, 1318));
        assert_eq!((found.first.point, found.second.point), (344, 1));
        assert!(!found.first.is_end_point());
    }

    #[test]
    fn a_finer_scan_moves_the_first_minimum_and_keeps_the_second_at_its_end() {
        let fine = scan(1e-5).unwrap();
        // E1, theta = 19.69486797613301988864753 deg, to the step of the scan.
        assert!((fine.first.theta_rad - 19.694_867_976_133_02_f64.to_radians()).abs() < 1e-5);
        assert!(fine.second.is_end_point());
    }

    #[test]
    fn steps_that_are_none_are_refused() {
        for step in [0.0, -0.1, f64::NAN, 2.0, f64::INFINITY, 1e-300] {
            assert!(scan(step).is_none());
        }
    }
}
