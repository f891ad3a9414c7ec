//! The interactive view: the paper's chain in space, and its energy along the closure curve.
//!
//! [`View::new`] collects the numbers from a [`Reproduction`] and from [`energy::example`], and
//! [`View::fragment`] puts them into a piece of HTML that brings its own style and script, asks no
//! network and says the same in a table where scripts are off. The drawing is in `view/view.js`.
//!
//! What can be seen: the chain turned about *OD*, with the weights and the forces of the ground;
//! its shape, `V` and the slope of `V` while theta goes along the closed chains. E1, E2 and their
//! mirror images, (ix) and (x) are samples of that curve themselves, so that one comes to rest on
//! them exactly.

use std::fmt::Write as _;

use energy::example::{Branch, alpha, curve, slope};
use paper::reproduction::{Position, Reproduction};
use serde::Serialize;

/// Samples of each branch of the closure curve: theta moves by a third of a degree at most.
const SAMPLES: usize = 361;

/// Every how many points of the paper's scan a mark is drawn: 1318 would run into one another.
const EVERY: usize = 40;

/// Decimals of the numbers given to the script, more than it shows.
const DECIMALS: i32 = 9;

const HTML: &str = include_str!("view/view.html");
const STYLE: &str = include_str!("view/view.css");
const SCRIPT: &str = include_str!("view/view.js");

/// What a named place on the curve is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A minimum of V.
    Minimum,
    /// A maximum of V.
    Maximum,
    /// A point of the scan next to an equilibrium: (ix).
    Step,
    /// A point of the scan far from every equilibrium: (x).
    False,
}

/// A named place on the curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct State {
    /// E1, E1', E2, E2', (ix), (x).
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
    /// The same in words.
    pub says: String,
    /// Number of its sample in [`View::curve`].
    pub at: usize,
    /// Forces of the ground at *O* and *D*, mg: horizontal and up. Nothing rests on (ix) and (x).
    pub ground_mg: Option<[[f64; 2]; 2]>,
    /// Axial forces of *OA*, *AB*, *BD*, mg, tension positive.
    pub axial_mg: Option<[f64; 3]>,
}

/// A closed chain: theta, alpha, beta in degrees, V in mgl, and dV/dtheta in mgl/rad, which is
/// `None` where the curve turns back in theta.
pub type Sample = (f64, f64, f64, f64, Option<f64>);

/// The numbers of the interactive view.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct View {
    /// The named places.
    pub states: Vec<State>,
    /// The closure curve once around.
    pub curve: Vec<Sample>,
    /// Points of the paper's scan: theta in degrees, V in mgl.
    pub scan: Vec<[f64; 2]>,
    /// Where the curve ends, deg.
    pub largest_theta_deg: f64,
}

/// A named place before it has its number on the curve.
struct Place {
    state: State,
    branch: Branch,
    sample: Sample,
}

impl View {
    /// Collect what there is to see.
    pub fn new(reproduction: &Reproduction) -> Self {
        let figures = &reproduction.figures;
        let [ix, x] = figures.scan_results;
        let equilibria = &reproduction.equilibria;
        let mut places: Vec<Place> = equilibria.iter().map(Place::equilibrium).collect();
        let away = equilibria.iter().map(|e| (e.lagrange_deg[0] - ix[0]).abs());
        let away = away.fold(f64::INFINITY, f64::min);
        places.push(Place::scanned(
            "(ix)",
            Kind::Step,
            format!(
                "the point of the paper\u{2019}s scan nearest to E1, {away:.4}\u{b0} beside it"
            ),
            ix,
        ));
        places.push(Place::scanned(
            "(x)",
            Kind::False,
            "the paper\u{2019}s second equilibrium, which is no equilibrium: the first point of its scan, on a slope \
             that goes down to E1\u{2032}"
                .to_owned(),
            x,
        ));

        // The first branch runs down in theta, the second one up.
        let mut along: Vec<(Branch, Sample, Option<usize>)> = curve(SAMPLES)
            .iter()
            .map(|p| {
                let angles = [p.theta_rad, p.alpha_rad, p.beta_rad].map(f64::to_degrees);
                (p.branch, sample(angles, p.energy_mgl, p.branch), None)
            })
            .collect();
        along.extend(places.iter().enumerate().map(|(k, p)| (p.branch, p.sample, Some(k))));
        along.sort_by(|(b, s, _), (c, t, _)| match (b, c) {
            (Branch::FirstQuadrant, Branch::FirstQuadrant) => t.0.total_cmp(&s.0),
            (Branch::FourthQuadrant, Branch::FourthQuadrant) => s.0.total_cmp(&t.0),
            (Branch::FirstQuadrant, Branch::FourthQuadrant) => std::cmp::Ordering::Less,
            (Branch::FourthQuadrant, Branch::FirstQuadrant) => std::cmp::Ordering::Greater,
        });
        for (at, (_, _, place)) in along.iter().enumerate() {
            if let Some(place) = place {
                places[*place].state.at = at;
            }
        }
        let scanned = figures.scan_points.iter().flat_map(|points| points.iter().step_by(EVERY));
        Self {
            states: places.into_iter().map(|place| place.state).collect(),
            curve: along.into_iter().map(|(_, sample, _)| sample).collect(),
            scan: scanned.map(|p| p.map(rounded)).collect(),
            largest_theta_deg: energy::example::LARGEST_THETA_COSINE.acos().to_degrees(),
        }
    }

