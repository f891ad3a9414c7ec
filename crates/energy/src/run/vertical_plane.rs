use model::Vector;

use crate::run::regime::Turning;
use crate::run::scaled_chain::ScaledChain;
use crate::run::slope::Slope;
use crate::vector::{dot, unit};

/// A step by the angle `phi` along straight lines distorts the chain by `phi²`, against a gradient
/// of the distance of the verticals times `phi`: up to this part of the distance Newton's method
/// turns well.
const WITHIN_REACH: f64 = 0.1;

/// The direction of a horizontal pull this many times the mean gradient is known to a tenth of a
/// radian.
const CERTAIN: f64 = 10.0;

/// The turn about the vertical that takes an equilibrium into the first and third axis of the
/// frame.
///
/// Every equilibrium lies in a vertical plane: each bar is parallel to `h_i up + mu`. The plane is
/// that of the anchors, which is where the frame has its first and third axis, unless the anchors
/// lie on one vertical: then every plane through it will do, and only the shape knows which.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    up: Vector,
    /// Level axis of the frame in its plane.
    level: Vector,
    cosine: f64,
    sine: f64,
}

impl Turn {
    pub(crate) fn into_plane(links: &ScaledChain, u: &[Vector]) -> Self {
        let level = links.level();
        let flat = |u: Vector| dot(level, u).hypot(u[1]);
        let longer = |best: Vector, u: &Vector| if flat(*u) > flat(best) { *u } else { best };
        let flattest = if links.vertical { u.iter().fold(links.up, longer) } else { level };
        Self::heading(links, flattest)
    }

    /// The turn that takes a vector into the plane of the frame, its horizontal part along the
    /// level axis.
    pub(crate) fn heading(links: &ScaledChain, v: Vector) -> Self {
        let (up, level) = (links.up, links.level());
        let [cosine, sine, _] = unit([dot(level, v), v[1], 0.0]).unwrap_or([1.0, 0.0, 0.0]);
        Self { up, level, cosine, sine }
    }

    /// When the anchors lie almost on one vertical: the turn that takes the horizontal part of `mu`
    /// to where the end anchor lies, with the fall of the energy that comes with it.
    ///
    /// A turn `R` takes the last joint from `D` to `R D`, and closing the chain again costs
    /// `-R mu . (D - R D)`, `-mu` being the derivative of the energy by the place of the last
    /// joint.
    ///
    /// `None` if the plane of the chain is near enough for Newton's method, or if it is not known
    /// yet: the horizontal part of `mu` is uncertain by the gradient that is left. (It may be none
    /// at all: with a level bar that carries no force at its bottom a chain hangs straight down and
    /// up again.)
    pub(crate) fn towards_anchor(links: &ScaledChain, slope: &Slope) -> Option<(Self, f64)> {
        let (up, level, multiplier) = (links.up, links.level(), slope.multiplier);
        let offset = dot(level, links.span[0]);
        if Turning::of(links) != Turning::Soft {
            return None;
        }
        let pull = [dot(level, multiplier) * offset.signum(), multiplier[1] * offset.signum()];
        let size = pull[0].hypot(pull[1]);
        if size <= CERTAIN * slope.mean {
            return None;
        }
        let (cosine, sine) = (pull[0] / size, pull[1] / size);
        let far = cosine < 0.0 || sine.abs() > WITHIN_REACH * offset.abs();
        let fall = size * offset.abs() * (1.0 - cosine);
        far.then_some((Self { up, level, cosine, sine }, fall))
    }

    /// The directions after the turn.
    pub(crate) fn of(&self, u: &[Vector]) -> Vec<Vector> {
        u.iter().map(|&u| self.turned(u, self.sine)).collect()
    }

    fn turned(&self, v: Vector, sine: f64) -> Vector {
        let (h, n) = (dot(self.level, v), v[1]);
        let vertical = dot(self.up, v);
        let (h, n) = (self.cosine * h + sine * n, self.cosine * n - sine * h);
        [h * self.level[0] + vertical * self.up[0], n, h * self.level[2] + vertical * self.up[2]]
    }

