//! Systems of members whose equilibria are known by hand.

use std::f64::consts::TAU;

use model::system::{Joint, Kind, Member, PointLoad, Support, System, SystemEquilibrium};
use model::{Bar, Vector};

use crate::joints;

/// A system, and what its equilibrium is.
pub struct Known {
    /// The system, in gravity 10 m/s².
    pub system: System,
    /// Axial force of each member, N.
    axial_n: Vec<f64>,
    /// Some of the joints, and where they are, m.
    at_m: Vec<(usize, Vector)>,
    /// Some of the reactions, N.
    reactions_n: Vec<(usize, Vector)>,
    energy_j: Option<f64>,
    /// Members that are slack.
    pub slack: Vec<usize>,
    /// Motions that keep all lengths and self-stresses, where all members are rigid and bear.
    pub counts: Option<[usize; 2]>,
    neutral: usize,
}

impl Known {
    fn new(name: &str, joints: Vec<Joint>, members: Vec<Member>, axial_n: &[f64]) -> Self {
        Self {
            system: System::new(name, 10.0, joints, members).expect("a valid system"),
            axial_n: axial_n.to_vec(),
            at_m: vec![],
            reactions_n: vec![],
            energy_j: None,
            slack: vec![],
            counts: None,
            neutral: 0,
        }
    }

    fn at(mut self, joint: usize, at_m: Vector) -> Self {
        self.at_m.push((joint, at_m));
        self
    }

    fn bears(mut self, joint: usize, reaction_n: Vector) -> Self {
        self.reactions_n.push((joint, reaction_n));
        self
    }

    fn counts(self, mechanisms: usize, self_stresses: usize) -> Self {
        Self { counts: Some([mechanisms, self_stresses]), ..self }
    }

    /// Every number, relative to itself or to one.
    pub fn assert_holds(&self, found: &SystemEquilibrium, within: f64) {
        let name = self.system.name();
        let close = |what: &str, found: &[f64], known: &[f64]| {
            assert_eq!(found.len(), known.len(), "{name}: {what}");
            for (a, b) in found.iter().zip(known) {
                assert!((a - b).abs() <= within * b.abs().max(1.0), "{name}, {what}: {a}, not {b}");
            }
        };
        close("axial forces", &found.axial_n, &self.axial_n);
        for (joint, at_m) in &self.at_m {
            close("place", &found.joints_m[*joint], at_m);
        }
        for (joint, reaction_n) in &self.reactions_n {
            close("reaction", &found.reactions_n[*joint], reaction_n);
        }
        self.energy_j.iter().for_each(|known| close("energy", &[found.energy_j], &[*known]));
        let stability = &found.stability;
        assert_eq!((stability.index_in_space, stability.neutral), (0, self.neutral), "{name}");
        assert!(stability.index_in_plane.is_none_or(|index| index == 0), "{name}");
    }
}

fn bar(from: usize, to: usize, length_m: f64, mass_kg: f64) -> Member {
    Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).expect("a valid bar"))
}

fn light(from: usize, to: usize, length_m: f64) -> Member {
    bar(from, to, length_m, 0.0)
}

fn cable(from: usize, to: usize, length_m: f64) -> Member {
    light(from, to, length_m).of_kind(Kind::Cable)
}

