"""The reference project, its trials, and one replicate of all of them from shared pieces."""

from __future__ import annotations

import pickle
from dataclasses import dataclass

import pytest

from rgss.evidence import TrialRecord
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project, load_project
from rgss.trials.pieces.run import Pieces
from rgss.trials.trial_spec import TrialSpec
from tests.fixtures.made_once import made_once
from tests.fixtures.shipped_project import REPOSITORY


@dataclass(frozen=True, kw_only=True)
class Replicate:
    """Every variant tried with the study's first seed.

    Attributes:
        specs: The trials by variant.
        records: Their records by variant.
        made: How many pieces of each kind were made for them.
    """

    specs: dict[int, TrialSpec]
    records: dict[int, TrialRecord]
    made: dict[str, int]


@pytest.fixture(scope="session")
def project(shipped) -> Project:
    return shipped


@pytest.fixture(scope="session")
def spec_of(project):
    """Makes the trial of a variant and a seed."""

    def make(variant: int = 65, seed: int = 1) -> TrialSpec:
        (spec,) = trial_specs(project, variants=[project.designs.variant(variant)], seeds=[seed])
        return spec

    return make


@pytest.fixture(scope="session")
def lite6() -> TrialSpec:
    """The design of the Lite6 that presses hardest, and a cube of 30 mm."""
    project = load_project(REPOSITORY, "studies/lite6_cubes.yaml")
    (spec,) = trial_specs(project, variants=[project.designs.variant(30)], seeds=[1])
    return spec


@pytest.fixture(scope="session")
def replicate(project, tmp_path_factory) -> Replicate:
    specs = {spec.variant: spec for spec in trial_specs(project, seeds=[project.study.seed])}
    with made_once(tmp_path_factory, "replicate.pickle") as path:
        if not path.exists():
            pieces = Pieces()
            records = {variant: pieces.record(spec) for variant, spec in specs.items()}
            path.write_bytes(pickle.dumps((records, pieces.made)))
        records, made = pickle.loads(path.read_bytes())  # noqa: S301 - written by this run
    return Replicate(specs=specs, records=records, made=made)
