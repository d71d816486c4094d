"""The generator of the benchmark makes a sound project of the size that is asked for."""

from __future__ import annotations

import importlib.util
from collections import Counter
from pathlib import Path

import pytest

from rgss.requirements import LinkKind, load_requirements

BENCHMARK = Path(__file__).parents[2] / "benchmarks" / "requirements_scale.py"


@pytest.fixture(scope="module")
def benchmark():
    spec = importlib.util.spec_from_file_location("requirements_scale", BENCHMARK)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("size", [20, 200])
def test_it_has_the_requirements_and_links_of_its_size(benchmark, tmp_path, size):
    requirements = load_requirements(benchmark.write_project(tmp_path, size))
    links = Counter(link.kind for link in requirements.links)
    assert len(requirements.system) == size
    assert links[LinkKind.DERIVE] == size
    assert links[LinkKind.SATISFY] == 2 * size
    texts = {item.text for item in requirements.system}
    assert len(texts) == size


def test_the_same_size_gives_the_same_files(benchmark, tmp_path):
    first, second = (benchmark.write_project(tmp_path / name, 20) for name in ("a", "b"))
    for path in sorted(first.rglob("*.yaml")):
        assert path.read_bytes() == (second / path.relative_to(first)).read_bytes()


def test_every_stage_is_measured(benchmark):
    row = benchmark.measured(20)
    assert row["requirements"] == 20
    assert row["links"] >= 60
    assert set(row["seconds"]) == {"load", *benchmark.STAGES}
    assert all(seconds >= 0.0 for seconds in row["seconds"].values())
    assert row["memory_mb"] > 1.0
