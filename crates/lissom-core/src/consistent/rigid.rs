//! Inertias and constraints of rigid parts, by the Schur complement of the constraints:
//!
//! ```text
//! [M Bᵀ; B 0] [x; λ] = [b; c],      B M⁻¹ Bᵀ λ = B M⁻¹ b - c,      x = M⁻¹ (b - Bᵀ λ)
//! ```
//!
//! M has a block for each part, in its own axes, and is constant. A coordinate without inertia is eliminated together with the one
//! equation of its joint that determines it, from all other constraints on it as well. The remaining unknowns are the multipliers alone,
//! a third to a half of those of a tangent, and neither curvatures nor augmented terms are needed.

use std::ops::Range;
use std::sync::Arc;

use lissom_motion::{Matrix6, Vector6};
use lissom_solver::{Group, LinearSolver, Pattern, SYMMETRIC, Structure};

use crate::joints::constraint::{Constraint, Port};
use crate::kinematics::{Kinematics, LOCKED};
use crate::round_off;
use crate::system::System;

/// Smallest pivot, relative to its terms, with which a solution has the accuracy of a correction.
pub(crate) const WELL_CONDITIONED: f64 = 1e-6;
/// Stands for what is not among the parts.
const NONE: usize = usize::MAX;

/// The matrix and its factors.
pub(crate) struct RigidMatrix {
    parts: Vec<Part>,
    constraints: Vec<Placed>,
    equations: Vec<Equation>,
    /// Row and equation of each coordinate without inertia.
    eliminated: Vec<(usize, usize)>,
    /// Entries of the matrix: two equations with the index of a part in each, and the position with that of the mirror image.
    entries: Vec<([usize; 2], [usize; 2], [usize; 2])>,
    /// Rows of multipliers that are zero: of omitted equations, and of released constraints.
    zero: Vec<usize>,
    solver: Box<dyn LinearSolver<f64>>,
    values: Vec<f64>,
    right: Vec<f64>,
    /// Forces on the parts, then their motions.
    motions: Vec<Vector6>,
    gradient: Vec<f64>,
}

/// A node, or a coordinate with inertia.
struct Part {
    rows: [u32; 6],
    /// M⁻¹; zero for locked directions.
    inverse: Matrix6,
}

/// A constraint.
struct Placed {
    is_released: bool,
    /// Index of the part and component of each local unknown; none for locked nodes and coordinates without inertia.
    columns: Vec<(usize, usize)>,
    equations: Range<usize>,
}

/// An equation of a constraint.
struct Equation {
    /// Position in its constraint, and row of its multiplier.
    number: usize,
    row: usize,
    /// Position among the unknowns; none if it determines a coordinate.
    index: usize,
    /// Local unknown that it determines, and ∂c/∂ coordinate.
    determines: Option<usize>,
    slope: f64,
    /// Parts on which it acts once coordinates without inertia are eliminated, B and M⁻¹ Bᵀ.
    parts: Vec<usize>,
    blocks: Vec<Vector6>,
    weighted: Vec<Vector6>,
    /// Coordinates that other equations determine: local unknown, which, and derivative relative to that of the other equation.
    through: Vec<(usize, usize, f64)>,
}

/// The matrix of a system for the constraints that are not released, if there is one.
#[derive(Default)]
pub(crate) struct Known {
    /// By constraint, whether it was released when the matrix was looked for; none before that.
    released: Option<Vec<bool>>,
    matrix: Option<Box<RigidMatrix>>,
}

impl Known {
    /// Whether there is a matrix.
    pub(crate) fn is_some(&self) -> bool {
        self.matrix.is_some()
    }

    /// Whether there is no matrix for the constraints of these positions.
    pub(crate) fn has_none(&self, system: &System, at: &Kinematics) -> bool {
        self.matrix.is_none() && self.is_of(system, at)
    }

    fn is_of(&self, system: &System, at: &Kinematics) -> bool {
        let mut now = system.constraints().map(|constraint| constraint.is_released(at));
        self.released.as_ref().is_some_and(|released| released.iter().all(|known| now.next() == Some(*known)))
    }

