//! All patterns of tension and compression on one cell at once.
//!
//! A pattern only flips the signs of the bars' terms. Written as middle and radius, a sign moves
//! the middle and leaves the radius alone: so the radii of all sums, rounding errors included, are
//! the same for all patterns and are computed once for a cell, and what is left for each pattern
//! are sums of plain numbers. Those have their prefixes in common in a walk over the tree of signs,
//! and a bound over the signs not yet chosen cuts off whole branches.
//!
//! # Rounding
//!
//! A sum of n + 1 numbers in any order of plain additions is off by at most n u / (1 − n u) times
//! the sum of their absolute values (u = 2⁻⁵³); twice that goes into the radius. The few operations
//! per pattern that remain are covered by [`SLACK`], a relative error a thousand times theirs. (N.
//! J. Higham, "Accuracy and Stability of Numerical Algorithms", 2002, section 4.2,
//! doi:10.1137/1.9780898718027)

use numerics::Interval;

use crate::run::closure::Pattern;
use crate::run::closure::bar::BarTerm;
use crate::run::plane::cell::Cell;
use crate::run::plane::system::System;

/// Relative allowance for the roundings of a few dozen operations on numbers that are not negative:
/// each is off by 2⁻⁵³ at most.
const SLACK: f64 = 1.0 + f64::from_bits((1023 - 40) << 52);

/// Roundings in a sum of two or three products, relative to the sum of the absolute values: they
/// are off by 3 u at most, 2⁻⁵⁰ is 8 u.
const PRODUCTS: f64 = 4.0 * f64::EPSILON;

/// Contraction of Krawczyk's operator below which a proof is tried. At one half Newton's method
/// converges from everywhere in the cell.
const PROMISING: f64 = 0.5;

/// What one bar adds to the sums: the value over the cell, the value at its middle, the slope.
const PARTS: usize = 8;

/// The sums of all patterns on one cell.
#[derive(Debug)]
pub(crate) struct PatternSums {
    bars: usize,
    /// Middles of the terms of each bar.
    middle: Vec<[f64; PARTS]>,
    /// Radii of the sums, the same for all patterns.
    radius: [f64; PARTS],
    /// Largest absolute value of the sum of the terms of bar i and all after it, over the cell.
    rest: Vec<[f64; 2]>,
    /// Where the sums start: −D.
    start: [f64; PARTS],
    /// The cell, its middle and its half widths.
    cell: [Interval; 2],
    at: [f64; 2],
    half: [f64; 2],
    /// How far each coordinate of the cell moves the closure of any pattern, at most; plain
    /// numbers.
    pub(crate) blur: [f64; 2],
}

/// What the walk says of a pattern that it cannot exclude.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Open {
    pub(crate) pattern: Pattern,
    /// The part of the cell that still can hold a zero.
    pub(crate) left: [Interval; 2],
    /// Whether a proof of a single zero is likely to succeed.
    pub(crate) promising: bool,
    /// Coordinates in which rounding errors hide more than the cell is wide: cutting across them
    /// cannot help.
    pub(crate) noisy: [bool; 2],
}

impl PatternSums {
    /// The terms of all bars over a cell; `None` where the force of some bar vanishes.
    pub(crate) fn over(system: &System, cell: &Cell) -> Option<Self> {
        Self::of(&system.length, system.weights(cell.face), system.span, cell)
    }

