//! Freedom of the way of a kicked ball from opponents.

use rsim_referee::Vector;

use crate::plane::Plane;
use crate::tactics::Tactics;
use crate::view::Player;

/// Margin from which no opponent is in the way, m.
pub(crate) const FREE: f32 = 1.0;

/// Way of a kicked ball.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lane {
    /// Place where it is kicked, m.
    pub(crate) start: Vector,
    /// Place where it goes, m.
    pub(crate) end: Vector,
    /// Speed of the kick, m/s.
    pub(crate) speed: f32,
    /// Distance over which it flies above robots, m.
    pub(crate) flies: f32,
}

/// Distance by which the ball passes the opponent that comes nearest to stopping it, m; negative if it can.
/// `body` is the sum of the radii of robot and ball.
pub(crate) fn margin(t: &Tactics, lane: &Lane, opponents: &[Player], body: f32) -> f32 {
    let way = lane.end - lane.start;
    let length = way.length();
    let ahead = way.unit_or(Vector::new(1.0, 0.0));
    let mut least = FREE;
    for opponent in opponents {
        let along = (opponent.position - lane.start).dot(ahead);
        if along < -body || along > length + FREE || along > 0.0 && along < lane.flies {
            continue;
        }
        let along = along.clamp(0.0, length);
        let time = along / (lane.speed * t.lane_ball_share);
        let place = opponent.position + opponent.velocity * time.min(t.reaction_time);
        let gap = place.distance(lane.start + ahead * along);
        least = least.min(gap - body - reach(t, time));
    }
    least
}

/// Distance that an opponent moves toward the ball in a time (s) after the kick, m.
pub(crate) fn reach(t: &Tactics, time: f32) -> f32 {
    let time = (time - t.reaction_time).max(0.0);
    let speeding_up = t.lane_speed / t.lane_acceleration;
    if time < speeding_up {
        0.5 * t.lane_acceleration * time * time
    } else {
        t.lane_speed * (time - 0.5 * speeding_up)
    }
}

/// Likelihood that a ball with this margin passes.
pub(crate) fn chance(t: &Tactics, margin: f32) -> f32 {
    ((margin + t.chance_offset) / t.chance_width).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: f32 = 0.11;

    fn lane(x: f32) -> Lane {
        Lane { start: Vector::default(), end: Vector::new(x, 0.0), speed: 6.0, flies: 0.0 }
    }

    fn opponent(x: f32, y: f32) -> [Player; 1] {
        [Player { position: Vector::new(x, y), ..Player::default() }]
    }

    #[test]
    fn opponents_have_more_time_far_from_the_kick() {
        let near = margin(&Tactics::DEFAULT, &lane(4.0), &opponent(0.5, 0.4), BODY);
        let far = margin(&Tactics::DEFAULT, &lane(4.0), &opponent(3.5, 0.4), BODY);
        assert!((near - 0.29).abs() < 0.01, "{near}");
        assert!(
            far < 0.0 && chance(&Tactics::DEFAULT, far) < chance(&Tactics::DEFAULT, near),
            "{far}"
        );
    }

    #[test]
    fn opponents_behind_the_kick_or_under_its_flight_are_not_in_the_way() {
        assert!(margin(&Tactics::DEFAULT, &lane(2.0), &opponent(-0.5, 0.0), BODY) >= FREE);
        let blocked = opponent(0.8, 0.0);
        assert!(margin(&Tactics::DEFAULT, &lane(3.0), &blocked, BODY) < 0.0);
        let chip = Lane { flies: 1.5, ..lane(3.0) };
        assert!(margin(&Tactics::DEFAULT, &chip, &blocked, BODY) >= FREE);
    }
}
