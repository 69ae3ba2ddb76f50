//! Expansion of parts: sub-assemblies from files or from the model itself, placed and inserted into the model's tables under
//! names such as `leg2.rod`. The meaning of a name, a parameter or a position depends on its scope.

pub(crate) mod context;
mod expand;
mod found_frames;
mod frames;
mod names;
mod overrides;

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::files::library::Library;
use crate::text::report::{Sources, Span};
use crate::text::{Node, ScopeId, Table};

pub(crate) use expand::expand;
pub(crate) use found_frames::Frames;
pub(crate) use frames::body_axes;
pub(crate) use names::PREVIOUS_SAMPLE;

/// Most parts that a model may be made of: more is a mistake in a count.
const MAX_PARTS: usize = 20_000;

/// Tables whose entries may be placed relative to another part by `in`.
const PLACED_TABLES: [&str; 11] = [
    "points",
    "bodies",
    "point_masses",
    "beams",
    "shells",
    "solids",
    "superelements",
    "joints",
    "springs",
    "loads",
    "local_loads",
];

/// Scope of a text, which determines the meaning of its names, parameters and positions.
#[derive(Clone, Debug)]
pub(crate) struct Scope {
    /// The scope around it; none for the model's.
    pub(crate) parent: Option<ScopeId>,
    /// Prefix of its names in the whole model, such as `leg2.`.
    pub(crate) prefix: String,
    /// Names of the scope around it that are known here.
    pub(crate) outside: Outside,
    /// Parameters of the scope itself, in the order in which they may name each other.
    pub(crate) parameters: Vec<(String, Span, Node)>,
    /// The number of the part among all of its array, from 1, and their count.
    pub(crate) index: Option<(usize, usize)>,
    /// Placements of the part in the enclosing scopes, the innermost first.
    pub(crate) placements: Vec<Placement>,
    /// Position of the request in the text.
    pub(crate) place: Span,
}

/// Names of the scopes around a scope.
#[derive(Clone, Debug)]
pub(crate) enum Outside {
    /// All of them.
    All,
    /// Names that were handed in, under names of the scope's own.
    Handed(Vec<(String, Node)>),
}

/// A turn about the origin of a frame, and then a shift.
#[derive(Clone, Debug, Default)]
pub(crate) struct Placement {
    /// The part to whose frame it is relative; the scope around it where there is none.
    pub(crate) part: Option<Node>,
    /// Position of the origin.
    pub(crate) position: Option<Node>,
    /// Rotation vector.
    pub(crate) rotation: Option<Node>,
}

impl Scope {
    /// The scope of the model itself.
    fn root() -> Self {
        Self {
            parent: None,
            prefix: String::new(),
            outside: Outside::All,
            parameters: Vec::new(),
            index: None,
            placements: Vec::new(),
            place: Span::default(),
        }
    }

    /// A scope in `parent` with all that is known there.
    fn within(parent: ScopeId, prefix: &str, place: Span) -> Self {
        Self { parent: Some(parent), prefix: prefix.to_owned(), place, ..Self::root() }
    }
}

/// A model whose parts are in its tables.
pub(crate) struct Expanded {
    pub(crate) root: Table,
    pub(crate) scopes: Vec<Scope>,
    /// Parts by name, with the scopes of their contents.
    pub(crate) instances: BTreeMap<String, ScopeId>,
    pub(crate) sources: Sources,
    pub(crate) library: Arc<Library>,
}

impl Expanded {
    /// A text without parts.
    pub(crate) fn plain(root: Table, sources: Sources) -> Self {
        Self {
            root,
            scopes: vec![Scope::root()],
            instances: BTreeMap::new(),
            sources,
            library: Arc::default(),
        }
    }
}
