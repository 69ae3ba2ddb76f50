//! Positions of mutations in the code, and their replacements. The kinds are those of cargo-mutants.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, UnOp};

use super::MutantsError;
use super::replacement;

/// Folders and files that are broken: elements, joints, schemes, lowering, outputs, sections.
const BROKEN: [&str; 9] = [
    "crates/lissom-mechanics/src/elements",
    "crates/lissom-flexible/src",
    "crates/lissom-contact/src",
    "crates/lissom-mechanics/src/joints",
    "crates/lissom-system/src/schemes",
    "crates/lissom-model/src/lower",
    "crates/lissom-model/src/output",
    "crates/lissom-model/src/sections",
    "crates/lissom-model/src/outputs",
];

/// What is in [`Mutant::before`] for the question whether the mutant is chosen.
pub(super) const CHOSEN: &str = "<chosen>";

/// One change of the code, made by what is inserted before and behind a range of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mutant {
    /// The file, from the project's folder on.
    pub(super) file: String,
    /// Line of the file, from 1 on.
    pub(super) line: usize,
    /// What is done, in which function, and the how manyth such change of the file it is if there are several.
    pub(super) what: String,
    /// Whether the function has changed.
    pub(super) mark: u64,
    /// Bytes of the file.
    pub(super) range: Range<usize>,
    pub(super) before: String,
    pub(super) after: &'static str,
}

impl Mutant {
    /// Key that is the same for the same change as long as neither file nor function get other names.
    pub(super) fn key(&self) -> String {
        format!("{}: {}", self.file, self.what)
    }

    pub(super) fn name(&self) -> String {
        format!("{}:{}: {}", self.file, self.line, self.what)
    }

    #[cfg(test)]
    pub(super) fn named(file: &str, line: usize, what: &str) -> Self {
        let (file, what) = (file.to_owned(), what.to_owned());
        Self { file, line, what, mark: 0, range: 0..0, before: String::new(), after: "" }
    }
}

/// All mutants of the project.
///
/// # Errors
/// If a file cannot be read or is no Rust.
pub(super) fn list(root: &Path) -> Result<Vec<Mutant>, MutantsError> {
    let mut files = Vec::new();
    for path in BROKEN {
        sources(&root.join(path), &mut files).map_err(MutantsError::about(path))?;
    }
    let mut mutants = Vec::new();
    for path in files {
        let text = std::fs::read_to_string(&path).map_err(MutantsError::about(path.display()))?;
        let file = path.strip_prefix(root).unwrap_or(&path).display().to_string();
        mutants.extend(of_file(&file, &text)?);
    }
    Ok(mutants)
}

fn sources(path: &Path, found: &mut Vec<PathBuf>) -> std::io::Result<()> {
    if path.is_file() {
        found.extend(path.extension().is_some_and(|end| end == "rs").then(|| path.to_owned()));
        return Ok(());
    }
    for entry in std::fs::read_dir(path)? {
        sources(&entry?.path(), found)?;
    }
    Ok(())
}

/// Mutants of one file.
fn of_file(file: &str, text: &str) -> Result<Vec<Mutant>, MutantsError> {
    let parsed = syn::parse_file(text)
        .map_err(|error| MutantsError::Source { file: file.to_owned(), what: error.to_string() })?;
    let mut search = Search { file, text, functions: Vec::new(), types: Vec::new(), found: Vec::new() };
    search.visit_file(&parsed);
    let mut counts = BTreeMap::new();
    for mutant in &mut search.found {
        let count: &mut usize = counts.entry(mutant.what.clone()).or_default();
        *count += 1;
        if *count > 1 {
            mutant.what = format!("{} #{count}", mutant.what);
        }
    }
    Ok(search.found)
}

/// FNV-1a of a text.
pub(super) fn mark(text: &str) -> u64 {
    text.bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

struct Search<'a> {
    file: &'a str,
    text: &'a str,
    /// Names and marks of the functions that are entered.
    functions: Vec<(String, u64)>,
    /// Names of the types whose functions are entered.
    types: Vec<String>,
    found: Vec<Mutant>,
}

