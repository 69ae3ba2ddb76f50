//! Fluids: their density, viscosity, and bulk modulus with bubbles of air.

use std::collections::BTreeMap;

use lissom_mechanics::registry::DefaultValue;

use super::net::Term;
use crate::format::keys::{Key, Shape, optional, unitless};
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::report::Span;
use crate::text::{Node, Value};

/// Pressure of the atmosphere [Pa].
pub(super) const ATMOSPHERE: f64 = 101_325.0;

/// A liquid with bubbles of air.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fluid {
    /// Density [kg/m³].
    pub(super) density: f64,
    /// Bulk modulus of the liquid [Pa].
    bulk_modulus: f64,
    /// Kinematic viscosity [m²/s].
    pub(super) viscosity: f64,
    /// Fraction of the volume that is air at the pressure of the atmosphere.
    air: f64,
    /// Polytropic exponent of the air.
    exponent: f64,
}

/// Keys of a fluid. The defaults are a mineral oil of class HLP 46 at 40 °C.
pub(in crate::document) fn keys() -> Vec<Key> {
    vec![
        optional("density", Shape::Positive, "kg/m³", "density").or_number(860.0),
        optional("bulk_modulus", Shape::Positive, "Pa", "of the liquid without air").or_number(1.5e9),
        optional("viscosity", Shape::Positive, "m²/s", "kinematic viscosity").or_number(46e-6),
        unitless(
            "air",
            Shape::Between(0.0, 0.5),
            "fraction of the volume that is undissolved air at the pressure of the atmosphere",
        )
        .or_number(0.005),
        unitless("exponent", Shape::Between(1.0, 2.0), "polytropic exponent of the air").or_number(1.4),
    ]
}

impl Fluid {
    /// The fluid of these numbers by key.
    fn of(number: impl Fn(&str) -> Option<f64>) -> Option<Self> {
        Some(Self {
            density: number("density")?,
            bulk_modulus: number("bulk_modulus")?,
            viscosity: number("viscosity")?,
            air: number("air")?,
            exponent: number("exponent")?,
        })
    }

    /// The fluid of models without `[fluids]`.
    fn usual() -> Option<Self> {
        let keys = keys();
        Self::of(|word| match keys.iter().find(|key| key.name == word)?.default {
            Some(DefaultValue::Number(number)) => Some(number),
            _ => None,
        })
    }

    /// Compressibility, 1/K(p), as a template over the pressure `p` with its numbers. Liquid and air change their volumes
    /// independently [Gholizadeh et al. 2011]:
    ///
    /// ```text
    /// liquid  l = (1 - a) exp(-(p - p0)/K),   air  g = a (p0/p)^(1/n),   1/K(p) = (l/K + g/(n p))/(l + g)
    /// ```
    pub(super) fn compressibility(&self) -> (&'static str, Vec<(&'static str, Term)>) {
        let modulus = ("K", Term::Number(self.bulk_modulus));
        if self.air == 0.0 {
            return ("1/K", vec![modulus]);
        }
        let numbers = [("n", self.exponent), ("a", self.air), ("p0", ATMOSPHERE)];
        let mut all: Vec<_> = numbers.map(|(name, number)| (name, Term::Number(number))).into();
        all.push(modulus);
        // An iterate may have a pressure below zero, which air does not have.
        let template = "((1 - a)*exp((p0 - p)/K)/K + a*(p0/max(p, 1))^(1/n)/(n*max(p, 1)))\
                        /((1 - a)*exp((p0 - p)/K) + a*(p0/max(p, 1))^(1/n))";
        (template, all)
    }

    /// Whether the pressure cannot fall below zero.
    pub(super) fn has_air(&self) -> bool {
        self.air > 0.0
    }
}

/// Fluids by name; none for one that is wrong.
pub(super) fn fluids(context: &Context<'_>) -> BTreeMap<String, Option<Fluid>> {
    let read = |(name, span, node): (&str, Span, &Node)| {
        let reader = Reader::open(context, node, (format!("fluid `{name}`"), span), keys());
        (name.to_owned(), reader.and_then(|own| Fluid::of(|key| own.number(key).map(|number| number.value))))
    };
    context.entries("fluids").into_iter().map(read).collect()
}

/// Name of the fluid of a node, whose key may be omitted if there is at most one.
pub(super) fn name_of(context: &Context<'_>, node: &str) -> Option<String> {
    let given = context.entry("hydraulics", node)?.table()?.get("fluid").map(|entry| &entry.node);
    match given.map(|node| (node, &node.value)) {
        Some((node, Value::Text(text))) => context.entry_named("fluids", text, node, "`fluid`"),
        _ => context.names("fluids").first().map(|(name, _)| (*name).to_owned()),
    }
}

/// The fluid of a node.
pub(super) fn of(
    context: &Context<'_>,
    fluids: &BTreeMap<String, Option<Fluid>>,
    node: &str,
) -> Option<Fluid> {
    match name_of(context, node) {
        Some(name) => fluids.get(&name).copied().flatten(),
        None => Fluid::usual(),
    }
}
