//! Superelements of a model file: parts that are given by reduced matrices over their interfaces and modes.

use std::sync::Arc;

use lissom_flexible::superelement::{Damping, GeometricMatrices, ReducedMatrices};
use lissom_motion::Vector3;
use nalgebra::DMatrix;

use super::bodies::{axes, position};
use super::entries::each;
use super::{Interface, Superelement};
use crate::files::library::joined;
use crate::files::matrix_file;
use crate::format::keys::Shape;
use crate::format::suggest;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::Value;
use crate::text::report::{Located, Problem};

pub(super) fn superelements(context: &Context<'_>) -> Vec<Superelement> {
    each(context, "superelements", |reader, name| {
        let (position, axes, interfaces) = (position(reader), axes(reader), interfaces(reader));
        let (mass, stiffness) = (needed(reader, "mass"), needed(reader, "stiffness"));
        let preload = matrix(reader, "preload")?.map_or_else(Vec::new, |column| column.as_slice().to_vec());
        let stacked = matrix(reader, "geometric")?;
        let (damping, recovery) = (damping(reader), matrix(reader, "recovery")?);
        let (interfaces, stiffness, mass) = (interfaces?, stiffness?, mass?);
        let floating = match reader.text("floating") {
            None => 0,
            Some(named) => interface_named(reader, &interfaces, &named)?,
        };
        let places: Vec<Vector3> = interfaces.iter().map(|interface| interface.place).collect();
        let (damping, ratio) = damping?;
        if let Some(node) = reader.node("floating").filter(|_| stacked.is_some() && floating > 0) {
            let message =
                format!("{} has `geometric` matrices, which are valid for the first interface", reader.what);
            return context.fail(
                node.span,
                message,
                "let the first interface carry the floating frame: name it first",
            );
        }
        let size = mass.nrows();
        if let Some(recovery) = recovery.as_ref().filter(|recovery| recovery.ncols() != size) {
            let message = format!(
                "the `recovery` of {} has {} columns, and its mass has {size} rows",
                reader.what,
                recovery.ncols()
            );
            let help =
                "it must have a column for each row of the mass: six for each interface, then the modes";
            return context.fail(
                reader.node("recovery").map_or(reader.name, |node| node.span),
                message,
                help,
            );
        }
        let geometric = stacked
            .map(|stacked| GeometricMatrices::from_stacked(&stacked, places.len(), size))
            .transpose()
            .map(|read| {
                if matches!(read, Some(None)) {
                    let span = reader.node("geometric").map_or(reader.name, |node| node.span);
                    let message = format!(
                        "the `geometric` matrices of {} are omitted: an earlier form of their file counts loads twice",
                        reader.what
                    );
                    context.report(Problem::warning(span, message).help("reduce the part again by `lissom reduce`"));
                }
                read.flatten().map(Box::new)
            });
        let checked = geometric.and_then(|geometric| {
            ReducedMatrices { mass, stiffness, damping, preload, geometric }.check(&places)
        });
        let damped = checked.and_then(|mut matrices| {
            if let Some(ratio) = ratio {
                matrices.damping = Damping::Matrix(matrices.modal_damping(ratio)?);
            }
            Ok(matrices)
        });
        let matrices = match damped {
            Ok(matrices) => matrices,
            Err(error) => {
                let span = reader.node(&error.parameter).map_or(reader.name, |node| node.span);
                let problem = Problem::error(span, format!("{}: {error}", reader.what));
                context.report(problem.label("of these matrices"));
                return None;
            }
        };
        Some(Superelement {
            name: Located::new(name.to_owned(), reader.name),
            position: position?,
            axes: axes?,
            interfaces,
            floating,
            matrices,
            recovery: recovery.map(Arc::new),
        })
    })
}

