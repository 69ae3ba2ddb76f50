//! VTK, for ParaView: one `.vtu` file for every frame and a `.pvd` file that lists their times. Beams are swept
//! sections with section forces at their points, shells their elements with forces, moments and stresses at the centres,
//! solids their surfaces with stresses.

use std::fmt::Write;

use lissom_motion::{Motion as Pose, Vector3};

use super::shell_cells::ShellCells;
use super::solid_cells::SolidCells;
use super::{ExportError, Format, Sink, chosen_frames, poses};
use crate::motion::{Motion, RecordedRun};
use crate::pictures::geometry::{Carrier, Geometry, Mesh, Piece, Role};
use crate::pictures::view::base64;

pub(super) const FORMAT: Format = Format {
    name: "vtk",
    summary: "A time series (.pvd and .vtu) for ParaView: surfaces with displacements and section forces.",
    target: "vtk",
    is_folder: true,
    files: &[("motion-", ".vtu"), ("motion.pvd", ""), ("parts.csv", "")],
    write,
};

/// Kind of cell of a polygon.
const POLYGON: u8 = 7;

fn write(run: &RecordedRun, most: usize, sink: &mut Sink<'_>) -> Result<(), ExportError> {
    let motion = &run.motion;
    let frames = chosen_frames(motion, most);
    if frames.is_empty() {
        return Err(ExportError::Empty);
    }
    let geometry = Geometry::new(&run.scene, motion, false);
    let (shells, solids) = (ShellCells::new(&run.scene), SolidCells::new(&run.scene));
    let mut series = String::new();
    for (number, &frame) in frames.iter().enumerate() {
        let name = format!("motion-{number:04}.vtu");
        let poses = poses(motion, frame);
        let mut grid = Grid::of(&geometry, motion, &poses, frame);
        grid.of_cells = shells.arrays(&geometry, &grid.pieces, &poses);
        grid.of_cells.extend(solids.arrays(&geometry, &grid.pieces, &poses));
        sink(&name, grid.text().as_bytes())?;
        // Writing to a string cannot fail.
        let _ = writeln!(series, "<DataSet timestep=\"{}\" file=\"{name}\"/>", motion.times()[frame]);
    }
    let text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n{series}</Collection>\n</VTKFile>\n"
    );
    sink("motion.pvd", text.as_bytes())?;
    let mut parts = "number,name,role\n".to_owned();
    for (number, (name, role)) in names(&geometry).iter().enumerate() {
        let _ = writeln!(parts, "{number},{},{}", lissom_model::output::quoted(name), role_word(*role));
    }
    Ok(sink("parts.csv", parts.as_bytes())?)
}

/// Every part once, in the order of its index.
fn names(geometry: &Geometry) -> Vec<(String, Role)> {
    let mut names: Vec<(String, Role)> = Vec::new();
    for piece in &geometry.pieces {
        if !names.iter().any(|(name, _)| *name == piece.name) {
            names.push((piece.name.clone(), piece.role));
        }
    }
    names
}

fn role_word(role: Role) -> &'static str {
    match role {
        Role::Beam => "beam",
        Role::Shell => "shell",
        Role::Solid => "solid",
        Role::Body => "body",
        Role::PointMass => "point mass",
        Role::Joint => "joint",
        Role::Spring => "spring",
        Role::Load => "load",
    }
}

