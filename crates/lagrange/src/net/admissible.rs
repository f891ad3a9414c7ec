//! The least forces that signs allow.
//!
//! Forces in balance are $t = t_0 + Q z$, with $t_0$ the least of them and $Q$ a basis of the
//! self-stresses that is orthonormal in the complementary energy: the least $|z|$ with $G z \ge h$
//! is sought, one row for each cable, strut and push of the floor. That is least squares with
//! unknowns that are not negative: with $E = [G\ h]^T$ and $f = (0, \dots, 0, 1)$ the residual $r =
//! f - E u$ of the best $u \ge 0$ has $z = -r_z/r_h$ (Lawson and Hanson 1974, chapter 23).

use matrices::dense::{apply, least_squares};
use nalgebra::{DMatrix, DVector};

use super::ranges::MOST_EXCHANGES;

/// A residual below this is zero: no forces obey all signs. A slope below it improves nothing.
const ROUNDING: f64 = 1e-11;

/// The shortest $z$ with $G z \ge h$; `None` where there is none.
pub(super) fn shortest(g: &DMatrix<f64>, h: &DVector<f64>) -> Option<DVector<f64>> {
    let scale = h.amax();
    if scale <= 0.0 {
        return Some(DVector::zeros(g.ncols()));
    }
    let (count, size) = (g.nrows(), g.ncols());
    let mut e = DMatrix::zeros(size + 1, count);
    e.rows_mut(0, size).copy_from(&g.transpose());
    e.row_mut(size).copy_from(&(h / scale).transpose());
    let mut f = DVector::zeros(size + 1);
    f[size] = 1.0;
    let rest = &f - apply(&e, &not_negative(&e, &f)?);
    // Its last component is its squared size.
    (rest[size] > ROUNDING).then(|| rest.rows(0, size) * (-scale / rest[size]))
}

/// The $u \ge 0$ with the least $|E u - f|$; `None` where the exchanges come to no end.
fn not_negative(e: &DMatrix<f64>, f: &DVector<f64>) -> Option<DVector<f64>> {
    let count = e.ncols();
    let mut u = DVector::<f64>::zeros(count);
    let mut open: Vec<usize> = Vec::new();
    for _ in 0..MOST_EXCHANGES * count.max(1) {
        let slopes = apply(&e.transpose(), &(f - apply(e, &u)));
        let closed = (0..count).filter(|k| !open.contains(k) && slopes[*k] > ROUNDING);
        let Some(next) = closed.max_by(|a, b| slopes[*a].total_cmp(&slopes[*b])) else {
            return Some(u);
        };
        open.push(next);
        while !open.is_empty() {
            let best = least_squares(&e.select_columns(&open), f, ROUNDING)?;
            // As far towards the best as nothing gets negative.
            let ways = open.iter().zip(best.iter()).filter(|(_, b)| **b <= 0.0);
            let way = ways.map(|(k, b)| u[*k] / (u[*k] - b)).fold(1.0, f64::min);
            for (k, b) in open.iter().zip(best.iter()) {
                u[*k] += way * (b - u[*k]);
            }
            if best.iter().all(|b| *b > 0.0) {
                break;
            }
            open.retain(|k| {
                let stays = u[*k] > ROUNDING;
                if !stays {
                    u[*k] = 0.0;
                }
                stays
            });
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: nearest points of a half plane, of a corner, and of nothing.
    #[test]
    fn the_shortest_is_the_foot_of_the_perpendicular() {
        let near = |g: &[f64], h: &[f64], wanted: [f64; 2]| {
            let g = DMatrix::from_row_slice(h.len(), 2, g);
            let found = shortest(&g, &DVector::from_row_slice(h)).unwrap();
            assert!((found - DVector::from_row_slice(&wanted)).amax() < 1e-12);
        };
        // 3 x + 4 y >= 10: (1.2, 1.6)
        near(&[3.0, 4.0], &[10.0], [1.2, 1.6]);
        // and x >= 2: (2, 1); and -x - y >= -9, which does not bind
        near(&[3.0, 4.0, 1.0, 0.0, -1.0, -1.0], &[10.0, 2.0, -9.0], [2.0, 1.0]);
        // x >= 2 alone binds where 3 x + 4 y >= 5 is met there.
        near(&[3.0, 4.0, 1.0, 0.0], &[5.0, 2.0], [2.0, 0.0]);
        near(&[3.0, 4.0], &[-10.0], [0.0, 0.0]);
        let g = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, -1.0, 0.0]);
        assert_eq!(shortest(&g, &DVector::from_row_slice(&[1.0, 1.0])), None);
    }
}
