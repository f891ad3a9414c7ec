//! A system to look at: its equilibria, load cases, modes, motion and load paths as one HTML file.

use std::ops::ControlFlow;
use std::sync::Arc;

use model::system::{System, SystemEquilibrium};

use crate::animation::Animation;
use crate::equilibria::{self, Equilibria};
use crate::error::Error;
use crate::modes::{Modes, ModesAnswer};
use crate::moving_page::{plain, plain_lines, six};
#[cfg(feature = "branches")]
use crate::parameters::Parameters;
use crate::problem::Problem;
use crate::shown::{Shape, Shown};
use crate::simulate::Simulate;
use crate::solve::{Solve, SolveAnswer};
use crate::text::census::plural;
use crate::text::{self, tables::counted};
use crate::track::Track;

/// Modes of each equilibrium, if nothing else is asked for.
const MODES: usize = 12;

/// What tracks are called in words.
const TRACKS: [[&str; 3]; 3] = [
    ["Motion", "motion", "motions"],
    ["Load paths", "load path", "load paths"],
    ["Study", "study", "studies"],
];

/// A page for a system: its equilibria (all of them where a census is complete), its load cases, the lowest
/// modes, a motion and, over a parameter, load paths or the shapes of a study, with forces, utilisation and
/// how far each is proved.
///
/// ```
/// use funicular::{Page, prelude::*};
/// let released = Simulate::new().start(Start::Seed(1)).time_s(0.5).damping_1_s(2.0);
/// let page = Page::new().simulate(released).run(&Problem::case("lamp")?)?;
/// assert!(page.html().starts_with("<!DOCTYPE html>"));
/// assert!(page.contents().ends_with(", 1 motion") && page.answer().agrees());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Page {
    #[cfg(feature = "branches")]
    vary: Option<Parameters>,
    simulate: Option<Simulate>,
    modes: Option<Modes>,
}

/// A page, and the answer of both solvers that it shows first.
#[derive(Debug, Clone, PartialEq)]
pub struct PageAnswer {
    answer: SolveAnswer,
    html: String,
    contents: String,
}

impl Shape {
    /// An equilibrium with its forces and what is known of it.
    pub fn of(
        system: &System,
        group: &'static str,
        label: &str,
        found: &SystemEquilibrium,
    ) -> Self {
        let statements = found.evidence.ladder.statements();
        let rungs = statements.into_iter().map(|s| (s.reached, s.rung.to_string(), plain(&s.how)));
        let held = system.joints().iter().zip(&found.reactions_n);
        let held = held.filter(|(joint, _)| joint.support.at_m().is_some());
        let ground =
            held.map(|(joint, force_n)| (plain(&joint.name.text()), force_n.map(six).to_vec()));
        Self {
            axial: Some(found.axial_n.iter().copied().map(six).collect()),
            used: found.utilisations(system),
            facts: Some(plain_lines(&text::facts(system, found))),
            ground: ground.collect(),
            rungs: rungs.collect(),
            ..Self::bare(system, group, label, found.joints_m.iter().copied())
        }
    }
}

impl Page {
    /// Of what is at rest.
    pub fn new() -> Self {
        Self::default()
    }

    /// With shapes over numbers of the file, `loads=0..1.2`; each combination of all but the last is a row of
    /// them. They are load paths, as a [`Trace`](crate::Trace) follows them over a range alone or in a
    /// system; where none can be followed, and over values of a chain, they are the shapes of a
    /// [`Study`](crate::Study), at 41 values of a range. The page says which of the two.
    ///
    /// ```
    /// use funicular::{Page, prelude::*};
    /// let lamp = Problem::case("lamp")?;
    /// let shown = |vary: &str| Page::new().vary(vary)?.run(&lamp);
    /// assert!(shown("loads=0.5..1.2")?.contents().ends_with(", 1 load path"));
    /// // No path leads from one number of bars to another.
    /// let chain = Problem::case("three-equal-bars")?;
    /// let over = Page::new().vary("bars.1.count=3..5")?.run(&chain)?;
    /// assert!(over.contents().ends_with(", 1 study"));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Parameter`] with the place in the text.
    #[cfg(feature = "branches")]
    pub fn vary(self, text: &str) -> Result<Self, Error> {
        Ok(Self { vary: Some(self.vary.unwrap_or_default().vary(text)?), ..self })
    }

    setters! {
        /// With a motion.
        simulate: Simulate => Some(simulate),
        /// With these modes, moving from the start, of these equilibria.
        modes: Modes => Some(modes),
    }

    /// Solve the problem and make its page.
    ///
    /// # Errors
    /// As [`Solve::run`], [`Simulate::run`] with a motion and [`Study::run`](crate::Study::run) with a
    /// parameter; [`Error::NoShapes`] where nothing hangs at any of its values. A system without
    /// modes, and a load case without an answer, are left out.
    pub fn run(&self, problem: &Problem) -> Result<PageAnswer, Error> {
        let found = equilibria::all(problem, self.asked_modes().most_bars())?;
        let mut tracks: Vec<Track> = self.moved(problem, &found)?.into_iter().collect();
        tracks.extend(self.varied(problem)?);
        let (answer, shown, mut contents) = self.at_rest(problem, &found)?;
        for [group, one, several] in TRACKS {
            let count = tracks.iter().filter(|track| track.group == group).count();
            if count > 0 {
                contents = format!("{contents}, {count} {}", plural(count, one, several));
            }
        }
        let html = Shown { play: self.modes.is_some(), tracks, ..shown }.html(&problem.system());
        Ok(PageAnswer { answer, html, contents })
    }

