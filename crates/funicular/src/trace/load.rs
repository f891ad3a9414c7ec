//! Load paths of any system.

use std::io::{self, Write};

pub(crate) use branches::load::Kind;
use branches::load::{End, LoadPath as FollowedPath, Parent, Settings, follow};
use branches::{Number, PointError, Variation};
use model::Vector;
use model::number::Brief;
use model::system::System;
use serde::Serialize;

use super::confirm::Confirmed;
use super::description::{described, most_moved};
use super::enclosed::PathProved;
use super::equations::{Family, Line, line};
use super::everywhere::everywhere;
use super::{figure, page};
use crate::csv::{exact, or_empty, quoted};
use crate::error::Error;
use crate::object::{head, names};
use crate::observable::Observable;

/// Steps over the whole range, at least.
const STEPS: f64 = 24.0;

/// Why there is no load path.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// Occurs when the values of the last parameter are all one.
    #[error("a load path needs a range of values, as `loads=0..1.2`")]
    NoRange,
    /// Occurs when parameters in step do not run along one straight line.
    #[error("the values of parameters in step are not on one straight line")]
    NotStraight,
    /// Occurs when the numbers describe no system.
    #[error(transparent)]
    Numbers(PointError),
    /// Occurs when `lagrange` has no equilibrium at the start.
    #[error("no equilibrium at the start of the path: {0}")]
    Solver(#[from] lagrange::Error),
    /// Occurs when the equilibrium at the start is another one than the shape given shows.
    #[error(
        "the equilibrium at the start of the path is not next to the shape given: joint {joint} is {moved_m} m away",
        moved_m = Brief(*moved_m)
    )]
    NotNear {
        /// The joint that is farthest, in units of its shortest member.
        joint: String,
        /// How far, m.
        moved_m: f64,
    },
    /// Occurs when the shape given is no equilibrium at the start, nor next to one: what is left of balance and lengths.
    #[error(
        "no equilibrium at the start of the path: next to the shape given a part {} of forces or lengths \
         is left",
        Brief(*.0)
    )]
    Start(f64),
    /// Occurs when the equilibrium at the start is singular, as in a limit point.
    #[error(
        "the start of the path is singular: it is a limit point; or cables and bars without load do not resist a motion across \
         them (begin with a little: --vary loads=0.01..1); or a part turns freely: a joint of it that slides in a plane \
         (`normal`) holds it"
    )]
    Singular,
    /// Occurs where two joints of a rope run together.
    #[error(
        "the rope jams: two of its joints run together, and the span between them has no direction"
    )]
    Jams,
}

/// Why a load path ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LoadEnd {
    /// At an end of the range.
    Range,
    /// At the largest number of points.
    MaxPoints,
    /// In a branch point of a path that is followed already.
    Joins,
    /// No step leads on.
    Lost,
    /// Where places are open: many are in equilibrium at one value of the parameter.
    Open,
    /// Where forces grow without bound, as in a line that is pulled straight.
    Unbounded,
    /// Where a rope jams: two of its joints run together.
    Jams,
    /// Where the ends of a bar meet: it has no direction.
    NoLength,
    /// The numbers describe no system beyond.
    Numbers,
}

/// A point of a load path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadPoint {
    /// Values of the parameters.
    pub values: Vec<f64>,
    /// Number of directions in which the energy falls: 0 is stable. In an event, of the part before
    /// it.
    pub index: usize,
    /// The event that happens here, by its number from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub event: Option<usize>,
    /// Energy, J.
    pub energy_j: f64,
    /// What is shown.
    pub of: Vec<Option<f64>>,
    /// Places of the joints, m.
    pub joints_m: Vec<Vector>,
    /// Axial forces of the bars, N, tension positive.
    pub axial_n: Vec<f64>,
}

