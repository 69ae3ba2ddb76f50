//! Force and moment that an element between two frames exerts on its tip.
//!
//! Legend: (F, M) force and moment on the node of the tip in its axes, r and Q origin and axes of the tip's frame in those of the node,
//! R rotation of the node, S axes in which the wrench is expressed.
//!
//! ```text
//! f = Sᵀ R F,      m = Sᵀ R (M - r × F)
//! S = 1 (ground), the axes of the base's frame, or R Q (tip)
//! δ(R a) = R (δa + δθ × a),      δ(Sᵀ b) = Sᵀ δb + (Sᵀ b) × (Q_baseᵀ δθ_base)
//! ```

use lissom_motion::{Matrix3, Vector3, skew};

use super::element::Element;
use super::scratch::with_scratch;
use super::work::with_tangents;
use crate::kinematics::{CarriedFrame, Kinematics};
use crate::signals::measurement::Gradient;

/// Axes in which a wrench is expressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WrenchAxes {
    /// Global ones.
    #[default]
    Ground,
    /// Axes of the frame that the base carries.
    Base,
    /// Axes of the frame that the tip carries.
    Tip,
}

/// First unknown of the tip.
const TIP: usize = 6;

impl WrenchAxes {
    /// Sᵀ R.
    fn rotation_of_tip(self, [base, tip]: &[CarriedFrame; 2], at: &Kinematics) -> Matrix3 {
        let rotation = at.nodes[tip.node].frame.rotation;
        match self {
            Self::Ground => rotation.matrix(),
            Self::Base => {
                (at.nodes[base.node].frame.rotation * base.offset.rotation).matrix().transpose()
                    * rotation.matrix()
            }
            Self::Tip => tip.offset.rotation.matrix().transpose(),
        }
    }
}

/// Force and moment about the origin of the tip's frame from those on its node.
fn about_frame(on_node: &[f64], tip: &CarriedFrame) -> [Vector3; 2] {
    let [force, moment] = [0, 3].map(|first| Vector3::from_column_slice(&on_node[first..first + 3]));
    [force, moment - tip.offset.position.cross(&force)]
}

/// Force [N] on the tip and moment [N m] about the origin of its frame, of an element whose first two nodes are those of the frames.
pub fn wrench<E: Element + ?Sized>(
    element: &E,
    frames: &[CarriedFrame; 2],
    axes: WrenchAxes,
    at: &Kinematics,
) -> [f64; 6] {
    with_scratch(element.unknowns().force_count(), |forces| {
        element.forces(at, forces);
        let turn = axes.rotation_of_tip(frames, at);
        // Forces are on the left-hand side of the equations of motion.
        let [force, moment] = about_frame(&forces[TIP..TIP + 6], &frames[1]).map(|own| -(turn * own));
        [force.x, force.y, force.z, moment.x, moment.y, moment.z]
    })
}

/// Gradient of a component of [`wrench`] with respect to the element's unknowns.
pub fn wrench_gradient<E: Element + ?Sized>(
    element: &E,
    frames: &[CarriedFrame; 2],
    axes: WrenchAxes,
    component: usize,
    at: &Kinematics,
) -> Gradient {
    let size = element.unknowns().force_count();
    let turn = axes.rotation_of_tip(frames, at);
    let (part, row) = (component / 3, component % 3);
    let project = |on_node: &[f64]| -(turn * about_frame(on_node, &frames[1])[part])[row];
    let mut gradient = Gradient::zero();
    with_tangents(element, at, |tangents| {
        for (own, matrix) in [
            (&mut gradient.by_place, &tangents.stiffness),
            (&mut gradient.by_rate, &tangents.damping),
            (&mut gradient.by_acceleration, &tangents.mass),
        ] {
            for (column, own) in own[..size].iter_mut().enumerate() {
                let of: [f64; 6] = std::array::from_fn(|k| matrix[(TIP + k) * size + column]);
                *own = project(&of);
            }
        }
    });
    if axes == WrenchAxes::Tip {
        return gradient;
    }
    with_scratch(size, |forces| {
        element.forces(at, forces);
        let own = -about_frame(&forces[TIP..TIP + 6], &frames[1])[part];
        let by_tip = -turn * skew(&own);
        let by_base = skew(&(turn * own)) * frames[0].offset.rotation.matrix().transpose();
        for k in 0..3 {
            gradient.by_place[TIP + 3 + k] += by_tip[(row, k)];
            if axes == WrenchAxes::Base {
                gradient.by_place[3 + k] += by_base[(row, k)];
            }
        }
    });
    gradient
}