/// All of them.
///
/// | system | its law |
/// |---|---|
/// | a lamp on a V of heavy bars | the weights of the bars go half to the lamp |
/// | a right angle | 3 : 4 : 5 |
/// | a tripod, and four legs | a third each; a quarter each, as equally stiff ones share |
/// | a mobile | a triangle hangs with its centre below its corner |
/// | a bridle with a branch point | 3 : 4 : 5 |
/// | a loaded string | built from its forces |
/// | a tree | every bar upright, with what hangs below it |
/// | a lamp on a V of springs | 3 : 4 : 5 as they are stretched |
/// | a slack cable | nothing |
/// | sliders on a line and in a plane | what they cannot bear is borne by bars |
/// | a load at a quarter | the lever rule |
///
/// ```
/// assert!(samples::known().iter().all(|known| known.system.gravity_m_s2() == 10.0));
/// ```
pub fn known() -> Vec<Known> {
    let v = [[0.0; 3], [8.0, 0.0, 0.0]];
    // On 5 kg hang 2 kg more, 35 N on each side along (4, -3)/5.
    let across = 35.0 * 4.0 / 3.0;
    let lamp = Known::new(
        "a lamp on a V of heavy bars",
        joints(&v, &[5.0]),
        vec![bar(0, 2, 5.0, 2.0), bar(2, 1, 5.0, 2.0)],
        &[35.0 * 5.0 / 3.0; 2],
    );
    let lamp = lamp.at(2, [4.0, 0.0, -3.0]).bears(0, [-across, 0.0, 45.0]).counts(1, 0);
    let angle = Known::new(
        "a right angle",
        joints(&[[0.0; 3], [5.0, 0.0, 0.0]], &[1.0]),
        vec![light(0, 2, 3.0), light(1, 2, 4.0)],
        &[8.0, 6.0],
    );
    let mut all = vec![
        Known { energy_j: Some(-50.0 * 3.0 - 2.0 * 20.0 * 1.5), ..lamp }
            .bears(1, [across, 0.0, 45.0]),
        angle.at(2, [1.8, 0.0, -2.4]).counts(1, 0),
        legs_of(3).counts(0, 0),
        legs_of(4).counts(0, 1),
        mobile(),
        Known::new(
            "a bridle with a branch point",
            joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[0.0, 7.0]),
            vec![bar(0, 2, 5.0, 1.0), bar(1, 2, 5.0, 1.0), bar(2, 3, 2.0, 3.0)],
            &[0.5 * 110.0 * 5.0 / 4.0, 0.5 * 110.0 * 5.0 / 4.0, 85.0],
        )
        .at(2, [0.0, 0.0, -4.0])
        .at(3, [0.0, 0.0, -6.0]),
        loaded_string(),
        tree(),
    ];
    // Each spring is 5 m long and pulls with 50 N.
    for stiffness in [20.0, 1e3, 1e7] {
        let length = 5.0 / (1.0 + 50.0 / stiffness);
        let spring = |from, to| light(from, to, length).with_stiffness(stiffness);
        let springs = vec![spring(0, 2), spring(2, 1)];
        let known = Known::new("a lamp on a V of springs", joints(&v, &[6.0]), springs, &[50.0; 2]);
        let energy_j = Some(-60.0 * 3.0 + 50.0 * 50.0 * length / stiffness);
        all.push(Known { energy_j, ..known }.at(2, [4.0, 0.0, -3.0]));
    }
    // The third cable would need to be 4.24 m long.
    let slack = Known::new(
        "a slack cable",
        joints(&[v[0], v[1], [4.0, 3.0, 0.0]], &[6.0]),
        vec![cable(0, 3, 5.0), cable(1, 3, 5.0), cable(2, 3, 4.5)],
        &[50.0, 50.0, 0.0],
    );
    all.push(Known { slack: vec![2], ..slack.at(3, [4.0, 0.0, -3.0]).bears(2, [0.0; 3]) });
    all.extend(sliders());
    let load = PointLoad { at_m: 0.5, force_n: [0.0, 0.0, -8.0], is_spread: false };
    let quarter = Known::new(
        "a load at a quarter",
        joints(&[[0.0; 3], [2.0, 0.0, 0.0]], &[0.0, 0.0]),
        vec![light(0, 2, 1.0), light(1, 3, 1.0), light(2, 3, 2.0).with_loads(vec![load])],
        &[6.0, 2.0, 0.0],
    );
    all.push(quarter.at(2, [0.0, 0.0, -1.0]));
    all
}

/// Legs of 5 m from a circle of 3 m: 4 m deep, with 40 N on each.
fn legs_of(count: usize) -> Known {
    let feet: Vec<Vector> = (0..count)
        .map(|k| {
            let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
            [3.0 * cos, 3.0 * sin, 0.0]
        })
        .collect();
    let members = (0..count).map(|k| light(k, count, 5.0)).collect();
    let joints = joints(&feet, &[4.0 * count as f64]);
    Known::new("legs", joints, members, &vec![50.0; count]).at(count, [0.0, 0.0, -4.0])
}

/// A triangle of rigid bars hung at one corner with unequal weights at the others: the centre of gravity is below the
/// corner, and the bar opposite is in compression. With `G` the centre at the depth h, balance of the corner L is
/// `-w_L L + w (R - L) = -(m_L g/h) G`, so `w_L = m_L g/h` and `w = -m_L m_R g/(h M)`.
fn mobile() -> Known {
    let (left, right) = (2.0_f64, 3.0_f64);
    let total = left + right;
    let depth = (left * left + right * right + left * right).sqrt() / total;
    let axial_n = [left, right, -left * right / total].map(|kg| 10.0 * kg / depth);
    let members = vec![light(0, 1, 1.0), light(0, 2, 1.0), light(1, 2, 1.0)];
    let known = Known::new("a mobile", joints(&[[0.0; 3]], &[left, right]), members, &axial_n);
    Known { energy_j: Some(-10.0 * total * depth), neutral: 1, ..known }
}

