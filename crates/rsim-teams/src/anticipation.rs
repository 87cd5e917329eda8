//! Places of the opponents once a pass has arrived: they move into the way of the shot that may follow.

use rsim_referee::Vector;

use crate::lanes::reach;
use crate::pitch::Area;
use crate::plane::Plane;
use crate::situation::{KEEPER, Situation};
use crate::view::Players;

/// The opponents, `time` (s) after a kick to a place, if they defend against a shot from there.
pub(crate) fn opponents(s: &Situation, from: Vector, time: f32) -> Players {
    let goal = s.pitch.their_goal();
    let out = (from - goal).unit_or(Vector::new(-1.0, 0.0));
    let reach = reach(s.tactics, time);
    let mut moved = s.view.others;
    for other in moved.iter_mut() {
        let wanted = if other.index == KEEPER {
            goal + out * (s.tactics.their_keeper_distance * s.pitch.lines.half_goal_width)
        } else {
            let along = (other.position - goal).dot(out).clamp(0.0, from.distance(goal));
            s.pitch.outside(Area::Theirs, goal + out * along, s.config.robot.radius)
        };
        other.position = other.position + (wanted - other.position).limited(reach);
        other.velocity = Vector::default();
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{PLAY, Scene};

    #[test]
    fn with_time_the_keeper_and_defenders_close_the_way_of_a_shot() {
        let mut scene = Scene::new(1, 2);
        scene.robot(1, [4.2, -0.4]);
        scene.robot(2, [2.0, -1.0]);
        let from = Vector::new(2.5, 1.5);
        let gaps = |time: f32| {
            scene.situation(PLAY, |s| {
                let moved = opponents(s, from, time);
                let goal = s.pitch.their_goal();
                [0, 1].map(|nth| moved[nth].position.distance_to_segment(goal, from))
            })
        };
        let [now, soon, late] = [0.0, 0.5, 3.0].map(gaps);
        for nth in 0..2 {
            assert!(now[nth] > soon[nth] && soon[nth] > late[nth], "{now:?} {soon:?} {late:?}");
            assert!(late[nth] < 0.02, "{late:?}");
        }
    }

    #[test]
    fn defenders_stay_out_of_their_area() {
        let mut scene = Scene::new(1, 2);
        scene.robot(1, [4.2, 0.0]);
        scene.robot(2, [4.0, 1.3]);
        scene.situation(PLAY, |s| {
            let moved = opponents(s, Vector::new(2.5, 0.0), 5.0);
            assert!(s.pitch.distance_to(Area::Theirs, moved[1].position) > 0.08, "{moved:?}");
        });
    }
}
