//! Forces of a tyre property file over slip, slip angle and both: tables and a figure.

use std::fmt::Write;

use lissom_core::elements::tyre::magic_formula::MagicFormula;
use lissom_model::files::tyre_file::TyreFile;
use lissom_model::output::{Axis, Chart, Curve, FigureError, Graphic, Panel};

/// Forces of a tyre in steady rolling.
#[derive(Clone, Debug)]
pub struct TyreCurves {
    law: MagicFormula,
    name: String,
    /// Normal forces [N].
    loads: Vec<f64>,
    /// Camber [rad] and velocity [m/s].
    camber: f64,
    velocity: f64,
}

/// A tyre at a slip.
struct Point {
    load: f64,
    /// Slip and slip angle [rad].
    slip: [f64; 2],
    /// F₁, F₂, M₁, M₂ and M₃.
    forces: [f64; 5],
}

impl TyreCurves {
    /// The tyre of a file under normal forces [N], by default half, once and one and a half times the nominal one, with a camber [rad].
    ///
    /// # Errors
    /// If the file lacks a coefficient, a normal force is not positive, or a force is not finite.
    pub fn new(name: &str, file: &TyreFile, loads: &[f64], camber: f64) -> Result<Self, String> {
        let law = MagicFormula::new(&file.coefficients, false)
            .map_err(|error| error.problem.replace("needs", "it needs"))?;
        if let Some(load) = loads.iter().find(|load| !(load.is_finite() && **load > 0.0)) {
            return Err(format!("the normal force {load:?} N is not positive and finite"));
        }
        let nominal = law.nominal_load();
        let loads = if loads.is_empty() {
            [0.5, 1.0, 1.5].map(|part| part * nominal).to_vec()
        } else {
            loads.to_vec()
        };
        let curves = Self { velocity: law.measured_velocity(), law, name: name.to_owned(), loads, camber };
        let points = curves.points();
        match points.iter().find(|point| point.forces.iter().any(|force| !force.is_finite())) {
            Some(Point { load, slip: [slip, angle], .. }) => Err(format!(
                "its coefficients have no finite forces at the normal force {load:?} N, slip {slip}, slip angle {angle} rad and camber {camber} rad"
            )),
            None => Ok(curves),
        }
    }

    /// A warning of normal forces beyond those for which the file has data.
    pub fn warning(&self) -> Option<String> {
        let [low, high] = [self.law.smallest_load(), self.law.largest_load()];
        let load = self.loads.iter().find(|load| !(low..=high).contains(*load))?;
        Some(format!(
            "the normal force {load:?} N is beyond those for which the file has data, {low:.0} to {high:.0} N: the forces are extrapolated"
        ))
    }

    fn at(&self, load: f64, slip: [f64; 2]) -> Point {
        let forces = self.law.forces([slip[0], slip[1], self.camber], load, self.velocity);
        Point { load, slip, forces }
    }

    /// Points over slips from -1 to 1 at each of these slip angles.
    fn over_slip(&self, angles: &[f64]) -> Vec<Vec<Point>> {
        let curve = |load: f64, angle: f64| -> Vec<Point> {
            // Closer near zero, where the curves are steep.
            let slip = |k: i32| (f64::from(k) / 100.0).powi(3);
            (-100..=100).map(|k| self.at(load, [slip(k), angle])).collect()
        };
        let loads = self.loads.iter();
        loads.flat_map(|load| angles.iter().map(|angle| curve(*load, *angle))).collect()
    }

    /// Points over slip angles from -20 to 20 degrees without slip.
    fn over_angle(&self) -> Vec<Vec<Point>> {
        let curve = |load: &f64| -> Vec<Point> {
            (-100..=100).map(|k| self.at(*load, [0.0, (0.2 * f64::from(k)).to_radians()])).collect()
        };
        self.loads.iter().map(curve).collect()
    }

    /// The points of the table.
    fn points(&self) -> Vec<Point> {
        let curves = self.over_slip(&[0.0, 0.05, 0.1, 0.2]).into_iter().chain(self.over_angle());
        curves.flatten().collect()
    }

