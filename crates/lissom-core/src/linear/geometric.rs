//! Second-order matrices of an assembly that is reduced: what its inertial and elastic forces do to second order in the shapes.
//!
//! Legend: Ψ_k shapes, with the first interface held but for its own; nodes at X + t Ψ_k are displaced along straight lines and turned by
//! rotation vectors, B_j variations of y_j there, g_j = B_j·r generalised force of a residual r; w displacements of a load state.
//!
//! ```text
//! steady rotation ω       g = -½ Σ ω_i ω_j (α_ij + A_ij y)
//! acceleration ω̇, a       g = … + Σ ω̇_i B_iᵀ y,      g = … + Σ a_k S_k y
//! load state w            K_g[w] = ∂²g/∂w ∂y
//! ```
//!
//! Shapes of first order stretch what they bend. What shortens instead does work against a load -r by -½ y·K_g[w] y, with K w = -r and
//! the interfaces held: A - K_g for rotation, B + K_g for ω̇, S + K_g for a. The interfaces themselves come nearer by h_k = ½ y·D_k y,
//! D_k = K_g[w_k], w_k under a unit force on interface k along the direction from the first [Wallrapp and Schwertassek 1991].

use lissom_motion::{Matrix3, Rotation, Vector3, Vector6, rotation_tangent, screw};
use nalgebra::{DMatrix, DVector};

use super::model::{LinearModel, nothing, point};
use super::reduction::{Assembly, ReductionError};
use super::shifted::RealShift;
use crate::elements::superelement::{GeometricMatrices, PAIRS, ReducedMatrices, flexibility};
use crate::system::{Kinematics, LOCKED, System};

/// Displacements of differences, as part of the model's length.
const DISPLACED: f64 = 1e-4;
/// A rigid motion about the first interface.
#[derive(Clone, Copy)]
enum Carried {
    /// At rest.
    Still,
    /// Steady rotation [rad/s].
    Turning(Vector3),
    /// From rest: acceleration of the first interface [m/s²], angular acceleration [rad/s²].
    Accelerated(Vector3, Vector3),
}

/// Forces of the assembly along shapes.
struct Forces<'a> {
    system: &'a System,
    at: &'a Kinematics,
    origin: Vector3,
    shapes: &'a [Vec<f64>],
    multipliers: Vec<f64>,
    room: Vec<f64>,
}

