//! Second-order terms in the deformation that matrices of mass and stiffness omit, in the format of the standard data of flexible
//! bodies [Wallrapp 1994]: the dependence of first moment, inertia and angular momentum of a part on its deformation, including
//! the shortening by bending, and the decrease of distances between interfaces.
//!
//! Legend: y are the displacements, from the floating frame at the first interface and in its axes: positions and rotation vectors of the
//! interfaces, then modal coordinates; x₁ + x₂ position of a point to first and to second order in y.
//!
//! ```text
//! ∫ρ x₂ = s,   s_k = ½ y·S_k y            J = J₀ + α·y + ½ y·A y                 (inertia about the floating frame)
//! ∫ρ x × ẋ = (M-terms)·ẏ + c,   c_i = y·B_i ẏ                 h = Σ U_k ½ y·D_k y    (elastic energy ½ (y + h)·K (y + h))
//! ```
//!
//! α, A and B are sums: of points that are displaced along straight lines, and of the effect of section rotations.

use lissom_motion::{Matrix3, Vector3, skew};
use nalgebra::{DMatrix, DVector};

use super::matrices::rigid_column;
use lissom_mechanics::number::Written;
use lissom_mechanics::registry::ParameterError;

/// Entries of inertias in the order in which they are kept.
pub const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
/// Square blocks of inertia, and those of them in the format with loads in D.
const BLOCKS: usize = 21;
const FORMER_BLOCKS: usize = 12;
/// Allowed relative asymmetry of matrices, and relative error of inertias under rigid rotations.
const ASYMMETRY: f64 = 1e-3;

/// Shortening by a deformation: along a direction, by half a quadratic form.
#[derive(Clone, Debug, PartialEq)]
pub struct Shortening {
    /// U.
    pub direction: DVector<f64>,
    /// D.
    pub matrix: DMatrix<f64>,
}

/// Dependence of inertia and angular momentum about the floating frame on the deformation.
#[derive(Clone, Debug, PartialEq)]
pub struct TurningMatrices {
    /// α, of all rows: one row each for xx, yy, zz, xy, xz, yz.
    pub slope: DMatrix<f64>,
    /// A, in the same order.
    pub inertia: [DMatrix<f64>; 6],
    /// B about x, y, z.
    pub momentum: [DMatrix<f64>; 3],
}

impl TurningMatrices {
    fn blocks(&self) -> impl Iterator<Item = &DMatrix<f64>> {
        self.inertia.iter().chain(&self.momentum)
    }

    fn blocks_mut(&mut self) -> impl Iterator<Item = &mut DMatrix<f64>> {
        self.inertia.iter_mut().chain(&mut self.momentum)
    }
}

/// Second-order matrices of a part over the rows of its mass matrix; rows and columns of the first interface are zero,
/// except those of α, if it is displaced relative to the frame.
#[derive(Clone, Debug, PartialEq)]
pub struct GeometricMatrices {
    /// S along x, y, z.
    pub moment: [DMatrix<f64>; 3],
    /// Matrices of points that are displaced along straight lines, with sections that do not rotate.
    pub points: TurningMatrices,
    /// Effect of the rotation of sections, and the static response of omitted modes.
    pub sections: TurningMatrices,
    /// U and D of all shortenings.
    pub shortening: Vec<Shortening>,
}

fn problem<T>(words: impl Into<String>) -> Result<T, ParameterError> {
    Err(ParameterError::new("geometric", words.into()))
}

