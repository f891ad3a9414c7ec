//! Answers as VTK's XML of an unstructured grid, in ASCII.
//!
//! # References
//!
//! VTK File Formats, <https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html>.

use model::Vector;
use roxmltree::{Document, Node, ParsingOptions};

use crate::answer::{Answer, Forces, Joints};
use crate::error::{At, Result, Wrong, as_count};

/// VTK's numbers for a line of two points, and for one of many.
const LINES: [usize; 2] = [3, 4];

/// More attributes than any element of the format has.
const MOST_ATTRIBUTES: usize = 100;

/// Parse a VTU file: its points are the joints in the order of the system, its lines members or spans of
/// ropes, in the order of their numbers `member` if it has these.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the reason: what is not ASCII, not a line, or not understood.
pub fn parse_vtu(text: &str, file: &str) -> Result<Answer> {
    check_attributes(text, file)?;
    let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
    let text = text.trim_start_matches('\u{feff}');
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let line = usize::try_from(error.pos().row).ok();
        At { file, line }.error(Wrong::Xml(error.to_string()))
    })?;
    let reader = Reader { file };
    let root = document.root_element();
    if !root.has_tag_name("VTKFile") || root.attribute("type") != Some("UnstructuredGrid") {
        return Err(reader.at(root).missing("VTKFile of type UnstructuredGrid"));
    }
    let pieces: Vec<_> = root.descendants().filter(|node| node.has_tag_name("Piece")).collect();
    let [piece] = pieces[..] else {
        return Err(reader.at(root).missing("single Piece"));
    };
    let points = reader.child(piece, "Points")?;
    let places = reader.array(reader.child(points, "DataArray")?)?;
    if places.is_empty() || places.len() % 3 != 0 {
        let (wanted, found) = (places.len().div_ceil(3).max(1) * 3, places.len());
        return Err(reader.at(points).error(Wrong::Count { wanted, found }));
    }
    let joints: Vec<Vector> = places.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
    let members = reader.lines(piece)?;
    let of_lines = |name| match reader.named(piece, "CellData", name)? {
        Some(found) if found.len() != members.len() => {
            let wrong = Wrong::Count { wanted: members.len(), found: found.len() };
            Err(reader.at(piece).error(wrong))
        }
        found => Ok(found),
    };
    let (axial_n, numbers) = (of_lines("axial_n")?, of_lines("member")?);
    let mut order: Vec<usize> = (0..members.len()).collect();
    if let Some(numbers) = numbers {
        order.sort_by(|a, b| numbers[*a].total_cmp(&numbers[*b]));
    }
    let force = |k: usize| axial_n.as_ref().map(|forces| forces[k]);
    let forces = order.into_iter().map(|k| (members[k][0], members[k][1], force(k)));
    Ok(Answer {
        source: file.to_owned(),
        joints: Joints::InOrder(joints),
        forces: Forces::Numbered(forces.collect()),
        reactions_n: None,
    })
}

/// Refuse an element with more attributes than any of VTK has, as the parser holds each of them
/// against all others. What follows a `<` up to the next one contains all of the element's.
fn check_attributes(text: &str, file: &str) -> Result<()> {
    let elements = text.split('<').skip(1).filter(|part| !part.starts_with('!'));
    let mut elements = elements.map(|part| (part, part.matches('=').count()));
    let Some((part, found)) = elements.find(|(_, found)| *found > MOST_ATTRIBUTES) else {
        return Ok(());
    };
    let line = text[..part.as_ptr().addr() - text.as_ptr().addr()].matches('\n').count() + 1;
    Err(At::line(file, line).unknown(format!("an element with {found} attributes")))
}

struct Reader<'a> {
    file: &'a str,
}

impl Reader<'_> {
    fn at(&self, node: Node<'_, '_>) -> At<'_> {
        let line = node.document().text_pos_at(node.range().start).row;
        At { file: self.file, line: usize::try_from(line).ok() }
    }

    fn child<'n, 'd>(&self, node: Node<'n, 'd>, name: &str) -> Result<Node<'n, 'd>> {
        let child = node.children().find(|child| child.has_tag_name(name));
        child.ok_or_else(|| self.at(node).missing(format!("{name} in {}", node.tag_name().name())))
    }

    /// The numbers of a DataArray.
    fn array(&self, node: Node<'_, '_>) -> Result<Vec<f64>> {
        let format = node.attribute("format").unwrap_or("ascii");
        if format != "ascii" {
            let error = self.at(node).unknown(format!("DataArray of format {format:?}"));
            return Err(error.with_help("write the file in ASCII"));
        }
        let (at, name) = (self.at(node), node.attribute("Name").unwrap_or("DataArray"));
        let text = node.text().unwrap_or_default();
        text.split_whitespace().map(|word| at.number(name, word)).collect()
    }

    /// The DataArray of a name, if it is there.
    fn named(&self, piece: Node<'_, '_>, part: &str, name: &str) -> Result<Option<Vec<f64>>> {
        let Some(part) = piece.children().find(|child| child.has_tag_name(part)) else {
            return Ok(None);
        };
        let arrays = part.children().filter(|child| child.has_tag_name("DataArray"));
        let mut arrays = arrays.filter(|array| array.attribute("Name") == Some(name));
        arrays.next().map(|array| self.array(array)).transpose()
    }

    fn counts(&self, piece: Node<'_, '_>, name: &str) -> Result<Vec<usize>> {
        let cells = self.child(piece, "Cells")?;
        let found = self.named(piece, "Cells", name)?;
        let found =
            found.ok_or_else(|| self.at(cells).missing(format!("array {name:?} of the cells")))?;
        let whole = |x: f64| {
            let wanted = "a whole number";
            let wrong = Wrong::Value { what: name.to_owned(), wanted, found: x.to_string() };
            let fits = x >= 0.0 && x <= f64::from(u32::MAX) && x.fract() <= 0.0;
            if fits { Ok(as_count(x)) } else { Err(self.at(cells).error(wrong)) }
        };
        found.into_iter().map(whole).collect()
    }

    /// The members: every line of two points, every piece of one of many.
    fn lines(&self, piece: Node<'_, '_>) -> Result<Vec<[usize; 2]>> {
        let ends = self.counts(piece, "offsets")?;
        let kinds = self.counts(piece, "types")?;
        let points = self.counts(piece, "connectivity")?;
        if kinds.len() != ends.len() {
            let wrong = Wrong::Count { wanted: ends.len(), found: kinds.len() };
            return Err(self.at(piece).error(wrong));
        }
        let (mut members, mut start) = (vec![], 0);
        for (end, kind) in ends.into_iter().zip(kinds) {
            if !LINES.contains(&kind) {
                return Err(self.at(piece).out_of_scope(format!("cell of VTK's type {kind}")));
            }
            let Some(line) = points.get(start..end) else {
                let wrong = Wrong::Count { wanted: end, found: points.len() };
                return Err(self.at(piece).error(wrong));
            };
            members.extend(line.windows(2).map(|pair| [pair[0], pair[1]]));
            start = end;
        }
        Ok(members)
    }
}
