"""Turns the bytes of a file into text, or says where they are none."""

from __future__ import annotations

import re

from .messages import Mark

_UNREADABLE = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


class NotTextError(ValueError):
    """Bytes that are no text.

    Attributes
    ----------
    text : what is wrong; remedy.
    mark : where, if it is known.
    """

    def __init__(self, text: str, mark: Mark | None = None) -> None:
        super().__init__(text)
        self.text = text
        self.mark = mark


def decode(content: bytes) -> str:
    """Text of a file, in UTF-8.

    Parameters
    ----------
    content : the bytes of the file.

    Raises
    ------
    NotTextError
        If they are not text.
    """
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise NotTextError("is UTF-16 text; save it as UTF-8")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise NotTextError(
            f"byte 0x{content[error.start]:02x} is not UTF-8 text; save the file as UTF-8",
            _place(content[: error.start].decode("utf-8", "replace")),
        ) from None
    wrong = _UNREADABLE.search(text)
    if wrong:
        raise NotTextError(
            f"character U+{ord(wrong.group()):04X} does not belong in text; is it a binary file?",
            _place(text[: wrong.start()]),
        )
    return text


def _place(before: str) -> Mark:
    return Mark(before.count("\n") + 1, len(before) - before.rfind("\n"))
