//! Inputs that are no general position: the answer is honest, and never a wrong "complete".

use crate::support::{census, equal, problem};
use census::{Census, CensusError, Reason, Settings, TopologyError};

/// 1 + 1 + 1 − 1 = 2: four straight positions, isolated from all equilibria, level and oblique.
#[test]
fn a_straight_position_is_apart_from_all_equilibria() {
    for end in [[2.0, 0.0, 0.0], [1.5, 0.0, -2.0]] {
        let length = 0.5 * f64::hypot(end[0], end[2]);
        let chain = problem(&[(length, 1.0, 0.5 * length); 4], end);
        let census = census(&chain);
        assert!(census.complete, "{:?}", census.undecided);
        assert!(matches!(census.topology, Err(TopologyError::Straight { .. })));
        let along: Vec<_> = census.straight.iter().map(|straight| &straight.along).collect();
        assert_eq!(along, [[1, 1, 1, -1], [1, 1, -1, 1], [1, -1, 1, 1], [-1, 1, 1, 1]].each_ref());
        assert!(census.straight.iter().all(|straight| !straight.upright));
    }
}

/// In doubles 1.2² + 1.6² is not 2²: next to straight, and nothing is said.
#[test]
fn a_closure_within_rounding_of_straight_is_not_decided() {
    let census = census(&equal(4, [1.2, 0.0, -1.6]));
    assert!(!census.complete && census.straight.is_empty());
    assert!(matches!(census.topology, Err(TopologyError::Straight { .. })));
    for undecided in &census.undecided {
        assert_eq!((undecided.reason, undecided.pull_n), (Reason::Degenerate, None));
        assert!(undecided.at.iter().all(|part| part.width() < 1e-3));
    }
}

#[test]
fn a_nearly_straight_closure_is_complete() {
    for gap in [1e-3, 1e-6, 1e-9] {
        for sign in [-1.0, 1.0] {
            let census = census(&equal(4, [2.0 + sign * gap, 0.0, 0.0]));
            assert!(census.complete, "{gap:e}: {:?}", census.undecided);
        }
    }
}

/// 1 + 1 − 1 = 1: all bars upright, an equilibrium under any force.
#[test]
fn upright_bars_between_upright_anchors_are_a_family_of_forces() {
    let census = census(&equal(3, [0.0, 0.0, -1.0]));
    assert!(census.circles && census.straight.len() == 3);
    assert!(!census.complete && census.straight.iter().all(|straight| straight.upright));
    assert!(census.decided(), "{:?}", census.undecided);
}

#[test]
fn coincident_anchors_are_complete_if_the_lengths_are_generic() {
    let chain = [(0.7, 1.0, 0.35), (0.45, 0.5, 0.1), (0.6, 0.8, 0.4), (0.5, 0.3, 0.25)];
    let census = census(&problem(&chain, [0.0; 3]));
    assert!(census.complete && census.circles);
    // Polygons with four sides (here one circle) times the turn of the loop: a torus.
    assert_eq!(census.topology.as_ref().unwrap().betti, [1, 2, 1]);
    assert_eq!(census.alternating_sum(), 0);
}

/// The bars can lie folded in any direction, and infinite pulls in any direction hold them there;
/// but only upright they are equilibria. With four equal bars the second moment is the first that
/// does not vanish.
#[test]
fn coincident_anchors_and_lengths_that_cancel_are_decided() {
    // 0.7 + 0.4 and 0.6 + 0.5 are the same double.
    let chain = [(0.7, 1.0, 0.35), (0.4, 0.5, 0.1), (0.6, 0.8, 0.4), (0.5, 0.3, 0.25)];
    for problem in [equal(4, [0.0; 3]), problem(&chain, [0.0; 3])] {
        let census = census(&problem);
        assert!(!census.complete && census.decided(), "{:?}", census.undecided);
        assert!(!census.straight.is_empty());
        assert!(census.straight.iter().all(|straight| straight.upright));
        assert!(matches!(census.topology, Err(TopologyError::Straight { .. })));
    }
}

