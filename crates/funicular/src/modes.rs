//! Small oscillations about equilibria.

use model::Vector;
use model::budget::{BYTES_PER_MEMBER_IN_MODES, BYTES_PER_MODE};
use model::system::System;
use motion::{Direction, What};
use serde::Serialize;

use crate::enclosed::{Enclosed, enclose};
use crate::equilibria::{self, Equilibria, Located};
use crate::error::Error;
use crate::object::{SCHEMA_VERSION, Summary};
use crate::problem::Problem;
use crate::threads;

/// Finds the frequencies and shapes of small oscillations, and the rates at which a system leaves
/// its unstable equilibria: of all equilibria of a chain where a census is complete, of the stable
/// one otherwise.
///
/// Inextensible cables and struts are bars in small motions where they certainly bear a force, and
/// hold nothing where they are slack; joints that a floor pushes slide in its level; what is
/// neither is refused. Bars whose moments of inertia across differ have their second axis level.
///
/// ```
/// use funicular::prelude::*;
/// // Two bars of 1 m between level anchors swing about them like a plate: ω² = M g h / J with
/// // M = 2 kg, the centre h = √3/4 m below the axis, and J = 2 (√3/2)²/3 = 1/2 kg m².
/// let problem = Problem::parse(
///     "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
///      bars = [{ length_m = 1, mass_kg = 1, count = 2 }]",
///     "two.toml",
/// )?;
/// let found = Modes::new().run(&problem)?;
/// assert!(found.complete && found.indices_agree());
/// let hanging = &found.equilibria[0];
/// let told = 2.0 * 9.80665 * (3.0_f64.sqrt() / 4.0) / 0.5;
/// assert!((hanging.modes[0].omega2_s2 - told).abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Modes {
    max_bars: usize,
    lowest: Option<usize>,
    threads: usize,
}

/// Systems of at most so many joints have all their modes found where nothing else is asked for.
const ALL_JOINTS: usize = 100;

/// Modes found of larger systems where nothing else is asked for.
const LOWEST: usize = 20;

impl Default for Modes {
    fn default() -> Self {
        Self { max_bars: census::Settings::UNASKED_BARS, lowest: None, threads: 0 }
    }
}

