//! Tests of `evaluation::element`, a module of it.

use super::*;
use crate::kinematics::GROUND;

/// Forces and their derivatives, and nothing else.
#[derive(Debug)]
struct Bare([NodeId; 1]);

impl Element for Bare {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.0)
    }
    fn forces(&self, _: &Kinematics, _: &mut [f64]) {}
    fn linearize(&self, _: &Kinematics, _: &mut Tangents) {}
}

#[test]
fn energies_add_up_part_by_part() {
    let mut sum = Energy { kinetic: 1.0, strain: 2.0, potential: -4.0 };
    sum += Energy { kinetic: 8.0, strain: 16.0, potential: -32.0 };
    assert_eq!(sum, Energy { kinetic: 9.0, strain: 18.0, potential: -36.0 });
    assert_eq!(sum.total(), -9.0);
    assert_eq!([sum, sum].into_iter().sum::<Energy>().total(), -18.0);
}

#[test]
fn an_element_has_only_what_it_says() {
    let mut bare = Bare([GROUND]);
    assert!(bare.switch_states().is_none());
    assert!(<Bare as Element>::blocks(&[Bare([GROUND])]).is_none());
    assert!(Bare::derivative(&[(&bare, 1.0)]).is_none());
    let element: &dyn Element = &bare;
    assert_eq!((element.unknowns().force_count(), element.unknowns().coordinates.len()), (6, 0));
    let capabilities = element.capabilities();
    assert!(capabilities.load.is_none() && capabilities.spring.is_none() && capabilities.laws.is_none());
    assert!(capabilities.deformation.is_none() && capabilities.inertia.is_none());
    assert!(capabilities.strain.is_none() && !capabilities.is_body_inertia);
}
