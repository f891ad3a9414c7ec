//! Files of other programs, right and wrong.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking; so do its helpers")]

mod answers;
mod compas;
mod drawings;
mod drawn_in_cad;
mod export;
mod forces;
mod map;
mod moordyn;
mod nets;
mod opensees;
