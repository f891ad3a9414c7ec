//! The best forces of random systems against every choice of members at their bounds, each solved by
//! nalgebra's singular value decomposition.

use model::Bar;
use model::system::{Joint, Member, Support};
use nalgebra::{DMatrix, DVector};
use numerics::vector::{minus, plus};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::foreign::bounds::TOLERANCE;
use crate::foreign::floor::laid;

/// Far below what is drawn.
const FLOOR_M: f64 = -4.0;
/// Members that are not rigid bars, at most: each doubles or trebles the choices.
const MOST_BOUNDED: usize = 6;

pub(in crate::foreign) fn vector(random: &mut ChaCha8Rng) -> Vector {
    [(); 3].map(|()| random.random_range(-3.0..3.0))
}

pub(in crate::foreign) fn unit(random: &mut ChaCha8Rng) -> Vector {
    let drawn = vector(random);
    times(1.0 / norm(drawn), drawn)
}

/// Two anchors, two oblique sliders, and joints that are free or lie on a floor, under loads of any
/// direction; bars, cables and struts, some too short or too long, some elastic.
fn drawn(random: &mut ChaCha8Rng) -> (System, Vec<Vector>) {
    let (at_m, direction, normal) = (vector(random), unit(random), unit(random));
    let mut joints = vec![
        Joint::anchor("A", vector(random)),
        Joint::anchor("B", vector(random)),
        Joint::free("C").held_by(Support::Line { at_m, direction }),
        Joint::free("D").held_by(Support::Plane { at_m, normal }),
    ];
    let free = random.random_range(0..3);
    joints.extend((0..free).map(|k| Joint::free(format!("P{k}"))));
    let mut places: Vec<Vector> = joints.iter().map(|_| vector(random)).collect();
    for (joint, place) in joints.iter_mut().zip(&mut places) {
        let on = joint.support.at_m().unwrap_or(*place);
        let off = minus(*place, on);
        *place = plus(on, joint.support.free_part(off));
        joint.force_n = vector(random);
    }
    let floor = free > 0 && random.random_bool(0.5);
    if floor {
        places[4][2] = FLOOR_M;
    }
    let mut members = vec![Member::bar(2, 3, Bar::homogeneous(1.0, 0.1).unwrap())];
    let mut bounded = 0;
    for _ in 0..random.random_range(2..10) {
        let [from, to] = [(); 2].map(|()| random.random_range(0..joints.len()));
        let twice =
            |m: &Member| [m.from.min(m.to), m.from.max(m.to)] == [from.min(to), from.max(to)];
        if from == to || members.iter().any(twice) {
            continue;
        }
        let distance = norm(minus(places[to], places[from]));
        let length = distance * [1.0, 1.0, 1.0, 0.8, 1.3][random.random_range(0..5)];
        let kind = [Kind::Bar, Kind::Cable, Kind::Cable, Kind::Strut][random.random_range(0..4)];
        let elastic = random.random_bool(0.25);
        if (elastic || kind != Kind::Bar) && bounded == MOST_BOUNDED {
            continue;
        }
        bounded += usize::from(elastic || kind != Kind::Bar);
        let mass_kg = random.random_range(0.0..0.2);
        let member =
            Member::bar(from, to, Bar::homogeneous(length, mass_kg).unwrap()).of_kind(kind);
        members.push(if elastic {
            member.with_stiffness(random.random_range(1.0..20.0))
        } else {
            member
        });
    }
    let bounds = Bounds::of_positions(&system_of(&joints, &members), &places, TOLERANCE);
    if random.random_bool(0.5) {
        // Loads that forces within the bounds balance.
        for joint in &mut joints {
            joint.force_n = [0.0; 3];
        }
        let mut left = system_of(&joints, &members).joint_loads_n();
        for member in &members {
            let along = minus(places[member.to], places[member.from]);
            let [low, high] = limits(member, norm(along), bounds.distance_m(member));
            let force = random.random_range(-5.0..5.0_f64).clamp(low, high);
            let pull = times(force / norm(along), along);
            left[member.from] = plus(left[member.from], pull);
            left[member.to] = minus(left[member.to], pull);
        }
        joints.iter_mut().zip(left).for_each(|(joint, left)| joint.force_n = times(-1.0, left));
    }
    let system = system_of(&joints, &members);
    (if floor { system.with_floor(FLOOR_M - 1e-9).unwrap() } else { system }, places)
}

fn system_of(joints: &[Joint], members: &[Member]) -> System {
    System::new("drawn", 10.0, joints.to_vec(), members.to_vec()).unwrap()
}

