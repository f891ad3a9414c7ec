//! MAP++ input files: the statics of its lines, which are read as those of MoorDyn.
//!
//! A line is [`SEGMENTS`] elastic cables in a row. Nodes that are fixed or on the vessel are anchors; those that connect
//! have their mass, are lifted by the water they displace, and bear their force. Gravity, the density of the water and
//! its depth come from the program around MAP++: they are standard gravity, 1025 kg/m³, and the height of the lowest
//! fixed node, unless all lines have the flag `OMIT_CONTACT`. Friction on the bottom (`CB`) is not part of the system.
//!
//! # References
//!
//! MAP++, <https://map-plus-plus.readthedocs.io>, "Input File"; `repeat` turns clockwise, as its source does.

use std::collections::{HashMap, HashSet};

use model::budget::{BYTES_PER_MEMBER, Budget};
use model::system::Joint;
use model::{STANDARD_GRAVITY_M_S2, Vector};

use super::options::{Options, SEA_WATER};
use super::sections::{Row, Section, Sections};
use super::{HELD, LINE_COLUMNS, Line, POINT_COLUMNS};
use crate::error::{At, Result, shortened};
use crate::system::{ForeignSystem, among};

/// Cables of one line: against the catenary the forces at its ends are then wrong by a part of some 1e-4.
const SEGMENTS: usize = 50;
/// `#` marks a first guess here.
const COMMENTS: &[char] = &['!', '%'];
/// A line that touches no bottom.
const NO_CONTACT: &str = "OMIT_CONTACT";
/// A line that does not weigh, and may push.
const SPRING: &str = "LINEAR_SPRING";
/// Flags that ask for output alone.
const OUTPUTS: &str = "plot gx_pos gy_pos gz_pos gx_a_pos gy_a_pos gz_a_pos gx_force gy_force \
    gz_force h_fair v_fair h_anch v_anch tension_fair tension_anch x_excursion z_excursion azimuth \
    altitude altitude_a altitude_anch line_tension lay_length";
/// The head of the table of options, and what its solver does.
const NO_BEARING: &str = "option options (-) [-] help inner_ftol inner_gtol inner_xtol \
    inner_max_its outer_tol outer_max_its outer_fd outer_bd outer_cd integration_dt kb_default \
    cb_default wave_kinematics ref_position krylov_accelerator pg_cooked lm_model";

/// Read a MAP++ input file.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the part that is wrong, not understood, or out of scope.
pub fn parse_map(text: &str, file: &str) -> Result<ForeignSystem> {
    let sections = Sections::parse(text, file, COMMENTS)?;
    let (gravity_m_s2, density_kg_m3) = (STANDARD_GRAVITY_M_S2, SEA_WATER);
    let options = Options { gravity_m_s2, density_kg_m3, floor_m: None };
    let angles = angles(&sections)?;
    let types = super::line_types(&sections, &options)?;
    let nodes = sections.need(Section::Points)?.rows(POINT_COLUMNS)?;
    let lines = sections.need(Section::Lines)?.rows(LINE_COLUMNS)?;
    let budget = Budget::default();
    // Of all copies, before the first is made.
    let (joints, members) = (nodes.len(), lines.len().saturating_mul(SEGMENTS));
    let copies = joints.saturating_add(members).saturating_mul(angles.len());
    let room = budget.fits_members(copies, BYTES_PER_MEMBER);
    room.map_err(|error| At::file(file).memory(error))?;
    lines.iter().try_for_each(flags)?;
    let (mut joints, mut members, mut held_n) = (Vec::new(), Vec::new(), Vec::new());
    let (mut numbers, mut ids) = (HashMap::new(), HashSet::new());
    for (copy, angle) in angles.iter().enumerate() {
        for (k, row) in nodes.iter().enumerate() {
            let name = numbered(row, copy, nodes.len(), k)?;
            let joint = node(row, name, *angle, &options, &mut held_n)?;
            if numbers.insert(joint.name.to_string(), joints.len()).is_some() {
                return Err(row.at().repeated(format!("node {}", joint.name)));
            }
            joints.push(joint);
        }
    }
    let floor_m = floor_m(&lines, &joints)?;
    let mut notes = vec![format!(
        "in still water of {density_kg_m3} kg/m^3, g = {gravity_m_s2} m/s^2, which the file does not say; without the \
         friction of the bottom"
    )];
    notes.extend(crate::system::held_loads(held_n.into_iter()));
    let indented = sections.lines(Section::Options).iter().find(|(_, text)| text.starts_with(' '));
    let comment = |(line, _): &(usize, _)| {
        format!("line {line} begins with a space: MAP++ takes such options for comments")
    };
    notes.extend(indented.map(comment));
    for (copy, k) in (0..angles.len()).flat_map(|copy| (0..lines.len()).map(move |k| (copy, k))) {
        let row = &lines[k];
        let line = Line {
            id: numbered(row, copy, lines.len(), k)?,
            kind: super::line_type(row, &types)?,
            ends: super::ends(row, &numbers)?.map(|end| end + copy * nodes.len()),
            length_m: row.positive("length")?,
            count: SEGMENTS,
        };
        let into = (&mut joints, &mut members, &mut ids);
        notes.push(line.read(row, gravity_m_s2, &budget, into)?);
    }
    super::foreign(&sections, gravity_m_s2, (joints, members), (notes, floor_m))
}

