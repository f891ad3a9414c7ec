//! Load paths as text.

use std::fmt::Write as _;

use branches::load::MOST_PATHS;
use model::system::Name;

use super::printable::Printable;
use super::tables::{heading, heads, numbers_from, outwards, short, significant, table, wrapped};
use crate::csv::Numbers;
use crate::trace::description::shortest_span;
use crate::trace::load::{BranchesFrom, Kind, LoadEnd, LoadEvent, LoadPath, LoadPaths, LoadPoint};
use crate::trace::{Confirmed, PathProved};
use validate::Tolerances;

/// Points of a path printed one by one besides its events; of more, as many spread over the path.
const PRINTED: usize = 16;
/// Digits of a value at which something happens.
const DIGITS: usize = 9;
/// The same where several modes give way at once: known to the root of rounding.
const FEWER_DIGITS: usize = 6;
/// Joints named of a mode, those that move most.
const MODE: usize = 3;
/// Bars or joints named of a kink.
const NAMED: usize = 4;

/// All paths, as `funicular trace` prints them.
pub(super) fn text(found: &LoadPaths) -> String {
    let mut text = format!("{}\n", Printable(found.system().name()));
    for (number, path) in found.paths().iter().enumerate() {
        if found.paths().len() > 1 {
            let from = path
                .branches_from
                .map_or(String::new(), |from| format!(", from {}", branch_point(found, from)));
            let _ = writeln!(text, "\npath {}{}{from}", number + 1, fixed(found, path));
        }
        text += &one_path(found, path);
    }
    if found.paths().iter().filter(|path| path.branches_from.is_some()).count() + 1 >= MOST_PATHS {
        let _ =
            writeln!(text, "\nno more than {MOST_PATHS} paths are followed; there may be others");
    }
    text
}

/// `the branch point of path 1 at loads = 3.1`.
fn branch_point(found: &LoadPaths, BranchesFrom { path, event }: BranchesFrom) -> String {
    let at = event_at(found, &found.paths()[path].events[event]);
    format!("the branch point of path {} at {at}", path + 1)
}

fn event_at(found: &LoadPaths, event: &LoadEvent) -> String {
    let (names, units) = found.parameters();
    let last = names.len().saturating_sub(1);
    let several = event.kind == Kind::Branch && event.index[0].abs_diff(event.index[1]) > 1;
    let digits = if several { FEWER_DIGITS } else { DIGITS };
    let value = with_unit(significant(event.values[last], digits), units[last]);
    format!("{} = {value}", Printable(&names[last]))
}

/// The parameters that stay the same along a path, with their values.
fn fixed(found: &LoadPaths, path: &LoadPath) -> String {
    let (names, units) = found.parameters();
    let Some(first) = path.points.first() else { return String::new() };
    let others = 0..names.len().saturating_sub(1);
    let all = others.map(|k| valued(&names[k], first.values[k], units[k]));
    std::iter::once(String::new()).chain(all).collect::<Vec<_>>().join(", ")
}

/// `loads = 0.5`, `joints.P.force_n.z = -3 N`.
fn valued(name: &str, value: f64, unit: &str) -> String {
    format!("{} = {}", Printable(name), with_unit(significant(value, DIGITS), unit))
}

fn with_unit(number: String, unit: &str) -> String {
    if unit == "1" { number } else { format!("{number} {unit}") }
}

fn one_path(found: &LoadPaths, path: &LoadPath) -> String {
    let (names, units) = found.parameters();
    let last = names.len().saturating_sub(1);
    let mut head = vec![heading(&names[last], units[last], false)];
    head.extend(heads(found.of(), 42));
    head.extend(["falling".to_owned(), "what happens".to_owned()]);
    let mut table = table(head.iter().map(String::as_str));
    let values = |k: usize| path.points.iter().filter_map(|point| point.of[k]).collect();
    let columns = Numbers::of_columns(found.of(), values);
    for point in spread(&path.points) {
        let mut row = vec![short(point.values[last])];
        let cells = point.of.iter().zip(&columns);
        row.extend(cells.map(|(x, column)| x.map_or_else(String::new, |x| column.short(x))));
        row.push(point.index.to_string());
        row.push(point.event.map_or_else(String::new, |event| happens(&path.events[event])));
        table.add_row(row);
    }
    numbers_from(&mut table, 0);
    let said = sentences(found, path).into_iter().map(|said| wrapped(&said, 2) + "\n");
    format!("{table}\n") + &said.collect::<String>()
}

