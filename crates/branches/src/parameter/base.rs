//! What a parameter needs to be there.

use model::system::System;
use model::system_file::nearest;

use crate::parameter::error::{ParameterError, Result};
use crate::parameter::number::{AnchorEnd, BarField, JointField, Number, Which, equals};
use crate::parameter::rows;
use crate::parameter::values::Parameter;

/// So many names of joints are listed.
const MOST_NAMES: usize = 12;

/// The number itself, where the path is another name for it: an end of a row of bars is a joint, the bars of a
/// row have numbers, and a count is that of a whole row.
pub fn resolved(system: &System, number: &Number) -> Number {
    if let Number::Row(name, field) = number {
        return row(system, name).map_or(number.clone(), |[a, b]| {
            resolved(system, &Number::Bar(Which::Range(a, b), *field))
        });
    }
    if let Number::Bar(which, BarField::Count) = number {
        let (joints, members) = (system.joints(), system.members());
        let row = rows::whole(*which, members.len(), |bar| rows::row(joints, members, bar));
        // Of several rows it is that of none.
        return Number::Bar(row.unwrap_or(Which::All), BarField::Count);
    }
    let Number::Anchor(end, axis) = number else { return number.clone() };
    let ends = ends(system).map(|[start, last]| match end {
        AnchorEnd::Start => start,
        AnchorEnd::End => last,
    });
    let field = JointField::Place(*axis);
    ends.map_or(number.clone(), |k| Number::Joint(system.joints()[k].name.to_string(), field))
}

/// Check that the number of a parameter is there.
///
/// # Errors
///
/// [`ParameterError`] with what is missing and what there is.
pub fn check(system: &System, parameter: &Parameter) -> Result<()> {
    match &parameter.number {
        Number::Loads | Number::Lengths | Number::Gravity | Number::Floor => Ok(()),
        Number::Bar(which, _) => bar(parameter, *which, system.members().len()),
        Number::Row(name, _) if row(system, name).is_some() => Ok(()),
        Number::Row(name, _) => {
            let what = format!("there is no row of bars `{name}`");
            Err(of_path(parameter, what, "rows are called by the joints at their ends, FROM-TO"))
        }
        Number::Anchor(..) if ends(system).is_some() => Ok(()),
        Number::Anchor(..) => {
            let what = "the system is not a chain between two anchors";
            Err(of_path(parameter, what, "its supports are `joints.NAME.at_m`"))
        }
        Number::Joint(name, field) => {
            if let Some(number) = system.joint(name) {
                let sides = || rows::sides(system.joints(), system.members(), number);
                if *field == JointField::Share && sides().is_none() {
                    let what = format!("joint `{name}` is not where two rows of bars meet");
                    let help = "it has a share of the rope on both sides of it";
                    return Err(of_path(parameter, what, help));
                }
                return held(parameter, system, number, *field);
            }
            let names: Vec<_> = system.joints().iter().map(|joint| joint.name.text()).collect();
            let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
            let help = match nearest(name, &names) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None if names.len() <= MOST_NAMES => format!("joints: {}", names.join(", ")),
                None => format!("there are {} joints", names.len()),
            };
            Err(of_path(parameter, format!("there is no joint `{name}`"), help))
        }
    }?;
    one_row(parameter, &resolved(system, &parameter.number))
}

/// Refuse a count of bars that are not of one row.
fn one_row(parameter: &Parameter, resolved: &Number) -> Result<()> {
    match resolved {
        Number::Bar(Which::Range(..), BarField::Count) => Ok(()),
        number if number.is_count() => {
            let help = "bars.1.count is that of the row of equal bars that bar 1 is in";
            Err(of_path(parameter, "these bars are of several rows", help))
        }
        _ => Ok(()),
    }
}

/// Whether a joint has the number: places are those of supports, anchors bear no loads.
fn held(parameter: &Parameter, system: &System, joint: usize, field: JointField) -> Result<()> {
    let joint = &system.joints()[joint];
    let name = &joint.name;
    match field {
        JointField::Place(axis) if system.across() == Some(axis) => {
            let what = format!("joint `{name}` would leave the plane that holds all joints");
            Err(of_path(parameter, what, "a file without `plane` lets joints leave it"))
        }
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
fn bar(parameter: &Parameter, which: Which, bars: usize) -> Result<()> {
    match which {
        Which::One(bar) | Which::Range(_, bar) if bar > bars => {
            let path = path(parameter);
            let at = path.find(|c: char| c.is_ascii_digit()).unwrap_or(0);
            let digits = path[at..].chars().take_while(char::is_ascii_digit).count();
            Err(ParameterError::new(
                parameter.text(),
                at..at + digits,
                format!("there is no bar {bar}"),
                format!("there are {bars} bars, numbered from 1"),
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
pub(crate) fn ends(system: &System) -> Option<[usize; 2]> {
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
