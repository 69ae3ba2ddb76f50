//! The core's tables of joints, springs, loads, schemes and solvers, in the words of the model file.

use lissom_mechanics::elements::{ElementKind, LOADS, SPRINGS};
use lissom_mechanics::joints::{self, JointKind};
use lissom_system::schemes;

use crate::registry::{ChoiceEntry, KindEntry, Registry};

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
                parameters: kind.parameters,
                tolerance: kind.tolerance,
            })
            .collect(),
        solvers: lissom_solver::KINDS
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
    let &JointKind { name, summary, sample, parameters, ports, .. } = kind;
    KindEntry { name, summary, sample, parameters, ports }
}

fn element(kind: &ElementKind) -> KindEntry {
    let &ElementKind { name, summary, sample, parameters, ports, .. } = kind;
    KindEntry { name, summary, sample, parameters, ports }
}
