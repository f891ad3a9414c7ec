//! Lists of equilibria of nets against closed forms, topology, and Newton's method.

use model::system::{Joint, Kind, Member, System};
use model::{NoCensus, Reason, Status, Vector};
use numerics::Interval;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::assert_frozen;

use census::Settings;
use census::net::{Open, SystemCensus};

use crate::support::{Acting, G, light, taken};

/// Strands of bars of these lengths from anchors to one knot; weights at all joints, growing from
/// strand to strand.
fn bridle(anchors: &[Vector], strands: &[&[f64]], knot_kg: f64, kg: f64) -> System {
    let mut joints = vec![Joint::free("knot").with_mass(knot_kg)];
    let mut members = vec![];
    let mut mass_kg = kg;
    for (at, lengths) in anchors.iter().zip(strands) {
        let mut here = joints.len();
        joints.push(Joint::anchor(format!("A{here}"), *at));
        for (i, length_m) in lengths.iter().enumerate() {
            let there = if i + 1 == lengths.len() { 0 } else { joints.len() };
            if there > 0 {
                joints.push(Joint::free(format!("P{there}")).with_mass(mass_kg));
            }
            members.push(Member::bar(here, there, light(*length_m)));
            here = there;
        }
        mass_kg *= 1.1;
    }
    System::new("bridle", G, joints, members).unwrap()
}

/// Strands of so many bars, about as long as the bridle asks for, drawn at random.
fn drawn(random: &mut ChaCha8Rng, bars: &[usize]) -> System {
    let (mut anchors, mut lengths) = (vec![], vec![]);
    for (k, strand) in bars.iter().enumerate() {
        let part = (k as f64 + random.random_range(-0.3..0.3)) / bars.len() as f64;
        let angle = part * std::f64::consts::TAU;
        anchors.push([2.0 * angle.cos(), 2.0 * angle.sin(), random.random_range(-0.5..0.5)]);
        let total = random.random_range(2.3..3.5);
        let parts: Vec<f64> = (0..*strand).map(|_| random.random_range(0.7..1.3)).collect();
        let whole: f64 = parts.iter().sum();
        lengths.push(parts.into_iter().map(|part| part * total / whole).collect::<Vec<f64>>());
    }
    let strands: Vec<&[f64]> = lengths.iter().map(Vec::as_slice).collect();
    bridle(&anchors, &strands, random.random_range(0.0..1.0), random.random_range(0.1..1.0))
}

const CORNERS: [Vector; 3] = [[2.0, 0.0, 0.0], [-1.0, 1.5, 0.2], [-1.1, -1.6, -0.1]];

/// The alternating sum of the indices.
fn alternating(census: &SystemCensus) -> i64 {
    census.equilibria.iter().map(|e| if e.index_in_space % 2 == 0 { 1 } else { -1 }).sum()
}

/// By Morse theory the alternating sum of the indices is the Euler characteristic of the
/// configurations, whatever the loads: of the knot and of the other joints, kg.
#[track_caller]
fn the_sum_is_the_same(strands: &[&[f64]; 3], loads_kg: &[(f64, f64)]) {
    let sum = |(knot_kg, kg): &(f64, f64)| {
        let census = taken(&bridle(&CORNERS, strands, *knot_kg, *kg));
        assert!(census.complete, "{:?}", census.nets().next().unwrap().undecided);
        let lowest = &census.equilibria[0];
        assert_eq!(lowest.index_in_space, 0);
        assert!(lowest.axial_n.iter().all(|axial| axial.lo() > 0.0));
        alternating(&census)
    };
    let sums: Vec<i64> = loads_kg.iter().map(sum).collect();
    assert!(sums.iter().all(|sum| *sum == sums[0]), "{strands:?}: {sums:?}");
}

#[test]
fn the_alternating_sum_does_not_depend_on_the_loads() {
    for strands in [
        [&[1.5, 1.4][..], &[1.9], &[2.1]],
        [&[1.5, 1.4][..], &[1.3, 1.2], &[2.2]],
        [&[1.5, 1.4][..], &[1.3, 1.2], &[1.6, 1.1]],
        [&[1.5, 1.5][..], &[1.5, 1.5], &[1.5, 1.5]],
        // Two knots in space, one of them in a strand.
        [&[0.9, 0.95, 1.0][..], &[1.9], &[2.2]],
    ] {
        the_sum_is_the_same(&strands, &[(1.0, 0.5), (0.0, 1.0), (0.3, 2.0), (9.0, 0.1)]);
    }
}

