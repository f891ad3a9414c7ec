//! Ranges over tolerances, for people.

use std::fmt;

use census::boxes::{Range, ToleranceRanges};

use super::answer::remarks;
use super::printable::Printable;
use super::printed::display;
use super::shape::{PRINTED, percent};
use super::tables::{Table, counted, numbers_from, outwards, significant, table, wrapped};
use crate::csv::Numbers;
use crate::draws::{Distribution, Draws};
use crate::tolerances::TolerancesAnswer;

/// Digits of the ends of a range.
const SHOWN: usize = 6;
/// Digits of what is an estimate.
const DIGITS: usize = 3;
/// The least excess that is told in digits, as a part of a range.
const SMALL: f64 = 1e-3;

/// As `funicular solve --tolerances` prints it.
impl fmt::Display for TolerancesAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let system = self.answer().system();
        let numbers = counted(system.uncertain().len(), "uncertain number");
        let title = format!("{}: over the tolerances of {numbers}", Printable(system.name()));
        writeln!(f, "{}\n", wrapped(&title, 0))?;
        if self.answer().check_failed() || !self.answer().is_decided() {
            let line = format!("The equilibrium of the numbers given: {}.", remarks(self.answer()));
            writeln!(f, "{}\n", wrapped(&line, 0))?;
        }
        match self.ranges() {
            Ok(ranges) => self.proved(f, ranges)?,
            Err(reason) => {
                let line = format!("Nothing is proved for all of them: {reason}.");
                writeln!(f, "{}", wrapped(&line, 0))?;
            }
        }
        self.draws().map_or(Ok(()), |draws| writeln!(f, "\n{}", wrapped(&said(draws), 0)))
    }
}

impl TolerancesAnswer {
    fn proved(&self, f: &mut fmt::Formatter<'_>, ranges: &ToleranceRanges) -> fmt::Result {
        let stable = match self.is_stable() {
            Some(true) => "stable",
            _ => "as stable as for the numbers given",
        };
        let boxes = if ranges.boxes == 1 { "1 box" } else { &format!("{} boxes", ranges.boxes) };
        let turns = match ranges.free_turns {
            0 => "",
            1 => {
                " (but for the free turn of one part about a vertical: the ranges are those of one turn)"
            }
            _ => {
                " (but for the free turns of parts about verticals: the ranges are those of one turn of each)"
            }
        };
        let line = format!(
            "For all of them exactly one equilibrium is near{turns}, {stable}, and no cable or strut changes between \
             slack and taut (proved in {boxes})."
        );
        writeln!(f, "{}\n\n{}", wrapped(&line, 0), self.bars(ranges))?;
        writeln!(f, "\n{}", self.causes(ranges))?;
        if let Some((sag, depth_m)) = self.sag() {
            let name = |joint: usize| Printable(&self.answer().system().joints()[joint].name);
            let (unit, size_m) = display("m").unwrap_or(("m", 1.0));
            let [least, most] = outwards(depth_m.guaranteed.map(|x| x / size_m), SHOWN);
            let (joint, ends) = (name(sag.joint), sag.ends.map(name));
            let below = match sag.ends {
                [a, b] if a == b => format!("the lowest support, {}", ends[0]),
                _ => format!("the line from {} to {}", ends[0], ends[1]),
            };
            let line = format!("Sag: {least} to {most} {unit}, of joint {joint} below {below}.");
            writeln!(f, "\n{}", wrapped(&line, 0))?;
        }
        // What is held where it is known to be has the rounding of its place.
        let rounded = Numbers::of(ranges.joints_m.iter().flatten().flat_map(|at| &at.guaranteed));
        let is_open = |range: &Range| rounded.number(width(range)) > 0.0;
        let places = ranges.joints_m.iter().enumerate();
        let places = places.filter(|(_, at)| at.iter().any(is_open));
        writeln!(f, "\n{}", self.vectors("m", ["x", "y", "z"], places))?;
        let reactions = ranges.reactions_n.iter().enumerate();
        let reactions = reactions.filter_map(|(k, force)| Some((k, force.as_ref()?)));
        writeln!(f, "\n{}", self.vectors("N", ["Fx", "Fy", "Fz"], reactions))?;
        let hidden = [ranges.axial_n.len(), ranges.joints_m.len()].iter().any(|all| *all > PRINTED);
        if hidden {
            writeln!(f, "(the widest {PRINTED} of each; --json has all)")?;
        }
        let line = "hull: both ends are reached; else the range is an outer bound of it, and so much of the range may be too \
                    much. \
                    most by: the number that changes the force most, and by how much over its tolerance.";
        writeln!(f, "\n{}", wrapped(line, 0))
    }

