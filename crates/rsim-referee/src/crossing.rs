//! The line over which the ball left the field in a step.

use crate::moment::Moment;
use crate::team::Team;
use crate::vector::Vector;

/// Line that the ball crossed outward.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Line {
    /// Between the posts of the goal that the team defends, below the crossbar.
    Goal(Team),
    /// The rest of the goal line of that team, or above the goal.
    End(Team),
    /// A touch line.
    Touch,
}

/// The first line that the center of the ball was `beyond` m behind in the step, and where; `None` if it
/// stayed on the field, or was off it before.
pub(crate) fn crossed(moment: &Moment, beyond: f32) -> Option<(Line, Vector)> {
    let lines = moment.lines();
    let (from, to) = (moment.ball_before, moment.ball);
    let (max_x, max_y) = (lines.half_length + beyond, lines.half_width + beyond);
    if lines.is_inside(to.position, beyond) || !lines.is_inside(from.position, beyond) {
        return None;
    }
    let over_end = share(from.position.x, to.position.x, max_x);
    let over_side = share(from.position.y, to.position.y, max_y);
    let at = |share: f32| from.position + (to.position - from.position) * share;
    if over_side < over_end {
        return Some((Line::Touch, at(over_side)));
    }
    let defender = if to.position.x < 0.0 { Team::Blue } else { Team::Yellow };
    let position = at(over_end);
    let height = from.height + (to.height - from.height) * over_end;
    let is_goal = position.y.abs() < lines.half_goal_width && height < lines.goal_height;
    let line = if is_goal { Line::Goal(defender) } else { Line::End(defender) };
    Some((line, position))
}

/// Share of a motion before it passes `limit` outward; infinite if it does not.
fn share(from: f32, to: f32, limit: f32) -> f32 {
    if to.abs() <= limit {
        return f32::INFINITY;
    }
    (limit.copysign(to) - from) / (to - from)
}
