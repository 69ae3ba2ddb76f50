//! The points at which parts may touch in a step: of all parts that may come near each other if they travel no farther than allowed.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_motion::{Motion, Vector3, Vector6};

use super::free_path::{Encounter, FreePath};
use super::known_gaps::KnownGaps;
use super::touch_point::{Phase, Place, StepOfPoint, TouchPoint};
use crate::contact::forms::Meeting;
use crate::contact::set::{ContactSet, NearPair, NearPairs, PlacedMeeting};
use crate::kinematics::{GROUND, Kinematics, NodeId, split};
use crate::scaling::StageMotion;
use crate::system::{State, System, Touch, TouchKey};

/// Allowed travel over the expected one: that at the velocity and acceleration of the start, or the one that was too long.
const TRAVEL_SHARE: f64 = 1.3;
/// Distance over the radius of a part: longer paths are followed, and parts with a smaller gap may touch soon.
pub(super) const SHORT: f64 = 0.01;
/// Path over the radius from which a step ends at the first touch.
const LONG: f64 = 0.1;
/// Cosine between normals that are one.
const ALIKE: f64 = 1.0 - 1e-6;
/// Overlap over the path, and over the radius of the smaller part, at which a surface is no obstacle: edges are crowned by as much.
const FLUSH: [f64; 2] = [1e-3, 2e-4];
/// Cosine between a surface and one that is flush with it, at its rounded edge.
const LEVEL: f64 = 0.97;
/// Number of places on a path at which an obstacle is looked for.
const LOOKS: u32 = 4;
/// Shares of a step between which it is divided.
const DIVIDED: [f64; 2] = [0.02, 0.98];

/// Finds the points.
pub(crate) struct NearPoints {
    set: Arc<ContactSet>,
    pairs: NearPairs,
    /// The points of every two parts that have been near, and what is known of their gaps.
    meetings: Vec<(Vec<PlacedMeeting>, KnownGaps)>,
    /// Their indices, and those of the pairs of the last search.
    known: BTreeMap<NearPair, usize>,
    last: Vec<(NearPair, usize)>,
    next: Vec<(NearPair, usize)>,
    /// Inverse masses by part [1/kg].
    compliances: Vec<f64>,
    /// Bounding radii by part, of those without bounds the distance of the farthest other part [m].
    levers: Vec<f64>,
    /// Allowed travel of the farthest point by part [m].
    travel: Vec<f64>,
    pub(crate) points: Vec<TouchPoint>,
    /// Whether the motion begins with the step.
    is_first: bool,
    /// Length of the planned step [s], and gravity [m/s²].
    planned: f64,
    gravity: Vector3,
    /// Radius of the smallest part [m].
    smallest: f64,
}

impl NearPoints {
    /// Points of the parts of a system, before the first step.
    pub(super) fn new(system: &System) -> Self {
        let set = system.contacts();
        let mass_of = |node| {
            let own = system.inertias().iter().filter(|inertia| inertia.node() == node);
            own.map(|inertia| inertia.mass()[(0, 0)]).sum::<f64>()
        };
        let masses: Vec<f64> = set.parts.iter().map(|part| mass_of(part.node)).collect();
        let least = masses.iter().copied().filter(|mass| *mass > 0.0).fold(f64::INFINITY, f64::min);
        // Parts without a mass of their own, such as interfaces, are taken as light.
        let compliance = |(mass, node): (f64, _)| match mass {
            _ if node == GROUND => 0.0,
            mass if mass > 0.0 => 1.0 / mass,
            _ if least.is_finite() => 1.0 / least,
            _ => 1.0,
        };
        let nodes = set.parts.iter().map(|part| part.node);
        Self {
            pairs: NearPairs::new(set),
            meetings: Vec::new(),
            known: BTreeMap::new(),
            last: Vec::new(),
            next: Vec::new(),
            compliances: masses.into_iter().zip(nodes).map(compliance).collect(),
            levers: set.parts.iter().map(|part| part.radius).collect(),
            travel: vec![0.0; set.parts.len()],
            points: Vec::new(),
            is_first: false,
            planned: 0.0,
            gravity: Vector3::zeros(),
            smallest: set.parts.iter().map(|part| part.radius).fold(f64::INFINITY, f64::min),
            set: Arc::clone(set),
        }
    }

    /// Finds the points of a step of `size` [s], which is part of a `planned` one [s], `from` its start, which may be that of the motion.
    pub(super) fn begin(
        &mut self,
        system: &System,
        (from, is_first): (&State, bool),
        [size, planned]: [f64; 2],
    ) {
        (self.is_first, self.planned, self.gravity) = (is_first, planned.max(size), *system.gravity());
        let (start, gravity) = (&from.kinematics, self.gravity.norm());
        self.measure_levers(start);
        for (index, part) in self.set.parts.iter().enumerate().filter(|(_, part)| part.node != GROUND) {
            let node = &start.nodes[part.node];
            let farthest = |screw: &Vector6| {
                screw.fixed_rows::<3>(0).norm() + self.levers[index] * screw.fixed_rows::<3>(3).norm()
            };
            let acceleration = gravity + farthest(&node.acceleration);
            self.travel[index] = TRAVEL_SHARE * size * (farthest(&node.twist) + size * acceleration);
        }
        self.find((start, &from.touches), size);
    }

