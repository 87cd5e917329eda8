//! Default positions of VSSS robots for each kick. Source: VSSSLeague/VSSReferee 2862742 (2022-03-12),
//! `src/world/entities/replacer/replacements.json` and `replacer.cpp`.

use crate::codes::Command;
use crate::game::Game;
use crate::moment::Moment;
use crate::positions::{command_of_positions, nearest_to};
use crate::sight::Placed;
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
/// Of a free ball, without the robots beside the ball. The team that attacks in the half has the kick.
const FREE_BALL_3: Table =
    Table { kicking: &[(0.675, 0.0), (-0.1, -0.2)], receiving: &[(0.675, 0.0), (0.3, -0.1)] };
const FREE_BALL_5: Table = Table {
    kicking: &[(1.03, 0.0), (0.4, 0.6), (0.4, -0.6), (-0.7, -0.1)],
    receiving: &[(1.03, 0.0), (0.3, -0.5), (-0.4, 0.0), (0.4, -0.1)],
};

/// Positions of the robots for the present kick, or the next one. Robots that the table does not have are
/// missing.
pub(crate) fn places(game: &Game, moment: &Moment) -> Vec<Placed> {
    let is_large = moment.lines().inner_area_depth > 0.0;
    let choose = |small, large| if is_large { large } else { small };
    let command = command_of_positions(game);
    let ball = game.designated_position;
    let (table, kicking) = match command {
        Command::PrepareKickoff(team) => (choose(&KICKOFF_3, &KICKOFF_5), team),
        Command::PreparePenalty(team) => (choose(&PENALTY_3, &PENALTY_5), team),
        Command::GoalKick(team) => (choose(&GOAL_KICK_3, &GOAL_KICK_5), team),
        Command::FreeBall => {
            let attacker = if ball.x < 0.0 { Team::Yellow } else { Team::Blue };
            (choose(&FREE_BALL_3, &FREE_BALL_5), attacker)
        }
        _ => return Vec::new(),
    };
    // The tables are for a ball at +y, where the league mirrors them.
    let mirrors = matches!(command, Command::FreeBall)
        || matches!(command, Command::GoalKick(_)) && !is_large;
    let aside = if mirrors && ball.y < 0.0 { -1.0 } else { 1.0 };
    let mut placed = Vec::new();
    for team in Team::BOTH {
        let positions = if team == kicking { table.kicking } else { table.receiving };
        let mut robots: Vec<usize> = moment.now.team(team).map(|robot| robot.index).collect();
        if command == Command::FreeBall {
            if let Some(taker) = nearest_to(moment, team, ball) {
                robots.retain(|robot| *robot != taker);
                let beside = team.own_side() * BESIDE_FREE_BALL[usize::from(is_large)];
                let position = Vector::new(ball.x + beside, ball.y);
                placed.push(Placed { robot: taker, position, faces: Some(ball) });
            }
        }
        for (robot, (x, y)) in robots.into_iter().zip(positions) {
            let position = Vector::new(team.own_side() * x, aside * y);
            placed.push(Placed { robot, position, faces: Some(ball) });
        }
    }
    placed
}
