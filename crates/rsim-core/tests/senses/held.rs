//! The tracked ball in a robot's mouth, whose break beam tells that it is there.

use rsim_core::scenes::{self, Scene};
use rsim_core::{Batch, Sensing};

use super::{Played, begin, moments};

/// A robot 2 m beside the cameras' middle, which faces away from it and drives with the ball.
fn carried(command: &[f32]) -> Scene {
    let mut scene = scenes::ball_in_mouth(command);
    let touching = scene.config.blue[0].front_distance() + scene.config.ball.radius;
    scene.set_robot_column(0, "x", 2.0);
    scene.set_ball([2.0 + touching, 0.0], [0.0, 0.0]);
    scene
}

const AWAY: [f32; 6] = [0.6, 0.0, 0.0, 0.0, 0.0, 1.0];

/// Largest distance of the sensed ball from the true one in all matches and steps, m.
fn error(played: &Played) -> f32 {
    let (x, y) = (played.column(None, "x"), played.column(None, "y"));
    let both = x.iter().flatten().zip(y.iter().flatten());
    both.map(|(x, y)| (x[1] - x[0]).hypot(y[1] - y[0])).fold(0.0, f32::max)
}

#[test]
fn a_carried_ball_that_the_robot_hides_moves_with_it() {
    let sensing = Sensing { camera_height: 4.0, visible_part: 0.8, tracker: 1.0, ..Sensing::OFF };
    let scene = carried(&AWAY);
    let blind = Sensing { beam_misses: 1.0, ..sensing.clone() };
    let (known, unknown) = (Played::new(&scene, sensing, 3, 40), Played::new(&scene, blind, 3, 40));
    let held = known.column(Some(0), "infrared");
    assert!(held.iter().flatten().all(|[truth, known]| *truth > 0.0 && *known > 0.0));
    let end = known.column(None, "x").last().expect("40 steps")[0][0];
    assert!(end > 2.4, "the robot carries it to {end} m");
    assert!(error(&known) < 0.01, "{}", error(&known));
    assert!(error(&unknown) > 0.2, "without the beam it is lost: {}", error(&unknown));
}

#[test]
fn a_held_ball_has_the_velocity_of_its_mouth() {
    let scene = carried(&AWAY);
    let sensing = Sensing { delay: 0.0, missing_balls: 0.0, visible_part: 0.0, ..Sensing::RC2021 };
    // Velocity of the ball relative to its robot, which is 0, by the time both move steadily.
    let noise = |sensing: Sensing| {
        let played = Played::new(&scene, sensing, 100, 60);
        let (ball, robot) = (played.column(None, "v_x"), played.column(Some(0), "v_x"));
        let late = ball[30..].iter().flatten().zip(robot[30..].iter().flatten());
        moments(late.map(|(ball, robot)| ball[1] - robot[1])).1
    };
    let (held, loose) = (noise(sensing.clone()), noise(Sensing { beam_misses: 1.0, ..sensing }));
    assert!(held < 0.5 * loose, "{held} and {loose} m/s");
}

#[test]
fn a_ball_elsewhere_is_none_that_a_false_alarm_holds() {
    let mut scene = carried(&[0.0; 6]);
    scene.set_ball([1.0, 1.0], [1.0, 0.0]);
    let alarms = Sensing { beam_false_alarms: 1.0, tracker: 1.0, ..Sensing::OFF };
    let played = Played::new(&scene, alarms, 2, 40);
    let cut = played.column(Some(0), "infrared");
    assert!(cut.iter().flatten().all(|[truth, known]| *truth == 0.0 && *known > 0.0));
    assert!(error(&played) < 0.01, "{}", error(&played));
}

/// Errors of the sensed ball in each step of a scene whose robot kicks in the sixth, m.
fn kicked(sensing: Sensing) -> Vec<f32> {
    let scene = carried(&[0.0; 6]);
    let (mut batch, mut rows): (Batch, Vec<f32>) = begin(&scene, sensing, 1);
    let error = |step: u8| {
        let kick = if step == 5 { 4.0 } else { 0.0 };
        batch.step(&[0.0, 0.0, 0.0, kick, 0.0, 1.0], &mut rows, None).expect("finite");
        let mut known = vec![0.0; rows.len()];
        batch.sense(&mut known, None);
        (known[0] - rows[0]).hypot(known[1] - rows[1])
    };
    (0..30).map(error).collect()
}

#[test]
fn a_kicked_ball_is_free_also_where_the_beam_still_tells_of_one() {
    let sensing = Sensing { tracker: 1.0, frame_rate: 70.0, ..Sensing::OFF };
    let errors = kicked(sensing.clone());
    assert!(errors[..5].iter().all(|error| *error < 0.002), "{errors:?}");
    assert!(errors[8..].iter().all(|error| *error < 0.12), "by one frame: {errors:?}");
    let stuck = kicked(Sensing { beam_false_alarms: 1.0, ..sensing });
    assert!(stuck[8..].iter().all(|error| *error < 0.12), "{stuck:?}");
}
