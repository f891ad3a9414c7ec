//! A limit point, enclosed.
//!
//! Along loads $f(t) = f_0 + t\\,(f_1 - f_0)$ the equations $F(y, t) = 0$ have a limit point where the
//! derivative $J = F_y$ is singular and $F_t$ is not in its range. There
//!
//! $$ F(y, t) = 0, \qquad J(y)\\,\phi = 0, \qquad c \cdot \phi = 1 $$
//!
//! has a regular derivative in $(y, \phi, t)$ if the parameter turns with a curvature (Moore and
//! Spence), so that Krawczyk's test proves exactly one of it in a box. Where other paths cross the
//! derivative is singular, and there is no such proof.
//!
//! # References
//!
//! G. Moore, A. Spence, SIAM J. Numer. Anal. 17 (1980) 567-576, doi:10.1137/0717048.

use faer::Mat;
use model::system::System;
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::arithmetic::{NOWHERE, Vector, difference, dot, minus, norm, plus, product, sum, times};
use super::equations::{Entry, Equations};
use super::krawczyk::{Zero, Zeros, prove_zero};
use super::newton::{inverse, refine};
use super::prove::{MAX_UNKNOWNS, Posed, complementarity};

/// Steps of inverse iteration towards the null vector; next to a limit point two suffice.
const STEPS: usize = 3;

/// The equations of a limit point: $(y, \phi, t)$.
struct Limit {
    equations: Equations,
    /// $F_t$.
    by_load: Vec<Interval>,
    /// $c$.
    measure: Vec<f64>,
}

/// Prove that exactly one limit point of the loads, with its shape and mode, lies in a box next to an
/// answer: an enclosure of the parameter there.
///
/// `ends` are systems at two values of the parameter, `at` one at the answer: they differ in loads
/// alone, which are on the straight line between those of the ends. `values` are the parameter at the
/// ends and at the answer.
///
/// # Errors
///
/// [`NoBox`], why there is no such proof.
///
/// # Panics
///
/// When the systems differ in their joints.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, Support, System};
/// // Two bars of EA = 1 N rise by 0.5 m over 1 m each; the apex moves up and down.
/// let l0 = 1.25_f64.sqrt();
/// let gable = |load_n: f64| {
///     let line = Support::Line { at_m: [0.0; 3], direction: [0.0, 0.0, 1.0] };
///     let apex = Joint { support: line, ..Joint::free("P").with_force([0.0, 0.0, -load_n]) };
///     let feet = [-1.0, 1.0].map(|x| Joint::anchor(if x < 0.0 { "A" } else { "B" }, [x, 0.0, 0.0]));
///     let bar = Bar::homogeneous(l0, 0.0).unwrap();
///     let members = (0..2).map(|foot| Member::bar(foot, 2, bar).with_stiffness(1.0));
///     let [a, b] = feet;
///     System::new("gable", 9.81, vec![a, b, apex], members.collect())
/// };
/// // It bears most where l^3 = l0 a^2.
/// let l = l0.cbrt();
/// let w = (l * l - 1.0).sqrt();
/// let limit_n = 2.0 * w / l * (l0 - l) / l0;
/// let shape = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, w + 1e-9]];
/// let [none, one, near] = [gable(0.0)?, gable(1.0)?, gable(limit_n)?];
/// let axial_n = [(l - l0) / l0; 2];
/// let values = [0.0, 1.0, limit_n + 1e-12];
/// let found = census::network::prove_limit([&none, &one], &near, values, &shape, &axial_n)?;
/// assert!(found.contains(limit_n) && found.width() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prove_limit(
    ends: [&System; 2],
    at: &System,
    values: [f64; 3],
    joints_m: &[Point],
    axial_n: &[f64],
) -> Result<Interval, NoBox> {
    let Posed { equations, activities, .. } = Posed::new(at, joints_m, axial_n)?;
    let size = equations.size;
    let unknowns = 2 * size + 1;
    if unknowns > MAX_UNKNOWNS {
        return Err(NoBox::TooLarge { unknowns, limit: MAX_UNKNOWNS });
    }
    let [first, last] = ends.map(|system| equations.frame.loads(system));
    let by_load = along(&equations, first.iter().zip(&last).map(|(a, b)| minus(*b, *a)));
    let mut start = equations.start(joints_m, axial_n);
    let equations = equations.with_loads(first);
    let point: Vec<Interval> = start.iter().copied().map(Interval::point).collect();
    let inverse = inverse(size, &equations.slope(&point)).ok_or(NoBox::Singular)?;
    let mode = null_vector(&inverse);
    start.extend_from_slice(&mode);
    start.push((values[2] - values[0]) / (values[1] - values[0]));
    let limit = Limit { equations, by_load, measure: mode };
    let refined = refine(&limit, &start)?;
    let Zero { mut tight } = prove_zero(&limit, &refined)?;
    let t = tight[2 * size];
    tight.truncate(size);
    complementarity(at, &limit.equations, &activities, &Zero { tight })?;
    let [from, to] = [values[0], values[1]].map(Interval::point);
    Ok(sum(from, product(t, difference(to, from))))
}

