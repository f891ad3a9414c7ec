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
use crate::boxes::arithmetic::{dot, minus, norm, sum};
use crate::boxes::equations::Equations;
use crate::boxes::krawczyk::prove_zero;
use crate::boxes::newton::refine;
use crate::boxes::turns::Turn;
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
    let equations = equations(core, turn.as_slice());
    let (joints_m, axial_n) = start(core, layout, found)?;
    let start = equations.start(&joints_m, &axial_n);
    let refined = refine(&equations, &start).ok()?;
    let zero = prove_zero(&equations, &refined).ok()?;
    let places = equations.places(&zero);
    let knots: Vec<Interval> = layout
        .knots
        .iter()
        .flat_map(|knot| layout.turned(places[*knot])[..layout.dim].to_vec())
        .collect();
    if !knots.iter().zip(&found.alone_in).all(|(tight, all)| all.encloses(*tight)) {
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
        if f64::from(sign?) * cell::sign(found.pattern, s) < 0.5 {
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
    let mut choice = Choice { circle: turn.is_some(), ..Choice::default() };
    choice.places.extend(core.joints.iter().map(|joint| (*joint, places[*joint])));
    for acting in &equations.acting {
        choice.axial.push((acting.member, acting.axial(zero[acting.force])));
    }
    choice.index = [index(&equations, &zero)?, 0];
    Some(Enclosed { choice, knots })
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
pub(in crate::net) fn equations(core: &Core, turns: &[Turn]) -> Equations {
    let activities: Vec<Activity> = (0..core.system.members().len())
        .map(|member| if core.members.contains(&member) { Activity::Acts } else { Activity::Idle })
        .collect();
    let joints = core.system.joints();
    let held: Vec<bool> = (0..joints.len()).map(|joint| !core.joints.contains(&joint)).collect();
    // Other joints that move are in no equation.
    let places_m: Vec<Point> =
        joints.iter().map(|joint| joint.support.at_m().unwrap_or(core.frame.origin_m)).collect();
    Equations::new(core.system, *core.frame, &activities, turns, &places_m, &held)
        .with_loads(core.loads.to_vec())
}

/// Places of all joints, m, and axial forces, N, next to a zero.
fn start<const N: usize>(
    core: &Core,
    layout: &Layout,
    found: &Found<N>,
) -> Option<(Vec<Point>, Vec<f64>)> {
    let frame = core.frame;
    let joints = core.system.joints();
    let mut joints_m: Vec<Point> =
        joints.iter().map(|joint| joint.support.at_m().unwrap_or(frame.origin_m)).collect();
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
        let hung = Swung::at_point(swing, layout.dim, &point, cell::sign(found.pattern, s))?;
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
