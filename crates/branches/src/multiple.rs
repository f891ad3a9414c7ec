//! Multiple points: degenerate equilibria in which more than two branches end at once.
//!
//! Where two curves touch, each has a fold of its own in the point they share, and the equations
//! are doubly singular: both folds are located to the square root of rounding only. If the
//! parameter has a short decimal value within what is known of it, the census is asked there. What
//! it proves to be one degenerate equilibrium is one event, at that value exactly; else the folds
//! stay as they are, with the digits that are known.

use census::{Census, CensusError, DegenerateEquilibrium};
use nalgebra::DVector;

use crate::branch::{Branch, BranchEnd};
use crate::census_point::homogeneous;
use crate::event::{Event, EventKind};
use crate::observables::Observables;
use crate::path::Path;

/// Events of the same multiple point lie within this part of the path, and so near to the angles of
/// the degenerate equilibrium, rad: the square root of that and of the rounding in it.
const SAME_POSITION: f64 = 1e-6;
const SAME_ANGLES: f64 = 1e-2;

/// An event known better than this part of the path is a simple one.
const SIMPLE: f64 = 1e-10;

/// Digits behind the point that are tried, the fewest first.
const MOST_DIGITS: usize = 12;

/// Events that may be one, by their numbers, and the value of the parameter at which that is asked.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) events: Vec<usize>,
    pub(crate) values: Vec<f64>,
    pub(crate) position: f64,
}

/// A candidate that is proved.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Multiple {
    event: Event,
    /// The folds and branch points that it is.
    joined: Vec<usize>,
    /// The bar that carries nothing in it changes its sign in it: these events have its place.
    unloaded: Vec<usize>,
}

/// Events in the plane that are next to each other, or not known well by themselves.
pub(crate) fn candidates(path: &Path<'_>, events: &[Event]) -> Vec<Candidate> {
    let in_plane: Vec<&Event> = events
        .iter()
        .filter(|event| matches!(event.kind, EventKind::Fold | EventKind::BranchPoint))
        .collect();
    let mut groups: Vec<Vec<&Event>> = vec![];
    for event in in_plane {
        let same = |other: &&Event| {
            (event.position - other.position).abs() <= SAME_POSITION
                && apart(&event.angles_rad, &other.angles_rad) <= SAME_ANGLES
        };
        match groups.iter_mut().find(|group| group.iter().any(same)) {
            Some(group) => group.push(event),
            None => groups.push(vec![event]),
        }
    }
    groups.retain(|group| group.len() > 1 || group.iter().any(|e| e.position_error > SIMPLE));
    groups.iter().filter_map(|group| candidate(path, group)).collect()
}

fn candidate(path: &Path<'_>, group: &[&Event]) -> Option<Candidate> {
    let first = group.first()?;
    let moving = path.moving(first.position)?;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for event in group {
        let [value, error] = [event.values[moving], event.values_error[moving]];
        low = low.min(value - error);
        high = high.max(value + error);
    }
    let value = shortest(low, high)?;
    let position = path.position_of(moving, value, first.position);
    let mut values = path.values_at(position);
    values[moving] = value;
    Some(Candidate { events: group.iter().map(|event| event.id).collect(), values, position })
}

/// The number with the fewest digits behind the point in a range.
fn shortest(low: f64, high: f64) -> Option<f64> {
    let middle = 0.5 * (low + high);
    (0..=MOST_DIGITS).find_map(|digits| {
        // Adding 0 takes the sign from a negative zero.
        let value = format!("{middle:.digits$}").parse::<f64>().ok()? + 0.0;
        (low..=high).contains(&value).then_some(value)
    })
}

/// Largest difference of angles.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let turn = |(a, b): (&f64, &f64)| {
        let turn = (a - b).rem_euclid(std::f64::consts::TAU);
        turn.min(std::f64::consts::TAU - turn)
    };
    a.iter().zip(b).map(turn).fold(0.0, f64::max)
}

/// The event that a candidate is, if the census proves a degenerate equilibrium there.
pub(crate) fn prove(
    path: &Path<'_>,
    events: &[Event],
    candidate: &Candidate,
    settings: &census::Settings,
) -> Result<Option<Multiple>, CensusError> {
    let Ok(problem) = path.problem(&candidate.values) else { return Ok(None) };
    let census = Census::take(&problem, settings)?;
    let Some(first) = candidate.events.first().map(|id| &events[*id]) else { return Ok(None) };
    let facing = path.facing(candidate.position);
    // On one vertical the mirror image is an equilibrium too.
    let sides = if census.circles { vec![facing, -facing] } else { vec![facing] };
    for merged in &census.degenerate {
        for side in &sides {
            let angles: Vec<f64> =
                merged.angles_rad.iter().map(|angle| side * angle.mid()).collect();
            if apart(&angles, &first.angles_rad) <= SAME_ANGLES {
                let event = event(path, candidate, first, merged, angles, *side);
                let unloaded = unloaded(events, &event, &merged.signs);
                return Ok(Some(Multiple { event, joined: candidate.events.clone(), unloaded }));
            }
        }
    }
    Ok(None)
}

