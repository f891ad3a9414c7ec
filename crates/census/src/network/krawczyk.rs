//! Krawczyk's test on the equations of a system.
//!
//! With $\tilde x$ and a box $\tilde x + D$ around it, Y near the inverse of the derivative and
//! $z = -Y F(\tilde x)$: if
//!
//! $$ K(D) = z + (I - Y F'(\tilde x + D))\\, D $$
//!
//! lies inside D, then $\tilde x + D$ holds exactly one zero of F, and that lies in $\tilde x +
//! K(D)$. The box D is found by inflating $K$ a little, again and again.
//!
//! # References
//!
//! R. Krawczyk, Computing 4 (1969) 187-201, doi:10.1007/BF02234767; S. M. Rump, "Verification
//! methods", Acta Numerica 19 (2010) 287-449, doi:10.1017/S096249291000005X, section 13
//! (inflation).

use faer::Mat;
use model::NoBox;
use numerics::Interval;

use super::equations::{Entry, Equations};
use super::newton::Refined;

/// Inflations before the test counts as failed; three or four are usual.
const ROUNDS: usize = 12;
/// Room that each inflation adds, relative to the box.
const ROOM: f64 = 0.25;
/// Least room, in units of the last place of the point.
const LAST_PLACES: f64 = 4.0;
/// Times that the proved box is narrowed by the same map.
const NARROW: usize = 3;

/// As many equations as unknowns, with their derivative.
pub(super) trait Zeros {
    /// How many.
    fn size(&self) -> usize;

    /// Left-hand sides over a box.
    ///
    /// # Errors
    ///
    /// [`NoBox::NotFinite`] when one is not finite.
    fn value(&self, unknowns: &[Interval]) -> Result<Vec<Interval>, NoBox>;

    /// The derivative over a box, entries of the same place to be added.
    fn slope(&self, unknowns: &[Interval]) -> Vec<Entry>;
}

impl Zeros for Equations {
    fn size(&self) -> usize {
        self.size
    }

    fn value(&self, unknowns: &[Interval]) -> Result<Vec<Interval>, NoBox> {
        Self::value(self, unknowns)
    }

    fn slope(&self, unknowns: &[Interval]) -> Vec<Entry> {
        Self::slope(self, unknowns)
    }
}

/// A zero, proved.
pub(super) struct Zero {
    /// Where it is, and no other.
    pub(super) tight: Vec<Interval>,
}

/// Prove the zero next to a refined point.
///
/// # Errors
///
/// [`NoBox::NotContracting`] when no inflated box is mapped into itself.
pub(super) fn prove_zero(equations: &impl Zeros, refined: &Refined) -> Result<Zero, NoBox> {
    let Refined { at, inverse } = refined;
    let value = equations.value(&boxed(at, &vec![Interval::ZERO; at.len()]))?;
    let newton: Vec<Interval> = (0..at.len())
        .map(|row| {
            -(0..at.len()).map(|k| Interval::point(inverse[(row, k)]) * value[k]).sum::<Interval>()
        })
        .collect();
    let image = |around: &[Interval]| -> Vec<Interval> {
        let rest = defect(equations, inverse, &boxed(at, around));
        // Where nothing is unknown nothing has to be contracted.
        let rows = rest.chunks_exact(around.len().max(1)).zip(&newton);
        rows.map(|(row, z)| *z + row.iter().zip(around).map(|(c, d)| *c * *d).sum()).collect()
    };
    let mut inner = newton.clone();
    for _ in 0..ROUNDS {
        let outer: Vec<Interval> =
            inner.iter().zip(at).map(|(part, x)| inflated(*part, x.abs())).collect();
        inner = image(&outer);
        if inner.iter().zip(&outer).all(|(inner, outer)| inner.interior_to(*outer)) {
            for _ in 0..NARROW {
                let next = image(&inner);
                // The zero is in both.
                inner =
                    inner.iter().zip(&next).map(|(a, b)| a.intersect(*b).unwrap_or(*a)).collect();
            }
            return Ok(Zero { tight: boxed(at, &inner) });
        }
        if inner.iter().any(|part| !part.mag().is_finite()) {
            break;
        }
    }
    Err(NoBox::NotContracting)
}

/// The box around a point.
fn boxed(at: &[f64], around: &[Interval]) -> Vec<Interval> {
    let sum = |(x, part): (&f64, &Interval)| {
        if *part == Interval::ZERO { Interval::point(*x) } else { Interval::point(*x) + *part }
    };
    at.iter().zip(around).map(sum).collect()
}

fn inflated(part: Interval, size: f64) -> Interval {
    let room = ROOM * part.mag() + LAST_PLACES * f64::EPSILON * size + f64::MIN_POSITIVE;
    part.hull(Interval::ZERO) + Interval::around(0.0, room)
}

/// `I − Y F'` over a box, row after row.
fn defect(equations: &impl Zeros, inverse: &Mat<f64>, unknowns: &[Interval]) -> Vec<Interval> {
    let size = unknowns.len();
    let slope = equations.slope(unknowns);
    let mut rest = vec![Interval::ZERO; size * size];
    for (k, row) in rest.chunks_exact_mut(size.max(1)).enumerate() {
        row[k] = Interval::ONE;
        for (through, column, value) in &slope {
            row[*column] = row[*column] - Interval::point(inverse[(k, *through)]) * *value;
        }
    }
    rest
}

#[cfg(test)]
mod tests;
