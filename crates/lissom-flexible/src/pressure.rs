//! Pressure on a face of a shell or solid, against its present normal.
//!
//! Legend: p pressure, ∇p its derivative by the place, N functions of the nodes of the face, n normal times area per r and s.
//!
//! ```text
//! f_I = -Σ w p N_I n,      n = x,r × x,s,      δn = N_J,r δx_J × x,s + N_J,s x,r × δx_J,      δp = N_J ∇p·δx_J
//! ```

use std::sync::Arc;

use lissom_mesh::kinds::Functions;
use lissom_mesh::kinds::face::rule;
use lissom_motion::{Matrix3, Vector3, skew};

use lissom_mechanics::elements::{Capabilities, Element, Load, Tangents, Unknowns, add_block};
use lissom_mechanics::kinematics::{Kinematics, NodeId};
use lissom_mechanics::registry::Function;

/// Functions of a face at its points of quadrature, with their weights. Faces share them.
pub type FacePoints<const NODES: usize> = Arc<[(Functions<NODES>, f64)]>;

/// The points of faces with four, six or eight nodes; none of others.
pub fn face_points<const NODES: usize>() -> FacePoints<NODES> {
    let Some((fill, (at, count))) = rule(NODES) else { return Arc::default() };
    (0..count).map(at).map(|(place, weight)| (Functions::at(fill, place), weight)).collect()
}

/// A force per area that depends on the place.
pub trait PressureField: Send + Sync + std::fmt::Debug {
    /// Value of the field at a place [m] and an instant [Pa].
    fn value(&self, time: f64, place: &Vector3) -> f64;

    /// Derivative of the value by the place [Pa/m].
    fn slope(&self, time: f64, place: &Vector3) -> Vector3;

    /// Known breakpoints in time [s].
    fn breakpoints(&self) -> Vec<f64>;
}

/// A force per area against the outward normal [Pa].
#[derive(Clone, Debug)]
pub enum Pressure {
    /// Uniform pressure on a face.
    Uniform(Function),
    /// One that depends on the place.
    Field(Arc<dyn PressureField>),
}

/// A face under pressure: corners counterclockwise seen from outside, then the middles of the sides. Nodes of faces with four rotate.
#[derive(Clone, Debug)]
pub struct FacePressure<const NODES: usize> {
    nodes: [NodeId; NODES],
    points: FacePoints<NODES>,
    pressure: Pressure,
}

/// Derivatives of the position with respect to both natural coordinates of a face.
fn tangents<const NODES: usize>(positions: &[Vector3; NODES], functions: &Functions<NODES>) -> [Vector3; 2] {
    [0, 1].map(|k| positions.iter().zip(&functions.slopes).map(|(x, slope)| slope[k] * x).sum())
}

impl<const NODES: usize> FacePressure<NODES> {
    /// Nodes of shells rotate, and forces on these are in their axes.
    const TURNS: bool = NODES == 4;

    /// Pressure on a face.
    pub fn new(nodes: [NodeId; NODES], points: FacePoints<NODES>, pressure: Pressure) -> Self {
        Self { nodes, points, pressure }
    }

    fn positions(&self, at: &Kinematics) -> [Vector3; NODES] {
        let origin = at.nodes[self.nodes[0]].frame.position;
        self.nodes.map(|node| at.nodes[node].frame.position - origin)
    }

    /// Where a point is [m].
    fn place(
        &self,
        at: &Kinematics,
        (positions, functions): (&[Vector3; NODES], &Functions<NODES>),
    ) -> Vector3 {
        let arm: Vector3 = positions.iter().zip(functions.values).map(|(x, value)| value * x).sum();
        at.nodes[self.nodes[0]].frame.position + arm
    }

    /// The pressure that is the same everywhere, or the field.
    fn uniform(&self, time: f64) -> Result<f64, &dyn PressureField> {
        match &self.pressure {
            Pressure::Uniform(function) => Ok(function.value(time)),
            Pressure::Field(field) => Err(&**field),
        }
    }

    /// Forces that counteract the pressure, global axes [N].
    fn global_forces(&self, at: &Kinematics) -> [Vector3; NODES] {
        let (uniform, positions) = (self.uniform(at.time), self.positions(at));
        let mut forces = [Vector3::zeros(); NODES];
        for (functions, weight) in self.points.iter() {
            let [along, across] = tangents(&positions, functions);
            let place = || self.place(at, (&positions, functions));
            let pressure = uniform.unwrap_or_else(|field| field.value(at.time, &place()));
            let force = (weight * pressure) * along.cross(&across);
            forces.iter_mut().zip(functions.values).for_each(|(sum, value)| *sum += value * force);
        }
        forces
    }
}

impl<const NODES: usize> Element for FacePressure<NODES> {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let forces = self.global_forces(at);
        for ((force, &node), out) in forces.iter().zip(&self.nodes).zip(out.chunks_exact_mut(6)) {
            let rotation = &at.nodes[node].frame.rotation;
            let force = if Self::TURNS { rotation.apply_inverse(force) } else { *force };
            out.iter_mut().zip(&force).for_each(|(sum, value)| *sum += value);
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let (uniform, positions) = (self.uniform(at.time), self.positions(at));
        let rotations = self.nodes.map(|node| at.nodes[node].frame.rotation.matrix());
        for (functions, weight) in self.points.iter() {
            let tangents = tangents(&positions, functions);
            let normal = tangents[0].cross(&tangents[1]);
            let [along, across] = tangents.map(|tangent| skew(&tangent));
            let place = || self.place(at, (&positions, functions));
            let pressure = uniform.unwrap_or_else(|field| field.value(at.time, &place()));
            let by_place = uniform.err().map(|field| field.slope(at.time, &place()));
            for (j, slope) in functions.slopes.iter().enumerate() {
                let mut change: Matrix3 = (weight * pressure) * (slope[1] * along - slope[0] * across);
                if let Some(by_place) = by_place {
                    change += (weight * functions.values[j]) * normal * by_place.transpose();
                }
                let change = if Self::TURNS { change * rotations[j] } else { change };
                for (i, value) in functions.values.iter().enumerate() {
                    let own = if Self::TURNS { rotations[i].tr_mul(&change) } else { change };
                    add_block(&mut out.stiffness, 6 * NODES, (6 * i, 6 * j), &(*value * own));
                }
            }
        }
        if Self::TURNS {
            for (i, force) in self.global_forces(at).iter().enumerate() {
                let turning = skew(&rotations[i].tr_mul(force));
                add_block(&mut out.stiffness, 6 * NODES, (6 * i, 6 * i + 3), &turning);
            }
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl<const NODES: usize> Load for FacePressure<NODES> {
    fn breakpoints(&self) -> Vec<f64> {
        match &self.pressure {
            Pressure::Uniform(function) => function.breakpoints(),
            Pressure::Field(field) => field.breakpoints(),
        }
    }

    fn depends_on_motion(&self) -> bool {
        true
    }
}
