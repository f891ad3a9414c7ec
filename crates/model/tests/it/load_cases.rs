//! Loads with names and load cases in system files: read, refused, written back, and put together.

use model::system::{PERMANENT, System};
use model::system_file::write_network;

use crate::support::{refused_at, system};

/// A net with loads of its own, and what stands in its file besides.
fn net(rest: &str) -> String {
    format!(
        "joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [6, 0, 0] }}, P = {{ mass_kg = 3 }}, Q = {{ force_n = [0, 5, 0] }} }}\n\
         bars = [{{ from = \"A\", to = \"P\", length_m = 3, mass_kg = 2, forces = [{{ force_n = [1, 0, 0] }}] }},\n\
         {{ from = \"P\", to = \"Q\", length_m = 2, mass_kg = 1, stiffness_n = 1000, prestress_n = 250, inertia_kg_m2 = [0.1, 0.4, 0.5] }},\n\
         {{ from = \"Q\", to = \"B\", length_m = 3, mass_kg = 2 }}]\n{rest}"
    )
}

fn chain(rest: &str) -> String {
    format!(
        "anchors = {{ start_m = [0, 0, 0], end_m = [2, 0, 0] }}\n\
         bars = [{{ length_m = 1, mass_kg = 1, count = 3 }}]\n{rest}"
    )
}

const LOADS: &str = "[[loads]]\njoint = \"Q\"\nmass_kg = 0.5\n\
     [[loads]]\nname = \"snow\"\njoint = [\"P\", \"Q\"]\nmass_kg = 8\n\
     [[loads]]\nname = \"wind\"\nbar = [1, 2]\nforce_n_per_m = [0, 4, 0]\n\
     [[loads]]\nname = \"wind\"\njoint = \"P\"\nforce_n = [0, 7, 1]\n\
     [[cases]]\nname = \"winter\"\nfactors = { permanent = 1.5, snow = 2 }\n\
     [[cases]]\nname = \"storm\"\nfactors = { wind = -0.5 }\n";

/// Masses and forces of joints, masses of members, and their forces one after the other.
type Acting = (Vec<(f64, [f64; 3])>, Vec<f64>, Vec<Vec<[f64; 3]>>);

fn acting(system: &System) -> Acting {
    let joints = system.joints()[2..].iter().map(|joint| (joint.mass_kg, joint.force_n));
    let masses = system.members().iter().map(|member| member.body.mass_kg());
    let forces = system.members().iter().map(|m| m.loads.iter().map(|load| load.force_n).collect());
    (joints.collect(), masses.collect(), forces.collect())
}

