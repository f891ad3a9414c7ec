//! Every equilibrium of a system, with proof, where its closures are few.
//!
//! Parts of a system that are connected over anchors alone have equilibria of their own, and the
//! system has all combinations of theirs. In each part the trees are taken off first: what a member
//! alone holds tells its force, and the force its direction (module `tree`). What is left has
//! closures = members − joints that move. Without any the part is a tree. A chain between two
//! anchors has one, and hangs in a vertical plane if all that it bears is weight: its equilibria
//! are those of the census of a chain, with weights at the joints (module `loaded_chain`). Frames that are
//! built up joint by joint, a tripod among them, have closed forms whatever their closures (module
//! `truss`).
//!
//! A net of several closures is searched over the places of its knots (module `knots`). A joint P that two bars of the lengths $l_1$, $l_2$ hold to a and b is
//! no knot: with $c = b - a$, $q = |c|^2$, its load f and $f_\perp$, the part of it across c,
//!
//! $$ P = a + \alpha c \pm h \frac{f_\perp}{|f_\perp|}, \qquad
//!    \alpha = \frac12 + \frac{l_1^2 - l_2^2}{2q}, \qquad
//!    h^2 = \frac{((l_1 + l_2)^2 - q)(q - (l_1 - l_2)^2)}{4q}, $$
//!
//! with the force densities $w_1 = \pm|f_\perp|(1 - \alpha)/h + f\cdot c/q$ and $w_2 =
//! \pm|f_\perp|\alpha/h - f\cdot c/q$. So a bridle whose strands have two bars each has one knot,
//! three unknowns and a sign for each strand, whatever the number of strands. Branch and bound goes
//! through all places of the knots within reach of their anchors. Boxes are narrowed by distances,
//! excluded by the linear balance of forces in intervals, and where all is smooth by the interval
//! Newton method, which also proves that a box has one equilibrium at most for a pattern of signs.
//! Each equilibrium is then enclosed by Krawczyk's test on the equations (1) and (2) of [`boxes`](crate::boxes), and its index follows from
//! the inertia of the bordered second derivative.
//!
//! Cables, struts and ropes beside bars are taut or slack: for each set of slack ones the others make a system of
//! their own (module `branch`), whose equilibria are kept where the taut ones pull or push as they can and the slack ones do not
//! reach. In a net a rope is one link of several spans with one tension $N$ and equation (3); an elastic member tells
//! its tension by its spans, and a weight alone at the end of a rope tells that of the rope, $N = W$, and hangs as far
//! down as the other spans leave it. A span without length pulls with any vector of at most the length 1 times N,
//! so that boxes with a jam are not excluded; they end as undecided, with that reason.
//!
//! Of cables and ropes alone the energy is convex, so that an equilibrium in a box is the only one
//! ([`SystemCensus::of_cables`]).
//!
//! Other nets with more motions than [`Settings::max_motions`](crate::Settings::max_motions) are
//! refused; what cannot be decided is listed.

mod branch;
mod choice;
mod convex;
mod knots;
mod loaded_chain;
mod parts;
mod position;
mod row;
mod tree;
mod truss;
mod weights;

use std::time::Instant;

use model::system::{Joint, Kind, Support, System};
use model::{NoCensus, Vector as Point};
use numerics::Interval;

pub use self::knots::{NetCensus, Open, UndecidedPlaces};
pub use self::position::SystemPosition;
pub use self::row::LoadedRow;

use self::branch::{Branch, branches, signs_hold};
use self::choice::{Choice, Measured};
use self::loaded_chain::{LoadedChain, choices};
use self::parts::{Core, Part, parts};
use self::tree::{borne, hung};
use self::truss::{order, positions};
use crate::boxes::frame::Frame;
use crate::run::Census;
use crate::run::check::CheckError;
use crate::run::search::Progress;
use crate::settings::Settings;

/// Most joints of a frame: with two places for each of them there are more positions than are
/// listed.
const MAX_FRAMED: usize = 64;

/// Joints of a net beyond which nothing is looked at: knots, swings and strands that are searched have
/// far fewer, and what tells one reason of a refusal from another takes the square of their number.
const MOST_JOINTS: usize = 1000;

/// Most positions that are listed, if several parts or trees make them together.
pub const MAX_POSITIONS: usize = 4096;

type Result<T, E = NoCensus> = std::result::Result<T, E>;

