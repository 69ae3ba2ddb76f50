//! Contacts of shells with balls where they are nearest.

use lissom_contact::forms::Form;
use lissom_contact::geometry::surfaces::Rod;
use lissom_contact::of_shells::{ShellContact, contact_patches};
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::NodeId;
use lissom_motion::Vector3;
use lissom_system::Builder;

use super::flexible::{OfFlexible, point};
use super::pairs::solids;
use crate::document::Shell;
use crate::outputs::contact_point::ContactPoint;
use crate::outputs::shell_nodes::BuiltShell;
use crate::text::report::Problem;

/// Pairs of balls and elements that may touch.
const MAX_PAIRS: usize = 50_000;

impl OfFlexible<'_> {
    /// Balls, each with all elements.
    pub(super) fn nearest_to_shell(
        &self,
        (shell, built): (&Shell, &BuiltShell),
        base: NodeId,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        if shell.offset != 0.0 {
            let message = format!("shell `{}` has an `offset`", shell.name.value);
            return Err(self.fault(
                &message,
                "give `stiffness_per_area` instead of `stiffness`, or describe the middle of the thickness without `offset`",
            ));
        }
        let thickness: Vec<f64> =
            (0..shell.mesh.elements.len()).map(|element| shell.thickness(element)).collect();
        if thickness.iter().any(|own| (own - thickness[0]).abs() > 1e-9 * thickness[0]) {
            let message = format!("the thickness of shell `{}` is not the same everywhere", shell.name.value);
            return Err(
                self.fault(&message, "give `stiffness_per_area` instead of `stiffness`, or one thickness")
            );
        }
        let solids = solids(self.document, &self.entry.between[0].value);
        let pairs = solids.len() * thickness.len();
        let help = "use fewer elements or balls, or divide the shell";
        self.check_count((pairs, MAX_PAIRS), "balls and elements", help)?;
        let patches = contact_patches(builder.model(), &built.surface);
        let law = (self.law.compliance, self.law.dissipation);
        let mut all = Vec::new();
        for solid in solids {
            let Some(Rod { half_length: 0.0, radius }) = solid.form.rod() else {
                return Err(self.no_ball(&solid.form));
            };
            let ball = ((base, solid.frame.transform_point(&Vector3::zeros())), radius);
            let mut contribution = Contribution::to(builder.model());
            let friction = self.friction(all.len() / thickness.len() + 1, &mut contribution);
            builder.add(contribution);
            for (index, (patch, thickness)) in patches.iter().zip(&thickness).enumerate() {
                let friction = friction.as_ref().map(|law| (law, index == 0));
                let contact = ShellContact::new(ball, (patch.clone(), *thickness), law, friction);
                builder.add(Contribution::of(builder.model(), contact.clone()));
                all.push(point(contact));
            }
        }
        Ok(all)
    }

    fn no_ball(&self, form: &Form) -> Problem {
        let message = format!("`stiffness` of a shell on {} is not available", form.kind().words());
        self.fault(&message, "give `stiffness_per_area` instead; `stiffness` is for spheres")
    }
}