/// What is known of a path, and how well.
pub(crate) fn sentences(found: &LoadPaths, path: &LoadPath) -> Vec<String> {
    let (names, units) = found.parameters();
    let last = names.len().saturating_sub(1);
    let loss = if path.meets_proof() {
        first_loss(found, path)
    } else {
        "not confirmed: the steps of the path are too long to meet what is proved of it: take a shorter \
         range"
            .to_owned()
    };
    let proof = match path.equilibria_at_every_load {
        Some(count) => everywhere(count),
        None => proved(found, path),
    };
    let buckles = path.linear_buckling.map(|at| {
        let at = valued(&names[last], at, units[last]);
        format!("linear buckling, from the stiffness at the start, estimates {at}")
    });
    let of_limit = imperfections(found, path).into_iter().chain(buckles);
    let checks = [ends(found, path), confirmed(&path.confirmed)];
    [loss, proof].into_iter().chain(of_limit).chain(checks).collect()
}

/// All points if they are few; else events, both ends and some between them.
fn spread(points: &[LoadPoint]) -> Vec<&LoadPoint> {
    let every = points.len().div_ceil(PRINTED).max(1);
    let shown =
        |k: usize| k.is_multiple_of(every) || k + 1 == points.len() || points[k].event.is_some();
    (0..points.len()).filter(|k| shown(*k)).map(|k| &points[k]).collect()
}

fn listed(names: &[String]) -> String {
    let shown = names.iter().take(NAMED).map(|name| Printable(name).to_string());
    let text = shown.collect::<Vec<_>>().join(", ");
    match names.len().checked_sub(NAMED) {
        Some(more) if more > 0 => format!("{text} and {more} more"),
        _ => text,
    }
}

/// What an event is.
pub(crate) fn happens(event: &LoadEvent) -> String {
    let bars = |bars: &[usize]| {
        let names: Vec<String> = bars.iter().map(ToString::to_string).collect();
        format!("bar{} {}", if names.len() > 1 { "s" } else { "" }, listed(&names))
    };
    match event.kind {
        Kind::Limit => "limit point".to_owned(),
        Kind::Branch => "branch point".to_owned(),
        Kind::Kink => {
            let of_bars = [(&event.slack, "slack"), (&event.taut, "taut")];
            let of_bars = of_bars.into_iter().filter(|(all, _)| !all.is_empty());
            let joints = [(&event.lands, "on"), (&event.leaves, "off")];
            let joints = joints.into_iter().filter(|(all, _)| !all.is_empty());
            let joints =
                joints.map(|(all, where_to)| format!("{} {where_to} the floor", listed(all)));
            let all = of_bars.map(|(all, how)| format!("{} {how}", bars(all))).chain(joints);
            all.collect::<Vec<_>>().join(", ")
        }
    }
}

