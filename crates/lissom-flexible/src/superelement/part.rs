//! The data of a superelement: its interfaces, matrices and rigid motion.

use lissom_motion::Vector3;
use nalgebra::{DMatrix, DVector, Matrix3xX};

use super::matrices::{Damping, ReducedMatrices, RigidMotion, rigid_motion};
use lissom_mechanics::elements::inertia::Gravity;
use lissom_mechanics::kinematics::{CoordinateId, NodeId};

/// A part that is reduced to its interfaces and modal coordinates.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) nodes: Vec<NodeId>,
    pub(super) coordinates: Vec<CoordinateId>,
    /// The interface that carries the floating frame.
    pub(super) frame: usize,
    /// X_i - X_f [m].
    pub(super) places: Vec<Vector3>,
    /// M less GᵀG/m.
    pub(super) mass: DMatrix<f64>,
    pub(super) stiffness: DMatrix<f64>,
    pub(super) damping: Option<DMatrix<f64>>,
    /// f₀.
    pub(super) preload: DVector<f64>,
    /// m, and m c from the interface f.
    pub(super) total: f64,
    pub(super) moment: Vector3,
    /// G.
    pub(super) carried: Matrix3xX<f64>,
    pub(super) gravity: Gravity,
}

impl Part {
    /// The part between `nodes`, whose positions without deformation are `places` [m], with the modal `coordinates`;
    /// interface `frame` carries the floating frame.
    pub(super) fn new(
        (nodes, coordinates): (Vec<NodeId>, Vec<CoordinateId>),
        (frame, places): (usize, &[Vector3]),
        matrices: ReducedMatrices,
        gravity: Gravity,
    ) -> Self {
        let places: Vec<Vector3> = places.iter().map(|place| place - places[frame]).collect();
        let RigidMotion { total, moment, carried, .. } = rigid_motion(&matrices.mass, &places);
        let ReducedMatrices { mass, stiffness, damping, preload, .. } = matrices;
        let damping = match damping {
            Damping::None => None,
            Damping::Matrix(matrix) => Some(matrix),
            Damping::OfStiffness(time) => Some(&stiffness * time),
        };
        let size = mass.nrows();
        // The mass matrix without that of the centre has no translations.
        let mass = mass - carried.tr_mul(&carried) / total;
        let preload = if preload.is_empty() { DVector::zeros(size) } else { DVector::from_vec(preload) };
        Self {
            nodes,
            coordinates,
            frame,
            places,
            mass,
            stiffness,
            damping,
            preload,
            total,
            moment,
            carried,
            gravity,
        }
    }

    pub(super) fn size(&self) -> usize {
        6 * self.nodes.len() + self.coordinates.len()
    }

    /// The largest distance of an interface from the floating frame [m].
    pub(super) fn reach(&self) -> f64 {
        self.places.iter().map(Vector3::norm).fold(0.0, f64::max)
    }

    /// The mass of a modal coordinate, that of the centre included.
    pub(super) fn whole_mass(&self, row: usize) -> f64 {
        self.mass[(row, row)] + self.carried.column(row).norm_squared() / self.total
    }
}
