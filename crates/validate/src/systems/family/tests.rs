//! Self-stresses of four bars that meet, by hand.

use model::Bar;
use model::system::{Joint, Member, Support};
use numerics::vector::{cross, minus, norm};

use super::super::tests::lamp;
use super::*;

/// A joint 4 m below the middle of a square of anchors 3 m from it: bars of 5 m.
fn legs(support: Support, lengths_m: [f64; 4]) -> (System, SystemEquilibrium) {
    let corners = [[3.0, 0.0, 4.0], [-3.0, 0.0, 4.0], [0.0, 3.0, 4.0], [0.0, -3.0, 4.0]];
    let mut joints: Vec<Joint> =
        corners.iter().enumerate().map(|(k, at)| Joint::anchor(k.to_string(), *at)).collect();
    joints.push(Joint::free("P").held_by(support));
    let member = |k: usize| Member::bar(k, 4, Bar::homogeneous(lengths_m[k], 0.0).unwrap());
    let members = (0..4).map(member).collect();
    let system = System::new("legs", 10.0, joints, members).unwrap();
    let mut joints_m = corners.to_vec();
    joints_m.push([0.0; 3]);
    (system, SystemEquilibrium { joints_m, ..lamp().1 })
}

/// Those along x against those along y: of 1 N in the first a quarter, with the signs + + - -.
#[test]
fn one_stress_is_left_where_four_bars_meet() {
    let (system, answer) = legs(Support::Free, [5.0; 4]);
    let family = Family::of(&system, &answer).unwrap();
    assert_eq!(family.dimension(), Some(1));
    // Whatever the signs.
    assert!((0..4).all(|member| family.takes_part(member)));
    let close = |found: &[f64], wanted: &[f64]| {
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{found}, not {wanted}");
        }
    };
    close(&family.part_of(&[1.0, 0.0, 0.0, 0.0]), &[0.25, 0.25, -0.25, -0.25]);
    close(&family.part_of(&[2.0, 0.0, 6.0, 4.0]), &[-2.0, -2.0, 2.0, 2.0]);
    // Each bar pulls the joint towards its corner.
    close(&family.left_by(&system, &[5.0, 10.0, 20.0, 40.0]), &[-3.0, -12.0, 60.0]);
    close(family.pull(1, 10.0).as_flattened(), &[6.0, 0.0, -8.0, -6.0, 0.0, 8.0]);
}

/// Held in a level plane the bars leave two stresses, on an upright line three, and four at an
/// anchor; one that is not at its length bears nothing.
#[test]
fn stresses_are_counted_against_motions_and_lengths() {
    let at_m = [0.0; 3];
    let count = |support: Support, lengths_m: [f64; 4]| {
        let (system, answer) = legs(support, lengths_m);
        Family::of(&system, &answer).unwrap().dimension().unwrap()
    };
    let plane = Support::Plane { at_m, normal: [0.0, 0.0, 1.0] };
    let line = Support::Line { at_m, direction: [0.0, 0.0, 1.0] };
    assert_eq!(count(plane, [5.0; 4]), 2);
    assert_eq!(count(line, [5.0; 4]), 3);
    assert_eq!(count(Support::Fixed { at_m }, [5.0; 4]), 4);
    for (off_m, dimension) in [(4e-9, 1), (-4e-9, 1), (6e-9, 0), (-6e-9, 0)] {
        assert_eq!(count(Support::Free, [5.0, 5.0, 5.0 + off_m, 5.0]), dimension, "{off_m}");
    }
    assert_eq!(count(Support::Free, [6.0; 4]), 0);
    let (system, mut answer) = legs(Support::Free, [5.0; 4]);
    answer.joints_m.truncate(4);
    assert!(Family::of(&system, &answer).is_none());
}