/// What the bounds of a member are, written once more.
fn limits(member: &Member, distance_m: f64, reach_m: f64) -> [f64; 2] {
    let length_m = member.body.length_m();
    let [low, high] = match member.kind {
        Kind::Bar => [f64::NEG_INFINITY, f64::INFINITY],
        Kind::Cable => [0.0, f64::INFINITY],
        Kind::Strut => [f64::NEG_INFINITY, 0.0],
    };
    if let Some(stiffness) = member.stiffness_n {
        let force =
            |reach: f64| (stiffness * ((distance_m + reach) / length_m - 1.0)).clamp(low, high);
        return [force(-reach_m), force(reach_m)];
    }
    match member.kind {
        Kind::Cable if distance_m < length_m - reach_m => [0.0; 2],
        Kind::Strut if distance_m > length_m + reach_m => [0.0; 2],
        _ => [low, high],
    }
}

/// The least that is left over, by all choices of which members are at which bound. One of them is
/// the best, with the others free and independent up to bars.
fn least_of_all(system: &System, places: &[Vector], reach_m: f64) -> f64 {
    let joints = system.joints();
    let projected = |joint: usize, vector: Vector| match joints[joint].support {
        Support::Free => vector,
        Support::Fixed { .. } => [0.0; 3],
        Support::Line { direction: d, .. } => times(dot(d, vector), d),
        Support::Plane { normal: n, .. } => minus(vector, times(dot(n, vector), n)),
    };
    let mut matrix = DMatrix::<f64>::zeros(3 * joints.len(), system.members().len());
    let mut bounds = Vec::new();
    for (k, member) in system.members().iter().enumerate() {
        let along = minus(places[member.to], places[member.from]);
        for (joint, sign) in [(member.from, 1.0), (member.to, -1.0)] {
            let part = projected(joint, times(sign / norm(along), along));
            (0..3).for_each(|c| matrix[(3 * joint + c, k)] = part[c]);
        }
        bounds.push(limits(member, norm(along), reach_m));
    }
    let loads = system.joint_loads_n().into_iter().enumerate();
    let loads: Vec<f64> = loads.flat_map(|(joint, load)| projected(joint, load)).collect();
    let loads = DVector::from_vec(loads);
    let choices = |[low, high]: &[f64; 2]| {
        let ends = [*low, *high].into_iter().filter(|end| end.is_finite()).map(Some);
        ends.chain((low < high).then_some(None)).collect::<Vec<_>>()
    };
    let mut all: Vec<Vec<Option<f64>>> = vec![vec![]];
    for bound in &bounds {
        let longer = |one: &Vec<_>| {
            choices(bound).into_iter().map(|end| [&one[..], &[end]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    let left = |choice: &Vec<Option<f64>>| {
        let held =
            DVector::from_iterator(choice.len(), choice.iter().map(|end| end.unwrap_or(0.0)));
        let right = -(&loads + &matrix * &held);
        let free: Vec<usize> = (0..choice.len()).filter(|k| choice[*k].is_none()).collect();
        let mut found = held;
        if !free.is_empty() {
            let columns = matrix.select_columns(&free);
            let solved = columns.svd(true, true).solve(&right, 1e-12).unwrap();
            free.iter().zip(solved.iter()).for_each(|(k, x)| found[*k] = *x);
        }
        let within = found
            .iter()
            .zip(&bounds)
            .all(|(x, [low, high])| (low - 1e-9..=high + 1e-9).contains(x));
        if within { (&loads + &matrix * found).norm() } else { f64::INFINITY }
    };
    all.iter().map(left).fold(f64::INFINITY, f64::min)
}

#[test]
fn no_other_choice_of_members_at_their_bounds_leaves_less() {
    let mut random = ChaCha8Rng::seed_from_u64(27);
    let (mut balanced, mut left_over) = (0, 0);
    for number in 0..400 {
        let (system, places) = drawn(&mut random);
        let bounds = Bounds::of_positions(&system, &places, TOLERANCE);
        let system = laid(&system, &places, &bounds);
        let best = best_forces(&system, &places, &bounds);
        let wanted = least_of_all(&system, &places, bounds.distance_m(&system.members()[0]));
        let scale = best.up_to_n / IMPLAUSIBLE;
        assert!(
            (best.residual_n - wanted).abs() < 1e-8 * scale,
            "{number}: {wanted} {best:?} {system:?}"
        );
        assert!(
            best.converged && best.least_n <= wanted + 1e-9 * scale,
            "{number}: {wanted} {best:?}"
        );
        if wanted < 1e-9 { balanced += 1 } else { left_over += 1 }
    }
    assert!(balanced > 100 && left_over > 100, "{balanced} {left_over}");
}
