"""Loads a study from a file; whatever is wrong with it is a `StudyError`."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import yaml
from pydantic import BaseModel, ValidationError

from .examples import example_names
from .explain import explain, located
from .files import InputFile
from .messages import (
    BuildError,
    Finding,
    StudyError,
    closest,
    did_you_mean,
    show,
    study_error,
)
from .reader import MAX_BYTES, Document, read_document
from .studies import DEFAULT_KIND, STUDIES
from .study import Study


def effective_text(study: Study) -> str:
    """The study with every default filled in, as YAML that loads to an equal study.

    Parameters
    ----------
    study : a validated study.
    """
    content = _said(study)
    return yaml.safe_dump(content, sort_keys=False, allow_unicode=True, default_flow_style=None)


def _said(value: Any) -> Any:
    """Plain data of a block; keys that are absent by default, and absent here, are left out."""
    if isinstance(value, BaseModel):
        return {
            name: _said(getattr(value, name))
            for name, field in type(value).model_fields.items()
            if getattr(value, name) is not None or field.default is not None
        }
    if isinstance(value, InputFile):
        return value.name
    return [_said(item) for item in value] if isinstance(value, tuple) else value


class LoadedStudy(NamedTuple):
    """A study and what it was read from.

    Attributes
    ----------
    study : the study, of the class of its kind.
    source_text : the text of the file.
    sha256 : hexadecimal digest of the file's bytes.
    file : name of the file.
    document : its data, and where each value stands.
    files : the files that the study names, in its order.
    """

    study: Study
    source_text: str
    sha256: str
    file: str
    document: Document
    files: tuple[InputFile, ...]

    def located(self, error: BuildError) -> StudyError:
        """The error of a build with its place in the file, as every other error has it.

        Parameters
        ----------
        error : from building what the study describes.
        """
        return located(error.at, error.text, self.document, file=self.file)


def load_study(source: Path) -> LoadedStudy:
    """Read and check a study.

    Parameters
    ----------
    source : the YAML file.

    Returns
    -------
    LoadedStudy

    Raises
    ------
    StudyError
        If the file can't be read or says something that a study may not; one message with place,
        key, value, limit and remedy.
    """
    content = _read(source)
    file = str(source)
    document = read_document(content, file=file)
    data = document.data
    if not isinstance(data, dict):
        finding = Finding(
            f"the study is {show(data)}, not a block of keys such as 'orbit:' and 'radar:'; start "
            "from an example: formation-opt --new three_sat",
            document.marks[()],
        )
        raise study_error(file, [finding])
    kind = data.get("kind", DEFAULT_KIND)
    if not isinstance(kind, str) or kind not in STUDIES:
        finding = Finding(
            f"kind = {show(kind)} must be one of {', '.join(STUDIES)}; "
            f"{did_you_mean(str(kind), STUDIES).strip() or 'choose one'}",
            document.marks[("kind",)],
        )
        raise study_error(file, [finding])
    model = STUDIES[kind]
    try:
        study = model.model_validate(
            {"name": _default_name(source), **data}, context={"folder": source.parent}
        )
    except ValidationError as error:
        raise explain(error, document, model, file=file) from None
    return LoadedStudy(
        study=study,
        source_text=content.decode("utf-8-sig"),
        sha256=hashlib.sha256(content).hexdigest(),
        file=file,
        document=document,
        files=tuple(dict.fromkeys(_files(study))),
    )


def _files(value: Any) -> Iterator[InputFile]:
    """The files that a block names."""
    if isinstance(value, InputFile):
        yield value
    elif isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _files(getattr(value, name))
    elif isinstance(value, tuple):
        for item in value:
            yield from _files(item)


def _default_name(source: Path) -> str:
    return re.sub(r"[^\w.-]+", "_", source.stem).strip("._-")[:64].strip("._-") or "study"


def _read(source: Path) -> bytes:
    file = str(source)
    try:
        with source.open("rb") as stream:
            return stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise study_error(file, [Finding(_missing_file(source))]) from None
    except IsADirectoryError:
        raise study_error(file, [Finding("is a folder; name a YAML file in it")]) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        finding = Finding(f"cannot be read ({reason}); check its name and its permissions")
        raise study_error(file, [finding]) from None


def _missing_file(source: Path) -> str:
    near = closest(source.stem, example_names())
    if near is None:
        return "does not exist; correct its name, or take an example (formation-opt --list)"
    return f"does not exist; did you mean the shipped example? formation-opt {near}"
