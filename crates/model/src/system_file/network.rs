//! Systems of bars by name: `[joints]`, and `[[bars]]` between them.

use std::collections::HashMap;
use std::ops::Range;

use super::document::bar;
use super::drawing;
use super::error::Result;
use super::kind::SystemFileErrorKind as Kind;
use super::limits::MAX_BARS;
use super::loads;
use super::material;
use super::network_rows::{self, FREE, member_kind};
use super::row_table::{Known, Row};
use super::sheet::SheetFile;
use super::strength;
use super::suggest::nearest;
use super::table::{Table, Value};
use super::tolerance::{self, Tolerances};
use crate::STANDARD_GRAVITY_M_S2;
use crate::Vector;
use crate::system::{
    Joint, Member, Name, PointLoad, Refusal, RopeFault, Shares, Support, System, SystemError,
    UNIT_TOLERANCE,
};

const ROOT_KEYS: &[&str] = names! {
    name gravity_m_s2 floor_m plane safety tolerances joints joints_file bars bars_file loads
    cases
};
const JOINT_KEYS: &[&str] = names! {
    at_m near_m free along normal mass_kg force_n mass_tolerance_kg at_tolerance_m
    force_tolerance_n
};
const MEMBER_KEYS: &[&str] = names! {
    from to via length_m mass_kg mass_kg_per_m diameter_m density_kg_m3 temperature_k
    expansion_per_k centre_m inertia_kg_m2 count kind stiffness_n young_pa force_n_per_m
    prestress_n length_tolerance_m stiffness_tolerance mass_tolerance_kg strength_n compression_n
    bending_n_m2 safety forces
};
const FORCE_KEYS: &[&str] = &["force_n", "at_m", "spread"];
const WANTED_JOINTS: &str = "a table of joints, such as A = { at_m = [0, 0, 0] }";
const WANTED_BARS: &str = "one or more tables [[bars]] with from, to, length_m and mass_kg";

/// The columns of a file of bars, between joints that are drawn or not.
const BARS: &Known = &network_rows::BARS;
const DRAWN_BARS: &Known = &network_rows::DRAWN_BARS;

/// So many joints are looked through for the one that was meant.
const MOST_NAMES: usize = 10_000;

/// Room for the number behind the name of a row.
const DIGITS: usize = 9;

/// A system while it is read.
struct Reading<'a> {
    root: &'a Table<'a>,
    joints: Vec<Joint>,
    /// Where each named joint stands.
    joint_spans: Vec<Range<usize>>,
    numbers: HashMap<String, usize>,
    /// How many runs between two joints have been named.
    runs: HashMap<String, usize>,
    /// Whether a place is drawn for any joint.
    drawn: bool,
    members: Vec<Member>,
    /// The safety that is required of all bars that say nothing else.
    safety: f64,
    /// How far numbers of bars and joints may be off that say nothing else.
    tolerances: Tolerances,
    /// Where each `[[bars]]` table stands, with the number of its first member, from 1.
    tables: Vec<(usize, Range<usize>)>,
    /// The file of the joints behind those of `[joints]`, and how many it has.
    joints_file: Option<(SheetFile, usize)>,
    /// The file of the members, in the place of tables.
    bars_file: Option<SheetFile>,
}

/// The system of a file with `[joints]`.
pub(super) fn read(root: &Table<'_>) -> Result<System> {
    if root.get("anchors").is_some() {
        let keys = ["joints", "joints_file"];
        let key = keys.into_iter().find(|key| root.get(key).is_some()).unwrap_or("joints");
        return Err(root.error(Kind::Conflict { key, other: "anchors" }, key));
    }
    root.only(ROOT_KEYS)?;
    let name = root.text("name")?.unwrap_or("unnamed");
    let gravity = root.number("gravity_m_s2")?.unwrap_or(STANDARD_GRAVITY_M_S2);
    let mut reading = Reading {
        root,
        joints: Vec::new(),
        joint_spans: Vec::new(),
        numbers: HashMap::new(),
        runs: HashMap::new(),
        drawn: false,
        members: Vec::new(),
        safety: strength::safety(root)?,
        tolerances: tolerance::all(root)?,
        tables: Vec::new(),
        joints_file: None,
        bars_file: None,
    };
    reading.joints()?;
    reading.joints_of_file()?;
    reading.drawn = reading.joints.iter().any(|joint| joint.near_m.is_some());
    reading.bars()?;
    // By number from here on: what is not needed any more makes room.
    reading.numbers = HashMap::new();
    reading.finish(name, gravity)
}

