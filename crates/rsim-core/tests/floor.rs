//! A kicked ball on an empty floor against the closed form of its preset: it slides, rolls and stops, the
//! same in every direction and at every tick.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::ball_column;
use rsim_core::scenes::{self, Scene, lone_ball, rolling_ball, steps};
use rsim_core::{BallModel, SimConfig};

/// A row of table F 3.4 for a straight kick without spin: slide end (m, s), speeds at 3 and 6 m
/// (m/s, `None` where it does not get so far), stop (m).
struct RollOut {
    slide_way: f32,
    slide_time: f32,
    at_3: Option<f32>,
    at_6: Option<f32>,
    stop: f32,
}

/// Distance in which a rolling ball slows from one speed to another (m/s), m. With drag it is the
/// integral of v / (a + b v).
fn rolls(ball: &BallModel, from: f32, to: f32) -> f32 {
    let (a, b) = (ball.rolling_deceleration, ball.rolling_drag);
    if b > 0.0 {
        (from - to - a / b * ((a + b * from) / (a + b * to)).ln()) / b
    } else {
        (from * from - to * to) / (2.0 * a)
    }
}

/// Speed of a rolling ball after a distance (m), m/s; `None` if it stops before. By bisection.
fn rolled(ball: &BallModel, speed: f32, way: f32) -> Option<f32> {
    let (mut slow, mut fast) = (0.0, speed);
    for _ in 0..40 {
        let middle = f32::midpoint(slow, fast);
        if rolls(ball, speed, middle) > way { slow = middle } else { fast = middle }
    }
    (rolls(ball, speed, 0.0) > way).then_some(slow)
}

/// The closed form: a uniformly decelerated slide, then rolling.
fn closed_form(ball: &BallModel, kick: f32) -> RollOut {
    let first = ball.slide_to_roll_ratio * kick;
    let slide_way = (kick * kick - first * first) / (2.0 * ball.sliding_deceleration);
    let speed_at = |way: f32| {
        if way < slide_way {
            Some((kick * kick - 2.0 * ball.sliding_deceleration * way).sqrt())
        } else {
            rolled(ball, first, way - slide_way)
        }
    };
    RollOut {
        slide_way,
        slide_time: (kick - first) / ball.sliding_deceleration,
        at_3: speed_at(3.0),
        at_6: speed_at(6.0),
        stop: slide_way + rolls(ball, first, 0.0),
    }
}

/// A field with 100 m of free way.
fn endless(ball: &BallModel) -> SimConfig {
    let mut config = SimConfig { ball: ball.clone(), ..scenes::ssl(0, 0) };
    (config.field.length, config.field.width) = (200.0, 200.0);
    config
}

/// Positions and velocities after each step of a kick in a direction, relative to it: (way, speed,
/// rim speed) from the start on.
fn track(config: &SimConfig, kick: f32, degrees: f32, seconds: f32) -> Vec<[f32; 3]> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let scene = lone_ball(config.clone(), [0.0, 0.0], [kick * cos, kick * sin]);
    let (rows, _) = scene.play(&mut scene.world(), steps(seconds, config.time_step));
    let along = |x: f32, y: f32| x * cos + y * sin;
    let (v_x, spin_x) = (ball_column("v_x"), ball_column("spin_x"));
    rows.chunks_exact(config.row_size())
        .map(|row| {
            let rim = [row[spin_x + 1], -row[spin_x]].map(|part| part * config.ball.radius);
            [along(row[0], row[1]), along(row[v_x], row[v_x + 1]), along(rim[0], rim[1])]
        })
        .collect()
}

/// Speed when the way reaches `at`, between two steps.
fn speed_at(track: &[[f32; 3]], at: f32) -> Option<f32> {
    let pair = track.windows(2).find(|pair| pair[0][0] <= at && pair[1][0] > at)?;
    let share = (at - pair[0][0]) / (pair[1][0] - pair[0][0]);
    Some(pair[0][1] + share * (pair[1][1] - pair[0][1]))
}

fn within(got: f32, expected: f32, share: f32, what: &str) {
    assert!((got / expected - 1.0).abs() < share, "{what}: {got}, closed form {expected}");
}

