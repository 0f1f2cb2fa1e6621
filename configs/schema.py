"""Reads the JSON schema of a study: what is allowed at a path, and how to say it in words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from .messages import KeyPath

Schema = dict[str, Any]

_UNITS = {
    "_deg_s2": "degrees per second squared",
    "_deg_s": "degrees per second",
    "_hz": "Hz",
    "_m_s": "m/s",
    "_km": "km",
    "_m": "m",
    "_deg": "degrees",
    "_db": "dB",
    "_s": "s",
    "_min": "minutes",
    "_days": "days",
}
_DEFINITIONS = "$defs"


def schema_at(schema: Schema, path: KeyPath) -> Schema:
    """What is allowed at a path; empty where nothing is known of it.

    Parameters
    ----------
    schema : of a whole study.
    path : keys and positions that lead to the value.

    Returns
    -------
    The part of the schema, references replaced.
    """
    definitions = schema.get(_DEFINITIONS, {})
    here = _dereference(schema, definitions)
    for part in path:
        if isinstance(part, int):
            entries = next((c for c in choices(here) if c.get("type") == "array"), {})
            prefix = entries.get("prefixItems", [])
            here = prefix[part] if part < len(prefix) else entries.get("items", {})
        else:
            here = resolve(here).get("properties", {}).get(part, {})
        here = _dereference(here, definitions)
    return here


def block_at(schema: Schema, path: KeyPath) -> Iterable[str]:
    """Keys of the block at a path; none where no block belongs.

    Parameters
    ----------
    schema : of a whole study.
    path : keys and positions that lead to the block.
    """
    keys: Iterable[str] = resolve(schema_at(schema, path)).get("properties", {})
    return keys


def choices(schema: Schema) -> list[Schema]:
    """The alternatives that a schema allows, without null."""
    found = schema.get("anyOf") or schema.get("oneOf")
    if found is None:
        return [] if schema.get("type") == "null" else [schema]
    return [choice for inner in found for choice in choices(inner)]


def resolve(schema: Schema) -> Schema:
    """The block among the alternatives of a schema, or its first alternative."""
    found = choices(schema)
    return next((choice for choice in found if choice.get("type") == "object"), found[0])


def describe(schema: Schema, key: str) -> str:
    """What a schema allows, in words.

    Parameters
    ----------
    schema : from `schema_at`.
    key : the key of the value, which ends in its unit.
    """
    words = list(dict.fromkeys(_describe_one(choice, key) for choice in choices(schema)))
    if schema.get("default") is not None and len(words) < len(schema.get("anyOf", [])):
        words.append("null to switch it off")
    return ", or ".join(words)


def _describe_one(schema: Schema, key: str) -> str:
    if "enum" in schema:
        return f"one of {', '.join(str(word) for word in schema['enum'])}"
    if "const" in schema:
        return str(schema["const"])
    kind = schema.get("type")
    if kind in ("number", "integer"):
        return _number(schema, key)
    if kind == "boolean":
        return "true or false"
    if kind == "string":
        return _text(schema)
    if kind == "array":
        return _list(schema, key)
    return f"a block with the keys {', '.join(schema.get('properties', {}))}"


def _number(schema: Schema, key: str) -> str:
    noun = "a whole number" if schema["type"] == "integer" else "a number"
    above = schema.get("exclusiveMinimum")
    start = f"from {schema['minimum']} to" if above is None else f"above {above} and at most"
    unit = next((f" {unit}" for end, unit in _UNITS.items() if key.endswith(end)), "")
    return f"{noun} {start} {schema['maximum']}{unit}"


def _text(schema: Schema) -> str:
    if schema.get("format") == "path":
        return "the name of a file"
    if "examples" in schema:
        return f"text such as '{schema['examples'][0]}'"
    limit = f" of at most {schema['maxLength']} characters" if "maxLength" in schema else ""
    if r"\w" in schema.get("pattern", ""):
        return f"text{limit}: letters, digits and '_', with '.' and '-' between them"
    return f"text{limit}" + (" on one line" if "pattern" in schema else "")


def _list(schema: Schema, key: str) -> str:
    low, high = schema.get("minItems", 0), schema.get("maxItems")
    count = f"{low}" if low == high else f"{low} to {high}"
    entry = choices(schema.get("prefixItems", [schema.get("items", {})])[0])[0]
    if entry.get("type") == "object":
        return f"a list of {count} blocks"
    return f"a list of {count} entries, each {_describe_one(entry, key)}"


def _dereference(schema: Schema, definitions: Schema) -> Schema:
    """The schema with its references replaced, down to its choices and entries."""
    if "$ref" in schema:
        target = definitions[schema["$ref"].rsplit("/", 1)[-1]]
        schema = {**target, **{key: value for key, value in schema.items() if key != "$ref"}}
    for form in ("anyOf", "oneOf"):
        if form in schema:
            found = [_dereference(choice, definitions) for choice in schema[form]]
            schema = {**schema, form: found}
    if "items" in schema:
        schema = {**schema, "items": _dereference(schema["items"], definitions)}
    return schema
