//! Joints and bars by name from files of columns: a row is a joint, or a bar.

use super::kind::SystemFileErrorKind as Kind;
use super::row_table::{Known, Row, Wrong};
use super::strength;
use super::suggest::nearest;
use crate::system::{Joint, Kind as MemberKind, Member, Name, PointLoad, PrestressError, Support};
use crate::{Bar, BarError, Vector};

const PLACE: [&str; 3] = ["x_m", "y_m", "z_m"];
const NEAR: [&str; 3] = ["near_x_m", "near_y_m", "near_z_m"];
const FORCE: [&str; 3] = ["force_x_n", "force_y_n", "force_z_n"];

/// The columns of joints.
pub(super) const JOINTS: Known = Known {
    columns: names! {
        name x_m y_m z_m fixed free mass_kg force_x_n force_y_n force_z_n near_x_m near_y_m
        near_z_m mass_tolerance_kg at_tolerance_m force_tolerance_n
    },
    needed: &[],
};

/// The columns of the bars of a chain.
pub(super) const CHAIN: Known = Known {
    columns: &["length_m", "mass_kg", "centre_m"],
    needed: &[
        ("length_m", "a column of lengths in metres"),
        ("mass_kg", "a column of masses in kilograms"),
    ],
};

/// The columns of bars.
pub(super) const BARS: Known = Known {
    columns: names! {
        from via to length_m mass_kg centre_m kind stiffness_n prestress_n length_tolerance_m
        stiffness_tolerance mass_tolerance_kg strength_n compression_n safety force_x_n force_y_n
        force_z_n force_at_m
    },
    needed: NEEDED,
};

const NEEDED: &[(&str, &str)] = &[
    ("from", "a column of names of joints"),
    ("to", "a column of names of joints"),
    ("mass_kg", "a column of masses in kilograms"),
    ("length_m", "a column of lengths in metres, or the places near_m of the joints"),
];

/// The columns of bars between joints that are drawn: their lengths may be those of the drawing.
pub(super) const DRAWN_BARS: Known =
    Known { columns: BARS.columns, needed: NEEDED.split_at(NEEDED.len() - 1).0 };

/// The kinds of members by their words; the first is meant where none is named.
const KINDS: [(&str, MemberKind); 3] =
    [("bar", MemberKind::Bar), ("cable", MemberKind::Cable), ("strut", MemberKind::Strut)];
/// The words alone.
const KIND_WORDS: &[&str] = &[KINDS[0].0, KINDS[1].0, KINDS[2].0];

/// The kind that a word names, in a table or in a row.
pub(super) fn member_kind(word: Option<&str>) -> Result<MemberKind, Kind> {
    let Some(word) = word else { return Ok(KINDS[0].1) };
    let known = KINDS.iter().find(|(name, _)| *name == word).map(|(_, kind)| *kind);
    known.ok_or_else(|| Kind::UnknownKind {
        found: word.to_owned(),
        allowed: KIND_WORDS,
        suggestion: nearest(word, KIND_WORDS),
    })
}

/// What `free` may be.
pub(super) const FREE: &str = "\"x\", \"y\", \"z\" (a line), \"xy\", \"xz\" or \"yz\" (a plane)";