    /// The matrix with the gradients of these positions, made anew where other constraints are released than before; none if parts are
    /// not rigid. Nothing but positions and constraints decides, so that a resumed run is one that was not interrupted.
    pub(crate) fn renewed(
        &mut self,
        (system, at): (&System, &Kinematics),
        omitted: &[usize],
    ) -> Option<&mut RigidMatrix> {
        if !self.is_of(system, at) {
            self.matrix = RigidMatrix::new(system, at, omitted).map(Box::new);
            self.released = Some(system.constraints().map(|constraint| constraint.is_released(at)).collect());
        }
        let matrix = self.matrix.as_deref_mut()?;
        matrix.gather(system, at)?;
        Some(matrix)
    }

    /// The matrix that was renewed last.
    pub(crate) fn matrix(&mut self) -> Option<&mut RigidMatrix> {
        self.matrix.as_deref_mut()
    }
}

/// Where nodes and coordinates are among the parts.
struct Places {
    parts: Vec<Part>,
    of_node: Vec<usize>,
    /// Part, or which of the coordinates without inertia.
    of_coordinate: Vec<(usize, usize)>,
    /// Row and equation of each coordinate without inertia.
    eliminated: Vec<(usize, usize)>,
}

impl Places {
    /// None if inertias are not constant blocks of parts.
    fn of(system: &System, at: &Kinematics) -> Option<Self> {
        let (layout, count) = (system.layout(), system.layout().coordinate_count());
        if !has_constant_inertias(system, at) {
            return None;
        }
        let entry = inertias(system, at);
        let (mut parts, mut eliminated) = (Vec::new(), Vec::new());
        let mut part_of_row = vec![NONE; count];
        let mut add = |rows: [u32; 6]| {
            if rows.iter().all(|&row| row == LOCKED) {
                return Some(NONE);
            }
            let free = rows.iter().filter(|row| **row != LOCKED);
            free.for_each(|&row| part_of_row[row as usize] = parts.len());
            parts.push(Part { rows, inverse: inverse_of(&rows, &entry)? });
            Some(parts.len() - 1)
        };
        let of_node = layout.node_rows.iter().map(|rows| add(*rows)).collect::<Option<Vec<usize>>>()?;
        let mut place = |&row: &u32| {
            if entry(row as usize, row as usize) == 0.0 {
                eliminated.push((row as usize, NONE));
                return Some((NONE, eliminated.len() - 1));
            }
            Some((add([row, LOCKED, LOCKED, LOCKED, LOCKED, LOCKED])?, NONE))
        };
        let of_coordinate = layout.coordinate_rows.iter().map(&mut place).collect::<Option<_>>()?;
        let pattern = &system.structure().pattern;
        let couples = |column: usize| {
            let mut others = pattern.column(column).iter().filter(|&&row| row < count);
            others.any(|&row| part_of_row[row] != part_of_row[column] && entry(row, column) != 0.0)
        };
        let is_coupled = (0..count).any(couples);
        (!is_coupled).then_some(Self { parts, of_node, of_coordinate, eliminated })
    }
}

/// Constraints and their equations, as they are added.
struct Assembled {
    places: Places,
    constraints: Vec<Placed>,
    equations: Vec<Equation>,
    groups: Vec<Group>,
    /// Number of unknowns.
    kept: usize,
    zero: Vec<usize>,
    gradient: Vec<f64>,
}

