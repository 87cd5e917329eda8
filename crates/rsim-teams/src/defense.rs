//! Defenders: a wall before the own area, and marks of dangerous opponents.

use rsim_referee::Vector;

use crate::jobs::{Job, Jobs};
use crate::plane::Plane;
use crate::rolling::INTERVAL;
use crate::situation::Situation;
use crate::view::Player;

/// Distance between centers in the wall, m.
const SPACING: f32 = 0.2;
/// Number by which marks are numbered among the jobs.
const MARK_NUMBER: i32 = 10;

/// Adds the places of a wall of `count` robots.
pub(crate) fn add_wall(s: &Situation, count: usize, jobs: &mut Jobs) {
    let ball = s.path.places[1].x.max(s.pitch.own_goal().x + 0.05);
    let ball = Vector::new(ball, s.path.places[1].y);
    let goal = s.pitch.own_goal();
    let margin = s.config.robot.radius + s.tactics.wall_room;
    let half = s.pitch.lines.half_goal_width;
    let Some(middle) = s.pitch.entry(ball, goal, margin) else {
        add_beside(s, ball, margin, count, jobs);
        return;
    };
    if count == 1 {
        jobs.add(Job::at(0, middle));
        return;
    }
    let aside = (goal - ball).unit_or(Vector::new(-1.0, 0.0)).left();
    for (number, side) in [(0, 1.0), (1, -1.0)] {
        // The goal's left, as seen from the ball, is at -y.
        let cover = goal - Vector::new(0.0, side * s.tactics.wall_cover * half);
        let place = s.pitch.entry(ball, cover, margin).unwrap_or(middle);
        let least = middle + aside * (side * 0.5 * SPACING);
        let is_apart = (place - middle).dot(aside) * side > 0.5 * SPACING;
        jobs.add(Job::at(number, if is_apart { place } else { least }));
    }
}

/// Adds places at the border of the area beside a ball in it.
fn add_beside(s: &Situation, ball: Vector, margin: f32, count: usize, jobs: &mut Jobs) {
    let front = -(s.pitch.lines.half_length - s.pitch.lines.area_depth - margin);
    let flank = s.pitch.lines.half_area_width;
    for (number, side) in [(0, 1.0), (1, -1.0)].into_iter().take(count) {
        let y = (ball.y + side * SPACING).clamp(-flank, flank);
        jobs.add(Job::at(number, Vector::new(front, y)));
    }
}

/// Adds marks of the most dangerous opponents, at most `count`. Returns their number.
pub(crate) fn add_marks(s: &Situation, count: usize, jobs: &mut Jobs) -> usize {
    let goal = s.pitch.own_goal();
    let at_ball = s.rival().map(|(index, _)| index);
    let reach = 2.0 * s.pitch.lines.half_length * s.tactics.marked_share;
    let mut added = 0;
    let mut marked = 0_u32;
    while added < count {
        let free = s.view.others.iter().filter(|other| {
            Some(other.index) != at_ball
                && marked >> other.index & 1 == 0
                && other.position.distance(goal) < reach
                && s.pitch.distance_to(crate::pitch::Area::Theirs, other.position) > 0.0
        });
        let danger = |other: &Player| other.position.distance(goal);
        let Some(other) = free.min_by(|a, b| danger(a).total_cmp(&danger(b))) else { break };
        marked |= 1 << other.index;
        let place = other.position + other.velocity * (2.0 * INTERVAL);
        let to_goal = (goal - place).unit_or(Vector::new(-1.0, 0.0));
        let to_ball = (s.ball() - place).unit_or(to_goal);
        let direction = (to_goal + to_ball * s.tactics.mark_toward_ball).unit_or(to_goal);
        let number = MARK_NUMBER + i32::try_from(other.index).unwrap_or(0);
        jobs.add(Job::at(number, place + direction * s.tactics.mark_distance));
        added += 1;
    }
    added
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pitch::Area;
    use crate::testing::{PLAY, Scene};

    fn places(scene: &Scene, add: impl Fn(&Situation, &mut Jobs)) -> Vec<Vector> {
        scene.situation(PLAY, |s| {
            let mut jobs = Jobs::default();
            add(s, &mut jobs);
            let places: Vec<Vector> = jobs.iter().filter_map(|job| job.place).collect();
            for place in &places {
                let distance = s.pitch.distance_to(Area::Own, *place);
                assert!(distance > 0.09, "{place:?} is in the own area");
            }
            places
        })
    }

    #[test]
    fn a_wall_stands_before_the_area_on_the_way_of_a_shot() {
        let mut scene = Scene::new(3, 1);
        for ball in [[-1.0, 0.5], [-3.0, 2.5], [-4.0, 0.3], [-4.3, 1.6]] {
            scene.ball(ball, [0.0, 0.0]);
            let wall = places(&scene, |s, jobs| add_wall(s, 2, jobs));
            assert_eq!(wall.len(), 2);
            assert!(wall[0].distance(wall[1]) > 0.18, "{ball:?}: {wall:?}");
        }
        scene.ball([-1.0, 0.5], [0.0, 0.0]);
        let one = places(&scene, |s, jobs| add_wall(s, 1, jobs))[0];
        let off = one.distance_to_segment(Vector::new(-1.0, 0.5), Vector::new(-4.5, 0.0));
        assert!(off < 0.01, "{one:?}");
    }

    #[test]
    fn opponents_near_the_goal_are_marked_on_its_side() {
        let mut scene = Scene::new(3, 3);
        scene.ball([2.0, 0.0], [0.0, 0.0]);
        scene.robot(3, [2.2, 0.0]);
        scene.robot(4, [-2.0, 1.5]);
        scene.robot(5, [0.0, -1.5]);
        let marks = places(&scene, |s, jobs| {
            add_marks(s, 2, jobs);
        });
        assert_eq!(marks.len(), 2);
        let [nearest, other] = [Vector::new(-2.0, 1.5), Vector::new(0.0, -1.5)];
        assert!(marks[0].distance(nearest) < 0.33 && marks[0].x < -1.9, "{marks:?}");
        assert!(marks[1].distance(other) < 0.33, "the one at the ball is not marked: {marks:?}");
    }
}
