pub(crate) mod inertia;
pub(crate) mod stress;

use numerics::{Interval, atan2};

use crate::run::closure::bar::{size, unit};
use crate::run::closure::signed;
use crate::run::enclosure::krawczyk::Zero;
use crate::run::equilibrium::inertia::Indices;
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::system::System;

/// An equilibrium whose existence and uniqueness near by are proved; every number is an enclosure
/// of the exact value.
///
/// For anchors on one vertical it stands for a whole circle of equilibria, all turns of the chain
/// about that vertical: it is shown in the plane X = 0, bar 1 leaning towards +Y, and its mirror
/// image is the turn by 180 degrees.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvenEquilibrium {
    /// +1 for each bar in tension, −1 for each in compression, 0 for one that carries nothing,
    /// less than a 10¹² part of the weights, or so little that its sign is not proved.
    pub signs: Vec<i8>,
    /// The pull of the chain on the first anchor, −λ₁..₃, N: its part along the horizontal
    /// direction from the first to the last anchor, and its part along Z.
    pub pull_n: [Interval; 2],
    /// A neighbourhood of the pull that holds no other equilibrium with the same signs, whatever
    /// that of a bar without force.
    pub alone_in: Neighbourhood,
    /// Angle of each bar from the descending vertical towards the last anchor, (−π, π].
    pub angles_rad: Vec<Interval>,
    /// Potential energy, measured from the height of joint 0.
    pub energy_j: Interval,
    /// Joints 0..=n, world frame.
    pub joints_m: Vec<[Interval; 3]>,
    /// Multipliers in the paper's meaning and order, world frame.
    pub multipliers_n: Vec<[Interval; 3]>,
    /// Axial force of each bar, weights lumped to its joints by the lever rule, tension positive.
    pub axial_n: Vec<Interval>,
    /// Morse index among the motions in the vertical plane; the second derivative is proved to be
    /// regular there.
    pub index_in_plane: usize,
    /// Morse index among the motions out of the plane. Their second derivative is proved to be
    /// regular too, but for the turn about vertical anchors.
    pub index_out_of_plane: usize,
    /// Condition of the derivative of the closure by the pull, as a plain number: how much the pull
    /// magnifies errors of the closure.
    pub condition: f64,
    /// Whether no configuration in space has less energy, by the stress matrix.
    pub optimal: bool,
    /// Whether it stands for a circle of equilibria.
    pub circle: bool,
}

/// A rectangle in a chart of pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbourhood {
    /// The chart.
    pub chart: Face,
    /// The rectangle in the coordinates of the chart.
    pub at: [Interval; 2],
}

impl ProvenEquilibrium {
    /// Index among all motions in space.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// let highest = &census.equilibria[1];
    /// assert_eq!((highest.index_in_plane, highest.index_out_of_plane), (1, 1));
    /// assert_eq!(highest.index_in_space(), 2);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn index_in_space(&self) -> usize {
        self.index_in_plane + self.index_out_of_plane
    }

    /// The largest relative width of an enclosure: of the pull against its size, the joints against
    /// the length of the chain, the angles in radians.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// assert!(census.equilibria.iter().all(|equilibrium| equilibrium.width() < 1e-14));
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn width(&self) -> f64 {
        let [h, v] = self.pull_n;
        let pull = h.width().max(v.width()) / h.mag().max(v.mag());
        self.angles_rad.iter().map(|angle| angle.width()).fold(pull, f64::max)
    }

    /// Assemble from a proved zero; `None` if the pull may be infinite, or an index cannot be
    /// proved.
    pub(crate) fn new(system: &System, signs: &[i8], zero: &Zero) -> Option<Self> {
        Some(Proof::of(system, signs, zero)?.assemble(system, signs))
    }
}

/// What is proved about a zero of the closure.
pub(crate) struct Proof {
    /// The zero, of a circle that on the side on which bar 1 leans towards +Y.
    pub(crate) shown: Zero,
    pub(crate) observed: Observed,
    pub(crate) indices: Indices,
    pub(crate) optimal: bool,
}

impl Proof {
    /// `None` if the pull may be infinite, or an index cannot be proved.
    pub(crate) fn of(system: &System, signs: &[i8], zero: &Zero) -> Option<Self> {
        // The one of the two mirror images in which bar 1 leans towards +Y.
        let flip = system.vertical && signs[0] < 0;
        let shown = if flip {
            Zero { tight: zero.tight.mirrored(), alone_in: zero.alone_in.mirrored() }
        } else {
            *zero
        };
        let [h, _, w] = shown.tight.homogeneous();
        if w.lo() <= 0.0 || h.sign().is_none_or(|sign| sign == 0) {
            return None;
        }
        let observed = Observed::at(system, signs, &shown.tight);
        let indices = inertia::indices(signs, &system.length, &observed.forces, system.vertical)?;
        let optimal =
            stress::proves_optimal(signs, &system.length, &observed.sizes, system.vertical);
        Some(Self { shown, observed, indices, optimal })
    }

