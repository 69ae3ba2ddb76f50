//! Power that springs, loads, drives and friction put into the rest of the model.

use std::slice::from_ref;
use std::sync::Arc;

use lissom_mechanics::kinematics::CoordinateId;
use lissom_mechanics::signals::Argument;
use lissom_mechanics::signals::measurement::Measurement;
use lissom_system::OutputDerivatives;
use lissom_system::element_quantity::Of;
use lissom_system::{ElementId, ScaledPower, System};

use super::derivatives::{add, add_argument, add_scaled, multiplier_row, of_gradient};
use super::frames::name_of;
use super::{Build, Evaluation, Found, OutputQuantity, Resolver, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::{Located, Problem};

/// Registry entry.
pub(crate) const POWER: Declaration = Declaration {
    word: "power",
    summary: "Power that a spring, a load, a drive or the friction of a joint delivers to the rest of the model.",
    subject: Subject::Actor,
    features: &[Feature::Accelerations],
    components: &[("power", "W")],
    build: Build::Element(|_| Of::Power, quantity),
};
/// What puts power into a model.
#[derive(Clone)]
pub(super) enum Actor {
    /// One, or one for each node of a set.
    Elements(Vec<ElementId>),
    /// By its position among the drives.
    Drive(usize),
    /// By its position among the latches.
    Latch(usize),
}

/// The spring, load, drive or friction of a joint of this name.
pub(super) fn actor(name: &Located<String>, system: &System, names: &Resolver<'_>) -> Result<Actor, Problem> {
    let drive = system.drives().iter().position(|drive| drive.name == name.value);
    let own = names.powers.get(&name.value).map(|own| Actor::Elements(own.clone()));
    let latch = names.latches.get(&name.value).map(|&index| Actor::Latch(index));
    own.or(drive.map(Actor::Drive)).or(latch).ok_or_else(|| {
        Problem::error(name.span, format!("`{}` has no power to record", name.value)).help(
            "name a spring, a load, a drive of a joint's coordinate, or a joint with friction; other joints neither give nor take",
        )
    })
}

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    Ok(match actor(name_of(output)?, system, subjects.names)? {
        Actor::Drive(index) => Arc::new(OfConstraint::drive(index)),
        Actor::Latch(index) => Arc::new(OfConstraint::latch(index)),
        Actor::Elements(elements) => match elements[..] {
            [element] => match system.element_quantity(element, Of::Power) {
                Some(measured) => Arc::new(Measured(measured)),
                None => Arc::new(OfElement(element)),
            },
            _ => Arc::new(OfSet(elements)),
        },
    })
}

/// Power of an element with its gradient.
struct Measured(Arc<dyn Measurement>);

impl OutputQuantity for Measured {
    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        from_ref(&self.0)
    }
}

/// Power of an element that a signal scales, or with many unknowns.
struct OfElement(ElementId);

impl OutputQuantity for OfElement {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.push(at.system.power(self.0, at.motion()));
    }

    /// Derivatives of the power of a load that a signal scales, by the product rule.
    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let ScaledPower { signal, size, unit, gradient, nodes, coordinates } =
            at.system.scaled_power(self.0, at.motion())?;
        let mut own = OutputDerivatives::default();
        add_argument(&mut own, unit, Argument::Signal(signal), at.system, at.motion());
        add_scaled(&mut own, &of_gradient(&gradient, (nodes, coordinates), at.system), size);
        Some(vec![own])
    }
}

/// Power of a load that is spread over a set of nodes.
struct OfSet(Vec<ElementId>);

impl OutputQuantity for OfSet {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.push(self.0.iter().map(|&element| at.system.power(element, at.motion())).sum());
    }
}

/// Power of a drive or a latch: minus its multiplier times the rate of its coordinate.
struct OfConstraint {
    /// Coordinate and multiplier.
    of: fn(&System, usize) -> (CoordinateId, usize),
    index: usize,
}

impl OfConstraint {
    fn drive(index: usize) -> Self {
        let of = |system: &System, index: usize| {
            let drive = &system.drives()[index];
            (drive.prescribed.coordinate, drive.multiplier)
        };
        Self { of, index }
    }

    fn latch(index: usize) -> Self {
        let of = |system: &System, index: usize| {
            let latch = &system.latches()[index];
            (latch.coordinate, latch.multiplier)
        };
        Self { of, index }
    }
}

impl OutputQuantity for OfConstraint {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (coordinate, multiplier) = (self.of)(at.system, self.index);
        out.push(-at.state.multipliers[multiplier] * at.motion().coordinates[coordinate].rate);
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let (coordinate, multiplier) = (self.of)(at.system, self.index);
        let row = at.system.layout().row_of_coordinate(coordinate);
        let mut own = OutputDerivatives::default();
        let rate = at.motion().coordinates[coordinate].rate;
        add(&mut own.by_multiplier, multiplier_row(at.system, multiplier), -rate);
        add(&mut own.by_rate, row, -at.state.multipliers[multiplier]);
        Some(vec![own])
    }
}
