//! Equilibrium paths, branches and buckling.

mod branches;
mod buckling;
mod load_factor;
mod parameter;
