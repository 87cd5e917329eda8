//! Place where a robot may be and how fast, by the rules.

use rsim_referee::Vector;

use crate::avoidance::{Avoided, Limit};
use crate::phase::{Mode, Phase, Restart};
use crate::pitch::{Area, Pitch};

/// Speed in a stop, m/s; the rules allow 1.5.
const STOP_SPEED: f32 = 1.2;
/// Distance of hulls from the ball before a kick of the opponents and in a stop, m.
const BALL_DISTANCE: f32 = 0.5;
/// Distance of hulls from the opponents' area before a kick, m.
const AREA_DISTANCE: f32 = 0.2;
/// Distance behind the ball of robots that take no part in a penalty kick, m.
const PENALTY_DISTANCE: f32 = 1.0;
/// Room to that distance, m: robots of both teams that stand there push each other.
const PENALTY_ROOM: f32 = 0.3;
/// Room to the limits of the rules, m.
const ROOM: f32 = 0.04;
/// Room to the distance from the ball, m: in the step of a kick the ball moves up to 0.16.
const BALL_ROOM: f32 = 0.17;
/// Room to the own area and to walls, m.
const PLAY_ROOM: f32 = 0.02;
/// Room to the opponents' area, in which a touch of the ball is a foul, m.
const TOUCH_ROOM: f32 = 0.05;

/// Part that a robot takes in a restart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// The keeper.
    Keeper,
    /// The robot that takes the kick or places the ball.
    Taker,
    /// Any other.
    Other,
}

/// Place where a robot may be and how fast.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    /// m/s.
    pub(crate) max_speed: f32,
    /// Way around which the robot keeps its distance.
    pub(crate) avoided: Avoided,
    /// Distance of the center from the opponents' area, m.
    pub(crate) their_area: f32,
    /// Distance of the center from the own area, m; none for the keeper.
    pub(crate) own_area: Option<f32>,
    /// Limits of x, m.
    pub(crate) x: [f32; 2],
}

impl Bounds {
    /// Bounds of a robot with a radius, for a kick or placement with the ball at `ball` that has to be at `place`.
    pub(crate) fn new(
        phase: Phase,
        part: Part,
        [ball, place]: [Vector; 2],
        max_speed: f32,
        pitch: &Pitch,
        radius: f32,
    ) -> Self {
        let mut bounds = Self {
            max_speed,
            avoided: Avoided {
                ends: [ball; 2],
                distance: 0.0,
                walls: pitch.within_walls(Vector::new(100.0, 100.0), radius + PLAY_ROOM),
            },
            their_area: radius + TOUCH_ROOM,
            own_area: (part != Part::Keeper).then_some(radius + PLAY_ROOM),
            x: [f32::NEG_INFINITY, f32::INFINITY],
        };
        let from_ball = BALL_DISTANCE + radius + ROOM;
        let is_taker = part == Part::Taker;
        match phase.mode {
            Mode::Play | Mode::Halt => return bounds,
            Mode::Stop => {
                bounds.max_speed = max_speed.min(STOP_SPEED);
                bounds.avoided.distance = from_ball;
            }
            Mode::Place => {
                bounds.avoided.ends = [ball, place];
                bounds.avoided.distance = from_ball + ROOM;
                if is_taker && phase.ours {
                    // It takes the ball wherever it lies.
                    bounds.avoided.distance = 0.0;
                    (bounds.own_area, bounds.their_area) = (None, f32::NEG_INFINITY);
                    return bounds;
                }
            }
            Mode::Prepare | Mode::Kick if !phase.ours => {
                bounds.avoided.distance = BALL_DISTANCE + radius + BALL_ROOM;
            }
            Mode::Prepare | Mode::Kick => {}
        }
        match phase.restart {
            Restart::Free => bounds.their_area = AREA_DISTANCE + radius + ROOM,
            Restart::Kickoff => bounds.keep_to_kickoff(phase, part, radius),
            Restart::Penalty => bounds.keep_to_penalty(phase, part, place, radius),
        }
        bounds
    }

    fn keep_to_kickoff(&mut self, phase: Phase, part: Part, radius: f32) {
        let is_kicker = phase.ours && part == Part::Taker && phase.mode != Mode::Stop;
        if !is_kicker {
            // The center circle has the radius of the distance from the ball.
            self.avoided.distance = BALL_DISTANCE + radius + BALL_ROOM;
            self.avoided.ends = [Vector::default(); 2];
            self.x[1] = -(radius + ROOM);
        }
    }

    fn keep_to_penalty(&mut self, phase: Phase, part: Part, place: Vector, radius: f32) {
        let behind = PENALTY_DISTANCE + radius + PENALTY_ROOM;
        if phase.ours {
            let is_kicker = part == Part::Taker;
            self.x[1] = place.x - if is_kicker { 0.0 } else { behind };
            if is_kicker && phase.mode == Mode::Kick {
                self.x[1] = f32::INFINITY;
            }
        } else if part != Part::Keeper {
            self.x[0] = place.x + behind;
        } else {
            self.avoided.distance = 0.0;
        }
    }

    /// The nearest place that is allowed.
    pub(crate) fn allowed(&self, place: Vector, pitch: &Pitch, radius: f32) -> Vector {
        let mut place = pitch.within_walls(place, radius + PLAY_ROOM);
        for _ in 0..2 {
            if let Some(own) = self.own_area {
                place = pitch.outside(Area::Own, place, own);
            }
            place = pitch.outside(Area::Theirs, place, self.their_area);
            let limit = self.avoided.limit(place);
            if limit.distance < 0.0 {
                place = self.avoided.nearest(place) + limit.away * self.avoided.distance;
            }
            place.x = place.x.clamp(self.x[0], self.x[1]);
        }
        pitch.within_walls(place, radius + PLAY_ROOM)
    }

