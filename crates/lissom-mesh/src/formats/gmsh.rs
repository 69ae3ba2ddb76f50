//! Files of Gmsh (`msh`), in ASCII, of the versions 2 and 4.1.
//!
//! A physical group becomes a set of elements and a set of the nodes that these touch, both with the name of the group.
//! One without a name is called after its dimension and tag, such as `surface 3`.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::error::MeshError;
use crate::formats::draft::Draft;
use crate::formats::fields::{Lines, label, quote, real, whole};
use crate::formats::gmsh_types::{ElementType, element_type, in_order_of_abaqus};
use crate::formats::set_budget::SetBudget;
use crate::mesh::Mesh;

const AS_ASCII: &str =
    "save it in Gmsh as ASCII of version 2 or 4.1 (Mesh.Binary = 0, Mesh.MshFileVersion = 4.1)";
const LINEAR: &str = "mesh with elements of first or second order, without pyramids";
const AGAIN: &str = "the file is damaged or incomplete: save it again";

/// Dimension and tag, of an entity or of a physical group.
type Tag = (u8, i64);

#[derive(Clone, Copy, PartialEq)]
enum Version {
    Two,
    Four,
}

#[derive(Default)]
struct Reader<'a> {
    lines: Option<Lines<'a>>,
    version: Option<Version>,
    draft: Draft,
    /// Names of physical groups.
    names: BTreeMap<Tag, String>,
    /// Tags of the physical groups of each entity. In version 2 every group is an entity.
    groups: HashMap<Tag, Vec<i64>>,
    /// Entity and index of each element.
    members: Vec<(Tag, usize)>,
    /// Elements of version 2 by their nodes: it saves an element once for each of its groups.
    known: HashMap<Vec<u64>, usize>,
    /// Entity, line and nodes of points.
    touched: Vec<(Tag, usize, Vec<u64>)>,
    /// Types of elements of which nodes are left out.
    reduced: BTreeSet<&'static str>,
    /// Names of other sections, with their lines.
    other_sections: BTreeMap<&'a str, usize>,
}

pub(crate) fn read(text: &str) -> Result<Mesh, MeshError> {
    let mut reader = Reader { lines: Some(Lines::new(text)), ..Reader::default() };
    reader.sections()?;
    reader.finish()
}

impl<'a> Reader<'a> {
    fn next_line(&mut self) -> Option<(usize, &'a str)> {
        self.lines.as_mut()?.find(|(_, content)| !content.is_empty())
    }

    fn last_line(&self) -> usize {
        self.lines.as_ref().map_or(0, |lines| lines.number)
    }

    /// Fields of the next line of a section.
    fn record(&mut self, at_least: usize) -> Result<(usize, Vec<&'a str>), MeshError> {
        let Some((line, content)) = self.next_line() else {
            return Err(MeshError::at(self.last_line(), "the file ends within a section", AGAIN));
        };
        let fields: Vec<&str> = content.split_whitespace().collect();
        if content.starts_with('$') || fields.len() < at_least {
            let found = format!("{} instead of a line of at least {at_least} numbers", quote(content));
            return Err(MeshError::at(line, found, AGAIN));
        }
        Ok((line, fields))
    }

    /// The first field of the next line, a number.
    fn count(&mut self) -> Result<u64, MeshError> {
        let (line, fields) = self.record(1)?;
        whole(line, fields[0])
    }

    /// The end of a section.
    fn end(&mut self, section: &str) -> Result<(), MeshError> {
        match self.next_line() {
            Some((_, content)) if content.strip_prefix("$End") == section.strip_prefix('$') => Ok(()),
            Some((line, content)) => {
                let found = format!("{} where {section} ends according to its counts", quote(content));
                Err(MeshError::at(line, found, AGAIN))
            }
            None => Err(MeshError::at(self.last_line(), format!("{section} does not end"), AGAIN)),
        }
    }

    fn sections(&mut self) -> Result<(), MeshError> {
        while let Some((line, section)) = self.next_line() {
            let Some(version) = self.version else {
                if section == "$MeshFormat" {
                    self.format()?;
                    self.end(section)?;
                    continue;
                }
                let found = format!("{} instead of $MeshFormat", quote(section));
                return Err(MeshError::at(line, found, AS_ASCII));
            };
            match (section, version) {
                ("$PhysicalNames", _) => self.physical_names()?,
                ("$Entities", Version::Four) => self.entities()?,
                ("$Nodes", Version::Two) => self.nodes_of_version_2()?,
                ("$Nodes", Version::Four) => self.nodes_of_version_4()?,
                ("$Elements", Version::Two) => self.elements_of_version_2()?,
                ("$Elements", Version::Four) => self.elements_of_version_4()?,
                ("$PartitionedEntities", _) => {
                    let remedy = "remove the partition in Gmsh (Mesh, Unpartition), and save it again";
                    return Err(MeshError::at(line, "the mesh is divided into partitions", remedy));
                }
                (other, _) if other.starts_with('$') && !other.starts_with("$End") => {
                    self.other_sections.entry(other).or_insert(line);
                    self.skip(line, other)?;
                    continue;
                }
                (other, _) => {
                    let found = format!("{} instead of the beginning of a section", quote(other));
                    return Err(MeshError::at(line, found, AGAIN));
                }
            }
            self.end(section)?;
        }
        Ok(())
    }