    /// The same for bars of these lengths and weights, to any place of a range of spans.
    pub(crate) fn of(
        lengths: &[Interval],
        weights: &[Interval],
        span: [Interval; 2],
        cell: &Cell,
    ) -> Option<Self> {
        let bars = lengths.len();
        let at = cell.middle();
        let point = Cell::point(cell.face, at);
        let mut sums = Self {
            bars,
            middle: Vec::with_capacity(bars),
            radius: [0.0; PARTS],
            rest: vec![[0.0; 2]; bars + 1],
            start: [0.0; PARTS],
            cell: cell.at,
            at,
            half: cell.half(),
            blur: [0.0; 2],
        };
        // Sum of absolute values, for the rounding error of the sums.
        let mut size = [0.0; PARTS];
        let mut add = |sums: &mut Self, part: usize, term: Interval| {
            let middle = term.mid();
            sums.radius[part] += term.rad();
            size[part] += middle.abs();
            middle
        };
        for (k, span) in span.into_iter().enumerate() {
            for part in [k, 2 + k] {
                sums.start[part] = add(&mut sums, part, -span);
            }
        }
        for (length, weight) in lengths.iter().zip(weights) {
            let term = BarTerm::over(cell, *length, *weight)?;
            let centre = BarTerm::value_over(&point, *length, *weight);
            let terms = [
                term.value[0], term.value[1], centre[0], centre[1], term.slope[0][0],
                term.slope[0][1], term.slope[1][0], term.slope[1][1],
            ];
            let middle = std::array::from_fn(|part| add(&mut sums, part, terms[part]));
            for k in 0..2 {
                sums.blur[k] += sums.half[k] * (term.slope[0][k].mag() + term.slope[1][k].mag());
            }
            sums.middle.push(middle);
        }
        let roundings = f64::EPSILON * (bars + 1) as f64;
        for (radius, size) in sums.radius.iter_mut().zip(size) {
            *radius = SLACK * (*radius + roundings * size);
        }
        for bar in (0..bars).rev() {
            for k in 0..2 {
                sums.rest[bar][k] = SLACK * (sums.rest[bar + 1][k] + sums.middle[bar][k].abs());
            }
        }
        Some(sums)
    }

    /// The coordinate of the cell to cut: the one whose width blurs the closure more.
    pub(crate) fn widest(&self) -> usize {
        usize::from(self.blur[1] > self.blur[0])
    }

    /// Those of the patterns, sorted, that the cell may hold a zero of.
    pub(crate) fn open(&self, patterns: &[Pattern]) -> Vec<Open> {
        let mut open = vec![];
        self.walk(0, patterns, self.start, &mut open);
        open
    }

    fn walk(&self, bar: usize, patterns: &[Pattern], sum: [f64; PARTS], open: &mut Vec<Open>) {
        if patterns.is_empty() {
            return;
        }
        // The bars to come cannot bring the sum back to zero, whatever their signs.
        if (0..2).any(|k| sum[k].abs() > SLACK * (self.rest[bar][k] + self.radius[k])) {
            return;
        }
        if bar == self.bars {
            open.extend(patterns.iter().filter_map(|pattern| self.leaf(*pattern, sum)));
            return;
        }
        let bit = Pattern::bit(self.bars, bar);
        let (tension, compression) =
            patterns.split_at(patterns.partition_point(|pattern| pattern.0 & bit == 0));
        let term = &self.middle[bar];
        self.walk(bar + 1, tension, std::array::from_fn(|part| sum[part] + term[part]), open);
        self.walk(bar + 1, compression, std::array::from_fn(|part| sum[part] - term[part]), open);
    }

