//! A census of so many equilibria that only what tells them apart is kept.
//!
//! A chain of twenty bars has millions of equilibria, and angles, joints and forces of one take
//! thousands of bytes. All of them follow from the signs of the bars and the pull: so those are
//! kept, 120 bytes whatever the number of bars, with what is proved of the index; and everything
//! else is made from them when it is asked for, to the same bits as in a [`Census`].

use model::{Chain, Equilibrium, Problem};
use numerics::{Interval, atan2};
use rayon::prelude::*;

use crate::census::check::{CheckError, zero_again};
use crate::census::check_bounds::check_bounds;
use crate::census::estimate::Kept;
use crate::census::gathered::Gathered;
use crate::census::position::Position;
use crate::census::{Census, by_energy_and_angles};
use crate::closure::Pattern;
use crate::count::morse::MorseError;
use crate::enclosure::krawczyk::Zero;
use crate::enclosure::polish::PreciseSystem;
use crate::equilibrium::inertia::Indices;
use crate::equilibrium::{Observed, Proof, ProvenEquilibrium};
use crate::error::CensusError;
use crate::plane::cell::Cell;
use crate::plane::loads::JointLoads;
use crate::plane::system::System;
use crate::search::Progress;
use crate::settings::Settings;
use crate::slack::moments::Exact;

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
    by_index: Vec<i64>,
    besides: Census,
}

