use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use numerics::in_parallel;
use serde::Serialize;

use crate::assemble::{Assembly, Link};
use crate::branch::{Branch, BranchEnd};
use crate::census_point::{CensusPoint, PathPoint, PointStatus};
use crate::checks::{Checks, agrees, incomplete};
use crate::error::ContinuationError;
use crate::event::{Event, EventKind};
use crate::parameter::number::Number;
use crate::path::Path;
use crate::segment::Segment;
use crate::variation::Variation;

/// What can be chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContinuationSettings {
    /// Settings of the censuses.
    pub census: census::Settings,
    /// Most points of a path: everything that is found along it is held in memory, some
    /// [`BYTES`](Self::BYTES) for each equilibrium of a chain of few bars at each point. Default
    /// 100,000.
    pub max_points: usize,
}

impl ContinuationSettings {
    /// Memory that a continuation takes for each equilibrium at each point, bytes, for up to ten
    /// bars: as measured, rounded up.
    pub const BYTES: usize = 4_000;
}

impl Default for ContinuationSettings {
    fn default() -> Self {
        Self { census: census::Settings::default(), max_points: 100_000 }
    }
}

/// How far a continuation has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Censuses taken.
    pub done: usize,
    /// Censuses to take, as far as is known.
    pub total: usize,
}

/// All equilibria along a path, as branches.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Continuation {
    /// The numbers that vary, by their paths in a system file.
    pub parameters: Vec<String>,
    /// Their units.
    pub units: Vec<&'static str>,
    /// The points of the path.
    pub points: Vec<PathPoint>,
    /// Unit vectors (X, Y) of the plane's horizontal direction at the points.
    pub directions: Vec<[f64; 2]>,
    /// The branches.
    pub branches: Vec<Branch>,
    /// What happens to them, by rising position.
    pub events: Vec<Event>,
    /// What the checks say.
    pub checks: Checks,
}

/// Where between two census points or events the checks look. Not half way: a symmetric path has
/// something special there. Where the census is undecided they look at the next.
const BETWEEN: [f64; 3] = [0.436_332_3, 0.701_356_1, 0.223_606_7];

/// Between events nearer to each other than this part of the path nothing is counted: a census as
/// near to both has nothing to tell from rounding.
const NARROWEST: f64 = 1e-8;

/// Rounds of adding points where branches and census differ.
const ROUNDS: usize = 6;

/// How much nearer to a branch point of which branches are missing each round looks than the one
/// before: what branches off may end soon.
const NEARER: f64 = 0.125;

