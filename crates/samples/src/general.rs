//! Chains in general position.

use std::f64::consts::PI;
use std::ops::Range;

use model::{Anchors, Bar, Chain, Problem, Vector};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Where the last anchor is, seen from the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// Anywhere.
    Any,
    /// Straight below or above.
    Vertical,
    /// In the plane *OYZ*.
    PlaneOyz,
}

/// The ranges from which chains in general position are drawn, uniformly and independently.
#[derive(Debug, Clone, PartialEq)]
pub struct General {
    /// Length of a bar, m.
    pub length_m: Range<f64>,
    /// Mass of a bar, kg.
    pub mass_kg: Range<f64>,
    /// Distance of its centre of weight from its first joint, as a part of its length.
    pub centre: Range<f64>,
    /// Coordinates of the first anchor, m; the origin where the range is empty.
    pub start_m: Range<f64>,
    /// Distance of the anchors, as a part of the total length.
    pub span: Range<f64>,
    /// Slope of the line from the first anchor to the last, rad.
    pub slope_rad: Range<f64>,
    /// Where that line lies.
    pub line: Line,
}

impl Default for General {
    /// Lengths 0.5 m to 2 m, masses 0.1 kg to 3 kg, centres of weight anywhere, from the origin, a
    /// span of 5 % to 95 % of the length, slopes up to 80 degrees.
    fn default() -> Self {
        Self {
            length_m: 0.5..2.0,
            mass_kg: 0.1..3.0,
            centre: 0.0..1.0,
            start_m: 0.0..0.0,
            span: 0.05..0.95,
            slope_rad: -1.4..1.4,
            line: Line::Any,
        }
    }
}

impl General {
    /// The chains over which censuses are taken: lengths 0.3 m to 1 m, masses 0.05 kg to 1 kg, any
    /// slope.
    pub fn of_censuses(line: Line) -> Self {
        Self {
            length_m: 0.3..1.0,
            mass_kg: 0.05..1.0,
            centre: 0.1..0.9,
            span: 0.05..0.9,
            slope_rad: 0.0..2.0 * PI,
            line,
            ..Self::default()
        }
    }

    /// `n` bars.
    pub fn bars(&self, random: &mut ChaCha8Rng, n: usize) -> Vec<Bar> {
        let mut bar = || {
            let length_m = random.random_range(self.length_m.clone());
            let centre_m = length_m * random.random_range(self.centre.clone());
            let mass_kg = random.random_range(self.mass_kg.clone());
            Bar::new(length_m, mass_kg, centre_m, [0.0; 3]).expect("ranges of bars")
        };
        (0..n).map(|_| bar()).collect()
    }

    /// A chain of `n` bars in gravity 9.81 m/s². One that cannot close is drawn again.
    ///
    /// ```
    /// use samples::{General, Line, stream};
    /// let general = General { line: Line::Vertical, ..General::default() };
    /// let problem = general.problem(&mut stream(1, 0), 4);
    /// assert!(problem.chain().anchors_on_one_vertical());
    /// ```
    pub fn problem(&self, random: &mut ChaCha8Rng, n: usize) -> Problem {
        loop {
            let bars = self.bars(random, n);
            let start_m = self.start(random);
            let [x, y, z] = self.difference(random, bars.iter().map(Bar::length_m).sum());
            let end_m = [start_m[0] + x, start_m[1] + y, start_m[2] + z];
            let chain = Chain::new("random", 9.81, Anchors { start_m, end_m }, bars);
            if let Ok(problem) = Problem::new(chain.expect("ranges of a chain")) {
                return problem;
            }
        }
    }

    fn start(&self, random: &mut ChaCha8Rng) -> Vector {
        let Range { start, end } = self.start_m;
        if start < end { [(); 3].map(|()| random.random_range(start..end)) } else { [start; 3] }
    }

    /// The last anchor from the first, m.
    fn difference(&self, random: &mut ChaCha8Rng, total_m: f64) -> Vector {
        let span = random.random_range(self.span.clone()) * total_m;
        let slope: f64 = random.random_range(self.slope_rad.clone());
        let azimuth: f64 = random.random_range(0.0..2.0 * PI);
        match self.line {
            Line::Any => {
                let level = span * slope.cos();
                [level * azimuth.cos(), level * azimuth.sin(), span * slope.sin()]
            }
            Line::Vertical => [0.0, 0.0, span.copysign(slope.sin())],
            Line::PlaneOyz => [0.0, span * slope.cos(), span * slope.sin()],
        }
    }
}
