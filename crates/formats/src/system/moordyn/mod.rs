//! MoorDyn input files, versions 1 and 2: the statics of lines between points in still water.
//!
//! A line becomes a run of as many elastic cables as the file has segments for it, with its weight
//! in water at the middle of each; a line lighter than water is pulled up there. Points that are
//! fixed, coupled to a vessel, or attached to a body that is, are anchors where the file puts them.
//! Free points have their mass, and are lifted by the water they displace.
//!
//! Bending stiffness, rods, free bodies, waves, currents, non-linear stiffness and everything that
//! is not known is named and refused. The floor is not part of the system: see
//! [`ForeignSystem::floor_m`].
//!
//! # References
//!
//! MoorDyn, <https://moordyn.readthedocs.io>, "Input Files".

mod map;
mod options;
mod sections;

use std::collections::{HashMap, HashSet};

use model::budget::{BYTES_PER_MEMBER, Budget};
use model::system::{Joint, Member, PointLoad, System};
use model::{Bar, Vector};

use crate::error::{At, Result, as_count};
use crate::system::{ForeignSystem, among};
pub use map::parse_map;
use options::Options;
use sections::{COMMENTS, Row, Section, Sections};

const TYPE_COLUMNS: &[(&str, &[&str])] = &[
    ("name", &["name", "typename", "linetype"]),
    ("diameter", &["diam", "d"]),
    ("mass", &["massden", "mass/m", "massdeninair", "mass"]),
    ("EA", &["ea"]),
    ("EI", &["ei"]),
    // Damping, drag, added mass and vortices: nothing of them at rest in still water.
    ("BA", &["ba/-zeta", "ba", "cint"]),
    (
        "",
        &[
            "cb", "cintdamp", "cd", "ca", "cdax", "caax", "can", "cat", "cdn", "cdt", "cl", "df",
            "cf",
        ],
    ),
];
const POINT_COLUMNS: &[(&str, &[&str])] = &[
    ("id", &["id", "node", "point"]),
    ("type", &["type", "attachment"]),
    ("x", &["x"]),
    ("y", &["y"]),
    ("z", &["z"]),
    ("mass", &["m", "mass"]),
    ("volume", &["v", "volume", "vol", "b"]),
    ("fx", &["fx"]),
    ("fy", &["fy"]),
    ("fz", &["fz"]),
    ("", &["cda", "ca"]),
];
const LINE_COLUMNS: &[(&str, &[&str])] = &[
    ("id", &["id", "line"]),
    ("type", &["linetype", "type"]),
    ("a", &["attacha", "nodeanch", "nodea", "enda"]),
    ("b", &["attachb", "nodefair", "nodeb", "endb"]),
    ("length", &["unstrlen"]),
    ("segments", &["numsegs"]),
    ("flags", &["flags"]),
    ("", &["lineoutputs", "flags/outputs", "outputs"]),
];
const BODY_COLUMNS: &[(&str, &[&str])] = &[
    ("id", &["id", "body"]),
    ("type", &["attachment", "type"]),
    ("x", &["x0", "x"]),
    ("y", &["Y0", "y"]),
    ("z", &["z0", "z"]),
    ("roll", &["r0", "roll", "roll0"]),
    ("pitch", &["p0", "pitch", "pitch0"]),
    ("yaw", &["y0", "yaw", "yaw0"]),
    ("", &["mass", "m", "cg*", "cg", "i*", "i", "volume", "v", "cda*", "cda", "ca*", "ca"]),
];
/// Words for a point that does not move.
const HELD: &str = "fixed fix anchor vessel ves coupled cpld vesselpinned coupledpinned";
/// Words for a point that is free.
const FREE: &[&str] = &["free", "connect", "point", "con"];
/// Segments of one line.
const MOST_SEGMENTS: f64 = 1e6;

/// What members that weigh as in water lack.
const MOTION: &str = "members weigh as in water: modes and motions lack the mass of the line that the water carries, and the \
                      water that moves with it";

/// Room for the words and the number around the name of a line in that of a joint.
const DIGITS: usize = 16;

/// Properties of a line.
struct LineType {
    weight_n_m: f64,
    stiffness_n: f64,
}

