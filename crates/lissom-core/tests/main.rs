//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod blocks;
mod derivatives;
mod dynamics;
mod house_rules;
mod mobility;
mod prose;
mod words;
