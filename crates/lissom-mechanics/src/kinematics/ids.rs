//! Indices of nodes, coordinates, held values, signals and measurements, each a type of its own.

use serde::{Deserialize, Serialize};

macro_rules! ids {
    ($($(#[$doc:meta])* $Id:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $Id(usize);

        impl $Id {
            /// Converts a position in the order of addition, counted from 0.
            pub const fn new(index: usize) -> Self {
                Self(index)
            }

            /// Position in the order of addition, counted from 0.
            pub const fn index(self) -> usize {
                self.0
            }

            /// The first `count` ids.
            pub fn first(count: usize) -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator + Clone {
                (0..count).map(Self)
            }

            /// Items with their ids, from the first one.
            pub fn enumerate<T: IntoIterator>(items: T) -> impl Iterator<Item = (Self, T::Item)> {
                items.into_iter().enumerate().map(|(index, item)| (Self(index), item))
            }
        }
    )*};
}

ids! {
    /// Index of a node.
    NodeId
    /// Index of an algebraic coordinate, such as a revolute joint's relative rotation.
    CoordinateId
    /// Index of a held value: an input, or the last sample of a signal.
    DiscreteValueId
    /// Index of a signal.
    SignalId
    /// Index of a measurement.
    MeasurementId
}

/// Lets an id select an item of vectors and slices of types that are stored once for each node, coordinate, and so on.
/// Vectors of other types, such as numbers, are indexed by `id.index()`.
macro_rules! indexed_by {
    ($($Id:ident: $($Item:ty),+;)+) => {$($(
        indexed_by!(@list $Id, $Item, [$Item]);
        indexed_by!(@list $Id, $Item, Vec<$Item>);
    )+)+};
    (@list $Id:ident, $Item:ty, $List:ty) => {
        impl std::ops::Index<$Id> for $List {
            type Output = $Item;

            #[inline(always)]
            fn index(&self, id: $Id) -> &$Item {
                &self[id.index()]
            }
        }

        impl std::ops::IndexMut<$Id> for $List {
            #[inline(always)]
            fn index_mut(&mut self, id: $Id) -> &mut $Item {
                &mut self[id.index()]
            }
        }
    };
}
pub(crate) use indexed_by;
