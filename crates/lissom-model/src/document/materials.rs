//! Materials and cross sections of a model file.

use lissom_motion::{Matrix3, Matrix6, Vector3};

use super::entries::{each, each_of_kind};
use super::{Material, Section};
use crate::format::keys::Shape as Holds;
use crate::format::suggest;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::Registry;
use crate::sections::Outline;
use crate::sections::{self, Isotropic, SectionKind, SectionProperties, Shear, ShearTheory, mass_matrix};
use crate::text::Value;
use crate::text::report::{Located, Problem};

/// Square of the speed of sound below which a material is hardly a solid [m²/s²]: soft rubber has 60, steel with E in MPa 27.
const SOFTEST: f64 = 30.0;
/// Relative error of moments in tables of three digits or more.
const ROUNDED: f64 = 1e-3;

pub(super) fn materials(context: &Context<'_>) -> Vec<Material> {
    each(context, "materials", |reader, name| {
        let (young, density) = (reader.number("E"), reader.number("density"));
        let expansion = reader.number("expansion");
        let shear = shear_modulus(reader, young.as_ref().map(|young| young.value));
        let (young, density) = (young?, density?);
        warn_of_units(reader, &young, density.value);
        let constants = Isotropic {
            young: young.value,
            shear: shear?,
            density: density.value,
            expansion: expansion?.value,
        };
        Some(Material { name: Located::new(name.to_owned(), reader.name), constants })
    })
}

/// A modulus in MPa or GPa shows as a solid through which sound creeps.
fn warn_of_units(reader: &Reader<'_, '_>, young: &Located<f64>, density: f64) {
    let square = young.value / density;
    if square < SOFTEST {
        let message = format!(
            "the speed of sound in {} would be only {:.2} m/s: `E` or `density` may be in other units",
            reader.what,
            square.sqrt()
        );
        let help = "write `E` in Pa, as 210e9 for 210 GPa, and `density` in kg/m³";
        reader.context.report(Problem::warning(young.span, message).help(help));
    }
}

/// From `G`, or from `nu` by `G = E/(2(1 + ν))`.
fn shear_modulus(reader: &Reader<'_, '_>, young: Option<f64>) -> Option<f64> {
    let (given, poisson) = (reader.number("G"), reader.number("nu"));
    match (reader.node("G"), reader.node("nu")) {
        (Some(_), Some(nu)) => {
            let message = format!("{} has both `G` and `nu`", reader.what);
            let help = "each determines the other: remove one of them";
            return reader.context.fail(nu.span, message, help);
        }
        (None, None) => {
            let message = format!("{} lacks `nu`", reader.what);
            return reader.context.fail(
                reader.name,
                message,
                "add `nu = …` (Poisson's ratio) or `G = …` [Pa]",
            );
        }
        _ => {}
    }
    if let Some(poisson) = poisson {
        if poisson.value > -1.0 && poisson.value <= 0.5 {
            return young.map(|young| young / (2.0 * (1.0 + poisson.value)));
        }
        let message = format!(
            "Poisson's ratio of {} must be above -1 and not above 0.5, not {}",
            reader.what, poisson.value
        );
        return reader.context.fail(poisson.span, message, "metals have about 0.3");
    }
    let given = given?;
    let poisson = young? / (2.0 * given.value) - 1.0;
    if !(poisson > -1.0 && poisson <= 0.5 + 1e-9) {
        let message = format!("`E` and `G` of {} mean a Poisson's ratio of {poisson:.3}", reader.what);
        return reader.context.fail(given.span, message, "G must be at least E/3: check the units of both");
    }
    Some(given.value)
}

pub(super) fn sections(context: &Context<'_>, registry: &Registry, materials: &[Material]) -> Vec<Section> {
    each_of_kind(context, "sections", registry, |reader, name, form| {
        let damping = reader.number("damping");
        let (outline, properties) = if let Some(kind) = sections::KINDS.iter().find(|kind| kind.name == form)
        {
            homogeneous(reader, kind, materials)?
        } else {
            let properties = general(reader)?;
            (Outline::of_mass(&properties.mass), properties)
        };
        let properties =
            SectionProperties { damping: damping.map_or(0.0, |damping| damping.value), ..properties };
        Some(Section { name: Located::new(name.to_owned(), reader.name), outline, properties })
    })
}