    fn skip(&mut self, line: usize, section: &str) -> Result<(), MeshError> {
        while let Some((_, content)) = self.next_line() {
            if content.strip_prefix("$End") == section.strip_prefix('$') {
                return Ok(());
            }
        }
        Err(MeshError::at(line, format!("{} does not end", quote(section)), AGAIN))
    }

    fn format(&mut self) -> Result<(), MeshError> {
        let (line, fields) = self.record(2)?;
        self.version = match fields[0] {
            "4.1" => Some(Version::Four),
            other if other == "2" || other.starts_with("2.") => Some(Version::Two),
            other => {
                let found = format!("version {} of the format", quote(other));
                return Err(MeshError::at(line, found, AS_ASCII));
            }
        };
        if fields[1] == "0" {
            return Ok(());
        }
        Err(MeshError::at(line, "the file is binary", AS_ASCII))
    }

    fn physical_names(&mut self) -> Result<(), MeshError> {
        for _ in 0..self.count()? {
            let (line, fields) = self.record(3)?;
            let group = (whole(line, fields[0])?, whole(line, fields[1])?);
            // Names may contain blanks.
            let name = fields[2..].join(" ").trim_matches('"').to_owned();
            self.names.insert(group, name);
        }
        Ok(())
    }

    fn entities(&mut self) -> Result<(), MeshError> {
        let (line, fields) = self.record(4)?;
        for dimension in 0..4_u8 {
            // A point has a position, others a box.
            let first = if dimension == 0 { 4 } else { 7 };
            for _ in 0..whole::<u64>(line, fields[usize::from(dimension)])? {
                let (line, fields) = self.record(first + 1)?;
                let tag = whole(line, fields[0])?;
                let count: usize = whole(line, fields[first])?;
                let tags = fields[first + 1..].iter().take(count);
                let tags: Result<Vec<i64>, MeshError> = tags.map(|field| whole(line, field)).collect();
                let tags = tags?;
                if tags.len() < count {
                    let found = format!("{count} physical groups of an entity, but {} tags", tags.len());
                    return Err(MeshError::at(line, found, AGAIN));
                }
                self.groups.insert((dimension, tag), tags);
            }
        }
        Ok(())
    }

    fn add_node(&mut self, line: usize, number: u64, fields: &[&str]) -> Result<(), MeshError> {
        let position = [real(line, fields[0])?, real(line, fields[1])?, real(line, fields[2])?];
        self.draft.add_node(line, number, position).map(|_| ())
    }

    fn nodes_of_version_2(&mut self) -> Result<(), MeshError> {
        for _ in 0..self.count()? {
            let (line, fields) = self.record(4)?;
            self.add_node(line, label(line, fields[0])?, &fields[1..])?;
        }
        Ok(())
    }

    fn nodes_of_version_4(&mut self) -> Result<(), MeshError> {
        for _ in 0..self.count()? {
            let (line, fields) = self.record(4)?;
            let mut numbers = Vec::new();
            for _ in 0..whole::<u64>(line, fields[3])? {
                let (line, fields) = self.record(1)?;
                numbers.push(label(line, fields[0])?);
            }
            for number in numbers {
                let (line, fields) = self.record(3)?;
                self.add_node(line, number, &fields)?;
            }
        }
        Ok(())
    }

    fn known_type(line: usize, field: &str) -> Result<ElementType, MeshError> {
        element_type(whole(line, field)?).ok_or_else(|| {
            MeshError::at(line, format!("an element of the unknown type {}", quote(field)), LINEAR)
        })
    }

    fn elements_of_version_2(&mut self) -> Result<(), MeshError> {
        for _ in 0..self.count()? {
            let (line, fields) = self.record(4)?;
            let kind = Self::known_type(line, fields[1])?;
            let tag_count: usize = whole(line, fields[2])?;
            let start = tag_count.saturating_add(3).min(fields.len());
            let group: i64 = if tag_count > 0 { whole(line, fields[3])? } else { 0 };
            let entity = (kind.dimension, group);
            if group != 0 {
                self.groups.insert(entity, vec![group]);
            }
            self.add_element(line, entity, &kind, fields[0], &fields[start..])?;
        }
        Ok(())
    }

