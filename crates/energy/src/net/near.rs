//! Forces to begin with next to a drawing: those of the linear analysis.
//!
//! At the shape as it is drawn the members are springs, elastic ones with their own stiffness and
//! the excess that they have there, inextensible ones so stiff that nothing else moves them. The
//! quadratic energy has its minimum where `(sum k J Jᵀ) u = p - sum k c J`; the forces are
//! `k (c + J u)`. A motion that no member resists, as the sideways one of a taut string, is left to
//! a ridge: it takes part in no force.

use crate::net::factor::Factor;
use crate::net::frame::{Frame, Rod};
use crate::net::shape::Shape;
use crate::thresholds::RIDGE;
use crate::vector::scaled;

/// Stiffness of inextensible members over that of the stiffest elastic one: their forces are right
/// to the inverse of it, which is enough to begin with, and errors of lengths fall by it in a step.
const RIGID: f64 = 1e3;

/// Where a cable or a strut would be loose by less than this of its length it is taken for taut.
const LOOSE: f64 = 1e-3;

impl Frame {
    /// The stiffness that stands for that of inextensible members; this one where no member is elastic.
    pub(super) fn rigid(&self, alone: f64) -> f64 {
        let elastic = self.rods.iter().filter(|rod| rod.elastic());
        elastic.map(|rod| 1.0 / rod.flexibility).reduce(f64::max).map_or(alone, |most| RIGID * most)
    }
}

/// The drawing with the forces of its linear analysis, and, of elastic structures, the largest relative displacement of
/// the ends of a member there, over its length. Cables and struts that would have the wrong sign bear nothing.
pub(super) fn loaded(frame: &Frame, factor: &mut Factor, drawn: &Shape) -> (Shape, f64) {
    let excess = frame.excesses(&drawn.x);
    let rigid = frame.rigid(1.0);
    let taut = |e: usize| {
        let rod = &frame.rods[e];
        let off = excess[e].value / rod.length;
        off.abs() <= LOOSE || rod.resists(off)
    };
    let stiffness = |e: usize| {
        let rod = &frame.rods[e];
        match (taut(e), rod.elastic()) {
            (false, _) => 0.0,
            (true, true) => 1.0 / rod.flexibility,
            (true, false) => rigid / rod.length,
        }
    };
    let strained = |e: usize| {
        let own = if frame.rods[e].elastic() { excess[e].value } else { 0.0 };
        stiffness(e) * own
    };
    frame.fill(factor, |e| excess[e].block(0.0, stiffness(e)), |_| RIDGE * rigid);
    if !factor.definite() {
        return (drawn.clone(), f64::INFINITY);
    }
    let moves = factor.step_against(frame.gradient(|e| scaled(strained(e), excess[e].gradient)));
    let force = (0..frame.rods.len()).map(|e| {
        let force = strained(e) + stiffness(e) * frame.change(&excess, e, &moves);
        if frame.rods[e].resists(force) { force } else { 0.0 }
    });
    // Inextensible members alone move by what is left of their stiffness.
    let is_elastic = frame.rods.iter().any(Rod::elastic);
    let rods = frame.rods.iter().enumerate().filter(|_| is_elastic);
    let turned = rods.map(|(e, rod)| frame.turned(&moves, e) / rod.length);
    let turned = turned.reduce(f64::max).unwrap_or(f64::INFINITY);
    (Shape { x: drawn.x.clone(), force: force.collect() }, turned)
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, System};

    use super::*;

    /// A at 0, P drawn at -1.2 m, B at -4 m; springs of 1 m and 40 N above and of 2 m and 30 N below, 5 N at P: they
    /// bear 8 N and 12 N as drawn, and P sinks by 9/55 m. A rigid member beside the upper one bears all of 12 N and
    /// 5 N that the upper spring does not.
    #[test]
    fn drawings_bear_the_forces_of_their_linear_analysis() {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("P").with_mass(0.5),
            Joint::anchor("B", [0.0, 0.0, -4.0]),
            Joint::anchor("C", [0.0, 0.0, 1.0]),
        ];
        let bar =
            |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
        let springs =
            vec![bar(0, 1, 1.0).with_stiffness(40.0), bar(1, 2, 2.0).with_stiffness(30.0)];
        let rigid = bar(3, 1, 2.2);
        for (members, wanted_n) in [
            (springs.clone(), vec![8.0 + 40.0 * 9.0 / 55.0, 12.0 - 15.0 * 9.0 / 55.0]),
            ([springs, vec![rigid]].concat(), vec![8.0, 12.0, 9.0]),
        ] {
            let system = System::new("drawn", 10.0, joints.clone(), members).unwrap();
            let frame = Frame::new(&system).unwrap();
            let x = [0.0, -1.2, -4.0, 1.0]
                .map(|z| [0.0, 0.0, (z - frame.origin_m[2]) / frame.length_m])
                .to_vec();
            let drawn = Shape { x, force: vec![0.0; frame.rods.len()] };
            let mut factor = Factor::new(&frame.spots, &frame.rods, &frame.meter).unwrap();
            let (found, _) = loaded(&frame, &mut factor, &drawn);
            for (force, wanted_n) in found.force.iter().zip(&wanted_n) {
                // Inextensible ones to the inverse of their stiffness, 1000 times the stiffest.
                let near = (force * frame.force_n - wanted_n).abs() < 0.02;
                assert!(near, "{} {wanted_n:?}", force * frame.force_n);
            }
            if wanted_n.len() == 2 {
                assert!((found.force[0] * frame.force_n - wanted_n[0]).abs() < 1e-4);
            }
        }
    }
}
