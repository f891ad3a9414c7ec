use model::system::{Kind, System, SystemEquilibrium, SystemStability};
use model::{
    Complete, CompleteSystem, Evidence, InSpace, Jam, NoCensus, NoCertificate, Reason, SolverName,
    Status, Vector as Point, Verified, VerifiedSystem,
};
use numerics::Interval;

use super::choice::{Choice, Measured};
use super::{PartCensus, SystemCensus};
use crate::boxes::arithmetic::{
    NOWHERE, Vector, dot, minus, norm, over, plus, product, sum, times,
};
use crate::boxes::frame::Frame;
use crate::boxes::proven::idle_n;

/// An equilibrium of a system whose existence is proved; every number is an enclosure of the exact
/// value.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemPosition {
    /// Places of all joints, world frame, m. Of what turns freely one position is shown.
    pub joints_m: Vec<[Interval; 3]>,
    /// Axial force of each member with its loads lumped to its joints, tension positive, N.
    pub axial_n: Vec<Interval>,
    /// Force of the ground on each joint, N; zero at joints without a support.
    pub reactions_n: Vec<[Interval; 3]>,
    /// Energy relative to [`System::reference_m`], J.
    pub energy_j: Interval,
    /// Independent directions in which the energy falls.
    pub index_in_space: usize,
    /// The same among the motions in the vertical plane of the one chain; nothing where there is no
    /// such plane.
    pub index_in_plane: Option<usize>,
    /// Whether a part turns freely about the vertical through its anchors.
    pub circle: bool,
}

impl SystemPosition {
    /// A position of all parts in metres and newtons.
    pub(super) fn new(of: Measured<'_>, choice: &Choice, plane: bool) -> Self {
        let (Measured { system, frame }, places) = (of, of.places(choice));
        let mut axial: Vec<Interval> = system
            .members()
            .iter()
            .map(|member| frame.force(idle_n(member, &places, frame.length_m)))
            .collect();
        for (member, force) in &choice.axial {
            axial[*member] = *force;
        }
        let loads = frame.loads(system);
        let forces = balance(system, &places, &axial, loads.clone()).joints;
        let mut energy = Interval::ZERO;
        for (place, load) in places.iter().zip(&loads) {
            energy = sum(energy, -dot(*place, *load));
        }
        for (member, axial) in system.members().iter().zip(&axial) {
            let stored = product(frame.compliance(member), axial.square()).scale(0.5);
            energy = sum(energy, stored);
        }
        let reactions = system.joints().iter().zip(forces).map(|(joint, force)| {
            if joint.support.at_m().is_some() {
                force.map(|part| (-part).scale(frame.force_n))
            } else {
                NOWHERE
            }
        });
        let [in_plane, out_of_plane] = choice.index;
        Self {
            joints_m: places.iter().map(|place| frame.place_m(*place)).collect(),
            axial_n: axial.iter().map(|force| force.scale(frame.force_n)).collect(),
            reactions_n: reactions.collect(),
            energy_j: energy.scale(frame.force_n).scale(frame.length_m),
            index_in_space: in_plane + out_of_plane,
            index_in_plane: plane.then_some(in_plane),
            circle: choice.circle,
        }
    }

    /// Largest width of the place of a joint, m.
    pub fn width_m(&self) -> f64 {
        self.joints_m.iter().flatten().map(|x| x.width()).fold(0.0, f64::max)
    }

    /// Largest width of an axial force, N.
    pub fn width_n(&self) -> f64 {
        self.axial_n.iter().map(|x| x.width()).fold(0.0, f64::max)
    }
}

/// Forces at places, all enclosed.
struct Balance {
    /// The sum of loads and members at each joint.
    joints: Vec<Vector>,
    /// How each member pulls at its first joint, and away from its last.
    ends: Vec<[Vector; 2]>,
    /// Spans without length, by member and place in it, and how each pulls at its first joint.
    jams: Vec<(usize, usize, Vector)>,
}

/// A span without length pulls as the joint asks that has run there, to the end of its rope.
fn balance(system: &System, places: &[Vector], axial: &[Interval], loads: Vec<Vector>) -> Balance {
    let ends = vec![[NOWHERE; 2]; axial.len()];
    let mut found = Balance { joints: loads, ends, jams: vec![] };
    let spans = |k: usize| system.members()[k].spans().enumerate();
    let all = (0..axial.len()).flat_map(|k| spans(k).map(move |(n, joints)| (k, n, joints)));
    let is_jam =
        |k: usize, [a, b]: [usize; 2]| axial[k] != Interval::ZERO && places[a] == places[b];
    let (jams, long): (Vec<_>, Vec<_>) = all.partition(|(k, _, joints)| is_jam(*k, *joints));
    for (k, n, [a, b]) in long.into_iter().chain(jams) {
        let pull = if !is_jam(k, [a, b]) {
            let span = minus(places[b], places[a]);
            times(axial[k], over(span, norm(span)))
        } else if system.joints()[b].support.at_m().is_none() {
            found.joints[b]
        } else {
            times(-Interval::ONE, found.joints[a])
        };
        found.joints[a] = plus(found.joints[a], pull);
        found.joints[b] = minus(found.joints[b], pull);
        if n == 0 {
            found.ends[k][0] = pull;
        }
        if n == system.members()[k].via().len() {
            found.ends[k][1] = pull;
        }
        if is_jam(k, [a, b]) {
            found.jams.push((k, n, pull));
        }
    }
    found
}

