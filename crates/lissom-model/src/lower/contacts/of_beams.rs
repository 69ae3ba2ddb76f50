//! Contacts along beams: their points, and what these carry.

use std::sync::Arc;

use lissom_contact::forms::spacing_of_rounds;
use lissom_contact::geometry::pairs::PointOnSurface;
use lissom_contact::geometry::surfaces::Rod;
use lissom_contact::nearest::{CarriedCurve, CarriedPoint, NearestContact};
use lissom_contact::of_beams::BeamContact;
use lissom_flexible::beam::line::BeamLine;
use lissom_flexible::beam::section::Section;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::elements::Element;
use lissom_mechanics::joints::centerline::Centerline;
use lissom_mechanics::kinematics::{CarriedFrame, MAX_NODES, NodeId};
use lissom_motion::Vector3;
use lissom_system::Builder;

use super::super::names::Names;
use super::flexible::{OfFlexible, point, unknown};
use super::pairs::solids;
use crate::document::{ContactEntry, Document, FlexiblePart, Way};
use crate::outputs::contact_point::ContactPoint;
use crate::sections::Outline;
use crate::text::report::Problem;

/// Parts of an interval between points whose chords make up its length.
const CHORDS: usize = 8;
/// Pairs of intervals of two beams that may touch.
const MAX_PAIRS: usize = 10_000;
/// Remedy for points that are too far apart.
const CLOSER: &str =
    "increase `points` or the number of elements; for contact where the beam is nearest give `stiffness`";

/// The radius of a beam where it touches: as given, or that of its sections.
fn radius(
    document: &Document,
    entry: &ContactEntry,
    (name, key): (&str, &str),
    given: Option<f64>,
) -> Result<f64, Problem> {
    if let Some(radius) = given {
        return Ok(radius);
    }
    let beam = document.beam(name).ok_or_else(|| unknown(name, entry))?;
    let mut radii = beam.stations.iter().map(|station| match document.section(&station.section.value) {
        Some(section) => match section.outline {
            Outline::Circle { radius, .. } => Some(radius),
            _ => None,
        },
        None => None,
    });
    let first = radii.next().flatten();
    match first {
        Some(radius) if radii.all(|other| other == first) => Ok(radius),
        _ => {
            let message = format!(
                "contact `{}` requires `{key}`: the sections of beam `{name}` are not all round and equal",
                entry.name.value
            );
            Err(Problem::error(entry.name.span, message).help("add the radius with which the beam touches"))
        }
    }
}

/// A beam as tip: its name, its line and its radius [m].
#[derive(Clone, Copy)]
struct Tip<'a> {
    name: &'a str,
    line: &'a BeamLine,
    radius: f64,
}

