//! Sets of nodes and elements of Abaqus, which may name other sets and refer to numbers that follow later in the file.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::error::MeshError;
use crate::formats::fields::{label, quote};
use crate::formats::set_budget::SetBudget;
use crate::mesh::Mesh;

/// Sets as indices, and notes.
type Resolved = (BTreeMap<String, Vec<usize>>, Vec<String>);

/// Lists of a kind of sets: of nodes or of elements.
#[derive(Default)]
pub(crate) struct Lists {
    /// Names as they are spelled where they are found first: case does not matter.
    names: Vec<String>,
    /// Index of each name in upper case.
    indices: HashMap<String, usize>,
    entries: Vec<List>,
}

/// What a line adds to a set.
struct List {
    line: usize,
    /// Index of its name.
    set: usize,
    entry: Entry,
}

enum Entry {
    /// The set exists, even if it is empty.
    Nothing,
    Number(u64),
    Range {
        first: u64,
        last: u64,
        step: u64,
    },
    Set(String),
    /// For sets of nodes: those of the elements of a set.
    NodesOfElements(String),
}

impl Lists {
    /// The name of a set that exists, without regard to case; also after the name of an instance and a dot.
    pub(crate) fn known(&self, name: &str) -> Option<&String> {
        self.index(name).map(|index| &self.names[index])
    }

    fn index(&self, name: &str) -> Option<usize> {
        let without_instance = name.rsplit('.').next().unwrap_or(name);
        [name, without_instance].iter().find_map(|name| self.indices.get(&name.to_uppercase())).copied()
    }

    fn push(&mut self, line: usize, set: &str, entry: Entry) {
        let next = self.names.len();
        let set_index = *self.indices.entry(set.to_uppercase()).or_insert(next);
        if set_index == next {
            self.names.push(set.to_owned());
        }
        self.entries.push(List { line, set: set_index, entry });
    }

    /// Makes a set, unless there is one.
    pub(crate) fn add_set(&mut self, line: usize, set: &str) {
        self.push(line, set, Entry::Nothing);
    }

    pub(crate) fn add_number(&mut self, line: usize, set: &str, number: u64) {
        self.push(line, set, Entry::Number(number));
    }

    pub(crate) fn add_nodes_of_elements(&mut self, line: usize, set: &str, elements: &str) {
        self.push(line, set, Entry::NodesOfElements(elements.to_owned()));
    }

    /// Adds a line of numbers and names of sets.
    pub(crate) fn add_line(&mut self, line: usize, set: &str, fields: &[&str]) -> Result<(), MeshError> {
        for field in fields {
            let is_number = field.starts_with(|c: char| c.is_ascii_digit() || c == '-');
            let entry = if is_number {
                Entry::Number(label(line, field)?)
            } else {
                Entry::Set(field.trim_matches('"').to_owned())
            };
            self.push(line, set, entry);
        }
        Ok(())
    }

    /// Adds a line of the form first, last, step.
    pub(crate) fn add_range(&mut self, line: usize, set: &str, fields: &[&str]) -> Result<(), MeshError> {
        let numbers: Result<Vec<u64>, MeshError> = fields.iter().map(|field| label(line, field)).collect();
        let (first, last, step) = match numbers?.as_slice() {
            &[first] => (first, first, 1),
            &[first, last] => (first, last, 1),
            &[first, last, step] => (first, last, step),
            other => {
                let found = format!("{} numbers after GENERATE", other.len());
                return Err(MeshError::at(line, found, "write the first, the last and the step"));
            }
        };
        self.push(line, set, Entry::Range { first, last, step });
        Ok(())
    }

    /// The sets as indices, and a note for each set with numbers that are not in the mesh.
    pub(crate) fn resolve(
        &self,
        what: &str,
        numbers: &HashMap<u64, usize>,
        mesh: &Mesh,
        element_lists: &Lists,
    ) -> Result<Resolved, MeshError> {
        let mut ascending: Vec<(u64, usize)> =
            numbers.iter().map(|(&number, &index)| (number, index)).collect();
        ascending.sort_unstable();
        let mut sets: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        let mut missing: BTreeMap<usize, (usize, u64, usize)> = BTreeMap::new();
        // Number of members that a set had when another one included it. Sets only grow.
        let mut included: HashMap<(usize, usize), usize> = HashMap::new();
        let mut budget = SetBudget::of(numbers.len());
        for List { line, set, entry } in &self.entries {
            let members: Vec<usize> = match entry {
                Entry::Nothing => Vec::new(),
                Entry::Number(number) => {
                    let index = numbers.get(number);
                    if index.is_none() {
                        missing.entry(*set).or_insert((*line, *number, 0)).2 += 1;
                    }
                    index.copied().into_iter().collect()
                }
                // Only numbers of the mesh are visited, however long the range.
                Entry::Range { first, last, step } => ascending
                    [ascending.partition_point(|(number, _)| number < first)..]
                    .iter()
                    .take_while(|(number, _)| number <= last)
                    .filter(|(number, _)| (number - first).is_multiple_of(*step))
                    .map(|(_, index)| *index)
                    .collect(),
                Entry::Set(name) => {
                    let index = self.index(name).filter(|index| sets.contains_key(index));
                    let index = index.ok_or_else(|| unknown(*line, what, name))?;
                    let members = &sets[&index];
                    let is_known = included.insert((*set, index), members.len()) == Some(members.len());
                    if is_known { Vec::new() } else { members.iter().copied().collect() }
                }
                Entry::NodesOfElements(name) => {
                    let known = element_lists.known(name).and_then(|name| mesh.element_sets.get(name));
                    mesh.nodes_of(known.ok_or_else(|| unknown(*line, "elements", name))?)
                }
            };
            budget.spend(*line, members.len())?;
            sets.entry(*set).or_default().extend(members);
        }
        let notes = missing.iter().map(|(set, (line, number, count))| {
            let others = if *count > 1 { format!(" and {} more", count - 1) } else { String::new() };
            let set = &self.names[*set];
            format!("line {line}: number {number}{others} of the set of {what} `{set}` is not in the mesh and is left out")
        });
        let notes = notes.collect();
        let sets =
            sets.into_iter().map(|(index, set)| (self.names[index].clone(), set.into_iter().collect()));
        Ok((sets.collect(), notes))
    }
}

fn unknown(line: usize, what: &str, name: &str) -> MeshError {
    let found = format!("no set of {what} {} before this line", quote(name));
    MeshError::at(line, found, "define the set above, or correct the name")
}

#[cfg(test)]
#[path = "../../tests/unit/formats/abaqus_sets.rs"]
mod tests;