/// Two unit vectors at right angles to each other and to the normal, whatever its length.
#[test]
fn motions_in_a_plane_are_a_right_handed_pair() {
    let at_m = [0.0; 3];
    for normal in [[2.0, 3.0, 6.0], [-6.0, 2.0, 3.0], [3.0, -6.0, -2.0], [0.0, 0.0, 1.0]] {
        let [first, second] = Support::Plane { at_m, normal }.motions()[..] else { panic!() };
        let turned = cross(first, second);
        let along = times(1.0 / norm(normal), normal);
        assert!(norm(minus(turned, along)) < 1e-15, "{normal:?}");
        assert!((norm(first) - 1.0).abs() < 1e-15 && (norm(second) - 1.0).abs() < 1e-15);
    }
    let [along] = Support::Line { at_m, direction: [2.0, 3.0, 6.0] }.motions()[..] else {
        panic!()
    };
    assert!(norm(minus(along, [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0])) < 1e-15);
    assert!(Support::Fixed { at_m }.motions().is_empty());
    assert_eq!(Support::Free.motions(), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
}

/// (1, 2, 2) and (2, 4, 4) cancel as (2, -1)/√5; the other value is 3 √5, and a billionth counts.
#[test]
fn rows_cancel_to_a_billionth_of_the_largest_value() {
    let matrix = |off: f64| {
        let rows = [[1.0, 2.0, 2.0], [2.0, 4.0, 4.0 + off]];
        DMatrix::from_fn(2, 3, |row, column| rows[row][column])
    };
    let Null { rows: stresses, zero, .. } = null_rows(&matrix(0.0)).unwrap();
    assert!((zero / (3.0e-9 * 5.0_f64.sqrt()) - 1.0).abs() < 1e-14);
    let [stress] = &stresses[..] else { panic!("{stresses:?}") };
    assert!((stress[0] / stress[1] + 2.0).abs() < 1e-14, "{stress:?}");
    assert!((stress[0].hypot(stress[1]) - 1.0).abs() < 1e-14);
    // Their lesser value is `|off| |(2, -1)/√5 · (0, 1)| |across (1, 2, 2)| = off/√5 · √5/3`.
    assert_eq!(null_rows(&matrix(1.9e-8)).unwrap().rows.len(), 1);
    assert_eq!(null_rows(&matrix(2.2e-8)).unwrap().rows.len(), 0);
    assert!(null_rows(&DMatrix::zeros(0, 3)).unwrap().rows.is_empty());
    let all = null_rows(&DMatrix::zeros(2, 0)).unwrap();
    assert_eq!(all.rows, [[1.0, 0.0], [0.0, 1.0]]);
}

/// Eighty joints have 240 coordinates, the most that are counted.
#[test]
fn large_systems_are_not_counted() {
    let counted = |joints: usize| {
        let mut all: Vec<Joint> = (0..joints).map(|k| Joint::free(k.to_string())).collect();
        all.push(Joint::anchor("A", [0.0; 3]));
        let body = Bar::homogeneous(1.0, 0.0).unwrap();
        // Slack, so that no member counts.
        let members = (0..joints).map(|k| Member::cable(k, joints, body)).collect();
        let system = System::new("many", 10.0, all, members).unwrap();
        let mut joints_m = vec![[0.0, 0.0, -0.5]; joints];
        joints_m.push([0.0; 3]);
        Family::of(&system, &SystemEquilibrium { joints_m, ..lamp().1 }).unwrap().dimension()
    };
    assert_eq!((counted(80), counted(81)), (Some(0), None));
}

/// The four legs with one longer by 4e-9 m, next to the shape of the others: what remains at the shape
/// that meets all best is a quarter of it in each, with the signs of the self-stress. All lengths and
/// angles are alike, so its place follows from three balances by hand.
#[test]
fn what_no_shape_removes_is_the_part_of_the_self_stress() {
    let (system, answer) = legs(Support::Free, [5.0, 5.0, 5.0 + 4e-9, 5.0]);
    let at = |joints_m: Vec<Vector>| {
        let answer = SystemEquilibrium { joints_m, ..answer.clone() };
        Family::of(&system, &answer).unwrap().unremovable_m(&system)
    };
    // Distance less length at the old place is -4e-9 m of the third, of which -1e-9 m is against
    // those along x, whatever the place.
    let wanted = [1e-9, 1e-9, -1e-9, -1e-9];
    for off_m in [[0.0; 3], [1e-10, -2e-10, 3e-10]] {
        let mut joints_m = answer.joints_m.clone();
        joints_m[4] = off_m;
        for (found, wanted) in at(joints_m).into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 4e-15, "{found:e}, not {wanted:e}");
        }
    }
}

