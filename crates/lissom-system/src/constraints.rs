//! One interface to all constraints of a system, and the contributions of those that are not evaluated in lanes.

use lissom_motion::lie_bracket_matrix;
use lissom_solver::{Group, Pattern};

use super::{StepPoint, System};
use lissom_contact::rigid::RigidConstraint;
use lissom_mechanics::evaluation::scatter_map::position_of;
use lissom_mechanics::evaluation::scratch::with_scratch;
use lissom_mechanics::evaluation::tangent_assembler::TangentAssembler;
use lissom_mechanics::joints::attached::AttachedJoint;
use lissom_mechanics::joints::constraint::{
    Constraint, Level, Port, Visit, ports_of, rates, violation_rates,
};
use lissom_mechanics::joints::coupling::Coupling;
use lissom_mechanics::joints::evaluation_point::{Augmentation, Chart, Point};
use lissom_mechanics::joints::latch::Latch;
use lissom_mechanics::joints::mean_motion::MeanMotion;
use lissom_mechanics::joints::no_slip::NoSlip;
use lissom_mechanics::joints::slider::Slider;
use lissom_mechanics::joints::starts::JointStarts;
use lissom_mechanics::joints::{Drive, MAX_EQUATIONS};
use lissom_mechanics::kinematics::{Kinematics, LOCKED, Layout, NodeId};

/// The constraints by family, because outputs depend on the type.
#[derive(Debug, Default)]
pub struct Constraints {
    pub joints: Vec<AttachedJoint>,
    pub drives: Vec<Drive>,
    pub couplings: Vec<Coupling>,
    pub sliders: Vec<Slider>,
    pub mean_motions: Vec<MeanMotion>,
    pub wheels: Vec<NoSlip>,
    pub latches: Vec<Latch>,
    pub rigid_contacts: Vec<RigidConstraint>,
    pub stickings: Vec<RigidConstraint>,
    /// Events of rigid contacts, each with the index of its contact.
    pub contact_events: Vec<(usize, usize)>,
}

/// Constraints of one type.
trait Family {
    fn count(&self) -> usize;
    fn member(&self, index: usize) -> &dyn Constraint;
}

impl<C: Constraint> Family for Vec<C> {
    fn count(&self) -> usize {
        self.len()
    }

    fn member(&self, index: usize) -> &dyn Constraint {
        &self[index]
    }
}

impl Constraints {
    /// All families, enumerated only here.
    fn families(&self) -> [&dyn Family; 9] {
        [
            &self.joints,
            &self.drives,
            &self.couplings,
            &self.sliders,
            &self.mean_motions,
            &self.wheels,
            &self.latches,
            &self.rigid_contacts,
            &self.stickings,
        ]
    }

    /// Number of constraints of each family, for comparing models.
    pub fn counts(&self) -> [usize; 9] {
        self.families().map(Family::count)
    }

    /// A constraint by its index among all: joints are first.
    pub fn get(&self, index: usize) -> &dyn Constraint {
        let mut own = index;
        for family in self.families() {
            if own < family.count() {
                return family.member(own);
            }
            own -= family.count();
        }
        unreachable!("there is no constraint {index}")
    }

    /// All constraints.
    pub fn iter(&self) -> impl Iterator<Item = &dyn Constraint> {
        let all = self.families().into_iter();
        all.flat_map(|family| (0..family.count()).map(move |index| family.member(index)))
    }

    /// All constraints that are not evaluated in lanes.
    pub(crate) fn others(&self) -> impl Iterator<Item = &dyn Constraint> {
        let all = self.families().into_iter().skip(1);
        all.flat_map(|family| (0..family.count()).map(move |index| family.member(index)))
    }
}

/// Rows of a port's unknowns, [`LOCKED`] for those that do not exist.
pub fn rows_of_port(port: Port, layout: &Layout) -> impl Iterator<Item = u32> {
    let rows = match port {
        Port::Node(node) => *layout.rows_of_node(node),
        Port::NoNode => [LOCKED; 6],
        Port::Coordinate(coordinate) => [layout.row_of_coordinate(coordinate) as u32; 6],
    };
    rows.into_iter().take(port.width())
}