impl OfFlexible<'_> {
    /// Adds a beam.
    pub(super) fn add_beam(
        &self,
        (name, line): (&str, &BeamLine),
        names: &Names,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let radius = radius(self.document, self.entry, (name, "radius"), self.law.radii[1])?;
        let tip = Tip { name, line, radius };
        let Some(FlexiblePart::Beam(base)) = &self.law.base else {
            let node = names.node(&self.entry.between[0])?;
            return match self.law.way {
                Way::Along(points) => self.along((node, tip), points, builder),
                _ => self.nearest_to_part((node, tip), builder),
            };
        };
        let other = names.lines.get(&base.value).ok_or_else(|| unknown(&base.value, self.entry))?;
        self.check_apart(line, &other.nodes)?;
        let radius =
            self::radius(self.document, self.entry, (&base.value, "base_radius"), self.law.radii[0])?;
        let curves = self.intervals(&base.value, other)?;
        self.with_beam((&curves, radius), tip, builder)
    }

    /// Points at equal fractions along the beam, each with its share of the length.
    fn along(
        &self,
        (base, Tip { name, line, radius }): (NodeId, Tip<'_>),
        points: usize,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let curve = &self.document.beam(name).ok_or_else(|| unknown(name, self.entry))?.line;
        let count = points * line.elements.len();
        let lengths: Vec<f64> = (0..count)
            .map(|k| {
                let place = |j: usize| curve.position((k as f64 + j as f64 / CHORDS as f64) / count as f64);
                (0..CHORDS).map(|j| (place(j + 1) - place(j)).norm()).sum()
            })
            .collect();
        let apart = lengths.iter().copied().fold(0.0, f64::max);
        let mut all = Vec::new();
        for solid in solids(self.document, &self.entry.between[0].value) {
            let found = (solid.form.spacing(radius), solid.form.surface(0.0));
            let (Some(most), Ok(Some(surface))) = found else { return Err(self.no_pair(&solid.form)) };
            self.check_spacing((apart, most), solid.form.kind().words(), CLOSER)?;
            for k in 0..=count {
                let before = if k > 0 { lengths[k - 1] } else { 0.0 };
                let share = 0.5 * (before + lengths.get(k).copied().unwrap_or(0.0));
                let mut contribution = Contribution::to(builder.model());
                let friction = self.friction(all.len() + 1, &mut contribution);
                let pair = Arc::new(PointOnSurface { rounding: radius, surface: surface.clone() });
                let contact = BeamContact::new(
                    CarriedFrame { node: base, offset: solid.frame },
                    Section::of_line(line, k as f64 / count as f64),
                    pair,
                    (self.compliance(share), self.law.dissipation),
                    friction,
                )
                .with_name(&self.entry.name.value);
                if contact.unknowns().nodes.len() > MAX_NODES {
                    return Err(self.fault(
                        "beams of order 3 touch moving parts at no points within their elements",
                        "add `order = 1` or `order = 2` to the beam",
                    ));
                }
                builder.add(contribution.with(contact.clone()));
                all.push(point(contact));
            }
        }
        Ok(all)
    }

    /// The smooth line through the nodes of a beam, and these.
    fn smooth_line(
        &self,
        name: &str,
        line: &BeamLine,
    ) -> Result<(Arc<Centerline>, Vec<CarriedPoint>), Problem> {
        let curve = &self.document.beam(name).ok_or_else(|| unknown(name, self.entry))?.line;
        let mut knots = vec![0.0];
        for pair in line.places.windows(2) {
            let place = |j: usize| curve.position(pair[0] + (pair[1] - pair[0]) * j as f64 / CHORDS as f64);
            let length: f64 = (0..CHORDS).map(|j| (place(j + 1) - place(j)).norm()).sum();
            knots.push(knots[knots.len() - 1] + length);
        }
        let centerline = Centerline::new(knots).ok_or_else(|| unknown(name, self.entry))?;
        let points = line.nodes.iter().zip(&line.offsets).map(|(node, offset)| (*node, offset.position));
        Ok((Arc::new(centerline), points.collect()))
    }

    /// The intervals of that line.
    fn intervals(&self, name: &str, line: &BeamLine) -> Result<Vec<CarriedCurve>, Problem> {
        let (centerline, points) = self.smooth_line(name, line)?;
        let all = 0..centerline.intervals();
        Ok(all.map(|interval| CarriedCurve::of_interval(&centerline, interval, &points)).collect())
    }

    /// A ball or a capsule, where the beam is nearest.
    fn nearest_to_part(
        &self,
        (base, tip): (NodeId, Tip<'_>),
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        self.check_apart(tip.line, &[base])?;
        let tips = self.intervals(tip.name, tip.line)?;
        let mut all = Vec::new();
        for solid in solids(self.document, &self.entry.between[0].value) {
            let at = |height: f64| (base, solid.frame.transform_point(&Vector3::new(0.0, 0.0, height)));
            let (curve, radius) = match solid.form.rod() {
                Some(Rod { half_length, radius }) if half_length > 0.0 => {
                    (CarriedCurve::between([-half_length, half_length].map(at)), radius)
                }
                Some(Rod { radius, .. }) => (CarriedCurve::of_point(at(0.0)), radius),
                None => {
                    let message =
                        format!("`stiffness` of a beam on {} is not available", solid.form.kind().words());
                    let help =
                        "give `stiffness_per_length` instead; `stiffness` is for spheres, capsules and beams";
                    return Err(self.fault(&message, help));
                }
            };
            self.add_pairs((&[curve], radius), ((&tips, tip.radius), |_| 1.0), (builder, &mut all))?;
        }
        Ok(all)
    }

    /// Another beam, where both are nearest, or at points of the tip.
    fn with_beam(
        &self,
        base: (&[CarriedCurve], f64),
        tip: Tip<'_>,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let mut all = Vec::new();
        if let Way::Along(points) = self.law.way {
            let (centerline, nodes) = self.smooth_line(tip.name, tip.line)?;
            let count = points * tip.line.elements.len();
            let apart = centerline.length() / count as f64;
            self.check_spacing((apart, spacing_of_rounds(tip.radius + base.1)), "a beam", CLOSER)?;
            let on = |k: usize| CarriedCurve::on_line(&centerline, k as f64 * apart, &nodes);
            let tips: Vec<_> = (0..=count).map(on).collect();
            let share = |k: usize| if k == 0 || k == count { 0.5 * apart } else { apart };
            self.add_pairs(base, ((&tips, tip.radius), share), (builder, &mut all))?;
        } else {
            let tips = self.intervals(tip.name, tip.line)?;
            self.add_pairs(base, ((&tips, tip.radius), |_| 1.0), (builder, &mut all))?;
        }
        Ok(all)
    }

    /// All pairs of curves of base and tip, with the share of the stiffness of each of the tip.
    fn add_pairs(
        &self,
        (bases, radius): (&[CarriedCurve], f64),
        ((tips, own), share): ((&[CarriedCurve], f64), impl Fn(usize) -> f64),
        (builder, all): (&mut Builder, &mut Vec<ContactPoint>),
    ) -> Result<(), Problem> {
        let count = bases.len() * tips.len();
        let help = "use fewer elements or points, or divide the beams";
        self.check_count((count, MAX_PAIRS), "intervals between nodes", help)?;
        for base in bases {
            for (k, tip) in tips.iter().enumerate() {
                let law = (self.compliance(share(k)), self.law.dissipation);
                let curves = [base.clone(), tip.clone()];
                let contact = NearestContact::new(curves, [radius, own], law);
                builder.add(Contribution::of(builder.model(), contact.clone()));
                all.push(point(contact));
            }
        }
        Ok(())
    }

    /// Where parts share a node the distance is always zero.
    fn check_apart(&self, line: &BeamLine, nodes: &[NodeId]) -> Result<(), Problem> {
        if line.nodes.iter().any(|node| nodes.contains(node)) {
            let help = "the contact would act at that node: join the parts by a joint outside of their radii, or remove the contact";
            return Err(self.fault("base and tip share a node", help));
        }
        Ok(())
    }
}
