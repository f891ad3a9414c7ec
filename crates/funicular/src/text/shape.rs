//! The shape of an equilibrium in tables: joints, bars, forces of the ground, and what stands out.

use std::fmt::Write as _;

use model::{AxialForce, ForceRange, Vector};
use numerics::vector::norm;

use super::printed::{numbers, quantity};
use super::tables::{Table, numbers_from, short, table, wrapped};
use crate::csv::Numbers;
use crate::extremes::Extremes;
use crate::sag::Sag;
use crate::weakest::{Unjudged, Weakest};

/// Joints and bars up to this many are printed one by one; of more the extremes (`--csv`,
/// `--bars-csv` and `--json` have all).
pub const PRINTED: usize = 40;

/// Bars at each end of the order by axial force, and forces of the ground, that stand for all of a
/// long system.
const EXTREMES: usize = 5;

/// What balance and signs leave open of a force.
fn open(range: ForceRange, rounded: Numbers) -> String {
    let number = |n: f64| rounded.short(n);
    match range {
        ForceRange::Unique => "only this".to_owned(),
        ForceRange::Free => "any".to_owned(),
        ForceRange::Bounded { least_n, most_n } => match (least_n, most_n) {
            (Some(least), Some(most)) => format!("{} to {}", number(least), number(most)),
            (Some(least), None) => format!("from {}", number(least)),
            (None, Some(most)) => format!("to {}", number(most)),
            (None, None) => "any".to_owned(),
        },
    }
}

/// An equilibrium as the tables have it.
pub struct Shape<'a> {
    /// The name of a joint, for a terminal.
    pub name: &'a dyn Fn(usize) -> String,
    /// The joints of a bar.
    pub ends: &'a dyn Fn(usize) -> [usize; 2],
    /// The joints between them that a rope runs over.
    pub via: &'a dyn Fn(usize) -> &'a [usize],
    /// Places, m.
    pub joints_m: &'a [Vector],
    /// Axial forces along the bars.
    pub axial: Vec<AxialForce>,
    /// What stands out.
    pub extremes: Option<Extremes>,
    /// Forces of the ground, N, with their joints.
    pub reactions_n: Vec<(usize, Vector)>,
    /// A word for a bar without force.
    pub idle: &'a dyn Fn(usize) -> &'static str,
    /// The part of its strength that a bar uses.
    pub used: &'a dyn Fn(usize) -> Option<f64>,
    /// The bar that is nearest to breaking.
    pub weakest: Option<Weakest>,
    /// What is open of the forces of the bars, where they are a family.
    pub ranges: Option<&'a [ForceRange]>,
    /// Who found it.
    pub solver: &'a model::SolverName,
}

