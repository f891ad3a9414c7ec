//! Sweeps over seeds: the same bits however they are cut, every seed accounted for, and the
//! equilibria those of the census and of the scalar solvers.

use model::{Anchors, Bar, Chain, Problem};
use sweep::{Axis, Chunk, Comparison, Failure, Settings, Source, Summary, Sweep};

/// A chain between anchors at different heights, its bars all different: four planar equilibria at
/// least.
fn uneven(bars: usize) -> Problem {
    let list = (0..bars)
        .map(|k| {
            let length = 1.0 + 0.37 * ((3 * k + 1) % 5) as f64;
            Bar::new(length, 0.5 + 0.41 * ((2 * k) % 3) as f64, 0.4 * length, [0.0; 3]).unwrap()
        })
        .collect();
    let anchors = Anchors { start_m: [0.3, -0.2, 1.0], end_m: [1.7, 0.9, 0.2] };
    Problem::new(Chain::new("uneven", 9.81, anchors, list).unwrap()).unwrap()
}

fn sweep_of(problem: &Problem, settings: Settings) -> Result<Sweep, sweep::SweepError> {
    Sweep::new(problem, settings, funicular::starts::solvers(problem).unwrap())
}

/// All bits of a chunk, columns one after the other.
fn bits(chunks: &[Chunk]) -> Vec<u64> {
    let mut all = vec![];
    for outcomes in chunks.iter().flat_map(|chunk| &chunk.outcomes) {
        all.extend(outcomes.outcome.iter().map(|x| u64::from(x.cast_unsigned())));
        all.extend(outcomes.iterations.iter().map(|x| u64::from(*x)));
        all.extend(outcomes.residual.iter().chain(&outcomes.energy_j).map(|x| x.to_bits()));
    }
    all
}

#[test]
fn a_run_of_seeds_has_the_same_bits_however_it_is_cut() {
    let grid = Source::Grid(vec![Axis::full(40), Axis::full(30), Axis::fixed(0.3)]);
    for source in [Source::Uniform, Source::Sobol, grid] {
        let settings = Settings { number: 5, source, ..Settings::default() };
        let sweep = sweep_of(&model::cases::paper(), settings).unwrap();
        let whole = sweep.run_chunk(100..3100);
        let mut start = 100;
        // Lengths below, at and above a group of lanes and a block.
        for length in [1, 7, 8, 500, 1024, 1025] {
            let part = sweep.run_chunk(start..start + length);
            let at = usize::try_from(start - 100).unwrap();
            let end = at + usize::try_from(length).unwrap();
            assert_eq!((part.outcomes.len(), whole.outcomes.len()), (2, 2));
            for (part, whole) in part.outcomes.iter().zip(&whole.outcomes) {
                assert_eq!(part.outcome, whole.outcome[at..end]);
                assert_eq!(part.iterations, whole.iterations[at..end]);
                let same =
                    |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
                assert!(same(&part.energy_j, &whole.energy_j[at..end]));
                assert!(same(&part.residual, &whole.residual[at..end]));
            }
            start += length;
        }
        assert_eq!(bits(&[whole]), bits(&[sweep.run_chunk(100..3100)]));
    }
}

#[test]
fn a_summary_is_the_same_for_any_threads_and_chunks() {
    let problem = uneven(4);
    let run = |threads: usize, chunk: u64| {
        let settings = Settings { chunk, ..Settings::default() };
        sweep_of(&problem, settings).unwrap().run(11..6011, threads).unwrap()
    };
    let one = run(1, 6000);
    for (threads, chunk) in [(2, 1000), (3, 7), (2, 1), (1, 16_384)] {
        assert_eq!(one, run(threads, chunk));
    }
    // Folded by hand, in another order.
    let sweep = sweep_of(&problem, Settings::default()).unwrap();
    let nothing = || Summary::new(sweep.members().list(), sweep.members().energy_unit_j());
    let mut last = nothing();
    last.add(&sweep.run_chunk(5000..6011));
    let mut first = nothing();
    first.add(&sweep.run_chunk(11..5000));
    last.merge(&first);
    assert_eq!(one, last);
}

