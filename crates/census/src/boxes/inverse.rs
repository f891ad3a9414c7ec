//! A square matrix $M$ of intervals with an approximate inverse $R$, and what both prove.
//!
//! With $E \ge |I - R M|$ for all matrices in $M$ and some $D > 0$ with $|R r| + E D < D$ the spectral radius
//! of $E$ is below 1, so $R$ and every matrix in $M$ are regular, and every solution of $M x = r$ lies
//! in $R r + [-1, 1]\\,E D$. Only $R$ is dense: rows of $R$ meet the sparse columns of $M$.
//!
//! S. M. Rump, "Verification methods", Acta Numerica 19 (2010) 287-449,
//! doi:10.1017/S096249291000005X, section 10.

use matrices::dense::inverse;
use numerics::{Interval, in_parallel, up};

use super::equations::Entry;
use super::newton::dense;

/// Room of each bound beyond the one it is found from; with an `E` of spectral radius up to about
/// 1/1.1 bounds are found.
const ROOM: f64 = 0.1;
/// Rounds to find a bound.
const ROUNDS: usize = 60;
/// Fewer rows than this are not shared among threads.
const APART: usize = 64;
/// Times that an enclosure is narrowed.
const NARROW: usize = 3;
/// Corrections of an approximate solution by what it leaves, at most.
const CORRECTIONS: usize = 20;

#[derive(Debug, Clone)]
pub(super) struct Inverse {
    size: usize,
    /// Row after row.
    rows: Vec<f64>,
}

/// Upper bounds of $|I - R M|$, row after row.
#[derive(Debug, Clone)]
pub(super) struct Defect {
    size: usize,
    rows: Vec<f64>,
}

impl Inverse {
    /// Of the middle of a matrix, if double precision has one.
    pub(super) fn of(size: usize, entries: &[Entry]) -> Option<Self> {
        // Of the transpose by columns, which are the rows of the inverse.
        let inverse = inverse(&dense(size, entries).transpose())?;
        let rows = inverse.as_slice().to_vec();
        rows.iter().all(|x| x.is_finite()).then_some(Self { size, rows })
    }

    /// The last column: what the last equation does to each unknown.
    pub(super) fn last_column(&self) -> Vec<f64> {
        self.rows.chunks_exact(self.size.max(1)).map(|row| row[self.size - 1]).collect()
    }

    pub(super) fn last_row(&self) -> &[f64] {
        &self.rows[self.rows.len() - self.size..]
    }

    /// $R r$.
    pub(super) fn apply(&self, right: &[Interval]) -> Vec<Interval> {
        self.of_rows(|row: &[f64]| {
            let parts = row.iter().zip(right).filter(|(_, part)| **part != Interval::ZERO);
            parts.map(|(x, part)| part.times(*x)).sum()
        })
    }

    /// Something of each row of $R$.
    pub(super) fn of_rows<T: Send>(&self, of: impl Fn(&[f64]) -> T + Sync) -> Vec<T> {
        in_parallel(self.size, APART, |k| of(row(&self.rows, self.size, k)))
    }

    /// $M^{-1} r$ for the middle of a matrix near to the inverted one, in double precision. No proof.
    pub(super) fn solve(&self, entries: &[Entry], right: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.size];
        let mut last = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let mut left = right.to_vec();
            for (row, column, entry) in entries {
                left[*row] -= entry.mid() * x[*column];
            }
            let rows = self.rows.chunks_exact(self.size.max(1));
            let step: Vec<f64> =
                rows.map(|row| row.iter().zip(&left).map(|(a, b)| a * b).sum()).collect();
            let size = step.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
            if size >= last || size.is_nan() {
                break;
            }
            last = size;
            x.iter_mut().zip(step).for_each(|(x, step)| *x += step);
        }
        x
    }

    /// All $M^{-1} r$ over a matrix with its defect; nothing where it is not proved to be regular.
    pub(super) fn enclose(
        &self,
        entries: &[Entry],
        defect: &Defect,
        right: &[Interval],
    ) -> Option<Vec<Interval>> {
        let middle: Vec<f64> = right.iter().map(|part| part.mid()).collect();
        let near = self.solve(entries, &middle);
        let mut left = right.to_vec();
        for (row, column, entry) in entries {
            left[*row] = left[*row] - entry.times(near[*column]);
        }
        let rest = defect.enclose(&self.apply(&left))?;
        Some(near.iter().zip(rest).map(|(x, rest)| Interval::point(*x) + rest).collect())
    }

    /// Bounds of $|I - R M|$ over a matrix.
    pub(super) fn defect(&self, entries: &[Entry]) -> Defect {
        self.defect_by(|row, rest| {
            for (through, column, entry) in entries {
                rest[*column] = rest[*column] - entry.times(row[*through]);
            }
        })
    }

    /// The same where `subtract` takes a row of $R M$ off, given the row of $R$.
    pub(super) fn defect_by(&self, subtract: impl Fn(&[f64], &mut [Interval]) + Sync) -> Defect {
        let size = self.size;
        let bounds = in_parallel(size, APART, |k| {
            let mut rest = vec![Interval::ZERO; size];
            rest[k] = Interval::ONE;
            subtract(row(&self.rows, size, k), &mut rest);
            rest.iter().map(|rest| rest.mag()).collect::<Vec<f64>>()
        });
        Defect { size, rows: bounds.concat() }
    }
}

