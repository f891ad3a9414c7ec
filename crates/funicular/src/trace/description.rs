//! Paths that are followed, as load paths: what is shown, what happens, what is proved and confirmed.

use branches::Variation;
use branches::load::{End, Event, Kind, LoadPath as FollowedPath, Point};
use lagrange::net::Side;
use model::Vector;
use model::system::{System, SystemEquilibrium};
use numerics::vector::{minus, norm};
use rayon::prelude::*;

use super::confirm::confirm;
use super::enclosed::{PathProved, enclosed, proved};
use super::equations::{Family, Kept};
use super::load::{LoadEnd, LoadError, LoadEvent, LoadPath, LoadPoint};
use crate::observable::Observable;

/// Most joints and bars together of a system of which all limit and branch points are proved, each in some
/// tenths of a second; of a larger one the first loss of stability alone.
const PROVED_ALL: usize = 300;

/// The coordinate that moves most along the paths, as `joints.NAME.z`, of joints that no support holds; where nothing
/// moves a force.
pub(super) fn most_moved<'a: 'b, 'b>(
    system: &System,
    paths: impl Iterator<Item = &'b FollowedPath<Family<'a>>>,
) -> Option<String> {
    let mut most = (0.0, None);
    for path in paths {
        let first = &path.points.first()?.record.equilibrium.joints_m;
        for point in &path.points {
            let joints = point.record.equilibrium.joints_m.iter().zip(first).enumerate();
            let moves = |joint: usize| !system.joints()[joint].support.is_fixed();
            for (joint, (at_m, from_m)) in joints.filter(|(joint, _)| moves(*joint)) {
                for axis in 0..3 {
                    let moved = (at_m[axis] - from_m[axis]).abs();
                    // What is equal to rounding is the first of them, upright if that is one.
                    if moved > most.0 * (1.0 + 1e-9) {
                        most = (moved, Some((joint, axis)));
                    }
                }
            }
        }
    }
    let Some((joint, axis)) = most.1 else {
        return (!system.members().is_empty()).then(|| "bars.1.axial_n".to_owned());
    };
    let name = system.joints()[joint].name.text();
    let quoted = name.contains(['.', '[', ']', '"']);
    let name = if quoted { format!("\"{name}\"") } else { name.into_owned() };
    Some(format!("joints.{name}.{}", ["x", "y", "z"][axis]))
}

/// A span that is shorter than this, in units of what it was where the path began, is at its end.
const NO_SPAN: f64 = 1e-3;

