//! Default positions for each kick.

use rsim_referee::codes::Command;
use rsim_referee::config::{HAND_ERROR, RefereeConfig};
use rsim_referee::draws::Draws;
use rsim_referee::sight::Robot;
use rsim_referee::{Referee, Team, Vector};

use crate::outlines::assert_valid;
use crate::pitches::{BALL_RADIUS, Size};
use crate::random::Random;
use crate::scene::Scene;

/// All kicks with the places of their balls.
pub(crate) fn kicks(size: Size) -> Vec<(Command, Vector)> {
    let lines = size.pitch().lines;
    let mut kicks = Vec::new();
    for team in Team::BOTH {
        kicks.push((Command::PrepareKickoff(team), Vector::default()));
        kicks.push((Command::PreparePenalty(team), lines.penalty_mark(team)));
        let x = team.own_side() * (lines.half_length - 0.15);
        let sides: &[f32] = match size {
            Size::Three => &[0.375 - BALL_RADIUS, BALL_RADIUS - 0.375],
            Size::Five => &[0.0],
        };
        kicks.extend(sides.iter().map(|y| (Command::GoalKick(team), Vector::new(x, *y))));
        kicks.extend([1.0, -1.0].map(|side| {
            let mark = Vector::new(team.own_side() * lines.free_ball_x, side * lines.free_ball_y);
            (Command::FreeBall, mark)
        }));
    }
    kicks
}

/// Positions of a team in the half at +x: the keeper's, then the others'.
type Positions = &'static [[f32; 2]];

/// Positions of the teams that have the kick and that receive it, by `replacements.json`, roles in alphabetical
/// order. Those beside a free ball are not in it.
fn positions(command: Command, size: Size) -> [Positions; 2] {
    match (command, size) {
        (Command::PrepareKickoff(_), Size::Three) => [&[[0.675, 0.0], [0.2, 0.0], [0.4, 0.0]]; 2],
        (Command::PrepareKickoff(_), Size::Five) => {
            [&[[1.1, 0.0], [0.3, 0.0], [0.7, 0.0], [0.45, -0.2], [0.45, 0.2]]; 2]
        }
        (Command::PreparePenalty(_), Size::Three) => {
            [&[[0.65, 0.0], [-0.3, 0.0], [0.1, 0.4]], &[[0.7125, 0.0], [-0.1, 0.25], [-0.1, -0.4]]]
        }
        (Command::PreparePenalty(_), Size::Five) => [
            &[[1.03, 0.0], [-0.6, 0.0], [0.3, 0.55], [0.3, 0.05], [0.3, -0.45]],
            &[[1.0625, 0.0], [-0.3, -0.7], [-0.3, 0.8], [-0.3, 0.3], [-0.3, -0.2]],
        ],
        (Command::GoalKick(_), Size::Three) => [
            &[[0.675, 0.27], [0.45, 0.32], [0.3, -0.47]],
            &[[0.675, 0.0], [-0.225, 0.1], [-0.15, -0.32]],
        ],
        (Command::GoalKick(_), Size::Five) => [
            &[[1.03, 0.0], [-0.45, 0.45], [0.4, -0.5], [-0.2, -0.4], [-0.4, 0.2]],
            &[[1.03, 0.0], [0.15, 0.0], [0.6, -0.6], [0.5, -0.3], [0.2, 0.4]],
        ],
        (_, Size::Three) => [&[[0.675, 0.0], [-0.1, -0.2]], &[[0.675, 0.0], [0.3, -0.1]]],
        (_, Size::Five) => [
            &[[1.03, 0.0], [0.4, 0.6], [0.4, -0.6], [-0.7, -0.1]],
            &[[1.03, 0.0], [0.3, -0.5], [-0.4, 0.0], [0.4, -0.1]],
        ],
    }
}

/// Place where the robots of a team have to stand.
fn expected(command: Command, size: Size, ball: Vector, team: Team) -> Vec<Vector> {
    // The team that attacks in the half has the free ball.
    let kicking = command.team().unwrap_or(if ball.x < 0.0 { Team::Yellow } else { Team::Blue });
    let [kicks, receives] = positions(command, size);
    let home = team.own_side();
    let aside = if ball.y < 0.0 { -1.0 } else { 1.0 };
    let positions = if team == kicking { kicks } else { receives };
    let mut places: Vec<Vector> =
        positions.iter().map(|[x, y]| Vector::new(home * x, aside * y)).collect();
    if command == Command::FreeBall {
        let beside = if size == Size::Three { 0.2 } else { 0.25 };
        places.insert(1, Vector::new(ball.x + home * beside, ball.y));
    }
    places
}

/// Ends the stop before a kick, with the bodies where they are.
pub(crate) fn arrange(scene: &mut Scene, command: Command, ball: Vector) {
    scene.game.give(Command::Stop, Some(command));
    scene.game.designated_position = ball;
    scene.game.wait_steps = 0;
    scene.step();
    assert_eq!(scene.game.command, command);
}

