//! The forces that leave the joints of given positions least out of balance.

use model::system::{Kind, Member, System};
use model::{Jam, Vector};
use serde::Serialize;

use super::bounds::{Bounds, IMPLAUSIBLE};
use super::least_squares::{Column, Found, Problem};
use crate::systems::spans;
use numerics::vector::{dot, norm, times};

/// Forces found for positions that came without.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BestForces {
    /// Axial force of each member, N.
    #[serde(skip)]
    pub axial_n: Vec<f64>,
    /// What spans of taut ropes bear whose joints are in one place.
    #[serde(skip)]
    pub jams: Vec<Jam>,
    /// What they leave over at each joint along the motions that its support leaves free, N.
    #[serde(skip)]
    pub left_n: Vec<Vector>,
    /// Root of the sum of squares of that, N.
    pub residual_n: f64,
    /// What no forces up to [`up_to_n`](Self::up_to_n) leave less than, N: a proof, however the
    /// search for the best ones ended.
    pub least_n: f64,
    /// The forces of which that is said: [`IMPLAUSIBLE`] times the largest that was found, or times
    /// all loads together, N.
    pub up_to_n: f64,
    /// Largest of the forces, N.
    pub largest_n: f64,
    /// Steps of the search that left less and less over.
    pub steps: usize,
    /// Whether these are the best ones: they leave no more than the proof says, to a millionth of
    /// the forces and loads.
    pub converged: bool,
}

/// How near the forces found come to the proof that no others are better, in units of the largest
/// force or of all loads together: what a judgement to six digits needs. The proof loses the square
/// of rounding over the residual, 1e-8 of them at worst.
const CLOSE: f64 = 1e-6;

/// The force of an elastic member by its law, N.
pub(super) fn law_n(kind: Kind, stiffness_n: f64, length_m: f64, distance_m: f64) -> f64 {
    kind.borne(stiffness_n * ((distance_m - length_m) / length_m))
}

/// The least and the largest force of a member by its law at lengths that the bounds allow, N: none where it is slack, that of
/// its elongation where it is elastic.
pub(super) fn limits_n(member: &Member, joints_m: &[Vector], bounds: &Bounds) -> [f64; 2] {
    let (distance_m, length_m) = (spans::length_m(member, joints_m), member.body.length_m());
    let reach_m = bounds.distance_m(member);
    match (member.stiffness_n, member.kind) {
        (Some(stiffness_n), kind) => {
            [-reach_m, reach_m].map(|off_m| law_n(kind, stiffness_n, length_m, distance_m + off_m))
        }
        (None, Kind::Bar) => [f64::NEG_INFINITY, f64::INFINITY],
        (None, Kind::Cable) if distance_m < length_m - reach_m => [0.0; 2],
        (None, Kind::Strut) if distance_m > length_m + reach_m => [0.0; 2],
        (None, Kind::Cable) => [0.0, f64::INFINITY],
        (None, Kind::Strut) => [f64::NEG_INFINITY, 0.0],
    }
}

/// A span whose joints meet: member, number of the span in it, and the columns of its pull.
type MetSpan = (usize, usize, [Column; 3]);

/// The spans of ropes whose joints meet. Such a span has no direction, and its pull is sought by its
/// parts, none of them larger than the largest tension of the rope.
fn met_spans(
    system: &System,
    joints_m: &[Vector],
    bounds: &Bounds,
    ropes: &[Column],
) -> Vec<MetSpan> {
    let mut met = Vec::new();
    for (k, (member, rope)) in system.members().iter().zip(ropes).enumerate() {
        for (number, [a, b]) in member.spans().enumerate() {
            if bounds.meet(member, [a, b], joints_m) {
                let part = |c: usize| {
                    let axis: Vector = std::array::from_fn(|k| f64::from(u8::from(k == c)));
                    let pulls = vec![(a, axis), (b, times(-1.0, axis))];
                    Column { pulls, lower: -rope.upper, upper: rope.upper }
                };
                met.push((k, number, [0, 1, 2].map(part)));
            }
        }
    }
    met
}

/// Find the axial forces that leave the joints at these places least out of balance: least squares
/// under the members' laws. A cable that is shorter than its length is slack, a strut that is
/// longer is loose; an elastic member has the force of its elongation; each as far as the bounds of
/// the positions decide it. A span of a taut rope whose joints have run together bears what balances
/// both.
pub fn best_forces(system: &System, joints_m: &[Vector], bounds: &Bounds) -> BestForces {
    let mut columns: Vec<Column> = system
        .members()
        .iter()
        .map(|member| {
            let [lower, upper] = limits_n(member, joints_m, bounds);
            let long = member.spans().filter(|span| !bounds.meet(member, *span, joints_m));
            let gradient = spans::gradient(long, joints_m).into_iter();
            let pulls = gradient.map(|(joint, longer)| (joint, times(-1.0, longer))).collect();
            Column { pulls, lower, upper }
        })
        .collect();
    let met = met_spans(system, joints_m, bounds, &columns);
    columns.extend(met.iter().flat_map(|(.., pulls)| pulls.clone()));
    let loads = system.joint_loads_n();
    let joints = system.joints();
    let free = |joint: usize, vector: Vector| joints[joint].support.free_part(vector);
    let problem = Problem { columns: &columns, loads: &loads, free: &free };
    let found = problem.solve();
    let (axial_n, parts_n) = found.x.split_at(system.members().len());
    let largest_n = axial_n.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
    let scale_n = largest_n.max(model::sum(loads.iter().map(|load| norm(*load))));
    let up_to_n = IMPLAUSIBLE * scale_n;
    let least_n = problem.least(&found, up_to_n);
    let jam = |((member, span, _), part_n): (&MetSpan, &[f64])| Jam {
        member: *member,
        span: *span,
        pull_n: std::array::from_fn(|c| part_n[c]),
    };
    let jams = met.iter().zip(parts_n.chunks_exact(3)).map(jam).collect();
    let axial_n = axial_n.to_vec();
    let Found { left, steps, .. } = found;
    let residual_n = model::sum(left.iter().map(|left| dot(*left, *left))).sqrt();
    BestForces {
        axial_n,
        jams,
        left_n: left,
        residual_n,
        least_n,
        up_to_n,
        largest_n,
        steps,
        converged: residual_n - least_n <= CLOSE * scale_n,
    }
}

#[cfg(test)]
pub(super) mod tests;
