//! Shapes of solid elements: functions of their nodes, points of quadrature, edges and faces. Nodes are in the order of Abaqus.

use lissom_motion::Vector3;

/// Natural coordinates: of a hexahedron from -1 to 1, of a tetrahedron three of its four volume coordinates.
pub type Natural = [f64; 3];

/// Functions of the nodes at a point.
#[derive(Clone, Copy, Debug)]
pub struct Functions<const NODES: usize> {
    /// Values.
    pub values: [f64; NODES],
    /// Derivatives with respect to the natural coordinates.
    pub slopes: [Vector3; NODES],
}

/// Edges of a tetrahedron, in the order of their middle nodes 4 to 9.
pub const TETRAHEDRON_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

/// Edges of a hexahedron, in the order of their middle nodes 8 to 19.
pub const HEXAHEDRON_EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

/// Faces of a tetrahedron: three corners counterclockwise seen from outside, then the middle nodes of the sides from each corner to the
/// next.
pub const TETRAHEDRON_FACES: [[usize; 6]; 4] =
    [[0, 2, 1, 6, 5, 4], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [2, 0, 3, 6, 7, 9]];

/// Faces of a hexahedron, in the same way: at the third natural coordinate -1 and 1, the second -1, the first 1, the second 1, the
/// first -1.
pub const HEXAHEDRON_FACES: [[usize; 8]; 6] = [
    [0, 3, 2, 1, 11, 10, 9, 8],
    [4, 5, 6, 7, 12, 13, 14, 15],
    [0, 1, 5, 4, 8, 17, 12, 16],
    [1, 2, 6, 5, 9, 18, 13, 17],
    [2, 3, 7, 6, 10, 19, 14, 18],
    [3, 0, 4, 7, 11, 16, 15, 19],
];

/// Natural coordinates of a node of a hexahedron.
pub fn hexahedron_node(node: usize) -> Natural {
    if let Some(edge) = node.checked_sub(8) {
        let [from, to] = HEXAHEDRON_EDGES[edge].map(hexahedron_node);
        return std::array::from_fn(|k| 0.5 * (from[k] + to[k]));
    }
    let sign = |is_high: bool| if is_high { 1.0 } else { -1.0 };
    [sign(matches!(node & 3, 1 | 2)), sign(node & 2 != 0), sign(node & 4 != 0)]
}

/// Natural coordinates of a node of a tetrahedron.
pub fn tetrahedron_node(node: usize) -> Natural {
    if let Some(edge) = node.checked_sub(4) {
        let [from, to] = TETRAHEDRON_EDGES[edge].map(tetrahedron_node);
        return std::array::from_fn(|k| 0.5 * (from[k] + to[k]));
    }
    std::array::from_fn(|k| f64::from(u8::from(node == k + 1)))
}

/// Quadratic functions of a tetrahedron: L (2 L - 1) at corners, 4 L L' at edges.
pub fn tetrahedron(place: Natural) -> Functions<10> {
    let [x, y, z] = place;
    let volume = [1.0 - x - y - z, x, y, z];
    let slope = [Vector3::repeat(-1.0), Vector3::x(), Vector3::y(), Vector3::z()];
    let mut functions = Functions { values: [0.0; 10], slopes: [Vector3::zeros(); 10] };
    for i in 0..4 {
        functions.values[i] = volume[i] * (2.0 * volume[i] - 1.0);
        functions.slopes[i] = (4.0 * volume[i] - 1.0) * slope[i];
    }
    for (k, [i, j]) in TETRAHEDRON_EDGES.into_iter().enumerate() {
        functions.values[4 + k] = 4.0 * volume[i] * volume[j];
        functions.slopes[4 + k] = 4.0 * (volume[j] * slope[i] + volume[i] * slope[j]);
    }
    functions
}

