//! `lissom export` as other programs see it: the files, read back number by number.

use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::DeflateDecoder;
use lissom::core::motion::Vector3;
use lissom::motion::NodeId;
use lissom::{Record, ResultFolder};
use serde_json::Value;

use crate::support::{CANTILEVER, Folder, example, lissom};

fn number<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    bytes[at..at + N].try_into().unwrap()
}

/// Files of an archive.
fn unzipped(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    let mut at = 0;
    while bytes[at..].starts_with(b"PK\x03\x04") {
        let size = u32::from_le_bytes(number(bytes, at + 18)) as usize;
        let length = usize::from(u16::from_le_bytes(number(bytes, at + 26)));
        let name = String::from_utf8(bytes[at + 30..at + 30 + length].to_vec()).unwrap();
        let start = at + 30 + length;
        let mut content = Vec::new();
        DeflateDecoder::new(&bytes[start..start + size]).read_to_end(&mut content).unwrap();
        files.push((name, content));
        at = start + size;
    }
    assert!(bytes[at..].starts_with(b"PK\x01\x02"));
    files
}

/// The content of an array and its header.
fn array(bytes: &[u8]) -> (String, &[u8]) {
    let length = usize::from(u16::from_le_bytes(number(bytes, 8)));
    (String::from_utf8(bytes[10..10 + length].to_vec()).unwrap(), &bytes[10 + length..])
}

fn run_four_bar(folder: &Folder) {
    let run = lissom(
        &["run", &example("four-bar"), "--set", "analysis.end=1", "--out", "out", "-q"],
        folder.path(),
    );
    assert_eq!(run.code, 0, "{}", run.errors);
}

#[test]
fn arrays_hold_the_table_with_its_units() {
    let folder = Folder::new("export-npz");
    run_four_bar(&folder);
    let export = lissom(&["export", "out", "--format", "npz"], folder.path());
    assert_eq!((export.code, export.output.trim()), (0, "out/results.npz"), "{}", export.errors);
    let files = unzipped(&fs::read(folder.path().join("out/results.npz")).unwrap());
    let of = |name: &str| &files.iter().find(|(known, _)| known == name).unwrap().1;
    let out = folder.path().join("out");
    let table = Record::from_csv(&fs::read_to_string(out.join("history.csv")).unwrap()).unwrap();
    let (header, content) = array(of("values.npy"));
    let (rows, columns) = (table.times.len(), table.columns.len());
    assert!(header.contains(&format!("'shape': ({rows}, {columns},)")), "{header}");
    for (row, column) in [(0, 0), (rows / 2, 3), (rows - 1, columns - 1)] {
        let value = f64::from_le_bytes(number(content, 8 * (row * columns + column)));
        assert_eq!(value, table.values[column][row]);
    }
    let (header, content) = array(of("units.npy"));
    assert!(header.contains("'descr': '<U"), "{header}");
    let letters: String =
        content.chunks(4).filter_map(|c| char::from_u32(u32::from_le_bytes(number(c, 0)))).collect();
    assert!(letters.contains("N m"), "{letters}");
    let motion = ResultFolder::recorded(&out).unwrap().motion;
    let (header, content) = array(of("positions.npy"));
    let nodes = motion.reference().len();
    let last_node = NodeId::new(nodes - 1);
    assert!(header.contains(&format!(", {nodes}, 3,)")), "{header}");
    let last = content.len() - 24;
    let place: Vec<f64> = (0..3).map(|k| f64::from_le_bytes(number(content, last + 8 * k))).collect();
    assert_eq!(Vector3::from_row_slice(&place), motion.pose(motion.times().len() - 1, last_node).position);
}

/// The two parts of a binary glTF file.
pub(crate) fn parts(file: &Path) -> (Value, Vec<u8>) {
    let bytes = fs::read(file).unwrap();
    assert_eq!((&bytes[..4], u32::from_le_bytes(number(&bytes, 4))), (&b"glTF"[..], 2));
    assert_eq!(u32::from_le_bytes(number(&bytes, 8)) as usize, bytes.len());
    let length = u32::from_le_bytes(number(&bytes, 12)) as usize;
    assert_eq!(&bytes[16..20], b"JSON");
    let document = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    assert_eq!(&bytes[24 + length..28 + length], b"BIN\0");
    (document, bytes[28 + length..].to_vec())
}

