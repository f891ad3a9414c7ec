//! The member that is nearest to breaking.

use model::system::{System, SystemEquilibrium};
use serde::{Serialize, Serializer};

/// The member that is nearest to the safety wanted, or furthest below it.
///
/// ```
/// use funicular::{Weakest, prelude::*};
/// // 100 N on a thread that bears 80 N, and on one that bears 400 N.
/// let answer = Solve::new().run(&Problem::parse(
///     "gravity_m_s2 = 10\n\
///      joints = { A = { at_m = [0, 0, 0] }, P = {}, Q = { mass_kg = 10 } }\n\
///      bars = [{ from = 'A', to = 'P', length_m = 1, mass_kg = 0, strength_n = 400, safety = 2 },\n\
///              { from = 'P', to = 'Q', length_m = 1, mass_kg = 0, strength_n = 80 }]",
///     "threads.toml",
/// )?)?;
/// let weakest = Weakest::of(answer.system(), &answer.equilibria()[0]).expect("strengths");
/// assert_eq!((weakest.bar, weakest.safety_wanted, weakest.suffices()), (1, 1.0, false));
/// assert!((weakest.utilisation - 1.25).abs() < 1e-12 && (weakest.safety - 0.8).abs() < 1e-12);
/// assert_eq!(answer.is_strong(), Some(false));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Weakest {
    /// Its number, from 0; in JSON from 1.
    #[serde(serialize_with = "from_one")]
    pub bar: usize,
    /// The part of its strength that it uses: force over strength. Infinite (in JSON `null`) where
    /// balance leaves its force without a bound.
    pub utilisation: f64,
    /// Strength over force; infinite (in JSON `null`) where the member bears nothing.
    pub safety: f64,
    /// What it is required to be at least.
    pub safety_wanted: f64,
    /// The largest force that is in the other sense than the strength of its member, which says nothing of it; not in JSON,
    /// which has the forces and the utilisation of each bar.
    #[serde(skip)]
    pub unjudged: Option<Unjudged>,
}

/// A force that no strength is known for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Unjudged {
    /// The member that bears it, from 0.
    pub bar: usize,
    /// The force, N: tension positive.
    pub axial_n: f64,
}

/// The number of a bar as JSON has it.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
pub(crate) fn from_one<S: Serializer>(bar: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    (bar + 1).serialize(serializer)
}

impl Weakest {
    /// Of an equilibrium of a system; `None` where no member has a strength.
    pub fn of(system: &System, found: &SystemEquilibrium) -> Option<Self> {
        let (bar, utilisation) = found.weakest(system)?;
        let safety_wanted = system.members()[bar].strength.as_deref()?.safety();
        let unjudged = found.unjudged(system).map(|(bar, axial_n)| Unjudged { bar, axial_n });
        Some(Self { bar, utilisation, safety: utilisation.recip(), safety_wanted, unjudged })
    }

    /// The safety wanted over the one that is there: above 1 it is too weak.
    pub fn demand(&self) -> f64 {
        self.utilisation * self.safety_wanted
    }

    /// Whether it is as safe as wanted; then all members are.
    pub fn suffices(&self) -> bool {
        self.demand() <= 1.0
    }
}
