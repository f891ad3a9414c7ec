//! Blocks of a drawing: those that hold a part of the structure, in themselves or in blocks within.

use std::collections::HashMap;

use super::{Entity, WAYS};

/// Group 70 of a `BLOCK`: what is in it stands in another file.
const ELSEWHERE: u32 = 4;

#[derive(Default)]
pub(super) struct Blocks<'a> {
    open: &'a str,
    /// Whether each holds a part of the structure.
    bearing: HashMap<&'a str, bool>,
    /// The blocks that each is within.
    within: HashMap<&'a str, Vec<&'a str>>,
}

impl<'a> Blocks<'a> {
    /// Take what stands in the section of blocks.
    pub(super) fn read(&mut self, entity: &Entity<'a>) {
        let name = entity.text(2);
        match entity.kind {
            "BLOCK" => {
                self.open = name;
                let elsewhere = entity.flags().is_ok_and(|flags| flags & ELSEWHERE != 0);
                self.bearing.insert(name, elsewhere);
            }
            "INSERT" => self.within.entry(name).or_default().push(self.open),
            kind if kind == "POINT" || WAYS.contains(&kind) => {
                if let Some(bearing) = self.bearing.get_mut(self.open) {
                    *bearing = true;
                }
            }
            _ => {}
        }
    }

    /// After all of them: what holds such a block is one.
    pub(super) fn close(&mut self) {
        let bearing = self.bearing.iter().filter(|(_, bearing)| **bearing);
        let mut todo: Vec<&str> = bearing.map(|(name, _)| *name).collect();
        while let Some(inner) = todo.pop() {
            for outer in self.within.remove(inner).unwrap_or_default() {
                if self.bearing.insert(outer, true) != Some(true) {
                    todo.push(outer);
                }
            }
        }
    }

    /// Whether a block is known to hold texts and the like alone.
    pub(super) fn is_plain(&self, name: &str) -> bool {
        self.bearing.get(name) == Some(&false)
    }
}