#[test]
fn each_case_has_its_loads_by_their_factors() {
    let system = system(&net(LOADS));
    let along = [0.0, 4.0, 0.0];
    let wanted: Acting = (
        vec![(11.0, [0.0, 7.0, 1.0]), (8.5, [0.0, 5.0, 0.0])],
        vec![2.0, 1.0, 2.0],
        // Of 3 m; the prestressed one is as long as it is given, 2 m.
        vec![vec![[1.0, 0.0, 0.0], along.map(|x| 3.0 * x)], vec![along.map(|x| 2.0 * x)], vec![]],
    );
    assert_eq!(acting(&system), wanted);
    let wanted: Acting = (
        vec![(20.5, [0.0; 3]), (16.75, [0.0, 7.5, 0.0])],
        vec![3.0, 1.5, 3.0],
        vec![vec![[1.5, 0.0, 0.0]], vec![], vec![]],
    );
    let winter = system.in_case("winter").unwrap();
    assert_eq!((acting(&winter), winter.name()), (wanted, "unnamed, winter"));
    let heavier = &winter.members()[1];
    let inertia = heavier.given_body().inertia_kg_m2();
    assert!(inertia.iter().zip([0.15, 0.6, 0.75]).all(|(j, wanted)| (j - wanted).abs() < 1e-15));
    assert_eq!((heavier.prestress_n(), heavier.body.length_m()), (Some(250.0), 1.6));
    let wanted: Acting = (
        vec![(3.0, [0.0, -3.5, -0.5]), (0.5, [0.0, 5.0, 0.0])],
        vec![2.0, 1.0, 2.0],
        vec![vec![[1.0, 0.0, 0.0], along.map(|x| -1.5 * x)], vec![along.map(|x| -x)], vec![]],
    );
    let storm = system.in_case("storm").unwrap();
    assert_eq!(acting(&storm), wanted);
    // In the middle, of the prestressed one at both its lengths.
    let [short, given] =
        [&storm.members()[1].loads, storm.members()[1].given_loads()].map(|l| l[0].at_m);
    assert_eq!((short, given), (0.8, 1.0));
    assert!(storm.load_cases().is_empty() && storm.named_loads().is_empty());
    let permanent = system.without_named_loads();
    assert_eq!(permanent.joints()[3].mass_kg.to_bits(), 0.5_f64.to_bits());
    let said = system.in_case("summer").unwrap_err().to_string();
    assert_eq!(said, "there is no load case \"summer\"; there are \"winter\", \"storm\"");
    assert_eq!(system.load_cases()[1].factor(PERMANENT).to_bits(), 1_f64.to_bits());
    // A floor stays where it is.
    let above = system.clone().with_floor(-9.0).unwrap().in_case("storm").unwrap();
    assert_eq!(above.floor_m(), Some(-9.0));
    // What the factors make of it has to be a system: masses do not lift.
    let light = LOADS.replace("wind = -0.5", "snow = -1");
    let error = self::system(&net(&light)).in_case("storm").unwrap_err().to_string();
    assert!(error.contains("mass at joint \"P\""), "{error}");
}

/// What a mass or force may be off is multiplied with it, and that of all counts for loads as well.
#[test]
fn tolerances_go_with_the_loads() {
    let text = format!("[tolerances]\nmass_tolerance_kg = 0.1\nforce_tolerance_n = 0.25\n{LOADS}");
    let system = system(&net(&text));
    let off = |system: &System, joint: usize| {
        system.joints()[joint].tolerances.as_deref().map(|t| [t.mass_kg(), t.force_n()])
    };
    // P has its force by the load alone, Q its mass.
    assert_eq!([2, 3].map(|joint| off(&system, joint)), [Some([0.1, 0.25]); 2]);
    let winter = system.in_case("winter").unwrap();
    assert_eq!([2, 3].map(|joint| off(&winter, joint)), [Some([0.2, 0.5]); 2]);
    let of_bar = winter.members()[0].tolerances.as_deref().map(|t| 1e9 * t.mass_kg());
    assert_eq!(of_bar.map(f64::round), Some(0.15e9));
    let storm = system.in_case("storm").unwrap();
    assert_eq!([2, 3].map(|joint| off(&storm, joint)), [Some([0.1, 0.25]); 2]);
}

#[test]
fn chains_have_them_too() {
    let loads = "[[loads]]\nname = \"ice\"\njoint = [1, 2]\nmass_kg = 2\n\
                 [[loads]]\nname = \"wind\"\nbar = 3\nforce_n_per_m = [0, 4, 0]\n\
                 [[cases]]\nname = \"winter\"\nfactors = { ice = 3 }\n";
    let system = system(&chain(loads));
    let winter = system.in_case("winter").unwrap();
    assert_eq!((winter.joints()[1].mass_kg, winter.joints()[2].mass_kg), (6.0, 6.0));
    assert_eq!(acting(&system).2[2], [[0.0, 4.0, 0.0]]);
    assert!(winter.members()[2].loads.is_empty());
}