    /// Distances of the farthest points of parts without bounds that rotate.
    fn measure_levers(&mut self, at: &Kinematics) {
        let Self { set, levers, .. } = self;
        for (index, part) in set.parts.iter().enumerate() {
            if part.radius.is_finite() || part.node == GROUND {
                continue;
            }
            let place = at.nodes[part.node].frame.position;
            let others =
                set.parts.iter().enumerate().filter(|(other, own)| *other != index && own.radius.is_finite());
            let reach =
                others.map(|(_, other)| (at.nodes[other.node].frame.position - place).norm() + other.radius);
            levers[index] = reach.fold(0.0, f64::max);
        }
    }

    fn find(&mut self, (start, touches): (&Kinematics, &[Touch]), size: f64) {
        let Self { set, pairs, meetings, known, last, next, points, travel, compliances, .. } = self;
        points.clear();
        next.clear();
        // Both lists are in ascending order, and nearly all pairs are in both.
        let mut before = last.iter().peekable();
        for &pair in pairs.find(set, start, travel) {
            while before.next_if(|(own, _)| own.rank() < pair.rank()).is_some() {}
            let index = match before.peek() {
                Some((own, index)) if *own == pair => *index,
                _ => *known.entry(pair).or_insert_with(|| {
                    let points = placed(set, pair);
                    let gaps = KnownGaps::new(points.len());
                    meetings.push((points, gaps));
                    meetings.len() - 1
                }),
            };
            next.push((pair, index));
        }
        std::mem::swap(last, next);
        let mut touches = touches.iter().peekable();
        for &(NearPair { rule, parts }, index) in last.iter() {
            let (meetings, gaps) = &mut meetings[index];
            let [base, tip] = parts.map(|part| part as usize);
            let nodes = [base, tip].map(|part| set.parts[part].node);
            let compliance = compliances[base] + compliances[tip];
            let radius = set.parts[base].radius.min(set.parts[tip].radius);
            let step =
                StepOfPoint { size, radius, planned: self.planned, compliance, is_first: self.is_first };
            let frames = nodes.map(|node| start.nodes[node].frame);
            let reach = travel[base] + travel[tip];
            gaps.follow(frames, [base, tip].map(|part| set.parts[part].radius));
            let first = points.len();
            for (point, (meeting, law)) in meetings.iter().enumerate() {
                if gaps.exceeds(point, reach) {
                    continue;
                }
                let key = TouchKey { rule, parts, point: point as u32 };
                while touches.next_if(|touch| touch.key.rank() < key.rank()).is_some() {}
                let before = touches.peek().copied().filter(|touch| touch.key == key && touch.continues);
                let mut place = match Place::within(meeting, frames, reach) {
                    Ok(place) => place,
                    Err(gap) => {
                        gaps.insert(point, gap);
                        continue;
                    }
                };
                if before.is_none() && is_round(meeting) && place.gap > 0.0 {
                    let path = FreePath::of(nodes, (start, self.gravity), size);
                    let length = path.length(meeting, &place);
                    if length > SHORT * radius {
                        let Encounter { time, .. } = path.first_touch(meeting, (place.gap, length));
                        place = path.place_at(meeting, time).unwrap_or(place);
                    }
                }
                points.push(TouchPoint::at((key, meeting, law), nodes, (start, step), (place, before)));
            }
            if set.parts[base].solids.len() * set.parts[tip].solids.len() > 1 {
                let hidden =
                    hidden(&points[first..], meetings, (start, nodes), [size, radius], self.is_first);
                let mut all = hidden.into_iter();
                let mut index = 0;
                points.retain(|_| {
                    index += 1;
                    index <= first || !all.next().unwrap_or(false)
                });
            }
        }
    }

    /// Time to the first touch of a ball that moves far in a step of `size` [s] from the `start`, if it is within the step [s].
    pub(crate) fn first_touch(&mut self, system: &System, from: &State, size: f64) -> Option<f64> {
        let start = &from.kinematics;
        let fall = size * system.gravity().norm();
        let fastest = self.set.parts.iter().filter(|part| part.node != GROUND).map(|part| {
            let (velocity, spin) = split(&start.nodes[part.node].twist);
            velocity.norm() + fall + if part.radius.is_finite() { part.radius * spin.norm() } else { 0.0 }
        });
        if 2.0 * size * fastest.fold(0.0, f64::max) < LONG * self.smallest {
            return None;
        }
        self.begin(system, (from, false), [size; 2]);
        let mut first = f64::INFINITY;
        for point in self.points.iter().filter(|point| point.phase == Phase::Impact) {
            let parts = point.key.parts.map(|part| part as usize);
            let nodes = parts.map(|part| self.set.parts[part].node);
            let Some(meeting) = self.meeting_of(point).filter(|meeting| is_round(meeting)) else { continue };
            let path = FreePath::of(nodes, (start, self.gravity), size);
            let frames = nodes.map(|node| start.nodes[node].frame);
            let Some(place) = Place::of(meeting, frames, f64::INFINITY) else { continue };
            let length = path.length(meeting, &place);
            let radius =
                parts.map(|part| self.set.parts[part].radius).into_iter().fold(f64::INFINITY, f64::min);
            if length > LONG * radius && place.gap > 0.0 {
                let Encounter { time, touches } = path.first_touch(meeting, (place.gap, length));
                if touches && time > DIVIDED[0] * size && time < DIVIDED[1] * size {
                    first = first.min(time);
                }
            }
        }
        first.is_finite().then_some(first)
    }

