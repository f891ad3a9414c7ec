//! Drawings of lines as systems: each straight line is a member, and ends in one place are a joint.
//!
//! A drawing says where things are and, by the name of a layer or group, what they are. Its members have the lengths
//! as drawn and one mass a metre, so that forces are in units of that weight.

mod nearest;

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use model::budget::{BYTES_PER_MEMBER, Budget};
use model::system::{Joint, Kind, Member, Support, System};
use model::{Bar, STANDARD_GRAVITY_M_S2, Vector};
use numerics::vector::{minus, norm};

use crate::error::{At, Result, shortened};
use crate::system::ForeignSystem;

/// Ends that are no further apart are one joint, in units of the diagonal of the drawing: what programs round off
/// that write six digits.
const ONE_PLACE: f64 = 1e-6;
/// Mass of a metre of each member, kg/m.
const MASS_KG_M: f64 = 1.0;
/// What the name of a layer or group has in it where its points mark anchors: the second is that of our own drawings.
const ANCHORS: [&str; 2] = ["anchor", "support"];
/// What to do about a rope.
const ROPES: &str = "a drawing does not say over what a rope runs: write it into a system file (`via`), or draw it as \
                     \"cables\" that end at their joints";
/// Kinds of other things that a note names.
const MOST_SKIPPED: usize = 30;
/// What stands there before the axes along which a support slides, and where it slides across them.
const FREE: &str = "free_";
const SLIDING: &str = "sliding";

/// What was found in a drawing.
pub(super) struct Drawing<'a> {
    file: &'a str,
    lines: Vec<Segment>,
    anchors: Vec<Anchor>,
    names: Vec<(Vector, String)>,
    skipped: BTreeMap<String, usize>,
    budget: Budget,
}

/// A mark of an anchor: where it stands in the file, its place, m, and the axes along which it slides.
struct Anchor {
    line: usize,
    at_m: Vector,
    free: [bool; 3],
}

/// A straight line: where it stands in the file, its ends, m, and what it is.
struct Segment {
    line: usize,
    ends_m: [Vector; 2],
    kind: Kind,
}

/// Joints found by their places, by the cells of a grid as wide as what is one place.
struct Places {
    within_m: f64,
    level: bool,
    cells: HashMap<[i64; 3], Vec<usize>>,
    at_m: Vec<Vector>,
}

impl<'a> Drawing<'a> {
    pub(super) fn new(file: &'a str) -> Self {
        let (lines, anchors, names) = (vec![], vec![], vec![]);
        Self { file, lines, anchors, names, skipped: BTreeMap::new(), budget: Budget::default() }
    }

    /// One more member, in a layer or group of this name.
    pub(super) fn line(&mut self, line: usize, layer: &str, ends_m: [Vector; 2]) -> Result<()> {
        let room = self.budget.fits_members(self.lines.len() + 1, BYTES_PER_MEMBER);
        room.map_err(|error| self.at(line).memory(error))?;
        let layer = layer.to_lowercase();
        let kind = match () {
            () if layer.contains("rope") => {
                let what = format!("a rope ({:?}), over whatever it runs,", shortened(&layer));
                let error = self.at(line).unknown(what);
                return Err(error.with_help(ROPES));
            }
            () if layer.contains("cable") => Kind::Cable,
            () if layer.contains("strut") => Kind::Strut,
            () => Kind::Bar,
        };
        self.lines.push(Segment { line, ends_m, kind });
        Ok(())
    }

    /// Members from each place to the next.
    pub(super) fn way(
        &mut self,
        line: usize,
        layer: &str,
        places_m: &[Vector],
        closed: bool,
    ) -> Result<()> {
        let back = closed.then(|| places_m.first()).flatten();
        for (a, b) in places_m.iter().zip(places_m.iter().skip(1).chain(back)) {
            self.line(line, layer, [*a, *b])?;
        }
        Ok(())
    }

    /// A point, in a layer or group of this name: an anchor or nothing.
    pub(super) fn point(&mut self, line: usize, layer: &str, at_m: Vector) -> Result<()> {
        let layer = layer.to_lowercase();
        if ANCHORS.iter().all(|word| !layer.contains(word)) {
            self.skip("POINT");
            return Ok(());
        }
        let axes = layer.split_once(FREE).map_or("", |(_, axes)| axes);
        let free = ['x', 'y', 'z'].map(|axis| axes.contains(axis));
        if layer.contains(SLIDING) || axes.chars().any(|c| !"xyz".contains(c)) || free == [true; 3]
        {
            let what = format!("a support that slides obliquely ({:?})", shortened(&layer));
            let error = self.at(line).unknown(what);
            return Err(error.with_help("a name such as supports_free_xz says along which axes"));
        }
        self.anchors.push(Anchor { line, at_m, free });
        Ok(())
    }