impl Reading<'_> {
    fn joints(&mut self) -> Result<()> {
        if self.root.get("joints").is_none() && self.root.get("joints_file").is_some() {
            return Ok(());
        }
        let value = self.root.require("joints", WANTED_JOINTS)?;
        let table = self.root.table("joints", value)?;
        for (name, value) in table.in_order() {
            let own = table.table(name, value)?;
            let joint = self.tolerances.joint(joint(name, &own)?, &own)?;
            self.numbers.insert(name.to_owned(), self.joints.len());
            joint.join(&mut self.joints);
            self.joint_spans.push(value.span());
        }
        Ok(())
    }

    /// The joints of a file, behind those of the table.
    fn joints_of_file(&mut self) -> Result<()> {
        let Self { root, joints, numbers, tolerances, .. } = self;
        let before = joints.len();
        let mut take = |row: &Row<'_>| {
            let joint = tolerances.joint(network_rows::joint(row)?, row)?;
            // A joint of a file need have no member.
            let bytes = size_of::<Joint>() + joint.name.text().len();
            let asked = root.source().budget.take_names(1, bytes);
            asked.map_err(|error| (Some("name"), Kind::Memory(error)))?;
            numbers.insert(joint.name.to_string(), joints.len());
            joint.join(joints);
            Ok(())
        };
        let file = SheetFile::read(root, "joints_file", &network_rows::JOINTS, &mut take)?;
        let rows = self.joints.len() - before;
        self.joints_file = file.map(|file| (file, rows));
        Ok(())
    }

    /// The bars of a file, a row for each.
    fn bars_of_file(&mut self) -> Result<()> {
        if self.root.get("bars").is_some() {
            let kind = Kind::Conflict { key: "bars_file", other: "bars" };
            return Err(self.root.error(kind, "bars_file"));
        }
        let mut members = Vec::new();
        let number = |name: &str| self.number(name);
        let drawn = |path: &[usize]| self.drawn_m(path, 1);
        let budget = &self.root.source().budget;
        let mut take = |row: &Row<'_>| {
            budget.take_members(1).map_err(|error| (None, Kind::Memory(error)))?;
            let member = network_rows::member(row, &number, &drawn, self.safety)?;
            self.rope(&member, row.number).map_err(|(key, kind)| (Some(key), kind))?;
            self.tolerances.member(member, row)?.join(&mut members);
            Ok(())
        };
        let known = if self.drawn { DRAWN_BARS } else { BARS };
        let file = SheetFile::read(self.root, "bars_file", known, &mut take)?;
        self.bars_file = file;
        self.members = members;
        Ok(())
    }

    fn bars(&mut self) -> Result<()> {
        if self.root.get("bars_file").is_some() {
            return self.bars_of_file();
        }
        self.root.require("bars", WANTED_BARS)?;
        for table in self.root.tables("bars", WANTED_BARS)? {
            let table = table?;
            self.tables.push((self.members.len() + 1, table.span.clone()));
            self.run(&table)?;
        }
        Ok(())
    }

    /// The members of one `[[bars]]` table: one, or `count` in a row with joints between them.
    fn run(&mut self, table: &Table<'_>) -> Result<()> {
        table.only(MEMBER_KEYS)?;
        let (from, from_name) = self.joint(table, "from")?;
        let (to, to_name) = self.joint(table, "to")?;
        let count = table.count("count")?;
        if count > MAX_BARS - self.members.len().min(MAX_BARS) {
            return Err(table.error(Kind::TooManyBars(MAX_BARS), "count"));
        }
        let ends = self.drawn.then(|| [from, to].map(|end| self.joints[end].clone()));
        let via = self.via(table)?;
        let drawn = || {
            let path = [&[from], via.as_slice(), &[to]].concat();
            self.drawn_m(&path, count).map_err(|kind| table.error(kind, "length_m"))
        };
        let read = member(table, &drawn, self.safety)?.between(from, to).over(via);
        let rope = self.rope(&read, self.members.len() + 1);
        rope.map_err(|(key, kind)| table.error(kind, key))?;
        let model = self.tolerances.member(read, table)?;
        let run = self.free_run(from_name, to_name, count);
        let budget = &table.source().budget;
        // Between drawn joints each has a place of its own.
        let own = if self.drawn { count } else { 1 };
        let asked = budget.take_members(own);
        let asked = asked.and_then(|()| budget.take_equal_members(count - own));
        let asked = asked.and_then(|()| budget.take_names(count, run.len() + DIGITS));
        asked.map_err(|error| table.error(Kind::Memory(error), "count"))?;
        let stem = format!("{run}.").into();
        self.joints.reserve(count - 1);
        self.members.reserve(count);
        let mut here = from;
        for k in 1..=count {
            let there = if k == count {
                to
            } else {
                let name = Name::numbered(&stem, k);
                self.joints.push(match &ends {
                    Some([from, to]) => drawing::between(name, from, to, k, count),
                    None => Joint::free(name),
                });
                self.joints.len() - 1
            };
            model.clone().between(here, there).join(&mut self.members);
            here = there;
        }
        Ok(())
    }

    /// Refuse what is not a valid rope, with the key that is wrong.
    fn rope(&self, read: &Member, member: usize) -> Result<(), (&'static str, Kind)> {
        let fault = read.rope_fault(&self.joints);
        let wrong = |f: RopeFault| (f.key(), Kind::System(SystemError::Rope { member, fault: f }));
        fault.map_or(Ok(()), |fault| Err(wrong(fault)))
    }

    /// The joints that a rope runs over.
    fn via(&self, table: &Table<'_>) -> Result<Vec<usize>> {
        const WANTED: &str = "one or more names of joints, such as [\"P\"]";
        let Some(value) = table.get("via") else { return Ok(Vec::new()) };
        if table.get("count").is_some() {
            return Err(table.error(Kind::Conflict { key: "count", other: "via" }, "count"));
        }
        let names = value.get_ref().as_array().filter(|names| !names.is_empty());
        let names = names.ok_or_else(|| table.wrong_type("via", value, WANTED))?;
        let joint = |name: &Value<'_>| {
            let text = name.get_ref().as_str();
            let text = text.ok_or_else(|| table.wrong_type("via", name, WANTED))?;
            self.number(text).map_err(|kind| table.error_at(kind, "via", name.span()))
        };
        names.iter().map(joint).collect()
    }

    /// The length of one of `count` members along these joints as they are drawn, m, if they are.
    fn drawn_m(&self, path: &[usize], count: usize) -> Result<Option<f64>, Kind> {
        if !self.drawn {
            return Ok(None);
        }
        let span =
            |pair: &[usize]| drawing::length_m(&self.joints[pair[0]], &self.joints[pair[1]], count);
        path.windows(2).map(span).sum()
    }

    /// A name for a run of bars, so that the joints between them are new: `A-P`, or `A-P#2`, ...
    fn free_run(&mut self, from: &str, to: &str, count: usize) -> String {
        let mut run = format!("{from}-{to}");
        if count > 1 {
            let again = self.runs.entry(run.clone()).or_insert(0);
            *again += 1;
            if *again > 1 {
                run = format!("{from}-{to}#{again}");
            }
            while self.numbers.contains_key(&format!("{run}.1")) {
                *again += 1;
                run = format!("{from}-{to}#{again}");
            }
            self.numbers.insert(format!("{run}.1"), self.joints.len());
        }
        run
    }

    /// The joint that `from` or `to` names.
    fn joint<'t>(&self, table: &'t Table<'_>, key: &'static str) -> Result<(usize, &'t str)> {
        let value = table.require(key, "the name of a joint")?;
        let Some(name) = value.get_ref().as_str() else {
            return Err(table.wrong_type(key, value, "the name of a joint"));
        };
        let number = self.number(name).map_err(|kind| table.error(kind, key))?;
        Ok((number, name))
    }

    /// The number of the joint of this name.
    fn number(&self, name: &str) -> Result<usize, Kind> {
        let named = self.numbers.get(name).copied();
        let named = named.filter(|joint| self.joints.get(*joint).is_some_and(|j| j.name == name));
        named.ok_or_else(|| unknown_joint(name, &self.joints))
    }

    fn finish(self, name: &str, gravity_m_s2: f64) -> Result<System> {
        let Self { root, mut joints, joint_spans, members, tables, joints_file, bars_file, .. } =
            self;
        let names: Vec<Name> =
            joints.iter().take(joint_spans.len()).map(|joint| joint.name.clone()).collect();
        // What stands in the file as a joint or a table of bars is the place of an error about it.
        let at_joint = |kind, joint: usize| match joint_spans.get(joint) {
            Some(span) => root.error_at(kind, &format!("joints.{}", names[joint]), span.clone()),
            None => match &joints_file {
                Some((file, rows)) if joint < joint_spans.len() + rows => {
                    file.row_error(root, joint - joint_spans.len() + 1, kind)
                }
                _ => root.error(kind, "bars"),
            },
        };
        let at_member = |kind, member: usize, key: &str| {
            if let Some(file) = &bars_file {
                return file.row_error(root, member, kind);
            }
            let table = tables.partition_point(|(first, _)| *first <= member);
            let span = tables[table - 1].1.clone();
            root.error_at(kind, &format!("bars[{table}]{key}"), span)
        };
        if let Some(plane) = root.text("plane")? {
            drawing::keep_to_plane(&mut joints, plane).map_err(|(joint, kind)| match joint {
                Some(joint) => at_joint(kind, joint),
                None => root.error(kind, "plane"),
            })?;
        }
        let floor_m = root.number("floor_m")?;
        let system = System::new(name, gravity_m_s2, joints, members)
            .and_then(|system| system.with_floor(floor_m))
            .map_err(|error| match error {
                SystemError::Floor(_) => root.error(Kind::System(error), "floor_m"),
                SystemError::Gravity(_) => root.error(Kind::System(error), "gravity_m_s2"),
                SystemError::DuplicateName { joint, .. }
                | SystemError::Coordinate { joint, .. }
                | SystemError::Direction { joint, .. }
                | SystemError::Mass { joint, .. }
                | SystemError::BelowFloor { joint, .. }
                | SystemError::NotDrawn { joint, .. }
                | SystemError::DrawnTogether { joint, .. }
                | SystemError::DrawnOffSupport { joint, .. }
                | SystemError::Force { joint, .. } => at_joint(Kind::System(error), joint),
                SystemError::SelfLoop { member, .. }
                | SystemError::Parallel { member, .. }
                | SystemError::Rope { member, .. }
                | SystemError::NoSuchJoint { member, .. }
                | SystemError::IdleStrength { member, .. }
                | SystemError::PointLoad { member, .. } => {
                    at_member(Kind::System(error), member, "")
                }
                SystemError::Stiffness { member, .. } => {
                    at_member(Kind::System(error), member, ".stiffness_n")
                }
                SystemError::LengthTolerance { member, .. } => {
                    at_member(Kind::System(error), member, ".length_tolerance_m")
                }
                _ => root.error(Kind::System(error), "bars"),
            })?;
        let system = tolerance::of_loads(root, loads::by_name(root, system)?)?;
        strength::check(root, &system)?;
        let key = if root.get("bars").is_some() { "bars" } else { "bars_file" };
        let room = root.source().budget.fits_solve(&system);
        room.map_err(|error| root.error(Kind::Memory(error), key))?;
        system.refusal().map_err(|refusal| match refusal {
            Refusal::Unconnected { joint, .. }
            | Refusal::Falls { joint, .. }
            | Refusal::OutOfReach { joint, .. }
            | Refusal::Taut { joint, .. } => at_joint(Kind::Refused(refusal), joint),
            Refusal::TooLong { member, .. }
            | Refusal::Folded { member, .. }
            | Refusal::ShortRope { member, .. } => at_member(Kind::Refused(refusal), member, ""),
            _ => {
                let key = if root.get("joints").is_some() { "joints" } else { "joints_file" };
                root.error(Kind::Refused(refusal), key)
            }
        })?;
        Ok(system)
    }
}

