//! What members bear before they break or buckle.

use std::f64::consts::PI;

use super::tolerance::checked;
use super::{RangeError, System, SystemEquilibrium};
use crate::ForceRange;

/// A member with less than this part of a self-stress has none of it but for rounding.
const NO_STRESS: f64 = 1e-9;

/// The largest tension and compression of a member, and how far below them its force is to stay.
///
/// What is not known is not judged: a rope has a tension alone, of a strut only its buckling may be of
/// interest.
///
/// ```
/// use model::system::Strength;
/// let rope = Strength::new(Some(5000.0), None, 2.0)?;
/// // 4 kN are 80 % of 5 kN: a safety of 1.25, less than the 2 that is wanted.
/// assert_eq!(rope.utilisation(0.0, 4000.0), 0.8);
/// assert!(!rope.suffices(0.8) && rope.suffices(0.5));
/// # Ok::<(), model::system::RangeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    tension_n: Option<f64>,
    compression_n: Option<f64>,
    safety: f64,
}

impl Strength {
    /// The tension that breaks a member and the compression that breaks or buckles it, N, as far as
    /// they are known, and the safety wanted: strength over force, at least; 1 where none is.
    ///
    /// # Errors
    /// [`RangeError`] for a number that is not positive and finite.
    pub fn new(
        tension_n: Option<f64>,
        compression_n: Option<f64>,
        safety: f64,
    ) -> Result<Self, RangeError> {
        let all =
            [("strength_n", tension_n), ("compression_n", compression_n), ("safety", Some(safety))];
        for (what, number) in all {
            checked(what, "positive and finite", number, f64::MAX)?;
        }
        Ok(Self { tension_n, compression_n, safety })
    }

    /// Euler's load $\pi^2 EI/l^2$, N: where a straight member of the length `length_m`, m, with hinges at
    /// its ends and the bending stiffness `bending_n_m2` $= EI$, N m², buckles.
    ///
    /// ```
    /// let load_n = model::system::Strength::euler_n(1000.0, 2.0);
    /// assert!((load_n - 2467.401_100_272_34).abs() < 1e-9);
    /// ```
    pub fn euler_n(bending_n_m2: f64, length_m: f64) -> f64 {
        (PI / length_m).powi(2) * bending_n_m2
    }

    /// The tension that breaks it, N.
    pub fn tension_n(&self) -> Option<f64> {
        self.tension_n
    }

    /// The compression that breaks or buckles it, N.
    pub fn compression_n(&self) -> Option<f64> {
        self.compression_n
    }

    /// The safety wanted.
    pub fn safety(&self) -> f64 {
        self.safety
    }

    /// Which part of its strength a member uses whose axial force, N, goes from `least_n` to `most_n`
    /// along it.
    pub fn utilisation(&self, least_n: f64, most_n: f64) -> f64 {
        let part = |force_n: f64, strength_n: Option<f64>| strength_n.map_or(0.0, |n| force_n / n);
        part(most_n, self.tension_n).max(part(-least_n, self.compression_n)).max(0.0)
    }

    /// The force, N, tension positive, for which no strength is known: the other sense of what is.
    fn unknown_n(&self, least_n: f64, most_n: f64) -> f64 {
        match (self.tension_n, self.compression_n) {
            (Some(_), None) if -least_n > most_n.max(0.0) => least_n,
            (None, Some(_)) if most_n > (-least_n).max(0.0) => most_n,
            _ => 0.0,
        }
    }

    /// Whether a member that uses this part of its strength is as safe as wanted.
    pub fn suffices(&self, utilisation: f64) -> bool {
        utilisation * self.safety <= 1.0
    }
}

impl System {
    /// Whether a member has a strength that its force can be held against.
    pub fn has_strengths(&self) -> bool {
        self.members().iter().any(|member| member.strength.is_some())
    }
}

impl SystemEquilibrium {
    /// Which part of its strength a member, from 0, uses; `None` without a strength, or without such a member.
    ///
    /// Of the largest force anywhere along it, its own weight included. Where balance leaves forces open
    /// (more members than are needed, none of which stretches) it is that of the largest force that
    /// balances; infinite where nothing bounds the force, or nobody has said what does.
    pub fn utilisation(&self, system: &System, member: usize) -> Option<f64> {
        let given = system.members().get(member)?;
        let strength = given.strength.as_deref()?;
        let family = self.evidence.self_stresses.as_ref();
        let range = family.map_or(ForceRange::Unique, |family| match &family.ranges {
            Some(ranges) => ranges[member],
            None if family.basis.iter().any(|stress| stress[member].abs() > NO_STRESS) => {
                ForceRange::Free
            }
            None => ForceRange::Unique,
        });
        let [below_n, above_n] = match range {
            ForceRange::Unique => [0.0; 2],
            ForceRange::Free => [f64::INFINITY; 2],
            ForceRange::Bounded { least_n, most_n } => [
                least_n.map_or(f64::INFINITY, |n| (self.axial_n[member] - n).max(0.0)),
                most_n.map_or(f64::INFINITY, |n| (n - self.axial_n[member]).max(0.0)),
            ],
        };
        // What bears nothing here bears its own weight as well where it may bear something.
        let along = if range == ForceRange::Unique || given.rope.is_some() {
            self.axial_force(system, member)
        } else {
            self.loaded_force(system, member)
        };
        Some(strength.utilisation(along.least_n - below_n, along.most_n + above_n))
    }

    /// The same of all members; nothing where none has a strength.
    pub fn utilisations(&self, system: &System) -> Option<Vec<Option<f64>>> {
        let all = || (0..system.members().len()).map(|member| self.utilisation(system, member));
        system.has_strengths().then(|| all().collect())
    }

    /// The member, from 0, with the largest axial force of those that are pressed and have a strength in tension alone, or
    /// pulled and have one in compression alone, and this force, N, tension positive: nothing judges it.
    pub fn unjudged(&self, system: &System) -> Option<(usize, f64)> {
        let forces = system.members().iter().enumerate().filter_map(|(k, member)| {
            let along = self.axial_force(system, k);
            Some((k, member.strength.as_deref()?.unknown_n(along.least_n, along.most_n)))
        });
        let borne = forces.filter(|(_, force_n)| force_n.abs() > 0.0);
        borne.reduce(|most, next| if next.1.abs() > most.1.abs() { next } else { most })
    }

    /// The member, from 0, that is nearest to the safety wanted, or furthest below it, with its
    /// utilisation; nothing where no member has a strength.
    pub fn weakest(&self, system: &System) -> Option<(usize, f64)> {
        let used = system.members().iter().enumerate().filter_map(|(k, member)| {
            let utilisation = self.utilisation(system, k)?;
            Some((k, utilisation, utilisation * member.strength.as_deref()?.safety))
        });
        let first = |best: (usize, f64, f64), next: (usize, f64, f64)| {
            if next.2 > best.2 { next } else { best }
        };
        used.reduce(first).map(|(member, utilisation, _)| (member, utilisation))
    }
}
