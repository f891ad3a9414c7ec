//! Ropes over rings and pulleys whose equilibria are known by hand.

use model::system::{Joint, Member, System};
use model::{Bar, STANDARD_GRAVITY_M_S2, Vector};

/// A system with ropes, and what its equilibrium is.
#[derive(Debug, Clone)]
pub struct RopeSample {
    /// The system.
    pub system: System,
    /// Axial force of each member, N.
    pub axial_n: Vec<f64>,
    /// Some of the joints, and where they are, m.
    pub at_m: Vec<(usize, Vector)>,
    /// The spans of the first member that have no length, and their pulls on their first joints, N.
    pub jams: Vec<(usize, Vector)>,
}

/// What each weight of a kilogram bears, N.
const G: f64 = STANDARD_GRAVITY_M_S2;

/// All of them.
///
/// | system | its law |
/// |---|---|
/// | a ring on a rope, and on one that stretches | both spans lean by `a` with `sin a = d/L`, `T = W/(2 cos a)` |
/// | two ropes through one ring | four spans of one slope, 4 : 5 |
/// | a tackle, and one that begins at its own block | `T = W/n` for n strands at the block |
/// | a weight over a pulley, rigid and elastic | `T = W`, `s = L (1 + T/EA)` |
/// | a lighter weight that a cable holds down | `T` of the heavier, the rest in the cable |
/// | a bridle over rings | each ring between the load and the middle of its anchors, `2 T₁ 4/5 = T₃` |
/// | a slack rope | nothing |
///
/// ```
/// let ring = &samples::ropes()[0];
/// assert!((ring.axial_n[0] - 81.722_083_333_333).abs() < 1e-11);
/// ```
pub fn ropes() -> Vec<RopeSample> {
    let leaning = 10.0 * G / (2.0 * 0.6);
    let block_m = [0.0, 0.0, -(9.0 - 10.0_f64.sqrt()) / 4.0];
    let own_block_m = [0.0, 0.0, -(8.0 - 5.0_f64.sqrt()) / 3.0];
    vec![
        known(
            "a ring on a rope",
            on_two([4.0, 0.0, 1.0]),
            vec![rope(&[0, 2, 1], 5.0)],
            &[leaning],
            &[(2, [4.0 / 3.0, 0.0, -1.0])],
        ),
        known(
            "a ring on a rope that stretches",
            on_two([4.0, 0.0, 1.0]),
            vec![rope(&[0, 2, 1], 5.0 / (1.0 + leaning / 1000.0)).with_stiffness(1000.0)],
            &[leaning],
            &[(2, [4.0 / 3.0, 0.0, -1.0])],
        ),
        known(
            "two ropes through one ring",
            [[3.0, 0.0], [0.0, 3.0], [-3.0, 0.0], [0.0, -3.0]]
                .into_iter()
                .enumerate()
                .map(|(k, [x, y])| Joint::anchor(format!("{k}"), [x, y, 4.0]))
                .chain([Joint::free("P").with_mass(10.0)])
                .collect(),
            vec![rope(&[0, 4, 1], 10.0), rope(&[2, 4, 3], 10.0)],
            &[10.0 * G / 3.2; 2],
            &[(4, [0.0; 3])],
        ),
        known(
            "a tackle of four strands",
            tackle(40.0, [1.0, 0.0, -3.0]),
            vec![rope(&[0, 1, 0, 1, 0, 2], 9.0)],
            &[10.0 * G],
            &[(1, block_m)],
        ),
        known(
            "a tackle that begins at its own block",
            tackle(30.0, [1.0, 0.0, -2.0]),
            vec![rope(&[1, 0, 1, 0, 2], 8.0)],
            &[10.0 * G],
            &[(1, own_block_m)],
        ),
        known(
            "a weight over a pulley",
            tackle(3.0, [-3.0, 0.0, -4.0]),
            vec![rope(&[2, 0, 1], 6.0)],
            &[3.0 * G],
            &[(1, [0.0, 0.0, -1.0])],
        ),
        known(
            "a weight on a rope that stretches",
            tackle(3.0, [-3.0, 0.0, -4.0]),
            vec![rope(&[2, 0, 1], 6.0).with_stiffness(300.0)],
            &[3.0 * G],
            &[(1, [0.0, 0.0, -1.0 - 6.0 * G / 100.0])],
        ),
        known(
            "a lighter weight that a cable holds down",
            vec![
                Joint::anchor("D", [0.0; 3]),
                Joint::anchor("E", [1.0, 0.0, 0.0]),
                Joint::anchor("F", [1.0, 0.0, -3.0]),
                Joint::free("P").with_mass(3.0),
                Joint::free("Q").with_mass(2.0),
            ],
            vec![rope(&[3, 0, 1, 4], 6.0), cable(2, 4, 1.0)],
            &[3.0 * G, G],
            &[(3, [0.0, 0.0, -3.0]), (4, [1.0, 0.0, -2.0])],
        ),
        known(
            "a slack rope",
            on_two([4.0, 0.0, 0.0])
                .into_iter()
                .chain([Joint::anchor("C", [2.0, 0.0, 1.0])])
                .collect(),
            vec![rope(&[0, 2, 1], 9.0), cable(3, 2, 2.0)],
            &[0.0, 10.0 * G],
            &[(2, [2.0, 0.0, -1.0])],
        ),
        bridle(),
    ]
}

