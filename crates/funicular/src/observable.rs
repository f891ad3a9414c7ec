//! What a study or a load path shows: places of joints, sags and forces by name.

use model::system::{System, SystemEquilibrium};
use model::system_file::nearest;

use branches::ParameterError;

use crate::sag::Sag;

const HELP: &str = "`joints.NAME` (or one coordinate of it, `joints.NAME.z`), `sag.NAME-NAME`, `bars.NUMBER.axial_max_n` (axial_n, axial_from_n, axial_to_n), `bars.NUMBER.utilisation` or `utilisation` of the weakest bar, `height` or `height=DATUM`";

/// Axial forces of a member, as the JSON of `solve` calls them: in the middle, at both ends, where it is largest.
const AXIAL: [&str; 4] = ["axial_n", "axial_from_n", "axial_to_n", "axial_max_n"];

/// The part of its strength that a member uses.
const UTILISATION: &str = "utilisation";

const STRENGTH: &str = "give it `strength_n`, `compression_n` or `bending_n_m2`";

/// A number of an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Observable {
    /// A coordinate of a joint, m.
    Place(usize, usize),
    /// The sag of the way of fewest members between two joints, m.
    Sag([usize; 2]),
    /// An axial force of a member, N, by its place in [`AXIAL`].
    Axial(usize, usize),
    /// The part of its strength that a member uses, or the one that is nearest to breaking.
    Used(Option<usize>),
    /// The height of the lowest joint over a datum, m.
    Height(f64),
}

impl Observable {
    /// What `text` names in a system.
    pub(crate) fn parse(text: &str, system: &System) -> Result<Self, ParameterError> {
        let wrong = |what: String, help: String| ParameterError {
            text: text.to_owned(),
            span: 0..text.len(),
            what,
            help,
        };
        let unknown = || wrong(format!("an answer has no number `{text}`"), HELP.to_owned());
        let joint = |name: &str| {
            let quoted = name.strip_prefix('"').and_then(|name| name.strip_suffix('"'));
            let name = quoted.unwrap_or(name);
            system.joint(name).ok_or_else(|| {
                let names: Vec<_> = system.joints().iter().map(|j| j.name.text()).collect();
                let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
                let help = nearest(name, &names)
                    .map_or_else(|| HELP.to_owned(), |meant| format!("did you mean `{meant}`?"));
                wrong(format!("there is no joint `{name}`"), help)
            })
        };
        if let Some(rest) = text.strip_prefix("joints.") {
            let (name, axis) = rest.rsplit_once('.').ok_or_else(unknown)?;
            let axis = ["x", "y", "z"].iter().position(|a| *a == axis).ok_or_else(unknown)?;
            return Ok(Self::Place(joint(name.strip_suffix(".at_m").unwrap_or(name))?, axis));
        }
        if let Some(rest) = text.strip_prefix("sag.") {
            // Names may have dashes of their own: of all ways to read it the first that is there.
            let mut both = rest.match_indices('-').map(|(at, _)| [&rest[..at], &rest[at + 1..]]);
            let found = both.clone().find_map(|[a, b]| Some([joint(a).ok()?, joint(b).ok()?]));
            let [a, b] = both.next_back().ok_or_else(unknown)?;
            return found
                .map_or_else(|| Ok(Self::Sag([joint(a)?, joint(b)?])), |ends| Ok(Self::Sag(ends)));
        }
        if let Some(rest) = text.strip_prefix("bars.") {
            let (bar, key) = rest.split_once('.').ok_or_else(unknown)?;
            let axial = AXIAL.iter().position(|axial| *axial == key);
            let members = system.members().len();
            let number = bar.parse::<usize>().ok().filter(|bar| (1..=members).contains(bar));
            let none = || wrong(format!("there is no bar `{bar}`"), format!("1 to {members}"));
            let is_used = key == UTILISATION;
            let member = if is_used || axial.is_some() { number.ok_or_else(none)? } else { 1 } - 1;
            return match axial {
                Some(key) => Ok(Self::Axial(member, key)),
                None if is_used && system.members()[member].strength.is_some() => {
                    Ok(Self::Used(Some(member)))
                }
                None if is_used => {
                    Err(wrong(format!("bar {bar} has no strength"), STRENGTH.to_owned()))
                }
                None => Err(unknown()),
            };
        }
        if text == UTILISATION {
            let none = || wrong("no bar has a strength".to_owned(), STRENGTH.to_owned());
            return system.has_strengths().then_some(Self::Used(None)).ok_or_else(none);
        }
        let datum = match text.split_once('=') {
            Some(("height", datum)) => datum.parse().ok(),
            None if text == "height" => Some(system.floor_m().unwrap_or(0.0)),
            _ => None,
        };
        datum.filter(|z: &f64| z.is_finite()).map(Self::Height).ok_or_else(unknown)
    }

    /// What `text` names in a system, each with its unit: `joints.NAME` alone all three coordinates.
    pub(super) fn named(
        text: &str,
        system: &System,
    ) -> Result<Vec<(String, &'static str)>, ParameterError> {
        let of = |text: String| Ok((text.clone(), Self::parse(&text, system)?.unit()));
        let joint = text.strip_prefix("joints.").map(|name| name.trim_matches('"'));
        match (of(text.to_owned()), joint.and_then(|name| system.joint(name))) {
            (Err(_), Some(_)) => {
                ["x", "y", "z"].iter().map(|axis| of(format!("{text}.{axis}"))).collect()
            }
            (one, _) => Ok(vec![one?]),
        }
    }

    /// Its unit.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Axial(..) => "N",
            Self::Used(_) => "1",
            Self::Place(..) | Self::Sag(_) | Self::Height(_) => "m",
        }
    }

    /// Its value; `None` where no members connect the two joints, or one is above the other.
    pub(crate) fn of(self, system: &System, found: &SystemEquilibrium) -> Option<f64> {
        match self {
            Self::Place(joint, axis) => Some(found.joints_m[joint][axis]),
            Self::Sag(ends) => Sag::between(system, &found.joints_m, ends).map(|sag| sag.depth_m),
            Self::Axial(member, key) => {
                let along = found.axial_force(system, member);
                let middle_n = found.axial_n[member];
                Some([middle_n, along.from_n, along.to_n, along.largest_n()][key])
            }
            Self::Used(Some(member)) => found.utilisation(system, member),
            Self::Used(None) => found.weakest(system).map(|(_, used)| used),
            Self::Height(datum_m) => {
                let lowest_m = found.joints_m.iter().map(|at_m| at_m[2]).min_by(f64::total_cmp)?;
                Some(lowest_m - datum_m)
            }
        }
    }
}