#[test]
fn every_seed_of_the_paper_is_accounted_for_and_listed() {
    let sweep = sweep_of(&model::cases::paper(), Settings::default()).unwrap();
    assert!(sweep.members().complete());
    let summary = sweep.run(0..100_000, 2).unwrap();
    let tally = summary.tally();
    let (lagrange, energy) = (tally.of("lagrange").unwrap(), tally.of("energy").unwrap());
    let counts = |rows: &sweep::SolverTally| {
        rows.0.iter().map(|(outcome, row)| (*outcome, row.count)).collect::<Vec<_>>()
    };
    // E1 and its image are minima, 0 and 1; E2 and its image maxima, 2 and 3.
    let (newton, descent) = (counts(lagrange), counts(energy));
    assert_eq!(newton.iter().map(|row| row.0).collect::<Vec<_>>(), [0, 1, 2, 3]);
    assert_eq!(descent.iter().map(|row| row.0).collect::<Vec<_>>(), [0, 1]);
    assert_eq!(newton.iter().map(|row| row.1).sum::<u64>(), 100_000);
    assert_eq!(descent.iter().map(|row| row.1).sum::<u64>(), 100_000);
    // The mirror image of a seed is as likely as the seed: equal rates, to five standard deviations
    // of the difference of two counts.
    for pair in [&newton[..2], &newton[2..], &descent[..]] {
        let (a, b) = (pair[0].1 as f64, pair[1].1 as f64);
        assert!((a - b).abs() < 5.0 * (a + b).sqrt(), "{a} {b}");
    }
    assert_eq!(summary.comparisons().map(|row| row.1).sum::<u64>(), 100_000);
    assert!(summary.disagreements().is_empty());
    // By the symmetry each minimum has half of them.
    let (low, high) = sweep::rate_interval(descent[0].1, 100_000);
    assert!(low < 0.5 && 0.5 < high && high - low < 0.007, "{low} to {high}");
}

#[test]
fn longer_chains_are_identified_against_the_census() {
    for bars in [5, 6, 8] {
        let settings = Settings::default();
        let sweep = sweep_of(&uneven(bars), settings).unwrap();
        assert!(sweep.members().complete());
        let summary = sweep.run(0..3000, 2).unwrap();
        let tally = summary.tally();
        // Nothing converges to what the census does not have, and every minimum is a minimum there.
        assert!(summary.disagreements().is_empty(), "{:?}", summary.disagreements());
        assert_eq!(tally.names().collect::<Vec<_>>(), ["lagrange", "energy"]);
        for (_, sweep::SolverTally(rows)) in &tally.solvers {
            assert!(!rows.contains_key(&(Failure::Unlisted as i16)));
            assert_eq!(rows.values().map(|row| row.count).sum::<u64>(), 3000);
        }
        let failed = |rows: &sweep::SolverTally| -> u64 {
            rows.0.iter().filter(|row| *row.0 < 0).map(|row| row.1.count).sum()
        };
        assert_eq!(failed(tally.of("energy").unwrap()), 0);
        assert!(failed(tally.of("lagrange").unwrap()) < 30);
    }
}

/// A taut chain has energies near zero and errors that grow with its forces.
#[test]
fn the_energies_of_a_taut_chain_agree() {
    let problem = model::cases::get("nearly-taut").unwrap().problem();
    let sweep = sweep_of(&problem, Settings::default()).unwrap();
    let summary = sweep.run(0..3000, 2).unwrap();
    assert!(summary.disagreements().is_empty(), "{:?}", summary.disagreements().first());
    let same = summary.comparisons().find(|row| row.0 == Comparison::Same).unwrap().1;
    assert!(same > 1000, "{same}");
}

