//! A contact as it was written.

use lissom_contact::elastic::ContactFriction;
use lissom_contact::rigid::RigidLaw;

use super::super::NodeReference;
use super::compliant::CompliantLaw;
use super::flexible::FlexibleLaw;
use super::parts::TwoParts;
use crate::text::report::Located;

/// Parts that may touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactEntry {
    /// Name.
    pub name: Located<String>,
    /// Base and tip; of a beam its start.
    pub between: [Located<NodeReference>; 2],
    /// Further parts: every two of all touch each other.
    pub others: Vec<Located<NodeReference>>,
    /// Groups of these parts, by their positions among base, tip and others: no two of a group touch each other.
    pub except: Vec<Vec<usize>>,
    /// How they touch.
    pub law: ContactLaw,
}

/// How parts touch.
#[derive(Clone, Debug, PartialEq)]
pub enum ContactLaw {
    /// Without penetration.
    Rigid(RigidLaw),
    /// A beam or a shell, by a force over the penetration.
    Flexible(FlexibleLaw),
    /// By a force over the penetration.
    Compliant(CompliantLaw),
}

/// What the entry of a kind says: base and tip, further parts, and how they touch.
pub(super) type Touching = (TwoParts, Vec<Located<NodeReference>>, ContactLaw);

impl ContactEntry {
    /// Number of its moving parts if shapes of each two of them may touch, otherwise zero.
    pub(in super::super) fn moving_parts(&self) -> usize {
        if !matches!(self.law, ContactLaw::Compliant(_)) {
            return 0;
        }
        let parts = self.between.iter().chain(&self.others);
        parts.filter(|part| part.value != NodeReference::Ground).count()
    }

    /// Every two parts that may touch.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = [&Located<NodeReference>; 2]> {
        let parts: Vec<_> = self.between.iter().chain(&self.others).collect();
        let groups = self.groups();
        (1..parts.len()).flat_map(move |tip| {
            let (parts, groups) = (parts.clone(), groups.clone());
            let is_apart = move |base: usize| groups[base].iter().any(|own| groups[tip].contains(own));
            (0..tip).filter(move |base| !is_apart(*base)).map(move |base| [parts[base], parts[tip]])
        })
    }

    /// Groups to which base, tip and each other part belong, ascending.
    pub(crate) fn groups(&self) -> Vec<Vec<u32>> {
        let mut of = vec![Vec::new(); 2 + self.others.len()];
        for (group, parts) in (0..).zip(&self.except) {
            for part in parts {
                of[*part].push(group);
            }
        }
        of
    }

    /// Friction of the contact, if it has bristles.
    pub(crate) fn bristles(&self) -> Option<&ContactFriction> {
        match &self.law {
            ContactLaw::Rigid(_) => None,
            ContactLaw::Flexible(law) => law.friction.as_ref(),
            ContactLaw::Compliant(law) => law.friction.as_ref(),
        }
    }
}
