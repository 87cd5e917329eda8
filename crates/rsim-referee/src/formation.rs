//! Default positions of VSSS robots for each kick. Source: VSSSLeague/VSSReferee 2862742 (2022-03-12),
//! `src/world/entities/replacer/replacements.json` and `replacer.cpp`.

use crate::codes::Command;
use crate::game::Game;
use crate::moment::Moment;
use crate::positions::{clear_of_ball, command_of_positions};
use crate::sight::Robot;
use crate::team::Team;
use crate::vector::Vector;

/// Positions of a team in the half at +x, m: the keeper's, then the others'. A team in the other half has
/// them with the opposite x.
struct Table {
    /// Of the team that has the kick.
    kicking: &'static [(f32, f32)],
    /// Of the other team.
    receiving: &'static [(f32, f32)],
}

/// Distance along x between the ball of a free ball and the robots beside it, m, at three and five a side.
const BESIDE_FREE_BALL: [f32; 2] = [0.20, 0.25];

/// More than the rounding of a distance, m.
const ROUNDING: f32 = 1e-5;

const KICKOFF_3: Table = Table {
    kicking: &[(0.675, 0.0), (0.2, 0.0), (0.4, 0.0)],
    receiving: &[(0.675, 0.0), (0.2, 0.0), (0.4, 0.0)],
};
const KICKOFF_5: Table = Table {
    kicking: &[(1.1, 0.0), (0.3, 0.0), (0.7, 0.0), (0.45, -0.2), (0.45, 0.2)],
    receiving: &[(1.1, 0.0), (0.3, 0.0), (0.7, 0.0), (0.45, -0.2), (0.45, 0.2)],
};
const PENALTY_3: Table = Table {
    kicking: &[(0.65, 0.0), (-0.3, 0.0), (0.1, 0.4)],
    receiving: &[(0.7125, 0.0), (-0.1, 0.25), (-0.1, -0.4)],
};
const PENALTY_5: Table = Table {
    kicking: &[(1.03, 0.0), (-0.6, 0.0), (0.3, 0.55), (0.3, 0.05), (0.3, -0.45)],
    receiving: &[(1.0625, 0.0), (-0.3, -0.7), (-0.3, 0.8), (-0.3, 0.3), (-0.3, -0.2)],
};
const GOAL_KICK_3: Table = Table {
    kicking: &[(0.675, 0.27), (0.45, 0.32), (0.3, -0.47)],
    receiving: &[(0.675, 0.0), (-0.225, 0.1), (-0.15, -0.32)],
};
const GOAL_KICK_5: Table = Table {
    kicking: &[(1.03, 0.0), (-0.45, 0.45), (0.4, -0.5), (-0.2, -0.4), (-0.4, 0.2)],
    receiving: &[(1.03, 0.0), (0.15, 0.0), (0.6, -0.6), (0.5, -0.3), (0.2, 0.4)],
};
/// Of a free ball, without the robot of each team beside the ball.
const FREE_BALL_3: Table =
    Table { kicking: &[(0.675, 0.0), (-0.1, -0.2)], receiving: &[(0.675, 0.0), (0.3, -0.1)] };
const FREE_BALL_5: Table = Table {
    kicking: &[(1.03, 0.0), (0.4, 0.6), (0.4, -0.6), (-0.7, -0.1)],
    receiving: &[(1.03, 0.0), (0.3, -0.5), (-0.4, 0.0), (0.4, -0.1)],
};

/// Places of robots for the present kick, or the next one, by their indices. The first robot of a team is its
/// keeper, the second one stands beside the ball of a free ball. Robots that the table does not have are
/// missing.
pub(crate) fn places(
    game: &Game,
    moment: &Moment,
    ball: Vector,
    robots: &[Robot],
) -> Vec<(usize, Vector)> {
    let command = command_of_positions(game);
    let is_large = moment.lines().inner_area_depth > 0.0;
    let Some((table, kicking)) = table_of(command, is_large, ball) else { return Vec::new() };
    let aside = if is_mirrored(command, is_large, ball) { -1.0 } else { 1.0 };
    let mut placed = Vec::new();
    for team in Team::BOTH {
        let home = team.own_side();
        let positions = if team == kicking { table.kicking } else { table.receiving };
        let mut positions: Vec<Vector> =
            positions.iter().map(|(x, y)| Vector::new(home * x, aside * y)).collect();
        if command == Command::FreeBall {
            let beside = home * BESIDE_FREE_BALL[usize::from(is_large)];
            positions.insert(1, Vector::new(ball.x + beside, ball.y));
        }
        let members = robots.iter().filter(|robot| robot.team == team);
        placed.extend(
            members
                .zip(positions)
                .map(|(robot, place)| (robot.index, away_from_ball(moment, place, ball))),
        );
    }
    placed
}

/// The table of a command, and the team that has the kick. Of a free ball it is the one that attacks in the
/// half. `None` for a command without a table.
fn table_of(command: Command, is_large: bool, ball: Vector) -> Option<(&'static Table, Team)> {
    let choose = |small, large| if is_large { large } else { small };
    match command {
        Command::PrepareKickoff(team) => Some((choose(&KICKOFF_3, &KICKOFF_5), team)),
        Command::PreparePenalty(team) => Some((choose(&PENALTY_3, &PENALTY_5), team)),
        Command::GoalKick(team) => Some((choose(&GOAL_KICK_3, &GOAL_KICK_5), team)),
        Command::FreeBall => {
            let attacker = if ball.x < 0.0 { Team::Yellow } else { Team::Blue };
            Some((choose(&FREE_BALL_3, &FREE_BALL_5), attacker))
        }
        _ => None,
    }
}

/// Whether the positions are those of the table with the opposite y. The tables are for a ball at +y. At a
/// goal kick the league mirrors the keeper alone; here both sides of the field are alike.
fn is_mirrored(command: Command, is_large: bool, ball: Vector) -> bool {
    let has_sides =
        command == Command::FreeBall || matches!(command, Command::GoalKick(_)) && !is_large;
    has_sides && ball.y < 0.0
}

/// The place, or one in the same direction from the ball that is just clear of it: the kicker of a penalty
/// stands nearer than a robot that may turn there.
fn away_from_ball(moment: &Moment, place: Vector, ball: Vector) -> Vector {
    let from_ball = place - ball;
    let (distance, clear) = (from_ball.length(), clear_of_ball(moment.pitch) + ROUNDING);
    if distance >= clear || distance == 0.0 {
        return place;
    }
    ball + from_ball * (clear / distance)
}
