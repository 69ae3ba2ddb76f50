//! A superelement with known second-order matrices: its kinetic energy is that of a part whose points are displaced along
//! straight lines, and bending shortens it without force.
//!
//! Legend: y = (r - X, κ, q) relative to the floating frame (see `relative`), v and ω its velocity and angular velocity, γ = R_fᵀ
//! g, U_k direction of a shortening. First moment s_k = s₀ + G_k y + ½ y·S_k y, T_t energy of rotation, of points and of their
//! sections' contribution (see `turning`), h_k = ½ y·D_k y (see [`GeometricMatrices`]), M mass of y.
//!
//! ```text
//! L = ½ m v² + v·(ω × s + ṡ) + γ·(m x + s) + T_t(y, ẏ, ω) + ½ ẏ·M ẏ - h·(K y + ½ K h),      h = Σ h_k U_k
//!
//! force on f      m a + s̈ + ω̇ × s + 2 ω × ṡ + ω × (ω × s),      a = v̇ + ω × v - γ
//! moment on f     s × a + that of T_t
//! dual to y       M ÿ + Σ a_k (G_k + S_k y) + that of T_t + Σ g_k D_k y + K h,      g_k = U_k·(K y + K h)
//! ```
//!
//! The equations are Poincaré's for L. The kinetic energy of the points is the full integral ½∫ρ |v + ω × (X + Ψ y) + Ψ ẏ|²:
//! terms of third order must not be omitted. Otherwise it would not remain positive if the inertia changes by as much as its own
//! value, such as that about the axis of a slender part. The elastic energy is ½ (y + h)·K (y + h): the square keeps it positive.

use lissom_motion::{Matrix3, Matrix6, Vector3, rotation_part, screw, skew, translation_part};
use nalgebra::{DMatrix, DVector, Matrix3xX, MatrixXx3};

use super::geometric::GeometricMatrices;
use super::linearize::Map;
use super::matrices::rigid_column;
use super::part::Part;
use super::relative::Relative;
use super::turning::{MeanRotation, PartMotion, Turning, TurningLaw, TurningSlopes, resize, rows, times};
use super::vectors::add;
use lissom_mechanics::elements::{Energy, Tangents};
use lissom_mechanics::kinematics::Kinematics;
use lissom_mechanics::round_off;

/// A shortening.
#[derive(Clone, Debug)]
struct Shortened {
    /// U.
    direction: DVector<f64>,
    /// D.
    matrix: DMatrix<f64>,
    /// K U.
    pulled: DVector<f64>,
}

/// The coefficients.
#[derive(Clone, Debug)]
pub(super) struct SecondOrder {
    /// s₀, G and S.
    first_moment: Vector3,
    moment_slope: [DVector<f64>; 3],
    moment: [DMatrix<f64>; 3],
    /// Laws of points and of sections.
    turning: [TurningLaw; 2],
    /// M.
    mass: DMatrix<f64>,
    shortening: Vec<Shortened>,
    /// U_k·K U_l.
    stiffness: DMatrix<f64>,
}

impl SecondOrder {
    /// For an element with the mass matrix `mass`; `matrices` are scaled likewise.
    pub(super) fn of(element: &Part, mass: &DMatrix<f64>, matrices: &GeometricMatrices) -> Self {
        let rigid =
            [0, 1, 2, 3, 4, 5].map(|k| DVector::from_vec(rigid_column(&element.places, element.size(), k)));
        let turns = [&rigid[3], &rigid[4], &rigid[5]];
        let momenta = turns.map(|turn| mass * turn);
        let mean = MeanRotation::of(mass, &rigid);
        let shortening: Vec<Shortened> = matrices
            .shortening
            .iter()
            .map(|own| Shortened {
                direction: own.direction.clone(),
                matrix: own.matrix.clone(),
                pulled: &element.stiffness * &own.direction,
            })
            .collect();
        let along = |k: usize, l: usize| shortening[k].direction.dot(&shortening[l].pulled);
        // Shortenings along natural modes are uncoupled except for round-off: products of all pairs would take most of the time.
        let stiffness = DMatrix::from_fn(shortening.len(), shortening.len(), |k, l| {
            let own = along(k, l);
            if own.abs() > round_off::COUPLING * (along(k, k) * along(l, l)).abs().sqrt() { own } else { 0.0 }
        });
        Self {
            first_moment: element.moment,
            moment_slope: [0, 1, 2].map(|k| element.carried.row(k).transpose()),
            moment: matrices.moment.clone(),
            turning: [
                TurningLaw::of_points(&matrices.points, turns, momenta),
                TurningLaw::of_sections(&matrices.sections, mean),
            ],
            mass: mass.clone(),
            shortening,
            stiffness,
        }
    }
}

