//! Chains as systems.

use super::row::{Once, Row};
use super::{Joint, Member, Name, Shares, System};
use crate::{Chain, Problem};

impl From<&Problem> for System {
    /// The same chain, which knows itself as one: see [`System::as_row`].
    fn from(problem: &Problem) -> Self {
        let row = Once::known(Row::from(problem));
        Self { row, ..Self::from(problem.chain()) }
    }
}

impl From<&Chain> for System {
    /// The same chain: joints named by their numbers, `"0"` and the last anchored.
    ///
    /// ```
    /// let chain = model::cases::paper().into_chain();
    /// let system = model::system::System::from(&chain);
    /// assert_eq!(system.joints()[3].name, "3");
    /// assert_eq!(system.total_mass_kg(), chain.total_mass_kg());
    /// ```
    fn from(chain: &Chain) -> Self {
        let bars = chain.bars();
        let anchors = chain.anchors();
        let joints = (0..=bars.len()).map(|k| {
            let name = Name::number(k);
            match k {
                0 => Joint::anchor(name, anchors.start_m),
                _ if k == bars.len() => Joint::anchor(name, anchors.end_m),
                _ => Joint::free(name),
            }
        });
        let mut members = Vec::with_capacity(bars.len());
        for (k, bar) in bars.iter().enumerate() {
            Member::bar(k, k + 1, *bar).join(&mut members);
        }
        // What a chain guarantees is all that a system asks for.
        let (name, gravity_m_s2) = (chain.name().to_owned(), chain.gravity_m_s2());
        Self::unchecked(name, gravity_m_s2, joints.collect(), members)
    }
}
