// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Kind of analysis and its settings.

use super::words;
use crate::builder::entry::{entries, keys};

entries! {
    /// Motion in time.
    Dynamics => AnalysisId, kind: "dynamics" {
        * end: f64 = "end", "last time \\[s\\]";
        scheme: words::Scheme = "scheme", "Time integration scheme.";
        contacts: words::Contacts = "contacts", "How contacts of shapes are solved: as `elements` with events, or as one `set`, all touches of a step at once; default: that of the scheme.";
        step: f64 = "step", "Time step; with `relative_tolerance` the first step \\[s\\].";
        relative_tolerance: f64 = "relative_tolerance", "Tolerance of the local error of adaptive steps, relative to the motion, if `step` is omitted; default 1e-6.";
        control: words::Control = "control", "Errors that determine adaptive steps: those of `positions` (and velocities and states), or those of `forces` (and accelerations), too; default `\"positions\"`.";
        max_step: f64 = "max_step", "Maximum adaptive step, default a twentieth of the whole time \\[s\\].";
        output_step: f64 = "output_step", "Interval between records of adaptive steps, interpolated within them; by default steps are sampled, up to 5000 times in all \\[s\\].";
        energy_check: bool = "energy_check", "Whether a spurious increase of energy is a failure; default `true`.";
        spectral_radius: f64 = "spectral_radius", "Spectral radius at infinite frequency; default 0.8.";
        alpha: f64 = "alpha", "Numerical damping; default -0.1.";
    }

    /// Equilibrium in load steps.
    Statics => AnalysisId, kind: "statics" {
        end: f64 = "end", "Last time; default 1 \\[s\\].";
        steps: usize = "steps", "Number of load steps; default: adaptive, by contraction and error.";
        relative_tolerance: f64 = "relative_tolerance", "Tolerance of the relative work error of adaptive load steps; default 0.01.";
        ramp: bool = "ramp", "Whether gravity and constant loads are ramped from zero over the load steps; default `true`.";
    }

    /// Equilibrium path under loads times a load factor, or along a number of the model, through limit points, by arc length.
    Path => AnalysisId, kind: "path" {
        end: f64 = "end", "Load factor at which the path ends; with `vary` the value at which it ends, which is required then; default 1.";
        step: f64 = "step", "First step of the load factor or of the number, default a fiftieth of the range.";
        steps: usize = "steps", "Maximum number of steps; default 1000.";
        vary: String = "vary", "Number of the model file that is varied from its value there, such as `parameters.height`; default: the load factor.";
        branch: f64 = "branch", "Number of the bifurcation at which the path continues on the branch, from 1; negative for the opposite direction of the branch, zero for none; default 0.";
    }

    /// Buckling load factors, by a linear estimate.
    Buckling => AnalysisId, kind: "buckling" {
        count: usize = "count", "Number of load factors; default 5.";
    }

    /// Natural modes about a state at rest.
    Modes => AnalysisId, kind: "modes" {
        count: usize = "count", "Number of modes; default 20.";
        about: words::About = "about", "Static equilibrium under the loads at the time `start`, or the undeformed state without loads and gravity; default `\"static\"`.";
        shift: f64 = "shift", "Frequency near which modes are computed; default: the lowest ones \\[Hz\\].";
    }
}

keys! {
    [Dynamics, Statics, Modes]
        start: f64 = "start", "First time; default 0 \\[s\\].";
}

keys! {
    [Dynamics, Statics, Path, Buckling, Modes]
        scaling: words::Scaling = "scaling", "Scale of the equations; default `\"physical\"`.";
        equilibrated: bool = "equilibrated", "Equilibration of rows and columns of the scaled tangent; default `true`.";
        augmented: bool = "augmented", "With the augmented Lagrangian term; default `true`.";
        penalty: f64 = "penalty", "Factor of the augmented term; default 1e-3.";
        solver: words::Solver = "solver", "Linear solver.";
        tolerance: f64 = "tolerance", "Tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of `relative_tolerance`, or that of the scheme; default 1e-8.";
        max_iterations: usize = "max_iterations", "Maximum number of Newton iterations; default 40.";
        without: Vec<words::Without> = "without", "Optional features of the nonlinear solver to be disabled, for studies; default none.";
}

keys! {
    [Dynamics, Statics]
        output_every: usize = "output_every", "Number of steps between records; default: every step, or several records in each adaptive step.";
        frames_per_second: f64 = "frames_per_second", "Frames of the recorded motion per simulated second; default at most 600 over the run \\[1/s\\].";
        statistics_window: String = "statistics_window", "Part of the records from which statistics are computed, such as \"after=0.5\", \"last=0.2\" or \"after=impact\"; default all.";
}

keys! {
    [Path, Buckling]
        start: f64 = "start", "Instant at which loads and drives are evaluated; default 1 \\[s\\].";
}