impl Shape<'_> {
    /// The tables, and what stands out.
    pub fn text(&self, summary: bool) -> String {
        let long = self.joints_m.len().max(self.axial.len()) > PRINTED + 1;
        let mut text = String::new();
        if !summary && !long {
            text += &self.joints();
        }
        text += &if long {
            self.largest()
        } else {
            self.bars("Bars", &(0..self.axial.len()).collect::<Vec<_>>())
        };
        text + &self.reactions() + &self.summary()
    }

    fn joints(&self) -> String {
        let mut table = table(["joint", "x / m", "y / m", "z / m"]);
        let places = self.places();
        for (k, at_m) in self.joints_m.iter().enumerate() {
            let mut row = vec![(self.name)(k)];
            row.extend(at_m.map(|x| places.short(x)));
            table.add_row(row);
        }
        numbers_from(&mut table, 1);
        titled(&format!("Joints, by {}:", self.solver), &table)
    }

    /// Coordinates as they are shown.
    fn places(&self) -> Numbers {
        let extent = |axis: usize| {
            let all = || self.joints_m.iter().map(|at_m| at_m[axis]);
            all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        Numbers::of(self.joints_m.as_flattened()).apart((0..3).map(extent).fold(0.0, f64::max))
    }

    /// Some bars, each with its axial force and how steeply it rises from its first joint to its
    /// second.
    fn bars(&self, title: &str, bars: &[usize]) -> String {
        let table = self.bars_table(bars, true);
        let fits = table.fits();
        let table = if fits { table } else { self.bars_table(bars, false) };
        let rises = if fits { "; rises from the level" } else { "" };
        titled(&format!("{title} (axial force at both ends: tension positive{rises}):"), &table)
    }

    /// The table of some bars; how steeply they rise is left out where there is no room for it.
    fn bars_table(&self, bars: &[usize], rises: bool) -> Table {
        let mut head = vec!["bar", "from", "to", "at from / N", "at to / N", "state"];
        head.extend(self.weakest.map(|_| "used"));
        head.extend(rises.then_some("rises / deg"));
        head.extend(self.ranges.map(|_| "may be / N"));
        let mut table = table(head);
        let axial = self.rounded();
        for &bar in bars {
            let [from, to] = (self.ends)(bar);
            let along = self.axial[bar];
            let what = match axial.number(along.largest_n()) {
                n if n > 0.0 => "tension",
                n if n < 0.0 => "compression",
                _ => (self.idle)(bar),
            };
            let via = (self.via)(bar);
            let mut row = vec![
                (bar + 1).to_string(),
                (self.name)(from),
                (self.name)(to) + &self.over(via),
                axial.short(along.from_n),
                axial.short(along.to_n),
                what.to_owned(),
            ];
            row.extend(self.weakest.map(|_| (self.used)(bar).map_or_else(String::new, percent)));
            let straight = rises && via.is_empty();
            row.extend(rises.then(|| if straight { self.rise([from, to]) } else { String::new() }));
            row.extend(self.ranges.map(|ranges| open(ranges[bar], axial)));
            table.add_row(row);
        }
        numbers_from(&mut table, 3);
        if let Some(words) = table.column_mut(5) {
            words.set_cell_alignment(comfy_table::CellAlignment::Left);
        }
        table
    }

    /// The joints that a rope runs over, in words: the first few by their names.
    fn over(&self, via: &[usize]) -> String {
        const NAMED: usize = 2;
        let names: Vec<String> = via.iter().take(NAMED).map(|joint| (self.name)(*joint)).collect();
        match via.len().saturating_sub(NAMED) {
            _ if via.is_empty() => String::new(),
            0 => format!(" over {}", names.join(", ")),
            more => format!(" over {} and {more} more", names.join(", ")),
        }
    }

    /// The angle of a bar above the level, degrees, to a hundredth.
    fn rise(&self, [from, to]: [usize; 2]) -> String {
        let (a, b) = (self.joints_m[from], self.joints_m[to]);
        let level = (b[0] - a[0]).hypot(b[1] - a[1]);
        let rise = (b[2] - a[2]).atan2(level).to_degrees();
        // Without the sign of what is rounded to zero.
        format!("{:.2}", rise + 0.0).replace("-0.00", "0.00")
    }

    /// The bars with the largest tension and compression of a long system.
    fn largest(&self) -> String {
        let mut order: Vec<usize> = (0..self.axial.len()).collect();
        let wanted = EXTREMES.min(order.len() - 1);
        let force = |bar: &usize| self.axial[*bar].largest_n();
        let by_force = |a: &usize, b: &usize| force(b).total_cmp(&force(a));
        order.select_nth_unstable_by(wanted, by_force);
        let mut most = order[..wanted].to_vec();
        let rest = order.len() - wanted;
        order.select_nth_unstable_by(rest, by_force);
        let mut least = order[rest..].to_vec();
        most.sort_by(by_force);
        least.sort_by(by_force);
        most.extend(least);
        let title =
            format!("Of {} bars those with the largest and the smallest forces", self.axial.len());
        self.bars(&title, &most)
    }

    fn reactions(&self) -> String {
        let mut table = table(["joint", "Fx / N", "Fy / N", "Fz / N", "size / N"]);
        let all: Vec<Vector> = self.reactions_n.iter().map(|(_, force)| *force).collect();
        // A support that bears nothing has the rounding of the bars' forces.
        let axial: Vec<f64> = self.axial.iter().map(AxialForce::largest_n).collect();
        let forces = Numbers::of(all.as_flattened().iter().chain(&axial));
        let mut shown: Vec<_> = self.reactions_n.iter().collect();
        let hidden = shown.len() > PRINTED;
        if hidden {
            shown.sort_by(|(_, a), (_, b)| norm(*b).total_cmp(&norm(*a)));
            shown.truncate(EXTREMES);
        }
        for (joint, force) in shown {
            let mut row = vec![(self.name)(*joint)];
            row.extend(force.map(|x| forces.short(x)));
            row.push(forces.short(norm(*force)));
            table.add_row(row);
        }
        numbers_from(&mut table, 1);
        let which = if hidden { ", the largest of them" } else { "" };
        titled(&format!("Forces of the ground on the joints{which}:"), &table)
    }

    /// What counts as zero beside the axial forces and those of the ground.
    fn rounded(&self) -> Numbers {
        let axial = self.axial.iter().map(AxialForce::largest_n);
        let ground = self.reactions_n.iter().flat_map(|(_, force_n)| *force_n);
        Numbers::of(&axial.chain(ground).collect::<Vec<_>>())
    }

    /// Sag, lowest joint, largest forces and where.
    pub fn summary(&self) -> String {
        let Some(extremes) = &self.extremes else { return String::new() };
        let places = self.places();
        let at = numbers(&extremes.lowest_m.map(|x| places.number(x)), "m", |x| places.short(x));
        let mut text = format!("Lowest joint: {}, at {at}.\n", (self.name)(extremes.lowest_joint));
        // Writing to a String cannot fail. What stands above all lines does not sag.
        if let Some(Sag { depth_m, joint, ends }) = extremes.sag.filter(|sag| sag.depth_m >= 0.0) {
            let [from, to] = ends.map(|end| (self.name)(end));
            let below = if from == to {
                format!("the lowest support, {from}")
            } else {
                format!("the line from {from} to {to}")
            };
            let (depth, joint) = (quantity(places.number(depth_m), "m"), (self.name)(joint));
            text += &wrapped(&format!("Sag: {depth}, of joint {joint} below {below}."), 0);
            text.push('\n');
        }
        let ends = [("tension", extremes.tension_n), ("compression", extremes.compression_n)];
        for (what, largest) in ends {
            let Some((bar, force_n)) = largest else { continue };
            let [from, to] = (self.ends)(bar).map(|joint| (self.name)(joint));
            let size = quantity(force_n, "N");
            let _ = writeln!(text, "Largest {what}: {size}, in the member from {from} to {to}.");
        }
        if let Some(weakest) = self.weakest {
            let ends = |bar| (self.ends)(bar).map(|joint| (self.name)(joint));
            text += &wrapped(&weakest_of(&weakest, &ends), 0);
            text.push('\n');
        }
        text
    }
}

