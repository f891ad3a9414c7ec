//! JSON with a line for each item of a list.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

/// Down to this depth each value has a line of its own: the keys of the object, and the items of
/// its arrays.
const OWN_LINE: usize = 2;

/// Write an object, a line for each key and for each item of an array.
pub(super) fn write(to: &mut impl Write, object: &impl Serialize) -> io::Result<()> {
    object.serialize(&mut Serializer::with_formatter(&mut *to, Lines::default()))?;
    to.write_all(b"\n")
}

#[derive(Debug, Default)]
struct Lines {
    depth: usize,
    empty: bool,
}

impl Lines {
    fn open(&mut self, to: &mut (impl Write + ?Sized), bracket: &[u8]) -> io::Result<()> {
        self.depth += 1;
        self.empty = true;
        to.write_all(bracket)
    }

    fn next(&mut self, to: &mut (impl Write + ?Sized), first: bool) -> io::Result<()> {
        self.empty = false;
        let own_line = self.depth <= OWN_LINE;
        to.write_all(match (first, own_line) {
            (true, _) => b"",
            (false, true) => b",",
            (false, false) => b", ",
        })?;
        if own_line { self.new_line(to) } else { Ok(()) }
    }

    fn close(&mut self, to: &mut (impl Write + ?Sized), bracket: &[u8]) -> io::Result<()> {
        self.depth -= 1;
        if self.depth < OWN_LINE && !self.empty {
            self.new_line(to)?;
        }
        self.empty = false;
        to.write_all(bracket)
    }

    fn new_line(&self, to: &mut (impl Write + ?Sized)) -> io::Result<()> {
        to.write_all(b"\n")?;
        (0..self.depth).try_for_each(|_| to.write_all(b"  "))
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.open(to, b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.close(to, b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        self.next(to, first)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.open(to, b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.close(to, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        self.next(to, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        to.write_all(b": ")
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    #[test]
    fn each_item_has_a_line() {
        let mut text = vec![];
        let object = json!({ "a": [{ "b": [1, 2], "c": {} }, { "b": [] }], "d": 3, "e": [] });
        super::write(&mut text, &object).unwrap();
        let lines = "{\n  \"a\": [\n    {\"b\": [1, 2], \"c\": {}},\n    {\"b\": []}\n  ],\n  \
                     \"d\": 3,\n  \"e\": []\n}\n";
        assert_eq!(String::from_utf8(text).unwrap(), lines);
    }
}
