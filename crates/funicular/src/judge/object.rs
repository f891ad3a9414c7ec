//! A judgement as JSON: the keys of [`Judgement`], with names and sentences beside its numbers.

use model::Vector;
use model::system::{Name, System};
use serde::{Serialize, Serializer};
use validate::foreign::{Judgement, Violation};

use super::Judged;
use crate::object::head;
use crate::weakest::Weakest;

#[derive(Serialize)]
struct Object<'a> {
    #[serde(flatten, serialize_with = "head")]
    system: &'a System,
    says: String,
    broken: Vec<Broken<'a>>,
    #[serde(flatten)]
    judgement: &'a Judgement,
    joints: Vec<Joint<'a>>,
    bars: Vec<Bar<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    weakest: Option<Weakest>,
}

#[derive(Serialize)]
struct Broken<'a> {
    at: String,
    says: String,
    #[serde(flatten)]
    violation: &'a Violation,
}

#[derive(Serialize)]
struct Joint<'a> {
    name: &'a Name,
    at_m: Vector,
    reaction_n: Vector,
}

#[derive(Serialize)]
struct Bar<'a> {
    from: &'a Name,
    to: &'a Name,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    via: Vec<&'a Name>,
    axial_n: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    utilisation: Option<f64>,
}

impl Serialize for Judged {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (system, judgement) = (self.system(), self.judgement());
        let name = |joint: usize| &system.joints()[joint].name;
        let broken = |violation| Broken {
            at: Violation::place_in(violation, system),
            says: violation.what(),
            violation,
        };
        let answer = &judgement.answer;
        let places = answer.joints_m.iter().zip(&answer.reactions_n).enumerate();
        Object {
            system,
            says: judgement.finding.to_string(),
            broken: judgement.violations.iter().map(broken).collect(),
            judgement,
            joints: places
                .map(|(k, (at_m, force))| Joint { name: name(k), at_m: *at_m, reaction_n: *force })
                .collect(),
            bars: system
                .members()
                .iter()
                .enumerate()
                .map(|(k, m)| Bar {
                    from: name(m.from),
                    to: name(m.to),
                    via: m.via().iter().map(|joint| name(*joint)).collect(),
                    axial_n: answer.axial_n[k],
                    utilisation: answer.utilisation(system, k),
                })
                .collect(),
            weakest: self.weakest(),
        }
        .serialize(serializer)
    }
}
