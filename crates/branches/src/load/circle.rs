//! Paths through a branch point in which two modes meet.
//!
//! With $\phi(a) = \cos a\\, \phi_1 + \sin a\\, \phi_2$ the point at the distance $\delta$ in this direction is held
//! there by a force $\mu$ across it:
//!
//! $$ G(y', t') + \mu \phi'(a) = 0, \qquad \phi(a) \cdot (y' - y) = \delta, \qquad \phi'(a) \cdot (y' - y) = 0 . $$
//!
//! Paths leave where $\mu(a) = 0$. Under symmetry of order $n$ it is of the order of $\delta^{n - 1}$, so that nearly all of the
//! circle seems to be in equilibrium, and no corrector gets to the path from beside it.

use std::f64::consts::TAU;

use nalgebra::DVector;

use super::Equations;
use super::bordered::{Bordered, Row};
use super::here::{GIVEN, Here, ITERATIONS, Space};
use crate::locate::sign_change;

/// Points of the circle: paths of two modes that meet by a symmetry of order up to eight are more than two apart.
const POINTS: usize = 40;
/// A step of less than this part of the radius is the last: they fall with the square.
const LAST: f64 = 1e-7;
/// Angles are found to this part of the distance of two points.
const NARROW: f64 = 1e-12;

/// A point held at an angle.
#[derive(Debug, Clone)]
struct Held {
    y: DVector<f64>,
    t: f64,
    angle: f64,
    force: f64,
}

impl<Q: Equations> Space<'_, Q> {
    /// First points of all paths that leave a point in the plane of two modes, outward, at a distance.
    pub(super) fn around(
        &mut self,
        at: &Here,
        modes: [&DVector<f64>; 2],
        radius: f64,
    ) -> Vec<Here> {
        let angle = |k: usize| TAU * k as f64 / POINTS as f64;
        let held = (0..POINTS).filter_map(|k| self.held(at, modes, radius, angle(k)));
        // A force that rounding hides has no sign.
        let held: Vec<_> = held.filter(|held| held.force.abs() > GIVEN).collect();
        let Some(first) = held.first().cloned() else { return vec![] };
        let round = Held { angle: first.angle + TAU, ..first };
        let after = held[1..].iter().chain([&round]);
        let mut found = vec![];
        for (a, b) in held.iter().zip(after) {
            let at_part = |part: f64| a.angle + part * (b.angle - a.angle);
            let part = |part| self.held(at, modes, radius, at_part(part));
            let Some((_, held)) = sign_change([a, b], NARROW, part, |held| Some(held.force)) else {
                continue;
            };
            let row = self.metric.along(&Row { y: turned(modes, held.angle), t: 0.0 });
            let here = self.here((held.y, held.t), [&row, &row]).ok().flatten();
            found.extend(here.filter(|here| self.is_exact(here).unwrap_or(false)));
        }
        found
    }

    fn held(
        &mut self,
        at: &Here,
        modes: [&DVector<f64>; 2],
        radius: f64,
        angle: f64,
    ) -> Option<Held> {
        let [along, across] = [angle, angle + TAU / 4.0].map(|angle| turned(modes, angle));
        let (mut y, mut t, mut force) = (&at.y + &along * radius, at.t, 0.0);
        let push = across.normalize();
        let [along, across] = [along, across].map(|y| self.metric.along(&Row { y, t: 0.0 }));
        for _ in 0..ITERATIONS {
            let (left, _) = self.equations.residual(&y, t).ok()?;
            let column = self.equations.by_parameter(&y, t).ok()?;
            self.equations.factorise(&y, t).ok()??;
            let bordered = Bordered::new(self.equations, &column, &along);
            let off = [&along, &across].map(|row| row.y.dot(&(&y - &at.y)));
            let left = -(left + &push * force);
            let (free, free_t) = bordered.solve(self.equations, (&left, radius - off[0]))?;
            // Nearly singular, and so large along the circle; the difference of both is not.
            let (soft, soft_t) = bordered.solve(self.equations, (&push, 0.0))?;
            let more = (across.y.dot(&free) + off[1]) / across.y.dot(&soft);
            let (dy, dt) = (free - soft * more, free_t - soft_t * more);
            let step = self.metric.norm(&dy, 0.0);
            (y, t, force) = (y + dy, t + dt, force + more);
            if step < LAST * radius {
                return Some(Held { y, t, angle, force });
            }
            if step.is_nan() || step > radius {
                break;
            }
        }
        None
    }
}

fn turned(modes: [&DVector<f64>; 2], angle: f64) -> DVector<f64> {
    modes[0] * angle.cos() + modes[1] * angle.sin()
}
