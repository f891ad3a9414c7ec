//! Load paths of potentials with closed forms.

use std::f64::consts::PI;

use branches::load::{
    End, Equations, Kind, LoadPath, NoPath, Parent, Settings, difference, follow, linear_buckling,
};
use nalgebra::{DMatrix, DVector};

/// The gradient of a potential of x and z and its second derivative, both at a load t.
type Gradient = fn([f64; 2], f64) -> [f64; 2];
type Second = fn([f64; 2], f64) -> [[f64; 2]; 2];

struct Potential {
    gradient: Gradient,
    second: Second,
    matrix: DMatrix<f64>,
    /// How often the gradient was asked for, and a factor.
    asked: [usize; 2],
    /// How many of x and z are places.
    places: usize,
    /// Loads at which there is a gradient.
    loads: [f64; 2],
    /// Where z meets a stop, its slope, and whether it is touched.
    stop: (f64, f64, bool),
}

impl Potential {
    fn new(gradient: Gradient, second: Second) -> Self {
        Self {
            gradient,
            second,
            matrix: DMatrix::zeros(2, 2),
            asked: [0; 2],
            places: 2,
            loads: [f64::NEG_INFINITY, f64::INFINITY],
            stop: (f64::INFINITY, 0.0, false),
        }
    }

    fn path(self, start: [f64; 2], range: [f64; 2]) -> Result<LoadPath<Self>, NoPath<()>> {
        Ok(self.paths(start, range, 0)?.remove(0))
    }

    fn paths(
        mut self,
        start: [f64; 2],
        range: [f64; 2],
        branches: usize,
    ) -> Result<Vec<LoadPath<Self>>, NoPath<()>> {
        self.follow(start, range, branches)
    }

    fn follow(
        &mut self,
        start: [f64; 2],
        range: [f64; 2],
        branches: usize,
    ) -> Result<Vec<LoadPath<Self>>, NoPath<()>> {
        let settings = Settings { range, longest: 0.05, max_points: 500, branches };
        follow(self, &DVector::from_row_slice(&start), settings, &|_, _| {})
    }
}

impl Equations for Potential {
    type Side = ();
    type Record = [f64; 2];
    type Error = ();

    fn places(&self) -> usize {
        self.places
    }

    fn residual(&mut self, y: &DVector<f64>, t: f64) -> Result<(DVector<f64>, f64), ()> {
        self.asked[0] += 1;
        if !(self.loads[0]..=self.loads[1]).contains(&t) {
            return Err(());
        }
        let mut rows = DVector::from_row_slice(&(self.gradient)([y[0], y[1]], t));
        if let (at, slope, true) = self.stop {
            rows[1] += slope * (y[1] - at);
        }
        let size = rows.amax();
        Ok((rows, size))
    }

    fn factorise(&mut self, y: &DVector<f64>, t: f64) -> Result<Option<usize>, ()> {
        self.asked[1] += 1;
        let [a, b] = (self.second)([y[0], y[1]], t);
        let stiff = if self.stop.2 { self.stop.1 } else { 0.0 };
        self.matrix = DMatrix::from_row_slice(2, 2, &[a[0], a[1], b[0], b[1] + stiff]);
        let values = self.matrix.symmetric_eigenvalues();
        Ok(Some(values.iter().filter(|value| **value < 0.0).count()))
    }

    fn solve(&mut self, right: &DVector<f64>) -> DVector<f64> {
        // A tiny stiffness where there is none.
        let lu = self.matrix.clone().full_piv_lu();
        let shifted = || (&self.matrix + DMatrix::identity(2, 2) * 1e-14).full_piv_lu();
        lu.solve(right).or_else(|| shifted().solve(right)).unwrap_or_else(|| DVector::zeros(2))
    }

    fn apply(&self, y: &DVector<f64>) -> DVector<f64> {
        &self.matrix * y
    }

    fn sides(&mut self, y: &DVector<f64>, _: f64) -> Result<Vec<((), f64)>, ()> {
        let (at, _, touched) = self.stop;
        let off = if touched { y[1] - at } else { at - y[1] };
        Ok(if at.is_finite() { vec![((), off)] } else { vec![] })
    }

