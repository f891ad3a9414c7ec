//! The equilibria that seeds reach where no census has them all, listed as the seeds go.
//!
//! A list keeps the lowest. So the lists of parts make the list of the whole, in whatever groups
//! they are joined: what is among the lowest of all is among the lowest of its part.

use model::Problem;
use serde::{Deserialize, Serialize};

use crate::identify::{
    ENERGY_TOLERANCE, Lookup, Member, Members, Origin, by_energy_and_angles, directions_of,
};
use crate::record::{Chunk, Failure, Outcomes};

/// Most discovered equilibria in a list. In a long chain nearly every seed of the first solver
/// reaches another one: a list of those identifies nothing, and each costs as much text as a
/// thousand rows.
pub const DISCOVERED: usize = 1000;

/// Most bars of all discovered equilibria in a list: ten megabytes of text.
const DISCOVERED_BARS: usize = 1 << 19;

/// What seeds reached beside what is proved.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Discovered {
    /// By energy, then by angles. They are numbered behind the proven ones.
    pub equilibria: Vec<Member>,
    /// Energy, J, from which on nothing is listed: more than [`DISCOVERED`] were reached, and these
    /// are the lowest. None where all that were reached are listed.
    pub below_j: Option<f64>,
}

impl Discovered {
    /// Whether it can be the list of a chain of so many bars.
    pub(crate) fn fits(&self, bars: usize) -> bool {
        let whole = |member: &Member| {
            let angles = &member.angles_rad;
            let known = angles.iter().all(|angle| angle.is_some_and(f64::is_finite));
            angles.len() == bars && known && member.energy_j.is_finite()
        };
        self.equilibria.len() <= Members::MOST
            && self.equilibria.iter().all(whole)
            && self.equilibria.is_sorted_by(|a, b| by_energy_and_angles(a, b).is_le())
    }
}

/// A list that grows: whatever converges within no tolerance of an entry is the next one, until
/// there are more than [`DISCOVERED`]. Then the lowest stay, up to a gap between energies, so that
/// of two that differ by rounding alone (mirror images) both stay or none.
///
/// Numbers are given in the order of coming; [`renumber`](Self::renumber) leads to those of the final
/// list, which is in order of energy.
#[derive(Debug, Clone)]
pub struct Reached {
    /// Entries that the census has proved: the numbers before.
    proven: usize,
    most: usize,
    lookup: Lookup,
    /// In order of energy, as in `lookup`.
    list: Vec<Member>,
    /// What each was numbered by, from 0.
    numbers: Vec<usize>,
    given: usize,
    /// Energy from which on nothing is listed, J.
    below_j: f64,
}

impl Reached {
    /// Nothing yet, behind so many proven entries.
    pub(crate) fn new(problem: &Problem, proven: usize) -> Self {
        let lookup = Lookup::new(problem, &[]);
        let most = DISCOVERED.min(DISCOVERED_BARS / lookup.bars().max(1)).max(1);
        Self {
            proven,
            most: most.min(Members::MOST.saturating_sub(proven)),
            lookup,
            list: vec![],
            numbers: vec![],
            given: 0,
            below_j: f64::INFINITY,
        }
    }

    /// Nothing of the same sweep.
    pub(crate) fn nothing(&self) -> Self {
        let mut nothing = self.clone();
        nothing.lookup.truncate(0);
        nothing.list.clear();
        nothing.numbers.clear();
        Self { given: 0, below_j: f64::INFINITY, ..nothing }
    }

    /// How many are listed by now.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether nothing is listed.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// All outcomes that stand for an equilibrium are below this.
    pub(crate) fn codes(&self) -> usize {
        self.proven + self.given
    }

    pub(crate) fn given(&self) -> usize {
        self.given
    }

    /// Entries whose numbers were given from `given` on.
    pub(crate) fn since(&self, given: usize) -> impl Iterator<Item = &Member> {
        let all = self.list.iter().zip(&self.numbers);
        all.filter(move |(_, number)| **number >= given).map(|(member, _)| member)
    }

    /// The code of where a seed converged, for unit directions (along the heading, up) of the bars
    /// and the index of what the solver finds, if that is known.
    pub(crate) fn number(&mut self, u: &[[f64; 2]], energy_j: f64, index: Option<usize>) -> i16 {
        let member = || Member {
            origin: Origin::Discovered,
            energy_j,
            angles_rad: u.iter().map(|u| Some(u[0].atan2(-u[1]))).collect(),
            index_in_plane: index,
            ..Member::default()
        };
        self.number_or(u, energy_j, index, &member)
    }

    /// The same, with what is listed if it is new.
    fn number_or(
        &mut self,
        u: &[[f64; 2]],
        energy_j: f64,
        index: Option<usize>,
        member: &dyn Fn() -> Member,
    ) -> i16 {
        if energy_j.is_nan() || energy_j >= self.below_j {
            return Failure::Unlisted as i16;
        }
        if let Some(at) = self.lookup.nearest(u, energy_j) {
            let member = &mut self.list[at];
            member.index_in_plane = member.index_in_plane.or(index);
            return self.code(self.numbers[at]);
        }
        if self.codes() >= Members::MOST {
            // No number is left: what is listed must be all that is as low.
            self.lower(energy_j - self.near_j());
            return Failure::Unlisted as i16;
        }
        let member = member();
        let number = self.given;
        self.given += 1;
        let at = self.list.partition_point(|other| by_energy_and_angles(other, &member).is_lt());
        self.lookup.insert(at, &member);
        self.list.insert(at, member);
        self.numbers.insert(at, number);
        if self.list.len() > 2 * self.most {
            self.cut();
        }
        self.code(number)
    }

