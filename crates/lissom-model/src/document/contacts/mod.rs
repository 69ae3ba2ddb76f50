//! Contacts between parts: each is of a kind, which has its keys and its law.

mod compliant;
mod entry;
mod flexible;
mod kinds;
mod law;
mod parts;
mod rigid;
mod solutions;

pub use compliant::CompliantLaw;
pub use entry::{ContactEntry, ContactLaw};
pub use flexible::{FlexibleLaw, FlexiblePart, Way};
pub(super) use kinds::variants;
pub(super) use parts::Parts;
pub use solutions::table_of_solutions;

use crate::format::top_level::singular;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::report::Located;

/// The contacts.
pub(super) fn contacts(context: &Context<'_>, parts: &Parts<'_>) -> Vec<ContactEntry> {
    let entry = |(name, span, node)| {
        let what = format!("{} `{name}`", singular("contacts"));
        let kind = kinds::of(context, node, (&what, span))?;
        let reader = Reader::open(context, node, (what, span), kind.keys())?;
        let (between, others, law) = (kind.read)(&reader, parts)?;
        let except = match law {
            ContactLaw::Flexible(_) => Vec::new(),
            _ => parts::exceptions(&reader, &between, &others)?,
        };
        Some(ContactEntry { name: Located::new(String::from(name), span), between, others, except, law })
    };
    context.entries("contacts").into_iter().filter_map(entry).collect()
}