fn row(rows: &[f64], size: usize, k: usize) -> &[f64] {
    &rows[k * size..][..size]
}

impl Defect {
    /// Some $D$ with $|z| + E D < D$, and $E D$; nothing where none is found. A guess of it comes first.
    pub(super) fn bound(&self, middle: &[Interval], guess: &[f64]) -> Option<[Vec<f64>; 2]> {
        let enlarged = |x: f64| x + ROOM * x + f64::MIN_POSITIVE;
        let sizes: Vec<f64> = middle.iter().map(|part| part.mag()).collect();
        let mut bound = guess.to_vec();
        for _ in 0..ROUNDS {
            let through = self.times(&bound);
            let next: Vec<f64> = sizes.iter().zip(&through).map(|(z, e)| up(z + e)).collect();
            if next.iter().zip(&bound).all(|(next, bound)| next < bound) {
                return Some([bound, through]);
            }
            if !next.iter().all(|x| x.is_finite()) {
                return None;
            }
            bound = next.into_iter().map(enlarged).collect();
        }
        None
    }

    /// All $M^{-1} r$, of which $z = R r$ is given; nothing where the matrix is not proved to be regular.
    pub(super) fn enclose(&self, middle: &[Interval]) -> Option<Vec<Interval>> {
        let guess: Vec<f64> = middle.iter().map(|z| 2.0 * z.mag() + f64::MIN_POSITIVE).collect();
        let [_, mut through] = self.bound(middle, &guess)?;
        let around = |through: &[f64]| -> Vec<Interval> {
            let pairs = middle.iter().zip(through);
            pairs.map(|(z, rest)| *z + Interval::around(0.0, *rest)).collect()
        };
        for _ in 0..NARROW {
            let sizes: Vec<f64> = around(&through).iter().map(|x| x.mag()).collect();
            through = self.times(&sizes);
        }
        Some(around(&through))
    }

    /// $E x$ for $x \ge 0$, from above.
    fn times(&self, x: &[f64]) -> Vec<f64> {
        in_parallel(self.size, APART, |k| {
            let row = row(&self.rows, self.size, k).iter();
            row.zip(x).fold(0.0, |all, (e, x)| up(all + up(e * x)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn full(values: [[Interval; 2]; 2]) -> Vec<Entry> {
        let row = |(i, row): (usize, [Interval; 2])| {
            row.into_iter().enumerate().map(move |(j, x)| (i, j, x))
        };
        values.into_iter().enumerate().flat_map(row).collect()
    }

    /// $[2, 1; 1, 3 + e]\\,x = (3, 4)$ has the solution $(5 + 3e, 5)/(5 + 2e)$; a singular matrix is not
    /// proved to be regular.
    #[test]
    fn solutions_are_enclosed() {
        let [one, two] = [1.0, 2.0].map(Interval::point);
        let matrix = |e: Interval| full([[two, one], [one, Interval::point(3.0) + e]]);
        let inverse = Inverse::of(2, &matrix(Interval::ZERO)).unwrap();
        let right = [3.0, 4.0].map(Interval::point);
        let solve = |e: Interval| {
            let entries = matrix(e);
            inverse.enclose(&entries, &inverse.defect(&entries), &right)
        };
        for e in [0.0, 0.01, 0.3] {
            let found = solve(Interval::around(0.0, e)).unwrap();
            for e in [-e, 0.0, e] {
                let x = [(5.0 + 3.0 * e) / (5.0 + 2.0 * e), 5.0 / (5.0 + 2.0 * e)];
                assert!(found.iter().zip(x).all(|(found, x)| found.contains(x)), "{found:?} {x:?}");
            }
            assert!(found.iter().all(|x| x.width() < 4e-15 + 3.0 * e), "{found:?}");
        }
        // At e = -5/2 it is singular.
        assert_eq!(solve(Interval::around(0.0, 2.5)), None);
    }

    /// With what a bound says it is one: |z| + E D < D, in sums that doubles have exactly.
    #[test]
    fn bounds_hold_what_they_bound() {
        let defect = Defect { size: 2, rows: vec![0.5, 0.125, 0.0625, 0.25] };
        let middle = [1.0, -3.0].map(Interval::point);
        for guess in [[0.1, 0.1], [2.0, 5.0], [1e-300, 40.0], [64.0, 64.0]] {
            let [bound, through] = defect.bound(&middle, &guess).unwrap();
            let rows = [[0.5, 0.125], [0.0625, 0.25]];
            for k in 0..2 {
                let e = rows[k][0] * bound[0] + rows[k][1] * bound[1];
                assert!(through[k] >= e && through[k] <= e * (1.0 + 1e-14), "{through:?} {e}");
                assert!(middle[k].mag() + e < bound[k], "{guess:?}: {bound:?}");
            }
        }
        // What is as large as it was is no bound: of spectral radius 1.
        let whole = Defect { size: 2, rows: vec![1.0, 0.0, 0.0, 0.5] };
        assert_eq!(whole.bound(&middle, &[8.0, 8.0]), None);
    }
}
