//! The matrices of a superelement, and their requirements: symmetry, a positive mass with the rigid motions of a rigid body,
//! a stiffness without resistance to them.

use lissom_motion::{Matrix3, Vector3, axial, skew};
use nalgebra::{DMatrix, Matrix3xX, SymmetricEigen};

use super::geometric::GeometricMatrices;
use lissom_mechanics::number::Written;
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::round_off;

/// Allowed difference between mirror entries, as a fraction of their rows' diagonals.
const ASYMMETRY: f64 = 1e-5;
/// Allowed forces of a rigid displacement, as a fraction of their terms, and allowed deviation of a mass from that of a rigid
/// body.
const RIGID: f64 = 1e-4;

/// Damping of a superelement.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Damping {
    /// None.
    #[default]
    None,
    /// A matrix like the stiffness [N s/m, N s, N m s].
    Matrix(DMatrix<f64>),
    /// The stiffness times a time [s].
    OfStiffness(f64),
}

/// Matrices over six unknowns of each interface, displacement and rotation in the axes of the part, and then the modal
/// coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedMatrices {
    /// Mass [kg, kg m, kg m²].
    pub mass: DMatrix<f64>,
    /// Stiffness [N/m, N, N m].
    pub stiffness: DMatrix<f64>,
    /// Damping.
    pub damping: Damping,
    /// Forces in the undeformed part [N, N m], which rotate with it; empty for none.
    pub preload: Vec<f64>,
    /// Second-order terms in the deformation; none if they are unknown.
    pub geometric: Option<Box<GeometricMatrices>>,
}

/// Rigid motions of a mass matrix.
pub(super) struct RigidMotion {
    /// m.
    pub(super) total: f64,
    /// m c from the origin of the positions.
    pub(super) moment: Vector3,
    /// G = Tᵀ M.
    pub(super) carried: Matrix3xX<f64>,
    /// The largest deviation of an entry from that of a rigid body, relative to m and m times lengths.
    error: f64,
}

/// Column `k` of the rigid motions, translations and then rotations about the origin of the positions.
pub fn rigid_column(places: &[Vector3], size: usize, k: usize) -> Vec<f64> {
    let mut column = vec![0.0; size];
    let axis = Vector3::ith(k % 3, 1.0);
    for (i, place) in places.iter().enumerate() {
        let (linear, angular) = if k < 3 { (axis, Vector3::zeros()) } else { (axis.cross(place), axis) };
        column[6 * i..6 * i + 3].copy_from_slice(linear.as_slice());
        column[6 * i + 3..6 * i + 6].copy_from_slice(angular.as_slice());
    }
    column
}

/// Rigid motions of a mass matrix; `places` are relative to the reference point of moments.
pub(super) fn rigid_motion(mass: &DMatrix<f64>, places: &[Vector3]) -> RigidMotion {
    let size = mass.nrows();
    let columns: Vec<_> =
        (0..6).map(|k| nalgebra::DVector::from_vec(rigid_column(places, size, k))).collect();
    let images: Vec<_> = columns.iter().map(|column| mass * column).collect();
    let carried = Matrix3xX::from_fn(size, |k, column| images[k][column]);
    let entry = |i: usize, j: usize| columns[i].dot(&images[j]);
    let total = (0..3).map(|k| entry(k, k)).sum::<f64>() / 3.0;
    // Momentum of a rotation is -m c\u{303}.
    let turning = Matrix3::from_fn(|i, j| entry(i, 3 + j));
    let moment = -axial(&turning);
    let length = (0..3).map(|k| entry(3 + k, 3 + k)).fold(0.0, f64::max) / total;
    let isotropy = Matrix3::from_fn(&entry) - Matrix3::from_diagonal_element(total);
    let skewness = turning + skew(&moment);
    let error =
        (isotropy.amax() / total).max(skewness.amax() / (total * length.sqrt().max(f64::MIN_POSITIVE)));
    RigidMotion { total, moment, carried, error }
}

fn problem<T>(parameter: &str, words: impl Into<String>) -> Result<T, ParameterError> {
    Err(ParameterError::new(parameter, words.into()))
}

