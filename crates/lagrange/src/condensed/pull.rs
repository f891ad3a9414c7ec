//! The pull on the first anchor: three numbers that determine the whole equilibrium.

use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroUsize;
use std::ops::Range;

use model::Vector;

use super::axis::{Axis, Fold};
use super::bottom::{Bottom, Hold};
use super::bracket::Bracket;
use super::chain::Condensed;
use super::compression::Push;
use super::error::CondensedError;
use super::kernel::Bars;
use super::loads::Arrays;
use super::newton::{NEWTON_PASSES, Passes, Root, first_few, minimise, polish};
use super::settings::Settings;
use super::span::Span;
use super::start::Rope;
use super::system::{Closure, Frame, System};
use super::team::Team;
use super::tension::nested;

/// A deviation smaller than this beside the largest load comes from cancellation.
const LEAST_DEVIATION: f64 = 1e-8;
/// A horizontal force less than this beside the largest one is none: bars turn off the vertical by less than the
/// root of a rounding.
const UPRIGHT: f64 = 1e-6;
const NO_BARS: Bars<'static> = Bars { lengths: &[], loads: &[] };

/// Which bars are compressed.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Signs {
    /// None.
    Tension,
    /// This one.
    One(usize),
    /// None, and these carry no force at all: they have just to fill the gap between the strands.
    Loose(Range<usize>),
}

/// An equilibrium, as briefly as it can be said: the force in the bottom bar and the signs.
///
/// Every force in the chain is this one plus weights, every bar is parallel to its force.
#[derive(Debug, Clone, PartialEq)]
pub struct Pull {
    /// Horizontal unit vector of the plane.
    pub(super) level: [f64; 2],
    /// Force in the bottom bar, horizontal and vertical, in units of the chain.
    pub(super) force: [f64; 2],
    pub(super) signs: Signs,
    /// Derivative of the closure by the force: largest pivot, and what elimination leaves of the other.
    pub(super) pivots: [f64; 2],
    /// Size of the terms of which that remainder is the difference.
    pub(super) remainder_of: f64,
    /// Force of the ground on bar 1 at joint 0, N.
    ground_n: Vector,
    /// The last closure computed, where an iteration found the force.
    closure: Option<Closure>,
    passes: usize,
}

impl Pull {
    pub(super) fn new(
        chain: &Condensed,
        level: [f64; 2],
        force: [f64; 2],
        signs: Signs,
        [a, b, c]: [f64; 3],
        passes: usize,
    ) -> Self {
        let (first, second) = if a.abs() >= c.abs() { (a, c) } else { (c, a) };
        let taken = if b.abs() > 0.0 { b / first * b } else { 0.0 };
        let unit = chain.units.force();
        let vertical = (chain.read.at_start - chain.read.loads[0]) - force[1];
        Self {
            level,
            force,
            signs,
            pivots: [first, second - taken],
            remainder_of: second.abs() + taken.abs(),
            ground_n: [-force[0] * level[0] * unit, -force[0] * level[1] * unit, vertical * unit],
            closure: None,
            passes,
        }
    }

    /// Force of the ground on bar 1 at joint 0, world frame, N: the paper's λ₁, λ₂, λ₃. The chain
    /// pulls the anchor with the opposite of it.
    #[must_use]
    pub fn ground_n(&self) -> Vector {
        self.ground_n
    }

    /// The compressed bars, numbered from 0.
    #[must_use]
    pub fn compressed(&self) -> Vec<usize> {
        match &self.signs {
            Signs::Tension | Signs::Loose(_) => Vec::new(),
            Signs::One(bar) => vec![*bar],
        }
    }

    /// Passes over all bars that it took.
    #[must_use]
    pub fn passes(&self) -> usize {
        self.passes
    }
}

impl Condensed {
    /// The pull of the hanging equilibrium: the global minimum of the energy.
    ///
    /// No guess is needed. Whether a bar is compressed, and which, follows from the lengths; with all
    /// bars in tension the pull is the minimum of a convex function, with one compressed the only
    /// root of its kind. With the anchors on one vertical every vertical plane is as good as any
    /// other; the answer lies in OYZ and the bars in tension lean towards +Y.
    ///
    /// # Errors
    ///
    /// [`CondensedError::Settings`] for settings out of range, [`CondensedError::NotClosed`] when
    /// the passes over the bars run out.
    pub fn pull(&self, settings: &Settings) -> Result<Pull, CondensedError> {
        settings.validate()?;
        let mut passes = Passes::new(settings.max_passes);
        let enough = settings.closure;
        let found = match self.bottom.hold(self.span.across, self.read.total_length) {
            Hold::Tension => self.in_tension(enough, &mut passes),
            Hold::Compression => self.in_compression(enough, &mut passes),
            Hold::Loose => Some(self.loose()),
            Hold::Meeting => self.meeting(&mut passes),
        };
        let pull =
            found.ok_or(CondensedError::NotClosed { closure: f64::NAN, passes: passes.spent })?;
        let finite = pull.ground_n.iter().all(|component| component.is_finite());
        if finite { Ok(pull) } else { Err(CondensedError::Overflow) }
    }

