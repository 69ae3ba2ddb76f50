//! Recorded quantities, a file for each kind or for several that share their formulas: names and units of components, values and
//! derivatives. They are recorded, and signals depend on them.

pub(crate) mod angle;
pub(crate) mod channel_components;
pub mod channels;
pub(crate) mod contact;
pub(crate) mod contact_force;
pub(crate) mod contact_point;
mod derivatives;
mod differences;
pub(crate) mod energy;
pub(crate) mod entry;
pub(crate) mod expression;
pub(crate) mod frames;
pub(crate) mod kinds;
pub(crate) mod line;
pub(crate) mod local_load;
pub(crate) mod local_load_points;
mod location;
pub(crate) mod meshes;
pub(crate) mod modal;
pub(crate) mod momentum;
pub(crate) mod power;
pub(crate) mod reaction;
pub(crate) mod recovered;
pub(crate) mod relative;
pub(crate) mod relative_acceleration;
pub(crate) mod section;
pub(crate) mod shell_stress;
pub(crate) mod signal;
pub(crate) mod solid_stress;
pub(crate) mod spring;
mod spring_force;
#[cfg(test)]
#[path = "../../tests/unit/outputs/mod.rs"]
mod tests;
mod touched;
mod tyre;
pub(crate) mod work;

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_flexible::beam::line::BeamLine;
use lissom_flexible::superelement::Deformation;
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, Kinematics, NodeId, Quantity};
use lissom_mechanics::signals::Argument;
use lissom_mechanics::signals::measurement::{Component, Measurement};
use lissom_system::OutputDerivatives;
use lissom_system::accumulated::Accumulated;
use lissom_system::element_quantity;
use lissom_system::{ElementId, State, System};

use nalgebra::DMatrix;

use crate::outputs::channels::Channel;
use crate::outputs::contact_point::PointsOfContacts;
use crate::outputs::entry::Output;
use crate::outputs::local_load_points::LocalLoadPoints;
use crate::outputs::meshes::BuiltMeshes;
use crate::text::report::Problem;

use touched::Touched;

/// A system and the state at which a quantity is evaluated.
#[derive(Clone, Copy)]
pub(crate) struct Evaluation<'a> {
    pub(crate) system: &'a System,
    pub(crate) state: &'a State,
}

impl<'a> Evaluation<'a> {
    /// The motion.
    fn motion(&self) -> &'a Kinematics {
        &self.state.kinematics
    }
}

/// Name and unit of each component.
pub(crate) type NamesAndUnits = Vec<(String, &'static str)>;

/// A recorded quantity of a model.
pub(crate) trait OutputQuantity: Send + Sync {
    /// Names and units of its components, unless they are those of its kind; `quantity` is that of a coordinate.
    fn components(&self, _quantity: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        None
    }

    /// Components of the quantity one after the other, if they depend on the motion of a few nodes and coordinates and have exact gradients
    /// for Newton's method.
    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        &[]
    }

    /// Appends the components' values [SI]. Default: those of its measurements.
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        for own in self.measurements() {
            out.extend_from_slice(&own.values(at.motion())[..own.component_count()]);
        }
    }

    /// Derivatives of the components, exact unless the quantity is [`touched`](Self::touched); `length` [m] is of the size of the
    /// model. Default: those of its measurements, or none.
    fn derivatives(&self, at: &Evaluation<'_>, _length: f64) -> Option<Vec<OutputDerivatives>> {
        let all = all_components(self.measurements());
        let of = |own: &Component| derivatives::of_component(own, at.system, at.motion());
        (!all.is_empty()).then(|| all.iter().map(of).collect())
    }

    /// Whether a component depends on positions only, although others need more.
    fn is_of_positions(&self, _component: usize) -> bool {
        false
    }

    /// The unknowns that it depends on, where its derivatives are differences.
    fn touched(&self, _system: &System) -> Option<Touched> {
        None
    }

    /// Channels whose components an expression names, and which component.
    fn arguments(&self) -> &[(Channel, usize)] {
        &[]
    }
}

/// The components of several measurements, one after the other.
pub(crate) fn all_components(measurements: &[Arc<dyn Measurement>]) -> Vec<Component> {
    let all = |of: &Arc<dyn Measurement>| {
        let of = Arc::clone(of);
        (0..of.component_count()).map(move |component| Component { of: Arc::clone(&of), component })
    };
    measurements.iter().flat_map(all).collect()
}

/// A quantity, or why there is none.
pub(crate) type Found = Result<Arc<dyn OutputQuantity>, Problem>;

/// A number that the simulation accumulates, or why there is none.
pub(crate) type FoundNumber = Result<Arc<dyn Accumulated>, Problem>;

/// How the quantity of an output is found.
pub(crate) enum Build {
    /// From what is known before the system is built, so that signals can depend on it.
    Motion(fn(&Output, &Subjects<'_>) -> Found),
    /// From an element; signals depend on this quantity of it, which is known when the elements are added.
    Element(fn(&Output) -> element_quantity::Of, fn(&Output, &System, &Subjects<'_>) -> Found),
    /// From the system; why signals can depend on it at samples alone.
    System(&'static str, fn(&Output, &System, &Subjects<'_>) -> Found),
    /// The simulation accumulates it.
    Accumulated(fn(&Output, &System, &Subjects<'_>) -> FoundNumber),
    /// From other outputs.
    Expression,
}

/// Why signals can depend on a kind at samples alone: it follows from the solution of a step.
const SOLUTION: &str = "it follows from the solution of a step";
/// Why signals can depend on a kind at samples alone: the tangent of a load would be full.
const WHOLE_MODEL: &str = "it depends on the motion of the whole model";

/// Unknowns of a superelement, and the matrix that makes outputs of them.
#[derive(Clone)]
pub struct Deformed {
    /// Where the unknowns are found.
    pub unknowns: Arc<Deformation>,
    /// A row for each output; none where it is not given.
    pub recovery: Option<Arc<DMatrix<f64>>>,
}

/// Names resolved by the lowering.
pub(crate) struct Resolver<'a> {
    pub(crate) nodes: &'a BTreeMap<String, NodeId>,
    pub(crate) lines: &'a BTreeMap<String, BeamLine>,
    pub(crate) meshes: &'a BuiltMeshes,
    pub(crate) deformations: &'a BTreeMap<String, Deformed>,
    pub(crate) coordinates: &'a BTreeMap<String, Vec<CoordinateId>>,
    pub(crate) springs: &'a BTreeMap<String, (ElementId, Quantity)>,
    pub(crate) latches: &'a BTreeMap<String, usize>,
    /// Springs, loads and joints' friction.
    pub(crate) powers: &'a BTreeMap<String, Vec<ElementId>>,
    /// Points of each contact.
    pub(crate) contacts: &'a PointsOfContacts,
    pub(crate) local_loads: &'a BTreeMap<String, LocalLoadPoints>,
    /// Signals, inputs and states.
    pub(crate) signals: &'a BTreeMap<String, Argument>,
}

/// What outputs refer to: names, and frames as far as they are known before the system is built.
pub(crate) struct Subjects<'a> {
    pub(crate) names: &'a Resolver<'a>,
    /// Frames of nodes as the model describes them.
    pub(crate) drawn: &'a Kinematics,
    /// Frames of nodes from which the motion starts: others than drawn where the model was assembled.
    pub(crate) start: &'a Kinematics,
    /// Frames of outputs of a joint between two nodes, base first.
    pub(crate) joint_frames: &'a dyn Fn(&str) -> Option<[CarriedFrame; 2]>,
}
