//! Load paths against closed forms: `l` is the length of a bar, `l0` its free length, `a` half the
//! span and `w` the height of a gable.

#![expect(clippy::format_push_string, reason = "helpers of tests")]

mod domes;
mod ropes;

use funicular::prelude::*;
use funicular::{LoadEnd, LoadEvent, LoadEventKind, LoadPath, PathProved};
use samples::root;

/// Limits and branches are located to this part.
const SHARP: f64 = 1e-9;

/// A file whose bars have no mass.
fn light(file: &str) -> Problem {
    let bare = file.replace("mass_kg = 0\n", "");
    Problem::parse(&bare.replace("[[bars]]\n", "[[bars]]\nmass_kg = 0\n"), "test.toml").unwrap()
}

fn paths(file: &str, trace: &Trace) -> Vec<LoadPath> {
    paths_of(&light(file), trace)
}

fn paths_of(problem: &Problem, trace: &Trace) -> Vec<LoadPath> {
    let found = trace.run(problem).unwrap();
    assert!(found.checks_agree(), "{found}");
    assert!(found.to_string().lines().all(|line| line.chars().count() <= 80), "{found}");
    found.load_paths().unwrap().paths().to_vec()
}

fn path(file: &str, vary: &str) -> LoadPath {
    paths(file, &Trace::new().vary(vary).unwrap()).remove(0)
}

/// Two bars of EA = 1 N, feet 2 m apart, the apex at this height, which moves as `free` says.
fn gable(height: f64, free: &str, more: &str) -> String {
    format!(
        "[joints]\nA = {{ at_m = [-1, 0, 0] }}\nB = {{ at_m = [1, 0, 0] }}\n\
         P = {{ at_m = [0, 0, {height}], near_m = [0, 0, {height}], free = \"{free}\", force_n = [0, 0, -1] }}\n{more}\
         [[bars]]\nfrom = \"A\"\nto = \"P\"\nstiffness_n = 1\n[[bars]]\nfrom = \"P\"\nto = \"B\"\nstiffness_n = 1\n"
    )
}

/// The load on a gable whose bars are this long, N.
fn load_n(l0: f64, l: f64) -> f64 {
    2.0 * (l * l - 1.0).sqrt() / l * (l0 - l) / l0
}

fn derivative(f: impl Fn(f64) -> f64) -> impl Fn(f64) -> f64 {
    let h = 1e-5;
    // Of fourth order.
    move |x| (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
}

fn told(events: &[LoadEvent]) -> Vec<(LoadEventKind, [usize; 2])> {
    events.iter().map(|event| (event.kind, event.index)).collect()
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= SHARP * wanted.abs().max(1.0), "{found} {wanted}");
}

/// The path is proved from its start up to this point.
fn is_proved(path: &LoadPath, kind: LoadEventKind, wanted: f64) {
    let PathProved { to, first, between, because, .. } = &path.proved;
    assert_eq!((*first, because.as_deref()), (Some(kind), None), "{:?}", path.proved);
    let [low, high] = between.unwrap();
    assert!(low - 1e-15 <= wanted && wanted <= high + 1e-15 && high - low < 1e-11, "{low} {high}");
    assert!((to.unwrap() - low).abs() < 1e-15);
}

#[test]
fn a_steep_gable_sways_before_its_limit() {
    let path = path(&gable(3.0, "xz", ""), "loads=0..2");
    let l0 = 10_f64.sqrt();
    let sways = |l: f64| l.powi(3) - l0 * (l * l - 1.0);
    let [first, second] = [root(sways, [2.2, l0]), root(sways, [1.01, 2.2])];
    let (limit, branch) = (LoadEventKind::Limit, LoadEventKind::Branch);
    let wanted = [(branch, [0, 1]), (limit, [1, 2]), (branch, [2, 1])];
    assert_eq!(told(&path.events), wanted);
    for (event, l) in path.events.iter().zip([first, l0.cbrt(), second]) {
        near(event.values[0], load_n(l0, l));
    }
    assert_eq!(path.first_loss(), Some(&path.events[0]));
    is_proved(&path, branch, load_n(l0, first));
    let [low, high] = path.events[0].enclosed.unwrap();
    assert!(low - 1e-15 <= load_n(l0, first) && load_n(l0, first) <= high + 1e-15);
    let [x, _, z] = path.events[0].mode[2];
    assert!((x - 1.0).abs() < 1e-12 && z.abs() < 1e-6);
}

