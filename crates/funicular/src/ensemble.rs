//! Many positions released: which of them comes to rest where.

use std::ops::Range;
use std::path::Path;

use model::Vector;
use model::system::System;
use motion::{Order, Simulation};
use rayon::prelude::*;
use sweep::{
    Chunk, Compute, Failure, Manifest, Member, Origin, Outcomes, Release, Run, RunSettings,
    SCHEMA_VERSION, Shard, Stream, SystemText,
};

use crate::equilibria::{self, Located, system_of};
use crate::error::Error;
use crate::problem::Problem;
use crate::resting::Resting;
use crate::simulate::{CENSUS_BARS, Simulate, SimulateError};
use crate::sweep::Format;

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
    seeds: u64,
    number: u64,
    shard: Shard,
    format: Format,
}

/// At rest are joints that are slower than this times `sqrt(g L)` and gain less speed than this
/// times `g`: they are then about as near to an equilibrium, in total lengths.
const REST: f64 = 1e-7;

/// Looks at whether it is at rest.
const LOOKS: u64 = 256;

/// Positions released, beside those asked for, to learn where a system without a census comes to
/// rest.
const DISCOVER: u64 = 256;

/// Seed number of these positions: always the same, whatever the ensemble.
const DISCOVERY: u64 = 0x0065_6e73_656d_626c;

impl Ensemble {
    /// So many positions at random, each released at rest and followed as `simulate` says: its
    /// damping, step and longest time. Its start, pushes and stored times mean nothing here.
    #[must_use]
    pub fn new(simulate: Simulate, seeds: u64) -> Self {
        Self { simulate, seeds, number: 1, shard: Shard::WHOLE, format: Format::default() }
    }

    /// The number that all positions come from (1); another one gives others.
    #[must_use]
    pub fn number(self, number: u64) -> Self {
        Self { number, ..self }
    }

    /// Only one of several parts, to be joined by [`merge`](sweep::merge).
    #[must_use]
    pub fn shard(self, shard: Shard) -> Self {
        Self { shard, ..self }
    }

    /// The form of the rows.
    #[must_use]
    pub fn format(self, format: Format) -> Self {
        Self { format, ..self }
    }

    /// Make the list of places where the system may come to rest: the equilibria of a complete
    /// census; elsewhere the stable one, and where 256 other positions come to rest.
    ///
    /// # Errors
    ///
    /// [`Error::Simulate`] without any damping, when nothing comes to rest, and for times out of
    /// range; [`Error::Motion`] when the system cannot be moved; the errors of
    /// [`Solve`](crate::Solve).
    pub fn prepare(&self, problem: &Problem) -> Result<PreparedEnsemble, Error> {
        let system = system_of(problem);
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
        let text = match problem.as_chain() {
            Some(chain) => SystemText::of(chain.chain()),
            None => SystemText::from(&system),
        };
        let steps_per_look = steps.div_ceil(LOOKS).max(1);
        let step_s = self.simulate.time_s / steps as f64;
        let mut compute = Released {
            settings,
            step_s,
            steps_per_look,
            looks: steps.div_ceil(steps_per_look),
            rest: Resting::new(&system, found.list.iter().map(|one| &one.found.joints_m[..])),
            positions: Stream::new(self.number),
            system,
        };
        let mut list: Vec<Member> = found.list.iter().map(|e| listed(e, found.complete)).collect();
        if !found.complete {
            compute.discover(&mut list);
        }
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
        let manifest = Manifest {
            schema_version: SCHEMA_VERSION,
            program: concat!("funicular ", env!("CARGO_PKG_VERSION")).to_owned(),
            system: text,
            seeds: self.seeds,
            seed_number: self.number,
            source: "released".to_owned(),
            solvers: vec![MOTION.to_owned()],
            release: Some(release),
            angles: Vec::new(),
            equilibria: list,
            equilibria_complete: found.complete,
            format: self.format.name().to_owned(),
            part_seeds: 0,
            shard: Shard::WHOLE,
            range: 0..0,
        }
        .with_shard(self.shard);
        Ok(PreparedEnsemble { compute, manifest })
    }
}

/// Who finds the outcomes, in the columns.
const MOTION: &str = "motion";

/// An equilibrium as an entry of the list.
fn listed(located: &Located, is_proven: bool) -> Member {
    let Located { label, found } = located;
    Member {
        origin: if is_proven { Origin::Proven } else { Origin::Discovered },
        energy_j: found.energy_j,
        angles_rad: Vec::new(),
        index_in_plane: found.stability.index_in_plane,
        mirrored: label.ends_with('\''),
        joints_m: Some(found.joints_m.clone()),
    }
}

/// An ensemble with its list of places, ready to run.
#[derive(Debug, Clone)]
pub struct PreparedEnsemble {
    compute: Released,
    manifest: Manifest,
}

impl PreparedEnsemble {
    /// Everything that the rows depend on, as the folder will say it.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// What becomes of these positions.
    #[must_use]
    pub fn run(&self, seeds: Range<u64>) -> Chunk {
        self.compute.chunk(seeds)
    }

