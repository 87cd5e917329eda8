//! The link to the robots: commands that arrive late, some of them never.

use serde::{Deserialize, Serialize};

use crate::models::sensing::Sensing;
use crate::senses::fetch::Fetched;
use crate::senses::jitter::Jitter;
use crate::senses::queue::remove_first;
use crate::senses::random::{Draws, Purpose};

/// Commands of a control step on their way.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Sent {
    /// Tick at whose start they arrive.
    due: u64,
    /// Number of the control step.
    number: u64,
    /// Robots that do not hear them, one bit each.
    lost: u64,
}

/// The link to all robots of a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Link {
    under_way: Vec<Sent>,
    /// Commands of those on their way, one after the other.
    queued: Vec<f32>,
    /// Number of control steps that sent commands.
    number: u64,
    /// Robots that have stopped after a time without commands, one bit each.
    stopped: u64,
    /// Tick of the last command that each robot heard.
    heard: Vec<u64>,
    /// Tick before which no robot that is not stopped heard its last command: its time-out is not over earlier.
    waiting_since: u64,
    /// Tick before which nothing arrives and no time-out is over.
    idle_until: u64,
    /// Last command that each robot heard.
    commands: Vec<f32>,
}

impl Link {
    /// Fetches what was heard and what is on its way.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        self.under_way.iter().for_each(|sent| fetched.number(sent.number));
        self.heard.iter().step_by(8).for_each(|tick| fetched.number(*tick));
        fetched.numbers(&self.queued);
        fetched.numbers(&self.commands);
    }

    /// A link to `robots` robots that have heard nothing yet, with memory for commands of a number of control steps.
    pub(super) fn new(robots: usize, columns: usize, steps: usize) -> Self {
        Self {
            under_way: Vec::with_capacity(steps),
            queued: Vec::with_capacity(steps * robots * columns),
            number: 0,
            stopped: 0,
            heard: vec![0; robots],
            waiting_since: 0,
            idle_until: 0,
            commands: vec![0.0; robots * columns],
        }
    }

    /// Sends the commands of a control step at the start of tick `now`. The lengths are those of a tick and of a step, s.
    pub(super) fn send(
        &mut self,
        now: u64,
        [tick, step]: [f32; 2],
        (sensing, key): (&Sensing, u64),
        commands: &[f32],
    ) {
        let mut draws = Draws::of(key, Purpose::Command, self.number);
        let jitter = Jitter::of(sensing.command_jitter, sensing.command_delay, step);
        let jitter = jitter.of_nth(self.number, key, Purpose::CommandDelay, &mut draws);
        let mut ticks = ((sensing.command_delay + jitter) / tick).max(0.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 2 s")]
        let whole = |ticks: f32| ticks as u32;
        #[expect(clippy::cast_precision_loss, reason = "0 to 2 s")]
        let nearest = whole(ticks + 0.5) as f32;
        // A robot listens once a tick, at a time of its own: the mean is the delay that was asked for.
        ticks = if (ticks - nearest).abs() > 1e-4 { ticks + draws.uniform() } else { nearest };
        let due = now + u64::from(whole(ticks));
        let due = self.under_way.last().map_or(due, |last| due.max(last.due));
        let lost = draws.which(sensing.command_loss, self.heard.len());
        self.under_way.push(Sent { due, number: self.number, lost });
        self.idle_until = self.idle_until.min(due);
        self.queued.extend_from_slice(commands);
        self.number += 1;
    }

    /// Takes in what has arrived at the start of tick `now`, and stops robots that have waited for `timeout`
    /// ticks. If anything changed, returns the number of the control step whose commands robots obey from now on.
    pub(super) fn receive(&mut self, now: u64, timeout: Option<u64>) -> Option<u64> {
        if now < self.idle_until {
            return None;
        }
        let mut obeyed = None;
        let arrived = self.under_way.iter().take_while(|sent| sent.due <= now).count();
        for nth in 0..arrived {
            let Sent { number, lost, .. } = self.under_way[nth];
            self.hear(now, lost, nth);
            self.stopped &= lost;
            obeyed = Some(number);
        }
        remove_first(&mut self.under_way, arrived);
        remove_first(&mut self.queued, arrived * self.commands.len());
        self.idle_until = self.under_way.first().map_or(u64::MAX, |next| next.due);
        let Some(timeout) = timeout else { return obeyed };
        if now - self.waiting_since >= timeout && self.stop_waiting(now, timeout) {
            obeyed = obeyed.or(Some(self.number));
        }
        self.idle_until = self.idle_until.min(self.waiting_since + timeout);
        obeyed
    }

    /// Stops robots that have waited for `timeout` ticks. Returns whether there were any.
    fn stop_waiting(&mut self, now: u64, timeout: u64) -> bool {
        let mut any = false;
        for robot in 0..self.heard.len() {
            if now - self.heard[robot] >= timeout && self.stopped >> robot & 1 == 0 {
                self.stopped |= 1 << robot;
                let columns = self.columns();
                self.commands[robot * columns..(robot + 1) * columns].fill(0.0);
                any = true;
            }
        }
        // A stopped robot that hears a command again does so later than now.
        let going =
            self.heard.iter().enumerate().filter(|(robot, _)| self.stopped >> robot & 1 == 0);
        self.waiting_since = going.map(|(_, heard)| *heard).min().unwrap_or(now);
        any
    }

    /// Lets robots whose commands are not `lost` hear the `nth` of those on their way.
    fn hear(&mut self, now: u64, lost: u64, nth: usize) {
        let (columns, size) = (self.columns(), self.commands.len());
        let sent = &self.queued[nth * size..][..size];
        if lost == 0 {
            self.heard.fill(now);
            self.commands.copy_from_slice(sent);
            return;
        }
        for (robot, heard) in self.heard.iter_mut().enumerate() {
            if lost >> robot & 1 == 0 {
                *heard = now;
                let own = robot * columns..(robot + 1) * columns;
                self.commands[own.clone()].copy_from_slice(&sent[own]);
            }
        }
    }

    /// The commands that the robots obey, a row for each.
    pub(super) fn commands(&self) -> &[f32] {
        &self.commands
    }

    fn columns(&self) -> usize {
        self.commands.len() / self.heard.len().max(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TICK: f32 = 0.005;
    const LENGTHS: [f32; 2] = [TICK, 5.0 * TICK];

    /// Ticks at whose start the robot of a link obeys each of `count` commands, one in five ticks.
    fn arrivals(sensing: &Sensing, count: u16) -> Vec<(u16, u64)> {
        let mut link = Link::new(1, 1, 1);
        let mut obeyed = Vec::new();
        for now in 0..u64::from(count) * 5 {
            if now % 5 == 0 {
                let command = u16::try_from(now / 5).expect("few") + 1;
                link.send(now, LENGTHS, (sensing, 3), &[f32::from(command)]);
            }
            link.receive(now, None);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
            let command = link.commands()[0] as u16;
            if command != obeyed.last().map_or(0, |(last, _)| *last) {
                obeyed.push((command, now));
            }
        }
        obeyed
    }

    #[test]
    fn commands_are_late_by_the_delay() {
        for (delay, ticks) in [(0.0, 0), (0.02, 4), (0.1, 20)] {
            let sensing = Sensing { command_delay: delay, ..Sensing::OFF };
            for (command, at) in arrivals(&sensing, 100) {
                assert_eq!(at, u64::from(command - 1) * 5 + ticks);
            }
        }
    }

    #[test]
    fn a_delay_between_ticks_is_right_in_the_mean() {
        let sensing = Sensing { command_delay: 0.0332, ..Sensing::OFF };
        let obeyed = arrivals(&sensing, 4000);
        #[expect(clippy::cast_precision_loss, reason = "small numbers")]
        let late = |&(command, at): &(u16, u64)| at as f64 - f64::from(command - 1) * 5.0;
        let mean = obeyed.iter().map(late).sum::<f64>()
            / f64::from(u16::try_from(obeyed.len()).expect("few"));
        assert!((mean * f64::from(TICK) - 0.0332).abs() < 0.0002, "{mean}");
    }

    #[test]
    fn jitter_keeps_the_order_and_losses_leave_the_last_command() {
        let sensing = Sensing {
            command_delay: 0.05,
            command_jitter: 0.04,
            command_loss: 0.2,
            ..Sensing::OFF
        };
        let obeyed = arrivals(&sensing, 2000);
        assert!(obeyed.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let gaps = obeyed.windows(2).filter(|pair| pair[1].0 > pair[0].0 + 1).count();
        assert!(gaps > 200, "{gaps}");
    }

    #[test]
    fn a_robot_that_hears_nothing_stops_in_time_and_obeys_again() {
        let lost = Sensing { command_loss: 1.0, ..Sensing::OFF };
        let mut link = Link::new(2, 1, 1);
        link.send(0, LENGTHS, (&Sensing::OFF, 0), &[7.0, 8.0]);
        assert_eq!(link.receive(0, Some(20)), Some(0));
        assert_eq!(link.commands(), [7.0, 8.0]);
        for now in 1..20 {
            link.send(now, LENGTHS, (&lost, 0), &[1.0, 1.0]);
            link.receive(now, Some(20));
            assert_eq!(link.commands(), [7.0, 8.0]);
        }
        assert!(link.receive(20, Some(20)).is_some(), "they stop");
        assert_eq!(link.commands(), [0.0, 0.0]);
        assert_eq!(link.receive(21, Some(20)), None);
        link.send(22, LENGTHS, (&Sensing::OFF, 0), &[5.0, 6.0]);
        link.receive(22, Some(20));
        assert_eq!(link.commands(), [5.0, 6.0]);
    }
}
