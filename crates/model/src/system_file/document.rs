//! The walk over the spanned TOML tree: from keys and values to a chain.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeTable;

use super::described::Described;
use super::duplicate;
use super::error::{Result, SystemFileError};
use super::kind::SystemFileErrorKind as Kind;
use super::limits::{most_bars, most_bars_of_file};
use super::loads;
use super::material;
use super::network;
use super::network_rows;
use super::row_table::Row;
use super::sheet::SheetFile;
use super::source::Source;
use super::strength;
use super::table::Table;
use super::tolerance;
use crate::system::{Refusal, Shares as _, System, SystemError};
use crate::{Anchors, Bar, BarError, Chain, Problem, STANDARD_GRAVITY_M_S2};

const ROOT_KEYS: &[&str] = names! {
    name gravity_m_s2 floor_m plane safety tolerances anchors bars bars_file loads cases joints
    joints_file
};
/// What a chain may have in a file and a [`Chain`] has not.
const BEYOND_CHAINS: &[&str] = &["loads", "cases", "floor_m"];
/// What all bars of a chain may have, and what one, and a [`Bar`] has not.
const BEYOND_ALL: &[&str] = &["safety", "tolerances"];
const BEYOND_BAR: &[&str] = names! {
    mass_kg_per_m density_kg_m3 temperature_k strength_n compression_n bending_n_m2 safety
    length_tolerance_m mass_tolerance_kg
};
const ANCHOR_KEYS: &[&str] = &["start_m", "end_m"];
const BAR_KEYS: &[&str] = names! {
    length_m mass_kg mass_kg_per_m diameter_m density_kg_m3 temperature_k expansion_per_k centre_m
    inertia_kg_m2 count strength_n compression_n bending_n_m2 safety length_tolerance_m
    mass_tolerance_kg
};

const WANTED_BARS: &str = "one or more tables [[bars]] with length_m and mass_kg";

/// Where things stand, for the refusals that come after reading.
pub(super) struct Places {
    end: Range<usize>,
    bars: Origin,
}

/// Where the bars come from.
enum Origin {
    /// The `[[bars]]` tables.
    Tables(Vec<BarsPlace>),
    /// The file that `bars_file` names.
    File(SheetFile),
}

/// Where a `[[bars]]` table stands.
struct BarsPlace {
    /// The number of its first bar, from 1.
    first: usize,
    length: Range<usize>,
    mass: Range<usize>,
}

impl Source<'_> {
    /// Whatever the text describes, accepted as an equilibrium problem.
    pub(super) fn described(&self) -> Result<Described> {
        let tree = self.tree()?;
        let root = Table::root(self, tree.get_ref());
        root.only(ROOT_KEYS)?;
        if root.get("joints").is_some() || root.get("joints_file").is_some() {
            return network::read(&root).map(Described::System);
        }
        if root.get("plane").is_some() {
            let kind = Kind::Conflict { key: "plane", other: "anchors" };
            return Err(root.error(kind, "plane"));
        }
        let (chain, places) = chain_of(&root)?;
        let has =
            |table: &Table<'_>, keys: &[&str]| keys.iter().any(|key| table.get(key).is_some());
        let mut tables = root.tables("bars", WANTED_BARS)?.flatten();
        let more = has(&root, BEYOND_ALL) || tables.any(|table| has(&table, BEYOND_BAR));
        if !more && !has(&root, BEYOND_CHAINS) {
            let problem = Problem::new(chain);
            return problem.map(Described::Chain).map_err(|found| refusal(&root, found, &places));
        }
        let system = if more { with_bars(&root, &chain)? } else { System::from(&chain) };
        let loaded = loads::of_chain(&root, system)?;
        match Problem::new(chain) {
            // The loads may be all that weighs; the system's own check says so if nothing does.
            Ok(_) | Err(Refusal::NoLoad | Refusal::LoadOnAnchors) => {}
            Err(found) => return Err(refusal(&root, found, &places)),
        }
        match loaded.refusal() {
            Ok(()) => Ok(Described::System(loaded)),
            Err(refusal) => {
                let key = ["loads", "floor_m"].into_iter().find(|key| root.get(key).is_some());
                let key = key.unwrap_or("bars");
                Err(root.error(Kind::Refused(refusal), key))
            }
        }
    }

    /// The text as a tree with places; every number of it is still text.
    fn tree(&self) -> Result<Spanned<DeTable<'_>>> {
        let tree = DeTable::parse(self.text).map_err(|error| self.syntax(&error))?;
        if tree.get_ref().is_empty() {
            return Err(self.error(Kind::Empty, None, None));
        }
        Ok(tree)
    }

    fn syntax(&self, error: &toml::de::Error) -> SystemFileError {
        match error.span() {
            Some(span) if error.message() == "duplicate key" => {
                let found = duplicate::find(self.text, span.clone());
                let (path, first_line) = found.first.unzip();
                let key = path.unwrap_or_else(|| found.name.clone());
                let kind = Kind::DuplicateKey { key: found.name, first_line };
                self.error(kind, Some(key), Some(span))
            }
            span => self.error(Kind::Syntax(error.message().to_owned()), None, span),
        }
    }
}

