//! Joints that have run together on a rope.
//!
//! The length of a rope has a corner where two joints of a span meet: $|d|$ has no direction there. The two
//! joints then are as one, and the span pulls at them with any force up to the tension ([`Jam`](crate::Jam)).

use super::{Joint, Kind, Member, Support, System};
use crate::Vector;

/// A system in which some joints are one.
#[derive(Debug, Clone, PartialEq)]
pub struct Joined {
    /// The system with the same members. Behind its joints may stand anchors of cables that are slack.
    pub system: System,
    /// For each joint of the whole system its number in this one.
    pub numbers: Vec<usize>,
    /// For each joint of this one the joint of the whole system that it has its name and support from.
    pub kept: Vec<usize>,
}

impl Joined {
    /// The places of its joints where those of the whole system are these, m.
    #[must_use]
    pub fn places_m(&self, whole_m: &[Vector]) -> Vec<Vector> {
        let kept = self.kept.iter().filter_map(|joint| whole_m.get(*joint).copied());
        let anchors = self.system.joints.iter().skip(self.kept.len());
        kept.chain(anchors.filter_map(|joint| joint.support.at_m())).collect()
    }

    /// The spans of ropes of the whole system whose joints are one here: member, number of the span in it, joints.
    pub fn spans<'a>(
        &'a self,
        whole: &'a System,
    ) -> impl Iterator<Item = (usize, usize, [usize; 2])> + 'a {
        let of_member = |(k, member): (usize, &'a Member)| {
            member.spans().enumerate().map(move |(number, joints)| (k, number, joints))
        };
        let ropes = whole.members.iter().enumerate().filter(|(_, member)| member.rope.is_some());
        let all = ropes.flat_map(of_member);
        all.filter(|(.., [a, b])| self.numbers[*a] == self.numbers[*b])
    }
}

impl System {
    /// The same system where each of these pairs of joints is one joint, with the loads of both; ropes have no
    /// spans between them. It has the name and the support of the one that is held, else of the first.
    ///
    /// A cable between them is slack. Without value where two joints of it are held, over a floor, and where
    /// another member had no two joints left.
    ///
    /// ```
    /// use model::{Bar, system::{Joint, Member, System}};
    /// // 3 kg and 2 kg over two pulleys: the lighter one is pulled up to its pulley.
    /// let joints = vec![
    ///     Joint::anchor("D", [0.0; 3]),
    ///     Joint::anchor("E", [1.0, 0.0, 0.0]),
    ///     Joint::free("P").with_mass(3.0),
    ///     Joint::free("Q").with_mass(2.0),
    /// ];
    /// let rope = Member::cable(2, 3, Bar::homogeneous(6.0, 0.0)?).over(vec![0, 1]);
    /// let system = System::new("two weights", 10.0, joints, vec![rope])?;
    /// let joined = system.joined(&[[1, 3]]).expect("one of them is held");
    /// assert_eq!(joined.numbers, [0, 1, 2, 1]);
    /// assert_eq!(joined.system.members()[0].path().collect::<Vec<_>>(), [2, 0, 1]);
    /// assert_eq!(joined.system.joints()[1].mass_kg, 2.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn joined(&self, pairs: &[[usize; 2]]) -> Option<Joined> {
        let held = |joint: usize| self.joints[joint].support != Support::Free;
        // Of each joint the one that stands for it.
        let mut stands: Vec<usize> = (0..self.joints.len()).collect();
        for [a, b] in pairs {
            let [a, b] = [stands[*a], stands[*b]];
            let [kept, gone] = if held(b) || (b < a && !held(a)) { [b, a] } else { [a, b] };
            if held(gone) && kept != gone || self.floor_m.is_some() {
                return None;
            }
            stands.iter_mut().filter(|joint| **joint == gone).for_each(|joint| *joint = kept);
        }
        let kept: Vec<usize> = (0..stands.len()).filter(|joint| stands[*joint] == *joint).collect();
        let number = |joint: usize| kept.binary_search(&stands[joint]).unwrap_or_default();
        let numbers: Vec<usize> = (0..stands.len()).map(number).collect();
        let mut joints: Vec<Joint> = kept.iter().map(|joint| self.joints[*joint].clone()).collect();
        for (joint, number) in
            numbers.iter().enumerate().filter(|(joint, _)| stands[*joint] != *joint)
        {
            let (from, to) = (&self.joints[joint], &mut joints[*number]);
            to.mass_kg += from.mass_kg;
            to.force_n = std::array::from_fn(|axis| to.force_n[axis] + from.force_n[axis]);
        }
        let members =
            self.members.iter().map(|member| without_spans(member, &numbers, &mut joints));
        let members = members.collect::<Option<_>>()?;
        let system = Self::new(self.name.clone(), self.gravity_m_s2, joints, members).ok()?;
        Some(Joined { system, numbers, kept })
    }
}

/// A member between joints of other numbers, without spans from a joint to itself.
fn without_spans(member: &Member, numbers: &[usize], joints: &mut Vec<Joint>) -> Option<Member> {
    let mut path: Vec<usize> = member.path().map(|joint| numbers[joint]).collect();
    path.dedup();
    if path.len() == 1 && member.kind == Kind::Cable {
        path = slack(member, joints)?;
    }
    let [from, via @ .., to] = &path[..] else { return None };
    let straight = Member { from: *from, to: *to, rope: None, ..member.clone() };
    Some(straight.over(via.to_vec()))
}

/// Two anchors in one place, between which a cable without loads is slack.
fn slack(cable: &Member, joints: &mut Vec<Joint>) -> Option<Vec<usize>> {
    let is_light = cable.body.mass_kg() <= 0.0 && cable.loads.is_empty();
    let at_m = joints.iter().find_map(|joint| joint.support.at_m())?;
    let first = joints.len();
    let name = |number: usize| format!("{} apart {number}", joints[0].name);
    let anchors = [first, first + 1].map(|number| Joint::anchor(name(number), at_m));
    joints.extend(anchors);
    is_light.then(|| vec![first, first + 1])
}
