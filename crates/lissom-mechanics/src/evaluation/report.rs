//! Numbers that elements report besides forces and energy.

use crate::kinematics::Kinematics;
use crate::signals::measurement::{Gradient, MAX_COMPONENTS};

/// Elements with numbers of their own, such as the slip of a tyre. The output with these words records them.
pub trait Report {
    /// Their words and units, at most [`MAX_COMPONENTS`].
    fn words(&self) -> &'static [(&'static str, &'static str)];

    /// The numbers, in the order of the words.
    fn numbers(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS];

    /// Their derivatives with respect to the local unknowns.
    fn gradients(&self, at: &Kinematics) -> [Gradient; MAX_COMPONENTS];
}
