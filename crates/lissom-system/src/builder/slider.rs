//! Adds sliders along beams.

use lissom_motion::Vector3;

use super::Builder;
use lissom_mechanics::elements::initial_model::Coordinate;
use lissom_mechanics::joints::alignment::{Across, Alignment};
use lissom_mechanics::joints::centerline::{Centerline, Support};
use lissom_mechanics::joints::slider::{CarriedPoint, Orientation, Slider};
use lissom_mechanics::kinematics::{CoordinateId, Freedoms, NodeId, Quantity};
use lissom_mechanics::number::Written;
use lissom_mechanics::registry::ParameterError;

/// Allowed initial distance of a point from the line, relative to the length of the line. It covers the digits of a text,
/// and the deviation of the smooth line through the nodes from a curved one.
const MAX_DISTANCE: f64 = 1e-4;

impl Builder {
    /// Adds a slider: a point of the node `tip`, initially at `place`, slides along the line through `nodes` at the arc
    /// lengths `knots` [m]. Returns its coordinate, the arc length. `orientation` determines how the tip rotates.
    ///
    /// # Errors
    /// If there are too few nodes, the tip is one of them, the point is not on the line, or the tip cannot rotate as
    /// required.
    pub fn add_slider(
        &mut self,
        name: &str,
        (nodes, knots): (Vec<CarriedPoint>, Vec<f64>),
        (tip, place): (NodeId, Vector3),
        orientation: &Orientation,
    ) -> Result<CoordinateId, ParameterError> {
        let unusable = |why: &str| ParameterError::new("beams", why);
        if nodes.len() != knots.len() {
            return Err(unusable("must have an arc length for each node"));
        }
        if nodes.iter().any(|own| own.node == tip) {
            return Err(ParameterError::new("tip", "is a node of the beam that it slides on"));
        }
        let Some(line) = Centerline::new(knots) else {
            return Err(unusable("must lead from node to node: some coincide"));
        };
        let at =
            |node: usize| self.model.nodes[nodes[node].node].motion.frame.transform_point(&nodes[node].point);
        let value = line.nearest(&place, at);
        let on_line = line.at(value).sum(0, at);
        let distance = (on_line - place).norm();
        // Parts that are given approximately are assembled afterwards.
        let is_drawn = self.start_values.is_some();
        if distance.is_nan() || (!is_drawn && distance > MAX_DISTANCE * line.length()) {
            let problem = format!(
                "must be on the line through the beam's nodes, but is {:.3e} m away from it; its nearest position is \
                 [{}, {}, {}]",
                Written(distance),
                Written(on_line.x),
                Written(on_line.y),
                Written(on_line.z)
            );
            return Err(ParameterError::new("at", problem));
        }
        let own = if is_drawn { place } else { on_line };
        let point = self.model.nodes[tip].motion.frame.inverse_transform_point(&own);
        self.model.check_carried(
            "tip",
            (tip, self.model.frame(tip).inverse_transform_point(&place)),
            false,
        )?;
        let alignments = self.alignments((&nodes, &line.at(value)), tip, orientation)?;
        let coordinate = self.model.add_coordinate(Coordinate {
            name: format!("{name}.displacement"),
            value,
            rate: 0.0,
            quantity: Quantity::Length,
        });
        let first_multiplier = self.multipliers.len();
        for direction in ["force along x", "force along y", "force along z"] {
            self.multipliers.push((name.to_owned(), direction));
            self.multiplier_quantities.push(Quantity::Length);
        }
        let moments = ["moment 1 across", "moment 2 across", "moment about"];
        for direction in moments.into_iter().take(alignments.len()) {
            self.multipliers.push((name.to_owned(), direction));
            self.multiplier_quantities.push(Quantity::Angle);
        }
        self.constraints.sliders.push(Slider {
            name: name.to_owned(),
            nodes,
            line,
            tip: CarriedPoint { node: tip, point },
            coordinate,
            alignments,
            first_multiplier,
        });
        Ok(coordinate)
    }

    /// Directions of the tip that remain perpendicular to the initial tangent, and to an axis of the sections.
    fn alignments(
        &self,
        (nodes, support): (&[CarriedPoint], &Support),
        tip: NodeId,
        orientation: &Orientation,
    ) -> Result<Vec<Alignment>, ParameterError> {
        let fault = |why: &str| Err(ParameterError::new("orientation", why));
        if *orientation == Orientation::Free {
            return Ok(Vec::new());
        }
        if self.model.nodes[tip].freedoms != Freedoms::Full {
            return fault(
                "requires a tip with free rotation in space: a body, not a point mass or a planar model",
            );
        }
        let frame = |node: NodeId| &self.model.nodes[node].motion.frame;
        let tangent = support.sum(1, |k| frame(nodes[k].node).transform_point(&nodes[k].point));
        let mut alignments = Vec::new();
        let mut across = |direction: &Vector3, what: Across| {
            let direction = frame(tip).rotation.apply_inverse(direction);
            alignments.push(Alignment { direction, across: what });
        };
        let sections = match orientation {
            Orientation::Section(axes) => Some(axes),
            Orientation::Free | Orientation::Tangent => None,
        };
        // Any direction perpendicular to the tangent is valid, unless the sections determine one.
        let beside = sections.map_or_else(
            || Vector3::ith(tangent.iamin(), 1.0),
            |axes| support.sum(0, |k| frame(nodes[k].node).rotation.apply(&axes[k])),
        );
        let Some(first) = tangent.cross(&beside).try_normalize(0.0) else {
            return fault("finds no axis of the sections across the line at the start");
        };
        across(&first, Across::Tangent);
        across(&tangent.cross(&first).normalize(), Across::Tangent);
        if let Some(axes) = sections {
            across(&first, Across::Sections(axes.clone()));
        }
        Ok(alignments)
    }
}
