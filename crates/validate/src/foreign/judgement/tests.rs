//! What the tolerance explains of a force.

use model::Bar;
use model::system::{Joint, Member};

use super::*;

/// A spring of 2 m and 6 N whose ends are known to 0.25 m each: 6/2 N/m times 0.5 m and the force's
/// own 0.5 N.
#[test]
fn a_stiff_member_may_be_off_by_what_its_ends_are() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P"), Joint::free("Q")];
    let rod = |from, to| Member::bar(from, to, Bar::homogeneous(2.0, 1.0).unwrap());
    let members = vec![rod(0, 1), rod(1, 2).with_stiffness(6.0)];
    let system = System::new("spring", 10.0, joints, members).unwrap();
    let bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.5 };
    let found = [0, 1, 2, 3].map(|member| allowed_n(&system, member, &bounds).to_bits());
    assert_eq!(found, [0.5, 0.5, 2.0, 0.5].map(f64::to_bits));
}