/// The span that has become shortest between two shapes, in units of what it was, its member and its joints.
pub(crate) fn shortest_span(
    system: &System,
    from_m: &[Vector],
    to_m: &[Vector],
) -> Option<(f64, usize, [usize; 2])> {
    let members = system.members().iter().enumerate();
    let parts = members.flat_map(|(k, member)| member.spans().map(move |[a, b]| (k, a, b)));
    let parts = parts.map(|(k, a, b)| {
        let [before, after] = [from_m, to_m].map(|at| norm(minus(at[a], at[b])));
        (after / before, k, [a, b])
    });
    parts.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// How a path is lost where the ends of a span run together, if it is. Of its points there only the first is kept: the others come
/// ever nearer, and their spans have directions to fewer digits than balance is judged by.
fn no_span(system: &System, path: &mut FollowedPath<Family<'_>>) -> Option<LoadEnd> {
    if !matches!(path.end, End::Lost | End::MaxPoints | End::Numbers(_)) {
        return None;
    }
    let (first, last) = (path.points.first()?, path.points.last()?);
    let [from_m, to_m] = [first, last].map(|at| &at.record.equilibrium.joints_m);
    let (_, member, _) = shortest_span(system, from_m, to_m)?;
    let is_rope = !system.members()[member].via().is_empty();
    let is_there = |point: &&Point<Kept>| {
        let [from_m, to_m] = [first, *point].map(|at| &at.record.equilibrium.joints_m);
        shortest_span(system, from_m, to_m).is_some_and(|(part, ..)| part < NO_SPAN)
    };
    let there = path.points.iter().rev().take_while(is_there).count();
    let kept = path.points.len() + 1 - there;
    // Other paths may begin in events.
    if there > 1 && path.events.iter().all(|event| event.point < kept) {
        path.points.truncate(kept);
    }
    (there > 0).then_some(if is_rope { LoadEnd::Jams } else { LoadEnd::NoLength })
}

/// A path as it is described.
pub(super) fn described(
    family: &mut Family<'_>,
    variation: &Variation,
    of: &[Observable],
    found: &mut FollowedPath<Family<'_>>,
) -> Result<LoadPath, LoadError> {
    let system = variation.base();
    let no_span = no_span(system, found);
    let points = found.points.iter().map(|point| {
        let Kept { values, equilibrium } = &point.record;
        let shown = |one: &Observable| one.of(system, equilibrium);
        LoadPoint {
            values: values.clone(),
            index: point.index,
            event: point.event,
            energy_j: equilibrium.energy_j,
            of: of.iter().map(shown).collect(),
            joints_m: equilibrium.joints_m.clone(),
            axial_n: equilibrium.axial_n.clone(),
        }
    });
    let points = points.collect();
    let events = found.events.iter().map(|event| event_described(system, family, event));
    let mut events: Vec<LoadEvent> = events.collect();
    let open = matches!(found.end, End::Open).then(|| found.points.len() - 1);
    let at: Vec<(&[f64], &SystemEquilibrium, usize, bool)> = found
        .points
        .iter()
        .enumerate()
        .map(|(number, point)| {
            let Kept { values, equilibrium } = &point.record;
            let singular = point.event.is_some() || open == Some(number);
            (values.as_slice(), equilibrium, point.index, singular)
        })
        .collect();
    let ends = family.ends();
    let ((proved, enclosed), confirmed) = rayon::join(
        || what_is_proved(variation, ends, found, &events),
        || confirm(variation, &at, &events),
    );
    for ((event, of), enclosed) in events.iter_mut().zip(&found.events).zip(enclosed) {
        event.enclosed = enclosed;
        if event.kind == Kind::Limit {
            let record = &found.points[event.point].record;
            (event.by_length, event.by_place) = family.imperfections(record, of)?;
        }
    }
    let end = no_span.unwrap_or(match &found.end {
        End::Range => LoadEnd::Range,
        End::MaxPoints => LoadEnd::MaxPoints,
        End::Joins(_) => LoadEnd::Joins,
        End::Lost => LoadEnd::Lost,
        End::Open => LoadEnd::Open,
        End::Unbounded => LoadEnd::Unbounded,
        End::Numbers(_) => LoadEnd::Numbers,
    });
    let (branches_from, joins, linear_buckling) = (None, None, None);
    let equilibria_at_every_load = None;
    Ok(LoadPath {
        points,
        events,
        end,
        branches_from,
        joins,
        linear_buckling,
        equilibria_at_every_load,
        confirmed,
        proved,
    })
}

/// What is proved of a path, and between which values each of its events is proved to lie.
fn what_is_proved(
    variation: &Variation,
    ends: [&[f64]; 2],
    found: &FollowedPath<Family<'_>>,
    events: &[LoadEvent],
) -> (PathProved, Vec<Option<[f64; 2]>>) {
    let system = variation.base();
    let proved = proved(variation, ends, found.points.first().map(|point| &point.record));
    let small = system.joints().len() + system.members().len() <= PROVED_ALL;
    let loss = events.iter().position(LoadEvent::is_loss);
    let first = events.iter().position(|event| event.kind != Kind::Kink);
    let between = |(number, event): (usize, &LoadEvent)| match proved.between {
        // What the proof of the path says of its first point is not proved again.
        Some(between) if first == Some(number) && proved.is_of(event) => Some(between),
        _ if small || loss == Some(number) => {
            enclosed(variation, ends, &found.points[event.point].record, event.kind)
        }
        _ => None,
    };
    let enclosed = events.par_iter().enumerate().map(between).collect();
    (proved, enclosed)
}

fn event_described(system: &System, family: &Family<'_>, event: &Event<Side>) -> LoadEvent {
    let sides = |active: bool| event.sides.iter().filter(move |(_, now)| *now == active);
    let bar = |(side, _): &(Side, bool)| match side {
        Side::Member(member) => Some(member + 1),
        Side::Joint(_) => None,
    };
    let bars = |active| sides(active).filter_map(bar).collect();
    let joint = |(side, _): &(Side, bool)| match side {
        Side::Joint(joint) => Some(system.joints()[*joint].name.to_string()),
        Side::Member(_) => None,
    };
    let joints = |active| sides(active).filter_map(joint).collect();
    let places = event.mode.get(..3 * system.joints().len()).unwrap_or_default();
    LoadEvent {
        kind: event.kind,
        values: family.values(event.t),
        point: event.point,
        index: event.index,
        turns: event.turns,
        enclosed: None,
        slack: bars(false),
        taut: bars(true),
        lands: joints(true),
        leaves: joints(false),
        mode: places.chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect(),
        by_length: vec![],
        by_place: vec![],
    }
}
