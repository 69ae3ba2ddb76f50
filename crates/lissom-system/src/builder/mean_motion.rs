//! Adds bodies with the mean motion of a set of nodes.

use super::{Builder, JointAttachment};
use lissom_mechanics::joints::mean_motion::{EQUATIONS, MeanMotion};
use lissom_mechanics::kinematics::Quantity;
use lissom_mechanics::registry::ParameterError;

impl Builder {
    /// Gives the last node of an attachment the mean motion of those before it, by their shares.
    ///
    /// # Errors
    /// If there are too many nodes, they are on a line, or the last one has no rotations.
    pub(super) fn add_mean_motion(
        &mut self,
        name: &str,
        attachment: &JointAttachment,
    ) -> Result<(), ParameterError> {
        let Some((&(body, _), set)) = attachment.nodes.split_last() else {
            return Err(ParameterError::new("tip", "must name a body"));
        };
        if self.model.nodes[body].freedoms.is_point() {
            let problem = "must be a body that turns freely, not a point mass or a node of a planar model";
            return Err(ParameterError::new("tip", problem));
        }
        // The equations relate all nodes of a set to each other, which takes time and memory of the square of their number.
        let most = 400;
        if set.len() > most {
            let problem = format!(
                "has {} nodes, more than {most}: their mean would take long; name a part of them",
                set.len()
            );
            return Err(ParameterError::new("base", problem));
        }
        let frame = self.model.frame(body);
        let place = |node| frame.inverse_transform_point(&self.model.frame(node).position);
        let members: Vec<_> = set
            .iter()
            .zip(&attachment.shares)
            .map(|(&(node, _), &share)| (node, share, place(node)))
            .collect();
        let first_multiplier = self.multipliers.len();
        let Some(own) = MeanMotion::new((name, first_multiplier), body, &members) else {
            let problem = "must have three nodes that are not on a line: others have no rotation";
            return Err(ParameterError::new("base", problem));
        };
        for (equation, direction) in EQUATIONS.into_iter().enumerate() {
            self.multipliers.push((name.to_owned(), direction));
            let quantity = if equation < 3 { Quantity::Length } else { Quantity::Angle };
            self.multiplier_quantities.push(quantity);
        }
        self.constraints.mean_motions.push(own);
        Ok(())
    }
}
