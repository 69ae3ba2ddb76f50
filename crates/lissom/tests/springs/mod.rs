//! Springs, stops, bushings and ropes.

mod force_laws;
mod ropes;
mod stops_and_bushings;