/// The two paths that leave the steep gable to the sides are unstable: along them the bars have force
/// densities q = EA (1/l0 - 1/l) with q1 (1 + x) = q2 (1 - x), and unloaded they come to x = l0.
#[test]
fn a_steep_gable_sways_to_either_side() {
    let trace = Trace::new().vary("loads=0..0.5").unwrap().branches(3);
    let paths = paths(&gable(3.0, "xz", ""), &trace);
    assert_eq!(paths.len(), 3);
    let l0 = 10_f64.sqrt();
    let mut sides = vec![];
    for path in &paths[1..] {
        let from = path.branches_from.unwrap();
        assert_eq!((from.path, from.event, path.end), (0, 0, LoadEnd::Range));
        for point in &path.points {
            let [x, _, z] = point.joints_m[2];
            let density = |foot: f64| 1.0 / l0 - 1.0 / (x - foot).hypot(z);
            let [q1, q2] = [density(-1.0), density(1.0)];
            assert!((q1 * (1.0 + x) - q2 * (1.0 - x)).abs() < SHARP && point.index == 1);
            assert!(((q1 + q2) * z + point.values[0]).abs() < SHARP);
        }
        let [x, ..] = path.points.last().unwrap().joints_m[2];
        near(x.abs(), l0);
        sides.push(x.signum());
    }
    assert!(sides.contains(&1.0) && sides.contains(&-1.0));
}

/// Over each range the two paths from each branch point begin next to it. Those of the second run the apex into a foot, where the bar
/// of no length still pushes with EA = 1 and the other one, 2 m long, with 1 - 2/l0, which is its level part.
#[test]
fn paths_begin_next_to_their_branch_points_over_every_range() {
    for to in [1, 10, 20, 50] {
        let trace = Trace::new().vary(&format!("loads=0..{to}")).unwrap().branches(1);
        let found = trace.run(&light(&gable(3.0, "xz", ""))).unwrap();
        assert!(found.checks_agree() && !found.checks_decided(), "{found}");
        let paths = found.load_paths().unwrap().paths();
        let from = |path: &LoadPath| path.branches_from.map(|from| from.event);
        let froms: Vec<_> = paths.iter().map(from).collect();
        assert_eq!(froms, [None, Some(0), Some(0), Some(2), Some(2)], "{to}");
        for (path, side) in paths[1..].iter().zip([1.0, -1.0, 1.0, -1.0]) {
            let (event, first) = (from(path).unwrap(), &path.points[0]);
            let same = paths.iter().find(|other| from(other) == Some(event)).unwrap();
            let x = side * same.points[0].joints_m[2][0].signum() * first.joints_m[2][0];
            assert!(x > 0.0 && x < 0.1, "{to}: {x}");
            let at = paths[0].events[event].values[0];
            assert!((first.values[0] / at - 1.0).abs() < 1e-2, "{to}: {} {at}", first.values[0]);
            let last = path.points.last().unwrap();
            if event == 0 {
                assert!(path.end == LoadEnd::Range && last.values[0] <= 0.0, "{found}");
                continue;
            }
            let level: f64 = 1.0 - 2.0 / 10_f64.sqrt();
            let meets = (1.0 - level * level).sqrt();
            assert!(path.end == LoadEnd::NoLength && (last.values[0] - meets).abs() < 1e-3);
            let bar = if last.joints_m[2][0] > 0.0 { 2 } else { 1 };
            let said = format!("the ends of bar {bar} meet: it has no length there");
            assert!(found.to_string().contains(&said), "{found}");
        }
    }
}

/// With an apex off the centre the steep gable has no branch point, and bears less: the loss goes with the
/// power 2/3 of the imperfection, as Koiter found for symmetric branch points that are unstable.
#[test]
fn an_imperfect_steep_gable_bears_less_by_the_power_two_thirds() {
    let perfect = path(&gable(3.0, "xz", ""), "loads=0..2").events[0].values[0];
    let loss = |off: f64| {
        let file = gable(3.0, "xz", "").replace("near_m = [0,", &format!("near_m = [{off},"));
        let path = path(&file, "loads=0..2");
        let first = path.first_loss().unwrap();
        assert_eq!(first.kind, LoadEventKind::Limit);
        perfect - first.values[0]
    };
    let [small, large] = [loss(1e-5), loss(8e-5)];
    let power = (large / small).log2() / 3.0;
    assert!((power - 2.0 / 3.0).abs() < 2e-3, "{power}");
}

