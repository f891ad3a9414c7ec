//! Settings that Python says in words.

use funicular::picture::Seen;
use funicular::prelude::{Equations, Solvers, UseCensus};
use funicular::{Distribution, Plane, Spread};
use pyo3::PyErr;

use crate::raise::bad_word;

/// `both`, `lagrange` or `energy`.
pub fn solvers(word: &str) -> Result<Solvers, PyErr> {
    match word {
        "both" => Ok(Solvers::Both),
        "lagrange" => Ok(Solvers::Lagrange),
        "energy" => Ok(Solvers::Energy),
        _ => Err(bad_word("solver", word, &["both", "lagrange", "energy"])),
    }
}

/// `condensed` or `full`.
pub fn equations(word: &str) -> Result<Equations, PyErr> {
    match word {
        "condensed" => Ok(Equations::Condensed),
        "full" => Ok(Equations::Full),
        _ => Err(bad_word("equations", word, &["condensed", "full"])),
    }
}

/// `auto`, `always` or `never`.
pub fn census(word: &str) -> Result<UseCensus, PyErr> {
    match word {
        "auto" => Ok(UseCensus::Auto),
        "always" => Ok(UseCensus::Always),
        "never" => Ok(UseCensus::Never),
        _ => Err(bad_word("census", word, &["auto", "always", "never"])),
    }
}

/// `best`, `front`, `side` or `top`.
pub fn seen(word: &str) -> Result<Seen, PyErr> {
    match word {
        "best" => Ok(Seen::Best),
        "front" => Ok(Seen::Front),
        "side" => Ok(Seen::Side),
        "top" => Ok(Seen::Top),
        _ => Err(bad_word("view", word, &["best", "front", "side", "top"])),
    }
}

/// `uniform`, `sobol` or `grid`.
pub fn spread(word: &str) -> Result<Spread, PyErr> {
    match word {
        "uniform" => Ok(Spread::Uniform),
        "sobol" => Ok(Spread::Sobol),
        "grid" => Ok(Spread::Grid),
        _ => Err(bad_word("spread", word, &["uniform", "sobol", "grid"])),
    }
}

/// `xz`, `yz` or `xy`.
pub fn plane(word: &str) -> Result<Plane, PyErr> {
    match word {
        "xz" => Ok(Plane::Xz),
        "yz" => Ok(Plane::Yz),
        "xy" => Ok(Plane::Xy),
        _ => Err(bad_word("plane", word, &["xz", "yz", "xy"])),
    }
}

/// `uniform`, `normal` or `ends`.
pub fn distribution(word: &str) -> Result<Distribution, PyErr> {
    match word {
        "uniform" => Ok(Distribution::Uniform),
        "normal" => Ok(Distribution::Normal),
        "ends" => Ok(Distribution::Ends),
        _ => Err(bad_word("distribution", word, &["uniform", "normal", "ends"])),
    }
}
