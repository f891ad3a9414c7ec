//! What bars, chains and problems refuse, with the numbers of the refusal.

use model::system::{Joint, Member, Refusal, System, SystemError};
use model::{Anchors, Bar, BarError, Chain, Problem, SMALLEST_TOTAL, STRAIGHT_TOLERANCE};

const HERE: Anchors = Anchors { start_m: [0.0; 3], end_m: [0.0; 3] };

fn apart(span_m: f64) -> Anchors {
    Anchors { start_m: [0.0; 3], end_m: [0.0, span_m, 0.0] }
}

fn bar(length_m: f64) -> Bar {
    Bar::homogeneous(length_m, 1.0).unwrap()
}

fn chain(anchors: Anchors, lengths_m: &[f64]) -> Chain {
    Chain::new("", 9.81, anchors, lengths_m.iter().map(|&l| bar(l)).collect()).unwrap()
}

fn refusal(anchors: Anchors, lengths_m: &[f64]) -> Refusal {
    Problem::new(chain(anchors, lengths_m)).unwrap_err()
}

fn accepted(anchors: Anchors, lengths_m: &[f64]) -> bool {
    Problem::new(chain(anchors, lengths_m)).is_ok()
}

#[test]
fn bars_refuse_numbers_out_of_range() {
    for length_m in [0.0, -0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Bar::homogeneous(length_m, 1.0), Err(BarError::Length(length_m)));
    }
    for mass_kg in [-1.0, -f64::MIN_POSITIVE, f64::INFINITY] {
        assert_eq!(Bar::homogeneous(1.0, mass_kg), Err(BarError::Mass(mass_kg)));
    }
    for centre_m in [-f64::MIN_POSITIVE, 2.0_f64.next_up(), f64::INFINITY] {
        let error = BarError::Centre { centre_m, length_m: 2.0 };
        assert_eq!(Bar::new(2.0, 1.0, centre_m, [0.0; 3]), Err(error));
    }
    for moment_kg_m2 in [-1.0, f64::INFINITY] {
        for k in 0..3 {
            let mut inertia = [1.0; 3];
            inertia[k] = moment_kg_m2;
            assert_eq!(Bar::new(1.0, 1.0, 0.5, inertia), Err(BarError::Inertia(moment_kg_m2)));
        }
    }
    let nan = f64::NAN;
    assert!(
        matches!(Bar::homogeneous(nan, 1.0), Err(BarError::Length(length_m)) if length_m.is_nan())
    );
    assert!(matches!(Bar::homogeneous(1.0, nan), Err(BarError::Mass(_))));
    assert!(matches!(Bar::new(1.0, 1.0, nan, [0.0; 3]), Err(BarError::Centre { .. })));
    assert!(matches!(Bar::new(1.0, 1.0, 0.5, [0.0, 0.0, nan]), Err(BarError::Inertia(_))));
}

#[test]
fn bars_accept_the_ends_of_their_ranges() {
    assert!(Bar::new(2.0, 0.0, 0.0, [0.0; 3]).is_ok());
    assert!(Bar::new(2.0, 0.0, 2.0, [0.0; 3]).is_ok());
    // Subnormal numbers are numbers.
    let tiny = Bar::homogeneous(1e-320, 1e-320).unwrap();
    assert!(tiny.centre_m() >= 0.0 && tiny.centre_m() <= tiny.length_m());
    assert!(Bar::new(f64::MAX, f64::MAX, 0.0, [f64::MAX; 3]).is_ok());
    assert_eq!(Bar::homogeneous(1e160, 1.0), Err(BarError::Inertia(f64::INFINITY)));
}