    fn switch(&mut self, (): ()) -> Result<bool, ()> {
        self.stop.2 ^= true;
        Ok(self.stop.2)
    }

    fn record(&mut self, y: &DVector<f64>, _: f64, _: usize) -> Result<[f64; 2], ()> {
        Ok([y[0], y[1]])
    }
}

/// V = 4 (z^4/4 - z^2/2 - t z + x^2/2): from z = -1 up to the fold t = 2/(3 sqrt 3), back to the other.
#[test]
fn folds_of_a_cubic() {
    let cubic = Potential::new(
        |[x, z], t| [4.0 * x, 4.0 * (z.powi(3) - z - t)],
        |[_, z], _| [[4.0, 0.0], [0.0, 4.0 * (3.0 * z * z - 1.0)]],
    );
    let path = cubic.path([0.0, -1.0], [-1.0, 1.0]).unwrap();
    let fold = 2.0 / 27_f64.sqrt();
    let found: Vec<_> = path.events.iter().map(|event| (event.kind, event.index)).collect();
    assert_eq!(found, [(Kind::Limit, [0, 1]), (Kind::Limit, [1, 0])]);
    for (event, wanted) in path.events.iter().zip([fold, -fold]) {
        assert!((event.t - wanted).abs() < 1e-12 && event.turns);
        assert!((event.load_on_mode - 1.0).abs() < 1e-9, "{event:?}");
        assert!(event.mode[0].abs() < 1e-12 && (event.mode[1] - 1.0).abs() < 1e-12);
    }
    assert_eq!((path.end, path.points.last().unwrap().t), (End::Range, 1.0));
}

/// V = z^2/2 - t z + (1 - z) x^2/2 + x^4/4: upright until t = 1, where x may go either way.
#[test]
fn a_pitchfork_is_passed_straight_on() {
    let pitchfork = Potential::new(
        |[x, z], t| [(1.0 - z) * x + x.powi(3), z - t - 0.5 * x * x],
        |[x, z], _| [[1.0 - z + 3.0 * x * x, -x], [-x, 1.0]],
    );
    let path = pitchfork.path([0.0, 0.0], [0.0, 2.0]).unwrap();
    let [event] = &path.events[..] else { panic!("{:?}", path.events) };
    assert_eq!((event.kind, event.index, event.turns), (Kind::Branch, [0, 1], false));
    assert!((event.t - 1.0).abs() < 1e-12 && event.load_on_mode < 1e-9);
    assert!((event.mode[0] - 1.0).abs() < 1e-9 && event.mode[1].abs() < 1e-9);
    assert_eq!(path.points[event.point].event, Some(0));
}

/// The same under t^3, which changes nothing at t = 0: beyond t = 1 the upright one is left by x^2 = z - 1,
/// z = t^3 + x^2 / 2, so that x^2 / 2 = t^3 - 1, both ways.
#[test]
fn both_paths_of_a_pitchfork_are_followed() {
    let pitchfork = || {
        Potential::new(
            |[x, z], t| [(1.0 - z) * x + x.powi(3), z - t.powi(3) - 0.5 * x * x],
            |[x, z], _| [[1.0 - z + 3.0 * x * x, -x], [-x, 1.0]],
        )
    };
    let paths = pitchfork().paths([0.0, 0.0], [0.0, 1.5], 1).unwrap();
    assert_eq!(paths.len(), 3);
    let mut sides = vec![];
    for path in &paths[1..] {
        assert_eq!(path.parent, Some(Parent { path: 0, event: 0 }));
        assert_eq!((path.end.clone(), path.events.len()), (End::Range, 0));
        for point in &path.points {
            let [x, z] = point.record;
            assert!((0.5 * x * x - (point.t.powi(3) - 1.0)).abs() < 1e-9 && point.index == 0);
            assert!((z - 1.0 - x * x).abs() < 1e-9);
        }
        sides.push(path.points.last().unwrap().record[0].signum());
    }
    assert!(sides.contains(&1.0) && sides.contains(&-1.0));
    assert_eq!(pitchfork().paths([0.0, 0.0], [0.0, 1.5], 0).unwrap().len(), 1);
}

