//! Chains as systems.

use super::{Joint, Member, Name, System};
use crate::Chain;

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
        let members =
            bars.iter().enumerate().scan(None, |before: &mut Option<Member>, (k, bar)| {
                let equal = before.take().filter(|before| before.body == *bar);
                let member = equal.unwrap_or_else(|| Member::bar(k, k + 1, *bar)).between(k, k + 1);
                *before = Some(member.clone());
                Some(member)
            });
        // What a chain guarantees is all that a system asks for.
        let (name, gravity_m_s2) = (chain.name().to_owned(), chain.gravity_m_s2());
        Self::unchecked(name, gravity_m_s2, joints.collect(), members.collect())
    }
}
