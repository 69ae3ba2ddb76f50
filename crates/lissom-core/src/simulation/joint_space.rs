//! Motion in joint coordinates: the rates of independent joint coordinates z determine all velocities. The velocities of a free body, in
//! its axes, are such rates, too: those of the base of a robot that floats.
//!
//! Legend: M mass, B gradient of the constraints c, f forces without accelerations, E unit vectors of the rows of z, τ forces on z.
//!
//! ```text
//! v = T ż + w,    Eᵀ T = 1,    H z̈ + h = τ,    H = Tᵀ M T
//! [M Bᵀ; B 0] [X; ·] = [E; 0]                                    X = T H⁻¹, hence H⁻¹ = Eᵀ X and T = X H
//! [M Bᵀ; B 0] [w + T ż₀; ·] = [0; -∂c/∂t]                        ż₀ the rates of z in this solution
//! [M Bᵀ; B 0] [a; λ] = [-f; -(Ḃ v + ∂²c/∂t²)]                    h = -H Eᵀ a
//! ```
//!
//! Parts that neither constraints nor inertias couple with z do not contribute: their columns of T are zero.
//! Closed loops need no special treatment. H⁻¹ is the acceleration per unit force; it is singular if coordinates depend on each other.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::consistent::initial_conditions::{ConsistentInitialConditions, Inertias, scatter_rates};
use crate::consistent::mobility::{coupled_freedoms, mobility};
use crate::diagnostics::diagnostics;
use crate::errors::InitialError;
use crate::integrator::pivoting_unless_augmented;
use crate::kinematics::Subject;
use crate::round_off;
use crate::scaling::Representative;
use crate::settings::Settings;
use crate::system::{State, System};

/// Smallest pivot of H⁻¹, relative to its diagonal, of independent coordinates.
const DEPENDENT: f64 = 1e-10;

diagnostics! {
    /// Joint coordinates that do not describe the motion.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure JointSpaceError {
        /// The number of joint coordinates differs from that of the degrees of freedom.
        Number {
            /// Number of coordinates.
            coordinates: usize,
            /// Number of degrees of freedom of the parts that joints connect with them.
            freedoms: usize,
        } => "joint-space-number" {
            cause: ("the parts that joints connect with them have {freedoms} degrees of freedom, but {coordinates} joint coordinates \
                     were chosen"),
            remedy: "choose as many independent joint coordinates as these parts have degrees of freedom",
            meaning: "The rates of the chosen joint coordinates do not determine the velocities of the parts that joints connect with \
                      them, or are not independent.",
            advice: "Choose all independent coordinates of these parts, and the name of a free body among them for the six of a robot \
                     that floats. Parts that no joint connects with them need none; an arm with a beam has more degrees of freedom than \
                     joint coordinates.",
        }
        /// A joint coordinate depends on the others, or is prescribed.
        Dependent {
            /// Name of the joint coordinate.
            coordinate: String,
        } => "joint-space-dependent" {
            subject: Subject::new("coordinate", coordinate),
            cause: ("joint coordinate `{coordinate}` cannot move independently of the others"),
            remedy: "choose another coordinate, or move the mechanism away from a singular position",
            meaning: "A chosen joint coordinate is prescribed, depends on the other ones, or is at a dead point of a closed loop.",
            advice: "Choose another coordinate of the loop.",
        }
    }
    wraps {
        /// There are no accelerations at the state.
        Initial(InitialError), (error) => error.diagnostic(),
    }
}

impl From<InitialError> for JointSpaceError {
    fn from(error: InitialError) -> Self {
        Self::Initial(error)
    }
}

/// Checks that there are as many `rows` of rates as degrees of freedom of all that is coupled with them, and none only without any
/// degree of freedom.
///
/// # Errors
/// [`JointSpaceError::Number`] otherwise.
pub fn check_number(system: &System, state: &State, rows: &[usize]) -> Result<(), JointSpaceError> {
    let freedoms = match rows {
        [] => mobility(system, state).freedoms,
        _ => coupled_freedoms(system, state, rows),
    };
    let coordinates = rows.len();
    if freedoms == coordinates { Ok(()) } else { Err(JointSpaceError::Number { coordinates, freedoms }) }
}

/// Equations of motion in joint coordinates at a state.
#[derive(Clone, Debug, PartialEq)]
pub struct JointMotion {
    /// T: velocities of the system per unit rate of each coordinate, by row of the system.
    pub directions: DMatrix<f64>,
    /// H: mass matrix [kg m², kg m, kg].
    pub mass: DMatrix<f64>,
    /// h: forces in addition to those of the model at which the coordinates do not accelerate [N m, N].
    pub bias: DVector<f64>,
}

impl JointMotion {
    /// H z̈ + h: forces in addition to those of the model at which the coordinates have these accelerations [N m, N].
    pub fn forces(&self, accelerations: &[f64]) -> Vec<f64> {
        (&self.mass * DVector::from_column_slice(accelerations) + &self.bias).as_slice().to_vec()
    }
}

