//! What stands out in an equilibrium.

use model::Vector;
use model::system::{Kind, System, SystemEquilibrium};
use serde::Serialize;

use crate::sag::Sag;

/// What is this much smaller than the largest force is the rounding of a zero: solvers agree to
/// less.
const ROUNDING: f64 = 1e-12;

/// What stands out in an equilibrium: how deep it hangs, and where the forces are largest.
///
/// ```
/// use funicular::{Extremes, prelude::*};
/// // A lamp on two threads of 5 m between anchors 6 m apart: the triangle 3, 4, 5.
/// let answer = Solve::new().run(&Problem::parse(
///     "gravity_m_s2 = 10\n\
///      joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, lamp = { mass_kg = 2 } }\n\
///      bars = [{ from = 'A', to = 'lamp', length_m = 5, mass_kg = 0 },\n\
///              { from = 'lamp', to = 'B', length_m = 5, mass_kg = 0 }]",
///     "lamp.toml",
/// )?)?;
/// let extremes = Extremes::of(answer.system(), &answer.equilibria()[0]).expect("joints");
/// assert_eq!(extremes.lowest_joint, 2);
/// assert!((extremes.sag_m.unwrap() - 4.0).abs() < 1e-12);
/// assert!((extremes.tension_n.unwrap().1 - 12.5).abs() < 1e-11);
/// assert_eq!(extremes.compression_n, None);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Extremes {
    /// The lowest joint, from 0; of several the first. In JSON it has its name.
    #[serde(skip)]
    pub lowest_joint: usize,
    /// Where it is, m.
    pub lowest_m: Vector,
    /// The largest depth of a joint below the line that its row of members spans, m; where no row
    /// spans anything, of the lowest joint below the lowest support. `None` where neither is.
    pub sag_m: Option<f64>,
    /// The same with the joint and the ends of the line.
    #[serde(skip)]
    pub sag: Option<Sag>,
    /// The bar, from 0, with the largest tension anywhere along it, and that, N; without value where
    /// no bar pulls. In JSON bars are counted from 1.
    #[serde(serialize_with = "from_one")]
    pub tension_n: Option<(usize, f64)>,
    /// The bar, from 0, with the largest compression anywhere along it, no cable, and its size, N; without
    /// value where no bar pushes. In JSON bars are counted from 1.
    #[serde(serialize_with = "from_one")]
    pub compression_n: Option<(usize, f64)>,
}

#[expect(clippy::ref_option, reason = "as serde calls it")]
fn from_one<S: serde::Serializer>(
    largest: &Option<(usize, f64)>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    largest.map(|(bar, force_n)| (bar + 1, force_n)).serialize(serializer)
}

impl Extremes {
    /// Of an equilibrium of a system; `None` where there is no joint.
    pub fn of(system: &System, found: &SystemEquilibrium) -> Option<Self> {
        let joints_m = &found.joints_m;
        let height = |joint: &usize| joints_m[*joint][2];
        let by_height = |a: &usize, b: &usize| height(a).total_cmp(&height(b));
        let lowest_joint = (0..joints_m.len()).min_by(by_height)?;
        let sag = Sag::largest(system, joints_m);
        let (mut size, mut largest): (f64, [Option<(usize, f64)>; 2]) = (0.0, [None; 2]);
        for bar in 0..system.members().len() {
            let along = found.axial_force(system, bar);
            size = size.max(along.largest_n().abs());
            // What its own weight presses together at an end of a lying cable is no compression of it.
            let borne = match system.members()[bar].kind {
                Kind::Bar => [along.most_n, -along.least_n],
                Kind::Cable => [along.most_n, 0.0],
                Kind::Strut => [0.0, -along.least_n],
            };
            for (most, force) in largest.iter_mut().zip(borne) {
                // The first of several.
                if most.is_some_and(|(_, largest)| force <= largest) {
                    continue;
                }
                *most = Some((bar, force));
            }
        }
        let felt = |(_, force): &(usize, f64)| *force > ROUNDING * size;
        let [tension_n, compression_n] = largest.map(|most| most.filter(felt));
        Some(Self {
            lowest_joint,
            lowest_m: joints_m[lowest_joint],
            sag_m: sag.map(|sag| sag.depth_m),
            sag,
            tension_n,
            compression_n,
        })
    }
}
