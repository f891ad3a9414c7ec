//! Limit points and branch points, enclosed.
//!
//! Along loads $f(t) = f_0 + t\\,(f_1 - f_0)$ the equations $F(y) + t b = 0$ have a limit point where the
//! derivative $J = F_y$ is singular and $b$ is not in its range. There
//!
//! $$ F(y) + t b = 0, \qquad J(y)\\,\phi = 0, \qquad c \cdot \phi = 1 $$
//!
//! has a regular derivative in $(y, \phi, t)$ if the parameter turns with a curvature (Moore and
//! Spence). Where other paths cross it is singular; but where a mirror or half-turn maps the system onto
//! itself and the mode breaks that symmetry, the same with $y$ symmetric and $\phi$ antisymmetric is
//! regular (Werner and Spence).
//!
//! Both are solved by elimination. A [tube](super::tube) holds one curve $x(s) = (y, t)(s)$ with $\phi =
//! \dot y$ for a limit point; the test $\tau = \dot t$ vanishes there. For a branch point
//!
//! $$ \begin{bmatrix} J_\chi & p \\\\ q & 0 \end{bmatrix} \begin{bmatrix} \phi \\\\ \tau \end{bmatrix}
//!    = \begin{bmatrix} 0 \\\\ 1 \end{bmatrix}, $$
//!
//! with the part $J_\chi$ of the derivative that breaks the symmetry, has $\tau = 0$. If $\dot\tau$ is not
//! zero in the tube and the interval Newton step $N = -\tau(0)/\dot\tau$ is inside, then exactly one singular
//! point lies in the tube, at an $s$ in $N$. So matrices of one more row than unknowns are inverted.
//!
//! G. Moore, A. Spence, SIAM J. Numer. Anal. 17 (1980) 567-576, doi:10.1137/0717048. B. Werner, A. Spence,
//! SIAM J. Numer. Anal. 21 (1984) 388-399, doi:10.1137/0721029.

use model::system::System;
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::arithmetic::{difference, product, sum};
use super::family::Family;
use super::newton::{FALLS, REACH, far};
use super::path::SingularKind;
use super::side::Side;
use super::tube::{Centre, Test, Tube, last, points};

/// Most unknowns of which limit points are proved: the inverse of 4096 takes 134 MB, four times that
/// while it is computed, and some ten seconds.
pub const MAX_LIMIT_UNKNOWNS: usize = 4096;

/// Steps to the zero of a test, which converge like Newton's method.
const STEPS: usize = 16;
/// Half-lengths of the tube in which the point is proved to be the only one, in units of the least one.
const LONGER: [f64; 4] = [4.0, 32.0, 256.0, 2048.0];

/// Prove that exactly one limit or branch point of the loads, with its shape and mode, lies in a box next to
/// an answer: an enclosure of the parameter there.
///
/// `ends` are systems at two values of the parameter, `at` one at the answer: they differ in loads
/// alone, which are on the straight line between those of the ends. `values` are the parameter at the
/// ends and at the answer.
///
/// The mode of a branch point breaks a symmetry: a mirror across a vertical plane along X, along Y or between
/// them, or the half-turn about a vertical, that maps supports, members and loads of both ends onto each other
/// without any rounding. The box is then one of symmetric shapes; another path crosses there.
///
/// # Errors
///
/// [`NoBox`], why there is no such proof: of a branch point [`NoBox::Singular`] where there is no such
/// symmetry, or the mode does not break it.
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
///     let apex = Joint::free("P").with_force([0.0, 0.0, -load_n]).held_by(line);
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
/// use census::boxes::{SingularKind, prove_singular};
/// let limit = SingularKind::Limit;
/// let found = prove_singular(limit, [&none, &one], &near, values, &shape, &axial_n)?;
/// assert!(found.contains(limit_n) && found.width() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prove_singular(
    kind: SingularKind,
    ends: [&System; 2],
    at: &System,
    values: [f64; 3],
    joints_m: &[Point],
    axial_n: &[f64],
) -> Result<Interval, NoBox> {
    let branch = kind == SingularKind::Branch;
    let family = Family::new(ends, at, (joints_m, axial_n), branch, MAX_LIMIT_UNKNOWNS)?;
    let start = family.start(joints_m, axial_n, part(values));
    let proved = |row: Vec<f64>, block: Option<usize>| {
        let found = singular(&family, &start, row, block)?;
        near(&found.point, &start)?;
        Ok(value(values, found.t))
    };
    if !branch {
        // The loads do work along the mode.
        let loads = family.loads();
        return proved(loads.iter().map(|load| load.mid()).chain([0.0]).collect(), None);
    }
    let mut row = vec![0.0; family.size()];
    row[family.size() - 1] = 1.0;
    let mut failure = NoBox::Singular;
    for block in 1..family.blocks.len() {
        match proved(row.clone(), Some(block)) {
            Ok(found) => return Ok(found),
            Err(error) => failure = error,
        }
    }
    Err(failure)
}

/// Where between the ends the answer is.
fn part([from, to, at]: [f64; 3]) -> f64 {
    (at - from) / (to - from)
}

pub(super) fn value([from, to, _]: [f64; 3], t: Interval) -> Interval {
    let [from, to] = [from, to].map(Interval::point);
    sum(from, product(t, difference(to, from)))
}

/// A singular point that is proved.
#[derive(Debug)]
pub(super) struct Singular {
    /// The parameter there.
    pub(super) t: Interval,
    pub(super) point: Vec<Interval>,
}

/// Whether what is proved is next to the answer.
pub(super) fn near(point: &[Interval], start: &[f64]) -> Result<(), NoBox> {
    let point = point.iter().map(|x| x.mid());
    if far(REACH, point, start) { Err(NoBox::NotConverged) } else { Ok(()) }
}