impl Search<'_> {
    fn text_of(&self, node: &impl Spanned) -> &str {
        &self.text[node.span().byte_range()]
    }

    fn note(&mut self, what: &str, range: Range<usize>, before: String, after: &'static str) {
        let Some((function, mark)) = self.functions.last() else { return };
        let line = self.text[..range.start].matches('\n').count() + 1;
        let what = format!("{what} in {function}");
        self.found.push(Mutant { file: self.file.to_owned(), line, what, mark: *mark, range, before, after });
    }

    /// An expression that is another one if the mutant is chosen.
    fn note_expression(&mut self, what: &str, range: Range<usize>, instead: &str) {
        self.note(what, range, format!("(if {CHOSEN} {{ {instead} }} else {{ "), " })");
    }

    fn function(
        &mut self,
        attributes: &[syn::Attribute],
        signature: &syn::Signature,
        block: &syn::Block,
        all: &impl Spanned,
    ) {
        // What is computed when the program is built cannot be chosen when it runs.
        if is_test(attributes) || signature.constness.is_some() {
            return;
        }
        let name = signature.ident.to_string();
        let name = self.types.last().map_or(name.clone(), |of| format!("{of}::{name}"));
        self.functions.push((name, mark(self.text_of(all))));
        if !block.stmts.is_empty() {
            let inside = block.brace_token.span.open().byte_range().end;
            let whole = block.span().byte_range();
            let body = self.text[inside..whole.end - 1].trim().to_owned();
            for value in replacement::values_of(&signature.output) {
                if value != body {
                    let before = format!(" if {CHOSEN} {{ return {value}; }}");
                    self.note(&format!("return {value}"), inside..inside, before, "");
                }
            }
        }
        visit::visit_block(self, block);
        self.functions.pop();
    }
}

/// Whether something is only there for tests.
fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        syn::Meta::Path(path) => path.is_ident("test"),
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        syn::Meta::NameValue(_) => false,
    })
}

/// Whether `let` is in a condition, which cannot be put in parentheses.
fn has_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(both) => has_let(&both.left) || has_let(&both.right),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Search<'_> {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.function(&item.attrs, &item.sig, &item.block, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.function(&item.attrs, &item.sig, &item.block, item);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.attrs, &item.sig, block, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if !is_test(&item.attrs) {
            self.types.push(self.text_of(&*item.self_ty).to_owned());
            visit::visit_item_impl(self, item);
            self.types.pop();
        }
    }

    fn visit_item_trait(&mut self, item: &'ast syn::ItemTrait) {
        self.types.push(item.ident.to_string());
        visit::visit_item_trait(self, item);
        self.types.pop();
    }

    fn visit_expr_binary(&mut self, both: &'ast syn::ExprBinary) {
        let range = both.left.span().byte_range().start..both.right.span().byte_range().end;
        if !has_let(&both.left) && !has_let(&both.right) {
            let sign = self.text_of(&both.op).to_owned();
            for other in others(&both.op) {
                let instead =
                    format!("({}) {other} ({})", self.text_of(&both.left), self.text_of(&both.right));
                self.note_expression(&format!("replace {sign} with {other}"), range.clone(), &instead);
            }
        }
        visit::visit_expr_binary(self, both);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        if matches!(unary.op, UnOp::Neg(_) | UnOp::Not(_)) {
            let (sign, instead) = (self.text_of(&unary.op), self.text_of(&unary.expr).to_owned());
            let what = format!("delete {sign}");
            self.note_expression(&what, unary.span().byte_range(), &instead);
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_match(&mut self, choice: &'ast syn::ExprMatch) {
        // The program still compiles without an arm where another one takes all.
        let has_rest =
            choice.arms.iter().any(|arm| matches!(arm.pat, syn::Pat::Wild(_)) && arm.guard.is_none());
        for arm in &choice.arms {
            let pattern = self.text_of(&arm.pat).split_whitespace().collect::<Vec<_>>().join(" ");
            if let Some((_, guard)) = &arm.guard {
                let range = guard.span().byte_range();
                if has_let(guard) {
                    continue;
                }
                let what = format!("replace guard of arm {pattern} with");
                self.note(&format!("{what} true"), range.clone(), format!("({CHOSEN} || ("), "))");
                self.note(&format!("{what} false"), range, format!("(!{CHOSEN} && ("), "))");
            } else if has_rest && !matches!(arm.pat, syn::Pat::Wild(_)) {
                let end = arm.pat.span().byte_range().end;
                self.note(&format!("delete arm {pattern}"), end..end, format!(" if !{CHOSEN}"), "");
            }
        }
        visit::visit_expr_match(self, choice);
    }

    // What is computed when the program is built.
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}
    fn visit_variant(&mut self, _: &'ast syn::Variant) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_path(&mut self, _: &'ast syn::Path) {}
    fn visit_angle_bracketed_generic_arguments(&mut self, _: &'ast syn::AngleBracketedGenericArguments) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_expr_repeat(&mut self, repeat: &'ast syn::ExprRepeat) {
        self.visit_expr(&repeat.expr);
    }
}

