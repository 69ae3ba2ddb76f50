//! Files of Abaqus and CalculiX (`inp`): nodes, elements, sets, sections and materials of one part.
//!
//! Steps and whatever else does not describe the mesh are left out with a note. Names of sets are compared without
//! regard to case, and are spelled as at their first occurrence.

use std::collections::BTreeMap;

use crate::error::MeshError;
use crate::formats::abaqus_sets::Lists;
use crate::formats::abaqus_types::{Treatment, treatment};
use crate::formats::draft::Draft;
use crate::formats::fields::{Lines, label, quote, real};
use crate::mesh::{Mesh, MeshMaterial, MeshSection, MeshShape};

const ONE_PART: &str = "export each part into a file of its own";

/// A keyword with its parameters and the lines of values after it.
struct Card<'a> {
    line: usize,
    /// In upper case and without blanks.
    keyword: String,
    /// Keys in upper case, with values.
    parameters: Vec<(String, String)>,
    rows: Vec<(usize, &'a str)>,
}

impl Card<'_> {
    fn parameter(&self, key: &str) -> Option<&str> {
        self.parameters.iter().find(|(own, _)| own == key).map(|(_, value)| value.as_str())
    }

    fn required(&self, key: &str) -> Result<&str, MeshError> {
        self.parameter(key).filter(|value| !value.is_empty()).ok_or_else(|| {
            let found = format!("*{} without {key}", self.keyword);
            MeshError::at(self.line, found, format!("add {key}= and a name"))
        })
    }

    /// Fields of the first line of values, with its number.
    fn values(&self) -> (usize, Vec<&str>) {
        self.rows.first().map_or((self.line, Vec::new()), |&(line, row)| (line, fields(row)))
    }
}

/// Fields between commas, without blanks; a comma at the end is followed by none.
fn fields(row: &str) -> Vec<&str> {
    let row = row.strip_suffix(',').unwrap_or(row);
    row.split(',').map(str::trim).collect()
}

fn cards(text: &str) -> Result<(Vec<Card<'_>>, usize), MeshError> {
    let (mut cards, mut lines) = (Vec::<Card>::new(), Lines::new(text));
    while let Some((line, content)) = lines.next() {
        if content.is_empty() || content.starts_with("**") {
            continue;
        }
        if !content.starts_with('*') {
            let Some(card) = cards.last_mut() else {
                let found = format!("{} before the first keyword", quote(content));
                return Err(MeshError::at(line, found, "begin the file with a keyword such as *NODE"));
            };
            card.rows.push((line, content));
            continue;
        }
        let mut head = content.to_owned();
        while head.ends_with(',') {
            let Some((_, more)) = lines.next() else { break };
            head.push_str(more);
        }
        let mut parts = head.split(',').map(str::trim);
        let keyword: String = parts.next().unwrap_or("").split_whitespace().collect();
        let parameters = parts.filter(|part| !part.is_empty()).map(|part| {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            (key.trim().to_uppercase(), value.trim().trim_matches('"').to_owned())
        });
        let keyword = keyword.trim_start_matches('*').to_uppercase();
        cards.push(Card { line, keyword, parameters: parameters.collect(), rows: Vec::new() });
    }
    Ok((cards, lines.number))
}

/// What encloses a keyword.
#[derive(Clone, Copy, Default, PartialEq)]
enum Place {
    /// A part, or nothing.
    #[default]
    Part,
    Assembly,
    Instance,
    Step,
}

#[derive(Default)]
struct Reader {
    draft: Draft,
    node_lists: Lists,
    element_lists: Lists,
    /// Line of each section.
    section_lines: Vec<usize>,
    parts: usize,
    instances: usize,
    place: Place,
    /// By how much the instance is moved.
    translation: [f64; 3],
    /// Keywords that are not read: first line and number.
    left_out: BTreeMap<String, (usize, usize)>,
}

pub(crate) fn read(text: &str) -> Result<Mesh, MeshError> {
    let (cards, last_line) = cards(text)?;
    let mut reader = Reader::default();
    for card in &cards {
        reader.card(card)?;
    }
    reader.finish(last_line)
}

