//! Springs, stops, bushings and ropes.

mod force_laws;
mod forces_on_tips;
mod ropes;
mod sheaves;
mod stops_and_bushings;
mod tyres;