/// A chain, and where its parts stand.
fn chain_of(root: &Table<'_>) -> Result<(Chain, Places)> {
    let name = root.text("name")?.unwrap_or("unnamed");
    let gravity = root.number("gravity_m_s2")?.unwrap_or(STANDARD_GRAVITY_M_S2);
    let table =
        root.table("anchors", root.require("anchors", "a table with start_m and end_m")?)?;
    let anchors = anchors(&table)?;
    let (bars, origin) = chain_bars(root)?;
    let end = table.get("end_m").map_or(0..0, Spanned::span);

    let chain = Chain::new(name, gravity, anchors, bars).map_err(|error| {
        let start_is_good = anchors.start_m.iter().all(|x| x.is_finite());
        let (at, key) = match error {
            SystemError::Gravity(_) => (root, "gravity_m_s2"),
            SystemError::Coordinate { .. } => {
                let key = if start_is_good { "end_m" } else { "start_m" };
                return table.component_error(Kind::System(error), key, f64::is_finite);
            }
            SystemError::Overflow("span") => (&table, "end_m"),
            _ if matches!(origin, Origin::Tables(_)) => (root, "bars"),
            _ => (root, "bars_file"),
        };
        at.error(Kind::System(error), key)
    })?;
    Ok((chain, Places { end, bars: origin }))
}

/// The bars of a chain, in its file or in one of their own.
fn chain_bars(root: &Table<'_>) -> Result<(Vec<Bar>, Origin)> {
    if root.get("bars").is_some() && root.get("bars_file").is_some() {
        let kind = Kind::Conflict { key: "bars_file", other: "bars" };
        return Err(root.error(kind, "bars_file"));
    }
    let (mut rows, limit) = (Vec::new(), most_bars_of_file());
    let mut take = |row: &Row<'_>| {
        if rows.len() == limit {
            return Err((None, Kind::TooManyBars(limit)));
        }
        rows.push(network_rows::of_chain(row)?);
        Ok(())
    };
    if let Some(file) = SheetFile::read(root, "bars_file", &network_rows::CHAIN, &mut take)? {
        return Ok((rows, Origin::File(file)));
    }
    root.require("bars", WANTED_BARS)?;
    bars(root)
}

/// The chain as a system, with what else the file says of its bars.
fn with_bars(root: &Table<'_>, chain: &Chain) -> Result<System> {
    let (safety, tolerances) = (strength::safety(root)?, tolerance::all(root)?);
    let system = System::from(chain);
    let mut members = Vec::with_capacity(system.members().len());
    for table in root.tables("bars", WANTED_BARS)? {
        let (table, left) = (table?, &system.members()[members.len()..]);
        for member in left.iter().take(table.count("count")?) {
            let strength = strength::of(&table, member.body.length_m(), safety)?;
            let mut member = member.clone().bearing(strength);
            member.by_length = material::by_length(&table)?;
            tolerances.member(member, &table)?.join(&mut members);
        }
    }
    // Those of a file have what is said of all.
    for member in &system.members()[members.len()..] {
        tolerances.member(member.clone(), root)?.join(&mut members);
    }
    let joints = system.joints().iter().map(|joint| tolerances.joint(joint.clone(), root));
    let joints = joints.collect::<Result<_>>()?;
    let system = System::new(system.name(), system.gravity_m_s2(), joints, members);
    let system = system.map_err(|error| root.error(Kind::System(error), "bars"))?;
    strength::check(root, &system)?;
    Ok(system)
}

