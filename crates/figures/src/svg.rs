//! The writer of SVG: shapes and texts in px, y downwards.

use std::fmt::{Arguments, Write as _};

use crate::escape::Escaped;
use crate::look::{Kind, Look, Style};
use crate::png::Raster;

/// A picture in the making: a file of its own, or an element of a page.
///
/// ```
/// use figures::{Anchor, Colour, Look, Svg};
/// let mut svg = Svg::new([200.0, 100.0], "Two < three");
/// svg.line(Look::stroke(Colour::BLACK, 2.0), [10.0, 10.0], [190.0, 90.0]);
/// svg.text(Look::PLAIN, [100.0, 50.0], Anchor::Middle, "a & b");
/// let text = svg.finish();
/// assert!(text.contains("<title>Two &lt; three</title>") && text.contains(">a &amp; b</text>"));
/// ```
#[derive(Debug, Clone)]
pub struct Svg {
    /// Name in the page; none for a file of its own.
    id: Option<String>,
    size: [f64; 2],
    title: String,
    description: String,
    letters_px: f64,
    body: String,
}

/// Which side of its point a text stands on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// To the right of it.
    Start,
    /// Centred on it.
    Middle,
    /// To the left of it.
    End,
}

impl Anchor {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// Length of the head of an arrow and half its width, px.
const HEAD: [f64; 2] = [9.0, 3.6];

/// Size of the letters of a file of its own, px.
const LETTERS: f64 = 14.0;

impl Svg {
    /// A picture of this size that is a file of its own: on white, with letters that every system
    /// has. Its shapes need colours.
    pub fn new(size: [f64; 2], title: &str) -> Self {
        Self {
            id: None,
            size,
            title: title.to_owned(),
            description: String::new(),
            letters_px: LETTERS,
            body: String::new(),
        }
    }

    /// A picture of this size for a page, whose style knows the classes of its shapes. `id` is
    /// unique in the page; title and description are for those who do not see it.
    pub fn in_page(id: &str, size: [f64; 2], title: &str, description: &str) -> Self {
        let id = Some(id.to_owned());
        Self { id, description: description.to_owned(), ..Self::new(size, title) }
    }

    /// The same with a description for those who do not see it.
    #[must_use]
    pub fn described(self, description: &str) -> Self {
        Self { description: description.to_owned(), ..self }
    }

    /// The same with letters of this size, px.
    #[must_use]
    pub fn letters(self, letters_px: f64) -> Self {
        Self { letters_px, ..self }
    }

    /// Digits behind the point of coordinates: in a page a tenth of a pixel is below what is seen;
    /// a file is printed and enlarged.
    fn digits(&self) -> usize {
        if self.id.is_some() { 1 } else { 2 }
    }

    /// An empty element: class, geometry, style.
    fn shape(&mut self, tag: &str, look: &Look<'_>, geometry: Arguments<'_>) {
        let (class, style) = (Class(look.class), Style(look, Kind::Area));
        // Here and below: writing to a String cannot fail.
        let _ = writeln!(self.body, "<{tag}{class} {geometry}{style}/>");
    }

    /// A straight line.
    pub fn line<'a>(&mut self, look: impl Into<Look<'a>>, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        let d = self.digits();
        let geometry = format_args!(r#"x1="{x1:.d$}" y1="{y1:.d$}" x2="{x2:.d$}" y2="{y2:.d$}""#);
        self.shape("line", &look.into(), geometry);
    }

