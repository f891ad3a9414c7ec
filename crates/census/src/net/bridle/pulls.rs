//! The pulls with which a strand can reach a box of places of the knot.
//!
//! The forces of a strand lie in the vertical plane of its pull, and so do its bars. With the pull
//! (H, V) at the anchor it ends at $\Phi_s = \sum_k s_k l_k F_k/|F_k|$, $F_k = (H, V + c_k)$, as in
//! the census of a chain: two equations in two unknowns for each pattern of tension and
//! compression. Cells of the half cube of pulls that miss the box are dropped, narrowed by Newton's
//! method, or cut until they are no coarser than the box is.

use numerics::Interval;

use super::strand::{Span, Strand};
use crate::boxes::arithmetic::norm;
use crate::branch_and_bound::hull;
use crate::run::closure::Pattern;
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::search::GOOD_CONTRACTION;
use crate::run::search::pattern_sums::PatternSums;
use crate::run::slack::exclusion::open_of;

/// A cell narrower than this, in widths of the box, tells the force well enough.
const FINE: f64 = 0.5;

/// Most cells of a strand that are told apart.
const MOST: usize = 4096;

/// A cell of pulls, and the patterns with which they may reach the knot.
#[derive(Debug, Clone)]
pub(super) struct Pulls {
    pub(super) cell: Cell,
    pub(super) patterns: Vec<Pattern>,
}

impl Pulls {
    /// All pulls and patterns of a strand.
    pub(super) fn all(strand: &Strand) -> Vec<Self> {
        let (full, half) = (Interval::new(-1.0, 1.0), Interval::new(0.0, 1.0));
        if strand.is_rod() {
            let rod = |(face, x)| Self {
                cell: Cell { face, at: [x, Interval::ZERO] },
                patterns: vec![Pattern(0)],
            };
            return [(Face::Near, full), (Face::Left, half), (Face::Right, half)].map(rod).into();
        }
        let patterns: Vec<Pattern> = (0..1 << strand.length.len()).map(Pattern).collect();
        let roots = Cell::roots(false).into_iter();
        roots.map(|cell| Self { cell, patterns: patterns.clone() }).collect()
    }
}

/// The force density of a bar alone as a quotient t/w: on the face w = 1 the small ones, pushes on
/// the left and pulls on the right face, with the first coordinate as the other number.
pub(super) fn density(cell: &Cell) -> [Interval; 2] {
    match cell.face {
        Face::Left => [-Interval::ONE, cell.at[0]],
        Face::Right => [Interval::ONE, cell.at[0]],
        _ => [cell.at[0], Interval::ONE],
    }
}

/// The part of a cell of a bar alone with these densities; nothing if there is none.
pub(super) fn with_density(cell: &Cell, density: Interval) -> Option<Cell> {
    let of_size = |density: Interval| {
        if density.hi() <= 0.0 {
            return None;
        }
        let least = (Interval::ONE / Interval::point(density.hi())).lo().max(0.0);
        let most = if density.lo() > 0.0 {
            (Interval::ONE / Interval::point(density.lo())).hi()
        } else {
            f64::INFINITY
        };
        cell.at[0].intersect(Interval::new(least, most))
    };
    let first = match cell.face {
        Face::Left => of_size(-density)?,
        Face::Right => of_size(density)?,
        _ => cell.at[0].intersect(density)?,
    };
    Some(Cell { at: [first, cell.at[1]], ..*cell })
}

