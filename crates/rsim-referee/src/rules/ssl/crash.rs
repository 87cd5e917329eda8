//! Robots crash (SSL rules, "Crashing").

use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::repeats::Repeated;
use crate::rules::ssl::areas::commit;
use crate::ruling::{Ruling, Rulings};
use crate::sight::Robot;
use crate::team::Team;

/// Foul of the faster robot.
pub fn crash_unique(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    for (blue, yellow) in crashes(moment) {
        let speeds = [&blue, &yellow].map(|robot| speed_before(moment, robot));
        if (speeds[0] - speeds[1]).abs() < moment.config.crash_difference {
            continue;
        }
        let faster = if speeds[0] > speeds[1] { blue } else { yellow };
        if commit(Repeated::Crash, game, moment, faster.team) {
            let place = (blue.position + yellow.position) * 0.5;
            let kind = EventKind::BotCrashUnique;
            rulings.add(Ruling::of_robot(kind, faster.team, faster.index, place).foul());
        }
    }
}

/// Foul of both robots, if their speeds are about the same; of one, while the other team's last crash lasts.
pub fn crash_drawn(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    for (blue, yellow) in crashes(moment) {
        let difference = speed_before(moment, &blue) - speed_before(moment, &yellow);
        if difference.abs() >= moment.config.crash_difference {
            continue;
        }
        let at_fault = match Team::BOTH.map(|team| commit(Repeated::Crash, game, moment, team)) {
            [true, true] => None,
            [true, false] => Some(Team::Blue),
            [false, true] => Some(Team::Yellow),
            [false, false] => continue,
        };
        let place = (blue.position + yellow.position) * 0.5;
        rulings.add(Ruling::of_team(EventKind::BotCrashDrawn, at_fault, place).foul());
    }
}

/// Pairs of opponents that met in the step with more than the speed of a crash, blue first.
fn crashes<'a>(moment: &'a Moment) -> impl Iterator<Item = (Robot, Robot)> + 'a {
    let crashed =
        |robot: &Robot| robot.touched_opponent && robot.collision_speed > moment.config.crash_speed;
    moment.now.team(Team::Blue).filter(crashed).filter_map(move |blue| {
        let partners = moment.now.team(Team::Yellow).filter(crashed);
        let nearest = partners.min_by(|a, b| {
            let distance = |robot: &Robot| robot.position.distance(blue.position);
            distance(a).total_cmp(&distance(b))
        });
        nearest.map(|yellow| (blue, yellow))
    })
}

/// Speed of a robot before the contact, m/s.
fn speed_before(moment: &Moment, robot: &Robot) -> f32 {
    moment.before.robot(robot.index).map_or(0.0, |before| before.velocity.length())
}
