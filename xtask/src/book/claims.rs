//! The claims of [Epple 2008] about the method, each with the command that measures it, the figure, and whether they agree.

use lissom::Model;
use lissom::analyses::study::conditioning::Request;
use lissom::analyses::study::{self, convergence};
use lissom::core::schemes;

use super::conditioning::{Conditions, MASS, conditions, with_steps, with_values};
use super::factorization::{Case, Factored, augmented, study};
use super::fragment::{Fragment, overrides, study_command, texts};
use super::numbers::{bound, one, two};
use super::published::{MASSES, STEPS};
use super::{BookError, Studio};

const PENDULUM: &str = "pendulum";
const CRANK: &str = "tip-crank";
/// A solver that does not pivot, like that of the source.
const SOLVER: &str = "sparse";
const STIFFNESS: &str = "springs.spring.stiffness";
/// Command of claims without a table of their own.
const ALL: &str = "cargo xtask claims";

/// Columns of condition numbers.
const NONE: usize = 0;
const UNIT: usize = 1;
const PHYSICAL: usize = 2;
const EQUILIBRATED: usize = 3;
/// Largest ratio of condition numbers that are called independent of a parameter.
const FLAT: f64 = 2.0;
/// Distance of an exponent or order from the expected one.
const EXPONENT: f64 = 0.15;
/// Ends of the axis of figure 2.3 [m].
const AXIS: [f64; 2] = [-4e-3, 12e-3];
/// Lateral displacement at the onset of buckling [m].
const ONSET: f64 = 1e-4;
/// Violation of a constraint that is round-off [m].
const ROUNDOFF: f64 = 1e-12;

/// Difference of displacements that is round-off of 800 steps [m].
const SAME: f64 = 1e-10;
/// A weight of the augmented term with which elimination loses a pivot without scaling.
const LIGHT: &str = "1e-9";
/// Words of the message about it.
const LOST: &str = "which is their round-off";

/// A claim and its measurement.
struct Claim {
    source: &'static str,
    measured: String,
    agrees: bool,
    /// Whether it is known to agree: a difference from this is a failure of the command.
    expected: bool,
    /// The parameter at another value of which it agrees.
    depends_on: Option<&'static str>,
    command: String,
}

/// All claims as a table.
///
/// # Errors
/// If a measurement fails, or a claim agrees that did not, or does not agree that did.
pub(super) fn claims(studio: &Studio) -> Result<Fragment, BookError> {
    let mut claims = Vec::new();
    over_step(studio, &mut claims)?;
    over_mass_and_stiffness(studio, &mut claims)?;
    of_schemes(studio, &mut claims)?;
    of_states(studio, &mut claims)?;
    buckling(studio, &mut claims)?;
    elimination(studio, &mut claims)?;
    orders(studio, &mut claims)?;
    drift(studio, &mut claims)?;
    let mut fragment = Fragment::default();
    let rows: Vec<Vec<String>> = claims
        .iter()
        .map(|claim| {
            let agrees = match (claim.agrees, claim.depends_on) {
                (true, _) => "yes".to_owned(),
                (false, None) => "**no**".to_owned(),
                (false, Some(parameter)) => format!("depends on {parameter}"),
            };
            let command = format!("`{}`", claim.command);
            vec![claim.source.to_owned(), claim.measured.clone(), agrees, command]
        })
        .collect();
    fragment.table(&["claim", "measured", "agrees", "command"], &rows);
    match claims.iter().find(|claim| claim.agrees != claim.expected) {
        Some(claim) => Err(BookError::Claim { claim: claim.source, measured: claim.measured.clone() }),
        None => Ok(fragment),
    }
}

/// Condition numbers of a column, in the order of the rows.
fn column(table: &[Conditions], scaling: usize) -> Vec<f64> {
    table.iter().map(|row| row[scaling]).collect()
}

/// Smallest and largest value; not a number if a value is none.
fn extremes(values: &[f64]) -> (f64, f64) {
    if values.iter().any(|value| value.is_nan()) {
        return (f64::NAN, f64::NAN);
    }
    let fold = |of: fn(f64, f64) -> f64| values.iter().copied().fold(f64::NAN, of);
    (fold(f64::min), fold(f64::max))
}

/// Lengths in millimetres with one decimal.
fn in_millimetres((least, most): (f64, f64)) -> (f64, f64) {
    // Zero is added so that it has no sign.
    let round = |value: f64| (1e4 * value).round() / 10.0 + 0.0;
    (round(least), round(most))
}

/// Largest over smallest value.
fn spread(values: &[f64]) -> f64 {
    let (least, most) = extremes(values);
    most / least
}

