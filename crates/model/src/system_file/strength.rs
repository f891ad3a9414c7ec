//! What bars bear: `strength_n`, `compression_n` or `bending_n_m2`, and the `safety` that is required.

use toml::de::DeTable;

use super::error::Result;
use super::kind::SystemFileErrorKind as Kind;
use super::table::Table;
use super::tolerance::Numbers;
use crate::system::{Member, Strength, StrengthError, System};

/// The keys of a bar.
const KEYS: [&str; 4] = ["strength_n", "compression_n", "bending_n_m2", "safety"];
const POSITIVE: &str = "positive and finite";
/// A safety, and no strength that it is of.
const OF_NOTHING: Kind = Kind::MissingKey {
    key: "strength_n",
    wanted: "the tension that breaks a bar, N, or compression_n: a safety is of a strength",
};

/// What is wrong with a number, and its key or column.
fn wrong(error: StrengthError) -> (&'static str, Kind) {
    (error.what, Kind::OutOfRange { found: error.found.to_string(), wanted: POSITIVE })
}

/// The safety that is required of all bars that say nothing else; 1 where the file has none.
pub(super) fn safety(root: &Table<'_>) -> Result<f64> {
    let safety = root.number("safety")?.unwrap_or(1.0);
    let checked = Strength::new(None, None, safety).map_err(|error| {
        let (key, kind) = wrong(error);
        root.error(kind, key)
    });
    checked.map(|strength| strength.safety())
}

/// What a bar of this length bears.
pub(super) fn of<N: Numbers>(
    own: &N,
    length_m: f64,
    safety: f64,
) -> Result<Option<Strength>, N::Error> {
    let tension_n = own.get("strength_n")?;
    let mut compression_n = own.get("compression_n")?;
    if let Some(bending_n_m2) = own.get("bending_n_m2")? {
        if compression_n.is_some() {
            let kind = Kind::Conflict { key: "bending_n_m2", other: "compression_n" };
            return Err(own.wrong(kind, "bending_n_m2"));
        }
        if !(bending_n_m2.is_finite() && bending_n_m2 > 0.0) {
            let kind = Kind::OutOfRange { found: bending_n_m2.to_string(), wanted: POSITIVE };
            return Err(own.wrong(kind, "bending_n_m2"));
        }
        compression_n = Some(Strength::euler_n(bending_n_m2, length_m));
    }
    let own_safety = own.get("safety")?;
    if tension_n.is_none() && compression_n.is_none() {
        let nothing = || own.wrong(OF_NOTHING, "safety");
        return own_safety.map_or(Ok(None), |_| Err(nothing()));
    }
    let strength = Strength::new(tension_n, compression_n, own_safety.unwrap_or(safety));
    strength.map(Some).map_err(|error| {
        let (key, kind) = wrong(error);
        own.wrong(kind, key)
    })
}

/// Refuse a safety for all bars where none has a strength.
pub(super) fn check(root: &Table<'_>, system: &System) -> Result<()> {
    let of_none = system.members().iter().all(|member| member.strength.is_none());
    let is_wanted = root.get("safety").is_some();
    if is_wanted && of_none { Err(root.error(OF_NOTHING, "safety")) } else { Ok(()) }
}

/// The first key about strengths that the file of a chain has.
pub(super) fn given(root: &Table<'_>) -> Option<&'static str> {
    root.get("safety").map(|_| "safety").or_else(|| first_of(root, &KEYS))
}

/// The first of these keys that a bar of a file has.
pub(super) fn first_of(root: &Table<'_>, keys: &[&'static str]) -> Option<&'static str> {
    let bars = root.get("bars").and_then(|value| value.get_ref().as_array());
    let mut bars = bars.into_iter().flatten().filter_map(|bar| bar.get_ref().as_table());
    bars.find_map(|table: &DeTable<'_>| keys.iter().copied().find(|key| table.contains_key(*key)))
}

/// The bars of a chain, as a system, with what they bear.
pub(super) fn put(root: &Table<'_>, system: System) -> Result<System> {
    if given(root).is_none() {
        return Ok(system);
    }
    let safety = safety(root)?;
    let system = with_bars(root, &system, |table, member| {
        member.strength = of(table, member.body.length_m(), safety)?.map(Box::new);
        Ok(())
    })?;
    check(root, &system)?;
    Ok(system)
}

/// A chain, as a system, with more of each of its bars.
pub(super) fn with_bars(
    root: &Table<'_>,
    system: &System,
    set: impl Fn(&Table<'_>, &mut Member) -> Result<()>,
) -> Result<System> {
    let mut members = system.members().to_vec();
    let mut left = members.iter_mut();
    for table in tables(root)? {
        left.by_ref().take(table.count("count")?).try_for_each(|member| set(&table, member))?;
    }
    let (name, gravity_m_s2) = (system.name(), system.gravity_m_s2());
    let system = System::new(name, gravity_m_s2, system.joints().to_vec(), members);
    system.map_err(|error| root.error(Kind::System(error), "bars"))
}

/// The `[[bars]]` of a chain; none where they are in a file of their own.
pub(super) fn tables<'a>(root: &'a Table<'a>) -> Result<Vec<Table<'a>>> {
    let tables = root.get("bars").and_then(|value| value.get_ref().as_array());
    let tables = tables.into_iter().flat_map(|tables| tables.iter().enumerate());
    tables.map(|(k, value)| root.table(&format!("bars[{}]", k + 1), value)).collect()
}
