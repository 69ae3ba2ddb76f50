//! Angles about an axis that go on beyond half a turn.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use lissom_mechanics::kinematics::{CarriedFrame, GROUND, Kinematics};
use lissom_motion::{Rotation, Vector3};
use lissom_system::accumulated::{AcceptedStep, Accumulated};

use super::frames::{carried_frame, location_of};
use super::location::Location;
use super::{Build, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const ANGLE: Declaration = Declaration {
    word: "angle",
    summary: "Rotation angle of a node about an axis since the start, continuous beyond half a revolution.",
    subject: Subject::Node,
    features: &[Feature::AngleAxis, Feature::Observer, Feature::Accumulated],
    components: &[("angle", "rad")],
    build: Build::Accumulated(|output, _, subjects| angle(output, subjects)),
};
fn angle(output: &Output, subjects: &Subjects<'_>) -> Result<Arc<dyn Accumulated>, Problem> {
    let location = location_of(output, subjects)?;
    let start = location.motion(subjects.start).frame;
    let observer = output.relative_to.as_ref().map(|node| carried_frame(node, subjects.names)).transpose()?;
    let observer = observer.unwrap_or(CarriedFrame::of_node(GROUND));
    let own = observer.frame(subjects.start).rotation;
    let axis = output.axis.unwrap_or_else(Vector3::z);
    let axis = observer.frame(subjects.drawn).rotation.apply_inverse(&axis).normalize();
    let start = own.inverse() * start.rotation;
    Ok(Arc::new(AngleAboutAxis { name: output.name.value.clone(), location, observer, axis, start }))
}

/// Cosine of half the angle by which the axis may at most be turned for the angle about it to have a meaning.
const MIN_COSINE: f64 = 1e-3;

/// Angle of a node about an axis, continued from step to step. With the unit quaternion (q0, q) of the rotation since the
/// start and the axis n:
///
/// ```text
/// tan (φ/2) = q·n / q0
/// ```
///
/// This is the angle of the turn about n that is left when the shortest turn of n itself is taken away. The whole turns are those
/// that the angular velocity gives.
struct AngleAboutAxis {
    name: String,
    location: Location,
    observer: CarriedFrame,
    /// In the observer's axes.
    axis: Vector3,
    /// Rotation of the node in the observer's axes at the start.
    start: Rotation,
}

/// Where a node is turned, in the observer's axes.
struct Turned {
    /// Parts of the quaternion: the scalar, and the rest.
    scalar: f64,
    vector: Vector3,
    /// Angular velocity about the axis [rad/s].
    rate: f64,
}

impl AngleAboutAxis {
    fn turned(&self, at: &Kinematics) -> Turned {
        let own = self.observer.frame(at).rotation;
        let node = self.location.motion(at);
        let [scalar, x, y, z] = (own.inverse() * node.frame.rotation * self.start.inverse()).quaternion();
        let relative = node.angular_velocity() - at.nodes[self.observer.node].angular_velocity();
        let rate = self.axis.dot(&own.apply_inverse(&relative));
        Turned { scalar, vector: Vector3::new(x, y, z), rate }
    }

    /// Cosine of half the angle by which the axis itself is turned.
    fn cosine(&self, turned: &Turned) -> f64 {
        self.axis.dot(&turned.vector).hypot(turned.scalar)
    }
}

impl Accumulated for AngleAboutAxis {
    fn name(&self) -> &str {
        &self.name
    }

    fn after(&self, step: &AcceptedStep<'_>, before: f64) -> f64 {
        let [start, end] = [step.start, step.end].map(|state| self.turned(&state.kinematics));
        // Half the angle between both ends: where the axis is as close to half a turn, it may have passed it in between.
        let between = (start.scalar * end.scalar + start.vector.dot(&end.vector)).abs().min(1.0).acos();
        if self.cosine(&start).min(self.cosine(&end)) <= between.sin().max(MIN_COSINE) {
            return f64::NAN;
        }
        let angle = 2.0 * self.axis.dot(&end.vector).atan2(end.scalar);
        // In load steps nothing moves in time.
        let is_motion = step.within.is_some();
        let predicted = if is_motion { 0.5 * step.duration() * (start.rate + end.rate) } else { 0.0 };
        let missed = angle - before - predicted;
        let missed = missed - TAU * (missed / TAU).round();
        if missed.abs() <= FRAC_PI_2 { before + predicted + missed } else { f64::NAN }
    }
}