/// Read a MoorDyn input file.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the part that is wrong, not understood, or out of scope.
pub fn parse_moordyn(text: &str, file: &str) -> Result<ForeignSystem> {
    let sections = Sections::parse(text, file, COMMENTS)?;
    let options = Options::read(&sections)?;
    let types = line_types(&sections, &options)?;
    let bodies = bodies(&sections)?;
    let mut notes = vec![format!(
        "in still water of {} kg/m^3, g = {} m/s^2",
        options.density_kg_m3, options.gravity_m_s2
    )];
    let (mut joints, mut held_n) = (Vec::new(), Vec::new());
    let mut numbers = HashMap::new();
    for row in sections.need(Section::Points)?.rows(POINT_COLUMNS)? {
        let joint = point(&row, &bodies, &options)?;
        if joint.support.is_fixed() {
            held_n.push(load(&row, &options).unwrap_or_default().in_water_n(&options));
        }
        if numbers.insert(joint.name.to_string(), joints.len()).is_some() {
            return Err(row.at().repeated(format!("point {}", joint.name)));
        }
        joints.push(joint);
    }
    notes.extend(super::held_loads(held_n.into_iter()));
    let (mut members, mut ids, budget) = (Vec::new(), HashSet::new(), Budget::default());
    let lines = sections.need(Section::Lines)?.rows(LINE_COLUMNS)?;
    // Of all lines, before the first is made.
    let all = lines.iter().map(segments).sum::<Result<usize, _>>()?;
    let room = budget.fits_members(all, BYTES_PER_MEMBER);
    room.map_err(|error| At::file(file).memory(error))?;
    for row in lines {
        let line = Line {
            id: row.text("id")?.to_owned(),
            kind: line_type(&row, &types)?,
            ends: ends(&row, &numbers)?,
            length_m: row.positive("length")?,
            count: segments(&row)?,
        };
        let into = (&mut joints, &mut members, &mut ids);
        notes.push(line.read(&row, options.gravity_m_s2, &budget, into)?);
    }
    foreign(&sections, options.gravity_m_s2, (joints, members), (notes, options.floor_m))
}

/// The system, with the bottom of the sea beside it.
fn foreign(
    sections: &Sections<'_>,
    gravity_m_s2: f64,
    (joints, members): (Vec<Joint>, Vec<Member>),
    (mut notes, floor_m): (Vec<String>, Option<f64>),
) -> Result<ForeignSystem> {
    notes.push(MOTION.to_owned());
    let system = System::new(sections.title(), gravity_m_s2, joints, members)
        .map_err(|error| At::file(sections.file).no_system(error))?;
    Ok(ForeignSystem { system, notes, floor_m })
}

fn line_types(sections: &Sections<'_>, options: &Options) -> Result<HashMap<String, LineType>> {
    let mut types = HashMap::new();
    for row in sections.need(Section::LineTypes)?.rows(TYPE_COLUMNS)? {
        let name = row.text("name")?.to_owned();
        let (diameter_m, mass_kg_m) = (row.positive("diameter")?, row.number("mass")?);
        if mass_kg_m < 0.0 {
            return Err(row.at().value("mass", "positive or zero", row.text("mass")?));
        }
        let stiffness = row.text("EA")?;
        if stiffness.parse::<f64>().is_err() {
            let what = format!("the stiffness {stiffness:?}, which is not a constant,");
            return Err(row.at().out_of_scope(what));
        }
        if let Some(bending) = row.optional("EI")?.filter(|bending| bending.abs() > 0.0) {
            let what = format!("the bending stiffness EI = {bending} N m^2");
            return Err(row.at().out_of_scope(what));
        }
        let area_m2 = 0.25 * std::f64::consts::PI * diameter_m * diameter_m;
        let weight_n_m = (mass_kg_m - options.density_kg_m3 * area_m2) * options.gravity_m_s2;
        let line_type = LineType { weight_n_m, stiffness_n: row.positive("EA")? };
        if types.insert(name.clone(), line_type).is_some() {
            return Err(row.at().repeated(format!("line type {name:?}")));
        }
    }
    Ok(types)
}

/// Where the bodies are that do not move.
fn bodies(sections: &Sections<'_>) -> Result<HashMap<String, Vector>> {
    let mut bodies = HashMap::new();
    let Some(section) = sections.get(Section::Bodies) else { return Ok(bodies) };
    for row in section.rows(BODY_COLUMNS)? {
        let (id, kind) = (row.text("id")?.to_owned(), row.text("type")?.to_lowercase());
        if !among(HELD, &kind) {
            let what = format!("body {id}, which is {kind:?} and not fixed,");
            return Err(row.at().out_of_scope(what));
        }
        for angle in ["roll", "pitch", "yaw"] {
            if row.optional(angle)?.is_some_and(|angle| angle.abs() > 0.0) {
                return Err(row.at().unknown(format!("the {angle} of body {id}")));
            }
        }
        let at_m = [row.number("x")?, row.number("y")?, row.number("z")?];
        if bodies.insert(id.clone(), at_m).is_some() {
            return Err(row.at().repeated(format!("body {id}")));
        }
    }
    Ok(bodies)
}