    /// List what was reached elsewhere; the codes here, in its order.
    pub(crate) fn join(&mut self, other: &Discovered) -> Vec<i16> {
        if let Some(below_j) = other.below_j {
            self.lower(below_j);
        }
        let listed = other.equilibria.iter().map(|member| self.join_one(member));
        listed.collect()
    }

    /// List all of this in another list, and find the way to its numbers.
    pub(crate) fn hand_over(&mut self, to: &mut Self) -> Renumbering {
        let (discovered, own) = self.finish();
        let codes = to.join(&discovered);
        let place = |code: &i16| usize::try_from(*code).ok()?.checked_sub(self.proven);
        let code = |own: &i16| place(own).map_or(*own, |at| codes[at]);
        Renumbering { proven: self.proven, codes: own.codes.iter().map(code).collect() }
    }

    /// Lead every row of a chunk from the numbers given so far to those of the list as it is now,
    /// which is then taken for the whole.
    pub fn renumber(&mut self, outcomes: &mut Outcomes) -> Discovered {
        let (discovered, renumbering) = self.finish();
        for code in &mut outcomes.outcome {
            *code = renumbering.apply(*code);
        }
        discovered
    }

    /// List an entry of another list.
    pub(crate) fn join_one(&mut self, member: &Member) -> i16 {
        let u: Vec<_> = directions_of(member).collect();
        // The angles as they are: another rounding would show.
        self.number_or(&u, member.energy_j, member.index_in_plane, &|| member.clone())
    }

    /// The code of an entry of another list in this one, which is final; that of no entry if it is
    /// too high.
    pub(crate) fn find(&self, member: &Member) -> i16 {
        let none = Failure::Unlisted as i16;
        if member.energy_j >= self.below_j {
            return none;
        }
        let directions: Vec<_> = directions_of(member).collect();
        self.lookup.nearest(&directions, member.energy_j).map_or(none, |at| self.code(at))
    }

    /// What is listed in the end, and the way to its numbers.
    pub(crate) fn finish(&mut self) -> (Discovered, Renumbering) {
        self.cut();
        let mut codes = vec![Failure::Unlisted as i16; self.given];
        for (at, number) in self.numbers.iter().enumerate() {
            codes[*number] = self.code(at);
        }
        let below_j = Some(self.below_j).filter(|below_j| below_j.is_finite());
        let discovered = Discovered { equilibria: self.list.clone(), below_j };
        (discovered, Renumbering { proven: self.proven, codes })
    }

    /// The numbers that were given to the entries, in their order.
    pub(crate) fn numbers(&self) -> &[usize] {
        &self.numbers
    }

    /// The way from so many numbers of another list, of which these entries have theirs, to the codes
    /// here.
    pub(crate) fn renumbering<'a>(
        &self,
        given: usize,
        entries: impl Iterator<Item = (usize, &'a Member)>,
    ) -> Renumbering {
        let mut codes = vec![Failure::Unlisted as i16; given];
        for (number, member) in entries {
            if let Some(code) = codes.get_mut(number) {
                *code = self.find(member);
            }
        }
        Renumbering { proven: self.proven, codes }
    }

    pub(crate) fn bars(&self) -> usize {
        self.lookup.bars()
    }

    fn code(&self, number: usize) -> i16 {
        i16::try_from(self.proven + number).unwrap_or(Failure::Unlisted as i16)
    }

    /// Half of what energies of one equilibrium differ by, J.
    fn near_j(&self) -> f64 {
        0.5 * ENERGY_TOLERANCE * self.lookup.unit_j()
    }

    /// Keep the lowest, if there are too many.
    fn cut(&mut self) {
        if self.list.len() <= self.most {
            return;
        }
        let energy = |k: usize| self.list[k].energy_j;
        let wide = |k: &usize| energy(*k) - energy(*k - 1) > 2.0 * self.near_j();
        if let Some(gap) = (1..=self.most).rev().find(wide) {
            self.lower(energy(gap) - self.near_j());
        } else {
            // All of one energy: the order of angles decides.
            let below_j = energy(self.most);
            self.truncate(self.most);
            self.below_j = self.below_j.min(below_j);
        }
    }

    /// List nothing from this energy on.
    fn lower(&mut self, below_j: f64) {
        if below_j < self.below_j {
            self.below_j = below_j;
            self.truncate(self.list.partition_point(|member| member.energy_j < below_j));
        }
    }

    fn truncate(&mut self, entries: usize) {
        self.lookup.truncate(entries);
        self.list.truncate(entries);
        self.numbers.truncate(entries);
    }
}

/// From the numbers of one list to those of another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Renumbering {
    proven: usize,
    /// Of the numbers behind the proven ones.
    codes: Vec<i16>,
}

impl Renumbering {
    /// The code for a code.
    pub(crate) fn apply(&self, code: i16) -> i16 {
        let behind = usize::try_from(code).ok().and_then(|code| code.checked_sub(self.proven));
        behind.map_or(code, |k| self.codes.get(k).copied().unwrap_or(Failure::Unlisted as i16))
    }

    /// Renumber every row.
    pub(crate) fn apply_to(&self, chunk: &mut Chunk) {
        for code in chunk.outcomes.iter_mut().flat_map(|outcomes| &mut outcomes.outcome) {
            *code = self.apply(*code);
        }
    }

    /// Whether it changes no number.
    pub(crate) fn is_identity(&self) -> bool {
        let all = self.codes.iter().enumerate();
        all.into_iter().all(|(k, code)| usize::try_from(*code) == Ok(self.proven + k))
    }
}
