//! Writes a model differently: parts in another order, turned in space, in other units. Works on the
//! text of model files, with the keys of lengths and directions.

use toml::{Table, Value};

/// The tables of a model file in reverse order.
pub(crate) fn reversed(text: &str) -> String {
    let mut blocks: Vec<String> = vec![String::new()];
    for line in text.lines() {
        if line.starts_with('[') {
            blocks.push(String::new());
        }
        if let Some(block) = blocks.last_mut() {
            block.push_str(line);
            block.push('\n');
        }
    }
    // What is before the first table must stay there.
    blocks[1..].reverse();
    blocks.concat()
}

/// A quarter turn or so about an oblique axis: columns are the images of the axes. Pythagorean quadruples keep the
/// numbers exact fractions.
const TURN: [[f64; 3]; 3] = [
    [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0],
    [2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0],
    [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0],
];

/// Keys whose three numbers are a position or direction in global axes.
const DIRECTED: [&str; 18] = [
    "gravity",
    "from",
    "to",
    "through",
    "up",
    "at",
    "at_base",
    "at_tip",
    "axis",
    "second_axis",
    "axis_at_tip",
    "second_axis_at_tip",
    "vector",
    "point",
    "position",
    "velocity",
    "about",
    "curve",
];

/// The model turned about the origin.
pub(crate) fn turned(model: &Table) -> Table {
    let mut model = model.clone();
    for (name, table) in &mut model {
        match table {
            Value::Array(_) if name == "gravity" => turn(table),
            Value::Table(points) if name == "points" => {
                for (_, point) in points.iter_mut() {
                    turn(point);
                }
            }
            Value::Table(entries) if name != "parameters" => {
                for (_, entry) in entries.iter_mut() {
                    turn_entry(name, entry);
                }
                if name == "initial" {
                    turn_keys(entries, &["velocity", "angular_velocity", "about"]);
                }
            }
            _ => {}
        }
    }
    model
}

fn turn_entry(table: &str, entry: &mut Value) {
    let Value::Table(keys) = entry else { return };
    turn_keys(keys, &DIRECTED);
    if let Some(Value::Array(axes)) = keys.get_mut("axes") {
        axes.iter_mut().for_each(turn);
    } else if table == "bodies" {
        let column = |k: usize| Value::Array((0..3).map(|i| Value::Float(TURN[i][k])).collect());
        keys.insert("axes".to_owned(), Value::Array(vec![column(0), column(1)]));
    }
}

fn turn_keys(keys: &mut Table, names: &[&str]) {
    for (_, value) in keys.iter_mut().filter(|(key, _)| names.contains(&key.as_str())) {
        turn(value);
    }
}

fn turn(value: &mut Value) {
    let Value::Array(list) = value else { return };
    if list.len() != 3 {
        return;
    }
    let old: Vec<String> = list.iter().map(words).collect();
    for (component, row) in list.iter_mut().zip(TURN) {
        let terms: Vec<String> =
            old.iter().zip(row).map(|(old, factor)| format!("({factor})*({old})")).collect();
        *component = Value::String(terms.join("+"));
    }
}

/// A number or expression as an expression.
fn words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// The model in millimetres, tonnes and seconds, so that forces stay newtons.
pub(crate) fn in_millimetres(model: &Table) -> Table {
    let mut model = model.clone();
    for (name, table) in &mut model {
        match table {
            Value::Array(_) if name == "gravity" => scale(table, 1e3),
            Value::Table(entries) if name == "points" => {
                entries.iter_mut().for_each(|(_, point)| scale(point, 1e3));
            }
            Value::Table(entries) => {
                for (_, entry) in entries.iter_mut() {
                    if let Value::Table(keys) = entry {
                        keys.iter_mut().for_each(|(key, value)| convert(name, key, value));
                    }
                }
            }
            _ => {}
        }
    }
    model
}

/// Keys of lengths, or of lengths per time.
const LENGTHS: [&str; 17] = [
    "from",
    "to",
    "through",
    "curve",
    "at",
    "at_base",
    "at_tip",
    "point",
    "position",
    "velocity",
    "about",
    "width",
    "height",
    "radius",
    "outer_radius",
    "thickness",
    "center_of_mass",
];

/// Factors of a section's stiffness [N, N m²].
const STIFFNESS: [f64; 6] = [1.0, 1.0, 1.0, 1e6, 1e6, 1e6];

/// Converts one entry. Springs are torsional ones [N m/rad], as in the examples.
fn convert(table: &str, key: &str, value: &mut Value) {
    match (table, key) {
        ("sections", "stiffness") => {
            let Value::Array(diagonal) = value else { return };
            diagonal.iter_mut().zip(STIFFNESS).for_each(|(value, factor)| scale(value, factor));
        }
        ("sections", "mass") => {
            let Value::Table(mass) = value else { return };
            if let Some(value) = mass.get_mut("per_length") {
                scale(value, 1e-6);
            }
        }
        (_, "E" | "G") => scale(value, 1e-6),
        (_, "density") => scale(value, 1e-12),
        (_, "mass") => scale(value, 1e-3),
        ("springs", "stiffness" | "damping") | ("bodies", "inertia") => scale(value, 1e3),
        (_, key) if LENGTHS.contains(&key) => scale(value, 1e3),
        _ => {}
    }
}

/// Multiplies numbers and expressions; names are unchanged, because they are scaled where they are defined.
fn scale(value: &mut Value, factor: f64) {
    match value {
        Value::Array(list) => list.iter_mut().for_each(|value| match value {
            Value::String(text) => *text = format!("({text})*({factor})"),
            other => scale(other, factor),
        }),
        Value::Integer(number) => *value = Value::Float(*number as f64 * factor),
        Value::Float(number) => *number *= factor,
        _ => {}
    }
}

/// Factor of a value of `unit` if lengths are in millimetres.
pub(crate) fn unit_factor(unit: &str) -> f64 {
    if matches!(unit, "m" | "m/s" | "m/s²" | "N m" | "N m s" | "J") { 1e3 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_a_rotation() {
        for i in 0..3 {
            for j in 0..3 {
                let product: f64 = (0..3).map(|k| TURN[i][k] * TURN[j][k]).sum();
                assert!((product - if i == j { 1.0 } else { 0.0 }).abs() < 1e-15);
            }
        }
        let (a, b, c) = (TURN[0], TURN[1], TURN[2]);
        let volume = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        assert!((volume - 1.0).abs() < 1e-15);
    }

    #[test]
    fn tables_are_reversed_after_the_head() {
        assert_eq!(reversed("x = 1\n[a]\nb = 2\n[c]\n"), "x = 1\n[c]\n[a]\nb = 2\n");
    }
}
