//! What code holds of the parts of a model that it builds: a table, a position in it, and the builder it belongs to.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// Every builder has a number, so that the ids of one mean nothing to another.
static BUILDERS: AtomicU64 = AtomicU64::new(0);

/// Where an entry is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AnyId {
    builder: u64,
    table: Table,
    index: usize,
}

/// An id that does not belong to the model it is used with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a {0} of another model is used with this one: ids are of use where they were made")]
pub struct ForeignId(&'static str);

impl AnyId {
    /// That it means nothing here.
    pub(crate) fn foreign(self) -> ForeignId {
        ForeignId(self.table.singular())
    }
}

macro_rules! tables {
    ($($(#[$doc:meta])* $id:ident: $table:ident = $word:literal, $singular:literal;)*) => {
        /// A table of the model.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Table {
            $($table),*
        }

        impl Table {
            /// Its word in a model file.
            pub(crate) fn word(self) -> &'static str {
                match self {
                    $(Self::$table => $word),*
                }
            }

            /// Whether it has no named entries.
            pub(crate) fn is_single(self) -> bool {
                matches!(self, Self::Initial | Self::Analysis)
            }

            fn singular(self) -> &'static str {
                match self {
                    $(Self::$table => $singular),*
                }
            }
        }

        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
            pub struct $id(pub(crate) AnyId);

            impl Id for $id {
                const TABLE: Table = Table::$table;

                fn from_any(any: AnyId) -> Self {
                    Self(any)
                }
            }

            impl From<$id> for AnyId {
                fn from(id: $id) -> Self {
                    id.0
                }
            }
        )*
    };
}

/// The id of an entry of one table.
pub trait Id: Into<AnyId> + Copy {
    /// The table.
    const TABLE: Table;

    /// The id as one of this table.
    fn from_any(any: AnyId) -> Self;
}

tables! {
    /// A material.
    MaterialId: Materials = "materials", "material";
    /// A cross section.
    SectionId: Sections = "sections", "section";
    /// A flexible beam.
    BeamId: Beams = "beams", "beam";
    /// A rigid body.
    BodyId: Bodies = "bodies", "body";
    /// A point mass.
    PointMassId: PointMasses = "point_masses", "point mass";
    /// A superelement.
    SuperelementId: Superelements = "superelements", "superelement";
    /// A joint.
    JointId: Joints = "joints", "joint";
    /// A spring.
    SpringId: Springs = "springs", "spring";
    /// A load.
    LoadId: Loads = "loads", "load";
    /// A number that is set from outside.
    InputId: Inputs = "inputs", "input";
    /// A named expression.
    SignalId: Signals = "signals", "signal";
    /// A first-order state.
    StateId: States = "states", "state";
    /// An event.
    EventId: Events = "events", "event";
    /// How all parts are and move at the start.
    InitialId: Initial = "initial", "start";
    /// A motion of some parts at the start.
    MotionId: Motions = "initial", "motion at the start";
    /// A recorded quantity.
    OutputId: Outputs = "outputs", "output";
    /// What is computed.
    AnalysisId: Analysis = "analysis", "analysis";
}

/// The names behind the ids of one builder.
#[derive(Clone, Debug)]
pub(crate) struct IdNames {
    builder: u64,
    names: BTreeMap<Table, Vec<String>>,
}

impl IdNames {
    pub(crate) fn new() -> Self {
        Self { builder: BUILDERS.fetch_add(1, Ordering::Relaxed), names: BTreeMap::new() }
    }

    /// Keeps a name.
    pub(crate) fn add<I: Id>(&mut self, name: String) -> I {
        let names = self.names.entry(I::TABLE).or_default();
        names.push(name);
        I::from_any(AnyId { builder: self.builder, table: I::TABLE, index: names.len() - 1 })
    }

    /// Whether an entry of any table is called `name`.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.names.values().flatten().any(|known| known == name)
    }

    /// The name that an id represents.
    ///
    /// # Errors
    /// If it is of another builder.
    pub(crate) fn name(&self, id: impl Into<AnyId>) -> Result<&str, ForeignId> {
        let id = id.into();
        let own = (id.builder == self.builder).then(|| self.names.get(&id.table)?.get(id.index)).flatten();
        own.map(String::as_str).ok_or(id.foreign())
    }
}
