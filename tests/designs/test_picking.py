"""Choosing variants by ids, filters and fractions; parts against every part there could be."""

import itertools
from collections import Counter

import pytest

from rgss.designs import picked, value_columns
from rgss.designs.balance import LARGEST_BLOCK, balanced_part
from rgss.errors import DefinitionError

RANGE = "parameter: d4, range: [1 N, 3 N], resolution: 0.01 N"


def ids(space, *terms):
    return [variant.id for variant in picked(space, terms)]


@pytest.mark.parametrize(
    ("terms", "expected"),
    [
        ((), [1, 2, 3, 4, 5, 6, 7, 8]),
        (("3",), [3]),
        (("1,7-8, 2-3",), [1, 2, 3, 7, 8]),
        (("d3=PRM",), [2, 4, 6, 8]),
        (("d3 != PRM",), [1, 3, 5, 7]),
        (("d1=100 g",), [1, 2, 3, 4]),
        (("d1==0.2 kg",), [5, 6, 7, 8]),
        (("d1 > 150 g",), [5, 6, 7, 8]),
        (("d2=3",), [3, 4, 7, 8]),
        (("design.d2=2",), [1, 2, 5, 6]),
        (("fingers=two",), [1, 2, 5, 6]),
        (("gripper=large",), [5, 6, 7, 8]),
        (("gripper=LARGE",), [5, 6, 7, 8]),
        (("d3=prm",), [2, 4, 6, 8]),
        (("fingers=Two",), [1, 2, 5, 6]),
        (("component.gripper!=large",), [1, 2, 3, 4]),
        (("D2=3",), [3, 4, 7, 8]),
        (("Fingers=two",), [1, 2, 5, 6]),
        (("force=3 N",), [1, 2, 3, 4, 5, 6, 7, 8]),
        (("gripper=low",), [1, 2, 3, 4]),
        (("planner=Prm",), [2, 4, 6, 8]),
        (("force * fingers >= 9 N",), [3, 4, 7, 8]),
        (("d1 * d2 >= 0.4 kg",), [5, 6, 7, 8]),
        (("d1*d2 == 0.6 kg,1",), [1, 7, 8]),
        (("d3=RRT", "d2=3"), [3, 7]),
        (("d3=RRT,d2=3",), [1, 3, 4, 5, 7, 8]),
    ],
)
def test_terms_choose_variants(project, terms, expected):
    assert ids(project.load(), *terms) == expected


def test_columns_of_values_choose_the_same_variants_as_the_terms(project):
    space = project.load()
    variants = space.expand()
    seen = set()
    for column in value_columns(space, variants):
        for place, value in enumerate(column.values):
            having = [one.id for one, entry in zip(variants, column.entries, strict=True) if entry == place]
            assert having == ids(space, f"{column.name}={value}")
            seen.add((column.name, value))
    # A component, and the level that selects it, which are not in one column.
    assert {("gripper", "large"), ("gripper", "low"), ("fingers", "two"), ("planner", "prm")} <= seen
    assert len({column.values for column in value_columns(space, variants) if column.name == "gripper"}) == 2


@pytest.mark.parametrize(
    ("old", "new", "terms", "expected"),
    [
        ("- id: mass\n", "- id: d1\n", ("d1=low",), [1, 2, 3, 4]),
        ("- id: mass\n", "- id: d1\n", ("D1!=High",), [1, 2, 3, 4]),
        ("- id: mass\n", "- id: d1\n", ("d1=200 g",), [5, 6, 7, 8]),
        ("- id: fingers\n", "- id: d2\n", ("d2=three",), [3, 4, 7, 8]),
        ("- id: fingers\n", "- id: d2\n", ("d2=3",), [3, 4, 7, 8]),
        ("{id: prm, sets", "{id: roadmap, sets", ("planner=roadmap",), [2, 4, 6, 8]),
        (
            "- id: planner\n    name: Planner\n    levels",
            "- id: d3\n    name: P\n    levels",
            ("d3=PRM",),
            [2, 4, 6, 8],
        ),
    ],
)
def test_a_factor_with_the_id_of_its_parameter_has_its_levels(project, old, new, terms, expected):
    assert ids(project.change(old, new).load(), *terms) == expected