/// V = (1 - t) (x^2 + z^2)/2 + 400 (x^4/4 + x^2 z^2/4 + z^4/2): in t = 1 both give way at once, along each alone with
/// 400 x^2 = t - 1 and 800 z^2 = t - 1, and along both with x^2 + z^2/2 = (t - 1)/400 = 2 z^2 + x^2/2.
#[test]
fn paths_leave_along_both_modes_that_meet() {
    const STIFF: f64 = 400.0;
    let double = Potential::new(
        |[x, z], t| {
            let [along_x, along_z] = [x * x + 0.5 * z * z, 2.0 * z * z + 0.5 * x * x];
            [(1.0 - t + STIFF * along_x) * x, (1.0 - t + STIFF * along_z) * z]
        },
        |[x, z], t| {
            let mixed = STIFF * x * z;
            let own = [3.0 * x * x + 0.5 * z * z, 6.0 * z * z + 0.5 * x * x];
            [[1.0 - t + STIFF * own[0], mixed], [mixed, 1.0 - t + STIFF * own[1]]]
        },
    );
    let paths = double.paths([0.0, 0.0], [0.0, 2.0], 1).unwrap();
    let [event] = &paths[0].events[..] else { panic!("{:?}", paths[0].events) };
    assert_eq!((event.kind, event.index), (Kind::Branch, [0, 2]));
    let mut leaves: Vec<[i8; 2]> = vec![];
    for path in &paths[1..] {
        assert_eq!(path.end, End::Range);
        let [x, z] = path.points[path.points.len() / 2].record;
        let way = [x, z].map(|x| i8::from(x > 1e-6) - i8::from(x < -1e-6));
        for point in &path.points {
            let ([x, z], load) = (point.record, point.t - 1.0);
            let wanted = match way {
                [_, 0] => [load, 0.0],
                [0, _] => [0.0, 0.5 * load],
                _ => [1.5 / 1.75 * load, 0.5 / 1.75 * load],
            };
            for (x, wanted) in [x, z].into_iter().zip(wanted) {
                assert!((STIFF * x * x - wanted).abs() < 1e-6, "{way:?}: {x} at {load}");
            }
            assert_eq!(point.index, usize::from(way.contains(&0)));
        }
        leaves.push(way);
    }
    leaves.sort_unstable();
    let all = (-1..=1).flat_map(|x| (-1..=1).map(move |z| [x, z])).filter(|way| *way != [0, 0]);
    assert_eq!(leaves, all.collect::<Vec<_>>());
}

/// V = (1 - t) r^2 / 2 + 100 r^4 + C r^6 cos(6 a) / 6: in t = 1 twelve paths leave, along a = k pi / 6 with
/// t - 1 = 400 r^2 +- C r^4. Between them nearly nothing moves a place along its circle: C r^5 sin(6 a).
#[test]
fn paths_leave_between_equal_modes_along_all_lines_of_symmetry() {
    fn of_six<const SOFT: u32>() -> Potential {
        Potential::new(
            |[x, z], t| {
                let soft = f64::from(SOFT);
                let ([x2, z2], stiff) = ([x * x, z * z], 1.0 - t + 400.0 * (x * x + z * z));
                let of_five = [
                    x * (x2 * x2 - 10.0 * x2 * z2 + 5.0 * z2 * z2),
                    -z * (5.0 * x2 * x2 - 10.0 * x2 * z2 + z2 * z2),
                ];
                [stiff * x + soft * of_five[0], stiff * z + soft * of_five[1]]
            },
            |[x, z], t| {
                let soft = f64::from(SOFT);
                let ([x2, z2], mixed) = ([x * x, z * z], 800.0 * x * z);
                let stiff = 1.0 - t + 400.0 * (x2 + z2);
                let of_four = 5.0 * (x2 * x2 - 6.0 * x2 * z2 + z2 * z2);
                let turned = -20.0 * x * z * (x2 - z2);
                [
                    [stiff + 800.0 * x2 + soft * of_four, mixed + soft * turned],
                    [mixed + soft * turned, stiff + 800.0 * z2 - soft * of_four],
                ]
            },
        )
    }
    let all = [of_six::<100_000>(), of_six::<10_000>(), of_six::<1000>(), of_six::<100>()];
    for (double, soft) in all.into_iter().zip([1e5, 1e4, 1e3, 1e2]) {
        let paths = double.paths([0.0, 0.0], [0.0, 2.0], 1).unwrap();
        let mut lines = vec![];
        for path in &paths[1..] {
            assert_eq!(path.end, End::Range, "{soft}");
            let line = |[x, z]: [f64; 2]| z.atan2(x) * 6.0 / PI;
            let first = line(path.points[0].record).round();
            let sign = if first.rem_euclid(2.0) > 0.5 { -1.0 } else { 1.0 };
            for point in &path.points {
                let [x, z] = point.record;
                let square = x * x + z * z;
                let load = 400.0 * square + sign * soft * square * square;
                assert!((point.t - 1.0 - load).abs() < 1e-9, "{soft}: {point:?}");
                let off = (line([x, z]) - first).rem_euclid(12.0);
                assert!(off.min(12.0 - off) < 1e-6, "{soft}: {point:?}");
            }
            lines.push(first.rem_euclid(12.0));
        }
        lines.sort_by(f64::total_cmp);
        assert_eq!(lines, (0..12).map(f64::from).collect::<Vec<_>>(), "{soft}");
    }
    // Rounding hides them all.
    assert_eq!(of_six::<1>().paths([0.0, 0.0], [0.0, 2.0], 1).unwrap().len(), 1);
}

