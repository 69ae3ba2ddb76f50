//! Pictures of a mechanism without a browser: one instant, or several beside each other, drawn from the same shapes as the
//! page shows. Faces are shaded; those that others hide are omitted, and those that are partly hidden are cut into small
//! ones and painted from the farthest to the nearest.

mod painter;
mod snapshot;
mod view;
mod visible;

pub use painter::{Seen, painted, shade_of};
pub use snapshot::{Picture, PictureError, instants};
pub use view::{Projection, View};
