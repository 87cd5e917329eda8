//! Commands that were sent, as long as a forecast may need them.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

/// Commands of all robots, and when they act.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Sent {
    /// Time from which robots obey them, s.
    acts: f64,
    commands: Vec<f32>,
}

/// Commands that were sent, in the order in which they act.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct CommandLog {
    sent: VecDeque<Sent>,
    /// Time before which some commands are forgotten, s; `None` if all are known.
    known_since: Option<f64>,
    /// Memory for commands to come.
    #[serde(skip)]
    spare: Vec<Vec<f32>>,
}

/// The commands of a log that robots obey, of all robots; `None` if they stand still.
pub(crate) type Acting<'a> = Option<&'a [f32]>;

/// Whether these are the same ones of a log.
pub(crate) fn is_same(one: Acting<'_>, other: Acting<'_>) -> bool {
    one.map(<[f32]>::as_ptr) == other.map(<[f32]>::as_ptr)
}

impl CommandLog {
    /// Adds the commands that act from time `acts`, s, which is not before that of the last ones. Those of the same
    /// time act no more.
    pub(crate) fn add(&mut self, acts: f64, commands: &[f32]) {
        if self.sent.back().is_some_and(|last| last.acts >= acts) {
            self.spare.extend(self.sent.pop_back().map(|last| last.commands));
        }
        let mut copied = self.spare.pop().unwrap_or_default();
        copied.clear();
        copied.extend_from_slice(commands);
        self.sent.push_back(Sent { acts, commands: copied });
    }

    /// Time from which the last commands act, s.
    pub(crate) fn last(&self) -> Option<f64> {
        self.sent.back().map(|sent| sent.acts)
    }

    /// The commands that robots obey at a time, s; `None` before the first, or if robots stop after `timeout`
    /// (s) without new ones.
    pub(crate) fn acting(&self, time: f64, timeout: Option<f64>) -> Acting<'_> {
        let sent = self.sent.iter().rev().find(|sent| sent.acts <= time)?;
        let is_heard = timeout.is_none_or(|timeout| time - sent.acts < timeout);
        is_heard.then_some(&sent.commands)
    }

    /// Time before which some commands are forgotten, s; `None` if all are known.
    pub(crate) fn known_since(&self) -> Option<f64> {
        self.known_since
    }

    /// Forgets the commands that act no more at a time, s.
    pub(crate) fn forget_before(&mut self, time: f64) {
        while let Some(next) = self.sent.get(1).map(|next| next.acts).filter(|acts| *acts <= time) {
            let Some(old) = self.sent.pop_front() else { return };
            self.spare.push(old.commands);
            self.known_since = Some(next);
        }
    }

    /// Forgets all, as if none had been sent.
    pub(crate) fn clear(&mut self) {
        self.sent.clear();
        self.known_since = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_commands_that_act_are_obeyed_until_the_timeout() {
        let mut log = CommandLog::default();
        for (acts, command) in [(0.1, 1.0), (0.125, 2.0), (0.15, 3.0)] {
            log.add(acts, &[command]);
        }
        let at = |log: &CommandLog, time, timeout| log.acting(time, timeout).map(|c| c[0]);
        assert_eq!(at(&log, 0.09, None), None);
        assert_eq!(at(&log, 0.13, None), Some(2.0));
        assert_eq!(at(&log, 9.0, None), Some(3.0));
        assert_eq!((at(&log, 0.24, Some(0.1)), at(&log, 0.26, Some(0.1))), (Some(3.0), None));
        assert_eq!(log.known_since(), None);
        log.forget_before(0.13);
        assert_eq!(log.known_since(), Some(0.125));
        assert_eq!((at(&log, 0.11, None), at(&log, 0.13, None)), (None, Some(2.0)));
        log.forget_before(9.0);
        assert_eq!(at(&log, 9.0, None), Some(3.0), "the last ones act on");
        log.add(9.5, &[4.0]);
        log.add(9.5, &[5.0]);
        assert_eq!((at(&log, 9.4, None), at(&log, 9.6, None)), (Some(3.0), Some(5.0)));
        assert_eq!(log.sent.len(), 2, "time that stands does not let the log grow");
        log.clear();
        assert_eq!((at(&log, 9.0, None), log.last(), log.known_since()), (None, None, None));
    }
}