/// V = x^4 / 4 - (z - 1) (2 - z) x^2 / 2 + z^2 / 2 - t z: the upright path is left in t = 1 by
/// x^2 = (z - 1) (2 - z), which comes back to it in t = 2 from both sides.
#[test]
fn paths_that_come_back_end_there() {
    let bubble = Potential::new(
        |[x, z], t| [x.powi(3) - (z - 1.0) * (2.0 - z) * x, z - t - (1.5 - z) * x * x],
        |[x, z], _| {
            let mixed = -(3.0 - 2.0 * z) * x;
            [[3.0 * x * x - (z - 1.0) * (2.0 - z), mixed], [mixed, 1.0 + x * x]]
        },
    );
    let paths = bubble.paths([0.0, 0.0], [0.0, 3.0], 2).unwrap();
    assert_eq!(paths.len(), 3);
    for path in &paths[1..] {
        assert_eq!(path.parent, Some(Parent { path: 0, event: 0 }));
        assert_eq!(path.end, End::Joins(Parent { path: 0, event: 1 }));
        for point in &path.points {
            let [x, z] = point.record;
            assert!((x * x - (z - 1.0) * (2.0 - z)).abs() < 1e-9);
        }
    }
}

/// The pitchfork that opens down, with x pushed by 1e-5: the path from the start turns to one side in a limit
/// point, close to where the other one begins.
#[test]
fn a_path_is_not_left_for_one_next_to_it() {
    let off = |[x, z]: [f64; 2], t: f64| [(1.0 - z) * x - x.powi(3) - 1e-5, z - t - 0.5 * x * x];
    let pushed = Potential::new(off, |[x, z], _| [[1.0 - z - 3.0 * x * x, -x], [-x, 1.0]]);
    let path = pushed.path([0.0, 0.0], [0.0, 2.0]).unwrap();
    let found: Vec<_> = path.events.iter().map(|event| (event.kind, event.index)).collect();
    assert_eq!(found, [(Kind::Limit, [0, 1])]);
    // With z = t + x^2 / 2: t = 1 - 3 x^2 / 2 - 1e-5 / x has its maximum at 3 x^3 = 1e-5.
    let x = (1e-5_f64 / 3.0).cbrt();
    assert!((path.events[0].t - (1.0 - 1.5 * x * x - 1e-5 / x)).abs() < 1e-11);
    assert_eq!((path.end, path.points.last().unwrap().t), (End::Range, 0.0));
}

/// V = z^3 / 3 - (1e-6 - t) z + x^2 / 2: from z = 1e-3 the limit at t = 1e-6 of the range is not passed by, and the
/// other side is followed down.
#[test]
fn a_limit_at_the_very_start_is_seen() {
    let early =
        Potential::new(|[x, z], t| [x, z * z - 1e-6 + t], |[_, z], _| [[1.0, 0.0], [0.0, 2.0 * z]]);
    let path = early.path([0.0, 1e-3], [-1.0, 1.0]).unwrap();
    let limit = path.events.iter().find(|event| event.kind == Kind::Limit).unwrap();
    assert!((limit.t - 1e-6).abs() < 1e-12 && limit.index == [0, 1]);
    assert_eq!((path.end, path.points.last().unwrap().t), (End::Range, -1.0));
}

