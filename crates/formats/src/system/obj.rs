//! Wavefront OBJ: lines between vertices.
//!
//! Elements `l` are members, elements `p` in a group of anchors are anchors; the last name of `g` or `o` says what they
//! are. Z is up and lengths are in m, which the format leaves open. Faces and curves are no members.
//!
//! # References
//!
//! Wavefront Technologies, "Advanced Visualizer", appendix B1, "Object files (.obj)".

use model::Vector;

use crate::error::{At, Result, Wrong, shortened};
use crate::system::drawing::Drawing;
use crate::system::{ForeignSystem, among};

/// Elements that are counted and not read.
const SKIPPED: &[&str] = &["f", "curv", "curv2", "surf"];
/// What belongs to surfaces and pictures.
const NO_BEARING: &str = "vt vn vp s mg usemtl mtllib usemap maplib cstype deg bmat step parm trim \
    hole scrv sp end con bevel c_interp d_interp lod shadow_obj trace_obj ctech stech";
/// How an anchor is marked.
const MARK: &str = "mark each anchor by an element `p` of its vertex, in a group (`g`) whose name has \"anchor\" in it";

/// Read the lines of an OBJ file.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the part that is wrong or not understood.
///
/// ```
/// let text = "v 0 0 0\nv 3 0 0\nv 1 0 -2\ng cables\nl 1 3 2\ng anchors\np 1 2\n";
/// let system = formats::system::parse_obj(text, "lamp.obj")?.system;
/// assert_eq!((system.name(), system.joints().len(), system.members().len()), ("lamp", 3, 2));
/// # Ok::<(), formats::FormatError>(())
/// ```
pub fn parse_obj(text: &str, file: &str) -> Result<ForeignSystem> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (mut vertices, mut group) = (Vec::<Vector>::new(), "");
    let mut drawing = Drawing::new(file);
    for (k, line) in text.lines().enumerate() {
        let at = At::line(file, k + 1);
        let bare = line.split('#').next().unwrap_or_default().trim();
        let (word, rest) = bare.split_once(char::is_whitespace).unwrap_or((bare, ""));
        let corner = |word: &str| corner(&vertices, word, at);
        match word {
            "" => {}
            "v" => {
                let words: Vec<&str> = rest.split_whitespace().collect();
                let [x, y, z, ..] = words[..] else {
                    return Err(at.error(Wrong::Count { wanted: 3, found: words.len() }));
                };
                let one = |text: &str| at.number("a coordinate", text);
                vertices.push([one(x)?, one(y)?, one(z)?]);
            }
            "l" => {
                let places = rest.split_whitespace().map(corner).collect::<Result<Vec<_>, _>>()?;
                drawing.way(k + 1, group, &places, false)?;
            }
            "p" => {
                for word in rest.split_whitespace() {
                    drawing.point(k + 1, group, corner(word)?)?;
                }
            }
            "g" | "o" => group = rest,
            word if SKIPPED.contains(&word) => drawing.skip(word),
            word if among(NO_BEARING, word) => {}
            word => {
                return Err(at.unknown(format!("the element {:?}", shortened(word))));
            }
        }
    }
    drawing.system("line (`l`)", MARK, vec!["lengths are in m, and z is up".to_owned()])
}

/// The vertex of a word as `3`, `-1` or `3/2`: negative ones count from the last.
fn corner(vertices: &[Vector], word: &str, at: At<'_>) -> Result<Vector> {
    let index = word.split('/').next().unwrap_or_default().parse::<i64>().ok();
    let count = i64::try_from(vertices.len()).unwrap_or(i64::MAX);
    let index = index.map(|index| if index < 0 { count.saturating_add(index) } else { index - 1 });
    let vertex = index.and_then(|index| vertices.get(usize::try_from(index).ok()?));
    vertex.copied().ok_or_else(|| at.missing(format!("vertex {:?}", shortened(word))))
}
