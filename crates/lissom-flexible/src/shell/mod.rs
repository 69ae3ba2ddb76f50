//! Four-node shell with six unknowns per node: elastic forces. Its inertia is added by `surface`.
//!
//! Strains are those of a surface with directors: Green-Lagrange membrane strains, curvatures and transverse shear from products of
//! positions and of vectors that the nodes carry, drilling by a weak spring on the skew part in the plane. 18 natural strains, for 24
//! unknowns without 6 rigid motions, see `strains`, `interpolation` and `condensed`:
//!
//! ```text
//! W = eᵀ D e/2,    forces Gᵀ D e,    G derivatives of e
//! ```
//!
//! with a constant D, so that there are no internal unknowns and no history. No deformation is without energy but rigid motions.

mod blocks;
mod condensed;
mod constants;
pub mod damping;
mod forces;
mod interpolation;
mod linearize;
mod mass;
pub mod quadrilateral;
mod reference;
pub mod section;
mod stage_forces;
mod strains;
pub mod surface;

use std::sync::Arc;

use lissom_motion::{Motion, Pose, Vector3};

use self::blocks::ShellBlocks;
use self::constants::{Constants, Numbers};
use self::forces::forces;
use self::interpolation::interpolation;
use self::quadrilateral::{EDGES, GAUSS, GAUSS_POINTS, NODES, STRAINS};
use self::reference::Reference;
use self::section::ShellLaw;
use self::strains::Deformed;
use lissom_mechanics::elements::{Capabilities, Deformable, Element, Energy, Tangents, Unknowns};
use lissom_mechanics::evaluation::blocks::{Blocks, linearize_alone};
use lissom_mechanics::kinematics::step_stages::{STAGES, StepStages};
use lissom_mechanics::kinematics::{Kinematics, NodeId, Stressed};

/// A shell element. Copies share its constants.
#[derive(Clone, Debug)]
pub struct Shell {
    nodes: [NodeId; NODES],
    numbers: Numbers,
    reference: Reference,
    law: Arc<ShellLaw>,
}

impl Shell {
    /// A shell element between `nodes`, stress-free with them at `frames`, except for free strains of its law. `directors` are the normals of the surface at its nodes in global
    /// axes, `direction` is projected on the surface to be the first local axis.
    pub fn new(
        nodes: [NodeId; NODES],
        frames: &[Motion; NODES],
        directors: &[Vector3; NODES],
        direction: Option<Vector3>,
        law: impl Into<Arc<ShellLaw>>,
    ) -> Self {
        let law = law.into();
        let reference = Reference::new(frames.map(|frame| frame.position), direction);
        let stiffness = condensed::stiffness(&reference, &law);
        let triads = std::array::from_fn(|i| {
            let normal = directors[i];
            let first = (reference.first - normal * reference.first.dot(&normal)).normalize();
            [first, normal.cross(&first), normal].map(|vector| frames[i].rotation.apply_inverse(&vector))
        });
        let jacobians = GAUSS_POINTS.map(|(r, s)| reference.axes(r, s).jacobian);
        let numbers = Numbers::new(&stiffness, &triads, &jacobians);
        let poses = frames.each_ref().map(Pose::from);
        let mut natural = Deformed::at(&numbers, &poses).raw_strains();
        let free = reference.natural_strains(&law.free);
        natural.iter_mut().zip(free).for_each(|(sum, value)| *sum += value);
        Self { nodes, numbers: numbers.with_natural(&natural), reference, law }
    }

    /// Normal of the surface at a node, in the axes of the node.
    pub fn director(&self, node: usize) -> Vector3 {
        self.numbers.director(node, 2).into()
    }

    fn frames(&self, at: &Kinematics) -> [Pose<f64>; NODES] {
        self.nodes.map(|node| Pose::from(&at.nodes[node].frame))
    }

    /// Strains ε11, ε22, 2 ε12 [-], κ11, κ22, 2 κ12 [1/m], 2 ε13, 2 ε23 [-] at r, s ∈ [-1, 1] in the local axes, beyond the free ones.
    pub fn strains_at(&self, at: &Kinematics, (r, s): (f64, f64)) -> [f64; 8] {
        let natural = Deformed::at(&self.numbers, &self.frames(at)).strains(&self.numbers);
        let axes = self.reference.axes(r, s);
        let strains = interpolation(&self.reference, &axes, r, s) * nalgebra::SVector::from(natural);
        std::array::from_fn(|k| strains[k])
    }

    /// Strains at a corner, extrapolated from the points of quadrature, where they are most accurate.
    pub fn strains_at_corner(&self, at: &Kinematics, corner: usize) -> [f64; 8] {
        let natural =
            nalgebra::SVector::from(Deformed::at(&self.numbers, &self.frames(at)).strains(&self.numbers));
        let (r, s) = quadrilateral::CORNERS[corner];
        // Of the Gauss points as corners of an element.
        let shape = quadrilateral::bilinear(r / GAUSS, s / GAUSS)[0];
        let mut strains = [0.0; 8];
        for (weight, (r, s)) in shape.iter().zip(quadrilateral::CORNERS) {
            let (r, s) = (GAUSS * r, GAUSS * s);
            let axes = self.reference.axes(r, s);
            let own = interpolation(&self.reference, &axes, r, s) * natural;
            strains.iter_mut().zip(&own).for_each(|(sum, value)| *sum += weight * value);
        }
        strains
    }