/// The transcritical point below, with x pushed by e: where it was crossed there is a limit at the largest
/// t = 1 - x - e / x - x^2 / 2. The loss goes with the root of the push, Koiter's half power.
#[test]
fn what_a_push_costs_an_unsymmetric_point_goes_with_its_root() {
    fn pushed(x: f64, z: f64, t: f64, push: f64) -> [f64; 2] {
        [(1.0 - z) * x - x * x - push, z - t - 0.5 * x * x]
    }
    let second: Second = |[x, z], _| [[1.0 - z - 2.0 * x, -x], [-x, 1.0]];
    let loss = |gradient: Gradient, push: f64| {
        let path = Potential::new(gradient, second).path([0.0, 0.0], [0.0, 2.0]).unwrap();
        let limit = &path.events[0];
        assert_eq!((limit.kind, limit.index), (Kind::Limit, [0, 1]));
        // 1 + x - e / x^2 = 0 there.
        let mut x = push.sqrt();
        for _ in 0..50 {
            x = (push / (1.0 + x)).sqrt();
        }
        assert!((limit.t - (1.0 - x - push / x - 0.5 * x * x)).abs() < 1e-11);
        1.0 - limit.t
    };
    let small = loss(|[x, z], t| pushed(x, z, t, 1e-8), 1e-8);
    let large = loss(|[x, z], t| pushed(x, z, t, 4e-8), 4e-8);
    assert!((large / small - 2.0).abs() < 1e-3, "{}", large / small);
}

/// V = (1 - z) x^2 / 2 - x^3 / 3 + z^2 / 2 - t z: in t = 1 the upright path is crossed by x = 1 - z with
/// z = t + x^2 / 2, on which the stable side and the other change places.
#[test]
fn a_transcritical_point_has_one_path_more_with_two_ends() {
    let exchange = Potential::new(
        |[x, z], t| [(1.0 - z) * x - x * x, z - t - 0.5 * x * x],
        |[x, z], _| [[1.0 - z - 2.0 * x, -x], [-x, 1.0]],
    );
    let paths = exchange.paths([0.0, 0.0], [0.0, 1.3], 1).unwrap();
    assert_eq!(paths.len(), 3);
    for path in &paths[1..] {
        for point in &path.points {
            let [x, z] = point.record;
            assert!((x - (1.0 - z)).abs() < 1e-9 && (z - point.t - 0.5 * x * x).abs() < 1e-9);
        }
    }
    let signs: Vec<_> = paths[1..].iter().map(|path| path.points[0].record[0] > 0.0).collect();
    assert!(signs.contains(&true) && signs.contains(&false));
}

#[test]
fn starts_that_are_none() {
    let parabola = |shift: f64| {
        let gradient: Gradient =
            if shift > 0.0 { |[x, z], t| [x, z * z + 1.0 - t] } else { |[x, z], t| [x, z * z - t] };
        Potential::new(gradient, |[_, z], _| [[1.0, 0.0], [0.0, 2.0 * z]])
    };
    assert!(matches!(parabola(1.0).path([0.0, 0.3], [0.0, 1.0]), Err(NoPath::Start { .. })));
    assert!(matches!(parabola(0.0).path([0.0, 0.0], [0.0, 1.0]), Err(NoPath::Singular)));
}

