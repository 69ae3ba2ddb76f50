//! Contacts along beams: their points, and what these carry.

use std::sync::Arc;

use lissom_contact::forms::{Form, spacing_of_rounds};
use lissom_contact::geometry::pairs::PointOnSurface;
use lissom_contact::geometry::surfaces::Rod;
use lissom_contact::nearest::{CarriedCurve, CarriedPoint, NearestContact};
use lissom_contact::of_beams::BeamContact;
use lissom_flexible::beam::line::BeamLine;
use lissom_flexible::beam::section::Section;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::elements::Element;
use lissom_mechanics::joints::centerline::Centerline;
use lissom_mechanics::kinematics::{CarriedFrame, MAX_NODES, NodeId};
use lissom_mechanics::number::written;
use lissom_motion::Vector3;
use lissom_system::Builder;

use super::contacts::solids;
use super::names::Names;
use crate::document::{BeamContactEntry, ContactEntry, Document, Touching};
use crate::outputs::contact_point::ContactPoint;
use crate::sections::Outline;
use crate::text::report::Problem;

/// Parts of an interval between points whose chords make up its length.
const CHORDS: usize = 8;
/// Pairs of intervals of two beams that may touch.
const MAX_PAIRS: usize = 10_000;

/// A contact of a beam with another part.
struct OfBeam<'a> {
    document: &'a Document,
    entry: &'a ContactEntry,
    law: &'a BeamContactEntry,
    /// Radius of the beam [m].
    radius: f64,
}

/// Adds a contact of a beam.
pub(super) fn add(
    document: &Document,
    (entry, law): (&ContactEntry, &BeamContactEntry),
    names: &Names,
    builder: &mut Builder,
) -> Result<Vec<ContactPoint>, Problem> {
    let line = names.lines.get(&law.beam.value).ok_or_else(|| unknown(&law.beam.value, entry))?;
    let radius = radius(document, entry, (&law.beam.value, "radius"), law.radii[1])?;
    let of_beam = OfBeam { document, entry, law, radius };
    match (&law.base, law.touching) {
        (None, Touching::Along(stiffness, points)) => {
            of_beam.along((names.node(&entry.between[0])?, line), (stiffness, points), builder)
        }
        (None, Touching::Nearest(stiffness)) => {
            of_beam.nearest_to_part((names.node(&entry.between[0])?, line), stiffness, builder)
        }
        (Some(base), touching) => {
            let other = names.lines.get(&base.value).ok_or_else(|| unknown(&base.value, entry))?;
            of_beam.check_apart(line, &other.nodes)?;
            let radius = self::radius(document, entry, (&base.value, "base_radius"), law.radii[0])?;
            let curves = of_beam.intervals(&base.value, other)?;
            of_beam.with_beam((&curves, radius), (line, touching), builder)
        }
    }
}

fn unknown(beam: &str, entry: &ContactEntry) -> Problem {
    Problem::error(entry.name.span, format!("contact `{}`: there is no beam `{beam}`", entry.name.value))
}

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

