//! Superelement: a linear elastic part that is reduced to a few interfaces and modal coordinates, on a floating frame
//! [Géradin and Cardona 2001, ch. 9].
//!
//! Legend: interface i has the place x_i and the rotation R_i, and X_i in the undeformed part, whose interfaces have parallel
//! axes; f is the interface that carries the floating frame, q are the modal coordinates, E_i = R_fᵀ R_i.
//!
//! ```text
//! u = (r_i - X_i + X_f,  log E_i,  q),        r_i = R_fᵀ (x_i - x_f)                elastic energy  f₀·u + ½ u·K u
//! η = (E_i v_i,  E_i ω_i,  q̇),      v_i, ω_i twist in the node's axes    kinetic energy  ½ η·(M - GᵀG/m) η + ½ m |ẋ_c|²
//! G = Tᵀ M,  T translations,  x_c centre of mass as G u displaces it (see `centre`)       weight  -m g·x_c
//! ```
//!
//! Interfaces are nodes and modal coordinates are coordinates: there is no further constraint. With matrices that know the
//! rigid motions the inertia of a rigid motion is exact. K acts on the relative motion alone, so that nothing changes when
//! the element moves rigidly. What is left out is of the square of the rate of rotation over the frequencies of the modes; where
//! second-order matrices are given, `second_order` has another kinetic energy in place of this one.
//!
//! Without the second term of the kinetic energy a part that moves fast and turns would be bent by that: η counts in turning
//! axes, and displacements of modal coordinates do not turn with them.
//!
//! With p = (M - GᵀG/m) η, the equations of motion of the kinetic energy in body axes (Poincaré's) are
//!
//! ```text
//! force on i   E_iᵀ (ṗ_i + ω_f × p_i),     moment on i   E_iᵀ (ṗ_i + (ω_f - E_i ω_i) × p_i),     on q   ṗ_q
//! moment on f, besides:   Σ (E_i v_i) × p_i + (E_i ω_i) × p_i    with p_i of force, and of moment
//! ```

mod build;
mod centre;
mod deformation;
mod geometric;
mod left_out;
mod linearize;
mod load_stiffness;
mod matrices;
mod relative;
mod room;
mod second_order;
mod step_stages;
mod turning;

use std::cell::RefCell;

use lissom_motion::Vector3;
use nalgebra::{DMatrix, DVector, Matrix3xX};

pub use self::build::{InterfacePlace, SuperelementDescription, add_superelement};
use self::centre::{Centre, Derivatives};
pub use self::deformation::Deformation;
pub(crate) use self::geometric::PAIRS;
pub use self::geometric::{GeometricMatrices, Shortening, TurningMatrices};
use self::left_out::{LARGEST_ERROR, LeftOut};
use self::linearize::Maps;
pub(crate) use self::load_stiffness::flexibility;
use self::load_stiffness::{LARGEST_SHARE, LoadStiffness};
pub(crate) use self::matrices::rigid_column;
pub use self::matrices::{Damping, ReducedMatrices};
use self::matrices::{RigidMotion, rigid_motion};
use self::room::{Room, product};
use self::second_order::{Deformed, SecondOrder};
use super::inertia::Gravity;
use super::{Element, Energy, LinearLimit, LinearRange, Tangents};
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CoordinateId, Kinematics, NodeId, split};

/// Elastic rotation of an interface against the floating frame from which on a warning reports it [rad]: forces that grow by the square
/// of the rotation are a few hundredths of the others.
pub const LARGEST_ROTATION: f64 = 0.2;
/// Elastic displacement of an interface from which on it does, as part of its distance from the floating frame.
pub const LARGEST_DISPLACEMENT: f64 = 0.15;

/// Rate of rotation from which on the stiffness by centrifugal forces is missed, over the first natural frequency with the
/// floating interface held: its square is the part of the stiffness.
pub const LARGEST_SPIN: f64 = 0.25;
/// The same with matrices that know it, to first order in the square.
pub const LARGEST_SPIN_KNOWN: f64 = 1.0;