#[test]
fn chains_refuse_numbers_out_of_range() {
    let build = |gravity, anchors, bars| Chain::new("", gravity, anchors, bars);
    assert_eq!(build(9.81, HERE, vec![]), Err(SystemError::NoMembers));
    for gravity_m_s2 in [0.0, -9.81, f64::INFINITY] {
        assert_eq!(
            build(gravity_m_s2, HERE, vec![bar(1.0)]),
            Err(SystemError::Gravity(gravity_m_s2))
        );
    }
    assert!(matches!(build(f64::NAN, HERE, vec![bar(1.0)]), Err(SystemError::Gravity(_))));
    for k in 0..3 {
        let mut anchors = HERE;
        anchors.end_m[k] = f64::NEG_INFINITY;
        assert_eq!(
            build(9.81, anchors, vec![bar(1.0)]),
            Err(SystemError::Coordinate {
                name: "1".to_owned(),
                joint: 1,
                coordinate_m: f64::NEG_INFINITY
            })
        );
    }
}

#[test]
fn chains_refuse_totals_that_overflow_or_vanish() {
    let long = Bar::new(1e150, 0.0, 0.0, [0.0; 3]).unwrap();
    let heavy = Bar::new(1.0, 1e150, 0.0, [0.0; 3]).unwrap();
    let far = Anchors { start_m: [-1e150, 0.0, 0.0], end_m: [1e150, 0.0, 0.0] };
    let overflow = |quantity| Err(SystemError::Overflow(quantity));
    let build = |anchors, bars: &[Bar]| Chain::new("", 1.0, anchors, bars.to_vec());
    assert_eq!(build(far, &[bar(1.0)]), overflow("span"));
    assert_eq!(build(HERE, &[long, long]), overflow("total length"));
    assert_eq!(build(HERE, &[heavy, heavy]), overflow("total weight"));
    assert_eq!(build(HERE, &[heavy, bar(1.0)]), overflow("total weight times total length"));
    assert!(build(HERE, &[long]).is_ok(), "long and massless");

    let underflow = |quantity, total| Err(SystemError::Underflow { quantity, total });
    let least = SMALLEST_TOTAL;
    let with = |length, mass| Bar::new(length, mass, 0.0, [0.0; 3]).unwrap();
    assert!(build(HERE, &[with(least, 1.0)]).is_ok());
    let shorter = least.next_down();
    assert_eq!(build(HERE, &[with(shorter, 1.0)]), underflow("total length", shorter));
    assert!(build(HERE, &[with(1.0, least)]).is_ok());
    assert_eq!(build(HERE, &[with(1.0, shorter)]), underflow("total weight", shorter));
    let product = "total weight times total length";
    assert_eq!(build(HERE, &[with(1e-160, 1e-160)]), underflow(product, 1e-160 * 1e-160));
    // A chain without mass has no weight to lose.
    assert!(build(HERE, &[with(least, 0.0)]).is_ok());
}

/// A double holds 53 bits: 1 + 2^-53 = 1, and with the next larger double it is more. Massless bars do
/// not count.
#[test]
fn masses_that_are_lost_in_others_are_refused() {
    let with = |mass| Bar::new(1.0, mass, 0.5, [0.0; 3]).unwrap();
    let build = |light: f64| Chain::new("", 1.0, HERE, vec![with(light), with(0.0), with(1.0)]);
    let lost = (-53.0_f64).exp2();
    let refused = SystemError::MassRange { lightest_kg: lost, heaviest_kg: 1.0 };
    assert_eq!(build(lost), Err(refused));
    assert!(build(lost.next_up()).is_ok());
    // The same at joints.
    let pendulum = |light: f64| {
        let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(1.0)];
        System::new("", 1.0, joints, vec![Member::bar(0, 1, with(light))]).map(|_| ())
    };
    let refused = SystemError::MassRange { lightest_kg: lost, heaviest_kg: 1.0 };
    assert_eq!(pendulum(lost), Err(refused));
    assert_eq!(pendulum(lost.next_up()), Ok(()));
}

