//! The sheet of a picture: panels at several instants, their times, the axes and a scale.

use std::ops::Range;

use lissom_core::diagnostics::Diagnose;
use lissom_model::output::{Align, Drawing, DrawingError, Format, Shade, animation, title_lines};
use lissom_model::scene::Scene;
use lissom_motion::{Motion as Pose, Vector3};

use super::depth_image::depth_image;
use super::field::Field;
use super::forces::RecordedForces;
use super::legend::legend;
use super::paint::Paint;
use super::painter::{Seen, painted};
use super::view::{Projection, View};
use crate::motion::Motion;
use crate::pictures::geometry::{Geometry, poses_at};
use lissom_core::kinematics::GROUND;

const WORDS: Shade = [0x1d, 0x24, 0x30];
const FAINT: Shade = [0x6b, 0x76, 0x86];
const TRACE: Shade = [0xd5, 0x5e, 0x00];
const FORCE: Shade = [0xd1, 0x49, 0x5b];
/// Length of the arrow of the largest force, relative to the model, and of heads [pixels].
const ARROW: f64 = 0.22;
const HEAD: f64 = 13.0;
/// The global axes.
const AXES: [(&str, Shade); 3] =
    [("x", [0xd1, 0x49, 0x5b]), ("y", [0x2f, 0x9e, 0x63]), ("z", [0x3b, 0x74, 0xd9])];
/// Margin around the drawing, and below it for text.
const MARGIN: f64 = 14.0;
const TITLE: u32 = 17;
const LINE: f64 = 22.0;
const FOOT: f64 = 64.0;
/// Maximum width and height of the area of panels.
const MAX_EXTENT: [f64; 2] = [1200.0, 900.0];
/// Maximum width and height of the area of panels of an animation.
const MAX_MOVING: [f64; 2] = [640.0, 480.0];
/// Maximum number of panels.
const MAX_PANELS: usize = 100;
/// Maximum number of frames of an animation.
const MAX_FRAMES: usize = 600;

/// Why a picture cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum PictureError {
    /// An instant is outside the motion.
    Outside {
        /// The instant [s].
        time: f64,
        /// The first recorded one [s].
        first: f64,
        /// The last recorded one [s].
        last: f64,
    },
    /// The motion has no frames.
    Empty,
    /// There are none, or too many for a sheet or an animation.
    TooMany {
        /// Their number.
        count: usize,
        /// The maximum number.
        most: usize,
    },
    /// The drawing failed.
    Drawing(#[from] DrawingError),
}

/// Contents of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Instants, one for each panel [s].
    pub times: Vec<f64>,
    /// Direction of view.
    pub view: View,
    /// Whether the paths of observed points are drawn.
    pub paths: bool,
    /// Forces to be drawn as arrows.
    pub forces: RecordedForces,
    /// Captions of the panels, in their order; by default their instants.
    pub labels: Vec<String>,
    /// The field by which shells are coloured; none for the colours of parts.
    pub field: Option<Field>,
}

/// This number of instants at equal distances over a motion, including its ends; the last if it is one.
///
/// # Errors
/// If there is no motion, or there are too many for a sheet.
pub fn instants(motion: &Motion, count: usize) -> Result<Vec<f64>, PictureError> {
    let (Some(first), Some(last)) = (motion.times().first(), motion.times().last()) else {
        return Err(PictureError::Empty);
    };
    if count > MAX_FRAMES {
        return Err(PictureError::TooMany { count, most: MAX_FRAMES });
    }
    let at = |k: usize| {
        if count < 2 || k + 1 == count {
            *last
        } else {
            first + (last - first) * k as f64 / (count - 1) as f64
        }
    };
    Ok((0..count).map(at).collect())
}

/// A rectangle that grows [m].
#[derive(Clone, Copy)]
struct Frame {
    low: [f64; 2],
    high: [f64; 2],
}

impl Frame {
    fn take(&mut self, point: &[f64; 2]) {
        for k in 0..2 {
            self.low[k] = self.low[k].min(point[k]);
            self.high[k] = self.high[k].max(point[k]);
        }
    }

    fn extent(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.high[k] - self.low[k]).max(1e-12))
    }
}

