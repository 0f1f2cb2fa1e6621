"""Numbers as JSON has them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

Json = dict[str, Any]


def finite(value: Any) -> float | None:
    """Number; None where it is not finite."""
    number = float(value)
    return number if math.isfinite(number) else None


def finite_list(values: Iterable[Any]) -> list[float | None]:
    """The same for each of several."""
    return [finite(value) for value in values]
