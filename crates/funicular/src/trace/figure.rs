//! A load path as a picture.

use figures::{Anchor, Axes, Axis, BLUE, Look, Svg, Unit, VERMILION};

use super::load::{BranchesFrom, Kind, LoadPath, LoadPaths, LoadPoint};

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 560.0;
const LEFT: f64 = 110.0;
const RIGHT: f64 = 870.0;
const TOP: f64 = 90.0;
const BOTTOM: f64 = 490.0;
/// How wide the curves are, px, and how large events.
const STROKE: f64 = 2.4;
const DOT: f64 = 5.0;

/// The last parameter over the first number shown: stable parts in full, unstable ones dashed,
/// events marked. The first path of the family is drawn last, over the others.
pub(super) fn figure(found: &LoadPaths, family: &[usize]) -> String {
    let last = found.parameters.len().saturating_sub(1);
    let at = |point: &LoadPoint| Some([*point.of.first()?.as_ref()?, point.values[last]]);
    let all = family.iter().flat_map(|path| &found.paths[*path].points);
    let points: Vec<[f64; 2]> = all.filter_map(at).collect();
    let x = Axis::around(points.iter().map(|at| at[0]), 0.04, [LEFT, RIGHT]);
    let y = Axis::around(points.iter().map(|at| at[1]), 0.06, [BOTTOM, TOP]);
    let (x_name, y_name) = (
        found.of.first().map_or(String::new(), |(name, unit)| format!("{name} / {unit}")),
        format!("{} / {}", found.parameters[last], found.units[last]),
    );
    let axes = Axes { x, y, names: [&x_name, &y_name] };
    let mut svg = Svg::new([WIDTH, HEIGHT], found.system.name());
    svg.text(Look::PLAIN.size(17.0).bold(), [LEFT, 28.0], Anchor::Start, found.system.name());
    svg.text(
        Look::PLAIN,
        [LEFT, 48.0],
        Anchor::Start,
        "stable in full, unstable dashed; limit points as dots, branch points as diamonds, kinks as crosses",
    );
    let place = |point: &LoadPoint| at(point).map(|at| axes.at(at));
    for path in family.iter().rev() {
        curve(&mut svg, found, &found.paths[*path], &place);
    }
    axes.frame(&mut svg, [Unit::Decimal, Unit::Decimal]);
    for path in family.iter().rev() {
        marks(&mut svg, &found.paths[*path], &place);
    }
    svg.finish()
}

fn curve(
    svg: &mut Svg,
    found: &LoadPaths,
    path: &LoadPath,
    place: &dyn Fn(&LoadPoint) -> Option<[f64; 2]>,
) {
    // From the branch point on in which it begins.
    let from = path.branches_from.and_then(|BranchesFrom { path, event }| {
        let parent = found.paths.get(path)?;
        place(parent.points.get(parent.events.get(event)?.point)?)
    });
    let mut run: Vec<[f64; 2]> = from.into_iter().collect();
    for (k, point) in path.points.iter().enumerate() {
        let Some(here) = place(point) else { continue };
        run.push(here);
        // An event has the index of the part before it, and both parts reach to it.
        let stable = point.index == 0;
        if path.points.get(k + 1).is_none_or(|next| (next.index == 0) != stable) {
            let look = Look::stroke(if stable { BLUE } else { VERMILION }, STROKE);
            svg.polyline(if stable { look } else { look.dashed("9 6") }, run.drain(..));
            run.push(here);
        }
    }
}

fn marks(svg: &mut Svg, path: &LoadPath, place: &dyn Fn(&LoadPoint) -> Option<[f64; 2]>) {
    for event in &path.events {
        let Some(here) = path.points.get(event.point).and_then(place) else { continue };
        let look = Look::fill(VERMILION);
        match event.kind {
            Kind::Limit => svg.circle(look, here, DOT),
            Kind::Branch => svg.diamond(look, here, DOT),
            Kind::Kink => svg.cross(Look::stroke(VERMILION, STROKE), here, DOT),
        }
    }
}
