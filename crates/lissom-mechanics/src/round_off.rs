//! Round-off tolerances by purpose, relative to the quantity in the comment. Tolerances that are chosen for other reasons are
//! defined where they are used.

/// The result of a few operations on numbers of one magnitude.
pub const OPERATIONS: f64 = 16.0 * f64::EPSILON;
/// A sum, relative to its terms.
pub const SUM: f64 = 4.0 * f64::EPSILON;
/// Forces of a system, relative to their terms.
pub const FORCES: f64 = 64.0 * f64::EPSILON;
/// A stiffness of a system, relative to its terms.
pub const STIFFNESS: f64 = 256.0 * f64::EPSILON;
/// Errors of rates of strains and deformations, relative to the displacement of an element's nodes, in element lengths. If an
/// element moves nearly as a rigid body its relative rates are round-off of the twists of its nodes.
pub const RIGID_MOTION: f64 = 4096.0 * f64::EPSILON;
/// Changes of the point of contact, relative to the radius of the wheel.
pub const CURVATURE_CENTRE: f64 = 1e-15;
/// A diagonal entry relative to the largest entry of its column, an eigenvalue of a shifted operator relative to the largest one.
pub const PIVOT: f64 = 1e-14;
/// Violations of constraints, of angles and relative to the length of the model.
pub const VIOLATION: f64 = 1e-14;
/// Corrections of Newton's method, scaled: some hundred roundings of numbers of magnitude one.
pub const CORRECTION: f64 = 1e-13;
/// The part of a vector that is independent of others, relative to it; eigenvalues, relative to the largest, as
/// squares.
pub const PREDICTION: f64 = 1e-13;
/// Increments determined by a step [-, rad].
pub const INCREMENT: f64 = 1e-12;
/// Values of a function of time, relative to its magnitude.
pub const FUNCTION: f64 = 1e-12;
/// Eigenvalues of symmetric matrices relative to the largest, and forces of rigid displacements relative to the norm of the stiffness.
pub const EIGENVALUE: f64 = 1e-12;
/// Entries of the matrices of a linearised model, relative to the largest of their rows.
pub const MATRIX_ENTRY: f64 = 1e-11;
/// An energy, relative to the largest single one.
pub const ENERGY: f64 = 1e-10;
/// Eigenvalues of given matrices relative to the largest, couplings of two stiffnesses, imaginary parts relative to the magnitude
/// of a number.
pub const COUPLING: f64 = 1e-10;
/// Forces and entries of gradients, relative to the largest: they are computed from solutions.
pub const FORCE: f64 = 1e-9;
/// Eigenvalues computed by iteration, relative to the largest, and their imaginary parts.
pub const ITERATED_EIGENVALUE: f64 = 1e-9;
/// Accelerations in steady motion relative to the squares of rates, and corrections of it that no longer decrease.
pub const STEADY_MOTION: f64 = 1e-8;
/// Derivatives with respect to model parameters, relative to the largest.
pub const DERIVATIVE: f64 = 1e-7;
/// Estimated errors of a step's vibrations below this fraction of the model's size: their displacements are small, and steps short.
pub const VIBRATION: f64 = 1e-14;
