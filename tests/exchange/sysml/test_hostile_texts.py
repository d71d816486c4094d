"""Texts that try to break out of where they stand."""

from __future__ import annotations

import longeron
import pytest

from rgss.exchange.sysml import sysml_text
from rgss.requirements import Architecture, BlockLevel, BlockRelation
from rgss.requirements.architecture import Block

HOSTILE = "It says */ \"x\" 'y' \\ <b>&amp;</b> =1+1 \U0001f916 {brace}; // end"


@pytest.mark.slow
def test_they_stay_texts(shipped):
    import dataclasses

    need = dataclasses.replace(shipped.requirements.stakeholder[0], text=HOSTILE, owner=HOSTILE, parent=None)
    block = Block(
        id="BLK-1", name=HOSTILE, level=BlockLevel.SYSTEM, parent=None, relation=BlockRelation.PART, text=HOSTILE
    )
    requirements = dataclasses.replace(
        shipped.requirements,
        stakeholder=(need,),
        system=(),
        architecture=Architecture(blocks=(block,), behaviours=()),
    )
    measures = dataclasses.replace(shipped.measures, measures=())

    model = longeron.loads(sysml_text(requirements, measures, title=HOSTILE))

    elements = list(model.iter_tree())
    assert [each.name for each in elements if getattr(each, "short_name", None) == "BLK-1"] == [HOSTILE]
    owners = [each.value.expr.value for each in elements if getattr(each, "redefines", None) == ["owner"]]
    assert owners == [HOSTILE]
    assert [package.name for package in model.members] == [HOSTILE]
    bodies = [each.body for each in elements if isinstance(each, longeron.Documentation)]
    assert sum(body.count("* / \"x\" 'y' \\ <b>") for body in bodies) == 2
