//! Free joints far from the origin.

use model::Anchors;

use super::*;

/// A bar of 0.75 m with 1 kg hangs from its anchor; three without mass bridge the 2.25 m from the
/// other one to it. Places 2^20 m from the origin are stored to 1.9e-9 m, more than the 1e-10 of
/// the length that joints may be off: both count together.
#[test]
fn what_hangs_loose_is_free_wherever_it_is() {
    let bar = |length, mass| Bar::homogeneous(length, mass).unwrap();
    let bars = vec![bar(0.5, 0.0), bar(1.0, 0.0), bar(2.0, 0.0), bar(0.75, 1.0)];
    for far in [0.0, 2.0_f64.powi(20)] {
        let (start_m, end_m) = ([far, 0.0, 0.0], [far, 0.0, 3.0]);
        let chain = Chain::new("far", 9.81, Anchors { start_m, end_m }, bars.clone()).unwrap();
        let free = |aside_m: f64| {
            let joint = [far + aside_m, 0.0, 2.25];
            let between = [far, 0.5, 0.0];
            let found = free_joints(&chain, &[start_m, between, between, joint, end_m]);
            found.map(|(bars, joints)| (bars, joints.first, joints.last))
        };
        let three = Some((0..3, 1, 2));
        assert_eq!(free(0.0), three, "{far}");
        assert_eq!(free(1e-8), None, "{far}");
        assert_eq!(free(1e-9), if far > 0.0 { three } else { None }, "{far}");
    }
}