/// The group of a constraint's multipliers, after those of all on which it acts.
pub(crate) fn group_of(
    constraint: &dyn Constraint,
    layout: &Layout,
    (of_node, first_coordinate): (&[Option<usize>], usize),
) -> Group {
    let first = layout.coordinate_count + constraint.first_multiplier();
    let host = |port| match port {
        Port::Node(node) => of_node[node.index()],
        Port::NoNode => None,
        Port::Coordinate(coordinate) => Some(first_coordinate + coordinate.index()),
    };
    let mut hosts: Vec<usize> = ports_of(constraint).into_iter().filter_map(host).collect();
    hosts.sort_unstable();
    hosts.dedup();
    Group { unknowns: (first..first + constraint.equations()).collect(), hosts }
}

/// Location of a constraint in the system: by arrangement.
#[derive(Debug)]
pub struct Placed {
    arrangements: Vec<Arrangement>,
}

#[derive(Debug, Default)]
struct Arrangement {
    /// Row of each local unknown, [`LOCKED`] if it does not exist.
    rows: Vec<u32>,
    /// First local unknown of each node.
    nodes: Vec<(usize, NodeId)>,
    /// Local row, local column and position in the tangent's pattern of every existing entry. Equations follow the
    /// local unknowns; the block of two equations is zero, except for the diagonal of constraints that may be released.
    entries: Vec<(u32, u32, u32)>,
}

impl Placed {
    /// Numbers the local unknowns of a constraint.
    pub(crate) fn new(constraint: &dyn Constraint, layout: &Layout) -> Self {
        let of = |arrangement: usize| {
            let mut own = Arrangement::default();
            for port in (0..constraint.ports()).map(|index| constraint.port(arrangement, index)) {
                if let Port::Node(node) = port {
                    own.nodes.push((own.rows.len(), node));
                }
                own.rows.extend(rows_of_port(port, layout));
            }
            own
        };
        Self { arrangements: (0..constraint.arrangements()).map(of).collect() }
    }

    /// Local unknown or equation, and row, of all that exist, by arrangement.
    fn unknowns(&self, constraint: &dyn Constraint, layout: &Layout) -> Vec<Vec<(usize, usize)>> {
        let first = layout.coordinate_count + constraint.first_multiplier();
        let of = |own: &Arrangement| {
            let free = own.rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED);
            let equations = (0..constraint.equations()).map(|e| (own.rows.len() + e, first + e));
            free.map(|(local, &row)| (local, row as usize)).chain(equations).collect()
        };
        self.arrangements.iter().map(of).collect()
    }

    /// Tangent entries of the constraint, by arrangement.
    pub(crate) fn cliques(&self, constraint: &dyn Constraint, layout: &Layout) -> Vec<Vec<usize>> {
        let rows = |unknowns: Vec<(usize, usize)>| {
            let mut rows: Vec<usize> = unknowns.into_iter().map(|(_, row)| row).collect();
            rows.sort_unstable();
            rows.dedup();
            rows
        };
        self.unknowns(constraint, layout).into_iter().map(rows).collect()
    }

    /// Determines the positions of the local matrix in the tangent's pattern.
    pub(crate) fn locate(&mut self, constraint: &dyn Constraint, layout: &Layout, pattern: &Pattern) {
        let unknowns = self.unknowns(constraint, layout);
        for (own, unknowns) in self.arrangements.iter_mut().zip(unknowns) {
            let size = own.rows.len();
            let pairs = unknowns.iter().flat_map(|column| unknowns.iter().map(move |row| (*row, *column)));
            let may_be_released = constraint.level() == Level::Velocity;
            let filled =
                pairs.filter(|((i, _), (j, _))| *i < size || *j < size || (may_be_released && i == j));
            let entry = |((i, row), (j, column)): ((usize, usize), (usize, usize))| {
                (i as u32, j as u32, position_of(pattern, row, column) as u32)
            };
            own.entries = filled.map(entry).collect();
        }
    }
}

impl Arrangement {
    /// Adds Bᵀ μ to the free rows.
    fn add_forces(&self, gradient: &[f64], mu: &[f64], out: &mut [f64]) {
        for (row, mu) in gradient.chunks_exact(self.rows.len()).zip(mu) {
            for (by, &row) in row.iter().zip(&self.rows).filter(|&(_, &row)| row != LOCKED) {
                out[row as usize] += by * mu;
            }
        }
    }
}

