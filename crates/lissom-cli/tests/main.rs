//! All tests of the program, in one program: it is linked once.

mod command_line;
mod defects;
mod resume;
mod support;
