//! Controls of a person as an action of one robot; `python/rsoccer/human/driver.py` has the same in Python.

use rsim_referee::Team;
use serde::{Deserialize, Serialize};

/// Wheel speed of a full turn of a differential robot, as a fraction of the top speed.
const WHEEL_TURN: f32 = 0.3;
/// Action of a full turn of an omnidirectional robot.
const TURN: f32 = 0.5;
/// Factor on speeds while they are reduced.
const SLOW: f32 = 0.4;

/// Controls of a person.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Controls {
    /// Deflection toward +x, -1 to 1; a differential robot turns to its right.
    pub right: f32,
    /// Deflection toward +y, -1 to 1; a differential robot drives ahead.
    pub up: f32,
    /// Turn, counterclockwise, -1 to 1.
    pub turn: f32,
    /// Speed of a kick, as a part of the fastest; 0 for none.
    pub kick: f32,
    /// Whether the kick is a chip.
    pub chip: bool,
    /// Whether the dribbler is on.
    pub dribble: bool,
    /// Whether speeds are reduced.
    pub slow: bool,
}

impl Controls {
    fn speed(&self) -> f32 {
        if self.slow { SLOW } else { 1.0 }
    }

    /// Action of a differential robot. Too fast a wheel slows both, so that the curve stays the same.
    pub(crate) fn wheels(&self) -> [f32; 2] {
        let turn = WHEEL_TURN * (self.turn - self.right).clamp(-1.0, 1.0);
        let wheels = [self.up - turn, self.up + turn];
        let largest = wheels[0].abs().max(wheels[1].abs()).max(1.0);
        wheels.map(|wheel| self.speed() * wheel / largest)
    }

    /// Action of an omnidirectional robot of a team, with the switch of a chip kick.
    pub(crate) fn motion(&self, team: Team) -> [f32; 6] {
        // Actions are in the coordinates of the team, which attacks +x.
        let sign = -team.own_side();
        // A diagonal of two keys is no faster than one key.
        let speed = self.speed() / libm::hypotf(self.right, self.up).max(1.0);
        let switch = |on: bool| if on { 1.0 } else { -1.0 };
        [
            speed * sign * self.right,
            speed * sign * self.up,
            self.speed() * TURN * self.turn.clamp(-1.0, 1.0),
            if self.kick > 0.0 { self.kick.min(1.0) } else { -1.0 },
            switch(self.dribble),
            switch(self.chip),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_has_the_same_directions_for_both_teams() {
        let controls = Controls { right: 1.0, up: 1.0, ..Controls::default() };
        let [blue, yellow] = Team::BOTH.map(|team| controls.motion(team));
        assert!((blue[0] + yellow[0]).abs() < 1e-6 && blue[0] > 0.7 && blue[0] < 0.71);
        assert!((blue[3] + 1.0).abs() < 1e-6, "no kick");
        let slow = Controls { slow: true, ..controls }.motion(Team::Blue);
        assert!((slow[0] - SLOW * blue[0]).abs() < 1e-6);
    }

    #[test]
    fn wheels_stay_within_their_speed() {
        let ahead = Controls { up: 1.0, right: 1.0, ..Controls::default() }.wheels();
        assert!((ahead[0] - 1.0).abs() < 1e-6 && ahead[1] > 0.5 && ahead[1] < 0.6, "{ahead:?}");
        assert!(Controls::default().wheels().iter().all(|wheel| wheel.abs() < 1e-9));
    }
}
