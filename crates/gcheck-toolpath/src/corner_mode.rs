//! How corners between moves are taken: the modes that decide it, together.
//!
//! Knows: which events change it, what it says of a tolerance, its words. Must not know: how a control rounds corners, what
//! runs or comparisons do with it.

use gcheck_engine::{Event, PathMode, Smoothing, Units};
use gcheck_geometry::Mm;

/// Does a cycle make the move? Some controls take its corners in a way of their own, whatever the program says.
pub(crate) fn is_of_cycle(event: &Event) -> bool {
    match event {
        Event::Travel(travel) => travel.expanded,
        Event::Arc(arc) => arc.expanded,
        Event::RigidTap { .. } => true,
        _ => false,
    }
}

/// Whether a control looks ahead on command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contour {
    /// It does not.
    Off,
    /// It does.
    On,
    /// It does, with this level of precision.
    Level(u8),
}

/// How corners between moves are taken: all modes that decide it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CornerMode {
    /// Exact stop, exact path or blending; tolerances in millimetres.
    pub path: PathMode,
    /// Level and tolerance that the program gives in place of the control's settings.
    pub smoothing: Smoothing,
    /// Whether the control looks ahead on command.
    pub contour: Contour,
}

impl CornerMode {
    /// As every control takes corners when it is switched on.
    pub const START: Self = Self {
        path: PathMode::Blending { tolerance: Mm::ZERO, naive: None },
        smoothing: Smoothing { level: None, tolerance: None },
        contour: Contour::Off,
    };

    /// Takes over what an event changes.
    pub(crate) fn set(&mut self, event: &Event) {
        match event {
            Event::PathMode(mode) => self.path = *mode,
            Event::Smoothing(Smoothing { level: None, tolerance: None }) => {
                self.smoothing = Smoothing::default();
            }
            Event::Smoothing(smoothing) => {
                self.smoothing = Smoothing {
                    level: smoothing.level.or(self.smoothing.level),
                    tolerance: smoothing.tolerance.or(self.smoothing.tolerance),
                };
            }
            Event::ContourControl { on: false, .. } => self.contour = Contour::Off,
            Event::ContourControl { level, .. } => self.contour = level.map_or(Contour::On, Contour::Level),
            _ => {}
        }
    }

    /// By how much the path may leave the programmed one at a corner, millimetres, as far as a tolerance says it. Infinite
    /// where the program gives none.
    pub(crate) fn tolerance(&self) -> f64 {
        let smoothing = self.smoothing.tolerance.map_or(f64::INFINITY, |tolerance| tolerance.0);
        match self.path {
            PathMode::ExactStop | PathMode::ExactPath => 0.0,
            PathMode::Blending { tolerance, naive } if tolerance.0 > 0.0 => {
                tolerance.0.max(naive.map_or(0.0, |naive| naive.0))
            }
            PathMode::Blending { .. } => smoothing,
        }
    }

    /// As people read it: "exact stop", "corners blended within 0.01 mm".
    pub fn words(&self, units: Units) -> String {
        let length = |length: Mm| {
            let (value, unit) = match units {
                Units::Inch => (length.0 / 25.4, "inch"),
                Units::Mm => (length.0, "mm"),
            };
            let text = format!("{value:.5}");
            format!("{} {unit}", text.trim_end_matches('0').trim_end_matches('.'))
        };
        let within = |mm: Mm| if mm.0.is_nan() { "an unknown tolerance".to_owned() } else { length(mm) };
        let mut words = vec![match self.path {
            PathMode::ExactStop => "exact stop".to_owned(),
            PathMode::ExactPath => "exact path".to_owned(),
            PathMode::Blending { tolerance, naive } => {
                let joined = naive.filter(|naive| naive.0.to_bits() != tolerance.0.to_bits());
                let joined = joined
                    .map_or_else(String::new, |naive| format!(", segments joined within {}", within(naive)));
                if tolerance.0.abs() > 0.0 || tolerance.0.is_nan() {
                    format!("corners blended within {}{joined}", within(tolerance))
                } else {
                    format!("corners blended without a tolerance{joined}")
                }
            }
        }];
        if let Some(level) = self.smoothing.level {
            words.push(format!("smoothing level {level}"));
        }
        if let Some(tolerance) = self.smoothing.tolerance {
            words.push(format!("smoothing within {}", length(tolerance)));
        }
        match self.contour {
            Contour::Level(level) => words.push(format!("contour control, level {level}")),
            Contour::On => words.push("contour control".to_owned()),
            Contour::Off => {}
        }
        words.join(", ")
    }
}
