//! Place where the ball will be: it slides, then rolls to rest.

use rsim_referee::Vector;

use crate::config::BallNumbers;
use crate::plane::Plane;
use crate::view::Ball;

/// Moments for which the path of the ball is known.
pub(crate) const MOMENTS: usize = 25;
/// Time between them, s.
pub(crate) const INTERVAL: f32 = 0.1;
/// Gravity, m/s².
const GRAVITY: f32 = 9.81;
/// Part of the speed over the floor that a ball keeps when it comes down.
const LANDING: f32 = 0.7;

/// Path of a ball that nobody touches.
#[derive(Debug, Clone)]
pub(crate) struct BallPath {
    /// Places at the moments, m.
    pub(crate) places: [Vector; MOMENTS],
    /// Direction, a unit vector; that of x for a ball at rest.
    pub(crate) direction: Vector,
    /// Place where it comes to rest, m.
    pub(crate) rest: Vector,
    /// Speed now, m/s.
    pub(crate) speed: f32,
    /// Time until a flying ball has come down, s.
    pub(crate) flight: f32,
}

impl BallPath {
    /// Path of the ball, which was kicked with `kick_speed` (m/s).
    pub(crate) fn new(ball: &Ball, kick_speed: f32, numbers: &BallNumbers) -> Self {
        let speed = ball.velocity.length();
        let direction = ball.velocity.unit_or(Vector::new(1.0, 0.0));
        let up = ball.vertical_velocity;
        let flight = if ball.height > 0.02 {
            (up + (up * up + 2.0 * GRAVITY * ball.height).sqrt()) / GRAVITY
        } else {
            0.0
        };
        let (flown, landed) =
            if flight > 0.0 { (speed * flight, speed * LANDING) } else { (0.0, speed) };
        let rolls_from =
            if flight > 0.0 { landed } else { kick_speed * numbers.slide_to_roll_ratio };
        let roll = Roll { speed: landed, rolls_from, numbers };
        let places = std::array::from_fn(|nth| {
            let time = nth as f32 * INTERVAL;
            let way = if time < flight { speed * time } else { flown + roll.way(time - flight) };
            ball.position + direction * way
        });
        let rest = ball.position + direction * (flown + roll.way(f32::INFINITY));
        Self { places, direction, rest, speed, flight }
    }
}

/// Motion of a ball on the floor.
struct Roll<'a> {
    speed: f32,
    /// Speed at which it stops sliding.
    rolls_from: f32,
    numbers: &'a BallNumbers,
}

impl Roll<'_> {
    /// Way in a time, m.
    fn way(&self, time: f32) -> f32 {
        let (slows, rolls) = (self.numbers.sliding_deceleration, self.numbers.rolling_deceleration);
        let slides_for = ((self.speed - self.rolls_from) / slows).max(0.0);
        let sliding = slides_for.min(time);
        let slid = (self.speed - 0.5 * slows * sliding) * sliding;
        let speed = self.speed - slows * sliding;
        let rolling = (time - sliding).min(speed / rolls);
        slid + (speed - 0.5 * rolls * rolling) * rolling
    }
}

/// Speed of a kick along the floor that arrives at a distance with a speed, m/s.
pub(crate) fn kick_speed(distance: f32, arrival: f32, numbers: &BallNumbers) -> f32 {
    // k: kick. It slides from k to r k on (k² - r² k²) / 2 s, then rolls to the arrival on the rest.
    let (slows, rolls) = (numbers.sliding_deceleration, numbers.rolling_deceleration);
    let ratio = numbers.slide_to_roll_ratio * numbers.slide_to_roll_ratio;
    let square = arrival * arrival + 2.0 * rolls * distance;
    (square / (ratio + rolls * (1.0 - ratio) / slows)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::config;

    #[test]
    fn a_kick_arrives_with_the_speed_that_it_was_made_for() {
        let numbers = config().ball;
        let kick = kick_speed(3.0, 1.5, &numbers);
        let ball = Ball { velocity: Vector::new(kick, 0.0), ..Ball::default() };
        let path = BallPath::new(&ball, kick, &numbers);
        let after = path.places.iter().position(|place| place.x > 3.0).expect("it passes");
        let speed = (path.places[after].x - path.places[after - 1].x) / INTERVAL;
        assert!((speed - 1.5).abs() < 0.06, "{speed}");
        assert!(path.rest.x > 6.0);
    }

    #[test]
    fn a_ball_at_rest_stays() {
        let ball = Ball { position: Vector::new(1.0, 2.0), ..Ball::default() };
        let path = BallPath::new(&ball, 0.0, &config().ball);
        assert!(path.places.iter().all(|place| *place == ball.position));
        assert_eq!(path.rest, ball.position);
    }

    #[test]
    fn a_flying_ball_slows_when_it_has_come_down() {
        let ball = Ball {
            velocity: Vector::new(3.0, 0.0),
            height: 0.1,
            vertical_velocity: 2.0,
            ..Ball::default()
        };
        let path = BallPath::new(&ball, 5.0, &config().ball);
        assert!((path.flight - 0.45).abs() < 0.02, "{}", path.flight);
        let steps: Vec<f32> = path.places.windows(2).map(|pair| pair[1].x - pair[0].x).collect();
        assert!((steps[0] - 0.3).abs() < 1e-4 && steps[10] < 0.22, "{steps:?}");
    }
}