    /// The forces of all members, or of those with the widest ranges.
    fn bars(&self, ranges: &ToleranceRanges) -> Table {
        let system = self.answer().system();
        let name = |joint: usize| Printable(&system.joints()[joint].name).to_string();
        let mut rows = table(["bar", "from", "to", "least / N", "most / N", "excess"]);
        for k in widest(&ranges.axial_n.iter().map(width).collect::<Vec<_>>()) {
            let (member, range) = (&system.members()[k], &ranges.axial_n[k]);
            let mut row = vec![(k + 1).to_string(), name(member.from), name(member.to)];
            row.extend(outwards(range.guaranteed, SHOWN));
            row.push(excess(range));
            rows.add_row(row);
        }
        numbers_from(&mut rows, 3);
        rows
    }

    /// What the forces depend on, and what they use of their strengths.
    fn causes(&self, ranges: &ToleranceRanges) -> Table {
        let strong = self.answer().system().has_strengths();
        let mut head = vec!["bar", "most by", "by / N"];
        head.extend(strong.then_some("used"));
        head.extend(self.draws().map(|_| "sd / N"));
        let mut rows = table(head);
        for k in widest(&ranges.axial_n.iter().map(width).collect::<Vec<_>>()) {
            let most_by = ranges.axial_n[k].most_by;
            let number = most_by.and_then(|(number, _)| self.number_name(number));
            let number = number.map_or_else(String::new, |name| Printable(&name).to_string());
            let by = most_by.map_or_else(String::new, |(_, by)| significant(by, DIGITS));
            let mut row = vec![(k + 1).to_string(), number, by];
            let used = || {
                let used = self.utilisation(k).map(|ends| ends.map(percent).join(" .. "));
                used.unwrap_or_default()
            };
            row.extend(strong.then(used));
            let sd = |draws: &Draws| significant(draws.axial_n[k].deviation, DIGITS);
            row.extend(self.draws().map(sd));
            rows.add_row(row);
        }
        numbers_from(&mut rows, 2);
        rows
    }

    /// Three ranges for each joint, beside each other or, where there is no room for it, below each other.
    fn vectors<'a>(
        &self,
        unit: &str,
        names: [&str; 3],
        all: impl Iterator<Item = (usize, &'a [Range; 3])>,
    ) -> Table {
        let heads = names.map(|name| [format!("{name} / {unit}"), format!("to / {unit}")]);
        let heads = heads.as_flattened().iter().map(String::as_str);
        let mut rows = table(std::iter::once("joint").chain(heads));
        let mut tall =
            table(["joint", "axis", &format!("least / {unit}"), &format!("most / {unit}")]);
        let all: Vec<_> = all.collect();
        let widths: Vec<f64> =
            all.iter().map(|(_, of)| of.iter().map(width).fold(0.0, f64::max)).collect();
        let rounded = Numbers::of(all.iter().flat_map(|(_, of)| *of).flat_map(|r| &r.guaranteed));
        for k in widest(&widths) {
            let (joint, of) = all[k];
            let name = Printable(&self.answer().system().joints()[joint].name).to_string();
            let ends = of
                .each_ref()
                .map(|range| outwards(range.guaranteed.map(|x| rounded.number(x)), SHOWN));
            for (axis, [least, most]) in names.iter().zip(ends.clone()) {
                tall.add_row([name.clone(), (*axis).to_owned(), least, most]);
            }
            rows.add_row(std::iter::once(name).chain(ends.into_iter().flatten()));
        }
        let (mut shown, first) = if rows.fits() { (rows, 1) } else { (tall, 2) };
        numbers_from(&mut shown, first);
        shown
    }
}

fn width(range: &Range) -> f64 {
    range.guaranteed[1] - range.guaranteed[0]
}

/// Of many the widest, in their order.
fn widest(widths: &[f64]) -> Vec<usize> {
    let mut all: Vec<usize> = (0..widths.len()).collect();
    all.sort_by(|a, b| widths[*b].total_cmp(&widths[*a]));
    all.truncate(PRINTED);
    all.sort_unstable();
    all
}

fn excess(range: &Range) -> String {
    let part = range.excess() / width(range);
    match part {
        _ if range.is_hull => "hull".to_owned(),
        part if part < SMALL => format!("< {}", percent(SMALL)),
        part => percent(part),
    }
}

fn said(draws: &Draws) -> String {
    let Draws { count, seed, distribution, solved, outside, .. } = draws;
    let outside = match outside {
        0 => "none of them outside of a range that is proved".to_owned(),
        outside => format!("{outside} of them OUTSIDE of what is proved"),
    };
    let within = match distribution {
        Distribution::Uniform => "uniform within the tolerances",
        Distribution::Normal => "normal, a third of the tolerance as deviation, cut off at it",
        Distribution::Ends => "at the ends of the tolerances",
    };
    let draws = counted(*count, "draw");
    format!("{draws} (seed {seed}), {within}: {solved} with an answer, {outside}.")
}
