//! DXF in ASCII: `LINE`, `LWPOLYLINE` and `POLYLINE` as members, `POINT` as anchors, `TEXT` as names of joints.
//!
//! The layer says what a line is. `$INSUNITS` says in which unit it is drawn: without one it is m. What else is in the
//! drawing is counted, curves within polylines and references to blocks with lines are refused. What is in paper space,
//! invisible or on a layer that is off or frozen is not read.
//!
//! # References
//!
//! Autodesk, "DXF Reference".

mod blocks;
mod letters;

use std::collections::HashSet;

use model::Vector;

use self::blocks::Blocks;
pub(super) use self::letters::decoded;
use crate::error::{At, Result, shortened};
use crate::system::ForeignSystem;
use crate::system::drawing::Drawing;

/// Values of `$INSUNITS`: their names and lengths, m.
const UNITS: &[(&str, &str, f64)] = &[
    ("0", "no unit: read in m", 1.0),
    ("1", "in", 0.0254),
    ("2", "ft", 0.3048),
    ("4", "mm", 1e-3),
    ("5", "cm", 1e-2),
    ("6", "m", 1.0),
    ("7", "km", 1e3),
    ("10", "yd", 0.9144),
    ("14", "dm", 0.1),
];
/// How an anchor is marked.
const MARK: &str = "mark each anchor by a POINT at the end of its line, on a layer whose name has \"anchor\" or \"support\" \
                    in it";
/// What to do about a block.
const EXPLODE: &str = "it holds lines or is not in the file: explode the blocks";
/// What a layer has in its name whose texts are names of joints.
const NAMES: &str = "name";
/// What is a member or several.
const WAYS: [&str; 3] = ["LINE", "LWPOLYLINE", "POLYLINE"];
/// Group 70 of a `LAYER`.
const FROZEN: u32 = 1;
/// Group 70 of a `POLYLINE`: closed, in space, a net or faces; of a `VERTEX`: no corner, but what bends a spline.
const CLOSED: u32 = 1;
const IN_SPACE: u32 = 8;
const SURFACE: u32 = 16 | 64;
const CONTROL: u32 = 16;

/// A value with its group code and the line of the code.
#[derive(Clone, Copy)]
struct Group<'a> {
    line: usize,
    code: i32,
    value: &'a str,
}

/// The groups of a text.
struct Groups<'a> {
    file: &'a str,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    next: Option<Group<'a>>,
}

/// What follows a group 0, until the next.
struct Entity<'a> {
    file: &'a str,
    line: usize,
    kind: &'a str,
    groups: Vec<Group<'a>>,
}

/// A `POLYLINE` whose vertices are being read, and why it is not seen.
struct Polyline<'a> {
    head: Entity<'a>,
    corners: Vec<Vector>,
    unseen: Option<&'static str>,
}

/// What was read so far.
struct Sheet<'a> {
    drawing: Drawing<'a>,
    open: Option<Polyline<'a>>,
    /// Layers that are off or frozen.
    off: HashSet<String>,
    blocks: Blocks<'a>,
    unit: (&'static str, &'static str, f64),
}

/// Read the lines of a drawing.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the line and the part that is wrong or not understood.
pub fn parse_dxf(text: &str, file: &str) -> Result<ForeignSystem> {
    if text.starts_with("AutoCAD Binary DXF") {
        let error = At::file(file).unknown("a binary DXF file");
        return Err(error.with_help("save the drawing as DXF in ASCII"));
    }
    let lines = text.strip_prefix('\u{feff}').unwrap_or(text).lines().enumerate();
    let mut groups = Groups { file, lines, next: None };
    let mut sheet = Sheet {
        drawing: Drawing::new(file),
        open: None,
        off: HashSet::new(),
        blocks: Blocks::default(),
        unit: UNITS[0],
    };
    let mut section = "";
    loop {
        let Some(entity) = groups.entity()? else {
            return Err(At::file(file).missing("end of the drawing (EOF)"));
        };
        match (section, entity.kind) {
            (_, "EOF") => break,
            (_, "SECTION") => {
                section = entity.text(2);
                if section == "HEADER" {
                    sheet.unit = entity.unit()?.unwrap_or(sheet.unit);
                }
            }
            (_, "ENDSEC") => {
                sheet.blocks.close();
                section = "";
            }
            ("TABLES", "LAYER") if entity.is_off()? => {
                sheet.off.insert(entity.text(2).to_lowercase());
            }
            ("BLOCKS", _) => sheet.blocks.read(&entity),
            ("ENTITIES", _) => entity.read(&mut sheet)?,
            _ => {}
        }
    }
    if let Some(Polyline { head, .. }) = sheet.open {
        return Err(head.at().missing("end of a polyline (SEQEND)"));
    }
    sheet.drawing.system("line", MARK, vec![format!("drawn in {}", sheet.unit.1)])
}