/// Without a census the list is what the seeds reach: a part of the census, whoever computes it.
#[test]
fn a_discovered_list_is_a_part_of_the_census() {
    let problem = uneven(4);
    let census = census::Settings { max_bars: 3, ..census::Settings::default() };
    let full = sweep_of(&problem, Settings::default()).unwrap();
    let all = full.members().list();
    let open = sweep_of(&problem, Settings { census, ..Settings::default() }).unwrap();
    assert!(full.members().complete() && open.members().list().is_empty());
    let swept = |threads: usize, cuts: &[u64]| {
        let mut swept = open.begin();
        for range in cuts.windows(2) {
            open.go_on(&mut swept, range[0]..range[1], threads).unwrap();
        }
        swept.finish()
    };
    let (summary, discovered) = swept(1, &[0, 5000]);
    assert_eq!(swept(3, &[0, 1, 700, 5000]), (summary.clone(), discovered.clone()));
    let discovered = discovered.unwrap();
    assert_eq!((discovered.equilibria.len(), discovered.below_j), (all.len(), None));
    for (a, b) in discovered.equilibria.iter().zip(all) {
        assert!((a.energy_j - b.energy_j).abs() < 1e-9);
        assert!(a.index_in_plane.is_none() || a.index_in_plane == b.index_in_plane);
    }
    // The same numbers, and so the same counts, as by the list of the census.
    let wanted = full.run(0..5000, 2).unwrap();
    assert_eq!(summary.tally(), wanted.tally());
    assert!(summary.disagreements().is_empty());
    let count = |of: &Summary, wanted: Comparison| {
        of.comparisons().find(|(comparison, _)| *comparison == wanted).unwrap().1
    };
    for same in [Comparison::Same, Comparison::OtherBasin, Comparison::Failed] {
        assert_eq!(count(&summary, same), count(&wanted, same), "{same:?}");
    }
    // Only minima are of known kind.
    let (saddles, unknown) = (Comparison::NoMinimum, Comparison::Unclassified);
    assert_eq!(count(&summary, unknown), count(&wanted, saddles));
}

/// Nearly every start of a long chain leads somewhere else: the lowest are listed, and whatever is
/// as low is one of them.
#[test]
fn a_discovered_list_holds_the_lowest() {
    let problem = model::cases::get("thirty-bars").unwrap().problem();
    let sweep = sweep_of(&problem, Settings::default()).unwrap();
    let mut reached = sweep.nothing_reached().unwrap();
    let mut all = sweep::Outcomes::default();
    let mut both = [all.clone(), all.clone()];
    sweep.run_chunks(0..3000, 100, &mut reached, &mut |chunk| {
        for (all, part) in both.iter_mut().zip(&chunk.outcomes) {
            all.outcome.extend(&part.outcome);
            all.energy_j.extend(&part.energy_j);
        }
    });
    for outcomes in both {
        all.outcome.extend(outcomes.outcome);
        all.energy_j.extend(outcomes.energy_j);
    }
    let discovered = reached.renumber(&mut all);
    let list = &discovered.equilibria;
    assert!(list.is_sorted_by(|a, b| a.energy_j <= b.energy_j));
    let below_j = discovered.below_j.unwrap();
    // Up to a gap between energies: the entry of a mirror image may be missing.
    assert!((sweep::DISCOVERED - 10..=sweep::DISCOVERED).contains(&list.len()), "{}", list.len());
    let unit_j = sweep.members().energy_unit_j();
    let mut high = 0;
    for (outcome, energy_j) in all.outcome.iter().zip(&all.energy_j) {
        if let Ok(entry) = usize::try_from(*outcome) {
            assert!((energy_j - list[entry].energy_j).abs() <= 1e-9 * unit_j);
            assert!(*energy_j < below_j);
        } else if *outcome == Failure::Unlisted as i16 {
            assert!(*energy_j >= below_j);
            high += 1;
        }
    }
    assert!(high > 100, "{high}");
    // All descents end in the one minimum.
    assert_eq!(list.iter().filter(|member| member.index_in_plane == Some(0)).count(), 1);
    assert_eq!(list[0].index_in_plane, Some(0));
    assert!(all.outcome[3000..].iter().all(|outcome| *outcome == 0));
}

