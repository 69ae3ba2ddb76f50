//! Derivatives of a beam's integrated strains, and of the forces they make, by the unknowns of both stages:
//!
//! ```text
//! δe_i = Σ_j d_ij (δė_j + s_j δr + r δs_j),   ė_j = B_j V_j,   r = Δe - Σ_j D_j ė_j,   s_j = σ_j·Wσ_j/Q
//! δF_i = B̃_iᵀ C δe_i + (S_i·δr) Wσ_i/Q + (S_i·r) δ(Wσ_i/Q)
//! ```

use lissom_motion::{Matrix6, Vector6};

use super::Beam;
use super::linearize::Gradients;
use super::passage::Visit;
use crate::elements::passage::{Passage, STAGES, Variation};

/// A linear map from the unknowns of an element's nodes at a stage.
type Blocks<const N: usize> = [Matrix6; N];
/// A linear form of them.
type Form<const N: usize> = [Vector6; N];

/// Relative twists at the stages and their derivatives.
struct Twists<const N: usize> {
    /// (Wσ_j/Q)ᵀ ∂σ_j/∂V: forces of a remainder, by stage and node.
    directions: [Form<N>; STAGES],
    /// ∂σ_j of a node by the unknowns of stage k: by j, relative node, k.
    changes: [[[Blocks<N>; STAGES]; N]; STAGES],
    /// ∂(σ_j·Wσ_j) by the unknowns of stage k: by j, k.
    squares: [[Form<N>; STAGES]; STAGES],
    /// ∂Q.
    whole: [Form<N>; STAGES],
}

impl<const N: usize> Beam<N> {
    /// Adds the derivatives of the forces by integrated strains.
    pub(super) fn add_integrated(
        &self,
        passage: &Passage<'_>,
        variations: &[[Variation; STAGES]],
        out: &mut [[Vec<f64>; STAGES]; STAGES],
    ) {
        let gradients = passage.stages.map(|at| Gradients::new(self, at));
        let at_end = Gradients::new(self, passage.end);
        let mut visits = passage.stages.map(|at| self.visit(at));
        let (inverse, shares) = passage.shares([visits[0].square, visits[1].square]);
        let twists = self.twists(passage, variations, &gradients, &visits, inverse);
        let mut works = [0.0; STAGES];
        self.integrate(passage, &mut visits, |_, station, strains| {
            let rows = [0, 1].map(|j| gradients[j].of_station(self, station));
            let rates: [[Blocks<N>; STAGES]; STAGES] =
                std::array::from_fn(|j| std::array::from_fn(|k| vary(variations, &rows[j], j, k)));
            let [end, _] = at_end.of_station(self, station);
            let missed: [Blocks<N>; STAGES] = std::array::from_fn(|k| {
                std::array::from_fn(|n| {
                    passage.reached[k] * end[n] * variations[n][STAGES - 1].place
                        - passage.whole([rates[0][k][n], rates[1][k][n]])
                })
            });
            let law = station.weight * station.law.stiffness;
            for i in 0..STAGES {
                let stress = law * strains.stressing[i];
                works[i] += stress.dot(&strains.missed);
                for k in 0..STAGES {
                    for b in 0..N {
                        let mut change = Matrix6::zeros();
                        for j in 0..STAGES {
                            let damped = if i == j { station.law.damping } else { 0.0 };
                            let lasting = passage.durations[i][j] + damped;
                            let share = inverse * (twists.squares[j][k][b] - shares[j] * twists.whole[k][b]);
                            change += lasting
                                * (rates[j][k][b]
                                    + shares[j] * missed[k][b]
                                    + strains.missed * share.transpose());
                        }
                        let pushed = law * change;
                        let along = change.tr_mul(&(law * strains.missed)) + missed[k][b].tr_mul(&stress);
                        for a in 0..N {
                            let block =
                                rows[i][0][a].tr_mul(&pushed) + twists.directions[i][a] * along.transpose();
                            add(&mut out[i][k], N, (a, b), &block);
                        }
                    }
                }
            }
        });
        for i in 0..STAGES {
            for k in 0..STAGES {
                for a in 0..N {
                    for b in 0..N {
                        let block = works[i] * self.turning(&twists, &gradients[i], inverse, (i, k), (a, b));
                        add(&mut out[i][k], N, (a, b), &block);
                    }
                }
            }
        }
    }

    /// ∂(Wσ_i/Q): how the direction in which a remainder is put back changes.
    fn turning(
        &self,
        twists: &Twists<N>,
        gradients: &Gradients<N>,
        inverse: f64,
        (i, k): (usize, usize),
        (a, b): (usize, usize),
    ) -> Matrix6 {
        let length = self.length();
        let mut block = -inverse * twists.directions[i][a] * twists.whole[k][b].transpose();
        for m in (0..N).filter(|&m| m != Self::REFERENCE) {
            let [by_twist, _] = gradients.of_twist(self, m);
            let mut change = twists.changes[i][m][k][b];
            for row in 3..6 {
                change.row_mut(row).scale_mut(length * length);
            }
            block += inverse * by_twist[a].tr_mul(&change);
        }
        block
    }

    fn twists(
        &self,
        passage: &Passage<'_>,
        variations: &[[Variation; STAGES]],
        gradients: &[Gradients<N>; STAGES],
        visits: &[Visit<N>; STAGES],
        inverse: f64,
    ) -> Twists<N> {
        let none = [Vector6::zeros(); N];
        let zeros = [Matrix6::zeros(); N];
        let mut twists = Twists {
            directions: [none; STAGES],
            changes: [[[zeros; STAGES]; N]; STAGES],
            squares: [[none; STAGES]; STAGES],
            whole: [none; STAGES],
        };
        for j in 0..STAGES {
            for m in (0..N).filter(|&m| m != Self::REFERENCE) {
                let rows = gradients[j].of_twist(self, m);
                let weighted = visits[j].weighted[m];
                for n in 0..N {
                    twists.directions[j][n] += inverse * rows[0][n].tr_mul(&weighted);
                }
                for k in 0..STAGES {
                    let change = vary(variations, &rows, j, k);
                    for n in 0..N {
                        twists.squares[j][k][n] += 2.0 * change[n].tr_mul(&weighted);
                    }
                    twists.changes[j][m][k] = change;
                }
            }
            for k in 0..STAGES {
                for n in 0..N {
                    twists.whole[k][n] += passage.lasting[j] * twists.squares[j][k][n];
                }
            }
        }
        twists
    }
}

/// What depends on twists and places of stage j, by the unknowns of stage k.
fn vary<const N: usize>(
    variations: &[[Variation; STAGES]],
    [by_twist, by_place]: &[Blocks<N>; 2],
    j: usize,
    k: usize,
) -> Blocks<N> {
    std::array::from_fn(|n| {
        let rate = by_twist[n] * variations[n][j].rate[k];
        if j == k { rate + by_place[n] * variations[n][j].place } else { rate }
    })
}

fn add(out: &mut [f64], nodes: usize, (a, b): (usize, usize), block: &Matrix6) {
    crate::elements::add_block(out, 6 * nodes, (6 * a, 6 * b), block);
}