    /// A line from point to point.
    pub fn polyline<'a>(
        &mut self,
        look: impl Into<Look<'a>>,
        points: impl IntoIterator<Item = [f64; 2]>,
    ) {
        let points = self.points(points);
        self.shape("polyline", &look.into(), format_args!(r#"points="{points}""#));
    }

    /// A closed area.
    pub fn polygon<'a>(&mut self, look: impl Into<Look<'a>>, points: &[[f64; 2]]) {
        let points = self.points(points.iter().copied());
        self.shape("polygon", &look.into(), format_args!(r#"points="{points}""#));
    }

    fn points(&self, points: impl IntoIterator<Item = [f64; 2]>) -> String {
        let d = self.digits();
        let mut text = String::new();
        for [x, y] in points {
            let _ = write!(text, "{x:.d$},{y:.d$} ");
        }
        text.truncate(text.trim_end().len());
        text
    }

    /// Straight lines with gaps between them, as one shape.
    pub fn lines<'a>(
        &mut self,
        look: impl Into<Look<'a>>,
        lines: impl IntoIterator<Item = [[f64; 2]; 2]>,
    ) {
        let d = self.digits();
        let mut path = String::new();
        for [[x1, y1], [x2, y2]] in lines {
            let _ = write!(path, "M{x1:.d$} {y1:.d$}L{x2:.d$} {y2:.d$}");
        }
        if !path.is_empty() {
            self.shape("path", &look.into(), format_args!(r#"d="{path}""#));
        }
    }

    /// Boxes between two opposite corners each, as one shape.
    pub fn boxes<'a>(
        &mut self,
        look: impl Into<Look<'a>>,
        boxes: impl IntoIterator<Item = [[f64; 2]; 2]>,
    ) {
        let d = self.digits();
        let mut path = String::new();
        for [[x1, y1], [x2, y2]] in boxes {
            let _ = write!(path, "M{x1:.d$} {y1:.d$}H{x2:.d$}V{y2:.d$}H{x1:.d$}z");
        }
        if !path.is_empty() {
            self.shape("path", &look.into(), format_args!(r#"d="{path}""#));
        }
    }

    /// A box with its upper left corner here.
    pub fn rectangle<'a>(
        &mut self,
        look: impl Into<Look<'a>>,
        [x, y]: [f64; 2],
        [width, height]: [f64; 2],
    ) {
        let d = self.digits();
        let geometry =
            format_args!(r#"x="{x:.d$}" y="{y:.d$}" width="{width:.d$}" height="{height:.d$}""#);
        self.shape("rect", &look.into(), geometry);
    }

    /// A disc or a ring.
    pub fn circle<'a>(&mut self, look: impl Into<Look<'a>>, [x, y]: [f64; 2], radius: f64) {
        let d = self.digits();
        let geometry = format_args!(r#"cx="{x:.d$}" cy="{y:.d$}" r="{radius:.d$}""#);
        self.shape("circle", &look.into(), geometry);
    }

    /// A square on one of its corners, `radius` from its centre.
    pub fn diamond<'a>(&mut self, look: impl Into<Look<'a>>, [x, y]: [f64; 2], radius: f64) {
        self.polygon(look, &[[x, y - radius], [x + radius, y], [x, y + radius], [x - radius, y]]);
    }

    /// A cross.
    pub fn cross<'a>(&mut self, look: impl Into<Look<'a>>, [x, y]: [f64; 2], radius: f64) {
        let look = look.into();
        self.line(look, [x - radius, y - radius], [x + radius, y + radius]);
        self.line(look, [x - radius, y + radius], [x + radius, y - radius]);
    }

    /// An arrow with its head at `to`, in the colour of its line. Nothing if it has no length.
    pub fn arrow<'a>(&mut self, look: impl Into<Look<'a>>, from: [f64; 2], to: [f64; 2]) {
        let look = look.into();
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy);
        if length.is_nan() || length < 1.0 {
            return;
        }
        let (ux, uy) = (dx / length, dy / length);
        let head = HEAD[0].min(length);
        let neck = [to[0] - head * ux, to[1] - head * uy];
        let side = |k: f64| [neck[0] - k * HEAD[1] * uy, neck[1] + k * HEAD[1] * ux];
        self.line(look, from, neck);
        let class = format!("{} head", look.class);
        self.polygon(look.head().class(class.trim_start()), &[to, side(1.0), side(-1.0)]);
    }

    /// An arc about a centre from one direction to another, in degrees from straight down towards
    /// the right.
    pub fn arc<'a>(
        &mut self,
        look: impl Into<Look<'a>>,
        [x, y]: [f64; 2],
        radius: f64,
        from: f64,
        to: f64,
    ) {
        /// One point for that many degrees.
        const STEP: f64 = 3.0;
        let steps = ((to - from).abs() / STEP).ceil().max(1.0);
        let points = (0..).take_while(|k| f64::from(*k) <= steps).map(|k| {
            let (sin, cos) = (from + (to - from) * f64::from(k) / steps).to_radians().sin_cos();
            [x + radius * sin, y + radius * cos]
        });
        self.polyline(look, points.collect::<Vec<_>>());
    }

