//! Declaration of the types of entries: required values are arguments of `new`, the others have a method per key.

use super::written::Written;
use crate::ids::Id;

/// Something that can be added to a model. Its kinds are those of the model file.
pub trait Entry {
    /// Its id in code.
    type Id: Id;
    /// Prefix of generated names.
    const WORD: &'static str;

    /// Its value in the model file.
    fn written(self) -> Written;
}

/// Declares the type of an entry of a table.
macro_rules! entry {
    (
        $(#[$meta:meta])*
        $name:ident => $id:ident, $word:literal;
        [$($tag:literal = $form:literal)?]
        $($rest:tt)*
    ) => {
        $crate::builder::entry::fields! {
            $(#[$meta])*
            $name
            [$($tag = $form)?]
            $($rest)*
        }

        impl $crate::builder::entry::Entry for $name {
            type Id = $crate::ids::$id;
            const WORD: &'static str = $word;

            fn written(self) -> $crate::builder::written::Written {
                self.0.into()
            }
        }
    };
}

/// Declares the type of a table that is the value of a key.
macro_rules! nested {
    ($(#[$meta:meta])* $name:ident; $($rest:tt)*) => {
        $crate::builder::entry::fields! {
            $(#[$meta])*
            $name
            []
            $($rest)*
        }

        impl From<$name> for $crate::builder::written::Written {
            fn from(value: $name) -> Self {
                value.0.into()
            }
        }
    };
}

macro_rules! fields {
    (
        $(#[$meta:meta])*
        $name:ident
        [$($tag:literal = $form:literal)?]
        $(#[$new:meta])*
        new($($required:ident: $held:ty = $key:literal),*)
        $($(#[$doc:meta])* $optional:ident: $holds:ty = $own:literal;)*
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        #[must_use]
        pub struct $name(pub(crate) $crate::builder::written::Fields);

        impl $name {
            $(#[$new])*
            #[allow(clippy::new_without_default, reason = "what is empty is rarely meant")]
            pub fn new($($required: impl Into<$held>),*) -> Self {
                #[allow(unused_mut, reason = "some have nothing that must be given")]
                let mut fields = $crate::builder::written::Fields::default();
                $(fields.set($tag, $form.to_owned());)?
                $(fields.set($key, $required.into());)*
                Self(fields)
            }
        }

        $crate::builder::entry::keys! { [$name] $($(#[$doc])* $optional: $holds = $own;)* }
    };
}

/// Declares optional keys, for each of some types.
macro_rules! keys {
    ([$name:ident] $($(#[$doc:meta])* $optional:ident: $holds:ty = $own:literal;)*) => {
        impl $name {
            $(
                $(#[$doc])*
                pub fn $optional(mut self, value: impl Into<$holds>) -> Self {
                    self.0.set($own, value.into());
                    self
                }
            )*
        }
    };
    ([$first:ident, $($name:ident),+] $($keys:tt)*) => {
        $crate::builder::entry::keys! { [$first] $($keys)* }
        $crate::builder::entry::keys! { [$($name),+] $($keys)* }
    };
}

/// Declares a type for the words of a key.
macro_rules! words {
    ($(#[$meta:meta])* $name:ident; $($word:ident = $written:literal;)*) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum $name {
            $(
                #[doc = concat!("`", $written, "`.")]
                $word,
            )*
        }

        impl From<$name> for $crate::builder::written::Written {
            fn from(word: $name) -> Self {
                let written = match word {
                    $($name::$word => $written),*
                };
                Self::Text(written.to_owned())
            }
        }
    };
}

pub(crate) use {entry, fields, keys, nested, words};
