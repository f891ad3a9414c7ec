//! Joints that have run together on a rope.
//!
//! The length of a rope has a corner where two joints of a span meet: $|d|$ has no direction there. The two
//! joints then are as one, and the span pulls at them with any force up to the tension ([`Jam`](crate::Jam)).

use super::{Joint, Kind, Member, Support, System};
use crate::{Bar, Vector};

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
    /// spans between them. It has the name of the one that is held, else of the first, and moves where the supports
    /// of both let it. Anchors in the place of one of them are one with it.
    ///
    /// A cable between them is slack, and its loads act at the joint. Without value where two supports have no place
    /// in common, and where another member had no two joints left.
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
    pub fn joined(&self, pairs: &[[usize; 2]]) -> Option<Joined> {
        // Of each joint the one that stands for it, and what holds that.
        let mut stands: Vec<usize> = (0..self.joints.len()).collect();
        let mut supports: Vec<Support> = self.joints.iter().map(|joint| joint.support).collect();
        for [a, b] in pairs.iter().copied().chain(self.anchors_of(pairs)) {
            let [a, b] = [stands[a], stands[b]];
            let first = |joint: usize| (supports[joint] == Support::Free, joint);
            let [kept, gone] = if first(a) <= first(b) { [a, b] } else { [b, a] };
            supports[kept] = supports[kept].meeting(&supports[gone])?;
            stands.iter_mut().filter(|joint| **joint == gone).for_each(|joint| *joint = kept);
        }
        let kept: Vec<usize> = (0..stands.len()).filter(|joint| stands[*joint] == *joint).collect();
        let number = |joint: usize| kept.binary_search(&stands[joint]).unwrap_or_default();
        let numbers: Vec<usize> = (0..stands.len()).map(number).collect();
        let support = |joint: usize| self.joints[joint].clone().held_by(supports[joint]);
        let mut joints: Vec<Joint> = kept.iter().map(|joint| support(*joint)).collect();
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
        // Unchecked: two members may have the same two joints now, and the longer cable of both is slack.
        let system = Self::unchecked(self.name.clone(), self.gravity_m_s2, joints, members);
        Some(Joined { system: Self { floor_m: self.floor_m, ..system }, numbers, kept })
    }

    /// The anchors in the place of a joint of these pairs, each with that joint.
    fn anchors_of(&self, pairs: &[[usize; 2]]) -> Vec<[usize; 2]> {
        let fixed = |joint: usize| self.joints[joint].support.is_fixed();
        let held = pairs.iter().flatten().filter(|joint| fixed(**joint));
        let same = |a: usize| {
            let all = (0..self.joints.len()).filter(move |b| *b != a);
            all.filter(move |b| self.joints[*b].support == self.joints[a].support)
                .map(move |b| [a, b])
        };
        held.flat_map(|joint| same(*joint)).collect()
    }
}

/// A member between joints of other numbers, without spans from a joint to itself.
fn without_spans(member: &Member, numbers: &[usize], joints: &mut Vec<Joint>) -> Option<Member> {
    let mut path: Vec<usize> = member.path().map(|joint| numbers[joint]).collect();
    path.dedup();
    if path.len() == 1 {
        return slack(member, path[0], joints);
    }
    let [from, via @ .., to] = &path[..] else { return None };
    let straight = member.clone().between(*from, *to).straight();
    Some(straight.over(via.to_vec()))
}

/// A cable from a joint to itself, slack between two anchors in one place, its loads at the joint.
fn slack(cable: &Member, at: usize, joints: &mut Vec<Joint>) -> Option<Member> {
    let body = (cable.kind == Kind::Cable).then(|| Bar::homogeneous(cable.body.length_m(), 0.0))?;
    joints[at].mass_kg += cable.body.mass_kg();
    for load in &cable.loads {
        joints[at].force_n =
            std::array::from_fn(|axis| joints[at].force_n[axis] + load.force_n[axis]);
    }
    let at_m = joints.iter().find_map(|joint| joint.support.at_m()).unwrap_or_default();
    let [from, to] = [joints.len(), joints.len() + 1];
    let name = |number: usize| format!("{} apart {number}", joints[0].name);
    let anchors = [from, to].map(|number| Joint::anchor(name(number), at_m));
    joints.extend(anchors);
    let mut light = cable.clone().between(from, to).straight().with_loads(vec![]);
    light.prestress = None;
    Some(light.with_body(body.ok()?))
}