    /// The view as a piece of HTML: a `figure` without headings, at most once in a page.
    ///
    /// # Errors
    /// Occurs when the numbers cannot be written as JSON.
    pub fn fragment(&self) -> serde_json::Result<String> {
        // `<` only ever stands inside a string, where JSON lets it be written like this; then
        // nothing can end the script element early.
        let data = serde_json::to_string(self)?.replace('<', "\\u003c");
        let html = HTML
            .replace("@every@", &EVERY.to_string())
            .replace("@rows@", &self.rows())
            .replace("@data@", &data)
            .replace("@script@", SCRIPT);
        Ok(format!("<style>\n{STYLE}</style>\n{html}"))
    }

    /// The named places as rows of a table.
    fn rows(&self) -> String {
        let mut rows = String::new();
        for state in &self.states {
            let (theta, alpha, beta, v, slope) = self.curve[state.at];
            let slope =
                slope.map_or_else(|| "none".to_owned(), |s| signless_zero(&format!("{s:+.4}")));
            // Writing to a String cannot fail.
            let _ = writeln!(
                rows,
                "<tr><th scope=\"row\">{}</th><td>{theta:.5}</td><td>{alpha:.5}</td><td>{beta:.5}</td>\
                 <td>{v:.5}</td><td>{slope}</td></tr>",
                state.name
            );
        }
        rows
    }
}

impl Place {
    fn equilibrium(found: &Position) -> Self {
        let branch = branch_of(found.lagrange_deg);
        let minimum = found.stability.index_in_plane == 0;
        let [o, _, _, d] = found.forces_mg;
        let axial = found.axial_mg;
        let compressed = axial.iter().filter(|&&n| n < 0.0).count();
        let bars = match compressed {
            0 => "every bar is in tension".to_owned(),
            3 => "every bar is in compression".to_owned(),
            _ => format!("{compressed} of 3 bars in compression"),
        };
        let says = format!(
            "an equilibrium, {} of V; the ground bears {:.4} mg at O and {:.4} mg at D, {bars}",
            if minimum { "a minimum" } else { "a maximum" },
            o[0].hypot(o[1]),
            d[0].hypot(d[1]),
        );
        Self {
            state: State {
                name: found.name,
                kind: if minimum { Kind::Minimum } else { Kind::Maximum },
                says,
                at: 0,
                ground_mg: Some([o.map(rounded), d.map(rounded)]),
                axial_mg: Some(axial.map(rounded)),
            },
            branch,
            sample: sample(found.lagrange_deg, found.lagrange_mgl, branch),
        }
    }

    fn scanned(name: &'static str, kind: Kind, says: String, [t, a, b, v]: [f64; 4]) -> Self {
        let signed = [t, a, b].map(|deg| (deg + 180.0).rem_euclid(360.0) - 180.0);
        let branch = branch_of(signed);
        Self {
            state: State { name, kind, says, at: 0, ground_mg: None, axial_mg: None },
            branch,
            sample: sample(signed, v, branch),
        }
    }
}

/// The branch whose alpha at this theta is nearer.
fn branch_of([theta, found, _]: [f64; 3]) -> Branch {
    let away = |branch| {
        alpha(theta.to_radians(), branch)
            .map_or(f64::INFINITY, |alpha| (alpha - found.to_radians()).abs())
    };
    let [first, fourth] = Branch::BOTH;
    if away(first) <= away(fourth) { first } else { fourth }
}

fn sample([theta, alpha, beta]: [f64; 3], v: f64, branch: Branch) -> Sample {
    let slope = slope(theta.to_radians(), branch);
    (
        rounded(theta),
        rounded(alpha),
        rounded(beta),
        rounded(v),
        slope.is_finite().then(|| rounded(slope)),
    )
}

fn rounded(x: f64) -> f64 {
    let scale = 10_f64.powi(DECIMALS);
    (x * scale).round() / scale
}

/// `+0.0000` and `-0.0000` as `0.0000`.
fn signless_zero(text: &str) -> String {
    let digits = text.trim_start_matches(['+', '-']);
    let zero = digits.bytes().all(|b| b == b'0' || b == b'.');
    if zero { digits.to_owned() } else { text.replace('-', "\u{2212}") }
}
