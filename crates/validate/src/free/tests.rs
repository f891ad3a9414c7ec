//! Free joints far from the origin.

use model::Anchors;

use super::*;

/// A bar of 0.75 m with 1 kg hangs from its anchor; three without mass bridge the 2.25 m from the
/// other one to it. Places 2^20 m from the origin are stored to 1.9e-9 m, more than the 1e-10 of
/// the length that joints may be off: both count together.
#[test]
fn what_hangs_loose_is_free_wherever_it_is() {
    let bar = |length, mass| Bar::homogeneous(length, mass).unwrap();
    let bars = vec![bar(0.5, 0.0), bar(1.0, 0.0), bar(2.0, 0.0), bar(0.75, 1.0)];
    for far in [0.0, 2.0_f64.powi(20)] {
        let (start_m, end_m) = ([far, 0.0, 0.0], [far, 0.0, 3.0]);
        let chain = Chain::new("far", 9.81, Anchors { start_m, end_m }, bars.clone()).unwrap();
        let free = |aside_m: f64| {
            let joint = [far + aside_m, 0.0, 2.25];
            let between = [far, 0.5, 0.0];
            let found = free_joints(&chain, &[start_m, between, between, joint, end_m]);
            found.map(|(bars, joints)| (bars, *joints.start(), *joints.end()))
        };
        let three = Some((0..3, 1, 2));
        assert_eq!(free(0.0), three, "{far}");
        assert_eq!(free(1e-8), None, "{far}");
        assert_eq!(free(1e-9), if far > 0.0 { three } else { None }, "{far}");
    }
}

/// Weights at the joints between bars: nothing at 1 and 2, at 4, and at 6 to 8.
#[test]
fn runs_are_as_long_as_no_joint_between_them_bears_anything() {
    let at_far_end = |mass| Bar::new(1.0, mass, 1.0, [0.0; 3]).unwrap();
    let masses = [0.0, 0.0, 3.0, 0.0, 5.0, 0.0, 0.0, 0.0, 7.0];
    let chain = |masses: &[f64]| {
        let bars = masses.iter().map(|mass| at_far_end(*mass));
        samples::of_bars(10.0, bars, [1.0, 0.0, 0.0]).into_chain()
    };
    assert_eq!(unloaded_runs(&chain(&masses)), [0..3, 3..5, 5..9]);
    assert_eq!(unloaded_runs(&chain(&[1.0, 1e-15, 0.0])), []);
    assert_eq!(unloaded_runs(&chain(&[1.0, 0.0, 1.0, 0.0, 1.0])), [1..3, 3..5]);
}

/// Bars of 3, 5, 7, 2 and 11 m; the second and third are loose, the first goes down, the fourth up,
/// the fifth down.
fn plumb_but_two(end_m: Vector) -> (Chain, Vec<Vector>) {
    let bars = [3.0, 5.0, 7.0, 2.0, 11.0].map(|length| Bar::homogeneous(length, 1.0).unwrap());
    let start_m = [1.0, 2.0, 4.0];
    let chain = Chain::new("plumb", 10.0, Anchors { start_m, end_m }, bars.to_vec()).unwrap();
    let [x, y, z] = end_m;
    let joints_m =
        vec![start_m, [1.0, 2.0, 1.0], [0.0; 3], [x, y, z + 9.0], [x, y, z + 11.0], end_m];
    (chain, joints_m)
}

