//! A stand-in for the simulator's tables of kinds, and damaged texts.

pub(crate) mod answers;
pub(crate) mod damage;
pub(crate) mod damaged_expressions;

use lissom_mechanics::elements::rope;
use lissom_mechanics::ports::Ports;
use lissom_mechanics::registry::{Parameter, ParameterType, optional, required};
use lissom_model::registry::{ChoiceEntry, KindEntry, Registry};

const fn kind(
    name: &'static str,
    sample: &'static str,
    ports: Ports,
    parameters: &'static [Parameter],
) -> KindEntry {
    KindEntry { name, summary: "A kind for tests.", sample, parameters, ports }
}

const fn choice(name: &'static str, parameters: &'static [Parameter]) -> ChoiceEntry {
    ChoiceEntry { name, summary: "A choice for tests.", parameters, tolerance: None }
}

const ANGLE: &[Parameter] =
    &[optional("angle", ParameterType::Number, "rad", "initial angle").or_number(0.0)];
const TURN: &[Parameter] = &[required("rotation", ParameterType::Function, "rad", "relative rotation")];
const POINT: &[Parameter] = &[
    required("stiffness", ParameterType::NotNegative, "N/m", "stiffness"),
    optional("damping", ParameterType::NotNegative, "N s/m", "damping"),
    optional("length", ParameterType::NotNegative, "m", "length without force"),
];
const TORSIONAL: &[Parameter] = &[
    required("stiffness", ParameterType::NotNegative, "N m/rad", "stiffness"),
    optional("damping", ParameterType::NotNegative, "N m s/rad", "damping"),
    optional("angle", ParameterType::Number, "rad", "angle without moment"),
];
const LOAD: &[Parameter] = &[
    required("vector", ParameterType::GlobalVector, "N or N m", "direction and size"),
    optional("scale", ParameterType::Function, "", "factor in time").or_number(1.0),
    optional("follower", ParameterType::Flag, "", "whether it turns with the node").or_flag(false),
];
const ALPHA: &[Parameter] =
    &[optional("alpha", ParameterType::Between(-1.0 / 3.0, 0.0), "", "damping").or_number(-0.3)];
const RADIUS: &[Parameter] =
    &[optional("spectral_radius", ParameterType::Between(0.0, 1.0), "", "damping").or_number(0.8)];

/// Kinds as the model files of the tests use them.
pub(crate) fn registry() -> Registry {
    let joints = vec![
        kind("clamp", "base = \"ground\"\ntip = \"a.start\"", Ports::POINT, &[]),
        kind("spherical", "base = \"ground\"\ntip = \"a.start\"", Ports::POINT, &[]),
        kind("revolute", "axis = [0, 0, 1]", Ports::AXIS, ANGLE),
        kind("universal", "axis = [0, 0, 1]\nsecond_axis = [0, 1, 0]", Ports::TWO_AXES, &[]),
        kind("rigid_link", "base = \"a.end\"\ntip = \"b.start\"", Ports::POINT, &[]),
        kind("swing_arm", "axis = [0, 0, 1]", Ports::ARM, &[]),
        kind("prescribed_rotation", "joint = \"hinge\"\nrotation = \"t\"", Ports::ROTATION, TURN),
    ];
    let springs = vec![
        kind("point", "stiffness = 1.0", Ports::TWO_LOCATIONS, POINT),
        kind("torsional", "joint = \"hinge\"\nstiffness = 1.0", Ports::ROTATION, TORSIONAL),
        kind("rope", "stiffness = 1.0", rope::KIND.ports, rope::KIND.parameters),
    ];
    let loads = vec![
        kind("force", "on = \"a.end\"\nvector = [0, 0, 1]", Ports::ONE_NODE, LOAD),
        kind("moment", "on = \"a.end\"\nvector = [0, 0, 1]", Ports::ONE_NODE, LOAD),
    ];
    let schemes = vec![choice("generalized-alpha", RADIUS), choice("hht", ALPHA), choice("radau-iia", &[])];
    let solvers = vec![choice("sparse", &[]), choice("pivoting", &[])];
    Registry { joints, springs, loads, schemes, solvers }
}