fn point(row: &Row<'_>, bodies: &HashMap<String, Vector>, options: &Options) -> Result<Joint> {
    let name = row.text("id")?;
    let kind = row.text("type")?.to_lowercase();
    let at_m = [row.number("x")?, row.number("y")?, row.number("z")?];
    for force in ["fx", "fy", "fz"] {
        if row.optional(force)?.is_some_and(|force| force.abs() > 0.0) {
            // Manual and sample files disagree whether it is in N or kN.
            let what = format!("the force {force} on point {name}, in N or kN by version,");
            return Err(row.at().unknown(what));
        }
    }
    if among(HELD, &kind) {
        return Ok(Joint::anchor(name, at_m));
    }
    if let Some(body) = kind.strip_prefix("body") {
        let Some(centre) = bodies.get(body) else {
            return Err(row.at().missing(format!("body {body:?} of point {name}")));
        };
        return Ok(Joint::anchor(name, std::array::from_fn(|c| centre[c] + at_m[c])));
    }
    if !FREE.contains(&kind.as_str()) {
        return Err(row.at().unknown(format!("the type {kind:?} of point {name}")));
    }
    let Load { mass_kg, force_n } = load(row, options)?;
    Ok(Joint::free(name).with_mass(mass_kg).with_force(force_n))
}

/// What acts on a point.
#[derive(Default)]
struct Load {
    mass_kg: f64,
    /// Buoyancy and constant force, N.
    force_n: Vector,
}

impl Load {
    /// The force with the weight, N.
    fn in_water_n(&self, options: &Options) -> Vector {
        let [x, y, z] = self.force_n;
        [x, y, z - self.mass_kg * options.gravity_m_s2]
    }
}

/// Mass and buoyancy of a point; a negative mass is lift alone.
fn load(row: &Row<'_>, options: &Options) -> Result<Load> {
    let mass_kg = row.optional("mass")?.unwrap_or_default();
    let displaced_kg = row.optional("volume")?.unwrap_or_default() * options.density_kg_m3;
    let lift_n = (displaced_kg - mass_kg.min(0.0)) * options.gravity_m_s2;
    Ok(Load { mass_kg: mass_kg.max(0.0), force_n: [0.0, 0.0, lift_n] })
}

/// Segments of a line.
fn segments(row: &Row<'_>) -> Result<usize> {
    let segments = row.positive("segments")?;
    if segments.fract() > 0.0 || segments > MOST_SEGMENTS {
        let found = segments.to_string();
        return Err(row.at().value("NumSegs", "a whole number up to 1e6", &found));
    }
    Ok(as_count(segments))
}

/// A line that becomes a run of elastic cables.
struct Line<'a> {
    id: String,
    kind: &'a LineType,
    ends: [usize; 2],
    length_m: f64,
    count: usize,
}

/// The type of a line.
fn line_type<'a>(row: &Row<'_>, types: &'a HashMap<String, LineType>) -> Result<&'a LineType> {
    let kind = row.text("type")?;
    types.get(kind).ok_or_else(|| row.at().missing(format!("line type {kind:?}")))
}

/// The points at the ends of a line.
fn ends(row: &Row<'_>, numbers: &HashMap<String, usize>) -> Result<[usize; 2]> {
    let end = |column: &str| {
        let name = row.text(column)?;
        let bare = name.to_lowercase();
        let bare = bare.strip_prefix("point").unwrap_or(name);
        let found = numbers.get(bare).copied();
        found.ok_or_else(|| row.at().missing(format!("point {name:?}")))
    };
    Ok([end("a")?, end("b")?])
}

impl Line<'_> {
    /// The cables, their joints, and how they were read.
    fn read(
        &self,
        row: &Row<'_>,
        gravity_m_s2: f64,
        budget: &Budget,
        (joints, members, ids): (&mut Vec<Joint>, &mut Vec<Member>, &mut HashSet<String>),
    ) -> Result<String> {
        let Self { id, kind, ends: [from, to], length_m, count } = self;
        if !ids.insert(id.clone()) {
            return Err(row.at().repeated(format!("line {id}")));
        }
        let asked =
            budget.take_members(*count).and_then(|()| budget.take_names(*count, id.len() + DIGITS));
        asked.map_err(|error| row.at().memory(error))?;
        let piece_m = length_m / *count as f64;
        let weight_n = kind.weight_n_m * piece_m;
        let mass_kg = if weight_n > 0.0 { weight_n / gravity_m_s2 } else { 0.0 };
        let body = Bar::homogeneous(piece_m, mass_kg).map_err(|error| row.at().no_system(error))?;
        let lift =
            PointLoad { at_m: 0.5 * piece_m, force_n: [0.0, 0.0, -weight_n], is_spread: true };
        let mut here = *from;
        for k in 1..=*count {
            let there = if k < *count {
                joints.push(Joint::free(format!("line {id}.{k}")));
                joints.len() - 1
            } else {
                *to
            };
            let mut member = Member::cable(here, there, body).with_stiffness(kind.stiffness_n);
            if weight_n < 0.0 {
                member.loads.push(lift);
            }
            members.push(member);
            here = there;
        }
        Ok(format!(
            "line {id}: {count} elastic cables of {piece_m} m, EA = {} N, {} N/m in water",
            kind.stiffness_n, kind.weight_n_m
        ))
    }
}
