// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Kind of analysis and its settings.

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
    /// How contacts of shapes are solved: as `elements` with events, or as one `set`, all touches of a step at once; default: that of the scheme.
    contacts: words::Contacts = "contacts";
    /// Time step; with `relative_tolerance` the first step \[s\].
    step: f64 = "step";
    /// Tolerance of the local error of adaptive steps, relative to the motion, if `step` is omitted; default 1e-6.
    relative_tolerance: f64 = "relative_tolerance";
    /// Errors that determine adaptive steps: those of `positions` (and velocities and states), or those of `forces` (and accelerations), too; default `"positions"`.
    control: words::Control = "control";
    /// Maximum adaptive step, default a twentieth of the whole time \[s\].
    max_step: f64 = "max_step";
    /// Interval between records of adaptive steps, interpolated within them; by default steps are sampled, up to 5000 times in all \[s\].
    output_step: f64 = "output_step";
    /// Whether a spurious increase of energy is a failure; default `true`.
    energy_check: bool = "energy_check";
    /// Spectral radius at infinite frequency; default 0.8.
    spectral_radius: f64 = "spectral_radius";
    /// Numerical damping; default -0.1.
    alpha: f64 = "alpha";
}

entry! {
    /// Equilibrium in load steps.
    Statics => AnalysisId, "statics";
    ["kind" = "statics"]
    /// With what must be given.
    new()
    /// Last time; default 1 \[s\].
    end: f64 = "end";
    /// Number of load steps; default: adaptive, by contraction and error.
    steps: usize = "steps";
    /// Tolerance of the relative work error of adaptive load steps; default 0.01.
    relative_tolerance: f64 = "relative_tolerance";
    /// Whether gravity and constant loads are ramped from zero over the load steps; default `true`.
    ramp: bool = "ramp";
}

entry! {
    /// Equilibrium path under loads times a load factor, or along a number of the model, through limit points, by arc length.
    Path => AnalysisId, "path";
    ["kind" = "path"]
    /// With what must be given.
    new()
    /// Load factor at which the path ends; with `vary` the value at which it ends, which is required then; default 1.
    end: f64 = "end";
    /// First step of the load factor or of the number, default a fiftieth of the range.
    step: f64 = "step";
    /// Maximum number of steps; default 1000.
    steps: usize = "steps";
    /// Number of the model file that is varied from its value there, such as `parameters.height`; default: the load factor.
    vary: String = "vary";
    /// Number of the bifurcation at which the path continues on the branch, from 1; negative for the opposite direction of the branch, zero for none; default 0.
    branch: f64 = "branch";
}

entry! {
    /// Buckling load factors, by a linear estimate.
    Buckling => AnalysisId, "buckling";
    ["kind" = "buckling"]
    /// With what must be given.
    new()
    /// Number of load factors; default 5.
    count: usize = "count";
}

entry! {
    /// Natural modes about a state at rest.
    Modes => AnalysisId, "modes";
    ["kind" = "modes"]
    /// With what must be given.
    new()
    /// Number of modes; default 20.
    count: usize = "count";
    /// Static equilibrium under the loads at the time `start`, or the undeformed state without loads and gravity; default `"static"`.
    about: words::About = "about";
    /// Frequency near which modes are computed; default: the lowest ones \[Hz\].
    shift: f64 = "shift";
}

keys! {
    [Dynamics, Statics, Modes]
    /// First time; default 0 \[s\].
    start: f64 = "start";
}

keys! {
    [Dynamics, Statics, Path, Buckling, Modes]
    /// Scale of the equations; default `"physical"`.
    scaling: words::Scaling = "scaling";
    /// Equilibration of rows and columns of the scaled tangent; default `true`.
    equilibrated: bool = "equilibrated";
    /// With the augmented Lagrangian term; default `true`.
    augmented: bool = "augmented";
    /// Factor of the augmented term; default 1e-3.
    penalty: f64 = "penalty";
    /// Linear solver.
    solver: words::Solver = "solver";
    /// Tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of `relative_tolerance`, or that of the scheme; default 1e-8.
    tolerance: f64 = "tolerance";
    /// Maximum number of Newton iterations; default 40.
    max_iterations: usize = "max_iterations";
    /// Optional features of the nonlinear solver to be disabled, for studies; default none.
    without: Vec<words::Without> = "without";
}

keys! {
    [Dynamics, Statics]
    /// Number of steps between records; default: every step, or several records in each adaptive step.
    output_every: usize = "output_every";
    /// Frames of the recorded motion per simulated second; default at most 600 over the run \[1/s\].
    frames_per_second: f64 = "frames_per_second";
    /// Part of the records from which statistics are computed, such as "after=0.5", "last=0.2" or "after=impact"; default all.
    statistics_window: String = "statistics_window";
}

keys! {
    [Path, Buckling]
    /// Instant at which loads and drives are evaluated; default 1 \[s\].
    start: f64 = "start";
}