/// A gable at its limit: dP/dl0 = 2 EA w / l0^2 for both bars together, at l^3 = l0 a^2. Two bars of other lengths
/// and stiffness with their feet at other heights against differences of the limit.
#[test]
fn what_imperfections_change_a_limit_by() {
    let limit = |file: &str| {
        let path = path(file, "loads=0..2");
        path.events.iter().find(|event| event.kind == LoadEventKind::Limit).unwrap().clone()
    };
    let l0 = 1.25_f64.sqrt();
    let w = (l0.cbrt().powi(2) - 1.0).sqrt();
    let symmetric = limit(&gable(0.5, "z", ""));
    let both: f64 = symmetric.by_length.iter().sum();
    near(both, 2.0 * w / (l0 * l0));
    let lean = |lengths: [f64; 2], a: [f64; 3]| {
        format!(
            "[joints]\nA = {{ at_m = [{}, {}, {}] }}\nB = {{ at_m = [1, 0, 0.1] }}\nC = {{ at_m = [0.1, 1.2, 0] }}\n\
             P = {{ near_m = [0, 0, 0.5], force_n = [0, 0.01, -1] }}\n\
             [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = {}\nstiffness_n = 1\n\
             [[bars]]\nfrom = \"P\"\nto = \"B\"\nlength_m = {}\nstiffness_n = 2\n\
             [[bars]]\nfrom = \"C\"\nto = \"P\"\nlength_m = 1.3\nstiffness_n = 1.5\n",
            a[0], a[1], a[2], lengths[0], lengths[1]
        )
    };
    let (lengths, a) = ([1.3, 1.1], [-1.1, 0.2, 0.05]);
    let found = limit(&lean(lengths, a));
    let h = 1e-4;
    let at = |lengths, a| limit(&lean(lengths, a)).values[0];
    let by = |plus: f64, minus: f64| (plus - minus) / (2.0 * h);
    let by_first = by(at([1.3 + h, 1.1], a), at([1.3 - h, 1.1], a));
    let by_second = by(at([1.3, 1.1 + h], a), at([1.3, 1.1 - h], a));
    assert!((found.by_length[0] - by_first).abs() < 1e-6, "{} {by_first}", found.by_length[0]);
    assert!((found.by_length[1] - by_second).abs() < 1e-6, "{} {by_second}", found.by_length[1]);
    for axis in 0..3 {
        let moved = |by: f64| {
            let mut a = a;
            a[axis] += by;
            at(lengths, a)
        };
        let difference = by(moved(h), moved(-h));
        let derivative = found.by_place[0][axis];
        assert!((derivative - difference).abs() < 1e-6, "{derivative} {difference}");
        assert!(found.by_place[3][axis].abs() < f64::MIN_POSITIVE);
    }
}

/// An upright bar of 1 m between two springs of EA = 10 N to the sides, sqrt(101) m long: it falls to a side under
/// 2 EA 100 / 101^1.5, goes round below at minus that, and comes back up on the other side.
pub(crate) const RING: &str = "[joints]\nA = { at_m = [0, 0, 0] }\n\
    L = { at_m = [-10, 0, 0] }\nR = { at_m = [10, 0, 0] }\n\
    P = { at_m = [0, 0, 1], near_m = [0, 0, 1], free = \"xz\", force_n = [0, 0, -1] }\n\
    [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 1\n\
    [[bars]]\nfrom = \"L\"\nto = \"P\"\nstiffness_n = 10\n\
    [[bars]]\nfrom = \"R\"\nto = \"P\"\nstiffness_n = 10\n";

#[test]
fn a_path_that_goes_round_ends_where_it_began() {
    let trace = Trace::new().vary("loads=0,4,-4").unwrap().branches(2).linear_buckling();
    let paths = paths(RING, &trace);
    let critical = 20.0 * 100.0 / 101_f64.powf(1.5);
    let [straight, round] = &paths[..] else { panic!("{}", paths.len()) };
    near(straight.events[0].values[0], critical);
    // Its places do not change and its forces grow with the load: the estimate is exact.
    assert!((straight.linear_buckling.unwrap() - critical).abs() < 1e-6);
    assert_eq!((round.branches_from, round.end), (round.joins, LoadEnd::Joins));
    assert!(round.joins.is_some());
    let ends: Vec<f64> = round.events.iter().map(|event| event.values[0]).collect();
    // Where it turns the load is known to the square of how well the place is.
    assert!((ends[0] + critical).abs().max((ends[1] - critical).abs()) < 1e-8, "{ends:?}");
    assert!(round.events.iter().all(|e| e.kind == LoadEventKind::Branch && e.turns));
    assert!(round.points.iter().any(|point| point.joints_m[3][0] > 0.99));
    assert!(round.points.iter().any(|point| point.joints_m[3][0] < -0.99));
}