def test_a_level_of_a_factor_with_the_id_of_a_named_parameter(project):
    project.change("- id: planner\n    name: Planner\n    levels", "- id: d3\n    name: P\n    levels")
    space = project.change("{id: prm, sets", "{id: roadmap, sets").load()
    assert ids(space, "d3=roadmap") == ids(space, "d3=PRM") == [2, 4, 6, 8]
    with pytest.raises(DefinitionError, match="d3 is never 'EST'"):
        picked(space, ["d3=EST"])


@pytest.mark.parametrize(
    ("terms", "message"),
    [
        (("x",), "--only: 'x' is not an id or a range (write ids such as 1,5,60-72)"),
        (("",), "--only: '' is not an id or a range (write ids such as 1,5,60-72)"),
        (("1,,2",), "--only: '' is not an id or a range (write ids such as 1,5,60-72)"),
        (("-5",), "--only: '-5' is not an id or a range (write ids such as 1,5,60-72)"),
        (("²",), "--only: '²' is not an id or a range (write ids such as 1,5,60-72)"),
        (("0",), "--only: unknown variant 0 (ids go from 1 to 8)"),
        (("7-99999999999",), "--only: unknown variant 9 (ids go from 1 to 8)"),
        (("5-1",), "--only: unknown variant 5-1 (ids go from 1 to 8)"),
        (("d3=RRX",), "--only: d3 is never 'RRX' (did you mean 'RRT'?)"),
        (("fingers=four",), "--only: fingers is never 'four' (known values of fingers: three, two)"),
        (("gripper=huge",), "--only: gripper is never 'huge' (known values of gripper: large, small)"),
        (
            ("finger=two",),
            "--only: nothing is named 'finger' (did you mean 'fingers'?)",
        ),
        (
            ("d1=3 N",),
            "--only: d1: unit 'N' does not measure what 'kg' measures (give it in kg or a multiple of it)",
        ),
        (
            ("d1 < 3 N",),
            "--only: 'd1 < 3 N': a value in kg is compared with one in N (compare values with the same dimension)",
        ),
        (("4/4",), "--only: the fraction must be above 0 and below 1, got 4/4 (write a fraction such as 1/4)"),
        (("1/0",), "--only: the fraction must be above 0 and below 1, got 1/0 (write a fraction such as 1/4)"),
        (("1/4,3",), "--only: the fraction '1/4' must be the only term (give it its own --only)"),
        (("d3=RRT", "2"), "--only: no variant is left at '2' (run 'rgss variants' to list them)"),
        (("d1 > 5 kg",), "--only: no variant is left at 'd1 > 5 kg' (run 'rgss variants' to list them)"),
    ],
)
def test_mistakes_are_told(project, terms, message):
    with pytest.raises(DefinitionError) as caught:
        picked(project.load(), terms)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("name", "value", "variants"),
    [
        ("gripper", "low", [1, 2, 3, 4]),
        ("component.gripper", "HIGH", [5, 6, 7, 8]),
        ("gripper", "small", [1, 2, 3, 4]),
        ("planner", "rrt", [1, 3, 5, 7]),
        ("planner", "PRM", [2, 4, 6, 8]),
        ("d3", "prm", [2, 4, 6, 8]),
        ("D3", "PRM", [2, 4, 6, 8]),
        ("fingers", "two", [1, 2, 5, 6]),
        ("planning.planner", "rrt", [1, 3, 5, 7]),
    ],
)
def test_a_filter_and_a_rule_have_one_spelling(project, name, value, variants):
    project.change("role: planner, description", "role: planner, sets: planning.planner, description")
    assert ids(project.load(), f"{name}={value}") == variants
    project.space_text += f"rules:\n  - {{id: r, rationale: So., require: {{{name}: {value}}}}}\n"
    assert ids(project.load()) == variants


def test_what_is_no_variant_is_passed_over_in_a_range_and_told_alone(project):
    project.space_text += "rules:\n  - {id: r, rationale: So., exclude: {d2: 3, d3: RRT}}\n"
    space = project.load()
    assert ids(space, "1-5") == [1, 2, 4, 5]
    with pytest.raises(DefinitionError, match=r"^--only: 3 is not a variant: it breaks rule 'r' \(run 'rgss variants'"):
        picked(space, ["3"])


