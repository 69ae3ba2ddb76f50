//! Reduction of a flexible assembly to its interfaces and some of its modes with fixed interfaces [Craig and Bampton
//! 1968].
//!
//! ```text
//! x = ψ b + φ q:      K ψ + Bᵀ μ = 0,  B ψ = 0  with the interfaces displaced by one unknown of b
//!                     K φ + Bᵀ μ = ω² M φ,  B φ = 0  with the interfaces held
//! M_r = Tᵀ M T,   D_r = Tᵀ D T,   K_r = Tᵀ K T,   T = [ψ φ]
//! ```
//!
//! K refers to body variations, and includes the stresses of the state. Forces f₀ on the interfaces there rotate with them. A
//! superelement has an energy f₀·u + ½ u·K u instead, in displacements u relative to one interface, whose forces in body axes
//! are the same to first order:
//!
//! ```text
//! δ(Eᵀ f) = δf - θ × f₀,      δ(T⁻ᵀ m) = δm - ½ θ × m₀
//! ```

use lissom_motion::{Matrix3, Vector3, skew};
use lissom_solver::Pattern;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::cubic::SecondOrder;
use super::mode::{Completeness, ModeError, ModeOptions};
use super::model::{LinearError, LinearModel, is_symmetric, nothing, point};
use super::shifted::RealShift;
use super::velocity_constraints::refuse;
use crate::diagnostics::{Diagnostic, diagnostics};
use crate::flexible::superelement::{Damping, ReducedMatrices};
use crate::joints::evaluation_point::Chart;
use crate::kinematics::{LOCKED, NodeId, Subject};
use crate::round_off;
use crate::system::{Linearization, State, System};

/// Forces of rigid displacements below this fraction of their terms are round-off.
const RIGID: f64 = 1e-6;

diagnostics! {
    /// An assembly that is not reduced.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure ReductionError {
        /// With the interfaces held the stiffness belongs to no energy, or rates have forces that do not damp.
        NotConservative {} => "reduction-not-conservative" {
            cause: ("the assembly with fixed interfaces is not conservative, but a superelement is linear elastic"),
            remedy: "remove follower loads and signals, and reduce it at rest",
            meaning: "With its interfaces held the assembly is not conservative, but a superelement is linear elastic.",
        }
        /// With the interfaces held there is an unstable mode.
        Unstable {} => "reduction-unstable" {
            cause: ("the assembly with fixed interfaces is unstable: the state is beyond buckling, or parts are stabilised by their \
                    stress only"),
            remedy: "reduce it under smaller loads, or constrain the parts that are stabilised by their stress only",
            meaning: "With its interfaces held the assembly is unstable.",
        }
        /// Forces act between the interfaces.
        Unbalanced {
            /// Displacement by these forces over the length of the assembly.
            displacement: f64,
        } => "reduction-unbalanced" {
            cause: ("forces between the interfaces are not balanced within the assembly: they would displace it by {displacement:.1e} \
                    of its length"),
            remedy: "declare the loaded node as an interface, or remove the load",
            meaning: "Forces that act on the assembly between its interfaces are not balanced within it.",
        }
        /// Something holds the assembly, or pulls at it, in directions fixed in space.
        Held {
            /// Name of the unknown.
            unknown: Subject,
            /// Force per unit of the rigid motion.
            force: f64,
            /// Sum of the magnitudes of its terms.
            terms: f64,
        } => "reduction-held" {
            subject: unknown,
            cause: ("a rigid motion of the assembly is not free of forces: the {unknown} has {force:.1e} of terms of {terms:.1e}"),
            remedy: "remove connections to the ground, and loads with directions fixed in space",
            meaning: "Forces act on the assembly in a rigid motion.",
        }
    }
    wraps {
        /// A factorisation stopped.
        Linear(LinearError), (error) => Diagnostic {
            remedy: "join what moves freely between the interfaces, or make it an interface".to_owned(),
            ..error.diagnostic().within("with its interfaces held the assembly has no solution")
        },
        /// There are no modes.
        Modes(ModeError), (error) => error.diagnostic().within("the modes with interfaces held"),
    }
}

