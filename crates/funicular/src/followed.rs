//! Many places at random, each followed to where it ends: by motion until it is at rest
//! ([`Ensemble`](crate::Ensemble)), or by the solvers ([`Sweep`](crate::Sweep) of a system).

use std::ops::Range;
use std::sync::Arc;

use model::Vector;
use model::system::System;
use rayon::prelude::*;
use sweep::{Chunk, Compute, Failure, Member, Origin, Outcomes, Stream, Summary, SystemText};

use validate::systems::energy_size_j;

use crate::equilibria::{Equilibria, Located};
use crate::error::Error;
use crate::problem::Problem;
use crate::resting::Resting;

/// Starts beside those asked for, from which the list of a system without a complete census is made.
const DISCOVER: u64 = 256;

/// Seed number of these starts: always the same, whatever is asked for.
const DISCOVERY: u64 = 0x0065_6e73_656d_626c;

/// Starts followed at a time: a fraction of a second.
const CHUNK: u64 = 64;

/// How a start is followed.
pub(crate) trait Follow: Sync {
    /// Who follows it: a name for each end.
    fn names(&self) -> Vec<&'static str>;

    /// Where the start of this number leads, by each of them.
    fn follow(&self, system: &System, start: u64) -> Vec<End>;
}

/// Where a start led.
#[derive(Debug, Clone)]
pub(crate) struct End {
    /// The places of the joints, world frame, m, if it is an equilibrium.
    pub joints_m: Result<Vec<Vector>, Failure>,
    /// What it took: iterations, or looks at what moves.
    pub steps: u16,
    pub residual: f64,
    pub energy_j: f64,
    /// Directions in which the energy falls, if they were counted.
    pub index: Option<usize>,
}

impl End {
    /// No equilibrium.
    pub(crate) fn failed(failure: Failure) -> Self {
        let joints_m = Err(failure);
        Self { joints_m, steps: 0, residual: f64::INFINITY, energy_j: f64::NAN, index: None }
    }
}

/// Starts of a system, with the list that their ends are numbered by.
#[derive(Debug, Clone)]
pub(crate) struct Followed<F> {
    pub system: Arc<System>,
    follow: F,
    starts: Stream,
    list: Vec<Member>,
    places: Resting,
    text: SystemText,
}

impl<F: Follow> Followed<F> {
    /// With the list of what is known, and where that is not complete of what other starts lead to.
    ///
    /// # Errors
    /// [`Error::Refused`] when the system has no equilibrium.
    pub(crate) fn new(
        problem: &Problem,
        known: &Equilibria,
        number: u64,
        follow: F,
    ) -> Result<Self, Error> {
        let system = problem.system();
        system.refusal()?;
        let places = Resting::new(&system, known.list.iter().map(|one| &one.found.joints_m[..]));
        let list = known.list.iter().map(|one| listed(one, known.complete)).collect();
        let mut text = SystemText::from(&*system);
        if let Some(one) = known.list.first() {
            text.unit_j = energy_size_j(&system, &one.found);
        }
        let starts = Stream::new(number);
        let mut all = Self { system, follow, starts, list, places, text };
        if !known.complete {
            all.discover();
        }
        Ok(all)
    }

    /// The equilibria that outcomes 0, 1, 2, ... stand for.
    pub(crate) fn list(&self) -> &[Member] {
        &self.list
    }

    /// The system as text, with the unit of its energies: loads and prestress times the length.
    pub(crate) fn text(&self) -> SystemText {
        self.text.clone()
    }

    /// The names of the columns.
    pub(crate) fn names(&self) -> Vec<String> {
        self.follow.names().into_iter().map(str::to_owned).collect()
    }

    /// What becomes of these starts, counted.
    pub(crate) fn count(&self, seeds: Range<u64>, watch: &(dyn Fn(u64) + Sync)) -> Summary {
        let mut summary = Summary::new(&self.list, self.text.unit_j);
        for first in seeds.clone().step_by(usize::try_from(CHUNK).unwrap_or(1)) {
            let next = first.saturating_add(CHUNK).min(seeds.end);
            summary.add(&self.chunk(first..next));
            watch(next - seeds.start);
        }
        summary
    }

    /// Add to the list where other starts end.
    fn discover(&mut self) {
        let others = Stream::new(DISCOVERY);
        let follow = |k| self.follow.follow(&self.system, others.at(k));
        let ends = (0..DISCOVER).into_par_iter().flat_map_iter(follow);
        let mut found: Vec<End> = ends.filter(|end| end.joints_m.is_ok()).collect();
        // Stable: of equal energies the first.
        found.sort_by(|a, b| a.energy_j.total_cmp(&b.energy_j));
        for End { joints_m, energy_j, index, .. } in found {
            let Ok(joints_m) = joints_m else { continue };
            if let Some(place) = self.places.nearest(&joints_m) {
                let known = &mut self.list[place].index_in_space;
                *known = known.or(index);
                continue;
            }
            self.places.add(&joints_m);
            self.list.push(Member {
                origin: Origin::Discovered,
                energy_j,
                angles_rad: Vec::new(),
                index_in_plane: None,
                index_in_space: index,
                mirrored: false,
                joints_m: Some(joints_m),
            });
        }
    }

    /// As columns, what each of them made of some starts.
    pub(crate) fn outcomes(&self, ends: &[Vec<End>]) -> Vec<Outcomes> {
        let of = |(k, solver): (usize, String)| {
            let ends = || ends.iter().filter_map(|ends| ends.get(k));
            Outcomes {
                solver,
                outcome: ends().map(|end| self.outcome(end)).collect(),
                iterations: ends().map(|end| end.steps).collect(),
                residual: ends().map(|end| end.residual).collect(),
                energy_j: ends().map(|end| end.energy_j).collect(),
            }
        };
        self.names().into_iter().enumerate().map(of).collect()
    }

    fn outcome(&self, end: &End) -> i16 {
        let place = match &end.joints_m {
            Ok(joints_m) => self.places.nearest(joints_m).ok_or(Failure::Unlisted),
            Err(failure) => Err(*failure),
        };
        let code = place.map(|place| i16::try_from(place).unwrap_or(Failure::Unlisted as i16));
        code.unwrap_or_else(|failure| failure as i16)
    }
}

/// An equilibrium as an entry of the list.
fn listed(located: &Located, is_proven: bool) -> Member {
    let Located { label, found } = located;
    Member {
        origin: if is_proven { Origin::Proven } else { Origin::Discovered },
        energy_j: found.energy_j,
        angles_rad: Vec::new(),
        index_in_plane: found.stability.index_in_plane,
        index_in_space: Some(found.stability.index_in_space),
        mirrored: label.ends_with('\''),
        joints_m: Some(found.joints_m.clone()),
    }
}

impl<F: Follow> Compute for Followed<F> {
    fn chunk_seeds(&self) -> u64 {
        CHUNK
    }

    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        // In the pool of whoever asks: threads without a part of their own help.
        let follow = |seed| self.follow.follow(&self.system, self.starts.at(seed));
        let ends: Vec<Vec<End>> = seeds.clone().into_par_iter().map(follow).collect();
        Chunk { seeds, outcomes: self.outcomes(&ends) }
    }

    fn angles(&self, _: Range<u64>) -> Vec<Vec<f64>> {
        Vec::new()
    }
}