impl GeometricMatrices {
    /// From one matrix with all of them stacked: S, A and B of points, A and B of sections, D, a row for each U, and α of points
    /// and of sections last. None for a file of the format in which D were those of interfaces, without U: their matrices include
    /// loads twice.
    ///
    /// # Errors
    /// Unless it has `size` columns and a number of rows that matches some number of D.
    pub fn from_stacked(
        stacked: &DMatrix<f64>,
        interfaces: usize,
        size: usize,
    ) -> Result<Option<Self>, ParameterError> {
        let least = BLOCKS * size + 2 * PAIRS.len();
        let (rows, columns) = stacked.shape();
        let former = (FORMER_BLOCKS + interfaces.saturating_sub(1)) * size + PAIRS.len();
        if interfaces > 1 && (rows, columns) == (former, size) {
            return Ok(None);
        }
        let more = rows.checked_sub(least).filter(|_| columns == size);
        let Some(more) = more.filter(|more| more % (size + 1) == 0) else {
            return problem(format!(
                "has {rows} rows and {columns} columns: a mass of {size} rows needs {size} columns and {least} rows, and {} more for each \
                 term of what is shortened",
                size + 1
            ));
        };
        let terms = more / (size + 1);
        let block = |k: usize| stacked.rows(k * size, size).into_owned();
        let directions = (BLOCKS + terms) * size;
        let term = |k: usize| Shortening {
            direction: stacked.row(directions + k).transpose(),
            matrix: block(BLOCKS + k),
        };
        let turning = |first: usize, slope: usize| TurningMatrices {
            inertia: [0, 1, 2, 3, 4, 5].map(|k| block(first + k)),
            momentum: [6, 7, 8].map(|k| block(first + k)),
            slope: stacked.rows(directions + terms + slope, PAIRS.len()).into_owned(),
        };
        Ok(Some(Self {
            moment: [0, 1, 2].map(block),
            points: turning(3, 0),
            sections: turning(12, PAIRS.len()),
            shortening: (0..terms).map(term).collect(),
        }))
    }

    /// All of them stacked.
    pub fn stacked(&self) -> DMatrix<f64> {
        let size = self.points.slope.ncols();
        let blocks: Vec<&DMatrix<f64>> = self.blocks().collect();
        let (first, terms) = (blocks.len() * size, self.shortening.len());
        let mut stacked = DMatrix::zeros(first + terms + 2 * PAIRS.len(), size);
        for (k, block) in blocks.iter().enumerate() {
            stacked.rows_mut(k * size, size).copy_from(block);
        }
        for (k, own) in self.shortening.iter().enumerate() {
            stacked.row_mut(first + k).tr_copy_from(&own.direction);
        }
        for (k, own) in [&self.points, &self.sections].into_iter().enumerate() {
            stacked.rows_mut(first + terms + k * PAIRS.len(), PAIRS.len()).copy_from(&own.slope);
        }
        stacked
    }

    fn blocks(&self) -> impl Iterator<Item = &DMatrix<f64>> {
        let shortening = self.shortening.iter().map(|own| &own.matrix);
        self.moment.iter().chain(self.points.blocks()).chain(self.sections.blocks()).chain(shortening)
    }

    fn blocks_mut(&mut self) -> impl Iterator<Item = &mut DMatrix<f64>> {
        let first = self.moment.iter_mut().chain(self.points.blocks_mut());
        first.chain(self.sections.blocks_mut()).chain(self.shortening.iter_mut().map(|own| &mut own.matrix))
    }

    /// α, A and B as sums.
    #[must_use]
    pub fn turning(&self) -> TurningMatrices {
        let mut sum = self.points.clone();
        sum.slope += &self.sections.slope;
        for (own, more) in sum.blocks_mut().zip(self.sections.blocks()) {
            *own += more;
        }
        sum
    }

    /// Inertial terms over other unknowns, y = map z; without the shortenings.
    #[must_use]
    pub fn through(&self, map: &DMatrix<f64>) -> Self {
        let mut own = Self { shortening: Vec::new(), ..self.clone() };
        for matrix in own.blocks_mut() {
            *matrix = map.tr_mul(&(&*matrix * map));
        }
        for turning in [&mut own.points, &mut own.sections] {
            turning.slope = &turning.slope * map;
        }
        own
    }