impl Modes {
    /// A census for chains of up to eight bars.
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// Take a census of chains of up to so many bars; 0 takes none.
        max_bars: usize,
        /// How many threads share the census, 0 (the default) for those of the pool that it is called
        /// from. The answer does not depend on it.
        threads: usize,
        /// Find so many modes of each equilibrium, the lowest: negative `ω²` first. Without it all
        /// modes of systems of up to 100 joints, and the lowest 20 of larger ones.
        ///
        /// ```
        /// use funicular::prelude::*;
        /// let problem = Problem::parse(
        ///     "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
        ///      bars = [{ length_m = 0.01, mass_kg = 0.01, count = 200 }]",
        ///     "long.toml",
        /// )?;
        /// let found = Modes::new().lowest(4).run(&problem)?;
        /// let hanging = &found.equilibria[0];
        /// // 199 joints, two directions, 200 lengths kept in the plane.
        /// assert_eq!((hanging.modes.len(), hanging.modes_in_all), (4, 199 + 198));
        /// # Ok::<(), Error>(())
        /// ```
        lowest: usize => Some(lowest),
    }

    /// Find equilibria and their modes.
    ///
    /// # Errors
    /// [`Error::Motion`] when the system cannot be moved, and the errors of
    /// [`Solve`](crate::Solve).
    pub fn run(&self, problem: &Problem) -> Result<ModesAnswer, Error> {
        threads::on(self.threads, || {
            self.fits(problem)?;
            self.of(problem, &equilibria::all(problem, self.max_bars)?)
        })?
    }

    /// Chains of how many bars a census is taken of.
    pub(crate) fn most_bars(&self) -> usize {
        self.max_bars
    }

    fn fits(&self, problem: &Problem) -> Result<(), Error> {
        let modes = self.lowest.unwrap_or(LOWEST) as u64;
        problem.fits(modes.saturating_mul(BYTES_PER_MODE).saturating_add(BYTES_PER_MEMBER_IN_MODES))
    }

    /// The modes of known equilibria.
    pub(crate) fn of(&self, problem: &Problem, found: &Equilibria) -> Result<ModesAnswer, Error> {
        self.fits(problem)?;
        let system = problem.system();
        let equilibria = found.list.iter().map(|located| self.with_modes(&system, located));
        Ok(ModesAnswer {
            schema_version: SCHEMA_VERSION,
            system: Summary::new(&system),
            equilibria: equilibria.collect::<Result<_, _>>()?,
            complete: found.complete,
            is_neighbour: found.is_neighbour,
        })
    }

    fn with_modes(&self, system: &System, located: &Located) -> Result<WithModes, Error> {
        let Located { label, found: equilibrium } = located;
        let (joints_m, axial_n) = (&equilibrium.joints_m, Some(&equilibrium.axial_n[..]));
        let is_large = system.joints().len() > ALL_JOINTS;
        let found = match self.lowest.or(is_large.then_some(LOWEST)) {
            Some(count) => motion::lowest_modes(system, joints_m, axial_n, count)?,
            None => motion::modes(system, joints_m, axial_n)?,
        };
        let (enclosed, between) = enclose(system, joints_m, &equilibrium.axial_n);
        let joints = system.joints().iter().zip(joints_m);
        let joints =
            joints.map(|(joint, at_m)| JointAt { name: joint.name.to_string(), at_m: *at_m });
        Ok(WithModes {
            label: label.clone(),
            solver: equilibrium.solver.clone(),
            energy_j: equilibrium.energy_j,
            joints: joints.collect(),
            index_in_space: equilibrium.stability.index_in_space,
            index_by_modes: enclosed.index().unwrap_or_else(|| found.index()),
            out_of_balance: found.out_of_balance,
            modes_in_all: found.total,
            modes: with_enclosures(system, found.modes, &enclosed, &between),
            enclosed,
        })
    }
}

/// Equilibria with their modes, as `funicular modes --json` prints them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModesAnswer {
    /// Version of this object as JSON.
    pub schema_version: u32,
    /// What was asked about.
    pub system: Summary,
    /// The equilibria, by energy.
    pub equilibria: Vec<WithModes>,
    /// Whether a census proves that there are no others.
    pub complete: bool,
    /// Whether the equilibrium is the neighbour of the shape that is drawn; true where none is.
    pub is_neighbour: bool,
}

/// One equilibrium with its modes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WithModes {
    /// Its number in the census, with a prime for a mirror image; `1` for the stable one.
    pub label: String,
    /// Who found it.
    pub solver: model::SolverName,
    /// Potential energy, J, as the solvers have it.
    pub energy_j: f64,
    /// The joints: names and places.
    pub joints: Vec<JointAt>,
    /// Number of directions in which the energy falls, by who found it.
    pub index_in_space: usize,
    /// The same by the signs of the modes, as they are proved where they are.
    pub index_by_modes: usize,
    /// Largest force left over at a joint, relative to the largest force.
    pub out_of_balance: f64,
    /// How many modes there are, listed or not.
    pub modes_in_all: usize,
    /// Whether interval arithmetic proves the frequencies.
    pub enclosed: Enclosed,
    /// The modes by ascending `ω²`, zero and negative ones included: all, or the lowest; that none
    /// below the last is left out is counted by Sylvester's law of inertia.
    pub modes: Vec<Mode>,
}

/// A joint and its place.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointAt {
    /// Its name.
    pub name: String,
    /// Its place, world frame, m.
    pub at_m: Vector,
}