    /// Limits at a place.
    pub(crate) fn limits(&self, place: Vector, pitch: &Pitch) -> [Limit; 5] {
        let area = |area: Area, margin: f32| Limit {
            distance: pitch.distance_to(area, place) - margin,
            away: pitch.away_from(area, place),
        };
        let along_x = |distance: f32, x: f32| Limit { distance, away: Vector::new(x, 0.0) };
        [
            self.own_area.map_or(along_x(f32::INFINITY, 1.0), |margin| area(Area::Own, margin)),
            area(Area::Theirs, self.their_area),
            self.avoided.limit(place),
            along_x(place.x - self.x[0], 1.0),
            along_x(self.x[1] - place.x, -1.0),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::pitch;

    const RADIUS: f32 = 0.09;

    fn bounds(mode: Mode, restart: Restart, ours: bool, part: Part, ball: Vector) -> Bounds {
        let phase = Phase { mode, restart, ours, kicks_next: false };
        Bounds::new(phase, part, [ball; 2], 3.0, &pitch(), RADIUS)
    }

    #[test]
    fn in_a_stop_robots_are_slow_and_far_from_ball_and_area() {
        let ball = Vector::new(2.5, 1.0);
        let bounds = bounds(Mode::Stop, Restart::Free, true, Part::Taker, ball);
        assert!(bounds.max_speed < 1.5);
        let place = bounds.allowed(Vector::new(2.6, 1.0), &pitch(), RADIUS);
        assert!(place.distance(ball) > 0.5 + RADIUS, "{place:?}");
        assert!(pitch().distance_to(Area::Theirs, place) > 0.2 + RADIUS, "{place:?}");
    }

    #[test]
    fn places_between_ball_and_wall_move_along_the_wall() {
        for (ball, wanted) in [
            (Vector::new(2.4, -2.8), Vector::new(2.6, -3.2)),
            (Vector::new(-4.3, 2.8), Vector::new(-4.7, 3.2)),
            (Vector::new(4.6, -0.9), Vector::new(4.7, -1.0)),
        ] {
            let bounds = bounds(Mode::Kick, Restart::Free, false, Part::Keeper, ball);
            let place = bounds.allowed(wanted, &pitch(), RADIUS);
            assert!(place.distance(ball) > 0.5 + RADIUS, "{ball:?}: {place:?}");
            assert!(place.x.abs() < 4.8 - RADIUS && place.y.abs() < 3.3 - RADIUS, "{place:?}");
        }
    }

    #[test]
    fn only_the_keeper_may_stand_in_the_own_area() {
        let wanted = Vector::new(-4.2, 0.3);
        let at = |part| {
            let bounds = bounds(Mode::Play, Restart::Free, false, part, Vector::default());
            bounds.allowed(wanted, &pitch(), RADIUS)
        };
        assert_eq!(at(Part::Keeper), wanted);
        assert!(pitch().distance_to(Area::Own, at(Part::Other)) > RADIUS);
    }

    #[test]
    fn at_a_kickoff_all_but_the_kicker_stay_in_their_half() {
        let wanted = Vector::new(0.2, 0.1);
        for ours in [true, false] {
            let ball = Vector::default();
            let bounds = bounds(Mode::Kick, Restart::Kickoff, ours, Part::Other, ball);
            let place = bounds.allowed(wanted, &pitch(), RADIUS);
            assert!(place.x < -RADIUS && place.length() > 0.5 + RADIUS, "{place:?}");
        }
        let ball = Vector::default();
        let kicker = bounds(Mode::Kick, Restart::Kickoff, true, Part::Taker, ball);
        assert_eq!(kicker.allowed(wanted, &pitch(), RADIUS), wanted);
    }

    #[test]
    fn opponents_leave_the_way_of_a_placement() {
        let ends = [Vector::new(-1.0, 0.0), Vector::new(1.0, 0.0)];
        let phase =
            Phase { mode: Mode::Place, restart: Restart::Free, ours: false, kicks_next: false };
        let bounds = Bounds::new(phase, Part::Other, ends, 3.0, &pitch(), RADIUS);
        let place = bounds.allowed(Vector::new(0.3, 0.1), &pitch(), RADIUS);
        assert!(place.y > 0.5 + RADIUS, "{place:?}");
        let limit = bounds.limits(Vector::new(0.3, 0.1), &pitch())[2];
        assert!(limit.distance < 0.0 && limit.away.y > 0.99, "{limit:?}");
    }

    #[test]
    fn at_a_penalty_kick_the_others_stand_behind_the_ball() {
        let ball = Vector::new(-1.5, 0.0);
        let theirs = bounds(Mode::Kick, Restart::Penalty, false, Part::Other, ball);
        assert!(theirs.allowed(Vector::new(-3.0, 1.5), &pitch(), RADIUS).x > -0.5 + RADIUS);
        let keeper = bounds(Mode::Kick, Restart::Penalty, false, Part::Keeper, ball);
        let on_line = Vector::new(-4.5, 0.0);
        assert_eq!(keeper.allowed(on_line, &pitch(), RADIUS), on_line);
    }
}