impl OfBeam<'_> {
    /// Points at equal fractions along the beam, each with its share of the length.
    fn along(
        &self,
        (base, line): (NodeId, &BeamLine),
        (stiffness, points): (f64, usize),
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let beam = self.beam();
        let curve = &self.document.beam(beam).ok_or_else(|| unknown(beam, self.entry))?.line;
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
            let found = (solid.form.spacing(self.radius), solid.form.surface(0.0));
            let (Some(most), Ok(Some(surface))) = found else { return Err(self.no_pair(&solid.form)) };
            self.check_spacing((apart, most), solid.form.kind().words())?;
            for k in 0..=count {
                let before = if k > 0 { lengths[k - 1] } else { 0.0 };
                let share = 0.5 * (before + lengths.get(k).copied().unwrap_or(0.0));
                let compliance = Compliance { stiffness: stiffness * share, exponent: self.law.exponent };
                let mut contribution = Contribution::to(builder.model());
                let name = format!("{} {}", self.entry.name.value, all.len() + 1);
                let friction = self.law.friction.as_ref();
                let friction =
                    friction.map(|law| law.with_bristles(&format!("{name}, friction"), &mut contribution));
                let pair = Arc::new(PointOnSurface { rounding: self.radius, surface: surface.clone() });
                let contact = BeamContact::new(
                    CarriedFrame { node: base, offset: solid.frame },
                    Section::of_line(line, k as f64 / count as f64),
                    pair,
                    (compliance, self.law.dissipation),
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
                all.push(ContactPoint { contact: Arc::new(contact), sign: 1.0, velocity: None });
            }
        }
        Ok(all)
    }

    /// Name of the beam.
    fn beam(&self) -> &str {
        &self.law.beam.value
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
        (base, line): (NodeId, &BeamLine),
        stiffness: f64,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        self.check_apart(line, &[base])?;
        let tips = self.intervals(self.beam(), line)?;
        let mut all = Vec::new();
        for solid in solids(self.document, &self.entry.between[0].value) {
            let point = |height: f64| (base, solid.frame.transform_point(&Vector3::new(0.0, 0.0, height)));
            let (curve, radius) = match solid.form.rod() {
                Some(Rod { half_length, radius }) if half_length > 0.0 => {
                    (CarriedCurve::between([-half_length, half_length].map(point)), radius)
                }
                Some(Rod { radius, .. }) => (CarriedCurve::of_point(point(0.0)), radius),
                None => {
                    let message =
                        format!("`stiffness` of a beam on {} is not available", solid.form.kind().words());
                    let help =
                        "give `stiffness_per_length` instead; `stiffness` is for spheres, capsules and beams";
                    return Err(self.fault(&message, help));
                }
            };
            self.add_pairs((&[curve], radius), (&tips, |_| stiffness), (builder, &mut all))?;
        }
        Ok(all)
    }

    /// Another beam, where both are nearest, or at points of the tip.
    fn with_beam(
        &self,
        base: (&[CarriedCurve], f64),
        (line, touching): (&BeamLine, Touching),
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let mut all = Vec::new();
        match touching {
            Touching::Nearest(stiffness) => {
                let tips = self.intervals(self.beam(), line)?;
                self.add_pairs(base, (&tips, |_| stiffness), (builder, &mut all))?;
            }
            Touching::Along(stiffness, points) => {
                let (centerline, nodes) = self.smooth_line(self.beam(), line)?;
                let count = points * line.elements.len();
                let apart = centerline.length() / count as f64;
                self.check_spacing((apart, spacing_of_rounds(self.radius + base.1)), "a beam")?;
                let on = |k: usize| CarriedCurve::on_line(&centerline, k as f64 * apart, &nodes);
                let tips: Vec<_> = (0..=count).map(on).collect();
                let share = |k: usize| if k == 0 || k == count { 0.5 * apart } else { apart };
                self.add_pairs(base, (&tips, |k| stiffness * share(k)), (builder, &mut all))?;
            }
        }
        Ok(all)
    }

    /// All pairs of curves of base and tip, with the stiffness of each of the tip.
    fn add_pairs(
        &self,
        (bases, radius): (&[CarriedCurve], f64),
        (tips, stiffness): (&[CarriedCurve], impl Fn(usize) -> f64),
        (builder, all): (&mut Builder, &mut Vec<ContactPoint>),
    ) -> Result<(), Problem> {
        let count = bases.len() * tips.len();
        if count > MAX_PAIRS {
            let message =
                format!("{count} pairs of intervals between nodes may touch, more than {MAX_PAIRS}");
            return Err(self.fault(&message, "use fewer elements or points, or divide the beams"));
        }
        for base in bases {
            for (k, tip) in tips.iter().enumerate() {
                let law = Compliance { stiffness: stiffness(k), exponent: self.law.exponent };
                let curves = [base.clone(), tip.clone()];
                let contact = NearestContact::new(curves, [radius, self.radius], (law, self.law.dissipation));
                builder.add(Contribution::of(builder.model(), contact.clone()));
                all.push(ContactPoint { contact: Arc::new(contact), sign: 1.0, velocity: None });
            }
        }
        Ok(())
    }

    fn fault(&self, message: &str, help: &str) -> Problem {
        let name = &self.entry.name.value;
        Problem::error(self.entry.name.span, format!("contact `{name}`: {message}")).help(help)
    }

    /// Where parts share a node the distance is always zero.
    fn check_apart(&self, line: &BeamLine, nodes: &[NodeId]) -> Result<(), Problem> {
        if line.nodes.iter().any(|node| nodes.contains(node)) {
            let help = "the contact would act at that node: join the parts by a joint outside of their radii, or remove the contact";
            return Err(self.fault("base and tip share a node", help));
        }
        Ok(())
    }

    fn no_pair(&self, form: &Form) -> Problem {
        let message = format!("a beam on {} is not available", form.kind().words());
        self.fault(&message, "use planes, boxes, cylinders, tubes, spheres and capsules that have its shape")
    }

    /// A solid between two points of a beam would not be noticed.
    fn check_spacing(&self, (apart, most): (f64, f64), what: &str) -> Result<(), Problem> {
        if apart <= most {
            return Ok(());
        }
        let message = format!(
            "the points of the beam are {} m apart, more than {} m for {what} of this size",
            written(apart, 3),
            written(most, 3)
        );
        let help = "increase `points` or the number of elements; for contact where the beam is nearest give `stiffness`";
        Err(self.fault(&message, help))
    }
}
