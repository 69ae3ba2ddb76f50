//! Superelement: a linear elastic part that is reduced to a few interfaces and modal coordinates, on a floating frame
//! [Géradin and Cardona 2001, ch. 9].
//!
//! Legend: interface i has the position x_i and the rotation R_i, and X_i in the undeformed part, whose interfaces have parallel
//! axes; f is the interface that carries the floating frame, q are the modal coordinates, E_i = R_fᵀ R_i.
//!
//! ```text
//! u = (r_i - X_i + X_f,  log E_i,  q),        r_i = R_fᵀ (x_i - x_f)                elastic energy  f₀·u + ½ u·K u
//! η = (E_i v_i,  E_i ω_i,  q̇),      v_i, ω_i twist in the node's axes    kinetic energy  ½ η·(M - GᵀG/m) η + ½ m |ẋ_c|²
//! G = Tᵀ M,  T translations,  x_c centre of mass as G u displaces it (see `centre`)       weight  -m g·x_c
//! ```
//!
//! Interfaces are nodes and modal coordinates are coordinates: there is no further constraint. If the matrices contain the
//! rigid motions, the inertia of a rigid motion is exact. K acts on the relative motion only, so that nothing changes when the
//! element moves rigidly. Omitted terms are of the order of the square of the angular velocity over the natural frequencies;
//! with given second-order matrices, `second_order` replaces this kinetic energy.
//!
//! Without the second term of the kinetic energy a part that moves fast and rotates would be bent by it: η has components in
//! rotating axes, and displacements of modal coordinates do not rotate with them.
//!
//! With p = (M - GᵀG/m) η, the equations of motion of the kinetic energy in body axes (Poincaré's) are
//!
//! ```text
//! force on i   E_iᵀ (ṗ_i + ω_f × p_i),     moment on i   E_iᵀ (ṗ_i + (ω_f - E_i ω_i) × p_i),     on q   ṗ_q
//! additional moment on f:  Σ (E_i v_i) × p_i + (E_i ω_i) × p_i    with p_i of force, and of moment
//! ```

mod build;
mod centre;
mod deformation;
mod element_scratch;
mod forces;
mod geometric;
mod left_out;
mod linearize;
mod load_stiffness;
mod matrices;
mod part;
mod relative;
mod second_order;
mod step_stages;
mod turning;
mod vectors;

use std::cell::RefCell;

use lissom_motion::Vector3;

pub use self::build::{InterfacePlace, SuperelementDescription, superelement};
use self::centre::{Centre, Derivatives};
pub use self::deformation::Deformation;
use self::element_scratch::ElementScratch;
pub use self::geometric::PAIRS;
pub use self::geometric::{GeometricMatrices, Shortening, TurningMatrices};
use self::left_out::{LeftOut, MAX_ERROR};
use self::linearize::Maps;
pub use self::load_stiffness::flexibility;
use self::load_stiffness::{LoadStiffness, MAX_SHARE};
pub use self::matrices::rigid_column;
pub use self::matrices::{Damping, ReducedMatrices};
use self::part::Part;
use self::second_order::{Deformed, SecondOrder};
use self::vectors::{product, three};
use lissom_mechanics::elements::inertia::Gravity;
use lissom_mechanics::elements::{
    Capabilities, Deformable, Element, Energy, Limit, LimitKind, OwnInertia, Place, Tangents, Unknowns,
    Validity,
};
use lissom_mechanics::kinematics::step_stages::{STAGES, StepStages};
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, NodeId, Stressed, split};

/// Elastic rotation of an interface relative to the floating frame that causes a warning [rad]: forces that grow by the square of
/// the rotation are a few hundredths of the others.
pub const MAX_ROTATION: f64 = 0.2;
/// Elastic displacement of an interface that causes a warning, as a fraction of its distance from the floating frame.
pub const MAX_DISPLACEMENT: f64 = 0.15;

/// Angular velocity at which the missing centrifugal stiffness causes a warning, over the first natural frequency with the
/// floating interface fixed: its square is the relative change of stiffness.
pub const MAX_SPIN: f64 = 0.25;
/// Angular velocity that causes a warning for matrices that include this stiffness, to first order in the square.
pub const MAX_SPIN_KNOWN: f64 = 1.0;

/// A reduced part.
#[derive(Clone, Debug)]
pub struct Superelement {
    part: Part,
    /// Angular velocity up to which matrices are valid [rad/s]; none without vibration.
    largest_spin: Option<f64>,
    /// Estimate of the change of stiffness by loads; none if not required.
    load_stiffness: Option<LoadStiffness>,
    /// Estimate of the forces of omitted modes; none if not required.
    left_out: Option<LeftOut>,
    /// Second-order terms in the deformation, if the matrices contain them.
    second_order: Option<Box<SecondOrder>>,
}

/// Scratch of a thread, so that nothing is allocated once it is large enough.
#[derive(Default)]
struct ThreadScratch {
    own: ElementScratch,
    stages: [ElementScratch; STAGES],
    centre: Centre,
    maps: Maps,
    derivatives: Derivatives,
    second: Deformed,
    mass: Vec<f64>,
}

