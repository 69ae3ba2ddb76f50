//! Limit of the members of all sets of a file: sets that name each other are much larger than the text that defines them.

use crate::error::MeshError;

/// Largest number of sets of which a node or an element is a member, on average.
const SETS: usize = 200;
/// Number of members that sets of small meshes may have, too.
const FEW: usize = 1_000_000;

/// What remains of the members that the sets of a file may have.
pub(crate) struct SetBudget(usize);

impl SetBudget {
    /// For so many nodes or elements.
    pub(crate) fn of(count: usize) -> Self {
        Self(SETS.saturating_mul(count).saturating_add(FEW))
    }

    /// Uses it for members of a set that is defined at a line.
    ///
    /// # Errors
    /// If they are too many.
    pub(crate) fn spend(&mut self, line: usize, members: usize) -> Result<(), MeshError> {
        let rest = self.0.checked_sub(members);
        self.0 = rest.ok_or_else(|| {
            let found =
                format!("sets of which nodes or elements are more than {SETS} times members on average");
            MeshError::at(line, found, "leave out sets that are not used")
        })?;
        Ok(())
    }
}
