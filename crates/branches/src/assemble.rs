//! From curves between census points to branches and events.

use nalgebra::DVector;

use crate::arc::{Arc, ArcPoint, Arcs, left};
use crate::branch::{Branch, BranchEnd, BranchPoint};
use crate::census_point::{CensusPoint, Node};
use crate::curve::CurveEnd;
use crate::equations::fold_error;
use crate::event::{Event, EventKind};
use crate::observables::Observables;
use crate::path::Path;
use crate::segment::distance;

/// The arcs between two census points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link<'a> {
    /// Numbers of the census points.
    pub(crate) census_points: [usize; 2],
    pub(crate) curves: &'a [Arcs],
}

/// A pull this near to infinite (its homogeneous weight) is not shown: it is a straight chain.
const INFINITE: f64 = 1e-7;

/// One branch point is found twice: by the change of the index, and by the turn of a curve that is
/// its own mirror image there, which is located to the square root of rounding only.
const SAME_POSITION: f64 = 1e-6;
const SAME_SHAPE: f64 = 1e-2;

/// How far events other than folds may be off, as part of the path: where closed forms are known
/// they are nearer.
const LOCATED: f64 = 1e-10;

pub(crate) struct Assembly<'a> {
    path: &'a Path<'a>,
    census_points: &'a [CensusPoint],
    pub(crate) branches: Vec<Branch>,
    pub(crate) events: Vec<Event>,
    /// The branch of each node of each census point.
    open: Vec<Vec<Option<usize>>>,
    /// Where each event was seen.
    places: Vec<DVector<f64>>,
}

impl<'a> Assembly<'a> {
    pub(crate) fn new(
        path: &'a Path<'a>,
        census_points: &'a [CensusPoint],
        links: impl Iterator<Item = Link<'a>>,
    ) -> Self {
        let count = |census_point: &CensusPoint| census_point.nodes.as_ref().map_or(0, Vec::len);
        let mut assembly = Self {
            path,
            census_points,
            branches: vec![],
            events: vec![],
            open: census_points.iter().map(|at| vec![None; count(at)]).collect(),
            places: vec![],
        };
        for link in links {
            assembly.begin(link.census_points[0]);
            for curve in link.curves {
                let turns = assembly.turns(&curve.parts, &curve.turns);
                for arc in &curve.parts {
                    assembly.add(&link, arc, &turns);
                }
            }
        }
        for census_point in 0..census_points.len() {
            assembly.begin(census_point);
        }
        assembly.vertical_exchanges();
        assembly.unite();
        assembly.beside_folds();
        assembly
    }

    /// An event within the error of a fold's position is known no better than the fold.
    fn beside_folds(&mut self) {
        let folds = self.events.iter().filter(|event| event.kind == EventKind::Fold);
        let folds: Vec<_> = folds
            .map(|fold| (fold.position, fold.position_error, fold.values_error.clone()))
            .collect();
        for event in self.events.iter_mut().filter(|event| event.kind != EventKind::Fold) {
            for (position, error, values) in &folds {
                let beside = (event.position - position).abs() <= *error;
                if beside && *error > event.position_error {
                    event.position_error = *error;
                    event.values_error.clone_from(values);
                }
            }
        }
    }

    /// Nodes that nothing leads to begin their branches here.
    fn begin(&mut self, census_point: usize) {
        let Some(nodes) = &self.census_points[census_point].nodes else { return };
        for (k, node) in nodes.iter().enumerate() {
            if self.open[census_point][k].is_none() {
                let id = self.branches.len();
                let start = if census_point == 0 { BranchEnd::Path } else { BranchEnd::Border };
                let points = vec![self.node_point(census_point, node)];
                self.branches.push(Branch { id, points, start, end: BranchEnd::Path });
                self.open[census_point][k] = Some(id);
            }
        }
    }

    /// The events of the turns of a curve.
    fn turns(&mut self, arcs: &[Arc], kinds: &[EventKind]) -> Vec<usize> {
        let mut ids = vec![];
        for (k, kind) in kinds.iter().enumerate() {
            let place = arcs.iter().find_map(|arc| {
                let at = arc.ends.iter().position(|end| *end == CurveEnd::Turn(k))?;
                if at == 0 { arc.points.first() } else { arc.points.last() }
            });
            if let Some(place) = place {
                ids.push(self.event(*kind, &place.y, &place.seen));
            }
        }
        ids
    }