    /// The pull if two strands just meet at the bottom; `None` if they do not.
    pub(crate) fn if_meeting(&self) -> Option<Pull> {
        let hold = self.bottom.hold(self.span.across, self.read.total_length);
        let mut passes = Passes::new(Settings::default().max_passes);
        (hold == Hold::Meeting).then(|| self.meeting(&mut passes)).flatten()
    }

    fn in_tension(&self, enough: f64, passes: &mut Passes) -> Option<Pull> {
        let upright = self.upright(self.all(), 0.0);
        let taut = Axis::taut(self, false);
        if taut.is_none()
            && let Some((axis, split)) = Axis::double(self)
            && let Some(start) = self.apart(passes)
        {
            let aligned = System { parts: self.split(split), frame: axis.frame, ..upright };
            let begin = axis.enter(start);
            let root = first_few(passes, |few| minimise(&aligned, begin, None, enough, few));
            if let Some(root) = root {
                return Some(self.found(axis.leave(root.force), Signs::Tension, &root, passes));
            }
        }
        let Some(axis) = taut else {
            let start = self.rope(self.read.total_length - self.span.distance).force();
            let (near, contraction) = self.over_the_coarse(start);
            let root = first_few(passes, |few| minimise(&upright, near, contraction, enough, few))
                .or_else(|| nested(&upright, start, enough, passes))?;
            return Some(self.found(root.force, Signs::Tension, &root, passes));
        };
        let aligned = System { frame: axis.frame, ..upright };
        let start = self.rope(axis.slack).force();
        let begin = axis.enter(start);
        let root = first_few(passes, |few| minimise(&aligned, begin, None, enough, few)).or_else(
            || {
                let root = nested(&upright, start, enough, passes)?;
                Some(polish(&aligned, axis.enter(root.force), passes))
            },
        )?;
        Some(self.found(axis.leave(root.force), Signs::Tension, &root, passes))
    }

    fn in_compression(&self, enough: f64, passes: &mut Passes) -> Option<Pull> {
        let Bottom { group, longest, shortest_reach, gap, .. } = &self.bottom;
        let Span { across, rise, .. } = self.span;
        let beside = [group.start.checked_sub(1), Some(group.end)];
        let beside = beside.into_iter().flatten().filter_map(|k| self.read.loads.get(k));
        let upright = Push {
            system: self.upright(self.around_the_bottom(), *shortest_reach),
            fold: None,
            side: 1.0,
            level: [1.0, 0.0],
            between: Bracket { low: -FRAC_PI_2, high: FRAC_PI_2 },
            // With the strands straight the bar's slope follows from the height of the gap.
            angle: (gap / shortest_reach).clamp(-1.0, 1.0).asin(),
            line: rise.atan2(across),
            load: beside.fold(f64::INFINITY, |least, load| least.min(load.abs())),
            largest_load: self.largest_load(),
        };
        let signs = Signs::One(*longest);
        let line = Axis::taut(self, true).or_else(|| Axis::folded(self));
        let fold = Fold::of(self);
        let root = if let Some(axis) = line {
            let root = upright.along(&axis).solve(enough, passes)?;
            Root { force: axis.leave(root.force), ..root }
        } else if fold.is_some() {
            Push { fold, ..upright }.solve(enough, passes)?
        } else if let Some(axis) = Axis::hanging(self) {
            let root = upright.along(&axis).solve(enough, passes)?;
            Root { force: axis.leave(root.force), ..root }
        } else {
            upright.solve(enough, passes)?
        };
        Some(self.found(root.force, signs, &root, passes))
    }

    /// No force at the bottom: every other bar carries the weights below it, straight up.
    fn loose(&self) -> Pull {
        let signs = Signs::Loose(self.bottom.group.clone());
        Pull::new(self, self.span.level, [0.0; 2], signs, [0.0; 3], 0)
    }

    /// Two strands that just meet share the weight of the joint where they do in any way they like.
    /// The answer is the limit of anchors that are moved apart a little: a horizontal pull H turns
    /// bar i off the vertical by $H/|F_i|$, which takes $l_i H^2/(2 F_i^2)$ off its height, and both
    /// strands must lose the same,
    ///
    /// $$ \sum_i l_i\, \mathrm{sign}(F_i)/F_i^2 = 0, $$
    ///
    /// a monotone function of the force at the bottom, with a pole at either end of its range.
    fn meeting(&self, passes: &mut Passes) -> Option<Pull> {
        let force = [0.0, self.shared(passes)?];
        let jacobian = self.upright(self.all(), 0.0).closure(force).jacobian;
        Some(Pull::new(self, self.span.level, force, Signs::Tension, jacobian, passes.spent))
    }