/// The joint of a row; without a column of names they are numbered from 0.
pub(super) fn joint(row: &Row<'_>) -> Result<Joint, Wrong> {
    let name = if row.has("name") {
        row.name("name")?.into_owned().into()
    } else {
        Name::number(row.number - 1)
    };
    let support = support(row)?;
    let mass_kg = row.number("mass_kg")?.unwrap_or(0.0);
    let force_n = row.vector(FORCE)?.unwrap_or_default();
    if !(mass_kg.is_finite() && mass_kg >= 0.0) {
        return Err((Some("mass_kg"), Kind::Mass(mass_kg)));
    }
    if let Some(bad) = (0..3).find(|k| !force_n[*k].is_finite()) {
        return Err((Some(FORCE[bad]), Kind::Force(force_n[bad])));
    }
    if support.is_fixed() {
        let loaded = |is: bool| {
            if is { Err(Kind::LoadedAnchor(name.to_string())) } else { Ok(()) }
        };
        loaded(mass_kg > 0.0).map_err(|kind| (Some("mass_kg"), kind))?;
        for k in 0..3 {
            loaded(force_n[k].abs() > 0.0).map_err(|kind| (Some(FORCE[k]), kind))?;
        }
    }
    let near_m = row.vector(NEAR)?;
    if support.is_fixed() && near_m.is_some() {
        return Err((Some(NEAR[0]), Kind::Conflict { key: NEAR[0], other: PLACE[0] }));
    }
    Ok(Joint::free(name).held_by(support).with_mass(mass_kg).with_force(force_n).near(near_m))
}

/// A joint with a place is held there, unless `fixed` says that the place is only where it was
/// drawn, or `free` how it slides.
fn support(row: &Row<'_>) -> Result<Support, Wrong> {
    let at_m = row.vector(PLACE)?;
    let fixed = match row.word("fixed")?.as_deref() {
        None => None,
        Some("1" | "true") => Some(true),
        Some("0" | "false") => Some(false),
        Some(found) => {
            let kind =
                Kind::OutOfRange { found: found.to_owned(), wanted: "1 or true, 0 or false" };
            return Err((Some("fixed"), kind));
        }
    };
    let slide = row.word("free")?;
    // Where it slides it is drawn.
    let near_m = if slide.is_some() { row.vector(NEAR)? } else { None };
    match (at_m.or(near_m), fixed, slide) {
        (_, Some(_), Some(_)) => {
            Err((Some("free"), Kind::Conflict { key: "free", other: "fixed" }))
        }
        (None, Some(true), None) | (None, _, Some(_)) => Err((Some(PLACE[0]), Kind::EmptyCell)),
        (None, _, None) | (Some(_), Some(false), None) => Ok(Support::Free),
        (Some(at_m), _, None) => Ok(Support::Fixed { at_m }),
        (Some(at_m), None, Some(word)) => sliding(&word, at_m).ok_or_else(|| {
            (Some("free"), Kind::OutOfRange { found: format!("{word:?}"), wanted: FREE })
        }),
    }
}

/// The support that leaves a joint free to slide through a point: along an axis, or in a plane of
/// two.
pub(super) fn sliding(word: &str, at_m: Vector) -> Option<Support> {
    let axis = |k: usize| std::array::from_fn(|c| if c == k { 1.0 } else { 0.0 });
    Some(match word {
        "x" => Support::Line { at_m, direction: axis(0) },
        "y" => Support::Line { at_m, direction: axis(1) },
        "z" => Support::Line { at_m, direction: axis(2) },
        "yz" => Support::Plane { at_m, normal: axis(0) },
        "xz" => Support::Plane { at_m, normal: axis(1) },
        "xy" => Support::Plane { at_m, normal: axis(2) },
        _ => return None,
    })
}

/// The joints that the rope of a row runs over: names between blanks, or between semicolons.
fn via(row: &Row<'_>, number: &dyn Fn(&str) -> Result<usize, Kind>) -> Result<Vec<usize>, Wrong> {
    let Some(cell) = row.word("via")? else { return Ok(Vec::new()) };
    let is_between = |c: char| if cell.contains(';') { c == ';' } else { c.is_whitespace() };
    let names = cell.split(is_between).map(str::trim).filter(|name| !name.is_empty());
    let joints: Result<Vec<_>, _> = names.map(number).collect();
    let joints = joints.map_err(|kind| (Some("via"), kind))?;
    if joints.is_empty() { Err((Some("via"), Kind::EmptyCell)) } else { Ok(joints) }
}

/// The bar of a row of a chain.
pub(super) fn of_chain(row: &Row<'_>) -> Result<Bar, Wrong> {
    body(row, row.needed("length_m")?, row.needed("mass_kg")?)
}

