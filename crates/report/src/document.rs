//! The report, chapter by chapter.

use census::{Census, CensusError};
use paper::Reproduction;
use serde::Serialize;
use validate::gallery::Piece;

use crate::block::Block;
use crate::chapters::{
    cases, citing, claims, equations, field, gallery, method, overview, positions, run, scan,
};
use crate::environment::Environment;
use crate::view::View;
use crate::{html, markdown};

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// Occurs when the census of the paper's example fails.
    #[error("the census of the example: {0}")]
    Census(#[from] CensusError),
    /// Occurs when the results hold a number that JSON has no word for.
    #[error("a number of the results cannot be written: {0}")]
    Json(#[from] serde_json::Error),
}

/// The reproduction of the paper, ready to be read.
#[derive(Debug, Clone)]
pub struct Report {
    reproduction: Reproduction,
    census: Census,
    gallery: Vec<Piece>,
    view: String,
    environment: Environment,
}

/// What `results.json` holds.
#[derive(Debug, Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    reproduction: &'a Reproduction,
    environment: &'a Environment,
}

impl Report {
    /// A report of this reproduction, made here.
    ///
    /// # Errors
    /// [`ReportError::Census`] when the equilibria of the example cannot be listed,
    /// [`ReportError::Json`] when a number is not finite.
    pub fn new(reproduction: Reproduction, environment: Environment) -> Result<Self, ReportError> {
        let census = Census::take(&model::cases::paper(), &census::Settings::default())?;
        let view = View::new(&reproduction).fragment()?;
        let gallery = validate::gallery::solve();
        Ok(Self { reproduction, census, gallery, view, environment })
    }

    /// What it was made from.
    pub fn reproduction(&self) -> &Reproduction {
        &self.reproduction
    }

    /// `report.html`: one page that needs nothing else.
    pub fn html(&self) -> String {
        html::page(self.reproduction.paper, &self.chapters(), &self.run())
    }

    /// `report.md`.
    pub fn markdown(&self) -> String {
        self.golden() + "\n" + &markdown::markdown(&self.run())
    }

    /// `report.md` without what differs from run to run and from machine to machine:
    /// `validation/REPORT.md`.
    pub fn golden(&self) -> String {
        markdown::markdown(&self.chapters())
    }

    /// `results.json`.
    ///
    /// # Errors
    /// [`ReportError::Json`], which a finished reproduction does not cause.
    pub fn json(&self) -> Result<String, ReportError> {
        let results = Results { reproduction: &self.reproduction, environment: &self.environment };
        Ok(serde_json::to_string_pretty(&results)? + "\n")
    }

    /// All chapters that are the same in every run.
    fn chapters(&self) -> Vec<Block<'_>> {
        let r = &self.reproduction;
        [
            overview::blocks(r),
            positions::blocks(r, &self.census),
            scan::blocks(r, self.view.clone()),
            claims::blocks(r),
            equations::blocks(r),
            method::blocks(r),
            cases::blocks(r),
            gallery::blocks(&self.gallery),
            field::blocks(r),
            citing::blocks(),
        ]
        .concat()
    }

    /// What differs.
    fn run(&self) -> Vec<Block<'_>> {
        run::blocks(&self.reproduction, &self.environment)
    }
}
