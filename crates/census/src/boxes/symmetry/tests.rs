use model::Bar;
use model::system::{Joint, Member, System};

use super::*;
use crate::boxes::frame::Frame;
use crate::boxes::prove::Posed;

/// Four feet about a centre, one moved by this along X, and an apex under this load.
fn pyramid(centre: f64, off: f64, force_n: Point) -> (System, Vec<Point>) {
    let feet = [[1.0 + off, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    let feet = feet.map(|[x, y]: [f64; 2]| [centre + x, y, 0.0]);
    let names = ["A", "B", "C", "D"];
    let mut joints: Vec<Joint> =
        names.iter().zip(feet).map(|(name, at_m)| Joint::anchor(*name, at_m)).collect();
    joints.push(Joint::free("P").with_force(force_n));
    let bar = Bar::homogeneous(2.0, 0.0).unwrap();
    let members = (0..4).map(|foot| Member::bar(foot, 4, bar).with_stiffness(1.0)).collect();
    let system = System::new("pyramid", 9.81, joints, members).unwrap();
    (system, feet.into_iter().chain([[centre, 0.0, 1.5]]).collect())
}

fn blocks(system: &System, shape: &[Point]) -> Option<(Equations, Vec<Block>)> {
    let symmetry = Symmetry::of(&[system], shape)?;
    let axial_n = [-0.1; 4];
    let mut frame = Frame::new(system, &axial_n);
    frame.origin_m = symmetry.centre_m;
    let Posed { equations, .. } = Posed::within(system, frame, shape, &axial_n, 100).unwrap();
    let blocks = Block::all(&equations, &symmetry)?;
    Some((equations, blocks))
}

/// Seven unknowns: the height and two pairs of forces; a move to each side with the difference of a pair.
#[test]
fn unknowns_fall_apart_by_their_symmetry() {
    let sizes = |centre, off, force_n| {
        let (system, shape) = pyramid(centre, off, force_n);
        let (_, blocks) = blocks(&system, &shape)?;
        Some(blocks.iter().map(Block::size).collect::<Vec<_>>())
    };
    let down = [0.0, 0.0, -1.0];
    for centre in [0.0, 3.5] {
        assert_eq!(sizes(centre, 0.0, down), Some(vec![3, 2, 2, 0]));
        // Under a push along X it is its mirror image across that alone.
        assert_eq!(sizes(centre, 0.0, [0.1, 0.0, -1.0]), Some(vec![5, 2]));
        // Along a diagonal.
        assert_eq!(sizes(centre, 0.0, [0.1, 0.1, -1.0]), Some(vec![4, 3]));
        assert_eq!(sizes(centre, 0.0, [0.1, 0.2, -1.0]), None);
    }
    // Off by the last place of a double, and what doubles cannot say of the centre.
    assert_eq!(sizes(0.0, f64::EPSILON, down), Some(vec![5, 2]));
    assert_eq!(sizes(0.1, 0.0, down), Some(vec![5, 2]));
}

/// Five bars of 1, 2, 3, 2 and 1 m, alike otherwise, are turned over end for end: each joint goes to the one that
/// stands there, not to the first that looks like it. A shape off by more than a ten-millionth of their 9 m is
/// its own image across the plane it lies in alone.
#[test]
fn joints_go_where_their_images_stand() {
    let heights = [0.0, -0.5, -1.5, -1.5, -0.5, 0.0];
    let places = [-3.0, -2.5, -1.0, 1.0, 2.5, 3.0];
    let mut shape: Vec<Point> = (0..6).map(|k| [places[k], 0.0, heights[k]]).collect();
    let joints = (0..6).map(|k| match k {
        0 | 5 => Joint::anchor(format!("{k}"), shape[k]),
        _ => Joint::free(format!("{k}")).with_force([0.0, 0.0, -1.0]),
    });
    let bars = [1.0, 2.0, 3.0, 2.0, 1.0].map(|length_m| Bar::homogeneous(length_m, 1.0).unwrap());
    let members = bars.into_iter().enumerate().map(|(k, bar)| Member::bar(k, k + 1, bar));
    let system = System::new("chain", 9.81, joints.collect(), members.collect()).unwrap();
    for (off, mirrors) in [(0.0, 2), (0.8e-6, 2), (1.0e-6, 1)] {
        shape[3][2] = heights[3] + off;
        let symmetry = Symmetry::of(&[&system], &shape).unwrap();
        assert_eq!(symmetry.mirrors.len(), mirrors, "{off}");
        for mirror in &symmetry.mirrors {
            let across = mirror.axes[0].1 < 0.0;
            let images = |count: usize| {
                (0..count).map(|k| if across { count - 1 - k } else { k }).collect::<Vec<_>>()
            };
            assert_eq!((&mirror.joints, &mirror.members), (&images(6), &images(5)));
        }
    }
}

/// The same chain is its own image across the plane it lies in alone, if the joint that stands for another is held
/// otherwise, or has another mass or force; wires are images of each other by their directions.
#[test]
fn images_are_held_and_loaded_alike() {
    let wire = |x: f64| Support::Line { at_m: [0.0; 3], direction: [x, 0.0, 0.8] };
    let shape: Vec<Point> = [-3.0, -1.0, 1.0, 3.0].map(|x: f64| [x, 0.0, 0.5 * x.abs()]).to_vec();
    let mirrors = |joints: [Joint; 2]| {
        let mut all = vec![Joint::anchor("A", shape[0]), Joint::anchor("B", shape[3])];
        all.splice(1..1, joints);
        for (joint, at) in all.iter_mut().zip(&shape) {
            if let Support::Line { at_m, .. } | Support::Plane { at_m, .. } = &mut joint.support {
                *at_m = *at;
            }
        }
        let bar = Bar::homogeneous(2.0, 1.0).unwrap();
        let members = (0..3).map(|k| Member::bar(k, k + 1, bar)).collect();
        let system = System::new("chain", 9.81, all, members).unwrap();
        Symmetry::of(&[&system], &shape).unwrap().mirrors.len()
    };
    let joint = || Joint::free("P").with_mass(1.0).with_force([0.25, 0.0, -1.0]);
    let held = |support| joint().held_by(support);
    let image = || {
        let mut joint = joint().with_force([-0.25, 0.0, -1.0]);
        joint.name = "Q".into();
        joint
    };
    let level = Support::Plane { at_m: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    for (joints, wanted) in [
        ([joint(), image()], 2),
        ([joint(), image().with_mass(1.5)], 1),
        ([joint(), image().with_force([-0.25, 0.0, -2.0])], 1),
        ([joint(), image().held_by(level)], 1),
        ([held(level), image().held_by(level)], 2),
        ([held(wire(0.6)), image().held_by(wire(-0.6))], 2),
        ([held(wire(0.6)), image().held_by(wire(0.6))], 1),
    ] {
        assert_eq!(mirrors(joints.clone()), wanted, "{joints:?}");
    }
}

/// The derivative at a symmetric shape maps each block into itself.
#[test]
fn blocks_are_kept_by_the_derivative() {
    let (system, shape) = pyramid(0.0, 0.0, [0.0, 0.0, -1.0]);
    let (equations, blocks) = blocks(&system, &shape).unwrap();
    let z: Vec<Interval> = [1.3, -0.2, -0.4].map(Interval::point).to_vec();
    let jacobian = equations.slope(&blocks[0].spread(&z));
    for block in &blocks {
        let own = block.restrict(&jacobian);
        for orbit in 0..block.size() {
            let mut unit = vec![Interval::ZERO; block.size()];
            unit[orbit] = Interval::ONE;
            let unit = block.spread(&unit);
            let mut image = vec![0.0; equations.size];
            for (row, column, entry) in &jacobian {
                image[*row] += entry.mid() * unit[*column].mid();
            }
            let mut reduced = vec![0.0; block.size()];
            for (row, column, entry) in &own {
                reduced[*row] += if *column == orbit { entry.mid() } else { 0.0 };
            }
            let reduced: Vec<Interval> = reduced.into_iter().map(Interval::point).collect();
            let whole = block.spread(&reduced);
            let close = |(a, b): (&f64, &Interval)| (a - b.mid()).abs() < 1e-14;
            assert!(image.iter().zip(&whole).all(close), "{image:?} {whole:?}");
        }
    }
}
