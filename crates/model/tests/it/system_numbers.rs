//! What systems refuse, with the numbers of the refusal, at and beside the ends of each range.

use model::system::{Joint, Kind, Member, PointLoad, Support, System, SystemError};
use model::{Bar, SMALLEST_TOTAL};

fn bar(length_m: f64, mass_kg: f64) -> Member {
    Member::bar(0, 1, Bar::new(length_m, mass_kg, 0.0, [0.0; 3]).unwrap())
}

fn anchor() -> Joint {
    Joint::anchor("A", [0.0; 3])
}

fn free() -> Joint {
    Joint::free("P")
}

fn error(gravity_m_s2: f64, joints: [Joint; 2], member: Member) -> SystemError {
    System::new("", gravity_m_s2, joints.into(), vec![member]).unwrap_err()
}

fn accepted(gravity_m_s2: f64, joints: [Joint; 2], member: Member) -> bool {
    System::new("", gravity_m_s2, joints.into(), vec![member]).is_ok()
}

#[test]
fn gravity_is_positive_and_a_number() {
    for gravity_m_s2 in [0.0, -0.0, -9.81, f64::INFINITY] {
        let found = error(gravity_m_s2, [anchor(), free()], bar(1.0, 1.0));
        assert_eq!(found, SystemError::Gravity(gravity_m_s2));
    }
    assert!(matches!(
        error(f64::NAN, [anchor(), free()], bar(1.0, 1.0)),
        SystemError::Gravity(gravity_m_s2) if gravity_m_s2.is_nan()
    ));
    assert!(accepted(0.001, [anchor(), free()], bar(1.0, 1.0)));
}

#[test]
fn joints_refuse_what_is_no_number() {
    let refused = |joint: Joint| error(9.81, [anchor(), joint], bar(1.0, 1.0));
    for bad in [f64::INFINITY, f64::NEG_INFINITY] {
        for k in 0..3 {
            let mut vector = [1.0; 3];
            vector[k] = bad;
            let found = refused(Joint::anchor("P", vector));
            let name = "P".to_owned();
            let place = SystemError::Coordinate { name: name.clone(), joint: 1, coordinate_m: bad };
            assert_eq!(found, place);
            let force = SystemError::Force { name, joint: 1, component_n: bad };
            assert_eq!(refused(free().with_force(vector)), force);
        }
    }
    for mass_kg in [-1.0, -f64::MIN_POSITIVE, f64::INFINITY] {
        let found = refused(free().with_mass(mass_kg));
        assert_eq!(found, SystemError::Mass { name: "P".to_owned(), joint: 1, mass_kg });
    }
    assert!(matches!(refused(free().with_mass(f64::NAN)), SystemError::Mass { .. }));
    assert!(accepted(9.81, [anchor(), free().with_mass(0.0)], bar(1.0, 1.0)));
}

/// Rounding gives a unit vector a length within some units in the last place of 1.
#[test]
fn directions_have_the_length_one() {
    let slides = |direction| free().held_by(Support::Line { at_m: [0.0; 3], direction });
    let within = 8.0 * f64::EPSILON;
    for off in [within, -within, 0.0] {
        assert!(accepted(9.81, [anchor(), slides([0.0, 0.0, 1.0 + off])], bar(1.0, 1.0)), "{off}");
    }
    for off in [1.25 * within, -1.25 * within, 0.5, -0.5, -2.5, f64::INFINITY] {
        let length = (1.0 + off).abs();
        let found = error(9.81, [anchor(), slides([0.0, 0.0, 1.0 + off])], bar(1.0, 1.0));
        assert_eq!(found, SystemError::Direction { name: "P".to_owned(), joint: 1, length });
    }
    let nan = error(9.81, [anchor(), slides([f64::NAN, 0.0, 1.0])], bar(1.0, 1.0));
    assert!(matches!(nan, SystemError::Direction { .. }), "{nan}");
    assert!(accepted(9.81, [anchor(), slides([0.36, 0.48, 0.8])], bar(1.0, 1.0)));
}

#[test]
fn members_refuse_what_cannot_be() {
    let joints = || [anchor(), free()];
    for stiffness_n in [0.0, -1.0, f64::INFINITY] {
        let found = error(9.81, joints(), bar(1.0, 1.0).with_stiffness(stiffness_n));
        assert_eq!(found, SystemError::Stiffness { member: 1, stiffness_n });
    }
    assert!(accepted(9.81, joints(), bar(1.0, 1.0).with_stiffness(f64::MIN_POSITIVE)));
    let loaded = |at_m, force_n| {
        bar(2.0, 1.0).with_loads(vec![PointLoad { at_m, force_n, is_spread: false }])
    };
    for at_m in [0.0, 2.0] {
        assert!(accepted(9.81, joints(), loaded(at_m, [1.0, 2.0, -3.0])));
    }
    for at_m in [-f64::MIN_POSITIVE, 2.0_f64.next_up()] {
        let found = error(9.81, joints(), loaded(at_m, [1.0, 2.0, -3.0]));
        let load = SystemError::PointLoad { member: 1, at_m, length_m: 2.0, component_n: 3.0 };
        assert_eq!(found, load);
    }
    let component_n = f64::NEG_INFINITY;
    let found = error(9.81, joints(), loaded(1.0, [0.0, component_n, 0.0]));
    assert_eq!(found, SystemError::PointLoad { member: 1, at_m: 1.0, length_m: 2.0, component_n });
}

