//! Charts: panels of curves below each other or side by side, with axes, grid and legend.

use crate::axis::{Axis, Scale};
use crate::drawing::{Align, COLOUR_COUNT, Drawing, Shade, palette};
use crate::lettering;

const INK: Shade = [0x33, 0x33, 0x33];
const GRID: Shade = [0xe4, 0xe4, 0xe4];
const BLACK: Shade = [0; 3];

/// Heights of text.
const TITLE: u32 = 16;
/// Smallest height of a title on one line.
const SMALL_TITLE: u32 = 11;
const LABEL: u32 = 13;
const TICK: u32 = 11;
/// Distances from the edges, and between adjacent elements.
const MARGIN: f64 = 12.0;
/// Space for the text below a panel.
const FOOT: f64 = 46.0;
/// Length of the sample of a curve in the legend, and height of its lines.
const SAMPLE: f64 = 24.0;
const LEGEND_LINE: f64 = 17.0;
/// Maximum width of a legend, as a fraction of the drawing.
const LEGEND_SHARE: f64 = 0.4;
/// Margin above and below the curves, as a fraction of their extent.
const ROOM: f64 = 0.04;
/// Radius of marks.
const RADIUS: f64 = 3.6;

/// Marks at the points of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A disc.
    Circle,
    /// A square.
    Square,
    /// A triangle that points upwards.
    Triangle,
    /// A square on its corner.
    Diamond,
}

/// Points joined by lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name of the curve in the legend; none if it is empty.
    pub name: String,
    /// Points of the curve. Those that have no position on the axes are omitted.
    pub points: Vec<(f64, f64)>,
    /// Colour of the curve.
    pub shade: Shade,
    /// Width of the curve; zero for marks without a line.
    pub width: f64,
    /// Whether it is dashed.
    pub is_dashed: bool,
    /// The marks at its points.
    pub mark: Option<Mark>,
    /// Half the size of marks.
    pub radius: f64,
}

impl Curve {
    /// A curve that differs from those of other indices, from zero: by its colour, and after seven by marks.
    pub fn numbered(index: usize) -> Self {
        const MARKS: [Option<Mark>; 5] =
            [None, Some(Mark::Circle), Some(Mark::Square), Some(Mark::Triangle), Some(Mark::Diamond)];
        let mark = MARKS[index / COLOUR_COUNT % MARKS.len()];
        Self { mark, radius: 2.6, ..Self::new(palette(index)) }
    }

    /// A plain curve without name and points.
    pub fn new(shade: Shade) -> Self {
        Self {
            name: String::new(),
            points: Vec::new(),
            shade,
            width: 1.6,
            is_dashed: false,
            mark: None,
            radius: RADIUS,
        }
    }
}

/// Curves with common axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Below the panel.
    pub x: Axis,
    /// To the left of the panel.
    pub y: Axis,
    /// Curves; later ones are drawn above.
    pub curves: Vec<Curve>,
}

/// Panels below each other, or several side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Name, suitable for a file.
    pub name: String,
    /// Title above all panels.
    pub title: String,
    /// Panels.
    pub panels: Vec<Panel>,
    /// Number of panels side by side; the next ones are below.
    pub columns: usize,
    /// Width of the drawing.
    pub width: f64,
    /// Height of each panel, including its labels.
    pub panel_height: f64,
}