/// Changes of sign, of a bar that carries nothing in an event, next to it.
fn unloaded(events: &[Event], multiple: &Event, signs: &[i8]) -> Vec<usize> {
    let here = events.iter().filter(|event| {
        let EventKind::Unloaded { bar } = event.kind else { return false };
        signs.get(bar - 1) == Some(&0)
            && (event.position - multiple.position).abs() <= SAME_POSITION
            && apart(&event.angles_rad, &multiple.angles_rad) <= SAME_ANGLES
    });
    here.map(|event| event.id).collect()
}

fn event(
    path: &Path<'_>,
    candidate: &Candidate,
    first: &Event,
    merged: &DegenerateEquilibrium,
    angles_rad: Vec<f64>,
    side: f64,
) -> Event {
    let Candidate { values, position, .. } = candidate;
    let plane = path.plane(*position);
    let pull_n = [side * merged.pull_n[0].mid(), merged.pull_n[1].mid()];
    let y = DVector::from_iterator(
        angles_rad.len() + 4,
        angles_rad.iter().copied().chain(homogeneous(&plane, pull_n)).chain([*position]),
    );
    Event {
        id: first.id,
        kind: EventKind::Multiple { multiplicity: merged.multiplicity, degree: merged.degree },
        position: *position,
        position_error: 0.0,
        values: values.clone(),
        values_error: vec![0.0; values.len()],
        span_m: plane.span_m(),
        branches: vec![],
        energy_j: merged.energy_j.mid(),
        residual: crate::equations::residual(&plane, &y).amax(),
        singular: Observables::at(&plane, &y).singular,
        angles_rad,
    }
}

/// Put one event in the place of those that it is: branches end in it, and events are numbered by
/// rising position again.
pub(crate) fn join(branches: &mut [Branch], events: Vec<Event>, proved: &[Multiple]) -> Vec<Event> {
    let mut joined: Vec<Event> = vec![];
    // By old number.
    let mut of: Vec<Option<usize>> = vec![None; events.len()];
    // By old number: the multiple point that has the place.
    let mut at: Vec<Option<usize>> = vec![None; events.len()];
    for (k, multiple) in proved.iter().enumerate() {
        let mut event = multiple.event.clone();
        for old in multiple.joined.iter().chain(&multiple.unloaded) {
            at[*old] = Some(k);
        }
        for old in &multiple.joined {
            event.branches.extend(&events[*old].branches);
            of[*old] = Some(joined.len());
        }
        event.branches.sort_unstable();
        event.branches.dedup();
        joined.push(event);
    }
    for event in events {
        if of[event.id].is_some() {
            continue;
        }
        of[event.id] = Some(joined.len());
        joined.push(match at[event.id] {
            Some(k) => {
                let Event { id, kind, branches, .. } = event;
                Event { id, kind, branches, ..proved[k].event.clone() }
            }
            None => event,
        });
    }
    let mut order: Vec<usize> = (0..joined.len()).collect();
    order.sort_by(|a, b| joined[*a].position.total_cmp(&joined[*b].position));
    let mut number = vec![0; joined.len()];
    for (new, old) in order.iter().enumerate() {
        number[*old] = new;
    }
    for branch in branches {
        settle(branch, |old| Some((number[of[old]?], at[old].map(|k| &proved[k].event))));
    }
    order.iter().enumerate().map(|(id, old)| Event { id, ..joined[*old].clone() }).collect()
}

/// Give the events of a branch their new numbers, and its points in multiple ones their places.
fn settle<'a>(branch: &mut Branch, new: impl Fn(usize) -> Option<(usize, Option<&'a Event>)>) {
    for end in [&mut branch.start, &mut branch.end] {
        if let BranchEnd::Event(id) = end
            && let Some((to, _)) = new(*id)
        {
            *id = to;
        }
    }
    for point in &mut branch.points {
        let Some((to, multiple)) = point.event.and_then(&new) else { continue };
        point.event = Some(to);
        if let Some(event) = multiple {
            point.position = event.position;
            point.values.clone_from(&event.values);
            point.span_m = event.span_m;
            point.angles_rad.clone_from(&event.angles_rad);
            point.energy_j = event.energy_j;
        }
    }
    // The place has moved by what was not known of it: no point of the curve lies beyond it.
    let ends = [branch.points.first(), branch.points.last()].map(|p| p.map(|p| p.position));
    if let [Some(low), Some(high)] = ends {
        branch.points.retain(|p| p.event.is_some() || (low..=high).contains(&p.position));
        // A bar that changes its sign there does so before the curve goes on.
        branch.points.sort_by(|a, b| a.position.total_cmp(&b.position));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_number_of_a_range() {
        for (low, high, wanted) in [
            (-2.000_000_02, -1.999_999_99, Some(-2.0)),
            (-1e-9, 2e-9, Some(0.0)),
            (0.123_449, 0.123_451, Some(0.123_45)),
            // Between two numbers of twelve digits.
            (0.123_456_789_012_4, 0.123_456_789_012_6, None),
        ] {
            assert_eq!(shortest(low, high), wanted);
        }
    }

    #[test]
    fn angles_are_compared_around_the_circle() {
        let pi = std::f64::consts::PI;
        assert!(apart(&[pi, 0.0], &[-pi, 0.1]) < 0.11);
        assert!((apart(&[0.0], &[pi]) - pi).abs() < 1e-15);
    }
}
