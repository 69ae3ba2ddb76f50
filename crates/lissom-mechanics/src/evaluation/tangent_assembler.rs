//! Assembles the derivatives of elements and joints: each kind of derivative separately, or their weighted sum, the
//! tangent. Independent of the scheme, which supplies the weights.

use lissom_motion::Block;
use lissom_solver::Scalar;
use num_complex::Complex64;

use super::element::Tangents;
use super::linearization::Linearization;
use super::scatter_map::Segment;
use crate::joints::derivatives::{Derivatives, OWN, TIP};

/// Factors of the derivatives in a tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend<T> {
    /// Factor of ∂/∂ position.
    pub place: f64,
    /// Factor of ∂/∂ twist.
    pub rate: T,
    /// Factor of ∂/∂ acceleration.
    pub acceleration: T,
    /// Factor of BᵀWB.
    pub augmented: f64,
    /// Factor of B and Bᵀ, and of derivatives of elements' forces with respect to multipliers.
    pub constraint: f64,
    /// Factor of B in the rows of constraints of velocities.
    pub slip: T,
    /// Factor of ∂(B v)/∂ position there.
    pub turning: f64,
    /// Factor of BᵀWB of constraints of velocities.
    pub slip_augmented: f64,
}

/// A tangent under assembly.
#[derive(Debug)]
pub struct Sum<'a, T> {
    /// Factors of the derivatives.
    pub blend: Blend<T>,
    /// The tangent, on its pattern.
    pub values: &'a mut [T],
    /// Receives the diagonal of ∂/∂ position by row, at least for translations; may be empty.
    pub stiffness: &'a mut [f64],
}

/// Destination of the derivatives.
#[derive(Debug)]
pub enum TangentAssembler<'a> {
    /// Each kind separately.
    Separate(&'a mut Linearization),
    /// Their sum with real factors.
    Real(Sum<'a, f64>),
    /// Their sum with complex factors.
    Complex(Sum<'a, Complex64>),
    /// Several of them, from one evaluation of the derivatives.
    Each(&'a mut [TangentAssembler<'a>]),
}

/// An element's or joint's position in the system.
#[derive(Clone, Copy)]
pub struct Slot<'a> {
    /// Row of each local unknown, or locked.
    pub rows: &'a [u32],
    /// Positions of its local matrix.
    pub segments: &'a [Segment],
}

impl Slot<'_> {
    /// Positions of the diagonal from the local unknown `first` on.
    fn diagonal(self, first: usize) -> impl Iterator<Item = usize> {
        self.segments.iter().filter_map(move |run| {
            let (row, column) = (usize::from(run.row), usize::from(run.column));
            let within = column.checked_sub(row).filter(|_| column >= first)?;
            run.positions().nth(within)
        })
    }
}

