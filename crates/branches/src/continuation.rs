//! The trace of a path.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::Serialize;

use super::assemble::{Assembly, Link};
use super::branch::Branch;
use super::check::{Checks, agrees, incomplete};
use super::course::Course;
use super::error::TraceError;
use super::event::{Event, EventKind};
use super::segment::Segment;
use super::station::{PointStatus, Station, TracePoint};
use crate::product::Study;

/// What can be chosen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TraceSettings {
    /// Settings of the censuses.
    pub census: census::Settings,
}

/// How far a trace has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TraceProgress {
    /// Censuses taken.
    pub done: usize,
    /// Censuses to take, as far as is known.
    pub total: usize,
}

/// All equilibria along a path, as branches.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trace {
    /// The numbers that vary, by their paths in a system file.
    pub parameters: Vec<String>,
    /// Their units.
    pub units: Vec<&'static str>,
    /// The points of the path.
    pub points: Vec<TracePoint>,
    /// Unit vectors (X, Y) of the plane's horizontal direction at the points.
    pub directions: Vec<[f64; 2]>,
    /// The branches.
    pub branches: Vec<Branch>,
    /// What happens to them, by rising position.
    pub events: Vec<Event>,
    /// What the checks say.
    pub checks: Checks,
}

/// Where between two stations or events the checks look. Not half way: a symmetric path has something
/// special there. Where the census is undecided they look at the next.
const BETWEEN: [f64; 3] = [0.436_332_3, 0.701_356_1, 0.223_606_7];

/// Between events nearer to each other than this part of the path nothing is counted: a census as near
/// to both has nothing to tell from rounding.
const NARROWEST: f64 = 1e-8;

/// Rounds of adding points where branches and census differ.
const ROUNDS: usize = 6;

/// How much nearer to a branch point of which branches are missing each round looks than the one before:
/// what branches off may end soon.
const NEARER: f64 = 0.125;

/// Follow all equilibria along one path of a study. `watch` is told of each census.
///
/// # Errors
///
/// [`TraceError`] when the chain is too long for a census or there is no such path. A point that is
/// refused or undecided is no error: it says so.
///
/// ```
/// use sweep::{Combine, EventKind, Study, TraceSettings, trace};
/// // Two bars of 1 m: two positions, which meet where the anchors are 2 m apart.
/// let vary = ["anchors.end_m.x=1.5..2.1:7".parse()?];
/// let chain = model::system_file::parse_system(
///     "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
///      bars = [{ length_m = 1, mass_kg = 1, count = 2 }]", "two.toml")?;
/// let trace = trace(&Study::new(chain, &vary, Combine::Product)?, 0, &TraceSettings::default(), &|_| {})?;
/// assert_eq!((trace.branches.len(), trace.events.len()), (2, 1));
/// assert_eq!(trace.events[0].kind, EventKind::Straight);
/// assert!((trace.events[0].values[0] - 2.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn trace(
    study: &Study,
    path: usize,
    settings: &TraceSettings,
    watch: &(dyn Fn(TraceProgress) + Sync),
) -> Result<Trace, TraceError> {
    let paths = study.paths();
    let values = paths.get(path).ok_or(TraceError::NoPath { path, paths: paths.len() })?;
    let course = Course::new(study, values);
    let grid: Vec<_> = (0..values.len()).map(|k| (course.position(k), Some(k))).collect();
    let mut work = Work {
        course: &course,
        settings,
        watch,
        done: AtomicUsize::new(0),
        total: AtomicUsize::new(grid.len()),
        known: BTreeMap::new(),
        between: BTreeMap::new(),
        checks: Checks::default(),
    };
    let mut stations = work.take(&grid)?;
    let mut round = 0;
    let (branches, events) = loop {
        let segments = segments(&course, &stations);
        let (branches, events) = work.branches(&stations, &segments);
        work.checks.incomplete = incomplete(&branches, &events);
        let gaps = gaps(&stations, &events);
        let mut differ = work.look_between(&stations, &segments, &gaps, &branches)?;
        if round == ROUNDS || (differ.is_empty() && work.checks.incomplete.is_empty()) {
            break (branches, events);
        }
        differ.extend(work.look_beside(&gaps, &branches, round)?);
        round += 1;
        work.checks.added += differ.len();
        stations.extend(differ);
        stations.sort_by(|a, b| a.position.total_cmp(&b.position));
        stations.dedup_by(|a, b| a.position.to_bits() == b.position.to_bits());
    };
    if stations.iter().all(|station| matches!(station.status, PointStatus::Undecided { .. })) {
        work.checks.undecided = stations.iter().map(|station| station.position).collect();
    }
    let mut checks = work.checks;
    count_disagreements(&stations, &mut checks);
    let points =
        stations.iter().filter(|station| station.grid.is_some()).map(|station| TracePoint {
            position: station.position,
            values: course.values_at(station.position),
            span_m: station.span_m,
            status: station.status.clone(),
        });
    Ok(Trace {
        parameters: study.numbers().iter().map(ToString::to_string).collect(),
        units: study.numbers().iter().map(|number| number.unit()).collect(),
        points: points.collect(),
        directions: course.frames.direction.clone(),
        branches,
        events,
        checks,
    })
}

/// What is kept from round to round.
struct Work<'a> {
    course: &'a Course<'a>,
    settings: &'a TraceSettings,
    watch: &'a (dyn Fn(TraceProgress) + Sync),
    done: AtomicUsize,
    total: AtomicUsize,
    /// The curves of each interval, by the bits of its ends.
    known: BTreeMap<[u64; 2], Segment>,
    /// The censuses between stations, by the bits of their positions.
    between: BTreeMap<u64, Station>,
    checks: Checks,
}