fn homogeneous(
    reader: &Reader<'_, '_>,
    kind: &SectionKind,
    materials: &[Material],
) -> Option<(Outline, SectionProperties)> {
    let material = reader.name_in("material");
    let shear = shear(reader);
    let shape = (kind.read)(reader);
    let (shape, material, shear) = (shape?, material?, shear?);
    let material = materials.iter().find(|known| known.name.value == material.value)?;
    let properties = SectionProperties::homogeneous(&*shape, &material.constants, shear);
    let usable =
        |matrix: &Matrix6| matrix.iter().all(|entry| entry.is_finite()) && matrix.diagonal().min() > 0.0;
    if usable(&properties.stiffness) && usable(&properties.mass) {
        return Some((shape.outline(), properties));
    }
    let message = format!("{} has a stiffness or mass beyond all numbers", reader.what);
    reader.context.fail(reader.name, message, "check the units of its sides and of its material")
}

fn shear(reader: &Reader<'_, '_>) -> Option<Shear> {
    let Some(node) = reader.node("shear") else { return Some(Shear::Theory(ShearTheory::Cowper)) };
    let what = reader.words("shear");
    let context = reader.context;
    let (k2, k3) = match &node.value {
        Value::Text(word) if word == "cowper" => return Some(Shear::Theory(ShearTheory::Cowper)),
        Value::Text(word) if word == "renton" => return Some(Shear::Theory(ShearTheory::Renton)),
        Value::Text(word) if suggest::nearest(word, ["cowper", "renton"]).is_some() => {
            let problem = Problem::error(node.span, format!("{what} names no theory"));
            context.report(problem.maybe_help(suggest::help(word, ["cowper", "renton"])));
            return None;
        }
        Value::List(_) => {
            let [k2, k3] = context.numbers::<2>(node, &what)?;
            (k2, k3)
        }
        _ => {
            let both = context.number(node, &what)?;
            (both, both)
        }
    };
    if k2 > 0.0 && k3 > 0.0 {
        return Some(Shear::Given(k2, k3));
    }
    context.fail(node.span, format!("{what} must be greater than zero"), "5/6 is common for a rectangle")
}

fn general(reader: &Reader<'_, '_>) -> Option<SectionProperties> {
    let stiffness = reader
        .node("stiffness")
        .and_then(|node| reader.context.definite_matrix(node, &reader.words("stiffness")));
    let mass = reader.node("mass").and_then(|node| {
        let mass = match &node.value {
            Value::Table(_) => described_mass(reader, node),
            _ => reader.context.definite_matrix(node, &reader.words("mass")),
        };
        warn_of_moments(reader, node, &mass?);
        mass
    });
    let expansion = reader.number("expansion");
    Some(SectionProperties { stiffness: stiffness?, mass: mass?, damping: 0.0, expansion: expansion?.value })
}

/// Moments about three perpendicular axes are sums over the same matter, `J11 = Σ m (y² + z²)`, so that none exceeds the sum of
/// the others. A section that turns feels the difference: in the modes of a blade it is a force that is not there.
fn warn_of_moments(reader: &Reader<'_, '_>, node: &crate::text::Node, mass: &Matrix6) {
    let moments = mass.diagonal().fixed_rows::<3>(3).into_owned();
    if 2.0 * moments.max() > moments.sum() * (1.0 + ROUNDED) {
        let message = format!(
            "{} belongs to no section: one of its moments {}, {} and {} exceeds the sum of the others",
            reader.words("mass"),
            lissom_mechanics::number::Written(moments.x),
            lissom_mechanics::number::Written(moments.y),
            lissom_mechanics::number::Written(moments.z)
        );
        let help = "a slice has J11 = J22 + J33, density times the moments of area";
        reader.context.report(Problem::warning(node.span, message).help(help));
    }
}

fn described_mass<'c>(reader: &Reader<'c, '_>, node: &'c crate::text::Node) -> Option<Matrix6> {
    let inner =
        Reader::open(reader.context, node, (reader.words("mass"), node.span), Holds::slice_mass_keys())?;
    let per_length = inner.number("per_length");
    let inertia = inner.node("inertia").and_then(|node| slice_inertia(&inner, node));
    let center = match inner.node("center") {
        None => Some([0.0, 0.0]),
        Some(node) => reader.context.numbers::<2>(node, &inner.words("center")),
    };
    Some(mass_matrix(per_length?.value, &inertia?, center?))
}

/// The inertia of a slice: it has no thickness, so that `J11 = J22 + J33`; any positive numbers are taken.
fn slice_inertia(inner: &Reader<'_, '_>, node: &crate::text::Node) -> Option<Matrix3> {
    let what = inner.words("inertia");
    let moments = inner.context.vector(node, &what)?;
    if moments.min() > 0.0 {
        return Some(Matrix3::from_diagonal(&Vector3::new(moments.x, moments.y, moments.z)));
    }
    inner.context.fail(node.span, format!("{what} must be three positive numbers"), "write [J11, J22, J33]")
}
