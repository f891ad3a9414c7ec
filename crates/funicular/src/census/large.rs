//! What a census of many equilibria says: written one by one, never held all at once.

use std::io::{self, Write};

use census::{CheckError, CompactCensus};
use model::{Problem, SystemSummary};
use serde::{Serialize, Serializer};

use super::answer::{ChainCensusAnswer, Enclosure, Found, Summary};
use super::{csv, lines};
use crate::solve::SCHEMA_VERSION;

/// What is listed of each equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum List {
    /// Signs, pull, energy and indices: everything else follows from the signs and the pull.
    Signs,
    /// Everything.
    Full,
}

/// A census whose equilibria are made from their signs and pulls while they are written: memory
/// does not grow with what is written.
#[derive(Debug, Clone)]
pub struct LargeCensusAnswer {
    /// The census as a whole, its list of equilibria cut off.
    pub first: ChainCensusAnswer,
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
    pub pull_n: [Enclosure; 2],
    /// Directions in the plane in which the energy falls.
    pub index_in_plane: usize,
    /// Directions in space in which the energy falls.
    pub index_in_space: usize,
    /// Whether it is proved that no configuration has less energy.
    pub optimal: bool,
}

impl LargeCensusAnswer {
    /// Put together from a census and the verdict of its check, so many equilibria of `first` made.
    #[must_use]
    pub fn new(
        problem: &Problem,
        proven: CompactCensus,
        verdict: Result<(), CheckError>,
        made: usize,
    ) -> Self {
        let few = (0..proven.len().min(made)).flat_map(|k| found(problem, &proven, k)).collect();
        let mut first = ChainCensusAnswer::with(problem, proven.first(made), few, verdict);
        let summary = &mut first.census;
        summary.decided = proven.decided();
        summary.count = proven.count_in_plane();
        summary.circle_count = summary.circles.then_some(proven.len());
        summary.count_by_index = proven.count_by_index().to_vec();
        summary.alternating_sum = proven.alternating_sum();
        Self { first, proven }
    }

    /// All equilibria with everything that is known of them, in the order of the census; of a
    /// circle both its mirror images. Each is made when it is asked for.
    pub fn found(&self) -> impl Iterator<Item = Found> + '_ {
        (0..self.proven.len()).flat_map(|k| found(&self.first.problem, &self.proven, k))
    }

    /// All equilibria by their signs and pulls, circles once.
    pub fn lines(&self) -> impl Iterator<Item = Line> + '_ {
        (0..self.proven.len()).map(|k| Line::of(&self.proven, k))
    }

    /// Write the census as JSON. With [`List::Full`] it is that of [`ChainCensusAnswer`]; with
    /// [`List::Signs`] the key `list` says so, each equilibrium is a [`Line`], and has one.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_json(&self, list: List, to: &mut impl Write) -> io::Result<()> {
        match list {
            List::Signs => lines::write(to, &self.object(Some("signs"), Each(|| self.lines()))),
            List::Full => {
                let object = self.object(None, Each(|| self.found()));
                serde_json::to_writer_pretty(&mut *to, &object)?;
                to.write_all(b"\n")
            }
        }
    }

    fn object<E>(&self, list: Option<&'static str>, equilibria: E) -> Object<'_, E> {
        let (system, census) = (&self.first.system, &self.first.census);
        Object { schema_version: SCHEMA_VERSION, system, list, equilibria, census }
    }

    /// Write the equilibria as CSV: with [`List::Full`] as
    /// [`write_csv`](ChainCensusAnswer::write_csv), with [`List::Signs`] a line per equilibrium, the
    /// pull by the middles of its enclosures.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_csv(&self, list: List, to: &mut impl Write) -> io::Result<()> {
        match list {
            List::Signs => {
                write!(to, "equilibrium,energy_j,index_in_plane,index_in_space,optimal,pattern,")?;
                writeln!(to, "pull_level_n,pull_upright_n")?;
                self.lines().try_for_each(|line| line.write_csv(to))
            }
            List::Full => {
                csv::write_head(to)?;
                self.found().try_for_each(|found| csv::write_rows(to, &found))
            }
        }
    }

    /// How many bytes of JSON the list takes, from its first equilibria.
    #[must_use]
    pub fn expected_bytes(&self, list: List) -> f64 {
        /// As many as speak for all.
        const SAMPLE: usize = 16;
        let (bytes, sample) = match list {
            List::Signs => {
                let sample: Vec<Line> = self.lines().take(SAMPLE).collect();
                let mut text = vec![];
                (lines::write(&mut text, &sample).map_or(0, |()| text.len()), sample.len())
            }
            List::Full => {
                let sample: Vec<Found> = self.found().take(SAMPLE).collect();
                (serde_json::to_string_pretty(&sample).map_or(0, |text| text.len()), sample.len())
            }
        };
        let all = match list {
            List::Signs => self.proven.len(),
            List::Full => self.proven.count_in_plane(),
        };
        bytes as f64 * all as f64 / sample.max(1) as f64
    }
}

fn found<'a>(
    problem: &'a Problem,
    proven: &'a CompactCensus,
    number: usize,
) -> impl Iterator<Item = Found> + 'a {
    let positions = proven.positions(number);
    positions.map(move |at| Found::of(problem, proven.position_to_model(&at), &at))
}

impl Line {
    fn of(proven: &CompactCensus, number: usize) -> Self {
        let outline = proven.outline(number);
        let letter = |sign: &i8| match sign {
            1 => 'T',
            -1 => 'C',
            _ => '.',
        };
        Self {
            number: number + 1,
            energy_j: outline.energy_j.mid(),
            pattern: outline.signs.iter().map(letter).collect(),
            pull_n: outline.pull_n.map(|part| [part.lo(), part.hi()]),
            index_in_plane: outline.index_in_plane,
            index_in_space: outline.index_in_plane + outline.index_out_of_plane,
            optimal: outline.optimal,
        }
    }

    fn write_csv(&self, to: &mut impl Write) -> io::Result<()> {
        let Self { number, energy_j, index_in_plane, index_in_space, optimal, pattern, .. } = self;
        let [level, upright] = self.pull_n.map(|[low, high]| 0.5 * low + 0.5 * high);
        write!(to, "{number},{energy_j:?},{index_in_plane},{index_in_space},")?;
        writeln!(to, "{optimal},{pattern},{level:?},{upright:?}")
    }
}

#[derive(Serialize)]
struct Object<'a, E> {
    schema_version: u32,
    system: &'a SystemSummary,
    #[serde(skip_serializing_if = "Option::is_none")]
    list: Option<&'static str>,
    equilibria: E,
    census: &'a Summary,
}

/// A list whose items are made while it is written.
struct Each<F>(F);

impl<F: Fn() -> I, I: Iterator<Item: Serialize>> Serialize for Each<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((self.0)())
    }
}
