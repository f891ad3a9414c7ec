//! How shapes and texts look.

use std::fmt;

/// A colour of the screen: red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// Black.
    pub const BLACK: Self = Self([0; 3]);
    /// White.
    pub const WHITE: Self = Self([0xff; 3]);

    /// A grey from black (0) to white (255).
    pub const fn grey(level: u8) -> Self {
        Self([level; 3])
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// How a shape or a text looks: a class that the style of a page knows, or colours of its own.
///
/// ```
/// use figures::{Colour, Look};
/// let thick = Look::stroke(Colour::BLACK, 3.0).dashed("6 4");
/// let named: Look<'_> = "tension".into();
/// assert_ne!(thick, named);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Look<'a> {
    pub(crate) class: &'a str,
    fill: Option<Colour>,
    stroke: Option<(Colour, f64)>,
    dashes: &'static str,
    size_px: Option<f64>,
    bold: bool,
    edge: Option<Colour>,
}

impl<'a, T: AsRef<str> + ?Sized> From<&'a T> for Look<'a> {
    fn from(class: &'a T) -> Self {
        Self { class: class.as_ref(), ..Self::default() }
    }
}

impl<'a> Look<'a> {
    /// As what is around it looks.
    pub const PLAIN: Look<'static> = Look {
        class: "",
        fill: None,
        stroke: None,
        dashes: "",
        size_px: None,
        bold: false,
        edge: None,
    };

    /// A line of a colour and a width in px.
    pub const fn stroke(colour: Colour, width_px: f64) -> Self {
        Look { stroke: Some((colour, width_px)), ..Look::PLAIN }
    }

    /// An area or a text of a colour.
    pub const fn fill(colour: Colour) -> Self {
        Look { fill: Some(colour), ..Look::PLAIN }
    }

    /// The same, filled.
    #[must_use]
    pub const fn filled(self, colour: Colour) -> Self {
        Self { fill: Some(colour), ..self }
    }

    /// The same in dashes: lengths in px of dash, gap, dash, ...
    #[must_use]
    pub const fn dashed(self, dashes: &'static str) -> Self {
        Self { dashes, ..self }
    }

    /// The same with letters of this size in px.
    #[must_use]
    pub const fn size(self, size_px: f64) -> Self {
        Self { size_px: Some(size_px), ..self }
    }

    /// The same in bold letters.
    #[must_use]
    pub const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// The same text with an edge around its letters, so that it can be read where it crosses a
    /// line.
    #[must_use]
    pub const fn edged(self, colour: Colour) -> Self {
        Self { edge: Some(colour), ..self }
    }

    /// The same with a class, by which scripts and tests find it.
    #[must_use]
    pub const fn class(self, class: &'a str) -> Self {
        Self { class, ..self }
    }

    /// The look of an area in the colour of this line: of the head of an arrow.
    pub(crate) fn head(self) -> Self {
        let fill = self.stroke.map(|(colour, _)| colour);
        Self { fill, stroke: None, dashes: "", ..self }
    }

    /// Whether it has colours of its own.
    pub(crate) fn is_drawn(&self) -> bool {
        self.fill.is_some() || self.stroke.is_some()
    }
}

/// The attributes but the class; an area that is not filled is told so.
pub(crate) struct Style<'a>(pub(crate) &'a Look<'a>, pub(crate) Kind);

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Area,
    Text,
}

impl fmt::Display for Style<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(look, kind) = self;
        match look.fill {
            Some(colour) => write!(f, " fill=\"{colour}\"")?,
            None if *kind == Kind::Area && look.is_drawn() => f.write_str(" fill=\"none\"")?,
            None => {}
        }
        if let Some((colour, width)) = look.stroke {
            write!(f, " stroke=\"{colour}\" stroke-width=\"{width}\"")?;
        }
        if !look.dashes.is_empty() {
            write!(f, " stroke-dasharray=\"{}\"", look.dashes)?;
        }
        if let Some(size) = look.size_px {
            write!(f, " font-size=\"{size}\"")?;
        }
        if let Some(colour) = look.edge {
            write!(f, " stroke=\"{colour}\" stroke-width=\"3\" paint-order=\"stroke\"")?;
        }
        if look.bold {
            f.write_str(" font-weight=\"bold\"")?;
        }
        Ok(())
    }
}
