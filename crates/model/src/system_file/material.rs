//! What people know of a bar: mass a metre, diameter and material, loads a metre, a change of temperature. Each
//! stands for `mass_kg`, `stiffness_n`, `forces` or `length_m`, and is here made into that.

use std::f64::consts::PI;

use super::error::Result;
use super::kind::SystemFileErrorKind as Kind;
use super::table::Table;
use super::tolerance::Numbers as _;
use crate::system::{ByLength, PointLoad};

/// The keys that give a mass, one of which a bar has.
const MASS: [&str; 3] = ["mass_kg", "mass_kg_per_m", "density_kg_m3"];
const WANTED_MASS: &str =
    "a mass in kilograms, or mass_kg_per_m, or density_kg_m3 with diameter_m, in its place";

/// How much longer a bar is after a change of temperature: `1 + expansion_per_k temperature_k`.
pub(super) fn expansion(table: &Table<'_>) -> Result<f64> {
    let both = both(table, ["temperature_k", "expansion_per_k"])?;
    Ok(both.map_or(1.0, |[change_k, expansion_per_k]| 1.0 + expansion_per_k * change_k))
}

/// The mass of a bar of this length, kg, and the key that gives it.
pub(super) fn mass_kg(table: &Table<'_>, length_m: f64) -> Result<(f64, &'static str)> {
    one_of(table, &MASS)?;
    if let Some(mass_kg) = table.number("mass_kg")? {
        return Ok((mass_kg, "mass_kg"));
    }
    if let Some(per_m) = table.number("mass_kg_per_m")? {
        return Ok((per_m * length_m, "mass_kg_per_m"));
    }
    match table.number("density_kg_m3")? {
        Some(density) => Ok((density * area_m2(table)? * length_m, "density_kg_m3")),
        // A rope over rings has none.
        None if table.get("via").is_some() => Ok((0.0, "mass_kg")),
        None => {
            Err(table.error(Kind::MissingKey { key: "mass_kg", wanted: WANTED_MASS }, "mass_kg"))
        }
    }
}

/// The axial stiffness EA, N, if there is one: `young_pa pi diameter_m^2 / 4`.
pub(super) fn stiffness_n(table: &Table<'_>) -> Result<Option<f64>> {
    one_of(table, &["stiffness_n", "young_pa"])?;
    match table.positive("young_pa")? {
        Some(young_pa) => Ok(Some(young_pa * area_m2(table)?)),
        None => table.number("stiffness_n"),
    }
}

/// A load a metre, spread over a bar: `given_m` long as the file has it, `length_m` now.
pub(super) fn spread(table: &Table<'_>, given_m: f64, length_m: f64) -> Result<Option<PointLoad>> {
    let Some(value) = table.get("force_n_per_m") else { return Ok(None) };
    let per_m = table.vector("force_n_per_m", value)?;
    let force_n = per_m.map(|x| x * given_m);
    if let Some(bad) = force_n.into_iter().find(|x| !x.is_finite()) {
        let kind = Kind::Force(bad);
        return Err(table.component_error(kind, "force_n_per_m", f64::is_finite));
    }
    Ok(Some(PointLoad { at_m: 0.5 * length_m, force_n, is_spread: true }))
}

/// What follows the length of a bar.
pub(super) fn by_length(table: &Table<'_>) -> Result<ByLength> {
    let force = table.get("force_n_per_m");
    let force = force.map(|value| table.vector("force_n_per_m", value)).transpose()?;
    Ok(ByLength {
        growth: expansion(table)?,
        mass: MASS[1..].iter().any(|key| table.get(key).is_some()),
        force_n_per_m: force.unwrap_or_default(),
    })
}

/// Refuse a diameter of which nothing is made.
pub(super) fn check_diameter(table: &Table<'_>, makers: &[&str]) -> Result<()> {
    let used = makers.iter().any(|key| table.get(key).is_some());
    match table.get("diameter_m") {
        Some(_) if !used => {
            const WANTED: &str =
                "the density in kg/m^3: nothing is made of the diameter without it";
            let kind = Kind::MissingKey { key: "density_kg_m3", wanted: WANTED };
            Err(table.error(kind, "diameter_m"))
        }
        _ => Ok(()),
    }
}

/// The area of a round section.
fn area_m2(table: &Table<'_>) -> Result<f64> {
    table.require("diameter_m", "the diameter in metres")?;
    let diameter_m = table.positive("diameter_m")?.unwrap_or_default();
    Ok(0.25 * PI * diameter_m * diameter_m)
}

/// Two numbers that mean something together alone.
fn both(table: &Table<'_>, keys: [&'static str; 2]) -> Result<Option<[f64; 2]>> {
    const WANTED: [&str; 2] =
        ["the change of temperature in kelvin", "the part of the length that it grows by a kelvin"];
    match [table.number(keys[0])?, table.number(keys[1])?] {
        [None, None] => Ok(None),
        [Some(first), Some(second)] => Ok(Some([first, second])),
        numbers => {
            let missing = usize::from(numbers[0].is_some());
            let kind = Kind::MissingKey { key: keys[missing], wanted: WANTED[missing] };
            Err(table.error(kind, keys[1 - missing]))
        }
    }
}

/// Refuse two keys that give the same number.
fn one_of(table: &Table<'_>, keys: &[&'static str]) -> Result<()> {
    let mut given = keys.iter().filter(|key| table.get(key).is_some());
    match (given.next(), given.next()) {
        (Some(other), Some(key)) => Err(table.error(Kind::Conflict { key, other }, key)),
        _ => Ok(()),
    }
}