fn first_loss(found: &LoadPaths, path: &LoadPath) -> String {
    let starts = path.points.first().map_or(0, |point| point.index);
    if starts > 0 {
        return format!(
            "unstable from the start: the energy falls in {starts} direction{}",
            if starts > 1 { "s" } else { "" }
        );
    }
    let Some(event) = path.first_loss() else {
        return match path.end {
            LoadEnd::Open => "stable up to its end".to_owned(),
            _ => "stable from its start to its end".to_owned(),
        };
    };
    let at = event_at(found, event);
    let by = match event.kind {
        Kind::Limit => "a limit point".to_owned(),
        Kind::Branch => match event.index[1] {
            1 => "a branch point".to_owned(),
            modes => format!("a branch point with {modes} modes at once"),
        },
        Kind::Kink => happens(event),
    };
    let mode = mode(found, event);
    // The sentence about the path says so where that comes to this point.
    let of_path = |[low, high]: &[f64; 2]| {
        path.proved.between.is_some_and(|[from, to]| from <= *high && *low <= to)
    };
    let enclosed = event.enclosed.filter(|between| !of_path(between));
    let proved = enclosed.map_or_else(String::new, |[low, high]| {
        let [low, high] = outwards([low, high], DIGITS);
        format!("; it is proved to lie between {low} and {high}")
    });
    format!("first loss of stability along this path at {at}, by {by}{proved}{mode}")
}

/// What is proved of the path from its start on.
fn proved(found: &LoadPaths, path: &LoadPath) -> String {
    let (names, units) = found.parameters();
    let last = names.len().saturating_sub(1);
    let PathProved { to, first, between, because, .. } = &path.proved;
    if let (Some(first), Some([low, high])) = (first, between) {
        let [low, high] =
            outwards([*low, *high], DIGITS).map(|value| with_unit(value, units[last]));
        let name = Printable(&names[last]);
        let does = match first {
            Kind::Branch => "comes to its first branch point, where a symmetry breaks,",
            _ => "reaches its first limit point",
        };
        return format!(
            "proved: the path through the shape at its start {does} at {name} between {low} and {high}, and no other \
             equilibrium meets it before"
        );
    }
    let because = because.as_deref().unwrap_or("the range ends");
    match to {
        Some(to) => {
            let to = valued(&names[last], *to, units[last]);
            format!("proved: no other equilibrium meets the path before {to}; beyond: {because}")
        }
        None => format!("the path is not proved: {because}"),
    }
}

/// The joints that move most in a mode.
fn mode(found: &LoadPaths, event: &LoadEvent) -> String {
    let largest = |joint: &usize| event.mode[*joint].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    // Moves that differ by rounding are in the order of the joints.
    let size = |joint: &usize| (1e6 * largest(joint)).round();
    let mut joints: Vec<usize> = (0..event.mode.len()).filter(|joint| size(joint) > 1.0).collect();
    joints.sort_by(|a, b| size(b).total_cmp(&size(a)).then(a.cmp(b)));
    let moves = joints.iter().take(MODE).map(|joint| {
        let [x, y, z] =
            event.mode[*joint].map(|x| significant(if x.abs() < 1e-6 { 0.0 } else { x }, 3));
        format!("{} by ({x}, {y}, {z})", Printable(&found.system().joints()[*joint].name))
    });
    let moves: Vec<String> = moves.collect();
    if moves.is_empty() { String::new() } else { format!("; its mode moves {}", moves.join(", ")) }
}

/// That shapes do not depend on how large the loads are.
fn everywhere(count: usize) -> String {
    let plural = if count == 1 { "um" } else { "a" };
    format!(
        "proved: {count} equilibri{plural} at every load of the path, from a complete census: all members keep their \
         lengths, so that shapes do not depend on the factor, and no other path meets this one"
    )
}

/// What changes the first limit most: the bar, by its length, and the support, by its place.
fn imperfections(found: &LoadPaths, path: &LoadPath) -> Option<String> {
    let limit = path.first_loss().filter(|event| event.kind == Kind::Limit)?;
    let largest = |sizes: &[f64]| {
        let most = sizes.iter().map(|size| size.abs()).fold(0.0, f64::max);
        // The first of those that differ by rounding.
        let first = sizes.iter().position(|size| size.abs() > most * (1.0 - 1e-6))?;
        Some((first, significant(1e-3 * sizes[first], 3)))
    };
    let bar = largest(&limit.by_length)
        .map(|(bar, by)| format!("1 mm more length of bar {} changes it by {by}", bar + 1));
    let sizes: Vec<f64> = limit.by_place.iter().map(|[x, y, z]| x.hypot(*y).hypot(*z)).collect();
    let joint = largest(&sizes).map(|(joint, by)| {
        let name = Printable(&found.system().joints()[joint].name);
        format!("a shift of {name} by 1 mm changes it by up to {by}")
    });
    let all: Vec<String> = bar.into_iter().chain(joint).collect();
    (!all.is_empty()).then(|| format!("{} (the largest; --json has all)", all.join(", ")))
}