impl Assembled {
    /// Adds a constraint, of which `determines` may determine coordinates; none if a coordinate without inertia is not determined by one
    /// equation.
    fn add(
        &mut self,
        constraint: &dyn Constraint,
        (count, at): (usize, &Kinematics),
        determines: bool,
    ) -> Option<()> {
        let (size, first) = (constraint.size(), count + constraint.first_multiplier());
        let is_released = constraint.is_released(at);
        let (mut columns, mut through, mut free) = (Vec::new(), Vec::new(), Vec::new());
        let (mut joined, begin) = (Vec::new(), self.equations.len());
        if is_released {
            self.zero.extend(first..first + constraint.equations());
            self.constraints.push(Placed { is_released, columns, equations: begin..begin });
            return Some(());
        }
        if constraint.arrangements() > 1 {
            return None;
        }
        evaluate(constraint, at, &mut self.gradient);
        for port in (0..constraint.ports()).map(|port| constraint.port(0, port)) {
            let (part, which) = match port {
                Port::Node(node) => (self.places.of_node[node.index()], NONE),
                Port::NoNode => return None,
                Port::Coordinate(coordinate) => self.places.of_coordinate[coordinate.index()],
            };
            if which != NONE {
                match self.places.eliminated[which].1 {
                    NONE if determines => free.push((columns.len(), which)),
                    NONE => return None,
                    known => {
                        through.push((columns.len(), which, 0.0));
                        let others = &self.equations[known].parts;
                        for &part in others {
                            index_of(&mut joined, part);
                        }
                    }
                }
            }
            let index = if part == NONE { NONE } else { index_of(&mut joined, part) };
            columns.extend((0..port.width()).map(|component| (index, component)));
        }
        let slope = |e: usize, local: usize| self.gradient[e * size + local].abs();
        let largest = |local: usize| (0..constraint.equations()).map(|e| slope(e, local)).fold(0.0, f64::max);
        let mut group = Vec::new();
        for e in 0..constraint.equations() {
            let mut determined =
                free.iter().filter(|&&(local, _)| slope(e, local) > round_off::MATRIX_ENTRY * largest(local));
            let determines = determined.next();
            let eliminated = &mut self.places.eliminated;
            if determined.next().is_some()
                || determines.is_some_and(|&(_, which)| eliminated[which].1 != NONE)
            {
                return None;
            }
            let is_omitted = self.zero.contains(&(first + e));
            if is_omitted && determines.is_none() {
                continue;
            }
            let index = if let Some(&(_, which)) = determines {
                eliminated[which].1 = self.equations.len();
                NONE
            } else {
                group.push(self.kept);
                self.kept += 1;
                self.kept - 1
            };
            if is_omitted || determines.is_some() && !through.is_empty() {
                return None;
            }
            let blocks = vec![Vector6::zeros(); joined.len()];
            self.equations.push(Equation {
                number: e,
                row: first + e,
                index,
                determines: determines.map(|&(local, _)| local),
                slope: 1.0,
                parts: joined.clone(),
                weighted: blocks.clone(),
                blocks,
                through: through.clone(),
            });
        }
        self.constraints.push(Placed { is_released, columns, equations: begin..self.equations.len() });
        self.groups.extend((!group.is_empty()).then_some(Group { unknowns: group, hosts: vec![] }));
        Some(())
    }
}

impl RigidMatrix {
    /// Matrix at these positions and those that follow; none if inertias are not constant blocks of parts, or a coordinate without
    /// inertia is not determined by one equation.
    fn new(system: &System, at: &Kinematics, omitted: &[usize]) -> Option<Self> {
        let count = system.layout().coordinate_count();
        let mut all = Assembled {
            places: Places::of(system, at)?,
            constraints: Vec::new(),
            equations: Vec::new(),
            groups: Vec::new(),
            kept: 0,
            zero: omitted.iter().map(|multiplier| count + multiplier).collect(),
            gradient: Vec::new(),
        };
        // Joints are first: each determines its own coordinates.
        for (position, constraint) in system.constraints().enumerate() {
            all.add(constraint, (count, at), position < system.joints().len())?;
        }
        let Assembled { places, constraints, equations, groups, kept, zero, gradient } = all;
        let Places { parts, eliminated, .. } = places;
        if kept == 0 || eliminated.iter().any(|&(_, equation)| equation == NONE) {
            return None;
        }
        let mut on_part: Vec<Vec<[usize; 2]>> = vec![Vec::new(); parts.len()];
        for (number, equation) in equations.iter().enumerate().filter(|(_, equation)| equation.index != NONE)
        {
            equation.parts.iter().enumerate().for_each(|(k, &part)| on_part[part].push([number, k]));
        }
        let index = |[equation, _]: &[usize; 2]| equations[*equation].index;
        let cliques: Vec<Vec<usize>> = on_part.iter().map(|all| all.iter().map(index).collect()).collect();
        let pattern = Arc::new(Pattern::from_cliques(kept, cliques.iter().map(Vec::as_slice)));
        let structure = Structure::new(Arc::clone(&pattern), groups).ok()?;
        let pairs =
            on_part.iter().flat_map(|all| all.iter().enumerate().map(move |(k, one)| (one, &all[..=k])));
        let entries = pairs.flat_map(|(&one, others)| others.iter().map(move |&other| (one, other)));
        let position = |one: &[usize; 2], other: &[usize; 2]| pattern.position(index(one), index(other));
        let placed = |(one, other)| Some((one, other, [position(&one, &other)?, position(&other, &one)?]));
        Some(Self {
            entries: entries.map(placed).collect::<Option<_>>()?,
            motions: vec![Vector6::zeros(); parts.len()],
            values: vec![0.0; pattern.entries()],
            right: vec![0.0; kept],
            solver: (SYMMETRIC.real)(&structure),
            parts,
            constraints,
            equations,
            eliminated,
            zero,
            gradient,
        })
    }

