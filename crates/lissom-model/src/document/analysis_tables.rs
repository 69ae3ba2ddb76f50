//! The keys of `[analysis]`, by kind of analysis.

use lissom_system::solver_features::WORDS;

use super::analysis::{
    CONTACTS, DEFAULT_BUCKLING_COUNT, DEFAULT_MODE_COUNT, DEFAULT_RELATIVE_TOLERANCE, DEFAULT_TOLERANCE,
    FORCES,
};
use crate::format::keys::{Key, Shape, choice, of_parameter, optional, required, unitless};
use crate::format::top_level::Variant;
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
            optional("start", Shape::Number, "s", "first time").or_number(0.0),
            unitless(
                "scaling",
                choice(&["physical", "unit", "none"]),
                "scale of the equations",
            )
            .or_word("physical"),
            unitless(
                "equilibrated",
                Shape::Flag,
                "equilibration of rows and columns of the scaled tangent",
            ).or_flag(true),
            unitless("augmented", Shape::Flag, "with the augmented Lagrangian term").or_flag(true),
            unitless("penalty", Shape::NotNegative, "factor of the augmented term").or_number(1e-3),
            unitless("solver", words(&registry.solvers), "linear solver"),
            unitless(
                "tolerance",
                Shape::Positive,
                "tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of \
                 `relative_tolerance`, or that of the scheme",
            )
            .or_number(DEFAULT_TOLERANCE),
            unitless(
                "max_iterations",
                Shape::Count(1, 10_000),
                "maximum number of Newton iterations",
            ).or_count(40),
            unitless(
                "without",
                Shape::Choices(&WORDS),
                "optional features of the nonlinear solver to be disabled, for studies; default none",
            ),
            unitless(
                "output_every",
                Shape::Count(1, 1_000_000_000),
                "number of steps between records; default: every step, or several records in each adaptive step",
            ),
            optional(
                "frames_per_second",
                Shape::Positive,
                "1/s",
                "frames of the recorded motion per simulated second; default at most 600 over the run",
            ),
            unitless(
                "statistics_window",
                Shape::Text,
                "part of the records from which statistics are computed, such as \"after=0.5\", \"last=0.2\" or \"after=impact\"; default all",
            ),
        ]
    };
    let mut variants = vec![
        Variant { word: "dynamics", summary: "Motion in time.", keys: motion(common(), registry) },
        Variant { word: "statics", summary: "Equilibrium in load steps.", keys: load_steps(common()) },
    ];
    variants.extend(analyses_without_records(common()));
    variants
}

/// Keys of motions in time, with those that all runs have.
fn motion(mut dynamics: Vec<Key>, registry: &Registry) -> Vec<Key> {
    let words = registry.schemes.iter().map(|entry| entry.name).collect();
    dynamics.push(unitless("scheme", Shape::Choice(words), "time integration scheme"));
    dynamics.push(unitless(
        "contacts",
        Shape::Choice(CONTACTS.into()),
        "how contacts of shapes are solved: as `elements` with events, or as one `set`, all touches of a step at once; default: that of \
         the scheme",
    ));
    dynamics.push(required("end", Shape::Number, "s", "last time"));
    dynamics.extend([
        optional("step", Shape::Positive, "s", "time step; with `relative_tolerance` the first step"),
        unitless(
            "relative_tolerance",
            Shape::Between(1e-12, 0.1),
            "tolerance of the local error of adaptive steps, relative to the motion, if `step` is omitted",
        )
        .or_number(DEFAULT_RELATIVE_TOLERANCE),
        unitless(
            "control",
            choice(&["positions", FORCES]),
            "errors that determine adaptive steps: those of `positions` (and velocities and states), or those of `forces` (and accelerations), too",
        )
        .or_word("positions"),
        optional("max_step", Shape::Positive, "s", "maximum adaptive step, default a twentieth of the whole time"),
        optional(
            "output_step",
            Shape::Positive,
            "s",
            "interval between records of adaptive steps, interpolated within them; by default steps are sampled, up to 5000 times in all",
        ),
    ]);
    dynamics.push(
        unitless("energy_check", Shape::Flag, "whether a spurious increase of energy is a failure")
            .or_flag(true),
    );
    for parameter in registry.schemes.iter().flat_map(|scheme| scheme.parameters) {
        if !dynamics.iter().any(|key| key.name == parameter.name) {
            let mut key = of_parameter(parameter);
            key.required = false;
            dynamics.push(key);
        }
    }
    dynamics
}

/// Keys of load steps, with those that all runs have.
fn load_steps(mut statics: Vec<Key>) -> Vec<Key> {
    statics.push(optional("end", Shape::Number, "s", "last time").or_number(1.0));
    statics.push(unitless(
        "steps",
        Shape::Count(1, 1_000_000),
        "number of load steps; default: adaptive, by contraction and error",
    ));
    statics.push(
        unitless(
            "relative_tolerance",
            Shape::Positive,
            "tolerance of the relative work error of adaptive load steps",
        )
        .or_number(0.01),
    );
    statics.push(
        unitless(
            "ramp",
            Shape::Flag,
            "whether gravity and constant loads are ramped from zero over the load steps",
        )
        .or_flag(true),
    );
    statics
}

/// Analyses that record nothing over time.
fn analyses_without_records(mut common: Vec<Key>) -> Vec<Variant> {
    common.retain(|key| !matches!(key.name, "output_every" | "frames_per_second" | "statistics_window"));
    // Loads that grow from zero to one second, as in statics, have their full size.
    let mut under_loads = common.clone();
    for key in under_loads.iter_mut().filter(|key| key.name == "start") {
        *key = optional("start", Shape::Number, "s", "instant at which loads and drives are evaluated")
            .or_number(1.0);
    }
    let mut path = under_loads.clone();
    path.extend([
        unitless("end", Shape::Number, "load factor at which the path ends; with `vary` the value at which it ends, which is required then").or_number(1.0),
        unitless("step", Shape::Positive, "first step of the load factor or of the number, default a fiftieth of the range"),
        unitless("steps", Shape::Count(1, 1_000_000), "maximum number of steps").or_count(1000),
        unitless("vary", Shape::Text, "number of the model file that is varied from its value there, such as `parameters.height`; default: the load factor"),
        unitless("branch", Shape::Between(-1000.0, 1000.0), "number of the bifurcation at which the path continues on the branch, from 1; negative for the opposite direction of the branch, zero for none").or_number(0.0),
    ]);
    let mut buckling = under_loads;
    buckling.push(
        unitless("count", Shape::Count(1, 10_000), "number of load factors").or_count(DEFAULT_BUCKLING_COUNT),
    );
    let mut modes = common;
    modes.extend([
        unitless("count", Shape::Count(1, 100_000), "number of modes").or_count(DEFAULT_MODE_COUNT),
        unitless(
            "about",
            choice(&["static", "undeformed"]),
            "static equilibrium under the loads at the time `start`, or the undeformed state without loads and gravity",
        )
        .or_word("static"),
        optional("shift", Shape::NotNegative, "Hz", "frequency near which modes are computed; default: the lowest ones"),
    ]);
    vec![
        Variant {
            word: "path",
            summary: "Equilibrium path under loads times a load factor, or along a number of the model, through limit points, by arc length.",
            keys: path,
        },
        Variant { word: "buckling", summary: "Buckling load factors, by a linear estimate.", keys: buckling },
        Variant { word: "modes", summary: "Natural modes about a state at rest.", keys: modes },
    ]
}
