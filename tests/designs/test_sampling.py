"""Sampled designs against SciPy's own points, and what every sample promises."""

import os
import subprocess
import sys
from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import qmc

from rgss.designs import Factor, Level, SamplingMethod, Span, variants_csv
from rgss.designs.sampling import sample_factors, unit_points

RANGED = """\
factors:
  - {id: mass, name: Mass, levels: [{id: low, sets: {d1: 0.1 kg}}, {id: high, sets: {d1: 200 g}}]}
  - {id: fingers, name: Fingers, parameter: d2, range: [2, 5]}
  - {id: force, name: Force, parameter: d4, range: [0.4 N, 1.2 N], resolution: 0.01 N}
  - {id: planner, name: Planner, levels: [{id: rrt, sets: {d3: RRT}}, {id: prm, sets: {d3: PRM}}]}
sample: {method: METHOD, size: 64, seed: 7}
"""
SOBOL, LATIN = SamplingMethod.SOBOL, SamplingMethod.LATIN_HYPERCUBE


@pytest.fixture
def ranged(project):
    head, _, _ = project.space_text.partition("constants:")
    project.space_text = head + RANGED.replace("METHOD", "sobol")
    return project


def levels(count):
    return tuple(Level(id=f"l{number}", values={"d": number}) for number in range(count))


def discrete(*counts):
    return [Factor(id=f"f{place}", name="F", levels=levels(count)) for place, count in enumerate(counts)]


def points_of(method, dimensions, size, seed):
    engine = qmc.Sobol if method is SOBOL else qmc.LatinHypercube
    return engine(dimensions, rng=np.random.default_rng(seed)).random(size)


@pytest.mark.parametrize("method", [SOBOL, LATIN])
def test_values_are_the_points_of_scipy_to_the_resolution(ranged, method):
    ranged.change("method: sobol", f"method: {method.value}")
    space = ranged.load()
    points = points_of(method, 4, 64, 7)
    assert len(space.expand()) + len(space.sample.repeats) == 64
    for variant in space.expand():
        mass, fingers, force, planner = points[variant.id - 1]
        assert variant.parameters["d1"] == (0.1, 0.2)[int(mass * 2)]
        assert variant.parameters["d2"] == 2 + int(fingers * 4)
        assert abs(variant.parameters["d4"] - (0.4 + 0.8 * force)) <= 0.005 + 1e-12
        assert variant.parameters["d3"] == ("RRT", "PRM")[int(planner * 2)]


def test_the_values_of_a_seed_do_not_change(ranged):
    # Evidence is kept by design: a library that drew other points for a seed would make it all anew.
    assert variants_csv(ranged.load().expand()).splitlines()[:5] == GOLDEN


def test_values_are_decimals_that_one_can_read(ranged):
    for variant in ranged.load().expand():
        value = variant.parameters["d4"]
        assert repr(value) == repr(round(value, 2))
        assert variant.levels["force"] == f"{value:g} N"


@pytest.mark.parametrize("dimensions", [1, 2, 5])
def test_a_sobol_sample_has_one_point_in_each_part_of_every_axis(dimensions):
    points = np.array(unit_points(SOBOL, dimensions=dimensions, size=64, seed=3))
    for axis in points.T:
        assert sorted(np.floor(axis * 64).astype(int)) == list(range(64))


@given(st.integers(1, 80), st.integers(1, 4), st.integers(0, 99))
@settings(max_examples=30, deadline=None)
def test_a_latin_hypercube_has_one_point_in_each_part_of_every_axis(size, dimensions, seed):
    points = np.array(unit_points(LATIN, dimensions=dimensions, size=size, seed=seed))
    for axis in points.T:
        assert sorted(np.floor(axis * size).astype(int)) == list(range(size))


