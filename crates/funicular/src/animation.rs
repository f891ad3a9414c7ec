//! A motion on a page: play, pause, scrub, turn; members by their forces, trails of the joints, the
//! energies and the distances from the equilibria as curves.

use model::Vector;
use model::system::System;
use motion::Snapshot;

use crate::equilibria::{self, Equilibria};
use crate::moving_page::eye;
use crate::page::Page;
use crate::problem::Problem;
use crate::resting::Resting;
use crate::shown::Shown;
use crate::simulate::CENSUS_BARS;
use crate::track::{Chart, Curve, Short, Track, kept};

/// At rest, for the eye, is what is slower than this part of its largest speed, in an equilibrium
/// what is nearer to it than this part of the total length.
const AT_REST: f64 = 1e-3;
/// What is slower than this part of the speed of a fall along all members is rounding.
const ROUNDING: f64 = 1e-9;

/// Collects what an animation shows, time by time.
///
/// ```
/// use funicular::prelude::*;
/// let problem = Problem::case("two-bars")?;
/// let moved = Simulate::new().start(Start::Seed(1)).time_s(0.1).run(&problem)?;
/// let mut animation = funicular::Animation::new(&moved.system);
/// moved.stored.iter().for_each(|at| animation.add(at));
/// let page = animation.page();
/// assert!(page.starts_with("<!DOCTYPE html>") && page.contains("\"bars\":[[0,1],[1,2]]"));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Animation {
    system: System,
    stored: Vec<Stored>,
    /// Names of the equilibria, and what tells their distance.
    labels: Vec<String>,
    equilibria: Resting,
    shown: Shown,
}

/// What is shown of a stored time.
#[derive(Debug, Clone)]
struct Stored {
    time_s: f64,
    joints_m: Vec<Vector>,
    axial_n: Vec<f64>,
    kinetic_j: f64,
    potential_j: f64,
    /// Of the fastest joint.
    speed_m_s: f64,
    /// From each equilibrium.
    distances_m: Vec<f64>,
}

impl Animation {
    /// Of a system, at no time yet.
    pub fn new(system: &System) -> Self {
        Self {
            system: system.clone(),
            stored: Vec::new(),
            labels: Vec::new(),
            equilibria: Resting::new(system, std::iter::empty()),
            shown: Shown::default(),
        }
    }

    /// Show the equilibria as well, with forces, modes and load cases as [`Page`] does, and how far the
    /// system is from each: from those of a complete census, elsewhere from the stable one. The distance
    /// is that of the joint farthest from its place, m; parts that turn freely about a vertical are
    /// turned to face the same way. What the solvers have no answer to has none. Before the first time
    /// is added.
    #[must_use]
    pub fn with_equilibria(self, problem: &Problem) -> Self {
        let Ok(found) = equilibria::all(problem, CENSUS_BARS) else { return self };
        let shown = Page::new().at_rest(problem, &found).map(|(_, shown, _)| shown);
        Self { shown: shown.unwrap_or_default(), ..self.near(&found) }
    }

    /// Measure how far it is from equilibria.
    pub(crate) fn near(mut self, found: &Equilibria) -> Self {
        for located in &found.list {
            // A mirror image of a chain that turns freely is the same place.
            if self.equilibria.nearest(&located.found.joints_m).is_none() {
                self.equilibria.add(&located.found.joints_m);
                self.labels.push(located.label.clone());
            }
        }
        self
    }

    /// Add a stored time.
    pub fn add(&mut self, at: &Snapshot) {
        let speeds = at.velocities_m_s.iter().map(|[x, y, z]| x.hypot(*y).hypot(*z));
        let length_m = self.system.total_length_m();
        let far = |place| length_m * self.equilibria.distance(place, &at.joints_m);
        self.stored.push(Stored {
            time_s: at.time_s,
            joints_m: at.joints_m.clone(),
            axial_n: at.axial_n.clone(),
            kinetic_j: at.kinetic_j,
            potential_j: at.potential_j,
            speed_m_s: speeds.fold(0.0, f64::max),
            distances_m: (0..self.labels.len()).map(far).collect(),
        });
    }

    /// The HTML of the page. Of many times so many are on it that it stays small, and both ends.
    pub fn page(&self) -> String {
        let tracks = vec![self.track()];
        Shown { play: true, tracks, ..self.shown.clone() }.html(&self.system)
    }

    /// The motion, with its energies and distances.
    pub(crate) fn track(&self) -> Track {
        let kept = kept(&self.system, [1, self.stored.len()], |_| false);
        let kept: Vec<_> = kept.into_iter().map(|k| &self.stored[k]).collect();
        let frames = kept.iter().map(|at| Some((&at.joints_m[..], &at.axial_n[..])));
        let curve = |label: &str, of: &dyn Fn(&Stored) -> f64| {
            Curve::up(label, kept.iter().map(|at| of(at)))
        };
        let floor_j = kept.iter().map(|at| at.potential_j).fold(f64::INFINITY, f64::min);
        let energies = vec![
            curve("kinetic energy / J", &|at| at.kinetic_j),
            curve("potential energy above its least / J", &|at| at.potential_j - floor_j),
            curve("their sum / J", &|at| at.kinetic_j + at.potential_j - floor_j),
        ];
        let far = |(place, label): (usize, &String)| {
            curve(&format!("from equilibrium {label} / m"), &move |at| at.distances_m[place])
        };
        let distances: Vec<_> = self.labels.iter().enumerate().map(far).collect();
        let over = "time / s".to_owned();
        let chart = |up: &str, curves| Chart { across: over.clone(), up: up.to_owned(), curves };
        let mut charts = vec![chart("energy / J", energies)];
        if !distances.is_empty() {
            charts.push(chart("distance of the farthest joint / m", distances));
        }
        Track {
            group: "Motion",
            label: "motion".to_owned(),
            note: self.ends(),
            motion: true,
            at: Short::all(kept.iter().map(|at| at.time_s)),
            over,
            charts,
            ..Track::of(&self.system, &frames.collect::<Vec<_>>())
        }
    }

    /// Where it comes to rest, or is at the end.
    fn ends(&self) -> String {
        let Some(last) = self.stored.last() else { return String::new() };
        let fastest = self.stored.iter().map(|at| at.speed_m_s).fold(0.0, f64::max);
        let falls_m_s = (self.system.gravity_m_s2() * self.system.total_length_m()).abs().sqrt();
        let near = self.labels.iter().zip(last.distances_m.iter().copied());
        let near = near.min_by(|a, b| a.1.total_cmp(&b.1));
        let is_near = |distance: f64| distance <= AT_REST * self.system.total_length_m();
        match near {
            _ if fastest > ROUNDING * falls_m_s && last.speed_m_s > AT_REST * fastest => {
                let near = near.map_or_else(String::new, |(label, distance)| {
                    format!(", {} m from equilibrium {label}", eye(distance))
                });
                format!("At the end, after {} s, it still moves{near}.", eye(last.time_s))
            }
            Some((label, distance)) if is_near(distance) => {
                format!("It comes to rest in equilibrium {label}.")
            }
            _ => "It comes to rest where no equilibrium is known.".to_owned(),
        }
    }
}