#[test]
fn animations_move_as_the_motion_does() {
    let folder = Folder::new("export-gltf");
    run_four_bar(&folder);
    let export =
        lissom(&["export", "out", "--format", "gltf", "--frames", "21", "--out", "bar.glb"], folder.path());
    assert_eq!((export.code, export.output.trim()), (0, "bar.glb"), "{}", export.errors);
    let (document, binary) = parts(&folder.path().join("bar.glb"));
    assert_eq!(document["buffers"][0]["byteLength"], binary.len());
    let list = |name: &str| document[name].as_array().unwrap();
    let index = |value: &Value| usize::try_from(value.as_u64().unwrap()).unwrap();
    // Every accessor lies within its view, and every view within the buffer.
    for accessor in list("accessors") {
        let view = &list("bufferViews")[index(&accessor["bufferView"])];
        let size = match accessor["componentType"].as_u64().unwrap() {
            5123 => 2,
            _ => 4,
        } * match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        assert_eq!(index(&accessor["count"]) * size, index(&view["byteLength"]), "{accessor}");
        assert!(index(&view["byteOffset"]) + index(&view["byteLength"]) <= binary.len());
        assert_eq!(index(&view["byteOffset"]) % 4, 0);
    }
    let floats = |accessor: &Value| -> Vec<f32> {
        let view = &list("bufferViews")[index(&list("accessors")[index(accessor)]["bufferView"])];
        let start = index(&view["byteOffset"]);
        (start..start + index(&view["byteLength"]))
            .step_by(4)
            .map(|at| f32::from_le_bytes(number(&binary, at)))
            .collect()
    };
    // Three beams are skins; their bones are as many as sections, and each vertex follows one that there is.
    assert_eq!(list("skins").len(), 3);
    // A section at the end of a beam goes where the node goes that carries it.
    let run = ResultFolder::recorded(&folder.path().join("out")).unwrap();
    let beam = &run.scene.beams[0];
    let skin = list("skins").iter().position(|skin| {
        let bone = &list("nodes")[index(&skin["joints"][0])]["name"];
        bone.as_str().unwrap().starts_with(&beam.name)
    });
    let bones = list("skins")[skin.unwrap()]["joints"].as_array().unwrap();
    let last = bones.last().unwrap();
    let animation = &document["animations"][0];
    let sampler = animation["channels"]
        .as_array()
        .unwrap()
        .iter()
        .find(|channel| channel["target"]["node"] == *last && channel["target"]["path"] == "translation");
    let sampler = &animation["samplers"][index(&sampler.unwrap()["sampler"])];
    let (times, places) = (floats(&sampler["input"]), floats(&sampler["output"]));
    assert_eq!((times.len(), places.len()), (21, 63));
    let node = *beam.nodes.last().unwrap();
    let frames = run.motion.times().len();
    for k in [0, 7, 20] {
        let frame = k * (frames - 1) / 20;
        let place = run.motion.pose(frame, node).position;
        assert!((f64::from(times[k]) - run.motion.times()[frame]).abs() < 1e-6);
        for axis in 0..3 {
            assert!((f64::from(places[3 * k + axis]) - place[axis]).abs() < 1e-6, "{k} {place}");
        }
    }
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
}

/// The bytes of an array of a file of a series.
pub(crate) fn series_content(grid: &str, name: &str) -> Vec<u8> {
    let (_, rest) = grid.split_once(&format!("Name=\"{name}\"")).unwrap();
    let (_, rest) = rest.split_once('>').unwrap();
    let bytes = crate::command_line::view::decoded(rest.split_once('<').unwrap().0);
    assert_eq!(u64::from_le_bytes(number(&bytes, 0)) as usize, bytes.len() - 8, "{name}");
    bytes[8..].to_vec()
}

#[test]
fn series_hold_sections_with_their_forces() {
    let folder = Folder::new("export-vtk");
    folder.write("bar.toml", CANTILEVER);
    assert_eq!(lissom(&["run", "bar.toml", "--out", "out", "-q"], folder.path()).code, 0);
    fs::create_dir(folder.path().join("out/vtk")).unwrap();
    folder.write("out/vtk/mine.csv", "a file of somebody else");
    let export = lissom(&["export", "out", "--format", "vtk"], folder.path());
    assert_eq!((export.code, export.output.trim()), (0, "out/vtk/motion.pvd"), "{}", export.errors);
    let read = |name: &str| fs::read_to_string(folder.path().join("out/vtk").join(name)).unwrap();
    let series = read("motion.pvd");
    assert_eq!(series.matches("<DataSet").count(), 5);
    assert!(series.contains("timestep=\"1\" file=\"motion-0004.vtu\""), "{series}");
    assert!(read("parts.csv").starts_with("number,name,role\n0,bar,beam\n"));
    let grid = read("motion-0004.vtu");
    let content = |name: &str| series_content(&grid, name);
    let doubles: Vec<f64> =
        content("points").chunks(8).map(|chunk| f64::from_le_bytes(number(chunk, 0))).collect();
    let moments: Vec<f32> =
        content("section moment [N m]").chunks(4).map(|chunk| f32::from_le_bytes(number(chunk, 0))).collect();
    assert_eq!(doubles.len(), moments.len());
    // The bar of 1 m under 3 N at its tip: bending moment 3 N (1 m - x), wherever its points are.
    let of_bar = 41 * 20;
    let mut most = 0.0_f64;
    for point in 0..of_bar {
        let bending = f64::from(moments[3 * point + 1]).hypot(f64::from(moments[3 * point + 2]));
        most = most.max((bending - 3.0 * (1.0 - doubles[3 * point])).abs());
    }
    assert!(most < 0.02, "{most}");
    // The tip has gone up by F L³/(3 EI) = 5 mm.
    let highest = doubles[..3 * of_bar].chunks(3).map(|point| point[2]).fold(0.0, f64::max);
    assert!((highest - 0.005 - 0.02).abs() < 1e-4, "{highest}");
    let offsets: Vec<i64> =
        content("offsets").chunks(8).map(|chunk| i64::from_le_bytes(number(chunk, 0))).collect();
    assert_eq!(i64::try_from(content("connectivity").len()).unwrap(), 8 * offsets.last().unwrap());
    assert_eq!(content("types").len(), offsets.len());
    // Another run takes away what was handed over of the former one, and nothing else.
    assert_eq!(lissom(&["run", "bar.toml", "--out", "out", "-q"], folder.path()).code, 0);
    let left: Vec<_> =
        fs::read_dir(folder.path().join("out/vtk")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, ["mine.csv"]);
    for (args, words) in [
        (vec!["export", "out", "--format", "step"], "possible values: gltf, netcdf, npz, parquet, vtk, urdf"),
        (vec!["export", "nowhere", "--format", "npz"], "history.csv"),
        (vec!["export", "bar.toml", "--format", "npz"], "specify a folder of results"),
        (vec!["export", "out", "--format", "npz", "--frames", "0"], "0 is not in"),
    ] {
        let export = lissom(&args, folder.path());
        assert_eq!(export.code, 2, "{args:?}");
        assert!(export.errors.contains(words), "{args:?} {}", export.errors);
    }
}

