//! `cargo xtask structure`: import cycles between files and between folders of a crate, and its numbers of lines and numeric constants. A file
//! imports another one if it names an item that is defined there, also through re-exports; a re-export alone is no import, and tests do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::Visit;
use syn::{Item, UseTree, Visibility};

use crate::walls::{MAX_FIELDS, Sizes};

/// Why imports cannot be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum StructureError {
    #[error("{path}: {source}", path = path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("{path}: {source}", path = path.display())]
    Parse { path: PathBuf, source: syn::Error },
}

/// Names of modules from the root of the crate on.
type Module = Vec<String>;

/// One name that a file imports: its path, the name in this file, and whether it is a re-export.
struct Import {
    path: Vec<String>,
    name: String,
    is_public: bool,
}

/// Definitions and references of a file.
#[derive(Default)]
struct Source {
    defined: BTreeSet<String>,
    imports: Vec<Import>,
    paths: Vec<Vec<String>>,
    /// Modules of tests.
    tests: Vec<String>,
    lines: usize,
    /// Number of named numeric constants: numbers, and vectors of real numbers.
    constants: usize,
}

pub(crate) fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute.parse_args::<syn::Ident>().is_ok_and(|condition| condition == "test")
    })
}

impl Source {
    fn add_tree(&mut self, tree: &UseTree, before: &[String], is_public: bool) {
        let mut path = before.to_vec();
        match tree {
            UseTree::Path(own) => {
                path.push(own.ident.to_string());
                self.add_tree(&own.tree, &path, is_public);
            }
            UseTree::Group(group) => {
                for own in &group.items {
                    self.add_tree(own, before, is_public);
                }
            }
            UseTree::Name(own) if own.ident == "self" => {
                let name = path.last().cloned().unwrap_or_default();
                self.imports.push(Import { path, name, is_public });
            }
            UseTree::Name(own) => {
                path.push(own.ident.to_string());
                self.imports.push(Import { path, name: own.ident.to_string(), is_public });
            }
            UseTree::Rename(own) => {
                path.push(own.ident.to_string());
                self.imports.push(Import { path, name: own.rename.to_string(), is_public });
            }
            UseTree::Glob(_) => self.imports.push(Import { path, name: "*".to_owned(), is_public }),
        }
    }

    /// Adds the paths among the tokens of a macro.
    fn add_tokens(&mut self, tokens: TokenStream) {
        let (mut path, mut colons) = (Vec::new(), 0);
        let mut ended = Vec::new();
        for token in tokens {
            match token {
                TokenTree::Ident(name) if colons == 2 => path.push(name.to_string()),
                TokenTree::Ident(name) => ended.push(std::mem::replace(&mut path, vec![name.to_string()])),
                TokenTree::Punct(own) if own.as_char() == ':' => {
                    colons += 1;
                    continue;
                }
                TokenTree::Group(group) => self.add_tokens(group.stream()),
                _ => ended.push(std::mem::take(&mut path)),
            }
            colons = 0;
        }
        ended.push(path);
        self.paths.extend(ended.into_iter().filter(|path| path.len() > 1));
    }

    fn count_constant(&mut self, kind: &syn::Type) {
        let name = |kind: &syn::Type| match kind {
            syn::Type::Path(own) => own.path.get_ident().map(ToString::to_string).unwrap_or_default(),
            _ => String::new(),
        };
        let numbers = ["f64", "f32", "usize", "u8", "u16", "u32", "u64", "i32", "i64"];
        let is_number = match kind {
            syn::Type::Array(own) => name(&own.elem) == "f64",
            _ => numbers.contains(&name(kind).as_str()),
        };
        self.constants += usize::from(is_number);
    }

    fn define(&mut self, item: &Item) {
        let name = match item {
            Item::Const(own) => &own.ident,
            Item::Enum(own) => &own.ident,
            Item::Fn(own) => &own.sig.ident,
            Item::Static(own) => &own.ident,
            Item::Struct(own) => &own.ident,
            Item::Trait(own) => &own.ident,
            Item::Type(own) => &own.ident,
            _ => return,
        };
        self.defined.insert(name.to_string());
    }
}