/// Violations of a constraint of velocities at the motion `at`; while it is released, minus its multipliers as lengths. `gradient`
/// is zero and receives B.
fn slips(
    constraint: &dyn Constraint,
    at: &Kinematics,
    (scale, multipliers): (&Augmentation, &[f64]),
    gradient: &mut [f64],
    out: &mut [f64],
) {
    if constraint.is_released(at) {
        out.iter_mut().zip(multipliers).for_each(|(value, mu)| *value = -scale.compliance * mu);
        return;
    }
    rates(constraint, at, gradient, out);
    let mut explicit = [0.0; MAX_EQUATIONS];
    constraint.time_derivative(at, &mut explicit[..out.len()]);
    for (value, explicit) in out.iter_mut().zip(explicit) {
        *value = (*value + explicit) * scale.lapse;
    }
}

/// μ = λ + w c by equation; constraints of velocities are not augmented: they do not define coordinates without mass.
fn multiplier(
    constraint: &dyn Constraint,
    augmentation: &Augmentation,
    (equation, multiplier, violation): (usize, f64, f64),
) -> f64 {
    match constraint.level() {
        Level::Position => {
            multiplier
                + augmentation.weight * augmentation.relative(constraint.quantity(equation)) * violation
        }
        Level::Velocity => multiplier,
    }
}

/// Violations at `point`: those at the start of the step and their change.
fn violations(constraint: &dyn Constraint, point: &Point<'_>, out: &mut [f64]) {
    constraint.violation_change(&point.increments, (point.at.time, point.at.elapsed), out);
    for (violation, before) in out.iter_mut().zip(&point.violations[constraint.first_multiplier()..]) {
        *violation += before;
    }
}

impl System {
    /// All constraints: joints first.
    pub fn constraints(&self) -> impl Iterator<Item = &dyn Constraint> {
        self.constraints.iter()
    }

    /// A constraint by its index among all.
    pub fn constraint(&self, index: usize) -> &dyn Constraint {
        self.constraints.get(index)
    }

    /// Constraints that are not evaluated in lanes, each with its location.
    fn others(&self) -> impl Iterator<Item = (&dyn Constraint, &Placed)> {
        self.constraints.others().zip(&self.placed)
    }

    /// Adds their forces and violations to a residual.
    pub(crate) fn add_others(&self, point: &Point<'_>, out: &mut [f64]) {
        // Most models have none, and this is checked in every iteration.
        if self.placed.is_empty() {
            return;
        }
        for (constraint, placed) in self.others() {
            let arrangement = &placed.arrangements[constraint.arrangement(point.at)];
            let (count, first) = (constraint.equations(), constraint.first_multiplier());
            with_scratch(count * (1 + arrangement.rows.len()), |scratch| {
                let (mu, gradient) = scratch.split_at_mut(count);
                match constraint.level() {
                    Level::Position => {
                        violations(constraint, point, mu);
                        constraint.gradient(point.at, gradient);
                    }
                    Level::Velocity => {
                        let given = (&point.augmentation, &point.multipliers[first..first + count]);
                        slips(constraint, point.at, given, gradient, mu);
                    }
                }
                let own = &mut out[self.layout.coordinate_count + first..][..count];
                own.copy_from_slice(mu);
                for (e, value) in mu.iter_mut().enumerate() {
                    *value = multiplier(
                        constraint,
                        &point.augmentation,
                        (e, point.multipliers[first + e], *value),
                    );
                }
                arrangement.add_forces(gradient, mu, out);
            });
        }
    }

    /// Their violations at `point`, by multiplier.
    pub(crate) fn violations_of_others(&self, point: &Point<'_>, out: &mut [f64]) {
        if self.placed.is_empty() {
            return;
        }
        for constraint in self.constraints.others() {
            let first = constraint.first_multiplier();
            violations(constraint, point, &mut out[first..first + constraint.equations()]);
        }
    }

