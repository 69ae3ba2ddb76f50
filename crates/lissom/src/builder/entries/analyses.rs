// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! What is computed, and how.

use super::words;
use crate::builder::entry::{entry, keys};

entry! {
    /// Motion in time.
    Dynamics => AnalysisId, "dynamics";
    ["kind" = "dynamics"]
    /// With what must be given.
    ///
    /// - `end`: last time \[s\]
    new(end: f64 = "end")
    /// Time integration scheme.
    scheme: words::Scheme = "scheme";
    /// Time step; with `relative_tolerance` the first one \[s\].
    step: f64 = "step";
    /// Error allowed per step, relative to the motion: steps are chosen to keep it; default 1e-5 without `step`.
    relative_tolerance: f64 = "relative_tolerance";
    /// Longest step that is chosen, default a twentieth of the whole \[s\].
    max_step: f64 = "max_step";
    /// Time from record to record where steps are chosen; default every step \[s\].
    output_step: f64 = "output_step";
    /// Whether a run with much more energy than anything put in fails, default true.
    energy_check: bool = "energy_check";
    /// Spectral radius at infinite frequency, 0 … 1; default 0.8.
    spectral_radius: f64 = "spectral_radius";
    /// Numerical damping, -1/3 … 0; default -0.1.
    alpha: f64 = "alpha";
}

entry! {
    /// Equilibrium in load steps.
    Statics => AnalysisId, "statics";
    ["kind" = "statics"]
    /// With what must be given.
    new()
    /// Last time, default 1 \[s\].
    end: f64 = "end";
    /// Number of load steps; without it they are chosen by contraction and error.
    steps: usize = "steps";
    /// Part of its work that a load step of chosen size may leave unexplained, default 0.01.
    relative_tolerance: f64 = "relative_tolerance";
    /// Whether gravity and loads that are constant grow from nothing over the load steps, default true.
    ramp: bool = "ramp";
}

entry! {
    /// Equilibria under loads times a load factor, or along a number of the model, through limit points, by arc length.
    Path => AnalysisId, "path";
    ["kind" = "path"]
    /// With what must be given.
    new()
    /// Load factor at which the path ends, default 1; with `vary` the value at which it ends, which must be given.
    end: f64 = "end";
    /// First step of the load factor or of the number, default a fiftieth of the way to `end`.
    step: f64 = "step";
    /// Most steps, default 1000.
    steps: usize = "steps";
    /// Number of the model file along which the path goes, such as `parameters.height`, from the value that it has there; default: the load factor.
    vary: String = "vary";
    /// Bifurcation at which the path goes over to its branch, counted from 1; negative for the other sense of the branch; default 0, none.
    branch: f64 = "branch";
}

entry! {
    /// Load factors of buckling, by a linear estimate.
    Buckling => AnalysisId, "buckling";
    ["kind" = "buckling"]
    /// With what must be given.
    new()
    /// Number of load factors, default 5.
    count: usize = "count";
}

entry! {
    /// Natural modes about a state at rest.
    Modes => AnalysisId, "modes";
    ["kind" = "modes"]
    /// With what must be given.
    new()
    /// Number of modes, default 20.
    count: usize = "count";
    /// About static equilibrium under the loads of the time `start` (default), or about the positions of the file without loads and gravity.
    about: words::About = "about";
    /// Frequency near which modes are sought; default: the lowest ones \[Hz\].
    shift: f64 = "shift";
}

keys! {
    [Dynamics, Statics, Path, Buckling, Modes]
    /// First time, default 0 \[s\].
    start: f64 = "start";
    /// Scale of the equations, default physical.
    scaling: words::Scaling = "scaling";
    /// Rows and columns of the scaled tangent brought to one size, default true.
    equilibrated: bool = "equilibrated";
    /// With the augmented Lagrangian term, default true.
    augmented: bool = "augmented";
    /// Factor of the augmented term, default 1e-3.
    penalty: f64 = "penalty";
    /// Linear solver.
    solver: words::Solver = "solver";
    /// Of Newton's iteration, in scaled units, default 1e-8; with chosen steps `relative_tolerance`/100; 1e-12 for `energy-decaying`.
    tolerance: f64 = "tolerance";
    /// Of Newton's iteration, default 40.
    max_iterations: usize = "max_iterations";
    /// Optional features of the nonlinear solver to be switched off, for studies; default none.
    without: Vec<words::Without> = "without";
}

keys! {
    [Dynamics, Statics]
    /// Steps from record to record, default 1.
    output_every: usize = "output_every";
    /// Of the motion that `lissom view` shows, per simulated second; default at most 600 over the run \[1/s\].
    frames_per_second: f64 = "frames_per_second";
}
