"""What every study says."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Self

from pydantic import BaseModel, Field, model_validator

from .base import Block, Label, Prose, StudyName, wrong
from .messages import KeyPath, did_you_mean, show


class Study(Block):
    """What every study says."""

    kind: str = Field(description="What the study does.")
    name: StudyName = Field(
        default="study",
        description="Name in the report and of the output folder: letters, digits, '.', '-' and "
        "'_'; the name of the file if absent.",
    )
    description: Prose = Field(default="", description="What the study is for, in words.")


class SourcedStudy(Study):
    """A study that follows a source which does not print all of its inputs."""

    inferred: tuple[Label, ...] = Field(
        default=(),
        max_length=100,
        description="Inputs that are not the source's but inferred, by their keys, such as "
        "orbit.altitude_km or a whole block; the report names them beside the result.",
    )

    @model_validator(mode="after")
    def _check_inferred(self) -> Self:
        for number, path in enumerate(self.inferred):
            inputs_at(self, path, ("inferred", number))
        return self

    @property
    def inferred_inputs(self) -> tuple[tuple[str, str], ...]:
        """Key and value of each, as the author would write them."""
        return tuple(
            pair
            for number, path in enumerate(self.inferred)
            for pair in inputs_at(self, path, ("inferred", number))
        )


def inputs_at(block: BaseModel, path: str, at: KeyPath) -> Iterator[tuple[str, str]]:
    """Keys and values of a block at a path of keys, all that are given if it leads to a block.

    Parameters
    ----------
    block : of which they are.
    path : keys with points between them; list positions from 1 in between.
    at : of the path in the study, which is blamed for what is not there.

    Returns
    -------
    pairs of text.
    """
    return iter(list(_given(_value_at(block, path, at), path)))


def _value_at(block: BaseModel, path: str, at: KeyPath) -> Any:
    value: Any = block
    for key in path.split("."):
        if value is None:  # a block that the study does not give has no inputs to name
            return None
        if isinstance(value, BaseModel) and key in type(value).model_fields:
            value = getattr(value, key)
        elif isinstance(value, tuple) and key.isdigit() and 1 <= int(key) <= len(value):
            value = value[int(key) - 1]
        else:
            known = list(type(value).model_fields) if isinstance(value, BaseModel) else []
            raise wrong(
                at,
                f"names no input of the study: there is no {key!r}",
                f"{did_you_mean(key, known)}write keys with points between, as in "
                "orbit.altitude_km",
            )
    return value


def _given(value: Any, path: str) -> Iterator[tuple[str, str]]:
    if isinstance(value, BaseModel):
        for key in type(value).model_fields:  # in order; the set of those given has none
            if key in value.model_fields_set:
                yield from _given(getattr(value, key), f"{path}.{key}")
    elif isinstance(value, tuple) and any(isinstance(item, BaseModel) for item in value):
        for number, item in enumerate(value, 1):
            yield from _given(item, f"{path}.{number}")
    elif value is not None:
        yield path, show(_plain(value)).strip("'")


def _plain(value: Any) -> Any:
    """A value as it would be written: a list, a whole number without a point."""
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value