impl From<LinearError> for ReductionError {
    fn from(error: LinearError) -> Self {
        Self::Linear(error)
    }
}

impl From<ModeError> for ReductionError {
    fn from(error: ModeError) -> Self {
        Self::Modes(error)
    }
}

/// A reduced assembly.
#[derive(Clone, Debug)]
pub struct Reduction {
    /// Matrices of the part: six unknowns of each interface in inertial axes, then the modes of unit modal mass.
    pub matrices: ReducedMatrices,
    /// Positions of the interfaces [m].
    pub places: Vec<Vector3>,
    /// Frequencies of the modes with fixed interfaces [Hz].
    pub frequencies: Vec<f64>,
    /// Number of correction shapes after the modes.
    pub corrections: usize,
    /// Whether a count shows that no mode was missed.
    pub is_counted: bool,
    /// Number of unknowns that were reduced.
    pub unknowns: usize,
    /// Displacements of the unknowns that were reduced, by row of the layout, for each unknown of the matrices.
    pub shapes: DMatrix<f64>,
    /// Second-order terms over all shapes; [`Self::with_modes`] builds matrices from them.
    pub(super) second_order: Option<SecondOrder>,
}

/// The input of a reduction: the assembly, the same with fixed interfaces (none if nothing remains then), and its state.
pub struct Assembly<'a> {
    /// With free interfaces.
    pub free: &'a System,
    /// With locked interfaces: the same nodes, coordinates and joints.
    pub locked: Option<&'a System>,
    /// Positions in equilibrium, without velocities.
    pub state: &'a State,
    /// The interfaces, the first of which carries the floating frame.
    pub interfaces: &'a [NodeId],
    /// Solver for accelerations.
    pub solver: &'a lissom_solver::SolverKind,
}

