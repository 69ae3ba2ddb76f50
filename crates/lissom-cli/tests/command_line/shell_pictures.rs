//! Shells in pictures and in files for other programs: their places, and stresses that can be computed by hand.

use std::fmt::Write;
use std::fs;

use lissom::ResultFolder;
use lissom::core::motion::Vector3;
use lissom::motion::{NodeId, RecordedRun};
use lissom::pictures::geometry::{Geometry, Layer, Role, ShellElements, at_rest, poses_at};
use lissom::pictures::picture::{Field, Paint, Picture, Projection, Seen, View, painted};
use serde_json::Value;

use super::export::{parts, series_content};
use crate::support::{Folder, lissom};

/// A plate of 1 m x 0.2 m x 10 mm along x, clamped at one end, with 3 N upward and 500 N outward at the other, and a small one below
/// it with its normal downward.
const PLATES: &str = r#"
lissom = 1
gravity = [0, 0, 0]
[materials.stiff]
E = 1e13
nu = 0
density = 1000
[shells.plate]
corners = [[0, 0, 0], [1, 0, 0], [1, 0.2, 0], [0, 0.2, 0]]
divisions = [8, 4]
thickness = 0.01
material = "stiff"
[shells.below]
corners = [[0.2, 0.05, -0.3], [0.2, 0.15, -0.3], [0.4, 0.15, -0.3], [0.4, 0.05, -0.3]]
divisions = [2, 2]
thickness = 0.01
material = "stiff"
[joints.root]
kind = "clamp"
base = "ground"
tip = "plate.west"
[joints.below]
kind = "clamp"
base = "ground"
tip = "below.west"
[loads.end]
kind = "force"
on = "plate.east"
vector = [500, 0, 3]
[analysis]
kind = "statics"
end = 1
steps = 1
"#;

const AXIAL: f64 = 500.0 / (0.2 * 0.01);

/// Stress of bending at the surface, x from the clamped end [m].
fn bending(x: f64) -> f64 {
    6.0 * 3.0 * (1.0 - x) / (0.2 * 0.01 * 0.01)
}

