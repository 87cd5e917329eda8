//! Drivers of a team.

use rsim_core::SimConfig;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, is_absent};
use rsim_referee::game::Game;
use rsim_referee::{Referee, Team};
use rsim_teams::ScriptedTeam;

use crate::actions::Actions;
use crate::error::MatchError;
use crate::knowledge::team_config;
use crate::observations::robots_of;
use crate::player::Player;

/// Driver of a team.
#[derive(Debug, Clone)]
pub enum Side {
    /// Nobody: robots stand still.
    Idle,
    /// The scripted SSL team, with its memory.
    Scripted(Box<ScriptedTeam>, Vec<f32>),
    /// A network.
    Network(Box<Player>),
}

/// State of a match that a side reads.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    pub(crate) config: &'a SimConfig,
    pub(crate) actions: &'a Actions,
    pub(crate) referee: &'a Referee,
    pub(crate) game: &'a Game,
    /// Row that the team knows.
    pub(crate) row: &'a [f32],
    pub(crate) team: Team,
    /// Whether the referee judges the goal areas, so that shields act.
    pub(crate) judges_areas: bool,
}

impl Side {
    /// The scripted SSL team, which plays by some tactics; `None` for those that were set by hand.
    ///
    /// # Errors
    /// A skill or tactics out of range, or robots that it cannot drive.
    pub(crate) fn scripted(
        config: &SimConfig,
        referee: &Referee,
        skill: f32,
        seed: u32,
        tactics: Option<&[f32]>,
    ) -> Result<Self, MatchError> {
        let Some(numbers) = team_config(config, referee.layout().clone(), skill) else {
            let got = &config.field.name;
            return Err(MatchError::argument(
                "side",
                "a side of this league",
                &format!("the scripted SSL team on {got}"),
            ));
        };
        let team = ScriptedTeam::new(&numbers)?;
        let mut memory = vec![0.0; team.memory_columns().len()];
        team.begin(&mut memory, seed, tactics)?;
        Ok(Self::Scripted(Box::new(team), memory))
    }

    /// Whether it plays from the state in which its commands act, as the programs of teams do.
    pub(crate) fn forecasts(&self) -> bool {
        match self {
            Self::Idle => false,
            Self::Scripted(..) => true,
            Self::Network(player) => player.network().needs_forecast(),
        }
    }

    /// Writes the commands of the team's robots, one after the other.
    ///
    /// # Errors
    /// A state that does not fit.
    pub(crate) fn act(&mut self, known: Known, commands: &mut [f32]) -> Result<(), MatchError> {
        commands.fill(0.0);
        match self {
            Self::Idle => Ok(()),
            Self::Scripted(team, memory) => {
                Ok(team.act(known.row, known.game, known.team, memory, commands)?)
            }
            Self::Network(player) => act_by_network(player, known, commands),
        }
    }
}

fn act_by_network(
    player: &mut Player,
    known: Known,
    commands: &mut [f32],
) -> Result<(), MatchError> {
    let Known { actions, game, row, team, .. } = known;
    let robots = robots_of(team, known.config);
    let mut observation = vec![0.0; player.observations().size()];
    // A policy that does not observe the state of the match cannot know when it may play; a shield knows.
    let knows_game = player.observations().has_game() && !player.network().is_shielded();
    for (nth, robot) in robots.enumerate() {
        let last = player.last_action(nth).to_vec();
        let state = (known.referee, game);
        player.observations().observe(row, state, robot, &last, &mut observation)?;
        let free = knows_game || game.robot_may_touch(robot, team);
        let shielded = known.judges_areas.then_some((robot, row));
        let action = player.act(nth, &observation, free, shielded);
        let columns = &row[BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len()..];
        if free && !is_absent(columns) {
            let size = actions.command_size();
            let out = &mut commands[nth * size..][..size];
            actions.command(action, row, robot, team == Team::Yellow, out);
        }
    }
    player.end_step();
    Ok(())
}