impl Work<'_> {
    /// Take censuses.
    fn take(&self, wanted: &[(f64, Option<usize>)]) -> Result<Vec<Station>, TraceError> {
        let station = |(position, grid): &(f64, Option<usize>)| {
            let station = Station::at(self.course, *position, *grid, &self.settings.census);
            let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
            (self.watch)(TraceProgress { done, total: self.total.load(Ordering::Relaxed) });
            station
        };
        let stations: Vec<_> = wanted.par_iter().map(station).collect();
        Ok(stations.into_iter().collect::<Result<_, _>>()?)
    }

    /// Follow the curves and join them.
    fn branches(
        &mut self,
        stations: &[Station],
        segments: &[[usize; 2]],
    ) -> (Vec<Branch>, Vec<Event>) {
        let key = |pair: [usize; 2]| pair.map(|k| stations[k].position.to_bits());
        let is_fresh = |pair: &[usize; 2]| !self.known.contains_key(&key(*pair));
        let fresh: Vec<[usize; 2]> = segments.iter().copied().filter(is_fresh).collect();
        let found: Vec<Segment> = fresh
            .par_iter()
            .map(|[a, b]| Segment::new(self.course, &stations[*a], &stations[*b]))
            .collect();
        self.known.extend(fresh.into_iter().map(key).zip(found));
        let link = |pair: &[usize; 2]| Link {
            stations: *pair,
            curves: self.known[&key(*pair)].curves.clone(),
        };
        let links: Vec<Link> = segments.iter().map(link).collect();
        let Assembly { branches, events, .. } = Assembly::new(self.course, stations, &links);
        (branches, events)
    }

    /// Count again between the stations and events; the censuses that differ from the branches, or lie
    /// where not all could be followed.
    fn look_between(
        &mut self,
        stations: &[Station],
        segments: &[[usize; 2]],
        gaps: &[[f64; 2]],
        branches: &[Branch],
    ) -> Result<Vec<Station>, TraceError> {
        let looks: Vec<Vec<f64>> = gaps
            .iter()
            .map(|[low, high]| BETWEEN.map(|part| low + part * (high - low)).to_vec())
            .collect();
        let looks = self.decide(&looks)?;
        self.checks.mismatches.clear();
        self.checks.undecided.clear();
        self.checks.unfollowed = segments
            .iter()
            .map(|pair| pair.map(|k| stations[k].position))
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

    /// Count on both sides of branch points that lack branches, nearer in each round; the censuses that
    /// differ.
    fn look_beside(
        &mut self,
        gaps: &[[f64; 2]],
        branches: &[Branch],
        round: usize,
    ) -> Result<Vec<Station>, TraceError> {
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

    /// Take censuses: of each list up to the first that is decided. Where that was, or the last of the list.
    fn decide(&mut self, lists: &[Vec<f64>]) -> Result<Vec<f64>, TraceError> {
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
            for station in self.take(&fresh)? {
                self.between.insert(station.position.to_bits(), station);
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

/// What lies between neighbouring stations and events in the plane.
fn gaps(stations: &[Station], events: &[Event]) -> Vec<[f64; 2]> {
    let in_plane =
        |kind| matches!(kind, EventKind::Fold | EventKind::Straight | EventKind::BranchPoint);
    let events = events.iter().filter(|event| in_plane(event.kind)).map(|event| event.position);
    let (Some(first), Some(last)) = (stations.first(), stations.last()) else { return vec![] };
    let mut bounds: Vec<f64> =
        events.filter(|at| (first.position..=last.position).contains(at)).collect();
    bounds.extend(stations.iter().map(|station| station.position));
    bounds.sort_by(f64::total_cmp);
    let gaps = bounds.windows(2).map(|pair| [pair[0], pair[1]]);
    gaps.filter(|[low, high]| high - low > NARROWEST).collect()
}

/// The intervals in which to follow curves: between neighbouring complete censuses, past undecided ones
/// (but not where the path has a corner there), and up to where the chain is refused.
fn segments(course: &Course<'_>, stations: &[Station]) -> Vec<[usize; 2]> {
    let barrier = |station: &Station| {
        station.is_refused() || station.grid.is_some_and(|grid| course.bends(grid))
    };

    let complete: Vec<usize> =
        (0..stations.len()).filter(|k| stations[*k].nodes.is_some()).collect();
    let (Some(&first), Some(&last)) = (complete.first(), complete.last()) else { return vec![] };
    let mut segments = vec![];
    if first > 0 {
        segments.push([first - 1, first]);
    }
    for pair in complete.windows(2) {
        let refused: Vec<usize> =
            (pair[0] + 1..pair[1]).filter(|k| barrier(&stations[*k])).collect();
        match (refused.first(), refused.last()) {
            (Some(from), Some(to)) => {
                segments.push([pair[0], *from]);
                segments.push([*to, pair[1]]);
            }
            _ => segments.push([pair[0], pair[1]]),
        }
    }
    if last + 1 < stations.len() {
        segments.push([last, last + 1]);
    }
    segments
}

fn count_disagreements(stations: &[Station], checks: &mut Checks) {
    for station in stations {
        let nodes = station.nodes.iter().flatten();
        checks.disagreements += nodes.filter(|node| !node.agrees).count();
        if let PointStatus::Complete { alternating_sum, euler_characteristic: Some(euler), .. } =
            station.status
            && alternating_sum != euler
        {
            checks.euler_violations += 1;
        }
    }
}
