//! The drawing of a structure: joints, members with their axial forces, supports, loads and
//! reactions, to scale.
//!
//! A planar structure is seen at right angles to its plane, with the vertical up; a spatial one
//! from above and one side, in parallel projection. Tension and compression differ in form (solid,
//! hollow) or, where members are too short for that, in lightness: so they do in grey.

mod forces;
mod key;
mod labels;
mod members;
mod scene;
mod shapes;
mod supports;
mod system;
mod view;

pub use shapes::{ModeShape, ModeShapes};
pub use system::SystemShape;
pub use view::Seen;

use crate::look::{Colour, Look};
use crate::structure::labels::Labels;
use crate::structure::scene::Scene;
use crate::svg::{Anchor, Svg};

/// What holds a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Support {
    /// It cannot move.
    Fixed,
    /// It slides along this direction, world frame.
    Line([f64; 3]),
    /// It slides in the plane with this normal, world frame.
    Plane([f64; 3]),
}

/// A joint of a [`Structure`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint<'a> {
    /// Its name; empty for none.
    pub name: &'a str,
    /// Where it is, m, world frame with Z up.
    pub at_m: [f64; 3],
    /// What holds it.
    pub support: Option<Support>,
    /// The load at it, N, world frame; zeros for none.
    pub load_n: [f64; 3],
    /// The force of its support on it, N, world frame; zeros for none.
    pub reaction_n: [f64; 3],
}

impl<'a> Joint<'a> {
    /// A joint without support and load.
    pub fn free(name: &'a str, at_m: [f64; 3]) -> Self {
        Self { name, at_m, support: None, load_n: [0.0; 3], reaction_n: [0.0; 3] }
    }
}

/// A member of a [`Structure`]: a straight line between two joints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Member {
    /// Its joints, by their places in the list.
    pub joints: [usize; 2],
    /// Its axial force, N, tension positive; none where it is not known.
    pub axial_n: Option<f64>,
    /// The part of its strength that it uses; none where that is not known.
    pub used: Option<f64>,
    /// Whether it is weaker than wanted.
    pub weak: bool,
    /// Whether its force stands elsewhere: at another span of the same rope.
    pub unlabelled: bool,
}

/// What is drawn: plain data, in SI units.
///
/// ```
/// use figures::{Joint, Member, Structure, Support};
/// let held = Some(Support::Fixed);
/// let joints = [
///     Joint { support: held, reaction_n: [-3.0, 0.0, 4.0], ..Joint::free("A", [0.0; 3]) },
///     Joint { load_n: [0.0, 0.0, -8.0], ..Joint::free("P", [3.0, 0.0, -4.0]) },
///     Joint { support: held, reaction_n: [3.0, 0.0, 4.0], ..Joint::free("B", [6.0, 0.0, 0.0]) },
/// ];
/// let of = |joints| Member { joints, axial_n: Some(5.0), used: Some(0.25), ..Member::default() };
/// let members = [[0, 1], [1, 2]].map(of);
/// let (title, seen) = ("two bars", figures::Seen::Best);
/// let structure = Structure { title, note: "", joints: &joints, members: &members, floor_m: None, seen };
/// assert!(structure.svg()?.contains("5 N, 25 %"));
/// # Ok::<(), figures::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Structure<'a> {
    /// What stands above the drawing.
    pub title: &'a str,
    /// A line under it.
    pub note: &'a str,
    /// The joints.
    pub joints: &'a [Joint<'a>],
    /// The members.
    pub members: &'a [Member],
    /// Height of a floor, m; none where there is none.
    pub floor_m: Option<f64>,
    /// From where it is looked at.
    pub seen: Seen,
}

