//! The team's penalty kick: the kicker drives the ball ahead of it, and shoots from near.

use rsim_referee::Vector;

use crate::aim::{self, Kick};
use crate::approach;
use crate::kicking;
use crate::memory::TeamMemory;
use crate::order::Order;
use crate::plane::Plane;
use crate::possession;
use crate::restart;
use crate::rolling;
use crate::situation::Situation;
use crate::view::Player;

/// Way of the ball ahead of the kicker, m.
const WAY: f32 = 3.2;
/// Speed of the ball after that way, m/s.
const ARRIVAL_SPEED: f32 = 0.8;
/// Speed of a ball that is followed, m/s.
const ROLLING: f32 = 0.5;
/// Distance behind it, m.
const FOLLOWING_DISTANCE: f32 = 0.35;
/// Distance from the goal line at which the kicker shoots at the latest, m.
const SHOOTING_DISTANCE: f32 = 3.55;
/// Likelihood of a goal from which it shoots at once.
const GOOD_SHOT: f32 = 0.5;
/// Time after which it shoots from anywhere, s; it has 10.
const PATIENCE: f32 = 7.0;

/// Order of the kicker.
pub(crate) fn kick(s: &Situation, memory: &mut TeamMemory, robot: &Player) -> Order {
    let ball = s.ball();
    if !s.in_play {
        return restart::take(s, memory, robot, &ahead(s));
    }
    let goal = (s.pitch.their_goal() - ball).unit_or(Vector::new(1.0, 0.0));
    let is_near = s.pitch.their_goal().x - ball.x < SHOOTING_DISTANCE;
    if !is_near && s.view.ball.velocity.x > ROLLING {
        // It drives behind the ball and leaves it alone: dribbling ends after 1 m.
        let order = Order::to(ball - goal * FOLLOWING_DISTANCE, goal);
        return Order { moving: s.view.ball.velocity, ..order };
    }
    if !possession::controls(s, robot) {
        return approach::take(s, robot, s.own.of(robot.index).unwrap_or_default(), goal);
    }
    let shot = aim::shot(s, ball);
    let shoots = is_near || shot.value > GOOD_SHOT || s.command_time > PATIENCE;
    let chosen = if shoots { shot } else { ahead(s) };
    let kick = aim::with_error(s, chosen, ball, robot.index);
    let mut order = possession::turn(s, robot, kick.at - ball);
    kicking::release(s, memory, robot, &kick, &mut order);
    order
}

/// The kick that the kicker follows.
fn ahead(s: &Situation) -> Kick {
    let goal = (s.pitch.their_goal() - s.ball()).unit_or(Vector::new(1.0, 0.0));
    let speed = rolling::kick_speed(WAY, ARRIVAL_SPEED, &s.config.ball);
    Kick { at: s.ball() + goal * WAY, speed, chip: false, receiver: None, value: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phase::{Mode, Phase, Restart};
    use crate::testing::Scene;

    const PENALTY: Phase =
        Phase { mode: Mode::Kick, restart: Restart::Penalty, ours: true, kicks_next: false };

    /// A kicker with the ball in its mouth.
    fn order(x: f32, in_play: bool) -> Order {
        let mut scene = Scene::new(1, 0);
        scene.ball([x, 0.0], [0.0, 0.0]);
        scene.robot(0, [x - 0.093, 0.0]);
        scene.set(0, "infrared", 1.0);
        let mut memory = TeamMemory::new(1);
        scene.situation(PENALTY, |s| {
            let s = Situation { in_play, command_time: 3.0, path: s.path.clone(), ..*s };
            kick(&s, &mut memory, &s.view.own[0])
        })
    }

    #[test]
    fn the_first_kick_is_one_that_the_kicker_follows_and_the_last_a_shot() {
        let first = order(-1.5, false);
        assert!((1.0..4.0).contains(&first.kick[0]), "{first:?}");
        let last = order(2.4, true);
        assert!(last.kick[0] > 5.0, "{last:?}");
    }
}