/// Prove the singular point of one block next to a guess: the limit point of the first one, the branch
/// point of another one.
pub(super) fn singular(
    family: &Family<'_>,
    guess: &[f64],
    row: Vec<f64>,
    block: Option<usize>,
) -> Result<Singular, NoBox> {
    let (centre, side) = locate(family, guess, row, block)?;
    let thin = centre.tube(family, Interval::ZERO)?;
    let rate = centre.rate(family, &thin)?.vector;
    let start = tested(family, &centre, &thin, side.as_ref(), &rate)?.0;
    // The least length in which the point may be, and some longer ones.
    let least = start.mag() / newton_slope(family, &centre, side.as_ref()).1.abs();
    let mut failure = NoBox::NotContracting;
    for longer in LONGER {
        let length = longer * least + f64::MIN_POSITIVE;
        match alone(family, &centre, side.as_ref(), (&thin, start), length) {
            Ok((step, t_rate)) => {
                // From the middle of the tube to the point.
                let t = last(thin.curve());
                let moved = thin.curve().iter().zip(&t_rate.1);
                let point = moved.map(|(x, rate)| sum(*x, product(step, *rate))).collect();
                return Ok(Singular { t: sum(t, product(step, t_rate.0)), point });
            }
            Err(error) => failure = error,
        }
    }
    Err(failure)
}

/// At which $s$ the test of a tube around a centre has its only zero; $\dot t$ and $\dot x$ up to there.
fn alone(
    family: &Family<'_>,
    centre: &Centre,
    side: Option<&Side>,
    (thin, start): (&Tube, Interval),
    length: f64,
) -> Result<(Interval, (Interval, Vec<Interval>)), NoBox> {
    let tube = centre.tube(family, Interval::around(0.0, length))?;
    // The curve of the thin tube is the one of this.
    centre.shares(thin, &tube)?;
    family.acts(&family.spread(tube.curve()))?;
    let rate = centre.rate(family, &tube)?.vector;
    let slope = tested(family, centre, &tube, side, &rate)?.1;
    let step = zero(start, slope, tube.over).ok_or(NoBox::NotContracting)?;
    let mut t_rate = last(&rate);
    if side.is_none() {
        t_rate = sum(start, product(step.hull(Interval::ZERO), slope));
    }
    Ok((step, (t_rate, rate)))
}

/// Where the only zero is of what has this value at 0 and this slope in a range around it; nothing
/// where that is not proved.
pub(super) fn zero(start: Interval, slope: Interval, over: Interval) -> Option<Interval> {
    let step = -start / slope;
    step.interior_to(over).then_some(step)
}

/// The test of the block that may be singular, over a tube, and its slope.
pub(super) fn tested(
    family: &Family<'_>,
    centre: &Centre,
    tube: &Tube,
    side: Option<&Side>,
    rate: &[Interval],
) -> Result<(Interval, Interval), NoBox> {
    let of = |test: &Test<'_>| Ok((test.value(), test.slope(family, tube, rate)?));
    let Some(side) = side else { return of(&centre.rate(family, tube)?) };
    let entries = side.entries(family, tube.slope(family));
    let defect = side.inverse.defect(&entries);
    of(&Test::new(side.of(family), &side.inverse, (&entries, &defect), Interval::ONE)?)
}

/// The singular point next to a guess, in double precision.
fn locate(
    family: &Family<'_>,
    guess: &[f64],
    row: Vec<f64>,
    block: Option<usize>,
) -> Result<(Centre, Option<Side>), NoBox> {
    let mut centre = Centre::new(family, guess, row)?;
    let side = match block {
        None => None,
        Some(block) => {
            let side = Side::new(family, block, &centre.slope, None);
            Some(side.ok_or(NoBox::Singular)?)
        }
    };
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let (value, slope) = newton_slope(family, &centre, side.as_ref());
        let s = -value / slope;
        if !s.is_finite() {
            return Err(NoBox::NotConverged);
        }
        // At the level of rounding the steps stop shrinking.
        if s.abs() >= FALLS * last {
            break;
        }
        last = s.abs();
        centre.at = centre.ahead(s);
        centre.settle(family)?;
    }
    Ok((centre, side))
}

/// $\tau$ and $\dot\tau$ at a centre, in double precision.
fn newton_slope(family: &Family<'_>, centre: &Centre, side: Option<&Side>) -> (f64, f64) {
    let y = family.spread(&points(&centre.at));
    let along = family.spread(&points(&centre.along));
    let (block, inverse, vector) = match side {
        None => (&family.blocks[0], &centre.inverse, centre.along.clone()),
        Some(side) => {
            let block = side.of(family);
            let mut last = vec![0.0; block.size() + 1];
            last[block.size()] = 1.0;
            let entries = side.entries(family, &centre.slope);
            (block, &side.inverse, side.inverse.solve(&entries, &last))
        }
    };
    let bent = family.bent(block, &y, &block.spread(&points(&vector)), &along);
    let slope: f64 = inverse.last_row().iter().zip(&bent).map(|(a, b)| a * b.mid()).sum();
    (vector.last().copied().unwrap_or(f64::NAN), slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_go_straight_from_end_to_end() {
        for (ends, t) in [([2.0, 6.0, 3.0], 0.25), ([5.0, 1.0, 2.0], 0.75), ([0.0, 0.5, 2.0], 4.0)]
        {
            assert!((part(ends) - t).abs() < 1e-15, "{ends:?}");
            assert!(value(ends, Interval::point(t)).contains(ends[2]), "{ends:?}");
        }
    }
}