    fn elements_of_version_4(&mut self) -> Result<(), MeshError> {
        for _ in 0..self.count()? {
            let (line, fields) = self.record(4)?;
            let entity = (whole(line, fields[0])?, whole(line, fields[1])?);
            let kind = Self::known_type(line, fields[2])?;
            for _ in 0..whole::<u64>(line, fields[3])? {
                let (line, fields) = self.record(2)?;
                self.add_element(line, entity, &kind, fields[0], &fields[1..])?;
            }
        }
        Ok(())
    }

    fn add_element(
        &mut self,
        line: usize,
        entity: Tag,
        kind: &ElementType,
        number: &str,
        nodes: &[&str],
    ) -> Result<(), MeshError> {
        let number = label(line, number)?;
        let nodes: Result<Vec<u64>, MeshError> = nodes.iter().map(|field| label(line, field)).collect();
        let nodes = nodes?;
        if nodes.len() != kind.node_count {
            let found = format!("a {} with {} nodes, it has {}", kind.name, nodes.len(), kind.node_count);
            return Err(MeshError::at(line, found, AGAIN));
        }
        let Some(shape) = kind.shape else {
            if kind.dimension > 0 {
                return Err(MeshError::at(line, format!("a {}, which is not read", kind.name), LINEAR));
            }
            self.touched.push((entity, line, nodes));
            return Ok(());
        };
        let whole = nodes.len();
        let nodes = in_order_of_abaqus(shape, &nodes);
        if nodes.len() < whole && self.reduced.insert(kind.name) {
            let note = format!(
                "line {line}: a {} is read as one of {}: nodes in the middle of its faces are left out",
                kind.name,
                nodes.len()
            );
            self.draft.mesh.notes.push(note);
        }
        let index = if let Some(&index) = self.known.get(&nodes) {
            index
        } else {
            let index = self.draft.add_element(line, number, shape, nodes.clone())?;
            if self.version == Some(Version::Two) {
                self.known.insert(nodes, index);
            }
            index
        };
        self.members.push((entity, index));
        Ok(())
    }

    /// Names of the sets of an entity.
    fn set_names(&self, entity: Tag) -> Vec<String> {
        let name = |&tag: &i64| {
            // A negative tag states that the normal is opposite.
            let group = (entity.0, tag.abs());
            self.names.get(&group).cloned().unwrap_or_else(|| {
                let kinds = ["point", "curve", "surface", "volume"];
                format!("{} {}", kinds[usize::from(group.0).min(3)], group.1)
            })
        };
        self.groups.get(&entity).map(|tags| tags.iter().map(name).collect()).unwrap_or_default()
    }

    fn finish(mut self) -> Result<Mesh, MeshError> {
        for (section, line) in &self.other_sections {
            let note = format!("line {line}: {} is not read", quote(section));
            self.draft.mesh.notes.push(note);
        }
        let last_line = self.last_line();
        self.draft.connect(last_line)?;
        let (mut node_sets, mut element_sets) = (BTreeMap::new(), BTreeMap::new());
        let mut members: BTreeMap<Tag, [Vec<usize>; 2]> = BTreeMap::new();
        for &(entity, index) in &self.members {
            let [elements, nodes] = members.entry(entity).or_default();
            elements.push(index);
            nodes.extend(&self.draft.mesh.elements[index].nodes);
        }
        let has_sets = |entity| self.groups.get(entity).is_some_and(|tags| !tags.is_empty());
        for (entity, line, numbers) in self.touched.iter().filter(|own| has_sets(&own.0)) {
            let [_, nodes] = members.entry(*entity).or_default();
            for &number in numbers {
                nodes.push(self.draft.node(*line, number)?);
            }
        }
        let mut budget = SetBudget::of(self.draft.mesh.positions.len() + self.draft.mesh.elements.len());
        for (entity, [elements, mut nodes]) in members {
            nodes.sort_unstable();
            nodes.dedup();
            for name in self.set_names(entity) {
                budget.spend(last_line, elements.len() + nodes.len())?;
                if !elements.is_empty() {
                    member(&mut element_sets, &name).extend(&elements);
                }
                member(&mut node_sets, &name).extend(&nodes);
            }
        }
        for set in node_sets.values_mut().chain(element_sets.values_mut()) {
            set.sort_unstable();
            set.dedup();
        }
        self.draft.mesh.node_sets = node_sets;
        self.draft.mesh.element_sets = element_sets;
        Ok(self.draft.mesh)
    }
}

/// The members of a set, which is made if there is none. No name is copied for one that exists.
fn member<'a>(sets: &'a mut BTreeMap<String, Vec<usize>>, name: &str) -> &'a mut Vec<usize> {
    if !sets.contains_key(name) {
        sets.insert(name.to_owned(), Vec::new());
    }
    sets.entry(name.to_owned()).or_default()
}

#[cfg(test)]
#[path = "../../tests/unit/formats/gmsh.rs"]
pub(crate) mod tests;