/// The interfaces with their positions in the axes of the part.
fn interfaces(reader: &Reader<'_, '_>) -> Option<Vec<Interface>> {
    let (context, node) = (reader.context, reader.node("interfaces")?);
    let what = reader.words("interfaces");
    let Value::List(list) = &node.value else {
        return context.wrong_type(node, &what, "a list of interfaces");
    };
    if list.is_empty() {
        return context.fail(
            node.span,
            format!("{what} is empty"),
            "specify at least one, such as { name = \"root\" }",
        );
    }
    let mut all: Vec<Interface> = Vec::new();
    for (index, entry) in list.iter().enumerate() {
        let words = format!("interface {} of {}", index + 1, reader.what);
        let own = Reader::open(context, entry, (words, entry.span), Shape::interface_keys())?;
        let name = own.text("name")?;
        if name.value.is_empty() || !name.value.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-'))
        {
            let message = format!("`{}` cannot be the name of an interface", name.value);
            return context.fail(name.span, message, "names are made of letters, digits, `_` and `-`");
        }
        if all.iter().any(|known| known.name == name.value) {
            let message = format!("two interfaces of {} are called `{}`", reader.what, name.value);
            return context.fail(name.span, message, "use distinct names");
        }
        let place = match own.node("at") {
            None => Vector3::zeros(),
            Some(_) => own.vector("at")?.value,
        };
        all.push(Interface { name: name.value.to_owned(), place });
    }
    Some(all)
}

fn interface_named(
    reader: &Reader<'_, '_>,
    interfaces: &[Interface],
    named: &Located<&str>,
) -> Option<usize> {
    let found = interfaces.iter().position(|interface| interface.name == named.value);
    if found.is_none() {
        let help = suggest::help(named.value, interfaces.iter().map(|interface| interface.name.as_str()));
        let message =
            format!("{} names `{}`, which is none of its interfaces", reader.words("floating"), named.value);
        reader
            .context
            .report(Problem::error(named.span, message).label("no such interface").maybe_help(help));
    }
    found
}

/// Damping as it is given, and the ratio of all modes where that is.
fn damping(reader: &Reader<'_, '_>) -> Option<(Damping, Option<f64>)> {
    let keys = ["damping", "modal_damping", "stiffness_damping"];
    let given: Vec<&str> = keys.into_iter().filter(|key| reader.has(key)).collect();
    match given.as_slice() {
        [] | ["damping"] => Some((matrix(reader, "damping")?.map_or(Damping::None, Damping::Matrix), None)),
        ["modal_damping"] => Some((Damping::None, Some(reader.number("modal_damping")?.value))),
        ["stiffness_damping"] => {
            Some((Damping::OfStiffness(reader.number("stiffness_damping")?.value), None))
        }
        [first, others @ ..] => {
            let second = others.first().unwrap_or(first);
            let message = format!("{} has both `{first}` and `{second}`", reader.what);
            reader.context.fail(reader.node(second)?.span, message, "remove one of them")
        }
    }
}

/// The matrix under `key`, which must be there.
fn needed(reader: &Reader<'_, '_>, key: &str) -> Option<DMatrix<f64>> {
    let found = matrix(reader, key)?;
    if found.is_none() {
        let span = reader.node("matrices").map_or(reader.name, |node| node.span);
        let message = format!("{} lacks `{key}`", reader.what);
        let help =
            format!("add `{key} = \"file.mtx\"`, or `matrices = \"file.npz\"` with an array of this name");
        return reader.context.fail(span, message, help);
    }
    found
}

/// The matrix in the file that `key` names, or in the archive; the outer none reports a mistake.
#[expect(clippy::option_option, reason = "a mistake, or nothing given")]
fn matrix(reader: &Reader<'_, '_>, key: &str) -> Option<Option<DMatrix<f64>>> {
    let context = reader.context;
    let own = reader.has(key);
    let Some(named) = reader.text(if own { key } else { "matrices" }) else {
        return (!own && !reader.has("matrices")).then_some(None);
    };
    let path = joined(context.sources.file(named.span), named.value);
    let fail = |message: String, help: Option<String>| {
        let problem = Problem::error(named.span, format!("{}: {message}", reader.words(key)));
        context.report(problem.label("named here").maybe_help(help));
        None
    };
    let found = if own {
        context.library.text(&path).map(Some)
    } else {
        let short = match key {
            "mass" => "M",
            "stiffness" => "K",
            "damping" => "D",
            other => other,
        };
        context.library.array(&path, &[key, short])
    };
    let text = match found {
        Ok(Some(text)) => text,
        Ok(None) => return Some(None),
        Err(missing) => return fail(missing.message, missing.help),
    };
    match matrix_file::matrix(&text) {
        Ok(matrix) => Some(Some(matrix)),
        Err(error) => {
            let help = "the Matrix Market format is that of SciPy's `mmwrite`, MATLAB's `mmwrite` and `lissom reduce`";
            fail(format!("`{path}` is not a valid matrix: {error}"), Some(help.to_owned()))
        }
    }
}
