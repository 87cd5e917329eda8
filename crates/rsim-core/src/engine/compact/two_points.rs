//! Impulses of two contact points, solved together.

/// Determinant of the two points' inverse masses, by the product of its diagonal, below which the
/// points are too near each other to be solved together.
const MIN_DETERMINANT: f32 = 1e-3;

/// Impulses x of two points, not negative, for which `diagonal * x + coupling * other x + offset` is
/// zero, or not negative where x is zero.
pub(super) fn solve_two(diagonal: [f32; 2], coupling: f32, offset: [f32; 2]) -> [f32; 2] {
    let product = diagonal[0] * diagonal[1];
    let determinant = product - coupling * coupling;
    if determinant > MIN_DETERMINANT * product {
        let inverse = 1.0 / determinant;
        let both = [
            (coupling * offset[1] - diagonal[1] * offset[0]) * inverse,
            (coupling * offset[0] - diagonal[0] * offset[1]) * inverse,
        ];
        if both[0] >= 0.0 && both[1] >= 0.0 {
            return both;
        }
    }
    let alone = [-offset[0] / diagonal[0], -offset[1] / diagonal[1]];
    let second_is_free = coupling * alone[0] + offset[1] >= 0.0;
    if alone[0] >= 0.0 && (second_is_free || alone[1] < 0.0) {
        return [alone[0], 0.0];
    }
    [0.0, alone[1].max(0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::uniform;

    #[test]
    fn impulses_of_two_points_leave_no_closing_speed_and_never_pull() {
        let mut cases = [0; 4];
        for draw in 0..4000_u64 {
            let number = |part: u64| uniform(draw * 8 + part);
            let diagonal = [1.5 + number(0), 1.5 + number(1)];
            let coupling = 0.99 * number(2) * (diagonal[0] * diagonal[1]).sqrt();
            let offset = [number(3), number(4)];
            let [one, two] = solve_two(diagonal, coupling, offset);
            let speeds = [
                diagonal[0] * one + coupling * two + offset[0],
                diagonal[1] * two + coupling * one + offset[1],
            ];
            for (impulse, speed) in [one, two].into_iter().zip(speeds) {
                let rounding = 1e-4 * (1.0 + one + two);
                assert!(impulse >= 0.0 && speed > -rounding, "{draw}: {impulse} {speed}");
                assert!(impulse <= 0.0 || speed.abs() < rounding, "{draw}: {impulse} {speed}");
            }
            cases[usize::from(one > 0.0) + 2 * usize::from(two > 0.0)] += 1;
        }
        assert!(cases.iter().all(|count| *count > 100), "{cases:?}");
    }

    #[test]
    fn points_at_one_place_share_the_load_of_one() {
        let [one, two] = solve_two([2.0, 2.0], 2.0, [-1.0, -1.0]);
        assert!((2.0 * (one + two) - 1.0).abs() < 1e-6, "{one} {two}");
    }
}
