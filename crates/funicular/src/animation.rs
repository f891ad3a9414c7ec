//! A motion as one HTML file: play, pause, scrub, turn; members by their forces, trails of the joints,
//! the energies and the distances from the equilibria as curves.

use model::Vector;
use model::system::System;
use motion::Snapshot;
use serde::Serialize;

use crate::equilibria;
use crate::moving_page::{self, Data, eye, flat, six};
use crate::problem::Problem;
use crate::resting::Resting;
use crate::simulate::CENSUS_BARS;

const PAGE: &str = include_str!("animation.html");

/// At rest, for the eye, is what is slower than this part of its largest speed, in an equilibrium
/// what is nearer to it than this part of the total length.
const AT_REST: f64 = 1e-3;

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
    times_s: Vec<f64>,
    frames: Vec<Vec<Vector>>,
    kinetic_j: Vec<f64>,
    potential_j: Vec<f64>,
    /// Axial forces of the members, N, and the speed of the fastest joint, m/s.
    axial_n: Vec<Vec<f64>>,
    speed_m_s: Vec<f64>,
    /// Names of the equilibria, and what tells their distance.
    labels: Vec<String>,
    equilibria: Resting,
    /// For each equilibrium the distances at the stored times, m.
    distances_m: Vec<Vec<f64>>,
}

impl Animation {
    /// Of a system, at no time yet.
    #[must_use]
    pub fn new(system: &System) -> Self {
        Self {
            system: system.clone(),
            times_s: Vec::new(),
            frames: Vec::new(),
            kinetic_j: Vec::new(),
            potential_j: Vec::new(),
            axial_n: Vec::new(),
            speed_m_s: Vec::new(),
            labels: Vec::new(),
            equilibria: Resting::new(system, std::iter::empty()),
            distances_m: Vec::new(),
        }
    }

    /// Show how far the system is from each of its equilibria, too: from those of a complete
    /// census, elsewhere from the stable one. The distance is that of the joint farthest from its
    /// place, m; parts that turn freely about a vertical are turned to face the same way. What the
    /// solvers have no answer to has none. Before the first time is added.
    #[must_use]
    pub fn with_equilibria(mut self, problem: &Problem) -> Self {
        let Ok(found) = equilibria::all(problem, CENSUS_BARS) else { return self };
        self.equilibria = Resting::new(&self.system, std::iter::empty());
        for located in &found.list {
            // A mirror image of a chain that turns freely is the same place.
            if self.equilibria.nearest(&located.found.joints_m).is_none() {
                self.equilibria.add(&located.found.joints_m);
                self.labels.push(located.label.clone());
                self.distances_m.push(Vec::new());
            }
        }
        self
    }

    /// Add a stored time.
    pub fn add(&mut self, at: &Snapshot) {
        self.times_s.push(at.time_s);
        self.frames.push(at.joints_m.clone());
        self.kinetic_j.push(at.kinetic_j);
        self.potential_j.push(at.potential_j);
        self.axial_n.push(at.axial_n.clone());
        let speeds = at.velocities_m_s.iter().map(|[x, y, z]| x.hypot(*y).hypot(*z));
        self.speed_m_s.push(speeds.fold(0.0, f64::max));
        let length_m = self.system.total_length_m();
        for (place, distances) in self.distances_m.iter_mut().enumerate() {
            distances.push(length_m * self.equilibria.distance(place, &at.joints_m));
        }
    }

    /// The HTML of the page.
    #[must_use]
    pub fn page(&self) -> String {
        moving_page::filled(PAGE, self.system.name(), "", &self.data())
    }

    /// Everything that is drawn, as JSON of numbers and of the numbers of equilibria.
    fn data(&self) -> String {
        #[derive(Serialize)]
        struct Near<'a> {
            label: &'a str,
            distance: Vec<f64>,
        }
        #[derive(Serialize)]
        struct Moved<'a> {
            t: Vec<f64>,
            kinetic: Vec<f64>,
            potential: Vec<f64>,
            equilibria: Vec<Near<'a>>,
            x: Vec<Vec<f64>>,
            axial: Vec<Vec<f64>>,
            speed: Vec<f64>,
            ends: String,
            view: f64,
        }
        let numbers = |all: &Vec<f64>| all.iter().copied().map(six).collect::<Vec<_>>();
        let near = self.labels.iter().zip(&self.distances_m);
        let near = near.map(|(label, distances)| Near { label, distance: numbers(distances) });
        let frames = self.frames.iter().map(|frame| flat(&self.system, frame.iter().copied()));
        let moved = Moved {
            t: numbers(&self.times_s),
            kinetic: numbers(&self.kinetic_j),
            potential: numbers(&self.potential_j),
            equilibria: near.collect(),
            x: frames.collect(),
            axial: self.axial_n.iter().map(numbers).collect(),
            speed: numbers(&self.speed_m_s),
            ends: self.ends(),
            view: six(self.view_rad()),
        };
        moving_page::json(&Data::new(&self.system, &moved))
    }

    /// Where it comes to rest, or is at the end.
    fn ends(&self) -> String {
        let Some((time_s, speed)) = self.times_s.last().zip(self.speed_m_s.last()) else {
            return String::new();
        };
        let fastest = self.speed_m_s.iter().copied().fold(0.0, f64::max);
        let far = |distances: &Vec<f64>| distances.last().copied().unwrap_or(f64::NAN);
        let near = self.labels.iter().zip(self.distances_m.iter().map(far));
        let near = near.min_by(|a, b| a.1.total_cmp(&b.1));
        let is_near = |distance: f64| distance <= AT_REST * self.system.total_length_m();
        match near {
            _ if fastest > 0.0 && *speed > AT_REST * fastest => {
                let near = near.map_or_else(String::new, |(label, distance)| {
                    format!(", {} m from equilibrium {label}", eye(distance))
                });
                format!("At the end, after {} s, it still moves{near}.", eye(*time_s))
            }
            Some((label, distance)) if is_near(distance) => {
                format!("It comes to rest in equilibrium {label}.")
            }
            _ => "It comes to rest where no equilibrium is known.".to_owned(),
        }
    }

    /// The turn of the view that shows the widest spread of all joints at all times.
    fn view_rad(&self) -> f64 {
        let all = || self.frames.iter().flatten();
        let count = all().count().max(1) as f64;
        let mean = [0, 1].map(|k| all().map(|x| x[k]).sum::<f64>() / count);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for [x, y, _] in all() {
            let (x, y) = (x - mean[0], y - mean[1]);
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
        }
        0.5 * f64::atan2(2.0 * xy, xx - yy)
    }
}
