//! Bars without force between two vertical strands: any shape that fits is an equilibrium; this is
//! one.

use crate::condensed::chain::Condensed;
use crate::condensed::pull::{Pull, Signs};
use crate::thresholds::CLOSURE_ROUNDING;

/// No force at the bottom: every other bar carries the weights below it, straight up.
pub(super) fn solve(chain: &Condensed) -> Pull {
    Pull::new(chain, Signs::Unloaded(chain.bottom.group.clone()), [0.0; 2], [0.0; 3], 0)
}

/// Vectors of bars of the given lengths that lead along `gap` together.
///
/// The bar in the middle of the length and the straight pieces before and after it make a
/// quadrangle with the gap; of its shapes the one is taken whose diagonal is in the middle of its
/// range, hanging below the gap. The lengths must be able to fill the gap; what rounding errors
/// leave open stays open. Where lengths and gap are equal to rounding the bars lie straight: any
/// triangle would be made of the rounding, with sides at an angle of its root.
pub(in super::super) fn fill(lengths: &[f64], gap: [f64; 2]) -> Vec<[f64; 2]> {
    let way = gap[0].hypot(gap[1]);
    let along = if way > 0.0 { [gap[0] / way, gap[1] / way] } else { [1.0, 0.0] };
    let total = model::sum(lengths.iter().copied());
    if (total - way).abs() <= CLOSURE_ROUNDING * total {
        return lengths.iter().map(|length| along.map(|e| length * e)).collect();
    }
    let (middle, before) = middle_bar(lengths, total);
    let bar = lengths[middle];
    let after = (total - before - bar).max(0.0);
    // The first piece and the middle bar reach from |before - bar| to before + bar; so must, seen
    // from the other end, the last piece and the gap.
    let nearest = (before - bar).abs().max((after - way).abs());
    let farthest = (before + bar).min(after + way);
    let diagonal = 0.5 * (nearest + farthest);

    let corner = third_corner(along, way, diagonal, after);
    let direction = unit(corner, along);
    let knee = third_corner(direction, diagonal, before, bar);
    let first = unit(knee, direction);
    let second = unit([corner[0] - knee[0], corner[1] - knee[1]], direction);
    let last = unit([gap[0] - corner[0], gap[1] - corner[1]], along);
    let bars = lengths.iter().enumerate().map(|(k, length)| {
        let [x, z] = match k.cmp(&middle) {
            std::cmp::Ordering::Less => first,
            std::cmp::Ordering::Equal => second,
            std::cmp::Ordering::Greater => last,
        };
        [length * x, length * z]
    });
    bars.collect()
}

/// The bar that holds the middle of the length, and the length before it.
fn middle_bar(lengths: &[f64], total: f64) -> (usize, f64) {
    let mut before = 0.0;
    for (k, length) in lengths.iter().enumerate() {
        if before + length >= 0.5 * total {
            return (k, before);
        }
        before += length;
    }
    (lengths.len() - 1, total - lengths[lengths.len() - 1])
}

/// Corner of a triangle over the base `base` along `along`, at the distances `from` and `to` of its
/// two ends, on the side that lies lower.
///
/// The angle at the end of the shorter side is computed: from there an error of it moves the corner
/// least.
fn third_corner(along: [f64; 2], base: f64, from: f64, to: f64) -> [f64; 2] {
    if to < from {
        let back = third_corner(along.map(|x| -x), base, to, from);
        return [base * along[0] + back[0], base * along[1] + back[1]];
    }
    if from <= 0.0 {
        return [0.0, 0.0];
    }
    let cosine = if base > 0.0 {
        // (from^2 + base^2 - to^2)/(2 from base), without squares of nearly equal numbers.
        (base / from + (from - to) / base * ((from + to) / from)) * 0.5
    } else {
        0.0
    };
    let cosine = cosine.clamp(-1.0, 1.0);
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let side = if along[0] >= 0.0 { -sine } else { sine };
    [from * (cosine * along[0] - side * along[1]), from * (cosine * along[1] + side * along[0])]
}

fn unit([x, z]: [f64; 2], otherwise: [f64; 2]) -> [f64; 2] {
    let size = x.hypot(z);
    if size > 0.0 { [x / size, z / size] } else { otherwise }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second of three holds the middle; where rounding finds none, the last does.
    #[test]
    fn the_middle_of_the_length_lies_in_one_bar() {
        assert_eq!(middle_bar(&[1.0, 3.0, 2.0], 6.0), (1, 1.0));
        assert_eq!(middle_bar(&[1.0, 2.0, 4.0], 7.0), (2, 3.0));
        assert_eq!(middle_bar(&[1.0, 2.0], 8.0), (1, 6.0));
    }

    /// Over a base of 5 the corner of 3 and 4 lies 2.4 below it, 1.8 from the shorter side's end.
    #[test]
    fn the_third_corner_lies_below() {
        for (along, from, to, wanted) in [
            ([1.0, 0.0], 3.0, 4.0, [1.8, -2.4]),
            ([1.0, 0.0], 4.0, 3.0, [3.2, -2.4]),
            ([-1.0, 0.0], 3.0, 4.0, [-1.8, -2.4]),
            ([0.6, -0.8], 3.0, 4.0, [1.08 - 1.92, -1.44 - 1.44]),
        ] {
            let found = third_corner(along, 5.0, from, to);
            assert!((found[0] - wanted[0]).hypot(found[1] - wanted[1]) < 1e-14, "{found:?}");
        }
    }

    #[test]
    fn pieces_fill_the_gap() {
        let cases: [(&[f64], [f64; 2]); 9] = [
            (&[1.0, 1.0], [0.0, 0.0]),
            (&[1.0, 1.0, 1.0], [0.0, 0.0]),
            (&[1.0, 1.0, 1.0], [0.5, -0.5]),
            (&[3.0, 1.0, 1.0], [1.0, 0.0]),
            (&[1.0, 3.0, 1.0], [0.0, 1.5]),
            (&[1.0, 1.0, 3.0], [0.0, -1.0]),
            (&[0.25; 40], [3.0, 2.0]),
            (&[2.0, 1.0], [3.0, 0.0]),
            (&[1.5], [0.0, -1.5]),
        ];
        for (lengths, gap) in cases {
            let bars = fill(lengths, gap);
            let sum = bars.iter().fold([0.0, 0.0], |s, b| [s[0] + b[0], s[1] + b[1]]);
            assert!(
                (sum[0] - gap[0]).hypot(sum[1] - gap[1]) < 1e-14,
                "{lengths:?} {gap:?} {sum:?}"
            );
            for (bar, length) in bars.iter().zip(lengths) {
                assert!((bar[0].hypot(bar[1]) / length - 1.0).abs() < 1e-14);
            }
        }
    }
}