/// Weights on a string, built from its forces: a horizontal tension and the vertical forces of the bars give
/// directions, these with any lengths the span.
fn loaded_string() -> Known {
    let (tension, first) = (70.0_f64, 90.0);
    let masses = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0];
    let lengths = [1.0, 0.5, 2.0, 0.7, 1.3, 0.9, 1.1];
    let (mut vertical, mut at, mut places, mut axial_n) = (first, [0.0; 3], vec![], vec![]);
    for (k, length) in lengths.iter().enumerate() {
        let pull = tension.hypot(vertical);
        axial_n.push(pull);
        at = [at[0] + length * tension / pull, 0.0, at[2] - length * vertical / pull];
        places.push(at);
        vertical -= 10.0 * masses.get(k).unwrap_or(&0.0);
    }
    let joints = joints(&[[0.0; 3], at], &masses);
    let joint = |k: usize| {
        if k == 0 {
            0
        } else if k == 7 {
            1
        } else {
            k + 1
        }
    };
    let members = (0..7).map(|k| light(joint(k), joint(k + 1), lengths[k])).collect();
    let known = Known::new("a loaded string", joints, members, &axial_n);
    let known = places.iter().enumerate().fold(known, |known, (k, at)| known.at(joint(k + 1), *at));
    known.bears(0, [-tension, 0.0, first]).counts(11, 0)
}

/// A binary tree below one anchor.
fn tree() -> Known {
    let mut joints = vec![Joint::anchor("root", [1.0, 2.0, 3.0])];
    let (mut members, mut places) = (vec![], vec![[1.0, 2.0, 3.0]]);
    for k in 1..31 {
        joints.push(Joint::free(format!("{k}")).with_mass(1.0 + (k % 3) as f64));
        let length = 1.0 + (k % 4) as f64;
        members.push(bar((k - 1) / 2, k, length, 0.5));
        let [x, y, z] = places[(k - 1) / 2];
        places.push([x, y, z - length]);
    }
    let mut below: Vec<f64> = joints.iter().map(|joint| joint.mass_kg * 10.0).collect();
    let mut axial_n = vec![0.0; 30];
    for k in (1..31).rev() {
        axial_n[k - 1] = below[k] + 2.5;
        below[(k - 1) / 2] += below[k] + 5.0;
    }
    let known = Known::new("a tree", joints, members, &axial_n);
    let known = places.into_iter().enumerate().fold(known, |known, (k, at)| known.at(k, at));
    known.bears(0, [0.0, 0.0, below[0]])
}

/// A bar of 2 m and 20 N at 1 m from a slider of 30 N on an upright line or in a plane hangs at 30 degrees; 12 N draw a
/// bead of 20 N along a level line until 5 m to it are taut at 4 : 3; in a plane 3 m off one hangs 4 m deep.
fn sliders() -> Vec<Known> {
    let root = 3.0_f64.sqrt();
    let on = |support: Support, mass_kg: f64, force_n: Vector| {
        let slider = Joint::free("S").with_mass(mass_kg).with_force(force_n).held_by(support);
        vec![Joint::anchor("A", [0.0; 3]), slider]
    };
    let line = Support::Line { at_m: [1.0, 0.0, 7.0], direction: [0.0, 0.0, 1.0] };
    let plane = Support::Plane { at_m: [1.0, 7.0, 7.0], normal: [1.0, 0.0, 0.0] };
    let mut all: Vec<Known> = [line, plane]
        .map(|support| {
            let axial_n = [40.0 * 2.0 / root];
            let joints = on(support, 3.0, [0.0; 3]);
            Known::new("a slider", joints, vec![bar(0, 1, 2.0, 2.0)], &axial_n)
                .at(1, [1.0, 0.0, -root])
                .bears(1, [40.0 / root, 0.0, 0.0])
                .bears(0, [-40.0 / root, 0.0, 50.0])
        })
        .into();
    let level = Support::Line { at_m: [1.0, 0.0, -3.0], direction: [1.0, 0.0, 0.0] };
    for kind in [Kind::Bar, Kind::Cable] {
        let member = light(0, 1, 5.0).of_kind(kind);
        let bead = Known::new("a bead", on(level, 2.0, [12.0, 0.0, 0.0]), vec![member], &[15.0]);
        all.push(bead.at(1, [4.0, 0.0, -3.0]).bears(1, [0.0, 0.0, 11.0]));
    }
    let wall = Support::Plane { at_m: [3.0, 1.0, 1.0], normal: [1.0, 0.0, 0.0] };
    let bead = on(wall, 2.0, [0.0; 3]);
    let bead = Known::new("a bead on a wall", bead, vec![light(0, 1, 5.0)], &[25.0]);
    all.push(bead.at(1, [3.0, 0.0, -4.0]).bears(1, [15.0, 0.0, 0.0]));
    all
}
