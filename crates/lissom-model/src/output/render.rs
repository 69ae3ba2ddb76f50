//! Scenes of the drawing library as SVG and as PNG, with what the latter draws otherwise set right.

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::render::color::Color;
use kuva::render::render::{Primitive, Scene};

/// Pixels of a PNG for each of the drawing.
const SCALE: f32 = 2.0;
/// Lengths of a dash and of the gap after it.
const DASH: [f64; 2] = [8.0, 4.0];

/// The text of an SVG file.
pub(super) fn svg(scene: &Scene) -> String {
    SvgBackend.render_scene(scene)
}

/// The bytes of a PNG file.
///
/// The library dashes every short piece of a curve by itself, so that a curve of many points has no gaps: here dashes go
/// on along the whole curve. It fills every pixel that a letter of turned words touches: they are drawn lighter, so that
/// they look as heavy as others.
pub(super) fn png(mut scene: Scene) -> Result<Vec<u8>, String> {
    let mut elements = Vec::with_capacity(scene.elements.len());
    for element in scene.elements {
        match element {
            Primitive::PolyLine { points, stroke, stroke_width, stroke_dasharray: Some(_) } => {
                elements.extend(dashes(&points).into_iter().map(|points| Primitive::PolyLine {
                    points,
                    stroke: stroke.clone(),
                    stroke_width,
                    stroke_dasharray: None,
                }));
            }
            Primitive::Text { x, y, content, size, anchor, rotate: Some(angle), bold, color } => {
                let color = color.or(Some(Color::Rgb(0x60, 0x60, 0x60)));
                elements.push(Primitive::Text {
                    x,
                    y,
                    content,
                    size,
                    anchor,
                    rotate: Some(angle),
                    bold,
                    color,
                });
            }
            other => elements.push(other),
        }
    }
    scene.elements = elements;
    PngBackend::new().with_scale(SCALE).render_scene(&scene)
}

/// The dashes of a curve.
fn dashes(points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    let mut found = Vec::new();
    let Some(&first) = points.first() else { return found };
    let mut dash = vec![first];
    let (mut phase, mut rest) = (0, DASH[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let length = (to.0 - from.0).hypot(to.1 - from.1);
            if length <= rest || !length.is_finite() {
                rest -= length;
                if phase == 0 {
                    dash.push(to);
                }
                break;
            }
            let share = rest / length;
            from = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            if phase == 0 {
                dash.push(from);
                found.push(std::mem::take(&mut dash));
            } else {
                dash = vec![from];
            }
            phase = 1 - phase;
            rest = DASH[phase];
        }
    }
    if dash.len() > 1 {
        found.push(dash);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_go_on_along_a_curve_of_many_points() {
        let points: Vec<(f64, f64)> = (0..=1000).map(|k| (0.0599 * f64::from(k), 3.0)).collect();
        let found = dashes(&points);
        // 59.9 pixels: dashes begin at 0, 12, 24, 36 and 48, and each is 8 long.
        assert_eq!(found.len(), 5);
        for (index, dash) in found.iter().enumerate() {
            let (start, end) = (dash[0].0, dash[dash.len() - 1].0);
            assert!(
                (start - 12.0 * index as f64).abs() < 1e-9 && (end - start - 8.0).abs() < 1e-9,
                "{dash:?}"
            );
        }
        let straight = dashes(&[(0.0, 0.0), (30.0, 0.0)]);
        assert_eq!(
            straight,
            [[(0.0, 0.0), (8.0, 0.0)], [(12.0, 0.0), (20.0, 0.0)], [(24.0, 0.0), (30.0, 0.0)]]
        );
        assert!(dashes(&[]).is_empty());
    }
}
