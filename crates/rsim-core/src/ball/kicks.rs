//! Several kicks of one ball in one tick.

use crate::math::Vector;

/// Maximum number of kickers at one ball; more do not fit around it.
const MAX_KICKERS: usize = 8;

/// Iterations over the kicks. For two plates at less than 60 degrees these converge to a thousandth; only
/// plates of small robots come nearer to each other than that.
const PASSES: usize = 16;

/// The kick of one robot.
#[derive(Debug, Clone, Copy)]
struct Kick {
    robot: usize,
    /// Direction of the plate, unit vector.
    heading: Vector,
    /// Impulse along the plate's direction if it were the only kick, N s.
    alone: f32,
    /// Impulse across the plate's direction, N s.
    across: Vector,
    /// Impulse along the plate's direction together with the others, N s.
    share: f32,
}

/// The kicks of one tick.
#[derive(Debug, Default)]
pub(crate) struct Kicks {
    all: [Option<Kick>; MAX_KICKERS],
    count: usize,
}

impl Kicks {
    /// Adds the kick of a robot that would give the ball an `impulse` (N s) if it were the only one.
    pub(crate) fn add(&mut self, robot: usize, heading: Vector, impulse: Vector) {
        let alone = impulse.dot(heading);
        let across = impulse - heading * alone;
        if let Some(slot) = self.all.get_mut(self.count) {
            *slot = Some(Kick { robot, heading, alone, across, share: alone });
            self.count += 1;
        }
    }

    /// Robots with their impulses on the ball, N s.
    ///
    /// A plate pushes until the ball is as fast as the plate: it saves the impulse that other plates give
    /// along its direction. It never gives more than if it were the only one.
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

    /// Moves each share half way to the impulse that the others leave it, all at once, so that their
    /// order does not matter.
    fn refine(&mut self) {
        let before = self.all;
        for (nth, kick) in self.all.iter_mut().enumerate() {
            let Some(kick) = kick else { continue };
            let others = before.iter().enumerate().filter(|(other, _)| *other != nth);
            let given: f32 = others
                .filter_map(|(_, other)| other.as_ref())
                .map(|other| other.share * other.heading.dot(kick.heading))
                .sum();
            let left = (kick.alone - given).clamp(0.0, kick.alone.max(0.0));
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
    fn a_single_kick_is_unchanged() {
        let mut kicks = Kicks::default();
        kicks.add(3, Vector::X, Vector::new(0.3, -0.1));
        let all: Vec<_> = kicks.shared().collect();
        assert_eq!(all, [(3, Vector::new(0.3, -0.1))]);
    }
}