impl SystemCensus {
    /// The isolated equilibria as answers of a solver, in the order of the census: middles of the
    /// enclosures, and how far each is proved.
    pub fn to_model(&self, system: &System) -> Vec<SystemEquilibrium> {
        let frame = Frame::new(system, &[]);
        self.equilibria.iter().map(|position| self.one_to_model(system, &frame, position)).collect()
    }

    fn one_to_model(
        &self,
        system: &System,
        frame: &Frame,
        position: &SystemPosition,
    ) -> SystemEquilibrium {
        let middles = |vectors: &[[Interval; 3]]| -> Vec<Point> {
            vectors.iter().map(|vector| vector.map(Interval::mid)).collect()
        };
        let in_newton = |force: &Vector| force.map(|part| part.scale(frame.force_n));
        let loads_n = frame.loads(system).iter().map(in_newton).collect();
        let Balance { ends, jams, .. } =
            balance(system, &position.joints_m, &position.axial_n, loads_n);
        let end = |is_start: bool| {
            let forces = system.members().iter().zip(&ends).map(|(member, pulls)| {
                let pull = pulls[usize::from(!is_start)];
                let share = frame.share(system, member, is_start);
                let share_n = in_newton(&share);
                let pull = if is_start { times(-Interval::ONE, pull) } else { pull };
                minus(pull, share_n)
            });
            middles(&forces.collect::<Vec<_>>())
        };
        let jam = |(member, span, pull): (usize, usize, Vector)| Jam {
            member,
            span,
            pull_n: pull.map(Interval::mid),
        };
        let jams = jams.into_iter().map(jam).collect();
        SystemEquilibrium {
            solver: SolverName::CENSUS,
            energy_j: position.energy_j.mid(),
            joints_m: middles(&position.joints_m),
            start_forces_n: end(true),
            end_forces_n: end(false),
            axial_n: position.axial_n.iter().map(|force| force.mid()).collect(),
            reactions_n: middles(&position.reactions_n),
            stability: SystemStability {
                in_space: if position.index_in_space == 0 {
                    InSpace::Stable
                } else {
                    InSpace::Unstable
                },
                index_in_space: position.index_in_space,
                index_in_plane: position.index_in_plane,
                neutral: usize::from(position.circle),
            },
            evidence: Evidence { jams, ..self.evidence(system, position) },
        }
    }

    fn evidence(&self, system: &System, position: &SystemPosition) -> Evidence {
        let (width_m, width_n) = (position.width_m(), position.width_n());
        let largest_n = position.axial_n.iter().map(|x| x.mag()).fold(f64::MIN_POSITIVE, f64::max);
        let width = (width_m / system.total_length_m()).max(width_n / largest_n);
        let mut evidence =
            Evidence::enclosed("width of the enclosures of joints and forces", width);
        evidence.solve_s = self.seconds;
        let members = system.members().iter().zip(&position.axial_n);
        let slack =
            members.filter(|(m, force)| m.kind != Kind::Bar && **force == Interval::ZERO).count();
        let ladder = &mut evidence.ladder;
        ladder.verified = Status::Reached(Verified {
            box_width: width,
            distance: 0.0,
            circle: false,
            system: Some(VerifiedSystem {
                width_m,
                width_n,
                distance_n: 0.0,
                turns: usize::from(position.circle),
                slack,
                loose_joints: 0,
            }),
        });
        ladder.complete = self.completeness(system);
        ladder.optimal = Status::Open(Reason::NoCertificate(match position.index_in_space {
            0 => NoCertificate::PivotsUndecided,
            directions => NoCertificate::EnergyFalls { directions },
        }));
        evidence
    }

    /// The rung `complete` of every equilibrium of this list.
    pub fn completeness(&self, system: &System) -> Status<Complete> {
        if !self.complete {
            let open = self.chains().find(|chain| !chain.census.complete);
            let boxes = self.nets().map(|net| net.undecided.len()).sum();
            let of_nets = match boxes {
                0 => NoCensus::PlaneOnly,
                boxes => NoCensus::Undecided { boxes },
            };
            let of_nets = Status::Open(Reason::NoCensus(of_nets));
            return open.map_or(of_nets, |chain| chain.census.completeness());
        }
        let two_sided = |member: &&usize| system.members()[**member].kind == Kind::Bar;
        let signs = |part: &PartCensus| {
            let of_chain = part.chain.as_ref().map_or(0, |chain| chain.members.len());
            let of_net = part.net.as_ref().map_or(0, |net| net.swings.len());
            part.hanging.iter().filter(two_sided).count() + of_chain + of_net
        };
        let patterns =
            |signs: usize| 2_u64.saturating_pow(u32::try_from(signs).unwrap_or(u32::MAX));
        let (taut, slack): (Vec<_>, Vec<_>) =
            self.parts.iter().partition(|part| part.slack.is_empty());
        let of_slack = slack.into_iter().map(|part| patterns(signs(part)));
        let of_taut = patterns(taut.iter().map(|part| signs(part)).sum());
        Status::Reached(Complete {
            in_plane: self.equilibria.len(),
            families: self.families(),
            patterns: of_slack.fold(of_taut, u64::saturating_add),
            cells: self.cells(),
            system: Some(CompleteSystem {
                positions: self.equilibria.len(),
                parts: taut.len(),
                hanging: taut.iter().map(|part| part.hanging.len()).sum(),
            }),
        })
    }
}
