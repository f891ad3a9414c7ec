//! Many seeds through the lanes.
#![expect(
    clippy::inline_always,
    reason = "a pass over the bars is fast only as one loop of vector instructions"
)]

use model::{Ends, Finish, Problem};

use super::control::{Lane, Next};
use super::piece::{Piece, Pieces, direction};
use super::point::{Moves, Place, measure, slopes, turn};
use super::wide::{WIDTH, same, wide};
use crate::error::Error;

/// What can be chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BatchSettings {
    /// Largest projected slope of a minimum: each bar's, in units of the largest of the closing
    /// force and the total weight, times the mean length. Default 1e-12, from 1e-14 to 1e-3.
    pub tolerance: f64,
    /// Largest gap of a closed chain, in total lengths. Default 1e-14, from 1e-15 to 1e-6.
    pub closure: f64,
    /// Trials (each one pass over the bars: a correction of the closure, or a step) after which a
    /// seed is given up. Default 2000, from 1 to 60,000.
    pub max_iterations: u32,
}

impl Default for BatchSettings {
    fn default() -> Self {
        Self { tolerance: 1e-12, closure: 1e-14, max_iterations: 2000 }
    }
}

impl BatchSettings {
    /// Check every range.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for the first field out of range.
    pub fn validate(&self) -> Result<(), Error> {
        let steps = f64::from(self.max_iterations);
        for (field, value, low, high) in [
            ("tolerance", self.tolerance, 1e-14, 1e-3),
            ("closure", self.closure, 1e-15, 1e-6),
            ("max_iterations", steps, 1.0, 60_000.0),
        ] {
            Error::unless_within(field, value, low, high)?;
        }
        Ok(())
    }
}

/// A minimiser of one problem for many seeds in its vertical plane: that of the anchors, or any if
/// they are on one vertical.
///
/// ```
/// use energy::batch::{Batch, BatchSettings};
/// use model::{Ends, Finish};
/// let batch = Batch::new(&model::cases::paper(), BatchSettings::default())?;
/// let mut ends = Ends::default();
/// batch.minimise(&[0.3, 0.7, -1.3, 2.8, 2.4, 4.0], &mut ends);
/// assert_eq!(ends.finish, [Finish::Converged; 2]);
/// // In the plane the only minima are E1 and its mirror image, V = 2.335468651999305 mgl.
/// for v in ends.energy_j {
///     assert!((v / 9.80665 + 6.0 - 2.335_468_651_999_305).abs() < 1e-13);
/// }
/// # Ok::<(), energy::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Batch {
    pieces: Pieces,
    settings: BatchSettings,
}

impl Batch {
    /// Prepare a problem.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] when a setting is out of range.
    pub fn new(problem: &Problem, settings: BatchSettings) -> Result<Self, Error> {
        settings.validate()?;
        Ok(Self { pieces: Pieces::of(problem), settings })
    }

    /// Minimise from all seeds: `angles` holds n angles from the descending vertical towards the
    /// last anchor, rad, for each of them. What was in `ends` is replaced, its memory used again.
    ///
    /// Converged is at a verified minimum in the plane; stalled, where no step lowers the energy or
    /// the chain cannot be closed. The residual is the largest projected slope, in the units of
    /// [`BatchSettings::tolerance`]; iterations are passes over the bars.
    ///
    /// # Panics
    ///
    /// When `angles` does not hold a multiple of n numbers.
    pub fn minimise(&self, angles: &[f64], ends: &mut Ends) {
        let bars = self.pieces.list.len();
        assert!(angles.len().is_multiple_of(bars), "{bars} angles for every seed");
        ends.resize(angles.len() / bars, bars);
        match bars {
            2 => self.fixed::<2>(angles, ends),
            3 => self.fixed::<3>(angles, ends),
            4 => self.fixed::<4>(angles, ends),
            5 => self.fixed::<5>(angles, ends),
            6 => self.fixed::<6>(angles, ends),
            _ => self.run(&self.pieces.list, &mut vec![Place::ZERO; bars], angles, ends),
        }
    }

    /// With a number of bars that the compiler knows.
    #[inline(never)]
    fn fixed<const N: usize>(&self, angles: &[f64], ends: &mut Ends) {
        let mut pieces = [Piece::default(); N];
        pieces.copy_from_slice(&self.pieces.list);
        pulp::Arch::new().dispatch(Vectors { batch: self, pieces, angles, ends });
    }

