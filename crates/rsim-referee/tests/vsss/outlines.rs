//! Whether bodies fit on the table: square robots, walls, corner blocks and goals.

use rsim_referee::sight::Robot;
use rsim_referee::{Lines, Vector};

use crate::pitches::{BALL_RADIUS, ROBOT_SIDE};
use crate::scene::Scene;

/// Fails unless ball and robots are on the table and touch nothing.
pub(crate) fn assert_valid(scene: &Scene) {
    let (robots, ball) = (scene.robots(), scene.ball_position());
    let lines = &scene.referee.pitch().lines;
    for (nth, robot) in robots.iter().enumerate() {
        let length = robot.heading.length();
        assert!((length - 1.0).abs() < 1e-5, "a heading of length {length}: {robot:?}");
        assert!(is_on_the_table(lines, robot), "in a wall: {robot:?}");
        let distance = distance_to(robot, ball);
        assert!(distance > BALL_RADIUS, "at the ball: {robot:?}, {ball:?}");
        for other in &robots[nth + 1..] {
            assert!(!overlap(robot, other), "one in another: {robot:?} and {other:?}");
        }
    }
    assert!(ball.x.abs() < lines.half_length && ball.y.abs() < lines.half_width, "{ball:?}");
}

/// A vector that was turned left by a right angle.
const fn left_of(vector: Vector) -> Vector {
    Vector::new(-vector.y, vector.x)
}

fn corners(robot: &Robot) -> [Vector; 4] {
    let ahead = robot.heading * (ROBOT_SIDE / 2.0);
    let [ahead, left] = [ahead, left_of(ahead)];
    [ahead + left, ahead - left, left - ahead, Vector::default() - ahead - left]
        .map(|corner| robot.position + corner)
}

fn is_on_the_table(lines: &Lines, robot: &Robot) -> bool {
    let (length, width) = (lines.half_length, lines.half_width);
    let is_inside = |corner: &Vector| {
        let (x, y) = (corner.x.abs(), corner.y.abs());
        let is_on_the_field = x < length && y < width && x + y < length + width - lines.corner_leg;
        // The smaller goal is 0.1 m deep.
        is_on_the_field || x < length + 0.1 && y < lines.half_goal_width
    };
    let posts = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(end, side)| Vector::new(end * length, side * lines.half_goal_width));
    corners(robot).iter().all(is_inside) && posts.iter().all(|post| distance_to(robot, *post) > 0.0)
}

/// Distance between a robot's outline and a place outside it; 0 inside.
fn distance_to(robot: &Robot, place: Vector) -> f32 {
    let offset = place - robot.position;
    let beyond = [robot.heading, left_of(robot.heading)]
        .map(|axis| (offset.dot(axis).abs() - ROBOT_SIDE / 2.0).max(0.0));
    beyond[0].hypot(beyond[1])
}

/// Whether two squares overlap: no side of either separates them.
fn overlap(a: &Robot, b: &Robot) -> bool {
    let axes = [a, b].map(|robot| [robot.heading, left_of(robot.heading)]);
    axes.as_flattened().iter().all(|axis| {
        let [a, b] = [a, b].map(|robot| corners(robot).map(|corner| corner.dot(*axis)));
        let least = |values: [f32; 4]| values.into_iter().fold(f32::INFINITY, f32::min);
        let most = |values: [f32; 4]| values.into_iter().fold(f32::NEG_INFINITY, f32::max);
        least(a) <= most(b) && least(b) <= most(a)
    })
}

#[test]
fn squares_overlap_where_their_sides_say_so() {
    let at = |x: f32, y: f32, heading: Vector| Robot {
        heading,
        ..Robot::at_rest(0, rsim_referee::Team::Blue, Vector::new(x, y))
    };
    let (straight, turned) = (Vector::new(1.0, 0.0), Vector::new(0.6, 0.8));
    let robot = at(0.0, 0.0, straight);
    assert!(overlap(&robot, &at(0.074, 0.074, straight)));
    assert!(!overlap(&robot, &at(0.076, 0.0, straight)));
    // A side of 0.075 m turned by 53.13 degrees reaches 0.0375 (0.6 + 0.8) m to each side.
    assert!(overlap(&robot, &at(0.0375 * 2.4 - 0.001, 0.0, turned)));
    assert!(!overlap(&robot, &at(0.0375 * 2.4 + 0.001, 0.0, turned)));
    assert!((distance_to(&robot, Vector::new(0.0675, 0.0775)) - 0.05).abs() < 1e-6);
}
