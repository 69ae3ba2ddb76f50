//! Second-order matrices of a reduced assembly: its inertial and elastic forces to second order in the shapes.
//!
//! Legend: Ψ_k shapes, with the first interface fixed except for its own; nodes at X + t Ψ_k are displaced along straight lines
//! and rotated by rotation vectors, B_j variations of y_j there, g_j = B_j·r generalised force of a residual r; w displacements
//! of a load state.
//!
//! ```text
//! steady rotation ω       g = -½ Σ ω_i ω_j (α_ij + A_ij y)
//! acceleration ω̇, a       g = … + Σ ω̇_i B_iᵀ y,      g = … + Σ a_k S_k y
//! load state w            K_g[w] = ∂²g/∂w ∂y
//! shape k                 T_k = K_g[Ψ_k]
//! ```
//!
//! First-order shapes stretch a part that they bend. The actual shortening does the work -½ y·K_g[w] y against a load -r, with K
//! w = -r and fixed interfaces: A - K_g for rotation, B + K_g for ω̇, S + K_g for a. `cubic` computes the part of it due to the
//! shapes.

use lissom_motion::{Matrix3, Rotation, Vector3, Vector6, rotation_tangent, screw};
use nalgebra::{DMatrix, DVector};

use super::DISPLACEMENT;
use super::carried_points::CarriedPoints;
use super::cubic::{LoadState, SecondOrder};
use super::model::{LinearModel, nothing, point};
use super::reduction::{Assembly, ReductionError};
use super::shifted::RealShift;
use crate::flexible::superelement::{GeometricMatrices, PAIRS, ReducedMatrices, TurningMatrices};
use crate::kinematics::{CoordinateId, Kinematics, LOCKED, NodeId};
use crate::system::System;

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
    /// Six components of a shape at a node, in its axes.
    fn of_node(&self, shape: &[f64], node: NodeId) -> Vector6 {
        let rows = self.system.layout().rows_of_node(node);
        Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { shape[rows[k] as usize] })
    }

    /// The assembly displaced by `shape` and moved rigidly.
    fn displaced(&self, shape: &[f64], carried: Carried) -> Kinematics {
        let mut at = self.at.clone();
        for node in self.system.layout().nodes().skip(1) {
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
        for (coordinate, motion) in CoordinateId::enumerate(&mut at.coordinates) {
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
        for node in self.system.layout().nodes().skip(1) {
            let rows = self.system.layout().rows_of_node(node);
            if rows.contains(&LOCKED) && rows.iter().all(|row| *row == LOCKED) {
                continue;
            }
            let force = self.of_node(&self.room, node);
            let turned = self.of_node(shape, node).fixed_rows::<3>(3).into_owned();
            // Forces in the axes of the node before its rotation, moments dual to the rotation vector.
            let linear = Rotation::exponential(&turned).apply(&force.fixed_rows::<3>(0).into_owned());
            let map: Matrix3 = rotation_tangent(&turned);
            let angular = map.tr_mul(&force.fixed_rows::<3>(3).into_owned());
            let dual = screw(&linear, &angular);
            for (k, own) in self.shapes.iter().enumerate() {
                found[k] += self.of_node(own, node).dot(&dual);
            }
        }
        for coordinate in self.system.layout().coordinates() {
            let row = self.system.layout().row_of_coordinate(coordinate);
            for (k, own) in self.shapes.iter().enumerate() {
                found[k] += own[row] * self.room[row];
            }
        }
        found
    }

    /// The largest displacement of a shape, rotations times `length`.
    fn size(&self, shape: &[f64], length: f64) -> f64 {
        let layout = self.system.layout();
        let of_nodes = layout.nodes().skip(1).map(|node| {
            let own = self.of_node(shape, node);
            own.fixed_rows::<3>(0).norm().max(length * own.fixed_rows::<3>(3).norm())
        });
        let of_coordinates =
            layout.coordinates().map(|coordinate| shape[layout.row_of_coordinate(coordinate)].abs());
        of_nodes.chain(of_coordinates).fold(0.0, f64::max)
    }

    /// ∂g/∂y in this rigid motion minus that at rest: a column per shape from `first` on.
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
        let far = DISPLACEMENT * length / size;
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

/// Inertial terms of a motion of the frame, and the static state under it.
struct OfMotion {
    direct: DMatrix<f64>,
    state: LoadState,
}

impl OfMotion {
    fn combine(&mut self, other: &Self, factor: f64) {
        self.direct += &other.direct * factor;
        self.state.combine(&other.state, factor);
    }

    fn scale(&mut self, factor: f64) {
        self.direct *= factor;
        self.state.scale(factor);
    }
}

/// Static response of the interior of an assembly, with fixed interfaces, to motions of the frame.
struct Response<'a> {
    solver: RealShift<'a>,
    locked: &'a System,
    /// Rows of the interior: in the free system, and in the one with fixed interfaces.
    rows: Vec<(usize, usize)>,
    /// Forces at rest.
    rest: Vec<f64>,
    stiffness: &'a DMatrix<f64>,
    /// The first shape that is a mode.
    modes: usize,
    steps: &'a [f64],
    first: usize,
    length: f64,
}

impl Response<'_> {
    fn to(&mut self, forces: &mut Forces<'_>, carried: Carried) -> OfMotion {
        let shapes = forces.shapes;
        let none = vec![0.0; self.rest.len()];
        let mut direct = forces.carried_slope(carried, self.steps, self.first);
        direct.rows_mut(0, self.first).fill(0.0);
        let moving = forces.displaced(&none, carried);
        let load = forces.residual(&moving).to_vec();
        let mut right = vec![0.0; self.locked.layout().size()];
        for &(free, own) in &self.rows {
            right[own] = self.rest[free] - load[free];
        }
        let response = DVector::from_fn(shapes.len(), |k, _| {
            if k < self.modes {
                return 0.0;
            }
            let work: f64 = self.rows.iter().map(|&(free, own)| shapes[k][free] * right[own]).sum();
            work / self.stiffness[(k, k)]
        });
        self.solver.solve(&mut right);
        let mut state = none;
        for &(free, own) in &self.rows {
            state[free] = right[own];
        }
        for k in self.modes..shapes.len() {
            for &(free, _) in &self.rows {
                state[free] -= response[k] * shapes[k][free];
            }
        }
        let remainder = forces.geometric(&state, (self.steps, self.first), self.length);
        OfMotion { direct, state: LoadState { remainder, response } }
    }
}

