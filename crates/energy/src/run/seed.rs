//! Where a minimisation starts.

use model::{Problem, Vector};

use crate::error::Error;
use crate::run::frame::Frame;
use crate::run::scaled_chain::{ScaledChain, Units};
use crate::run::settings::Motion;
use crate::vector::{scaled, unit};

/// One direction per bar, from joint *i*-1 to joint *i*, in the world frame. Any length but zero;
/// the chain need not close.
///
/// ```
/// use energy::Seed;
/// let problem = model::cases::paper();
/// // Two bars straight down, the third up again.
/// let seed = Seed::directions(&problem, &[[0.0, 0.0, -2.0], [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]])?;
/// assert_eq!(seed.as_slice()[0], [0.0, 0.0, -1.0]);
/// # Ok::<(), energy::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Seed {
    directions: Vec<Vector>,
}

impl Seed {
    /// A seed of directions in space.
    ///
    /// # Errors
    ///
    /// [`Error::SeedSize`] for a wrong number of directions, [`Error::SeedDirection`] for one that
    /// is zero or not finite.
    pub fn directions(problem: &Problem, directions: &[Vector]) -> Result<Self, Error> {
        let bars = problem.chain().bars().len();
        if directions.len() != bars {
            return Err(Error::SeedSize { bars, given: directions.len() });
        }
        let directions = directions
            .iter()
            .enumerate()
            .map(|(k, &direction)| {
                unit(direction).ok_or(Error::SeedDirection { bar: k + 1, direction })
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { directions })
    }

    /// A seed in the vertical plane of the anchors: the angles of the bars from the descending
    /// vertical, as in the paper's example, positive towards the end anchor (towards +*Y* when the
    /// anchors lie on one vertical).
    ///
    /// # Errors
    ///
    /// [`Error::SeedSize`] for a wrong number of angles, [`Error::SeedAngle`] for one that is not
    /// finite.
    ///
    /// ```
    /// use energy::Seed;
    /// // The anchors lie on one vertical, so a level bar points along +Y.
    /// let seed = Seed::angles(&model::cases::paper(), &[std::f64::consts::FRAC_PI_2, 0.0, 0.0])?;
    /// let [x, y, z] = seed.as_slice()[0];
    /// assert!(x.abs() < 1e-15 && (y - 1.0).abs() < 1e-15 && z.abs() < 1e-15);
    /// assert_eq!(seed.as_slice()[1], [0.0, 0.0, -1.0]);
    /// # Ok::<(), energy::Error>(())
    /// ```
    pub fn angles(problem: &Problem, angles_rad: &[f64]) -> Result<Self, Error> {
        let chain = problem.chain();
        if let Some(&angle_rad) = angles_rad.iter().find(|a| !a.is_finite()) {
            return Err(Error::SeedAngle { angle_rad });
        }
        let across = Frame::horizontal(chain);
        let directions: Vec<Vector> = angles_rad
            .iter()
            .map(|angle| {
                let [x, y, _] = scaled(angle.sin(), across);
                [x, y, -angle.cos()]
            })
            .collect();
        Self::directions(problem, &directions)
    }

    /// The unit directions.
    pub fn as_slice(&self) -> &[Vector] {
        &self.directions
    }

    /// The directions in the frame of the chain; without their part across the plane when the
    /// motion is plane.
    pub(crate) fn in_frame(
        &self,
        links: &ScaledChain,
        units: &Units,
    ) -> Result<Vec<Vector>, Error> {
        if self.directions.len() != links.bars() {
            return Err(Error::SeedSize { bars: links.bars(), given: self.directions.len() });
        }
        self.directions
            .iter()
            .enumerate()
            .map(|(k, &direction)| {
                let mut v = units.frame.into_frame(direction);
                if links.motion == Motion::Plane {
                    v[1] = 0.0;
                }
                unit(v).ok_or(Error::SeedDirection { bar: k + 1, direction })
            })
            .collect()
    }
}
