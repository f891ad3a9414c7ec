//! Which start leads where, as pictures.

use figures::Unit;
use model::budget::Budget;
use model::system::{Support, System};
use model::{SolverName, Vector};
use rayon::prelude::*;
use sweep::{Axis, Chunk, Discovered, Failure, Field, Member, Outcomes, Settings, Source};

use crate::equilibria;
use crate::error::Error;
use crate::followed::Followed;
use crate::problem::Problem;
use crate::simulate::CENSUS_BARS;
use crate::starts::{FromPlaces, solvers};
use crate::threads;

/// Memory that a start takes, bytes.
const BYTES_PER_START: u64 = 50;

/// Draws which equilibrium each start leads to, by both solvers: of a chain between two anchors over
/// the starting angles of two bars; of any other system over the place of one joint, the others
/// starting where they hang.
///
/// ```
/// use funicular::prelude::*;
/// let found = Basins::new().size(20).run(&Problem::case("three-equal-bars")?)?;
/// assert_eq!(found.starts(), 400);
/// let picture = found.svg(&SolverName::ENERGY, funicular::Field::Outcome)?;
/// assert!(picture.starts_with("<svg") && found.failed(&SolverName::ENERGY) == 0);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Basins {
    size: u32,
    bars: [usize; 2],
    others_deg: f64,
    joint: Option<String>,
    plane: Plane,
    threads: usize,
}

/// The plane in which the start of a joint varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "program", derive(clap::ValueEnum))]
pub enum Plane {
    /// X and Z.
    #[default]
    Xz,
    /// Y and Z.
    Yz,
    /// X and Y.
    Xy,
}

impl Plane {
    /// Its axes, by their numbers and names.
    fn axes(self) -> [(usize, char); 2] {
        match self {
            Self::Xz => [(0, 'x'), (2, 'z')],
            Self::Yz => [(1, 'y'), (2, 'z')],
            Self::Xy => [(0, 'x'), (1, 'y')],
        }
    }
}

impl Default for Basins {
    fn default() -> Self {
        let (joint, plane) = (None, Plane::default());
        Self { size: 300, bars: [1, 2], others_deg: 0.0, joint, plane, threads: 0 }
    }
}

