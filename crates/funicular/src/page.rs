//! A system to look at: its equilibria, load cases, modes and load paths as one HTML file.

use std::sync::Arc;

use model::system::{System, SystemEquilibrium};

use crate::equilibria::{self, system_of};
use crate::error::Error;
use crate::modes::{Modes, ModesAnswer};
use crate::moving_page::{plain, six};
use crate::problem::Problem;
use crate::shown::{Shape, Shown, plain_lines};
use crate::solve::{Solve, SolveAnswer};
use crate::text;
use crate::trace::{Trace, TraceAnswer};

/// Modes of each equilibrium.
const MODES: usize = 12;

/// A page for a system: its equilibria (all of them where a census is complete), its load cases, the lowest
/// modes and, over a parameter, load paths, with forces, utilisation and how far each is proved.
///
/// ```
/// use funicular::{Page, prelude::*};
/// let page = Page::new().vary("loads=0.5..1.2")?.run(&Problem::case("lamp")?)?;
/// assert!(page.html().starts_with("<!DOCTYPE html>") && page.html().contains("Load paths"));
/// assert!(page.answer().agrees());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Page {
    trace: Option<Trace>,
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
        let ground = held.map(|(joint, force_n)| (plain(&joint.name), force_n.map(six).to_vec()));
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
    /// Without a parameter.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// With load paths over a range of a number of the file, `loads=0..1.2`; of several all but the last have one value.
    ///
    /// # Errors
    ///
    /// [`Error::Parameter`] with the place in the text.
    pub fn vary(self, text: &str) -> Result<Self, Error> {
        Ok(Self { trace: Some(self.trace.unwrap_or_default().vary(text)?) })
    }

    /// Solve the problem and make its page.
    ///
    /// # Errors
    ///
    /// As [`Solve::run`], and [`Trace::run`] with a parameter; [`Error::PageRange`] for one that is no range alone.
    /// A system without modes, and a load case without an answer, are left out.
    pub fn run(&self, problem: &Problem) -> Result<PageAnswer, Error> {
        let (answer, shown, contents) = self.shown(problem)?;
        let html = shown.html(&system_of(problem), &text::answer(&answer, false, false));
        Ok(PageAnswer { answer, html, contents })
    }

    /// What the page is made of, and what that is in words.
    pub(crate) fn shown(&self, problem: &Problem) -> Result<(SolveAnswer, Shown, String), Error> {
        let system = system_of(problem);
        let traced = self.traced(problem)?;
        let answer = Solve::new().run(problem)?;
        let modes = Modes::new().lowest(MODES).run(problem).ok();
        let (mut shapes, count) = equilibria(problem, &system, &answer, modes.as_ref())?;
        let listed = shapes.len();
        for case in problem.load_cases() {
            let found = problem.in_case(case).and_then(|changed| Solve::new().run_here(&changed));
            let Some((system, first)) = found.ok().and_then(first) else { continue };
            shapes.push(Shape::of(&system, "Load cases", case, &first));
        }
        let cases = shapes.len() - listed;
        let mut shown = Shown { shapes, ..Shown::default() };
        if let Some(paths) = traced.as_ref().and_then(|found| found.load_paths()) {
            shown = shown.with_paths(paths);
        }
        let modes = if modes.is_some() { " with modes" } else { "" };
        let mut contents = plural(count, "equilibrium", "equilibria") + modes;
        for (count, one, several) in
            [(cases, "load case", "load cases"), (shown.paths.len(), "load path", "load paths")]
        {
            if count > 0 {
                contents = contents + ", " + &plural(count, one, several);
            }
        }
        Ok((answer, shown, contents))
    }

    fn traced(&self, problem: &Problem) -> Result<Option<TraceAnswer>, Error> {
        let Some(trace) = &self.trace else { return Ok(None) };
        if !trace.is_load_path(problem) {
            return Err(Error::PageRange);
        }
        trace.run(problem).map(Some)
    }
}

fn plural(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// The first equilibrium with its system.
fn first(answer: SolveAnswer) -> Option<(Arc<System>, SystemEquilibrium)> {
    let (system, found) = answer.into_parts();
    found.into_iter().next().map(|first| (system, first))
}

/// The answer, and all equilibria where a census knows them, with their modes; and how many there are.
fn equilibria(
    problem: &Problem,
    system: &System,
    answer: &SolveAnswer,
    modes: Option<&ModesAnswer>,
) -> Result<(Vec<Shape>, usize), Error> {
    const GROUP: &str = "Equilibria";
    let own = match answer.agreement() {
        Some(_) => "the answer of both solvers".to_owned(),
        None => format!(
            "the answer of {} alone",
            answer.equilibria().first().map_or("", |one| one.solver.as_str())
        ),
    };
    let found = equilibria::all(problem, census::Settings::UNASKED_BARS)?;
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
    if found.complete && found.list.len() > 1 {
        let first = answer.equilibria().first();
        let own = first.map(|first| Shape::of(system, GROUP, &own, first));
        return Ok((own.into_iter().chain(listed).collect(), found.list.len()));
    }
    let first = answer
        .equilibria()
        .first()
        .map(|first| with_modes(Shape::of(system, GROUP, &own, first), "1"));
    Ok((first.into_iter().collect(), 1))
}

impl PageAnswer {
    /// The answer that the page shows first.
    #[must_use]
    pub fn answer(&self) -> &SolveAnswer {
        &self.answer
    }

    /// The page, which needs nothing else.
    #[must_use]
    pub fn html(&self) -> &str {
        &self.html
    }

    /// What is on it, in words.
    #[must_use]
    pub fn contents(&self) -> &str {
        &self.contents
    }
}
