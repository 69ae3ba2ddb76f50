//! Meshes of MJCF: triangles of STL, glTF, OBJ and MSH files or of the description itself, their volume and inertia, and their hull.
//!
//! With the corners a, b, c of a triangle from a point o, its pyramid has the volume V = (a × b)·c/6, the centre (a + b + c)/4, and
//!
//! ```text
//! ∫ x xᵀ dV = V/20 (s sᵀ + a aᵀ + b bᵀ + c cᵀ),      s = a + b + c
//! ```
//!
//! Pyramids over all triangles of a closed mesh sum up to its solid, wherever o is. The format also has a sum of their absolute values
//! (`legacy`), o being the centre of the triangles for the volume, and the centre of mass for the inertia; it differs for meshes that
//! are not convex.

use std::collections::BTreeMap;
use std::path::Path;
use std::rc::Rc;

use lissom_core::contact::geometry::surfaces::Mesh as Hull;
use lissom_model::files;
use lissom_model::scene::Surface;
use lissom_motion::{Matrix3, Rotation, Vector3};

use super::super::{ImportError, LinkInertia, VisualShape};
use super::element::Element;
use super::expand::asset_name;
use super::tree::Node;

/// Largest number of corners of a hull that touches: the edges of two hulls are examined in pairs.
const MAX_CORNERS: usize = 32;
/// Relative size of a gap at which a mesh counts as open.
const OPEN: f64 = 1e-6;

/// Mass of a mesh.
#[derive(Clone, Copy)]
pub(super) enum Density {
    /// Mass per volume, or per area of a shell [kg/m³, kg/m²].
    Uniform(f64),
    /// The whole mass [kg].
    Total(f64),
}

/// A mesh in metres, in the axes of its geom.
pub(super) struct Mesh {
    corners: Vec<Vector3>,
    triangles: Vec<[usize; 3]>,
    hull: Option<Hull>,
    /// How inertia follows from it.
    inertia: String,
    /// Path and scale of a file that can be drawn.
    file: Option<(String, Vector3)>,
}

/// The meshes of a description, which are read when they are first needed.
#[derive(Default)]
pub(super) struct Meshes {
    assets: BTreeMap<String, Node>,
    materials: BTreeMap<String, Node>,
    known: BTreeMap<String, Result<Rc<Mesh>, ImportError>>,
    /// What is omitted of meshes, one sentence each.
    pub(super) notes: Vec<String>,
}

impl Meshes {
    pub(super) fn of(root: &Node) -> Self {
        let named = |tag: &str| {
            let assets = root.within("asset").filter(|own| own.has_tag(tag));
            assets.map(|own| (asset_name(own), own.clone())).collect()
        };
        Self { assets: named("mesh"), materials: named("material"), ..Self::default() }
    }

    /// Red, green, blue and opacity of a geom, or of its material.
    pub(super) fn rgba(&self, geom: &Element) -> Result<Option<[f64; 4]>, ImportError> {
        let own = geom.numbers::<4>("rgba")?;
        let material = geom.text("material").and_then(|name| self.materials.get(name));
        own.map_or_else(|| material.map_or(Ok(None), |own| own.element.numbers("rgba")), |own| Ok(Some(own)))
    }

    /// The mesh of a geom.
    ///
    /// # Errors
    /// If there is none, or it cannot be read.
    pub(super) fn of_geom(&mut self, geom: &Element) -> Result<Rc<Mesh>, ImportError> {
        let name = geom.text("mesh").ok_or_else(|| geom.fault("it has no `mesh`"))?;
        let asset = self.assets.get(name);
        let asset =
            asset.ok_or_else(|| geom.fault(format!("there is no <mesh> `{name}` among the assets")))?;
        let known = self.known.entry(name.to_owned()).or_insert_with(|| Mesh::read(asset).map(Rc::new));
        known.clone()
    }
}

impl Meshes {
    /// Notes that the hull of a mesh has fewer corners than the mesh.
    pub(super) fn note_corners(&mut self, geom: &Element, mesh: &Mesh) {
        let Some(count) = mesh.reduced_corners() else { return };
        let name = geom.text("mesh").unwrap_or_default();
        let words =
            format!("corners of the hull of the mesh `{name}`: {count} except for at most {MAX_CORNERS}");
        if !self.notes.contains(&words) {
            self.notes.push(words);
        }
    }
}