impl TangentAssembler<'_> {
    /// Sets all values to zero.
    pub fn clear(&mut self) {
        match self {
            Self::Separate(linearization) => linearization.clear(),
            Self::Real(sum) => sum.clear(),
            Self::Complex(sum) => sum.clear(),
            Self::Each(all) => all.iter_mut().for_each(Self::clear),
        }
    }

    /// Adds an element's derivatives.
    pub fn add_element(&mut self, place: Slot<'_>, local: &Tangents) {
        match self {
            Self::Separate(out) => {
                for (position, i, j) in place.segments.iter().flat_map(|run| run.entries()) {
                    let entry = i * local.size() + j;
                    if j >= local.first_multiplier() {
                        out.by_multiplier[position] += local.stiffness[entry];
                        continue;
                    }
                    out.stiffness[position] += local.stiffness[entry];
                    out.damping[position] += local.damping[entry];
                    out.mass[position] += local.mass[entry];
                }
            }
            Self::Real(sum) => sum.add_element(place, local),
            Self::Complex(sum) => sum.add_element(place, local),
            Self::Each(all) => all.iter_mut().for_each(|own| own.add_element(place, local)),
        }
    }

    /// Adds the derivatives of an element whose forces are the rates of its coordinates, the local unknowns from `first` on.
    pub fn add_rates(&mut self, place: Slot<'_>, first: usize) {
        match self {
            Self::Separate(out) => place.diagonal(first).for_each(|position| out.damping[position] += 1.0),
            Self::Real(sum) => sum.add_rates(place, first),
            Self::Complex(sum) => sum.add_rates(place, first),
            Self::Each(all) => all.iter_mut().for_each(|own| own.add_rates(place, first)),
        }
    }

    /// Adds derivatives of one element of a block with respect to positions and to twists, row after row; the latter may be empty.
    pub fn add_lane(&mut self, place: Slot<'_>, entries: [&[Block]; 2], lane: usize) {
        match self {
            Self::Separate(out) => {
                for (values, entries) in [&mut out.stiffness, &mut out.damping].into_iter().zip(entries) {
                    scatter_lane(place, (entries, lane), 1.0, values);
                }
            }
            Self::Real(sum) => sum.add_lane(place, entries, lane),
            Self::Complex(sum) => sum.add_lane(place, entries, lane),
            Self::Each(all) => all.iter_mut().for_each(|own| own.add_lane(place, entries, lane)),
        }
    }

    /// Adds a joint's derivatives.
    pub fn add_joint(&mut self, place: Slot<'_>, joint: &mut Derivatives) {
        match self {
            Self::Separate(out) => {
                let Linearization { stiffness, gram, constraint, .. } = &mut **out;
                for (values, [place_, augmented, constraint]) in
                    [(stiffness, [1.0, 0.0, 0.0]), (gram, [0.0, 1.0, 0.0]), (constraint, [0.0, 0.0, 1.0])]
                {
                    joint.sum(place_, augmented, constraint);
                    scatter(place.segments, joint, values);
                }
            }
            Self::Real(sum) => sum.add_joint(place, joint),
            Self::Complex(sum) => sum.add_joint(place, joint),
            Self::Each(all) => all.iter_mut().for_each(|own| own.add_joint(place, joint)),
        }
    }

    /// Adds B and ∂(B v)/∂ position at one position in a row of a constraint of velocities.
    pub fn add_slip_entry(&mut self, position: usize, [gradient, turning]: [f64; 2]) {
        match self {
            Self::Separate(out) => {
                out.constraint[position] += gradient;
                out.stiffness[position] += turning;
            }
            Self::Real(sum) => sum.add_slip_entry(position, [gradient, turning]),
            Self::Complex(sum) => sum.add_slip_entry(position, [gradient, turning]),
            Self::Each(all) => {
                all.iter_mut().for_each(|own| own.add_slip_entry(position, [gradient, turning]));
            }
        }
    }

    /// Adds BᵀWB of a constraint of velocities at one position.
    pub fn add_slip_gram(&mut self, position: usize, augmented: f64) {
        match self {
            // Only load steps need it, to eliminate what such a constraint alone holds.
            Self::Separate(_) => {}
            Self::Real(sum) => sum.add_slip_gram(position, augmented),
            Self::Complex(sum) => sum.add_slip_gram(position, augmented),
            Self::Each(all) => all.iter_mut().for_each(|own| own.add_slip_gram(position, augmented)),
        }
    }

    /// Adds stiffness, BᵀWB and constraint at one position.
    pub fn add_constraint_entry(&mut self, position: usize, [place, augmented, constraint]: [f64; 3]) {
        match self {
            Self::Separate(out) => {
                out.stiffness[position] += place;
                out.gram[position] += augmented;
                out.constraint[position] += constraint;
            }
            Self::Real(sum) => sum.add_constraint_entry(position, [place, augmented, constraint]),
            Self::Complex(sum) => sum.add_constraint_entry(position, [place, augmented, constraint]),
            Self::Each(all) => {
                all.iter_mut()
                    .for_each(|own| own.add_constraint_entry(position, [place, augmented, constraint]));
            }
        }
    }
}