    /// The force at the bottom of two strands that nearly meet, their anchors a little apart: to first order
    /// in H the strands turn as far as that asks for, $H \sum_i l_i/|F_i| = $ the way across.
    fn apart(&self, passes: &mut Passes) -> Option<[f64; 2]> {
        let vertical = self.shared(passes)?;
        let bars = self.read.lengths.iter().zip(&self.read.loads);
        let turns = model::sum(bars.map(|(length, load)| length / (vertical + load).abs()));
        Some([self.span.across / turns, vertical])
    }

    /// The vertical force at the bottom of two strands that just meet.
    fn shared(&self, passes: &mut Passes) -> Option<f64> {
        let Bottom { group, gap, .. } = &self.bottom;
        let load = if *gap < 0.0 {
            self.read.loads.get(group.end).copied()
        } else {
            group.start.checked_sub(1).map(|k| self.read.loads[k])
        };
        let end = -load.unwrap_or(0.0);
        let range = Bracket { low: end.min(0.0), high: end.max(0.0) };
        let read = &self.read;
        range.root(0.5 * end, end.abs(), 0.0, |vertical| {
            if !passes.spend() {
                return None;
            }
            // In units of the range: a square of a small force would underflow.
            let terms = || {
                read.lengths.iter().zip(&read.loads).map(|(length, load)| {
                    let force = (vertical + load) / end.abs();
                    (length / force.abs(), force)
                })
            };
            let lost = model::sum(terms().map(|(turn, force)| turn / force));
            let slope = 2.0 * terms().map(|(turn, force)| turn / (force * force)).sum::<f64>();
            Some((-lost, slope / end.abs()))
        })
    }

    fn found(&self, force: [f64; 2], signs: Signs, root: &Root, passes: &Passes) -> Pull {
        let closure = Some(root.closure);
        let jacobian = root.closure.jacobian;
        Pull { closure, ..Pull::new(self, self.span.level, force, signs, jacobian, passes.spent) }
    }

    /// How far rounding may have moved the force of a pull, as a part of the largest force.
    pub(super) fn doubt(&self, pull: &Pull) -> f64 {
        let largest = pull.force[0].hypot(pull.force[1]) + self.largest_load();
        // Between anchors on one vertical a chain that is straight, one of its bars pushed, shares the weight
        // along the vertical in any way.
        let upright = self.span.across <= 0.0 && pull.force[0].abs() <= UPRIGHT * largest;
        if upright && matches!(pull.signs, Signs::One(_)) {
            return 1.0;
        }
        pull.closure.map_or(0.0, |closure| closure.doubt() / largest)
    }

    /// The minimum for the coarse chain, and how fast it was reached.
    fn over_the_coarse(&self, start: [f64; 2]) -> ([f64; 2], Option<f64>) {
        let Arrays { lengths, loads } = &self.moments.coarse;
        if lengths.is_empty() {
            return (start, None);
        }
        let bars = Bars { lengths, loads };
        let alone = Team::new(NonZeroUsize::MIN, lengths.len());
        let system = System { team: alone, ..self.upright([bars, NO_BARS], 0.0) };
        let mut passes = Passes::new(NEWTON_PASSES);
        let root = minimise(&system, start, None, f64::INFINITY, &mut passes);
        // Without a full step nothing was measured.
        let measured =
            |root: &Root| Some(root.contraction).filter(|contraction| *contraction > 0.0);
        root.map_or((start, None), |root| (root.force, measured(&root)))
    }

    fn rope(&self, slack: f64) -> Rope {
        let Span { across, rise, distance, .. } = self.span;
        let length = self.read.total_length;
        let (mean, deviation) = self.moments.total(length);
        Rope {
            across,
            rise,
            length,
            slack_squared: slack * (length + distance),
            mean,
            deviation: deviation.max(LEAST_DEVIATION * self.largest_load()),
        }
    }

    fn largest_load(&self) -> f64 {
        self.read.loads[0].abs().max(self.read.loads[self.read.loads.len() - 1].abs())
    }

    fn all(&self) -> [Bars<'_>; 2] {
        [Bars { lengths: &self.read.lengths, loads: &self.read.loads }, NO_BARS]
    }

    fn around_the_bottom(&self) -> [Bars<'_>; 2] {
        let group = &self.bottom.group;
        [self.part(0..group.start), self.part(group.end..self.bars())]
    }

    fn split(&self, at: usize) -> [Bars<'_>; 2] {
        [self.part(0..at), self.part(at..self.bars())]
    }

    fn part(&self, range: Range<usize>) -> Bars<'_> {
        Bars { lengths: &self.read.lengths[range.clone()], loads: &self.read.loads[range] }
    }

    fn upright<'a>(&self, parts: [Bars<'a>; 2], push: f64) -> System<'a> {
        let frame = Frame::Upright { across: self.span.across, rise: self.span.rise };
        System { parts, push, frame, total_length: self.read.total_length, team: self.team() }
    }
}
