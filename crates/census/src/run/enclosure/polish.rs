//! Enclosures as narrow as doubles allow, however ill-conditioned the pull.

use model::{Bar, Chain};
use numerics::{DoubleDouble, Interval, lever};

use crate::run::closure::Closure;
use crate::run::enclosure::krawczyk::{Zero, image, inside, inverse};
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::loads::JointLoads;
use crate::run::plane::system::System;

/// Newton steps with the precise closure: the first one brings the last place of a double.
const STEPS: usize = 2;

/// Room around the point for the proof: so many units in the last place and so many last steps.
const ROOM: f64 = 4.0;

/// The data of the closure to twice the usual precision.
#[derive(Debug)]
pub(crate) struct PreciseSystem {
    length: Vec<DoubleDouble>,
    /// `c_i`, not centred; exactly 0 for bar 1.
    weight: Vec<DoubleDouble>,
    span: [DoubleDouble; 2],
    offset: f64,
}

impl PreciseSystem {
    pub(crate) fn new(chain: &Chain, loads: &JointLoads, system: &System) -> Self {
        let bars = chain.bars();
        let mass =
            |bar: &Bar| DoubleDouble::point(bar.mass_kg()).scale(system.mass_unit_kg.recip());
        let [length, centre] =
            [Bar::length_m, Bar::centre_m].map(|of| move |bar| DoubleDouble::point(of(bar)));
        let shares = |bar| lever(length(bar), centre(bar));
        let with_load = |weight: DoubleDouble, bar: usize| match loads.precisely_at(bar + 1) {
            Some(load) => weight + load.scale(system.mass_unit_kg.recip()),
            None => weight,
        };
        // As in `System`: what joint 0 carries is left out.
        let mut carried = with_load(mass(&bars[0]) * shares(&bars[0])[1], 0);
        let mut weight = vec![DoubleDouble::ZERO];
        for (k, bar) in bars.iter().enumerate().skip(1) {
            weight.push(carried + mass(bar) * shares(bar)[0]);
            carried = with_load(carried + mass(bar), k);
        }
        for group in &system.groups {
            let first = weight[group.start];
            weight[group.clone()].fill(first);
        }
        let shorten = |x: DoubleDouble| x.scale(system.length_unit_m.recip());
        let anchors = chain.anchors();
        let [x, y, z] = std::array::from_fn(|k| {
            shorten(DoubleDouble::point(anchors.end_m[k]) - DoubleDouble::point(anchors.start_m[k]))
        });
        let horizontal =
            if system.vertical { DoubleDouble::ZERO } else { (x.square() + y.square()).sqrt() };
        Self {
            length: bars.iter().map(|bar| shorten(DoubleDouble::point(bar.length_m()))).collect(),
            weight,
            span: [horizontal, z],
            offset: system.offset,
        }
    }

    /// Φ at a point of a chart.
    fn gap(&self, system: &System, signs: &[i8], face: Face, at: [f64; 2]) -> [Interval; 2] {
        let [h, v, w] = Cell::point(face, at).homogeneous().map(|x| DoubleDouble::point(x.mid()));
        let origin = match face {
            Face::Around(group) => self.weight[system.groups[usize::from(group)].start],
            _ => DoubleDouble::point(self.offset),
        };
        let mut gap = self.span.map(|part| -part);
        for ((sign, length), weight) in signs.iter().zip(&self.length).zip(&self.weight) {
            let force = [h, v + (*weight - origin) * w];
            let size = (force[0].square() + force[1].square()).sqrt();
            for k in 0..2 {
                let term = *length * (force[k] / size);
                gap[k] = gap[k] + if *sign < 0 { -term } else { term };
            }
        }
        gap.map(DoubleDouble::interval)
    }
}

/// The same zero in a narrower cell, if double precision was not reached yet.
pub(crate) fn polish(system: &System, precise: &PreciseSystem, signs: &[i8], zero: &Zero) -> Zero {
    refined(system, precise, signs, zero).unwrap_or(*zero)
}

fn refined(system: &System, precise: &PreciseSystem, signs: &[i8], zero: &Zero) -> Option<Zero> {
    let face = zero.tight.face;
    let mut x = zero.tight.middle();
    let mut step = [0.0; 2];
    for _ in 0..STEPS {
        let inverse = inverse(Closure::plain(system, signs, face, x).1)?;
        let gap = precise.gap(system, signs, face, x).map(Interval::mid);
        step = std::array::from_fn(|k| inverse[k][0] * gap[0] + inverse[k][1] * gap[1]);
        x = std::array::from_fn(|k| x[k] - step[k]);
    }
    let last_place = f64::EPSILON * Cell::size(face, x);
    let small = Cell {
        face,
        at: std::array::from_fn(|k| Interval::around(x[k], ROOM * (last_place + step[k].abs()))),
    };
    let slope = Closure::over(system, signs, &small)?.slope;
    let image = image(&small, x, slope, precise.gap(system, signs, face, x))?;
    // The zero in the small cell is the one that was proved only if that holds no other there.
    if !inside(&image, &small) || !zero.alone_in.encloses(&small) {
        return None;
    }
    let at = [zero.tight.at[0].intersect(image.at[0])?, zero.tight.at[1].intersect(image.at[1])?];
    Some(Zero { tight: Cell { face, at }, ..*zero })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two bars of 5 m between level anchors 6 m apart: slopes of 4/3, so the pull is 3/4 of what
    /// either bar bears. What was proved elsewhere says nothing of that zero.
    #[test]
    fn only_the_zero_that_was_proved_is_narrowed() {
        let chain = samples::homogeneous(10.0, &[(5.0, 1.0); 2], [6.0, 0.0, 0.0]).into_chain();
        let system = System::new(&chain, JointLoads::NONE);
        let precise = PreciseSystem::new(&chain, JointLoads::NONE, &system);
        let pull = 0.75 * system.weight[1].mid();
        let around = |x: f64, radius: f64| Cell {
            face: Face::Near,
            at: [x, 0.0].map(|x| Interval::around(x, radius)),
        };
        let tight = around(pull, 1e-9);
        let refined =
            |alone_in: Cell| refined(&system, &precise, &[1, 1], &Zero { tight, alone_in });
        let Zero { tight: Cell { at, .. }, .. } = refined(around(pull, 1e-6)).unwrap();
        assert!(at[0].contains(pull) && at[1].contains(0.0), "{at:?}");
        assert!(at.into_iter().all(|part| part.width() < 1e-15), "{at:?}");
        assert!(refined(around(pull + 1e-3, 1e-6)).is_none());
    }
}
