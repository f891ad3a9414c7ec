//! Labels that do not cover each other, nor members and arrows where that can be: what has no room
//! is left out.

use std::collections::BTreeMap;

use model::number::{decimals, trimmed};

use crate::look::{Colour, Look};
use crate::svg::{Anchor, Svg};

/// Size of the letters, px, and their mean width.
const LETTERS: f64 = 12.0;
const LETTER: f64 = 6.7;

/// Side of the cells in which covered places are looked up, px.
const CELL: f64 = 64.0;

/// Most labels in a drawing: more are read by nobody.
const MOST: usize = 200;

/// Distance of the points by which a line is kept free, px: less than the height of a label.
const STEP: f64 = 5.0;

/// Most points of lines that are kept free: in a drawing with more nobody reads labels.
const MOST_POINTS: usize = 100_000;

/// Whether a label may cross members and arrows where it finds no other place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Crossing {
    /// It is left out instead.
    Never,
    /// It is worth it.
    Allowed,
}

/// The places that are taken.
pub(crate) struct Labels {
    size: [f64; 2],
    taken: BTreeMap<[i32; 2], Vec<[f64; 4]>>,
    /// Points of members and arrows.
    lines: BTreeMap<[i32; 2], Vec<[f64; 2]>>,
    points: usize,
    written: usize,
}

impl Labels {
    pub(crate) fn within(size: [f64; 2]) -> Self {
        Self { size, taken: BTreeMap::new(), lines: BTreeMap::new(), points: 0, written: 0 }
    }

    /// Keep a line free of labels where that can be.
    pub(crate) fn line(&mut self, [a, b]: [[f64; 2]; 2]) {
        let along = [b[0] - a[0], b[1] - a[1]];
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "pixels of a picture"
        )]
        let steps = (along[0].hypot(along[1]) / STEP).ceil() as usize;
        self.points += steps;
        if self.points > MOST_POINTS {
            return;
        }
        for k in 0..=steps {
            let part = k as f64 / steps.max(1) as f64;
            let point = [0, 1].map(|c| a[c] + part * along[c]);
            self.lines.entry(cell(point)).or_default().push(point);
        }
    }

    /// Keep a place free of labels.
    pub(crate) fn take(&mut self, [x, y]: [f64; 2], radius: f64) {
        self.insert([x - radius, y - radius, x + radius, y + radius]);
    }

    /// Whether there is no use in trying.
    pub(crate) fn full(&self) -> bool {
        self.written >= MOST
    }

    /// Write a text at the first of these places where it covers nothing.
    pub(crate) fn write(
        &mut self,
        svg: &mut Svg,
        text: &str,
        places: &[([f64; 2], Anchor)],
        crossing: Crossing,
    ) {
        if text.is_empty() || self.full() {
            return;
        }
        let width = width(text);
        let covered = |([x, y], anchor): ([f64; 2], Anchor)| {
            let left = match anchor {
                Anchor::Start => x,
                Anchor::Middle => x - 0.5 * width,
                Anchor::End => x - width,
            };
            [left, y - 0.5 * LETTERS, left + width, y + 0.5 * LETTERS]
        };
        let free = |place: &&([f64; 2], Anchor)| self.is_free(covered(**place));
        let clear = |place: &&([f64; 2], Anchor)| self.crosses_nothing(covered(**place));
        let mut free: Vec<_> = places.iter().filter(free).collect();
        let best = free.iter().position(clear);
        let place = match (best, crossing) {
            (Some(best), _) => free.swap_remove(best),
            (None, Crossing::Allowed) if !free.is_empty() => free.swap_remove(0),
            (None, _) => return,
        };
        self.insert(covered(*place));
        self.written += 1;
        let ([x, y], anchor) = *place;
        let look = Look::fill(Colour::grey(0x22)).size(LETTERS).edged(Colour::WHITE);
        svg.text(look, [x, y + 0.35 * LETTERS], anchor, text);
    }

    fn crosses_nothing(&self, [left, top, right, bottom]: [f64; 4]) -> bool {
        let outside = |[x, y]: &[f64; 2]| *x < left || *x > right || *y < top || *y > bottom;
        cells([left, top, right, bottom])
            .all(|cell| self.lines.get(&cell).into_iter().flatten().all(outside))
    }

    fn is_free(&self, [left, top, right, bottom]: [f64; 4]) -> bool {
        let inside = left >= 0.0 && top >= 0.0 && right <= self.size[0] && bottom <= self.size[1];
        let apart = |other: &[f64; 4]| {
            right <= other[0] || other[2] <= left || bottom <= other[1] || other[3] <= top
        };
        inside
            && cells([left, top, right, bottom])
                .all(|cell| self.taken.get(&cell).into_iter().flatten().all(apart))
    }

    fn insert(&mut self, place: [f64; 4]) {
        for cell in cells(place) {
            self.taken.entry(cell).or_default().push(place);
        }
    }
}

