//! Krawczyk's test on equations.
//!
//! With $\tilde x$ and a box $\tilde x + D$ around it, R near the inverse of the derivative and
//! $z = R F(\tilde x)$: if
//!
//! $$ |z| + E D < D, \qquad E \ge |I - R F'(\tilde x + D)|, $$
//!
//! then $\tilde x + D$ holds exactly one zero of F, and that lies in $\tilde x - z + [-1, 1]\\,E D$. The box
//! is found by widening $|z|$ a little, again and again.
//!
//! R. Krawczyk, Computing 4 (1969) 187-201, doi:10.1007/BF02234767; S. M. Rump, "Verification
//! methods", Acta Numerica 19 (2010) 287-449, doi:10.1017/S096249291000005X, section 13
//! (inflation).

use model::NoBox;
use numerics::Interval;

use super::arithmetic::sum;
use super::equations::{Entry, Equations};
use super::inverse::{Defect, Inverse};
use super::newton::Refined;

/// Boxes that are tried before the test counts as failed; one or two are usual.
const ROUNDS: usize = 6;
/// First box, in units of what the middle is off, and each next one in units of the last bound.
const WIDER: f64 = 2.0;
/// Least room, in units of the last place of the point.
const LAST_PLACES: f64 = 4.0 * f64::EPSILON;

/// A box around a point, or around all points of a line, that holds exactly one zero for each.
#[derive(Debug)]
pub(super) struct Proved {
    /// Half-widths of the box.
    pub(super) within: Vec<f64>,
    pub(super) tight: Vec<Interval>,
    /// The derivative over the box, and what it differs from the inverted one.
    pub(super) entries: Vec<Entry>,
    pub(super) defect: Defect,
}

/// Prove the zeros next to the points of a line, where the left-hand sides times the approximate inverse
/// are `newton`, with at least `room` around.
/// [`NoBox::NotContracting`] when no box is mapped into itself.
pub(super) fn prove_around(
    line: &[Interval],
    newton: &[Interval],
    room: f64,
    inverse: &Inverse,
    slope: impl Fn(&[Interval]) -> Vec<Entry>,
) -> Result<Proved, NoBox> {
    let least = |x: &Interval| LAST_PLACES * x.mag() + room + f64::MIN_POSITIVE;
    let pairs = newton.iter().zip(line);
    let mut guess: Vec<f64> = pairs.map(|(z, x)| WIDER * z.mag() + least(x)).collect();
    for _ in 0..ROUNDS {
        let around = line.iter().zip(&guess).map(|(x, by)| *x + Interval::around(0.0, *by));
        let entries = slope(&around.collect::<Vec<_>>());
        let defect = inverse.defect(&entries);
        let [within, through] = defect.bound(newton, &guess).ok_or(NoBox::NotContracting)?;
        if within.iter().zip(&guess).all(|(within, guess)| within <= guess) {
            let zeros = line.iter().zip(newton).zip(&through);
            let zeros = zeros.map(|((x, z), rest)| sum(*x, Interval::around(0.0, *rest) - *z));
            return Ok(Proved { within, tight: zeros.collect(), entries, defect });
        }
        guess = within.iter().zip(&guess).map(|(w, g)| (WIDER * w).max(*g)).collect();
    }
    Err(NoBox::NotContracting)
}

/// Where the zero next to a refined point is, and no other, proved.
/// [`NoBox::NotContracting`] when no box is mapped into itself.
pub(crate) fn prove_zero(equations: &Equations, refined: &Refined) -> Result<Vec<Interval>, NoBox> {
    let Refined { at, inverse } = refined;
    let at: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
    let newton = inverse.apply(&equations.value(&at)?);
    let slope = |x: &[Interval]| equations.slope(x);
    Ok(prove_around(&at, &newton, 0.0, inverse, slope)?.tight)
}
