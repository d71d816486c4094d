"""The eight states as a task give the records that they gave as an enumeration, which are stored here."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rgss.evidence import record_to_json
from rgss.studies import load_project, trial_specs
from rgss.trials.pieces import run_trial

ROOT = Path(__file__).parents[2]
RECORDED = sorted((Path(__file__).parent / "recorded").glob("*.json"))


@pytest.mark.engine
@pytest.mark.slow
@pytest.mark.parametrize("path", RECORDED, ids=lambda path: path.stem)
def test_the_record_is_the_one_that_was_stored_before_tasks_were_data(path):
    study, fidelity, variant, seed = path.stem.rsplit("-", 3)
    project = load_project(ROOT, f"studies/{study}.yaml").with_fidelity(fidelity)
    variants = [one for one in project.designs.expand() if one.id == int(variant)]

    (spec,) = trial_specs(project, variants=variants, seeds=[int(seed)])

    was = plain(json.loads(path.read_text(encoding="utf-8")))
    record = plain(json.loads(record_to_json(run_trial(spec))))
    # Metrics that were added since are not compared.
    now = {key: value for key, value in record.items() if key in was or "/metrics/" not in key}

    # The last bits depend on the kernels of the machine; names, outcomes and counts do not.
    numbers = {key for key, value in was.items() if isinstance(value, float)}
    exact, close = ({key: value for key, value in one.items() if key not in numbers} for one in (was, now))
    assert close == exact
    assert {key: now[key] for key in numbers} == pytest.approx({key: was[key] for key in numbers}, rel=1e-5, abs=1e-4)


def plain(value, at=""):
    """A document as one mapping from paths to values."""
    if isinstance(value, (dict, list)):
        items = value.items() if isinstance(value, dict) else enumerate(value)
        return {path: leaf for key, inner in items for path, leaf in plain(inner, f"{at}/{key}").items()}
    return {at: value}
