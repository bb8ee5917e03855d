use super::{
    body::Body,
    level::Underside,
    normal::Slanted,
    rows::{Point, Rows},
};
use crate::lanes::{Lanes, Mask};
use creatures::Shape;

/// The contacts of the same part of `W` creatures with the half-space under uneven ground, found in all lanes at once: most
/// of what a part is near is not a mound or a box.
#[derive(Clone, Debug)]
pub(super) struct Floor<const W: usize> {
    underside: Underside<W>,
    points: [Point<W>; 2],
    /// Which points are near the ground in this step.
    active: [Mask<W>; 2],
    /// The lanes whose ground has a half-space at y = 0, as its first shape.
    there: Mask<W>,
    /// For each of the rows, the lanes in which it holds this contact.
    rows: Vec<Mask<W>>,
}

impl<const W: usize> Floor<W> {
    pub(super) fn new(shape: Shape, is_there: bool) -> Self {
        let mut there = Mask::NONE;
        (0..W).for_each(|lane| there.set_lane(lane, is_there));
        let active = [Mask::NONE; 2];
        Self { underside: Underside::new(shape), points: [Point::NONE; 2], active, there, rows: Vec::new() }
    }

    /// Forgets that a lane's part stood on it.
    pub(super) fn reset(&mut self, lane: usize) {
        self.rows.iter_mut().for_each(|lanes| lanes.set_lane(lane, false));
    }

    /// Takes over how another lane's part stands on it, and whether it is there.
    pub(super) fn copy_lane(&mut self, lane: usize, from: &Floor<1>) {
        self.underside.copy_lane(lane, &from.underside);
        self.there.set_lane(lane, from.there.lane(0));
        for (mine, from) in self.rows.iter_mut().zip(&from.rows) {
            mine.set_lane(lane, from.lane(0));
        }
    }

    /// One more of the rows.
    pub(super) fn add_row(&mut self) {
        self.rows.push(Mask::NONE);
    }

    /// Whether it is the first shape of a lane's ground.
    #[inline(always)]
    pub(super) fn is_there(&self, lane: usize) -> bool {
        self.there.lane(lane)
    }

    /// Whether it has a row in a lane.
    #[inline(always)]
    pub(super) fn has(&self, row: usize, lane: usize) -> bool {
        self.rows[row].lane(lane)
    }

    /// Finds the points of contact; rows of contacts that have ended are free from then on. Returns the lanes in which a
    /// contact has begun, which has no row yet.
    #[inline(always)]
    pub(super) fn find(&mut self, body: &Body<W>, reach: f32, rows: &[Rows<Slanted<W>, W>]) -> Mask<W> {
        let reach = Lanes::splat(reach);
        let near = self.underside.near(body, reach).and(self.there);
        self.active = [Mask::NONE; 2];
        if near.any() {
            self.recall(rows);
            self.active = self.underside.find(body, reach, &mut self.points).map(|active| active.and(near));
        }
        let touching = self.active[0].or(self.active[1]);
        let mut known = Mask::NONE;
        for lanes in &mut self.rows {
            *lanes = lanes.and(touching);
            known = known.or(*lanes);
        }
        touching.without(known)
    }

    /// Gives a contact that has begun a row.
    pub(super) fn begin(&mut self, row: usize, lane: usize) {
        self.rows[row].set_lane(lane, true);
    }

    /// Sets the lanes of the rows that hold this contact.
    #[inline(always)]
    pub(super) fn fill(&self, rows: &mut [Rows<Slanted<W>, W>], active: &mut [[Mask<W>; 2]]) {
        for ((rows, active), &lanes) in rows.iter_mut().zip(active).zip(&self.rows) {
            if lanes.any() {
                rows.set_level(lanes, &self.points);
                for (active, mine) in active.iter_mut().zip(self.active) {
                    *active = active.or(mine.and(lanes));
                }
            }
        }
    }

    /// Brings the impulses of the last step from the rows to the points.
    #[inline(always)]
    fn recall(&mut self, rows: &[Rows<Slanted<W>, W>]) {
        for (index, point) in self.points.iter_mut().enumerate() {
            (point.normal_impulse, point.friction_impulse) = (Lanes::ZERO, Lanes::ZERO);
            for (rows, lanes) in rows.iter().zip(&self.rows) {
                let known = &rows.points[index];
                point.normal_impulse = lanes.select(known.normal_impulse, point.normal_impulse);
                point.friction_impulse = lanes.select(known.friction_impulse, point.friction_impulse);
            }
        }
    }
}
