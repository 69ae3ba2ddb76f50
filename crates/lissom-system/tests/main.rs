//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod blocks;
mod derivatives;
