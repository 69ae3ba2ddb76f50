//! Mass, damping and stiffness between coordinates: M q̈ + D q̇ + K (q - q₀) on the left-hand side of their equations.
//!
//! The parts that store or dissipate energy are separate from those that may supply it, whose work is computed:
//!
//! ```text
//! K = (K + Kᵀ)/2 + (K - Kᵀ)/2      strain energy (q - q₀)ᵀ (K + Kᵀ) (q - q₀)/4;  circulatory forces
//! D                                with an indefinite symmetric part it puts energy in
//! ```

use nalgebra::{DMatrix, DVector};

use super::contribution::{Contribution, CoordinateMass};
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, Energy, Load, Tangents, Unknowns};
use crate::kinematics::{CoordinateId, Kinematics};
use crate::ports::{PortDeclaration, PortType, Ports};
use crate::registry::{ParameterError, ParameterType, Parameters, optional};
use crate::round_off;

/// Maximum number of coordinates of one entry: its matrices are full.
const MAX_COORDINATES: usize = 100;

const MATRIX: &str = "a number, the diagonal, or all rows";

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "coordinate_dynamics",
    summary: "Mass, damping and stiffness matrices on coordinates: `M q'' + D q' + K (q - rest)` in their equations.",
    sample: "mass = [2.0, 1.0]\nstiffness = [[30.0, -10.0], [-10.0, 10.0]]",
    parameters: &[
        optional(
            "mass",
            ParameterType::SquareMatrix,
            "kg, kg m or kg m²",
            "Mass matrix, symmetric, without negative eigenvalues.",
        ).or_number(0.0),
        optional(
            "damping",
            ParameterType::SquareMatrix,
            "N s/m, N s or N m s/rad",
            "Damping matrix; it may be unsymmetric (gyroscopic forces) or negative.",
        ).or_number(0.0),
        optional(
            "stiffness",
            ParameterType::SquareMatrix,
            "N/m, N/rad or N m/rad",
            "Stiffness matrix; it may be unsymmetric (circulatory forces).",
        ).or_number(0.0),
        optional(
            "rest",
            ParameterType::Numbers,
            "m or rad",
            "Values of the coordinates without force of `stiffness`; default zeros.",
        ),
    ],
    ports: Ports(&[PortDeclaration::required(
        "coordinates",
        PortType::Coordinates,
        "coordinates on which it acts, such as \"arm.angle\", in the order of its matrices; the name of a joint stands for all its coordinates",
    )
    .listed("coordinates: joint coordinates on which it acts, in the order of its matrices")
    .sample("coordinates = [\"my_hinge.angle\", \"my_slide.displacement\"]")]),
    build,
};

/// Constant matrices on coordinates.
#[derive(Clone, Debug)]
pub struct CoordinateDynamics {
    coordinates: Vec<CoordinateId>,
    mass: DMatrix<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    rest: DVector<f64>,
    /// Whether its forces may supply energy.
    is_load: bool,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let coordinates = attached.coordinates;
    let count = coordinates.len();
    if count == 0 {
        return Err(ParameterError::new("coordinates", "must list coordinates of joints"));
    }
    if count > MAX_COORDINATES {
        let problem =
            format!("names {count} coordinates; an entry has at most {MAX_COORDINATES}: use several entries");
        return Err(ParameterError::new("coordinates", problem));
    }
    let [mass, damping, stiffness] =
        ["mass", "damping", "stiffness"].map(|name| matrix(parameters, name, count));
    let (mass, damping, stiffness) = (mass?, damping?, stiffness?);
    if !["mass", "damping", "stiffness"].iter().any(|name| parameters.has(name)) {
        return Err(ParameterError::new(
            "mass",
            "is missing, as are `damping` and `stiffness`: specify one of them",
        ));
    }
    let asymmetry = (&mass - mass.transpose()).amax();
    if asymmetry > round_off::COUPLING * mass.amax() {
        return Err(ParameterError::new("mass", "must be symmetric: it is the matrix of a kinetic energy"));
    }
    if is_indefinite(&mass) {
        let problem = "must not have negative eigenvalues: a motion would have negative kinetic energy";
        return Err(ParameterError::new("mass", problem));
    }
    let rest = if parameters.has("rest") { parameters.numbers("rest")?.to_vec() } else { vec![0.0; count] };
    if rest.len() != count {
        let problem = format!("has {} numbers, but `coordinates` names {count}", rest.len());
        return Err(ParameterError::new("rest", problem));
    }
    let rest = DVector::from_vec(rest);
    let none = DMatrix::zeros(count, count);
    let symmetric = 0.5 * (&stiffness + stiffness.transpose());
    let circulatory = &stiffness - &symmetric;
    // Negative damping supplies energy; the rest of the matrix belongs to the same element, so that there is only one
    // work term.
    let drives = is_indefinite(&(0.5 * (&damping + damping.transpose())));
    let (kept, active) = if drives { (none.clone(), damping) } else { (damping, none.clone()) };
    let is_whole = active.amax() == 0.0 && circulatory.amax() == 0.0;
    let mut contribution = Contribution::to(model);
    if !is_whole {
        contribution = contribution.with(CoordinateDynamics {
            coordinates: coordinates.clone(),
            mass: none,
            damping: active,
            stiffness: circulatory,
            rest: rest.clone(),
            is_load: true,
        });
    }
    if mass.amax() > 0.0 {
        let own = CoordinateMass { coordinates: coordinates.clone(), matrix: mass.clone() };
        contribution.coordinate_masses.push(own);
    }
    let contribution = contribution.with(CoordinateDynamics {
        coordinates,
        mass,
        damping: kept,
        stiffness: symmetric,
        rest,
        is_load: false,
    });
    // The power of an entry with two elements is not that of one of them.
    Ok(if is_whole { contribution } else { contribution.without_outputs() })
}

