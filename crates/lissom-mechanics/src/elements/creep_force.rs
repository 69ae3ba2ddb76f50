//! Forces of rolling contact between wheel and rail, by the law of [`CreepLaw`]. The normal force is the multiplier of the joint
//! that keeps wheel and rail in contact.

use lissom_motion::{Matrix6, Vector6, lie_bracket_matrix};
use nalgebra::{SMatrix, SVector};

use super::{Capabilities, Element, Load, Tangents, Unknowns};
use crate::dual::{Dual, Number};
use crate::joints::frame_pair::{FramePair, RelativeMotion};
use crate::kinematics::local_derivatives::LocalDerivatives;
use crate::kinematics::{CarriedFrame, Kinematics};
use crate::wheels::CreepLaw;
use crate::wheels::creep_law::Creep;
use crate::wheels::wheel_on_rail::{Pose, RailContact};

/// Derivatives of a force: with respect to the tip's variation, its twist relative to the base, and the normal force.
const DIRECTIONS: usize = 13;

/// A wheel with creep forces on a rail.
#[derive(Clone, Debug)]
pub struct CreepForce {
    frames: FramePair,
    multipliers: [usize; 1],
    contact: RailContact,
    law: CreepLaw,
}

impl CreepForce {
    /// Between a joint's frames, with the joint's multiplier.
    pub fn new(frames: [CarriedFrame; 2], multiplier: usize, contact: RailContact, law: CreepLaw) -> Self {
        Self { frames: FramePair::new(frames), multipliers: [multiplier], contact, law }
    }

    /// Creep at this normal force.
    pub fn creep(&self, at: &Kinematics, normal_force: f64) -> Creep<f64> {
        self.creep_of(&self.frames.motion(at), normal_force)
    }

    /// Wrench on the tip in the tip's joint frame [N, N m].
    pub fn wrench(&self, at: &Kinematics, normal_force: f64) -> Vector6 {
        Vector6::from_column_slice(&self.creep(at, normal_force).wrench)
    }

    fn creep_of(&self, motion: &RelativeMotion, normal_force: f64) -> Creep<f64> {
        let pose = Pose::new(&motion.rotation, &motion.position);
        let place = self.contact.place(&pose).place;
        self.law.creep(&self.contact, (&pose, &place), &motion.twist.into(), normal_force)
    }

    /// The multiplier is the force that pulls the wheel to the rail.
    fn normal_force(&self, at: &Kinematics) -> f64 {
        at.multipliers.get(self.multipliers[0]).map_or(0.0, |pull| -pull)
    }
}

impl Element for CreepForce {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.frames.nodes, multipliers: &self.multipliers, ..Unknowns::default() }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let motion = self.frames.motion(at);
        let creep = self.creep_of(&motion, self.normal_force(at));
        self.frames.add_wrench(&motion, &-Vector6::from_column_slice(&creep.wrench), out);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.linearize_pressed(at, self.normal_force(at), out);
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl Load for CreepForce {}

impl CreepForce {
    /// The derivatives of its forces at this normal force; the multiplier is the last local unknown.
    pub(crate) fn linearize_pressed(&self, at: &Kinematics, normal_force: f64, out: &mut Tangents) {
        let motion = self.frames.motion(at);
        if normal_force <= 0.0 {
            return;
        }
        let pose = Pose::new(&motion.rotation, &motion.position);
        let varied = pose.varied::<DIRECTIONS>();
        let place = self.contact.varied_place(&pose, &varied);
        let twist: [Dual<DIRECTIONS>; 6] = std::array::from_fn(|k| Dual::variable(motion.twist[k], 6 + k));
        let pressed = Dual::variable(normal_force, 12);
        // On the left-hand side.
        let wrench =
            self.law.creep(&self.contact, (&varied, &place), &twist, pressed).wrench.map(|value| -value);
        let by_rate = Matrix6::from_fn(|i, j| wrench[i].by[6 + j]);
        // Changes of the relative twist at fixed twists of the nodes: δη̇ = -ad(A V_base) η.
        let by_place =
            Matrix6::from_fn(|i, j| wrench[i].by[j]) - by_rate * lie_bracket_matrix(&motion.carried);
        let values = Vector6::from_fn(|i, _| wrench[i].value);
        let size = out.size();
        self.frames.add_stiffness(&motion, (&values, &by_place), (size, &mut out.stiffness));
        self.frames.add_damping(&motion, &by_rate, (size, &mut out.damping));
        let mut column = [0.0; 12];
        self.frames.add_wrench(&motion, &Vector6::from_fn(|i, _| -wrench[i].by[12]), &mut column);
        out.add_by_multiplier(&column);
    }
}

/// Derivatives of the numbers of a contact between frames at this normal force, of which the multiplier is the negative one:
/// positions on wheel and rail, shift angle, normal force, creep forces and creepages.
pub(crate) fn contact_derivatives(
    frames: [CarriedFrame; 2],
    (contact, law): (&RailContact, Option<&CreepLaw>),
    at: &Kinematics,
    normal_force: f64,
) -> LocalDerivatives<9> {
    let pair = FramePair::new(frames);
    let motion = pair.motion(at);
    let pose = Pose::new(&motion.rotation, &motion.position);
    let varied = pose.varied::<DIRECTIONS>();
    let place = contact.varied_place(&pose, &varied);
    let pressed = Dual::variable(normal_force, 12);
    let shift = contact.shift_angle(&varied, place.along);
    let mut values = [Dual::constant(0.0); 9];
    values[..4].copy_from_slice(&[place.along, place.on_rail, shift, pressed]);
    if let Some(law) = law {
        let twist: [Dual<DIRECTIONS>; 6] = std::array::from_fn(|k| Dual::variable(motion.twist[k], 6 + k));
        let creep = law.creep(contact, (&varied, &place), &twist, pressed);
        values[4..6].copy_from_slice(&creep.forces);
        values[6..].copy_from_slice(&creep.creepages);
    }
    let mut out = LocalDerivatives::zero(frames.map(|frame| frame.node).to_vec(), Vec::new(), 1);
    let by_rate = SMatrix::<f64, 9, 6>::from_fn(|i, j| values[i].by[6 + j]);
    // Changes of the relative twist at fixed twists of the nodes: δη̇ = -ad(A V_base) η.
    let by_place =
        SMatrix::<f64, 9, 6>::from_fn(|i, j| values[i].by[j]) - by_rate * lie_bracket_matrix(&motion.carried);
    for (side, columns) in pair.columns(&motion).iter().enumerate() {
        for k in 0..6 {
            out.by_place[6 * side + k] = by_place * columns.column(k);
            out.by_rate[6 * side + k] = by_rate * columns.column(k);
        }
    }
    out.by_multiplier[0] = SVector::from_fn(|i, _| -values[i].by[12]);
    out
}
