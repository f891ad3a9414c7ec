//! From where a structure is seen.

/// A parallel projection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct View {
    /// Unit vectors of the picture in the world frame.
    pub(crate) right: [f64; 3],
    pub(crate) up: [f64; 3],
    /// Whether the structure or its forces leave every plane.
    pub(crate) spatial: bool,
}

/// From where a structure is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Seen {
    /// A planar one at right angles to its plane, a spatial one from above and from that side on
    /// which it spreads most.
    #[default]
    Best,
    /// Along +Y: X to the right, Z up.
    Front,
    /// Along −X: Y to the right, Z up.
    Side,
    /// Along −Z: X to the right, Y up.
    Top,
}

/// What leaves a plane by less than this part of the whole lies in it: the residual of a solver is
/// a thousandth of that.
const FLAT: f64 = 1e-6;

/// From where a spatial structure is seen: to the right of −Y, or from another of these sides if it
/// is wider there by [`WIDER`]; and from above, deg.
const AZIMUTHS: [f64; 4] = [30.0, -30.0, -60.0, 60.0];
const ELEVATION: f64 = 24.0;
const WIDER: f64 = 1.1;

impl View {
    /// The view that is asked for of points and forces.
    pub(crate) fn from(seen: Seen, points: &[[f64; 3]], forces: &[[f64; 3]]) -> Self {
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let [right, up] = match seen {
            Seen::Best => return Self::of(points, forces),
            Seen::Front => [x, z],
            Seen::Side => [y, z],
            Seen::Top => [x, y],
        };
        Self { right, up, spatial: true }
    }

    /// The view of points and forces: at right angles to the plane of both, if there is one.
    pub(crate) fn of(points: &[[f64; 3]], forces: &[[f64; 3]]) -> Self {
        let origin = points.first().copied().unwrap_or_default();
        let mut offsets: Vec<[f64; 3]> = points.iter().map(|point| minus(*point, origin)).collect();
        let mut forces = forces.to_vec();
        unify(&mut offsets);
        unify(&mut forces);
        offsets.extend(forces);
        match normal(&offsets) {
            Some(normal) => Self::along(normal),
            None => Self::from_above(points),
        }
    }

    /// At right angles to a plane: its steepest direction is up, and in a level plane Y.
    fn along(normal: [f64; 3]) -> Self {
        let steepest = reject([0.0, 0.0, 1.0], normal);
        let up = unit(steepest)
            .or_else(|| unit(reject([0.0, 1.0, 0.0], normal)))
            .unwrap_or([0.0, 0.0, 1.0]);
        let right = cross(up, normal);
        let largest =
            right.into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let right = if largest < 0.0 { right.map(|x| -x) } else { right };
        Self { right, up, spatial: false }
    }

    fn from_above(points: &[[f64; 3]]) -> Self {
        let width = |azimuth: f64| {
            let (sin, cos) = azimuth.to_radians().sin_cos();
            let across = || points.iter().map(|[x, y, _]| x * cos + y * sin);
            across().fold(f64::NEG_INFINITY, f64::max) - across().fold(f64::INFINITY, f64::min)
        };
        let [first, others @ ..] = AZIMUTHS;
        let wider = |best: f64, other: f64| {
            if width(other) > WIDER * width(best) { other } else { best }
        };
        let azimuth = others.into_iter().fold(first, wider);
        let (azimuth_sin, azimuth_cos) = azimuth.to_radians().sin_cos();
        let (elevation_sin, elevation_cos) = ELEVATION.to_radians().sin_cos();
        let right = [azimuth_cos, azimuth_sin, 0.0];
        let eye = [azimuth_sin * elevation_cos, -azimuth_cos * elevation_cos, elevation_sin];
        Self { right, up: cross(eye, right), spatial: true }
    }

    /// A vector in the picture: to the right, up.
    pub(crate) fn seen(&self, vector: [f64; 3]) -> [f64; 2] {
        [dot(self.right, vector), dot(self.up, vector)]
    }
}

