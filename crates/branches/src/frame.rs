//! The horizontal direction of the plane along a path, without jumps.
//!
//! The census measures along the horizontal direction from the first to the last anchor, which
//! flips where the anchors pass each other on one vertical. Here it does not: the horizontal span
//! becomes negative.

/// Unit vector (X, Y) of the plane at each point of a path, and how it goes on to the next.
#[derive(Debug, Clone)]
pub(crate) struct Frames {
    pub(crate) direction: Vec<[f64; 2]>,
    /// For each interval between two points.
    intervals: Vec<Interval>,
    /// Whether the anchors stand on one vertical at every point.
    pub(crate) always_vertical: bool,
}

#[derive(Debug, Clone, Copy)]
enum Interval {
    /// The anchors move along one line through the vertical: the direction stays.
    Fixed([f64; 2]),
    /// The direction turns with the anchors: this sign times theirs.
    Turning(f64),
}

/// Directions this near to each other are one: roundings of the coordinates.
const PARALLEL: f64 = 1e-12;

/// The anchors of the paper stand in the plane OYZ.
const PAPER_PLANE: [f64; 2] = [0.0, 1.0];

impl Frames {
    /// From the horizontal spans at the points.
    pub(crate) fn new(spans: &[[f64; 2]]) -> Self {
        let first = spans.iter().find_map(|span| unit(*span));
        let mut now = first.unwrap_or(PAPER_PLANE);
        let mut direction: Vec<[f64; 2]> = Vec::with_capacity(spans.len());
        let mut intervals = vec![];
        for (k, span) in spans.iter().enumerate() {
            let before = k.checked_sub(1).and_then(|k| unit(spans[k]));
            let (next, interval) = match (before, unit(*span)) {
                (_, None) => (now, Interval::Fixed(now)),
                (Some(_), Some(here)) if !parallel(now, here) => {
                    let sign = before.map_or(1.0, |before| dot(now, before).signum());
                    (here.map(|x| sign * x), Interval::Turning(sign))
                }
                (_, Some(here)) => {
                    let sign = if dot(now, here) < 0.0 { -1.0 } else { 1.0 };
                    let next = here.map(|x| sign * x);
                    (next, Interval::Fixed(next))
                }
            };
            if k > 0 {
                intervals.push(interval);
            }
            now = next;
            direction.push(now);
        }
        if intervals.is_empty() {
            intervals.push(Interval::Fixed(now));
        }
        Self { direction, intervals, always_vertical: first.is_none() }
    }

    /// The horizontal span with its sign, in the interval of this number.
    pub(crate) fn signed(&self, interval: usize, span: [f64; 2]) -> f64 {
        match self.intervals[interval] {
            Interval::Fixed(direction) => dot(direction, span),
            Interval::Turning(sign) => sign * span[0].hypot(span[1]),
        }
    }
}

fn unit(span: [f64; 2]) -> Option<[f64; 2]> {
    let size = span[0].hypot(span[1]);
    (size > 0.0).then(|| span.map(|x| x / size))
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn parallel(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] * b[1] - a[1] * b[0]).abs() <= PARALLEL
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passing_the_vertical_does_not_flip_the_plane() {
        let frames = Frames::new(&[[-1.0, 0.0], [-0.5, 0.0], [0.0, 0.0], [0.5, 0.0]]);
        assert!(frames.direction.iter().all(|d| d[0] < -0.5), "{frames:?}");
        assert!(frames.signed(0, [-0.7, 0.0]) > 0.0 && frames.signed(2, [0.2, 0.0]) < 0.0);
        // Nor does passing it between two points.
        let frames = Frames::new(&[[-1.0, 0.0], [0.5, 0.0]]);
        assert!(frames.signed(0, [-0.7, 0.0]) > 0.0 && frames.signed(0, [0.2, 0.0]) < 0.0);
    }

    #[test]
    fn going_round_the_vertical_turns_the_plane() {
        let frames = Frames::new(&[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]);
        assert!(frames.signed(0, [0.6, 0.8]) > 0.99 && frames.signed(1, [-0.6, 0.8]) > 0.99);
        assert!(frames.direction[2][0] < -0.99);
    }
}
