//! Modes of small oscillations side by side: the structure at rest and displaced to both sides.

use model::Vector;
use model::system::System;

use crate::look::{Colour, Look};
use crate::palette::{BLUE, SKY_BLUE, VERMILION};
use crate::structure::StructureError;
use crate::structure::scene::bounds;
use crate::structure::view::{Seen, View};
use crate::svg::{Anchor, Svg};

/// Panels in a row.
const COLUMNS: usize = 3;
/// Size of a panel and of its picture, px.
const PANEL: [f64; 2] = [300.0, 290.0];
const PICTURE: [f64; 2] = [250.0, 210.0];
/// Room above the panels for the title, px.
const ABOVE: f64 = 76.0;
/// Largest displacement in units of the extent of the structure: seen, and still small.
const AMPLITUDE: f64 = 0.12;
/// Structures of more members are drawn without joints and with thinner lines.
const MANY: usize = 60;

/// One mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeShape<'a> {
    /// Its number and frequency, as the heading.
    pub heading: String,
    /// What it is, below the heading.
    pub what: &'a str,
    /// Displacement of each joint; the largest of length 1, or all zero.
    pub shape: &'a [Vector],
}

/// Modes of an equilibrium, in panels.
///
/// ```
/// use figures::{ModeShape, ModeShapes, Seen};
/// use model::system::{Joint, Member, System};
/// let cord = model::Bar::homogeneous(1.0, 1.0)?;
/// let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P")];
/// let system = System::new("a rod", 10.0, joints, vec![Member::bar(0, 1, cord)])?;
/// let swing = [[0.0; 3], [1.0, 0.0, 0.0]];
/// let mode = ModeShape { heading: "1: 0.6 Hz".into(), what: "oscillation", shape: &swing };
/// let joints_m = [[0.0; 3], [0.0, 0.0, -1.0]];
/// let modes = ModeShapes { system: &system, note: "", joints_m: &joints_m, modes: &[mode], seen: Seen::Best };
/// assert!(modes.svg()?.contains("0.6 Hz"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ModeShapes<'a> {
    /// The system.
    pub system: &'a System,
    /// A line under its name.
    pub note: &'a str,
    /// Places of its joints at rest, m.
    pub joints_m: &'a [Vector],
    /// The modes, each with as many displacements as there are joints.
    pub modes: &'a [ModeShape<'a>],
    /// From where all of them are seen.
    pub seen: Seen,
}

impl ModeShapes<'_> {
    /// The drawing as an SVG file.
    ///
    /// # Errors
    /// [`StructureError`] when there is nothing to draw or a place is not finite.
    pub fn svg(&self) -> Result<String, StructureError> {
        if self.system.members().is_empty() {
            return Err(StructureError::Empty);
        }
        let finite = |joint: &Vector| joint.iter().all(|x| x.is_finite());
        if let Some(joint) = self.joints_m.iter().position(|joint| !finite(joint)) {
            return Err(StructureError::NotFinite(joint));
        }
        let rows = self.modes.len().div_ceil(COLUMNS).max(1);
        let size = [PANEL[0] * COLUMNS as f64, ABOVE + PANEL[1] * rows as f64];
        let told = "Small oscillations: for each mode the structure at rest, dashed, and displaced to \
                    both sides; squares are joints that are held.";
        let mut svg = Svg::new(size, self.system.name()).described(told);
        let heading = Look::PLAIN.size(17.0).bold();
        svg.text(heading, [16.0, 30.0], Anchor::Start, self.system.name());
        svg.text(Look::PLAIN, [16.0, 51.0], Anchor::Start, self.note);
        for (k, mode) in self.modes.iter().enumerate() {
            let [column, row] = [k % COLUMNS, k / COLUMNS];
            let at = [PANEL[0] * column as f64, ABOVE + PANEL[1] * row as f64];
            self.panel(&mut svg, at, mode);
        }
        Ok(svg.finish())
    }

    fn panel(&self, svg: &mut Svg, [x, y]: [f64; 2], mode: &ModeShape<'_>) {
        svg.text(Look::PLAIN.bold(), [x + 16.0, y + 16.0], Anchor::Start, &mode.heading);
        let small = Look::fill(Colour::grey(0x44)).size(12.0);
        svg.text(small, [x + 16.0, y + 34.0], Anchor::Start, mode.what);
        let amplitude = AMPLITUDE * extent(self.joints_m);
        let moved = |by: f64| -> Vec<Vector> {
            let both = self.joints_m.iter().zip(mode.shape);
            both.map(|(at, shape)| std::array::from_fn(|k| at[k] + by * shape[k])).collect()
        };
        let positions = [self.joints_m.to_vec(), moved(-amplitude), moved(amplitude)];
        let all: Vec<Vector> = positions.iter().flatten().copied().collect();
        let view = View::from(self.seen, &all, &[]);
        let seen: Vec<[f64; 2]> = all.iter().map(|point| view.seen(*point)).collect();
        let [low, high] = bounds(&seen);
        let fits = [0, 1].map(|k| PICTURE[k] / (high[k] - low[k]));
        let scale = fits[0].min(fits[1]);
        let scale = if scale.is_finite() { scale } else { 0.0 };
        let middle = [x + 0.5 * PANEL[0], y + 48.0 + 0.5 * PICTURE[1]];
        let place = |point: &Vector| {
            let [right, up] = view.seen(*point);
            [
                middle[0] + scale * (right - 0.5 * (low[0] + high[0])),
                middle[1] - scale * (up - 0.5 * (low[1] + high[1])),
            ]
        };
        let thin = if self.system.members().len() > MANY { 0.5 } else { 1.0 };
        let looks = [
            Look::stroke(Colour::grey(0x99), 1.4 * thin).dashed("5 4"),
            Look::stroke(SKY_BLUE, 1.6 * thin),
            Look::stroke(BLUE, 3.0 * thin),
        ];
        for (joints, look) in positions.iter().zip(looks) {
            let ends = |joint: usize| place(&joints[joint]);
            let members = self.system.members().iter();
            let spans = members.flat_map(model::system::Member::spans);
            svg.lines(look, spans.map(|joints| joints.map(ends)));
        }
        for (joint, data) in self.system.joints().iter().enumerate() {
            let at = place(&positions[2][joint]);
            if data.support.is_fixed() {
                let corner = at.map(|x| x - 4.0);
                svg.rectangle(Look::fill(VERMILION), corner, [8.0; 2]);
            } else if self.system.members().len() <= MANY {
                svg.circle(Look::fill(BLUE), at, 3.5);
            }
        }
    }
}

/// The largest distance from the middle of the box around points, doubled, m.
fn extent(points: &[Vector]) -> f64 {
    let [low, high] = bounds(points);
    let [x, y, z] = [0, 1, 2].map(|k| high[k] - low[k]);
    x.hypot(y).hypot(z)
}
