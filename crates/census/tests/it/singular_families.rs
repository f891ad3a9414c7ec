//! Slack bars that also fit into one line in between, or close upon themselves: their positions are no
//! manifold, and all of them are equilibria.

use census::{Census, TopologyError};
use model::Status;

use crate::support;

/// Homogeneous bars as (length, mass), under 9.81 m/s².
fn census(bars: &[(f64, f64)], end_m: [f64; 3]) -> Census {
    let bars: Vec<(f64, f64, f64)> = bars.iter().map(|(l, m)| (*l, *m, 0.5 * l)).collect();
    support::census(&support::problem(&bars, end_m))
}

/// Under a bar of 1.5 m that hangs, three of 1.25, 0.75 and 1 m without mass over 1 m: 1.25 + 0.75 - 1 = 1.
/// With a gap a thousandth longer or shorter that way has an equilibrium of its own, with a little force,
/// besides the same family, which is a manifold then; all others stay, and move a little.
#[test]
fn bars_that_also_fit_into_one_line_are_a_family_all_the_same() {
    let bars = [(1.5, 1.0), (1.25, 0.0), (0.75, 0.0), (1.0, 0.0)];
    let at = census(&bars, [1.0, 0.0, -1.5]);
    assert!(at.decided() && !at.complete, "{:?}", at.undecided);
    let [family] = &at.families[..] else { panic!("{:?}", at.families) };
    assert_eq!(family.signs, [1, 0, 0, 0]);
    assert_eq!(family.topology, Err(TopologyError::Straight { sides: vec![1, 2] }));
    assert_eq!(family.dimension_in_plane, 1);
    // The bar's middle is 0.75 m deep.
    assert!((family.energy_j.mid() + 9.81 * 0.75).abs() < 1e-14);
    assert_eq!(at.completeness(), Status::Open(model::Reason::SingularFamilies { listed: 1 }));

    for apart in [-1e-3, 1e-3] {
        let near = census(&bars, [1.0 + apart, 0.0, -1.5]);
        assert!(near.complete && near.families.len() == 1, "{apart}");
        // 1.25 and 0.75 come to less than 1 and a longer gap: the circle has fallen apart into two.
        let circles = if apart > 0.0 { 2 } else { 1 };
        assert_eq!(near.families[0].topology.as_ref().unwrap().betti, [circles; 2], "{apart}");
        let (soft, others): (Vec<_>, Vec<_>) =
            near.equilibria.iter().partition(|e| e.axial_n[1].mag() < 0.1);
        // Bar 1 leans by 1/1500, and carries 4.905 N.
        let [soft] = &soft[..] else { panic!("{apart}: {soft:?}") };
        assert!((soft.axial_n[1].mag() - 4.905 / 1500.0).abs() < 1e-5, "{:?}", soft.axial_n);
        assert_eq!(others.len(), at.equilibria.len(), "{apart}");
        for (one, other) in at.equilibria.iter().zip(others) {
            assert_eq!(one.signs, other.signs, "{apart}");
            assert!((one.energy_j.mid() - other.energy_j.mid()).abs() < 0.1, "{apart}");
        }
    }
}