/// Everything that a solver reaches is within the radius of the entry that it is told to be: joint
/// by joint, from the angles of the list and the directions that the solver ends with.
#[test]
fn what_is_reached_is_where_the_list_says() {
    let problem = uneven(18);
    let sweep = sweep_of(&problem, Settings::default()).unwrap();
    let mut reached = sweep.nothing_reached().unwrap();
    let mut chunks = vec![];
    sweep.run_chunks(0..300, 64, &mut reached, &mut |chunk| chunks.push(chunk));
    let mut outcomes: Vec<sweep::Outcomes> =
        chunks.into_iter().flat_map(|chunk| chunk.outcomes).collect();
    let mut list = vec![];
    for outcomes in &mut outcomes {
        list = reached.renumber(outcomes).equilibria;
    }
    let of = |solver: &str| -> Vec<i16> {
        let own = outcomes.iter().filter(|outcomes| outcomes.solver == solver);
        own.flat_map(|outcomes| outcomes.outcome.iter().copied()).collect()
    };
    let starts = sweep.angles_rad(0..300);
    let settings = lagrange::batch::BatchSettings::default();
    let lagrange = lagrange::batch::Batch::new(&problem, settings).unwrap();
    let settings = energy::batch::BatchSettings::default();
    let energy = energy::batch::Batch::new(&problem, settings).unwrap();
    let mut ends = [model::Ends::default(), model::Ends::default()];
    lagrange.solve(&starts, &mut ends[0]);
    energy.minimise(&starts, &mut ends[1]);
    let mut distinct = std::collections::BTreeSet::new();
    for (ends, outcomes) in ends.iter().zip([of("lagrange"), of("energy")]) {
        for ((finish, u), outcome) in
            ends.finish.iter().zip(ends.directions.chunks(18)).zip(outcomes)
        {
            assert_eq!(*finish == model::Finish::Converged, outcome >= 0, "{finish:?} {outcome}");
            let Ok(entry) = usize::try_from(outcome) else { continue };
            distinct.insert(entry);
            let (mut off, mut largest) = ([0.0; 2], 0.0_f64);
            let bars = problem.chain().bars().iter().zip(u).zip(&list[entry].angles_rad);
            for ((bar, u), angle) in bars {
                let (sin, cos) = angle.unwrap().sin_cos();
                off[0] += bar.length_m() * (u[0] - sin);
                off[1] += bar.length_m() * (u[1] + cos);
                largest = largest.max(off[0].hypot(off[1]));
            }
            // From the first seed that reached it, and from that of another chunk.
            let radius = 2.0 * sweep::JOINT_TOLERANCE * problem.chain().total_length_m();
            assert!(largest <= radius, "{largest:e}");
        }
    }
    // Every entry is somebody's.
    assert_eq!(distinct.len(), list.len());
    assert!(list.len() > 20, "{}", list.len());
}

#[test]
fn one_solver_alone_and_settings_out_of_range() {
    let problem = model::cases::paper();
    let only = |names: &[&str]| {
        let solvers = funicular::starts::solvers(&problem).unwrap().only(names);
        Sweep::new(&problem, Settings::default(), solvers).map(|sweep| sweep.run_chunk(3..40))
    };
    let (one, both) = (only(&["lagrange"]).unwrap(), only(&["energy", "lagrange"]).unwrap());
    assert!(one.of("energy").is_none() && one.outcomes.len() == 1);
    assert_eq!(one.outcomes[0], both.outcomes[0]);
    assert_eq!(only(&["neither"]).unwrap_err(), sweep::SweepError::NoSolver);
    let refused = Settings { chunk: 0, ..Settings::default() };
    assert!(sweep_of(&model::cases::paper(), refused).is_err());
    let axes = Source::Grid(vec![Axis::full(3)]);
    let refused = Settings { source: axes, ..Settings::default() };
    assert!(sweep_of(&model::cases::paper(), refused).is_err());
}

