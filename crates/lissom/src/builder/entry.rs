//! Declaration of the types of entries: required values are arguments of `new`, the others have a method per key. A row has the name
//! in code, the type, the key and its meaning.

use super::written::Written;
use crate::ids::Id;

/// Something that can be added to a model. Its kinds are those of the model file.
pub trait Entry {
    /// Id of the entry in code.
    type Id: Id;
    /// Prefix of generated names.
    const WORD: &'static str;

    /// Value of the entry in the model file.
    fn written(self) -> Written;
}

/// Declares the types of the entries of a table, and of tables that are values of keys, which have neither ids nor a word.
macro_rules! entries {
    ($($(#[$meta:meta])* $name:ident $(=> $id:ident, $($tag:ident:)? $word:literal)? { $($keys:tt)* })*) => {$(
        $crate::builder::entry::fields! { $(#[$meta])* $name [$($($tag = $word)?)?] $($keys)* }

        impl From<$name> for $crate::builder::written::Written {
            fn from(value: $name) -> Self {
                value.0.into()
            }
        }

        $(impl $crate::builder::entry::Entry for $name {
            type Id = $crate::ids::$id;
            const WORD: &'static str = $word;

            fn written(self) -> $crate::builder::written::Written {
                self.0.into()
            }
        })?
    )*};
}

/// Declares one of them: what must be given is marked by an asterisk.
macro_rules! fields {
    (
        $(#[$meta:meta])*
        $name:ident
        [$($tag:ident = $form:literal)?]
        $(* $required:ident: $held:ty = $key:literal, $words:literal;)*
        $($optional:ident: $holds:ty = $own:literal, $about:literal;)*
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        #[must_use]
        pub struct $name(pub(crate) $crate::builder::written::Fields);

        impl $name {
            /// With what must be given.
            ///
            $(#[doc = concat!("- `", stringify!($required), "`: ", $words)])*
            #[allow(clippy::new_without_default, reason = "what is empty is rarely meant")]
            pub fn new($($required: impl Into<$held>),*) -> Self {
                #[allow(unused_mut, reason = "some have nothing that must be given")]
                let mut fields = $crate::builder::written::Fields::default();
                $(fields.set(stringify!($tag), $form.to_owned());)?
                $(fields.set($key, $required.into());)*
                Self(fields)
            }
        }

        $crate::builder::entry::keys! { [$name] $($optional: $holds = $own, $about;)* }
    };
}

/// Declares optional keys, for each of some types.
macro_rules! keys {
    ([$name:ident] $($optional:ident: $holds:ty = $own:literal, $about:literal;)*) => {
        impl $name {
            $(
                #[doc = $about]
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

/// Declares types for the words of keys.
macro_rules! words {
    ($($name:ident { $($word:ident = $written:literal),* })*) => {$(
        #[doc = concat!("One of"$(, " `", $written, "`")*, ".")]
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
    )*};
}

pub(crate) use {entries, fields, keys, words};
