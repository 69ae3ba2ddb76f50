//! Whether prescribed motions begin where their joints are, and go on without jumps of speed.

use lissom_core::errors::Warning;
use lissom_core::kinematics::{Quantity, Subject};
use lissom_core::system::{Drive, State, System};

use lissom_model::Problem;
use lissom_model::document::{AnalysisKind, Component, Document};

/// Difference at the start that is round-off of given numbers [m, rad].
const SAME_PLACE: f64 = 1e-6;

/// Distance from a breakpoint at which functions are evaluated, relative to the whole run.
const ASIDE: f64 = 1e-9;
/// Speeds that differ by less than this fraction of the largest speed are the same.
const SAME_SPEED: f64 = 1e-3;
/// Instants at which the largest speed is looked for.
const INSTANTS: u32 = 64;

/// Rejects prescribed motions that begin elsewhere; warns of those whose speed jumps.
pub(super) fn drives(
    document: &Document,
    system: &System,
    state: &State,
    problems: &mut Vec<Problem>,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let moves = matches!(document.analysis.kind, AnalysisKind::Dynamics { .. });
    for drive in system.drives() {
        // The drive of one component of a motion is called after both.
        let (owner, part) = drive.name.split_once(", ").map_or((&*drive.name, None), |(a, b)| (a, Some(b)));
        let Some(component) = document.joints.iter().find(|joint| joint.name.value == owner) else {
            continue;
        };
        if moves && !document.starts_in_equilibrium() {
            problems.extend(begins_elsewhere((component, part), system, drive, state));
        }
        if moves {
            warnings.extend(jumps(component, drive, (document.analysis.start, document.analysis.end)));
        }
    }
    warnings
}

/// The key under which a drive has its function.
fn key(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Angle => "rotation",
        Quantity::Length | Quantity::State => "displacement",
    }
}

fn begins_elsewhere(
    (component, part): (&Component, Option<&str>),
    system: &System,
    drive: &Drive,
    state: &State,
) -> Option<Problem> {
    let own = state.kinematics.coordinates[drive.prescribed.coordinate].value;
    let wanted = drive.prescribed.value.value(state.kinematics.time);
    let distance = (wanted - own).abs();
    // A value that is not a number is named where it is evaluated.
    if distance <= SAME_PLACE || distance.is_nan() {
        return None;
    }
    let quantity = system.layout().coordinate_quantity(drive.prescribed.coordinate);
    let (unit, key) = (if quantity == Quantity::Angle { "rad" } else { "m" }, part.unwrap_or(key(quantity)));
    let message = format!(
        "the drive `{}` starts at {wanted} {unit}, but its joint is at {own} {unit} at t = {} s",
        drive.name, state.kinematics.time
    );
    Some(Problem::error(component.span_of(key), message).label("jumps at the start").help(format!(
        "let it start at {own}, or place the parts and give the joint's value at the start so that they agree"
    )))
}

fn jumps(component: &Component, drive: &Drive, (start, end): (f64, f64)) -> Option<Warning> {
    let function = &drive.prescribed.value;
    let aside = ASIDE * (end - start);
    // A speed that starts or ends at zero has no magnitude: its change is compared with the largest one.
    let speeds = (0..=INSTANTS)
        .map(|index| start + (end - start) * f64::from(index) / f64::from(INSTANTS))
        .chain(function.breakpoints().into_iter().flat_map(|kink| [kink - aside, kink + aside]))
        .filter(|time| (start..=end).contains(time))
        .map(|time| function.first_derivative(time).abs());
    let fastest = speeds.filter(|speed| speed.is_finite()).fold(0.0, f64::max);
    let is_jump = |&time: &f64| {
        let [before, after] = [time - aside, time + aside].map(|time| function.first_derivative(time));
        let way = function.value(time + aside) - function.value(time - aside);
        let smooth = aside * (before.abs() + after.abs());
        (after - before).abs() > SAME_SPEED * fastest
            || (way - aside * (before + after)).abs() > smooth + SAME_PLACE
    };
    let inside = |time: &f64| (start + aside..end - aside).contains(time);
    let jumps: Vec<f64> = function.breakpoints().into_iter().filter(inside).filter(is_jump).collect();
    let first = jumps.first()?;
    Some(Warning::Model {
        part: Subject::new("drive", &*component.name.value),
        message: format!(
            "what the drive `{}` prescribes jumps in position or speed at t = {first} s{}: forces there have no limit and \
             depend on the step",
            component.name.value,
            if jumps.len() > 1 { format!(" and {} more times", jumps.len() - 1) } else { String::new() }
        ),
        help: "give a table `interpolation = \"spline\"`, or another function".to_owned(),
    })
}