impl Mesh {
    fn read(asset: &Node) -> Result<Self, ImportError> {
        let own = &asset.element;
        let scale = own.numbers::<3>("scale")?.map_or(Vector3::repeat(1.0), Vector3::from);
        let shift = Vector3::from(own.numbers::<3>("refpos")?.unwrap_or_default());
        let turn = match own.numbers::<4>("refquat")? {
            None => Rotation::identity(),
            Some(quaternion) => Rotation::from_quaternion(quaternion)
                .ok_or_else(|| own.fault("`refquat` has the length zero"))?,
        };
        if let Some(kind) = own.text("builtin").filter(|kind| *kind != "none") {
            let message =
                format!("the mesh `{kind}` that the program generates is not supported: write its vertices");
            return Err(own.fault(message));
        }
        let (mut corners, mut triangles, file) = match (own.text("file"), own.list("vertex")?) {
            (Some(_), Some(_)) => return Err(own.fault("it has both a file and vertices: remove one")),
            (Some(file), None) => {
                let ((corners, triangles), path) = of_file(asset, file)?;
                (corners, triangles, Some(path))
            }
            (None, Some(values)) => {
                if values.len() % 3 != 0 {
                    return Err(own.fault("`vertex` must be three numbers for each vertex"));
                }
                let faces = own.list("face")?.unwrap_or_default();
                if faces.len() % 3 != 0 {
                    return Err(own.fault("`face` must be three indices for each triangle"));
                }
                let corners = values.chunks_exact(3).map(|c| Vector3::new(c[0], c[1], c[2])).collect();
                if faces.iter().any(|index| *index < 0.0 || index.fract() != 0.0) {
                    return Err(own.fault("`face` must be indices of vertices, from 0"));
                }
                let index = |face: &[f64]| [face[0] as usize, face[1] as usize, face[2] as usize];
                (corners, faces.chunks_exact(3).map(index).collect(), None)
            }
            (None, None) => return Err(own.fault("it has neither a file nor vertices")),
        };
        if triangles.iter().flatten().any(|corner| *corner >= corners.len()) || corners.len() < 4 {
            return Err(own.fault(
                "its faces refer to vertices that it does not have, or it has fewer than four vertices",
            ));
        }
        for corner in &mut corners {
            *corner = turn.apply_inverse(&(corner.component_mul(&scale) - shift));
        }
        if scale.iter().filter(|factor| **factor < 0.0).count() % 2 == 1 {
            for corners in &mut triangles {
                corners.swap(1, 2);
            }
        }
        let hull = Hull::hull(&corners).ok();
        if triangles.is_empty() {
            let hull = hull.as_ref().ok_or_else(|| own.fault("all its vertices are in a plane"))?;
            corners = hull.corners().collect();
            triangles = hull.triangles().iter().map(|own| own.map(|index| index as usize)).collect();
        }
        let drawn = file.filter(|path: &String| {
            let name = path.to_lowercase();
            let is_drawn = [".stl", ".gltf", ".glb"].iter().any(|ending| name.ends_with(ending));
            is_drawn && shift == Vector3::zeros() && turn == Rotation::identity()
        });
        let inertia = own.text("inertia").unwrap_or("legacy").to_owned();
        Ok(Self { corners, triangles, hull, inertia, file: drawn.map(|path| (path, scale)) })
    }

    /// Mass of the mesh, a solid or a shell.
    pub(super) fn inertia(
        &self,
        geom: &Element,
        is_shell: bool,
        density: Density,
    ) -> Result<LinkInertia, ImportError> {
        let kind = if is_shell { "shell" } else { self.inertia.as_str() };
        let own = match kind {
            "shell" => self.shell(),
            "exact" => self.exact().ok_or_else(|| {
                geom.fault("the triangles of its mesh do not enclose a volume: write inertia=\"convex\", or repair the mesh")
            })?,
            "convex" => {
                let hull = self.hull.as_ref().ok_or_else(|| geom.fault("its mesh is flat: add an <inertial> to the body"))?;
                let corners: Vec<Vector3> = hull.corners().collect();
                let triangles: Vec<[usize; 3]> =
                    hull.triangles().iter().map(|own| own.map(|index| index as usize)).collect();
                moments(&corners, &triangles, &Vector3::zeros(), false).solid(&Vector3::zeros())
            }
            "legacy" => self.legacy(),
            other => {
                return Err(geom.fault(format!(
                    "`inertia` of its mesh must be convex, exact, legacy or shell, not `{other}`"
                )));
            }
        };
        if own.mass.is_nan() || own.mass <= 0.0 {
            return Err(geom.fault("its mesh encloses no volume: add an <inertial> to the body"));
        }
        let factor = match density {
            Density::Uniform(density) => density,
            Density::Total(mass) => mass / own.mass,
        };
        Ok(LinkInertia { mass: factor * own.mass, centre: own.centre, inertia: factor * own.inertia })
    }