/// A bar of 1 m with 1 kg at its end hangs or stands, and bars without mass just bridge what it leaves, in one line:
/// 5 + 1 over 6, level, or 7 - 1; 3 + 2 over 3, 4, 5; and 1 + 2 + 3 over 6.
#[test]
fn bars_that_just_bridge_their_gap_are_a_family_of_one_position() {
    for (slack, end, sign, side) in [
        (&[5.0, 1.0][..], [6.0, 0.0, -1.0], 1, 3),
        (&[5.0, 1.0], [6.0, 0.0, 1.0], -1, 3),
        (&[7.0, 1.0], [6.0, 0.0, -1.0], 1, 1),
        (&[3.0, 2.0], [4.0, 0.0, -4.0], 1, 3),
        (&[1.0, 2.0, 3.0], [6.0, 0.0, 1.0], -1, 4),
    ] {
        let mut bars = vec![(1.0, 1.0, 1.0)];
        bars.extend(slack.iter().map(|length| (*length, 0.0, 0.5 * length)));
        let at = |longer: f64| {
            let [x, y, z] = end;
            support::census(&support::problem(&bars, [x + longer, y, z]))
        };
        let census = at(0.0);
        assert!(census.decided() && !census.complete, "{slack:?}: {:?}", census.undecided);
        let of = |census: &Census| {
            census.families.iter().filter(|f| f.signs[0] == sign).cloned().collect::<Vec<_>>()
        };
        let [family] = &of(&census)[..] else { panic!("{slack:?}: {:?}", census.families) };
        assert_eq!(family.topology, Err(TopologyError::Straight { sides: vec![side] }));
        assert_eq!(family.dimension_in_plane, 0);
        let reach = if side == 1 { 6.0 } else { slack.iter().sum() };
        assert!(family.gap_m.contains(reach) && family.gap_m.width() < 1e-14);
        // The weight is 1 m below the anchor, or above.
        let newton = 9.81 * f64::from(sign);
        assert!((family.energy_j.mid() + newton).abs() < 1e-13);
        assert!((family.axial_n[0].mid() - newton).abs() < 1e-13);
        // Where the gap is longer there is none, where it is shorter there is one: of a folded pair the other way.
        let families = [1e-3, -1e-3].map(|longer| {
            let near = at(longer);
            assert!(near.complete, "{slack:?} {longer}: {:?}", near.undecided);
            of(&near).len()
        });
        assert_eq!(families, if side == 1 { [1, 0] } else { [0, 1] }, "{slack:?}");
    }
}

/// 5 less 1 upright over the 4 m between anchors on one vertical, bars 1 and 4 hanging to and fro: bars 2 and 3 carry
/// nothing in the straight position, which is named as such, with any force.
#[test]
fn slack_bars_that_just_bridge_an_upright_gap_are_straight() {
    let bars = [(2.0, 2.0, 1.0), (5.0, 0.0, 5.0), (1.0, 3.0, 1.0), (2.0, 0.0, 0.5)];
    let census = support::census(&support::problem(&bars, [0.0, 0.0, 4.0]));
    assert!(census.decided(), "{:?}", census.undecided);
    // 2 + 5 - 1 - 2 and -2 + 5 - 1 + 2, all in one line.
    let mut along: Vec<_> = census.straight.iter().map(|s| (s.along.clone(), s.upright)).collect();
    along.sort();
    assert_eq!(along, [(vec![-1, 1, -1, 1], true), (vec![1, 1, -1, -1], true)]);
}

/// A triangle of 1 m without mass hangs from a bar of 1 m that ends at the anchor, and turns about it:
/// two circles, it and its mirror image.
#[test]
fn bars_that_close_upon_themselves_turn_about_a_point() {
    let triangle = census(&[(1.0, 1.0), (1.0, 0.0), (1.0, 0.0), (1.0, 0.0)], [0.0, 0.0, -1.0]);
    let family = triangle.families.iter().find(|f| f.signs == [1, 0, 0, 0]).unwrap();
    assert_eq!(family.topology.as_ref().unwrap().betti, [2, 2]);
    assert_eq!((family.dimension_in_plane, family.index_in_plane), (1, 0));
    assert_eq!((family.gap_m.lo(), family.gap_m.hi()), (0.0, 0.0));
    assert!((family.energy_j.mid() + 9.81 * 0.5).abs() < 1e-14);
    // Standing it leaves 2 m: 1, 1, 1, 2 is one circle.
    let standing = triangle.families.iter().find(|f| f.signs == [-1, 0, 0, 0]).unwrap();
    assert_eq!(standing.topology.as_ref().unwrap().betti, [1, 1]);
    assert!(triangle.decided(), "{:?}", triangle.undecided);
}

/// Two of 1 m are folded, and turn about the anchor; of 2, 1 and 1 m so too. Of 2.5 and 1 m, or 3, 1
/// and 1 m, none closes.
#[test]
fn folded_bars_turn_about_a_point() {
    for (slack, closes) in [
        (&[1.0, 1.0][..], true),
        (&[1.0, 2.0, 1.0], true),
        (&[2.5, 1.0], false),
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
            assert_eq!((folded.dimension_in_plane, folded.gap_m.hi().to_bits()), (1, 0));
        }
    }
}
