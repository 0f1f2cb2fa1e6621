"""How far an error stays the same on the ground."""

from __future__ import annotations

from enum import StrEnum


class Scale(StrEnum):
    """How far an error stays the same on the ground: its correlation length.

    Every scale but the pixel is systematic over a scene; what differs is what else shares the
    error. Members are listed from the shortest to the longest, see `covers`.
    """

    PIXEL = "pixel"
    """Random from pixel to pixel: the relative height error of the model."""
    SCENE = "scene"
    """The same over the scene, another in the next scene of the data take."""
    DATA_TAKE = "data_take"
    """The same over a data take (one switching-on of the radar), another in the next."""
    ORBIT = "orbit"
    """The same in all data takes of a pass or of a day, another afterwards."""
    MISSION = "mission"
    """Always the same: a bias that no averaging of acquisitions removes."""

    def covers(self, other: Scale) -> bool:
        """Whether an error of this scale is the same over all of `other`.

        >>> Scale.ORBIT.covers(Scale.SCENE), Scale.SCENE.covers(Scale.ORBIT)
        (True, False)
        """
        order = list(Scale)
        return order.index(self) >= order.index(other)
