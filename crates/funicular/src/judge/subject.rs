//! What an answer from elsewhere is an answer to.

use std::sync::Arc;

use formats::answer::{Answer, Forces, Joints};
use formats::system::{ForceDensityNet, ForeignSystem};
use model::system::System;

use super::{Finding, ForeignAnswer, Judge, Judged, fit};
use crate::error::Error;
use crate::picture::Seen;
use crate::problem::Problem;

/// What an answer from elsewhere is an answer to: a system, as we have it or as another program's
/// file describes it, or a net of force densities, which becomes a system at the places that are
/// judged.
///
/// ```
/// use formats::system::parse_net;
/// use funicular::judge::{Judge, Subject};
/// // A node of 10 N between two fixed ones 2 m apart; both edges carry 5 N/m times their length.
/// let nodes = "joint,x_m,y_m,z_m,free,force_z_n\n0,-1,0,0,0,0\n1,1,0,0,0,0\n2,0,0,-1,1,-10\n";
/// let edges = "from,to,q_n_m\n0,2,5\n2,1,5\n";
/// let net = parse_net((nodes, "nodes.csv"), (edges, "edges.csv"), "nodes.csv")?;
/// let subject = Subject::net(net, "nodes.csv");
/// let answer = subject.own_answer().expect("a net has one");
/// let ruling = subject.judge(&Judge::new(), answer, &|_| {})?;
/// assert!(ruling.is_confirmed());
/// # Ok::<(), funicular::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Subject(Kind);

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    System { system: System, notes: Vec<String>, floor_m: Option<f64> },
    Net { net: ForceDensityNet, file: String },
}

/// A judgement, with how the subject was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Ruling {
    /// The judgement.
    pub judged: Judged,
    /// Sentences about the reading, and about what the judgement leaves out.
    pub notes: Vec<String>,
    /// A joint on or below a floor that is not part of the system.
    pub on_floor: Option<String>,
}

impl Subject {
    /// A net, and the name of its file for errors.
    pub fn net(net: ForceDensityNet, file: &str) -> Self {
        Self(Kind::Net { net, file: file.to_owned() })
    }

    /// How the file was read.
    pub fn notes(&self) -> Vec<String> {
        match &self.0 {
            Kind::System { notes, .. } => notes.clone(),
            Kind::Net { net, .. } => {
                let note = "each edge is an elastic member that carries its force density times its length at the places \
                            judged";
                std::iter::once(note.to_owned()).chain(net.held_loads()).collect()
            }
        }
    }

    /// The answer that the file has itself: the places of a net.
    pub fn own_answer(&self) -> Option<Answer> {
        let Kind::Net { net, file } = &self.0 else { return None };
        Some(Answer {
            source: file.clone(),
            joints: Joints::InOrder(net.places_m()),
            forces: Forces::None,
            reactions_n: None,
        })
    }

    /// Judge an answer, with `watch` told what is being done.
    ///
    /// # Errors
    /// [`Error::Given`] when names or counts do not fit, [`Error::Format`] when a net is no system
    /// at the places of the answer, [`Error::Tolerance`].
    pub fn judge(
        &self,
        judge: &Judge,
        answer: Answer,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<Ruling, Error> {
        let (system, answer) = self.fitted(answer)?;
        let judged = judge.run_watched(&system.into(), &answer, watch)?;
        let mut notes = self.notes();
        let on_floor = self.floor_m().and_then(|floor_m| joint_on_floor(&judged, floor_m));
        if let Some(joint) = &on_floor {
            notes.push(on_floor_sentence(joint));
        }
        Ok(Ruling { judged, notes, on_floor })
    }

    /// The system at the places of the answer, and the answer in its order.
    fn fitted(&self, answer: Answer) -> Result<(System, ForeignAnswer), Error> {
        match &self.0 {
            Kind::System { system, .. } => Ok((system.clone(), fit(system, answer)?)),
            Kind::Net { net, file } => {
                let answer = fit(&net.system_at(&net.places_m(), file)?, answer)?;
                Ok((net.system_at(&answer.joints_m, file)?, answer))
            }
        }
    }

    fn floor_m(&self) -> Option<f64> {
        match &self.0 {
            Kind::System { floor_m, .. } => *floor_m,
            Kind::Net { .. } => None,
        }
    }
}

impl From<System> for Subject {
    fn from(system: System) -> Self {
        Self(Kind::System { system, notes: vec![], floor_m: None })
    }
}

impl From<&Problem> for Subject {
    fn from(problem: &Problem) -> Self {
        Arc::unwrap_or_clone(problem.system()).into()
    }
}

impl From<ForeignSystem> for Subject {
    fn from(read: ForeignSystem) -> Self {
        let ForeignSystem { system, mut notes, floor_m } = read;
        let beside = |floor_m: f64| format!("the floor at {floor_m} m is not part of the system");
        notes.extend(floor_m.map(beside));
        Self(Kind::System { system, notes, floor_m })
    }
}

impl Ruling {
    /// Whether the answer is no equilibrium of the system, proved.
    pub fn is_refuted(&self) -> bool {
        self.judged.judgement().is_refuted() && self.on_floor.is_none()
    }

    /// Whether the answer is an equilibrium to its own tolerance.
    pub fn is_confirmed(&self) -> bool {
        self.judged.judgement().is_confirmed() && self.on_floor.is_none()
    }

    /// The finding in words: a joint on a floor that is not part of the system leaves it open.
    pub fn finding(&self) -> String {
        match (&self.on_floor, self.judged.judgement().finding) {
            (Some(joint), Finding::Confirmed | Finding::Refuted) => on_floor_sentence(joint),
            (_, finding) => finding.to_string(),
        }
    }

    /// The judgement as a page that needs nothing else, its picture seen from there.
    pub fn html(&self, seen: Seen) -> String {
        self.judged.html(&self.notes, seen)
    }
}

fn on_floor_sentence(joint: &str) -> String {
    format!("undecided: joint {joint} is on or below the floor, which is not part of the system")
}

/// A free joint of the answer, or of the nearest equilibrium, that is not above the floor.
fn joint_on_floor(judged: &Judged, floor_m: f64) -> Option<String> {
    let judgement = judged.judgement();
    let least_m = floor_m + judgement.bounds.position_m;
    let nearest = judgement.nearest().map(|one| &one.equilibrium.joints_m);
    let lists = std::iter::once(&judgement.answer.joints_m).chain(nearest);
    lists
        .flat_map(|places| places.iter().zip(judged.system().joints()))
        .find(|(place, joint)| joint.support.at_m().is_none() && place[2] <= least_m)
        .map(|(_, joint)| joint.name.to_string())
}
