//! What bars bear: `strength_n`, `compression_n` or `bending_n_m2`, and the `safety` that is required.

use super::error::Result;
use super::kind::SystemFileErrorKind as Kind;
use super::table::Table;
use super::tolerance::Numbers;
use crate::system::{Strength, System};

/// A safety, and no strength that it is of.
const OF_NOTHING: Kind = Kind::MissingKey {
    key: "strength_n",
    wanted: "the tension that breaks a bar, N, or compression_n: a safety is of a strength",
};

/// The safety that is required of all bars that say nothing else; 1 where the file has none.
pub(super) fn safety(root: &Table<'_>) -> Result<f64> {
    Ok(root.positive("safety")?.unwrap_or(1.0))
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
        own.positive("bending_n_m2")?;
        compression_n = Some(Strength::euler_n(bending_n_m2, length_m));
    }
    let own_safety = own.get("safety")?;
    if tension_n.is_none() && compression_n.is_none() {
        let nothing = || own.wrong(OF_NOTHING, "safety");
        return own_safety.map_or(Ok(None), |_| Err(nothing()));
    }
    let strength = Strength::new(tension_n, compression_n, own_safety.unwrap_or(safety));
    strength.map(Some).map_err(|error| own.refused(error))
}

/// Refuse a safety for all bars where none has a strength.
pub(super) fn check(root: &Table<'_>, system: &System) -> Result<()> {
    let of_none = system.members().iter().all(|member| member.strength.is_none());
    let is_wanted = root.get("safety").is_some();
    if is_wanted && of_none { Err(root.error(OF_NOTHING, "safety")) } else { Ok(()) }
}