impl Continuation {
    /// Follow all equilibria along one path of a variation. `watch` is told of each census.
    ///
    /// # Errors
    ///
    /// [`ContinuationError`] when the chain is too long for a census or there is no such path. A
    /// point that is refused or undecided is no error: it says so.
    ///
    /// ```
    /// use branches::{Combine, Continuation, ContinuationSettings, EventKind, Variation};
    /// // Two bars of 1 m: two positions, which meet where the anchors are 2 m apart.
    /// let vary = ["anchors.end_m.x=1.5..2.1:7".parse()?];
    /// let bar = model::Bar::homogeneous(1.0, 1.0)?;
    /// let anchors = model::Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
    /// let chain = model::Chain::new("two", 9.81, anchors, vec![bar; 2])?;
    /// let variation = Variation::new(&chain, &vary, Combine::Product)?;
    /// let found = Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {})?;
    /// assert_eq!((found.branches.len(), found.events.len()), (2, 1));
    /// assert_eq!(found.events[0].kind, EventKind::Straight);
    /// assert!((found.events[0].values[0] - 2.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn follow(
        variation: &Variation,
        path: usize,
        settings: &ContinuationSettings,
        watch: &(dyn Fn(Progress) + Sync),
    ) -> Result<Self, ContinuationError> {
        let paths = variation.paths();
        let values =
            paths.get(path).ok_or(ContinuationError::NoPath { path, paths: paths.len() })?;
        let (points, most) = (values.len(), settings.max_points);
        if points > most {
            return Err(ContinuationError::TooManyPoints { points, most });
        }
        let path = Path::new(variation, values).ok_or(ContinuationError::NoRow)?;
        let grid: Vec<_> = (0..values.len()).map(|k| (path.position(k), Some(k))).collect();
        let mut work = Work {
            path: &path,
            settings,
            watch,
            done: AtomicUsize::new(0),
            total: AtomicUsize::new(grid.len()),
            known: BTreeMap::new(),
            between: BTreeMap::new(),
            checks: Checks::default(),
        };
        let mut census_points = work.take(&grid)?;
        let mut round = 0;
        let (mut branches, mut events) = loop {
            let segments = segments(&path, &census_points);
            let (branches, events) = work.branches(&census_points, &segments);
            work.checks.incomplete = incomplete(&branches, &events);
            let gaps = gaps(&census_points, &events);
            let mut differ = work.look_between(&census_points, &segments, &gaps, &branches)?;
            if round == ROUNDS || (differ.is_empty() && work.checks.incomplete.is_empty()) {
                break (branches, events);
            }
            differ.extend(work.look_beside(&gaps, &branches, round)?);
            round += 1;
            work.checks.added += differ.len();
            census_points.extend(differ);
            census_points.sort_by(|a, b| a.position.total_cmp(&b.position));
            census_points.dedup_by(|a, b| a.position.to_bits() == b.position.to_bits());
        };
        if census_points.iter().all(|at| matches!(at.status, PointStatus::Undecided { .. })) {
            work.checks.undecided = census_points.iter().map(|at| at.position).collect();
        }
        from_one(&mut branches, &mut events);
        let mut checks = work.checks;
        count_disagreements(&census_points, &mut checks);
        let points = census_points.iter().filter(|at| at.grid.is_some()).map(|at| PathPoint {
            position: at.position,
            values: path.values_at(at.position),
            span_m: at.span_m,
            status: at.status.clone(),
        });
        Ok(Self {
            parameters: variation.numbers().iter().map(ToString::to_string).collect(),
            units: variation.numbers().iter().map(Number::unit).collect(),
            points: points.collect(),
            directions: path.frames.direction.clone(),
            branches,
            events,
            checks,
        })
    }
}

/// Branches, events and points of the grid counted from 1, as readers count.
fn from_one(branches: &mut [Branch], events: &mut [Event]) {
    for branch in branches {
        branch.id += 1;
        for end in [&mut branch.start, &mut branch.end] {
            if let BranchEnd::Event(id) = end {
                *id += 1;
            }
        }
        for point in &mut branch.points {
            point.grid = point.grid.map(|k| k + 1);
            point.event = point.event.map(|k| k + 1);
        }
    }
    for event in events {
        event.id += 1;
        event.branches.iter_mut().for_each(|branch| *branch += 1);
    }
}

/// What is kept from round to round.
struct Work<'a> {
    path: &'a Path<'a>,
    settings: &'a ContinuationSettings,
    watch: &'a (dyn Fn(Progress) + Sync),
    done: AtomicUsize,
    total: AtomicUsize,
    /// The curves of each interval, by the bits of its ends.
    known: BTreeMap<[u64; 2], Segment>,
    /// The censuses between census points, by the bits of their positions.
    between: BTreeMap<u64, CensusPoint>,
    checks: Checks,
}