    /// The name of a joint.
    pub(super) fn name(&mut self, at_m: Vector, name: String) {
        self.names.push((at_m, name));
    }

    /// Something that is not a line.
    pub(super) fn skip(&mut self, what: &str) {
        *self.skipped.entry(what.to_owned()).or_default() += 1;
    }

    /// The system. `word` is what a line is called in the file, `mark` says how an anchor is marked.
    pub(super) fn system(
        self,
        word: &str,
        mark: &str,
        notes: Vec<String>,
    ) -> Result<ForeignSystem> {
        let mut read = self.joined(word, mark)?;
        read.notes.extend(notes);
        read.notes.push(format!(
            "a drawing has no masses: each member has {MASS_KG_M} kg/m; `funicular convert FILE --to FILE.toml` writes a \
             system file, to be edited"
        ));
        let skipped = self.skipped.iter().map(|(what, count)| format!("{count} {what}"));
        let skipped: Vec<_> = skipped.take(MOST_SKIPPED).collect();
        if !skipped.is_empty() {
            read.notes.push(format!("not read: {}", skipped.join(", ")));
        }
        Ok(read)
    }

    fn joined(&self, word: &str, mark: &str) -> Result<ForeignSystem> {
        let mut places = Places::of(self.lines.iter().flat_map(|line| line.ends_m));
        let (mut ends, mut short) = (Vec::with_capacity(self.lines.len()), 0);
        let mut seen = HashMap::with_capacity(self.lines.len());
        for line in &self.lines {
            let [a, b] = line.ends_m.map(|at_m| places.joint(at_m));
            if a == b {
                short += 1;
                continue;
            }
            match seen.entry([a.min(b), a.max(b)]) {
                Entry::Occupied(other) => {
                    let what = format!("the {word} in line {}", other.get());
                    return Err(self.at(line.line).repeated(what));
                }
                Entry::Vacant(free) => free.insert(line.line),
            };
            ends.push((a, b, line));
        }
        if ends.is_empty() {
            return Err(At::file(self.file).missing(format!("{word} that has a length")));
        }
        let (names, nameless) = self.named(&places, &ends);
        let joints = self.joints(&places, names, mark)?;
        let members = ends.iter().map(|&(a, b, line)| {
            let length_m = norm(minus(places.at_m[b], places.at_m[a]));
            let body = Bar::homogeneous(length_m, MASS_KG_M * length_m)
                .map_err(|error| self.at(line.line).no_system(error))?;
            Ok(Member::bar(a, b, body).of_kind(line.kind))
        });
        let members = members.collect::<Result<Vec<_>>>()?;
        let mut notes = vec![format!(
            "{} members between {} joints; ends within {:.1e} m of each other are one",
            members.len(),
            joints.len(),
            places.within_m
        )];
        if places.level {
            notes.push("the drawing is flat: its y is up, and joints stay in its plane".to_owned());
        }
        if short > 0 {
            notes.push(format!("{short} lines without a length are left out"));
        }
        if nameless > 0 {
            notes
                .push(format!("{nameless} names are not next to a joint without a name: left out"));
        }
        let name = Path::new(self.file).file_stem().unwrap_or_default().to_string_lossy();
        let system = System::new(name, STANDARD_GRAVITY_M_S2, joints, members)
            .map_err(|error| At::file(self.file).no_system(error))?;
        Ok(ForeignSystem { system, notes, floor_m: None })
    }