    /// Write a row per position into a folder, or go on with one.
    ///
    /// # Errors
    ///
    /// [`Error::Store`]; the folder is left as it was if it holds something else.
    pub fn write(&self, folder: &Path, settings: &RunSettings<'_>) -> Result<Run, Error> {
        Ok(sweep::run(folder, &self.manifest, &self.compute, settings)?)
    }
}

/// Follows what is released.
#[derive(Debug, Clone)]
struct Released {
    system: System,
    settings: motion::Settings,
    step_s: f64,
    steps_per_look: u64,
    looks: u64,
    positions: Stream,
    rest: Resting,
}

/// How one release ended.
struct End {
    outcome: i16,
    looks: u16,
    residual: f64,
    energy_j: f64,
}

/// Where a release came to rest, or did not.
struct Followed {
    simulation: Simulation,
    looks: u16,
    residual: f64,
    is_at_rest: bool,
}

impl Released {
    /// Release a position; none when there is none, or a step cannot be taken.
    fn follow(&self, position: u64) -> Option<Followed> {
        let at = motion::random_position(&self.system, position).ok()?;
        let mut simulation = Simulation::new(&self.system, &at, self.settings).ok()?;
        let mut residual = f64::INFINITY;
        for look in 1..=self.looks {
            for _ in 0..self.steps_per_look {
                simulation.step(self.step_s).ok()?;
            }
            residual = self.unrest(&mut simulation);
            if residual <= REST {
                let looks = u16::try_from(look).unwrap_or(u16::MAX);
                return Some(Followed { simulation, looks, residual, is_at_rest: true });
            }
        }
        let looks = u16::try_from(self.looks).unwrap_or(u16::MAX);
        Some(Followed { simulation, looks, residual, is_at_rest: false })
    }

    /// Largest acceleration in units of gravity, or largest speed in units of `sqrt(g L)`.
    fn unrest(&self, simulation: &mut Simulation) -> f64 {
        let largest = |vectors: &[Vector]| {
            let squares = vectors.iter().map(|v| v.iter().map(|x| x * x).sum::<f64>());
            // NaN is kept, and is no rest.
            squares
                .fold(0.0, |most: f64, x| if most.is_nan() || x <= most { most } else { x })
                .sqrt()
        };
        let gravity = self.system.gravity_m_s2();
        let speed = largest(&simulation.velocities_m_s());
        let speed = speed / (gravity * self.system.total_length_m()).sqrt();
        // Accelerations cost as much as a step: they are asked for where it is slow.
        if speed.is_nan() || speed > REST {
            return speed;
        }
        let gain = largest(&simulation.snapshot().accelerations_m_s2) / gravity;
        if gain.is_nan() || gain > speed { gain } else { speed }
    }

    fn end(&self, position: u64) -> End {
        let Some(followed) = self.follow(position) else {
            let outcome = Failure::Stalled as i16;
            return End { outcome, looks: 0, residual: f64::INFINITY, energy_j: f64::NAN };
        };
        let outcome = if followed.is_at_rest {
            let place = self.rest.nearest(&followed.simulation.joints_m());
            place.and_then(|place| i16::try_from(place).ok()).unwrap_or(Failure::Unlisted as i16)
        } else {
            Failure::IterationLimit as i16
        };
        End {
            outcome,
            looks: followed.looks,
            residual: followed.residual,
            energy_j: followed.simulation.potential_j(),
        }
    }

    /// Add to the list where other positions come to rest.
    fn discover(&mut self, list: &mut Vec<Member>) {
        let others = Stream::new(DISCOVERY);
        let follow = |k| self.follow(others.at(k)).filter(|followed| followed.is_at_rest);
        let ends: Vec<Option<(f64, Vec<Vector>)>> = (0..DISCOVER)
            .into_par_iter()
            .map(|k| follow(k).map(|end| (end.simulation.potential_j(), end.simulation.joints_m())))
            .collect();
        let mut found: Vec<(f64, Vec<Vector>)> = ends.into_iter().flatten().collect();
        // Stable: of equal energies the first released.
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (energy_j, joints_m) in found {
            if self.rest.nearest(&joints_m).is_none() {
                self.rest.add(&joints_m);
                list.push(Member {
                    origin: Origin::Discovered,
                    energy_j,
                    angles_rad: Vec::new(),
                    index_in_plane: None,
                    mirrored: false,
                    joints_m: Some(joints_m),
                });
            }
        }
    }
}

/// Positions followed at a time: a fraction of a second.
const CHUNK: u64 = 64;

impl Compute for Released {
    fn chunk_seeds(&self) -> u64 {
        CHUNK
    }

    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        // In the pool of whoever asks: threads without a part of their own help.
        let ends: Vec<End> =
            seeds.clone().into_par_iter().map(|seed| self.end(self.positions.at(seed))).collect();
        let outcomes = Outcomes {
            solver: MOTION.to_owned(),
            outcome: ends.iter().map(|end| end.outcome).collect(),
            iterations: ends.iter().map(|end| end.looks).collect(),
            residual: ends.iter().map(|end| end.residual).collect(),
            energy_j: ends.iter().map(|end| end.energy_j).collect(),
        };
        Chunk { seeds, outcomes: vec![outcomes] }
    }

    fn angles(&self, _: Range<u64>) -> Vec<Vec<f64>> {
        Vec::new()
    }
}
