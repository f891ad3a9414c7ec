//! A census of so many equilibria that only what tells them apart is kept.
//!
//! A chain of twenty bars has millions of equilibria, and angles, joints and forces of one take
//! thousands of bytes. All of them follow from the signs of the bars and the pull: so those are
//! kept, 120 bytes whatever the number of bars, with what is proved of the index; and everything
//! else is made from them when it is asked for. A [`Census`] is the same with all of it made.

use std::borrow::Cow;
use std::time::Instant;

use model::{Chain, Equilibrium, Problem};
use numerics::atan2;

use crate::branch_and_bound::worked;
use crate::error::CensusError;
use crate::run::check::CheckError;
use crate::run::closure::Pattern;
use crate::run::count::morse::alternating_sum;
use crate::run::count::topology::Topology;
use crate::run::enclosure::krawczyk::Zero;
use crate::run::enclosure::polish::{PreciseSystem, polish};
use crate::run::equilibrium::inertia::Indices;
use crate::run::equilibrium::{Observed, Proof, ProvenEquilibrium};
use crate::run::estimate::refuse_long;
use crate::run::plane::loads::JointLoads;
use crate::run::plane::system::System;
use crate::run::position::Position;
use crate::run::search::merge::{Zeros, merge};
use crate::run::search::undecided::{Reason, Undecided, gather};
use crate::run::search::{Progress, Search, Settled, search};
use crate::run::slack::families::families;
use crate::run::slack::moments::Exact;
use crate::run::slack::straight::Straight;
use crate::run::slack::unloaded::unloaded;
use crate::run::{Census, Statistics, by_energy_and_angles};
use crate::settings::Settings;

/// Below so many equilibria, threads cost more than they save: each takes tens of microseconds.
const WORTH_THREADS: usize = 64;

/// All equilibria of a chain, each in 120 bytes; in the order of a [`Census`], and equal to it.
///
/// ```
/// use census::{Census, CompactCensus, Settings};
/// let problem = model::cases::get("three-bars-off-centre").ok_or("a case")?.problem();
/// let compact = CompactCensus::take(&problem, &Settings::default(), &|_| {})?;
/// let census = Census::take(&problem, &Settings::default())?;
/// assert!(compact.complete() && compact.check(&problem).is_ok());
/// let all: Vec<_> = (0..compact.len()).map(|k| compact.equilibrium(k)).collect();
/// assert_eq!(all, census.equilibria);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct CompactCensus {
    system: System,
    records: Vec<Record>,
    /// Those with a bar that carries next to nothing: whole.
    unloaded: Vec<ProvenEquilibrium>,
    besides: Census,
}

/// What is kept of an equilibrium.
#[derive(Debug, Clone, Copy)]
struct Record {
    /// Middles of the energy, J, and of the angle of bar 1, rad, by which the list is in order.
    energy_j: f64,
    first_angle: f64,
    in_plane: u8,
    out_of_plane: u8,
    optimal: bool,
    place: Place,
}

/// Where an equilibrium is.
#[derive(Debug, Clone, Copy)]
enum Place {
    /// At a zero of the closure of a pattern, a circle on the side that is shown.
    Pull { pattern: Pattern, zero: Zero, condition: f64 },
    /// In the list of those with a bar that carries next to nothing.
    Unloaded(u32),
}

impl CompactCensus {
    /// Take the census of a chain, and tell `watch` of the progress.
    ///
    /// # Errors
    ///
    /// As [`Census::take`].
    pub fn take(
        problem: &Problem,
        settings: &Settings,
        watch: &dyn Fn(Progress),
    ) -> Result<Self, CensusError> {
        Self::of_chain(problem.chain(), JointLoads::NONE, settings, watch)
    }