/// What happens on a load path, and where.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadEvent {
    /// What it is.
    pub kind: Kind,
    /// Values of the parameters.
    pub values: Vec<f64>,
    /// Its point, by its number from 0.
    pub point: usize,
    /// Number of directions in which the energy falls, before and after it.
    pub index: [usize; 2],
    /// Whether the parameter turns back here.
    pub turns: bool,
    /// Between these values of the last parameter exactly one limit or branch point is proved to lie, next to
    /// this shape: where loads alone vary, of systems that are not too large; a branch point where its mode
    /// breaks a symmetry that is exact in double precision.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub enclosed: Option<[f64; 2]>,
    /// Bars that become slack here, from 1.
    pub slack: Vec<usize>,
    /// Bars that become taut here, from 1.
    pub taut: Vec<usize>,
    /// Joints that meet the floor here.
    pub lands: Vec<String>,
    /// Joints that leave the floor here.
    pub leaves: Vec<String>,
    /// Move of each joint in the direction without stiffness, the largest coordinate 1; empty in a
    /// kink.
    pub mode: Vec<Vector>,
    /// In a limit point the derivative of the last parameter there by the length of each bar, in its unit
    /// a metre: what an imperfection changes. In a branch point none is finite.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_length: Vec<f64>,
    /// The same by the place of each support; 0 for free joints.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_place: Vec<Vector>,
}

/// A branch point of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct BranchesFrom {
    /// The path, by its number from 0.
    pub path: usize,
    /// Its event, by its number from 0.
    pub event: usize,
}

impl LoadEvent {
    pub(super) fn is_loss(&self) -> bool {
        self.index[0] == 0 && self.index[1] > 0
    }
}

/// A load path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadPath {
    /// Its points, from the start on.
    pub points: Vec<LoadPoint>,
    /// What happens on it, in its order.
    pub events: Vec<LoadEvent>,
    /// Why it ends.
    pub end: LoadEnd,
    /// The branch point in which it begins, if it is one of [`Trace::branches`](crate::Trace::branches).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branches_from: Option<BranchesFrom>,
    /// The branch point in which it ends, if it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joins: Option<BranchesFrom>,
    /// Where the stiffness at the start, extrapolated, is singular: the estimate of linear buckling, if it
    /// was asked for and there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear_buckling: Option<f64>,
    /// How many equilibria there are at every load of the path, if that is proved: the path meets none of
    /// the others, and no branch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equilibria_at_every_load: Option<usize>,
    /// What `energy` says of it.
    pub confirmed: Confirmed,
    /// What interval arithmetic proves of it from its start on.
    pub proved: PathProved,
}

impl LoadPath {
    /// Whether nothing contradicts the path: `energy` and the judge confirm its points, and the first loss of
    /// stability that is proved is one that was met.
    pub fn agrees(&self) -> bool {
        self.confirmed.agrees() && self.meets_proof()
    }

    /// Whether the first limit or branch point that is proved is the first that was met: a path may turn back
    /// and forth within one step.
    pub(crate) fn meets_proof(&self) -> bool {
        let first = self.events.iter().find(|event| event.kind != Kind::Kink);
        match first {
            _ if self.proved.between.is_none() => true,
            Some(event) => self.proved.is_of(event),
            None => self.end == LoadEnd::MaxPoints,
        }
    }

    /// The first event in which the index rises from 0; nothing where it does not.
    pub fn first_loss(&self) -> Option<&LoadEvent> {
        self.events.iter().find(|event| event.is_loss())
    }
}

/// Load paths, as [`Trace`](crate::Trace) follows them for any system.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadPaths {
    #[serde(flatten, serialize_with = "head")]
    pub(super) system: System,
    pub(super) parameters: Vec<String>,
    pub(super) units: Vec<&'static str>,
    #[serde(serialize_with = "names")]
    pub(super) of: Vec<(String, &'static str)>,
    #[serde(rename = "load_paths")]
    pub(super) paths: Vec<LoadPath>,
}

/// What is followed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    pub(super) max_points: usize,
    /// From how many branch points one after another other paths are followed.
    pub(super) branches: usize,
    pub(super) linear_buckling: bool,
}

/// The paths of one combination of all parameters but the last.
struct Followed<'a> {
    family: Family<'a>,
    linear_buckling: Option<f64>,
    everywhere: Option<usize>,
    paths: Vec<FollowedPath<Family<'a>>>,
}

