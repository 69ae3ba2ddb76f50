//! Natural modes for a page: the tables of `lissom modes`, read back.

use serde::Serialize;

/// A mode for pictures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Mode {
    /// Frequency [Hz].
    pub(crate) frequency: f64,
    /// Damping ratio [-].
    damping: f64,
    /// Kind, such as `oscillation`.
    kind: String,
    /// Displacement [m] and rotation [rad] of every node except the ground, concatenated.
    pub(crate) real: Vec<f32>,
    /// Imaginary parts; empty where there are none.
    pub(crate) imaginary: Vec<f32>,
}

/// Reads `modes.csv` and `shapes.csv` of a model with this number of nodes, the ground included; none if they are
/// invalid.
pub(crate) fn read(modes: &str, shapes: &str, nodes: usize) -> Option<Vec<Mode>> {
    let mut rows = shapes.lines();
    let is_complex = rows.next()?.ends_with("_im");
    let columns = if is_complex { 15 } else { 9 };
    let mut found = Vec::new();
    for line in modes.lines().skip(1) {
        let mut fields = line.split(',').skip(1);
        let mut number = || fields.next()?.parse::<f64>().ok();
        let (frequency, damping) = (number()?, number()?);
        let kind = fields.next()?.to_owned();
        let (mut real, mut imaginary) = (Vec::new(), Vec::new());
        for _ in 1..nodes {
            // Names of nodes are first and may contain commas: numbers are counted from the end.
            let numbers: Option<Vec<f32>> =
                rows.next()?.rsplitn(columns + 1, ',').take(columns).map(|text| text.parse().ok()).collect();
            let mut numbers = numbers.filter(|numbers| numbers.len() == columns)?;
            numbers.reverse();
            real.extend_from_slice(&numbers[3..9]);
            imaginary.extend_from_slice(&numbers[9..]);
        }
        found.push(Mode { frequency, damping, kind, real, imaginary });
    }
    rows.next().is_none().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_come_back_from_their_tables() {
        let modes = "mode,frequency,damping,kind\n1,2.5,0.01,oscillation\n2,3.5,0.0,rigid\n";
        let heading = "mode,node,x,y,z,u1,u2,u3,r1,r2,r3\n";
        let row = |mode: u32| format!("{mode},\"a, b\",0.0,0.0,0.0,{mode}.0,2.0,3.0,4.0,5.0,6e-1\n");
        let shapes = format!("{heading}{}{}", row(1), row(2));
        let found = read(modes, &shapes, 2).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].frequency, found[0].kind.as_str()), (2.5, "oscillation"));
        assert_eq!(found[1].real, [2.0, 2.0, 3.0, 4.0, 5.0, 0.6]);
        assert!(found[1].imaginary.is_empty());
        assert_eq!(read(modes, &shapes, 3), None, "of another model");
        assert_eq!(read(modes, &format!("{heading}{}", row(1)), 2), None, "cut off");
        let complex = shapes
            .replace("r3\n", "r3,u1_im,u2_im,u3_im,r1_im,r2_im,r3_im\n")
            .replace("6e-1\n", "6e-1,1,2,3,4,5,6\n");
        assert_eq!(read(modes, &complex, 2).unwrap()[0].imaginary, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }
}
