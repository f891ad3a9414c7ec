//! Bars that carry nothing because they just bridge a gap.
//!
//! Neighbouring bars without load between them carry one force. If it is zero, every other bar
//! carries the weight of what is beyond it alone and is plumb, so that lengths and anchors say how
//! wide the gap is between the ends of the two plumb parts. Bars whose lengths add up to that lie
//! straight. The energy then rises only with the fourth power of their angles, and a minimiser
//! leaves them by the fourth root of rounding off the line. With `R` the sum of their lengths and
//! `g` the gap, `R - g = (R² - g²) / (R + g)` is found to twice the digits of a double, and tells
//! which of three it is:
//!
//! - zero: the bars lie on the line;
//! - positive: they are at rest in any position that bridges the gap; they are bent at one joint;
//! - negative: they pull the plumb parts aside, by as much as is missing.

use std::ops::Range;

use model::{Anchors, Chain};

use crate::run::refine::{LIGHT, Point};
use crate::thresholds::{CORRECTIONS, SETTLED};
use crate::twofold::Twofold;
use crate::vector::{along, dot, norm, scaled, unit};

/// Angle, rad, within which such bars are left of their line, and the others of the vertical.
const NEARLY_STRAIGHT: f64 = 1e-2;

/// Sums to twice the digits of a double, relative to their terms: less than this is their rounding.
const TWICE_THE_DIGITS: f64 = 64.0 * f64::EPSILON * f64::EPSILON;

impl Point {
    /// Lay bars that just bridge a gap where they belong, all others plumb. The angle, rad, by
    /// which that may differ from the equilibrium; `None` if there are no such bars.
    pub(crate) fn straightened(&mut self, chain: &Chain) -> Option<f64> {
        let run = self.unloaded_runs().into_iter().find(|run| self.soft(run))?;
        let (links, up) = (&self.links, self.links.up);
        let rises: Vec<bool> = self.shape.u.iter().map(|&u| dot(u, up) > 0.0).collect();
        let mut u: Vec<_> = rises.iter().map(|&r| if r { up } else { scaled(-1.0, up) }).collect();
        let others = || (0..links.bars()).filter(|i| !run.contains(i));
        let line = unit(others().fold(links.span[0], |gap, i| along(gap, -links.length[i], u[i])))?;
        u[run.clone()].fill(line);
        let near = |(a, b)| norm(along(a, -1.0, b)) < NEARLY_STRAIGHT;
        if !self.shape.u.iter().copied().zip(u.iter().copied()).all(near) {
            return None;
        }
        let slack = slack(chain, &run, &rises);
        if slack > 0.0 {
            bend(&mut u[run.clone()], &links.length[run.clone()], slack, up);
        }
        let moments = links.measure(&u);
        if norm(moments.gap) > SETTLED {
            return None;
        }
        let unknown = if slack < 0.0 {
            // What is missing, of the bars that give way and of their part across the vertical.
            let reach: f64 = links.length[run.clone()].iter().sum();
            let shortest = others().map(|i| links.length[i]).fold(f64::INFINITY, f64::min);
            -slack * reach / (shortest * norm(along(line, -dot(line, up), up)))
        } else {
            0.0
        };
        // Where the vertical parts cannot give way nothing is known.
        if unknown > NEARLY_STRAIGHT {
            return None;
        }
        self.multiplier = scaled(-links.carried[run.start], up);
        (self.shape.u, self.shape.moments) = (u, moments);
        Some(unknown)
    }

    /// Whether bars carry next to nothing: a minimiser leaves those that carry nothing at an angle of the fourth root of
    /// rounding, with its square as their force.
    fn soft(&self, run: &Range<usize>) -> bool {
        let pull = norm(self.multiplier).max(1.0);
        run.clone().all(|i| {
            let load = self.links.load(i, self.multiplier);
            dot(load, self.shape.u[i]).abs() <= LIGHT * pull
        })
    }

    /// Runs of two and more bars without any load between them.
    fn unloaded_runs(&self) -> Vec<Range<usize>> {
        let (mut runs, mut first) = (Vec::new(), 0);
        for run in self.links.carried.chunk_by(|a, b| (a - b).abs() <= 0.0) {
            if run.len() > 1 {
                runs.push(first..first + run.len());
            }
            first += run.len();
        }
        runs
    }

    /// Whether the chain is closed, or can be by turns that only bars without force notice.
    pub(crate) fn closed(&mut self) -> bool {
        if norm(self.shape.moments.gap) <= SETTLED {
            return true;
        }
        if let Ok(shape) = self.links.close(self.shape.clone(), CORRECTIONS) {
            self.shape = shape;
        }
        norm(self.shape.moments.gap) <= SETTLED
    }
}

/// How much longer bars are than the gap that all others leave when they are plumb, up or down as
/// they are: as a part of their length. Zero is exact to twice the digits of a double.
fn slack(chain: &Chain, run: &Range<usize>, rises: &[bool]) -> f64 {
    let Anchors { start_m, end_m } = chain.anchors();
    let mut reach = Twofold::default();
    let mut gap: [Twofold; 3] = std::array::from_fn(|k| Twofold::sum(end_m[k], -start_m[k]));
    for (i, bar) in chain.bars().iter().enumerate() {
        let length = Twofold::from(bar.length_m());
        if run.contains(&i) {
            reach = reach + length;
        } else {
            gap[2] = gap[2] + if rises[i] { -length } else { length };
        }
    }
    let difference = gap.iter().fold(reach * reach, |left, part| left - *part * *part);
    let (reach, size) = (reach.value(), norm(gap.map(Twofold::value)));
    let slack = difference.value() / (reach * (reach + size));
    if slack.abs() <= TWICE_THE_DIGITS { 0.0 } else { slack }
}

/// Bend bars that lie on one line, and are longer than it by a part `slack`, at their first joint:
/// they make a triangle whose height follows from its sides (Heron), the joint below the line.
fn bend(u: &mut [model::Vector], length: &[f64], slack: f64, up: model::Vector) {
    let [first, ..] = *length else { return };
    let reach: f64 = length.iter().sum();
    let (rest, gap) = (reach - first, reach - slack * reach);
    let sides = (reach + gap) * (slack * reach) * (gap + first - rest) * (gap + rest - first);
    let height = 0.5 * sides.max(0.0).sqrt() / gap;
    let line = u[0];
    // A vertical line has no side below it: any side will do.
    let below =
        unit(along(scaled(-1.0, up), dot(line, up), line)).unwrap_or([line[2], 0.0, -line[0]]);
    let turned = |sine: f64| {
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        along(scaled(cosine, line), sine, below)
    };
    u.fill(turned(-height / rest));
    u[0] = turned(height / first);
}

#[cfg(test)]
mod tests;