impl Assembly<'_> {
    /// Reduces to the interfaces and at most this number of modes with fixed interfaces, or of the free assembly.
    ///
    /// # Errors
    /// If the assembly with fixed interfaces is a mechanism, not elastic, or not in equilibrium, or if something other than the
    /// interfaces supports it.
    pub fn reduce(&self, modes: usize, are_free: bool) -> Result<Reduction, ReductionError> {
        refuse(self.free)?;
        let mut model =
            self.locked.map(|system| LinearModel::of(system, self.state, self.solver)).transpose()?;
        let multipliers = model.as_ref().map_or_else(
            || vec![0.0; self.free.layout().multiplier_rows().len()],
            |model| model.multipliers().to_vec(),
        );
        let whole = Whole::of(self, &multipliers);
        let length = model.as_ref().map_or(1.0, LinearModel::length);
        if let Some(model) = model.as_ref().filter(|model| model.imbalance() > round_off::POSITION) {
            return Err(ReductionError::Unbalanced { displacement: model.imbalance() });
        }
        whole.check_rigid(self)?;
        let mut columns = self.boundary_columns();
        let (mut frequencies, mut is_counted) = (Vec::new(), true);
        if let (Some(model), Some(locked)) = (model.as_mut(), self.locked) {
            self.add_static_shapes(&whole, model, locked, &mut columns)?;
            model.parts.damping.fill(0.0);
            if !is_symmetric(locked, &model.representative, &model.parts) {
                return Err(ReductionError::NotConservative {});
            }
            model.is_conservative = true;
            if modes > 0 && are_free {
                is_counted = self.add_free_modes(modes, &whole, (&mut columns, &mut frequencies))?;
            } else if modes > 0 {
                let found = model.modes(&ModeOptions { count: modes, shift: None })?;
                is_counted = found.completeness == Completeness::Counted;
                for mode in found.modes {
                    if mode.kind.is_unstable() || mode.frequency == 0.0 {
                        return Err(ReductionError::Unstable {});
                    }
                    let mut column = vec![0.0; whole.size];
                    for (free, inner) in self.inner_rows(locked) {
                        column[free] = mode.shape[inner].re;
                    }
                    columns.push(column);
                    frequencies.push(mode.frequency);
                }
            }
        }
        let matrices = self.projected(&whole, &columns, length);
        let mut second_order = None;
        if whole.residual.iter().all(|force| force.is_finite()) {
            second_order = self.second_order(&columns, (&matrices, &whole.parts.mass), model.as_ref())?;
        }
        let places = self.interfaces.iter().map(|&node| self.state.kinematics.nodes[node].frame.position);
        Ok(Reduction {
            matrices,
            places: places.collect(),
            frequencies,
            corrections: 0,
            is_counted,
            unknowns: self.free.layout().coordinate_count(),
            shapes: DMatrix::from_fn(self.free.layout().coordinate_count(), columns.len(), |i, j| {
                columns[j][i]
            }),
            second_order,
        })
    }

    /// Pairs of rows of the unknowns: in the free assembly and in the one with locked interfaces.
    pub(super) fn inner_rows(&self, locked: &System) -> Vec<(usize, usize)> {
        let (free, inner) = (self.free.layout(), locked.layout());
        let of_nodes = free.nodes().flat_map(|node| {
            let rows = free.rows_of_node(node).iter().zip(inner.rows_of_node(node));
            rows.filter(|(_, row)| **row != LOCKED)
                .map(|(one, other)| (*one as usize, *other as usize))
                .collect::<Vec<_>>()
        });
        let of_coordinates = free
            .coordinates()
            .map(|coordinate| (free.row_of_coordinate(coordinate), inner.row_of_coordinate(coordinate)));
        of_nodes.chain(of_coordinates).collect()
    }

    /// One column per unknown of the interfaces, in inertial axes, zero elsewhere.
    fn boundary_columns(&self) -> Vec<Vec<f64>> {
        let layout = self.free.layout();
        let mut columns = Vec::with_capacity(6 * self.interfaces.len());
        for &node in self.interfaces {
            let rotation = self.state.kinematics.nodes[node].frame.rotation;
            let rows = layout.rows_of_node(node);
            for k in 0..6 {
                let own = rotation.apply_inverse(&Vector3::ith(k % 3, 1.0));
                let mut column = vec![0.0; layout.size()];
                for i in 0..3 {
                    column[rows[k / 3 * 3 + i] as usize] = own[i];
                }
                columns.push(column);
            }
        }
        columns
    }

    /// Adds to the columns the static displacements of the assembly between displaced interfaces.
    fn add_static_shapes(
        &self,
        whole: &Whole,
        model: &LinearModel<'_>,
        locked: &System,
        columns: &mut [Vec<f64>],
    ) -> Result<(), ReductionError> {
        let mut solver = RealShift::new(locked, &model.representative);
        solver.factor(&model.parts, 0.0).map_err(|error| model.stopped(&error))?;
        let (free_count, count) = (self.free.layout().coordinate_count(), locked.layout().coordinate_count());
        let inner = self.inner_rows(locked);
        let multipliers = self.free.layout().multiplier_rows().len();
        let mut right = vec![0.0; locked.layout().size()];
        for column in columns {
            // Refined: the remaining forces and violations are solved for again.
            for _ in 0..2 {
                let forces = whole.times_constrained(self.free, &column[..]);
                for &(free, own) in &inner {
                    right[own] = -forces[free];
                }
                for k in 0..multipliers {
                    right[count + k] = -forces[free_count + k];
                }
                solver.solve(&mut right);
                for &(free, own) in &inner {
                    column[free] += right[own];
                }
                let factor = solver.multiplier_factor();
                for k in 0..multipliers {
                    column[free_count + k] += factor * right[count + k];
                }
            }
            column[free_count..].fill(0.0);
        }
        Ok(())
    }

    /// Adds the elastic modes of the free assembly, less the static displacements with the same motion of the interfaces: together
    /// with these they span the modes. They are combined to natural modes with fixed interfaces. Returns whether a count
    /// shows that none was missed.
    fn add_free_modes(
        &self,
        count: usize,
        whole: &Whole,
        (columns, frequencies): (&mut Vec<Vec<f64>>, &mut Vec<f64>),
    ) -> Result<bool, ReductionError> {
        let rigid_motions = 6;
        let mut model = LinearModel::of(self.free, self.state, self.solver)?;
        if model.imbalance() > round_off::POSITION {
            return Err(ReductionError::Unbalanced { displacement: model.imbalance() });
        }
        model.parts.damping.fill(0.0);
        model.is_conservative = true;
        let found = model.modes(&ModeOptions { count: count + rigid_motions, shift: None })?;
        let layout = self.free.layout();
        let size = layout.coordinate_count();
        // Without the static displacements with the same motion of the interfaces.
        let inner = |shape: Vec<f64>| {
            let mut own = shape.clone();
            own.resize(whole.size, 0.0);
            for (k, column) in columns.iter().enumerate() {
                let node = self.interfaces[k / 6];
                let rows = &layout.rows_of_node(node)[k % 6 / 3 * 3..][..3];
                let local = Vector3::from_fn(|i, _| shape[rows[i] as usize]);
                let moved = self.state.kinematics.nodes[node].frame.rotation.apply(&local)[k % 3];
                own.iter_mut().zip(column).for_each(|(own, by)| *own -= moved * by);
            }
            own
        };
        let all: Vec<Vec<f64>> = (found.modes.iter().skip(rigid_motions))
            .map(|mode| inner(mode.shape.iter().take(size).map(|own| own.re).collect()))
            .collect();
        // Shapes that are static ones except for round-off are none.
        let own = |parts: &[f64], all: &[Vec<f64>]| {
            let matrix = self.among(parts, all);
            SymmetricEigen::new(0.5 * (&matrix + matrix.transpose()))
        };
        let SymmetricEigen { eigenvectors, eigenvalues } = own(&whole.parts.mass, &all);
        let kept = (0..eigenvalues.len()).filter(|&k| eigenvalues[k] > 1e-10 * eigenvalues.amax());
        let unit = |k: usize| combined(&all, &(eigenvectors.column(k) / eigenvalues[k].sqrt()));
        let all: Vec<Vec<f64>> = kept.map(unit).collect();
        let SymmetricEigen { eigenvectors, eigenvalues } = own(&whole.parts.stiffness, &all);
        let mut order: Vec<usize> = (0..eigenvalues.len()).collect();
        order.sort_by(|&a, &b| eigenvalues[a].total_cmp(&eigenvalues[b]));
        for k in order {
            if eigenvalues[k] <= 0.0 {
                return Err(ReductionError::Unstable {});
            }
            columns.push(combined(&all, &eigenvectors.column(k).into_owned()));
            frequencies.push(eigenvalues[k].sqrt() / std::f64::consts::TAU);
        }
        Ok(found.completeness == Completeness::Counted)
    }

    /// Columnsᵀ matrix columns, for the values of a matrix on the pattern.
    fn among(&self, values: &[f64], columns: &[Vec<f64>]) -> DMatrix<f64> {
        let pattern = self.free.pattern();
        let mut image = vec![0.0; self.free.layout().size()];
        let mut matrix = DMatrix::zeros(columns.len(), columns.len());
        for (j, column) in columns.iter().enumerate() {
            pattern.multiply(values, column, &mut image);
            for (i, other) in columns.iter().enumerate() {
                matrix[(i, j)] = other.iter().zip(&image).map(|(a, b)| a * b).sum::<f64>();
            }
        }
        matrix
    }

    /// Projects the matrices on the columns.
    fn projected(&self, whole: &Whole, columns: &[Vec<f64>], length: f64) -> ReducedMatrices {
        let among = |values: &[f64]| self.among(values, columns);
        let mass = among(&whole.parts.mass);
        let damping = among(&whole.parts.damping);
        let mut stiffness = among(&whole.parts.stiffness);
        let count = self.free.layout().coordinate_count();
        let forces = columns.iter().map(|column| {
            column[..count].iter().zip(&whole.residual).map(|(shape, force)| shape * force).sum::<f64>()
        });
        let mut preload: Vec<f64> = forces.collect();
        let is_loaded = preload.iter().enumerate().any(|(row, force)| {
            let unit = if row % 6 < 3 { length } else { 1.0 };
            force.abs() > round_off::EQUILIBRIUM * unit * stiffness[(row, row)].abs()
        });
        if is_loaded {
            self.to_energy(&preload, &mut stiffness);
        } else {
            preload.clear();
        }
        let relative = self.relative(columns.len());
        let is_damped = damping.amax() > 0.0;
        let symmetric = |matrix: DMatrix<f64>| 0.5 * (&matrix + matrix.transpose());
        // Through displacements relative to the first interface: rigid motions are free of forces to the last digits.
        let through = |matrix: DMatrix<f64>| relative.transpose() * matrix * &relative;
        ReducedMatrices {
            mass: symmetric(mass),
            stiffness: symmetric(through(stiffness)),
            damping: if is_damped { Damping::Matrix(symmetric(through(damping))) } else { Damping::None },
            preload,
            geometric: None,
        }
    }

    /// Transforms forces in body axes to those of an energy, by the displacements relative to the first interface.
    fn to_energy(&self, preload: &[f64], stiffness: &mut DMatrix<f64>) {
        for i in 1..self.interfaces.len() {
            let part = |first: usize| Vector3::from_column_slice(&preload[6 * i + first..6 * i + first + 3]);
            for (first, factor) in [(0, 1.0), (3, 0.5)] {
                let turned: Matrix3 = factor * skew(&part(first));
                let mut block = stiffness.fixed_view_mut::<3, 3>(6 * i + first, 6 * i + 3);
                block -= turned;
            }
        }
    }

    /// Transformation from displacements to those relative to the first interface, which are zero there.
    fn relative(&self, size: usize) -> DMatrix<f64> {
        let mut map = DMatrix::identity(size, size);
        let nodes = &self.state.kinematics.nodes;
        let origin = nodes[self.interfaces[0]].frame.position;
        for (i, &node) in self.interfaces.iter().enumerate() {
            let arm = skew(&(nodes[node].frame.position - origin));
            for k in 0..6 {
                map[(6 * i + k, k)] -= 1.0;
            }
            let mut block = map.fixed_view_mut::<3, 3>(6 * i, 3);
            block += arm;
        }
        map
    }
}

