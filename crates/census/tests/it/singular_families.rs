//! Slack bars that also fit into one line in between, or close upon themselves: their positions are no
//! manifold, and all of them are equilibria.

use census::{Census, Settings, TopologyError};
use model::{Anchors, Bar, Chain, Problem, Reason, Status};

/// Bars as (length, mass).
fn census(bars: &[(f64, f64)], end_m: [f64; 3]) -> Census {
    let bars = bars.iter().map(|(l, m)| Bar::homogeneous(*l, *m).unwrap()).collect();
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    let problem = Problem::new(Chain::new("slack", 10.0, anchors, bars).unwrap()).unwrap();
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert_eq!(census.check(&problem), Ok(()));
    census
}

/// Under a bar of 1 m that hangs, three of 1 m without mass over 1 m: 1 + 1 - 1 = 1, in three ways. With
/// a gap a thousandth longer or shorter each way has an equilibrium of its own, with a little force,
/// besides the same family, which is a manifold then; all others stay, and move a little.
#[test]
fn bars_that_also_fit_into_one_line_are_a_family_all_the_same() {
    let bars = [(1.0, 1.0), (1.0, 0.0), (1.0, 0.0), (1.0, 0.0)];
    let at = census(&bars, [1.0, 0.0, -1.0]);
    assert!(at.decided() && !at.complete && at.degenerate.is_empty());
    let families: Vec<_> = at.families.iter().map(|f| (&f.signs[..], &f.topology)).collect();
    let straight = |k| Err(TopologyError::Straight { sides: vec![k, 4] });
    // Standing, bar 1 leaves 2.2 m, over which no three signs of 1 m reach in one line.
    let [(hanging, singular), (standing, regular)] = families[..] else { panic!("{families:?}") };
    assert_eq!((hanging, standing), (&[1, 0, 0, 0][..], &[-1, 0, 0, 0][..]));
    assert!((1..=3).any(|k| *singular == straight(k)), "{singular:?}");
    // 1, 1, 1, √5: one circle, as for any gap from 1 to 3.
    assert_eq!(regular.as_ref().unwrap().betti, [1, 1]);
    assert_eq!([0, 1].map(|k| at.families[k].dimension_in_plane()), [1, 1]);
    // Bar 1 carries half its weight, 5 N, and hangs 0.5 m deep in the middle.
    assert!((at.families[0].energy_j.mid() + 5.0).abs() < 1e-14);
    let reason = Status::Open(Reason::SingularFamilies { listed: 1 });
    assert_eq!(at.completeness(), reason);

    for apart in [-1e-3, 1e-3] {
        let near = census(&bars, [1.0 + apart, 0.0, -1.0]);
        assert!(near.complete && near.families.len() == 2, "{apart}");
        assert_eq!(near.equilibria.len(), at.equilibria.len() + 3, "{apart}");
        let (soft, others): (Vec<_>, Vec<_>) =
            near.equilibria.iter().partition(|e| e.axial_n[1].mag() < 0.1);
        // Bar 1 leans by a thousandth: 5 N times that.
        assert_eq!(soft.len(), 3);
        assert!(soft.iter().all(|e| (e.axial_n[1].mag() - 5e-3).abs() < 1e-4), "{soft:?}");
        for (one, other) in at.equilibria.iter().zip(others) {
            assert_eq!(one.signs, other.signs, "{apart}");
            assert!((one.energy_j.mid() - other.energy_j.mid()).abs() < 0.1, "{apart}");
        }
    }
}

/// A triangle of 1 m without mass hangs from a bar of 1 m that ends at the anchor, and turns about it:
/// two circles, it and its mirror image.
#[test]
fn bars_that_close_upon_themselves_turn_about_a_point() {
    let triangle = census(&[(1.0, 1.0), (1.0, 0.0), (1.0, 0.0), (1.0, 0.0)], [0.0, 0.0, -1.0]);
    let family = triangle.families.iter().find(|f| f.signs == [1, 0, 0, 0]).unwrap();
    assert_eq!(family.topology.as_ref().unwrap().betti, [2, 2]);
    assert_eq!((family.dimension_in_plane(), family.index_in_plane), (1, 0));
    assert_eq!((family.gap_m.lo(), family.gap_m.hi()), (0.0, 0.0));
    assert!((family.energy_j.mid() + 5.0).abs() < 1e-14);
    // Standing it leaves 2 m: 1, 1, 1, 2 is one circle.
    let standing = triangle.families.iter().find(|f| f.signs == [-1, 0, 0, 0]).unwrap();
    assert_eq!(standing.topology.as_ref().unwrap().betti, [1, 1]);
    assert!(triangle.decided(), "{:?}", triangle.undecided);
}

/// Two of 1 m are folded, and turn about the anchor; of 2, 1 and 1 m so too. Of 3 and 1 m, or 3, 1 and
/// 1 m, none closes.
#[test]
fn folded_bars_turn_about_a_point() {
    for (slack, closes) in [
        (&[1.0, 1.0][..], true),
        (&[1.0, 2.0, 1.0], true),
        (&[3.0, 1.0], false),
        (&[1.0, 3.0, 1.0], false),
    ] {
        let mut bars = vec![(1.0, 1.0)];
        bars.extend(slack.iter().map(|length| (*length, 0.0)));
        let census = census(&bars, [0.0, 0.0, -1.0]);
        assert!(census.decided(), "{slack:?}: {:?}", census.undecided);
        let hanging = census.families.iter().find(|f| f.signs[0] == 1);
        assert_eq!(hanging.is_some(), closes, "{slack:?}");
        if let Some(folded) = hanging {
            // The longest is as long as the others.
            let longest = if slack.len() == 2 { 1 } else { 2 };
            assert_eq!(folded.topology, Err(TopologyError::Straight { sides: vec![longest] }));
            assert_eq!((folded.dimension_in_plane(), folded.gap_m.hi().to_bits()), (1, 0));
        }
    }
}