    fn event(&mut self, kind: EventKind, y: &DVector<f64>, seen: &Observables) -> usize {
        let id = self.events.len();
        let n = y.len() - 4;
        let position = y[n + 3];
        let position_error = match kind {
            EventKind::Fold => fold_error(self.path, y),
            _ => LOCATED,
        };
        let values = self.path.values_at(position);
        // A parameter that stays the same is known.
        let ahead = self.path.values_at(position + position_error);
        let values_error = values.iter().zip(&ahead).map(|(a, b)| (a - b).abs()).collect();
        self.events.push(Event {
            id,
            kind,
            position,
            position_error,
            values,
            values_error,
            span_m: self.path.plane(position).span_m(),
            branches: vec![],
            angles_rad: y.iter().take(n).map(|angle| wrap(*angle)).collect(),
            energy_j: seen.energy_j,
            residual: left(self.path, y),
            singular: seen.singular,
        });
        self.places.push(y.clone());
        id
    }

    /// Put an arc at the end of its branch, or begin one with it.
    fn add(&mut self, link: &Link<'_>, arc: &Arc, turns: &[usize]) {
        let [low, high] = link.census_points;
        let branch = match arc.ends[0] {
            CurveEnd::Low(node) => self.open[low][node],
            _ => None,
        };
        let branch = branch.unwrap_or_else(|| {
            let id = self.branches.len();
            let start = self.end(arc.ends[0], turns, id);
            self.branches.push(Branch { id, points: vec![], start, end: BranchEnd::Path });
            id
        });
        let last = arc.points.len() - 1;
        for (k, point) in arc.points.iter().enumerate() {
            let end = match k {
                0 => Some(arc.ends[0]),
                _ if k == last => Some(arc.ends[1]),
                _ => None,
            };
            let mut event = None;
            match end {
                // The node is there already.
                Some(CurveEnd::Low(_)) => continue,
                Some(CurveEnd::High(node)) => {
                    if let Some(nodes) = &self.census_points[high].nodes {
                        let shown = self.node_point(high, &nodes[node]);
                        self.branches[branch].points.push(shown);
                    }
                    continue;
                }
                Some(CurveEnd::Turn(k)) => event = turns.get(k).copied(),
                _ => {}
            }
            if let Some(kind) = point.happens {
                let id = self.event(kind, &point.y, &point.seen);
                self.events[id].branches.push(branch);
                event = Some(id);
            }
            let shown = self.curve_point(point, event);
            self.branches[branch].points.push(shown);
        }
        match arc.ends[1] {
            CurveEnd::High(node) => self.open[high][node] = Some(branch),
            end => self.branches[branch].end = self.end(end, turns, branch),
        }
    }

    fn end(&mut self, end: CurveEnd, turns: &[usize], branch: usize) -> BranchEnd {
        match end {
            CurveEnd::Turn(k) => match turns.get(k) {
                Some(event) => {
                    self.events[*event].branches.push(branch);
                    BranchEnd::Event(*event)
                }
                None => BranchEnd::Lost,
            },
            CurveEnd::Border => BranchEnd::Border,
            // A node without a branch is one that could not be reached.
            CurveEnd::Low(_) | CurveEnd::High(_) | CurveEnd::Lost => BranchEnd::Lost,
        }
    }

    fn node_point(&self, census_point: usize, node: &Node) -> BranchPoint {
        let census_point = &self.census_points[census_point];
        BranchPoint { grid: census_point.grid, proved: true, ..self.shown(&node.y, &node.seen) }
    }

    fn curve_point(&self, point: &ArcPoint, event: Option<usize>) -> BranchPoint {
        BranchPoint { event, ..self.shown(&point.y, &point.seen) }
    }

    fn shown(&self, y: &DVector<f64>, seen: &Observables) -> BranchPoint {
        let n = y.len() - 4;
        let position = y[n + 3];
        let finite = y[n + 2].abs() > INFINITE;
        BranchPoint {
            position,
            values: self.path.values_at(position),
            span_m: self.path.plane(position).span_m(),
            grid: None,
            proved: false,
            event: None,
            pull_n: finite.then_some(seen.pull_n),
            angles_rad: y.iter().take(n).map(|angle| wrap(*angle)).collect(),
            energy_j: seen.energy_j,
            axial_n: if finite { seen.axial_n.clone() } else { vec![] },
            index_in_plane: seen.index_in_plane,
            index_in_space: seen.index_in_space(),
        }
    }

