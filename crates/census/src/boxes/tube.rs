//! Tubes: boxes that follow a path of equilibria, each with one curve inside.
//!
//! Along the line $p(s) = p_0 + s v$ of points $x = (y, t)$, with a row $\gamma$, a box $D$ and all $s$
//! between $s_0$ and $s_1$ the equations
//!
//! $$ F(p(s) + \xi) = 0, \qquad \gamma \cdot \xi = 0 $$
//!
//! have exactly one solution $\xi$ in $D$ for each $s$ if $R$, an approximate inverse of $M = [F'; \gamma]$,
//! satisfies
//!
//! $$ |R\\, G| + E D < D, \qquad G = F(p_0) + s F'(p_0) v + \tfrac{s^2}{2} F''(p_0 + [0, s] v)[v, v],
//!    \qquad E \ge |I - R M| \text{ over } p_0 + [s_0, s_1] v + D : $$
//!
//! Krawczyk's test with $s$ as an interval. $D$ is of second order in $s$. The solutions are a smooth curve,
//! on which $\dot x = M^{-1} (0, \gamma \cdot v)$ and $\ddot x = M^{-1} (-F''[\dot x, \dot x], 0)$.
//! Where $M$ is regular $J$ is singular if and only if $\dot t = 0$.

use std::cell::OnceCell;

use model::NoBox;
use numerics::Interval;

use super::arithmetic::{product, sum};
use super::equations::Entry;
use super::family::Family;
use super::inverse::{Defect, Inverse};
use super::krawczyk::{Proved, prove_around};
use super::newton::FALLS;
use super::symmetry::Block;

/// Newton steps towards the equilibrium next to a guess.
const STEPS: usize = 24;
/// Steps below this size, relative, may be at the level of rounding.
const SMALL: f64 = 1e-9;
/// Least room in a tube, relative to its length.
const LEAST: f64 = 1e-6;

/// A point next to the path, in double precision, with a direction and an approximate inverse.
#[derive(Debug, Clone)]
pub(super) struct Centre {
    pub(super) at: Vec<f64>,
    /// $v$.
    pub(super) along: Vec<f64>,
    /// $\gamma$.
    pub(super) row: Vec<f64>,
    pub(super) inverse: Inverse,
    /// The derivative there by all unknowns.
    pub(super) slope: Vec<Entry>,
}

pub(super) fn points(at: &[f64]) -> Vec<Interval> {
    at.iter().copied().map(Interval::point).collect()
}

fn dot(a: &[f64], b: &[Interval]) -> Interval {
    let terms = a.iter().zip(b).map(|(a, b)| product(Interval::point(*a), *b));
    terms.fold(Interval::ZERO, sum)
}

impl Centre {
    /// The equilibrium next to a guess, with $\gamma \cdot (x - \text{guess}) = 0$.
    pub(super) fn new(family: &Family<'_>, guess: &[f64], row: Vec<f64>) -> Result<Self, NoBox> {
        let jacobian = family.equations.slope(&family.spread(&points(guess)));
        let entries = family.bordered(&jacobian, &row);
        let inverse = Inverse::of(family.size(), &entries).ok_or(NoBox::Singular)?;
        let (at, along) = (guess.to_vec(), inverse.last_column());
        let mut centre = Self { at, along, row, inverse, slope: vec![] };
        centre.settle(family)?;
        Ok(centre)
    }

    /// Where the row is the parameter alone, its value is kept to the last bit.
    fn keeps_parameter(&self) -> bool {
        let (_, others) = self.row.split_last().unwrap_or((&0.0, &[]));
        others.iter().all(|c| c.abs() <= 0.0)
    }