    /// Take the census of a chain with loads at its joints.
    pub(crate) fn of_chain(
        chain: &Chain,
        loads: &JointLoads,
        settings: &Settings,
        watch: &dyn Fn(Progress),
    ) -> Result<Self, CensusError> {
        let start = Instant::now();
        settings.validate()?;
        refuse_long(chain, loads, settings)?;
        let system = System::new(chain, loads);
        let exact = Exact::new(chain, loads);
        let unloaded = unloaded(&system, &exact);
        let straight = Straight::of(&system, &exact);
        let settled = Settled { unloaded: &unloaded, straight: &straight };
        let patterns: Vec<Pattern> = (0..1_u32 << system.bars()).map(Pattern).collect();
        let mut search = search(&system, settings, &settled, &patterns, watch);
        let (zeros, unclear) = merge(&system, std::mem::take(&mut search.found));
        let (mut records, without_index) =
            records(&system, &PreciseSystem::new(chain, loads, &system), zeros);
        let unloaded = unloaded.equilibria;
        records.extend((0..).zip(&unloaded).map(|(k, e)| Record::of_unloaded(k, e)));
        let (families, maybe) = families(&system, exact.sides.as_ref());
        let besides = Census {
            equilibria: vec![],
            families,
            straight: straight.positions,
            undecided: undecided(
                &system,
                &mut search,
                [(Reason::Unclear, unclear), (Reason::Index, without_index)],
                maybe,
            ),
            complete: false,
            circles: system.vertical,
            topology: Topology::of_system(&system),
            statistics: Statistics {
                bars: system.bars(),
                cells: search.cells,
                tests: search.tests,
                proofs: search.proofs,
                levels: search.batches,
                seconds: 0.0,
            },
        };
        let mut compact = Self { system, records: vec![], unloaded, besides };
        records.sort_by(|a, b| {
            let quickly = a.energy_j.total_cmp(&b.energy_j);
            quickly
                .then(a.first_angle.total_cmp(&b.first_angle))
                .then_with(|| by_energy_and_angles(&compact.whole(a), &compact.whole(b)))
        });
        compact.records = records;
        compact.besides.complete = compact.decided() && compact.besides.may_be_complete();
        compact.besides.statistics.seconds = start.elapsed().as_secs_f64();
        Ok(compact)
    }

    /// Number of isolated equilibria, or of circles.
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// One equilibrium, numbered from 0, with everything that is proved about it.
    ///
    /// # Panics
    ///
    /// If there is no such number.
    pub fn equilibrium(&self, number: usize) -> ProvenEquilibrium {
        self.whole(&self.records[number])
    }

    /// The positions of one equilibrium, numbered from 0, in one vertical plane: as
    /// [`Census::positions`].
    ///
    /// # Panics
    ///
    /// If there is no such number.
    pub fn positions(&self, number: usize) -> impl Iterator<Item = Position> + use<> {
        Position::of(self.equilibrium(number), number + 1)
    }

    /// As [`Census::position_to_model`].
    pub fn position_to_model(&self, position: &Position) -> Equilibrium {
        self.besides.one_to_model(&position.equilibrium, self.count_in_plane())
    }

    /// The first equilibria, and everything else of the census: a list that is cut off.
    pub fn first(&self, number: usize) -> Census {
        let shown = &self.records[..number.min(self.len())];
        let equilibria = worked(shown, shown.len(), WORTH_THREADS, |record| self.whole(record));
        Census { equilibria, ..self.besides.clone() }
    }

    /// Everything of the census but its list of isolated equilibria, which is empty there.
    pub fn besides(&self) -> &Census {
        &self.besides
    }

    /// As [`Census::complete`].
    pub fn complete(&self) -> bool {
        self.besides.complete
    }

    /// As [`Census::decided`].
    pub fn decided(&self) -> bool {
        self.besides.is_decided_with(&self.count_by_index())
    }

    /// As [`Census::count_in_plane`].
    pub fn count_in_plane(&self) -> usize {
        self.records.len() * if self.besides.circles { 2 } else { 1 }
    }

    /// As [`Census::count_by_index`].
    pub fn count_by_index(&self) -> Vec<i64> {
        self.besides.count_of(self.records.iter().map(|record| record.in_plane.into()))
    }