impl Reader {
    fn card(&mut self, card: &Card) -> Result<(), MeshError> {
        if self.place == Place::Step && card.keyword != "ENDSTEP" && card.keyword != "INCLUDE" {
            return Ok(());
        }
        // Reference points of an assembly, and sets of these.
        let is_outside = self.place == Place::Assembly;
        match card.keyword.as_str() {
            "HEADING" | "PREPRINT" | "ENDPART" => {}
            "NODE" | "ELEMENT" if is_outside => self.leave_out(card, " of the assembly"),
            "NSET" | "ELSET" if is_outside && card.parameter("INSTANCE").is_none() => {
                self.leave_out(card, " of the assembly");
            }
            "NODE" => self.nodes(card)?,
            "ELEMENT" => self.elements(card)?,
            "NSET" | "ELSET" => self.set(card)?,
            "SHELLSECTION" | "SHELLGENERALSECTION" | "MEMBRANESECTION" => self.section(card, true)?,
            "SOLIDSECTION" => self.section(card, false)?,
            "MATERIAL" => {
                let name = card.required("NAME")?.to_owned();
                let material = MeshMaterial { name, young: None, poisson: None, density: None };
                self.draft.mesh.materials.push(material);
            }
            "ELASTIC" | "DENSITY" => self.property(card)?,
            "PART" => {
                self.parts += 1;
                self.one_only(card, self.parts)?;
            }
            "INSTANCE" => {
                self.instances += 1;
                self.one_only(card, self.instances)?;
                self.place = Place::Instance;
                self.translate(card)?;
            }
            "ASSEMBLY" | "ENDINSTANCE" => self.place = Place::Assembly,
            "STEP" => {
                self.place = Place::Step;
                self.leave_out(card, "");
            }
            "ENDASSEMBLY" | "ENDSTEP" => self.place = Place::Part,
            "INCLUDE" => {
                let remedy = "insert the text of that file in its place";
                return Err(MeshError::at(card.line, "*INCLUDE of another file", remedy));
            }
            "NGEN" | "NFILL" | "NCOPY" | "NMAP" | "ELGEN" | "ELCOPY" | "SYSTEM" => {
                let found = format!("*{}, which makes or moves nodes or elements", card.keyword);
                return Err(MeshError::at(
                    card.line,
                    found,
                    "export the mesh with all its nodes and elements",
                ));
            }
            _ => self.leave_out(card, ""),
        }
        Ok(())
    }

    fn leave_out(&mut self, card: &Card, where_from: &str) {
        let name = format!("*{}{where_from}", card.keyword);
        self.left_out.entry(name).or_insert((card.line, 0)).1 += 1;
    }

    fn one_only(&self, card: &Card, count: usize) -> Result<(), MeshError> {
        if count < 2 && (card.keyword != "PART" || self.place == Place::Part) {
            return Ok(());
        }
        let found = format!("a second *{}, or one within an assembly", card.keyword);
        Err(MeshError::at(card.line, found, ONE_PART))
    }

    /// Lines after *INSTANCE: a translation, and two points of an axis with an angle.
    fn translate(&mut self, card: &Card) -> Result<(), MeshError> {
        for (index, &(line, row)) in card.rows.iter().enumerate() {
            let numbers: Result<Vec<f64>, MeshError> =
                fields(row).iter().map(|field| real(line, field)).collect();
            let numbers = numbers?;
            if index == 0 {
                for (own, value) in self.translation.iter_mut().zip(numbers) {
                    *own = value;
                }
            } else if numbers.get(6).is_some_and(|&angle| angle != 0.0) {
                let remedy = "export the part without its assembly";
                return Err(MeshError::at(line, "the instance is rotated", remedy));
            }
        }
        Ok(())
    }

    fn from_this_file(card: &Card) -> Result<(), MeshError> {
        if card.parameter("INPUT").is_some() {
            let remedy = "insert the text of that file in its place";
            return Err(MeshError::at(card.line, format!("*{} of another file", card.keyword), remedy));
        }
        Ok(())
    }

