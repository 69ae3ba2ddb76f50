//! Sizes of traits and structs of the crates, and words that sources of a crate must not contain: what `cargo xtask structure` prints,
//! and tests bound.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use syn::visit::Visit;

use crate::structure::{StructureError, is_test};

/// Fields of a struct.
pub(crate) const MAX_FIELDS: usize = 16;

/// A trait of the workspace.
#[derive(Default)]
pub(crate) struct Interface {
    /// Number of its methods.
    pub(crate) methods: usize,
    /// Methods with a default, by the types that replace it.
    pub(crate) defaults: BTreeMap<String, BTreeSet<String>>,
}

/// Traits, by name, and structs with the number of their fields.
#[derive(Default)]
pub(crate) struct Sizes {
    pub(crate) interfaces: BTreeMap<String, Interface>,
    pub(crate) fields: BTreeMap<String, usize>,
    /// Methods that a type implements of a trait.
    implemented: Vec<(String, String, Vec<String>)>,
}

impl<'ast> Visit<'ast> for Sizes {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            syn::visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_trait(&mut self, item: &'ast syn::ItemTrait) {
        let methods = item.items.iter().filter_map(|item| match item {
            syn::TraitItem::Fn(method) => Some(method),
            _ => None,
        });
        let interface = self.interfaces.entry(item.ident.to_string()).or_default();
        interface.methods = methods.clone().count().max(interface.methods);
        for method in methods.filter(|method| method.default.is_some()) {
            interface.defaults.entry(method.sig.ident.to_string()).or_default();
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        let Some((_, path, _)) = &item.trait_ else { return };
        let Some(name) = path.segments.last() else { return };
        let methods = item.items.iter().filter_map(|item| match item {
            syn::ImplItem::Fn(method) => Some(method.sig.ident.to_string()),
            _ => None,
        });
        let of = match &*item.self_ty {
            syn::Type::Path(named) => named.path.segments.last().map(|segment| segment.ident.to_string()),
            _ => None,
        };
        self.implemented.push((name.ident.to_string(), of.unwrap_or_default(), methods.collect()));
    }

    fn visit_item_struct(&mut self, item: &'ast syn::ItemStruct) {
        let most = self.fields.entry(item.ident.to_string()).or_default();
        *most = item.fields.len().max(*most);
    }
}

/// Files of Rust in a folder and those below it.
fn sources(folder: &Path) -> Result<Vec<PathBuf>, StructureError> {
    let about = |source| StructureError::Read { path: folder.to_owned(), source };
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(about)? {
        let path = entry.map_err(about)?.path();
        if path.is_dir() {
            found.extend(sources(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    Ok(found)
}

impl Sizes {
    /// Sizes of all crates with these sources.
    ///
    /// # Errors
    /// If a file cannot be read or is no Rust.
    pub(crate) fn of<'p>(roots: impl IntoIterator<Item = &'p Path>) -> Result<Self, StructureError> {
        let mut found = Self::default();
        for root in roots {
            for path in sources(root)? {
                let text = std::fs::read_to_string(&path)
                    .map_err(|source| StructureError::Read { path: path.clone(), source })?;
                let file = syn::parse_file(&text).map_err(|source| StructureError::Parse { path, source })?;
                found.visit_file(&file);
            }
        }
        for (interface, of, methods) in std::mem::take(&mut found.implemented) {
            let Some(interface) = found.interfaces.get_mut(&interface) else { continue };
            for method in methods {
                if let Some(types) = interface.defaults.get_mut(&method) {
                    types.insert(of.clone());
                }
            }
        }
        Ok(found)
    }

    /// Methods with a default that fewer than three types replace.
    pub(crate) fn rare(&self) -> Vec<String> {
        let of_interface = |(name, interface): (&String, &Interface)| {
            let rare = interface.defaults.iter().filter(|(_, types)| types.len() < 3);
            rare.map(|(method, types)| format!("{name}::{method} ({})", types.len())).collect::<Vec<_>>()
        };
        self.interfaces.iter().flat_map(of_interface).collect()
    }

    /// Structs with more than this number of fields.
    pub(crate) fn wide(&self, most: usize) -> Vec<(&str, usize)> {
        self.fields
            .iter()
            .filter(|(_, count)| **count > most)
            .map(|(name, count)| (&**name, *count))
            .collect()
    }

    /// Traits with more than this number of methods.
    pub(crate) fn large(&self, most: usize) -> Vec<(&str, usize)> {
        let counts = self.interfaces.iter().map(|(name, interface)| (&**name, interface.methods));
        counts.filter(|(_, count)| *count > most).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fields of the structs that have more.
    const WIDE: [(&str, usize); 3] = [("Builder", 17), ("Document", 31), ("Scene", 19)];

    /// Methods of a trait, and those of the traits that have more.
    const MAX_METHODS: usize = 8;
    const LARGE: [(&str, usize); 10] = [
        ("AnyBatch", 10),
        ("AnyJoint", 14),
        ("Constraint", 26),
        ("Control", 17),
        ("Element", 9),
        ("ForceFunction", 9),
        ("JointBatch", 9),
        ("Measure", 11),
        ("Number", 12),
        ("TimeFunction", 10),
    ];

    /// Methods with a default that fewer than three types replace: capabilities of one kind in the interface of all.
    const MAX_RARE: usize = 115;

    /// What the sources of crates must not contain.
    const WALLS: [(&str, &[&str]); 2] = [
        // A system holds nothing that runs.
        ("Mutex", &["motion", "mechanics", "flexible", "contact", "system", "core", "drawing", "mesh"]),
        // No name is taken apart to find what it means.
        ("_matches(\".", &["mechanics", "system", "core", "model"]),
    ];

    fn root(name: &str) -> PathBuf {
        let name = if name.is_empty() { "lissom".to_owned() } else { format!("lissom-{name}") };
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates").join(name).join("src")
    }

    fn all() -> Sizes {
        let names = [
            "motion",
            "solver",
            "mechanics",
            "flexible",
            "contact",
            "system",
            "core",
            "drawing",
            "mesh",
            "model",
            "",
            "cli",
            "fmi",
            "units",
            "python",
        ];
        let roots = names.map(root);
        Sizes::of(roots.iter().map(|root| &**root)).expect("readable sources")
    }

    /// Fails if `found` differs from what is listed: more is a mistake, and less a reason to list less.
    fn check_listed(found: &[(&str, usize)], listed: &[(&str, usize)], what: &str) {
        assert_eq!(
            found, listed,
            "{what}: a new one is to be split, and one that became smaller to be listed so"
        );
    }

    #[test]
    fn structs_have_few_fields() {
        check_listed(&all().wide(MAX_FIELDS), &WIDE, "fields");
    }

    #[test]
    fn traits_have_few_methods() {
        check_listed(&all().large(MAX_METHODS), &LARGE, "methods");
    }

    #[test]
    fn methods_with_a_default_are_of_several_types() {
        let rare = all().rare();
        assert_eq!(rare.len(), MAX_RARE, "a method of one or two types belongs to a capability: {rare:#?}");
    }

    #[test]
    fn walls_stand() {
        for (word, crates) in WALLS {
            for path in crates.iter().flat_map(|name| sources(&root(name)).expect("readable sources")) {
                let text = std::fs::read_to_string(&path).expect("a file");
                assert!(!text.contains(word), "{} contains `{word}`", path.display());
            }
        }
    }
}
