//! A small writer of vector graphics for the page: shapes with classes, colours left to its style.

use std::fmt::{Display, Write as _};

/// A picture in the making. Coordinates in px, y downwards.
#[derive(Debug, Clone)]
pub struct Svg {
    id: String,
    size: [f64; 2],
    title: String,
    description: String,
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

/// Length of the head of an arrow and half its width, px.
const HEAD: [f64; 2] = [9.0, 3.6];

impl Svg {
    /// An empty picture. `id` is unique in the page; title and description are for those who do not see
    /// it.
    #[must_use]
    pub fn new(id: &str, size: [f64; 2], title: &str, description: &str) -> Self {
        Self {
            id: id.to_owned(),
            size,
            title: title.to_owned(),
            description: description.to_owned(),
            body: String::new(),
        }
    }

    fn element(&mut self, text: impl Display) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.body, "{text}");
    }

    /// A straight line.
    pub fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        self.element(format_args!(
            r#"<line class="{class}" x1="{x1:.1}" y1="{y1:.1}" x2="{x2:.1}" y2="{y2:.1}"/>"#
        ));
    }

    /// A line from point to point.
    pub fn polyline(&mut self, class: &str, points: impl IntoIterator<Item = [f64; 2]>) {
        let mut path = String::new();
        for [x, y] in points {
            let _ = write!(path, "{x:.1},{y:.1} ");
        }
        self.element(format_args!(r#"<polyline class="{class}" points="{}"/>"#, path.trim_end()));
    }

    /// A closed area.
    pub fn polygon(&mut self, class: &str, points: &[[f64; 2]]) {
        let mut path = String::new();
        for [x, y] in points {
            let _ = write!(path, "{x:.1},{y:.1} ");
        }
        self.element(format_args!(r#"<polygon class="{class}" points="{}"/>"#, path.trim_end()));
    }

    /// Boxes between two opposite corners each, as one shape.
    pub fn boxes(&mut self, class: &str, boxes: impl IntoIterator<Item = [[f64; 2]; 2]>) {
        let mut path = String::new();
        for [[x1, y1], [x2, y2]] in boxes {
            let _ = write!(path, "M{x1:.1} {y1:.1}H{x2:.1}V{y2:.1}H{x1:.1}z");
        }
        if !path.is_empty() {
            self.element(format_args!(r#"<path class="{class}" d="{path}"/>"#));
        }
    }

    /// A disc or a ring.
    pub fn circle(&mut self, class: &str, [x, y]: [f64; 2], radius: f64) {
        self.element(format_args!(
            r#"<circle class="{class}" cx="{x:.1}" cy="{y:.1}" r="{radius:.1}"/>"#
        ));
    }

    /// A square on one of its corners, `radius` from its centre.
    pub fn diamond(&mut self, class: &str, [x, y]: [f64; 2], radius: f64) {
        self.polygon(class, &[[x, y - radius], [x + radius, y], [x, y + radius], [x - radius, y]]);
    }

    /// A cross.
    pub fn cross(&mut self, class: &str, [x, y]: [f64; 2], radius: f64) {
        self.line(class, [x - radius, y - radius], [x + radius, y + radius]);
        self.line(class, [x - radius, y + radius], [x + radius, y - radius]);
    }

    /// An arrow with its head at `to`. Nothing if it has no length.
    pub fn arrow(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = dx.hypot(dy);
        if length.is_nan() || length < 1.0 {
            return;
        }
        let (ux, uy) = (dx / length, dy / length);
        let head = HEAD[0].min(length);
        let neck = [to[0] - head * ux, to[1] - head * uy];
        let side = |k: f64| [neck[0] - k * HEAD[1] * uy, neck[1] + k * HEAD[1] * ux];
        self.line(class, from, neck);
        self.polygon(&format!("{class} head"), &[to, side(1.0), side(-1.0)]);
    }

    /// An arc about a centre from one direction to another, in degrees from straight down towards the
    /// right.
    pub fn arc(&mut self, class: &str, [x, y]: [f64; 2], radius: f64, from: f64, to: f64) {
        /// One point for that many degrees.
        const STEP: f64 = 3.0;
        let steps = ((to - from).abs() / STEP).ceil().max(1.0);
        let points = (0..).take_while(|k| f64::from(*k) <= steps).map(|k| {
            let (sin, cos) = (from + (to - from) * f64::from(k) / steps).to_radians().sin_cos();
            [x + radius * sin, y + radius * cos]
        });
        self.polyline(class, points.collect::<Vec<_>>());
    }

    /// A text. What stands between `_` and the next space or the end is set as an index, and
    /// `*` in front makes it italic.
    pub fn text(&mut self, class: &str, [x, y]: [f64; 2], anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.element(format_args!(
            r#"<text class="{class}" x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{}</text>"#,
            indexed(text)
        ));
    }

    /// The finished element.
    #[must_use]
    pub fn finish(self) -> String {
        let Self { id, size: [width, height], title, description, body } = self;
        format!(
            "<svg viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\">\n<title id=\"{id}-title\">{}</title>\n\
             <desc id=\"{id}-desc\">{}</desc>\n{body}</svg>\n",
            escape(&title),
            escape(&description),
        )
    }
}

/// Text that is no markup.
#[must_use]
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// `C_1 x` with the index set lower and smaller.
fn indexed(text: &str) -> String {
    let text = escape(text);
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
        let mut svg = Svg::new("a", [10.0, 20.0], "A < B", "Nothing to see.");
        svg.text("label", [1.0, 2.0], Anchor::Middle, "C_1 & D");
        let text = svg.finish();
        assert!(text.contains("role=\"img\" aria-labelledby=\"a-title a-desc\""));
        assert!(text.contains("<title id=\"a-title\">A &lt; B</title>"));
        assert!(text.contains(">C<tspan class=\"index\" dy=\"4\">1</tspan>"));
        assert!(text.contains(" &amp; D</text>"));
    }

    #[test]
    fn an_arrow_without_length_is_not_drawn() {
        let mut svg = Svg::new("a", [10.0, 20.0], "", "");
        svg.arrow("force", [3.0, 3.0], [3.0, 3.0]);
        svg.arrow("force", [3.0, 3.0], [f64::NAN, 3.0]);
        assert!(!svg.clone().finish().contains("NaN"));
    }
}
