//! Valid places of ball and robots at a restart.

use crate::cards;
use crate::config::League;
use crate::flow::Arrangement;
use crate::formation;
use crate::game::Game;
use crate::moment::Moment;
use crate::positions::Positions;
use crate::sight::{Layout, Placed, Robot};
use crate::team::Team;
use crate::vector::Vector;

/// Distance from its place within which a ball at rest stays, m.
const SAME_PLACE: f32 = 0.01;

/// Greatest distance of a valid place from the one that hands wanted, m: beside a ball or a goal.
const SEARCHED: f32 = 0.02;

fn rests(robot: &Robot) -> bool {
    robot.velocity == Vector::default() && robot.angular_velocity == 0.0
}

/// Whether all robots are where the present command allows them to be, with the ball at a place.
pub(crate) fn is_arranged(game: &Game, moment: &Moment, ball: Vector) -> bool {
    let positions = Positions::new(game, moment, ball);
    moment.now.robots().all(|robot| positions.allows(&robot, robot.position))
}

/// Changes the row of a restart as the referee arranges the bodies. Returns whether anything changed.
pub(crate) fn arrange(
    game: &mut Game,
    moment: &Moment,
    layout: &Layout,
    arrangement: Arrangement,
    row: &mut [f32],
) -> bool {
    let mut restart = Restart { layout, row, changed: false, settled: Vec::new() };
    let ball = match arrangement {
        Arrangement::All => restart.place_ball(moment, game.designated_position),
        Arrangement::Robots | Arrangement::None => moment.ball.position,
    };
    restart.take_out(game, moment);
    let positions = Positions::new(game, moment, ball);
    let present = |robot: &Robot| !cards::is_removed(game, robot.index);
    let robots: Vec<Robot> = moment.now.robots().filter(present).collect();
    match (arrangement, moment.config.league) {
        (Arrangement::All, League::Ssl) => restart.place_invalid(&positions, robots),
        (Arrangement::All, League::Vsss) => {
            let table = formation::places(game, moment, ball, &robots);
            restart.place_by_table(game, moment, &positions, robots, &table);
        }
        _ => restart.settled.extend(robots.iter().map(|robot| robot.position)),
    }
    restart.bring_back(game, moment, &positions);
    restart.changed
}

/// The row of a restart, and the robots that have their places in it.
struct Restart<'a> {
    layout: &'a Layout,
    row: &'a mut [f32],
    changed: bool,
    settled: Vec<Vector>,
}

impl Restart<'_> {
    /// Puts the ball at its place, unless it rests there. Returns where it is.
    fn place_ball(&mut self, moment: &Moment, place: Vector) -> Vector {
        let ball = moment.ball;
        let rests = ball.speed() == 0.0 && ball.height == 0.0;
        if rests && ball.position.distance(place) <= SAME_PLACE {
            return ball.position;
        }
        self.layout.put_ball(self.row, place);
        self.changed = true;
        place
    }

    /// Puts the robots in forbidden places in valid ones. The others stay.
    fn place_invalid(&mut self, positions: &Positions, robots: Vec<Robot>) {
        let is_valid = |robot: &Robot| positions.allows(robot, robot.position);
        let (valid, invalid): (Vec<_>, Vec<_>) = robots.into_iter().partition(is_valid);
        self.settled.extend(valid.iter().map(|robot| robot.position));
        self.place_near(positions, invalid);
    }

    /// Puts the robots in their places of a table, as exactly as by hand, and those for which it has none in
    /// the places nearest to where they are.
    fn place_by_table(
        &mut self,
        game: &mut Game,
        moment: &Moment,
        positions: &Positions,
        robots: Vec<Robot>,
        table: &[(usize, Vector)],
    ) {
        let place_of = |robot: &Robot| table.iter().find(|(index, _)| *index == robot.index);
        let (listed, others): (Vec<_>, Vec<_>) =
            robots.into_iter().partition(|robot| place_of(robot).is_some());
        for robot in &listed {
            let place = place_of(robot).map_or(robot.position, |(_, place)| *place);
            let most = moment.config.placement_error;
            let off = robot.position - place;
            // A kick is arranged twice; a robot that hands have put there stays. Hands are never exact.
            let is_there = off != Vector::default()
                && most > 0.0
                && off.x.abs().max(off.y.abs()) <= most + SEARCHED
                && positions.allows(robot, robot.position)
                && rests(robot);
            let wanted =
                if is_there { robot.position } else { place + game.placements.within(most) };
            self.place(positions, robot, wanted);
        }
        self.place_near(positions, others);
    }

    /// Puts robots in the valid places nearest to where they are. The nearest to the ball come first, so that
    /// both teams have the same chances.
    fn place_near(&mut self, positions: &Positions, mut robots: Vec<Robot>) {
        let distance = |robot: &Robot| robot.position.distance(positions.ball());
        robots.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        for robot in &robots {
            self.place(positions, robot, robot.position);
        }
    }

    /// Puts a robot at the valid place that is nearest to the one that is wanted.
    fn place(&mut self, positions: &Positions, robot: &Robot, wanted: Vector) {
        let position = positions.nearest(robot, wanted, &self.settled);
        self.settled.push(position);
        if position != robot.position || !rests(robot) {
            let placed = Placed { robot: robot.index, position, faces: Some(positions.ball()) };
            self.layout.put_robot(self.row, &placed);
            self.changed = true;
        }
    }

    /// Takes out the robots that a team has too many.
    fn take_out(&mut self, game: &mut Game, moment: &Moment) {
        for team in Team::BOTH {
            for robot in cards::taken_out(game, moment, team) {
                self.layout.take_out(self.row, robot.index);
                game.removed_robots |= 1 << robot.index;
                game.removal_steps_left[team] = -1;
                self.changed = true;
            }
        }
    }

    /// Brings robots back whose cards have expired: to the touch line at the halfway line.
    fn bring_back(&mut self, game: &mut Game, moment: &Moment, positions: &Positions) {
        for team in Team::BOTH {
            let most = cards::max_robots(game, moment, team);
            let missing = most.saturating_sub(moment.now.count(team));
            let removed = moment.now.indices(team).filter(|robot| cards::is_removed(game, *robot));
            for index in removed.take(missing).collect::<Vec<_>>() {
                let entry = Vector::new(0.0, moment.lines().half_width);
                let robot = Robot::at_rest(index, team, entry);
                let position = positions.nearest(&robot, entry, &self.settled);
                self.settled.push(position);
                let placed = Placed { robot: index, position, faces: Some(positions.ball()) };
                self.layout.put_robot(self.row, &placed);
                game.removed_robots &= !(1 << index);
                self.changed = true;
            }
        }
    }
}
