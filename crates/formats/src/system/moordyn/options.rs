//! The options of a MoorDyn input file that have a bearing on statics.

use model::STANDARD_GRAVITY_M_S2;

use super::sections::{Section, Sections};
use crate::error::{At, Result, shortened};
use crate::system::among;

/// Gravity, water and floor.
pub(super) struct Options {
    pub(super) gravity_m_s2: f64,
    pub(super) density_kg_m3: f64,
    pub(super) floor_m: Option<f64>,
}

/// Density of water unless the file says another, kg/m^3: MoorDyn's own default.
pub(super) const SEA_WATER: f64 = 1025.0;

/// Time steps, tolerances of the dynamic relaxation, contact with the floor, output: nothing of
/// them at rest above it.
const NO_BEARING: &str = "dtm cfl tscheme kbot kb cbot cb dtic tmaxic cdscaleic threshic icdfac \
    icthresh ictmax writelog writeunits dtout disableoutput disableouttime frictioncoefficient \
    frictiondamping statdynfricscale icgendynamic dtwave";
/// Anything but zero is out of scope.
const ZERO: &[&str] = &["wavekin", "currents", "waterkin"];

impl Options {
    /// Read them; what is not known is refused.
    pub(super) fn read(sections: &Sections<'_>) -> Result<Self> {
        let mut options =
            Self { gravity_m_s2: STANDARD_GRAVITY_M_S2, density_kg_m3: SEA_WATER, floor_m: None };
        for (line, text) in sections.lines(Section::Options) {
            let mut words = text.split_whitespace();
            let (value, name) =
                (words.next().unwrap_or_default(), words.next().unwrap_or_default());
            let at = At::line(sections.file, *line);
            match name.to_lowercase().as_str() {
                "g" | "gravity" => options.gravity_m_s2 = at.positive(name, value)?,
                "wtrdnsty" | "rhow" | "rho" => {
                    options.density_kg_m3 = at.number(name, value)?;
                }
                "wtrdpth" | "depth" => {
                    if value.parse::<f64>().is_err() {
                        return Err(at.out_of_scope(format!("the floor {value:?}")));
                    }
                    options.floor_m = Some(-at.positive(name, value)?);
                }
                known if among(NO_BEARING, known) => {}
                known if ZERO.contains(&known) => {
                    if value.parse::<f64>().map_or(true, |value| value.abs() > 0.0) {
                        return Err(at.out_of_scope(format!("{name} = {value}")));
                    }
                }
                _ => {
                    return Err(at.unknown(format!("the option {:?}", shortened(text.trim()))));
                }
            }
        }
        Ok(options)
    }
}