/// Follow all paths of a variation.
pub(super) fn trace(
    variation: &Variation,
    named: &[String],
    asked: Asked,
    watch: &(dyn Fn(usize, usize) + Sync),
) -> Result<LoadPaths, Error> {
    let system = variation.base();
    let of = named.iter().map(|text| Observable::parse(text, system));
    let of = of.collect::<Result<Vec<_>, _>>()?;
    let mut all = Vec::new();
    for (number, points) in variation.paths().iter().enumerate() {
        let Line { ends, range, longest } = line(points)?;
        let (mut family, start) = Family::new(variation, ends)?;
        let Asked { max_points, branches, linear_buckling } = asked;
        let longest = longest.min(1.0 / STEPS);
        let settings = Settings { range, longest, max_points, branches };
        let buckles = if linear_buckling {
            branches::load::linear_buckling(&mut family, &start).map_err(LoadError::from)?
        } else {
            None
        };
        let linear_buckling = buckles.and_then(|t| family.values(t).last().copied());
        let told = |_, points| watch(number, points);
        let paths = follow(&mut family, &start, settings, &told).map_err(LoadError::from)?;
        let everywhere = everywhere(variation, points);
        all.push(Followed { family, linear_buckling, everywhere, paths });
    }
    let followed = all.iter().flat_map(|one| &one.paths);
    let moved = if named.is_empty() { most_moved(system, followed) } else { None };
    let named = moved.clone().map_or_else(|| named.to_vec(), |moved| vec![moved]);
    let of = match moved {
        Some(moved) => vec![Observable::parse(&moved, system)?],
        None => of,
    };
    let mut paths: Vec<LoadPath> = Vec::new();
    for Followed { mut family, linear_buckling, everywhere, paths: found } in all {
        let earlier = paths.len();
        for mut one in found {
            let mut path = described(&mut family, variation, &of, &mut one)?;
            let main = one.parent.is_none();
            let at = |of: Parent| BranchesFrom { path: earlier + of.path, event: of.event };
            path.joins = if let End::Joins(of) = one.end { Some(at(of)) } else { None };
            path.branches_from = one.parent.map(at);
            path.linear_buckling = linear_buckling.filter(|_| main);
            path.equilibria_at_every_load = everywhere.filter(|_| main);
            paths.push(path);
        }
    }
    let numbers = variation.numbers();
    Ok(LoadPaths {
        system: system.clone(),
        parameters: numbers.iter().map(ToString::to_string).collect(),
        units: numbers.iter().map(Number::unit).collect(),
        of: named.into_iter().zip(of.iter().map(|one| one.unit())).collect(),
        paths,
    })
}

impl LoadPaths {
    /// The paths, one for each combination of all parameters but the last, each followed by those that
    /// branch from it.
    pub fn paths(&self) -> &[LoadPath] {
        &self.paths
    }

    /// The names of the parameters, as in the system file, with their units.
    pub fn parameters(&self) -> (&[String], &[&'static str]) {
        (&self.parameters, &self.units)
    }

    /// What is shown, with its units.
    pub fn of(&self) -> &[(String, &'static str)] {
        &self.of
    }

    /// The system whose numbers vary.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Load over displacement as SVG, for one path, from 1, and all that branch from it.
    pub fn figure(&self, path: usize) -> Option<String> {
        let first = path.checked_sub(1)?;
        self.paths.get(first)?;
        let mut family = vec![first];
        for (number, path) in self.paths.iter().enumerate() {
            if path.branches_from.is_some_and(|from| family.contains(&from.path)) {
                family.push(number);
            }
        }
        Some(figure::figure(self, &family))
    }

    /// One HTML file with the shape at every point of all paths, moved along them, beside the load over
    /// the first number shown.
    pub fn page(&self) -> String {
        page::page(self)
    }

    pub(super) fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        let mut columns = vec!["path".to_owned(), "point".to_owned()];
        columns.extend(self.parameters.iter().map(quoted));
        columns.extend(["index", "event", "energy_j"].map(str::to_owned));
        columns.extend(self.of.iter().map(|(name, _)| quoted(name)));
        for joint in self.system.joints() {
            let place = |axis| quoted(format!("{}_{axis}_m", joint.name));
            columns.extend(["x", "y", "z"].map(place));
        }
        columns.extend((1..=self.system.members().len()).map(|bar| format!("axial_{bar}_n")));
        writeln!(to, "{}", columns.join(","))?;
        for (path, found) in self.paths.iter().enumerate() {
            for (number, point) in found.points.iter().enumerate() {
                let mut cells = vec![(path + 1).to_string(), number.to_string()];
                cells.extend(point.values.iter().map(exact));
                cells.extend([exact(&point.index), or_empty(point.event), exact(&point.energy_j)]);
                cells.extend(point.of.iter().map(|value| or_empty(*value)));
                let numbers = point.joints_m.as_flattened().iter().chain(&point.axial_n);
                cells.extend(numbers.map(exact));
                writeln!(to, "{}", cells.join(","))?;
            }
        }
        Ok(())
    }
}
