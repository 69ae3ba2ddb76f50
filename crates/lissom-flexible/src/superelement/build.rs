//! Adds superelements to a system.

use lissom_motion::{Motion, Vector3};
use nalgebra::DMatrix;

use super::deformation::Deformation;
use super::matrices::{Damping, rigid_motion};
use super::{MAX_SPIN, MAX_SPIN_KNOWN, ReducedMatrices, Superelement};
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::initial_model::InitialModel;
use lissom_mechanics::kinematics::{CoordinateId, Freedoms, NodeId, Quantity};
use lissom_mechanics::registry::ParameterError;

/// An interface of a superelement.
#[derive(Clone, Debug, PartialEq)]
pub struct InterfacePlace {
    /// Name of its node in the model.
    pub name: String,
    /// Position in the axes of the part [m].
    pub place: Vector3,
}

/// Description of a superelement.
#[derive(Clone, Debug)]
pub struct SuperelementDescription<'a> {
    /// Name in the model.
    pub name: &'a str,
    /// Initial pose of the part.
    pub frame: Motion,
    /// Interfaces of the part, in the order of the matrices.
    pub interfaces: &'a [InterfacePlace],
    /// Index of the interface that carries the floating frame.
    pub floating: usize,
    /// The matrices, as [`ReducedMatrices::check`] has left them.
    pub matrices: ReducedMatrices,
}

/// A superelement, with its unknowns. Modal coordinates are scaled so that each has the mass of the part: then they
/// have the magnitude of displacements.
///
/// # Errors
/// If it has too many unknowns.
pub fn superelement(
    model: &InitialModel,
    description: &SuperelementDescription<'_>,
) -> Result<(Contribution, Deformation), ParameterError> {
    let SuperelementDescription { name, frame, interfaces, floating, matrices } = description;
    let (size, first) = (matrices.mass.nrows(), 6 * interfaces.len());
    // Segments of local unknowns store indices in a byte.
    let max_unknowns = usize::from(u8::MAX);
    if size > max_unknowns {
        let words =
            format!("has {size} rows: a superelement has at most {max_unknowns}; remove interfaces or modes");
        return Err(ParameterError::new("mass", words));
    }
    let mut contribution = Contribution::to(model);
    let nodes: Vec<NodeId> = interfaces
        .iter()
        .map(|interface| {
            let place = Motion::new(frame.rotation, frame.transform_point(&interface.place));
            contribution.add_node(&interface.name, place, Freedoms::Full)
        })
        .collect();
    let coordinates: Vec<CoordinateId> = (1..=size - first)
        .map(|k| contribution.add_coordinate(format!("{name}.mode{k}"), 0.0, Quantity::Length))
        .collect();
    let places: Vec<Vector3> = interfaces.iter().map(|interface| interface.place).collect();
    let total = rigid_motion(&matrices.mass, &places).total;
    let factor = |k: usize| if k < first { 1.0 } else { (total / matrices.mass[(k, k)]).sqrt() };
    let scaled =
        |matrix: &DMatrix<f64>| DMatrix::from_fn(size, size, |i, j| factor(i) * factor(j) * matrix[(i, j)]);
    let damping = match &matrices.damping {
        Damping::Matrix(matrix) => Damping::Matrix(scaled(matrix)),
        other => other.clone(),
    };
    let preload = matrices.preload.iter().enumerate().map(|(k, value)| factor(k) * value).collect();
    let scaled = ReducedMatrices {
        mass: scaled(&matrices.mass),
        stiffness: scaled(&matrices.stiffness),
        damping,
        preload,
        geometric: matrices.geometric.as_ref().map(|own| Box::new(own.scaled(factor))),
    };
    let most = if matrices.geometric.is_some() { MAX_SPIN_KNOWN } else { MAX_SPIN };
    let gravity = model.gravity.clone();
    let spin = matrices.first_frequency_held(*floating).map(|rate| most * rate);
    let element =
        Superelement::new((nodes.clone(), coordinates.clone()), (*floating, &places), scaled, gravity);
    let contribution = contribution.with(element.believed_up_to(spin));
    let modes = coordinates.into_iter().enumerate().map(|(k, own)| (own, factor(first + k))).collect();
    Ok((contribution, Deformation { nodes, floating: *floating, places, modes }))
}
