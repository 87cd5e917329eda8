//! A robot pushes an opponent (SSL rules, "Pushing").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};
use crate::sight::Robot;
use crate::team::Team;
use crate::vector::Vector;

/// Gap of two robots that are in contact, m.
const CONTACT: f32 = 0.02;

/// Cosine of the angle, 0.7 rad, within which both robots move from the one to the other (Sumatra's
/// automatic referee).
const COS_ANGLE: f32 = 0.764_84;

/// Two opponents in contact travel in the direction from the one to the other. Of several pairs the one
/// nearest to the ball is followed.
pub fn pushing(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some([first, second]) = follow_contact(game, moment).filter(|_| game.is_running()) else {
        return;
    };
    let [start, other_start] = game.push_start;
    for (pusher, pushed, from, to) in
        [(&first, &second, start, other_start), (&second, &first, other_start, start)]
    {
        let direction = to - from;
        let limit = moment.config.push_distance;
        let travels = |way: Vector| {
            way.length() > limit
                && way.dot(direction) > COS_ANGLE * way.length() * direction.length()
        };
        if travels(pushed.position - to) && travels(pusher.position - from) {
            (game.pusher, game.pushed) = (None, None); // to be followed anew
            let place = moment.ball.position;
            let kind = EventKind::BotPushedBot;
            let ruling = Ruling::of_robot(kind, pusher.team, pusher.index, pusher.position).foul();
            let command = Command::DirectFree(pushed.team);
            rulings.add(ruling.stops(command, kick_place(moment, place)));
        }
    }
}

/// The two robots whose contact is followed; `None` if no opponents are in contact.
fn follow_contact(game: &mut Game, moment: &Moment) -> Option<[Robot; 2]> {
    let robot = |index: Option<usize>| index.and_then(|index| moment.now.robot(index));
    if let (Some(first), Some(second)) = (robot(game.pusher), robot(game.pushed)) {
        if in_contact(moment, &first, &second) {
            return Some([first, second]);
        }
    }
    let found = nearest_contact(moment);
    (game.pusher, game.pushed) = found.map(|[first, second]| (first.index, second.index)).unzip();
    if let Some([first, second]) = found {
        game.push_start = [first.position, second.position];
    }
    found
}

/// The opponents in contact that are nearest to the ball.
fn nearest_contact(moment: &Moment) -> Option<[Robot; 2]> {
    let touching = |team| moment.now.team(team).filter(|robot| robot.touched_opponent);
    let from_ball = |robot: &Robot| robot.position.distance(moment.ball.position);
    touching(Team::Blue)
        .flat_map(|blue| touching(Team::Yellow).map(move |yellow| [blue, yellow]))
        .filter(|[blue, yellow]| in_contact(moment, blue, yellow))
        .min_by(|a, b| {
            from_ball(&a[0])
                .min(from_ball(&a[1]))
                .total_cmp(&from_ball(&b[0]).min(from_ball(&b[1])))
        })
}

fn in_contact(moment: &Moment, first: &Robot, second: &Robot) -> bool {
    let gap = first.position.distance(second.position) - 2.0 * moment.pitch.robot_radius;
    first.touched_opponent && second.touched_opponent && gap < CONTACT
}