impl Work<'_> {
    fn take(&self, wanted: &[(f64, Option<usize>)]) -> Result<Vec<CensusPoint>, ContinuationError> {
        let census_points = in_parallel(wanted.len(), 1, |k| {
            let (position, grid) = wanted[k];
            let census_point = CensusPoint::at(self.path, position, grid, &self.settings.census);
            let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
            (self.watch)(Progress { done, total: self.total.load(Ordering::Relaxed) });
            census_point
        });
        Ok(census_points.into_iter().collect::<Result<_, _>>()?)
    }

    /// Follow the curves and join them.
    fn branches(
        &mut self,
        census_points: &[CensusPoint],
        segments: &[[usize; 2]],
    ) -> (Vec<Branch>, Vec<Event>) {
        let key = |pair: [usize; 2]| pair.map(|k| census_points[k].position.to_bits());
        let is_fresh = |pair: &[usize; 2]| !self.known.contains_key(&key(*pair));
        let fresh: Vec<[usize; 2]> = segments.iter().copied().filter(is_fresh).collect();
        let found = in_parallel(fresh.len(), 1, |k| {
            let [a, b] = fresh[k].map(|at| &census_points[at]);
            Segment::new(self.path, a, b)
        });
        self.known.extend(fresh.into_iter().map(key).zip(found));
        let link = |pair: &[usize; 2]| Link {
            census_points: *pair,
            curves: &self.known[&key(*pair)].curves,
        };
        let links = segments.iter().map(link);
        let Assembly { branches, events, .. } = Assembly::new(self.path, census_points, links);
        (branches, events)
    }

    /// Count again between the census points and events; the censuses that differ from the
    /// branches, or lie where not all could be followed.
    fn look_between(
        &mut self,
        census_points: &[CensusPoint],
        segments: &[[usize; 2]],
        gaps: &[[f64; 2]],
        branches: &[Branch],
    ) -> Result<Vec<CensusPoint>, ContinuationError> {
        let looks: Vec<Vec<f64>> = gaps
            .iter()
            .map(|[low, high]| BETWEEN.map(|part| low + part * (high - low)).to_vec())
            .collect();
        let looks = self.decide(&looks)?;
        self.checks.mismatches.clear();
        self.checks.undecided.clear();
        self.checks.unfollowed = segments
            .iter()
            .map(|pair| pair.map(|k| census_points[k].position))
            .filter(|ends| !self.known[&ends.map(f64::to_bits)].sure)
            .collect();
        let unsure = |position: f64| {
            self.checks.unfollowed.iter().any(|[low, high]| (*low..=*high).contains(&position))
        };
        let mut differ = vec![];
        let (mut mismatches, mut undecided) = (vec![], vec![]);
        for position in looks {
            let look = &self.between[&position.to_bits()];
            match agrees(branches, look) {
                None => undecided.push(position),
                Some(false) => mismatches.push(position),
                Some(true) if !unsure(position) => continue,
                Some(true) => {}
            }
            if look.nodes.is_some() || look.is_refused() {
                differ.push(look.clone());
            }
        }
        (self.checks.mismatches, self.checks.undecided) = (mismatches, undecided);
        Ok(differ)
    }

    /// Count on both sides of branch points that lack branches, nearer in each round; the censuses
    /// that differ.
    fn look_beside(
        &mut self,
        gaps: &[[f64; 2]],
        branches: &[Branch],
        round: usize,
    ) -> Result<Vec<CensusPoint>, ContinuationError> {
        let mut looks = vec![];
        for at in &self.checks.incomplete {
            let near = (0..=round).fold(1.0, |near, _| NEARER * near);
            for [low, high] in gaps {
                let way = near * (high - low);
                if (low - at).abs() <= NARROWEST {
                    looks.push(vec![low + way]);
                } else if (high - at).abs() <= NARROWEST {
                    looks.push(vec![high - way]);
                }
            }
        }
        let looks = self.decide(&looks)?;
        let looks = looks.iter().map(|position| &self.between[&position.to_bits()]);
        Ok(looks.filter(|look| agrees(branches, look) == Some(false)).cloned().collect())
    }

    /// Take censuses: of each list up to the first that is decided. Where that was, or the last of
    /// the list.
    fn decide(&mut self, lists: &[Vec<f64>]) -> Result<Vec<f64>, ContinuationError> {
        let mut at = vec![0; lists.len()];
        loop {
            let wanted = lists.iter().zip(&at).filter_map(|(list, at)| list.get(*at));
            let mut fresh: Vec<_> = wanted
                .filter(|position| !self.between.contains_key(&position.to_bits()))
                .map(|position| (*position, None))
                .collect();
            fresh.dedup();
            self.total.fetch_add(fresh.len(), Ordering::Relaxed);
            self.checks.between += fresh.len();
            for census_point in self.take(&fresh)? {
                self.between.insert(census_point.position.to_bits(), census_point);
            }
            let mut more = false;
            for (list, at) in lists.iter().zip(&mut at) {
                let look = &self.between[&list[*at].to_bits()];
                let open = matches!(look.status, PointStatus::Undecided { .. });
                if open && *at + 1 < list.len() {
                    *at += 1;
                    more = true;
                }
            }
            if !more {
                return Ok(lists.iter().zip(at).map(|(list, at)| list[at]).collect());
            }
        }
    }
}

