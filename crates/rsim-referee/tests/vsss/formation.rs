//! Default positions for each kick.

use rsim_referee::codes::Command;
use rsim_referee::{Team, Vector};

use crate::outlines::assert_valid;
use crate::pitches::{BALL_RADIUS, Size};
use crate::random::Random;
use crate::scene::Scene;

/// All kicks with the places of their balls.
fn kicks(size: Size) -> Vec<(Command, Vector)> {
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

/// Where the robots of a team have to stand.
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
fn arrange(scene: &mut Scene, command: Command, ball: Vector) {
    scene.game.give(Command::Stop, Some(command));
    scene.game.designated_position = ball;
    scene.game.wait_steps = 0;
    scene.step();
    assert_eq!(scene.game.command, command);
}

/// A match with robots at random places, also in corners and goals, and some of them absent.
fn scattered(size: Size, robots: [usize; 2], seed: u64, absent: f32) -> Scene {
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
        scene.referee.line_up(&mut scene.row).expect("its row");
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

#[test]
fn any_robots_are_put_on_the_table_without_touching_anything() {
    for size in Size::BOTH {
        for seed in 0..40 {
            for (command, ball) in kicks(size) {
                let mut scene = scattered(size, [5, 5], seed, 0.2);
                let before: Vec<usize> = scene.robots().iter().map(|robot| robot.index).collect();
                arrange(&mut scene, command, ball);
                let after: Vec<usize> = scene.robots().iter().map(|robot| robot.index).collect();
                assert_eq!(before, after, "absent robots stay away");
                assert!(scene.row.iter().all(|value| value.is_finite()));
                assert_valid(&scene);
            }
        }
    }
}

#[test]
fn the_first_robot_on_the_field_keeps_the_goal() {
    for size in Size::BOTH {
        for seed in 0..10 {
            for (command, ball) in kicks(size) {
                let mut scene = scattered(size, [5, 4], seed, 0.4);
                arrange(&mut scene, command, ball);
                let lines = &scene.referee.pitch().lines;
                for team in Team::BOTH {
                    let robots = scene.robots();
                    let Some(keeper) = robots.iter().find(|robot| robot.team == team) else {
                        continue;
                    };
                    let from_goal = keeper.position.distance(lines.goal(team));
                    // At three a side the keeper takes goal kicks, beside its goal.
                    let kicks = size == Size::Three && command == Command::GoalKick(team);
                    let limit = if kicks { 0.3 } else { 0.1 };
                    assert!(from_goal <= limit + 1e-6, "{command:?}: {keeper:?}");
                }
            }
        }
    }
}

#[test]
fn robots_without_a_place_stay_where_they_may() {
    for size in Size::BOTH {
        let robots = [size.robots() + 1; 2];
        for (command, ball) in kicks(size) {
            let mut scene = scattered(size, robots, 3, 0.0);
            // Beside all places of the tables, and beside the blocks in the corners.
            let x = size.pitch().lines.half_length - 0.1;
            let y = size.pitch().lines.half_width - 0.15;
            for team in Team::BOTH {
                scene.robot(team, size.robots(), [team.own_side() * x, y]);
            }
            arrange(&mut scene, command, ball);
            for team in Team::BOTH {
                let place = Vector::new(team.own_side() * x, y);
                assert_eq!(scene.position(team, size.robots()), place);
            }
        }
    }
}

/// Where a robot without a place of a table comes from a place.
fn moved_from(place: [f32; 2]) -> f32 {
    let mut scene = scattered(Size::Three, [4, 3], 4, 0.0);
    scene.robot(Team::Blue, 3, place);
    arrange(&mut scene, Command::PrepareKickoff(Team::Blue), Vector::default());
    scene.position(Team::Blue, 3).distance(Vector::new(place[0], place[1]))
}

#[test]
fn robots_in_walls_corners_and_goals_are_moved_and_those_beside_them_are_not() {
    // 0.0375 m times the root of 2, and 1 mm of room.
    let radius = 0.054_03;
    for (x, y) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        let corner = (0.75 + 0.65 - 0.07 - 2_f32.sqrt() * radius) / 2.0;
        for ([ahead, aside], moves) in [
            ([0.75 - radius - 0.001, 0.4], false),
            ([0.75 - radius + 0.001, 0.4], true),
            ([0.3, 0.65 - radius - 0.001], false),
            ([0.3, 0.65 - radius + 0.001], true),
            ([corner + 0.05 - 0.001, corner - 0.05], false),
            ([corner + 0.05 + 0.002, corner - 0.05], true),
            ([0.749, 0.2 - radius - 0.001], false),
            ([0.749, 0.2 - radius + 0.001], true),
            ([0.751, 0.12], true),
            ([0.749, 0.2 + radius + 0.001], true),
        ] {
            let way = moved_from([x * ahead, y * aside]);
            assert_eq!(way > 0.0, moves, "{ahead} {aside}");
            assert!(way < 0.1, "to a place nearby");
        }
    }
}

#[test]
fn robots_at_the_ball_are_moved_away_from_it() {
    let touching = 0.053_03 + BALL_RADIUS + 0.001;
    for (distance, moves) in [(touching + 0.001, false), (touching - 0.001, true), (0.0, true)] {
        let way = moved_from([0.0, distance]);
        assert_eq!(way > 0.0, moves, "{distance}");
        assert!(way < 0.15);
    }
}

#[test]
fn a_kicker_whose_place_is_that_of_the_ball_is_moved_away_from_it() {
    let mut scene = scattered(Size::Three, [3, 3], 5, 0.0);
    arrange(&mut scene, Command::PreparePenalty(Team::Yellow), Vector::new(-0.3, 0.0));
    assert_valid(&scene);
}

/// The same match with the teams swapped and x with the opposite sign.
fn swapped(scene: &Scene, robots: [usize; 2], size: Size) -> Scene {
    let mut other = Scene::with(size.config(), size.pitch(), [robots[1], robots[0]]);
    for (team, count) in Team::BOTH.into_iter().zip(robots) {
        for nth in 0..count {
            let place = scene.position(team, nth);
            other.robot(team.opponent(), nth, [-place.x, place.y]);
        }
    }
    other
}

/// The same command of the other team.
fn of_opponent(command: Command) -> Command {
    match command {
        Command::PrepareKickoff(team) => Command::PrepareKickoff(team.opponent()),
        Command::PreparePenalty(team) => Command::PreparePenalty(team.opponent()),
        Command::GoalKick(team) => Command::GoalKick(team.opponent()),
        command => command,
    }
}

#[test]
fn both_teams_are_treated_alike() {
    for size in Size::BOTH {
        for seed in 0..40 {
            for (command, ball) in kicks(size) {
                let robots = [5, 4];
                let mut scene = scattered(size, robots, seed, 0.0);
                let mut other = swapped(&scene, robots, size);
                arrange(&mut scene, command, ball);
                arrange(&mut other, of_opponent(command), Vector::new(-ball.x, ball.y));
                for (team, count) in Team::BOTH.into_iter().zip(robots) {
                    for nth in 0..count {
                        let place = scene.position(team, nth);
                        let expected = Vector::new(-place.x, place.y);
                        assert_eq!(other.position(team.opponent(), nth), expected);
                    }
                }
            }
        }
    }
}

#[test]
fn left_and_right_are_treated_alike_at_free_balls_and_goal_kicks() {
    for seed in 0..40 {
        for (command, ball) in kicks(Size::Three).into_iter().filter(|(_, ball)| ball.y > 0.0) {
            let mut scene = scattered(Size::Three, [5, 5], seed, 0.0);
            let mut other = Scene::with(Size::Three.config(), Size::Three.pitch(), [5, 5]);
            for team in Team::BOTH {
                for nth in 0..5 {
                    let place = scene.position(team, nth);
                    other.robot(team, nth, [place.x, -place.y]);
                }
            }
            arrange(&mut scene, command, ball);
            arrange(&mut other, command, Vector::new(ball.x, -ball.y));
            for (robot, mirrored) in scene.robots().iter().zip(other.robots()) {
                let expected = Vector::new(robot.position.x, -robot.position.y);
                assert_eq!(mirrored.position, expected);
            }
        }
    }
}

#[test]
fn robots_at_y_0_are_moved_as_after_half_a_turn() {
    let mut scene = scattered(Size::Three, [4, 4], 6, 0.0);
    for team in Team::BOTH {
        scene.robot(team, 3, [team.own_side() * 0.25, 0.0]);
    }
    arrange(&mut scene, Command::PrepareKickoff(Team::Blue), Vector::default());
    let [blue, yellow] = Team::BOTH.map(|team| scene.position(team, 3));
    assert_eq!(blue, yellow * -1.0);
    assert!(blue.y != 0.0, "the places in line with it are taken");
}
