//! Turbulent wind in the binary full-field files of TurbSim (`.bts`): velocities at the points of a plane across the wind, over time, as
//! integers of 16 bits [Jonkman and Buhl, TurbSim User's Guide, NREL/TP-500-39797].

/// Bytes of the header before the description.
const HEADER: usize = 70;
/// A file whose first and last instants follow each other.
const PERIODIC: i16 = 8;
/// Another file.
const SINGLE: i16 = 7;
/// Components of the velocity.
const COMPONENTS: usize = 3;

/// A file that contains no wind.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum WindError {
    /// The first number is not that of the format.
    #[error("the file begins with {0}, not with 7 or 8 as a full-field file of TurbSim")]
    Format(i16),
    /// It ends within the header.
    #[error("the file ends within its header")]
    Header,
    /// A size is not positive, or too small for interpolation.
    #[error("the header has {0}")]
    Size(&'static str),
    /// The length differs from that of the header.
    #[error("the file has {found} bytes, but its header requires {}", required.map_or_else(|| "more than a file can have".to_owned(), |count| count.to_string()))]
    Length {
        /// Length of the file.
        found: usize,
        /// Length by the header, if it can be represented.
        required: Option<usize>,
    },
}

/// Velocities over y, z and time. y is 0 in the middle of the plane, and time begins with the first plane.
#[derive(Clone, Debug, PartialEq)]
pub struct WindBox {
    bytes: Vec<u8>,
    /// Position of the first velocity in the file.
    first: usize,
    /// Points along y, along z, and instants.
    counts: [usize; 3],
    /// Points of the tower below the plane, which follow each plane.
    tower: usize,
    start: [f64; 3],
    step: [f64; 3],
    slope: [f64; COMPONENTS],
    offset: [f64; COMPONENTS],
    is_periodic: bool,
}

/// Little-endian numbers of a header.
struct Header<'b>(&'b [u8]);

impl Header<'_> {
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], WindError> {
        let (first, rest) = self.0.split_first_chunk().ok_or(WindError::Header)?;
        self.0 = rest;
        Ok(*first)
    }

    fn count(&mut self, words: &'static str, least: usize) -> Result<usize, WindError> {
        let count = usize::try_from(i32::from_le_bytes(self.bytes()?)).ok();
        count.filter(|&count| count >= least).ok_or(WindError::Size(words))
    }

    fn real(&mut self, words: &'static str, is_right: impl Fn(f64) -> bool) -> Result<f64, WindError> {
        let real = f64::from(f32::from_le_bytes(self.bytes()?));
        (real.is_finite() && is_right(real)).then_some(real).ok_or(WindError::Size(words))
    }
}

impl WindBox {
    /// The wind of a file. Nothing is allocated by the counts of the header.
    pub(crate) fn of_file(bytes: Vec<u8>) -> Result<Self, WindError> {
        let mut header = Header(&bytes);
        let format = i16::from_le_bytes(header.bytes()?);
        if ![SINGLE, PERIODIC].contains(&format) {
            return Err(WindError::Format(format));
        }
        let along_z = header.count("fewer than two points along z", 2)?;
        let along_y = header.count("fewer than two points along y", 2)?;
        let tower = header.count("a negative number of points of the tower", 0)?;
        let instants = header.count("fewer than two instants", 2)?;
        let [dz, dy, dt] =
            ["z", "y", "time"].map(|_| header.real("a distance that is not positive", |x| x > 0.0));
        let (dz, dy, dt) = (dz?, dy?, dt?);
        header.real("a mean velocity that is no number", |_| true)?;
        header.real("a height of the hub that is no number", |_| true)?;
        let bottom = header.real("a height of the lowest points that is no number", |_| true)?;
        let (mut slope, mut offset) = ([0.0; COMPONENTS], [0.0; COMPONENTS]);
        for k in 0..COMPONENTS {
            slope[k] = header.real("a scale that is zero or no number", |x| x != 0.0)?;
            offset[k] = header.real("an offset that is no number", |_| true)?;
        }
        let description = header.count("a negative length of the description", 0)?;
        let first = HEADER.checked_add(description);
        let points = along_y.checked_mul(along_z).and_then(|plane| plane.checked_add(tower));
        let data = points.and_then(|points| points.checked_mul(2 * COMPONENTS)?.checked_mul(instants));
        let required = first.zip(data).and_then(|(first, data)| first.checked_add(data));
        if required != Some(bytes.len()) {
            return Err(WindError::Length { found: bytes.len(), required });
        }
        #[expect(clippy::cast_precision_loss, reason = "the counts fit the file")]
        let half = 0.5 * dy * (along_y - 1) as f64;
        Ok(Self {
            first: first.unwrap_or_default(),
            counts: [along_y, along_z, instants],
            tower,
            start: [-half, bottom, 0.0],
            step: [dy, dz, dt],
            slope,
            offset,
            is_periodic: format == PERIODIC,
            bytes,
        })
    }