/// Replacements of an operator.
fn others(operator: &BinOp) -> &'static [&'static str] {
    match operator {
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::Lt(_) => &["==", ">", "<="],
        BinOp::Gt(_) => &["==", "<", ">="],
        BinOp::Le(_) => &[">"],
        BinOp::Ge(_) => &["<"],
        BinOp::Add(_) => &["-", "*"],
        BinOp::Sub(_) | BinOp::Mul(_) => &["+", "/"],
        BinOp::Div(_) => &["%", "*"],
        BinOp::Rem(_) => &["/", "+"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::BitAnd(_) => &["|", "^"],
        BinOp::BitOr(_) => &["&", "^"],
        BinOp::BitXor(_) => &["|", "&"],
        BinOp::AddAssign(_) => &["-=", "*="],
        BinOp::SubAssign(_) | BinOp::MulAssign(_) => &["+=", "/="],
        BinOp::DivAssign(_) => &["%=", "*="],
        BinOp::RemAssign(_) => &["/=", "+="],
        BinOp::BitAndAssign(_) => &["|=", "^="],
        BinOp::BitOrAssign(_) => &["&=", "^="],
        BinOp::BitXorAssign(_) => &["|=", "&="],
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is done in a text, with the text that it does it to.
    fn all(text: &str) -> Vec<(String, String)> {
        let found = of_file("file.rs", text).expect("it is Rust");
        found.into_iter().map(|mutant| (mutant.what, text[mutant.range].to_owned())).collect()
    }

    #[test]
    fn operators_bodies_and_arms_are_found_where_they_stand() {
        let found = all("impl A { fn f(&self) -> bool { -a + é * 2 < 3 } }");
        let has = |what: &str, range: &str| found.contains(&(what.to_owned(), range.to_owned()));
        assert!(has("return true in A::f", "") && has("return false in A::f", ""));
        assert!(has("replace < with == in A::f", "-a + é * 2 < 3"));
        assert!(has("replace + with - in A::f", "-a + é * 2") && has("replace * with / in A::f", "é * 2"));
        assert!(has("delete - in A::f", "-a"));
        let found = all("fn f() { match a { B | C => 1, D if e => 2, _ => 3 }; }");
        let names: Vec<&str> = found.iter().map(|(what, _)| what.as_str()).collect();
        assert_eq!(
            names,
            [
                "return () in f",
                "delete arm B | C in f",
                "replace guard of arm D with true in f",
                "replace guard of arm D with false in f"
            ]
        );
    }

    #[test]
    fn what_the_compiler_computes_and_tests_are_left_alone() {
        assert_eq!(all("const A: f64 = 1.0 + 2.0; const fn f() -> f64 { 1.0 + 2.0 }"), []);
        assert_eq!(all("#[cfg(test)] mod tests { fn f() -> bool { 1 < 2 } } #[test] fn g() { 1 + 2; }"), []);
        assert_eq!(all("fn f() {} fn g() -> bool { false }").len(), 1);
        let found = all("fn f() { if let Some(a) = b && c == d {} }");
        assert_eq!(found.len(), 2, "{found:?}");
    }

    #[test]
    fn equal_changes_of_a_file_are_counted() {
        let found = all("fn f() { a + b; c + d; }");
        assert_eq!(found[1].0, "replace + with - in f");
        assert_eq!(found[3], ("replace + with - in f #2".to_owned(), "c + d".to_owned()));
    }
}
