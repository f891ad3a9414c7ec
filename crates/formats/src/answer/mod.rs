//! Answers: joint positions, and forces if there are some.
//!
//! | file | what is read |
//! |---|---|
//! | JSON | what `solve --json` and `census --json` print, of chains and of systems: every equilibrium in it; or one object with `joints` and, if there are forces, `bars` |
//! | CSV | `joint,x_m,y_m,z_m`, and `reaction_x_n,reaction_y_n,reaction_z_n`, `solver` if there are; forces as `from,to,axial_n`, in the order of `bar` if there is that, in a file of their own |
//! | VTU | an unstructured grid in ASCII: points in the order of the joints, lines that are members or spans of ropes, `axial_n` as data of the cells, in the order of `member` if there is that |

mod csv;
mod json;
mod vtu;

use std::collections::HashMap;

use model::Vector;

use crate::error::{At, Result, Wrong};

pub use csv::{MemberForces, parse_csv, parse_member_forces};
pub use json::parse_json;
pub use vtu::parse_vtu;

/// An answer as a file has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Who found it: what the file says, or the file's own name.
    pub source: String,
    /// Where the joints are.
    pub joints: Joints,
    /// Forces of the members.
    pub forces: Forces,
    /// Forces of the ground on joints by name, N; nothing where the file has none.
    pub reactions_n: Option<Vec<(String, Vector)>>,
}

/// Where joints are, m.
#[derive(Debug, Clone, PartialEq)]
pub enum Joints {
    /// By name.
    Named(Vec<(String, Vector)>),
    /// In the order of the system.
    InOrder(Vec<Vector>),
}

/// Axial forces of members, tension positive, N.
#[derive(Debug, Clone, PartialEq)]
pub enum Forces {
    /// The file has none.
    None,
    /// By the names of the two joints.
    Named(Vec<(String, String, f64)>),
    /// By the numbers of the two joints, from 0; without a force the member is only said to be
    /// there.
    Numbered(Vec<(usize, usize, Option<f64>)>),
    /// In the order of the system.
    InOrder(Vec<f64>),
}

/// Parse an answer by what the text looks like: JSON begins with a brace, XML with `<`, all else is
/// CSV.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the reason.
///
/// ```
/// use formats::answer::{Joints, parse};
/// let answers = parse("joint,x_m,y_m,z_m\nP,0,0,-4\n", "lamp.csv")?;
/// assert_eq!(answers[0].joints, Joints::Named(vec![("P".to_owned(), [0.0, 0.0, -4.0])]));
/// # Ok::<(), formats::FormatError>(())
/// ```
pub fn parse(text: &str, file: &str) -> Result<Vec<Answer>> {
    let begins = text.trim_start_matches('\u{feff}').trim_start();
    match begins.chars().next() {
        None => Err(At::file(file).error(Wrong::Empty)),
        Some('{' | '[') => parse_json(text, file),
        Some('<') => Ok(vec![parse_vtu(text, file)?]),
        Some(_) => parse_csv(text, file),
    }
}

/// Give each answer the forces of its source, or the one list there is; `file` names the lists in
/// errors.
///
/// # Errors
/// When an answer has no list, or a list no answer.
///
/// ```
/// use formats::answer::{attach_forces, parse_csv, parse_member_forces};
/// let mut answers = parse_csv("joint,x_m,y_m,z_m\n0,0,0,0\n1,0,0,-1\n", "joints.csv")?;
/// let lists = parse_member_forces("from,to,axial_n\n0,1,9.81\n", "forces.csv")?;
/// attach_forces(&mut answers, &lists, "forces.csv")?;
/// let forces = vec![("0".into(), "1".into(), 9.81)];
/// assert_eq!(answers[0].forces, formats::answer::Forces::Named(forces));
/// # Ok::<(), formats::FormatError>(())
/// ```
pub fn attach_forces(answers: &mut [Answer], lists: &[MemberForces], file: &str) -> Result<()> {
    let missing = |what| Err(At::file(file).missing(what));
    let mut taken = vec![false; lists.len()];
    let numbers: HashMap<_, _> =
        lists.iter().enumerate().map(|(k, (name, _))| (name.as_deref(), k)).collect();
    for answer in answers.iter_mut() {
        let of_all = || numbers.get(&None);
        let Some(&k) = numbers.get(&Some(answer.source.as_str())).or_else(of_all) else {
            return missing(format!("list of the forces of {:?}", answer.source));
        };
        taken[k] = true;
        answer.forces = Forces::Named(lists[k].1.clone());
    }
    match taken.iter().position(|taken| !taken) {
        None => Ok(()),
        Some(k) => {
            let name = lists[k].0.as_deref().unwrap_or_default();
            missing(format!("answer of {name:?}, whose forces are here"))
        }
    }
}
