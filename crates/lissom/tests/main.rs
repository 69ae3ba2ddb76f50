//! All tests of the crate that need no process of their own, in one program: it is linked once.

mod assembly;
mod beam_outputs;
mod branch;
mod branches;
mod breakpoints;
mod buckling;
mod built_in_code;
mod cable;
mod campbell;
#[cfg(feature = "command-line")]
mod command_line;
mod contact;
mod contacts;
mod controlled_forces;
mod couplings;
#[cfg(feature = "command-line")]
mod defects;
mod distributed;
mod driven_records;
mod driven_start;
mod events;
mod feedback;
mod force_laws;
mod frames;
mod generalized_coordinates;
mod gradient;
mod joint_space;
mod joints;
mod latches;
mod machines;
mod modes;
mod multiblade;
mod path;
mod path_number;
mod published;
mod redundant;
mod response;
#[cfg(feature = "command-line")]
mod resume;
mod rigid_contacts;
mod rolling_contact;
mod ropes;
mod schemes;
mod session;
mod shaft;
mod shared_system;
mod slider;
mod solver_features;
mod statics;
mod study;
mod superelements;
mod support;
mod threads;
mod units;
mod velocity_constraints;
mod wheelset;