/// The sum of columns by factors.
fn combined(columns: &[Vec<f64>], factors: &DVector<f64>) -> Vec<f64> {
    let mut sum = vec![0.0; columns.first().map_or(0, Vec::len)];
    for (column, factor) in columns.iter().zip(factors) {
        sum.iter_mut().zip(column).for_each(|(sum, own)| *sum += factor * own);
    }
    sum
}

/// The free assembly, linearised.
struct Whole {
    parts: Linearization,
    /// Forces of the state in the rows of the coordinates.
    residual: Vec<f64>,
    size: usize,
}

impl Whole {
    fn of(assembly: &Assembly<'_>, multipliers: &[f64]) -> Self {
        let Assembly { free, state, .. } = assembly;
        let zeros = vec![0.0; multipliers.len()];
        let mut at = state.kinematics.clone();
        for node in &mut at.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        for coordinate in &mut at.coordinates {
            (coordinate.rate, coordinate.acceleration) = (0.0, 0.0);
        }
        let (still, unchanged) = nothing(&at);
        let point = point(&at, (&still, &unchanged), multipliers, &zeros);
        let mut parts = free.empty_linearization();
        free.linearize(&point, Chart::Body, &mut parts);
        let size = free.layout().size();
        let mut residual = vec![0.0; size];
        free.residual(&point, &mut residual);
        residual.truncate(free.layout().coordinate_count());
        Self { parts, residual, size }
    }