/// Whether a symmetric matrix has a negative eigenvalue. It is scaled to a unit diagonal, so that the result is
/// independent of units.
fn is_indefinite(matrix: &DMatrix<f64>) -> bool {
    let scale = matrix.diagonal().map(|entry| if entry > 0.0 { 1.0 / entry.sqrt() } else { 1.0 });
    let scaled =
        DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] * scale[i] * scale[j]);
    let eigenvalues = scaled.symmetric_eigenvalues();
    eigenvalues.min() < -round_off::COUPLING * eigenvalues.amax().max(1.0)
}

/// A matrix of the size of the coordinates: zero if it is not given; a single number is the value of the whole diagonal.
fn matrix(parameters: &Parameters, name: &str, count: usize) -> Result<DMatrix<f64>, ParameterError> {
    if !parameters.has(name) {
        return Ok(DMatrix::zeros(count, count));
    }
    let given = parameters.square_matrix(name)?;
    if given.nrows() == 1 {
        return Ok(DMatrix::from_diagonal_element(count, count, given[(0, 0)]));
    }
    if given.nrows() != count {
        let rows = given.nrows();
        let problem = format!("is of {rows} coordinates, but `coordinates` names {count}: give {MATRIX}");
        return Err(ParameterError::new(name, problem));
    }
    Ok(given.clone())
}

impl CoordinateDynamics {
    fn gather(&self, of: impl Fn(CoordinateId) -> f64) -> DVector<f64> {
        DVector::from_iterator(self.coordinates.len(), self.coordinates.iter().map(|&own| of(own)))
    }

    fn departure(&self, at: &Kinematics) -> DVector<f64> {
        self.gather(|own| at.coordinates[own].value) - &self.rest
    }
}

impl Element for CoordinateDynamics {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_coordinates(&self.coordinates)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        for (row, out) in out.iter_mut().enumerate() {
            for (column, &own) in self.coordinates.iter().enumerate() {
                let motion = &at.coordinates[own];
                *out += self.mass[(row, column)] * motion.acceleration
                    + self.damping[(row, column)] * motion.rate
                    + self.stiffness[(row, column)] * (motion.value - self.rest[column]);
            }
        }
    }

    fn linearize(&self, _: &Kinematics, out: &mut Tangents) {
        let size = out.size();
        for row in 0..self.coordinates.len() {
            for column in 0..self.coordinates.len() {
                let entry = row * size + column;
                out.mass[entry] += self.mass[(row, column)];
                out.damping[entry] += self.damping[(row, column)];
                out.stiffness[entry] += self.stiffness[(row, column)];
            }
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        if self.is_load {
            return Energy::default();
        }
        let (rates, departure) = (self.gather(|own| at.coordinates[own].rate), self.departure(at));
        Energy {
            kinetic: 0.5 * rates.dot(&(&self.mass * &rates)),
            strain: 0.5 * departure.dot(&(&self.stiffness * &departure)),
            ..Energy::default()
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl Load for CoordinateDynamics {
    fn is_active(&self) -> bool {
        self.is_load
    }
}

#[cfg(test)]
#[path = "../../tests/unit/elements/coordinate_dynamics.rs"]
mod tests;