impl<'ast> Visit<'ast> for Source {
    fn visit_item(&mut self, item: &'ast Item) {
        match item {
            Item::Use(own) if !is_test(&own.attrs) => {
                let is_public = !matches!(own.vis, Visibility::Inherited);
                self.add_tree(&own.tree, &[], is_public);
            }
            Item::Mod(own) if is_test(&own.attrs) => self.tests.push(own.ident.to_string()),
            Item::Use(_) => {}
            _ => {
                self.define(item);
                syn::visit::visit_item(self, item);
            }
        }
    }

    fn visit_item_const(&mut self, item: &'ast syn::ItemConst) {
        self.count_constant(&item.ty);
        syn::visit::visit_item_const(self, item);
    }

    fn visit_impl_item_const(&mut self, item: &'ast syn::ImplItemConst) {
        self.count_constant(&item.ty);
        syn::visit::visit_impl_item_const(self, item);
    }

    fn visit_macro(&mut self, own: &'ast syn::Macro) {
        self.add_tokens(own.tokens.clone());
        syn::visit::visit_macro(self, own);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        if path.segments.len() > 1 {
            self.paths.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        syn::visit::visit_path(self, path);
    }
}

/// The files of a crate.
struct Crate {
    sources: BTreeMap<Module, Source>,
}

impl Crate {
    fn read(root: &Path) -> Result<Self, StructureError> {
        let mut sources = BTreeMap::new();
        let mut folders = vec![(root.to_owned(), Module::new())];
        while let Some((folder, module)) = folders.pop() {
            let about = |source| StructureError::Read { path: folder.clone(), source };
            for entry in std::fs::read_dir(&folder).map_err(about)? {
                let path = entry.map_err(about)?.path();
                let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                let mut own = module.clone();
                if path.is_dir() {
                    own.push(stem);
                    folders.push((path, own));
                    continue;
                }
                if path.extension().is_none_or(|extension| extension != "rs") {
                    continue;
                }
                if !["mod", "lib"].contains(&stem.as_str()) {
                    own.push(stem);
                }
                let text = std::fs::read_to_string(&path).map_err(about)?;
                let file = syn::parse_file(&text).map_err(|source| StructureError::Parse { path, source })?;
                let mut source = Source { lines: text.lines().count(), ..Source::default() };
                source.visit_file(&file);
                sources.insert(own, source);
            }
        }
        let of_tests: Vec<Module> = sources
            .iter()
            .flat_map(|(module, source)| {
                source.tests.iter().map(|name| [&module[..], std::slice::from_ref(name)].concat())
            })
            .collect();
        sources.retain(|module, _| !of_tests.iter().any(|test| module.starts_with(test)));
        Ok(Self { sources })
    }

    /// A path from the root of the crate on; none for those of other crates and of local items.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Module> {
        let first = path.first()?.as_str();
        let ups = path.iter().take_while(|own| *own == "super").count();
        let (from, rest) = match first {
            "crate" => (&[][..], &path[1..]),
            "self" => (module, &path[1..]),
            "super" => (&module[..module.len().checked_sub(ups)?], &path[ups..]),
            _ => {
                let child: Module = module.iter().cloned().chain([first.to_owned()]).collect();
                if !self.sources.contains_key(&child) {
                    return None;
                }
                (module, path)
            }
        };
        Some(from.iter().chain(rest).cloned().collect())
    }
    /// The file that defines the item at a path from the root.
    fn definition(&self, path: &[String], seen: &mut Vec<Module>) -> Module {
        let mut length = 0;
        while length < path.len() && self.sources.contains_key(&path[..=length]) {
            length += 1;
        }
        let module = path[..length].to_vec();
        let (Some(name), Some(source)) = (path.get(length), self.sources.get(&module)) else { return module };
        let key: Module = path[..=length].to_vec();
        if source.defined.contains(name) || seen.contains(&key) {
            return module;
        }
        seen.push(key);
        for import in source.imports.iter().filter(|import| import.name == *name || import.name == "*") {
            let Some(mut target) = self.absolute(&module, &import.path) else { continue };
            if import.name == "*" {
                target.push(name.clone());
            }
            let found = self.definition(&target, seen);
            let is_there = self.sources.get(&found).is_some_and(|source| source.defined.contains(name));
            if import.name != "*" || is_there {
                return found;
            }
        }
        module
    }

