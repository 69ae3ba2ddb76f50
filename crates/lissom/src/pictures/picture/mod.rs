//! Pictures of a mechanism without a browser: one instant, or several side by side, drawn from the same shapes as on the
//! page. Faces are shaded; hidden ones are omitted, and partly hidden ones are divided into small faces and painted from
//! the farthest to the nearest. Moving pictures, and those of a running simulation, are drawn by a depth buffer.

mod camera;
mod depth_image;
mod field;
mod forces;
mod legend;
mod lines;
mod paint;
mod painter;
mod snapshot;
mod view;
mod visible;

pub use camera::{Camera, Framing};
pub use field::Field;
pub use forces::RecordedForces;
pub use paint::Paint;
pub use painter::{Seen, painted, shade_of};
pub use snapshot::{Picture, PictureError, instants};
pub use view::{Projection, View};