/// A reader of the header of a NetCDF file.
struct Header<'a>(&'a [u8], usize);

impl Header<'_> {
    fn number(&mut self) -> usize {
        self.1 += 4;
        u32::from_be_bytes(number(self.0, self.1 - 4)) as usize
    }

    fn text(&mut self) -> String {
        let length = self.number();
        let text = String::from_utf8(self.0[self.1..self.1 + length].to_vec()).unwrap();
        self.1 += length.next_multiple_of(4);
        text
    }

    fn attributes(&mut self) -> Vec<(String, String)> {
        let tag = self.number();
        let count = self.number();
        assert_eq!(tag, if count == 0 { 0 } else { 12 });
        let mut all = Vec::new();
        for _ in 0..count {
            let name = self.text();
            assert_eq!(self.number(), 2);
            all.push((name, self.text()));
        }
        all
    }
}

#[test]
fn netcdf_holds_the_table_and_the_motion() {
    let folder = Folder::new("export-netcdf");
    run_four_bar(&folder);
    let export = lissom(&["export", "out", "--format", "netcdf"], folder.path());
    assert_eq!((export.code, export.output.trim()), (0, "out/results.nc"), "{}", export.errors);
    let bytes = fs::read(folder.path().join("out/results.nc")).unwrap();
    assert!(bytes.starts_with(b"CDF\x02"));
    let mut header = Header(&bytes, 4);
    assert_eq!((header.number(), header.number()), (0, 10));
    let dimensions: Vec<(String, usize)> =
        (0..header.number()).map(|_| (header.text(), header.number())).collect();
    assert!(header.attributes()[0].1.starts_with("lissom "));
    assert_eq!(header.number(), 11);
    let mut variables = Vec::new();
    for _ in 0..header.number() {
        let name = header.text();
        let shape: Vec<usize> = (0..header.number()).map(|_| dimensions[header.number()].1).collect();
        let attributes = header.attributes();
        let (kind, size) = (header.number(), header.number());
        let begin = u64::from_be_bytes(number(&bytes, header.1)) as usize;
        header.1 += 8;
        let width = if kind == 6 { 8 } else { 1 };
        assert_eq!(size, (width * shape.iter().product::<usize>()).next_multiple_of(4), "{name}");
        variables.push((name, attributes, begin, size));
    }
    let last = variables.last().unwrap();
    assert_eq!((variables[0].2, last.2 + last.3), (header.1, bytes.len()));
    let values = |wanted: &str| -> Vec<f64> {
        let (_, _, begin, size) = variables.iter().find(|variable| variable.0 == wanted).unwrap();
        bytes[*begin..begin + size]
            .chunks(8)
            .map(|value| f64::from_be_bytes(value.try_into().unwrap()))
            .collect()
    };
    let out = folder.path().join("out");
    let table = Record::from_csv(&fs::read_to_string(out.join("history.csv")).unwrap()).unwrap();
    assert_eq!(values("time"), table.times);
    for (column, recorded) in table.columns.iter().zip(&table.values) {
        assert_eq!(&values(&column.name()), recorded, "{}", column.name());
    }
    let time = &variables[0];
    assert_eq!(time.1, [("units".to_owned(), "s".to_owned())]);
    let rotations = values("rotation");
    assert!(rotations.chunks(4).all(|q| (q.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-6));
}
