//! Numbers and switches of the rules, with presets of both leagues.
//!
//! Sources: RoboCup-SSL/ssl-rules 4300196 (2026-05-21) for SSL; VSSSLeague/VSSReferee 2862742 (2022-03-12),
//! `src/constants/constants.json` and `referee/checkers`, for VSSS.

use serde::{Deserialize, Serialize};

/// League whose rules are played.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum League {
    /// Small Size League.
    Ssl,
    /// IEEE Very Small Size Soccer.
    Vsss,
}

/// Time that the match clock counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The time of a stage passes always.
    Running,
    /// It passes only while the ball is in play or a free kick may be taken.
    Stopped,
}

/// Way in which the ball comes to the place of the next kick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Placement {
    /// Ball and robots that stand too near are put in valid places at once.
    Teleport,
    /// A robot of a team carries it.
    Robots,
}

/// Times of the stages of a match.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Times {
    /// Duration of a half, s.
    pub half_seconds: f32,
    /// Number of halves, 1 or 2.
    pub halves: u8,
    /// Duration of a half of extra time after a draw, s; 0 for none.
    pub extra_half_seconds: f32,
    /// Penalty kicks of each team in the shoot-out after a draw, before sudden death; 0 for none.
    pub shootout_kicks: u8,
    /// Goals of a team from which a lead of `early_end_lead` ends the match; 0 for never.
    pub early_end_goals: u8,
    /// Lead that ends the match early.
    pub early_end_lead: u8,
    /// Time that the clock counts.
    pub clock: Clock,
}

/// Times in which something has to happen, s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// From the permission of a kick-off to the kick.
    pub kickoff_seconds: f32,
    /// From the permission of a free kick to the kick.
    pub free_kick_seconds: f32,
    /// Duration of a penalty kick.
    pub penalty_seconds: f32,
    /// Of a ball that makes no progress.
    pub no_progress_seconds: f32,
    /// Of the ball in the own area.
    pub held_ball_seconds: f32,
    /// Of a ball placement by robots.
    pub placement_seconds: f32,
    /// Between a stop and the next kick.
    pub transition_seconds: f32,
}

/// Numbers and switches of the rules of a match.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RefereeConfig {
    /// League.
    pub league: League,
    /// Times of the stages.
    pub times: Times,
    /// Times in which something has to happen.
    pub limits: Limits,
    /// Way in which the ball comes to the place of the next kick.
    pub placement: Placement,
}

impl RefereeConfig {
    /// Names of the presets.
    pub const PRESETS: [&'static str; 4] = ["ssl_2026_a", "ssl_2026_b", "vsss_3v3", "vsss_5v5"];

    /// A preset by name; `None` if there is none.
    pub fn preset(name: &str) -> Option<Self> {
        match name {
            "ssl_2026_a" => Some(Self::ssl_2026_a()),
            "ssl_2026_b" => Some(Self::ssl_2026_b()),
            "vsss_3v3" | "vsss_5v5" => Some(Self::vsss()),
            _ => None,
        }
    }

    /// SSL division A: "Game Structure", "Referee Commands", "Offenses".
    fn ssl_2026_a() -> Self {
        Self {
            league: League::Ssl,
            times: Times {
                half_seconds: 300.0,
                halves: 2,
                extra_half_seconds: 150.0,
                shootout_kicks: 5,
                early_end_goals: 10,
                early_end_lead: 2,
                clock: Clock::Stopped,
            },
            limits: Limits {
                kickoff_seconds: 10.0,
                free_kick_seconds: 5.0,
                penalty_seconds: 10.0,
                no_progress_seconds: 5.0,
                held_ball_seconds: 5.0,
                placement_seconds: 30.0,
                transition_seconds: 2.0,
            },
            placement: Placement::Teleport,
        }
    }

    /// SSL division B: as division A, with more time to act.
    fn ssl_2026_b() -> Self {
        let mut config = Self::ssl_2026_a();
        config.limits.free_kick_seconds = 10.0;
        config.limits.no_progress_seconds = 10.0;
        config.limits.held_ball_seconds = 10.0;
        config
    }

    /// VSSS: two halves of five minutes, then two of three and penalty kicks.
    fn vsss() -> Self {
        Self {
            league: League::Vsss,
            times: Times {
                half_seconds: 300.0,
                halves: 2,
                extra_half_seconds: 180.0,
                shootout_kicks: 5,
                early_end_goals: 0,
                early_end_lead: 0,
                clock: Clock::Stopped,
            },
            limits: Limits {
                kickoff_seconds: 10.0,
                free_kick_seconds: 10.0,
                penalty_seconds: 10.0,
                no_progress_seconds: 5.0,
                held_ball_seconds: 10.0,
                placement_seconds: 0.0,
                transition_seconds: 4.0,
            },
            placement: Placement::Teleport,
        }
    }
}