    pub(crate) fn assemble(self, system: &System, signs: &[i8]) -> ProvenEquilibrium {
        let Self { shown: Zero { alone_in, .. }, observed, indices, optimal } = self;
        let Indices { in_plane, out_of_plane, condition } = indices;
        let newton = system.force_unit_n();
        ProvenEquilibrium {
            signs: signs.to_vec(),
            pull_n: system.pull_on_anchor_n(observed.pull),
            alone_in: Neighbourhood { chart: alone_in.face, at: alone_in.at },
            angles_rad: observed.angles(),
            energy_j: observed.energy_j(system),
            joints_m: observed.joints(system),
            multipliers_n: observed.multipliers(system),
            axial_n: signs
                .iter()
                .zip(&observed.sizes)
                .map(|(sign, size)| signed(*sign, *size) * newton)
                .collect(),
            index_in_plane: in_plane,
            index_out_of_plane: out_of_plane,
            condition,
            optimal,
            circle: system.vertical,
        }
    }
}

/// What follows from signs and pull, in the units of the system.
pub(crate) struct Observed {
    /// Pull of bar 1 on joint 0, not centred.
    pub(crate) pull: [Interval; 2],
    pub(crate) forces: Vec<[Interval; 2]>,
    /// |F|; of a bar with the sign 0 its axial force, sign and all.
    pub(crate) sizes: Vec<Interval>,
    pub(crate) directions: Vec<[Interval; 2]>,
}

impl Observed {
    pub(crate) fn at(system: &System, signs: &[i8], cell: &Cell) -> Self {
        let w = cell.homogeneous()[2];
        // Directions from the homogeneous coordinates, which are narrower than their quotients.
        let homogeneous: Vec<[Interval; 2]> =
            system.weights(cell.face).iter().map(|weight| cell.force(*weight)).collect();
        let sizes = homogeneous.iter().map(|force| size(*force) / w).collect();
        let directions = signs
            .iter()
            .zip(&homogeneous)
            .map(|(sign, force)| unit(*force).map(|part| signed(*sign, part)))
            .collect();
        Self { pull: cell.pull(system), forces: homogeneous, sizes, directions }
    }

    /// From the descending vertical: (−u_z, u_x).
    fn angles(&self) -> Vec<Interval> {
        self.directions.iter().map(|[x, z]| atan2(*x, -*z)).collect()
    }

    /// Potential energy above the height of joint 0, J: V = Σ m g z_C = (M − c₀) D_z − Σ c_i l_i u_iz with the centred weights; M is what hangs
    /// behind joint 0, at whose height weight has no energy.
    pub(crate) fn energy_j(&self, system: &System) -> Interval {
        let total: Interval = system.added.iter().copied().sum();
        let hanging: Interval = self
            .directions
            .iter()
            .zip(&system.length)
            .zip(&system.weight)
            .map(|((u, length), weight)| *weight * (*length * u[1]))
            .sum();
        let energy = (total - Interval::point(system.offset)) * system.span[1] - hanging;
        energy * system.force_unit_n() * Interval::point(system.length_unit_m)
    }

    fn joints(&self, system: &System) -> Vec<[Interval; 3]> {
        let mut at = [Interval::ZERO; 2];
        let mut joints = vec![system.start_m.map(Interval::point)];
        for (u, length) in self.directions.iter().zip(&system.length) {
            for k in 0..2 {
                at[k] = at[k] + *length * u[k];
            }
            let world = system.world(at);
            joints.push(std::array::from_fn(|k| {
                let start = Interval::point(system.start_m[k]);
                // In the plane of the paper X is exactly that of the anchors.
                if world[k] == Interval::ZERO {
                    start
                } else {
                    start + world[k].scale(system.length_unit_m)
                }
            }));
        }
        // The last joint is the last anchor, which is known exactly.
        if let Some(last) = joints.last_mut() {
            *last = system.end_m.map(Interval::point);
        }
        joints
    }

    fn multipliers(&self, system: &System) -> Vec<[Interval; 3]> {
        let newton = system.force_unit_n();
        let mut pull = self.pull;
        let mut forces = vec![system.pull_on_anchor_n(pull).map(|part| -part)];
        for weight in &system.added {
            pull[1] = pull[1] + *weight;
            forces.push(pull.map(|part| part * newton));
        }
        forces.into_iter().map(|force| system.world(force)).collect()
    }
}
