//! Shapes over numbers of the file on a page: load paths, or where none can be followed a study.

use branches::Number;

use crate::error::Error;
use crate::moving_page::plain;
use crate::parameters::Parameters;
use crate::problem::Problem;
use crate::study::Study;
use crate::trace::Trace;
use crate::trace::load::LoadPaths;
use crate::track::Track;

/// Shapes of a study over a range.
const POINTS: usize = 41;

/// Load paths if they can be followed; else the shapes of a study, with the reason.
pub(crate) fn tracks(problem: &Problem, parameters: &Parameters) -> Result<Vec<Track>, Error> {
    match followed(problem, parameters) {
        Ok(tracks) => Ok(tracks),
        Err(why) => {
            let study = Study::new().over(parameters.sampled(POINTS)).with_shapes();
            let found = study.run(problem)?;
            if found.shapes().next().is_none() {
                return Err(Error::NoShapes(why));
            }
            Ok(found.tracks(&problem.system(), &why))
        }
    }
}

/// The load paths, or why there are none.
fn followed(problem: &Problem, parameters: &Parameters) -> Result<Vec<Track>, String> {
    let trace = Trace::new().over(parameters.clone());
    if !trace.is_load_path(problem) {
        return Err("one is followed over a range alone, such as loads=0..1.2".to_owned());
    }
    let said = |error: Error| error.to_string();
    if trace.load_variation(problem).map_err(said)?.numbers().iter().any(Number::is_count) {
        return Err("none leads from one count to another".to_owned());
    }
    let found = trace.run(problem).map_err(said)?;
    if !found.checks_decided() {
        return Err("it is lost on its way".to_owned());
    }
    if !found.checks_agree() {
        return Err("`energy` does not confirm it".to_owned());
    }
    Ok(found.load_paths().map(LoadPaths::tracks).unwrap_or_default())
}

/// A name with its unit.
pub(crate) fn named(name: &str, unit: &str) -> String {
    match unit {
        "1" => plain(name),
        _ => plain(&format!("{name} / {unit}")),
    }
}
