//! Lines of the field as the rules use them: areas, places of kicks, valid places of the ball.

use serde::{Deserialize, Serialize};

use crate::team::Team;
use crate::vector::Vector;

/// Dimensions of a field that the rules need, m. Distances are to the middle of lines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Lines {
    /// Half the distance between the goal lines.
    pub half_length: f32,
    /// Half the distance between the touch lines.
    pub half_width: f32,
    /// Half the width of a goal.
    pub half_goal_width: f32,
    /// Height of a goal, below its crossbar.
    pub goal_height: f32,
    /// Depth of the area in front of a goal.
    pub area_depth: f32,
    /// Half the width of the area in front of a goal.
    pub half_area_width: f32,
    /// Depth of the smaller area in it, 0 without one.
    pub inner_area_depth: f32,
    /// Half the width of the smaller area in it, 0 without one.
    pub half_inner_area_width: f32,
    /// Width of the painted lines; they belong to the areas that they bound.
    pub line_width: f32,
    /// Leg of the 45-degree block in each corner; 0 for none.
    pub corner_leg: f32,
    /// Thickness of a goal's own walls; 0 without them.
    pub goal_wall_thickness: f32,
    /// Radius of the center circle.
    pub center_circle_radius: f32,
    /// Distance of a penalty mark from the goal line that it attacks.
    pub penalty_mark_distance: f32,
    /// Distance of the outer walls from the center along x; the goal line's where goals are pockets in a wall.
    pub boundary_x: f32,
    /// Distance of the outer walls from the center along y.
    pub boundary_y: f32,
    /// Distance of the free-ball marks from the center along x; 0 without marks.
    pub free_ball_x: f32,
    /// Distance of the free-ball marks from the center along y; 0 without marks.
    pub free_ball_y: f32,
}

impl Lines {
    /// The middle of the goal that a team defends.
    pub fn goal(&self, defender: Team) -> Vector {
        Vector::new(defender.own_side() * self.half_length, 0.0)
    }

    /// Whether a place lies within the lines of the field, or at most `margin` beyond them.
    pub fn is_inside(&self, place: Vector, margin: f32) -> bool {
        place.x.abs() <= self.half_length + margin && place.y.abs() <= self.half_width + margin
    }

    /// Distance of a place from the area in front of the goal that `defender` defends; negative inside, by
    /// the distance to its nearest line inside the field. The area goes on behind the goal line.
    pub fn distance_to_area(&self, place: Vector, defender: Team) -> f32 {
        let ahead = self.half_length - defender.own_side() * place.x - self.area_depth;
        let aside = place.y.abs() - self.half_area_width;
        if ahead <= 0.0 || aside <= 0.0 {
            ahead.max(aside)
        } else {
            Vector::new(ahead, aside).length()
        }
    }

    /// Whether a place lies in the smaller area in front of the goal that `defender` defends; its lines do
    /// not belong to it. The area goes on behind the goal line.
    pub fn is_in_inner_area(&self, place: Vector, defender: Team) -> bool {
        self.half_length - defender.own_side() * place.x < self.inner_area_depth
            && place.y.abs() < self.half_inner_area_width
    }

    /// Mark of the penalty kick of a team.
    pub fn penalty_mark(&self, attacker: Team) -> Vector {
        let goal = self.goal(attacker.opponent());
        Vector::new(goal.x - goal.x.signum() * self.penalty_mark_distance, 0.0)
    }

    /// The free-ball mark of the quarter that a place is in; the middle lines belong to -x and -y.
    pub fn free_ball_mark(&self, place: Vector) -> Vector {
        let side = |coordinate: f32| if coordinate > 0.0 { 1.0 } else { -1.0 };
        Vector::new(side(place.x) * self.free_ball_x, side(place.y) * self.free_ball_y)
    }

