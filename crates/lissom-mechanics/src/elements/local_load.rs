//! Force and moment at a point of a node that functions of the motion of this point determine: aerodynamic and hydrodynamic forces on
//! sections, supports by soil, drag.
//!
//! Legend: global frame, that of the model or of a part; (R, p) frame of the node in it, r point and Q axes of the section in that of
//! the node, (v, ω) twist of the node in its axes, w(x, t) velocity of the fluid in global axes, S axes of the load in those of the
//! node: Q for the section, Rᵀ for global axes; f force and m
//! moment in the axes of the load, y states of the load; H, h rotation and origin of a frame of another node, a direction in it.
//!
//! ```text
//! x = p + R r,      c = Sᵀ (v + ω × r),      o = Sᵀ ω,      u = Sᵀ Rᵀ w - c
//! d = Rᵀ (x - h),      r = Sᵀ d,      n = Sᵀ Rᵀ H a
//! f, m = functions of x, c, o, u, r, n, y, t,      y' = function of the same
//! wrench on the node:  (S f, S m + r × S f)
//! δx = R (δu + δθ × r),      δ(Sᵀ Rᵀ w) = Sᵀ Rᵀ δw + Qᵀ (Rᵀ w × δθ),      δ(Rᵀ f) = Rᵀ δf + Rᵀ f × δθ
//! ```
//!
//! The other node, for example the hub of a rotor, receives no force: the load is external.
//!
//! Functions are evaluated one after the other, and each may use those before it. Derivatives are accumulated forwards.

use std::sync::Arc;

use lissom_motion::{Matrix3, Motion, Rotation, Vector3, rotation_part, skew, translation_part};
use nalgebra::SVector;

use super::{Capabilities, Element, ForceLaws, Load, Tangents, Unknowns};
use crate::evaluation::switch_states::SwitchStates;
use crate::kinematics::{CarriedFrame, CoordinateId, DiscreteValueId, Kinematics, NodeId, Subject, Switch};
use crate::law::VisitLaw;
use crate::registry::Function;
use crate::signals::{MAX_ARGUMENTS, SignalError, SignalFunction, with_arguments};

/// Most states of a load.
pub const MAX_STATES: usize = 6;
/// Most functions of a load.
pub const MAX_FUNCTIONS: usize = 80;

/// Derivatives by displacement and rotation of the node, by its twist, by the states, and by displacement and rotation of another node
/// if there is one.
type Row<const N: usize> = SVector<f64, N>;

/// An argument of a function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LocalArgument {
    /// Component of x [m], global axes.
    Position(usize),
    /// Component of the change of x since the start [m], global axes.
    Displacement(usize),
    /// Component of c [m/s].
    Velocity(usize),
    /// Component of o [rad/s].
    AngularVelocity(usize),
    /// Component of u [m/s].
    RelativeFlow(usize),
    /// Component of r, the position relative to the origin of another frame, in the load's axes [m].
    RelativePosition(usize),
    /// Component of n, a direction fixed in another node, in the load's axes.
    Direction(usize),
    /// A state of the load.
    State(usize),
    /// An input, or a sampled signal.
    Held(DiscreteValueId),
    /// A function before this one.
    Function(usize),
    /// A constant.
    Constant(f64),
}

/// A function with its arguments.
#[derive(Clone, Debug)]
pub struct LocalFunction {
    /// Subject of messages.
    pub subject: Arc<Subject>,
    /// The function.
    pub function: Arc<dyn SignalFunction>,
    /// Arguments of the function.
    pub arguments: Vec<LocalArgument>,
}

/// Functions of a load, the same at all its points.
#[derive(Clone, Debug, Default)]
pub struct LocalFunctions {
    /// All of them, each after those that it uses.
    pub all: Vec<LocalFunction>,
    /// The components of w, which use neither velocities nor the flow; zero if there is none.
    pub flow: [Option<usize>; 3],
    /// The components of force and moment; zero if there is none.
    pub wrench: [Option<usize>; 6],
    /// The rates of the states.
    pub rates: Vec<usize>,
}

