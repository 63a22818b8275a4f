"""Features tell wheels and sizes; the learned model names what it knows and doubts what it does not."""

import json

import numpy as np
import pytest

from peers import classifier, command, train
from peers.design import Design
from peers.features import features
from peers.learned import best_threshold, doubt, learned
from peers.report import check
from peers.tests.made import FOUR, session

NAMES = [("dead_time", None), ("drive_gain", 0), ("drive_gain", 1), ("drive_gain", 2)]


def design(coefficients):
    chance = np.random.default_rng(9)
    terms = chance.standard_normal((4000, len(NAMES)))
    return Design(terms @ coefficients + 0.1 * chance.standard_normal(4000), terms, NAMES, np.full(4000, "electrical"))


def test_features_have_size_and_wheel():
    found = features(design([0, 0, 2.0, 0.5]), FOUR)
    assert found.wheels == {"drive_gain": 1}
    assert found.values["drive_gain.0.size"] == pytest.approx(2.0, abs=0.05)
    assert found.values["drive_gain.0.behind"] == pytest.approx(0.25, abs=0.05)
    assert abs(found.values["dead_time.0.share"]) < 0.01
    negative = features(design([-1.0, 0, 0, 0]), FOUR)
    assert negative.values["dead_time.0.share"] == pytest.approx(-1, abs=0.05)


def test_what_a_session_does_not_have_is_not_a_number():
    vector = features(design([1.0, 0, 0, 0]), FOUR).vector(["dead_time.0.size", "camera.rms"])
    assert vector[0] == pytest.approx(1, abs=0.05) and np.isnan(vector[1])


def test_the_threshold_parts_what_can_be_parted():
    known, strange = np.array([0.9, 0.8, 0.7]), np.array([0.3, 0.4])
    assert 0.4 < best_threshold(known, strange) < 0.7
    assert doubt(0.55, 0.55) == pytest.approx(0.5)
    assert doubt(0.9, 0.55) < 0.1 < 0.9 < doubt(0.1, 0.55)


def clouds(chance, label, count):
    centres = {"a": (0, 5), "b": (5, 0), "c": (-5, -5), "no_gap": (0, 0)}
    return np.array(centres[label]) + 0.5 * chance.standard_normal((count, 2))


def test_the_model_names_what_it_learned():
    chance = np.random.default_rng(10)
    labels = ["a", "b", "c", "no_gap"]
    table = np.vstack([clouds(chance, label, 30) for label in labels])
    model = learned(table, np.repeat(labels, 30), ["x", "y"], 1)
    for label in labels:
        given = model.probabilities(clouds(chance, label, 1)[0])
        assert max(given, key=given.get) == label
        assert sum(given.values()) == pytest.approx(1)


def words(tmp_path, *more):
    return [str(session(tmp_path / "s")), "--out", str(tmp_path / "out"), *more]


@pytest.mark.parametrize("text", [None, b"not a model"])
def test_without_a_model_it_says_how_to_train_one(tmp_path, capsys, text, tool):
    path = tmp_path / "model"
    if text is not None:
        path.write_bytes(text)
    asked = words(tmp_path, "--model", str(path), "--omni-gap", str(tool.program))
    assert command.run("classifier", classifier.answer, classifier.OPTIONS, asked) == 2
    assert "train" in capsys.readouterr().err


def test_training_and_answering_work_end_to_end(tmp_path, tool):
    program = ["--omni-gap", str(tool.program)]
    trained = ["--out", str(tmp_path / "model"), "--count", "40", "--seed", "2", *program]
    assert train.main(trained) == 0
    asked = words(tmp_path, "--model", str(tmp_path / "model"), *program)
    assert command.run("classifier", classifier.answer, classifier.OPTIONS, asked) == 0
    assert check(json.loads((tmp_path / "out" / "report.json").read_text())) == []


def test_too_few_sessions_are_refused(tmp_path, capsys):
    assert train.main(["--out", str(tmp_path / "model"), "--count", "3"]) == 2
    assert "--count 3" in capsys.readouterr().err