impl Assembly<'_> {
    /// Second-order terms over `shapes`, six of each interface and then modes of unit mass, with the values `mass` of the
    /// assembly's matrix; none with joints within the assembly.
    ///
    /// # Errors
    /// If the assembly with fixed interfaces cannot be solved.
    pub(super) fn second_order(
        &self,
        shapes: &[Vec<f64>],
        (matrices, mass): (&ReducedMatrices, &[f64]),
        inner: Option<&LinearModel<'_>>,
    ) -> Result<Option<SecondOrder>, ReductionError> {
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
            .map(|shape| DISPLACEMENT * length / forces.size(shape, length).max(f64::MIN_POSITIVE))
            .collect();
        let none = vec![0.0; layout.size()];
        let rest = forces.along(&none, Carried::Still);
        let rest_rows = forces.room.clone();
        // Inertia is proportional to the square of the rate: it is evaluated at a rate for which it has the magnitude of
        // the elastic forces.
        let rate = (first..size)
            .map(|k| matrices.stiffness[(k, k)] / matrices.mass[(k, k)])
            .fold(0.0, f64::max)
            .sqrt()
            .max(f64::MIN_POSITIVE);
        let mut solver = RealShift::new(locked, &model.representative);
        solver.factor(&model.parts, 0.0).map_err(|error| model.stopped(&error))?;
        let mut response = Response {
            solver,
            locked,
            rows: self.inner_rows(locked),
            rest: rest_rows,
            stiffness: &matrices.stiffness,
            modes: 6 * self.interfaces.len(),
            steps: &steps,
            first,
            length,
        };
        let mut of_motion = |forces: &mut Forces<'_>, carried: Carried| response.to(forces, carried);
        let axis = |k: usize| Vector3::ith(k, 1.0);
        let mut slope = DMatrix::zeros(PAIRS.len(), size);
        let mut turning: Vec<OfMotion> = Vec::with_capacity(PAIRS.len());
        let square = rate * rate;
        for (k, [i, j]) in PAIRS.into_iter().enumerate() {
            let spin = if i == j { axis(i) } else { axis(i) + axis(j) };
            let carried = Carried::Turning(rate * spin);
            // ω ω (α + A y), with both entries of a pair.
            let mut own = (forces.along(&none, carried) - &rest) * (-2.0 / square);
            let mut matrices = of_motion(&mut forces, carried);
            matrices.scale(-2.0 / square);
            if i != j {
                for other in [i, j] {
                    own -= slope.row(other).transpose();
                    matrices.combine(&turning[other], -1.0);
                }
                own *= 0.5;
                matrices.scale(0.5);
            }
            slope.row_mut(k).tr_copy_from(&own);
            turning.push(matrices);
        }
        let zero = Vector3::zeros();
        let mut from_rest = |carried: Carried| {
            let mut own = of_motion(&mut forces, carried);
            own.scale(square.recip());
            own
        };
        let spun = [0, 1, 2].map(|k| from_rest(Carried::Accelerated(zero, square * axis(k))));
        let pushed = [0, 1, 2].map(|k| from_rest(Carried::Accelerated(square * axis(k), zero)));
        let cubic = (0..size).map(|k| {
            if k < first {
                DMatrix::zeros(size, size)
            } else {
                forces.geometric(&shapes[k], (&steps, first), length)
            }
        });
        let cubic: Vec<DMatrix<f64>> = cubic.collect();
        let points = CarriedPoints { system: self.free, at: &at, origin, mass }.turning(shapes, first);
        let sections = TurningMatrices {
            slope: slope - &points.slope,
            inertia: std::array::from_fn(|k| symmetric(&turning[k].direct) - &points.inertia[k]),
            momentum: [0, 1, 2].map(|k| spun[k].direct.transpose() - &points.momentum[k]),
        };
        let moment = [0, 1, 2].map(|k| symmetric(&pushed[k].direct));
        let direct = GeometricMatrices { moment, points, sections, shortening: Vec::new() };
        let states = |of: &[OfMotion]| of.iter().map(|own| own.state.clone()).collect::<Vec<_>>();
        Ok(Some(SecondOrder {
            direct,
            cubic,
            turning: states(&turning),
            spun: states(&spun),
            pushed: states(&pushed),
        }))
    }
}
