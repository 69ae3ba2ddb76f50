//! The gap of a ball and another part on their way through a step, which a gap of the start that is continued along its normal misses: a
//! ball that passes by does not touch, and one that meets the other part in the middle of the step has another normal there.
//!
//! Legend: φ gap, u relative velocity at the point, h step size.
//!
//! ```text
//! φ of the start ← φ(τ) - τ u_n(τ)      with the axes and the arms of the instant τ of the least gap or of the first touch
//! ```

use lissom_motion::{Motion, Rotation, Vector3};

use super::touch_point::Place;
use crate::contact::forms::Meeting;
use crate::contact::set::placed;
use crate::kinematics::{GROUND, Kinematics, NodeId, split};

/// Largest number of gaps on a path.
const MAX_GAPS: usize = 60;
/// Gap over the path below which the parts touch.
const TOUCHES: f64 = 1e-5;

/// The free motion of two parts in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct FreePath {
    frames: [Motion; 2],
    /// Velocities and angular velocities, in inertial axes; the latter in those of the body, too.
    twists: [[Vector3; 2]; 2],
    spins: [Vector3; 2],
    size: f64,
}

/// An instant of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Encounter {
    /// Since the start of the step [s].
    pub(super) time: f64,
    /// Whether the parts touch there.
    pub(super) touches: bool,
}

impl FreePath {
    /// Path of the parts with these nodes in a step of `size` [s] under gravity [m/s²].
    pub(super) fn of(nodes: [NodeId; 2], (start, gravity): (&Kinematics, Vector3), size: f64) -> Self {
        let motion = |node: NodeId| {
            let own = &start.nodes[node];
            let (velocity, spin) = split(&own.twist);
            let fall = if node == GROUND { Vector3::zeros() } else { size * gravity };
            ([own.frame.rotation.apply(&velocity) + fall, own.frame.rotation.apply(&spin)], spin)
        };
        let both = nodes.map(motion);
        let frames = nodes.map(|node| start.nodes[node].frame);
        Self { frames, twists: both.map(|own| own.0), spins: both.map(|own| own.1), size }
    }

    /// Length of the relative path of two points that coincide at `place` [m].
    pub(super) fn length(&self, meeting: &Meeting, place: &Place) -> f64 {
        self.size * place.relative_velocity(meeting, self.twists).norm()
    }

    fn frames_at(&self, time: f64) -> [Motion; 2] {
        [0, 1].map(|k| {
            let Motion { rotation, position } = self.frames[k];
            let turn = Rotation::exponential(&(time * self.spins[k]));
            Motion::new(rotation * turn, position + time * self.twists[k][0])
        })
    }

    /// The first touch of a path of this `length` [m] from a `gap` [m], or the least gap.
    pub(super) fn first_touch(&self, meeting: &Meeting, (gap, length): (f64, f64)) -> Encounter {
        // No gap closes faster.
        let speed = length / self.size * 1.05;
        let mut least = (gap, 0.0);
        let (mut time, mut own) = (0.0, gap);
        for _ in 0..MAX_GAPS {
            if own <= TOUCHES * length {
                return Encounter { time, touches: true };
            }
            time += (own / speed).max(TOUCHES * self.size);
            if time >= self.size {
                break;
            }
            let (_, tip) = placed(meeting, self.frames_at(time));
            own = meeting.pair.value(&tip.position, &tip.rotation.matrix());
            if own < least.0 {
                least = (own, time);
            }
        }
        Encounter { time: least.1, touches: false }
    }

    /// The point at an instant, with the gap at the start that leads to that of the instant along its normal.
    pub(super) fn place_at(&self, meeting: &Meeting, time: f64) -> Option<Place> {
        let mut place = Place::of(meeting, self.frames_at(time), f64::INFINITY)?;
        place.gap -= time * place.relative_velocity(meeting, self.twists).z;
        Some(place)
    }
}
