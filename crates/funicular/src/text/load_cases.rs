//! A system in each of its load cases, for people.

use std::fmt;

use super::printable::Printable;
use super::settled::{cells, head, severe, used};
use super::shape::{PRINTED, percent};
use super::tables::{counted, numbers_from, short, table, wrapped};
use crate::load_cases::{BarEnvelope, Governing, LoadCasesAnswer};

/// As `funicular solve --load-case each` prints it.
impl fmt::Display for LoadCasesAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (system, cases) = (self.system(), self.cases());
        let strong = system.has_strengths();
        let counted = counted(cases.len(), "load case");
        writeln!(f, "{}", wrapped(&format!("{}: {counted}", Printable(system.name())), 0))?;
        let mut rows = table(head(&["case"], strong));
        for case in cases {
            let mut row = vec![Printable(&case.name).to_string()];
            row.extend(cells(&case.settled, strong));
            rows.add_row(row);
        }
        numbers_from(&mut rows, 1);
        writeln!(f, "{rows}\n")?;
        self.envelope(f)?;
        for case in cases {
            if let Err(reason) = &case.settled {
                let line = format!("{}: {}", Printable(&case.name), Printable(&reason.reason));
                writeln!(f, "{}", wrapped(&line, 2))?;
            }
        }
        let all = cases.iter().filter_map(|case| Some((case, case.settled.as_ref().ok()?)));
        let worst = all.max_by(|(_, a), (_, b)| severe(a).total_cmp(&severe(b)));
        let Some((case, weakest)) = worst.and_then(|(case, s)| Some((case, s.weakest?))) else {
            return Ok(());
        };
        let member = &system.members()[weakest.bar];
        let name = |joint: usize| Printable(&system.joints()[joint].name);
        let (from, to, used) = (name(member.from), name(member.to), used(&weakest));
        let case = Printable(&case.name);
        let line = format!("Worst: in {case} the member from {from} to {to} {used}.");
        writeln!(f, "{}", wrapped(&line, 0))
    }
}

impl LoadCasesAnswer {
    /// Members and supports over all cases: of many those that are nearest to breaking, or bear most.
    fn envelope(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let strong = self.system().has_strengths();
        let mut head = vec!["bar", "from", "to", "least / N", "case", "most / N", "case"];
        head.extend(strong.then_some(["used", "case"]).into_iter().flatten());
        let shown = most(self.bars(), severity);
        let all = |case: &dyn Fn(&Governing) -> String| {
            let mut rows = table(head.iter().copied());
            for bar in &shown {
                let mut row = vec![(bar.bar + 1).to_string()];
                row.extend(bar.ends.iter().map(|end| Printable(end).to_string()));
                for of in [&bar.least_n, &bar.most_n] {
                    row.extend([short(of.value), case(of)]);
                }
                let used = bar.utilisation.as_ref();
                row.extend(used.into_iter().flat_map(|of| [percent(of.value), case(of)]));
                row.resize(head.len(), String::new());
                rows.add_row(row);
            }
            numbers_from(&mut rows, 3);
            rows
        };
        let case = |of: &Governing| Printable(&of.case).to_string();
        let mut rows = all(&case);
        let names = || self.cases().iter().map(|case| &case.name);
        let number = |of: &Governing| names().take_while(|name| **name != of.case).count() + 1;
        let are_numbered = !rows.fits();
        if are_numbered {
            rows = all(&|of| number(of).to_string());
        }
        writeln!(f, "Bars over all cases: axial force, tension positive\n{rows}")?;
        left_out(f, shown.len(), self.bars().len())?;
        if are_numbered {
            let named = (1..).zip(names()).map(|(k, name)| format!("{k} {}", Printable(name)));
            let named = named.collect::<Vec<_>>().join(", ");
            writeln!(f, "{}", wrapped(&format!("Cases: {named}."), 2))?;
        }
        let mut rows = table(["support", "most / N", "case"]);
        let shown = most(self.supports(), |support| support.most_n.value);
        for support in &shown {
            let of = &support.most_n;
            rows.add_row([Printable(&support.joint).to_string(), short(of.value), case(of)]);
        }
        numbers_from(&mut rows, 1);
        writeln!(f, "\nForces of the ground over all cases, their size\n{rows}")?;
        left_out(f, shown.len(), self.supports().len())?;
        writeln!(f)
    }
}

/// All, or of many those with the largest numbers.
pub(super) fn most<T>(all: &[T], number: impl Fn(&T) -> f64) -> Vec<&T> {
    let mut shown: Vec<&T> = all.iter().collect();
    if all.len() > PRINTED {
        shown.sort_by(|a, b| number(b).total_cmp(&number(a)));
        shown.truncate(PRINTED);
    }
    shown
}

fn left_out(f: &mut fmt::Formatter<'_>, shown: usize, all: usize) -> fmt::Result {
    if shown < all { writeln!(f, "(the largest {shown} of {all}; --json has all)") } else { Ok(()) }
}

/// What a member uses of its strength, or its largest force.
fn severity(bar: &BarEnvelope) -> f64 {
    let size = bar.most_n.value.max(-bar.least_n.value);
    bar.utilisation.as_ref().map_or(size, |used| used.value)
}
