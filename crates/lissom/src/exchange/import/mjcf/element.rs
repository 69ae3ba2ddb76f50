//! Elements of MJCF with their own and default attributes.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::super::ImportError;
use super::super::xml::{finite_numbers, location};

pub(super) type Attributes = BTreeMap<String, String>;

/// Actuators, whose defaults are one element in the format …
const ACTUATORS: [&str; 5] = ["motor", "position", "velocity", "damper", "general"];
/// … except for their laws.
const OF_ACTUATORS: [&str; 5] = ["ctrlrange", "ctrllimited", "forcerange", "forcelimited", "gear"];

/// Default attributes by class and tag; a class inherits those of its enclosing classes.
pub(super) struct Classes {
    by_name: BTreeMap<String, BTreeMap<String, Attributes>>,
    /// Name of the outermost class.
    main: String,
}

impl Classes {
    /// Reads `<default>` elements, of which there may be several.
    pub(super) fn read(root: Node<'_, '_>) -> Result<Self, ImportError> {
        let mut classes = Self { by_name: BTreeMap::new(), main: "main".to_owned() };
        for node in root.children().filter(|child| child.has_tag_name("default")) {
            let name = node.attribute("class").unwrap_or("main");
            name.clone_into(&mut classes.main);
            let around = classes.by_name.get(name).cloned().unwrap_or_default();
            classes.add(node, name, around)?;
        }
        Ok(classes)
    }

    fn add(
        &mut self,
        node: Node<'_, '_>,
        name: &str,
        mut by_tag: BTreeMap<String, Attributes>,
    ) -> Result<(), ImportError> {
        let elements = || node.children().filter(Node::is_element);
        for element in elements().filter(|element| !element.has_tag_name("default")) {
            let tag = element.tag_name().name();
            let given: Attributes =
                element.attributes().map(|own| (own.name().to_owned(), own.value().to_owned())).collect();
            for other in ACTUATORS.iter().filter(|other| ACTUATORS.contains(&tag) && **other != tag) {
                let shared = given.iter().filter(|(key, _)| OF_ACTUATORS.contains(&key.as_str()));
                let shared = shared.map(|(key, value)| (key.clone(), value.clone()));
                by_tag.entry((*other).to_owned()).or_default().extend(shared);
            }
            by_tag.entry(tag.to_owned()).or_default().extend(given);
        }
        for inner in elements().filter(|element| element.has_tag_name("default")) {
            let name = inner.attribute("class").ok_or_else(|| {
                ImportError::new(format!("{}: a <default> within another has no class", location(inner)))
            })?;
            self.add(inner, name, by_tag.clone())?;
        }
        self.by_name.insert(name.to_owned(), by_tag);
        Ok(())
    }

    /// The default attributes of elements `tag` in a class.
    ///
    /// # Errors
    /// If there is no such class.
    pub(super) fn of(&self, tag: &str, class: Option<&str>) -> Result<Attributes, String> {
        let class = class.unwrap_or(&self.main);
        match self.by_name.get(class) {
            Some(by_tag) => Ok(by_tag.get(tag).cloned().unwrap_or_default()),
            None if class == self.main => Ok(Attributes::new()),
            None => Err(format!("there is no default class `{class}`")),
        }
    }
}

/// An element.
#[derive(Clone)]
pub(super) struct Element {
    pub(super) tag: String,
    pub(super) location: String,
    pub(super) attributes: Attributes,
}

impl Element {
    /// An element without defaults.
    pub(super) fn bare(node: Node<'_, '_>) -> Self {
        let attributes =
            node.attributes().map(|own| (own.name().to_owned(), own.value().to_owned())).collect();
        Self { tag: node.tag_name().name().to_owned(), location: location(node), attributes }
    }

    /// An element without attributes, which is nowhere in a text.
    pub(super) fn empty(tag: &str) -> Self {
        Self { tag: tag.to_owned(), location: String::new(), attributes: Attributes::new() }
    }

    pub(super) fn set(&mut self, key: &str, value: String) {
        self.attributes.insert(key.to_owned(), value);
    }

    pub(super) fn tag(&self) -> &str {
        &self.tag
    }

    /// Elements of one tag as one: later attributes replace earlier ones.
    pub(super) fn merged(mut self, later: Self) -> Self {
        self.attributes.extend(later.attributes);
        self
    }

    /// Location of the element in the description.
    pub(super) fn location(&self) -> &str {
        &self.location
    }

    /// Tag and location of the element, for reports of what is omitted.
    pub(super) fn words(&self) -> String {
        format!("<{}> ({})", self.tag, self.location)
    }

    /// An error about this element.
    pub(super) fn fault(&self, message: impl std::fmt::Display) -> ImportError {
        let name = self.text("name").map(|name| format!(" `{name}`")).unwrap_or_default();
        ImportError::new(format!("{}: <{}>{name}: {message}", self.location, self.tag))
    }

    /// Reports unknown attributes, because they may have an effect.
    pub(super) fn check_known(&self, used: &[&str], harmless: &[&str]) -> Result<(), ImportError> {
        let unknown = self.attributes.keys().find(|key| {
            !used.contains(&key.as_str())
                && !harmless.contains(&key.as_str())
                && *key != "name"
                && *key != "class"
        });
        match unknown {
            None => Ok(()),
            Some(key) => {
                Err(self
                    .fault(format!("the attribute `{key}` is not supported: remove it if it has no effect")))
            }
        }
    }

    pub(super) fn has_tag(&self, tag: &str) -> bool {
        self.tag == tag
    }

    pub(super) fn text(&self, key: &str) -> Option<&str> {
        self.attributes.get(key).map(String::as_str)
    }

    /// All numbers of an attribute, if they are finite.
    pub(super) fn list(&self, key: &str) -> Result<Option<Vec<f64>>, ImportError> {
        let Some(text) = self.text(key) else { return Ok(None) };
        let values = finite_numbers(text);
        values.map(Some).ok_or_else(|| self.fault(format!("`{key}` must be finite numbers, not `{text}`")))
    }

    pub(super) fn numbers<const N: usize>(&self, key: &str) -> Result<Option<[f64; N]>, ImportError> {
        let Some(values) = self.list(key)? else { return Ok(None) };
        let text = self.text(key).unwrap_or_default();
        let wrong = |_| self.fault(format!("`{key}` must be {N} numbers, not `{text}`"));
        values.try_into().map(Some).map_err(wrong)
    }

    /// A number, or its default.
    pub(super) fn number(&self, key: &str, default: f64) -> Result<f64, ImportError> {
        Ok(self.numbers::<1>(key)?.map_or(default, |[value]| value))
    }

    /// A number that must not be negative; default zero.
    pub(super) fn not_negative(&self, key: &str) -> Result<f64, ImportError> {
        let value = self.number(key, 0.0)?;
        if value < 0.0 { Err(self.fault(format!("`{key}` is negative: {value}"))) } else { Ok(value) }
    }

    /// A boolean attribute.
    pub(super) fn flag(&self, key: &str, default: bool) -> Result<bool, ImportError> {
        match self.text(key) {
            None => Ok(default),
            Some("true") => Ok(true),
            Some("false") => Ok(false),
            Some(other) => Err(self.fault(format!("`{key}` must be true or false, not `{other}`"))),
        }
    }
}