/// From 1 m to 9 m above the other anchor, (3, 4) aside.
#[test]
fn plumb_parts_end_where_their_lengths_reach() {
    let (chain, joints_m) = plumb_but_two([4.0, 6.0, -8.0]);
    assert_eq!(plumb(&chain, &joints_m, &(1..3)), [[1.0, 2.0, 1.0], [4.0, 6.0, 1.0]]);
    let [gap, reach, folded] = squares(&chain, &joints_m, &(1..3)).map(|x| x.interval().mid());
    assert_eq!([gap, reach, folded].map(f64::to_bits), [25.0, 144.0, 4.0].map(f64::to_bits));
    let enough = 1e-9;
    assert!(stands_below(&chain, &joints_m, &(1..3), enough));
    assert!(hangs_plumb(&chain, &joints_m, &(1..3), enough));
    for joint in [1, 3] {
        for axis in 0..3 {
            let mut off = joints_m.clone();
            off[joint][axis] += 0.25;
            assert!(!hangs_plumb(&chain, &off, &(1..3), enough), "{joint} {axis}");
            assert_eq!(stands_below(&chain, &off, &(1..3), enough), axis == 2, "{joint} {axis}");
        }
    }
    // 12 m off by (3, 4, 12): the run ends 5 m aside and 12 m higher.
    let (chain, joints_m) = plumb_but_two([4.0, 6.0, 4.0]);
    let [gap, ..] = squares(&chain, &joints_m, &(1..3)).map(|x| x.interval().mid());
    assert_eq!(gap.to_bits(), f64::to_bits(169.0));
}

/// 5 and 7 m reach 12 m and fold on 2 m: there is room between, and none at either end.
#[test]
fn there_is_room_between_folded_and_straight() {
    let room = |apart_m: f64| {
        // Straight above: the gap is as high as the anchor is moved.
        let (chain, joints_m) = plumb_but_two([1.0, 2.0, -8.0 + apart_m]);
        has_room(&chain, &joints_m, &(1..3))
    };
    let ulp = 2.0_f64.powi(-47);
    assert!(!room(12.0 + ulp) && !room(12.0) && room(12.0 - ulp) && room(7.0));
    assert!(room(2.0 + ulp) && !room(2.0) && !room(2.0 - ulp) && !room(0.5) && !room(0.0));
    // Below as well as above.
    assert!(!room(-12.0) && room(-11.5) && room(-2.5) && !room(-1.5));
}

/// Equal bars fold to nothing: a triangle closes on one point, two bars on it lie on a line.
#[test]
fn what_closes_on_a_point_turns_about_it() {
    let room = |lengths: &[f64]| {
        let bars = lengths.iter().map(|length| Bar::homogeneous(*length, 0.0).unwrap()).collect();
        let anchors = Anchors { start_m: [0.5; 3], end_m: [0.5; 3] };
        let chain = Chain::new("closed", 10.0, anchors, bars).unwrap();
        let joints_m = vec![[0.5; 3]; lengths.len() + 1];
        has_room(&chain, &joints_m, &(0..lengths.len()))
    };
    assert!(room(&[1.0, 1.0]) && room(&[3.0, 4.0, 5.0]) && room(&[2.0, 1.0, 1.0]));
    assert!(!room(&[2.0, 1.0]) && !room(&[4.0, 1.0, 2.0]));
}

/// What is level counts as upwards, wherever it is asked: 2 m up from the start.
#[test]
fn level_bars_count_as_one_way() {
    let bars = [2.0, 5.0, 7.0].map(|length| (length, 1.0));
    let chain = samples::homogeneous(10.0, &bars, [0.0, 0.0, 10.0]).into_chain();
    let joints_m = [[0.0; 3], [2.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, 10.0]];
    assert_eq!(plumb(&chain, &joints_m, &(1..3)), [[0.0, 0.0, 2.0], [0.0, 0.0, 10.0]]);
    let [gap, ..] = squares(&chain, &joints_m, &(1..3)).map(|x| x.interval().mid());
    assert_eq!(gap.to_bits(), f64::to_bits(64.0));
}

/// Two bars of 1 m and a little more: rounding of lengths and places is 24 units of 2 m. Closed by
/// less, one may be longer by as much; else by less than what is open.
#[test]
fn what_closes_to_rounding_turns_about_a_point() {
    let room = |open: f64, longer: f64| {
        let bars = [1.0, 1.0 + longer * f64::EPSILON].map(|l| Bar::homogeneous(l, 0.0).unwrap());
        let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, open * f64::EPSILON] };
        let chain = Chain::new("closed", 10.0, anchors, bars.to_vec()).unwrap();
        has_room(&chain, &[anchors.start_m, [0.0; 3], anchors.end_m], &(0..2))
    };
    assert!(room(32.0, 40.0) && !room(32.0, 60.0));
    assert!(room(56.0, 52.0) && !room(56.0, 60.0));
}