    /// A raster between these corners: each of its pixels a rectangle with sharp edges.
    pub fn raster(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], raster: &Raster<'_>) {
        let geometry = format_args!(
            "x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{}\"",
            raster.base64()
        );
        self.shape("image", &Look::PLAIN, geometry);
    }

    /// A text.
    pub fn text<'a>(
        &mut self,
        look: impl Into<Look<'a>>,
        at: [f64; 2],
        anchor: Anchor,
        text: &str,
    ) {
        self.text_element(&look.into(), at, anchor, "", &Escaped(text).to_string());
    }

    /// A text in which what stands between `_` and the next space or the end is set as an index.
    pub fn indexed<'a>(
        &mut self,
        look: impl Into<Look<'a>>,
        at: [f64; 2],
        anchor: Anchor,
        text: &str,
    ) {
        self.text_element(&look.into(), at, anchor, "", &indexed(text));
    }

    /// A text of pieces that look different.
    ///
    /// Blanks at the start of a piece become a shift.
    pub fn pieces(&mut self, at: [f64; 2], anchor: Anchor, pieces: &[(Look<'_>, &str)]) {
        /// How wide a blank is, px.
        const BLANK: usize = 5;
        let mut inner = String::new();
        for (look, text) in pieces {
            let (class, style) = (Class(look.class), Style(look, Kind::Text));
            // Blanks at the start of a piece are dropped by some programs: a shift is not.
            let shown = text.trim_start_matches([' ', '\u{a0}']);
            let blanks = text.chars().count() - shown.chars().count();
            let shift =
                if blanks > 0 { format!(" dx=\"{}\"", BLANK * blanks) } else { String::new() };
            let _ = write!(inner, "<tspan{class}{style}{shift}>{}</tspan>", Escaped(shown));
        }
        self.text_element(&Look::PLAIN, at, anchor, "", &inner);
    }

    /// A text that runs upwards, centred on its point.
    pub fn text_upwards<'a>(&mut self, look: impl Into<Look<'a>>, at: [f64; 2], text: &str) {
        let [x, y] = at;
        let turn = format!(r#" transform="rotate(-90 {x:.2} {y:.2})""#);
        let text = Escaped(text).to_string();
        self.text_element(&look.into(), at, Anchor::Middle, &turn, &text);
    }

    fn text_element(
        &mut self,
        look: &Look<'_>,
        [x, y]: [f64; 2],
        anchor: Anchor,
        turn: &str,
        inner: &str,
    ) {
        let (d, anchor) = (self.digits(), anchor.name());
        let (class, style) = (Class(look.class), Style(look, Kind::Text));
        let _ = writeln!(
            self.body,
            "<text{class} x=\"{x:.d$}\" y=\"{y:.d$}\" text-anchor=\"{anchor}\"{turn}{style}>\
             {inner}</text>"
        );
    }

    /// Shapes that belong together, moved by this much; a title is read aloud and shown by browsers
    /// where the pointer rests.
    pub fn group(
        &mut self,
        class: &str,
        [x, y]: [f64; 2],
        title: Option<&str>,
        draw: impl FnOnce(&mut Self),
    ) {
        let class = Class(class);
        let _ = match title {
            Some(title) => writeln!(
                self.body,
                "<g{class} role=\"img\" transform=\"translate({x:.1} {y:.1})\">\n<title>{}</title>",
                Escaped(title)
            ),
            None => writeln!(self.body, "<g{class} transform=\"translate({x:.1} {y:.1})\">"),
        };
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// The finished text.
    pub fn finish(self) -> String {
        let Self { id, size: [width, height], title, description, letters_px, body } = self;
        let (title, description) = (Escaped(&title), Escaped(&description));
        if let Some(id) = id {
            let id = Escaped(&id);
            return format!(
                "<svg viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
                 role=\"img\" aria-labelledby=\"{id}-title {id}-desc\">\n\
                 <title id=\"{id}-title\">{title}</title>\n\
                 <desc id=\"{id}-desc\">{description}</desc>\n{body}</svg>\n"
            );
        }
        let about = match description.0 {
            "" => String::new(),
            _ => format!("<desc>{description}</desc>\n"),
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"Helvetica, Arial, sans-serif\" \
             font-size=\"{letters_px}\" stroke-linejoin=\"round\" role=\"img\">\n\
             <title>{title}</title>\n{about}\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        )
    }
}

/// The attribute of a class, if there is one.
struct Class<'a>(&'a str);

impl std::fmt::Display for Class<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0.is_empty() { Ok(()) } else { write!(f, " class=\"{}\"", Escaped(self.0)) }
    }
}