    /// The files that each file imports.
    fn edges(&self) -> BTreeMap<Module, BTreeSet<Module>> {
        let of = |(module, source): (&Module, &Source)| {
            let imports = source.imports.iter().filter(|import| !import.is_public).map(|import| &import.path);
            let targets = imports.chain(&source.paths).filter_map(|path| self.absolute(module, path));
            let files = targets.map(|target| self.definition(&target, &mut Vec::new()));
            (module.clone(), files.filter(|file| file != module).collect())
        };
        self.sources.iter().map(of).collect()
    }
}

/// Files that `from` leads to.
fn reached(edges: &BTreeMap<Module, BTreeSet<Module>>, from: &Module) -> BTreeSet<Module> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from.clone()]);
    while let Some(module) = open.pop() {
        for next in edges.get(&module).into_iter().flatten() {
            if found.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    found
}

/// Import cycles of the crate below `root`: the files that lead to each other, the largest cycle first.
///
/// # Errors
/// If a file cannot be read or is no Rust.
pub(crate) fn cycles(root: &Path) -> Result<Vec<Vec<String>>, StructureError> {
    Ok(cycles_of(&Crate::read(root)?.edges()))
}

/// Import cycles of the crate's folders and of the files beside them.
///
/// # Errors
/// If a file cannot be read or is no Rust.
pub(crate) fn cycles_of_folders(root: &Path) -> Result<Vec<Vec<String>>, StructureError> {
    let mut edges: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
    let folder = |module: &Module| module.iter().take(1).cloned().collect::<Module>();
    for (from, targets) in Crate::read(root)?.edges() {
        let others = targets.iter().map(folder).filter(|to| *to != folder(&from) && !to.is_empty());
        edges.entry(folder(&from)).or_default().extend(others);
    }
    Ok(cycles_of(&edges))
}

/// Imports from one of these folders to another.
///
/// # Errors
/// If a file cannot be read or is no Rust.
fn arrows_between(root: &Path, folders: &[String]) -> Result<Vec<(String, String)>, StructureError> {
    let is_inside = |module: &Module| module.first().is_some_and(|folder| folders.contains(folder));
    let mut arrows = Vec::new();
    for (from, targets) in Crate::read(root)?.edges() {
        let others = targets.iter().filter(|to| is_inside(&from) && is_inside(to) && to[0] != from[0]);
        arrows.extend(others.map(|to| (from.join("/"), to.join("/"))));
    }
    Ok(arrows)
}

/// Number of lines of its sources.
///
/// # Errors
/// If a file cannot be read or is no Rust.
pub(crate) fn lines(root: &Path) -> Result<usize, StructureError> {
    Ok(Crate::read(root)?.sources.values().map(|source| source.lines).sum())
}

/// Number of its named numeric constants outside tests.
///
/// # Errors
/// If a file cannot be read or is no Rust.
pub(crate) fn constants(root: &Path) -> Result<usize, StructureError> {
    Ok(Crate::read(root)?.sources.values().map(|source| source.constants).sum())
}

fn cycles_of(edges: &BTreeMap<Module, BTreeSet<Module>>) -> Vec<Vec<String>> {
    let reach: BTreeMap<&Module, BTreeSet<Module>> =
        edges.keys().map(|module| (module, reached(edges, module))).collect();
    let mut cycles: BTreeSet<Vec<String>> = BTreeSet::new();
    for (module, others) in &reach {
        let own = others.iter().filter(|other| reach.get(other).is_some_and(|back| back.contains(*module)));
        let files: Vec<String> = own.map(|other| other.join("/")).collect();
        if files.len() > 1 {
            cycles.insert(files);
        }
    }
    let mut cycles: Vec<Vec<String>> = cycles.into_iter().collect();
    cycles.sort_by_key(|files| std::cmp::Reverse(files.len()));
    cycles
}

/// Prints the cycles of a crate, its numbers of lines and constants, and the sizes of its traits and structs.
///
/// # Errors
/// If a file cannot be read or is no Rust.
pub(crate) fn run(root: &Path) -> Result<(), StructureError> {
    for files in cycles(root)? {
        println!("{} files: {}", files.len(), files.join(", "));
    }
    for folders in cycles_of_folders(root)? {
        println!("{} folders: {}", folders.len(), folders.join(", "));
        for (from, to) in arrows_between(root, &folders)? {
            println!("  {from} -> {to}");
        }
    }
    println!("{} lines", lines(root)?);
    println!("{} numeric constants", constants(root)?);
    let sizes = Sizes::of([root])?;
    for (name, count) in sizes.large(0) {
        println!("{count} methods: {name}");
    }
    for name in sizes.rare() {
        println!("a method with a default that few types replace: {name}");
    }
    for (name, count) in sizes.wide(MAX_FIELDS) {
        println!("{count} fields: {name}");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Files that may import each other.
    const MAX_CYCLE: usize = 5;

    /// Files at the top of a crate's sources, besides those of programs and libraries.
    const MAX_LOOSE: usize = 12;

    /// Named numeric constants of the crates of the core outside tests.
    const MAX_CONSTANTS: usize = 487;

    /// The crates.
    const CRATES: [&str; 15] = [
        "lissom-motion",
        "lissom-solver",
        "lissom-mechanics",
        "lissom-flexible",
        "lissom-contact",
        "lissom-system",
        "lissom-core",
        "lissom-drawing",
        "lissom-mesh",
        "lissom-model",
        "lissom",
        "lissom-cli",
        "lissom-fmi",
        "lissom-units",
        "lissom-python",
    ];

    /// Crates of the core.
    const OF_CORE: [&str; 5] =
        ["lissom-mechanics", "lissom-flexible", "lissom-contact", "lissom-system", "lissom-core"];

    /// Lines of the sources of all crates. It is raised by a commit that does nothing else, with a row of docs/decisions/growth.md.
    const MAX_LINES: usize = 172_240;

    /// Public modules at the top of the facade.
    const MAX_PUBLIC_MODULES: usize = 12;

    fn sources_of(name: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates").join(name).join("src")
    }

    fn of(name: &str) -> Vec<Vec<String>> {
        cycles(&sources_of(name)).expect("readable sources")
    }

    #[test]
    fn numeric_constants_of_the_core_do_not_become_more() {
        let count = |name| constants(&sources_of(name)).expect("readable sources");
        let found: usize = OF_CORE.map(count).iter().sum();
        assert_eq!(
            found, MAX_CONSTANTS,
            "unify a constant with one of the same meaning, or lower the number"
        );
    }

    #[test]
    fn the_sources_keep_to_their_budget_of_lines() {
        let found: usize =
            CRATES.map(|name| lines(&sources_of(name)).expect("readable sources")).iter().sum();
        assert!(
            found <= MAX_LINES,
            "{found} lines instead of {MAX_LINES}: delete some, or say what they do in docs/decisions/growth.md"
        );
    }

    #[test]
    fn files_of_the_core_import_each_other_in_small_cycles_within_one_folder() {
        let folder = |file: &String| file.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
        for files in OF_CORE.into_iter().flat_map(of) {
            assert!(
                files.len() <= MAX_CYCLE,
                "{} files import each other: {}",
                files.len(),
                files.join(", ")
            );
            // A folder's own file is at its border.
            let inner: BTreeSet<String> = files
                .iter()
                .filter(|file| !files.iter().any(|other| folder(other) == **file))
                .map(folder)
                .collect();
            assert!(inner.len() <= 1, "a cycle across folders: {}", files.join(", "));
        }
    }

    #[test]
    fn files_outside_the_core_import_each_other_in_small_cycles() {
        for files in ["lissom-solver", "lissom-model", "lissom", "lissom-cli"].into_iter().flat_map(of) {
            assert!(
                files.len() <= MAX_CYCLE,
                "{} files import each other: {}",
                files.len(),
                files.join(", ")
            );
        }
    }

    #[test]
    fn folders_stand_on_floors() {
        for name in CRATES {
            let found = cycles_of_folders(&sources_of(name)).expect("readable sources");
            assert!(found.is_empty(), "folders of {name} import each other: {found:?}");
        }
    }

    #[test]
    fn files_of_the_model_and_the_facade_are_in_folders() {
        for name in ["lissom-model", "lissom"] {
            let files = Crate::read(&sources_of(name)).expect("readable sources").sources.into_keys();
            let is_loose = |file: &Module| file.len() == 1 && !sources_of(name).join(&file[0]).is_dir();
            let loose: Vec<Module> = files.filter(|file| is_loose(file) && file[0] != "main").collect();
            assert!(loose.len() <= MAX_LOOSE, "{} files at the top of the sources: {loose:?}", loose.len());
        }
    }

    #[test]
    fn the_model_is_independent_of_the_core() {
        let manifest = sources_of("lissom-model").join("../Cargo.toml");
        let text = std::fs::read_to_string(manifest).expect("a manifest");
        assert!(!text.contains("lissom-core"), "what it needs belongs to a crate below both");
    }

    #[test]
    fn the_program_uses_the_facade_alone() {
        let inner: Vec<&str> = OF_CORE.into_iter().chain(["lissom-model"]).collect();
        let manifest = sources_of("lissom-cli").join("../Cargo.toml");
        let manifest = std::fs::read_to_string(manifest).expect("a manifest");
        let names: Vec<String> = inner.iter().map(|name| name.replace('-', "_")).collect();
        for (file, source) in Crate::read(&sources_of("lissom-cli")).expect("readable sources").sources {
            let imports = source.imports.iter().map(|import| &import.path).chain(&source.paths);
            let mut first = imports.filter_map(|path| path.first());
            assert!(
                !first.any(|name| names.contains(name)),
                "{} passes the facade: export what it needs from `lissom`",
                file.join("/")
            );
        }
        assert!(
            !inner.iter().any(|name| manifest.contains(*name)),
            "the program depends on the facade alone"
        );
    }

    #[test]
    fn the_facade_has_few_public_modules() {
        let text = std::fs::read_to_string(sources_of("lissom").join("lib.rs")).expect("sources");
        let found = text.lines().filter(|line| line.starts_with("pub mod ")).count();
        assert!(found <= MAX_PUBLIC_MODULES, "{found} public modules: put one below another");
    }

    #[test]
    fn cycles_are_found_through_re_exports() {
        let folder = std::env::temp_dir().join(format!("xtask-structure-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("inner")).expect("a folder");
        let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a file");
        write("lib.rs", "mod a;\nmod inner;\n");
        write("a.rs", "use crate::inner::Thing;\npub struct Other(Thing);\nconst A: [f64; 2] = [0.0; 2];\n");
        write("inner/mod.rs", "mod b;\npub use b::Thing;\n");
        write(
            "inner/b.rs",
            "pub struct Thing;\nimpl Thing { fn own(&self) -> crate::a::Other { crate::a::Other(Thing) } }\n",
        );
        let (found, folders) = (cycles(&folder), cycles_of_folders(&folder));
        let count = constants(&folder).expect("a crate");
        write("inner/b.rs", "pub struct Thing;\n#[cfg(test)]\nmod tests { use crate::a::Other; }\n");
        let without = cycles(&folder);
        std::fs::remove_dir_all(&folder).expect("a folder");
        assert_eq!(
            (found.expect("a crate").as_slice(), count),
            ([["a", "inner/b"].map(str::to_owned).to_vec()].as_slice(), 1)
        );
        assert_eq!(folders.expect("a crate"), [["a", "inner"]]);
        assert!(without.expect("a crate").is_empty());
    }
}