/// Force and moment at a point of a node.
#[derive(Clone, Debug)]
pub struct LocalLoad {
    /// The node, and the other one if it is not the same.
    nodes: Vec<NodeId>,
    /// Origin and direction in the axes of the last node, if positions are relative to it.
    other: Option<[Vector3; 2]>,
    point: Vector3,
    /// Q; none if the axes are global.
    axes: Option<Rotation>,
    /// The global frame in the inertial one.
    global: Motion,
    start: Vector3,
    functions: LocalFunctions,
    states: Vec<CoordinateId>,
    /// Factor of force and moment.
    weight: f64,
    /// Factor over time.
    scale: Function,
    group: usize,
    switch_states: SwitchStates,
}

/// The motion of the point.
struct Local {
    position: Vector3,
    velocity: Vector3,
    angular_velocity: Vector3,
    /// R, S.
    rotation: Matrix3,
    axes: Matrix3,
    /// r, n; H in the axes of the load.
    relative_position: Vector3,
    direction: Vector3,
    other_axes: Matrix3,
}

/// Values of all functions.
struct Values {
    local: Local,
    functions: [f64; MAX_FUNCTIONS],
}

/// Rows of a vector whose derivatives by displacement and rotation of the node, or by its twist, are these matrices; their columns
/// are from `first` on.
fn rows_of<const N: usize>(by: [Matrix3; 2], first: usize) -> [Row<N>; 3] {
    std::array::from_fn(|k| {
        let mut row = Row::zeros();
        for (j, matrix) in by.iter().enumerate() {
            for i in 0..3 {
                row[first + 3 * j + i] = matrix[(k, i)];
            }
        }
        row
    })
}

impl LocalLoad {
    /// At a frame of a node, which is at `start` [m] at the start: with its axes, or those of the `global` frame. Points of one load
    /// have the number of a `group` in common.
    pub fn new(
        group: usize,
        (frame, start): (CarriedFrame, Vector3),
        (global, is_global): (Motion, bool),
        functions: LocalFunctions,
        states: Vec<CoordinateId>,
        (weight, scale): (f64, Function),
    ) -> Self {
        Self {
            nodes: vec![frame.node],
            other: None,
            point: frame.offset.position,
            axes: (!is_global).then_some(frame.offset.rotation),
            global,
            start: global.inverse_transform_point(&start),
            functions,
            states,
            weight,
            scale,
            group,
            switch_states: SwitchStates::default(),
        }
    }

    /// With positions relative to the origin of `other`, and a direction in the axes of its node.
    #[must_use]
    pub fn about(mut self, other: CarriedFrame, direction: Vector3) -> Self {
        if other.node != self.nodes[0] {
            self.nodes.push(other.node);
        }
        self.other = Some([other.offset.position, direction]);
        self
    }

    /// Force and moment about the point, inertial axes [N, N m].
    pub fn resultant(&self, at: &Kinematics) -> [Vector3; 2] {
        let values = self.values(at);
        let to_inertial = self.global.rotation.matrix()
            * values.local.rotation
            * values.local.axes
            * (self.weight * self.scale.value(at.time));
        self.wrench(&values).map(|vector| to_inertial * vector)
    }

    /// Passes force and moment in the axes of the load, per length along a beam [N/m, N] or on a node [N, N m], and the values of all
    /// functions to `read`.
    pub fn read_functions(&self, at: &Kinematics, read: impl FnOnce([Vector3; 2], &[f64])) {
        let values = self.values(at);
        let scale = self.scale.value(at.time);
        read(self.wrench(&values).map(|vector| scale * vector), &values.functions);
    }

    /// The point [m], inertial axes.
    pub fn position(&self, at: &Kinematics) -> Vector3 {
        self.global.transform_point(&self.local(at).position)
    }

    /// Velocity of the point and angular velocity, inertial axes [m/s, rad/s].
    pub fn velocities(&self, at: &Kinematics) -> [Vector3; 2] {
        let Local { velocity, angular_velocity, rotation, axes, .. } = self.local(at);
        let to_inertial = self.global.rotation.matrix() * rotation * axes;
        [velocity, angular_velocity].map(|vector| to_inertial * vector)
    }

