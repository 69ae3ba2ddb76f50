//! Forces of a tread over its slip: what the laws of tyres have in common.

use super::brush::Brush;
use super::magic_formula::MagicFormula;
use crate::dual::Number;

/// State of the contact of a tyre.
pub(super) struct Slip<T> {
    /// κ, positive where the wheel is driven.
    pub(super) along: T,
    /// tan α, positive where the wheel slides towards y.
    pub(super) across: T,
    /// sin γ, positive where the wheel leans away from y.
    pub(super) lean: T,
    /// N.
    pub(super) normal: T,
    /// V₁.
    pub(super) rolling: T,
    /// From -1 to 1: in which direction the wheel moves, 0 at standstill.
    pub(super) forwards: T,
    /// From -1 to 1: in which direction it turns.
    pub(super) turning: T,
}

/// Forces of the road on a tyre in axes x, y, n, at the centre of contact.
#[derive(Clone, Copy)]
pub(super) struct Tread<T> {
    /// F₁.
    pub(super) along: T,
    /// F₂.
    pub(super) across: T,
    /// About x.
    pub(super) overturning: T,
    /// About the axis of the wheel.
    pub(super) resisting: T,
    /// M_n.
    pub(super) aligning: T,
}

/// A law of the forces of a tyre.
#[derive(Clone, Debug)]
pub(super) enum Law {
    /// With few data.
    Brush(Brush),
    /// Fitted to measurements.
    MagicFormula(Box<MagicFormula>),
}

impl Law {
    /// N without its sign, for a deflection and its rate.
    pub(super) fn normal<T: Number>(&self, depth: T, rate: T) -> T {
        match self {
            Self::Brush(law) => depth.scaled(law.normal[0]) + rate.scaled(law.normal[1]),
            Self::MagicFormula(law) => law.normal(depth, rate),
        }
    }

    /// R_e.
    pub(super) fn effective_radius<T: Number>(&self, radius: f64, depth: T) -> T {
        match self {
            Self::Brush(_) => -depth.scaled(1.0 / 3.0).plus(-radius),
            Self::MagicFormula(law) => law.effective_radius(depth),
        }
    }

    /// σ along and across.
    pub(super) fn relaxation<T: Number>(&self, normal: T, lean: T) -> [T; 2] {
        match self {
            Self::Brush(law) => law.relaxation.map(T::constant),
            Self::MagicFormula(law) => law.relaxation(normal, lean),
        }
    }

    /// ε_a: friction over slip stiffness, along and across.
    pub(super) fn adhesion<T: Number>(&self, normal: T) -> [T; 2] {
        match self {
            Self::Brush(law) => [0, 1].map(|k| law.friction(normal).scaled(1.0 / law.slip[k])),
            Self::MagicFormula(law) => law.adhesion(normal),
        }
    }

    /// The forces.
    pub(super) fn tread<T: Number>(&self, slip: &Slip<T>) -> Tread<T> {
        match self {
            Self::Brush(law) => law.tread(slip),
            Self::MagicFormula(law) => law.tread(slip),
        }
    }
}