/// Forces at the joints as they stand in the balances.
fn along(equations: &Equations, forces: impl Iterator<Item = Vector>) -> Vec<Interval> {
    let mut rows = vec![Interval::ZERO; equations.size];
    for (joint, force) in equations.joints.iter().zip(forces) {
        for (k, axis) in joint.axes.iter().enumerate() {
            rows[joint.first + k] = dot(*axis, force);
        }
    }
    rows
}

/// The vector of unit length that a nearly singular matrix shortens most.
fn null_vector(inverse: &Mat<f64>) -> Vec<f64> {
    let mut mode = Mat::from_fn(inverse.nrows(), 1, |k, _| 1.0 + (k as f64).sin());
    for _ in 0..STEPS {
        mode = inverse * mode;
        let norm = mode.norm_l2();
        mode *= faer::Scale(norm.recip());
    }
    (0..inverse.nrows()).map(|k| mode[(k, 0)]).collect()
}

impl Zeros for Limit {
    fn size(&self) -> usize {
        2 * self.equations.size + 1
    }

    fn value(&self, unknowns: &[Interval]) -> Result<Vec<Interval>, NoBox> {
        let size = self.equations.size;
        let (y, mode, t) = (&unknowns[..size], &unknowns[size..2 * size], unknowns[2 * size]);
        let mut value = self.equations.value(y)?;
        for (row, by_load) in value.iter_mut().zip(&self.by_load) {
            *row = sum(*row, product(t, *by_load));
        }
        value.resize(2 * size, Interval::ZERO);
        for (row, column, entry) in self.equations.slope(y) {
            value[size + row] = sum(value[size + row], product(entry, mode[column]));
        }
        let measured = mode.iter().zip(&self.measure).map(|(part, c)| Interval::point(*c) * *part);
        value.push(measured.sum::<Interval>() - Interval::ONE);
        let finite = value.iter().all(|part| part.mag().is_finite());
        if finite { Ok(value) } else { Err(NoBox::NotFinite) }
    }

    fn slope(&self, unknowns: &[Interval]) -> Vec<Entry> {
        let size = self.equations.size;
        let (y, mode) = (&unknowns[..size], &unknowns[size..2 * size]);
        let jacobian = self.equations.slope(y);
        let shifted =
            jacobian.iter().map(|(row, column, entry)| (size + row, size + column, *entry));
        let mut entries: Vec<Entry> = shifted.collect();
        entries.extend(jacobian);
        entries.extend(self.by_load.iter().enumerate().map(|(row, entry)| (row, 2 * size, *entry)));
        let measure = self.measure.iter().enumerate();
        entries.extend(measure.map(|(k, c)| (2 * size, size + k, Interval::point(*c))));
        self.curvature(y, mode, &mut entries);
        entries
    }
}