    /// The solid of unit density, of a mesh that is closed.
    fn exact(&self) -> Option<LinkInertia> {
        let mut area = Vector3::zeros();
        let mut size = 0.0;
        for [a, b, c] in self.faces() {
            let own = 0.5 * (b - a).cross(&(c - a));
            area += own;
            size += own.norm();
        }
        let sum = moments(&self.corners, &self.triangles, &self.centre(), false);
        (area.norm() <= OPEN * size && sum.volume > 0.0).then(|| sum.solid(&self.centre()))
    }

    /// The sum of the absolute values of all pyramids.
    fn legacy(&self) -> LinkInertia {
        let centre = self.centre();
        let of_volume = moments(&self.corners, &self.triangles, &centre, true).solid(&centre);
        let about = of_volume.centre;
        let sum = moments(&self.corners, &self.triangles, &about, true);
        let trace = sum.second.trace();
        LinkInertia { inertia: trace * Matrix3::identity() - sum.second, ..of_volume }
    }

    /// A shell of unit mass per area.
    fn shell(&self) -> LinkInertia {
        let (mut area, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        for [a, b, c] in self.faces() {
            let own = 0.5 * (b - a).cross(&(c - a)).norm();
            let s = a + b + c;
            area += own;
            first += own / 3.0 * s;
            second +=
                own / 12.0 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
        }
        let centre = first / area;
        let second = second - area * centre * centre.transpose();
        LinkInertia { mass: area, centre, inertia: second.trace() * Matrix3::identity() - second }
    }

    fn faces(&self) -> impl Iterator<Item = [Vector3; 3]> {
        self.triangles.iter().map(|own| own.map(|corner| self.corners[corner]))
    }

    /// Centre of the area of all triangles.
    fn centre(&self) -> Vector3 {
        let (mut area, mut sum) = (0.0, Vector3::zeros());
        for [a, b, c] in self.faces() {
            let own = 0.5 * (b - a).cross(&(c - a)).norm();
            area += own;
            sum += own / 3.0 * (a + b + c);
        }
        if area > 0.0 { sum / area } else { Vector3::zeros() }
    }

    /// Number of corners of its hull, if only some of them can touch.
    pub(super) fn reduced_corners(&self) -> Option<usize> {
        self.hull.as_ref().map(|hull| hull.corners().count()).filter(|count| *count > MAX_CORNERS)
    }

    /// What is drawn of it: its hull if it touches others or its file cannot be drawn. None if it is flat.
    pub(super) fn shape(&self, touches: bool) -> Option<VisualShape> {
        if let Some((path, scale)) = self.file.as_ref().filter(|_| !touches) {
            return Some(VisualShape::Mesh { name: path.clone(), scale: *scale, path: None });
        }
        let hull = self.hull.as_ref()?;
        let corners: Vec<Vector3> = hull.corners().collect();
        if corners.len() <= MAX_CORNERS {
            return Some(VisualShape::Hull(corners));
        }
        // The farthest corners in directions that are spread evenly over the sphere.
        let mut chosen: Vec<usize> = Vec::new();
        for k in 0..MAX_CORNERS {
            let z = 1.0 - (2.0 * k as f64 + 1.0) / MAX_CORNERS as f64;
            let (sine, cosine) = (std::f64::consts::PI * (3.0 - 5.0_f64.sqrt()) * k as f64).sin_cos();
            let r = (1.0 - z * z).sqrt();
            let direction = Vector3::new(r * cosine, r * sine, z);
            let far = |one: &usize, other: &usize| {
                direction.dot(&corners[*one]).total_cmp(&direction.dot(&corners[*other]))
            };
            let farthest = (0..corners.len()).max_by(far)?;
            if !chosen.contains(&farthest) {
                chosen.push(farthest);
            }
        }
        Some(VisualShape::Hull(chosen.into_iter().map(|corner| corners[corner]).collect()))
    }
}

/// Volume and moments of pyramids, about a point.
struct Moments {
    volume: f64,
    first: Vector3,
    second: Matrix3,
}

impl Moments {
    /// The solid of unit density, for moments about `origin`.
    fn solid(&self, origin: &Vector3) -> LinkInertia {
        let centre = self.first / self.volume;
        let second = self.second - self.volume * centre * centre.transpose();
        let inertia = second.trace() * Matrix3::identity() - second;
        LinkInertia { mass: self.volume, centre: origin + centre, inertia }
    }
}

/// Sums over the pyramids from `origin` to all triangles, of their values or of their absolute values.
fn moments(corners: &[Vector3], triangles: &[[usize; 3]], origin: &Vector3, is_absolute: bool) -> Moments {
    let mut sum = Moments { volume: 0.0, first: Vector3::zeros(), second: Matrix3::zeros() };
    for own in triangles {
        let [a, b, c] = own.map(|corner| corners[corner] - origin);
        let volume = a.cross(&b).dot(&c) / 6.0;
        let volume = if is_absolute { volume.abs() } else { volume };
        let s = a + b + c;
        sum.volume += volume;
        sum.first += 0.25 * volume * s;
        sum.second +=
            volume / 20.0 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    sum
}

type Triangles = (Vec<Vector3>, Vec<[usize; 3]>);

/// Corners and triangles of a file, and its path.
fn of_file(asset: &Node, name: &str) -> Result<(Triangles, String), ImportError> {
    let own = &asset.element;
    let folders = &asset.settings.mesh_folders;
    if folders.is_empty() {
        return Err(own.fault(format!("the file `{name}` is not read from a text without a folder")));
    }
    let path = folders.iter().map(|folder| folder.join(name)).find(|path| path.is_file());
    let path = path.ok_or_else(|| {
        let message = format!(
            "the file `{name}` of the mesh is not there: put it in the folder `{}`",
            folders[0].display()
        );
        own.fault(message)
    })?;
    let bytes = files::read_input(&path).map_err(|error| own.fault(format!("`{name}`: {error}")))?;
    let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let read = match ending.as_deref().unwrap_or_default() {
        "stl" | "gltf" | "glb" => drawn(&bytes, path.parent().unwrap_or(Path::new(""))),
        "obj" => obj(&bytes),
        "msh" => msh(&bytes).ok_or_else(|| "it is no valid mesh of this format".to_owned()),
        other => {
            let message =
                format!("the format `{other}` of the mesh `{name}` is unknown: stl, gltf, obj or msh");
            return Err(own.fault(message));
        }
    };
    let (corners, triangles) = read.map_err(|error| own.fault(format!("`{name}`: {error}")))?;
    let finite = corners.iter().all(|corner: &Vector3| corner.iter().all(|value| value.is_finite()));
    if !finite {
        return Err(own.fault(format!("`{name}` has vertices that are not finite")));
    }
    Ok(((corners, triangles), path.to_string_lossy().into_owned()))
}

fn float(bytes: &[u8], at: usize) -> Option<f64> {
    Some(f64::from(f32::from_le_bytes(*bytes.get(at..at + 4)?.first_chunk()?)))
}

/// Triangles of an STL or glTF file, as they are drawn.
fn drawn(bytes: &[u8], folder: &Path) -> Result<Triangles, String> {
    let beside = |name: &str| files::read_input(&folder.join(name)).map_err(|error| error.to_string());
    let surface = Surface::of_file(bytes, &beside).map_err(|error| error.to_string())?;
    let corners = surface.points.iter().map(|point| Vector3::from(point.map(f64::from)));
    let triangles = surface.triangles.iter().map(|own| own.map(|index| index as usize));
    Ok((corners.collect(), triangles.collect()))
}

/// Triangles of an OBJ file.
fn obj(bytes: &[u8]) -> Result<Triangles, String> {
    let mesh = lissom_mesh::read(bytes, "obj").map_err(|error| error.to_string())?;
    let corners = mesh.positions.iter().map(|position| Vector3::from(*position)).collect();
    let faces = mesh.elements.iter().map(|element| element.nodes.as_slice());
    let divided =
        |face: &[usize]| (2..face.len()).map(|k| [face[0], face[k - 1], face[k]]).collect::<Vec<_>>();
    Ok((corners, faces.flat_map(divided).collect()))
}

/// Triangles of the binary format of MuJoCo.
fn msh(bytes: &[u8]) -> Option<Triangles> {
    let integer = |at: usize| Some(u32::from_le_bytes(*bytes.get(at..at + 4)?.first_chunk()?) as usize);
    let [vertices, normals, textures, faces] = [integer(0)?, integer(4)?, integer(8)?, integer(12)?];
    let before = vertices.checked_add(normals)?.checked_mul(12)?.checked_add(textures.checked_mul(8)?)?;
    if bytes.len() != before.checked_add(faces.checked_mul(12)?)?.checked_add(16)? {
        return None;
    }
    let three =
        |at: usize| Some(Vector3::new(float(bytes, at)?, float(bytes, at + 4)?, float(bytes, at + 8)?));
    let corners = (0..vertices).map(|k| three(16 + 12 * k)).collect::<Option<Vec<_>>>()?;
    let face = |k: usize| {
        let at = 16 + before + 12 * k;
        Some([integer(at)?, integer(at + 4)?, integer(at + 8)?])
    };
    Some((corners, (0..faces).map(face).collect::<Option<Vec<_>>>()?))
}