    fn nodes(&mut self, card: &Card) -> Result<(), MeshError> {
        Self::from_this_file(card)?;
        if card.parameter("SYSTEM").is_some_and(|system| !system.eq_ignore_ascii_case("R")) {
            let remedy = "export the nodes in rectangular coordinates";
            return Err(MeshError::at(card.line, "nodes in cylindrical or spherical coordinates", remedy));
        }
        for &(line, row) in &card.rows {
            let fields = fields(row);
            let number = label(line, fields[0])?;
            let mut position = [0.0; 3];
            for (own, field) in position.iter_mut().zip(&fields[1..]) {
                // An empty field is zero.
                *own = if field.is_empty() { 0.0 } else { real(line, field)? };
            }
            self.draft.add_node(line, number, position)?;
            if let Some(set) = card.parameter("NSET") {
                self.node_lists.add_number(line, set, number);
            }
        }
        Ok(())
    }

    fn elements(&mut self, card: &Card) -> Result<(), MeshError> {
        Self::from_this_file(card)?;
        let name = card.required("TYPE")?.to_uppercase();
        let set = card.parameter("ELSET");
        if let Some(set) = set {
            self.element_lists.add_set(card.line, set);
        }
        let shape = match treatment(&name) {
            Treatment::Read(shape) => shape,
            Treatment::ReadAs(shape, what) => {
                let note = format!("line {}: elements {name} are read as {what}", card.line);
                self.draft.mesh.notes.push(note);
                shape
            }
            Treatment::LeaveOut => {
                self.leave_out(card, &format!(" of the type {name}"));
                return Ok(());
            }
            Treatment::Reject(remedy) => {
                return Err(MeshError::at(
                    card.line,
                    format!("elements of the type {}", quote(&name)),
                    remedy,
                ));
            }
        };
        let (mut labels, mut start) = (Vec::new(), card.line);
        for &(line, row) in &card.rows {
            if labels.is_empty() {
                start = line;
            }
            for field in fields(row) {
                labels.push(label(line, field)?);
            }
            // The third node of a beam states the direction of its section.
            if shape == MeshShape::Line2 && labels.len() == 4 {
                labels.truncate(3);
            }
            if labels.len() <= shape.node_count() && row.ends_with(',') {
                continue;
            }
            let number = labels[0];
            self.add_element(start, &name, shape, std::mem::take(&mut labels))?;
            if let Some(set) = set {
                self.element_lists.add_number(line, set, number);
            }
        }
        if labels.is_empty() { Ok(()) } else { self.add_element(start, &name, shape, labels) }
    }

    /// Adds an element from its number and those of its nodes.
    fn add_element(
        &mut self,
        line: usize,
        name: &str,
        shape: MeshShape,
        mut labels: Vec<u64>,
    ) -> Result<(), MeshError> {
        let number = labels.remove(0);
        if labels.len() != shape.node_count() {
            let found =
                format!("element {number} has {} nodes, {name} has {}", labels.len(), shape.node_count());
            let remedy = "write all nodes; a line that is continued ends with a comma";
            return Err(MeshError::at(line, found, remedy));
        }
        if shape == MeshShape::Line3 {
            // The middle stands between the ends.
            labels.swap(1, 2);
        }
        self.draft.add_element(line, number, shape, labels).map(|_| ())
    }

    fn set(&mut self, card: &Card) -> Result<(), MeshError> {
        let name = card.required(&card.keyword)?;
        let is_nodes = card.keyword == "NSET";
        let lists = if is_nodes { &mut self.node_lists } else { &mut self.element_lists };
        lists.add_set(card.line, name);
        if let Some(elements) = card.parameter("ELSET").filter(|_| is_nodes) {
            lists.add_nodes_of_elements(card.line, name, elements);
        }
        let is_range = card.parameter("GENERATE").is_some();
        for &(line, row) in &card.rows {
            let mut fields = fields(row);
            fields.retain(|field| !field.is_empty());
            if is_range {
                lists.add_range(line, name, &fields)?;
            } else {
                lists.add_line(line, name, &fields)?;
            }
        }
        Ok(())
    }