/// The symmetric part, if the antisymmetric one is only round-off.
fn symmetric(matrix: &DMatrix<f64>, name: &str) -> Result<DMatrix<f64>, ParameterError> {
    let size = matrix.nrows();
    for i in 0..size {
        for j in 0..i {
            let (one, other) = (matrix[(i, j)], matrix[(j, i)]);
            let usual = (matrix[(i, i)] * matrix[(j, j)]).abs().sqrt();
            if (one - other).abs() > ASYMMETRY * usual.max(one.abs()).max(other.abs()) {
                return problem(
                    name,
                    format!(
                        "is not symmetric: the entries ({}, {}) and ({}, {}) are {} and {}",
                        i + 1,
                        j + 1,
                        j + 1,
                        i + 1,
                        Written(one),
                        Written(other)
                    ),
                );
            }
        }
    }
    Ok(0.5 * (matrix + matrix.transpose()))
}

/// Eigenvalues of the matrix scaled to a unit diagonal.
fn scaled_eigenvalues(matrix: &DMatrix<f64>) -> Vec<f64> {
    let size = matrix.nrows();
    let factor = |k: usize| {
        let own: f64 = matrix[(k, k)];
        if own > 0.0 { own.sqrt().recip() } else { 1.0 }
    };
    let scaled = DMatrix::from_fn(size, size, |i, j| factor(i) * factor(j) * matrix[(i, j)]);
    SymmetricEigen::new(scaled).eigenvalues.iter().copied().collect()
}

/// Fails if a rigid displacement has forces.
fn check_rigid(matrix: &DMatrix<f64>, places: &[Vector3], name: &str) -> Result<(), ParameterError> {
    let size = matrix.nrows();
    let words = ["translation along x", "translation along y", "translation along z"];
    let turns = ["rotation about x", "rotation about y", "rotation about z"];
    let scale: Vec<f64> = (0..size).map(|row| matrix[(row, row)].abs().sqrt()).collect();
    for (k, word) in words.iter().chain(&turns).enumerate() {
        let column = rigid_column(places, size, k);
        // Terms may be round-off themselves: their bound is the norm of the matrix, scaled to one unit by its
        // diagonal.
        let norm = column.iter().zip(&scale).map(|(own, scale)| own.abs() * scale).fold(0.0, f64::max);
        for row in 0..size {
            let terms = column.iter().enumerate().map(|(j, value)| matrix[(row, j)] * value);
            let (sum, most) =
                terms.fold((0.0_f64, 0.0_f64), |(sum, most), term| (sum + term, most + term.abs()));
            let least = round_off::EIGENVALUE * scale[row] * norm;
            if sum.abs() > RIGID * most + least {
                return problem(
                    name,
                    format!(
                        "holds a rigid {word}: row {} of its force is {:.3e} of terms of {:.3e}; a free part is not held: give \
                         matrices of the part without supports, six rows for each interface in the order of `interfaces` and then \
                         those of the modes, positions in the units of the matrices",
                        row + 1,
                        Written(sum),
                        Written(most)
                    ),
                );
            }
        }
    }
    Ok(())
}