fn run(folder: &Folder) -> RecordedRun {
    folder.write("plates.toml", PLATES);
    let run = lissom(&["run", "plates.toml", "--out", "out", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    ResultFolder::recorded(&folder.path().join("out")).unwrap()
}

fn close(found: f64, expected: f64, tolerance: f64) -> bool {
    (found - expected).abs() <= tolerance * expected.abs()
}

#[test]
fn shells_are_surfaces_through_their_nodes() {
    let folder = Folder::new("shell-surface");
    let run = run(&folder);
    let geometry = Geometry::new(&run.scene, &run.motion, true);
    let shells: Vec<_> = geometry.pieces.iter().filter(|piece| piece.role == Role::Shell).collect();
    assert_eq!(shells.iter().map(|piece| piece.name.as_str()).collect::<Vec<_>>(), ["plate", "below"]);
    let poses = poses_at(&run.motion, 1.0).unwrap();
    let mesh = shells[0].at(&poses, 1.0).unwrap();
    assert_eq!((mesh.points.len(), mesh.faces.len(), mesh.is_open), (45, 32, true));
    for (point, node) in mesh.points.iter().zip(&run.scene.shells[0].nodes) {
        assert_eq!(*point, poses[*node].position);
    }
    // The end moves by F L³/(3 EI) + 6/5 F L/(GA) upward, 6 µm, and by F L/(EA) outward.
    let high = mesh.points.iter().fold(Vector3::zeros(), |high, point| high.sup(point));
    let sag = 3.0 / (3.0 * 1e13 * 0.2 * 1e-6 / 12.0) + 1.2 * 3.0 / (0.5e13 * 0.002);
    assert!(close(high.z, sag, 1e-2) && close(high.x - 1.0, 500.0 / (1e13 * 0.002), 5e-3), "{high}");
    assert!((geometry.high - Vector3::new(1.0, 0.2, sag)).norm() < 1e-6, "{}", geometry.high);
}

fn area(face: &Seen) -> f64 {
    let points = &face.points;
    let twice = |k: usize| {
        let ([a, b], [c, d]) = (points[k], points[(k + 1) % points.len()]);
        a * d - b * c
    };
    0.5 * (0..points.len()).map(twice).sum::<f64>()
}

fn length(line: &Seen) -> f64 {
    let [[a, b], [c, d]] = line.points[..] else { panic!("a line of two points") };
    (c - a).hypot(d - b)
}

#[test]
fn both_sides_of_shells_are_seen_and_nearer_ones_hide_faces_and_edges() {
    let folder = Folder::new("shell-painted");
    let run = run(&folder);
    let seen = |names: &[&str]| {
        let mut geometry = Geometry::new(&run.scene, &run.motion, true);
        geometry.pieces.retain(|piece| names.contains(&piece.name.as_str()) && piece.role == Role::Shell);
        let projection = Projection::of(&geometry, View::Top);
        painted((&geometry, &Paint::default()), &projection, &poses_at(&run.motion, 0.0).unwrap(), 0.0)
    };
    let sum = |seen: &[Seen], of: fn(&Seen) -> f64, width: fn(f64) -> bool| -> f64 {
        seen.iter().filter(|own| width(own.width.unwrap_or(0.0))).map(of).sum()
    };
    // Area, length of the border and of the edges between elements.
    let measures = |seen: &[Seen]| {
        [
            sum(seen, area, |w| w == 0.0),
            sum(seen, length, |w| w > 1.0),
            sum(seen, length, |w| w > 0.0 && w < 1.0),
        ]
    };
    for (names, expected) in [
        (&["plate"][..], [0.2, 2.4, 3.0 + 7.0 * 0.2]),
        (&["below"], [0.02, 0.6, 0.3]),
        (&["plate", "below"], [0.2, 2.4, 4.4]),
    ] {
        let found = measures(&seen(names));
        assert!((0..3).all(|k| close(found[k], expected[k], 1e-6)), "{names:?} {found:?} {expected:?}");
    }
    let brightest =
        |name| seen(&[name]).iter().map(|own| u32::from(own.shade.iter().max().copied().unwrap())).max();
    assert!(brightest("below") < brightest("plate"), "the back");
    let border = seen(&["plate"]);
    let darkest = |is_line: bool| {
        border.iter().filter(|own| own.width.is_some() == is_line).map(|own| own.shade[0]).min().unwrap()
    };
    assert!(darkest(true) < darkest(false) / 2);
}

#[test]
fn stresses_of_shells_are_those_of_the_beam() {
    let folder = Folder::new("shell-stresses");
    let run = run(&folder);
    let at = at_rest(&poses_at(&run.motion, 1.0).unwrap());
    let plate = ShellElements::new(&run.scene.shells[0]);
    assert_eq!(plate.count(), 32);
    for (element, corners) in run.scene.shells[0].elements.iter().enumerate() {
        let x = corners.iter().map(|node| run.scene.shells[0].positions[*node][0]).sum::<f64>() / 4.0;
        let resultants = plate.resultants(element, &at, (0.0, 0.0));
        let moment = -3.0 * (1.0 - x) / 0.2;
        assert!(close(resultants[0], 500.0 / 0.2, 0.01), "{element} {resultants:?}");
        assert!((resultants[3] - moment).abs() < 0.01 * 15.0, "{x} {resultants:?} {moment}");
        let stress = |layer| plate.von_mises(element, &resultants, layer).unwrap();
        assert!((stress(Layer::Top) - (AXIAL - bending(x)).abs()).abs() < 0.01 * bending(0.0), "{x}");
        assert!((stress(Layer::Bottom) - AXIAL - bending(x)).abs() < 0.01 * bending(0.0), "{x}");
        assert!(close(stress(Layer::Middle), AXIAL, 0.01), "{x}");
        // N²/(2 E t) + 6 M²/(E t³).
        let energy = 2500.0 * 2500.0 / (2.0 * 1e13 * 0.01) + 6.0 * moment * moment / (1e13 * 1e-6);
        assert!(close(plate.energy(element, &at, (0.0, 0.0)), energy, 0.03), "{x} {energy}");
    }
}

#[test]
fn fields_have_colours_and_a_scale() {
    let folder = Folder::new("shell-field");
    let run = run(&folder);
    let drawn = |field| {
        let picture = Picture { times: vec![1.0], field: Some(field), ..Picture::default() };
        picture.draw(&run.scene, &run.motion, "plates").unwrap().svg().unwrap()
    };
    let stress = drawn(Field::StressBottom);
    // The largest stress at the centre of an element, 1/16 m from the end.
    let most = AXIAL + bending(1.0 / 16.0);
    assert!(stress.contains("von Mises stress, bottom [MPa]"), "{stress}");
    let number = |text: &str| {
        text.split(">1").nth(1).and_then(|rest| format!("1{}", rest.split('<').next()?).parse().ok())
    };
    let legend: f64 = number(stress.split("von Mises").nth(1).unwrap()).unwrap();
    assert!(close(1e6 * legend, most, 0.01), "{legend} {most}");
    for (field, words) in [
        (Field::Displacement, "displacement [µm]"),
        (Field::StressTop, "von Mises stress, top [kPa]"),
        (Field::StressMiddle, "von Mises stress, middle [kPa]"),
        (Field::Energy, "strain energy per area [µJ/m²]"),
    ] {
        assert!(field.is_in(&run.scene));
        let svg = drawn(field);
        assert!(svg.contains(words), "{words}");
        assert!(!svg.contains("NaN"));
    }
}

#[test]
fn animations_of_shells_are_skins_over_their_nodes() {
    let folder = Folder::new("shell-gltf");
    let run = run(&folder);
    let export = lissom(&["export", "out", "--format", "gltf", "--out", "plates.glb"], folder.path());
    assert_eq!(export.code, 0, "{}", export.errors);
    let (document, binary) = parts(&folder.path().join("plates.glb"));
    let list = |name: &str| document[name].as_array().unwrap();
    let index = |value: &Value| usize::try_from(value.as_u64().unwrap()).unwrap();
    let start = |accessor: &Value| {
        index(&list("bufferViews")[index(&list("accessors")[index(accessor)]["bufferView"])]["byteOffset"])
    };
    let float = |at: usize| f64::from(f32::from_le_bytes(binary[at..at + 4].try_into().unwrap()));
    let node = list("nodes").iter().find(|node| node["name"] == "plate").unwrap();
    let skin = &list("skins")[index(&node["skin"])];
    let bones = skin["joints"].as_array().unwrap();
    assert_eq!((list("skins").len(), bones.len()), (2, 45));
    let primitive = &list("meshes")[index(&node["mesh"])]["primitives"][0];
    assert_eq!(list("materials")[index(&primitive["material"])]["doubleSided"], true);
    assert_eq!(list("accessors")[index(&primitive["indices"])]["count"], 3 * 2 * 32);
    let attributes = &primitive["attributes"];
    assert_eq!(list("accessors")[index(&attributes["POSITION"])]["count"], 4 * 32);
    // Every vertex, moved from its place in the mesh by its bone, lies at its node in the last frame.
    let poses = poses_at(&run.motion, 1.0).unwrap();
    for vertex in 0..4 * 32 {
        let at = |name: &str, size: usize| start(&attributes[name]) + size * vertex;
        let bone = usize::from(u16::from_le_bytes(binary[at("JOINTS_0", 8)..][..2].try_into().unwrap()));
        assert_eq!(float(at("WEIGHTS_0", 16)), 1.0);
        let place = Vector3::from_fn(|k, _| float(at("POSITION", 12) + 4 * k));
        let bind = start(&skin["inverseBindMatrices"]) + 64 * bone;
        let local = Vector3::from_fn(|row, _| {
            (0..3).map(|column| float(bind + 16 * column + 4 * row) * place[column]).sum::<f64>()
                + float(bind + 48 + 4 * row)
        });
        let node = run.scene.shells[0].nodes[bone];
        assert!((poses[node].transform_point(&local) - poses[node].position).norm() < 1e-6, "{vertex}");
    }
    // The bone of the node that moves most moves as the node does.
    let last = NodeId::new(run.scene.shells[0].nodes[44].index());
    let channels = document["animations"][0]["channels"].as_array().unwrap();
    let channel = channels
        .iter()
        .find(|channel| channel["target"]["node"] == bones[44] && channel["target"]["path"] == "translation");
    let sampler = &document["animations"][0]["samplers"][index(&channel.unwrap()["sampler"])];
    let frames = run.motion.times().len();
    let output = start(&sampler["output"]) + 12 * (frames - 1);
    let end = Vector3::from_fn(|k, _| float(output + 4 * k));
    assert!((end - poses[last].position).norm() < 1e-6 && end.z > 5e-6, "{end}");
}

#[test]
fn series_hold_forces_and_stresses_of_shells() {
    let folder = Folder::new("shell-vtk");
    let run = run(&folder);
    assert_eq!(lissom(&["export", "out", "--format", "vtk"], folder.path()).code, 0);
    let read = |name: &str| fs::read_to_string(folder.path().join("out/vtk").join(name)).unwrap();
    assert!(read("parts.csv").starts_with("number,name,role\n0,plate,shell\n1,below,shell\n"));
    let grid = read("motion-0001.vtu");
    let floats = |name: &str| -> Vec<f64> {
        let bytes = series_content(&grid, name);
        bytes.chunks(4).map(|chunk| f64::from(f32::from_le_bytes(chunk.try_into().unwrap()))).collect()
    };
    let cells = series_content(&grid, "types").len();
    assert!(cells >= 36);
    let thickness = floats("thickness [m]");
    assert_eq!((thickness.len(), thickness[35]), (cells, f64::from(0.01_f32)));
    let shifts = floats("displacement [m]");
    let poses = poses_at(&run.motion, 1.0).unwrap();
    for (point, node) in run.scene.shells[0].nodes.iter().enumerate() {
        let moved = poses[*node].position - Vector3::from(run.scene.shells[0].positions[point]);
        assert!((0..3).all(|k| (shifts[3 * point + k] - moved[k]).abs() < 1e-12), "{point}");
    }
    let [forces, moments, shear] = ["N11, N22, N12 [N/m]", "M11, M22, M12 [N]", "Q13, Q23 [N/m]"].map(floats);
    let [top, middle, bottom] =
        ["top", "middle", "bottom"].map(|layer| floats(&format!("von Mises stress {layer} [Pa]")));
    assert_eq!(
        [forces.len(), moments.len(), shear.len(), top.len()],
        [3 * cells, 3 * cells, 2 * cells, cells]
    );
    for (cell, corners) in run.scene.shells[0].elements.iter().enumerate() {
        let x = corners.iter().map(|node| run.scene.shells[0].positions[*node][0]).sum::<f64>() / 4.0;
        assert!(close(forces[3 * cell], 2500.0, 0.01) && close(shear[2 * cell], 15.0, 0.03), "{cell}");
        assert!((moments[3 * cell] + 15.0 * (1.0 - x)).abs() < 0.15, "{cell}");
        assert!((top[cell] - (AXIAL - bending(x)).abs()).abs() < 0.01 * bending(0.0), "{cell}");
        assert!((bottom[cell] - AXIAL - bending(x)).abs() < 0.01 * bending(0.0), "{cell}");
        assert!(close(middle[cell], AXIAL, 0.01), "{cell}");
    }
    let axes = floats("local axis 1");
    assert!(axes[..3 * 32].chunks(3).all(|axis| (axis[0] - 1.0).abs() < 1e-6 && axis[2] > 0.0));
    // The other one is not loaded.
    assert!((32..36).all(|cell| top[cell] == 0.0 && forces[3 * cell] == 0.0));
}

/// A sheet of irregular triangles of 1 m x 0.5 m x 10 mm, which is pulled with 10 kN/m along x and 4 kN/m along y.
const PULLED: &str = r#"
lissom = 1
[materials.stiff]
E = 70e9
nu = 0
density = 2700
[shells.sheet]
mesh = "sheet.obj"
thickness = 0.01
material = "stiff"
[shells.sheet.sets]
west = { from = [-0.001, -1, -1], to = [0.001, 1, 1] }
east = { from = [0.999, -1, -1], to = [1.001, 1, 1] }
south = { from = [-1, -0.001, -1], to = [2, 0.001, 1] }
north = { from = [-1, 0.499, -1], to = [2, 0.501, 1] }
corner = { near = [0, 0, 0] }
first = { near = [0.28, 0.2, 0] }
second = { near = [0.77, 0.29, 0] }
third = { near = [0.5, 0.21, 0] }
[joints]
x = { kind = "generic", base = "ground", tip = "sheet.west", locked = ["x"] }
y = { kind = "generic", base = "ground", tip = "sheet.south", locked = ["y"] }
z = { kind = "generic", base = "ground", tip = "sheet.corner", locked = ["z", "rx", "ry"] }
[loads]
east = { kind = "force", on = "sheet.east", vector = [5000, 0, 0] }
north = { kind = "force", on = "sheet.north", vector = [0, 4000, 0] }
[outputs]
s1 = { kind = "shell_stress", of = "sheet.first" }
s2 = { kind = "shell_stress", of = "sheet.second" }
s3 = { kind = "shell_stress", of = "sheet.third" }
n1 = { kind = "shell_force", of = "sheet.first" }
n2 = { kind = "shell_force", of = "sheet.second" }
n3 = { kind = "shell_force", of = "sheet.third" }
[analysis]
kind = "statics"
end = 1
steps = 1
"#;

/// Two rows of four cells, each divided along either diagonal; the corner at which a triangle begins varies.
fn triangles() -> String {
    let mut text = String::new();
    for j in 0..3_usize {
        for i in 0..5_usize {
            let is_inside = j == 1 && (1..4).contains(&i);
            let shift = [[0.03, -0.05], [0.0, -0.04], [0.02, 0.04]][(i + 2) % 3];
            let [x, y] = [0, 1]
                .map(|k| [0.25 * i as f64, 0.25 * j as f64][k] + if is_inside { shift[k] } else { 0.0 });
            writeln!(text, "v {x} {y} 0").unwrap();
        }
    }
    let node = |i: usize, j: usize| 5 * j + i + 1;
    for (cell, (i, j)) in (0..8).map(|k| (k, (k % 4, k / 4))) {
        let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        let halves = if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        for (half, mut corners) in halves.into_iter().enumerate() {
            corners.rotate_left((cell + half) % 3);
            writeln!(text, "f {} {} {}", corners[0], corners[1], corners[2]).unwrap();
        }
    }
    text
}

#[test]
fn table_picture_and_series_have_the_same_stresses_on_triangles() {
    let folder = Folder::new("shell-triangles");
    folder.write("sheet.obj", &triangles());
    folder.write("sheet.toml", PULLED);
    let run = lissom(&["run", "sheet.toml", "--out", "out", "-q"], folder.path());
    assert_eq!(run.code, 0, "{}", run.errors);
    let table = fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let value = |name: &str| -> f64 {
        let column = rows[0].iter().position(|own| own.starts_with(name));
        let column = column.unwrap_or_else(|| panic!("{name} in {:?}", rows[0]));
        rows.last().unwrap()[column].parse().unwrap()
    };
    // 10 and 4 N/mm on 10 mm, up to the strain.
    for node in 1..4 {
        for (of, expected) in [("top11", 1e6), ("bottom22", 0.4e6), ("top12", 0.0), ("error", 0.0)] {
            let found = value(&format!("s{node}.{of}"));
            assert!((found - expected).abs() < 30.0, "{node} {of} {found}");
        }
        for (of, expected) in [("n11", 1e4), ("n22", 4e3), ("n12", 0.0)] {
            let found = value(&format!("n{node}.{of}"));
            assert!((found - expected).abs() < 0.3, "{node} {of} {found}");
        }
    }
    let expected = value("s2.mises_top");
    // 1 - 0.4 + 0.16.
    assert!(close(expected, 1e6 * 0.76_f64.sqrt(), 3e-5), "{expected}");
    let recorded = ResultFolder::recorded(&folder.path().join("out")).unwrap();
    let at = at_rest(&poses_at(&recorded.motion, 1.0).unwrap());
    let sheet = ShellElements::new(&recorded.scene.shells[0]);
    for element in 0..sheet.count() {
        let resultants = sheet.resultants(element, &at, (0.0, 0.0));
        let found = sheet.von_mises(element, &resultants, Layer::Top).unwrap();
        assert!(close(found, expected, 1e-2), "picture: {element} {found}");
    }
    assert_eq!(lissom(&["export", "out", "--format", "vtk"], folder.path()).code, 0);
    let grid = fs::read_to_string(folder.path().join("out/vtk/motion-0001.vtu")).unwrap();
    let floats = |name: &str| -> Vec<f64> {
        let bytes = series_content(&grid, name);
        bytes.chunks(4).map(|chunk| f64::from(f32::from_le_bytes(chunk.try_into().unwrap()))).collect()
    };
    let (forces, axes) = (floats("N11, N22, N12 [N/m]"), floats("local axis 1"));
    for element in 0..sheet.count() {
        let own = &forces[3 * element..][..3];
        assert!(
            close(own[0], 1e4, 1e-2) && close(own[1], 4e3, 1e-2) && own[2].abs() < 50.0,
            "{element} {own:?}"
        );
        assert!((axes[3 * element] - 1.0).abs() < 1e-5, "{element}");
    }
}
