//! A pull that is prescribed in the place of a position: an anchor that may move, with a force.

use model::Bar;
use model::system::{Joint, Member, Support, System, SystemEquilibrium};

use crate::common::{agreed, close};

/// Length, m, and weight, N, of a member, and how many there are.
const LENGTH_M: f64 = 0.5;
const WEIGHT_N: f64 = 4.0;
const MEMBERS: u32 = 11;

/// A cable from an anchor to this joint, by both solvers.
fn answers(end: Joint) -> Vec<SystemEquilibrium> {
    let n = MEMBERS as usize;
    let mut joints = vec![Joint::anchor("A", [0.0; 3])];
    joints.extend((1..n).map(|k| Joint::free(k.to_string())));
    joints.push(end);
    let body = Bar::homogeneous(LENGTH_M, WEIGHT_N / 10.0).unwrap();
    let members = (0..n).map(|k| Member::cable(k, k + 1, body)).collect();
    agreed(&System::new("cable", 10.0, joints, members).unwrap())
}

/// Where the end is when member k pulls up with `vertical_n(k)`: each points along its force.
fn end_m(level_n: f64, vertical_n: impl Fn(f64) -> f64) -> [f64; 2] {
    (0..MEMBERS).map(|k| vertical_n(f64::from(k))).fold([0.0; 2], |[x, z], v| {
        let size = level_n.hypot(v);
        [x + LENGTH_M * level_n / size, z + LENGTH_M * v / size]
    })
}

/// The end slides on a level line, and a level force draws it: the horizontal tension of the cable.
/// By symmetry the middle of the cable is level.
#[test]
fn a_horizontal_tension_is_prescribed_by_a_slider_with_a_force() {
    for level_n in [0.5, 10.0, 300.0] {
        let support = Support::Line { at_m: [0.0; 3], direction: [1.0, 0.0, 0.0] };
        let end = Joint::free("B").with_force([level_n, 0.0, 0.0]).held_by(support);
        let middle = 0.5 * f64::from(MEMBERS - 1);
        let [span_m, _] = end_m(level_n, |k| (k - middle) * WEIGHT_N);
        for e in answers(end) {
            close(e.joints_m[MEMBERS as usize][0], span_m);
            close(e.reactions_n[0][0], -level_n);
            close(e.reactions_n[0][2], 0.5 * f64::from(MEMBERS) * WEIGHT_N);
        }
    }
}

/// The whole force at the end is prescribed: it is a free joint with that force.
#[test]
fn the_force_of_an_anchor_is_prescribed_by_a_free_joint_with_it() {
    for force_n in [[30.0, 0.0, 40.0], [5.0, 12.0, 30.0]] {
        let [x, y, up_n] = force_n;
        let level_n = f64::hypot(x, y);
        // Below the end hang half of its own member, and the members further on.
        let further = |k: f64| f64::from(MEMBERS - 1) - k + 0.5;
        let [far_m, height_m] = end_m(level_n, |k| up_n - further(k) * WEIGHT_N);
        for e in answers(Joint::free("B").with_force(force_n)) {
            let [ex, ey, ez] = e.joints_m[MEMBERS as usize];
            close(ex.hypot(ey), far_m);
            close(ex * y, ey * x);
            close(ez, height_m);
            for (reaction, force) in e.reactions_n[0].iter().zip([x, y]) {
                assert!((reaction + force).abs() < 1e-10);
            }
        }
    }
}