#[test]
fn slack_bars_make_families_that_the_topology_needs() {
    // Weights on strings: the two massless bars in the middle can hang slack.
    let chain =
        [(0.9, 0.0, 0.0), (0.4, 3.0, 0.2), (0.85, 0.0, 0.0), (1.0, 0.0, 0.0), (0.35, 2.0, 0.1)];
    let five = problem(&chain, [0.3, 0.0, 0.5]);
    let census = census(&five);
    assert!(census.complete, "{:?}", census.undecided);
    assert!(!census.families.is_empty());
    let topology = census.topology.as_ref().unwrap();
    assert_eq!(census.alternating_sum(), topology.euler);
    for family in &census.families {
        assert_eq!(&family.signs[2..4], [0, 0]);
        assert_eq!(family.dimension_in_plane, 0);
        assert_eq!(
            family.topology.as_ref().unwrap().betti,
            [2],
            "two slack bars: a triangle and its mirror image"
        );
        assert!(family.axial_n[2].contains(0.0));
        // It carries what hangs before the slack bars: 3 kg.
        assert!(family.pull_n[1].contains(-3.0 * 9.81));
    }
    // The lowest position of all: everything hangs, the middle is slack.
    let lowest = &census.families.iter().min_by(|a, b| a.energy_j.lo().total_cmp(&b.energy_j.lo()));
    let lowest = lowest.unwrap();
    assert_eq!((lowest.index_in_plane, &lowest.signs), (0, &vec![1, 1, 0, 0, 1]));
    // Bar 1 and half of bar 2 below the start; bar 5 below the end, its centre 0.25 from it.
    let energy = 9.81 * (3.0 * (-0.9 - 0.2) + 2.0 * (0.5 - 0.25));
    assert!((lowest.energy_j.mid() - energy).abs() < 1e-12, "{:?}", lowest.energy_j);
    // Without them the count is wrong, and the check says so.
    let mut wrong = census.clone();
    wrong.families.clear();
    assert!(wrong.check(&five).is_err() && wrong.morse().is_err());
}

/// "No other closes" would be wrong where slack bars close in ways of their own: the evidence names
/// them.
#[test]
fn the_evidence_of_completeness_names_the_slack_families() {
    let slack = [(0.9, 2.0, 0.3), (0.4, 0.0, 0.2), (0.45, 0.0, 0.2), (0.5, 1.5, 0.2)];
    let evidence = |end| {
        let census = census(&problem(&slack, end));
        let answer = census.to_model().remove(0);
        let complete = answer.evidence.ladder.complete;
        (census.equilibria.len(), census.families.len(), complete)
    };
    let (equilibria, families, complete) = evidence([0.3, 0.0, 0.9]);
    assert_eq!((equilibria, families, complete.proof().unwrap().families), (8, 2, 2));
    let how = complete.to_string();
    assert!(how.contains("besides 2 families with slack bars, and no other"), "{how}");
    // Out of reach of the slack bars there is none.
    let (_, families, complete) = evidence([1.5, 0.0, 0.1]);
    assert_eq!((families, complete.proof().unwrap().families), (0, 0));
    assert!(!complete.to_string().contains("slack"), "{complete}");
}

#[test]
fn three_slack_bars_are_a_curve_of_equilibria() {
    let chain =
        [(0.8, 1.0, 0.8), (0.5, 0.0, 0.0), (0.4, 0.0, 0.0), (0.3, 0.0, 0.0), (0.7, 1.0, 0.0)];
    let census = census(&problem(&chain, [0.43, 0.0, 0.1]));
    assert!(census.complete, "{:?}", census.undecided);
    assert!(!census.families.is_empty());
    assert!(census.families.iter().all(|family| family.dimension_in_plane == 1));
    assert_eq!(census.alternating_sum(), census.topology.as_ref().unwrap().euler);
}

