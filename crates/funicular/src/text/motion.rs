//! A motion as text: how far it went, and how well its laws were kept.

use std::fmt;

use model::number::Number;
use model::system::System;
use motion::Snapshot;

use super::printable::Printable;
use super::tables::{fitted, short};
use crate::simulate::Motion;

/// What is said of a motion, gathered while it runs.
#[derive(Debug, Clone, Default)]
pub struct Summary {
    stored: usize,
    first_j: f64,
    /// Largest departure of the energy, J, and violations of lengths and laws.
    energy_off_j: f64,
    lengths_off: f64,
    laws_off: f64,
    last_s: f64,
    /// Energy lost in impacts, J; none where there cannot be any.
    lost_j: Option<f64>,
}

impl Summary {
    /// Of no time yet.
    pub fn new(system: &System) -> Self {
        Self { lost_j: motion::has_impacts(system).then_some(0.0), ..Self::default() }
    }

    /// One more stored time.
    pub fn add(&mut self, now: &Snapshot) {
        if self.stored == 0 {
            self.first_j = now.energy_j();
        }
        self.stored += 1;
        self.last_s = now.time_s;
        let kept_j = now.energy_j() + now.lost_j;
        self.energy_off_j = self.energy_off_j.max((kept_j - self.first_j).abs());
        self.lost_j = self.lost_j.map(|_| now.lost_j);
        self.lengths_off = self.lengths_off.max(now.lengths_off);
        self.laws_off = self.laws_off.max(now.laws.largest());
    }

    /// Whether anything but the start is stored.
    pub fn has_begun(&self) -> bool {
        self.stored > 1
    }

    /// The text, of steps that were taken in so many parts each.
    pub fn text(&self, system: &System, interrupted: bool, parts_of_step: u32) -> String {
        let parted = match parts_of_step {
            1 => String::new(),
            parts => format!(", each step in {parts} parts for the elastic members"),
        };
        let ended = if interrupted { ", interrupted" } else { "" };
        let lost = self.lost_j.map_or_else(String::new, |lost_j| {
            format!(", beside {} J lost in impacts", short(lost_j))
        });
        fitted(&format!(
            "{}: {} s{ended}, {} stored times{parted}\n\
             energy at the beginning {} J, then within {} J of it{lost}\n\
             lengths kept to {}, Newton's and Euler's laws to {} of the largest force\n",
            Printable(system.name()),
            short(self.last_s),
            self.stored,
            short(self.first_j),
            if self.energy_off_j < 1e-3 {
                Number::size(self.energy_off_j, 1).to_string()
            } else {
                short(self.energy_off_j)
            },
            Number::size(self.lengths_off, 1),
            Number::size(self.laws_off, 1),
        ))
    }
}

/// As `funicular simulate` prints it.
impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut summary = Summary::new(&self.system);
        self.stored.iter().for_each(|now| summary.add(now));
        f.write_str(&summary.text(&self.system, false, self.parts_of_step))
    }
}
