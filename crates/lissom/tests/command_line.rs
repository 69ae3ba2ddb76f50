//! The program, as scripts see it.