/// Put a refusal where the number stands that it rests on.
fn refusal(root: &Table<'_>, refusal: Refusal, places: &Places) -> SystemFileError {
    let bar = match refusal {
        Refusal::OutOfReach { .. } | Refusal::Taut { .. } | Refusal::Unresolved { .. } => {
            return root.error_at(Kind::Refused(refusal), "anchors.end_m", places.end.clone());
        }
        Refusal::TooLong { member, .. } | Refusal::Folded { member, .. } => Some(member),
        _ => None,
    };
    let massless = refusal == Refusal::NoLoad;
    let kind = Kind::Refused(refusal);
    match (&places.bars, bar) {
        (Origin::Tables(tables), None) if massless => {
            root.error_at(kind, "bars[1].mass_kg", tables[0].mass.clone())
        }
        (Origin::Tables(tables), None) => root.error_at(kind, "bars", tables[0].length.clone()),
        (Origin::Tables(tables), Some(bar)) => {
            let table = tables.partition_point(|place| place.first <= bar);
            let place = tables[table - 1].length.clone();
            root.error_at(kind, &format!("bars[{table}].length_m"), place)
        }
        (Origin::File(file), Some(bar)) => file.row_error(root, bar, kind),
        (Origin::File(_), None) => root.error(kind, "bars_file"),
    }
}

fn anchors(table: &Table<'_>) -> Result<Anchors> {
    const WANTED: &str = "three coordinates in metres, [x, y, z]";
    table.only(ANCHOR_KEYS)?;
    let vector = |key| table.vector(key, table.require(key, WANTED)?);
    Ok(Anchors { start_m: vector("start_m")?, end_m: vector("end_m")? })
}

fn bars(root: &Table<'_>) -> Result<(Vec<Bar>, Origin)> {
    let (mut bars, mut places) = (Vec::new(), Vec::new());
    for table in root.tables("bars", WANTED_BARS)? {
        let table = table?;
        table.only(BAR_KEYS)?;
        let length = table.require("length_m", "a length in metres")?;
        material::check_diameter(&table, &["density_kg_m3"])?;
        let bar = bar(&table, table.number_of("length_m", length)?)?;
        let count = table.count("count")?;
        if count > most_bars() - bars.len() {
            return Err(table.error(Kind::TooManyBars(most_bars()), "count"));
        }
        let mass = table.get("mass_kg").map_or_else(|| length.span(), Spanned::span);
        places.push(BarsPlace { first: bars.len() + 1, length: length.span(), mass });
        bars.resize(bars.len() + count, bar);
    }
    Ok((bars, Origin::Tables(places)))
}

/// The body of one bar: length, mass, centre, moments; of the length that the file gives, and then after a change of temperature.
pub(super) fn bar(table: &Table<'_>, given_m: f64) -> Result<Bar> {
    let (mass_kg, mass_key) = material::mass_kg(table, given_m)?;
    let expansion = material::expansion(table)?;
    let centre_m = table.number("centre_m")?;
    let inertia = table.get("inertia_kg_m2");
    let inertia = inertia.map(|value| table.vector("inertia_kg_m2", value)).transpose()?;
    let given = Bar::given(given_m, mass_kg, centre_m, inertia);
    given.and_then(|given| given.scaled(|x| expansion * x)).map_err(|error| {
        let kind = Kind::Bar(error);
        match error {
            BarError::Length(_) => table.error(kind, "length_m"),
            BarError::Mass(_) => table.error(kind, mass_key),
            BarError::Centre { .. } => table.error(kind, "centre_m"),
            BarError::Inertia(_) => {
                table.component_error(kind, "inertia_kg_m2", |j| j.is_finite() && j >= 0.0)
            }
        }
    })
}
