//! Section VIII closed by the census, and everything that rests on it falls with it.

use model::Rung;
use paper::completeness::Completeness;
use paper::example::Example;
use paper::printed::Paper;

/// Section VIII, closed: four in the plane, two circles, (x) not among them, (ix) not exactly one.
#[test]
fn section_viii_is_closed() {
    let (paper, example) = (Paper::project(), Example::solve().unwrap());
    let proof = Completeness::new(&paper, &example);
    println!("{proof:?}");
    assert!(proof.is_closed());
    assert_eq!((proof.planar, proof.circles), (4, 2));
    assert_eq!((proof.euler, proof.sextic_roots), (Some(0), Some(2)));
    assert_eq!(proof.by_index, [2, 2]);
    // At theta = 0 the slope is sqrt(3)/2 exactly; (x) is the first point of the scan.
    let [low, high] = proof.second.slope_mgl;
    assert!(low > 0.86 && high < 0.87 && high - low < 1e-5, "{low} {high}");
    // The nearest is E1', by alpha: -38.59914 against 299.94274 - 360.
    assert!((proof.second.nearest_deg - 21.458_12).abs() < 1e-4);
    // (ix) is within a step of the scan, 0.001 rad, of E1, but not at it.
    assert!(proof.first.is_refuted() && proof.first.nearest_deg > 0.01);
    assert!(proof.first.nearest_deg < 0.001_f64.to_degrees());
}

#[test]
fn a_tampered_census_does_not_close_section_viii() {
    let (paper, example) = (Paper::project(), Example::solve().unwrap());
    let closed = |change: &dyn Fn(&mut Example)| {
        let mut example = example.clone();
        change(&mut example);
        Completeness::new(&paper, &example).is_closed()
    };
    assert!(closed(&|_| ()));
    assert!(!closed(&|e| e.census.complete = false));
    assert!(!closed(&|e| drop(e.census.equilibria.pop())));
    assert!(!closed(&|e| e.census.equilibria.clear()));
    assert!(!closed(&|e| e.census.equilibria[0].index_in_plane = 1));
    assert!(!closed(&|e| e.census.equilibria[1].multipliers_n[2][2] = census::Interval::ONE));
    assert!(!closed(&|e| e.census.equilibria[1].joints_m[2][2] = census::Interval::LINE));
    // If the paper printed E2, (x) would be one of the equilibria.
    let mut other = Paper::project();
    for (id, text) in [("x-theta", "73.92059"), ("x-alpha", "321.40086"), ("x-beta", "340.30513")] {
        text.clone_into(&mut other.claims.iter_mut().find(|c| c.id == id).unwrap().printed);
    }
    let proof = Completeness::new(&other, &example);
    assert!(!proof.second.is_refuted() && proof.second.nearest_deg <= 0.0 && !proof.is_closed());
}

/// The claims that rest on the census fall with it, and no others.
#[test]
fn the_claims_rest_on_the_census() {
    let (paper, example) = (Paper::project(), Example::solve().unwrap());
    let surveys = paper::seeds::surveys(&example, 300);
    let unexpected = |change: &dyn Fn(&mut Example)| -> Vec<String> {
        let mut example = example.clone();
        change(&mut example);
        let judged = paper::claims::claims(&paper, &example, &surveys);
        judged.into_iter().filter(|claim| !claim.as_expected).map(|c| c.printed.id).collect()
    };
    assert_eq!(unexpected(&|_| ()), Vec::<String>::new());
    let fallen = ["x-listed", "four", "infinity"];
    assert_eq!(unexpected(&|e| drop(e.census.equilibria.pop())), fallen);
    assert_eq!(unexpected(&|e| e.census.equilibria[1].index_in_plane = 0), fallen);
    assert_eq!(unexpected(&|e| e.census.complete = false), fallen);
}

/// In the reproduction E1 and its mirror image alone stand on the highest rung.
#[test]
fn only_e1_is_optimal_in_the_reproduction() {
    let r = crate::reproduction::reproduction();
    let rungs: Vec<_> = r.equilibria.iter().map(|p| (p.name, p.rung().unwrap())).collect();
    let expected = [
        ("E1", Rung::Optimal),
        ("E1'", Rung::Optimal),
        ("E2", Rung::Complete),
        ("E2'", Rung::Complete),
    ];
    assert_eq!(rungs, expected);
    for position in &r.equilibria {
        let reached = |rung| position.ladder.is_reached(rung);
        assert!(reached(Rung::Verified) && reached(Rung::Complete), "{position:?}");
        assert_eq!(reached(Rung::Agreed), position.name.starts_with("E1"));
    }
}

/// The enclosed slope, and the nearest equilibrium, if these angles were printed as (x), deg.
fn slope_mgl(angles: [(&str, usize); 3]) -> [f64; 2] {
    let mut paper = Paper::project();
    for (id, (text, digits)) in ["x-theta", "x-alpha", "x-beta"].into_iter().zip(angles) {
        let printed = paper.claims.iter_mut().find(|claim| claim.id == id).unwrap();
        text.clone_into(&mut printed.printed);
        printed.digits = Some(digits);
    }
    Completeness::new(&paper, &crate::claims::solved().0).second.slope_mgl
}

/// Closed form of the example, and the zero at E1.
#[test]
fn the_slope_is_that_of_the_paper() {
    // theta = 0, alpha = −60°, beta = 60°: √3/2.
    let [low, high] = slope_mgl([("0", 14), ("300", 14), ("60", 14)]);
    let exact = 0.75_f64.sqrt();
    assert!(low < exact && exact < high && high - low < 1e-13, "{low} {high}");
    let [low, high] = slope_mgl([
        ("19.69486797613302", 13),
        ("38.59913618445189", 13),
        ("286.07941120776866", 13),
    ]);
    assert!(low < 0.0 && 0.0 < high && high - low < 1e-12, "{low} {high}");
    // Of all angles nothing is known.
    let [low, high] = slope_mgl([("NaN", 0), ("0", 3), ("0", 3)]);
    assert!(low < f64::MIN && high > f64::MAX, "{low} {high}");
}

/// All along the closure curve, where the chain does not turn back in theta.
#[test]
fn the_slope_is_that_of_the_energy_along_the_curve() {
    let mut met = 0;
    for point in energy::example::curve(12) {
        let exact = energy::example::slope(point.theta_rad, point.branch);
        let angles = [point.theta_rad, point.alpha_rad, point.beta_rad];
        let text = angles.map(|angle| format!("{:.12}", angle.to_degrees().rem_euclid(360.0)));
        let [low, high] = slope_mgl([(&text[0], 12), (&text[1], 12), (&text[2], 12)]);
        if exact.abs() < 10.0 {
            assert!(low < exact && exact < high && high - low < 1e-10, "{low} {exact} {high}");
            met += 1;
        }
    }
    assert!(met > 16, "{met}");
}