#[test]
fn taut_is_equal_up_to_rounding_and_no_more() {
    let (from, to, joint) = ("0".to_owned(), "3".to_owned(), 3);
    let taut = Refusal::Taut { from, to, joint, distance_m: 3.0, reach_m: 3.0 };
    assert_eq!(refusal(apart(3.0), &[1.0, 1.5, 0.5]), taut);
    // 0.1 + 0.2 is not 0.3 in doubles; the decimals mean a taut chain.
    assert!(matches!(refusal(apart(0.3), &[0.1, 0.2]), Refusal::Taut { .. }));
    assert!(matches!(refusal(apart(0.7), &[0.1; 7]), Refusal::Taut { .. }));
    // On both sides of the tolerance, which is 16 units of the rounding.
    let step = 3.0 * STRAIGHT_TOLERANCE;
    assert!(matches!(refusal(apart(3.0 - 0.9 * step), &[1.0; 3]), Refusal::Taut { .. }));
    assert!(matches!(refusal(apart(3.0 + 0.9 * step), &[1.0; 3]), Refusal::Taut { .. }));
    assert!(accepted(apart(3.0 - 1.5 * step), &[1.0; 3]));
    let far = refusal(apart(3.0 + 1.5 * step), &[1.0; 3]);
    assert!(matches!(far, Refusal::OutOfReach { reach_m: 3.0, .. }), "{far}");
}

#[test]
fn folded_is_equal_up_to_rounding_and_no_more() {
    let names = |all: &str| all.chars().map(String::from).collect::<Vec<_>>();
    let folded = |member: usize, length_m: f64, way: &str| {
        let [from, to] = [member - 1, member].map(|joint| joint.to_string());
        Refusal::Folded { member, from, to, length_m, way: names(way) }
    };
    let too_long = |member: usize, length_m: f64, rest_m: f64, way: &str| {
        let [from, to] = [member - 1, member].map(|joint| joint.to_string());
        Refusal::TooLong { member, from, to, length_m, rest_m, way: names(way) }
    };
    assert_eq!(refusal(apart(2.0), &[0.5, 3.0, 0.5]), folded(2, 3.0, "1032"));
    assert_eq!(refusal(apart(2.0), &[0.5, 0.5, 3.5]), too_long(3, 3.5, 3.0, "2103"));
    let step = 4.0 * STRAIGHT_TOLERANCE;
    assert!(matches!(refusal(apart(2.0), &[0.5, 3.0 - 0.9 * step, 0.5]), Refusal::Folded { .. }));
    assert!(matches!(refusal(apart(2.0), &[0.5, 3.0 + 0.9 * step, 0.5]), Refusal::Folded { .. }));
    assert!(accepted(apart(2.0), &[0.5, 3.0 - 1.5 * step, 0.5]));
    assert!(matches!(
        refusal(apart(2.0), &[0.5, 3.0 + 1.5 * step, 0.5]),
        Refusal::TooLong { member: 2, .. }
    ));
    // Two equal bars from one point back to it can only fold; the first of them is named.
    assert_eq!(refusal(HERE, &[1.0, 1.0]), folded(1, 1.0, "021"));
    assert_eq!(refusal(HERE, &[1.0, 1.5]), too_long(2, 1.5, 1.0, "102"));
    assert!(accepted(HERE, &[1.0, 1.0, 1.0]));
    assert_eq!(refusal(HERE, &[1.0, 2.0, 1.0]), folded(2, 2.0, "1032"));
}

#[test]
fn single_bars_are_refused_for_what_they_are() {
    assert_eq!(refusal(apart(2.0), &[2.0]), Refusal::NothingMoves);
    assert!(matches!(refusal(apart(2.0), &[1.0]), Refusal::OutOfReach { .. }));
    assert!(matches!(refusal(apart(2.0), &[3.0]), Refusal::TooLong { member: 1, rest_m: 2.0, .. }));
    let massless = Bar::homogeneous(2.0, 0.0).unwrap();
    let single = Chain::new("", 1.0, apart(2.0), vec![massless]).unwrap();
    assert_eq!(Problem::new(single), Err(Refusal::NothingMoves));
}

#[test]
fn chains_without_mass_are_refused_before_their_shape() {
    let massless = vec![Bar::homogeneous(1.0, 0.0).unwrap(); 3];
    let far = Chain::new("", 1.0, apart(9.0), massless.clone()).unwrap();
    assert_eq!(Problem::new(far), Err(Refusal::NoLoad));
    let mut one = massless;
    one[1] = bar(1.0);
    assert!(Problem::new(Chain::new("", 1.0, apart(2.0), one).unwrap()).is_ok());
}

