//! Settings that Python says in words.

use funicular::picture::Seen;
use funicular::prelude::{Equations, Solvers, UseCensus};
use funicular::{Distribution, Format, Plane, Spread};
use pyo3::PyResult;

use crate::raise::bad_word;

/// The setting that a word stands for.
fn one<T: Copy, const N: usize>(
    setting: &'static str,
    word: &str,
    all: [(&'static str, T); N],
) -> PyResult<T> {
    let found = all.iter().find(|(known, _)| *known == word);
    let found = found.map(|(_, value)| *value);
    found.ok_or_else(|| bad_word(setting, word, &all.map(|(known, _)| known)))
}

pub fn solvers(word: &str) -> PyResult<Solvers> {
    use Solvers::{Both, Energy, Lagrange};
    one("solver", word, [("both", Both), ("lagrange", Lagrange), ("energy", Energy)])
}

pub fn equations(word: &str) -> PyResult<Equations> {
    one("equations", word, [("condensed", Equations::Condensed), ("full", Equations::Full)])
}

pub fn census(word: &str) -> PyResult<UseCensus> {
    use UseCensus::{Always, Auto, Never};
    one("census", word, [("auto", Auto), ("always", Always), ("never", Never)])
}

pub fn seen(word: &str) -> PyResult<Seen> {
    use Seen::{Best, Front, Side, Top};
    one("view", word, [("best", Best), ("front", Front), ("side", Side), ("top", Top)])
}

pub fn spread(word: &str) -> PyResult<Spread> {
    use Spread::{Grid, Sobol, Uniform};
    one("spread", word, [("uniform", Uniform), ("sobol", Sobol), ("grid", Grid)])
}

pub fn plane(word: &str) -> PyResult<Plane> {
    one("plane", word, [("xz", Plane::Xz), ("yz", Plane::Yz), ("xy", Plane::Xy)])
}

pub fn distribution(word: &str) -> PyResult<Distribution> {
    use Distribution::{Ends, Normal, Uniform};
    one("distribution", word, [("uniform", Uniform), ("normal", Normal), ("ends", Ends)])
}

pub fn format(word: &str) -> PyResult<Format> {
    one("format", word, [("parquet", Format::Parquet), ("csv", Format::Csv)])
}