/// What lies between neighbouring census points and events in the plane, if that is known to be apart.
fn gaps(census_points: &[CensusPoint], events: &[Event]) -> Vec<[f64; 2]> {
    let in_plane =
        |kind| !matches!(kind, EventKind::SpaceExchange { .. } | EventKind::Unloaded { .. });
    let events = events.iter().filter(|event| in_plane(event.kind));
    let events = events.map(|event| (event.position, event.position_error));
    let (Some(first), Some(last)) = (census_points.first(), census_points.last()) else {
        return vec![];
    };
    let mut bounds: Vec<(f64, f64)> =
        events.filter(|(at, _)| (first.position..=last.position).contains(at)).collect();
    bounds.extend(census_points.iter().map(|census_point| (census_point.position, 0.0)));
    bounds.sort_by(|a, b| a.0.total_cmp(&b.0));
    let gap = |pair: &[(f64, f64)]| {
        let [(low, before), (high, after)] = [pair[0], pair[1]];
        (high - low > NARROWEST + before + after).then_some([low, high])
    };
    bounds.windows(2).filter_map(gap).collect()
}

/// The intervals in which to follow curves: between neighbouring complete censuses, past undecided
/// ones (but not where the path has a corner there), and up to where the chain is refused.
fn segments(path: &Path<'_>, census_points: &[CensusPoint]) -> Vec<[usize; 2]> {
    let barrier = |census_point: &CensusPoint| {
        census_point.is_refused() || census_point.grid.is_some_and(|grid| path.bends(grid))
    };

    let complete: Vec<usize> =
        (0..census_points.len()).filter(|k| census_points[*k].nodes.is_some()).collect();
    let (Some(&first), Some(&last)) = (complete.first(), complete.last()) else { return vec![] };
    let mut segments = vec![];
    if first > 0 {
        segments.push([first - 1, first]);
    }
    for pair in complete.windows(2) {
        let refused: Vec<usize> =
            (pair[0] + 1..pair[1]).filter(|k| barrier(&census_points[*k])).collect();
        match (refused.first(), refused.last()) {
            (Some(from), Some(to)) => {
                segments.push([pair[0], *from]);
                segments.push([*to, pair[1]]);
            }
            _ => segments.push([pair[0], pair[1]]),
        }
    }
    if last + 1 < census_points.len() {
        segments.push([last, last + 1]);
    }
    segments
}

fn count_disagreements(census_points: &[CensusPoint], checks: &mut Checks) {
    for census_point in census_points {
        let nodes = census_point.nodes.iter().flatten();
        checks.disagreements += nodes.filter(|node| !node.agrees).count();
        if let PointStatus::Complete { alternating_sum, euler_characteristic: Some(euler), .. } =
            census_point.status
            && alternating_sum != euler
        {
            checks.euler_violations += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variation::Combine;

    /// An equilibrium that is seen otherwise, and a sum of indices that is not the Euler characteristic.
    #[test]
    fn disagreements_are_counted() {
        let vary = ["anchors.end_m.x=0.7".parse().unwrap()];
        let paper = model::cases::paper();
        let variation = Variation::new(paper.chain(), &vary, Combine::Product).unwrap();
        let paths = variation.paths();
        let path = Path::new(&variation, &paths[0]).unwrap();
        let point = CensusPoint::at(&path, 0.0, Some(0), &census::Settings::default()).unwrap();
        let counted = |change: &dyn Fn(&mut CensusPoint)| {
            let mut other = point.clone();
            change(&mut other);
            let mut checks = Checks::default();
            count_disagreements(&[point.clone(), other], &mut checks);
            (checks.disagreements, checks.euler_violations)
        };
        assert_eq!(counted(&|_| {}), (0, 0));
        let other = |point: &mut CensusPoint| point.nodes.as_mut().unwrap()[1].agrees = false;
        assert_eq!(counted(&other), (1, 0));
        let other = |point: &mut CensusPoint| {
            let PointStatus::Complete { alternating_sum, .. } = &mut point.status else { panic!() };
            *alternating_sum += 2;
        };
        assert_eq!(counted(&other), (0, 1));
    }
}
