//! Vectors of the plane, beyond those of the referee. No function of angles is used, so that results are the
//! same on every platform.

use rsim_referee::Vector;

/// Length below which a vector has no direction.
const TINY: f32 = 1e-6;

/// Operations on vectors of the plane.
pub(crate) trait Plane: Sized {
    /// The vector of length 1 in the same direction; `otherwise` for one without direction.
    fn unit_or(self, otherwise: Self) -> Self;

    /// The vector turned to the left by 90 degrees.
    fn left(self) -> Self;

    /// Component of the cross product: positive if `other` lies to the left.
    fn cross(self, other: Self) -> f32;

    /// The vector, shortened to a length if it is longer.
    fn limited(self, length: f32) -> Self;

    /// The vector in the axes of a frame whose x axis is the unit vector `ahead`.
    fn seen_from(self, ahead: Self) -> Self;

    /// The vector of a frame whose x axis is the unit vector `ahead`, in the axes of the field.
    fn turned_by(self, ahead: Self) -> Self;
}

impl Plane for Vector {
    fn unit_or(self, otherwise: Self) -> Self {
        let length = self.length();
        if length > TINY { self * (1.0 / length) } else { otherwise }
    }

    fn left(self) -> Self {
        Self::new(-self.y, self.x)
    }

    fn cross(self, other: Self) -> f32 {
        self.x * other.y - self.y * other.x
    }

    fn limited(self, length: f32) -> Self {
        let own = self.length();
        if own > length { self * (length / own) } else { self }
    }

    fn seen_from(self, ahead: Self) -> Self {
        Self::new(self.dot(ahead), ahead.cross(self))
    }

    fn turned_by(self, ahead: Self) -> Self {
        ahead * self.x + ahead.left() * self.y
    }
}

/// The angle from the unit vector `from` to the direction `to`, rad; up to 45 degrees it is accurate to 6
/// percent, beyond it is larger.
pub(crate) fn turn_to(from: Vector, to: Vector) -> f32 {
    let to = to.unit_or(from);
    let (cos, sin) = (from.dot(to), from.cross(to));
    let sin = if sin.abs() < TINY { TINY.copysign(sin) } else { sin };
    2.0 * sin / (1.0 + cos).max(TINY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_and_the_field_lead_to_each_other() {
        let ahead = Vector::new(0.6, 0.8);
        let vector = Vector::new(-2.0, 0.5);
        assert!(vector.seen_from(ahead).turned_by(ahead).distance(vector) < 1e-6);
        assert!(ahead.seen_from(ahead).distance(Vector::new(1.0, 0.0)) < 1e-6);
    }

    #[test]
    fn turns_have_the_sign_of_the_side_and_grow_to_the_back() {
        let ahead = Vector::new(1.0, 0.0);
        assert!((turn_to(ahead, Vector::new(10.0, 1.0)) - 0.1).abs() < 1e-3);
        assert!(turn_to(ahead, Vector::new(0.0, -1.0)) < -1.5);
        assert!(turn_to(ahead, Vector::new(-1.0, 0.01)) > 100.0);
        assert!(turn_to(ahead, Vector::default()).abs() < 1e-5, "no direction");
    }

    #[test]
    fn vectors_are_shortened_and_never_lengthened() {
        assert!((Vector::new(3.0, 4.0).limited(1.0).length() - 1.0).abs() < 1e-6);
        assert_eq!(Vector::new(0.3, 0.4).limited(1.0), Vector::new(0.3, 0.4));
    }
}