    /// Forces K x + Bᵀ μ and violations B x.
    fn times_constrained(&self, system: &System, x: &[f64]) -> Vec<f64> {
        let pattern = system.pattern();
        let (mut forces, mut constrained) = (vec![0.0; self.size], vec![0.0; self.size]);
        pattern.multiply(&self.parts.stiffness, x, &mut forces);
        pattern.multiply(&self.parts.constraint, x, &mut constrained);
        for (force, other) in forces.iter_mut().zip(&constrained) {
            *force += other;
        }
        forces
    }

    /// Square roots of the diagonal of the stiffness: rows and columns divided by them have one unit. What is round-off of the largest one,
    /// as of a body without springs, counts as round-off.
    fn scale(&self, pattern: &Pattern) -> Vec<f64> {
        let own = |row| pattern.position(row, row).map_or(0.0, |at| self.parts.stiffness[at].abs().sqrt());
        let scale: Vec<f64> = (0..self.size).map(own).collect();
        let least = f64::EPSILON * scale.iter().copied().fold(0.0, f64::max);
        scale.into_iter().map(|own| own.max(least)).collect()
    }

    /// Fails if a rigid motion causes forces: coordinates of joints do not change in it.
    fn check_rigid(&self, assembly: &Assembly<'_>) -> Result<(), ReductionError> {
        let (system, at) = (assembly.free, &assembly.state.kinematics);
        let layout = system.layout();
        let pattern = system.pattern();
        let origin = at.nodes[assembly.interfaces[0]].frame.position;
        let sizes: Vec<f64> = self.parts.stiffness.iter().map(|value| value.abs()).collect();
        let scale = self.scale(&pattern);
        for k in 0..6 {
            let axis = Vector3::ith(k % 3, 1.0);
            let (mut motion, mut forces, mut terms) =
                (vec![0.0; self.size], vec![0.0; self.size], vec![0.0; self.size]);
            for (node, place) in NodeId::enumerate(&at.nodes).skip(1) {
                let (linear, angular) = if k < 3 {
                    (axis, Vector3::zeros())
                } else {
                    (axis.cross(&(place.frame.position - origin)), axis)
                };
                let parts = [linear, angular].map(|own| place.frame.rotation.apply_inverse(&own));
                for (i, &row) in
                    layout.rows_of_node(node).iter().enumerate().filter(|(_, row)| **row != LOCKED)
                {
                    motion[row as usize] = parts[i / 3][i % 3];
                }
            }
            pattern.multiply(&self.parts.stiffness, &motion, &mut forces);
            let motion: Vec<f64> = motion.iter().map(|value| value.abs()).collect();
            pattern.multiply(&sizes, &motion, &mut terms);
            // Terms may be round-off themselves: their bound is the norm of the stiffness, scaled to one unit by its
            // diagonal.
            let norm = motion.iter().zip(&scale).map(|(own, scale)| own * scale).fold(0.0, f64::max);
            let wrong = (0..layout.coordinate_count()).find(|&row| {
                forces[row].abs() > RIGID * terms[row] + round_off::EIGENVALUE * scale[row] * norm
            });
            if let Some(row) = wrong {
                return Err(ReductionError::Held {
                    unknown: layout.subject_of(row),
                    force: forces[row].abs(),
                    terms: terms[row],
                });
            }
        }
        Ok(())
    }
}
