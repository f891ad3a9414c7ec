//! Branch and bound over the places of the knot, with the pulls of each strand that reach them.

use std::collections::BTreeSet;

use numerics::Interval;

use super::balance::{Held, balanced, densities};
use super::newton::{Charts, Found, Verdict, cell, examine};
use super::pulls::{Pulls, reaching, with_density};
use super::strand::{Bridle, Span};
use crate::boxes::arithmetic::Vector;
use crate::branch_and_bound::{self, Plan, encloses, halves, widest};
use crate::net::knots::search::{GOOD, LEAST_WIDTH};
use crate::run::closure::Pattern;
use crate::run::plane::cell::Cell;
use crate::run::search::Progress;

/// More choices of pulls than this are not looked at one by one: the box is cut first.
const MOST_CHOICES: usize = 64;

/// So many choices of pulls go on by themselves where the pulls are little known.
const FEW_CHOICES: usize = 4;

/// More products of the numbers of pulls than this are not even formed.
const MOST_PRODUCTS: usize = 1 << 20;

/// More patterns of all strands together than this are not looked at one by one: those of three
/// strands of four bars.
const MOST_PATTERNS: usize = 1 << 12;

/// A cell of pulls wider than the box of places by this factor is cut first.
const WIDE: f64 = 4.0;

/// Boxes that are worked on together.
const BATCH: usize = 512;

/// A box of places, and for each strand the pulls that may reach it.
#[derive(Debug, Clone)]
pub(super) struct Task {
    pub(super) at: Vector,
    pub(super) pulls: Vec<Vec<Pulls>>,
}

pub(super) type Search = branch_and_bound::Search<Found, Task>;
type Outcome = branch_and_bound::Outcome<Found, Task>;

impl Task {
    /// The patterns of each strand that may reach the box, in order.
    pub(super) fn patterns(&self) -> Vec<Vec<Pattern>> {
        let of_strand = |list: &Vec<Pulls>| {
            let all = list.iter().flat_map(|pulls| pulls.patterns.iter().copied());
            all.collect::<BTreeSet<Pattern>>().into_iter().collect()
        };
        self.pulls.iter().map(of_strand).collect()
    }
}

/// Search all places, with at most so many tests: of a cell of pulls for a pattern, or of a box by
/// the interval Newton method.
pub(super) fn search(bridle: &Bridle, budget: u64, watch: &dyn Fn(Progress)) -> Search {
    let pulls = bridle.strands.iter().map(Pulls::all).collect();
    let roots = bridle.whole().map(|at| Task { at, pulls }).into_iter().collect();
    let plan = Plan { budget, batch: BATCH, worth_threads: 0, size: |_| 1 };
    Search::run(roots, &plan, |known, task| of_task(bridle, known, task), watch)
}

/// Narrow, exclude, prove, cut.
fn of_task(bridle: &Bridle, known: &[Found], task: &Task) -> Outcome {
    let mut outcome = Outcome::default();
    let width = widest(&task.at).1;
    let mut lists: Vec<Vec<Pulls>> = vec![];
    let mut held: Vec<Vec<Held>> = vec![];
    for (strand, pulls) in bridle.strands.iter().zip(&task.pulls) {
        let span = Span::new(strand, &task.at);
        let left = reaching(strand, &span, width, pulls, &mut outcome.tests);
        if left.is_empty() {
            return outcome;
        }
        held.push(left.iter().map(|pulls| Held::new(strand, &span, pulls)).collect());
        lists.push(left);
    }
    let products = lists.iter().map(Vec::len).fold(1, usize::saturating_mul);
    if products > MOST_PRODUCTS {
        cut(&task.at, lists, &mut outcome);
        return outcome;
    }
    let choices = balanced(bridle.load, &held);
    let mut stays: Vec<Vec<usize>> = vec![];
    if choices.len() > MOST_CHOICES {
        stays = choices;
    } else {
        for choice in choices {
            of_choice(bridle, known, &task.at, &lists, choice, &mut stays, &mut outcome);
        }
    }
    if stays.len() <= FEW_CHOICES {
        stays.retain(|stay| {
            let mut lists = chosen(&lists, std::slice::from_ref(stay));
            match narrowed(bridle, &task.at, &lists) {
                Some(cells) => {
                    for (list, cell) in lists.iter_mut().zip(cells) {
                        list[0].cell = cell;
                    }
                    !cut_pulls(&task.at, width, &lists, &mut outcome)
                }
                None => false,
            }
        });
    }
    if !stays.is_empty() {
        cut(&task.at, chosen(&lists, &stays), &mut outcome);
    }
    outcome
}