    fn local(&self, at: &Kinematics) -> Local {
        let motion = &at.nodes[self.nodes[0]];
        let frame = motion.frame.relative_to(&self.global);
        let rotation = frame.rotation.matrix();
        let axes = self.axes.map_or_else(|| rotation.transpose(), |own| own.matrix());
        let turning = rotation_part(&motion.twist);
        let position = frame.position + rotation * self.point;
        let (relative_position, direction, other_axes) =
            self.other.map_or_else(Default::default, |[origin, direction]| {
                let other = at.nodes[self.nodes[self.nodes.len() - 1]].frame.relative_to(&self.global);
                let axes_of_other = axes.tr_mul(&rotation.tr_mul(&other.rotation.matrix()));
                let relative = axes.tr_mul(&rotation.tr_mul(&(position - other.transform_point(&origin))));
                (relative, axes_of_other * direction, axes_of_other)
            });
        Local {
            position,
            velocity: axes.tr_mul(&(translation_part(&motion.twist) + turning.cross(&self.point))),
            angular_velocity: axes.tr_mul(&turning),
            rotation,
            axes,
            relative_position,
            direction,
            other_axes,
        }
    }

    /// w.
    fn fluid(&self, functions: &[f64; MAX_FUNCTIONS]) -> Vector3 {
        Vector3::from_fn(|k, _| self.functions.flow[k].map_or(0.0, |index| functions[index]))
    }

    fn argument(&self, argument: LocalArgument, values: &Values, at: &Kinematics) -> f64 {
        let local = &values.local;
        match argument {
            LocalArgument::Position(k) => local.position[k],
            LocalArgument::Displacement(k) => local.position[k] - self.start[k],
            LocalArgument::Velocity(k) => local.velocity[k],
            LocalArgument::AngularVelocity(k) => local.angular_velocity[k],
            LocalArgument::RelativeFlow(k) => {
                let fluid = local.rotation.tr_mul(&self.fluid(&values.functions));
                local.axes.column(k).dot(&fluid) - local.velocity[k]
            }
            LocalArgument::RelativePosition(k) => local.relative_position[k],
            LocalArgument::Direction(k) => local.direction[k],
            LocalArgument::State(k) => at.coordinates[self.states[k]].value,
            LocalArgument::Held(held) => at.held[held.index()],
            LocalArgument::Function(index) => values.functions[index],
            LocalArgument::Constant(value) => value,
        }
    }

    /// Passes every function with its arguments and the sides of its switches to `visit`, whose results are the values.
    fn evaluate(&self, at: &Kinematics, mut visit: impl FnMut(usize, &[f64], &[f64]) -> f64) -> Values {
        let mut values = Values { local: self.local(at), functions: [0.0; MAX_FUNCTIONS] };
        let mut sides = self.switch_states.of(at);
        for (index, LocalFunction { function, arguments, .. }) in self.functions.all.iter().enumerate() {
            let count = if sides.is_empty() { 0 } else { function.switch_count().min(sides.len()) };
            let (own, others) = sides.split_at(count);
            values.functions[index] = with_arguments(arguments.len(), |numbers| {
                for (number, &argument) in numbers.iter_mut().zip(arguments) {
                    *number = self.argument(argument, &values, at);
                }
                visit(index, numbers, own)
            });
            sides = others;
        }
        values
    }

    fn values(&self, at: &Kinematics) -> Values {
        self.evaluate(at, |index, arguments, sides| {
            self.functions.all[index].function.value(at.time, arguments, sides)
        })
    }

    /// f and m.
    fn wrench(&self, values: &Values) -> [Vector3; 2] {
        let of = |first: usize| {
            Vector3::from_fn(|k, _| {
                self.functions.wrench[first + k].map_or(0.0, |index| values.functions[index])
            })
        };
        [of(0), of(3)]
    }

