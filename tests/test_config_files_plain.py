"""A study with a file is plain data again, with the name of the file in its place."""

from configs import example_path, load_study


def test_a_study_writes_a_file_by_its_name():
    study = load_study(example_path("three_sat_real")).study  # warnings are errors in tests
    assert study.model_dump(mode="json")["scene"]["observation"]["geojson_file"] == "etna.geojson"