/// All equilibria of a system, and how far that is proved.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemCensus {
    /// The isolated equilibria by energy, each standing for all that free turns about verticals
    /// make of it.
    pub equilibria: Vec<SystemPosition>,
    /// The parts, each with the equilibria that it has whatever the others do.
    pub parts: Vec<PartCensus>,
    /// Whether every equilibrium is in the list, or in a family of slack bars of a chain.
    pub complete: bool,
    /// Wall-clock time, s.
    pub seconds: f64,
}

/// A part of a system, connected not over anchors alone.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PartCensus {
    /// Its isolated equilibria, whatever the lengths of slack members are.
    pub positions: usize,
    /// Members that are slack, from 0: with those the part is another one, or several.
    pub slack: Vec<usize>,
    /// Members in trees, from 0: each pulls or pushes, whatever the others do.
    pub hanging: Vec<usize>,
    /// The chain between anchors that bears the trees, if there is one.
    pub chain: Option<ChainCensus>,
    /// Joints of a frame that is built up joint by joint, placed by closed forms.
    pub framed: usize,
    /// The net of several closures that bears the trees, if there is one.
    pub net: Option<NetCensus>,
}

/// The chain of a part with its census.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainCensus {
    /// Its joints from anchor to anchor, from 0.
    pub joints: Vec<usize>,
    /// Its members in that order, from 0.
    pub members: Vec<usize>,
    /// Its equilibria; bars without mass, all weights at the joints.
    pub census: Census,
    /// Whether every one of them is proved again without the search, and the count of them is what
    /// topology asks for; else what is missing or wrong.
    pub check: Result<(), String>,
    /// Whether the check shows that something is wrong; else what failed is a proof, which shows nothing.
    pub refuted: bool,
    /// Whether every bar bears its own weight. Where a bar is given against the direction of the chain and its
    /// centre would be rounded, its weight is at the joints, and energy and pull are without what the anchors
    /// bear of it.
    pub whole: bool,
}

