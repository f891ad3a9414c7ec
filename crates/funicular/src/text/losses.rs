//! What the loss of each member does, for people.

use std::fmt;

use super::load_cases::most;
use super::printable::Printable;
use super::settled::{cells, head, severe, used};
use super::shape::PRINTED;
use super::tables::{Table, counted, numbers_from, table, wrapped};
use crate::losses::{Loss, LossesAnswer};
use crate::settled::Outcome;

/// As `funicular solve --without each` prints it.
impl fmt::Display for LossesAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (system, all) = (self.system(), self.losses());
        let members = counted(all.len(), "member");
        let title = format!("{}: the loss of each of {members} in turn", Printable(system.name()));
        // Of many the worst.
        let shown = most(all, severity);
        writeln!(f, "{}\n{}", wrapped(&title, 0), self.rows(&shown))?;
        if all.len() > PRINTED {
            writeln!(f, "(the worst {PRINTED} of {}; --json has all)", all.len())?;
        }
        let after = |what| all.iter().filter(|loss| outcome(loss) == Some(what)).count();
        let losses = if all.len() == 1 { "loss" } else { "losses" };
        let falls = after(Outcome::Falls);
        let mut said = vec![format!("A part falls after {falls} of {} {losses}", all.len())];
        if system.has_strengths() {
            let weak =
                |loss: &&Loss| loss.left.as_ref().is_ok_and(|l| l.is_strong() == Some(false));
            said.push(format!("a member is too weak after {}", all.iter().filter(weak).count()));
        }
        for (outcome, what) in [
            (Outcome::Leaves, "the rest leaves its drawing"),
            (Outcome::NoLoad, "nothing bears a load"),
            (Outcome::Unknown, "there is no answer"),
        ] {
            let count = Some(after(outcome)).filter(|count| *count > 0);
            said.extend(count.map(|count| format!("{what} after {count}")));
        }
        writeln!(f, "\n{}", wrapped(&format!("{}.", said.join(", ")), 0))?;
        for loss in shown.iter().filter(|loss| outcome(loss) == Some(Outcome::Unknown)) {
            let Err(reason) = &loss.left else { continue };
            let line = format!("Without {}: {}", loss.bar + 1, Printable(&reason.reason));
            writeln!(f, "{}", wrapped(&line, 2))?;
        }
        let weakest = all.iter().filter_map(|loss| Some((loss, loss.left.as_ref().ok()?.weakest?)));
        let worst = weakest.max_by(|(a, _), (b, _)| severity(a).total_cmp(&severity(b)));
        let Some((loss, weakest)) = worst else { return Ok(()) };
        let [[a, b], [from, to]] = [loss.bar, weakest.bar].map(|bar| self.ends(bar));
        let used = used(&weakest);
        let line = format!("Worst: without {a} to {b} the member from {from} to {to} {used}.");
        writeln!(f, "{}", wrapped(&line, 0))
    }
}

impl LossesAnswer {
    /// The names of the joints of a member.
    fn ends(&self, bar: usize) -> [String; 2] {
        let member = &self.system().members()[bar];
        let name = |joint: usize| Printable(&self.system().joints()[joint].name).to_string();
        [name(member.from), name(member.to)]
    }

    fn rows(&self, shown: &[&Loss]) -> Table {
        let strong = self.system().has_strengths();
        let mut rows = table(head(&["lost", "from", "to"], strong));
        for loss in shown {
            let [from, to] = self.ends(loss.bar);
            let mut row = vec![(loss.bar + 1).to_string(), from, to];
            row.extend(cells(&loss.left, strong));
            rows.add_row(row);
        }
        numbers_from(&mut rows, 3);
        rows
    }
}

/// What becomes of a system of which nothing more is said.
fn outcome(loss: &Loss) -> Option<Outcome> {
    Some(loss.left.as_ref().err()?.outcome)
}

/// How bad a loss is: what falls or is unknown, then what is nearest to breaking, or pulls most.
fn severity(loss: &Loss) -> f64 {
    loss.left.as_ref().map_or(f64::INFINITY, severe)
}