impl<'a> Groups<'a> {
    fn group(&mut self) -> Result<Option<Group<'a>>> {
        let Some((k, code)) = self.lines.next() else { return Ok(None) };
        let (line, text) = (k + 1, code.trim());
        let Ok(code) = text.parse() else {
            if text.is_empty() && self.lines.all(|(_, line)| line.trim().is_empty()) {
                return Ok(None);
            }
            return Err(At::line(self.file, line).value("a group code", "a whole number", text));
        };
        let Some((_, value)) = self.lines.next() else {
            return Err(At::line(self.file, line).missing(format!("value of the group {code}")));
        };
        Ok(Some(Group { line, code, value: value.trim() }))
    }

    /// A group 0 with those that follow it.
    fn entity(&mut self) -> Result<Option<Entity<'a>>> {
        /// A remark.
        const REMARK: i32 = 999;
        let mut head = self.next.take();
        while head.is_none_or(|head| head.code == REMARK) {
            head = self.group()?;
            if head.is_none() {
                return Ok(None);
            }
        }
        let Some(Group { line, code: 0, value: kind }) = head else {
            let (line, what) = (head.map(|head| head.line), "group 0 of an entity".to_owned());
            return Err(At { file: self.file, line }.missing(what));
        };
        let mut groups = vec![];
        while let Some(group) = self.group()? {
            if group.code == 0 {
                self.next = Some(group);
                break;
            }
            groups.push(group);
        }
        Ok(Some(Entity { file: self.file, line, kind, groups }))
    }
}

