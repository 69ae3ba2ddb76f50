//! Visibility of faces by an item buffer: faces are projected onto a grid of points, and for every point the nearest
//! is stored.

/// Points of the grid across a model.
const ACROSS: f64 = 1100.0;

/// A projected face: points to the right, upward and towards the viewer [m].
pub(super) type Laid = Vec<[f64; 3]>;

/// Visibility of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// All of it.
    Wholly,
    /// Some of it.
    Partly,
    /// Nothing.
    Hidden,
}

/// The nearest face at every point of a grid.
pub(super) struct ItemBuffer {
    low: [f64; 2],
    /// Distance between neighbouring points [m].
    spacing: f64,
    columns: usize,
    /// Coordinate of the nearest face towards the viewer [m], and its index.
    nearest: Vec<(f64, u32)>,
}

/// No face.
const NONE: u32 = u32::MAX;

impl ItemBuffer {
    /// Built from the faces of a model of this size [m].
    pub(super) fn of(faces: &[Laid], size: f64) -> Self {
        let points = || faces.iter().flatten();
        let bound = |k: usize, least: f64, pick: fn(f64, f64) -> f64| {
            points().map(|point| point[k]).fold(least, pick)
        };
        let low = [0, 1].map(|k| bound(k, f64::INFINITY, f64::min));
        let high = [0, 1].map(|k| bound(k, f64::NEG_INFINITY, f64::max));
        let widest = (high[0] - low[0]).max(high[1] - low[1]);
        // A part that extends far beyond the nodes makes the grid coarser, not larger. A model that travels far is drawn at one instant.
        let spacing = (size.min(2.0 * widest) / ACROSS).max(widest / (3.0 * ACROSS)).max(f64::MIN_POSITIVE);
        let count =
            |k: usize| if high[k] > low[k] { ((high[k] - low[k]) / spacing).ceil() as usize + 1 } else { 1 };
        let (columns, rows) = (count(0), count(1));
        let mut buffer =
            Self { low, spacing, columns, nearest: vec![(f64::NEG_INFINITY, NONE); columns * rows] };
        for (number, face) in faces.iter().enumerate() {
            let mut found = Vec::new();
            buffer.covered(face, |point, near| found.push((point, near)));
            for (point, near) in found {
                if near > buffer.nearest[point].0 {
                    buffer.nearest[point] = (near, number as u32);
                }
            }
        }
        buffer
    }

    /// Extent for which the grid is made [m].
    pub(super) fn size(&self) -> f64 {
        self.spacing * ACROSS
    }

    /// Visibility of `face`, which is the face of this index or a part of it.
    pub(super) fn seen(&self, face: &Laid, number: usize) -> Seen {
        let (mut all, mut own) = (0_u32, 0_u32);
        self.covered(face, |point, _| {
            all += 1;
            own += u32::from(self.nearest[point].1 == number as u32);
        });
        match own {
            0 => Seen::Hidden,
            own if own == all => Seen::Wholly,
            _ => Seen::Partly,
        }
    }

    /// The visible parts of a line between two positions, by pieces that span two points of the grid.
    pub(super) fn seen_parts(&self, [from, to]: [[f64; 3]; 2]) -> Vec<[[f64; 2]; 2]> {
        let at = |x: f64| -> [f64; 3] { std::array::from_fn(|k| from[k] + x * (to[k] - from[k])) };
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let count = (length / (2.0 * self.spacing)).ceil().clamp(1.0, ACROSS) as usize;
        let mut parts: Vec<[f64; 2]> = Vec::new();
        for k in 0..count {
            let [begin, end] = [k, k + 1].map(|k| k as f64 / count as f64);
            if self.is_seen(at(0.5 * (begin + end))) {
                match parts.last_mut() {
                    Some(last) if last[1] == begin => last[1] = end,
                    _ => parts.push([begin, end]),
                }
            }
        }
        let flat = |x: f64| [at(x)[0], at(x)[1]];
        parts.into_iter().map(|part| part.map(flat)).collect()
    }

    /// Whether a face is visible although it is so narrow that no point of the grid is within it.
    pub(super) fn is_missed(&self, face: &Laid) -> bool {
        let mut is_covered = false;
        self.covered(face, |_, _| is_covered = true);
        let mean = |k: usize| face.iter().map(|point| point[k]).sum::<f64>() / face.len() as f64;
        !is_covered && self.is_seen([mean(0), mean(1), mean(2)])
    }

    /// Whether nothing is nearer than a position at one of the points of the grid around it.
    fn is_seen(&self, [x, y, near]: [f64; 3]) -> bool {
        let cell = [(x, 0), (y, 1)].map(|(x, k)| ((x - self.low[k]) / self.spacing).max(0.0) as usize);
        let around =
            [0, 1, self.columns, self.columns + 1].map(|step| cell[1] * self.columns + cell[0] + step);
        let is_behind = |point: usize| self.nearest.get(point).is_none_or(|own| own.0 <= near + self.spacing);
        around.into_iter().any(is_behind)
    }

    /// The points of the grid within a convex face, and its coordinate towards the viewer there.
    fn covered(&self, face: &Laid, mut visit: impl FnMut(usize, f64)) {
        let Some(plane) = Plane::of(face) else { return };
        let range = |k: usize| {
            let of = |pick: fn(f64, f64) -> f64, least| face.iter().map(|point| point[k]).fold(least, pick);
            let (low, high) = (of(f64::min, f64::INFINITY), of(f64::max, f64::NEG_INFINITY));
            let at = |x: f64| (x - self.low[k]) / self.spacing;
            (at(low).ceil().max(0.0) as usize, at(high).floor())
        };
        let ((left, right), (bottom, top)) = (range(0), range(1));
        if right < 0.0 || top < 0.0 {
            return;
        }
        let rows = self.nearest.len() / self.columns;
        for row in bottom..=(top as usize).min(rows - 1) {
            let y = self.low[1] + row as f64 * self.spacing;
            for column in left..=(right as usize).min(self.columns - 1) {
                let x = self.low[0] + column as f64 * self.spacing;
                let is_inside = (0..face.len()).all(|k| {
                    let ([ax, ay, _], [bx, by, _]) = (face[k], face[(k + 1) % face.len()]);
                    (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0.0
                });
                if is_inside {
                    visit(row * self.columns + column, plane.near(x, y));
                }
            }
        }
    }
}

/// The plane of a face: its coordinate towards the viewer at a position.
struct Plane {
    at: [f64; 3],
    slope: [f64; 2],
}

impl Plane {
    /// By Newell's formula; none if only its edge is visible.
    fn of(face: &Laid) -> Option<Self> {
        let first = face[0];
        let from_first = |k: usize| {
            let point = face[k % face.len()];
            [point[0] - first[0], point[1] - first[1], point[2] - first[2]]
        };
        let mut normal = [0.0; 3];
        for k in 1..face.len() {
            let (a, b) = (from_first(k), from_first(k + 1));
            for i in 0..3 {
                let (j, l) = ((i + 1) % 3, (i + 2) % 3);
                normal[i] += a[j] * b[l] - a[l] * b[j];
            }
        }
        (normal[2] > 0.0).then(|| Self { at: first, slope: [-normal[0] / normal[2], -normal[1] / normal[2]] })
    }

    fn near(&self, x: f64, y: f64) -> f64 {
        self.at[2] + self.slope[0] * (x - self.at[0]) + self.slope[1] * (y - self.at[1])
    }
}

#[cfg(test)]
#[path = "../../../tests/unit/pictures/picture/visible.rs"]
mod tests;
