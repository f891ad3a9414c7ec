//! Files of other programs, right and wrong.

mod answers;
mod compas;
mod moordyn;
mod nets;