impl Limit {
    /// The derivative of $J(y)\\,\phi$ by $y$.
    fn curvature(&self, y: &[Interval], mode: &[Interval], entries: &mut Vec<Entry>) {
        let Equations { joints, acting, size, .. } = &self.equations;
        let places = self.equations.places(y);
        let moves: Vec<Vector> = joints
            .iter()
            .map(|joint| {
                let parts = joint.axes.iter().zip(&mode[joint.first..]);
                parts.fold(NOWHERE, |all, (axis, part)| plus(all, times(*part, *axis)))
            })
            .collect();
        for member in acting {
            let [a, b] = member.ends;
            let (span, change) = (minus(places[b], places[a]), minus(moves[b], moves[a]));
            let (w, of_force) = (y[member.density], mode[member.density]);
            let row = size + member.density;
            let (by_span, by_force) = if member.is_rigid() {
                (change, Interval::ZERO)
            } else {
                let length = norm(span);
                let unit =
                    span.map(|part| if part == Interval::ZERO { part } else { part / length });
                let stretch = dot(unit, change);
                let across = minus(change, times(stretch, unit));
                let across = times(member.shrink(w) / length, across);
                let along = times(product(member.compliance, of_force), unit);
                (minus(across, along), -product(member.compliance, stretch))
            };
            entries.push((row, member.density, by_force));
            for (here, sign) in [(a, -Interval::ONE), (b, Interval::ONE)] {
                let joint = &joints[here];
                for (k, axis) in joint.axes.iter().enumerate() {
                    let at = joint.first + k;
                    entries.push((row, at, product(sign, dot(*axis, by_span))));
                    // Balance: what pulls a pulls b the other way.
                    entries.push((size + at, member.density, -product(sign, dot(*axis, change))));
                    for (there, other_sign) in [(a, -Interval::ONE), (b, Interval::ONE)] {
                        for (i, towards) in joints[there].axes.iter().enumerate() {
                            let block = product(of_force, dot(*axis, *towards));
                            let block = -product(product(sign, other_sign), block);
                            entries.push((size + at, joints[there].first + i, block));
                        }
                    }
                }
            }
        }
        entries.retain(|(_, _, value)| *value != Interval::ZERO);
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::{Joint, Member};

    use super::*;
    use crate::network::newton::dense;

    /// A bar and two springs to two joints.
    #[test]
    fn the_slope_is_its_difference_quotient() {
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
        ];
        let system = System::new("twin", 10.0, joints, members).unwrap();
        let at_m = [[0.0; 3], [0.6, 0.1, -0.7], [-0.3, 0.5, -0.9]];
        let Posed { equations, .. } = Posed::new(&system, &at_m, &[1.0, 2.0, 3.0]).unwrap();
        let size = equations.size;
        let by_load = (0..size).map(|k| Interval::point(0.1 * k as f64)).collect();
        let measure = (0..size).map(|k| (k as f64).cos()).collect();
        let limit = Limit { equations, by_load, measure };
        let at: Vec<f64> = (0..limit.size()).map(|k| (1.0 + 1.7 * k as f64).sin() + 0.1).collect();
        let points = |at: &[f64]| at.iter().copied().map(Interval::point).collect::<Vec<_>>();
        let slope = dense(limit.size(), &limit.slope(&points(&at)));
        for column in 0..limit.size() {
            let moved = |step: f64| {
                let mut at = at.clone();
                at[column] += step;
                limit.value(&points(&at)).unwrap()
            };
            let (more, less) = (moved(1e-5), moved(-1e-5));
            for row in 0..limit.size() {
                let quotient = (more[row].mid() - less[row].mid()) / 2e-5;
                let error = (slope[(row, column)] - quotient).abs();
                assert!(error < 1e-7, "{row} {column}: {} {quotient}", slope[(row, column)]);
            }
        }
    }
}