/// Along the bars K = 2 EA h^2 / l0^3, of their forces -(P l0 / 2 h) across them K' = -P a^2 / (h l0^2): linear
/// buckling estimates P = 2 EA h^3 / (a^2 l0), many times what it bears.
#[test]
fn linear_buckling_of_a_gable_is_its_closed_form() {
    for height in [0.5, 0.2] {
        let trace = Trace::new().vary("loads=0..1").unwrap().linear_buckling();
        let path = paths(&gable(height, "z", ""), &trace).remove(0);
        let l0 = f64::hypot(1.0, height);
        let wanted = 2.0 * height.powi(3) / l0;
        let found = path.linear_buckling.unwrap();
        assert!((found / wanted - 1.0).abs() < 1e-6, "{found} {wanted}");
        assert!(found > 5.0 * path.first_loss().unwrap().values[0]);
    }
}

/// Two rigid bars between anchors hang or stand, at every load; the path of the hanging ones stays.
#[test]
fn rigid_bars_have_the_same_equilibria_at_every_load() {
    let file = "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [1, 0, 0] }\nP = { mass_kg = 1 }\n\
        [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 1\n[[bars]]\nfrom = \"P\"\nto = \"B\"\nlength_m = 1\n";
    let rigid = path(file, "loads=0.1..3");
    assert_eq!(rigid.equilibria_at_every_load, Some(2));
    assert!(rigid.events.is_empty() && rigid.end == LoadEnd::Range);
    let deep = -0.75_f64.sqrt();
    assert!(rigid.points.iter().all(|point| (point.joints_m[2][2] - deep).abs() < 1e-12));
    let elastic = file.replace("length_m = 1\n", "length_m = 1\nstiffness_n = 1e5\n");
    assert_eq!(path(&elastic, "loads=0.1..3").equilibria_at_every_load, None);
}

/// Heated bars of a gable that may rise bear nothing: w^2 = (f l0)^2 - 1 at the factor f.
#[test]
fn a_heated_gable_rises() {
    let unloaded = gable(0.5, "z", "").replace("force_n = [0, 0, -1]", "force_n = [0, 0, 0]");
    let path = path(&unloaded, "lengths=1..1.05");
    assert!(path.points.len() > 10 && path.end == LoadEnd::Range);
    for point in &path.points {
        let length = point.values[0] * 1.25_f64.sqrt();
        let [_, _, w] = point.joints_m[2];
        assert!((w - (length * length - 1.0).sqrt()).abs() < 1e-12, "{w}");
    }
}

#[test]
fn dead_load_an_elastic_support_and_an_apex_off_the_centre() {
    // Dead load is a part of the limit load.
    let heavy = gable(0.5, "z", "").replace("force_n", "mass_kg = 0.001, force_n");
    let dead_n = 0.001 * 9.80665;
    let l0 = 1.25_f64.sqrt();
    let found = path(&heavy, "joints.P.force_n.z=0..-1");
    near(-found.first_loss().unwrap().values[0], load_n(l0, l0.cbrt()) - dead_n);
    // A spring of 0.05 N/m below the apex.
    let spring = "[[bars]]\nfrom = \"S\"\nto = \"P\"\nstiffness_n = 0.075\n";
    let propped = gable(0.5, "z", "S = { at_m = [0, 0, -1] }\n") + spring;
    let on_spring = |w: f64| load_n(l0, w.hypot(1.0)) + 0.05 * (0.5 - w);
    let w = root(derivative(on_spring), [0.05, 0.5]);
    near(path(&propped, "loads=0..1").first_loss().unwrap().values[0], on_spring(w));
    // The apex 0.3 m off the centre.
    let oblique = gable(0.5, "z", "").replace("[0, 0, 0.5]", "[0.3, 0, 0.5]");
    let bears = |w: f64| {
        [0.7_f64, 1.3]
            .iter()
            .map(|a| {
                let (l, l0) = (w.hypot(*a), a.hypot(0.5));
                w / l * (l0 - l) / l0
            })
            .sum::<f64>()
    };
    let w = root(derivative(bears), [0.05, 0.5]);
    near(path(&oblique, "loads=0..1").first_loss().unwrap().values[0], bears(w));
}