/// One pull for each strand: the interval Newton method for every choice of patterns.
fn of_choice(
    bridle: &Bridle,
    known: &[Found],
    place: &Vector,
    lists: &[Vec<Pulls>],
    choice: Vec<usize>,
    stays: &mut Vec<Vec<usize>>,
    outcome: &mut Outcome,
) {
    let Some(cells) = narrowed(bridle, place, &chosen(lists, std::slice::from_ref(&choice))) else {
        return;
    };
    let pulls: Vec<&Pulls> = lists.iter().zip(&choice).map(|(list, k)| &list[*k]).collect();
    let patterns = pulls.iter().map(|pulls| pulls.patterns.len());
    if patterns.fold(1, usize::saturating_mul) > MOST_PATTERNS {
        stays.push(choice);
        return;
    }
    let faces = pulls.iter().map(|pulls| pulls.cell.face).collect();
    let unknowns = cells
        .iter()
        .zip(&bridle.strands)
        .flat_map(|(cell, strand)| cell.at.into_iter().take(if strand.is_rod() { 1 } else { 2 }));
    let at: Vec<Interval> = place.iter().copied().chain(unknowns).collect();
    let mut charts = Charts { faces, patterns: vec![] };
    let mut stay = false;
    for patterns in combined(&pulls) {
        charts.patterns = patterns;
        if known.iter().any(|found| found.charts == charts && encloses(&found.alone_in, &at)) {
            continue;
        }
        outcome.tests += 1;
        match examine(bridle, &charts, &at) {
            Verdict::Empty => {}
            Verdict::One(found) => outcome.found.push(found),
            Verdict::Within(left) if widest(&left[..3]).1 < GOOD * widest(place).1 => {
                let pulls = (0..pulls.len()).map(|i| {
                    let patterns = vec![charts.patterns[i]];
                    vec![Pulls { cell: cell(bridle, &charts, &left, i), patterns }]
                });
                let pulls = pulls.collect();
                outcome.next.push(Task { at: [left[0], left[1], left[2]], pulls });
            }
            Verdict::Within(_) => stay = true,
        }
    }
    if stay {
        stays.push(choice);
    }
}

/// The cells of one choice of pulls, those of bars alone narrowed by the balance; nothing where
/// they cannot hold the load.
fn narrowed(bridle: &Bridle, place: &Vector, lists: &[Vec<Pulls>]) -> Option<Vec<Cell>> {
    let spans: Vec<Span> = bridle.strands.iter().map(|strand| Span::new(strand, place)).collect();
    let held: Vec<Held> =
        (0..lists.len()).map(|i| Held::new(&bridle.strands[i], &spans[i], &lists[i][0])).collect();
    let rods: Vec<usize> = (0..lists.len()).filter(|i| bridle.strands[*i].is_rod()).collect();
    let mut cells: Vec<Cell> = lists.iter().map(|list| list[0].cell).collect();
    let arms: Vec<Vector> = rods.iter().map(|i| spans[*i].arm).collect();
    let others = (0..held.len()).filter(|i| !rods.contains(i)).map(|i| &held[i]);
    let Some(densities) = densities(bridle.load, others, &arms) else { return Some(cells) };
    for (i, density) in rods.into_iter().zip(densities) {
        cells[i] = with_density(&cells[i], density)?;
    }
    Some(cells)
}

