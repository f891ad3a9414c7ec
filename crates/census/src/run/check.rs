//! A census judged again, from the problem and its own claims.
//!
//! Nothing of the search is used: every claimed neighbourhood is proved again to hold exactly one
//! zero, and every number is computed from it. (Where a bar carries no force there is one
//! proof, of module `unloaded`, and it is made again.)
//!
//! That nothing is missing is not proved again: only the search proves it. A list that is called
//! complete is held against what every complete list must be. The Morse inequalities see any one
//! missing equilibrium, but not a pair of neighbouring index that topology does not need. The
//! lowest and the highest position of all are seen in any case. For the second derivative of the
//! energy by motions out of the plane is $y^T \Omega y$ with the stress matrix Ω (module `stress`),
//! and Ω positive semidefinite certifies that no position is lower, Ω negative semidefinite that
//! none is higher; conversely the lowest and the highest position have such an Ω, being lowest and
//! highest among chains in any dimension. So exactly one equilibrium has index 0 out of the plane,
//! and exactly one has the largest that there is; a slack family stands for it if all other bars of
//! the family are in tension, or all in compression.

use std::borrow::Cow;

use model::{Chain, Problem};
use numerics::{Interval, in_parallel};

use crate::run::Census;
use crate::run::by_energy_and_angles;
use crate::run::count::morse::MorseError;
use crate::run::count::topology::Topology;
use crate::run::enclosure::krawczyk::{Zero, inside, krawczyk_about_zero, narrow};
use crate::run::enclosure::polish::{PreciseSystem, polish};
use crate::run::equilibrium::ProvenEquilibrium;
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::loads::JointLoads;
use crate::run::plane::system::System;
use crate::run::slack::families::families;
use crate::run::slack::moments::Exact;
use crate::run::slack::straight::{Straight, StraightPosition};
use crate::run::slack::unloaded::with_signs;

/// A stated enclosure may be that much wider than the one computed by the check, both being at the
/// level of rounding errors; measured: below 4 on thousands of equilibria.
const LOOSE: f64 = 64.0;

/// An enclosure narrower than this many units in the last place is never called loose.
const ROUNDINGS: f64 = 256.0 * f64::EPSILON;

