//! Orders of all robots of a team in a step: who does what.

use rsim_referee::Vector;

use crate::aim;
use crate::approach;
use crate::config::MAX_ROBOTS;
use crate::keeper;
use crate::memory::Memory;
use crate::order::Order;
use crate::penalty;
use crate::phase::{Mode, Restart};
use crate::placement;
use crate::plane::Plane;
use crate::possession;
use crate::restart;
use crate::roles;
use crate::situation::{KEEPER, Situation};
use crate::support::{self, RUNNER};
use crate::view::Player;

/// Distance from the ball within which a robot reacts at once, m.
const CLOSE: f32 = 0.6;
/// Distance from the ball of the robot that blocks a kick of the opponents, m.
const BLOCK_DISTANCE: f32 = 0.8;
/// Time by which an opponent is earlier at the ball from which a robot without teammates guards its goal, s.
const ALONE: f32 = 0.2;

/// Orders of all robots, by index.
pub(crate) fn orders(s: &Situation, memory: &mut Memory) -> [Order; MAX_ROBOTS] {
    let stay = Order::to(Vector::default(), Vector::new(1.0, 0.0));
    let mut orders = [stay; MAX_ROBOTS];
    let taker = memory.team.taker;
    let mut free = 0;
    for player in s.view.own.iter() {
        if s.keeps(player.index) {
            let order = keeper_order(s, memory, player);
            orders[player.index] = reacting(s, memory, player, order);
        } else if taker == Some(player.index) {
            let order = taker_order(s, memory, player);
            orders[player.index] = reacting(s, memory, player, order);
        } else {
            free |= 1 << player.index;
        }
    }
    let jobs = roles::jobs(s, memory, free);
    let is_runner = |index: usize| jobs[index].is_some_and(|job| job.number == RUNNER);
    let runners = (0..MAX_ROBOTS).filter(|index| is_runner(*index)).fold(0, |all, i| all | 1 << i);
    for player in s.view.own.iter().filter(|player| free >> player.index & 1 == 1) {
        let Some(job) = jobs[player.index] else { continue };
        let target =
            job.place.unwrap_or_else(|| support::spot(s, player, runners, &mut memory.robots));
        memory.robots[player.index].job = job.number;
        let order = Order::to(target, s.ball() - player.position);
        orders[player.index] = reacting(s, memory, player, order);
    }
    if let Some(index) = taker {
        memory.robots[index].job = -1;
    }
    orders
}

/// The order as the robot follows it: it sees a new place only after its reaction time.
fn reacting(s: &Situation, memory: &mut Memory, player: &Player, order: Order) -> Order {
    let kept = &mut memory.robots[player.index];
    let steps = s.skill.reaction_steps;
    let turn = i32::try_from(player.index).unwrap_or(0) * 3;
    let is_close = player.index != KEEPER && player.position.distance(s.ball()) < CLOSE;
    if s.phase.mode != Mode::Play || is_close || (s.step + turn) % steps == 0 {
        (kept.target, kept.facing) = (order.target, order.facing);
        return order;
    }
    Order { target: kept.target, facing: kept.facing, ..order }
}

fn keeper_order(s: &Situation, memory: &mut Memory, keeper: &Player) -> Order {
    if roles::is_penalty(s) && !s.phase.ours && s.path.speed < 0.1 {
        return keeper::on_line(s, keeper);
    }
    if s.phase.mode == Mode::Play && s.barred != Some(KEEPER) && keeper::takes_ball(s) {
        return ball_order(s, memory, keeper);
    }
    keeper::guard(s, keeper)
}

fn taker_order(s: &Situation, memory: &mut Memory, robot: &Player) -> Order {
    match s.phase.mode {
        Mode::Play | Mode::Halt => ball_order(s, memory, robot),
        Mode::Kick if s.phase.ours && s.phase.restart == Restart::Penalty => {
            penalty::kick(s, &mut memory.team, robot)
        }
        Mode::Kick if s.phase.ours => restart::take_kick(s, &mut memory.team, robot),
        Mode::Place if s.phase.ours => placement::place(s, &mut memory.team, robot),
        Mode::Stop | Mode::Prepare if s.phase.ours => restart::wait_for_kick(s),
        _ => Order::to(block_place(s), s.ball() - robot.position),
    }
}

/// Takes the ball, or plays it.
fn ball_order(s: &Situation, memory: &mut Memory, robot: &Player) -> Order {
    if possession::controls(s, robot) {
        return possession::play(s, &mut memory.team, robot);
    }
    if possession::is_too_far(s, &memory.team, robot) {
        return possession::stand(robot);
    }
    let meeting = s.own.of(robot.index).unwrap_or_default();
    let to_ball = (meeting.place - robot.position).unit_or(robot.heading);
    let rival = s.rival().map_or(f32::INFINITY, |(_, meeting)| meeting.time);
    let is_alone = s.view.own.len() == 1;
    if is_alone && rival + ALONE < meeting.time {
        return keeper::guard(s, robot);
    }
    let place = meeting.place;
    let kick = possession::chosen(s, &mut memory.team, robot.index, || {
        aim::best_kick(s, place, robot.index)
    });
    let aim = (kick.at - place).unit_or(Vector::new(1.0, 0.0));
    let least = if robot.index == KEEPER {
        -1.0 // it never drives the ball toward its goal
    } else if rival > meeting.time + 0.5 {
        s.tactics.aimed_with_time - 1.0
    } else {
        s.tactics.aimed
    };
    approach::take(s, robot, meeting, if aim.dot(to_ball) > least { aim } else { to_ball })
}

/// Place of the robot nearest to the ball where it may not play it: between ball and goal.
fn block_place(s: &Situation) -> Vector {
    let ball = s.ball();
    let to_goal = (s.pitch.own_goal() - ball).unit_or(Vector::new(-1.0, 0.0));
    ball + to_goal * BLOCK_DISTANCE
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PLAY, Scene};

    #[test]
    fn a_lone_robot_fetches_the_ball_that_a_nearer_opponent_may_not_touch() {
        let mut scene = Scene::new(1, 1);
        scene.robot(0, [-2.0, 0.0]);
        scene.robot(1, [1.3, 0.0]);
        scene.ball([1.0, 0.0], [0.0, 0.0]);
        let target = |barred_opponent| {
            scene.situation(PLAY, |s| {
                let situation = Situation { barred_opponent, path: s.path.clone(), ..*s };
                let mut memory = Memory::new(1);
                ball_order(&situation, &mut memory, &s.view.own[0]).target
            })
        };
        let ball = Vector::new(1.0, 0.0);
        assert!(target(Some(0)).distance(ball) < 0.5, "{:?}", target(Some(0)));
        assert!(target(None).distance(ball) > 2.0, "it guards its goal: {:?}", target(None));
    }
}