    /// Rows of position, velocity and angular velocity.
    fn motion_rows<const N: usize>(&self, local: &Local) -> [[Row<N>; 3]; 3] {
        let arm = skew(&self.point);
        let (rotation, axes) = (&local.rotation, local.axes.transpose());
        let position = rows_of([*rotation, -rotation * arm], 0);
        let mut velocity = rows_of([axes, -axes * arm], 6);
        let mut turning = rows_of([Matrix3::zeros(), axes], 6);
        if self.axes.is_none() {
            // δ(R a) = -R a~ δθ at constant a.
            for (rows, vector) in [(&mut velocity, local.velocity), (&mut turning, local.angular_velocity)] {
                let turned = -skew(&vector) * rotation;
                let added = rows_of([Matrix3::zeros(), turned], 0);
                rows.iter_mut().zip(&added).for_each(|(row, own)| *row += own);
            }
        }
        [position, velocity, turning]
    }

    /// Rows of relative position and direction.
    fn relative_rows<const N: usize>(&self, local: &Local) -> [[Row<N>; 3]; 2] {
        let Some(others) = self.other else { return [[Row::zeros(); 3]; 2] };
        let first = if self.nodes.len() == 1 { 0 } else { 12 + MAX_STATES };
        let (axes, other) = (local.axes.transpose(), &local.other_axes);
        let [origin, direction] = others.map(|vector| skew(&vector));
        // δ(Sᵀ b) = Sᵀ b × δθ for the axes of the section, at a constant b in global axes.
        let turned = |vector: &Vector3| match self.axes {
            Some(_) => axes * skew(&(local.axes * vector)),
            None => Matrix3::zeros(),
        };
        let arm = axes * skew(&self.point);
        let own =
            [[axes, turned(&local.relative_position) - arm], [Matrix3::zeros(), turned(&local.direction)]];
        let by_other = [[-other, other * origin], [Matrix3::zeros(), -other * direction]];
        std::array::from_fn(|k| {
            let mut rows = rows_of(own[k], 0);
            rows.iter_mut().zip(&rows_of(by_other[k], first)).for_each(|(row, added)| *row += added);
            rows
        })
    }

    /// Rows of Sᵀ Rᵀ w - c.
    fn flow_rows<const N: usize>(
        &self,
        local: &Local,
        fluid: (&Vector3, &[Row<N>; 3]),
        velocity: &[Row<N>; 3],
    ) -> [Row<N>; 3] {
        let (w, by) = fluid;
        let to_load = local.axes.transpose() * local.rotation.transpose();
        let mut rows: [Row<N>; 3] =
            std::array::from_fn(|k| (0..3).fold(-velocity[k], |row, j| row + to_load[(k, j)] * by[j]));
        if self.axes.is_some() {
            let turned = local.axes.transpose() * skew(&local.rotation.tr_mul(w));
            let added = rows_of([Matrix3::zeros(), turned], 0);
            rows.iter_mut().zip(&added).for_each(|(row, own)| *row += own);
        }
        rows
    }