/// A cable above and a bar below: pushed up by 4 N the cable is as long as it is unstretched.
#[test]
fn a_cable_becomes_slack_and_taut_again() {
    let file = "[joints]\nT = { at_m = [0, 0, 2] }\nB = { at_m = [0, 0, -1] }\n\
                P = { at_m = [0, 0, 0], near_m = [0, 0, 0.1], free = \"z\", force_n = [0, 0, 1] }\n\
                [[bars]]\nfrom = \"T\"\nto = \"P\"\nkind = \"cable\"\nlength_m = 1.8\nstiffness_n = 18\n\
                [[bars]]\nfrom = \"B\"\nto = \"P\"\nlength_m = 1\nstiffness_n = 20\n";
    let up = path(file, "joints.P.force_n.z=1..8");
    let [kink] = &up.events[..] else { panic!("{:?}", up.events) };
    assert_eq!((kink.kind, &kink.slack[..], kink.turns), (LoadEventKind::Kink, &[1][..], false));
    near(kink.values[0], 4.0);
    let PathProved { to, first: None, because: Some(because), .. } = &up.proved else {
        panic!("{up:?}")
    };
    let to = to.unwrap();
    assert!(to < 4.0 && to > 3.999 && because.contains("member 1"), "{to} {because}");
    near(up.points.last().unwrap().joints_m[2][2], 0.4);
    let z = up.points[0].joints_m[2][2];
    near(10.0 * (0.2 - z) - 20.0 * z + 1.0, 0.0);
    let down = path(file, "joints.P.force_n.z=8..1");
    assert_eq!((down.events.len(), &down.events[0].taut[..]), (1, &[1][..]));
    near(down.events[0].values[0], 4.0);
}

/// A post of 3 m with three guys that are just taut, from no load on: rigid guys bear the wind of 30 N along x, and the downwind
/// ones nothing; of elastic ones of EA = 1e6 N one that is stretched by x cos² gives way by 30 N over EA cos²/l, next to which
/// second order is some 1e-4.
#[test]
fn guys_that_are_just_taut_bear_from_the_first_load_on() {
    for elastic in [false, true] {
        for turned_deg in [0.0_f64, 10.0, 60.0] {
            let stiffness = if elastic { "stiffness_n = 1e6\n" } else { "" };
            let feet = [0.0, 120.0, 240.0].map(|at: f64| (at + 180.0 + turned_deg).to_radians());
            let mut file = "[joints]\nfoot = { at_m = [0, 0, 0] }\n\
                            P = { near_m = [0, 0, 3], force_n = [30, 0, -50] }\n"
                .to_owned();
            let mut guys = String::new();
            for (guy, at) in feet.iter().enumerate() {
                let (sin, cos) = at.sin_cos();
                file += &format!("F{guy} = {{ at_m = [{}, {}, 0] }}\n", 4.0 * cos, 4.0 * sin);
                guys += &format!(
                    "[[bars]]\nfrom = \"F{guy}\"\nto = \"P\"\nkind = \"cable\"\n{stiffness}"
                );
            }
            file += &format!("[[bars]]\nfrom = \"foot\"\nto = \"P\"\n{guys}");
            let path = path(&file, "loads=0..1");
            // Of two that bear nothing one may go slack only there.
            let kinks = path.events.iter().all(|event| event.values[0].abs() <= 0.0);
            assert_eq!((path.end, kinks), (LoadEnd::Range, true), "{elastic} {turned_deg}");
            let last = path.points.last().unwrap();
            near(last.values[0], 1.0);
            assert!(path.points.iter().all(|point| point.index == 0));
            let pulls = last.axial_n[1..].iter().zip(feet);
            let pulled_n: f64 = pulls.map(|(n, at)| 0.8 * n * at.cos()).sum();
            assert!((pulled_n + 30.0).abs() < 0.05, "{pulled_n}");
            assert!(last.axial_n[2..].contains(&0.0), "{:?}", last.axial_n);
            let moved_m = last.joints_m[1][0].hypot(last.joints_m[1][1]);
            let most_m = if elastic { 2.0 * 30.0 / (1e6 / 5.0 * 0.64) } else { 1e-12 };
            assert!(moved_m <= 1.01 * most_m, "{moved_m} {most_m}");
        }
    }
}

