//! Answers as comma-separated values.

use std::collections::HashMap;

use model::name_of_cell;

use crate::answer::{Answer, Forces, Joints};
use crate::error::{At, Result};
use crate::sheet::Sheet;

const JOINTS: &[&str] = names! {
    joint x_m y_m z_m solver reaction_x_n reaction_y_n reaction_z_n
    // What `solve --csv` writes for a chain besides: the force between two bars, which follows from
    // the joints and the axial forces, and those.
    force_x_n force_y_n force_z_n axial_n
};
const REACTION: [&str; 3] = ["reaction_x_n", "reaction_y_n", "reaction_z_n"];
const MEMBERS: &[&str] = names! {
    from to axial_n solver bar
    // What `solve --bars-csv` writes besides; all follow from the axial force and the loads of the
    // member.
    axial_from_n axial_to_n axial_max_n start_x_n start_y_n start_z_n end_x_n end_y_n end_z_n
    // And of those that have them the part of the strength that is used, and the joints of a rope.
    utilisation via
};

/// Parse joints as CSV: one answer, or one for each name in the column `solver`.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the reason.
pub fn parse_csv(text: &str, file: &str) -> Result<Vec<Answer>> {
    let sheet = Sheet::parse(file, text, JOINTS, &[])?;
    for name in &JOINTS[..4] {
        sheet.need(name)?;
    }
    let reactions = REACTION.iter().any(|name| sheet.has(name));
    if reactions {
        REACTION.iter().try_for_each(|name| sheet.need(name))?;
    }
    let (mut answers, mut numbers) = (Vec::<(String, Collected)>::new(), HashMap::new());
    for row in sheet.rows() {
        let solver = row.text("solver");
        let source = if solver.is_empty() { file } else { solver };
        let index = *numbers.entry(source.to_owned()).or_insert_with(|| {
            answers.push((source.to_owned(), Collected::default()));
            answers.len() - 1
        });
        let collected = &mut answers[index].1;
        let name = name_of_cell(row.text("joint")).to_owned();
        if name.is_empty() {
            return Err(row.at().missing("name of the joint"));
        }
        let place = [row.number("x_m")?, row.number("y_m")?, row.number("z_m")?];
        if reactions {
            let [x, y, z] = REACTION;
            let force = [row.number(x)?, row.number(y)?, row.number(z)?];
            collected.reactions_n.push((name.clone(), force));
        }
        if sheet.has("axial_n") && !row.text("axial_n").is_empty() {
            collected.axial_n.push(row.number("axial_n")?);
        }
        collected.joints.push((name, place));
    }
    if answers.is_empty() {
        return Err(At::file(file).missing("joint"));
    }
    let answer = |(source, collected): (String, Collected)| Answer {
        source,
        joints: Joints::Named(collected.joints),
        forces: if collected.axial_n.is_empty() {
            Forces::None
        } else {
            Forces::InOrder(collected.axial_n)
        },
        reactions_n: reactions.then_some(collected.reactions_n),
    };
    Ok(answers.into_iter().map(answer).collect())
}

#[derive(Default)]
struct Collected {
    joints: Vec<(String, [f64; 3])>,
    axial_n: Vec<f64>,
    reactions_n: Vec<(String, [f64; 3])>,
}

/// Axial forces by the names of the two joints of each member, N, and whose they are if that is
/// said.
pub type MemberForces = (Option<String>, Vec<(String, String, f64)>);

/// Parse the forces of members as CSV, `from,to,axial_n`: by the name in the column `solver`, or
/// one list for all; in the order of the column `bar`, if there is one.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the reason.
pub fn parse_member_forces(text: &str, file: &str) -> Result<Vec<MemberForces>> {
    let sheet = Sheet::parse(file, text, MEMBERS, &[])?;
    for name in &MEMBERS[..3] {
        sheet.need(name)?;
    }
    let (mut lists, mut numbers) = (Vec::<MemberForces>::new(), HashMap::new());
    let mut rows: Vec<_> =
        sheet.rows().map(|row| Ok((row.number_or_zero("bar")?, row))).collect::<Result<_>>()?;
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, row) in rows {
        let solver = Some(row.text("solver").to_owned()).filter(|name| !name.is_empty());
        let index = *numbers.entry(solver.clone()).or_insert_with(|| {
            lists.push((solver, Vec::new()));
            lists.len() - 1
        });
        let force = row.number("axial_n")?;
        let [from, to] = ["from", "to"].map(|end| name_of_cell(row.text(end)).to_owned());
        lists[index].1.push((from, to, force));
    }
    if lists.is_empty() {
        return Err(At::file(file).missing("member"));
    }
    Ok(lists)
}