/// Scratch for one element at one instant.
#[derive(Default)]
pub(super) struct Deformed {
    relatives: Vec<Option<Relative>>,
    shape: Shape,
    frame: FloatingFrame,
    /// G + S y, S ẏ.
    moment: [DVector<f64>; 3],
    moment_rate: [DVector<f64>; 3],
    /// Matrices of points and of sections.
    turning: [Turning; 2],
    /// D y.
    shortening: Vec<DVector<f64>>,
    /// h, g.
    shorter: Vec<f64>,
    pull: Vec<f64>,
    /// Force dual to y.
    force: DVector<f64>,
    room: DVector<f64>,
    maps: Maps,
    product: DMatrix<f64>,
    rows: DMatrix<f64>,
}

/// y, ẏ, ÿ.
#[derive(Default)]
struct Shape {
    place: DVector<f64>,
    rate: DVector<f64>,
    second: DVector<f64>,
}

/// Motion of the floating frame, in its axes.
#[derive(Default)]
struct FloatingFrame {
    velocity: Vector3,
    spin: Vector3,
    spin_rate: Vector3,
    gravity: Vector3,
    /// a.
    against: Vector3,
}

/// Maps of the unknowns to y, of positions to ẏ, and of positions and twists to ÿ.
#[derive(Default)]
struct Maps {
    gradient: Map,
    rate_by_place: Map,
    second_by_place: Map,
    second_by_twist: Map,
}

impl Deformed {
    /// Evaluates the motion `at`.
    fn enter(&mut self, of: &Part, law: &SecondOrder, at: &Kinematics) {
        let (size, nodes) = (of.size(), of.nodes.len());
        for vector in [
            &mut self.shape.place,
            &mut self.shape.rate,
            &mut self.shape.second,
            &mut self.force,
            &mut self.room,
        ] {
            resize(vector, size);
            vector.fill(0.0);
        }
        let base = &at.nodes[of.nodes[of.frame]];
        self.frame.velocity = translation_part(&base.twist);
        self.frame.spin = rotation_part(&base.twist);
        self.frame.spin_rate = rotation_part(&base.acceleration);
        self.frame.gravity = base.frame.rotation.apply_inverse(&of.gravity.at(at.time));
        let own = translation_part(&base.acceleration);
        self.frame.against = own + self.frame.spin.cross(&self.frame.velocity) - self.frame.gravity;
        self.relatives.clear();
        for i in 0..nodes {
            let relative = Relative::of(of, i, at);
            if let Some(seen) = &relative {
                let (rate, second) = (seen.rate(), seen.second());
                let shift = seen.arm - of.places[i];
                for k in 0..3 {
                    self.shape.place[6 * i + k] = shift[k];
                    self.shape.place[6 * i + 3 + k] = seen.axis[k];
                }
                for k in 0..6 {
                    self.shape.rate[6 * i + k] = rate[k];
                    self.shape.second[6 * i + k] = second[k];
                }
            }
            self.relatives.push(relative);
        }
        for (k, &coordinate) in of.coordinates.iter().enumerate() {
            let (row, motion) = (6 * nodes + k, &at.coordinates[coordinate]);
            self.shape.place[row] = motion.value;
            self.shape.rate[row] = motion.rate;
            self.shape.second[row] = motion.acceleration;
        }
        self.fill(of, law);
    }