    /// Values and rows of all functions, of which there are at most `F`.
    fn rows<const N: usize, const F: usize>(&self, at: &Kinematics) -> (Values, [Row<N>; F]) {
        let local = self.local(at);
        let [position, velocity, turning] = self.motion_rows(&local);
        let [relative, direction] = self.relative_rows(&local);
        let mut rows = [Row::zeros(); F];
        let mut known = [0.0; MAX_FUNCTIONS];
        let values = self.evaluate(at, |index, arguments, sides| {
            let LocalFunction { function, arguments: sources, .. } = &self.functions.all[index];
            let mut gradient = [0.0; MAX_ARGUMENTS];
            let gradient = &mut gradient[..arguments.len()];
            function.gradient(at.time, arguments, sides, gradient);
            let mut row = Row::zeros();
            for (&derivative, source) in
                gradient.iter().zip(sources).filter(|(derivative, _)| **derivative != 0.0)
            {
                match *source {
                    LocalArgument::Position(k) | LocalArgument::Displacement(k) => {
                        row += derivative * position[k];
                    }
                    LocalArgument::Velocity(k) => row += derivative * velocity[k],
                    LocalArgument::AngularVelocity(k) => row += derivative * turning[k],
                    LocalArgument::RelativeFlow(k) => {
                        let by = self.functions.flow.map(|own| own.map_or_else(Row::zeros, |own| rows[own]));
                        let flow = self.flow_rows(&local, (&self.fluid(&known), &by), &velocity);
                        row += derivative * flow[k];
                    }
                    LocalArgument::RelativePosition(k) => row += derivative * relative[k],
                    LocalArgument::Direction(k) => row += derivative * direction[k],
                    LocalArgument::State(k) => row[12 + k] += derivative,
                    LocalArgument::Function(earlier) => row += derivative * rows[earlier],
                    LocalArgument::Held(_) | LocalArgument::Constant(_) => {}
                }
            }
            rows[index] = row;
            known[index] = function.value(at.time, arguments, sides);
            known[index]
        });
        (values, rows)
    }

    /// Force and moment on the node in its axes.
    fn on_node(&self, [force, moment]: &[Vector3; 2], axes: &Matrix3) -> [Vector3; 2] {
        let force = axes * force;
        [force, axes * moment + self.point.cross(&force)]
    }

    /// Adds force and moment on the node to the left-hand side of its equations.
    fn add_wrench(&self, values: &Values, factor: f64, out: &mut [f64]) {
        let [force, moment] = self.on_node(&self.wrench(values), &values.local.axes);
        for k in 0..3 {
            out[k] -= factor * force[k];
            out[3 + k] -= factor * moment[k];
        }
    }

    /// Index of the first state among the unknowns.
    fn first_state(&self) -> usize {
        6 * self.nodes.len()
    }

    fn linearize_by<const N: usize, const F: usize>(&self, at: &Kinematics, out: &mut Tangents) {
        let (values, rows) = self.rows::<N, F>(at);
        let factor = self.factor(at);
        let (size, axes, first) = (out.size(), &values.local.axes, self.first_state());
        let of = |index: Option<usize>, column: usize| index.map_or(0.0, |index| rows[index][column]);
        let mut add = |row: usize, column: usize, value: f64| match column {
            0..6 => out.stiffness[row * size + column] += value,
            6..12 => out.damping[row * size + column - 6] += value,
            column if column < 12 + MAX_STATES => out.stiffness[row * size + first + column - 12] += value,
            _ => out.stiffness[row * size + 6 + column - 12 - MAX_STATES] += value,
        };
        let by_other = if self.nodes.len() == 1 { 0..0 } else { 12 + MAX_STATES..18 + MAX_STATES };
        for column in (0..12 + self.states.len()).chain(by_other) {
            let by =
                [0, 3].map(|first| Vector3::from_fn(|k, _| of(self.functions.wrench[first + k], column)));
            let [force, moment] = self.on_node(&by, axes);
            for k in 0..3 {
                add(k, column, -factor * force[k]);
                add(3 + k, column, -factor * moment[k]);
            }
            for (k, &rate) in self.functions.rates.iter().enumerate() {
                add(first + k, column, -rows[rate][column]);
            }
        }
        if self.axes.is_none() {
            // δ(Rᵀ f) = (Rᵀ f)~ δθ
            let [force, moment] = self.wrench(&values).map(|vector| skew(&(axes * vector)));
            let moment = moment + skew(&self.point) * force;
            for (k, i) in (0..3).flat_map(|k| (0..3).map(move |i| (k, i))) {
                add(k, 3 + i, -factor * force[(k, i)]);
                add(3 + k, 3 + i, -factor * moment[(k, i)]);
            }
        }
        for k in 0..self.states.len() {
            out.damping[(first + k) * size + first + k] += 1.0;
        }
    }

    fn factor(&self, at: &Kinematics) -> f64 {
        self.weight * self.scale.value(at.time)
    }
}