@pytest.mark.parametrize("method", [SOBOL, LATIN])
def test_samples_are_more_even_than_chance(method):
    even = [qmc.discrepancy(np.array(unit_points(method, dimensions=3, size=64, seed=seed))) for seed in range(10)]
    random = np.random.default_rng(1)
    chance = [qmc.discrepancy(random.random((64, 3))) for _ in range(50)]
    assert max(even) < np.quantile(chance, 0.5)
    assert np.mean(even) < 0.5 * np.mean(chance)


def test_a_larger_sobol_sample_begins_with_the_smaller_one(ranged):
    small = ranged.load().expand()
    ranged.change("size: 64", "size: 256")
    large = {variant.id: variant for variant in ranged.load().expand()}
    assert all(large[variant.id].digest == variant.digest for variant in small)


@given(st.integers(1, 60), st.lists(st.integers(1, 7), min_size=1, max_size=4), st.integers(0, 99))
@settings(max_examples=60, deadline=None)
def test_levels_of_a_latin_hypercube_differ_by_one_at_most(size, counts, seed):
    factors = [*discrete(*counts), Factor(id="s", name="S", levels=(), span=SPAN)]
    sample = sample_factors(factors, method=LATIN, size=size, seed=seed)
    rows = [*sample.points.values(), *(sample.points[first] for first in sample.repeats.values())]
    assert len(rows) == size
    for place, count in enumerate(counts):
        found = Counter(row[place].id for row in rows)
        assert {found[level.id] for level in factors[place].levels} <= {size // count, -(-size // count)}


@given(st.integers(0, 7), st.lists(st.integers(1, 9), min_size=1, max_size=4), st.integers(0, 99))
@settings(max_examples=60, deadline=None)
def test_levels_of_a_sobol_sample_balance(power, counts, seed):
    size = 2**power
    factors = discrete(*counts)
    sample = sample_factors(factors, method=SOBOL, size=size, seed=seed)
    rows = [*sample.points.values(), *(sample.points[first] for first in sample.repeats.values())]
    for place, count in enumerate(counts):
        found = Counter(row[place].id for row in rows)
        for level in factors[place].levels:
            assert abs(found[level.id] - size / count) < (1 if count & (count - 1) == 0 else 2)


SPAN = Span(parameter="d", unit="m", low=0.0, high=1.0, steps=1000)


def test_points_that_repeat_another_make_no_variant_and_keep_their_numbers():
    sample = sample_factors(discrete(2, 2), method=SOBOL, size=16, seed=1)
    assert len(sample.points) == 4
    assert sorted([*sample.points, *sample.repeats]) == list(range(1, 17))
    assert all(first < repeat and first in sample.points for repeat, first in sample.repeats.items())


@pytest.mark.parametrize(("low", "high", "steps"), [(0.4, 1.2, 80), (0.0, 0.3, 3), (1e-3, 7e-3, 6), (-0.1, 0.1, 7)])
def test_a_range_has_its_ends_and_the_decimals_between(low, high, steps):
    span = Span(parameter="d", unit="m", low=low, high=high, steps=steps)
    values = [span.value(step) for step in range(steps + 1)]
    assert (values[0], values[-1]) == (low, high)
    assert values == sorted(set(values))
    assert all(span.has(value) for value in values)
    assert not span.has((values[0] + values[1]) / 2)
    assert not span.has(high * 2 + 1)
    assert not span.has("RRT")
    assert span.at(0.0).values == {"d": low}
    assert span.at(1 - 2**-53).values == {"d": high}


def test_counts_of_a_range_are_equally_likely():
    span = Span(parameter="n", unit="1", low=2, high=8, steps=3, counted=True)
    assert Counter(span.at(place / 100).values["n"] for place in range(100)) == {2: 25, 4: 25, 6: 25, 8: 25}


@pytest.mark.parametrize("seed", ["0", "7"])
def test_samples_do_not_depend_on_the_process(ranged, seed):
    here = [f"{variant.id}:{variant.digest}" for variant in ranged.load().expand()]
    program = (
        "import sys; from pathlib import Path; from rgss.designs import *; folder = Path(sys.argv[1])\n"
        "space = load_design_space(folder / 'space.yaml', load_catalogue(folder / 'catalogue.yaml'))\n"
        "print(*(f'{variant.id}:{variant.digest}' for variant in space.expand()))"
    )
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    command = [sys.executable, "-c", program, str(ranged.folder)]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert result.stdout.split() == here


def test_what_a_rule_excludes_is_counted_and_keeps_its_number(ranged):
    whole = {variant.id: variant for variant in ranged.load().expand()}
    ranged.space_text += "rules:\n  - {id: r, rationale: So., constraint: d2 * d4 <= 3 N}\n"
    space = ranged.load()
    allowed = {number for number, one in whole.items() if round(one.parameters["d2"] * one.parameters["d4"], 6) <= 3}
    assert 0 < len(allowed) < len(whole)
    assert {variant.id for variant in space.expand()} == allowed
    assert {one.id for one in space.excluded()} == set(whole) - allowed
    assert all(variant.digest == whole[variant.id].digest for variant in space.expand())


MISTAKES = {
    "no resolution": (
        ", resolution: 0.01 N}",
        "}",
        "¦range: [0.4",
        "range: [0.4",
        (
            "the range of d4 has no resolution (add the 'resolution' to which values are rounded, such as a hundredth "
            "of the range) [design.range]"
        ),
    ),
    "resolution that does not fit": (
        "resolution: 0.01 N",
        "resolution: ¦0.03 N",
        "",
        "",
        (
            "0.4 N to 1.2 N is not a whole number of steps of 0.03 N "
            "(make the range a multiple of the resolution) [design.range]"
        ),
    ),
    "resolution of nothing": (
        "resolution: 0.01 N",
        "resolution: ¦0 N",
        "",
        "",
        "the resolution of d4 must be greater than zero (write a step) [design.range]",
    ),
    "empty range": (
        "[0.4 N, 1.2 N]",
        "¦[1.2 N, 0.4 N]",
        "",
        "",
        "the range of d4 is empty (write [least, greatest]) [design.range]",
    ),
    "three ends": (
        "range: [2, 5]",
        "range: ¦[2, 5, 6]",
        "",
        "",
        "the range of d2 has 3 ends (write [least, greatest]) [design.range]",
    ),
    "end in another unit": (
        "[0.4 N, 1.2 N]",
        "[0.4 N, ¦1.2 m]",
        "",
        "",
        "d4: unit 'm' does not measure what 'N' measures (give it in N or a multiple of it) [design.value]",
    ),
    "broken count": (
        "range: [2, 5]",
        "range: [2, ¦5.5]",
        "",
        "",
        "d2: a whole number from 0 is expected, got 5.5 (write a count, such as 2) [design.value]",
    ),
    "range of names": (
        "parameter: d2, range: [2, 5]",
        "parameter: ¦d3, range: [2, 5]",
        "levels: [{id: rrt, sets: {d3: RRT}}, {id: prm, sets: {d3: PRM}}]",
        "parameter: d2, range: [2, 5]",
        "d3 has names, which have no range (write levels) [design.range]",
    ),
    "both levels and a range": (
        "- {id: fingers, name: Fingers, parameter",
        "- ¦{id: fingers, name: Fingers, levels: [], parameter",
        "",
        "",
        (
            "factor 'fingers' has neither just levels nor just a range "
            "(write 'levels'; or 'parameter', 'range' and 'resolution') [design.factor]"
        ),
    ),
    "unknown parameter": (
        "parameter: d4",
        "parameter: ¦d44",
        "",
        "",
        "unknown design parameter 'd44' (did you mean 'd4'?) [design.unknown-parameter]",
    ),
    "odd size": (
        "size: 64",
        "size: ¦100",
        "",
        "",
        (
            "the size of a Sobol sample must be a power of two, got 100 "
            "(write 64 or 128, or use latin_hypercube) [design.sample]"
        ),
    ),
    "set by a constant too": (
        "factors:",
        "constants: {d4: 1 N}\nfactors:",
        "parameter: d4",
        "parameter: ¦d4",
        "d4 is already set by the constants (set it in one place) [design.set-twice]",
    ),
    "no component for a value": (
        "levels: [{id: low, sets: {d1: 0.1 kg}}, {id: high, sets: {d1: 200 g}}]",
        "parameter: d1, range: ¦[0.1 kg, 0.2 kg], resolution: 0.1 kg",
        "{d1: [200 g, 0.3 kg]}",
        "{d1: [0.3 kg]}",
        (
            "no gripper in the catalogue matches d1 = 0.2 kg "
            "(add a component, or a rule that excludes the combination) [design.no-component]"
        ),
    ),
    "rule on a value that is not on the grid": (
        "size: 64, seed: 7}",
        "size: 64, seed: 7}\nrules:\n  - {id: r, rationale: So., exclude: {d4: ¦0.405 N}}",
        "",
        "",
        "d4 is never 0.405 N (its range: 0.4 N to 1.2 N in 80 steps) [design.never-holds]",
    ),
}


@pytest.mark.parametrize("case", MISTAKES)
def test_a_mistake_is_found_at_its_place(ranged, case):
    old, new, second_old, second_new, message = MISTAKES[case]
    ranged.change(old, new)
    if second_old.startswith("¦"):
        ranged.change(second_new, second_old)
    elif second_old:
        ranged.change(second_old, second_new)
    expected = f"{ranged.marks()[0]}: error: {message}"
    assert expected in ranged.findings()
    unset = "is never set"
    assert [finding for finding in ranged.findings() if unset not in finding] == [expected]


def test_a_range_without_a_sample_is_found(ranged):
    ranged.change("\nsample: {method: sobol, size: 64, seed: 7}", "").change("range: [0.4", "¦range: [0.4")
    hint = "(add 'sample: {method: sobol, size: 64, seed: 1}' to the file, or write levels) [design.sample]"
    findings = ranged.findings()
    assert f"{ranged.marks()[0]}: error: factor 'force' has a range, so the file needs 'sample' {hint}" in findings
    assert len(findings) == 2


def test_a_sample_of_nothing_is_found(ranged):
    head, _, _ = ranged.space_text.partition("factors:")
    ranged.space_text = (
        head + "constants: {d1: 0.1 kg, d2: 2, d3: RRT, d4: 1 N}\n¦sample: {method: sobol, size: 4, seed: 1}\n"
    )
    assert ranged.findings() == [
        f"{ranged.marks()[0]}: error: the sample has no factor (add a factor, or remove 'sample') [design.sample]"
    ]


def test_a_sample_takes_spaces_whose_product_is_too_large(project):
    head, _, _ = project.space_text.partition("constants:")
    rows = "".join(f"      - {{id: l{n}, sets: {{d2: {n}}}}}\n" for n in range(400))
    more = "".join(f"      - {{id: m{n}, sets: {{d4: {n} N}}}}\n" for n in range(400))
    project.space_text = (
        f"{head}constants: {{d1: 0.1 kg, d3: RRT}}\nfactors:\n  - id: a\n    name: A\n    levels:\n{rows}"
        f"  - id: b\n    name: B\n    levels:\n{more}sample: {{method: latin_hypercube, size: 100, seed: 1}}\n"
    )
    assert len(project.load().expand()) == 100


GOLDEN = [
    "design_id,d1_mass_kg,d2_fingers,d3_planner,d4_force_n",
    "1,0.2,5,PRM,0.48",
    "2,0.1,2,RRT,0.87",
    "3,0.1,4,PRM,0.69",
    "4,0.2,3,RRT,1.05",
]