    fn fill(&mut self, of: &Part, law: &SecondOrder) {
        for k in 0..3 {
            times(&law.moment[k], &self.shape.place, &mut self.moment[k]);
            self.moment[k] += &law.moment_slope[k];
            times(&law.moment[k], &self.shape.rate, &mut self.moment_rate[k]);
        }
        let at = PartMotion {
            displacement: &self.shape.place,
            rate: &self.shape.rate,
            second: &self.shape.second,
            spin: self.frame.spin,
            spin_rate: self.frame.spin_rate,
        };
        for (own, law) in self.turning.iter_mut().zip(&law.turning) {
            own.enter(law, &at);
        }
        self.shortening.resize_with(law.shortening.len(), DVector::default);
        self.shorter.clear();
        self.pull.clear();
        times(&of.stiffness, &self.shape.place, &mut self.room);
        for (own, product) in law.shortening.iter().zip(&mut self.shortening) {
            times(&own.matrix, &self.shape.place, product);
            let shorter = 0.5 * product.dot(&self.shape.place);
            self.shorter.push(shorter);
            self.room.axpy(shorter, &own.pulled, 1.0);
        }
        for own in &law.shortening {
            self.pull.push(own.direction.dot(&self.room));
        }
    }

    /// s, ṡ.
    fn first_moment(&self, law: &SecondOrder) -> [Vector3; 2] {
        let half = |k: usize| {
            0.5 * (self.moment[k].dot(&self.shape.place) + law.moment_slope[k].dot(&self.shape.place))
        };
        [
            law.first_moment + Vector3::from_fn(|k, _| half(k)),
            Vector3::from_fn(|k, _| self.moment[k].dot(&self.shape.rate)),
        ]
    }

    /// Stores the force dual to y in `force`.
    fn fill_force(&mut self, law: &SecondOrder) {
        let force = &mut self.force;
        force.gemv(1.0, &law.mass, &self.shape.second, 0.0);
        for k in 0..3 {
            force.axpy(self.frame.against[k], &self.moment[k], 1.0);
        }
        for (own, law) in self.turning.iter().zip(&law.turning) {
            own.add_dual(law, force);
        }
        for (k, own) in law.shortening.iter().enumerate() {
            force.axpy(self.pull[k], &self.shortening[k], 1.0);
            force.axpy(self.shorter[k], &own.pulled, 1.0);
        }
    }

    /// Adds the forces at the motion `at`.
    pub(super) fn add_forces(&mut self, of: &Part, law: &SecondOrder, at: &Kinematics, out: &mut [f64]) {
        self.enter(of, law, at);
        self.fill_force(law);
        let [s, rate] = self.first_moment(law);
        let second = Vector3::from_fn(|k, _| {
            self.moment_rate[k].dot(&self.shape.rate) + self.moment[k].dot(&self.shape.second)
        });
        let (w, dw) = (self.frame.spin, self.frame.spin_rate);
        let force = of.total * self.frame.against
            + second
            + dw.cross(&s)
            + 2.0 * w.cross(&rate)
            + w.cross(&w.cross(&s));
        let moment = s.cross(&self.frame.against) + self.turning[0].moment() + self.turning[1].moment();
        add(out, 6 * of.frame, &force);
        add(out, 6 * of.frame + 3, &moment);
        self.add_dual(of, out);
    }

    /// Adds Yᵀ times the force dual to y.
    fn add_dual(&self, of: &Part, out: &mut [f64]) {
        for (i, seen) in self.relatives.iter().enumerate() {
            let Some(seen) = seen else { continue };
            let part = |first: usize| Vector3::from_fn(|k, _| self.force[6 * i + first + k]);
            let own = seen.gradient().tr_mul(&screw(&part(0), &part(3)));
            let on_frame = -seen.to_own.tr_mul(&own);
            for k in 0..6 {
                out[6 * i + k] += own[k];
                out[6 * of.frame + k] += on_frame[k];
            }
        }
        for row in 6 * of.nodes.len()..of.size() {
            out[row] += self.force[row];
        }
    }

