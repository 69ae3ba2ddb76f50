//! Pressure on a face of a solid, against its present outward normal.
//!
//! Legend: p pressure, N functions of the nodes of the face, n normal times area per r and s.
//!
//! ```text
//! f_I = -p Σ w N_I n,      n = x,r × x,s,      δn = N_J,r δx_J × x,s + N_J,s x,r × δx_J
//! ```

use lissom_motion::{Matrix3, Vector3, skew};

use super::shape::{Functions, Natural, quadrilateral, quadrilateral_points, triangle, triangle_points};
use lissom_mechanics::elements::{Capabilities, Element, Load, Tangents, Unknowns, add_block};
use lissom_mechanics::kinematics::{Kinematics, NodeId};
use lissom_mechanics::registry::Function;

/// Functions of a face at its nine points of quadrature.
fn at_points<const NODES: usize>(
    functions: fn(Natural) -> Functions<NODES>,
    points: &[(Natural, f64); 9],
) -> [(Functions<NODES>, f64); 9] {
    points.map(|(place, weight)| (functions(place), weight))
}

/// A face with its functions at the points of quadrature.
#[derive(Clone, Debug)]
pub struct FacePressure<const NODES: usize> {
    nodes: [NodeId; NODES],
    points: Box<[(Functions<NODES>, f64); 9]>,
    /// Force per area against the outward normal [Pa].
    pressure: Function,
}

impl FacePressure<6> {
    /// Pressure [Pa] on a triangle: corners counterclockwise seen from outside, then the middles of the sides.
    pub fn on_triangle(nodes: [NodeId; 6], pressure: Function) -> Self {
        Self { nodes, points: Box::new(at_points(triangle, &triangle_points())), pressure }
    }
}

impl FacePressure<8> {
    /// Pressure [Pa] on a quadrilateral: corners counterclockwise seen from outside, then the middles of the sides.
    pub fn on_quadrilateral(nodes: [NodeId; 8], pressure: Function) -> Self {
        Self { nodes, points: Box::new(at_points(quadrilateral, &quadrilateral_points())), pressure }
    }
}

/// Derivatives of the position with respect to both natural coordinates of a face.
fn tangents<const NODES: usize>(positions: &[Vector3; NODES], functions: &Functions<NODES>) -> [Vector3; 2] {
    [0, 1].map(|k| positions.iter().zip(&functions.slopes).map(|(x, slope)| slope[k] * x).sum())
}

/// Shares of the nodes in a force per area on a triangle with six nodes, or a quadrilateral with eight: the integrals of their functions
/// [m²]. Those of corners are zero or negative.
pub fn area_shares(positions: &[Vector3]) -> Vec<f64> {
    fn of<const NODES: usize>(
        positions: [Vector3; NODES],
        points: &[(Functions<NODES>, f64); 9],
    ) -> Vec<f64> {
        let mut shares = vec![0.0; NODES];
        for (functions, weight) in points {
            let [along, across] = tangents(&positions, functions);
            let area = weight * along.cross(&across).norm();
            shares.iter_mut().zip(functions.values).for_each(|(sum, value)| *sum += area * value);
        }
        shares
    }
    if let Ok(positions) = <[Vector3; 6]>::try_from(positions) {
        return of(positions, &at_points(triangle, &triangle_points()));
    }
    <[Vector3; 8]>::try_from(positions)
        .map(|positions| of(positions, &at_points(quadrilateral, &quadrilateral_points())))
        .unwrap_or_default()
}

impl<const NODES: usize> FacePressure<NODES> {
    fn positions(&self, at: &Kinematics) -> [Vector3; NODES] {
        let origin = at.nodes[self.nodes[0]].frame.position;
        self.nodes.map(|node| at.nodes[node].frame.position - origin)
    }
}

impl<const NODES: usize> Element for FacePressure<NODES> {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let (pressure, positions) = (self.pressure.value(at.time), self.positions(at));
        for (functions, weight) in self.points.iter() {
            let [along, across] = tangents(&positions, functions);
            let force = (weight * pressure) * along.cross(&across);
            for (value, out) in functions.values.iter().zip(out.chunks_exact_mut(6)) {
                out.iter_mut().zip(&(*value * force)).for_each(|(sum, value)| *sum += value);
            }
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let (pressure, positions) = (self.pressure.value(at.time), self.positions(at));
        for (functions, weight) in self.points.iter() {
            let [along, across] = tangents(&positions, functions).map(|tangent| skew(&tangent));
            for (j, slope) in functions.slopes.iter().enumerate() {
                let change: Matrix3 = (weight * pressure) * (slope[1] * along - slope[0] * across);
                for (i, value) in functions.values.iter().enumerate() {
                    add_block(&mut out.stiffness, 6 * NODES, (6 * i, 6 * j), &(*value * change));
                }
            }
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl<const NODES: usize> Load for FacePressure<NODES> {
    fn breakpoints(&self) -> Vec<f64> {
        self.pressure.breakpoints()
    }

    fn depends_on_motion(&self) -> bool {
        true
    }
}
