//! What a census of many equilibria says: written one by one, never held all at once.

use std::io::{self, Write};

use census::net::SystemCensus;
use census::{CompactCensus, Interval};
use model::system::System;
use serde::Serialize;

use super::answer::{CensusAnswer, Each, Found, Item};
use crate::text::census::pattern;

/// What is listed of each equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "program", derive(clap::ValueEnum))]
pub enum List {
    /// Signs, pull, energy and indices of each equilibrium, in a line
    Signs,
    /// Everything of each equilibrium
    Full,
}

/// A census whose equilibria are made from their signs and pulls while they are written: memory
/// does not grow with what is written.
#[derive(Debug, Clone)]
pub struct LargeCensusAnswer {
    /// The census as a whole, its list of equilibria cut off.
    pub first: CensusAnswer,
    /// All equilibria.
    pub proven: CompactCensus,
}

/// An equilibrium by its signs and its pull, from which everything else follows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Its number by energy, from 1; a circle has one.
    pub number: usize,
    /// Energy above the height of joint 0.
    pub energy_j: f64,
    /// `T` for each bar in tension, `C` in compression, `.` for one that carries next to nothing.
    pub pattern: String,
    /// Intervals that hold the pull of the chain on the first anchor, level and upright.
    pub pull_n: [Interval; 2],
    /// Directions in the plane in which the energy falls.
    pub index_in_plane: usize,
    /// Directions in space in which the energy falls.
    pub index_in_space: usize,
    /// Whether it is proved that no configuration has less energy.
    pub optimal: bool,
}

impl LargeCensusAnswer {
    /// Put together from both censuses, so many equilibria of `first` made.
    pub(super) fn new(
        system: &System,
        (proven, cut_off): (CompactCensus, SystemCensus),
        made: usize,
    ) -> Self {
        let mut first = CensusAnswer::new(system, cut_off);
        let summary = &mut first.census;
        summary.decided = proven.decided();
        summary.count = proven.count_in_plane();
        for chain in summary.parts.iter_mut().filter_map(|part| part.chain.as_mut()) {
            chain.decided = summary.decided;
            chain.count_in_plane = summary.count;
            chain.circle_count = summary.circles.then_some(proven.len());
            chain.count_by_index = proven.count_by_index();
            chain.alternating_sum = proven.alternating_sum();
        }
        let mut answer = Self { first, proven };
        answer.first.equilibria = answer.found(made).collect();
        answer
    }

    /// The first so many equilibria with everything that is known of them, in the order of the census; of a
    /// circle both its mirror images. Each is made when it is asked for.
    fn found(&self, number: usize) -> impl Iterator<Item = Found> + '_ {
        let at = (0..self.proven.len().min(number)).flat_map(|k| self.proven.positions(k));
        let row = self.first.as_row();
        at.filter_map(move |at| Some(row.as_ref()?.found(self.proven.position_to_model(&at), &at)))
    }

    /// All equilibria by their signs and pulls, circles once.
    pub fn lines(&self) -> impl Iterator<Item = Line> + '_ {
        (0..self.proven.len()).map(|k| Line::of(&self.proven, k))
    }

    /// Write the census as JSON. With [`List::Full`] it is that of [`CensusAnswer`]; with
    /// [`List::Signs`] the key `list` says so, each equilibrium is a [`Line`], and has one.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_json(&self, list: List, to: &mut impl Write) -> io::Result<()> {
        match list {
            List::Signs => self.write_lines(to),
            List::Full => {
                let object = self.first.object(None, Each(|| self.items()));
                serde_json::to_writer_pretty(&mut *to, &object)?;
                to.write_all(b"\n")
            }
        }
    }

    /// Each equilibrium in a line.
    fn write_lines(&self, to: &mut impl Write) -> io::Result<()> {
        const LIST: &str = "\"equilibria\": [";
        let all = serde_json::to_string_pretty(&self.first.object(Some("signs"), [(); 0]))?;
        let (before, behind) = all.split_once(LIST).unwrap_or_default();
        write!(to, "{before}{LIST}")?;
        for (k, line) in self.lines().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            write!(to, "{comma}\n    {}", serde_json::to_string(&line)?)?;
        }
        writeln!(to, "\n  {behind}")
    }

    /// All equilibria as JSON has them.
    fn items(&self) -> impl Iterator<Item = Item<'_, Found>> {
        self.found(usize::MAX).map(|found| Item(self.first.system(), found))
    }

    /// Write the equilibria as CSV: with [`List::Full`] as
    /// [`write_csv`](CensusAnswer::write_csv), with [`List::Signs`] a line per equilibrium, the
    /// pull by the middles of its enclosures.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_csv(&self, list: List, to: &mut impl Write) -> io::Result<()> {
        match list {
            List::Signs => {
                write!(to, "equilibrium,energy_j,index_in_plane,index_in_space,optimal,pattern,")?;
                writeln!(to, "pull_level_n,pull_upright_n")?;
                self.lines().try_for_each(|line| line.write_csv(to))
            }
            List::Full => self.first.write_list(self.found(usize::MAX), to),
        }
    }

    /// How many bytes of JSON the list takes, from its first equilibria.
    pub fn expected_bytes(&self, list: List) -> f64 {
        /// As many as speak for all.
        const SAMPLE: usize = 16;
        let (all, text) = match list {
            List::Signs => {
                let sample: Vec<Line> = self.lines().take(SAMPLE).collect();
                (self.proven.len(), serde_json::to_string(&sample))
            }
            List::Full => {
                let sample: Vec<_> = self.items().take(SAMPLE).collect();
                (self.proven.count_in_plane(), serde_json::to_string_pretty(&sample))
            }
        };
        let bytes = text.map_or(0, |text| text.len());
        bytes as f64 * all as f64 / all.clamp(1, SAMPLE) as f64
    }
}

impl Line {
    fn of(proven: &CompactCensus, number: usize) -> Self {
        let whole = proven.equilibrium(number);
        Self {
            number: number + 1,
            energy_j: whole.energy_j.mid(),
            pattern: pattern(&whole.signs),
            pull_n: whole.pull_n,
            index_in_plane: whole.index_in_plane,
            index_in_space: whole.index_in_space(),
            optimal: whole.optimal,
        }
    }

    fn write_csv(&self, to: &mut impl Write) -> io::Result<()> {
        let Self { number, energy_j, index_in_plane, index_in_space, optimal, pattern, .. } = self;
        let [level, upright] = self.pull_n.map(Interval::mid);
        write!(to, "{number},{energy_j:?},{index_in_plane},{index_in_space},")?;
        writeln!(to, "{optimal},{pattern},{level:?},{upright:?}")
    }
}
