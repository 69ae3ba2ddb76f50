//! Lines divided into dashes, which continue along the whole line.

/// Lengths of a dash and of the gap after it.
pub(crate) const DASH: [f64; 2] = [8.0, 4.0];

/// The dashes of a line.
pub(crate) fn dashes(points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut found = Vec::new();
    let Some(&first) = points.first() else { return found };
    let mut dash = vec![first];
    let (mut phase, mut rest) = (0, DASH[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            if length <= rest || !length.is_finite() {
                rest -= length;
                if phase == 0 {
                    dash.push(to);
                }
                break;
            }
            let share = rest / length;
            from = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
            if phase == 0 {
                dash.push(from);
                found.push(std::mem::take(&mut dash));
            } else {
                dash = vec![from];
            }
            phase = 1 - phase;
            rest = DASH[phase];
        }
    }
    if dash.len() > 1 {
        found.push(dash);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_go_on_along_a_curve_of_many_points() {
        let points: Vec<[f64; 2]> = (0..=1000).map(|k| [0.0599 * f64::from(k), 3.0]).collect();
        let found = dashes(&points);
        // 59.9 pixels: dashes begin at 0, 12, 24, 36 and 48, and each is 8 long.
        assert_eq!(found.len(), 5);
        for (index, dash) in found.iter().enumerate() {
            let (start, end) = (dash[0][0], dash[dash.len() - 1][0]);
            assert!(
                (start - 12.0 * index as f64).abs() < 1e-9 && (end - start - 8.0).abs() < 1e-9,
                "{dash:?}"
            );
        }
        let straight = dashes(&[[0.0, 0.0], [30.0, 0.0]]);
        assert_eq!(
            straight,
            [[[0.0, 0.0], [8.0, 0.0]], [[12.0, 0.0], [20.0, 0.0]], [[24.0, 0.0], [30.0, 0.0]]]
        );
        assert!(dashes(&[]).is_empty());
    }
}