/// Exponent of values between the first and the last of `at`.
fn exponent(values: &[f64], at: &[f64]) -> f64 {
    let [from, to] = [0, values.len() - 1];
    (values[to] / values[from]).ln() / (at[to] / at[from]).ln()
}

fn numbers(texts: &[&str]) -> Vec<f64> {
    texts.iter().map(|text| text.parse().unwrap_or(f64::NAN)).collect()
}

fn over_step(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    let steps = STEPS.map(|(step, _)| step);
    let table = conditions(studio, PENDULUM, &with_steps(&steps, &[]))?;
    let command = "cargo xtask figures conditioning-steps".to_owned();
    let none = exponent(&column(&table, NONE), &numbers(&steps));
    let printed = numbers(&STEPS.map(|(_, values)| values[NONE]));
    let ratios: Vec<f64> =
        column(&table, NONE).iter().zip(printed).map(|(ours, printed)| ours / printed).collect();
    let ratio = extremes(&ratios);
    claims.push(Claim {
        source: "table 2.1: without scaling, κ grows as h⁻⁴",
        measured: format!("h^{none:.2}; {:.1} to {:.1} times the printed values", ratio.0, ratio.1),
        agrees: (none + 4.0).abs() < EXPONENT,
        expected: true,
        depends_on: None,
        command: command.clone(),
    });
    let flat = [UNIT, PHYSICAL].map(|scaling| spread(&column(&table, scaling)));
    claims.push(Claim {
        source: "table 2.1: with s = 1 and with s of eq. (2.6), κ is independent of h",
        measured: format!("largest / smallest κ over four decades of h: {:.2} and {:.2}", flat[0], flat[1]),
        agrees: flat.iter().all(|&ratio| ratio < FLAT),
        expected: true,
        depends_on: None,
        command,
    });
    Ok(())
}

fn over_mass_and_stiffness(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    let masses = MASSES.map(|(mass, _)| mass);
    let table = conditions(studio, PENDULUM, &with_values(MASS, &masses))?;
    let command = "cargo xtask figures conditioning-mass".to_owned();
    let none = exponent(&column(&table, NONE), &numbers(&masses));
    // From 1 kg on: lighter masses are below s = 1.
    let unit = exponent(&column(&table, UNIT)[3..], &numbers(&masses)[3..]);
    let physical = spread(&column(&table, PHYSICAL));
    claims.push(Claim {
        source: "table 2.2: κ grows with the mass without scaling and with s = 1, as m² for large masses",
        measured: format!("m^{none:.2} and m^{unit:.2}"),
        agrees: (none - 2.0).abs() < EXPONENT && (unit - 2.0).abs() < EXPONENT,
        expected: true,
        depends_on: None,
        command: command.clone(),
    });
    claims.push(Claim {
        source: "table 2.2: with s of eq. (2.6), κ is independent of the mass",
        measured: format!("largest / smallest κ over six decades: {physical:.2}"),
        agrees: physical < FLAT,
        expected: true,
        depends_on: None,
        command,
    });
    let stiffnesses = ["1e-1", "1e0", "1e1", "1e2", "1e3", "1e4"];
    let table = conditions(studio, PENDULUM, &with_values(STIFFNESS, &stiffnesses))?;
    let physical = spread(&column(&table, PHYSICAL));
    claims.push(Claim {
        source: "similar results if the stiffness is varied",
        measured: format!("largest / smallest κ with (2.6) over five decades: {physical:.2}"),
        agrees: physical < FLAT,
        expected: true,
        depends_on: None,
        command: ALL.to_owned(),
    });
    let label = |table: &[super::published::Row], name: &str| {
        table.iter().find(|(label, _)| *label == name).map_or("", |(_, values)| values[NONE])
    };
    let rows = [label(&STEPS, "1e-2"), label(&MASSES, "1e0")];
    claims.push(Claim {
        source: "tables 2.1 and 2.2 have one case in common: 1 kg, h = 0.01 s",
        measured: format!(
            "printed without scaling: {} and {}; the tables contradict each other",
            rows[0], rows[1]
        ),
        agrees: rows[0] == rows[1],
        expected: false,
        depends_on: None,
        command: "cargo xtask figures conditioning-contradiction".to_owned(),
    });
    Ok(())
}