    /// Where it has values, in words.
    pub(crate) fn extent(&self) -> String {
        let ends = [0, 1, 2].map(|k| (self.start[k], self.start[k] + self.span(k)));
        let [y, z, t] = ends.map(|(from, to)| format!("{from} to {to}"));
        let time = if self.is_periodic { "every time".to_owned() } else { format!("t = {t} s") };
        format!("y = {y} m, z = {z} m and {time}")
    }

    #[expect(clippy::cast_precision_loss, reason = "the counts fit the file")]
    fn span(&self, axis: usize) -> f64 {
        self.step[axis] * (self.counts[axis] - 1) as f64
    }

    /// Velocity at a point and an instant, by their indices along y, z and time [m/s].
    fn at(&self, component: usize, [y, z, instant]: [usize; 3]) -> f64 {
        let plane = self.counts[0] * self.counts[1] + self.tower;
        let index = COMPONENTS * (instant * plane + z * self.counts[0] + y) + component;
        let position = self.first + 2 * index;
        let stored = i16::from_le_bytes([self.bytes[position], self.bytes[position + 1]]);
        (f64::from(stored) - self.offset[component]) / self.slope[component]
    }

    /// Component of the velocity [m/s] at y, z and time, and its derivatives by them; NaN where there is no wind. In each of the three it is a
    /// cubic through the values with the slopes of their neighbours' chords, so that derivatives are continuous and steps need not end at
    /// the points.
    pub(crate) fn evaluate(&self, component: usize, place: [f64; 3]) -> [f64; 4] {
        let mut axes = [Span::default(); 3];
        for (k, axis) in axes.iter_mut().enumerate() {
            let (count, wraps) = (self.counts[k], k == 2 && self.is_periodic);
            let last = count - 1;
            #[expect(clippy::cast_precision_loss, reason = "the counts fit the file")]
            let (end, period) = (last as f64, count as f64);
            let steps = (place[k] - self.start[k]) / self.step[k];
            let steps = if wraps { steps.rem_euclid(period) } else { steps };
            if !((wraps && steps.is_finite()) || (0.0..=end).contains(&steps)) {
                return [f64::NAN; 4];
            }
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between 0 and the count"
            )]
            let cell = if wraps { (steps as usize).min(last) } else { (steps as usize).min(last - 1) };
            #[expect(clippy::cast_precision_loss, reason = "the counts fit the file")]
            let start = cell as f64;
            let Span { points, weights, slopes } = axis;
            (*weights, *slopes) = cubic(steps - start);
            if wraps {
                *points = [(cell + last) % count, cell, (cell + 1) % count, (cell + 2) % count];
            } else {
                *points = [cell.saturating_sub(1), cell, cell + 1, (cell + 2).min(last)];
                for of in [&mut *weights, &mut *slopes] {
                    // Straight beyond the ends.
                    if cell == 0 {
                        *of = [0.0, of[1] + 2.0 * of[0], of[2] - of[0], of[3]];
                    }
                    if cell + 2 > last {
                        *of = [of[0], of[1] - of[3], of[2] + 2.0 * of[3], 0.0];
                    }
                }
            }
            for slope in slopes.iter_mut() {
                *slope /= self.step[k];
            }
        }
        let [across, upwards, over] = &axes;
        let mut found = [0.0; 4];
        for k in 0..4 {
            for j in 0..4 {
                let (mut value, mut slope) = (0.0, 0.0);
                for i in 0..4 {
                    let own = self.at(component, [across.points[i], upwards.points[j], over.points[k]]);
                    value += across.weights[i] * own;
                    slope += across.slopes[i] * own;
                }
                found[0] += over.weights[k] * upwards.weights[j] * value;
                found[1] += over.weights[k] * upwards.weights[j] * slope;
                found[2] += over.weights[k] * upwards.slopes[j] * value;
                found[3] += over.slopes[k] * upwards.weights[j] * value;
            }
        }
        found
    }
}

/// Points along one direction with their weights in a value and in its derivative.
#[derive(Clone, Copy, Default)]
struct Span {
    points: [usize; 4],
    weights: [f64; 4],
    slopes: [f64; 4],
}

/// Weights of four equidistant values, and their derivatives, at the fraction `p` between the second and the third: the cubic through both
/// with the slopes of the chords of their neighbours [Catmull and Rom 1974].
fn cubic(p: f64) -> ([f64; 4], [f64; 4]) {
    let weights = [
        0.5 * p * (p * (2.0 - p) - 1.0),
        1.0 + 0.5 * p * p * (3.0 * p - 5.0),
        0.5 * p * (1.0 + p * (4.0 - 3.0 * p)),
        0.5 * p * p * (p - 1.0),
    ];
    let slopes = [
        0.5 * (p * (4.0 - 3.0 * p) - 1.0),
        0.5 * p * (9.0 * p - 10.0),
        0.5 * (1.0 + p * (8.0 - 9.0 * p)),
        0.5 * p * (3.0 * p - 2.0),
    ];
    (weights, slopes)
}

#[cfg(test)]
#[path = "../../tests/unit/files/wind_box.rs"]
mod tests;
