use super::*;

fn count(errors: impl Iterator<Item = f64>) -> usize {
    let mut instants = Instants::default();
    errors.filter(|&error| instants.contain(error)).count()
}

#[test]
fn contacts_are_instants_and_vibrations_are_not() {
    let contacts = (0..500_u32).map(|step| if step % 100 < 10 && step >= 100 { 1.0 } else { 1e-3 });
    assert_eq!(count(contacts), 40);
    assert_eq!(count((0..500).map(|step| (0.37 * f64::from(step)).cos().abs())), 0);
    let late =
        count((0..500).map(|step| if step < 250 { 1e-6 } else { (0.37 * f64::from(step)).sin().abs() }));
    assert!(late <= 32, "{late}");
}
