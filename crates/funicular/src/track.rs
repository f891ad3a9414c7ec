//! Shapes over a number on a page: a motion, a load path, a study.

use std::collections::BTreeMap;

use model::Vector;
use model::system::System;
use serde::{Serialize, Serializer};

use crate::moving_page::{Topology, flat};

/// Numbers in the frames of one group of tracks: some 300 kB.
const NUMBERS: usize = 60_000;
/// Frames of a group, however large or small the system.
const FRAMES: [usize; 2] = [24, 1000];
/// Steps of a place to either side of the reference point: a tenth of a pixel.
const STEPS: f64 = 8000.0;

/// What moves: a frame for each value of what it is over.
#[derive(Debug, Clone, Default, Serialize)]
pub(crate) struct Track {
    pub group: &'static str,
    pub label: String,
    /// What it is, and what is proved of it.
    pub note: String,
    /// Whether it is over time, s.
    pub motion: bool,
    /// What it is over, with the unit, and the value of each frame.
    pub over: String,
    pub at: Vec<Short>,
    /// Places are whole multiples of this, m.
    pub unit: f64,
    pub x: Vec<Option<Vec<Short>>>,
    pub axial: Vec<Option<Vec<Short>>>,
    /// The bars of each frame, where their number changes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nets: Option<Vec<Option<Topology>>>,
    /// What happens, by the numbers of the frames.
    pub events: BTreeMap<usize, String>,
    pub charts: Vec<Chart>,
}

/// Curves over one another.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Chart {
    pub across: String,
    pub up: String,
    pub curves: Vec<Curve>,
}

/// A curve: what is not given across or up is what the track is over.
#[derive(Debug, Clone, Default, Serialize)]
pub(crate) struct Curve {
    pub label: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<Vec<Short>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<Vec<Short>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stable: Option<Vec<bool>>,
}

impl Curve {
    /// Of what the track is over.
    pub fn up(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        Self { label: label.to_owned(), y: Some(Short::all(values)), ..Self::default() }
    }
}

/// A number as short as it is; what is not finite is null.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Short(f64);

impl Serialize for Short {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[expect(clippy::cast_possible_truncation, reason = "whole, below 2^53")]
        match self.0 {
            x if x.fract() == 0.0 && x.abs() < 9e15 => serializer.serialize_i64(x as i64),
            x => serializer.serialize_f64(x),
        }
    }
}

impl Short {
    /// Six digits.
    pub fn all(values: impl IntoIterator<Item = f64>) -> Vec<Self> {
        values.into_iter().map(|x| Self::digits(x, 6)).collect()
    }

    /// So many behind the point.
    pub fn decimals(x: f64, decimals: i32) -> Self {
        let ten = 10_f64.powi(decimals);
        Self((x * ten).round() / ten)
    }

    /// So many digits.
    pub fn digits(x: f64, digits: usize) -> Self {
        Self(format!("{x:.*e}", digits - 1).parse().unwrap_or(f64::NAN))
    }
}

/// Which of so many frames are kept of each of some tracks of a group: every one, or every second ..., the last,
/// and those that must be.
pub(crate) fn kept(
    system: &System,
    [tracks, frames]: [usize; 2],
    must: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let numbers = 3 * system.joints().len() + system.members().len();
    let most = (NUMBERS / (numbers * tracks).max(1)).clamp(FRAMES[0], FRAMES[1]);
    let every = frames.div_ceil(most).max(1);
    (0..frames).filter(|&k| k % every == 0 || k + 1 == frames || must(k)).collect()
}

impl Track {
    /// The frames: places, m, and axial forces, N, where there are some.
    pub fn of(system: &System, frames: &[Option<(&[Vector], &[f64])>]) -> Self {
        let places: Vec<_> = frames
            .iter()
            .map(|frame| frame.map(|(joints_m, _)| flat(system, joints_m.iter().copied())))
            .collect();
        let far = places.iter().flatten().flatten().fold(0.0, |far: f64, x| far.max(x.abs()));
        let unit = if far > 0.0 { far / STEPS } else { 1.0 };
        let steps = |all: Vec<f64>| all.into_iter().map(|x| Short((x / unit).round())).collect();
        let forces = |axial_n: &[f64]| axial_n.iter().map(|n| Short::digits(*n, 3)).collect();
        Self {
            unit,
            x: places.into_iter().map(|all| all.map(steps)).collect(),
            axial: frames.iter().map(|frame| frame.map(|(_, axial_n)| forces(axial_n))).collect(),
            ..Self::default()
        }
    }
}
