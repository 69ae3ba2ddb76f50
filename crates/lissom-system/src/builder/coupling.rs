//! Adds drives of coordinates, and relations between coordinates.

use super::Builder;
use lissom_mechanics::elements::gear_friction::GearFriction;
use lissom_mechanics::elements::initial_model::Coordinate;
use lissom_mechanics::joints::coupling::{Coupling, MAX_COUPLED, Relation, RelationPoint};
use lissom_mechanics::joints::prescribed::Prescribed;
use lissom_mechanics::joints::{Build, Drive, JointKind};
use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_mechanics::registry::{ParameterError, Parameters};

impl Builder {
    /// Prescribes a coordinate with a drive of the given kind.
    ///
    /// # Errors
    /// If a parameter is missing, or the drive is for another kind of coordinate.
    pub fn add_drive(
        &mut self,
        name: &str,
        kind: &JointKind,
        coordinate: CoordinateId,
        parameters: &Parameters,
    ) -> Result<(), ParameterError> {
        let (Build::Coordinate(build), Some(wanted)) = (kind.build, kind.ports.quantity()) else {
            return Err(ParameterError::new("kind", "is between two nodes"));
        };
        self.model.check_quantity(coordinate, wanted)?;
        let prescribed = Prescribed { coordinate, value: build(&parameters.declared(kind.parameters))? };
        self.constraints.drives.push(Drive {
            name: name.to_owned(),
            prescribed,
            quantity: wanted,
            multiplier: self.multipliers.len(),
        });
        self.multipliers.push((name.to_owned(), wanted.relative()));
        self.multiplier_quantities.push(wanted);
        Ok(())
    }

    /// Adds coordinates that are not between nodes, of the given kind.
    ///
    /// # Errors
    /// If a parameter is missing or invalid.
    pub fn add_free_coordinates(
        &mut self,
        name: &str,
        kind: &JointKind,
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        let Build::Free(build) = kind.build else {
            return Err(ParameterError::new("kind", "has no coordinates of its own"));
        };
        let free = build(&parameters.declared(kind.parameters))?;
        let numbered = |k: usize| if free.len() > 1 { (k + 1).to_string() } else { String::new() };
        let coordinates = free.iter().enumerate().map(|(k, own)| Coordinate {
            name: format!("{name}.{}{}", own.coordinate.name, numbered(k)),
            value: own.value,
            rate: own.rate,
            quantity: own.coordinate.quantity,
        });
        let added: Vec<CoordinateId> = coordinates.map(|own| self.model.add_coordinate(own)).collect();
        self.free_coordinates.extend(&added);
        Ok(added)
    }

    /// Relates coordinates by a relation of the given kind, in the order of its arguments.
    ///
    /// # Errors
    /// If a parameter is missing, a coordinate is named twice, or the relation does not depend on its coordinates.
    pub fn add_coupling(
        &mut self,
        name: &str,
        kind: &JointKind,
        coordinates: &[CoordinateId],
        parameters: &Parameters,
    ) -> Result<(), ParameterError> {
        let Build::Coupling(build) = kind.build else {
            return Err(ParameterError::new("kind", "relates no coordinates"));
        };
        let count = coordinates.len();
        if count == 0 || count > MAX_COUPLED {
            let problem =
                format!("relates {count} coordinates of joints, but must relate 1 to {MAX_COUPLED}");
            return Err(ParameterError::new("kind", problem));
        }
        if (1..count).any(|k| coordinates[..k].contains(&coordinates[k])) {
            return Err(ParameterError::new("other", "names the same coordinate as `joint`"));
        }
        let start: Vec<f64> = coordinates.iter().map(|&k| self.model.coordinates[k].value).collect();
        let parameters = parameters.declared(kind.parameters);
        let relation = build(&parameters, &start)?;
        let quantities: Vec<Quantity> =
            coordinates.iter().map(|&k| self.model.coordinates[k].quantity).collect();
        let quantity =
            if quantities.contains(&Quantity::Length) { Quantity::Length } else { Quantity::Angle };
        let largest = largest_slope(&*relation, &start, |k| quantities[k] == quantity);
        if !(largest.is_finite() && largest > 0.0) {
            let problem = "does not change with its coordinates at the start: specify their values there, or \
                           another equation";
            return Err(ParameterError::new(kind.parameters[0].name, problem));
        }
        let multiplier = self.multipliers.len();
        let efficiency = parameters.number_or("efficiency", 1.0)?;
        if efficiency < 1.0 {
            let mut unit = vec![0.0; count];
            unit[0] = 1.0;
            let moment = relation.jet((0.0, &start), (0.0, &unit))[1] / largest;
            let law = [efficiency, parameters.number("deflection")?, parameters.number("damping")?];
            let of_gear = (multiplier, moment);
            self.add(GearFriction::contribution(&self.model, coordinates[0], of_gear, law).without_outputs());
        }
        self.constraints.couplings.push(Coupling {
            name: name.to_owned(),
            coordinates: coordinates.to_vec(),
            quantities,
            quantity,
            multiplier,
            relation,
            scale: 1.0 / largest,
        });
        self.multipliers.push((name.to_owned(), "coupling"));
        self.multiplier_quantities.push(quantity);
        Ok(())
    }
}

/// The largest derivative of a relation by one of the chosen coordinates at the start.
fn largest_slope(relation: &dyn Relation, start: &[f64], is_chosen: impl Fn(usize) -> bool) -> f64 {
    let at: RelationPoint<'_> = (0.0, start);
    let slope = |k: usize| {
        let mut unit = vec![0.0; start.len()];
        unit[k] = 1.0;
        relation.jet(at, (0.0, &unit))[1].abs()
    };
    (0..start.len()).filter(|&k| is_chosen(k)).map(slope).fold(0.0, f64::max)
}