    /// What stands still.
    #[cfg(feature = "live")]
    pub(crate) fn of(&self, problem: &Problem) -> Result<Shown, Error> {
        let found = equilibria::all(problem, self.asked_modes().most_bars())?;
        self.at_rest(problem, &found).map(|(_, shown, _)| shown)
    }

    /// What stands still, and that in words.
    pub(crate) fn at_rest(
        &self,
        problem: &Problem,
        found: &Equilibria,
    ) -> Result<(SolveAnswer, Shown, String), Error> {
        let system = problem.system();
        let answer = Solve::new().run(problem)?;
        let modes = self.asked_modes().of(problem, found).ok();
        let (mut shapes, count) = equilibria(&system, &answer, found, modes.as_ref());
        let listed = shapes.len();
        for case in problem.load_cases() {
            let found = problem.in_case(case).and_then(|changed| Solve::new().run_here(&changed));
            let Some((system, first)) = found.ok().and_then(first) else { continue };
            shapes.push(Shape::of(&system, "Load cases", case, &first));
        }
        let cases = shapes.len() - listed;
        let modes = if modes.is_some() { " with modes" } else { "" };
        let mut contents =
            format!("{count} {}", plural(count, "equilibrium", "equilibria")) + modes;
        if cases > 0 {
            contents = contents + ", " + &counted(cases, "load case");
        }
        let words = text::answer(&answer, false, false);
        Ok((answer, Shown { words, shapes, ..Shown::default() }, contents))
    }

    fn asked_modes(&self) -> Modes {
        self.modes.unwrap_or_else(|| Modes::new().lowest(MODES))
    }

    fn moved(&self, problem: &Problem, found: &Equilibria) -> Result<Option<Track>, Error> {
        let Some(simulate) = &self.simulate else { return Ok(None) };
        let mut animation = Animation::new(&problem.system()).near(found);
        simulate.run_watched(problem, &mut |at| {
            animation.add(at);
            ControlFlow::Continue(())
        })?;
        Ok(Some(animation.track()))
    }

    #[cfg(feature = "branches")]
    fn varied(&self, problem: &Problem) -> Result<Vec<Track>, Error> {
        self.vary.as_ref().map_or(Ok(vec![]), |vary| crate::varied::tracks(problem, vary))
    }

    #[cfg(not(feature = "branches"))]
    #[expect(clippy::unused_self, clippy::unnecessary_wraps, reason = "nothing varies")]
    fn varied(&self, _: &Problem) -> Result<Vec<Track>, Error> {
        Ok(vec![])
    }
}

/// The first equilibrium with its system.
fn first(answer: SolveAnswer) -> Option<(Arc<System>, SystemEquilibrium)> {
    let (system, found) = answer.into_parts();
    found.into_iter().next().map(|first| (system, first))
}

/// The answer, and all equilibria where a census knows them, with their modes; and how many there are.
fn equilibria(
    system: &System,
    answer: &SolveAnswer,
    found: &Equilibria,
    modes: Option<&ModesAnswer>,
) -> (Vec<Shape>, usize) {
    const GROUP: &str = "Equilibria";
    let own = match answer.agreement() {
        Some(_) => "the answer of both solvers".to_owned(),
        None => format!(
            "the answer of {} alone",
            answer.equilibria().first().map_or("", |one| one.solver.as_str())
        ),
    };
    let with_modes = |shape: Shape, label: &str| {
        let known = modes.and_then(|all| all.equilibria.iter().find(|one| one.label == label));
        match known {
            Some(one) => shape.with_modes(&one.modes),
            None => shape,
        }
    };
    let listed = found.list.iter().map(|located| {
        let down = match located.found.stability.index_in_space {
            0 => "stable".to_owned(),
            index => format!("unstable, {index}"),
        };
        let label = format!("{}: {down}", located.label);
        with_modes(Shape::of(system, GROUP, &label, &located.found), &located.label)
    });
    let first = answer.equilibria().first().map(|first| Shape::of(system, GROUP, &own, first));
    if found.complete && found.list.len() > 1 {
        return (first.into_iter().chain(listed).collect(), found.list.len());
    }
    (first.map(|first| with_modes(first, "1")).into_iter().collect(), 1)
}

impl PageAnswer {
    /// The answer that the page shows first.
    pub fn answer(&self) -> &SolveAnswer {
        &self.answer
    }

    /// The page, which needs nothing else.
    pub fn html(&self) -> &str {
        &self.html
    }

    /// What is on it, in words.
    pub fn contents(&self) -> &str {
        &self.contents
    }
}
