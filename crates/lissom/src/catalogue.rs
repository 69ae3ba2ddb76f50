//! The catalogue of all codes of warnings and failures.

use lissom_core::diagnostics::Entry;

use crate::analyses::{buckling, campbell, gradient, modes, reduce, response};
use crate::{analysis_warning, failures};

/// All codes of warnings and failures, with their meaning.
pub fn catalogue() -> impl Iterator<Item = &'static Entry> {
    let of_core = lissom_core::catalogue::entries();
    let of_model = lissom_model::failures::entries();
    of_core
        .chain(modes::ENTRIES)
        .chain(response::ENTRIES)
        .chain(buckling::ENTRIES)
        .chain(campbell::ENTRIES)
        .chain(reduce::ENTRIES)
        .chain(gradient::ENTRIES)
        .chain(analysis_warning::ENTRIES)
        .chain(of_model)
        .chain(failures::entries())
}

#[cfg(test)]
#[path = "../tests/unit/catalogue.rs"]
mod tests;