/// One mode.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mode {
    /// `ω²`, 1/s²; negative where it leaves the equilibrium.
    pub omega2_s2: f64,
    /// Within this of it the linearised equations have an `ω²`, but for rounding, 1/s².
    pub residual_s2: f64,
    /// The `ω²` is proved to lie between these, 1/s², where the frequencies are enclosed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub omega2_between_s2: Option<[f64; 2]>,
    /// Displacement of each joint, the largest of length 1; of the spin of a bar all are zero.
    pub shape: Vec<Vector>,
    /// What it is, in words.
    pub what: String,
    /// Frequency, Hz, of an oscillation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Rate at which the system leaves, 1/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate_1_s: Option<f64>,
}

impl ModesAnswer {
    /// Whether the signs of the modes, proved by interval arithmetic where they are, give each equilibrium the index that its
    /// solver gives it.
    pub fn indices_agree(&self) -> bool {
        self.equilibria.iter().all(|found| found.index_in_space == found.index_by_modes)
    }
}

/// Modes with the enclosures of their `ω²`: the k-th smallest of both are of each other, and what is
/// proved is what is shown. Spins of bars stand behind the negative ones, and are zero by their
/// meaning.
fn with_enclosures(
    system: &System,
    modes: Vec<motion::Mode>,
    enclosed: &Enclosed,
    between: &[[f64; 2]],
) -> Vec<Mode> {
    let is_reached = matches!(enclosed, Enclosed::Reached { .. });
    let mut next = between.iter().copied();
    let with = |mode: motion::Mode| {
        let is_spin = matches!(mode.what, What::Spin { .. });
        let spin = (is_spin && is_reached).then_some([0.0; 2]);
        let omega2_between_s2 = if is_spin { spin } else { next.next() };
        let mode = match omega2_between_s2 {
            Some(ends) if !is_spin => within(system, mode, ends),
            _ => mode,
        };
        Mode {
            what: words(&mode),
            frequency_hz: mode.frequency_hz(),
            rate_1_s: mode.rate_1_s(),
            omega2_s2: mode.omega2_s2,
            residual_s2: mode.residual_s2,
            omega2_between_s2,
            shape: mode.shape,
        }
    };
    modes.into_iter().map(with).collect()
}

/// A mode with a number in its enclosure, and called what the enclosure proves: the solver's zero
/// has a threshold, the proof has none.
fn within(system: &System, mut mode: motion::Mode, [low, high]: [f64; 2]) -> motion::Mode {
    let omega2_s2 = mode.omega2_s2.clamp(low, high);
    mode.residual_s2 += (omega2_s2 - mode.omega2_s2).abs();
    mode.omega2_s2 = omega2_s2;
    let is_named = matches!(mode.what, What::Turn { .. } | What::Neutral);
    if low > 0.0 {
        mode.what = What::Oscillation;
    } else if high < 0.0 {
        mode.what = What::Leaving;
    } else if omega2_s2.abs() <= 0.0 && !is_named {
        mode.what = only_turn(system).unwrap_or(What::Neutral);
    }
    mode
}

/// The turn about a vertical that the supports leave to the system, if there is one alone.
fn only_turn(system: &System) -> Option<What> {
    let parts = system.parts();
    let mut axes = parts.iter().filter_map(|part| part.axis_m);
    let axis_m = axes.next()?;
    axes.next().is_none().then_some(What::Turn { axis_m })
}

/// What a mode is, in words.
fn words(mode: &motion::Mode) -> String {
    let what = match mode.what {
        What::Oscillation => "oscillation",
        What::Leaving => "leaves the equilibrium",
        What::Turn { axis_m: [x, y] } => {
            return format!("turn about the vertical at x = {x} m, y = {y} m");
        }
        What::Spin { member } => return format!("spin of bar {} about its axis", member + 1),
        _ => "neutral",
    };
    let direction = match mode.direction {
        Direction::InPlane => " in the plane",
        Direction::Across => " across the plane",
        Direction::Space => "",
    };
    format!("{what}{direction}")
}
