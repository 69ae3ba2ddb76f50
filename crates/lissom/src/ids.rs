//! Ids of the parts of a model built in code: a table, an index in it, and the builder to which it belongs.

use lissom_core::diagnostics::Diagnose;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// Every builder has a number, so that the ids of another one are detected.
static BUILDERS: AtomicU64 = AtomicU64::new(0);

/// Location of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AnyId {
    builder: u64,
    table: Table,
    index: usize,
}

/// An id that does not belong to the model in which it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.diagnostic())]
pub struct ForeignId(&'static str);

impl ForeignId {
    /// Kind of the entry, such as `body`.
    pub(crate) fn kind(self) -> &'static str {
        self.0
    }
}

impl AnyId {
    /// The error for this id.
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
            /// Name of the table in a model file.
            pub(crate) fn word(self) -> &'static str {
                match self {
                    $(Self::$table => $word),*
                }
            }

            /// Whether it has no named entries.
            pub(crate) fn is_single(self) -> bool {
                matches!(self, Self::Initial | Self::Analysis | Self::Ground)
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
    /// A shell.
    ShellId: Shells = "shells", "shell";
    /// An elastic solid.
    SolidId: Solids = "solids", "solid";
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
    /// A load that depends on the motion of its own points.
    LocalLoadId: LocalLoads = "local_loads", "local load";
    /// A contact.
    ContactId: Contacts = "contacts", "contact";
    /// The shape of the ground.
    GroundId: Ground = "ground", "ground";
    /// A number that can be set while a simulation runs.
    InputId: Inputs = "inputs", "input";
    /// A named expression.
    SignalId: Signals = "signals", "signal";
    /// A first-order state.
    StateId: States = "states", "state";
    /// An event.
    EventId: Events = "events", "event";
    /// A fluid.
    FluidId: Fluids = "fluids", "fluid";
    /// A node or a component of a hydraulic network.
    HydraulicId: Hydraulics = "hydraulics", "hydraulic part";
    /// The initial state of all parts.
    InitialId: Initial = "initial", "start";
    /// The initial motion of some parts.
    MotionId: Motions = "initial", "motion at the start";
    /// A recorded quantity.
    OutputId: Outputs = "outputs", "output";
    /// The analysis.
    AnalysisId: Analysis = "analysis", "analysis";
}

/// Declares types that contain the name of an entry of one of several tables.
macro_rules! names {
    ($($(#[$doc:meta])* $name:ident of $($id:ident)*;)*) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $name(pub(crate) AnyId);

            $(impl From<$id> for $name {
                fn from(id: $id) -> Self {
                    Self(id.0)
                }
            })*
        )*
    };
}

names! {
    /// A body, a point mass, a beam or a superelement.
    Part of BodyId PointMassId BeamId SuperelementId;
    /// A number with a name in a simulation: a signal, an input or a state.
    Quantity of SignalId InputId StateId;
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

    /// Stores a name.
    pub(crate) fn add<I: Id>(&mut self, name: String) -> I {
        let names = self.names.entry(I::TABLE).or_default();
        names.push(name);
        I::from_any(AnyId { builder: self.builder, table: I::TABLE, index: names.len() - 1 })
    }

    /// Whether an entry of any table has the name `name`.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.names.values().flatten().any(|known| known == name)
    }

    /// The name that an id represents.
    ///
    /// # Errors
    /// If it belongs to another builder.
    pub(crate) fn name(&self, id: impl Into<AnyId>) -> Result<&str, ForeignId> {
        let id = id.into();
        let own = (id.builder == self.builder).then(|| self.names.get(&id.table)?.get(id.index)).flatten();
        own.map(String::as_str).ok_or(id.foreign())
    }
}
