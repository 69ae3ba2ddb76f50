//! The table of forms that touch, and the pairs of their parts.

use std::sync::Arc;

use lissom_motion::Motion;

use super::FormKind::{
    self, Box, Capsule, Cylinder, Ellipsoid, HeightField, Hull, Mesh, Outline, Plane, Polygon, Sphere, Tube,
};
use super::PlacedSolid;
use super::parts::{Parts, edge_rounding, touching};
use crate::geometry::gap::Pair;
use crate::geometry::surfaces::MeshError;

/// Bases, a tip, the parts of the tip that touch the base, and those of the base that touch the tip, where both have edges.
type Row = (&'static [FormKind], FormKind, Parts, Option<Parts>);

/// Forms that touch, every two of them once. Edges that cross touch once: those of one of both are parts.
const PAIRS: [Row; 21] = [
    (&[Plane, Sphere, Capsule, Cylinder, Tube, Box], Sphere, Parts::Middle, None),
    (&[Hull, Polygon, Outline, Mesh, HeightField], Sphere, Parts::Middle, None),
    (&[Plane], Capsule, Parts::Ends, None),
    (&[Capsule, Cylinder, Hull], Capsule, Parts::Axis, None),
    // Two points on a face: one of a crowned axis would move as the capsule tilts.
    (&[Box], Capsule, Parts::Ends, Some(Parts::Edges)),
    (&[Plane], Cylinder, Parts::Rims, None),
    (&[Plane], Tube, Parts::Rims, None),
    (&[Box, Hull], Cylinder, Parts::Round, None),
    (&[Cylinder], Cylinder, Parts::Round, Some(Parts::Rims)),
    // Rollers, whose axes are parallel to those of the prisms.
    (&[Polygon, Outline], Cylinder, Parts::Middle, None),
    (&[Polygon, Outline], Tube, Parts::Middle, None),
    (&[Plane], Box, Parts::Corners, None),
    (&[Box, Hull], Box, Parts::Edges, Some(Parts::Corners)),
    (&[Plane], Hull, Parts::Corners, None),
    (&[Hull], Hull, Parts::Edges, Some(Parts::Corners)),
    (&[Plane], Polygon, Parts::Corners, None),
    (&[Polygon], Polygon, Parts::Corners, Some(Parts::Corners)),
    (&[Outline], Polygon, Parts::Corners, Some(Parts::Curve)),
    (&[Plane, Outline], Outline, Parts::Curve, None),
    (&[Plane, Sphere, Capsule, Cylinder, Box, Hull], Ellipsoid, Parts::Whole, None),
    (&[Plane], Mesh, Parts::Corners, None),
];

/// The row of two forms, and which of them is the base.
fn found(forms: [FormKind; 2]) -> Option<(&'static Row, usize)> {
    let of = |base: usize| {
        let is_meant = |row: &&Row| row.0.contains(&forms[base]) && row.1 == forms[1 - base];
        PAIRS.iter().find(is_meant).map(|row| (row, base))
    };
    of(0).or_else(|| of(1))
}

/// The parts with which two forms touch, in words; none if that is not available.
pub fn parts_between(forms: [FormKind; 2]) -> Option<String> {
    let ((.., parts, back), _) = found(forms)?;
    let back = back.filter(|back| back != parts && *parts != Parts::Round);
    let words: Vec<&str> = std::iter::once(*parts).chain(back).map(Parts::words).collect();
    Some(words.join(" and "))
}

/// Parts of two solids that may touch at a point.
#[derive(Clone, Debug)]
pub struct Meeting {
    /// The pair of base and tip.
    pub pair: Arc<dyn Pair>,
    /// Which of the solids base and tip belong to.
    pub sides: [usize; 2],
    /// Their axes in those of the bodies.
    pub frames: [Motion; 2],
    /// Whether the tip is a fixed point of a flat end, to which an edge that is flush with what it stands on is no obstacle.
    pub stands: bool,
}

/// The points at which two solids may touch; none if that is not available. With `stands` ends of cylinders have fixed points beside
/// their rims, whose nearest point travels where they lie flat.
///
/// # Errors
/// If one is a mesh that encloses no solid.
pub fn meetings(solids: [&PlacedSolid; 2], stands: bool) -> Result<Option<Vec<Meeting>>, MeshError> {
    let Some(((.., parts, back), base)) = found(solids.map(|solid| solid.form.kind())) else {
        return Ok(None);
    };
    let mut ways = vec![([base, 1 - base], *parts)];
    ways.extend(back.map(|back| ([1 - base, base], back)));
    if stands {
        let have_ends =
            ways.clone().into_iter().filter(|(_, parts)| matches!(parts, Parts::Rims | Parts::Round));
        ways.extend(have_ends.map(|(sides, _)| (sides, Parts::Stands)));
    }
    ways.sort_by_key(|(sides, _)| *sides);
    let is_rounded = back.is_some() || matches!(parts, Parts::Round | Parts::Whole);
    let mut all = Vec::new();
    for (sides, parts) in ways {
        let [base, tip] = sides.map(|side| solids[side]);
        let edges = [base, tip].map(|own| if is_rounded { edge_rounding(&own.form) } else { 0.0 });
        let found = touching(&base.form, (&tip.form, parts), edges)?.into_iter();
        let of = |(pair, place)| Meeting {
            pair,
            sides,
            frames: [base.frame, tip.frame * place],
            stands: parts == Parts::Stands,
        };
        all.extend(found.map(of));
    }
    Ok(Some(all))
}

#[cfg(test)]
#[path = "../../tests/unit/forms/meeting.rs"]
mod tests;