impl Forces<'_> {
    /// Six numbers of a shape at a node, in its axes.
    fn of_node(&self, shape: &[f64], node: usize) -> Vector6 {
        let rows = self.system.layout().rows_of_node(node);
        Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { shape[rows[k] as usize] })
    }

    /// The assembly displaced by `shape` and carried along.
    fn displaced(&self, shape: &[f64], carried: Carried) -> Kinematics {
        let mut at = self.at.clone();
        for node in 1..at.nodes.len() {
            let own = self.of_node(shape, node);
            let (linear, angular) =
                (own.fixed_rows::<3>(0).into_owned(), own.fixed_rows::<3>(3).into_owned());
            let motion = &mut at.nodes[node];
            motion.frame.position += motion.frame.rotation.apply(&linear);
            motion.frame.rotation = motion.frame.rotation * Rotation::exponential(&angular);
            let arm = motion.frame.position - self.origin;
            let turned = |vector: Vector3| motion.frame.rotation.apply_inverse(&vector);
            let (twist, acceleration) = match carried {
                Carried::Still => (Vector6::zeros(), Vector6::zeros()),
                Carried::Turning(spin) => (screw(&turned(spin.cross(&arm)), &turned(spin)), Vector6::zeros()),
                Carried::Accelerated(linear, angular) => {
                    (Vector6::zeros(), screw(&turned(linear + angular.cross(&arm)), &turned(angular)))
                }
            };
            (motion.twist, motion.acceleration) = (twist, acceleration);
        }
        for (coordinate, motion) in at.coordinates.iter_mut().enumerate() {
            motion.value += shape[self.system.layout().row_of_coordinate(coordinate)];
            (motion.rate, motion.acceleration) = (0.0, 0.0);
        }
        at
    }

    /// Residual in the rows of the unknowns.
    fn residual(&mut self, at: &Kinematics) -> &[f64] {
        let (still, unchanged) = nothing(at);
        let here = point(at, (&still, &unchanged), &self.multipliers, &self.multipliers);
        self.system.residual(&here, &mut self.room);
        &self.room
    }

    /// Generalised forces along all shapes, displaced by `shape`.
    fn along(&mut self, shape: &[f64], carried: Carried) -> DVector<f64> {
        let at = self.displaced(shape, carried);
        self.residual(&at);
        let mut found = DVector::zeros(self.shapes.len());
        for node in 1..self.at.nodes.len() {
            let rows = self.system.layout().rows_of_node(node);
            if rows.contains(&LOCKED) && rows.iter().all(|row| *row == LOCKED) {
                continue;
            }
            let force = self.of_node(&self.room, node);
            let turned = self.of_node(shape, node).fixed_rows::<3>(3).into_owned();
            // Forces in the axes of the node before it was turned, moments dual to the rotation vector.
            let linear = Rotation::exponential(&turned).apply(&force.fixed_rows::<3>(0).into_owned());
            let map: Matrix3 = rotation_tangent(&turned);
            let angular = map.tr_mul(&force.fixed_rows::<3>(3).into_owned());
            let dual = screw(&linear, &angular);
            for (k, own) in self.shapes.iter().enumerate() {
                found[k] += self.of_node(own, node).dot(&dual);
            }
        }
        for coordinate in 0..self.at.coordinates.len() {
            let row = self.system.layout().row_of_coordinate(coordinate);
            for (k, own) in self.shapes.iter().enumerate() {
                found[k] += own[row] * self.room[row];
            }
        }
        found
    }

    /// The largest displacement of a shape, rotations times `length`.
    fn size(&self, shape: &[f64], length: f64) -> f64 {
        let of_nodes = (1..self.at.nodes.len()).map(|node| {
            let own = self.of_node(shape, node);
            own.fixed_rows::<3>(0).norm().max(length * own.fixed_rows::<3>(3).norm())
        });
        let of_coordinates = (0..self.at.coordinates.len())
            .map(|coordinate| shape[self.system.layout().row_of_coordinate(coordinate)].abs());
        of_nodes.chain(of_coordinates).fold(0.0, f64::max)
    }

    /// ∂g/∂y with what carries it along, less what it is at rest: a column per shape from `first` on.
    fn carried_slope(&mut self, carried: Carried, steps: &[f64], first: usize) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(steps.len(), steps.len());
        for (k, step) in steps.iter().enumerate().skip(first) {
            let [plus, minus] = [*step, -*step].map(|step| {
                let shape = scaled(&self.shapes[k], step);
                self.along(&shape, carried) - self.along(&shape, Carried::Still)
            });
            matrix.set_column(k, &((plus - minus) / (2.0 * step)));
        }
        matrix
    }

    /// K_g of a load state.
    fn geometric(&mut self, state: &[f64], (steps, first): (&[f64], usize), length: f64) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(steps.len(), steps.len());
        let size = self.size(state, length);
        if size <= 0.0 {
            return matrix;
        }
        let far = DISPLACED * length / size;
        for (k, step) in steps.iter().enumerate().skip(first) {
            let mut sum = DVector::zeros(steps.len());
            for (one, other) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let shape: Vec<f64> = state
                    .iter()
                    .zip(&self.shapes[k])
                    .map(|(state, own)| one * far * state + other * step * own)
                    .collect();
                sum.axpy(one * other, &self.along(&shape, Carried::Still), 1.0);
            }
            matrix.set_column(k, &(sum / (4.0 * far * step)));
        }
        matrix.rows_mut(0, first).fill(0.0);
        symmetric(&matrix)
    }
}

fn symmetric(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    0.5 * (matrix + matrix.transpose())
}

fn scaled(shape: &[f64], factor: f64) -> Vec<f64> {
    shape.iter().map(|value| factor * value).collect()
}

