//! The motion of systems of bars against closed forms, series and laws.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod cable;
mod common;
mod elliptic;
mod enclosed;
mod energy;
mod folded;
mod forced;
mod four_bars;
mod held;
mod impacts;
mod laws;
mod lowest;
mod modes;
mod natural;
mod order;
mod paper;
mod pendulum;
mod positions;
mod refused;
mod ropes;
mod scale;
mod second_opinion;
mod slack;
mod spinning;
mod squeezer;
mod unequal;