/// Weight is mass times gravity, loads add to it, and the product with the length is asked for too.
#[test]
fn totals_are_numbers_with_digits_to_spare() {
    let small = |quantity, total| SystemError::Underflow { quantity, total };
    let large = |quantity| SystemError::Overflow(quantity);
    let (tiny, huge) = (SMALLEST_TOTAL, f64::MAX);
    let joints = || [anchor(), free()];
    assert_eq!(error(1.0, joints(), bar(tiny / 2.0, 1.0)), small("total length", tiny / 2.0));
    assert_eq!(error(0.25, joints(), bar(1.0, 2.0 * tiny)), small("total load", tiny / 2.0));
    assert_eq!(
        error(1.0, joints(), bar(0.25, 2.0 * tiny)),
        small("total load times total length", tiny / 2.0)
    );
    assert!(accepted(0.5, joints(), bar(1.0, 2.0 * tiny)));
    assert!(accepted(1.0, joints(), bar(tiny, 1.0)));
    // Nothing is loaded: there is no weight to be small.
    assert!(accepted(1.0, joints(), bar(1.0, 0.0)));
    assert_eq!(error(4.0, joints(), bar(1.0, huge / 2.0)), large("total load"));
    // Solvers square lengths and forces: 1e150 is the most that any total may be.
    assert_eq!(error(4.0, joints(), bar(1.0, 0.26e150)), large("total load"));
    assert!(accepted(4.0, joints(), bar(1.0, 0.24e150)));
    assert_eq!(error(4.0, joints(), bar(1e80, 1e80)), large("total load times total length"));
    let stiff = vec![bar(1.0, 1.0).with_stiffness(Some(1.1e150))];
    let stiff = System::new("", 1.0, joints().to_vec(), stiff).map(|_| ());
    assert_eq!(stiff, Err(large("total stiffness")));
    // The two ends of the reach may be on both sides of zero.
    let far = [Joint::anchor("A", [0.0, -0.75 * huge, 0.0]), free()];
    assert_eq!(error(1.0, far, bar(1.0, 1.0)), large("extent of the supports"));
    // Masses of joints and forces count with the members.
    let pulled = [anchor(), free().with_force([0.0, 0.75 * huge, 0.0]).with_mass(0.75 * huge)];
    assert_eq!(error(1.0, pulled, bar(1.0, 0.0)), large("total load"));
    let pushed = [anchor(), free().with_force([0.0, tiny, 0.0])];
    assert!(accepted(1.0, pushed, bar(1.0, 0.0)));
}

/// Above a floor every support that moves level alone has its height to keep.
#[test]
fn a_floor_is_below_what_is_held() {
    let at_m = [0.0, 0.0, 2.0];
    let above = |support, floor_m: f64| {
        let joints = vec![Joint::free("A").held_by(support), free()];
        System::new("", 9.81, joints, vec![bar(1.0, 1.0)]).unwrap().with_floor(floor_m)
    };
    let (up, level) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let refused = |floor_m| {
        Err(SystemError::BelowFloor { name: "A".into(), joint: 0, height_m: 2.0, floor_m })
    };
    for support in [
        Support::Fixed { at_m },
        Support::Line { at_m, direction: level },
        Support::Plane { at_m, normal: up },
    ] {
        assert!(above(support, 2.0).is_ok());
        assert_eq!(above(support, 2.5), refused(2.5));
    }
    // What can rise is not bound to its height.
    for support in [
        Support::Line { at_m, direction: up },
        Support::Line { at_m, direction: [0.6, 0.0, 0.8] },
        Support::Plane { at_m, normal: level },
        Support::Plane { at_m, normal: [0.6, 0.0, 0.8] },
        Support::Plane { at_m, normal: [0.0, 0.6, 0.8] },
    ] {
        assert!(above(support, 2.5).is_ok(), "{support:?}");
    }
}

#[test]
fn rigid_bars_and_struts_alone_keep_their_ends_apart() {
    let member = |kind| bar(1.0, 1.0).of_kind(kind);
    assert!(member(Kind::Bar).keeps_apart() && member(Kind::Strut).keeps_apart());
    assert!(!member(Kind::Cable).keeps_apart());
    for kind in [Kind::Bar, Kind::Strut, Kind::Cable] {
        assert!(!member(kind).with_stiffness(1.0).keeps_apart());
    }
}
