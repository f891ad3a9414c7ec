use census::{Census, ProvenEquilibrium};
use nalgebra::DVector;
use serde::Serialize;

use crate::observables::Observables;
use crate::path::{Path, PlanarChain};

/// A point of the path and what its census says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PathPoint {
    /// Position on the path: 0 at its first point, 1 at its last.
    pub position: f64,
    /// The values of the parameters.
    pub values: Vec<f64>,
    /// Distance of the anchors, m.
    pub span_m: f64,
    /// What is known there.
    #[serde(flatten)]
    pub status: PointStatus,
}

/// What is known at a point.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "status")]
pub enum PointStatus {
    /// All equilibria, with proof.
    Complete {
        /// How many there are in the plane.
        count: usize,
        /// How many of each index in the plane.
        by_index: Vec<i64>,
        /// Sum of (−1)^index.
        alternating_sum: i64,
        /// The Euler characteristic of the configurations in the plane, from the lengths alone.
        euler_characteristic: Option<i64>,
        /// Whether the anchors stand on one vertical: every equilibrium stands for a circle of
        /// them, which meets the plane twice.
        circles: bool,
        /// Families of equilibria with slack bars; they are not followed.
        families: usize,
    },
    /// A degenerate point: the census leaves something undecided, or the chain fits into the line
    /// of its anchors. Branches are followed past it.
    Undecided {
        /// Why, once for each cell and straight position.
        reasons: Vec<census::Reason>,
        /// What is known all the same: the number of equilibria in the plane that are proved.
        proved: usize,
        /// Positions in which the chain lies on the line of its anchors: upright, with any force
        /// along it, or held by none.
        straight: usize,
    },
    /// The values describe no problem.
    Refused {
        /// Why.
        reason: String,
    },
}

/// An equilibrium of a census as a point of a curve.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    /// Angles, homogeneous pull, position.
    pub(crate) y: DVector<f64>,
    /// As the census has it.
    pub(crate) seen: Observables,
    /// Whether the curve's own indices and energy agree with those of the census.
    pub(crate) agrees: bool,
}

/// A position with its equilibria; without, if there is no chain or its census is not complete.
#[derive(Debug, Clone)]
pub(crate) struct CensusPoint {
    pub(crate) position: f64,
    /// Number on the grid of the path.
    pub(crate) grid: Option<usize>,
    pub(crate) nodes: Option<Vec<Node>>,
    pub(crate) status: PointStatus,
    pub(crate) span_m: f64,
    /// Whether the anchors stand on one vertical.
    pub(crate) vertical: bool,
}

/// Relative difference of energies that both come from the same equilibrium; rounding is a
/// thousandth.
const SAME_ENERGY: f64 = 1e-11;

impl CensusPoint {
    /// Take the census at a position.
    pub(crate) fn at(
        path: &Path<'_>,
        position: f64,
        grid: Option<usize>,
        settings: &census::Settings,
    ) -> Result<Self, census::CensusError> {
        let span_m = path.plane(position).span_m();
        let problem = match path.problem(&path.values_at(position)) {
            Ok(problem) => problem,
            Err(error) => {
                let status = PointStatus::Refused { reason: error.to_string() };
                return Ok(Self { position, grid, nodes: None, status, span_m, vertical: false });
            }
        };
        let census = Census::take(&problem, settings)?;
        // At a straight position pulls are without bound: there branches meet, or pass it.
        let is_followed = census.complete && census.straight.is_empty();
        let status = if is_followed {
            PointStatus::Complete {
                count: census.count_in_plane(),
                by_index: census.count_by_index(),
                alternating_sum: census.alternating_sum(),
                euler_characteristic: census.topology.as_ref().ok().map(|topology| topology.euler),
                circles: census.circles,
                families: census.families.len(),
            }
        } else {
            let undecided = census.undecided.iter().map(|undecided| undecided.reason);
            let straight = census.straight.iter().map(|_| census::Reason::Degenerate);
            PointStatus::Undecided {
                reasons: undecided.chain(straight).collect(),
                proved: census.count_in_plane(),
                straight: census.straight.len(),
            }
        };
        let nodes = is_followed.then(|| nodes(path, position, &census));
        Ok(Self { position, grid, nodes, status, span_m, vertical: census.circles })
    }

    /// Whether the values describe no problem here.
    pub(crate) fn is_refused(&self) -> bool {
        matches!(self.status, PointStatus::Refused { .. })
    }
}