/// A joint that is not there, with the one that was meant.
pub(super) fn unknown_joint(name: &str, joints: &[Joint]) -> Kind {
    let names: Vec<_> = joints.iter().take(MOST_NAMES).map(|joint| joint.name.text()).collect();
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    let suggestion = nearest(name, &names).map(str::to_owned);
    Kind::UnknownJoint { joint: name.to_owned(), suggestion }
}

fn joint(name: &str, table: &Table<'_>) -> Result<Joint> {
    table.only(JOINT_KEYS)?;
    let vector = |key: &str| table.get(key).map(|value| table.vector(key, value)).transpose();
    let mass = table.number("mass_kg")?;
    let force_n = vector("force_n")?;
    table.check_load(mass, force_n, "force_n")?;
    let near_m = vector("near_m")?;
    let support = support(table, vector("at_m")?, near_m)?;
    if support.is_fixed()
        && let Some(key) = ["mass_kg", "force_n"].into_iter().find(|key| table.get(key).is_some())
    {
        return Err(table.error(Kind::LoadedAnchor(name.to_owned()), key));
    }
    if support.is_fixed() && near_m.is_some() {
        return Err(table.error(Kind::Conflict { key: "near_m", other: "at_m" }, "near_m"));
    }
    let (force_n, mass_kg) = (force_n.unwrap_or_default(), mass.unwrap_or(0.0));
    Ok(Joint::free(name).held_by(support).with_mass(mass_kg).with_force(force_n).near(near_m))
}