/// Of 16 N on the four legs each has 5 N: 1 N more in the first, with what balances it, is 1 N from
/// that. A cable without force stays without.
#[test]
fn equally_stiff_is_the_least_sum_of_squares_times_lengths() {
    let (system, answer) = legs(Support::Free, [5.0; 4]);
    let off = |system: &System, axial_n: [f64; 4]| {
        let reactions_n = vec![[0.0; 3]; 5];
        let answer = SystemEquilibrium { axial_n: axial_n.to_vec(), reactions_n, ..answer.clone() };
        let family = Family::of(system, &answer).unwrap();
        family.off_equally_stiff_n(system, &answer, 1e-9)
    };
    assert!(off(&system, [5.0; 4]) < 1e-14);
    assert!((off(&system, [6.0, 6.0, 4.0, 4.0]) - 1.0).abs() < 1e-14);
    assert!((off(&system, [10.0, 10.0, 0.0, 0.0]) - 5.0).abs() < 1e-14);
    let mut members = system.members().to_vec();
    members[2].kind = Kind::Cable;
    let joints = system.joints().to_vec();
    let with_cable = System::new("legs", 10.0, joints, members).unwrap();
    assert!(off(&with_cable, [10.0, 10.0, 0.0, 0.0]) < 1e-14);
}

/// A cable that has its length and bears nothing leaves forces open one way; against a second one
/// that stress would make push, none.
#[test]
fn signs_may_leave_nothing_open() {
    use Kind::{Bar, Cable, Strut};

    let (system, answer) = legs(Support::Free, [5.0; 4]);
    let open = |kinds: [Kind; 4], axial_n: [f64; 4]| {
        let mut members = system.members().to_vec();
        members.iter_mut().zip(kinds).for_each(|(member, kind)| member.kind = kind);
        let system = System::new("legs", 10.0, system.joints().to_vec(), members).unwrap();
        let answer = SystemEquilibrium { axial_n: axial_n.to_vec(), ..answer.clone() };
        Family::of(&system, &answer).unwrap().is_open(&system, &answer.axial_n, 1e-9)
    };
    assert!(open([Bar; 4], [0.0; 4]));
    assert!(open([Bar, Bar, Cable, Bar], [10.0, 10.0, 0.0, 0.0]));
    assert!(open([Bar, Bar, Cable, Cable], [10.0, 10.0, 0.0, 0.0]));
    assert!(!open([Cable, Bar, Cable, Bar], [0.0; 4]));
    assert!(open([Cable, Bar, Strut, Bar], [0.0; 4]));
    assert!(open([Cable, Bar, Cable, Bar], [5.0; 4]));
}

/// A self-stress that is named counts where the system is too large to count any, if it is one.
#[test]
fn named_self_stresses_count_if_they_are_in_balance() {
    let (system, mut answer) = legs(Support::Free, [5.0; 4]);
    let mut joints = system.joints().to_vec();
    joints.extend((0..80).map(|k| Joint::free(format!("loose {k}"))));
    answer.joints_m.extend(vec![[0.0; 3]; 80]);
    let system = System::new("large", 10.0, joints, system.members().to_vec()).unwrap();
    for (stress, dimension) in [([1.0, 1.0, -1.0, -1.0], Some(1)), ([1.0, 1.0, -1.0, -1.001], None)]
    {
        answer.evidence.self_stresses = Some(model::SelfStresses {
            dimension: 2,
            basis: vec![stress.to_vec(); 2],
            choice: model::ForceChoice::Unknown,
            misfit_m: None,
            ranges: None,
        });
        let family = Family::of(&system, &answer).unwrap();
        assert_eq!(family.dimension(), dimension);
        assert!(family.counts().is_none());
    }
}

