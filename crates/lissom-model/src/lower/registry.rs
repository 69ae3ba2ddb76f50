//! The core's tables of joints, springs, loads, schemes and solvers, in the words of the model file.

use lissom_core::elements::{Attachment, ElementKind, LOADS, SPRINGS};
use lissom_core::joints::{self, Build, Coupled, Frames, JointKind};
use lissom_core::registry::{Parameter, ParameterType};
use lissom_core::schemes;

use crate::registry::{ActsOn, ChoiceEntry, FrameRule, KindEntry, Registry};

const ALPHA: Parameter =
    Parameter::optional("alpha", ParameterType::Number, "", "Numerical damping, -1/3 … 0; default -0.1.");
const SPECTRAL_RADIUS: Parameter = Parameter::optional(
    "spectral_radius",
    ParameterType::Number,
    "",
    "Spectral radius at infinite frequency, 0 … 1; default 0.8.",
);

const DECAY: Parameter = Parameter::optional(
    "spectral_radius",
    ParameterType::Number,
    "",
    "Spectral radius at infinite frequency: 1 preserves energy, 0 (default) annihilates.",
);

/// The registry of all kinds of the core.
pub fn registry() -> Registry {
    Registry {
        joints: joints::KINDS.iter().map(joint).collect(),
        springs: SPRINGS.iter().map(element).collect(),
        loads: LOADS.iter().map(element).collect(),
        schemes: schemes::KINDS
            .iter()
            .map(|kind| ChoiceEntry {
                name: kind.name,
                summary: kind.summary,
                parameters: match kind.name {
                    "hht" => &[ALPHA],
                    "energy-decaying" => &[DECAY],
                    "generalized-alpha" => &[SPECTRAL_RADIUS],
                    _ => &[],
                },
                tolerance: kind.tolerance,
            })
            .collect(),
        solvers: lissom_core::solvers::KINDS
            .iter()
            .map(|kind| ChoiceEntry {
                name: kind.name,
                summary: kind.summary,
                parameters: &[],
                tolerance: None,
            })
            .collect(),
    }
}

fn joint(kind: &JointKind) -> KindEntry {
    let acts_on = match kind.build {
        Build::Relative(Frames::Point, _) => ActsOn::TwoNodes(FrameRule::None),
        Build::Relative(Frames::Axis | Frames::SpanWithAxis, _) => ActsOn::TwoNodes(FrameRule::Axis),
        Build::Relative(Frames::TwoAxes, _) => ActsOn::TwoNodes(FrameRule::TwoAxes),
        Build::Relative(Frames::GivenOrGlobalAxes, _) | Build::Motion => {
            ActsOn::TwoNodes(FrameRule::GivenOrGlobal)
        }
        Build::Relative(Frames::Span, _) => ActsOn::TwoPlaces,
        Build::Coordinate(quantity, _) => ActsOn::JointCoordinate(quantity),
        Build::Free(_) => ActsOn::Nothing,
        Build::AlongBeams => ActsOn::AlongBeams,
        Build::Coupling(Coupled::Two, _) => ActsOn::TwoJointCoordinates,
        Build::Coupling(Coupled::Named, _) => ActsOn::NamedCoordinates,
    };
    KindEntry {
        name: kind.name,
        summary: kind.summary,
        sample: kind.sample,
        parameters: kind.parameters,
        acts_on,
    }
}

fn element(kind: &ElementKind) -> KindEntry {
    let acts_on = match kind.attachment {
        Attachment::OneNode => ActsOn::OneNode,
        Attachment::TwoNodes => ActsOn::TwoPlaces,
        Attachment::Coordinate(quantity) => ActsOn::JointCoordinate(quantity),
        Attachment::Places => ActsOn::Places,
        Attachment::Coordinates => ActsOn::Coordinates,
    };
    KindEntry {
        name: kind.name,
        summary: kind.summary,
        sample: kind.sample,
        parameters: kind.parameters,
        acts_on,
    }
}