/// The normal of the plane through the origin that holds all vectors, if there is one; of several
/// (all on one line) a level one.
fn normal(vectors: &[[f64; 3]]) -> Option<[f64; 3]> {
    let longest = vectors.iter().copied().max_by(|a, b| size(*a).total_cmp(&size(*b)))?;
    let along = unit(longest).unwrap_or([0.0, 0.0, 1.0]);
    let aside = vectors
        .iter()
        .map(|vector| reject(*vector, along))
        .max_by(|a, b| size(*a).total_cmp(&size(*b)))?;
    let normal = if size(aside) > FLAT {
        unit(cross(along, aside))?
    } else {
        // The paper's plane is OYZ: its normal is X.
        unit(cross(along, [0.0, 0.0, 1.0])).unwrap_or([1.0, 0.0, 0.0])
    };
    vectors.iter().all(|vector| dot(*vector, normal).abs() <= FLAT).then_some(normal)
}

/// Vectors in units of the longest.
fn unify(vectors: &mut [[f64; 3]]) {
    let largest = vectors.iter().fold(0.0, |largest: f64, vector| largest.max(size(*vector)));
    if largest > 0.0 {
        for vector in vectors {
            *vector = vector.map(|x| x / largest);
        }
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn size(a: [f64; 3]) -> f64 {
    a[0].hypot(a[1]).hypot(a[2])
}

/// What of a vector is at right angles to a unit vector.
fn reject(a: [f64; 3], along: [f64; 3]) -> [f64; 3] {
    let part = dot(a, along);
    minus(a, along.map(|x| part * x))
}

fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let size = size(a);
    (size > FLAT).then(|| a.map(|x| x / size))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: [f64; 3], b: [f64; 3]) -> bool {
        size(minus(a, b)) < 1e-12
    }

    #[test]
    fn planes_are_seen_at_right_angles() {
        let weight = [[0.0, 0.0, -1.0]];
        // An upright plane through X and Y, a level one, and one line upright.
        let upright = View::of(&[[0.0; 3], [3.0, 4.0, 0.0], [0.0, 0.0, -1.0]], &weight);
        assert!(close(upright.right, [0.6, 0.8, 0.0]) && close(upright.up, [0.0, 0.0, 1.0]));
        let level = View::of(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[]);
        assert!(close(level.right, [1.0, 0.0, 0.0]) && close(level.up, [0.0, 1.0, 0.0]));
        let line = View::of(&[[0.0; 3], [0.0, 0.0, -2.0]], &weight);
        assert!(close(line.right, [0.0, 1.0, 0.0]) && !line.spatial);
        assert!(!upright.spatial && !level.spatial);
    }

    #[test]
    fn a_long_structure_is_seen_from_its_long_side() {
        let long = |axis: usize| {
            let mut points = vec![[0.0; 3], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
            points.push([0.0; 3]);
            points[4][axis] = 10.0;
            View::of(&points, &[])
        };
        for axis in 0..2 {
            let mut along = [0.0; 3];
            along[axis] = 1.0;
            assert!(long(axis).seen(along)[0].abs() > 0.8, "{axis}");
        }
        // Its up and right stay what they are called.
        assert!(long(1).seen([0.0, 0.0, 1.0])[1] > 0.8);
        assert!(close(View::from(Seen::Top, &[], &[]).up, [0.0, 1.0, 0.0]));
    }

    #[test]
    fn what_leaves_the_plane_is_seen_from_above() {
        let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1e-3, 0.0]];
        let view = View::of(&points, &[]);
        assert!(view.spatial && view.seen([0.0, 0.0, 1.0])[1] > 0.8);
        assert!(dot(view.right, view.up).abs() < 1e-12 && (size(view.up) - 1.0).abs() < 1e-12);
        // So does a force across it.
        assert!(View::of(&points[..3], &[[0.0, 2.0, 0.0]]).spatial);
        assert!(!View::of(&points[..3], &[[0.0, 0.0, 2.0]]).spatial);
    }
}
