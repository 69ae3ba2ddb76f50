//! A line of beam elements: nodes, elements and the nodes' shares of the mass, from a reference line.

use std::sync::Arc;

use lissom_motion::{Matrix6, Motion, Vector6};

use super::{Beam, SectionLaw};
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::initial_model::InitialModel;
use lissom_mechanics::elements::quadrature::gauss_lobatto;
use lissom_mechanics::kinematics::local_derivatives::LocalDerivatives;
use lissom_mechanics::kinematics::{Freedoms, Kinematics, NodeId};

/// Motion and section forces anywhere in a beam element, for outputs.
pub trait BeamProbe: Send + Sync {
    /// Pose of the section at ξ ∈ [-1, 1].
    fn frame_at(&self, at: &Kinematics, xi: f64) -> Motion;
    /// Twist of the section at ξ in its own frame [m/s, rad/s].
    fn twist_at(&self, at: &Kinematics, xi: f64) -> Vector6;
    /// Section forces and moments at ξ in the section's frame [N, N m].
    fn section_forces_at(&self, at: &Kinematics, xi: f64) -> Vector6;
    /// Internal forces on the two end nodes, section axes [N, N m].
    fn end_forces(&self, at: &Kinematics) -> [Vector6; 2];
    /// Derivatives of the section forces and moments with respect to the element's nodes.
    fn section_force_derivatives_at(&self, at: &Kinematics, xi: f64) -> LocalDerivatives<6>;
    /// The largest strain of the line, axial and shear [-].
    fn largest_strain(&self, at: &Kinematics) -> f64;
    /// Whether a node is behind the one before it.
    fn overlaps(&self, at: &Kinematics) -> bool;
    /// Strains and curvatures at ξ [-, 1/m].
    fn strain_at(&self, at: &Kinematics, xi: f64) -> Vector6;
}

impl<const N: usize> BeamProbe for Beam<N> {
    fn frame_at(&self, at: &Kinematics, xi: f64) -> Motion {
        Self::frame_at(self, at, xi)
    }
    fn twist_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        Self::twist_at(self, at, xi)
    }
    fn section_forces_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        Self::section_forces_at(self, at, xi)
    }
    fn end_forces(&self, at: &Kinematics) -> [Vector6; 2] {
        Self::end_forces(self, at)
    }
    fn section_force_derivatives_at(&self, at: &Kinematics, xi: f64) -> LocalDerivatives<6> {
        Self::section_force_derivatives_at(self, at, xi)
    }
    fn largest_strain(&self, at: &Kinematics) -> f64 {
        Self::largest_strain(self, at)
    }
    fn overlaps(&self, at: &Kinematics) -> bool {
        Self::overlaps(self, at)
    }
    fn strain_at(&self, at: &Kinematics, xi: f64) -> Vector6 {
        Self::strain_at(self, at, xi)
    }
}

/// Description of a line of beam elements. All functions take s ∈ [0, 1] along the line.
pub struct BeamLineDescription<'a> {
    /// Name in the model.
    pub name: &'a str,
    /// Number of elements, at least 1.
    pub elements: usize,
    /// Polynomial order of the elements: 1, 2 or 3.
    pub order: usize,
    /// Section frame: first axis along the line.
    pub frame: &'a dyn Fn(f64) -> Motion,
    /// Elastic law of the section.
    pub law: &'a dyn Fn(f64) -> SectionLaw,
    /// Mass matrix per length of the section [kg/m, kg, kg m], where it changes at once on the side of the second s.
    pub mass: &'a dyn Fn(f64, f64) -> Matrix6,
    /// Nodes of other parts to which the ends are fixed, instead of nodes of their own.
    pub ends: [Option<NodeId>; 2],
}

/// A line of beam elements as built.
#[derive(Clone)]
pub struct BeamLine {
    /// All nodes along the line.
    pub nodes: Vec<NodeId>,
    /// s of each node.
    pub places: Vec<f64>,
    /// Section frame relative to the node's frame, for each node.
    pub offsets: Vec<Motion>,
    /// Polynomial order.
    pub order: usize,
    /// The elements in order, for outputs.
    pub elements: Vec<Arc<dyn BeamProbe>>,
}

impl BeamLine {
    /// The element that contains s ∈ [0, 1], and ξ in it.
    pub fn locate(&self, s: f64) -> (&Arc<dyn BeamProbe>, f64) {
        let count = self.elements.len();
        let index = ((s * count as f64).floor().max(0.0) as usize).min(count - 1);
        (&self.elements[index], 2.0 * (s * count as f64 - index as f64) - 1.0)
    }

    /// The node at s, if there is one.
    pub fn node_at(&self, s: f64) -> Option<NodeId> {
        self.places.iter().position(|place| (place - s).abs() < 1e-9).map(|index| self.nodes[index])
    }
}

/// A line of beam elements.
pub fn beam_line(model: &InitialModel, description: &BeamLineDescription<'_>) -> (Contribution, BeamLine) {
    match description.order {
        1 => build::<2>(model, description),
        2 => build::<3>(model, description),
        _ => build::<4>(model, description),
    }
}

fn build<const N: usize>(model: &InitialModel, line: &BeamLineDescription<'_>) -> (Contribution, BeamLine) {
    let mut contribution = Contribution::to(model);
    let rule = gauss_lobatto(N);
    let last = line.elements * (N - 1);
    // s of node k: end points of elements exact, so that equal meshes have equal values.
    let place = |k: usize| {
        let (element, i) = (k / (N - 1), k % (N - 1));
        (element as f64 + 0.5 * (1.0 + rule[i].0)) / line.elements as f64
    };
    let places: Vec<f64> = (0..=last).map(place).collect();
    let frames: Vec<Motion> = places.iter().map(|&s| (line.frame)(s)).collect();
    let mut nodes = Vec::with_capacity(last + 1);
    let mut offsets = Vec::with_capacity(last + 1);
    for k in 0..=last {
        let shared = match k {
            0 => line.ends[0],
            _ if k == last => line.ends[1],
            _ => None,
        };
        if let Some(node) = shared {
            nodes.push(node);
            offsets.push(frames[k].relative_to(&model.frame(node)));
        } else {
            let name = match k {
                0 => format!("{}.start", line.name),
                _ if k == last => format!("{}.end", line.name),
                _ => format!("{}@{:.4}", line.name, places[k]),
            };
            nodes.push(contribution.add_node(&name, frames[k], Freedoms::Full));
            offsets.push(Motion::identity());
        }
    }
    let mut elements: Vec<Arc<dyn BeamProbe>> = Vec::with_capacity(line.elements);
    for element in 0..line.elements {
        let first = element * (N - 1);
        let own: [usize; N] = std::array::from_fn(|i| first + i);
        let along = |xi: f64| (element as f64 + 0.5 * (1.0 + xi)) / line.elements as f64;
        let beam = Beam::<N>::new(
            own.map(|k| nodes[k]),
            own.map(|k| (offsets[k] != Motion::identity()).then_some(offsets[k])),
            &own.map(|k| frames[k]),
            |xi| (line.law)(along(xi)),
        );
        for (i, &(xi, weight)) in rule.iter().enumerate() {
            let k = first + i;
            let mass = (weight * beam.length_per_xi(xi)) * (line.mass)(places[k], along(0.0));
            let adjoint = offsets[k].inverse().adjoint();
            contribution.add_inertia(nodes[k], adjoint.transpose() * mass * adjoint);
        }
        elements.push(Arc::new(beam.clone()));
        contribution = contribution.with(beam);
    }
    (contribution, BeamLine { nodes, places, offsets, order: N - 1, elements })
}