/// Level anchors at the corners of an equilateral triangle, strands of two equal bars: the lowest
/// equilibrium has the symmetry of the triangle. Each strand bears its own weight P and a third of
/// the load W: with the pull H, slopes (P + W/3)/H and W/(3H).
#[test]
fn a_symmetric_bridle_hangs_by_its_closed_form() {
    let half = 0.5 * 3.0_f64.sqrt();
    let (load_n, weight_n, pull_n) = (12.0, 5.0, 3.0);
    let steep: f64 = f64::hypot(pull_n, weight_n + load_n / 3.0);
    let flat: f64 = f64::hypot(pull_n, load_n / 3.0);
    // Bars of 1 m: how far each reaches in and down.
    let reach = pull_n / steep + pull_n / flat;
    let depth = (weight_n + load_n / 3.0) / steep + (load_n / 3.0) / flat;
    let mut joints = vec![Joint::free("knot").with_mass(load_n / G)];
    let mut members = vec![];
    for (k, [x, y]) in [[1.0, 0.0], [-0.5, half], [-0.5, -half]].into_iter().enumerate() {
        joints.push(Joint::anchor(format!("A{k}"), [reach * x, reach * y, 0.0]));
        joints.push(Joint::free(format!("P{k}")).with_mass(weight_n / G));
        members.push(Member::bar(2 * k + 1, 2 * k + 2, light(1.0)));
        members.push(Member::bar(2 * k + 2, 0, light(1.0)));
    }
    let census = taken(&System::new("symmetric", G, joints, members).unwrap());
    assert!(census.complete);
    let lowest = &census.equilibria[0];
    assert!((lowest.joints_m[0][2].mid() + depth).abs() < 1e-13);
    for (axial, n) in lowest.axial_n.iter().zip([steep, flat].into_iter().cycle()) {
        assert!((axial.mid() - n).abs() < 1e-12 && axial.width() < 1e-12, "{axial:?}");
    }
    // Its mirror image in the level plane stands.
    let highest = census.equilibria.last().unwrap();
    assert!((highest.joints_m[0][2].mid() - depth).abs() < 1e-13);
}

/// Two anchors bear two rows of two joints: six bars, two closures. In space the joints move in
/// five ways, in the plane of the anchors in two.
#[test]
fn a_mesh_is_searched_in_its_plane() {
    let mut joints: Vec<Joint> = [[-1.0, 0.5, 0.0], [0.3, 0.5, 0.2]]
        .into_iter()
        .enumerate()
        .map(|(k, at)| Joint::anchor(format!("A{k}"), at))
        .collect();
    for k in 0..4 {
        joints.push(Joint::free(format!("P{k}")).with_mass(0.3 + 0.1 * f64::from(k)));
    }
    let down = [(0, 2, 0.9), (1, 3, 1.0), (2, 4, 0.7), (3, 5, 0.75)];
    let level = [(2, 3, 1.05), (4, 5, 0.95)];
    let members = down.into_iter().chain(level).map(|(a, b, l)| Member::bar(a, b, light(l)));
    let mesh = System::new("mesh", G, joints, members.collect()).unwrap();
    let census = taken(&mesh);
    let net = census.nets().next().unwrap();
    println!("{} {:?}", census.equilibria.len(), net);
    assert!(net.in_plane && net.undecided.is_empty() && !census.complete);
    assert_eq!(net.closures, 2);
    let lowest = &census.equilibria[0];
    assert_eq!(lowest.index_in_space, 0);
    let flat = |at: &[Interval; 3]| at[1].contains(0.5) && at[1].width() < 1e-12;
    assert!(census.equilibria.iter().all(|one| one.joints_m.iter().all(flat)));
    let open = census.completeness(&mesh);
    assert_eq!(open, Status::Open(Reason::NoCensus(NoCensus::PlaneOnly)));
}