/// Serendipity functions of a hexahedron: Π(1 + r rᵢ) (Σ r rᵢ - 2)/8 at corners, Π(1 + r rᵢ) (1 - r²)/4 at edges, r along the edge.
pub fn hexahedron(place: Natural) -> Functions<20> {
    let mut functions = Functions { values: [0.0; 20], slopes: [Vector3::zeros(); 20] };
    for i in 0..20 {
        let node = hexahedron_node(i);
        // A factor of each direction with its slope.
        let along = |k: usize| node[k] == 0.0;
        let factor = |k: usize| if along(k) { 1.0 - place[k] * place[k] } else { 1.0 + node[k] * place[k] };
        let slope = |k: usize| if along(k) { -2.0 * place[k] } else { node[k] };
        let factors = [factor(0), factor(1), factor(2)];
        let product: f64 = factors.iter().product();
        let others = |k: usize| factors[(k + 1) % 3] * factors[(k + 2) % 3];
        let (scale, sum) =
            if i < 8 { (0.125, (0..3).map(|k| node[k] * place[k]).sum::<f64>() - 2.0) } else { (0.25, 1.0) };
        functions.values[i] = scale * product * sum;
        functions.slopes[i] = Vector3::from_fn(|k, _| {
            let of_sum = if i < 8 { product * node[k] } else { 0.0 };
            scale * (slope(k) * others(k) * sum + of_sum)
        });
    }
    functions
}

/// Quadratic functions of a triangle with six nodes, over r, s ≥ 0 with r + s ≤ 1; the third natural coordinate is not used.
pub fn triangle(place: Natural) -> Functions<6> {
    let [x, y, _] = place;
    let area = [1.0 - x - y, x, y];
    let slope = [Vector3::new(-1.0, -1.0, 0.0), Vector3::x(), Vector3::y()];
    let mut functions = Functions { values: [0.0; 6], slopes: [Vector3::zeros(); 6] };
    for i in 0..3 {
        let j = (i + 1) % 3;
        functions.values[i] = area[i] * (2.0 * area[i] - 1.0);
        functions.slopes[i] = (4.0 * area[i] - 1.0) * slope[i];
        functions.values[3 + i] = 4.0 * area[i] * area[j];
        functions.slopes[3 + i] = 4.0 * (area[j] * slope[i] + area[i] * slope[j]);
    }
    functions
}

/// Serendipity functions of a quadrilateral with eight nodes: those of a face of a hexahedron.
pub fn quadrilateral([r, s, _]: Natural) -> Functions<8> {
    let solid = hexahedron([r, s, 1.0]);
    let nodes = HEXAHEDRON_FACES[1];
    Functions { values: nodes.map(|node| solid.values[node]), slopes: nodes.map(|node| solid.slopes[node]) }
}

/// Four points of a tetrahedron, of second order.
pub(super) fn tetrahedron_points() -> [(Natural, f64); 4] {
    let near = (5.0 - 5.0_f64.sqrt()) / 20.0;
    let far = 1.0 - 3.0 * near;
    [0, 1, 2, 3].map(|i| (std::array::from_fn(|k| if i == k + 1 { far } else { near }), 1.0 / 24.0))
}

/// 21 points of a hexahedron: eight near those of Gauss, which alone have modes without energy that join across elements in layers of one
/// element, and thirteen with small weights, which give these modes a stiffness. Like those of Gauss they integrate products of third
/// order in each coordinate exactly, so that distorted elements with straight edges pass the patch test.
///
/// ```text
/// (±b, ±b, ±b) with t³, b² = 1/(3 t),      (±e, ±e, 0) and alike with D = (1 - t²)(1 + t)/2, e² = 2/(3 + 3 t),
/// the centre with 8 - 8 t³ - 12 D,         t = 0.95;  t = 1 are the points of Gauss
/// ```
pub(super) fn hexahedron_points() -> [(Natural, f64); 21] {
    let t = 0.95_f64;
    let [corner, along] = [1.0 / (3.0 * t), 2.0 / (3.0 + 3.0 * t)].map(f64::sqrt);
    let [of_corner, of_edge] = [t.powi(3), 0.5 * (1.0 - t * t) * (1.0 + t)];
    // Corners, then the middles of the edges, which are nodes of the element.
    std::array::from_fn(|point| match point {
        0..8 => (hexahedron_node(point).map(|sign| corner * sign), of_corner),
        8..20 => (hexahedron_node(point).map(|sign| along * sign), of_edge),
        _ => ([0.0; 3], 8.0 - 8.0 * of_corner - 12.0 * of_edge),
    })
}

/// Points of Gauss on a line from -1 to 1, exact to the fifth order.
fn line_points() -> [(f64, f64); 3] {
    let far = 0.6_f64.sqrt();
    [(-far, 5.0 / 9.0), (0.0, 8.0 / 9.0), (far, 5.0 / 9.0)]
}

