//! The registry of named cases: every solver runs over every case.
//!
//! The system files stand in `validation/cases/`, each with a comment that says what it exercises.

use crate::Problem;
use crate::system::System;
use crate::system_file::{Described, parse};

/// A named case: a chain, or a system of joints and members.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Case {
    /// Its name, the stem of its file.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// Its system file.
    pub text: &'static str,
}

impl Case {
    /// The problem of a chain.
    ///
    /// # Panics
    /// Where the case is not a chain, and nowhere else: a test reads all of them.
    pub fn problem(&self) -> Problem {
        match parse(self.text, self.name) {
            Ok(Described::Chain(problem)) => problem,
            Ok(Described::System(_)) => panic!("{} of the registry is not a chain", self.name),
            Err(error) => panic!("case of the registry: {error}"),
        }
    }

    /// The system of joints and members.
    ///
    /// # Panics
    /// Where the case is a chain, and nowhere else: a test reads all of them.
    pub fn system(&self) -> System {
        match parse(self.text, self.name) {
            Ok(Described::System(system)) => system,
            Ok(Described::Chain(_)) => panic!("{} of the gallery is a chain", self.name),
            Err(error) => panic!("system of the gallery: {error}"),
        }
    }
}

macro_rules! registry {
    ($($name:literal: $about:literal,)*) => {
        &[$(Case {
            name: $name,
            about: $about,
            text: include_str!(concat!("../data/cases/", $name, ".toml")),
        },)*]
    };
}

const REGISTRY: &[Case] = registry! {
    "three-equal-bars": "the example of the paper",
    "three-equal-bars-on-the-moon": "the same in other units",
    "three-equal-bars-oblique": "its bars between anchors not on one vertical",
    "two-bars": "a triangle: closed form",
    "three-bars-off-centre": "different bars, weights off centre",
    "propped": "one bar in compression props the chain up",
    "five-in-space": "anchors in general position",
    "ten-equal-bars": "the chain of the benches, small",
    "level-odd": "the middle bar hangs level",
    "thirty-bars": "lengths, masses and centres at random",
    "hundred-bars": "little sag",
    "slack": "both anchors in one place",
    "nearly-taut": "span 0.999999 of the length",
    "massless-links": "weights on strings",
    "six-orders": "lengths and masses over six orders of magnitude",
    "nanometres": "lengths of 1e-9 m",
    "gigametres": "lengths of 1e9 m",
    "far-from-the-origin": "anchors 1e6 m from the origin",
};

const GALLERY: &[Case] = registry! {
    "lamp": "a lamp on two cables: the triangle 3, 4, 5",
    "bridle": "three heavy strands hold a load",
    "mobile": "a tree of beams that hang level by the lever rule",
    "footbridge": "cables, hangers and a deck: the parabola of a suspension bridge",
    "net": "a net of heavy bars, hung by its corners",
    "ring": "a closed ring, held by three cables",
    "tripod": "three legs and a load: a rigid truss",
    "pendulum-chain": "five bars in a side wind",
    "four-bar-linkage": "two cranks and a coupler with a load",
};

const TENSEGRITIES: &[Case] = registry! {
    "x-cross": "four cables around two crossed struts",
    "prism": "three struts, nine cables: the simplex, twisted by 150°",
    "expandable-octahedron": "six struts, twenty-four cables",
    "simplex-tower": "two prisms, one on the other",
};

const DRAWN: &[Case] = registry! {
    "warren-truss": "a planar truss as it is drawn: the method of joints",
    "pratt-truss": "a planar truss with both diagonals, of rigid bars",
    "lattice-tower": "an X-braced tower of elastic bars in the wind",
    "star-dome": "the shallow dome of Levy and Spillers under 0.3 of their load",
    "geiger-dome": "a prestressed cable dome",
};

const ROPES: &[Case] = registry! {
    "ring-on-a-rope": "a lantern by a ring on one rope: both spans lean alike",
    "tackle": "one elastic rope over a block and two pulleys: a third each",
};

/// Ropes that run over rings and pulleys.
pub fn ropes() -> &'static [Case] {
    ROPES
}

/// Structures that stand where they are drawn: trusses, a tower, domes.
pub fn drawn() -> &'static [Case] {
    DRAWN
}

/// Every system of joints and members with a name: [`systems`], [`drawn`] and [`ropes`].
pub fn exhibits() -> impl Iterator<Item = &'static Case> {
    systems().chain(DRAWN).chain(ROPES)
}

/// Tensegrities that no load holds up: cables of a given prestress around rigid struts, each with
/// the stress that is known of it in a closed form.
pub fn tensegrities() -> &'static [Case] {
    TENSEGRITIES
}

/// The gallery: systems of joints and members, each with what is known of it in a closed form.
pub fn gallery() -> &'static [Case] {
    GALLERY
}

/// All systems that hang or hold themselves: the gallery and the tensegrities.
pub fn systems() -> impl Iterator<Item = &'static Case> {
    GALLERY.iter().chain(TENSEGRITIES)
}

/// The system of this name.
///
/// ```
/// // A rigid truss of three legs.
/// let tripod = model::cases::exhibit("tripod").unwrap().system();
/// assert_eq!((tripod.joints().len(), tripod.members().len()), (4, 3));
/// ```
pub fn exhibit(name: &str) -> Option<&'static Case> {
    exhibits().find(|exhibit| exhibit.name == name)
}

/// All cases: chains.
///
/// ```
/// // Every case is a problem with an answer.
/// for case in model::cases::all() {
///     assert!(case.problem().chain().bars().len() >= 2, "{}", case.name);
/// }
/// ```
pub fn all() -> &'static [Case] {
    REGISTRY
}

/// The names of all cases and systems of the gallery, chains first, with what they are.
pub fn named() -> impl Iterator<Item = (&'static str, &'static str)> {
    let chains = all().iter().map(|case| (case.name, case.about));
    chains.chain(exhibits().map(|exhibit| (exhibit.name, exhibit.about)))
}

/// The case of this name.
///
/// ```
/// let case = model::cases::get("two-bars").unwrap();
/// assert_eq!(case.problem().chain().bars().len(), 2);
/// assert!(model::cases::get("two bars").is_none());
/// ```
pub fn get(name: &str) -> Option<&'static Case> {
    REGISTRY.iter().find(|case| case.name == name)
}

/// The paper's example (section VIII): three homogeneous bars of length 1 m and mass 1 kg, the
/// anchors 2 m apart on one vertical.
///
/// ```
/// let problem = model::cases::paper();
/// assert_eq!(problem.chain().anchors().difference_m(), [0.0, 0.0, -2.0]);
/// ```
pub fn paper() -> Problem {
    REGISTRY[0].problem()
}