    /// The name of each joint, and how many names are left over. Each is that of the nearest joint, the nearest name
    /// first, if it is nearer than the middle of the shortest member there.
    fn named(
        &self,
        places: &Places,
        ends: &[(usize, usize, &Segment)],
    ) -> (Vec<Option<String>>, usize) {
        let mut reach_m = vec![f64::INFINITY; places.at_m.len()];
        for &(a, b, _) in ends {
            let half_m = 0.5 * norm(minus(places.at_m[b], places.at_m[a]));
            for k in [a, b] {
                reach_m[k] = half_m.min(reach_m[k]);
            }
        }
        let sorted = nearest::Sorted::of(&places.at_m);
        let near = self.names.iter().filter_map(|(at_m, name)| {
            let (distance_m, joint) = sorted.nearest(places.world(*at_m))?;
            (distance_m < reach_m[joint]).then_some((distance_m, joint, name))
        });
        let mut near: Vec<_> = near.collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut names, mut left) = (vec![None; reach_m.len()], self.names.len());
        for (_, joint, name) in near {
            if names[joint].is_none() {
                names[joint] = Some(name.clone());
                left -= 1;
            }
        }
        (names, left)
    }

    /// The joints where they are drawn, anchors as marked.
    fn joints(
        &self,
        places: &Places,
        mut names: Vec<Option<String>>,
        mark: &str,
    ) -> Result<Vec<Joint>> {
        // Of a flat drawing every joint stays in its plane.
        let unmarked = [true, !places.level, true];
        let mut free = vec![unmarked; places.at_m.len()];
        let mut marked: HashMap<usize, &Anchor> = HashMap::new();
        for anchor in &self.anchors {
            let Some(joint) = places.find(anchor.at_m) else {
                return Err(self.at(anchor.line).missing("line that ends at this anchor"));
            };
            let other = *marked.entry(joint).or_insert(anchor);
            if other.free != anchor.free {
                let what = format!("the anchor in line {}, held in another way,", other.line);
                return Err(self.at(anchor.line).repeated(what));
            }
            let [x, y, z] = anchor.free;
            free[joint] = if places.level { [x, false, y] } else { [x, y, z] };
        }
        if self.anchors.is_empty() {
            return Err(At::file(self.file).missing("anchor").with_help(mark));
        }
        let joint = |(k, &at_m): (usize, &Vector)| {
            let name = names[k].take().unwrap_or_else(|| (k + 1).to_string());
            match support(at_m, free[k]) {
                Support::Fixed { at_m } => Joint::anchor(name, at_m),
                support => Joint::free(name).near(at_m).held_by(support),
            }
        };
        Ok(places.at_m.iter().enumerate().map(joint).collect())
    }

    fn at(&self, line: usize) -> At<'a> {
        At::line(self.file, line)
    }
}

/// What holds a joint that is free along some axes.
pub(super) fn support(at_m: Vector, free: [bool; 3]) -> Support {
    let axes = |wanted: bool| free.map(|free| if free == wanted { 1.0 } else { 0.0 });
    match free.iter().filter(|free| **free).count() {
        0 => Support::Fixed { at_m },
        1 => Support::Line { at_m, direction: axes(true) },
        2 => Support::Plane { at_m, normal: axes(false) },
        _ => Support::Free,
    }
}

impl Places {
    /// Of the ends of all lines: how wide one place is, and whether the drawing is level.
    fn of(ends_m: impl Iterator<Item = Vector>) -> Self {
        let (mut least_m, mut most_m) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for at_m in ends_m {
            least_m = std::array::from_fn(|k| least_m[k].min(at_m[k]));
            most_m = std::array::from_fn(|k| most_m[k].max(at_m[k]));
        }
        let within_m = ONE_PLACE * norm(minus(most_m, least_m));
        let level = most_m[2] - least_m[2] <= within_m;
        Self { within_m, level, cells: HashMap::new(), at_m: vec![] }
    }

    /// A place of the drawing in the world: of a level one y is up, as on paper.
    fn world(&self, [x, y, z]: Vector) -> Vector {
        if self.level { [x, 0.0, y] } else { [x, y, z] }
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "far ends of the grid meet: distances decide"
    )]
    fn cell(&self, at_m: Vector) -> [i64; 3] {
        at_m.map(|x| (x / self.within_m).floor() as i64)
    }

    /// The joint at a place of the world.
    fn near(&self, at_m: Vector) -> Option<usize> {
        let [x, y, z] = self.cell(at_m);
        let around = (0..27).map(|k| {
            [(x, k % 3), (y, k / 3 % 3), (z, k / 9)].map(|(x, k)| x.saturating_add(k - 1))
        });
        let one = |k: &usize| norm(minus(self.at_m[*k], at_m)) <= self.within_m;
        around.filter_map(|cell| self.cells.get(&cell)).flatten().copied().find(one)
    }

    /// The joint at a place of the drawing, if there is one.
    fn find(&self, at_m: Vector) -> Option<usize> {
        self.near(self.world(at_m))
    }

    /// The joint at a place of the drawing.
    fn joint(&mut self, at_m: Vector) -> usize {
        let at_m = self.world(at_m);
        self.near(at_m).unwrap_or_else(|| {
            self.cells.entry(self.cell(at_m)).or_default().push(self.at_m.len());
            self.at_m.push(at_m);
            self.at_m.len() - 1
        })
    }
}