impl Basins {
    /// 300 starts along each side, over the angles of the first two bars; all other bars start
    /// hanging down.
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// Starts along each side.
        size: u32,
        /// The two bars whose angles are the axes, from 1.
        bars: [usize; 2],
        /// Starting angle of all other bars from the descending vertical, degrees.
        others_deg: f64,
        /// The joint whose starting place the axes are, of a system that is no chain (its first free
        /// joint).
        joint: &str => Some(joint.to_owned()),
        /// The plane in which it varies, through where the joint hangs: as far as its longest member to
        /// all sides.
        plane: Plane,
        /// How many threads share the work, 0 (the default) for those of the pool that it is called
        /// from.
        threads: usize,
    }

    /// Check the settings against a system.
    ///
    /// # Errors
    /// [`Error::BasinsBars`], [`Error::BasinsAngle`], [`Error::BasinsJoint`], [`Error::Refused`], [`Error::Memory`].
    pub fn check(&self, problem: &Problem) -> Result<(), Error> {
        Budget::default().fits(u64::from(self.size).pow(2).saturating_mul(BYTES_PER_START))?;
        if let Some(chain) = problem.row() {
            return self.axes(chain.chain().bars().len()).map(|_| ());
        }
        let system = problem.system();
        system.refusal()?;
        self.moved(&system).map(|_| ())
    }

    /// Run all starts.
    ///
    /// # Errors
    /// [`Error::BasinsBars`], [`Error::BasinsAngle`] and [`Error::BasinsJoint`] for settings out of
    /// range, [`Error::Sweep`] for chains without a list of equilibria, the errors of
    /// [`Solve`](crate::Solve) for other systems.
    pub fn run(&self, problem: &Problem) -> Result<BasinsAnswer, Error> {
        self.check(problem)?;
        let Some(chain) = problem.row() else { return self.over_places(problem) };
        let bars = chain.chain().bars().len();
        let [i, j] = self.axes(bars)?;
        let axis = |bar: usize| {
            if bar == i || bar == j {
                Axis::full(u64::from(self.size))
            } else {
                Axis::fixed(self.others_deg.to_radians())
            }
        };
        let source = Source::Grid((1..=bars).map(axis).collect());
        let settings = Settings { source, ..Settings::default() };
        let size = u64::from(self.size);
        threads::on(self.threads, || {
            let sweep = sweep::Sweep::new(chain, settings, solvers(chain)?)?;
            let [mut lagrange, mut energy] = [Outcomes::default(), Outcomes::default()];
            let mut add = |row: Chunk| {
                for (all, name) in [(&mut lagrange, "lagrange"), (&mut energy, "energy")] {
                    let Some(part) = row.of(name) else { continue };
                    all.outcome.extend(&part.outcome);
                    all.iterations.extend(&part.iterations);
                }
            };
            let proven = sweep.members().list().iter();
            let mut discovered = Discovered::default();
            match sweep.nothing_reached() {
                None => {
                    let rows: Vec<_> = (0..size)
                        .into_par_iter()
                        .map(|row| sweep.run_chunk(row * size..(row + 1) * size))
                        .collect();
                    rows.into_iter().for_each(add);
                }
                Some(mut reached) => {
                    sweep.run_chunks(0..size * size, size, &mut reached, &mut add);
                    for outcomes in [&mut lagrange, &mut energy] {
                        discovered = reached.renumber(outcomes);
                    }
                }
            }
            let names = proven.chain(&discovered.equilibria).enumerate().map(name).collect();
            let fixed = if bars > 2 {
                format!("; all other bars start at {}\u{b0}", self.others_deg)
            } else {
                String::new()
            };
            let label = |bar: usize| format!("start of bar {bar} from the vertical / \u{b0}");
            let over = Over {
                labels: [label(i), label(j)],
                ranges: [[0.0, 360.0]; 2],
                unit: Unit::Degrees,
                fixed,
            };
            let title = chain.chain().name().to_owned();
            Ok(BasinsAnswer { size: self.size, over, title, names, lagrange, energy })
        })?
    }

    /// Run all starts over the place of a joint.
    fn over_places(&self, problem: &Problem) -> Result<BasinsAnswer, Error> {
        threads::on(self.threads, || {
            let known = equilibria::all(problem, CENSUS_BARS)?;
            let both = FromPlaces(validate::Solvers::Both);
            let starts = Followed::new(problem, &known, 1, both)?;
            let system = &starts.system;
            let joint = self.moved(system)?;
            let hanging: Vec<Vector> =
                known.list.first().map(|one| one.found.joints_m.clone()).unwrap_or_default();
            let reach_m = longest_m(system, joint);
            let axes = self.plane.axes();
            let ranges = axes.map(|(k, _)| {
                let middle = hanging[joint][k];
                [middle - reach_m, middle + reach_m]
            });
            let side = u64::from(self.size);
            let grid = ranges.map(|[from_rad, to_rad]| Axis { from_rad, to_rad, points: side });
            let follow = |seed: u64| {
                let mut places = hanging.clone();
                for ((k, _), (axis, at)) in
                    axes.iter().zip(grid.iter().zip([seed % side, seed / side]))
                {
                    places[joint][*k] = axis.at(at);
                }
                both.from(system, &places)
            };
            let ends: Vec<_> = (0..side * side).into_par_iter().map(follow).collect();
            let [lagrange, energy] = <[Outcomes; 2]>::try_from(starts.outcomes(&ends))
                .unwrap_or_else(|_| unreachable!("both solvers are asked"));
            let name_of = system.joints()[joint].name.to_string();
            let over = Over {
                labels: axes.map(|(_, axis)| format!("start of joint {name_of}: {axis} / m")),
                ranges,
                unit: Unit::Decimal,
                fixed: "; all other joints start where they hang".to_owned(),
            };
            let names = starts.list().iter().enumerate().map(name).collect();
            let title = system.name().to_owned();
            Ok(BasinsAnswer { size: self.size, over, title, names, lagrange, energy })
        })?
    }

    /// The joint that is moved.
    fn moved(&self, system: &System) -> Result<usize, Error> {
        let is_free =
            |joint: &model::system::Joint| !matches!(joint.support, Support::Fixed { .. });
        let wanted = |joint: &model::system::Joint| match &self.joint {
            Some(name) => joint.name == *name,
            None => true,
        };
        let found = system.joints().iter().position(|joint| is_free(joint) && wanted(joint));
        found.ok_or_else(|| Error::BasinsJoint(self.joint.clone().unwrap_or_default()))
    }

    /// Processor time that the starts take, s: from a few starts, good to a factor of three.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn expected_time_s(&self, problem: &Problem) -> Result<f64, Error> {
        let starts = u64::from(self.size).pow(2);
        match problem.row() {
            Some(chain) => {
                Ok(sweep::expected_time_s(chain, &Settings::default(), &solvers(chain)?, starts)?)
            }
            None => crate::Sweep::new(starts).expected_time_s(problem),
        }
    }

    /// The two bars of the axes, the lower first: the grid runs along it.
    fn axes(&self, bars: usize) -> Result<[usize; 2], Error> {
        let [i, j] = self.bars;
        if i == j || ![i, j].iter().all(|bar| (1..=bars).contains(bar)) {
            return Err(Error::BasinsBars { axes: self.bars, bars });
        }
        if !self.others_deg.is_finite() {
            return Err(Error::BasinsAngle(self.others_deg));
        }
        Ok([i.min(j), i.max(j)])
    }
}