impl<'a> Entity<'a> {
    fn text(&self, code: i32) -> &'a str {
        self.groups.iter().find(|group| group.code == code).map_or("", |group| group.value)
    }

    fn value(&self, group: &Group<'_>) -> Result<f64> {
        let what = format!("the group {}", group.code);
        At::line(self.file, group.line + 1).number(&what, group.value)
    }

    fn number(&self, code: i32, otherwise: f64) -> Result<f64> {
        let group = self.groups.iter().find(|group| group.code == code);
        group.map_or(Ok(otherwise), |group| self.value(group))
    }

    /// Bits of group 70.
    fn flags(&self) -> Result<u32> {
        let text = Some(self.text(70)).filter(|text| !text.is_empty()).unwrap_or("0");
        text.parse().map_err(|_| self.at().value("the group 70", "a whole number", text))
    }

    fn at(&self) -> At<'a> {
        At::line(self.file, self.line)
    }

    /// The point of the groups 10, 20, 30, or 11, 21, 31, m.
    fn place(&self, number: i32, unit_m: f64) -> Result<Vector> {
        let mut at_m = [0.0; 3];
        for (k, x) in (1..).zip(&mut at_m) {
            let code = 10 * k + number;
            if k < 3 && self.groups.iter().all(|group| group.code != code) {
                let what = format!("group {code} of a {}", shortened(self.kind));
                return Err(self.at().missing(what));
            }
            *x = unit_m * self.number(code, 0.0)?;
        }
        Ok(at_m)
    }

    /// The unit of a header.
    fn unit(&self) -> Result<Option<(&'static str, &'static str, f64)>> {
        let named = |group: &Group<'_>| group.code == 9 && group.value == "$INSUNITS";
        let mut rest = self.groups.iter().skip_while(|group| !named(group)).skip(1);
        let Some(group) = rest.next() else { return Ok(None) };
        let unit = UNITS.iter().find(|(number, ..)| *number == group.value);
        unit.copied().map(Some).ok_or_else(|| {
            let error = At::line(self.file, group.line + 1)
                .unknown(format!("the unit {:?} ($INSUNITS)", shortened(group.value)));
            error.with_help("draw in m, dm, cm, mm, km, in, ft or yd")
        })
    }

    /// Whether it is a layer that is not shown.
    fn is_off(&self) -> Result<bool> {
        Ok(self.text(62).starts_with('-') || self.flags()? & FROZEN != 0)
    }

    /// Why it is not seen with the model.
    fn unseen(&self, off: &HashSet<String>) -> Option<&'static str> {
        match () {
            () if self.text(67) == "1" => Some("on paper"),
            () if self.text(60) == "1" => Some("invisible"),
            () if off.contains(&self.text(8).to_lowercase()) => Some("on layers that are off"),
            () => None,
        }
    }

    fn read(self, sheet: &mut Sheet<'a>) -> Result<()> {
        let Sheet { drawing, open, off, blocks, unit: (.., unit_m) } = sheet;
        if let Some(polyline) = open {
            return match self.kind {
                "VERTEX" => polyline.corner(&self, *unit_m),
                "SEQEND" => match open.take() {
                    Some(polyline) => polyline.read(drawing, *unit_m),
                    None => Ok(()),
                },
                _ => Err(self.at().missing("end of the polyline before it (SEQEND)")),
            };
        }
        let (layer, unit_m, unseen) = (self.text(8), *unit_m, self.unseen(off));
        match (self.kind, unseen) {
            ("POLYLINE", unseen) => *open = Some(Polyline { head: self, corners: vec![], unseen }),
            (kind, Some(why)) => drawing.skip(&format!("{} {why}", shortened(kind))),
            ("LINE", _) => {
                let ends = [self.place(0, unit_m)?, self.place(1, unit_m)?];
                drawing.line(self.line, layer, ends)?;
            }
            ("POINT", _) => drawing.point(self.line, layer, self.place(0, unit_m)?)?,
            ("TEXT", _) if layer.to_lowercase().contains(NAMES) => {
                drawing.name(self.place(0, unit_m)?, letters::unescaped(self.text(1)));
            }
            ("LWPOLYLINE", _) => {
                let corners = self.corners(unit_m)?;
                drawing.way(self.line, layer, &corners, self.flags()? & CLOSED != 0)?;
            }
            ("INSERT", _) if !blocks.is_plain(self.text(2)) => {
                let what = format!("the block {:?}", shortened(self.text(2)));
                return Err(self.at().unknown(what).with_help(EXPLODE));
            }
            (kind, _) => drawing.skip(&shortened(kind)),
        }
        Ok(())
    }

    /// The corners of a polyline in a level plane, m.
    fn corners(&self, unit_m: f64) -> Result<Vec<Vector>> {
        self.level()?;
        self.straight()?;
        let z = unit_m * self.number(38, 0.0)?;
        let mut corners: Vec<Vector> = vec![];
        for group in &self.groups {
            match (group.code, corners.last_mut()) {
                (10, _) => corners.push([unit_m * self.value(group)?, 0.0, z]),
                (20, Some(last)) => last[1] = unit_m * self.value(group)?,
                _ => {}
            }
        }
        Ok(corners)
    }

    /// Refuse arcs between the corners of a polyline.
    fn straight(&self) -> Result<()> {
        let bulges = self.groups.iter().filter(|group| group.code == 42);
        for group in bulges {
            if self.value(group)?.abs() > 0.0 {
                let at = At::line(self.file, group.line);
                return Err(at.out_of_scope("an arc of a polyline (group 42)"));
            }
        }
        Ok(())
    }

    /// Refuse a plane of its own.
    fn level(&self) -> Result<()> {
        let normal = [self.number(210, 0.0)?, self.number(220, 0.0)?, self.number(230, 1.0)?];
        if normal[0].abs() + normal[1].abs() > 0.0 || normal[2] <= 0.0 {
            let what = "a polyline in a plane of its own (groups 210 to 230)";
            return Err(self.at().unknown(what).with_help("draw it in 3D"));
        }
        Ok(())
    }
}

impl<'a> Polyline<'a> {
    fn corner(&mut self, vertex: &Entity<'a>, unit_m: f64) -> Result<()> {
        if self.unseen.is_none() {
            vertex.straight()?;
            if vertex.flags()? & CONTROL == 0 {
                self.corners.push(vertex.place(0, unit_m)?);
            }
        }
        Ok(())
    }

    fn read(self, drawing: &mut Drawing<'a>, unit_m: f64) -> Result<()> {
        let Self { head, mut corners, unseen } = self;
        if let Some(why) = unseen {
            drawing.skip(&format!("POLYLINE {why}"));
            return Ok(());
        }
        let flags = head.flags()?;
        if flags & SURFACE != 0 {
            drawing.skip("POLYLINE of faces");
            return Ok(());
        }
        if flags & IN_SPACE == 0 {
            head.level()?;
            let z = unit_m * head.number(30, 0.0)?;
            for at_m in &mut corners {
                at_m[2] = z;
            }
        }
        drawing.way(head.line, head.text(8), &corners, flags & CLOSED != 0)
    }
}