    /// The valid place nearest to `place` for a ball that is kicked: at least `from_lines` inside the lines
    /// of the field and at least `from_areas` from both areas.
    pub fn nearest_kick_place(&self, place: Vector, from_lines: f32, from_areas: f32) -> Vector {
        let [max_x, max_y] =
            [self.half_length, self.half_width].map(|half| (half - from_lines).max(0.0));
        let inside = Vector::new(place.x.clamp(-max_x, max_x), place.y.clamp(-max_y, max_y));
        let defender = if inside.x < 0.0 { Team::Blue } else { Team::Yellow };
        if self.distance_to_area(inside, defender) >= from_areas {
            return inside;
        }
        let side = defender.own_side();
        // The places at exactly that distance: a line ahead of the area, one beside it, and an arc.
        let front = self.half_length - self.area_depth;
        let corner = Vector::new(side * front, self.half_area_width.copysign(inside.y));
        let ahead = Vector::new(
            side * (front - from_areas),
            inside.y.clamp(-self.half_area_width, self.half_area_width),
        );
        let aside = Vector::new(
            side * (side * inside.x).max(front),
            (self.half_area_width + from_areas).copysign(inside.y),
        );
        let from_corner = inside - corner;
        let length = from_corner.length();
        let arc = corner + from_corner * (if length > 0.0 { from_areas / length } else { 0.0 });
        let is_valid = |candidate: &Vector| {
            self.is_inside(*candidate, 1e-4 - from_lines)
                && self.distance_to_area(*candidate, defender) >= from_areas - 1e-4
        };
        [ahead, aside, arc]
            .into_iter()
            .filter(is_valid)
            .min_by(|a, b| inside.distance(*a).total_cmp(&inside.distance(*b)))
            .unwrap_or(ahead)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A field of SSL division B.
    pub(crate) const SSL_B: Lines = Lines {
        half_length: 4.5,
        half_width: 3.0,
        half_goal_width: 0.5,
        goal_height: 0.16,
        area_depth: 1.0,
        half_area_width: 1.0,
        inner_area_depth: 0.0,
        half_inner_area_width: 0.0,
        line_width: 0.01,
        corner_leg: 0.0,
        goal_wall_thickness: 0.02,
        center_circle_radius: 0.5,
        penalty_mark_distance: 6.0,
        boundary_x: 4.8,
        boundary_y: 3.3,
        free_ball_x: 0.0,
        free_ball_y: 0.0,
    };

    #[test]
    fn distances_to_an_area_are_negative_inside() {
        for (x, y, expected) in [
            (-4.0, 0.0, -0.5),
            (-3.0, 0.0, 0.5),
            (-4.2, -1.3, 0.3),
            (-3.1, 1.4, 0.4_f32.hypot(0.4)),
            (-4.9, 0.2, -0.8),
        ] {
            let distance = SSL_B.distance_to_area(Vector::new(x, y), Team::Blue);
            assert!((distance - expected).abs() < 1e-5, "{x} {y}: {distance}");
        }
    }

    #[test]
    fn lines_do_not_belong_to_the_inner_area() {
        let lines = Lines { inner_area_depth: 0.5, half_inner_area_width: 0.75, ..SSL_B };
        for (x, y, expected) in [
            (4.25, 0.5, true),
            (4.75, 0.5, true),
            (4.0, 0.5, false),
            (4.25, 0.75, false),
            (4.25, -0.75, false),
            (3.75, 0.0, false),
        ] {
            assert_eq!(
                lines.is_in_inner_area(Vector::new(x, y), Team::Yellow),
                expected,
                "{x} {y}"
            );
            assert_eq!(lines.is_in_inner_area(Vector::new(-x, y), Team::Blue), expected, "{x} {y}");
            assert!(!lines.is_in_inner_area(Vector::new(x, y), Team::Blue));
        }
    }

    #[test]
    fn each_team_has_its_own_goal_and_mark() {
        assert_eq!(SSL_B.goal(Team::Blue), Vector::new(-4.5, 0.0));
        assert_eq!(SSL_B.penalty_mark(Team::Blue), Vector::new(-1.5, 0.0));
        assert_eq!(SSL_B.penalty_mark(Team::Yellow), Vector::new(1.5, 0.0));
    }

    /// The nearest valid place of a fine grid: slow, and the definition.
    fn by_grid(place: Vector, from_lines: f32, from_areas: f32) -> f32 {
        let is_valid = |at: Vector| {
            SSL_B.is_inside(at, -from_lines)
                && Team::BOTH.iter().all(|team| SSL_B.distance_to_area(at, *team) >= from_areas)
        };
        (-450_i16..=450)
            .flat_map(|x| (-300_i16..=300).map(move |y| (x, y)))
            .map(|(x, y)| Vector::new(f32::from(x) / 100.0, f32::from(y) / 100.0))
            .filter(|at| is_valid(*at))
            .map(|at| at.distance(place))
            .fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn the_place_of_a_kick_is_the_nearest_valid_one() {
        for (x, y) in [
            (0.0, 0.0),
            (4.6, 3.2),
            (4.45, 0.3),
            (-4.0, -0.9),
            (3.0, 1.2),
            (-2.9, -1.9),
            (3.5, 2.1),
            (-4.5, 1.95),
            (3.5, 1.0),
        ] {
            let place = Vector::new(x, y);
            let found = SSL_B.nearest_kick_place(place, 0.2, 1.0);
            assert!(SSL_B.is_inside(found, -0.1999), "{place:?}: {found:?}");
            for team in Team::BOTH {
                assert!(SSL_B.distance_to_area(found, team) > 0.999, "{place:?}: {found:?}");
            }
            let excess = found.distance(place) - by_grid(place, 0.2, 1.0);
            assert!(excess < 0.011, "{place:?}: {found:?} is {excess} too far");
        }
    }
}
