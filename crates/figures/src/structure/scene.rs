//! Where things stand in the picture.

use crate::structure::Structure;
use crate::structure::members::NOTHING;
use crate::structure::view::View;

/// Room at the sides, px: for arrows and their labels.
pub(crate) const SIDE: f64 = 96.0;
/// Room above, for the title too, and below, for the key too.
const ABOVE: f64 = 172.0;
const BELOW: f64 = 176.0;

/// Largest extent of the structure, px.
const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 620.0;

/// Least width, px: the key must fit.
const LEAST_WIDTH: f64 = 620.0;

/// Length of the arrow of the largest force, px.
pub(crate) const LONGEST_ARROW: f64 = 70.0;

/// Members of at least this length in the middle are drawn with all marks.
const ROOMY: f64 = 24.0;

/// The structure projected.
pub(crate) struct Scene {
    pub(crate) size: [f64; 2],
    pub(crate) view: View,
    /// Pixels per metre.
    pub(crate) scale: f64,
    /// Pixels per newton.
    pub(crate) force_scale: f64,
    /// The joints, px.
    pub(crate) joints: Vec<[f64; 2]>,
    /// The corners of the floor under them, px; none where there is no floor.
    pub(crate) floor: Vec<[f64; 2]>,
    /// How much smaller marks and lines are than in a roomy drawing, from 0 to 1.
    pub(crate) detail: f64,
}

impl Scene {
    pub(crate) fn new(structure: &Structure<'_>) -> Self {
        let points: Vec<[f64; 3]> = structure.joints.iter().map(|joint| joint.at_m).collect();
        let axial = structure.members.iter().filter_map(|member| member.axial_n);
        // What a solver leaves of a force that is zero is not drawn.
        let nothing = NOTHING * axial.map(f64::abs).fold(0.0, f64::max);
        let forces = structure.joints.iter().flat_map(|joint| [joint.load_n, joint.reaction_n]);
        let forces: Vec<[f64; 3]> =
            forces.filter(|[x, y, z]| x.hypot(*y).hypot(*z) > nothing).collect();
        let view = View::from(structure.seen, &points, &forces);
        let floor = structure.floor_m.map_or_else(Vec::new, |height| corners(&points, height));
        let seen: Vec<[f64; 2]> =
            points.iter().chain(&floor).map(|point| view.seen(*point)).collect();
        let [low, high] = bounds(&seen);
        let [width, height] = [high[0] - low[0], high[1] - low[1]];
        let fits = (WIDTH / width).min(HEIGHT / height);
        // Joints all in one place have no scale.
        let scale = if fits.is_finite() { fits } else { 0.0 };
        let size = [
            (width * scale + 2.0 * SIDE).max(LEAST_WIDTH).max(heading(structure)).round(),
            (height * scale + ABOVE + BELOW).round(),
        ];
        let left = 0.5 * (size[0] - width * scale);
        let place = |[x, y]: [f64; 2]| [left + scale * (x - low[0]), ABOVE + scale * (high[1] - y)];
        let mut joints: Vec<[f64; 2]> = seen.into_iter().map(place).collect();
        let floor = joints.split_off(points.len());
        let largest = forces.iter().map(|force| length(view.seen(*force))).fold(0.0, f64::max);
        let force_scale = if largest > 0.0 { LONGEST_ARROW / largest } else { 0.0 };
        let detail = (median_length(structure, &joints) / ROOMY).min(1.0);
        Self { size, view, scale, force_scale, joints, floor, detail }
    }

    /// The same with more room to the left and to the right, px.
    pub(crate) fn widened(mut self, [left, right]: [f64; 2]) -> Self {
        self.size[0] = (self.size[0] + left + right).round();
        for point in self.joints.iter_mut().chain(&mut self.floor) {
            point[0] += left;
        }
        self
    }

    /// The ends of a member, px.
    pub(crate) fn ends(&self, joints: [usize; 2]) -> [[f64; 2]; 2] {
        joints.map(|joint| self.joints[joint])
    }

    /// A force as an arrow, px.
    pub(crate) fn arrow(&self, force_n: [f64; 3]) -> [f64; 2] {
        let [x, y] = self.view.seen(force_n);
        [self.force_scale * x, -self.force_scale * y]
    }

    /// The unit direction of a vector, px; none if it is seen end on.
    pub(crate) fn direction(&self, vector: [f64; 3]) -> Option<[f64; 2]> {
        let [x, y] = self.view.seen(vector);
        let size = length([x, y]);
        (size > 1e-3).then(|| [x / size, -y / size])
    }
}

/// The least and the largest of each coordinate; 0 without points.
pub(super) fn bounds<const N: usize>(points: &[[f64; N]]) -> [[f64; N]; 2] {
    let bound = |k: usize, best: fn(f64, f64) -> f64| {
        points.iter().map(|point| point[k]).reduce(best).unwrap_or_default()
    };
    [f64::min, f64::max].map(|best| std::array::from_fn(|k| bound(k, best)))
}

/// The corners of a level rectangle under all points, m.
fn corners(points: &[[f64; 3]], height: f64) -> Vec<[f64; 3]> {
    let [[west, south, _], [east, north, _]] = bounds(points);
    let at = |[x, y]: [f64; 2]| [x, y, height];
    [[west, south], [east, south], [east, north], [west, north]].map(at).to_vec()
}

/// Width that the lines above the drawing need, px.
fn heading(structure: &Structure<'_>) -> f64 {
    /// Mean width of a letter of the title and of the note, px.
    const LETTERS: [f64; 2] = [9.6, 7.3];
    let letters = [structure.title, structure.note].map(|text| text.chars().count() as f64);
    // A title of any length is cut off at the width of the widest structure.
    let widest = WIDTH + 2.0 * SIDE;
    (SIDE + f64::max(LETTERS[0] * letters[0], LETTERS[1] * letters[1]) + 0.2 * SIDE).min(widest)
}

pub(crate) fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// Length of the member in the middle, px.
fn median_length(structure: &Structure<'_>, joints: &[[f64; 2]]) -> f64 {
    let length = |[a, b]: [usize; 2]| length([0, 1].map(|k| joints[a][k] - joints[b][k]));
    let mut lengths: Vec<f64> =
        structure.members.iter().map(|member| length(member.joints)).collect();
    let middle = lengths.len() / 2;
    *lengths.select_nth_unstable_by(middle, f64::total_cmp).1
}
