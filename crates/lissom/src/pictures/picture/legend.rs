//! The scale of the colours of a field.

use lissom_model::output::{Align, Drawing, Shade};

use super::field::{Field, colour};
use super::snapshot::short;

const WORDS: Shade = [0x6b, 0x76, 0x86];
/// Width and height of the bar [pixels], and number of its colours.
const WIDTH: f64 = 180.0;
const HEIGHT: f64 = 9.0;
const PARTS: usize = 60;
/// Prefixes of units, by thousands.
const PREFIXES: [(&str, f64); 7] =
    [("G", 1e9), ("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("µ", 1e-6), ("n", 1e-9)];

/// A bar from zero to the largest value of a field, with its middle at `x` and its lower edge at `y`.
pub(super) fn legend(drawing: &mut Drawing, (field, most): (Field, f64), [x, y]: [f64; 2]) {
    let left = x - 0.5 * WIDTH;
    let step = WIDTH / PARTS as f64;
    for k in 0..PARTS {
        let [from, to] = [k, k + 1].map(|k| left + k as f64 * step);
        let shade = colour((k as f64 + 0.5) / PARTS as f64);
        drawing.polygon(vec![[from, y - HEIGHT], [to, y - HEIGHT], [to, y], [from, y]], shade);
    }
    let (name, unit) = field.title();
    let (prefix, factor) = PREFIXES
        .into_iter()
        .find(|(_, factor)| most >= *factor)
        .unwrap_or(if most > 0.0 { PREFIXES[6] } else { PREFIXES[3] });
    drawing.words([x, y - HEIGHT - 5.0], &format!("{name} [{prefix}{unit}]"), 12, Align::Middle, WORDS);
    for (share, at) in [(0.0, left), (0.5, x), (1.0, left + WIDTH)] {
        drawing.words([at, y + 12.0], &short(share * most / factor), 11, Align::Middle, WORDS);
    }
}