    /// Energies at the motion `at`.
    pub(super) fn energy(&mut self, of: &Part, law: &SecondOrder, at: &Kinematics) -> Energy {
        self.enter(of, law, at);
        let [s, rate] = self.first_moment(law);
        self.room.gemv(1.0, &law.mass, &self.shape.rate, 0.0);
        let kinetic = 0.5 * of.total * self.frame.velocity.norm_squared()
            + self.frame.velocity.dot(&(self.frame.spin.cross(&s) + rate))
            + self.turning[0].kinetic()
            + self.turning[1].kinetic()
            + 0.5 * self.room.dot(&self.shape.rate);
        // h·(K y + ½ K h), of h·(K y + K h).
        let mut strain = 0.0;
        for k in 0..law.shortening.len() {
            strain += self.shorter[k] * self.pull[k];
            for l in 0..law.shortening.len() {
                strain -= 0.5 * self.shorter[k] * self.shorter[l] * law.stiffness[(k, l)];
            }
        }
        let base = &at.nodes[of.nodes[of.frame]].frame;
        let weighed = of.total * base.position + base.rotation.apply(&s);
        Energy { kinetic, strain, potential: -of.gravity.acceleration.dot(&weighed) }
    }

    fn fill_maps(&mut self, nodes: usize) {
        self.maps.gradient.begin(true);
        for map in
            [&mut self.maps.rate_by_place, &mut self.maps.second_by_place, &mut self.maps.second_by_twist]
        {
            map.begin(false);
        }
        for i in 0..nodes {
            let Some(seen) = &self.relatives[i] else {
                let none = Matrix6::zeros();
                for map in [
                    &mut self.maps.gradient,
                    &mut self.maps.rate_by_place,
                    &mut self.maps.second_by_place,
                    &mut self.maps.second_by_twist,
                ] {
                    map.push(&none, &none);
                }
                continue;
            };
            let own = seen.gradient();
            let slopes = seen.slopes();
            self.maps.gradient.push(&own, &(-own * seen.to_own));
            self.maps.rate_by_place.push(&slopes.rate_by_place, &(-slopes.rate_by_place * seen.to_own));
            self.maps.second_by_place.push(&slopes.second_by_place, &(-slopes.second_by_place * seen.to_own));
            self.maps
                .second_by_twist
                .push(&slopes.second_by_twist, &(slopes.second_by_carried * seen.to_own));
        }
    }

    /// Adds the mass matrix.
    pub(super) fn add_mass(&mut self, of: &Part, law: &SecondOrder, at: &Kinematics, out: &mut [f64]) {
        self.enter(of, law, at);
        self.fill_maps(of.nodes.len());
        self.add_mass_entered(of, law, out);
    }

    fn add_mass_entered(&mut self, of: &Part, law: &SecondOrder, out: &mut [f64]) {
        let (size, frame) = (of.size(), 6 * of.frame);
        let [s, _] = self.first_moment(law);
        let lever = skew(&s);
        // Force and moment on f due to ÿ, through Y; the transpose on y.
        let mut rows = DMatrix::zeros(6, size);
        for k in 0..3 {
            rows.row_mut(k).tr_copy_from(&self.moment[k]);
        }
        let (mut among, mut inertia) = (law.mass.clone(), Matrix3::zeros());
        for (own, law) in self.turning.iter().zip(&law.turning) {
            let part = own.mass(law);
            inertia += part.inertia;
            let mut below = rows.fixed_rows_mut::<3>(3);
            below += part.coupling;
            if let Some(part) = part.among {
                among += part;
            }
        }
        self.maps.gradient.after(&among, of.frame, &mut self.product);
        self.maps.gradient.add_before(&self.product, of.frame, out);
        self.maps.gradient.after(&rows, of.frame, &mut self.product);
        for row in 0..6 {
            for column in 0..size {
                out[(frame + row) * size + column] += self.product[(row, column)];
                out[column * size + frame + row] += self.product[(row, column)];
            }
        }
        for i in 0..3 {
            out[(frame + i) * (size + 1)] += of.total;
            for j in 0..3 {
                out[(frame + i) * size + frame + 3 + j] -= lever[(i, j)];
                out[(frame + 3 + i) * size + frame + j] += lever[(i, j)];
                out[(frame + 3 + i) * size + frame + 3 + j] += inertia[(i, j)];
            }
        }
    }