    #[inline(always)]
    fn run(&self, pieces: &[Piece], places: &mut [Place], angles: &[f64], ends: &mut Ends) {
        let seeds = angles.len() / pieces.len();
        let mut fresh = 0..seeds;
        let mut lanes = [Lane::new(usize::MAX); WIDTH];
        for (k, lane) in lanes.iter_mut().enumerate() {
            refill(lane, k, places, angles, &mut fresh);
        }
        while lanes.iter().any(|lane| lane.seed != usize::MAX) {
            let sums = measure(pieces, self.pieces.span, places);
            let mut next = [Next::Stalled; WIDTH];
            for (k, (next, lane)) in next.iter_mut().zip(&mut lanes).enumerate() {
                let gap = [sums.gap[0][k], sums.gap[1][k]];
                let spread = [sums.spread[0][k], sums.spread[1][k], sums.spread[2][k]];
                *next = lane.measured(&self.settings, gap, spread, sums.value[k]);
            }
            let accepted = wide(|k| next[k] == Next::Accept);
            if accepted.contains(&true) {
                let slopes = slopes(pieces, &sums, &accepted, places);
                for k in (0..WIDTH).filter(|k| accepted[*k]) {
                    next[k] = lanes[k].accepted(
                        &self.settings, slopes.largest[k], slopes.convex[k],
                        slopes.largest_turn[k], slopes.fall[k],
                    );
                }
            }
            let mut moves = Moves {
                from_base: [false; WIDTH],
                part: same(0.0),
                pull: [same(0.0); 2],
                perturbation: same(0.0),
            };
            let mut ended = [None; WIDTH];
            for k in 0..WIDTH {
                match next[k] {
                    Next::Correct(pull) => {
                        (moves.pull[0][k], moves.pull[1][k]) = (pull[0], pull[1]);
                    }
                    Next::Step(part) => (moves.from_base[k], moves.part[k]) = (true, part),
                    Next::Perturb(size) => moves.perturbation[k] = size,
                    Next::Minimum => ended[k] = Some(Finish::Converged),
                    Next::IterationLimit => ended[k] = Some(Finish::IterationLimit),
                    Next::NonFinite => ended[k] = Some(Finish::NonFinite),
                    Next::Stalled | Next::Accept => ended[k] = Some(Finish::Stalled),
                }
                if let Some(finish) = ended[k]
                    && lanes[k].seed != usize::MAX
                {
                    self.store(places, &lanes[k], k, finish, ends);
                }
            }
            turn(places, &moves);
            for k in 0..WIDTH {
                if ended[k].is_some() {
                    refill(&mut lanes[k], k, places, angles, &mut fresh);
                }
            }
        }
    }

    /// Write down where a lane is.
    fn store(&self, places: &[Place], lane: &Lane, k: usize, finish: Finish, ends: &mut Ends) {
        let (bars, seed) = (places.len(), lane.seed);
        let directions = &mut ends.directions[seed * bars..(seed + 1) * bars];
        let mut value = 0.0;
        for ((u, place), piece) in directions.iter_mut().zip(places).zip(&self.pieces.list) {
            *u = [place.x[k], place.z[k]];
            value += piece.length * piece.lifted * place.z[k];
        }
        ends.finish[seed] = finish;
        ends.iterations[seed] = u16::try_from(lane.trials).unwrap_or(u16::MAX);
        ends.residual[seed] = lane.slope;
        ends.energy_j[seed] = value * self.pieces.unit_j;
    }
}

/// A minimisation to be compiled once for each kind of vector register; none of them changes a bit.
struct Vectors<'a, const N: usize> {
    batch: &'a Batch,
    pieces: [Piece; N],
    angles: &'a [f64],
    ends: &'a mut Ends,
}

impl<const N: usize> pulp::NullaryFnOnce for Vectors<'_, N> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.batch.run(&self.pieces, &mut [Place::ZERO; N], self.angles, self.ends);
    }
}

/// Put the next seed into a lane.
fn refill(
    lane: &mut Lane,
    k: usize,
    places: &mut [Place],
    angles: &[f64],
    fresh: &mut std::ops::Range<usize>,
) {
    *lane = Lane::new(fresh.next().unwrap_or(usize::MAX));
    if lane.seed == usize::MAX {
        return;
    }
    let bars = places.len();
    for (place, angle) in places.iter_mut().zip(&angles[lane.seed * bars..]) {
        [place.x[k], place.z[k]] = direction(*angle);
    }
}