/// What is wrong with a census. Numbers count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum CheckError {
    /// Occurs when an equilibrium has not one sign for each bar, +1 or −1 (0 for one bar at most),
    /// or its neighbourhood is no rectangle in a chart.
    #[error("equilibrium {number} is malformed")]
    Malformed { number: usize },
    /// Occurs when the neighbourhood of an equilibrium is proved to hold none.
    #[error("the neighbourhood of equilibrium {number} holds none")]
    Empty { number: usize },
    /// Occurs when the neighbourhood of an equilibrium is not proved to hold exactly one. That
    /// refutes nothing: it may hold one all the same.
    #[error("the neighbourhood of equilibrium {number} is not proved to hold exactly one")]
    NotOne { number: usize },
    /// Occurs when the index of an equilibrium is not proved. That refutes nothing.
    #[error("the index of equilibrium {number} is not proved")]
    IndexNotProved { number: usize },
    /// Occurs when an enclosure does not contain the value.
    #[error("{quantity} of equilibrium {number} is wrong")]
    Wrong { number: usize, quantity: &'static str },
    /// Occurs when an enclosure is much wider than it need be.
    #[error("the enclosure of {quantity} of equilibrium {number} is not tight")]
    Loose { number: usize, quantity: &'static str },
    /// Occurs when an index or a certificate is not what is proved.
    #[error("the index or the certificate of equilibrium {number} is wrong")]
    Index { number: usize },
    /// Occurs when equilibria are listed twice or out of order.
    #[error("equilibrium {number} is listed twice or out of order")]
    Order { number: usize },
    /// Occurs when the equilibria and the topology of the configuration space contradict each
    /// other.
    #[error(transparent)]
    Morse(#[from] MorseError),
    /// Occurs when a list that is called complete has not exactly one equilibrium or slack family
    /// that is certified, by its stress matrix, to be the lowest or the highest position of all.
    #[error(
        "a complete list has one {which} position, certified by its stress matrix; this one has {found}"
    )]
    Extreme {
        /// `lowest` or `highest`.
        which: &'static str,
        found: usize,
    },
    /// Occurs when the slack families, the topology or the claim of completeness are not what
    /// follows from the rest.
    #[error("{quantity} does not follow from the chain")]
    Claim { quantity: &'static str },
}

/// The isolated equilibria by their numbers, from 0.
pub(super) type Listed<'a> = dyn Fn(usize) -> Cow<'a, ProvenEquilibrium> + Sync + 'a;

/// What is asked of all equilibria together.
struct Told {
    /// The middle.
    energy_j: f64,
    /// A number for its signs: three ways for each bar, of which there are fewer than forty.
    signs: i64,
    in_plane: usize,
    out_of_plane: usize,
}

impl Told {
    fn of(equilibrium: &ProvenEquilibrium) -> Self {
        let signs = equilibrium.signs.iter().fold(0, |all, sign| 3 * all + i64::from(*sign));
        let (in_plane, out_of_plane) = (equilibrium.index_in_plane, equilibrium.index_out_of_plane);
        Self { energy_j: equilibrium.energy_j.mid(), signs, in_plane, out_of_plane }
    }
}

impl CheckError {
    /// Whether it shows that the census is wrong; else a proof did not succeed, which shows
    /// nothing.
    ///
    /// ```
    /// use census::CheckError;
    /// assert!(CheckError::Empty { number: 1 }.refutes());
    /// assert!(!CheckError::NotOne { number: 1 }.refutes());
    /// ```
    pub fn refutes(&self) -> bool {
        !matches!(self, Self::NotOne { .. } | Self::IndexNotProved { .. })
    }
}

impl Census {
    /// Judge this census of a chain.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong or not proved, as [`CheckError`].
    pub fn check(&self, problem: &Problem) -> Result<(), CheckError> {
        self.check_chain(problem.chain(), JointLoads::NONE)
    }

    /// Judge this census of a chain with loads at its joints.
    pub(crate) fn check_chain(&self, chain: &Chain, loads: &JointLoads) -> Result<(), CheckError> {
        let at = |number: usize| Cow::Borrowed(&self.equilibria[number]);
        self.check_list(chain, loads, self.equilibria.len(), &at)
    }

    /// Judge this census with so many isolated equilibria, whichever way they are kept.
    pub(super) fn check_list(
        &self,
        chain: &Chain,
        loads: &JointLoads,
        count: usize,
        at: &Listed<'_>,
    ) -> Result<(), CheckError> {
        if chain.bars().len() != self.statistics.bars {
            return Err(CheckError::Claim { quantity: "the number of bars" });
        }
        let system = System::new(chain, loads);
        let precise = PreciseSystem::new(chain, loads, &system);
        let one = |number: usize| {
            let stated = at(number);
            check_one(&precise, &system, number + 1, &stated)?;
            Ok(Told::of(&stated))
        };
        let told = in_parallel(count, 1, one);
        let told = told.into_iter().collect::<Result<Vec<Told>, CheckError>>()?;
        for number in 1..count {
            let by_energy = told[number - 1].energy_j.total_cmp(&told[number].energy_j);
            let ascends =
                by_energy.then_with(|| by_energy_and_angles(&at(number - 1), &at(number))).is_lt();
            if !ascends {
                return Err(CheckError::Order { number: number + 1 });
            }
        }
        once(&told, at)?;
        self.check_claims(&system, &Exact::new(chain, loads))?;
        if self.undecided.is_empty() {
            self.morse_of(&self.count_of(told.iter().map(|told| told.in_plane)))?;
        }
        if self.complete {
            self.extremes(|index| told.iter().filter(|told| told.out_of_plane == index).count())?;
        }
        Ok(())
    }

    /// What is claimed besides the isolated equilibria.
    fn check_claims(&self, system: &System, exact: &Exact) -> Result<(), CheckError> {
        let claims = [
            (
                "the list of slack families",
                self.families == families(system, exact.sides.as_ref()).0,
            ),
            (
                "the list of straight positions",
                self.straight == Straight::of(system, exact).positions,
            ),
            ("the topology", self.topology == Topology::of_system(system)),
            ("whether there are circles", self.circles == system.vertical),
            (
                "completeness",
                !self.complete || (self.undecided.is_empty() && self.may_be_complete()),
            ),
        ];
        match claims.into_iter().find(|(_, holds)| !holds) {
            Some((quantity, _)) => Err(CheckError::Claim { quantity }),
            None => Ok(()),
        }
    }

    /// Whether the lowest and the highest position of all are listed, and once.
    /// `listed` counts the equilibria with an index out of the plane.
    fn extremes(&self, listed: impl Fn(usize) -> usize) -> Result<(), CheckError> {
        // The turn about vertical anchors is in the kernel of the stress matrix.
        let joints = self.statistics.bars - 1 - usize::from(self.circles);
        // Lengths that do not reach leave no position at all.
        let known = self.topology.as_ref();
        let none = known.is_ok_and(|known| known.betti.iter().all(|number| *number == 0));
        // Taut from anchor to anchor, or folded on their line, it has one position, which no force holds.
        let only = |straight: &StraightPosition| {
            let onwards = straight.along.iter().filter(|way| **way > 0).count();
            !straight.upright && (onwards == straight.along.len() || onwards == 1)
        };
        let wanted = usize::from(!none && !self.straight.iter().any(only));
        for (which, sign, index) in [("lowest", 1, 0), ("highest", -1, joints)] {
            let families =
                self.families.iter().filter(|f| f.signs.iter().all(|s| *s == sign || *s == 0));
            let found = listed(index) + families.count();
            if found != wanted {
                return Err(CheckError::Extreme { which, found });
            }
        }
        Ok(())
    }
}

/// Whether no equilibrium is listed twice, of numbers for the signs of each: the same one would have equal signs and
/// overlapping pulls.
fn once(told: &[Told], at: &Listed<'_>) -> Result<(), CheckError> {
    let mut by_signs: Vec<(i64, usize)> = told.iter().map(|told| told.signs).zip(0..).collect();
    by_signs.sort_unstable();
    for group in by_signs.chunk_by(|(a, _), (b, _)| a == b).filter(|group| group.len() > 1) {
        let pulls: Vec<_> = group.iter().map(|(_, number)| at(*number).pull_n).collect();
        for (k, pull) in pulls.iter().enumerate() {
            let overlaps = |other: &[Interval; 2]| (0..2).all(|i| !other[i].disjoint(pull[i]));
            if pulls[..k].iter().any(overlaps) {
                return Err(CheckError::Order { number: group[k].1 + 1 });
            }
        }
    }
    Ok(())
}

fn check_one(
    precise: &PreciseSystem,
    system: &System,
    number: usize,
    stated: &ProvenEquilibrium,
) -> Result<(), CheckError> {
    let signs = &stated.signs;
    let malformed = CheckError::Malformed { number };
    let unloaded = signs.iter().filter(|sign| **sign == 0).count();
    let is_sign = |sign: &i8| (-1..=1).contains(sign);
    if signs.len() != system.bars() || !signs.iter().all(is_sign) || unloaded > 1 {
        return Err(malformed);
    }
    let around = Cell { face: stated.alone_in.chart, at: stated.alone_in.at };
    if matches!(around.face, Face::Around(group) if usize::from(group) >= system.groups.len()) {
        return Err(malformed);
    }
    let computed = if unloaded == 1 {
        let computed = with_signs(system, signs).ok_or(CheckError::NotOne { number })?;
        if stated.alone_in != computed.alone_in {
            return Err(CheckError::Wrong { number, quantity: "the neighbourhood" });
        }
        computed
    } else {
        proved_again(precise, system, number, signs, around)?
    };
    compared(system, number, stated, &computed)
}

/// The equilibrium in a neighbourhood, from the zero of the closure there.
fn proved_again(
    precise: &PreciseSystem,
    system: &System,
    number: usize,
    signs: &[i8],
    around: Cell,
) -> Result<ProvenEquilibrium, CheckError> {
    let not_one = CheckError::NotOne { number };
    let image = krawczyk_about_zero(system, signs, &around).ok_or(not_one.clone())?;
    if image.disjoint(&around) {
        return Err(CheckError::Empty { number });
    }
    if !inside(&image, &around) {
        return Err(not_one);
    }
    let tight = narrow(system, signs, &image);
    let tight = polish(system, precise, signs, &Zero { tight, alone_in: around }).tight;
    // `new` shows a circle by its other point if bar 1 leans the other way.
    let flip = |cell: Cell| if system.vertical && signs[0] < 0 { cell.mirrored() } else { cell };
    let zero = Zero { tight: flip(tight), alone_in: flip(around) };
    ProvenEquilibrium::new(system, signs, &zero).ok_or(CheckError::IndexNotProved { number })
}

/// Every number of an equilibrium against the one that is proved.
fn compared(
    system: &System,
    number: usize,
    stated: &ProvenEquilibrium,
    computed: &ProvenEquilibrium,
) -> Result<(), CheckError> {
    let wrong = |quantity| CheckError::Wrong { number, quantity };
    if (computed.index_in_plane, computed.index_out_of_plane, computed.optimal, computed.circle)
        != (stated.index_in_plane, stated.index_out_of_plane, stated.optimal, stated.circle)
    {
        return Err(CheckError::Index { number });
    }
    // Else both mirror images of every circle could be listed, and no count would tell.
    if system.vertical && stated.angles_rad.first().is_none_or(|angle| angle.lo() <= 0.0) {
        return Err(wrong("the side of the circle that is shown"));
    }
    let flat = |vectors: &[[Interval; 3]]| vectors.concat();
    for (quantity, stated, computed) in [
        ("the pull", stated.pull_n.to_vec(), computed.pull_n.to_vec()),
        ("the angle", stated.angles_rad.clone(), computed.angles_rad.clone()),
        ("the energy", vec![stated.energy_j], vec![computed.energy_j]),
        ("the joint", flat(&stated.joints_m), flat(&computed.joints_m)),
        ("the multiplier", flat(&stated.multipliers_n), flat(&computed.multipliers_n)),
        ("the axial force", stated.axial_n.clone(), computed.axial_n.clone()),
    ] {
        if stated.len() != computed.len()
            || stated.iter().zip(&computed).any(|(a, b)| a.disjoint(*b))
        {
            return Err(wrong(quantity));
        }
        let size = computed.iter().map(|x| x.mag()).fold(0.0, f64::max);
        if stated.iter().zip(&computed).any(|(a, b)| {
            let allowed = LOOSE * b.width() + ROUNDINGS * size;
            a.width().is_nan() || a.width() > allowed
        }) {
            return Err(CheckError::Loose { number, quantity });
        }
    }
    Ok(())
}
