//! Moves that nearly lie on one straight line, made one.
//!
//! Knows: how near they have to be. Must not know: speeds, corners.

use gcheck_geometry::{Plane, Seconds};

use crate::axes::{beyond_xyz, xyz};
use crate::item::{Drive, Move};

/// No more points are left out in a row.
const MOST: usize = 100;

/// Moves that may still become one.
#[derive(Debug, Clone)]
pub(crate) struct Merge<T> {
    /// All of them as one.
    whole: Option<Move<T>>,
    /// The points between them.
    between: Vec<nalgebra::Vector3<f64>>,
    blocks: u32,
    /// Their speed.
    pace: f64,
}

impl<T> Default for Merge<T> {
    fn default() -> Self {
        Self { whole: None, between: Vec::new(), blocks: 0, pace: 0.0 }
    }
}

impl<T: Copy> Merge<T> {
    /// Is this a move that may be merged at all?
    pub(crate) fn takes(item: &Move<T>) -> bool {
        item.drive == Drive::Feed && item.arc.is_none() && !beyond_xyz(&(item.to - item.from))
    }

    /// An arc that is as good as straight, as two straight moves by way of its middle.
    pub(crate) fn halves(item: &Move<T>, tolerance: f64) -> Option<[Move<T>; 2]> {
        let arc = item.arc.filter(|arc| item.drive == Drive::Feed && arc.plane() == Plane::Xy)?;
        let bulge = arc.radius().0 * (1.0 - (arc.sweep() / 2.0).cos());
        if arc.sweep().abs() > std::f64::consts::PI
            || bulge >= tolerance
            || beyond_xyz(&(item.to - item.from))
        {
            return None;
        }
        let mut middle = item.from;
        for (slot, part) in middle.iter_mut().zip(arc.point_at(0.5)) {
            *slot = part.0;
        }
        let asked = Seconds(item.asked.0 / 2.0);
        let half = Move { arc: None, asked, ..*item };
        Some([Move { to: middle, ..half }, Move { from: middle, ..half }])
    }

    /// Takes a move that is this many blocks; gives the ones before it, as one, when it does not lie on their line.
    pub(crate) fn add(&mut self, item: &Move<T>, blocks: u32, tolerance: f64) -> Option<(Move<T>, u32)> {
        if let Some(whole) = &mut self.whole {
            let (begin, end) = (xyz(&whole.from), xyz(&item.to));
            let joins = self.between.len() < MOST
                && (pace(item) - self.pace).abs() <= 1e-6 * self.pace
                && (whole.to - item.from).norm() < 1e-9
                && self.between.iter().chain([&xyz(&whole.to)]).all(|p| is_near(p, &begin, &end, tolerance));
            if joins {
                self.between.push(xyz(&whole.to));
                whole.to = item.to;
                whole.asked += item.asked;
                whole.tag = item.tag;
                self.blocks += blocks;
                return None;
            }
        }
        let done = self.take();
        self.whole = Some(*item);
        self.blocks = blocks;
        self.pace = pace(item);
        done
    }

    /// The moves as one.
    pub(crate) fn take(&mut self) -> Option<(Move<T>, u32)> {
        self.between.clear();
        self.whole.take().map(|whole| (whole, std::mem::take(&mut self.blocks)))
    }
}

fn pace<T>(item: &Move<T>) -> f64 {
    (item.to - item.from).norm() / item.asked.0
}

/// Does a point lie beside the line between two others, no further off than this?
fn is_near(
    point: &nalgebra::Vector3<f64>,
    begin: &nalgebra::Vector3<f64>,
    end: &nalgebra::Vector3<f64>,
    tolerance: f64,
) -> bool {
    let line = end - begin;
    let square = line.norm_squared();
    if square <= 0.0 {
        return false;
    }
    let part = (point - begin).dot(&line) / square;
    (0.0..=1.0).contains(&part) && (point - begin - line * part).norm() <= tolerance
}