#[test]
fn weight_on_the_anchors_alone_is_refused_and_weight_beside_them_is_not() {
    let problem = |bars: [(f64, f64); 3]| {
        let bars = bars.map(|(mass, centre)| Bar::new(1.0, mass, centre, [0.0; 3]).unwrap());
        Problem::new(Chain::new("", 1.0, apart(1.5), bars.to_vec()).unwrap())
    };
    let refused = Err(Refusal::LoadOnAnchors);
    assert_eq!(problem([(2.0, 0.0), (0.0, 0.5), (3.0, 1.0)]), refused);
    assert_eq!(problem([(0.0, 0.7), (0.0, 0.5), (3.0, 1.0)]), refused);
    // The least part of a weight at a joint that can move, from either side, is one.
    for loaded in [
        [(2.0, 1e-300), (0.0, 0.5), (3.0, 1.0)],
        [(2.0, 0.0), (1e-15, 0.5), (3.0, 1.0)],
        [(2.0, 0.0), (0.0, 0.5), (3.0, 1.0 - f64::EPSILON)],
        [(2.0, 1.0), (0.0, 0.5), (0.0, 1.0)],
    ] {
        assert!(problem(loaded).is_ok(), "{loaded:?}");
    }
}

#[test]
fn refusals_do_not_depend_on_the_unit_of_length() {
    for scale in [1e-100, 1e-9, 1.0, 1e9, 1e100] {
        let lengths = [scale, scale, scale];
        assert!(accepted(apart(2.0 * scale), &lengths));
        assert!(accepted(HERE, &lengths));
        assert!(matches!(refusal(apart(3.0 * scale), &lengths), Refusal::Taut { .. }));
        assert!(matches!(refusal(apart(4.0 * scale), &lengths), Refusal::OutOfReach { .. }));
        let long = [scale, 5.0 * scale, scale];
        assert!(matches!(refusal(apart(2.0 * scale), &long), Refusal::TooLong { member: 2, .. }));
    }
}

#[test]
fn far_anchors_leave_the_span_uncertain() {
    let at = |x: f64, span: f64| Anchors { start_m: [x, 0.0, 0.0], end_m: [x + span, 0.0, 0.0] };
    // 1e12 m away doubles are 1.2e-4 m apart.
    assert!(accepted(at(1e12, 2.0), &[1.0; 3]));
    assert!(accepted(at(1e12, 2.0), &[1.0, 1.001]));
    let unresolved = refusal(at(1e12, 2.0), &[1.0, 1.0001]);
    let Refusal::Unresolved { coordinate_m, rounding_m, margin_m } = unresolved else {
        panic!("{unresolved:?}")
    };
    assert!((coordinate_m - (1e12 + 2.0)).abs() < 0.5);
    // Six coordinates, each half a unit in the last place off: at most 3 times 2^-52 of the
    // largest.
    assert!((rounding_m / (3.0 * f64::EPSILON * coordinate_m) - 1.0).abs() < 1e-15);
    assert!((margin_m - 1e-4).abs() < 1e-12);
    assert!(
        matches!(refusal(at(1e12, 2.0), &[1.0, 0.9999]), Refusal::Unresolved { margin_m, .. } if margin_m < 0.0)
    );
    assert!(matches!(refusal(at(1e12, 2.0), &[1.0, 0.99]), Refusal::OutOfReach { .. }));
    assert!(matches!(refusal(at(1e12, 2.0), &[3.0001, 1.0]), Refusal::Unresolved { .. }));
    assert!(matches!(refusal(at(1e12, 2.0), &[3.01, 1.0]), Refusal::TooLong { .. }));
    // So far away that the anchors coincide.
    assert!(matches!(refusal(at(1e20, 2.0), &[1.0; 3]), Refusal::Unresolved { .. }));
}