impl SystemCensus {
    /// Take the census of a system.
    ///
    /// # Errors
    ///
    /// [`NoCensus`], why there is none.
    ///
    /// ```
    /// use model::Bar;
    /// use model::system::{Joint, Member, System};
    /// // A lamp on two bars of 5 m between anchors 6 m apart hangs 4 m below them or stands 4 m
    /// // above.
    /// let joints = vec![
    ///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
    ///     Joint::anchor("B", [3.0, 0.0, 0.0]),
    ///     Joint::free("lamp").with_mass(0.2),
    /// ];
    /// let bar = Bar::homogeneous(5.0, 0.0)?;
    /// let members = vec![Member::bar(0, 2, bar), Member::bar(1, 2, bar)];
    /// let system = System::new("lamp", 10.0, joints, members)?;
    /// let census = census::net::SystemCensus::take(&system, &census::Settings::default())?;
    /// assert!(census.complete && census.equilibria.len() == 2);
    /// let lowest = &census.equilibria[0];
    /// assert!(lowest.joints_m[2][2].contains(-4.0) && lowest.axial_n[1].contains(1.25));
    /// assert!(census.equilibria[1].energy_j.contains(8.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn take(system: &System, settings: &Settings) -> Result<Self> {
        Self::take_watched(system, settings, &|_| {})
    }

    /// Take the census of a system, and tell `watch` of the progress of every search.
    ///
    /// # Errors
    ///
    /// As [`take`](Self::take).
    pub fn take_watched(
        system: &System,
        settings: &Settings,
        watch: &dyn Fn(Progress),
    ) -> Result<Self> {
        let start = Instant::now();
        system.refusal().map_err(|_| NoCensus::Refused)?;
        if system.floor_m().is_some() {
            return Err(NoCensus::Floor);
        }
        let planar = in_plane(system);
        let system = planar.as_ref().map_or(system, |(freed, _)| freed);
        let moves_freely =
            |support: &Support| matches!(support, Support::Free | Support::Fixed { .. });
        if let Some(joint) = system.joints().iter().position(|j| !moves_freely(&j.support)) {
            return Err(NoCensus::Slider { joint: joint + 1 });
        }
        let frame = &Frame::new(system, &[]);
        let (of, parts) = (Measured { system, frame }, parts(system, &[]));
        let is_net = |part: &Part| matches!(part.core, Core::Net { .. });
        if let Some(part) = parts.iter().find(|part| planar.is_some() && is_net(part)) {
            return Err(NoCensus::Slider { joint: part.joints[0] + 1 });
        }
        let pulls = system.members().iter().all(|member| member.kind == Kind::Cable);
        if pulls && parts.iter().any(is_net) {
            return Err(NoCensus::Cables);
        }
        let mut positions = vec![Choice::default()];
        let (count, mut found) = (parts.len(), vec![]);
        for part in parts {
            let mut own = vec![];
            refusal(of, &part, settings)?;
            let branches = branches(of, part)?;
            for part in branches[1..].iter().flat_map(|branch| &branch.parts) {
                refusal(of, part, settings)?;
            }
            // The searches of all sets take no longer together than one.
            let nets = branches.iter().flat_map(|branch| &branch.parts).filter(|part| is_net(part));
            let tests = settings.max_tests_per_pattern / nets.count().max(1) as u64;
            let shared = Settings { max_tests_per_pattern: tests.max(1), ..*settings };
            for branch in branches {
                own.extend(of_branch(of, &branch, &shared, watch, &mut found)?);
            }
            if let Some((_, level)) = planar {
                own = own.into_iter().flat_map(|choice| choice.in_plane(system, level)).collect();
            }
            positions = combined(&positions, &own)?;
        }
        // One vertical plane holds a chain and plumb trees on it, or plumb trees on one anchor.
        let plane = count <= 1
            && found.iter().all(|part| part.framed == 0 && part.net.is_none())
            && frame.loads(system).iter().all(|[x, y, _]| [*x, *y] == [Interval::ZERO; 2]);
        let mut equilibria = vec![];
        for mut choice in positions {
            if planar.is_some() {
                choice.index[1] = 0;
            }
            equilibria.push(SystemPosition::new(of, &choice, plane));
        }
        equilibria.sort_by(|a, b| a.energy_j.mid().total_cmp(&b.energy_j.mid()));
        let proved = |part: &PartCensus| {
            part.chain.as_ref().is_none_or(|chain| chain.census.complete)
                && part.net.as_ref().is_none_or(|net| net.undecided.is_empty() && !net.in_plane)
        };
        Ok(Self {
            complete: found.iter().all(proved),
            equilibria,
            parts: found,
            seconds: start.elapsed().as_secs_f64(),
        })
    }

    /// Cells of pulls of chains and boxes of places of nets that could not be decided.
    pub fn undecided(&self) -> usize {
        let chains: usize = self.chains().map(|chain| chain.census.undecided.len()).sum();
        chains + self.nets().map(|net| net.undecided.len()).sum::<usize>()
    }

    /// Families of equilibria with slack bars.
    pub fn families(&self) -> usize {
        self.chains().map(|chain| chain.census.families.len()).sum()
    }

    /// Cells of pulls and boxes of places looked at.
    pub fn cells(&self) -> u64 {
        let chains: u64 = self.chains().map(|chain| chain.census.statistics.cells).sum();
        chains + self.nets().map(|net| net.cells).sum::<u64>()
    }

    /// The census of the row of bars that the system is, if it is one
    /// ([`as_row`](System::as_row)) whose bars bear their own weight.
    pub fn row(&self, system: &System) -> Option<&ChainCensus> {
        let [PartCensus { chain, .. }] = &self.parts[..] else { return None };
        chain.as_ref().filter(|chain| chain.whole && system.as_row().is_some())
    }

    /// The chains of all parts.
    pub fn chains(&self) -> impl Iterator<Item = &ChainCensus> {
        self.parts.iter().filter_map(|part| part.chain.as_ref())
    }

    /// The nets of all parts.
    pub fn nets(&self) -> impl Iterator<Item = &NetCensus> {
        self.parts.iter().filter_map(|part| part.net.as_ref())
    }
}

/// A system whose joints slide in one upright plane across x or y, with its anchors and loads in it, as one that moves
/// freely: chains and trees stay in that plane by themselves. With the level axis of the plane.
fn in_plane(system: &System) -> Option<(System, usize)> {
    let across = system.across().filter(|across| *across < 2)?;
    let none = |force: &Point| force[across].abs() <= 0.0;
    let line = |joint: &Joint| matches!(joint.support, Support::Line { .. });
    let loads = system.members().iter().flat_map(|member| &member.loads).map(|load| &load.force_n);
    let mut loads = loads.chain(system.joints().iter().map(|joint| &joint.force_n));
    if system.joints().iter().any(line) || !loads.all(none) {
        return None;
    }
    let free = |_, joint: &Joint| match joint.support {
        Support::Plane { .. } => Support::Free,
        support => support,
    };
    Some((system.on_supports(free, system.members().to_vec()).ok()?, 1 - across))
}

