//! Writing: the text that reads back to the same chain, bit for bit.

use std::fmt::Write as _;

use crate::{Bar, Chain, Vector};

/// The system file of a chain. Equal bars in a row become one table with `count`; the centre and
/// the moments of inertia are left out where they were not given.
///
/// ```
/// use model::system_file::{Described, parse, write_system};
/// let problem = model::cases::paper();
/// let text = write_system(problem.chain());
/// assert_eq!(parse(&text, "paper.toml")?, Described::Chain(problem));
/// # Ok::<(), model::system_file::SystemFileError>(())
/// ```
pub fn write_system(chain: &Chain) -> String {
    let anchors = chain.anchors();
    let mut text = format!(
        "name = {}\ngravity_m_s2 = {:?}\n\n[anchors]\nstart_m = {}\nend_m = {}\n",
        toml::Value::from(chain.name()),
        chain.gravity_m_s2(),
        vector(anchors.start_m),
        vector(anchors.end_m),
    );
    for run in chain.bars().chunk_by(same) {
        write_run(&mut text, &run[0], run.len());
    }
    text
}

fn write_run(text: &mut String, bar: &Bar, count: usize) {
    let (length, mass) = (bar.length_m(), bar.mass_kg());
    // Writing to a String cannot fail.
    let _ = write!(text, "\n[[bars]]\nlength_m = {length:?}\nmass_kg = {mass:?}\n");
    write_given(text, bar);
    if count > 1 {
        let _ = writeln!(text, "count = {count}");
    }
}

/// Centre and moments where they are given.
pub(super) fn write_given(text: &mut String, bar: &Bar) {
    // Writing to a String cannot fail.
    if let Some(centre_m) = bar.given_centre_m() {
        let _ = writeln!(text, "centre_m = {centre_m:?}");
    }
    if let Some(inertia_kg_m2) = bar.given_inertia_kg_m2() {
        let _ = writeln!(text, "inertia_kg_m2 = {}", vector(inertia_kg_m2));
    }
}

/// Whether two bars are the same in every bit, given or not; `==` takes -0 for 0.
fn same(a: &Bar, b: &Bar) -> bool {
    let numbers = |bar: &Bar| [bar.length_m(), bar.mass_kg(), bar.centre_m()];
    let given = |bar: &Bar| (bar.given_centre_m().is_some(), bar.given_inertia_kg_m2().is_some());
    given(a) == given(b)
        && !differ(&numbers(a), &numbers(b))
        && !differ(&a.inertia_kg_m2(), &b.inertia_kg_m2())
}

/// Whether two rows of numbers differ in any bit.
pub(super) fn differ(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).any(|(x, y)| x.to_bits() != y.to_bits())
}

/// A vector as the file has it.
pub(super) fn vector(v: Vector) -> String {
    format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2])
}
