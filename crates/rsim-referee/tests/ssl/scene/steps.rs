//! Steps of a scene: the states from which a test begins, and judging.

use rsim_referee::Team;
use rsim_referee::codes::Command;
use rsim_referee::events::Event;

use super::{Bot, Scene, Seen, Side, Us};

impl Scene {
    /// Goes on as after a force start.
    pub(crate) fn free(&mut self) {
        self.game.kick = Some(Command::ForceStart);
        self.game.give(Command::ForceStart, None);
        self.game.in_play = true;
        self.settle();
    }

    /// A team may take a free kick from where the ball is.
    pub(crate) fn free_kick(&mut self, side: Side) {
        self.allow(Command::DirectFree(self.team(side)));
        self.game.give(Command::DirectFree(self.team(side)), None);
    }

    /// A team may take its kick-off.
    pub(crate) fn kickoff(&mut self, side: Side) {
        self.ball(0.0, 0.0);
        self.allow(Command::PrepareKickoff(self.team(side)));
        self.game.give(Command::NormalStart, None);
    }

    /// A team may take a penalty kick. All others are behind the ball, the keepers in their goals.
    pub(crate) fn penalty(&mut self, side: Side) {
        self.stop(Command::PreparePenalty, side, self.penalty_mark(side));
        self.run(30.0, |scene| scene.game.command == Command::NormalStart);
        self.game.command_steps = 0;
    }

    /// The mark of the penalty kick of a team.
    pub(crate) fn penalty_mark(&self, side: Side) -> (f32, f32) {
        let lines = &self.referee.pitch().lines;
        let x = lines.half_length - lines.penalty_mark_distance;
        (if side == Us { x } else { -x }, 0.0)
    }

    fn allow(&mut self, kick: Command) {
        self.game.kick = Some(kick);
        self.game.in_play = false;
        let (x, y) = self.ball_at();
        self.game.designated_position = self.turn((x, y));
        self.game.kick_position = self.game.designated_position;
        self.settle();
    }

    /// Stops play, before a command for a team with the ball at a place.
    pub(crate) fn stop(&mut self, next: fn(Team) -> Command, side: Side, place: (f32, f32)) {
        self.stop_for(next(self.team(side)), place);
    }

    /// Stops play, before a command.
    pub(crate) fn stop_for(&mut self, next: Command, place: (f32, f32)) {
        self.game.in_play = false;
        self.game.give(Command::Stop, Some(next));
        self.game.wait_steps = self.steps(2.0);
        self.game.designated_position = self.turn(place);
        self.settle();
    }

    /// Makes the present bodies those before the next step, as after a restart.
    pub(crate) fn settle(&mut self) {
        self.before.copy_from_slice(&self.row);
        self.game.stuck_position = self.sight().ball().position;
        self.game.stuck_steps = 0;
    }

    /// Judges a step that ends with the bodies where the test put them.
    pub(crate) fn step(&mut self) {
        self.write_since_touch();
        let mut restart = vec![0.0; self.row.len()];
        self.referee
            .judge(
                &self.before,
                &self.row,
                &mut self.game,
                &mut self.statistics,
                &mut restart,
                &mut self.decisions,
            )
            .expect("rows of this layout");
        self.events = self.decisions.events.iter().map(|event| self.seen(event)).collect();
        self.restarted = self.decisions.restarts;
        if self.restarted {
            self.row = restart;
        }
        self.clear_touches();
        self.before.copy_from_slice(&self.row);
    }

    fn seen(&self, event: &Event) -> Seen {
        let bot = event.robot.map(|index| {
            let team = self.referee.layout().team_of(index);
            (self.side(team), if team == Team::Blue { index } else { index - self.size() })
        });
        let side = event.team.map(|team| self.side(team));
        Seen { kind: event.kind, side, bot, at: self.back(event.position) }
    }

    /// Judges steps in which nothing moves, for a time. Returns all events.
    pub(crate) fn wait(&mut self, seconds: f32) -> Vec<Seen> {
        let mut events = Vec::new();
        for _ in 0..self.steps(seconds) {
            self.step();
            events.append(&mut self.events);
        }
        self.events.clone_from(&events);
        events
    }

    /// Judges steps in which nothing moves, until something is true. Returns all events.
    pub(crate) fn run(&mut self, seconds: f32, until: impl Fn(&Self) -> bool) -> Vec<Seen> {
        let mut events = Vec::new();
        for _ in 0..self.steps(seconds) {
            if until(self) {
                break;
            }
            self.step();
            events.append(&mut self.events);
        }
        assert!(until(self), "not within {seconds} s: {:?}", self.game);
        self.events.clone_from(&events);
        events
    }

    /// A robot kicks the ball from where it is to another place, in one step.
    pub(crate) fn kick(&mut self, bot: Bot, x: f32, y: f32) {
        self.touch(bot);
        self.ball(x, y);
        self.step();
    }
}