/// The member that is nearest to breaking, by the names of its joints, and what is not judged, in sentences.
pub fn weakest_of(weakest: &Weakest, ends: &dyn Fn(usize) -> [String; 2]) -> String {
    let Weakest { bar, utilisation, safety, safety_wanted, unjudged } = *weakest;
    let not_judged = unjudged.map(|Unjudged { bar, axial_n }| {
        let [from, to] = ends(bar);
        let (borne, key) = match axial_n {
            n if n < 0.0 => ("compression", "compression_n or bending_n_m2"),
            _ => ("tension", "strength_n"),
        };
        let size = quantity(axial_n.abs(), "N");
        format!(
            "Not judged: {borne} of up to {size}, in the member from {from} to {to}, which has no {key}."
        )
    });
    let [from, to] = ends(bar);
    let wanted = if weakest.suffices() {
        format!("{} required", short(safety_wanted))
    } else {
        format!("below {}", short(safety_wanted))
    };
    let used = if utilisation.is_finite() {
        format!("at {} of its strength", percent(utilisation))
    } else {
        "whose force has no bound".to_owned()
    };
    let safety = three_digits(safety);
    let judged = (utilisation > 0.0 || unjudged.is_none()).then(|| {
        format!("Weakest: member from {from} to {to}, {used}: safety {safety}, {wanted}.")
    });
    judged.into_iter().chain(not_judged).collect::<Vec<_>>().join(" ")
}

/// A safety in three digits, rounded down: 1.9999 is below 2.
fn three_digits(safety: f64) -> String {
    let step = 10.0_f64.powf(safety.log10().floor() - 2.0);
    if step.is_normal() { short((safety / step).floor() * step) } else { short(safety) }
}

/// A part in percent, in three digits; what nothing bounds, in words.
pub fn percent(part: f64) -> String {
    if part.is_finite() {
        format!("{} %", short((1e3 * part).round() / 10.0))
    } else {
        "no bound".to_owned()
    }
}

/// A table under its title.
fn titled(title: &str, table: &Table) -> String {
    format!("{}\n{table}\n\n", wrapped(title, 0))
}
