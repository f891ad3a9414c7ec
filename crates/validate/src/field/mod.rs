//! The field, judged: published numbers of cables and nets, each with its source and a verdict that
//! follows from numbers computed here.
//!
//! | file | what |
//! |---|---|
//! | [`elastic_catenary`] | the heavy elastic cable in closed form |
//! | [`run_of_members`] | the same cable as a run of elastic members, by both solvers |
//! | [`cables`], [`nets`], [`chains`] | what is published, against these |
//! | [`record`] | all of it |

pub mod cables;
pub mod chains;
pub mod elastic_catenary;
pub mod entry;
pub mod nets;
pub mod record;
pub mod run_of_members;