/// Each of these positions with each of those.
fn combined(all: &[Choice], own: &[Choice]) -> Result<Vec<Choice>> {
    let alone = all.len() <= 1 || own.len() <= 1;
    if !alone && all.len().saturating_mul(own.len()) > MAX_POSITIONS {
        return Err(NoCensus::TooManyPositions { limit: MAX_POSITIONS });
    }
    Ok(all.iter().flat_map(|all| own.iter().map(|one| all.and(one))).collect())
}

/// Why a part has no census, as far as that is known before any search.
fn refusal(of: Measured<'_>, part: &Part, settings: &Settings) -> Result<()> {
    match &part.core {
        _ if !part.grounded => Err(NoCensus::Loose { joint: part.joints[0] + 1 }),
        Core::Net { joints, members } if joints.len() > MOST_JOINTS => {
            let closures = members.len().saturating_sub(joints.len());
            Err(NoCensus::Closures { closures })
        }
        Core::Net { joints, members } if framing(of.system, joints, members).is_none() => {
            let (Measured { system, frame }, loads) = (of, borne(of, &part.hanging));
            let core = knots::Core { system, frame, joints, members, loads: &loads };
            knots::refusal(&core, settings)
        }
        Core::Chain { members, .. } if members.len() > settings.max_bars => {
            Err(NoCensus::TooManyBars { bars: members.len(), limit: settings.max_bars })
        }
        _ => Ok(()),
    }
}

/// The positions of a part with some members slack.
fn of_branch(
    of: Measured<'_>,
    branch: &Branch,
    settings: &Settings,
    watch: &dyn Fn(Progress),
    found: &mut Vec<PartCensus>,
) -> Result<Vec<Choice>> {
    let axial = branch.slack.iter().map(|member| (*member, Interval::ZERO)).collect();
    let mut positions = vec![Choice { axial, ..Choice::default() }];
    for part in &branch.parts {
        let (part, own) = of_part(of, part, settings, watch)?;
        positions = combined(&positions, &own)?;
        found.push(PartCensus { slack: branch.slack.clone(), ..part });
    }
    let mut kept = vec![];
    for choice in positions {
        if branch.has(of, &choice)? {
            kept.push(choice);
        }
    }
    Ok(kept)
}

/// In which order the joints of a net are placed, if closed forms do.
fn framing(system: &System, joints: &[usize], members: &[usize]) -> Option<Vec<truss::Placed>> {
    (joints.len() <= MAX_FRAMED).then(|| order(system, joints, members)).flatten()
}

fn of_part(
    of: Measured<'_>,
    part: &Part,
    settings: &Settings,
    watch: &dyn Fn(Progress),
) -> Result<(PartCensus, Vec<Choice>)> {
    let Measured { system, frame } = of;
    let (mut chain, mut framed, mut net) = (None, 0, None);
    let cores = match &part.core {
        Core::Net { joints, members } => {
            let loads = borne(of, &part.hanging);
            if let Some(order) = framing(system, joints, members) {
                framed = joints.len();
                positions(of, &order, &loads)?
            } else {
                let core = knots::Core { system, frame, joints, members, loads: &loads };
                let (taken, cores) = knots::taken(&core, settings, watch)?;
                net = Some(taken);
                cores
            }
        }
        Core::Anchor => vec![Choice::anchor(of, part)],
        Core::Chain { joints, members } => {
            let loaded = LoadedChain::new(system, joints, members, &part.hanging)?;
            let census = loaded.census(settings, watch)?;
            let check = loaded.check(&census);
            let refuted = check.as_ref().is_err_and(CheckError::refutes);
            let (check, whole) = (check.map_err(|error| error.to_string()), loaded.whole);
            let both = [joints.as_slice(), members.as_slice()];
            let cores = choices(&census, frame, both);
            let (joints, members) = (joints.clone(), members.clone());
            chain = Some(ChainCensus { joints, members, census, check, refuted, whole });
            cores
        }
    };
    let mut positions = vec![];
    for choice in hung(of, &part.hanging, cores)? {
        if signs_hold(system, &choice)? {
            positions.push(choice);
        }
    }
    let hanging = part.hanging.iter().map(|hanging| hanging.member).collect();
    let (count, slack) = (positions.len(), vec![]);
    Ok((PartCensus { positions: count, slack, hanging, chain, framed, net }, positions))
}
