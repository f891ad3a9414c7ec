//! Systems of any size.

use std::f64::consts::TAU;

use model::system::{Joint, Member, System};
use model::{Bar, STANDARD_GRAVITY_M_S2};

/// Three strands of `n` bars of 1 m and 1 kg from anchors on a circle, 0.8 n m wide, to a joint with the mass of a
/// strand.
pub fn bridle(n: usize) -> System {
    let bar = Bar::homogeneous(1.0, 1.0).expect("a valid bar");
    let mut joints = vec![Joint::free("knot").with_mass(n as f64)];
    let mut members = Vec::with_capacity(3 * n);
    for strand in 0..3 {
        let (sine, cosine) = (TAU * f64::from(strand) / 3.0).sin_cos();
        let radius_m = 0.8 * n as f64;
        let at_m = [radius_m * cosine, radius_m * sine, 0.0];
        joints.push(Joint::anchor(format!("anchor {strand}"), at_m));
        for k in 1..=n {
            let to = if k == n { 0 } else { joints.len() };
            members.push(Member::bar(joints.len() - 1, to, bar));
            if k < n {
                joints.push(Joint::free(format!("{strand} {k}")));
            }
        }
    }
    System::new("bridle", STANDARD_GRAVITY_M_S2, joints, members).expect("a valid system")
}

/// A net of `n` by `n` joints with all of the edge held 1 m apart, massless cables of 1.05 m between
/// them, and 1 kg at each.
pub fn cable_net(n: usize) -> System {
    let edge = |k: usize| k == 0 || k + 1 == n;
    let body = Bar::homogeneous(1.05, 0.0).expect("a valid bar");
    let (mut joints, mut cables) = (vec![], vec![]);
    for k in 0..n * n {
        let (x, y) = (k % n, k / n);
        joints.push(if edge(x) || edge(y) {
            Joint::anchor(k.to_string(), [x as f64, y as f64, 0.0])
        } else {
            Joint::free(k.to_string()).with_mass(1.0)
        });
        if x + 1 < n && !edge(y) {
            cables.push(Member::cable(k, k + 1, body));
        }
        if y + 1 < n && !edge(x) {
            cables.push(Member::cable(k, k + n, body));
        }
    }
    System::new("net of cables", 9.81, joints, cables).expect("a valid system")
}