/// What turns freely is named, and so are self-stresses and bars that nothing turns.
#[test]
fn what_has_no_list_is_named() {
    let refusal = |system: &System| SystemCensus::take(system, &Settings::default()).unwrap_err();
    let upright = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, 1.0]];
    let strands = [&[1.5, 1.4][..], &[1.3, 1.2], &[1.6, 1.1]];
    assert_eq!(refusal(&bridle(&upright, &strands, 1.0, 1.0)), NoCensus::Turns { joint: 2 });
    assert_eq!(refusal(&bridle(&CORNERS, &strands, 1.0, 0.0)), NoCensus::Limp { member: 1 });
    // A triangle that hangs at the knot.
    let whole = bridle(&CORNERS, &strands, 1.0, 1.0);
    let (mut joints, mut members) = (whole.joints().to_vec(), whole.members().to_vec());
    let n = joints.len();
    joints.extend([Joint::free("L").with_mass(1.0), Joint::free("R").with_mass(1.0)]);
    members.extend([(0, n), (0, n + 1), (n, n + 1)].map(|(a, b)| Member::bar(a, b, light(1.0))));
    let mobile = System::new("mobile", G, joints, members).unwrap();
    assert_eq!(refusal(&mobile), NoCensus::Turns { joint: 1 });
}

/// How many of a list Newton's method finds; it must find nothing else.
fn found_of(system: &System, census: &SystemCensus, starts: usize, seed: u64) -> usize {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut seen = vec![false; census.equilibria.len()];
    let acting = Acting::new(system, (0..system.members().len()).collect());
    for at in (0..starts).filter_map(|_| acting.newton(&mut random)) {
        let listed = census.equilibria.iter().position(|one| {
            let places = acting.free.iter().flat_map(|k| &one.joints_m[*k]).zip(&at);
            places.into_iter().all(|(all, x)| (all.mid() - x).abs() < 1e-6)
        });
        seen[listed.unwrap_or_else(|| panic!("{at:?} is not listed"))] = true;
    }
    seen.into_iter().filter(|seen| *seen).count()
}

#[test]
fn newton_from_many_starts_finds_nothing_that_is_not_listed() {
    /// Measured: they find 35 of 36.
    const STARTS: usize = 600;
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let (mut found, mut listed, mut complete) = (0, 0, 0);
    for seed in 0..10 {
        let strands = random.random_range(3..=4);
        let bars: Vec<usize> =
            (0..strands).map(|k| if k < 2 { 2 } else { random.random_range(1..=2) }).collect();
        let system = drawn(&mut random, &bars);
        let Ok(census) = SystemCensus::take(&system, &Settings::default()) else { continue };
        complete += usize::from(census.complete);
        listed += census.equilibria.len();
        found += found_of(&system, &census, STARTS, seed);
    }
    assert!(complete >= 8 && 10 * found > 9 * listed, "{complete}, {found} of {listed}");
}

/// Rings of so many joints, each held by an anchor: as many bars as coordinates in a plane, one
/// motion more for each joint in space. A budget of next to no tests is spent at once.
#[test]
fn rings_of_every_number_of_knots_are_searched() {
    let ring = |knots: usize, y: f64| {
        let (mut joints, mut members) = (vec![], vec![]);
        for k in 0..knots {
            let angle = std::f64::consts::TAU * k as f64 / knots as f64;
            let off = if k % 2 == 0 { 0.0 } else { y };
            // The ring of bars about the middle, and 1 m from it to each anchor.
            let radius = 1.0 + 0.55 / (0.5 * std::f64::consts::TAU / knots as f64).sin();
            joints.push(Joint::anchor(
                format!("A{k}"),
                [radius * angle.cos(), off, radius * angle.sin()],
            ));
            joints.push(Joint::free(format!("P{k}")).with_mass(0.1));
            members.push(Member::bar(2 * k, 2 * k + 1, light(1.3)));
            members.push(Member::bar(2 * k + 1, (2 * k + 3) % (2 * knots), light(1.1)));
        }
        System::new("ring", G, joints, members).unwrap()
    };
    let search = |knots: usize, y: f64, max_motions: usize| {
        let settings = Settings { max_motions, max_tests_per_pattern: 1, ..Settings::default() };
        SystemCensus::take(&ring(knots, y), &settings).map(|census| {
            let net = census.nets().next().unwrap();
            assert!(net.undecided.iter().all(|open| open.reason == Open::Budget));
            assert_eq!((net.knots.len(), net.swings.len(), net.closures), (knots, 0, knots));
            net.in_plane
        })
    };
    for knots in 3..=5 {
        assert_eq!(search(knots, 0.0, 1), Ok(true), "{knots}");
    }
    for knots in 3..=4 {
        assert_eq!(search(knots, 0.5, knots), Ok(false), "{knots}");
    }
    assert_eq!(search(5, 0.5, 5), Err(NoCensus::Closures { closures: 5 }));
    let refused = search(4, 0.5, 3);
    assert_eq!(refused, Err(NoCensus::Motions { closures: 4, motions: 4, limit: 3 }));
    // One knot on four strands in a plane.
    let strands: [&[f64]; 4] = [&[1.5, 1.4]; 4];
    let anchors = [[2.0, 0.0, 0.0], [-2.0, 0.0, 0.1], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.2]];
    let settings = Settings { max_motions: 2, max_tests_per_pattern: 1, ..Settings::default() };
    let census = SystemCensus::take(&bridle(&anchors, &strands, 1.0, 0.5), &settings).unwrap();
    let net = census.nets().next().unwrap();
    assert_eq!((net.knots.len(), net.swings.len(), net.in_plane), (1, 4, true));
}