/// Those of the pulls that reach a box of places; also counts the tests of a cell for a pattern.
pub(super) fn reaching(
    strand: &Strand,
    span: &Span,
    width: f64,
    pulls: &[Pulls],
    tests: &mut u64,
) -> Vec<Pulls> {
    if strand.is_rod() {
        let reaches = !norm(span.arm).disjoint(strand.length[0]);
        return if reaches { pulls.to_vec() } else { vec![] };
    }
    let mut waiting: Vec<Pulls> = pulls.iter().rev().cloned().collect();
    let (mut kept, mut alone) = (vec![], vec![]);
    while let Some(Pulls { cell, patterns }) = waiting.pop() {
        *tests += patterns.len() as u64;
        let many = kept.len() + alone.len() + waiting.len() >= MOST;
        let size = cell.at[0].width().max(cell.at[1].width());
        let Some(sums) = PatternSums::of(&strand.length, &strand.weight, span.way, &cell) else {
            // Bars whose forces may vanish may point anywhere.
            let patterns = open_of(
                &strand.length,
                &strand.weight,
                &strand.groups(),
                span.way,
                &cell,
                &patterns,
            );
            if patterns.is_empty() {
                continue;
            }
            if many || size <= FINE * width {
                kept.push(Pulls { cell, patterns });
            } else {
                let halves = cell.cut(cell.wider());
                waiting.extend(halves.map(|cell| Pulls { cell, patterns: patterns.clone() }));
            }
            continue;
        };
        let mut rest = vec![];
        let mut left: Option<[Interval; 2]> = None;
        for open in sums.open(&patterns) {
            let part = Cell { face: cell.face, at: open.left };
            let own = |pattern| Pulls { cell: part, patterns: vec![pattern] };
            if part.area() < GOOD_CONTRACTION * cell.area() {
                waiting.push(own(open.pattern));
            } else if open.promising {
                // As narrow as the box makes it.
                alone.push(own(open.pattern));
            } else {
                rest.push(open.pattern);
                left = Some(left.map_or(open.left, |all| hull(all, open.left)));
            }
        }
        let Some(at) = left else { continue };
        let cell = Cell { face: cell.face, at };
        let blur = sums.blur;
        // It moves the end of the strand further than the box is wide.
        let coarse = blur[0].max(blur[1]) > width && size > FINE * width;
        if coarse && !many {
            let across = usize::from(blur[1] > blur[0]);
            waiting.extend(cell.cut(across).map(|cell| Pulls { cell, patterns: rest.clone() }));
        } else {
            kept.push(Pulls { cell, patterns: rest });
        }
    }
    kept.extend(joined(strand, span, alone));
    kept
}

/// Cells that touch, of one pattern each, become one where the closure is regular on both together.
fn joined(strand: &Strand, span: &Span, alone: Vec<Pulls>) -> Vec<Pulls> {
    let mut all: Vec<Pulls> = vec![];
    for mut pulls in alone {
        let mut from = 0;
        while let Some(other) = all.get(from) {
            if let Some(both) = both(strand, span, &pulls, other) {
                all.swap_remove(from);
                pulls.cell = both;
                from = 0;
            } else {
                from += 1;
            }
        }
        all.push(pulls);
    }
    all
}