    /// With other units of the unknowns, each by its factor.
    #[must_use]
    pub fn scaled(&self, factor: impl Fn(usize) -> f64) -> Self {
        let mut own = self.clone();
        for matrix in own.blocks_mut() {
            let size = matrix.nrows();
            *matrix = DMatrix::from_fn(size, size, |i, j| factor(i) * factor(j) * matrix[(i, j)]);
        }
        for turning in [&mut own.points, &mut own.sections] {
            for (k, mut column) in turning.slope.column_iter_mut().enumerate() {
                column *= factor(k);
            }
        }
        for term in &mut own.shortening {
            for (k, value) in term.direction.iter_mut().enumerate() {
                *value /= factor(k);
            }
        }
        own
    }

    /// Makes the matrices symmetric to the last bit, if they are consistent with the part whose mass is `mass`, with interfaces at
    /// `places` [m].
    ///
    /// # Errors
    /// If they are not.
    pub fn check(mut self, mass: &DMatrix<f64>, places: &[Vector3]) -> Result<Self, ParameterError> {
        let size = mass.nrows();
        if self.blocks().any(|block| block.shape() != (size, size))
            || [&self.points, &self.sections].iter().any(|own| own.slope.ncols() != size)
            || self.shortening.iter().any(|own| own.direction.len() != size)
        {
            return problem(format!("is not over the {size} rows of the mass"));
        }
        if self
            .blocks()
            .chain([&self.points.slope, &self.sections.slope])
            .any(|block| block.iter().any(|value| !value.is_finite()))
            || self.shortening.iter().any(|own| own.direction.iter().any(|value| !value.is_finite()))
        {
            return problem("contains a number that is not finite");
        }
        if self.blocks().any(|block| block.rows(0, 6).amax() > 0.0 || block.columns(0, 6).amax() > 0.0)
            || self.shortening.iter().any(|own| own.direction.rows(0, 6).amax() > 0.0)
        {
            return problem(
                "has entries of the first interface, which has the floating frame and is not displaced relative to it",
            );
        }
        let shortening = self.shortening.iter_mut().map(|own| &mut own.matrix);
        let inertia = self.points.inertia.iter_mut().chain(&mut self.sections.inertia);
        for matrix in self.moment.iter_mut().chain(inertia).chain(shortening) {
            let symmetric = 0.5 * (&*matrix + matrix.transpose());
            if (&symmetric - &*matrix).amax() > ASYMMETRY * matrix.amax() {
                return problem("has a block that is not symmetric");
            }
            *matrix = symmetric;
        }
        self.check_turned(mass, places)?;
        Ok(self)
    }

    /// A rigid rotation of a part rotates its inertia.
    fn check_turned(&self, mass: &DMatrix<f64>, places: &[Vector3]) -> Result<(), ParameterError> {
        if places.len() < 2 {
            return Ok(());
        }
        let size = mass.nrows();
        let places: Vec<Vector3> = places.iter().map(|place| place - places[0]).collect();
        let turn = |k: usize| DVector::from_vec(rigid_column(&places, size, 3 + k));
        let turns = [0, 1, 2].map(turn);
        let whole = Matrix3::from_fn(|i, j| turns[i].dot(&(mass * &turns[j])));
        let slope = &self.points.slope + &self.sections.slope;
        for (k, turned) in turns.iter().enumerate() {
            let about = skew(&Vector3::ith(k, 1.0));
            let expected = about * whole + whole * about.transpose();
            for (row, [i, j]) in PAIRS.into_iter().enumerate() {
                let found = slope.row(row).transpose().dot(turned);
                if (found - expected[(i, j)]).abs() > ASYMMETRY * whole.amax() {
                    return problem(format!(
                        "does not match the mass: rotated about its first interface the part would have another inertia ({:.3e} \
                         instead of {:.3e} kg m² per radian); look at the order of rows and at the units",
                        Written(found),
                        Written(expected[(i, j)])
                    ));
                }
            }
        }
        Ok(())
    }
}
