//! What a parameter needs to be there.

use model::Chain;
use model::system::{Joint, System};
use model::system_file::nearest;

use crate::parameter::error::ParameterError;
use crate::parameter::number::{AnchorEnd, BarField, JointField, Number, Which, equals};
use crate::parameter::values::Parameter;

/// So many names of joints are listed.
const MOST_NAMES: usize = 12;

/// What has numbers that vary: a [`Chain`] or a [`System`].
pub trait Base {
    /// Check that the number of a parameter is there.
    ///
    /// # Errors
    ///
    /// [`ParameterError`] with what is missing and what there is.
    fn check(&self, parameter: &Parameter) -> Result<(), ParameterError>;

    /// The number itself, where the path is another name for it.
    fn resolved(&self, number: &Number) -> Number {
        number.clone()
    }
}

impl Base for Chain {
    fn check(&self, parameter: &Parameter) -> Result<(), ParameterError> {
        match &parameter.number {
            Number::Loads
            | Number::Floor
            | Number::Joint(..)
            | Number::Row(..)
            | Number::Bar(
                _,
                BarField::Stiffness | BarField::Prestress | BarField::LengthTolerance,
            ) => {
                let what = format!("a chain has no `{}`", parameter.number);
                Err(of_path(parameter, what, "it belongs to systems with `[joints]`"))
            }
            Number::Bar(which, _) => bar(parameter, *which, self.bars().len(), "chain"),
            Number::Gravity | Number::Anchor(..) => Ok(()),
        }
    }
}

impl Base for System {
    /// An end of a row of bars is a joint, and the bars of a row have numbers.
    fn resolved(&self, number: &Number) -> Number {
        if let Number::Row(name, field) = number {
            return row(self, name)
                .map_or(number.clone(), |[a, b]| Number::Bar(Which::Range(a, b), *field));
        }
        let Number::Anchor(end, axis) = number else { return number.clone() };
        let ends = ends(self).map(|[start, last]| match end {
            AnchorEnd::Start => start,
            AnchorEnd::End => last,
        });
        let field = JointField::Place(*axis);
        ends.map_or(number.clone(), |k| Number::Joint(self.joints()[k].name.clone(), field))
    }

    fn check(&self, parameter: &Parameter) -> Result<(), ParameterError> {
        match &parameter.number {
            Number::Loads | Number::Gravity | Number::Floor => Ok(()),
            Number::Bar(which, _) => bar(parameter, *which, self.members().len(), "system"),
            Number::Row(name, _) if row(self, name).is_some() => Ok(()),
            Number::Row(name, _) => {
                let what = format!("there is no row of bars `{name}`");
                Err(of_path(
                    parameter,
                    what,
                    "rows are called by the joints at their ends, FROM-TO",
                ))
            }
            Number::Anchor(..) if ends(self).is_some() => Ok(()),
            Number::Anchor(..) => {
                let what = "the system is no chain between two anchors";
                Err(of_path(parameter, what, "its supports are `joints.NAME.at_m`"))
            }
            Number::Joint(name, field) => {
                if let Some(number) = self.joint(name) {
                    return held(parameter, &self.joints()[number], *field);
                }
                let names: Vec<_> = self.joints().iter().map(|joint| joint.name.as_str()).collect();
                let help = match nearest(name, &names) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None if names.len() <= MOST_NAMES => format!("joints: {}", names.join(", ")),
                    None => format!("there are {} joints", names.len()),
                };
                Err(of_path(parameter, format!("there is no joint `{name}`"), help))
            }
        }
    }
}

/// Whether a joint has the number: places are those of supports, anchors bear no loads.
fn held(parameter: &Parameter, joint: &Joint, field: JointField) -> Result<(), ParameterError> {
    let name = &joint.name;
    match field {
        JointField::Place(_) if joint.support.at_m().is_none() => {
            let what = format!("joint `{name}` is free and has no `at_m`");
            Err(of_path(parameter, what, "joints that are held have a place"))
        }
        JointField::Mass | JointField::Force(_) if joint.support.is_fixed() => {
            let what = format!("joint `{name}` is an anchor");
            Err(of_path(parameter, what, "its load would rest on the ground"))
        }
        _ => Ok(()),
    }
}

/// Whether there are so many bars.
fn bar(parameter: &Parameter, which: Which, bars: usize, what: &str) -> Result<(), ParameterError> {
    match which {
        Which::One(bar) | Which::Range(_, bar) if bar > bars => {
            let path = path(parameter);
            let at = path.find(|c: char| c.is_ascii_digit()).unwrap_or(0);
            let digits = path[at..].chars().take_while(char::is_ascii_digit).count();
            Err(ParameterError::new(
                parameter.text(),
                at..at + digits,
                format!("there is no bar {bar}"),
                format!("the {what} has {bars} bars, numbered from 1"),
            ))
        }
        _ => Ok(()),
    }
}

fn path(parameter: &Parameter) -> &str {
    let text = parameter.text();
    equals(text).map_or(text, |at| &text[..at])
}

/// An error about the whole path.
fn of_path(
    parameter: &Parameter,
    what: impl Into<String>,
    help: impl Into<String>,
) -> ParameterError {
    ParameterError::new(parameter.text(), 0..path(parameter).len(), what, help)
}

/// The two anchors of a system that is one row of bars between them, in the order of its bars.
fn ends(system: &System) -> Option<[usize; 2]> {
    let (joints, members) = (system.joints(), system.members());
    let row = members.iter().enumerate().all(|(k, member)| [member.from, member.to] == [k, k + 1]);
    let last = members.len();
    let held = |joint: usize| joints.get(joint).is_some_and(|j| j.support.is_fixed());
    (row && joints.len() == last + 1 && held(0) && held(last)).then_some([0, last])
}

/// The first and the last bar, from 1, of the row between two joints, whose joints are called `FROM-TO.1` and so on.
fn row(system: &System, name: &str) -> Option<[usize; 2]> {
    // The second row between two joints is called `FROM-TO#2`.
    let ends = name.split_once('#').map_or(name, |(ends, _)| ends);
    let known = |name: &str| system.joint(name);
    let mut splits = ends.match_indices('-').map(|(at, _)| (&ends[..at], &ends[at + 1..]));
    let (from, to) = splits.find_map(|(a, b)| Some((known(a)?, known(b)?)))?;
    let members = system.members();
    if let Some(first) = known(&format!("{name}.1")) {
        let begins = members.iter().position(|m| (m.from, m.to) == (from, first))?;
        let ends = (begins..members.len()).find(|k| members[*k].to == to)?;
        return Some([begins + 1, ends + 1]);
    }
    let one = members.iter().position(|m| (m.from, m.to) == (from, to))?;
    Some([one + 1; 2])
}