impl Element for LocalLoad {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.nodes, coordinates: &self.states, multipliers: &[] }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let values = self.values(at);
        let factor = self.factor(at);
        self.add_wrench(&values, factor, out);
        for (k, (&state, &rate)) in self.states.iter().zip(&self.functions.rates).enumerate() {
            out[self.first_state() + k] += at.coordinates[state].rate - values.functions[rate];
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        // Most loads have few functions and one node, and the time is that of their rows.
        if self.nodes.len() == 1 && self.functions.all.len() <= 24 {
            self.linearize_by::<{ 12 + MAX_STATES }, 24>(at, out);
        } else {
            self.linearize_by::<{ 18 + MAX_STATES }, MAX_FUNCTIONS>(at, out);
        }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), laws: Some(self), ..Capabilities::default() }
    }
}

impl Load for LocalLoad {
    fn breakpoints(&self) -> Vec<f64> {
        let of = |own: &LocalFunction| own.function.breakpoints().to_vec();
        self.functions.all.iter().flat_map(of).chain(self.scale.breakpoints()).collect()
    }

    fn depends_on_motion(&self) -> bool {
        let is_motion = |argument: &LocalArgument| {
            !matches!(
                argument,
                LocalArgument::Held(_) | LocalArgument::Constant(_) | LocalArgument::Function(_)
            )
        };
        self.functions.all.iter().flat_map(|own| &own.arguments).any(is_motion)
    }

    fn check(&self, at: &Kinematics) -> Result<(), SignalError> {
        let values = self.values(at);
        for (own, value) in self.functions.all.iter().zip(values.functions) {
            if !value.is_finite() {
                return Err(SignalError { signal: (*own.subject).clone(), value, time: at.time });
            }
        }
        Ok(())
    }

    fn states_at_rest(&self) -> &[CoordinateId] {
        &self.states
    }

    fn add_by_held(&self, held: DiscreteValueId, at: &Kinematics, out: &mut [f64]) {
        let mut by = [0.0; MAX_FUNCTIONS];
        let local = self.local(at);
        let values = self.evaluate(at, |index, arguments, sides| {
            let LocalFunction { function, arguments: sources, .. } = &self.functions.all[index];
            let mut gradient = [0.0; MAX_ARGUMENTS];
            function.gradient(at.time, arguments, sides, &mut gradient[..arguments.len()]);
            by[index] = gradient
                .iter()
                .zip(sources)
                .map(|(derivative, source)| match *source {
                    LocalArgument::Held(own) if own == held => *derivative,
                    LocalArgument::Function(earlier) => derivative * by[earlier],
                    LocalArgument::RelativeFlow(k) => {
                        let fluid = local.rotation.tr_mul(&self.fluid(&by));
                        derivative * local.axes.column(k).dot(&fluid)
                    }
                    _ => 0.0,
                })
                .sum();
            function.value(at.time, arguments, sides)
        });
        let by = Values { local: values.local, functions: by };
        let factor = self.factor(at);
        self.add_wrench(&by, factor, out);
        for (k, &rate) in self.functions.rates.iter().enumerate() {
            out[self.first_state() + k] -= by.functions[rate];
        }
    }
}

impl ForceLaws for LocalLoad {
    fn switch_count(&self) -> usize {
        self.functions.all.iter().map(|own| own.function.switch_count()).sum()
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        self.evaluate(at, |index, arguments, sides| {
            let function = &self.functions.all[index].function;
            function.switches(at.time, arguments, sides, out);
            function.value(at.time, arguments, sides)
        });
    }

    fn switch_subjects(&self) -> Option<Vec<Subject>> {
        let of = |own: &LocalFunction| vec![Subject::clone(&own.subject); own.function.switch_count()];
        Some(self.functions.all.iter().flat_map(of).collect())
    }

    fn group(&self) -> Option<usize> {
        Some(self.group)
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        self.evaluate(at, |index, arguments, sides| {
            let function = &self.functions.all[index].function;
            if !function.is_polynomial() {
                visit(&&**function, arguments);
            }
            function.value(at.time, arguments, sides)
        });
    }
}
