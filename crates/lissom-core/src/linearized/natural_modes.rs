//! Natural modes of a linearised model, by Lanczos' or Arnoldi's method.

use num_complex::Complex64;

use super::lanczos::Found;
use super::mode::{Mode, ModeError, ModeOptions, Modes, OVERDAMPED};
use super::model::LinearModel;
use super::{arnoldi, lanczos};

impl LinearModel<'_> {
    /// Whether a mode is one of those asked for: first-order states add decays, often slower than all motions, which are found besides.
    pub fn counts(&self, mode: &Mode) -> bool {
        mode.damping < OVERDAMPED || self.system.layout().states().next().is_none()
    }

    /// Natural modes: real and counted if the model is conservative, otherwise complex.
    ///
    /// # Errors
    /// If the model has no mass or its matrices cannot be factorised.
    pub fn modes(&self, options: &ModeOptions) -> Result<Modes, ModeError> {
        if options.count == 0 {
            return Err(ModeError::NothingAsked {});
        }
        if self.parts.mass.iter().all(|&value| value == 0.0) {
            return Err(ModeError::NoMass {});
        }
        if !self.is_conservative() {
            return arnoldi::find(self, options);
        }
        let Found { pairs, completeness } = lanczos::find(self, options)?;
        let modes = pairs
            .into_iter()
            .map(|pair| {
                let root = pair.square.abs().sqrt();
                let eigenvalue = match pair.square {
                    square if square.abs() <= pair.round_off => Complex64::new(0.0, 0.0),
                    square if square < 0.0 => Complex64::new(root, 0.0),
                    _ => Complex64::new(0.0, root),
                };
                let shape = pair.shape.into_iter().map(Complex64::from).collect();
                Mode::new(eigenvalue, shape, pair.residual)
            })
            .collect();
        Ok(Modes { modes, completeness })
    }
}
