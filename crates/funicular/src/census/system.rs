//! What a census of a system says, as `funicular census --json` prints it.

use std::io::{self, Write};

use census::network::{ChainCensus, NetCensus, PartCensus, SystemCensus};
use model::system::{Name, System, SystemEquilibrium};
use serde::Serialize;

use crate::csv::{Numbers, quoted};
use crate::modes::Summary;
use crate::solve::{Lists, Named, SCHEMA_VERSION};

/// All equilibria of a system with their proofs, and what is known of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemCensusAnswer {
    system: System,
    census: SystemCensus,
    equilibria: Vec<SystemEquilibrium>,
}

impl SystemCensusAnswer {
    /// Put together from a census.
    #[must_use]
    pub fn new(system: &System, census: SystemCensus) -> Self {
        let equilibria = census.to_model(system);
        Self { system: system.clone(), census, equilibria }
    }

    /// What it is the census of.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The census itself, with the enclosures.
    #[must_use]
    pub fn proven(&self) -> &SystemCensus {
        &self.census
    }

    /// The isolated equilibria by energy, from the middles of the enclosures.
    #[must_use]
    pub fn equilibria(&self) -> &[SystemEquilibrium] {
        &self.equilibria
    }

    /// Joints as CSV, a line per equilibrium, from 1, and joint: its place, and the force of the
    /// ground on it. What is zero but for rounding is written as 0.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        write!(to, "equilibrium,energy_j,index_in_space,joint,x_m,y_m,z_m")?;
        writeln!(to, ",reaction_x_n,reaction_y_n,reaction_z_n")?;
        for (k, e) in self.equilibria.iter().enumerate() {
            let places = Numbers::of(e.joints_m.as_flattened());
            let forces = Numbers::of(e.reactions_n.as_flattened().iter().chain(&e.axial_n));
            let (energy_j, index) = (e.energy_j, e.stability.index_in_space);
            let joints = self.system.joints().iter().zip(&e.joints_m).zip(&e.reactions_n);
            for ((joint, at_m), force_n) in joints {
                let (name, place) = (quoted(&joint.name), places.cells(*at_m));
                let force = forces.cells(*force_n);
                writeln!(to, "{},{energy_j:?},{index},{name},{place},{force}", k + 1)?;
            }
        }
        Ok(())
    }

    /// Whether the list of every chain was judged again, and passed.
    #[must_use]
    pub fn check_passed(&self) -> bool {
        self.census.chains().all(|chain| chain.check.is_ok())
    }
}

impl Serialize for SystemCensusAnswer {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let system = &self.system;
        let named = |equilibrium| Named { system, equilibrium, lists: Lists::Objects };
        Object {
            schema_version: SCHEMA_VERSION,
            system: Summary::new(system),
            equilibria: self.equilibria.iter().map(named).collect(),
            census: Whole {
                complete: self.census.complete,
                count: self.equilibria.len(),
                circles: self.census.equilibria.iter().any(|position| position.circle),
                undecided_boxes: self.census.undecided(),
                slack_families: self.census.families(),
                check_passed: self.check_passed(),
                parts: self.census.parts.iter().map(|part| One::of(system, part)).collect(),
                seconds: self.census.seconds,
            },
        }
        .serialize(serializer)
    }
}

#[derive(Serialize)]
struct Object<'a> {
    schema_version: u32,
    system: Summary,
    equilibria: Vec<Named<'a>>,
    census: Whole<'a>,
}

#[derive(Serialize)]
struct Whole<'a> {
    complete: bool,
    count: usize,
    circles: bool,
    undecided_boxes: usize,
    slack_families: usize,
    check_passed: bool,
    parts: Vec<One<'a>>,
    seconds: f64,
}

/// One part.
#[derive(Serialize)]
struct One<'a> {
    count: usize,
    /// Numbers of the members that are slack, from 1.
    slack: Vec<usize>,
    /// Numbers of the members in trees, from 1.
    hanging: Vec<usize>,
    chain: Option<Chain<'a>>,
    /// Joints placed by closed forms.
    framed: usize,
    net: Option<Net<'a>>,
}

/// The net of a part.
#[derive(Serialize)]
struct Net<'a> {
    closures: usize,
    /// Joints whose places were searched.
    knots: Vec<&'a Name>,
    /// Joints that follow from their two neighbours.
    swings: Vec<&'a Name>,
    /// Bars and joints of which both signs were tried.
    signs: usize,
    /// Whether only equilibria in the vertical plane of the anchors were looked for.
    in_plane: bool,
    cells: u64,
    tests: u64,
    undecided_boxes: usize,
}

/// The chain of a part.
#[derive(Serialize)]
struct Chain<'a> {
    joints: Vec<&'a Name>,
    complete: bool,
    count_in_plane: usize,
    count_by_index: Vec<i64>,
    alternating_sum: i64,
    euler_characteristic: Option<i64>,
    undecided_boxes: usize,
    check: Option<&'a str>,
    statistics: census::Statistics,
}

/// From 1.
fn numbers(members: &[usize]) -> Vec<usize> {
    members.iter().map(|member| member + 1).collect()
}

impl<'a> One<'a> {
    fn of(system: &'a System, part: &'a PartCensus) -> Self {
        Self {
            count: part.positions,
            slack: numbers(&part.slack),
            hanging: numbers(&part.hanging),
            chain: part.chain.as_ref().map(|chain| Chain::of(system, chain)),
            framed: part.framed,
            net: part.net.as_ref().map(|net| Net::of(system, net)),
        }
    }
}

impl<'a> Net<'a> {
    fn of(system: &'a System, net: &'a NetCensus) -> Self {
        let names = |joints: &[usize]| -> Vec<&'a Name> {
            joints.iter().map(|k| &system.joints()[*k].name).collect()
        };
        Self {
            closures: net.closures,
            knots: names(&net.knots),
            swings: names(&net.swings),
            signs: net.signs,
            in_plane: net.in_plane,
            cells: net.cells,
            tests: net.tests,
            undecided_boxes: net.undecided.len(),
        }
    }
}

impl<'a> Chain<'a> {
    fn of(system: &'a System, chain: &'a ChainCensus) -> Self {
        let census = &chain.census;
        Self {
            joints: chain.joints.iter().map(|k| &system.joints()[*k].name).collect(),
            complete: census.complete,
            count_in_plane: census.count_in_plane(),
            count_by_index: census.count_by_index(),
            alternating_sum: census.alternating_sum(),
            euler_characteristic: census.topology.as_ref().ok().map(|known| known.euler),
            undecided_boxes: census.undecided.len(),
            check: chain.check.as_ref().err().map(String::as_str),
            statistics: census.statistics,
        }
    }
}