    /// As [`Census::alternating_sum`].
    pub fn alternating_sum(&self) -> i64 {
        alternating_sum(&self.count_by_index())
    }

    /// As [`Census::figure`].
    pub fn figure(&self, name: &str, limit: usize) -> String {
        let first = self.first(limit);
        let shown: Vec<Position> = first.positions().take(limit).collect();
        first.figure_of(name, &shown, self.count_in_plane())
    }

    /// Judge this census of a chain, as [`Census::check`].
    ///
    /// # Errors
    ///
    /// The first thing that is wrong or not proved, as [`CheckError`].
    pub fn check(&self, problem: &Problem) -> Result<(), CheckError> {
        self.check_chain(problem.chain(), JointLoads::NONE)
    }

    /// Judge this census of a chain with loads at its joints.
    pub(crate) fn check_chain(&self, chain: &Chain, loads: &JointLoads) -> Result<(), CheckError> {
        let at = |number: usize| Cow::Owned(self.equilibrium(number));
        self.besides.check_list(chain, loads, self.len(), &at)
    }

    fn whole(&self, record: &Record) -> ProvenEquilibrium {
        match record.place {
            Place::Unloaded(k) => self.unloaded[k as usize].clone(),
            Place::Pull { pattern, zero, condition } => {
                let signs: Vec<i8> = pattern.signs(self.system.bars()).collect();
                let observed = Observed::at(&self.system, &signs, &zero.tight);
                let indices = Indices {
                    in_plane: record.in_plane.into(),
                    out_of_plane: record.out_of_plane.into(),
                    condition,
                };
                let proof = Proof { shown: zero, observed, indices, optimal: record.optimal };
                proof.assemble(&self.system, &signs)
            }
        }
    }
}

/// What is kept of the zeros of the closure, and those of which an index or a finite pull is not proved.
fn records(system: &System, precise: &PreciseSystem, zeros: Zeros) -> (Vec<Record>, Zeros) {
    let one = |(pattern, zero): &(Pattern, Zero)| {
        let signs: Vec<i8> = pattern.signs(system.bars()).collect();
        let zero = polish(system, precise, &signs, zero);
        Record::of(system, *pattern, &signs, &zero).ok_or((*pattern, zero))
    };
    let made = worked(&zeros, zeros.len(), WORTH_THREADS, one);
    drop(zeros);
    let (mut records, mut without_index) = (Vec::with_capacity(made.len()), vec![]);
    for result in made {
        match result {
            Ok(record) => records.push(record),
            Err(open) => without_index.push(open),
        }
    }
    (records, without_index)
}

/// All that a search could not decide: cells, zeros, slack families that may or may not exist.
fn undecided(
    system: &System,
    search: &mut Search,
    zeros: [(Reason, Zeros); 2],
    maybe: Vec<Vec<i8>>,
) -> Vec<Undecided> {
    let mut all = vec![];
    for task in gather(std::mem::take(&mut search.undecided)) {
        let reason = if search.exhausted {
            Reason::Budget
        } else if task.cell.is_at_unloaded_bar() {
            Reason::Unloaded
        } else {
            Reason::Degenerate
        };
        all.push(Undecided::new(system, reason, &task.cell, &task.patterns));
    }
    for (reason, zeros) in zeros {
        let open = |(pattern, zero): (Pattern, Zero)| {
            Undecided::new(system, reason, &zero.tight, &[pattern])
        };
        all.extend(zeros.into_iter().map(open));
    }
    all.extend(maybe.into_iter().map(|signs| Undecided::slack(system, signs)));
    all
}

impl Record {
    fn of(system: &System, pattern: Pattern, signs: &[i8], zero: &Zero) -> Option<Self> {
        let Proof { shown, observed, indices, optimal } = Proof::of(system, signs, zero)?;
        let [x, z] = observed.directions.first().copied()?;
        Some(Self {
            energy_j: observed.energy_j(system).mid(),
            first_angle: atan2(x, -z).mid(),
            in_plane: u8::try_from(indices.in_plane).ok()?,
            out_of_plane: u8::try_from(indices.out_of_plane).ok()?,
            optimal,
            place: Place::Pull { pattern, zero: shown, condition: indices.condition },
        })
    }