/// The projections at all instants.
struct Panels {
    geometry: Geometry,
    paint: Paint,
    /// Poses of the nodes, by panel.
    poses: Vec<Vec<Pose>>,
    seen: Vec<Vec<Seen>>,
    paths: Vec<Vec<[f64; 2]>>,
    /// Begin and end of each arrow, by panel.
    arrows: Vec<Vec<[[f64; 2]; 2]>>,
    /// Length of the arrow of the largest force [m].
    longest: f64,
    projection: Projection,
    /// Their common bounds.
    frame: Frame,
}

impl Picture {
    /// Draws a model with this motion, with the instants side by side.
    ///
    /// # Errors
    /// If an instant is outside the motion, or there are none or too many.
    pub fn draw(&self, scene: &Scene, motion: &Motion, title: &str) -> Result<Drawing, PictureError> {
        let panels = self.panels(scene, motion, Some(MAX_PANELS))?;
        let count = panels.seen.len();
        let sheet = Sheet::of(panels.frame, count, MAX_EXTENT);
        Ok(sheet.drawn(
            &panels,
            0..count,
            (title, &self.labels(scene)),
            &self.scale_of_forces(panels.longest),
        ))
    }

    /// The bytes of a moving picture of a model with this motion, each instant shown for `delay` [s].
    ///
    /// # Errors
    /// If an instant is outside the motion, or there are none or too many.
    pub fn moving(
        &self,
        (scene, motion, title): (&Scene, &Motion, &str),
        (format, delay): (Format, f64),
    ) -> Result<Vec<u8>, PictureError> {
        let panels = self.panels(scene, motion, None)?;
        let sheet = Sheet::of(panels.frame, 1, MAX_MOVING);
        let labels = self.labels(scene);
        let note = self.scale_of_forces(panels.longest);
        let frame = |k: usize| {
            let drawing = sheet.drawn(&panels, k..k + 1, (title, &labels[k..=k]), &note);
            let size = drawing.size.map(|side| side.ceil() as u32);
            let model = (&panels.geometry, &panels.paint, &panels.projection);
            let now = (panels.poses[k].as_slice(), self.times[k]);
            Ok((depth_image(model, now, size, sheet.place(0, title)), drawing))
        };
        animation((format, delay), panels.poses.len(), frame)
    }

    /// The scale of arrows; empty without forces.
    fn scale_of_forces(&self, longest: f64) -> String {
        let most = self.forces.most();
        if most > 0.0 {
            format!("forces: {} N per m of arrow, at most {} N", short(most / longest), short(most))
        } else {
            String::new()
        }
    }

    /// Captions of the panels.
    fn labels(&self, scene: &Scene) -> Vec<String> {
        let of_time = |time: f64| match &scene.path {
            Some(path) => format!("{} {}", path.name, short(path.at(time))),
            None if scene.is_static => format!("load {}", short(time)),
            None => format!("t = {} s", short(time)),
        };
        let label =
            |(index, time): (usize, &f64)| self.labels.get(index).cloned().unwrap_or_else(|| of_time(*time));
        self.times.iter().enumerate().map(label).collect()
    }

