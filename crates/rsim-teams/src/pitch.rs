//! The field as a team sees it: its own goal is at -x, the opponents' at +x.

use rsim_referee::{Lines, Team, Vector};

use crate::plane::Plane;

/// An area in front of a goal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Area {
    /// In front of the own goal.
    Own,
    /// In front of the opponents' goal.
    Theirs,
}

impl Area {
    /// The team that has the area where blue's goal is at -x.
    const fn defender(self) -> Team {
        match self {
            Self::Own => Team::Blue,
            Self::Theirs => Team::Yellow,
        }
    }

    /// Sign of x of the area.
    pub(crate) const fn side(self) -> f32 {
        self.defender().own_side()
    }
}

/// The field.
#[derive(Debug, Clone)]
pub(crate) struct Pitch {
    /// Its lines.
    pub(crate) lines: Lines,
}

impl Pitch {
    /// The middle of the own goal.
    pub(crate) fn own_goal(&self) -> Vector {
        self.lines.goal(Team::Blue)
    }

    /// The middle of the opponents' goal.
    pub(crate) fn their_goal(&self) -> Vector {
        self.lines.goal(Team::Yellow)
    }

    /// Distance of a place from an area; negative inside.
    pub(crate) fn distance_to(&self, area: Area, place: Vector) -> f32 {
        self.lines.distance_to_area(place, area.defender())
    }

    /// The nearest place that is at least `margin` away from an area, and in front of its goal line.
    pub(crate) fn outside(&self, area: Area, place: Vector, margin: f32) -> Vector {
        if self.distance_to(area, place) >= margin {
            return place;
        }
        let side = area.side();
        let front = self.lines.half_length - self.lines.area_depth - margin;
        let flank = self.lines.half_area_width + margin;
        let (ahead, aside) = (side * place.x - front, flank - place.y.abs());
        if ahead < aside || flank > self.lines.half_width - margin {
            Vector::new(side * front, place.y)
        } else {
            Vector::new(place.x, flank.copysign(place.y))
        }
    }

    /// Direction away from an area at a place.
    pub(crate) fn away_from(&self, area: Area, place: Vector) -> Vector {
        let side = area.side();
        let ahead = self.lines.half_length - self.lines.area_depth - side * place.x;
        let aside = place.y.abs() - self.lines.half_area_width;
        let toward_middle = Vector::new(-side, 0.0);
        let outward = Vector::new(0.0, 1.0_f32.copysign(place.y));
        match (ahead > 0.0, aside > 0.0) {
            (true, true) => (toward_middle * ahead + outward * aside).unit_or(toward_middle),
            (false, false) if aside > ahead => outward,
            (false, true) => outward,
            _ => toward_middle,
        }
    }

    /// The nearest place within the lines, at least `margin` from them; below 0 it may be beyond them.
    pub(crate) fn inside(&self, place: Vector, margin: f32) -> Vector {
        let (max_x, max_y) = (self.lines.half_length - margin, self.lines.half_width - margin);
        Vector::new(place.x.clamp(-max_x, max_x), place.y.clamp(-max_y, max_y))
    }

    /// The nearest place at least `margin` from the walls.
    pub(crate) fn within_walls(&self, place: Vector, margin: f32) -> Vector {
        let (max_x, max_y) = (self.lines.boundary_x - margin, self.lines.boundary_y - margin);
        Vector::new(place.x.clamp(-max_x, max_x), place.y.clamp(-max_y, max_y))
    }

    /// Place where the way from `from` to `to`, a place in the own area, enters the area extended by `margin`;
    /// `None` if it begins in there.
    pub(crate) fn entry(&self, from: Vector, to: Vector, margin: f32) -> Option<Vector> {
        if self.distance_to(Area::Own, from) <= margin {
            return None;
        }
        let front = -(self.lines.half_length - self.lines.area_depth - margin);
        let flank = self.lines.half_area_width + margin;
        let way = to - from;
        let share_x = if way.x.abs() > 1e-6 { (front - from.x) / way.x } else { -1.0 };
        let through_front = from + way * share_x;
        if (0.0..=1.0).contains(&share_x) && through_front.y.abs() <= flank {
            return Some(through_front);
        }
        let share_y =
            if way.y.abs() > 1e-6 { (flank.copysign(from.y) - from.y) / way.y } else { -1.0 };
        (0.0..=1.0).contains(&share_y).then_some(from + way * share_y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::pitch;

    #[test]
    fn places_in_an_area_move_to_its_nearest_border() {
        let pitch = pitch();
        let moved = pitch.outside(Area::Own, Vector::new(-3.6, 0.2), 0.1);
        assert_eq!(moved, Vector::new(-3.4, 0.2));
        let moved = pitch.outside(Area::Theirs, Vector::new(4.3, -0.9), 0.1);
        assert_eq!(moved, Vector::new(4.3, -1.1));
        let free = Vector::new(0.0, 0.0);
        assert_eq!(pitch.outside(Area::Own, free, 0.1), free);
    }

    #[test]
    fn directions_away_from_an_area_increase_the_distance() {
        let pitch = pitch();
        for (x, y) in [(-3.2, 0.1), (-4.0, 1.3), (-3.3, 1.2), (-3.6, 0.0), (-4.2, -0.9)] {
            let place = Vector::new(x, y);
            for area in [Area::Own, Area::Theirs] {
                let place = if area == Area::Own { place } else { place * -1.0 };
                let out = place + pitch.away_from(area, place) * 0.01;
                let gain = pitch.distance_to(area, out) - pitch.distance_to(area, place);
                assert!(gain > 0.0099, "{area:?} {place:?}: {gain}");
            }
        }
    }

    #[test]
    fn ways_to_the_goal_enter_the_area_at_its_border() {
        let pitch = pitch();
        for (x, y) in [(0.0, 0.0), (-4.0, 2.5), (-1.0, -2.9), (3.0, 1.0)] {
            let from = Vector::new(x, y);
            let entry = pitch.entry(from, pitch.own_goal(), 0.13).expect("from outside");
            assert!(pitch.distance_to(Area::Own, entry) < 0.19, "{entry:?}");
            assert!(pitch.distance_to(Area::Own, entry) > 0.129, "{entry:?}");
        }
        assert_eq!(pitch.entry(Vector::new(-4.0, 0.0), pitch.own_goal(), 0.1), None);
    }
}
