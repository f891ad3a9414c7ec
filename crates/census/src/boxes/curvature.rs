//! The second derivative of the equations.

use numerics::Interval;

use super::arithmetic::{Vector, dot, minus, plus, product, sum, times};
use super::equations::{Entry, Equations};

impl Equations {
    /// The derivative of $J(y)\\,\phi$ by $y$ over boxes of both, entries of the same place to be added.
    pub(super) fn curvature(&self, y: &[Interval], mode: &[Interval]) -> Vec<Entry> {
        let Self { joints, acting, .. } = self;
        let places = self.places(y);
        let mut entries = Vec::with_capacity(64 * acting.len());
        let moves: Vec<Vector> = joints.iter().map(|joint| joint.step(mode)).collect();
        for member in acting {
            let (row, force, of_force) = (member.force, y[member.force], mode[member.force]);
            for ends in &self.ends[member.spans.clone()] {
                let [a, b] = *ends;
                let (span, change) = (minus(places[b], places[a]), minus(moves[b], moves[a]));
                let direction = member.direction(span);
                let turned = direction.turned(Interval::ONE, change);
                for (joint, k, axis, sign) in self.axes(*ends) {
                    let at = joint.first + k;
                    let by = product(sign, dot(axis, turned));
                    // Balance: what pulls a pulls b the other way.
                    entries.extend([(row, at, by), (at, row, -by)]);
                    for (other, i, towards, other_sign) in self.axes(*ends) {
                        let more = direction.turned(of_force, towards);
                        let bent = times(force, direction.bent(change, towards));
                        let block = dot(axis, plus(more, bent));
                        let block = -product(product(sign, other_sign), block);
                        entries.push((at, other.first + i, block));
                    }
                }
            }
        }
        entries.retain(|(_, _, value)| *value != Interval::ZERO);
        entries
    }

    /// $F''(y)[a, b]$ over boxes.
    pub(super) fn second(&self, y: &[Interval], a: &[Interval], b: &[Interval]) -> Vec<Interval> {
        let mut rows = vec![Interval::ZERO; self.size];
        for (row, column, entry) in self.curvature(y, a) {
            rows[row] = sum(rows[row], product(entry, b[column]));
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member, System};

    use super::*;
    use crate::boxes::newton::dense;
    use crate::boxes::prove::Posed;

    /// A bar and two springs to two joints, and two ropes over them.
    #[test]
    fn the_curvature_is_the_difference_quotient_of_the_slope() {
        let light = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let joints = vec![
            Joint::anchor("A", [0.0, 0.0, 0.0]),
            Joint::free("P").with_mass(0.3),
            Joint::free("Q").with_mass(0.2),
        ];
        let members = vec![
            Member::bar(0, 1, light(1.0)),
            Member::bar(1, 2, light(1.3)).with_stiffness(7.0),
            Member::bar(2, 0, light(0.8)).with_stiffness(3.0),
            Member::cable(0, 1, light(1.9)).over(vec![2]),
            Member::cable(1, 2, light(2.4)).over(vec![0, 1, 0]).with_stiffness(4.0),
        ];
        let system = System::new("twin", 10.0, joints, members).unwrap();
        let at_m = [[0.0; 3], [0.6, 0.1, -0.7], [-0.3, 0.5, -0.9]];
        let Posed { equations, .. } =
            Posed::new(&system, &at_m, &[1.0, 2.0, 3.0, 1.5, 0.7]).unwrap();
        let size = equations.size;
        let points = |at: &[f64]| at.iter().copied().map(Interval::point).collect::<Vec<_>>();
        let at: Vec<f64> = (0..size).map(|k| (1.0 + 1.7 * k as f64).sin() + 0.1).collect();
        let mode: Vec<f64> = (0..size).map(|k| (2.0 + 1.3 * k as f64).cos()).collect();
        let curvature = dense(size, &equations.curvature(&points(&at), &points(&mode)));
        let change = |column: usize, step: f64| {
            let mut at = at.clone();
            at[column] += step;
            let mut rows = vec![0.0; size];
            for (row, column, entry) in equations.slope(&points(&at)) {
                rows[row] += entry.mid() * mode[column];
            }
            rows
        };
        for column in 0..size {
            let (more, less) = (change(column, 1e-5), change(column, -1e-5));
            for row in 0..size {
                let quotient = (more[row] - less[row]) / 2e-5;
                let error = (curvature[(row, column)] - quotient).abs();
                assert!(error < 1e-7, "{row} {column}: {} {quotient}", curvature[(row, column)]);
            }
        }
    }
}
