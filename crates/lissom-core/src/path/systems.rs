//! Parameter of a path: the factor of all loads, between the systems without and with them, or a parameter of the model.

use std::sync::Arc;

use super::PathError;
use crate::system::System;

/// Systems that differ by one parameter only, such as a stiffness or a length.
pub trait Family: Send {
    /// The system with this `value` of the parameter.
    ///
    /// # Errors
    /// The reason, if the value is invalid.
    fn system(&mut self, value: f64) -> Result<Arc<System>, String>;
}

/// Relative step of the central differences by the parameter: their truncation error is of its square, their round-off of its inverse.
const DIFFERENCE_STEP: f64 = 1e-5;
/// Lower bound of the parameter's magnitude, as a fraction of its range.
const MIN_SIZE: f64 = 1e-2;
/// Number of cached systems.
const KEPT: usize = 4;

/// The systems of a path.
pub(super) enum PathSystems {
    /// Without and with the loads.
    Loads([Arc<System>; 2]),
    /// One for each value of a parameter.
    Number(NumberSystems),
}

/// Systems by the value of a parameter.
pub(super) struct NumberSystems {
    name: String,
    family: Box<dyn Family>,
    /// Values at the start and at the end of the path.
    way: [f64; 2],
    /// Cached systems by value, the latest last.
    kept: Vec<(f64, Arc<System>)>,
    /// System of the last valid value requested; all systems have its unknowns.
    last: Arc<System>,
    /// Why the last value requested is invalid.
    problem: Option<String>,
}

impl PathSystems {
    /// A path along the parameter `name`, from `way[0]` to `way[1]`.
    pub(super) fn of_number(
        name: String,
        mut family: Box<dyn Family>,
        way: [f64; 2],
    ) -> Result<Self, PathError> {
        let last = match family.system(way[0]) {
            Ok(system) => system,
            Err(problem) => return Err(PathError::NoSystem { name, value: way[0], problem }),
        };
        let kept = vec![(way[0], Arc::clone(&last))];
        Ok(Self::Number(NumberSystems { name, family, way, kept, last, problem: None }))
    }

    /// Name of the path parameter.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Loads(_) => "load factor",
            Self::Number(number) => &number.name,
        }
    }

    /// A system with the unknowns of the path: the loaded one, or that of the last valid value.
    pub(super) fn any(&self) -> &Arc<System> {
        match self {
            Self::Loads([_, loaded]) => loaded,
            Self::Number(number) => &number.last,
        }
    }

    /// The system without loads; for a parameter, the same as [`any`](Self::any).
    pub(super) fn unloaded(&self) -> &Arc<System> {
        match self {
            Self::Loads([unloaded, _]) => unloaded,
            Self::Number(number) => &number.last,
        }
    }

    /// Why the last value requested is invalid, if it is.
    pub(super) fn problem(&self) -> Option<&str> {
        match self {
            Self::Loads(_) => None,
            Self::Number(number) => number.problem.as_deref(),
        }
    }
}

impl NumberSystems {
    /// The system for a value; none if the value is invalid.
    pub(super) fn at(&mut self, value: f64) -> Option<Arc<System>> {
        if let Some((_, system)) = self.kept.iter().find(|(known, _)| *known == value) {
            self.problem = None;
            self.last = Arc::clone(system);
            return Some(Arc::clone(system));
        }
        let found = if value.is_finite() {
            self.family.system(value)
        } else {
            Err("it is not a finite number".to_owned())
        };
        let system = match found {
            Ok(system) if are_alike(&system, &self.last) => system,
            Ok(_) => {
                self.problem = Some("the model has other unknowns there".to_owned());
                return None;
            }
            Err(problem) => {
                self.problem = Some(problem);
                return None;
            }
        };
        self.problem = None;
        self.last = Arc::clone(&system);
        self.kept.push((value, Arc::clone(&system)));
        if self.kept.len() > KEPT {
            self.kept.remove(0);
        }
        Some(system)
    }

    /// Systems for a central difference at a value, with their values. If one of the two is invalid, the difference is one-sided.
    pub(super) fn around(&mut self, value: f64) -> Option<[(f64, Arc<System>); 2]> {
        let [from, to] = self.way;
        let apart = DIFFERENCE_STEP * value.abs().max(MIN_SIZE * (to - from).abs());
        let mut side = |neighbour: f64| match self.at(neighbour) {
            Some(system) => Some((neighbour, system)),
            None => self.at(value).map(|system| (value, system)),
        };
        let [below, above] = [side(value - apart)?, side(value + apart)?];
        (above.0 > below.0).then_some([below, above])
    }
}

/// Whether two systems have the same unknowns.
pub(super) fn are_alike(a: &System, b: &System) -> bool {
    let layouts = [a, b].map(System::layout);
    layouts[0].coordinate_count() == layouts[1].coordinate_count()
        && layouts[0].size() == layouts[1].size()
        && a.pattern() == b.pattern()
}