fn nodes(path: &Path<'_>, position: f64, census: &Census) -> Vec<Node> {
    let plane = path.plane(position);
    let facing = path.facing(position);
    let mut nodes = vec![];
    for equilibrium in &census.equilibria {
        nodes.push(node(&plane, position, equilibrium, facing));
        if census.circles {
            nodes.push(node(&plane, position, equilibrium, -facing));
        }
    }
    nodes
}

/// A pull in the homogeneous coordinates of the equations.
fn homogeneous(plane: &PlanarChain, pull_n: [f64; 2]) -> [f64; 3] {
    let h = pull_n[0] / plane.force_unit_n;
    let v = (pull_n[1] + plane.offset_n) / plane.force_unit_n;
    let size = h.hypot(v).hypot(1.0);
    [h / size, v / size, size.recip()]
}

/// The equilibrium, or for `facing` = −1 its mirror image, in the frame of the path.
fn node(plane: &PlanarChain, position: f64, found: &ProvenEquilibrium, facing: f64) -> Node {
    let n = plane.length.len();
    let pull_n = [facing * found.pull_n[0].mid(), found.pull_n[1].mid()];
    let mut y = DVector::zeros(n + 4);
    for (slot, angle) in y.iter_mut().zip(&found.angles_rad) {
        *slot = facing * angle.mid();
    }
    for (slot, part) in y.iter_mut().skip(n).zip(homogeneous(plane, pull_n)) {
        *slot = part;
    }
    y[n + 3] = position;
    let own = Observables::at(plane, &y);
    let scale = plane.length_unit_m * plane.total_n;
    let energy_j = found.energy_j.mid();
    let agrees = own.index_in_plane == found.index_in_plane
        && own.index_out_of_plane == found.index_out_of_plane
        && (own.energy_j - energy_j).abs() <= SAME_ENERGY * scale;
    let seen = Observables {
        pull_n,
        energy_j,
        axial_n: found.axial_n.iter().map(|force| force.mid()).collect(),
        index_in_plane: found.index_in_plane,
        index_out_of_plane: found.index_out_of_plane,
        ..own
    };
    Node { y, seen, agrees }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variation::{Combine, Variation};

    /// Of the three bars of the paper between other anchors.
    #[test]
    fn a_census_is_held_against_the_formulas_of_the_curves() {
        let vary =
            ["anchors.end_m.x=0.7".parse().unwrap(), "anchors.end_m.z=-1.3".parse().unwrap()];
        let chain = model::cases::paper().into_chain();
        let variation = Variation::new(&chain, &vary, Combine::Product).unwrap();
        let paths = variation.paths();
        let path = Path::new(&variation, &paths[0]).unwrap();
        let problem = path.problem(&path.values_at(0.0)).unwrap();
        let census = Census::take(&problem, &census::Settings::default()).unwrap();
        let plane = path.plane(0.0);
        for found in &census.equilibria {
            let agrees = |change: &dyn Fn(&mut ProvenEquilibrium)| {
                let mut found = found.clone();
                change(&mut found);
                node(&plane, 0.0, &found, 1.0).agrees
            };
            assert!(agrees(&|_| {}));
            assert!(!agrees(&|found| found.index_in_plane += 1));
            assert!(!agrees(&|found| found.index_out_of_plane += 1));
            let joule = plane.total_n * plane.length_unit_m;
            let higher = |by: f64| numerics::Interval::point(by * joule);
            assert!(!agrees(&|found| found.energy_j = found.energy_j + higher(1e-10)));
            assert!(agrees(&|found| found.energy_j = found.energy_j + higher(1e-12)));
            // The same pull in newtons, by the angles and the shares of the weights.
            let seen = node(&plane, 0.0, found, 1.0);
            let own = Observables::at(&plane, &seen.y);
            for (own, census) in own.pull_n.iter().zip(seen.seen.pull_n) {
                assert!((own - census).abs() < 1e-12 * plane.total_n, "{own} {census}");
            }
            for (own, census) in own.axial_n.iter().zip(&seen.seen.axial_n) {
                assert!((own - census).abs() < 1e-11 * plane.total_n, "{own} {census}");
            }
            // Its mirror image pulls to the other side.
            let image = node(&plane, 0.0, found, -1.0);
            let [level, up] = seen.seen.pull_n;
            assert_eq!(image.seen.pull_n.map(f64::to_bits), [-level, up].map(f64::to_bits));
            assert!(image.agrees && image.y.rows(0, 3) == -seen.y.rows(0, 3));
        }
    }
}
