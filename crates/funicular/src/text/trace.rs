//! A trace as text: what happens on its branches, and where.

use std::fmt::{self, Write as _};

use branches::{Continuation, Event, EventKind, PointStatus};

use super::census::plural;
use super::tables;
use crate::trace::TraceAnswer;

/// Events printed in full as a table.
const SHOWN: usize = 60;

/// What stays the same along a path, with its values; nothing if that is nothing.
fn fixed(trace: &Continuation) -> String {
    let Some(first) = trace.points.first() else { return String::new() };
    let same = |k: &usize| {
        trace.points.iter().all(|point| point.values[*k].to_bits() == first.values[*k].to_bits())
    };
    let named = (0..trace.parameters.len())
        .filter(same)
        .map(|k| format!("{} = {} {}", trace.parameters[k], first.values[k], trace.units[k]));
    named.collect::<Vec<_>>().join(", ")
}

/// As `funicular trace` prints it.
impl fmt::Display for TraceAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(found) = self.load_paths() {
            return f.write_str(&super::load::text(found));
        }
        let many = self.paths().len() > 1;
        let texts: Vec<_> = self.paths().iter().map(|one| text(one, many)).collect();
        f.write_str(&texts.join("\n"))
    }
}

/// One trace for people; with others, each says for which values it is.
fn text(trace: &Continuation, many: bool) -> String {
    let complete = |p: &&branches::PathPoint| matches!(p.status, PointStatus::Complete { .. });
    let refused = |p: &&branches::PathPoint| matches!(p.status, PointStatus::Refused { .. });
    let count = trace.points.len();
    let proved = trace.points.iter().filter(complete).count();
    let refused = trace.points.iter().filter(refused).count();
    let undecided = count - proved - refused;
    let checks = &trace.checks;
    let of = match fixed(trace) {
        fixed if many && !fixed.is_empty() => format!(" ({fixed})"),
        _ => String::new(),
    };
    let mut text = format!(
        "{}{of}: {}, {proved} with all equilibria proved, {refused} refused, {undecided} degenerate; \
         {} branches\n",
        trace.parameters.join(", "),
        tables::counted(count, "point"),
        trace.branches.len()
    );
    text += &table(trace);
    for point in trace.points.iter().filter(|p| matches!(p.status, PointStatus::Undecided { .. })) {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "degenerate at {}{}",
            values(trace, &point.values, None),
            degenerate(&point.status)
        );
    }
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{} censuses between the points and events: {}",
        checks.between,
        said(trace, proved == 0 && undecided > 0)
    );
    tables::fitted(&text)
}

/// What is known of a degenerate point.
fn degenerate(status: &PointStatus) -> String {
    let PointStatus::Undecided { straight, .. } = status else { return String::new() };
    match straight {
        0 => String::new(),
        1 => ": the chain fits into the line of its anchors".to_owned(),
        ways => format!(": the chain fits into the line of its anchors in {ways} ways"),
    }
}

/// What the checks say.
fn said(trace: &Continuation, nothing: bool) -> String {
    let checks = &trace.checks;
    if checks.agree() {
        return "each finds exactly the branches there, with the same indices".to_owned();
    }
    if nothing {
        return "nothing was decided, every point is degenerate".to_owned();
    }
    [
        (checks.mismatches.len(), "differ from the branches"),
        (checks.undecided.len(), "are undecided"),
        (checks.unfollowed.len(), "intervals could not be followed"),
        (checks.incomplete.len(), "branch points lack branches"),
        (checks.disagreements, "energies or indices differ"),
        (checks.euler_violations, "Euler characteristics do not hold"),
    ]
    .into_iter()
    .filter(|(count, _)| *count > 0)
    .map(|(count, what)| format!("{count} {what}"))
    .collect::<Vec<_>>()
    .join(", ")
}

/// The values of the parameters, with the digits that are known where errors are given.
fn values(trace: &Continuation, values: &[f64], errors: Option<&[f64]>) -> String {
    let named = trace.parameters.iter().zip(values).zip(&trace.units).enumerate();
    named
        .map(|(k, ((name, value), unit))| {
            let error = errors.and_then(|errors| errors.get(k)).copied().unwrap_or(0.0);
            format!("{name} = {} {unit}", known(*value, error))
        })
        .collect::<Vec<_>>()
        .join(", ")
}

/// The energies of all branches lie in a range of this width, J.
fn range_j(trace: &Continuation) -> f64 {
    let points = trace.branches.iter().flat_map(|branch| &branch.points);
    let ends = points.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| {
        [low.min(point.energy_j), high.max(point.energy_j)]
    });
    (ends[1] - ends[0]).max(0.0)
}

/// Decimals of an energy, at most.
const DECIMALS: usize = 9;

/// How much faster than on the whole path the energy may change in an event.
const STEEPER: f64 = 10.0;

/// The energy in an event: what is not known of the position is not known of it.
fn energy(event: &Event, range_j: f64) -> String {
    let all = format!("{:.DECIMALS$}", event.energy_j);
    let some = known(event.energy_j, STEEPER * event.position_error * range_j);
    if event.position_error > 0.0 && some.len() < all.len() { some } else { all }
}

/// A value with its known digits: the last one that is shown is off by one at most.
fn known(value: f64, error: f64) -> String {
    if error <= 0.0 {
        return value.to_string();
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let digits = (-error.log10()).floor().clamp(0.0, 17.0) as usize;
    let rounded = format!("{value:.digits$}");
    let all = value.to_string();
    if all.len() < rounded.len() { all } else { rounded }
}

fn table(trace: &Continuation) -> String {
    let mut table = tables::table(["what happens", "where", "branches", "energy / J", "residual"]);
    let shown = |kind: EventKind| !matches!(kind, EventKind::Unloaded { .. });
    let range_j = range_j(trace);
    let events: Vec<_> = trace.events.iter().filter(|event| shown(event.kind)).collect();
    for event in events.iter().take(SHOWN) {
        let what = match event.kind {
            EventKind::Fold => "fold: two branches meet and end".to_owned(),
            EventKind::Straight => "straight chain: two branches meet and end".to_owned(),
            EventKind::BranchPoint => "branch point".to_owned(),
            EventKind::SpaceExchange { from, to } => {
                format!("index in space {from} \u{2192} {to}")
            }
            EventKind::Unloaded { .. } => event.kind.name().to_owned(),
        };
        let branches: Vec<String> = event.branches.iter().map(ToString::to_string).collect();
        table.add_row([
            what,
            values(trace, &event.values, Some(&event.values_error)),
            branches.join(", "),
            energy(event, range_j),
            format!("{:.0e}", event.residual),
        ]);
    }
    let unloaded = trace.events.len() - events.len();
    let mut text = if events.is_empty() {
        "no folds, branch points or exchanges of stability\n".to_owned()
    } else {
        format!("{table}\n")
    };
    if events.len() > SHOWN {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "... and {} more (--json has them all)", events.len() - SHOWN);
    }
    if unloaded > 0 {
        let _ = writeln!(
            text,
            "{unloaded} {} a bar changes between tension and compression (--json has them)",
            plural(unloaded, "time", "times")
        );
    }
    text
}
