//! Jobs of robots without the ball, and who does which.

use rsim_referee::Vector;

use crate::config::MAX_ROBOTS;
use crate::view::Player;

/// Distance by which another robot has to be nearer to take a job over, m.
const LOYALTY: f32 = 0.35;

/// A job.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Job {
    /// Number by which a robot knows its job again.
    pub(crate) number: i32,
    /// Place where it is done, m; none for a robot that finds its place itself.
    pub(crate) place: Option<Vector>,
}

impl Job {
    /// A job at a place.
    pub(crate) const fn at(number: i32, place: Vector) -> Self {
        Self { number, place: Some(place) }
    }
}

/// Jobs in the order of their importance.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Jobs {
    all: [Job; MAX_ROBOTS],
    count: usize,
}

impl Jobs {
    /// Adds the next job; more than there are robots are left out.
    pub(crate) fn add(&mut self, job: Job) {
        if self.count < MAX_ROBOTS {
            self.all[self.count] = job;
            self.count += 1;
        }
    }

    /// The jobs.
    #[cfg(test)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Job> {
        self.all[..self.count].iter()
    }

    /// Number of jobs.
    pub(crate) const fn len(&self) -> usize {
        self.count
    }

    /// Gives each job to the nearest free robot, in the order of the jobs. `free` has one bit for each robot
    /// and `last` its last job.
    pub(crate) fn assign(
        &self,
        players: &[Player],
        mut free: u32,
        last: impl Fn(usize) -> i32,
    ) -> [Option<Job>; MAX_ROBOTS] {
        let mut assigned = [None; MAX_ROBOTS];
        for job in &self.all[..self.count] {
            let cost = |player: &Player| {
                let distance = job.place.map_or(0.0, |place| player.position.distance(place));
                if last(player.index) == job.number { distance - LOYALTY } else { distance }
            };
            let candidates = players.iter().filter(|player| free >> player.index & 1 == 1);
            let nearest = candidates.min_by(|a, b| cost(a).total_cmp(&cost(b)));
            if let Some(player) = nearest {
                free &= !(1 << player.index);
                assigned[player.index] = Some(*job);
            }
        }
        assigned
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn player(index: usize, x: f32) -> Player {
        Player { index, position: Vector::new(x, 0.0), ..Player::default() }
    }

    fn assigned(jobs: &[Job], last: [i32; 3]) -> [Option<i32>; 3] {
        let mut all = Jobs::default();
        for job in jobs {
            all.add(*job);
        }
        let players = [player(0, 0.0), player(1, 1.0), player(2, 2.0)];
        let found = all.assign(&players, 0b110, |index| last[index]);
        [0, 1, 2].map(|index| found[index].map(|job: Job| job.number))
    }

    #[test]
    fn the_nearest_free_robot_gets_a_job() {
        let jobs = [Job::at(5, Vector::new(0.2, 0.0)), Job::at(6, Vector::new(0.0, 0.0))];
        assert_eq!(assigned(&jobs, [-1; 3]), [None, Some(5), Some(6)], "robot 0 is not free");
    }

    #[test]
    fn a_robot_keeps_its_job_if_another_is_hardly_nearer() {
        let near_one = [Job::at(5, Vector::new(1.4, 0.0))];
        assert_eq!(assigned(&near_one, [-1, -1, 5]), [None, None, Some(5)]);
        let nearer = [Job::at(5, Vector::new(1.2, 0.0))];
        assert_eq!(assigned(&nearer, [-1, -1, 5]), [None, Some(5), None]);
    }
}
