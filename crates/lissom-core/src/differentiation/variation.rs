//! Sensitivities of a state to model parameters: variations of positions, rates, accelerations and the scheme's history, by row, for
//! several parameters at once.

use lissom_motion::{Block, Motion, Vector6, WIDTH};

use crate::kinematics::{CoordinateMotion, Kinematics, LOCKED, Layout, NodeMotion};
use crate::system::State;

/// Zero in all lanes.
pub(super) const NOTHING: Block = [0.0; WIDTH];

/// Derivatives of a state by as many parameters as there are lanes. Those of a node are in its body axes.
#[derive(Clone, Debug)]
pub(super) struct Variation {
    /// Positions: body variations η of nodes with δH = H η̃, and values of coordinates; by row.
    pub(super) place: Vec<Block>,
    /// Components of twists, and rates of coordinates.
    pub(super) rate: Vec<Block>,
    /// Their time derivatives.
    pub(super) acceleration: Vec<Block>,
    /// The scheme's algorithmic accelerations.
    pub(super) algorithmic: Vec<Block>,
    /// Multipliers.
    pub(super) multipliers: Vec<Block>,
}

impl Variation {
    pub(super) fn new(layout: &Layout) -> Self {
        let rows = vec![NOTHING; layout.coordinate_count()];
        Self {
            place: rows.clone(),
            rate: rows.clone(),
            acceleration: rows.clone(),
            algorithmic: rows,
            multipliers: vec![NOTHING; layout.multiplier_count],
        }
    }

    /// Adds the weighted differences of perturbed states from `base`. False if a locked degree of freedom differs, which has no row.
    pub(super) fn enter(
        &mut self,
        lane: usize,
        layout: &Layout,
        base: &Kinematics,
        neighbours: &[(&State, f64)],
    ) -> bool {
        for (state, weight) in neighbours {
            let at = &state.kinematics;
            let is_alike = at.nodes.len() == base.nodes.len()
                && at.coordinates.len() == base.coordinates.len()
                && at.held == base.held;
            if !is_alike {
                return false;
            }
            for (node, rows) in layout.node_rows.iter().enumerate() {
                let (own, other) = (&base.nodes[node], &at.nodes[node]);
                let place = if own.frame == other.frame {
                    Vector6::zeros()
                } else {
                    other.frame.relative_to(&own.frame).logarithm()
                };
                let parts = [place, other.twist - own.twist, other.acceleration - own.acceleration];
                for k in 0..6 {
                    if rows[k] == LOCKED {
                        if parts.iter().any(|part| part[k] != 0.0) {
                            return false;
                        }
                        continue;
                    }
                    let row = rows[k] as usize;
                    self.place[row][lane] += weight * parts[0][k];
                    self.rate[row][lane] += weight * parts[1][k];
                    self.acceleration[row][lane] += weight * parts[2][k];
                }
            }
            for (coordinate, &row) in layout.coordinate_rows.iter().enumerate() {
                let (row, own) = (row as usize, &base.coordinates[coordinate]);
                let other = &at.coordinates[coordinate];
                self.place[row][lane] += weight * (other.value - own.value);
                self.rate[row][lane] += weight * (other.rate - own.rate);
                self.acceleration[row][lane] += weight * (other.acceleration - own.acceleration);
            }
            for (value, of) in self.algorithmic.iter_mut().zip(&state.algorithmic) {
                value[lane] += weight * of;
            }
            for (value, of) in self.multipliers.iter_mut().zip(&state.multipliers) {
                value[lane] += weight * of;
            }
        }
        true
    }

    /// Sets a lane to zero.
    pub(super) fn clear(&mut self, lane: usize) {
        let Self { place, rate, acceleration, algorithmic, multipliers } = self;
        for values in [place, rate, acceleration, algorithmic, multipliers] {
            for block in values {
                block[lane] = 0.0;
            }
        }
    }

    /// Largest derivative in each lane: of a scaled position, or of a rate or acceleration over `duration` [s].
    pub(super) fn extents(&self, sizes: &[f64], duration: f64) -> Block {
        let mut largest = NOTHING;
        let of = [(&self.place, 1.0), (&self.rate, duration), (&self.acceleration, duration * duration)];
        for (values, factor) in of {
            for (block, size) in values.iter().zip(sizes) {
                for lane in 0..WIDTH {
                    largest[lane] = largest[lane].max((factor * size * block[lane]).abs());
                }
            }
        }
        largest
    }

    /// Displaces `state` by `share` times the variation in a lane.
    pub(super) fn displace(&self, lane: usize, layout: &Layout, share: f64, state: &mut State) {
        let own = |values: &[Block], rows: &[u32; 6]| {
            Vector6::from_fn(
                |k, _| {
                    if rows[k] == LOCKED { 0.0 } else { share * values[rows[k] as usize][lane] }
                },
            )
        };
        for (node, rows) in state.kinematics.nodes.iter_mut().zip(&layout.node_rows) {
            let NodeMotion { frame, twist, acceleration } = node;
            *frame = *frame * Motion::exponential(&own(&self.place, rows));
            *twist += own(&self.rate, rows);
            *acceleration += own(&self.acceleration, rows);
        }
        for (coordinate, &row) in state.kinematics.coordinates.iter_mut().zip(&layout.coordinate_rows) {
            let row = row as usize;
            let CoordinateMotion { value, rate, acceleration } = coordinate;
            *value += share * self.place[row][lane];
            *rate += share * self.rate[row][lane];
            *acceleration += share * self.acceleration[row][lane];
        }
        for (value, variation) in state.multipliers.iter_mut().zip(&self.multipliers) {
            *value += share * variation[lane];
        }
    }
}