impl ReducedMatrices {
    /// Makes the matrices symmetric to the last bit, if they are those of a free elastic part with interfaces at `places` [m].
    ///
    /// # Errors
    /// If they are not: with the name of the matrix.
    pub fn check(self, places: &[Vector3]) -> Result<Self, ParameterError> {
        let size = self.mass.nrows();
        let least = 6 * places.len();
        let mut named = vec![("mass", &self.mass), ("stiffness", &self.stiffness)];
        if let Damping::Matrix(matrix) = &self.damping {
            named.push(("damping", matrix));
        }
        for (name, matrix) in &named {
            let (rows, columns) = matrix.shape();
            if rows != size || columns != size {
                return problem(
                    name,
                    format!("has {rows} rows and {columns} columns, and the mass has {size} rows"),
                );
            }
            if rows < least {
                let count = places.len();
                return problem(
                    name,
                    format!("has {rows} rows: {count} interfaces need six each, at least {least}"),
                );
            }
            if let Some(k) = matrix.iter().position(|value| !value.is_finite()) {
                return problem(
                    name,
                    format!("is not finite in row {}, column {}", k % rows + 1, k / rows + 1),
                );
            }
        }
        if !self.preload.is_empty() && self.preload.len() != size {
            return problem("preload", format!("has {} rows, and the mass has {size}", self.preload.len()));
        }
        if let Some(row) = self.preload.iter().position(|value| !value.is_finite()) {
            return problem("preload", format!("is not finite in row {}", row + 1));
        }
        let mass = symmetric(&self.mass, "mass")?;
        if let Some(row) = (0..size).find(|&k| mass[(k, k)] <= 0.0) {
            return problem("mass", format!("has no positive entry on the diagonal of row {}", row + 1));
        }
        if scaled_eigenvalues(&mass).into_iter().fold(f64::INFINITY, f64::min) <= round_off::EIGENVALUE {
            return problem(
                "mass",
                "is not positive definite: some motion of the part would have no kinetic energy, or less",
            );
        }
        let error = rigid_motion(&mass, places).error;
        if error > RIGID {
            return problem(
                "mass",
                format!(
                    "is not that of a rigid body in rigid motions (by {error:.1e} of it): the mass must be the same along all axes; \
                     look at the order and the positions of the interfaces"
                ),
            );
        }
        let stiffness = symmetric(&self.stiffness, "stiffness")?;
        check_rigid(&stiffness, places, "stiffness")?;
        if scaled_eigenvalues(&stiffness).into_iter().fold(0.0, f64::min) < -round_off::GIVEN {
            return problem("stiffness", "has a negative eigenvalue: the part would be unstable by itself");
        }
        let damping = match &self.damping {
            Damping::Matrix(matrix) => {
                let matrix = symmetric(matrix, "damping")?;
                check_rigid(&matrix, places, "damping")?;
                if scaled_eigenvalues(&matrix).into_iter().fold(0.0, f64::min) < -round_off::GIVEN {
                    return problem("damping", "has a negative eigenvalue: it would put energy in");
                }
                Damping::Matrix(matrix)
            }
            other => other.clone(),
        };
        let geometric = match self.geometric {
            None => None,
            Some(matrices) => Some(Box::new(matrices.check(&mass, places)?)),
        };
        Ok(Self { mass, stiffness, damping, preload: self.preload, geometric })
    }

    /// The first natural frequency with an interface fixed [rad/s]; none if there is no vibration.
    pub(super) fn first_frequency_held(&self, interface: usize) -> Option<f64> {
        let held = |matrix: &DMatrix<f64>| {
            matrix.clone().remove_rows(6 * interface, 6).remove_columns(6 * interface, 6)
        };
        let (mass, stiffness) = (held(&self.mass), held(&self.stiffness));
        // One interface without modes is a rigid body.
        if mass.is_empty() {
            return None;
        }
        let lower = mass.cholesky()?.l();
        let half = lower.solve_lower_triangular(&stiffness)?;
        let scaled = lower.solve_lower_triangular(&half.transpose())?;
        let squares = SymmetricEigen::new(0.5 * (&scaled + scaled.transpose())).eigenvalues;
        let largest = squares.amax();
        let least = squares.iter().copied().filter(|square| *square > round_off::EIGENVALUE * largest);
        least.reduce(f64::min).map(f64::sqrt)
    }

    /// Damping with this ratio to critical damping in every mode of the free part: Σ 2 ζ ω M φ (M φ)ᵀ over the modes φ of unit
    /// modal mass. Rigid motions are not damped.
    ///
    /// # Errors
    /// If the mass is not positive definite.
    pub fn modal_damping(&self, ratio: f64) -> Result<DMatrix<f64>, ParameterError> {
        let Some(cholesky) = self.mass.clone().cholesky() else {
            return problem("mass", "is not positive definite");
        };
        let lower = cholesky.l();
        let half = lower.solve_lower_triangular(&self.stiffness).unwrap_or_else(|| self.stiffness.clone());
        let scaled = lower.solve_lower_triangular(&half.transpose()).unwrap_or(half);
        let SymmetricEigen { eigenvectors, eigenvalues } =
            SymmetricEigen::new(0.5 * (&scaled + scaled.transpose()));
        // M φ = L v for φ = L⁻ᵀ v.
        let momenta = lower * eigenvectors;
        let largest = eigenvalues.amax();
        let rates = eigenvalues
            .map(|square| if square > round_off::EIGENVALUE * largest { square.sqrt() } else { 0.0 });
        let weighted = &momenta * DMatrix::from_diagonal(&(rates * (2.0 * ratio)));
        Ok(weighted * momenta.transpose())
    }
}
