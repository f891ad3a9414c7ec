//! From a zero found by the search to places of all joints and forces of all members, enclosed by
//! the proof that knows nothing of the search; and its index.

use model::Vector as Point;
use numerics::Interval;

use super::box_test::Found;
use super::cell;
use super::inertia::index;
use super::jet::values;
use super::layout::Layout;
use super::pieces::Core;
use super::reach::span;
use super::swing::{Swung, place};
use crate::boxes::activity::Activity;
use crate::boxes::arithmetic::{Vector, dot, minus, norm, sum};
use crate::boxes::equations::{Acting, Equations};
use crate::boxes::krawczyk::prove_zero;
use crate::boxes::newton::refine;
use crate::boxes::turns::Turn;
use crate::branch_and_bound::encloses;
use crate::net::choice::Choice;

/// An equilibrium of the net, enclosed.
pub(super) struct Enclosed {
    pub(super) choice: Choice,
    /// Places of the knots, in the coordinates of the search.
    pub(super) knots: Vec<Interval>,
}

/// Enclose a zero; nothing if that is not proved, or if it may not be the one of the search.
pub(super) fn enclosed<const N: usize>(
    core: &Core,
    layout: &Layout,
    found: &Found<N>,
) -> Option<Enclosed> {
    let turn = turn(core, layout, found);
    let Proved { equations, zero, places, mut choice } =
        Proved::next_to(core, turn.as_slice(), &start(core, layout, found)?)?;
    let knots: Vec<Interval> = layout
        .knots
        .iter()
        .flat_map(|knot| layout.turned(places[*knot])[..layout.dim].to_vec())
        .collect();
    if !encloses(&found.alone_in, &knots) {
        return None;
    }
    // The pattern is that of the search, too.
    for (s, swing) in layout.swings.iter().enumerate() {
        let sign = if layout.dim == 2 {
            let at = std::array::from_fn(|k| knots.get(k).copied().unwrap_or(Interval::ZERO));
            let [a, b] = swing.ends.map(|end| values(place::<N>(end, 2, &at)));
            let (span, arm) = (minus(b, a), minus(layout.turned(places[swing.joint]), a));
            dot([-span[1], span[0], Interval::ZERO], arm).sign()
        } else {
            let of = |member: usize| equations.acting.iter().find(|acting| acting.member == member);
            let densities = swing.members.map(|member| of(member).map(|a| zero[a.force]));
            densities.into_iter().flatten().fold(Interval::ZERO, sum).sign()
        };
        if sign? != cell::sign(found.pattern, s) {
            return None;
        }
    }
    if let Some(Turn { arm, centre, .. }) = &turn {
        // The arm that holds the turn is none on the axis.
        let off = minus(layout.turned(places[*arm]), layout.turned(places[*centre]));
        if off[0].contains(0.0) {
            return None;
        }
    }
    choice.circle = turn.is_some();
    Some(Enclosed { choice, knots })
}

/// A zero of the equations of a net, and the position that it is.
pub(in crate::net) struct Proved {
    equations: Equations,
    zero: Vec<Interval>,
    /// Of all joints.
    pub(in crate::net) places: Vec<Vector>,
    pub(in crate::net) choice: Choice,
}

impl Proved {
    /// With free turns that are held, next to places of all joints, m, and axial forces, N.
    pub(in crate::net) fn next_to(
        core: &Core,
        turns: &[Turn],
        (joints_m, axial_n): &(Vec<Point>, Vec<f64>),
    ) -> Option<Self> {
        let equations = equations(core, turns);
        let refined = refine(&equations, &equations.start(joints_m, axial_n)).ok()?;
        let zero = prove_zero(&equations, &refined).ok()?;
        let places = equations.places(&zero);
        let axial = |acting: &Acting| (acting.member, acting.axial(zero[acting.force]));
        let choice = Choice {
            places: core.joints.iter().map(|joint| (*joint, places[*joint])).collect(),
            axial: equations.acting.iter().map(axial).collect(),
            index: [index(&equations, &zero)?, 0],
            circle: false,
        };
        Some(Self { equations, zero, places, choice })
    }
}

/// The free turn about the vertical of the anchors, where the knot is not on it.
fn turn<const N: usize>(core: &Core, layout: &Layout, found: &Found<N>) -> Option<Turn> {
    let (centre, arm) = (layout.axis?, *layout.knots.first()?);
    let axis = layout.turned(core.frame.place(core.system.joints()[centre].support.at_m()?))[0];
    let mut across = [1.0; 2];
    across[layout.axes[0]] = 0.0;
    let turn = Turn { joints: core.joints.to_vec(), centre, arm, across };
    axis.disjoint(found.alone_in[0]).then_some(turn)
}

/// The equations of the net alone, with what its joints bear, each of these free turns held.
fn equations(core: &Core, turns: &[Turn]) -> Equations {
    let activities: Vec<Activity> = (0..core.system.members().len())
        .map(|member| if core.members.contains(&member) { Activity::Acts } else { Activity::Idle })
        .collect();
    let joints = core.system.joints();
    let held: Vec<bool> = (0..joints.len()).map(|joint| !core.joints.contains(&joint)).collect();
    // Other joints that move are in no equation.
    Equations::new(core.system, *core.frame, &activities, turns, &core.places_m(), &held)
        .with_loads(core.loads.to_vec())
}

/// Places of all joints, m, and axial forces, N, next to a zero.
fn start<const N: usize>(
    core: &Core,
    layout: &Layout,
    found: &Found<N>,
) -> Option<(Vec<Point>, Vec<f64>)> {
    let frame = core.frame;
    let mut joints_m = core.places_m();
    let mut axial_n = vec![0.0; core.system.members().len()];
    let point = found.at.map(Interval::point);
    let anchor_m = core.anchor_m()?;
    let mut put = |joint: usize, at: &dyn Fn(usize) -> f64| {
        joints_m[joint] = anchor_m;
        for k in 0..layout.dim {
            let axis = layout.axes[k];
            joints_m[joint][axis] = at(k) * frame.length_m + frame.origin_m[axis];
        }
    };
    for (number, knot) in layout.knots.iter().enumerate() {
        put(*knot, &|k| found.at[layout.dim * number + k]);
    }
    for (link, force) in layout.links.iter().zip(&found.densities) {
        let axial = link.acting.axial(Interval::point(*force));
        axial_n[link.acting.member] = axial.mid() * frame.force_n;
    }
    for (s, swing) in layout.swings.iter().enumerate() {
        let sign = f64::from(cell::sign(found.pattern, s));
        let hung = Swung::at_point(swing, layout.dim, &point, sign)?;
        put(swing.joint, &|k| hung.place[k]);
        for ((member, density), length) in
            swing.members.iter().zip(hung.densities).zip(swing.lengths)
        {
            axial_n[*member] = density * length.mid() * frame.force_n;
        }
    }
    for link in &layout.links {
        let Some(hanging) = &link.hanging else { continue };
        let spans = link.ends.iter().map(|ends| norm(span(layout.dim, &point, *ends)));
        let left = spans.fold(link.sizes().hi(), |left, span| left - span.mid());
        // Along its load, as far as the rope is left.
        let from = frame.place(joints_m[hanging.from]);
        for k in 0..3 {
            let down = left * hanging.load[k].mid() / hanging.tension.mid();
            joints_m[hanging.joint][k] =
                (from[k].mid() + down) * frame.length_m + frame.origin_m[k];
        }
    }
    Some((joints_m, axial_n))
}