fn support(table: &Table<'_>, at_m: Option<Vector>, near_m: Option<Vector>) -> Result<Support> {
    const SLIDES: [&str; 3] = ["free", "along", "normal"];
    const WANTED: &str = "a point where the joint may be, [x, y, z]";
    let mut given = SLIDES.into_iter().filter(|key| table.get(key).is_some());
    let slide = given.next();
    if let (Some(other), Some(key)) = (slide, given.next()) {
        return Err(table.error(Kind::Conflict { key, other }, key));
    }
    // Where it slides it is drawn.
    let Some(at_m) = at_m.or(near_m.filter(|_| slide.is_some())) else {
        return match slide {
            Some(key) => Err(table.error(Kind::MissingKey { key: "at_m", wanted: WANTED }, key)),
            None => Ok(Support::Free),
        };
    };
    match slide {
        None => Ok(Support::Fixed { at_m }),
        Some("free") => free(table, at_m),
        Some(key) => {
            let direction = unit(table, key)?;
            Ok(if key == "along" {
                Support::Line { at_m, direction }
            } else {
                Support::Plane { at_m, normal: direction }
            })
        }
    }
}

/// `free = "x"` and the like.
fn free(table: &Table<'_>, at_m: Vector) -> Result<Support> {
    let word = table.text("free")?.unwrap_or_default();
    network_rows::sliding(word, at_m).ok_or_else(|| {
        let found = format!("{word:?}");
        table.error(Kind::OutOfRange { found, wanted: FREE }, "free")
    })
}