    /// Go on to the path, across the direction, and take the direction there.
    pub(super) fn settle(&mut self, family: &Family<'_>) -> Result<(), NoBox> {
        let mut last = f64::INFINITY;
        let fixed = self.at.last().copied().filter(|_| self.keeps_parameter());
        for step in 0..=STEPS {
            let mut left = family.value(&points(&self.at))?;
            left.push(Interval::ZERO);
            let step_by = self.inverse.apply(&left);
            let size = step_by.iter().map(|part| part.mid().abs()).fold(0.0, f64::max);
            let scale = self.at.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            // At the level of rounding the steps stop shrinking.
            let done = size <= 0.0 || (size >= FALLS * last && size <= SMALL * scale);
            if done {
                break;
            }
            if !(size.is_finite() && step < STEPS) || size >= 2.0 * last {
                return Err(NoBox::NotConverged);
            }
            for (x, part) in self.at.iter_mut().zip(&step_by) {
                *x -= part.mid();
            }
            if let (Some(t), Some(fixed)) = (self.at.last_mut(), fixed) {
                *t = fixed;
            }
            last = size;
        }
        self.slope = family.equations.slope(&family.spread(&points(&self.at)));
        let mut last = vec![0.0; family.size()];
        last[family.size() - 1] = 1.0;
        self.along = self.inverse.solve(&family.bordered(&self.slope, &self.row), &last);
        if self.along.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(NoBox::NotConverged) }
    }

    /// The point at $s$ on the line.
    pub(super) fn ahead(&self, s: f64) -> Vec<f64> {
        self.at.iter().zip(&self.along).map(|(x, v)| x + s * v).collect()
    }

    /// Prove the tube over these $s$.
    pub(super) fn tube(&self, family: &Family<'_>, over: Interval) -> Result<Tube, NoBox> {
        let newton = self.inverse.apply(&self.off(family, over)?);
        let length = over.width() * self.along.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let slope =
            |x: &[Interval]| family.bordered(&family.equations.slope(&family.spread(x)), &self.row);
        let line = self.line(over);
        let proved = prove_around(&line, &newton, LEAST * length, &self.inverse, slope)?;
        Ok(Tube { over, proved, slope: OnceCell::new() })
    }

    /// $p_0 + s v$.
    fn line(&self, over: Interval) -> Vec<Interval> {
        let pairs = self.at.iter().zip(&self.along);
        let point =
            |(x, v): (&f64, &f64)| sum(Interval::point(*x), product(over, Interval::point(*v)));
        pairs.map(point).collect()
    }

    /// $G$ over these $s$, with a 0 below.
    fn off(&self, family: &Family<'_>, over: Interval) -> Result<Vec<Interval>, NoBox> {
        let at = points(&self.at);
        let mut off = family.value(&at)?;
        off.push(Interval::ZERO);
        if over == Interval::ZERO {
            return Ok(off);
        }
        let along = points(&self.along);
        let last = family.size() - 1;
        let mut first = vec![Interval::ZERO; family.size()];
        for (row, column, entry) in family.bordered(&self.slope, &self.row) {
            if row < last {
                first[row] = sum(first[row], product(entry, along[column]));
            }
        }
        let line = family.spread(&self.line(over.hull(Interval::ZERO)));
        let along = family.spread(&along);
        let second = family.bent(&family.blocks[0], &line, &along, &along);
        let half = over.square().scale(0.5);
        for ((off, first), second) in off.iter_mut().zip(first).zip(second) {
            *off = sum(*off, sum(product(over, first), -product(half, second)));
        }
        Ok(off)
    }

    /// $\gamma \cdot v$.
    fn pace(&self) -> Interval {
        dot(&self.row, &points(&self.along))
    }

    /// $\dot x$ in a tube, of which the last part is $\dot t$, with what it is found from.
    pub(super) fn rate<'a>(
        &'a self,
        family: &'a Family<'_>,
        tube: &'a Tube,
    ) -> Result<Test<'a>, NoBox> {
        Test::new(
            &family.blocks[0],
            &self.inverse,
            (&tube.proved.entries, &tube.proved.defect),
            self.pace(),
        )
    }

    /// The direction, of length 1.
    pub(super) fn unit(&self) -> Vec<f64> {
        let size = self.along.iter().map(|v| v * v).sum::<f64>().sqrt();
        self.along.iter().map(|v| v / size).collect()
    }

    fn away(&self, point: &[Interval]) -> Vec<Interval> {
        point.iter().zip(&self.at).map(|(x, at)| *x - Interval::point(*at)).collect()
    }

    /// Across which point of the line a point is, at which $s$.
    pub(super) fn seen(&self, point: &[Interval]) -> Interval {
        dot(&self.row, &self.away(point)) / self.pace()
    }

    /// Prove that the point at $s = 0$ of a thin tube around the same centre is on the curve of another one.
    pub(super) fn shares(&self, thin: &Tube, tube: &Tube) -> Result<(), NoBox> {
        let away = self.away(thin.curve());
        let inside = away.iter().zip(&tube.proved.within).all(|(off, within)| off.mag() < *within);
        if inside && tube.over.contains(0.0) { Ok(()) } else { Err(NoBox::NotContracting) }
    }

    /// Prove that a point of the path that is known to lie in a box is on the curve of a tube.
    pub(super) fn holds(&self, tube: &Tube, point: &[Interval]) -> Result<Interval, NoBox> {
        let s = self.seen(point);
        let away = self.away(point);
        let inside =
            away.iter().zip(&self.along).zip(&tube.proved.within).all(|((away, v), within)| {
                let across = *away - s * Interval::point(*v);
                across.mag() < *within
            });
        if inside && tube.over.encloses(s) { Ok(s) } else { Err(NoBox::NotContracting) }
    }
}

