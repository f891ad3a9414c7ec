//! Parameters of the system file on the command line.

use branches::Combine;
use clap::Args;
use funicular::Parameters;

use crate::exit::Result;

/// What a command over parameters varies.
#[derive(Debug, Args)]
pub struct Varied {
    /// A number of the system file and its values: `anchors.end_m.z=-2.9..-0.1:500` (repeatable)
    #[arg(long, value_name = "KEY=VALUES", required = true, allow_hyphen_values = true)]
    pub vary: Vec<String>,
    /// Take the values of several parameters in step instead of in all combinations
    #[arg(long)]
    pub zip: bool,
}

impl Varied {
    /// The parameters.
    pub fn parameters(&self) -> Result<Parameters> {
        let combine = if self.zip { Combine::Zip } else { Combine::Product };
        let none = Ok(Parameters::new().combine(combine));
        Ok(self.vary.iter().fold(none, |all, text| all?.vary(text))?)
    }
}