thread_local! {
    static SCRATCH: RefCell<ThreadScratch> = RefCell::default();
}

impl Superelement {
    /// The element between `nodes`, whose positions in the undeformed part are `places` [m], with the modal `coordinates`;
    /// interface `frame` carries the floating frame. The matrices are not checked: see [`ReducedMatrices::check`].
    pub fn new(
        (nodes, coordinates): (Vec<NodeId>, Vec<CoordinateId>),
        (frame, places): (usize, &[Vector3]),
        matrices: ReducedMatrices,
        gravity: Gravity,
    ) -> Self {
        let geometric = matrices.geometric.clone();
        let mass = matrices.mass.clone();
        let part = Part::new((nodes, coordinates), (frame, places), matrices, gravity);
        let second_order = geometric.map(|own| Box::new(SecondOrder::of(&part, &mass, &own)));
        Self { part, largest_spin: None, load_stiffness: None, left_out: None, second_order }
    }

    /// With an angular velocity that causes a warning [rad/s], and with a warning of loads that change the stiffness.
    #[must_use]
    pub fn believed_up_to(self, spin: Option<f64>) -> Self {
        let load_stiffness = Some(LoadStiffness::of(&self.part));
        let left_out = LeftOut::of(&self.part);
        Self { largest_spin: spin, load_stiffness, left_out, ..self }
    }
}

/// Whether all pivots of a symmetric matrix are positive, by its Cholesky factorisation in place, of the lower triangle.
fn is_positive_definite(matrix: &mut [f64], size: usize) -> bool {
    for row in 0..size {
        for column in 0..=row {
            let (above, own) = matrix.split_at(row * size);
            let before =
                if column < row { &above[column * size..column * size + column] } else { &own[..column] };
            let sum: f64 = own[..column].iter().zip(before).map(|(a, b)| a * b).sum();
            let rest = own[column] - sum;
            if column < row {
                let pivot = above[column * size + column];
                matrix[row * size + column] = rest / pivot;
            } else if rest > 0.0 {
                matrix[row * size + column] = rest.sqrt();
            } else {
                return false;
            }
        }
    }
    true
}

impl Element for Superelement {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.part.nodes, coordinates: &self.part.coordinates, multipliers: &[] }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        SCRATCH.with_borrow_mut(|ThreadScratch { own: scratch, centre, second, .. }| {
            scratch.enter(&self.part, at);
            self.part.stress(scratch);
            self.part.add_conjugate(scratch, &scratch.stress, out);
            if let Some(law) = &self.second_order {
                second.add_forces(&self.part, law, at, out);
            } else {
                self.part.add_inertia(at, scratch, centre, out);
            }
        });
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        SCRATCH.with_borrow_mut(|ThreadScratch { own, stages, centre, second, .. }| {
            let has_inertia = self.second_order.is_none();
            self.part.add_stage_forces(step, (own, stages, centre), has_inertia, out);
            if let Some(law) = &self.second_order {
                for (at, out) in step.stages.iter().zip(out) {
                    second.add_forces(&self.part, law, at, out);
                }
            }
        });
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.linearize_stressed(at, at.into(), out);
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        SCRATCH.with_borrow_mut(|ThreadScratch { own: scratch, centre, second, .. }| {
            scratch.enter(&self.part, at);
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            product(&self.part.stiffness, &scratch.displacement, &mut scratch.stress);
            let strain = 0.5 * dot(&scratch.stress, &scratch.displacement)
                + dot(self.part.preload.as_slice(), &scratch.displacement);
            if let Some(law) = &self.second_order {
                let own = second.energy(&self.part, law, at);
                return Energy { strain: strain + own.strain, ..own };
            }
            centre.enter(&self.part, at);
            self.part.momenta(scratch);
            let of_centre = self.part.total * centre.velocity().norm_squared();
            let kinetic = 0.5 * (dot(&scratch.velocity, &scratch.momentum) + of_centre);
            let node = &at.nodes[self.part.nodes[self.part.frame]].frame;
            let place = node.position + node.rotation.apply(&centre.place());
            let potential = -self.part.total * self.part.gravity.acceleration.dot(&place);
            Energy { kinetic, strain, potential }
        })
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities {
            deformation: Some(self),
            validity: Some(self),
            inertia: Some(self),
            ..Capabilities::default()
        }
    }
}