/// Next to a fold the middle of a neighbourhood is so far from its zero that Krawczyk's test about
/// the middle fails: what the search proved about the zero, the check proves about the zero as
/// well.
#[test]
fn next_to_a_fold_the_check_proves_what_the_search_proved() {
    let bars = [
        (0.744_003_286_989_166_3, 0.295_321_229_436_031_84, 0.734_670_458_537_469),
        (0.800_934_968_638_009_8, 0.337_843_480_862_743_63, 0.252_195_513_658_455_1),
        (0.955_505_132_010_287, 0.371_962_658_396_993_55, 0.359_763_508_059_449_1),
        (0.606_212_031_725_482, 0.798_976_642_597_092_9, 0.357_182_036_441_701_43),
    ];
    let mut worst = 0.0_f64;
    // From a tenth of a length off the fold to the last place, at both its sides.
    for k in 0..=150 {
        for off in [-1.0, 1.0].map(|sign| sign * 10_f64.powf(-0.1 * f64::from(k) - 1.0)) {
            let end = [1.488_489_526_943_378_4, 0.0, 1.650_370_399_310_159_3 + off];
            let census = census(&problem(&bars, end));
            let conditions = census.equilibria.iter().map(|equilibrium| equilibrium.condition);
            worst = conditions.fold(worst, f64::max);
        }
    }
    // They are folds indeed.
    assert!(worst > 1e6, "{worst:e}");
}

/// Weight on an anchor acts on its reaction alone, however large it is.
#[test]
fn weight_on_an_anchor_takes_no_digits_from_the_rest() {
    /// Widest box of an angle, rad, and of an energy, J; measured: 1.3e-14 and 1e-13.
    const ANGLE_RAD: f64 = 4e-14;
    const ENERGY_J: f64 = 4e-13;
    let chain = |mass: f64| {
        problem(&[(1.0, mass, 0.0), (0.8, 1.0, 0.4), (0.9, 1.0, 0.45)], [1.0, 0.0, 0.3])
    };
    let light = census(&chain(1.0));
    assert!(light.complete && light.equilibria.len() == 8);
    let mut widest = [0.0_f64; 2];
    for mass in [0.0, 1e4, 1e8, 1e10, 1e14] {
        let heavy = census(&chain(mass));
        assert!(heavy.complete, "{mass:e}: {:?}", heavy.undecided);
        assert_eq!(heavy.equilibria.len(), 8, "{mass:e}");
        for (a, b) in heavy.equilibria.iter().zip(&light.equilibria) {
            assert_eq!((&a.signs, a.index_in_plane), (&b.signs, b.index_in_plane));
            for (x, y) in a.angles_rad.iter().zip(&b.angles_rad) {
                widest[0] = widest[0].max(x.width());
                assert!(x.width() < ANGLE_RAD && !x.disjoint(*y), "{mass:e}: {:e}", x.width());
            }
            widest[1] = widest[1].max(a.energy_j.width());
            assert!(a.energy_j.width() < ENERGY_J && !a.energy_j.disjoint(b.energy_j));
            // All joints but the first carry the same; the first carries the weight in addition.
            let pairs = a.multipliers_n.iter().zip(&b.multipliers_n).enumerate();
            for (joint, (x, y)) in pairs {
                let more = if joint == 0 { (mass - 1.0) * 9.81 } else { 0.0 };
                let off = (x[2].mid() - y[2].mid() - more).abs();
                assert!(
                    off <= 4.0 * f64::EPSILON * more.abs() + 1e-12,
                    "{mass:e} {joint}: {off:e}"
                );
            }
            assert!((a.pull_n[1].mid() + a.multipliers_n[0][2].mid()).abs() <= 0.0);
        }
    }
    println!("widest: {widest:?}");
}

#[test]
fn a_chain_too_long_is_refused_with_its_cost() {
    let result = Census::take(&equal(30, [2.5, 0.0, 0.0]), &Settings::default());
    let Err(error @ CensusError::TooManyBars { bars: 30, .. }) = result else {
        panic!("{result:?}")
    };
    assert!(error.to_string().contains("would take about"), "{error}");
    let long = Census::take(&equal(5000, [2.5, 0.0, 0.0]), &Settings::default());
    assert!(
        matches!(long, Err(CensusError::TooManyBars { estimate_s, .. }) if estimate_s.is_finite())
    );
}