impl<T: Scalar> Sum<'_, T> {
    fn add_slip_entry(&mut self, position: usize, [gradient, turning]: [f64; 2]) {
        let Blend { slip, turning: by_place, .. } = self.blend;
        self.values[position] += slip * T::from_real(gradient) + T::from_real(by_place * turning);
    }

    fn add_slip_gram(&mut self, position: usize, augmented: f64) {
        self.values[position] += T::from_real(self.blend.slip_augmented * augmented);
    }

    fn clear(&mut self) {
        self.values.fill(T::zero());
        self.stiffness.fill(0.0);
    }

    fn add_element(&mut self, place: Slot<'_>, local: &Tangents) {
        let (size, blend) = (local.size(), self.blend);
        let Slot { rows, segments } = place;
        for run in segments {
            let first = usize::from(run.row) * size + usize::from(run.column);
            let is_multiplier = usize::from(run.column) >= local.first_multiplier();
            let place = if is_multiplier { blend.constraint } else { blend.place };
            for (k, value) in self.values[run.positions()].iter_mut().enumerate() {
                let entry = first + k * size;
                *value += T::from_real(place * local.stiffness[entry])
                    + blend.rate * T::from_real(local.damping[entry])
                    + blend.acceleration * T::from_real(local.mass[entry]);
            }
        }
        for (i, &row) in rows.iter().enumerate() {
            // Locked rows are out of range.
            if let Some(sum) = self.stiffness.get_mut(row as usize) {
                *sum += local.stiffness[i * size + i];
            }
        }
    }

    fn add_rates(&mut self, place: Slot<'_>, first: usize) {
        place.diagonal(first).for_each(|position| self.values[position] += self.blend.rate);
    }

    fn add_lane(&mut self, place: Slot<'_>, [stiffness, damping]: [&[Block]; 2], lane: usize) {
        let rows = place.rows;
        scatter_lane(place, (stiffness, lane), T::from_real(self.blend.place), self.values);
        scatter_lane(place, (damping, lane), self.blend.rate, self.values);
        for (i, &row) in rows.iter().enumerate() {
            // Locked rows are out of range.
            if let Some(sum) = self.stiffness.get_mut(row as usize) {
                *sum += stiffness[i * rows.len() + i][lane];
            }
        }
    }

    fn add_joint(&mut self, place: Slot<'_>, joint: &mut Derivatives) {
        joint.sum(self.blend.place, self.blend.augmented, self.blend.constraint);
        scatter(place.segments, joint, self.values);
        for i in (0..3).chain(TIP..TIP + 3).chain(OWN..TIP + 8) {
            if let Some(sum) = self.stiffness.get_mut(place.rows[i] as usize) {
                *sum += joint.stiffness(i);
            }
        }
    }

    fn add_constraint_entry(&mut self, position: usize, [place, augmented, constraint]: [f64; 3]) {
        let Blend { place: p, augmented: a, constraint: c, .. } = self.blend;
        self.values[position] += T::from_real(p * place + a * augmented + c * constraint);
    }
}

/// Adds a factor times the entries of an element of a block, row after row; they may be empty.
fn scatter_lane<T: Scalar>(
    Slot { rows, segments }: Slot<'_>,
    (entries, lane): (&[Block], usize),
    factor: T,
    values: &mut [T],
) {
    let size = rows.len();
    for run in segments.iter().filter(|_| !entries.is_empty()) {
        let column = entries[usize::from(run.row) * size + usize::from(run.column)..].iter().step_by(size);
        for (value, entry) in values[run.positions()].iter_mut().zip(column) {
            *value += factor * T::from_real(entry[lane]);
        }
    }
}

fn scatter<T: Scalar>(segments: &[Segment], joint: &Derivatives, values: &mut [T]) {
    for run in segments {
        let row = usize::from(run.row);
        let own = &joint.column(usize::from(run.column))[row..row + usize::from(run.length)];
        let values = &mut values[run.positions()];
        // A node's six rows, or the three of a point: without a loop.
        if let (Ok(values), Ok(own)) = (<&mut [T; 6]>::try_from(&mut *values), <&[f64; 6]>::try_from(own)) {
            add(values, own);
        } else if let (Ok(values), Ok(own)) =
            (<&mut [T; 3]>::try_from(&mut *values), <&[f64; 3]>::try_from(own))
        {
            add(values, own);
        } else {
            for (value, own) in values.iter_mut().zip(own) {
                *value += T::from_real(*own);
            }
        }
    }
}

fn add<T: Scalar, const COUNT: usize>(values: &mut [T; COUNT], own: &[f64; COUNT]) {
    for (value, own) in values.iter_mut().zip(own) {
        *value += T::from_real(*own);
    }
}
