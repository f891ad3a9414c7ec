use nalgebra::DVector;

use crate::equations::correct;
use crate::path::Path;

/// Halvings at most: they exhaust the digits of a double.
const MOST: usize = 80;

/// The bracket, as a part of the chord, below which there is nothing left to refine.
const NARROW: f64 = 1e-14;

/// The point on the curve between `a` and `b`, near to each other, where `test` changes its sign:
/// points are named by their foot on the chord.
///
/// `test` sees the point and the chord. `None` if it does not change its sign, or the curve is
/// lost.
pub(crate) fn on_chord(
    path: &Path<'_>,
    a: &DVector<f64>,
    b: &DVector<f64>,
    test: impl Fn(&DVector<f64>, &DVector<f64>) -> Option<f64>,
) -> Option<DVector<f64>> {
    let chord = b - a;
    let row = &chord / chord.norm();
    sign_change([a, b], NARROW, |part| correct(path, a + part * &chord, &row), |y| test(y, &row))
        .map(|(_, y)| y)
}

/// Where `test` changes its sign between two ends, by regula falsi (the Illinois rule) with
/// bisection, to this part of the way: the part of the way, and the point there.
pub(crate) fn sign_change<P: Clone>(
    [a, b]: [&P; 2],
    narrow: f64,
    mut point: impl FnMut(f64) -> Option<P>,
    mut test: impl FnMut(&P) -> Option<f64>,
) -> Option<(f64, P)> {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    let (mut at_low, mut at_high) = (test(a)?, test(b)?);
    if at_low.abs() <= 0.0 {
        return Some((low, a.clone()));
    }
    if at_high.abs() <= 0.0 {
        return Some((high, b.clone()));
    }
    let changes = at_low * at_high < 0.0;
    if !changes {
        // So it does if one of them is no number.
        return None;
    }
    let mut best = if at_low.abs() < at_high.abs() { (low, a.clone()) } else { (high, b.clone()) };
    let mut kept = 0_i32;
    for round in 0..MOST {
        if high - low <= narrow {
            break;
        }
        let secant = low + (high - low) * at_low / (at_low - at_high);
        // A weighted secant that keeps missing on one side gives way to bisection.
        let inside = secant > low && secant < high && round % 4 != 3;
        let middle = if inside { secant } else { 0.5 * (low + high) };
        // At a point where two curves cross the corrector fails; next to it, it does not.
        let Some(y) = point(middle) else { break };
        let Some(here) = test(&y) else { break };
        let moved = (middle - best.0).abs();
        best = (middle, y);
        if here.abs() <= 0.0 || moved <= narrow {
            break;
        }
        if here * at_low > 0.0 {
            (low, at_low) = (middle, here);
            if kept == 1 {
                at_high *= 0.5;
            }
            kept = 1;
        } else {
            (high, at_high) = (middle, here);
            if kept == -1 {
                at_low *= 0.5;
            }
            kept = -1;
        }
    }
    Some(best)
}

/// Half the width, as a part of the chord, of the neighbourhood from which a crossing is
/// interpolated: the sixth power of it is below rounding, and its nearest point still far from
/// singular.
const AROUND: f64 = 0.02;

/// Points of the interpolation, as parts of that.
const SAMPLES: [f64; 6] = [-1.0, -2.0 / 3.0, -1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];

/// The same where curves cross. There the corrector is singular, so the point is interpolated from
/// its neighbours on the curve, as a function of `test` (Neville's scheme at 0).
pub(crate) fn crossing_on_chord(
    path: &Path<'_>,
    a: &DVector<f64>,
    b: &DVector<f64>,
    test: impl Fn(&DVector<f64>, &DVector<f64>) -> Option<f64>,
) -> Option<DVector<f64>> {
    let rough = on_chord(path, a, b, &test)?;
    let chord = b - a;
    let size = chord.norm();
    let row = &chord / size;
    let middle = row.dot(&(&rough - a)) / size;
    let half = AROUND.min(middle).min(1.0 - middle);
    let samples: Option<Vec<(f64, DVector<f64>)>> = SAMPLES
        .iter()
        .map(|part| {
            let y = correct(path, a + (middle + half * part) * &chord, &row)?;
            Some((test(&y, &row)?, y))
        })
        .collect();
    let Some(samples) = samples else { return Some(rough) };
    // The test must rise or fall all the way.
    let falls = samples.windows(2).all(|pair| pair[1].0 < pair[0].0);
    if !(falls || samples.windows(2).all(|pair| pair[1].0 > pair[0].0)) {
        return Some(rough);
    }
    let (tests, mut values): (Vec<f64>, Vec<DVector<f64>>) = samples.into_iter().unzip();
    for level in 1..tests.len() {
        for k in 0..tests.len() - level {
            let (low, high) = (tests[k], tests[k + level]);
            values[k] = (&values[k] * high - &values[k + 1] * low) / (high - low);
        }
    }
    Some(values.swap_remove(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_sign_is_found_to_the_last_digit() {
        let between = |a: f64, b: f64, test: &dyn Fn(f64) -> f64| {
            let mut asked = 0;
            let found = sign_change(
                [&a, &b],
                NARROW,
                |part| {
                    asked += 1;
                    Some(a + part * (b - a))
                },
                |x: &f64| Some(test(*x)),
            );
            (found, asked)
        };
        for root in [0.125, 0.3, 0.99_f64] {
            for sign in [1.0, -1.0] {
                // Curved to either side, and with a double slope: the secant alone would creep.
                let curved = |x: f64| sign * (x.powi(9) - root * root.powi(8));
                let (found, asked) = between(-0.5, 1.5, &curved);
                let (part, x) = found.unwrap();
                assert!((x - root).abs() < 1e-13 && (2.0 * part - root - 0.5).abs() < 1e-13, "{x}");
                assert!(asked < 60, "{asked}");
            }
        }
        // Points that are asked for, of which each gains digits: a bend, one to either side, a step.
        let tests: [(&dyn Fn(f64) -> f64, usize); 4] = [
            (&|x| x * x - 0.5, 11),
            (&|x| 0.5 - x.powi(5), 13),
            (&|x| (x - 0.3).cbrt(), 39),
            (&|x| if x > 0.7 { 1.0 } else { -3.0 }, 54),
        ];
        let found = tests.map(|(test, _)| between(0.0, 1.0, test).1);
        assert_eq!(found, tests.map(|(_, asked)| asked));
        let line = |x: f64| 3.0 * x - 1.5;
        assert_eq!(between(0.5, 2.0, &line).0, Some((0.0, 0.5)));
        assert_eq!(between(-1.0, 0.5, &line).0, Some((1.0, 0.5)));
        assert_eq!(between(0.0, 1.0, &line), (Some((0.5, 0.5)), 1));
        assert_eq!(between(0.75, 2.0, &line).0, None);
        assert_eq!(between(0.0, 2.0, &|x| if x > 1.0 { f64::NAN } else { -1.0 }).0, None);
        // A curve that is lost leaves the end that is nearer.
        let lost =
            |a: f64, b: f64| sign_change([&a, &b], NARROW, |_| None, |x: &f64| Some(line(*x)));
        assert_eq!((lost(0.0, 0.75), lost(0.25, 2.0)), (Some((1.0, 0.75)), Some((0.0, 0.25))));
    }
}