/// 27 points of a hexahedron, for integrals of mass.
pub(super) fn hexahedron_fine() -> Vec<(Natural, f64)> {
    let line = line_points();
    let point = |k: usize| {
        let [x, y, z] = [line[k / 9], line[k / 3 % 3], line[k % 3]];
        ([x.0, y.0, z.0], x.1 * y.1 * z.1)
    };
    (0..27).map(point).collect()
}

/// The same of a tetrahedron, as a hexahedron with a side of which one edge remains and an end of which one corner remains.
pub(super) fn tetrahedron_fine() -> Vec<(Natural, f64)> {
    let collapsed = |([x, y, z], weight): (Natural, f64)| {
        let [u, v, w] = [x, y, z].map(|x| 0.5 * (1.0 + x));
        let (rest, left) = (1.0 - u, 1.0 - v);
        ([u, v * rest, w * rest * left], 0.125 * weight * rest * rest * left)
    };
    hexahedron_fine().into_iter().map(collapsed).collect()
}

/// Nine points of a quadrilateral.
pub(super) fn quadrilateral_points() -> [(Natural, f64); 9] {
    let line = line_points();
    std::array::from_fn(|k| {
        let [x, y] = [line[k / 3], line[k % 3]];
        ([x.0, y.0, 0.0], x.1 * y.1)
    })
}

/// The same of a triangle.
pub(super) fn triangle_points() -> [(Natural, f64); 9] {
    quadrilateral_points().map(|([x, y, _], weight)| {
        let [u, v] = [x, y].map(|x| 0.5 * (1.0 + x));
        ([u, v * (1.0 - u), 0.0], 0.25 * weight * (1.0 - u))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const NODES: usize>(
        functions: fn(Natural) -> Functions<NODES>,
        node: fn(usize) -> Natural,
        rules: &[Vec<(Natural, f64)>; 2],
        squares: usize,
    ) {
        for i in 0..NODES {
            let values = functions(node(i)).values;
            for (j, value) in values.iter().enumerate() {
                assert!((value - f64::from(u8::from(i == j))).abs() < 1e-14, "{i}, {j}");
            }
        }
        let (place, step) = ([0.21, 0.13, 0.34], 1e-6);
        let here = functions(place);
        for k in 0..3 {
            let moved = |by: f64| {
                let mut moved = place;
                moved[k] += by;
                functions(moved).values
            };
            for i in 0..NODES {
                let slope = (moved(step)[i] - moved(-step)[i]) / (2.0 * step);
                assert!((slope - here.slopes[i][k]).abs() < 1e-9, "{i}, {k}");
            }
        }
        // Products of squares up to this number of coordinates by both rules.
        for count in 0..=squares {
            let product = |p: &Natural| p[..count].iter().map(|x| x * x).product::<f64>();
            let sums = rules.each_ref().map(|rule| rule.iter().map(|(p, w)| w * product(p)).sum::<f64>());
            assert!((sums[0] - sums[1]).abs() < 1e-14, "{count}: {sums:?}");
        }
    }

    #[test]
    fn functions_are_one_at_their_node_and_slopes_are_their_derivatives() {
        check(tetrahedron, tetrahedron_node, &[tetrahedron_points().to_vec(), tetrahedron_fine()], 1);
        check(hexahedron, hexahedron_node, &[hexahedron_points().to_vec(), hexahedron_fine()], 3);
    }

    #[test]
    fn faces_point_outward_and_have_the_middles_of_their_sides() {
        fn check<const NODES: usize, const COUNT: usize>(
            faces: &[[usize; NODES]],
            node: fn(usize) -> Natural,
            centre: f64,
        ) {
            let corners = NODES / 2;
            for face in faces {
                let p = face.map(|i| Vector3::from(node(i)));
                for i in 0..corners {
                    assert_eq!(p[corners + i], 0.5 * (p[i] + p[(i + 1) % corners]));
                }
                let normal = (p[1] - p[0]).cross(&(p[2] - p[0]));
                assert!(normal.dot(&(p[0] - Vector3::repeat(centre))) > 0.0, "{face:?}");
            }
            assert_eq!(faces.len(), COUNT);
        }
        check::<6, 4>(&TETRAHEDRON_FACES, tetrahedron_node, 0.2);
        check::<8, 6>(&HEXAHEDRON_FACES, hexahedron_node, 0.0);
    }
}
