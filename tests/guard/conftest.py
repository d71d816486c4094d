"""A guarded study, and trials without a simulation that a change makes slower, failing or lost."""

from __future__ import annotations

import random
import re
from dataclasses import replace

import pytest

from rgss.evidence import EvidenceStore, Provenance
from rgss.guard import compare_with_baseline, make_baseline
from rgss.studies.study import read_study
from rgss.sweep.trial_keys import keys_of
from tests.fixtures.shipped_project import STUDY

SECTION = """
regression:
  runs:
    - {id: planning, fidelity: kinematic, variants: "57,60", replicates: 4, batch: 4, cap: 12}
    - {id: grasp, fidelity: contact, variants: "57", replicates: 4, batch: 8, cap: 12}
  decision: grasp
  metrics:
    - {metric: success, better: higher, margin: 25 %}
    - {metric: success, phases: all, better: higher, margin: 25 %}
    - {metric: planning_time_s, runs: [planning], phases: all, better: lower, margin: 0.2 s}
    - {metric: motion_time_s, better: lower, margin: 0.5 s}
"""
REASON = "First baseline."


def without_section(text):
    """The text of a study without what it guards."""
    return re.sub(r"(?ms)^(?:# What `rgss regress`[^\n]*\n(?:#[^\n]*\n)*)?regression:\n.*?(?=^\S|\Z)", "", text)


@pytest.fixture
def project_of(shipped, tmp_path):
    """The shipped project with another section."""

    def load(section=SECTION):
        path = tmp_path / "study.yaml"
        path.write_text(without_section((shipped.folder / STUDY).read_text(encoding="utf-8")) + section, "utf-8")
        study = read_study(
            path, shipped.measures, project=shipped.folder, label=STUDY, requirements=shipped.requirements
        )
        return replace(shipped, study=study)

    return load


@pytest.fixture
def stores(tmp_path):
    """Opens a new store each time."""
    opened = []

    def make():
        opened.append(EvidenceStore.open(tmp_path / f"{len(opened)}.sqlite"))
        return opened[-1]

    yield make
    for store in opened:
        store.close()


@pytest.fixture
def runner(record_of):
    """Runs trials without a simulation; each planning takes its time, and one may fail, or not be run at all."""

    def make(
        store,
        *,
        slower_s=0.0,
        slower=lambda spec: True,
        fails=lambda spec: False,
        lost=lambda spec: False,
        more_metrics=None,
        more_of_phases=False,
    ):
        def run(specs):
            rows = []
            for spec, key in zip(specs, keys_of(specs), strict=True):
                chance = random.Random(f"{spec.planner} {spec.seed}")  # noqa: S311 - a sample, no secret
                if lost(spec):
                    continue
                took_s = 0.5 + chance.random() + slower_s * slower(spec)
                record = record_of(spec, success=not fails(spec), planning_s=took_s)
                more = more_metrics or {}
                record = replace(record, metrics={**record.metrics, **more})
                if more_of_phases:
                    phases = tuple(replace(one, metrics={**one.metrics, **more}) for one in record.phases)
                    record = replace(record, phases=phases)
                rows.append((key, record, Provenance(inputs={}, versions={})))
            store.put_many(trials=rows)

        return run

    return make


@pytest.fixture(scope="session")
def baselines():
    """The baselines of sections, each made once from trials that are as they were."""
    return {}


@pytest.fixture
def compared(project_of, stores, runner, baselines):
    """The report of a project whose trials changed since its baseline."""

    def compare(
        section=SECTION, baseline_of=lambda baseline: baseline, on_look=None, before=SECTION, accepted="", **changes
    ):
        project = project_of(before)
        if before not in baselines:
            first = stores()
            baselines[before] = make_baseline(project, first, runner(first), before=None, reason=REASON)
        baseline = baselines[before]
        if section != before:
            project = project_of(section)
        now = stores()
        return compare_with_baseline(
            project,
            now,
            runner(now, **changes),
            baseline_of(baseline),
            label="b",
            on_look=on_look,
            accepted=accepted,
        )

    return compare
