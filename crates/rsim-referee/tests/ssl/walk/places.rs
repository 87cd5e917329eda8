//! Place where robots may stand after a teleport, by the text of the rules.

use rsim_referee::codes::Command;
use rsim_referee::events::EventKind::{AttackerTooCloseToDefenseArea, DefenderTooCloseToKickPoint};
use rsim_referee::sight::Robot;
use rsim_referee::statistics::Statistics;
use rsim_referee::{Decisions, Lines, Team, Vector};

use crate::scene::{BALL_RADIUS, ROBOT_RADIUS, Scene};

/// Rounding of places, m.
pub(crate) const ROUNDING: f32 = 1e-4;

/// Distance of a place from a rectangle; 0 inside.
fn distance_to_rectangle(place: Vector, x: (f32, f32), y: (f32, f32)) -> f32 {
    let nearest = (place.x.clamp(x.0, x.1), place.y.clamp(y.0, y.1));
    (place.x - nearest.0).hypot(place.y - nearest.1)
}

/// Distance of a place from the goal area at +x, or at -x.
fn distance_to_area(lines: &Lines, place: Vector, side: f32) -> f32 {
    let front = lines.half_length - lines.area_depth;
    let turned = Vector::new(side * place.x, place.y);
    let width = (-lines.half_area_width, lines.half_area_width);
    distance_to_rectangle(turned, (front, f32::INFINITY), width)
}

/// After a teleport all robots are in places that the rules allow, and none overlap.
pub(crate) fn check_places(scene: &Scene) {
    let game = &scene.game;
    let lines = &scene.referee.pitch().lines;
    let is_stopped = matches!(game.command, Command::Stop | Command::Halt);
    let command = match game.command {
        Command::Stop | Command::Halt => game.next_command.expect("a kick is due"),
        Command::NormalStart => game.kick.expect("it was prepared"),
        command => command,
    };
    let robots = scene.robots();
    let ball = scene.sight().ball().position;
    assert!(ball.distance(game.designated_position) <= 0.0101, "{game:?}");
    if matches!(command, Command::DirectFree(_) | Command::ForceStart) {
        check_kick_place(lines, game.designated_position);
    }
    for (nth, robot) in robots.iter().enumerate() {
        check_on_the_field(lines, robot);
        let gap = robot.position.distance(ball) - ROBOT_RADIUS;
        let kicks = command.team() == Some(robot.team) && !is_stopped;
        let least = if kicks { BALL_RADIUS + 0.05 } else { 0.5 };
        assert!(gap >= least - ROUNDING, "{robot:?} is too near in {command:?}");
        for other in &robots[nth + 1..] {
            let distance = robot.position.distance(other.position);
            assert!(distance >= 2.0 * ROBOT_RADIUS, "{robot:?} {other:?}");
        }
    }
    match command {
        Command::PrepareKickoff(team) => check_kickoff(&robots, team),
        Command::PreparePenalty(team) => check_penalty(scene, &robots, team, ball),
        _ => {
            for robot in &robots {
                let distance = distance_to_area(lines, robot.position, -robot.team.own_side());
                assert!(distance >= 0.2 + ROBOT_RADIUS - ROUNDING, "{robot:?} in {command:?}");
            }
        }
    }
}

fn check_kick_place(lines: &Lines, place: Vector) {
    assert!(place.x.abs() <= lines.half_length - 0.2 + ROUNDING, "{place:?}");
    assert!(place.y.abs() <= lines.half_width - 0.2 + ROUNDING, "{place:?}");
    for side in [-1.0, 1.0] {
        assert!(distance_to_area(lines, place, side) >= 1.0 - 2.0 * ROUNDING, "{place:?}");
    }
}

/// A robot is within the walls, and not in the walls of a goal.
fn check_on_the_field(lines: &Lines, robot: &Robot) {
    let place = Vector::new(robot.position.x.abs(), robot.position.y.abs());
    assert!(place.x <= lines.boundary_x - ROBOT_RADIUS, "{robot:?}");
    assert!(place.y <= lines.boundary_y - ROBOT_RADIUS, "{robot:?}");
    let wall = (lines.half_goal_width, lines.half_goal_width + lines.goal_wall_thickness);
    let distance = distance_to_rectangle(place, (lines.half_length, lines.boundary_x), wall);
    assert!(distance >= ROBOT_RADIUS, "{robot:?} is in a wall of a goal");
}

fn check_kickoff(robots: &[Robot], kicking: Team) {
    let mut in_circle = 0;
    for robot in robots {
        let from_center = robot.position.length();
        let is_home = robot.team.own_side() * robot.position.x >= ROBOT_RADIUS - ROUNDING
            && from_center >= 0.5 + ROBOT_RADIUS - ROUNDING;
        if !is_home {
            let touches_own_half = robot.team.own_side() * robot.position.x >= ROBOT_RADIUS;
            let is_inside = from_center + ROBOT_RADIUS <= 0.5 + ROUNDING;
            assert!(is_inside || touches_own_half, "{robot:?}");
            assert_eq!(robot.team, kicking);
            in_circle += 1;
        }
    }
    assert!(in_circle <= 1);
}

fn check_penalty(scene: &Scene, robots: &[Robot], attacker: Team, ball: Vector) {
    let (lines, keepers) = (&scene.referee.pitch().lines, [0, scene.size()]);
    let mut near = 0;
    for robot in robots {
        let is_keeper = robot.team != attacker && keepers.contains(&robot.index);
        if is_keeper {
            let from_line = robot.position.x - robot.team.own_side() * lines.half_length;
            assert!(from_line.abs() <= ROBOT_RADIUS + ROUNDING, "{robot:?}");
            assert!(robot.position.y.abs() <= lines.half_goal_width, "{robot:?}");
            continue;
        }
        let behind = attacker.own_side() * (robot.position.x - ball.x) - ROBOT_RADIUS;
        if behind < 1.0 - ROUNDING {
            assert_eq!(robot.team, attacker, "{robot:?}");
            near += 1;
        }
    }
    assert!(near <= 1, "one kicker");
}

/// Robots that a teleport has placed commit no offense by standing there.
pub(crate) fn check_valid_for_the_rules(scene: &Scene) {
    let mut game = scene.game.clone();
    let row: Vec<f32> = scene.row().to_vec();
    let mut decisions = Decisions::default();
    let mut statistics = Statistics::default();
    scene
        .referee
        .judge(&row, &row, &mut game, &mut statistics, &mut row.clone(), &mut decisions)
        .expect("rows of this layout");
    let offenses = [AttackerTooCloseToDefenseArea, DefenderTooCloseToKickPoint];
    assert!(decisions.events.iter().all(|event| !offenses.contains(&event.kind)));
}