    /// With at most this number of panels; without a number, those of a moving picture, whose faces are not yet painted.
    fn panels(&self, scene: &Scene, motion: &Motion, most: Option<usize>) -> Result<Panels, PictureError> {
        let (Some(&first), Some(&last)) = (motion.times().first(), motion.times().last()) else {
            return Err(PictureError::Empty);
        };
        let (is_moving, most) = (most.is_none(), most.unwrap_or(MAX_FRAMES));
        if self.times.is_empty() || self.times.len() > most {
            return Err(PictureError::TooMany { count: self.times.len(), most });
        }
        let geometry = Geometry::new(scene, motion, true);
        let projection = Projection::of(&geometry, self.view);
        let (mut all, mut panels) = (Vec::new(), Vec::new());
        let (mut arrows, longest) = (Vec::new(), ARROW * geometry.size);
        let mut frame = Frame { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        for &time in &self.times {
            all.push(poses_at(motion, time).ok_or(PictureError::Outside { time, first, last })?);
        }
        let paint = Paint::new(self.field, scene, &all);
        for (&time, poses) in self.times.iter().zip(&all) {
            let seen = if is_moving {
                for mesh in geometry.pieces.iter().filter_map(|piece| piece.at(poses, time)) {
                    mesh.points.iter().for_each(|point| frame.take(&projection.flat(point)));
                }
                Vec::new()
            } else {
                painted((&geometry, &paint), &projection, poses, time)
            };
            seen.iter().flat_map(|face| &face.points).for_each(|point| frame.take(point));
            panels.push(seen);
            let arrow = |(at, force): (Vector3, Vector3)| {
                let end = at + force * (longest / self.forces.most());
                [at, end].map(|point| projection.flat(&point))
            };
            let drawn: Vec<_> = self.forces.at(poses, time).into_iter().map(arrow).collect();
            drawn.iter().flatten().for_each(|point| frame.take(point));
            arrows.push(drawn);
        }
        let paths = if self.paths { paths(scene, motion, &projection) } else { Vec::new() };
        paths.iter().flatten().for_each(|point| frame.take(point));
        Ok(Panels { geometry, paint, poses: all, seen: panels, paths, arrows, longest, projection, frame })
    }
}

/// Projected paths of the observed points [m].
fn paths(scene: &Scene, motion: &Motion, projection: &Projection) -> Vec<Vec<[f64; 2]>> {
    let points = scene.outputs.iter().filter_map(|output| output.point).filter(|point| point.node != GROUND);
    let path = |anchor: lissom_model::scene::Anchor| {
        let at = |frame| motion.pose(frame, anchor.node).transform_point(&Vector3::from(anchor.position));
        (0..motion.times().len()).map(|frame| projection.flat(&at(frame))).collect()
    };
    let mut anchors: Vec<lissom_model::scene::Anchor> = Vec::new();
    for anchor in points {
        if !anchors.contains(&anchor) {
            anchors.push(anchor);
        }
    }
    anchors.into_iter().map(path).collect()
}

/// Arrangement of panels on a sheet.
struct Sheet {
    frame: Frame,
    columns: usize,
    rows: usize,
    /// Pixels per metre.
    scale: f64,
}

impl Sheet {
    /// The number of columns with the largest panels on a sheet of at most this width and height.
    fn of(frame: Frame, count: usize, most: [f64; 2]) -> Self {
        let [width, height] = frame.extent();
        let of_columns = |columns: usize| {
            let rows = count.div_ceil(columns);
            let across = (most[0] / columns as f64 - 2.0 * MARGIN) / width;
            let down = (most[1] / rows as f64 - 2.0 * MARGIN - LINE) / height;
            Self { frame, columns, rows, scale: across.min(down).max(1e-300) }
        };
        let better = |best: Self, other: Self| if other.scale > best.scale { other } else { best };
        (2..=count).map(of_columns).fold(of_columns(1), better)
    }

    /// Width and height of a panel with its margin.
    fn panel(&self) -> [f64; 2] {
        self.frame.extent().map(|extent| extent * self.scale + 2.0 * MARGIN)
    }

    fn width(&self) -> f64 {
        (self.columns as f64 * self.panel()[0]).max(240.0)
    }

    /// Pixels of projected positions in the panel of this index.
    fn place(&self, index: usize, title: &str) -> impl Fn(&[f64; 2]) -> [f64; 2] + Copy + use<> {
        let [width, height] = self.panel();
        let left = 0.5 * (self.width() - self.columns as f64 * width);
        let x = left + (index % self.columns) as f64 * width + MARGIN;
        let y = self.head(title) + (index / self.columns) as f64 * (height + LINE) + MARGIN;
        let (low, high, scale) = (self.frame.low[0], self.frame.high[1], self.scale);
        move |point| [x + (point[0] - low) * scale, y + (high - point[1]) * scale]
    }

    /// Lines of the title and their height.
    fn title(&self, title: &str) -> (Vec<String>, u32) {
        title_lines(title, TITLE, self.width() - 2.0 * MARGIN)
    }

    /// Height of the area of the title.
    fn head(&self, title: &str) -> f64 {
        let lines = self.title(title).0.len();
        if lines == 0 { 0.0 } else { (lines + 1) as f64 * LINE }
    }

