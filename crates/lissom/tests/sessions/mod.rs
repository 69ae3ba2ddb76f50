//! Sessions and models in memory.

mod built_in_code;
mod in_memory;
mod shared_system;
mod threads;
