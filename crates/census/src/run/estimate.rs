//! What a census would take, from that of some of its patterns.
//!
//! Chains of one length differ by a hundred times: few patterns close a taut chain. So the search
//! is made for a sample of the patterns, and one of a quarter of it. The number of zeros is in
//! proportion to that of the patterns; the number of cells, which patterns share, grows as a power
//! that the two samples tell. (D. E. Knuth, "Estimating the efficiency of backtrack programs",
//! Math. Comp. 29 (1975) 121-136, doi:10.1090/S0025-5718-1975-0373371-6, samples the tree of a
//! search likewise.)

use model::{Chain, Problem};

use crate::error::CensusError;
use crate::run::closure::Pattern;
use crate::run::plane::loads::JointLoads;
use crate::run::plane::system::System;
use crate::run::search::{Search, Settled, search};
use crate::run::slack::straight::Straight;
use crate::run::slack::unloaded::Unloaded;
use crate::run::{Census, GROWTH};
use crate::settings::Settings;

/// Patterns of the sample, and of a quarter of it.
const SAMPLE: u32 = 1_024;
const QUARTER: u32 = SAMPLE / 4;

/// Processor time for each cell and bar, s. Measured on random chains of 10 to 16 bars
/// (`examples/census_speed.rs`, time of the processor): 0.9 to 1.1 µs, the proofs included.
const CELL_S: f64 = 1e-6;

/// Memory for each equilibrium and bar, GB: six intervals of positions and forces, an angle, a
/// force and what holds them, and the neighbourhood.
const EQUILIBRIUM_GB: f64 = 3e-7;

/// Beyond the bars of any census it grows from that of sixteen bars, measured on random chains.
const SIXTEEN_BARS: Estimate = Estimate { seconds: 13.0, gigabytes: 0.5, equilibria: 1e5 };

/// What a census would take. Cells and equilibria are good to a factor of two; the processor time
/// of the program was 0.6 to 7.4 times the seconds on 24 random chains of 13 to 16 bars, and 4.7
/// times on one of 20, on a busy machine.
///
/// ```
/// use census::Census;
/// use model::{Anchors, Bar, Chain, Problem};
/// let bars = vec![Bar::homogeneous(1.0, 1.0)?; 14];
/// let seconds = |span| -> Result<f64, Box<dyn std::error::Error>> {
///     let anchors = Anchors { start_m: [0.0; 3], end_m: [span, 0.0, 0.3] };
///     let chain = Chain::new("fourteen", 9.81, anchors, bars.clone())?;
///     Ok(Census::estimate(&Problem::new(chain)?).seconds)
/// };
/// // Few patterns of compression reach as far as a taut chain.
/// assert!(seconds(13.1)? < 0.1 * seconds(4.1)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Time of one processor, s.
    pub seconds: f64,
    /// Memory, GB; a [`CompactCensus`](crate::CompactCensus) takes less.
    pub gigabytes: f64,
    /// Equilibria, those of a circle counted once.
    pub equilibria: f64,
}

impl Census {
    /// What the census of a chain would take. Takes a fraction of a second itself for chains of up
    /// to [`Settings::MAX_BARS`] bars; those of more are not looked at.
    pub fn estimate(problem: &Problem) -> Estimate {
        of_chain(problem.chain(), JointLoads::NONE)
    }
}

pub(crate) fn of_chain(chain: &Chain, loads: &JointLoads) -> Estimate {
    let bars = chain.bars().len();
    if bars > Settings::MAX_BARS {
        // Beyond 600 bars more the numbers overflow; the message stays finite.
        let times = GROWTH.powf((bars as f64 - 16.0).min(600.0));
        let Estimate { seconds, gigabytes, equilibria } = SIXTEEN_BARS;
        return Estimate {
            seconds: seconds * times,
            gigabytes: gigabytes * times,
            equilibria: equilibria * times,
        };
    }
    let system = System::new(chain, loads);
    let all = 1_u32 << bars;
    let [few, many] = [QUARTER, SAMPLE].map(|number| sampled(&system, number.min(all)));
    let cells = |search: &Search| search.cells as f64;
    let power = (cells(&many) / cells(&few)).log(f64::from(SAMPLE) / f64::from(QUARTER));
    let times = f64::from(all) / f64::from(SAMPLE.min(all));
    let equilibria = many.found.len() as f64 * times;
    Estimate {
        seconds: CELL_S * bars as f64 * cells(&many) * times.powf(power.clamp(0.0, 1.0)),
        gigabytes: EQUILIBRIUM_GB * bars as f64 * equilibria,
        equilibria,
    }
}