/// 12 kg by a ring on a rope of 1 m, whose ends are rings on two ropes of 5 m between anchors 3 m apart, 2 m
/// to the left and to the right. Each ring on these is 2 m from the middle of its anchors, towards the load.
fn bridle() -> RopeSample {
    let anchors = [[-2.0, -1.5], [-2.0, 1.5], [2.0, -1.5], [2.0, 1.5]];
    let anchors = anchors.into_iter().enumerate();
    let mut joints: Vec<Joint> =
        anchors.map(|(k, [x, y])| Joint::anchor(format!("{k}"), [x, y, 0.0])).collect();
    joints.extend(["left", "right"].map(Joint::free));
    joints.push(Joint::free("load").with_mass(12.0));
    let upper = 12.0 * G / (2.0 * 0.6);
    known(
        "a bridle over rings",
        joints,
        vec![rope(&[0, 4, 1], 5.0), rope(&[2, 5, 3], 5.0), rope(&[4, 6, 5], 1.0)],
        &[upper / 1.6, upper / 1.6, upper],
        &[(4, [-0.4, 0.0, -1.2]), (5, [0.4, 0.0, -1.2]), (6, [0.0, 0.0, -1.5])],
    )
}

fn known(
    name: &str,
    joints: Vec<Joint>,
    members: Vec<Member>,
    axial_n: &[f64],
    at_m: &[(usize, Vector)],
) -> RopeSample {
    let system = System::new(name, G, joints, members).expect("a valid system");
    RopeSample { system, axial_n: axial_n.to_vec(), at_m: at_m.to_vec(), jams: vec![] }
}

/// Ropes with spans that have no length, for which the tension is enough.
///
/// | system | its law |
/// |---|---|
/// | two weights over two pulleys | the lighter one at its pulley, with its weight |
/// | two rings, or three, on one rope | all in one place, where one ring would be |
/// | a tackle closed block to block | each of n spans has a part of the block's weight |
/// | a ring blown to the end of its rope | what the other span and the wind leave |
///
/// ```
/// let weights = &samples::jammed_ropes()[0];
/// assert_eq!(weights.jams, [(2, [0.0, 0.0, -2.0 * model::STANDARD_GRAVITY_M_S2])]);
/// ```
pub fn jammed_ropes() -> Vec<RopeSample> {
    let free = |name: &str, mass_kg: f64| Joint::free(name).with_mass(mass_kg);
    let leaning = 10.0 * G / (2.0 * 0.6);
    let meet_m = [4.0 / 3.0, 0.0, -1.0];
    let mut two = on_two([4.0, 0.0, 1.0]);
    two[2].mass_kg = 4.0;
    two.push(free("Q", 6.0));
    let mut closed = tackle(30.0, [0.0; 3]);
    closed[2] = free("weight", 10.0);
    let mut blown = on_two([4.0, 0.0, 0.0]);
    blown[2] = Joint::free("P").with_force([2.0, 0.0, -2.0]);
    let one = |name, joints, member, tension_n, at_m: &[_], jams: &[_]| {
        let known = known(name, joints, vec![member], &[tension_n], at_m);
        RopeSample { jams: jams.to_vec(), ..known }
    };
    let part = |sign: f64| [0.0, 0.0, sign * 7.5 * G];
    vec![
        one(
            "two weights over two pulleys",
            vec![
                Joint::anchor("D", [0.0; 3]),
                Joint::anchor("E", [1.0, 0.0, 0.0]),
                free("P", 3.0),
                free("Q", 2.0),
            ],
            rope(&[2, 0, 1, 3], 6.0),
            3.0 * G,
            &[(2, [0.0, 0.0, -5.0]), (3, [1.0, 0.0, 0.0])],
            &[(2, [0.0, 0.0, -2.0 * G])],
        ),
        one(
            "two rings on one rope",
            two,
            rope(&[0, 2, 3, 1], 5.0),
            leaning,
            &[(2, meet_m), (3, meet_m)],
            &[(1, [0.8 * leaning, 0.0, 4.0 * G - 0.6 * leaning])],
        ),
        // P to Q bears what the first span and 1 kg leave at P, Q to R 2 kg more.
        one(
            "three rings on one rope",
            crate::joints(&[[0.0; 3], [4.0, 0.0, 1.0]], &[1.0, 2.0, 3.0]),
            rope(&[0, 2, 3, 4, 1], 5.0),
            5.0 * G,
            &[(2, meet_m), (3, meet_m), (4, meet_m)],
            &[(1, [4.0 * G, 0.0, -2.0 * G]), (2, [4.0 * G, 0.0, 0.0])],
        ),
        one(
            "a tackle closed block to block",
            closed,
            rope(&[0, 1, 0, 1, 0, 2], 5.0),
            10.0 * G,
            &[(1, [0.0; 3]), (2, [0.0, 0.0, -5.0])],
            &[(0, part(-1.0)), (1, part(1.0)), (2, part(-1.0)), (3, part(1.0))],
        ),
        one(
            "a ring blown to the end of its rope",
            blown,
            rope(&[0, 2, 1], 4.0 / 1.1).with_stiffness(100.0),
            10.0,
            &[(2, [4.0, 0.0, 0.0])],
            &[(1, [8.0, 0.0, 2.0])],
        ),
    ]
}

/// Anchors at the origin and there, and 10 kg.
fn on_two(b_m: Vector) -> Vec<Joint> {
    vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", b_m), Joint::free("P").with_mass(10.0)]
}

/// A beam at the origin, a block, and where the rope ends.
fn tackle(mass_kg: f64, end_m: Vector) -> Vec<Joint> {
    let block = Joint::free("block").with_mass(mass_kg);
    vec![Joint::anchor("beam", [0.0; 3]), block, Joint::anchor("end", end_m)]
}

fn cable(from: usize, to: usize, length_m: f64) -> Member {
    Member::cable(from, to, Bar::homogeneous(length_m, 0.0).expect("a valid length"))
}

/// A massless rope over these joints, from the first to the last.
pub fn rope(path: &[usize], length_m: f64) -> Member {
    let last = path.len() - 1;
    cable(path[0], path[last], length_m).over(path[1..last].to_vec())
}