    fn section(&mut self, card: &Card, has_thickness: bool) -> Result<(), MeshError> {
        let element_set = card.required("ELSET")?.to_owned();
        if card.parameter("COMPOSITE").is_some() {
            let remedy = "give one thickness and one material";
            return Err(MeshError::at(card.line, "a section of several layers", remedy));
        }
        for ignored in ["OFFSET", "NODALTHICKNESS", "NODAL THICKNESS"] {
            if let Some(value) = card.parameter(ignored) {
                let note =
                    format!("line {}: {ignored} {} of the section is not read", card.line, quote(value));
                self.draft.mesh.notes.push(note);
            }
        }
        let (line, values) = card.values();
        let field = values.first().filter(|field| has_thickness && !field.is_empty());
        let thickness = field.map(|field| real(line, field)).transpose()?;
        if thickness.is_some_and(|thickness| thickness <= 0.0) {
            return Err(MeshError::at(line, "a thickness that is not above zero", "correct the thickness"));
        }
        let material = card.parameter("MATERIAL").map(str::to_owned);
        self.draft.mesh.sections.push(MeshSection { element_set, thickness, material });
        self.section_lines.push(card.line);
        Ok(())
    }

    fn property(&mut self, card: &Card) -> Result<(), MeshError> {
        let (line, values) = card.values();
        let Some(material) = self.draft.mesh.materials.last_mut() else {
            let found = format!("*{} before any *MATERIAL", card.keyword);
            return Err(MeshError::at(card.line, found, "write *MATERIAL, NAME= above"));
        };
        let kind = card.parameter("TYPE").unwrap_or("ISOTROPIC").to_uppercase();
        if !kind.starts_with("ISO") {
            let note =
                format!("line {}: *{} of the type {} is not read", card.line, card.keyword, quote(&kind));
            self.draft.mesh.notes.push(note);
            return Ok(());
        }
        let wanted = if card.keyword == "ELASTIC" { 2 } else { 1 };
        let numbers: Result<Vec<f64>, MeshError> =
            values.iter().take(wanted).map(|field| real(line, field)).collect();
        match *numbers?.as_slice() {
            [young, poisson] => (material.young, material.poisson) = (Some(young), Some(poisson)),
            [density] if wanted == 1 => material.density = Some(density),
            _ => {
                let found = format!("*{} without its {wanted} value(s)", card.keyword);
                let remedy = "write Young's modulus and Poisson's ratio, or the density, in the next line";
                return Err(MeshError::at(line, found, remedy));
            }
        }
        if card.rows.len() > 1 {
            let note = format!("line {line}: only the first line of *{} is read", card.keyword);
            self.draft.mesh.notes.push(note);
        }
        Ok(())
    }

    fn finish(mut self, last_line: usize) -> Result<Mesh, MeshError> {
        self.draft.connect(last_line)?;
        let Draft { mut mesh, nodes, elements, .. } = self.draft;
        for (name, (line, count)) in &self.left_out {
            let more = if *count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
            mesh.notes.push(format!("line {line}: {name} is not read{more}"));
        }
        let none = Lists::default();
        let (sets, notes) = self.element_lists.resolve("elements", &elements, &mesh, &none)?;
        mesh.element_sets = sets;
        mesh.notes.extend(notes);
        let (sets, notes) = self.node_lists.resolve("nodes", &nodes, &mesh, &self.element_lists)?;
        mesh.node_sets = sets;
        mesh.notes.extend(notes);
        for (section, line) in mesh.sections.iter_mut().zip(self.section_lines) {
            let Some(name) = self.element_lists.known(&section.element_set) else {
                let found = format!("a section of the unknown set {}", quote(&section.element_set));
                return Err(MeshError::at(line, found, "define the set, or correct the name"));
            };
            section.element_set.clone_from(name);
            let same = |own: &&MeshMaterial, name: &String| own.name.to_uppercase() == name.to_uppercase();
            if let Some(name) = &mut section.material {
                if let Some(material) = mesh.materials.iter().find(|own| same(own, name)) {
                    name.clone_from(&material.name);
                } else {
                    let note = format!("line {line}: the material {} is not in the file", quote(name));
                    mesh.notes.push(note);
                }
            }
        }
        if self.translation != [0.0; 3] {
            for position in &mut mesh.positions {
                for axis in 0..3 {
                    position[axis] += self.translation[axis];
                }
            }
            mesh.notes.push("positions are those of the instance, which is moved in the assembly".to_owned());
        }
        Ok(mesh)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/formats/abaqus.rs"]
pub(crate) mod tests;