/// All choices of a pattern for each strand.
fn combined(pulls: &[&Pulls]) -> Vec<Vec<Pattern>> {
    let mut all = vec![vec![]];
    for pulls in pulls {
        all = all
            .into_iter()
            .flat_map(|before: Vec<Pattern>| {
                let more = pulls.patterns.iter();
                more.map(move |pattern| before.iter().copied().chain([*pattern]).collect())
            })
            .collect();
    }
    all
}

/// The pulls that some choice takes.
fn chosen(lists: &[Vec<Pulls>], choices: &[Vec<usize>]) -> Vec<Vec<Pulls>> {
    let kept = |(strand, list): (usize, &Vec<Pulls>)| {
        let mut taken = vec![false; list.len()];
        for choice in choices {
            taken[choice[strand]] = true;
        }
        let kept = list.iter().zip(taken).filter(|(_, taken)| *taken);
        kept.map(|(pulls, _)| pulls.clone()).collect()
    };
    lists.iter().enumerate().map(kept).collect()
}

/// Two halves of the box of places.
fn cut(at: &Vector, pulls: Vec<Vec<Pulls>>, outcome: &mut Outcome) {
    let (across, width) = widest(at);
    if width < LEAST_WIDTH {
        outcome.undecided.push(Task { at: *at, pulls });
        return;
    }
    outcome.next.extend(halves(*at, across).map(|at| Task { at, pulls: pulls.clone() }));
}

/// Two halves of a cell of pulls where one is much wider than the box of places.
fn cut_pulls(at: &Vector, width: f64, lists: &[Vec<Pulls>], outcome: &mut Outcome) -> bool {
    let cells: Vec<Interval> = lists.iter().flat_map(|list| list[0].cell.at).collect();
    let (across, widest) = widest(&cells);
    if widest <= WIDE * width {
        return false;
    }
    let (strand, across) = (across / 2, across % 2);
    for half in lists[strand][0].cell.cut(across) {
        let mut pulls = lists.to_vec();
        pulls[strand][0].cell = half;
        outcome.next.push(Task { at: *at, pulls });
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::arithmetic::points;
    use crate::net::bridle::strand::Strand;
    use crate::run::plane::face::Face;

    /// Three bars, each with 128 cells of pulls, cannot hold a load of a thousand. Of so many choices
    /// none is formed: the box is cut with all cells. With one cell each it is excluded.
    #[test]
    fn too_many_choices_are_not_formed() {
        let anchors = [[1.0, 0.0, 0.0], [-0.5, 0.75, 0.0], [-0.5, -0.75, 0.0]];
        let rod = |at: [f64; 3]| Strand {
            members: vec![0],
            joints: vec![],
            anchor: points(at),
            length: vec![Interval::new(0.5, 2.0)],
            weight: vec![Interval::ZERO],
        };
        let strands = anchors.map(rod).to_vec();
        let bridle = Bridle { knot: 0, load: points([0.0, 0.0, -1e3]), strands };
        let examined = |cells: u8| {
            let part = 2.0 / f64::from(cells);
            let pulls = (0..cells).map(|k| {
                let x = Interval::new(f64::from(k) * part - 1.0, f64::from(k + 1) * part - 1.0);
                let cell = Cell { face: Face::Near, at: [x, Interval::ZERO] };
                Pulls { cell, patterns: vec![Pattern(0)] }
            });
            let pulls = vec![pulls.collect(); 3];
            let at = [Interval::around(0.0, 0.125); 3];
            of_task(&bridle, &[], &Task { at, pulls })
        };
        let next = examined(128).next;
        let kept: Vec<usize> =
            next.iter().map(|task| task.pulls.iter().map(Vec::len).sum()).collect();
        assert_eq!(kept, [3 * 128; 2]);
        assert!(examined(1).next.is_empty());
    }

    #[test]
    fn the_smallest_boxes_are_not_cut() {
        for (part, expected) in [(1.0, [0, 2]), (0.25, [1, 0])] {
            let mut outcome = Outcome::default();
            cut(&[Interval::around(0.0, part * LEAST_WIDTH); 3], vec![], &mut outcome);
            assert_eq!([outcome.undecided.len(), outcome.next.len()], expected, "{part}");
        }
    }
}