    fn drawn(
        &self,
        panels: &Panels,
        shown: Range<usize>,
        (title, labels): (&str, &[String]),
        note: &str,
    ) -> Drawing {
        let [_, height] = self.panel();
        let size = [self.width(), self.head(title) + self.rows as f64 * (height + LINE) + FOOT];
        let mut drawing = Drawing::new("snapshot", size);
        let (lines, height) = self.title(title);
        for (row, words) in lines.iter().enumerate() {
            let y = (1.3 + row as f64) * LINE;
            drawing.words([0.5 * size[0], y], words, height, Align::Middle, WORDS);
        }
        let all = panels.seen[shown.clone()].iter().zip(&panels.arrows[shown]);
        for (index, ((faces, arrows), words)) in all.zip(labels).enumerate() {
            let place = self.place(index, title);
            for path in &panels.paths {
                drawing.line(path.iter().map(place).collect(), TRACE, 1.0);
            }
            for face in faces {
                let points = face.points.iter().map(place).collect();
                match face.width {
                    Some(width) => drawing.line(points, face.shade, width),
                    None => drawing.polygon(points, face.shade),
                }
            }
            for [from, to] in arrows {
                arrow(&mut drawing, place(from), place(to));
            }
            let [low, high] = [self.frame.low, self.frame.high];
            let [x, y] = place(&[0.5 * (low[0] + high[0]), low[1]]);
            let middle = [x, y + MARGIN + 0.6 * LINE];
            drawing.words(middle, words, 13, Align::Middle, FAINT);
        }
        let foot = size[1] - 0.45 * FOOT;
        axes(&mut drawing, &panels.projection, [34.0, foot]);
        if let Some(scale) = panels.paint.scale() {
            legend(&mut drawing, scale, [0.5 * size[0], foot - 8.0]);
        }
        if !note.is_empty() {
            drawing.words([0.5 * size[0], foot + 22.0], note, 11, Align::Middle, FAINT);
        }
        self.ruler(&mut drawing, [size[0] - 20.0, foot + 12.0]);
        drawing
    }

    /// A scale that ends at a position.
    fn ruler(&self, drawing: &mut Drawing, [x, y]: [f64; 2]) {
        let longest = 120.0 / self.scale;
        let power = 10_f64.powf(longest.log10().floor());
        let length = [5.0, 2.0, 1.0].map(|k| k * power).into_iter().find(|length| *length <= longest);
        let length = length.unwrap_or(power);
        let start = x - length * self.scale;
        drawing.line(vec![[start, y - 4.0], [start, y], [x, y], [x, y - 4.0]], FAINT, 1.2);
        let words =
            if length < 1.0 { format!("{} mm", short(1e3 * length)) } else { format!("{} m", short(length)) };
        drawing.words([0.5 * (start + x), y - 6.0], &words, 12, Align::Middle, FAINT);
    }
}

/// An arrow of a force.
fn arrow(drawing: &mut Drawing, [x, y]: [f64; 2], end: [f64; 2]) {
    let along = [end[0] - x, end[1] - y];
    let length = along[0].hypot(along[1]);
    if length < 1.0 {
        return;
    }
    let [a, b] = along.map(|part| part / length);
    let head = HEAD.min(0.6 * length);
    let neck = [end[0] - head * a, end[1] - head * b];
    let half = 0.36 * head;
    drawing.line(vec![[x, y], neck], FORCE, 2.4);
    let sides = [[neck[0] - half * b, neck[1] + half * a], [neck[0] + half * b, neck[1] - half * a]];
    drawing.polygon(vec![end, sides[0], sides[1]], FORCE);
}

/// The global axes at a position; the farthest first.
fn axes(drawing: &mut Drawing, projection: &Projection, [x, y]: [f64; 2]) {
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| {
        let near = |k: &usize| projection.near(&Vector3::ith(*k, 1.0));
        near(a).total_cmp(&near(b))
    });
    for k in order {
        let (name, shade) = AXES[k];
        let [right, above] = projection.flat(&Vector3::ith(k, 1.0));
        if right.hypot(above) < 0.1 {
            continue;
        }
        drawing.line(vec![[x, y], [x + 20.0 * right, y - 20.0 * above]], shade, 2.0);
        drawing.words([x + 28.0 * right, y - 28.0 * above + 4.0], name, 12, Align::Middle, shade);
    }
}

/// A number in few digits.
pub(super) fn short(number: f64) -> String {
    let rounded = format!("{number:.3e}").parse::<f64>().unwrap_or(number);
    format!("{}", if rounded.abs() < 1e-12 { 0.0 } else { rounded })
}

#[cfg(test)]
#[path = "../../../tests/unit/pictures/picture/snapshot.rs"]
mod tests;
