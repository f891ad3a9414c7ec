//! Many positions released: which of them comes to rest where.

use std::ops::Range;
use std::path::Path;

use model::Vector;
use model::system::System;
use motion::{Order, Simulation};
use sweep::{Chunk, Compute as _, Failure, Manifest, Release, Run, RunSettings, Shard};

use crate::equilibria;
use crate::error::Error;
use crate::followed::{End, Follow, Followed};
use crate::problem::Problem;
use crate::simulate::{CENSUS_BARS, Simulate, SimulateError};
use crate::sweep::{Format, Sweep, SweptBy};

/// Releases a system from many positions at random, and tells where each comes to rest.
///
/// ```
/// use funicular::prelude::*;
/// // The chain of the paper has one circle of stable positions: all releases end there.
/// let problem = Problem::case("three-equal-bars")?;
/// let damped = Simulate::new().time_s(60.0).step_s(5e-3).damping_1_s(3.0);
/// let prepared = Ensemble::new(damped, 4).prepare(&problem)?;
/// let ends = prepared.run(0..4);
/// assert_eq!(ends.of("motion").unwrap().outcome, [0; 4]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Ensemble {
    simulate: Simulate,
    /// How many there are, and what is written of them.
    rows: Sweep,
}

/// At rest are joints that are slower than this times `sqrt(g L)` and gain less speed than this
/// times `g`: they are then about as near to an equilibrium, in total lengths.
const REST: f64 = 1e-7;

/// Looks at whether it is at rest.
const LOOKS: u64 = 256;

impl Ensemble {
    /// So many positions at random, each released at rest and followed as `simulate` says: its
    /// damping, step and longest time. Its start, pushes and stored times mean nothing here.
    pub fn new(simulate: Simulate, seeds: u64) -> Self {
        Self { simulate, rows: Sweep::new(seeds) }
    }

    /// The number that all positions come from (1); another one gives others.
    #[must_use]
    pub fn number(self, number: u64) -> Self {
        Self { rows: self.rows.number(number), ..self }
    }

    /// Only one of several parts, to be joined by [`merge`](sweep::merge).
    #[must_use]
    pub fn shard(self, shard: Shard) -> Self {
        Self { rows: self.rows.shard(shard), ..self }
    }

    /// The form of the rows.
    #[must_use]
    pub fn format(self, format: Format) -> Self {
        Self { rows: self.rows.format(format), ..self }
    }

    /// Make the list of places where the system may come to rest: the equilibria of a complete
    /// census; elsewhere the stable one, and where 256 other positions come to rest.
    ///
    /// # Errors
    /// [`Error::Simulate`] without any damping, when nothing comes to rest, and for times out of
    /// range; [`Error::Motion`] when the system cannot be moved; the errors of
    /// [`Solve`](crate::Solve).
    pub fn prepare(&self, problem: &Problem) -> Result<PreparedEnsemble, Error> {
        let system = problem.system();
        let settings = self.simulate.settings;
        settings.validate()?;
        if settings.damping_1_s.max(settings.friction_n_m_s) <= 0.0 {
            return Err(SimulateError::NoDamping.into());
        }
        let (steps, _) = self.simulate.steps()?;
        let found = equilibria::all(problem, CENSUS_BARS)?;
        // What cannot be moved is refused here, and is not the fate of every position.
        if let Some(first) = found.list.first() {
            Simulation::new(&system, &first.found.joints_m, settings)?
                .parts_of(self.simulate.time_s / steps as f64)?;
        }
        let steps_per_look = steps.div_ceil(LOOKS).max(1);
        let step_s = self.simulate.time_s / steps as f64;
        let released =
            Released { settings, step_s, steps_per_look, looks: steps.div_ceil(steps_per_look) };
        let compute = Followed::new(problem, &found, self.rows.number, released)?;
        let release = Release {
            time_s: self.simulate.time_s,
            step_s,
            span_s: step_s * steps_per_look as f64,
            damping_1_s: settings.damping_1_s,
            friction_n_m_s: settings.friction_n_m_s,
            order: match settings.order {
                Order::Second => 2,
                Order::Fourth => 4,
                Order::Eighth => 8,
            },
            rest: REST,
        };
        let of = SweptBy::places(&compute, "released", found.complete);
        let manifest = Manifest { release: Some(release), ..self.rows.manifest(of) };
        Ok(PreparedEnsemble { compute, manifest })
    }
}

/// An ensemble with its list of places, ready to run.
#[derive(Debug, Clone)]
pub struct PreparedEnsemble {
    compute: Followed<Released>,
    manifest: Manifest,
}

impl PreparedEnsemble {
    /// Everything that the rows depend on, as the folder will say it.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// What becomes of these positions.
    pub fn run(&self, seeds: Range<u64>) -> Chunk {
        self.compute.chunk(seeds)
    }

    /// Write a row per position into a folder, or go on with one.
    ///
    /// # Errors
    /// [`Error::Store`]; the folder is left as it was if it holds something else.
    pub fn write(&self, folder: &Path, settings: &RunSettings<'_>) -> Result<Run, Error> {
        Ok(sweep::run(folder, &self.manifest, &self.compute, settings)?)
    }
}

/// Follows what is released.
#[derive(Debug, Clone)]
struct Released {
    settings: motion::Settings,
    step_s: f64,
    steps_per_look: u64,
    looks: u64,
}

impl Released {
    /// Release a position; none when there is none, or a step cannot be taken.
    fn release(&self, system: &System, position: u64) -> Option<End> {
        let at = motion::random_position(system, position).ok()?;
        let mut simulation = Simulation::new(system, &at, self.settings).ok()?;
        let mut end = End::failed(Failure::IterationLimit);
        for look in 1..=self.looks {
            for _ in 0..self.steps_per_look {
                simulation.step(self.step_s).ok()?;
            }
            end.steps = u16::try_from(look).unwrap_or(u16::MAX);
            end.residual = unrest(system, &mut simulation);
            if end.residual <= REST {
                end.joints_m = Ok(simulation.joints_m());
                break;
            }
        }
        end.energy_j = simulation.potential_j();
        Some(end)
    }
}

/// Largest acceleration in units of gravity, or largest speed in units of `sqrt(g L)`.
fn unrest(system: &System, simulation: &mut Simulation) -> f64 {
    let largest = |vectors: &[Vector]| {
        let squares = vectors.iter().map(|v| v.iter().map(|x| x * x).sum::<f64>());
        // NaN is kept, and is no rest.
        squares.fold(0.0, |most: f64, x| if most.is_nan() || x <= most { most } else { x }).sqrt()
    };
    let gravity = system.gravity_m_s2();
    let speed = largest(&simulation.velocities_m_s());
    let speed = speed / (gravity * system.total_length_m()).sqrt();
    // Accelerations cost as much as a step: they are asked for where it is slow.
    if speed.is_nan() || speed > REST {
        return speed;
    }
    let gain = largest(&simulation.snapshot().accelerations_m_s2) / gravity;
    if gain.is_nan() || gain > speed { gain } else { speed }
}

impl Follow for Released {
    fn names(&self) -> Vec<&'static str> {
        vec!["motion"]
    }

    fn follow(&self, system: &System, start: u64) -> Vec<End> {
        vec![self.release(system, start).unwrap_or_else(|| End::failed(Failure::Stalled))]
    }
}