/// The area of a panel's curves.
struct Frame<'a> {
    panel: &'a Panel,
    x: [f64; 2],
    y: [f64; 2],
    /// Beginning of its text.
    edge: f64,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Chart {
    /// Panels without a title, of a usual size.
    pub fn new(name: &str, panels: Vec<Panel>) -> Self {
        let panel_height = if panels.len() == 1 { 430.0 } else { 340.0 };
        Self { name: name.to_owned(), title: String::new(), panels, columns: 1, width: 760.0, panel_height }
    }

    /// Panels without any point on the axes are omitted.
    pub fn draw(&self) -> Drawing {
        let frames: Vec<Frame<'_>> = self.panels.iter().filter_map(Frame::of).collect();
        let (title, title_height) = title_lines(&self.title, TITLE, self.width - 2.0 * MARGIN);
        let line = 1.3 * f64::from(title_height);
        let head = match title.len() {
            0 => MARGIN,
            count => 2.0 * MARGIN + f64::from(TITLE) + line * (count - 1) as f64,
        };
        let columns = self.columns.max(1);
        let rows = frames.len().div_ceil(columns);
        let cell = self.width / columns as f64;
        let height = head + self.panel_height * rows as f64;
        let mut drawing = Drawing::new(&self.name, [self.width, height]);
        // Panels have equal widths, so that times are aligned vertically.
        let numbers =
            frames.iter().flat_map(Frame::y_ticks).map(|(_, text)| lettering::width(&text, f64::from(TICK)));
        let left = 2.0 * MARGIN + f64::from(LABEL) + numbers.fold(0.0, f64::max) + 6.0;
        let names =
            frames.iter().flat_map(|frame| &frame.panel.curves).filter(|curve| !curve.name.is_empty());
        let legend = names.map(|curve| lettering::width(&curve.name, f64::from(TICK))).fold(0.0, f64::max);
        let legend = if legend > 0.0 { (legend + SAMPLE + MARGIN).min(LEGEND_SHARE * cell) } else { 0.0 };
        let right = cell - 2.0 * MARGIN - legend;
        for (index, mut frame) in frames.into_iter().enumerate() {
            let (row, column) = (index / columns, index % columns);
            let top = head + self.panel_height * row as f64;
            let foot = if row + 1 < rows { FOOT + MARGIN } else { FOOT };
            frame.edge = cell * column as f64;
            (frame.left, frame.right) = (frame.edge + left, frame.edge + right);
            (frame.top, frame.bottom) = (top, top + self.panel_height - foot);
            frame.draw(&mut drawing);
            frame.legend(&mut drawing, legend);
        }
        let middle = if columns == 1 { 0.5 * (left + right) } else { 0.5 * self.width };
        for (row, words) in title.iter().enumerate() {
            // Centred on the panels, unless it is too long for that.
            let half = 0.5 * lettering::width(words, f64::from(title_height));
            let x = middle.clamp(MARGIN + half, (self.width - MARGIN - half).max(MARGIN + half));
            let y = MARGIN + f64::from(TITLE) + line * row as f64;
            drawing.words([x, y], words, title_height, Align::Middle, BLACK);
        }
        drawing
    }
}