    /// Adds the derivatives of the forces at the motion `at`.
    pub(super) fn add_tangents(&mut self, of: &Part, law: &SecondOrder, at: &Kinematics, out: &mut Tangents) {
        self.enter(of, law, at);
        self.fill_maps(of.nodes.len());
        self.fill_force(law);
        self.add_mass_entered(of, law, &mut out.mass);
        let at = PartMotion {
            displacement: &self.shape.place,
            rate: &self.shape.rate,
            second: &self.shape.second,
            spin: self.frame.spin,
            spin_rate: self.frame.spin_rate,
        };
        let mut turning = self.turning[0].slopes(&law.turning[0], &at);
        turning += self.turning[1].slopes(&law.turning[1], &at);
        self.add_on_shape(of, law, &turning, out);
        self.add_on_frame(of, law, &turning, out);
        for (i, seen) in self.relatives.iter().enumerate() {
            let Some(seen) = seen else { continue };
            let part = |first: usize| Vector3::from_fn(|k, _| self.force[6 * i + first + k]);
            seen.add_geometric((of, i), (&part(0), &part(3)), &mut out.stiffness);
        }
    }

    /// Adds the derivatives of the force dual to y with respect to positions and twists.
    fn add_on_shape(&mut self, of: &Part, law: &SecondOrder, turning: &TurningSlopes, out: &mut Tangents) {
        let frame = of.frame;
        let (mut by_place, by_rate) = (self.shape_by_place(of, law), &turning.dual[1]);
        by_place += &turning.dual[0];
        // With respect to a, which depends on the floating frame's pose and twist, and to ω.
        let moment = MatrixXx3::from_columns(&self.moment);
        let turned = -(&moment * skew(&self.frame.gravity));
        let by_velocity = &moment * skew(&self.frame.spin);
        let by_spin = &turning.dual_by_spin - &moment * skew(&self.frame.velocity);
        self.maps.gradient.after(&by_place, frame, &mut self.product);
        self.maps.rate_by_place.after(by_rate, frame, &mut self.rows);
        self.product += &self.rows;
        let mut by_second = law.mass.clone();
        if let Some(among) = &turning.among {
            by_second += among;
        }
        self.maps.second_by_place.after(&by_second, frame, &mut self.rows);
        self.product += &self.rows;
        {
            let mut view = self.product.columns_mut(6 * frame + 3, 3);
            view += &turned;
        }
        self.maps.gradient.add_before(&self.product, frame, &mut out.stiffness);
        self.maps.gradient.after(by_rate, frame, &mut by_place);
        self.maps.second_by_twist.after(&by_second, frame, &mut self.rows);
        by_place += &self.rows;
        for (first, columns) in [(0, &by_velocity), (3, &by_spin)] {
            let mut view = by_place.columns_mut(6 * frame + first, 3);
            view += columns;
        }
        self.maps.gradient.add_before(&by_place, frame, &mut out.damping);
    }

    /// Derivative of the force dual to y with respect to y, without that of rotation.
    fn shape_by_place(&self, of: &Part, law: &SecondOrder) -> DMatrix<f64> {
        let size = of.size();
        let mut matrix = DMatrix::zeros(size, size);
        let mut add = |factor: f64, own: &DMatrix<f64>| {
            if factor != 0.0 {
                matrix.zip_apply(own, |sum, value| *sum += factor * value);
            }
        };
        for k in 0..3 {
            add(self.frame.against[k], &law.moment[k]);
        }
        for (k, own) in law.shortening.iter().enumerate() {
            add(self.pull[k], &own.matrix);
        }
        for (k, own) in law.shortening.iter().enumerate() {
            matrix.ger(1.0, &self.shortening[k], &own.pulled, 1.0);
            matrix.ger(1.0, &own.pulled, &self.shortening[k], 1.0);
            for (l, other) in self.shortening.iter().enumerate() {
                let along = law.stiffness[(k, l)];
                if along != 0.0 {
                    matrix.ger(along, &self.shortening[k], other, 1.0);
                }
            }
        }
        matrix
    }

