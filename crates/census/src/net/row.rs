//! A system that is one row of bars, with more equilibria than should be held in memory.

use model::system::System;

use super::loaded_chain::LoadedChain;
use super::parts::{Core, parts};
use super::{ChainCensus, PartCensus, SystemCensus};
use crate::error::CensusError;
use crate::run::check::CheckError;
use crate::run::compact::CompactCensus;
use crate::run::estimate::{Estimate, of_chain, refuse_long};
use crate::run::search::Progress;
use crate::settings::Settings;

/// A system that is one row of bars between two anchors, with weights at its joints.
pub struct LoadedRow {
    loaded: LoadedChain,
    joints: Vec<usize>,
    members: Vec<usize>,
}

impl LoadedRow {
    /// Of a system, if it is one ([`as_row`](System::as_row)) whose bars bear their own weight
    /// ([`ChainCensus::whole`](super::ChainCensus::whole)).
    pub fn of(system: &System) -> Option<Self> {
        system.as_row()?;
        let Core::Chain { joints, members } = parts(system, &[]).pop()?.core else { return None };
        let loaded = LoadedChain::new(system, &joints, &members, &[]).ok()?;
        loaded.whole.then_some(Self { loaded, joints, members })
    }

    /// Number of bars.
    pub fn bars(&self) -> usize {
        self.loaded.chain.bars().len()
    }

    /// As [`Census::estimate`](crate::Census::estimate).
    pub fn estimate(&self) -> Estimate {
        of_chain(&self.loaded.chain, &self.loaded.loads)
    }

    /// Why its census is not taken, with what it would take.
    ///
    /// # Errors
    ///
    /// As [`Census::take`](crate::Census::take).
    pub fn refusal(&self, settings: &Settings) -> Result<(), CensusError> {
        settings.validate()?;
        refuse_long(&self.loaded.chain, &self.loaded.loads, settings)
    }

    /// Its census, judged again; and the same without its list of equilibria.
    ///
    /// # Errors
    ///
    /// As [`Census::take`](crate::Census::take).
    pub fn compact(
        &self,
        settings: &Settings,
        watch: &dyn Fn(Progress),
    ) -> Result<(CompactCensus, SystemCensus), CensusError> {
        let Self { loaded: LoadedChain { chain, loads, whole }, joints, members } = self;
        let compact = CompactCensus::of_chain(chain, loads, settings, watch)?;
        let check = compact.check_chain(chain, loads);
        let census = compact.besides().clone();
        let (complete, seconds) = (census.complete, census.statistics.seconds);
        let chain = ChainCensus {
            joints: joints.clone(),
            members: members.clone(),
            census,
            refuted: check.as_ref().is_err_and(CheckError::refutes),
            check: check.map_err(|error| error.to_string()),
            whole: *whole,
        };
        let positions = compact.len();
        let part = PartCensus { positions, chain: Some(chain), ..PartCensus::default() };
        let parts = vec![part];
        Ok((compact, SystemCensus { equilibria: vec![], parts, complete, seconds }))
    }
}
