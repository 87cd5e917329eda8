//! Robots that stand, for forecasts: one that moves by no more than the noise of the cameras is taken to be at rest.
//!
//! The velocity that a filter finds for such a robot is noise, and a forecast would carry the robot along it. Here a
//! robot rests as long as its detections scatter around their mean as the noise does. The ball has no such estimate:
//! it often rolls more slowly than could be separated from noise, and passes became fewer.

use serde::{Deserialize, Serialize};

use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::sensing::Sensing;
use crate::senses::filter::GATE;
use crate::senses::frames::Frame;
use crate::senses::noise::Noise;
use crate::senses::track::unit;

/// Number of detections in a row around one place after which a robot rests: .18 s at 66 frames a second.
const SETTLED: u8 = 12;

/// Number of detections whose mean is the place.
const LONG: u8 = 32;

/// Place of a robot that may rest.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Place {
    /// m.
    position: Vector,
    /// Cosine and sine.
    heading: Vector,
    /// Number of detections around it.
    count: u8,
    /// Time since the last of them, s.
    age: f32,
}

impl Place {
    const UNSEEN: Self =
        Self { position: Vector::ZERO, heading: Vector::X, count: 0, age: f32::INFINITY };

    fn take(&mut self, position: Vector, heading: Vector, noise: Noise) {
        self.age = 0.0;
        let count = f32::from(self.count.max(1));
        let gate = GATE * (1.0 + 1.0 / count);
        let away = (position - self.position).length_squared();
        let turned = self.heading.perp_dot(heading);
        let is_there = away <= gate * noise.robot * noise.robot
            && turned * turned <= gate * noise.heading * noise.heading
            && self.heading.dot(heading) > 0.0;
        if self.count == 0 || !is_there {
            *self = Self { position, heading, count: 1, age: 0.0 };
            return;
        }
        self.count = (self.count + 1).min(LONG);
        let part = 1.0 / f32::from(self.count);
        self.position += (position - self.position) * part;
        self.heading = unit(self.heading + (heading - self.heading) * part);
    }

    /// A robot at rest there.
    pub(super) fn at_rest(&self) -> Motion {
        Motion::at_rest(self.position, self.heading)
    }

    fn is_settled(&self) -> bool {
        self.count >= SETTLED
    }
}

/// Places of all robots.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Resting {
    places: Vec<Place>,
    /// Time between two frames, s.
    period: f32,
}

impl Resting {
    /// Robots of which none was seen.
    pub(super) fn new(robots: usize, period: f32) -> Self {
        Self { places: vec![Place::UNSEEN; robots], period }
    }

    /// Forgets where the robots of a frame were, as they were moved by hand.
    pub(super) fn begin(&mut self, frame: Frame<'_>) {
        for (index, _) in frame.moving_robots() {
            self.places[index] = Place::UNSEEN;
        }
    }

    /// Takes in a frame, `elapsed` (s) after the last. Of detections of a robot by several cameras one counts, and of
    /// copies of a frame none.
    pub(super) fn take(&mut self, frame: Frame<'_>, elapsed: f32, sensing: &Sensing) {
        let noise = Noise::of(sensing);
        for place in &mut self.places {
            place.age += elapsed;
        }
        for (index, Motion { position, heading, .. }) in frame.moving_robots() {
            let place = &mut self.places[index];
            if place.age >= self.period / 2.0 {
                place.take(position, unit(heading), noise);
            }
        }
    }

    /// The place of a robot that rests; `None` if it moves, or there is none.
    pub(super) fn robot(&self, robot: usize) -> Option<Place> {
        self.places.get(robot).copied().filter(Place::is_settled)
    }
}