    /// Adds the derivatives of force and moment on the floating frame with respect to positions and twists.
    fn add_on_frame(&mut self, of: &Part, law: &SecondOrder, turning: &TurningSlopes, out: &mut Tangents) {
        let (size, frame) = (of.size(), 6 * of.frame);
        let (w, dw) = (self.frame.spin, self.frame.spin_rate);
        let (turn, turn_rate) = (skew(&w), skew(&dw));
        let [s, rate] = self.first_moment(law);
        let lever = skew(&s);
        let moment = rows(&self.moment);
        let moment_rate = rows(&self.moment_rate);
        let moment_second = rows(&law.moment.each_ref().map(|own| own * &self.shape.second));
        let centrifugal = turn_rate + turn * turn;
        let force_by_place = moment_second + centrifugal * &moment + 2.0 * turn * &moment_rate;
        let force_by_rate = 2.0 * moment_rate + 2.0 * turn * &moment;
        let [moment_by_place, moment_by_rate, moment_by_second] = &turning.moment;
        let moment_by_place = moment_by_place - skew(&self.frame.against) * &moment;
        let stacked =
            |above: &Matrix3xX<f64>, below: &Matrix3xX<f64>| {
                DMatrix::from_fn(6, size, |row, column| {
                    if row < 3 { above[(row, column)] } else { below[(row - 3, column)] }
                })
            };
        let by_place = stacked(&force_by_place, &moment_by_place);
        let by_rate = stacked(&force_by_rate, moment_by_rate);
        let by_second = stacked(&moment, moment_by_second);
        let mut sum = DMatrix::zeros(6, size);
        for (map, matrix) in [
            (&self.maps.gradient, &by_place),
            (&self.maps.rate_by_place, &by_rate),
            (&self.maps.second_by_place, &by_second),
        ] {
            map.after(matrix, of.frame, &mut self.rows);
            sum += &self.rows;
        }
        add_three(&mut sum, (0, frame + 3), &-(of.total * skew(&self.frame.gravity)));
        add_three(&mut sum, (3, frame + 3), &-(lever * skew(&self.frame.gravity)));
        add_to(&mut out.stiffness, (frame, size), &sum);
        sum.fill(0.0);
        for (map, matrix) in [(&self.maps.gradient, &by_rate), (&self.maps.second_by_twist, &by_second)] {
            map.after(matrix, of.frame, &mut self.rows);
            sum += &self.rows;
        }
        let force_by_spin =
            -of.total * skew(&self.frame.velocity) - 2.0 * skew(&rate) - skew(&w.cross(&s)) - turn * lever;
        let moment_by_spin = turning.moment_by_spin - lever * skew(&self.frame.velocity);
        add_three(&mut sum, (0, frame), &(of.total * turn));
        add_three(&mut sum, (0, frame + 3), &force_by_spin);
        add_three(&mut sum, (3, frame), &(lever * turn));
        add_three(&mut sum, (3, frame + 3), &moment_by_spin);
        add_to(&mut out.damping, (frame, size), &sum);
    }
}

fn add_three(matrix: &mut DMatrix<f64>, at: (usize, usize), block: &Matrix3) {
    let mut view = matrix.fixed_view_mut::<3, 3>(at.0, at.1);
    view += block;
}

/// Adds rows to a local matrix from the row `first` on.
fn add_to(out: &mut [f64], (first, size): (usize, usize), rows: &DMatrix<f64>) {
    for row in 0..rows.nrows() {
        for column in 0..size {
            out[(first + row) * size + column] += rows[(row, column)];
        }
    }
}