fn of_schemes(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    let steps = ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6"];
    let (mut ratios, mut exponents) = (Vec::new(), Vec::new());
    for kind in schemes::KINDS {
        // The parameter of the scheme in the model is for generalized-α.
        let set = [("analysis.scheme", kind.name), ("analysis.end", "0.01")];
        let table = conditions(studio, PENDULUM, &with_steps(&steps, &set))?;
        exponents.push(exponent(&column(&table, NONE), &numbers(&steps)));
        ratios.push((kind.name, [UNIT, PHYSICAL].map(|scaling| spread(&column(&table, scaling)))));
    }
    let listed: Vec<String> = ratios
        .iter()
        .map(|(scheme, [unit, physical])| format!("{scheme} {unit:.2}, {physical:.2}"))
        .collect();
    let (steepest, flattest) = extremes(&exponents);
    claims.push(Claim {
        source: "scaling before discretisation benefits all schemes",
        measured: format!(
            "without scaling κ grows as h^{flattest:.2} to h^{steepest:.2}; largest / smallest κ over h from 1e-2 to 1e-6 s with s = 1 and \
             (2.6): {}",
            listed.join("; ")
        ),
        agrees: ratios.iter().all(|(_, ratios)| ratios.iter().all(|ratio| *ratio < FLAT))
            && exponents.iter().all(|exponent| (exponent + 4.0).abs() < EXPONENT),
        expected: true,
        depends_on: None,
        command: ALL.to_owned(),
    });
    Ok(())
}

/// Condition numbers of a hydraulic model, whose states have other units than positions.
fn of_states(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    const SLEDGE: &str = "xtask/src/book/sledge.toml";
    let model = Model::read(&studio.root.join(SLEDGE))?;
    let flat = |steps: &[&str], vary: Option<(&str, [&str; 4])>| {
        let vary = vary.map(|(path, values)| (path.to_owned(), texts(&values)));
        let table =
            study::conditioning::study(&model, &Request { steps: texts(steps), vary }, &studio.watch())?;
        let points = table.series().into_iter().flat_map(|series| series.points);
        let conditions: Vec<f64> = points.map(|(_, conditions)| conditions[EQUILIBRATED]).collect();
        let is_complete = table.rows.iter().all(|row| row.outcome.is_ok());
        Ok::<_, BookError>((
            if is_complete { spread(&conditions) } else { f64::NAN },
            extremes(&conditions).1,
        ))
    };
    let over = [
        flat(&["1e-4", "1e-5", "1e-6", "1e-7"], None)?,
        flat(&["1e-5"], Some(("fluids.oil.bulk_modulus", ["1e8", "1e9", "1e10", "1e11"])))?,
        flat(&["1e-5"], Some(("parameters.level", ["1e6", "1e7", "1e8", "1e9"])))?,
    ];
    let [ratios, largest] = [over.map(|(ratio, _)| ratio), over.map(|(_, largest)| largest)];
    claims.push(Claim {
        source: "so do equations with hydraulic states",
        measured: format!(
            "largest / smallest κ over three decades of h, bulk modulus and pressure: {:.2}, {:.2} and {:.2}; κ is at most {}",
            ratios[0],
            ratios[1],
            ratios[2],
            two(extremes(&largest).1)
        ),
        agrees: ratios.iter().all(|&ratio| ratio < FLAT),
        expected: true,
        depends_on: None,
        command: format!("lissom study conditioning {SLEDGE} --steps 1e-4,1e-5,1e-6,1e-7"),
    });
    Ok(())
}

fn buckling(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    let (columns, _) = midspan(studio, &[])?;
    let [times, u1, u2, u3] = columns;
    let onset = times.iter().zip(&u2).find(|(_, u2)| u2.abs() > ONSET).map_or(f64::NAN, |(time, _)| *time);
    let command = format!("lissom run examples/{CRANK}.toml");
    claims.push(Claim {
        source: "figure 2.3: the beam buckles laterally at about 0.05 s",
        measured: format!("u2 exceeds 0.1 mm at {onset:.3} s"),
        agrees: (onset - 0.05).abs() < 0.01,
        expected: true,
        depends_on: None,
        command: command.clone(),
    });
    let is_inside = |values: &[f64]| values.iter().all(|value| *value >= AXIS[0] && *value <= AXIS[1]);
    let [of_u1, of_u2, of_u3] = [&u1, &u2, &u3].map(|values| in_millimetres(extremes(values)));
    claims.push(Claim {
        source: "figure 2.3: u1 and u3 are within its axis, -4 to 12 mm",
        measured: format!("{:.1} to {:.1} mm and {:.1} to {:.1} mm", of_u1.0, of_u1.1, of_u3.0, of_u3.1),
        agrees: is_inside(&u1) && is_inside(&u3),
        expected: true,
        depends_on: None,
        command: command.clone(),
    });
    claims.push(Claim {
        source: "figure 2.3: so is u2",
        measured: format!("{:.1} to {:.1} mm", of_u2.0, of_u2.1),
        agrees: is_inside(&u2),
        expected: false,
        depends_on: None,
        command,
    });
    Ok(())
}