fn both(strand: &Strand, span: &Span, one: &Pulls, other: &Pulls) -> Option<Cell> {
    let touch = one.cell.face == other.cell.face
        && one.patterns == other.patterns
        && !one.cell.disjoint(&other.cell);
    if !touch {
        return None;
    }
    let cell = Cell { face: one.cell.face, at: hull(one.cell.at, other.cell.at) };
    let sums = PatternSums::of(&strand.length, &strand.weight, span.way, &cell)?;
    let [open] = sums.open(&one.patterns)[..] else { return None };
    open.promising.then_some(Cell { face: cell.face, at: open.left })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is(found: Interval, [lo, hi]: [f64; 2]) -> bool {
        found.encloses(Interval::new(lo, hi)) && found.width() < hi - lo + 1e-14
    }

    /// Densities from 2 to 4 are 1/4 to 1/2 on the face of pulls, their opposites on that of
    /// pushes.
    #[test]
    fn a_cell_is_cut_to_its_densities() {
        let (full, unit) = (Interval::new(-1.0, 1.0), Interval::new(0.0, 1.0));
        let cell = |face, x| Cell { face, at: [x, Interval::ZERO] };
        let [pulls, pushes] = [Interval::new(2.0, 4.0), Interval::new(-4.0, -2.0)];
        let first = |face, density| with_density(&cell(face, unit), density).map(|cell| cell.at[0]);
        assert!(is(first(Face::Right, pulls).unwrap(), [0.25, 0.5]));
        assert!(is(first(Face::Left, pushes).unwrap(), [0.25, 0.5]));
        assert_eq!([first(Face::Right, pushes), first(Face::Left, pulls)], [None; 2]);
        // Without a bound: all that is large enough.
        assert!(is(first(Face::Right, Interval::new(-1.0, 4.0)).unwrap(), [0.25, 1.0]));
        assert!(is(first(Face::Right, Interval::new(0.0, 4.0)).unwrap(), [0.25, 1.0]));
        let near = with_density(&cell(Face::Near, full), Interval::new(0.5, 4.0)).unwrap();
        assert_eq!(near.at, [Interval::new(0.5, 1.0), Interval::ZERO]);
        assert!(with_density(&cell(Face::Near, full), pulls).is_none());
        // And back: t/w.
        for (face, sign) in [(Face::Right, 1.0), (Face::Left, -1.0)] {
            let [t, w] = density(&cell(face, Interval::point(0.25)));
            assert_eq!((t, w), (Interval::point(sign), Interval::point(0.25)));
        }
    }

    /// Two bars of 1 under weights of ±1/2: with the pull (3/4, -1) the forces are (3/4, -3/2) and
    /// (3/4, -1/2).
    fn strand() -> Strand {
        Strand {
            members: vec![0, 1],
            joints: vec![1],
            anchor: [Interval::ZERO; 3],
            length: vec![Interval::ONE; 2],
            weight: [-0.5, 0.5].map(Interval::point).to_vec(),
        }
    }

    #[test]
    fn the_pulls_that_reach_a_place_hold_the_one_that_does() {
        let strand = strand();
        let [h, v] = [0.75, -1.0];
        let forces = [[h, v - 0.5], [h, v + 0.5]];
        // Both in tension, and the second compressed.
        for (pattern, sign) in [(0b00, 1.0), (0b01, -1.0)] {
            let unit = forces.map(|[x, z]: [f64; 2]| [x / x.hypot(z), z / x.hypot(z)]);
            let end: [f64; 2] = std::array::from_fn(|k| unit[0][k] + sign * unit[1][k]);
            // The plane of the strand has its end on the right.
            let h = h * end[0].signum();
            let around = |x: f64| Interval::around(x, 1e-6);
            let at = [around(end[0]), Interval::around(0.0, 1e-9), around(end[1])];
            let span = Span::new(&strand, &at);
            let mut tests = 0;
            let found = reaching(&strand, &span, 2e-6, &Pulls::all(&strand), &mut tests);
            let own = |pulls: &&Pulls| pulls.patterns.contains(&Pattern(pattern));
            let holds = |pulls: &Pulls| -> bool {
                let [own_h, own_v, w] = pulls.cell.homogeneous();
                let is =
                    |part: Interval, x: f64| (w * Interval::point(x)).intersect(part).is_some();
                is(own_h, h) && is(own_v, v)
            };
            assert!(found.iter().filter(own).any(holds), "{found:?}");
            assert!(found.iter().all(|pulls| pulls.cell.area() < 1e-3), "{found:?}");
        }
        let cell =
            Cell { face: Face::Near, at: [Interval::new(1.0, 3.0), Interval::new(0.0, 0.25)] };
        assert!((cell.area() - 0.5).abs() < 1e-15);
    }

    /// About the pull of the test before: cells of another pattern, on another face, or apart are
    /// others, though the closure is regular on both together.
    #[test]
    fn cells_of_one_pattern_that_touch_are_one() {
        let strand = strand();
        let unit =
            [[0.75, -1.5], [0.75, -0.5]].map(|[x, z]: [f64; 2]| [x, z].map(|a| a / x.hypot(z)));
        let end = [0, 1].map(|k| Interval::around(unit[0][k] + unit[1][k], 1e-6));
        let span = Span::new(&strand, &[end[0], Interval::ZERO, end[1]]);
        let pulls = |face, [lo, hi]: [f64; 2], pattern| Pulls {
            cell: Cell {
                face,
                at: [
                    Interval::new(0.75 + 1e-4 * lo, 0.75 + 1e-4 * hi),
                    Interval::around(-1.0, 1e-4),
                ],
            },
            patterns: vec![Pattern(pattern)],
        };
        let one = pulls(Face::Near, [-1.0, 0.25], 0b00);
        let joined = |other: &Pulls| both(&strand, &span, &one, other);
        let Cell { face, at } = joined(&pulls(Face::Near, [0.25, 1.0], 0b00)).unwrap();
        assert!(face == Face::Near && at[0].contains(0.75) && at[1].contains(-1.0));
        assert!(at.into_iter().all(|part| part.width() < 5e-5), "{at:?}");
        assert_eq!(joined(&pulls(Face::Near, [0.25, 1.0], 0b01)), None);
        assert_eq!(joined(&pulls(Face::Around(0), [0.25, 1.0], 0b00)), None);
        assert_eq!(joined(&pulls(Face::Near, [0.5, 1.0], 0b00)), None);
    }
}