/// Why a structure cannot be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StructureError {
    /// Occurs when there is no member.
    #[error("there is no member to draw")]
    Empty,
    /// Occurs when a member has a joint that is not in the list.
    #[error("member {member} ends in joint {joint}, and there are {joints} joints")]
    NoJoint {
        /// Place of the member, from 0.
        member: usize,
        /// The joint as given, from 0.
        joint: usize,
        /// Joints in the list.
        joints: usize,
    },
    /// Occurs when a coordinate of a joint, by its place from 0, is not finite.
    #[error("joint {0} is at no finite place")]
    NotFinite(usize),
}

impl Structure<'_> {
    /// The drawing as an SVG file.
    ///
    /// # Errors
    /// [`StructureError`].
    pub fn svg(&self) -> Result<String, StructureError> {
        self.draw(|size, description| Svg::new(size, self.title).described(description))
    }

    /// The drawing as an SVG element for a page in which `id` is unique. It is meant for a white
    /// ground.
    ///
    /// # Errors
    /// [`StructureError`].
    pub fn in_page(&self, id: &str) -> Result<String, StructureError> {
        self.draw(|size, description| Svg::in_page(id, size, self.title, description))
    }

    fn draw(&self, begin: impl FnOnce([f64; 2], &str) -> Svg) -> Result<String, StructureError> {
        self.check()?;
        let scene = Scene::new(self);
        let overhang = forces::overhang(self, &scene);
        let scene = scene.widened(overhang);
        let mut svg = begin(scene.size, &self.description(&scene));
        let heading = Look::PLAIN.size(17.0).bold();
        svg.text(heading, [scene::SIDE, 30.0], Anchor::Start, self.title);
        svg.text(Look::PLAIN, [scene::SIDE, 51.0], Anchor::Start, self.note);
        let small = Look::fill(Colour::grey(0x44)).size(12.0);
        svg.text(small, [scene::SIDE, 70.0], Anchor::Start, &self.extremes());

        let mut labels = Labels::within(scene.size);
        if scene.detail >= 1.0 {
            self.members.iter().for_each(|member| labels.line(scene.ends(member.joints)));
        }
        supports::draw(&mut svg, self, &scene, &mut labels);
        members::draw(&mut svg, self, &scene);
        supports::joints(&mut svg, self, &scene, &mut labels);
        forces::draw(&mut svg, self, &scene, &mut labels);
        supports::names(&mut svg, self, &scene, &mut labels);
        members::values(&mut svg, self, &scene, &mut labels);
        key::draw(&mut svg, self, &scene);
        Ok(svg.finish())
    }

    fn check(&self) -> Result<(), StructureError> {
        if self.members.is_empty() {
            return Err(StructureError::Empty);
        }
        let finite = |joint: &Joint<'_>| joint.at_m.iter().all(|x| x.is_finite());
        if let Some(joint) = self.joints.iter().position(|joint| !finite(joint)) {
            return Err(StructureError::NotFinite(joint));
        }
        let joints = self.joints.len();
        for (member, one) in self.members.iter().enumerate() {
            if let Some(joint) = one.joints.into_iter().find(|joint| *joint >= joints) {
                return Err(StructureError::NoJoint { member, joint, joints });
            }
        }
        Ok(())
    }

    fn description(&self, scene: &Scene) -> String {
        format!(
            "{} members between {} joints, {}. Bars in tension are solid, bars in compression hollow or \
             light, bars without force dashed.",
            self.members.len(),
            self.joints.len(),
            if scene.view.spatial { "in space" } else { "in their plane" }
        )
    }

    /// The largest forces, in words.
    fn extremes(&self) -> String {
        let forces = || self.members.iter().filter_map(|member| member.axial_n);
        let most = forces().fold(0.0, f64::max);
        let least = forces().fold(0.0, f64::min);
        // What a solver leaves of a force that is zero is not told.
        let nothing = members::NOTHING * f64::max(most, -least);
        let said = |name: &str, force: f64| {
            (force > nothing).then(|| format!("largest {name} {} N", labels::short(force)))
        };
        [said("tension", most), said("compression", -least)]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(", ")
    }
}