    /// The mean value form and the interval Newton operator of one pattern:
    /// Φ(X) ⊂ Φ(m) + J(X − m), and the same after multiplication by the adjugate of the middle of
    /// J.
    fn leaf(&self, pattern: Pattern, sum: [f64; PARTS]) -> Option<Open> {
        let [rx, ry] = self.half;
        let radius = &self.radius;
        let gap = [sum[2], sum[3]];
        let [a, b, c, d] = [sum[4], sum[5], sum[6], sum[7]];
        // Each row of Φ over the cell, on its own.
        let reach = [
            radius[2] + (a.abs() + radius[4]) * rx + (b.abs() + radius[5]) * ry,
            radius[3] + (c.abs() + radius[6]) * rx + (d.abs() + radius[7]) * ry,
        ];
        if gap[0].abs() > SLACK * reach[0] || gap[1].abs() > SLACK * reach[1] {
            return None;
        }
        // adj(J_m) Φ = adj(J_m) Φ(m) + det(J_m) (x − m) + adj(J_m) (J − J_m) (x − m) for some J.
        let determinant = a * d - b * c;
        let determinant_error = PRODUCTS * ((a * d).abs() + (b * c).abs());
        let adjugate = [[d, -b], [-c, a]];
        // |J − J_m| |x − m| and the error of Φ(m), both as errors of Φ.
        let blur = [
            radius[2] + radius[4] * rx + radius[5] * ry,
            radius[3] + radius[6] * rx + radius[7] * ry,
        ];
        let size = determinant.abs() - determinant_error;
        let mut left = [Interval::LINE; 2];
        let mut contraction = 0.0_f64;
        let mut noisy = [false; 2];
        for k in 0..2 {
            let [p, q] = adjugate[k];
            let moved = p * gap[0] + q * gap[1];
            let moved_error = PRODUCTS * ((p * gap[0]).abs() + (q * gap[1]).abs());
            let blurred = SLACK * (p.abs() * blur[0] + q.abs() * blur[1] + moved_error);
            if moved.abs()
                > SLACK * (blurred + (determinant.abs() + determinant_error) * self.half[k])
            {
                return None;
            }
            let slopes = [
                p.abs() * radius[4] + q.abs() * radius[6],
                p.abs() * radius[5] + q.abs() * radius[7],
            ];
            let noise = p.abs() * radius[2] + q.abs() * radius[3] + moved_error;
            let shrinking = determinant.abs() * self.half[k] + slopes[0] * rx + slopes[1] * ry;
            noisy[k] = noise >= shrinking;
            contraction =
                contraction.max((slopes[0] * rx + slopes[1] * ry) / (size * self.half[k]));
            if size > 0.0 {
                // det (x_k − m_k) = −moved ± blurred.
                let middle = -moved / determinant;
                let radius = SLACK * (blurred / size + PRODUCTS * middle.abs())
                    + SLACK * middle.abs() * determinant_error / size;
                left[k] = self.cell[k]
                    .intersect(Interval::point(self.at[k]) + Interval::around(middle, radius))?;
            } else {
                left[k] = self.cell[k];
            }
        }
        let promising = size > 0.0 && contraction < PROMISING;
        Some(Open { pattern, left, promising, noisy })
    }
}

#[cfg(test)]
mod tests {
    use crate::run::plane::loads::JointLoads;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::run::closure::Closure;
    use crate::run::plane::face::Face;
    use crate::run::slack::exclusion;

    /// The chain of the test with the span that this pattern closes at this pull exactly.
    fn closed(system: &System, pattern: Pattern, at: &Cell) -> System {
        let signs: Vec<i8> = pattern.signs(system.bars()).collect();
        let mut closed = system.clone();
        closed.span = [Interval::ZERO; 2];
        closed.span = Closure::gap_over(&closed, &signs, at);
        closed
    }

    /// Sums without radii over a cell from −2 to 2, and the gap and slope of their one pattern.
    fn sums(numbers: [f64; PARTS]) -> (PatternSums, [f64; PARTS]) {
        let cell = [Interval::new(-2.0, 2.0); 2];
        let sums = PatternSums {
            bars: 0,
            middle: vec![],
            radius: [0.0; PARTS],
            rest: vec![[0.0; 2]],
            start: [0.0; PARTS],
            cell,
            at: [0.0; 2],
            half: [2.0; 2],
            blur: [0.0; 2],
        };
        (sums, numbers)
    }

    /// x + y = −2⁻⁴¹ and x + (1 + 2⁻⁴⁰) y = 0: y = 1/2 and x = −1/2 − 2⁻⁴¹. The determinant is 2⁻⁴⁰,
    /// and known to 2⁻⁵⁰ times the sum of its two products, a part of 2⁻⁹: room for as much of x.
    #[test]
    fn the_rounding_of_a_small_determinant_has_room() {
        let small = f64::from_bits((1023 - 40) << 52);
        let (sums, sum) = sums([0.0, 0.0, 0.5 * small, 0.0, 1.0, 1.0, 1.0, 1.0 + small]);
        let open = sums.leaf(Pattern(0), sum).unwrap();
        assert!(open.promising && open.noisy == [false; 2]);
        for (left, x) in open.left.into_iter().zip([-0.5 - 0.5 * small, 0.5]) {
            let room = left.rad() / (0.5 / 512.0);
            assert!(left.contains(x) && (1.0..1.02).contains(&room), "{left:?} {room}");
        }
    }

