//! Data common to all decoders: the names of a model, its parameters and points, and the list of problems.

use std::cell::{Ref, RefCell};
use std::collections::BTreeMap;

use lissom_mechanics::registry::Function;

use crate::files::library::Library;
use crate::format::suggest;
use crate::format::top_level::{Variants, singular};
use crate::parts::{Expanded, Frames, Scope};
use crate::registry::Registry;
use crate::text::report::{Problem, Severity, Sources, Span};
use crate::text::{Node, Table, in_order};
use crate::text::{ROOT, ScopeId};

/// Shared by all decoders of one model.
pub(crate) struct Context<'a> {
    pub(crate) sources: &'a Sources,
    root: &'a Table,
    problems: RefCell<Vec<Problem>>,
    /// Parameters of each scope.
    parameters: RefCell<Vec<BTreeMap<String, f64>>>,
    pub(crate) scopes: &'a [Scope],
    /// Parts by name, with the scopes of their contents.
    pub(crate) instances: &'a BTreeMap<String, ScopeId>,
    pub(crate) frames: Frames,
    pub(crate) library: &'a Library,
    /// The forms of a table.
    pub(crate) forms: fn(&str, &Registry) -> Variants,
    /// Functions of time to try out once the times of the analysis are known, with their owners.
    pub(crate) functions: RefCell<Vec<(Function, Span, String)>>,
}

impl<'a> Context<'a> {
    pub(crate) fn new(model: &'a Expanded, forms: fn(&str, &Registry) -> Variants) -> Self {
        Self {
            sources: &model.sources,
            root: &model.root,
            problems: RefCell::default(),
            parameters: RefCell::new(vec![BTreeMap::new(); model.scopes.len()]),
            scopes: &model.scopes,
            instances: &model.instances,
            frames: Frames::default(),
            library: &model.library,
            forms,
            functions: RefCell::default(),
        }
    }

    /// The parameters that expressions of `scope` may name.
    pub(crate) fn parameters_of(&self, scope: ScopeId) -> Ref<'_, BTreeMap<String, f64>> {
        Ref::map(self.parameters.borrow(), |all| &all[scope])
    }

    /// Makes `value` known as the parameter `name` of `scope`.
    pub(crate) fn set_parameter(&self, scope: ScopeId, name: &str, value: f64) {
        self.parameters.borrow_mut()[scope].insert(name.to_owned(), value);
    }

    /// Makes the parameters of `from` known in `scope`.
    pub(crate) fn inherit_parameters(&self, scope: ScopeId, from: ScopeId) {
        let mut all = self.parameters.borrow_mut();
        all[scope] = all[from].clone();
    }

    /// The parameters of the model itself.
    pub(crate) fn own_parameters(&self) -> BTreeMap<String, f64> {
        self.parameters.borrow()[ROOT].clone()
    }

    /// Notes a problem.
    pub(crate) fn report(&self, problem: Problem) {
        self.problems.borrow_mut().push(problem);
    }

    /// Notes an error and gives nothing.
    pub(crate) fn fail<T>(
        &self,
        span: Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.report(Problem::error(span, message).help(help));
        None
    }

    /// Whether an error was noted.
    pub(crate) fn has_errors(&self) -> bool {
        self.problems.borrow().iter().any(|problem| problem.severity == Severity::Error)
    }

    pub(crate) fn into_problems(self) -> Vec<Problem> {
        self.problems.into_inner()
    }

    /// The value and the key of a word at the top.
    pub(crate) fn top(&self, word: &str) -> Option<(&'a Node, Span)> {
        self.root.get(word).map(|entry| (&entry.node, entry.key))
    }

    /// All words at the top.
    pub(crate) fn tops(&self) -> Vec<(&'a str, Span, &'a Node)> {
        in_order(self.root)
    }

    fn table(&self, table: &str) -> Option<&'a Table> {
        self.root.get(table).and_then(|entry| entry.node.table())
    }

    /// Names in a table of named entries, in the order of the text.
    pub(crate) fn names(&self, table: &str) -> Vec<(&'a str, Span)> {
        self.entries(table).into_iter().map(|(name, span, _)| (name, span)).collect()
    }

    /// Entries of a table of named entries, in the order of the text.
    pub(crate) fn entries(&self, table: &str) -> Vec<(&'a str, Span, &'a Node)> {
        self.table(table).map(in_order).unwrap_or_default()
    }

    /// The entry called `name`.
    pub(crate) fn entry(&self, table: &str, name: &str) -> Option<&'a Node> {
        self.table(table)?.get(name).map(|entry| &entry.node)
    }

    /// The name of an entry as it was written, without those of the parts around it.
    pub(crate) fn local_name<'n>(&self, name: &'n str, node: &Node) -> &'n str {
        name.strip_prefix(self.scopes[node.scope].prefix.as_str()).unwrap_or(name)
    }

    /// Whether `table` has an entry called `name`.
    pub(crate) fn has(&self, table: &str, name: &str) -> bool {
        self.entry(table, name).is_some()
    }

    /// Whether `name` is in `table`; if not, notes an error at `span`.
    pub(crate) fn is_known(&self, table: &'static str, name: &str, span: Span, what: &str) -> bool {
        let known = self.has(table, name);
        // A table that is none has been complained about.
        if !known && self.top(table).is_none_or(|(node, _)| node.table().is_some()) {
            let names = self.names(table);
            let single = singular(table);
            let problem =
                Problem::error(span, format!("{what} names {single} `{name}`, which does not exist"));
            let help = suggest::help(name, names.iter().map(|(known, _)| *known))
                .unwrap_or_else(|| format!("add a table [{table}.{name}]"));
            self.report(problem.label(format!("no such {single}")).help(help));
        }
        known
    }
}
