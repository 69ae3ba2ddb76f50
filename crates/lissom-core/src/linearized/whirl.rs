//! Whirl of a mode about the axis of rotation: from the shape in rotating axes to the motion in axes at rest.
//!
//! With e₁, e₂, e₃ = axis and displacements d, z = d₁ + i d₂ moves in rotating axes as
//!
//! ```text
//! z = ½ (d₁ + i d₂) e^{iωt} + ½ (d₁ - i d₂)* e^{-iωt}
//! ```
//!
//! forward with rate ω and backward with rate -ω; in axes at rest the rate of rotation is added to both.

use lissom_motion::Vector3;
use num_complex::Complex64;

use super::mode::Mode;
use super::model::LinearModel;
use crate::round_off;

/// If the forward and backward parts differ by less than this, the orbit is an ellipse, with two frequencies in axes
/// at rest.
const CIRCULAR: f64 = 0.999;

/// Whirl of a mode in axes at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Whirl {
    /// Motion along the axis or about it, or no rotation.
    None,
    /// A circle in the sense of the rotation, with this frequency in axes at rest [Hz]; for a mode computed in axes at rest also
    /// an ellipse.
    Forward(f64),
    /// A circle against the rotation, or an ellipse, likewise.
    Backward(f64),
    /// An ellipse in rotating axes: two frequencies in axes at rest.
    Mixed,
}

impl Whirl {
    /// Name of the whirl in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Forward(_) => "forward",
            Self::Backward(_) => "backward",
            Self::Mixed => "mixed",
        }
    }
}

impl LinearModel<'_> {
    /// Whirl of a mode in axes at rest.
    pub fn whirl(&self, mode: &Mode) -> Whirl {
        let spin = self.spin();
        let rate = spin.norm();
        if rate == 0.0 {
            return Whirl::None;
        }
        if let Some(generator) = self.generator() {
            let sense = self.sense_at_rest(generator, mode);
            return match sense {
                _ if sense.abs() <= round_off::NEGLIGIBLE => Whirl::None,
                _ if sense > 0.0 => Whirl::Forward(mode.frequency),
                _ => Whirl::Backward(mode.frequency),
            };
        }
        let axis = spin / rate;
        let other = Vector3::ith(axis.iamin(), 1.0);
        let first = axis.cross(&other).normalize();
        let second = axis.cross(&first);
        let length = self.length();
        let (mut forward, mut backward, mut whole) = (0.0, 0.0, 0.0);
        for (node, shape) in self.at.nodes.iter().skip(1).zip(self.shape(mode)) {
            if node.angular_velocity() == Vector3::zeros() {
                continue;
            }
            for (vector, unit) in [(shape.displacement, 1.0), (shape.rotation, length)] {
                let along = |direction: &Vector3| -> Complex64 {
                    vector.iter().zip(direction).map(|(value, factor)| value * *factor * unit).sum()
                };
                let (one, two) = (along(&first), along(&second));
                forward += (one + Complex64::i() * two).norm_sqr();
                backward += (one - Complex64::i() * two).norm_sqr();
                whole += vector.iter().map(|value| value.norm_sqr() * unit * unit).sum::<f64>();
            }
        }
        if forward + backward <= round_off::NEGLIGIBLE * whole {
            return Whirl::None;
        }
        let sense = (forward - backward) / (forward + backward);
        if sense.abs() < CIRCULAR {
            return Whirl::Mixed;
        }
        let seen = rate + sense.signum() * mode.eigenvalue.im;
        let frequency = seen.abs() / std::f64::consts::TAU;
        if seen >= 0.0 { Whirl::Forward(frequency) } else { Whirl::Backward(frequency) }
    }
}