/// What is kept of an equilibrium.
#[derive(Debug, Clone, Copy)]
struct Record {
    energy_j: Interval,
    /// Middle of the angle of bar 1, rad.
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

/// One equilibrium without what follows from its signs and its pull.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// +1 for each bar in tension, −1 in compression, 0 for one that carries next to nothing.
    pub signs: Vec<i8>,
    /// Potential energy above the height of joint 0.
    pub energy_j: Interval,
    /// Pull of the chain on the first anchor, along the horizontal direction and along Z.
    pub pull_n: [Interval; 2],
    /// Morse index among the motions in the vertical plane.
    pub index_in_plane: usize,
    /// Morse index among the motions out of the plane.
    pub index_out_of_plane: usize,
    /// Whether no configuration in space has less energy.
    pub optimal: bool,
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
        let mut gathered = Gathered::of(chain, loads, settings, Kept::Compact, watch)?;
        let unloaded = gathered.take_unloaded();
        let mut records = gathered.each(Record::of);
        let (system, besides) = gathered.finish();
        records.extend((0..).zip(&unloaded).map(|(k, e)| Record::of_unloaded(k, e)));
        let by_index = besides.count_of(records.iter().map(|one| usize::from(one.in_plane)));
        let mut compact = Self { system, records: vec![], unloaded, by_index, besides };
        records.par_sort_by(|a, b| {
            let quickly = a.energy_j.mid().total_cmp(&b.energy_j.mid());
            quickly
                .then(a.first_angle.total_cmp(&b.first_angle))
                .then_with(|| by_energy_and_angles(&compact.whole(a), &compact.whole(b)))
        });
        compact.records = records;
        let besides = &mut compact.besides;
        besides.complete = besides.is_decided_with(&compact.by_index) && besides.may_be_complete();
        Ok(compact)
    }

    /// Number of isolated equilibria, or of circles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// One equilibrium, numbered from 0, with everything that is proved about it.
    ///
    /// # Panics
    ///
    /// If there is no such number.
    #[must_use]
    pub fn equilibrium(&self, number: usize) -> ProvenEquilibrium {
        self.whole(&self.records[number])
    }

    /// One equilibrium, numbered from 0, without what takes long to derive.
    ///
    /// # Panics
    ///
    /// If there is no such number.
    ///
    /// ```
    /// use census::{CompactCensus, Settings};
    /// let compact = CompactCensus::take(&model::cases::paper(), &Settings::default(), &|_| {})?;
    /// let (outline, whole) = (compact.outline(0), compact.equilibrium(0));
    /// assert_eq!((outline.signs, outline.pull_n), (whole.signs, whole.pull_n));
    /// # Ok::<(), census::CensusError>(())
    /// ```
    #[must_use]
    pub fn outline(&self, number: usize) -> Outline {
        let record = &self.records[number];
        let (signs, pull_n) = match record.place {
            Place::Unloaded(k) => {
                let whole = &self.unloaded[k as usize];
                (whole.signs.clone(), whole.pull_n)
            }
            Place::Pull { pattern, zero, .. } => (
                pattern.signs(self.system.bars()).collect(),
                self.system.pull_on_anchor_n(zero.tight.pull(&self.system)),
            ),
        };
        Outline {
            signs,
            energy_j: record.energy_j,
            pull_n,
            index_in_plane: record.in_plane.into(),
            index_out_of_plane: record.out_of_plane.into(),
            optimal: record.optimal,
        }
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
    #[must_use]
    pub fn position_to_model(&self, position: &Position) -> Equilibrium {
        self.besides.one_to_model(&position.equilibrium, self.count_in_plane())
    }

    /// The first equilibria, and everything else of the census: a list that is cut off.
    #[must_use]
    pub fn first(&self, number: usize) -> Census {
        let shown = self.records.iter().take(number).map(|record| self.whole(record));
        Census { equilibria: shown.collect(), ..self.besides.clone() }
    }

    /// Everything of the census but its list of isolated equilibria, which is empty there.
    #[must_use]
    pub fn besides(&self) -> &Census {
        &self.besides
    }

    /// As [`Census::complete`].
    #[must_use]
    pub fn complete(&self) -> bool {
        self.besides.complete
    }

    /// As [`Census::decided`].
    #[must_use]
    pub fn decided(&self) -> bool {
        self.besides.is_decided_with(&self.by_index)
    }

    /// As [`Census::count_in_plane`].
    #[must_use]
    pub fn count_in_plane(&self) -> usize {
        self.records.len() * if self.besides.circles { 2 } else { 1 }
    }

    /// As [`Census::count_by_index`].
    #[must_use]
    pub fn count_by_index(&self) -> &[i64] {
        &self.by_index
    }

    /// As [`Census::alternating_sum`].
    #[must_use]
    pub fn alternating_sum(&self) -> i64 {
        self.besides.alternating_sum_of(&self.by_index)
    }

    /// As [`Census::morse`].
    ///
    /// # Errors
    ///
    /// [`MorseError`] for the first inequality that fails.
    pub fn morse(&self) -> Result<(), MorseError> {
        self.besides.morse_of(&self.by_index)
    }

    /// As [`Census::figure`].
    #[must_use]
    pub fn figure(&self, name: &str, limit: usize) -> String {
        let first = self.first(limit);
        let shown: Vec<Position> = first.positions().take(limit).collect();
        first.figure_of(name, &shown, self.count_in_plane())
    }

    /// Judge this census of a chain, as [`Census::check`]: every neighbourhood is proved again to
    /// hold exactly one zero, from which index and energy are made again.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong or not proved, as [`CheckError`].
    pub fn check(&self, problem: &Problem) -> Result<(), CheckError> {
        self.check_chain(problem.chain(), JointLoads::NONE)
    }

    /// Judge this census of a chain with loads at its joints.
    pub(crate) fn check_chain(&self, chain: &Chain, loads: &JointLoads) -> Result<(), CheckError> {
        let bars = chain.bars().len();
        if bars != self.besides.statistics.bars || bars != self.system.bars() {
            return Err(CheckError::Claim { quantity: "the number of bars" });
        }
        let system = System::new(chain, loads);
        let precise = PreciseSystem::new(chain, loads, &system);
        let exact = Exact::new(chain, loads);
        // Equilibria with an unloaded bar are few: those are judged with everything that is listed.
        let whole =
            Census { equilibria: self.unloaded.clone(), complete: false, ..self.besides.clone() };
        whole.check_each(&system, &precise)?;
        let one = |(k, record): (usize, &Record)| record.check(&precise, &system, k + 1);
        self.records.par_iter().enumerate().map(one).collect::<Result<(), _>>()?;
        self.check_order()?;
        self.besides.check_claims(&system, &exact)?;
        check_bounds(&self.besides, &system, &exact, &|signs| {
            let of_signs = |place: &Place| match place {
                Place::Pull { pattern, zero, .. } => {
                    pattern.signs(bars).eq(signs.iter().copied()).then_some(zero.alone_in)
                }
                Place::Unloaded(_) => None,
            };
            let equal = self.records.iter().enumerate();
            equal
                .filter_map(|(k, record)| Some((k, of_signs(&record.place)?)))
                .map(|(k, around)| zero_again(&precise, &system, k + 1, signs, around))
                .collect()
        })?;
        let by_index = self.records.iter().map(|record| usize::from(record.in_plane));
        if self.by_index != self.besides.count_of(by_index) {
            return Err(CheckError::Claim { quantity: "the number of equilibria by index" });
        }
        if self.besides.undecided.is_empty() {
            self.morse()?;
        }
        if self.besides.complete {
            self.besides.extremes(|index| {
                self.records.iter().filter(|one| usize::from(one.out_of_plane) == index).count()
            })?;
        }
        Ok(())
    }

    /// Whether no equilibrium is listed twice, and all are in order.
    fn check_order(&self) -> Result<(), CheckError> {
        let order = |number| Err(CheckError::Order { number });
        for (k, pair) in self.records.windows(2).enumerate() {
            let [a, b] = pair else { continue };
            let quickly = a.energy_j.mid().total_cmp(&b.energy_j.mid());
            let by_angle = quickly.then(a.first_angle.total_cmp(&b.first_angle));
            let ascends = by_angle.is_lt()
                || by_angle.is_eq() && by_energy_and_angles(&self.whole(a), &self.whole(b)).is_lt();
            if !ascends {
                return order(k + 2);
            }
        }
        // The same equilibrium twice would have overlapping pulls and equal signs.
        let mut by_pattern: Vec<(Pattern, u32)> = (0..)
            .zip(&self.records)
            .filter_map(|(k, record)| match record.place {
                Place::Pull { pattern, .. } => Some((pattern, k)),
                Place::Unloaded(_) => None,
            })
            .collect();
        by_pattern.sort_unstable();
        for group in by_pattern.chunk_by(|(a, _), (b, _)| a == b).filter(|group| group.len() > 1) {
            let pulls: Vec<_> =
                group.iter().map(|(_, k)| self.outline(*k as usize).pull_n).collect();
            for (j, pull) in pulls.iter().enumerate() {
                let overlaps = |other: &[Interval; 2]| (0..2).all(|i| !other[i].disjoint(pull[i]));
                if pulls[..j].iter().any(overlaps) {
                    return order(group[j].1 as usize + 1);
                }
            }
        }
        Ok(())
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

impl Record {
    fn of(system: &System, signs: &[i8], zero: &Zero) -> Option<Self> {
        let compressed = signs.iter().enumerate().filter(|(_, sign)| **sign < 0);
        let pattern = Pattern(compressed.map(|(bar, _)| Pattern::bit(signs.len(), bar)).sum());
        let Proof { shown, observed, indices, optimal } = Proof::of(system, signs, zero)?;
        let [x, z] = observed.directions.first().copied()?;
        Some(Self {
            energy_j: observed.energy_j(system),
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
            energy_j: whole.energy_j,
            first_angle: whole.angles_rad.first().map_or(0.0, |angle| angle.mid()),
            in_plane: small(whole.index_in_plane),
            out_of_plane: small(whole.index_out_of_plane),
            optimal: whole.optimal,
            place: Place::Unloaded(number),
        }
    }

    /// The record against what is proved again.
    fn check(
        &self,
        precise: &PreciseSystem,
        system: &System,
        number: usize,
    ) -> Result<(), CheckError> {
        let Place::Pull { pattern, zero, .. } = self.place else { return Ok(()) };
        let signs: Vec<i8> = pattern.signs(system.bars()).collect();
        let again = zero_again(precise, system, number, &signs, zero.alone_in)?;
        let proved =
            Self::of(system, &signs, &again).ok_or(CheckError::IndexNotProved { number })?;
        let (stated, known) = (self.claims(), proved.claims());
        if stated != known {
            return Err(CheckError::Index { number });
        }
        let wrong = |quantity| Err(CheckError::Wrong { number, quantity });
        if system.vertical && self.first_angle <= 0.0 {
            return wrong("the side of the circle that is shown");
        }
        if self.energy_j.disjoint(proved.energy_j) {
            return wrong("the energy");
        }
        let Place::Pull { zero: known, .. } = proved.place else { return Ok(()) };
        // A neighbourhood holds one zero alone: if the pull is in it, it is that one.
        if !zero.alone_in.encloses(&zero.tight) || apart(&zero.tight, &known.tight) {
            return wrong("the pull");
        }
        Ok(())
    }

    fn claims(&self) -> (u8, u8, bool) {
        (self.in_plane, self.out_of_plane, self.optimal)
    }
}

/// Whether two enclosures, on one face, have nothing in common.
fn apart(a: &Cell, b: &Cell) -> bool {
    a.face == b.face && a.disjoint(b)
}

#[cfg(test)]
mod tests {
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
            let energy = said(CASE, |c| {
                c.records[k].energy_j = c.records[k].energy_j + Interval::point(1e-9);
            });
            assert_eq!(energy, wrong("the energy"));
            let moved = said(CASE, |c| {
                let (_, zero) = pull(&mut c.records[k]);
                let width = zero.tight.at[0].width();
                zero.tight.at[0] = zero.tight.at[0] + Interval::point(3.0 * width);
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

    /// Listed twice with another energy, the order alone does not tell.
    #[test]
    fn the_same_pull_twice_is_caught_wherever_it_stands() {
        let said = said("five-in-space", |c| {
            let mut again = c.records[0];
            again.energy_j = Interval::new(again.energy_j.lo(), again.energy_j.hi().next_up());
            let at = usize::from(again.energy_j.mid() > c.records[0].energy_j.mid());
            again.first_angle += if at == 0 { -1e-9 } else { 1e-9 };
            c.records.insert(at, again);
        });
        assert!(matches!(said, Err(CheckError::Order { .. })), "{said:?}");
    }

    #[test]
    fn claims_besides_the_list_are_held_against_the_chain() {
        let claim = |change: &dyn Fn(&mut CompactCensus)| {
            let said = said("three-equal-bars", change);
            assert!(matches!(said, Err(CheckError::Claim { .. })), "{said:?}");
        };
        claim(&|c| c.by_index[0] += 1);
        claim(&|c| c.besides.circles = false);
        claim(&|c| c.besides.statistics.bars = 4);
        let side = said("three-equal-bars", |c| c.records[0].first_angle *= -1.0);
        assert!(matches!(side, Err(CheckError::Wrong { number: 1, .. })), "{side:?}");
    }
}