    /// Forces and moments per length N11, N22, N12 [N/m], M11, M22, M12 [N], Q13, Q23 [N/m] at r, s ∈ [-1, 1] in the local axes.
    pub fn resultants_at(&self, at: &Kinematics, place: (f64, f64)) -> [f64; 8] {
        let strains = nalgebra::SVector::from(self.strains_at(at, place));
        let resultants = self.law.stiffness * strains;
        std::array::from_fn(|k| resultants[k])
    }

    /// Area of the element in the stress-free state [m²].
    pub fn area(&self) -> f64 {
        condensed::areas(&self.reference).sum()
    }

    /// Elastic law of the element.
    pub fn law(&self) -> &ShellLaw {
        &self.law
    }

    /// Direction whose projection on the surface is the first local axis, global axes in the stress-free state.
    pub fn first_direction(&self) -> Vector3 {
        self.reference.first
    }

    /// First local axis and normal of the element at a corner, global axes in the stress-free state.
    pub fn axes_at_corner(&self, corner: usize) -> [Vector3; 2] {
        let (r, s) = quadrilateral::CORNERS[corner];
        let axes = self.reference.axes(r, s);
        [axes.first, axes.normal]
    }

    /// The normals of the surface that its nodes carry, in the axes of the nodes.
    pub fn directors(&self) -> [Vector3; NODES] {
        std::array::from_fn(|i| self.numbers.director(i, 2).into())
    }

    /// Nodes of the element, counterclockwise about the normal.
    pub fn nodes(&self) -> &[NodeId; NODES] {
        &self.nodes
    }

    /// Length of the longest side in the stress-free state [m].
    fn size(&self) -> f64 {
        let p = &self.reference.positions;
        EDGES.iter().map(|&(i, j)| (p[j] - p[i]).norm()).fold(0.0, f64::max)
    }
}

/// Energy of strains [J].
fn energy(numbers: &Numbers, strains: &[f64; STRAINS]) -> f64 {
    let stress = forces::stress(numbers, strains);
    0.5 * strains.iter().zip(&stress).map(|(strain, stress)| strain * stress).sum::<f64>()
}

impl Element for Shell {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let wrenches = forces(&self.numbers, &self.frames(at));
        for (sum, value) in out.iter_mut().zip(wrenches.iter().flat_map(|wrench| wrench.components())) {
            *sum += value;
        }
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        self.add_stage_forces(step, out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.linearize_stressed(at, at.into(), out);
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let strains = Deformed::at(&self.numbers, &self.frames(at)).strains(&self.numbers);
        Energy { strain: energy(&self.numbers, &strains), ..Energy::default() }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { deformation: Some(self), ..Capabilities::default() }
    }

    fn blocks(items: &[Self]) -> Option<Box<dyn Blocks>> {
        Some(Box::new(ShellBlocks::new(items)))
    }
}

impl Deformable for Shell {
    fn linearize_stressed(&self, at: &Kinematics, stressed: Stressed<'_>, out: &mut Tangents) {
        linearize_alone(&ShellBlocks::new(std::slice::from_ref(self)), (at, stressed), out);
    }

    fn predicts_stresses(&self) -> bool {
        true
    }

    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)> {
        let velocity = |node: NodeId| {
            let own = &at.nodes[node];
            own.frame.rotation.apply(&own.twist.fixed_rows::<3>(0).into())
        };
        let turning = |node: NodeId| {
            let own = &at.nodes[node];
            own.frame.rotation.apply(&own.twist.fixed_rows::<3>(3).into())
        };
        let rate = |&(i, j): &(usize, usize)| {
            let [from, to] = [i, j].map(|k| self.nodes[k]);
            let chord = at.nodes[to].frame.position - at.nodes[from].frame.position;
            let mean = 0.5 * (turning(from) + turning(to));
            let apart = velocity(to) - velocity(from) - mean.cross(&chord);
            (apart.norm() / chord.norm() + (turning(to) - turning(from)).norm(), to)
        };
        EDGES.iter().map(rate).reduce(|most, own| if own.0 > most.0 { own } else { most })
    }

    fn max_relative_rotation(&self, at: &Kinematics) -> Option<(f64, [NodeId; 2])> {
        let triads = Deformed::at(&self.numbers, &self.frames(at)).triads;
        // cos(θ/2) from the trace 1 + 2 cos θ of the rotation from one triad to the other.
        let pairs = EDGES.iter().map(|&(i, j)| {
            let trace: f64 = (0..3).map(|k| triads[i][k].dot(triads[j][k])).sum();
            (0.5 * (1.0 + trace).max(0.0).sqrt(), [i, j].map(|k| self.nodes[k]))
        });
        pairs.reduce(|least, pair| if pair.0 < least.0 { pair } else { least })
    }
}
