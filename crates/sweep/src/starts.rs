//! Where seeds come from: angles of all bars for every seed number.

use std::f64::consts::TAU;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::error::SweepError;
use crate::seeds::{Stream, unit};
use crate::sobol::Sobol;

/// How seeds are spread over the angles of the bars, each from the descending vertical.
///
/// Seed k is the same whatever threads, shards or order the sweep has: it is computed from k alone.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Source {
    /// Each angle uniform on [0, 2π), independent of the others.
    #[default]
    Uniform,
    /// Sobol's sequence on [0, 2π) in all angles; seed number 0 takes it as published, any other
    /// turns on a fixed random set of its binary digits in each dimension (a digital shift), which
    /// keeps it as even. Up to 32 bars.
    Sobol,
    /// A regular grid, the first bar varying fastest; seeds beyond its last point begin again.
    Grid(Vec<Axis>),
}

/// One angle of a grid: the middles of `points` equal parts of an interval. With one point it is
/// fixed at the middle.
///
/// ```
/// use std::f64::consts::FRAC_PI_4;
/// use sweep::Axis;
/// let quarters = Axis::full(4);
/// assert_eq!([0, 1, 2, 3].map(|k| quarters.at(k) / FRAC_PI_4), [1.0, 3.0, 5.0, 7.0]);
/// assert_eq!(Axis::fixed(0.3).at(0), 0.3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Where the interval begins, rad.
    pub from_rad: f64,
    /// Where it ends, rad.
    pub to_rad: f64,
    /// Number of parts.
    pub points: u64,
}

impl Axis {
    /// The full turn in `points` parts.
    pub fn full(points: u64) -> Self {
        Self { from_rad: 0.0, to_rad: TAU, points }
    }

    /// One angle.
    pub fn fixed(angle_rad: f64) -> Self {
        Self { from_rad: angle_rad, to_rad: angle_rad, points: 1 }
    }

    /// The angle of part `k`, rad.
    pub fn at(&self, k: u64) -> f64 {
        let part = (k as f64 + 0.5) / self.points as f64;
        // A fixed angle is exact: the length of the interval is zero.
        self.from_rad + (self.to_rad - self.from_rad) * part
    }
}

/// A source made ready for a chain.
#[derive(Debug, Clone)]
pub(crate) enum Starts {
    Uniform { stream: Stream },
    Sobol { sobol: Sobol, shift: Vec<u64> },
    Grid { axes: Vec<Axis>, points: u64 },
}

impl Source {
    pub(crate) fn ready(&self, number: u64, bars: usize) -> Result<Starts, SweepError> {
        let stream = Stream::new(number);
        match self {
            Self::Uniform => Ok(Starts::Uniform { stream }),
            Self::Sobol => {
                let shift = (0..bars as u64).map(|k| if number == 0 { 0 } else { stream.at(k) });
                Ok(Starts::Sobol { sobol: Sobol::new(bars)?, shift: shift.collect() })
            }
            Self::Grid(axes) => {
                if axes.len() != bars {
                    return Err(SweepError::GridAxes { bars, axes: axes.len() });
                }
                let mut points = 1_u64;
                for (k, axis) in axes.iter().enumerate() {
                    let Axis { from_rad, to_rad, points } = *axis;
                    if points == 0 || !(to_rad - from_rad).is_finite() {
                        return Err(SweepError::GridAxis { axis: k + 1, points, from_rad, to_rad });
                    }
                }
                for axis in axes {
                    points = points.checked_mul(axis.points).ok_or(SweepError::GridSize)?;
                }
                Ok(Starts::Grid { axes: axes.clone(), points })
            }
        }
    }
}

impl Starts {
    /// The angles of a run of seeds, bar by bar and seed by seed, in place of what is in `angles`.
    pub(crate) fn fill(&self, seeds: Range<u64>, bars: usize, angles: &mut Vec<f64>) {
        angles.clear();
        match self {
            Self::Uniform { stream } => {
                for seed in seeds {
                    let first = seed.wrapping_mul(bars as u64);
                    let numbers = (0..bars as u64).map(|k| stream.at(first.wrapping_add(k)));
                    angles.extend(numbers.map(|bits| TAU * unit(bits)));
                }
            }
            Self::Sobol { sobol, shift } => {
                for seed in seeds {
                    let bits = shift.iter().enumerate().map(|(k, s)| sobol.at(seed, k) ^ s);
                    angles.extend(bits.map(|bits| TAU * unit(bits)));
                }
            }
            Self::Grid { axes, points } => {
                for seed in seeds {
                    let mut rest = seed % points;
                    for axis in axes {
                        angles.push(axis.at(rest % axis.points));
                        rest /= axis.points;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Source};
    use crate::error::SweepError;

    #[test]
    fn a_seed_does_not_depend_on_where_a_run_begins() {
        let grid = Source::Grid(vec![Axis::full(7), Axis::fixed(0.3), Axis::full(5)]);
        for source in [Source::Uniform, Source::Sobol, grid] {
            let starts = source.ready(9, 3).unwrap();
            let (mut all, mut part) = (vec![], vec![]);
            starts.fill(0..100, 3, &mut all);
            starts.fill(37..100, 3, &mut part);
            let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&all[3 * 37..]), bits(&part));
            assert!(all.iter().all(|x| (0.0..std::f64::consts::TAU).contains(x)));
        }
    }

    #[test]
    fn a_grid_has_each_point_once_and_then_begins_again() {
        let starts = Source::Grid(vec![Axis::full(2), Axis::fixed(0.25)]).ready(0, 2).unwrap();
        let mut angles = vec![];
        starts.fill(0..3, 2, &mut angles);
        let half = std::f64::consts::FRAC_PI_2;
        for (x, y) in angles.iter().zip([half, 0.25, 3.0 * half, 0.25, half, 0.25]) {
            assert!((x - y).abs() < 1e-15);
        }
    }

    #[test]
    fn grids_that_are_none_are_refused() {
        let refused = |axes: Vec<Axis>| Source::Grid(axes).ready(0, 2).unwrap_err();
        assert_eq!(refused(vec![Axis::full(2)]), SweepError::GridAxes { bars: 2, axes: 1 });
        assert!(matches!(
            refused(vec![Axis::full(2), Axis::full(0)]),
            SweepError::GridAxis { axis: 2, .. }
        ));
        assert_eq!(refused(vec![Axis::full(1 << 40); 2]), SweepError::GridSize);
    }
}
