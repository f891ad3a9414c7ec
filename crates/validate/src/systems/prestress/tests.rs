//! Strings between two anchors, by hand.

use model::Bar;
use model::system::{Joint, Member};

use super::*;

/// Members of these lengths one after the other along x, between anchors, at a height.
fn string(joints: &mut Vec<Joint>, members: &mut Vec<Member>, kind: Kind, z: f64, lengths: &[f64]) {
    let mut x = 0.0;
    joints.push(Joint::anchor(format!("start {z}"), [x, 0.0, z]));
    for (k, length_m) in lengths.iter().enumerate() {
        x += length_m;
        let name = format!("{z}.{k}");
        let last = k + 1 == lengths.len();
        joints.push(if last { Joint::anchor(name, [x, 0.0, z]) } else { Joint::free(name) });
        let body = Bar::homogeneous(*length_m, 0.0).unwrap();
        let end = joints.len() - 1;
        members.push(Member::bar(end - 1, end, body).of_kind(kind));
    }
}

fn stable(strings: &[(Kind, &[f64])], stress: Stress<'_>) -> PrestressStability {
    let (mut joints, mut members, mut places_m) = (vec![], vec![], vec![]);
    for (z, (kind, lengths)) in strings.iter().enumerate() {
        string(&mut joints, &mut members, *kind, z as f64, lengths);
        let mut x = 0.0;
        places_m.push([x, 0.0, z as f64]);
        for length_m in *lengths {
            x += length_m;
            places_m.push([x, 0.0, z as f64]);
        }
    }
    let system = System::new("strings", 10.0, joints, members).unwrap();
    prestress_stability(&system, &places_m, Standing::Supported, stress).unwrap()
}

/// 1 N in three members of 10, 1 and 10 m: moved together the two joints feel 1/10 N/m each, in two
/// directions; the densities are 1/10, 1 and 1/10, ten times what counts.
#[test]
fn a_string_is_held_however_soft_it_is_beside_its_shortest_member() {
    let found = stable(&[(Kind::Cable, &[10.0, 1.0, 10.0])], Stress::Given(&[1.0; 3]));
    assert_eq!((found.self_stresses, found.mechanisms), (1, 4));
    let Held::ByStress { stiffness_n_m } = found.held else { panic!("{found:?}") };
    assert!((stiffness_n_m - 0.1).abs() < 1e-13, "{stiffness_n_m}");
    // The other way round it drives them aside: by 2 + 1/10 where they move against each other.
    let found = stable(&[(Kind::Cable, &[10.0, 1.0, 10.0])], Stress::Given(&[-1.0; 3]));
    let Held::NotByThis { stiffness_n_m } = found.held else { panic!("{found:?}") };
    assert!((stiffness_n_m + 2.1).abs() < 1e-13, "{stiffness_n_m}");
}

/// One string of cables and one of bars, whose sign nobody asks for: each joint is held by 2 N/m
/// where both strings bear 1 N, and by no stress better. The search starts with cables alone.
#[test]
fn stresses_are_searched_beyond_what_the_signs_ask_for() {
    let strings: [(Kind, &[f64]); 2] = [(Kind::Cable, &[1.0, 1.0]), (Kind::Bar, &[1.0, 1.0])];
    let found = stable(&strings, Stress::Free);
    assert_eq!((found.self_stresses, found.mechanisms), (2, 4));
    let Held::ByStress { stiffness_n_m } = found.held else { panic!("{found:?}") };
    assert!((stiffness_n_m - 2.0).abs() < 1e-12, "{stiffness_n_m}");
    let stress = found.stress.unwrap();
    assert!(stress.iter().all(|force| (force - 1.0).abs() < 1e-12), "{stress:?}");
}

/// 5 N over 10 m are half a newton per metre, 2 N over half a metre four.
#[test]
fn rounding_is_a_part_of_the_largest_density() {
    let form = Form { motions: 1, by_force: vec![], lengths: vec![10.0, 0.5] };
    assert!((form.zero(&[5.0, -2.0]) / 4e-9 - 1.0).abs() < 1e-14);
}

