//! The keys of `[analysis]`, by kind of analysis.

use lissom_core::solver_features::WORDS;

use super::tables::Variant;
use crate::keys::{Key, Shape, choice, of_parameter, optional, required};
use crate::registry::{ChoiceEntry, Registry};

/// The forms of `[analysis]`, by kind.
pub(super) fn analyses(registry: &Registry) -> Vec<Variant> {
    let words = |table: &[ChoiceEntry]| Shape::Choice(table.iter().map(|entry| entry.name).collect());
    let common = || {
        vec![
            required(
                "kind",
                choice(&["dynamics", "statics", "modes", "path", "buckling"]),
                "",
                "what is computed",
            ),
            optional("start", Shape::Number, "s", "first time, default 0"),
            optional(
                "scaling",
                choice(&["physical", "unit", "none"]),
                "",
                "scale of the equations, default physical",
            ),
            optional(
                "equilibrated",
                Shape::Flag,
                "",
                "rows and columns of the scaled tangent brought to one size, default true",
            ),
            optional("augmented", Shape::Flag, "", "with the augmented Lagrangian term, default true"),
            optional("penalty", Shape::NotNegative, "", "factor of the augmented term, default 1e-3"),
            optional("solver", words(&registry.solvers), "", "linear solver"),
            optional(
                "tolerance",
                Shape::Positive,
                "",
                "of Newton's iteration, in scaled units, default 1e-8; with chosen steps `relative_tolerance`/100; 1e-12 for `energy-decaying`",
            ),
            optional("max_iterations", Shape::Count(1, 10_000), "", "of Newton's iteration, default 40"),
            optional(
                "without",
                Shape::Choices(&WORDS),
                "",
                "optional features of the nonlinear solver to be switched off, for studies; default none",
            ),
            optional(
                "output_every",
                Shape::Count(1, 1_000_000_000),
                "",
                "steps from record to record, default 1",
            ),
            optional(
                "frames_per_second",
                Shape::Positive,
                "1/s",
                "of the motion that `lissom view` shows, per simulated second; default at most 600 over the run",
            ),
        ]
    };
    let mut dynamics = common();
    dynamics.push(optional("scheme", words(&registry.schemes), "", "time integration scheme"));
    dynamics.push(required("end", Shape::Number, "s", "last time"));
    dynamics.extend([
        optional("step", Shape::Positive, "s", "time step; with `relative_tolerance` the first one"),
        optional(
            "relative_tolerance",
            Shape::Between(1e-12, 0.1),
            "",
            "error allowed per step, relative to the motion: steps are chosen to keep it; default 1e-5 without `step`",
        ),
        optional("max_step", Shape::Positive, "s", "longest step that is chosen, default a twentieth of the whole"),
        optional(
            "output_step",
            Shape::Positive,
            "s",
            "time from record to record where steps are chosen; default every step",
        ),
    ]);
    dynamics.push(optional(
        "energy_check",
        Shape::Flag,
        "",
        "whether a run with much more energy than anything put in fails, default true",
    ));
    for parameter in registry.schemes.iter().flat_map(|scheme| scheme.parameters) {
        if !dynamics.iter().any(|key| key.name == parameter.name) {
            let mut key = of_parameter(parameter);
            key.required = false;
            key.holds = super::analysis::range_of(parameter.name).unwrap_or(key.holds);
            dynamics.push(key);
        }
    }
    let mut variants = vec![
        Variant { word: "dynamics", summary: "Motion in time.", keys: dynamics },
        Variant { word: "statics", summary: "Equilibrium in load steps.", keys: load_steps(common()) },
    ];
    variants.extend(analyses_without_records(common()));
    variants
}

/// Keys of load steps, with those that all runs have.
fn load_steps(mut statics: Vec<Key>) -> Vec<Key> {
    statics.push(optional("end", Shape::Number, "s", "last time, default 1"));
    statics.push(optional(
        "steps",
        Shape::Count(1, 1_000_000),
        "",
        "number of load steps; without it they are chosen by contraction and error",
    ));
    statics.push(optional(
        "relative_tolerance",
        Shape::Positive,
        "",
        "part of its work that a load step of chosen size may leave unexplained, default 0.01",
    ));
    statics.push(optional(
        "ramp",
        Shape::Flag,
        "",
        "whether gravity and loads that are constant grow from nothing over the load steps, default true",
    ));
    statics
}

/// Analyses that record nothing over time.
fn analyses_without_records(mut common: Vec<Key>) -> Vec<Variant> {
    common.retain(|key| !matches!(key.name, "output_every" | "frames_per_second"));
    let mut path = common.clone();
    path.extend([
        optional("end", Shape::Number, "", "load factor at which the path ends, default 1; with `vary` the value at which it ends, which must be given"),
        optional("step", Shape::Positive, "", "first step of the load factor or of the number, default a fiftieth of the way to `end`"),
        optional("steps", Shape::Count(1, 1_000_000), "", "most steps, default 1000"),
        optional("vary", Shape::Text, "", "number of the model file along which the path goes, such as `parameters.height`, from the value that it has there; default: the load factor"),
        optional("branch", Shape::Between(-1000.0, 1000.0), "", "bifurcation at which the path goes over to its branch, counted from 1; negative for the other sense of the branch; default 0, none"),
    ]);
    let mut buckling = common.clone();
    buckling.push(optional("count", Shape::Count(1, 10_000), "", "number of load factors, default 5"));
    let mut modes = common;
    modes.extend([
        optional("count", Shape::Count(1, 100_000), "", "number of modes, default 20"),
        optional(
            "about",
            choice(&["static", "undeformed"]),
            "",
            "about static equilibrium under the loads of the time `start` (default), or about the positions of the file \
             without loads and gravity",
        ),
        optional("shift", Shape::NotNegative, "Hz", "frequency near which modes are sought; default: the lowest ones"),
    ]);
    vec![
        Variant {
            word: "path",
            summary: "Equilibria under loads times a load factor, or along a number of the model, through limit points, by arc length.",
            keys: path,
        },
        Variant {
            word: "buckling",
            summary: "Load factors of buckling, by a linear estimate.",
            keys: buckling,
        },
        Variant { word: "modes", summary: "Natural modes about a state at rest.", keys: modes },
    ]
}
