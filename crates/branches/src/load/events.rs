//! What happens between two points of a path.

use std::cell::RefCell;

use nalgebra::DVector;

use super::here::{Here, Space};
use super::{Equations, Kind};
use crate::locate::sign_change;

/// Halvings of a step that holds several changes of the inertia.
const HALVINGS: usize = 40;
/// Changes of the inertia that are this near to each other are one event.
const TOGETHER: f64 = 1e-7;
/// Part of a step to which a point is located.
const NARROW: f64 = 1e-12;
/// The test vanishes below this part of what it is at the ends of a step.
const VANISHES: f64 = 1e-6;
/// A load acts on a mode by less than this part of both if it does not.
const OFF: f64 = 1e-3;
/// A test that has become so many times larger than at both ends of a step is at a pole.
const POLE: f64 = 4.0;

/// A point where the matrix is singular.
pub(super) struct Singular {
    pub(super) at: Here,
    pub(super) kind: Kind,
    pub(super) index: [usize; 2],
    /// Whether the parameter turns there.
    pub(super) turns: bool,
    pub(super) mode: DVector<f64>,
    pub(super) load_on_mode: f64,
}

impl<Q: Equations> Space<'_, Q> {
    /// Where a test changes its sign between two points.
    ///
    /// Each guess is between its neighbours among the points found so far: where the corrector is
    /// singular, as where paths cross, it has less and less to do.
    pub(super) fn located(
        &mut self,
        [a, b]: [&Here; 2],
        test: impl Fn(&mut Self, &Here) -> Option<f64>,
    ) -> Option<Here> {
        // Both closures borrow the equations, one after the other.
        let space = RefCell::new(self);
        let chord = a.towards(b);
        let mut known = vec![(0.0, a.clone()), (1.0, b.clone())];
        let point = |part: f64| {
            let next = known.partition_point(|(other, _)| *other < part).clamp(1, known.len() - 1);
            let [(low, from), (high, to)] = [&known[next - 1], &known[next]];
            let between = (part - low) / (high - low);
            let here = space.borrow_mut().next_to([from, to], (&chord, between))?;
            known.insert(next, (part, here.clone()));
            Some(here)
        };
        let found =
            sign_change([a, b], NARROW, point, |here: &Here| test(*space.borrow_mut(), here));
        found.map(|(_, here)| here)
    }

    /// Limit points and branch points between two points with the same active conditions, in their
    /// order; `None` when the two are on different paths.
    pub(super) fn smooth(&mut self, a: &Here, b: &Here) -> Option<Vec<Singular>> {
        let turn = (a.tangent.t * b.tangent.t < 0.0)
            .then(|| self.located([a, b], |_, here| Some(here.tangent.t)))
            .flatten();
        let mut all = vec![];
        let Some(at) = turn else {
            self.branches([a, b], &mut all)?;
            return Some(all);
        };
        let [before, after] = self.beside(&at, [a, b]);
        let at = self.settled(at, &before);
        let (mode, load_on_mode) = self.mode(&at, &before);
        let index = [before.index, after.index];
        self.branches([a, &before], &mut all)?;
        // A limit exchanges stability; on a side path of a pitchfork the parameter turns where it meets
        // the other one: both halves are alike, and the load does not act on the mode.
        // Where neither holds the load is the same all along, as what is slack moves, and its turn is rounding.
        let kind = match (index[0] == index[1], load_on_mode <= OFF) {
            (true, true) => Some(Kind::Branch),
            (true, false) => None,
            (false, _) => Some(Kind::Limit),
        };
        all.extend(kind.map(|kind| Singular { at, kind, index, turns: true, mode, load_on_mode }));
        self.branches([&after, b], &mut all)?;
        Some(all)
    }

    /// Branch points between two points: where the inertia changes; `None` when it jumps from one path
    /// to another.
    ///
    /// The test changes its sign there, but at its poles too, so that a step may have to be halved
    /// until it holds one of them alone.
    fn branches(&mut self, [a, b]: [&Here; 2], all: &mut Vec<Singular>) -> Option<()> {
        if a.index == b.index {
            return Some(());
        }
        let border = self.null_space(b, 1, 1).pop()?.normalize();
        let ends = [a, b].map(|end| (end, self.singular(end, &border).unwrap_or(f64::NAN)));
        self.within(&border, ends, HALVINGS, all)
    }

    /// The same with the tests at both points.
    fn within(
        &mut self,
        border: &DVector<f64>,
        [(a, at_a), (b, at_b)]: [(&Here, f64); 2],
        halvings: usize,
        all: &mut Vec<Singular>,
    ) -> Option<()> {
        if a.index == b.index {
            return Some(());
        }
        if at_a * at_b < 0.0
            && let Some((before, found, after)) = self.branch(border, [(a, at_a), (b, at_b)])
        {
            self.branches([a, &before], all)?;
            all.push(found);
            return self.branches([&after, b], all);
        }
        if self.metric.coarse().apart(a, b) <= TOGETHER {
            let (mode, load_on_mode) = self.mode(b, a);
            let (kind, index) = (Kind::Branch, [a.index, b.index]);
            all.push(Singular { at: b.clone(), kind, index, turns: false, mode, load_on_mode });
            return Some(());
        }
        // On two paths the ends do not come nearer to each other.
        let middle = (halvings > 0).then(|| self.between(a, b, 0.5)).flatten()?;
        let test = self.singular(&middle, border).unwrap_or(f64::NAN);
        self.within(border, [(a, at_a), (&middle, test)], halvings - 1, all)?;
        self.within(border, [(&middle, test), (b, at_b)], halvings - 1, all)
    }

    /// A branch point where the test changes its sign, with points before and after it.
    fn branch(
        &mut self,
        border: &DVector<f64>,
        [(a, at_a), (b, at_b)]: [(&Here, f64); 2],
    ) -> Option<(Here, Singular, Here)> {
        let size = at_a.abs().max(at_b.abs());
        let at = self.located([a, b], |space, here| {
            space.singular(here, border).filter(|test| test.abs() <= POLE * size)
        })?;
        // At a pole it is large, and at a gap between two paths it does not vanish.
        if self.singular(&at, border)?.abs() > VANISHES * size {
            return None;
        }
        let [before, after] = self.beside(&at, [a, b]);
        if before.index == after.index {
            return None;
        }
        let at = self.settled(at, &before);
        let (mode, load_on_mode) = self.mode(&at, &before);
        let (kind, index) = (Kind::Branch, [before.index, after.index]);
        Some((before, Singular { at, kind, index, turns: false, mode, load_on_mode }, after))
    }
}