/// The search for so many patterns, spread evenly: multiples of an odd number near the golden part
/// of 2³², by whose last bits all patterns come once.
fn sampled(system: &System, number: u32) -> Search {
    const STEP: u32 = 0x9e37_79b9;
    let last = u32::MAX >> (u32::BITS - u32::try_from(system.bars()).unwrap_or(u32::BITS));
    let mut patterns: Vec<Pattern> =
        (0..number).map(|k| Pattern(k.wrapping_mul(STEP) & last)).collect();
    patterns.sort_unstable();
    let (unloaded, straight) = (Unloaded::default(), Straight::default());
    let settled = Settled { unloaded: &unloaded, straight: &straight };
    // What cannot be decided must not take the time of a census.
    let settings = Settings { max_tests_per_pattern: 2_000, ..Settings::default() };
    search(system, &settings, &settled, &patterns, &|_| {})
}

/// Refuse a chain of more bars than the settings allow, with what its census would take.
pub(crate) fn refuse_long(
    chain: &Chain,
    loads: &JointLoads,
    settings: &Settings,
) -> Result<(), CensusError> {
    let bars = chain.bars().len();
    if bars <= settings.max_bars {
        return Ok(());
    }
    let Estimate { seconds, gigabytes, .. } = of_chain(chain, loads);
    Err(CensusError::TooManyBars {
        bars,
        max_bars: settings.max_bars,
        patterns: 2.0_f64.powf((bars as f64).min(600.0)),
        estimate_s: seconds,
        estimate_gb: gigabytes,
    })
}

#[cfg(test)]
mod tests {
    use model::{Anchors, Bar};

    use super::*;

    /// Of twelve bars the larger sample is to all patterns as the smaller one to it: what the power
    /// of the one step multiplies the cells by, it does so in the next.
    #[test]
    fn cells_grow_on_as_from_the_one_sample_to_the_other() {
        let lengths = [0.9, 0.4, 0.7, 0.5, 1.0, 0.6, 0.8, 0.3, 0.55, 0.95, 0.45, 0.75];
        let bars = lengths.map(|length| (length, 2.0 - length));
        let chain = samples::homogeneous(10.0, &bars, [2.5, 0.0, 0.7]).into_chain();
        let system = System::new(&chain, JointLoads::NONE);
        let [few, many] = [256, 1_024].map(|number| sampled(&system, number).cells as f64);
        assert!(few < many && many < 4.0 * few, "{few} {many}");
        let found = of_chain(&chain, JointLoads::NONE).seconds;
        let expected = 1e-6 * 12.0 * many * (many / few);
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }

    /// Twenty-six bars are not looked at: ten more than sixteen, each of which takes 2.1 times as much.
    #[test]
    fn what_no_census_takes_is_told_from_sixteen_bars() {
        let long = |bars: usize| {
            let bar = Bar::homogeneous(1.0, 1.0).unwrap();
            let anchors = Anchors { start_m: [0.0; 3], end_m: [3.0, 0.0, 0.0] };
            Chain::new("long", 10.0, anchors, vec![bar; bars]).unwrap()
        };
        let told = |bars: usize, max_bars: usize| {
            let settings = Settings { max_bars, ..Settings::default() };
            refuse_long(&long(bars), JointLoads::NONE, &settings)
        };
        let times = 2.1_f64.powi(10);
        let Err(CensusError::TooManyBars { bars, max_bars, patterns, estimate_s, estimate_gb }) =
            told(26, 24)
        else {
            panic!()
        };
        assert_eq!((bars, max_bars), (26, 24));
        for (found, wanted) in
            [(patterns, 67_108_864.0), (estimate_s, 13.0 * times), (estimate_gb, 0.5 * times)]
        {
            assert!((found / wanted - 1.0).abs() < 1e-12, "{found}, not {wanted}");
        }
        assert!(
            (of_chain(&long(26), JointLoads::NONE).equilibria / (1e5 * times) - 1.0).abs() < 1e-12
        );
        assert!(told(3, 3).is_ok() && told(3, 2).is_err());
        // However long the message stays finite.
        let Err(CensusError::TooManyBars { patterns, estimate_s, .. }) = told(2_000, 24) else {
            panic!()
        };
        assert!(patterns.is_finite() && estimate_s.is_finite() && estimate_s > 1e190);
    }
}
