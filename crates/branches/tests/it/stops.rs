//! Load paths along stops, with closed forms.

use branches::load::{End, Equations, Kind, LoadPath, Settings, follow};
use nalgebra::DVector;

/// Stops along z: a spring of x beside one of z, to which each stop adds a slope from its place on, either sign
/// of it; x follows t with half its stiffness.
struct Stops {
    /// Places, slopes, and whether each is touched.
    all: Vec<(f64, f64, bool)>,
    slope: f64,
    /// How far all places move with the load.
    drift: f64,
}

impl Stops {
    fn new(stops: &[(f64, f64)]) -> Self {
        let free = |(at, slope): &(f64, f64)| (*at, *slope, false);
        Self { all: stops.iter().map(free).collect(), slope: 1.0, drift: 0.0 }
    }

    fn path(&mut self, range: [f64; 2]) -> LoadPath<Self> {
        let settings = Settings { range, longest: 0.125, max_points: 500, branches: 0 };
        follow(self, &DVector::zeros(2), settings, &|_, _| {}).unwrap().remove(0)
    }
}

impl Equations for Stops {
    type Side = usize;
    type Record = [f64; 2];
    type Error = ();

    fn places(&self) -> usize {
        2
    }

    fn residual(&mut self, y: &DVector<f64>, t: f64) -> Result<(DVector<f64>, f64), ()> {
        let touched = self.all.iter().filter(|(.., touched)| *touched);
        let held = touched.map(|(at, slope, _)| slope * (y[1] - at - self.drift * t));
        let held: f64 = held.sum();
        let rows = DVector::from_row_slice(&[2.0 * y[0] - t, y[1] + held - t]);
        let size = rows.amax();
        Ok((rows, size))
    }

    fn factorise(&mut self, _: &DVector<f64>, _: f64) -> Result<Option<usize>, ()> {
        let touched = self.all.iter().filter(|(.., touched)| *touched);
        self.slope = 1.0 + touched.map(|(_, slope, _)| slope).sum::<f64>();
        Ok(Some(usize::from(self.slope < 0.0)))
    }

    fn solve(&mut self, right: &DVector<f64>) -> DVector<f64> {
        DVector::from_row_slice(&[right[0] / 2.0, right[1] / self.slope])
    }

    fn apply(&self, y: &DVector<f64>) -> DVector<f64> {
        DVector::from_row_slice(&[2.0 * y[0], self.slope * y[1]])
    }

    fn sides(&mut self, y: &DVector<f64>, t: f64) -> Result<Vec<(usize, f64)>, ()> {
        let value = |(at, _, touched): &(f64, f64, bool)| {
            let off = at + self.drift * t - y[1];
            if *touched { -off } else { off }
        };
        Ok(self.all.iter().map(value).enumerate().collect())
    }

    fn switch(&mut self, side: usize) -> Result<bool, ()> {
        self.all[side].2 ^= true;
        Ok(self.all[side].2)
    }

    fn record(&mut self, y: &DVector<f64>, _: f64, _: usize) -> Result<[f64; 2], ()> {
        Ok([y[0], y[1]])
    }
}

/// Pieces of lines between kinks, each by its slope.
#[test]
fn kinks_of_stops_are_where_these_stand() {
    // The load rises by 1 to z = 1, by 4 a unit to z = 2, and by 2 from there on.
    let path = Stops::new(&[(2.0, -2.0), (1.0, 3.0)]).path([-0.25, 7.0]);
    let [first, second] = &path.events[..] else { panic!("{:?}", path.events) };
    for (event, t, side) in [(first, 1.0, 1), (second, 5.0, 0)] {
        let wanted = (Kind::Kink, [0, 0], false, vec![(side, true)]);
        assert_eq!((event.kind, event.index, event.turns, event.sides.clone()), wanted);
        assert!((event.t - t).abs() < 1e-9, "{} {t}", event.t);
    }
    let last = path.points.last().unwrap();
    assert_eq!((path.end, last.t), (End::Range, 7.0));
    assert!((last.record[1] - 3.0).abs() < 1e-12 && (last.record[0] - 3.5).abs() < 1e-12);
}

/// A stop that takes more than it gives turns the load, and the next turns it back.
#[test]
fn a_stop_that_gives_way_turns_the_load() {
    let path = Stops::new(&[(1.0, -1.5), (2.0, 4.5)]).path([-0.25, 2.0]);
    let [first, second] = &path.events[..] else { panic!("{:?}", path.events) };
    for (event, t, index, side) in [(first, 1.0, [0, 1], 0), (second, 0.5, [1, 0], 1)] {
        let wanted = (Kind::Kink, index, true, vec![(side, true)]);
        assert_eq!((event.kind, event.index, event.turns, event.sides.clone()), wanted);
        assert!((event.t - t).abs() < 1e-9, "{}", event.t);
        let [x, z] = path.points[event.point].record;
        assert!((x - 0.5 * t).abs() < 1e-9 && (z - 1.0 - side as f64).abs() < 1e-9, "{x} {z}");
    }
    let last = path.points.last().unwrap();
    assert_eq!((path.end, last.t), (End::Range, 2.0));
    assert!((last.record[1] - 2.375).abs() < 1e-12 && (last.record[0] - 1.0).abs() < 1e-12);
    // Every point is on its piece.
    for point in &path.points {
        let z = point.record[1];
        let t = if z < 1.0 {
            z
        } else if z < 2.0 {
            1.5 - 0.5 * z
        } else {
            0.5 + 4.0 * (z - 2.0)
        };
        assert!((point.t - t).abs() < 1e-9, "{} {z}", point.t);
    }
}

/// Stops in one place are one kink.
#[test]
fn stops_in_one_place_are_touched_together() {
    let path = Stops::new(&[(1.0, 1.0), (1.0, 2.0), (9.0, 1.0)]).path([-0.25, 2.0]);
    let [event] = &path.events[..] else { panic!("{:?}", path.events) };
    assert_eq!((event.kind, event.index, event.turns), (Kind::Kink, [0, 0], false));
    assert_eq!(event.sides, [(0, true), (1, true)]);
    assert!((path.points.last().unwrap().record[1] - 1.25).abs() < 1e-12);
}

/// A stop at 1 - t/2 is met by z = t at t = 2/3; from there on 4 z = 3 - t/2, up to where a second one at 3 - t/2
/// would be. One at 1 + 2 t is never met.
#[test]
fn stops_that_move_with_the_load_are_met_on_their_way() {
    let mut coming = Stops::new(&[(1.0, 3.0), (3.0, 1.0)]);
    coming.drift = -0.5;
    let path = coming.path([-0.25, 2.0]);
    let [event] = &path.events[..] else { panic!("{:?}", path.events) };
    assert_eq!(
        (event.kind, event.turns, event.sides.clone()),
        (Kind::Kink, false, vec![(0, true)])
    );
    assert!((event.t - 2.0 / 3.0).abs() < 1e-9, "{}", event.t);
    assert_eq!((path.end, path.points.last().unwrap().t), (End::Range, 2.0));
    for point in &path.points {
        let t = point.t;
        let z = if t < 2.0 / 3.0 { t } else { 0.75 - 0.125 * t };
        assert!((point.record[1] - z).abs() < 1e-9 && (point.record[0] - 0.5 * t).abs() < 1e-9);
    }
    let mut going = Stops::new(&[(1.0, 3.0)]);
    going.drift = 2.0;
    let path = going.path([-0.25, 2.0]);
    assert!(path.events.is_empty() && path.end == End::Range);
}
