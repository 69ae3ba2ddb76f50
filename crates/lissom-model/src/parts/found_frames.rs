//! Frames that have been requested so far.

use std::cell::RefCell;
use std::collections::BTreeMap;

use lissom_motion::Motion;

use crate::text::ScopeId;

/// The request.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Wanted {
    Scope(ScopeId),
    Body(String),
    Point(String),
}

/// How far a frame is known.
#[derive(Clone, Copy)]
pub(super) enum Finding {
    /// It is being found.
    Begun,
    /// It is known; nothing where it could not be read.
    Done(Option<Motion>),
}

/// Frames that are known, or being found.
#[derive(Default)]
pub(crate) struct Frames(pub(super) RefCell<BTreeMap<Wanted, Finding>>);