/// A reduced part.
#[derive(Clone, Debug)]
pub struct Superelement {
    nodes: Vec<NodeId>,
    coordinates: Vec<CoordinateId>,
    /// The interface that carries the floating frame.
    frame: usize,
    /// X_i - X_f [m].
    places: Vec<Vector3>,
    /// M less GᵀG/m.
    mass: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    damping: Option<DMatrix<f64>>,
    /// f₀.
    preload: DVector<f64>,
    /// m, and m c from the interface f.
    total: f64,
    moment: Vector3,
    /// G.
    carried: Matrix3xX<f64>,
    gravity: Gravity,
    /// Rate of rotation up to which matrices are believed [rad/s]; none where nothing swings.
    largest_spin: Option<f64>,
    /// What estimates how loads change the stiffness; none where nobody asks.
    load_stiffness: Option<LoadStiffness>,
    /// What estimates the forces of modes that are left out; none where nobody asks.
    left_out: Option<LeftOut>,
    /// What is of second order in the deformation, where the matrices know it.
    second_order: Option<Box<SecondOrder>>,
}

/// Room of this thread, so that nothing is allocated once it is large enough.
#[derive(Default)]
struct Rooms {
    own: Room,
    stages: [Room; STAGES],
    centre: Centre,
    maps: Maps,
    derivatives: Derivatives,
    second: Deformed,
    mass: Vec<f64>,
}

thread_local! {
    static ROOMS: RefCell<Rooms> = RefCell::default();
}

impl Superelement {
    /// The element between `nodes`, whose places in the undeformed part are `places` [m], with the modal `coordinates`;
    /// interface `frame` carries the floating frame. The matrices are taken as they are: see [`ReducedMatrices::check`].
    pub fn new(
        (nodes, coordinates): (Vec<NodeId>, Vec<CoordinateId>),
        (frame, places): (usize, &[Vector3]),
        matrices: ReducedMatrices,
        gravity: Gravity,
    ) -> Self {
        let places: Vec<Vector3> = places.iter().map(|place| place - places[frame]).collect();
        let RigidMotion { total, moment, carried, .. } = rigid_motion(&matrices.mass, &places);
        let ReducedMatrices { mass, stiffness, damping, preload, geometric } = matrices;
        let damping = match damping {
            Damping::None => None,
            Damping::Matrix(matrix) => Some(matrix),
            Damping::OfStiffness(time) => Some(&stiffness * time),
        };
        let size = mass.nrows();
        let whole = geometric.is_some().then(|| mass.clone());
        // What is left of the mass without that of the centre sees no translation.
        let mass = mass - carried.tr_mul(&carried) / total;
        let preload = if preload.is_empty() { DVector::zeros(size) } else { DVector::from_vec(preload) };
        let mut element = Self {
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
            largest_spin: None,
            load_stiffness: None,
            left_out: None,
            second_order: None,
        };
        element.second_order =
            geometric.zip(whole).map(|(own, mass)| Box::new(SecondOrder::of(&element, &mass, &own)));
        element
    }

    /// With a rate of rotation from which on a warning is reported [rad/s], and with one of loads that change the stiffness.
    #[must_use]
    pub fn believed_up_to(self, spin: Option<f64>) -> Self {
        let load_stiffness = Some(LoadStiffness::of(&self));
        let left_out = LeftOut::of(&self);
        Self { largest_spin: spin, load_stiffness, left_out, ..self }
    }

    fn size(&self) -> usize {
        6 * self.nodes.len() + self.coordinates.len()
    }

    /// K u + D u̇ + f₀.
    fn stress(&self, room: &mut Room) {
        room.stress.copy_from_slice(self.preload.as_slice());
        product(&self.stiffness, &room.displacement, &mut room.stress);
        if let Some(damping) = &self.damping {
            product(damping, &room.rate, &mut room.stress);
        }
    }

    /// Adds forces that are conjugate to u: by the transposed gradient of u.
    fn add_conjugate(&self, room: &Room, stress: &[f64], out: &mut [f64]) {
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for i in (0..self.nodes.len()).filter(|&i| i != self.frame) {
            let (f, m) = (three(stress, 6 * i), three(stress, 6 * i + 3));
            let own = room.inverse_tangents[i].tr_mul(&m);
            add(out, 6 * i, &room.turns[i].tr_mul(&f));
            add(out, 6 * i + 3, &own);
            force -= f;
            moment -= room.arms[i].cross(&f) + room.turns[i] * own;
        }
        add(out, 6 * self.frame, &force);
        add(out, 6 * self.frame + 3, &moment);
        for k in 6 * self.nodes.len()..self.size() {
            out[k] += stress[k];
        }
    }

