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