    /// Passes their derivatives to `out`.
    pub(crate) fn linearize_others(
        &self,
        point: &Point<'_>,
        chart: Chart<'_>,
        out: &mut TangentAssembler<'_>,
    ) {
        if self.placed.is_empty() {
            return;
        }
        for (constraint, placed) in self.others() {
            let arrangement = &placed.arrangements[constraint.arrangement(point.at)];
            let (count, first) = (constraint.equations(), constraint.first_multiplier());
            let size = arrangement.rows.len();
            let is_of_velocities = constraint.level() == Level::Velocity;
            with_scratch(size * (size + 3 * count), |scratch| {
                let (stiffness, gradients) = scratch.split_at_mut(size * size);
                let (plain, gradients) = gradients.split_at_mut(count * size);
                let (charted, turning) = gradients.split_at_mut(count * size);
                constraint.gradient(point.at, plain);
                // The Hessian of the augmented term, w c ∂²c/∂q², is omitted, see `AttachedJoint::linearize_for`.
                constraint.constraint_hessian(point.at, &point.multipliers[first..first + count], stiffness);
                charted.copy_from_slice(plain);
                if is_of_velocities {
                    constraint.rate_derivatives(point.at, turning);
                }
                for &(column, node) in &arrangement.nodes {
                    match chart {
                        Chart::Increments(tangents) => {
                            let matrices = [&mut *stiffness, &mut *charted, &mut *turning];
                            for row in matrices.into_iter().flat_map(|own| own.chunks_exact_mut(size)) {
                                tangents[node].through(&mut row[column..column + 6]);
                            }
                        }
                        Chart::RelativeToDrift(start, _) if is_of_velocities => {
                            // δV = δψ̂' + ad_V δψ̂.
                            let drift = lie_bracket_matrix(&start[node].twist);
                            for (row, by) in turning.chunks_exact_mut(size).zip(plain.chunks_exact(size)) {
                                for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
                                    row[column + j] += by[column + i] * drift[(i, j)];
                                }
                            }
                        }
                        Chart::Body | Chart::RelativeToDrift(..) => {}
                    }
                }
                let diagonal = if constraint.is_released(point.at) { -1.0 } else { 0.0 };
                for &(i, j, position) in &arrangement.entries {
                    let (i, j) = (i as usize, j as usize);
                    let square = |e: usize| {
                        let weight = point.augmentation.relative(constraint.quantity(e));
                        weight * plain[e * size + i] * charted[e * size + j]
                    };
                    let parts = match (i.checked_sub(size), j.checked_sub(size)) {
                        (None, None) if is_of_velocities => {
                            out.add_slip_gram(position as usize, (0..count).map(square).sum());
                            [stiffness[i * size + j], 0.0, 0.0]
                        }
                        (None, None) => [stiffness[i * size + j], (0..count).map(square).sum(), 0.0],
                        (None, Some(e)) => [0.0, 0.0, plain[e * size + i]],
                        (Some(e), None) if is_of_velocities => {
                            let entry = e * size + j;
                            out.add_slip_entry(position as usize, [plain[entry], turning[entry]]);
                            continue;
                        }
                        (Some(e), None) => [0.0, 0.0, charted[e * size + j]],
                        (Some(_), Some(_)) => [0.0, 0.0, diagonal],
                    };
                    out.add_constraint_entry(position as usize, parts);
                }
            });
        }
    }

    /// Adds their forces and integrated violations to the residuals at the stages of `point`.
    pub(crate) fn add_stages_of_others(&self, point: &StepPoint<'_>, out: &mut [Vec<f64>]) {
        for (constraint, placed) in self.others() {
            let (count, first, size) =
                (constraint.equations(), constraint.first_multiplier(), constraint.size());
            with_scratch(count * (3 + 2 * size), |scratch| {
                let (changes, rest) = scratch.split_at_mut(count);
                let (violations, rows) = rest.split_at_mut(2 * count);
                let (end, before) =
                    (&point.increments[point.increments.len() - 1], &point.violations[first..]);
                let mut visit = Visit {
                    rows: rows.split_at_mut(count * size).into(),
                    violations: violations.split_at_mut(count).into(),
                    changes,
                };
                match constraint.level() {
                    Level::Position => constraint.visit(&point.step, end, before, &mut visit),
                    Level::Velocity => {
                        for (stage, at) in point.step.stages.iter().enumerate() {
                            let given =
                                (&point.augmentation, &point.multipliers[stage][first..first + count]);
                            slips(constraint, at, given, visit.rows[stage], visit.violations[stage]);
                        }
                    }
                }
                for (stage, at) in point.step.stages.iter().enumerate() {
                    let (rows, mu) = (&*visit.rows[stage], &mut *visit.violations[stage]);
                    let own = &mut out[stage][self.layout.coordinate_count + first..][..count];
                    own.copy_from_slice(mu);
                    for (e, value) in mu.iter_mut().enumerate() {
                        let given = point.multipliers[stage][first + e];
                        *value = multiplier(constraint, &point.augmentation, (e, given, *value));
                    }
                    placed.arrangements[constraint.arrangement(at)].add_forces(rows, mu, &mut out[stage]);
                }
            });
        }
    }

    /// Adds the forces of a constraint for its multipliers, and sets its violations, evaluated from absolute positions.
    pub(crate) fn add_absolute(&self, index: usize, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        let constraint = self.constraints.get(index);
        let (count, first, size) = (constraint.equations(), constraint.first_multiplier(), constraint.size());
        with_scratch(count * size, |gradient| {
            constraint.gradient(at, gradient);
            let arrangement = constraint.arrangement(at);
            let ports = (0..constraint.ports()).map(|index| constraint.port(arrangement, index));
            for (local, row) in ports.flat_map(|port| rows_of_port(port, &self.layout)).enumerate() {
                if row != LOCKED {
                    let of = |e: usize| gradient[e * size + local] * multipliers[first + e];
                    out[row as usize] += (0..count).map(of).sum::<f64>();
                }
            }
        });
        constraint.violation(at, &mut out[self.layout.coordinate_count + first..][..count]);
    }

    /// Violations of all constraints, evaluated from absolute positions: by multiplier.
    pub fn violations(&self, at: &Kinematics, out: &mut [f64]) {
        self.each_equation(out, |constraint, own| constraint.violation(at, own));
    }

    /// ∂c/∂t by multiplier.
    pub fn constraint_velocities(&self, at: &Kinematics, out: &mut [f64]) {
        out.fill(0.0);
        self.each_equation(out, |constraint, own| constraint.time_derivative(at, own));
    }

    /// ċ and c̈ by multiplier, for the motion `at` at which the values `starts` of the joints are taken.
    pub fn violation_rates(
        &self,
        at: &Kinematics,
        starts: &JointStarts,
        [rates, accelerations]: [&mut [f64]; 2],
    ) {
        for (batch, starts) in self.joint_lanes.batches.with_starts(Some(starts)) {
            batch.violation_rates(at, starts.unwrap_or_default(), &mut |block, found| {
                for (lane, item) in batch.block_items(block).enumerate() {
                    let joint = &self.constraints.joints[batch.indices()[item] as usize];
                    let own = joint.first_multiplier..joint.first_multiplier + joint.equations();
                    let own = rates[own.clone()].iter_mut().zip(&mut accelerations[own]);
                    for (k, (rate, acceleration)) in own.enumerate() {
                        (*rate, *acceleration) = (found[0][k][lane], found[1][k][lane]);
                    }
                }
            });
        }
        for constraint in self.constraints.others() {
            let own = constraint.first_multiplier()..constraint.first_multiplier() + constraint.equations();
            with_scratch(constraint.equations() * constraint.size(), |gradient| {
                let out = [&mut rates[own.clone()], &mut accelerations[own]];
                violation_rates(constraint, at, gradient, out);
            });
        }
    }

    fn each_equation(&self, out: &mut [f64], of: impl Fn(&dyn Constraint, &mut [f64])) {
        for family in self.constraints.families() {
            for constraint in (0..family.count()).map(|index| family.member(index)) {
                let first = constraint.first_multiplier();
                of(constraint, &mut out[first..first + constraint.equations()]);
            }
        }
    }

    /// Whether a constraint depends explicitly on time at a configuration.
    pub fn has_driven_constraint(&self, at: &Kinematics) -> bool {
        !self.placed.is_empty() && self.constraints.others().any(|constraint| constraint.depends_on_time(at))
    }
}
