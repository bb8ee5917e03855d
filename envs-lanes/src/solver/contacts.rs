use super::{body::Body, ledges::Ledges, level::LevelContact, pace::Pace, uneven::UnevenContact};
use crate::lanes::Mask;
use creatures::Blueprint;
use envs_core::{Ground, GroundShape};
use std::sync::Arc;

/// The contacts of each part with the ground.
#[derive(Clone, Debug)]
pub(super) enum Contacts<const W: usize> {
    /// A single half-space.
    Level(Vec<LevelContact<W>>),
    /// Anything else.
    Uneven(Vec<UnevenContact<W>>),
}

impl<const W: usize> Contacts<W> {
    pub(super) fn new(blueprint: &Blueprint, ground: &Ground) -> Self {
        let shapes = blueprint.parts().iter().map(|part| part.shape);
        if ground.shapes == [GroundShape::HalfSpace] {
            Self::Level(shapes.map(LevelContact::new).collect())
        } else {
            let ledges = Arc::new(Ledges::new(ground));
            Self::Uneven(shapes.map(|shape| UnevenContact::new(shape, ledges.clone())).collect())
        }
    }

    pub(super) fn reset(&mut self, part: usize, lane: usize, friction: f32) {
        match self {
            Self::Level(contacts) => contacts[part].rows.reset(lane, friction),
            Self::Uneven(contacts) => contacts[part].reset(lane, friction),
        }
    }

    pub(super) fn is_level(&self) -> bool {
        matches!(self, Self::Level(_))
    }

    pub(super) fn copy_lane(&mut self, lane: usize, from: &Contacts<1>) {
        match (self, from) {
            (Self::Level(mine), Contacts::Level(theirs)) => {
                mine.iter_mut().zip(theirs).for_each(|(mine, theirs)| mine.copy_lane(lane, theirs));
            }
            (Self::Uneven(mine), Contacts::Uneven(theirs)) => {
                mine.iter_mut().zip(theirs).for_each(|(mine, theirs)| mine.copy_lane(lane, theirs));
            }
            // Worlds of one kind have one kind of ground.
            (Self::Level(_), Contacts::Uneven(_)) | (Self::Uneven(_), Contacts::Level(_)) => {}
        }
    }

    #[inline(always)]
    pub(super) fn pressing(&self, part: usize) -> Mask<W> {
        match self {
            Self::Level(contacts) => contacts[part].rows.pressing,
            Self::Uneven(contacts) => contacts[part].pressing(),
        }
    }

    #[inline(always)]
    pub(super) fn find(&mut self, bodies: &[Body<W>], reach: f32, pace: &Pace<W>) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter().zip(contacts) {
                    contact.find(body, reach);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter().zip(contacts) {
                    contact.find(body, reach, &pace.time_step);
                }
            }
        }
    }

    #[inline(always)]
    pub(super) fn prepare(&mut self, bodies: &mut [Body<W>], pace: &Pace<W>) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.rows.prepare(body, pace);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.prepare(body, pace);
                }
            }
        }
    }

    #[inline(always)]
    pub(super) fn solve(&mut self, bodies: &mut [Body<W>]) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.rows.solve(body);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.solve(body);
                }
            }
        }
    }

    #[inline(always)]
    pub(super) fn relax(&mut self, bodies: &mut [Body<W>], pace: &Pace<W>) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.rows.relax(body, pace);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.relax(body, pace);
                }
            }
        }
    }

    /// Keeps what some of the lanes press on the ground with, for [`put_back`](Self::put_back) in the same step.
    pub(super) fn keep(&mut self, lanes: Mask<W>) {
        match self {
            Self::Level(contacts) => contacts.iter_mut().for_each(|contact| contact.rows.keep(lanes)),
            Self::Uneven(contacts) => contacts.iter_mut().for_each(|contact| contact.keep(lanes)),
        }
    }

    /// Has these lanes press on the ground with what was kept of them.
    pub(super) fn put_back(&mut self, lanes: Mask<W>) {
        match self {
            Self::Level(contacts) => contacts.iter_mut().for_each(|contact| contact.rows.put_back(lanes)),
            Self::Uneven(contacts) => contacts.iter_mut().for_each(|contact| contact.put_back(lanes)),
        }
    }
}