#[test]
fn spans_are_right_at_every_scale() {
    let span = |x: f64, y: f64, z: f64| Anchors { start_m: [0.0; 3], end_m: [x, y, z] }.span_m();
    // 2² + 3² + 6² = 7².
    for scale in [1e-300, 1e-160, 1.0, 1e160, 1e300] {
        let ratio = span(2.0 * scale, -3.0 * scale, 6.0 * scale) / (7.0 * scale);
        assert!((ratio - 1.0).abs() <= 2.0 * f64::EPSILON, "{scale:e}: {ratio}");
    }
    // Far from the origin the difference of the coordinates is exact.
    let far = Anchors { start_m: [1e15, -1e15, 0.0], end_m: [1e15 + 3.0, 4.0 - 1e15, 0.0] };
    assert_eq!(far.span_m().to_bits(), 5.0_f64.to_bits());
}

#[test]
fn totals_do_not_drift_over_a_million_bars() {
    let bar = Bar::homogeneous(0.1, 0.3).unwrap();
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
    let chain = Chain::new("long", 9.81, anchors, vec![bar; 1_000_000]).unwrap();
    // 0.1 and 0.3 are not exact in binary; a million times their doubles is what the sum must be.
    assert!((chain.total_length_m() - 1e6 * 0.1).abs() <= 1e5 * f64::EPSILON);
    assert!((chain.total_mass_kg() - 1e6 * 0.3).abs() <= 3e5 * f64::EPSILON);
}

#[test]
fn totals_keep_what_is_small_beside_the_large() {
    // Added one by one, each of the million would be lost: doubles near 1e9 are 1.2e-7 apart.
    let mut bars = vec![bar(1e-9); 1_000_001];
    bars[0] = bar(1e9);
    let chain = Chain::new("uneven", 9.81, HERE, bars).unwrap();
    assert!((chain.total_length_m() - (1e9 + 1e-3)).abs() <= 1e9 * f64::EPSILON);
}

/// 10 kg and 98.0665 N upwards, at a joint or by the halves of the bars beside it, leave rounding; a hundred times that is a load.
#[test]
fn loads_that_cancel_are_none() {
    for (bar_kg, joint_kg, up_n, refused) in [
        (0.0, 10.0, 98.0665, true),
        (4.0, 6.0, 98.0665, true),
        (0.0, 10.0, 98.0665 * (1.0 - 1e-13), false),
        (0.0, 10.0, 98.0, false),
    ] {
        let bar = Bar::homogeneous(1.0, bar_kg).unwrap();
        let lifted = Joint::free("P").with_mass(joint_kg).with_force([0.0, 0.0, up_n]);
        let ends = [Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [1.0, 0.0, 0.0])];
        let joints = ends.into_iter().chain([lifted]).collect();
        let members = vec![Member::bar(0, 2, bar), Member::bar(1, 2, bar)];
        let system = System::new("", 9.80665, joints, members).unwrap();
        assert_eq!(system.refusal() == Err(Refusal::LoadsCancel), refused, "{bar_kg} {up_n}");
    }
}

/// A chain is refused as the joints and members that it is, to the number; a single bar for that nothing moves.
#[test]
fn a_chain_and_its_system_are_refused_alike() {
    for (anchors, lengths) in [
        (apart(3.5), &[1.0; 3][..]),
        (apart(3.0), &[1.0; 3]),
        (apart(2.0), &[0.5, 3.0, 0.5]),
        (apart(2.0), &[0.5, 0.5, 3.5]),
        (HERE, &[1.0, 1.5]),
        (apart(2.0), &[2.0]),
        (apart(2.0), &[1.0, 1.0, 9.0, 1.0, 1.0, 1.0, 1.0]),
        (Anchors { start_m: [1e12, 0.0, 0.0], end_m: [1e12 + 2.0, 0.0, 0.0] }, &[1.0, 1.0001]),
    ] {
        let bars = lengths.iter().map(|length_m| bar(*length_m)).collect();
        let chain = Chain::new("", 9.81, anchors, bars).unwrap();
        let system = System::from(&chain).refusal();
        assert_eq!(Problem::new(chain).map(|_| ()), system, "{lengths:?}");
    }
}