/// Times [s] and displacements u1, u2, u3 at mid-span [m] of a complete run, and the largest violation of a constraint [m].
fn midspan(studio: &Studio, set: &[(&str, &str)]) -> Result<([Vec<f64>; 4], f64), BookError> {
    let mut session =
        studio.example(CRANK)?.with_overrides(&overrides(set)).session().map_err(BookError::run(CRANK))?;
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if let Some(error) = report.error() {
        return Err(BookError::run(CRANK)(error));
    }
    let of = |component: &str| record.column("midspan", component).map(<[f64]>::to_vec).unwrap_or_default();
    Ok(([record.times.clone(), of("u1"), of("u2"), of("u3")], report.violation))
}

fn elimination(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    let command = "cargo xtask figures factorization-tip-crank".to_owned();
    let model = studio.example(CRANK)?;
    let table = study(&model, CRANK, &[])?;
    let plain = |case: &&Case| case.solver == SOLVER && !case.augmented && case.scaling == "none";
    let stop = table.iter().find(plain).and_then(|case| case.outcome.as_ref().err());
    claims.push(Claim {
        source: "without the augmented term, elimination without pivoting fails at the first iteration of the first step",
        measured: stop.map_or("it has factors".to_owned(), |stop| format!("stops at the {stop}")),
        agrees: stop.is_some(),
        expected: true,
        depends_on: None,
        command: command.clone(),
    });
    let unscaled = factors(&table, "none")?;
    let scaled = factors(&table, "physical")?;
    claims.push(Claim {
        source: "with it, but without scaling, elimination without pivoting factors the tangent",
        measured: format!("smallest / largest pivot {}", one(unscaled.relative_pivot)),
        agrees: true,
        expected: true,
        depends_on: None,
        command: command.clone(),
    });
    let strict = ("analysis.solver", "strict");
    let ([_, _, plain, _], _) = midspan(studio, &[strict])?;
    let mut apart = 0.0_f64;
    for penalty in ["1", "1e-3", "1e-8"] {
        let set = [strict, ("analysis.scaling", "none"), ("analysis.penalty", penalty)];
        let ([_, _, without, _], _) = midspan(studio, &set)?;
        apart = plain.iter().zip(&without).map(|(a, b)| (a - b).abs()).fold(apart, f64::max);
    }
    let lost = midspan(studio, &[strict, ("analysis.scaling", "none"), ("analysis.penalty", LIGHT)]);
    let has_lost_pivot = matches!(&lost, Err(BookError::Run { reason, .. }) if reason.contains(LOST));
    claims.push(Claim {
        source: "... but the iterations do not converge, because of the conditioning",
        measured: format!(
            "they converge: residual {} N in the first step, as with scaling ({} N); all 800 steps with p = 1, 1e-3 and 1e-8, u2 differs by at \
             most {} m; with p = {LIGHT} {}",
            one(unscaled.residual),
            one(scaled.residual),
            one(apart),
            if has_lost_pivot { "the pivot of a multiplier is lost to round-off" } else { "no pivot is lost" },
        ),
        agrees: !(apart < SAME && has_lost_pivot),
        expected: false,
        depends_on: None,
        command: format!("lissom run examples/{CRANK}.toml --set analysis.scaling=none --set analysis.solver=strict"),
    });
    claims.push(Claim {
        source: "with it and with scaling, factorisation without pivoting is safe",
        measured: format!(
            "backward error {} (without scaling {}); all 800 steps with the solver `strict`",
            one(scaled.backward_error),
            one(unscaled.backward_error)
        ),
        agrees: scaled.backward_error < 1e-10,
        expected: true,
        depends_on: None,
        command,
    });
    Ok(())
}

/// Result with the augmented term.
fn factors<'a>(cases: &'a [Case], scaling: &str) -> Result<&'a Factored, BookError> {
    augmented(cases, scaling, SOLVER)
        .ok_or_else(|| BookError::run(CRANK)("the augmented tangent has no factors"))
}