    /// x = 1 and y = −3/2 lie in the cell, x = 3 does not.
    #[test]
    fn zeros_in_the_cell_are_kept() {
        let (sums, sum) = sums([0.0, 0.0, -1.0, 1.5, 1.0, 0.0, 0.0, 1.0]);
        let open = sums.leaf(Pattern(0), sum).unwrap();
        for (left, x) in open.left.into_iter().zip([1.0, -1.5]) {
            assert!(left.contains(x) && left.width() < 1e-14, "{left:?}");
        }
        assert!(sums.leaf(Pattern(0), [0.0, 0.0, -3.0, 1.5, 1.0, 0.0, 0.0, 1.0]).is_none());
        // 2 x = 6 and 2 y = 0 as x + y = 3 and x − y = 3: each row alone may vanish.
        assert!(sums.leaf(Pattern(0), [0.0, 0.0, -3.0, -3.0, 1.0, 1.0, 1.0, -1.0]).is_none());
    }

    /// Without a slope nothing is known of a zero.
    #[test]
    fn a_closure_without_slope_promises_nothing() {
        let (sums, sum) = sums([0.0; PARTS]);
        let open = sums.leaf(Pattern(0), sum).unwrap();
        assert_eq!((open.promising, open.left), (false, [Interval::new(-2.0, 2.0); 2]));
    }

    /// No test may ever exclude a cell that holds a zero, nor contract the zero away.
    #[test]
    fn a_zero_is_never_excluded() {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let problem = model::cases::get("six-orders").unwrap().problem();
        let others = ["three-bars-off-centre", "massless-links", "five-in-space"]
            .map(|name| model::cases::get(name).unwrap().problem());
        let mut contracted = 0;
        for round in 0..20_000 {
            let problem = if round % 4 == 0 { &problem } else { &others[round % 4 - 1] };
            let system = System::new(problem.chain(), JointLoads::NONE);
            let faces =
                [Face::Near, Face::Left, Face::Right, Face::Below, Face::Above, Face::Around(1)];
            let face = faces[round % faces.len()];
            let shrink: f64 = 10f64.powf(rng.random_range(-12.0..0.0));
            let near = if face == Face::Around(1) {
                10f64.powf(rng.random_range(-12.0..0.0))
            } else {
                1.0
            };
            let at = [near * rng.random_range(-1.0..1.0), near * rng.random_range(0.0..1.0)];
            let pattern = Pattern(rng.random_range(0..1 << system.bars()));
            let system = closed(&system, pattern, &Cell::point(face, at));
            let cell = Cell {
                face,
                at: at.map(|x| {
                    Interval::new(
                        x - near * shrink * rng.random_range(0.0..1.0),
                        x + near * shrink * rng.random_range(0.0..1.0),
                    )
                }),
            };
            let all: Vec<Pattern> = (0..1 << system.bars()).map(Pattern).collect();
            let open = |cell: &Cell| match PatternSums::over(&system, cell) {
                Some(sums) => sums.open(&all),
                None => exclusion::open(&system, cell, &all)
                    .into_iter()
                    .map(|pattern| Open {
                        pattern,
                        left: cell.at,
                        promising: false,
                        noisy: [false; 2],
                    })
                    .collect(),
            };
            let open = open(&cell);
            let kept = open.iter().find(|open| open.pattern == pattern);
            let kept = kept.unwrap_or_else(|| panic!("round {round}: excluded from {cell:?}"));
            assert!(kept.left[0].contains(at[0]) && kept.left[1].contains(at[1]), "round {round}");
            contracted += usize::from(kept.left[0].width() < 0.5 * cell.at[0].width());
        }
        // The tests are worth something: many cells are contracted.
        assert!(contracted > 1000, "{contracted}");
    }

    /// Slopes of 1 everywhere, known to 1/2 or 1/4 in one of them: over half widths of 2 that hides
    /// 1 or 1/2. What hides more of the value than that is noise.
    #[test]
    fn noise_is_what_hides_more_than_the_width() {
        let noisy = |part: usize, slope: f64, value: f64| {
            let (mut sums, sum) = sums([0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
            sums.radius[part] = slope;
            sums.radius[2] = value;
            sums.leaf(Pattern(0), sum).unwrap().noisy
        };
        for part in 4..8 {
            assert_eq!(noisy(part, 0.5, 0.75), [false; 2], "{part}");
            assert_eq!(noisy(part, 0.25, 0.75), [true; 2], "{part}");
        }
    }
}
