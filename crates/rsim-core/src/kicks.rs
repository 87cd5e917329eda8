//! Several kickers that hit the ball in one tick.

use rapier2d::math::Vector;

/// Kickers that can be at one ball: more than have room around it.
const MOST: usize = 8;

/// Passes over the kicks. Two plates at less than 60 degrees agree after these to a thousandth; that
/// near each other only plates of small robots come.
const PASSES: usize = 16;

/// A kick as if it were the only one.
#[derive(Debug, Clone, Copy)]
struct Kick {
    robot: usize,
    /// Direction of the plate, a unit vector.
    heading: Vector,
    /// Impulse along the plate's direction, N s, at most.
    most: f32,
    /// Impulse across it, N s.
    across: Vector,
    /// Impulse along the plate's direction that it gives beside the others, N s.
    share: f32,
}

/// The kicks of one tick.
#[derive(Debug, Default)]
pub(crate) struct Kicks {
    all: [Option<Kick>; MOST],
    count: usize,
}

impl Kicks {
    /// Adds the kick of a robot that alone would give the ball an `impulse`, N s.
    pub(crate) fn add(&mut self, robot: usize, heading: Vector, impulse: Vector) {
        let most = impulse.dot(heading);
        let across = impulse - heading * most;
        if let Some(slot) = self.all.get_mut(self.count) {
            *slot = Some(Kick { robot, heading, most, across, share: most });
            self.count += 1;
        }
    }

    /// Each robot with its share of the impulse, N s.
    ///
    /// A plate pushes until the ball is as fast as it is, no further: what another plate gives along
    /// its direction it need not give itself. It never gives more than alone.
    pub(crate) fn shared(mut self) -> impl Iterator<Item = (usize, Vector)> {
        if self.count > 1 {
            for _ in 0..PASSES {
                self.refine();
            }
        }
        self.all
            .into_iter()
            .flatten()
            .map(|kick| (kick.robot, kick.heading * kick.share + kick.across))
    }

    /// Half way to what each has left to give beside the others: all at once, so that their order does
    /// not matter.
    fn refine(&mut self) {
        let before = self.all;
        for (nth, kick) in self.all.iter_mut().enumerate() {
            let Some(kick) = kick else { continue };
            let others = before.iter().enumerate().filter(|(other, _)| *other != nth);
            let given: f32 = others
                .filter_map(|(_, other)| other.as_ref())
                .map(|other| other.share * other.heading.dot(kick.heading))
                .sum();
            let left = (kick.most - given).clamp(0.0, kick.most.max(0.0));
            kick.share = kick.share.midpoint(left);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn together(degrees: f32) -> Vector {
        let mut kicks = Kicks::default();
        for (robot, angle) in [(0, degrees / 2.0), (1, -degrees / 2.0)] {
            let (sin, cos) = angle.to_radians().sin_cos();
            let heading = Vector::new(cos, sin);
            kicks.add(robot, heading, heading * 8.0);
        }
        kicks.shared().map(|(_, impulse)| impulse).sum()
    }

    #[test]
    fn two_plates_push_until_the_ball_is_as_fast_as_both() {
        for degrees in [60.0_f32, 80.0, 90.0] {
            let expected = 8.0 / (degrees / 2.0).to_radians().cos();
            let got = together(degrees);
            assert!((got.x / expected - 1.0).abs() < 2e-3, "{degrees}: {got}, {expected}");
            assert!(got.y.abs() < 1e-5, "{degrees}: {got}");
        }
    }

    #[test]
    fn opposed_plates_give_no_more_than_each_alone() {
        assert!(together(180.0).length() < 1e-5);
        assert!((together(120.0).x - 8.0).abs() < 1e-3);
    }

    #[test]
    fn one_kick_is_all_that_it_would_be() {
        let mut kicks = Kicks::default();
        kicks.add(3, Vector::X, Vector::new(0.3, -0.1));
        let all: Vec<_> = kicks.shared().collect();
        assert_eq!(all, [(3, Vector::new(0.3, -0.1))]);
    }
}