/// A cross of four cables of 1 m, prestressed: pulled along one of them until it is slack.
#[test]
fn a_prestressed_net_bears_until_its_first_cable_is_slack() {
    let mut file = "[joints]\nP = { near_m = [0, 0, 0], force_n = [1, 0, 0] }\n".to_owned();
    for (k, [x, y]) in [[1, 0], [0, 1], [-1, 0], [0, -1]].iter().enumerate() {
        file += &format!("F{k} = {{ at_m = [{x}, {y}, 0] }}\n");
    }
    for k in 0..4 {
        file += &format!(
            "[[bars]]\nfrom = \"P\"\nto = \"F{k}\"\nkind = \"cable\"\nstiffness_n = 100\nprestress_n = 10\n"
        );
    }
    let path = path(&file, "loads=0..60");
    let l0 = 1.0 / 1.1;
    let u = 1.0 - l0;
    let force = |l: f64| 100.0 * (l - l0) / l0;
    let side = u.hypot(1.0);
    let [kink] = &path.events[..] else { panic!("{:?}", path.events) };
    assert_eq!((kink.kind, &kink.slack[..]), (LoadEventKind::Kink, &[1][..]));
    near(kink.values[0], force(1.0 + u) + 2.0 * force(side) * u / side);
    assert_eq!((kink.index, kink.enclosed), ([0, 0], None));
}

/// 8 N stretch a spring of 10 N/m and 1 m to 1.8 m: what lies on a floor above that moves with it, and hangs where it is deeper.
#[test]
fn a_floor_moves_what_lies_on_it() {
    let file = "floor_m = -1.5\n[joints]\nT = { at_m = [0, 0, 0] }\n\
                P = { at_m = [0, 0, -1], near_m = [0, 0, -1.5], free = \"z\", force_n = [0, 0, -8] }\n\
                [[bars]]\nfrom = \"T\"\nto = \"P\"\nlength_m = 1\nstiffness_n = 10\n";
    let up = path(file, "floor_m=-1.5..-1.2");
    assert!(up.events.is_empty(), "{:?}", up.events);
    for point in &up.points {
        near(point.joints_m[1][2], point.values[0]);
    }
    near(up.points.last().unwrap().joints_m[1][2], -1.2);
    let down = path(file, "floor_m=-1.5..-2");
    let [kink] = &down.events[..] else { panic!("{:?}", down.events) };
    assert_eq!(kink.kind, LoadEventKind::Kink);
    near(kink.values[0], -1.8);
    near(down.points.last().unwrap().joints_m[1][2], -1.8);
}

/// The asymmetric shapes of three equal bars end where the squared distance of level anchors is 3/2:
/// the census of the chain knows them, and the chain cut into a system has the same fold.
#[test]
fn a_chain_as_a_system_has_its_fold() {
    let chain = Problem::case("three-equal-bars").unwrap();
    let level = chain.with(&[("anchors.end_m.z", 0.0), ("anchors.end_m.x", 1.2)]).unwrap();
    let all = Trace::new().vary("anchors.end_m.x=1.2,1.21").unwrap().run(&level).unwrap();
    let branches = &all.paths()[0].branches;
    // The symmetric ones have an upright middle or equal angles at both ends.
    let lopsided = branches.iter().map(|branch| &branch.points[0].angles_rad).find(|angles| {
        let [a, b, c] = angles[..] else { panic!("three bars") };
        (a + c - 2.0 * b).abs().min((a + c).sin().abs()) > 1e-3
            && (b.abs() - std::f64::consts::FRAC_PI_2).abs() > 1e-3
    });
    let mut at_m = vec![[0.0; 3]];
    for angle in lopsided.unwrap() {
        let [x, _, z] = *at_m.last().unwrap();
        at_m.push([x + angle.sin(), 0.0, z - angle.cos()]);
    }
    let drawn = level.near(&at_m).unwrap();
    let found = Trace::new().vary("anchors.end_m.x=1.2..1.3").unwrap().run(&drawn).unwrap();
    assert!(found.checks_agree(), "{found}");
    let path = &found.load_paths().unwrap().paths()[0];
    let limit = path.events.iter().find(|event| event.kind == LoadEventKind::Limit);
    near(limit.unwrap().values[0], 1.5_f64.sqrt());
}