#[derive(Debug)]
pub(super) struct Tube {
    /// The values of $s$.
    pub(super) over: Interval,
    proved: Proved,
    slope: OnceCell<Vec<Entry>>,
}

impl Tube {
    /// Where the curve is.
    pub(super) fn curve(&self) -> &[Interval] {
        &self.proved.tight
    }

    /// The derivative there by all unknowns.
    pub(super) fn slope(&self, family: &Family<'_>) -> &[Entry] {
        self.slope.get_or_init(|| family.equations.slope(&family.spread(self.curve())))
    }
}

/// What vanishes where a block of $J$ is singular: the last part $\tau$ of the solution $w$ of $M w = (0, g)$
/// with $M = [J, p; q, d]$ of that block, all over a tube.
pub(super) struct Test<'a> {
    block: &'a Block,
    inverse: &'a Inverse,
    matrix: (&'a [Entry], &'a Defect),
    /// $w$.
    pub(super) vector: Vec<Interval>,
}

impl<'a> Test<'a> {
    pub(super) fn new(
        block: &'a Block,
        inverse: &'a Inverse,
        matrix: (&'a [Entry], &'a Defect),
        load: Interval,
    ) -> Result<Self, NoBox> {
        let mut right = vec![Interval::ZERO; block.size()];
        right.push(load);
        let vector = inverse.enclose(matrix.0, matrix.1, &right).ok_or(NoBox::NotContracting)?;
        Ok(Self { block, inverse, matrix, vector })
    }

    /// $\tau$.
    pub(super) fn value(&self) -> Interval {
        last(&self.vector)
    }

    /// $\dot\tau$, the last part of $M^{-1} (-F''[w, \dot x], 0)$.
    pub(super) fn slope(
        &self,
        family: &Family<'_>,
        tube: &Tube,
        rate: &[Interval],
    ) -> Result<Interval, NoBox> {
        let y = family.spread(tube.curve());
        let own = self.block.spread(&self.vector);
        let bent = family.bent(self.block, &y, &own, &family.spread(rate));
        let (entries, defect) = self.matrix;
        let found = self.inverse.enclose(entries, defect, &bent).ok_or(NoBox::NotContracting)?;
        Ok(last(&found))
    }
}

/// The last part: of a point its parameter.
pub(super) fn last(x: &[Interval]) -> Interval {
    x.last().copied().unwrap_or(Interval::LINE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Along (2, 3, 6), of length 7, from (1, 1, 2), with the row (5, -1, 1): a step of 1 is 13 along the row.
    #[test]
    fn lines_have_a_direction_and_a_pace() {
        let entries: Vec<Entry> = (0..3).map(|k| (k, k, Interval::ONE)).collect();
        let inverse = Inverse::of(3, &entries).unwrap();
        let (at, along) = (vec![1.0, 1.0, 2.0], vec![2.0, 3.0, 6.0]);
        let (row, slope) = (vec![5.0, -1.0, 1.0], vec![]);
        let centre = Centre { at, along, row, inverse, slope };
        let close = |found: f64, wanted: f64| {
            assert!((found - wanted).abs() < 1e-15, "{found}, not {wanted}");
        };
        for (found, wanted) in centre.unit().into_iter().zip([2.0, 3.0, 6.0]) {
            close(found, wanted / 7.0);
        }
        assert_eq!(centre.ahead(0.5), [2.0, 2.5, 5.0]);
        close(centre.pace().mid(), 13.0);
        // (1, 2, 4) lies 1/13 ahead, across which it is.
        let seen = centre.seen(&points(&[1.0, 2.0, 4.0]));
        assert!(seen.contains(1.0 / 13.0) && seen.width() < 1e-15, "{seen:?}");
        let line = centre.line(Interval::new(0.25, 0.5));
        for (found, (low, high)) in line.iter().zip([(1.5, 2.0), (1.75, 2.5), (3.5, 5.0)]) {
            close(found.lo(), low);
            close(found.hi(), high);
        }
        assert!(!centre.keeps_parameter());
        assert!(Centre { row: vec![0.0, 0.0, 2.0], ..centre }.keeps_parameter());
    }
}