fn ends(found: &LoadPaths, path: &LoadPath) -> String {
    let points = path.points.len();
    let why = match path.end {
        LoadEnd::Range => "the path ends at an end of the range".to_owned(),
        LoadEnd::MaxPoints => "the path goes on: --max-points asks for more of it".to_owned(),
        LoadEnd::Lost => "the path is lost there: no step leads on".to_owned(),
        LoadEnd::NoLength => {
            let (bar, _) = shortest(found, path);
            format!("the path ends where the ends of bar {} meet: it has no length there", bar + 1)
        }
        LoadEnd::Jams => {
            let [a, b] = shortest(found, path).1.map(Printable);
            format!("the path ends where {a} comes to {b} along its rope, which jams there")
        }
        LoadEnd::Unbounded => {
            "the path ends there: forces grow without bound, as in a line that is pulled straight"
                .to_owned()
        }
        LoadEnd::Open => {
            "the path ends there: many shapes are in equilibrium at this value (study goes on beyond)"
                .to_owned()
        }
        LoadEnd::Joins => {
            let at = path.joins.map_or(String::new(), |at| branch_point(found, at));
            format!("the path ends in {at}")
        }
        LoadEnd::Numbers => "beyond the last one the numbers describe no system".to_owned(),
    };
    format!("{points} point{}; {why}", if points == 1 { "" } else { "s" })
}

/// The member of which two joints run together at the end of a path, and these, the one that moves first.
fn shortest<'a>(found: &'a LoadPaths, path: &LoadPath) -> (usize, [&'a Name; 2]) {
    let joints = found.system().joints();
    let [first, last] = [path.points.first(), path.points.last()]
        .map(|point| point.map_or(&[][..], |point| &point.joints_m));
    let (_, member, mut span) = shortest_span(found.system(), first, last).unwrap_or_default();
    span.sort_by_key(|joint| joints[*joint].support.is_fixed());
    (member, span.map(|joint| &joints[joint].name))
}

fn confirmed(found: &Confirmed) -> String {
    let Confirmed { points, critical, same_index, minimised, minima, singular, flat, statics } =
        *found;
    let budget = Tolerances::project().statics;
    let over_budget = format!("statics over the budget of {}", significant(budget, 1));
    let failed: Vec<&str> = [
        (critical == points, "equilibria"),
        (same_index == points, "falling directions"),
        (minima == minimised, "minima"),
        (flat == singular, "curvatures"),
        (statics <= budget, &over_budget),
    ]
    .into_iter()
    .filter_map(|(agrees, what)| (!agrees).then_some(what))
    .collect();
    let failed = match &failed[..] {
        [] => String::new(),
        _ => format!("; not confirmed: {}", failed.join(", ")),
    };
    let statics = significant(statics, 1);
    let flat = match singular {
        0 => String::new(),
        _ => format!(", no curvature at {flat} of {singular} limit and branch points"),
    };
    format!(
        "energy: an equilibrium at {critical} of {points} points, as many falling directions at {same_index}, a minimum at \
         {minima} of {minimised} stable ones{flat}; statics to {statics}{failed}. Other equilibria are not looked for"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_check_that_fails_is_named() {
        let said = |statics| {
            confirmed(&Confirmed {
                points: 3,
                critical: 3,
                same_index: 2,
                statics,
                ..Confirmed::default()
            })
        };
        let failed = "; not confirmed: falling directions, statics over the budget of 1e-11.";
        assert!(said(1e-9).contains(failed), "{}", said(1e-9));
        assert!(said(0.0).contains("not confirmed: falling directions. "), "{}", said(0.0));
    }
}
