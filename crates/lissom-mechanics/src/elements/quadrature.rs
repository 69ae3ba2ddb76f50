//! Gauss-Legendre and Gauss-Lobatto rules on [-1, 1].

/// Points and weights of the Gauss-Legendre rule, exact to degree 2 n - 1, for n = 1 … 4.
pub fn gauss_legendre(points: usize) -> &'static [(f64, f64)] {
    const ONE: [(f64, f64); 1] = [(0.0, 2.0)];
    const TWO: [(f64, f64); 2] = [(-0.577_350_269_189_625_8, 1.0), (0.577_350_269_189_625_8, 1.0)];
    const THREE: [(f64, f64); 3] =
        [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
    const FOUR: [(f64, f64); 4] = [
        (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
        (-0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
        (0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    ];
    match points {
        0 | 1 => &ONE,
        2 => &TWO,
        3 => &THREE,
        _ => &FOUR,
    }
}

/// Points and weights of the Gauss-Lobatto rule, end points included, exact to degree 2 n - 3, for
/// n = 2 … 4. These points are also the positions of a beam element's nodes.
pub fn gauss_lobatto(points: usize) -> &'static [(f64, f64)] {
    const TWO: [(f64, f64); 2] = [(-1.0, 1.0), (1.0, 1.0)];
    const THREE: [(f64, f64); 3] = [(-1.0, 1.0 / 3.0), (0.0, 4.0 / 3.0), (1.0, 1.0 / 3.0)];
    const FOUR: [(f64, f64); 4] = [
        (-1.0, 1.0 / 6.0),
        (-0.447_213_595_499_957_9, 5.0 / 6.0),
        (0.447_213_595_499_957_9, 5.0 / 6.0),
        (1.0, 1.0 / 6.0),
    ];
    match points {
        0..=2 => &TWO,
        3 => &THREE,
        _ => &FOUR,
    }
}

#[cfg(test)]
#[path = "../../tests/unit/elements/quadrature.rs"]
mod tests;