/// The name of a row, or in a copy its number: copies are numbered on.
fn numbered(row: &Row<'_>, copy: usize, count: usize, k: usize) -> Result<String> {
    Ok(if copy == 0 { row.text("id")?.to_owned() } else { (copy * count + k + 1).to_string() })
}

/// The angles of all copies, rad: that of the file itself is 0.
fn angles(sections: &Sections<'_>) -> Result<Vec<f64>> {
    let mut angles = vec![0.0];
    let options = sections.lines(Section::Options).iter();
    for (line, text) in options.filter(|(_, text)| !text.starts_with([' ', '#'])) {
        let mut words = text.split_whitespace();
        let word = words.next().unwrap_or_default().to_lowercase();
        if word == "repeat" {
            for angle in words {
                let angle_deg =
                    At::line(sections.file, *line).number("an angle of repeat", angle)?;
                angles.push(angle_deg.to_radians());
            }
        } else if !among(NO_BEARING, &word) {
            return Err(
                At::line(sections.file, *line).unknown(format!("the option {:?}", shortened(text)))
            );
        }
    }
    Ok(angles)
}

/// A node of a copy.
fn node(
    row: &Row<'_>,
    name: String,
    angle: f64,
    options: &Options,
    held_n: &mut Vec<Vector>,
) -> Result<Joint> {
    let (sin, cos) = angle.sin_cos();
    let turned = |[x, y, z]: Vector| [cos * x + sin * y, cos * y - sin * x, z];
    let kind = row.text("type")?.to_lowercase();
    let at_m = turned([place(row, "x")?, place(row, "y")?, place(row, "z")?]);
    if among(HELD, &kind) {
        // What is no number there is looked for.
        let mut load = super::load(row, options).unwrap_or_default();
        for (column, force_n) in ["fx", "fy", "fz"].into_iter().zip(&mut load.force_n) {
            *force_n += row.number(column).unwrap_or_default();
        }
        held_n.push(turned(load.in_water_n(options)));
        return Ok(Joint::anchor(name, at_m));
    }
    if kind != "connect" {
        return Err(row.at().unknown(format!("the type {kind:?} of node {name}")));
    }
    let mut load = super::load(row, options)?;
    for (column, sum_n) in ["fx", "fy", "fz"].into_iter().zip(&mut load.force_n) {
        let force_n = row.optional(column)?.unwrap_or_default();
        *sum_n += force_n;
        // MAP++ takes N, whatever the head of its table says.
        if force_n.abs() > 0.0 && row.unit(column) != "N" {
            let what = format!("the force {column} on node {name} in {:?}", row.unit(column));
            return Err(row.at().unknown(what).with_help("MAP++ takes N: write (N)"));
        }
    }
    Ok(Joint::free(name).with_mass(load.mass_kg).with_force(turned(load.force_n)))
}

/// Refuse a line with a flag that has a bearing on statics and is not read.
fn flags(row: &Row<'_>) -> Result<()> {
    let read = |flag: &str| among(OUTPUTS, &flag.to_lowercase());
    let known = |flag: &str| read(flag) || flag.eq_ignore_ascii_case(NO_CONTACT);
    let Some(flag) = row.flags().iter().find(|flag| !known(flag)) else { return Ok(()) };
    let error = row.at().unknown(format!("the flag {:?}", shortened(flag)));
    Err(if flag.eq_ignore_ascii_case(SPRING) {
        error.with_help("a spring without weight is an elastic member: write it into a system file")
    } else {
        error.with_help(format!("known are: {NO_CONTACT}, {}", OUTPUTS.replace(' ', ", ")))
    })
}

/// A coordinate; where it is a first guess it has a `#` before it.
fn place(row: &Row<'_>, column: &str) -> Result<f64> {
    let text = row.text(column)?;
    if text.eq_ignore_ascii_case("depth") {
        let error = row.at().missing("depth of the water");
        return Err(error.with_help("write the height of the bottom in the place of `depth`"));
    }
    row.as_number(column, text.strip_prefix('#').unwrap_or(text))
}

/// The bottom of the sea: that of the lowest fixed node, where lines may lie on it.
fn floor_m(lines: &[Row<'_>], joints: &[Joint]) -> Result<Option<f64>> {
    let free = lines.iter().filter(|row| row.has_flag(NO_CONTACT)).count();
    if free == lines.len() {
        return Ok(None);
    }
    if let Some(row) = lines.iter().find(|row| row.has_flag(NO_CONTACT)) {
        return Err(row.at().unknown(format!("a bottom for some lines alone ({NO_CONTACT})")));
    }
    let heights = joints.iter().filter_map(|joint| joint.support.at_m()).map(|at_m| at_m[2]);
    Ok(heights.reduce(f64::min))
}