/// A pendulum of 2 kg on a bar of 1 kg, lifted: at 2.5 kg g nothing acts, and its bar bears nothing.
#[test]
fn a_pendulum_turns_up_where_it_is_lifted() {
    let file = "[joints]\nA = { at_m = [0, 0, 0] }\nP = { mass_kg = 2 }\n\
                [[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 2\nmass_kg = 1\n";
    let problem = Problem::parse(file, "test.toml").unwrap();
    let found = Trace::new().vary("joints.P.force_n.z=0..60").unwrap().run(&problem).unwrap();
    assert!(found.checks_agree(), "{found}");
    near(found.load_paths().unwrap().paths()[0].events[0].values[0], 2.5 * 9.80665);
}

#[test]
fn a_path_ends_where_it_says() {
    let short =
        paths(&gable(0.5, "z", ""), &Trace::new().vary("loads=0..1").unwrap().max_points(5));
    assert_eq!((short[0].end, short[0].points.len()), (LoadEnd::MaxPoints, 5));
    let hangs = "[joints]\nT = { at_m = [0, 0, 0] }\nP = { mass_kg = 2 }\n\
                 [[bars]]\nfrom = \"T\"\nto = \"P\"\nlength_m = 1\n";
    let path = path(hangs, "loads=1..3");
    assert_eq!((path.end, path.events.len()), (LoadEnd::Range, 0));
    near(path.points.last().unwrap().axial_n[0], 3.0 * 2.0 * 9.80665);
    // Below no load at all the mass is negative.
    let none = paths(hangs, &Trace::new().vary("loads=1,0,-1").unwrap());
    assert!(none[0].end != LoadEnd::Range && none[0].points.last().unwrap().values[0] > -1e-3);
}

/// Two slings of 1.5 m are straight when their ends are 3 m apart: no force would be large enough, and what lies beyond, with
/// as large a push, is no point of the path.
#[test]
fn a_path_ends_before_slings_are_straight() {
    let sling = |end: &str| {
        format!("[[bars]]\nfrom = \"{end}\"\nto = \"P\"\nlength_m = 1.5\nkind = \"cable\"\n")
    };
    let file =
        "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [2, 0, 0] }\nP = { mass_kg = 200 }\n"
            .to_owned();
    let problem = light(&(file + &sling("A") + &sling("B")));
    let found = Trace::new().vary("joints.B.at_m.x=2..4").unwrap().run(&problem).unwrap();
    let path = &found.load_paths().unwrap().paths()[0];
    assert!(path.end == LoadEnd::Unbounded && path.confirmed.statics < 1e-9, "{found}");
    for at in &path.points {
        assert!(at.joints_m[2][2] < 0.0 && at.axial_n.iter().all(|n| *n > 0.0), "{at:?}");
    }
    let [x, z] = [0, 2].map(|k| path.points.last().unwrap().joints_m[2][k]);
    assert!(x > 1.499 && z > -0.06, "{x}, {z}");
}

#[test]
fn where_no_path_begins_the_error_says_why() {
    let run = |file: &str, vary: &str| {
        let problem = light(file);
        Trace::new().vary(vary).unwrap().run(&problem).unwrap_err().to_string()
    };
    // Rigid bars of two lengths do not meet over the middle.
    let rigid = gable(0.5, "z", "").replacen("stiffness_n = 1\n", "length_m = 1.2\n", 1);
    let said = run(&rigid.replace("stiffness_n = 1\n", "length_m = 1.5\n"), "loads=1..2");
    assert!(said.contains("start of the path"), "{said}");
    // Under so much load the apex hangs far below the drawing.
    let below = gable(0.5, "z", "").replace("near_m = [0, 0, 0.5]", "near_m = [0, 0, -0.6]");
    let said = run(&below.replace("stiffness_n", "length_m = 1.1\nstiffness_n"), "loads=1..2");
    assert!(said.contains("not next to the shape given: joint P is"), "{said}");
    // At the limit load, drawn at the limit.
    let l0 = 1.25_f64.sqrt();
    let l = l0.cbrt();
    let [w, p] = [(l * l - 1.0).sqrt(), load_n(l0, l)];
    let fold = gable(0.5, "z", "")
        .replace("near_m = [0, 0, 0.5]", &format!("near_m = [0, 0, {w:?}]"))
        .replace("stiffness_n = 1\n", &format!("length_m = {l0:?}\nstiffness_n = 1\n"));
    let said = run(&fold, &format!("loads={p:?}..1"));
    assert!(said.contains("singular") || said.contains("start of the path"), "{said}");
    // A chain between anchors on one vertical turns about it.
    let turns = Problem::case("three-equal-bars").unwrap();
    let turns = Trace::new().vary("anchors.end_m.z=-2..-2.9").unwrap().run(&turns).unwrap_err();
    assert!(turns.to_string().contains("a part turns freely"), "{turns}");
    // Straight cables bear nothing yet; with a load on them they do.
    let lamp = gable(-0.5, "z", "").replace("at_m = [0, 0, -0.5], near_m", "near_m");
    let lamp =
        lamp.replace("free = \"z\", ", "").replace("stiffness_n", "kind = \"cable\"\nstiffness_n");
    let said = run(&lamp, "loads=0..0.01");
    assert!(said.contains("begin with a little"), "{said}");
    assert_eq!(path(&lamp, "loads=0.0001..0.01").end, LoadEnd::Range);
    assert!(run(&gable(0.5, "z", ""), "loads=1,1").contains("needs a range"));
    assert!(run(&gable(0.5, "z", ""), "joints.Q.force_n.z=0..1").contains("no joint `Q`"));
}

