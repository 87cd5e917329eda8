//! Episodes of the self-play tasks: they begin at random places and end with a goal or after some time.

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use rsim_core::streams::{unit, words};
use rsim_core::{Field, SimConfig};
use rsim_referee::codes::{Command, Stage};
use rsim_referee::game::Game;
use rsim_referee::{Team, Vector};

/// Longest episode, s.
pub(crate) const EPISODE_SECONDS: f32 = 30.0;
/// Time after which a ball that is stuck ends an episode of VSSS, s: there the task has a free ball.
pub(crate) const STUCK_SECONDS: f32 = 10.0;
/// Distance from the line of a ball that is repositioned, m (SSL rules, "Ball Placement").
const INSIDE: f32 = 0.2;
/// Places along the line that are tried for it, and their distance, m.
const TRIED: usize = 40;
const APART: f32 = 0.05;
/// Room between the bodies and the lines at the start, m.
const ROOM: f32 = 0.1;

/// Puts ball and robots of a row at rest to random places, which may overlap, with random headings.
pub(crate) fn scatter(config: &SimConfig, key: u64, row: &mut [f32]) {
    let field = &config.field;
    let keys = [key];
    let mut drawn = words(&keys, 2 + 3 * config.n_robots()).map(unit);
    let mut within = |half: f32| (2.0 * drawn.next().unwrap_or(0.5) - 1.0) * half;
    let (along, across) = (field.half_length() - ROOM, field.half_width() - ROOM);
    let (ball, robots) = row.split_at_mut(BALL_COLUMNS.len());
    (ball[0], ball[1]) = (within(along), within(across));
    for robot in robots.chunks_exact_mut(ROBOT_COLUMNS.len()) {
        (robot[0], robot[1]) = (within(along), within(across));
        (robot[3], robot[2]) = within(std::f32::consts::PI).sin_cos();
    }
}

/// The game at the start of an episode: the ball is free for both teams, the score stays.
pub(crate) fn begun(game: &Game, time_step: f32) -> Game {
    let mut next = Game::new(Team::Blue);
    next.score = game.score;
    next.stage = Stage::FirstHalf;
    #[allow(clippy::cast_possible_truncation)] // some thousand steps
    let steps = (EPISODE_SECONDS / time_step).round() as i32;
    next.stage_steps_left = steps;
    next.give(Command::ForceStart, None);
    next.in_play = true;
    next
}

/// Whether an episode has ended: a goal stops play, and so do a ball that is stuck and the end of its time.
pub(crate) fn has_ended(game: &Game) -> bool {
    game.command != Command::ForceStart || game.stage != Stage::FirstHalf
}

/// Places for a ball that has left the field, the nearest one first; none for a ball within.
pub(crate) fn places_inside(field: &Field, ball: Vector, radius: f32) -> Vec<Vector> {
    let (along, across) = (field.half_length(), field.half_width());
    if field.touch_line_margin == 0.0
        || ball.x.abs() <= along + radius && ball.y.abs() <= across + radius
    {
        return Vec::new();
    }
    let clamped = |half: f32, at: f32| at.clamp(INSIDE - half, half - INSIDE);
    let is_over_goal_line = ball.x.abs() > along + radius;
    let place = |aside: f32| {
        let (x, y) = if is_over_goal_line { (0.0, aside) } else { (aside, 0.0) };
        Vector::new(clamped(along, ball.x + x), clamped(across, ball.y + y))
    };
    #[allow(clippy::cast_precision_loss)] // few places
    let asides = (0..TRIED).map(|nth| APART * nth as f32).flat_map(|aside| [aside, -aside]);
    asides.map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_beyond_a_line_has_places_inside_along_that_line() {
        let field = Field::preset("ssl_challenge").expect("a field");
        let (along, across) = (field.half_length(), field.half_width());
        assert!(places_inside(&field, Vector::new(0.3, 0.1), 0.02).is_empty());
        let out = places_inside(&field, Vector::new(0.5, across + 0.1), 0.02);
        assert!((out[0].x - 0.5).abs() < 1e-6 && (out[0].y - (across - INSIDE)).abs() < 1e-6);
        assert!(out.iter().all(|place| (place.y - out[0].y).abs() < 1e-6));
        let out = places_inside(&field, Vector::new(-along - 0.1, -0.7), 0.02);
        assert!((out[2].y + 0.65).abs() < 1e-6 && (out[2].x + along - INSIDE).abs() < 1e-6);
    }

    #[test]
    fn walls_keep_the_ball_in() {
        let field = Field::preset("vss_3v3").expect("a field");
        assert!(places_inside(&field, Vector::new(0.8, 0.0), 0.02).is_empty(), "it is in the goal");
    }

    #[test]
    fn bodies_are_scattered_over_the_field_by_the_key() {
        let config = SimConfig::vss(3, 3);
        let rows = [1, 1, 2].map(|key| {
            let mut row = vec![0.0; config.row_size()];
            scatter(&config, key, &mut row);
            row
        });
        assert!(rows[0] == rows[1] && rows[0] != rows[2]);
        for robot in rows[0][BALL_COLUMNS.len()..].chunks(ROBOT_COLUMNS.len()) {
            assert!(robot[0].abs() < 0.75 && robot[1].abs() < 0.65);
            assert!((robot[2].hypot(robot[3]) - 1.0).abs() < 1e-5);
        }
    }
}
