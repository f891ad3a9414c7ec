//! How far the force of each member is open.
//!
//! Where self-stresses exist the forces in balance are $N + B z$, with the basis $B$ and any $z$
//! that lets no cable push and no strut or floor pull. The least and the largest force of a member are two
//! linear programmes in as few unknowns as there are self-stresses. They start from forces that
//! obey all signs: every member's force as a linear function of the
//! unknowns, which an exchange step (Dantzig) replaces one by one by members at their limits.

use model::ForceRange;
use model::system::Kind;

use super::framework::Framework;
use super::solution::NO_FORCE;
use super::state::State;
use crate::thresholds::ZERO;

/// Exchange steps of one programme, in units of its unknowns and conditions together. Some two
/// are the rule.
pub(super) const MOST_EXCHANGES: usize = 50;

/// The range of every member's axial force over all forces in balance with the right signs, which are these and self-stresses.
pub(super) fn ranges(
    framework: &Framework,
    state: &State,
    basis: &[Vec<f64>],
) -> Option<Vec<ForceRange>> {
    let table = Table::new(framework, state, basis);
    // Each from the same table, whose rounding many exchanges would make worse.
    (0..framework.members()).map(|member| table.clone().range(member)).collect()
}

/// Forces of all members, and pushes of the floor, as functions of the unknowns, $N_k = d_k + \sum_j T_{kj} t_j$. An unknown
/// is free, or the force of a member with a sign, which is then at its limit.
#[derive(Clone)]
struct Table {
    /// 1 where the force must not be negative, -1 where it must not be positive, 0 for bars. Rows
    /// of negative sign stand negated in the table.
    signs: Vec<f64>,
    values: Vec<f64>,
    rows: Vec<Vec<f64>>,
    free: Vec<bool>,
    unit_n: f64,
    unique: Vec<bool>,
}

/// End of one programme.
enum Extreme {
    /// The force there, N.
    At(f64),
    Unbounded,
    /// The exchanges came to no end.
    Undecided,
}

impl Table {
    fn new(framework: &Framework, state: &State, basis: &[Vec<f64>]) -> Self {
        // Behind the forces of the members those of the floor, of which none pulls.
        let directions = state.directions(framework);
        let by_stress = |stress: &Vec<f64>| {
            [stress.clone(), framework.pushes_of_stress(&directions, stress)].concat()
        };
        let basis: Vec<Vec<f64>> = basis.iter().map(by_stress).collect();
        let forces = [state.axial.clone(), framework.pushes(&directions, &state.axial)].concat();
        let largest = forces.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
        let largest = if largest > 0.0 { largest } else { 1.0 };
        let signs: Vec<f64> = framework
            .links
            .iter()
            .map(|link| match link.kind {
                Kind::Bar => 0.0,
                Kind::Cable => 1.0,
                Kind::Strut => -1.0,
            })
            .chain(framework.lying.iter().map(|_| 1.0))
            .collect();
        let turn = |k: usize| if signs[k] < 0.0 { -1.0 } else { 1.0 };
        let rows: Vec<Vec<f64>> = (0..signs.len())
            .map(|k| basis.iter().map(|stress| turn(k) * stress[k]).collect())
            .collect();
        let unique = rows.iter().map(|row| row.iter().all(|t| t.abs() <= ZERO)).collect();
        let value = |k: usize| {
            let value = turn(k) * forces[k] / largest;
            // A force of the wrong sign by rounding counts as zero.
            if signs[k] != 0.0 && value < NO_FORCE { 0.0 } else { value }
        };
        let values = (0..signs.len()).map(value).collect();
        let unit_n = largest * framework.units.force_n;
        Self { values, rows, free: vec![true; basis.len()], unit_n, unique, signs }
    }

    /// Nothing when the exchanges come to no end.
    fn range(&mut self, member: usize) -> Option<ForceRange> {
        if self.unique[member] {
            return Some(ForceRange::Unique);
        }
        let mut limit = |direction| match self.extreme(member, direction) {
            Extreme::At(force) => Some(Some(force)),
            Extreme::Unbounded => Some(None),
            Extreme::Undecided => None,
        };
        let (low, high) = (limit(-1.0)?, limit(1.0)?);
        let negated = |force: Option<f64>| force.map(|n| -n);
        let turned = self.signs[member] < 0.0;
        let (least_n, most_n) = if turned { (negated(high), negated(low)) } else { (low, high) };
        Some(match (least_n, most_n) {
            (None, None) => ForceRange::Free,
            (Some(low), Some(high)) if high - low <= NO_FORCE * self.unit_n => ForceRange::Unique,
            _ => ForceRange::Bounded { least_n, most_n },
        })
    }

    /// The largest value of a row, or the least for the direction -1.
    fn extreme(&mut self, member: usize, direction: f64) -> Extreme {
        for _ in 0..MOST_EXCHANGES * (self.free.len() + self.rows.len()) {
            let Some((unknown, way)) = self.entering(member, direction) else {
                return Extreme::At(self.values[member] * self.unit_n);
            };
            let Some(limit) = self.limit(unknown, way) else { return Extreme::Unbounded };
            self.exchange(limit, unknown);
        }
        Extreme::Undecided
    }

    /// The first unknown whose change improves a row, and which way (Bland's rule, which does not
    /// cycle).
    fn entering(&self, member: usize, direction: f64) -> Option<(usize, f64)> {
        let row = &self.rows[member];
        (0..row.len()).find_map(|j| {
            let gain = direction * row[j];
            let improves = gain > ZERO || (self.free[j] && gain < -ZERO);
            improves.then_some((j, gain.signum()))
        })
    }

    /// The first of the members that reach their limit soonest.
    fn limit(&self, unknown: usize, way: f64) -> Option<usize> {
        let mut first: Option<(f64, usize)> = None;
        for (k, row) in self.rows.iter().enumerate() {
            let fall = -way * row[unknown];
            if self.signs[k] != 0.0 && fall > ZERO {
                let room = self.values[k].max(0.0) / fall;
                if first.is_none_or(|(least, _)| room < least) {
                    first = Some((room, k));
                }
            }
        }
        first.map(|(_, k)| k)
    }

    /// The force of a member becomes the unknown.
    fn exchange(&mut self, member: usize, unknown: usize) {
        let pivot = self.rows[member][unknown];
        let limiting = self.rows[member].clone();
        let value = self.values[member];
        for (row, d) in self.rows.iter_mut().zip(&mut self.values) {
            let factor = row[unknown] / pivot;
            if factor != 0.0 {
                *d -= factor * value;
                row.iter_mut().zip(&limiting).for_each(|(entry, of)| *entry -= factor * of);
            }
            row[unknown] = factor;
        }
        // Exact, and no remainder of rounding.
        self.rows[member].fill(0.0);
        (self.rows[member][unknown], self.values[member]) = (1.0, 0.0);
        self.free[unknown] = false;
    }
}