    /// The table `tyre.csv`: normal force, slip, slip angle [rad], longitudinal and lateral force, moments about x, y and z.
    pub fn csv(&self) -> String {
        let mut text =
            "load,slip,slip_angle,longitudinal,lateral,overturning,resisting,aligning\n".to_owned();
        for point in self.points() {
            let numbers = [point.load, point.slip[0], point.slip[1]].into_iter().chain(point.forces);
            let cells: Vec<String> = numbers.map(|number| format!("{number:?}")).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }

    /// Stiffnesses, friction and relaxation lengths at each normal force, in words.
    pub fn text(&self) -> String {
        let mut text =
            format!("  free radius {} m, nominal load {} N\n", self.law.radius(), self.law.nominal_load());
        text += "      load   slip stiffness   cornering stiffness   peak friction along, across   relaxation along, across\n";
        text += "         N            N               N/rad                                            m\n";
        for &load in &self.loads {
            let step = 1e-4;
            let slope = |slip: [f64; 2], component: usize| {
                let [low, high] =
                    [-1.0, 1.0].map(|sign| self.at(load, slip.map(|own| sign * own)).forces[component]);
                (high - low) / (2.0 * step)
            };
            let most = |points: &[Vec<Point>], component: usize| {
                let own = points.iter().flatten().filter(|point| point.load.total_cmp(&load).is_eq());
                own.map(|point| point.forces[component].abs()).fold(0.0, f64::max) / load
            };
            let [along, across] = self.law.relaxation(load, self.camber.sin());
            let _ = writeln!(
                text,
                "  {load:>8.0} {:>16.0} {:>21.0} {:>18.3} {:>10.3} {along:>18.3} {across:>7.3}",
                slope([step, 0.0], 0),
                -slope([0.0, step], 1),
                most(&self.over_slip(&[0.0]), 0),
                most(&self.over_angle(), 1),
            );
        }
        text
    }

    /// The figure `tyre`: longitudinal force over slip, lateral force and aligning moment over slip angle, and both forces of combined slip.
    ///
    /// # Errors
    /// If it has no points.
    pub fn figure(&self) -> Result<Graphic, FigureError> {
        let panel = |x: &str, y: &str, curves: Vec<Vec<(f64, f64)>>, names: &[String]| Panel {
            x: Axis::new(x),
            y: Axis::new(y),
            curves: (curves.into_iter().enumerate())
                .map(|(index, points)| Curve { name: names[index].clone(), points, ..Curve::numbered(index) })
                .collect(),
        };
        let points = |curves: &[Vec<Point>], of: fn(&Point) -> (f64, f64)| -> Vec<Vec<(f64, f64)>> {
            curves.iter().map(|curve| curve.iter().map(of).collect()).collect()
        };
        let loads: Vec<String> = self.loads.iter().map(|load| format!("{load:.0} N")).collect();
        let angles = [0.0, 2.0, 5.0, 10.0];
        let middle = Self { loads: vec![self.loads[self.loads.len() / 2]], ..self.clone() };
        let degrees: Vec<String> = angles.iter().map(|angle| format!("{angle}°")).collect();
        let combined = middle.over_slip(&angles.map(f64::to_radians));
        let over_angle = self.over_angle();
        let panels = vec![
            panel(
                "slip [-]",
                "longitudinal force [N]",
                points(&self.over_slip(&[0.0]), |own| (own.slip[0], own.forces[0])),
                &loads,
            ),
            panel(
                "slip angle [°]",
                "lateral force [N]",
                points(&over_angle, |own| (own.slip[1].to_degrees(), own.forces[1])),
                &loads,
            ),
            panel(
                "slip angle [°]",
                "aligning moment [N m]",
                points(&over_angle, |own| (own.slip[1].to_degrees(), own.forces[4])),
                &loads,
            ),
            panel(
                "longitudinal force [N]",
                "lateral force [N]",
                points(&combined, |own| (own.forces[0], own.forces[1])),
                &degrees,
            ),
        ];
        let chart =
            Chart { columns: 2, width: 1180.0, title: self.name.clone(), ..Chart::new("tyre", panels) };
        Ok(chart.draw().into())
    }
}