impl Assembly<'_> {
    /// Second-order matrices over `shapes`, six of each interface and then modes; none with joints within the assembly.
    ///
    /// # Errors
    /// If the assembly with its interfaces held cannot be solved for.
    pub(super) fn second_order(
        &self,
        shapes: &[Vec<f64>],
        matrices: &ReducedMatrices,
        inner: Option<&LinearModel<'_>>,
    ) -> Result<Option<GeometricMatrices>, ReductionError> {
        let layout = self.free.layout();
        let Some(locked) = self.locked else { return Ok(None) };
        let Some(model) = inner.filter(|_| layout.size() == layout.coordinate_count()) else {
            return Ok(None);
        };
        let mut at = self.state.kinematics.clone();
        for node in &mut at.nodes {
            node.twist.fill(0.0);
            node.acceleration.fill(0.0);
        }
        let origin = at.nodes[self.interfaces[0]].frame.position;
        let length = model.length();
        let mut forces = Forces {
            system: self.free,
            at: &at,
            origin,
            shapes,
            multipliers: Vec::new(),
            room: vec![0.0; layout.size()],
        };
        let (size, first) = (shapes.len(), 6.min(shapes.len()));
        let steps: Vec<f64> = shapes
            .iter()
            .map(|shape| DISPLACED * length / forces.size(shape, length).max(f64::MIN_POSITIVE))
            .collect();
        let clean = |mut matrix: DMatrix<f64>| {
            matrix.rows_mut(0, first).fill(0.0);
            matrix
        };
        let none = vec![0.0; layout.size()];
        let rest = forces.along(&none, Carried::Still);
        let rest_rows = forces.room.clone();
        // Inertia goes with the square of the rate: it is taken at one at which it is of the size of the elastic forces.
        let rate = (first..size)
            .map(|k| matrices.stiffness[(k, k)] / matrices.mass[(k, k)])
            .fold(0.0, f64::max)
            .sqrt()
            .max(f64::MIN_POSITIVE);
        let mut solver = RealShift::new(locked, &model.representative);
        solver.factor(&model.parts, 0.0).map_err(|error| model.stopped(&error))?;
        let rows = self.inner_rows(locked);
        let mut loaded = |forces: &mut Forces<'_>, carried: Carried| {
            let moving = forces.displaced(&none, carried);
            let load = forces.residual(&moving).to_vec();
            let mut right = vec![0.0; locked.layout().size()];
            for &(free, own) in &rows {
                right[own] = rest_rows[free] - load[free];
            }
            solver.solve(&mut right);
            let mut state = vec![0.0; none.len()];
            for &(free, own) in &rows {
                state[free] = right[own];
            }
            forces.geometric(&state, (&steps, first), length)
        };
        let axis = |k: usize| Vector3::ith(k, 1.0);
        let mut slope = DMatrix::zeros(PAIRS.len(), size);
        let mut inertia: Vec<DMatrix<f64>> = Vec::with_capacity(PAIRS.len());
        let square = rate * rate;
        for (k, [i, j]) in PAIRS.into_iter().enumerate() {
            let spin = if i == j { axis(i) } else { axis(i) + axis(j) };
            let carried = Carried::Turning(rate * spin);
            // ω ω (α + A y), with both entries of a pair.
            let mut own = (forces.along(&none, carried) - &rest) * (-2.0 / square);
            let mut matrix = clean(forces.carried_slope(carried, &steps, first)) * (-2.0 / square);
            matrix -= loaded(&mut forces, carried) * (2.0 / square);
            if i != j {
                for other in [i, j] {
                    own -= slope.row(other).transpose();
                    matrix -= &inertia[other];
                }
                (own, matrix) = (0.5 * own, 0.5 * matrix);
            }
            slope.row_mut(k).tr_copy_from(&own);
            inertia.push(symmetric(&matrix));
        }
        let mut carried_matrices = |carried: Carried| {
            let direct = clean(forces.carried_slope(carried, &steps, first)) / square;
            direct + loaded(&mut forces, carried) / square
        };
        let none = Vector3::zeros();
        let momentum =
            [0, 1, 2].map(|k| carried_matrices(Carried::Accelerated(none, square * axis(k))).transpose());
        let moment =
            [0, 1, 2].map(|k| symmetric(&carried_matrices(Carried::Accelerated(square * axis(k), none))));
        let shortening = self.shortening(&mut forces, matrices, (&steps, first), length);
        let Ok(inertia) = <[DMatrix<f64>; 6]>::try_from(inertia) else { return Ok(None) };
        Ok(Some(GeometricMatrices { moment, slope, inertia, momentum, shortening }))
    }

    /// D of each interface but the first.
    fn shortening(
        &self,
        forces: &mut Forces<'_>,
        matrices: &ReducedMatrices,
        (steps, first): (&[f64], usize),
        length: f64,
    ) -> Vec<DMatrix<f64>> {
        let size = steps.len();
        let flexibility = flexibility(&matrices.stiffness, 0);
        let places: Vec<Vector3> = self
            .interfaces
            .iter()
            .map(|&node| self.state.kinematics.nodes[node].frame.position - forces.origin)
            .collect();
        let direction = |i: usize| {
            let distance = places[i].norm();
            if distance > 0.0 { places[i] / distance } else { Vector3::zeros() }
        };
        (1..self.interfaces.len())
            .map(|i| {
                let along = direction(i);
                let own: DVector<f64> = flexibility.columns(6 * i, 3) * along;
                let mut state = vec![0.0; forces.room.len()];
                for (k, shape) in forces.shapes.iter().enumerate().skip(first) {
                    state.iter_mut().zip(shape).for_each(|(sum, value)| *sum += own[k] * value);
                }
                let mut matrix = forces.geometric(&state, (steps, first), length);
                // What is stretched itself counts once: in h of all interfaces a term of two or three of them comes up as often.
                let mut onto = DMatrix::zeros(size, size);
                for j in 1..self.interfaces.len() {
                    let direction = direction(j);
                    let block = direction * direction.transpose();
                    onto.fixed_view_mut::<3, 3>(6 * j, 6 * j).copy_from(&block);
                }
                let once = &onto * &matrix;
                let twice = &once * &onto;
                matrix -= 0.5 * (&once + once.transpose()) - twice / 3.0;
                matrix
            })
            .collect()
    }
}