/// Strings of bars, one after the other, as many steps of the search.
#[test]
fn stresses_are_searched_until_all_strings_bear_some() {
    let mut strings: Vec<(Kind, &[f64])> = vec![(Kind::Bar, &[1.0, 1.0]); 5];
    strings[0].0 = Kind::Cable;
    let found = stable(&strings, Stress::Free);
    assert_eq!((found.self_stresses, found.mechanisms), (5, 10));
    assert!(
        matches!(found.held, Held::ByStress { stiffness_n_m } if stiffness_n_m > 0.1),
        "{found:?}"
    );
}

/// A billionth of the largest force is rounding, on either side of nothing.
#[test]
fn cables_pull_and_struts_push_to_rounding() {
    let kinds = [Kind::Cable, Kind::Strut, Kind::Bar];
    let (mut joints, mut members) = (vec![], vec![]);
    for (z, kind) in kinds.into_iter().enumerate() {
        string(&mut joints, &mut members, kind, z as f64, &[1.0]);
    }
    let system = System::new("kinds", 10.0, joints, members).unwrap();
    for bar_n in [5.0, -5.0] {
        assert!(bears(&system, &[3.0, -3.0, bar_n]) && bears(&system, &[0.0, 0.0, bar_n]));
        assert!(bears(&system, &[-4e-9, 4e-9, bar_n]));
        assert!(!bears(&system, &[-6e-9, 0.0, bar_n]) && !bears(&system, &[0.0, 6e-9, bar_n]));
    }
    assert_eq!(kinds.map(sign).map(f64::to_bits), [1.0, -1.0, 0.0].map(f64::to_bits));
}

#[test]
fn vectors_are_scaled_to_one() {
    assert_eq!(normalised(&[3.0, -4.0]), Some(vec![0.6, -0.8]));
    assert_eq!((normalised(&[0.0, 0.0]), normalised(&[])), (None, None));
    assert_eq!(scaled(vec![3.0, -4.0]), Some(vec![0.75, -1.0]));
    assert_eq!((scaled(vec![0.0]), scaled(vec![])), (None, None));
}

/// Four joints with six bars, and five with ten: no stress, no proof. Ten bars between five joints
/// have one stress.
#[test]
fn without_stress_nothing_is_super_stable() {
    let simplex = |joints: usize| {
        let places_m =
            [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.25, 0.25, 0.25]];
        let all = (0..joints).map(|k| Joint::free(k.to_string())).collect();
        let mut members = vec![];
        for from in 0..joints {
            for to in from + 1..joints {
                let length_m = norm(minus(places_m[to], places_m[from]));
                let body = Bar::homogeneous(length_m, 0.0).unwrap();
                members.push(Member::bar(from, to, body));
            }
        }
        let count = members.len();
        (System::new("simplex", 10.0, all, members).unwrap(), places_m[..joints].to_vec(), count)
    };
    let (system, places_m, count) = simplex(4);
    let stress = vec![0.0; count];
    let given = Stress::Given(&stress);
    let found = prestress_stability(&system, &places_m, Standing::Free, given).unwrap();
    assert_eq!((found.self_stresses, found.mechanisms, found.super_stable), (0, 0, false));
    assert_eq!(found.held, Held::ByLengths);
    let (system, places_m, count) = simplex(5);
    let free = prestress_stability(&system, &places_m, Standing::Free, Stress::Free).unwrap();
    assert_eq!((free.self_stresses, free.mechanisms), (1, 0));
    // The inner joint is drawn to the outer ones or pressed: one of both is a proof.
    let proved = [1.0, -1.0].map(|sign| {
        let stress: Vec<f64> = free.stress.iter().flatten().map(|n| sign * n).collect();
        assert_eq!(stress.len(), count);
        let given = Stress::Given(&stress);
        prestress_stability(&system, &places_m, Standing::Free, given).unwrap().super_stable
    });
    assert_eq!(proved.into_iter().filter(|proved| *proved).count(), 1);
    let none = vec![0.0; count - 1];
    let short = Stress::Given(&none);
    assert!(prestress_stability(&system, &places_m, Standing::Free, short).is_none());
    let far = &places_m[..4];
    assert!(prestress_stability(&system, far, Standing::Free, Stress::Free).is_none());
    let mut met = places_m.clone();
    met[4] = met[0];
    assert!(prestress_stability(&system, &met, Standing::Free, Stress::Free).is_none());
    met[4] = [f64::NAN; 3];
    assert!(prestress_stability(&system, &met, Standing::Free, Stress::Free).is_none());
}