#[test]
fn a_straight_kick_slides_rolls_and_stops_by_the_closed_form() {
    for ball in BallModel::PRESETS {
        for kick in [2.0, 4.0, 6.5] {
            let expected = closed_form(&ball, kick);
            let seconds = expected.slide_time + kick / ball.rolling_deceleration;
            let track = track(&endless(&ball), kick, 0.0, seconds);
            let what = |part: &str| format!("{} at {kick} m/s, {part}", ball.name);
            let rolls = track.iter().position(|[_, speed, rim]| (speed - rim).abs() < 1e-3);
            let rolls = rolls.expect("it comes to roll");
            // Steps are 25 ms: the slide ended in the step before.
            let latest = (rolls + 1) as f32 * 0.025;
            assert!((-0.001..0.03).contains(&(latest - expected.slide_time)), "{}", what("slide"));
            let slid = track[rolls][0] - (latest - expected.slide_time) * track[rolls][1];
            within(slid, expected.slide_way, 0.03, &what("slide way"));
            for (way, expected) in [(3.0, expected.at_3), (6.0, expected.at_6)] {
                match (speed_at(&track, way), expected) {
                    (Some(got), Some(expected)) => {
                        within(got, expected, 0.03, &what(&format!("speed at {way} m")));
                    }
                    (got, expected) => assert_eq!(got, expected, "{}", what("it never gets there")),
                }
            }
            let [way, speed, _] = track[track.len() - 1];
            assert_eq!(speed, 0.0, "{}", what("it stops"));
            within(way, expected.stop, 0.03, &what("stop"));
        }
    }
}

#[test]
fn a_kick_rolls_equally_far_in_every_direction() {
    for ball in BallModel::PRESETS {
        let ends = [0.0, 30.0, 45.0, 90.0, 200.0]
            .map(|degrees| track(&endless(&ball), 4.0, degrees, 2.0)[79]);
        for [way, speed, _] in ends {
            within(way, ends[0][0], 0.01, &ball.name);
            within(speed, ends[0][1], 0.01, &ball.name);
        }
    }
}

#[test]
fn the_path_of_the_ball_does_not_depend_on_the_tick() {
    for ball in BallModel::PRESETS {
        let ends = [0.001, 0.0025, 0.005].map(|tick| {
            let config = SimConfig { tick, ..endless(&ball) };
            track(&config, 4.0, 0.0, 2.0)[79]
        });
        for [way, speed, _] in ends {
            within(way, ends[0][0], 0.01, &ball.name);
            within(speed, ends[0][1], 0.01, &ball.name);
        }
    }
}

#[test]
fn a_grazing_contact_does_not_depend_on_the_tick() {
    let scenes = [0.001, 0.0025, 0.005].map(|tick| {
        let mut scene = lone_ball(scenes::ssl(0, 0), [-2.0, 2.8], [4.0, 1.2]);
        scene.config.tick = tick;
        scene
    });
    let (v_x, v_y) = (ball_column("v_x"), ball_column("v_y"));
    let ends = scenes.each_ref().map(|scene| scene.after(40));
    for (scene, end) in scenes.iter().zip(&ends) {
        assert!(scene.after(20)[v_y] < -0.05, "it grazed the wall");
        within(end[0] + 2.0, ends[0][0] + 2.0, 0.01, "way");
        within(end[v_x], ends[0][v_x], 0.01, "speed");
        assert!((end[1] - ends[0][1]).abs() < 0.01, "aside: {} and {}", end[1], ends[0][1]);
    }
}

#[test]
fn a_ball_that_rolls_already_does_not_slide() {
    let mut scene: Scene = rolling_ball(1.0);
    let radius = scene.config.ball.radius;
    scene.set_ball_column("spin_y", 1.0 / radius);
    let row = scene.after(20);
    let expected = 1.0 - 0.5 * scene.config.ball.rolling_deceleration;
    within(row[ball_column("v_x")], expected, 1e-3, "speed");
}

#[test]
fn back_spin_brakes_the_ball_and_reverses_it() {
    let mut scene = lone_ball(scenes::ssl(0, 0), [0.0, 0.0], [1.0, 0.0]);
    scene.set_ball_column("spin_y", -4.0 / scene.config.ball.radius);
    let row = scene.after(4);
    within(row[ball_column("v_x")], 1.0 - 0.3, 1e-3, "braked by the full slide for 0.1 s");
    let row = scene.after(24);
    assert!(row[ball_column("v_x")] < -0.6, "and rolls back: {row:?}");
}