/// A direction of any length, made one of unit length.
fn unit(table: &Table<'_>, key: &'static str) -> Result<Vector> {
    let value = table.require(key, "a direction [x, y, z]")?;
    let vector = table.vector(key, value)?;
    if (vector[0].hypot(vector[1]).hypot(vector[2]) - 1.0).abs() <= UNIT_TOLERANCE {
        // What is written with all its digits reads back as it was.
        return Ok(vector);
    }
    // Scaled first, so that no square overflows or vanishes.
    let size = vector.into_iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    let scaled = vector.map(|x| x / size);
    let length = scaled[0].hypot(scaled[1]).hypot(scaled[2]);
    if length.is_finite() && size > 0.0 {
        Ok(scaled.map(|x| x / length))
    } else {
        Err(table.error(Kind::NoDirection, key))
    }
}

/// The member that a `[[bars]]` table describes, without its joints; its length, where none is
/// given, is that of the drawing.
fn member(
    table: &Table<'_>,
    drawn: &dyn Fn() -> Result<Option<f64>>,
    safety: f64,
) -> Result<Member> {
    const WANTED: &str = "a length in metres, or places near_m of the joints";
    let length_m = match table.number("length_m")? {
        Some(length_m) => length_m,
        None => match drawn()? {
            Some(length_m) => length_m,
            None => table.number_of("length_m", table.require("length_m", WANTED)?)?,
        },
    };
    material::check_diameter(table, &["density_kg_m3", "young_pa"])?;
    let body = bar(table, length_m)?;
    let expansion = material::expansion(table)?;
    let kind = member_kind(table.text("kind")?).map_err(|kind| table.error(kind, "kind"))?;
    let mut loads = Vec::new();
    if let Some(value) = table.get("forces") {
        const WANTED: &str = "an array of forces, such as [{ force_n = [0, 12, 0] }]";
        let items = value.get_ref().as_array();
        let items = items.ok_or_else(|| table.wrong_type("forces", value, WANTED))?;
        for (k, item) in items.iter().enumerate() {
            let force = force(&table.table(&format!("forces[{}]", k + 1), item)?, length_m)?;
            // At the same part of the length, whose last place may be before it by rounding.
            let at_m = (expansion * force.at_m).min(body.length_m());
            loads.push(PointLoad { at_m, ..force });
        }
    }
    loads.extend(material::spread(table, length_m, body.length_m())?);
    let stiffness_n = material::stiffness_n(table)?;
    let strength = strength::of(table, body.length_m(), safety)?;
    let member = Member::bar(0, 0, body).of_kind(kind).with_stiffness(stiffness_n);
    let mut member = member.bearing(strength).with_loads(loads);
    member.by_length = material::by_length(table)?;
    network_rows::prestressed(member, table.number("prestress_n")?)
        .map_err(|(key, kind)| table.error(kind, key))
}

/// A force on a bar; in the middle if no place is given.
fn force(table: &Table<'_>, length_m: f64) -> Result<PointLoad> {
    table.only(FORCE_KEYS)?;
    let value: &Value<'_> = table.require("force_n", "a force in newtons, [x, y, z]")?;
    let force_n = table.vector("force_n", value)?;
    table.check_load(None, Some(force_n), "force_n")?;
    let is_spread = table.boolean("spread")?.unwrap_or(false);
    let at_m = table.number("at_m")?.unwrap_or(0.5 * length_m);
    if is_spread && table.get("at_m").is_some() {
        return Err(table.error(Kind::Conflict { key: "at_m", other: "spread" }, "at_m"));
    }
    if !(0.0..=length_m).contains(&at_m) {
        let kind = Kind::OutOfRange { found: at_m.to_string(), wanted: "from 0 to length_m" };
        return Err(table.error(kind, "at_m"));
    }
    Ok(PointLoad { at_m, force_n, is_spread })
}