    /// Adds what inertia and weight need besides the forces conjugate to u.
    fn add_inertia(&self, at: &Kinematics, room: &mut Room, centre: &mut Centre, out: &mut [f64]) {
        centre.enter(self, at);
        self.momenta(room);
        let mut on_frame = Vector3::zeros();
        for i in 0..self.nodes.len() {
            let (p, l) = (three(&room.momentum, 6 * i), three(&room.momentum, 6 * i + 3));
            let (v, w) = (three(&room.velocity, 6 * i), three(&room.velocity, 6 * i + 3));
            let [force, moment] = room.inertial(i);
            add(out, 6 * i, &room.turns[i].tr_mul(&force));
            add(out, 6 * i + 3, &room.turns[i].tr_mul(&moment));
            on_frame += v.cross(&p) + w.cross(&l);
        }
        add(out, 6 * self.frame + 3, &on_frame);
        for k in 6 * self.nodes.len()..self.size() {
            out[k] += room.inertia[k];
        }
        centre.add_forces(self.total, out);
    }

    /// Momentum, and the inertial forces before they are turned.
    fn momenta(&self, room: &mut Room) {
        room.momentum.fill(0.0);
        room.inertia.fill(0.0);
        product(&self.mass, &room.velocity, &mut room.momentum);
        product(&self.mass, &room.acceleration, &mut room.inertia);
    }

    /// The largest distance of an interface from the floating frame [m].
    fn reach(&self) -> f64 {
        self.places.iter().map(Vector3::norm).fold(0.0, f64::max)
    }
}

