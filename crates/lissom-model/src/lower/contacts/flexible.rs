//! Contacts of beams and shells: what both share.

use lissom_contact::elastic::ContactFriction;
use lissom_contact::forms::Form;
use lissom_contact::reading::ContactElement;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::number::written;
use lissom_system::Builder;

use super::super::names::Names;
use super::at_nodes::TouchingNodes;
use crate::document::{ContactEntry, Document, FlexibleLaw, FlexiblePart, Shell, Way};
use crate::outputs::contact_point::ContactPoint;
use crate::outputs::meshes::BuiltShell;
use crate::reading::mesh_nodes::nodes_at;
use crate::reading::node_reference::MeshPlace;
use crate::text::report::Problem;

/// A contact of a beam or a shell with another part.
#[derive(Clone, Copy)]
pub(super) struct OfFlexible<'a> {
    pub(super) document: &'a Document,
    pub(super) entry: &'a ContactEntry,
    pub(super) law: &'a FlexibleLaw,
}

impl OfFlexible<'_> {
    /// Adds it.
    pub(super) fn add(&self, names: &Names, builder: &mut Builder) -> Result<Vec<ContactPoint>, Problem> {
        match &self.law.tip {
            FlexiblePart::Beam(name) => {
                let line = names.lines.get(&name.value).ok_or_else(|| unknown(&name.value, self.entry))?;
                self.add_beam((&name.value, line), names, builder)
            }
            FlexiblePart::Shell(name) => {
                let found = self.shell(&name.value, names)?;
                match self.law.way {
                    Way::Nodes => {
                        self.add_touching(&TouchingNodes::of_shell(found.0, found.1), names, builder)
                    }
                    _ => self.nearest_to_shell(found, names.node(&self.entry.between[0])?, builder),
                }
            }
            FlexiblePart::Solid(name) => {
                let found = names.meshes.solids.get(&name.value);
                let found =
                    found.ok_or_else(|| self.fault(&format!("there is no solid `{}`", name.value), ""))?;
                let mesh = &found.nodes.mesh;
                let faces = match &self.law.faces {
                    None => mesh.faces.clone(),
                    Some(set) => {
                        let nodes = nodes_at(mesh, &name.value, &MeshPlace::Set(set.value.clone()));
                        let nodes =
                            nodes.map_err(|(message, help)| Problem::error(set.span, message).help(help))?;
                        mesh.faces_in(&nodes)
                    }
                };
                self.add_touching(&TouchingNodes::of_solid(&found.nodes, &faces), names, builder)
            }
        }
    }

    /// Nodes on the shapes of a part, or on a shell.
    fn add_touching(
        &self,
        own: &TouchingNodes,
        names: &Names,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        match &self.law.base {
            Some(base) => self.nodes_on_shell(own, self.shell(&base.name().value, names)?, builder),
            None => self.add_nodes(own, names.node(&self.entry.between[0])?, builder),
        }
    }

    /// A shell as it was described and as it was built.
    fn shell<'n>(&self, name: &str, names: &'n Names) -> Result<(&Shell, &'n BuiltShell), Problem> {
        let found = self.document.shell(name).zip(names.meshes.shells.get(name));
        found.ok_or_else(|| self.fault(&format!("there is no shell `{name}`"), ""))
    }

    /// Law of the contact at a point with this share of a length or an area.
    pub(super) fn compliance(&self, share: f64) -> Compliance {
        Compliance { stiffness: self.law.compliance.stiffness * share, ..self.law.compliance }
    }

    /// Friction of the contact at the point of this number, with bristles of its own.
    pub(super) fn friction(&self, number: usize, contribution: &mut Contribution) -> Option<ContactFriction> {
        let name = format!("{}, friction {number}", self.entry.name.value);
        self.law.friction.as_ref().map(|law| law.with_bristles(&name, contribution))
    }

    pub(super) fn fault(&self, message: &str, help: &str) -> Problem {
        let name = &self.entry.name.value;
        Problem::error(self.entry.name.span, format!("contact `{name}`: {message}")).help(help)
    }

    pub(super) fn no_pair(&self, form: &Form) -> Problem {
        let message = format!("{} on {} is not available", self.law.tip.words(), form.kind().words());
        self.fault(&message, "use planes, boxes, cylinders, tubes, spheres and capsules that have its shape")
    }

    /// A form between two points would not be noticed.
    pub(super) fn check_spacing(
        &self,
        (apart, most): (f64, f64),
        what: &str,
        help: &str,
    ) -> Result<(), Problem> {
        if apart <= most {
            return Ok(());
        }
        let message = format!(
            "the points of {} are {} m apart, more than {} m for {what} of this size, which could pass between them",
            self.law.tip.words().replace("a ", "the "),
            written(apart, 3),
            written(most, 3)
        );
        Err(self.fault(&message, help))
    }

    /// Every two curves or a ball and an element are evaluated.
    pub(super) fn check_count(
        &self,
        (count, most): (usize, usize),
        what: &str,
        help: &str,
    ) -> Result<(), Problem> {
        if count <= most {
            return Ok(());
        }
        Err(self.fault(&format!("{count} pairs of {what} may touch, more than {most}"), help))
    }
}

/// A point of a contact.
pub(super) fn point(contact: impl ContactElement + 'static) -> ContactPoint {
    ContactPoint { contact: std::sync::Arc::new(contact), sign: 1.0, velocity: None }
}

/// There is no such beam.
pub(super) fn unknown(beam: &str, entry: &ContactEntry) -> Problem {
    Problem::error(entry.name.span, format!("contact `{}`: there is no beam `{beam}`", entry.name.value))
}
