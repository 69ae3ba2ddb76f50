//! Elastic laws of solids.
//!
//! Legend: F deformation gradient, J its determinant, E Green-Lagrange strain, I₁ = F:F, I₂ = (I₁² - FᵀF:FᵀF)/2, μ shear modulus, μ₂ its
//! part in Mooney-Rivlin's second term, otherwise 0, λ Lamé's first constant, K bulk modulus, K₀ its part at points, V volume of an element,
//! V₀ that at rest.
//!
//! ```text
//! St. Venant-Kirchhoff   W = λ/2 (tr E)² + μ E:E
//! rubber                 W = (μ - μ₂)/2 (I₁ J^(-2/3) - 3) + μ₂/2 (I₂ J^(-4/3) - 3) + K₀/2 (J - 1)²,
//!                        and of an element  V₀ (K - K₀)/2 (V/V₀ - 1)²
//! ```
//!
//! K₀ = min(K, 14/3 μ), which is the bulk modulus at ν = 0.4. The rest acts on the mean dilatation, one equation per element, so that
//! elements do not lock up to ν → 1/2. Without K₀, bending of one layer of elements would be nearly free of energy: its dilatation is
//! linear, with the mean 0.

use lissom_motion::{Matrix3, Vector3};

use super::deformation::Deformation;

/// Which law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidModel {
    /// Stress is proportional to the Green-Lagrange strain: for small strains.
    StVenantKirchhoff,
    /// Rubber: also large strains, and almost incompressible.
    Rubber,
}

/// An elastic law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidLaw {
    /// Which one.
    pub model: SolidModel,
    /// Shear modulus [Pa].
    pub shear: f64,
    /// Bulk modulus [Pa].
    pub bulk: f64,
    /// Part of the shear modulus of rubber in the second term, twice the second constant of Mooney and Rivlin [Pa].
    pub second: f64,
}

impl SolidLaw {
    /// The law with Young's modulus [Pa] and Poisson's ratio at small strains.
    pub fn new(model: SolidModel, young: f64, poisson: f64) -> Self {
        let (shear, bulk) = (0.5 * young / (1.0 + poisson), young / (3.0 - 6.0 * poisson));
        Self { model, shear, bulk, second: 0.0 }
    }

    /// Bulk modulus of the dilatation at a point [Pa].
    fn bulk_at_point(&self) -> f64 {
        match self.model {
            SolidModel::StVenantKirchhoff => self.bulk,
            SolidModel::Rubber => self.bulk.min(14.0 / 3.0 * self.shear),
        }
    }

    /// Bulk modulus of the mean dilatation of an element [Pa].
    pub(super) fn bulk_of_mean(&self) -> f64 {
        self.bulk - self.bulk_at_point()
    }

    /// Energy at a point without that of the mean dilatation [J/m³].
    pub(super) fn energy(&self, at: &Deformation) -> f64 {
        match self.model {
            SolidModel::StVenantKirchhoff => {
                let strain = at.strain();
                0.5 * strain.dot(&self.second_stress(&strain))
            }
            SolidModel::Rubber => {
                // (I₁ J^(-2/3) - 3) of small strains without loss of digits.
                let exponent = -2.0 / 3.0 * at.dilatation().ln_1p();
                let first = 2.0 * at.displacement.trace() + at.displacement.norm_squared();
                let distortion = 3.0 * exponent.exp_m1() + first * exponent.exp();
                let first = (self.shear - self.second) * distortion;
                let strain = at.strain();
                let trace = strain.trace();
                let invariant = 4.0 * trace + 2.0 * (trace * trace - strain.norm_squared());
                let second = 3.0 * (2.0 * exponent).exp_m1() + invariant * (2.0 * exponent).exp();
                0.5 * (first + self.second * second + self.bulk_at_point() * at.dilatation().powi(2))
            }
        }
    }

    /// Stress of a small strain without that of the mean dilatation [Pa].
    pub(super) fn small_stress(&self, strain: &Matrix3) -> Matrix3 {
        let first = (self.bulk_at_point() - 2.0 / 3.0 * self.shear) * strain.trace();
        2.0 * self.shear * strain + Matrix3::from_diagonal_element(first)
    }