def test_a_repeated_point_is_told(project):
    project.space_text += "sample: {method: sobol, size: 32, seed: 1}\n"
    space = project.load()
    repeat, first = next(iter(space.sample.repeats.items()))
    with pytest.raises(DefinitionError, match=f"{repeat} is not a variant: it repeats variant {first}"):
        picked(space, [str(repeat)])
    assert ids(space, "1-32") == [variant.id for variant in space.expand()]


def test_a_fraction_is_of_what_is_left(project):
    space = project.load()
    half = picked(space, ["d3=RRT", "1/2"])
    assert len(half) == 2
    assert Counter(variant.levels["mass"] for variant in half) == {"low": 1, "high": 1}
    assert Counter(variant.levels["fingers"] for variant in half) == {"two": 1, "three": 1}
    assert len(picked(space, ["3/4"])) == 6
    assert len(picked(space, ["1/100"])) == 1


def test_a_fraction_is_balanced_over_ranges_too(project):
    head, _, _ = project.space_text.partition("constants:")
    tail = project.space_text.partition("factors:")[2]
    project.space_text = (
        f"{head}factors:\n  - {{id: force, name: Force, {RANGE}}}{tail}sample: {{method: sobol, size: 64, seed: 3}}\n"
    )
    part = picked(project.load(), ["1/4"])
    assert len(part) == 16
    quarters = Counter(min(int((variant.parameters["d4"] - 1) / 0.5), 3) for variant in part)
    assert set(quarters.values()) == {4}
    for factor in ("mass", "fingers", "planner"):
        assert set(Counter(variant.levels[factor] for variant in part).values()) == {8}


def imbalance(rows, places):
    """Sums of squares of the counts of single levels and of pairs of levels, weighted as Xu's J2 has it."""
    columns = list(zip(*rows, strict=True))
    weights = [len(set(column)) for column in columns]
    alike = [
        sum(w for w, one, other in zip(weights, rows[i], rows[j], strict=True) if one == other)
        for i, j in itertools.combinations(places, 2)
    ]
    return sum(alike), sum(common**2 for common in alike)


@pytest.mark.parametrize(
    ("sizes", "count"), [((2, 2, 2), 4), ((2, 2, 2), 2), ((3, 2, 2), 6), ((3, 3), 3), ((2, 3, 2), 4), ((4, 2, 2), 8)]
)
def test_no_part_of_a_small_product_is_more_balanced(sizes, count):
    rows = list(itertools.product(*(range(size) for size in sizes)))
    best = min(imbalance(rows, places) for places in itertools.combinations(range(len(rows)), count))
    assert imbalance(rows, balanced_part(rows, count)) == best


@pytest.mark.parametrize("count", [6, 9, 12, 18, 24, 30, 36, 54])
def test_parts_of_the_reference_product_have_each_level_as_often_as_any_other(count):
    rows = list(itertools.product(range(2), range(2), range(2), range(3), range(3)))
    part = [rows[place] for place in balanced_part(rows, count)]
    for factor, size in enumerate((2, 2, 2, 3, 3)):
        counts = Counter(row[factor] for row in part)
        assert {counts[level] for level in range(size)} <= {count // size, -(-count // size)}


def test_a_part_of_many_designs_is_taken_block_by_block():
    rows = [(place % 2, place // 7 % 3) for place in range(2 * LARGEST_BLOCK + 100)]
    part = balanced_part(rows, 40)
    assert len(part) == 40
    assert list(part) == sorted(set(part))
    # Each of the three blocks may have one more of one level than of the other.
    assert abs(sum((-1) ** rows[place][0] for place in part)) <= 3


def test_a_part_without_factors_is_the_first_designs():
    assert balanced_part([(), (), ()], 2) == (0, 1)
    assert balanced_part([(1,), (2,)], 2) == (0, 1)
    assert balanced_part([(1,), (2,)], 0) == ()
    assert balanced_part([], 0) == ()