/// Name of an array, number of its components, and its values for all cells.
pub(super) type CellArray = (&'static str, usize, Vec<f32>);

/// All surfaces in one frame.
#[derive(Default)]
struct Grid {
    points: Vec<f64>,
    displacements: Vec<f32>,
    forces: Vec<f32>,
    moments: Vec<f32>,
    connectivity: Vec<i64>,
    offsets: Vec<i64>,
    parts: Vec<i32>,
    /// Index of the piece, and number of its faces.
    pieces: Vec<(usize, usize)>,
    /// Further arrays.
    of_cells: Vec<CellArray>,
}

impl Grid {
    fn of(geometry: &Geometry, motion: &Motion, poses: &[Pose], frame: usize) -> Self {
        let names = names(geometry);
        let mut grid = Self::default();
        for (index, piece) in geometry.pieces.iter().enumerate() {
            let time = motion.times()[frame];
            let (Some(mesh), Some(start)) = (piece.at(poses, time), piece.at(motion.reference(), time))
            else {
                continue;
            };
            let part = names.iter().position(|(name, _)| *name == piece.name).unwrap_or_default();
            grid.add(&mesh, &start, (part as u32).cast_signed());
            grid.pieces.push((index, mesh.faces.len()));
            grid.section_forces(piece, mesh.points.len(), (motion, frame));
        }
        grid
    }

    fn add(&mut self, mesh: &Mesh, start: &Mesh, part: i32) {
        let first = (self.points.len() as u64 / 3).cast_signed();
        for (point, before) in mesh.points.iter().zip(&start.points) {
            self.points.extend(<[f64; 3]>::from(*point));
            let shift: Vector3 = point - before;
            self.displacements.extend(shift.iter().map(|part| *part as f32));
        }
        for face in &mesh.faces {
            self.connectivity.extend(face.iter().map(|k| first + i64::from(*k)));
            self.offsets.push((self.connectivity.len() as u64).cast_signed());
            self.parts.push(part);
        }
    }

    /// Section forces and moments at the points of a beam, interpolated linearly between those of the motion; zero
    /// elsewhere.
    fn section_forces(&mut self, piece: &Piece, count: usize, (motion, frame): (&Motion, usize)) {
        let mut first = 0;
        let mut of_beam = None;
        for points in &motion.header().force_points {
            if points.beam == piece.name && piece.role == Role::Beam {
                of_beam = Some((first, &points.at));
            }
            first += points.at.len();
        }
        let (Some((first, at)), Carrier::Sections(sweep)) = (of_beam, &piece.carrier) else {
            self.forces.resize(self.forces.len() + 3 * count, 0.0);
            self.moments.resize(self.moments.len() + 3 * count, 0.0);
            return;
        };
        let around = sweep.profiles()[0].len();
        for s in sweep.places() {
            let k = at[..at.len() - 1].partition_point(|place| place < s).saturating_sub(1);
            let next = (k + 1).min(at.len() - 1);
            let x = if next > k { (s - at[k]) / (at[next] - at[k]) } else { 0.0 };
            let (a, b) =
                (motion.section_forces(frame, first + k), motion.section_forces(frame, first + next));
            let here = a + (b - a) * x;
            for _ in 0..around {
                self.forces.extend(here.iter().take(3).map(|part| *part as f32));
                self.moments.extend(here.iter().skip(3).map(|part| *part as f32));
            }
        }
    }

    fn text(&self) -> String {
        let floats = |values: &[f32]| encoded(values.iter().flat_map(|value| value.to_le_bytes()));
        let wholes = |values: &[i64]| encoded(values.iter().flat_map(|value| value.to_le_bytes()));
        let array = |name: &str, kind: &str, size: usize, content: String| {
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{size}\" format=\"binary\">{content}</DataArray>\n"
            )
        };
        let (points, cells) = (self.points.len() / 3, self.offsets.len());
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n"
        );
        text += "<PointData>\n";
        text += &array("displacement [m]", "Float32", 3, floats(&self.displacements));
        text += &array("section force [N]", "Float32", 3, floats(&self.forces));
        text += &array("section moment [N m]", "Float32", 3, floats(&self.moments));
        text += "</PointData>\n<CellData>\n";
        text += &array("part", "Int32", 1, encoded(self.parts.iter().flat_map(|part| part.to_le_bytes())));
        for (name, size, values) in &self.of_cells {
            text += &array(name, "Float32", *size, floats(values));
        }
        text += "</CellData>\n<Points>\n";
        text +=
            &array("points", "Float64", 3, encoded(self.points.iter().flat_map(|value| value.to_le_bytes())));
        text += "</Points>\n<Cells>\n";
        text += &array("connectivity", "Int64", 1, wholes(&self.connectivity));
        text += &array("offsets", "Int64", 1, wholes(&self.offsets));
        text += &array("types", "UInt8", 1, encoded(std::iter::repeat_n(POLYGON, cells)));
        text + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"
    }
}

/// Bytes in base64, preceded by their number.
fn encoded(bytes: impl Iterator<Item = u8>) -> String {
    let bytes: Vec<u8> = bytes.collect();
    base64(&[&(bytes.len() as u64).to_le_bytes(), bytes.as_slice()].concat())
}
