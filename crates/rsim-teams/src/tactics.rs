//! Tactics: the numbers by which a scripted side plays, and which learning may change.
//!
//! A side is a fixed program with some sixty thresholds, values and gains. Their defaults were set by hand.
//! `rsoccer evolve` finds better ones by playing matches.

use crate::error::TeamsError;

/// Factor by which a number may be below and above its default.
const FACTOR: f32 = 4.0;

/// A number of the tactics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tactic {
    /// Name.
    pub name: &'static str,
    /// Value that was set by hand.
    pub default: f32,
    /// Least value.
    pub least: f32,
    /// Greatest value.
    pub most: f32,
}

/// Declares the numbers with their defaults, and the greatest values of those that a rule or the robot limits.
macro_rules! tactics {
    ($($(#[$doc:meta])* $name:ident: $default:literal $(.. $most:literal)?,)*) => {
        /// Numbers of a scripted side.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub(crate) struct Tactics { $($(#[$doc])* pub(crate) $name: f32,)* }

        impl Tactics {
            /// Number of numbers.
            pub(crate) const COUNT: usize = [$(stringify!($name)),*].len();

            /// The tactics that were set by hand.
            pub(crate) const DEFAULT: Self = Self { $($name: $default,)* };

            fn from_array(values: [f32; Self::COUNT]) -> Self {
                let [$($name),*] = values;
                Self { $($name,)* }
            }

            fn to_array(self) -> [f32; Self::COUNT] {
                [$(self.$name),*]
            }
        }

        /// All numbers, in the order of an array of tactics.
        pub const TACTICS: [Tactic; Tactics::COUNT] = [$(Tactic {
            name: stringify!($name),
            default: $default,
            least: $default / FACTOR,
            most: tactics!(@most $default $(, $most)?),
        }),*];
    };
    (@most $default:literal) => { FACTOR * $default };
    (@most $default:literal, $most:literal) => { $most };
}

tactics! {
    /// Value by which a new kick has to be better than the one chosen, as a factor.
    kick_hysteresis: 1.2,
    /// Value of a kick that is made at once.
    good_value: 0.3,
    /// Distance of an opponent from the ball that hurries, m.
    pressed_distance: 0.45,
    /// Way that a robot dribbles, m; the rules allow 1.
    dribble_way: 0.6 .. 0.72,
    /// Acceleration with the ball, m/s²: the dribbler holds it up to 2.6, and along its back-spin up to 5.6.
    carry_acceleration: 2.5,
    /// Deceleration with the ball, m/s².
    carry_deceleration: 3.2,
    /// Acceleration of the ball to the side, in a turn, m/s².
    carry_side_acceleration: 1.8,
    /// Angular acceleration with the ball, rad/s²: 1.4 m/s² at the ball.
    carry_turn_acceleration: 15.0,
    /// Speed with the ball, m/s.
    carry_speed: 1.0,
    /// Angular velocity with the ball, rad/s: TIGERs turn at 5.
    carry_turning: 5.0,
    /// Speed of a pass on arrival, m/s: the dribbler stops it.
    arrival_speed: 2.4,
    /// Time for which a receiver goes on as it does, s.
    receiver_lead: 0.35,
    /// Likelihood that a chip is received, if nobody stops it.
    chip_reception: 0.75 .. 1.0,
    /// Share of the value of a long shot that is worth it: aimless kicks give free kicks.
    long_shot_share: 0.3,
    /// Value of the ball at a place from which a shot is a sure goal.
    goal_value: 0.55,
    /// Value of the way over the field to the goal.
    progress_value: 0.25,
    /// Value of a clearance that no opponent stops.
    clearance_value: 0.04,
    /// Value of a weak kick ahead that the robot follows.
    run_value: 0.1,
    /// Distance from opponents that such a kick needs, m.
    run_space: 1.0,
    /// Speed of the ball after a kick, m/s; the rules allow 6.5.
    ball_speed: 6.0 .. 6.4,
    /// Time after a kick until opponents react, s.
    reaction_time: 0.15,
    /// Acceleration of opponents toward the ball, m/s².
    lane_acceleration: 3.0,
    /// Speed of opponents toward the ball, m/s.
    lane_speed: 2.0,
    /// Share of a kick's speed that the ball has on its way.
    lane_ball_share: 0.75,
    /// Sine of the error of direction for a shot.
    shot_sine: 0.025,
    /// Sine of the error of direction for a pass along the floor.
    pass_sine: 0.06,
    /// Sine of the error of direction for a chip.
    chip_sine: 0.12,
    /// Angular velocity for a kick, rad/s.
    kick_turning: 1.5,
    /// Distance between mouth and ball before the final approach, m.
    standoff: 0.09,
    /// Speed into the ball, m/s.
    press_speed: 0.35,
    /// Cosine of the angle between a coming ball's way back and the direction of a kick at first touch.
    redirection: 0.35 .. 1.0,
    /// Value of a shot that is made at first touch.
    first_touch_value: 0.2,
    /// Share of the ball's speed across the front that a kick keeps.
    kept_across: 0.35 .. 1.0,
    /// Distance from teammates that is wanted, m.
    teammate_distance: 1.5,
    /// Distance from opponents that is wanted, m.
    free_distance: 0.7,
    /// Value lost for a m of way.
    way_cost: 0.05,
    /// Share of the ball's maximum speed that a pass to a place has.
    lane_pass_share: 0.7 .. 1.0,
    /// Distance of the wall's centers from the own area, m, beyond the robots' radius.
    wall_room: 0.06,
    /// Places in the goal that two robots of the wall cover, as shares of half its width.
    wall_cover: 0.5,
    /// Distance of a mark from its opponent, m.
    mark_distance: 0.32,
    /// Weight of the ball against the goal in the direction of a mark.
    mark_toward_ball: 0.5,
    /// Distance from the own goal within which opponents are marked, as a share of the field's length.
    marked_share: 0.75,
    /// Time by which another robot has to be earlier at the ball to take over, s.
    taker_loyalty: 0.25,
    /// The same against the receiver of a pass, s.
    receiver_loyalty: 0.5,
    /// Time by which the opponents have to be earlier or later until a team changes its attitude, s.
    attitude_time: 0.2,
    /// Distance of the keeper from the middle of the goal, as a share of half its width.
    keeper_distance: 0.9,
    /// The same of the other team's keeper, as it is expected.
    their_keeper_distance: 0.9,
    /// Share of the maximum deceleration with which robots plan to brake.
    braking_share: 0.55 .. 1.0,
    /// Speed by the distance that is left, 1/s: the last centimeters.
    position_gain: 9.0,
    /// Deceleration with which a robot plans to come to a limit, m/s².
    limit_braking: 3.0,
    /// Deceleration with which a robot plans to meet another one, m/s².
    meeting_braking: 2.5,
    /// Share of the speed of a robot in contact at which it is followed.
    following_share: 0.6 .. 1.0,
    /// Distance from opponents that ways keep, m.
    their_room: 0.06,
    /// Margin below 0 at which no ball passes an opponent, m, as a positive number.
    chance_offset: 0.1,
    /// Margin from there until every ball passes, m.
    chance_width: 0.35,
    /// Time after which a robot but the keeper makes any kick, s.
    patience: 1.8,
    /// Share of the maximum speed that a skilled team uses: what remains is for corrections.
    speed_share: 0.85 .. 1.0,
    /// Share of the maximum acceleration that a skilled team uses when it gets faster.
    acceleration_share: 0.85 .. 1.0,
    /// Least distance from the ball of a robot that runs free, m.
    ball_distance_least: 1.4,
    /// Greatest distance from the ball of a robot that runs free, m.
    ball_distance_most: 4.0,
    /// Likelihood from which a skilled team tries a pass.
    pass_threshold: 0.45 .. 0.9,
    /// Speed of opponents, as it is assumed, m/s.
    their_speed: 3.0,
    /// Acceleration of opponents, as it is assumed, m/s².
    their_acceleration: 4.0,
    /// One more than the cosine of the angle between the ways to the ball and on with it up to which a robot drives
    /// behind the ball, if it has time.
    aimed_with_time: 0.7,
    /// That cosine without time.
    aimed: 0.6 .. 1.0,
}

impl Tactics {
    /// Names of the columns in a team's memory.
    pub(crate) fn columns() -> impl Iterator<Item = String> {
        TACTICS.iter().map(|tactic| tactic.name.to_owned())
    }

    /// The tactics of an array, in the order of [`TACTICS`].
    ///
    /// # Errors
    /// Another length, or a number out of its range.
    pub(crate) fn read(values: &[f32]) -> Result<Self, TeamsError> {
        let Ok(array) = <[f32; Self::COUNT]>::try_from(values) else {
            let (expected, got) = (Self::COUNT, values.len());
            return Err(TeamsError::Size { name: "tactics", expected, got });
        };
        for (tactic, got) in TACTICS.iter().zip(array) {
            let Tactic { name, least, most, .. } = *tactic;
            if !(least..=most).contains(&got) {
                return Err(TeamsError::Tactic { name, least, most, got });
            }
        }
        Ok(Self::from_array(array))
    }

    /// Writes the numbers to the start of a row. Returns the rest.
    pub(crate) fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
        let (own, rest) = row.split_at_mut(Self::COUNT);
        own.copy_from_slice(&self.to_array());
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_within_their_ranges_and_come_back_from_an_array() {
        let mut row = [0.0; Tactics::COUNT + 1];
        assert_eq!(Tactics::DEFAULT.write(&mut row).len(), 1);
        assert_eq!(Tactics::read(&row[..Tactics::COUNT]), Ok(Tactics::DEFAULT));
        for tactic in TACTICS {
            assert!(tactic.least < tactic.default && tactic.default < tactic.most, "{tactic:?}");
        }
    }

    #[test]
    fn wrong_arrays_are_refused() {
        let mut values = Tactics::DEFAULT.to_array();
        assert!(Tactics::read(&values[1..]).is_err());
        for wrong in [f32::NAN, -1.0, 0.0, 100.0] {
            values[1] = wrong;
            let error = Tactics::read(&values).expect_err("out of range").to_string();
            assert!(error.contains("good_value") && error.contains("0.075"), "{error}");
        }
    }

    #[test]
    fn names_differ() {
        let mut names: Vec<String> = Tactics::columns().collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), Tactics::COUNT);
    }
}