/// Half the extent of a label, px, to the side and up.
pub(crate) fn half_extent(text: &str) -> [f64; 2] {
    [0.5 * width(text), 0.5 * LETTERS]
}

fn width(text: &str) -> f64 {
    LETTER * text.chars().count() as f64
}

#[expect(clippy::cast_possible_truncation, reason = "pixels of a picture")]
fn cell(point: [f64; 2]) -> [i32; 2] {
    point.map(|x| (x / CELL).floor() as i32)
}

fn cells([left, top, right, bottom]: [f64; 4]) -> impl Iterator<Item = [i32; 2]> {
    let ([first, above], [last, below]) = (cell([left, top]), cell([right, bottom]));
    (first..=last).flat_map(move |x| (above..=below).map(move |y| [x, y]))
}

/// Four digits, without an exponent where that is short.
pub(crate) fn short(x: f64) -> String {
    let text = if x.abs() >= 1e5 || (x != 0.0 && x.abs() < 1e-3) {
        format!("{x:.3e}")
    } else {
        trimmed(&format!("{x:.*}", decimals(x, 4, 6))).to_owned()
    };
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_cover_each_other_nor_leave_the_picture() {
        let mut svg = Svg::new([200.0, 100.0], "");
        let mut labels = Labels::within([200.0, 100.0]);
        labels.take([100.0, 50.0], 5.0);
        let at = |x, y| [([x, y], Anchor::Start)];
        labels.line([[0.0, 70.0], [200.0, 70.0]]);
        let mut write = |text: &str, places: &[([f64; 2], Anchor)], crossing| {
            labels.write(&mut svg, text, places, crossing);
        };
        write("covers a joint", &at(90.0, 50.0), Crossing::Allowed);
        write("first", &at(10.0, 20.0), Crossing::Never);
        write("covers the first", &at(12.0, 24.0), Crossing::Allowed);
        write("beyond the edge", &at(150.0, 20.0), Crossing::Allowed);
        let places = [([12.0, 24.0], Anchor::Start), ([10.0, 40.0], Anchor::Start)];
        write("moved", &places, Crossing::Never);
        write("covers a line", &at(10.0, 70.0), Crossing::Never);
        write("crosses", &at(10.0, 70.0), Crossing::Allowed);
        write(
            "clear",
            &[([100.0, 72.0], Anchor::Start), ([100.0, 88.0], Anchor::Start)],
            Crossing::Allowed,
        );
        let text = svg.finish();
        for wanted in ["first", "moved", "crosses"] {
            assert!(text.contains(wanted), "{wanted}");
        }
        assert!(!text.contains("covers") && !text.contains("beyond"));
        assert!(text.contains("y=\"92.20\""), "{text}");
    }

    #[test]
    fn numbers_are_short() {
        for (x, wanted) in [
            (5.0, "5"),
            (0.0, "0"),
            (-12.3456, "\u{2212}12.35"),
            (98_066.7, "98067"),
            (1.5e7, "1.500e7"),
            (2.5e-5, "2.500e\u{2212}5"),
        ] {
            assert_eq!(short(x), wanted);
        }
    }
}