/// `C_1 x` with the index set lower and smaller.
fn indexed(text: &str) -> String {
    let text = Escaped(text).to_string();
    let mut out = String::new();
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once('_') {
        let (index, tail) = after.split_at(after.find(' ').unwrap_or(after.len()));
        let _ = write!(
            out,
            r#"{before}<tspan class="index" dy="4">{index}</tspan><tspan dy="-4">&#8203;</tspan>"#
        );
        rest = tail;
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_says_what_it_is() {
        let mut svg = Svg::in_page("a", [10.0, 20.0], "A < B", "Nothing to see.");
        svg.indexed("label", [1.0, 2.0], Anchor::Middle, "C_1 & D");
        let text = svg.finish();
        assert!(text.contains("role=\"img\" aria-labelledby=\"a-title a-desc\""));
        assert!(text.contains("<title id=\"a-title\">A &lt; B</title>"));
        assert!(text.contains(">C<tspan class=\"index\" dy=\"4\">1</tspan>"));
        assert!(text.contains(" &amp; D</text>"));
    }

    #[test]
    fn an_arrow_without_length_is_not_drawn() {
        let mut svg = Svg::in_page("a", [10.0, 20.0], "", "");
        svg.arrow("force", [3.0, 3.0], [3.0, 3.0]);
        svg.arrow("force", [3.0, 3.0], [f64::NAN, 3.0]);
        let text = svg.finish();
        assert!(!text.contains("NaN") && !text.contains("force"));
    }

    #[test]
    fn no_text_of_the_caller_is_markup() {
        let bad = "\"><script>&";
        let mut svg = Svg::in_page(bad, [10.0; 2], bad, bad);
        svg.line(bad, [0.0; 2], [1.0; 2]);
        svg.text(bad, [0.0; 2], Anchor::End, bad);
        svg.indexed(bad, [0.0; 2], Anchor::End, bad);
        svg.text_upwards(bad, [0.0; 2], bad);
        svg.pieces([0.0; 2], Anchor::End, &[(bad.into(), bad)]);
        svg.group(bad, [0.0; 2], Some(bad), |_| ());
        assert!(!svg.finish().contains("<script"));
        assert!(!Svg::new([1.0; 2], bad).described(bad).finish().contains("<script"));
    }
}