    /// The directions in the plane, their rounded rest across it taken off.
    pub(crate) fn flattened(&self, u: &[Vector]) -> Vec<Vector> {
        u.iter()
            .map(|&u| {
                let [x, _, z] = self.turned(u, self.sine);
                unit([x, 0.0, z]).unwrap_or(u)
            })
            .collect()
    }

    /// From the plane back to where the equilibrium was.
    pub(crate) fn back(&self, v: Vector) -> Vector {
        self.turned(v, -self.sine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::settings::Motion;

    #[test]
    fn a_turned_chain_comes_into_the_plane_and_goes_back() {
        for up in [[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]] {
            let links = ScaledChain {
                length: vec![0.5, 0.5],
                carried: vec![0.25, -0.25],
                span: [up, [0.0; 3]],
                up,
                vertical: true,
                motion: Motion::Space,
            };
            let level = [up[2], 0.0, -up[0]];
            let (s, c) = 0.7_f64.sin_cos();
            // 0.6 up and 0.8 outwards, in a plane turned by 0.7 rad.
            let u: Vector =
                std::array::from_fn(|k| 0.6 * up[k] + 0.8 * (c * level[k] + s * f64::from(k == 1)));
            let turn = Turn::into_plane(&links, &[u]);
            let flat = turn.flattened(&[u])[0];
            assert!((dot(flat, up) - 0.6).abs() < 1e-15);
            assert!((dot(flat, level) - 0.8).abs() < 1e-15);
            let back = turn.back(flat);
            assert!((0..3).all(|k| (back[k] - u[k]).abs() < 1e-15));
        }
    }

    /// Anchors nearly on one vertical, and a pull that is heading elsewhere: the turn brings it over
    /// the end anchor, on either side, and promises what the energy loses by that.
    #[test]
    fn the_chain_turns_towards_its_anchor() {
        let problem = samples::equal_bars(4, 4.0, 1.0, [0.0, 1e-4, -1.0]);
        let (links, _) = ScaledChain::new(&problem, Motion::Space);
        assert_eq!(Turning::of(&links), Turning::Soft);
        let level = [links.up[2], 0.0, -links.up[0]];
        let offset = dot(level, links.span[0]);
        let along = |h: f64, n: f64| -> Vector {
            std::array::from_fn(|k| h * level[k] + 0.3 * links.up[k] + n * f64::from(k == 1))
        };
        let slope = |multiplier: Vector, mean: f64| Slope {
            multiplier,
            mean,
            ..Slope::refined(&links, &links.arc(), multiplier)
        };
        for side in [1.0, -1.0] {
            let links = ScaledChain {
                span: links.span.map(|s| [side * s[0], s[1], side * s[2]]),
                ..links.clone()
            };
            let offset = side * offset;
            for (h, n) in [(0.3, 0.4), (-0.3, 0.4), (-0.3, -0.4), (0.0, 0.5), (-0.5, 0.0)] {
                let multiplier = along(h * offset.signum(), n);
                let (turn, fall) = Turn::towards_anchor(&links, &slope(multiplier, 0.0)).unwrap();
                let turned = turn.of(&[multiplier])[0];
                assert!((dot(level, turned) * offset.signum() - 0.5).abs() < 1e-15, "{h} {n}");
                assert!(turned[1].abs() < 1e-15 && (dot(turned, links.up) - 0.3).abs() < 1e-15);
                let exact = (0.5 - h) * offset.abs();
                assert!((fall - exact).abs() < 1e-15 * (1.0 + exact), "{h} {n}");
            }
            // Over the anchor to a tenth of the offset already; and a pull that is not known.
            let near = along(0.5 * offset.signum(), 0.04 * offset.abs());
            assert!(Turn::towards_anchor(&links, &slope(near, 0.0)).is_none());
            let far = along(0.5 * offset.signum(), 0.06 * offset.abs());
            assert!(Turn::towards_anchor(&links, &slope(far, 0.0)).is_some());
            assert!(Turn::towards_anchor(&links, &slope(along(-0.3, 0.4), 0.051)).is_none());
            assert!(Turn::towards_anchor(&links, &slope(along(-0.3, 0.4), 0.049)).is_some());
        }
    }
}