/// A match with robots at random places, also in corners and goals, and some of them absent.
pub(crate) fn scattered(size: Size, robots: [usize; 2], seed: u64, absent: f32) -> Scene {
    let mut scene = Scene::with(size.config(), size.pitch(), robots);
    let mut random = Random::new(seed);
    let lines = size.pitch().lines;
    for (team, count) in Team::BOTH.into_iter().zip(robots) {
        for nth in 0..count {
            let x = random.between(-lines.half_length - 0.08, lines.half_length + 0.08);
            let y = random.between(-lines.half_width, lines.half_width);
            scene.robot(team, nth, [x, y]);
            let heading = random.between(-3.0, 3.0);
            scene.set(team, nth, "cos", heading.cos());
            scene.set(team, nth, "sin", heading.sin());
            scene.set(team, nth, "absent", f32::from(u8::from(random.happens(absent))));
        }
    }
    scene
}

#[test]
fn robots_stand_where_the_tables_of_the_league_say() {
    for size in Size::BOTH {
        for (command, ball) in kicks(size) {
            let mut scene = scattered(size, [size.robots(); 2], 1, 0.0);
            arrange(&mut scene, command, ball);
            assert_eq!(scene.ball_position(), ball);
            for team in Team::BOTH {
                for (nth, place) in expected(command, size, ball, team).into_iter().enumerate() {
                    // The kicker of a penalty kick is moved by 0.4 mm: it may turn.
                    let distance = scene.position(team, nth).distance(place);
                    assert!(distance < 5e-4, "{command:?} {team:?} {nth}: {distance}");
                }
            }
            assert_valid(&scene);
        }
    }
}

#[test]
fn a_match_is_lined_up_for_its_first_kick_off() {
    for size in Size::BOTH {
        let mut scene = scattered(size, [5, 5], 8, 0.2);
        scene.roll([0.3, 0.2], [1.0, 0.0]);
        let present = scene.robots().len();
        scene.referee.line_up(&mut scene.row, 0).expect("its row");
        let kickoff = Command::PrepareKickoff(Team::Blue);
        assert_eq!((scene.ball_position(), scene.robots().len()), (Vector::default(), present));
        for team in Team::BOTH {
            let places = expected(kickoff, size, Vector::default(), team);
            let robots = scene.robots().into_iter().filter(|robot| robot.team == team);
            for (robot, place) in robots.zip(places) {
                assert!(robot.position.distance(place) < 1e-6, "{robot:?}");
                assert!(robot.heading.dot(robot.position) < 0.0, "it faces the ball");
            }
        }
        assert_valid(&scene);
    }
}

#[test]
fn hands_put_robots_near_their_places_and_each_time_elsewhere() {
    for size in Size::BOTH {
        for (command, ball) in kicks(size) {
            let placed = |seed| {
                let mut scene = scattered(size, [size.robots(); 2], 1, 0.0);
                let config = RefereeConfig { placement_error: HAND_ERROR, ..size.config() };
                scene.referee = Referee::new(config, size.pitch(), scene.referee.layout().clone())
                    .expect("valid");
                scene.game.placements = Draws::new(seed);
                arrange(&mut scene, command, ball);
                assert_eq!(scene.ball_position(), ball);
                assert_valid(&scene);
                let first: Vec<Robot> = scene.robots();
                arrange(&mut scene, command, ball);
                assert_eq!(first, scene.robots(), "they stay where they are");
                for team in Team::BOTH {
                    for nth in 0..size.robots() {
                        scene.robot(team, nth, [0.1 * team.own_side(), 0.1 * nth as f32]);
                    }
                }
                arrange(&mut scene, command, ball);
                (first, scene.robots())
            };
            let (first, second) = placed(1);
            assert_eq!((&first, &second), (&placed(1).0, &placed(1).1));
            for other in [&second, &placed(2).0] {
                assert!(first.iter().zip(other).all(|(a, b)| a.position != b.position));
            }
            for team in Team::BOTH {
                let robots = first.iter().filter(|robot| robot.team == team);
                for (robot, place) in robots.zip(expected(command, size, ball, team)) {
                    // Robots beside a ball or a goal make room for their turns.
                    let error = robot.position - place;
                    let most = HAND_ERROR + 0.02;
                    assert!(error.x.abs() < most && error.y.abs() < most, "{command:?} {robot:?}");
                }
            }
        }
    }
}

#[test]
fn smaller_teams_have_the_first_places() {
    for size in Size::BOTH {
        for (command, ball) in kicks(size) {
            for robots in [[1, 2], [2, 0], [0, 1], [1, 1]] {
                let mut scene = scattered(size, robots, 2, 0.0);
                arrange(&mut scene, command, ball);
                for (team, count) in Team::BOTH.into_iter().zip(robots) {
                    let expected = expected(command, size, ball, team);
                    for (nth, place) in expected.into_iter().take(count).enumerate() {
                        assert!(scene.position(team, nth).distance(place) < 5e-4);
                    }
                }
                assert_valid(&scene);
            }
        }
    }
}
