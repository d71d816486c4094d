"""Properties of every design space: counts, uniqueness, order, ids."""

import itertools

from hypothesis import given
from hypothesis import strategies as st

from rgss.designs import (
    Catalogue,
    Component,
    Condition,
    DesignParameter,
    DesignSpace,
    Factor,
    Level,
    ParameterKind,
    Role,
    Rule,
    SourcedValue,
    variants_csv,
)
from rgss.documents import Document

COST = SourcedValue(value=1.0, unit="USD", assumption=True, rationale="Invented.", source="")
COMPONENT = Component(id="c", role="r", name="C", manufacturer="M", matches={}, geometry="", cost=COST, properties={})
CATALOGUE = Catalogue(
    roles=(Role(id="r", name="R", properties={}),),
    components=(COMPONENT,),
    document=Document(label="", data=None, values={(): (1, 1)}, keys={}),
)


@st.composite
def spaces(draw):
    sizes = draw(st.lists(st.integers(1, 4), min_size=1, max_size=4))
    factors, parameters = [], []
    for index, size in enumerate(sizes):
        values = draw(st.lists(st.integers(0, 9), min_size=size, max_size=size, unique=True))
        name = f"d{index}"
        parameters.append(DesignParameter(id=name, name=f"p{index}", symbol=name, kind=ParameterKind.COUNT, unit="1"))
        levels = tuple(Level(id=f"l{number}", values={name: value}) for number, value in enumerate(values))
        factors.append(Factor(id=f"f{index}", name="F", levels=levels))
    excluded = draw(
        st.lists(
            st.dictionaries(st.sampled_from([item.id for item in parameters]), st.integers(0, 9), min_size=1),
            max_size=3,
        )
    )
    rules = tuple(
        Rule(
            id=f"r{number}",
            rationale="So.",
            when=Condition(choices={name: (value,) for name, value in condition.items()}),
            require=None,
        )
        for number, condition in enumerate(excluded)
    )
    space = DesignSpace(
        parameters=tuple(parameters),
        constants={},
        factors=tuple(factors),
        rules=rules,
        catalogue=CATALOGUE,
        selectors={"c": {}},
    )
    return space, excluded


def _allowed_by_hand(space, excluded):
    """The combinations as plain tuples, in order, with their numbers."""
    values = [[level.values[f"d{index}"] for level in factor.levels] for index, factor in enumerate(space.factors)]
    for number, combination in enumerate(itertools.product(*values), start=1):
        named = {f"d{index}": value for index, value in enumerate(combination)}
        if not any(all(named[name] == value for name, value in condition.items()) for condition in excluded):
            yield number, named


@given(spaces())
def test_variants_are_the_product_less_what_is_excluded(drawn):
    space, excluded = drawn
    variants = space.expand()
    assert [(variant.id, variant.parameters) for variant in variants] == list(_allowed_by_hand(space, excluded))
    product = 1
    for factor in space.factors:
        product *= len(factor.levels)
    assert len(variants) + len(space.excluded()) == product


@given(spaces())
def test_every_variant_is_unique(drawn):
    variants = drawn[0].expand()
    assert len({tuple(variant.parameters.items()) for variant in variants}) == len(variants)
    assert len({variant.digest for variant in variants}) == len(variants)
    assert len(set(variants_csv(variants).splitlines())) == (len(variants) + 1 if variants else 0)
