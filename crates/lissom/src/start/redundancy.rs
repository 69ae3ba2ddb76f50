//! Which columns are not unique because constraints repeat each other: those that change where multipliers are added
//! that are in equilibrium with each other.

use lissom_core::consistent::mobility::{has_loops, mobility};
use lissom_core::errors::Warning;
use lissom_core::kinematics::Subject;
use lissom_core::system::{State, System};

use lissom_model::channels::Channel;
use lissom_model::document::OutputKind;

/// Changes below this fraction of the largest multiplier added are round-off.
const ROUND_OFF: f64 = 1e-6;
/// Columns named in a message.
const MAX_LISTED: usize = 6;

/// Names of the columns of `channels` that constraints leave undetermined at `state`, and a warning if there are any.
pub(super) fn not_unique(
    system: &System,
    state: &State,
    channels: &[Channel],
) -> (Vec<String>, Option<Warning>) {
    let mut columns = Vec::new();
    let (mut repeated, mut joint) = (Vec::new(), None);
    let is_asked = channels.iter().any(|channel| channel.kind == OutputKind::Reaction);
    let may_repeat = has_loops(system) || !system.layout().of_velocities.is_empty();
    if !is_asked || !may_repeat {
        return (columns, None);
    }
    let values = |multipliers: &[(usize, f64)]| {
        let mut stressed = state.clone();
        stressed.multipliers.fill(0.0);
        for &(k, value) in multipliers {
            stressed.multipliers[k] = value;
        }
        let mut values = Vec::new();
        for channel in channels.iter().filter(|channel| channel.kind == OutputKind::Reaction) {
            channel.evaluate(system, &stressed, &mut values);
        }
        values
    };
    let names: Vec<String> = channels
        .iter()
        .filter(|channel| channel.kind == OutputKind::Reaction)
        .flat_map(|channel| channel.components.iter().map(|part| format!("{}.{part}", channel.name)))
        .collect();
    let unstressed = values(&[]);
    let mut is_unique = vec![true; names.len()];
    for redundant in mobility(system, state).redundant {
        let largest = redundant.self_stress.iter().fold(0.0_f64, |most, (_, value)| most.max(value.abs()));
        let mut touches = false;
        for (k, (stressed, value)) in values(&redundant.self_stress).iter().zip(&unstressed).enumerate() {
            if (stressed - value).abs() > ROUND_OFF * largest {
                is_unique[k] = false;
                touches = true;
            }
        }
        if touches {
            repeated.push(redundant.words());
            joint.get_or_insert(redundant.joint);
        }
    }
    columns.extend(names.into_iter().zip(is_unique).filter(|(_, unique)| !unique).map(|(name, _)| name));
    let doubt = joint.and_then(|joint| doubt(&columns, joint, &repeated));
    (columns, doubt)
}

fn doubt(columns: &[String], joint: String, repeated: &[String]) -> Option<Warning> {
    let named = |names: &[String]| {
        let more = names.len().saturating_sub(MAX_LISTED);
        let first = names[..names.len() - more].join(", ");
        if more == 0 { first } else { format!("{first} and {more} more") }
    };
    let is = if columns.len() == 1 { "is" } else { "are" };
    (!columns.is_empty()).then(|| Warning::ReactionsNotUnique {
        columns: format!("{} {is}", named(columns)),
        repeated: Subject::new("joint", joint).called(named(repeated)),
    })
}