/// The longest member at a joint, m.
fn longest_m(system: &System, joint: usize) -> f64 {
    let members = system.members().iter();
    let at = members.filter(|member| member.path().any(|other| other == joint));
    at.map(|member| member.body.length_m()).fold(0.0, f64::max)
}

/// Where every start led.
#[derive(Debug, Clone, PartialEq)]
pub struct BasinsAnswer {
    size: u32,
    over: Over,
    title: String,
    names: Vec<String>,
    lagrange: Outcomes,
    energy: Outcomes,
}

/// What the axes of a picture are, and what does not vary.
#[derive(Debug, Clone, PartialEq)]
struct Over {
    labels: [String; 2],
    ranges: [[f64; 2]; 2],
    unit: Unit,
    fixed: String,
}

impl BasinsAnswer {
    /// Number of starts.
    pub fn starts(&self) -> u64 {
        u64::from(self.size).pow(2)
    }

    /// What the two axes are, with their unit.
    pub fn labels(&self) -> &[String; 2] {
        &self.over.labels
    }

    /// Where each axis begins and ends, degrees or m; a start is the middle of its part.
    pub fn ranges(&self) -> [[f64; 2]; 2] {
        self.over.ranges
    }

    /// The equilibria that outcomes 0, 1, 2, ... stand for, in words.
    pub fn equilibria(&self) -> &[String] {
        &self.names
    }

    /// Where the starts of a solver led.
    pub fn outcomes(&self, solver: &SolverName) -> Option<&Outcomes> {
        match solver.as_str() {
            "lagrange" => Some(&self.lagrange),
            "energy" => Some(&self.energy),
            _ => None,
        }
    }

    /// Starts from which a solver reached no equilibrium.
    pub fn failed(&self, solver: &SolverName) -> usize {
        let all = self.outcomes(solver).into_iter().flat_map(|all| &all.outcome);
        all.filter(|outcome| **outcome < 0).count() - self.unlisted(solver)
    }

    /// Starts from which a solver reached an equilibrium that is in no list.
    pub fn unlisted(&self, solver: &SolverName) -> usize {
        let all = self.outcomes(solver).into_iter().flat_map(|all| &all.outcome);
        all.filter(|outcome| **outcome == Failure::Unlisted as i16).count()
    }

    /// The picture of one solver as SVG.
    ///
    /// # Errors
    /// [`Error::Basins`] when the solver was not asked.
    pub fn svg(&self, solver: &SolverName, field: Field) -> Result<String, Error> {
        let none = Outcomes::default();
        let outcomes = self.outcomes(solver).unwrap_or(&none);
        let what = match field {
            Field::Outcome => "equilibrium reached",
            Field::Iterations => "iterations spent",
        };
        let (size, Over { labels, ranges, unit, fixed }) = (self.size, &self.over);
        let note = format!("{what} by {solver} from {size} \u{d7} {size} starts{fixed}");
        let picture = sweep::Basins {
            size,
            outcomes,
            names: &self.names,
            title: &self.title,
            note: &note,
            labels: [&labels[0], &labels[1]],
            ranges: *ranges,
            unit: *unit,
        };
        Ok(picture.svg(field)?)
    }
}

/// An equilibrium in the legend: its number from 1, energy and kind.
fn name((number, member): (usize, &Member)) -> String {
    let kind = match member.index() {
        Some(0) => ", minimum",
        Some(_) => ", no minimum",
        None => "",
    };
    let mirrored = if member.mirrored { " (mirror image)" } else { "" };
    format!("{}: {:.4} J{kind}{mirrored}", number + 1, member.energy_j)
}
