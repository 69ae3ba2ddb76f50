//! Elastic law of a shell's section: from strains of the reference surface to forces and moments per length.

use lissom_motion::Vector3;
use nalgebra::{Matrix2, Matrix3, SMatrix, SVector};

/// 8 x 8 stiffness of a section.
pub type Matrix8 = SMatrix<f64, 8, 8>;

/// Elastic law of a shell's section in its local axes 1 and 2.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellLaw {
    /// Forces and moments per length N11, N22, N12 [N/m], M11, M22, M12 [N], Q13, Q23 [N/m] for the strains ε11, ε22, 2 ε12,
    /// κ11, κ22, 2 κ12, 2 ε13, 2 ε23. Symmetric; transverse shear is not coupled with the others.
    pub stiffness: Matrix8,
    /// Strains ε11, ε22, 2 ε12, κ11, κ22, 2 κ12 without forces and moments, as of a change of temperature.
    pub free: [f64; 6],
    /// Stiffness of the rotation about the normal relative to the surface [N/m]: a small fraction of that of shear in the plane.
    pub drilling: f64,
}

/// Shear correction of a homogeneous plate [Reissner 1945].
pub const SHEAR_CORRECTION: f64 = 5.0 / 6.0;
/// Stiffness of drilling over that of shear in the plane: small enough to change nothing, large enough to remain a pivot.
pub const DRILLING_SHARE: f64 = 1e-3;

/// Von Mises stress of stresses 11, 22, 12 in a plane.
pub fn von_mises([s11, s22, s12]: [f64; 3]) -> f64 {
    (s11 * s11 - s11 * s22 + s22 * s22 + 3.0 * s12 * s12).max(0.0).sqrt()
}

/// A layer of a laminate, orthotropic in its plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ply {
    /// Thickness [m].
    pub thickness: f64,
    /// Angle from the first local axis to its fibres about the normal [rad].
    pub angle: f64,
    /// Young's moduli along and across the fibres E1, E2 [Pa].
    pub young: [f64; 2],
    /// Poisson's ratio ν12: contraction across over extension along the fibres.
    pub poisson: f64,
    /// Shear moduli G12, G13, G23 [Pa].
    pub shear: [f64; 3],
    /// Density [kg/m³].
    pub density: f64,
    /// Stresses 11, 22, 12 without strain in the local axes of the shell [Pa].
    pub initial: [f64; 3],
}

/// From strains 11, 22, 2 12 to those along and across fibres at an angle [rad].
fn to_fibres(angle: f64) -> Matrix3<f64> {
    let (s, c) = angle.sin_cos();
    Matrix3::new(c * c, s * s, c * s, s * s, c * c, -c * s, -2.0 * c * s, 2.0 * c * s, c * c - s * s)
}

impl Ply {
    /// A layer of an isotropic material.
    pub fn isotropic(thickness: f64, young: f64, poisson: f64, density: f64) -> Self {
        let shear = young / (2.0 * (1.0 + poisson));
        Self {
            thickness,
            angle: 0.0,
            young: [young; 2],
            poisson,
            shear: [shear; 3],
            density,
            initial: [0.0; 3],
        }
    }

    /// Plane stresses 11, 22, 12 for the strains 11, 22, 2 12 in the local axes of the shell [Pa].
    pub fn in_plane(&self) -> Matrix3<f64> {
        let [e1, e2] = self.young;
        let across = self.poisson * e2 / e1;
        let divisor = 1.0 - self.poisson * across;
        let own = Matrix3::new(
            e1 / divisor,
            self.poisson * e2 / divisor,
            0.0,
            self.poisson * e2 / divisor,
            e2 / divisor,
            0.0,
            0.0,
            0.0,
            self.shear[0],
        );
        let to_fibres = to_fibres(self.angle);
        to_fibres.transpose() * own * to_fibres
    }

    /// The layer where strains along and across the fibres are free [-], on top of its stresses without strain.
    #[must_use]
    pub fn expanded(mut self, [along, across]: [f64; 2]) -> Self {
        // The angle of the opposite sign turns back.
        let free = to_fibres(-self.angle) * Vector3::new(along, across, 0.0);
        let stress = self.in_plane() * free;
        self.initial.iter_mut().zip(&stress).for_each(|(sum, value)| *sum -= value);
        self
    }

    /// Transverse shear stresses 13, 23 for the strains 2 13, 2 23 [Pa].
    fn transverse(&self) -> Matrix2<f64> {
        let (s, c) = self.angle.sin_cos();
        let to_fibres = Matrix2::new(c, s, -s, c);
        to_fibres.transpose() * Matrix2::new(self.shear[1], 0.0, 0.0, self.shear[2]) * to_fibres
    }
}

impl ShellLaw {
    /// A laminate of layers from the bottom to the top, with the middle of its thickness at `offset` [m] along the normal of the reference
    /// surface, by classical laminate theory with transverse shear.
    pub fn laminate(plies: &[Ply], offset: f64) -> Self {
        let mut stiffness = Matrix8::zeros();
        let whole: f64 = plies.iter().map(|ply| ply.thickness).sum();
        let mut below = offset - 0.5 * whole;
        let mut add = |row: usize, column: usize, block: &Matrix3<f64>| {
            let mut own = stiffness.fixed_view_mut::<3, 3>(row, column);
            own += block;
        };
        let (mut shear, mut in_plane) = (Matrix2::zeros(), 0.0);
        let mut initial = SVector::<f64, 6>::zeros();
        for ply in plies {
            let above = below + ply.thickness;
            let own = ply.in_plane();
            add(0, 0, &(own * ply.thickness));
            let first = own * (0.5 * (above * above - below * below));
            add(0, 3, &first);
            add(3, 0, &first);
            add(3, 3, &(own * ((above.powi(3) - below.powi(3)) / 3.0)));
            shear += ply.transverse() * (SHEAR_CORRECTION * ply.thickness);
            in_plane += own[(2, 2)] * ply.thickness;
            for (k, stress) in ply.initial.iter().enumerate() {
                initial[k] += stress * ply.thickness;
                initial[3 + k] += 0.5 * stress * (above * above - below * below);
            }
            below = above;
        }
        stiffness.fixed_view_mut::<2, 2>(6, 6).copy_from(&shear);
        let free = stiffness.fixed_view::<6, 6>(0, 0).into_owned().cholesky();
        let free = free.map_or([0.0; 6], |factors| (-factors.solve(&initial)).into());
        Self { stiffness, free, drilling: DRILLING_SHARE * in_plane }
    }

    /// The strains' stiffness with drilling as ninth.
    pub(super) fn with_drilling(&self) -> SMatrix<f64, 9, 9> {
        let mut all = SMatrix::<f64, 9, 9>::zeros();
        all.fixed_view_mut::<8, 8>(0, 0).copy_from(&self.stiffness);
        all[(8, 8)] = self.drilling;
        all
    }
}