/// Points, events, gradients and factors of paths through limits, branch points and next to them, frozen: where
/// another number is meant, the failing test prints the table that then belongs here.
#[test]
fn work_of_paths() {
    type Case = (Gradient, Second, [f64; 2], [f64; 2], usize);
    let cases: [Case; 6] = [
        (
            |[x, z], t| [x, z.powi(3) - z - t],
            |[_, z], _| [[1.0, 0.0], [0.0, 3.0 * z * z - 1.0]],
            [0.0, -1.0],
            [-1.0, 1.0],
            0,
        ),
        // The same in units of 1/50 and 50.
        (
            |[x, z], t| [x, 0.02 * ((50.0 * z).powi(3) - 50.0 * z - t)],
            |[_, z], _| [[1.0, 0.0], [0.0, 3.0 * (50.0 * z).powi(2) - 1.0]],
            [0.0, -0.02],
            [-1.0, 1.0],
            0,
        ),
        (
            |[x, z], t| [50.0 * x, 50.0 * ((0.02 * z).powi(3) - 0.02 * z - t)],
            |[_, z], _| [[50.0, 0.0], [0.0, 3.0 * (0.02 * z).powi(2) - 1.0]],
            [0.0, -50.0],
            [-1.0, 1.0],
            0,
        ),
        (
            |[x, z], t| [x.powi(3) - (z - 1.0) * (2.0 - z) * x, z - t - (1.5 - z) * x * x],
            |[x, z], _| {
                let mixed = -(3.0 - 2.0 * z) * x;
                [[3.0 * x * x - (z - 1.0) * (2.0 - z), mixed], [mixed, 1.0 + x * x]]
            },
            [0.0, 0.0],
            [0.0, 3.0],
            2,
        ),
        (
            |[x, z], t| [(1.0 - z) * x - x.powi(3) - 1e-5, z - t - 0.5 * x * x],
            |[x, z], _| [[1.0 - z - 3.0 * x * x, -x], [-x, 1.0]],
            [0.0, 0.0],
            [0.0, 2.0],
            1,
        ),
        (
            |[x, z], t| [(1.0 - z) * x - x * x, z - t - 0.5 * x * x],
            |[x, z], _| [[1.0 - z - 2.0 * x, -x], [-x, 1.0]],
            [0.0, 0.0],
            [0.0, 1.3],
            1,
        ),
    ];
    let found = cases.map(|(gradient, second, start, range, branches)| {
        let mut potential = Potential::new(gradient, second);
        let paths = potential.follow(start, range, branches).unwrap();
        let points: usize = paths.iter().map(|path| path.points.len()).sum();
        let events: usize = paths.iter().map(|path| path.events.len()).sum();
        [paths.len(), points, events, potential.asked[0], potential.asked[1]]
    });
    let expected = [
        [1, 61, 2, 819, 275],
        [1, 61, 2, 801, 257],
        [1, 61, 2, 916, 318],
        [3, 145, 4, 2227, 672],
        [1, 74, 1, 996, 327],
        [3, 75, 1, 721, 198],
    ];
    samples::assert_frozen(&found, &expected);
}

/// Of (t^2 + x, 3 t - t^2/2) by t, from both sides or one: exactly (2 t, 3 - t).
#[test]
fn a_difference_is_taken_on_the_side_that_has_a_meaning() {
    for (loads, t) in [([-1.0, 2.0], 0.5), ([0.25, 2.0], 0.25), ([-1.0, 0.75], 0.75)] {
        let mut parabola = Potential::new(
            |[x, _], t| [t * t + x, 3.0 * t - 0.5 * t * t],
            |_, _| [[1.0, 0.0], [0.0, 1.0]],
        );
        parabola.loads = loads;
        let found = difference(&mut parabola, &DVector::from_row_slice(&[7.0, 0.0]), t).unwrap();
        for (found, wanted) in found.iter().zip([2.0 * t, 3.0 - t]) {
            assert!((found - wanted).abs() < 1e-9, "{t}: {found}, not {wanted}");
        }
        assert!(difference(&mut parabola, &DVector::zeros(2), 3.0).is_err());
    }
}