/// Backward errors and results of Newton's method in the first step without scaling, by the weight of the augmented term.
pub(super) fn penalties(studio: &Studio) -> Result<Fragment, BookError> {
    let model = studio.example(CRANK)?;
    let mut rows = Vec::new();
    for penalty in ["1", "1e-3", "1e-6", "1e-8"] {
        let table = study(&model, CRANK, &[("analysis.penalty", penalty)])?;
        let mut line = vec![penalty.to_owned()];
        for scaling in ["none", "physical", "equilibrated"] {
            let found = factors(&table, scaling)?;
            line.extend([found.backward_error, found.violation].map(one));
        }
        rows.push(line);
    }
    let mut fragment = Fragment::default();
    let heading = [
        "p",
        "none: backward error",
        "violation [m]",
        "s of (2.6): backward error",
        "violation [m]",
        "equilibrated: backward error",
        "violation [m]",
    ];
    fragment.table(&heading, &rows);
    Ok(fragment)
}

fn orders(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    let schemes = [("radau-iia", 3.0), ("energy-decaying", 3.0), ("hht(-0.3)", 2.0)];
    let names = schemes.map(|(name, _)| name);
    let steps = ["2e-3", "1e-3", "5e-4", "1e-4", "1e-5"];
    let request = convergence::Request {
        schemes: texts(&names),
        steps: texts(&steps),
        reference: ("radau-iia".to_owned(), "5e-6".to_owned()),
        output: "midspan.u2".to_owned(),
    };
    let set = overrides(&[("analysis.end", "0.1")]);
    let (listed, written) = (names.join(","), steps.join(","));
    let options = [
        ("schemes", listed.as_str()),
        ("steps", &written),
        ("reference", "radau-iia:5e-6"),
        ("output", "midspan.u2"),
    ];
    let command = study_command("convergence", CRANK, &options, &set);
    let model = studio.example(CRANK)?.with_overrides(&set);
    let table = convergence::study(&model, &request, &studio.watch())?;
    let rows = |scheme: &str| table.rows.iter().filter(move |row| row.scheme == scheme).collect::<Vec<_>>();
    let order = |scheme: &str| rows(scheme).get(1).and_then(|row| row.order).unwrap_or(f64::NAN);
    let observed: Vec<String> = names.iter().map(|name| format!("{name} {:.2}", order(name))).collect();
    claims.push(Claim {
        source: "figure 2.4: the three schemes converge with their orders: 3 for Radau IIA, 2 for HHT-α",
        measured: format!("{} from 2 to 1 ms", observed.join(", ")),
        agrees: schemes.iter().all(|(name, expected)| (order(name) - expected).abs() < EXPONENT),
        expected: true,
        depends_on: None,
        command: command.clone(),
    });
    let errors = |scheme: &str| -> Vec<f64> {
        rows(scheme).iter().map(|row| *row.outcome.as_ref().unwrap_or(&f64::NAN)).collect()
    };
    let last: Vec<String> = names
        .iter()
        .map(|name| format!("{name} {}", errors(name).last().copied().map_or(String::new(), two)))
        .collect();
    claims.push(Claim {
        source: "figure 2.4: they converge even for very small steps",
        measured: format!("errors decrease down to h = 10 µs: {}", last.join(", ")),
        agrees: names.iter().all(|name| errors(name).windows(2).all(|pair| pair[1] < pair[0])),
        expected: true,
        depends_on: None,
        command,
    });
    Ok(())
}

fn drift(studio: &Studio, claims: &mut Vec<Claim>) -> Result<(), BookError> {
    let set = [("analysis.step", "1e-4"), ("analysis.end", "20"), ("analysis.output_every", "1000")];
    let mut session = studio
        .example(PENDULUM)?
        .with_overrides(&overrides(&set))
        .session()
        .map_err(BookError::run(PENDULUM))?;
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if let Some(error) = report.error() {
        return Err(BookError::run(PENDULUM)(error));
    }
    claims.push(Claim {
        source: "index-3 equations that are solved directly do not drift",
        measured: format!("violation after 200 000 steps: at most {} m", bound(report.violation.max(1e-16))),
        agrees: report.violation < ROUNDOFF,
        expected: true,
        depends_on: None,
        command: format!(
            "lissom run examples/{PENDULUM}.toml{}",
            set.map(|(path, value)| format!(" --set {path}={value}")).concat()
        ),
    });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_and_spreads_are_measured() {
        assert!((exponent(&[1.0, 16.0, 256.0], &[4.0, 2.0, 1.0]) + 4.0).abs() < 1e-12);
        assert!((spread(&[2.0, 8.0, 4.0]) - 4.0).abs() < 1e-12);
        // A failed run makes a claim fail.
        assert!(spread(&[2.0, f64::NAN]).is_nan());
        assert_eq!(in_millimetres((-4.549_7e-2, -1e-9)), (-45.5, 0.0));
        assert!(exponent(&[f64::NAN, 1.0], &[1.0, 2.0]).is_nan());
    }
}