/// A load that is lifted by its own weight rests anywhere, also where it hangs on one cable alone: the path ends at that force,
/// 2 g and 2.2 g, stable up to there, without a limit point or a branch point.
#[test]
fn a_path_ends_where_a_load_is_weightless() {
    let massless = |elastic: &str| format!("mass_kg = 0\n{elastic}");
    let member = |from: &str, to: &str, length_m: f64, kind: &str, more: &str| {
        format!(
            "[[bars]]\nfrom = {from:?}\nto = {to:?}\nlength_m = {length_m}\nkind = {kind:?}\n{more}"
        )
    };
    let hung = |elastic: &str| {
        "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [1.5, 0, -2] }\nP = { mass_kg = 3 }\nQ = { mass_kg = 2 }\n"
            .to_owned()
            + &member("A", "P", 2.0, "cable", &massless(elastic))
            + &member("P", "Q", 1.0, "bar", "mass_kg = 0\n")
            + &member("Q", "B", 1.2, "cable", &massless(elastic))
    };
    let slung = |elastic: &str| {
        let heavy = format!("mass_kg = 0.2\n{elastic}");
        "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [4, 0, 0] }\nQ = { mass_kg = 2 }\n"
            .to_owned()
            + &member("A", "Q", 3.0, "cable", &heavy)
            + &member("Q", "B", 3.0, "cable", &heavy)
    };
    for elastic in ["", "stiffness_n = 1e5\n"] {
        for (file, weight_kg) in [(hung(elastic), 2.0), (slung(elastic), 2.2)] {
            for to in ["30", "40", "25.5"] {
                let problem = Problem::parse(&file, "test.toml").unwrap();
                let trace = Trace::new().vary(&format!("joints.Q.force_n.z=0..{to}")).unwrap();
                let found = paths_of(&problem, &trace).remove(0);
                let last = found.points.last().unwrap().values[0];
                assert!((last - weight_kg * 9.80665).abs() < 1e-6, "{last}");
                assert!(found.end == LoadEnd::Open && found.agrees(), "{to} {:?}", found.confirmed);
                assert!(
                    found.events.iter().all(|event| event.kind == LoadEventKind::Kink),
                    "{:?}",
                    found.events
                );
            }
        }
    }
}

/// Six links of a metre, whose ends are pulled further apart than they reach: stable up to there, where forces have no bound.
#[test]
fn a_path_ends_where_a_row_is_straight() {
    for kind in ["bar", "cable"] {
        let file = format!(
            "[joints]\nA = {{ at_m = [0, 0, 0] }}\nB = {{ at_m = [4, 0, 0] }}\n\
            [[bars]]\nfrom = \"A\"\nto = \"B\"\nlength_m = 1\nmass_kg = 1\ncount = 6\nkind = {kind:?}\n"
        );
        let problem = Problem::parse(&file, "test.toml").unwrap();
        let trace = Trace::new().vary("joints.B.at_m.x=4..7").unwrap();
        let found = paths_of(&problem, &trace).remove(0);
        let last = found.points.last().unwrap().values[0];
        assert!((5.9..6.0).contains(&last) && found.events.is_empty(), "{kind} {last}");
        assert!(found.end == LoadEnd::Unbounded && found.agrees(), "{kind} {:?}", found.confirmed);
    }
}