    /// The meeting of a point.
    fn meeting_of(&self, point: &TouchPoint) -> Option<&Meeting> {
        let TouchKey { rule, parts, point: index } = point.key;
        let pair = NearPair { rule, parts };
        let found = self.last.binary_search_by_key(&pair.rank(), |(own, _)| own.rank()).ok()?;
        Some(&self.meetings[self.last[found].1].0[index as usize].0)
    }

    /// A point of the step at another configuration.
    pub(super) fn placed_at(&self, point: &TouchPoint, at: &Kinematics) -> TouchPoint {
        self.meeting_of(point).map_or(*point, |meeting| point.placed_at(meeting, at))
    }

    /// Whether a part has travelled farther than allowed: it is then allowed more, and the points are found again.
    pub(super) fn has_left(&mut self, from: &State, motion: &StageMotion, size: f64) -> bool {
        let mut has_left = false;
        for (index, part) in self.set.parts.iter().enumerate() {
            let turn = size * motion.at.nodes[part.node].twist.fixed_rows::<3>(3).norm();
            let path = motion.changes[part.node].shift.norm() + self.levers[index] * turn;
            if path > self.travel[index] {
                self.travel[index] = TRAVEL_SHARE * path;
                has_left = true;
            }
        }
        if has_left {
            let before = std::mem::take(&mut self.points);
            self.find((&from.kinematics, &from.touches), size);
            for point in &mut self.points {
                if let Ok(index) = before.binary_search_by_key(&point.key.rank(), |own| own.key.rank()) {
                    *point = before[index];
                }
            }
        }
        has_left
    }
}

/// Which of the new points of two parts with several solids are no obstacles: those that a part meets only because it is within the
/// surface of another solid, on which it rests, as at a seam between flush faces. The normal there is that of an edge. Without this
/// penetration nothing is in its way along this surface.
fn hidden(
    points: &[TouchPoint],
    meetings: &[PlacedMeeting],
    (start, nodes): (&Kinematics, [NodeId; 2]),
    [size, radius]: [f64; 2],
    is_first: bool,
) -> Vec<bool> {
    let rests = |point: &&TouchPoint| point.phase == Phase::Lasting || point.gap() < FLUSH[1] * radius;
    if points.iter().all(|point| point.phase == Phase::Lasting) || !points.iter().any(|own| rests(&own)) {
        return Vec::new();
    }
    let frames = nodes.map(|node| start.nodes[node].frame);
    let is_hidden = |point: &TouchPoint| {
        let (meeting, _) = &meetings[point.key.point as usize];
        // The path of a ball is followed.
        let is_followed = is_round(meeting) && !meeting.stands;
        if point.phase == Phase::Lasting || is_followed || is_first && point.gap() <= 0.0 {
            return false;
        }
        let [normal, velocity] = point.motion_of_second(start, nodes);
        points.iter().filter(rests).any(|support| {
            let [along, _] = support.motion_of_second(start, nodes);
            if along.dot(&normal) > ALIKE {
                return false;
            }
            let path = size * (velocity - velocity.dot(&along).min(0.0) * along);
            let most = FLUSH[0] * path.norm() + FLUSH[1] * radius;
            if point.gap() + 2.0 * normal.dot(&path).min(size * normal.dot(&velocity)) >= most {
                return false;
            }
            let alike = points
                .iter()
                .filter(rests)
                .filter(|own| own.motion_of_second(start, nodes)[0].dot(&along) > ALIKE);
            let depth = alike.map(|own| -own.gap()).fold(0.0, f64::max);
            (0..=LOOKS).all(|look| {
                let shift = depth * along + f64::from(look) / f64::from(LOOKS) * path;
                let [first, second] = frames;
                let moved = Motion::new(second.rotation, second.position + shift);
                let Some(place) = Place::of(meeting, [first, moved], -FLUSH[0] * path.norm()) else {
                    return true;
                };
                place.gap > -most && place.normal(meeting).dot(&along) > LEVEL
            })
        })
    };
    points.iter().map(is_hidden).collect()
}

/// Whether a point is the centre of a ball.
fn is_round(meeting: &Meeting) -> bool {
    meeting.pair.reach() == 0.0
}

/// The points of two parts, each with its law.
fn placed(set: &ContactSet, pair: NearPair) -> Vec<PlacedMeeting> {
    // Forms that cannot touch are rejected with the model.
    let parts = pair.parts.map(|part| part as usize);
    set.meetings_of(pair.rule as usize, parts).ok().flatten().unwrap_or_default()
}