/// Computes the motion in joint coordinates.
pub struct JointSpace {
    /// Rows of the rates in the layout.
    rows: Vec<usize>,
    initial: ConsistentInitialConditions,
}

impl JointSpace {
    /// For the independent rates in these `rows` of the layout: of coordinates of joints, and all six of a free body.
    pub fn new(system: &System, state: &State, settings: &Settings, rows: Vec<usize>) -> Self {
        let linearization = system.linearization_at(&state.kinematics);
        let representative = Representative::of(system, &state.kinematics, &linearization);
        let kind = pivoting_unless_augmented(settings);
        let initial = ConsistentInitialConditions::new(system, state, &representative, kind);
        Self { rows, initial }
    }

    /// Mass matrix and bias at a state under the forces of the model.
    ///
    /// # Errors
    /// If the coordinates depend on each other, or there are no accelerations.
    pub fn motion(&mut self, system: &System, state: &State) -> Result<JointMotion, JointSpaceError> {
        let (directions, mass) = self.directions_and_mass(system, state)?;
        let free = self.initial.acceleration_with_factors(system, state)?;
        let bias = -&mass * self.of_coordinates(&free);
        Ok(JointMotion { directions, mass, bias })
    }

    /// Sets all velocities of `state` to those at which the coordinates have these `rates` [rad/s, m/s].
    ///
    /// # Errors
    /// If the coordinates depend on each other.
    pub fn set_rates(
        &mut self,
        system: &System,
        state: &mut State,
        rates: &[f64],
    ) -> Result<(), JointSpaceError> {
        let directions = self.directions(system, state)?;
        let layout = system.layout();
        let mut driven = vec![0.0; layout.size()];
        system.constraint_velocities(&state.kinematics, &mut driven[layout.coordinate_count()..]);
        for value in &mut driven {
            *value = -*value;
        }
        self.initial.solve(system, &mut driven);
        let missing = DVector::from_column_slice(rates) - self.of_coordinates(&driven);
        for (value, change) in driven.iter_mut().zip(&(directions * missing)) {
            *value += change;
        }
        scatter_rates(layout, &driven, &mut state.kinematics);
        Ok(())
    }

    /// The entries of a vector by row that belong to the coordinates.
    fn of_coordinates(&self, rows: &[f64]) -> DVector<f64> {
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(|&row| rows[row]))
    }

    /// T: velocities of the system per unit rate of each coordinate, by row of the system.
    ///
    /// # Errors
    /// If the coordinates depend on each other.
    pub fn directions(&mut self, system: &System, state: &State) -> Result<DMatrix<f64>, JointSpaceError> {
        Ok(self.directions_and_mass(system, state)?.0)
    }

    /// T and H.
    fn directions_and_mass(
        &mut self,
        system: &System,
        state: &State,
    ) -> Result<(DMatrix<f64>, DMatrix<f64>), JointSpaceError> {
        let layout = system.layout();
        let (count, size) = (layout.coordinate_count(), self.rows.len());
        self.initial.factor(system, state, Inertias::All)?;
        let mut responses = DMatrix::zeros(count, size);
        let mut momenta = DMatrix::zeros(count, size);
        let mut right = vec![0.0; layout.size()];
        let mut product = right.clone();
        for (column, &row) in self.rows.iter().enumerate() {
            right.fill(0.0);
            right[row] = 1.0;
            self.initial.solve(system, &mut right);
            right[count..].fill(0.0);
            self.initial.multiply_mass(system, &right, &mut product);
            responses.column_mut(column).copy_from_slice(&right[..count]);
            momenta.column_mut(column).copy_from_slice(&product[..count]);
        }
        let energies = responses.tr_mul(&momenta);
        let dependent =
            |index: usize| JointSpaceError::Dependent { coordinate: layout.name_of(self.rows[index]) };
        let rows = &self.rows;
        let own = DVector::from_fn(size, |index, _| responses[(rows[index], index)]);
        // These comparisons are false for NaN.
        let is_motion = |index: &usize| {
            (energies[(*index, *index)] - own[*index]).abs() <= round_off::NEGLIGIBLE * own[*index]
        };
        if let Some(index) = (0..size).find(|index| !(is_motion(index) && own[*index] > 0.0)) {
            return Err(dependent(index));
        }
        let units = own.map(|value| value.sqrt().recip());
        let relative = DMatrix::from_fn(size, size, |i, j| {
            0.5 * (responses[(rows[i], j)] + responses[(rows[j], i)]) * units[i] * units[j]
        });
        let factors = Cholesky::new(relative).ok_or_else(|| dependent(size - 1))?;
        let pivots = factors.l_dirty().diagonal();
        if let Some(index) = (0..size).find(|&index| pivots[index].powi(2) <= DEPENDENT) {
            return Err(dependent(index));
        }
        let inverse = factors.inverse();
        let inverse = DMatrix::from_fn(size, size, |i, j| inverse[(i, j)] * units[i] * units[j]);
        let directions = responses * &inverse;
        let mass = directions.tr_mul(&(momenta * inverse));
        let mass = 0.5 * (&mass + mass.transpose());
        Ok((directions, mass))
    }
}
