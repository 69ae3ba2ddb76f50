//! Relative motion of joints at the start of a step, side by side in lanes.

use lissom_motion::{Block, Matrix3, Vector3, WIDTH};

use super::MAX_COORDINATES;

/// Values of all joints at the start of a step.
#[derive(Clone, Debug, Default)]
pub struct JointStarts(pub(super) Vec<Vec<StartBlock>>);

/// Values of eight joints at the start of a step.
#[derive(Clone, Debug)]
pub struct StartBlock {
    /// Relative rotation, column by column.
    pub(super) rotation: [Block; 9],
    /// Relative position in the tip's axes [m].
    pub(super) place: [Block; 3],
    /// Sine and cosine of coordinates that are angles.
    pub(super) angles: [[Block; 2]; MAX_COORDINATES],
}

impl StartBlock {
    pub(super) fn zeros() -> Self {
        let zeros = [0.0; WIDTH];
        Self { rotation: [zeros; 9], place: [zeros; 3], angles: [[zeros; 2]; MAX_COORDINATES] }
    }

    /// Relative rotation and position of one of the joints.
    pub(super) fn relative(&self, lane: usize) -> (Matrix3, Vector3) {
        let rotation = Matrix3::from_fn(|i, j| self.rotation[3 * j + i][lane]);
        let place = Vector3::from_fn(|i, _| self.place[i][lane]);
        (rotation, rotation * place)
    }
}