/// Places are stored to 8 units in the last place of 5 m, 1e-14 m: a floor that is further below
/// does not bear anything.
#[test]
fn a_floor_is_touched_to_the_rounding_of_places() {
    let (system, answer) = legs(Support::Free, [5.0; 4]);
    let count = |floor_m: f64| {
        let system = system.clone().with_floor(floor_m).unwrap();
        Family::of(&system, &answer).unwrap().dimension()
    };
    assert_eq!([0.0, -5e-15].map(count), [Some(2); 2]);
    assert_eq!([-2e-14, -1e-12, -1e-9].map(count), [Some(1); 3]);
}

/// A bar may be off by its tolerance, and so may a cable that bears; one that does not by a rounding of its 4 m; a
/// spring has no length to be off from.
#[test]
fn misfits_are_those_of_members_at_their_lengths() {
    let body = Bar::homogeneous(4.0, 0.0).unwrap();
    let bar = Member::bar(0, 1, body);
    let cable = Member::cable(0, 1, body).with_length_tolerance(1e-3);
    for (member, off_m, bears, within) in [
        (bar.clone(), 3.9e-9, false, true),
        (bar.clone(), -3.9e-9, true, true),
        (bar.clone(), 4.1e-9, true, false),
        (bar.clone().with_length_tolerance(1e-3), -0.9e-3, false, true),
        (bar.clone().with_length_tolerance(1e-3), 1.1e-3, false, false),
        (cable.clone(), -0.9e-3, true, true),
        (cable.clone(), -0.9e-3, false, false),
        (cable.clone(), -3.9e-9, false, true),
        (cable.clone(), -4.1e-9, false, false),
        (bar.with_stiffness(1e6), 0.0, true, false),
    ] {
        let found = misfit(&member, 4.0 + off_m, bears);
        assert_eq!(found.is_some(), within, "{member:?} {off_m} {bears}");
        assert!(found.is_none_or(|found| (found - off_m).abs() < 1e-15));
    }
}

/// A ring on an upright line between bars of 4 m and 2 m: of 0.6 mm too long and 0.3 mm too short, together
/// 0.3 mm, the longer keeps two parts and the shorter one.
#[test]
fn what_no_shape_removes_is_shared_by_length() {
    let support = Support::Line { at_m: [0.0; 3], direction: [0.0, 0.0, 1.0] };
    let joints = vec![
        Joint::anchor("A", [0.0, 0.0, 4.0]),
        Joint::anchor("B", [0.0, 0.0, -2.0]),
        Joint::free("P").held_by(support),
    ];
    let member = |from: usize, length_m: f64| {
        Member::bar(from, 2, Bar::homogeneous(length_m, 0.0).unwrap()).with_length_tolerance(1e-3)
    };
    let members = vec![member(0, 3.9994), member(1, 2.0003)];
    let system = System::new("ring", 10.0, joints, members).unwrap();
    let joints_m = vec![[0.0, 0.0, 4.0], [0.0, 0.0, -2.0], [0.0; 3]];
    let family = Family::of(&system, &SystemEquilibrium { joints_m, ..lamp().1 }).unwrap();
    for (found, wanted) in family.unremovable_m(&system).iter().zip([0.2e-3, 0.1e-3]) {
        assert!((found - wanted).abs() < 1e-7, "{found}, not {wanted}");
    }
    let parts = family.part_of(&[1.0, 0.0]);
    assert!(parts.iter().all(|part| (part - 0.5).abs() < 1e-14), "{parts:?}");
}

/// A cable whose length is known to a millimetre takes part in self-stresses that far off where it
/// bears, and at its length alone where it does not.
#[test]
fn cables_that_bear_are_off_by_their_tolerance() {
    let count = |axial_n: f64| {
        let (system, mut answer) = legs(Support::Free, [5.0; 4]);
        let mut members = system.members().to_vec();
        let rope = Member::cable(0, 4, Bar::homogeneous(5.0 + 1e-4, 0.0).unwrap());
        members[0] = rope.with_length_tolerance(1e-3);
        answer.axial_n = vec![axial_n, 1.0, 1.0, 1.0];
        let roped = System::new("legs", 10.0, system.joints().to_vec(), members).unwrap();
        Family::of(&roped, &answer).unwrap().dimension()
    };
    assert_eq!((count(1.0), count(0.0)), (Some(1), Some(0)));
}