    fn of_unloaded(number: u32, whole: &ProvenEquilibrium) -> Self {
        let small = |index: usize| u8::try_from(index).unwrap_or(u8::MAX);
        Self {
            energy_j: whole.energy_j.mid(),
            first_angle: whole.angles_rad.first().map_or(0.0, |angle| angle.mid()),
            in_plane: small(whole.index_in_plane),
            out_of_plane: small(whole.index_out_of_plane),
            optimal: whole.optimal,
            place: Place::Unloaded(number),
        }
    }
}

#[cfg(test)]
mod tests {
    use numerics::Interval;

    use super::*;

    fn taken(case: &str) -> (Problem, CompactCensus) {
        let problem = model::cases::get(case).unwrap().problem();
        let compact = CompactCensus::take(&problem, &Settings::default(), &|_| {}).unwrap();
        assert_eq!(compact.check(&problem), Ok(()));
        (problem, compact)
    }

    /// What the check says after a change.
    fn said(case: &str, change: impl Fn(&mut CompactCensus)) -> Result<(), CheckError> {
        let (problem, mut compact) = taken(case);
        change(&mut compact);
        compact.check(&problem)
    }

    fn pull(record: &mut Record) -> (&mut Pattern, &mut Zero) {
        match &mut record.place {
            Place::Pull { pattern, zero, .. } => (pattern, zero),
            Place::Unloaded(_) => panic!("no bar of this chain is unloaded"),
        }
    }

    /// Every record of a chain of five bars, damaged in every way.
    #[test]
    fn a_damaged_record_is_caught() {
        const CASE: &str = "five-in-space";
        let count = taken(CASE).1.len();
        let number = |k: usize| k + 1;
        for k in 0..count {
            let index = Err(CheckError::Index { number: number(k) });
            assert_eq!(said(CASE, |c| c.records[k].in_plane += 1), index);
            assert_eq!(said(CASE, |c| c.records[k].out_of_plane += 2), index);
            assert_eq!(said(CASE, |c| c.records[k].optimal ^= true), index);
            let wrong = |quantity| Err(CheckError::Wrong { number: number(k), quantity });
            let moved = said(CASE, |c| {
                let (_, zero) = pull(&mut c.records[k]);
                let width = zero.tight.at[0].width();
                zero.tight.at[0] = zero.tight.at[0] + Interval::point(100.0 * width);
            });
            assert_eq!(moved, wrong("the pull"));
            assert!(said(CASE, |c| pull(&mut c.records[k]).0.0 ^= 1).is_err());
            let missing = said(CASE, |c| {
                c.records.remove(k);
            });
            assert!(missing.is_err());
            let twice = said(CASE, |c| c.records.insert(k, c.records[k]));
            assert_eq!(twice, Err(CheckError::Order { number: number(k) + 1 }));
        }
        let swapped = said(CASE, |c| c.records.swap(0, 1));
        assert_eq!(swapped, Err(CheckError::Order { number: 2 }));
    }

    #[test]
    fn claims_besides_the_list_are_held_against_the_chain() {
        let claim = |change: &dyn Fn(&mut CompactCensus)| {
            let said = said("three-equal-bars", change);
            assert!(matches!(said, Err(CheckError::Claim { .. })), "{said:?}");
        };
        claim(&|c| c.besides.circles = false);
        claim(&|c| c.besides.statistics.bars = 4);
        let side = said("three-equal-bars", |c| {
            let (_, zero) = pull(&mut c.records[0]);
            let [tight, alone_in] = [zero.tight, zero.alone_in].map(|cell| cell.mirrored());
            *zero = Zero { tight, alone_in };
        });
        assert!(matches!(side, Err(CheckError::Wrong { number: 1, .. })), "{side:?}");
    }
}