    /// Row and inertia of each coordinate without inertia of its own: that of its parts if they could move freely, the smallest possible.
    pub(crate) fn inertias_of_coordinates(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.eliminated.iter().map(|&(row, equation)| {
            let Equation { blocks, weighted, slope, .. } = &self.equations[equation];
            let compliance: f64 =
                blocks.iter().zip(weighted).map(|(block, weighted)| block.dot(weighted)).sum();
            (row, slope * slope / compliance)
        })
    }

    /// Evaluates gradients at these positions; none if a coordinate acts in two equations of its joint.
    fn gather(&mut self, system: &System, at: &Kinematics) -> Option<()> {
        let Self { parts, constraints, equations, eliminated, gradient, .. } = self;
        for (constraint, placed) in
            system.constraints().zip(constraints).filter(|(_, placed)| !placed.is_released)
        {
            evaluate(constraint, at, gradient);
            let size = placed.columns.len();
            let (before, after) = equations.split_at_mut(placed.equations.start);
            for equation in &mut after[..placed.equations.len()] {
                let row = &gradient[equation.number * size..][..size];
                equation.blocks.fill(Vector6::zeros());
                for (value, &(index, component)) in
                    row.iter().zip(&placed.columns).filter(|(_, (index, _))| *index != NONE)
                {
                    equation.blocks[index][component] += value;
                }
                for (local, which, factor) in &mut equation.through {
                    let other = &before[eliminated[*which].1];
                    *factor = row[*local] / other.slope;
                    for (part, block) in other.parts.iter().zip(&other.blocks) {
                        let index = equation.parts.iter().position(|known| known == part)?;
                        equation.blocks[index] -= *factor * block;
                    }
                }
                if let Some(local) = equation.determines {
                    equation.slope = row[local];
                    let mut others = gradient
                        .chunks_exact(size)
                        .enumerate()
                        .filter(|(number, _)| *number != equation.number);
                    if others
                        .any(|(_, row)| row[local].abs() > round_off::MATRIX_ENTRY * equation.slope.abs())
                    {
                        return None;
                    }
                }
                let blocks = equation.parts.iter().zip(&equation.blocks);
                for (weighted, (&part, block)) in equation.weighted.iter_mut().zip(blocks) {
                    *weighted = parts[part].inverse * block;
                }
            }
        }
        Some(())
    }

    /// Factors with the gradients gathered last; none if constraints are nearly dependent.
    pub(crate) fn factor(&mut self) -> Option<()> {
        self.values.fill(0.0);
        for &([one, k], [other, l], [position, mirror]) in &self.entries {
            let sum = self.equations[one].blocks[k].dot(&self.equations[other].weighted[l]);
            self.values[position] += sum;
            if position != mirror {
                self.values[mirror] += sum;
            }
        }
        let report = self.solver.factor(&self.values).ok()?;
        (report.worst_cancellation > WELL_CONDITIONED).then_some(())
    }

