//! Any signs, any plane: the condensed equations in space.
//!
//! Whatever the signs, an equilibrium is a root of three equations in the pull on the first anchor.
//! These are for those who want other equilibria than the hanging one, and bring the signs and a
//! pull to start from.

use model::Vector;
use nalgebra::{Matrix3, Vector3};

use super::chain::Condensed;
use super::error::CondensedError;
use super::pull::{Pull, Signs};
use super::settings::Settings;
use super::sums::{BLOCK, Twofold};

/// The closure of a chain for some pull and signs; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// Where the last joint is, seen from its anchor, m.
    pub miss_m: Vector3<f64>,
    /// Its derivative by the pull, symmetric, m/N.
    pub derivative_m_n: Matrix3<f64>,
}

/// Part of the residual's own size that is added to the normal equations as damping.
const DAMPING: f64 = 1e-2;
/// Growth of the damping after a step that led away, and its decrease after a good one.
const GROWTH: f64 = 8.0;
/// Damping beyond which a step is too short to change anything.
const TOO_STIFF: f64 = 1e30;

impl Condensed {
    /// By how much the chain misses its last anchor when the chain pulls the first one with
    /// `pull_n` (the opposite of λ₁..₃) and the bars marked `compressed` are so; one pass, O(n).
    ///
    /// $$ r(p) = \sum s_i\\,l_i\\,F_i/|F_i| - D, \qquad
    ///    \frac{\partial r}{\partial p} = \sum \frac{s_i l_i}{|F_i|} (1 - u_i u_i^T). $$
    ///
    /// # Errors
    ///
    /// [`CondensedError::SignsLength`], [`CondensedError::PullNotFinite`].
    pub fn miss(&self, pull_n: Vector, compressed: &[bool]) -> Result<Miss, CondensedError> {
        let q = self.bottom_force(pull_n, compressed)?;
        let (miss, derivative) = self.miss_at(q, compressed);
        let Self { units, .. } = self;
        Ok(Miss {
            miss_m: miss * units.length,
            derivative_m_n: derivative * (units.length / units.force()),
        })
    }

    /// The equilibrium with the given signs to which Newton's method leads from `pull_n`, in space.
    ///
    /// Levenberg's damping makes every step reduce the miss and copes with the singular derivative
    /// at vertical anchors, where every turn of an equilibrium is one.
    ///
    /// # Errors
    ///
    /// [`CondensedError::NotClosed`] when the iteration ends at a local minimum of the miss, or at
    /// rounding errors larger than the settings allow; those of [`Self::miss`].
    pub fn pull_from(
        &self,
        pull_n: Vector,
        compressed: &[bool],
        settings: &Settings,
    ) -> Result<Pull, CondensedError> {
        settings.validate()?;
        let mut q = self.bottom_force(pull_n, compressed)?;
        let (mut miss, mut derivative) = self.miss_at(q, compressed);
        let mut damping = DAMPING;
        let mut passes = 1;
        let enough = f64::EPSILON * self.read.total_length;
        while miss.norm() > enough && passes < settings.max_passes {
            let relative = damping * miss.norm() / self.read.total_length;
            let scale = derivative.norm();
            let normal = derivative * derivative + Matrix3::identity() * (relative * scale * scale);
            let step = normal.cholesky().map(|factors| factors.solve(&(derivative * miss)));
            let Some(step) = step.filter(|step| step.iter().all(|x| x.is_finite())) else { break };
            let trial = q - step;
            let (there, its) = self.miss_at(trial, compressed);
            passes += 1;
            if there.norm() < miss.norm() {
                (q, miss, derivative) = (trial, there, its);
                damping /= GROWTH;
            } else {
                damping = damping.max(f64::MIN_POSITIVE) * GROWTH;
                if damping > TOO_STIFF || (trial - q).norm() <= f64::EPSILON * q.norm() {
                    break;
                }
            }
        }
        let closure = miss.norm() / self.read.total_length;
        if closure.is_nan() || closure > settings.closure {
            return Err(CondensedError::NotClosed { closure, passes });
        }
        Ok(self.pull_of(q, compressed, passes))
    }

    /// Force in the bottom bar, in units of the chain.
    fn bottom_force(
        &self,
        pull_n: Vector,
        compressed: &[bool],
    ) -> Result<Vector3<f64>, CondensedError> {
        if compressed.len() != self.bars() {
            let (expected, got) = (self.bars(), compressed.len());
            return Err(CondensedError::SignsLength { expected, got });
        }
        if let Some(&component_n) = pull_n.iter().find(|component| !component.is_finite()) {
            return Err(CondensedError::PullNotFinite { component_n });
        }
        let before = self.read.at_start - self.read.loads[0];
        let p = Vector3::from(pull_n) / self.units.force();
        Ok(Vector3::new(p.x, p.y, p.z + before))
    }

    fn miss_at(&self, q: Vector3<f64>, compressed: &[bool]) -> (Vector3<f64>, Matrix3<f64>) {
        let mut sum = [Twofold::default(); 3];
        let mut derivative = Matrix3::zeros();
        let arrays = self.read.lengths.chunks(BLOCK).zip(self.read.loads.chunks(BLOCK));
        for ((lengths, loads), compressed) in arrays.zip(compressed.chunks(BLOCK)) {
            let mut here = Vector3::zeros();
            for ((length, load), compressed) in lengths.iter().zip(loads).zip(compressed) {
                let force = Vector3::new(q.x, q.y, q.z + load);
                let size = force.norm();
                let u = force / size;
                let length = if *compressed { -length } else { *length };
                here += u * length;
                derivative += (Matrix3::identity() - u * u.transpose()) * (length / size);
            }
            for k in 0..3 {
                sum[k] = sum[k].plus(here[k]);
            }
        }
        let end = self.span.level.map(|e| e * self.span.across);
        let end = Vector3::new(end[0], end[1], self.span.rise);
        (Vector3::from(sum.map(Twofold::value)) - end, derivative)
    }

    fn pull_of(&self, q: Vector3<f64>, compressed: &[bool], passes: usize) -> Pull {
        let horizontal = q.x.hypot(q.y);
        // The plane of the anchors, if they have one, with the horizontal pull of either sign in it;
        // else the plane of the pull, turned so that the pull is positive.
        let along = self.span.level[0] * q.x + self.span.level[1] * q.y;
        let (level, h) = if self.on_one_vertical() && horizontal > 0.0 {
            ([q.x / horizontal, q.y / horizontal], horizontal)
        } else {
            (self.span.level, along)
        };
        let out = Vector3::new(level[0], level[1], 0.0);
        let in_plane = Vector3::new(h * level[0], h * level[1], q.z);
        let (_, derivative) = self.miss_at(in_plane, compressed);
        let jacobian = [
            (out.transpose() * derivative * out).x,
            (out.transpose() * derivative).z,
            derivative[(2, 2)],
        ];
        Pull::new(self, level, [h, q.z], Signs::Listed(compressed.to_vec()), jacobian, passes)
    }
}
