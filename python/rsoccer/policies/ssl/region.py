"""Regions of the field in which a robot may drive."""

import numpy as np

from rsoccer._core import Field
from rsoccer.arrays import Floats
from rsoccer.vectors import FAR, XY, norm, reciprocal


class Region:
    """Allowed positions of a robot's center: a box, less the goal area that its team attacks."""

    def __init__(self, low: tuple[float, float], high: tuple[float, float]) -> None:
        """Set the box; no goal area is excluded.

        Args:
            low: smallest x and y, m.
            high: largest x and y, m.
        """
        self.low, self.high = np.array(low, np.float32), np.array(high, np.float32)
        self.area_x, self.area_y = FAR, np.float32(0.0)

    @classmethod
    def of_field(cls, field: Field, margin: float) -> "Region":
        """Return the region of a whole field.

        Args:
            field: the field.
            margin: distance to keep inside the field's lines, m.
        """
        corner = (field.half_length - margin, field.half_width - margin)
        return cls((-corner[0], -corner[1]), corner)

    def exclude_goal_area(self, field: Field, margin: float) -> "Region":
        """Exclude the opponents' goal area from this region.

        Args:
            field: the field.
            margin: distance to keep from the area, m.

        Returns:
            This region, changed.
        """
        self.area_x = np.float32(field.half_length - field.goal_area_depth - margin)
        self.area_y = np.float32(field.goal_area_width / 2 + margin)
        return self

    def distance_outside(self, x: Floats, y: Floats) -> Floats:
        """Return how far positions are outside the region, m; 0 inside.

        Args:
            x: (...) m.
            y: (...) m.
        """
        outside = np.maximum(self.low[0] - x, x - self.high[0])
        outside = np.maximum(outside, np.maximum(self.low[1] - y, y - self.high[1]))
        outside = np.maximum(outside, np.minimum(x - self.area_x, self.area_y - np.abs(y)))
        distance: Floats = np.maximum(outside, np.float32(0.0))
        return distance

    def clamp(self, x: Floats, y: Floats) -> XY:
        """Return the nearest positions in the box, moved out of the goal area.

        Args:
            x: (...) m.
            y: (...) m.

        Returns:
            x and y. A position in the goal area moves to the area's front or nearer side.
        """
        x = np.minimum(np.maximum(x, self.low[0]), self.high[0])
        y = np.minimum(np.maximum(y, self.low[1]), self.high[1])
        from_front, from_side = x - self.area_x, self.area_y - np.abs(y)
        within = np.minimum(from_front, from_side) > 0.0
        x = np.where(within & (from_front <= from_side), self.area_x, x)
        return x, np.where(within & (from_front > from_side), np.copysign(self.area_y, y), y)

    def length_in_goal_area(self, start: XY, end: XY) -> Floats:
        """Return the length (m) of the parts of segments that lie in the goal area.

        Args:
            start: starts of the segments, m.
            end: ends of the segments, m.
        """
        path_x, path_y = end[0] - start[0], end[1] - start[1]
        scale_x = np.copysign(reciprocal(np.abs(path_x)), path_x)
        scale_y = np.copysign(reciprocal(np.abs(path_y)), path_y)
        xs = (self.area_x - start[0]) * scale_x, (FAR + FAR - start[0]) * scale_x
        ys = (-self.area_y - start[1]) * scale_y, (self.area_y - start[1]) * scale_y
        enter = np.maximum(np.minimum(*xs), np.maximum(np.minimum(*ys), np.float32(0.0)))
        leave = np.minimum(np.maximum(*xs), np.minimum(np.maximum(*ys), np.float32(1.0)))
        part: Floats = np.maximum(leave - enter, np.float32(0.0)) * norm(path_x, path_y)
        return part
