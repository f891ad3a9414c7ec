//! What `energy` and the judge say of a load path that `lagrange` has followed.

use branches::Variation;
use energy::net::Critical;
use model::system::{System, SystemEquilibrium};
use rayon::prelude::*;
use serde::Serialize;
use validate::Tolerances;
use validate::systems::judge;

use super::load::{Kind, LoadEvent};

/// Stable points that are minimised from, spread over the path.
const MINIMISED: usize = 8;
/// Systems of more joints are minimised at fewer of them.
const SMALL: usize = 100;
/// A minimum is the point if no joint is farther from it than this part of the size of the system.
const SAME: f64 = 1e-7;
/// A curvature below this part of the largest stiffness of a member on the path is zero: a singular point is known to the square root
/// of rounding, and in it all forces may vanish.
const FLAT: f64 = 1e-6;

/// Points that were looked at, and those of them that `energy` and the judge confirm.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Confirmed {
    /// Points at which the gradient of the energy was taken: all, events too.
    pub points: usize,
    /// Those where it vanishes and the lengths are kept.
    pub critical: usize,
    /// Those where the number of directions in which the energy falls is that of the path; events,
    /// where it changes, and points next to them, where a curvature vanishes to rounding, count as
    /// confirmed.
    pub same_index: usize,
    /// Stable points from whose neighbourhood the energy was minimised.
    pub minimised: usize,
    /// Those of them that are the minimum.
    pub minima: usize,
    /// Limit points and branch points whose least curvature was taken.
    pub singular: usize,
    /// Those where it vanishes.
    pub flat: usize,
    /// The largest violation of the laws of statics at any point, in the units of the judge with the
    /// largest load on the path in the place of that of the point.
    pub statics: f64,
}

impl Confirmed {
    /// Whether nothing contradicts the path.
    pub fn agrees(&self) -> bool {
        self.critical == self.points
            && self.same_index == self.points
            && self.minima == self.minimised
            && self.flat == self.singular
            && self.statics <= Tolerances::project().statics
    }
}

/// A point of a path: values, equilibrium, index, and whether an event happens there.
type Point<'a> = (&'a [f64], &'a SystemEquilibrium, usize, bool);

/// What is seen of a point by itself.
struct Seen {
    load_n: f64,
    statics: f64,
    critical: Option<Critical>,
    /// Whether it is a minimum, where that was looked at.
    minimum: Option<bool>,
}

/// Look at every point of a path: values, equilibrium, index, whether an event happens there.
pub(super) fn confirm(
    variation: &Variation,
    points: &[Point<'_>],
    events: &[LoadEvent],
) -> Confirmed {
    let mut found = Confirmed::default();
    let minimised = minimised(variation.base(), points);
    let look = |(point, minimised): (&Point<'_>, &bool)| {
        let (values, equilibrium, ..) = point;
        let system = variation.unloaded(values).ok()?;
        let critical = energy::net::critical(&system, &equilibrium.joints_m).ok().flatten();
        // Nor does a minimiser tell how far it is from where nothing resists.
        let resists = |found: &Critical| {
            found.curvature_n_m.is_none_or(|n_m| n_m > FLAT * found.stiffest_n_m)
        };
        let looked_at =
            *minimised && critical.as_ref().is_some_and(resists) && !system.is_unloaded();
        Some(Seen {
            load_n: system.total_load_n(),
            statics: judge(&system, equilibrium).largest(),
            minimum: looked_at.then(|| is_minimum(&system, equilibrium)),
            critical,
        })
    };
    let seen: Vec<Option<Seen>> = points.par_iter().zip(&minimised).map(look).collect();
    let most_n = seen.iter().flatten().map(|seen| seen.load_n).fold(0.0, f64::max);
    let critical = seen.iter().flatten().filter_map(|seen| seen.critical);
    let stiffest_n_m = critical.map(|critical| critical.stiffest_n_m).fold(0.0, f64::max);
    for (number, ((_, _, index, event), seen)) in points.iter().zip(&seen).enumerate() {
        let Some(Seen { load_n, statics, critical, minimum }) = seen else { continue };
        let of_most = load_n / most_n.max(f64::MIN_POSITIVE);
        let statics = statics * of_most;
        let worse = statics > found.statics || (statics.is_nan() && of_most > 0.0);
        found.statics = if worse { statics } else { found.statics };
        let Some(critical) = critical else { continue };
        found.points += 1;
        found.critical += usize::from(critical.is_equilibrium());
        // The sign of such a curvature is rounding.
        let flat = critical.curvature_n_m.is_some_and(|n_m| n_m.abs() <= FLAT * stiffest_n_m);
        found.same_index += usize::from(*event || flat || critical.index == *index);
        let smooth = |event: &&LoadEvent| event.kind != Kind::Kink;
        let singular = events.iter().filter(smooth).any(|event| event.point == number);
        if singular && critical.curvature_n_m.is_some() {
            found.singular += 1;
            found.flat += usize::from(flat);
        }
        found.minimised += usize::from(minimum.is_some());
        found.minima += usize::from(*minimum == Some(true));
    }
    found
}

/// The stable points that are minimised from: the last one, next to a limit point, would be a minimum to
/// few digits.
fn minimised(system: &System, points: &[Point<'_>]) -> Vec<bool> {
    let is_stable = |(_, _, index, event): &Point<'_>| *index == 0 && !event;
    let all = points.iter().filter(|point| is_stable(point)).count();
    let large = system.joints().len() > SMALL;
    let every = all.div_ceil(if large { 1 } else { MINIMISED }).max(1);
    let mut stable = 0;
    let chosen = |point| {
        stable += usize::from(is_stable(point));
        is_stable(point) && stable % every == every / 2
    };
    points.iter().map(chosen).collect()
}

/// Whether the energy has its minimum here.
fn is_minimum(system: &System, equilibrium: &SystemEquilibrium) -> bool {
    let at_m = &equilibrium.joints_m;
    let settings = energy::net::Settings::default();
    let Ok(found) = energy::net::minimise_near(system, at_m, &settings) else { return false };
    let same = SAME * system.total_length_m();
    let pairs = found.equilibrium.joints_m.iter().zip(at_m);
    pairs.flat_map(|(a, b)| (0..3).map(move |k| (a[k] - b[k]).abs())).all(|off| off <= same)
}
