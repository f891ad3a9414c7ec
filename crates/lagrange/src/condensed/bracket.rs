//! The root of an increasing function of one variable, come what may.

use crate::thresholds::HALVED;

/// Without a second bound the distance from the first is multiplied by this.
const REACH: f64 = 8.0;

/// An interval that holds the root; open ends are infinite.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bracket {
    pub low: f64,
    pub high: f64,
}

impl Bracket {
    pub const LINE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// Find x with $|f(x)| \le$ `enough` by Newton's method, and by bisection where it is slow.
    ///
    /// `f` returns value and derivative, or `None` when it may not be asked any more. The result is
    /// the point asked last, within a rounding of the root when `enough` cannot be reached.
    pub fn root(
        mut self,
        start: f64,
        scale: f64,
        enough: f64,
        mut f: impl FnMut(f64) -> Option<(f64, f64)>,
    ) -> Option<f64> {
        let (mut x, mut reach) = (start, scale);
        let mut last = f64::INFINITY;
        loop {
            let (value, slope) = f(x)?;
            if value.is_nan() {
                return None;
            }
            if value.abs() <= enough {
                return Some(x);
            }
            if value < 0.0 {
                self.low = x;
            } else {
                self.high = x;
            }
            let newton = x - value / slope;
            let slow = value.abs() > HALVED * last;
            last = value.abs();
            let bounded = self.low.is_finite() && self.high.is_finite();
            let near = bounded || (newton - x).abs() <= REACH * reach;
            let inside = newton > self.low && newton < self.high && near;
            let next = if inside && !slow {
                newton
            } else if bounded {
                // After a bisection Newton's step gets another chance.
                last = f64::INFINITY;
                0.5 * (self.low + self.high)
            } else {
                last = f64::INFINITY;
                reach *= REACH;
                if value < 0.0 { x + reach } else { x - reach }
            };
            if !next.is_finite() || (next - x).abs() <= f64::EPSILON * x.abs() {
                return next.is_finite().then_some(x);
            }
            x = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cap that none of the functions below comes near.
    const CALLS: usize = 400;

    fn solve(bracket: Bracket, start: f64, enough: f64, f: impl Fn(f64) -> (f64, f64)) -> f64 {
        let mut calls = 0;
        bracket
            .root(start, 1.0, enough, |x| {
                calls += 1;
                (calls < CALLS).then(|| f(x))
            })
            .unwrap()
    }

    #[test]
    fn finds_roots_where_newton_alone_would_not() {
        let arctan = |x: f64| ((x - 3.0).atan(), 1.0 / (1.0 + (x - 3.0).powi(2)));
        assert!((solve(Bracket::LINE, 1e6, 0.0, arctan) - 3.0).abs() < 1e-14);
        let cubic = |x: f64| (x.powi(3), 3.0 * x * x);
        let around = Bracket { low: -1.0, high: 2.0 };
        assert!(solve(around, 1.0, 1e-90, cubic).abs() <= 1e-30);
        // A jump: no value is zero, but the place is exact.
        let jump = |x: f64| (if x < 0.3 { -1.0 } else { 1.0 }, 0.0);
        assert!((solve(Bracket { low: 0.0, high: 1.0 }, 0.9, 0.0, jump) - 0.3).abs() < 1e-15);
        assert!(Bracket::LINE.root(0.0, 1.0, 0.0, |_| Some((f64::NAN, 1.0))).is_none());
    }
}
