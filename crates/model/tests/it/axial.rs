//! Forces along a member.

use model::AxialForce;

/// Two opposing loads of 100 N between the ends of a level bar: 100 N between them, 0 outside.
#[test]
fn loads_along_the_member_put_the_largest_force_between_the_ends() {
    let forces = AxialForce::along(
        ([0.0; 3], [2.0, 0.0, 0.0]),
        ([0.0; 3], [0.0; 3]),
        0.0,
        [(0.75, [100.0, 0.0, 0.0]), (0.25, [-100.0, 0.0, 0.0])],
    );
    assert_eq!((forces.from_n, forces.to_n), (0.0, 0.0));
    assert_eq!((forces.least_n, forces.most_n, forces.largest_n()), (0.0, 100.0, 100.0));
}

#[test]
fn a_member_without_length_has_its_middle_force_everywhere() {
    let at = ([1.0; 3], [1.0; 3]);
    let forces = AxialForce::along(at, ([3.0; 3], [-3.0; 3]), -5.0, []);
    assert_eq!((forces.from_n, forces.to_n, forces.largest_n()), (-5.0, -5.0, -5.0));
}