/// Three numbers of a vector.
fn three(values: &[f64], first: usize) -> Vector3 {
    Vector3::new(values[first], values[first + 1], values[first + 2])
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

/// Adds to three numbers of a vector.
fn add(values: &mut [f64], first: usize, vector: &Vector3) {
    for k in 0..3 {
        values[first + k] += vector[k];
    }
}

impl Element for Superelement {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinates
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        ROOMS.with_borrow_mut(|Rooms { own: room, centre, second, .. }| {
            room.enter(self, at);
            self.stress(room);
            self.add_conjugate(room, &room.stress, out);
            if let Some(law) = &self.second_order {
                second.add_forces(self, law, at, out);
            } else {
                self.add_inertia(at, room, centre, out);
            }
        });
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        ROOMS.with_borrow_mut(|Rooms { own, stages, centre, second, .. }| {
            self.add_stage_forces(step, (own, stages, centre), out);
            if let Some(law) = &self.second_order {
                for (at, out) in step.stages.iter().zip(out) {
                    second.add_forces(self, law, at, out);
                }
            }
        });
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.linearize_stressed(at, at, out);
    }

    fn linearize_stressed(&self, at: &Kinematics, stressed: &Kinematics, out: &mut Tangents) {
        ROOMS.with_borrow_mut(
            |Rooms { own, stages: [other, _], centre, maps, derivatives, second, .. }| {
                other.enter(self, stressed);
                self.stress(other);
                own.enter(self, at);
                own.stress.copy_from_slice(&other.stress);
                maps.add_elastic_tangents(self, own, out);
                if let Some(law) = &self.second_order {
                    second.add_tangents(self, law, at, out);
                } else {
                    self.momenta(own);
                    maps.add_inertial_tangents(self, own, out);
                    centre.enter(self, at);
                    centre.add_tangents(self, derivatives, out);
                }
            },
        );
    }

    fn mass(&self, at: &Kinematics, out: &mut Vec<f64>) {
        ROOMS.with_borrow_mut(|Rooms { own, centre, maps, second, .. }| {
            if let Some(law) = &self.second_order {
                out.clear();
                out.resize(self.size() * self.size(), 0.0);
                second.add_mass(self, law, at, out);
                return;
            }
            own.enter(self, at);
            maps.mass(self, own, out);
            centre.enter(self, at);
            centre.add_mass(self.total, out);
        });
    }

    fn has_positive_mass(&self, at: &Kinematics) -> bool {
        // To first order it is a sum of squares.
        if self.second_order.is_none() {
            return true;
        }
        let mut matrix = ROOMS.with_borrow_mut(|rooms| std::mem::take(&mut rooms.mass));
        self.mass(at, &mut matrix);
        let is_positive = is_positive_definite(&mut matrix, self.size());
        ROOMS.with_borrow_mut(|rooms| rooms.mass = matrix);
        is_positive
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        ROOMS.with_borrow_mut(|Rooms { own: room, centre, second, .. }| {
            room.enter(self, at);
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            product(&self.stiffness, &room.displacement, &mut room.stress);
            let strain = 0.5 * dot(&room.stress, &room.displacement)
                + dot(self.preload.as_slice(), &room.displacement);
            if let Some(law) = &self.second_order {
                let own = second.energy(self, law, at);
                return Energy { strain: strain + own.strain, ..own };
            }
            centre.enter(self, at);
            self.momenta(room);
            let of_centre = self.total * centre.velocity().norm_squared();
            let kinetic = 0.5 * (dot(&room.velocity, &room.momentum) + of_centre);
            let node = &at.nodes[self.nodes[self.frame]].frame;
            let place = node.position + node.rotation.apply(&centre.place());
            let potential = -self.total * self.gravity.acceleration.dot(&place);
            Energy { kinetic, strain, potential }
        })
    }

    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)> {
        let reach = self.reach();
        ROOMS.with_borrow_mut(|Rooms { own: room, .. }| {
            room.enter(self, at);
            let rate = |i: usize| {
                let (linear, angular) = (three(&room.rate, 6 * i), three(&room.rate, 6 * i + 3));
                let linear = if reach > 0.0 { linear.norm() / reach } else { 0.0 };
                (linear + angular.norm(), self.nodes[i])
            };
            (0..self.nodes.len()).map(rate).reduce(|most, rate| if rate.0 > most.0 { rate } else { most })
        })
    }

    fn least_aligned(&self, at: &Kinematics) -> Option<(f64, [NodeId; 2])> {
        let quaternion = |node: NodeId| at.nodes[node].frame.rotation.quaternion();
        let frame = self.nodes[self.frame];
        let base = quaternion(frame);
        let others = self.nodes.iter().filter(|&&node| node != frame);
        let pairs = others.map(|&node| {
            let cosine: f64 = quaternion(node).iter().zip(base).map(|(a, b)| a * b).sum();
            (cosine, [frame, node])
        });
        pairs.reduce(|least, pair| if pair.0 < least.0 { pair } else { least })
    }

    fn linear_range(&self, limit: LinearLimit, at: &Kinematics) -> Option<LinearRange> {
        let reach = self.reach();
        let frame = self.nodes[self.frame];
        let spin = split(&at.nodes[frame].twist).1;
        if limit == LinearLimit::Spin {
            return self.largest_spin.map(|most| LinearRange { part: spin.norm() / most, node: frame });
        }
        ROOMS.with_borrow_mut(|Rooms { own: room, .. }| {
            room.enter(self, at);
            if limit == LinearLimit::LeftOut {
                let share = self.share_left_out(at, (&room.displacement, &mut room.stress))?;
                return Some(LinearRange { part: share / LARGEST_ERROR, node: frame });
            }
            if limit != LinearLimit::Deformation {
                let estimate = self.load_stiffness.as_ref()?;
                product(&self.stiffness, &room.displacement, &mut room.stress);
                let share = match limit {
                    LinearLimit::Moment => {
                        estimate.share_of_moments(self, (&room.displacement, &room.stress))?
                    }
                    // Matrices of second order know it.
                    _ if self.second_order.is_some() => return None,
                    _ => estimate.share(self, (&room.displacement, &room.stress, &spin))?,
                };
                return Some(LinearRange { part: share / LARGEST_SHARE, node: frame });
            }
            let deformed = |i: usize| {
                let (linear, angular) =
                    (three(&room.displacement, 6 * i).norm(), three(&room.displacement, 6 * i + 3).norm());
                let by_length = if reach > 0.0 { linear / (LARGEST_DISPLACEMENT * reach) } else { 0.0 };
                let part = by_length.max(angular / LARGEST_ROTATION);
                LinearRange { part, node: self.nodes[i] }
            };
            (0..self.nodes.len())
                .map(deformed)
                .reduce(|most, own| if own.part > most.part { own } else { most })
        })
    }
}