    /// Second Piola-Kirchhoff stress of a Green-Lagrange strain [Pa].
    pub(super) fn second_stress(&self, strain: &Matrix3) -> Matrix3 {
        let first = (self.bulk - 2.0 / 3.0 * self.shear) * strain.trace();
        2.0 * self.shear * strain + Matrix3::from_diagonal_element(first)
    }

    /// First Piola-Kirchhoff stress with the pressure of the mean dilatation, positive in tension [Pa].
    pub(super) fn first_stress(&self, at: &Deformation, mean: f64) -> Matrix3 {
        match self.model {
            SolidModel::StVenantKirchhoff => at.gradient * self.second_stress(&at.strain()),
            SolidModel::Rubber => {
                let factor = (self.shear - self.second) * at.determinant.powf(-2.0 / 3.0);
                let third = at.gradient.norm_squared() / 3.0;
                let pressure = (self.bulk_at_point() * at.dilatation() + mean) * at.determinant;
                let first = factor * at.gradient + (pressure - factor * third) * at.inverse_transpose;
                if self.second == 0.0 { first } else { first + self.second_term(at).1 }
            }
        }
    }

    /// I₂ and the stress of the second term, μ₂ J^(-4/3) (I₁ F - F Fᵀ F - 2/3 I₂ F⁻ᵀ).
    fn second_term(&self, at: &Deformation) -> (f64, Matrix3) {
        let right = at.gradient.tr_mul(&at.gradient);
        let first = right.trace();
        let second = 0.5 * (first * first - right.norm_squared());
        let slope = first * at.gradient - at.gradient * right;
        let factor = self.second * at.determinant.powf(-4.0 / 3.0);
        (second, factor * (slope - 2.0 / 3.0 * second * at.inverse_transpose))
    }

    /// Change of the second term by a change of the gradient.
    fn second_change(&self, at: &Deformation, change: &Matrix3) -> Matrix3 {
        let (f, q) = (&at.gradient, &at.inverse_transpose);
        let (second, stress) = self.second_term(at);
        let right = f.tr_mul(f);
        let first = right.trace();
        let share = q.dot(change);
        let slope = first * f - f * right;
        let turned = q * change.tr_mul(q);
        let cubic = change * right + f * change.tr_mul(f) + f * f.tr_mul(change);
        let own = 2.0 * f.dot(change) * f + first * change - cubic - 4.0 / 3.0 * slope.dot(change) * q
            + 2.0 / 3.0 * second * turned;
        self.second * at.determinant.powf(-4.0 / 3.0) * own - 4.0 / 3.0 * share * stress
    }

    /// Change of the first Piola-Kirchhoff stress by a change of the gradient e_k ⊗ `slope`, at a constant pressure of the mean
    /// dilatation; with the second stress `stressed` in the geometric part of St. Venant-Kirchhoff.
    pub(super) fn stress_change(
        &self,
        at: &Deformation,
        (stressed, mean): (&Matrix3, f64),
        (k, slope): (usize, &Vector3),
    ) -> Matrix3 {
        match self.model {
            SolidModel::StVenantKirchhoff => {
                let row: Vector3 = at.gradient.row(k).transpose();
                let half = 0.5 * row * slope.transpose();
                let mut change = at.gradient * self.second_stress(&(half + half.transpose()));
                let geometric = stressed * slope;
                for column in 0..3 {
                    change[(k, column)] += geometric[column];
                }
                change
            }
            SolidModel::Rubber => {
                let (q, j) = (&at.inverse_transpose, at.determinant);
                let along = q * slope;
                let share = along[k];
                // -δF⁻ᵀ
                let turned = along * q.row(k);
                let factor = (self.shear - self.second) * j.powf(-2.0 / 3.0);
                let third = at.gradient.norm_squared() / 3.0;
                let bulk = self.bulk_at_point();
                let pressure = (bulk * at.dilatation() + mean) * j;
                let stretch = at.gradient.row(k).dot(&slope.transpose());
                let mut change = (pressure * share + bulk * j * j * share
                    - 2.0 / 3.0 * factor * (stretch - third * share))
                    * q
                    - (2.0 / 3.0 * factor * share) * at.gradient
                    + (factor * third - pressure) * turned;
                for column in 0..3 {
                    change[(k, column)] += factor * slope[column];
                }
                if self.second != 0.0 {
                    change += self.second_change(at, &(Vector3::ith(k, 1.0) * slope.transpose()));
                }
                change
            }
        }
    }
}