/// Positions, undecided boxes, the sum of all indices; cells and tests; the sums of the binary
/// orders of the widths of places, in metres, and of forces, in newtons.
fn work(census: &SystemCensus) -> [i64; 7] {
    #[expect(clippy::cast_possible_truncation, reason = "binary orders of doubles are small")]
    let order = |width: f64| if width > 0.0 { width.log2().floor() as i64 } else { 0 };
    let whole = |number: u64| i64::try_from(number).unwrap();
    let all = &census.equilibria;
    [
        whole(all.len() as u64),
        whole(census.undecided() as u64),
        whole(all.iter().map(|one| one.index_in_space as u64).sum()),
        whole(census.cells()),
        whole(census.nets().map(|net| net.tests).sum()),
        all.iter().map(|one| order(one.width_m())).sum(),
        all.iter().map(|one| order(one.width_n())).sum(),
    ]
}

/// What is found, and what it takes, by places: frozen.
#[test]
fn work_of_small_nets() {
    let nets: [(&str, [&[f64]; 3], f64, f64); 5] = [
        ("one strand", [&[1.5, 1.4], &[1.9], &[2.1]], 1.0, 0.5),
        ("two strands", [&[1.5, 1.4], &[1.3, 1.2], &[2.2]], 1.0, 0.5),
        ("three strands", [&[1.5, 1.4], &[1.3, 1.2], &[1.6, 1.1]], 1.0, 0.5),
        ("equal bars", [&[1.5, 1.5], &[1.5, 1.5], &[1.5, 1.5]], 0.3, 2.0),
        ("light knot", [&[1.5, 1.5], &[1.5, 1.5], &[1.5, 1.5]], 0.0, 1.0),
    ];
    let mut found = vec![];
    for (name, strands, knot_kg, kg) in nets {
        let system = bridle(&CORNERS, &strands, knot_kg, kg);
        let census = SystemCensus::take(&system, &Settings::default()).unwrap();
        found.push((name, work(&census)));
    }
    let expected = [
        ("one strand", [2, 0, 2, 48, 81, -96, -88]),
        ("two strands", [2, 0, 4, 280, 663, -96, -88]),
        ("three strands", [2, 0, 6, 2686, 10837, -96, -88]),
        ("equal bars", [2, 0, 6, 9625, 32664, -96, -88]),
        ("light knot", [2, 0, 6, 9821, 34446, -96, -90]),
    ];
    assert_frozen(&found[..], &expected);
}

/// A net of 40 x 40 elastic cables, one of them a bar, is refused by the count of its joints; what tells the reasons of a
/// refusal apart would take minutes.
#[test]
fn a_large_net_is_refused_at_once() {
    const SIDE: usize = 40;
    let at = |i: usize, j: usize| SIDE * i + j;
    let joints = (0..SIDE * SIDE).map(|k| {
        let (i, j) = (k / SIDE, k % SIDE);
        let corner = i % (SIDE - 1) == 0 && j % (SIDE - 1) == 0;
        if corner {
            Joint::anchor(k.to_string(), [i as f64, j as f64, 0.0])
        } else {
            Joint::free(k.to_string()).with_mass(1.0)
        }
    });
    let cables = (0..SIDE).flat_map(|i| {
        (1..SIDE).flat_map(move |j| [(at(i, j - 1), at(i, j)), (at(j - 1, i), at(j, i))])
    });
    let cables = cables.map(|(a, b)| Member::cable(a, b, light(1.1)).with_stiffness(1e4));
    let mut cables: Vec<Member> = cables.collect();
    cables[0].kind = Kind::Bar;
    let system = System::new("net", G, joints.collect(), cables).unwrap();
    let (members, moving) = (2 * SIDE * (SIDE - 1), SIDE * SIDE - 4);
    let refused = SystemCensus::take(&system, &Settings::default());
    assert_eq!(refused, Err(NoCensus::Closures { closures: members - moving }));
}