    /// Solves in place for motions and multipliers, by row; multipliers of omitted equations are zero.
    pub(crate) fn solve(&mut self, right: &mut [f64]) {
        let Self { parts, equations, eliminated, motions, .. } = self;
        for (motion, Part { rows, .. }) in motions.iter_mut().zip(&*parts) {
            *motion = Vector6::from_fn(|k, _| if rows[k] == LOCKED { 0.0 } else { right[rows[k] as usize] });
        }
        // Multipliers of eliminated equations follow from the rows of their coordinates, which then contain what the equation requires.
        for &(row, equation) in &*eliminated {
            let equation = &equations[equation];
            let force = right[row] / equation.slope;
            right[row] = std::mem::replace(&mut right[equation.row], force);
            equation
                .parts
                .iter()
                .zip(&equation.blocks)
                .for_each(|(&part, block)| motions[part] -= force * block);
        }
        for equation in equations.iter().filter(|equation| equation.index != NONE) {
            let through =
                equation.through.iter().map(|&(_, which, factor)| factor * right[eliminated[which].0]);
            let pushed = equation
                .parts
                .iter()
                .zip(&equation.weighted)
                .map(|(&part, weighted)| weighted.dot(&motions[part]));
            self.right[equation.index] = through.chain(pushed).sum::<f64>() - right[equation.row];
        }
        self.solver.solve(&mut self.right);
        self.zero.iter().for_each(|&multiplier| right[multiplier] = 0.0);
        for equation in equations.iter().filter(|equation| equation.index != NONE) {
            let force = self.right[equation.index];
            right[equation.row] = force;
            for &(_, which, factor) in &equation.through {
                right[equations[eliminated[which].1].row] -= factor * force;
            }
            equation
                .parts
                .iter()
                .zip(&equation.blocks)
                .for_each(|(&part, block)| motions[part] -= force * block);
        }
        for (motion, Part { rows, inverse }) in motions.iter_mut().zip(&*parts) {
            *motion = *inverse * *motion;
            for (k, &row) in rows.iter().enumerate().filter(|(_, row)| **row != LOCKED) {
                right[row as usize] = motion[k];
            }
        }
        for &(row, equation) in &*eliminated {
            let equation = &equations[equation];
            let moved =
                equation.parts.iter().zip(&equation.blocks).map(|(&part, block)| block.dot(&motions[part]));
            right[row] = (right[row] - moved.sum::<f64>()) / equation.slope;
        }
    }
}

/// Evaluates B by equation and local unknown.
fn evaluate(constraint: &dyn Constraint, at: &Kinematics, out: &mut Vec<f64>) {
    out.clear();
    out.resize(constraint.size() * constraint.equations(), 0.0);
    constraint.gradient(at, out);
}

/// Index of a part in a list, to which it is added if it is missing.
fn index_of(parts: &mut Vec<usize>, part: usize) -> usize {
    parts.iter().position(|known| *known == part).unwrap_or_else(|| {
        parts.push(part);
        parts.len() - 1
    })
}

/// Inverse of the block of these rows; none unless it is symmetric and definite.
fn inverse_of(rows: &[u32; 6], entry: &impl Fn(usize, usize) -> f64) -> Option<Matrix6> {
    let is_free = |i: usize, j: usize| rows[i] != LOCKED && rows[j] != LOCKED;
    let matrix = Matrix6::from_fn(|i, j| {
        if is_free(i, j) { entry(rows[i] as usize, rows[j] as usize) } else { f64::from(u8::from(i == j)) }
    });
    if (matrix - matrix.transpose()).amax() > round_off::MATRIX_ENTRY * matrix.amax() {
        return None;
    }
    let inverse = matrix.cholesky()?.inverse();
    Some(Matrix6::from_fn(|i, j| if is_free(i, j) { inverse[(i, j)] } else { 0.0 }))
}

/// Whether no element's inertia depends on its configuration. Signals do not depend on accelerations between samples.
pub(crate) fn has_constant_inertias(system: &System, at: &Kinematics) -> bool {
    let mut changing = Vec::new();
    for inertia in system.elements_with(|element| element.inertia.filter(|_| !element.is_body_inertia)) {
        inertia.mass(at, &mut changing);
    }
    changing.is_empty()
}

/// Inertias by row and column, and one for states, which are decoupled.
fn inertias<'s>(system: &'s System, at: &Kinematics) -> impl Fn(usize, usize) -> f64 + use<'s> {
    let (mass, pattern) = (system.linearization_at(at).mass, &system.structure().pattern);
    let mut is_state = vec![false; system.layout().coordinate_count()];
    system.layout().states().for_each(|(row, ..)| is_state[row] = true);
    move |row: usize, column: usize| {
        let of_state = if row == column && is_state[row] { 1.0 } else { 0.0 };
        of_state + pattern.position(row, column).map_or(0.0, |position| mass[position])
    }
}

#[cfg(test)]
#[path = "../../tests/unit/consistent/rigid.rs"]
mod tests;
