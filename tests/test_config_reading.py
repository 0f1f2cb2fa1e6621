"""Reading: what YAML means here, and that no input whatever gets past the error message."""

from __future__ import annotations

import hashlib
import math

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from configs import (
    EvaluateStudy,
    OptimizeStudy,
    StudyError,
    example_names,
    example_text,
    load_study,
)
from configs.reader import read_document

THREE_SAT = example_text("three_sat")


def data(text):
    return read_document(text.encode("utf-8"), file="a.yaml").data


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-3", 1e-3),
        ("1E3", 1e3),
        ("-.5", -0.5),
        ("+12.", 12.0),
        ("010", 10),
        ("0x10", 16),
        ("0o17", 15),
        ("-3", -3),
        ("99999999999999999999", 1e20),
        ("true", True),
        ("False", False),
        ("~", None),
        ("", None),
        ("no", "no"),
        ("on", "on"),
        ("10:30", "10:30"),
        ("2026-11-23", "2026-11-23"),
        ("1_000", "1_000"),
        ("1e", "1e"),
        ("0,5", "0,5"),
        ("!!str 12", "12"),
        ("!!float 12", 12.0),
        ("=", "="),
    ],
)
def test_scalars_follow_yaml_1_2(text, value):
    found = data(f"a: {text}\n")["a"]
    assert found == value
    assert type(found) is type(value)


def test_infinity_and_nan_are_numbers_here_and_refused_by_their_key():
    assert data("a: -.inf")["a"] == -math.inf
    assert math.isnan(data("a: .NaN")["a"])


def test_an_alias_stands_for_its_anchor():
    assert data("a: &x [1, 2]\nb: *x\n") == {"a": [1, 2], "b": [1, 2]}


def test_every_value_and_key_has_its_place():
    document = read_document(b"a:\n  b: 1\n  c: [x,\n    y]\n", file="a.yaml")
    assert document.marks["a", "b"] == (2, 6)
    assert document.keys["a", "b"] == (2, 3)
    assert document.marks["a", "c", 1] == (4, 5)


@pytest.mark.parametrize("ending", ["\r\n", "\r", "\n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_line_endings_and_byte_order_mark_do_not_matter(tmp_path, ending, mark):
    path = tmp_path / "three_sat.yaml"
    path.write_bytes((mark + THREE_SAT.replace("\n", ending)).encode("utf-8"))
    assert load_study(path).study == OptimizeStudy.model_validate(yaml.safe_load(THREE_SAT))


def test_the_study_knows_what_it_was_read_from(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text(THREE_SAT, encoding="utf-8", newline="\n")
    loaded = load_study(path)
    assert loaded.source_text == THREE_SAT
    assert loaded.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize(
    ("file", "name"),
    [
        ("my study.yaml", "my_study"),
        ("2026-11-23.yaml", "2026-11-23"),
        ("Überflug (neu).yaml", "Überflug_neu"),
        ("....yaml", "study"),
        ("x" * 90 + ".yaml", "x" * 64),
    ],
)
def test_a_study_without_a_name_is_called_as_its_file(tmp_path, file, name):
    path = tmp_path / file
    path.write_text(THREE_SAT.replace("name: three_sat ", "#"), encoding="utf-8")
    assert load_study(path).study.name == name


@pytest.mark.parametrize("name", ["no", "2026-11-23", "on", "X1.b-c", "编队"])
def test_a_name_may_look_like_something_else(tmp_path, name):
    path = tmp_path / "a.yaml"
    path.write_text(THREE_SAT.replace("name: three_sat ", f"name: {name} "), encoding="utf-8")
    assert load_study(path).study.name == name


def test_the_kind_is_optimize_unless_it_is_said(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text(THREE_SAT.replace("kind: optimize", ""), encoding="utf-8")
    assert load_study(path).study.kind == "optimize"
    path.write_text(example_text("evaluate_example"), encoding="utf-8")
    assert isinstance(load_study(path).study, EvaluateStudy)


def _loaded_or_refused(path, content):
    path.write_bytes(content)
    try:
        load_study(path)
    except StudyError as error:
        text = str(error)
        text.encode("utf-8")
        assert all(line.isprintable() for line in text.splitlines())


@given(st.binary(max_size=200))
def test_any_bytes_are_a_study_or_one_message(tmp_path_factory, content):
    _loaded_or_refused(tmp_path_factory.getbasetemp() / "bytes.yaml", content)


@given(st.text(max_size=200))
def test_any_text_is_a_study_or_one_message(tmp_path_factory, content):
    _loaded_or_refused(
        tmp_path_factory.getbasetemp() / "text.yaml", content.encode("utf-8", "surrogatepass")
    )


@given(st.text(alphabet="ab:-[]{},'\"\n &*!|>%@#?~.0123456789\\uUx\t<=", max_size=60))
def test_any_yaml_like_text_is_a_study_or_one_message(tmp_path_factory, content):
    _loaded_or_refused(tmp_path_factory.getbasetemp() / "yaml.yaml", content.encode("utf-8"))


_VALUES = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(max_size=12),
        st.sampled_from(["S1", "S2", "either", "li2009", "pair", "list"]),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4), st.dictionaries(st.text(max_size=6), inner, max_size=3)
    ),
    max_leaves=6,
)


def _paths(value, path=()):
    yield path
    items = enumerate(value) if isinstance(value, list) else getattr(value, "items", tuple)()
    for key, inner in items:
        yield from _paths(inner, (*path, key))


_EXAMPLES = {name: yaml.safe_load(example_text(name)) for name in example_names()}
_PLACES = [(name, path) for name, tree in _EXAMPLES.items() for path in _paths(tree) if path]


@given(where=st.sampled_from(_PLACES), value=_VALUES, rename=st.booleans())
def test_any_value_anywhere_in_a_study_is_accepted_or_one_message(
    tmp_path_factory, where, value, rename
):
    name, path = where
    tree = yaml.safe_load(example_text(name))
    parent = tree
    for part in path[:-1]:
        parent = parent[part]
    if rename and isinstance(parent, dict):
        parent[str(value)[:20]] = parent.pop(path[-1])
    else:
        parent[path[-1]] = value
    text = yaml.safe_dump(tree, allow_unicode=True)
    _loaded_or_refused(
        tmp_path_factory.getbasetemp() / "mutant.yaml", text.encode("utf-8", "surrogatepass")
    )