/// The estimate knows a chain from another of the same length: the taut one has next to none.
#[test]
fn an_estimate_is_that_of_the_chain() {
    let mut all = vec![];
    for span in [2.2, 4.5, 8.3, 10.8] {
        let problem = equal(11, [span, 0.0, 0.31]);
        let estimate = Census::estimate(&problem);
        let found = census(&problem).equilibria.len() as f64;
        let ratio = estimate.equilibria.max(1.0) / found;
        println!("{span}: {:.0} estimated, {found} found", estimate.equilibria);
        assert!(found < 64.0 || (0.6..1.7).contains(&ratio), "{span}: {ratio}");
        all.push((found, estimate.seconds));
    }
    // More equilibria, more time.
    assert!(all.windows(2).all(|pair| pair[0].0 > pair[1].0 && pair[0].1 > pair[1].1), "{all:?}");
    assert!(all[0].1 > 10.0 * all[3].1, "{all:?}");
}

#[test]
fn a_spent_budget_is_said_so() {
    let settings = Settings { max_tests_per_pattern: 1, ..Settings::default() };
    let problem = equal(3, [1.5, 0.0, 0.2]);
    let census = Census::take(&problem, &settings).unwrap();
    assert!(!census.complete);
    assert!(census.undecided.iter().any(|undecided| undecided.reason == Reason::Budget));
    assert_eq!(census.check(&problem), Ok(()));
    let settings = Settings { max_tests_per_pattern: 0, ..Settings::default() };
    let result = Census::take(&problem, &settings);
    assert!(matches!(result, Err(CensusError::Setting { name: "max_tests_per_pattern", .. })));
}

#[test]
fn the_answer_does_not_depend_on_the_units() {
    let shape = |length: f64, mass: f64| {
        let chain = [(0.8, 1.0, 0.3), (0.5, 0.6, 0.2), (0.7, 0.4, 0.4), (0.6, 0.9, 0.3)];
        let chain = chain.map(|(l, m, r)| (l * length, m * mass, r * length));
        problem(&chain, [0.9 * length, 0.5 * length, -0.3 * length])
    };
    let reference = census(&shape(1.0, 1.0));
    for (length, mass) in [(1e-9, 1.0), (1e9, 1e-12), (3e-7, 7e15)] {
        let other = census(&shape(length, mass));
        assert!(other.complete);
        assert_eq!(other.equilibria.len(), reference.equilibria.len());
        for (a, b) in other.equilibria.iter().zip(&reference.equilibria) {
            assert_eq!((&a.signs, a.index_in_plane), (&b.signs, b.index_in_plane));
            // The data are rounded differently in each unit.
            for (x, y) in a.angles_rad.iter().zip(&b.angles_rad) {
                assert!((x.mid() - y.mid()).abs() < 1e-12);
            }
            let ratio = a.energy_j.mid() / b.energy_j.mid() / length / mass;
            assert!((ratio - 1.0).abs() < 1e-11, "{ratio}");
        }
    }
}

#[test]
fn every_case_of_the_registry_has_an_honest_answer() {
    for case in model::cases::all() {
        let problem = case.problem();
        if problem.chain().bars().len() > Settings::default().max_bars {
            let result = Census::take(&problem, &Settings::default());
            assert!(matches!(result, Err(CensusError::TooManyBars { .. })), "{}", case.name);
            continue;
        }
        let census = census(&problem);
        assert_eq!(census.complete, census.undecided.is_empty(), "{}", case.name);
        let energies = |census: &Census| census.equilibria[0].energy_j;
        assert!(census.families.is_empty() || !census.equilibria.is_empty(), "{}", case.name);
        assert!(energies(&census).width().is_finite(), "{}", case.name);
    }
}
