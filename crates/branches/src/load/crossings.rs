//! Other paths through the branch points of a path.
//!
//! In a branch point the null space of $J$ has the dimension by which the inertia changes. A path
//! through it other than the first leaves in a direction $\phi$ of that space: with $(y, t)$ there,
//!
//! $$ G(y', t') = 0, \qquad \phi \cdot (y' - y) = \delta $$
//!
//! has a solution next to $(y + \delta \phi, t)$. With one mode $\pm \phi$ are all directions; with two
//! of them all on a circle are looked at ([`circle`](super::circle)), with more the circles in the planes of each two of a basis, and there
//! may be others.

use nalgebra::DVector;

use super::bordered::Row;
use super::here::{Here, Metric, Space, correct};
use super::singular::ITERATIONS;
use super::{Equations, LoadPath, NoPath, Parent, Settings};
use crate::load::walk::{Walk, begin};

/// How far from a branch point a path is picked up, in units of the length of the path.
const AWAY: f64 = 4e-2;
/// A path comes to a branch point if it passes it by less than this part of a step: from its side the
/// place is known to the root of rounding.
const SAME: f64 = 1e-3;
/// A path does not come back to its own branch point in fewer points.
const ROUND: usize = 8;
/// Cosine of two directions that are one.
const ALIKE: f64 = 0.97;
/// Most paths together: beyond them no other is begun.
pub const MOST_PATHS: usize = 64;

/// A branch point, and the directions in which paths through it are known.
#[derive(Debug, Clone)]
pub(super) struct Crossing<S> {
    pub(super) at: Here,
    /// Where it is an event: the number of its path and of the event there.
    pub(super) of: Parent,
    /// The number of its point there.
    pub(super) point: usize,
    pub(super) modes: usize,
    pub(super) depth: usize,
    /// Conditions that are on other sides than at the start of the first path.
    pub(super) switched: Vec<S>,
    /// Unit vectors towards points of known paths.
    pub(super) known: Vec<Row>,
}

/// Follow the path from an equilibrium at $t = 0$ next to `start`, and the paths that branch from it,
/// from those, and so on to a depth: 0 for the first one alone. `watch` is told the numbers of
/// paths and of points of the last one so far.
///
/// # Errors
///
/// [`NoPath`] where no path begins.
///
/// # Panics
///
/// Never.
pub fn follow<Q: Equations>(
    equations: &mut Q,
    start: &DVector<f64>,
    settings: Settings,
    watch: &dyn Fn(usize, usize),
) -> Result<Vec<LoadPath<Q>>, NoPath<Q::Error>> {
    let (space, here) = begin(equations, start)?;
    let mut walk = Walk::new(space, settings);
    let mut all = vec![walk.path(&here, None, &|points| watch(0, points))];
    // What branches off moves where the first path stands still.
    let metric = walk.space.metric.coarse();
    walk.space.metric = metric;
    let mut next = 0;
    while let Some(crossing) = walk.crossings.get(next).cloned() {
        if crossing.depth < settings.branches && all.len() < MOST_PATHS {
            walk.set(&crossing.switched).map_err(NoPath::Numbers)?;
            for first in walk.space.starts(&crossing) {
                // Another one of them may have led back to here.
                let known = &walk.crossings[next].known;
                let direction = metric.towards(&crossing.at, &first);
                if all.len() == MOST_PATHS
                    || known.iter().any(|known| alike(metric, known, &direction))
                {
                    continue;
                }
                walk.crossings[next].known.push(direction);
                walk.set(&crossing.switched).map_err(NoPath::Numbers)?;
                walk.depth = crossing.depth + 1;
                let number = all.len();
                all.push(walk.path(&first, Some(crossing.of), &|points| watch(number, points)));
            }
        }
        next += 1;
    }
    Ok(all)
}

fn alike(metric: Metric, a: &Row, b: &Row) -> bool {
    metric.along(a).dot(&b.y, b.t) >= ALIKE
}

impl<Q: Equations> Space<'_, Q> {
    /// First points of other paths through a branch point, outward.
    fn starts(&mut self, crossing: &Crossing<Q::Side>) -> Vec<Here> {
        let mut found: Vec<(Here, Row)> = vec![];
        let basis = self.null_space(&crossing.at, crossing.modes, ITERATIONS);
        let mut all = vec![];
        if let [mode] = &basis[..] {
            all.extend(
                [1.0, -1.0].iter().filter_map(|side| self.first(&crossing.at, &(mode * *side))),
            );
        }
        for (k, one) in basis.iter().enumerate() {
            for other in &basis[..k] {
                all.extend(self.around(&crossing.at, [one, other], AWAY));
            }
        }
        for first in all {
            let way = self.metric.towards(&crossing.at, &first);
            let again = found.iter().map(|(_, known)| known).chain(&crossing.known);
            if !again.into_iter().any(|known| alike(self.metric, known, &way)) {
                found.push((first, way));
            }
        }
        found.into_iter().map(|(first, _)| first).collect()
    }

    /// A point of another path through one, in a direction.
    fn first(&mut self, at: &Here, direction: &DVector<f64>) -> Option<Here> {
        let metric = self.metric;
        let row = metric.along(&Row { y: direction.clone(), t: 0.0 });
        let known = metric.along(&metric.unit(at.tangent.y.clone(), at.tangent.t));
        let guess = &at.y + direction * AWAY;
        let found = correct(self.equations, (&guess, at.t), &row).ok()?.ok()?;
        // Straight on is the path that is known.
        let new = Row { y: &found.0 - &at.y, t: found.1 - at.t };
        if known.dot(&new.y, new.t).abs() > ALIKE * metric.norm(&new.y, new.t) {
            return None;
        }
        let here = self.here(found, [&row, &row]).ok()??;
        self.is_exact(&here).is_ok_and(|exact| exact).then_some(here)
    }
}

impl<S> Crossing<S> {
    /// Whether a path comes from here: it may have several of its own one after another, but does not turn round at once.
    fn begins(&self, (number, point): (usize, usize)) -> bool {
        self.of.path == number && point < self.point + ROUND
    }
}

/// The known branch point of several modes to which a step of this length leads; `own` as below.
pub(super) fn ahead<'a, S>(
    metric: Metric,
    crossings: &'a mut [Crossing<S>],
    (here, long): (&Here, f64),
    own: (usize, usize),
) -> Option<&'a Crossing<S>> {
    let known = crossings.iter_mut().find(|crossing| {
        crossing.modes > 1
            && !crossing.begins(own)
            && metric.apart(&crossing.at, here) <= long
            && alike(metric, &metric.towards(here, &crossing.at), &here.tangent)
    })?;
    known.known.push(metric.towards(&known.at, here));
    Some(known)
}

/// The known branch point in which a path ends, if it does; `own` are its numbers of path and point.
pub(super) fn joins<'a, S>(
    metric: Metric,
    crossings: &'a mut [Crossing<S>],
    [before, at, after]: [&Here; 3],
    own: (usize, usize),
) -> Option<&'a Crossing<S>> {
    let metric = metric.coarse();
    let near = SAME * metric.apart(before, after);
    let others = crossings.iter_mut().filter(|crossing| !crossing.begins(own));
    let others = others.map(|crossing| (metric.apart(&crossing.at, at), crossing));
    let (distance, known) = others.min_by(|a, b| a.0.total_cmp(&b.0))?;
    if distance > near {
        return None;
    }
    known.known.push(metric.towards(at, before));
    Some(known)
}
