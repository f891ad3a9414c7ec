//! Factors by closed forms.

use model::system::Kind;

use super::*;
use crate::net::framework::{Link, Node, Units};

/// Every one of so many free joints connected with every other.
fn complete(joints: usize) -> Framework {
    let node = Node { base: Vector3::zeros(), free: Directions::All, load: Vector3::zeros() };
    let pairs = (0..joints).flat_map(|to| (0..to).map(move |from| (from, to)));
    let link = |(from, to)| Link {
        from,
        to,
        length: 1.0,
        within: 0.0,
        compliance: 0.0,
        kind: Kind::Bar,
        rope: None,
    };
    Framework {
        units: Units { length_m: 1.0, force_n: 1.0, origin_m: Vector3::zeros() },
        nodes: vec![node; joints],
        links: pairs.map(link).collect(),
        ropes: Vec::new(),
        lying: Vec::new(),
        work: Work::default(),
    }
}

/// With unit weights and a shift the matrix is $a 1 - J$, $a = n + s$ and J full of ones. Its
/// leading minors are $a^{k-1} (a - k)$, so its pivots are $a (a - k)/(a - k + 1)$; one of its
/// eigenvalues is s, all others a.
#[test]
fn pivots_of_a_complete_graph_follow_from_its_minors() {
    for joints in [4, 150] {
        let framework = complete(joints);
        let mut stiffness = Stiffness::new(&framework, true).unwrap();
        let n = joints as f64;
        for (shift, negative) in [(0.5, 0), (-0.5, 1), (-n - 0.5, joints)] {
            stiffness.assemble_scalar(framework.links.iter().map(|_| 1.0));
            stiffness.shift(shift);
            assert!(stiffness.factorise_indefinite());
            assert_eq!(stiffness.negative_pivots(), negative);
            let pivots: Vec<f64> = stiffness.factor.pivots().to_vec();
            assert_eq!(pivots.len(), joints);
            let a = n + shift;
            for (k, pivot) in (1..).zip(pivots) {
                let rest = a - f64::from(k);
                let expected = a * rest / (rest + 1.0);
                assert!((pivot - expected).abs() < 1e-11 * expected.abs(), "{k}: {pivot}");
            }
        }
    }
}

/// The same in space: blocks of the identity make three such matrices.
#[test]
fn blocks_of_several_unknowns_are_counted_alike() {
    let framework = complete(40);
    let mut stiffness = Stiffness::new(&framework, false).unwrap();
    for (shift, negative) in [(0.5, 0), (-0.5, 3), (-40.5, 120)] {
        stiffness.assemble(&framework, framework.links.iter().map(|_| Matrix3::identity()));
        stiffness.shift(shift);
        assert!(stiffness.factorise_indefinite());
        assert_eq!(stiffness.negative_pivots(), negative);
        // The determinant.
        let log: f64 = stiffness.factor.pivots().iter().map(|pivot| pivot.abs().ln()).sum();
        let expected = 3.0 * (shift.abs().ln() + 39.0 * (40.0 + shift).abs().ln());
        assert!((log - expected).abs() < 1e-9);
    }
}
