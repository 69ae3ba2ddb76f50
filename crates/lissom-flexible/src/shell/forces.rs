//! Forces of a shell element, over one number or several lanes.
//!
//! Legend: f_I force on a node in global axes, v_iI the derivative of the energy with respect to its vector t_i, T_iI that vector in the axes
//! of the node.
//!
//! ```text
//! F_I = R_Iᵀ f_I,      M_I = Σ_i T_iI × R_Iᵀ v_iI
//! ```
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Pose, Real, Screw, Triple};

use super::constants::{Constants, SHAPES};
use super::quadrilateral::{EDGES, NODES, POINTS, STRAINS};
use super::strains::{BY_NODE, Deformed};

/// Derivatives of Σ σ_k e_k with respect to the positions and the vectors of the nodes, global axes.
#[derive(Clone, Copy)]
pub(super) struct Conjugate<R> {
    pub(super) positions: [Triple<R>; NODES],
    pub(super) vectors: [[Triple<R>; 3]; NODES],
}

impl<R: Real> Deformed<R> {
    /// Derivatives of Σ σ_k e_k.
    #[inline(always)]
    pub(super) fn conjugate(&self, stress: &[R; STRAINS]) -> Conjugate<R> {
        let zero = stress[0].like(0.0);
        let none = Triple::new(zero, zero, zero);
        let mut f = [none; NODES];
        let mut v = [[none; 3]; NODES];
        for k in 0..4 {
            let (i, j) = EDGES[k];
            let edge = &self.edges[k];
            let bending = (stress[5 + k] * edge.arc[0]).scaled(0.25);
            let shear = stress[10 + k].scaled(0.25);
            let own = (edge.chord * stress[k].scaled(0.25))
                .plus_scaled(edge.difference, bending)
                .plus_scaled(edge.sum, shear);
            f[j] = f[j] + own;
            f[i] = f[i] - own;
            let turned = (stress[5 + k] * edge.bending * edge.arc[1]).scaled(-2.0);
            v[j][2] = v[j][2].plus_scaled(edge.chord, shear + bending).plus_scaled(self.triads[i][2], turned);
            v[i][2] = v[i][2].plus_scaled(edge.chord, shear - bending).plus_scaled(self.triads[j][2], turned);
        }
        let (membrane, bending) = (stress[4].scaled(0.5), stress[9].scaled(0.5));
        let by_r = (self.position[1] * membrane).plus_scaled(self.director[1], bending);
        let by_s = (self.position[0] * membrane).plus_scaled(self.director[0], bending);
        let (turn_r, turn_s) = (self.position[1] * bending, self.position[0] * bending);
        for i in 0..NODES {
            let (a, b) = BY_NODE[i];
            f[i] = f[i] + by_r.scaled(a) + by_s.scaled(b);
            v[i][2] = v[i][2] + turn_r.scaled(a) + turn_s.scaled(b);
        }
        for p in 0..POINTS {
            let point = &self.points[p];
            let shape = &SHAPES[p][2];
            let stress = stress[14 + p];
            let (first, second) = (point.triad[0] * stress, point.triad[1] * stress);
            let (along, across) = (point.slopes[0] * stress, point.slopes[1] * stress);
            for i in 0..NODES {
                let [by_1, by_2] = point.by_node[i];
                f[i] = f[i].plus_scaled(first, by_2).plus_scaled(second, -by_1);
                v[i][0] = v[i][0] + across.scaled(shape[i]);
                v[i][1] = v[i][1] - along.scaled(shape[i]);
            }
        }
        Conjugate { positions: f, vectors: v }
    }
}

impl<R: Real> Conjugate<R> {
    /// Forces and moments in the axes of the nodes.
    #[inline(always)]
    pub(super) fn wrenches<C: Constants<R>>(
        &self,
        constants: &C,
        frames: &[Pose<R>; NODES],
    ) -> [Screw<R>; NODES] {
        let mut wrenches = [Screw::zero(self.positions[0].x); NODES];
        for i in 0..NODES {
            let rotation = frames[i].rotation;
            let mut moment = constants.director(i, 0).cross(rotation.apply_inverse(self.vectors[i][0]));
            for k in 1..3 {
                moment =
                    moment.plus_cross(constants.director(i, k), rotation.apply_inverse(self.vectors[i][k]));
            }
            wrenches[i] = Screw::new(rotation.apply_inverse(self.positions[i]), moment);
        }
        wrenches
    }
}

/// D e.
#[inline(always)]
pub(super) fn stress<R: Real, C: Constants<R>>(constants: &C, strains: &[R; STRAINS]) -> [R; STRAINS] {
    let zero = strains[0].like(0.0);
    let mut columns = [[zero]; STRAINS];
    for k in 0..STRAINS {
        columns[k][0] = strains[k];
    }
    let mut product = [[zero]; STRAINS];
    constants.stiffness_times(&columns, &mut product);
    let mut stress = [zero; STRAINS];
    for k in 0..STRAINS {
        stress[k] = product[k][0];
    }
    stress
}

/// Elastic forces on the nodes.
#[inline(always)]
pub(super) fn forces<R: Real, C: Constants<R>>(
    constants: &C,
    frames: &[Pose<R>; NODES],
) -> [Screw<R>; NODES] {
    let deformed = Deformed::at(constants, frames);
    let stress = stress(constants, &deformed.strains(constants));
    deformed.conjugate(&stress).wrenches(constants, frames)
}