/// A column of stiffness 5/2 under a force n = t gives way at t = 5/2: V = (5/2 - n) x^2/2 - n^2/2 + t n. Two places
/// under a load that takes from their stiffness at the lesser root of (3 - 2 t)(4 - t) = (1 - t/2)^2, and with the
/// load the other way nowhere.
#[test]
fn linear_buckling_is_the_least_load_of_the_pencil() {
    let start = DVector::zeros(2);
    let mut column = Potential::new(
        |[x, n], t| [(2.5 - n) * x, t - n - 0.5 * x * x],
        |[x, n], _| [[2.5 - n, -x], [-x, -1.0]],
    );
    column.places = 1;
    let found = linear_buckling(&mut column, &start).unwrap().unwrap();
    assert!((found - 2.5).abs() < 1e-6, "{found}");
    let mut pencil = Potential::new(
        |[x, z], t| {
            let mixed = 1.0 - 0.5 * t;
            [(3.0 - 2.0 * t) * x + mixed * z, mixed * x + (4.0 - t) * z]
        },
        |_, t| [[3.0 - 2.0 * t, 1.0 - 0.5 * t], [1.0 - 0.5 * t, 4.0 - t]],
    );
    // 7/4 t^2 - 10 t + 11 = 0.
    let wanted = (10.0 - (100.0_f64 - 77.0).sqrt()) / 3.5;
    let found = linear_buckling(&mut pencil, &start).unwrap().unwrap();
    assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}");
    let mut away = Potential::new(
        |[x, z], t| [(3.0 + 2.0 * t) * x, (4.0 + t) * z],
        |_, t| [[3.0 + 2.0 * t, 0.0], [0.0, 4.0 + t]],
    );
    assert_eq!(linear_buckling(&mut away, &start).unwrap(), None);
    let mut still = Potential::new(|[x, z], _| [3.0 * x, 4.0 * z], |_, _| [[3.0, 0.0], [0.0, 4.0]]);
    assert_eq!(linear_buckling(&mut still, &start).unwrap(), None);
}

/// The pitchfork with a stop of slope 3 at z = 3/2: the upright path meets it at t = 3/2 and goes on with
/// z = (t + 9/2)/4; those beside it, which begin at t = 1 before the stop, with z = 2 t - 1 meet it at t = 5/4
/// and go on with z = (t + 4) 2/7.
#[test]
fn paths_beside_meet_the_stops_anew() {
    let mut pitchfork = Potential::new(
        |[x, z], t| [(1.0 - z) * x + x.powi(3), z - t - 0.5 * x * x],
        |[x, z], _| [[1.0 - z + 3.0 * x * x, -x], [-x, 1.0]],
    );
    pitchfork.stop = (1.5, 3.0, false);
    let paths = pitchfork.follow([0.0, 0.0], [0.0, 2.0], 1).unwrap();
    assert_eq!(paths.len(), 3);
    for (number, path) in paths.iter().enumerate() {
        let meets = if number == 0 { 1.5 } else { 1.25 };
        let kinks: Vec<_> = path.events.iter().filter(|event| event.kind == Kind::Kink).collect();
        let [kink] = kinks[..] else { panic!("{number}: {:?}", path.events) };
        assert!((kink.t - meets).abs() < 1e-9 && kink.sides == [((), true)], "{kink:?}");
        assert_eq!((path.end.clone(), path.points.last().unwrap().t), (End::Range, 2.0));
        for point in &path.points {
            let ([x, z], t) = (point.record, point.t);
            let wanted = match (number, t < meets) {
                (0, true) => t,
                (0, false) => (t + 4.5) / 4.0,
                (_, true) => 2.0 * t - 1.0,
                (_, false) => (t + 4.0) / 3.5,
            };
            assert!((z - wanted).abs() < 1e-8, "{number}: {z} at {t}, not {wanted}");
            let square = if number == 0 { 0.0 } else { z - 1.0 };
            assert!((x * x - square).abs() < 1e-8, "{number}: {x} at {t}");
        }
    }
}

/// The upright path that ends where it meets the stop has no kink; cut after so many points it ends there.
#[test]
fn paths_end_at_the_range_or_after_so_many_points() {
    let mut upright = Potential::new(|[x, z], t| [2.0 * x, z - t], |_, _| [[2.0, 0.0], [0.0, 1.0]]);
    upright.stop = (1.5, 3.0, false);
    let path = upright.follow([0.0, 0.0], [0.0, 1.5], 0).unwrap().remove(0);
    assert_eq!((path.end, path.events.len()), (End::Range, 0));
    let settings = Settings { range: [0.0, 1.5], longest: 0.05, max_points: 7, branches: 0 };
    let path = follow(&mut upright, &DVector::zeros(2), settings, &|_, _| {}).unwrap().remove(0);
    assert_eq!((path.end, path.points.len()), (End::MaxPoints, 7));
}