fn body(row: &Row<'_>, length_m: f64, mass_kg: f64) -> Result<Bar, Wrong> {
    Bar::given(length_m, mass_kg, row.number("centre_m")?, None).map_err(|error| {
        let column = match error {
            BarError::Mass(_) => "mass_kg",
            BarError::Centre { .. } => "centre_m",
            // The moments have no column of their own: m l²/12 is too large.
            BarError::Length(_) | BarError::Inertia(_) => "length_m",
        };
        (Some(column), Kind::Bar(error))
    })
}

/// The length of a path over joints where these are drawn, m.
type Drawn<'a> = dyn Fn(&[usize]) -> Result<Option<f64>, Kind> + 'a;

/// The member of a row, between joints whose numbers `number` knows, and the length of its path where
/// they are drawn `drawn`; `safety` is required where the row says nothing else.
pub(super) fn member(
    row: &Row<'_>,
    number: &dyn Fn(&str) -> Result<usize, Kind>,
    drawn: &Drawn<'_>,
    safety: f64,
) -> Result<Member, Wrong> {
    let joint = |column| number(&row.name(column)?).map_err(|kind| (Some(column), kind));
    let (from, via, to) = (joint("from")?, via(row, number)?, joint("to")?);
    let path = [&[from], via.as_slice(), &[to]].concat();
    let given = row.number("length_m")?;
    let drawn = || drawn(&path).map_err(|kind| (Some("length_m"), kind));
    let length_m = match given.map_or_else(drawn, |given| Ok(Some(given)))? {
        Some(length_m) => length_m,
        None => row.needed("length_m")?,
    };
    let mass_kg = match row.number("mass_kg")? {
        None if via.is_empty() => row.needed("mass_kg")?,
        given => given.unwrap_or(0.0),
    };
    let body = body(row, length_m, mass_kg)?;
    let kind = row.word("kind")?;
    let kind = member_kind(kind.as_deref()).map_err(|kind| (Some("kind"), kind))?;
    let stiffness_n = row.number("stiffness_n")?;
    let loads = load(row, length_m)?;
    let bar = Member::bar(from, to, body).over(via);
    let strength = strength::of(row, length_m, safety)?;
    let member = bar.of_kind(kind).with_stiffness(stiffness_n).bearing(strength).with_loads(loads);
    prestressed(member, row.number("prestress_n")?).map_err(|(column, kind)| (Some(column), kind))
}

/// The member with the unstretched length that goes with its prestress, if it has one; else the key
/// or column that is wrong.
pub(super) fn prestressed(
    member: Member,
    prestress_n: Option<f64>,
) -> Result<Member, (&'static str, Kind)> {
    let Some(prestress_n) = prestress_n else { return Ok(member) };
    member.with_prestress(prestress_n).map_err(|error| {
        let key = match error {
            PrestressError::Stiffness(_) => "stiffness_n",
            PrestressError::Bar(_) => "length_m",
            _ => "prestress_n",
        };
        (key, Kind::Prestress(error))
    })
}

/// The force on a bar, in the middle if no place is given.
fn load(row: &Row<'_>, length_m: f64) -> Result<Vec<PointLoad>, Wrong> {
    let at = row.number("force_at_m")?;
    let Some(force_n) = row.vector(FORCE)? else {
        return if at.is_some() { Err((Some(FORCE[0]), Kind::EmptyCell)) } else { Ok(Vec::new()) };
    };
    if let Some(bad) = (0..3).find(|k| !force_n[*k].is_finite()) {
        return Err((Some(FORCE[bad]), Kind::Force(force_n[bad])));
    }
    let at_m = at.unwrap_or(0.5 * length_m);
    if !(0.0..=length_m).contains(&at_m) {
        let kind = Kind::OutOfRange { found: at_m.to_string(), wanted: "from 0 to length_m" };
        return Err((Some("force_at_m"), kind));
    }
    Ok(vec![PointLoad { at_m, force_n, is_spread: false }])
}
