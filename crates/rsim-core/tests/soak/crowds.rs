//! Crowds under the highest pressure: in goals and corners, spinning, under a flying ball, with every
//! parameter at an end of its range.

use rsim_core::columns::{BALL_PARAMETERS, ROBOT_PARAMETERS};
use rsim_core::scenes::{self, Driver, Scene, robots_mut, uniform};
use rsim_core::{Field, RobotModel, SimConfig};

use super::depths::Depths;
use super::{fault, ticks};

/// Control steps between two starts of a scene.
const EPISODE: u64 = 200;

/// Part of all ticks for each scene.
const SHARE: u64 = 20;

/// Plays random starts of a scene, and checks every tick.
fn play(name: &str, most: [f32; 3], most_ball: [f32; 3], start: impl Fn(u64) -> Scene) {
    let mut depths = Depths::default();
    for episode in 0..(ticks() / 5 / SHARE / EPISODE).max(2) {
        let mut scene = start(episode);
        scene.config.time_step = scene.config.tick;
        let (mut world, mut row) = (scene.world(), scene.start.clone());
        let mut apart = vec![0; 300];
        for tick in 0..5 * EPISODE {
            world.step(&scene.commands(&row, tick / 5, episode)).expect("finite");
            world.write_row(&mut row);
            if let Some(fault) = fault(&scene.config, &row, &mut apart, 10) {
                panic!("{name}, episode {episode}, tick {tick}: {fault}\n{row:?}");
            }
            depths.look(&scene.config, &row);
        }
    }
    depths.check(name, most, most_ball);
}

/// Both teams in line-up, the ball at `ball`, and all robots chasing it.
fn chase(config: SimConfig, ball: [f32; 2]) -> Scene {
    let mut scene = Scene::lined_up("chase", config, Driver::Chase);
    scene.set_ball(ball, [0.0, 0.0]);
    scene
}

fn draw(episode: u64, part: u64) -> f32 {
    uniform(episode * 1_000_003 + part)
}

#[test]
fn eleven_per_team_press_into_a_goal() {
    let config = SimConfig { field: Field::SSL_A, ..scenes::ssl(11, 11) };
    play("11 v 11 in a goal", [0.2, 1.0, 10.0], [1.0, 4.0, 12.0], |episode| {
        let (depth, side) = (0.05 + 0.05 * draw(episode, 0), 0.7 * draw(episode, 1));
        chase(config.clone(), [config.field.half_length() + depth, side])
    });
}

#[test]
fn five_per_team_press_into_a_corner() {
    let config = SimConfig { field: Field::VSS_5V5, ..scenes::vss(5, 5) };
    play("5 v 5 in a corner", [0.2, 0.6, 6.0], [0.5, 1.0, 6.0], |episode| {
        let end = if episode % 2 == 0 { 1.0 } else { -1.0 };
        let ball = [end * 1.02, 0.82 - 0.05 * draw(episode, 0).abs()];
        chase(config.clone(), ball)
    });
}

#[test]
fn robots_that_spin_at_each_other_and_the_ball_stay_sound() {
    for model in [RobotModel::VSS_440RPM, RobotModel::VSS_650RPM] {
        let mut config = scenes::vss(2, 2);
        (config.blue, config.yellow) = (vec![model.clone(); 2], vec![model.clone(); 2]);
        play("spin duels", [1.5, 4.0, 8.0], [2.0, 4.0, 8.0], |episode| {
            let full = vec![-100.0, 100.0];
            let commands =
                (0..4).map(|nth| if nth == 1 { vec![100.0, -100.0] } else { full.clone() });
            let poses =
                [[-0.06, 0.0, 0.0], [0.06, 0.0, 45.0], [0.0, 0.12, 10.0], [0.0, -0.12, 80.0]];
            let driver = Driver::Constant(commands.collect());
            let mut scene = Scene::at("spin", config.clone(), &poses, driver);
            // The robots drift into each other, and the ball into them.
            for (nth, robot) in robots_mut(&mut scene.start).enumerate() {
                robot[4] = -robot[0] * 8.0 * (1.2 + draw(episode, nth as u64));
                robot[5] = -robot[1] * 8.0;
            }
            scene.set_ball([0.16, 0.16 + 0.03 * draw(episode, 9)], [-1.5, -1.5]);
            scene
        });
    }
}

#[test]
fn a_flying_ball_in_every_corner_is_as_solid_as_on_the_floor() {
    for config in [scenes::ssl(4, 0), scenes::vss(4, 0)] {
        let vss = config.field.corner_leg > 0.0;
        play("flying ball in a corner", [0.2, 0.5, 3.0], [0.3, 1.0, 3.0], |episode| {
            let sign = |odd: u64| if odd % 2 == 0 { 1.0_f32 } else { -1.0 };
            let (end, side) = (sign(episode), sign(episode / 2));
            let inset = config.ball.radius + if vss { config.field.corner_leg / 2.0 } else { 0.0 };
            let out = |inset: f32| {
                [end * (config.field.max_x() - inset), side * (config.field.max_y() - inset)]
            };
            let (max_x, step) = if vss {
                (config.field.half_length(), 0.062)
            } else {
                (config.field.max_x(), 0.135)
            };
            let corner = [end * (max_x - inset - 0.005), out(inset + 0.005)[1]];
            let heading = side.atan2(end).to_degrees();
            let back = |nth: usize| {
                let away =
                    config.blue[0].front_distance() * 0.75 + config.ball.radius + step * nth as f32;
                [corner[0] - end * away, corner[1] - side * away, heading]
            };
            let command = if vss { vec![46.0, 46.0] } else { vec![2.0, 0.0, 0.0, 0.0, 0.0, 0.0] };
            let poses: Vec<_> = (0..4).map(back).collect();
            let driver = Driver::Constant(vec![command; 4]);
            let mut scene = Scene::at("corner", config.clone(), &poses, driver);
            scene.set_ball(corner, [0.0, 0.0]);
            let top = config.blue[0].height - config.ball.radius;
            scene.set_ball_column("z", top * draw(episode, 0).abs());
            scene
        });
    }
}

#[test]
fn parameters_at_the_ends_of_their_ranges_stay_sound() {
    for config in [scenes::vss(3, 3), scenes::ssl(4, 4)] {
        play("own parameters", [0.3, 2.0, 12.0], [0.8, 4.0, 25.0], |episode| {
            let mut scene = chase(config.clone(), [0.3 * draw(episode, 0), 0.3 * draw(episode, 1)]);
            let names = BALL_PARAMETERS.iter().chain(
                ROBOT_PARAMETERS.iter().cycle().take(ROBOT_PARAMETERS.len() * config.n_robots()),
            );
            let parameters = names.enumerate().map(|(nth, name)| {
                let low = draw(episode, 100 + nth as u64) < 0.0;
                match (*name, low) {
                    ("speed" | "acceleration", false) => 1.25,
                    // A ball that loses no energy gets ever faster between robots that meet.
                    ("robot_restitution" | "wall_restitution", false) => 1.5,
                    (_, true) => 0.5,
                    (_, false) => 2.0,
                }
            });
            scene.parameters = Some(parameters.collect());
            scene
        });
    }
}