#[test]
fn they_are_written_and_read_again() {
    let read = |first: &System| system(&write_network(first));
    let first = system(&net(LOADS));
    let again = read(&first);
    let all = |system: &System| {
        (system.joints().to_vec(), system.members().to_vec(), system.named_loads().to_vec())
    };
    assert_eq!(all(&again), all(&first));
    assert_eq!(again.load_cases(), first.load_cases());
    // Loads without a name are numbers of their joints now.
    assert_eq!(read(&again), again);
}

#[test]
fn what_is_no_load_or_case_is_refused_where_it_stands() {
    let wind = "[[loads]]\nname = \"wind\"\njoint = \"P\"\nforce_n = [0, 1, 0]\n";
    let storm = "[[cases]]\nname = \"storm\"\n";
    for (rest, key, words) in [
        ("[[loads]]\njoint = \"R\"\nmass_kg = 1", "loads[1].joint", "no joint \"R\""),
        ("[[loads]]\njoint = [\"P\", \"B\"]\nmass_kg = 1", "loads[1].joint", "anchor"),
        ("[[loads]]\njoint = 3\nmass_kg = 1", "loads[1].joint", "name of a joint"),
        ("[[loads]]\njoint = \"P\"", "loads[1].joint", "mass_kg or force_n"),
        ("[[loads]]\nmass_kg = 1", "loads[1].joint", "where the load acts"),
        ("[[loads]]\njoint = \"P\"\nmass_kg = -1", "loads[1].mass_kg", "zero or positive"),
        ("[[loads]]\njoint = \"P\"\nforce_n = [0, nan, 0]", "loads[1].force_n[2]", "finite"),
        ("[[loads]]\njoint = []\nmass_kg = 1", "loads[1].joint", "where the load acts"),
        ("[[loads]]\nbar = []\nforce_n_per_m = [0, 0, 1]", "loads[1].bar", "number of a bar"),
        ("[[loads]]\nbar = 1", "loads[1].force_n_per_m", "each metre"),
        ("[[loads]]\nbar = 4\nforce_n_per_m = [0, 0, 1]", "loads[1].bar", "number of bars"),
        ("[[loads]]\nbar = 0\nforce_n_per_m = [0, 0, 1]", "loads[1].bar", "from 1"),
        ("[[loads]]\nbar = 1\nforce_n_per_m = [0, 0, inf]", "loads[1].force_n_per_m[3]", "finite"),
        ("[[loads]]\nbar = 1\nmass_kg = 1", "loads[1].mass_kg", "`bar`"),
        ("[[loads]]\nbar = 1\njoint = \"P\"", "loads[1].joint", "`bar`"),
        (
            "[[loads]]\njoint = \"P\"\nforce_n_per_m = [0, 0, 1]",
            "loads[1].force_n_per_m",
            "`joint`",
        ),
        ("[[loads]]\njoit = \"P\"", "loads[1].joit", "did you mean `joint`"),
        ("loads = 3", "loads", "[[loads]]"),
        ("cases = 3", "cases", "[[cases]]"),
        ("[[cases]]\nfactors = {}", "cases[1].name", "called"),
        (storm, "cases[1].factors", "names of loads"),
        ("[[cases]]\nname = \"each\"\nfactors = {}", "cases[1].name", "all cases"),
    ] {
        refused(rest, key, words);
    }
    for (factors, words) in [
        ("snow = 1", "no load is called"),
        ("wind = inf", "finite"),
        ("permanent = -1", "negative"),
    ] {
        refused(&format!("{wind}{storm}factors = {{ {factors} }}"), "cases[1].factors", words);
    }
    refused(
        &format!("{wind}{storm}factors = {{ wind = \"much\" }}"),
        "cases[1].factors.wind",
        "number",
    );
    let twice = format!("{wind}{storm}factors = {{}}\n{storm}factors = {{ wind = 2 }}");
    refused(&twice, "cases[2].name", "two load cases");
}

#[track_caller]
fn refused(rest: &str, key: &str, words: &str) {
    refused_at(&net(rest), key, words);
}