/// Lines of a title and their height: one line if it has this width at a legible height up to `height`, otherwise several, which
/// end between words and within those that are too long.
pub fn title_lines(title: &str, height: u32, width: f64) -> (Vec<String>, u32) {
    let height = fitting(title, height, width);
    if title.is_empty() || height >= SMALL_TITLE {
        return (Some(title.to_owned()).filter(|title| !title.is_empty()).into_iter().collect(), height);
    }
    let fits = |words: &str| lettering::width(words, f64::from(SMALL_TITLE)) <= width;
    let (mut lines, mut line) = (Vec::new(), String::new());
    for word in title.split_whitespace() {
        let longer = format!("{line}{}{word}", if line.is_empty() { "" } else { " " });
        if fits(&longer) {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for character in word.chars() {
            if !line.is_empty() && !fits(&format!("{line}{character}")) {
                lines.push(std::mem::take(&mut line));
            }
            line.push(character);
        }
    }
    lines.push(line);
    (lines, SMALL_TITLE)
}

/// The largest height up to `height` at which the text has this width.
fn fitting(words: &str, height: u32, width: f64) -> u32 {
    (7..=height).rev().find(|height| lettering::width(words, f64::from(*height)) <= width).unwrap_or(7)
}

impl<'a> Frame<'a> {
    /// Before its position on the drawing is known; none if no point is on the axes.
    fn of(panel: &'a Panel) -> Option<Self> {
        let points =
            || panel.curves.iter().flat_map(|curve| &curve.points).filter(|point| panel.shows(point));
        points().next()?;
        let [x, y] = [
            panel.x.extent(points().map(|point| point.0), ROOM),
            panel.y.extent(points().map(|point| point.1), ROOM),
        ];
        Some(Frame { panel, x, y, edge: 0.0, left: 0.0, right: 0.0, top: 0.0, bottom: 0.0 })
    }

    fn y_ticks(&self) -> Vec<(f64, String)> {
        self.panel.y.ticks(self.y, 7)
    }

    fn place(&self, (x, y): (f64, f64)) -> [f64; 2] {
        let share = [self.panel.x.share(self.x, x), self.panel.y.share(self.y, y)];
        // Beyond the range curves follow its edge.
        let [x, y] = share.map(|share| share.clamp(0.0, 1.0));
        [self.left + x * (self.right - self.left), self.bottom - y * (self.bottom - self.top)]
    }

    fn draw(&self, drawing: &mut Drawing) {
        let Panel { x, y, curves } = self.panel;
        let middle = [0.5 * (self.left + self.right), 0.5 * (self.top + self.bottom)];
        let tick = f64::from(TICK);
        // One number for this many pixels.
        let most: f64 = if x.scale == Scale::Linear { 8.0 } else { 9.0 };
        let widest = most.min((self.right - self.left) / 60.0).max(2.0) as usize;
        for (number, text) in x.ticks(self.x, widest) {
            let [at, _] = self.place((number, self.y[0]));
            drawing.line(vec![[at, self.bottom + 4.0], [at, self.top]], GRID, 1.0);
            drawing.line(vec![[at, self.bottom], [at, self.bottom + 4.0]], INK, 1.0);
            drawing.words([at, self.bottom + 6.0 + tick], &text, TICK, Align::Middle, INK);
        }
        for (number, text) in self.y_ticks() {
            let [_, at] = self.place((self.x[0], number));
            drawing.line(vec![[self.left, at], [self.right, at]], GRID, 1.0);
            drawing.line(vec![[self.left - 4.0, at], [self.left, at]], INK, 1.0);
            drawing.words([self.left - 6.0, at + 0.36 * tick], &text, TICK, Align::End, INK);
        }
        for curve in curves {
            self.curve(drawing, curve);
        }
        let corners = [[self.left, self.top], [self.left, self.bottom], [self.right, self.bottom]];
        drawing.line(corners.to_vec(), INK, 1.0);
        let height = fitting(&x.label, LABEL, self.right - self.left);
        drawing.words([middle[0], self.bottom + 2.0 * tick + 16.0], &x.label, height, Align::Middle, BLACK);
        let height = fitting(&y.label, LABEL, self.bottom - self.top);
        drawing.upright_words(
            [self.edge + MARGIN + f64::from(LABEL), middle[1]],
            &y.label,
            height,
            Align::Middle,
            BLACK,
        );
    }

    fn curve(&self, drawing: &mut Drawing, curve: &Curve) {
        // A gap is left if points have no position.
        for piece in curve.points.split(|point| !self.panel.shows(point)) {
            let places: Vec<[f64; 2]> = piece.iter().map(|point| self.place(*point)).collect();
            for place in curve.mark.map(|_| &places).into_iter().flatten() {
                mark(drawing, *place, curve);
            }
            if let [place] = places[..] {
                // A line through a single point would be invisible.
                mark(drawing, place, &Curve { mark: curve.mark.or(Some(Mark::Circle)), ..curve.clone() });
            } else if !places.is_empty() && curve.width > 0.0 {
                line(drawing, places, curve);
            }
        }
    }

    fn legend(&self, drawing: &mut Drawing, width: f64) {
        let named: Vec<&Curve> = self.panel.curves.iter().filter(|curve| !curve.name.is_empty()).collect();
        let lines = (((self.bottom - self.top) / LEGEND_LINE) as usize).max(1);
        let left = self.right + MARGIN;
        // The last line contains the number of the others.
        let shown = if named.len() > lines { lines - 1 } else { named.len() };
        for (index, curve) in named[..shown].iter().enumerate() {
            let y = self.top + LEGEND_LINE * (index as f64 + 0.5);
            if curve.width > 0.0 {
                line(drawing, vec![[left, y], [left + SAMPLE, y]], curve);
            }
            if curve.mark.is_some() {
                mark(drawing, [left + 0.5 * SAMPLE, y], curve);
            }
            let height = fitting(&curve.name, TICK, width - SAMPLE - MARGIN);
            drawing.words([left + SAMPLE + 6.0, y + 4.0], &curve.name, height, Align::Start, INK);
        }
        if shown < named.len() {
            let y = self.top + LEGEND_LINE * (shown as f64 + 0.5);
            let words = format!("and {} more", named.len() - shown);
            drawing.words([left, y + 4.0], &words, TICK, Align::Start, INK);
        }
    }
}

impl Panel {
    fn shows(&self, point: &(f64, f64)) -> bool {
        self.x.shows(point.0) && self.y.shows(point.1)
    }
}

fn line(drawing: &mut Drawing, places: Vec<[f64; 2]>, curve: &Curve) {
    if curve.is_dashed {
        drawing.dashed_line(places, curve.shade, curve.width);
    } else {
        drawing.line(places, curve.shade, curve.width);
    }
}

fn mark(drawing: &mut Drawing, [x, y]: [f64; 2], curve: &Curve) {
    let radius = curve.radius;
    let (corners, turn, radius) = match curve.mark {
        None => return,
        Some(Mark::Circle) => return drawing.disc([x, y], radius, curve.shade),
        Some(Mark::Square) => (4, 0.5, 1.2 * radius),
        Some(Mark::Triangle) => (3, 0.25, 1.2 * radius),
        Some(Mark::Diamond) => (4, 0.0, 1.3 * radius),
    };
    let corner = |index: u32| {
        let angle = std::f64::consts::TAU * (f64::from(index) + turn) / f64::from(corners);
        // The first corner of a triangle points upwards.
        let angle = if corners == 3 { angle + std::f64::consts::PI } else { angle };
        [x + radius * angle.cos(), y + radius * angle.sin()]
    };
    drawing.polygon((0..corners).map(corner).collect(), curve.shade);
}

#[cfg(test)]
#[path = "../tests/unit/chart.rs"]
mod tests;