    /// Where the anchors pass one vertical exactly at a census point, the index in space on both
    /// sides is compared across it.
    fn vertical_exchanges(&mut self) {
        if self.path.frames.always_vertical {
            return;
        }
        for census_point in self.census_points.iter().filter(|census_point| census_point.vertical) {
            for branch in 0..self.branches.len() {
                let points = &self.branches[branch].points;
                let at = points.iter().position(|point| {
                    point.proved && (point.position - census_point.position).abs() <= 0.0
                });
                let Some(at) = at.filter(|at| *at > 0 && at + 1 < points.len()) else { continue };
                let [before, after] = [&points[at - 1], &points[at + 1]];
                let out = |p: &BranchPoint| p.index_in_space - p.index_in_plane;
                if out(before) == out(after) {
                    continue;
                }
                let kind = EventKind::SpaceExchange {
                    from: before.index_in_space,
                    to: after.index_in_space,
                };
                let node = census_point.nodes.iter().flatten().find(|node| {
                    let angles = node.y.iter().zip(&points[at].angles_rad);
                    angles.fold(0.0_f64, |a, (x, y)| a.max(wrap(x - y).abs())) <= 0.0
                });
                if let Some(node) = node {
                    let id = self.event(kind, &node.y, &node.seen);
                    self.events[id].branches.push(branch);
                    self.branches[branch].points[at].event = Some(id);
                }
            }
        }
    }

    /// One event for each branch point, however many curves meet there; numbers by rising position.
    fn unite(&mut self) {
        let count = self.events.len();
        let mut same: Vec<usize> = (0..count).collect();
        let passing = |event: &Event| event.branches.len() == 1;
        for (k, same) in same.iter_mut().enumerate() {
            if self.events[k].kind != EventKind::BranchPoint {
                continue;
            }
            // Curves that turn in it join one that passes; so does one that passes after the first.
            let others = if passing(&self.events[k]) { 0..k } else { 0..count };
            let first = others.into_iter().find(|other| {
                let event = &self.events[*other];
                event.kind == EventKind::BranchPoint
                    && passing(event)
                    && event.branches != self.events[k].branches
                    && (event.position - self.events[k].position).abs() <= SAME_POSITION
                    && distance(&self.places[*other], &self.places[k]) <= SAME_SHAPE
            });
            if let Some(first) = first {
                *same = first;
            }
        }
        for (k, &same) in same.iter().enumerate() {
            if same != k {
                let joined = std::mem::take(&mut self.events[k].branches);
                self.events[same].branches.extend(joined);
            }
        }
        let mut order: Vec<usize> = (0..count).filter(|k| same[*k] == *k).collect();
        order.sort_by(|a, b| self.events[*a].position.total_cmp(&self.events[*b].position));
        let mut number = vec![0; count];
        for (new, old) in order.iter().enumerate() {
            number[*old] = new;
        }
        let new = |old: usize| number[same[old]];
        let mut events: Vec<Event> = order.iter().map(|old| self.events[*old].clone()).collect();
        for (k, event) in events.iter_mut().enumerate() {
            event.id = k;
            event.branches.sort_unstable();
            event.branches.dedup();
        }
        self.events = events;
        for branch in &mut self.branches {
            for end in [&mut branch.start, &mut branch.end] {
                if let BranchEnd::Event(event) = end {
                    *event = new(*event);
                }
            }
            for event in branch.points.iter_mut().filter_map(|point| point.event.as_mut()) {
                *event = new(*event);
            }
        }
    }
}

/// An angle in (−π, π].
fn wrap(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if angle > -PI && angle <= PI {
        return angle;
    }
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    #[test]
    fn angles_are_shown_between_half_a_turn_either_way() {
        for (angle, wanted) in
            [(PI, PI), (-PI, PI), (4.0, 4.0 - TAU), (-4.0, TAU - 4.0), (7.0, 7.0 - TAU), (0.5, 0.5)]
        {
            assert!((super::wrap(angle) - wanted).abs() < 1e-15, "{angle}");
        }
    }
}
