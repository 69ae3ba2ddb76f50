//! Accuracy of numbers by purpose, relative to the quantity in the comment: round-off, and what iterations, roots and given numbers
//! have in common. Tolerances that are chosen for other reasons are defined where they are used.

/// The result of a few operations on numbers of one magnitude.
pub const OPERATIONS: f64 = 16.0 * f64::EPSILON;
/// A sum, relative to its terms.
pub const SUM: f64 = 4.0 * f64::EPSILON;
/// Forces of a system, relative to their terms.
pub const FORCES: f64 = 64.0 * f64::EPSILON;
/// A stiffness of a system, relative to its terms.
pub const STIFFNESS: f64 = 256.0 * f64::EPSILON;
/// Errors of rates of strains, deformations and violations, relative to the displacement of the nodes of an element or joint, in
/// element lengths. If these move nearly as a rigid body their relative rates are round-off of the twists of the nodes.
pub const RIGID_MOTION: f64 = 4096.0 * f64::EPSILON;
/// Changes of the point of contact, relative to the radius of the wheel.
pub const CURVATURE_CENTRE: f64 = 1e-15;
/// Residuals of linear equations, per row: a further correction does not reduce them.
pub const SOLUTION: f64 = 1e-15;
/// A diagonal entry relative to the largest entry of its column, an eigenvalue of a shifted operator relative to the largest one.
pub const PIVOT: f64 = 1e-14;
/// Added to the square of a sine, so that its root has a derivative at zero.
pub const SQUARE: f64 = 1e-14;
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
/// Iterations whose results change by less than this fraction have converged, or no longer decrease.
pub const ITERATION: f64 = 1e-10;
/// Roots within a step, as step fractions.
pub const ROOT: f64 = 1e-10;
/// Positions at equilibrium and positions that satisfy constraints, relative to the length of the model.
pub const EQUILIBRIUM: f64 = 1e-9;
/// Last corrections of a step that round-off prevents from reaching the tolerance: their effect on the energy is checked by the
/// energy balance.
pub const STEP: f64 = 1e-9;
/// Places, directions and inertias that are one, to the digits of a text: of a place relative to 1 m and to its distance from the origin.
pub const COINCIDENT: f64 = 1e-9;
/// A pivot of constraints relative to the squares it is made of: an equation below it repeats others.
pub const RANK: f64 = 1e-9;
/// Forces and entries of gradients, relative to the largest, and residuals relative to their terms: they are computed from solutions.
pub const FORCE: f64 = 1e-9;
/// Eigenvalues computed by iteration, relative to the largest, their imaginary parts, and residuals of accepted modes.
pub const ITERATED_EIGENVALUE: f64 = 1e-9;
/// Accelerations in steady motion relative to the squares of rates, and corrections of it that no longer decrease.
pub const STEADY_MOTION: f64 = 1e-8;
/// Positions, with respect to the length of the model: energies and forces of smaller displacements are round-off.
pub const POSITION: f64 = 1e-7;
/// Derivatives with respect to model parameters, relative to the largest.
pub const DERIVATIVE: f64 = 1e-7;
/// Estimated errors of a step's vibrations below this fraction of the model's size: their displacements are small, and steps short.
pub const VIBRATION: f64 = 1e-14;
/// Numbers of a model file, which are written with six digits or more: lengths relative to the size of a part, angles, directions.
pub const GIVEN: f64 = 1e-6;
/// A component relative to the largest one, or a displacement relative to the length of the model, that is neither used nor reported.
pub const NEGLIGIBLE: f64 = 1e-6;
/// Instants closer than this step fraction to an end of the step are at that end: the accelerations of a shorter step would be
/// round-off, and a jump at an end of an interval belongs to the neighbour.
pub const STEP_END: f64 = 1e-6;
/// Distance from the end of a step, as a step fraction, of the values that determine a rate there.
pub const SLOPE_OFFSET: f64 = 1e-3;

/// Changes of the parameter of a nearest point on a curve, relative to its range.
pub const CURVE_PARAMETER: f64 = 1e-15;

/// Changes of a squared distance, relative to it.
pub const SQUARED_DISTANCE: f64 = 1e-13;