impl Deformable for Superelement {
    fn linearize_stressed(&self, at: &Kinematics, stressed: Stressed<'_>, out: &mut Tangents) {
        SCRATCH.with_borrow_mut(
            |ThreadScratch { own, stages: [other, _], centre, maps, derivatives, second, .. }| {
                other.enter(&self.part, stressed.at);
                self.part.stress(other);
                own.enter(&self.part, at);
                own.stress.copy_from_slice(&other.stress);
                maps.add_elastic_tangents(&self.part, own, out);
                if let Some(law) = &self.second_order {
                    second.add_tangents(&self.part, law, at, out);
                } else {
                    self.part.momenta(own);
                    maps.add_inertial_tangents(&self.part, own, out);
                    centre.enter(&self.part, at);
                    centre.add_tangents(&self.part, derivatives, out);
                }
            },
        );
    }

    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)> {
        let reach = self.part.reach();
        SCRATCH.with_borrow_mut(|ThreadScratch { own: scratch, .. }| {
            scratch.enter(&self.part, at);
            let rate = |i: usize| {
                let (linear, angular) = (three(&scratch.rate, 6 * i), three(&scratch.rate, 6 * i + 3));
                let linear = if reach > 0.0 { linear.norm() / reach } else { 0.0 };
                (linear + angular.norm(), self.part.nodes[i])
            };
            (0..self.part.nodes.len())
                .map(rate)
                .reduce(|most, rate| if rate.0 > most.0 { rate } else { most })
        })
    }

    fn max_relative_rotation(&self, at: &Kinematics) -> Option<(f64, [NodeId; 2])> {
        let quaternion = |node: NodeId| at.nodes[node].frame.rotation.quaternion();
        let frame = self.part.nodes[self.part.frame];
        let base = quaternion(frame);
        let others = self.part.nodes.iter().filter(|&&node| node != frame);
        let pairs = others.map(|&node| {
            let cosine: f64 = quaternion(node).iter().zip(base).map(|(a, b)| a * b).sum();
            (cosine, [frame, node])
        });
        pairs.reduce(|least, pair| if pair.0 < least.0 { pair } else { least })
    }
}

impl Validity for Superelement {
    fn limits(&self) -> &'static [LimitKind] {
        &[LimitKind::Deformation, LimitKind::Spin, LimitKind::Load, LimitKind::Moment, LimitKind::LeftOut]
    }

    fn limit(&self, kind: LimitKind, [_, at]: [&Kinematics; 2]) -> Option<Limit<'_>> {
        let used = |part: f64, node| Some(Limit { value: part, limit: 1.0, place: Place::Node(node) });
        let reach = self.part.reach();
        let frame = self.part.nodes[self.part.frame];
        let spin = split(&at.nodes[frame].twist).1;
        if kind == LimitKind::Spin {
            return used(spin.norm() / self.largest_spin?, frame);
        }
        SCRATCH.with_borrow_mut(|ThreadScratch { own: scratch, .. }| {
            scratch.enter(&self.part, at);
            if kind == LimitKind::LeftOut {
                let estimate = self.left_out.as_ref()?;
                product(&self.part.stiffness, &scratch.displacement, &mut scratch.stress);
                let share = estimate.share(&self.part, at, &scratch.stress)?;
                return used(share / MAX_ERROR, frame);
            }
            if kind != LimitKind::Deformation {
                let estimate = self.load_stiffness.as_ref()?;
                product(&self.part.stiffness, &scratch.displacement, &mut scratch.stress);
                let share = match kind {
                    LimitKind::Moment => {
                        estimate.share_of_moments(&self.part, (&scratch.displacement, &scratch.stress))?
                    }
                    // Second-order matrices include it.
                    _ if self.second_order.is_some() => return None,
                    _ => estimate.share(&self.part, (&scratch.displacement, &scratch.stress, &spin))?,
                };
                return used(share / MAX_SHARE, frame);
            }
            let deformed = |i: usize| {
                let (linear, angular) = (
                    three(&scratch.displacement, 6 * i).norm(),
                    three(&scratch.displacement, 6 * i + 3).norm(),
                );
                let by_length = if reach > 0.0 { linear / (MAX_DISPLACEMENT * reach) } else { 0.0 };
                (by_length.max(angular / MAX_ROTATION), self.part.nodes[i])
            };
            let most = |most: (f64, _), own: (f64, _)| if own.0 > most.0 { own } else { most };
            let (part, node) = (0..self.part.nodes.len()).map(deformed).reduce(most)?;
            used(part, node)
        })
    }
}

impl OwnInertia for Superelement {
    fn mass(&self, at: &Kinematics, out: &mut Vec<f64>) {
        SCRATCH.with_borrow_mut(|ThreadScratch { own, centre, maps, second, .. }| {
            if let Some(law) = &self.second_order {
                out.clear();
                out.resize(self.part.size() * self.part.size(), 0.0);
                second.add_mass(&self.part, law, at, out);
                return;
            }
            own.enter(&self.part, at);
            maps.mass(&self.part, own, out);
            centre.enter(&self.part, at);
            centre.add_mass(self.part.total, out);
        });
    }

    fn has_positive_mass(&self, at: &Kinematics) -> bool {
        // To first order the kinetic energy is a sum of squares.
        if self.second_order.is_none() {
            return true;
        }
        let mut matrix = SCRATCH.with_borrow_mut(|scratch| std::mem::take(&mut scratch.mass));
        self.mass(at, &mut matrix);
        let is_positive = is_positive_definite(&mut matrix, self.part.size());
        SCRATCH.with_borrow_mut(|scratch| scratch.mass = matrix);
        is_positive
    }
}