/// A sweep of both solvers and what becomes of its seeds.
fn rates(text: &str, seeds: u64) -> (Sweep, Summary) {
    let sweep = sweep_of(&samples::parsed(text), Settings::default()).unwrap();
    let summary = sweep.run(0..seeds, 2).unwrap();
    (sweep, summary)
}

/// Massless bars that just bridge their gap carry a billionth of the weight: where the slope is
/// zero to the tolerance they are 6e-5 m from the minimum, and a seed that stops there is in no
/// list.
#[test]
fn minima_of_bars_that_carry_nearly_nothing_are_reached() {
    let text = "anchors = { start_m = [0, 0, 0], end_m = [2.00000001, 0, 0] }\n\
        bars = [{ length_m = 1, mass_kg = 1 }, { length_m = 1, mass_kg = 0, count = 2 },\n\
        { length_m = 1, mass_kg = 1 }]";
    let (sweep, summary) = rates(text, 500);
    assert!(sweep.members().complete());
    let rows = &summary.tally().of("energy").unwrap().0;
    let listed: u64 = rows.iter().filter(|(code, _)| **code >= 0).map(|(_, row)| row.count).sum();
    assert!(listed >= 475, "{listed} of 500: {:?}", rows.keys());
}

/// Bars of 1, 5 and 1 m that just bridge: one minimum, which is degenerate, and every seed of the
/// minimiser is in the same one.
#[test]
fn a_degenerate_minimum_is_one_for_all_seeds() {
    let text = "anchors = { start_m = [0, 0, 0], end_m = [6, 0, -1] }\n\
        bars = [{ length_m = 1, mass_kg = 3, centre_m = 1 }, { length_m = 5, mass_kg = 2, centre_m = 0 },\n\
        { length_m = 1, mass_kg = 0, centre_m = 0.25 }]";
    let (_, summary) = rates(text, 500);
    let rows = &summary.tally().of("energy").unwrap().0;
    let counts: Vec<_> = rows.iter().map(|(code, row)| (*code, row.count)).collect();
    // The census leaves it undecided.
    assert_eq!(counts, [(0, 500)]);
}

/// From wherever it starts, what a solver calls an equilibrium is one: in balance by a judge that
/// shares no formula with either, and of `energy` a minimum.
#[test]
fn what_solvers_reach_from_anywhere_is_in_balance() {
    use validate::systems::judge;
    /// Starts of each system, fewer of large ones.
    const STARTS: u64 = 40;
    /// The budget of the project. (Of 14,726 answers from 600 starts each all were within it.)
    const BALANCE: f64 = 1e-11;
    let mut reached = [0; 2];
    for exhibit in model::cases::exhibits() {
        let system = exhibit.system();
        let members = system.members().len() as u64;
        for start in 0..STARTS.min(2_000 / members) {
            let places = motion::random_places(&system, start);
            let seed = lagrange::net::Seed::at(places.clone());
            let settings = lagrange::net::Settings::default();
            let lagrange = lagrange::net::solve_from(&system, &seed, &settings);
            let settings = energy::net::Settings::default();
            let energy = energy::net::minimise_from(&system, &places, &settings);
            let energy = energy.map(|found| found.equilibrium).ok();
            let lagrange = lagrange.map(|found| found.equilibrium).ok();
            if let Some(found) = &energy {
                let (name, stability) = (exhibit.name, found.stability);
                assert_eq!(stability.index_in_space, 0, "{name} from {start}: {stability:?}");
            }
            for (k, found) in [lagrange, energy].into_iter().enumerate() {
                let Some(found) = found else { continue };
                reached[k] += 1;
                let statics = judge(&system, &found);
                assert!(
                    statics.passes(BALANCE),
                    "{} from {start} by {}: {statics:?}",
                    exhibit.name,
                    found.solver
                );
            }
        }
    }
    println!("reached by lagrange, energy: {reached:?}");
    assert!(reached.iter().all(|count| *count > 100), "{reached:?}");
}
